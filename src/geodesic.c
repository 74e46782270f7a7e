#include "geodesic.h"

static const int32_t stepLengths[KIRI_STEP_LENGTHS] = { KIRI_UNIT, KIRI_UNIT_DIAGONAL, KIRI_UNIT_KNIGHT };
enum { FROM_SEED = KIRI_STEP_LENGTHS, FROM_NOWHERE };

bool kiriField_Init(kiriField* field, const kiriMemory* memory, int32_t cellCount)
{
    field->settled.count = 0;
    if (!kiriArray_Resize(memory, &field->distance, cellCount) || !kiriArray_Resize(memory, &field->owner, cellCount) ||
        !kiriArray_Reserve(memory, &field->settled, cellCount)) {
        return false;
    }
    for (int32_t c = 0; c < cellCount; ++c) {
        field->distance.data[c] = KIRI_FAR;
        field->owner.data[c] = KIRI_NONE;
    }
    return true;
}

void kiriField_Release(kiriField* field, const kiriMemory* memory)
{
    kiriArray_Release(memory, &field->distance);
    kiriArray_Release(memory, &field->owner);
    kiriArray_Release(memory, &field->settled);
    kiriArray_Release(memory, &field->seeds);
}

void kiriField_Reset(kiriField* field)
{
    for (int32_t i = 0; i < field->settled.count; ++i) {
        field->distance.data[field->settled.data[i]] = KIRI_FAR;
        field->owner.data[field->settled.data[i]] = KIRI_NONE;
    }
    field->settled.count = 0;
}

/* Restores the heap of seeds, nearest on top, below a place that may hold too far a one. */
static void SinkSeed(kiriField* field, int32_t i)
{
    kiriSeed* seeds = field->seeds.data;
    kiriSeed sinking = seeds[i];
    for (int32_t child = 2 * i + 1; child < field->seeds.count; child = 2 * i + 1) {
        if (child + 1 < field->seeds.count && seeds[child + 1].distance < seeds[child].distance) {
            ++child;
        }
        if (seeds[child].distance >= sinking.distance) {
            break;
        }
        seeds[i] = seeds[child];
        i = child;
    }
    seeds[i] = sinking;
}

static kiriSeed PopSeed(kiriField* field)
{
    kiriSeed top = field->seeds.data[0];
    field->seeds.data[0] = field->seeds.data[--field->seeds.count];
    if (field->seeds.count > 0) {
        SinkSeed(field, 0);
    }
    return top;
}

static bool LoadSeeds(kiriField* field, const kiriMemory* memory, const kiriSeed* seeds, int32_t seedCount)
{
    field->seeds.count = 0;
    if (!kiriArray_Resize(memory, &field->seeds, seedCount)) {
        return false;
    }
    for (int32_t i = 0; i < seedCount; ++i) {
        field->seeds.data[i] = seeds[i];
    }
    for (int32_t i = seedCount / 2; i-- > 0;) {
        SinkSeed(field, i);
    }
    return true;
}

/* The sweep goes by growing distance, so the first to reach a cell is the nearest. An owner may still get lower until the
   sweep moves on, which is before the cell passes it on, for every step is longer than nothing. */
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

/* Where the sweep goes on: at which distance, no farther than `limit`, and from which cursor. */
static int NearestSource(const kiriField* field, const int32_t cursor[KIRI_STEP_LENGTHS], int64_t limit,
                         int64_t* distance)
{
    int source = FROM_NOWHERE;
    *distance = limit;
    for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
        if (cursor[k] < field->settled.count) {
            int64_t d = (int64_t)field->distance.data[field->settled.data[cursor[k]]] + stepLengths[k];
            if (d <= *distance) {
                *distance = d;
                source = k;
            }
        }
    }
    if (field->seeds.count > 0 && field->seeds.data[0].distance <= *distance) {
        *distance = field->seeds.data[0].distance;
        source = FROM_SEED;
    }
    return source;
}

static void TakeSteps(kiriField* field, const kiriGrid* grid, int32_t from, int source, int32_t distance, bool pass)
{
    const int32_t* start = &grid->lengthStart.data[KIRI_STEP_LENGTHS * from + source];
    int32_t owner = field->owner.data[from], end = pass ? start[1] : start[0];
    for (int32_t s = start[0]; s < end; ++s) {
        Reach(field, grid->steps.data[s].cell, distance, owner);
    }
}

/* Dijkstra without a queue: there are only three lengths of steps, and cells settle by growing distance; so what the steps
   of one length reach is sorted already, and a cursor for each length over the settled cells finds the next. */
bool kiriField_Flood(kiriField* field, const kiriMemory* memory, const kiriGrid* grid, const kiriSeed* seeds,
                     int32_t seedCount, int32_t limit, kiriPassFn* pass, const void* context)
{
    if (!LoadSeeds(field, memory, seeds, seedCount)) {
        return false;
    }
    int32_t cursor[KIRI_STEP_LENGTHS] = { 0 };
    int64_t farthest = limit < KIRI_FAR ? limit : KIRI_FAR - 1, distance;
    for (;;) {
        int source = NearestSource(field, cursor, farthest, &distance);
        if (source == FROM_NOWHERE) {
            return true;
        }
        if (source == FROM_SEED) {
            kiriSeed seed = PopSeed(field);
            Reach(field, seed.cell, seed.distance, seed.owner);
            continue;
        }
        int32_t from = field->settled.data[cursor[source]];
        int32_t passed = field->distance.data[from];
        do { /* all that lie at this distance: saves asking for the source again */
            TakeSteps(field, grid, from, source, (int32_t)distance, pass == NULL || pass(context, from));
            from = ++cursor[source] < field->settled.count ? field->settled.data[cursor[source]] : KIRI_NONE;
        } while (from != KIRI_NONE && field->distance.data[from] == passed);
    }
}
