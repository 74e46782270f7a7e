#include "scene.h"

#include "outline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- What scenes are made of ------------------------------------------------------------------------------------ */

static kiriMaterial Felt(void)
{
    return (kiriMaterial){ .youngsModulus = 1e7f,
                           .poissonsRatio = 0.3f,
                           .thickness = 0.0015f,
                           .density = 200.0f,
                           .airDamping = 0.8f,
                           .flexDamping = 0.03f };
}

static kiriMaterial Paper(void)
{
    return (kiriMaterial){ .youngsModulus = 2e9f,
                           .poissonsRatio = 0.3f,
                           .thickness = 0.0001f,
                           .density = 800.0f,
                           .airDamping = 1.0f,
                           .flexDamping = 0.005f };
}

/* Fills the def's mesh with a rectangle and makes the sheet. */
static bool MakeRectangle(Scene* scene, kiriSheetDef* def, const SceneOptions* options, float width, float height,
                          int32_t columns, int32_t rows)
{
    def->vertexCount = (columns + 1) * (rows + 1);
    def->triangleCount = 2 * columns * rows;
    float* positions = malloc(2 * sizeof(float) * (size_t)def->vertexCount);
    int32_t* indices = malloc(3 * sizeof(int32_t) * (size_t)def->triangleCount);
    kiriResult result = KIRI_ERROR_MEMORY;
    if (positions != NULL && indices != NULL) {
        kiriFillRectangle(width, height, columns, rows, positions, indices);
        def->restPositions = positions;
        def->indices = indices;
        def->gridResolution = options->gridResolution > 0 ? options->gridResolution : def->gridResolution;
        def->frameCount = options->frameCount > 0 ? options->frameCount : def->frameCount;
        result = kiriCreateSheet(scene->world, def, &scene->sheet);
    }
    free(positions);
    free(indices);
    return result == KIRI_OK;
}

static bool PinAt(Scene* scene, float u, float v, float x, float y, float z)
{
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    def.restPoint[0] = u;
    def.restPoint[1] = v;
    def.target[0] = x;
    def.target[1] = y;
    def.target[2] = z;
    kiriPin pin;
    return kiriCreatePin(scene->world, scene->sheet, &def, &pin) == KIRI_OK;
}

static void AddStroke(Scene* scene, const float* points, int32_t count, int32_t firstTick, int32_t lastTick)
{
    scene->strokes[scene->strokeCount++] =
        (Stroke){ .points = points, .count = count, .firstTick = firstTick, .lastTick = lastTick };
}

/* The floor is the plane z = 0. */
static void TouchFloor(Scene* scene)
{
    enum { MAX_CONTACTS = 1024 };
    kiriContact contacts[MAX_CONTACTS];
    const float* points;
    int32_t pointCount, count = 0;
    if (kiriSheet_GetCollisionPoints(scene->world, scene->sheet, &points, &pointCount) != KIRI_OK) {
        return;
    }
    for (int32_t i = 0; i < pointCount && count < MAX_CONTACTS; i++) {
        if (points[3 * i + 2] < 0.01f) {
            contacts[count++] = (kiriContact){
                .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.004f, .friction = 0.6f, .stiffness = 40.0f
            };
        }
    }
    kiriSheet_SetContacts(scene->world, scene->sheet, contacts, count);
}

/* ---- Bunny: cut out of a hanging cloth -------------------------------------------------------------------------- */

static const float bunnySize = 0.55f;

