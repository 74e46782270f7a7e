/* The mesh: what it refuses, and that splitting, opening and taking back keep it whole. */
#include "check_mesh.h"

static const double Size = 536870912.0;

static kiriResult Init(kiriMeshData* mesh, const float* positions, int32_t vertexCount, const int32_t* indices,
                       int32_t triangleCount)
{
    kiriFault why;
    kiriResult result =
        kiriMesh_Init(mesh, Heap(), &(kiriMeshInput){ positions, vertexCount, indices, triangleCount, 4, 0.0 }, &why);
    assert_int_equal(strlen(why.line) == 0, result == KIRI_OK);
    return result;
}

/* Refused, or taken and released. */
static kiriResult Try(const float* positions, int32_t vertexCount, const int32_t* indices, int32_t triangleCount)
{
    kiriMeshData mesh;
    kiriResult result = Init(&mesh, positions, vertexCount, indices, triangleCount);
    if (result == KIRI_OK) {
        CheckMesh(&mesh);
        kiriMemory_FreeAll(mesh.memory);
    }
    return result;
}

/* A half-edge from one place to another, or KIRI_NONE. */
static int32_t Find(const kiriMeshData* mesh, double ax, double ay, double bx, double by)
{
    kiriLatticePoint a = kiriMesh_Snap(mesh, kiriVec2_Make(ax, ay)), b = kiriMesh_Snap(mesh, kiriVec2_Make(bx, by));
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        kiriLatticePoint p = TailAt(mesh, h), q = TailAt(mesh, kiriEdge_Next(h));
        if (p.x == a.x && p.y == a.y && q.x == b.x && q.y == b.y) {
            return h;
        }
    }
    return KIRI_NONE;
}

static int32_t VerticesAt(const kiriMeshData* mesh, double x, double y)
{
    kiriLatticePoint p = kiriMesh_Snap(mesh, kiriVec2_Make(x, y));
    int32_t count = 0;
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        count += mesh->vertices.data[v].at.x == p.x && mesh->vertices.data[v].at.y == p.y ? 1 : 0;
    }
    return count;
}

/* ---- Squares ----------------------------------------------------------------------------------------------------- */

/* Area of a polygon left of the line n . p >= c, in place. */
static int ClipHalfPlane(kiriVec2* polygon, int count, kiriVec2 n, double c)
{
    kiriVec2 out[16];
    int size = 0;
    for (int i = 0; i < count; ++i) {
        kiriVec2 p = polygon[i], q = polygon[(i + 1) % count];
        double dp = kiriVec2_Dot(n, p) - c, dq = kiriVec2_Dot(n, q) - c;
        if (dp >= 0.0) {
            out[size++] = p;
        }
        if ((dp < 0.0) != (dq < 0.0) && dp != 0.0 && dq != 0.0) {
            out[size++] = kiriVec2_Add(p, kiriVec2_Scale(dp / (dp - dq), kiriVec2_Sub(q, p)));
        }
    }
    memcpy(polygon, out, (size_t)size * sizeof(kiriVec2));
    return size;
}

static double ClippedArea(const kiriLatticePoint c[3], kiriLatticePoint low, double side)
{
    kiriVec2 polygon[16];
    for (int i = 0; i < 3; ++i) {
        polygon[i] = kiriVec2_Make(c[i].x, c[i].y);
    }
    int count = ClipHalfPlane(polygon, 3, kiriVec2_Make(1.0, 0.0), low.x);
    count = ClipHalfPlane(polygon, count, kiriVec2_Make(-1.0, 0.0), -(low.x + side));
    count = ClipHalfPlane(polygon, count, kiriVec2_Make(0.0, 1.0), low.y);
    count = ClipHalfPlane(polygon, count, kiriVec2_Make(0.0, -1.0), -(low.y + side));
    double area = 0.0;
    for (int i = 1; i + 1 < count; ++i) {
        kiriVec2 p = kiriVec2_Sub(polygon[i], polygon[0]), q = kiriVec2_Sub(polygon[i + 1], polygon[0]);
        area += 0.5 * (p.x * q.y - p.y * q.x);
    }
    return area;
}

static void SquaresListWhatTheyOverlap(void** state)
{
    (void)state;
    uint32_t seed = 7;
    kiriLatticePoint extent = { 60, 34 };
    kiriSquares squares;
    assert_true(kiriSquares_Init(&squares, Heap(), extent, 7));
    /* 60 + 2 over 7 squares of an even side */
    assert_int_equal(squares.side, 10);
    assert_int_equal(squares.columns, 7);
    assert_int_equal(squares.rows, 4);
    kiriLatticePoint was[3] = { { 0, 0 }, { 60, 0 }, { 0, 34 } };
    assert_true(kiriSquares_Insert(&squares, Heap(), 5, was));
    for (int round = 0; round < 3000; ++round) {
        kiriLatticePoint c[3];
        for (int i = 0; i < 3; ++i) {
            c[i].x = (int32_t)(2 * (Random(&seed) % 31));
            c[i].y = (int32_t)(2 * (Random(&seed) % 18));
        }
        if (kiriOrient(c[0], c[1], c[2]) <= 0) {
            continue;
        }
        kiriSquares_ClearDirty(&squares);
        assert_true(kiriArray_Reserve(Heap(), &squares.nodes, squares.nodes.count + kiriSquares_MostNodes(&squares, c)));
        kiriSquares_Reshape(&squares, 5, was, c);
        for (int32_t s = 0; s < 28; ++s) {
            /* Small numbers: an overlap has at least the area of a triangle between lines through their points. */
            bool overlaps = ClippedArea(c, kiriSquares_Corner(&squares, s), 10.0) > 1e-9;
            assert_int_equal(kiriSquares_Overlap(&squares, s, c), overlaps);
            assert_int_equal(squares.head[s] != KIRI_NONE, overlaps);
            assert_int_equal(squares.isDirty[s], overlaps || kiriSquares_Overlap(&squares, s, was));
        }
        memcpy(was, c, sizeof(was));
    }
    assert_true(squares.nodes.count <= 28);
    kiriMemory_FreeAll(Heap());
}

