#include "kiri_pipeline.h"

#include "kiri_seen.h"
#include "kiri_stages.h"

#include <string.h>

typedef struct PipelineStage {
    int quota;
    kiriProgress (*run)(kiriSheetData* sheet, kiriQuota* quota);
} PipelineStage;

/* What a cut sets off, in the order of KIRI_STAGE. Any stage may spend its quota, or run out of memory; nothing is in
   force before the commit. */
static const PipelineStage pipeline[KIRI_READY] = {
    { KIRI_QUOTA_TRIANGLES, kiriStage_SplitMesh }, /* appendix A, algorithm 4 */
    { KIRI_QUOTA_CELLS, kiriStage_Grid },          /* section 4.2, algorithm 3 */
    { KIRI_QUOTA_CELLS, kiriStage_Regions },       /* section 5: frames for pieces that have none */
    { KIRI_QUOTA_CELLS, kiriStage_Shape },         /* section 4.1, algorithm 2; re-sampling of section 5 */
    { KIRI_QUOTA_SAMPLES, kiriStage_Samples },     /* section 6 */
    { KIRI_QUOTA_SAMPLES, kiriStage_Constants },   /* owners of material, new frames, the pattern of the matrix */
};

kiriQuotas kiriQuotas_Of(const kiriBudget* budget)
{
    const int32_t items[KIRI_QUOTA_COUNT] = { budget->triangles, budget->cells, budget->samples, budget->iterations };
    kiriQuotas quotas;
    for (int kind = 0; kind < KIRI_QUOTA_COUNT; ++kind) {
        quotas.limits[kind] = items[kind] > 0 ? items[kind] : INT64_MAX;
        quotas.of[kind] = (kiriQuota){ quotas.limits[kind], 0, 0, false };
    }
    return quotas;
}

kiriQuotas kiriQuotas_Unlimited(void)
{
    const kiriBudget unlimited = { 0, 0, 0, 0 };
    return kiriQuotas_Of(&unlimited);
}

void kiriQuotas_Share(kiriQuotas* quotas, int spent)
{
    int64_t left = quotas->of[spent].left, limit = quotas->limits[spent];
    for (int kind = 0; kind < KIRI_QUOTA_ITERATIONS; ++kind) {
        if (kind != spent && left < limit && limit < INT64_MAX && quotas->limits[kind] < INT64_MAX) {
            int64_t most = left * quotas->limits[kind] / limit; /* each has 31 bits */
            kiriQuota* quota = &quotas->of[kind];
            quota->left = kiriMin(quota->left, most);
            quota->isShared = true;
        }
    }
}

static kiriProgress RunUpTo(kiriSheetData* sheet, int32_t end, kiriQuotas* quotas, const kiriWatch* watch)
{
    kiriUpdate* u = sheet->update;
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && u->stage < end) {
        KIRI_ASSERT(u->stage >= KIRI_STAGE_CUT && u->stage < KIRI_READY);
        kiriQuota* quota = &quotas->of[pipeline[u->stage].quota];
        int64_t done = quota->used + quota->beyond;
        if (watch != NULL) {
            watch->enter(watch->context, u->stage);
        }
        progress = quota->left > 0 ? pipeline[u->stage].run(sheet, quota) : KIRI_MORE;
        u->spent += quota->used + quota->beyond - done;
        quota->left = progress == KIRI_MORE ? 0 : quota->left; /* too little for the next item: nobody else gets it */
        kiriQuotas_Share(quotas, pipeline[u->stage].quota);
        if (progress == KIRI_DONE) {
            /* A blade may move outside the sheet, or along edges that are open already. */
            bool isOver = u->stage == KIRI_STAGE_CUT && !u->cut.meshChanged;
            u->stage = isOver ? KIRI_READY : u->stage + 1;
            u->step = 0;
        }
    }
    return progress;
}

