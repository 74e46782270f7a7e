/* Blocks of 64 vertices: which of them a tick may have to write anew, so that what sleeps, and what a cut leaves as it
   is, costs nothing. */
#ifndef KIRI_BLOCKS_H
#define KIRI_BLOCKS_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

enum { KIRI_BLOCK = 64, KIRI_UNKNOWN = -2 };

/* Room for so many vertices and frames. Nothing is known of new blocks. False for memory. */
bool kiriBlocks_Resize(kiriBlocks* blocks, kiriMemory* memory, int32_t vertexCount, int32_t frameCount);

/* There are no more vertices and frames than these, again. Never fails. */
void kiriBlocks_Truncate(kiriBlocks* blocks, int32_t vertexCount, int32_t frameCount);

/* Vertices or frames have other indices: nothing is known. */
void kiriBlocks_Forget(kiriBlocks* blocks);

/* These vertices are gone, and frames with them: others have new indices, and their labels. The rest is as well known
   as before. */
void kiriBlocks_LeaveHoles(kiriBlocks* blocks, const kiriIndices* vertices, const kiriKeep* frames);

/* Of these vertices some have other weights, or are new: who moves them is found anew. */
void kiriBlocks_ForgetOne(kiriBlocks* blocks, int32_t block);

/* When other pieces are awake, or blocks are not known: a block has its mover until that falls asleep, and one that has
   none gets one where a frame of it woke. */
void kiriBlocks_FindMovers(kiriSheetData* sheet);

/* Bits of the patches that are other than before. */
kiriFrameMask kiriBlocks_MaskOfOther(const kiriPatches* patches);

/* May a patch of these carry a vertex of the block? */
static inline bool kiriBlocks_MayMeet(const kiriBlocks* blocks, int32_t block, const kiriFrameMask* mask)
{
    const uint64_t *a = blocks->frames.data[block].bits, *b = mask->bits;
    bool mayNear = ((a[0] & b[0]) | (a[1] & b[1])) != 0, mayFar = ((a[2] & b[2]) | (a[3] & b[3])) != 0;
    return blocks->movers.data[block] == KIRI_UNKNOWN || (mayNear && mayFar);
}

static inline void kiriBlocks_Stale(kiriBlocks* blocks, int32_t vertex)
{
    if (vertex >= 0) {
        blocks->stale.data[vertex / KIRI_BLOCK] = 1;
    }
}

static inline bool kiriBlocks_Moves(const kiriBlocks* blocks, int32_t block)
{
    return blocks->movers.data[block] != KIRI_NONE;
}

KIRI_C_END

#endif
