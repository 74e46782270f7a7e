#include "kiri_geodesic.h"

/* ---- Room of a field ---- */

/* The one with room for all cells. */
static kiriIndices* LongList(kiriField* field)
{
    return field->settled.capacity < field->dirty.capacity ? &field->dirty : &field->settled;
}

bool kiriField_Resize(kiriField* field, kiriMemory* memory, int32_t cellCount)
{
    if (!kiriArray_Reserve(memory, &field->distance, cellCount) ||
        !kiriArray_Reserve(memory, &field->owner, cellCount) ||
        !kiriArray_Reserve(memory, LongList(field), cellCount) ||
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

void kiriField_Reset(kiriField* field)
{
    for (int32_t i = 0; i < field->settled.count; ++i) {
        field->distance.data[field->settled.data[i]] = KIRI_FAR;
        field->owner.data[field->settled.data[i]] = KIRI_NONE;
    }
    field->settled.count = 0;
}

static const int32_t stepLengths[KIRI_STEP_LENGTHS] = { KIRI_UNIT, KIRI_UNIT_DIAGONAL, KIRI_UNIT_KNIGHT };
enum { FROM_SEED = KIRI_STEP_LENGTHS, FROM_NOWHERE };

/* Marks of cells while a field is repaired. */
enum {
    FIELD_DIRTY = 1,   /* in `dirty`, not checked yet */
    FIELD_LOGGED = 2,  /* in `log` */
    FIELD_SETTLED = 4, /* in `settled` */
    FIELD_PASSES = 8,  /* whether ways pass through it may have changed; of the caller's */
};

/* What `cursor` holds. In a sweep the first three go over the settled cells, one for each length of steps. Before
   it: */
enum {
    DIRTY_CHECKED,     /* dirty cells that were checked, or looked at for seeds of the sweep */
    DIRTY_FROM_CALLER, /* how many the caller marked; those behind are dependents */
    REPAIR_STAGE = KIRI_STEP_LENGTHS,
};
enum { REPAIR_NONE, REPAIR_CLEARS, REPAIR_SEEDS, REPAIR_SETTLES };

/* Before cells are put in a list, and when there are none in the other one. */
static void MakeLong(kiriField* field, kiriIndices* list)
{
    if (list->capacity < field->distance.count) {
        kiriIndices settled = field->settled;
        KIRI_ASSERT(field->settled.count == 0 && field->dirty.count == 0);
        field->settled = field->dirty;
        field->dirty = settled;
    }
}

void kiriField_Clear(kiriField* field)
{
    field->distance.count = field->owner.count = field->marks.count = 0;
    field->settled.count = field->log.count = field->heap.count = field->dirty.count = 0;
    field->cursor[REPAIR_STAGE] = REPAIR_NONE;
}

/* ---- The heap of seeds, nearest on top --------------------------------------------------------------------------- */

static bool IsNearerSeed(kiriSeed a, kiriSeed b)
{
    return a.distance != b.distance ? a.distance < b.distance : a.owner < b.owner;
}

/* Restores the heap below a place that may hold too far a seed. */
static void SinkSeed(kiriField* field, int32_t i)
{
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

static void MakeHeap(kiriField* field)
{
    for (int32_t i = field->heap.count / 2; i-- > 0;) {
        SinkSeed(field, i);
    }
}

static kiriSeed PopSeed(kiriField* field)
{
    kiriSeed top = field->heap.data[0];
    field->heap.data[0] = field->heap.data[--field->heap.count];
    if (field->heap.count > 0) {
        SinkSeed(field, 0);
    }
    return top;
}

/* ---- The sweep: Dijkstra without a queue ------------------------------------------------------------------------- */

/* There are only three lengths of steps, and cells settle by growing distance. So what the steps of one length reach is
   sorted already: a cursor for each length over the settled cells finds the next. */

/* The first to reach a cell is the nearest. Its owner may still become a lower one as long as the sweep is at this
   distance; the cell passes it on later, for every step is longer than nothing. */
static void SettleFirst(kiriField* field, int32_t cell, int32_t distance, int32_t owner)
{
    KIRI_ASSERT(cell >= 0 && cell < field->distance.count && distance >= 0);
    if (field->distance.data[cell] == KIRI_FAR) {
        KIRI_ASSERT(field->settled.count < field->settled.capacity);
        field->distance.data[cell] = distance;
        field->owner.data[cell] = owner;
        field->settled.data[field->settled.count++] = cell;
    } else if (owner < field->owner.data[cell] && field->distance.data[cell] == distance) {
        field->owner.data[cell] = owner;
    }
}

static inline kiriSeed ValueOf(const kiriField* field, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->distance.count);
    kiriSeed value = { cell, field->distance.data[cell], field->owner.data[cell] };
    return value;
}

/* There is room. */
static void LogValue(kiriField* field, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->marks.count);
    if ((field->marks.data[cell] & FIELD_LOGGED) == 0) {
        KIRI_ASSERT(field->log.count < field->log.capacity);
        field->marks.data[cell] |= FIELD_LOGGED;
        field->log.data[field->log.count++] = ValueOf(field, cell);
    }
}

/* Takes a value that is nearer, or equals the cell's own, which is then passed on once more. */
static void SettleValue(kiriField* field, kiriSeed to)
{
    if (IsNearerSeed(to, ValueOf(field, to.cell))) {
        LogValue(field, to.cell);
        field->distance.data[to.cell] = to.distance;
        field->owner.data[to.cell] = to.owner;
    }
    if ((field->marks.data[to.cell] & FIELD_SETTLED) == 0) {
        KIRI_ASSERT(field->settled.count < field->settled.capacity);
        field->marks.data[to.cell] |= FIELD_SETTLED;
        field->settled.data[field->settled.count++] = to.cell;
    }
}

/* SettleFirst where cells may have kept a value. */
static void SettleAgain(kiriField* field, int32_t cell, int32_t distance, int32_t owner)
{
    KIRI_ASSERT(cell >= 0 && cell < field->distance.count);
    int32_t has = field->distance.data[cell];
    if (distance < has || (distance == has && owner < field->owner.data[cell])) {
        SettleValue(field, (kiriSeed){ cell, distance, owner });
    }
}

static int32_t FarthestOf(const kiriRule* rule)
{
    return rule->limit < KIRI_FAR ? rule->limit : KIRI_FAR - 1;
}

static inline bool Passes(const kiriRule* rule, int32_t cell)
{
    return rule->pass == NULL || rule->pass(rule->context, cell);
}

/* Passes, of floods. */
static inline bool LetsPass(const kiriField* field, const kiriRule* rule, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->distance.count);
    int32_t distance = field->distance.data[cell];
    return (rule->below[0] == NULL || distance < rule->below[0][cell]) &&
           (rule->below[1] == NULL || distance < rule->below[1][cell]) && Passes(rule, cell);
}

