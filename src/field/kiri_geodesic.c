#include "kiri_geodesic.h"

/* Marks of cells while a field is repaired. */
enum {
    FIELD_DIRTY = 1,   /* in `dirty`, not checked yet */
    FIELD_LOGGED = 2,  /* in `log` */
    FIELD_LISTED = 4,  /* in the list of its bucket, or settled */
    FIELD_PASSES = 8,  /* whether ways pass through it may have changed; set by the caller */
};

/* Stages of a repair. */
enum { REPAIR_NONE, REPAIR_CLEARS, REPAIR_SEEDS, REPAIR_SETTLES };

/* ---- Room of a field --------------------------------------------------------------------------------------------- */

bool kiriField_Resize(kiriField* field, kiriMemory* memory, int32_t cellCount, int uses)
{
    int32_t owned = (uses & KIRI_FIELD_OWNERS) != 0 ? cellCount : 0;
    int32_t marked = (uses & KIRI_FIELD_REPAIRS) != 0 ? cellCount : 0;
    if (!kiriArray_Reserve(memory, &field->distance, cellCount) || !kiriArray_Reserve(memory, &field->owner, owned) ||
        !kiriArrays_Reserve(memory, marked, &field->dirty, &field->marks)) {
        return false;
    }
    int32_t c = field->distance.count;
    field->distance.count = cellCount;
    field->owner.count = owned;
    for (field->marks.count = marked; c < cellCount; ++c) {
        kiriField_Forget(field, c);
        if (c < marked) {
            field->marks.data[c] = 0;
        }
    }
    return true;
}

void kiriField_Reset(kiriField* field)
{
    KIRI_ASSERT(field->stage == REPAIR_NONE);
    KIRI_FROM_TO(k, -1, KIRI_RING) {
        kiriIndices* list = k < 0 ? &field->settled : &field->ring[k];
        KIRI_EACH_LISTED(cell, *list) {
            kiriField_Forget(field, cell);
        }
        list->count = 0;
    }
}

void kiriField_Clear(kiriField* field)
{
    field->distance.count = field->owner.count = field->marks.count = 0;
    field->settled.count = field->log.count = field->seeds.count = field->dirty.count = 0;
    field->ring[0].count = field->ring[1].count = field->ring[2].count = field->ring[3].count = 0;
    field->stage = REPAIR_NONE;
}

/* ---- Steps to some values ---------------------------------------------------------------------------------------- */

enum { BELOW = -1, EQUAL, ABOVE };

/* Returns the steps of a cell that may lead to values below, equal to, or above `than` plus `sign` times their length:
   a bit each, in their order. Cells that are not open have all bits. */
static inline int32_t HitsAt(const kiriField* field, const kiriGrid* grid, int32_t cell, int which, int32_t than,
                             int32_t sign)
{
    if (!kiriGrid_IsOpen(grid, cell)) {
        return -1;
    }
    const ptrdiff_t row = grid->openSteps[3].cell;
    const int32_t *has = field->distance.data + cell, *up = has - row, *down = has + row;
    const int32_t to[KIRI_OPEN_STEPS] = { up[0],    has[-1],      has[1],       down[0], up[-1],   up[1],   down[-1],
                                          down[1],  up[-1 - row], up[1 - row],  up[-2],  up[2],    down[-2], down[2],
                                          down[row - 1], down[row + 1] };
    const int32_t limits[3] = { than + sign * KIRI_UNIT, than + sign * KIRI_UNIT_DIAGONAL,
                                than + sign * KIRI_UNIT_KNIGHT };
    uint32_t hits = 0;
    for (int k = KIRI_OPEN_STEPS - 1; k >= 0; --k) {
        int32_t limit = limits[k < 4 ? 0 : k < 8 ? 1 : 2];
        hits += hits + (which == BELOW ? to[k] < limit : which == EQUAL ? to[k] == limit : to[k] > limit);
    }
    return (int32_t)hits;
}

/* Goes on to the next step that `hits` names, and shifts it. A negative number names all. */
static inline bool NextHit(kiriStepWalk* walk, int32_t* hits)
{
    if (*hits >= 0) {
        if (*hits == 0) {
            return false;
        }
        int32_t skipped = kiriLowestBit((uint32_t)*hits);
        walk->next += skipped;
        *hits >>= skipped + 1;
    }
    return kiriStepWalk_Next(walk);
}

