/* Sheets of paper that hands tear. */
#include "scene_parts.h"
#include "scene_types.h"

#include <math.h>
#include <stddef.h>

enum { PAPER_FRAMES = 96, SHEET_GROUP = 1, HAND_GROUP = 2 };

static bool MakeSheet(Scene* scene, const SceneOptions* options, kiriSheetDef* def, float width, int32_t preset,
                      float weakness, float grainRatio)
{
    kiriTearing tearing;
    kiriMaterial material;
    kiriGetTearing(preset, &tearing);
    kiriGetMaterial(preset, &material);
    tearing.toughness *= weakness;
    tearing.grain[1] = 1.0f; /* upwards */
    tearing.grainRatio = grainRatio;
    *def = Scene_PlaceSheet(scene, (float[]){ -0.5f * width, 0.0f, 0.9f }, (float[]){ 0.0f, 0.0f, 1.0f }, material);
    def->frameCount = PAPER_FRAMES;
    def->gridResolution = 72;
    def->iterations = 4;
    def->groups = SHEET_GROUP;
    return Scene_MakeRectangle(scene, def, options, &(Rectangle){ width, 1.0f, (int32_t)(48.0f * width), 48, NULL }) &&
           kiriSheet_SetTearing(scene->world, scene->sheet, &tearing) == KIRI_OK;
}

static bool MakePaper(Scene* scene, const SceneOptions* options, kiriSheetDef* def, float width)
{
    return MakeSheet(scene, options, def, width, KIRI_MATERIAL_PAPER, 1.0f, 1.0f);
}

/* A thumb before the sheet and a finger behind it, from a point (u, v) of the sheet to another. */
static bool AddFingers(Scene* scene, const kiriSheetDef* def, const float from[2], const float to[2])
{
    const float size = scene->type->size, x = def->position[0] / size, z = def->position[2] / size, radius = 0.045f;
    bool fine = true;
    for (int side = -1; fine && side <= 1; side += 2) {
        float y = (float)side * radius;
        const float tip[3] = { x + from[0], y, z + from[1] }, end[3] = { x + to[0], 3.0f * y, z + to[1] };
        fine = Scene_AddCapsule(scene, tip, end, radius, HAND_GROUP);
    }
    return fine;
}

/* A hand that stays: no point of the sheet between its fingers moves. */
static bool AddHolder(Scene* scene, const kiriSheetDef* def, const float from[2], const float to[2])
{
    const float size = scene->type->size, ends[2][2] = { { size * from[0], size * from[1] }, { size * to[0], size * to[1] } };
    kiriPin clamp;
    return AddFingers(scene, def, from, to) &&
           kiriSheet_ClampLine(scene->world, scene->sheet, ends[0], ends[1], &clamp) == KIRI_OK;
}

/* A hand that holds three points of the sheet softly, so that paper tears before it is stretched. */
static bool AddHand(Scene* scene, const kiriSheetDef* def, const float from[2], const float to[2])
{
    const float size = scene->type->size, u = from[0], v = from[1];
    const float points[3][2] = { { u - 0.04f, v }, { u + 0.04f, v }, { u, v < 0.5f ? v - 0.04f : v + 0.04f } };
    bool fine = AddFingers(scene, def, from, to);
    for (int i = 0; fine && i < 3; i++) {
        kiriPinDef pin;
        kiriPin id;
        kiriDefaultPinDef(&pin);
        for (int k = 0; k < 2; k++) {
            pin.restPoint[k] = size * points[i][k];
        }
        for (int k = 0; k < 3; k++) {
            pin.target[k] = def->position[k] + pin.restPoint[0] * def->axisU[k] + pin.restPoint[1] * def->axisV[k];
        }
        pin.stiffness = 300.0f; /* N/m */
        pin.obstacle = scene->bodyIds[scene->bodyCount - 1];
        fine = kiriCreatePin(scene->world, scene->sheet, &pin, &id) == KIRI_OK;
    }
    return fine;
}

/* Both fingers of a hand go on so fast, in sizes a tick of the scene's own pace, and turn about the vertical; rad a tick. */
static void MoveHand(Scene* scene, int hand, const float way[3], float turn)
{
    const float rate = 60.0f * scene->pace;
    const kiriObstacle* ids = scene->bodyIds + 2 * hand;
    kiriObstacleState fingers[2];
    for (int i = 0; i < 2; i++) {
        kiriObstacle_GetState(scene->world, ids[i], &fingers[i]);
    }
    for (int i = 0; i < 2; i++) { /* about the middle between them */
        float x = 0.5f * (fingers[i].position[0] - fingers[1 - i].position[0]);
        float y = 0.5f * (fingers[i].position[1] - fingers[1 - i].position[1]), velocity[3];
        for (int k = 0; k < 3; k++) {
            velocity[k] = rate * (scene->type->size * way[k] + turn * (k == 0 ? -y : k == 1 ? x : 0.0f));
        }
        kiriObstacle_SetVelocity(scene->world, ids[i], velocity, (float[]){ 0.0f, 0.0f, rate * turn });
    }
}

