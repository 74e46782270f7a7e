/* Arrays, spans, ids, sets, hashes, sorting, rotations, moments: the ground floor, against independent computations. */
#include "core/kiri_archive.h"
#include "core/kiri_pool.h"
#include "core/kiri_array.h"
#include "scene.h"
#include "core/kiri_vec.h"

/* ---- Arrays ---- */

static void ArraysGrow(void** state)
{
    (void)state;
    Purse purse = { -1, 0 };
    kiriMemory memory = kiriMemory_Make(PurseAlloc, PurseFree, &purse);
    KIRI_ARRAY(int64_t) array = { 0 };
    for (int64_t i = 0; i < 1000; ++i) {
        assert_true(kiriArray_Push(&memory, &array, 3 * i));
        assert_true(array.count == i + 1 && array.capacity >= array.count);
    }
    assert_true(kiriArray_Resize(&memory, &array, 2000) && array.count == 2000);
    for (int64_t i = 0; i < 1000; ++i) {
        assert_int_equal(array.data[i], 3 * i);
    }
    int64_t* data = array.data;
    assert_true(kiriArray_Resize(&memory, &array, 5) && kiriArray_Reserve(&memory, &array, 2000));
    assert_true(array.data == data && array.count == 5);
    assert_int_equal(purse.out, 1);
    kiriArray_Release(&memory, &array);
    assert_true(array.data == NULL && array.count == 0 && array.capacity == 0 && purse.out == 0);
    kiriArray_Release(&memory, &array);
}

static void ArraysFail(void** state)
{
    (void)state;
    Purse purse = { 1, 0 };
    kiriMemory memory = kiriMemory_Make(PurseAlloc, PurseFree, &purse);
    KIRI_ARRAY(int32_t) array = { 0 };
    int32_t pushed = 0;
    int64_t tooMany = (int64_t)INT32_MAX + 1;
    while (kiriArray_Push(&memory, &array, pushed)) {
        ++pushed;
    }
    assert_true(pushed > 0 && array.count == pushed && array.capacity == pushed);
    assert_false(kiriArray_Resize(&memory, &array, pushed + 1));
    assert_false(kiriArray_Reserve(&memory, &array, tooMany));
    purse.budget = -1;
    assert_false(kiriArray_Reserve(&memory, &array, tooMany)); /* counts are 32 bits */
    assert_int_equal(array.count, pushed);
    for (int32_t i = 0; i < pushed; ++i) {
        assert_int_equal(array.data[i], i);
    }
    kiriArray_Release(&memory, &array);
    assert_int_equal(purse.out, 0);
}

static void MemoryByDefault(void** state)
{
    (void)state;
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    void* block = kiriMemory_Alloc(&memory, 0);
    assert_true(block != NULL && (uintptr_t)block % 16 == 0);
    kiriMemory_Free(&memory, block);
    kiriMemory_Free(&memory, NULL);
}

/* ---- Ids ---- */

static void PoolsFindWhatIsThere(void** state)
{
    (void)state;
    Purse purse = { -1, 0 };
    kiriMemory memory = kiriMemory_Make(PurseAlloc, PurseFree, &purse);
    kiriPool pools[2];
    int owners[100];
    uint32_t ids[100];
    kiriPool_Init(&pools[0], KIRI_KIND_CUT);
    kiriPool_Init(&pools[1], KIRI_KIND_PIN);
    assert_null(kiriPool_Find(&pools[0], 0));
    for (int i = 0; i < 100; ++i) {
        ids[i] = kiriPool_Add(&pools[0], &memory, &owners[i], i);
        assert_true(ids[i] != 0 && kiriPool_Add(&pools[1], &memory, &owners[i], i) != ids[i]);
    }
    for (int i = 0; i < 100; i += 3) {
        kiriPool_Remove(&pools[0], ids[i]);
        kiriPool_Remove(&pools[0], ids[i]); /* stale: does nothing */
    }
    for (int i = 0; i < 100; ++i) {
        kiriSlot* slot = kiriPool_Find(&pools[0], ids[i]);
        assert_true(i % 3 == 0 ? slot == NULL : slot->owner == &owners[i] && slot->index == i);
        assert_null(kiriPool_Find(&pools[1], ids[i]));
    }
    kiriMemory_FreeAll(&memory);
    kiriMemory_FreeAll(&memory);
    assert_int_equal(purse.out, 0);
}

