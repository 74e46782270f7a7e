/* Cutting: hand-made cases with their counts, and random cuts after which everything must still hold. */
#include "check_mesh.h"
#include "mesh/kiri_cut.h"

static const double LatticeSize = 536870912.0;

/* 4 x 4 squares of 1 m, diagonals in turn: from lower left to upper right where column + row is even. */
static void InitSheet(kiriMeshData* mesh)
{
    InitRectangle(mesh, 4, 4, 4.0f, 4.0f, 8);
    kiriMesh_Begin(mesh);
}

/* All the way. */
static kiriProgress Move(kiriMeshData* mesh, kiriBladeTip* blade, kiriLatticePoint to, double snap)
{
    kiriQuota all = { INT64_MAX, 0, 0, false };
    return kiriCut_Move(mesh, blade, to, snap, &all);
}

static kiriBladeTip Cut(kiriMeshData* mesh, const double* xy, int count, double snap)
{
    kiriBladeTip blade = kiriCut_Place(mesh, kiriVec2_Make(xy[0], xy[1]));
    for (int i = 1; i < count; ++i) {
        assert_int_equal(Move(mesh, &blade, kiriMesh_Snap(mesh, kiriVec2_Make(xy[2 * i], xy[2 * i + 1])), snap),
                         KIRI_DONE);
    }
    return blade;
}

static void CutLine(kiriMeshData* mesh, double ax, double ay, double bx, double by)
{
    const double xy[] = { ax, ay, bx, by };
    Cut(mesh, xy, 2, 1e-4 * LatticeSize);
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

static int32_t OpenEdges(const kiriMeshData* mesh)
{
    int32_t count = 0;
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        count += kiriMesh_IsOpen(mesh, h) ? 1 : 0;
    }
    return count / 2;
}

/* Area of the piece at a place, m^2. */
static double AreaAt(const kiriMeshData* mesh, double x, double y)
{
    int32_t* piece = malloc((size_t)mesh->triangles.count * sizeof(int32_t));
    int32_t here = kiriMesh_Locate(mesh, kiriMesh_Snap(mesh, kiriVec2_Make(x, y)));
    int64_t area = 0;
    NumberPieces(mesh, piece);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        area += piece[t] == piece[here] ? kiriOrient(c[0], c[1], c[2]) : 0;
    }
    free(piece);
    return 0.5 * (double)area * mesh->step * mesh->step;
}

#define ASSERT_NEAR(a, b, tolerance) assert_true(fabs((a) - (b)) <= (tolerance))

/* Checks everything, counts, and releases. */
static void Expect(kiriMeshData* mesh, int32_t pieces, int32_t vertices, int32_t triangles, int32_t openEdges)
{
    assert_int_equal(CheckMesh(mesh), pieces);
    assert_int_equal(mesh->vertices.count, vertices);
    assert_int_equal(mesh->triangles.count, triangles);
    assert_int_equal(OpenEdges(mesh), openEdges);
    assert_int_equal(kiriMesh_DoubledArea(mesh), (int64_t)1 << 59);
    kiriMemory_FreeAll(mesh->memory);
}

/* ---- Hand-made cases on the 4 x 4 sheet: 25 vertices, 32 triangles ----------------------------------------------- */

static void CutsThrough(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, 1.3, -1.0, 1.3, 5.0);
    ASSERT_NEAR(AreaAt(&mesh, 0.5, 0.5), 5.2, 1e-7);
    ASSERT_NEAR(AreaAt(&mesh, 2.5, 0.5), 10.8, 1e-7);
    /* 5 lines and 4 diagonals are crossed: 9 places, two vertices each; 7 edges inside, 2 on the outline */
    Expect(&mesh, 2, 25 + 18, 32 + 14 + 2, 8);
}

static void EndsStayClosed(void** state)
{
    (void)state;
    const double xy[] = { 1.25, 1.125, 1.75, 1.125, 1.75, 1.25 };
    kiriMeshData mesh;
    InitSheet(&mesh);
    /* both ends in one triangle */
    Cut(&mesh, xy, 2, 1000.0);
    assert_int_equal(VerticesAt(&mesh, 1.25, 1.125), 1);
    assert_int_equal(VerticesAt(&mesh, 1.75, 1.125), 1);
    Expect(&mesh, 1, 27, 36, 1);
    InitSheet(&mesh);
    Cut(&mesh, xy, 3, 1000.0);
    assert_int_equal(VerticesAt(&mesh, 1.75, 1.125), 2);
    assert_int_equal(VerticesAt(&mesh, 1.75, 1.25), 1);
    Expect(&mesh, 1, 29, 38, 2);
}

/* The blade goes on where it was, as over several ticks. */
static void BladeGoesOn(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    kiriBladeTip blade = kiriCut_Place(&mesh, kiriVec2_Make(1.3, -1.0));
    assert_int_equal(blade.vertex, KIRI_NONE);
    for (int i = 0; i <= 12; ++i) {
        kiriLatticePoint to = kiriMesh_Snap(&mesh, kiriVec2_Make(1.3, -0.75 + 0.5 * i));
        assert_int_equal(Move(&mesh, &blade, to, 1e-4 * LatticeSize), KIRI_DONE);
        assert_int_equal(blade.vertex == KIRI_NONE, i < 2 || i > 9);
        assert_int_equal(CheckMesh(&mesh), i > 9 ? 2 : 1);
        kiriMesh_Commit(&mesh);
        kiriMesh_Begin(&mesh);
    }
    ASSERT_NEAR(AreaAt(&mesh, 0.5, 0.5), 5.2, 1e-7);
    /* standing still does nothing, wherever */
    int32_t triangles = mesh.triangles.count;
    blade = kiriCut_Place(&mesh, kiriVec2_Make(2.6, 2.7));
    assert_int_equal(Move(&mesh, &blade, blade.at, 1e-4 * LatticeSize), KIRI_DONE);
    assert_int_equal(mesh.triangles.count, triangles);
    kiriMemory_FreeAll(mesh.memory);
}

static void FollowsEdges(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, 1.0, -1.0, 1.0, 5.0);
    Expect(&mesh, 2, 30, 32, 4);
    InitSheet(&mesh);
    CutLine(&mesh, 4.0, 4.0, 0.0, 0.0);
    Expect(&mesh, 2, 30, 32, 4);
    /* starts and ends between vertices of the line */
    InitSheet(&mesh);
    CutLine(&mesh, 1.0, 0.5, 1.0, 2.75);
    Expect(&mesh, 1, 25 + 2 + 2, 32 + 4, 3);
}