/* Multiplies the toughness along a line. */
static bool Perforate(Scene* scene, float u, float v, float toU, float toV, float factor)
{
    const float size = scene->type->size, line[4] = { size * u, size * v, size * toU, size * toV };
    return kiriSheet_SetTearLine(scene->world, scene->sheet, line, 2, factor) == KIRI_OK;
}

/* Is it a tick between two of the scene, at its pace? */
static bool IsBetween(const Scene* scene, int32_t first, int32_t last)
{
    int32_t start = scene->type->firstCut;
    return scene->tick >= start + Scene_Slow(first - start, scene->pace) &&
           scene->tick < start + Scene_Slow(last - start, scene->pace);
}

static void Blend(uint8_t* pixel, const uint8_t color[3])
{
    for (int i = 0; i < 3; i++) {
        pixel[i] = color[i];
    }
}

/* ---- Letter: one hand holds it, the other one tears a strip off ---------------------------------------------------- */

enum { LETTER_PULL = 60, LETTER_TURNED = 120, LETTER_END = 340 };

static const float letterWidth = 1.5f, stripAt = 0.8f;

/* An address, a stamp, and the dashes of the strip. */
static void PrintLetter(uint8_t* rgb)
{
    static const uint8_t paper[3] = { 250, 246, 236 }, ink[3] = { 52, 60, 90 }, red[3] = { 190, 60, 50 };
    for (int i = 0; i < PRINT_SIZE * PRINT_SIZE; i++) {
        float u = letterWidth * ((float)(i % PRINT_SIZE) + 0.5f) / PRINT_SIZE;
        float v = letterWidth * ((float)(i / PRINT_SIZE) + 0.5f) / PRINT_SIZE;
        bool isLine = u > 0.7f && u < (v < 0.25f ? 1.1f : 1.35f) && v > 0.18f && v < 0.46f && fmodf(v, 0.1f) < 0.018f;
        bool isStamp = u > 1.2f && u < 1.4f && v > 0.52f && v < 0.74f;
        bool isDash = fabsf(v - stripAt) < 0.006f && fmodf(u, 0.06f) < 0.035f;
        Blend(rgb + 3 * i, isLine || isDash ? ink : isStamp ? red : paper);
    }
}

static bool StartLetter(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def;
    return MakePaper(scene, options, &def, letterWidth) && Perforate(scene, -0.1f, stripAt, 1.1f * letterWidth, stripAt, 0.5f) &&
           AddHolder(scene, &def, (float[]){ 0.35f, 0.5f }, (float[]){ 0.15f, 0.0f }) &&
           AddHand(scene, &def, (float[]){ 0.1f, 0.9f }, (float[]){ -0.1f, 1.2f }) &&
           Scene_AddLine(scene, -0.05f, stripAt, 0.16f, stripAt);
}

static void TearLetter(Scene* scene)
{
    bool isPulling = IsBetween(scene, LETTER_PULL, LETTER_END), isTurning = IsBetween(scene, LETTER_PULL, LETTER_TURNED);
    MoveHand(scene, 1, (float[]){ isPulling ? 0.0105f : 0.0f, isPulling ? -0.005f : 0.0f, 0.0f },
             isTurning ? 3.1416f / (LETTER_TURNED - LETTER_PULL) : 0.0f);
}

const SceneType letterScene = {
    .name = "letter",
    .about = "a hand tears a letter open, along the line of small cuts below its edge",
    .size = 0.12f,
    .ticks = 400,
    .substeps = 2,
    .firstCut = 10,
    .lastCut = 40,
    .moments = { 60, 100, 150, 210, 280, 400 },
    .camera = { { 1.9f, -6.6f, 2.8f }, { 0.8f, 0.0f, 1.15f }, 25.0f },
    .look = { { 1.0f, 1.0f, 1.0f }, { 0.93f, 0.92f, 0.90f }, { 0.75f, 0.73f, 0.70f }, 1.0f / 1.5f },
    .print = PrintLetter,
    .start = StartLetter,
    .push = TearLetter,
};

/* ---- Stamps: they come off their sheet ------------------------------------------------------------------------ */

