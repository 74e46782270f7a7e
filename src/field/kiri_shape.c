#include "kiri_shape.h"

#include "../core/kiri_archive.h"
#include "../core/kiri_array.h"

/* Marks of a cell. */
enum {
    MARK_STEPS = 1, /* new, or its steps changed */
    MARK_GONE = 2,
    MARK_REGION = 4,      /* its owner or the distance to its site changed */
    MARK_CHANGED = 8,     /* it is in shape->changes, */
    MARK_RECOMPUTED = 16, /* and counted in shape->recomputed */
    MARK_DIRTY = 32,      /* it is in work->dirty */
    MARK_SEED = 64,       /* the site of the current frame may send it a seed */
    MARK_SEEN = 128,      /* the cells that its steps lead to are loaded */
};

/* An update, and the frame that is measured. */
typedef struct ShapeJob {
    kiriShape* shape;
    kiriShapeWork* work;
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriRegions* regions;
    const kiriSite* sites;
    int32_t siteCount;
    kiriQuota* quota;
    bool outOfMemory; /* the update fails */
    int32_t frame;
} ShapeJob;

/* ---- How far the distances of a frame go ------------------------------------------------------------------------- */

/* Returns how far distances to the site of its region have to go for the sake of a cell x: to itself, and where a step
   leads over the border to y, to the last cell that gets weight from there. Let the nearest way from such a cell c to
   the border come in by y. Then d <= D(x) + |xy| + |yc|, and the weight is above zero only where d > 2 e = D(x) + |xy|
   - D(y) + 2 |yc|: where |yc| < D(y), and so d < D(x) + |xy| + D(y). */
static int32_t FarthestFor(const ShapeJob* job, int32_t x)
{
    const kiriField* field = &job->regions->field;
    const int32_t *owner = field->owner.data, *distance = field->distance.data;
    int64_t farthest = distance[x];
    KIRI_ASSERT(owner[x] != KIRI_NONE && distance[x] < KIRI_FAR);
    if (job->regions->onBorder.data[x]) {
        KIRI_EACH_STEP(step, job->grid, x, KIRI_KNIGHT) {
            int64_t over = (int64_t)distance[x] + step.length + distance[step.cell];
            farthest = owner[step.cell] != owner[x] ? kiriMax(over, farthest) : farthest;
        }
    }
    return (int32_t)kiriMin(farthest, KIRI_FAR - 1);
}

/* Counts a cell for the limit of a frame, and no longer for another one. A frame of KIRI_NONE: for none. */
static void CountFor(ShapeJob* job, int32_t cell, kiriCountedCell is)
{
    KIRI_ASSERT(cell >= 0 && cell < job->work->counted.count && is.sides >= 0);
    kiriShapeWork* work = job->work;
    kiriCountedCell* was = &work->counted.data[cell];
    if (is.frame == was->frame && is.sides == was->sides) {
        return;
    }
    if (is.frame != KIRI_NONE) {
        kiriSpan* span = &work->frames.data[is.frame].sides;
        int32_t k = span->count;
        if (is.sides >= k && !kiriSpan_Resize(span, &work->sideRoom, job->memory, &work->sideCounts,
                                              sizeof(*work->sideCounts.data), is.sides + 1)) {
            job->outOfMemory = true;
            return;
        }
        for (; k <= is.sides; ++k) {
            work->sideCounts.data[span->first + k] = 0;
        }
        work->sideCounts.data[span->first + is.sides] += 1;
    }
    if (was->frame != KIRI_NONE) {
        kiriSpan span = work->frames.data[was->frame].sides;
        KIRI_ASSERT(was->sides < span.count && work->sideCounts.data[span.first + was->sides] > 0);
        work->sideCounts.data[span.first + was->sides] -= 1;
    }
    *was = is;
}

static void CountCell(ShapeJob* job, int32_t cell)
{
    kiriCountedCell is = { KIRI_NONE, 0 };
    int32_t frame = job->regions->field.owner.data[cell];
    if (frame != KIRI_NONE) {
        is.frame = frame;
        is.sides = FarthestFor(job, cell) / KIRI_UNIT;
    }
    CountFor(job, cell, is);
}

/* ---- Algorithm 2: seeds and weights ------------------------------------------------------------------------------ */

static bool IsInRegion(const ShapeJob* job, int32_t cell)
{
    KIRI_ASSERT_HAS(job->regions->field.owner, cell);
    return job->regions->field.owner.data[cell] == job->frame;
}

static kiriSeed SiteSeed(const void* context, int32_t cell)
{
    const ShapeJob* job = context;
    const kiriSeed none = { cell, KIRI_FAR, KIRI_NONE };
    bool may = (job->work->marks.data[cell] & MARK_SEED) != 0;
    return may ? kiriSite_SeedAt(&job->sites[job->frame], KIRI_NONE, job->grid, cell) : none;
}

/* Returns the seed at the border: it crosses the step from x to y where the distances to their sites are equal. Rounds
   a half up. */
