#include "kiri_field_check.h"
#include "kiri_shape_work.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------ */

static const kiriMust IsShapeCell[] = { KIRI_INDEX(KIRI_OF_CELLS, kiriSpan, first, first) };
static const kiriMust IsRegion[] = { KIRI_INDEX(KIRI_OF_REGIONS, kiriSpan, first, first) };

static const kiriMust ShapeFrameMust[] = {
    KIRI_WITHIN(0, KIRI_FAR, kiriShapeFrame, limit, limit),
    KIRI_WITHIN(0, INT32_MAX, kiriShapeFrame, touches, touches),
};

static const kiriMust RawWeightMust[] = {
    KIRI_INDEX(KIRI_OF_CELLS, kiriRawWeight, cell, cell),
    KIRI_INDEX(KIRI_OF_REGIONS, kiriRawWeight, frame, frame),
    KIRI_REALS(kiriRawWeight, raw, raw),
};

static const kiriMust TouchedMust[] = {
    KIRI_INDEX(KIRI_OF_CELLS, kiriTouchedCell, cell, cell),
};

static const kiriMust ShapeWorkMust[] = {
    KIRI_WITHIN(KIRI_FRAME_REST, KIRI_FRAME_SEEDS, kiriShapeWork, frameStage, frameStage),
    KIRI_ITEMS_MUST(kiriShapeWork, frames, ShapeFrameMust),
    KIRI_LENGTH(KIRI_OF_REGIONS, kiriShapeWork, frames),
    KIRI_ITEMS_MUST(kiriShapeWork, dirtyFrames, IsRegion),
    KIRI_WITHIN(KIRI_SHAPE_REST, KIRI_SHAPE_FINISH, kiriShapeWork, stage, stage),
    KIRI_WITHIN(0, INT32_MAX, kiriShapeWork, next, next),
    KIRI_COUNTS(kiriShapeWork, due, due),
};

/* While an update is at hand: what rests has whatever the last one left there. */
static const kiriMust RunningShapeMust[] = {
    KIRI_ITEMS_MUST(kiriShapeWork, touches, TouchedMust),
    KIRI_ITEMS_MUST(kiriShapeWork, rawWeights, RawWeightMust),
    KIRI_ITEMS_MUST(kiriShapeWork, dirty, IsShapeCell),
};

static const kiriMust ShapeMust[] = {
    KIRI_REALS(kiriShape, rigidWeight, rigidWeight),
    KIRI_ITEMS_MUST(kiriShape, changes, IsShapeCell),
    KIRI_COUNTS(kiriShape, recomputed, recomputed),
    KIRI_OWNED_MUST(kiriShape, work, ShapeWorkMust),
};

/* Of weights that are awaited nothing is there yet. */
static bool AreWeightsOf(kiriCheck* check, const kiriShape* shape, int32_t cell)
{
    kiriSpan span = shape->spans.data[cell];
    int32_t awaited = shape->work->awaited.data[cell];
    int32_t there = span.count > 0 ? span.count - awaited : 0;
    bool areFine = awaited >= 0 && awaited <= (span.count > 0 ? span.count : check->count[KIRI_OF_REGIONS]);
    for (int32_t k = 0; areFine && k < there; ++k) {
        const kiriCellWeight* weight = &shape->weights.data[span.first + k];
        double raw = kiriCellWeight_Raw(weight);
        areFine = kiriLabels_Has(&shape->labels, weight->label, shape->rigid.count) && raw > 0.0 && raw <= 1.0;
    }
    return kiriCheck_That(check, areFine);
}

static bool AreWeights(kiriCheck* check, const kiriShape* shape)
{
    kiriRooms rooms;
    bool areFine = kiriCheck_StartRooms(check, &rooms, &shape->weights, sizeof(kiriCellWeight), &shape->room);
    for (int32_t c = 0; areFine && c < shape->spans.count; ++c) {
        areFine = kiriCheck_Span(check, &rooms, shape->spans.data[c]) && AreWeightsOf(check, shape, c);
    }
    kiriMemory_Free(&check->memory, areFine ? rooms.taken : NULL);
    return areFine;
}

