#include "kiri_shape_work.h"

#include <string.h>

/* ---- The weights of a cell --------------------------------------------------------------------------------------- */

/* Adds a share to the rigid sums of the frames that hold the cell rigidly. */
static void AddRigid(kiriShapeJob* job, int32_t cell, int64_t share)
{
    kiriSpan span = job->shape->spans.data[cell];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        const kiriCellWeight* weight = &job->shape->weights.data[k];
        if (weight->value > job->shape->rigidWeight) {
            job->shape->rigid.data[weight->frame] += share;
        }
    }
}

/* There is room for every cell. */
static void AddWeightChange(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(job->grid, cell));
    if ((job->work->marks.data[cell] & KIRI_MARK_CHANGED) == 0) {
        job->work->marks.data[cell] |= KIRI_MARK_CHANGED;
        job->shape->changes.data[job->shape->changes.count++] = cell;
    }
}

/* The cell's weights or its material are about to change: they leave the rigid sums until they are normalised again.
   There is room for every cell. */
static void MarkSumDirty(kiriShapeJob* job, int32_t cell)
{
    if ((job->work->marks.data[cell] & KIRI_MARK_DIRTY) == 0) {
        job->work->marks.data[cell] |= KIRI_MARK_DIRTY;
        job->work->dirty.data[job->work->dirty.count++] = cell;
        AddRigid(job, cell, -job->work->rigidShares.data[cell]);
    }
}

static void MarkWeightsDirty(kiriShapeJob* job, int32_t cell)
{
    MarkSumDirty(job, cell);
    AddWeightChange(job, cell);
    job->shape->recomputed += (job->work->marks.data[cell] & KIRI_MARK_RECOMPUTED) == 0;
    job->work->marks.data[cell] |= KIRI_MARK_RECOMPUTED;
}

static bool ResizeWeights(kiriShapeJob* job, int32_t cell, int32_t count)
{
    kiriShape* shape = job->shape;
    return kiriSpan_Resize(&shape->spans.data[cell], &shape->room, job->memory, &shape->weights,
                           sizeof(*shape->weights.data), count);
}

/* A cell without weights gets room for all at once. */
static bool MakeFirstRoom(kiriShapeJob* job, int32_t cell)
{
    MarkWeightsDirty(job, cell);
    return ResizeWeights(job, cell, job->work->awaited.data[cell]);
}

/* Puts, changes or takes away one weight among those that are there. */
static bool ReplaceWeight(kiriShapeJob* job, const kiriRawWeight* entry)
{
    KIRI_ASSERT(entry->frame >= 0 && entry->frame < job->siteCount && kiriGrid_IsCell(job->grid, entry->cell));
    kiriSpan* span = &job->shape->spans.data[entry->cell];
    kiriCellWeight* weights = job->shape->weights.data + span->first;
    int32_t k = 0;
    while (k < span->count && weights[k].frame < entry->frame) {
        ++k;
    }
    bool found = k < span->count && weights[k].frame == entry->frame, kept = entry->raw > 0.0;
    if (found ? weights[k].raw == entry->raw : !kept) {
        return true;
    }
    MarkWeightsDirty(job, entry->cell);
    if (found && !kept) {
        memmove(weights + k, weights + k + 1, (size_t)(span->count - k - 1) * sizeof(*weights));
        return ResizeWeights(job, entry->cell, span->count - 1);
    }
    if (!found) {
        if (!ResizeWeights(job, entry->cell, span->count + 1)) {
            return false;
        }
        weights = job->shape->weights.data + span->first;
        memmove(weights + k + 1, weights + k, (size_t)(span->count - k - 1) * sizeof(*weights));
    }
    weights[k] = (kiriCellWeight){ entry->frame, 0.0, entry->raw };
    return true;
}

static bool PlaceWeight(kiriShapeJob* job, const kiriRawWeight* entry)
{
    int32_t* awaited = &job->work->awaited.data[entry->cell];
    if (*awaited == 0) {
        return ReplaceWeight(job, entry);
    }
    if (job->shape->spans.data[entry->cell].count == 0 && !MakeFirstRoom(job, entry->cell)) {
        return false;
    }
    kiriSpan span = job->shape->spans.data[entry->cell];
    KIRI_ASSERT(*awaited > 0 && *awaited <= span.count && entry->raw > 0.0);
    job->shape->weights.data[span.first + span.count - (*awaited)--] =
        (kiriCellWeight){ entry->frame, 0.0, entry->raw };
    return true;
}

