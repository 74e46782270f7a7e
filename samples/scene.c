#include "scene.h"

#include "outline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- What scenes are made of ------------------------------------------------------------------------------------ */

static const float floorGap = 0.004f; /* m: a sheet lies so high above the floor z = 0 */

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
    float* target = scene->targets[scene->pinCount];
    memcpy(target, (float[]){ x, y, z }, 3 * sizeof(float));
    memcpy(def.target, target, 3 * sizeof(float));
    return kiriCreatePin(scene->world, scene->sheet, &def, &scene->pins[scene->pinCount++]) == KIRI_OK;
}

/* Pins a rest point where it is when the sheet starts. */
static bool PinHere(Scene* scene, const kiriSheetDef* def, float u, float v)
{
    float x[3];
    for (int i = 0; i < 3; i++) {
        x[i] = def->position[i] + u * def->axisU[i] + v * def->axisV[i];
    }
    return PinAt(scene, u, v, x[0], x[1], x[2]);
}

static void MovePin(Scene* scene, int32_t pin, const float target[3])
{
    memcpy(scene->targets[pin], target, 3 * sizeof(float));
    kiriPin_SetTarget(scene->world, scene->pins[pin], target);
}

/* 0 to 1 from one tick to another, without a jerk. */
static float Ease(int32_t tick, int32_t first, int32_t last)
{
    float x = tick <= first ? 0.0f : tick >= last ? 1.0f : (float)(tick - first) / (float)(last - first);
    return x * x * (3.0f - 2.0f * x);
}

static Outline* AddStroke(Scene* scene)
{
    return &scene->strokes[scene->strokeCount++].way;
}

/* All blades at once, or one after the other, each as fast as the others. */
static void DivideTime(Scene* scene)
{
    const SceneType* type = scene->type;
    double all = 0.0, done = 0.0;
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        all += Outline_GetLength(&scene->strokes[i].way);
    }
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        Stroke* stroke = &scene->strokes[i];
        double before = type->together ? 0.0 : done / all;
        done += Outline_GetLength(&stroke->way);
        double after = type->together ? 1.0 : done / all;
        stroke->firstTick = type->firstCut + (int32_t)((type->lastCut - type->firstCut) * before + 0.5);
        stroke->lastTick = type->firstCut + (int32_t)((type->lastCut - type->firstCut) * after + 0.5);
    }
}

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
                .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = floorGap, .friction = 0.6f, .stiffness = 40.0f
            };
        }
    }
    kiriSheet_SetContacts(scene->world, scene->sheet, contacts, count);
}

/* ---- Figures cut out of a hanging cloth -------------------------------------------------------------------------- */

typedef struct Figure {
    const char* name; /* of its outline */
    float size, u, v;
} Figure;

static bool AddFigure(Scene* scene, const SceneOptions* options, const Figure* figure)
{
    char path[1024];
    snprintf(path, sizeof path, "%s/%s.csv", options->dataFolder, figure->name);
    Outline outline;
    if (!Outline_Read(path, &outline)) {
        return false;
    }
    Outline* way = AddStroke(scene);
    bool fine = true;
    for (int32_t i = 0; fine && i <= outline.count; i++) {
        const float* point = outline.points + 2 * (i % outline.count);
        fine = Outline_Add(way, figure->u + figure->size * point[0], figure->v + figure->size * point[1]);
    }
    Outline_Free(&outline);
    return fine;
}

/* A push against a figure when it comes off, harder the higher above `foot`, so that it topples out of the hole. */
static void PushFigure(Scene* scene, const Stroke* stroke, float foot)
{
    if (scene->tick <= stroke->lastTick || scene->tick > stroke->lastTick + 12) {
        return;
    }
    kiriFrame frames[256];
    int32_t count = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, 256, &count);
    for (int32_t i = 0; i < count && i < 256; i++) {
        kiriFrameState state;
        if (kiriFrame_GetState(scene->world, frames[i], &state) == KIRI_OK &&
            Outline_Holds(stroke->way.points, stroke->way.count - 1, state.restPoint)) {
            float force[3] = { 0.0f, -state.mass * (1.6f + 8.0f * (state.restPoint[1] - foot)), 0.0f };
            float torque[3] = { 0.0f, 0.0f, 0.0f };
            kiriFrame_ApplyForce(scene->world, frames[i], force, torque);
        }
    }
}

