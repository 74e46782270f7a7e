#include "kiri_geodesic.h"

static const int32_t stepLengths[KIRI_STEP_LENGTHS] = { KIRI_UNIT, KIRI_UNIT_DIAGONAL, KIRI_UNIT_KNIGHT };

/* Marks of cells while a field is repaired. */
enum {
    FIELD_DIRTY = 1,   /* in `dirty`, not checked yet */
    FIELD_LOGGED = 2,  /* in `log` */
    FIELD_SETTLED = 4, /* in `settled` */
    FIELD_PASSES = 8,  /* whether ways pass through it may have changed; set by the caller */
};

/* Stages of a repair. */
enum { REPAIR_NONE, REPAIR_CLEARS, REPAIR_SEEDS, REPAIR_SETTLES };

/* ---- Room of a field --------------------------------------------------------------------------------------------- */

bool kiriField_Resize(kiriField* field, kiriMemory* memory, int32_t cellCount)
{
    kiriIndices* longer = field->settled.capacity < field->dirty.capacity ? &field->dirty : &field->settled;
    if (!kiriArray_Reserve(memory, &field->distance, cellCount) ||
        !kiriArray_Reserve(memory, &field->owner, cellCount) || !kiriArray_Reserve(memory, longer, cellCount) ||
        !kiriArray_Reserve(memory, &field->marks, cellCount)) {
        return false;
    }
    for (int32_t c = field->distance.count; c < cellCount; ++c) {
        field->distance.data[c] = KIRI_FAR;
        field->owner.data[c] = KIRI_NONE;
        field->marks.data[c] = 0;
    }
    field->distance.count = field->owner.count = field->marks.count = cellCount;
    return true;
}

/* Makes a list the long one, before cells are put into it, and when the other one is empty. */
static void MakeLong(kiriField* field, kiriIndices* list)
{
    if (list->capacity < field->distance.count) {
        kiriIndices settled = field->settled;
        KIRI_ASSERT(field->settled.count == 0 && field->dirty.count == 0);
        field->settled = field->dirty;
        field->dirty = settled;
    }
}

void kiriField_Reset(kiriField* field)
{
    KIRI_ASSERT(field->stage == REPAIR_NONE);
    for (int32_t i = 0; i < field->settled.count; ++i) {
        kiriField_Forget(field, field->settled.data[i]);
    }
    field->settled.count = 0;
}

void kiriField_Clear(kiriField* field)
{
    field->distance.count = field->owner.count = field->marks.count = 0;
    field->settled.count = field->log.count = field->heap.count = field->dirty.count = 0;
    field->stage = REPAIR_NONE;
}

/* ---- The heap of seeds, nearest on top --------------------------------------------------------------------------- */

static bool IsNearerSeed(kiriSeed a, kiriSeed b)
{
    return a.distance != b.distance ? a.distance < b.distance : a.owner < b.owner;
}

/* Restores the heap below a place that may hold too far a seed. */
static void SinkSeed(kiriField* field, int32_t i)
{
    KIRI_ASSERT(i >= 0 && i < field->heap.count);
    kiriSeed* seeds = field->heap.data;
    kiriSeed sinking = seeds[i];
    for (int32_t child = 2 * i + 1; child < field->heap.count; child = 2 * i + 1) {
        if (child + 1 < field->heap.count && IsNearerSeed(seeds[child + 1], seeds[child])) {
            ++child;
        }
        if (!IsNearerSeed(seeds[child], sinking)) {
            break;
        }
        seeds[i] = seeds[child];
        i = child;
    }
    seeds[i] = sinking;
}

static kiriSeed PopSeed(kiriField* field)
{
    KIRI_ASSERT(field->heap.count > 0);
    kiriSeed top = field->heap.data[0];
    field->heap.data[0] = field->heap.data[--field->heap.count];
    if (field->heap.count > 0) {
        SinkSeed(field, 0);
    }
    return top;
}