static int CompareIds(const void* a, const void* b)
{
    uint32_t x = *(const uint32_t*)a, y = *(const uint32_t*)b;
    return x < y ? -1 : x > y;
}

/* One at a time, more often than a slot has generations: slots retire, and no id ever comes twice. */
static void PoolsNeverRepeat(void** state)
{
    (void)state;
    enum { COUNT = 5000 };
    static uint32_t ids[COUNT];
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    kiriPool pool;
    int owner = 0;
    kiriPool_Init(&pool, KIRI_KIND_SHEET);
    for (int i = 0; i < COUNT; ++i) {
        ids[i] = kiriPool_Add(&pool, &memory, &owner, 0);
        for (int j = i > 0 ? i - 1 : 0; j >= 0 && j < i; j -= 97) {
            assert_null(kiriPool_Find(&pool, ids[j]));
        }
        assert_non_null(kiriPool_Find(&pool, ids[i]));
        kiriPool_Remove(&pool, ids[i]);
    }
    assert_int_equal(pool.slots.count, 40); /* 127 generations each: generation 0 is never given */
    qsort(ids, COUNT, sizeof(ids[0]), CompareIds);
    for (int i = 1; i < COUNT; ++i) {
        assert_true(ids[i] != ids[i - 1] && ids[i] != 0);
    }
    kiriMemory_FreeAll(&memory);
}

/* Far more at a time than a world of many small sheets needs, all different, and of one kind. */
static void PoolsHoldManyIds(void** state)
{
    (void)state;
    enum { COUNT = 1 << 19 };
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    kiriPool pool;
    int owner = 0;
    uint32_t* ids = malloc(COUNT * sizeof(uint32_t));
    kiriPool_Init(&pool, KIRI_KIND_FRAME);
    for (int32_t i = 0; i < COUNT; ++i) {
        ids[i] = kiriPool_Add(&pool, &memory, &owner, i);
    }
    for (int32_t i = 0; i < COUNT; ++i) {
        kiriSlot* slot = kiriPool_Find(&pool, ids[i]);
        assert_true(slot != NULL && slot->index == i);
        for (uint32_t kind = 1; kind < 8; ++kind) {
            assert_null(kiriPool_Find(&pool, ids[i] ^ kind << 29));
        }
        if (i % 2 == 0) {
            kiriPool_Remove(&pool, ids[i]);
        }
    }
    qsort(ids, COUNT, sizeof(ids[0]), CompareIds);
    for (int i = 1; i < COUNT; ++i) {
        assert_true(ids[i] != ids[i - 1] && ids[i] != 0);
    }
    assert_true(kiriPool_HasRoom(&pool, (1 << 22) - COUNT / 2));
    assert_false(kiriPool_HasRoom(&pool, (1 << 22) - COUNT / 2 + 1));
    free(ids);
    kiriMemory_FreeAll(&memory);
}

/* All slots given: no more, until one comes back. */
static void PoolsFillUp(void** state)
{
    (void)state;
    enum { MOST = 1 << 22 };
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    kiriPool pool;
    int owner = 0;
    uint32_t id = 0;
    kiriPool_Init(&pool, KIRI_KIND_FRAME);
    assert_true(kiriPool_HasRoom(&pool, MOST));
    assert_false(kiriPool_HasRoom(&pool, (int64_t)1 << 40));
    assert_false(kiriPool_Reserve(&pool, &memory, MOST + 1));
    assert_true(kiriPool_Reserve(&pool, &memory, MOST));
    for (int32_t i = 0; i < MOST; ++i) {
        id = kiriPool_Add(&pool, &memory, &owner, i);
    }
    assert_int_equal(kiriPool_Find(&pool, id)->index, MOST - 1);
    assert_true(kiriPool_HasRoom(&pool, 0));
    for (int generation = 1; generation < 127; ++generation) {
        assert_false(kiriPool_HasRoom(&pool, 1));
        assert_int_equal(kiriPool_Add(&pool, &memory, &owner, 0), 0);
        assert_false(kiriPool_Reserve(&pool, &memory, 1));
        kiriPool_Remove(&pool, id);
        assert_true(kiriPool_HasRoom(&pool, 1));
        assert_true(kiriPool_Reserve(&pool, &memory, 1));
        id = kiriPool_Add(&pool, &memory, &owner, 0);
        assert_int_not_equal(id, 0);
    }
    kiriPool_Remove(&pool, id); /* its last generation: the slot is used up */
    assert_false(kiriPool_HasRoom(&pool, 1));
    kiriMemory_FreeAll(&memory);
}

