/* Sheets that are sewn or glued along lines. */
#include "scene_parts.h"
#include "scene_types.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static kiriMaterial Preset(int32_t preset)
{
    kiriMaterial material;
    kiriGetMaterial(preset, &material);
    return material;
}

/* Sews lines of as many points, in sizes, shifted along u. */
static bool Sew(Scene* scene, kiriSheet a, kiriSheet b, const float* lineA, const float* lineB, int32_t count,
                float shiftA, float shiftB, float stiffness)
{
    float points[2][16];
    for (int32_t i = 0; i < 2 * count; i++) {
        points[0][i] = scene->type->size * (lineA[i] + (i % 2 == 0 ? shiftA : 0.0f));
        points[1][i] = scene->type->size * (lineB[i] + (i % 2 == 0 ? shiftB : 0.0f));
    }
    kiriSeamDef def;
    kiriSeam seam;
    kiriDefaultSeamDef(&def);
    def.sheetA = a;
    def.sheetB = b;
    def.lineA = points[0];
    def.lineB = points[1];
    def.countA = def.countB = count;
    def.stiffness = stiffness;
    return kiriCreateSeam(scene->world, &def, &seam) == KIRI_OK;
}

/* ---- Shirt: four panels around a man are sewn, and drop on his shoulders ------------------------------------------ */

enum { BODY = 12, NECK = 4, SLEEVE = 12, ROWS = 28, UNDERARM = 16, COLUMNS = BODY + SLEEVE, PANELS = 4 };

/* Corners of a panel, from its middle outwards and upwards: hem, underarm, shoulder, cuff. */
static const float hemAt[2] = { 0.27f, 0.0f }, armAt[2] = { 0.26f, 0.36f }, shoulderAt[2] = { 0.23f, 0.60f };
static const float cuffAt[2][2] = { { 0.36f, 0.26f }, { 0.476f, 0.428f } }; /* below, above */
static const float neckAt[2] = { 0.085f, 0.65f }, frontAt[2] = { 0.0f, 0.57f };

static float Mix(float from, float to, float share)
{
    return from + share * (to - from);
}

/* The upper end of a column of the body: the neck, then the shoulder. */
static void GetTop(int32_t column, float top[2])
{
    float share = column < NECK ? (float)column / NECK : (float)(column - NECK) / (BODY - NECK);
    const float* from = column < NECK ? frontAt : neckAt;
    const float* to = column < NECK ? neckAt : shoulderAt;
    top[0] = Mix(from[0], to[0], share);
    top[1] = Mix(from[1], to[1], column < NECK ? 1.0f - sqrtf(1.0f - share * share) : share);
}

/* A vertex of the grid; false where the panel has none: below the sleeve. */
static bool PlaceVertex(int32_t column, int32_t row, float point[2])
{
    float up = row < UNDERARM ? (float)row / UNDERARM : (float)(row - UNDERARM) / (ROWS - UNDERARM), top[2];
    if (column > BODY) {
        float out = (float)(column - BODY) / SLEEVE;
        for (int i = 0; i < 2; i++) {
            point[i] = Mix(Mix(armAt[i], shoulderAt[i], up), Mix(cuffAt[0][i], cuffAt[1][i], up), out);
        }
        return row >= UNDERARM;
    }
    float side = (float)column / BODY;
    GetTop(column, top);
    point[0] = row < UNDERARM ? side * Mix(hemAt[0], armAt[0], up) : Mix(side * armAt[0], top[0], up);
    point[1] = row < UNDERARM ? Mix(0.0f, armAt[1], up) : Mix(armAt[1], top[1], up);
    return true;
}

