#include "kiri_shape.h"

#include "../core/kiri_archive.h"
#include "../core/kiri_array.h"

#include <string.h>

/* How far distances to the site of a frame have to go. */

/* How far distances to the site of its region have to go for the sake of a cell x: to itself, and where a step leads
   over the border to y, to the last cell that gets weight from there. Let the nearest way from such a cell c to the
   border come in by y. Then d <= D(x) + |xy| + |yc|, and the weight is above zero only where d > 2 e = D(x) + |xy| -
   D(y) + 2 |yc|: where |yc| < D(y), and so d < D(x) + |xy| + D(y). */
static int32_t ReachAt(const kiriShapeJob* job, int32_t x)
{
    const kiriField* field = &job->regions->field;
    const int32_t *owner = field->owner.data, *distance = field->distance.data;
    kiriSteps steps;
    int64_t farthest = distance[x];
    if (!job->regions->onBorder.data[x]) {
        return distance[x] < KIRI_FAR ? distance[x] : KIRI_FAR - 1;
    }
    kiriGrid_GetSteps(job->grid, x, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = steps.data[s];
        if (owner[step.cell] != owner[x]) {
            int64_t over = (int64_t)distance[x] + step.length + distance[step.cell];
            farthest = kiriMax(over, farthest);
        }
    }
    return farthest < KIRI_FAR ? (int32_t)farthest : KIRI_FAR - 1;
}

static void CountSide(const kiriShapeJob* job, kiriCountedCell counted, int32_t more)
{
    if (counted.label != KIRI_NONE) {
        int32_t frame = kiriLabels_Item(&job->shape->labels, counted.label);
        job->work->sideCounts.data[job->work->frames.data[frame].sides.first + counted.sides] += more;
    }
}

static void kiriShapeJob_UncountCell(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < job->work->counted.count);
    kiriCountedCell* counted = &job->work->counted.data[cell];
    CountSide(job, *counted, -1);
    *counted = (kiriCountedCell){ KIRI_NONE, 0 };
}

/* Room to count sides up to this number. */
static bool MakeSidesRoom(kiriShapeJob* job, int32_t frame, int32_t sides)
{
    kiriShapeWork* work = job->work;
    kiriSpan* span = &work->frames.data[frame].sides;
    int32_t k = span->count;
    if (sides >= k && !kiriSpan_Resize(span, &work->sideRoom, job->memory, &work->sideCounts,
                                       sizeof(*work->sideCounts.data), sides + 1)) {
        return false;
    }
    for (; k <= sides; ++k) {
        work->sideCounts.data[span->first + k] = 0;
    }
    return true;
}

static bool kiriShapeJob_CountCell(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < job->work->counted.count);
    kiriCountedCell is = { KIRI_NONE, 0 }, was = job->work->counted.data[cell];
    int32_t frame = job->regions->field.owner.data[cell];
    if (frame != KIRI_NONE) {
        is.label = kiriLabels_Of(&job->shape->labels, frame);
        is.sides = ReachAt(job, cell) / KIRI_UNIT;
    }
    if (is.label == was.label && is.sides == was.sides) {
        return true;
    }
    if (frame != KIRI_NONE && !MakeSidesRoom(job, frame, is.sides)) {
        return false;
    }
    kiriShapeJob_UncountCell(job, cell);
    CountSide(job, is, 1);
    job->work->counted.data[cell] = is;
    return true;
}

static int32_t kiriShapeJob_LimitOf(const kiriShapeJob* job)
{
    const kiriSpan span = job->work->frames.data[job->frame].sides;
    int64_t sides = span.count;
    while (sides > 1 && job->work->sideCounts.data[span.first + sides - 1] == 0) {
        --sides;
    }
    return sides < 1 ? KIRI_UNIT : sides * KIRI_UNIT < KIRI_FAR ? (int32_t)(sides * KIRI_UNIT) : KIRI_FAR - 1;
}

static bool IsInRegion(const kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < job->regions->field.owner.count);
    return job->regions->field.owner.data[cell] == job->frame;
}

/* ---- Seeds ------------------------------------------------------------------------------------------------------- */