/* ---- The sweep: Dijkstra without a queue ------------------------------------------------------------------------- */

/* There are only three lengths of steps, and cells settle by growing distance. So the cells that steps of one length
   reach are sorted already: a cursor for each length over the settled cells finds the next. */

static void StartSweep(kiriField* field)
{
    for (int32_t i = field->heap.count / 2; i-- > 0;) {
        SinkSeed(field, i);
    }
    MakeLong(field, &field->settled);
    field->cursor[0] = field->cursor[1] = field->cursor[2] = 0;
}

static inline kiriSeed ValueOf(const kiriField* field, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->distance.count);
    return (kiriSeed){ cell, field->distance.data[cell], field->owner.data[cell] };
}

/* Logs the value of a cell before it changes. The caller has reserved room. */
static void LogValue(kiriField* field, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->marks.count);
    if ((field->marks.data[cell] & FIELD_LOGGED) == 0) {
        KIRI_ASSERT(field->log.count < field->log.capacity);
        field->marks.data[cell] |= FIELD_LOGGED;
        field->log.data[field->log.count++] = ValueOf(field, cell);
    }
}

/* Gives a cell a value and settles it. A flood does so once: the first to reach a cell is the nearest, and only its
   owner may still become a lower one as long as the sweep is at this distance. Every step is longer than nothing, so
   the cell passes it on later. In a repair a cell may have a value already, even this one. */
static inline void SettleCell(kiriField* field, kiriSeed to, bool repairs)
{
    bool isNew = field->distance.data[to.cell] == KIRI_FAR;
    if (repairs) {
        if (IsNearerSeed(to, ValueOf(field, to.cell))) {
            LogValue(field, to.cell);
        }
        isNew = (field->marks.data[to.cell] & FIELD_SETTLED) == 0;
        field->marks.data[to.cell] |= FIELD_SETTLED;
    }
    field->distance.data[to.cell] = to.distance;
    field->owner.data[to.cell] = to.owner;
    if (isNew) {
        KIRI_ASSERT(field->settled.count < field->settled.capacity);
        field->settled.data[field->settled.count++] = to.cell;
    }
}

static int32_t FarthestOf(const kiriRule* rule)
{
    return kiriMin(rule->limit, KIRI_FAR - 1);
}

static inline bool Passes(const kiriRule* rule, int32_t cell)
{
    return rule->pass == NULL || rule->pass(rule->context, cell);
}

static void LookAround(const kiriRule* rule, int32_t cell)
{
    if (rule->look != NULL) {
        rule->look(rule->context, cell);
    }
}

/* The distance of the next cells that steps of one length reach; FAR_BEYOND where they reach no more so far. */
static const int64_t FAR_BEYOND = INT64_MAX;

static inline int64_t NextDistance(const kiriField* field, int length)
{
    int32_t cursor = field->cursor[length];
    return cursor < field->settled.count
               ? (int64_t)field->distance.data[field->settled.data[cursor]] + stepLengths[length]
               : FAR_BEYOND;
}

enum { FROM_SEED = KIRI_STEP_LENGTHS, FROM_NOWHERE };

/* Finds where the sweep goes on: with which length of steps, and at which distance, no farther than `limit`. */
static inline int NearestSource(const kiriField* field, const int64_t* next, int32_t limit, int32_t* distance)
{
    int source = FROM_NOWHERE;
    int64_t least = limit;
    for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
        source = next[k] <= least ? k : source;
        least = next[k] <= least ? next[k] : least;
    }
    if (field->heap.count > 0 && field->heap.data[0].distance <= least) {
        least = field->heap.data[0].distance;
        source = FROM_SEED;
    }
    *distance = (int32_t)least;
    return source;
}

/* Takes the steps of one length from a cell. False where `most` cells are settled before all are taken: they are all
   taken again later, which changes nothing. */
