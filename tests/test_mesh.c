/* Meshes that a sheet is made of: refused where triangles overlap, and taken whatever else is odd about them. */
#include "host.h"

static kiriSheetDef DefOf(const float* points, int32_t vertexCount, const int32_t* indices, int32_t triangleCount)
{
    kiriSheetDef def = DefaultSheet();
    def.restPositions = points;
    def.vertexCount = vertexCount;
    def.indices = indices;
    def.triangleCount = triangleCount;
    def.gridResolution = 4;
    def.frameCount = def.collisionPoints = 1;
    return def;
}

static kiriResult Try(const float* points, int32_t vertexCount, const int32_t* indices, int32_t triangleCount)
{
    kiriSheetDef def = DefOf(points, vertexCount, indices, triangleCount);
    kiriSheet sheet;
    START_HOST(host);
    return kiriCreateSheet(host.world, &def, &sheet);
}

static void CheckTaken(const float* points, int32_t vertexCount, const int32_t* indices, int32_t triangleCount,
                       int32_t pieces, int32_t vertices)
{
    kiriSheetDef def = DefOf(points, vertexCount, indices, triangleCount);
    START_HOST(host);
    kiriSheet sheet = World_AddSheet(host.world, &def);
    assert_int_equal(Host_Counts(&host, sheet).pieces, pieces);
    assert_int_equal(Host_Counts(&host, sheet).vertices, vertices);
    OK(Host_Tick(&host, 0.01f, 1));
}

/* A few steps of the lattice wide, beside a triangle that is as thin and ends far away: what floats are given for
   rounding does not let them lie on each other. */
TEST(RefusesOverlapOfTheSmallest)
{
    const int32_t two[] = { 0, 1, 2, 3, 4, 5 };
    const float on[] = { 0, 0, 1e8f, 0, 0, 1, 0.5f, 0, 1.5f, 0, 1.5f, 1 };
    const float beside[] = { 0, 0, 1e8f, 0, 0, 1, 0.5f, 1, 1.5f, 1, 1.5f, 2 };
    assert_int_equal(Try(on, 6, two, 2), KIRI_ERROR_MESH);
    assert_int_equal(Try(beside, 6, two, 2), KIRI_OK);
}

/* Is all of one on the outer side of an edge of the other? */
static bool IsApart(const float* a, const float* b)
{
    for (int i = 0; i < 3; ++i) {
        const float *p = a + 2 * i, *q = a + 2 * ((i + 1) % 3);
        bool outer = true;
        for (int k = 0; k < 3; ++k) {
            outer = outer && (q[0] - p[0]) * (b[2 * k + 1] - p[1]) <= (q[1] - p[1]) * (b[2 * k] - p[0]);
        }
        if (outer) {
            return true;
        }
    }
    return false;
}

/* Triangles thrown at random, few enough that often none overlap: against all pairs. */
TEST(RefusesOverlapAnywhere)
{
    enum { TRIANGLES = 12, RANGE = 40 };
    uint32_t seed = 5;
    int32_t refused = 0, indices[3 * TRIANGLES];
    for (int round = 0; round < 400; ++round) {
        float points[6 * TRIANGLES];
        bool apart = true;
        for (int32_t t = 0; t < TRIANGLES; ++t) {
            float* p = points + 6 * t;
            do {
                p[0] = (float)(Random(&seed) % RANGE);
                p[1] = (float)(Random(&seed) % RANGE);
                for (int k = 2; k < 6; ++k) {
                    p[k] = p[k % 2] + (float)(Random(&seed) % 9) - 4.0f;
                }
            } while ((p[2] - p[0]) * (p[5] - p[1]) <= (p[3] - p[1]) * (p[4] - p[0]));
            for (int32_t s = 0; s < t; ++s) {
                apart = apart && (IsApart(p, points + 6 * s) || IsApart(points + 6 * s, p));
            }
            for (int32_t k = 3 * t; k < 3 * t + 3; ++k) {
                indices[k] = k;
            }
        }
        assert_int_equal(Try(points, 3 * TRIANGLES, indices, TRIANGLES), apart ? KIRI_OK : KIRI_ERROR_MESH);
        refused += !apart;
    }
    assert_in_range(refused, 50, 350);
}

/* Strips that wind: one outline, and often over themselves. Against all pairs that have no corner in common; where a
   few do, others do, too. */