/* Room or not is not the same as memory or not. */
static void PoolsFail(void** state)
{
    (void)state;
    Purse purse = { 0, 0 };
    kiriMemory memory = kiriMemory_Make(PurseAlloc, PurseFree, &purse);
    kiriPool pool;
    int owner = 0;
    kiriPool_Init(&pool, KIRI_KIND_PIN);
    assert_int_equal(kiriPool_Add(&pool, &memory, &owner, 0), 0);
    assert_false(kiriPool_Reserve(&pool, &memory, 1));
    assert_true(kiriPool_HasRoom(&pool, 1));
    purse.budget = 1;
    assert_true(kiriPool_Reserve(&pool, &memory, 50));
    for (int i = 0; i < 50; ++i) {
        assert_int_not_equal(kiriPool_Add(&pool, &memory, &owner, i), 0); /* cannot fail after Reserve */
    }
    kiriMemory_FreeAll(&memory);
    assert_int_equal(purse.out, 0);
}

/* ---- Spans ---- */

typedef struct Item {
    int32_t owner, number;
    double value;
} Item;

/* Spans that grow and shrink at random keep their items, overlap nowhere, and use room again. */
static void SpansKeepTheirItems(void** state)
{
    (void)state;
    enum { SPANS = 40, MOST = 50 };
    Purse purse = { -1, 0 };
    kiriMemory memory = kiriMemory_Make(PurseAlloc, PurseFree, &purse);
    KIRI_ARRAY(Item) items = { NULL, 0, 0 };
    kiriSpans spans;
    kiriSpan of[SPANS];
    uint32_t seed = 5;
    int32_t refused = 0;
    memset(&spans, 0, sizeof(spans));
    memset(of, 0, sizeof(of));
    for (int round = 0; round < 20000; ++round) {
        int32_t s = (int32_t)(Random(&seed) % SPANS), count = (int32_t)(Random(&seed) % MOST), was = of[s].count;
        purse.budget = Random(&seed) % 4 == 0 ? 0 : -1;
        bool done = kiriSpan_Resize(&of[s], &spans, &memory, &items, sizeof(Item), count);
        assert_true(done || (purse.budget == 0 && count > was));
        refused += !done;
        assert_int_equal(of[s].count, done ? count : was);
        for (int32_t i = 0; i < of[s].count; ++i) {
            Item* item = &items.data[of[s].first + i];
            Item fresh = { s, i, 0.5 * s };
            assert_true(i >= was || (item->owner == s && item->number == i && item->value == 0.5 * s));
            *item = fresh;
        }
    }
    assert_true(refused > 0);
    assert_in_range(items.count, 1, 4 * SPANS * 64);
    for (int32_t s = 0; s < SPANS; ++s) {
        for (int32_t i = 0; i < of[s].count; ++i) {
            assert_int_equal(items.data[of[s].first + i].owner, s);
        }
    }
    kiriMemory_FreeAll(&memory);
}

/* ---- Union-find ---- */

/* Against colours that are painted over. */
static void UnionsFollowColours(void** state)
{
    (void)state;
    enum { COUNT = 200 };
    uint32_t seed = 17;
    for (int round = 0; round < 50; ++round) {
        int32_t parent[COUNT], colour[COUNT], sets = COUNT;
        kiriUnion_Init(parent, COUNT);
        for (int32_t i = 0; i < COUNT; ++i) {
            colour[i] = i;
        }
        for (int k = 0; k < 4 * round; ++k) {
            int32_t i = (int32_t)(Random(&seed) % COUNT), j = (int32_t)(Random(&seed) % COUNT);
            int32_t from = colour[i] > colour[j] ? colour[i] : colour[j];
            int32_t to = colour[i] > colour[j] ? colour[j] : colour[i];
            kiriUnion_Join(parent, i, j);
            sets -= from != to;
            for (int32_t m = 0; m < COUNT; ++m) {
                colour[m] = colour[m] == from ? to : colour[m];
            }
        }
        for (int32_t i = 0; i < COUNT; ++i) {
            assert_int_equal(kiriUnion_Root(parent, i), colour[i]); /* the lowest */
        }
        for (int32_t i = 0; i < COUNT; ++i) {
            sets -= colour[i] == i;
        }
        assert_int_equal(sets, 0);
    }
}

