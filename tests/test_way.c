#include "scene.h"

#include "field/kiri_path.h"

/* A sheet of one region: all squares may be looked at. */
typedef struct Plain {
    Scene scene;
    int32_t* owner;
    int32_t region;
    kiriSightEdges edges;
    kiriSight sight;
} Plain;

static void Start(Plain* p, double width, double height, int32_t columns, int32_t rows, int32_t resolution)
{
    memset(p, 0, sizeof(*p));
    Scene_Init(&p->scene, width, height, columns, rows, resolution);
}

static void Look(Plain* p)
{
    Scene_BuildGrid(&p->scene);
    p->owner = calloc((size_t)p->scene.grid.cells.count, sizeof(int32_t));
    p->sight = (kiriSight){ &p->scene.grid, &p->scene.mesh, p->owner, &p->region, 1, &p->edges };
    assert_true(kiriSightEdges_Start(&p->edges, &p->scene.mesh));
}

static void Stop(Plain* p)
{
    free(p->owner);
    Scene_Release(&p->scene);
}

static kiriVec2 At(double u, double v)
{
    return kiriVec2_Make(u, v);
}

static kiriTurns AllTurns(const Plain* p, kiriVec2 from, kiriVec2 to, double most)
{
    kiriTurns turns;
    kiriTurns_Start(&turns, from, to, most);
    for (int32_t c = 0; c < p->scene.grid.cells.count; ++c) {
        kiriTurns_AddAround(&turns, &p->sight, c);
    }
    return turns;
}

/* The length of the way, and its turns. */
static kiriWay WayOf(Plain* p, kiriVec2 from, kiriVec2 to)
{
    kiriTurns turns = AllTurns(p, from, to, 1e9);
    kiriWay way;
    assert_false(turns.isFull);
    assert_true(kiriWay_Find(&turns, &p->sight, &way));
    /* No corner is missed that is needed. */
    double length = way.length;
    turns = AllTurns(p, from, to, 1.0001 * length);
    assert_true(kiriWay_Find(&turns, &p->sight, &way));
    AssertNear(way.length, length, 0.0);
    return way;
}

static void SlitsStopTheSight(void** state)
{
    (void)state;
    Plain p;
    kiriSightHit hit;
    Start(&p, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&p.scene, 0.5, 0.0, 0.5, 0.8);
    Look(&p);
    assert_int_equal(kiriSight_Cast(&p.sight, At(0.1, 0.3), At(0.9, 0.3), &hit), KIRI_SIGHT_EDGE);
    AssertNear(hit.share, 0.5, 1e-7);
    AssertNear(kiriMesh_Local(&p.scene.mesh, kiriSight_HeadOf(&p.scene.mesh, hit.edge)).x, 0.5, 1e-7);
    assert_int_equal(kiriSight_EdgeBefore(&p.scene.mesh, kiriSight_EdgeAfter(&p.scene.mesh, hit.edge)), hit.edge);
    assert_int_equal(kiriSight_Cast(&p.sight, At(0.9, 0.1), At(0.3, 0.4), &hit), KIRI_SIGHT_EDGE);
    AssertNear(hit.share, 2.0 / 3.0, 1e-7);
    assert_true(kiriSight_IsClear(&p.sight, At(0.1, 0.9), At(0.9, 0.9)));
    /* Past the outline there is nothing; up to a lip, or along it, there is. */
    assert_int_equal(kiriSight_Cast(&p.sight, At(0.1, 0.9), At(0.1, 1.5), &hit), KIRI_SIGHT_EDGE);
    AssertNear(hit.share, 1.0 / 6.0, 1e-7);
    assert_true(kiriSight_IsClear(&p.sight, At(0.1, 0.3), At(0.5, 0.3)));
    assert_true(kiriSight_IsClear(&p.sight, At(0.5, 0.05), At(0.5, 0.95)));
    /* Through a vertex of the slit there is no way, and over its end there is. */
    assert_false(kiriSight_IsClear(&p.sight, At(0.1, 0.4), At(0.9, 0.4)));
    assert_true(kiriSight_IsClear(&p.sight, At(0.1, 0.8), At(0.9, 0.8)));
    Stop(&p);
}

/* Against all edges of the mesh, one by one. */
static void SightIsThatOfAllEdges(void** state)
{
    (void)state;
    uint32_t seed = 9;
    int32_t clear = 0, stopped = 0;
    for (int round = 0; round < 40; ++round) {
        Plain p;
        memset(&p, 0, sizeof(p));
        Scene_InitMesh(&p.scene, 1.0, 1.0, 9, 9, 4 + (int32_t)(Random(&seed) % 30), 0.25, seed);
        Scene_CutAtRandom(&p.scene, 6, 8, &seed);
        Look(&p);
        for (int k = 0; k < 100; ++k) {
            kiriVec2 a = RandomVec2(&seed, 0.001, 0.999), b = RandomVec2(&seed, 0.001, 0.999);
            kiriVec2 way = kiriVec2_Sub(b, a);
            double nearest = 2.0;
            for (int32_t h = 0; h < 3 * p.scene.mesh.triangles.count; ++h) {
                if (kiriMesh_Twin(&p.scene.mesh, h) == KIRI_NONE || kiriMesh_IsOpen(&p.scene.mesh, h)) {
                    int32_t next = kiriMesh_Tail(&p.scene.mesh, kiriEdge_Next(h));
                    kiriVec2 q =
                        kiriMesh_Local(&p.scene.mesh, p.scene.mesh.vertices.data[kiriMesh_Tail(&p.scene.mesh, h)].at);
                    kiriVec2 e = kiriVec2_Sub(kiriMesh_Local(&p.scene.mesh, p.scene.mesh.vertices.data[next].at), q);
                    kiriVec2 o = kiriVec2_Sub(q, a);
                    double det = way.x * e.y - way.y * e.x;
                    double t = (o.x * e.y - o.y * e.x) / det, s = (o.x * way.y - o.y * way.x) / det;
                    nearest = s >= 0.0 && s <= 1.0 && t >= 0.0 && t <= 1.0 && t < nearest ? t : nearest;
                }
            }
            kiriSightHit hit;
            kiriSightEnd end = kiriSight_Cast(&p.sight, a, b, &hit);
            assert_int_equal(end, nearest <= 1.0 ? KIRI_SIGHT_EDGE : KIRI_SIGHT_CLEAR);
            AssertNear(hit.share, nearest <= 1.0 ? nearest : 1.0, 1e-9);
            clear += end == KIRI_SIGHT_CLEAR;
            stopped += end == KIRI_SIGHT_EDGE;
        }
        Stop(&p);
    }
    assert_true(clear > 500 && stopped > 500);
}

