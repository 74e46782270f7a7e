/* The work on a cut, spread over ticks: its stages, and the commit of their results. */
#ifndef KIRI_UPDATE_H
#define KIRI_UPDATE_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Stages the solver for `frameCount` frames, with the staged links and layout, or the ones in use. Fails on out of
   memory. */
bool kiriStage_Solver(kiriSheetData* sheet, int32_t frameCount, const kiriMaterial* material, bool isNext);

/* Runs the first step of KIRI_STAGE_CONSTANTS for a new sheet. It depends on the mesh alone. */
kiriProgress kiriStage_Owners(kiriSheetData* sheet, kiriQuota* samples);

/* Commits the mesh changes of this tick. Cannot fail. */
void kiriStage_CommitMesh(kiriSheetData* sheet);

/* Commits the staged state after the last stage. New frames take their motion from the previous surface (section 5 of
   the paper). Cannot fail. */
void kiriStage_Commit(kiriSheetData* sheet);

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

/* Starts an update with all pending points, or for the pins of a new sheet, unless one runs. ticks: of the world. */
void kiriPipeline_Start(kiriSheetData* sheet, int64_t ticks);

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