#define EACH_HIT(step, grid, cell, hits)                                                                               \
    for (kiriStepWalk step = kiriGrid_Walk(grid, cell, KIRI_KNIGHT); NextHit(&step, &(hits));)

/* ---- The sweep: Dijkstra in buckets ------------------------------------------------------------------------------ */

/* A bucket has the cells of KIRI_UNIT distances. No step is shorter, so no cell of a bucket makes another one nearer,
   and their order is free. Steps lead three buckets on at most: a ring of lists. A list may name cells that came into
   an earlier bucket since then, and are settled. */

static inline int32_t BucketOf(int32_t distance)
{
    KIRI_ASSERT(distance >= 0);
    return (int32_t)((uint32_t)distance / KIRI_UNIT);
}

static void StartSweep(kiriField* field)
{
    field->bucket = -1;
    field->nearest = KIRI_FAR;
    KIRI_EACH(const kiriSeed, seed, field->seeds) {
        field->nearest = kiriMin(seed->distance, field->nearest);
    }
}

static bool IsNearerSeed(kiriSeed a, kiriSeed b)
{
    return a.distance != b.distance ? a.distance < b.distance : a.owner < b.owner;
}

static inline kiriSeed ValueOf(const kiriField* field, int32_t cell)
{
    KIRI_ASSERT_HAS(field->distance, cell);
    return (kiriSeed){ cell, field->distance.data[cell], field->owner.count > 0 ? field->owner.data[cell] : KIRI_NONE };
}

static inline void SetValue(kiriField* field, kiriSeed to)
{
    field->distance.data[to.cell] = to.distance;
    if (field->owner.count > 0) {
        field->owner.data[to.cell] = to.owner;
    }
}

/* Logs the value of a cell before it changes. False for memory. */
static bool LogValue(kiriField* field, kiriMemory* memory, int32_t cell)
{
    KIRI_ASSERT_HAS(field->marks, cell);
    bool isLogged = (field->marks.data[cell] & FIELD_LOGGED) != 0;
    field->marks.data[cell] |= FIELD_LOGGED;
    return isLogged || kiriArray_Push(memory, &field->log, ValueOf(field, cell));
}

/* Gives a cell a value, and lists it for its bucket, unless it is listed there. In a repair it may have a value that no
   list has, even this one. False for memory. */
static inline bool GiveValue(kiriField* field, kiriMemory* memory, kiriSeed to, bool repairs)
{
    int32_t bucket = BucketOf(to.distance);
    bool isListed = BucketOf(field->distance.data[to.cell]) == bucket;
    if (repairs) {
        if (IsNearerSeed(to, ValueOf(field, to.cell)) && !LogValue(field, memory, to.cell)) {
            return false;
        }
        isListed = isListed && (field->marks.data[to.cell] & FIELD_LISTED) != 0;
        field->marks.data[to.cell] |= FIELD_LISTED;
    }
    if (!isListed && !kiriArray_Push(memory, &field->ring[bucket % KIRI_RING], to.cell)) {
        return false;
    }
    SetValue(field, to);
    return true;
}

static inline bool Passes(const kiriRule* rule, int32_t cell)
{
    return rule->pass == NULL || rule->pass(rule->context, cell);
}

/* Goes on to the next bucket that has cells or seeds, and takes the seeds of all buckets of the ring. KIRI_DONE: there
   is none. */
