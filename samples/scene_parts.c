#include "scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- Sheets ----------------------------------------------------------------------------------------------------- */

kiriSheetDef Scene_PlaceSheet(const Scene* scene, const float corner[3], const float axisV[3], kiriMaterial material)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.skinning = KIRI_SKINNING_LINEAR; /* the paper's */
    for (int i = 0; i < 3; i++) {
        def.position[i] = scene->type->size * corner[i];
        def.axisU[i] = i == 0 ? 1.0f : 0.0f;
        def.axisV[i] = axisV[i];
    }
    def.material = material;
    return def;
}

static void ScaleToSize(const Scene* scene, float* numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        numbers[i] *= scene->type->size;
    }
}

bool Scene_MakeSheet(Scene* scene, kiriSheetDef* def, const SceneOptions* options, const float* frames)
{
    size_t numbers = 2 * (size_t)def->frameCount;
    float* scaled = malloc((numbers + 1) * sizeof(float)); /* +1: frameCount may be 0 */
    kiriResult result = KIRI_ERROR_MEMORY;
    if (scaled != NULL) {
        if (options->frameCount > 0) {
            def->frameCount = options->frameCount;
        } else if (frames != NULL) {
            memcpy(scaled, frames, numbers * sizeof(float));
            ScaleToSize(scene, scaled, numbers);
            def->framePoints = scaled;
        }
        if (options->plain) {
            def->model = KIRI_MODEL_LINKS;
            def->planar = 0;
        }
        def->skinning = options->smooth ? KIRI_SKINNING_SMOOTH : def->skinning;
        def->gridResolution = options->gridResolution > 0 ? options->gridResolution : def->gridResolution;
        def->collisionPoints = options->collisionPoints;
        def->paper.fromScratch = options->fromScratch;
        def->paper.popping = options->popping;
        def->fadeTime = options->unfaded ? 0.0f : def->fadeTime;
        def->contactThickness = 2.0f * scene->type->size * floorGap;
        scene->gridResolution = def->gridResolution;
        result = scene->folds == NULL
                     ? kiriCreateSheet(scene->world, def, &scene->sheet)
                     : kiriCreateFoldedSheet(scene->world, def, scene->folds, scene->foldCount, &scene->sheet);
        scene->folds = NULL;
    }
    free(scaled);
    return result == KIRI_OK;
}

bool Scene_MakeRectangle(Scene* scene, kiriSheetDef* def, const SceneOptions* options, const Rectangle* rectangle)
{
    const float size = scene->type->size;
    int32_t columns = rectangle->columns, rows = rectangle->rows;
    def->vertexCount = (columns + 1) * (rows + 1);
    def->triangleCount = 2 * columns * rows;
    float* positions = malloc(2 * sizeof(float) * (size_t)def->vertexCount);
    int32_t* indices = malloc(3 * sizeof(int32_t) * (size_t)def->triangleCount);
    bool fine = positions != NULL && indices != NULL;
    if (fine) {
        kiriFillRectangle(size * rectangle->width, size * rectangle->height, columns, rows, positions, indices);
        def->restPositions = positions;
        def->indices = indices;
        fine = Scene_MakeSheet(scene, def, options, rectangle->frames);
    }
    free(positions);
    free(indices);
    return fine;
}

/* ---- Pins ------------------------------------------------------------------------------------------------------- */

bool Scene_PinAt(Scene* scene, float u, float v, float x, float y, float z)
{
    const float size = scene->type->size;
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    memcpy(def.restPoint, (float[]){ size * u, size * v }, sizeof def.restPoint);
    memcpy(def.target, (float[]){ size * x, size * y, size * z }, sizeof def.target);
    memcpy(scene->targets[scene->pinCount], def.target, sizeof def.target);
    return kiriCreatePin(scene->world, scene->sheet, &def, &scene->pins[scene->pinCount++]) == KIRI_OK;
}

static void GetStart(const Scene* scene, const kiriSheetDef* def, float u, float v, float x[3])
{
    for (int i = 0; i < 3; i++) {
        x[i] = def->position[i] / scene->type->size + u * def->axisU[i] + v * def->axisV[i];
    }
}

bool Scene_PinHere(Scene* scene, const kiriSheetDef* def, float u, float v)
{
    float x[3];
    GetStart(scene, def, u, v, x);
    return Scene_PinAt(scene, u, v, x[0], x[1], x[2]);
}

void Scene_MovePin(Scene* scene, int32_t pin, int axis, float to)
{
    scene->targets[pin][axis] = scene->type->size * to;
    kiriPin_SetTarget(scene->world, scene->pins[pin], scene->targets[pin]);
}

