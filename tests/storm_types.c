/* See storm.h. */
#include "storm.h"

#include <stddef.h>
#include <string.h>

const StormType Storm_Types[STORM_TYPES] = {
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
    { .name = "folds", .obstacles = true, .folds = true, .sheets = 2, .budget = { 64, 1000, 400, 0 } },
    { .name = "seams", .touches = true, .obstacles = true, .tasks = true, .seams = true, .sheets = 4 },
};

/* Ranges in an order of its own: the bits are the same. */
static void* StartTask(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* taskContext)
{
    for (int32_t end = itemCount; end > 0;) {
        int32_t start = end > 2 * minRange ? (end - 1) / minRange * minRange : 0;
        task(start, end, taskContext);
        end = start;
    }
    return NULL;
}

static void FinishTask(void* user, void* handle)
{
}

kiriResult Storm_Start(Storm* storm, int32_t kind, kiriWorldDef* def)
{
    const StormType* type = &Storm_Types[kind];
    memset(storm, 0, sizeof *storm);
    storm->type = type;
    storm->seed = 1 + (uint32_t)kind;
    def->budget = type->budget;
    if (type->tasks) {
        def->startTask = StartTask;
        def->finishTask = FinishTask;
        def->workerCount = 3;
    }
    kiriResult result = kiriCreateWorld(def, &storm->world);
    for (int32_t i = 0; result == KIRI_OK && i < type->sheets; i++) {
        Storm_AddSheet(storm);
    }
    for (int32_t i = 0; result == KIRI_OK && type->obstacles && i < STORM_OBSTACLES; i++) {
        Storm_AddObstacle(storm);
    }
    return result;
}

void Storm_Tick(Storm* storm)
{
    for (uint32_t acts = 2 + Storm_Random(storm, 4); acts > 0; acts--) {
        Storm_Act(storm);
    }
    Storm_Note(storm, kiriWorld_Tick(storm->world, 1.0f / 60.0f, 1 + (int32_t)Storm_Random(storm, 3)));
}
