#include "kiri_grid_work.h"

#include "../core/kiri_union_find.h"

#include <string.h>

/* SetMaterial compares bytes. */
typedef char MomentsHaveNoPadding[sizeof(kiriMoments) == 6 * sizeof(double) ? 1 : -1];

/* ---- Whole squares ----------------------------------------------------------------------------------------------- */

/* Does the outline or an open edge of the triangle run through the square? */
static bool RunsThroughSquare(const kiriMeshData* mesh, const kiriTriangle* t, int32_t square)
{
    for (int i = 0; i < 3; ++i) {
        if ((t->twin[i] == KIRI_NONE || (t->marks >> i & 1) != 0) &&
            kiriSquares_RunsThrough(&mesh->squares, square, mesh->vertices.data[t->vertex[i]].at,
                                    mesh->vertices.data[t->vertex[(i + 1) % 3]].at)) {
            return true;
        }
    }
    return false;
}

/* A square is whole where there is material and neither the outline nor an open edge runs through it. Then it is wholly
   covered, its triangles all hang together in it, and it has one cell: no need to join or to clip. Most squares are. */
static kiriProgress LookWhetherWhole(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    bool wasWhole = grid->whole.data[square], isWhole = mesh->squares.head[square] != KIRI_NONE;
    while (isWhole && work->node != KIRI_NONE) {
        const kiriTriangle* t = &mesh->triangles.data[nodes[work->node].triangle];
        bool isInner = (t->marks & KIRI_TRIANGLE_OPEN) == 0 &&
                       (t->twin[0] | t->twin[1] | t->twin[2]) >= 0; /* KIRI_NONE has the sign bit */
        isWhole = isInner || !RunsThroughSquare(mesh, t, square);
        work->node = nodes[work->node].next;
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_NODE) && isWhole) {
            return KIRI_MORE;
        }
    }
    grid->whole.data[square] = isWhole;
    work->isSame = wasWhole && isWhole;
    work->newCells.count = 0;
    work->due += KIRI_GRID_SQUARE;
    return work->isSame || kiriGridWork_AddOnce(work, mesh->memory, square, KIRI_SQUARE_FACES_DIRTY, &work->facesDirty)
               ? KIRI_DONE
               : KIRI_FAILED;
}

/* ---- Triangles of a square --------------------------------------------------------------------------------------- */

/* The entry of a triangle among sorted ones, or KIRI_NONE. */
static int32_t FindTriangleEntry(const kiriGridWork* work, const kiriMeshData* mesh, int32_t from, int32_t end,
                                 int32_t triangle)
{
    int32_t at;
    KIRI_SEARCH(at, from, end, kiriGridWork_TriangleAt(work, mesh, middle) < triangle);
    return at < end && kiriGridWork_TriangleAt(work, mesh, at) == triangle ? at : KIRI_NONE;
}

/* Joins an entry of a square to those after it that a closed edge through the square leads to. */
static void JoinEntry(kiriGridWork* work, const kiriMeshData* mesh, int32_t square, int32_t i)
{
    int32_t triangle = kiriGridWork_TriangleAt(work, mesh, i), end = work->ranges.data[square].end;
    for (int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin < h || kiriMesh_IsOpen(mesh, h)) {
            continue;
        }
        int32_t j = FindTriangleEntry(work, mesh, i + 1, end, twin / 3);
        if (j != KIRI_NONE &&
            kiriSquares_RunsThrough(&mesh->squares, square, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                                    mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at)) {
            kiriUnion_Join(work->parent.data, i, j);
        }
    }
}

/* Joins the triangles of a square (algorithm 3). */
static kiriProgress JoinTriangles(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    if (grid->whole.data[square]) {
        return KIRI_DONE;
    }
    kiriProgress progress = kiriGridWork_Collect(work, mesh, square, quota);
    kiriNodeRange range = work->ranges.data[square];
    while (progress == KIRI_DONE && work->at < range.end - range.first) {
        JoinEntry(work, mesh, square, range.first + work->at++);
        progress = kiriGridWork_Spend(work, quota, KIRI_GRID_JOIN) ? KIRI_DONE : KIRI_MORE;
    }
    return progress;
}