/* The part of the segment between two parallels, as shares of its length. */
static void ClipShares(double a, double b, double low, double high, double* from, double* to)
{
    double first = (low - a) / (b - a), last = (high - a) / (b - a);
    if (a == b) {
        first = a > low && a < high ? 0.0 : 2.0;
        last = 1.0;
    }
    *from = fmax(*from, fmin(first, last));
    *to = fmin(*to, fmax(first, last));
}

static void SquaresThatEdgesRunThrough(void** state)
{
    (void)state;
    uint32_t seed = 9;
    kiriLatticePoint extent = { 60, 34 };
    kiriSquares squares;
    assert_true(kiriSquares_Init(&squares, Heap(), extent, 7));
    for (int round = 0; round < 3000; ++round) {
        kiriLatticePoint a = { (int32_t)(2 * (Random(&seed) % 31)), (int32_t)(2 * (Random(&seed) % 18)) };
        kiriLatticePoint b = { (int32_t)(2 * (Random(&seed) % 31)), (int32_t)(2 * (Random(&seed) % 18)) };
        if (a.x == b.x && a.y == b.y) {
            continue;
        }
        kiriSquares_MarkEdgeDirty(&squares, a, b);
        for (int32_t s = 0; s < 28; ++s) {
            kiriLatticePoint low = kiriSquares_Corner(&squares, s);
            double from = 0.0, to = 1.0;
            ClipShares(a.x, b.x, low.x, low.x + 10.0, &from, &to);
            ClipShares(a.y, b.y, low.y, low.y + 10.0, &from, &to);
            assert_int_equal(kiriSquares_RunsThrough(&squares, s, a, b), to > from + 1e-12);
            assert_int_equal(squares.isDirty[s], to > from + 1e-12);
        }
        kiriSquares_ClearDirty(&squares);
        assert_int_equal(squares.dirty.count, 0);
    }
    kiriMemory_FreeAll(Heap());
}

static void SquaresAroundPoints(void** state)
{
    (void)state;
    kiriLatticePoint extent = { 60, 34 }, inside = { 10, 8 }, last = { 60, 34 }, left = { -2, 4 }, above = { 4, 40 };
    kiriSquares squares;
    assert_true(kiriSquares_Init(&squares, Heap(), extent, 7));
    assert_int_equal(kiriSquares_At(&squares, inside), 1);
    assert_int_equal(kiriSquares_At(&squares, last), 27);
    assert_int_equal(kiriSquares_At(&squares, left), KIRI_NONE);
    assert_int_equal(kiriSquares_At(&squares, above), KIRI_NONE);
    kiriLatticePoint corner = kiriSquares_Corner(&squares, 8);
    assert_int_equal(corner.x, 9);
    assert_int_equal(corner.y, 9);
    kiriMemory_FreeAll(Heap());
}

/* An insertion that is refused memory changes nothing. */
static void SquaresWithoutMemory(void** state)
{
    (void)state;
    kiriLatticePoint extent = { 60, 34 }, big[3] = { { 0, 0 }, { 60, 0 }, { 0, 34 } },
                     small[3] = { { 0, 0 }, { 4, 0 }, { 0, 4 } };
    Meter meter = { -1, 0 };
    kiriMemory memory = kiriMemory_Make(MeterAlloc, MeterFree, &meter);
    kiriSquares squares;
    assert_true(kiriSquares_Init(&squares, &memory, extent, 7));
    assert_true(kiriSquares_Insert(&squares, &memory, 0, small));
    kiriSquares_ClearDirty(&squares);
    meter.untilFailure = 0;
    assert_false(kiriSquares_Insert(&squares, &memory, 1, big));
    for (int32_t s = 0; s < 28; ++s) {
        assert_int_equal(squares.head[s] != KIRI_NONE, s == 0);
    }
    assert_true(squares.nodes.count == 1 && squares.dirty.count == 0);
    meter.untilFailure = -1;
    assert_true(kiriSquares_Insert(&squares, &memory, 1, big));
    assert_true(squares.dirty.count > 10);
    kiriMemory_FreeAll(&memory);
    assert_int_equal(meter.live, 0);
}

/* ---- Taking triangles over --------------------------------------------------------------------------------------- */

static const float Unit[] = { 0, 0, 1, 0, 1, 1, 0, 1 };
static const int32_t UnitIndices[] = { 0, 1, 2, 0, 2, 3 };