/* ---- Hashes ---- */

static uint64_t HashOf(const char* text)
{
    uint64_t hash = KIRI_HASH_START;
    for (; *text != '\0'; ++text) {
        kiriHash_Word(&hash, (unsigned char)*text);
    }
    return hash;
}

/* The published values of FNV-1a. */
static void HashesAreFnv(void** state)
{
    (void)state;
    assert_true(HashOf("") == UINT64_C(0xcbf29ce484222325));
    assert_true(HashOf("a") == UINT64_C(0xaf63dc4c8601ec8c));
    assert_true(HashOf("foobar") == UINT64_C(0x85944171f73967e8));
    uint64_t hash = HashOf("x"), same = hash;
    kiriHash_Word(&same, 300);
    assert_true(same == (hash ^ 300) * UINT64_C(0x100000001b3));
}

static uint64_t HashOfNumbers(const double* numbers, int count)
{
    uint64_t hash = KIRI_HASH_START;
    for (int i = 0; i < count; ++i) {
        kiriHash_Double(&hash, numbers[i]);
    }
    return hash;
}

/* One bit that differs in each of two numbers, or their order, makes another hash; signs do not cancel out. */
static void HashesTellNumbersApart(void** state)
{
    (void)state;
    double numbers[4] = { 1.0, -0.5, 0.0, 3.25 };
    uint64_t first = HashOfNumbers(numbers, 4), hash = KIRI_HASH_START, same = KIRI_HASH_START;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 64 * 64; ++k) {
            double other[4];
            uint64_t bits[2];
            memcpy(other, numbers, sizeof(other));
            memcpy(bits, &other[i], sizeof(bits));
            bits[0] ^= UINT64_C(1) << k % 64;
            bits[1] ^= UINT64_C(1) << k / 64;
            memcpy(&other[i], bits, sizeof(bits));
            assert_true(HashOfNumbers(other, 4) != first);
        }
    }
    numbers[2] = -0.0;
    assert_true(HashOfNumbers(numbers, 4) != first);
    kiriHash_Int32(&hash, -2);
    kiriHash_Int64(&same, -2);
    assert_true(hash == same);
    kiriHash_Pair(&hash, 1, -2);
    kiriHash_Pair(&same, -2, 1);
    assert_true(hash != same);
}

/* ---- Sorting ---- */

typedef struct Keys {
    int32_t* key;
    int64_t calls;
} Keys;

/* By descending key, then by index. */
static bool HasHigherKey(const void* context, int32_t a, int32_t b)
{
    Keys* keys = (Keys*)context;
    ++keys->calls;
    return keys->key[a] != keys->key[b] ? keys->key[a] > keys->key[b] : a < b;
}

/* Keys in the patterns that sorts dislike. */
static int32_t KeyOf(int pattern, int32_t i, int32_t count, uint32_t* seed)
{
    switch (pattern) {
    case 0:
        return (int32_t)(Random(seed) % 1000000);
    case 1:
        return i;
    case 2:
        return -i;
    case 3:
        return (int32_t)(Random(seed) % 3);
    case 4:
        return i < count / 2 ? i : count - i;
    case 5:
        return i % 2 == 0 ? i : -i;
    case 6:
        return i == count / 2 ? 0 : i;
    default:
        return 7;
    }
}

