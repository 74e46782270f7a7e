/* How far cells are from the sites of frames, and from the borders of their regions: of each frame only for the cells
   that it reaches. Cells whose indices follow each other, which mostly lie in a row, share a block for each frame that
   reaches one of them. So what a frame knows of a cell, and which frames reach a cell, is found at the cost of the
   frames near by. */
#ifndef KIRI_REACH_H
#define KIRI_REACH_H

#include "kiri_geodesic.h"
#include "../core/kiri_label.h"

KIRI_C_BEGIN

enum { KIRI_BLOCK_CELLS = 16 };

/* Whose block it is. Apart from what is in it: so a search along the list of some cells reads few lines of memory. */
typedef struct kiriReachHead {
    int32_t label;       /* of the frame; KIRI_NONE: no block has this index now */
    int32_t nextOfCells; /* the block of another frame for these cells, or KIRI_NONE */
} kiriReachHead;

/* What a frame knows of so many cells, from cell `cells` * KIRI_BLOCK_CELLS on. */
typedef struct kiriReachBlock {
    int32_t cells;
    int32_t nextOfFrame, previousOfFrame;
    int32_t fromSite[KIRI_BLOCK_CELLS]; /* KIRI_FAR where the frame does not reach the cell */
    int32_t fromBorder[KIRI_BLOCK_CELLS];
} kiriReachBlock;

typedef struct kiriReaches {
    KIRI_ARRAY(kiriReachBlock) blocks; /* by index, with gaps; */
    KIRI_ARRAY(kiriReachHead) heads;   /* and one head for each */
    KIRI_ARRAY(int32_t) ofCells;       /* heads of lists */
    KIRI_ARRAY(int32_t) ofLabel;       /* of each label of a frame */
    int32_t freeBlocks;                /* how many have no frame; the list is headed by */
    int32_t freeBlock;
} kiriReaches;

/* A cell that a frame reaches. */
typedef struct kiriReach {
    int32_t cell; /* KIRI_NONE: there are no more */
    int32_t fromSite, fromBorder;
    int32_t block;
} kiriReach;

/* Room for so many cells and labels. False for memory. */
bool kiriReaches_Resize(kiriReaches* reaches, kiriMemory* memory, int32_t cellCount, int32_t labelCount);

/* Makes it empty; keeps the memory. */
void kiriReaches_Clear(kiriReaches* reaches);

/* The block, or KIRI_NONE. */
int32_t kiriReaches_Find(const kiriReaches* reaches, int32_t label, int32_t cells);

/* The room that so many more blocks need, in `blocks` and in `heads`. */
int64_t kiriReaches_RoomFor(const kiriReaches* reaches, int32_t more);

/* A block that there is not yet, which reaches nothing. There is room. */
int32_t kiriReaches_Add(kiriReaches* reaches, int32_t label, int32_t cells);
void kiriReaches_Remove(kiriReaches* reaches, int32_t block);

/* A frame loses its blocks. */
void kiriReaches_Forget(kiriReaches* reaches, int32_t label);

/* Labels that are not kept, which have no blocks, are gone, and others are numbered anew. */
void kiriReaches_Relabel(kiriReaches* reaches, const kiriKeep* labels);

/* The cells that a frame reaches, in no order. */
kiriReach kiriReaches_First(const kiriReaches* reaches, int32_t label);
kiriReach kiriReaches_After(const kiriReaches* reaches, kiriReach reach);

static inline int32_t kiriReach_BlockOf(int32_t cell)
{
    return cell / KIRI_BLOCK_CELLS;
}

KIRI_C_END

#endif
