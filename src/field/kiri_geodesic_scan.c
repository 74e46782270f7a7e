/* Floods by scanning: all cells in their order, forth and back, each pulls from those before it (Rosenfeld and Pfaltz
   1966, Borgefors 1986). In a sheet without slits and bays all is found in the first two scans. There is no queue,
   and few branches are hard to predict, so it is faster than a sweep. */
#include "kiri_geodesic.h"

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
