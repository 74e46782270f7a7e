#include "defaults.h"
#include "sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

enum { MAX_VERTICES = 2048, MAX_TRIANGLES = 4096, MAX_FRAMES = 512, CUT_TICK = 6 };

const char* const sweepNames[SWEEP_SCENES] = { "strip", "square", "tongue" };

/* The rest shape, its mesh, and Young's modulus. */
typedef struct Shape {
    float length, width;
    int32_t columns, rows;
    float young;
} Shape;

static const Shape shapes[SWEEP_SCENES] = {
    { 0.2f, 0.05f, 80, 20, 5e8f },
    { 0.2f, 0.2f, 40, 40, 1e8f },
    { 0.1f, 0.1f, 40, 40, 5e8f },
};

const Setting sweepReferences[SWEEP_SCENES] = {
    { SWEEP_STRIP, 33, 1, 160, 2, 64, 8, KIRI_MODEL_LINKS, 0 },
    { SWEEP_SQUARE, 17, 17, 160, 2, 64, 1, KIRI_MODEL_LINKS, 0 },
    { SWEEP_TONGUE, 17, 17, 160, 2, 64, 1, KIRI_MODEL_LINKS, 0 },
};

/* What was seen after a tick. */
typedef struct Picture {
    int32_t vertexCount;
    float positions[3 * MAX_VERTICES];
} Picture;

static Picture references[SWEEP_SCENES][SWEEP_TICKS];

/* ---- Settings --------------------------------------------------------------------------------------------------- */

static int32_t RowsFor(int32_t scene, int32_t columns)
{
    return scene == SWEEP_STRIP ? 1 : columns;
}

/* Affine frames want more iterations than rigid ones in stiff paper. */
static int AddModel(Setting* settings, int32_t model)
{
    static const int32_t columns[] = { 5, 9, 17 }, substeps[] = { 1, 4, 16 };
    int count = 0;
    for (int c = 0; c < COUNT(columns); ++c) {
        for (int s = 0; s < COUNT(substeps); ++s) {
            Setting setting = { SWEEP_STRIP, columns[c], 1, 40, 8, substeps[s], 1, model, 0 };
            settings[count++] = setting;
        }
    }
    return count;
}

int Sweep_Settings(int32_t scene, Setting settings[SWEEP_SETTINGS], bool thin)
{
    static const int32_t columns[SWEEP_SCENES][5] = { { 3, 5, 9, 17, 0 }, { 3, 5, 7, 9, 12 }, { 3, 5, 7, 9, 12 } };
    static const int32_t grids[] = { 20, 40, 80 }, powers[] = { 1, 2, 4, 8, 16 };
    int count = 0;
    for (int c = 0; c < 5 && columns[scene][c] > 0; ++c) {
        for (int g = 0; g < COUNT(grids); ++g) {
            for (int i = 0; i < (scene == SWEEP_STRIP && !thin ? 4 : 2); ++i) {
                for (int s = 0; s < COUNT(powers); ++s) {
                    int32_t n = columns[scene][c];
                    Setting setting = { scene,     n, RowsFor(scene, n), grids[g], powers[i],
                                        powers[s], 1, KIRI_MODEL_LINKS,  0 };
                    settings[count++] = setting;
                }
            }
        }
    }
    if (scene == SWEEP_STRIP && !thin) {
        count += AddModel(&settings[count], KIRI_MODEL_AFFINE);
        count += AddModel(&settings[count], KIRI_MODEL_POINTS);
    }
    return count;
}

Setting Sweep_FromQuality(int32_t scene, const kiriQuality* quality)
{
    int32_t columns = scene == SWEEP_STRIP ? quality->framesAlong : (quality->framesAlong + 1) / 2;
    Setting setting = { scene,
                        columns,
                        RowsFor(scene, columns),
                        quality->gridResolution,
                        quality->iterations,
                        quality->substeps,
                        1,
                        KIRI_MODEL_LINKS,
                        0 };
    return setting;
}

int Sweep_Dominating(const Setting* settings, const Outcome* outcomes, int count, const Setting* setting,
                     const Outcome* outcome)
{
    for (int i = 0; i < count; ++i) {
        if (settings[i].scene == setting->scene && outcomes[i].error < outcome->error &&
            outcomes[i].cost <= outcome->cost && settings[i].gridResolution <= setting->gridResolution) {
            return i;
        }
    }
    return -1;
}

/* ---- The scene -------------------------------------------------------------------------------------------------- */

