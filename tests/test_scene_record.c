/* Recordings of scenes in files: a replay has the same state, and shows the same. */
#include "../samples/scene_record.h"
#include "host.h"

#include <stdio.h>

static char filePath[1024]; /* beside the program */

/* A scene in which pins move and blades cut. */
static void RecordScene(const char* name, int32_t ticks, Scene* scene)
{
    FILE* file;
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
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
    SceneReplay replay;
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
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
    SceneReplay_Free(&replay);
}

static void TestReplay(void** state)
{
    CheckReplay("bunny", Scene_FindType("bunny")->firstCut + 20);
    CheckReplay("kirigami", Scene_FindType("kirigami")->firstCut + 3);
    remove(filePath);
}

static void TestNoRecording(void** state)
{
    Scene scene;
    SceneReplay replay;
    FILE* file;
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    assert_false(SceneReplay_Start(&replay, "build/no such file", &scene, Scene_GetType(0), &def));
    SceneReplay_Free(&replay);
    assert_false(SceneReplay_Start(&replay, "README.md", &scene, Scene_GetType(0), &def));
    assert_false(replay.isRight);
    SceneReplay_Free(&replay);
    assert_false(SceneRecord_Open(&file, "build/no such folder/file", &def));
    assert_true(SceneRecord_Close(NULL, NULL));
}

int main(int count, char** words)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestReplay),
        cmocka_unit_test(TestNoRecording),
    };
    snprintf(filePath, sizeof filePath, "%s.recording", count > 0 ? words[0] : "test_scene_record");
    return cmocka_run_group_tests(tests, NULL, NULL);
}
