#include "scene.h"

#include "outline.h"
#include "scene_parts.h"
#include "scene_record.h"
#include "scene_types.h"

#include <stdio.h>
#include <string.h>

/* ---- Which there are -------------------------------------------------------------------------------------------- */

static const SceneType* const types[] = {
    &bunnyScene,  &spiralScene,     &kirigamiScene, &patchworkScene,
    &vortexScene, &fallingGuyScene, &rubberScene,   &flatScene,
    &miuraScene,  &cardScene,       &craneScene,    &shirtScene,
    &lanternScene, &patchScene,     &bagScene,      &letterScene,
    &stampsScene,  &posterScene,    &weaveScene,    &canScene,
};

const SceneType* Scene_GetType(int32_t index)
{
    return index >= 0 && index < (int32_t)(sizeof types / sizeof types[0]) ? types[index] : NULL;
}

const SceneType* Scene_FindType(const char* name)
{
    for (int32_t i = 0; Scene_GetType(i) != NULL; i++) {
        if (strcmp(types[i]->name, name) == 0) {
            return types[i];
        }
    }
    return NULL;
}

/* ---- Start ------------------------------------------------------------------------------------------------------ */

/* The type with all that comes after its first cut at another pace. */
static SceneType SlowType(const SceneType* type, float pace)
{
    SceneType paced = *type;
    paced.lastCut = type->firstCut + Scene_Slow(type->lastCut - type->firstCut, pace);
    paced.ticks = type->firstCut + Scene_Slow(type->ticks - type->firstCut, pace);
    for (int32_t i = 0; i < SCENE_MOMENTS; i++) {
        int32_t after = type->moments[i] - type->firstCut;
        paced.moments[i] = after > 0 ? type->firstCut + Scene_Slow(after, pace) : type->moments[i];
    }
    return paced;
}

static void Initialize(Scene* scene, const SceneType* type, float pace)
{
    *scene = (Scene){ .type = type, .pace = 1.0f };
    if (pace > 0.0f && pace != 1.0f) {
        scene->paced = SlowType(type, pace);
        scene->type = &scene->paced;
        scene->pace = pace;
    }
}

/* The strokes are drawn. All blades at once, or one after the other, each as fast as the others. */
static void FinishStrokes(Scene* scene)
{
    const SceneType* type = scene->type;
    double all = 0.0, done = 0.0;
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        all += Outline_GetLength(&scene->strokes[i].way);
    }
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        Stroke* stroke = &scene->strokes[i];
        for (int32_t k = 0; k < 2 * stroke->way.count; k++) {
            stroke->way.points[k] *= type->size;
        }
        double before = type->together ? 0.0 : done / all;
        done += Outline_GetLength(&stroke->way) / type->size;
        double after = type->together ? 1.0 : done / all;
        stroke->firstTick = type->firstCut + (int32_t)((type->lastCut - type->firstCut) * before + 0.5);
        stroke->lastTick = type->firstCut + (int32_t)((type->lastCut - type->firstCut) * after + 0.5);
    }
}

bool Scene_Start(Scene* scene, const SceneType* type, const kiriWorldDef* def, const SceneOptions* options)
{
    Initialize(scene, type, options->pace);
    SceneOptions filled = *options;
    filled.dataFolder = filled.dataFolder != NULL ? filled.dataFolder : "samples/data";
    kiriResult result = kiriCreateWorld(def, &scene->world);
    if (result != KIRI_OK) {
        fprintf(stderr, "no world: %s\n", kiriGetResultName(result));
        return false;
    }
    bool fine = Scene_AddFloor(scene) && type->start(scene, &filled);
    FinishStrokes(scene);
    if (!fine) {
        fprintf(stderr, "scene %s does not start: %s\n", type->name, kiriWorld_GetLastError(scene->world));
        Scene_Stop(scene);
        return false;
    }
    scene->isRecorded = def->record != NULL;
    if (scene->isRecorded) {
        Scene_NoteStart(scene);
    }
    return true;
}