typedef struct Scene {
    kiriWorld* world;
    kiriSheet sheet;
} Scene;

/* -0.1 to 0.1; Numerical Recipes' "quick and dirty" generator. */
static float Shift(uint32_t* seed)
{
    *seed = 1664525u * *seed + 1013904223u;
    return 0.2f * ((float)(*seed >> 8) / (float)(1u << 24) - 0.5f);
}

static void PlaceFrames(const Setting* setting, float* points)
{
    const Shape* shape = &shapes[setting->scene];
    uint32_t seed = (uint32_t)setting->spread;
    for (int i = 0; i < setting->columns * setting->rows; ++i) {
        float u = (float)(i / setting->rows) + 0.5f, v = (float)(i % setting->rows) + 0.5f;
        if (setting->spread > 1) {
            u += Shift(&seed);
            v += setting->rows > 1 ? Shift(&seed) : 0.0f;
        }
        points[2 * i] = shape->length * u / (float)setting->columns;
        points[2 * i + 1] = shape->width * v / (float)setting->rows;
    }
}

static bool AddSheet(Scene* scene, const Setting* setting)
{
    static float rest[2 * MAX_VERTICES], points[2 * MAX_FRAMES];
    static int32_t indices[3 * MAX_TRIANGLES];
    const Shape* shape = &shapes[setting->scene];
    kiriSheetDef def = DefaultSheet();
    def.sleepSpeed = 0.0f;
    kiriFillRectangle(shape->length, shape->width, shape->columns, shape->rows, rest, indices);
    PlaceFrames(setting, points);
    def.restPositions = rest;
    def.vertexCount = (shape->columns + 1) * (shape->rows + 1);
    def.indices = indices;
    def.triangleCount = 2 * shape->columns * shape->rows;
    def.material = (kiriMaterial){ shape->young, 0.3f, 5e-4f, 1000.0f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f, 0 };
    def.framePoints = setting->spread == 1 ? NULL : points;
    def.frameCount = def.maxFrames = setting->columns * setting->rows; /* nothing is added */
    def.rigidWeight = 2.0f;
    def.gridResolution = setting->gridResolution;
    def.iterations = setting->iterations;
    def.model = setting->model;
    return kiriCreateSheet(scene->world, &def, &scene->sheet) == KIRI_OK;
}

static bool PinCorner(const Scene* scene, float v)
{
    kiriPin pin;
    kiriPinDef def = DefaultPin();
    def.restPoint[1] = def.target[1] = v;
    return kiriCreatePin(scene->world, scene->sheet, &def, &pin) == KIRI_OK;
}

static bool Fasten(const Scene* scene, const Setting* setting)
{
    const float from[2] = { 0.0f, 0.0f }, to[2] = { 0.0f, shapes[setting->scene].width };
    kiriPin clamp;
    if (setting->scene == SWEEP_SQUARE) {
        return PinCorner(scene, from[1]) && PinCorner(scene, to[1]);
    }
    return kiriSheet_ClampLine(scene->world, scene->sheet, from, to, &clamp) == KIRI_OK;
}

static bool CutTongue(const Scene* scene)
{
    static const float outside[2] = { 0.05f, -0.01f }, way[4] = { 0.05f, 0.07f, 0.08f, 0.07f };
    kiriCut cut;
    return kiriBeginCut(scene->world, scene->sheet, outside, &cut) == KIRI_OK &&
           kiriCut_Extend(scene->world, cut, way, 2) == KIRI_OK && kiriCut_End(scene->world, cut) == KIRI_OK;
}

static bool MakeScene(Scene* scene, const Setting* setting, kiriClockFn* clock, Outcome* outcome)
{
    kiriWorldDef def = DefaultWorld();
    def.clock = clock;
    if (setting->columns < 1 || setting->columns * setting->rows > MAX_FRAMES ||
        kiriCreateWorld(&def, &scene->world) != KIRI_OK) {
        return false;
    }
    double start = clock != NULL ? clock(NULL) : 0.0;
    bool added = AddSheet(scene, setting);
    outcome->create = clock != NULL ? clock(NULL) - start : 0.0;
    if (!added || !Fasten(scene, setting)) {
        kiriDestroyWorld(scene->world);
        return false;
    }
    return true;
}

