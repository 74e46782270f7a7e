/* Distances inside the cut sheet: Dijkstra over the steps of the grid. Lengths are whole numbers, so a field is the
   one fixed point of (distance, owner) = min over the seed and the neighbours' (distance + step, owner), whatever the
   order of work; ties go to the lower owner. So a field can be repaired where the grid has changed (after Ramalingam
   and Reps 1996), and then equals one from scratch. */
#ifndef KIRI_GEODESIC_H
#define KIRI_GEODESIC_H

#include "kiri_grid.h"
#include "../core/kiri_array.h"

KIRI_C_BEGIN

typedef struct kiriSeed {
    int32_t cell;
    int32_t distance; /* 0 or more */
    int32_t owner;
} kiriSeed;

enum { KIRI_FAR = INT32_MAX, KIRI_RING = 4 /* buckets of distances at a time, see kiri_geodesic.c */ };

/* Returns true if ways go on from a cell. Floods ask when its distance is final, repairs also before that: so a cell
   that lets ways pass at some distance must do so at every shorter one. */
typedef bool kiriPassFn(const void* context, int32_t cell);

/* Returns the nearest of the cell's own seeds, or KIRI_FAR as its distance. Ties go to the lowest owner. */
typedef kiriSeed kiriSeedFn(const void* context, int32_t cell);

/* Called before a repair reads the cells that the steps of a cell lead to. It may put distances there that are not in
   the field yet. */
typedef void kiriLookFn(const void* context, int32_t cell);

/* What makes a field. */
typedef struct kiriRule {
    const kiriGrid* grid;
    int32_t limit;    /* the farthest distance, less than KIRI_FAR */
    kiriPassFn* pass; /* or null */
    kiriSeedFn* seed; /* of repairs only */
    const void* context;
    kiriLookFn* look; /* or null */
} kiriRule;

typedef struct kiriField {
    kiriIndices distance;         /* one a cell; KIRI_FAR where the field does not reach */
    kiriIndices owner;            /* of the nearest seed; KIRI_NONE where FAR; no items: all are KIRI_NONE */
    kiriIndices settled;          /* of floods: cells reached; none once dirty */
    KIRI_ARRAY(kiriSeed) log;     /* of repairs: previous values of cells, each once; some may be the same again */

    KIRI_ARRAY(kiriSeed) seeds;  /* of a sweep: those that it has not taken yet */
    int32_t nearest;             /* of their distances, or KIRI_FAR */
    kiriIndices ring[KIRI_RING]; /* of a sweep: cells to be settled, by the bucket of their distance */
    int32_t bucket;              /* of the cells that are settled now */
    kiriIndices dirty;           /* cells to be checked */
    kiriFlags marks;             /* one a cell; between repairs only of dirty cells */
    int32_t checked, fromCaller; /* dirty cells: the next one to check, and how many the caller marked */
    int32_t stage;               /* of a repair; 0: none is in progress */
} kiriField;

/* Makes room for cells; new ones are FAR. `uses` stay the same. A zeroed field is empty. False for memory: the field
   stays as it is. */
enum { KIRI_FIELD_OWNERS = 1, KIRI_FIELD_REPAIRS = 2 };
bool kiriField_Resize(kiriField* field, kiriMemory* memory, int32_t cellCount, int uses);

/* Makes it a field of no cells, whatever its state; keeps the memory. */
void kiriField_Clear(kiriField* field);

/* ---- From scratch ---- */

/* Starts a flood from the seeds. The field must be FAR everywhere. */
bool kiriField_Start(kiriField* field, kiriMemory* memory, const kiriSeed* seeds, int32_t seedCount);

/* Continues a flood. An item of the quota is a cell settled. KIRI_FAILED: only kiriField_Clear helps. */
kiriProgress kiriField_Flood(kiriField* field, const kiriRule* rule, kiriQuota* quota);

/* Makes all cells FAR again, at the cost of those that a flood settled. Not after a repair. */
void kiriField_Reset(kiriField* field);

/* ---- Repairs ---- */

