#include "kiri_shape_work.h"

#include <string.h>

static bool IsInRegion(const kiriShapeJob* job, int32_t cell)
{
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

/* Loads a cell about which something has changed, and marks what may change in the fields. */
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

enum { UNLOAD_ROOMS = 3 };

/* For all that may come out of the fields. */
static void ListUnloadRooms(kiriShape* shape, kiriMemory* memory, kiriRoom rooms[UNLOAD_ROOMS])
{
    kiriShapeWork* work = shape->work;
    int64_t blocks = kiriReaches_RoomFor(&shape->reaches, work->loaded.count),
            weights = work->rawWeights.count + (int64_t)KIRI_BLOCK_CELLS * work->loaded.count;
    const kiriRoom all[UNLOAD_ROOMS] = { KIRI_ROOM(memory, &shape->reaches.blocks, blocks),
                                         KIRI_ROOM(memory, &shape->reaches.heads, blocks),
                                         KIRI_ROOM(memory, &work->rawWeights, weights) };
    memcpy(rooms, all, sizeof(all));
}

/* So that no tick moves all of it. */
static kiriProgress MakeRoomToUnload(kiriShapeJob* job, kiriQuota* quota)
{
    enum { MOVED_BYTES = 128 }; /* for an item: most are the first in their page */
    kiriRoom rooms[UNLOAD_ROOMS];
    ListUnloadRooms(job->shape, job->memory, rooms);
    return kiriGrowing_GoOn(&job->work->growing, rooms, UNLOAD_ROOMS, quota, MOVED_BYTES);
}

void kiriShape_ArchiveGrowing(kiriArchive* archive, kiriShape* shape, kiriMemory* memory)
{
    kiriRoom rooms[UNLOAD_ROOMS];
    if (shape->work != NULL) {
        ListUnloadRooms(shape, memory, rooms);
        kiriArchive_Growing(archive, &shape->work->growing, rooms, UNLOAD_ROOMS);
        kiriArchive_Expect(archive, shape->work->growing.data == NULL || shape->work->frameStage == KIRI_FRAME_UNLOAD);
    }
}

/* Brings the blocks up to date with the fields, and empties these. */
static kiriProgress UnloadFrame(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    kiriProgress progress = MakeRoomToUnload(job, quota);
    if (progress != KIRI_DONE) {
        return progress;
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

kiriProgress kiriShapeJob_MeasureFrame(kiriShapeJob* job, kiriQuota* quota)
{
    kiriProgress progress = KIRI_DONE;
    do {
        bool isPaid = kiriQuota_Pay(quota, &job->work->due);
        progress = isPaid ? frameStages[job->work->frameStage](job, quota) : KIRI_MORE;
    } while (progress == KIRI_DONE && job->work->frameStage != KIRI_FRAME_REST);
    return progress;
}