static kiriSeed SiteSeed(const void* context, int32_t cell)
{
    const kiriShapeJob* job = context;
    const kiriSeed none = { cell, KIRI_FAR, KIRI_NONE };
    bool may = (job->work->marks.data[cell] & KIRI_MARK_SEED) != 0;
    return may ? kiriSite_SeedAt(&job->sites[job->frame], KIRI_NONE, job->grid, job->mesh, cell) : none;
}

/* The border lies on the way between x and y where the distances to their sites are equal. A half is rounded up. */
static int32_t DistanceToBorder(const kiriShapeJob* job, int32_t x)
{
    const int32_t* distance = job->regions->field.distance.data;
    kiriSteps steps;
    kiriGrid_GetSteps(job->grid, x, &steps);
    int32_t least = KIRI_FAR;
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = steps.data[s];
        if (IsInRegion(job, step.cell) != IsInRegion(job, x)) {
            int32_t half = (distance[step.cell] + step.length - distance[x] + 1) / 2;
            least = kiriMin(half, least);
        }
    }
    return kiriMax(least, 0); /* it is, but for distances that somebody made up */
}

static kiriSeed BorderSeed(const void* context, int32_t cell)
{
    const kiriShapeJob* job = context;
    bool has = job->regions->onBorder.data[cell] && job->work->fromSite.distance.data[cell] != KIRI_FAR;
    kiriSeed seed = { cell, has ? DistanceToBorder(job, cell) : KIRI_FAR, KIRI_NONE };
    return seed;
}

/* Outside the region, distances to the border are measured only as far as the weight is above zero: along a way e grows
   at least as fast as d. The flood may cross the border, for no step over it is shorter than the seed beyond. Whether a
   way goes on depends only on e where it passes: so there is still one fixed point, and a repair finds it. */
static bool HasWeight(const void* context, int32_t cell)
{
    const kiriShapeJob* job = context;
    int64_t d = job->work->fromSite.distance.data[cell], e = job->work->fromBorder.distance.data[cell];
    return d != KIRI_FAR && (d > 2 * e || IsInRegion(job, cell));
}

/* Algorithm 2, with d the distance to the site and e the distance to the border of its region: linear along a
   straight way from site to site.

   At a site c in the middle of its square its own weight is exactly 1 (d = 0), and any other frame's exactly 0:
   let the nearest way from c to the border of that frame's region cross it from y to x, with D the distances to
   the nearest site. Then e >= (D(x) + |xy| - D(y)) / 2 + |yc|, and D(y) <= |yc|, so 2 e >= D(x) + |xy| + |yc| >=
   d. */
static double RawWeight(bool inside, int32_t d, int32_t e)
{
    if (inside) {
        /* In a piece with one frame e is KIRI_FAR, which makes the weight 1 once it is normalised. */
        return e > 0 ? 0.5 * (1.0 + e / ((double)d + e)) : 0.5;
    }
    return (double)d > 2.0 * e ? 0.5 * (1.0 - e / ((double)d - e)) : 0.0;
}

/* ---- Its blocks -------------------------------------------------------------------------------------------------- */

enum { ITEMS_OF_LOAD = 8 };

/* There is room for all. */
static void LoadNewBlock(const kiriShapeJob* job, int32_t cells)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* reaches = &job->shape->reaches;
    int32_t block = kiriReaches_Find(reaches, job->label, cells), first = cells * KIRI_BLOCK_CELLS;
    KIRI_ASSERT(work->loaded.count < work->loaded.capacity);
    work->isLoaded.data[cells] = KIRI_BLOCK_LOADED;
    work->due += ITEMS_OF_LOAD;
    work->loaded.data[work->loaded.count++] = (kiriLoadedBlock){ cells, block };
    if (block != KIRI_NONE && !work->frames.data[job->frame].moved) {
        const kiriReachBlock* from = &reaches->blocks.data[block];
        memcpy(&work->fromSite.distance.data[first], from->fromSite, sizeof(from->fromSite));
        memcpy(&work->fromBorder.distance.data[first], from->fromBorder, sizeof(from->fromBorder));
    }
}

/* Loads the distances of these cells, unless they are made from scratch. */
static inline void LoadBlock(const kiriShapeJob* job, int32_t cells)
{
    KIRI_ASSERT(cells >= 0 && cells < job->work->isLoaded.count);
    if (!job->work->isLoaded.data[cells]) {
        LoadNewBlock(job, cells);
    }
}

