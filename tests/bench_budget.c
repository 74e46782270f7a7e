/* The scenes with and without a budget: the worst tick while a blade cuts, and what it costs in delay. */
#define _POSIX_C_SOURCE 199309L

#include "../samples/scene.h"
#include "bench.h"

enum { RUNS = 3, MAX_TICKS = 1536, CELLS_ALLOWED = 10000, SAMPLES_ALLOWED = 2000 };
enum { CELLS, SAMPLES, ITEMS };

/* For all scenes: what keeps a tick near 2 ms. Triangles are few, and linear systems as many in each tick anyway. */
static const kiriBudget sceneBudget = { .cells = CELLS_ALLOWED, .samples = SAMPLES_ALLOWED };

typedef struct Course {
    float times[MAX_TICKS][RUNS]; /* ms of a tick */
    int32_t most[ITEMS];          /* in one tick */
    int32_t lastCommit;           /* the tick */
    kiriCounts end;
} Course;

static void Note(Course* course, int32_t tick, const kiriProfile* profile)
{
    const int32_t items[ITEMS] = { profile->cellsSettled, profile->samplesRefreshed };
    for (int k = 0; k < ITEMS; k++) {
        course->most[k] = items[k] > course->most[k] ? items[k] : course->most[k];
    }
    course->lastCommit = profile->commits > 0 ? tick : course->lastCommit;
}

/* Whether work waits for the next tick. */
static bool IsBehind(const kiriWorld* world)
{
    const kiriEvent* events;
    int32_t count = 0;
    bool behind = false;
    kiriWorld_GetEvents(world, &events, &count);
    for (int32_t i = 0; i < count; i++) {
        behind = behind || events[i].type == KIRI_EVENT_DEFERRED;
    }
    return behind;
}

/* To the end of the scene, and on until nothing waits. */
static bool RunOnce(Course* course, const SceneType* type, const kiriBudget* budget, int run)
{
    const SceneOptions options = { .asPaper = true };
    kiriWorldDef def = Bench_WorldDef();
    def.budget = *budget;
    Scene scene;
    bool fine = Scene_Start(&scene, type, &def, &options);
    for (int32_t i = 0; fine && i < MAX_TICKS && (i < type->ticks || IsBehind(scene.world)); i++) {
        kiriProfile profile;
        double start = Bench_Clock(NULL);
        fine = Scene_Tick(&scene) >= 0;
        course->times[i][run] = (float)(1e3 * (Bench_Clock(NULL) - start));
        fine = fine && kiriWorld_GetProfile(scene.world, &profile) == KIRI_OK;
        if (fine) {
            Note(course, i, &profile);
        }
    }
    fine = fine && kiriSheet_GetCounts(scene.world, scene.sheet, &course->end) == KIRI_OK;
    Scene_Stop(&scene);
    return fine;
}

/* Of the ticks from the first cut to the last commit; of each the median over the runs. */
static Series TimesOf(const Course* course, const SceneType* type)
{
    Series series = { .number = NULL };
    for (int32_t i = type->firstCut; i <= course->lastCommit; i++) {
        Series runs = { .number = NULL };
        for (int run = 0; run < RUNS; run++) {
            Series_Add(&runs, course->times[i][run]);
        }
        Series_Add(&series, Series_Median(&runs));
        Series_Free(&runs);
    }
    return series;
}

static void PrintTimes(Table* table, const Course* course, const SceneType* type, bool judged)
{
    Series series = TimesOf(course, type);
    double worst = Series_Worst(&series);
    Table_Number(table, Series_Median(&series));
    Table_Judge(table, worst, !judged || worst <= 2.0);
    Series_Free(&series);
}

static bool IsSameEnd(const kiriCounts* left, const kiriCounts* right)
{
    return left->frames == right->frames && left->cells == right->cells && left->links == right->links &&
           left->pieces == right->pieces && left->triangles == right->triangles;
}

/* False where a tick did more than the budget, or the end is another. */
static bool PrintScene(Table* table, const SceneType* type, const Course* without, const Course* with)
{
    const int32_t allowed[ITEMS] = { sceneBudget.cells, sceneBudget.samples };
    bool same = IsSameEnd(&without->end, &with->end), fine = same;
    Table_Text(table, type->name);
    PrintTimes(table, without, type, false);
    PrintTimes(table, with, type, true);
    Table_Number(table, with->lastCommit - without->lastCommit);
    for (int k = 0; k < ITEMS; k++) {
        bool within = with->most[k] <= allowed[k];
        Table_Number(table, without->most[k]);
        Table_Judge(table, with->most[k], within);
        Table_Number(table, allowed[k]);
        fine = fine && within;
    }
    Table_Number(table, with->end.frames);
    Table_Number(table, with->end.cells);
    Table_Number(table, with->end.links);
    Table_Text(table, same ? "yes" : "no*");
    return fine;
}

static bool BenchScene(Table* table, const SceneType* type)
{
    static Course courses[2];
    static const kiriBudget none = { 0 };
    memset(courses, 0, sizeof courses);
    bool fine = true;
    for (int run = 0; fine && run < RUNS; run++) {
        fine = RunOnce(&courses[0], type, &none, run) && RunOnce(&courses[1], type, &sceneBudget, run);
    }
    return fine && PrintScene(table, type, &courses[0], &courses[1]);
}

int main(void)
{
    static const char* const columns[] = { "scene     ", "without", "worst",   "with",     "worst", "later",
                                           "cells",      "with",    "allowed", "samples",  "with",  "allowed",
                                           "frames",     "cells",   "links",   "same end", NULL };
    static const char title[] =
        "Scenes without and with a budget, one for all: ms of a tick while a blade cuts, median and worst; how many "
        "ticks later the\nlast cut took effect; the most items of work in a tick, without and with, and what the "
        "budget allows; frames, cells and links\nin the end, and whether they, triangles and pieces are as many as "
        "without. Aims: the worst tick 2 ms; never more than allowed.";
    Table table;
    Bench_WeighClock();
    bool fine = Table_Start(&table, "budget", title, columns);
    for (int32_t i = 0; fine && Scene_GetType(i) != NULL; i++) {
        fine = BenchScene(&table, Scene_GetType(i));
    }
    fine = Table_Stop(&table) && fine;
    if (!fine) {
        fprintf(stderr, "bench_budget: more work than the budget allows, another end than without, or an error\n");
    }
    return fine ? 0 : 1;
}