/* Panels lie side by side in the rest plane, as on cloth that they are cut from. */
static kiriSheet AddPanel(Scene* scene, const SceneOptions* options, int32_t panel)
{
    float positions[2 * (COLUMNS + 1) * (ROWS + 1)];
    int32_t indices[6 * COLUMNS * ROWS], number[COLUMNS + 1][ROWS + 1];
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ 0.0f, panel < 2 ? -0.15f : 0.15f, 0.92f },
                                        (float[]){ 0.0f, 0.0f, 1.0f }, Preset(KIRI_MATERIAL_COTTON));
    def.axisU[0] = panel % 2 == 0 ? 1.0f : -1.0f;
    def.position[0] -= def.axisU[0] * scene->type->size * (float)panel;
    for (int32_t i = 0; i <= COLUMNS; i++) {
        for (int32_t j = 0; j <= ROWS; j++) {
            float* point = positions + 2 * def.vertexCount;
            number[i][j] = PlaceVertex(i, j, point) ? def.vertexCount++ : -1;
            point[0] = scene->type->size * (point[0] + (float)panel);
            point[1] *= scene->type->size;
        }
    }
    for (int32_t i = 0; i < COLUMNS; i++) {
        for (int32_t j = i < BODY ? 0 : UNDERARM; j < ROWS; j++) {
            int32_t a = number[i][j], b = number[i + 1][j], c = number[i + 1][j + 1], d = number[i][j + 1];
            const int32_t corners[6] = { a, b, c, a, c, d };
            memcpy(indices + 3 * def.triangleCount, corners, sizeof corners);
            def.triangleCount += 2;
        }
    }
    def.restPositions = positions;
    def.indices = indices;
    def.frameCount = 30;
    def.gridResolution = 48;
    def.touchesSheets = 1;
    return Scene_MakeSheet(scene, &def, options, NULL) ? scene->sheet : 0;
}

static bool AddMan(Scene* scene)
{
    static const float limbs[][7] = {
        /* from, to (x, y, z), radius */
        { 0.0f, 0.0f, 1.62f, 0.0f, 0.0f, 1.65f, 0.095f },    { 0.0f, 0.0f, 1.36f, 0.0f, 0.0f, 1.55f, 0.055f },
        { -0.16f, 0.0f, 1.36f, 0.16f, 0.0f, 1.36f, 0.07f },  { -0.08f, 0.0f, 0.95f, -0.08f, 0.0f, 1.3f, 0.11f },
        { 0.08f, 0.0f, 0.95f, 0.08f, 0.0f, 1.3f, 0.11f },    { -0.19f, 0.0f, 1.36f, -0.64f, 0.0f, 1.045f, 0.05f },
        { 0.19f, 0.0f, 1.36f, 0.64f, 0.0f, 1.045f, 0.05f },  { -0.1f, 0.0f, 0.9f, -0.12f, 0.0f, 0.08f, 0.08f },
        { 0.1f, 0.0f, 0.9f, 0.12f, 0.0f, 0.08f, 0.08f },
    };
    bool fine = true;
    for (size_t i = 0; fine && i < sizeof limbs / sizeof limbs[0]; i++) {
        fine = Scene_AddCapsule(scene, limbs[i], limbs[i] + 3, limbs[i][6], UINT32_MAX);
    }
    return fine;
}

static bool StartShirt(Scene* scene, const SceneOptions* options)
{
    const float middle[2][2] = { { 0.0f, 0.0f }, { frontAt[0], frontAt[1] } };
    const float above[3][2] = { { neckAt[0], neckAt[1] },
                                { shoulderAt[0], shoulderAt[1] },
                                { cuffAt[1][0], cuffAt[1][1] } };
    const float below[3][2] = { { hemAt[0], hemAt[1] }, { armAt[0], armAt[1] }, { cuffAt[0][0], cuffAt[0][1] } };
    kiriSheet panels[PANELS];
    bool fine = AddMan(scene);
    for (int32_t i = 0; fine && i < PANELS; i++) {
        panels[i] = AddPanel(scene, options, i);
        fine = panels[i] != 0;
    }
    for (int32_t i = 0; fine && i < 2; i++) {
        float k = (float)i;
        fine = Sew(scene, panels[2 * i], panels[2 * i + 1], middle[0], middle[0], 2, 2.0f * k, 2.0f * k + 1.0f, 0.0f) &&
               Sew(scene, panels[i], panels[i + 2], above[0], above[0], 3, k, k + 2.0f, 0.0f) &&
               Sew(scene, panels[i], panels[i + 2], below[0], below[0], 3, k, k + 2.0f, 0.0f);
    }
    scene->sheet = fine ? panels[0] : 0;
    return fine;
}