static kiriSheetDef HangingCloth(float width, float height, float bottom)
{
    (void)height;
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.position[0] = -0.5f * width;
    def.position[2] = bottom;
    memcpy(def.axisU, (float[]){ 1.0f, 0.0f, 0.0f }, sizeof def.axisU);
    memcpy(def.axisV, (float[]){ 0.0f, 0.0f, 1.0f }, sizeof def.axisV);
    def.material = Felt();
    def.gridResolution = 50;
    def.collisionPoints = 200;
    return def;
}

static bool StartBunny(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = HangingCloth(1.0f, 1.0f, 0.4f);
    def.frameCount = 9;
    def.rigidArea = 0.022f;
    const Figure figure = { "bunny", 0.55f, 0.5f, 0.5f };
    return MakeRectangle(scene, &def, options, 1.0f, 1.0f, 64, 64) && PinAt(scene, 0.0f, 1.0f, -0.49f, 0.0f, 1.4f) &&
           PinAt(scene, 1.0f, 1.0f, 0.49f, 0.0f, 1.4f) && AddFigure(scene, options, &figure);
}

static void PushBunny(Scene* scene)
{
    TouchFloor(scene);
    PushFigure(scene, &scene->strokes[0], 0.45f);
}

static const Figure patches[] = {
    { "bunny", 0.38f, 0.27f, 0.74f },
    { "teapot", 0.42f, 0.74f, 0.73f },
    { "dragon", 0.42f, 0.26f, 0.26f },
    { "armadillo", 0.42f, 0.74f, 0.26f },
};

enum { PATCHES = sizeof patches / sizeof patches[0] };

static bool StartPatchwork(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = HangingCloth(1.0f, 1.0f, 0.45f);
    const float frames[] = { 0.06f, 0.92f, 0.94f, 0.92f, 0.5f, 0.5f, 0.06f, 0.06f, 0.94f, 0.06f };
    def.frameCount = 5;
    def.framePoints = options->frameCount > 0 ? NULL : frames;
    def.maxFrames = 12;
    def.rigidArea = 0.02f;
    if (!MakeRectangle(scene, &def, options, 1.0f, 1.0f, 64, 64)) {
        return false;
    }
    bool fine = true;
    for (int32_t i = 0; fine && i < 3; i++) {
        fine = PinHere(scene, &def, 0.5f * (float)i, 1.0f);
    }
    for (int32_t i = 0; fine && i < PATCHES; i++) {
        fine = AddFigure(scene, options, &patches[i]);
    }
    return fine;
}

static void PushPatches(Scene* scene)
{
    TouchFloor(scene);
    for (int32_t i = 0; i < PATCHES; i++) {
        PushFigure(scene, &scene->strokes[i], patches[i].v - 0.05f);
    }
}

/* ---- Paper ------------------------------------------------------------------------------------------------------- */

static kiriSheetDef LevelPaper(float width, float height, float z)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.position[0] = -0.5f * width;
    def.position[1] = -0.5f * height;
    def.position[2] = z;
    memcpy(def.axisU, (float[]){ 1.0f, 0.0f, 0.0f }, sizeof def.axisU);
    memcpy(def.axisV, (float[]){ 0.0f, 1.0f, 0.0f }, sizeof def.axisV);
    def.material = Paper();
    return def;
}

/* In the corners and half-way between them. */
static bool PinBorder(Scene* scene, const kiriSheetDef* def, float width, float height)
{
    bool fine = true;
    for (int32_t i = 0; fine && i < 9; i++) {
        fine = i == 4 || PinHere(scene, def, 0.5f * width * (float)(i % 3), 0.5f * height * (float)(i / 3));
    }
    return fine;
}