/* ---- Material ---------------------------------------------------------------------------------------------------- */

/* Room for what clipping may make of a triangle even where rounding spoils its convexity: at most twice as many corners
   a time, and 3, 4, 6, 9, 13 when counted closely. */
enum { MOST_CORNERS = 13 };
typedef struct ClippedPolygon {
    kiriVec2 at[MOST_CORNERS];
    int32_t count;
} ClippedPolygon;

/* How far beyond the square's lower (or upper) side along an axis. */
static double DepthInside(kiriVec2 p, int axis, bool upper, double side)
{
    double x = axis == 0 ? p.x : p.y;
    return upper ? side - x : x;
}

/* Cuts off what is outside one side of the square (Sutherland and Hodgman 1974). An edge is followed from its inner end
   whichever way the triangle runs, so neighbours at this edge get the very same point. */
static void ClipAtSide(ClippedPolygon* polygon, int axis, bool upper, double side)
{
    double depth[MOST_CORNERS], least = side;
    for (int32_t i = 0; i < polygon->count; ++i) {
        depth[i] = DepthInside(polygon->at[i], axis, upper, side);
        least = kiriMin(depth[i], least);
    }
    if (least > 0.0) {
        return;
    }
    ClippedPolygon was = *polygon;
    polygon->count = 0;
    for (int32_t i = 0; i < was.count; ++i) {
        int32_t j = i + 1 < was.count ? i + 1 : 0;
        if (depth[i] > 0.0) {
            polygon->at[polygon->count++] = was.at[i];
        }
        if ((depth[i] > 0.0) != (depth[j] > 0.0)) {
            int32_t in = depth[i] > 0.0 ? i : j, out = i + j - in;
            kiriVec2 way = kiriVec2_Sub(was.at[out], was.at[in]);
            kiriVec2 at = kiriVec2_Add(was.at[in], kiriVec2_Scale(depth[in] / (depth[in] - depth[out]), way));
            *(axis == 0 ? &at.x : &at.y) = upper ? side : 0.0;
            polygon->at[polygon->count++] = at;
        }
    }
}

/* Most triangles reach over few sides of a square, if any: whole numbers tell faster. */
static void ClipToSquare(ClippedPolygon* part, const kiriLatticePoint c[3], kiriLatticePoint low, int32_t side)
{
    kiriLatticePoint high = { low.x + side, low.y + side };
    if (c[0].x < low.x || c[1].x < low.x || c[2].x < low.x) {
        ClipAtSide(part, 0, false, side);
    }
    if (c[0].x > high.x || c[1].x > high.x || c[2].x > high.x) {
        ClipAtSide(part, 0, true, side);
    }
    if (c[0].y < low.y || c[1].y < low.y || c[2].y < low.y) {
        ClipAtSide(part, 1, false, side);
    }
    if (c[0].y > high.y || c[1].y > high.y || c[2].y > high.y) {
        ClipAtSide(part, 1, true, side);
    }
}

/* The part of a triangle in a square, about the square's lower corner, so that nothing cancels in a small one. */
static kiriMoments MaterialInSquare(const kiriMeshData* mesh, int32_t triangle, int32_t square)
{
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    ClippedPolygon part;
    part.count = 3;
    for (int i = 0; i < 3; ++i) {
        part.at[i] = kiriVec2_Make((double)corners[i].x - low.x, (double)corners[i].y - low.y);
    }
    ClipToSquare(&part, corners, low, mesh->squares.side);
    kiriMoments sum = { 0 };
    for (int32_t i = 0; i < part.count; ++i) {
        part.at[i] = kiriVec2_Scale(mesh->step, part.at[i]);
        if (i >= 2) {
            kiriMoments fan = kiriMoments_Triangle(part.at[0], part.at[i - 1], part.at[i]);
            kiriMoments_Add(&sum, &fan);
        }
    }
    return sum;
}