static void SortsAnything(void** state)
{
    (void)state;
    const int32_t counts[] = { 0, 1, 2, 3, 10, 24, 25, 26, 100, 1000, 30000 };
    uint32_t seed = 23;
    for (size_t c = 0; c < sizeof(counts) / sizeof(counts[0]); ++c) {
        int32_t count = counts[c], *items = malloc(sizeof(int32_t) * (size_t)(count + 1));
        Keys keys = { malloc(sizeof(int32_t) * (size_t)(count + 1)), 0 };
        for (int pattern = 0; pattern < 8; ++pattern) {
            for (int32_t i = 0; i < count; ++i) {
                keys.key[i] = KeyOf(pattern, i, count, &seed);
                items[i] = i;
            }
            keys.calls = 0;
            kiriSort(items, count, HasHigherKey, &keys);
            assert_true((double)keys.calls <= 200.0 + 20.0 * count * log2(count + 1.0));
            for (int32_t i = 1; i < count; ++i) { /* strictly: so each comes once */
                assert_true(HasHigherKey(&keys, items[i - 1], items[i]));
            }
            kiriSort(items, count, NULL, NULL);
            for (int32_t i = 0; i < count; ++i) {
                assert_int_equal(items[i], i);
            }
        }
        free(items);
        free(keys.key);
    }
}

/* Each number as often as it was there, from the lowest on. */
static void SortsNumbers(void** state)
{
    (void)state;
    const int32_t counts[] = { 0, 1, 2, 100, 5000 }, mosts[] = { 0, 1, 2047, 2048, 5000000, INT32_MAX };
    uint32_t seed = 31;
    for (size_t c = 0; c < sizeof(counts) / sizeof(counts[0]); ++c) {
        for (size_t m = 0; m < sizeof(mosts) / sizeof(mosts[0]); ++m) {
            int32_t count = counts[c], items[5000], sorted[5000], room[5000];
            for (int32_t i = 0; i < count; ++i) {
                items[i] = sorted[i] = i == 0 ? mosts[m] : (int32_t)RandomBetween(&seed, 0.0, mosts[m]);
            }
            kiriSort(sorted, count, NULL, NULL);
            kiriSort_Numbers(items, room, count);
            assert_memory_equal(items, sorted, sizeof(int32_t) * (size_t)count);
        }
    }
}

/* ---- Rotations ---- */

static kiriVec3 RandomVec3(uint32_t* seed, double size)
{
    double x = RandomBetween(seed, -size, size), y = RandomBetween(seed, -size, size);
    return kiriVec3_Make(x, y, RandomBetween(seed, -size, size));
}

static double Entry(kiriMat3 m, int row, int column)
{
    kiriVec3 c = column == 0 ? m.u : column == 1 ? m.v : m.d;
    return row == 0 ? c.x : row == 1 ? c.y : c.z;
}

static double Determinant(kiriMat3 m)
{
    return kiriVec3_Dot(m.u, kiriVec3_Cross(m.v, m.d));
}

static void CheckRotation(kiriMat3 r, double tolerance)
{
    const kiriVec3 columns[3] = { r.u, r.v, r.d };
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            assert_true(fabs(kiriVec3_Dot(columns[i], columns[j]) - (i == j)) < tolerance);
        }
    }
    assert_true(fabs(Determinant(r) - 1.0) < tolerance);
}

static void CayleyRotates(void** state)
{
    (void)state;
    uint32_t seed = 12345;
    for (int i = 0; i < 1000; ++i) {
        kiriVec3 w = RandomVec3(&seed, i % 3 == 0 ? 1e-6 : i % 3 == 1 ? 1.0 : 100.0), x = RandomVec3(&seed, 1.0);
        kiriMat3 r = kiriMat3_Cayley(w);
        CheckRotation(r, 1e-13);
        /* Rodrigues' formula, about w by 2 atan(|w| / 2). */
        double angle = 2.0 * atan(0.5 * kiriVec3_Length(w)), c = cos(angle), s = sin(angle);
        kiriVec3 k = kiriVec3_Normalize(w);
        kiriVec3 turned = kiriVec3_AddScaled(kiriVec3_Scale(c, x), s, kiriVec3_Cross(k, x));
        turned = kiriVec3_AddScaled(turned, (1.0 - c) * kiriVec3_Dot(k, x), k);
        assert_true(kiriVec3_Length(kiriVec3_Sub(turned, kiriMat3_Mul(r, x))) < 1e-13);
    }
}

/* R is the nearest rotation to m exactly when R^T m is symmetric with the sum of any two eigenvalues not negative: then
   no small turn makes trace(R^T m) larger. */
