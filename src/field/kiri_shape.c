#include "kiri_shape_work.h"

#include "../core/kiri_hash.h"
#include "../core/kiri_sort.h"

#include <string.h>

/* ---- The weights of a cell --------------------------------------------------------------------------------------- */

/* Adds a share to the rigid sums of the frames that hold the cell rigidly. */
static void AddRigid(kiriShapeJob* job, int32_t cell, int64_t share)
{
    kiriSpan span = job->shape->spans.data[cell];
    double sum = kiriShape_Sum(job->shape, span);
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        const kiriCellWeight* weight = &job->shape->weights.data[k];
        if (kiriCellWeight_Raw(weight) / sum > job->shape->rigidWeight) {
            job->shape->rigid.data[kiriLabels_Item(&job->shape->labels, weight->label)] += share;
        }
    }
}

static bool AddWeightChange(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(job->grid, cell));
    if ((job->work->marks.data[cell] & KIRI_MARK_CHANGED) != 0) {
        return true;
    }
    job->work->marks.data[cell] |= KIRI_MARK_CHANGED;
    return kiriArray_Push(job->memory, &job->shape->changes, cell);
}

/* The cell's weights or its material are about to change: they leave the rigid sums until it is finished. */
static bool MarkSumDirty(kiriShapeJob* job, int32_t cell)
{
    if ((job->work->marks.data[cell] & KIRI_MARK_DIRTY) != 0) {
        return true;
    }
    job->work->marks.data[cell] |= KIRI_MARK_DIRTY;
    AddRigid(job, cell, -job->work->rigidShares.data[cell]);
    return kiriArray_Push(job->memory, &job->work->dirty, cell);
}

static bool MarkWeightsDirty(kiriShapeJob* job, int32_t cell)
{
    uint8_t* mark = &job->work->marks.data[cell];
    job->shape->recomputed += (*mark & KIRI_MARK_RECOMPUTED) == 0;
    *mark |= KIRI_MARK_RECOMPUTED;
    return MarkSumDirty(job, cell) && AddWeightChange(job, cell);
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
    return MarkWeightsDirty(job, cell) && ResizeWeights(job, cell, job->work->awaited.data[cell]);
}

/* Puts, changes or takes away one weight among those that are there. */
static bool ReplaceWeight(kiriShapeJob* job, const kiriRawWeight* entry)
{
    KIRI_ASSERT(entry->frame >= 0 && entry->frame < job->siteCount && kiriGrid_IsCell(job->grid, entry->cell));
    kiriSpan* span = &job->shape->spans.data[entry->cell];
    kiriCellWeight* weights = job->shape->weights.data + span->first;
    int32_t k = 0, label = kiriLabels_Of(&job->shape->labels, entry->frame);
    while (k < span->count && weights[k].label < label) {
        ++k;
    }
    bool found = k < span->count && weights[k].label == label, kept = entry->raw > 0.0;
    if (found ? kiriCellWeight_Raw(&weights[k]) == entry->raw : !kept) {
        return true;
    }
    if (!MarkWeightsDirty(job, entry->cell)) {
        return false;
    }
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
    weights[k] = kiriCellWeight_Make(label, entry->raw);
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
        kiriCellWeight_Make(kiriLabels_Of(&job->shape->labels, entry->frame), entry->raw);
    return true;
}

/* The share of a square that the cell covers, in units of 2^-40. */
static int64_t RigidShareOf(const kiriGrid* grid, int32_t cell)
{
    return (int64_t)(kiriGrid_Area(grid, cell) / (grid->side * grid->side) * 1099511627776.0 + 0.5);
}

/* Its weights and its material are what they shall be. */
static void FinishCell(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(job->work->awaited.data[cell] == 0);
    job->work->rigidShares.data[cell] = RigidShareOf(job->grid, cell);
    AddRigid(job, cell, job->work->rigidShares.data[cell]);
    job->work->marks.data[cell] &= (uint8_t)~KIRI_MARK_DIRTY;
}

/* ---- The update -------------------------------------------------------------------------------------------------- */