static kiriSeed BorderSeed(const void* context, int32_t x)
{
    const ShapeJob* job = context;
    const int32_t* distance = job->regions->field.distance.data;
    kiriSeed seed = { x, KIRI_FAR, KIRI_NONE };
    if (job->regions->onBorder.data[x] && job->work->fromSite.distance.data[x] != KIRI_FAR) {
        KIRI_EACH_STEP(step, job->grid, x, KIRI_KNIGHT) {
            if (IsInRegion(job, step.cell) != IsInRegion(job, x)) {
                int32_t half = (distance[step.cell] + step.length - distance[x] + 1) / 2;
                seed.distance = kiriMin(half, seed.distance);
            }
        }
    }
    KIRI_ASSERT(seed.distance >= 0);
    return seed;
}

/* Returns true if the weight is positive. Outside the region, distances to the border are measured only as far as that:
   along a path, e grows at least as fast as d. The flood may cross the border, as no step over it is shorter than the
   seed beyond. Whether a path continues depends only on e along it: so the fixed point is unique, and a repair finds
   it. */
static bool HasWeightAt(const ShapeJob* job, int32_t cell, int64_t d)
{
    int64_t e = job->work->fromBorder.distance.data[cell];
    return d != KIRI_FAR && (d > 2 * e || IsInRegion(job, cell));
}

static bool HasWeight(const void* context, int32_t cell)
{
    const ShapeJob* job = context;
    return HasWeightAt(job, cell, job->work->fromSite.distance.data[cell]);
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

/* ---- Changes of grid and regions --------------------------------------------------------------------------------- */

static void MarkFrameDirty(ShapeJob* job, int32_t frame)
{
    kiriShapeWork* work = job->work;
    KIRI_ASSERT(frame >= KIRI_NONE && frame < job->siteCount);
    if (frame != KIRI_NONE && !work->frames.data[frame].dirty) {
        work->frames.data[frame].dirty = true;
        KIRI_NEXT(work->dirtyFrames) = frame;
    }
}

/* Tells all frames that reach a changed cell. */
static void TouchCell(ShapeJob* job, int32_t cell)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* reaches = &job->shape->reaches;
    for (int32_t b = reaches->ofCells.data[kiriReach_BlockOf(cell)]; b != KIRI_NONE;
         b = reaches->heads.data[b].nextOfCells) {
        if (reaches->blocks.data[b].fromSite[cell % KIRI_BLOCK_CELLS] != KIRI_FAR) {
            int32_t frame = reaches->heads.data[b].frame;
            kiriTouchedCell touched = { cell, work->frames.data[frame].firstTouch };
            MarkFrameDirty(job, frame);
            work->frames.data[frame].firstTouch = work->touches.count;
            if (!kiriArray_Push(job->memory, &work->touches, touched)) {
                work->frames.data[frame].firstTouch = touched.next;
                job->outOfMemory = true;
            }
        }
    }
}

/* Adds a cell to a list, unless it has this mark of the list. */
static void MarkCell(ShapeJob* job, int32_t cell, uint8_t mark, kiriIndices* list)
{
    KIRI_ASSERT(kiriGrid_IsCell(job->grid, cell));
    if ((job->work->marks.data[cell] & mark) == 0) {
        job->work->marks.data[cell] |= mark;
        bool ok = kiriArray_Push(job->memory, list, cell);
        job->outOfMemory = job->outOfMemory || !ok;
    }
}

static void MarkDirty(ShapeJob* job, int32_t cell)
{
    MarkCell(job, cell, MARK_DIRTY, &job->work->dirty);
}

static void MarkChanged(ShapeJob* job, int32_t cell)
{
    MarkCell(job, cell, MARK_CHANGED, &job->shape->changes);
}

/* Adds a share to the rigid sums of the frames that hold the cell rigidly. */
static void AddRigid(ShapeJob* job, int32_t cell, int64_t share)
{
    kiriShape* shape = job->shape;
    kiriSpan span = shape->spans.data[cell];
    KIRI_EACH_IN(k, span) {
        const kiriCellWeight* weight = &shape->weights.data[k];
        if (kiriCellWeight_Value(weight) > shape->rigidWeight) {
            shape->rigid.data[weight->frame] += share;
        }
    }
}

static bool MarkGone(ShapeJob* job, int32_t item)
{
    kiriShape* shape = job->shape;
    int32_t cell = job->grid->changes.gone.data[item];
    AddRigid(job, cell, -job->work->rigidShares.data[cell]);
    kiriSpan_Resize(&shape->spans.data[cell], &shape->room, job->memory, &shape->weights, sizeof(kiriCellWeight), 0);
    CountFor(job, cell, (kiriCountedCell){ KIRI_NONE, 0 });
    job->work->marks.data[cell] |= MARK_GONE;
    TouchCell(job, cell);
    return true;
}

static bool MarkSteps(ShapeJob* job, int32_t item)
{
    int32_t cell = job->grid->changes.steps.data[item];
    job->work->marks.data[cell] |= MARK_STEPS;
    MarkChanged(job, cell);
    TouchCell(job, cell);
    return true;
}