static kiriProgress OpenBucket(kiriField* field, const kiriRule* rule, bool repairs)
{
    int32_t ahead = 1, count = field->seeds.count, first = BucketOf(field->nearest);
    while (ahead < KIRI_RING && field->ring[(field->bucket + ahead) % KIRI_RING].count == 0) {
        ++ahead;
    }
    if (field->nearest == KIRI_FAR && ahead == KIRI_RING) {
        return KIRI_DONE;
    }
    field->bucket = kiriMin(field->bucket + ahead, first);
    if (first > field->bucket) {
        return KIRI_MORE;
    }
    field->nearest = KIRI_FAR;
    field->seeds.count = 0;
    KIRI_TIMES(i, count) {
        kiriSeed seed = field->seeds.data[i], value = ValueOf(field, seed.cell);
        /* In a repair a cell that has the very value of the seed is dirty itself: it passes its value on. */
        if (BucketOf(seed.distance) >= field->bucket + KIRI_RING) {
            KIRI_NEXT(field->seeds) = seed;
            field->nearest = kiriMin(seed.distance, field->nearest);
        } else if (seed.distance <= rule->limit && !IsNearerSeed(value, seed) &&
                   !GiveValue(field, rule->grid->mesh->memory, seed, repairs)) {
            return KIRI_FAILED;
        }
    }
    return KIRI_MORE;
}

/* Takes the steps from a cell, as far as `room`. False for memory. */
static inline bool TakeGridSteps(kiriField* field, const kiriGrid* grid, kiriSeed from, int32_t room, bool repairs)
{
    const int32_t passed = from.distance - (from.owner != KIRI_NONE); /* a lower owner wins where both are as far */
    int32_t hits = room < KIRI_UNIT_KNIGHT ? -1 : HitsAt(field, grid, from.cell, ABOVE, passed, 1);
    EACH_HIT(step, grid, from.cell, hits) {
        kiriSeed to = { step.cell, from.distance + step.length, from.owner };
        bool isNearer = step.length <= room && IsNearerSeed(to, ValueOf(field, to.cell));
        if (isNearer && !GiveValue(field, grid->mesh->memory, to, repairs)) {
            return false;
        }
    }
    return true;
}

/* Settles cells until none is left, or the quota is spent on them. In a repair a cell may have values on all sides, and
   its previous value is logged: it counts twice. */
static inline kiriProgress Sweep(kiriField* field, const kiriRule* rule, kiriQuota* quota, bool repairs)
{
    int32_t before = field->settled.count, items = repairs ? 2 : 1;
    int64_t fit = quota->left / items, most = INT64_MAX;
    kiriProgress progress = KIRI_MORE;
    if (quota->left < INT32_MAX) {
        most = before + (fit > 0 || kiriQuota_IsBegun(quota) ? fit : 1);
    }
    while (progress == KIRI_MORE && field->settled.count < most) {
        kiriIndices* list = &field->ring[field->bucket & (KIRI_RING - 1)];
        if (list->count == 0) {
            progress = OpenBucket(field, rule, repairs);
            continue;
        }
        if (!kiriArray_ReserveMore(rule->grid->mesh->memory, &field->settled, 1)) {
            return KIRI_FAILED;
        }
        kiriSeed value = ValueOf(field, list->data[--list->count]);
        if (BucketOf(value.distance) != field->bucket) {
            continue;
        }
        KIRI_NEXT(field->settled) = value.cell;
        if (Passes(rule, value.cell)) {
            if (rule->look != NULL) {
                rule->look(rule->context, value.cell);
            }
            bool ok = TakeGridSteps(field, rule->grid, value, rule->limit - value.distance, repairs);
            progress = ok ? KIRI_MORE : KIRI_FAILED;
        }
    }
    int64_t done = (int64_t)items * (field->settled.count - before), counted = kiriMin(done, quota->left);
    if (done == counted || !kiriQuota_IsBegun(quota)) { /* more than the whole quota is charged as the quota */
        quota->beyond += done - counted;
        kiriQuota_Take(quota, counted);
    }
    return progress;
}

bool kiriField_Start(kiriField* field, kiriMemory* memory, const kiriSeed* seeds, int32_t seedCount)
{
    KIRI_ASSERT(field->settled.count == 0 && field->dirty.count == 0 && field->stage == REPAIR_NONE);
    if (!kiriArray_Resize(memory, &field->seeds, seedCount)) {
        return false;
    }
    KIRI_TIMES(i, seedCount) {
        KIRI_ASSERT(seeds[i].cell >= 0 && seeds[i].cell < field->distance.count && seeds[i].distance >= 0);
        field->seeds.data[i] = seeds[i];
    }
    StartSweep(field);
    return true;
}