/* Arrays that are read by whole blocks of cells. */
static bool MakeBlocksRoom(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    int32_t old = work->marks.count, was = work->isLoaded.count;
    int32_t blocks = kiriReach_BlockOf(job->grid->cells.count + KIRI_BLOCK_CELLS - 1);
    int32_t cells = blocks * KIRI_BLOCK_CELLS;
    if (!kiriReaches_Resize(&job->shape->reaches, job->memory, cells,
                            kiriLabels_Count(&job->shape->labels, job->siteCount)) ||
        !kiriField_Resize(&work->fromSite, job->memory, cells) ||
        !kiriField_Resize(&work->fromBorder, job->memory, cells) ||
        !kiriArray_Resize(job->memory, &work->marks, cells) || !kiriArray_Reserve(job->memory, &work->loaded, blocks) ||
        !kiriArray_Resize(job->memory, &work->isLoaded, blocks)) {
        return false;
    }
    memset(work->marks.data + old, 0, (size_t)(cells - old));
    memset(work->isLoaded.data + was, 0, (size_t)(blocks - was));
    return true;
}

static bool MakeCellsRoom(kiriShapeJob* job)
{
    kiriShape* shape = job->shape;
    kiriShapeWork* work = job->work;
    int32_t cells = job->grid->cells.count, c = shape->spans.count;
    if (!kiriArray_Resize(job->memory, &shape->spans, cells) ||
        !kiriArray_Resize(job->memory, &work->wasOwner, cells) ||
        !kiriArray_Resize(job->memory, &work->awaited, cells) ||
        !kiriArray_Resize(job->memory, &work->counted, cells) ||
        !kiriArray_Resize(job->memory, &work->rigidShares, cells)) {
        return false;
    }
    for (; c < cells; ++c) {
        shape->spans.data[c] = (kiriSpan){ 0, 0 };
        work->awaited.data[c] = 0;
        work->counted.data[c] = (kiriCountedCell){ KIRI_NONE, 0 };
        work->rigidShares.data[c] = 0;
    }
    return true;
}

static bool MakeFramesRoom(kiriShapeJob* job)
{
    kiriShape* shape = job->shape;
    kiriShapeWork* work = job->work;
    if (!kiriArray_Reserve(job->memory, &shape->rigid, job->siteCount) ||
        !kiriArray_Reserve(job->memory, &work->dirtyFrames, job->siteCount) ||
        !kiriArray_Reserve(job->memory, &work->frames, job->siteCount)) {
        return false;
    }
    while (shape->rigid.count < job->siteCount) {
        shape->rigid.data[shape->rigid.count++] = 0;
        work->frames.data[work->frames.count++] = (kiriShapeFrame){ 0, { 0, 0 }, 0, KIRI_NONE, false, false };
    }
    return true;
}

static void MarkFrameDirty(kiriShapeJob* job, int32_t frame)
{
    kiriShapeWork* work = job->work;
    KIRI_ASSERT(frame >= KIRI_NONE && frame < job->siteCount);
    if (frame != KIRI_NONE && !work->frames.data[frame].dirty) {
        work->frames.data[frame].dirty = true;
        work->dirtyFrames.data[work->dirtyFrames.count++] = frame;
    }
}

static void StartStage(kiriShapeWork* work, kiriShapeStage stage)
{
    work->stage = stage;
    work->next = 0;
}

static bool BeginWeights(kiriShapeJob* job, const kiriSiteMove* moves, int32_t moveCount)
{
    kiriShapeWork* work = job->work;
    if (!MakeBlocksRoom(job) || !MakeCellsRoom(job) || !MakeFramesRoom(job)) {
        return false;
    }
    for (int32_t k = 0; k < moveCount; ++k) {
        MarkFrameDirty(job, moves[k].frame);
        work->frames.data[moves[k].frame].moved = true;
    }
    work->rawWeights.count = work->dirty.count = work->touches.count = 0;
    StartStage(work, KIRI_SHAPE_MARK);
    return true;
}

/* ---- What has changed -------------------------------------------------------------------------------------------- */