/* Loads the cells that the steps of this one lead to. */
static void LoadAround(const void* context, int32_t cell)
{
    const kiriShapeJob* job = context;
    uint8_t* mark = &job->work->marks.data[cell];
    if ((*mark & KIRI_MARK_SEEN) != 0) {
        return;
    }
    *mark |= KIRI_MARK_SEEN;
    const kiriStepRun* run = &job->grid->runs.data[cell];
    if (kiriStepRun_IsOpen(run)) {
        const int32_t* around = kiriGrid_AroundOpen(job->grid, run);
        for (int k = 0; k < KIRI_OPEN_STEPS; ++k) {
            LoadBlock(job, kiriReach_BlockOf(around[job->grid->openTo[k]]));
        }
        return;
    }
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        LoadBlock(job, kiriReach_BlockOf(job->grid->steps.data[s].cell));
    }
}

/* Where the site has moved, nothing of what was is of use; but weights of cells that are out of reach now must go. */
static void LoadAllBlocks(kiriShapeJob* job)
{
    const kiriReaches* reaches = &job->shape->reaches;
    for (int32_t b = reaches->ofLabel.data[job->label]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
        LoadBlock(job, reaches->blocks.data[b].cells);
    }
}

/* A cell has another owner or distance. So where the border of the frame's region runs between it and a cell beside it,
   the seeds of both may differ. */
static void MarkBorderSeedsDirty(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < job->work->wasOwner.count);
    kiriField* field = &job->work->fromBorder;
    bool inside = IsInRegion(job, cell), turned = inside != (job->work->wasOwner.data[cell] == job->frame);
    kiriSteps steps;
    LoadAround(job, cell);
    if (turned) {
        kiriField_MarkDirty(field, cell);
        job->work->isLoaded.data[kiriReach_BlockOf(cell)] |= KIRI_BLOCK_TURNED;
    } else if (!job->regions->onBorder.data[cell]) {
        return;
    }
    kiriGrid_GetSteps(job->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t beside = steps.data[s].cell;
        if (turned || IsInRegion(job, beside) != inside) {
            kiriField_MarkStepsDirty(field, cell);
            kiriField_MarkStepsDirty(field, beside);
        }
    }
}

/* The steps of a cell have changed. Of those that they lead to, cells that the frame does not reach yet do not know of
   it: other frames, or none, have touched them. */
static void MarkStepsAround(kiriShapeJob* job, int32_t cell)
{
    kiriShapeWork* work = job->work;
    kiriSteps steps;
    kiriField_MarkStepsDirty(&work->fromSite, cell);
    kiriField_MarkStepsDirty(&work->fromBorder, cell);
    LoadAround(job, cell);
    kiriGrid_GetSteps(job->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t beside = steps.data[s].cell;
        if (work->fromSite.distance.data[beside] == KIRI_FAR && (work->marks.data[beside] & KIRI_MARK_STEPS) != 0) {
            kiriField_MarkStepsDirty(&work->fromSite, beside);
        }
    }
}

/* Loads a changed cell, and marks what may change in the fields. */
static void LoadTouched(kiriShapeJob* job, int32_t cell)
{
    kiriShapeWork* work = job->work;
    uint8_t mark = work->marks.data[cell];
    LoadBlock(job, kiriReach_BlockOf(cell));
    if ((mark & KIRI_MARK_GONE) != 0) {
        kiriField_Forget(&work->fromSite, cell);
        kiriField_Forget(&work->fromBorder, cell);
        return;
    }
    if ((mark & KIRI_MARK_STEPS) != 0) {
        MarkStepsAround(job, cell);
    }
    if ((mark & KIRI_MARK_REGION) != 0) {
        MarkBorderSeedsDirty(job, cell);
    }
}