static void RefusesArguments(void** state)
{
    (void)state;
    const int32_t outside[] = { 0, 1, 4 }, negative[] = { 0, -1, 2 };
    float nan[] = { 0, 0, 1, 0, 1, 1, 0, 1 }, infinite[] = { 0, 0, 1, 0, 1, 1, 0, 1 };
    nan[5] = (float)(0.0 * (double)INFINITY);
    infinite[6] = -INFINITY;
    assert_int_equal(Try(Unit, 4, UnitIndices, 2), KIRI_OK);
    assert_int_equal(Try(NULL, 4, UnitIndices, 2), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(Unit, 4, NULL, 2), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(Unit, 2, UnitIndices, 2), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(Unit, -4, UnitIndices, 2), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(Unit, 4, UnitIndices, 0), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(Unit, 4, UnitIndices, INT32_MAX), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(Unit, 4, outside, 1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(Unit, 4, negative, 1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(nan, 4, UnitIndices, 2), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Try(infinite, 4, UnitIndices, 2), KIRI_ERROR_ARGUMENT);
    kiriMeshData mesh;
    kiriFault why;
    assert_int_equal(kiriMesh_Init(&mesh, Heap(), &(kiriMeshInput){ Unit, 4, UnitIndices, 2, 0, 0.0 }, &why),
                     KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriMesh_Init(&mesh, Heap(), &(kiriMeshInput){ Unit, 4, UnitIndices, 2, 4097, 0.0 }, &why),
                     KIRI_ERROR_ARGUMENT);
}

static void RefusesWhatIsNoSheet(void** state)
{
    (void)state;
    const int32_t repeated[] = { 0, 1, 1, 0, 2, 3 }, clockwise[] = { 0, 2, 1, 0, 2, 3 }, twice[] = { 0, 1, 2, 0, 1, 2 };
    const int32_t same[] = { 0, 1, 2, 0, 2, 3, 1, 2, 3 }, one[] = { 0, 1, 2 };
    const float point[] = { 3, 3, 3, 3, 3, 3 }, line[] = { 0, 0, 1, 1, 2, 2 };
    /* too thin for the lattice */
    const float thin[] = { 0, 0, 1, 0, 1, 1e-12f };
    assert_int_equal(Try(Unit, 4, repeated, 2), KIRI_ERROR_MESH);
    assert_int_equal(Try(Unit, 4, clockwise, 2), KIRI_ERROR_MESH);
    assert_int_equal(Try(Unit, 3, twice, 2), KIRI_ERROR_MESH);
    assert_int_equal(Try(Unit, 4, same, 3), KIRI_ERROR_MESH);
    assert_int_equal(Try(Unit, 4, one, 1), KIRI_OK); /* a vertex that no triangle has */
    assert_int_equal(Try(point, 3, one, 1), KIRI_ERROR_MESH);
    assert_int_equal(Try(line, 3, one, 1), KIRI_ERROR_MESH);
    assert_int_equal(Try(thin, 3, one, 1), KIRI_ERROR_MESH);
}

static void RefusesOverlap(void** state)
{
    (void)state;
    const int32_t two[] = { 0, 1, 2, 3, 4, 5 };
    const float crossing[] = { 0, 0, 4, 0, 2, 3, 0, 2, 2, -1, 4, 2 }, inside[] = { 0, 0, 9, 0, 0, 9, 1, 1, 2, 1, 1, 2 };
    const float apart[] = { 0, 0, 4, 0, 2, 3, 9, 0, 12, 0, 9, 3 };
    /* the corner of one in the middle of the other's side */
    const float touching[] = { 0, 0, 3, 0, 0, 3, 1.5f, 1.5f, 3, 1.5f, 3, 3 };
    assert_int_equal(Try(crossing, 6, two, 2), KIRI_ERROR_MESH);
    assert_int_equal(Try(inside, 6, two, 2), KIRI_ERROR_MESH);
    assert_int_equal(Try(apart, 6, two, 2), KIRI_OK);
    assert_int_equal(Try(touching, 6, two, 2), KIRI_OK);
}

/* A few steps of the lattice wide, beside a triangle that is as thin and ends far away: what floats are given for
   rounding does not let them lie on each other. */
static void RefusesOverlapOfTheSmallest(void** state)
{
    (void)state;
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
static void RefusesOverlapAnywhere(void** state)
{
    (void)state;
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
static void RefusesStripsOverThemselves(void** state)
{
    (void)state;
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
static void TakesCrowds(void** state)
{
    (void)state;
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
static void TakesHubs(void** state)
{
    (void)state;
    enum { SPOKES = 3000 };
    static float points[2 * (SPOKES + 1)];
    static int32_t indices[3 * SPOKES];
    kiriMeshData mesh;
    for (int32_t i = 0; i < SPOKES; ++i) {
        double angle = 6.283185307179586 * i / SPOKES;
        points[2 * i + 2] = (float)cos(angle);
        points[2 * i + 3] = (float)sin(angle);
        indices[3 * i + 1] = 1 + i;
        indices[3 * i + 2] = 1 + (i + 1) % SPOKES;
    }
    assert_int_equal(Init(&mesh, points, SPOKES + 1, indices, SPOKES), KIRI_OK);
    for (int32_t i = 0; i < SPOKES; ++i) {
        assert_int_equal(mesh.triangles.data[i].twin[2], 3 * ((i + 1) % SPOKES));
        assert_int_equal(mesh.triangles.data[i].twin[1], KIRI_NONE);
    }
    assert_int_equal(mesh.triangles.data[0].marks, 0);
    kiriMemory_FreeAll(mesh.memory);
}

/* Nine triangles wound twice around a vertex: no edge is used twice, but they lie on each other. */
static void RefusesWindingTwice(void** state)
{
    (void)state;
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

static void TakesRectangles(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 4, 2, 2.0f, 1.0f, 8);
    assert_int_equal(mesh.vertices.count, 15);
    assert_int_equal(mesh.triangles.count, 16);
    assert_int_equal(kiriMesh_DoubledArea(&mesh), (int64_t)1 << 58);
    assert_true(fabs(mesh.step - 2.0 / Size) == 0.0);
    assert_int_equal(CheckMesh(&mesh), 1);
    assert_int_equal(mesh.vertices.data[6].at.x, 1 << 27);
    assert_int_equal(mesh.vertices.data[6].at.y, 1 << 27);
    kiriMemory_FreeAll(mesh.memory);
}

/* Doubled vertices are the lips of a cut: it ends where the vertex is single. */
static void TakesSlits(void** state)
{
    (void)state;
    const float positions[] = { 0, 0, 1, 0, 2, 0, 0, 1, 1, 1, 2, 1, 1, 0 };
    const int32_t indices[] = { 0, 1, 4, 0, 4, 3, 6, 2, 5, 6, 5, 4 };
    kiriMeshData mesh;
    assert_int_equal(Init(&mesh, positions, 7, indices, 4), KIRI_OK);
    int32_t h = Find(&mesh, 1, 0, 1, 1);
    assert_true(kiriMesh_IsOpen(&mesh, h));
    assert_true(kiriMesh_Twin(&mesh, h) != KIRI_NONE);
    assert_int_equal(VerticesAt(&mesh, 1, 0), 2);
    /* the slit ends at the outline above: two fans, so the shared vertex is divided */
    assert_int_equal(mesh.vertices.count, 8);
    assert_int_equal(CheckMesh(&mesh), 2);
    kiriMemory_FreeAll(mesh.memory);
}

/* Two squares that share only a corner. */
static void DividesPinchedVertices(void** state)
{
    (void)state;
    const float positions[] = { 0, 0, 1, 0, 0, 1, 1, 1, 2, 1, 1, 2, 2, 2 };
    const int32_t indices[] = { 0, 1, 3, 0, 3, 2, 3, 4, 6, 3, 6, 5 };
    kiriMeshData mesh;
    assert_int_equal(Init(&mesh, positions, 7, indices, 4), KIRI_OK);
    assert_int_equal(mesh.vertices.count, 8);
    assert_int_equal(mesh.vertices.data[7].source, 2);
    assert_int_equal(mesh.triangles.data[0].vertex[2], 3);
    assert_int_equal(mesh.triangles.data[2].vertex[0], 7);
    assert_int_equal(CheckMesh(&mesh), 2);
    kiriMemory_FreeAll(mesh.memory);
}

static void InitWithoutMemory(void** state)
{
    (void)state;
    Rectangle r = Rectangle_Make(6, 5, 1.0f, 1.0f);
    kiriResult result = KIRI_ERROR_MEMORY;
    for (int32_t n = 0; result != KIRI_OK; ++n) {
        Meter meter = { n, 0 };
        kiriMemory memory = kiriMemory_Make(MeterAlloc, MeterFree, &meter);
        kiriMeshData mesh;
        kiriFault why;
        result = kiriMesh_Init(
            &mesh, &memory, &(kiriMeshInput){ r.positions, r.vertexCount, r.indices, r.triangleCount, 8, 0.0 }, &why);
        assert_true(result == KIRI_OK || result == KIRI_ERROR_MEMORY);
        assert_true(result != KIRI_OK || n > 8);
        kiriMemory_FreeAll(&memory);
        assert_int_equal(meter.live, 0);
    }
    Rectangle_Free(&r);
}

/* ---- Changing ---------------------------------------------------------------------------------------------------- */

static void SplitsEdges(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 2, 2.0f, 2.0f, 4);
    kiriLatticePoint inside = kiriMesh_Snap(&mesh, kiriVec2_Make(1.0, 0.25)),
                     border = kiriMesh_Snap(&mesh, kiriVec2_Make(0.75, 0.0));
    uint32_t revision = mesh.revision;
    int32_t h = Find(&mesh, 1, 0, 1, 1);
    assert_true(kiriMesh_CanSplitEdge(&mesh, h, inside));
    assert_false(kiriMesh_CanSplitEdge(&mesh, h, border));
    assert_false(kiriMesh_CanSplitEdge(&mesh, h, TailAt(&mesh, h)));
    int32_t v = kiriMesh_SplitEdge(&mesh, h, inside);
    assert_int_equal(v, 9);
    assert_int_equal(mesh.triangles.count, 10);
    assert_true(mesh.births.data[0].share[0] == 0.75 && mesh.births.data[0].share[1] == 0.25);
    CheckMesh(&mesh);
    h = Find(&mesh, 0, 0, 1, 0);
    assert_true(kiriMesh_CanSplitEdge(&mesh, h, border));
    assert_int_equal(kiriMesh_SplitEdge(&mesh, h, border), 10);
    assert_int_equal(mesh.triangles.count, 11);
    assert_int_equal(CheckMesh(&mesh), 1);
    assert_int_equal(kiriMesh_DoubledArea(&mesh), (int64_t)1 << 59);
    assert_true(mesh.revision > revision);
    kiriMemory_FreeAll(mesh.memory);
}

/* Each lip gets a point of its own, born on its own side. */
static void SplitsOpenEdges(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 2, 2.0f, 2.0f, 4);
    kiriLatticePoint at = kiriMesh_Snap(&mesh, kiriVec2_Make(1.0, 0.25));
    int32_t h = Find(&mesh, 1, 0, 1, 1);
    assert_true(kiriMesh_Open(&mesh, h));
    assert_int_equal(VerticesAt(&mesh, 1, 0), 2);
    int32_t foot = kiriMesh_Tail(&mesh, h);
    int32_t v = kiriMesh_SplitEdge(&mesh, h, at);
    assert_int_equal(mesh.vertices.count, 12);
    assert_int_equal(VerticesAt(&mesh, 1.0, 0.25), 2);
    assert_int_equal(mesh.births.data[v - mesh.oldVertexCount].parent[0], foot);
    assert_true(kiriMesh_IsOpen(&mesh, Find(&mesh, 1, 0, 1, 0.25)));
    assert_true(kiriMesh_IsOpen(&mesh, Find(&mesh, 1, 1, 1, 0.25)));
    assert_int_equal(CheckMesh(&mesh), 1);
    kiriMemory_FreeAll(mesh.memory);
}

static void SplitsTriangles(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 2, 2.0f, 2.0f, 4);
    kiriLatticePoint at = kiriMesh_Snap(&mesh, kiriVec2_Make(0.75, 0.25)),
                     edge = kiriMesh_Snap(&mesh, kiriVec2_Make(0.5, 0.0));
    int32_t t = kiriMesh_Locate(&mesh, at);
    assert_true(kiriMesh_CanSplitTriangle(&mesh, t, at));
    assert_false(kiriMesh_CanSplitTriangle(&mesh, t, edge));
    assert_int_equal(kiriMesh_SplitTriangle(&mesh, t, at), 9);
    assert_int_equal(mesh.triangles.count, 10);
    assert_int_equal(mesh.vertices.data[9].source, t);
    assert_int_equal(CheckMesh(&mesh), 1);
    assert_int_equal(kiriMesh_DoubledArea(&mesh), (int64_t)1 << 59);
    kiriMemory_FreeAll(mesh.memory);
}

static void FlipsEdges(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 2, 2.0f, 2.0f, 4);
    int32_t t = kiriMesh_Locate(&mesh, kiriMesh_Snap(&mesh, kiriVec2_Make(0.75, 0.25)));
    assert_false(kiriMesh_CanFlipEdge(&mesh, Find(&mesh, 0, 0, 1, 0))); /* the outline */
    assert_false(kiriMesh_CanFlipEdge(&mesh, Find(&mesh, 1, 0, 1, 1))); /* between two source triangles */
    assert_int_equal(kiriMesh_SplitTriangle(&mesh, t, kiriMesh_Snap(&mesh, kiriVec2_Make(0.75, 0.25))), 9);
    assert_int_equal(kiriMesh_SplitTriangle(&mesh,
                                            kiriMesh_Locate(&mesh, kiriMesh_Snap(&mesh, kiriVec2_Make(0.6, 0.1))),
                                            kiriMesh_Snap(&mesh, kiriVec2_Make(0.6, 0.1))),
                     10);
    uint32_t revision = mesh.revision;
    int32_t h = Find(&mesh, 0.75, 0.25, 1, 0);
    assert_true(kiriMesh_CanFlipEdge(&mesh, Find(&mesh, 0, 0, 0.75, 0.25)));
    assert_false(kiriMesh_CanFlipEdge(&mesh, Find(&mesh, 0.75, 0.25, 0.6, 0.1))); /* not convex */
    int32_t count = mesh.triangles.count, flips = 0;
    for (h = 0; h < 3 * count; ++h) {
        if (kiriMesh_CanFlipEdge(&mesh, h)) {
            kiriLatticePoint c = TailAt(&mesh, kiriEdge_Previous(h)),
                             d = TailAt(&mesh, kiriEdge_Previous(kiriMesh_Twin(&mesh, h)));
            assert_true(kiriMesh_FlipEdge(&mesh, h));
            assert_true(kiriDistanceSquared(TailAt(&mesh, kiriEdge_Next(h)), d) == 0);
            assert_true(kiriDistanceSquared(TailAt(&mesh, kiriEdge_Previous(h)), c) == 0);
            assert_int_equal(CheckMesh(&mesh), 1);
            assert_int_equal(kiriMesh_DoubledArea(&mesh), (int64_t)1 << 59);
            ++flips;
        }
    }
    assert_true(flips > 0 && mesh.revision > revision);
    assert_int_equal(mesh.triangles.count, count);
    assert_int_equal(mesh.vertices.count, 11);
    kiriMemory_FreeAll(mesh.memory);
}

static void OpensEdges(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 4, 2.0f, 4.0f, 4);
    /* one edge inside: both its ends stay closed */
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 1, 1, 1, 2)));
    assert_int_equal(mesh.vertices.count, 15);
    assert_int_equal(CheckMesh(&mesh), 1);
    /* a second one: the place between tears */
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 1, 3, 1, 2)));
    assert_int_equal(mesh.vertices.count, 16);
    assert_int_equal(VerticesAt(&mesh, 1, 2), 2);
    assert_int_equal(CheckMesh(&mesh), 1);
    /* again, and the outline: nothing happens */
    uint32_t revision = mesh.revision;
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 1, 3, 1, 2)));
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 0, 0, 1, 0)));
    assert_int_equal(mesh.revision, revision);
    /* to the outline on both sides */
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 1, 0, 1, 1)));
    assert_int_equal(VerticesAt(&mesh, 1, 0), 2);
    assert_int_equal(CheckMesh(&mesh), 1);
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 1, 4, 1, 3)));
    assert_int_equal(mesh.vertices.count, 20);
    assert_int_equal(CheckMesh(&mesh), 2);
    /* across: four fans at the place in the middle */
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 0, 2, 1, 2)));
    assert_true(kiriMesh_Open(&mesh, Find(&mesh, 2, 2, 1, 2)));
    assert_int_equal(VerticesAt(&mesh, 1, 2), 4);
    assert_int_equal(CheckMesh(&mesh), 4);
    kiriMemory_FreeAll(mesh.memory);
}

