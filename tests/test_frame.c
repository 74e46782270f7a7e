#include "scene.h"

static bool Place(Scene* scene, kiriSites* sites, int32_t piece, int32_t count)
{
    return kiriFrames_Place(sites, &scene->memory, &scene->grid, &scene->mesh, &scene->field, piece, NULL, count);
}

static void AssertDistinct(const Scene* scene, const kiriSites* sites)
{
    for (int32_t i = 0; i < sites->count; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            assert_int_not_equal(sites->data[i].cell, sites->data[j].cell);
        }
        kiriVec2 off =
            kiriVec2_Sub(sites->data[i].at, kiriGrid_Middle(&scene->grid, &scene->mesh, sites->data[i].cell));
        assert_true(fabs(off.x) <= 0.5 * scene->grid.side && fabs(off.y) <= 0.5 * scene->grid.side);
    }
}

static void SpreadsEvenly(void** state)
{
    (void)state;
    int32_t counts[4] = { 2, 5, 16, 47 };
    for (int k = 0; k < 4; ++k) {
        Scene scene;
        kiriSites sites = { 0 };
        kiriRegions regions = { { 0 }, { 0 }, { 0 }, { 0 } };
        Scene_Init(&scene, 1.0, 1.0, 8, 8, 48);
        Scene_BuildGrid(&scene);
        assert_true(Place(&scene, &sites, 0, counts[k]));
        assert_int_equal(sites.count, counts[k]);
        AssertDistinct(&scene, &sites);
        assert_true(kiriRegions_Build(&regions, &scene.memory, &scene.grid, &scene.mesh, &scene.field, sites.data,
                                      sites.count));
        for (int32_t i = 0; i < sites.count; ++i) {
            double share = regions.regions.data[i].material.area * counts[k];
            assert_true(share > 0.6 && share < 1.6);
        }
        kiriRegions_Release(&regions, &scene.memory);
        kiriArray_Release(&scene.memory, &sites);
        Scene_Release(&scene);
    }
}

/* One frame goes to the middle of its piece, and only there. */
static void OneFrameForEachPiece(void** state)
{
    (void)state;
    Scene scene;
    kiriSites sites = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 10, 10, 31);
    Scene_Slit(&scene, 0.3, 0.0, 0.3, 1.0);
    Scene_BuildGrid(&scene);
    assert_int_equal(scene.grid.pieces, 2);
    for (int32_t piece = 1; piece >= 0; --piece) {
        assert_true(Place(&scene, &sites, piece, 1));
        kiriSite site = sites.data[sites.count - 1];
        assert_int_equal(scene.grid.cells.data[site.cell].piece, piece);
        AssertNear(site.at.x, site.at.x < 0.3 ? 0.15 : 0.65, 0.6 * scene.grid.side);
        AssertNear(site.at.y, 0.5, 0.6 * scene.grid.side);
    }
    assert_int_equal(sites.count, 2);
    assert_true((sites.data[0].at.x < 0.3) != (sites.data[1].at.x < 0.3));
    kiriArray_Release(&scene.memory, &sites);
    Scene_Release(&scene);
}

static void OldSitesStay(void** state)
{
    (void)state;
    Scene scene;
    kiriSites sites = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 4, 4, 32);
    Scene_BuildGrid(&scene);
    kiriSite old[2] = { Scene_Site(&scene, 0.1, 0.1), Scene_Site(&scene, 0.2, 0.15) };
    assert_true(kiriArray_Push(&scene.memory, &sites, old[0]));
    assert_true(kiriArray_Push(&scene.memory, &sites, old[1]));
    assert_true(Place(&scene, &sites, 0, 1));
    assert_int_equal(sites.count, 3);
    assert_memory_equal(sites.data, old, sizeof(old));
    assert_true(sites.data[2].at.x > 0.5 && sites.data[2].at.y > 0.5);
    kiriArray_Release(&scene.memory, &sites);
    Scene_Release(&scene);
}

/* More than there are cells: every cell gets one, and no more, also beside sites off the middle of theirs. */
static void CountIsLimitedByCells(void** state)
{
    (void)state;
    Scene scene;
    kiriSites sites = { 0 };
    Scene_Init(&scene, 1.0, 0.7, 3, 3, 5);
    Scene_BuildGrid(&scene);
    int32_t cells = scene.grid.cells.count;
    kiriSite old = { { 0.39, 0.21 }, Scene_Cell(&scene, 0.39, 0.21) };
    assert_true(kiriArray_Push(&scene.memory, &sites, old));
    assert_true(Place(&scene, &sites, 0, 1000));
    assert_int_equal(sites.count, cells);
    AssertDistinct(&scene, &sites);
    assert_true(Place(&scene, &sites, 0, 1));
    assert_true(Place(&scene, &sites, 0, 0));
    assert_int_equal(sites.count, cells);
    kiriArray_Release(&scene.memory, &sites);
    Scene_Release(&scene);
}