static void OtherSquaresAreNotLookedAt(void** state)
{
    (void)state;
    Plain p;
    kiriSightHit hit;
    Start(&p, 1.0, 1.0, 4, 4, 10);
    Look(&p);
    for (int32_t c = 0; c < p.scene.grid.cells.count; ++c) {
        p.owner[c] = kiriGrid_Middle(&p.scene.grid, &p.scene.mesh, c).x > 0.5;
    }
    assert_int_equal(kiriSight_Cast(&p.sight, At(0.05, 0.35), At(0.95, 0.35), &hit), KIRI_SIGHT_LOST);
    AssertNear(hit.share, 0.5, 1e-6);
    assert_true(kiriSight_IsClear(&p.sight, At(0.05, 0.35), At(0.45, 0.85)));
    Stop(&p);
}

static void WaysTurnAtSlitEnds(void** state)
{
    (void)state;
    Plain p;
    Start(&p, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&p.scene, 0.3, 0.0, 0.3, 0.8);
    Scene_Slit(&p.scene, 0.7, 0.2, 0.7, 1.0);
    Look(&p);
    kiriWay way = WayOf(&p, At(0.1, 0.9), At(0.5, 0.9));
    assert_int_equal(way.turnCount, 0);
    AssertNear(way.length, 0.4, 1e-12);
    way = WayOf(&p, At(0.1, 0.2), At(0.5, 0.6));
    double first = sqrt(0.04 + 0.36), second = sqrt(0.04 + 0.04);
    assert_int_equal(way.turnCount, 1);
    AssertNear(way.turn[0].x, 0.3, 1e-7);
    AssertNear(way.turn[0].y, 0.8, 1e-7);
    AssertNear(way.length, first + second, 1e-7);
    kiriVec2 half = kiriWay_At(&way, At(0.1, 0.2), At(0.5, 0.6), first + 0.5 * second);
    AssertNear(half.x, 0.4, 1e-7);
    AssertNear(half.y, 0.7, 1e-7);
    way = WayOf(&p, At(0.1, 0.1), At(0.9, 0.9));
    assert_int_equal(way.turnCount, 2);
    AssertNear(way.length, 2.0 * sqrt(0.04 + 0.49) + sqrt(0.16 + 0.36), 1e-7);
    Stop(&p);
}

/* A slit of two legs: its knee is a corner on one side only. From the hollow side no way turns there, and none slips
   through it. */
static void NoWayThroughAKnee(void** state)
{
    (void)state;
    Plain p;
    Start(&p, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&p.scene, 0.5, 0.2, 0.5, 0.5);
    Scene_Slit(&p.scene, 0.5, 0.5, 0.8, 0.5);
    Look(&p);
    kiriWay way = WayOf(&p, At(0.45, 0.6), At(0.6, 0.4));
    assert_true(way.turnCount >= 1);
    double left = sqrt(0.05 * 0.05 + 0.1 * 0.1) + 0.3 + sqrt(0.1 * 0.1 + 0.2 * 0.2);
    double right = sqrt(0.35 * 0.35 + 0.1 * 0.1) + sqrt(0.2 * 0.2 + 0.1 * 0.1);
    AssertNear(way.length, left < right ? left : right, 1e-6);
    way = WayOf(&p, At(0.4, 0.3), At(0.6, 0.7));
    assert_int_equal(way.turnCount, 0); /* past the knee, outside */
    way = WayOf(&p, At(0.48, 0.3), At(0.7, 0.52));
    assert_int_equal(way.turnCount, 1); /* around it */
    AssertNear(way.turn[0].x, 0.5, 1e-7);
    AssertNear(way.turn[0].y, 0.5, 1e-7);
    Stop(&p);
}

/* A comb of slits has more corners than there is room for. */
static void TooManyTurnsAreRefused(void** state)
{
    (void)state;
    Plain p;
    Start(&p, 1.0, 1.0, 120, 4, 8);
    for (int k = 1; k < 120; ++k) {
        Scene_Slit(&p.scene, k / 120.0, 0.25, k / 120.0, 0.75);
    }
    Look(&p);
    kiriTurns turns = AllTurns(&p, At(0.01, 0.5), At(0.99, 0.5), 1e9);
    kiriWay way;
    assert_true(turns.isFull);
    assert_false(kiriWay_Find(&turns, &p.sight, &way));
    Stop(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(SlitsStopTheSight),          cmocka_unit_test(SightIsThatOfAllEdges),
        cmocka_unit_test(OtherSquaresAreNotLookedAt), cmocka_unit_test(WaysTurnAtSlitEnds),
        cmocka_unit_test(NoWayThroughAKnee),          cmocka_unit_test(TooManyTurnsAreRefused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
