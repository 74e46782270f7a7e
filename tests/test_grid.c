/* The non-manifold grid: against shapes whose cells are known, and against slow independent ways to find them. */
#include "cells.h"
#include "mesh_copy.h"
#include "field/kiri_grid.h"
#include "mesh/kiri_cut.h"
#include "mesh_pieces.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

/* ---- Sheets ----------------------------------------------------------------------------------------------------- */

/* Counts live blocks, and returns null at the allocation numbered failAt. */
typedef struct Blocks {
    int32_t live, calls, failAt;
} Blocks;

static void* CountedAlloc(void* user, int64_t bytes)
{
    Blocks* blocks = user;
    if (++blocks->calls == blocks->failAt) {
        return NULL;
    }
    ++blocks->live;
    return malloc((size_t)bytes);
}

static void CountedFree(void* user, void* pointer)
{
    --((Blocks*)user)->live;
    free(pointer);
}

typedef struct Sheet {
    Blocks blocks;
    kiriMemory memory;
    kiriMeshData mesh;
    kiriGrid grid;
} Sheet;

static void OpenSheet(Sheet* sheet, const float* positions, int32_t vertexCount, const int32_t* indices,
                      int32_t triangleCount, int32_t resolution)
{
    kiriFault why;
    memset(sheet, 0, sizeof(*sheet));
    sheet->memory = kiriMemory_Make(CountedAlloc, CountedFree, &sheet->blocks);
    assert_int_equal(kiriMesh_Init(&sheet->mesh, &sheet->memory,
                                   &(kiriMeshInput){ positions, vertexCount, indices, triangleCount, resolution, 0.0 },
                                   &why),
                     KIRI_OK);
}

static void CloseSheet(Sheet* sheet)
{
    kiriMemory_FreeAll(sheet->mesh.memory);
    assert_int_equal(sheet->blocks.live, 0);
}

static void OpenRectangle(Sheet* sheet, float width, float height, int32_t columns, int32_t rows, int32_t resolution)
{
    float* positions = malloc(sizeof(float) * 2 * (size_t)((columns + 1) * (rows + 1)));
    int32_t* indices = malloc(sizeof(int32_t) * 6 * (size_t)(columns * rows));
    int32_t n = 0;
    for (int32_t k = 0; k < (columns + 1) * (rows + 1); ++k) {
        positions[2 * k] = width * (float)(k % (columns + 1)) / (float)columns;
        positions[2 * k + 1] = height * (float)(k / (columns + 1)) / (float)rows;
    }
    for (int32_t k = 0; k < columns * rows; ++k) {
        int32_t a = k / columns * (columns + 1) + k % columns, b = a + 1, c = a + columns + 1, d = c + 1;
        int32_t quad[6] = { a, b, d, a, d, c };
        memcpy(indices + n, quad, sizeof(quad));
        n += 6;
    }
    OpenSheet(sheet, positions, (columns + 1) * (rows + 1), indices, 2 * columns * rows, resolution);
    free(positions);
    free(indices);
}

/* A ring: radii 0.5 and 0.2 about (0.5, 0.5). */
static void OpenRing(Sheet* sheet, int32_t resolution)
{
    enum { SPOKES = 48, RINGS = 6 };
    float positions[2 * SPOKES * (RINGS + 1)];
    int32_t indices[6 * SPOKES * RINGS], n = 0;
    double c = 1.0, s = 0.0;
    const double turnC = 0.99144486137381038, turnS = 0.13052619222005157; /* 360 / 48 degrees */
    for (int32_t k = 0; k < SPOKES; ++k) {
        for (int32_t r = 0; r <= RINGS; ++r) {
            double radius = 0.2 + 0.3 * r / RINGS;
            positions[2 * (k * (RINGS + 1) + r)] = (float)(0.5 + radius * c);
            positions[2 * (k * (RINGS + 1) + r) + 1] = (float)(0.5 + radius * s);
        }
        double next = c * turnC - s * turnS;
        s = c * turnS + s * turnC;
        c = next;
    }
    for (int32_t k = 0; k < SPOKES; ++k) {
        for (int32_t r = 0; r < RINGS; ++r) {
            int32_t a = k * (RINGS + 1) + r, b = (k + 1) % SPOKES * (RINGS + 1) + r;
            int32_t quad[6] = { a, a + 1, b + 1, a, b + 1, b };
            memcpy(indices + n, quad, sizeof(quad));
            n += 6;
        }
    }
    OpenSheet(sheet, positions, SPOKES * (RINGS + 1), indices, 2 * SPOKES * RINGS, resolution);
}

/* Cuts along a polyline given as pairs of local coordinates, within what is begun. */
static void CutWithin(Sheet* sheet, const double* points, int32_t count)
{
    kiriBladeTip blade = kiriCut_Place(&sheet->mesh, kiriVec2_Make(points[0], points[1]));
    for (int32_t i = 1; i < count; ++i) {
        kiriLatticePoint to = kiriMesh_Snap(&sheet->mesh, kiriVec2_Make(points[2 * i], points[2 * i + 1]));
        kiriQuota all = { INT64_MAX, 0, 0, false };
        assert_int_equal(kiriCut_Move(&sheet->mesh, &blade, to, 16.0, &all), KIRI_DONE);
    }
}

static void CutAlong(Sheet* sheet, const double* points, int32_t count)
{
    kiriMesh_Begin(&sheet->mesh);
    CutWithin(sheet, points, count);
    kiriMesh_Commit(&sheet->mesh);
}

static void CutLine(Sheet* sheet, double x0, double y0, double x1, double y1)
{
    double points[4] = { x0, y0, x1, y1 };
    CutAlong(sheet, points, 2);
}

static void CutRandomly(Sheet* sheet, uint32_t* seed, int32_t cuts)
{
    while (cuts-- > 0) {
        double points[10], x = RandomBetween(seed, 0.0, 1.0), y = RandomBetween(seed, 0.0, 1.0);
        for (int i = 0; i < 5; ++i) {
            points[2 * i] = x;
            points[2 * i + 1] = y;
            x += RandomBetween(seed, -0.4, 0.4);
            y += RandomBetween(seed, -0.4, 0.4);
        }
        CutAlong(sheet, points, 2 + (int32_t)(Random(seed) % 4));
    }
}

static void Update(kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    assert_int_equal(kiriGrid_Update(grid, mesh, &quota), KIRI_DONE);
}

/* From scratch, but with the memory of the grid before. */
static void Build(Sheet* sheet)
{
    kiriGrid_Reset(&sheet->grid);
    Update(&sheet->grid, &sheet->mesh);
    kiriSquares_ClearDirty(&sheet->mesh.squares);
    assert_int_equal(sheet->grid.cellCount, sheet->grid.cells.count); /* no gaps */
}

/* ---- What must hold for every grid ------------------------------------------------------------------------------ */

static void assert_near(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) {
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
    }
}

static int32_t CellsIn(const Sheet* sheet, int32_t column, int32_t row)
{
    int32_t n = 0;
    for (int32_t c = sheet->grid.squareCell.data[row * sheet->mesh.squares.columns + column]; c != KIRI_NONE;
         c = sheet->grid.cells.data[c].next) {
        ++n;
    }
    return n;
}

/* The cell that holds a local point. */
static int32_t CellAt(const Sheet* sheet, double x, double y)
{
    kiriLatticePoint at = kiriMesh_Snap(&sheet->mesh, kiriVec2_Make(x, y));
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    assert_int_not_equal(triangle, KIRI_NONE);
    return kiriGrid_CellOf(&sheet->grid, &sheet->mesh, triangle, at);
}

static int32_t FindFace(const kiriGrid* grid, int32_t a, int32_t b)
{
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        const int32_t* cell = grid->faces.data[f].cell;
        if ((cell[0] == a && cell[1] == b) || (cell[0] == b && cell[1] == a)) {
            return f;
        }
    }
    return KIRI_NONE;
}

static Face FaceBetween(const Sheet* sheet, int32_t a, int32_t b)
{
    int32_t f = FindFace(&sheet->grid, a, b);
    assert_int_not_equal(f, KIRI_NONE);
    return Face_Of(&sheet->grid, &sheet->mesh, f);
}

static int32_t CountSteps(const kiriGrid* grid, int32_t c)
{
    kiriSteps steps;
    kiriGrid_GetSteps(grid, c, &steps);
    return steps.end[2];
}

static int32_t StepLength(const kiriGrid* grid, int32_t a, int32_t b)
{
    kiriSteps steps;
    kiriGrid_GetSteps(grid, a, &steps);
    for (int32_t s = 0; s < steps.end[2]; ++s) {
        if (steps.data[s].cell == b) {
            return steps.data[s].length;
        }
    }
    return 0;
}