/* Vertices at a place, each with its lean, in the order of their index. */
static int32_t LeansAt(const kiriMeshData* mesh, double x, double y, kiriVec2 leans[4])
{
    kiriLatticePoint at = kiriMesh_Snap(mesh, kiriVec2_Make(x, y));
    int32_t count = 0;
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        if (mesh->vertices.data[v].at.x == at.x && mesh->vertices.data[v].at.y == at.y) {
            assert_true(count < 4);
            leans[count++] = kiriMesh_Lean(mesh, v);
        }
    }
    return count;
}

static void AssertLean(kiriVec2 lean, double x, double y)
{
    if (!(fabs(lean.x - x) < 1e-6 && fabs(lean.y - y) < 1e-6)) {
        fail_msg("(%g, %g) is not (%g, %g)", lean.x, lean.y, x, y);
    }
}

/* On the outline, on lips, at both ends of a slit, and inside. */
static void LeansIntoTheMaterial(void** state)
{
    (void)state;
    Rectangle r = Rectangle_Make(4, 4, 1.0f, 1.0f);
    kiriMeshData mesh;
    kiriVec2 leans[4];
    assert_int_equal(Init(&mesh, r.positions, r.vertexCount, r.indices, r.triangleCount), KIRI_OK);
    for (int k = 0; k < 2; ++k) {
        assert_true(kiriMesh_Open(&mesh, Find(&mesh, 0.25 * k + 0.25, 0.5, 0.25 * k + 0.5, 0.5)));
    }
    static const double whole[][4] = { { 0.0, 0.0, 0.125, 0.125 }, { 0.5, 0.0, 0.0, 0.25 }, { 1.0, 0.5, -0.25, 0.0 },
                                       { 0.25, 0.5, 0.0, 0.0 },    { 0.75, 0.5, 0.0, 0.0 }, { 0.5, 0.25, 0.0, 0.0 } };
    for (size_t k = 0; k < sizeof(whole) / sizeof(whole[0]); ++k) {
        assert_int_equal(LeansAt(&mesh, whole[k][0], whole[k][1], leans), 1);
        AssertLean(leans[0], whole[k][2], whole[k][3]);
    }
    assert_int_equal(LeansAt(&mesh, 0.5, 0.5, leans), 2);
    AssertLean(leans[0], 0.0, leans[0].y > 0.0 ? 0.25 : -0.25);
    AssertLean(leans[1], 0.0, -leans[0].y);
    kiriMemory_FreeAll(mesh.memory);
    Rectangle_Free(&r);
}