/* The share of a square that the cell covers, in units of 2^-40. */
static int64_t RigidShareOf(const kiriGrid* grid, int32_t cell)
{
    return (int64_t)(grid->cells.data[cell].material.area / (grid->side * grid->side) * 1099511627776.0 + 0.5);
}

static void NormalizeCell(kiriShapeJob* job, int32_t cell)
{
    kiriSpan span = job->shape->spans.data[cell];
    kiriCellWeight* weights = job->shape->weights.data + span.first;
    double sum = 0.0;
    for (int32_t k = 0; k < span.count; ++k) {
        sum += weights[k].raw;
    }
    KIRI_ASSERT(job->work->awaited.data[cell] == 0 && (span.count == 0 || sum > 0.0));
    for (int32_t k = 0; k < span.count; ++k) {
        weights[k].value = weights[k].raw / sum;
    }
    job->work->rigidShares.data[cell] = RigidShareOf(job->grid, cell);
    AddRigid(job, cell, job->work->rigidShares.data[cell]);
    job->work->marks.data[cell] &= (uint8_t)~KIRI_MARK_DIRTY;
}

/* ---- The update -------------------------------------------------------------------------------------------------- */

static bool MakeShapeRoom(kiriShapeJob* job)
{
    kiriShape* shape = job->shape;
    kiriShapeWork* work = job->work;
    int32_t cells = job->grid->cells.count, old = work->marks.count;
    bool ok =
        kiriField_Resize(&work->fromSite, job->memory, cells) &&
        kiriField_Resize(&work->fromBorder, job->memory, cells) &&
        kiriArray_Resize(job->memory, &shape->spans, cells) && kiriArray_Reserve(job->memory, &shape->changes, cells) &&
        kiriArray_Reserve(job->memory, &work->dirty, cells) && kiriArray_Resize(job->memory, &work->wasOwner, cells) &&
        kiriArray_Resize(job->memory, &work->awaited, cells) &&
        kiriArray_Resize(job->memory, &work->rigidShares, cells) &&
        kiriArray_Resize(job->memory, &work->marks, cells) &&
        kiriArray_Reserve(job->memory, &shape->reaches, job->siteCount) &&
        kiriArray_Reserve(job->memory, &shape->rigid, job->siteCount) &&
        kiriArray_Reserve(job->memory, &work->frames, job->siteCount);
    for (int32_t c = old; ok && c < cells; ++c) {
        shape->spans.data[c] = (kiriSpan){ 0, 0 };
        work->awaited.data[c] = 0;
        work->rigidShares.data[c] = 0;
        work->marks.data[c] = 0;
    }
    while (ok && shape->reaches.count < job->siteCount) {
        memset(&shape->reaches.data[shape->reaches.count++], 0, sizeof(*shape->reaches.data));
    }
    while (ok && shape->rigid.count < job->siteCount) {
        shape->rigid.data[shape->rigid.count++] = 0;
        memset(&work->frames.data[work->frames.count++], 0, sizeof(*work->frames.data));
    }
    return ok;
}

static void MarkChange(kiriShapeJob* job, int32_t cell, uint8_t mark)
{
    kiriShapeWork* work = job->work;
    int32_t square = job->grid->cells.data[cell].square, columns = job->mesh->squares.columns;
    const int32_t at[2] = { square % columns, square / columns };
    KIRI_ASSERT(kiriGrid_IsCell(job->grid, cell));
    work->marks.data[cell] |= mark;
    for (int i = 0; i < 2; ++i) {
        work->low[i] = at[i] < work->low[i] ? at[i] : work->low[i];
        work->high[i] = at[i] > work->high[i] ? at[i] : work->high[i];
    }
}

/* Cells whose owner or distance changed. */
static void MarkRegionChanges(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    const kiriField* field = &job->regions->field;
    for (int32_t k = 0; k < job->regions->changes.count; ++k) {
        kiriSeed was = job->regions->changes.data[k];
        int32_t owner = field->owner.data[was.cell];
        MarkChange(job, was.cell, KIRI_MARK_REGION);
        work->wasOwner.data[was.cell] = was.owner;
        KIRI_ASSERT(was.owner < job->siteCount && owner < job->siteCount);
        if (was.owner != KIRI_NONE) {
            work->frames.data[was.owner].dirty = true;
        }
        if (owner != KIRI_NONE) {
            kiriShapeFrame* frame = &work->frames.data[owner];
            int32_t reach = kiriShapeJob_ReachAt(job, was.cell);
            frame->dirty = true;
            frame->reach = reach > frame->reach ? reach : frame->reach;
        }
    }
}