/* ---- Run -------------------------------------------------------------------------------------------------------- */

/* Gives the library the points of the way up to that number. */
static kiriResult TakePoints(Scene* scene, Stroke* stroke, int32_t until)
{
    if (until <= stroke->taken) {
        return KIRI_OK;
    }
    const float* points = stroke->way.points + 2 * stroke->taken;
    int32_t count = until - stroke->taken;
    stroke->taken = until;
    memcpy(stroke->tip, stroke->way.points + 2 * (until - 1), sizeof stroke->tip);
    return kiriCut_Extend(scene->world, stroke->cut, points, count);
}

/* And the point at `share` of the way from the last one to the next. */
static kiriResult TakeTip(Scene* scene, Stroke* stroke, float share)
{
    const float *from = stroke->way.points + 2 * (stroke->taken - 1), *to = from + 2;
    if (!(share > 0.0f)) {
        return KIRI_OK;
    }
    for (int i = 0; i < 2; i++) {
        stroke->tip[i] = from[i] + share * (to[i] - from[i]);
    }
    return kiriCut_Extend(scene->world, stroke->cut, stroke->tip, 1);
}

/* Gives the library the points up to this tick: those of the way, and at a pace of its own, where the blade moves
   smoothly, also where it is between them. */
static kiriResult MoveBlade(Scene* scene, Stroke* stroke)
{
    const Outline* way = &stroke->way;
    if (scene->tick < stroke->firstTick || stroke->taken == way->count) {
        return KIRI_OK;
    }
    kiriResult result = KIRI_OK;
    if (stroke->taken == 0) {
        result = kiriBeginCut(scene->world, scene->sheet, way->points, &stroke->cut);
        memcpy(stroke->tip, way->points, sizeof stroke->tip);
        stroke->taken = 1;
    }
    int32_t ticks = stroke->lastTick - stroke->firstTick, done = scene->tick - stroke->firstTick;
    int64_t gone = (int64_t)(way->count - 1) * done;
    int32_t until = done < ticks ? 1 + (int32_t)(gone / ticks) : way->count;
    result = result == KIRI_OK ? TakePoints(scene, stroke, until) : result;
    if (result == KIRI_OK && until == way->count) {
        result = kiriCut_End(scene->world, stroke->cut);
    } else if (result == KIRI_OK && scene->pace != 1.0f) {
        result = TakeTip(scene, stroke, (float)(gone % ticks) / (float)ticks);
    }
    return result;
}

kiriResult Scene_Tick(Scene* scene)
{
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        kiriResult result = MoveBlade(scene, &scene->strokes[i]);
        if (result < 0) {
            return result;
        }
    }
    int32_t parts = scene->type->parts > 0 ? scene->type->parts : 1;
    kiriResult result = KIRI_OK;
    for (int32_t i = 0; i < parts && result >= 0; i++) {
        if (scene->type->push != NULL) {
            scene->type->push(scene);
        }
        if (i == 0) {
            scene->tick++;
            if (scene->isRecorded) {
                Scene_NoteTick(scene);
            }
        }
        result = kiriWorld_Tick(scene->world, 1.0f / (60.0f * (float)parts), scene->type->substeps);
    }
    return result;
}

int32_t Scene_GetBlades(const Scene* scene, float (*restPoints)[2], int32_t capacity)
{
    int32_t count = 0;
    for (int32_t i = 0; i < scene->strokeCount && count < capacity; i++) {
        const Stroke* stroke = &scene->strokes[i];
        if (stroke->taken > 0 && scene->tick <= stroke->lastTick + 1) {
            memcpy(restPoints[count++], stroke->tip, sizeof stroke->tip);
        }
    }
    return count;
}

void Scene_Stop(Scene* scene)
{
    kiriDestroyWorld(scene->world);
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        Outline_Free(&scene->strokes[i].way);
    }
    *scene = (Scene){ .type = NULL };
}
