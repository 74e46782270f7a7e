/* The work that cuts set off in a sheet, as far as it has come. It takes all points that wait when it begins, whatever
   ticks they were given before. Mesh, grid, regions and weights do not depend on where one update ends and the next
   begins. Sites of frames would: so sites are added only where the points decide it, see settlesSites. Each stage owns
   its part; kiri_pipeline.h runs them. */
#ifndef KIRI_UPDATE_H
#define KIRI_UPDATE_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* The cut stage: the points at the head of the queue. */
typedef struct kiriCutWork {
    int64_t stamp; /* the tick that the first of them was given before */
    int32_t count, taken;
    bool meshChanged; /* or sites may be too few: the other stages have work */

    /* A blade has met the border or a lip, or a cut has ended. The update takes no points of later ticks then, and adds
       frames where they are too few. Others add none. So the sites do not depend on the budget. */
    bool settlesSites;
} kiriCutWork;

/* Sites of frames, and whatever else is placed piece by piece; kiri_site.c. */
typedef struct kiriPlacingWork {
    kiriSites sites; /* of the frames that are there, then of new ones */
    KIRI_ARRAY(kiriSiteMove) moves;
    int32_t movesSeen; /* by the regions */
    int32_t spread;    /* frames to spread over the sheet, at its start, */
    int32_t pieces;    /* and pieces that have none yet */
    kiriPlacer placer;
    bool isTaking;               /* a piece into the placer, */
    bool isPlacing;              /* in it */
    kiriSlitSearch search;       /* for its slit ends */
    bool isAgain;                /* all sites of the piece in the placer are placed again */
    bool isFirst;                /* round of re-sampling in this update */
    double whole;                /* m^2 of the sheet; while things are spread over it */
    int32_t at;                  /* orphan, frame or piece that is being seen to */
    KIRI_ARRAY(uint8_t) marks;   /* of cells, frames or pieces */
    KIRI_ARRAY(uint8_t) allowed; /* of cells */
    KIRI_ARRAY(uint8_t) flags;   /* of squares or cells */
    KIRI_ARRAY(int32_t) own;     /* frames of the piece in the placer */
} kiriPlacingWork;

typedef struct kiriSampleWork {
    int32_t oldVertices; /* at the last commit: those from there on have the weights that they were born with */
    kiriRefresh refresh;
    KIRI_ARRAY(kiriSample) newPoints;
    KIRI_ARRAY(kiriSample) movedPoints; /* `frame` is the index of a point, `cell` where it is now */
} kiriSampleWork;

/* A frame that appears with the commit. */
typedef struct kiriNewFrame {
    kiriLatticePoint anchor;
    int32_t triangle; /* that it takes its motion from */
} kiriNewFrame;

/* What a commit has changed, for the profile. */
typedef struct kiriCommitCounts {
    int32_t cells, weights, vertices, points, links;
} kiriCommitCounts;

/* What a tick that fails goes back to. */
typedef struct kiriUpdateStart {
    int32_t stage;
    kiriCutWork cut;
    int64_t spent;
} kiriUpdateStart;

typedef struct kiriUpdate {
    int32_t stage;     /* KIRI_STAGE_..., the next to run; KIRI_READY: they are done; KIRI_NONE: nothing is at hand */
    int32_t step;      /* within the stage, see there */
    int64_t spent;     /* items of the budget: with stage and step it says how far the work has come */
    bool needsRebuild; /* grid, regions and shape are of no use: to be made from scratch */
    bool isScratch;    /* as they are now */
    bool isUnsettled;  /* the mesh has changed since an update settled sites */

    kiriUpdateStart start;
    bool isBegun; /* in this tick */

    kiriGrowing growing; /* of arrays before a cut, */
    uint32_t growsSince; /* at this revision of the mesh */
    kiriCutWork cut;
    kiriPlacingWork placing;
    KIRI_ARRAY(kiriMoments) material; /* of each frame's region */
    kiriSampleWork samples;
    kiriRefit refit;
    int64_t due;                        /* items of the step at hand that are not paid yet */
    KIRI_ARRAY(kiriNewFrame) newFrames; /* in the order of their sites */
    kiriIntegrationWork integration;

    /* Staged for the commit, beside links and weights. */
    kiriLayout next;
    KIRI_ARRAY(int32_t) parent; /* of frames: union-find */
    kiriCommitCounts counts;
} kiriUpdate;

enum { KIRI_READY = KIRI_STAGE_CONTACT };

/* Do grid, regions and shape belong to the mesh as it is? */
static inline bool kiriUpdate_IsFieldCurrent(const kiriUpdate* update)
{
    bool isUntouched = update->stage == KIRI_NONE || (update->stage == KIRI_STAGE_CUT && !update->cut.meshChanged);
    return isUntouched && !update->needsRebuild;
}

KIRI_C_END

#endif