/* Cells that are gone have made others in their squares, so the box holds them too. */
static void MarkAllChanges(kiriShapeJob* job)
{
    const kiriGridChanges* changes = &job->grid->changes;
    for (int32_t k = 0; k < changes->gone.count; ++k) {
        int32_t cell = changes->gone.data[k];
        AddRigid(job, cell, -job->work->rigidShares.data[cell]);
        ResizeWeights(job, cell, 0);
        job->work->marks.data[cell] |= KIRI_MARK_GONE;
    }
    for (int32_t k = 0; k < changes->steps.count; ++k) {
        MarkChange(job, changes->steps.data[k], KIRI_MARK_STEPS);
        AddWeightChange(job, changes->steps.data[k]);
    }
    for (int32_t k = 0; k < changes->material.count; ++k) {
        MarkSumDirty(job, changes->material.data[k].cell);
    }
    MarkRegionChanges(job);
}

static void StartStage(kiriShapeWork* work, kiriShapeStage stage)
{
    work->stage = stage;
    work->next = 0;
}

static bool BeginWeights(kiriShapeJob* job, const kiriSiteMove* moves, int32_t moveCount)
{
    kiriShapeWork* work = job->work;
    if (!MakeShapeRoom(job)) {
        return false;
    }
    for (int32_t f = 0; f < job->siteCount; ++f) {
        kiriShapeFrame* frame = &work->frames.data[f];
        frame->reach = 0;
        frame->moved = frame->dirty = false;
    }
    for (int32_t k = 0; k < moveCount; ++k) {
        KIRI_ASSERT(moves[k].frame >= 0 && moves[k].frame < job->siteCount);
        work->frames.data[moves[k].frame].moved = true;
    }
    work->low[0] = work->low[1] = INT32_MAX;
    work->high[0] = work->high[1] = INT32_MIN;
    work->rawWeights.count = work->dirty.count = 0;
    MarkAllChanges(job);
    StartStage(work, KIRI_SHAPE_MEASURE);
    return true;
}

static kiriProgress MeasureAllFrames(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < job->siteCount; ++work->next) {
        job->frame = work->next;
        if (work->frameStage != KIRI_FRAME_REST || kiriShapeJob_IsFrameDirty(job)) {
            kiriProgress progress = kiriShapeJob_MeasureFrame(job, quota);
            if (progress != KIRI_DONE) {
                return progress;
            }
        }
    }
    StartStage(work, job->shape->weights.count == 0 ? KIRI_SHAPE_MAKE_ROOM : KIRI_SHAPE_PLACE);
    return KIRI_DONE;
}

/* Where no cell has weights yet, they get room in the order of cells: so weights of neighbours lie close together. */
static kiriProgress MakeFirstRooms(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < job->grid->cells.count; ++work->next) {
        if (work->awaited.data[work->next] > 0) {
            if (!kiriQuota_Take(quota, 1)) {
                return KIRI_MORE;
            }
            if (!MakeFirstRoom(job, work->next)) {
                return KIRI_FAILED;
            }
        }
    }
    StartStage(work, KIRI_SHAPE_PLACE);
    return KIRI_DONE;
}

static kiriProgress PlaceWeights(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < work->rawWeights.count; ++work->next) {
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        if (!PlaceWeight(job, &work->rawWeights.data[work->next])) {
            return KIRI_FAILED;
        }
    }
    StartStage(work, KIRI_SHAPE_NORMALIZE);
    return KIRI_DONE;
}

/* Clears the marks of this update, and takes cells that are gone out of the list of changes. */
static void EndWeights(kiriShapeJob* job)
{
    kiriShape* shape = job->shape;
    const kiriGridChanges* changes = &job->grid->changes;
    uint8_t* marks = job->work->marks.data;
    const uint8_t kept = (uint8_t) ~(KIRI_MARK_STEPS | KIRI_MARK_GONE | KIRI_MARK_REGION);
    int32_t count = 0;
    for (int32_t k = 0; k < changes->steps.count; ++k) {
        marks[changes->steps.data[k]] &= kept;
    }
    for (int32_t k = 0; k < job->regions->changes.count; ++k) {
        marks[job->regions->changes.data[k].cell] &= kept;
    }
    for (int32_t k = 0; k < shape->changes.count; ++k) {
        int32_t cell = shape->changes.data[k];
        if ((marks[cell] & KIRI_MARK_GONE) == 0) {
            shape->changes.data[count++] = cell;
        }
    }
    shape->changes.count = count;
    for (int32_t k = 0; k < changes->gone.count; ++k) {
        marks[changes->gone.data[k]] = 0;
    }
    job->work->stage = KIRI_SHAPE_REST;
}

