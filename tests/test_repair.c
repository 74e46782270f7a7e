/* Repairs of distances, on nets made by hand: cells on a square lattice, up to two a square, with random steps
   between them; against Dijkstra without a heap. */
#include "field/kiri_geodesic.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

enum { SIDE = 10, MOST = 2 * SIDE * SIDE };

typedef struct Net {
    kiriMemory memory;
    int32_t blocks, untilFailure; /* live ones; allocations that succeed yet, or -1 */
    int32_t count;                /* of cells */
    uint8_t linked[MOST][MOST];
    kiriSeed seeds[MOST];
    uint8_t blocked[MOST];
    int32_t farthest[MOST]; /* from which a way passes on */
    bool passes;            /* whether there is a rule at all */
    kiriGrid grid;
    kiriField field;
    kiriRule rule;
} Net;

static void* NetAlloc(void* user, int64_t bytes)
{
    Net* net = user;
    if (net->untilFailure == 0) {
        return NULL;
    }
    net->untilFailure -= net->untilFailure > 0;
    ++net->blocks;
    return malloc((size_t)bytes);
}

static void NetFree(void* user, void* pointer)
{
    --((Net*)user)->blocks;
    free(pointer);
}

static bool NetPass(const void* context, int32_t cell)
{
    const Net* net = context;
    return !net->blocked[cell] && net->field.distance.data[cell] <= net->farthest[cell];
}

static kiriSeed NetSeed(const void* context, int32_t cell)
{
    return ((const Net*)context)->seeds[cell];
}

/* How long a step between the squares of two cells is, or 0 if there can be none. */
static int32_t LengthBetween(int32_t a, int32_t b)
{
    int32_t x = abs(a / 2 % SIDE - b / 2 % SIDE), y = abs(a / 2 / SIDE - b / 2 / SIDE);
    return x + y == 1                                 ? KIRI_UNIT
           : x == 1 && y == 1                         ? KIRI_UNIT_DIAGONAL
           : (x == 1 && y == 2) || (x == 2 && y == 1) ? KIRI_UNIT_KNIGHT
                                                      : 0;
}

static void Link(Net* net, int32_t a, int32_t b, uint8_t linked)
{
    net->linked[a][b] = net->linked[b][a] = linked;
}

/* Writes the steps of the grid anew. */
static void MakeSteps(Net* net)
{
    static const int32_t lengths[] = { KIRI_UNIT, KIRI_UNIT_DIAGONAL, KIRI_UNIT_KNIGHT };
    net->grid.steps.count = 0;
    assert_true(kiriArray_Resize(&net->memory, &net->grid.runs, net->count));
    for (int32_t a = 0; a < net->count; ++a) {
        net->grid.runs.data[a].first = net->grid.steps.count;
        for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
            for (int32_t b = 0; b < net->count; ++b) {
                kiriStep step = { b, (int16_t)lengths[k], 0, 0 };
                if (net->linked[a][b] && LengthBetween(a, b) == lengths[k]) {
                    assert_true(kiriArray_Push(&net->memory, &net->grid.steps, step));
                }
            }
            net->grid.runs.data[a].end[k] = net->grid.steps.count;
        }
    }
}

static void Open(Net* net, int32_t count, double share, uint32_t* seed)
{
    memset(net, 0, sizeof(*net));
    net->memory = kiriMemory_Make(NetAlloc, NetFree, net);
    net->untilFailure = -1;
    net->count = count;
    net->rule = (kiriRule){ &net->grid, KIRI_FAR, NULL, NetSeed, net, NULL, { NULL, NULL } };
    for (int32_t a = 0; a < MOST; ++a) {
        net->seeds[a] = (kiriSeed){ a, KIRI_FAR, KIRI_NONE };
        net->farthest[a] = KIRI_FAR;
        for (int32_t b = 0; b < a && a < count; ++b) {
            Link(net, a, b, LengthBetween(a, b) > 0 && RandomBetween(seed, 0.0, 1.0) < share);
        }
    }
    MakeSteps(net);
    assert_true(kiriField_Resize(&net->field, &net->memory, count));
}

static void Close(Net* net)
{
    kiriMemory_FreeAll(&net->memory);
    assert_int_equal(net->blocks, 0);
}

