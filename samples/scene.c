#include "scene.h"

#include "outline.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* ---- What scenes are made of ------------------------------------------------------------------------------------ */

static const float floorGap = 0.004f; /* a sheet lies so high above the floor z = 0, in its sizes */

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
    kiriMaterial paper;
    kiriGetMaterial(KIRI_MATERIAL_PAPER, &paper);
    return paper;
}

/* Lengths below are in sizes of the scene's sheet. `corner` is where the rest point (0, 0) starts; axis u is x. */
static kiriSheetDef PlaceSheet(const Scene* scene, const float corner[3], const float axisV[3], kiriMaterial material)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    for (int i = 0; i < 3; i++) {
        def.position[i] = scene->type->size * corner[i];
        def.axisU[i] = i == 0 ? 1.0f : 0.0f;
        def.axisV[i] = axisV[i];
    }
    def.material = material;
    return def;
}

static void Scale(float* numbers, int32_t count, float factor)
{
    for (int32_t i = 0; i < count; i++) {
        numbers[i] *= factor;
    }
}

typedef struct Rectangle {
    float width, height;
    int32_t columns, rows;
    const float* frames; /* 2 a frame; null: they spread evenly */
} Rectangle;

/* Fills the def's mesh with a rectangle and makes the sheet. */
static bool MakeRectangle(Scene* scene, kiriSheetDef* def, const SceneOptions* options, const Rectangle* rectangle)
{
    const float size = scene->type->size;
    int32_t columns = rectangle->columns, rows = rectangle->rows;
    def->vertexCount = (columns + 1) * (rows + 1);
    def->triangleCount = 2 * columns * rows;
    def->gridResolution = options->gridResolution > 0 ? options->gridResolution : def->gridResolution;
    kiriPaperDef paper;
    kiriDefaultPaperDef(&paper);
    paper.fromScratch = options->fromScratch;
    def->paper = options->fromScratch ? &paper : NULL;
    size_t frameNumbers = 2 * (size_t)def->frameCount;
    float* positions = malloc(2 * sizeof(float) * (size_t)def->vertexCount);
    int32_t* indices = malloc(3 * sizeof(int32_t) * (size_t)def->triangleCount);
    float* frames = malloc(frameNumbers * sizeof(float));
    kiriResult result = KIRI_ERROR_MEMORY;
    if (positions != NULL && indices != NULL && frames != NULL) {
        kiriFillRectangle(size * rectangle->width, size * rectangle->height, columns, rows, positions, indices);
        def->restPositions = positions;
        def->indices = indices;
        if (options->frameCount > 0) {
            def->frameCount = options->frameCount;
        } else if (rectangle->frames != NULL) {
            memcpy(frames, rectangle->frames, frameNumbers * sizeof(float));
            Scale(frames, (int32_t)frameNumbers, size);
            def->framePoints = frames;
        }
        scene->gridResolution = def->gridResolution;
        result = kiriCreateSheet(scene->world, def, &scene->sheet);
    }
    free(positions);
    free(indices);
    free(frames);
    return result == KIRI_OK;
}

static bool PinAt(Scene* scene, float u, float v, float x, float y, float z)
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

/* Pins a rest point where it is when the sheet starts. */
static bool PinHere(Scene* scene, const kiriSheetDef* def, float u, float v)
{
    float x[3];
    GetStart(scene, def, u, v, x);
    return PinAt(scene, u, v, x[0], x[1], x[2]);
}

/* A thread for the eye alone, where a frame is held. */
static void ShowThread(Scene* scene, const kiriSheetDef* def, float u, float v)
{
    float* x = scene->targets[scene->pinCount++];
    GetStart(scene, def, u, v, x);
    Scale(x, 3, scene->type->size);
}

static void RaisePin(Scene* scene, int32_t pin, float z)
{
    scene->targets[pin][2] = scene->type->size * z;
    kiriPin_SetTarget(scene->world, scene->pins[pin], scene->targets[pin]);
}

/* 0 to 1 from one tick to another, without a jerk. */
static float Ease(int32_t tick, int32_t first, int32_t last)
{
    float x = tick <= first ? 0.0f : tick >= last ? 1.0f : (float)(tick - first) / (float)(last - first);
    return x * x * (3.0f - 2.0f * x);
}

/* As many ticks at another pace. */
static int32_t Slow(int32_t ticks, float pace)
{
    return (int32_t)((double)ticks / (double)pace + 0.5);
}