const SceneType shirtScene = {
    .name = "shirt",
    .about = "four panels around a man are sewn to a shirt, which drops on his shoulders",
    .size = 1.0f,
    .ticks = 240,
    .substeps = 2,
    .moments = { 1, 5, 8, 13, 19, 240 },
    .camera = { { 0.9f, -2.9f, 1.7f }, { 0.0f, 0.0f, 1.13f }, 27.0f },
    .look = { { 0.30f, 0.50f, 0.72f }, { 0.27f, 0.45f, 0.66f }, { 0.15f, 0.25f, 0.4f }, 12.0f },
    .start = StartShirt,
};

/* ---- Lantern: paper is rolled and glued to a tube, slit, and pressed ---------------------------------------------- */

enum { SLITS = 12, LEVELS = 5, TUBE_FRAMES = (SLITS + 1) * LEVELS, ROLL_FIRST = 10, ROLL_LAST = 110, GLUE = 115, PRESS = 90 };

static const float around = 1.2f; /* length of the sheet; its height is 1 */
static const float levels[LEVELS] = { 0.06f, 0.28f, 0.5f, 0.72f, 0.94f };

static float ColumnAt(int32_t column)
{
    float u = column == 0 ? 0.25f : column == SLITS ? SLITS - 0.25f : (float)column;
    return around * u / SLITS;
}

static bool StartLantern(Scene* scene, const SceneOptions* options)
{
    float points[2 * TUBE_FRAMES];
    for (int32_t i = 0; i < TUBE_FRAMES; i++) {
        points[2 * i] = ColumnAt(i / LEVELS);
        points[2 * i + 1] = levels[i % LEVELS];
    }
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ -0.5f * around, 0.0f, 0.02f }, (float[]){ 0.0f, 0.0f, 1.0f },
                                        Preset(KIRI_MATERIAL_PAPER));
    def.frameCount = def.maxFrames = TUBE_FRAMES;
    def.gridResolution = 96;
    def.skinning = KIRI_SKINNING_SMOOTH;
    def.iterations = 2;
    bool fine = Scene_MakeRectangle(scene, &def, options, &(Rectangle){ around, 1.0f, 72, 40, points });
    for (int32_t i = 0; fine && i < SLITS; i++) {
        float u = around * ((float)i + 0.5f) / SLITS;
        fine = Scene_AddLine(scene, u, 0.13f, u, 0.87f);
    }
    return fine;
}

/* Holds a frame where the sheet is when it is rolled to a part `rolled` of a tube. */
static void HoldOnTube(Scene* scene, float width, kiriFrame frame, const float rest[2], float rolled, float drop)
{
    const float size = scene->type->size, length = size * width, s = rest[0] - 0.5f * length;
    float bend = 6.2831853f * (rolled > 1e-3f ? rolled : 1e-3f) / length, c = cosf(bend * s), n = sinf(bend * s);
    const float at[3] = { n / bend, (c - 1.0f) / bend, rest[1] + size * (0.02f - drop) };
    kiriFrame_Hold(scene->world, frame, at, (float[]){ c, -n, 0.0f, 0.0f, 0.0f, 1.0f, -n, -c, 0.0f });
}