/* From 0 to the farthest; or there is none. */
static bool IsDistanceOrFar(int32_t distance)
{
    return ((uint32_t)distance <= KIRI_FARTHEST) | (distance == KIRI_FAR);
}

/* Cells beyond those of the grid are far. */
static bool AreDistances(const kiriReachBlock* block, int64_t cells)
{
    int64_t there = cells - (int64_t)block->cells * KIRI_BLOCK_CELLS;
    bool areFine = true;
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
        areFine &= IsDistanceOrFar(block->fromSite[k]);
        areFine &= IsDistanceOrFar(block->fromBorder[k]);
    }
    for (int32_t k = there > 0 ? (int32_t)there : 0; there < KIRI_BLOCK_CELLS && k < KIRI_BLOCK_CELLS; ++k) {
        areFine &= block->fromSite[k] == KIRI_FAR && block->fromBorder[k] == KIRI_FAR;
    }
    return areFine;
}

/* Each block in the list of its cells is in one list alone. */
static bool AreBlocksOfCells(const kiriReaches* reaches, kiriChains* ofCells)
{
    const kiriReachHead* heads = reaches->heads.data;
    for (int32_t c = 0; c < reaches->ofCells.count; ++c) {
        for (int32_t b = reaches->ofCells.data[c]; b != KIRI_NONE; b = heads[b].nextOfCells) {
            if (!kiriChains_Take(ofCells, b) || reaches->blocks.data[b].cells != c || heads[b].label == KIRI_NONE) {
                return false;
            }
        }
    }
    return true;
}

static bool AreBlocksOfLabel(const kiriReaches* reaches, kiriChains* ofLabel, int32_t label)
{
    const kiriReachBlock* blocks = reaches->blocks.data;
    int32_t before = KIRI_NONE;
    for (int32_t b = reaches->ofLabel.data[label]; b != KIRI_NONE; b = blocks[b].nextOfFrame) {
        if (!kiriChains_Take(ofLabel, b) || reaches->heads.data[b].label != label ||
            blocks[b].previousOfFrame != before) {
            return false;
        }
        before = b;
    }
    return true;
}

static bool AreBlocksOfLabels(const kiriShape* shape, kiriChains* ofLabel)
{
    const kiriReaches* reaches = &shape->reaches;
    bool areFine = true;
    for (int32_t label = 0; areFine && label < reaches->ofLabel.count; ++label) {
        areFine =
            reaches->ofLabel.data[label] == KIRI_NONE ||
            (kiriLabels_Has(&shape->labels, label, shape->rigid.count) && AreBlocksOfLabel(reaches, ofLabel, label));
    }
    return areFine;
}

static bool AreBlocksFree(const kiriReaches* reaches, kiriChains* ofLabel)
{
    int32_t block = reaches->freeBlock;
    bool areFine = reaches->freeBlocks >= 0;
    for (int32_t k = 0; areFine && k < reaches->freeBlocks; ++k) {
        areFine = kiriChains_Take(ofLabel, block) && reaches->heads.data[block].label == KIRI_NONE;
        block = areFine ? reaches->blocks.data[block].nextOfFrame : KIRI_NONE;
    }
    return areFine;
}

static bool AreBlocksListed(const kiriShape* shape, kiriChains* ofCells, kiriChains* ofLabel, int64_t cells)
{
    const kiriReaches* reaches = &shape->reaches;
    bool areFine = true;
    for (int32_t b = 0; areFine && b < reaches->blocks.count; ++b) {
        areFine = reaches->heads.data[b].label == KIRI_NONE || AreDistances(&reaches->blocks.data[b], cells);
    }
    return areFine && AreBlocksOfCells(reaches, ofCells) && AreBlocksOfLabels(shape, ofLabel) &&
           ofCells->listed == ofLabel->listed && AreBlocksFree(reaches, ofLabel) &&
           ofLabel->listed == reaches->blocks.count;
}