static Outline* AddStroke(Scene* scene)
{
    return &scene->strokes[scene->strokeCount++].way;
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
        Scale(stroke->way.points, 2 * stroke->way.count, type->size);
        double before = type->together ? 0.0 : done / all;
        done += Outline_GetLength(&stroke->way) / type->size;
        double after = type->together ? 1.0 : done / all;
        stroke->firstTick = type->firstCut + (int32_t)((type->lastCut - type->firstCut) * before + 0.5);
        stroke->lastTick = type->firstCut + (int32_t)((type->lastCut - type->firstCut) * after + 0.5);
    }
}

static void TouchFloor(Scene* scene)
{
    const float gap = scene->type->size * floorGap;
    enum { MAX_CONTACTS = 1024 };
    kiriContact contacts[MAX_CONTACTS];
    const float* points;
    int32_t pointCount, count = 0;
    if (kiriSheet_GetCollisionPoints(scene->world, scene->sheet, &points, &pointCount) != KIRI_OK) {
        return;
    }
    for (int32_t i = 0; i < pointCount && count < MAX_CONTACTS; i++) {
        if (points[3 * i + 2] < 2.5f * gap) {
            contacts[count++] = (kiriContact){
                .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = gap, .friction = 0.6f, .stiffness = 40.0f
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

/* A push against a figure when it comes off, harder the higher above `foot`, so that it topples out of the hole. As
   short at any pace of the blade: the figure falls as fast. */
static void PushFigure(Scene* scene, const Stroke* stroke, float foot, float strength)
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
            float force[3] = { 0.0f, -strength * state.mass * (1.6f + 8.0f * (state.restPoint[1] - foot)), 0.0f };
            float torque[3] = { 0.0f, 0.0f, 0.0f };
            kiriFrame_ApplyForce(scene->world, frames[i], force, torque);
        }
    }
}

static bool StartBunny(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = PlaceSheet(scene, (float[]){ -0.5f, 0.0f, 0.4f }, (float[]){ 0.0f, 0.0f, 1.0f }, Felt());
    def.gridResolution = 50;
    def.collisionPoints = 200;
    def.frameCount = 9;
    def.rigidArea = 0.022f;
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, NULL };
    const Figure figure = { "bunny", 0.55f, 0.5f, 0.5f };
    return MakeRectangle(scene, &def, options, &rectangle) && PinAt(scene, 0.0f, 1.0f, -0.49f, 0.0f, 1.4f) &&
           PinAt(scene, 1.0f, 1.0f, 0.49f, 0.0f, 1.4f) && AddFigure(scene, options, &figure);
}

static void PushBunny(Scene* scene)
{
    TouchFloor(scene);
    PushFigure(scene, &scene->strokes[0], 0.45f, 1.0f);
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
    kiriSheetDef def = PlaceSheet(scene, (float[]){ -0.5f, 0.0f, 0.45f }, (float[]){ 0.0f, 0.0f, 1.0f }, Felt());
    const float frames[] = { 0.06f, 0.92f, 0.94f, 0.92f, 0.5f, 0.5f, 0.06f, 0.06f, 0.94f, 0.06f };
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, frames };
    def.gridResolution = 50;
    def.collisionPoints = 200;
    def.frameCount = 5;
    def.maxFrames = 12;
    def.rigidArea = 0.035f;
    bool fine = MakeRectangle(scene, &def, options, &rectangle);
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
        PushFigure(scene, &scene->strokes[i], patches[i].v - 0.05f, 1.5f);
    }
}

/* ---- Paper ------------------------------------------------------------------------------------------------------- */

static kiriSheetDef LevelPaper(const Scene* scene, float z)
{
    return PlaceSheet(scene, (float[]){ -0.5f, -0.5f, z }, (float[]){ 0.0f, 1.0f, 0.0f }, Paper());
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

/* Holds the last frames of the sheet where they are, as if taped to the floor. */
static bool HoldLastFrames(Scene* scene, int32_t held)
{
    kiriFrame frames[256];
    kiriFrameState state;
    int32_t count = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, 256, &count);
    bool fine = count >= held && count <= 256;
    for (int32_t i = count - held; fine && i < count; i++) {
        fine = kiriFrame_GetState(scene->world, frames[i], &state) == KIRI_OK &&
               kiriFrame_Hold(scene->world, frames[i], state.position, state.rotation) == KIRI_OK;
    }
    return fine;
}

enum { MIDDLE_PINS = 3 };

/* Three pins hold the middle level. */
static bool PinMiddle(Scene* scene, const kiriSheetDef* def)
{
    return PinHere(scene, def, 0.47f, 0.48f) && PinHere(scene, def, 0.53f, 0.48f) && PinHere(scene, def, 0.5f, 0.53f);
}