static void GoesThroughVertices(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, 0.0, -1.0, 3.0, 5.0);
    assert_int_equal(VerticesAt(&mesh, 1.0, 1.0), 2);
    assert_int_equal(VerticesAt(&mesh, 2.0, 3.0), 2);
    /* new places: 2 on the outline, 3 inside */
    Expect(&mesh, 2, 25 + 10 + 2, 32 + 2 + 6, 6);
}

static void SnapsToVerticesAndEdges(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, 1.00005, -1.0, 0.99995, 5.0);
    Expect(&mesh, 2, 30, 32, 4);
    /* a start and an end beside an edge */
    const double xy[] = { 1.00005, 0.5, 1.00005, 1.5 };
    InitSheet(&mesh);
    kiriBladeTip blade = Cut(&mesh, xy, 2, 1e-4 * LatticeSize);
    assert_int_equal(blade.at.x, 1 << 27);
    Expect(&mesh, 1, 27 + 1, 36, 2);
    /* too far for a smaller snap */
    InitSheet(&mesh);
    Cut(&mesh, xy, 2, 1e-6 * LatticeSize);
    assert_int_equal(VerticesAt(&mesh, 1.00005, 1.0), 2);
    kiriMemory_FreeAll(mesh.memory);
}

/* A row of vertices at a small angle must not lead the blade away. */
static void DoesNotDrift(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 256, 2, 256.0f, 2.0f, 64);
    kiriMesh_Begin(&mesh);
    double snap = 0.01 / mesh.step;
    const double xy[] = { 0.0, 1.0, 256.0, 1.6 };
    Cut(&mesh, xy, 2, snap);
    CheckMesh(&mesh);
    for (int32_t h = 0; h < 3 * mesh.triangles.count; ++h) {
        if (kiriMesh_IsOpen(&mesh, h)) {
            kiriVec2 p = kiriMesh_Local(&mesh, TailAt(&mesh, h));
            ASSERT_NEAR(p.y, 1.0 + p.x * (0.6 / 256.0), 0.02001);
        }
    }
    kiriMemory_FreeAll(mesh.memory);
}

static void CrossesCuts(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, 1.25, -1.0, 1.25, 5.0);
    CutLine(&mesh, -1.0, 2.125, 5.0, 2.125);
    assert_int_equal(VerticesAt(&mesh, 1.25, 2.125), 4);
    ASSERT_NEAR(AreaAt(&mesh, 0.1, 0.1), 1.25 * 2.125, 1e-7);
    ASSERT_NEAR(AreaAt(&mesh, 3.9, 3.9), 2.75 * 1.875, 1e-7);
    assert_int_equal(CheckMesh(&mesh), 4);
    /* a third through their crossing, from one tip inside to another */
    CutLine(&mesh, 1.25 - 0.5, 2.125 - 0.75, 1.25 + 0.5, 2.125 + 0.75);
    assert_int_equal(VerticesAt(&mesh, 1.25, 2.125), 6);
    assert_int_equal(CheckMesh(&mesh), 4);
    kiriMemory_FreeAll(mesh.memory);
}

static void FollowsOlderCuts(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, 0.3, -1.0, 2.9, 5.0);
    int32_t vertices = mesh.vertices.count, triangles = mesh.triangles.count;
    CutLine(&mesh, 0.3, -1.0, 2.9, 5.0);
    CutLine(&mesh, 2.9, 5.0, 0.3, -1.0);
    assert_int_equal(mesh.vertices.count, vertices);
    Expect(&mesh, 2, vertices, triangles, triangles / 2 - 16);
}

static void CrossesItself(void** state)
{
    (void)state;
    const double xy[] = { 0.5, 0.5, 3.5, 0.625, 2.0, 3.0, 1.75, -1.0 };
    kiriMeshData mesh;
    InitSheet(&mesh);
    Cut(&mesh, xy, 4, 1e-4 * LatticeSize);
    assert_int_equal(CheckMesh(&mesh), 2);
    /* the triangle between the crossing, (3.5, 0.625) and (2, 3) */
    double t = (2.0 - 1.75) / 4.0, slope = 0.125 / 3.0;
    double y = (0.5 + slope * (1.75 - t - 0.5)) / (1.0 - slope * t), x = 1.75 + t * (y + 1.0);
    y = 0.5 + slope * (x - 0.5);
    for (int i = 0; i < 50; ++i) {
        x = 1.75 + t * (y + 1.0);
        y = 0.5 + slope * (x - 0.5);
    }
    double area = 0.5 * ((3.5 - x) * (3.0 - y) - (0.625 - y) * (2.0 - x));
    ASSERT_NEAR(AreaAt(&mesh, 2.2, 1.0), area, 4e-3);
    kiriMemory_FreeAll(mesh.memory);
}

static void ClosesLoops(void** state)
{
    (void)state;
    const double xy[] = { 1.2, 1.2, 2.8, 1.2, 2.8, 2.8, 1.2, 2.8, 1.2, 1.2 };
    kiriMeshData mesh;
    InitSheet(&mesh);
    Cut(&mesh, xy, 4, 1e-4 * LatticeSize);
    assert_int_equal(CheckMesh(&mesh), 1);
    InitSheet(&mesh);
    Cut(&mesh, xy, 5, 1e-4 * LatticeSize);
    ASSERT_NEAR(AreaAt(&mesh, 2.0, 2.0), 2.56, 1e-6);
    assert_int_equal(VerticesAt(&mesh, 1.2, 1.2), 2);
    assert_int_equal(CheckMesh(&mesh), 2);
    kiriMemory_FreeAll(mesh.memory);
}

static void LeavesAndComesBack(void** state)
{
    (void)state;
    const double corner[] = { 0.5, -0.5, 0.5, 0.5, -0.5, 0.5 };
    const double twice[] = { 0.5, -0.5, 0.5, 0.75, -0.5, 0.75, -0.5, 3.3, 1.5, 3.3, 1.5, 5.0 };
    kiriMeshData mesh;
    InitSheet(&mesh);
    kiriBladeTip blade = Cut(&mesh, corner, 3, 1e-4 * LatticeSize);
    assert_int_equal(blade.vertex, KIRI_NONE);
    ASSERT_NEAR(AreaAt(&mesh, 0.1, 0.1), 0.25, 1e-7);
    assert_int_equal(CheckMesh(&mesh), 2);
    InitSheet(&mesh);
    Cut(&mesh, twice, 6, 1e-4 * LatticeSize);
    ASSERT_NEAR(AreaAt(&mesh, 0.1, 0.1), 0.375, 1e-7);
    ASSERT_NEAR(AreaAt(&mesh, 0.1, 3.9), 1.05, 1e-7);
    assert_int_equal(CheckMesh(&mesh), 3);
    kiriMemory_FreeAll(mesh.memory);
}