/* The limit is another: cells beyond it lose their distance, or distances have to go on from those near the old one. */
static void LoadBeyond(kiriShapeJob* job, int32_t limit)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* reaches = &job->shape->reaches;
    int32_t old = work->frames.data[job->frame].limit, rim = limit > old ? old - KIRI_UNIT_KNIGHT : limit;
    for (int32_t b = reaches->ofLabel.data[job->label]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
        const kiriReachBlock* block = &reaches->blocks.data[b];
        for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
            int32_t cell = block->cells * KIRI_BLOCK_CELLS + k;
            if (block->fromSite[k] <= rim || block->fromSite[k] == KIRI_FAR ||
                (work->marks.data[cell] & KIRI_MARK_GONE) != 0) {
                continue;
            }
            LoadBlock(job, block->cells);
            if (limit > old) {
                kiriField_MarkDirty(&work->fromSite, cell);
            } else {
                kiriField_Forget(&work->fromSite, cell);
                kiriField_MarkDirty(&work->fromBorder, cell);
            }
        }
    }
}

enum { ITEMS_OF_TOUCH = 2 };

/* The cells about which something has changed. */
static kiriProgress LoadAllTouched(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeFrame* frame = &job->work->frames.data[job->frame];
    for (; !frame->moved && frame->firstTouch != KIRI_NONE; --frame->touches) {
        if (!kiriQuota_Take(quota, ITEMS_OF_TOUCH)) {
            return KIRI_MORE;
        }
        kiriTouchedCell touched = job->work->touches.data[frame->firstTouch];
        LoadTouched(job, touched.cell);
        frame->firstTouch = touched.next;
    }
    return KIRI_DONE;
}

/* The seeds of a site depend on the steps of its cell, so cells there are dirty too. */
static void LoadChanges(kiriShapeJob* job, int32_t limit)
{
    kiriShapeWork* work = job->work;
    int32_t cell = job->sites[job->frame].cell;
    kiriSteps steps;
    if (limit != work->frames.data[job->frame].limit) {
        LoadBeyond(job, limit);
    }
    if ((work->marks.data[cell] & KIRI_MARK_STEPS) != 0) {
        LoadAround(job, cell);
        kiriGrid_GetSteps(job->grid, cell, &steps);
        for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
            kiriField_MarkStepsDirty(&work->fromSite, steps.data[s].cell);
        }
    }
}

static bool StartFromSite(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    kiriShapeFrame* frame = &work->frames.data[job->frame];
    int32_t limit = kiriShapeJob_LimitOf(job);
    work->seeds.count = 0;
    if (!kiriSite_Seed(&job->sites[job->frame], KIRI_NONE, job->memory, job->grid, job->mesh, &work->seeds)) {
        return false;
    }
    for (int32_t k = 0; k < work->seeds.count; ++k) {
        work->marks.data[work->seeds.data[k].cell] |= KIRI_MARK_SEED;
        LoadBlock(job, kiriReach_BlockOf(work->seeds.data[k].cell));
    }
    if (frame->moved) {
        LoadAllBlocks(job);
    } else {
        LoadChanges(job, limit);
    }
    frame->limit = limit;
    return !frame->moved || kiriField_Start(&work->fromSite, job->memory, work->seeds.data, work->seeds.count);
}

static bool SeedBorder(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    const uint8_t* onBorder = job->regions->onBorder.data;
    work->seeds.count = 0;
    for (int32_t k = 0; k < work->fromSite.settled.count; ++k) {
        int32_t cell = work->fromSite.settled.data[k];
        if (onBorder[cell]) {
            kiriSeed seed = { cell, DistanceToBorder(job, cell), KIRI_NONE };
            if (seed.distance < KIRI_FAR && !kiriArray_Push(job->memory, &work->seeds, seed)) {
                return false;
            }
        }
    }
    return kiriField_Start(&work->fromBorder, job->memory, work->seeds.data, work->seeds.count);
}

/* Where the distance to the site has changed, ways to the border may pass that did not, or no more. */
static kiriProgress MarkForBorder(kiriShapeJob* job, kiriQuota* quota)
{
    enum { MARKED_AN_ITEM = 4 };
    kiriShapeWork* work = job->work;
    for (; work->fromSite.log.count > 0; --work->fromSite.log.count) {
        int32_t last = work->fromSite.log.count - 1;
        kiriSeed was = work->fromSite.log.data[last];
        bool isOther = work->fromSite.distance.data[was.cell] != was.distance;
        bool mayTurn = isOther && (work->marks.data[was.cell] & KIRI_MARK_REGION) != 0;
        if (!kiriQuota_Take(quota, mayTurn || last % MARKED_AN_ITEM == 0)) {
            return KIRI_MORE;
        }
        if (isOther) {
            kiriField_MarkDirty(&work->fromBorder, was.cell);
        }
        if (mayTurn) {
            MarkBorderSeedsDirty(job, was.cell);
        }
    }
    return KIRI_DONE;
}