/* ---- Spiral: cut from the border of a sheet that is held in the middle ------------------------------------------- */

static bool StartSpiral(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, 1.4f);
    /* From the middle of the sheet to the end of the strip. */
    const float frames[] = { 0.5f, 0.5f, 0.35f, 0.6f, 0.72f, 0.67f, 0.72f, 0.19f, 0.1f, 0.2f };
    const Rectangle rectangle = { 1.0f, 1.0f, 8, 8, frames };
    def.gridResolution = 40;
    def.frameCount = def.maxFrames = 5;
    def.collisionPoints = 200;
    const Spiral spiral = { { 0.5, 0.5 }, 0.52, 0.08, 0.0, 5.0, 0.014 };
    return MakeRectangle(scene, &def, options, &rectangle) && PinMiddle(scene, &def) &&
           Outline_AddSpiral(AddStroke(scene), &spiral);
}

/* ---- Vortex: two spirals meet in the middle, and two arms hang down ---------------------------------------------- */

/* Pins would pull at whichever frame is nearest, and that changes as blades pass: so the frames are held. */
static bool HoldBorder(Scene* scene, const kiriSheetDef* def)
{
    ShowThread(scene, def, 0.0f, 0.0f);
    ShowThread(scene, def, 1.0f, 1.0f);
    return HoldLastFrames(scene, 3);
}

static bool StartVortex(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = LevelPaper(scene, 0.9f);
    /* One an arm, near its end, and three in the border, so that an arm always hangs from the same one. */
    const float frames[] = { 0.486f, 0.387f, 0.514f, 0.613f, 0.08f, 0.2f, 0.92f, 0.8f, 0.05f, 0.05f };
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, frames };
    def.gridResolution = 68;
    def.frameCount = def.maxFrames = 5;
    def.collisionPoints = 200;
    const Spiral first = { { 0.5, 0.5 }, 0.0, 0.38, 0.0, 1.6, 0.014 };
    const Spiral second = { { 0.5, 0.5 }, 0.0, 0.38, 0.5, 1.6, 0.014 };
    return MakeRectangle(scene, &def, options, &rectangle) && HoldBorder(scene, &def) &&
           Outline_AddSpiral(AddStroke(scene), &first) && Outline_AddSpiral(AddStroke(scene), &second);
}

/* ---- Kirigami: 8 rings of 6 slits, and the middle is pulled up --------------------------------------------------- */

enum { RINGS = 8, SLITS = 6, PULL_PAUSE = 20, PULL_TICKS = 180 };

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
    kiriSheetDef def = LevelPaper(scene, floorGap);
    Outline frames = { .points = NULL };
    bool fine = PlaceFrames(&frames);
    const Rectangle rectangle = { 1.0f, 1.0f, 64, 64, frames.points };
    def.gridResolution = 68;
    def.frameCount = def.maxFrames = frames.count;
    def.collisionPoints = 600;
    def.iterations = 1;
    fine = fine && MakeRectangle(scene, &def, options, &rectangle) && PinMiddle(scene, &def);
    Outline_Free(&frames);
    fine = fine && HoldLastFrames(scene, 4);
    for (int32_t i = 0; fine && i < RINGS * SLITS; i++) {
        fine = AddSlit(scene, i / SLITS, i % SLITS);
    }
    return fine;
}

static void PullKirigami(Scene* scene)
{
    TouchFloor(scene);
    int32_t first = scene->type->lastCut + Slow(PULL_PAUSE, scene->pace), last = first + Slow(PULL_TICKS, scene->pace);
    for (int32_t i = 0; i < MIDDLE_PINS; i++) {
        RaisePin(scene, i, floorGap + 0.32f * Ease(scene->tick, first, last));
    }
}

/* ---- Falling guy: swings down, and hangs on by a finger ---------------------------------------------------------- */

static bool StartFallingGuy(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def = PlaceSheet(scene, (float[]){ -1.0f, -0.45f, 1.75f }, (float[]){ 0.0f, 0.96f, 0.28f }, Paper());
    /* Left and right, below and above; forearm, head, chest, elbow, both legs. The finger is half-way from the first to
       the forearm, so that the regions meet where it is thin. */
    const float frames[] = { 0.06f, 0.17f, 1.93f, 0.5f,  1.0f,  0.04f, 1.0f,  0.96f, 0.42f, 0.17f,
                             0.56f, 0.39f, 0.83f, 0.38f, 0.86f, 0.70f, 1.48f, 0.27f, 1.48f, 0.56f };
    const Rectangle rectangle = { 2.0f, 1.0f, 16, 16, frames };
    const Figure guy = { "fallingguy", 1.6f, 1.0f, 0.5f };
    def.gridResolution = 100;
    def.frameCount = def.maxFrames = 10;
    def.collisionPoints = 500;
    def.iterations = 2; /* large turns at each tick while he swings */
    bool fine = MakeRectangle(scene, &def, options, &rectangle) && PinBorder(scene, &def, 2.0f, 1.0f) &&
                AddFigure(scene, options, &guy);
    if (fine) {
        scene->strokes[0].way.count--; /* from one side of the finger to the other: not closed */
    }
    return fine;
}

