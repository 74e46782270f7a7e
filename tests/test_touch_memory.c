/* What touches pushed with, against a list in which each force is put into its place by itself. */
#include "sheet/kiri_touch.h"
#include "support.h"

#include <string.h>

enum { MOST = 400, KEYS = 90, ROUNDS = 40 };

typedef struct PlainForces {
    kiriTouchForce forces[MOST];
    int32_t count;
} PlainForces;

static void PlainForces_Add(PlainForces* plain, uint64_t key, kiriVec3 force)
{
    int32_t at = plain->count++;
    for (; at > 0 && plain->forces[at - 1].key > key; --at) {
        plain->forces[at] = plain->forces[at - 1];
    }
    plain->forces[at].key = key;
    plain->forces[at].force = force;
}

static kiriVec3 PlainForces_Take(PlainForces* plain, uint64_t key)
{
    for (int32_t i = 0; i < plain->count; ++i) {
        if (plain->forces[i].key == key) {
            kiriVec3 force = plain->forces[i].force;
            memmove(&plain->forces[i], &plain->forces[i + 1], sizeof(kiriTouchForce) * (size_t)(plain->count - i - 1));
            plain->count -= 1;
            return force;
        }
    }
    return kiriVec3_Make(0.0, 0.0, 0.0);
}

static void Compare(const kiriTouchMemory* memory, const PlainForces* plain)
{
    assert_int_equal(memory->forces.count, plain->count);
    for (int32_t i = 0; i < plain->count; ++i) {
        assert_true(memory->forces.data[i].key == plain->forces[i].key);
        assert_true(kiriVec3_Equal(memory->forces.data[i].force, plain->forces[i].force));
    }
}

/* Every third one pushes with nothing. */
static void AddSome(kiriTouchMemory* memory, PlainForces* plain, kiriIndices* order, uint32_t* seed)
{
    int32_t first = memory->touches.count;
    for (int32_t n = (int32_t)(Random(seed) % 12); n > 0 && plain->count + 1 < MOST; --n) {
        kiriTouch touch = { .key = (uint64_t)KIRI_TOUCH_HOST << 60 | Random(seed) % KEYS };
        kiriVec3 force = kiriVec3_Make(0.0, Random(seed) % 3 != 0 ? RandomBetween(seed, 0.1, 1.0) : 0.0, 0.0);
        kiriTouchMemory_Add(memory, &touch, force);
        if (force.y > 0.0) {
            PlainForces_Add(plain, touch.key, force);
        }
    }
    kiriTouchMemory_SortForces(memory, first, order);
}

static void TakeSome(kiriTouchMemory* memory, PlainForces* plain, uint32_t* seed)
{
    for (int32_t n = (int32_t)(Random(seed) % 8); n > 0; --n) {
        uint64_t key = (uint64_t)KIRI_TOUCH_HOST << 60 | Random(seed) % KEYS;
        kiriVec3 a = kiriTouchMemory_Take(memory, key), b = PlainForces_Take(plain, key);
        assert_true(kiriVec3_Equal(a, b));
    }
    kiriTouchMemory_DropTaken(memory);
}

TEST(ForcesAreSorted)
{
    kiriMemory owner = kiriMemory_Make(NULL, NULL, NULL);
    kiriTouchMemory memory;
    kiriIndices order = { 0 };
    static PlainForces plain;
    uint32_t seed = 2463534242u;
    memset(&memory, 0, sizeof(memory));
    assert_true(kiriArray_Reserve(&owner, &memory.touches, ROUNDS * 12) &&
                kiriArray_Reserve(&owner, &memory.forces, MOST) && kiriArray_Reserve(&owner, &order, 12));
    for (int32_t round = 0; round < ROUNDS; ++round) {
        AddSome(&memory, &plain, &order, &seed);
        Compare(&memory, &plain);
        TakeSome(&memory, &plain, &seed);
        Compare(&memory, &plain);
    }
    assert_int_equal(memory.given, memory.touches.count);
    kiriMemory_FreeAll(&owner);
}