/* Lifts the first pin, which holds the middle of a sheet that lies on the floor. */
static void LiftMiddle(Scene* scene, float height, int32_t first, int32_t last)
{
    MovePin(scene, 0, (float[]){ 0.0f, 0.0f, floorGap + height * Ease(scene->tick, first, last) });
}

/* ---- Spiral: unwinds as its middle is lifted ---------------------------------------------------------------------- */

static bool StartSpiral(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(1.0f, 1.0f, floorGap);
    const float frames[] = { 0.5f, 0.5f, 0.5f, 0.68f, 0.25f, 0.5f, 0.5f, 0.18f, 0.94f, 0.94f };
    def.gridResolution = 40;
    def.frameCount = def.maxFrames = 5;
    def.framePoints = options->frameCount > 0 ? NULL : frames;
    def.collisionPoints = 200;
    const Spiral spiral = { { 0.5, 0.5 }, 0.07, 0.46, 0.0, 5.0, 0.0115 };
    return MakeRectangle(scene, &def, options, 1.0f, 1.0f, 8, 8) && PinHere(scene, &def, 0.5f, 0.5f) &&
           PinBorder(scene, &def, 1.0f, 1.0f) && Outline_AddSpiral(AddStroke(scene), &spiral);
}

static void LiftSpiral(Scene* scene)
{
    TouchFloor(scene);
    LiftMiddle(scene, 0.9f, scene->type->firstCut + 60, scene->type->lastCut + 60);
}

/* ---- Vortex: two spirals meet in the middle, and two arms hang down ---------------------------------------------- */

static bool StartVortex(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(1.0f, 1.0f, 0.8f);
    const float frames[] = { 0.5f, 0.62f, 0.5f, 0.38f, 0.72f, 0.5f, 0.28f, 0.5f, 0.93f, 0.93f };
    def.gridResolution = 68;
    def.frameCount = def.maxFrames = 5;
    def.framePoints = options->frameCount > 0 ? NULL : frames;
    def.collisionPoints = 200;
    const Spiral first = { { 0.5, 0.5 }, 0.0, 0.34, 0.0, 1.1, 0.014 };
    const Spiral second = { { 0.5, 0.5 }, 0.0, 0.34, 0.5, 1.1, 0.014 };
    return MakeRectangle(scene, &def, options, 1.0f, 1.0f, 64, 64) && PinBorder(scene, &def, 1.0f, 1.0f) &&
           Outline_AddSpiral(AddStroke(scene), &first) && Outline_AddSpiral(AddStroke(scene), &second);
}

/* ---- Kirigami: 8 rings of 6 slits, and the middle is pulled up ---------------------------------------------------- */

enum { RINGS = 8, SLITS = 6, PULL_TICKS = 180 };

static double RadiusOf(int32_t ring)
{
    return 0.06 + 0.05 * ring;
}

/* Rings are turned by half a slit from one to the next, so that a bridge leads to the middle of a slit. */
static double BridgeTurn(int32_t ring, int32_t bridge)
{
    return (bridge + 0.5 * (ring % 2)) / SLITS;
}

static bool AddSlit(Scene* scene, int32_t ring, int32_t slit)
{
    const double bridge = 0.035; /* m */
    double radius = RadiusOf(ring), gap = bridge / (6.283185307 * radius);
    const Spiral arc = { { 0.5, 0.5 }, radius, radius, BridgeTurn(ring, slit) + 0.5 * gap, 1.0 / SLITS - gap, 0.02 };
    return Outline_AddSpiral(AddStroke(scene), &arc);
}

/* In the middle, at every bridge but the innermost, and in the corners. */
static bool PlaceFrames(Outline* frames)
{
    bool fine = Outline_Add(frames, 0.5f, 0.5f);
    for (int32_t ring = 1; fine && ring < RINGS; ring++) {
        for (int32_t bridge = 0; fine && bridge < SLITS; bridge++) {
            double turn = BridgeTurn(ring, bridge), radius = RadiusOf(ring);
            const Spiral point = { { 0.5, 0.5 }, radius, radius, turn, 0.0, 1.0 };
            fine = Outline_AddSpiral(frames, &point);
            frames->count--; /* both of its ends */
        }
    }
    for (int32_t i = 0; fine && i < 4; i++) {
        fine = Outline_Add(frames, 0.04f + 0.92f * (float)(i & 1), 0.04f + 0.92f * (float)(i >> 1));
    }
    return fine;
}

