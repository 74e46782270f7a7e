#include "kiri_border_cell.h"

bool kiriBorderCells_Resize(kiriBorderCells* lists, kiriMemory* memory, int32_t cellCount, int32_t regionCount)
{
    const kiriBorderCell none = { KIRI_NONE, KIRI_NONE, KIRI_NONE };
    if (!kiriArray_Reserve(memory, &lists->cells, cellCount) ||
        !kiriArray_Reserve(memory, &lists->first, regionCount)) {
        return false;
    }
    while (lists->cells.count < cellCount) {
        lists->cells.data[lists->cells.count++] = none;
    }
    while (lists->first.count < regionCount) {
        lists->first.data[lists->first.count++] = KIRI_NONE;
    }
    return true;
}

static void TakeFromBorder(kiriBorderCells* lists, const kiriBorderCell* at)
{
    *(at->before == KIRI_NONE ? &lists->first.data[at->region] : &lists->cells.data[at->before].next) = at->next;
    if (at->next != KIRI_NONE) {
        lists->cells.data[at->next].before = at->before;
    }
}

void kiriBorderCells_Put(kiriBorderCells* lists, int32_t cell, int32_t region)
{
    KIRI_ASSERT(cell >= 0 && cell < lists->cells.count);
    kiriBorderCell* at = &lists->cells.data[cell];
    if (at->region == region) {
        return;
    }
    if (at->region != KIRI_NONE) {
        TakeFromBorder(lists, at);
    }
    *at = (kiriBorderCell){ region, KIRI_NONE, KIRI_NONE };
    if (region != KIRI_NONE) {
        at->next = lists->first.data[region];
        lists->first.data[region] = cell;
        if (at->next != KIRI_NONE) {
            lists->cells.data[at->next].before = cell;
        }
    }
}

void kiriBorderCells_Keep(kiriBorderCells* lists, const kiriKeep* regions)
{
    const int32_t *to = regions->to.data, first = regions->first;
    for (int32_t c = 0; c < lists->cells.count && kiriKeep_Moves(regions); ++c) {
        kiriBorderCell* cell = &lists->cells.data[c];
        if (cell->region >= first) {
            cell->region = to[cell->region];
        }
    }
    kiriKeep_Compact(regions, &lists->first, 1, sizeof(int32_t));
}

void kiriBorderCells_Reset(kiriBorderCells* lists)
{
    lists->first.count = lists->cells.count = 0;
}