static kiriProgress StartFromBorder(kiriShapeJob* job, kiriQuota* quota)
{
    enum { SEEDED_AN_ITEM = 16 };
    kiriShapeWork* work = job->work;
    kiriProgress progress = KIRI_DONE;
    if (!work->frames.data[job->frame].moved) {
        progress = MarkForBorder(job, quota);
    } else if (!kiriQuota_TakeAtMostAll(quota, work->fromSite.settled.count / SEEDED_AN_ITEM)) {
        progress = KIRI_MORE;
    } else if (!SeedBorder(job)) {
        progress = KIRI_FAILED;
    }
    work->frameStage = progress == KIRI_DONE ? KIRI_FRAME_BORDER : KIRI_FRAME_SEEDS;
    return progress;
}

/* Fields that are made from scratch are empty where no block is loaded. */
static kiriLookFn* LookFor(const kiriShapeJob* job)
{
    return job->work->frames.data[job->frame].moved ? NULL : LoadAround;
}

static kiriProgress MeasureField(kiriShapeJob* job, kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    int32_t k = field->settled.count;
    if (!job->work->frames.data[job->frame].moved) {
        return kiriField_Repair(field, job->memory, rule, quota);
    }
    kiriProgress progress = kiriField_Flood(field, rule, quota);
    for (; k < field->settled.count; ++k) {
        LoadBlock(job, kiriReach_BlockOf(field->settled.data[k]));
    }
    return progress;
}

/* ---- Back into its blocks ---------------------------------------------------------------------------------------- */

/* UnloadFrame has made room. */
static void AddRawWeight(kiriShapeJob* job, int32_t cell, int32_t fromSite, int32_t fromBorder)
{
    KIRI_ASSERT(cell >= 0 && cell < job->shape->spans.count);
    kiriShapeWork* work = job->work;
    double raw = fromSite == KIRI_FAR ? 0.0 : RawWeight(IsInRegion(job, cell), fromSite, fromBorder);
    bool none = job->shape->spans.data[cell].count == 0;
    if (raw > 0.0 || !none) {
        work->awaited.data[cell] += none;
        KIRI_ASSERT(work->rawWeights.count < work->rawWeights.capacity);
        work->rawWeights.data[work->rawWeights.count++] = (kiriRawWeight){ cell, job->frame, raw };
    }
}

/* Has the cell come to the region of the frame, or left it? */
static bool HasTurned(const kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < job->work->marks.count);
    return (job->work->marks.data[cell] & KIRI_MARK_REGION) != 0 &&
           (job->work->wasOwner.data[cell] == job->frame) != IsInRegion(job, cell);
}

/* Distances to the border are given one step farther than ways go on: does the frame reach any of these cells? */
static bool DropBeyond(const int32_t* fromSite, int32_t* fromBorder)
{
    bool any = false;
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
        fromBorder[k] = fromSite[k] == KIRI_FAR ? KIRI_FAR : fromBorder[k];
        any = any || fromSite[k] != KIRI_FAR;
    }
    return any;
}

/* The distances go back into the block. Weights follow where they have changed. */
static void UnloadCells(kiriShapeJob* job, kiriReachBlock* block, const int32_t* fromSite, const int32_t* fromBorder)
{
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
        int32_t cell = block->cells * KIRI_BLOCK_CELLS + k;
        bool same = block->fromSite[k] == fromSite[k] && block->fromBorder[k] == fromBorder[k];
        bool is = fromSite[k] != KIRI_FAR || block->fromSite[k] != KIRI_FAR;
        block->fromSite[k] = fromSite[k];
        block->fromBorder[k] = fromBorder[k];
        if (is && (!same || HasTurned(job, cell)) && kiriGrid_IsCell(job->grid, cell)) {
            AddRawWeight(job, cell, fromSite[k], fromBorder[k]);
        }
    }
}

