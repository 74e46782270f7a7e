/* Progress of an update: the work that follows a cut, spread over ticks. An update takes all points that are pending
   when it starts. Mesh, grid, regions and weights do not depend on how points are grouped into updates. Sites of frames
   would, so sites are added only at moments that the points decide, see settlesSites. */
#ifndef KIRI_UPDATE_H
#define KIRI_UPDATE_H

#include "kiri_sheet.h"
#include "../core/kiri_archive.h"

KIRI_C_BEGIN

/* State of the cut stage: it processes the points at the head of the queue. */
typedef struct kiriCutWork {
    int64_t stamp; /* stamp of the first of these points */
    int32_t count, taken;
    bool meshChanged; /* the mesh changed, or there may be too few sites: the other stages have work */

    /* A blade reached the border or a lip, or a cut ended. Then the update takes no points of later ticks and adds
       frames if there are too few. No other update adds frames, so the sites do not depend on the budget. */
    bool settlesSites;
} kiriCutWork;

/* State of the placer: sites of frames, and points, are placed piece by piece. See kiri_sheet_site.c. */
typedef struct kiriPlacingWork {
    kiriSites sites; /* of existing frames, then of new ones */
    KIRI_ARRAY(kiriSiteMove) moves;
    int32_t movesSeen; /* count of moves that the regions have processed */
    int32_t spread;    /* frames to spread over a new sheet */
    int32_t pieces;    /* count of pieces that have no frame yet */
    kiriPlacer placer;
    bool isTaking;               /* the placer is collecting a piece */
    bool isPlacing;              /* the placer is placing sites */
    kiriSlitSearch search;       /* slit ends of the piece */
    bool isAgain;                /* all sites of the piece are placed again */
    bool isFirst;                /* first round of re-sampling in this update */
    double whole;                /* m^2: area of the sheet, while items are spread over it */
    int32_t at;                  /* current orphan, frame or piece */
    KIRI_ARRAY(uint8_t) marks;   /* per cell, frame or piece */
    KIRI_ARRAY(uint8_t) allowed; /* per cell */
    KIRI_ARRAY(uint8_t) flags;   /* per square or cell */
    KIRI_ARRAY(int32_t) own;     /* frames of the current piece */
} kiriPlacingWork;

typedef struct kiriSampleWork {
    int32_t oldVertices; /* vertex count at the last commit; newer vertices have interpolated weights */
    kiriRefresh refresh;
    KIRI_ARRAY(kiriSample) newPoints;
    KIRI_ARRAY(kiriSample) movedPoints; /* `frame` is the index of a point, `cell` its new cell */
} kiriSampleWork;

/* A frame that the commit adds. */
typedef struct kiriNewFrame {
    kiriLatticePoint anchor;
    int32_t triangle; /* source of its motion */
} kiriNewFrame;

/* Items that a commit changed, for the profile. */
typedef struct kiriCommitCounts {
    int32_t cells, weights, vertices, points, links;
} kiriCommitCounts;

typedef struct kiriUpdate {
    int32_t stage;     /* KIRI_STAGE_..., the next to run; KIRI_READY: all are done; KIRI_NONE: no update */
    int32_t step;      /* within the stage */
    int64_t spent;     /* budget items; stage, step and spent together measure the progress */
    bool needsRebuild; /* grid, regions and shape are invalid: the next update rebuilds them */
    bool isScratch;    /* this update rebuilds grid, regions and shape */
    bool isUnsettled;  /* the mesh has changed since an update settled sites */

    kiriCutWork cut;
    kiriPlacingWork placing;
    KIRI_ARRAY(kiriMoments) material; /* moments of each frame's region */
    kiriSampleWork samples;
    kiriRefit refit;
    int64_t due;                        /* items of the current step that are not paid yet */
    KIRI_ARRAY(kiriNewFrame) newFrames; /* in the order of their sites */
    kiriIntegrationWork integration;

    /* Staged for the commit, beside links and weights. */
    kiriLayout next;
    KIRI_ARRAY(int32_t) parent; /* union-find of frames */
    kiriCommitCounts counts;
} kiriUpdate;

enum { KIRI_READY = KIRI_STAGE_CONTACT };

/* The last step of KIRI_STAGE_CONSTANTS. */
enum { KIRI_PREPARE_COMMIT = 2 };