static void LeavesTheOutlineAlone(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, -1.0, 0.0, 5.0, 0.0);
    CutLine(&mesh, 4.0, 4.0, 4.0, 1.0);
    CutLine(&mesh, -1.0, 1.0, 1.0, -1.0); /* touches a corner */
    CutLine(&mesh, -1.0, 3.0, -0.5, 9.0); /* is outside */
    CutLine(&mesh, -1.0, 9.0, 5.0, 9.0);
    Expect(&mesh, 1, 25, 32, 0);
}

/* Starts and ends on the outline. */
static void StartsOnTheOutline(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    CutLine(&mesh, 0.0, 1.5, 1.5, 0.0);
    ASSERT_NEAR(AreaAt(&mesh, 0.1, 0.1), 1.125, 1e-7);
    assert_int_equal(CheckMesh(&mesh), 2);
    InitSheet(&mesh);
    /* out of a vertex of the outline, and into another */
    CutLine(&mesh, 0.0, 3.0, 3.0, 4.0);
    ASSERT_NEAR(AreaAt(&mesh, 0.1, 3.9), 1.5, 1e-7);
    assert_int_equal(CheckMesh(&mesh), 2);
    kiriMemory_FreeAll(mesh.memory);
}

/* ---- Other outlines ---------------------------------------------------------------------------------------------- */

/* Squares of a grid of 1 m, but for those marked '.', from the top row down. */
static void InitShape(kiriMeshData* mesh, int32_t columns, int32_t rows, const char* shape)
{
    Rectangle r = Rectangle_Make(columns, rows, (float)columns, (float)rows);
    int32_t* number = malloc((size_t)r.vertexCount * sizeof(int32_t));
    int32_t vertexCount = 0, kept = 0;
    memset(number, 0xff, (size_t)r.vertexCount * sizeof(int32_t));
    for (int32_t t = 0; t < r.triangleCount; ++t) {
        int32_t square = t / 2, row = square / columns;
        for (int i = 0; i < 3 && shape[(rows - 1 - row) * columns + square % columns] != '.'; ++i) {
            r.indices[kept++] = r.indices[3 * t + i];
        }
    }
    for (int32_t i = 0; i < kept; ++i) {
        number[r.indices[i]] = 0;
    }
    for (int32_t v = 0; v < r.vertexCount; ++v) {
        if (number[v] == 0) {
            memcpy(&r.positions[2 * vertexCount], &r.positions[2 * v], 2 * sizeof(float));
            number[v] = vertexCount++;
        }
    }
    for (int32_t i = 0; i < kept; ++i) {
        r.indices[i] = number[r.indices[i]];
    }
    kiriFault why;
    assert_int_equal(
        kiriMesh_Init(mesh, Heap(), &(kiriMeshInput){ r.positions, vertexCount, r.indices, kept / 3, 8, 0.0 }, &why),
        KIRI_OK);
    kiriMesh_Begin(mesh);
    free(number);
    Rectangle_Free(&r);
}

static void CutsOverGaps(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitShape(&mesh, 3, 2,
              "#.#"
              "###");
    CutLine(&mesh, -1.0, 1.4, 4.0, 1.4);
    ASSERT_NEAR(AreaAt(&mesh, 0.5, 1.9), 0.6, 1e-7);
    ASSERT_NEAR(AreaAt(&mesh, 2.5, 1.9), 0.6, 1e-7);
    assert_int_equal(CheckMesh(&mesh), 3);
    InitShape(&mesh, 3, 2,
              "#.#"
              "###");
    /* over the gap from one tip inside to another */
    CutLine(&mesh, 0.5, 1.4, 2.5, 1.4);
    assert_int_equal(CheckMesh(&mesh), 1);
    InitShape(&mesh, 3, 2,
              "#.#"
              "###");
    /* along the bottom of the gap: two slits */
    CutLine(&mesh, 0.0, 1.0, 3.0, 1.0);
    assert_int_equal(CheckMesh(&mesh), 3);
    assert_int_equal(OpenEdges(&mesh), 2);
    InitShape(&mesh, 3, 2,
              "#.#"
              "###");
    CutLine(&mesh, 3.0, 1.0, 0.0, 1.0);
    assert_int_equal(CheckMesh(&mesh), 3);
    assert_int_equal(OpenEdges(&mesh), 2);
    kiriMemory_FreeAll(mesh.memory);
}

static void CutsToHoles(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitShape(&mesh, 3, 3,
              "###"
              "#.#"
              "###");
    CutLine(&mesh, -1.0, 1.5, 1.5, 1.5);
    assert_int_equal(CheckMesh(&mesh), 1);
    CutLine(&mesh, 1.5, 1.4, 4.0, 1.25);
    assert_int_equal(CheckMesh(&mesh), 2);
    InitShape(&mesh, 3, 3,
              "###"
              "#.#"
              "###");
    CutLine(&mesh, -1.0, -1.0, 4.0, 4.0);
    assert_int_equal(CheckMesh(&mesh), 2);
    ASSERT_NEAR(AreaAt(&mesh, 2.0, 0.5), 4.0, 1e-7);
    kiriMemory_FreeAll(mesh.memory);
}

/* Squares that touch at corners only: twins do not lead over them. */
static void CutsThroughPinches(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitShape(&mesh, 2, 2,
              ".#"
              "#.");
    assert_int_equal(CheckMesh(&mesh), 2);
    CutLine(&mesh, -1.0, -1.0, 3.0, 3.0);
    assert_int_equal(CheckMesh(&mesh), 4);
    assert_int_equal(VerticesAt(&mesh, 1.0, 1.0), 4);
    InitShape(&mesh, 2, 2,
              ".#"
              "#.");
    CutLine(&mesh, 0.0, -1.0, 2.0, 3.0);
    ASSERT_NEAR(AreaAt(&mesh, 0.1, 0.5), 0.75, 1e-7);
    ASSERT_NEAR(AreaAt(&mesh, 1.9, 1.5), 0.75, 1e-7);
    assert_int_equal(CheckMesh(&mesh), 4);
    InitShape(&mesh, 2, 2,
              ".#"
              "#.");
    /* from the pinch, which the blade holds by one vertex, into either square */
    for (int side = 0; side < 2; ++side) {
        const double xy[] = { 1.0, 1.0, side == 0 ? 0.4 : 1.6, side == 0 ? -1.0 : 3.0 };
        Cut(&mesh, xy, 2, 1e-4 * LatticeSize);
        assert_int_equal(CheckMesh(&mesh), 3 + side);
    }
    kiriMemory_FreeAll(mesh.memory);
}