static void Snaps(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 2, 1.0f, 1.0f, 4);
    const double in[] = { 0.0, 0.9, 1.1, 2.9, 3.1, -0.9, -1.1, -2.9, -3.1 };
    const int32_t out[] = { 0, 0, 2, 2, 4, 0, -2, -2, -4 };
    for (int i = 0; i < 9; ++i) {
        kiriLatticePoint p = kiriMesh_Snap(&mesh, kiriVec2_Make(in[i] * mesh.step, in[8 - i] * mesh.step));
        assert_int_equal(p.x, out[i]);
        assert_int_equal(p.y, out[8 - i]);
    }
    kiriMemory_FreeAll(mesh.memory);
}

/* Random splits, flips and openings. False when memory runs out. */
static bool Scramble(kiriMeshData* mesh, uint32_t seed, int rounds)
{
    for (int i = 0; i < rounds; ++i) {
        int32_t h = (int32_t)(Random(&seed) % (uint32_t)(3 * mesh->triangles.count));
        kiriLatticePoint a = TailAt(mesh, h), b = TailAt(mesh, kiriEdge_Next(h)),
                         c = TailAt(mesh, kiriEdge_Previous(h));
        double s = RandomBetween(&seed, 0.2, 0.8), third = 1.0 / 3.0;
        kiriLatticePoint onEdge = kiriMesh_Round(kiriVec2_Make(a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)));
        kiriLatticePoint within =
            kiriMesh_Round(kiriVec2_Make(third * ((double)a.x + b.x + c.x), third * ((double)a.y + b.y + c.y)));
        uint32_t choice = Random(&seed) % 5;
        if (choice == 4) {
            if (kiriMesh_CanFlipEdge(mesh, h) && !kiriMesh_FlipEdge(mesh, h)) {
                return false;
            }
            continue;
        }
        if (choice == 0 && kiriMesh_CanSplitEdge(mesh, h, onEdge) && kiriMesh_SplitEdge(mesh, h, onEdge) == KIRI_NONE) {
            return false;
        }
        if (choice == 1 && kiriMesh_CanSplitTriangle(mesh, h / 3, within) &&
            kiriMesh_SplitTriangle(mesh, h / 3, within) == KIRI_NONE) {
            return false;
        }
        if (choice >= 2 && !kiriMesh_Open(mesh, h)) {
            return false;
        }
    }
    return true;
}