/* Every triangle's moments against every cell's. */
static void CheckMaterial(const Sheet* sheet)
{
    kiriMoments cells = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, triangles = cells;
    for (int32_t c = 0; c < sheet->grid.cells.count; ++c) {
        kiriMoments m = kiriGrid_Material(&sheet->grid, &sheet->mesh, c);
        assert_true(m.area > 0.0);
        kiriVec2 apart = kiriVec2_Sub(kiriMoments_Center(&m), kiriGrid_Middle(&sheet->grid, &sheet->mesh, c));
        assert_true(fabs(apart.x) <= 0.5001 * sheet->grid.side && fabs(apart.y) <= 0.5001 * sheet->grid.side);
        kiriMoments_Add(&cells, &m);
    }
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        kiriLatticePoint p[3];
        kiriMesh_Corners(&sheet->mesh, t, p);
        kiriMoments m = kiriMoments_Triangle(kiriMesh_Local(&sheet->mesh, p[0]), kiriMesh_Local(&sheet->mesh, p[1]),
                                             kiriMesh_Local(&sheet->mesh, p[2]));
        kiriMoments_Add(&triangles, &m);
    }
    double exact = 0.5 * (double)kiriMesh_DoubledArea(&sheet->mesh) * sheet->mesh.step * sheet->mesh.step;
    assert_near(cells.area, exact, 1e-12 * exact);
    assert_near(cells.u, triangles.u, 1e-12 * triangles.u);
    assert_near(cells.v, triangles.v, 1e-12 * triangles.v);
    assert_near(cells.uu, triangles.uu, 1e-12 * triangles.uu);
    assert_near(cells.uv, triangles.uv, 1e-12 * triangles.uv);
    assert_near(cells.vv, triangles.vv, 1e-12 * triangles.vv);
}

/* Numbers what hangs together over faces, in the order of cells. Returns how many there are. */
static int32_t PiecesOf(const kiriGrid* grid, int32_t* piece)
{
    int32_t count = 0;
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        piece[c] = c;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t f = 0; f < grid->faces.count; ++f) {
            const int32_t* cell = grid->faces.data[f].cell;
            int32_t a = cell[0] == KIRI_NONE ? 0 : piece[cell[0]], b = cell[0] == KIRI_NONE ? 0 : piece[cell[1]];
            if (a != b) {
                piece[cell[0]] = piece[cell[1]] = a < b ? a : b;
                changed = true;
            }
        }
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        piece[c] = piece[c] == c ? count++ : piece[piece[c]];
    }
    return count;
}

static int32_t CountPieces(const kiriGrid* grid)
{
    int32_t* piece = malloc(sizeof(int32_t) * (size_t)grid->cells.count);
    int32_t count = PiecesOf(grid, piece);
    free(piece);
    return count;
}

/* A piece of the mesh is a piece of the grid, and the other way round. */
static void CheckPieces(const Sheet* sheet)
{
    int32_t triangles = sheet->mesh.triangles.count;
    int32_t* piece = malloc(sizeof(int32_t) * (size_t)triangles);
    int32_t* match = malloc(sizeof(int32_t) * (size_t)triangles);
    int32_t* ofCell = malloc(sizeof(int32_t) * (size_t)sheet->grid.cells.count);
    int32_t count = NumberPieces(&sheet->mesh, piece);
    assert_int_equal(count, PiecesOf(&sheet->grid, ofCell));
    for (int32_t i = 0; i < count; ++i) {
        match[i] = KIRI_NONE;
    }
    for (int32_t s = 0; s < sheet->mesh.squares.columns * sheet->mesh.squares.rows; ++s) {
        for (int32_t n = sheet->mesh.squares.head[s]; n != KIRI_NONE; n = sheet->mesh.squares.nodes.data[n].next) {
            int32_t ofMesh = piece[sheet->mesh.squares.nodes.data[n].triangle];
            int32_t ofGrid = ofCell[sheet->grid.nodeCell.data[n]];
            assert_true(match[ofMesh] == KIRI_NONE || match[ofMesh] == ofGrid);
            match[ofMesh] = ofGrid;
        }
    }
    free(piece);
    free(match);
    free(ofCell);
}

/* Where a side is covered from end to end, its faces together are the whole side: width, middle and moment. */
static void CheckSide(const Sheet* sheet, int32_t before, int32_t square, int axis)
{
    double width = 0.0, first = 0.0, second = 0.0, side = sheet->grid.side;
    kiriVec2 corner = kiriMesh_Local(&sheet->mesh, kiriSquares_Corner(&sheet->mesh.squares, square));
    for (int32_t c = sheet->grid.squareCell.data[square]; c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
        for (int32_t f = sheet->grid.cells.data[c].firstFace; f != KIRI_NONE;) {
            const kiriFace* face = &sheet->grid.faces.data[f];
            if (face->cell[1] == c && sheet->grid.cells.data[face->cell[0]].square == before) {
                kiriStretch s = kiriGrid_Stretch(&sheet->grid, &sheet->mesh, f);
                double along = axis == 0 ? s.middle.y - corner.y : s.middle.x - corner.x;
                assert_int_equal(kiriFace_Axis(face), axis);
                assert_near(axis == 0 ? s.middle.x : s.middle.y, axis == 0 ? corner.x : corner.y, 0.0);
                assert_true(s.width > 0.0 && s.moment > 0.0);
                assert_true(s.moment <= s.width * side * side);
                width += s.width;
                first += s.width * along;
                second += s.moment + s.width * along * along;
            }
            f = face->next[face->cell[1] == c];
        }
    }
    assert_near(width, side, 1e-11 * side);
    assert_near(first, 0.5 * side * side, 1e-11 * side * side);
    assert_near(second, side * side * side / 3.0, 1e-11 * side * side * side);
}

/* For a rectangle, whose squares but the outermost are covered. */
static void CheckInnerSides(const Sheet* sheet)
{
    int32_t columns = sheet->mesh.squares.columns, rows = sheet->mesh.squares.rows;
    for (int32_t row = 1; row + 1 < rows; ++row) {
        for (int32_t column = 1; column + 1 < columns; ++column) {
            int32_t s = row * columns + column;
            CheckSide(sheet, s - 1, s, 0);
            CheckSide(sheet, s - columns, s, 1);
        }
    }
}

/* Liang and Barsky with fractions: the part from t0 to t1 of the segment that is inside is longer than nothing. */
static bool SegmentInside(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint low, int32_t side)
{
    int64_t d[2] = { (int64_t)b.x - a.x, (int64_t)b.y - a.y };
    int64_t from[2] = { (int64_t)low.x - a.x, (int64_t)low.y - a.y };
    int64_t n0 = 0, d0 = 1, n1 = 1, d1 = 1;
    for (int i = 0; i < 2; ++i) {
        int64_t step = d[i] < 0 ? -d[i] : d[i];
        int64_t enter = d[i] < 0 ? -(from[i] + side) : from[i], leave = enter + side;
        if (d[i] == 0) {
            if (from[i] >= 0 || from[i] + side <= 0) {
                return false;
            }
            continue;
        }
        if (enter * d0 > n0 * step) {
            n0 = enter;
            d0 = step;
        }
        if (leave * d1 < n1 * step) {
            n1 = leave;
            d1 = step;
        }
    }
    return n0 * d1 < n1 * d0;
}

/* The cells of a square, found by spreading the lowest triangle over closed edges until nothing changes. */
static void CheckCellsOfSquare(const Sheet* sheet, int32_t square)
{
    int32_t node[4096], lowest[4096], count = 0;
    const kiriMeshData* mesh = &sheet->mesh;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        assert_true(count < 4096);
        node[count] = n;
        lowest[count++] = mesh->squares.nodes.data[n].triangle;
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t i = 0; i < count; ++i) {
            for (int32_t h = 3 * mesh->squares.nodes.data[node[i]].triangle, k = h + 3; h < k; ++h) {
                kiriLatticePoint a = mesh->vertices.data[kiriMesh_Tail(mesh, h)].at;
                kiriLatticePoint b = mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at;
                for (int32_t j = 0; j < count && !kiriMesh_IsOpen(mesh, h); ++j) {
                    if (kiriMesh_Twin(mesh, h) / 3 == mesh->squares.nodes.data[node[j]].triangle &&
                        kiriMesh_Twin(mesh, h) != KIRI_NONE && lowest[i] < lowest[j] &&
                        SegmentInside(a, b, kiriSquares_Corner(&mesh->squares, square), mesh->squares.side)) {
                        lowest[j] = lowest[i];
                        changed = true;
                    }
                }
            }
        }
    }
    int32_t distinct = 0;
    for (int32_t i = 0; i < count; ++i) {
        const kiriCell* cell = &sheet->grid.cells.data[sheet->grid.nodeCell.data[node[i]]];
        assert_int_equal(cell->square, square);
        assert_int_equal(cell->triangle, lowest[i]);
        distinct += lowest[i] == mesh->squares.nodes.data[node[i]].triangle;
    }
    assert_int_equal(distinct, CellsIn(sheet, square % mesh->squares.columns, square / mesh->squares.columns));
}

static void CheckCells(const Sheet* sheet)
{
    for (int32_t s = 0; s < sheet->mesh.squares.columns * sheet->mesh.squares.rows; ++s) {
        CheckCellsOfSquare(sheet, s);
    }
    for (int32_t c = 1; c < sheet->grid.cells.count; ++c) {
        const kiriCell* cell = &sheet->grid.cells.data[c];
        assert_true(cell[-1].square < cell->square ||
                    (cell[-1].square == cell->square && cell[-1].triangle < cell->triangle && cell[-1].next == c));
    }
}

