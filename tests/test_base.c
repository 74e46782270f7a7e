/* The ground floor: hashes, sorting, rotations, moments, exact sums, tables of fields, and lanes, against independent
   computations. */
#define KIRI_PLAIN_LANES
#define kiriCarriers_Write Plain_WriteCarriers
#define kiriCarriers_Fit Plain_FitCarriers
#define kiriPatches_Reserve Plain_ReservePatches
#define kiriPatches_Write Plain_WritePatches
#define kiriPatches_Forget Plain_ForgetPatches
#define kiriPatches_MayMove Plain_MayMove
#define kiriSkin_WritePositions Plain_WritePositions
#define kiriNormals_TurnOf Plain_TurnOf
#define kiriNormals_Sum Plain_SumNormals
#define kiriNormals_SumOne Plain_SumOneNormal
#define kiriNormals_Write Plain_WriteNormals
#include "view/kiri_skin.c"
#undef kiriCarriers_Write
#undef kiriCarriers_Fit
#undef kiriPatches_Reserve
#undef kiriPatches_Write
#undef kiriPatches_Forget
#undef kiriPatches_MayMove
#undef kiriSkin_WritePositions
#undef kiriNormals_TurnOf
#undef kiriNormals_Sum
#undef kiriNormals_SumOne
#undef kiriNormals_Write

#include "core/kiri_archive.h"
#include "core/kiri_array.h"
#include "core/kiri_vec.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* ---- Hashes ---- */

static uint64_t HashOfText(const char* text)
{
    uint64_t hash = KIRI_HASH_START;
    for (; *text != '\0'; ++text) {
        kiriHash_Word(&hash, (unsigned char)*text);
    }
    return hash;
}

/* The published values of FNV-1a. */
TEST(HashesAreFnv)
{
    assert_true(HashOfText("") == UINT64_C(0xcbf29ce484222325));
    assert_true(HashOfText("a") == UINT64_C(0xaf63dc4c8601ec8c));
    assert_true(HashOfText("foobar") == UINT64_C(0x85944171f73967e8));
    uint64_t hash = HashOfText("x"), same = hash;
    kiriHash_Word(&same, 300);
    assert_true(same == (hash ^ 300) * UINT64_C(0x100000001b3));
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
    const int32_t random = (int32_t)(Random(seed) % 1000000);
    const int32_t keys[] = { random, i, -i, random % 3, i < count / 2 ? i : count - i, i % 2 == 0 ? i : -i,
                             i == count / 2 ? 0 : i, 7 };
    return keys[pattern];
}