/* All frames that reach the cell have to look at it. */
static bool TouchCell(kiriShapeJob* job, int32_t cell)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* reaches = &job->shape->reaches;
    kiriReachHead head;
    for (int32_t b = reaches->ofCells.data[kiriReach_BlockOf(cell)]; b != KIRI_NONE; b = head.nextOfCells) {
        head = reaches->heads.data[b];
        if (reaches->blocks.data[b].fromSite[cell % KIRI_BLOCK_CELLS] != KIRI_FAR) {
            int32_t f = kiriLabels_Item(&job->shape->labels, head.label);
            kiriShapeFrame* frame = &work->frames.data[f];
            kiriTouchedCell touched = { cell, frame->firstTouch };
            MarkFrameDirty(job, f);
            frame->firstTouch = work->touches.count;
            frame->touches += 1;
            if (!kiriArray_Push(job->memory, &work->touches, touched)) {
                return false;
            }
        }
    }
    return true;
}

static bool MarkGone(kiriShapeJob* job, int32_t cell)
{
    AddRigid(job, cell, -job->work->rigidShares.data[cell]);
    ResizeWeights(job, cell, 0);
    kiriShapeJob_UncountCell(job, cell);
    job->work->marks.data[cell] |= KIRI_MARK_GONE;
    return TouchCell(job, cell);
}

static bool MarkSteps(kiriShapeJob* job, int32_t cell)
{
    job->work->marks.data[cell] |= KIRI_MARK_STEPS;
    return AddWeightChange(job, cell) && TouchCell(job, cell);
}

/* Another owner or distance. */
static bool MarkRegion(kiriShapeJob* job, kiriSeed was)
{
    uint8_t* mark = &job->work->marks.data[was.cell];
    bool isTouched = (*mark & KIRI_MARK_STEPS) != 0;
    *mark |= KIRI_MARK_REGION;
    job->work->wasOwner.data[was.cell] = was.owner;
    MarkFrameDirty(job, was.owner);
    MarkFrameDirty(job, job->regions->field.owner.data[was.cell]);
    return isTouched || TouchCell(job, was.cell);
}

/* Counts how far distances have to go for the sake of a cell that has changed, and of those beside it. */
static bool CountAround(kiriShapeJob* job, int32_t cell)
{
    kiriSteps steps;
    kiriGrid_GetSteps(job->grid, cell, &steps);
    const uint8_t* marks = job->work->marks.data;
    bool ok = kiriShapeJob_CountCell(job, cell);
    for (int32_t s = 0; ok && s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t beside = steps.data[s].cell;
        ok = (marks[beside] & (KIRI_MARK_STEPS | KIRI_MARK_REGION)) != 0 || kiriShapeJob_CountCell(job, beside);
    }
    return ok;
}

/* What the grid and the regions have changed; and once more, when all is marked. */
typedef enum ChangeList {
    LIST_GONE,
    LIST_STEPS,
    LIST_MATERIAL,
    LIST_REGION,
    LIST_COUNT_STEPS,
    LIST_COUNT_REGION
} ChangeList;

static bool MarkChange(kiriShapeJob* job, ChangeList list, int32_t k)
{
    const kiriGridChanges* changes = &job->grid->changes;
    switch (list) {
    case LIST_GONE:
        return MarkGone(job, changes->gone.data[k]);
    case LIST_STEPS:
        return MarkSteps(job, changes->steps.data[k]);
    case LIST_MATERIAL:
        return MarkSumDirty(job, changes->material.data[k].cell);
    case LIST_REGION:
        return MarkRegion(job, job->regions->changes.data[k]);
    case LIST_COUNT_STEPS:
        return CountAround(job, changes->steps.data[k]);
    default: {
        int32_t cell = job->regions->changes.data[k].cell;
        return (job->work->marks.data[cell] & KIRI_MARK_STEPS) != 0 || CountAround(job, cell);
    }
    }
}

enum { PLACED_AN_ITEM = 3 };

/* Goes on at work->next, which counts through all lists. An item is a cell that is marked, or counted with those beside
   it. */