/* The steps by their definition, over all pairs of cells. */
static void CheckSteps(const Sheet* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    int32_t n = grid->cells.count, columns = sheet->mesh.squares.columns;
    size_t bytes = (size_t)n * (size_t)n;
    char *straight = calloc(bytes, 1), *diagonal = calloc(bytes, 1), *knight = calloc(bytes, 1);
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        const int32_t* cell = grid->faces.data[f].cell;
        assert_int_equal(straight[cell[0] * n + cell[1]], 0); /* one face a pair */
        straight[cell[0] * n + cell[1]] = straight[cell[1] * n + cell[0]] = 1;
    }
    for (int32_t a = 0; a < n; ++a) {
        int32_t ax = grid->cells.data[a].square % columns, ay = grid->cells.data[a].square / columns;
        for (int32_t b = 0; b < n; ++b) {
            int32_t bx = grid->cells.data[b].square % columns, by = grid->cells.data[b].square / columns, ways = 0;
            for (int32_t m = 0; m < n && abs(ax - bx) == 1 && abs(ay - by) == 1; ++m) {
                if (straight[a * n + m] && straight[m * n + b]) {
                    ways |= grid->cells.data[m].square / columns == ay ? 1 : 2;
                }
            }
            diagonal[a * n + b] = ways == 3;
        }
    }
    for (int32_t a = 0; a < n; ++a) {
        int32_t ax = grid->cells.data[a].square % columns, ay = grid->cells.data[a].square / columns;
        for (int32_t b = 0; b < n; ++b) {
            int32_t bx = grid->cells.data[b].square % columns, by = grid->cells.data[b].square / columns, ways = 0;
            for (int32_t m = 0; m < n && abs(ax - bx) + abs(ay - by) == 3 && ax != bx && ay != by; ++m) {
                ways |= straight[a * n + m] && diagonal[m * n + b] ? 1 : 0;
                ways |= diagonal[a * n + m] && straight[m * n + b] ? 2 : 0;
            }
            knight[a * n + b] = ways == 3;
        }
    }
    for (int32_t a = 0; a < n; ++a) {
        int32_t s = 0;
        kiriSteps steps;
        kiriGrid_GetSteps(grid, a, &steps);
        for (int kind = 0; kind < 3; ++kind) {
            const char* is = kind == 0 ? straight : kind == 1 ? diagonal : knight;
            for (int32_t b = 0; b < n; ++b) {
                if (is[a * n + b]) {
                    assert_true(s < steps.end[kind]);
                    assert_int_equal(steps.data[s].cell, b);
                    assert_int_equal(steps.data[s].length, kind == 0 ? 256 : kind == 1 ? 362 : 572);
                    assert_int_equal(StepLength(grid, b, a), steps.data[s].length);
                    assert_int_equal(grid->cells.data[a].square + steps.data[s].u + columns * steps.data[s].v,
                                     grid->cells.data[b].square);
                    ++s;
                }
            }
            assert_int_equal(s, steps.end[kind]);
        }
    }
    free(straight);
    free(diagonal);
    free(knight);
}

static void CheckAll(const Sheet* sheet)
{
    CheckMaterial(sheet);
    CheckPieces(sheet);
    CheckCells(sheet);
    if (sheet->grid.cells.count < 1200) {
        CheckSteps(sheet);
    }
}

/* ---- Shapes whose cells are known (figure 4 of the paper) ------------------------------------------------------- */

static void TestDividedInTwo(void** state)
{
    (void)state;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 7, 7, 4);
    CutLine(&sheet, 0.4, -0.1, 0.4, 1.1);
    Build(&sheet);
    CheckAll(&sheet);
    assert_int_equal(CountPieces(&sheet.grid), 2);
    for (int32_t row = 0; row < 4; ++row) {
        for (int32_t column = 0; column < 4; ++column) {
            assert_int_equal(CellsIn(&sheet, column, row), column == 1 ? 2 : 1);
        }
    }
    int32_t left = CellAt(&sheet, 0.38, 0.37), right = CellAt(&sheet, 0.42, 0.37);
    assert_int_equal(sheet.grid.cells.data[left].square, sheet.grid.cells.data[right].square);
    assert_near(kiriGrid_Area(&sheet.grid, left), 0.15 * 0.25, 1e-7);
    assert_near(kiriGrid_Area(&sheet.grid, right), 0.10 * 0.25, 1e-7);
    kiriMoments material = kiriGrid_Material(&sheet.grid, &sheet.mesh, left);
    assert_near(kiriMoments_Center(&material).x, 0.325, 1e-7);
    assert_int_equal(FindFace(&sheet.grid, left, right), KIRI_NONE);
    assert_near(FaceBetween(&sheet, left, CellAt(&sheet, 0.1, 0.37)).width, 0.25, 1e-7);
    assert_int_equal(FindFace(&sheet.grid, left, CellAt(&sheet, 0.6, 0.37)), KIRI_NONE);
    const Face up = FaceBetween(&sheet, left, CellAt(&sheet, 0.38, 0.6));
    assert_near(up.width, 0.15, 1e-7);
    assert_near(up.middle.x, 0.325, 1e-7);
    assert_near(up.middle.y, 0.5, 1e-7);
    assert_near(up.moment, 0.15 * 0.15 * 0.15 / 12.0, 1e-9);
    CloseSheet(&sheet);
}

static void TestConfettiInOneSquare(void** state)
{
    (void)state;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 5, 5, 4);
    const double at[3][2] = { { 0.30, 0.30 }, { 0.42, 0.33 }, { 0.34, 0.43 } };
    for (int i = 0; i < 3; ++i) {
        double x = at[i][0], y = at[i][1];
        double loop[10] = { x, y, x + 0.05, y, x + 0.05, y + 0.04, x, y + 0.04, x, y };
        CutAlong(&sheet, loop, 5);
    }
    Build(&sheet);
    CheckAll(&sheet);
    assert_int_equal(CountPieces(&sheet.grid), 4);
    assert_int_equal(CellsIn(&sheet, 1, 1), 4);
    assert_int_equal(sheet.grid.cells.count, 16 + 3);
    int32_t around = CellAt(&sheet, 0.27, 0.4);
    assert_near(kiriGrid_Area(&sheet.grid, around), 0.0625 - 3.0 * 0.002, 1e-7);
    for (int i = 0; i < 3; ++i) {
        int32_t c = CellAt(&sheet, at[i][0] + 0.02, at[i][1] + 0.02);
        assert_near(kiriGrid_Area(&sheet.grid, c), 0.002, 1e-8);
        assert_int_equal(sheet.grid.cells.data[c].firstFace, KIRI_NONE);
        assert_int_equal(CountSteps(&sheet.grid, c), 0);
        assert_int_equal(sheet.grid.cells.data[c].square, sheet.grid.cells.data[around].square);
    }
    CloseSheet(&sheet);
}

static void TestThinStrip(void** state)
{
    (void)state;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 6, 6, 8);
    CutLine(&sheet, 0.41, -0.1, 0.41, 1.1);
    CutLine(&sheet, 0.42, -0.1, 0.42, 1.1);
    Build(&sheet);
    CheckAll(&sheet);
    CheckInnerSides(&sheet);
    assert_int_equal(CountPieces(&sheet.grid), 3);
    for (int32_t row = 0; row < 8; ++row) {
        assert_int_equal(CellsIn(&sheet, 3, row), 3);
        int32_t c = CellAt(&sheet, 0.415, (row + 0.5) / 8.0);
        int32_t neighbours = row == 0 || row == 7 ? 1 : 2;
        assert_int_equal(CountSteps(&sheet.grid, c), neighbours);
        if (row > 0) {
            const Face face = FaceBetween(&sheet, c, CellAt(&sheet, 0.415, (row - 0.5) / 8.0));
            assert_near(face.width, 0.01, 1e-7);
        }
        assert_int_equal(
            StepLength(&sheet.grid, CellAt(&sheet, 0.405, (row + 0.5) / 8.0), CellAt(&sheet, 0.425, (row + 0.5) / 8.0)),
            0);
    }
    CloseSheet(&sheet);
}

/* Two plates with a gap of 0.01 between them: nothing is there, not even a strip. */
static void TestGapNarrowerThanACell(void** state)
{
    (void)state;
    const float positions[16] = { 0.0f, 0.0f, 0.41f, 0.0f, 0.42f, 0.0f, 1.0f, 0.0f,
                                  0.0f, 1.0f, 0.41f, 1.0f, 0.42f, 1.0f, 1.0f, 1.0f };
    const int32_t indices[12] = { 0, 1, 5, 0, 5, 4, 2, 3, 7, 2, 7, 6 };
    Sheet sheet;
    OpenSheet(&sheet, positions, 8, indices, 4, 8);
    Build(&sheet);
    CheckAll(&sheet);
    assert_int_equal(CountPieces(&sheet.grid), 2);
    assert_int_equal(sheet.grid.cells.count, 64 + 8);
    int32_t left = CellAt(&sheet, 0.405, 0.55), right = CellAt(&sheet, 0.425, 0.55);
    assert_int_equal(sheet.grid.cells.data[left].square, sheet.grid.cells.data[right].square);
    assert_int_equal(StepLength(&sheet.grid, left, right), 0);
    assert_near(kiriGrid_Area(&sheet.grid, left), 0.035 * 0.125, 1e-7);
    assert_near(kiriGrid_Area(&sheet.grid, right), 0.08 * 0.125, 1e-7);
    CloseSheet(&sheet);
}

