/* The one table of stages: a tick, a new sheet and the part of a sheet all run it. */
#ifndef KIRI_PIPELINE_H
#define KIRI_PIPELINE_H

#include "kiri_update.h"

KIRI_C_BEGIN

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

/* The same as far as the quotas go. KIRI_MORE: again with new ones. */
kiriProgress kiriPipeline_MakeSome(kiriSheetData* sheet, int32_t end, kiriQuotas* quotas);

/* At the start of a tick: begins an update with all pending points, unless one is under way. */
void kiriPipeline_Start(kiriSheetData* sheet);

/* Has the stage at hand a quota with something left? */
bool kiriPipeline_CanRun(const kiriSheetData* sheet, const kiriQuotas* quotas);

/* Carries the work at hand on as far as the quotas go. KIRI_DONE: it is ready to commit. KIRI_FAILED: abort it. */
kiriProgress kiriPipeline_Run(kiriSheetData* sheet, kiriQuotas* quotas, const kiriWatch* watch);

/* After a commit, or when the points changed nothing: they leave the queue. */
void kiriPipeline_Finish(kiriSheetData* sheet);

/* Takes back what this tick has done, as far as anyone can see. Grid, regions and shape are made from scratch then. */
void kiriPipeline_Abort(kiriSheetData* sheet);

KIRI_C_END

#endif
