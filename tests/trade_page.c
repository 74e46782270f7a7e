/* What accuracy costs, on one page: five materials in four scenes, Kiri's settings and presets, and springs
   (springs.h). Writes trade.csv (drawn by plot_trade.py), and prints how cloths drape (trade_drape.h).

   Sheets are level at first, and let go: they fall and swing for 0.4 s at 60 ticks a second. The error is the rms
   distance from the reference by the rms way of the reference, over points 2 cm apart and all ticks. The reference is a
   much finer run of Kiri. Its own error is the largest of three differences: from runs with half the substeps, with
   half the frames along, and from springs that are much finer too. Poisson's ratio is 0. */
#include "defaults.h"
#include "frame_layout.h"
#include "specimen.h"
#include "springs.h"
#include "trade_drape.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define COUNT(array) ((int)(sizeof(array) / sizeof((array)[0])))

enum { TICKS = 24, MAX_SAMPLES = 11 * 11, MAX_VERTICES = 32768, MAX_RESULTS = 64 };

static const double PITCH = 0.02, DAMPING = 1.0; /* m, between samples; 1/s */
/* Springs are so soft that a hanging sheet stretches by this at least: stiffer ones tremble, and are less accurate. */
static const double STRAIN = 2e-5, GRAVITY = 9.81;

/* ---- Scenes and materials --------------------------------------------------------------------------------------- */

typedef struct Scene {
    const char* name;
    double length, width; /* m */
    bool byCorners;       /* else clamped along u = 0 */
    bool spread;          /* frames where the library puts them; else in rows */
    int slitPoints;
    double slit[7][2];
} Scene;

static const Scene scenes[] = {
    { "strip", 0.2, 0.04, false, false, 0, { { 0.0 } } },
    { "square", 0.2, 0.2, true, false, 0, { { 0.0 } } },
    { "slit flap", 0.2, 0.2, false, true, 2, { { 0.1, 0.04 }, { 0.1, 0.16 } } },
    { "spiral",
      0.2,
      0.2,
      false,
      true,
      7,
      { { 0.04, 0.0 },
        { 0.04, 0.16 },
        { 0.16, 0.16 },
        { 0.16, 0.04 },
        { 0.08, 0.04 },
        { 0.08, 0.12 },
        { 0.12, 0.12 } } },
};

static const char* const stuffs[] = { "paper", "foil", "rubber", "cotton", "silk" };