static void CheckPolar(kiriMat3 m, double tolerance)
{
    kiriMat3 r = kiriMat3_Rotation(m);
    const kiriVec3 rc[3] = { r.u, r.v, r.d }, mc[3] = { m.u, m.v, m.d };
    double s[3][3], size = 0.0;
    CheckRotation(r, 1e-12);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            s[i][j] = kiriVec3_Dot(rc[i], mc[j]);
            size = fmax(size, fabs(Entry(m, i, j)));
        }
    }
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < i; ++j) {
            if (!(fabs(s[i][j] - s[j][i]) <= tolerance * size)) {
                fail_msg("not symmetric by %g of %g", fabs(s[i][j] - s[j][i]), size);
            }
        }
    }
    /* Turns trace(R^T m) as a quadratic form: trace(s) I - s must have no negative value. Sampled over directions. */
    uint32_t seed = 99;
    double trace = s[0][0] + s[1][1] + s[2][2];
    for (int k = 0; k < 200; ++k) {
        kiriVec3 d = kiriVec3_Normalize(RandomVec3(&seed, 1.0));
        const double v[3] = { d.x, d.y, d.z };
        double form = trace;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                form -= v[i] * s[i][j] * v[j];
            }
        }
        if (!(form >= -1e-9 * size)) {
            fail_msg("not the nearest: %g of %g", form, size);
        }
    }
}

static kiriMat3 RandomRotation(uint32_t* seed)
{
    return kiriMat3_Cayley(RandomVec3(seed, 10.0));
}

static kiriMat3 Stretched(uint32_t* seed, double a, double b, double c)
{
    kiriMat3 q = RandomRotation(seed), p = RandomRotation(seed);
    kiriMat3 d = { { a, 0.0, 0.0 }, { 0.0, b, 0.0 }, { 0.0, 0.0, c } };
    return kiriMat3_MulMat(q, kiriMat3_MulMat(d, p));
}

static void RotationIsPolarFactor(void** state)
{
    (void)state;
    uint32_t seed = 777;
    for (int i = 0; i < 200; ++i) {
        double a = RandomBetween(&seed, 0.3, 3.0), b = RandomBetween(&seed, 0.3, 3.0),
               c = RandomBetween(&seed, 0.3, 3.0);
        kiriMat3 q = RandomRotation(&seed), r = kiriMat3_Rotation(q);
        for (int k = 0; k < 9; ++k) {
            assert_true(fabs(Entry(q, k / 3, k % 3) - Entry(r, k / 3, k % 3)) < 1e-12); /* a rotation is its own */
        }
        CheckPolar(Stretched(&seed, a, b, c), 1e-9);
        CheckPolar(Stretched(&seed, 1e6 * a, 1e6 * b, 1e6 * c), 1e-9);
        CheckPolar(Stretched(&seed, a, b, 1e-3), 1e-6);
    }
}

static void RotationOfSingular(void** state)
{
    (void)state;
    uint32_t seed = 4242;
    const kiriVec3 zero = { 0.0, 0.0, 0.0 }, x = { 1.0, 0.0, 0.0 }, z = { 0.0, 0.0, 1.0 };
    const kiriMat3 special[] = {
        { zero, zero, zero }, { x, x, x },       { x, zero, zero },
        { zero, x, zero },    { zero, zero, x }, { x, zero, z },
        { zero, x, z },       { x, z, zero },    { { 1e-200, 0.0, 0.0 }, { 0.0, 1e-200, 0.0 }, { 0.0, 0.0, 1e-200 } }
    };
    for (size_t i = 0; i < sizeof(special) / sizeof(special[0]); ++i) {
        CheckRotation(kiriMat3_Rotation(special[i]), 1e-12);
    }
    for (int i = 0; i < 200; ++i) {
        double a = RandomBetween(&seed, 0.5, 2.0), b = RandomBetween(&seed, 0.5, 2.0);
        CheckPolar(Stretched(&seed, a, b, 0.0), 1e-6);      /* flat */
        CheckPolar(Stretched(&seed, a, b, -0.1 * a), 1e-6); /* mirrored: the nearest that does not mirror */
        CheckRotation(kiriMat3_Rotation(Stretched(&seed, a, 0.0, 0.0)), 1e-12);
        CheckRotation(kiriMat3_Rotation(Stretched(&seed, -a, -a, -a)), 1e-12);
    }
}

