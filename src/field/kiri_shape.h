/* Shape functions: weights of the frames on the cells (section 4.1 of the paper, algorithm 2; after Faure, Gilles,
   Bousquet, Pai 2011). */
#ifndef KIRI_SHAPE_H
#define KIRI_SHAPE_H

#include "kiri_geodesic.h"
#include "kiri_region.h"

KIRI_C_BEGIN

typedef struct kiriWeight {
    int32_t frame; /* index of the site */
    double value;
} kiriWeight;

/* A weight at a cell. A double in two parts, to avoid padding. */
typedef struct kiriCellWeight {
    int32_t frame;
    uint32_t low, high; /* see kiriCellWeight_Value */
} kiriCellWeight;

static inline kiriCellWeight kiriCellWeight_Make(int32_t frame, double value)
{
    uint64_t bits;
    memcpy(&bits, &value, sizeof(bits));
    return (kiriCellWeight){ frame, (uint32_t)bits, (uint32_t)(bits >> 32) };
}

static inline double kiriCellWeight_Value(const kiriCellWeight* weight)
{
    uint64_t bits = (uint64_t)weight->high << 32 | weight->low;
    double value;
    memcpy(&value, &bits, sizeof(value));
    return value;
}

typedef struct kiriShapeWork kiriShapeWork; /* the update in progress, see below */

typedef struct kiriShape {
    KIRI_ARRAY(kiriSpan) spans;         /* of each cell: its weights */
    KIRI_ARRAY(kiriCellWeight) weights; /* by spans; in a span by frame; above zero, sum 1 */
    kiriSpans room;
    kiriReaches reaches; /* of each frame: distances of the cells that its weight may reach */

    /* Per frame: the area of its rigid cells, where its weight exceeds rigidWeight. The unit is 2^-40 of a square:
       integer sums do not depend on their order. */
    KIRI_ARRAY(int64_t) rigid;
    double rigidWeight; /* set before the first update */
    bool eased; /* weights of points have no kinks at sites, see kiri_stencil.c; weights of cells are linear */

    /* Since kiriShape_ClearChanges: cells in use, each once, whose weights or steps changed, and new ones. */
    kiriIndices changes;
    int64_t recomputed; /* how many of them have other weights */
    kiriShapeWork* work;
} kiriShape;

/* Updates distances and weights after changes of grid and regions; the caller clears those changes afterwards. `moves`
   as in kiriRegions_Update: distances to a moved site are recomputed. Every cell with an owner gets weights. KIRI_MORE:
   call again before grid, regions or sites change. KIRI_FAILED: only kiriShape_Reset helps.

   Items of the quota: one for each changed cell, and two for each frame that reaches it; the items of kiriField_Repair;
   eight for each block of distances loaded, two for each block stored, and half for each cell with other distances;
   then one for each such cell, and a third for each of its weights. Work beyond the quota is deducted from the next
   ones. */
kiriProgress kiriShape_Update(kiriShape* shape, const kiriGrid* grid, const kiriRegions* regions, const kiriSite* sites,
                              int32_t siteCount, const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota);

/* Removes the listed cells, which must be all that the frames reach that are not kept, and gives the other frames their
   new index. Not during an update, nor before its changes are cleared. Cannot fail. */
void kiriShape_Keep(kiriShape* shape, kiriMemory* memory, const kiriKeep* frames, const int32_t* gone,
                    int32_t goneCount);
void kiriShape_ClearChanges(kiriShape* shape);

/* Adds the debt of the update in progress to the state hash. */
void kiriShape_HashProgress(const kiriShape* shape, uint64_t* hash);

/* Gives back the room of lists that are as long as the grid only from scratch. Not during an update. */
void kiriShape_DropScratch(kiriShape* shape, kiriMemory* memory);
void kiriShape_Reset(kiriShape* shape);

/* The update in progress. Private to kiri_shape.c, and to snapshots. */

/* State of a frame during an update. */
typedef struct kiriShapeFrame {
    int32_t limit;      /* of its distances */
    kiriSpan sides;     /* in work->sideCounts: for each number of sides, how many cells of its region need it */
    int32_t firstTouch; /* in work->touches, or KIRI_NONE */
    bool moved;         /* its site */
    bool dirty;         /* its distances or weights may have changed */
} kiriShapeFrame;

/* The frame of a cell's region, and how many whole sides distances to the site there have to go for its sake. */
typedef struct kiriCountedCell {
    int32_t frame, sides;
} kiriCountedCell;

/* A changed cell that a frame reaches. */
typedef struct kiriTouchedCell {
    int32_t cell, next; /* the next one of the frame, or KIRI_NONE */
} kiriTouchedCell;

/* Cells whose distances are loaded, and the block that they are from, or KIRI_NONE. */
typedef struct kiriLoadedBlock {
    int32_t cells, block;
} kiriLoadedBlock;

struct kiriShapeWork {
    /* Of the frame that is measured; empty between frames. All seeds are its own, so they need no owner, and neither do
       the distances that are loaded from its blocks: only those near changes. */
    kiriField fromSite;   /* distances to its site, no farther than its weight may be above zero, */
    kiriField fromBorder; /* and to the border of its region */
    kiriSeeds seeds;
    KIRI_ARRAY(kiriLoadedBlock) loaded;
    kiriFlags isLoaded; /* of each block of cells */

    kiriFlags marks;                     /* of each cell */
    kiriIndices wasOwner;                /* of cells whose owner or distance changed */
    KIRI_ARRAY(int64_t) rigidShares;     /* of each cell: its area in the rigid sums of its frames */
    KIRI_ARRAY(kiriCountedCell) counted; /* of each cell */
    kiriIndices sideCounts;
    kiriSpans sideRoom;
    KIRI_ARRAY(kiriShapeFrame) frames;
    kiriIndices dirtyFrames;
    KIRI_ARRAY(kiriTouchedCell) touches;
    kiriIndices dirty; /* cells with other distances or material */
    KIRI_ARRAY(kiriCellWeight) weights; /* of one cell */
    bool running;
    bool isMeasuring;    /* a distance field of the current item */
    int32_t stage, item; /* the next to do */
    int64_t debt;        /* items of work that the quota has not paid yet */
};

KIRI_C_END

#endif
