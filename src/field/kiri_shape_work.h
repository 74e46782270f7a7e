/* What kiri_shape.c and kiri_shape_frame.c share: the update at hand. Private to them. */
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
};

/* A weight before normalisation, to be put in its place; 0: to be taken away. */
typedef struct kiriRawWeight {
    int32_t cell, frame;
    double raw;
} kiriRawWeight;

/* What an update knows of a frame. */
typedef struct kiriShapeFrame {
    int32_t limit; /* of the distances in its list */
    int32_t reach; /* the least limit that the changed cells of its region ask for */
    bool moved;    /* its site */
    bool dirty;    /* a cell came to its region, left it, or has another distance in it */
} kiriShapeFrame;

typedef enum kiriShapeStage {
    KIRI_SHAPE_REST,
    KIRI_SHAPE_MEASURE,
    KIRI_SHAPE_MAKE_ROOM,
    KIRI_SHAPE_PLACE,
    KIRI_SHAPE_NORMALIZE
} kiriShapeStage;

/* Which distances of the frame at hand are being measured. */
typedef enum kiriFrameStage { KIRI_FRAME_REST, KIRI_FRAME_SITE, KIRI_FRAME_BORDER } kiriFrameStage;

struct kiriShapeWork {
    /* Of the frame at hand; empty between frames. All seeds are its own, so they need no owner, and neither do the
       distances that are loaded from its list. */
    kiriField fromSite;   /* distances to its site, no farther than its weight may be above zero, */
    kiriField fromBorder; /* and to the border of its region */
    kiriSeeds seeds;
    kiriFrameStage frameStage;

    KIRI_ARRAY(uint8_t) marks;       /* of each cell */
    KIRI_ARRAY(int32_t) wasOwner;    /* of cells with KIRI_MARK_REGION */
    KIRI_ARRAY(int32_t) awaited;     /* of cells without weights: how many are still to be put there */
    KIRI_ARRAY(int64_t) rigidShares; /* of each cell: what it adds to the rigid sums of its frames */
    KIRI_ARRAY(kiriShapeFrame) frames;
    KIRI_ARRAY(kiriRawWeight) rawWeights; /* by frame */
    KIRI_ARRAY(int32_t) dirty;            /* cells whose weights do not sum to 1 yet, or that have other material */
    int32_t low[2], high[2];              /* the box of columns and rows in which something changed */
    kiriShapeStage stage;
    int32_t next; /* item of the stage at which the work goes on */
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
    int32_t frame;
} kiriShapeJob;

/* How far distances to the site of its region have to go for the sake of a cell. */
int32_t kiriShapeJob_ReachAt(const kiriShapeJob* job, int32_t cell);

/* May the distances of the frame at hand have changed? */
bool kiriShapeJob_IsFrameDirty(const kiriShapeJob* job);

/* Measures the distances of the frame at hand again: brings its list up to date, and adds the weights that follow to
   job->work->rawWeights. An item of the quota: see kiriField_Flood and kiriField_Repair. */
kiriProgress kiriShapeJob_MeasureFrame(kiriShapeJob* job, kiriQuota* quota);

KIRI_C_END

#endif
