#include "kiri_move_step.h"

#include "../core/kiri_sort.h"
#include "../core/kiri_union_find.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_seen.h"
#include "kiri_obstacle_step.h"
#include "kiri_pin_step.h"

/* ---- Groups ---- */

/* Of several touches of one obstacle, which come after each other, one is enough. */
static bool AddMeet(kiriWorld* world, int32_t sheet, const kiriObstacleData* obstacle, const kiriObstacleData** last)
{
    bool isNew = obstacle != NULL && obstacle != *last && kiriObstacle_IsMovable(obstacle);
    kiriMeet meet = { isNew ? kiriObstacles_NumberOf(obstacle) : 0, sheet };
    *last = obstacle != NULL ? obstacle : *last;
    return !isNew || kiriArray_Push(&world->memory, &world->moves.meets, meet);
}

/* Whatever the sheet may give an impulse to, and would move by it; with what it touched last, should it sleep. */
static bool ListMeets(kiriWorld* world, int32_t sheet)
{
    const kiriSheetData* data = world->sheets.data[sheet];
    const kiriObstacleData* last = NULL;
    bool ok = true;
    const kiriTouchMemory* memories[] = { &data->touches.last, &data->touches.slept };
    for (int32_t i = 0; ok && i < data->touches.found.count; ++i) {
        ok = AddMeet(world, sheet, kiriObstacles_OwnerOf(world, data->touches.found.data[i].key), &last);
    }
    for (int n = 0; n < 2; ++n) {
        for (int32_t i = 0; ok && i < memories[n]->touches.count; ++i) {
            ok = AddMeet(world, sheet, kiriObstacles_OwnerOf(world, memories[n]->touches.data[i].key), &last);
        }
    }
    for (int32_t i = 0; ok && i < data->pins.count; ++i) {
        ok = AddMeet(world, sheet, kiriPinStep_Obstacle(world, &data->pins.data[i]), &last);
    }
    return ok;
}

static bool HasLowerNumber(const void* context, int32_t a, int32_t b)
{
    const kiriMeet* meets = context;
    return meets[a].number < meets[b].number || (meets[a].number == meets[b].number && a < b);
}

/* Sheets that move the same body: each finds in its yield rows what those before it gave. */
static bool JoinByBodies(kiriWorld* world)
{
    kiriMoves* moves = &world->moves;
    bool ok = true;
    moves->meets.count = 0;
    for (int32_t i = 0; ok && i < world->sheets.count; ++i) {
        ok = ListMeets(world, i);
    }
    if (!ok || !kiriArray_Resize(&world->memory, &moves->order, moves->meets.count)) {
        return false;
    }
    for (int32_t k = 0; k < moves->order.count; ++k) {
        moves->order.data[k] = k;
    }
    kiriSort(moves->order.data, moves->order.count, HasLowerNumber, moves->meets.data);
    for (int32_t k = 1; k < moves->order.count; ++k) {
        const kiriMeet *a = &moves->meets.data[moves->order.data[k - 1]], *b = &moves->meets.data[moves->order.data[k]];
        if (a->number == b->number) {
            kiriUnion_Join(moves->parent.data, a->sheet, b->sheet);
        }
    }
    return true;
}

bool kiriMoves_Prepare(kiriWorld* world)
{
    kiriMoves* moves = &world->moves;
    int32_t count = world->sheets.count;
    if (!kiriArray_Resize(&world->memory, &moves->of, count) ||
        !kiriArray_Resize(&world->memory, &moves->parent, count) ||
        !kiriArray_Reserve(&world->memory, &moves->heads, count)) {
        return false;
    }
    kiriUnion_Init(moves->parent.data, count);
    return !kiriTasks_AreGiven(&world->tasks) || world->obstacles.count == 0 || JoinByBodies(world);
}

/* ---- Moving ---- */

typedef struct MoveTask {
    kiriWorld* world;
    double dt;
    int32_t substeps;
    kiriQuota systems; /* each sheet may take all of them: together they will not */
} MoveTask;

/* What moves by it is of one group; what does not gets it when all are moved, in the order of sheets. */
static void GiveImpulses(const MoveTask* task, int32_t i, bool areMovable)
{
    kiriSheetData* sheet = task->world->sheets.data[i];
    kiriObstacles_TakeImpulses(task->world, sheet, task->dt, areMovable);
    if (task->world->moves.of.data[i].progress != KIRI_MORE) {
        kiriPinStep_End(task->world, sheet, task->dt, areMovable);
    }
}