static void RollLantern(Scene* scene)
{
    const float ends[2][2][2] = { { { around, 0.0f }, { around, 1.0f } }, { { 0.0f, 0.0f }, { 0.0f, 1.0f } } };
    int32_t count = 0, first = scene->type->lastCut + 10;
    float drop = 0.08f * Scene_Ease(scene->tick, first, first + Scene_Slow(PRESS, scene->pace));
    kiriFrame frames[TUBE_FRAMES];
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, TUBE_FRAMES, &count);
    for (int32_t i = 0; i < count; i++) {
        kiriFrameState state;
        kiriFrame_GetState(scene->world, frames[i], &state);
        float height = state.restPoint[1] / scene->type->size;
        bool isRim = height < 0.15f || height > 0.85f;
        if (scene->tick <= GLUE || isRim) {
            HoldOnTube(scene, around, frames[i], state.restPoint, Scene_Ease(scene->tick, ROLL_FIRST, ROLL_LAST),
                       height > 0.85f ? drop : 0.0f);
        } else if (scene->tick == GLUE + 1) {
            kiriFrame_Hold(scene->world, frames[i], NULL, NULL);
        } else if (drop > 0.0f && drop < 0.1f) { /* outwards, so that no strip buckles inwards */
            const float k = 3.0f * (float)state.mass, none[3] = { 0.0f, 0.0f, 0.0f };
            kiriFrame_ApplyForce(scene->world, frames[i],
                                 (float[]){ -k * state.rotation[6], -k * state.rotation[7], 0.0f }, none);
        }
    }
    if (scene->tick == GLUE) {
        Sew(scene, scene->sheet, scene->sheet, ends[0][0], ends[1][0], 2, 0.0f, 0.0f, 1e3f);
    }
}

const SceneType lanternScene = {
    .name = "lantern",
    .about = "a sheet of paper is rolled and glued to a tube, slit twelve times, and pressed to a lantern",
    .size = 0.2f,
    .ticks = 460,
    .substeps = 2,
    .firstCut = 130,
    .lastCut = 300,
    .moments = { 10, 80, 125, 220, 350, 460 },
    .camera = { { 0.9f, -2.6f, 1.5f }, { 0.0f, -0.15f, 0.45f }, 30.0f },
    .look = { { 0.93f, 0.72f, 0.35f }, { 0.86f, 0.30f, 0.22f }, { 0.5f, 0.2f, 0.1f }, 0.0f },
    .start = StartLantern,
    .push = RollLantern,
};

/* ---- Can: foil is rolled and glued to a tube, and a thumb dents it ------------------------------------------------ */

enum { CAN_COLUMNS = 24, CAN_ROWS = 14, CAN_FRAMES = CAN_COLUMNS * CAN_ROWS, PRESSED = 190, BACK = 230 };

static const float canAround = 1.8f, thumb = 0.1f, thumbHeight = 0.8f;

static bool StartCan(Scene* scene, const SceneOptions* options)
{
    float points[2 * CAN_FRAMES];
    for (int32_t i = 0; i < CAN_FRAMES; i++) {
        points[2 * i] = canAround * ((float)(i / CAN_ROWS) + 0.5f) / CAN_COLUMNS;
        points[2 * i + 1] = ((float)(i % CAN_ROWS) + 0.5f) / CAN_ROWS;
    }
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ -0.5f * canAround, 0.0f, 0.02f }, (float[]){ 0.0f, 0.0f, 1.0f },
                                        Preset(KIRI_MATERIAL_FOIL));
    def.material.thickness = 1e-4f; /* m: of a can */
    def.frameCount = def.maxFrames = CAN_FRAMES;
    def.gridResolution = 72;
    def.iterations = 2;
    return Scene_MakeRectangle(scene, &def, options, &(Rectangle){ canAround, 1.0f, 72, 40, points }) &&
           Scene_AddCapsule(scene, (float[]){ 0.0f, 0.3f, thumbHeight }, (float[]){ 0.0f, 0.9f, thumbHeight + 0.25f }, thumb,
                            UINT32_MAX);
}