static bool StartKirigami(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(1.0f, 1.0f, floorGap);
    Outline frames = { .points = NULL };
    def.gridResolution = 68;
    def.collisionPoints = 600;
    bool fine = PlaceFrames(&frames);
    def.frameCount = def.maxFrames = frames.count;
    def.framePoints = options->frameCount > 0 ? NULL : frames.points;
    fine = fine && MakeRectangle(scene, &def, options, 1.0f, 1.0f, 64, 64) && PinHere(scene, &def, 0.5f, 0.5f) &&
           PinBorder(scene, &def, 1.0f, 1.0f);
    Outline_Free(&frames);
    for (int32_t i = 0; fine && i < RINGS * SLITS; i++) {
        fine = AddSlit(scene, i / SLITS, i % SLITS);
    }
    return fine;
}

static void PullKirigami(Scene* scene)
{
    TouchFloor(scene);
    LiftMiddle(scene, 0.45f, scene->type->lastCut + 20, scene->type->lastCut + 20 + PULL_TICKS);
}

/* ---- Falling guy: swings down, and hangs on by a finger ------------------------------------------------------------ */

static bool StartFallingGuy(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(2.0f, 1.0f, 1.75f);
    memcpy(def.axisV, (float[]){ 0.0f, 0.8f, 0.6f }, sizeof def.axisV);
    /* Left and right, below and above; forearm, head, chest, elbow, both legs. */
    const float frames[] = { 0.07f, 0.5f,  1.93f, 0.5f,  1.0f,  0.04f, 1.0f,  0.96f, 0.51f, 0.84f,
                             0.56f, 0.61f, 0.83f, 0.62f, 0.86f, 0.30f, 1.48f, 0.73f, 1.48f, 0.44f };
    def.gridResolution = 100;
    def.frameCount = def.maxFrames = 10;
    def.framePoints = options->frameCount > 0 ? NULL : frames;
    def.collisionPoints = 500;
    const Figure guy = { "fallingguy", 1.6f, 1.0f, 0.5f };
    bool fine = MakeRectangle(scene, &def, options, 2.0f, 1.0f, 16, 16) && PinBorder(scene, &def, 2.0f, 1.0f) &&
                AddFigure(scene, options, &guy);
    if (fine) {
        scene->strokes[0].way.count--; /* from one side of the finger to the other: not closed */
    }
    return fine;
}

/* ---- All of them ------------------------------------------------------------------------------------------------ */

#define PAPER_LOOK(red, green, blue)                                                                                   \
    {                                                                                                                  \
        { 0.82f, 0.80f, 0.76f }, { red, green, blue }, { 0.45f, 0.42f, 0.40f }, 0.0f                                   \
    }

