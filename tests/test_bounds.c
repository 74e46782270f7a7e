/* Rays against all triangles one by one; and boxes, which come with rays and go without. */
#include "host.h"

static const float down[3] = { 0.0f, 0.0f, -1.0f };

/* How far along the ray the plane of a triangle is met within the triangle, by doubles; -1: not. *margin is the least
   weight there: near 0 rounding decides. */
static double Meet(const kiriMesh* mesh, int32_t triangle, const float origin[3], const float way[3], double* margin)
{
    const int32_t* corner = &mesh->indices[3 * triangle];
    double p[3][3], n[3], weight[3], along = 0.0, height = 0.0, sum = 0.0;
    for (int k = 0; k < 9; ++k) {
        p[k / 3][k % 3] = (double)mesh->positions[3 * corner[k / 3] + k % 3] - origin[k % 3];
    }
    for (int k = 0; k < 3; ++k) { /* of the origin seen along the ray: the sides of three tetrahedra */
        const double *a = p[(k + 1) % 3], *b = p[(k + 2) % 3];
        weight[k] = way[0] * (a[1] * b[2] - a[2] * b[1]) + way[1] * (a[2] * b[0] - a[0] * b[2]) +
                    way[2] * (a[0] * b[1] - a[1] * b[0]);
        sum += weight[k];
    }
    for (int k = 0; k < 3; ++k) {
        int a = (k + 1) % 3, b = (k + 2) % 3;
        n[k] = (p[1][a] - p[0][a]) * (p[2][b] - p[0][b]) - (p[1][b] - p[0][b]) * (p[2][a] - p[0][a]);
        along += n[k] * way[k];
        height += n[k] * p[0][k];
    }
    *margin = sum == 0.0 ? 0.0 : fmin(fmin(weight[0], weight[1]), weight[2]) / sum;
    *margin = sum < 0.0 ? fmin(fmin(weight[0] / sum, weight[1] / sum), weight[2] / sum) : *margin;
    return *margin > 0.0 && along != 0.0 && height / along > 0.0 ? height / along : -1.0;
}

/* Compares with the nearest triangle of all. Returns true if the ray meets the sheet. */
static bool CheckRay(const Host* host, kiriSheet sheet, const float origin[3], const float way[3])
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    double nearest = 1e30, doubt = 1e30, length = 0.0;
    kiriHit hit;
    for (int k = 0; k < 3; ++k) {
        length = hypot(length, way[k]);
    }
    OK(kiriSheet_Raycast(host->world, sheet, origin, way, 100.0f, &hit));
    for (int32_t t = 0; t < mesh.triangleCount; ++t) {
        double margin, at = Meet(&mesh, t, origin, way, &margin);
        nearest = at >= 0.0 ? fmin(nearest, length * at) : nearest;
        doubt = fmin(doubt, fabs(margin));
    }
    bool isHit = hit.triangle >= 0;
    if (doubt > 1e-5 && isHit != (nearest < 100.0)) {
        fail_msg("a ray %s the sheet", isHit ? "does not meet" : "meets");
    }
    if (doubt > 1e-5 && isHit && fabs(hit.distance - nearest) > 1e-5 * (1.0 + nearest)) {
        fail_msg("a ray meets the sheet at %.9g, not %.9g, %g", (double)hit.distance, nearest, doubt);
    }
    for (int k = 0; k < 3 && isHit; ++k) {
        assert_float_equal(hit.position[k], origin[k] + hit.distance / length * way[k], 1e-5);
    }
    return isHit;
}

/* ---- At random ---- */