/* Returns true if grid, regions and shape match the current mesh. */
static inline bool kiriUpdate_IsFieldCurrent(const kiriUpdate* update)
{
    bool isUntouched = update->stage == KIRI_NONE || (update->stage == KIRI_STAGE_CUT && !update->cut.meshChanged);
    return isUntouched && !update->needsRebuild;
}

/* The stages of an update, in order, then its commit. Each stage continues where the quota of the last tick ended. The
   cost is proportional to the items that the cut touched. KIRI_FAILED: out of memory. */

kiriProgress kiriStage_SplitMesh(kiriSheetData* sheet, kiriQuota* triangles);
kiriProgress kiriStage_Grid(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Regions(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Shape(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Samples(kiriSheetData* sheet, kiriQuota* samples);
kiriProgress kiriStage_Constants(kiriSheetData* sheet, kiriQuota* samples);

/* Runs a stage in steps, from sheet->update->step on, which starts at 0. */
typedef kiriProgress kiriStageStep(kiriSheetData* sheet, kiriQuota* quota);
kiriProgress kiriStage_RunSteps(kiriSheetData* sheet, kiriQuota* quota, kiriStageStep* const* steps, int32_t count);

/* Runs the first step of KIRI_STAGE_CONSTANTS for a new sheet. It depends on the mesh alone. */
kiriProgress kiriStage_Owners(kiriSheetData* sheet, kiriQuota* samples);

/* Stages the solver for `frameCount` frames, with the staged links and layout. Fails on out of memory. */
bool kiriStage_Solver(kiriSheetData* sheet, int32_t frameCount);

/* Commits the mesh changes of this tick. Cannot fail. */
void kiriStage_CommitMesh(kiriSheetData* sheet);

/* Commits the staged state after the last stage. New frames take their motion from the previous surface (section 5 of
   the paper). Cannot fail. */
void kiriStage_Commit(kiriSheetData* sheet);

/* Drops the staged state. */
void kiriStage_Drop(kiriSheetData* sheet);

/* The pipeline of stages: ticks, new sheets and detached parts run it. */

enum { KIRI_QUOTA_TRIANGLES, KIRI_QUOTA_CELLS, KIRI_QUOTA_SAMPLES, KIRI_QUOTA_ITERATIONS, KIRI_QUOTA_COUNT };

/* Remaining budget of this tick. */
typedef struct kiriQuotas {
    kiriQuota of[KIRI_QUOTA_COUNT];
    int64_t limits[KIRI_QUOTA_COUNT]; /* items a tick; INT64_MAX: no limit */
} kiriQuotas;

/* Returns the quotas of a budget, in which 0 means no limit. */
kiriQuotas kiriQuotas_Of(const kiriBudget* budget);
kiriQuotas kiriQuotas_Unlimited(void);

/* Shares one allowance among the three quotas for cuts: using 30 % of one leaves 70 % of the others. So a tick takes no
   longer than the costliest of the three alone. */
void kiriQuotas_Share(kiriQuotas* quotas, int spent);

/* Callback at the start of each stage, for the profile. */
typedef struct kiriWatch {
    void (*enter)(void* context, int32_t stage);
    void* context;
} kiriWatch;

/* Runs the stages of a new sheet that has only its mesh, from the grid up to the stage `end`, without a limit. Call it
   again for later stages. Fails on out of memory. */
bool kiriPipeline_Make(kiriSheetData* sheet, int32_t end);

/* Starts an update with all pending points, unless one is running. Call at the start of a tick. */
void kiriPipeline_Start(kiriSheetData* sheet);

/* Returns true if the quota of the current stage has items left. */
bool kiriPipeline_CanRun(const kiriSheetData* sheet, const kiriQuotas* quotas);

/* Continues the update as far as the quotas allow. KIRI_DONE: ready to commit. KIRI_FAILED: out of memory; the next
   tick continues. */
kiriProgress kiriPipeline_Run(kiriSheetData* sheet, kiriQuotas* quotas, const kiriWatch* watch);

/* Ends the update and removes its points from the queue. Call after a commit, or if the points changed nothing. */
void kiriPipeline_Finish(kiriSheetData* sheet);

/* Defers the commit to the next tick, which prepares it again: the host may change pins in between. */
void kiriPipeline_Wait(kiriSheetData* sheet);

KIRI_C_END

#endif
