/* Recordings of scenes in files: a replay has the same state, and shows the same. */
#include "../samples/scene_record.h"
#include "host.h"

#include <stdio.h>

static char filePath[1024]; /* beside the program */

/* A scene in which pins move and blades cut. */
static void RecordScene(const char* name, int32_t ticks, Scene* scene)
{
    FILE* file;
    kiriWorldDef def = DefaultWorld();
    assert_true(SceneRecord_Open(&file, filePath, &def));
    def.recordHashTicks = 7;
    assert_true(Scene_Start(scene, Scene_FindType(name), &def, &(SceneOptions){ .plain = false }));
    for (int32_t i = 0; i < ticks; i++) {
        assert_true(Scene_Tick(scene) >= 0);
    }
    Scene last = *scene;
    Scene_Stop(scene);
    *scene = last;
    assert_true(SceneRecord_Close(file, filePath));
}

static void CheckReplay(const char* name, int32_t ticks)
{
    Scene recorded, scene;
    SCOPED(SceneReplay, replay, SceneReplay_Free);
    kiriWorldDef def = DefaultWorld();
    RecordScene(name, ticks, &recorded);
    assert_true(SceneReplay_Start(&replay, filePath, &scene, Scene_GetType(0), &def));
    assert_true(replay.isRight);
    assert_int_equal(replay.ticks, ticks);
    for (int32_t i = 0; i < ticks; i++) {
        assert_int_equal(SceneReplay_Tick(&replay, &scene), KIRI_PENDING);
    }
    assert_int_equal(SceneReplay_Tick(&replay, &scene), KIRI_OK);
    assert_string_equal(scene.type->name, name);
    assert_int_equal(scene.sheet, recorded.sheet);
    assert_int_equal(scene.gridResolution, recorded.gridResolution);
    assert_int_equal(scene.tick, ticks);
    assert_int_equal(scene.pinCount, recorded.pinCount);
    assert_memory_equal(scene.targets, recorded.targets, sizeof scene.targets[0] * (size_t)scene.pinCount);
    float blades[2][SCENE_MAX_STROKES][2];
    int32_t count = Scene_GetBlades(&recorded, blades[0], SCENE_MAX_STROKES);
    assert_int_equal(Scene_GetBlades(&scene, blades[1], SCENE_MAX_STROKES), count);
    assert_memory_equal(blades[1], blades[0], sizeof blades[0][0] * (size_t)count);
    Scene_Stop(&scene);
}

TEST(Replay)
{
    CheckReplay("bunny", Scene_FindType("bunny")->firstCut + 20);
    CheckReplay("kirigami", Scene_FindType("kirigami")->firstCut + 3);
    remove(filePath);
}

static void CheckOpened(const SceneReplay* replay, Scene* scene, uint64_t hash)
{
    uint64_t found = 0;
    for (int32_t i = 0; i < 2; i++) {
        assert_true(fabs((double)(scene->type->size * scene->type->camera.target[i]) - (i == 0 ? 5.5 : 0.5)) < 0.01);
    }
    assert_true(fabs((double)scene->type->size - 11.0) < 0.01);
    assert_true(replay->isRight);
    kiriWorld_GetStateHash(scene->world, &found);
    assert_int_equal(found, hash);
}

