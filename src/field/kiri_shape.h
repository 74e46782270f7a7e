/* Shape functions: weights of the frames on the cells (section 4.1 of the paper, algorithm 2; after Faure, Gilles,
   Bousquet, Pai 2011). */
#ifndef KIRI_SHAPE_H
#define KIRI_SHAPE_H

#include "kiri_geodesic.h"
#include "kiri_region.h"

#include <string.h>

KIRI_C_BEGIN

typedef struct kiriWeight {
    int32_t frame; /* index of the site */
    double value;
} kiriWeight;

/* A weight at a cell, before the weights there are divided by their sum. A double in two parts: so it takes no
   padding. */
typedef struct kiriCellWeight {
    int32_t label;      /* of the frame */
    uint32_t low, high; /* see kiriCellWeight_Raw */
} kiriCellWeight;

static inline kiriCellWeight kiriCellWeight_Make(int32_t label, double raw)
{
    uint64_t bits;
    memcpy(&bits, &raw, sizeof(bits));
    return (kiriCellWeight){ label, (uint32_t)bits, (uint32_t)(bits >> 32) };
}

static inline double kiriCellWeight_Raw(const kiriCellWeight* weight)
{
    uint64_t bits = (uint64_t)weight->high << 32 | weight->low;
    double raw;
    memcpy(&raw, &bits, sizeof(raw));
    return raw;
}

typedef struct kiriShapeWork kiriShapeWork; /* the update at hand: kiri_shape.h */

typedef struct kiriShape {
    kiriLabels
        labels; /* of frames, in weights of cells and of samples: so no frame that goes changes those of others */
    KIRI_ARRAY(kiriSpan) spans;         /* of each cell: its weights */
    KIRI_ARRAY(kiriCellWeight) weights; /* by spans; in a span by label; above zero */
    kiriSpans room;
    kiriReaches reaches; /* of each frame: how far cells are that its weight may reach */

    /* Of each frame: the cells in which its weight exceeds rigidWeight, as shares of whole squares, in units of 2^-40:
       a whole number, so that it does not depend on the order of adding. */
    KIRI_ARRAY(int64_t) rigid;
    double rigidWeight; /* set before the first update */
    bool eased; /* weights of points have no kinks at sites, see kiri_stencil.c; those of cells are linear in between */

    /* Since kiriShape_ClearChanges: live cells, each once, whose weights or steps changed, and new ones. */
    KIRI_ARRAY(int32_t) changes;
    int64_t recomputed; /* and for how many of them a weight was computed */
    kiriShapeWork* work;
} kiriShape;

/* What the raw weights of a cell are divided by. */
static inline double kiriShape_Sum(const kiriShape* shape, kiriSpan span)
{
    double sum = 0.0;
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        sum += kiriCellWeight_Raw(&shape->weights.data[k]);
    }
    return sum;
}

/* Follows the changes of grid and regions, which are cleared after it. Costs what it touches. `moves` as in
   kiriRegions_Update: distances to such a site are made from scratch. Items of the quota: one for a cell about which
   grid or regions have changed something, and two for each frame that reaches one; a cell whose distance is repaired,
   see kiriField_Repair; eight for a block of distances that is loaded, two for one that goes back, and one for two
   cells in it that have others; three weights put in their place; a cell that gets room for its first weights or whose
   weights are all in their place; 128 bytes that move where arrays grow. Every cell with an owner gets weights.
   KIRI_MORE: call again before grid, regions or sites change. KIRI_FAILED: only kiriShape_Reset helps. */
kiriProgress kiriShape_Update(kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                              const kiriRegions* regions, const kiriSite* sites, int32_t siteCount,
                              const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota);

/* The cells go that are listed, which are all that the frames reach that are not kept; others get their new index.
   `labels`: what labels become (kiriLabels_Map); null: they stay, and there is room to list them. Not during an update,
   nor before its changes are cleared. Never fails. */
void kiriShape_Keep(kiriShape* shape, kiriMemory* memory, const kiriKeep* frames, const kiriKeep* labels,
                    const int32_t* gone, int32_t goneCount);
void kiriShape_ClearChanges(kiriShape* shape);

/* How far the update at hand has come, for the state hash: it is not all in what the quota has given. */
void kiriShape_HashProgress(const kiriShape* shape, uint64_t* hash);

/* Gives back the room of what is as long as what an update changes. Not during an update. */
void kiriShape_DropScratch(kiriShape* shape, kiriMemory* memory);
void kiriShape_Reset(kiriShape* shape);

/* The update that kiri_shape.c works on. Private to it, and to saves. */