static void TestTipOfSlit(void** state)
{
    (void)state;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 9, 9, 10);
    CutLine(&sheet, -0.1, 0.44, 0.57, 0.44);
    Build(&sheet);
    CheckAll(&sheet);
    CheckInnerSides(&sheet);
    assert_int_equal(CountPieces(&sheet.grid), 1);
    for (int32_t column = 0; column < 10; ++column) {
        assert_int_equal(CellsIn(&sheet, column, 4), column < 5 ? 2 : 1);
    }
    for (int32_t column = 0; column < 5; ++column) { /* no step from one lip to the other */
        for (int32_t k = column - 2; k <= column + 2; ++k) {
            for (int32_t row = 2; row <= 4 && k >= 0 && k < 5; ++row) {
                int32_t above = CellAt(&sheet, (column + 0.5) / 10.0, 0.47);
                int32_t below = CellAt(&sheet, (k + 0.5) / 10.0, (row + 0.2) / 10.0);
                assert_int_equal(StepLength(&sheet.grid, above, below), 0);
            }
        }
    }
    int32_t tip = CellAt(&sheet, 0.55, 0.42);
    assert_int_equal(tip, CellAt(&sheet, 0.55, 0.46));
    assert_near(FaceBetween(&sheet, tip, CellAt(&sheet, 0.47, 0.42)).width, 0.04, 1e-7);
    assert_near(FaceBetween(&sheet, tip, CellAt(&sheet, 0.47, 0.46)).width, 0.06, 1e-7);
    CloseSheet(&sheet);
}

/* Vertices on the two lips are in cells of their own; each is in the square around it. */
static void TestCellsOfVertices(void** state)
{
    (void)state;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 9, 9, 10);
    CutLine(&sheet, -0.1, 0.44, 0.57, 0.44);
    Build(&sheet);
    int32_t pairs = 0;
    for (int32_t v = 0; v < sheet.mesh.vertices.count; ++v) {
        kiriLatticePoint at = sheet.mesh.vertices.data[v].at;
        int32_t cell = kiriGrid_CellOfVertex(&sheet.grid, &sheet.mesh, v);
        assert_int_equal(cell, kiriGrid_CellOf(&sheet.grid, &sheet.mesh, sheet.mesh.vertices.data[v].edge / 3, at));
        assert_int_equal(sheet.grid.cells.data[cell].square, kiriSquares_At(&sheet.mesh.squares, at));
        for (int32_t w = 0; w < v; ++w) {
            if (kiriDistanceSquared(at, sheet.mesh.vertices.data[w].at) == 0) {
                bool split = CellsIn(&sheet, sheet.grid.cells.data[cell].square % 10, 4) == 2;
                assert_int_equal(split, cell != kiriGrid_CellOfVertex(&sheet.grid, &sheet.mesh, w));
                ++pairs;
            }
        }
    }
    assert_true(pairs > 8);
    CloseSheet(&sheet);
}

static void TestMeshFinerCoarserAligned(void** state)
{
    (void)state;
    const int32_t cases[][3] = { { 40, 40, 5 }, { 1, 1, 16 }, { 8, 8, 8 }, { 16, 16, 8 },
                                 { 4, 4, 8 },   { 3, 50, 1 }, { 13, 2, 9 } };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
        Sheet sheet;
        OpenRectangle(&sheet, 1.0f, 1.0f, cases[i][0], cases[i][1], cases[i][2]);
        Build(&sheet);
        CheckAll(&sheet);
        CheckInnerSides(&sheet);
        int32_t n = cases[i][2];
        assert_int_equal(sheet.grid.cells.count, n * n);
        assert_int_equal(sheet.grid.faces.count, 2 * n * (n - 1));
        assert_int_equal(CountPieces(&sheet.grid), 1);
        for (int32_t f = 0; f < sheet.grid.faces.count; ++f) {
            assert_near(kiriGrid_Stretch(&sheet.grid, &sheet.mesh, f).width, 1.0 / n,
                        1e-7); /* squares are a few steps larger */
        }
        CloseSheet(&sheet);
    }
}

/* Every triangle of an aligned mesh torn off: corners reach over grid lines by one step of the lattice, and cells there
   are too small for their area to be anything but rounding. They still have some, and no mass is lost. */
static void TestEveryTriangleAPiece(void** state)
{
    (void)state;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 8, 8, 8);
    kiriMesh_Begin(&sheet.mesh);
    for (int32_t h = 0; h < 3 * sheet.mesh.triangles.count; ++h) {
        assert_true(kiriMesh_Open(&sheet.mesh, h));
    }
    kiriMesh_Commit(&sheet.mesh);
    Build(&sheet);
    CheckAll(&sheet);
    assert_int_equal(CountPieces(&sheet.grid), 128);
    double area[128] = { 0.0 };
    int32_t* piece = malloc(sizeof(int32_t) * (size_t)sheet.grid.cells.count);
    PiecesOf(&sheet.grid, piece);
    for (int32_t c = 0; c < sheet.grid.cells.count; ++c) {
        area[piece[c]] += kiriGrid_Area(&sheet.grid, c);
    }
    free(piece);
    for (int i = 0; i < 128; ++i) {
        assert_near(area[i], 1.0 / 128.0, 1e-12);
    }
    CloseSheet(&sheet);
}

/* A point p of the lattice, with the edge from (0, 0) to p passing the corner at the least distance there is, on its
   left or right: orient(0, p, corner) = 2 or -2. By Euclid's algorithm; false where the corner's coordinates have a
   common divisor. */
static bool GrazingPoint(kiriLatticePoint corner, bool left, kiriLatticePoint* p)
{
    int64_t a = left ? corner.y : corner.x, b = left ? corner.x : corner.y;
    int64_t r0 = a, r1 = b, s0 = 1, s1 = 0, t0 = 0, t1 = 1; /* r = s a + t b */
    while (r1 != 0) {
        int64_t n = r0 / r1, r = r0 - n * r1, s = s0 - n * s1, t = t0 - n * t1;
        r0 = r1, r1 = r, s0 = s1, s1 = s, t0 = t1, t1 = t;
    }
    if (t0 >= 0) {
        s0 += b;
        t0 -= a;
    }
    p->x = (int32_t)(left ? 2 * s0 : -2 * t0);
    p->y = (int32_t)(left ? -2 * t0 : 2 * s0);
    return r0 == 1;
}

/* Tears off all triangles around p. */
static void TearAround(Sheet* sheet, kiriLatticePoint p)
{
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, p);
    if (triangle != KIRI_NONE && kiriMesh_CanSplitTriangle(&sheet->mesh, triangle, p)) {
        kiriMesh_Begin(&sheet->mesh);
        assert_int_not_equal(kiriMesh_SplitTriangle(&sheet->mesh, triangle, p), KIRI_NONE);
        for (int32_t h = 0; h < 3 * sheet->mesh.triangles.count; ++h) {
            assert_true(kiriMesh_Open(&sheet->mesh, h));
        }
        kiriMesh_Commit(&sheet->mesh);
    }
}

/* An edge that misses a corner of the grid by 2^-28 of a lattice step leaves some 10^-32 of the square in it. That is a
   cell all the same, with an area, and with faces that have a width. */
static void TestGrazedCorner(void** state)
{
    (void)state;
    int32_t specks = 0, hairs = 0;
    for (int32_t i = 0; i < 2 * 7 * 7; ++i) {
        Sheet sheet;
        OpenRectangle(&sheet, 1.0f, 1.0f, 1, 1, 8);
        kiriLatticePoint corner = kiriSquares_Corner(&sheet.mesh.squares, 8 * (1 + i / 2 / 7) + 1 + i / 2 % 7), p;
        if (corner.x != corner.y && GrazingPoint(corner, i % 2 == 0, &p)) {
            kiriLatticePoint start = { 0, 0 };
            assert_int_equal(kiriOrient(start, p, corner), i % 2 == 0 ? 2 : -2);
            TearAround(&sheet, p);
        }
        Build(&sheet);
        CheckAll(&sheet);
        CheckInnerSides(&sheet);
        for (int32_t c = 0; c < sheet.grid.cells.count; ++c) {
            specks += kiriGrid_Area(&sheet.grid, c) < 1e-13 * sheet.grid.side * sheet.grid.side;
        }
        for (int32_t f = 0; f < sheet.grid.faces.count; ++f) {
            hairs += kiriGrid_Stretch(&sheet.grid, &sheet.mesh, f).width < 1e-13 * sheet.grid.side;
        }
        CloseSheet(&sheet);
    }
    assert_true(specks > 10 && hairs > 20);
}