/* Blocks are in the list of their cells and in that of their frame, or free. */
static bool AreReaches(kiriCheck* check, const kiriShape* shape)
{
    const kiriReaches* reaches = &shape->reaches;
    if (reaches->blocks.count == 0 || reaches->heads.count != reaches->blocks.count) {
        return kiriCheck_That(check, reaches->freeBlocks == 0 && reaches->heads.count == reaches->blocks.count);
    }
    kiriChains ofCells, ofLabel;
    return kiriCheck_StartChains(check, &ofCells, &reaches->heads.data->nextOfCells, sizeof(kiriReachHead),
                                 reaches->heads.count) &&
           kiriCheck_StartChains(check, &ofLabel, &reaches->blocks.data->nextOfFrame, sizeof(kiriReachBlock),
                                 reaches->blocks.count) &&
           kiriCheck_That(check, AreBlocksListed(shape, &ofCells, &ofLabel, check->count[KIRI_OF_CELLS]));
}

/* What an update has marked so far of what grid and regions have changed: as many as it has come to in their lists. */
static void MarkChanged(const kiriShapeWork* work, const kiriGrid* grid, const kiriRegions* regions, uint8_t* marks)
{
    const kiriGridChanges* changes = &grid->changes;
    int64_t left = work->stage == KIRI_SHAPE_MARK ? work->next : INT64_MAX;
    for (int32_t k = 0; k < changes->gone.count && left > 0; ++k, --left) {
        marks[changes->gone.data[k]] |= KIRI_MARK_GONE;
    }
    for (int32_t k = 0; k < changes->steps.count && left > 0; ++k, --left) {
        marks[changes->steps.data[k]] |= KIRI_MARK_STEPS;
    }
    left -= changes->material.count;
    for (int32_t k = 0; k < regions->changes.count && left > 0; ++k, --left) {
        marks[regions->changes.data[k].cell] |= KIRI_MARK_REGION;
    }
}

/* Cells that are marked so; each is there once, and lives. */
static bool MarkListed(const kiriGrid* grid, const int32_t* cells, int32_t count, uint8_t* marks, uint8_t mark)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < count; ++k) {
        areFine = (marks[cells[k]] & mark) == 0 && kiriGrid_IsCell(grid, cells[k]);
        marks[cells[k]] |= mark;
    }
    return areFine;
}

/* Marks say in which lists cells are, and what has changed about them; those of the frame at hand are of cells that are
   loaded. */
static bool AreMarksOfShape(kiriCheck* check, const kiriShape* shape, const kiriGrid* grid, const kiriRegions* regions)
{
    const uint8_t ofFrame = KIRI_MARK_SEED | KIRI_MARK_SEEN;
    const kiriShapeWork* work = shape->work;
    int32_t first = work->stage == KIRI_SHAPE_FINISH ? work->next : 0;
    uint8_t* marks = kiriCheck_Bytes(check, work->marks.count);
    bool areFine =
        marks != NULL && MarkListed(grid, shape->changes.data, shape->changes.count, marks, KIRI_MARK_CHANGED);
    if (areFine && work->stage != KIRI_SHAPE_REST) {
        MarkChanged(work, grid, regions, marks);
        areFine = MarkListed(grid, work->dirty.data + first, work->dirty.count - first, marks, KIRI_MARK_DIRTY);
    }
    for (int32_t c = 0; areFine && c < work->marks.count; ++c) {
        uint8_t is = work->marks.data[c], may = (marks[c] & KIRI_MARK_CHANGED) != 0 ? KIRI_MARK_RECOMPUTED : 0;
        may |= work->isLoaded.data[kiriReach_BlockOf(c)] != 0 ? ofFrame : 0;
        areFine = (is & ~(ofFrame | KIRI_MARK_RECOMPUTED)) == marks[c] && (is & ~(marks[c] | may)) == 0;
    }
    kiriMemory_Free(&check->memory, marks);
    return kiriCheck_That(check, areFine);
}