static void FloodNet(Net* net)
{
    kiriSeed seeds[MOST];
    int32_t count = 0;
    for (int32_t c = 0; c < net->count; ++c) {
        if (net->seeds[c].distance != KIRI_FAR) {
            seeds[count++] = net->seeds[c];
        }
    }
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    assert_true(kiriField_Start(&net->field, &net->memory, seeds, count));
    assert_int_equal(kiriField_Flood(&net->field, &net->rule, &quota), KIRI_DONE);
    assert_int_equal(quota.used, net->field.settled.count);
}

/* ---- The right answer -------------------------------------------------------------------------------------------- */

typedef struct Values {
    int32_t distance[MOST], owner[MOST];
} Values;

static void Offer(const Net* net, Values* values, int32_t cell, int64_t distance, int32_t owner)
{
    if (distance <= net->rule.limit && distance < KIRI_FAR &&
        (distance < values->distance[cell] || (distance == values->distance[cell] && owner < values->owner[cell]))) {
        values->distance[cell] = (int32_t)distance;
        values->owner[cell] = owner;
    }
}

static void Solve(const Net* net, Values* values)
{
    bool done[MOST] = { false };
    for (int32_t c = 0; c < net->count; ++c) {
        values->distance[c] = KIRI_FAR;
        values->owner[c] = KIRI_NONE;
        Offer(net, values, c, net->seeds[c].distance, net->seeds[c].owner);
    }
    for (;;) {
        int32_t next = KIRI_NONE;
        for (int32_t c = 0; c < net->count; ++c) {
            if (!done[c] && values->distance[c] != KIRI_FAR &&
                (next == KIRI_NONE || values->distance[c] < values->distance[next])) {
                next = c;
            }
        }
        if (next == KIRI_NONE) {
            return;
        }
        done[next] = true;
        if (net->passes && (net->blocked[next] || values->distance[next] > net->farthest[next])) {
            continue;
        }
        for (int32_t c = 0; c < net->count; ++c) {
            if (net->linked[next][c]) {
                Offer(net, values, c, (int64_t)values->distance[next] + LengthBetween(next, c), values->owner[next]);
            }
        }
    }
}

static Values ValuesOf(const Net* net)
{
    Values values;
    memcpy(values.distance, net->field.distance.data, sizeof(int32_t) * (size_t)net->field.distance.count);
    memcpy(values.owner, net->field.owner.data, sizeof(int32_t) * (size_t)net->field.owner.count);
    return values;
}

static void CheckField(const Net* net)
{
    Values values;
    Solve(net, &values);
    assert_memory_equal(values.distance, net->field.distance.data, sizeof(int32_t) * (size_t)net->count);
    assert_memory_equal(values.owner, net->field.owner.data, sizeof(int32_t) * (size_t)net->count);
}

/* All that is not as it was before is in the log, once, with what it was. Returns how many cells changed. */
static int32_t CheckLog(const Net* net, const Values* before)
{
    bool logged[MOST] = { false };
    int32_t changed = 0;
    for (int32_t i = 0; i < net->field.log.count; ++i) {
        kiriSeed was = net->field.log.data[i];
        assert_false(logged[was.cell]);
        logged[was.cell] = true;
        assert_int_equal(was.distance, before->distance[was.cell]);
        assert_int_equal(was.owner, before->owner[was.cell]);
    }
    for (int32_t c = 0; c < net->count; ++c) {
        bool same = net->field.distance.data[c] == before->distance[c] && net->field.owner.data[c] == before->owner[c];
        assert_true(same || logged[c]);
        changed += !same;
    }
    return changed;
}

/* ---- Changes ----------------------------------------------------------------------------------------------------- */

static int32_t AnyCell(const Net* net, uint32_t* seed)
{
    return (int32_t)(Random(seed) % (uint32_t)net->count);
}

/* Its steps or its seed have changed, but not whether ways pass: that may be said, or not. */
static void MarkStepsDirty(Net* net, int32_t cell, uint32_t* seed)
{
    (Random(seed) % 8 == 0 ? kiriField_MarkDirty : kiriField_MarkStepsDirty)(&net->field, cell);
}