enum { ROWS = 3, COLUMNS = 4, PULL = 30, PULL_TICKS = 60, REST = 90 };

static const float stampSide = 1.0f / ROWS;

/* One stamp: a hill under the sun, a white border, and half of each hole around it. */
static void PrintStamp(uint8_t* rgb)
{
    static const uint8_t white[3] = { 250, 248, 240 }, hole[3] = { 120, 116, 112 }, sky[3] = { 240, 170, 90 };
    static const uint8_t sun[3] = { 205, 60, 45 }, hill[3] = { 40, 90, 110 };
    for (int i = 0; i < PRINT_SIZE * PRINT_SIZE; i++) {
        float x = ((float)(i % PRINT_SIZE) + 0.5f) / PRINT_SIZE, y = ((float)(i / PRINT_SIZE) + 0.5f) / PRINT_SIZE;
        float edgeX = fminf(x, 1.0f - x), edgeY = fminf(y, 1.0f - y), edge = fminf(edgeX, edgeY);
        float along = fmodf((edgeX < edgeY ? y : x) * 10.0f, 1.0f) - 0.5f, sunX = x - 0.62f, sunY = y - 0.62f;
        bool isHole = edge * edge + 0.01f * along * along < 0.022f * 0.022f;
        bool isSun = sunX * sunX + sunY * sunY < 0.02f, isHill = y < 0.38f + 0.12f * sinf(7.0f * x);
        Blend(rgb + 3 * i, isHole ? hole : edge < 0.12f ? white : isHill ? hill : isSun ? sun : sky);
    }
}

static bool StartStamps(Scene* scene, const SceneOptions* options)
{
    const float width = COLUMNS * stampSide;
    kiriSheetDef def;
    bool fine = MakePaper(scene, options, &def, width);
    for (int i = 1; fine && i < COLUMNS; i++) {
        fine = Perforate(scene, (float)i * stampSide, -0.1f, (float)i * stampSide, 1.1f, 0.02f);
    }
    for (int i = 1; fine && i < ROWS; i++) {
        fine = Perforate(scene, -0.1f, (float)i * stampSide, width + 0.1f, (float)i * stampSide, 0.02f);
    }
    return fine && AddHolder(scene, &def, (float[]){ 0.92f, 0.9f }, (float[]){ 0.7f, 0.0f }) &&
           AddHand(scene, &def, (float[]){ width - 0.5f * stampSide, 0.9f }, (float[]){ width + 0.1f, 1.2f }) &&
           AddHand(scene, &def, (float[]){ width - 0.5f * stampSide, 0.1f }, (float[]){ width + 0.1f, -0.2f });
}

static void TearStamps(Scene* scene)
{
    for (int i = 0; i < 2; i++) {
        bool isPulling = IsBetween(scene, PULL + i * REST, PULL + i * REST + PULL_TICKS);
        MoveHand(scene, 1 + i, isPulling ? (float[]){ 0.004f, -0.008f, i == 0 ? -0.002f : 0.002f } : (float[]){ 0.0f, 0.0f, 0.0f }, 0.0f);
    }
}

const SceneType stampsScene = {
    .name = "stamps",
    .about = "hands tear a stamp and a column of stamps off their sheet, along the holes",
    .size = 0.075f,
    .ticks = 240,
    .substeps = 2,
    .moments = { 20, 60, 95, 108, 135, 180 },
    .camera = { { 1.5f, -4.4f, 2.2f }, { 0.1f, 0.0f, 1.25f }, 26.0f },
    .look = { { 1.0f, 1.0f, 1.0f }, { 0.93f, 0.92f, 0.90f }, { 0.75f, 0.73f, 0.70f }, ROWS },
    .print = PrintStamp,
    .start = StartStamps,
    .push = TearStamps,
};

/* ---- Poster: a hand rips a strip off a wall -------------------------------------------------------------------- */

enum { GLUE_ROWS = 6, GLUE_COLUMNS = 5, RIP = 60, RIP_END = 316 };

static const float posterWidth = 0.8f;

static void PrintPoster(uint8_t* rgb)
{
    static const uint8_t sky[3] = { 240, 200, 90 }, sun[3] = { 215, 70, 50 }, sea[3] = { 40, 90, 130 };
    for (int i = 0; i < PRINT_SIZE * PRINT_SIZE; i++) {
        float x = ((float)(i % PRINT_SIZE) + 0.5f) / PRINT_SIZE, y = ((float)(i / PRINT_SIZE) + 0.5f) / PRINT_SIZE;
        float sunX = x - 0.4f, sunY = y - 0.5f;
        Blend(rgb + 3 * i, y < 0.4f + 0.02f * sinf(40.0f * x) ? sea : sunX * sunX + sunY * sunY < 0.05f ? sun : sky);
    }
}