/* On randomly cut sheets: in the right piece, in cells of their own, the same again on a second run. */
static void RandomPiecesAreFilled(void** state)
{
    (void)state;
    uint32_t seed = 41;
    for (int round = 0; round < 60; ++round) {
        Scene scene;
        kiriSites random, sites[2] = { { 0 }, { 0 } };
        Scene_InitRandom(&scene, &random, 0, &seed);
        for (int run = 0; run < 2; ++run) {
            for (int32_t piece = 0; piece < scene.grid.pieces; ++piece) {
                int32_t before = sites[run].count, cells = 0, count = 1 + (piece + round) % 7;
                for (int32_t c = 0; c < scene.grid.cells.count; ++c) {
                    cells += scene.grid.cells.data[c].piece == piece;
                }
                assert_true(Place(&scene, &sites[run], piece, count));
                assert_int_equal(sites[run].count - before, count < cells ? count : cells);
                for (int32_t i = before; i < sites[run].count; ++i) {
                    assert_int_equal(scene.grid.cells.data[sites[run].data[i].cell].piece, piece);
                }
            }
            AssertDistinct(&scene, &sites[run]);
        }
        assert_int_equal(sites[0].count, sites[1].count);
        for (int32_t i = 0; i < sites[0].count; ++i) {
            assert_int_equal(sites[0].data[i].cell, sites[1].data[i].cell);
            assert_true(sites[0].data[i].at.x == sites[1].data[i].at.x &&
                        sites[0].data[i].at.y == sites[1].data[i].at.y);
        }
        kiriArray_Release(&scene.memory, &random);
        kiriArray_Release(&scene.memory, &sites[0]);
        kiriArray_Release(&scene.memory, &sites[1]);
        Scene_Release(&scene);
    }
}

static kiriVec3 RandomVec3(uint32_t* seed)
{
    kiriVec2 p = RandomVec2(seed, -1.0, 1.0);
    return kiriVec3_Make(p.x, p.y, RandomBetween(seed, -1.0, 1.0));
}

static kiriFrameData RandomFrame(uint32_t* seed)
{
    kiriFrameData frame;
    memset(&frame, 0, sizeof(frame));
    frame.center = RandomVec2(seed, 0.0, 1.0);
    frame.x = RandomVec3(seed);
    frame.A = kiriMat3_Cayley(kiriVec3_Scale(3.0, RandomVec3(seed)));
    frame.velocity = RandomVec3(seed);
    frame.spin = RandomVec3(seed);
    return frame;
}

static kiriVec3 VelocityAt(const kiriFrameData* frame, kiriVec2 p)
{
    return kiriVec3_Add(frame->velocity,
                        kiriVec3_Cross(frame->spin, kiriVec3_Sub(kiriFrame_Carry(frame, p), frame->x)));
}

static kiriMoments RandomTriangle(uint32_t* seed, kiriVec2 corners[3])
{
    corners[0] = RandomVec2(seed, 0.0, 0.4);
    corners[1] = RandomVec2(seed, 0.0, 0.4);
    corners[1].x += 0.6;
    corners[2] = RandomVec2(seed, 0.0, 0.4);
    corners[2].y += 0.6;
    return kiriMoments_Triangle(corners[0], corners[1], corners[2]);
}

static void AssertNear3(kiriVec3 a, kiriVec3 b, double tolerance)
{
    AssertNear(a.x, b.x, tolerance);
    AssertNear(a.y, b.y, tolerance);
    AssertNear(a.z, b.z, tolerance);
}