static kiriProgress MarkChanges(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    const kiriGridChanges* changes = &job->grid->changes;
    const int32_t counts[] = { changes->gone.count,         changes->steps.count, changes->material.count,
                               job->regions->changes.count, changes->steps.count, job->regions->changes.count };
    int32_t first = 0;
    for (ChangeList list = LIST_GONE; list <= LIST_COUNT_REGION; ++list) {
        for (; work->next < first + counts[list]; ++work->next) {
            if (!kiriQuota_Take(quota, 1)) {
                return KIRI_MORE;
            }
            if (!MarkChange(job, list, work->next - first)) {
                return KIRI_FAILED;
            }
        }
        first += counts[list];
    }
    kiriSort(work->dirtyFrames.data, work->dirtyFrames.count, NULL, NULL);
    StartStage(work, KIRI_SHAPE_MEASURE);
    return KIRI_DONE;
}

/* ---- The stages -------------------------------------------------------------------------------------------------- */

static kiriProgress MeasureDirtyFrames(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < work->dirtyFrames.count; ++work->next) {
        job->frame = work->dirtyFrames.data[work->next];
        job->label = kiriLabels_Of(&job->shape->labels, job->frame);
        kiriProgress progress = kiriShapeJob_MeasureFrame(job, quota);
        if (progress != KIRI_DONE) {
            return progress;
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
        if (!kiriQuota_Take(quota, work->next % PLACED_AN_ITEM == 0)) {
            return KIRI_MORE;
        }
        if (!PlaceWeight(job, &work->rawWeights.data[work->next])) {
            return KIRI_FAILED;
        }
    }
    StartStage(work, KIRI_SHAPE_FINISH);
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
    for (int32_t k = 0; k < job->work->dirtyFrames.count; ++k) {
        kiriShapeFrame* frame = &job->work->frames.data[job->work->dirtyFrames.data[k]];
        frame->touches = 0;
        frame->firstTouch = KIRI_NONE;
        frame->moved = frame->dirty = false;
    }
    job->work->dirtyFrames.count = 0;
    job->work->stage = KIRI_SHAPE_REST;
}

static kiriProgress FinishCells(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < work->dirty.count; ++work->next) {
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        FinishCell(job, work->dirty.data[work->next]);
    }
    EndWeights(job);
    return KIRI_DONE;
}

/* Algorithm 2, each stage over its items. */
static kiriProgress (*const shapeStages[])(kiriShapeJob* job, kiriQuota* quota) = {
    NULL,
    MarkChanges,        /* cells, and the frames that reach them */
    MeasureDirtyFrames, /* distances to the site and to the border, and the raw weights that follow from them */
    MakeFirstRooms,     /* only where no cell has weights yet */
    PlaceWeights,       /* the raw weights, in the spans of their cells */
    FinishCells,        /* their rigid sums */
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
    kiriShapeJob job = { shape, shape->work, memory, grid, mesh, regions, sites, siteCount, 0, 0 };
    if (shape->work->stage == KIRI_SHAPE_REST && !BeginWeights(&job, moves, moveCount)) {
        return KIRI_FAILED;
    }
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && shape->work->stage != KIRI_SHAPE_REST) {
        progress = shapeStages[shape->work->stage](&job, quota);
    }
    return progress;
}

void kiriShape_HashProgress(const kiriShape* shape, uint64_t* hash)
{
    if (shape->work != NULL && shape->work->stage != KIRI_SHAPE_REST) {
        kiriHash_Int64(hash, shape->work->due);
    }
}

static void RelabelWeights(kiriShape* shape, const kiriKeep* labels)
{
    const int32_t* to = labels->to.data;
    for (int32_t c = 0; c < shape->spans.count; ++c) {
        kiriCellWeight* weight = shape->weights.data + shape->spans.data[c].first;
        for (const kiriCellWeight* end = weight + shape->spans.data[c].count; weight < end; ++weight) {
            int32_t now = to[weight->label];
            weight->label = now != KIRI_NONE ? now : 0; /* never gone, but for bytes that were made up */
        }
        kiriCountedCell* counted = &shape->work->counted.data[c];
        counted->label = counted->label != KIRI_NONE ? to[counted->label] : KIRI_NONE;
    }
}