/* Frames that are dirty are listed; nothing is known of others. */
static bool AreDirtyFrames(kiriCheck* check, const kiriShapeWork* work)
{
    kiriIndices frames = { work->dirtyFrames.data, work->dirtyFrames.count, work->dirtyFrames.capacity };
    bool areFine = kiriCheck_Distinct(check, &frames, work->frames.count);
    int32_t dirty = 0;
    for (int32_t f = 0; areFine && f < work->frames.count; ++f) {
        const kiriShapeFrame* frame = &work->frames.data[f];
        dirty += frame->dirty;
        areFine = frame->dirty || (frame->firstTouch == KIRI_NONE && frame->touches == 0 && !frame->moved);
    }
    for (int32_t k = 0; areFine && k < frames.count; ++k) {
        areFine = work->frames.data[frames.data[k]].dirty;
    }
    return kiriCheck_That(check, areFine && dirty == frames.count && frames.capacity >= work->frames.count &&
                                     (work->stage != KIRI_SHAPE_REST || frames.count == 0));
}

static bool AreSideCounts(const kiriShapeWork* work, kiriSpan sides)
{
    bool areFine = true;
    for (int32_t k = sides.first; k < sides.first + sides.count; ++k) {
        areFine &= work->sideCounts.data[k] >= 0 && work->sideCounts.data[k] < INT32_MAX / 2;
    }
    return areFine;
}

static bool IsCounted(const kiriShape* shape, kiriCountedCell counted)
{
    const kiriShapeFrame* frames = shape->work->frames.data;
    return counted.label == KIRI_NONE ||
           (kiriLabels_Has(&shape->labels, counted.label, shape->work->frames.count) && counted.sides >= 0 &&
            counted.sides < frames[kiriLabels_Item(&shape->labels, counted.label)].sides.count);
}

/* How far distances have to go is counted in spans of their own; what touches frames are lists. */
static bool AreCounted(kiriCheck* check, const kiriShape* shape)
{
    const kiriShapeWork* work = shape->work;
    kiriRooms rooms;
    bool areFine = kiriCheck_StartRooms(check, &rooms, &work->sideCounts, sizeof(int32_t), &work->sideRoom);
    for (int32_t f = 0; areFine && f < work->frames.count; ++f) {
        const kiriShapeFrame* frame = &work->frames.data[f];
        areFine = kiriCheck_Span(check, &rooms, frame->sides) && AreSideCounts(work, frame->sides) &&
                  kiriCheck_That(check, frame->firstTouch == KIRI_NONE ||
                                            (frame->firstTouch >= 0 && frame->firstTouch < work->touches.count));
    }
    for (int32_t c = 0; areFine && c < shape->spans.count; ++c) {
        areFine = kiriCheck_That(check, IsCounted(shape, work->counted.data[c]));
    }
    for (int32_t k = 0; areFine && work->stage != KIRI_SHAPE_REST && k < work->touches.count; ++k) {
        areFine = kiriCheck_That(check, work->touches.data[k].next >= KIRI_NONE && work->touches.data[k].next < k);
    }
    return areFine;
}

static bool AreFar(const kiriShapeWork* work, int32_t cells)
{
    bool areFar = true;
    for (int32_t c = cells * KIRI_BLOCK_CELLS; c < (cells + 1) * KIRI_BLOCK_CELLS; ++c) {
        areFar &= (work->fromSite.distance.data[c] == KIRI_FAR) & (work->fromBorder.distance.data[c] == KIRI_FAR);
    }
    return areFar;
}

