/* What a second worker saves: ticks of many sheets on the floor, of many in a heap, and of one large sheet, of which
   almost all is skinning. Times are of the wall, for the time of one thread says nothing here: the least of several
   runs of the same ticks. */
#define _POSIX_C_SOURCE 200809L

#include "bench.h"
#include "crew.h"

enum { MOST_WORKERS = 2, TICKS = 30, WARM_TICKS = 10, RUNS = 3 };

static void* StartTask(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* context)
{
    Crew_Begin(user, task, itemCount, minRange, context);
    return user;
}

static void FinishTask(void* user, void* handle)
{
    Crew_Finish(user);
}

/* ---- Rows ---- */

typedef struct Row {
    const char* name;
    int32_t sheets, squares, frames;
    bool isHeap; /* sheets lie over each other, and touch */
} Row;

static const Row rows[] = {
    { "on the floor", 64, 24, 9, false },
    { "in heaps of 4", 64, 24, 9, true },
    { "in the air", 1, 255, 25, false },
};

static bool Build(kiriWorld* world, const Row* row)
{
    kiriObstacle obstacle;
    bool fine = true;
    kiriObstacleDef floor = ObstacleOf(KIRI_OBSTACLE_PLANE);
    floor.position[2] = row->sheets > 1 ? 0.0f : -1000.0f;
    fine = kiriCreateObstacle(world, &floor, &obstacle) == KIRI_OK;
    for (int32_t i = 0; fine && i < row->sheets; i++) {
        kiriSheet sheet;
        int32_t spot = row->isHeap ? i / 4 : i, layer = row->isHeap ? i % 4 : 0;
        kiriSheetDef def = DefaultSheet();
        def.frameCount = row->frames;
        def.sleepSpeed = 0.0f;
        def.touchesSheets = row->isHeap;
        def.position[0] = 1.3f * (float)(spot % 8) + 0.1f * (float)layer;
        def.position[1] = 1.3f * (float)(spot / 8);
        def.position[2] = 0.02f + 0.02f * (float)layer;
        fine = Bench_AddSheet(world, &def, row->squares, &sheet);
    }
    return fine;
}

static double WallClock(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* Seconds of each tick, where they are less than what is there; 0 workers: without hooks. */
static bool Run(const Row* row, int32_t workers, double* seconds, uint64_t* hash)
{
    Crew crew;
    SCOPED_WORLD(world) = NULL;
    kiriWorldDef def = DefaultWorld();
    def.startTask = workers > 0 ? StartTask : NULL;
    def.finishTask = workers > 0 ? FinishTask : NULL;
    def.workerCount = workers;
    def.user = &crew;
    bool fine = Crew_Start(&crew, workers) && kiriCreateWorld(&def, &world) == KIRI_OK && Build(world, row);
    for (int32_t i = 0; fine && i < WARM_TICKS + TICKS; i++) {
        double start = WallClock();
        fine = kiriWorld_Tick(world, 1.0f / 60.0f, 2) == KIRI_OK;
        double took = WallClock() - start;
        if (i >= WARM_TICKS && took < seconds[i - WARM_TICKS]) {
            seconds[i - WARM_TICKS] = took;
        }
    }
    fine = fine && kiriWorld_GetStateHash(world, hash) == KIRI_OK;
    Crew_Stop(&crew);
    return fine;
}

static double MeanOf(const double* seconds)
{
    double sum = 0.0;
    for (int i = 0; i < TICKS; i++) {
        sum += seconds[i] / TICKS;
    }
    return sum;
}

static bool BenchRow(Table* table, const Row* row)
{
    double seconds[MOST_WORKERS + 1][TICKS], means[MOST_WORKERS + 1];
    uint64_t hashes[MOST_WORKERS + 1] = { 0 };
    bool fine = true;
    for (int i = 0; i < (MOST_WORKERS + 1) * TICKS; i++) {
        seconds[i / TICKS][i % TICKS] = INFINITY;
    }
    for (int run = 0; fine && run < RUNS; run++) {
        for (int32_t workers = 0; fine && workers <= MOST_WORKERS; workers++) {
            fine = Run(row, workers, seconds[workers], &hashes[workers]);
            fine = fine && hashes[workers] == hashes[0];
        }
    }
    for (int workers = 0; workers <= MOST_WORKERS; workers++) {
        means[workers] = MeanOf(seconds[workers]);
    }
    Table_Text(table, row->name);
    TABLE_NUMBERS(table, row->sheets, row->sheets * (row->squares + 1) * (row->squares + 1));
    for (int workers = 0; workers <= MOST_WORKERS; workers++) {
        Table_Number(table, 1e3 * means[workers]);
    }
    Table_Number(table, means[0] / means[MOST_WORKERS]);
    return fine;
}

int main(void)
{
    static const char* const columns[] = { "sheets that lie", "sheets",    "vertices", "no hooks",
                                           "1 worker",        "2 workers", "faster",   NULL };
    Table table;
    bool fine = Table_Start(&table, "tasks",
                            "Tasks: ms of the wall that a tick takes, the mean over 30 of the least of three runs, "
                            "without hooks, with one worker and\nwith two, and how many times faster two are. The bits "
                            "are the same.",
                            columns);
    for (size_t i = 0; fine && i < sizeof rows / sizeof rows[0]; i++) {
        fine = BenchRow(&table, &rows[i]);
    }
    return Table_Stop(&table) && fine ? 0 : 1;
}