static void RecenterKeepsTheMotion(void** state)
{
    (void)state;
    uint32_t seed = 43;
    for (int round = 0; round < 100; ++round) {
        kiriVec2 corners[3];
        kiriMoments material = RandomTriangle(&seed, corners);
        kiriFrameData before = RandomFrame(&seed), after = before;
        kiriFrame_Recenter(&after, &material, 0.3);
        for (int k = 0; k < 3; ++k) {
            AssertNear3(kiriFrame_Carry(&after, corners[k]), kiriFrame_Carry(&before, corners[k]), 1e-14);
            AssertNear3(VelocityAt(&after, corners[k]), VelocityAt(&before, corners[k]), 1e-14);
        }
        AssertNear(after.area, material.area, 0.0);
        AssertNear(after.mass, 0.3 * material.area, 1e-15);
        AssertNear(after.center.x, (corners[0].x + corners[1].x + corners[2].x) / 3.0, 1e-14);
        AssertNear3(after.spin, before.spin, 0.0);
    }
}

/* Momentum and angular momentum about the world's origin of the material by itself: a quadratic integrand, exact
   with the middles of a triangle's sides. */
static void IntegrateMomentum(const kiriFrameData* frame, const kiriVec2 corners[3], double mass, kiriVec3* linear,
                              kiriVec3* angular)
{
    *linear = *angular = kiriVec3_Make(0.0, 0.0, 0.0);
    for (int k = 0; k < 3; ++k) {
        kiriVec2 middle = kiriVec2_Scale(0.5, kiriVec2_Add(corners[k], corners[(k + 1) % 3]));
        kiriVec3 velocity = kiriVec3_Scale(mass / 3.0, VelocityAt(frame, middle));
        *linear = kiriVec3_Add(*linear, velocity);
        *angular = kiriVec3_Add(*angular, kiriVec3_Cross(kiriFrame_Carry(frame, middle), velocity));
    }
}

static void RecenterKeepsTheMomentum(void** state)
{
    (void)state;
    uint32_t seed = 47;
    for (int round = 0; round < 100; ++round) {
        kiriVec2 corners[3];
        kiriMoments material = RandomTriangle(&seed, corners);
        kiriFrameData before = RandomFrame(&seed), frame = before;
        kiriVec3 linear, angular;
        kiriFrame_Recenter(&frame, &material, 0.3);
        IntegrateMomentum(&before, corners, 0.3 * material.area, &linear, &angular);
        AssertNear3(kiriVec3_Scale(frame.mass, frame.velocity), linear, 1e-12);
        /* sum over u, v of inertia * A x (spin x A), and that of the centre of mass */
        kiriVec3 u = kiriVec3_Cross(frame.spin, frame.A.u), v = kiriVec3_Cross(frame.spin, frame.A.v);
        kiriVec3 own = kiriVec3_Scale(frame.inertia[0], kiriVec3_Cross(frame.A.u, u));
        own = kiriVec3_AddScaled(own, frame.inertia[1], kiriVec3_Cross(frame.A.u, v));
        own = kiriVec3_AddScaled(own, frame.inertia[1], kiriVec3_Cross(frame.A.v, u));
        own = kiriVec3_AddScaled(own, frame.inertia[2], kiriVec3_Cross(frame.A.v, v));
        own = kiriVec3_AddScaled(own, frame.mass, kiriVec3_Cross(frame.x, frame.velocity));
        AssertNear3(own, angular, 1e-12);
    }
}

static void FailingAllocatorLeaksNothing(void** state)
{
    (void)state;
    uint32_t seed = 5;
    Scene scene;
    kiriSites random;
    Scene_InitRandom(&scene, &random, 0, &seed);
    int64_t before = scene.purse.out;
    bool done = false;
    for (int64_t budget = 0; !done; ++budget) {
        kiriSites sites = { 0 };
        assert_true(kiriArray_Push(&scene.memory, &sites, Scene_MiddleOf(&scene, 0)));
        scene.purse.budget = budget;
        done = Place(&scene, &sites, 0, 12);
        scene.purse.budget = -1;
        assert_int_equal(sites.count, done ? 13 : 1);
        assert_true(done || budget < 1000);
        assert_true(!done || budget > 5);
        kiriArray_Release(&scene.memory, &sites);
        assert_true(scene.purse.out <= before + 1); /* the field may have grown once */
    }
    kiriArray_Release(&scene.memory, &random);
    Scene_Release(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(SpreadsEvenly),
        cmocka_unit_test(OneFrameForEachPiece),
        cmocka_unit_test(OldSitesStay),
        cmocka_unit_test(CountIsLimitedByCells),
        cmocka_unit_test(RandomPiecesAreFilled),
        cmocka_unit_test(RecenterKeepsTheMotion),
        cmocka_unit_test(RecenterKeepsTheMomentum),
        cmocka_unit_test(FailingAllocatorLeaksNothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