static inline bool TakeStepsFrom(kiriField* field, const kiriRule* rule, int32_t from, int length, int32_t distance,
                                 int64_t most, bool repairs)
{
    static const int32_t openEnds[] = { 0, 4, 8, KIRI_OPEN_STEPS };
    const int32_t passed = field->distance.data[from], owner = field->owner.data[from];
    KIRI_ASSERT(from >= 0 && from < rule->grid->runs.count && passed != KIRI_FAR);
    if ((rule->below[0] != NULL && passed >= rule->below[0][from]) ||
        (rule->below[1] != NULL && passed >= rule->below[1][from]) || !Passes(rule, from)) {
        return true;
    }
    if (length == 0) { /* the shortest come first */
        LookAround(rule, from);
    }
    const kiriStepRun* run = &rule->grid->runs.data[from];
    const int32_t *has = field->distance.data, *owners = field->owner.data, *to = rule->grid->openTo;
    const int32_t* around = kiriStepRun_IsOpen(run) ? kiriGrid_AroundOpen(rule->grid, run) : NULL;
    const kiriStep* steps = rule->grid->steps.data;
    int32_t end = around != NULL ? openEnds[length + 1] : run->end[length];
    int32_t s = around != NULL ? openEnds[length] : length == 0 ? run->first : run->end[length - 1];
    for (; s < end && field->settled.count < most; ++s) {
        int32_t cell = around != NULL ? around[to[s]] : steps[s].cell;
        if (distance < has[cell] || (distance == has[cell] && owner < owners[cell])) {
            SettleCell(field, (kiriSeed){ cell, distance, owner }, repairs);
        }
    }
    return s >= end;
}

/* Settles cells until none is left, or the quota is spent on them. In a repair a cell may have values on all sides, and
   its previous value is logged: it counts twice. */
static kiriProgress Sweep(kiriField* field, const kiriRule* rule, kiriQuota* quota, bool repairs)
{
    int32_t before = field->settled.count, farthest = FarthestOf(rule), distance, items = repairs ? 2 : 1;
    int64_t fit = quota->left / items, most = INT64_MAX;
    if (quota->left < INT32_MAX) {
        most = before + (fit > 0 || kiriQuota_IsBegun(quota) ? fit : 1);
    }
    int64_t next[KIRI_STEP_LENGTHS] = { NextDistance(field, 0), NextDistance(field, 1), NextDistance(field, 2) };
    int source = NearestSource(field, next, farthest, &distance);
    while (source != FROM_NOWHERE && field->settled.count < most) {
        if (source == FROM_SEED) {
            /* A cell that has the very value of the seed is dirty itself: it passes its value on. */
            kiriSeed seed = PopSeed(field), value = ValueOf(field, seed.cell);
            if (repairs ? !IsNearerSeed(value, seed) : IsNearerSeed(seed, value)) {
                SettleCell(field, seed, repairs);
            }
        } else {
            int32_t *cursor = &field->cursor[source], from = field->settled.data[*cursor];
            int32_t passed = field->distance.data[from]; /* by all cells at this distance */
            while (from != KIRI_NONE && field->distance.data[from] == passed &&
                   TakeStepsFrom(field, rule, from, source, distance, most, repairs)) {
                from = ++*cursor < field->settled.count ? field->settled.data[*cursor] : KIRI_NONE;
            }
        }
        for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
            next[k] = k == source || next[k] == FAR_BEYOND ? NextDistance(field, k) : next[k];
        }
        source = NearestSource(field, next, farthest, &distance);
    }
    kiriQuota_TakeAtMostAll(quota, (int64_t)items * (field->settled.count - before));
    return source == FROM_NOWHERE ? KIRI_DONE : KIRI_MORE;
}