/* Frames are held until the foil is glued, and at both ends, as by lids. */
static void DentCan(Scene* scene)
{
    const float ends[2][2][2] = { { { canAround, 0.0f }, { canAround, 1.0f } }, { { 0.0f, 0.0f }, { 0.0f, 1.0f } } };
    int32_t count = 0, tick = scene->tick;
    float in = Scene_Ease(tick + 1, GLUE + 5, PRESSED) - Scene_Ease(tick, GLUE + 5, PRESSED);
    float out = Scene_Ease(tick + 1, PRESSED, BACK) - Scene_Ease(tick, PRESSED, BACK);
    kiriFrame frames[CAN_FRAMES];
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, CAN_FRAMES, &count);
    for (int32_t i = 0; i < count; i++) {
        kiriFrameState state;
        kiriFrame_GetState(scene->world, frames[i], &state);
        float height = state.restPoint[1] / scene->type->size;
        if (tick <= GLUE || height < 1.0f / CAN_ROWS) {
            HoldOnTube(scene, canAround, frames[i], state.restPoint, Scene_Ease(tick, ROLL_FIRST, ROLL_LAST), 0.0f);
        } else if (tick == GLUE + 1) {
            kiriFrame_Hold(scene->world, frames[i], NULL, NULL);
        }
    }
    if (tick == GLUE) {
        Sew(scene, scene->sheet, scene->sheet, ends[0][0], ends[1][0], 2, 0.0f, 0.0f, 1e3f);
    }
    float speed = 60.0f * scene->type->size * (0.9f * out - 0.58f * in);
    kiriObstacle_SetVelocity(scene->world, scene->bodyIds[0], (float[]){ 0.0f, speed, 0.0f }, (float[]){ 0.0f, 0.0f, 0.0f });
}

const SceneType canScene = {
    .name = "can",
    .about = "foil is rolled and glued to a can, and a thumb dents it",
    .size = 0.12f,
    .ticks = 270,
    .substeps = 2,
    .moments = { 40, 115, 155, 190, 210, 270 },
    .camera = { { 0.9f, 2.5f, 1.6f }, { 0.0f, -0.15f, 0.5f }, 30.0f },
    .look = { { 0.80f, 0.82f, 0.85f }, { 0.72f, 0.74f, 0.78f }, { 0.5f, 0.5f, 0.55f }, 0.0f },
    .start = StartCan,
    .push = DentCan,
};

/* ---- Patch: a hole is cut in a curtain, a patch is sewn over it, and a ball pushes ------------------------------- */

enum { PATCH_TICK = 150, BALL_FIRST = 240, BALL_LAST = 330, BALL_BACK = 400 };

static const float patchSide = 0.34f;

static bool StartPatch(Scene* scene, const SceneOptions* options)
{
    const Spiral hole = { { 0.5, 0.55 }, 0.1, 0.1, 0.3, 1.0, 0.02 };
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ -0.5f, 0.0f, 0.1f }, (float[]){ 0.0f, 0.0f, 1.0f },
                                        Preset(KIRI_MATERIAL_COTTON));
    def.frameCount = 36;
    def.gridResolution = 60;
    def.touchesSheets = 1;
    bool fine = Scene_MakeRectangle(scene, &def, options, &(Rectangle){ 1.0f, 1.0f, 50, 50, NULL });
    for (int32_t i = 0; fine && i < 5; i++) {
        fine = Scene_PinHere(scene, &def, 0.25f * (float)i, 1.0f);
    }
    return fine && Scene_AddCapsule(scene, (float[]){ 0.0f, 0.6f, 0.62f }, (float[]){ 0.0f, 0.6f, 0.62f }, 0.13f,
                            UINT32_MAX) &&
           Outline_AddSpiral(Scene_AddStroke(scene), &hole);
}

/* The patch hangs before the hole, askew, and its border is sewn to the curtain. */
static void AddPatch(Scene* scene)
{
    const float c = 0.990f, s = 0.139f, half = 0.5f * patchSide, corners[5][2] = { { -half, -half }, { half, -half },
                                                                                   { half, half },   { -half, half },
                                                                                   { -half, -half } };
    float line[5][2], lineB[5][2];
    for (int i = 0; i < 5; i++) {
        const float* p = corners[i];
        line[i][0] = 0.5f + c * p[0] - s * p[1];
        line[i][1] = 0.55f + s * p[0] + c * p[1];
        lineB[i][0] = half + p[0];
        lineB[i][1] = half + p[1];
    }
    kiriSheet curtain = scene->sheet;
    const float corner[3] = { line[0][0] - 0.5f, -0.12f, line[0][1] + 0.1f };
    kiriSheetDef def = Scene_PlaceSheet(scene, corner, (float[]){ -s, 0.0f, c }, Preset(KIRI_MATERIAL_COTTON));
    def.axisU[0] = c;
    def.axisU[2] = s;
    def.frameCount = 16;
    def.gridResolution = 32;
    def.touchesSheets = 1;
    if (Scene_MakeRectangle(scene, &def, &(SceneOptions){ .dataFolder = NULL },
                            &(Rectangle){ patchSide, patchSide, 20, 20, NULL })) {
        scene->second = scene->sheet;
        Sew(scene, curtain, scene->second, line[0], lineB[0], 5, 0.0f, 0.0f, 0.0f);
    }
    scene->sheet = curtain;
}