/* The blade only touches the sharp corner; it must not be led along a side. */
static void TouchesSharpCorners(void** state)
{
    (void)state;
    const float left[] = { 0, 0, 4, 0, 4, 1 }, right[] = { 0, 0, 4, -1, 4, 0 };
    const int32_t indices[] = { 0, 1, 2 };
    kiriFault why;
    for (int side = -1; side <= 1; side += 2) {
        kiriMeshData mesh;
        assert_int_equal(
            kiriMesh_Init(&mesh, Heap(), &(kiriMeshInput){ side > 0 ? left : right, 3, indices, 1, 8, 0.0 }, &why),
            KIRI_OK);
        kiriMesh_Begin(&mesh);
        double base = side > 0 ? 0.0 : 1.0; /* local coordinates start at the box's corner */
        CutLine(&mesh, -1.5, base - side, 3.0, base + 2.0 * side);
        assert_int_equal(mesh.triangles.count, 1);
        kiriMemory_FreeAll(mesh.memory);
    }
}

/* A corner in the middle of another part's side: the blade goes on from part to part. */
static void CutsThroughSplitSides(void** state)
{
    (void)state;
    const float positions[] = { 0, 0, 1, 0, 1, 2, 0, 2, 1, 0, 2, 0, 2, 1, 1, 1, 2, 2, 1, 2 };
    const int32_t indices[] = { 0, 1, 2, 0, 2, 3, 4, 5, 6, 4, 6, 7, 7, 6, 8, 7, 8, 9 };
    kiriFault why;
    for (int way = 0; way < 2; ++way) {
        kiriMeshData mesh;
        assert_int_equal(kiriMesh_Init(&mesh, Heap(), &(kiriMeshInput){ positions, 10, indices, 6, 8, 0.0 }, &why),
                         KIRI_OK);
        kiriMesh_Begin(&mesh);
        assert_int_equal(CheckPieces(&mesh), 2);
        CutLine(&mesh, way == 0 ? -1.0 : 3.0, 1.0, way == 0 ? 3.0 : -1.0, 1.0);
        /* the parts stay apart: what is an edge on both sides now has no twins */
        assert_int_equal(VerticesAt(&mesh, 1.0, 1.0), 4);
        CheckConnections(&mesh, false);
        assert_int_equal(CheckPieces(&mesh), 4);
        kiriMemory_FreeAll(mesh.memory);
    }
}

/* ---- Range ------------------------------------------------------------------------------------------------------- */

static void Clips(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 2, 1.0f, 1.0f, 4);
    kiriVec2 from = { 0.25, 0.5 }, to = { 0.75, 1.25 };
    assert_true(kiriCut_Clip(&mesh, &from, &to));
    assert_true(from.x == 0.25 && from.y == 0.5 && to.x == 0.75 && to.y == 1.25);
    from = kiriVec2_Make(-2.0, 0.0);
    to = kiriVec2_Make(2.0, 1.0);
    assert_true(kiriCut_Clip(&mesh, &from, &to));
    ASSERT_NEAR(from.x, -0.5, 0.0);
    ASSERT_NEAR(from.y, 0.375, 1e-15);
    ASSERT_NEAR(to.x, 1.5, 0.0);
    ASSERT_NEAR(to.y, 0.875, 1e-15);
    from = kiriVec2_Make(-2.0, 0.0);
    to = kiriVec2_Make(0.0, 3.0);
    assert_false(kiriCut_Clip(&mesh, &from, &to));
    from = kiriVec2_Make(-2.0, 1.0);
    to = kiriVec2_Make(-2.0, 0.0);
    assert_false(kiriCut_Clip(&mesh, &from, &to));
    from = kiriVec2_Make(-1.7e308, 0.5);
    to = kiriVec2_Make(1.7e308, 0.5);
    assert_true(kiriCut_Clip(&mesh, &from, &to));
    assert_true(from.x == -0.5 && to.x == 1.5 && fabs(from.y - 0.5) < 1e-15 && fabs(to.y - 0.5) < 1e-15);
    kiriMemory_FreeAll(mesh.memory);
}

static void PlacesWithinRange(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 2, 2, 1.0f, 1.0f, 4);
    kiriBladeTip blade = kiriCut_Place(&mesh, kiriVec2_Make(-1e300, 1e300));
    assert_int_equal(blade.at.x, -(1 << 28));
    assert_int_equal(blade.at.y, 3 << 28);
    blade = kiriCut_Place(&mesh, kiriVec2_Make(0.25, 0.5));
    assert_int_equal(blade.at.x, 1 << 27);
    assert_int_equal(blade.at.y, 1 << 28);
    assert_int_equal(blade.vertex, KIRI_NONE);
    /* from corner to corner of the range: the largest products there are */
    kiriMesh_Begin(&mesh);
    const double xy[] = { -9.0, -9.0, 9.0, 9.0 };
    blade = kiriCut_Place(&mesh, kiriVec2_Make(xy[0], xy[1]));
    kiriBladeTip end = kiriCut_Place(&mesh, kiriVec2_Make(xy[2], xy[3]));
    assert_int_equal(Move(&mesh, &blade, end.at, 1.0), KIRI_DONE);
    assert_int_equal(CheckMesh(&mesh), 2);
    kiriMemory_FreeAll(mesh.memory);
}

/* ---- Parts that lie on each other -------------------------------------------------------------------------------- */

/* Where the longer side of the sheet is this long, lattice steps are 1. */
#define LATTICE_SIDE 536870912.0f

static void InitLoose(kiriMeshData* mesh, const float* corners, int32_t triangles)
{
    const int32_t indices[] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
    kiriFault why;
    assert_int_equal(
        kiriMesh_Init(mesh, Heap(), &(kiriMeshInput){ corners, 3 * triangles, indices, triangles, 8, 0.0 }, &why),
        KIRI_OK);
    kiriMesh_Begin(mesh);
}

/* The corner (0, 60) of the first triangle is on the left side of the second: they lie on each other by as much as
   floats are given for rounding. A blade that starts there, along the second edge that ends there, must not make it
   again. */