TEST(SortsAnything)
{
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

TEST(CayleyRotates)
{
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

TEST(RotationIsPolarFactor)
{
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

TEST(RotationOfSingular)
{
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

static void CheckMomentsNear(kiriMoments a, kiriMoments b, double tolerance)
{
    assert_true(fabs(a.area - b.area) < tolerance && fabs(a.u - b.u) < tolerance && fabs(a.v - b.v) < tolerance);
    assert_true(fabs(a.uu - b.uu) < tolerance && fabs(a.uv - b.uv) < tolerance && fabs(a.vv - b.vv) < tolerance);
}

static kiriVec2 RandomPlace(uint32_t* seed)
{
    double x = RandomBetween(seed, -1.0, 2.0);
    return kiriVec2_Make(x, RandomBetween(seed, -1.0, 2.0));
}

TEST(MomentsOfTriangles)
{
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
        CheckMomentsNear(m, BruteMoments(a, b, c, 100), 1e-3);
        /* Exact for the triangle's parts, whatever the parts. */
        kiriVec2 p = kiriVec2_Scale(1.0 / 3.0, kiriVec2_Add(kiriVec2_Add(a, b), c));
        kiriMoments sum = kiriMoments_Triangle(a, b, p), second = kiriMoments_Triangle(b, c, p),
                    third = kiriMoments_Triangle(c, a, p);
        kiriMoments_Add(&sum, &second);
        kiriMoments_Add(&sum, &third);
        CheckMomentsNear(m, sum, 1e-13);
        kiriVec2 center = kiriMoments_Center(&m);
        assert_true(kiriVec2_Length(kiriVec2_Sub(center, p)) < 1e-12);
        CheckMomentsNear(kiriMoments_About(&m, o),
                     kiriMoments_Triangle(kiriVec2_Sub(a, o), kiriVec2_Sub(b, o), kiriVec2_Sub(c, o)), 1e-12);
    }
}

/* ---- Exact sums ---- */

/* A right triangle with its corner at (u, v). */
static kiriMoments Part(double u, double v, double side)
{
    return kiriMoments_Triangle(kiriVec2_Make(u, v), kiriVec2_Make(u + side, v), kiriVec2_Make(u, v + side));
}

static kiriMoments AnyPart(uint32_t* seed, double extent)
{
    double side = extent * (Random(seed) % 2 == 0 ? 1e-9 : 0.01) * RandomBetween(seed, 0.0, 1.0);
    return Part(extent * RandomBetween(seed, 0.0, 0.98), extent * RandomBetween(seed, 0.0, 0.98), side);
}

static void CheckNear(double a, double b, double tolerance)
{
    assert_true(fabs(a - b) <= tolerance * fabs(b));
}

static void CheckMoments(kiriMoments a, kiriMoments b, double tolerance)
{
    CheckNear(a.area, b.area, tolerance);
    CheckNear(a.u, b.u, tolerance);
    CheckNear(a.v, b.v, tolerance);
    CheckNear(a.uu, b.uu, tolerance);
    CheckNear(a.uv, b.uv, tolerance);
    CheckNear(a.vv, b.vv, tolerance);
}

static const double extents[] = { 1.0, 0.1, 3.0e-5, 7.3e4, 1024.0 };
enum { EXTENTS = sizeof(extents) / sizeof(extents[0]), PARTS = 3000 };

/* Added in one order, added in another, and with others in between that go again: the very same bits. */
TEST(OrderDoesNotMatter)
{
    uint32_t seed = 8;
    for (int e = 0; e < EXTENTS; ++e) {
        kiriMoments parts[PARTS], sum = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
        kiriTally there = { 0 }, back = { 0 }, mixed = { 0 };
        for (int k = 0; k < PARTS; ++k) {
            parts[k] = AnyPart(&seed, extents[e]);
            kiriTally_Add(&there, &parts[k], 1, extents[e]);
            kiriTally_Add(&mixed, &parts[k], 1, extents[e]);
            if (k % 3 == 2) {
                kiriTally_Add(&mixed, &parts[k / 2], -1, extents[e]);
                kiriTally_Add(&mixed, &parts[k / 2], 1, extents[e]);
            }
            kiriMoments_Add(&sum, &parts[k]);
        }
        for (int k = PARTS; k-- > 0;) {
            kiriTally_Add(&back, &parts[k], 1, extents[e]);
        }
        assert_memory_equal(&there, &back, sizeof(there));
        assert_memory_equal(&there, &mixed, sizeof(there));
        CheckMoments(kiriTally_Moments(&there, extents[e]), sum, 1e-12);
    }
}

TEST(TakingAwayLeavesZero)
{
    uint32_t seed = 81;
    const kiriTally zero = { 0 };
    for (int e = 0; e < EXTENTS; ++e) {
        kiriMoments parts[PARTS];
        kiriTally tally = { 0 };
        for (int k = 0; k < PARTS; ++k) {
            parts[k] = AnyPart(&seed, extents[e]);
            kiriTally_Add(&tally, &parts[k], 1, extents[e]);
        }
        assert_memory_not_equal(&tally, &zero, sizeof(zero));
        for (int k = 0; k < PARTS; ++k) {
            kiriTally_Add(&tally, &parts[(7 * k) % PARTS], -1, extents[e]);
        }
        assert_memory_equal(&tally, &zero, sizeof(zero));
        kiriMoments none = kiriTally_Moments(&tally, extents[e]);
        assert_true(none.area == 0.0 && none.u == 0.0 && none.v == 0.0);
        assert_true(none.uu == 0.0 && none.uv == 0.0 && none.vv == 0.0);
    }
}

/* A region of one sliver, in the grid's far corner and near its origin, left over of much more. Near the origin its
   second moments are smaller by eight decades. */
TEST(SliversKeepTheirDigits)
{
    for (int e = 0; e < EXTENTS; ++e) {
        double square = extents[e] / 4096.0;
        for (int far = 0; far < 2; ++far) {
            double at = (far ? 4095.3 : 0.3) * square;
            kiriMoments sliver = Part(at, at, 1e-7 * square), rest = Part(0.0, 0.0, extents[e]);
            kiriTally tally = { 0 };
            kiriTally_Add(&tally, &rest, 1, extents[e]);
            kiriTally_Add(&tally, &sliver, 1, extents[e]);
            kiriTally_Add(&tally, &rest, -1, extents[e]);
            kiriMoments left = kiriTally_Moments(&tally, extents[e]);
            assert_true(left.area > 0.0);
            CheckMoments(left, sliver, far ? 1e-9 : 1e-6);
            kiriVec2 center = kiriMoments_Center(&left), expected = kiriMoments_Center(&sliver);
            CheckNear(center.x, expected.x, 1e-9);
            CheckNear(center.y, expected.y, 1e-9);
        }
    }
}

/* ---- Tables of fields ---- */

typedef struct Bag {
    KIRI_ARRAY(uint16_t) words;
} Bag;

KIRI_TABLE(BagTable, Bag, { KIRI_ITEMS(2, words) })

/* Counts that no bytes can have ask for no memory. */
TEST(CountsAreLimited)
{
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    Bag bag = { { NULL, 0, 0 } };
    const uint8_t many[9] = { 0xff, 0xff, 0xff, 0x7f, 1, 0, 0, 0, 0 }, negative[9] = { 0xff, 0xff, 0xff, 0xff, 0 };
    kiriArchive archive = kiriArchive_Read(many, sizeof(many), &memory);
    kiriArchive_Object(&archive, BagTable, &bag);
    assert_true(archive.isBad && !archive.isShort && bag.words.capacity == 0);
    archive = kiriArchive_Read(negative, sizeof(negative), &memory);
    kiriArchive_Object(&archive, BagTable, &bag);
    assert_true(archive.isBad && bag.words.capacity == 0);
    archive = kiriArchive_Read(many, 4, &memory);
    assert_int_equal(kiriArchive_Count(&archive, 0, 2, 10), 2);
    assert_true(archive.isBad);
    assert_null(memory.blocks);
}

/* A struct and its table from one list: a new field is one line. */
#define COLUMNS(X)                                                                                                     \
    X(double, weight, KIRI_REALS(weight))                                                                              \
    X(int32_t, frame, KIRI_INDEX(KIRI_OF_FRAMES, frame))                                                               \
    X(int32_t, added, KIRI_WITHIN(3, 5, added))
#define DECLARE_COLUMN(type, name, entry) type name;
#define LIST_COLUMN(type, name, entry) entry,

typedef struct Column {
    COLUMNS(DECLARE_COLUMN)
} Column;

KIRI_TABLE(ColumnTable, Column, { COLUMNS(LIST_COLUMN) })

static bool CanLoad(Column column)
{
    uint8_t bytes[32];
    Column read = { 0 };
    kiriArchive archive = kiriArchive_Write(bytes, sizeof(bytes));
    kiriArchive_Object(&archive, ColumnTable, &column);
    archive = kiriArchive_Read(bytes, archive.at, NULL);
    archive.count[KIRI_OF_FRAMES] = 7;
    kiriArchive_Object(&archive, ColumnTable, &read);
    assert_true(archive.isBad || (read.weight == column.weight && read.frame == column.frame && read.added == column.added));
    return !archive.isBad;
}

static uint64_t HashOfColumn(Column column)
{
    kiriArchive archive = kiriArchive_Hash();
    kiriArchive_Object(&archive, ColumnTable, &column);
    return archive.hash;
}

/* It is saved, checked, hashed and restored. */
TEST(NewFieldIsOneLine)
{
    const Column fine = { 0.5, 6, 4 }, other = { 0.5, 6, 5 };
    const Column bad[] = { { HUGE_VAL, 6, 4 }, { 0.5, 7, 4 }, { 0.5, -1, 4 }, { 0.5, 6, 2 }, { 0.5, 6, 6 } };
    assert_true(CanLoad(fine) && CanLoad(other));
    for (size_t k = 0; k < sizeof(bad) / sizeof(bad[0]); ++k) {
        assert_false(CanLoad(bad[k]));
    }
    assert_true(HashOfColumn(fine) == HashOfColumn(fine) && HashOfColumn(fine) != HashOfColumn(other));
    Column read = { 0 };
    uint8_t bytes[sizeof(Column)];
    kiriArchive archive = kiriArchive_Write(bytes, sizeof(bytes));
    archive.isWhole = true;
    kiriArchive_Object(&archive, ColumnTable, (void*)(uintptr_t)&other);
    archive = kiriArchive_Read(bytes, sizeof(bytes), NULL);
    archive.isWhole = true;
    kiriArchive_Object(&archive, ColumnTable, &read);
    assert_true(!archive.isBad && read.added == 5);
}

/* ---- Lanes ---- */

/* As the library has them. */
void kiriSkin_WritePositions(const kiriSkin* skin, const kiriPatches* patches, const kiriVec2* rest, int32_t begin,
                             int32_t end, float* positions);
void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const kiriCorners* corners);
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end);

enum { FRAMES = 9, VERTICES = 203, TRIANGLES = 300 };

typedef struct Patchwork {
    kiriMemory memory;
    kiriPatches patches;
    kiriSkin skin;
    kiriVec2 rest[VERTICES];
    int32_t corners[3 * TRIANGLES];
} Patchwork;

static void FillPatches(Patchwork* work, bool isBent, double size, uint32_t* seed)
{
    kiriCarrier carriers[FRAMES];
    for (int32_t i = 0; i < FRAMES; ++i) {
        kiriCarrier* c = &carriers[i];
        *c = (kiriCarrier){ RandomVec3(seed, size),
                            RandomVec3(seed, size),
                            RandomVec3(seed, 1.0),
                            RandomVec3(seed, size),
                            { 0.0, 0.0 },
                            0.0,
                            0.0,
                            0.0,
                            6.0 };
        c->center = kiriVec2_Make(RandomBetween(seed, 0.0, 1.0), RandomBetween(seed, 0.0, 1.0));
        c->uu = RandomBetween(seed, -20.0, 20.0);
        c->uv = RandomBetween(seed, -20.0, 20.0);
        c->vv = RandomBetween(seed, -20.0, 20.0);
    }
    assert_true(Plain_ReservePatches(&work->patches, &work->memory, FRAMES));
    Plain_WritePatches(&work->patches, carriers, FRAMES, RandomVec3(seed, size), isBent, NULL);
}

static void FillVertices(Patchwork* work, uint32_t* seed)
{
    for (int32_t v = 0; v < VERTICES; ++v) {
        kiriSpan span = { work->skin.weights.count, 1 + (int32_t)(Random(seed) % 7) };
        work->rest[v] = kiriVec2_Make(RandomBetween(seed, 0.0, 1.0), RandomBetween(seed, 0.0, 1.0));
        for (int32_t k = 0; k < span.count; ++k) {
            kiriSampleWeight weight = { (int32_t)(Random(seed) % FRAMES), (float)RandomBetween(seed, 0.0, 1.0) };
            assert_true(kiriArray_Push(&work->memory, &work->skin.weights, weight));
        }
        assert_true(kiriArray_Push(&work->memory, &work->skin.spans, span));
    }
    for (int32_t k = 0; k < 3 * TRIANGLES; ++k) {
        bool sharesEdge = k % 12 == 3 || k % 12 == 4;
        work->corners[k] = sharesEdge ? work->corners[k % 12 == 3 ? k - 3 : k - 2] : (int32_t)(Random(seed) % VERTICES);
    }
}

static void CheckLanesOfNormals(const Patchwork* work, const float* positions)
{
    static float plainSlopes[4 * VERTICES], slopes[4 * VERTICES], plain[3 * VERTICES], normals[3 * VERTICES];
    uint8_t turns[TRIANGLES / 2];
    for (int32_t pair = 0; pair < TRIANGLES / 2; ++pair) {
        turns[pair] = Plain_TurnOf(&work->corners[6 * pair], false);
    }
    const kiriCorners corners = { work->corners, turns, TRIANGLES };
    Plain_SumNormals(plainSlopes, VERTICES, positions, &corners);
    kiriNormals_Sum(slopes, VERTICES, positions, &corners);
    Plain_WriteNormals(plain, plainSlopes, 0, VERTICES);
    kiriNormals_Write(normals, slopes, 0, 50);
    kiriNormals_Write(normals, slopes, 50, 131);
    kiriNormals_Write(normals, slopes, 131, VERTICES);
    assert_memory_equal(normals, plain, sizeof(normals));
}

/* Skinning and normals: plain C and the lanes of the machine give the same bits, in ranges too. */
TEST(BitsAreThoseOfPlainC)
{
    static const double sizes[] = { 1.0, 1e-12, 1e12 };
    for (uint32_t seed = 1; seed <= 60; ++seed) {
        float plain[3 * VERTICES + 1] = { 0.0f }, positions[3 * VERTICES + 1] = { 0.0f };
        uint32_t random = seed;
        Patchwork work;
        memset(&work, 0, sizeof(work));
        work.memory = kiriMemory_Make(NULL, NULL, NULL);
        FillPatches(&work, seed % 2 == 0, sizes[seed % 3], &random);
        FillVertices(&work, &random);
        Plain_WritePositions(&work.skin, &work.patches, work.rest, 0, VERTICES, plain);
        kiriSkin_WritePositions(&work.skin, &work.patches, work.rest, 0, 77, positions);
        kiriSkin_WritePositions(&work.skin, &work.patches, work.rest, 77, VERTICES, positions);
        assert_memory_equal(positions, plain, sizeof(plain));
        CheckLanesOfNormals(&work, positions);
        kiriMemory_FreeAll(&work.memory);
    }
}