static void Locates(void** state)
{
    (void)state;
    uint32_t seed = 11;
    kiriMeshData mesh;
    InitRectangle(&mesh, 5, 3, 5.0f, 3.0f, 7);
    kiriMesh_Begin(&mesh);
    assert_true(Scramble(&mesh, 3, 20));
    for (int i = 0; i < 2000; ++i) {
        /* also on vertices and edges, on the outline and outside */
        double grain = i % 2 == 0 ? 0.25 : 1e-6;
        double x = grain * (int)(RandomBetween(&seed, -1.0, 6.0) / grain);
        double y = grain * (int)(RandomBetween(&seed, -1.0, 4.0) / grain);
        kiriLatticePoint p = kiriMesh_Snap(&mesh, kiriVec2_Make(x, y));
        int32_t expected = KIRI_NONE;
        for (int32_t t = mesh.triangles.count - 1; t >= 0; --t) {
            kiriLatticePoint c[3];
            kiriMesh_Corners(&mesh, t, c);
            bool holds =
                kiriOrient(c[0], c[1], p) >= 0 && kiriOrient(c[1], c[2], p) >= 0 && kiriOrient(c[2], c[0], p) >= 0;
            expected = holds ? t : expected;
        }
        assert_int_equal(kiriMesh_Locate(&mesh, p), expected);
    }
    kiriMemory_FreeAll(mesh.memory);
}