/* Faces around a closed curve add up to nothing as vectors, and to its length along each axis. */
static void TestClosedCurveAroundHole(void** state)
{
    (void)state;
    Sheet sheet;
    OpenRing(&sheet, 20);
    Build(&sheet);
    CheckAll(&sheet);
    assert_int_equal(CountPieces(&sheet.grid), 1);
    assert_near(0.5 * (double)kiriMesh_DoubledArea(&sheet.mesh) * sheet.mesh.step * sheet.mesh.step,
                0.5 * 48.0 * 0.13052619222005157 * (0.25 - 0.04), 1e-6);
    double sum[2] = { 0.0, 0.0 }, length = 0.0;
    for (int32_t f = 0; f < sheet.grid.faces.count; ++f) {
        const Face of = Face_Of(&sheet.grid, &sheet.mesh, f), *face = &of;
        bool in[2];
        for (int k = 0; k < 2; ++k) {
            kiriVec2 at =
                kiriVec2_Sub(kiriGrid_Middle(&sheet.grid, &sheet.mesh, face->cell[k]), kiriVec2_Make(0.5, 0.5));
            in[k] = kiriVec2_Length(at) < 0.34;
        }
        if (in[0] != in[1]) {
            assert_near(face->width, sheet.grid.side, 1e-12 * sheet.grid.side);
            sum[face->axis] += in[0] ? face->width : -face->width;
            length += face->width;
        }
    }
    assert_near(sum[0], 0.0, 1e-13);
    assert_near(sum[1], 0.0, 1e-13);
    assert_near(length, 8.0 * 7 * sheet.grid.side, 1e-12); /* of a stair around a disc, as of the box around it */
    CloseSheet(&sheet);
}

/* ---- Properties ------------------------------------------------------------------------------------------------- */

static void TestRandomCuts(void** state)
{
    (void)state;
    uint32_t seed = 2015;
    int32_t pieces = 0, copies = 0;
    for (int round = 0; round < 60; ++round) {
        Sheet sheet;
        int32_t resolution = 2 + (int32_t)(Random(&seed) % 22);
        bool ring = round % 5 == 4;
        if (ring) {
            OpenRing(&sheet, resolution);
        } else {
            OpenRectangle(&sheet, 1.0f, 1.0f, 1 + (int32_t)(Random(&seed) % 12), 1 + (int32_t)(Random(&seed) % 12),
                          resolution);
        }
        int64_t area = kiriMesh_DoubledArea(&sheet.mesh);
        for (int again = 0; again < 2; ++again) { /* the second build uses the first one's memory */
            CutRandomly(&sheet, &seed, 1 + (int32_t)(Random(&seed) % 6));
            Build(&sheet);
            CheckAll(&sheet);
            if (!ring) {
                CheckInnerSides(&sheet);
                assert_true(kiriMesh_DoubledArea(&sheet.mesh) == area);
            }
        }
        pieces += CountPieces(&sheet.grid);
        for (int32_t c = 0; c < sheet.grid.cells.count; ++c) {
            copies += sheet.grid.cells.data[c].next != KIRI_NONE;
        }
        CloseSheet(&sheet);
    }
    assert_true(pieces > 200 && copies > 2000); /* the cuts were worth testing */
}

/* ---- Updates: the same as from scratch -------------------------------------------------------------------------- */

static bool SameBits(const void* a, const void* b, size_t bytes)
{
    return memcmp(a, b, bytes) == 0;
}

static bool SameMaterial(const kiriGrid* a, int32_t c, const kiriGrid* b, int32_t d, const kiriMeshData* mesh)
{
    kiriMoments x = kiriGrid_Material(a, mesh, c), y = kiriGrid_Material(b, mesh, d);
    return SameBits(&x, &y, sizeof(x));
}

static bool SameFace(const Face* a, const Face* b)
{
    return a->axis == b->axis && SameBits(&a->width, &b->width, sizeof(a->width)) &&
           SameBits(&a->middle, &b->middle, sizeof(a->middle)) && SameBits(&a->moment, &b->moment, sizeof(a->moment));
}

static int32_t NextOf(const kiriFace* face, int32_t cell)
{
    return face->next[face->cell[1] == cell];
}

/* The face of cell a that leads from or to cell b, in the list of a. */
static int32_t FaceInList(const kiriGrid* grid, int32_t a, int32_t b)
{
    for (int32_t f = grid->cells.data[a].firstFace; f != KIRI_NONE; f = NextOf(&grid->faces.data[f], a)) {
        if (grid->faces.data[f].cell[0] == b || grid->faces.data[f].cell[1] == b) {
            return f;
        }
    }
    return KIRI_NONE;
}

/* The cell of the second grid for each cell of the first: the same place in the list of the same square. */
static int32_t* MatchCells(const kiriGrid* a, const kiriGrid* b)
{
    int32_t* match = malloc(sizeof(int32_t) * (size_t)a->cells.count);
    int32_t live = 0;
    for (int32_t c = 0; c < a->cells.count; ++c) {
        match[c] = KIRI_NONE;
    }
    assert_int_equal(a->squareCell.count, b->squareCell.count);
    for (int32_t s = 0; s < a->squareCell.count; ++s) {
        int32_t c = a->squareCell.data[s], d = b->squareCell.data[s];
        for (int32_t last = KIRI_NONE; c != KIRI_NONE && d != KIRI_NONE; ++live) {
            assert_int_equal(a->cells.data[c].square, s);
            assert_int_equal(a->cells.data[c].triangle, b->cells.data[d].triangle);
            assert_true(a->cells.data[c].triangle > last);
            last = a->cells.data[c].triangle;
            match[c] = d;
            c = a->cells.data[c].next;
            d = b->cells.data[d].next;
        }
        assert_int_equal(c, KIRI_NONE);
        assert_int_equal(d, KIRI_NONE);
    }
    assert_int_equal(live, a->cellCount);
    assert_int_equal(live, b->cellCount);
    for (int32_t c = 0; c < a->cells.count; ++c) {
        assert_int_equal(kiriGrid_IsCell(a, c), match[c] != KIRI_NONE);
        live -= kiriGrid_IsCell(a, c);
    }
    assert_int_equal(live, 0);
    return match;
}

static int32_t CountFaces(const kiriGrid* grid)
{
    int32_t count = 0;
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        count += grid->faces.data[f].cell[0] != KIRI_NONE;
    }
    return count;
}

static void CheckSameFaces(const kiriGrid* a, const kiriGrid* b, const kiriMeshData* mesh, const int32_t* match)
{
    int32_t ends = 0;
    assert_int_equal(CountFaces(a), CountFaces(b));
    for (int32_t c = 0; c < a->cells.count; ++c) {
        for (int32_t f = match[c] == KIRI_NONE ? KIRI_NONE : a->cells.data[c].firstFace; f != KIRI_NONE; ++ends) {
            const kiriFace* face = &a->faces.data[f];
            bool second = face->cell[1] == c;
            int32_t g = FaceInList(b, match[c], match[face->cell[!second]]);
            assert_int_equal(face->cell[second], c);
            assert_int_not_equal(g, KIRI_NONE);
            Face this = Face_Of(a, mesh, f), other = Face_Of(b, mesh, g);
            assert_int_equal(other.cell[second], match[c]);
            assert_true(SameFace(&this, &other));
            f = face->next[second];
        }
    }
    assert_int_equal(ends, 2 * CountFaces(a));
}

static void CheckSameSteps(const kiriGrid* a, const kiriGrid* b, const int32_t* match)
{
    for (int32_t c = 0; c < a->cells.count; ++c) {
        if (match[c] == KIRI_NONE) {
            continue;
        }
        kiriSteps p, q;
        kiriGrid_GetSteps(a, c, &p);
        kiriGrid_GetSteps(b, match[c], &q);
        assert_memory_equal(p.end, q.end, sizeof(p.end));
        for (int32_t i = 0; i < p.end[2]; ++i) {
            kiriStep s = p.data[i], t = q.data[i];
            assert_true(match[s.cell] == t.cell && s.length == t.length && s.u == t.u && s.v == t.v);
        }
    }
}

/* Equal bit for bit, but for the indices. */
static void CheckSameGrid(const kiriGrid* a, const kiriGrid* b, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int32_t* match = MatchCells(a, b);
    assert_true(a->side == b->side);
    assert_memory_equal(a->whole.data, b->whole.data, (size_t)a->whole.count);
    for (int32_t c = 0; c < a->cells.count; ++c) {
        assert_true(match[c] == KIRI_NONE || SameMaterial(a, c, b, match[c], mesh));
    }
    for (int32_t s = 0; s < a->squareCell.count; ++s) {
        for (int32_t n = squares->head[s]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
            assert_int_equal(match[a->nodeCell.data[n]], b->nodeCell.data[n]);
        }
    }
    CheckSameFaces(a, b, mesh, match);
    CheckSameSteps(a, b, match);
    free(match);
}

static void CheckAgainstScratch(const Sheet* sheet)
{
    kiriGrid fresh = { 0 };
    Update(&fresh, &sheet->mesh);
    CheckSameGrid(&sheet->grid, &fresh, &sheet->mesh);
    for (int32_t v = 0; v < sheet->mesh.vertices.count; ++v) {
        const kiriVertex* vertex = &sheet->mesh.vertices.data[v];
        assert_int_equal(kiriGrid_CellOfVertex(&sheet->grid, &sheet->mesh, v),
                         kiriGrid_CellOf(&sheet->grid, &sheet->mesh, vertex->edge / 3, vertex->at));
    }
}

/* ---- Updates: what they say has changed ------------------------------------------------------------------------- */

/* A copy of what followers see of a grid. */
static void* CopyBytes(const void* data, size_t bytes)
{
    void* copy = malloc(bytes + 1);
    if (bytes > 0) {
        memcpy(copy, data, bytes);
    }
    return copy;
}