bool kiriField_Start(kiriField* field, kiriMemory* memory, const kiriSeed* seeds, int32_t seedCount)
{
    KIRI_ASSERT(field->settled.count == 0 && field->dirty.count == 0 && field->stage == REPAIR_NONE);
    if (!kiriArray_Resize(memory, &field->heap, seedCount)) {
        return false;
    }
    for (int32_t i = 0; i < seedCount; ++i) {
        KIRI_ASSERT(seeds[i].cell >= 0 && seeds[i].cell < field->distance.count && seeds[i].distance >= 0);
        field->heap.data[i] = seeds[i];
    }
    StartSweep(field);
    return true;
}

kiriProgress kiriField_Flood(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    KIRI_ASSERT(field->stage == REPAIR_NONE);
    return Sweep(field, rule, quota, false);
}

/* ---- Repairs (Ramalingam and Reps 1996) -------------------------------------------------------------------------- */

void kiriField_MarkStepsDirty(kiriField* field, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->marks.count);
    if ((field->marks.data[cell] & FIELD_DIRTY) == 0) {
        field->settled.count = 0; /* of a flood */
        MakeLong(field, &field->dirty);
        KIRI_ASSERT(field->dirty.count < field->dirty.capacity);
        field->marks.data[cell] |= FIELD_DIRTY;
        field->dirty.data[field->dirty.count++] = cell;
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
    field->distance.data[cell] = KIRI_FAR;
    field->owner.data[cell] = KIRI_NONE;
}

/* True if its seed or a neighbour still gives the cell its value. Every step is longer than nothing, so the cells of a
   ring cannot support each other. */
static bool IsSupported(const kiriField* field, const kiriRule* rule, int32_t cell)
{
    const kiriSeed value = ValueOf(field, cell);
    kiriSteps steps;
    if (value.distance > FarthestOf(rule)) {
        return false;
    }
    kiriGrid_GetSteps(rule->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t next = steps.data[s].cell;
        if (field->distance.data[next] == value.distance - steps.data[s].length &&
            field->owner.data[next] == value.owner && Passes(rule, next)) {
            return true;
        }
    }
    kiriSeed seed = rule->seed(rule->context, cell);
    return seed.distance == value.distance && seed.owner == value.owner;
}

/* Adds the cells that may have their value from this one to the dirty ones. False for memory. */
static bool AddDependents(kiriField* field, kiriMemory* memory, const kiriRule* rule, int32_t cell)
{
    const kiriSeed value = ValueOf(field, cell);
    kiriSteps steps;
    kiriGrid_GetSteps(rule->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t next = steps.data[s].cell;
        if (field->distance.data[next] == value.distance + steps.data[s].length &&
            field->owner.data[next] == value.owner && (field->marks.data[next] & FIELD_DIRTY) == 0) {
            if (!kiriArray_Push(memory, &field->dirty, next)) {
                return false;
            }
            field->marks.data[next] |= FIELD_DIRTY;
        }
    }
    return true;
}

/* Clears the affected cells: those whose value nothing supports any more. The other values are lengths of ways that
   still exist, if not the shortest. A cell that ways do not pass (any longer) keeps its own value, but its dependents
   may lose theirs. */