static void LookAround(const kiriRule* rule, int32_t cell)
{
    if (rule->look != NULL) {
        rule->look(rule->context, cell);
    }
}

/* Where what the steps of one length reach next lies; FAR_BEYOND where they reach nothing more so far. */
static const int64_t FAR_BEYOND = INT64_MAX;

static inline int64_t NextReachOf(const kiriField* field, int length)
{
    int32_t cursor = field->cursor[length];
    return cursor < field->settled.count
               ? (int64_t)field->distance.data[field->settled.data[cursor]] + stepLengths[length]
               : FAR_BEYOND;
}

/* Where the sweep goes on: from which cursor, and at which distance, no farther than `limit`. */
static inline int NearestSource(const kiriField* field, const int64_t* reach, int32_t limit, int32_t* distance)
{
    int source = FROM_NOWHERE;
    int64_t least = limit;
    for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
        source = reach[k] <= least ? k : source;
        least = reach[k] <= least ? reach[k] : least;
    }
    if (field->heap.count > 0 && field->heap.data[0].distance <= least) {
        least = field->heap.data[0].distance;
        source = FROM_SEED;
    }
    *distance = (int32_t)least;
    return source;
}

static void TakeNearestSeed(kiriField* field)
{
    kiriSeed seed = PopSeed(field);
    if (field->cursor[REPAIR_STAGE] == REPAIR_SETTLES) {
        /* A cell that has the very value of the seed is dirty itself: it passes its value on. */
        if (!IsNearerSeed(ValueOf(field, seed.cell), seed)) {
            SettleValue(field, seed);
        }
    } else {
        SettleFirst(field, seed.cell, seed.distance, seed.owner);
    }
}

/* Where steps of a cell lead, those from `from` to `end`: stored ones, or those of an open cell. */
typedef struct StepsAhead {
    const kiriStep* stored; /* or null */
    const int32_t *around, *openTo;
    int32_t from, end;
} StepsAhead;

