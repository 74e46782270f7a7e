#include "sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

enum {
    COLUMNS = 80,
    ROWS = 20,
    VERTICES = (COLUMNS + 1) * (ROWS + 1),
    TRIANGLES = 2 * COLUMNS * ROWS,
    MAX_FRAMES = 512
};

static const float LENGTH = 0.2f, WIDTH = 0.05f;

/* Backward Euler is of first order: it takes steps much shorter than any setting's to know where the strip is. */
const Setting sweepReference = { 33, 1, 160, 2, 64, 8, KIRI_MODEL_LINKS };

static float reference[SWEEP_TICKS][3 * VERTICES];

/* ---- Settings --------------------------------------------------------------------------------------------------- */

/* Affine frames want more iterations than rigid ones in stiff paper. */
static int AddModel(Setting* settings, int32_t model)
{
    static const int32_t columns[] = { 5, 9, 17 }, substeps[] = { 1, 4, 16 };
    int count = 0;
    for (int c = 0; c < COUNT(columns); ++c) {
        for (int s = 0; s < COUNT(substeps); ++s) {
            Setting setting = { columns[c], 1, 40, 8, substeps[s], 1, model };
            settings[count++] = setting;
        }
    }
    return count;
}

int Sweep_Settings(Setting settings[SWEEP_SETTINGS], bool thin)
{
    static const int32_t columns[] = { 3, 5, 9, 17 }, grids[] = { 20, 40, 80 }, powers[] = { 1, 2, 4, 8, 16 };
    int count = 0;
    for (int c = 0; c < COUNT(columns); ++c) {
        for (int g = 0; g < COUNT(grids); ++g) {
            for (int i = 0; i < 4; ++i) {
                for (int s = 0; s < COUNT(powers); ++s) {
                    bool keep = !thin || i < 2;
                    Setting setting = { columns[c], 1, grids[g], powers[i], powers[s], 1, KIRI_MODEL_LINKS };
                    settings[count] = setting;
                    count += keep ? 1 : 0;
                }
            }
        }
    }
    if (!thin) {
        count += AddModel(&settings[count], KIRI_MODEL_AFFINE);
        count += AddModel(&settings[count], KIRI_MODEL_POINTS);
    }
    return count;
}

Setting Sweep_FromQuality(const kiriQuality* quality)
{
    Setting setting = { quality->framesAlong, 1, quality->gridResolution, quality->iterations,
                        quality->substeps,    1, KIRI_MODEL_LINKS };
    return setting;
}