/* Drops of glue hold the poster; those behind the strip break. Two cuts at its upper edge begin the strip. */
static bool StartPoster(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def;
    bool fine = MakePaper(scene, options, &def, posterWidth);
    for (int i = 0; fine && i < GLUE_ROWS * GLUE_COLUMNS; i++) {
        kiriPinDef pin;
        kiriPin id;
        kiriDefaultPinDef(&pin);
        pin.restPoint[0] = scene->type->size * posterWidth * ((float)(i % GLUE_COLUMNS) + 0.5f) / GLUE_COLUMNS;
        pin.restPoint[1] = scene->type->size * ((float)(i / GLUE_COLUMNS) + 0.5f) / (GLUE_ROWS + 1);
        pin.target[0] = def.position[0] + pin.restPoint[0];
        pin.target[2] = def.position[2] + pin.restPoint[1];
        pin.stiffness = 500.0f;
        pin.breakForce = i % GLUE_COLUMNS == GLUE_COLUMNS / 2 ? 0.3f : 0.0f; /* N */
        fine = kiriCreatePin(scene->world, scene->sheet, &pin, &id) == KIRI_OK;
    }
    return fine && AddHand(scene, &def, (float[]){ 0.4f, 0.92f }, (float[]){ 0.4f, 1.2f }) &&
           Scene_AddLine(scene, 0.26f, 1.05f, 0.28f, 0.85f) && Scene_AddLine(scene, 0.54f, 1.05f, 0.52f, 0.85f);
}

static void RipPoster(Scene* scene)
{
    bool isPulling = IsBetween(scene, RIP, RIP_END);
    MoveHand(scene, 0, isPulling ? (float[]){ 0.0f, -0.004f, -0.0055f } : (float[]){ 0.0f, 0.0f, 0.0f }, 0.0f);
}

const SceneType posterScene = {
    .name = "poster",
    .about = "a hand rips a strip out of a poster",
    .size = 0.3f,
    .ticks = 340,
    .substeps = 2,
    .firstCut = 10,
    .lastCut = 50,
    .moments = { 60, 110, 160, 210, 270, 340 },
    .camera = { { 1.5f, -3.6f, 2.0f }, { 0.1f, -0.2f, 1.08f }, 32.0f },
    .look = { { 1.0f, 1.0f, 1.0f }, { 0.93f, 0.92f, 0.90f }, { 0.75f, 0.73f, 0.70f }, 1.0f },
    .print = PrintPoster,
    .start = StartPoster,
    .push = RipPoster,
};

/* ---- Weave: hands tear a cloth along its threads ---------------------------------------------------------------- */

static bool StartWeave(Scene* scene, const SceneOptions* options)
{
    kiriSheetDef def;
    return MakeSheet(scene, options, &def, 0.8f, KIRI_MATERIAL_COTTON, 0.05f, 5.0f) &&
           AddHand(scene, &def, (float[]){ 0.28f, 0.92f }, (float[]){ 0.2f, 1.2f }) &&
           AddHand(scene, &def, (float[]){ 0.52f, 0.92f }, (float[]){ 0.6f, 1.2f }) &&
           Scene_AddLine(scene, 0.4f, 1.05f, 0.42f, 0.85f);
}

static void TearWeave(Scene* scene)
{
    bool isPulling = IsBetween(scene, RIP, RIP_END);
    for (int i = 0; i < 2; i++) {
        float side = i == 0 ? -1.0f : 1.0f;
        MoveHand(scene, i, isPulling ? (float[]){ 0.005f * side, 0.0f, 0.0f } : (float[]){ 0.0f, 0.0f, 0.0f }, 0.0f);
    }
}

const SceneType weaveScene = {
    .name = "weave",
    .about = "two hands tear a cloth along its threads, from a slanted cut on",
    .size = 0.4f,
    .ticks = 320,
    .substeps = 2,
    .firstCut = 10,
    .lastCut = 50,
    .moments = { 60, 100, 150, 210, 250, 320 },
    .camera = { { 0.6f, -4.6f, 2.0f }, { 0.0f, 0.0f, 1.2f }, 35.0f },
    .look = { { 0.62f, 0.30f, 0.30f }, { 0.55f, 0.26f, 0.26f }, { 0.40f, 0.15f, 0.15f }, 16.0f },
    .start = StartWeave,
    .push = TearWeave,
};