static void MakesNoEdgeTwice(void** state)
{
    (void)state;
    const float side = LATTICE_SIDE;
    const float corners[] = { 0, 60, side, 0, side, side, 0, 0, side, side, 0, side };
    const double steps[] = { 2.0, 1e3, 1e-4 * LatticeSize };
    for (int i = 0; i < 3; ++i) {
        kiriMeshData mesh;
        InitLoose(&mesh, corners, 2);
        const double xy[] = { 0.0, 60.0, side, side }, back[] = { side, side, 0.0, 60.0 };
        Cut(&mesh, xy, 2, steps[i]);
        CheckConnections(&mesh, false);
        Cut(&mesh, back, 2, steps[i]);
        CheckConnections(&mesh, false);
        kiriMemory_FreeAll(mesh.memory);
    }
}

/* Two squares of few steps, each of two triangles, and one that goes far up; three corners are moved by up to four
   eighths of a square. */
static kiriResult InitFewSteps(kiriMeshData* mesh, uint32_t* seed, int32_t unit)
{
    static const float eighths[] = { 0, 0, 8, 0, 8, 8, 0, 0, 8, 8, 0, 8, 8, 0, 16, 0, 8, 8, 16, 0, 16, 8, 8, 8 };
    const int32_t indices[] = { 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11 };
    kiriFault why;
    float corners[24];
    for (int i = 0; i < 24; ++i) {
        corners[i] = (float)unit * eighths[i];
    }
    for (int i = 0; i < 3; ++i) {
        float far = (float)(unit < 16 || Random(seed) % 2 == 0 ? unit : 16);
        corners[Random(seed) % 24] += far * ((float)(Random(seed) % 5) - 2.0f);
    }
    corners[15] = LATTICE_SIDE;
    return kiriMesh_Init(mesh, Heap(), &(kiriMeshInput){ corners, 12, indices, 4, 8, 0.0 }, &why);
}

/* Blades with places like those of the corners. */
static void MakesNoEdgeTwiceAmongFewSteps(void** state)
{
    (void)state;
    uint32_t seed = 77;
    int32_t made = 0;
    for (int round = 0; round < 6000; ++round) {
        kiriMeshData mesh;
        int32_t unit = 2 << Random(&seed) % 8;
        if (InitFewSteps(&mesh, &seed, unit) == KIRI_OK) {
            kiriMesh_Begin(&mesh);
            for (int i = 0; i < 6; ++i) {
                double xy[8];
                for (int k = 0; k < 8; ++k) {
                    xy[k] = unit * ((double)(Random(&seed) % 21) - 2.0) + 2.0 * (double)(Random(&seed) % 2);
                }
                Cut(&mesh, xy, 4, (double)(Random(&seed) % (round % 2 == 0 ? 4 : 200)));
            }
            CheckConnections(&mesh, false);
            ++made;
        }
        kiriMemory_FreeAll(Heap());
    }
    assert_in_range(made, 500, 6000);
}

/* ---- Random cuts ------------------------------------------------------------------------------------------------- */

enum { MOST_POINTS = 12 };

typedef struct Polyline {
    kiriLatticePoint points[MOST_POINTS];
    int count;
} Polyline;

/* What the generator draws on: earlier points are used again, in this and in later cuts. */
typedef struct Pool {
    kiriLatticePoint points[64];
    uint32_t used;
} Pool;

static kiriLatticePoint RandomPoint(uint32_t* seed, const Pool* pool, kiriLatticePoint last, double reach)
{
    uint32_t choice = Random(seed) % 16;
    if (choice == 0 && pool->used > 0) {
        return pool->points[Random(seed) % (pool->used < 64 ? pool->used : 64)];
    }
    double x = last.x + LatticeSize * RandomBetween(seed, -reach, reach);
    double y = last.y + LatticeSize * RandomBetween(seed, -reach, reach);
    double cell = LatticeSize / 16.0;
    if (choice == 1 || choice == 2) { /* along a grid line, or to a vertex */
        x = cell * (int32_t)(x / cell + 0.5);
    }
    if (choice == 2 || choice == 3) {
        y = cell * (int32_t)(y / cell + 0.5);
    }
    double low = -0.2 * LatticeSize, high = 1.2 * LatticeSize;
    x = x < low ? low : x > high ? high : x;
    y = y < low ? low : y > high ? high : y;
    return kiriMesh_Round(kiriVec2_Make(x, y));
}

static Polyline RandomPolyline(uint32_t* seed, Pool* pool, double reach)
{
    Polyline line;
    kiriLatticePoint middle = { 1 << 28, 1 << 28 };
    line.count = 2 + (int)(Random(seed) % (MOST_POINTS - 1));
    line.points[0] = RandomPoint(seed, pool, middle, 0.7);
    for (int i = 1; i < line.count; ++i) {
        line.points[i] = RandomPoint(seed, pool, line.points[i - 1], reach);
        pool->points[pool->used++ % 64] = line.points[i];
    }
    if (line.count > 2 && Random(seed) % 4 == 0) {
        line.points[line.count - 1] = line.points[0];
    }
    return line;
}

static bool CutPolyline(kiriMeshData* mesh, const Polyline* line, double snap)
{
    kiriBladeTip blade = kiriCut_PlaceAt(line->points[0]);
    for (int i = 1; i < line->count; ++i) {
        if (Move(mesh, &blade, line->points[i], snap) != KIRI_DONE) {
            return false;
        }
    }
    return true;
}

static double DistanceToEdge(kiriLatticePoint p, kiriLatticePoint a, kiriLatticePoint b)
{
    kiriVec2 ab = kiriVec2_Make((double)b.x - a.x, (double)b.y - a.y),
             ap = kiriVec2_Make((double)p.x - a.x, (double)p.y - a.y);
    double s = kiriVec2_Dot(ab, ap) / kiriVec2_Dot(ab, ab);
    s = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
    return kiriVec2_Length(kiriVec2_Sub(ap, kiriVec2_Scale(s, ab)));
}

/* Distance from a place to the nearest open edge or outline in the squares around it. */
static double DistanceToCut(const kiriMeshData* mesh, kiriLatticePoint p)
{
    const kiriSquares* squares = &mesh->squares;
    double least = 1e30;
    for (int32_t k = 0; k < 9; ++k) {
        kiriLatticePoint q = { p.x + (k % 3 - 1) * squares->side, p.y + (k / 3 - 1) * squares->side };
        int32_t square = kiriSquares_At(squares, q), i = square == KIRI_NONE ? KIRI_NONE : squares->head[square];
        for (; i != KIRI_NONE; i = squares->nodes.data[i].next) {
            int32_t h = 3 * squares->nodes.data[i].triangle;
            for (int32_t end = h + 3; h < end; ++h) {
                if (kiriMesh_IsOpen(mesh, h) || kiriMesh_Twin(mesh, h) == KIRI_NONE) {
                    double distance = DistanceToEdge(p, TailAt(mesh, h), TailAt(mesh, kiriEdge_Next(h)));
                    least = distance < least ? distance : least;
                }
            }
        }
    }
    return least;
}