/* A speck of material at the middle of the square. */
static kiriMoments Speck(double side)
{
    double area = kiriLeastShare * side * side, half = 0.5 * side;
    kiriMoments m = { area, half * area, half * area, half * half * area, half * half * area, half * half * area };
    return m;
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

/* The index of a new cell, or KIRI_NONE for memory. */
static int32_t AddCell(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    const kiriCell cell = { square, KIRI_NONE, KIRI_NONE, KIRI_NONE, KIRI_NONE };
    const kiriStepRun run = { 0, { 0, 0, 0 } };
    kiriGridWork* work = grid->work;
    int32_t c = grid->freeCell;
    if (c != KIRI_NONE) {
        grid->freeCell = grid->cells.data[c].next;
        grid->cells.data[c] = cell;
    } else if (kiriArray_Push(memory, &grid->cells, cell) && kiriArray_Push(memory, &grid->runs, run) &&
               kiriArray_Push(memory, &work->cellFlags, 0) && kiriArray_Push(memory, &work->mark, 0)) {
        c = grid->cells.count - 1;
    } else {
        return KIRI_NONE;
    }
    ++grid->cellCount;
    work->cellFlags.data[c] = KIRI_CELL_MADE | KIRI_CELL_STEPS;
    bool ok = kiriArray_Push(memory, &grid->changes.made, c) && kiriArray_Push(memory, &grid->changes.steps, c) &&
              (!work->fromScratch || kiriArray_Push(memory, &work->stepsDirty, c));
    return ok ? c : KIRI_NONE;
}

static bool StoreMaterial(kiriGrid* grid, kiriMemory* memory, int32_t c, const kiriMoments* material)
{
    kiriMoments* own = kiriGrid_OwnMaterial(grid, memory, c);
    if (own != NULL) {
        *own = *material;
    }
    return own != NULL;
}

static bool SetMaterial(kiriGrid* grid, const kiriMeshData* mesh, int32_t c, const kiriMoments* material)
{
    kiriMaterialChange change = { c, kiriGrid_Material(grid, mesh, c) };
    uint8_t* flags = &grid->work->cellFlags.data[c];
    if (memcmp(&change.was, material, sizeof(*material)) == 0) {
        return true;
    }
    if (grid->whole.data[grid->cells.data[c].square]) {
        kiriGrid_DropMaterial(grid, c);
    } else if (!StoreMaterial(grid, mesh->memory, c, material)) {
        return false;
    }
    if ((*flags & (KIRI_CELL_MADE | KIRI_CELL_MATERIAL)) != 0) {
        return true;
    }
    *flags |= KIRI_CELL_MATERIAL;
    return kiriArray_Push(mesh->memory, &grid->changes.material, change);
}

/* What it covered is kept: without a square it does not follow any more. */
static bool RemoveCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t c)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, c));
    kiriMemory* memory = mesh->memory;
    kiriCell* cell = &grid->cells.data[c];
    kiriMoments material = kiriGrid_Material(grid, mesh, c);
    if (!StoreMaterial(grid, memory, c, &material)) {
        return false;
    }
    while (cell->firstFace != KIRI_NONE) {
        if (!kiriGrid_RemoveFace(grid, memory, cell->firstFace)) {
            return false;
        }
    }
    kiriGrid_RemoveSteps(grid, memory, c);
    cell->square = cell->next = KIRI_NONE;
    --grid->cellCount;
    grid->work->removed = true;
    return (grid->work->cellFlags.data[c] & KIRI_CELL_MADE) != 0 || kiriArray_Push(memory, &grid->changes.gone, c);
}