kiriProgress kiriField_Flood(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    KIRI_ASSERT(field->stage == REPAIR_NONE && rule->limit < KIRI_FAR);
    return Sweep(field, rule, quota, false);
}

/* ---- Repairs (Ramalingam and Reps 1996) -------------------------------------------------------------------------- */

void kiriField_MarkStepsDirty(kiriField* field, int32_t cell)
{
    KIRI_ASSERT_HAS(field->marks, cell);
    if ((field->marks.data[cell] & FIELD_DIRTY) == 0) {
        field->settled.count = 0; /* of a flood */
        field->marks.data[cell] |= FIELD_DIRTY;
        KIRI_NEXT(field->dirty) = cell;
    }
}

void kiriField_MarkDirty(kiriField* field, int32_t cell)
{
    kiriField_MarkStepsDirty(field, cell);
    field->marks.data[cell] |= FIELD_PASSES;
}

void kiriField_Forget(kiriField* field, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->distance.capacity); /* the field may have had more cells */
    SetValue(field, (kiriSeed){ cell, KIRI_FAR, KIRI_NONE });
}

/* Returns true if its seed or a neighbour still gives the cell its value. Every step is longer than nothing, so the cells of
   a ring cannot support each other. Lists the cells that may have their value from this one, in dirty.data from dirty.count
   to `end`, which has room for all steps of the cell. */
static bool IsSupported(const kiriField* field, const kiriRule* rule, int32_t cell, int32_t* end)
{
    const kiriSeed value = ValueOf(field, cell);
    bool isSupported = false;
    int32_t hits = HitsAt(field, rule->grid, cell, EQUAL, value.distance, -1) |
                   HitsAt(field, rule->grid, cell, EQUAL, value.distance, 1);
    *end = field->dirty.count;
    EACH_HIT(step, rule->grid, cell, hits) {
        int32_t next = step.cell, way = field->distance.data[next] - value.distance;
        if (way == step.length && (field->marks.data[next] & FIELD_DIRTY) == 0 && ValueOf(field, next).owner == value.owner) {
            field->dirty.data[(*end)++] = next;
        }
        isSupported = isSupported || (way == -step.length && ValueOf(field, next).owner == value.owner && Passes(rule, next));
    }
    kiriSeed seed = rule->seed(rule->context, cell);
    return value.distance <= rule->limit && (isSupported || (seed.distance == value.distance && seed.owner == value.owner));
}

/* Clears the affected cells: those whose value nothing supports any more. The other values are lengths of ways that
   still exist, if not the shortest. A cell that ways do not pass (any longer) keeps its own value, but its dependents
   may lose theirs. */
static kiriProgress ClearAffected(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    for (; field->checked < field->dirty.count; ++field->checked) {
        int32_t cell = field->dirty.data[field->checked];
        if (field->distance.data[cell] != KIRI_FAR) {
            bool blocked = (field->marks.data[cell] & FIELD_PASSES) != 0 && !Passes(rule, cell);
            if (rule->look != NULL) {
                rule->look(rule->context, cell);
            }
            int32_t steps = kiriGrid_GetSteps(rule->grid, cell).end[KIRI_KNIGHT], end;
            if (!kiriArray_ReserveMore(rule->grid->mesh->memory, &field->dirty, steps)) {
                return KIRI_FAILED;
            }
            bool supported = IsSupported(field, rule, cell, &end);
            if (!kiriQuota_Take(quota, !supported || field->checked % 4 == 0)) {
                return KIRI_MORE;
            }
            if (!supported && !LogValue(field, rule->grid->mesh->memory, cell)) {
                return KIRI_FAILED;
            }
            while ((!supported || blocked) && field->dirty.count < end) {
                field->marks.data[KIRI_NEXT(field->dirty)] |= FIELD_DIRTY;
            }
            if (!supported) {
                kiriField_Forget(field, cell);
            }
        }
        field->marks.data[cell] &= (uint8_t)~FIELD_DIRTY;
    }
    return KIRI_DONE;
}