static kiriGrid CopyGrid(const kiriGrid* grid)
{
    kiriGrid copy = *grid;
    copy.cells.data = CopyBytes(grid->cells.data, sizeof(kiriCell) * (size_t)grid->cells.count);
    copy.runs.data = CopyBytes(grid->runs.data, sizeof(kiriStepRun) * (size_t)grid->runs.count);
    copy.steps.data = CopyBytes(grid->steps.data, sizeof(kiriStep) * (size_t)grid->steps.count);
    copy.squareCell.data = CopyBytes(grid->squareCell.data, sizeof(int32_t) * (size_t)grid->squareCell.count);
    copy.faces.data = CopyBytes(grid->faces.data, sizeof(kiriFace) * (size_t)grid->faces.count);
    copy.materials.data = CopyBytes(grid->materials.data, sizeof(kiriMoments) * (size_t)grid->materials.count);
    copy.stretches.data = CopyBytes(grid->stretches.data, sizeof(kiriStretch) * (size_t)grid->stretches.count);
    return copy;
}

static void FreeCopy(kiriGrid* copy)
{
    free(copy->cells.data);
    free(copy->runs.data);
    free(copy->steps.data);
    free(copy->squareCell.data);
    free(copy->faces.data);
    free(copy->materials.data);
    free(copy->stretches.data);
}

static bool HadCell(const kiriGrid* was, int32_t c)
{
    return c < was->cells.count && kiriGrid_IsCell(was, c);
}

static bool SameSteps(const kiriGrid* was, const kiriGrid* is, int32_t c)
{
    kiriSteps p, q;
    kiriGrid_GetSteps(was, c, &p);
    kiriGrid_GetSteps(is, c, &q);
    return memcmp(p.end, q.end, sizeof(p.end)) == 0 &&
           (p.end[2] == 0 || SameBits(p.data, q.data, sizeof(kiriStep) * (size_t)p.end[2]));
}

static bool HasFacesOf(const kiriGrid* a, const kiriGrid* b, const kiriMeshData* mesh, int32_t c)
{
    for (int32_t f = a->cells.data[c].firstFace; f != KIRI_NONE; f = NextOf(&a->faces.data[f], c)) {
        const Face face = Face_Of(a, mesh, f);
        int32_t g = FaceInList(b, c, face.cell[face.cell[0] == c]);
        if (g == KIRI_NONE) {
            return false;
        }
        const Face other = Face_Of(b, mesh, g);
        if (other.cell[0] != face.cell[0] || !SameFace(&face, &other)) {
            return false;
        }
    }
    return true;
}

static bool SameFaces(const kiriGrid* was, const kiriGrid* is, const kiriMeshData* mesh, int32_t c)
{
    return HasFacesOf(was, is, mesh, c) && HasFacesOf(is, was, mesh, c);
}

enum { IN_MADE = 1, IN_GONE = 2, IN_STEPS = 4, IN_MATERIAL = 8 };

static void Enlist(uint8_t* lists, int32_t c, int list)
{
    assert_int_equal(lists[c] & list, 0); /* once */
    lists[c] |= (uint8_t)list;
}

static uint8_t* ListsOf(const kiriGrid* grid)
{
    uint8_t* lists = calloc((size_t)grid->cells.count + 1, 1);
    const kiriGridChanges* changes = &grid->changes;
    for (int32_t i = 0; i < changes->made.count; ++i) {
        Enlist(lists, changes->made.data[i], IN_MADE);
    }
    for (int32_t i = 0; i < changes->gone.count; ++i) {
        Enlist(lists, changes->gone.data[i], IN_GONE);
    }
    for (int32_t i = 0; i < changes->steps.count; ++i) {
        Enlist(lists, changes->steps.data[i], IN_STEPS);
    }
    for (int32_t i = 0; i < changes->material.count; ++i) {
        Enlist(lists, changes->material.data[i].cell, IN_MATERIAL);
    }
    return lists;
}

/* The lists of changes against a copy from before. `exact`: there has been only one update since. */
static void CheckChanges(const kiriGrid* was, const kiriGrid* is, const kiriMeshData* mesh, bool exact)
{
    uint8_t* lists = ListsOf(is);
    for (int32_t c = 0; c < is->cells.count; ++c) {
        bool had = HadCell(was, c), has = kiriGrid_IsCell(is, c);
        if (!had || !has) {
            assert_int_equal(lists[c], has ? IN_MADE | IN_STEPS : had ? IN_GONE : 0);
            assert_true(!had || SameMaterial(was, c, is, c, mesh));
            continue;
        }
        assert_int_equal(was->cells.data[c].square, is->cells.data[c].square);
        bool material = !SameMaterial(was, c, is, c, mesh);
        bool steps = !SameSteps(was, is, c) || !SameFaces(was, is, mesh, c);
        int expected = (material ? IN_MATERIAL : 0) | (steps ? IN_STEPS : 0);
        assert_int_equal(exact ? lists[c] : lists[c] & expected, expected);
        assert_int_equal(lists[c] & (IN_MADE | IN_GONE), 0);
    }
    for (int32_t i = 0; i < is->changes.material.count; ++i) {
        kiriMaterialChange r = is->changes.material.data[i];
        kiriMoments had = kiriGrid_Material(was, mesh, r.cell);
        assert_true(SameBits(&r.was, &had, sizeof(had)));
    }
    free(lists);
}

/* ---- Updates: properties ---------------------------------------------------------------------------------------- */

typedef struct Tour {
    uint32_t seed;
    double x, y; /* the blade */
    int64_t updates, made, gone, steps, material;
} Tour;

/* A few segments of a cut of some kind from the blade on. Points stay on lines of the grid or mesh for some. */
static void CutOn(Sheet* sheet, Tour* tour, int kind, int32_t lines)
{
    double points[24], reach = kind % 2 == 0 ? 0.1 : 0.5;
    int32_t count = 2 + (int32_t)(Random(&tour->seed) % 4);
    for (int32_t i = 0; i < count; ++i) {
        points[2 * i] = tour->x;
        points[2 * i + 1] = tour->y;
        double dx = RandomBetween(&tour->seed, -reach, reach), dy = RandomBetween(&tour->seed, -reach, reach);
        if (kind == 2) { /* along lines */
            dx = Random(&tour->seed) % 2 == 0 ? 0.0 : dx;
            dy = dx == 0.0 ? dy : 0.0;
            tour->x = (double)(int32_t)(lines * (tour->x + dx) + 0.5) / lines;
            tour->y = (double)(int32_t)(lines * (tour->y + dy) + 0.5) / lines;
        } else if (kind == 3 && i > 0) { /* a sliver: there and back */
            tour->x = points[2 * i - 2] + 0.004;
            tour->y = points[2 * i - 1] + 0.003;
        } else {
            tour->x += dx;
            tour->y += dy;
        }
    }
    if (kind == 4 && count > 2) { /* a loop */
        points[2 * count] = points[0];
        points[2 * count + 1] = points[1];
        ++count;
    }
    CutAlong(sheet, points, count);
    if (kind == 3 || tour->x < 0.0 || tour->x > 1.0 || tour->y < 0.0 || tour->y > 1.0 || Random(&tour->seed) % 4 == 0) {
        tour->x = RandomBetween(&tour->seed, 0.0, 1.0);
        tour->y = RandomBetween(&tour->seed, 0.0, 1.0);
    }
}

/* The teeth of a comb: a cell with many faces. */
static void CutComb(Sheet* sheet, Tour* tour)
{
    double x = RandomBetween(&tour->seed, 0.1, 0.6), y = RandomBetween(&tour->seed, 0.1, 0.6);
    bool upright = Random(&tour->seed) % 2 == 0;
    for (int i = 0; i < 6; ++i) {
        double at = 0.012 * i;
        if (upright) {
            CutLine(sheet, x + at, y, x + at, y + 0.3);
        } else {
            CutLine(sheet, x, y + at, x + 0.3, y + at);
        }
    }
}

static void OpenAnySheet(Sheet* sheet, uint32_t* seed, int32_t* lines)
{
    const int32_t meshes[6] = { 1, 2, 5, 9, 16, 30 };
    int32_t mesh = meshes[Random(seed) % 6], resolution = 1 + (int32_t)(Random(seed) % 28);
    *lines = Random(seed) % 2 == 0 ? mesh : resolution;
    if (Random(seed) % 6 == 0) {
        OpenRing(sheet, resolution);
    } else {
        OpenRectangle(sheet, 1.0f, Random(seed) % 3 == 0 ? 0.6f : 1.0f, mesh, 1 + mesh / 2, resolution);
    }
}

/* With quotas up to `most`, or all at once for 0. Returns the items it took. */
static int64_t UpdateInParts(Sheet* sheet, uint32_t* seed, int32_t most)
{
    int64_t items = 0;
    for (kiriProgress progress = KIRI_MORE; progress != KIRI_DONE;) {
        int64_t left = most == 0 ? INT64_MAX : (int64_t)(Random(seed) % (uint32_t)most);
        kiriQuota quota = { left, 0, 0, false };
        progress = kiriGrid_Update(&sheet->grid, &sheet->mesh, &quota);
        assert_int_not_equal(progress, KIRI_FAILED);
        assert_true(quota.used >= 0 && quota.left >= 0 && quota.used + quota.left == left);
        assert_true(progress == KIRI_DONE || quota.left == 0);
        items += quota.used;
    }
    kiriSquares_ClearDirty(&sheet->mesh.squares);
    return items;
}

