/* A storm of cuts: blades run through many sheets at once, in waves. With a budget the work is spread over ticks, no
   tick does more than it allows, and in the end all is cut as without. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { SHEETS = 24, WAVES = 6, WAVE_TICKS = 40, TICKS = 400, POINTS = 24 };
enum { TRIANGLES, CELLS, SAMPLES, ITERATIONS, ITEMS };

typedef struct Storm {
    kiriBudget budget;
    double milliseconds; /* that cuts may take; NaN: no budget */
    Series times;        /* ms of a tick */
    int32_t most[ITEMS]; /* in one tick */
    kiriProfile sum;
    int32_t done;      /* ticks until no work waited */
    int32_t triangles; /* of all sheets, in the end */
} Storm;

static bool AddSheets(kiriWorld* world, kiriSheet sheets[SHEETS])
{
    bool fine = true;
    for (int32_t i = 0; fine && i < SHEETS; i++) {
        kiriSheetDef def = DefaultSheet();
        def.position[1] = 2.0f * (float)i;
        def.gridResolution = 48;
        def.frameCount = def.maxFrames = 12;
        def.collisionPoints = 50;
        fine = Bench_AddSheet(world, &def, 48, &sheets[i]);
    }
    return fine;
}

/* A wave from side to side of each sheet, in one tick. */
static bool Slash(kiriWorld* world, kiriSheet sheet, int32_t wave)
{
    float points[2 * POINTS];
    for (int32_t i = 0; i < POINTS; i++) {
        float along = -0.05f + 1.1f * (float)i / (POINTS - 1);
        float across = 0.1f + 0.13f * (float)wave + 0.021f * (float)(i % 3) + 0.2f * along;
        points[2 * i + wave % 2] = along;
        points[2 * i + 1 - wave % 2] = across;
    }
    kiriCut cut;
    return kiriSheet_Cut(world, sheet, points, POINTS, &cut) == KIRI_OK;
}

static void NoteTick(Storm* storm, const kiriProfile* profile)
{
    const int32_t items[ITEMS] = { profile->trianglesSplit, profile->cellsSettled, profile->samplesRefreshed,
                                   profile->solverIterations };
    for (int k = 0; k < ITEMS; k++) {
        storm->most[k] = items[k] > storm->most[k] ? items[k] : storm->most[k];
    }
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        storm->sum.seconds[k] += profile->seconds[k];
    }
    storm->sum.trianglesSplit += profile->trianglesSplit;
    storm->sum.cellsSettled += profile->cellsSettled;
    storm->sum.samplesRefreshed += profile->samplesRefreshed;
    storm->sum.commits += profile->commits;
}

static bool StormTick(kiriWorld* world, const kiriSheet sheets[SHEETS], int32_t tick, Storm* storm)
{
    bool fine = true;
    for (int32_t i = 0; fine && i < SHEETS && tick % WAVE_TICKS == 10 && tick / WAVE_TICKS < WAVES; i++) {
        fine = Slash(world, sheets[i], tick / WAVE_TICKS);
    }
    kiriProfile profile;
    const kiriEvent* events;
    int32_t count = 0;
    double start = Bench_Clock(NULL);
    fine = fine && kiriWorld_Tick(world, 1.0f / 60.0f, 2) >= 0;
    Series_Add(&storm->times, 1e3 * (Bench_Clock(NULL) - start));
    fine = fine && kiriWorld_GetProfile(world, &profile) == KIRI_OK &&
           kiriWorld_GetEvents(world, &events, &count) == KIRI_OK;
    if (fine) {
        NoteTick(storm, &profile);
    }
    for (int32_t i = 0; i < count; i++) {
        storm->done =
            events[i].type == KIRI_EVENT_DEFERRED || events[i].type == KIRI_EVENT_CUT_FINISHED ? tick : storm->done;
    }
    return fine;
}