/* Every place of the polyline inside the sheet is open, or beside lips that the blade has joined instead, at both ends. */
static void CheckFollowed(const kiriMeshData* mesh, const Polyline* line, double snap)
{
    for (int i = 1; i < line->count; ++i) {
        kiriLatticePoint a = line->points[i - 1], b = line->points[i];
        for (int k = 0; k <= 16; ++k) {
            double s = k / 16.0;
            kiriLatticePoint p =
                kiriMesh_Round(kiriVec2_Make(a.x + s * ((double)b.x - a.x), a.y + s * ((double)b.y - a.y)));
            if (kiriMesh_Locate(mesh, p) != KIRI_NONE) {
                assert_true(DistanceToCut(mesh, p) <= 5.0 * snap + 64.0);
            }
        }
    }
}

static void CutAtRandom(kiriMeshData* mesh, uint32_t seed, int count, double reach, double snap, int checkEvery)
{
    Pool pool = { { { 0, 0 } }, 0 };
    for (int i = 1; i <= count; ++i) {
        Polyline line = RandomPolyline(&seed, &pool, reach);
        int64_t area = kiriMesh_DoubledArea(mesh);
        kiriMesh_Begin(mesh);
        assert_true(CutPolyline(mesh, &line, snap));
        if (snap >= 64.0) {
            CheckFollowed(mesh, &line, snap);
        }
        if (i % checkEvery == 0) {
            CheckMesh(mesh);
        }
        double change = (double)(kiriMesh_DoubledArea(mesh) - area);
        assert_true(change == 0.0 || fabs(change) <= 1e-9 * (double)area);
        kiriMesh_Commit(mesh);
    }
    CheckMesh(mesh);
}

static void CutsAtRandomOnOneSheet(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitRectangle(&mesh, 16, 16, 1.0f, 1.0f, 32);
    CutAtRandom(&mesh, 2015, 1000, 0.06, 1e-3 * LatticeSize, 40);
    assert_int_equal(kiriMesh_DoubledArea(&mesh), (int64_t)1 << 59);
    kiriMemory_FreeAll(mesh.memory);
}

static void CutsAtRandomFarAndWide(void** state)
{
    (void)state;
    const double snaps[] = { 0.0, 2.0, 1e-6, 1e-4, 1e-2 };
    for (uint32_t round = 0; round < 25; ++round) {
        kiriMeshData mesh;
        double snap = snaps[round % 5] < 1.0 ? snaps[round % 5] * LatticeSize : snaps[round % 5];
        InitRectangle(&mesh, 16, 16, 1.0f, 1.0f, 1 + (int32_t)round);
        CutAtRandom(&mesh, 100 + round, 8, 0.6, snap, 1);
        assert_int_equal(kiriMesh_DoubledArea(&mesh), (int64_t)1 << 59);
        kiriMemory_FreeAll(mesh.memory);
    }
}

/* A ring of 12 x 48 squares that is almost a disc, with slanted outlines. */
static void InitRing(kiriMeshData* mesh)
{
    enum { RINGS = 12, SPOKES = 48 };
    static float positions[2 * (RINGS + 1) * SPOKES];
    static int32_t indices[6 * RINGS * SPOKES];
    for (int i = 0; i < (RINGS + 1) * SPOKES; ++i) {
        double angle = 6.283185307179586 * (i % SPOKES) / SPOKES, radius = 0.12 + 0.38 * (i / SPOKES) / RINGS;
        positions[2 * i] = (float)(0.5 + radius * cos(angle));
        positions[2 * i + 1] = (float)(0.5 + radius * sin(angle));
    }
    for (int i = 0; i < RINGS * SPOKES; ++i) {
        int a = i, b = i - i % SPOKES + (i + 1) % SPOKES;
        const int32_t corners[6] = { a, b + SPOKES, b, a, a + SPOKES, b + SPOKES };
        memcpy(&indices[6 * i], corners, sizeof(corners));
    }
    kiriFault why;
    assert_int_equal(
        kiriMesh_Init(mesh, Heap(),
                      &(kiriMeshInput){ positions, (RINGS + 1) * SPOKES, indices, 2 * RINGS * SPOKES, 24, 0.0 }, &why),
        KIRI_OK);
}

/* Points on a slanted outline are rounded to the lattice, which moves the outline by a step: 2^-29 of the size. */
static void CutsAtRandomOnARing(void** state)
{
    (void)state;
    for (uint32_t round = 0; round < 6; ++round) {
        kiriMeshData mesh;
        InitRing(&mesh);
        int64_t area = kiriMesh_DoubledArea(&mesh);
        CutAtRandom(&mesh, 500 + round, 30, round % 2 == 0 ? 0.5 : 0.1, 1e-4 * LatticeSize, 5);
        assert_true(fabs((double)(kiriMesh_DoubledArea(&mesh) - area)) <= 1e-8 * (double)area);
        kiriMemory_FreeAll(mesh.memory);
    }
}

/* Cuts while one request after another is refused. A blade goes on where it was, and the mesh comes out as if nothing
   had been refused. */