/* Blocks that are loaded are of one frame: each knows its cells. Others have no distances. */
static bool AreLoaded(kiriCheck* check, const kiriShape* shape)
{
    const kiriShapeWork* work = shape->work;
    const kiriReaches* reaches = &shape->reaches;
    uint8_t* seen = kiriCheck_Bytes(check, work->isLoaded.count);
    bool areFine = seen != NULL && work->loaded.capacity >= work->isLoaded.count &&
                   (work->stage == KIRI_SHAPE_MEASURE || work->loaded.count == 0);
    for (int32_t k = 0; areFine && k < work->loaded.count; ++k) {
        kiriLoadedBlock loaded = work->loaded.data[k];
        areFine = loaded.cells >= 0 && loaded.cells < work->isLoaded.count && !seen[loaded.cells] &&
                  loaded.block >= KIRI_NONE && loaded.block < reaches->blocks.count;
        if (areFine) {
            seen[loaded.cells] = 1;
            areFine = loaded.block == KIRI_NONE || (reaches->heads.data[loaded.block].label != KIRI_NONE &&
                                                    reaches->blocks.data[loaded.block].cells == loaded.cells);
        }
    }
    for (int32_t b = 0; areFine && b < work->isLoaded.count; ++b) {
        areFine = seen[b] == (work->isLoaded.data[b] != 0) && (seen[b] || AreFar(work, b));
    }
    kiriMemory_Free(&check->memory, seen);
    return kiriCheck_That(check, areFine);
}

/* Sums of it, in units of 2^-40 of a square, hold. */
#define MOST_OF_CELL (INT64_C(1) << 42)
#define MOST_OF_SHEET (INT64_C(1) << 61)

static bool IsRigidSum(int64_t sum, int64_t most)
{
    return sum >= -most && sum <= most;
}

static bool AreRigidSums(const kiriShape* shape)
{
    bool areFine = true;
    for (int32_t f = 0; f < shape->rigid.count; ++f) {
        areFine &= IsRigidSum(shape->rigid.data[f], MOST_OF_SHEET);
    }
    return areFine;
}

/* As many weights come to a cell as it awaits. */
static bool AreAwaited(kiriCheck* check, const kiriShape* shape)
{
    const kiriShapeWork* work = shape->work;
    int32_t* left = (int32_t*)(void*)kiriCheck_Bytes(check, (int64_t)sizeof(int32_t) * shape->spans.count);
    int32_t from = work->stage == KIRI_SHAPE_PLACE ? work->next : 0;
    bool areFine = left != NULL;
    bool isFilling = work->stage > KIRI_SHAPE_REST && work->stage < KIRI_SHAPE_FINISH;
    for (int32_t k = from; areFine && isFilling && k < work->rawWeights.count; ++k) {
        const kiriRawWeight* weight = &work->rawWeights.data[k];
        bool isAwaited = work->awaited.data[weight->cell] > 0;
        left[weight->cell] += isAwaited;
        areFine = weight->raw <= 1.0 && (isAwaited ? weight->raw > 0.0 : weight->raw >= 0.0);
    }
    for (int32_t c = 0; areFine && c < shape->spans.count; ++c) {
        areFine = left[c] == work->awaited.data[c] && IsRigidSum(work->rigidShares.data[c], MOST_OF_CELL);
    }
    kiriMemory_Free(&check->memory, left);
    return kiriCheck_That(check, areFine);
}

static bool AreLabels(const kiriShape* shape)
{
    return kiriLabels_AreSound(&shape->labels, shape->rigid.count) &&
           shape->reaches.ofLabel.count == kiriLabels_Count(&shape->labels, shape->rigid.count);
}

static bool AreRowsOfShape(const kiriShape* shape, const kiriGrid* grid)
{
    const kiriShapeWork* work = shape->work;
    int32_t cells = shape->spans.count, blocks = work->isLoaded.count;
    return cells <= grid->cells.count && (work->stage == KIRI_SHAPE_REST || cells == grid->cells.count) &&
           cells <= work->wasOwner.count && cells <= work->awaited.count && cells <= work->counted.count &&
           cells <= work->rigidShares.count && blocks == shape->reaches.ofCells.count &&
           work->marks.count == (int64_t)blocks * KIRI_BLOCK_CELLS && work->marks.count >= cells &&
           work->marks.count == work->fromSite.distance.count && work->marks.count == work->fromBorder.distance.count &&
           (work->frameStage == KIRI_FRAME_REST || work->stage == KIRI_SHAPE_MEASURE);
}

/* By kiriFrameStage: of distances to the site, and to the border. Where the site has moved they are flooded, else
   repaired; cells are marked for that before the frame is at hand. */