static kiriProgress ClearAffected(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
{
    for (; field->checked < field->dirty.count; ++field->checked) {
        int32_t cell = field->dirty.data[field->checked];
        if (field->distance.data[cell] != KIRI_FAR) {
            bool blocked = (field->marks.data[cell] & FIELD_PASSES) != 0 && !Passes(rule, cell);
            LookAround(rule, cell);
            bool supported = IsSupported(field, rule, cell);
            if (!kiriQuota_Take(quota, !supported || field->checked % 4 == 0)) {
                return KIRI_MORE;
            }
            if (!kiriArray_Reserve(memory, &field->log, (int64_t)field->log.count + 1) ||
                ((!supported || blocked) && !AddDependents(field, memory, rule, cell))) {
                return KIRI_FAILED;
            }
            if (!supported) {
                LogValue(field, cell);
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
    int32_t farthest = FarthestOf(rule);
    kiriSteps steps;
    best = best.distance <= farthest && IsNearerSeed(best, value) ? best : value;
    kiriGrid_GetSteps(rule->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t next = steps.data[s].cell, length = steps.data[s].length;
        if (field->distance.data[next] <= kiriMin(best.distance, farthest) - length) {
            kiriSeed over = { cell, field->distance.data[next] + length, field->owner.data[next] };
            best = IsNearerSeed(over, best) && Passes(rule, next) ? over : best;
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
            LookAround(rule, cell);
            kiriSeed best = NearestFor(field, rule, cell);
            bool passes = (field->marks.data[cell] & FIELD_PASSES) != 0;
            if (best.distance != KIRI_FAR && (passes || IsNearerSeed(best, ValueOf(field, cell)))) {
                KIRI_ASSERT(field->heap.count < field->heap.capacity);
                field->heap.data[field->heap.count++] = best;
            }
            field->marks.data[cell] &= (uint8_t)~FIELD_PASSES;
        }
    }
    return KIRI_DONE;
}

/* Sweeps some cells at a time: so there is room in the log for those that are settled, and for those that get a lower
   owner. */
static kiriProgress SweepAgain(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
{
    enum { AT_ONCE = 1024 };
    kiriProgress progress = KIRI_MORE;
    int64_t used;
    do {
        int64_t give = kiriMin(quota->left, AT_ONCE);
        used = quota->used;
        kiriQuota part = { give, 0, 0, kiriQuota_IsBegun(quota) };
        if (!kiriArray_Reserve(memory, &field->log, (int64_t)field->log.count + field->settled.count + give)) {
            return KIRI_FAILED;
        }
        progress = Sweep(field, rule, &part, true);
        kiriQuota_Take(quota, part.used);
        quota->beyond += part.beyond;
    } while (progress == KIRI_MORE && quota->left > 0 && quota->used > used);
    return progress;
}

kiriProgress kiriField_Repair(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
{
    KIRI_ASSERT(rule->seed != NULL && rule->below[0] == NULL && rule->below[1] == NULL);
    kiriProgress progress = KIRI_DONE;
    if (field->stage == REPAIR_NONE) {
        for (int32_t i = 0; i < field->log.count; ++i) {
            field->marks.data[field->log.data[i].cell] |= FIELD_LOGGED;
        }
        field->checked = 0;
        field->fromCaller = field->dirty.count;
        field->stage = REPAIR_CLEARS;
    }
    if (field->stage == REPAIR_CLEARS) {
        progress = ClearAffected(field, memory, rule, quota);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (!kiriArray_Reserve(memory, &field->heap, field->dirty.count)) {
            return KIRI_FAILED;
        }
        field->heap.count = field->checked = 0;
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
    progress = SweepAgain(field, memory, rule, quota);
    if (progress == KIRI_DONE) {
        for (int32_t i = 0; i < field->log.count; ++i) {
            field->marks.data[field->log.data[i].cell] = 0;
        }
        for (int32_t i = 0; i < field->settled.count; ++i) {
            field->marks.data[field->settled.data[i]] = 0;
        }
        field->settled.count = 0;
        field->stage = REPAIR_NONE;
    }
    return progress;
}

/* ---- Floods by scanning ------------------------------------------------------------------------------------------ */

/* Each cell in their order, forth and back, pulls from the cells before it (Rosenfeld and Pfaltz 1966, Borgefors 1986).
   A sheet without slits and bays needs two scans. A scan has no queue, and few branches that are hard to predict, so it
   is faster than a sweep. */

/* The distance and the owner of a cell, in one number. The lesser key is nearer. */
typedef uint64_t ScanKey;

static inline ScanKey Nearer(ScanKey key, ScanKey from, int32_t length)
{
    ScanKey over = from + ((ScanKey)length << 32);
    return kiriMin(over, key);
}

static ScanKey KeyOf(int32_t distance, int32_t owner)
{
    return (ScanKey)(uint32_t)distance << 32 | (uint32_t)owner;
}

typedef struct Scan {
    const kiriGrid* grid;
    const int32_t* cells;
    int32_t count;
    ScanKey* keys; /* of each cell of the grid */
} Scan;

/* Pulls from the cells before an open cell, or behind. */
static inline ScanKey PullOpen(const Scan* scan, const kiriStepRun* run, bool forth, ScanKey key)
{
    /* As kiriOpenSteps has them. The cell just scanned comes last: others need not wait for it. */
    static const uint8_t steps[2][KIRI_OPEN_STEPS / 2] = { { 15, 14, 13, 12, 7, 6, 3, 2 },
                                                           { 8, 9, 10, 11, 4, 5, 0, 1 } };
    const int32_t *around = kiriGrid_AroundOpen(scan->grid, run), *to = scan->grid->openTo;
    for (int k = 0; k < KIRI_OPEN_STEPS / 2; ++k) {
        int32_t length = k < 4 ? KIRI_UNIT_KNIGHT : k < 6 ? KIRI_UNIT_DIAGONAL : KIRI_UNIT;
        key = Nearer(key, scan->keys[around[to[steps[forth][k]]]], length);
    }
    return key;
}

static ScanKey PullStored(const Scan* scan, const kiriStepRun* run, ScanKey key)
{
    const kiriStep* steps = scan->grid->steps.data;
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        key = Nearer(key, scan->keys[steps[s].cell], steps[s].length);
    }
    return key;
}

/* Scans all cells; true if any became nearer. */
static inline bool ScanOnce(const Scan* scan, bool forth)
{
    ScanKey changes = 0;
    for (int32_t k = 0; k < scan->count; ++k) {
        int32_t cell = scan->cells[forth ? k : scan->count - 1 - k];
        const kiriStepRun* run = &scan->grid->runs.data[cell];
        ScanKey was = scan->keys[cell];
        ScanKey key = kiriStepRun_IsOpen(run) ? PullOpen(scan, run, forth, was) : PullStored(scan, run, was);
        scan->keys[cell] = key;
        changes |= key ^ was;
    }
    return changes != 0;
}

/* Scans until nothing changes in two scans, one each way. The more the ways wind the more scans it takes: then false,
   because a sweep is faster. */
static bool ScanAll(const Scan* scan)
{
    enum { MOST_SCAN_PAIRS = 4 };
    for (int pairs = 0; pairs < MOST_SCAN_PAIRS; ++pairs) {
        bool changes = ScanOnce(scan, true);
        if ((!changes && pairs > 0) || !ScanOnce(scan, false)) {
            return true;
        }
    }
    return false;
}

kiriProgress kiriField_Scan(kiriField* field, kiriMemory* memory, const kiriGrid* grid, const int32_t* cells,
                            int32_t count)
{
    KIRI_ASSERT(field->settled.count == 0 && field->stage == REPAIR_NONE);
    Scan scan = { grid, cells, count, kiriMemory_Alloc(memory, field->distance.count * (int64_t)sizeof(ScanKey)) };
    if (scan.keys == NULL) {
        return KIRI_FAILED;
    }
    for (int32_t c = 0; c < field->distance.count; ++c) {
        scan.keys[c] = KeyOf(KIRI_FAR, KIRI_NONE);
    }
    for (int32_t k = 0; k < field->heap.count; ++k) {
        kiriSeed seed = field->heap.data[k];
        scan.keys[seed.cell] = Nearer(scan.keys[seed.cell], KeyOf(seed.distance, seed.owner), 0);
    }
    bool isDone = ScanAll(&scan);
    for (int32_t k = 0; isDone && k < count; ++k) {
        int32_t cell = cells[k], distance = (int32_t)(scan.keys[cell] >> 32);
        if (distance != KIRI_FAR) {
            SettleCell(field, (kiriSeed){ cell, distance, (int32_t)(uint32_t)scan.keys[cell] }, false);
        }
    }
    if (isDone) {
        field->heap.count = 0;
        field->cursor[0] = field->cursor[1] = field->cursor[2] = field->settled.count;
    }
    kiriMemory_Free(memory, scan.keys);
    return isDone ? KIRI_DONE : KIRI_MORE;
}

/* ---- Distances of frames, in blocks ------------------------------------------------------------------------------ */

bool kiriReaches_Resize(kiriReaches* reaches, kiriMemory* memory, int32_t cellCount, int32_t frameCount)
{
    int32_t cells = reaches->ofCells.count, frames = reaches->ofFrame.count;
    int32_t needed = kiriReach_BlockOf(cellCount + KIRI_BLOCK_CELLS - 1);
    if (!kiriArray_Resize(memory, &reaches->ofCells, kiriMax(needed, cells)) ||
        !kiriArray_Resize(memory, &reaches->ofFrame, kiriMax(frameCount, frames))) {
        return false;
    }
    for (; cells < reaches->ofCells.count; ++cells) {
        reaches->ofCells.data[cells] = KIRI_NONE;
    }
    for (; frames < reaches->ofFrame.count; ++frames) {
        reaches->ofFrame.data[frames] = KIRI_NONE;
    }
    return true;
}

void kiriReaches_Clear(kiriReaches* reaches)
{
    reaches->blocks.count = reaches->heads.count = reaches->ofCells.count = reaches->ofFrame.count =
        reaches->freeBlocks = 0;
}

int32_t kiriReaches_Find(const kiriReaches* reaches, int32_t frame, int32_t cells)
{
    KIRI_ASSERT(cells >= 0 && cells < reaches->ofCells.count);
    int32_t block = reaches->ofCells.data[cells];
    while (block != KIRI_NONE && reaches->heads.data[block].frame != frame) {
        block = reaches->heads.data[block].nextOfCells;
    }
    return block;
}

int64_t kiriReaches_RoomFor(const kiriReaches* reaches, int32_t more)
{
    return (int64_t)reaches->blocks.count + more - reaches->freeBlocks;
}

int32_t kiriReaches_Add(kiriReaches* reaches, int32_t frame, int32_t cells)
{
    KIRI_ASSERT(frame >= 0 && frame < reaches->ofFrame.count && cells >= 0 && cells < reaches->ofCells.count);
    int32_t index = reaches->freeBlock, next = reaches->ofFrame.data[frame];
    if (reaches->freeBlocks > 0) {
        reaches->freeBlock = reaches->blocks.data[index].nextOfFrame;
        reaches->freeBlocks -= 1;
    } else {
        KIRI_ASSERT(reaches->blocks.count < reaches->blocks.capacity && reaches->blocks.count < reaches->heads.capacity);
        index = reaches->blocks.count++;
        reaches->heads.count += 1;
    }
    kiriReachBlock* block = &reaches->blocks.data[index];
    reaches->heads.data[index] = (kiriReachHead){ frame, reaches->ofCells.data[cells] };
    block->cells = cells;
    block->nextOfFrame = next;
    block->previousOfFrame = KIRI_NONE;
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
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
    KIRI_ASSERT(index >= 0 && index < reaches->heads.count);
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
    KIRI_ASSERT(frame >= 0 && frame < reaches->ofFrame.count);
    while (reaches->ofFrame.data[frame] != KIRI_NONE) {
        kiriReaches_Remove(reaches, reaches->ofFrame.data[frame]);
    }
}

void kiriReaches_Keep(kiriReaches* reaches, const kiriKeep* frames)
{
    for (int32_t frame = frames->first; frame < reaches->ofFrame.count; ++frame) {
        int32_t to = kiriKeep_To(frames, frame);
        KIRI_ASSERT(to != KIRI_NONE || reaches->ofFrame.data[frame] == KIRI_NONE);
        for (int32_t b = reaches->ofFrame.data[frame]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
            reaches->heads.data[b].frame = to;
        }
    }
    kiriKeep_Compact(frames, &reaches->ofFrame, 1, sizeof(int32_t));
}