TEST(Rays)
{
    uint32_t seed = 17;
    int32_t hits = 0, rays = 0;
    for (int round = 0; round < 6; ++round) {
        START_HOST(host);
        kiriSheetDef def = Host_SmallDef();
        def.framePoints = NULL;
        def.frameCount = 5;
        def.skinning = round % 2 == 0 ? KIRI_SKINNING_LINEAR : KIRI_SKINNING_SMOOTH;
        def.material.youngsModulus = 1e4f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4 + 4 * round, 9);
        World_Clamp(host.world, sheet, (float[]){ 0.0f, 1.0f }, (float[]){ 1.0f, 1.0f });
        for (int tick = 0; tick < 40; ++tick) {
            float line[4];
            for (int k = 0; k < 4; ++k) {
                line[k] = (float)RandomBetween(&seed, -0.2, 1.2);
            }
            if (tick % 2 == 0) {
                Host_Cut(&host, sheet, line, 2);
            }
            assert_true(Host_Tick(&host, 0.01f, 2) >= 0);
            for (int k = 0; k < 20; ++k, ++rays) {
                kiriMesh mesh = Host_Mesh(&host, sheet);
                const float* to = &mesh.positions[3 * (Random(&seed) % (uint32_t)mesh.vertexCount)];
                float origin[3], way[3];
                for (int a = 0; a < 3; ++a) {
                    origin[a] = to[a] + (float)RandomBetween(&seed, -2.0, 2.0);
                    way[a] = to[a] + (float)RandomBetween(&seed, -0.2, 0.2) - origin[a];
                }
                hits += CheckRay(&host, sheet, origin, way);
            }
        }
    }
    assert_true(hits > rays / 4 && hits < rays);
}

/* ---- Boxes ---- */

static kiriHit Cast(const Host* host, kiriSheet sheet, float x, float y)
{
    const float origin[3] = { x, y, 5.0f };
    kiriHit hit;
    OK(kiriSheet_Raycast(host->world, sheet, origin, down, 100.0f, &hit));
    return hit;
}

/* A sheet has no boxes before somebody asks, has them from the next tick on, and gives them back when nobody asks any
   more. */
TEST(WhoAsks)
{
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 16);
    enum { PATIENCE = 120 };
    OK(Host_Tick(&host, 0.01f, 1));
    int64_t live = host.live;
    kiriHit first = Cast(&host, sheet, 0.3f, 0.4f);
    assert_int_equal(host.live, live);
    OK(Host_Tick(&host, 0.01f, 1));
    assert_true(host.live > live);
    int64_t calls = host.calls;
    for (int k = 0; k < PATIENCE - 2; ++k) {
        OK(Host_Tick(&host, 0.01f, 1));
        assert_true(host.live > live);
    }
    assert_int_equal(host.calls, calls); /* no room is taken but once */
    assert_int_equal(Cast(&host, sheet, 0.3f, 0.4f).triangle, first.triangle);
    Host_Ticks(&host, PATIENCE + 2, 0.01f, 1);
    assert_int_equal(host.live, live);
}

/* The sheet that a ray meets first, of three above each other, with and without boxes. */
TEST(AllSheets)
{
    kiriSheet sheets[3], met;
    kiriHit hit;
    const float heights[3] = { 0.5f, 2.0f, 1.0f }, up[3] = { 0.0f, 0.0f, 4.0f };
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    World_StopGravity(host.world);
    for (int k = 0; k < 3; ++k) {
        def.position[2] = heights[k];
        sheets[k] = Host_AddRectangle(&host, &def, 1.0f, 1.0f + (float)k, 4, 4);
    }
    for (int round = 0; round < 2; ++round) {
        const float over[3] = { 0.4f, 0.5f, 9.0f }, under[3] = { 0.4f, 0.5f, -1.0f }, beyond[3] = { 0.4f, 2.5f, 9.0f };
        OK(kiriWorld_Raycast(host.world, over, down, 100.0f, &met, &hit));
        assert_int_equal(met, sheets[1]);
        assert_float_equal(hit.distance, 7.0f, 1e-6f);
        OK(kiriWorld_Raycast(host.world, under, up, 100.0f, &met, &hit));
        assert_int_equal(met, sheets[0]);
        assert_float_equal(hit.distance, 1.5f, 1e-6f);
        OK(kiriWorld_Raycast(host.world, beyond, down, 100.0f, &met, &hit));
        assert_int_equal(met, sheets[2]);
        OK(kiriWorld_Raycast(host.world, over, up, 100.0f, &met, &hit));
        assert_int_equal(met, 0);
        assert_int_equal(hit.triangle, -1);
        OK(kiriWorld_Raycast(host.world, over, down, 6.9f, &met, &hit));
        assert_int_equal(met, 0);
        OK(Host_Tick(&host, 0.01f, 1));
    }
}