/* Weights for all vertices, none yet. */
static bool StartSkin(kiriSheetData* sheet)
{
    kiriSkin* skin = &sheet->vertexSkin;
    if (!kiriArray_Resize(sheet->memory, &skin->spans, sheet->mesh.vertices.count)) {
        return false;
    }
    memset(skin->spans.data, 0, sizeof(kiriSpan) * (size_t)skin->spans.count);
    return true;
}

kiriProgress kiriPipeline_MakeSome(kiriSheetData* sheet, int32_t end, kiriQuotas* quotas)
{
    if (sheet->update == NULL) {
        sheet->update = kiriMemory_AllocZeroed(sheet->memory, sizeof(kiriUpdate));
        if (sheet->update == NULL || !StartSkin(sheet)) {
            return KIRI_FAILED;
        }
        sheet->update->stage = KIRI_STAGE_GRID;
        sheet->update->isScratch = true;
        sheet->update->cut.settlesSites = true;
    }
    return RunUpTo(sheet, end, quotas, NULL);
}

bool kiriPipeline_Make(kiriSheetData* sheet, int32_t end)
{
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    return kiriPipeline_MakeSome(sheet, end, &unlimited) == KIRI_DONE;
}

void kiriPipeline_Start(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    u->start = (kiriUpdateStart){ u->stage, u->cut, u->spent };
    u->isBegun = false;
    if (u->stage == KIRI_NONE && sheet->queue.count > 0) {
        u->cut = (kiriCutWork){ sheet->queue.data[0].stamp, sheet->queue.count, 0, false, false };
        u->stage = KIRI_STAGE_CUT;
        u->step = 0;
        u->spent = 0;
    }
    sheet->seen.fades.jump = sheet->seen.fades.move = 0.0;
}

bool kiriPipeline_CanRun(const kiriSheetData* sheet, const kiriQuotas* quotas)
{
    int32_t stage = sheet->update->stage;
    KIRI_ASSERT(stage != KIRI_NONE);
    return stage == KIRI_READY || quotas->of[pipeline[stage].quota].left > 0;
}

kiriProgress kiriPipeline_Run(kiriSheetData* sheet, kiriQuotas* quotas, const kiriWatch* watch)
{
    KIRI_ASSERT(sheet->update->stage != KIRI_NONE && !sheet->update->isBegun);
    sheet->update->isBegun = true;
    return RunUpTo(sheet, KIRI_READY, quotas, watch);
}

void kiriPipeline_Finish(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    KIRI_ASSERT(u->stage == KIRI_READY && u->cut.taken == u->cut.count && u->cut.count <= sheet->queue.count);
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        if (i < u->cut.count) {
            sheet->queue.data[i].cut->waiting -= 1;
        } else {
            sheet->queue.data[i - u->cut.count] = sheet->queue.data[i];
        }
    }
    sheet->queue.count -= u->cut.count;
    u->isUnsettled = !u->cut.settlesSites && (u->isUnsettled || u->cut.meshChanged);
    u->stage = KIRI_NONE;
}

/* The mesh, and the blades in it, as the tick found them. */
static void RollBackMesh(kiriSheetData* sheet)
{
    kiriMesh_Rollback(&sheet->mesh);
    kiriMesh_Commit(&sheet->mesh); /* nothing: between two ticks the journal is closed */
    kiriSkin_Truncate(&sheet->vertexSkin, sheet->mesh.vertices.count);
    kiriView_Truncate(sheet);
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        sheet->cuts.data[i]->tip = sheet->cuts.data[i]->committed;
    }
}

void kiriPipeline_Abort(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    if (u->isBegun) {
        RollBackMesh(sheet);
        if (u->stage > KIRI_STAGE_CUT && u->cut.meshChanged) {
            kiriStage_Drop(sheet);
            u->needsRebuild = true;
        }
        u->step = 0;
        u->isBegun = false;
        u->spent = u->start.stage == KIRI_STAGE_CUT ? u->start.spent : 0;
        u->stage = u->start.stage > KIRI_STAGE_CUT ? KIRI_STAGE_GRID : u->start.stage;
    } else {
        u->stage = u->start.stage; /* it may have been started in this tick */
    }
    u->cut = u->start.cut;
}