/* Where no system is left, and all is seen as it is: so of many sheets those that wait cost next to nothing. */
static bool StandsStill(const MoveTask* task, kiriSheetData* sheet)
{
    return kiriQuota_IsSpent(&task->systems) && kiriView_IsSettled(sheet) && kiriMotion_Wait(sheet, task->dt);
}

static void MoveSheet(const MoveTask* task, int32_t i)
{
    kiriWorld* world = task->world;
    kiriMove* move = &world->moves.of.data[i];
    kiriQuota systems = task->systems;
    if (StandsStill(task, world->sheets.data[i])) {
        move->progress = KIRI_MORE;
        move->systems = 0;
        return;
    }
    kiriObstacles_LoadYields(world, world->sheets.data[i]);
    kiriPinStep_Begin(world, world->sheets.data[i], task->dt);
    move->progress = kiriMotion_Solve(world->sheets.data[i], world->gravity, task->dt, task->substeps, &systems);
    move->systems = systems.used - task->systems.used;
    GiveImpulses(task, i, true);
}

static void MoveGroups(int32_t start, int32_t end, void* context)
{
    const MoveTask* task = context;
    const kiriMoves* moves = &task->world->moves;
    for (int32_t k = start; k < end; ++k) {
        for (int32_t i = moves->heads.data[k]; i != KIRI_NONE; i = moves->of.data[i].next) {
            MoveSheet(task, i);
        }
    }
}

/* In the order in which sheets are moved. */
int32_t kiriMoves_SheetAt(const kiriWorld* world, int32_t turn, int32_t k)
{
    const kiriIndices* active = &world->active;
    int32_t low;
    KIRI_SEARCH(low, 0, active->count, active->data[middle] < turn);
    return active->data[(low + k) % active->count];
}

static int32_t SheetAt(const kiriWorld* world, int32_t k)
{
    return kiriMoves_SheetAt(world, world->turn, k);
}

/* From the first one on: as many as have enough systems whatever they take, and one at least; all where there are
   none. */
static int32_t EndOfWave(const MoveTask* task, int32_t first)
{
    const kiriWorld* world = task->world;
    int32_t end = kiriQuota_IsSpent(&task->systems) ? world->active.count : first;
    int64_t most = 0;
    while (end < world->active.count) {
        most += kiriMotion_MostItems(world->sheets.data[SheetAt(world, end)], task->substeps);
        if (most > task->systems.left && end > first) {
            break;
        }
        ++end;
    }
    return end;
}

/* The groups of these sheets, each in their order. */
static void ListGroups(kiriWorld* world, int32_t first, int32_t end)
{
    kiriMoves* moves = &world->moves;
    moves->heads.count = 0;
    for (int32_t k = first; k < end; ++k) {
        moves->of.data[kiriUnion_Root(moves->parent.data, SheetAt(world, k))].tail = KIRI_NONE;
    }
    for (int32_t k = first; k < end; ++k) {
        int32_t i = SheetAt(world, k);
        int32_t* tail = &moves->of.data[kiriUnion_Root(moves->parent.data, i)].tail;
        if (*tail == KIRI_NONE) {
            moves->heads.data[moves->heads.count++] = i;
        } else {
            moves->of.data[*tail].next = i;
        }
        *tail = i;
        moves->of.data[i].next = KIRI_NONE;
    }
}

/* Sheets that systems are enough for move side by side; the others one after the other, each with what is left. */
void kiriMoves_Run(kiriWorld* world, double dt, int32_t substeps, kiriQuota* systems)
{
    for (int32_t first = 0, end; first < world->active.count; first = end) {
        MoveTask task = { world, dt, substeps, *systems };
        end = EndOfWave(&task, first);
        ListGroups(world, first, end);
        kiriTasks_Run(&world->tasks, MoveGroups, world->moves.heads.count, 1, &task);
        for (int32_t k = first; k < end; ++k) {
            GiveImpulses(&task, SheetAt(world, k), false);
            kiriQuota_Take(systems, world->moves.of.data[SheetAt(world, k)].systems);
            world->profile.systemsSolved += kiriSolver_TakeSolved(world->sheets.data[SheetAt(world, k)]->solver);
        }
    }
}