static void PushPatch(Scene* scene)
{
    int32_t tick = scene->tick;
    float way = tick < BALL_LAST ? Scene_Ease(tick + 1, BALL_FIRST, BALL_LAST) - Scene_Ease(tick, BALL_FIRST, BALL_LAST)
                                 : Scene_Ease(tick, BALL_LAST, BALL_BACK) - Scene_Ease(tick + 1, BALL_LAST, BALL_BACK);
    if (tick == PATCH_TICK) {
        AddPatch(scene);
    }
    kiriObstacle_SetVelocity(scene->world, scene->bodyIds[0], (float[]){ 0.0f, -0.72f * 60.0f * way, 0.0f },
                             (float[]){ 0.0f, 0.0f, 0.0f });
}

const SceneType patchScene = {
    .name = "patch",
    .about = "a hole is cut in a curtain, a patch is sewn over it, and holds as a ball pushes from behind",
    .size = 1.0f,
    .ticks = 440,
    .substeps = 2,
    .firstCut = 20,
    .lastCut = 100,
    .moments = { 70, 140, 151, 230, 330, 440 },
    .camera = { { 0.9f, -2.7f, 1.1f }, { 0.0f, 0.0f, 0.6f }, 30.0f },
    .look = { { 0.70f, 0.24f, 0.26f }, { 0.60f, 0.20f, 0.22f }, { 0.40f, 0.10f, 0.12f }, 0.0f },
    .secondLook = { { 0.95f, 0.80f, 0.35f }, { 0.90f, 0.72f, 0.30f }, { 0.55f, 0.40f, 0.10f }, 16.0f },
    .start = StartPatch,
    .push = PushPatch,
};

/* ---- Bag: two panels are sewn on three sides, and fifty balls fall in -------------------------------------------- */

/* A ball lies on balls below, whose load a tick of the world brings to the cloth with a delay: so ticks are short. */
enum { BALLS = 50, BALL_EVERY = 4, BAG_PARTS = 4, ROUNDS = 20 };

static const float ballRadius = 0.02f, ballMass = 0.01f; /* m, kg */

static bool AddBagPanel(Scene* scene, const SceneOptions* options, float side, kiriSheet* panel)
{
    const float round = 0.307f, mouth = 0.217f; /* the mouth is held round, at its eighths */
    kiriSheetDef def = Scene_PlaceSheet(scene, (float[]){ -0.5f, side * mouth, 0.1f }, (float[]){ 0.0f, 0.0f, 1.0f },
                                        Preset(KIRI_MATERIAL_COTTON));
    def.frameCount = 25;
    def.skinning = KIRI_SKINNING_SMOOTH;
    bool fine = Scene_MakeRectangle(scene, &def, options, &(Rectangle){ 1.0f, 1.0f, 30, 30, NULL }) &&
                Scene_PinAt(scene, 0.25f, 1.0f, -mouth, side * mouth, 1.1f) &&
                Scene_PinAt(scene, 0.5f, 1.0f, 0.0f, side * round, 1.1f) &&
                Scene_PinAt(scene, 0.75f, 1.0f, mouth, side * mouth, 1.1f);
    *panel = scene->sheet;
    return fine;
}

static bool StartBag(Scene* scene, const SceneOptions* options)
{
    const float sides[4][2] = { { 0.0f, 1.0f }, { 0.0f, 0.0f }, { 1.0f, 0.0f }, { 1.0f, 1.0f } };
    kiriSheet front = 0, back = 0;
    bool fine = AddBagPanel(scene, options, -1.0f, &front) && AddBagPanel(scene, options, 1.0f, &back) &&
                Sew(scene, front, back, sides[0], sides[0], 4, 0.0f, 0.0f, 0.0f);
    scene->sheet = front;
    scene->second = back;
    return fine;
}

