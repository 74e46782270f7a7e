/* The work that cuts set off in a sheet, as far as it has come. It takes all points that wait when it begins, whatever
   ticks they were given before. Mesh, grid, regions and weights do not depend on where one update ends and the next
   begins. Sites of frames would: so sites are added only where the points decide it, see settlesSites. Each stage owns
   its part; kiri_update.h runs them. */
#ifndef KIRI_UPDATE_H
#define KIRI_UPDATE_H

#include "kiri_sheet.h"
#include "../core/kiri_archive.h"

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

/* Sites of frames, and whatever else is placed piece by piece; kiri_sheet_site.c. */
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

typedef struct kiriUpdate {
    int32_t stage;     /* KIRI_STAGE_..., the next to run; KIRI_READY: they are done; KIRI_NONE: nothing is at hand */
    int32_t step;      /* within the stage, see there */
    int64_t spent;     /* items of the budget: with stage and step it says how far the work has come */
    bool needsRebuild; /* grid, regions and shape are of no use: to be made from scratch */
    bool isScratch;    /* as they are now */
    bool isUnsettled;  /* the mesh has changed since an update settled sites */

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

/* The last step of KIRI_STAGE_CONSTANTS. */
enum { KIRI_PREPARE_COMMIT = 2 };

/* Do grid, regions and shape belong to the mesh as it is? */
static inline bool kiriUpdate_IsFieldCurrent(const kiriUpdate* update)
{
    bool isUntouched = update->stage == KIRI_NONE || (update->stage == KIRI_STAGE_CUT && !update->cut.meshChanged);
    return isUntouched && !update->needsRebuild;
}

/* The stages of the work on a cut, in their order, and what its commit does. Each stage goes on where the quota of the
   last tick ended, and costs what the cut touched. KIRI_FAILED is for memory. kiri_update.h runs them. */

kiriProgress kiriStage_SplitMesh(kiriSheetData* sheet, kiriQuota* triangles);
kiriProgress kiriStage_Grid(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Regions(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Shape(kiriSheetData* sheet, kiriQuota* cells);
kiriProgress kiriStage_Samples(kiriSheetData* sheet, kiriQuota* samples);
kiriProgress kiriStage_Constants(kiriSheetData* sheet, kiriQuota* samples);

/* A stage in steps: goes on with sheet->update->step, which starts with 0. */
typedef kiriProgress kiriStageStep(kiriSheetData* sheet, kiriQuota* quota);
kiriProgress kiriStage_RunSteps(kiriSheetData* sheet, kiriQuota* quota, kiriStageStep* const* steps, int32_t count);

/* Of a sheet that is made: the first step of the constants, which depends on the mesh alone. */
kiriProgress kiriStage_Owners(kiriSheetData* sheet, kiriQuota* samples);

/* Stages the solver for so many frames, with the links and the layout that are staged. False for memory. */
bool kiriStage_Solver(kiriSheetData* sheet, int32_t frameCount);

/* What this tick did to the mesh becomes final. Never fails. */
void kiriStage_CommitMesh(kiriSheetData* sheet);

/* After the last stage: what is staged comes in force. New frames take their motion from the surface as it was (section
   5 of the paper). Never fails. */
void kiriStage_Commit(kiriSheetData* sheet);

/* Forgets what is staged. */
void kiriStage_Drop(kiriSheetData* sheet);

/* The one table of stages: a tick, a new sheet and the part of a sheet all run it. */

enum { KIRI_QUOTA_TRIANGLES, KIRI_QUOTA_CELLS, KIRI_QUOTA_SAMPLES, KIRI_QUOTA_ITERATIONS, KIRI_QUOTA_COUNT };

/* What is left of the budget in this tick. */
typedef struct kiriQuotas {
    kiriQuota of[KIRI_QUOTA_COUNT];
    int64_t limits[KIRI_QUOTA_COUNT]; /* what a tick has; INT64_MAX: no limit */
} kiriQuotas;

/* 0: no limit. */
kiriQuotas kiriQuotas_Of(const kiriBudget* budget);
kiriQuotas kiriQuotas_Unlimited(void);

/* What has been spent of one kind of work on cuts leaves as much less of the other two: so a tick takes as long as the
   costliest of the three does alone. */
void kiriQuotas_Share(kiriQuotas* quotas, int spent);

/* Is told which stage begins, for the profile. */
typedef struct kiriWatch {
    void (*enter)(void* context, int32_t stage);
    void* context;
} kiriWatch;

/* For a sheet that has its mesh, and nothing else: runs the stages from the grid up to the stage `end`, without a
   limit. Again for the next ones. False for memory. */
bool kiriPipeline_Make(kiriSheetData* sheet, int32_t end);

/* At the start of a tick: begins an update with all pending points, unless one is under way. */
void kiriPipeline_Start(kiriSheetData* sheet);

/* Has the stage at hand a quota with something left? */
bool kiriPipeline_CanRun(const kiriSheetData* sheet, const kiriQuotas* quotas);

/* Carries the work at hand on as far as the quotas go. KIRI_DONE: it is ready to commit. KIRI_FAILED: out of memory; it goes on in
   the next tick. */
kiriProgress kiriPipeline_Run(kiriSheetData* sheet, kiriQuotas* quotas, const kiriWatch* watch);

/* After a commit, or when the points changed nothing: they leave the queue. */
void kiriPipeline_Finish(kiriSheetData* sheet);

/* In a tick that cannot commit: the commit is prepared again in the next, for the host may change pins in between. */
void kiriPipeline_Wait(kiriSheetData* sheet);

KIRI_C_END

#endif