/* Returns the nearest value that seed and neighbours give the cell, or its own. */
static kiriSeed NearestFor(const kiriField* field, const kiriRule* rule, int32_t cell)
{
    kiriSeed best = rule->seed(rule->context, cell), value = ValueOf(field, cell);
    best = best.distance <= rule->limit && IsNearerSeed(best, value) ? best : value;
    int32_t hits = HitsAt(field, rule->grid, cell, BELOW, kiriMin(best.distance, rule->limit) + 1, -1);
    EACH_HIT(step, rule->grid, cell, hits) {
        int32_t distance = field->distance.data[step.cell];
        if (distance <= kiriMin(best.distance, rule->limit) - step.length) {
            kiriSeed over = { cell, distance + step.length, ValueOf(field, step.cell).owner };
            best = IsNearerSeed(over, best) && Passes(rule, step.cell) ? over : best;
        }
    }
    return best;
}

/* Finds the seeds of the sweep. A cell that has lost its value gets the nearest one. One of the caller's that kept its
   own may get a nearer one, over a new step or from its seed; and where ways pass that did not, they go on from it with
   its own value. Cells that its new steps lead to are dirty too. */
static kiriProgress SeedSweep(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    for (; field->checked < field->dirty.count; ++field->checked) {
        int32_t cell = field->dirty.data[field->checked];
        bool seeds = field->checked < field->fromCaller || field->distance.data[cell] == KIRI_FAR;
        if (!kiriQuota_Take(quota, seeds || field->checked % 4 == 0)) {
            return KIRI_MORE;
        }
        if (seeds) {
            if (rule->look != NULL && field->checked < field->fromCaller) { /* ClearAffected looked at the others */
                rule->look(rule->context, cell);
            }
            kiriSeed best = NearestFor(field, rule, cell);
            bool passes = (field->marks.data[cell] & FIELD_PASSES) != 0;
            if (best.distance != KIRI_FAR && (passes || IsNearerSeed(best, ValueOf(field, cell)))) {
                KIRI_NEXT(field->seeds) = best;
            }
            field->marks.data[cell] &= (uint8_t)~FIELD_PASSES;
        }
    }
    return KIRI_DONE;
}

kiriProgress kiriField_Repair(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    KIRI_ASSERT(rule->limit < KIRI_FAR && rule->seed != NULL);
    kiriProgress progress = KIRI_DONE;
    if (field->stage == REPAIR_NONE) {
        KIRI_EACH(const kiriSeed, logged, field->log) {
            field->marks.data[logged->cell] |= FIELD_LOGGED;
        }
        field->checked = 0;
        field->fromCaller = field->dirty.count;
        field->stage = REPAIR_CLEARS;
    }
    if (field->stage == REPAIR_CLEARS) {
        progress = ClearAffected(field, rule, quota);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (!kiriArray_Reserve(rule->grid->mesh->memory, &field->seeds, field->dirty.count)) {
            return KIRI_FAILED;
        }
        field->seeds.count = field->checked = 0;
        field->stage = REPAIR_SEEDS;
    }
    if (field->stage == REPAIR_SEEDS) {
        progress = SeedSweep(field, rule, quota);
        if (progress != KIRI_DONE) {
            return progress;
        }
        field->dirty.count = field->settled.count = 0;
        StartSweep(field);
        field->stage = REPAIR_SETTLES;
    }
    progress = Sweep(field, rule, quota, true);
    if (progress == KIRI_DONE) {
        KIRI_EACH(const kiriSeed, logged, field->log) {
            field->marks.data[logged->cell] = 0;
        }
        KIRI_EACH_LISTED(cell, field->settled) {
            field->marks.data[cell] = 0;
        }
        field->settled.count = 0;
        field->stage = REPAIR_NONE;
    }
    return progress;
}

/* ---- Distances of frames, in blocks ------------------------------------------------------------------------------ */

bool kiriReaches_Resize(kiriReaches* reaches, kiriMemory* memory, int32_t cellCount, int32_t frameCount)
{
    int32_t blocks = kiriReach_BlockOf(cellCount + KIRI_BLOCK_CELLS - 1);
    if (!kiriArray_Reserve(memory, &reaches->ofCells, blocks) ||
        !kiriArray_Reserve(memory, &reaches->ofFrame, frameCount)) {
        return false;
    }
    kiriArray_Extend(&reaches->ofCells, blocks, KIRI_NONE);
    kiriArray_Extend(&reaches->ofFrame, frameCount, KIRI_NONE);
    return true;
}