TEST(RefusesStripsOverThemselves)
{
    enum { LINKS = 24, POINTS = 2 * (LINKS + 1), TRIANGLES = 2 * LINKS };
    uint32_t seed = 11;
    int32_t refused = 0, indices[3 * TRIANGLES];
    for (int32_t i = 0; i < LINKS; ++i) {
        int32_t p = 2 * i, both[6] = { p, p + 2, p + 1, p + 1, p + 2, p + 3 };
        memcpy(indices + 6 * i, both, sizeof both);
    }
    for (int round = 0; round < 400; ++round) {
        float points[2 * POINTS], corners[6 * TRIANGLES];
        double angle = 0.0, bend = 0.0, x = 0.0, y = 0.0;
        for (int32_t i = 0; i <= LINKS; ++i) {
            bend += 0.05 * ((double)(Random(&seed) % 9) - 4.0);
            bend = bend > 0.6 ? 0.6 : bend < -0.6 ? -0.6 : bend;
            angle += bend;
            x += 2.0 * cos(angle);
            y += 2.0 * sin(angle);
            const double edge[4] = { x + sin(angle), y - cos(angle), x - sin(angle), y + cos(angle) };
            for (int k = 0; k < 4; ++k) {
                points[4 * i + k] = (float)edge[k];
            }
        }
        for (int32_t k = 0; k < 6 * TRIANGLES; ++k) {
            corners[k] = points[2 * indices[k / 2] + k % 2];
        }
        bool apart = true;
        for (int32_t t = 0; t < TRIANGLES; ++t) {
            for (int32_t s = 0; s < t - 2; ++s) {
                const float *a = corners + 6 * s, *b = corners + 6 * t;
                apart = apart && (IsApart(a, b) || IsApart(b, a));
            }
        }
        assert_int_equal(Try(points, POINTS, indices, TRIANGLES), apart ? KIRI_OK : KIRI_ERROR_MESH);
        refused += !apart;
    }
    assert_in_range(refused, 50, 350);
}

/* 20 000 triangles within 1e-4 of the sheet, and one far away; then one more in the crowd, on others. */
TEST(TakesCrowds)
{
    enum { SIDE = 100, VERTICES = (SIDE + 1) * (SIDE + 1), TRIANGLES = 2 * SIDE * SIDE };
    static float points[2 * (VERTICES + 6)];
    static int32_t indices[3 * (TRIANGLES + 2)];
    const float far[] = { 0.9f, 0.9f, 1.0f, 0.9f, 1.0f, 1.0f }, on[] = { 4e-5f, 4e-5f, 6e-5f, 4e-5f, 5e-5f, 6e-5f };
    assert_int_equal(kiriFillRectangle(1e-4f, 1e-4f, SIDE, SIDE, points, indices), KIRI_OK);
    memcpy(points + 2 * VERTICES, far, sizeof far);
    memcpy(points + 2 * VERTICES + 6, on, sizeof on);
    for (int32_t i = 0; i < 6; ++i) {
        indices[3 * TRIANGLES + i] = VERTICES + i;
    }
    assert_int_equal(Try(points, VERTICES + 3, indices, TRIANGLES + 1), KIRI_OK);
    assert_int_equal(Try(points, VERTICES + 6, indices, TRIANGLES + 2), KIRI_ERROR_MESH);
}

/* All triangles around one vertex. */
TEST(TakesHubs)
{
    enum { SPOKES = 3000 };
    static float points[2 * (SPOKES + 1)];
    static int32_t indices[3 * SPOKES];
    for (int32_t i = 0; i < SPOKES; ++i) {
        double angle = 6.283185307179586 * i / SPOKES;
        points[2 * i + 2] = (float)cos(angle);
        points[2 * i + 3] = (float)sin(angle);
        indices[3 * i + 1] = 1 + i;
        indices[3 * i + 2] = 1 + (i + 1) % SPOKES;
    }
    CheckTaken(points, SPOKES + 1, indices, SPOKES, 1, SPOKES + 1);
}

/* Nine triangles wound twice around a vertex: no edge is used twice, but they lie on each other. */
TEST(RefusesWindingTwice)
{
    const float ring[] = { 0, 0, 4, 0, 3, 3, 0, 4, -3, 3, -4, 0, -3, -3, 0, -4, 3, -3 };
    int32_t indices[24];
    for (int32_t i = 0; i < 8; ++i) {
        indices[3 * i] = 0;
        indices[3 * i + 1] = 1 + 3 * i % 8;
        indices[3 * i + 2] = 1 + 3 * (i + 1) % 8;
    }
    assert_int_equal(Try(ring, 9, indices, 8), KIRI_ERROR_MESH);
    for (int32_t i = 0; i < 8; ++i) {
        indices[3 * i + 1] = 1 + i;
        indices[3 * i + 2] = 1 + (i + 1) % 8;
    }
    assert_int_equal(Try(ring, 9, indices, 8), KIRI_OK);
}

/* Doubled vertices are the lips of a cut: it ends where the vertex is single, here at the outline. Squares that share a
   corner alone have a vertex each. */
TEST(DividesVertices)
{
    const float slit[] = { 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 1, 0 }, pinch[] = { 0, 0, 1, 0, 0, 1, 1, 1, 2, 1, 1, 2, 2, 2 };
    const int32_t lips[] = { 0, 1, 4, 0, 4, 3, 6, 2, 5, 6, 5, 4 }, squares[] = { 0, 1, 3, 0, 3, 2, 3, 4, 6, 3, 6, 5 };
    CheckTaken(slit, 7, lips, 4, 2, 8);
    CheckTaken(slit, 7, lips, 1, 1, 3); /* four vertices that no triangle has */
    CheckTaken(pinch, 7, squares, 4, 2, 8);
}