static void Scrambles(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 4, 4, 1.0f, 1.0f, 8);
    for (uint32_t round = 1; round <= 30; ++round) {
        kiriMesh_Begin(&mesh);
        assert_true(Scramble(&mesh, 99 * round, 20));
        CheckMesh(&mesh);
        kiriMesh_Commit(&mesh);
    }
    kiriMemory_FreeAll(mesh.memory);
}

/* The corners of the caller's triangles, from the time before any was split. */
static kiriLatticePoint* SourceCorners(const kiriMeshData* mesh)
{
    kiriLatticePoint* corners = malloc(3 * sizeof(*corners) * (size_t)mesh->triangles.count);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriMesh_Corners(mesh, t, corners + (ptrdiff_t)3 * t);
    }
    return corners;
}

static void CheckSources(const kiriMeshData* mesh, const kiriLatticePoint* corners, int32_t count)
{
    kiriLatticePoint c[3];
    for (int32_t source = 0; source < count; ++source) {
        assert_true(kiriMesh_SourceCorners(mesh, source, c));
        assert_memory_equal(c, corners + (ptrdiff_t)3 * source, sizeof(c));
    }
    assert_false(kiriMesh_SourceCorners(mesh, KIRI_NONE, c));
    assert_false(kiriMesh_SourceCorners(mesh, count, c));
}

/* Whatever is split; and only where something is split are they stored. */
static void KnowsSources(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 9, 5, 1.0f, 1.0f, 8);
    int32_t count = mesh.triangles.count;
    kiriLatticePoint* corners = SourceCorners(&mesh);
    CheckSources(&mesh, corners, count);
    assert_int_equal(mesh.sourceCorners.count, 0);
    for (uint32_t round = 1; round <= 20; ++round) {
        kiriMesh_Begin(&mesh);
        assert_true(Scramble(&mesh, 33 * round, 20));
        CheckSources(&mesh, corners, count);
        kiriMesh_Commit(&mesh);
        assert_true(round > 1 || (mesh.sourceCorners.count > 0 && mesh.sourceCorners.count < 3 * count));
    }
    free(corners);
    kiriMemory_FreeAll(mesh.memory);
}