void kiriReaches_Clear(kiriReaches* reaches)
{
    reaches->blocks.count = reaches->heads.count = reaches->ofCells.count = reaches->ofFrame.count =
        reaches->freeBlocks = 0;
}

int32_t kiriReaches_Find(const kiriReaches* reaches, int32_t frame, int32_t cells)
{
    KIRI_ASSERT_HAS(reaches->ofCells, cells);
    int32_t block = reaches->ofCells.data[cells];
    while (block != KIRI_NONE && reaches->heads.data[block].frame != frame) {
        block = reaches->heads.data[block].nextOfCells;
    }
    return block;
}

int32_t kiriReaches_Add(kiriReaches* reaches, int32_t frame, int32_t cells)
{
    KIRI_ASSERT(frame >= 0 && frame < reaches->ofFrame.count && cells >= 0 && cells < reaches->ofCells.count);
    int32_t index = reaches->freeBlock, next = reaches->ofFrame.data[frame];
    if (reaches->freeBlocks > 0) {
        reaches->freeBlock = reaches->blocks.data[index].nextOfFrame;
        reaches->freeBlocks -= 1;
    } else {
        KIRI_ASSERT(reaches->blocks.count < reaches->blocks.capacity &&
                    reaches->blocks.count < reaches->heads.capacity);
        index = reaches->blocks.count++;
        reaches->heads.count += 1;
    }
    kiriReachBlock* block = &reaches->blocks.data[index];
    reaches->heads.data[index] = (kiriReachHead){ frame, reaches->ofCells.data[cells] };
    block->cells = cells;
    block->nextOfFrame = next;
    block->previousOfFrame = KIRI_NONE;
    KIRI_TIMES(k, KIRI_BLOCK_CELLS) {
        block->fromSite[k] = block->fromBorder[k] = KIRI_FAR;
    }
    if (next != KIRI_NONE) {
        reaches->blocks.data[next].previousOfFrame = index;
    }
    reaches->ofCells.data[cells] = reaches->ofFrame.data[frame] = index;
    return index;
}

void kiriReaches_Remove(kiriReaches* reaches, int32_t index)
{
    KIRI_ASSERT_HAS(reaches->heads, index);
    kiriReachBlock *blocks = reaches->blocks.data, *block = &blocks[index];
    kiriReachHead* head = &reaches->heads.data[index];
    int32_t* link = &reaches->ofCells.data[block->cells];
    while (*link != index) {
        link = &reaches->heads.data[*link].nextOfCells;
    }
    *link = head->nextOfCells;
    if (block->nextOfFrame != KIRI_NONE) {
        blocks[block->nextOfFrame].previousOfFrame = block->previousOfFrame;
    }
    if (block->previousOfFrame != KIRI_NONE) {
        blocks[block->previousOfFrame].nextOfFrame = block->nextOfFrame;
    } else {
        reaches->ofFrame.data[head->frame] = block->nextOfFrame;
    }
    head->frame = KIRI_NONE;
    block->nextOfFrame = reaches->freeBlock;
    reaches->freeBlock = index;
    reaches->freeBlocks += 1;
}

void kiriReaches_Forget(kiriReaches* reaches, int32_t frame)
{
    KIRI_ASSERT_HAS(reaches->ofFrame, frame);
    while (reaches->ofFrame.data[frame] != KIRI_NONE) {
        kiriReaches_Remove(reaches, reaches->ofFrame.data[frame]);
    }
}

void kiriReaches_Keep(kiriReaches* reaches, const kiriKeep* frames)
{
    KIRI_FROM_TO(frame, frames->first, reaches->ofFrame.count) {
        int32_t to = kiriKeep_To(frames, frame);
        KIRI_ASSERT(to != KIRI_NONE || reaches->ofFrame.data[frame] == KIRI_NONE);
        for (int32_t b = reaches->ofFrame.data[frame]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
            reaches->heads.data[b].frame = to;
        }
    }
    kiriKeep_Compact(frames, &reaches->ofFrame, 1, sizeof(int32_t));
}
