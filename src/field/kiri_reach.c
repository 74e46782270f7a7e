#include "kiri_reach.h"

bool kiriReaches_Resize(kiriReaches* reaches, kiriMemory* memory, int32_t cellCount, int32_t labelCount)
{
    int32_t cells = reaches->ofCells.count, labels = reaches->ofLabel.count;
    int32_t needed = kiriReach_BlockOf(cellCount + KIRI_BLOCK_CELLS - 1);
    if (!kiriArray_Resize(memory, &reaches->ofCells, kiriMax(needed, cells)) ||
        !kiriArray_Resize(memory, &reaches->ofLabel, kiriMax(labelCount, labels))) {
        return false;
    }
    for (; cells < reaches->ofCells.count; ++cells) {
        reaches->ofCells.data[cells] = KIRI_NONE;
    }
    for (; labels < reaches->ofLabel.count; ++labels) {
        reaches->ofLabel.data[labels] = KIRI_NONE;
    }
    return true;
}

void kiriReaches_Clear(kiriReaches* reaches)
{
    reaches->blocks.count = reaches->heads.count = reaches->ofCells.count = reaches->ofLabel.count =
        reaches->freeBlocks = 0;
}

int32_t kiriReaches_Find(const kiriReaches* reaches, int32_t label, int32_t cells)
{
    KIRI_ASSERT(cells >= 0 && cells < reaches->ofCells.count);
    int32_t block = reaches->ofCells.data[cells];
    while (block != KIRI_NONE && reaches->heads.data[block].label != label) {
        block = reaches->heads.data[block].nextOfCells;
    }
    return block;
}

int64_t kiriReaches_RoomFor(const kiriReaches* reaches, int32_t more)
{
    return (int64_t)reaches->blocks.count + more - reaches->freeBlocks;
}

static int32_t TakeBlock(kiriReaches* reaches)
{
    if (reaches->freeBlocks == 0) {
        KIRI_ASSERT(reaches->blocks.count < reaches->blocks.capacity &&
                    reaches->blocks.count < reaches->heads.capacity);
        reaches->heads.count += 1;
        return reaches->blocks.count++;
    }
    int32_t block = reaches->freeBlock;
    reaches->freeBlock = reaches->blocks.data[block].nextOfFrame;
    reaches->freeBlocks -= 1;
    return block;
}

int32_t kiriReaches_Add(kiriReaches* reaches, int32_t label, int32_t cells)
{
    KIRI_ASSERT(label >= 0 && label < reaches->ofLabel.count);
    int32_t index = TakeBlock(reaches), next = reaches->ofLabel.data[label];
    kiriReachBlock* block = &reaches->blocks.data[index];
    reaches->heads.data[index] = (kiriReachHead){ label, reaches->ofCells.data[cells] };
    block->cells = cells;
    block->nextOfFrame = next;
    block->previousOfFrame = KIRI_NONE;
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
        block->fromSite[k] = block->fromBorder[k] = KIRI_FAR;
    }
    if (next != KIRI_NONE) {
        reaches->blocks.data[next].previousOfFrame = index;
    }
    reaches->ofCells.data[cells] = reaches->ofLabel.data[label] = index;
    return index;
}

void kiriReaches_Remove(kiriReaches* reaches, int32_t index)
{
    KIRI_ASSERT(index >= 0 && index < reaches->heads.count);
    kiriReachBlock *blocks = reaches->blocks.data, *block = &blocks[index];
    kiriReachHead* head = &reaches->heads.data[index];
    int32_t* link = &reaches->ofCells.data[block->cells];
    while (*link != index) {
        link = &reaches->heads.data[*link].nextOfCells;
    }
    *link = head->nextOfCells;
    if (block->nextOfFrame != KIRI_NONE) {
        blocks[block->nextOfFrame].previousOfFrame = block->previousOfFrame;
    }
    if (block->previousOfFrame != KIRI_NONE) {
        blocks[block->previousOfFrame].nextOfFrame = block->nextOfFrame;
    } else {
        reaches->ofLabel.data[head->label] = block->nextOfFrame;
    }
    head->label = KIRI_NONE;
    block->nextOfFrame = reaches->freeBlock;
    reaches->freeBlock = index;
    reaches->freeBlocks += 1;
}

void kiriReaches_Forget(kiriReaches* reaches, int32_t label)
{
    KIRI_ASSERT(label >= 0 && label < reaches->ofLabel.count);
    while (reaches->ofLabel.data[label] != KIRI_NONE) {
        kiriReaches_Remove(reaches, reaches->ofLabel.data[label]);
    }
}

void kiriReaches_Relabel(kiriReaches* reaches, const kiriKeep* labels)
{
    for (int32_t label = labels->first; label < reaches->ofLabel.count; ++label) {
        int32_t to = kiriKeep_To(labels, label);
        KIRI_ASSERT(to != KIRI_NONE || reaches->ofLabel.data[label] == KIRI_NONE);
        for (int32_t b = reaches->ofLabel.data[label]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
            reaches->heads.data[b].label = to;
        }
    }
    kiriKeep_Compact(labels, &reaches->ofLabel, 1, sizeof(int32_t));
}

/* ---- What a frame reaches ---------------------------------------------------------------------------------------- */

static kiriReach NextReach(const kiriReaches* reaches, int32_t block, int32_t k)
{
    for (; block != KIRI_NONE; block = reaches->blocks.data[block].nextOfFrame, k = 0) {
        const kiriReachBlock* at = &reaches->blocks.data[block];
        for (; k < KIRI_BLOCK_CELLS; ++k) {
            if (at->fromSite[k] != KIRI_FAR) {
                return (kiriReach){ at->cells * KIRI_BLOCK_CELLS + k, at->fromSite[k], at->fromBorder[k], block };
            }
        }
    }
    return (kiriReach){ KIRI_NONE, KIRI_FAR, KIRI_FAR, KIRI_NONE };
}

kiriReach kiriReaches_First(const kiriReaches* reaches, int32_t label)
{
    KIRI_ASSERT(label >= 0 && label < reaches->ofLabel.count);
    return NextReach(reaches, reaches->ofLabel.data[label], 0);
}

kiriReach kiriReaches_After(const kiriReaches* reaches, kiriReach reach)
{
    return NextReach(reaches, reach.block, reach.cell % KIRI_BLOCK_CELLS + 1);
}