int Sweep_Dominating(const Setting* settings, const Outcome* outcomes, int count, const Setting* setting,
                     const Outcome* outcome)
{
    for (int i = 0; i < count; ++i) {
        if (outcomes[i].error < outcome->error && outcomes[i].cost <= outcome->cost &&
            settings[i].gridResolution <= setting->gridResolution) {
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

static bool AddStrip(Scene* scene, const Setting* setting)
{
    static float rest[2 * VERTICES], points[2 * MAX_FRAMES];
    static int32_t indices[3 * TRIANGLES];
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.sleepSpeed = 0.0f;
    kiriFillRectangle(LENGTH, WIDTH, COLUMNS, ROWS, rest, indices);
    for (int i = 0; i < setting->columns * setting->rows; ++i) {
        points[2 * i] = LENGTH * (float)(i / setting->rows) / (float)(setting->columns - 1);
        points[2 * i + 1] = WIDTH * ((float)(i % setting->rows) + 0.5f) / (float)setting->rows;
    }
    def.restPositions = rest;
    def.vertexCount = VERTICES;
    def.indices = indices;
    def.triangleCount = TRIANGLES;
    def.material = (kiriMaterial){ 5e8f, 0.3f, 5e-4f, 1000.0f, 0.5f, 0.0f };
    def.framePoints = points;
    def.frameCount = def.maxFrames = setting->columns * setting->rows; /* nothing is added */
    def.rigidWeight = 2.0f;
    def.gridResolution = setting->gridResolution;
    def.iterations = setting->iterations;
    def.model = setting->model;
    return kiriCreateSheet(scene->world, &def, &scene->sheet) == KIRI_OK;
}

static bool HoldFirst(const Scene* scene, const Setting* setting)
{
    static const float flat[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    kiriFrame ids[MAX_FRAMES];
    int32_t count, held = 0;
    kiriSheet_GetFrames(scene->world, scene->sheet, ids, MAX_FRAMES, &count);
    for (int i = 0; i < count; ++i) {
        kiriFrameState state;
        if (kiriFrame_GetState(scene->world, ids[i], &state) == KIRI_OK && state.restPoint[0] < 1e-6f) {
            held += kiriFrame_Hold(scene->world, ids[i], state.position, flat) == KIRI_OK ? 1 : 0;
        }
    }
    return count == setting->columns * setting->rows && held == setting->rows;
}

static bool MakeScene(Scene* scene, const Setting* setting, kiriClockFn* clock, Outcome* outcome)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.clock = clock;
    if (setting->columns < 2 || setting->columns * setting->rows > MAX_FRAMES ||
        kiriCreateWorld(&def, &scene->world) != KIRI_OK) {
        return false;
    }
    double start = clock != NULL ? clock(NULL) : 0.0;
    bool added = AddStrip(scene, setting);
    outcome->create = clock != NULL ? clock(NULL) - start : 0.0;
    if (!added || !HoldFirst(scene, setting)) {
        kiriDestroyWorld(scene->world);
        return false;
    }
    return true;
}

/* A sixtieth of a second. */
static bool Tick(const Scene* scene, const Setting* setting, Outcome* outcome)
{
    for (int k = 0; k < setting->parts; ++k) {
        kiriProfile profile;
        if (kiriWorld_Tick(scene->world, 1.0f / 60.0f / (float)setting->parts, setting->substeps) != KIRI_OK) {
            return false;
        }
        kiriWorld_GetProfile(scene->world, &profile);
        double frames = setting->columns * setting->rows * (setting->model == KIRI_MODEL_LINKS ? 1.0 : 8.0);
        outcome->cost += profile.solverIterations * frames;
        outcome->seconds += profile.seconds[KIRI_STAGE_SOLVE] + profile.seconds[KIRI_STAGE_SKIN];
    }
    return true;
}

/* ---- Comparison ------------------------------------------------------------------------------------------------- */

bool Sweep_Prepare(const Setting* setting)
{
    Scene scene;
    Outcome ignored = { 0.0, 0.0, 0.0, 0.0 };
    bool ok = MakeScene(&scene, setting, NULL, &ignored);
    if (!ok) {
        return false;
    }
    for (int t = 0; t < SWEEP_TICKS && ok; ++t) {
        kiriMesh mesh;
        ok = Tick(&scene, setting, &ignored) && kiriSheet_GetMesh(scene.world, scene.sheet, &mesh) == KIRI_OK &&
             mesh.vertexCount == VERTICES;
        if (ok) {
            memcpy(reference[t], mesh.positions, sizeof reference[t]);
        }
    }
    kiriDestroyWorld(scene.world);
    return ok;
}

static void AddSquares(const kiriMesh* mesh, const float* expected, double* error, double* way)
{
    for (int i = 0; i < 3 * VERTICES; ++i) {
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
        ok = Tick(&scene, setting, outcome) && kiriSheet_GetMesh(scene.world, scene.sheet, &mesh) == KIRI_OK &&
             mesh.vertexCount == VERTICES;
        if (ok) {
            AddSquares(&mesh, reference[t], &error, &way);
        }
    }
    kiriDestroyWorld(scene.world);
    outcome->error = sqrt(error / way);
    outcome->cost /= SWEEP_TICKS;
    outcome->seconds /= SWEEP_TICKS;
    return ok;
}