/* A recording without a scene, and a save, go on as the world did; the camera looks at the middle of all sheets. */
TEST(WorldsOfHosts)
{
    static uint8_t bytes[1 << 20];
    FILE* file;
    kiriWorld* world;
    kiriSheet sheet;
    uint64_t hashes[2];
    int64_t size = 0;
    kiriWorldDef def = DefaultWorld();
    kiriSheetDef sheetDef = DefaultSheet();
    assert_true(SceneRecord_Open(&file, filePath, &def));
    assert_int_equal(kiriCreateWorld(&def, &world), KIRI_OK);
    for (int32_t i = 0; i < 2; i++, sheetDef.position[0] += 10.0f) {
        sheetDef.normals = i;
        assert_int_equal(kiriCreateRectangle(world, 1.0f, 1.0f, 4, 4, &sheetDef, &sheet), KIRI_OK);
    }
    for (int32_t i = 0; i < 2; i++) {
        kiriWorld_Tick(world, 1.0f / 60.0f, 2);
        kiriWorld_GetStateHash(world, &hashes[i]);
        if (i == 0) {
            assert_int_equal(kiriWorld_Save(world, bytes, sizeof bytes, &size), KIRI_OK);
        }
    }
    kiriDestroyWorld(world);
    assert_true(SceneRecord_Close(file, filePath));
    for (int32_t pass = 0; pass < 2; pass++) {
        SCOPED(Scene, scene, Scene_Stop);
        SCOPED(SceneReplay, replay, SceneReplay_Free);
        if (pass == 1) {
            file = fopen(filePath, "wb");
            assert_int_equal(fwrite(bytes, 1, (size_t)size, file), size);
            assert_int_equal(fclose(file), 0);
        }
        kiriDefaultWorldDef(&def);
        assert_true(SceneReplay_Start(&replay, filePath, &scene, Scene_GetType(0), &def));
        assert_int_equal(replay.isSave, pass);
        for (int32_t i = pass; i < 2; i++) {
            assert_int_equal(SceneReplay_Tick(&replay, &scene), KIRI_PENDING);
        }
        CheckOpened(&replay, &scene, hashes[1]);
    }
    remove(filePath);
}

/* A cut takes the larger part off a held sheet, and it falls sideways: the camera stays. */
TEST(HeldPieceStaysSeen)
{
    FILE* file;
    kiriWorld* world;
    kiriSheet sheet;
    uint32_t id;
    SCOPED(Scene, scene, Scene_Stop);
    SCOPED(SceneReplay, replay, SceneReplay_Free);
    kiriWorldDef def = DefaultWorld();
    kiriSheetDef sheetDef = DefaultSheet();
    def.gravity[0] = 9.81f;
    assert_true(SceneRecord_Open(&file, filePath, &def));
    kiriCreateWorld(&def, &world);
    kiriCreateRectangle(world, 1.0f, 1.0f, 8, 8, &sheetDef, &sheet);
    assert_int_equal(kiriSheet_ClampLine(world, sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 0.0f, 1.0f }, &id), KIRI_OK);
    assert_int_equal(kiriBeginCut(world, sheet, (float[]){ 0.2f, -0.1f }, &id), KIRI_OK);
    assert_int_equal(kiriCut_Extend(world, id, (float[]){ 0.2f, 1.1f }, 1), KIRI_OK);
    for (int32_t i = 0; i < 120; i++) {
        kiriWorld_Tick(world, 1.0f / 60.0f, 2);
    }
    kiriDestroyWorld(world);
    assert_true(SceneRecord_Close(file, filePath));
    kiriDefaultWorldDef(&def);
    assert_true(SceneReplay_Start(&replay, filePath, &scene, Scene_GetType(0), &def));
    for (int32_t i = 0; i < 120; i++) {
        assert_int_equal(SceneReplay_Tick(&replay, &scene), KIRI_PENDING);
        float target = scene.type->size * scene.type->camera.target[0];
        assert_true(target > 0.0f && target < 1.0f);
    }
    remove(filePath);
}

TEST(NoRecording)
{
    Scene scene;
    SceneReplay replay;
    FILE* file;
    kiriWorldDef def = DefaultWorld();
    assert_false(SceneReplay_Start(&replay, "build/no such file", &scene, Scene_GetType(0), &def));
    SceneReplay_Free(&replay);
    assert_false(SceneReplay_Start(&replay, "README.md", &scene, Scene_GetType(0), &def));
    assert_false(replay.isRight);
    SceneReplay_Free(&replay);
    assert_false(SceneRecord_Open(&file, "build/no such folder/file", &def));
    assert_true(SceneRecord_Close(NULL, NULL));
}

SETUP
{
    snprintf(filePath, sizeof filePath, "%s.recording", words[0]);
}
