/* Cusick's test: a disc of 15 cm is held between two discs of 9 cm. The drape coefficient is the part of the ring that
   still casts a shadow. It is measured at 14 cm, inside the hem of squares. */
#include "trade_drape.h"

#include "defaults.h"
#include "specimen.h"
#include "springs.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { HEM = 256, SQUARES = 64, CLAMPS = 32, TICKS = 240 };

static const double RADIUS = 0.15, INNER = 0.09, MEASURED = 0.14, HOLE = 0.082, TURN = 6.283185307179586;

typedef struct Hem {
    double at[HEM][2]; /* m, from the middle, seen from above */
} Hem;

static void PointOf(int i, double radius, float at[2])
{
    at[0] = (float)(RADIUS + radius * cos(TURN * i / HEM));
    at[1] = (float)(RADIUS + radius * sin(TURN * i / HEM));
}

/* Folds are maxima of the mean radius over 13 points that stand out by 15 % of its range, and by 2 mm. */
static int CountFolds(const Hem* hem)
{
    double mean[HEM], low = HUGE_VAL, high = 0.0;
    int first = 0, folds = 0;
    for (int i = 0; i < HEM; ++i) {
        mean[i] = 0.0;
        for (int k = HEM - 6; k <= HEM + 6; ++k) {
            const double* p = hem->at[(i + k) % HEM];
            mean[i] += hypot(p[0], p[1]) / 13.0;
        }
        first = mean[i] < low ? i : first;
        low = fmin(low, mean[i]);
        high = fmax(high, mean[i]);
    }
    double least = fmax(0.15 * (high - low), 0.002), last = low;
    bool rises = true;
    for (int k = 0; k <= HEM; ++k) {
        double r = mean[(first + k) % HEM];
        bool turns = rises ? r > last + least : r < last - least;
        folds += turns && !rises;
        last = turns ? r : rises ? fmin(last, r) : fmax(last, r);
        rises = turns ? !rises : rises;
    }
    return folds;
}

static void Print(const Hem* hem)
{
    double area = 0.0;
    for (int i = 0; i < HEM; ++i) {
        const double *a = hem->at[i], *b = hem->at[(i + 1) % HEM];
        area += 0.5 * (a[0] * b[1] - b[0] * a[1]);
    }
    double whole = 0.5 * TURN * (MEASURED * MEASURED - INNER * INNER);
    printf(" %5.1f (%d)", 100.0 * (area - 0.5 * TURN * INNER * INNER) / whole, CountFolds(hem));
    fflush(stdout);
}

/* A ring without its inner part, clamped along a polygon around the smaller disc. */
static void PrintKiri(const kiriMaterial* material, int32_t frames)
{
    LatticeDef latticeDef = { 2.0 * RADIUS, 2.0 * RADIUS, 2.0 * RADIUS / SQUARES, RADIUS, HOLE, NULL, 0, 0 };
    SCOPED(Lattice, l, Lattice_Free);
    SCOPED_WORLD(world) = NULL;
    kiriSheet sheet;
    kiriPin pin;
    kiriSheetDef def = DefaultSheet();
    kiriWorldDef worldDef = DefaultWorld();
    Require(Lattice_Make(&l, &latticeDef) && kiriCreateWorld(&worldDef, &world) == KIRI_OK, "no memory");
    def.restPositions = l.rest;
    def.vertexCount = l.vertexCount;
    def.indices = l.triangles;
    def.triangleCount = l.triangleCount;
    def.material = *material;
    def.sleepSpeed = 0.0f;
    def.frameCount = def.maxFrames = frames;
    def.rigidWeight = 2.0f;
    def.gridResolution = 48;
    def.iterations = 1;
    def.skinning = KIRI_SKINNING_SMOOTH;
    Require(kiriCreateSheet(world, &def, &sheet) == KIRI_OK, "no disc");
    for (int i = 0; i < HEM; i += HEM / CLAMPS) {
        float from[2], to[2];
        PointOf(i, INNER, from);
        PointOf(i + HEM / CLAMPS, INNER, to);
        Require(kiriSheet_ClampLine(world, sheet, from, to, &pin) == KIRI_OK, "no clamp");
    }
    double start = ProcessorTime(NULL);
    for (int tick = 0; tick < TICKS; ++tick) {
        Require(kiriWorld_Tick(world, 1.0f / 60.0f, 4) == KIRI_OK, "no tick");
    }
    double seconds = ProcessorTime(NULL) - start;
    Hem hem;
    for (int i = 0; i < HEM; ++i) {
        float at[2];
        kiriPointState point;
        PointOf(i, MEASURED, at);
        Require(kiriSheet_GetPoint(world, sheet, at, &point) == KIRI_OK, "no hem");
        hem.at[i][0] = (double)point.position[0] - RADIUS;
        hem.at[i][1] = (double)point.position[1] - RADIUS;
    }
    Print(&hem);
    printf(" %.1f ms", 1e3 * seconds / TICKS);
}