static void CountChanges(const kiriGrid* grid, Tour* tour)
{
    ++tour->updates;
    tour->made += grid->changes.made.count;
    tour->gone += grid->changes.gone.count;
    tour->steps += grid->changes.steps.count;
    tour->material += grid->changes.material.count;
}

/* Cuts a sheet step by step and checks the grid after each. `batch`: so many updates before the changes are cleared. */
static void CheckProgressiveCuts(Tour* tour, int32_t mostQuota, int32_t batch)
{
    Sheet sheet;
    int32_t lines;
    OpenAnySheet(&sheet, &tour->seed, &lines);
    UpdateInParts(&sheet, &tour->seed, mostQuota);
    CheckAgainstScratch(&sheet);
    kiriGrid_ClearChanges(&sheet.grid);
    int kind = (int)(Random(&tour->seed) % 6);
    tour->x = RandomBetween(&tour->seed, -0.1, 1.1);
    tour->y = RandomBetween(&tour->seed, -0.1, 1.1);
    for (int step = 0; step < 6; ++step) {
        kiriGrid was = CopyGrid(&sheet.grid);
        for (int32_t i = 0; i < batch; ++i) {
            if (kind == 5 && step % 3 == 0) {
                CutComb(&sheet, tour);
            } else {
                CutOn(&sheet, tour, kind, lines);
            }
            UpdateInParts(&sheet, &tour->seed, mostQuota);
        }
        CheckAgainstScratch(&sheet);
        CheckChanges(&was, &sheet.grid, &sheet.mesh, batch == 1);
        CountChanges(&sheet.grid, tour);
        kiriGrid_ClearChanges(&sheet.grid);
        FreeCopy(&was);
    }
    CloseSheet(&sheet);
}

static void TestUpdateEqualsScratch(void** state)
{
    (void)state;
    Tour tour = { 20150, 0.0, 0.0, 0, 0, 0, 0, 0 };
    for (int round = 0; round < 150; ++round) {
        CheckProgressiveCuts(&tour, 0, 1);
    }
    assert_true(tour.updates == 900 && tour.made > 3000); /* the cuts were worth testing */
    assert_true(tour.steps > 10000 && tour.material > 3000);
}

static void TestUpdateWithTinyQuotas(void** state)
{
    (void)state;
    Tour tour = { 711, 0.0, 0.0, 0, 0, 0, 0, 0 };
    for (int round = 0; round < 60; ++round) {
        CheckProgressiveCuts(&tour, 2 + round % 9, 1);
    }
    assert_true(tour.made > 1000);
}

/* Cells may come and go again before anybody has heard of them. */
static void TestManyUpdatesBeforeSettling(void** state)
{
    (void)state;
    Tour tour = { 99, 0.0, 0.0, 0, 0, 0, 0, 0 };
    for (int round = 0; round < 60; ++round) {
        CheckProgressiveCuts(&tour, 0, 3);
    }
    assert_true(tour.made > 2000);
}

static void CutAcross(Sheet* sheet, uint32_t* seed)
{
    double points[8];
    for (int i = 0; i < 8; ++i) {
        points[i] = RandomBetween(seed, 0.0, 1.0);
    }
    CutWithin(sheet, points, 4);
}

/* After Settle, every index is a cell's or waits to be one's, and so for faces, and for what they have of their own. */
static void CheckFreeIndices(const kiriGrid* grid)
{
    int32_t cells = grid->cellCount, faces = CountFaces(grid);
    int32_t materials = grid->unusedMaterials.count, stretches = grid->unusedStretches.count;
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        assert_true(kiriGrid_IsCell(grid, c) || grid->cells.data[c].material == KIRI_NONE);
        materials += grid->cells.data[c].material != KIRI_NONE;
    }
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        stretches += kiriFace_HasOwnStretch(&grid->faces.data[f]);
    }
    assert_int_equal(materials, grid->materials.count);
    assert_int_equal(stretches, grid->stretches.count);
    for (int32_t c = grid->freeCell; c != KIRI_NONE; c = grid->cells.data[c].next) {
        assert_false(kiriGrid_IsCell(grid, c));
        ++cells;
    }
    for (int32_t f = grid->freeFace; f != KIRI_NONE; f = grid->faces.data[f].next[0]) {
        assert_int_equal(grid->faces.data[f].cell[0], KIRI_NONE);
        ++faces;
    }
    assert_int_equal(cells, grid->cells.count);
    assert_int_equal(faces, grid->faces.count);
}

/* Two cuts that are taken back as one, so that cells merge again. The changes are cleared after the first, the second,
   both, or never: cells go that were known and have changed since, or that nobody has heard of. */
static void CheckCutsTakenBack(Tour* tour, int32_t mostQuota)
{
    Sheet sheet;
    int32_t lines;
    OpenAnySheet(&sheet, &tour->seed, &lines);
    CutRandomly(&sheet, &tour->seed, 2);
    UpdateInParts(&sheet, &tour->seed, mostQuota);
    for (uint32_t round = 0; round < 4; ++round) {
        kiriGrid_ClearChanges(&sheet.grid);
        CheckFreeIndices(&sheet.grid);
        kiriGrid was = CopyGrid(&sheet.grid);
        int32_t cellCount = sheet.grid.cellCount;
        Whole whole = Whole_Make(&sheet.mesh);
        kiriMesh_Begin(&sheet.mesh);
        for (uint32_t cut = 0; cut < 2; ++cut) {
            CutAcross(&sheet, &tour->seed);
            UpdateInParts(&sheet, &tour->seed, mostQuota);
            CheckAgainstScratch(&sheet);
            if ((round >> cut & 1) != 0) {
                kiriGrid_ClearChanges(&sheet.grid);
                FreeCopy(&was);
                was = CopyGrid(&sheet.grid);
            }
        }
        Whole_Restore(&whole, &sheet.mesh);
        Whole_Free(&whole);
        UpdateInParts(&sheet, &tour->seed, mostQuota);
        CheckAgainstScratch(&sheet);
        CheckChanges(&was, &sheet.grid, &sheet.mesh, round >= 2);
        CountChanges(&sheet.grid, tour);
        assert_int_equal(sheet.grid.cellCount, cellCount);
        FreeCopy(&was);
    }
    CloseSheet(&sheet);
}

static void TestCutsTakenBack(void** state)
{
    (void)state;
    Tour tour = { 4711, 0.0, 0.0, 0, 0, 0, 0, 0 };
    for (int round = 0; round < 80; ++round) {
        CheckCutsTakenBack(&tour, round % 2 == 0 ? 0 : 7);
    }
    assert_true(tour.gone > 500);
}

/* However the quota is cut up, the work is the same. */
static void TestQuotaCountsAll(void** state)
{
    (void)state;
    int64_t items[2][4];
    for (int parts = 0; parts < 2; ++parts) {
        uint32_t cuts = 6, quotas = 9;
        Sheet sheet;
        OpenRectangle(&sheet, 1.0f, 1.0f, 5, 8, 12);
        for (int i = 0; i < 4; ++i) {
            items[parts][i] = UpdateInParts(&sheet, &quotas, parts * 5);
            CutRandomly(&sheet, &cuts, 1);
        }
        CloseSheet(&sheet);
    }
    assert_memory_equal(items[0], items[1], sizeof(items[0]));
    assert_true(items[0][0] > 144 && items[0][1] < items[0][0]);
}

/* `patch` x `patch` squares of two triangles, all in one square of the grid, and a triangle far away. */
static void OpenPatch(Sheet* sheet, int32_t patch)
{
    int32_t vertices = (patch + 1) * (patch + 1), triangles = 2 * patch * patch;
    float* positions = malloc(sizeof(float) * 2 * (size_t)(vertices + 3));
    int32_t* indices = malloc(sizeof(int32_t) * 3 * (size_t)(triangles + 1));
    const float far[6] = { 0.5f, 0.5f, 1.0f, 0.5f, 1.0f, 1.0f };
    assert_int_equal(kiriFillRectangle(0.1f, 0.1f, patch, patch, positions, indices), KIRI_OK);
    memcpy(positions + 2 * vertices, far, sizeof(far));
    for (int32_t k = 0; k < 2 * vertices; ++k) {
        positions[k] += 0.01f;
    }
    for (int32_t k = 0; k < 3; ++k) {
        indices[3 * triangles + k] = vertices + k;
    }
    OpenSheet(sheet, positions, vertices + 3, indices, triangles + 1, 4);
    free(positions);
    free(indices);
}

/* The items that a cut through a patch takes, in parts. No call does much more than its quota. */
static int64_t ItemsOfPatch(int32_t patch, int64_t limit)
{
    const double across[4] = { -0.05, 0.0513, 0.2, 0.0521 };
    Sheet sheet;
    OpenPatch(&sheet, patch);
    Build(&sheet);
    kiriSquares_ClearDirty(&sheet.mesh.squares);
    kiriGrid_ClearChanges(&sheet.grid);
    CutAlong(&sheet, across, 2);
    kiriProgress progress = KIRI_MORE;
    int64_t items = 0;
    for (int32_t calls = 0; progress == KIRI_MORE; ++calls) {
        kiriQuota quota = { limit, 0, 0, false };
        progress = kiriGrid_Update(&sheet.grid, &sheet.mesh, &quota);
        assert_true(quota.used <= limit);
        items += quota.used;
        assert_true(calls <= items); /* each gets on */
    }
    assert_int_equal(progress, KIRI_DONE);
    kiriSquares_ClearDirty(&sheet.mesh.squares);
    CheckAgainstScratch(&sheet);
    CloseSheet(&sheet);
    return items;
}

