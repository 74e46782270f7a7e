/* See storm.h. Prints for each world, at some ticks, its state hash and one of what is seen. */
#include "storm.h"

#include <stdio.h>
#include <string.h>

enum { TICKS = 24, PRINTED = 8 };

static const StormType types[] = {
    { .name = "links", .sheets = 2 },
    { .name = "smooth", .skinning = KIRI_SKINNING_SMOOTH, .obstacles = true, .sheets = 2 },
    { .name = "euler", .timeStepping = KIRI_TIME_STEPPING_EULER, .obstacles = true, .sheets = 2 },
    { .name = "affine", .model = KIRI_MODEL_AFFINE, .obstacles = true, .sheets = 2 },
    { .name = "points", .model = KIRI_MODEL_POINTS, .sheets = 1 },
    { .name = "planar", .planar = true, .sheets = 2 },
    { .name = "rubber", .model = KIRI_MODEL_AFFINE, .skinning = KIRI_SKINNING_SMOOTH, .planar = true, .sheets = 2 },
    { .name = "scratch", .fromScratch = true, .sheets = 2 },
    { .name = "crowd", .touches = true, .obstacles = true, .tasks = true, .sheets = 4 },
    { .name = "budget", .touches = true, .sheets = 3, .budget = { 64, 400, 100, 8 } },
};

/* Ranges in an order of its own: the bits are the same. */
static void* StartTask(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* taskContext)
{
    (void)user;
    for (int32_t end = itemCount; end > 0;) {
        int32_t start = end > 2 * minRange ? (end - 1) / minRange * minRange : 0;
        task(start, end, taskContext);
        end = start;
    }
    return NULL;
}

static void FinishTask(void* user, void* handle)
{
    (void)user;
    (void)handle;
}

static kiriResult Start(Storm* storm, const StormType* type)
{
    memset(storm, 0, sizeof *storm);
    storm->type = type;
    storm->seed = 1 + (uint32_t)(type - types);
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.budget = type->budget;
    if (type->tasks) {
        def.startTask = StartTask;
        def.finishTask = FinishTask;
        def.workerCount = 3;
    }
    kiriResult result = kiriCreateWorld(&def, &storm->world);
    for (int32_t i = 0; result == KIRI_OK && i < type->sheets; i++) {
        Storm_AddSheet(storm);
    }
    for (int32_t i = 0; result == KIRI_OK && type->obstacles && i < STORM_OBSTACLES; i++) {
        Storm_AddObstacle(storm);
    }
    return result;
}

static void Tick(Storm* storm)
{
    for (uint32_t acts = 2 + Storm_Random(storm, 4); acts > 0; acts--) {
        Storm_Act(storm);
    }
    Storm_Note(storm, kiriWorld_Tick(storm->world, 1.0f / 60.0f, 1 + (int32_t)Storm_Random(storm, 3)));
}

/* In halves: not every C library prints 64 bits alike. */
static void PrintHash(uint64_t hash)
{
    printf(" %08lx%08lx", (unsigned long)(hash >> 32), (unsigned long)(hash & 0xffffffff));
}

static void Print(Storm* storm, int32_t tick)
{
    uint64_t hash = 0;
    kiriWorld_GetStateHash(storm->world, &hash);
    printf("%-8s %2d", storm->type->name, (int)tick);
    PrintHash(hash);
    PrintHash(Storm_HashSeen(storm));
    printf("\n");
}

static bool Run(const StormType* type)
{
    Storm storm;
    kiriResult result = Start(&storm, type);
    if (result != KIRI_OK) {
        printf("%-8s %s\n", type->name, kiriGetResultName(result));
        return false;
    }
    for (int32_t tick = 1; tick <= TICKS; tick++) {
        Tick(&storm);
        if (tick % PRINTED == 0) {
            Print(&storm, tick);
        }
    }
    kiriDestroyWorld(storm.world);
    return true;
}

int main(void)
{
    bool fine = true;
    for (size_t i = 0; i < sizeof types / sizeof types[0]; i++) {
        fine = Run(&types[i]) && fine;
    }
    return fine ? 0 : 1;
}