static void PrintSprings(const kiriMaterial* m, int squares, int substeps)
{
    static bool fixed[32768];
    LatticeDef def = { 2.0 * RADIUS, 2.0 * RADIUS, 2.0 * RADIUS / squares, RADIUS, 0.0, NULL, 0, 0 };
    SCOPED(Lattice, l, Lattice_Free);
    double h = (double)m->thickness, stretch = (double)m->youngsModulus * h, nu = (double)m->poissonsRatio;
    SpringMaterial material = { stretch, stretch * h * h / (12.0 * (1.0 - nu * nu)), 1.0, (double)m->density * h, 2.0 };
    Require(Lattice_Make(&l, &def) && l.vertexCount <= 32768, "no memory");
    for (int i = 0; i < l.vertexCount; ++i) {
        fixed[i] = hypot((double)l.rest[2 * i] - RADIUS, (double)l.rest[2 * i + 1] - RADIUS) < INNER + 1e-6;
    }
    Springs* springs = Springs_Create(&l, &material, fixed);
    Require(springs != NULL, "no memory");
    double* x = Springs_GetPositions(springs);
    for (int i = 0; i < l.vertexCount; ++i) {
        x[3 * i + 2] += fixed[i] ? 0.0 : 5e-5 * ((double)(i * 7919 % 101) / 50.0 - 1.0); /* a side for each fold */
    }
    for (int tick = 0; tick < TICKS; ++tick) {
        Springs_Tick(springs, 1.0 / 60.0, substeps);
    }
    Hem hem;
    for (int i = 0; i < HEM; ++i) {
        float at[2];
        PointOf(i, MEASURED, at);
        double u = (double)at[0] / l.side, v = (double)at[1] / l.side;
        const int* c = l.corners + 4 * ((int)v * l.columns + (int)u);
        u -= (int)u;
        v -= (int)v;
        Require(c[0] >= 0, "the hem is outside");
        const double w[4] = { (1.0 - u) * (1.0 - v), u * (1.0 - v), u * v, (1.0 - u) * v };
        for (int axis = 0; axis < 2; ++axis) {
            hem.at[i][axis] = -RADIUS;
            for (int k = 0; k < 4; ++k) {
                hem.at[i][axis] += w[k] * x[3 * c[k] + axis];
            }
        }
    }
    Print(&hem);
    Springs_Destroy(springs);
}

void Drape_Print(void)
{
    static const char* const names[] = { "silk", "shirting", "wool", "denim", "jersey" };
    static const int32_t frames[] = { 91, 96, 99, 102, 108 };
    printf("\nDrape coefficient, %%, and folds\n");
    for (int32_t k = 0; k < (int)(sizeof names / sizeof names[0]); ++k) {
        for (int slack = 0; slack < 2; ++slack) {
            kiriMaterial material;
            kiriGetMaterial(KIRI_MATERIAL_SILK + k, &material);
            material.slack = slack ? material.slack : 0.0f;
            printf("%-9s slack %.2f, 91 to 108 frames:", names[k], (double)material.slack);
            for (int f = 0; f < (int)(sizeof frames / sizeof frames[0]); ++f) {
                PrintKiri(&material, frames[f]);
            }
            printf("\n");
        }
        kiriMaterial material;
        kiriGetMaterial(KIRI_MATERIAL_SILK + k, &material);
        printf("%-9s springs, 32 and 64 squares:", names[k]);
        PrintSprings(&material, SQUARES / 2, 240);
        PrintSprings(&material, SQUARES, 240);
        printf("\n");
    }
}