/* Steps come and go around a cell, as around the tip of a blade. */
static void ChangeSteps(Net* net, uint32_t* seed)
{
    int32_t a = AnyCell(net, seed);
    for (int32_t b = 0; b < net->count; ++b) {
        if (LengthBetween(a, b) > 0 && Random(seed) % 3 == 0) {
            Link(net, a, b, !net->linked[a][b]);
            MarkStepsDirty(net, a, seed);
            MarkStepsDirty(net, b, seed);
        }
    }
}

/* A whole line of them, as by a long cut. */
static void CutNet(Net* net, uint32_t* seed)
{
    int32_t line = (int32_t)(Random(seed) % (SIDE - 1)), from = (int32_t)(Random(seed) % SIDE);
    bool across = Random(seed) % 2 == 0;
    for (int32_t a = 0; a < net->count; ++a) {
        for (int32_t b = 0; b < net->count; ++b) {
            int32_t x = across ? a / 2 % SIDE : a / 2 / SIDE, y = across ? b / 2 % SIDE : b / 2 / SIDE;
            int32_t along = across ? a / 2 / SIDE : a / 2 % SIDE;
            if (net->linked[a][b] && x <= line && y > line && along >= from) {
                Link(net, a, b, 0);
                MarkStepsDirty(net, a, seed);
                MarkStepsDirty(net, b, seed);
            }
        }
    }
}

static void ChangeSeed(Net* net, uint32_t* seed)
{
    int32_t c = AnyCell(net, seed);
    kiriSeed none = { c, KIRI_FAR, KIRI_NONE };
    kiriSeed some = { c, (int32_t)(Random(seed) % 500), (int32_t)(Random(seed) % 4) };
    net->seeds[c] = net->seeds[c].distance == KIRI_FAR ? some : none;
    MarkStepsDirty(net, c, seed);
}

static void ChangePass(Net* net, uint32_t* seed)
{
    int32_t c = AnyCell(net, seed);
    net->blocked[c] = !net->blocked[c];
    net->farthest[c] = (int32_t)(Random(seed) % 4000);
    kiriField_MarkDirty(&net->field, c);
}

static void ChangeLimit(Net* net, uint32_t* seed)
{
    int32_t old = net->rule.limit, now = (int32_t)(Random(seed) % 5000);
    net->rule.limit = Random(seed) % 8 == 0 ? KIRI_FAR : now;
    for (int32_t c = 0; c < net->count; ++c) {
        int32_t distance = net->field.distance.data[c];
        if (distance != KIRI_FAR && distance > net->rule.limit) {
            (old % 2 == 0 ? kiriField_Forget : kiriField_MarkDirty)(&net->field, c);
        } else if (distance != KIRI_FAR && old < KIRI_FAR && distance > old - KIRI_UNIT_KNIGHT) {
            kiriField_MarkDirty(&net->field, c);
        }
        if (net->seeds[c].distance != KIRI_FAR && net->seeds[c].distance > old) {
            kiriField_MarkDirty(&net->field, c);
        }
    }
}

/* A cell goes, and comes again with other steps. */
static void ReplaceCell(Net* net, uint32_t* seed)
{
    int32_t a = AnyCell(net, seed);
    net->seeds[a].distance = KIRI_FAR;
    for (int32_t b = 0; b < net->count; ++b) {
        if (net->linked[a][b]) {
            Link(net, a, b, 0);
            MarkStepsDirty(net, b, seed);
        }
    }
    kiriField_Forget(&net->field, a);
    if (Random(seed) % 2 == 0) {
        for (int32_t b = 0; b < net->count; ++b) {
            if (LengthBetween(a, b) > 0 && Random(seed) % 2 == 0) {
                Link(net, a, b, 1);
                MarkStepsDirty(net, b, seed);
            }
        }
        MarkStepsDirty(net, a, seed);
    }
}

static void AddCell(Net* net, uint32_t* seed)
{
    if (net->count < MOST) {
        int32_t a = net->count++;
        assert_true(kiriField_Resize(&net->field, &net->memory, net->count));
        assert_int_equal(net->field.distance.data[a], KIRI_FAR);
        for (int32_t b = 0; b < a; ++b) {
            if (LengthBetween(a, b) > 0 && Random(seed) % 2 == 0) {
                Link(net, a, b, 1);
                MarkStepsDirty(net, b, seed);
            }
        }
        MarkStepsDirty(net, a, seed);
    }
}