static bool AreFieldsOfFrame(kiriCheck* check, const kiriShapeWork* work)
{
    static const kiriFieldUse flooded[][2] = {
        { KIRI_FIELD_RESTS, KIRI_FIELD_RESTS },     { KIRI_FIELD_FLOODS, KIRI_FIELD_RESTS },
        { KIRI_FIELD_FLOODS, KIRI_FIELD_FLOODS },   { KIRI_FIELD_EMPTIED, KIRI_FIELD_EMPTIED },
        { KIRI_FIELD_FLOODS, KIRI_FIELD_RESTS },
    };
    static const kiriFieldUse repaired[][2] = {
        { KIRI_FIELD_MARKED, KIRI_FIELD_MARKED },   { KIRI_FIELD_REPAIRS, KIRI_FIELD_MARKED },
        { KIRI_FIELD_READ, KIRI_FIELD_REPAIRS },    { KIRI_FIELD_READ, KIRI_FIELD_READ },
        { KIRI_FIELD_READ, KIRI_FIELD_MARKED },
    };
    bool isAtFrame = work->stage == KIRI_SHAPE_MEASURE && work->next < work->dirtyFrames.count;
    bool isFlooded = !isAtFrame || work->frames.data[work->dirtyFrames.data[work->next]].moved;
    const kiriFieldUse* uses = (isFlooded ? flooded : repaired)[work->frameStage];
    return kiriCheck_That(check, isAtFrame || (work->frameStage == KIRI_FRAME_REST && work->due == 0)) &&
           kiriField_Check(&work->fromSite, check, INT32_MAX, uses[0]) &&
           kiriField_Check(&work->fromBorder, check, INT32_MAX, uses[1]);
}

/* Raw weights that are still to be put in their place are of cells that live. */
static bool AreWeightsToPlace(const kiriShapeWork* work, const kiriGrid* grid)
{
    bool areFine = true;
    for (int32_t k = work->stage == KIRI_SHAPE_PLACE ? work->next : 0;
         areFine && work->stage != KIRI_SHAPE_FINISH && k < work->rawWeights.count; ++k) {
        areFine = kiriGrid_IsCell(grid, work->rawWeights.data[k].cell);
    }
    return areFine;
}

static bool IsRunningShape(kiriCheck* check, const kiriShape* shape, const kiriGrid* grid)
{
    const kiriShapeWork* work = shape->work;
    return work->stage == KIRI_SHAPE_REST ||
           (kiriCheck_Object(check, RunningShapeMust, work) &&
            kiriCheck_That(check, AreWeightsToPlace(work, grid) &&
                                      (work->stage != KIRI_SHAPE_FINISH || work->next <= work->dirty.count)));
}

bool kiriShape_Check(const kiriShape* shape, const kiriGrid* grid, const kiriRegions* regions, kiriCheck* check)
{
    int64_t cells = check->count[KIRI_OF_CELLS];
    if (!kiriCheck_That(check, shape->work != NULL) || !kiriCheck_That(check, AreRowsOfShape(shape, grid))) {
        return false;
    }
    check->count[KIRI_OF_REGIONS] = shape->rigid.count;
    check->count[KIRI_OF_CELLS] = shape->spans.count;
    bool isFine = kiriCheck_That(check, shape->rigid.count <= check->count[KIRI_OF_SITES] && AreRigidSums(shape)) &&
                  kiriCheck_That(check, AreLabels(shape)) && kiriCheck_Object(check, ShapeMust, shape) &&
                  IsRunningShape(check, shape, grid) && AreReaches(check, shape) &&
                  AreDirtyFrames(check, shape->work) && AreFieldsOfFrame(check, shape->work) &&
                  AreLoaded(check, shape) && AreMarksOfShape(check, shape, grid, regions) && AreCounted(check, shape) &&
                  AreWeights(check, shape) && AreAwaited(check, shape);
    check->count[KIRI_OF_CELLS] = cells;
    return isFine;
}

bool kiriShape_IsAtWork(const kiriShape* shape)
{
    return shape->work != NULL && shape->work->stage != KIRI_SHAPE_REST;
}