/* Of a cell. */
enum {
    KIRI_MARK_STEPS = 1, /* new, or its steps changed */
    KIRI_MARK_GONE = 2,
    KIRI_MARK_REGION = 4,      /* its owner or the distance to its site changed */
    KIRI_MARK_CHANGED = 8,     /* it is in shape->changes, */
    KIRI_MARK_RECOMPUTED = 16, /* and in shape->recomputed */
    KIRI_MARK_DIRTY = 32,      /* it is in work->dirty */
    KIRI_MARK_SEED = 64,       /* the site of the frame at hand may send it a seed */
    KIRI_MARK_SEEN = 128,      /* the cells that its steps lead to are loaded */
};

/* Of a block of cells. */
enum {
    KIRI_BLOCK_LOADED = 1,
    KIRI_BLOCK_TURNED = 2 /* a cell in it has come to the region of the frame, or left it */
};

/* A weight before normalisation, to be put in its place; 0: to be taken away. */
typedef struct kiriRawWeight {
    int32_t cell, frame;
    double raw;
} kiriRawWeight;

/* What an update knows of a frame. */
typedef struct kiriShapeFrame {
    int32_t limit;  /* of its distances */
    kiriSpan sides; /* of work->sideCounts: of each number of sides, how many cells of its region ask for it */
    int32_t touches, firstTouch; /* how many, and which */
    bool moved;                  /* its site */
    bool dirty;                  /* its distances or weights may have changed */
} kiriShapeFrame;

/* Whose region a cell is in, by label, and how many whole sides distances to the site there have to go for its sake. */
typedef struct kiriCountedCell {
    int32_t label, sides;
} kiriCountedCell;

/* A cell about which something has changed, and that a frame reaches. */
typedef struct kiriTouchedCell {
    int32_t cell, next; /* the next one of the frame, or KIRI_NONE */
} kiriTouchedCell;

/* Cells whose distances are loaded, and the block that they are from, or KIRI_NONE. */
typedef struct kiriLoadedBlock {
    int32_t cells, block;
} kiriLoadedBlock;

typedef enum kiriShapeStage {
    KIRI_SHAPE_REST,
    KIRI_SHAPE_MARK,
    KIRI_SHAPE_MEASURE,
    KIRI_SHAPE_MAKE_ROOM,
    KIRI_SHAPE_PLACE,
    KIRI_SHAPE_FINISH
} kiriShapeStage;

/* Which distances of the frame at hand are being measured. */
typedef enum kiriFrameStage {
    KIRI_FRAME_REST,
    KIRI_FRAME_SITE,
    KIRI_FRAME_BORDER,
    KIRI_FRAME_UNLOAD,
    KIRI_FRAME_SEEDS /* after KIRI_FRAME_SITE: what follows from it for the border */
} kiriFrameStage;

struct kiriShapeWork {
    /* Of the frame at hand; empty between frames. All seeds are its own, so they need no owner, and neither do the
       distances that are loaded from its blocks: only those near what changes. */
    kiriField fromSite;   /* distances to its site, no farther than its weight may be above zero, */
    kiriField fromBorder; /* and to the border of its region */
    kiriSeeds seeds;
    kiriFrameStage frameStage;
    KIRI_ARRAY(kiriLoadedBlock) loaded;
    KIRI_ARRAY(uint8_t) isLoaded; /* of each block of cells: KIRI_BLOCK_LOADED... */

    KIRI_ARRAY(uint8_t) marks;       /* of each cell */
    KIRI_ARRAY(int32_t) wasOwner;    /* of cells with KIRI_MARK_REGION */
    KIRI_ARRAY(int32_t) awaited;     /* of cells without weights: how many are still to be put there */
    KIRI_ARRAY(int64_t) rigidShares; /* of each cell: what it adds to the rigid sums of its frames */
    KIRI_ARRAY(kiriCountedCell) counted;
    KIRI_ARRAY(int32_t) sideCounts;
    kiriSpans sideRoom;
    KIRI_ARRAY(kiriShapeFrame) frames;
    KIRI_ARRAY(int32_t) dirtyFrames;
    KIRI_ARRAY(kiriTouchedCell) touches;
    KIRI_ARRAY(kiriRawWeight) rawWeights; /* by frame */
    KIRI_ARRAY(int32_t) dirty; /* cells whose weights are not all in their place yet, or that have other material */
    kiriShapeStage stage;
    int32_t next;        /* item of the stage at which the work goes on */
    int64_t due;         /* for blocks that were loaded: the quota has not given it yet */
};

/* An update, and the frame at hand. */
typedef struct kiriShapeJob {
    kiriShape* shape;
    kiriShapeWork* work;
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const kiriRegions* regions;
    const kiriSite* sites;
    int32_t siteCount;
    int32_t frame, label;
} kiriShapeJob;

KIRI_C_END

#endif