static bool StartBunny(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.position[0] = -0.5f;
    def.position[2] = 0.4f;
    memcpy(def.axisU, (float[]){ 1.0f, 0.0f, 0.0f }, sizeof def.axisU);
    memcpy(def.axisV, (float[]){ 0.0f, 0.0f, 1.0f }, sizeof def.axisV);
    def.material = Felt();
    def.gridResolution = 50;
    def.frameCount = 9;
    def.rigidArea = 0.022f;
    def.collisionPoints = 200;
    if (!MakeRectangle(scene, &def, options, 1.0f, 1.0f, 64, 64) || !PinAt(scene, 0.0f, 1.0f, -0.49f, 0.0f, 1.4f) ||
        !PinAt(scene, 1.0f, 1.0f, 0.49f, 0.0f, 1.4f)) {
        return false;
    }

    char path[1024];
    snprintf(path, sizeof path, "%s/bunny.csv", options->dataFolder);
    Outline outline;
    if (!Outline_Read(path, &outline)) {
        return false;
    }
    scene->points = malloc(2 * sizeof(float) * (size_t)(outline.count + 1));
    if (scene->points != NULL) {
        for (int32_t i = 0; i <= 2 * outline.count + 1; i++) {
            scene->points[i] = 0.5f + bunnySize * outline.points[i % (2 * outline.count)];
        }
        AddStroke(scene, scene->points, outline.count + 1, 18, 138);
    }
    Outline_Free(&outline);
    return scene->points != NULL;
}

/* A push against the bunny when it comes off, harder at the ears, so that it topples out of the hole. */
static void PushBunny(Scene* scene)
{
    TouchFloor(scene);
    const Stroke* stroke = &scene->strokes[0];
    if (scene->tick <= stroke->lastTick || scene->tick > stroke->lastTick + 12) {
        return;
    }
    kiriFrame frames[256];
    int32_t count = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, 256, &count);
    for (int32_t i = 0; i < count && i < 256; i++) {
        kiriFrameState state;
        if (kiriFrame_GetState(scene->world, frames[i], &state) == KIRI_OK &&
            Outline_Holds(stroke->points, stroke->count - 1, state.restPoint)) {
            float force[3] = { 0.0f, -state.mass * (1.6f + 8.0f * (state.restPoint[1] - 0.45f)), 0.0f };
            float torque[3] = { 0.0f, 0.0f, 0.0f };
            kiriFrame_ApplyForce(scene->world, frames[i], force, torque);
        }
    }
}

/* ---- Spiral: a sheet of paper unwinds --------------------------------------------------------------------------- */

static bool StartSpiral(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.position[0] = -0.5f;
    def.position[1] = -0.5f;
    def.position[2] = 1.3f;
    memcpy(def.axisU, (float[]){ 1.0f, 0.0f, 0.0f }, sizeof def.axisU);
    memcpy(def.axisV, (float[]){ 0.0f, 1.0f, 0.0f }, sizeof def.axisV);
    def.material = Paper();
    def.gridResolution = 64;
    def.frameCount = 49;
    def.collisionPoints = 200;
    if (!MakeRectangle(scene, &def, options, 1.0f, 1.0f, 64, 64)) {
        return false;
    }
    for (int32_t i = 0; i < 4; i++) {
        float u = (float)(i & 1), v = (float)(i >> 1);
        if (!PinAt(scene, u, v, u - 0.5f, v - 0.5f, 1.3f)) {
            return false;
        }
    }

    enum { TURNS = 3, STEPS = 64 };
    const double cosine = 0.99518472667219693, sine = 0.098017140329560604; /* of a turn divided by STEPS */
    const int32_t count = TURNS * STEPS + 1;
    scene->points = malloc(2 * sizeof(float) * (size_t)count);
    if (scene->points == NULL) {
        return false;
    }
    double x = 1.0, y = 0.0;
    for (int32_t i = 0; i < count; i++) {
        double radius = 0.06 + 0.37 * i / (count - 1);
        scene->points[2 * i] = (float)(0.5 + radius * x);
        scene->points[2 * i + 1] = (float)(0.5 + radius * y);
        double turned = cosine * x - sine * y;
        y = sine * x + cosine * y;
        x = turned;
    }
    AddStroke(scene, scene->points, count, 18, 168);
    return true;
}