static void AddProfile(const Scene* scene, const Setting* setting, Outcome* outcome, double* all)
{
    kiriProfile profile;
    kiriWorld_GetProfile(scene->world, &profile);
    double frames = setting->columns * setting->rows * (setting->model == KIRI_MODEL_LINKS ? 1.0 : 8.0);
    outcome->cost += profile.systemsSolved * frames;
    outcome->seconds += profile.seconds[KIRI_STAGE_SOLVE] + profile.seconds[KIRI_STAGE_SKIN];
    for (int stage = 0; stage < KIRI_STAGE_COUNT; ++stage) {
        *all += profile.seconds[stage];
    }
}

/* A sixtieth of a second. */
static bool Tick(const Scene* scene, const Setting* setting, int tick, Outcome* outcome)
{
    double all = 0.0;
    if (setting->scene == SWEEP_TONGUE && tick == CUT_TICK && !CutTongue(scene)) {
        return false;
    }
    for (int k = 0; k < setting->parts; ++k) {
        if (kiriWorld_Tick(scene->world, 1.0f / 60.0f / (float)setting->parts, setting->substeps) != KIRI_OK) {
            return false;
        }
        AddProfile(scene, setting, outcome, &all);
    }
    outcome->worst = fmax(outcome->worst, all);
    return true;
}

/* ---- Comparison ------------------------------------------------------------------------------------------------- */

static bool Look(const Scene* scene, kiriMesh* mesh)
{
    return kiriSheet_GetMesh(scene->world, scene->sheet, mesh) == KIRI_OK && mesh->vertexCount <= MAX_VERTICES;
}

bool Sweep_Prepare(const Setting* setting)
{
    Scene scene;
    Outcome ignored;
    memset(&ignored, 0, sizeof ignored);
    bool ok = MakeScene(&scene, setting, NULL, &ignored);
    if (!ok) {
        return false;
    }
    for (int t = 0; t < SWEEP_TICKS && ok; ++t) {
        kiriMesh mesh;
        Picture* picture = &references[setting->scene][t];
        ok = Tick(&scene, setting, t, &ignored) && Look(&scene, &mesh);
        if (ok) {
            picture->vertexCount = mesh.vertexCount;
            memcpy(picture->positions, mesh.positions, 3 * sizeof(float) * (size_t)mesh.vertexCount);
        }
    }
    kiriDestroyWorld(scene.world);
    return ok;
}

static void AddSquares(const kiriMesh* mesh, const float* expected, double* error, double* way)
{
    for (int i = 0; i < 3 * mesh->vertexCount; ++i) {
        double rest = i % 3 < 2 ? (double)mesh->restPositions[i / 3 * 2 + i % 3] : 0.0;
        double off = (double)mesh->positions[i] - (double)expected[i], moved = (double)expected[i] - rest;
        *error += off * off;
        *way += moved * moved;
    }
}

bool Sweep_Run(const Setting* setting, kiriClockFn* clock, Outcome* outcome)
{
    Scene scene;
    double error = 0.0, way = 0.0;
    memset(outcome, 0, sizeof *outcome);
    bool ok = MakeScene(&scene, setting, clock, outcome);
    if (!ok) {
        return false;
    }
    for (int t = 0; t < SWEEP_TICKS && ok; ++t) {
        kiriMesh mesh;
        const Picture* picture = &references[setting->scene][t];
        ok = Tick(&scene, setting, t, outcome) && Look(&scene, &mesh) && mesh.vertexCount == picture->vertexCount;
        if (ok) {
            AddSquares(&mesh, picture->positions, &error, &way);
        }
    }
    kiriDestroyWorld(scene.world);
    outcome->error = sqrt(error / way);
    outcome->cost /= SWEEP_TICKS;
    outcome->seconds /= SWEEP_TICKS;
    return ok;
}

bool Sweep_Range(const Setting* setting, bool spread, double error[2])
{
    static const int32_t grids[] = { 16, 18, 20, 23, 25 }; /* of 20 */
    static const int32_t inRows[] = { 0, 2, 3 }, byLibrary[] = { 1 };
    int32_t places = spread ? COUNT(byLibrary) : COUNT(inRows);
    error[0] = 1e30;
    error[1] = 0.0;
    for (int32_t k = 0; k < places * COUNT(grids); ++k) {
        Setting other = *setting;
        Outcome outcome;
        other.gridResolution = setting->gridResolution * grids[k / places] / 20;
        other.spread = spread ? byLibrary[k % places] : inRows[k % places];
        if (!Sweep_Run(&other, NULL, &outcome)) {
            return false;
        }
        error[0] = fmin(error[0], outcome.error);
        error[1] = fmax(error[1], outcome.error);
    }
    return true;
}
