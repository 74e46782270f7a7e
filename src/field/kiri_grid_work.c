#include "kiri_grid_work.h"

/* ---- Quota ------------------------------------------------------------------------------------------------------- */

bool kiriGridWork_Pay(kiriGridWork* work, kiriQuota* quota)
{
    int64_t owed = work->due / KIRI_GRID_ITEM, rest = work->due % KIRI_GRID_ITEM;
    bool isPaid = kiriQuota_Pay(quota, &owed);
    work->due = KIRI_GRID_ITEM * owed + rest;
    return isPaid;
}

/* ---- Lists ------------------------------------------------------------------------------------------------------- */

bool kiriGridWork_Flag(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag)
{
    uint8_t* flags = &work->squareFlags.data[square];
    bool ok = *flags != 0 || kiriArray_Push(memory, &work->flagged, square);
    *flags |= (uint8_t)flag;
    return ok;
}

bool kiriGridWork_AddOnce(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag, kiriIndices* list)
{
    return kiriGridWork_IsFlagged(work, square, flag) ||
           (kiriGridWork_Flag(work, memory, square, flag) && kiriArray_Push(memory, list, square));
}

bool kiriGrid_RecordSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell)
{
    KIRI_ASSERT(grid->work->running && kiriGrid_IsCell(grid, cell));
    uint8_t* flags = &grid->work->cellFlags.data[cell];
    bool isRecorded = (*flags & KIRI_CELL_STEPS) != 0;
    *flags |= KIRI_CELL_STEPS;
    return isRecorded || kiriArray_Push(memory, &grid->changes.steps, cell);
}

bool kiriGrid_RecordLink(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b)
{
    kiriGridWork* work = grid->work;
    return work->fromScratch ||
           (kiriGrid_RecordSteps(grid, memory, a) && kiriGrid_RecordSteps(grid, memory, b) &&
            kiriGridWork_AddOnce(work, memory, grid->cells.data[a].square, KIRI_SQUARE_LINKS_DIRTY,
                                 &work->linksDirty) &&
            kiriGridWork_AddOnce(work, memory, grid->cells.data[b].square, KIRI_SQUARE_LINKS_DIRTY, &work->linksDirty));
}

/* ---- Triangles of a square --------------------------------------------------------------------------------------- */

/* By triangle: the order of a square's list does not matter. */
static bool IsNodeBefore(const void* nodes, int32_t a, int32_t b)
{
    return ((const kiriSquareNode*)nodes)[a].triangle < ((const kiriSquareNode*)nodes)[b].triangle;
}

static void TurnAround(int32_t* items, int32_t count)
{
    for (int32_t i = 0, j = count - 1; i < j; ++i, --j) {
        int32_t item = items[i];
        items[i] = items[j];
        items[j] = item;
    }
}

/* A list has the latest triangles first: turned around it is nearly in order. */
static kiriProgress CollectList(kiriGridWork* work, const kiriMeshData* mesh, kiriQuota* quota, int32_t first)
{
    while (work->node != KIRI_NONE) {
        if (!kiriArray_Push(mesh->memory, &work->parent, work->node) ||
            !kiriArray_Push(mesh->memory, &work->entries, work->node)) {
            return KIRI_FAILED;
        }
        work->node = mesh->squares.nodes.data[work->node].next;
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    TurnAround(work->entries.data + first, work->entries.count - first);
    for (int32_t i = first; i < work->entries.count; ++i) {
        work->parent.data[i] = i;
    }
    return KIRI_DONE;
}

static kiriProgress SortEntries(kiriGridWork* work, const kiriMeshData* mesh, kiriQuota* quota, int32_t first)
{
    enum { FEW = 64, MOVES = 512 };
    int32_t *entries = work->entries.data + first, count = work->entries.count - first;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    if (count <= FEW) {
        kiriSort(entries, count, IsNodeBefore, nodes);
        work->due += KIRI_GRID_NODE * count;
        return KIRI_DONE;
    }
    if (!kiriArray_Resize(mesh->memory, &work->sortRoom, count)) {
        return KIRI_FAILED;
    }
    while (!kiriSorting_GoOn(&work->sorting, entries, work->sortRoom.data, count, IsNodeBefore, nodes, MOVES)) {
        if (!kiriGridWork_Spend(work, quota, MOVES * KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    return KIRI_DONE;
}

kiriProgress kiriGridWork_Collect(kiriGridWork* work, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    kiriNodeRange* range = &work->ranges.data[square];
    if (kiriGridWork_IsFlagged(work, square, KIRI_SQUARE_COLLECTED)) {
        return KIRI_DONE;
    }
    if (!work->isCollecting) {
        work->isCollecting = true;
        work->isSorting = false;
        work->node = mesh->squares.head[square];
        work->sorting = (kiriSorting){ 0, 0, 0, 0, 0 };
        range->first = work->entries.count;
    }
    kiriProgress progress = work->isSorting ? KIRI_DONE : CollectList(work, mesh, quota, range->first);
    work->isSorting = progress == KIRI_DONE;
    progress = progress == KIRI_DONE ? SortEntries(work, mesh, quota, range->first) : progress;
    if (progress != KIRI_DONE) {
        return progress;
    }
    work->isCollecting = false;
    range->end = work->entries.count;
    return kiriGridWork_Flag(work, mesh->memory, square, KIRI_SQUARE_COLLECTED) ? KIRI_DONE : KIRI_FAILED;
}