static bool FindWholeCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    kiriNewCell whole = { KIRI_NONE, KIRI_NONE, kiriGrid_MaterialOfWhole(grid, mesh, square) };
    return kiriArray_Push(mesh->memory, &grid->work->newCells, whole);
}

/* Adds what a triangle covers to its cell. Cells come by lowest triangle; so far nodes know them by their rank. */
static bool MeasureEntry(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int32_t i)
{
    kiriGridWork* work = grid->work;
    int32_t root = kiriUnion_Root(work->parent.data, i), triangle = kiriGridWork_TriangleAt(work, mesh, i);
    const kiriNewCell none = { triangle, KIRI_NONE, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 } };
    if (root == i && !kiriArray_Push(mesh->memory, &work->newCells, none)) {
        return false;
    }
    int32_t rank = root == i ? work->newCells.count - 1 : grid->nodeCell.data[work->entries.data[root]];
    kiriMoments part = MaterialInSquare(mesh, triangle, square);
    kiriMoments_Add(&work->newCells.data[rank].material, &part);
    grid->nodeCell.data[work->entries.data[i]] = rank;
    return true;
}

static void FinishMaterial(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    for (int32_t rank = 0; rank < grid->work->newCells.count; ++rank) {
        kiriMoments* material = &grid->work->newCells.data[rank].material;
        if (!(material->area > kiriLeastShare * grid->side * grid->side)) {
            *material = Speck(grid->side);
        }
        *material = kiriMoments_About(material, kiriVec2_Scale(-1.0, corner));
    }
}

/* The cells that the square should have, in `newCells`. */
static kiriProgress FindCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    if (grid->whole.data[square]) {
        return work->isSame || FindWholeCell(grid, mesh, square) ? KIRI_DONE : KIRI_FAILED;
    }
    kiriNodeRange range = work->ranges.data[square];
    while (work->at < range.end - range.first) {
        if (!MeasureEntry(grid, mesh, square, range.first + work->at++)) {
            return KIRI_FAILED;
        }
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_MEASURE)) {
            return KIRI_MORE;
        }
    }
    FinishMaterial(grid, mesh, square);
    return KIRI_DONE;
}

/* The old cells of the square become the new ones in their order. Where there are more new ones than old, cells are
   added, and where there are fewer, removed. */
static bool TakeNewCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    int32_t old = grid->squareCell.data[square], last = KIRI_NONE;
    grid->squareCell.data[square] = KIRI_NONE;
    for (int32_t i = 0; i < grid->work->newCells.count; ++i) {
        kiriNewCell* made = &grid->work->newCells.data[i];
        made->cell = old != KIRI_NONE ? old : AddCell(grid, mesh->memory, square);
        if (made->cell == KIRI_NONE || !SetMaterial(grid, mesh, made->cell, &made->material)) {
            return false;
        }
        kiriCell* cell = &grid->cells.data[made->cell];
        old = cell->next;
        cell->triangle = made->triangle;
        cell->next = KIRI_NONE;
        *(last == KIRI_NONE ? &grid->squareCell.data[square] : &grid->cells.data[last].next) = made->cell;
        last = made->cell;
    }
    while (old != KIRI_NONE) {
        int32_t gone = old;
        old = grid->cells.data[gone].next;
        if (!RemoveCell(grid, mesh, gone)) {
            return false;
        }
    }
    return true;
}

static kiriProgress ReplaceCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    (void)quota;
    grid->work->due += KIRI_GRID_CELL * grid->work->newCells.count;
    return grid->work->isSame || TakeNewCells(grid, mesh, square) ? KIRI_DONE : KIRI_FAILED;
}