static void ForgetCells(kiriShape* shape, kiriMemory* memory, const int32_t* gone, int32_t goneCount)
{
    for (int32_t k = 0; k < goneCount; ++k) {
        kiriSpan_Resize(&shape->spans.data[gone[k]], &shape->room, memory, &shape->weights,
                        sizeof(*shape->weights.data), 0);
        shape->work->rigidShares.data[gone[k]] = 0;
        shape->work->counted.data[gone[k]] = (kiriCountedCell){ KIRI_NONE, 0 };
    }
}

static void ForgetFrame(kiriShape* shape, kiriMemory* memory, int32_t frame)
{
    kiriReaches_Forget(&shape->reaches, kiriLabels_Of(&shape->labels, frame));
    kiriSpan_Resize(&shape->work->frames.data[frame].sides, &shape->work->sideRoom, memory, &shape->work->sideCounts,
                    sizeof(*shape->work->sideCounts.data), 0);
}

/* Frames are those that are left. */
static void KeepLabels(kiriShape* shape, const kiriKeep* frames, const kiriKeep* labels)
{
    if (labels == NULL) {
        kiriLabels_Keep(&shape->labels, frames);
        shape->reaches.ofLabel.count = kiriLabels_Count(&shape->labels, frames->count);
        return;
    }
    kiriReaches_Relabel(&shape->reaches, labels);
    if (kiriKeep_Moves(labels)) {
        RelabelWeights(shape, labels);
    }
    kiriLabels_Forget(&shape->labels);
}

void kiriShape_Keep(kiriShape* shape, kiriMemory* memory, const kiriKeep* frames, const kiriKeep* labels,
                    const int32_t* gone, int32_t goneCount)
{
    KIRI_ASSERT(shape->work->stage == KIRI_SHAPE_REST && shape->changes.count == 0);
    ForgetCells(shape, memory, gone, goneCount);
    for (int32_t f = frames->first; f < frames->to.count; ++f) {
        if (!kiriKeep_Has(frames, f)) {
            ForgetFrame(shape, memory, f);
        }
    }
    KeepLabels(shape, frames, labels);
    kiriKeep_Compact(frames, &shape->rigid, 1, sizeof(int64_t));
    kiriKeep_Compact(frames, &shape->work->frames, 1, sizeof(kiriShapeFrame));
}

void kiriShape_DropScratch(kiriShape* shape, kiriMemory* memory)
{
    KIRI_ASSERT(shape->work->stage == KIRI_SHAPE_REST && shape->changes.count == 0);
    shape->work->dirty.count = 0;
    kiriArray_Release(memory, &shape->changes);
    kiriArray_Release(memory, &shape->work->dirty);
    kiriArray_Release(memory, &shape->work->rawWeights);
    kiriArray_Release(memory, &shape->work->touches);
    kiriArray_Shorten(memory, &shape->weights, sizeof(*shape->weights.data));
    kiriArray_Shorten(memory, &shape->reaches.blocks, sizeof(*shape->reaches.blocks.data));
    kiriArray_Shorten(memory, &shape->reaches.heads, sizeof(*shape->reaches.heads.data));
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
    kiriShapeWork* work = shape->work;
    kiriReaches_Clear(&shape->reaches);
    shape->spans.count = shape->weights.count = shape->rigid.count = shape->changes.count = 0;
    memset(&shape->room, 0, sizeof(shape->room));
    shape->recomputed = 0;
    if (work != NULL) {
        kiriField_Clear(&work->fromSite);
        kiriField_Clear(&work->fromBorder);
        work->marks.count = work->isLoaded.count = work->loaded.count = 0;
        work->frames.count = work->dirtyFrames.count = work->sideCounts.count = 0;
        memset(&work->sideRoom, 0, sizeof(work->sideRoom));
        work->stage = KIRI_SHAPE_REST;
        work->frameStage = KIRI_FRAME_REST;
        work->due = 0;
        kiriGrowing_Drop(&work->growing);
        work->growing.owed = 0;
    }
}