/* Elastic, with Poisson's ratio 0 and the bending stiffness of the preset. Silk: a light plain weave. */
static kiriMaterial MaterialOf(int stuff)
{
    static const int32_t presets[] = { KIRI_MATERIAL_PAPER, KIRI_MATERIAL_FOIL, KIRI_MATERIAL_RUBBER,
                                       KIRI_MATERIAL_COTTON };
    kiriMaterial m;
    if (stuff < COUNT(presets)) {
        kiriGetMaterial(presets[stuff], &m);
    } else {
        m = (kiriMaterial){ 2.6e7f, 0.0f, 1e-4f, 400.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    }
    m.youngsModulus /= 1.0f - m.poissonsRatio * m.poissonsRatio;
    m.poissonsRatio = m.flexDamping = m.yieldStress = m.hardening = 0.0f;
    m.airDamping = (float)DAMPING;
    m.detail = 0;
    return m;
}

/* ---- Samples ---------------------------------------------------------------------------------------------------- */

/* The vertex at each multiple of PITCH; -1 on slits, where there are two. */
typedef struct Samples {
    int count, vertices[MAX_SAMPLES];
} Samples;

typedef struct Film {
    double at[TICKS][MAX_SAMPLES][3];
} Film;

static Film reference, film;

static void FindSamples(const Scene* scene, const Lattice* l, Samples* samples)
{
    int rows = (int)(scene->width / PITCH + 1.5), columns = (int)(scene->length / PITCH + 1.5),
        found[MAX_SAMPLES] = { 0 };
    samples->count = rows * columns;
    for (int i = 0; i < l->vertexCount; ++i) {
        double u = (double)l->rest[2 * i] / PITCH, v = (double)l->rest[2 * i + 1] / PITCH;
        int column = (int)(u + 0.5), row = (int)(v + 0.5);
        if (u > -0.5 && fabs(u - column) < 1e-3 && fabs(v - row) < 1e-3) {
            int k = row * columns + column;
            samples->vertices[k] = found[k]++ == 0 ? i : -1;
        }
    }
}

static double Compare(const Scene* scene, const Samples* samples)
{
    double error = 0.0, way = 0.0;
    int columns = (int)(scene->length / PITCH + 1.5);
    for (int t = 0; t < TICKS; ++t) {
        for (int k = 0; k < samples->count; ++k) {
            double rest[3] = { k % columns * PITCH, k / columns * PITCH, 0.0 };
            for (int c = 0; c < 3 && samples->vertices[k] >= 0; ++c) {
                double off = film.at[t][k][c] - reference.at[t][k][c], moved = reference.at[t][k][c] - rest[c];
                error += off * off;
                way += moved * moved;
            }
        }
    }
    return error < HUGE_VAL ? sqrt(error / way) : HUGE_VAL;
}

/* ---- Runs ------------------------------------------------------------------------------------------------------- */

typedef struct Result {
    const char* method; /* "kiri", "springs" */
    const char* preset; /* or "" */
    int size;           /* frames, or squares along */
    int columns, substeps, grid;
    double error, milliseconds;
} Result;

static LatticeDef DefOf(const Scene* scene, double side)
{
    LatticeDef def = { scene->length, scene->width, side, 0.0, 0.0, scene->slit, scene->slitPoints, 0 };
    return def;
}

static void Hold(kiriWorld* world, kiriSheet sheet, const Scene* scene)
{
    kiriPin pin;
    const float from[2] = { 0.0f, 0.0f }, to[2] = { 0.0f, (float)scene->width };
    for (int k = 0; k < 2 && scene->byCorners; ++k) {
        kiriPinDef def = DefaultPin();
        def.restPoint[1] = def.target[1] = k == 0 ? from[1] : to[1];
        Require(kiriCreatePin(world, sheet, &def, &pin) == KIRI_OK, "no pin");
    }
    Require(scene->byCorners || kiriSheet_ClampLine(world, sheet, from, to, &pin) == KIRI_OK, "no clamp");
}

/* Runs the sheet into `into`; returns ms a tick, or -1 where the frames are refused. */
static double RunKiri(const Scene* scene, const kiriMaterial* material, const Result* setting, Film* into)
{
    static Layout layout;
    LatticeDef latticeDef = DefOf(scene, scene->length / 40.0);
    Lattice l;
    Samples samples;
    kiriWorld* world;
    kiriSheet sheet;
    kiriSheetDef def = DefaultSheet();
    double seconds = 0.0;
    Require(Lattice_Make(&l, &latticeDef), "no memory");
    FindSamples(scene, &l, &samples);
    kiriWorldDef worldDef = DefaultWorld();
    worldDef.clock = ProcessorTime;
    Require(kiriCreateWorld(&worldDef, &world) == KIRI_OK, "no world");
    def.restPositions = l.rest;
    def.vertexCount = l.vertexCount;
    def.indices = l.triangles;
    def.triangleCount = l.triangleCount;
    def.material = *material;
    def.sleepSpeed = 0.0f;
    def.frameCount = def.maxFrames = setting->size;
    if (!scene->spread) {
        Layout_Make(&layout, LAYOUT_ROWS, scene->length, scene->width, setting->columns,
                    setting->size / setting->columns);
        def.framePoints = layout.points;
    }
    def.rigidWeight = 2.0f;
    def.gridResolution = setting->grid;
    def.iterations = 1;
    def.skinning = KIRI_SKINNING_SMOOTH;
    if (kiriCreateSheet(world, &def, &sheet) != KIRI_OK) {
        kiriDestroyWorld(world);
        Lattice_Free(&l);
        return -1.0;
    }
    Hold(world, sheet, scene);
    for (int t = 0; t < TICKS; ++t) {
        kiriMesh mesh;
        kiriProfile profile;
        Require(kiriWorld_Tick(world, 1.0f / 60.0f, setting->substeps) == KIRI_OK, "no tick");
        kiriWorld_GetProfile(world, &profile);
        seconds += profile.seconds[KIRI_STAGE_SOLVE] + profile.seconds[KIRI_STAGE_SKIN];
        kiriSheet_GetMesh(world, sheet, &mesh);
        for (int k = 0; k < 3 * samples.count; ++k) {
            int vertex = samples.vertices[k / 3];
            into->at[t][k / 3][k % 3] = vertex < 0 ? 0.0 : (double)mesh.positions[3 * vertex + k % 3];
        }
    }
    kiriDestroyWorld(world);
    Lattice_Free(&l);
    return 1e3 * seconds / TICKS;
}

/* The same with springs. */
static double RunSprings(const Scene* scene, const kiriMaterial* m, const Result* setting, Film* into)
{
    static bool fixed[MAX_VERTICES];
    LatticeDef def = DefOf(scene, scene->length / setting->size);
    SCOPED(Lattice, l, Lattice_Free);
    Samples samples;
    double h = (double)m->thickness, mass = (double)m->density * h, stretch = (double)m->youngsModulus * h;
    SpringMaterial material = { fmin(stretch, mass * GRAVITY * scene->length / STRAIN), stretch * h * h / 12.0, 1.0,
                                mass, DAMPING };
    double seconds = 0.0;
    def.ghosts = scene->byCorners ? 0 : 1;
    Require(Lattice_Make(&l, &def) && l.vertexCount <= MAX_VERTICES, "no memory");
    FindSamples(scene, &l, &samples);
    for (int i = 0; i < l.vertexCount; ++i) {
        double u = (double)l.rest[2 * i], v = (double)l.rest[2 * i + 1];
        fixed[i] = u < 1e-6 && (!scene->byCorners || v < 1e-6 || v > scene->width - 1e-6);
    }
    Springs* springs = Springs_Create(&l, &material, fixed);
    Require(springs != NULL, "no memory");
    for (int t = 0; t < TICKS; ++t) {
        double start = ProcessorTime(NULL);
        Springs_Tick(springs, 1.0 / 60.0, setting->substeps);
        seconds += ProcessorTime(NULL) - start;
        for (int k = 0; k < 3 * samples.count; ++k) {
            int vertex = samples.vertices[k / 3];
            into->at[t][k / 3][k % 3] = vertex < 0 ? 0.0 : Springs_GetPositions(springs)[3 * vertex + k % 3];
        }
    }
    Springs_Destroy(springs);
    return 1e3 * seconds / TICKS;
}

static Samples SamplesOf(const Scene* scene)
{
    LatticeDef def = DefOf(scene, scene->length / 40.0);
    SCOPED(Lattice, l, Lattice_Free);
    Samples samples;
    Require(Lattice_Make(&l, &def), "no memory");
    FindSamples(scene, &l, &samples);
    return samples;
}

/* The shortest time of two runs: others use the machine too. */
static bool Measure(const Scene* scene, const kiriMaterial* material, Result* result)
{
    Samples samples = SamplesOf(scene);
    result->milliseconds = HUGE_VAL;
    for (int k = 0; k < 2; ++k) {
        double ms = (result->method[0] == 'k' ? RunKiri : RunSprings)(scene, material, result, &film);
        if (ms < 0.0) {
            return false;
        }
        result->milliseconds = fmin(result->milliseconds, ms);
    }
    result->error = 100.0 * Compare(scene, &samples);
    return true;
}

/* ---- The page --------------------------------------------------------------------------------------------------- */

/* Results of one material in one scene. */
typedef struct Sheet {
    char title[64];
    Result results[MAX_RESULTS];
    int count;
    double noise; /* %, of the reference */
} Sheet;

static Sheet sheets[COUNT(scenes) * COUNT(stuffs)];
static const int springSizes[] = { 10, 20, 40 };

static Result KiriSetting(const Scene* scene, int columns, int substeps, int grid, const char* preset)
{
    Result r = { "kiri", preset, columns * (scene->width < scene->length ? 1 : columns), columns, substeps, grid,
                 0.0,    0.0 };
    return r;
}

/* %: how far a run is from the reference. */
static double Differ(const Scene* scene, const kiriMaterial* material, const Result* other)
{
    Samples samples = SamplesOf(scene);
    double ms = (other->method[0] == 'k' ? RunKiri : RunSprings)(scene, material, other, &film);
    Require(ms >= 0.0, "a reference is refused");
    return 100.0 * Compare(scene, &samples);
}

/* Returns its error, %: the largest difference from runs with half the substeps, with half the frames along, and from
   the nearer one of two runs of springs in short steps, on coarse and on fine squares. */
static double MakeReference(const Scene* scene, const kiriMaterial* material)
{
    int columns = scene->width < scene->length ? 65 : 17;
    Result finest = KiriSetting(scene, columns, 64, 160, "");
    Result slower = KiriSetting(scene, columns, 32, 160, ""), fewer = KiriSetting(scene, columns / 2 + 1, 64, 160, "");
    Result coarse = { "springs", "", 20, 0, 960, 0, 0.0, 0.0 }, fine = { "springs", "", 40, 0, 960, 0, 0.0, 0.0 };
    Require(RunKiri(scene, material, &finest, &reference) >= 0.0, "the reference is refused");
    double own = fmax(Differ(scene, material, &slower), Differ(scene, material, &fewer));
    double others = fmin(Differ(scene, material, &coarse), Differ(scene, material, &fine));
    return fmax(own, others);
}

static void AddResult(Sheet* sheet, const Scene* scene, const kiriMaterial* material, Result result)
{
    if (sheet->count < MAX_RESULTS && Measure(scene, material, &result)) {
        sheet->results[sheet->count++] = result;
    }
}

static void MeasureAll(Sheet* sheet, const Scene* scene, const kiriMaterial* material)
{
    static const char* const names[KIRI_QUALITY_COUNT] = { "fast", "balanced", "accurate" };
    static const int alongStrip[] = { 3, 5, 9, 17, 33 }, alongSquare[] = { 3, 4, 5, 7, 9, 12 };
    bool isStrip = scene->width < scene->length;
    sheet->noise = MakeReference(scene, material);
    for (int f = 0; f < (isStrip ? COUNT(alongStrip) : COUNT(alongSquare)); ++f) {
        for (int substeps = 1; substeps <= 16; substeps *= 2) {
            int columns = isStrip ? alongStrip[f] : alongSquare[f];
            AddResult(sheet, scene, material, KiriSetting(scene, columns, substeps, columns > 17 ? 80 : 40, ""));
        }
    }
    for (int32_t p = 0; p < KIRI_QUALITY_COUNT; ++p) {
        kiriQuality q;
        kiriGetQuality(p, &q);
        int columns = isStrip ? q.framesAlong : (q.framesAlong + 1) / 2;
        AddResult(sheet, scene, material, KiriSetting(scene, columns, q.substeps, q.gridResolution, names[p]));
    }
    for (int k = 0; k < COUNT(springSizes); ++k) {
        static const int substeps[] = { 5, 15, 60, 240 };
        for (int s = 0; s < COUNT(substeps); ++s) {
            Result result = { "springs", "", springSizes[k], 0, substeps[s], 0, 0.0, 0.0 };
            AddResult(sheet, scene, material, result);
        }
    }
}

static bool WriteTable(const char* folder)
{
    char path[512];
    snprintf(path, sizeof path, "%s/trade.csv", folder);
    FILE* file = fopen(path, "w");
    if (file == NULL) {
        return false;
    }
    fprintf(file, "scene and material,method,frames or squares along,grid,substeps,preset,error %%,ms a tick,"
                  "error of the reference %%\n");
    for (int s = 0; s < COUNT(sheets); ++s) {
        for (int k = 0; k < sheets[s].count; ++k) {
            const Result* r = &sheets[s].results[k];
            fprintf(file, "%s,%s,%d,%d,%d,%s,%.4g,%.3g,%.2g\n", sheets[s].title, r->method, r->size, r->grid,
                    r->substeps, r->preset, r->error, r->milliseconds, sheets[s].noise);
        }
    }
    return fclose(file) == 0;
}

/* trade [output folder] */
int main(int argc, char** argv)
{
    const char* folder = argc > 1 ? argv[1] : "build/accuracy";
    for (int k = 0; k < COUNT(sheets); ++k) {
        const Scene* scene = &scenes[k / COUNT(stuffs)];
        kiriMaterial material = MaterialOf(k % COUNT(stuffs));
        snprintf(sheets[k].title, sizeof sheets[k].title, "%s of %s", scene->name, stuffs[k % COUNT(stuffs)]);
        MeasureAll(&sheets[k], scene, &material);
        printf("%-20s reference to %.2g %%:", sheets[k].title, sheets[k].noise);
        for (int r = 0; r < sheets[k].count; ++r) {
            const Result* result = &sheets[k].results[r];
            if (result->preset[0] != '\0') {
                printf("  %s %.3g %% at %.3g ms", result->preset, result->error, result->milliseconds);
            }
        }
        printf("\n");
        fflush(stdout);
    }
    Require(WriteTable(folder), "cannot write the results");
    Drape_Print();
    return 0;
}