static void DropBall(Scene* scene)
{
    int32_t n = scene->bodyCount;
    kiriObstacleDef* def = &scene->bodies[n];
    kiriDefaultObstacleDef(def);
    def->type = KIRI_OBSTACLE_SPHERE;
    def->radius = ballRadius;
    def->mass = ballMass;
    def->position[0] = 0.015f * (float)(7 * n % 5 - 2);
    def->position[1] = 0.01f * (float)(3 * n % 3 - 1);
    def->position[2] = scene->type->size * 1.1f + 0.09f;
    if (kiriCreateObstacle(scene->world, def, &scene->bodyIds[n]) == KIRI_OK) {
        scene->bodyCount++;
    }
}

/* Changes velocities so that in dt no two balls come nearer than their surfaces; those that are nearer part slowly. */
static void PartBalls(float (*at)[3], float (*velocity)[3], int32_t count, float dt)
{
    for (int32_t pair = 0; pair < count * count; pair++) {
        int32_t i = pair / count, j = pair % count;
        float way[3], square = 0.0f, speed = 0.0f;
        for (int k = 0; k < 3; k++) {
            way[k] = at[i][k] - at[j][k];
            square += way[k] * way[k];
        }
        if (j >= i || square > 9.0f * ballRadius * ballRadius || square < 1e-12f) {
            continue;
        }
        float length = sqrtf(square), gap = length - 2.0f * ballRadius;
        float least = gap > 0.0f ? -gap / dt : fminf(-0.2f * gap / dt, 0.5f);
        for (int k = 0; k < 3; k++) {
            speed += way[k] / length * (velocity[i][k] - velocity[j][k]);
        }
        float push = 0.5f * fmaxf(least - speed, 0.0f) / length;
        for (int k = 0; k < 3; k++) {
            velocity[i][k] += push * way[k];
            velocity[j][k] -= push * way[k];
        }
    }
}

/* Gives the balls velocities, as a host does: from their weight, the impulses of the bag and their contacts. */
static void FillBag(Scene* scene)
{
    const float dt = 1.0f / (60.0f * BAG_PARTS);
    float at[BALLS][3], velocity[BALLS][3];
    if (scene->bodyCount < BALLS && scene->tick == BALL_EVERY * scene->bodyCount) {
        DropBall(scene);
    }
    for (int32_t i = 0; i < scene->bodyCount; i++) {
        kiriObstacleState state;
        kiriObstacle_GetState(scene->world, scene->bodyIds[i], &state);
        for (int k = 0; k < 3; k++) {
            at[i][k] = state.position[k];
            velocity[i][k] = state.velocity[k] + (float)state.impulse[k] / ballMass - (k == 2 ? 9.81f * dt : 0.0f);
        }
    }
    for (int round = 0; round < ROUNDS; round++) {
        PartBalls(at, velocity, scene->bodyCount, dt);
    }
    for (int32_t i = 0; i < scene->bodyCount; i++) {
        kiriObstacle_SetVelocity(scene->world, scene->bodyIds[i], velocity[i], (float[]){ 0.0f, 0.0f, 0.0f });
    }
}

const SceneType bagScene = {
    .name = "bag",
    .about = "two panels are sewn to a bag, and fifty balls fall in",
    .size = 0.3f,
    .ticks = 270,
    .substeps = 2,
    .parts = BAG_PARTS,
    .moments = { 2, 26, 47, 110, 181, 270 },
    .camera = { { 0.55f, -1.9f, 2.9f }, { 0.0f, 0.0f, 0.78f }, 30.0f },
    .look = { { 0.36f, 0.58f, 0.55f }, { 0.30f, 0.50f, 0.47f }, { 0.15f, 0.3f, 0.28f }, 0.0f },
    .secondLook = { { 0.36f, 0.58f, 0.55f }, { 0.30f, 0.50f, 0.47f }, { 0.15f, 0.3f, 0.28f }, 0.0f },
    .bodies = { 0.95f, 0.55f, 0.12f },
    .start = StartBag,
    .push = FillBag,
};
