#include "kiri_skin_step.h"

#include "../sheet/kiri_seen.h"

enum { RANGE_VERTICES = 2048 }; /* about 10 us; a multiple of 4, see kiri_normal.c */

typedef struct SkinTask {
    kiriWorld* world;
    double dt;
} SkinTask;

static bool StoodStill(const kiriWorld* world, int32_t k)
{
    return world->moves.of.data[world->active.data[k]].isStill;
}

/* Without tasks, and where a sheet is one range, sleeps or stood still, all is done at one go. */
static bool IsInRanges(const kiriWorld* world, int32_t k)
{
    const kiriSheetData* sheet = kiriWorld_Active(world, k);
    return kiriTasks_AreGiven(&world->tasks) && !StoodStill(world, k) && !sheet->rest.asleep &&
           sheet->mesh.vertices.count > RANGE_VERTICES;
}

bool kiriSkinStep_Prepare(kiriWorld* world)
{
    int64_t count = 0;
    for (int32_t i = 0; kiriTasks_AreGiven(&world->tasks) && i < world->sheets.count; ++i) {
        count += world->sheets.data[i]->mesh.vertices.count / RANGE_VERTICES + 1;
    }
    return kiriArray_Reserve(&world->memory, &world->skinRanges, count);
}

/* Sheets for which the budget had nothing left stood where they were written last. */
static void FindStill(kiriWorld* world)
{
    for (int32_t k = 0; k < world->active.count; ++k) {
        kiriMove* move = &world->moves.of.data[world->active.data[k]];
        move->isStill = move->progress == KIRI_MORE && kiriView_IsSettled(kiriWorld_Active(world, k));
    }
}

static void ListRanges(kiriWorld* world)
{
    world->skinRanges.count = 0;
    for (int32_t k = 0; k < world->active.count; ++k) {
        const kiriSheetData* sheet = kiriWorld_Active(world, k);
        int32_t vertices = IsInRanges(world, k) ? sheet->mesh.vertices.count : 0;
        for (int32_t v = 0; v < vertices; v += RANGE_VERTICES) {
            kiriSkinRange range = { world->active.data[k], v, kiriMin(v + RANGE_VERTICES, vertices) };
            world->skinRanges.data[world->skinRanges.count++] = range;
        }
    }
}

static void BeginSheets(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    for (int32_t k = start; k < end; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(task->world, k);
        if (StoodStill(task->world, k)) {
            continue;
        }
        if (!sheet->rest.asleep) {
            kiriView_Fade(sheet, task->dt);
        }
        if (IsInRanges(task->world, k)) {
            kiriView_TakeFrames(sheet);
            continue;
        }
        if (!sheet->rest.asleep || sheet->seen.isElsewhere) {
            kiriView_WritePositions(sheet);
        }
        kiriView_KeepBounds(sheet);
    }
}

static void BlendRanges(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    for (int32_t k = start; k < end; ++k) {
        kiriSkinRange range = task->world->skinRanges.data[k];
        kiriView_BlendRange(task->world->sheets.data[range.sheet], range.begin, range.end);
    }
}

static void SumSheets(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    for (int32_t k = start; k < end; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(task->world, k);
        if (IsInRanges(task->world, k)) {
            kiriView_Sum(sheet);
        }
    }
}

static void WriteRanges(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    for (int32_t k = start; k < end; ++k) {
        kiriSkinRange range = task->world->skinRanges.data[k];
        kiriView_WriteRange(task->world->sheets.data[range.sheet], range.begin, range.end);
    }
}

static void EndSheets(int32_t start, int32_t end, void* context)
{
    const SkinTask* task = context;
    for (int32_t k = start; k < end; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(task->world, k);
        if (IsInRanges(task->world, k)) {
            kiriView_EndWriting(sheet);
            kiriView_KeepBounds(sheet);
        }
    }
}

void kiriSkinStep_Run(kiriWorld* world, double dt)
{
    SkinTask task = { world, dt };
    FindStill(world);
    ListRanges(world);
    kiriTasks_Run(&world->tasks, BeginSheets, world->active.count, 1, &task);
    if (world->skinRanges.count > 0) {
        kiriTasks_Run(&world->tasks, BlendRanges, world->skinRanges.count, 1, &task);
        kiriTasks_Run(&world->tasks, SumSheets, world->active.count, 1, &task);
        kiriTasks_Run(&world->tasks, WriteRanges, world->skinRanges.count, 1, &task);
        kiriTasks_Run(&world->tasks, EndSheets, world->active.count, 1, &task);
    }
    for (int32_t k = 0; k < world->active.count; ++k) {
        if (!StoodStill(world, k) && !kiriWorld_Active(world, k)->rest.asleep) {
            kiriView_Trim(kiriWorld_Active(world, k));
        }
    }
}