static inline int32_t CellAhead(const StepsAhead* ahead, int32_t s)
{
    return ahead->stored != NULL ? ahead->stored[s].cell : ahead->around[ahead->openTo[s]];
}

/* The steps of one length. */
static inline StepsAhead LookAhead(const kiriGrid* grid, int32_t cell, int length)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->runs.count);
    static const int32_t openEnds[] = { 0, 4, 8, KIRI_OPEN_STEPS };
    const kiriStepRun* run = &grid->runs.data[cell];
    if (kiriStepRun_IsOpen(run)) {
        return (StepsAhead){ NULL, kiriGrid_AroundOpen(grid, run), grid->openTo, openEnds[length],
                             openEnds[length + 1] };
    }
    int32_t from = length == 0 ? run->first : run->end[length - 1];
    return (StepsAhead){ grid->steps.data, NULL, NULL, from, run->end[length] };
}

/* SettleFirst for all steps of one length of an open cell. */
static inline void SettleAroundOpen(kiriField* field, const kiriGrid* grid, const kiriStepRun* run, int length,
                                    int32_t distance, int32_t owner)
{
    const int32_t *around = kiriGrid_AroundOpen(grid, run), *to = grid->openTo + 4 * length;
    int32_t *has = field->distance.data, *owners = field->owner.data, *settled = field->settled.data;
    int32_t count = field->settled.count, steps = length == KIRI_STEP_LENGTHS - 1 ? 8 : 4;
    for (int32_t s = 0; s < steps; ++s) {
        int32_t cell = around[to[s]];
        if (has[cell] == KIRI_FAR) {
            has[cell] = distance;
            owners[cell] = owner;
            settled[count++] = cell;
        } else if (has[cell] == distance && owner < owners[cell]) {
            owners[cell] = owner;
        }
    }
    KIRI_ASSERT(count <= field->settled.capacity);
    field->settled.count = count;
}

/* Takes the steps of one length. False where `most` cells are settled before all are taken: they are all taken again
   later, which changes nothing. */
static inline bool TakeStepsFrom(kiriField* field, const kiriRule* rule, int32_t from, int length, int32_t distance,
                                 int64_t most)
{
    KIRI_ASSERT(from >= 0 && from < field->owner.count);
    const int32_t* has = field->distance.data;
    int32_t owner = field->owner.data[from];
    if (!LetsPass(field, rule, from)) {
        return true;
    }
    if (length == 0) { /* the shortest come first */
        LookAround(rule, from);
    }
    bool repairs = field->cursor[REPAIR_STAGE] == REPAIR_SETTLES;
    const kiriStepRun* run = &rule->grid->runs.data[from];
    if (!repairs && kiriStepRun_IsOpen(run) && field->settled.count + 8 <= most) {
        SettleAroundOpen(field, rule->grid, run, length, distance, owner);
        return true;
    }
    const StepsAhead ahead = LookAhead(rule->grid, from, length);
    int32_t s = ahead.from;
    if (repairs) {
        for (; s < ahead.end && field->settled.count < most; ++s) {
            int32_t to = CellAhead(&ahead, s);
            if (distance <= has[to]) { /* most have a nearer one */
                SettleAgain(field, to, distance, owner);
            }
        }
    } else {
        for (; s < ahead.end && field->settled.count < most; ++s) {
            SettleFirst(field, CellAhead(&ahead, s), distance, owner);
        }
    }
    return s >= ahead.end;
}

/* Takes the steps of one length from all cells at the distance where its cursor is. */
static void TakeStepsOf(kiriField* field, const kiriRule* rule, int length, int32_t distance, int64_t most)
{
    int32_t* cursor = &field->cursor[length];
    int32_t from = field->settled.data[*cursor], passed = field->distance.data[from];
    while (from != KIRI_NONE && field->distance.data[from] == passed &&
           TakeStepsFrom(field, rule, from, length, distance, most)) {
        from = ++*cursor < field->settled.count ? field->settled.data[*cursor] : KIRI_NONE;
    }
}

/* A cell may have values on all sides, and what it had is logged. */
enum { ITEMS_OF_SETTLED_AGAIN = 2 };

/* How many cells the quota has left; one where it is less, but nothing of it is used yet. */
static int64_t CellsLeft(const kiriQuota* quota, int32_t items)
{
    int64_t fit = quota->left / items;
    return fit > 0 || kiriQuota_IsBegun(quota) ? fit : 1;
}