static bool MarkMaterial(ShapeJob* job, int32_t item)
{
    MarkDirty(job, job->grid->changes.material.data[item].cell);
    return true;
}

static bool MarkRegion(ShapeJob* job, int32_t item)
{
    kiriSeed was = job->regions->changes.data[item];
    uint8_t* mark = &job->work->marks.data[was.cell];
    *mark |= MARK_REGION;
    job->work->wasOwner.data[was.cell] = was.owner;
    MarkFrameDirty(job, was.owner);
    MarkFrameDirty(job, job->regions->field.owner.data[was.cell]);
    if ((*mark & MARK_STEPS) == 0) {
        TouchCell(job, was.cell);
    }
    return true;
}

/* Counts how far distances have to go for the sake of a cell that has changed, and of the cells beside it. */
static void CountAround(ShapeJob* job, int32_t cell)
{
    CountCell(job, cell);
    KIRI_EACH_STEP(step, job->grid, cell, KIRI_KNIGHT) {
        int32_t beside = step.cell;
        if ((job->work->marks.data[beside] & (MARK_STEPS | MARK_REGION)) == 0) {
            CountCell(job, beside);
        }
    }
}

static bool CountSteps(ShapeJob* job, int32_t item)
{
    CountAround(job, job->grid->changes.steps.data[item]);
    return true;
}

static bool CountRegion(ShapeJob* job, int32_t item)
{
    int32_t cell = job->regions->changes.data[item].cell;
    if ((job->work->marks.data[cell] & MARK_STEPS) == 0) {
        CountAround(job, cell);
    }
    return true;
}

/* ---- Distances of a frame, from its blocks ----------------------------------------------------------------------- */

/* Loads the distances of a block of cells, unless they are made from scratch. */
static inline void LoadBlock(const ShapeJob* job, int32_t cells)
{
    enum { COST_OF_LOAD = 8 };
    kiriShapeWork* work = job->work;
    const kiriReaches* reaches = &job->shape->reaches;
    KIRI_ASSERT_HAS(work->isLoaded, cells);
    if (work->isLoaded.data[cells]) {
        return;
    }
    int32_t block = kiriReaches_Find(reaches, job->frame, cells), first = cells * KIRI_BLOCK_CELLS;
    work->isLoaded.data[cells] = 1;
    work->debt += COST_OF_LOAD;
    KIRI_NEXT(work->loaded) = (kiriLoadedBlock){ cells, block };
    if (block != KIRI_NONE && !work->frames.data[job->frame].moved) {
        const kiriReachBlock* from = &reaches->blocks.data[block];
        memcpy(&work->fromSite.distance.data[first], from->fromSite, sizeof(from->fromSite));
        memcpy(&work->fromBorder.distance.data[first], from->fromBorder, sizeof(from->fromBorder));
    }
}

/* Loads the cells that the steps of this one lead to: all are, if the ends of the rows around an open one are. */
static void LoadAround(const void* context, int32_t cell)
{
    const ShapeJob* job = context;
    const uint8_t* isLoaded = job->work->isLoaded.data;
    uint8_t* mark = &job->work->marks.data[cell];
    bool isReady = (*mark & MARK_SEEN) != 0 || kiriGrid_IsOpen(job->grid, cell);
    for (int32_t v = -2; isReady && (*mark & MARK_SEEN) == 0 && v <= 2; ++v) {
        int32_t at = cell + v * job->grid->mesh->squares.columns, reach = v == -1 || v == 1 ? 2 : 1;
        isReady = isLoaded[kiriReach_BlockOf(at - reach)] && isLoaded[kiriReach_BlockOf(at + reach)];
    }
    if (!isReady) {
        KIRI_EACH_STEP(step, job->grid, cell, KIRI_KNIGHT) {
            LoadBlock(job, kiriReach_BlockOf(step.cell));
        }
    }
    *mark |= MARK_SEEN;
}

/* Marks the seeds that may differ where a cell has another owner or distance: its own seed, and the seeds of cells
   beside it across the border of the region. */
static void MarkBorderSeedsDirty(ShapeJob* job, int32_t cell)
{
    KIRI_ASSERT((job->work->marks.data[cell] & MARK_REGION) != 0);
    kiriField* field = &job->work->fromBorder;
    bool inside = IsInRegion(job, cell), turned = inside != (job->work->wasOwner.data[cell] == job->frame);
    LoadAround(job, cell);
    if (turned) {
        kiriField_MarkDirty(field, cell);
    } else if (!job->regions->onBorder.data[cell]) {
        return;
    }
    KIRI_EACH_STEP(step, job->grid, cell, KIRI_KNIGHT) {
        int32_t beside = step.cell;
        if (turned || IsInRegion(job, beside) != inside) {
            kiriField_MarkStepsDirty(field, cell);
            kiriField_MarkStepsDirty(field, beside);
        }
    }
}

/* Marks a cell with other steps. It also marks new cells beside it that the frame does not reach yet: only frames that
   reached them have touched them. */