/* The one cell of a whole square holds all its triangles. Where the square was whole before, nothing else changes. */
static kiriProgress FillWholeCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    int32_t c = grid->squareCell.data[square], *lowest = &grid->cells.data[c].triangle;
    *lowest = work->node == mesh->squares.head[square] ? INT32_MAX : *lowest;
    while (work->node != KIRI_NONE) {
        int32_t triangle = nodes[work->node].triangle;
        *lowest = kiriMin(triangle, *lowest);
        grid->nodeCell.data[work->node] = c;
        work->node = nodes[work->node].next;
        if (!kiriGridWork_Spend(work, quota, KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    return KIRI_DONE;
}

/* An edge in the square may have changed that changes neither material nor faces: a slit that ends there, by its
   tip. */
static bool RecordEdges(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    bool ok = true;
    for (int32_t c = grid->squareCell.data[square]; ok && c != KIRI_NONE; c = grid->cells.data[c].next) {
        uint8_t* flags = &grid->work->cellFlags.data[c];
        ok = (*flags & KIRI_CELL_EDGES) != 0 || kiriArray_Push(memory, &grid->changes.edges, c);
        *flags |= KIRI_CELL_EDGES;
    }
    return ok;
}

/* The vertices of the square that find their fan by this triangle. */
static void FillVertices(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, int32_t triangle, int32_t cell)
{
    const int32_t* corners = mesh->triangles.data[triangle].vertex;
    for (int i = 0; i < 3; ++i) {
        const kiriVertex* v = &mesh->vertices.data[corners[i]];
        if (v->edge / 3 == triangle && kiriSquares_At(&mesh->squares, v->at) == square) {
            grid->vertexCell.data[corners[i]] = cell;
        }
    }
}

/* Gives the square's triangles their cells: so far they have the ranks of FindCells. */
static kiriProgress FillCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    if (grid->whole.data[square]) {
        return FillWholeCell(grid, mesh, square, quota);
    }
    kiriNodeRange range = work->ranges.data[square];
    while (work->at < range.end - range.first) {
        int32_t i = range.first + work->at++, *cell = &grid->nodeCell.data[work->entries.data[i]];
        *cell = work->newCells.data[*cell].cell;
        if (work->newCells.count > 1) {
            FillVertices(grid, mesh, square, kiriGridWork_TriangleAt(work, mesh, i), *cell);
        }
        if (!kiriGridWork_Spend(work, quota, 2 * KIRI_GRID_NODE)) {
            return KIRI_MORE;
        }
    }
    return RecordEdges(grid, mesh->memory, square) ? KIRI_DONE : KIRI_FAILED;
}

kiriProgress kiriGrid_MakeCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    enum { PARTS = 5 };
    static kiriGridStageFn* const parts[PARTS] = { LookWhetherWhole, JoinTriangles, FindCells, ReplaceCells,
                                                   FillCells };
    kiriGridWork* work = grid->work;
    int32_t square = work->fromScratch ? item : mesh->squares.dirty.data[item];
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    for (; work->part < PARTS; ++work->part) {
        if (!work->isAmidPart) {
            work->node = mesh->squares.head[square];
            work->at = 0;
        }
        kiriProgress progress = parts[work->part](grid, mesh, square, quota);
        work->isAmidPart = progress == KIRI_MORE;
        if (progress != KIRI_DONE) {
            return progress;
        }
    }
    work->part = 0;
    return KIRI_DONE;
}

kiriLatticePoint kiriGrid_Anchor(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    kiriMoments largest = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    int32_t square = grid->cells.data[cell].square, lowest = INT32_MAX;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        if (grid->nodeCell.data[n] == cell) {
            int32_t triangle = mesh->squares.nodes.data[n].triangle;
            kiriMoments material = MaterialInSquare(mesh, triangle, square);
            if (material.area > largest.area || (material.area == largest.area && triangle < lowest)) {
                largest = material;
                lowest = triangle;
            }
        }
    }
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    return kiriMesh_Snap(mesh, largest.area > 0.0 ? kiriVec2_Add(corner, kiriMoments_Center(&largest))
                                                  : kiriGrid_Middle(grid, mesh, cell));
}
