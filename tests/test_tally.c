/* Exact sums: of any order, taken away again, and precise for slivers. */
#include "core/kiri_vec.h"
#include "support.h"

#include <string.h>

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
static void OrderDoesNotMatter(void** state)
{
    (void)state;
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

static void TakingAwayLeavesZero(void** state)
{
    (void)state;
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
static void SliversKeepTheirDigits(void** state)
{
    (void)state;
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

/* Rounding may leave a moment below zero; it goes as it came. */
static void NegativeNumbersToo(void** state)
{
    (void)state;
    const double values[] = { -1e-30, -1e-40, -1e-19, -0.3, -1.0, 1e-40, 1.0, 0.7, -8.6736173798840355e-19 };
    const kiriTally zero = { 0 };
    for (size_t i = 0; i < sizeof(values) / sizeof(values[0]); ++i) {
        double x = values[i];
        kiriMoments moments = { x, x, x, x, x, x };
        kiriTally tally = { 0 };
        kiriTally_Add(&tally, &moments, 1, 1.0);
        kiriMoments back = kiriTally_Moments(&tally, 1.0);
        assert_true(fabs(back.area - x) <= 1e-16 * fabs(x) + 4e-19 * (x < 0.0) + 2e-37);
        assert_true(tally.area.low >= 0);
        kiriTally_Add(&tally, &moments, -1, 1.0);
        assert_memory_equal(&tally, &zero, sizeof(zero));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(OrderDoesNotMatter),
        cmocka_unit_test(TakingAwayLeavesZero),
        cmocka_unit_test(SliversKeepTheirDigits),
        cmocka_unit_test(NegativeNumbersToo),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