/* Has nothing changed in the block? */
static bool IsAsLoaded(const kiriShapeJob* job, int32_t cells, const kiriReachBlock* block)
{
    const kiriShapeWork* work = job->work;
    int32_t first = cells * KIRI_BLOCK_CELLS;
    return !work->frames.data[job->frame].moved && work->isLoaded.data[cells] == KIRI_BLOCK_LOADED &&
           memcmp(block->fromSite, &work->fromSite.distance.data[first], sizeof(block->fromSite)) == 0 &&
           memcmp(block->fromBorder, &work->fromBorder.distance.data[first], sizeof(block->fromBorder)) == 0;
}

static void UnloadBlock(kiriShapeJob* job, kiriLoadedBlock loaded)
{
    kiriShapeWork* work = job->work;
    kiriReaches* reaches = &job->shape->reaches;
    int32_t first = loaded.cells * KIRI_BLOCK_CELLS, block = loaded.block;
    int32_t *fromSite = &work->fromSite.distance.data[first], *fromBorder = &work->fromBorder.distance.data[first];
    bool any = DropBeyond(fromSite, fromBorder);
    if (any && block == KIRI_NONE) {
        block = kiriReaches_Add(reaches, job->label, loaded.cells);
    }
    if (block != KIRI_NONE && !IsAsLoaded(job, loaded.cells, &reaches->blocks.data[block])) {
        UnloadCells(job, &reaches->blocks.data[block], fromSite, fromBorder);
    }
    if (!any && block != KIRI_NONE) {
        kiriReaches_Remove(reaches, block);
    }
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
        fromSite[k] = fromBorder[k] = KIRI_FAR;
        work->marks.data[first + k] &= (uint8_t) ~(KIRI_MARK_SEED | KIRI_MARK_SEEN);
    }
    work->isLoaded.data[loaded.cells] = 0;
}

/* Of a block, which is looked for in several places of memory; and of cells with other distances, which may get another
   weight. */
static int64_t ItemsToUnload(const kiriShapeJob* job, kiriLoadedBlock loaded)
{
    enum { ITEMS_OF_BLOCK = 2, CHANGED_AN_ITEM = 2 };
    const kiriShapeWork* work = job->work;
    const kiriReachBlock* block = loaded.block != KIRI_NONE ? &job->shape->reaches.blocks.data[loaded.block] : NULL;
    int32_t first = loaded.cells * KIRI_BLOCK_CELLS, changed = 0;
    const int32_t *fromSite = &work->fromSite.distance.data[first],
                  *fromBorder = &work->fromBorder.distance.data[first];
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
        int32_t wasSite = block != NULL ? block->fromSite[k] : KIRI_FAR;
        int32_t wasBorder = block != NULL ? block->fromBorder[k] : KIRI_FAR;
        changed += (fromSite[k] != wasSite) | ((fromBorder[k] != wasBorder) & (fromSite[k] != KIRI_FAR));
    }
    return ITEMS_OF_BLOCK + changed / CHANGED_AN_ITEM;
}

/* For all that may come out of the fields. */
static bool ReserveUnload(kiriShapeJob* job)
{
    kiriReaches* reaches = &job->shape->reaches;
    kiriShapeWork* work = job->work;
    int64_t blocks = kiriReaches_RoomFor(reaches, work->loaded.count),
            weights = work->rawWeights.count + (int64_t)KIRI_BLOCK_CELLS * work->loaded.count;
    return kiriArray_Reserve(job->memory, &reaches->blocks, blocks) &&
           kiriArray_Reserve(job->memory, &reaches->heads, blocks) &&
           kiriArray_Reserve(job->memory, &work->rawWeights, weights);
}

/* Brings the blocks up to date with the fields, and empties these. */
static kiriProgress UnloadFrame(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    if (!ReserveUnload(job)) {
        return KIRI_FAILED;
    }
    for (; work->loaded.count > 0; --work->loaded.count) {
        kiriLoadedBlock loaded = work->loaded.data[work->loaded.count - 1];
        if (!kiriQuota_Take(quota, ItemsToUnload(job, loaded))) {
            return KIRI_MORE;
        }
        UnloadBlock(job, loaded);
    }
    work->fromSite.settled.count = work->fromSite.log.count = 0;
    work->fromBorder.settled.count = work->fromBorder.log.count = 0;
    work->frameStage = KIRI_FRAME_REST;
    return KIRI_DONE;
}