static void GoesOnAfterRefusals(void** state)
{
    (void)state;
    Rectangle r = Rectangle_Make(8, 8, 1.0f, 1.0f);
    const kiriMeshInput input = { r.positions, r.vertexCount, r.indices, r.triangleCount, 20, 0.0 };
    int32_t refused = 0;
    for (uint32_t round = 1; round <= 10; ++round) {
        Meter meter = { -1, 0 };
        kiriMemory memory = kiriMemory_Make(MeterAlloc, MeterFree, &meter);
        kiriMeshData rich, poor;
        kiriFault why;
        uint32_t seed = 9 * round;
        Pool pool = { { { 0, 0 } }, 0 };
        assert_int_equal(kiriMesh_Init(&rich, Heap(), &input, &why), KIRI_OK);
        assert_int_equal(kiriMesh_Init(&poor, &memory, &input, &why), KIRI_OK);
        kiriMesh_Begin(&rich);
        kiriMesh_Begin(&poor);
        for (int i = 0; i < 20; ++i) {
            Polyline line = RandomPolyline(&seed, &pool, 0.3);
            assert_true(CutPolyline(&rich, &line, 1e-4 * LatticeSize));
            kiriBladeTip blade = kiriCut_PlaceAt(line.points[0]);
            for (int k = 1; k < line.count; ++k) {
                for (int32_t n = 0;; ++n, ++refused) {
                    meter.untilFailure = n % 5;
                    kiriProgress progress = Move(&poor, &blade, line.points[k], 1e-4 * LatticeSize);
                    meter.untilFailure = -1;
                    if (progress == KIRI_DONE) {
                        break;
                    }
                    assert_int_equal(progress, KIRI_FAILED);
                }
            }
        }
        Whole whole = Whole_Make(&rich);
        assert_true(Whole_Equals(&whole, &poor));
        CheckMesh(&poor);
        Whole_Free(&whole);
        kiriMemory_FreeAll(rich.memory);
        kiriMemory_FreeAll(&memory);
        assert_int_equal(meter.live, 0);
    }
    assert_true(refused > 100);
    Rectangle_Free(&r);
}

/* ---- Interrupted moves ------------------------------------------------------------------------------------------- */

/* Triangles that were not there, or had corners elsewhere: tearing a vertex does not count. */
static int64_t CountReshaped(const kiriMeshData* mesh, const Copy* before)
{
    int64_t count = mesh->triangles.count - before->triangleCount;
    for (int32_t t = 0; t < before->triangleCount; ++t) {
        bool same = true;
        for (int i = 0; i < 3; ++i) {
            kiriLatticePoint p = before->vertices[before->triangles[t].vertex[i]].at, q = TailAt(mesh, 3 * t + i);
            same = same && p.x == q.x && p.y == q.y;
        }
        count += same ? 0 : 1;
    }
    return count;
}

static bool SameMesh(const kiriMeshData* a, const kiriMeshData* b)
{
    Copy copy = Copy_Make(a);
    bool same = Copy_Equals(&copy, b) && a->births.count == b->births.count;
    for (int32_t i = 0; same && i < a->births.count; ++i) {
        const kiriBirth *p = &a->births.data[i], *q = &b->births.data[i];
        same =
            memcmp(p->parent, q->parent, sizeof(p->parent)) == 0 && memcmp(p->share, q->share, sizeof(p->share)) == 0;
    }
    Copy_Free(&copy);
    return same;
}

/* Cuts with quotas up to `most` items, just enough for a step at least. Returns the items used. */
static int64_t CutInParts(kiriMeshData* mesh, const Polyline* line, double snap, uint32_t* seed, uint32_t most,
                          bool count)
{
    kiriBladeTip blade = kiriCut_PlaceAt(line->points[0]);
    int64_t used = 0;
    for (int i = 1; i < line->count; ++i) {
        kiriProgress progress = KIRI_MORE;
        while (progress == KIRI_MORE) {
            int64_t given = KIRI_MOST_SPLITS + (most > 0 ? Random(seed) % most : 0);
            kiriQuota quota = { given, 0, 0, false };
            Copy before = count ? Copy_Make(mesh) : (Copy){ NULL, NULL, 0, 0, 0 };
            progress = kiriCut_Move(mesh, &blade, line->points[i], snap, &quota);
            assert_true(progress != KIRI_FAILED && quota.left >= 0 && quota.left + quota.used == given);
            assert_true(progress == KIRI_DONE || quota.left < KIRI_MOST_SPLITS);
            if (count && quota.used > 0) { /* one step */
                int64_t reshaped = CountReshaped(mesh, &before);
                assert_true(quota.used >= (reshaped > 0 ? reshaped : 1));
            }
            Copy_Free(&before);
            used += quota.used;
        }
    }
    return used + blade.owed;
}

static void InterruptedMovesGoOn(void** state)
{
    (void)state;
    const double snaps[] = { 0.0, 1e-6, 1e-4, 1e-2 };
    for (uint32_t round = 0; round < 8; ++round) {
        kiriMeshData whole, steps, parts;
        kiriMeshData* meshes[] = { &whole, &steps, &parts };
        uint32_t seed = 70 + round;
        Pool pool = { { { 0, 0 } }, 0 };
        for (int k = 0; k < 3; ++k) {
            InitRectangle(meshes[k], 8, 8, 1.0f, 1.0f, 16);
        }
        for (int i = 0; i < 12; ++i) {
            double snap = snaps[round % 4] * LatticeSize;
            Polyline line = RandomPolyline(&seed, &pool, round < 4 ? 0.6 : 0.1);
            for (int k = 0; k < 3; ++k) {
                kiriMesh_Begin(meshes[k]);
            }
            assert_true(CutPolyline(&whole, &line, snap));
            int64_t used = CutInParts(&steps, &line, snap, &seed, 0, true);
            assert_true(CutInParts(&parts, &line, snap, &seed, 40, false) >=
                        used); /* the last gets no more than is left */
            assert_true(SameMesh(&whole, &steps) && SameMesh(&whole, &parts));
        }
        assert_true(whole.triangles.count > 300);
        CheckMesh(&parts);
        for (int k = 0; k < 3; ++k) {
            kiriMemory_FreeAll(meshes[k]->memory);
        }
    }
}

/* Less than a step needs: nothing happens, however often. */
static void SmallQuotasWait(void** state)
{
    (void)state;
    kiriMeshData mesh;
    InitSheet(&mesh);
    kiriBladeTip blade = kiriCut_Place(&mesh, kiriVec2_Make(0.3, 0.2));
    kiriLatticePoint to = kiriMesh_Snap(&mesh, kiriVec2_Make(3.7, 2.9));
    Copy copy = Copy_Make(&mesh);
    kiriQuota quota = { KIRI_MOST_SPLITS - 1, 0, 0, false };
    for (int i = 0; i < 3; ++i) {
        assert_int_equal(kiriCut_Move(&mesh, &blade, to, 1.0, &quota), KIRI_MORE);
    }
    assert_true(quota.left == KIRI_MOST_SPLITS - 1 && quota.used == 0 && Copy_Equals(&copy, &mesh));
    assert_int_equal(Move(&mesh, &blade, to, 1.0), KIRI_DONE);
    assert_true(blade.at.x == to.x && blade.at.y == to.y);
    Copy_Free(&copy);
    kiriMemory_FreeAll(mesh.memory);
}