/* A view that is written where the journal says is as good as one that is written anew. */
static void JournalTellsWhatChanged(void** state)
{
    (void)state;
    kiriMeshData mesh;
    static kiriTriangle triangles[1 << 14];
    static kiriVertex vertices[1 << 14];
    InitRectangle(&mesh, 8, 8, 1.0f, 1.0f, 8);
    memcpy(triangles, mesh.triangles.data, (size_t)mesh.triangles.count * sizeof(kiriTriangle));
    memcpy(vertices, mesh.vertices.data, (size_t)mesh.vertices.count * sizeof(kiriVertex));
    for (uint32_t round = 1; round <= 40; ++round) {
        kiriMesh_Begin(&mesh);
        assert_true(Scramble(&mesh, 33 * round, 1 + (int)round));
        for (int32_t i = 0; i < mesh.changedTriangles.count; ++i) {
            int32_t t = mesh.changedTriangles.data[i];
            triangles[t] = mesh.triangles.data[t];
            triangles[t].marks &= ~KIRI_TRIANGLE_CHANGED;
        }
        for (int32_t i = 0; i < mesh.changedVertices.count; ++i) {
            int32_t v = mesh.changedVertices.data[i];
            vertices[v] = mesh.vertices.data[v];
        }
        memcpy(triangles + mesh.oldTriangleCount, mesh.triangles.data + mesh.oldTriangleCount,
               (size_t)(mesh.triangles.count - mesh.oldTriangleCount) * sizeof(kiriTriangle));
        memcpy(vertices + mesh.oldVertexCount, mesh.vertices.data + mesh.oldVertexCount,
               (size_t)(mesh.vertices.count - mesh.oldVertexCount) * sizeof(kiriVertex));
        kiriMesh_Commit(&mesh);
        Copy view = { triangles, vertices, mesh.triangles.count, mesh.vertices.count, mesh.revision };
        assert_true(Copy_Equals(&view, &mesh));
    }
    assert_in_range(mesh.triangles.count, 300, 1 << 14);
    kiriMemory_FreeAll(mesh.memory);
}

/* Each allocation is refused once: a change that is refused has changed nothing, and is made in the next try. */
static void ChangesAreWholeOrNot(void** state)
{
    (void)state;
    Rectangle r = Rectangle_Make(4, 4, 1.0f, 1.0f);
    const kiriMeshInput input = { r.positions, r.vertexCount, r.indices, r.triangleCount, 8, 0.0 };
    Meter meter = { -1, 0 };
    kiriMemory memory = kiriMemory_Make(MeterAlloc, MeterFree, &meter);
    kiriMeshData rich, poor;
    kiriFault why;
    int32_t refused = 0;
    assert_int_equal(kiriMesh_Init(&rich, Heap(), &input, &why), KIRI_OK);
    assert_int_equal(kiriMesh_Init(&poor, &memory, &input, &why), KIRI_OK);
    kiriMesh_Begin(&rich);
    kiriMesh_Begin(&poor);
    for (uint32_t step = 1; step <= 150; ++step) {
        assert_true(Scramble(&rich, 5 * step, 1));
        for (int32_t n = 0;; ++n, ++refused) {
            Whole whole = Whole_Make(&poor);
            meter.untilFailure = n % 3;
            bool done = Scramble(&poor, 5 * step, 1);
            meter.untilFailure = -1;
            assert_true(done || Whole_Equals(&whole, &poor));
            Whole_Free(&whole);
            if (done) {
                break;
            }
        }
    }
    Whole whole = Whole_Make(&rich);
    assert_true(Whole_Equals(&whole, &poor));
    CheckMesh(&poor);
    assert_true(refused > 8);
    Whole_Free(&whole);
    kiriMemory_FreeAll(rich.memory);
    kiriMemory_FreeAll(&memory);
    assert_int_equal(meter.live, 0);
    Rectangle_Free(&r);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(SquaresListWhatTheyOverlap),
        cmocka_unit_test(SquaresThatEdgesRunThrough),
        cmocka_unit_test(SquaresAroundPoints),
        cmocka_unit_test(SquaresWithoutMemory),
        cmocka_unit_test(RefusesArguments),
        cmocka_unit_test(RefusesWhatIsNoSheet),
        cmocka_unit_test(RefusesOverlap),
        cmocka_unit_test(RefusesOverlapOfTheSmallest),
        cmocka_unit_test(RefusesOverlapAnywhere),
        cmocka_unit_test(RefusesStripsOverThemselves),
        cmocka_unit_test(RefusesWindingTwice),
        cmocka_unit_test(TakesCrowds),
        cmocka_unit_test(TakesHubs),
        cmocka_unit_test(TakesRectangles),
        cmocka_unit_test(TakesSlits),
        cmocka_unit_test(DividesPinchedVertices),
        cmocka_unit_test(InitWithoutMemory),
        cmocka_unit_test(SplitsEdges),
        cmocka_unit_test(SplitsOpenEdges),
        cmocka_unit_test(SplitsTriangles),
        cmocka_unit_test(FlipsEdges),
        cmocka_unit_test(OpensEdges),
        cmocka_unit_test(LeansIntoTheMaterial),
        cmocka_unit_test(Locates),
        cmocka_unit_test(Snaps),
        cmocka_unit_test(Scrambles),
        cmocka_unit_test(KnowsSources),
        cmocka_unit_test(JournalTellsWhatChanged),
        cmocka_unit_test(ChangesAreWholeOrNot),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