void Scene_ShowThread(Scene* scene, const kiriSheetDef* def, float u, float v)
{
    float* x = scene->targets[scene->pinCount++];
    GetStart(scene, def, u, v, x);
    ScaleToSize(scene, x, 3);
}

/* ---- Blades ----------------------------------------------------------------------------------------------------- */

Outline* Scene_AddStroke(Scene* scene)
{
    return &scene->strokes[scene->strokeCount++].way;
}

bool Scene_AddLine(Scene* scene, float u, float v, float toU, float toV)
{
    const float step = 0.02f;
    float length = sqrtf((toU - u) * (toU - u) + (toV - v) * (toV - v));
    int32_t steps = 1 + (int32_t)(length / step);
    Outline* way = Scene_AddStroke(scene);
    bool fine = true;
    for (int32_t i = 0; fine && i <= steps; i++) {
        float share = (float)i / (float)steps;
        fine = Outline_Add(way, u + share * (toU - u), v + share * (toV - v));
    }
    return fine;
}

bool Scene_AddFigure(Scene* scene, const SceneOptions* options, const Figure* figure)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.csv", options->dataFolder, figure->name);
    Outline outline;
    if (!Outline_Read(path, &outline)) {
        return false;
    }
    Outline* way = Scene_AddStroke(scene);
    bool fine = true;
    for (int32_t i = 0; fine && i <= outline.count; i++) {
        const float* point = outline.points + 2 * (i % outline.count);
        fine = Outline_Add(way, figure->u + figure->size * point[0], figure->v + figure->size * point[1]);
    }
    Outline_Free(&outline);
    return fine;
}

int32_t Scene_GetEnclosedFrames(const Scene* scene, const Stroke* stroke, kiriFrame* frames, int32_t capacity)
{
    kiriFrame all[256];
    int32_t count = 0, enclosed = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, all, 256, &count);
    for (int32_t i = 0; i < count && i < 256 && enclosed < capacity; i++) {
        kiriFrameState state;
        if (kiriFrame_GetState(scene->world, all[i], &state) == KIRI_OK &&
            Outline_Holds(stroke->way.points, stroke->way.count - 1, state.restPoint)) {
            frames[enclosed++] = all[i];
        }
    }
    return enclosed;
}

/* ---- Floor ------------------------------------------------------------------------------------------------------ */

bool Scene_AddFloor(Scene* scene)
{
    kiriObstacleDef def;
    kiriDefaultObstacleDef(&def);
    def.type = KIRI_OBSTACLE_PLANE;
    def.friction = 0.72f; /* 0.6 with that of the sheet */
    return kiriCreateObstacle(scene->world, &def, &scene->floor) == KIRI_OK;
}

/* ---- Bodies ----------------------------------------------------------------------------------------------------- */

bool Scene_AddCapsule(Scene* scene, const float from[3], const float to[3], float radius, uint32_t groups)
{
    const float size = scene->type->size;
    kiriObstacleDef* def = &scene->bodies[scene->bodyCount];
    float way[3], length = 0.0f;
    kiriDefaultObstacleDef(def);
    for (int i = 0; i < 3; i++) {
        def->position[i] = 0.5f * size * (from[i] + to[i]);
        way[i] = to[i] - from[i];
        length += way[i] * way[i];
    }
    length = sqrtf(length);
    def->type = length > 0.0f ? KIRI_OBSTACLE_CAPSULE : KIRI_OBSTACLE_SPHERE;
    def->radius = size * radius;
    def->groups = groups;
    def->height = size * length;
    if (length > 0.0f) { /* axis w; u is across it and y, or x where w is along y */
        const float w[3] = { way[0] / length, way[1] / length, way[2] / length };
        float across = sqrtf(w[0] * w[0] + w[2] * w[2]);
        const float u[3] = { across > 0.0f ? w[2] / across : 1.0f, 0.0f, across > 0.0f ? -w[0] / across : 0.0f };
        for (int i = 0; i < 3; i++) {
            int j = (i + 1) % 3, k = (i + 2) % 3;
            def->rotation[i] = u[i];
            def->rotation[3 + i] = w[j] * u[k] - w[k] * u[j];
            def->rotation[6 + i] = w[i];
        }
    }
    return kiriCreateObstacle(scene->world, def, &scene->bodyIds[scene->bodyCount++]) == KIRI_OK;
}

/* ---- Time ------------------------------------------------------------------------------------------------------- */

float Scene_Ease(int32_t tick, int32_t first, int32_t last)
{
    float x = tick <= first ? 0.0f : tick >= last ? 1.0f : (float)(tick - first) / (float)(last - first);
    return x * x * (3.0f - 2.0f * x);
}

int32_t Scene_Slow(int32_t ticks, float pace)
{
    return (int32_t)((double)ticks / (double)pace + 0.5);
}