/* The items of a short cut. */
static int64_t ItemsOfCut(int32_t squares, int32_t resolution)
{
    kiriMeshData mesh;
    InitRectangle(&mesh, squares, squares, 1.0f, 1.0f, resolution);
    kiriMesh_Begin(&mesh);
    kiriBladeTip blade = kiriCut_Place(&mesh, kiriVec2_Make(0.401, 0.413));
    kiriQuota all = { INT64_MAX, 0, 0, false };
    assert_int_equal(kiriCut_Move(&mesh, &blade, kiriMesh_Snap(&mesh, kiriVec2_Make(0.443, 0.437)), 1.0, &all),
                     KIRI_DONE);
    kiriMemory_FreeAll(mesh.memory);
    return all.used;
}

/* A step counts for more than its triangles where they are in many squares, or where a square has very many. */
static void StepsCountWhatTheyLookAt(void** state)
{
    (void)state;
    int64_t few = ItemsOfCut(4, 4);
    assert_true(few <= 16);
    assert_true(ItemsOfCut(4, 64) > few && ItemsOfCut(4, 256) > 10 * ItemsOfCut(4, 64));
    assert_true(ItemsOfCut(64, 1) > 3 * ItemsOfCut(64, 64));
}

/* ---- Dirty squares ----------------------------------------------------------------------------------------------- */

static uint64_t Mix(uint64_t hash, int64_t value)
{
    hash = (hash ^ (uint64_t)value) * 0x9E3779B97F4A7C15u;
    return hash ^ hash >> 29;
}

/* All that a grid can see of a square, whatever the order of its lists: its triangles, how they hang together in it,
   and its vertices. */
static uint64_t Fingerprint(const kiriMeshData* mesh, int32_t square)
{
    const kiriSquares* squares = &mesh->squares;
    uint64_t sum = 0;
    for (int32_t i = squares->head[square]; i != KIRI_NONE; i = squares->nodes.data[i].next) {
        int32_t t = squares->nodes.data[i].triangle;
        uint64_t hash = Mix(1, t);
        for (int32_t h = 3 * t; h < 3 * t + 3; ++h) {
            kiriLatticePoint a = TailAt(mesh, h), b = TailAt(mesh, kiriEdge_Next(h));
            hash = Mix(Mix(hash, a.x), a.y);
            if (kiriSquares_RunsThrough(squares, square, a, b)) {
                hash = Mix(Mix(hash, kiriMesh_Twin(mesh, h)), kiriMesh_IsOpen(mesh, h));
            }
        }
        sum += hash;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        if (kiriSquares_At(squares, vertex->at) == square) {
            sum += Mix(Mix(Mix(Mix(2, v), vertex->at.x), vertex->at.y), vertex->edge);
        }
    }
    return sum;
}

static void TakeFingerprints(const kiriMeshData* mesh, uint64_t* prints)
{
    for (int32_t s = 0; s < mesh->squares.columns * mesh->squares.rows; ++s) {
        prints[s] = Fingerprint(mesh, s);
    }
}

/* What has changed is dirty. Returns how many squares are dirty and have not changed. */
static int32_t CheckDirty(const kiriMeshData* mesh, uint64_t* prints)
{
    int32_t needless = 0;
    for (int32_t s = 0; s < mesh->squares.columns * mesh->squares.rows; ++s) {
        uint64_t now = Fingerprint(mesh, s);
        assert_true(now == prints[s] || mesh->squares.isDirty[s]);
        needless += now == prints[s] && mesh->squares.isDirty[s] ? 1 : 0;
        prints[s] = now;
    }
    return needless;
}

static void DirtiesWhatChanges(void** state)
{
    (void)state;
    static uint64_t prints[32 * 32];
    int32_t changed = 0;
    for (uint32_t round = 0; round < 4; ++round) {
        kiriMeshData mesh;
        uint32_t seed = 60 + round;
        Pool pool = { { { 0, 0 } }, 0 };
        InitRectangle(&mesh, round % 2 == 0 ? 24 : 2, 16, 1.0f, 1.0f, 32);
        assert_int_equal(mesh.squares.dirty.count, mesh.squares.columns * mesh.squares.rows);
        TakeFingerprints(&mesh, prints);
        for (int i = 0; i < 30; ++i) {
            Polyline line = RandomPolyline(&seed, &pool, round < 2 ? 0.05 : 0.4);
            kiriSquares_ClearDirty(&mesh.squares);
            kiriMesh_Begin(&mesh);
            assert_true(CutPolyline(&mesh, &line, 1e-4 * LatticeSize));
            assert_int_equal(CheckDirty(&mesh, prints), 0);
            changed += mesh.squares.dirty.count;
        }
        CheckMesh(&mesh);
        kiriMemory_FreeAll(mesh.memory);
    }
    assert_true(changed > 1000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(CutsThrough),
        cmocka_unit_test(EndsStayClosed),
        cmocka_unit_test(BladeGoesOn),
        cmocka_unit_test(FollowsEdges),
        cmocka_unit_test(GoesThroughVertices),
        cmocka_unit_test(SnapsToVerticesAndEdges),
        cmocka_unit_test(DoesNotDrift),
        cmocka_unit_test(CrossesCuts),
        cmocka_unit_test(FollowsOlderCuts),
        cmocka_unit_test(CrossesItself),
        cmocka_unit_test(ClosesLoops),
        cmocka_unit_test(LeavesAndComesBack),
        cmocka_unit_test(LeavesTheOutlineAlone),
        cmocka_unit_test(StartsOnTheOutline),
        cmocka_unit_test(CutsOverGaps),
        cmocka_unit_test(CutsToHoles),
        cmocka_unit_test(CutsThroughPinches),
        cmocka_unit_test(TouchesSharpCorners),
        cmocka_unit_test(CutsThroughSplitSides),
        cmocka_unit_test(Clips),
        cmocka_unit_test(PlacesWithinRange),
        cmocka_unit_test(MakesNoEdgeTwice),
        cmocka_unit_test(MakesNoEdgeTwiceAmongFewSteps),
        cmocka_unit_test(CutsAtRandomOnOneSheet),
        cmocka_unit_test(CutsAtRandomFarAndWide),
        cmocka_unit_test(CutsAtRandomOnARing),
        cmocka_unit_test(GoesOnAfterRefusals),
        cmocka_unit_test(InterruptedMovesGoOn),
        cmocka_unit_test(SmallQuotasWait),
        cmocka_unit_test(StepsCountWhatTheyLookAt),
        cmocka_unit_test(DirtiesWhatChanges),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