static const SceneType types[] = {
    { .name = "bunny",
      .about = "a bunny is cut out of a hanging cloth and falls",
      .ticks = 210,
      .substeps = 2,
      .firstCut = 18,
      .lastCut = 138,
      .moments = { 17, 60, 100, 138, 149, 157, 167, 210 },
      .camera = { { 0.95f, -2.75f, 1.2f }, { 0.04f, -0.1f, 0.6f }, 34.0f },
      .look = { { 0.38f, 0.64f, 0.90f }, { 0.96f, 0.80f, 0.55f }, { 0.93f, 0.30f, 0.12f }, 10.0f },
      .start = StartBunny,
      .push = PushBunny },
    { .name = "spiral",
      .about = "a long spiral is cut into a sheet of paper, from its middle, and unwinds",
      .ticks = 540,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 360,
      .moments = { 60, 120, 180, 240, 300, 360, 420, 540 },
      .camera = { { 1.1f, -2.5f, 1.55f }, { 0.0f, 0.0f, 0.45f }, 30.0f },
      .look = PAPER_LOOK(0.85f, 0.25f, 0.20f),
      .start = StartSpiral,
      .push = LiftSpiral },
    { .name = "kirigami",
      .about = "48 slits let a sheet of paper rise when its middle is pulled up",
      .ticks = 800,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 540,
      .moments = { 60, 200, 400, 540, 600, 650, 710, 800 },
      .camera = { { 1.0f, -2.2f, 1.5f }, { 0.0f, 0.0f, 0.2f }, 30.0f },
      .look = PAPER_LOOK(0.20f, 0.55f, 0.50f),
      .start = StartKirigami,
      .push = PullKirigami },
    { .name = "patchwork",
      .about = "a bunny, a teapot, a dragon and an armadillo are cut out of a cloth, and fall",
      .ticks = 600,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 480,
      .moments = { 60, 165, 200, 290, 400, 480, 500, 600 },
      .camera = { { 0.95f, -2.75f, 1.2f }, { 0.04f, -0.1f, 0.65f }, 34.0f },
      .look = { { 0.80f, 0.28f, 0.25f }, { 0.95f, 0.85f, 0.60f }, { 0.98f, 0.95f, 0.88f }, 10.0f },
      .start = StartPatchwork,
      .push = PushPatches },
    { .name = "vortex",
      .together = true,
      .about = "two spirals that meet let two arms of a sheet of paper hang down",
      .ticks = 420,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 260,
      .moments = { 60, 110, 160, 210, 235, 260, 320, 420 },
      .camera = { { 1.1f, -2.5f, 1.55f }, { 0.0f, 0.0f, 0.45f }, 30.0f },
      .look = PAPER_LOOK(0.20f, 0.35f, 0.70f),
      .start = StartVortex,
      .push = TouchFloor },
    { .name = "fallingguy",
      .about = "a man is cut out of a sheet of paper, swings down and hangs on by a finger",
      .ticks = 600,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 300,
      .moments = { 60, 140, 220, 290, 310, 330, 360, 600 },
      .camera = { { 1.2f, -4.8f, 2.4f }, { 0.0f, 0.0f, 0.95f }, 33.0f },
      .look = PAPER_LOOK(0.90f, 0.60f, 0.15f),
      .start = StartFallingGuy,
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
    bool fine = type->start(scene, &filled);
    DivideTime(scene);
    if (!fine) {
        fprintf(stderr, "scene %s does not start: %s\n", type->name, kiriWorld_GetLastError(scene->world));
        Scene_Stop(scene);
        return false;
    }
    return true;
}

/* Gives the library the points up to this tick. */
static kiriResult MoveBlade(Scene* scene, Stroke* stroke)
{
    const Outline* way = &stroke->way;
    if (scene->tick < stroke->firstTick || stroke->taken == way->count) {
        return KIRI_OK;
    }
    kiriResult result = KIRI_OK;
    if (stroke->taken == 0) {
        result = kiriBeginCut(scene->world, scene->sheet, way->points, &stroke->cut);
        stroke->taken = 1;
    }
    int32_t ticks = stroke->lastTick - stroke->firstTick, done = scene->tick - stroke->firstTick;
    int32_t until = done < ticks ? 1 + (way->count - 1) * done / ticks : way->count;
    if (result == KIRI_OK && until > stroke->taken) {
        result = kiriCut_Extend(scene->world, stroke->cut, way->points + 2 * stroke->taken, until - stroke->taken);
        stroke->taken = until;
    }
    if (result == KIRI_OK && stroke->taken == way->count) {
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

int32_t Scene_GetBlades(const Scene* scene, float (*restPoints)[2], int32_t capacity)
{
    int32_t count = 0;
    for (int32_t i = 0; i < scene->strokeCount && count < capacity; i++) {
        const Stroke* stroke = &scene->strokes[i];
        if (stroke->taken > 0 && scene->tick <= stroke->lastTick + 1) {
            memcpy(restPoints[count++], stroke->way.points + 2 * (stroke->taken - 1), 2 * sizeof(float));
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