/* Until nothing is left, or the quota is spent on settled cells. */
static kiriProgress Sweep(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    int32_t before = field->settled.count, farthest = FarthestOf(rule), distance;
    int32_t items = field->cursor[REPAIR_STAGE] == REPAIR_SETTLES ? ITEMS_OF_SETTLED_AGAIN : 1;
    int64_t most = quota->left < INT32_MAX ? before + CellsLeft(quota, items) : INT64_MAX;
    int64_t reach[KIRI_STEP_LENGTHS] = { NextReachOf(field, 0), NextReachOf(field, 1), NextReachOf(field, 2) };
    int source = NearestSource(field, reach, farthest, &distance);
    while (source != FROM_NOWHERE && field->settled.count < most) {
        if (source == FROM_SEED) {
            TakeNearestSeed(field);
        } else {
            TakeStepsOf(field, rule, source, distance, most);
        }
        for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
            reach[k] = k == source || reach[k] == FAR_BEYOND ? NextReachOf(field, k) : reach[k];
        }
        source = NearestSource(field, reach, farthest, &distance);
    }
    kiriQuota_TakeAtMostAll(quota, (int64_t)items * (field->settled.count - before));
    return source == FROM_NOWHERE ? KIRI_DONE : KIRI_MORE;
}

bool kiriField_Start(kiriField* field, kiriMemory* memory, const kiriSeed* seeds, int32_t seedCount)
{
    KIRI_ASSERT(field->settled.count == 0 && field->dirty.count == 0 && field->cursor[REPAIR_STAGE] == REPAIR_NONE);
    field->heap.count = 0;
    MakeLong(field, &field->settled);
    if (!kiriArray_Resize(memory, &field->heap, seedCount)) {
        return false;
    }
    for (int32_t i = 0; i < seedCount; ++i) {
        KIRI_ASSERT(seeds[i].cell >= 0 && seeds[i].cell < field->distance.count);
        field->heap.data[i] = seeds[i];
    }
    MakeHeap(field);
    field->cursor[0] = field->cursor[1] = field->cursor[2] = 0;
    field->cursor[REPAIR_STAGE] = REPAIR_NONE;
    return true;
}

kiriProgress kiriField_Flood(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    KIRI_ASSERT(field->cursor[REPAIR_STAGE] == REPAIR_NONE);
    return Sweep(field, rule, quota);
}

/* ---- Repairs ----------------------------------------------------------------------------------------------------- */

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
    KIRI_ASSERT(cell >= 0 && cell < field->marks.count);
    kiriField_MarkStepsDirty(field, cell);
    field->marks.data[cell] |= FIELD_PASSES;
}

void kiriField_Forget(kiriField* field, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->distance.count);
    field->distance.data[cell] = KIRI_FAR;
    field->owner.data[cell] = KIRI_NONE;
}

/* Do its seed or a neighbour still give the cell its value? Every step is longer than nothing, so the cells of a ring
   cannot support each other. Where nothing supports it, or all are asked for, the cells that may have their value from
   it are put behind the dirty ones, where there is room, and *dependents says how many: they are not counted yet. */
static bool IsSupported(const kiriField* field, const kiriRule* rule, int32_t cell, bool all, int32_t* dependents)
{
    const int32_t *distance = field->distance.data, *owner = field->owner.data;
    int32_t value = distance[cell], mine = owner[cell], count = field->dirty.count;
    bool near = value <= FarthestOf(rule), supported = false;
    for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
        const StepsAhead ahead = LookAhead(rule->grid, cell, k);
        int32_t nearer = value - stepLengths[k], farther = value + stepLengths[k];
        for (int32_t s = ahead.from; s < ahead.end; ++s) {
            int32_t next = CellAhead(&ahead, s), has = distance[next];
            if (has == nearer && owner[next] == mine && near && Passes(rule, next)) {
                supported = true;
                if (!all) {
                    return true;
                }
            }
            if (has == farther && owner[next] == mine && (field->marks.data[next] & FIELD_DIRTY) == 0) {
                field->dirty.data[count++] = next;
            }
        }
    }
    *dependents = count - field->dirty.count;
    kiriSeed seed = supported || !near ? (kiriSeed){ cell, KIRI_FAR, KIRI_NONE } : rule->seed(rule->context, cell);
    return supported || (seed.distance == value && seed.owner == mine);
}