static void MarkStepsAround(ShapeJob* job, int32_t cell)
{
    kiriShapeWork* work = job->work;
    kiriField_MarkStepsDirty(&work->fromSite, cell);
    kiriField_MarkStepsDirty(&work->fromBorder, cell);
    LoadAround(job, cell);
    KIRI_EACH_STEP(step, job->grid, cell, KIRI_KNIGHT) {
        int32_t beside = step.cell;
        if (work->fromSite.distance.data[beside] == KIRI_FAR && (work->marks.data[beside] & MARK_STEPS) != 0) {
            kiriField_MarkStepsDirty(&work->fromSite, beside);
        }
    }
}

/* Loads a changed cell, and marks the cells whose distances may differ. */
static void LoadTouched(ShapeJob* job, int32_t cell)
{
    enum { COST_OF_TOUCH = 2 };
    kiriShapeWork* work = job->work;
    uint8_t mark = work->marks.data[cell];
    LoadBlock(job, kiriReach_BlockOf(cell));
    work->debt += COST_OF_TOUCH;
    if ((mark & MARK_GONE) != 0) {
        kiriField_Forget(&work->fromSite, cell);
        kiriField_Forget(&work->fromBorder, cell);
        return;
    }
    if ((mark & MARK_STEPS) != 0) {
        MarkStepsAround(job, cell);
    }
    if ((mark & MARK_REGION) != 0) {
        MarkBorderSeedsDirty(job, cell);
    }
}

/* Follows another limit: cells beyond it lose their distance, or distances have to go on from those near the old
   one. */