static kiriProgress NormalizeCells(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < work->dirty.count; ++work->next) {
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        NormalizeCell(job, work->dirty.data[work->next]);
    }
    EndWeights(job);
    return KIRI_DONE;
}

/* Algorithm 2, each stage over its items. */
static kiriProgress (*const shapeStages[])(kiriShapeJob* job, kiriQuota* quota) = {
    NULL,
    MeasureAllFrames, /* distances to the site and to the border, and the raw weights that follow from them */
    MakeFirstRooms,   /* only where no cell has weights yet */
    PlaceWeights,     /* the raw weights, in the spans of their cells */
    NormalizeCells,   /* to sum 1 */
};

kiriProgress kiriShape_Update(kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                              const kiriRegions* regions, const kiriSite* sites, int32_t siteCount,
                              const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota)
{
    if (shape->work == NULL) {
        shape->work = kiriMemory_AllocZeroed(memory, sizeof(*shape->work));
    }
    if (shape->work == NULL) {
        return KIRI_FAILED;
    }
    KIRI_ASSERT(!regions->running && regions->material.count == siteCount);
    kiriShapeJob job = { shape, shape->work, memory, grid, mesh, regions, sites, siteCount, 0 };
    if (shape->work->stage == KIRI_SHAPE_REST && !BeginWeights(&job, moves, moveCount)) {
        return KIRI_FAILED;
    }
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && shape->work->stage != KIRI_SHAPE_REST) {
        progress = shapeStages[shape->work->stage](&job, quota);
    }
    return progress;
}

static void RenumberWeights(kiriShape* shape, const kiriKeep* frames)
{
    for (int32_t c = 0; c < shape->spans.count; ++c) {
        kiriSpan span = shape->spans.data[c];
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            shape->weights.data[k].frame = kiriKeep_To(frames, shape->weights.data[k].frame);
        }
    }
}

void kiriShape_Keep(kiriShape* shape, kiriMemory* memory, const kiriKeep* frames, const int32_t* gone,
                    int32_t goneCount)
{
    KIRI_ASSERT(shape->work->stage == KIRI_SHAPE_REST && shape->changes.count == 0);
    for (int32_t k = 0; k < goneCount; ++k) {
        kiriSpan_Resize(&shape->spans.data[gone[k]], &shape->room, memory, &shape->weights,
                        sizeof(*shape->weights.data), 0);
        shape->work->rigidShares.data[gone[k]] = 0;
    }
    if (kiriKeep_Moves(frames)) {
        RenumberWeights(shape, frames);
    }
    for (int32_t f = frames->first; f < frames->to.count; ++f) {
        if (!kiriKeep_Has(frames, f)) {
            kiriArray_Release(memory, &shape->reaches.data[f]);
        }
    }
    kiriKeep_Compact(frames, &shape->reaches, 1, sizeof(kiriReaches));
    kiriKeep_Compact(frames, &shape->rigid, 1, sizeof(int64_t));
    kiriKeep_Compact(frames, &shape->work->frames, 1, sizeof(kiriShapeFrame));
}

void kiriShape_ClearChanges(kiriShape* shape)
{
    KIRI_ASSERT(shape->work == NULL || shape->work->stage == KIRI_SHAPE_REST);
    for (int32_t k = 0; k < shape->changes.count; ++k) {
        shape->work->marks.data[shape->changes.data[k]] &= (uint8_t) ~(KIRI_MARK_CHANGED | KIRI_MARK_RECOMPUTED);
    }
    shape->changes.count = 0;
    shape->recomputed = 0;
}

void kiriShape_Reset(kiriShape* shape)
{
    for (int32_t f = 0; f < shape->reaches.count; ++f) {
        shape->reaches.data[f].count = 0;
    }
    shape->spans.count = shape->weights.count = shape->rigid.count = shape->changes.count = 0;
    memset(&shape->room, 0, sizeof(shape->room));
    shape->recomputed = 0;
    if (shape->work != NULL) {
        kiriField_Clear(&shape->work->fromSite);
        kiriField_Clear(&shape->work->fromBorder);
        shape->work->marks.count = shape->work->frames.count = 0;
        shape->work->stage = KIRI_SHAPE_REST;
        shape->work->frameStage = KIRI_FRAME_REST;
    }
}