/* Cells that IsSupported found. */
static void MarkDependentsDirty(kiriField* field, int32_t dependents)
{
    for (; dependents > 0; --dependents) {
        field->marks.data[field->dirty.data[field->dirty.count++]] |= FIELD_DIRTY;
    }
}

static bool MakeDependentsRoom(kiriField* field, kiriMemory* memory, const kiriRule* rule, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < rule->grid->runs.count);
    const kiriStepRun* run = &rule->grid->runs.data[cell];
    int32_t steps = kiriStepRun_IsOpen(run) ? KIRI_OPEN_STEPS : run->end[KIRI_STEP_LENGTHS - 1] - run->first;
    return kiriArray_Reserve(memory, &field->dirty, (int64_t)field->dirty.count + steps);
}

/* Clears the affected cells (Ramalingam and Reps): those whose value nothing supports any more. The values that are
   left are lengths of ways that still exist, if not the shortest. A cell that ways do not pass (any longer) keeps its
   own value, but its dependents may lose theirs. */
static kiriProgress ClearAffected(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
{
    for (; field->cursor[DIRTY_CHECKED] < field->dirty.count; ++field->cursor[DIRTY_CHECKED]) {
        int32_t cell = field->dirty.data[field->cursor[DIRTY_CHECKED]];
        if (field->distance.data[cell] != KIRI_FAR) {
            bool blocked = (field->marks.data[cell] & FIELD_PASSES) != 0 && !Passes(rule, cell);
            int32_t dependents = 0;
            LookAround(rule, cell);
            if (!MakeDependentsRoom(field, memory, rule, cell) ||
                !kiriArray_Reserve(memory, &field->log, (int64_t)field->log.count + 1)) {
                return KIRI_FAILED;
            }
            bool supported = IsSupported(field, rule, cell, blocked, &dependents);
            if (!kiriQuota_Take(quota, !supported || field->cursor[DIRTY_CHECKED] % 4 == 0)) {
                return KIRI_MORE;
            }
            if (!supported || blocked) {
                MarkDependentsDirty(field, dependents);
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

/* The nearest that seed and neighbours give the cell, or what it has. */
static kiriSeed NearestFor(const kiriField* field, const kiriRule* rule, int32_t cell)
{
    const int32_t *distance = field->distance.data, *owner = field->owner.data;
    kiriSeed best = rule->seed(rule->context, cell), value = ValueOf(field, cell);
    int32_t farthest = FarthestOf(rule);
    best = best.distance <= farthest && IsNearerSeed(best, value) ? best : value;
    int32_t most = kiriMin(best.distance, farthest);
    for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
        const StepsAhead ahead = LookAhead(rule->grid, cell, k);
        for (int32_t s = ahead.from; s < ahead.end; ++s) {
            int32_t next = CellAhead(&ahead, s);
            if (distance[next] <= most - stepLengths[k]) {
                kiriSeed over = { cell, distance[next] + stepLengths[k], owner[next] };
                best = IsNearerSeed(over, best) && Passes(rule, next) ? over : best;
                most = kiriMin(best.distance, most);
            }
        }
    }
    return best;
}

/* The sweep starts when the heap has all its seeds. */
static void StartSweep(kiriField* field)
{
    MakeHeap(field);
    field->dirty.count = field->settled.count = 0;
    MakeLong(field, &field->settled);
    field->cursor[0] = field->cursor[1] = field->cursor[2] = 0;
    field->cursor[REPAIR_STAGE] = REPAIR_SETTLES;
}

/* A cell that has lost its value gets the nearest that there is for it. One of the caller's that kept its own may get a
   nearer one, over a new step or from its seed; and where ways pass that did not, they go on from it with what it has.
   What it gives by new steps is no matter of its own: the cells that they lead to are dirty too. */
static void SeedFrom(kiriField* field, const kiriRule* rule, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < field->marks.count);
    bool passes = (field->marks.data[cell] & FIELD_PASSES) != 0;
    LookAround(rule, cell);
    kiriSeed best = NearestFor(field, rule, cell);
    if (best.distance != KIRI_FAR && (passes || IsNearerSeed(best, ValueOf(field, cell)))) {
        field->heap.data[field->heap.count++] = best;
    }
    field->marks.data[cell] &= (uint8_t)~FIELD_PASSES;
}

/* The seeds of the sweep. */
static kiriProgress SeedSweep(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    for (int32_t i = field->cursor[DIRTY_CHECKED]; i < field->dirty.count; ++i) {
        int32_t cell = field->dirty.data[i];
        bool seeds = i < field->cursor[DIRTY_FROM_CALLER] || field->distance.data[cell] == KIRI_FAR;
        field->cursor[DIRTY_CHECKED] = i;
        if (!kiriQuota_Take(quota, seeds || i % 4 == 0)) {
            return KIRI_MORE;
        }
        if (seeds) {
            SeedFrom(field, rule, cell);
        }
    }
    StartSweep(field);
    return KIRI_DONE;
}

/* Room for all seeds of the sweep. */
static bool BeginSeeds(kiriField* field, kiriMemory* memory)
{
    field->heap.count = 0;
    field->cursor[DIRTY_CHECKED] = 0;
    field->cursor[REPAIR_STAGE] = REPAIR_SEEDS;
    return kiriArray_Reserve(memory, &field->heap, field->dirty.count);
}

static void BeginRepair(kiriField* field)
{
    for (int32_t i = 0; i < field->log.count; ++i) {
        field->marks.data[field->log.data[i].cell] |= FIELD_LOGGED;
    }
    field->cursor[DIRTY_CHECKED] = 0;
    field->cursor[DIRTY_FROM_CALLER] = field->dirty.count;
    field->cursor[REPAIR_STAGE] = REPAIR_CLEARS;
}

static void EndRepair(kiriField* field)
{
    for (int32_t i = 0; i < field->log.count; ++i) {
        field->marks.data[field->log.data[i].cell] = 0;
    }
    for (int32_t i = 0; i < field->settled.count; ++i) {
        field->marks.data[field->settled.data[i]] = 0;
    }
    field->settled.count = 0;
    field->cursor[REPAIR_STAGE] = REPAIR_NONE;
}

/* Some cells at a time: so there is room in the log for those that are settled, and for those that get a lower
   owner. */
static kiriProgress SweepRepaired(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
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
        progress = Sweep(field, rule, &part);
        kiriQuota_Take(quota, part.used);
        quota->beyond += part.beyond;
    } while (progress == KIRI_MORE && quota->left > 0 && quota->used > used);
    return progress;
}

kiriProgress kiriField_Repair(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
{
    KIRI_ASSERT(rule->seed != NULL && rule->below[0] == NULL && rule->below[1] == NULL);
    if (field->cursor[REPAIR_STAGE] == REPAIR_NONE) {
        BeginRepair(field);
    }
    if (field->cursor[REPAIR_STAGE] == REPAIR_CLEARS) {
        kiriProgress progress = ClearAffected(field, memory, rule, quota);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (!BeginSeeds(field, memory)) {
            return KIRI_FAILED;
        }
    }
    if (field->cursor[REPAIR_STAGE] == REPAIR_SEEDS && SeedSweep(field, rule, quota) == KIRI_MORE) {
        return KIRI_MORE;
    }
    kiriProgress progress = SweepRepaired(field, memory, rule, quota);
    if (progress == KIRI_DONE) {
        EndRepair(field);
    }
    return progress;
}

/* Floods by scanning: all cells in their order, forth and back, each pulls from those before it (Rosenfeld and Pfaltz
   1966, Borgefors 1986). In a sheet without slits and bays all is found in the first two scans. There is no queue,
   and few branches are hard to predict, so it is faster than a sweep. */

/* The more the ways wind the more scans it takes: then a sweep is faster. */
enum { MOST_SCAN_PAIRS = 4 };

/* Of a cell: its distance, then its owner. So the lesser one is nearer. */
typedef uint64_t ScanKey;

static ScanKey KeyOf(int32_t distance, int32_t owner)
{
    return (ScanKey)(uint32_t)distance << 32 | (uint32_t)owner;
}

static inline ScanKey Lesser(ScanKey a, ScanKey b)
{
    return kiriMin(b, a);
}

static inline ScanKey Over(ScanKey from, int32_t length)
{
    return from + ((ScanKey)length << 32);
}

typedef struct Scan {
    const kiriGrid* grid;
    const int32_t* cells;
    int32_t count;
    ScanKey* keys; /* of each cell of the grid */
} Scan;

/* What an open cell gets from the cells before it, or behind. */
static inline ScanKey PullOpen(const Scan* scan, const kiriStepRun* run, bool forth, ScanKey key)
{
    /* As kiriOpenSteps has them. The cell just scanned comes last: others need not wait for it. */
    static const uint8_t steps[2][KIRI_OPEN_STEPS / 2] = { { 15, 14, 13, 12, 7, 6, 3, 2 },
                                                           { 8, 9, 10, 11, 4, 5, 0, 1 } };
    const int32_t *around = kiriGrid_AroundOpen(scan->grid, run), *to = scan->grid->openTo;
    for (int k = 0; k < KIRI_OPEN_STEPS / 2; ++k) {
        int32_t length = k < 4 ? KIRI_UNIT_KNIGHT : k < 6 ? KIRI_UNIT_DIAGONAL : KIRI_UNIT;
        key = Lesser(key, Over(scan->keys[around[to[steps[forth][k]]]], length));
    }
    return key;
}

static ScanKey PullStored(const Scan* scan, const kiriStepRun* run, ScanKey key)
{
    const kiriStep* steps = scan->grid->steps.data;
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        key = Lesser(key, Over(scan->keys[steps[s].cell], steps[s].length));
    }
    return key;
}

/* Has anything become nearer? */
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

/* Until two scans, one each way, have nothing more to do. */
static bool ScanAll(const Scan* scan)
{
    for (int pairs = 0; pairs < MOST_SCAN_PAIRS; ++pairs) {
        bool changes = ScanOnce(scan, true);
        if ((!changes && pairs > 0) || !ScanOnce(scan, false)) {
            return true;
        }
    }
    return false;
}

static void TakeSeeds(const Scan* scan, const kiriField* field)
{
    for (int32_t c = 0; c < field->distance.count; ++c) {
        scan->keys[c] = KeyOf(KIRI_FAR, KIRI_NONE);
    }
    for (int32_t k = 0; k < field->heap.count; ++k) {
        kiriSeed seed = field->heap.data[k];
        scan->keys[seed.cell] = Lesser(scan->keys[seed.cell], KeyOf(seed.distance, seed.owner));
    }
}

/* What a flood leaves. */
static void PutIntoField(const Scan* scan, kiriField* field)
{
    for (int32_t k = 0; k < scan->count; ++k) {
        int32_t cell = scan->cells[k], distance = (int32_t)(scan->keys[cell] >> 32);
        if (distance != KIRI_FAR) {
            KIRI_ASSERT(field->settled.count < field->settled.capacity);
            field->distance.data[cell] = distance;
            field->owner.data[cell] = (int32_t)(uint32_t)scan->keys[cell];
            field->settled.data[field->settled.count++] = cell;
        }
    }
    field->heap.count = 0;
    field->cursor[0] = field->cursor[1] = field->cursor[2] = field->settled.count;
}

kiriProgress kiriField_Scan(kiriField* field, kiriMemory* memory, const kiriGrid* grid, const int32_t* cells,
                            int32_t count)
{
    KIRI_ASSERT(field->settled.count == 0);
    Scan scan = { grid, cells, count, kiriMemory_Alloc(memory, field->distance.count * (int64_t)sizeof(ScanKey)) };
    if (scan.keys == NULL) {
        return KIRI_FAILED;
    }
    TakeSeeds(&scan, field);
    bool isDone = ScanAll(&scan);
    if (isDone) {
        PutIntoField(&scan, field);
    }
    kiriMemory_Free(memory, scan.keys);
    return isDone ? KIRI_DONE : KIRI_MORE;
}

bool kiriReaches_Resize(kiriReaches* reaches, kiriMemory* memory, int32_t cellCount, int32_t labelCount)
{
    int32_t cells = reaches->ofCells.count, labels = reaches->ofLabel.count;
    int32_t needed = kiriReach_BlockOf(cellCount + KIRI_BLOCK_CELLS - 1);
    if (!kiriArray_Resize(memory, &reaches->ofCells, kiriMax(needed, cells)) ||
        !kiriArray_Resize(memory, &reaches->ofLabel, kiriMax(labelCount, labels))) {
        return false;
    }
    for (; cells < reaches->ofCells.count; ++cells) {
        reaches->ofCells.data[cells] = KIRI_NONE;
    }
    for (; labels < reaches->ofLabel.count; ++labels) {
        reaches->ofLabel.data[labels] = KIRI_NONE;
    }
    return true;
}

void kiriReaches_Clear(kiriReaches* reaches)
{
    reaches->blocks.count = reaches->heads.count = reaches->ofCells.count = reaches->ofLabel.count =
        reaches->freeBlocks = 0;
}

int32_t kiriReaches_Find(const kiriReaches* reaches, int32_t label, int32_t cells)
{
    KIRI_ASSERT(cells >= 0 && cells < reaches->ofCells.count);
    int32_t block = reaches->ofCells.data[cells];
    while (block != KIRI_NONE && reaches->heads.data[block].label != label) {
        block = reaches->heads.data[block].nextOfCells;
    }
    return block;
}

int64_t kiriReaches_RoomFor(const kiriReaches* reaches, int32_t more)
{
    return (int64_t)reaches->blocks.count + more - reaches->freeBlocks;
}

static int32_t TakeBlock(kiriReaches* reaches)
{
    if (reaches->freeBlocks == 0) {
        KIRI_ASSERT(reaches->blocks.count < reaches->blocks.capacity &&
                    reaches->blocks.count < reaches->heads.capacity);
        reaches->heads.count += 1;
        return reaches->blocks.count++;
    }
    int32_t block = reaches->freeBlock;
    reaches->freeBlock = reaches->blocks.data[block].nextOfFrame;
    reaches->freeBlocks -= 1;
    return block;
}

int32_t kiriReaches_Add(kiriReaches* reaches, int32_t label, int32_t cells)
{
    KIRI_ASSERT(label >= 0 && label < reaches->ofLabel.count);
    int32_t index = TakeBlock(reaches), next = reaches->ofLabel.data[label];
    kiriReachBlock* block = &reaches->blocks.data[index];
    reaches->heads.data[index] = (kiriReachHead){ label, reaches->ofCells.data[cells] };
    block->cells = cells;
    block->nextOfFrame = next;
    block->previousOfFrame = KIRI_NONE;
    for (int32_t k = 0; k < KIRI_BLOCK_CELLS; ++k) {
        block->fromSite[k] = block->fromBorder[k] = KIRI_FAR;
    }
    if (next != KIRI_NONE) {
        reaches->blocks.data[next].previousOfFrame = index;
    }
    reaches->ofCells.data[cells] = reaches->ofLabel.data[label] = index;
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
        reaches->ofLabel.data[head->label] = block->nextOfFrame;
    }
    head->label = KIRI_NONE;
    block->nextOfFrame = reaches->freeBlock;
    reaches->freeBlock = index;
    reaches->freeBlocks += 1;
}

void kiriReaches_Forget(kiriReaches* reaches, int32_t label)
{
    KIRI_ASSERT(label >= 0 && label < reaches->ofLabel.count);
    while (reaches->ofLabel.data[label] != KIRI_NONE) {
        kiriReaches_Remove(reaches, reaches->ofLabel.data[label]);
    }
}

void kiriReaches_Relabel(kiriReaches* reaches, const kiriKeep* labels)
{
    for (int32_t label = labels->first; label < reaches->ofLabel.count; ++label) {
        int32_t to = kiriKeep_To(labels, label);
        KIRI_ASSERT(to != KIRI_NONE || reaches->ofLabel.data[label] == KIRI_NONE);
        for (int32_t b = reaches->ofLabel.data[label]; b != KIRI_NONE; b = reaches->blocks.data[b].nextOfFrame) {
            reaches->heads.data[b].label = to;
        }
    }
    kiriKeep_Compact(labels, &reaches->ofLabel, 1, sizeof(int32_t));
}

/* ---- What a frame reaches ---------------------------------------------------------------------------------------- */

static kiriReach NextReach(const kiriReaches* reaches, int32_t block, int32_t k)
{
    for (; block != KIRI_NONE; block = reaches->blocks.data[block].nextOfFrame, k = 0) {
        const kiriReachBlock* at = &reaches->blocks.data[block];
        for (; k < KIRI_BLOCK_CELLS; ++k) {
            if (at->fromSite[k] != KIRI_FAR) {
                return (kiriReach){ at->cells * KIRI_BLOCK_CELLS + k, at->fromSite[k], at->fromBorder[k], block };
            }
        }
    }
    return (kiriReach){ KIRI_NONE, KIRI_FAR, KIRI_FAR, KIRI_NONE };
}

kiriReach kiriReaches_First(const kiriReaches* reaches, int32_t label)
{
    KIRI_ASSERT(label >= 0 && label < reaches->ofLabel.count);
    return NextReach(reaches, reaches->ofLabel.data[label], 0);
}

kiriReach kiriReaches_After(const kiriReaches* reaches, kiriReach reach)
{
    return NextReach(reaches, reach.block, reach.cell % KIRI_BLOCK_CELLS + 1);
}