static bool RunStorm(Storm* storm)
{
    kiriWorldDef def = Bench_WorldDef();
    def.budget = storm->budget;
    kiriWorld* world = NULL;
    kiriSheet sheets[SHEETS];
    bool fine = kiriCreateWorld(&def, &world) == KIRI_OK && AddSheets(world, sheets);
    for (int32_t tick = 0; fine && tick < TICKS; tick++) {
        fine = StormTick(world, sheets, tick, storm);
    }
    for (int32_t i = 0; fine && i < SHEETS; i++) {
        kiriCounts counts;
        fine = kiriSheet_GetCounts(world, sheets[i], &counts) == KIRI_OK;
        storm->triangles += counts.triangles;
    }
    kiriDestroyWorld(world);
    return fine;
}

static bool IsWithin(int32_t items, int32_t budget)
{
    return budget == 0 || items <= budget;
}

/* False where a tick did more than the budget. */
static bool PrintStorm(Table* table, Storm* storm)
{
    const int32_t budget[ITEMS] = { storm->budget.triangles, storm->budget.cells, storm->budget.samples,
                                    storm->budget.iterations };
    double median = Series_Median(&storm->times), worst = Series_Worst(&storm->times);
    bool fine = true;
    TABLE_NUMBERS(table, storm->milliseconds, median, Series_Quantile(&storm->times, 0.95), worst, worst / median);
    for (int k = 0; k < ITEMS; k++) {
        bool within = IsWithin(storm->most[k], budget[k]);
        Table_Judge(table, storm->most[k], within);
        Table_Number(table, budget[k] > 0 ? budget[k] : (double)NAN);
        fine = fine && within;
    }
    TABLE_NUMBERS(table, storm->sum.commits, storm->done);
    return fine;
}

/* The budget that does the work of the whole storm in so many ticks. */
static bool FitBudget(Storm* storm, const Storm* without, int32_t ticks)
{
    double seconds = 0.0;
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        seconds += without->sum.seconds[k];
    }
    storm->milliseconds = 1e3 * seconds / ticks;
    return kiriFitBudget(&without->sum, (float)(1e3 * storm->milliseconds), &storm->budget) == KIRI_OK;
}

static bool BenchStorms(Table* table)
{
    static const struct {
        int32_t ticks; /* for all cuts; 0: no budget */
        int32_t iterations;
    } cases[] = { { 0, 0 }, { 60, 0 }, { 240, 0 }, { 240, 2 * SHEETS } };
    Storm storms[sizeof cases / sizeof cases[0]] = { { .milliseconds = (double)NAN } };
    bool fine = true;
    for (size_t i = 0; fine && i < sizeof cases / sizeof cases[0]; i++) {
        Storm* storm = &storms[i];
        storm->budget.iterations = cases[i].iterations;
        fine = (cases[i].ticks == 0 || FitBudget(storm, &storms[0], cases[i].ticks)) && RunStorm(storm) &&
               PrintStorm(table, storm) && storm->triangles == storms[0].triangles;
        Series_Free(&storm->times);
    }
    return fine;
}

int main(void)
{
    static const char* const columns[] = { "budget ms", "tick",    "95 %",      "worst",   "worst/median", "triangles",
                                           "allowed",   "cells",   "allowed",   "samples", "allowed",      "iterations",
                                           "allowed",   "commits", "last tick", NULL };
    static const char title[] =
        "24 sheets, each cut from side to side every 40 ticks: ms of a tick, median, 95 % and "
        "worst; the most items of work in a\ntick, and what the budget allows: as many as take so "
        "many ms at the pace without a budget; when the last cut was done.\nAim: never more items "
        "than allowed.";
    Table table;
    Bench_WeighClock();
    bool fine = Table_Start(&table, "storm", title, columns) && BenchStorms(&table) && Table_Stop(&table);
    return Bench_End(fine, "bench_storm: more work than the budget allows, other triangles than without, or an error");
}
