#include "defaults.h"
#include "sweep.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

enum { MAX_VERTICES = 2048, MAX_TRIANGLES = 4096, MAX_FRAMES = 512 };

/* The rest shape, its mesh, and Young's modulus. */
typedef struct Shape {
    float length, width;
    int32_t columns, rows;
    float young;
} Shape;

static const Shape shapes[SWEEP_SCENES] = {
    { 0.2f, 0.05f, 80, 20, 5e8f },
    { 0.2f, 0.2f, 40, 40, 1e8f },
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

int Sweep_Settings(Setting settings[SWEEP_SETTINGS])
{
    static const int32_t columns[] = { 3, 5, 9, 17 }, grids[] = { 20, 40, 80 }, powers[] = { 1, 2, 4, 8, 16 };
    int count = 0;
    for (int c = 0; c < COUNT(columns); ++c) {
        for (int g = 0; g < COUNT(grids); ++g) {
            for (int i = 0; i < 2; ++i) {
                for (int s = 0; s < COUNT(powers); ++s) {
                    settings[count++] = (Setting){ SWEEP_STRIP, columns[c], 1, grids[g], powers[i], powers[s], 0 };
                }
            }
        }
    }
    return count;
}

Setting Sweep_FromQuality(int32_t scene, const kiriQuality* quality)
{
    int32_t columns = scene == SWEEP_STRIP ? quality->framesAlong : (quality->framesAlong + 1) / 2;
    return (Setting){
        scene, columns, RowsFor(scene, columns), quality->gridResolution, quality->iterations, quality->substeps, 0
    };
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
    uint32_t seed = (uint32_t)setting->moved;
    for (int i = 0; i < setting->columns * setting->rows; ++i) {
        float u = (float)(i / setting->rows) + 0.5f, v = (float)(i % setting->rows) + 0.5f;
        if (setting->moved != 0) {
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
    def.material = (kiriMaterial){ shape->young, 0.3f, 5e-4f, 1000.0f, 0.5f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.framePoints = points;
    def.frameCount = def.maxFrames = setting->columns * setting->rows; /* nothing is added */
    def.rigidWeight = 2.0f;
    def.gridResolution = setting->gridResolution;
    def.iterations = setting->iterations;
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

static bool MakeScene(Scene* scene, const Setting* setting)
{
    kiriWorldDef def = DefaultWorld();
    if (setting->columns < 1 || setting->columns * setting->rows > MAX_FRAMES ||
        kiriCreateWorld(&def, &scene->world) != KIRI_OK) {
        return false;
    }
    if (!AddSheet(scene, setting) || !Fasten(scene, setting)) {
        kiriDestroyWorld(scene->world);
        return false;
    }
    return true;
}

/* A sixtieth of a second. */
static bool Tick(const Scene* scene, const Setting* setting, kiriMesh* mesh, double* cost)
{
    kiriProfile profile;
    bool fine = kiriWorld_Tick(scene->world, 1.0f / 60.0f, setting->substeps) == KIRI_OK &&
                kiriWorld_GetProfile(scene->world, &profile) == KIRI_OK &&
                kiriSheet_GetMesh(scene->world, scene->sheet, mesh) == KIRI_OK && mesh->vertexCount <= MAX_VERTICES;
    *cost += fine ? profile.systemsSolved * setting->columns * setting->rows : 0.0;
    return fine;
}

/* ---- Comparison ------------------------------------------------------------------------------------------------- */

bool Sweep_Prepare(const Setting* setting)
{
    Scene scene;
    double cost = 0.0;
    if (!MakeScene(&scene, setting)) {
        return false;
    }
    bool ok = true;
    for (int t = 0; t < SWEEP_TICKS && ok; ++t) {
        kiriMesh mesh;
        Picture* picture = &references[setting->scene][t];
        ok = Tick(&scene, setting, &mesh, &cost);
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

bool Sweep_Run(const Setting* setting, Outcome* outcome)
{
    Scene scene;
    double error = 0.0, way = 0.0;
    *outcome = (Outcome){ 0.0, 0.0 };
    if (!MakeScene(&scene, setting)) {
        return false;
    }
    bool ok = true;
    for (int t = 0; t < SWEEP_TICKS && ok; ++t) {
        kiriMesh mesh;
        const Picture* picture = &references[setting->scene][t];
        ok = Tick(&scene, setting, &mesh, &outcome->cost) && mesh.vertexCount == picture->vertexCount;
        if (ok) {
            AddSquares(&mesh, picture->positions, &error, &way);
        }
    }
    kiriDestroyWorld(scene.world);
    outcome->error = sqrt(error / way);
    outcome->cost /= SWEEP_TICKS;
    return ok;
}

bool Sweep_Range(const Setting* setting, double error[2])
{
    static const int32_t grids[] = { 16, 18, 20, 23, 25 }; /* of 20 */
    static const int32_t moved[] = { 0, 2, 3 };
    error[0] = 1e30;
    error[1] = 0.0;
    for (int32_t k = 0; k < COUNT(moved) * COUNT(grids); ++k) {
        Setting other = *setting;
        Outcome outcome;
        other.gridResolution = setting->gridResolution * grids[k / COUNT(moved)] / 20;
        other.moved = moved[k % COUNT(moved)];
        if (!Sweep_Run(&other, &outcome)) {
            return false;
        }
        error[0] = fmin(error[0], outcome.error);
        error[1] = fmax(error[1], outcome.error);
    }
    return true;
}