/* ---- Moments ---- */

/* By many small triangles, each taken at its middle. */
static kiriMoments BruteMoments(kiriVec2 a, kiriVec2 b, kiriVec2 c, int n)
{
    kiriMoments m = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    kiriVec2 ab = kiriVec2_Sub(b, a), ac = kiriVec2_Sub(c, a);
    double area = 0.5 * (ab.x * ac.y - ab.y * ac.x) / ((double)n * n);
    for (int i = 0; i < n; ++i) {
        for (int j = 0; i + j < n; ++j) {
            for (int up = 0; up < (i + j + 1 < n ? 2 : 1); ++up) {
                double s = (i + (1.0 + up) / 3.0) / n, t = (j + (1.0 + up) / 3.0) / n;
                double u = a.x + s * ab.x + t * ac.x, v = a.y + s * ab.y + t * ac.y;
                kiriMoments part = { area, area * u, area * v, area * u * u, area * u * v, area * v * v };
                kiriMoments_Add(&m, &part);
            }
        }
    }
    return m;
}

static void CheckMoments(kiriMoments a, kiriMoments b, double tolerance)
{
    assert_true(fabs(a.area - b.area) < tolerance && fabs(a.u - b.u) < tolerance && fabs(a.v - b.v) < tolerance);
    assert_true(fabs(a.uu - b.uu) < tolerance && fabs(a.uv - b.uv) < tolerance && fabs(a.vv - b.vv) < tolerance);
}

static kiriVec2 RandomPlace(uint32_t* seed)
{
    double x = RandomBetween(seed, -1.0, 2.0);
    return kiriVec2_Make(x, RandomBetween(seed, -1.0, 2.0));
}

static void MomentsOfTriangles(void** state)
{
    (void)state;
    uint32_t seed = 31;
    for (int i = 0; i < 50; ++i) {
        kiriVec2 a = RandomPlace(&seed), b = RandomPlace(&seed), c = RandomPlace(&seed), o = RandomPlace(&seed);
        kiriMoments m = kiriMoments_Triangle(a, b, c);
        if (m.area < 0.0) { /* clockwise: triangles of meshes are not */
            kiriVec2 swapped = b;
            b = c;
            c = swapped;
            m = kiriMoments_Triangle(a, b, c);
        }
        CheckMoments(m, BruteMoments(a, b, c, 100), 1e-3);
        /* Exact for the triangle's parts, whatever the parts. */
        kiriVec2 p = kiriVec2_Scale(1.0 / 3.0, kiriVec2_Add(kiriVec2_Add(a, b), c));
        kiriMoments sum = kiriMoments_Triangle(a, b, p), second = kiriMoments_Triangle(b, c, p),
                    third = kiriMoments_Triangle(c, a, p);
        kiriMoments_Add(&sum, &second);
        kiriMoments_Add(&sum, &third);
        CheckMoments(m, sum, 1e-13);
        kiriVec2 center = kiriMoments_Center(&m);
        assert_true(kiriVec2_Length(kiriVec2_Sub(center, p)) < 1e-12);
        CheckMoments(kiriMoments_About(&m, o),
                     kiriMoments_Triangle(kiriVec2_Sub(a, o), kiriVec2_Sub(b, o), kiriVec2_Sub(c, o)), 1e-12);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ArraysGrow),
        cmocka_unit_test(ArraysFail),
        cmocka_unit_test(MemoryByDefault),
        cmocka_unit_test(PoolsFindWhatIsThere),
        cmocka_unit_test(PoolsNeverRepeat),
        cmocka_unit_test(PoolsHoldManyIds),
        cmocka_unit_test(PoolsFillUp),
        cmocka_unit_test(PoolsFail),
        cmocka_unit_test(SpansKeepTheirItems),
        cmocka_unit_test(UnionsFollowColours),
        cmocka_unit_test(HashesAreFnv),
        cmocka_unit_test(HashesTellNumbersApart),
        cmocka_unit_test(SortsAnything),
        cmocka_unit_test(SortsNumbers),
        cmocka_unit_test(CayleyRotates),
        cmocka_unit_test(RotationIsPolarFactor),
        cmocka_unit_test(RotationOfSingular),
        cmocka_unit_test(MomentsOfTriangles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