/* What is in a square counts, and is worked on in parts. */
static void TestSquareOfManyTriangles(void** state)
{
    (void)state;
    int64_t few = ItemsOfPatch(8, 10), many = ItemsOfPatch(64, 10);
    assert_true(many > 32 * few && many < 128 * few); /* 64 times the triangles */
    assert_true(ItemsOfPatch(64, 200) == many && ItemsOfPatch(64, INT64_MAX / 2) == many);
}

/* All squares looked at, and nothing found. */
static void TestNothingChanged(void** state)
{
    (void)state;
    uint32_t seed = 41;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 9, 11, 13);
    CutRandomly(&sheet, &seed, 6);
    Build(&sheet);
    kiriGrid_ClearChanges(&sheet.grid);
    kiriGrid was = CopyGrid(&sheet.grid);
    int32_t calls = sheet.blocks.calls;
    for (int again = 0; again < 2; ++again) {
        for (int32_t h = 0; h < 3 * sheet.mesh.triangles.count; ++h) {
            kiriSquares_MarkEdgeDirty(&sheet.mesh.squares, sheet.mesh.vertices.data[kiriMesh_Tail(&sheet.mesh, h)].at,
                                      sheet.mesh.vertices.data[kiriMesh_Tail(&sheet.mesh, kiriEdge_Next(h))].at);
        }
        assert_int_equal(sheet.mesh.squares.dirty.count, 13 * 13);
        assert_true(UpdateInParts(&sheet, &seed, 0) > 13 * 13);
        assert_true(again == 0 || sheet.blocks.calls == calls); /* the second time asks for no memory */
        calls = sheet.blocks.calls;
        CheckChanges(&was, &sheet.grid, &sheet.mesh, true);
        assert_int_equal(sheet.grid.changes.steps.count + sheet.grid.changes.material.count, 0);
    }
    CheckAgainstScratch(&sheet);
    assert_int_equal(UpdateInParts(&sheet, &seed, 0), 0); /* nothing is dirty: nothing is done */
    FreeCopy(&was);
    CloseSheet(&sheet);
}

static void ReverseLists(kiriSquares* squares)
{
    for (int32_t s = 0; s < squares->columns * squares->rows; ++s) {
        int32_t reversed = KIRI_NONE;
        for (int32_t n = squares->head[s]; n != KIRI_NONE;) {
            int32_t next = squares->nodes.data[n].next;
            squares->nodes.data[n].next = reversed;
            reversed = n;
            n = next;
        }
        squares->head[s] = reversed;
    }
}

/* `mesh` lines of the mesh and some cuts: the second sheet has many triangles of the same size in each square. */
static void CheckSameBitsWhateverTheLists(int32_t mesh, int32_t resolution)
{
    uint32_t seed = 77;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 0.7f, mesh, mesh, resolution);
    CutRandomly(&sheet, &seed, mesh);
    Build(&sheet);
    int32_t count = sheet.grid.cells.count;
    kiriLatticePoint* anchors = malloc(sizeof(kiriLatticePoint) * (size_t)count);
    for (int32_t c = 0; c < count; ++c) {
        anchors[c] = kiriGrid_Anchor(&sheet.grid, &sheet.mesh, c);
    }
    ReverseLists(&sheet.mesh.squares);
    CheckAgainstScratch(&sheet);
    for (int32_t c = 0; c < count; ++c) {
        assert_true(kiriDistanceSquared(anchors[c], kiriGrid_Anchor(&sheet.grid, &sheet.mesh, c)) == 0);
    }
    free(anchors);
    CloseSheet(&sheet);
}

static void TestSameBitsWhateverTheLists(void** state)
{
    (void)state;
    CheckSameBitsWhateverTheLists(11, 13);
    CheckSameBitsWhateverTheLists(32, 4);
}

/* An anchor finds its cell: some triangle there is the cell's. */
static void TestAnchors(void** state)
{
    (void)state;
    uint32_t seed = 8;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 7, 7, 9);
    CutRandomly(&sheet, &seed, 10);
    Build(&sheet);
    for (int32_t c = 0; c < sheet.grid.cells.count; ++c) {
        if (kiriGrid_Area(&sheet.grid, c) > 1e-6 * sheet.grid.side * sheet.grid.side) {
            kiriLatticePoint at = kiriGrid_Anchor(&sheet.grid, &sheet.mesh, c);
            assert_int_equal(kiriGrid_CellOf(&sheet.grid, &sheet.mesh, kiriMesh_Locate(&sheet.mesh, at), at), c);
        }
    }
    CloseSheet(&sheet);
}

static void TestSortCells(void** state)
{
    (void)state;
    uint32_t seed = 12;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 4, 4, 12);
    CutRandomly(&sheet, &seed, 10);
    Build(&sheet);
    int32_t count = sheet.grid.cells.count, *cells = malloc(sizeof(int32_t) * (size_t)count);
    for (int32_t i = 0; i < count; ++i) {
        int32_t j = (int32_t)(Random(&seed) % (uint32_t)(i + 1));
        cells[i] = cells[j];
        cells[j] = i;
    }
    kiriGrid_SortCells(&sheet.grid, cells, count);
    for (int32_t i = 0; i < count; ++i) {
        assert_int_equal(cells[i], i); /* from scratch, indices are in order */
    }
    free(cells);
    CloseSheet(&sheet);
}

/* What is done again in the same memory asks for no more. */
static void TestMemoryIsUsedAgain(void** state)
{
    (void)state;
    uint32_t seed = 5;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 11, 9, 13);
    CutRandomly(&sheet, &seed, 8);
    Build(&sheet);
    int32_t calls = sheet.blocks.calls;
    Build(&sheet);
    assert_int_equal(sheet.blocks.calls, calls);
    CheckAgainstScratch(&sheet);
    CloseSheet(&sheet);
}

/* Whatever allocation of an update fails, what is left can be reset, and is right again. */
static void TestFailingUpdate(void** state)
{
    (void)state;
    int32_t failures = 0;
    for (bool done = false; !done; ++failures) {
        uint32_t seed = 3;
        Sheet sheet;
        OpenRectangle(&sheet, 1.0f, 1.0f, 3, 3, 9);
        Build(&sheet);
        kiriGrid_ClearChanges(&sheet.grid);
        CutRandomly(&sheet, &seed, 8);
        sheet.blocks.calls = 0;
        sheet.blocks.failAt = failures + 1;
        kiriQuota quota = { INT64_MAX, 0, 0, false };
        done = kiriGrid_Update(&sheet.grid, &sheet.mesh, &quota) == KIRI_DONE;
        assert_int_equal(done, sheet.blocks.calls < sheet.blocks.failAt);
        sheet.blocks.failAt = 0;
        if (failures % 2 == 0) {
            Build(&sheet);
            CheckAgainstScratch(&sheet);
        }
        CloseSheet(&sheet);
    }
    assert_true(failures > 10);
}

static void TestFailingMemory(void** state)
{
    (void)state;
    uint32_t seed = 3;
    Sheet sheet;
    OpenRectangle(&sheet, 1.0f, 1.0f, 8, 8, 6);
    CutRandomly(&sheet, &seed, 5);
    int32_t failures = 0;
    for (bool built = false; !built; ++failures) {
        kiriGrid grid = { 0 };
        kiriQuota quota = { INT64_MAX, 0, 0, false };
        sheet.blocks.calls = 0;
        sheet.blocks.failAt = failures + 1;
        built = kiriGrid_Update(&grid, &sheet.mesh, &quota) == KIRI_DONE;
        assert_int_equal(built, sheet.blocks.calls < sheet.blocks.failAt);
    }
    assert_true(failures > 17);
    CloseSheet(&sheet);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestDividedInTwo),
        cmocka_unit_test(TestConfettiInOneSquare),
        cmocka_unit_test(TestThinStrip),
        cmocka_unit_test(TestGapNarrowerThanACell),
        cmocka_unit_test(TestTipOfSlit),
        cmocka_unit_test(TestCellsOfVertices),
        cmocka_unit_test(TestMeshFinerCoarserAligned),
        cmocka_unit_test(TestEveryTriangleAPiece),
        cmocka_unit_test(TestGrazedCorner),
        cmocka_unit_test(TestClosedCurveAroundHole),
        cmocka_unit_test(TestRandomCuts),
        cmocka_unit_test(TestUpdateEqualsScratch),
        cmocka_unit_test(TestUpdateWithTinyQuotas),
        cmocka_unit_test(TestManyUpdatesBeforeSettling),
        cmocka_unit_test(TestCutsTakenBack),
        cmocka_unit_test(TestQuotaCountsAll),
        cmocka_unit_test(TestSquareOfManyTriangles),
        cmocka_unit_test(TestNothingChanged),
        cmocka_unit_test(TestSameBitsWhateverTheLists),
        cmocka_unit_test(TestAnchors),
        cmocka_unit_test(TestSortCells),
        cmocka_unit_test(TestMemoryIsUsedAgain),
        cmocka_unit_test(TestFailingUpdate),
        cmocka_unit_test(TestFailingMemory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
