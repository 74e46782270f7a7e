/* What each feature of a scene costs where it is used, and that it costs nothing where it is not: a cloth that hangs by
   two corners, is cut by one slit and swings, with one feature changed at a time. Times are ratios to the plain sheet,
   which runs again beside each; memory is what the world holds in the end. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

#include <stdint.h>

enum { SQUARES = 64, TICKS = 126, CUT_TICK = 20, CALM_TICK = 66, RUNS = 5, HEADER = 16 };

/* ---- Memory ---- */

static int64_t liveBytes;

static void* CountAlloc(void* user, int64_t bytes)
{
    int64_t* block = malloc((size_t)bytes + HEADER);
    if (block == NULL) {
        return NULL;
    }
    *block = bytes;
    liveBytes += bytes;
    return (char*)block + HEADER;
}

static void CountFree(void* user, void* pointer)
{
    int64_t* block = (int64_t*)((char*)pointer - HEADER);
    liveBytes -= *block;
    free(block);
}

/* ---- Features ---- */

typedef struct Feature {
    const char* name;
    void (*set)(kiriSheetDef* def);
} Feature;

static void SetNothing(kiriSheetDef* def)
{
}
static void SetPoints(kiriSheetDef* def)
{
    def->collisionPoints = 400;
}
static void SetSmooth(kiriSheetDef* def)
{
    def->skinning = KIRI_SKINNING_SMOOTH;
}
static void SetNoFade(kiriSheetDef* def)
{
    def->fadeTime = 0.0f;
}
static void SetAutomatic(kiriSheetDef* def)
{
    def->frameCount = 0;
    def->frameLength = 0.2f;
}
static void SetAsleep(kiriSheetDef* def)
{
    def->sleepSpeed = 1e6f;
}
static void SetPlanar(kiriSheetDef* def)
{
    def->planar = 1;
}
static void SetAffine(kiriSheetDef* def)
{
    def->model = KIRI_MODEL_AFFINE;
}
static void SetEuler(kiriSheetDef* def)
{
    def->timeStepping = KIRI_TIME_STEPPING_EULER;
}
static void SetPaperPoints(kiriSheetDef* def)
{
    def->model = KIRI_MODEL_POINTS;
}

static const Feature features[] = {
    { "nothing (once more)", SetNothing }, { "collision points, 400", SetPoints },
    { "smooth skinning", SetSmooth },      { "without fading", SetNoFade },
    { "automatic frames", SetAutomatic },  { "asleep", SetAsleep },
    { "backward Euler", SetEuler },        { "planar", SetPlanar },
    { "affine frames", SetAffine },        { "integration points", SetPaperPoints },
};
enum { FEATURES = sizeof(features) / sizeof(features[0]) };

/* ---- Runs ---- */

typedef struct Cost {
    double tick, cut; /* s: the median of ticks long after the cut; the tick of the cut */
    double bytes;
    int32_t frames;
} Cost;

static bool MakeWorld(kiriWorld** world, kiriSheet* sheet, void (*set)(kiriSheetDef* def))
{
    kiriWorldDef worldDef = DefaultWorld();
    worldDef.alloc = CountAlloc;
    worldDef.free = CountFree;
    kiriSheetDef def = DefaultSheet();
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    def.frameCount = 25;
    def.gridResolution = 50;
    def.sleepSpeed = 0.0f;
    set(&def);
    bool fine = kiriCreateWorld(&worldDef, world) == KIRI_OK && Bench_AddSheet(*world, &def, SQUARES, sheet) &&
                Bench_PinCorners(*world, *sheet, 1.0f, 1.0f);
    return fine;
}

static double TimedTick(kiriWorld* world)
{
    double start = Bench_Clock(NULL);
    kiriWorld_Tick(world, 1.0f / 60.0f, 2);
    return Bench_Clock(NULL) - start;
}

static bool Run(void (*set)(kiriSheetDef* def), Cost* cost)
{
    SCOPED_WORLD(world) = NULL;
    kiriSheet sheet;
    SCOPED(Series, plain, Series_Free);
    if (!MakeWorld(&world, &sheet, set)) {
        return false;
    }
    for (int tick = 0; tick < TICKS; ++tick) {
        if (tick == CUT_TICK) {
            const float from[2] = { 0.3f, 0.2f }, to[4] = { 0.5f, 0.25f, 0.7f, 0.6f };
            kiriCut cut;
            kiriBeginCut(world, sheet, from, &cut);
            kiriCut_Extend(world, cut, to, 2);
            kiriCut_End(world, cut);
            cost->cut = TimedTick(world);
        } else {
            double seconds = TimedTick(world);
            if (tick >= CALM_TICK) {
                Series_Add(&plain, seconds);
            }
        }
    }
    kiriCounts counts;
    kiriSheet_GetCounts(world, sheet, &counts);
    cost->tick = Series_Median(&plain);
    cost->bytes = (double)liveBytes;
    cost->frames = counts.frames;
    return true;
}

/* A feature beside the plain sheet, in turns; the medians of their ratios. */
static bool Compare(Table* table, const Feature* feature)
{
    Series tick = { NULL, 0, 0 }, cut = { NULL, 0, 0 };
    Cost plain = { 0 }, used = { 0 };
    for (int run = 0; run < RUNS; ++run) {
        if (!Run(SetNothing, &plain) || !Run(feature->set, &used)) {
            return false;
        }
        Series_Add(&tick, used.tick / plain.tick);
        Series_Add(&cut, used.cut / plain.cut);
    }
    Table_Text(table, feature->name);
    TABLE_NUMBERS(table, used.frames, 1e3 * plain.tick, Series_Median(&tick), Series_Quantile(&tick, 0.0),
                  Series_Worst(&tick), Series_Median(&cut), plain.bytes / 1024.0, used.bytes / plain.bytes);
    Series_Free(&tick);
    Series_Free(&cut);
    return true;
}

int main(void)
{
    static const char* const columns[] = { "feature        ", "frames", "plain ms",   "tick, times",
                                           "least",           "most",   "cut, times", "plain KB",
                                           "memory, times",   NULL };
    Table table;
    Bench_WeighClock();
    bool fine =
        Table_Start(&table, "features", "What a feature costs: a hanging cloth of 4225 vertices, 25 frames", columns);
    for (int32_t i = 0; fine && i < FEATURES; ++i) {
        fine = Compare(&table, &features[i]);
    }
    return fine && Table_Stop(&table) ? 0 : 1;
}