/* Marks a cell whose steps or seed may have changed, or whether ways pass through it. Never fails: Resize makes room.
   Forgets which cells a flood has settled. */
void kiriField_MarkDirty(kiriField* field, int32_t cell);

/* Marks a cell through which ways pass or do not pass as before: it costs less. */
void kiriField_MarkStepsDirty(kiriField* field, int32_t cell);

/* Makes a cell FAR that is removed, and then it must not be dirty; or one that shall be FAR. The cells that its steps
   led to must be dirty. Not logged. */
void kiriField_Forget(kiriField* field, int32_t cell);

/* Repairs the field. All affected cells must be dirty: if the limit grew, cells from which a step leads beyond the old
   limit; if it shrank, cells beyond the new limit that are not forgotten. Items of the quota: a cell whose distance is
   cleared, half of a settled cell, a possible seed of the sweep, or four cells that keep their distance. KIRI_MORE:
   call again with the same rule before anything changes. The reader of the log empties it (its count). KIRI_FAILED:
   only kiriField_Clear helps. */
kiriProgress kiriField_Repair(kiriField* field, const kiriRule* rule, kiriQuota* quota);

/* Distances of cells from the sites of frames, and from the borders of their regions: of each frame only for the cells
   that it reaches. Cells with consecutive indices, which mostly lie in a row, share a block for each frame that reaches
   one of them. So the cost of finding a cell's distances grows with the number of frames near by. */

enum { KIRI_BLOCK_CELLS = 16 };

/* The frame of a block. Stored apart from the distances: so a search along the list of some cells reads few cache
   lines. */
typedef struct kiriReachHead {
    int32_t frame;       /* KIRI_NONE: the index is not in use */
    int32_t nextOfCells; /* the block of another frame for these cells, or KIRI_NONE */
} kiriReachHead;

/* Distances of a frame at the cells from `cells` * KIRI_BLOCK_CELLS on. */
typedef struct kiriReachBlock {
    int32_t cells;
    int32_t nextOfFrame, previousOfFrame;
    int32_t fromSite[KIRI_BLOCK_CELLS]; /* KIRI_FAR where the frame does not reach the cell */
    int32_t fromBorder[KIRI_BLOCK_CELLS];
} kiriReachBlock;

typedef struct kiriReaches {
    KIRI_ARRAY(kiriReachBlock) blocks; /* by index, with gaps */
    KIRI_ARRAY(kiriReachHead) heads;   /* one for each block */
    kiriIndices ofCells;               /* of each block of cells: the head of its list, or KIRI_NONE */
    kiriIndices ofFrame;               /* of each frame: the head of its list, or KIRI_NONE */
    int32_t freeBlocks, freeBlock;     /* how many blocks are not in use, and the head of their list */
} kiriReaches;

/* Makes room for cells and frames. False for memory. */
bool kiriReaches_Resize(kiriReaches* reaches, kiriMemory* memory, int32_t cellCount, int32_t frameCount);

/* Makes it empty; keeps the memory. */
void kiriReaches_Clear(kiriReaches* reaches);

/* Finds a block, or returns KIRI_NONE. */
int32_t kiriReaches_Find(const kiriReaches* reaches, int32_t frame, int32_t cells);

/* Adds a block, which reaches nothing. The caller has reserved room in `blocks` and `heads`. */
int32_t kiriReaches_Add(kiriReaches* reaches, int32_t frame, int32_t cells);
void kiriReaches_Remove(kiriReaches* reaches, int32_t block);

/* Removes all blocks of a frame. */
void kiriReaches_Forget(kiriReaches* reaches, int32_t frame);

/* Renumbers the frames. Removed frames must have no blocks. */
void kiriReaches_Keep(kiriReaches* reaches, const kiriKeep* frames);

static inline int32_t kiriReach_BlockOf(int32_t cell)
{
    KIRI_ASSERT(cell >= 0);
    return (int32_t)((uint32_t)cell / KIRI_BLOCK_CELLS);
}

KIRI_C_END

#endif