/* ---- All of them ------------------------------------------------------------------------------------------------ */

static const SceneType types[] = {
    { .name = "bunny",
      .about = "a bunny is cut out of a hanging cloth and falls",
      .ticks = 210,
      .substeps = 2,
      .moments = { 17, 60, 100, 138, 149, 157, 167, 210 },
      .camera = { { 0.95f, -2.75f, 1.2f }, { 0.04f, -0.1f, 0.6f }, 34.0f },
      .start = StartBunny,
      .push = PushBunny },
    { .name = "spiral",
      .about = "a spiral is cut into a sheet of paper, which unwinds under its weight",
      .ticks = 240,
      .substeps = 2,
      .moments = { 17, 60, 95, 120, 140, 160, 180, 240 },
      .camera = { { 1.1f, -2.7f, 1.95f }, { 0.1f, 0.0f, 0.6f }, 36.0f },
      .start = StartSpiral,
      .push = TouchFloor },
};

const SceneType* Scene_GetType(int32_t index)
{
    return index >= 0 && index < (int32_t)(sizeof types / sizeof types[0]) ? &types[index] : NULL;
}

const SceneType* Scene_FindType(const char* name)
{
    for (int32_t i = 0; Scene_GetType(i) != NULL; i++) {
        if (strcmp(types[i].name, name) == 0) {
            return &types[i];
        }
    }
    return NULL;
}

bool Scene_Start(Scene* scene, const SceneType* type, const kiriWorldDef* def, const SceneOptions* options)
{
    *scene = (Scene){ .type = type };
    SceneOptions filled = *options;
    filled.dataFolder = filled.dataFolder != NULL ? filled.dataFolder : "samples/data";
    kiriResult result = kiriCreateWorld(def, &scene->world);
    if (result != KIRI_OK) {
        fprintf(stderr, "no world: %s\n", kiriGetResultName(result));
        return false;
    }
    if (!type->start(scene, &filled)) {
        fprintf(stderr, "scene %s does not start: %s\n", type->name, kiriWorld_GetLastError(scene->world));
        Scene_Stop(scene);
        return false;
    }
    return true;
}

/* Gives the library the points up to this tick. */
static kiriResult MoveBlade(Scene* scene, Stroke* stroke)
{
    if (scene->tick < stroke->firstTick || stroke->taken == stroke->count) {
        return KIRI_OK;
    }
    kiriResult result = KIRI_OK;
    if (stroke->taken == 0) {
        result = kiriBeginCut(scene->world, scene->sheet, stroke->points, &stroke->cut);
        stroke->taken = 1;
    }
    int32_t ticks = stroke->lastTick - stroke->firstTick, done = scene->tick - stroke->firstTick;
    int32_t until = done < ticks ? 1 + (stroke->count - 1) * done / ticks : stroke->count;
    if (result == KIRI_OK && until > stroke->taken) {
        result = kiriCut_Extend(scene->world, stroke->cut, stroke->points + 2 * stroke->taken, until - stroke->taken);
        stroke->taken = until;
    }
    if (result == KIRI_OK && stroke->taken == stroke->count) {
        result = kiriCut_End(scene->world, stroke->cut);
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
    if (scene->type->push != NULL) {
        scene->type->push(scene);
    }
    scene->tick++;
    return kiriWorld_Tick(scene->world, 1.0f / 60.0f, scene->type->substeps);
}

bool Scene_GetBlade(const Scene* scene, float restPoint[2])
{
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        const Stroke* stroke = &scene->strokes[i];
        if (stroke->taken > 0 && scene->tick <= stroke->lastTick + 1) {
            memcpy(restPoint, stroke->points + 2 * (stroke->taken - 1), 2 * sizeof(float));
            return true;
        }
    }
    return false;
}

void Scene_Stop(Scene* scene)
{
    kiriDestroyWorld(scene->world);
    free(scene->points);
    *scene = (Scene){ .type = NULL };
}