static void Change(Net* net, uint32_t* seed)
{
    static void (*const changes[])(Net*, uint32_t*) = { ChangeSteps, ChangeSteps, CutNet,  ChangeSeed,
                                                        ChangePass,  ChangeLimit, AddCell, ReplaceCell };
    for (int32_t n = 1 + (int32_t)(Random(seed) % 3); n-- > 0;) {
        changes[Random(seed) % (sizeof(changes) / sizeof(changes[0]))](net, seed);
    }
    MakeSteps(net);
}

/* With quotas of so many items. Returns how many were used. */
static int64_t Repair(Net* net, int64_t items)
{
    int64_t used = 0;
    for (;;) {
        kiriQuota quota = { items, 0, 0, false };
        kiriProgress progress = kiriField_Repair(&net->field, &net->memory, &net->rule, &quota);
        assert_int_not_equal(progress, KIRI_FAILED);
        assert_true(quota.left >= 0 && quota.used - items < 64);
        used += quota.used;
        if (progress == KIRI_DONE) {
            return used;
        }
        assert_true(quota.used > 0 && quota.left < 2); /* a cell that settles again takes 2 */
    }
}

static void CheckAtRest(const Net* net)
{
    assert_int_equal(net->field.dirty.count, 0);
    assert_int_equal(net->field.settled.count, 0);
    assert_int_equal(net->field.heap.count, 0);
    for (int32_t c = 0; c < net->count; ++c) {
        assert_int_equal(net->field.marks.data[c], 0);
    }
}

static void OpenRandomly(Net* net, int round, uint32_t* seed)
{
    Open(net, round % 3 == 0 ? MOST : 1 + (int32_t)(Random(seed) % MOST), round % 2 == 0 ? 0.8 : 0.3, seed);
    for (int k = 0; k < 4; ++k) {
        ChangeSeed(net, seed);
    }
    net->passes = round % 4 >= 2;
    net->rule.pass = net->passes ? NetPass : NULL;
    net->field.dirty.count = 0;
    memset(net->field.marks.data, 0, (size_t)net->count);
    FloodNet(net);
    CheckField(net);
}

/* ---- Tests ------------------------------------------------------------------------------------------------------- */

static void RepairedEqualsFlooded(void** state)
{
    (void)state;
    uint32_t seed = 77;
    static Net net;
    int32_t changed = 0, logged = 0;
    int64_t used = 0;
    for (int round = 0; round < 60; ++round) {
        OpenRandomly(&net, round, &seed);
        for (int k = 0; k < 30; ++k) {
            Change(&net, &seed);
            Values before = ValuesOf(&net);
            int32_t dirty = net.field.dirty.count;
            int64_t items = Repair(&net, k % 3 == 0 ? 1 + k % 5 : INT64_MAX / 2);
            CheckField(&net);
            changed += CheckLog(&net, &before);
            assert_true(items <= 8 * (net.field.log.count + dirty));
            used += items - 2 * dirty;
            logged += net.field.log.count;
            net.field.log.count = 0;
            CheckAtRest(&net);
        }
        Close(&net);
    }
    assert_true(changed > 20000);
    assert_true(logged < changed + changed / 4); /* hardly more than what had to change, */
    assert_true(used < 3 * changed);             /* each taken away, looked at and given */
}

/* The log may wait: several repairs, and still each cell once, with what it was before the first. */
static void LogAddsUp(void** state)
{
    (void)state;
    uint32_t seed = 5;
    static Net net;
    for (int round = 0; round < 30; ++round) {
        OpenRandomly(&net, round, &seed);
        Values before = ValuesOf(&net);
        for (int k = 0; k < 6; ++k) {
            ChangeSteps(&net, &seed);
            ChangeSeed(&net, &seed);
            MakeSteps(&net);
            Repair(&net, 7);
        }
        CheckField(&net);
        CheckLog(&net, &before);
        Close(&net);
    }
}

