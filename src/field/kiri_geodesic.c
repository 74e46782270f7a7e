#include "kiri_geodesic.h"

static const int32_t stepLengths[KIRI_STEP_LENGTHS] = { KIRI_UNIT, KIRI_UNIT_DIAGONAL, KIRI_UNIT_KNIGHT };
enum { FROM_SEED = KIRI_STEP_LENGTHS, FROM_NOWHERE };

/* Marks of cells while a field is repaired. */
enum {
    SUSPECT = 1, /* waits to be checked */
    LOGGED = 2,
    GIVEN = 4, /* in `settled` */
};

/* What the cursors mean: in a sweep the first three go over the settled cells, one a length of steps; before it: */
enum {
    CHECKED,  /* suspects that were checked */
    SUSPECTS, /* how many the caller had; those behind are dependents */
    STAGE = KIRI_STEP_LENGTHS,
};
enum { AT_REST, TAKING, GIVING }; /* stages of a repair */

bool kiriField_Resize(kiriField* field, kiriMemory* memory, int32_t cellCount)
{
    if (!kiriArray_Reserve(memory, &field->distance, cellCount) ||
        !kiriArray_Reserve(memory, &field->owner, cellCount) ||
        !kiriArray_Reserve(memory, &field->settled, cellCount) || !kiriArray_Reserve(memory, &field->log, cellCount) ||
        !kiriArray_Reserve(memory, &field->suspects, cellCount) ||
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

void kiriField_Clear(kiriField* field)
{
    field->distance.count = field->owner.count = field->marks.count = 0;
    field->settled.count = field->log.count = field->heap.count = field->suspects.count = 0;
    field->cursor[STAGE] = AT_REST;
}

/* ---- The heap of seeds, nearest on top --------------------------------------------------------------------------- */

static bool IsNearer(kiriSeed a, kiriSeed b)
{
    return a.distance != b.distance ? a.distance < b.distance : a.owner < b.owner;
}

/* Restores the heap below a place that may hold too far a seed. */
static void SinkSeed(kiriField* field, int32_t i)
{
    kiriSeed* seeds = field->heap.data;
    kiriSeed sinking = seeds[i];
    for (int32_t child = 2 * i + 1; child < field->heap.count; child = 2 * i + 1) {
        if (child + 1 < field->heap.count && IsNearer(seeds[child + 1], seeds[child])) {
            ++child;
        }
        if (!IsNearer(seeds[child], sinking)) {
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

/* There are only three lengths of steps, and cells settle by growing distance; so what the steps of one length reach
   is sorted already, and a cursor for each length over the settled cells finds the next. */

/* The first to reach a cell is the nearest. An owner may still get lower until the sweep moves on, which is before
   the cell passes it on, for every step is longer than nothing. */
static void Reach(kiriField* field, int32_t cell, int32_t distance, int32_t owner)
{
    if (field->distance.data[cell] == KIRI_FAR) {
        field->distance.data[cell] = distance;
        field->owner.data[cell] = owner;
        field->settled.data[field->settled.count++] = cell;
    } else if (owner < field->owner.data[cell] && field->distance.data[cell] == distance) {
        field->owner.data[cell] = owner;
    }
}

static kiriSeed ValueOf(const kiriField* field, int32_t cell)
{
    kiriSeed value = { cell, field->distance.data[cell], field->owner.data[cell] };
    return value;
}

/* Each cell is in the log at most once: there is room. */
static void Log(kiriField* field, int32_t cell)
{
    if ((field->marks.data[cell] & LOGGED) == 0) {
        field->marks.data[cell] |= LOGGED;
        field->log.data[field->log.count++] = ValueOf(field, cell);
    }
}

/* Takes a value that is nearer, or one that shall be passed on once more. */
static void Give(kiriField* field, kiriSeed to)
{
    if (IsNearer(to, ValueOf(field, to.cell))) {
        Log(field, to.cell);
        field->distance.data[to.cell] = to.distance;
        field->owner.data[to.cell] = to.owner;
    }
    if ((field->marks.data[to.cell] & GIVEN) == 0) {
        field->marks.data[to.cell] |= GIVEN;
        field->settled.data[field->settled.count++] = to.cell;
    }
}

/* Reach where cells may have kept a value: most have one that is nearer. */
static void ReachAgain(kiriField* field, int32_t cell, int32_t distance, int32_t owner)
{
    int32_t has = field->distance.data[cell];
    if (distance < has || (distance == has && owner < field->owner.data[cell])) {
        Give(field, (kiriSeed){ cell, distance, owner });
    }
}

static int32_t FarthestOf(const kiriRule* rule)
{
    return rule->limit < KIRI_FAR ? rule->limit : KIRI_FAR - 1;
}

static bool Passes(const kiriRule* rule, int32_t cell)
{
    return rule->pass == NULL || rule->pass(rule->context, cell);
}

/* Where the sweep goes on: at which distance, no farther than `limit`, and from which cursor. */
static int NearestSource(const kiriField* field, int32_t limit, int32_t* distance)
{
    int source = FROM_NOWHERE;
    int64_t least = limit;
    for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
        if (field->cursor[k] < field->settled.count) {
            int64_t d = (int64_t)field->distance.data[field->settled.data[field->cursor[k]]] + stepLengths[k];
            if (d <= least) {
                least = d;
                source = k;
            }
        }
    }
    if (field->heap.count > 0 && field->heap.data[0].distance <= least) {
        least = field->heap.data[0].distance;
        source = FROM_SEED;
    }
    *distance = (int32_t)least;
    return source;
}

static void TakeSeed(kiriField* field)
{
    kiriSeed seed = PopSeed(field);
    if (field->cursor[STAGE] == GIVING) {
        /* One that has the very value of a seed is a suspect. */
        if (!IsNearer(ValueOf(field, seed.cell), seed)) {
            Give(field, seed);
        }
    } else {
        Reach(field, seed.cell, seed.distance, seed.owner);
    }
}

/* Takes the steps of one length; false where so many cells are settled before it is through: to take them again does no
   harm. */
static bool TakeSteps(kiriField* field, const kiriRule* rule, int32_t from, int length, int32_t distance, int64_t most)
{
    const kiriStepRun* run = &rule->grid->runs.data[from];
    const kiriStep* steps = rule->grid->steps.data;
    int32_t owner = field->owner.data[from], end = Passes(rule, from) ? run->end[length] : 0;
    int32_t s = length == 0 ? run->first : run->end[length - 1];
    if (field->cursor[STAGE] == GIVING) {
        for (; s < end && field->settled.count < most; ++s) {
            ReachAgain(field, steps[s].cell, distance, owner);
        }
    } else {
        for (; s < end && field->settled.count < most; ++s) {
            Reach(field, steps[s].cell, distance, owner);
        }
    }
    return s >= end;
}

/* Until nothing is left, or as many cells are settled as the quota has. */
static kiriProgress Sweep(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    int32_t before = field->settled.count, farthest = FarthestOf(rule), distance;
    int64_t most = quota->left < INT32_MAX ? before + quota->left : INT64_MAX;
    int source = NearestSource(field, farthest, &distance);
    while (source != FROM_NOWHERE && field->settled.count < most) {
        if (source == FROM_SEED) {
            TakeSeed(field);
        } else {
            int32_t from = field->settled.data[field->cursor[source]], passed = field->distance.data[from];
            /* All that lie at this distance: saves asking for the source again. */
            while (from != KIRI_NONE && field->distance.data[from] == passed &&
                   TakeSteps(field, rule, from, source, distance, most)) {
                bool more = ++field->cursor[source] < field->settled.count;
                from = more ? field->settled.data[field->cursor[source]] : KIRI_NONE;
            }
        }
        source = NearestSource(field, farthest, &distance);
    }
    kiriQuota_Take(quota, field->settled.count - before);
    return source == FROM_NOWHERE ? KIRI_DONE : KIRI_MORE;
}

bool kiriField_Start(kiriField* field, kiriMemory* memory, const kiriSeed* seeds, int32_t seedCount)
{
    field->heap.count = 0;
    if (!kiriArray_Resize(memory, &field->heap, seedCount)) {
        return false;
    }
    for (int32_t i = 0; i < seedCount; ++i) {
        field->heap.data[i] = seeds[i];
    }
    MakeHeap(field);
    field->cursor[0] = field->cursor[1] = field->cursor[2] = 0;
    field->cursor[STAGE] = AT_REST;
    return true;
}

kiriProgress kiriField_Flood(kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    return Sweep(field, rule, quota);
}

/* ---- Repairs ----------------------------------------------------------------------------------------------------- */

void kiriField_MarkDirty(kiriField* field, int32_t cell)
{
    if ((field->marks.data[cell] & SUSPECT) == 0) {
        field->marks.data[cell] |= SUSPECT;
        field->suspects.data[field->suspects.count++] = cell;
    }
}

void kiriField_Forget(kiriField* field, int32_t cell)
{
    field->distance.data[cell] = KIRI_FAR;
    field->owner.data[cell] = KIRI_NONE;
}

/* Does the cell have its value from its seed, or from a neighbour? No step is shorter than nothing, so no ring of
   cells can have its values from itself. */
static bool IsGiven(const kiriField* field, const kiriRule* rule, int32_t cell)
{
    const kiriStepRun* run = &rule->grid->runs.data[cell];
    kiriSeed value = ValueOf(field, cell);
    if (value.distance > FarthestOf(rule)) {
        return false;
    }
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = rule->grid->steps.data[s];
        if (field->distance.data[step.cell] == value.distance - step.length &&
            field->owner.data[step.cell] == value.owner && Passes(rule, step.cell)) {
            return true;
        }
    }
    kiriSeed seed = rule->seed(rule->context, cell);
    return seed.distance == value.distance && seed.owner == value.owner;
}

/* Suspects the cells that may have their value from this one. */
static bool SuspectDependents(kiriField* field, kiriMemory* memory, const kiriRule* rule, int32_t cell)
{
    const kiriStepRun* run = &rule->grid->runs.data[cell];
    kiriSeed value = ValueOf(field, cell);
    if (!kiriArray_Reserve(memory, &field->suspects,
                           (int64_t)field->suspects.count + run->end[KIRI_STEP_LENGTHS - 1] - run->first)) {
        return false;
    }
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = rule->grid->steps.data[s];
        int32_t distance = field->distance.data[step.cell];
        if (distance != KIRI_FAR && distance - step.length == value.distance &&
            field->owner.data[step.cell] == value.owner) {
            kiriField_MarkDirty(field, step.cell);
        }
    }
    return true;
}

/* Takes away what nothing gives any more; what is left are ways that still exist, if not the shortest. Of the
   caller's suspects only: where ways do not pass (any longer), dependents may have lost theirs. */
static kiriProgress TakeAway(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
{
    for (; field->cursor[CHECKED] < field->suspects.count; ++field->cursor[CHECKED]) {
        int32_t cell = field->suspects.data[field->cursor[CHECKED]];
        if (field->distance.data[cell] != KIRI_FAR) {
            bool given = IsGiven(field, rule, cell);
            bool blocked = field->cursor[CHECKED] < field->cursor[SUSPECTS] && !Passes(rule, cell);
            if (!given && !kiriQuota_Take(quota, 1)) {
                return KIRI_MORE;
            }
            if ((!given || blocked) && !SuspectDependents(field, memory, rule, cell)) {
                return KIRI_FAILED;
            }
            if (!given) {
                Log(field, cell);
                kiriField_Forget(field, cell);
            }
        }
        field->marks.data[cell] &= (uint8_t)~SUSPECT;
    }
    return KIRI_DONE;
}

/* The best that seed and neighbours give the cell, or what it has. */
static kiriSeed BestOf(const kiriField* field, const kiriRule* rule, int32_t cell)
{
    const kiriStepRun* run = &rule->grid->runs.data[cell];
    kiriSeed best = rule->seed(rule->context, cell), value = ValueOf(field, cell);
    int32_t farthest = FarthestOf(rule);
    best = best.distance <= farthest && IsNearer(best, value) ? best : value;
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = rule->grid->steps.data[s];
        if (field->distance.data[step.cell] <= farthest - step.length) {
            kiriSeed over = { cell, field->distance.data[step.cell] + step.length, field->owner.data[step.cell] };
            best = IsNearer(over, best) && Passes(rule, step.cell) ? over : best;
        }
    }
    return best;
}

/* The seeds of the sweep: all that is known at the rim of what was taken away, and at suspects, which may reach
   farther now than they did. */
static bool SeedSweep(kiriField* field, kiriMemory* memory, const kiriRule* rule)
{
    field->heap.count = 0;
    if (!kiriArray_Reserve(memory, &field->heap, field->suspects.count)) {
        return false;
    }
    for (int32_t i = 0; i < field->suspects.count; ++i) {
        int32_t cell = field->suspects.data[i];
        if (i < field->cursor[SUSPECTS] || field->distance.data[cell] == KIRI_FAR) {
            kiriSeed best = BestOf(field, rule, cell);
            if (best.distance != KIRI_FAR) {
                field->heap.data[field->heap.count++] = best;
            }
        }
    }
    MakeHeap(field);
    field->suspects.count = field->settled.count = 0;
    field->cursor[0] = field->cursor[1] = field->cursor[2] = 0;
    field->cursor[STAGE] = GIVING;
    return true;
}

static void Begin(kiriField* field)
{
    for (int32_t i = 0; i < field->log.count; ++i) {
        field->marks.data[field->log.data[i].cell] |= LOGGED;
    }
    field->cursor[CHECKED] = 0;
    field->cursor[SUSPECTS] = field->suspects.count;
    field->cursor[STAGE] = TAKING;
}

static void End(kiriField* field)
{
    for (int32_t i = 0; i < field->log.count; ++i) {
        field->marks.data[field->log.data[i].cell] = 0;
    }
    for (int32_t i = 0; i < field->settled.count; ++i) {
        field->marks.data[field->settled.data[i]] = 0;
    }
    field->settled.count = 0;
    field->cursor[STAGE] = AT_REST;
}

kiriProgress kiriField_Repair(kiriField* field, kiriMemory* memory, const kiriRule* rule, kiriQuota* quota)
{
    if (field->cursor[STAGE] == AT_REST) {
        Begin(field);
    }
    if (field->cursor[STAGE] == TAKING) {
        kiriProgress progress = TakeAway(field, memory, rule, quota);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (!SeedSweep(field, memory, rule)) {
            return KIRI_FAILED;
        }
    }
    if (Sweep(field, rule, quota) == KIRI_MORE) {
        return KIRI_MORE;
    }
    End(field);
    return KIRI_DONE;
}