/* ---- All of them ------------------------------------------------------------------------------------------------ */

#define PAPER_LOOK(red, green, blue)                                                                                   \
    {                                                                                                                  \
        { 0.81f, 0.80f, 0.775f }, { red, green, blue }, { 0.45f, 0.42f, 0.40f }, 0.0f                                  \
    }

static const SceneType types[] = {
    { .name = "bunny",
      .about = "a bunny is cut out of a hanging cloth and falls",
      .size = 1.0f,
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
      .size = 0.2f,
      .ticks = 600,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 480,
      .moments = { 60, 140, 200, 280, 360, 440, 490, 600 },
      .camera = { { 1.2f, -3.2f, 1.7f }, { 0.0f, 0.0f, 0.72f }, 32.0f },
      .look = PAPER_LOOK(0.85f, 0.25f, 0.20f),
      .start = StartSpiral,
      .push = TouchFloor },
    { .name = "kirigami",
      .about = "48 slits let a sheet of paper rise when its middle is pulled up",
      .size = 0.3f,
      .ticks = 800,
      .substeps = 4,
      .firstCut = 60,
      .lastCut = 540,
      .moments = { 60, 200, 400, 540, 620, 650, 690, 800 },
      .camera = { { 1.0f, -2.2f, 1.35f }, { 0.0f, 0.0f, 0.1f }, 25.0f },
      .look = PAPER_LOOK(0.20f, 0.55f, 0.50f),
      .start = StartKirigami,
      .push = PullKirigami },
    { .name = "patchwork",
      .about = "a bunny, a teapot, a dragon and an armadillo are cut out of a cloth, and fall",
      .size = 1.0f,
      .ticks = 600,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 480,
      .moments = { 60, 165, 200, 290, 400, 480, 500, 600 },
      .camera = { { 0.95f, -2.85f, 1.2f }, { 0.04f, -0.1f, 0.6f }, 35.0f },
      .look = { { 0.80f, 0.28f, 0.25f }, { 0.95f, 0.85f, 0.60f }, { 0.98f, 0.95f, 0.88f }, 10.0f },
      .start = StartPatchwork,
      .push = PushPatches },
    { .name = "vortex",
      .together = true,
      .about = "two spirals that meet let two arms of a sheet of paper hang down",
      .size = 0.36f,
      .ticks = 540,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 390,
      .moments = { 60, 160, 225, 250, 280, 330, 390, 540 },
      .camera = { { 1.1f, -2.5f, 1.45f }, { 0.0f, 0.0f, 0.5f }, 28.0f },
      .look = PAPER_LOOK(0.20f, 0.35f, 0.70f),
      .start = StartVortex,
      .push = TouchFloor },
    { .name = "fallingguy",
      .about = "a man is cut out of a sheet of paper, swings down and hangs on by a finger",
      .size = 0.4f,
      .ticks = 600,
      .substeps = 2,
      .firstCut = 60,
      .lastCut = 300,
      .moments = { 60, 140, 220, 290, 310, 330, 360, 600 },
      .camera = { { 1.0f, -4.7f, 2.2f }, { -0.25f, 0.0f, 1.0f }, 31.0f },
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

/* The type with all that comes after its first cut at another pace. */
static SceneType SlowType(const SceneType* type, float pace)
{
    SceneType paced = *type;
    paced.lastCut = type->firstCut + Slow(type->lastCut - type->firstCut, pace);
    paced.ticks = type->firstCut + Slow(type->ticks - type->firstCut, pace);
    for (int32_t i = 0; i < 8; i++) {
        int32_t after = type->moments[i] - type->firstCut;
        paced.moments[i] = after > 0 ? type->firstCut + Slow(after, pace) : type->moments[i];
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
    bool fine = type->start(scene, &filled);
    FinishStrokes(scene);
    if (!fine) {
        fprintf(stderr, "scene %s does not start: %s\n", type->name, kiriWorld_GetLastError(scene->world));
        Scene_Stop(scene);
        return false;
    }
    return true;
}

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