/* ---- Algorithm 2 of a frame -------------------------------------------------------------------------------------- */

static kiriProgress StartFrame(kiriShapeJob* job, kiriQuota* quota)
{
    kiriProgress progress = LoadAllTouched(job, quota);
    if (progress == KIRI_DONE) {
        job->work->frameStage = KIRI_FRAME_SITE;
        progress = StartFromSite(job) ? KIRI_DONE : KIRI_FAILED;
    }
    return progress;
}

static kiriProgress MeasureFromSite(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    const kiriRule rule = { job->grid,     work->frames.data[job->frame].limit, NULL, SiteSeed, job, LookFor(job),
                            { NULL, NULL } };
    kiriProgress progress = MeasureField(job, &work->fromSite, &rule, quota);
    if (progress == KIRI_DONE) {
        work->frameStage = KIRI_FRAME_SEEDS;
    }
    return progress;
}

static kiriProgress MeasureFromBorder(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    const kiriRule rule = { job->grid, KIRI_FAR - 1, HasWeight, BorderSeed, job, LookFor(job), { NULL, NULL } };
    kiriProgress progress = MeasureField(job, &work->fromBorder, &rule, quota);
    if (progress == KIRI_DONE) {
        work->frameStage = KIRI_FRAME_UNLOAD;
    }
    return progress;
}

/* By kiriFrameStage. */
static kiriProgress (*const frameStages[])(kiriShapeJob* job, kiriQuota* quota) = {
    StartFrame, MeasureFromSite, MeasureFromBorder, UnloadFrame, StartFromBorder,
};

static kiriProgress kiriShapeJob_MeasureFrame(kiriShapeJob* job, kiriQuota* quota)
{
    kiriProgress progress = KIRI_DONE;
    do {
        bool isPaid = kiriQuota_Pay(quota, &job->work->due);
        progress = isPaid ? frameStages[job->work->frameStage](job, quota) : KIRI_MORE;
    } while (progress == KIRI_DONE && job->work->frameStage != KIRI_FRAME_REST);
    return progress;
}

/* ---- The weights of a cell --------------------------------------------------------------------------------------- */

/* Adds a share to the rigid sums of the frames that hold the cell rigidly. */
static void AddRigid(kiriShapeJob* job, int32_t cell, int64_t share)
{
    KIRI_ASSERT(cell >= 0 && cell < job->shape->spans.count);
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
    KIRI_ASSERT(cell >= 0 && cell < job->work->marks.count);
    if ((job->work->marks.data[cell] & KIRI_MARK_DIRTY) != 0) {
        return true;
    }
    job->work->marks.data[cell] |= KIRI_MARK_DIRTY;
    AddRigid(job, cell, -job->work->rigidShares.data[cell]);
    return kiriArray_Push(job->memory, &job->work->dirty, cell);
}

static bool MarkWeightsDirty(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < job->work->marks.count);
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
    KIRI_ASSERT(cell >= 0 && cell < job->work->awaited.count);
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

/* Its weights and its material are what they shall be. */
static void FinishCell(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(job->work->awaited.data[cell] == 0);
    double share = kiriGrid_Area(job->grid, cell) / (job->grid->side * job->grid->side);
    job->work->rigidShares.data[cell] = (int64_t)(share * 1099511627776.0 + 0.5);
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
    KIRI_ASSERT(cell >= 0 && cell < job->work->rigidShares.count);
    AddRigid(job, cell, -job->work->rigidShares.data[cell]);
    ResizeWeights(job, cell, 0);
    kiriShapeJob_UncountCell(job, cell);
    job->work->marks.data[cell] |= KIRI_MARK_GONE;
    return TouchCell(job, cell);
}

static bool MarkSteps(kiriShapeJob* job, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < job->work->marks.count);
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
    KIRI_ASSERT(frame >= 0 && frame < shape->work->frames.count);
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
    }
}
