/* Distances inside the cut sheet: Dijkstra over the steps of the grid. Lengths are whole numbers, so a field is the
   one fixed point of (distance, owner) = min over the seed and the neighbours' (distance + step, owner), whatever the
   order of work; ties go to the lower owner. So a field can be repaired where the grid has changed (after Ramalingam
   and Reps 1996), and then equals one from scratch. */
#ifndef KIRI_GEODESIC_H
#define KIRI_GEODESIC_H

#include "kiri_grid.h"
#include "../core/kiri_keep.h"

KIRI_C_BEGIN

typedef struct kiriSeed {
    int32_t cell;
    int32_t distance; /* 0 or more */
    int32_t owner;
} kiriSeed;

enum { KIRI_FAR = INT32_MAX };

/* May ways go on from a cell? Floods ask when its distance is final, repairs also before that: so a cell that lets ways
   pass at some distance must do so at every shorter one. */
typedef bool kiriPassFn(const void* context, int32_t cell);

/* The nearest of the cell's own seeds (of equals, that of the lowest owner), or KIRI_FAR as its distance. */
typedef kiriSeed kiriSeedFn(const void* context, int32_t cell);

/* Called before a field is read where the steps of a cell lead to. It may put distances there that are not in the field
   yet, as if they had always been. */
typedef void kiriLookFn(const void* context, int32_t cell);

/* What makes a field. */
typedef struct kiriRule {
    const kiriGrid* grid;
    int32_t limit;    /* the farthest that is reached */
    kiriPassFn* pass; /* or null */
    kiriSeedFn* seed; /* of repairs only */
    const void* context;
    kiriLookFn* look; /* or null */
    /* Or null: of floods: ways go on only from cells that are nearer than this, one number a cell. */
    const int32_t* below[2];
} kiriRule;

typedef struct kiriField {
    KIRI_ARRAY(int32_t) distance; /* one a cell; KIRI_FAR where the field does not reach */
    KIRI_ARRAY(int32_t) owner;    /* of the nearest seed; KIRI_NONE where FAR */
    kiriIndices settled;          /* of floods: cells reached, by growing distance if not scanned; none once dirty */
    KIRI_ARRAY(kiriSeed) log;     /* of repairs: what cells were before, each once; some may be the same again */

    /* Work at hand. Cells are settled when none is to be checked any more, so one of the two lists has room for all
       cells, and the other need not: they change places. */
    KIRI_ARRAY(kiriSeed) heap;
    kiriIndices dirty;         /* cells to be checked */
    KIRI_ARRAY(uint8_t) marks; /* one a cell; between repairs only of dirty cells */
    int32_t cursor[KIRI_STEP_LENGTHS + 1];
} kiriField;

/* Room for so many cells; new ones are FAR. A zeroed field is empty. False for memory: what was there stays. */
bool kiriField_Resize(kiriField* field, kiriMemory* memory, int32_t cellCount);

/* Makes it a field of no cells, whatever its state; keeps the memory. */
void kiriField_Clear(kiriField* field);

/* ---- From scratch ---- */

/* Starts a flood from the seeds. The field must be empty: FAR everywhere. */
bool kiriField_Start(kiriField* field, kiriMemory* memory, const kiriSeed* seeds, int32_t seedCount);

/* Goes on with it. An item of the quota is a cell settled. Allocates nothing: never KIRI_FAILED. */
kiriProgress kiriField_Flood(kiriField* field, const kiriRule* rule, kiriQuota* quota);

/* Makes the whole flood that Start has prepared, without a limit, and from all cells ways go on; as many items as cells
   are settled. All that the seeds reach is among these cells, which come in their order; and so they are settled.
   KIRI_MORE, and nothing is done: the ways wind too much, and Flood does it. KIRI_FAILED: no memory. */
kiriProgress kiriField_Scan(kiriField* field, kiriMemory* memory, const kiriGrid* grid, const int32_t* cells,
                            int32_t count);

/* Makes all cells FAR again, at the cost of those that a flood settled. Not after a repair. */
void kiriField_Reset(kiriField* field);

/* ---- Repairs ---- */

/* The cell's steps or seed may have changed, or whether ways pass through it. Never fails: room is made by Resize. What
   a flood has settled is forgotten. */
void kiriField_MarkDirty(kiriField* field, int32_t cell);

/* The same where ways pass through the cell, or do not, as before, and so far as before: it costs less. */
void kiriField_MarkStepsDirty(kiriField* field, int32_t cell);

/* The cell is no more, and then it must not be dirty; or it shall be FAR. The cells that its steps led to must be
   dirty. Not logged. */
void kiriField_Forget(kiriField* field, int32_t cell);

/* Makes the field right again. All cells about which something has changed must be dirty: where the limit has grown,
   all from which a step leads beyond the old one; where it has shrunk, all beyond the new one that are not forgotten.
   An item of the quota is a cell whose distance is cleared, half of one that is settled, one that is looked at for
   where the sweep begins, or four that keep what they have. KIRI_MORE: call again with the same rule before
   anything changes. The log tells what changed; its reader empties it (its count). KIRI_FAILED: only kiriField_Clear
   helps. */
kiriProgress kiriField_Repair(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota);

/* How far cells are from the sites of frames, and from the borders of their regions: of each frame only for the cells
   that it reaches. Cells whose indices follow each other, which mostly lie in a row, share a block for each frame that
   reaches one of them. So what a frame knows of a cell, and which frames reach a cell, is found at the cost of the
   frames near by. */

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