/* A repair from nothing: all that has a seed is a suspect. */
static void RepairsFromNothing(void** state)
{
    (void)state;
    uint32_t seed = 9;
    static Net net;
    Open(&net, MOST, 0.5, &seed);
    for (int k = 0; k < 9; ++k) {
        ChangeSeed(&net, &seed);
    }
    Repair(&net, 3);
    CheckField(&net);
    kiriField_Clear(&net.field);
    assert_true(kiriField_Resize(&net.field, &net.memory, net.count));
    for (int32_t c = 0; c < net.count; ++c) {
        assert_int_equal(net.field.distance.data[c], KIRI_FAR);
        assert_int_equal(net.field.owner.data[c], KIRI_NONE);
    }
    FloodNet(&net);
    CheckField(&net);
    Close(&net);
}

/* Where a change is felt nearby only, the work is small, however large the field. */
static void WorkIsLocal(void** state)
{
    (void)state;
    uint32_t seed = 3;
    static Net net;
    Open(&net, MOST, 1.1, &seed);
    net.seeds[0] = (kiriSeed){ 0, 0, 0 };
    FloodNet(&net);
    int32_t corner = MOST - 1;
    for (int32_t b = 0; b < net.count; ++b) {
        if (net.linked[corner][b]) {
            Link(&net, corner, b, 0);
            kiriField_MarkDirty(&net.field, b);
        }
    }
    kiriField_MarkDirty(&net.field, corner);
    MakeSteps(&net);
    int32_t dirty = net.field.dirty.count;
    assert_true(Repair(&net, INT64_MAX) <= 4 * dirty); /* one checked, one looked at, and two for what is settled */
    assert_int_equal(net.field.log.count, 1);
    assert_int_equal(net.field.distance.data[corner], KIRI_FAR);
    CheckField(&net);
    Close(&net);
}

/* Floods with quotas of a few cells are those with one of many. */
static void FloodsInSlices(void** state)
{
    (void)state;
    uint32_t seed = 21;
    static Net net;
    for (int round = 0; round < 40; ++round) {
        OpenRandomly(&net, round, &seed);
        int32_t settled[MOST], count = net.field.settled.count;
        memcpy(settled, net.field.settled.data, sizeof(int32_t) * (size_t)count);
        kiriField_Reset(&net.field);
        kiriSeed seeds[MOST];
        int32_t seedCount = 0, slices = 0;
        for (int32_t c = 0; c < net.count; ++c) {
            if (net.seeds[c].distance != KIRI_FAR) {
                seeds[seedCount++] = net.seeds[c];
            }
        }
        kiriQuota quota = { 2, 0, 0, false };
        assert_true(kiriField_Start(&net.field, &net.memory, seeds, seedCount));
        for (; kiriField_Flood(&net.field, &net.rule, &quota) == KIRI_MORE; ++slices) {
            assert_int_equal(quota.left, 0);
            quota.left = 2;
        }
        assert_true(slices > count / 50);
        assert_int_equal(quota.used, count);
        assert_int_equal(net.field.settled.count, count);
        assert_memory_equal(settled, net.field.settled.data, sizeof(int32_t) * (size_t)count);
        CheckField(&net);
        Close(&net);
    }
}

static void FailsCleanly(void** state)
{
    (void)state;
    uint32_t seed = 33;
    static Net net;
    int failed = 0;
    for (int round = 0; round < 60; ++round) {
        OpenRandomly(&net, round, &seed);
        kiriArray_Release(&net.memory, &net.field.heap);
        Change(&net, &seed);
        kiriQuota quota = { INT64_MAX, 0, 0, false };
        net.untilFailure = round % 2;
        kiriProgress progress = kiriField_Repair(&net.field, &net.memory, &net.rule, &quota);
        net.untilFailure = -1;
        if (progress == KIRI_FAILED) {
            ++failed;
            kiriField_Clear(&net.field);
            assert_true(kiriField_Resize(&net.field, &net.memory, net.count));
            FloodNet(&net);
        }
        CheckField(&net);
        Close(&net);
    }
    assert_true(failed > 25);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(RepairedEqualsFlooded), cmocka_unit_test(LogAddsUp),      cmocka_unit_test(RepairsFromNothing),
        cmocka_unit_test(WorkIsLocal),           cmocka_unit_test(FloodsInSlices), cmocka_unit_test(FailsCleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