static void LoadBeyond(ShapeJob* job, int32_t limit)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* reaches = &job->shape->reaches;
    int32_t old = work->frames.data[job->frame].limit, rim = limit > old ? old - KIRI_UNIT_KNIGHT : limit;
    for (int32_t b = reaches->ofFrame.data[job->frame]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
        const kiriReachBlock* block = &reaches->blocks.data[b];
        KIRI_TIMES(k, KIRI_BLOCK_CELLS) {
            int32_t cell = block->cells * KIRI_BLOCK_CELLS + k;
            if (block->fromSite[k] <= rim || block->fromSite[k] == KIRI_FAR ||
                (work->marks.data[cell] & MARK_GONE) != 0) {
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

/* Loads the changes for a frame whose site stays. Seeds of a site depend on the steps of its cell. */
static void LoadChanges(ShapeJob* job, int32_t limit)
{
    kiriShapeWork* work = job->work;
    const kiriShapeFrame* frame = &work->frames.data[job->frame];
    int32_t cell = job->sites[job->frame].cell;
    for (int32_t t = frame->firstTouch; t != KIRI_NONE; t = work->touches.data[t].next) {
        LoadTouched(job, work->touches.data[t].cell);
    }
    if (limit != frame->limit) {
        LoadBeyond(job, limit);
    }
    if ((work->marks.data[cell] & MARK_STEPS) != 0) {
        LoadAround(job, cell);
        KIRI_EACH_STEP(step, job->grid, cell, KIRI_KNIGHT) {
            kiriField_MarkStepsDirty(&work->fromSite, step.cell);
        }
    }
}

/* Starts the distances to the site. Where it has moved, no old distance is of use; but all blocks are loaded, because
   cells out of reach lose their weight. */
static bool StartFromSite(ShapeJob* job)
{
    kiriShapeWork* work = job->work;
    kiriShapeFrame* frame = &work->frames.data[job->frame];
    const kiriReaches* reaches = &job->shape->reaches;
    int64_t sides = frame->sides.count;
    while (sides > 1 && work->sideCounts.data[frame->sides.first + sides - 1] == 0) {
        --sides;
    }
    int32_t limit = sides < 1 ? KIRI_UNIT : (int32_t)kiriMin(sides * KIRI_UNIT, KIRI_FAR - 1);
    work->seeds.count = 0;
    if (!kiriSite_Seed(&job->sites[job->frame], KIRI_NONE, job->grid, &work->seeds)) {
        return false;
    }
    KIRI_EACH(const kiriSeed, seed, work->seeds) {
        work->marks.data[seed->cell] |= MARK_SEED;
        LoadBlock(job, kiriReach_BlockOf(seed->cell));
    }
    if (!frame->moved) {
        LoadChanges(job, limit);
        frame->limit = limit;
        return true;
    }
    frame->limit = limit;
    for (int32_t b = reaches->ofFrame.data[job->frame]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
        LoadBlock(job, reaches->blocks.data[b].cells);
    }
    return kiriField_Start(&work->fromSite, job->memory, work->seeds.data, work->seeds.count);
}

/* Starts the distances to the border. Where the distance to the site has changed, ways to the border may pass that did
   not, or no longer, and seeds may come or go. */
static bool StartFromBorder(ShapeJob* job)
{
    enum { MARKED_AN_ITEM = 4, SEEDED_AN_ITEM = 16 };
    kiriShapeWork* work = job->work;
    for (; work->fromSite.log.count > 0; --work->fromSite.log.count) {
        int32_t last = work->fromSite.log.count - 1;
        kiriSeed was = work->fromSite.log.data[last];
        int32_t is = work->fromSite.distance.data[was.cell];
        bool mayTurn = is != was.distance && (work->marks.data[was.cell] & MARK_REGION) != 0;
        work->debt += mayTurn || last % MARKED_AN_ITEM == 0;
        if ((is == KIRI_FAR) != (was.distance == KIRI_FAR) ||
            HasWeightAt(job, was.cell, is) != HasWeightAt(job, was.cell, was.distance)) {
            kiriField_MarkDirty(&work->fromBorder, was.cell);
        }
        if (mayTurn) {
            MarkBorderSeedsDirty(job, was.cell);
        }
    }
    if (!work->frames.data[job->frame].moved) {
        return true;
    }
    work->seeds.count = 0;
    work->debt += work->fromSite.settled.count / SEEDED_AN_ITEM;
    KIRI_EACH_LISTED(cell, work->fromSite.settled) {
        kiriSeed seed = BorderSeed(job, cell);
        if (seed.distance < KIRI_FAR && !kiriArray_Push(job->memory, &work->seeds, seed)) {
            return false;
        }
    }
    return kiriField_Start(&work->fromBorder, job->memory, work->seeds.data, work->seeds.count);
}

/* Floods or repairs a field. A flooded one is empty where no block is loaded. False: the quota is spent. */
static bool MeasureField(ShapeJob* job, kiriField* field, int32_t limit, kiriPassFn* pass, kiriSeedFn* seed)
{
    bool moved = job->work->frames.data[job->frame].moved;
    const kiriRule rule = { job->grid, limit, pass, seed, job, moved ? NULL : LoadAround };
    int32_t k = field->settled.count;
    kiriProgress progress =
        moved ? kiriField_Flood(field, &rule, job->quota) : kiriField_Repair(field, &rule, job->quota);
    for (; moved && k < field->settled.count; ++k) {
        LoadBlock(job, kiriReach_BlockOf(field->settled.data[k]));
    }
    job->outOfMemory = job->outOfMemory || progress == KIRI_FAILED;
    return progress != KIRI_MORE;
}

/* ---- Back into its blocks ---------------------------------------------------------------------------------------- */

/* Stores the distances of a block of cells and clears the fields there. Distances to the border one step beyond the
   last cell with a weight are dropped. The weights change for cells with other distances, and for cells that entered or
   left the frame's region. */
static void UnloadBlock(ShapeJob* job, kiriLoadedBlock loaded)
{
    enum { COST_OF_BLOCK = 2, CHANGED_AN_ITEM = 2 };
    kiriShapeWork* work = job->work;
    kiriReaches* reaches = &job->shape->reaches;
    int32_t first = loaded.cells * KIRI_BLOCK_CELLS, index = loaded.block, changed = 0;
    int32_t *fromSite = &work->fromSite.distance.data[first], *fromBorder = &work->fromBorder.distance.data[first];
    bool any = false;
    KIRI_TIMES(k, KIRI_BLOCK_CELLS) {
        any |= fromSite[k] != KIRI_FAR;
        fromBorder[k] = fromSite[k] != KIRI_FAR ? fromBorder[k] : KIRI_FAR;
    }
    if (any && index == KIRI_NONE) {
        index = kiriReaches_Add(reaches, job->frame, loaded.cells);
    }
    KIRI_TIMES_WHILE(index != KIRI_NONE, k, KIRI_BLOCK_CELLS) {
        kiriReachBlock* block = &reaches->blocks.data[index];
        uint8_t mark = work->marks.data[first + k];
        bool isOther = block->fromSite[k] != fromSite[k] || block->fromBorder[k] != fromBorder[k];
        bool turned = (mark & MARK_REGION) != 0 && (isOther || fromSite[k] != KIRI_FAR) &&
                      (work->wasOwner.data[first + k] == job->frame) != IsInRegion(job, first + k);
        changed += isOther;
        if ((isOther || turned) && (mark & MARK_GONE) == 0) {
            MarkDirty(job, first + k);
        }
        block->fromSite[k] = fromSite[k];
        block->fromBorder[k] = fromBorder[k];
    }
    KIRI_TIMES(k, KIRI_BLOCK_CELLS) {
        fromSite[k] = fromBorder[k] = KIRI_FAR;
        work->marks.data[first + k] &= (uint8_t) ~(MARK_SEED | MARK_SEEN);
    }
    if (!any && index != KIRI_NONE) {
        kiriReaches_Remove(reaches, index);
    }
    work->isLoaded.data[loaded.cells] = 0;
    work->debt += COST_OF_BLOCK + changed / CHANGED_AN_ITEM;
}

/* Brings the blocks up to date with the fields, and empties the fields. False for memory. */
static bool UnloadFrame(ShapeJob* job)
{
    kiriReaches* reaches = &job->shape->reaches;
    kiriShapeWork* work = job->work;
    int64_t blocks = (int64_t)reaches->blocks.count + work->loaded.count - reaches->freeBlocks;
    if (!kiriArrays_Reserve(job->memory, blocks, &reaches->blocks, &reaches->heads)) {
        return false;
    }
    for (; work->loaded.count > 0; --work->loaded.count) {
        UnloadBlock(job, work->loaded.data[work->loaded.count - 1]);
    }
    work->fromSite.settled.count = work->fromSite.log.count = 0;
    work->fromBorder.settled.count = work->fromBorder.log.count = 0;
    return true;
}

/* Measures a frame in three parts: distances to its site, then to its border; then they go back into its blocks. */
enum { MEASURE_SITE, MEASURE_BORDER, MEASURE_UNLOAD, MEASURE_PARTS };

static bool MeasureFrame(ShapeJob* job, int32_t item)
{
    kiriShapeWork* work = job->work;
    int32_t part = item % MEASURE_PARTS;
    bool starts = !work->isMeasuring, ok = true, isDone = true;
    job->frame = work->dirtyFrames.data[item / MEASURE_PARTS];
    if (part == MEASURE_SITE) {
        ok = !starts || StartFromSite(job);
        isDone = !ok || MeasureField(job, &work->fromSite, work->frames.data[job->frame].limit, NULL, SiteSeed);
    } else if (part == MEASURE_BORDER) {
        ok = !starts || StartFromBorder(job);
        isDone = !ok || MeasureField(job, &work->fromBorder, KIRI_FAR - 1, HasWeight, BorderSeed);
    } else {
        ok = UnloadFrame(job);
    }
    job->outOfMemory = job->outOfMemory || !ok;
    work->isMeasuring = !isDone;
    return isDone;
}

/* ---- The weights of a cell --------------------------------------------------------------------------------------- */

/* Lists the weights that the distances give a cell, in work->weights, by frame. */
static void ListWeights(const ShapeJob* job, int32_t cell)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* reaches = &job->shape->reaches;
    int32_t k = cell % KIRI_BLOCK_CELLS, owner = job->regions->field.owner.data[cell];
    double sum = 0.0;
    work->weights.count = 0;
    for (int32_t b = reaches->ofCells.data[kiriReach_BlockOf(cell)]; b != KIRI_NONE;
         b = reaches->heads.data[b].nextOfCells) {
        const kiriReachBlock* block = &reaches->blocks.data[b];
        int32_t frame = reaches->heads.data[b].frame, at = work->weights.count;
        double raw =
            block->fromSite[k] != KIRI_FAR ? RawWeight(frame == owner, block->fromSite[k], block->fromBorder[k]) : 0.0;
        if (raw > 0.0) {
            const kiriCellWeight weight = kiriCellWeight_Make(frame, raw);
            KIRI_ASSERT(at < work->weights.capacity);
            work->weights.count += 1;
            for (; at > 0 && work->weights.data[at - 1].frame > frame; --at) {
                work->weights.data[at] = work->weights.data[at - 1];
            }
            work->weights.data[at] = weight;
        }
    }
    KIRI_EACH(const kiriCellWeight, weight, work->weights) {
        sum += kiriCellWeight_Value(weight);
    }
    KIRI_EACH(kiriCellWeight, weight, work->weights) {
        *weight = kiriCellWeight_Make(weight->frame, kiriCellWeight_Value(weight) / sum);
    }
}

/* Gives a cell the weights that its distances give, and its share of the rigid sums. */
static bool WeighCell(ShapeJob* job, int32_t item)
{
    enum { WEIGHTS_AN_ITEM = 3 };
    kiriShape* shape = job->shape;
    kiriShapeWork* work = job->work;
    int32_t cell = work->dirty.data[item];
    kiriSpan* span = &shape->spans.data[cell];
    double area = kiriGrid_Area(job->grid, cell) / (job->grid->side * job->grid->side);
    int64_t share = (int64_t)(area * 1099511627776.0 + 0.5), was = work->rigidShares.data[cell];
    ListWeights(job, cell);
    int32_t count = work->weights.count;
    size_t bytes = sizeof(kiriCellWeight) * count;
    if (span->count != count ||
        (count > 0 && memcmp(&shape->weights.data[span->first], work->weights.data, bytes) != 0)) {
        AddRigid(job, cell, -was);
        was = 0;
        shape->recomputed += (work->marks.data[cell] & MARK_RECOMPUTED) == 0;
        work->marks.data[cell] |= MARK_RECOMPUTED;
        MarkChanged(job, cell);
        if (span->count != count && !kiriSpan_Resize(span, &shape->room, job->memory, &shape->weights,
                                                     sizeof(kiriCellWeight), count)) {
            job->outOfMemory = true;
            return true;
        }
        memcpy(&shape->weights.data[span->first], work->weights.data, bytes);
    }
    if (share != was) {
        AddRigid(job, cell, share - was);
    }
    work->rigidShares.data[cell] = share;
    work->marks.data[cell] &= (uint8_t)~MARK_DIRTY;
    work->debt += 1 + count / WEIGHTS_AN_ITEM;
    return true;
}

/* ---- The update -------------------------------------------------------------------------------------------------- */

/* Stages of algorithm 2, each over its items. An item returns false if the quota is spent before it is done. */
typedef bool ShapeStageFn(ShapeJob* job, int32_t item);
enum { SHAPE_STAGES = 8, CHANGE_STAGES = 6 };
static ShapeStageFn* const shapeStages[SHAPE_STAGES] = {
    MarkGone,     /* cells that changed, and the frames that reach them */
    MarkSteps,    /* the same */
    MarkMaterial, /* the same */
    MarkRegion,   /* the same */
    CountSteps,   /* how far distances have to go; when all is marked */
    CountRegion,  /* the same */
    MeasureFrame, /* distances to the site and to the border */
    WeighCell,    /* the weights that follow from them */
};

/* Makes room for all cells and frames. The fields, marks and blocks are read by whole blocks of cells. */
static bool ReserveShape(ShapeJob* job)
{
    kiriShape* shape = job->shape;
    kiriShapeWork* work = job->work;
    kiriMemory* memory = job->memory;
    int32_t cells = job->grid->cells.count, blocks = kiriReach_BlockOf(cells + KIRI_BLOCK_CELLS - 1);
    int32_t whole = blocks * KIRI_BLOCK_CELLS, c = shape->spans.count;
    if (!kiriReaches_Resize(&shape->reaches, memory, whole, job->siteCount) ||
        !kiriField_Resize(&work->fromSite, memory, whole, KIRI_FIELD_REPAIRS) ||
        !kiriField_Resize(&work->fromBorder, memory, whole, KIRI_FIELD_REPAIRS) ||
        !kiriArray_Reserve(memory, &work->marks, whole) ||
        !kiriArrays_Reserve(memory, blocks, &work->loaded, &work->isLoaded) ||
        !kiriArrays_Resize(memory, cells, &shape->spans, &work->wasOwner, &work->counted, &work->rigidShares) ||
        !kiriArrays_Reserve(memory, job->siteCount, &shape->rigid, &work->weights, &work->dirtyFrames, &work->frames)) {
        return false;
    }
    kiriArray_Extend(&work->marks, whole, 0);
    kiriArray_Extend(&work->isLoaded, blocks, 0);
    for (; c < cells; ++c) {
        shape->spans.data[c] = (kiriSpan){ 0 };
        work->counted.data[c] = (kiriCountedCell){ KIRI_NONE, 0 };
        work->rigidShares.data[c] = 0;
    }
    while (shape->rigid.count < job->siteCount) {
        KIRI_NEXT(shape->rigid) = 0;
        KIRI_NEXT(work->frames) = (kiriShapeFrame){ 0, { 0, 0 }, KIRI_NONE, false, false };
    }
    return true;
}

static bool StartShapeUpdate(ShapeJob* job, const kiriSiteMove* moves, int32_t moveCount)
{
    kiriShapeWork* work = job->work;
    if (!ReserveShape(job)) {
        return false;
    }
    KIRI_TIMES(k, moveCount) {
        MarkFrameDirty(job, moves[k].frame);
        work->frames.data[moves[k].frame].moved = true;
    }
    work->dirty.count = work->touches.count = 0;
    work->stage = work->item = 0;
    work->running = true;
    return true;
}

/* Clears the marks of this update, and takes cells that are gone out of the list of changes. */
static void EndShapeUpdate(ShapeJob* job)
{
    kiriShape* shape = job->shape;
    const kiriGridChanges* changes = &job->grid->changes;
    uint8_t* marks = job->work->marks.data;
    const uint8_t kept = (uint8_t) ~(MARK_STEPS | MARK_GONE | MARK_REGION);
    KIRI_EACH_LISTED(cell, changes->steps) {
        marks[cell] &= kept;
    }
    KIRI_EACH(const kiriSeed, change, job->regions->changes) {
        marks[change->cell] &= kept;
    }
    KIRI_KEEP_IF(const int32_t, at, shape->changes, (marks[*at] & MARK_GONE) == 0);
    KIRI_EACH_LISTED(at, changes->gone) {
        marks[at] = 0;
    }
    KIRI_EACH_LISTED(dirty, job->work->dirtyFrames) {
        kiriShapeFrame* frame = &job->work->frames.data[dirty];
        frame->firstTouch = KIRI_NONE;
        frame->moved = frame->dirty = false;
    }
    job->work->dirtyFrames.count = 0;
    job->work->running = false;
}

kiriProgress kiriShape_Update(kiriShape* shape, const kiriGrid* grid, const kiriRegions* regions, const kiriSite* sites,
                              int32_t siteCount, const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota)
{
    if (shape->work == NULL) {
        shape->work = kiriMemory_AllocZeroed(grid->mesh->memory, sizeof(*shape->work));
    }
    kiriShapeWork* work = shape->work;
    KIRI_ASSERT(!regions->running && regions->material.count == siteCount);
    ShapeJob job = { shape, work, grid->mesh->memory, grid, regions, sites, siteCount, quota, false, KIRI_NONE };
    if (work == NULL || (!work->running && !StartShapeUpdate(&job, moves, moveCount))) {
        return KIRI_FAILED;
    }
    for (; work->stage < SHAPE_STAGES; ++work->stage, work->item = 0) {
        const int32_t counts[SHAPE_STAGES] = { grid->changes.gone.count,
                                               grid->changes.steps.count,
                                               grid->changes.material.count,
                                               regions->changes.count,
                                               grid->changes.steps.count,
                                               regions->changes.count,
                                               MEASURE_PARTS * work->dirtyFrames.count,
                                               work->dirty.count };
        KIRI_ASSERT(work->item <= counts[work->stage]);
        for (; work->item < counts[work->stage]; ++work->item, work->debt += work->stage < CHANGE_STAGES) {
            bool isDone = !kiriMemory_MustPause(job.memory) && kiriQuota_Pay(quota, &work->debt) &&
                          shapeStages[work->stage](&job, work->item);
            if (job.outOfMemory || !isDone) {
                return job.outOfMemory ? KIRI_FAILED : KIRI_MORE;
            }
        }
    }
    if (!kiriQuota_Pay(quota, &work->debt)) {
        return KIRI_MORE;
    }
    EndShapeUpdate(&job);
    return KIRI_DONE;
}

void kiriShape_HashProgress(const kiriShape* shape, uint64_t* hash)
{
    if (shape->work != NULL && shape->work->running) {
        kiriHash_Int64(hash, shape->work->debt);
        kiriHash_Pair(hash, shape->work->stage, shape->work->item);
    }
}

void kiriShape_Keep(kiriShape* shape, kiriMemory* memory, const kiriKeep* frames, const int32_t* gone,
                    int32_t goneCount)
{
    kiriShapeWork* work = shape->work;
    KIRI_ASSERT(!work->running && shape->changes.count == 0);
    KIRI_TIMES(k, goneCount) {
        kiriSpan_Resize(&shape->spans.data[gone[k]], &shape->room, memory, &shape->weights, sizeof(kiriCellWeight), 0);
        work->rigidShares.data[gone[k]] = 0;
        work->counted.data[gone[k]] = (kiriCountedCell){ KIRI_NONE, 0 };
    }
    KIRI_FROM_TO(f, frames->first, frames->to.count) {
        if (!kiriKeep_Has(frames, f)) {
            kiriReaches_Forget(&shape->reaches, f);
            kiriSpan_Resize(&work->frames.data[f].sides, &work->sideRoom, memory, &work->sideCounts,
                            sizeof(*work->sideCounts.data), 0);
        }
    }
    kiriReaches_Keep(&shape->reaches, frames);
    KIRI_EACH_INDEX_WHILE(kiriKeep_Moves(frames), c, shape->spans) {
        kiriSpan span = shape->spans.data[c];
        KIRI_EACH_IN(k, span) {
            shape->weights.data[k].frame = kiriKeep_To(frames, shape->weights.data[k].frame);
            KIRI_ASSERT(shape->weights.data[k].frame != KIRI_NONE);
        }
        work->counted.data[c].frame = kiriKeep_To(frames, work->counted.data[c].frame);
    }
    kiriKeep_Compact(frames, &shape->rigid, 1, sizeof(int64_t));
    kiriKeep_Compact(frames, &work->frames, 1, sizeof(kiriShapeFrame));
}

void kiriShape_DropScratch(kiriShape* shape, kiriMemory* memory)
{
    KIRI_ASSERT(!shape->work->running && shape->changes.count == 0);
    kiriArray_Release(memory, &shape->changes);
    kiriArray_Release(memory, &shape->work->dirty);
    kiriArray_Release(memory, &shape->work->touches);
    kiriArray_Shorten(memory, &shape->weights, sizeof(*shape->weights.data));
    kiriArray_Shorten(memory, &shape->reaches.blocks, sizeof(*shape->reaches.blocks.data));
    kiriArray_Shorten(memory, &shape->reaches.heads, sizeof(*shape->reaches.heads.data));
}

void kiriShape_ClearChanges(kiriShape* shape)
{
    KIRI_ASSERT(shape->work == NULL || !shape->work->running);
    KIRI_EACH_LISTED(cell, shape->changes) {
        shape->work->marks.data[cell] &= (uint8_t) ~(MARK_CHANGED | MARK_RECOMPUTED);
    }
    shape->changes.count = 0;
    shape->recomputed = 0;
}

void kiriShape_Reset(kiriShape* shape)
{
    kiriShapeWork* work = shape->work;
    kiriReaches_Clear(&shape->reaches);
    shape->spans.count = shape->weights.count = shape->rigid.count = shape->changes.count = 0;
    KIRI_CLEAR(&shape->room);
    shape->recomputed = 0;
    if (work != NULL) {
        kiriField_Clear(&work->fromSite);
        kiriField_Clear(&work->fromBorder);
        work->marks.count = work->isLoaded.count = work->loaded.count = 0;
        work->frames.count = work->dirtyFrames.count = work->sideCounts.count = 0;
        KIRI_CLEAR(&work->sideRoom);
        work->running = work->isMeasuring = false;
        work->debt = 0;
    }
}
