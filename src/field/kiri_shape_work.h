/* The update that kiri_shape.c works on. Private to it, and to saves. */
#ifndef KIRI_SHAPE_WORK_H
#define KIRI_SHAPE_WORK_H

#include "kiri_shape.h"

KIRI_C_BEGIN

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
    kiriGrowing growing; /* what the frame at hand needs room for */
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
