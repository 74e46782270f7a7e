#include "grid.h"

#include <string.h>

/* The least share of a square's area, or of its side, that a cell or a face is given. Whether they exist is decided
   exactly; their size is not, and may round to nothing where others divide by it. */
static const double leastShare = 1e-14;

typedef KIRI_ARRAY(int32_t) Ints;

/* What building needs and the grid does not keep. */
typedef struct Work {
    KIRI_ARRAY(uint8_t) whole; /* of each square, see MarkWholeSquares */
    Ints start;                /* a square's first entry in `node`; squares + 1 */
    Ints node;                 /* of squares that are not whole or next to such: nodes by triangle */
    Ints parent;               /* union-find over entries of `node`, then over cells */
    Ints mark;
    Ints nearStart; /* straight and diagonal steps, as stepStart and steps of the grid */
    kiriSteps near;
} Work;

static void ReleaseWork(Work* work, const kiriMemory* memory)
{
    kiriArray_Release(memory, &work->whole);
    kiriArray_Release(memory, &work->start);
    kiriArray_Release(memory, &work->node);
    kiriArray_Release(memory, &work->parent);
    kiriArray_Release(memory, &work->mark);
    kiriArray_Release(memory, &work->nearStart);
    kiriArray_Release(memory, &work->near);
}

static bool Fill(const kiriMemory* memory, Ints* array, int64_t count, int32_t value)
{
    array->count = 0;
    if (!kiriArray_Resize(memory, array, count)) {
        return false;
    }
    for (int64_t i = 0; i < count; ++i) {
        array->data[i] = value;
    }
    return true;
}

/* ---- Union-find, the lowest index stands for all ----------------------------------------------------------------- */

static int32_t Find(int32_t* parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

static void Join(int32_t* parent, int32_t i, int32_t j)
{
    i = Find(parent, i);
    j = Find(parent, j);
    if (i < j) {
        parent[j] = i;
    } else {
        parent[i] = j;
    }
}

static bool FillParents(const kiriMemory* memory, Ints* parent, int32_t count)
{
    if (!Fill(memory, parent, count, 0)) {
        return false;
    }
    for (int32_t i = 0; i < count; ++i) {
        parent->data[i] = i;
    }
    return true;
}

/* ---- Whole squares ----------------------------------------------------------------------------------------------- */

static int32_t Least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}
static int32_t Most(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Does the segment run through the open square? Exact, by separating axes: the sides of the square and the segment. */
static bool RunsThrough(const kiriSquares* squares, int32_t square, kiriPoint a, kiriPoint b)
{
    kiriPoint low = kiriSquares_Corner(squares, square), high = { low.x + squares->side, low.y + squares->side };
    if (Most(a.x, b.x) <= low.x || Least(a.x, b.x) >= high.x || Most(a.y, b.y) <= low.y || Least(a.y, b.y) >= high.y) {
        return false;
    }
    /* The two corners farthest to the left and to the right of a line that rises, or falls. */
    bool rises = (a.x < b.x) == (a.y < b.y);
    kiriPoint p = { low.x, rises ? high.y : low.y }, q = { high.x, rises ? low.y : high.y };
    int64_t sideP = kiriOrient(a, b, p), sideQ = kiriOrient(a, b, q);
    return (sideP < 0 && sideQ > 0) || (sideP > 0 && sideQ < 0);
}

static void MarkCrossed(Work* work, const kiriSquares* squares, kiriPoint a, kiriPoint b)
{
    int32_t lastColumn = (Most(a.x, b.x) + 1) / squares->side, lastRow = (Most(a.y, b.y) + 1) / squares->side;
    for (int32_t row = (Least(a.y, b.y) + 1) / squares->side; row <= lastRow; ++row) {
        for (int32_t column = (Least(a.x, b.x) + 1) / squares->side; column <= lastColumn; ++column) {
            int32_t square = row * squares->columns + column;
            if (RunsThrough(squares, square, a, b)) {
                work->whole.data[square] = 0;
            }
        }
    }
}

/* A square is whole where there is material and neither the outline nor an open edge runs through it. Then it is wholly
   covered, its triangles all hang together in it, and it has one cell: no need to join or to clip. Most squares are. */
static bool MarkWholeSquares(Work* work, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    if (!kiriArray_Resize(mesh->memory, &work->whole, squares->columns * squares->rows)) {
        return false;
    }
    for (int32_t s = 0; s < work->whole.count; ++s) {
        work->whole.data[s] = squares->head[s] != KIRI_NONE;
    }
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin == KIRI_NONE || (twin > h && kiriMesh_IsOpen(mesh, h))) {
            MarkCrossed(work, squares, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                        mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at);
        }
    }
    return true;
}

/* Is the square whole, and all those around that a diagonal step (radius 1) or one like a knight (2) may touch? */
static bool IsWholeAround(const Work* work, const kiriSquares* squares, int32_t square, int32_t radius)
{
    int32_t column = square % squares->columns, row = square / squares->columns;
    if (column < radius || column >= squares->columns - radius || row < radius || row >= squares->rows - radius) {
        return false;
    }
    for (int32_t v = -radius; v <= radius; ++v) {
        int32_t width = v == -2 || v == 2 ? 1 : radius;
        for (int32_t u = -width; u <= width; ++u) {
            if (!work->whole.data[square + v * squares->columns + u]) {
                return false;
            }
        }
    }
    return true;
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

/* Must the triangles of the square be known one by one? For its cells, or for the faces of cells beside it. */
static bool NeedsNodes(const Work* work, const kiriSquares* squares, int32_t square)
{
    const uint8_t* whole = work->whole.data;
    int32_t columns = squares->columns, column = square % columns, row = square / columns;
    return !whole[square] || (column > 0 && !whole[square - 1]) || (column + 1 < columns && !whole[square + 1]) ||
           (row > 0 && !whole[square - columns]) || (row + 1 < squares->rows && !whole[square + columns]);
}

/* By triangle (Shell 1959): the order of a square's list does not matter. */
static void SortNodes(const kiriSquareNode* nodes, int32_t* node, int32_t count)
{
    int32_t gap = 1;
    while (gap < count / 3) {
        gap = 3 * gap + 1;
    }
    for (; gap > 0; gap /= 3) {
        for (int32_t i = gap; i < count; ++i) {
            int32_t moving = node[i], j = i;
            for (; j >= gap && nodes[node[j - gap]].triangle > nodes[moving].triangle; j -= gap) {
                node[j] = node[j - gap];
            }
            node[j] = moving;
        }
    }
}

static bool CollectNodes(Work* work, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int32_t squareCount = squares->columns * squares->rows;
    if (!kiriArray_Resize(mesh->memory, &work->start, (int64_t)squareCount + 1)) {
        return false;
    }
    work->node.count = 0;
    for (int32_t s = 0; s < squareCount; ++s) {
        int32_t first = work->start.data[s] = work->node.count;
        int32_t n = NeedsNodes(work, squares, s) ? squares->head[s] : KIRI_NONE;
        for (; n != KIRI_NONE; n = squares->nodes.data[n].next) {
            if (!kiriArray_Push(mesh->memory, &work->node, n)) {
                return false;
            }
        }
        SortNodes(squares->nodes.data, work->node.data + first, work->node.count - first);
    }
    work->start.data[squareCount] = work->node.count;
    return FillParents(mesh->memory, &work->parent, work->node.count);
}

static int32_t TriangleAt(const Work* work, const kiriMeshData* mesh, int32_t entry)
{
    return mesh->squares.nodes.data[work->node.data[entry]].triangle;
}

/* The entry of a triangle among sorted ones, or KIRI_NONE. */
static int32_t FindEntry(const Work* work, const kiriMeshData* mesh, int32_t from, int32_t end, int32_t triangle)
{
    int32_t last = end;
    while (from < last) {
        int32_t middle = from + (last - from) / 2;
        if (TriangleAt(work, mesh, middle) < triangle) {
            from = middle + 1;
        } else {
            last = middle;
        }
    }
    return from < end && TriangleAt(work, mesh, from) == triangle ? from : KIRI_NONE;
}

/* Joins the triangles of a square over the closed edges that run through it (algorithm 3). */
static void JoinTriangles(Work* work, const kiriMeshData* mesh, int32_t square)
{
    int32_t end = work->start.data[square + 1];
    for (int32_t i = work->start.data[square]; i < end; ++i) {
        int32_t triangle = TriangleAt(work, mesh, i);
        for (int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
            int32_t twin = kiriMesh_Twin(mesh, h);
            if (twin < h || kiriMesh_IsOpen(mesh, h)) {
                continue;
            }
            int32_t j = FindEntry(work, mesh, i + 1, end, twin / 3);
            if (j != KIRI_NONE && RunsThrough(&mesh->squares, square, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                                              mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at)) {
                Join(work->parent.data, i, j);
            }
        }
    }
}

/* Room for what clipping may make of a triangle even where rounding spoils its convexity: at most twice as many corners
   a time, and 3, 4, 6, 9, 13 when counted closely. */
enum { MOST_CORNERS = 13 };
typedef struct Polygon {
    kiriVec2 at[MOST_CORNERS];
    int32_t count;
} Polygon;

/* How far beyond the square's lower (or upper) side along an axis. */
static double Depth(kiriVec2 p, int axis, bool upper, double side)
{
    double x = axis == 0 ? p.x : p.y;
    return upper ? side - x : x;
}

/* Cuts off what is outside one side of the square (Sutherland and Hodgman 1974). An edge is followed from its inner end
   whichever way the triangle runs, so neighbours at this edge get the very same point. */
static void Clip(Polygon* polygon, int axis, bool upper, double side)
{
    double depth[MOST_CORNERS], least = side;
    for (int32_t i = 0; i < polygon->count; ++i) {
        depth[i] = Depth(polygon->at[i], axis, upper, side);
        least = depth[i] < least ? depth[i] : least;
    }
    if (least > 0.0) {
        return;
    }
    Polygon was = *polygon;
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

/* The part of a triangle in a square, about the square's lower corner, so that nothing cancels in a small one. */
static kiriMoments MaterialInSquare(const kiriMeshData* mesh, int32_t triangle, int32_t square)
{
    kiriPoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    double side = mesh->squares.side;
    Polygon part;
    part.count = 3;
    for (int i = 0; i < 3; ++i) {
        part.at[i] = kiriVec2_Make((double)corners[i].x - low.x, (double)corners[i].y - low.y);
    }
    Clip(&part, 0, false, side);
    Clip(&part, 0, true, side);
    Clip(&part, 1, false, side);
    Clip(&part, 1, true, side);
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
    double area = leastShare * side * side, half = 0.5 * side;
    kiriMoments m = { area, half * area, half * area, half * half * area, half * half * area, half * half * area };
    return m;
}

/* Makes the one cell of a whole square. */
static bool AddWholeCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    double x = grid->side, area = x * x;
    kiriMoments about = {
        area, x / 2.0 * area, x / 2.0 * area, area * area / 3.0, area * area / 4.0, area * area / 3.0
    };
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    kiriCell cell = { square, KIRI_NONE, KIRI_NONE, INT32_MAX,
                      kiriMoments_About(&about, kiriVec2_Scale(-1.0, corner)) };
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = nodes[n].next) {
        cell.triangle = Least(cell.triangle, nodes[n].triangle);
        grid->nodeCell.data[n] = grid->cells.count;
    }
    grid->squareCell.data[square] = grid->cells.count;
    return kiriArray_Push(mesh->memory, &grid->cells, cell);
}

/* Makes the cells of a square, by lowest triangle. */
static bool AddCells(kiriGrid* grid, Work* work, const kiriMeshData* mesh, int32_t square)
{
    int32_t first = grid->cells.count;
    JoinTriangles(work, mesh, square);
    for (int32_t i = work->start.data[square]; i < work->start.data[square + 1]; ++i) {
        int32_t root = Find(work->parent.data, i), triangle = TriangleAt(work, mesh, i);
        if (root == i) {
            kiriCell cell = { square, KIRI_NONE, KIRI_NONE, triangle, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 } };
            grid->nodeCell.data[work->node.data[i]] = grid->cells.count;
            if (!kiriArray_Push(mesh->memory, &grid->cells, cell)) {
                return false;
            }
        }
        int32_t c = grid->nodeCell.data[work->node.data[root]];
        kiriMoments part = MaterialInSquare(mesh, triangle, square);
        kiriMoments_Add(&grid->cells.data[c].material, &part);
        grid->nodeCell.data[work->node.data[i]] = c;
    }
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    for (int32_t c = first; c < grid->cells.count; ++c) {
        kiriCell* cell = &grid->cells.data[c];
        if (!(cell->material.area > leastShare * grid->side * grid->side)) {
            cell->material = Speck(grid->side);
        }
        cell->material = kiriMoments_About(&cell->material, kiriVec2_Scale(-1.0, corner));
        cell->next = c + 1 < grid->cells.count ? c + 1 : KIRI_NONE;
    }
    grid->squareCell.data[square] = first < grid->cells.count ? first : KIRI_NONE;
    return true;
}

static bool BuildCells(kiriGrid* grid, Work* work, const kiriMeshData* mesh)
{
    int32_t squareCount = mesh->squares.columns * mesh->squares.rows;
    grid->side = mesh->step * mesh->squares.side;
    grid->cells.count = grid->squareCell.count = grid->nodeCell.count = 0;
    if (!MarkWholeSquares(work, mesh) || !CollectNodes(work, mesh) ||
        !kiriArray_Resize(mesh->memory, &grid->squareCell, squareCount) ||
        !kiriArray_Resize(mesh->memory, &grid->nodeCell, mesh->squares.nodes.count)) {
        return false;
    }
    for (int32_t n = 0; n < grid->nodeCell.count; ++n) {
        grid->nodeCell.data[n] = KIRI_NONE;
    }
    for (int32_t s = 0; s < squareCount; ++s) {
        if (!(work->whole.data[s] ? AddWholeCell(grid, mesh, s) : AddCells(grid, work, mesh, s))) {
            return false;
        }
    }
    return true;
}

/* ---- Faces ------------------------------------------------------------------------------------------------------- */

static int32_t OtherCell(const kiriFace* face, int32_t cell)
{
    return face->cell[face->cell[0] == cell];
}
static int32_t NextFace(const kiriFace* face, int32_t cell)
{
    return face->next[face->cell[1] == cell];
}

/* A stretch of a side: its ends, in lattice steps from the lower end of the side. */
typedef struct Stretch {
    double from, to;
} Stretch;

/* The stretch that a triangle covers of the lower side of a square along the axis. Two of the triangle's edges meet the
   grid line, and no corner lies on it. */
static Stretch CoveredStretch(const kiriMeshData* mesh, int32_t triangle, int32_t square, int axis)
{
    kiriPoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    double side = mesh->squares.side;
    Stretch stretch = { side, 0.0 };
    kiriMesh_Corners(mesh, triangle, corners);
    for (int i = 0; i < 3; ++i) {
        kiriPoint p = corners[i], q = corners[(i + 1) % 3];
        /* Across the side and along it, from the side's lower end; 64 bits hold the products below. */
        int64_t pa = axis == 0 ? p.x - low.x : p.y - low.y, ps = axis == 0 ? p.y - low.y : p.x - low.x;
        int64_t qa = axis == 0 ? q.x - low.x : q.y - low.y, qs = axis == 0 ? q.y - low.y : q.x - low.x;
        if ((pa < 0) != (qa < 0)) {
            double at = (double)(ps * qa - qs * pa) / (double)(qa - pa);
            stretch.from = at < stretch.from ? at : stretch.from;
            stretch.to = at > stretch.to ? at : stretch.to;
        }
    }
    stretch.from = stretch.from > 0.0 ? stretch.from : 0.0;
    stretch.to = stretch.to < side ? stretch.to : side;
    return stretch;
}

/* Null for memory. */
static kiriFace* AddFace(kiriGrid* grid, const kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    int32_t* head = grid->faceHead.data;
    kiriFace face = { { a, b }, { head[a], head[b] }, axis, 0.0, { 0.0, 0.0 }, 0.0 };
    if (!kiriArray_Push(memory, &grid->faces, face)) {
        return NULL;
    }
    head[a] = head[b] = grid->faces.count - 1;
    return &grid->faces.data[grid->faces.count - 1];
}

/* The face between two cells, new if there is none yet; null for memory. Looks from both ends at once, since a cell with
   many faces, a comb, most often touches cells with few. */
static kiriFace* FaceBetween(kiriGrid* grid, const kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    int32_t* head = grid->faceHead.data;
    for (int32_t f = head[a], g = head[b]; f != KIRI_NONE && g != KIRI_NONE;) {
        kiriFace *ofA = &grid->faces.data[f], *ofB = &grid->faces.data[g];
        if (OtherCell(ofA, a) == b) {
            return ofA;
        }
        if (OtherCell(ofB, b) == a) {
            return ofB;
        }
        f = NextFace(ofA, a);
        g = NextFace(ofB, b);
    }
    return AddFace(grid, memory, a, b, axis);
}

/* Adds a stretch by the parallel axis rule: each term is positive, so a narrow face has a sound moment too. */
static void AddStretch(kiriFace* face, const kiriMeshData* mesh, kiriPoint low, Stretch stretch)
{
    double width = mesh->step * (stretch.to - stretch.from), least = leastShare * mesh->step * mesh->squares.side;
    width = width > least ? width : least;
    kiriVec2 corner = kiriMesh_Local(mesh, low);
    double along = 0.5 * mesh->step * (stretch.from + stretch.to);
    kiriVec2 middle =
        face->axis == 0 ? kiriVec2_Make(corner.x, corner.y + along) : kiriVec2_Make(corner.x + along, corner.y);
    kiriVec2 apart = face->width > 0.0 ? kiriVec2_Sub(middle, face->middle) : kiriVec2_Make(0.0, 0.0);
    double sum = face->width + width;
    face->moment += width * width * width / 12.0 + kiriVec2_Dot(apart, apart) * face->width * width / sum;
    face->middle = face->width > 0.0 ? kiriVec2_Add(face->middle, kiriVec2_Scale(width / sum, apart)) : middle;
    face->width = sum;
}

/* Whole squares share their whole side. */
static bool AddWholeFace(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis)
{
    Stretch side = { 0.0, mesh->squares.side };
    kiriFace* face = AddFace(grid, mesh->memory, grid->squareCell.data[before], grid->squareCell.data[square], axis);
    if (face != NULL) {
        AddStretch(face, mesh, kiriSquares_Corner(&mesh->squares, square), side);
    }
    return face != NULL;
}

/* Links the cells of a square to those of the one before it along the axis. A triangle with material in both covers a
   stretch of the side between them, for both together are convex. */
static bool AddFaces(kiriGrid* grid, const Work* work, const kiriMeshData* mesh, int32_t before, int32_t square,
                     int axis)
{
    if (work->whole.data[before] && work->whole.data[square]) {
        return AddWholeFace(grid, mesh, before, square, axis);
    }
    kiriPoint low = kiriSquares_Corner(&mesh->squares, square);
    int32_t i = work->start.data[before], iEnd = work->start.data[before + 1];
    int32_t j = work->start.data[square], jEnd = work->start.data[square + 1];
    while (i < iEnd && j < jEnd) {
        int32_t t = TriangleAt(work, mesh, i), u = TriangleAt(work, mesh, j);
        if (t == u) {
            int32_t a = grid->nodeCell.data[work->node.data[i]], b = grid->nodeCell.data[work->node.data[j]];
            kiriFace* face = FaceBetween(grid, mesh->memory, a, b, axis);
            if (face == NULL) {
                return false;
            }
            AddStretch(face, mesh, low, CoveredStretch(mesh, t, square, axis));
        }
        i += t <= u;
        j += u <= t;
    }
    return true;
}

static bool BuildFaces(kiriGrid* grid, const Work* work, const kiriMeshData* mesh)
{
    grid->faces.count = grid->faceHead.count = 0;
    if (!kiriArray_Resize(mesh->memory, &grid->faceHead, grid->cells.count)) {
        return false;
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        grid->faceHead.data[c] = KIRI_NONE;
    }
    int32_t columns = mesh->squares.columns, rows = mesh->squares.rows;
    for (int32_t s = 0; s < columns * rows; ++s) {
        if ((s % columns > 0 && !AddFaces(grid, work, mesh, s - 1, s, 0)) ||
            (s >= columns && !AddFaces(grid, work, mesh, s - columns, s, 1))) {
            return false;
        }
    }
    return true;
}

static bool NumberPieces(kiriGrid* grid, Work* work, const kiriMemory* memory)
{
    if (!FillParents(memory, &work->parent, grid->cells.count)) {
        return false;
    }
    for (int32_t f = 0; f < grid->faces.count; ++f) {
        Join(work->parent.data, grid->faces.data[f].cell[0], grid->faces.data[f].cell[1]);
    }
    grid->pieces = 0;
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        int32_t root = Find(work->parent.data, c);
        grid->cells.data[c].piece = root == c ? grid->pieces++ : grid->cells.data[root].piece;
    }
    return true;
}

/* ---- Steps ------------------------------------------------------------------------------------------------------- */

/* All steps from a cell amid whole squares, by length, then cell: cells are numbered square by square. */
static const kiriStep openSteps[] = {
    { 0, KIRI_UNIT, 0, -1 },          { 0, KIRI_UNIT, -1, 0 },           { 0, KIRI_UNIT, 1, 0 },
    { 0, KIRI_UNIT, 0, 1 },           { 0, KIRI_UNIT_DIAGONAL, -1, -1 }, { 0, KIRI_UNIT_DIAGONAL, 1, -1 },
    { 0, KIRI_UNIT_DIAGONAL, -1, 1 }, { 0, KIRI_UNIT_DIAGONAL, 1, 1 },   { 0, KIRI_UNIT_KNIGHT, -1, -2 },
    { 0, KIRI_UNIT_KNIGHT, 1, -2 },   { 0, KIRI_UNIT_KNIGHT, -2, -1 },   { 0, KIRI_UNIT_KNIGHT, 2, -1 },
    { 0, KIRI_UNIT_KNIGHT, -2, 1 },   { 0, KIRI_UNIT_KNIGHT, 2, 1 },     { 0, KIRI_UNIT_KNIGHT, -1, 2 },
    { 0, KIRI_UNIT_KNIGHT, 1, 2 },
};
enum { OPEN_NEAR = 8, OPEN_ALL = 16 };

static bool AddOpenSteps(const kiriGrid* grid, kiriSteps* steps, const kiriMeshData* mesh, int32_t cell, int first,
                         int end)
{
    int32_t square = grid->cells.data[cell].square;
    for (int k = first; k < end; ++k) {
        kiriStep step = openSteps[k];
        step.cell = grid->squareCell.data[square + step.v * mesh->squares.columns + step.u];
        if (!kiriArray_Push(mesh->memory, steps, step)) {
            return false;
        }
    }
    return true;
}

/* A cell that is reached from c in two ways: the first leaves the mark First(c), the second finds it. */
static int32_t First(int32_t c)
{
    return 2 * c + 1;
}
static int32_t Second(int32_t c)
{
    return 2 * c + 2;
}

/* By length, then cell. */
static void SortSteps(kiriStep* steps, int32_t from, int32_t end)
{
    for (int32_t i = from + 1; i < end; ++i) {
        kiriStep step = steps[i];
        int32_t j = i;
        for (; j > from; --j) {
            if (steps[j - 1].length < step.length ||
                (steps[j - 1].length == step.length && steps[j - 1].cell < step.cell)) {
                break;
            }
            steps[j] = steps[j - 1];
        }
        steps[j] = step;
    }
}

static kiriStep Straight(const kiriFace* face, int32_t from)
{
    int8_t way = face->cell[0] == from ? 1 : -1;
    return (kiriStep){ OtherCell(face, from), KIRI_UNIT, face->axis == 0 ? way : 0, face->axis == 1 ? way : 0 };
}

/* One step after another. */
static kiriStep Joined(kiriStep a, kiriStep b, int16_t length)
{
    return (kiriStep){ b.cell, length, (int8_t)(a.u + b.u), (int8_t)(a.v + b.v) };
}

static bool AddStraightSteps(const kiriGrid* grid, Work* work, const kiriMemory* memory, int32_t c)
{
    for (int32_t f = grid->faceHead.data[c]; f != KIRI_NONE; f = NextFace(&grid->faces.data[f], c)) {
        const kiriFace* face = &grid->faces.data[f];
        if (!kiriArray_Push(memory, &work->near, Straight(face, c))) {
            return false;
        }
    }
    return true;
}

/* To cells reached along u, then v, and also along v, then u: both ways around the corner. */
static bool AddDiagonalSteps(const kiriGrid* grid, Work* work, const kiriMemory* memory, int32_t c)
{
    const kiriFace* faces = grid->faces.data;
    for (int axis = 0; axis < 2; ++axis) {
        for (int32_t f = grid->faceHead.data[c]; f != KIRI_NONE; f = NextFace(&faces[f], c)) {
            int32_t between = OtherCell(&faces[f], c);
            int32_t g = faces[f].axis == axis ? grid->faceHead.data[between] : KIRI_NONE;
            for (; g != KIRI_NONE; g = NextFace(&faces[g], between)) {
                if (faces[g].axis == axis) {
                    continue;
                }
                kiriStep step = Joined(Straight(&faces[f], c), Straight(&faces[g], between), KIRI_UNIT_DIAGONAL);
                if (axis == 0) {
                    work->mark.data[step.cell] = First(c);
                } else if (work->mark.data[step.cell] == First(c)) {
                    work->mark.data[step.cell] = Second(c);
                    if (!kiriArray_Push(memory, &work->near, step)) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

static bool AddNearSteps(const kiriGrid* grid, Work* work, const kiriMeshData* mesh, int32_t c)
{
    if (IsWholeAround(work, &mesh->squares, grid->cells.data[c].square, 1)) {
        return AddOpenSteps(grid, &work->near, mesh, c, 0, OPEN_NEAR);
    }
    int32_t from = work->near.count;
    bool ok = AddStraightSteps(grid, work, mesh->memory, c) && AddDiagonalSteps(grid, work, mesh->memory, c);
    SortSteps(work->near.data, from, work->near.count);
    return ok;
}

static bool BuildNearSteps(const kiriGrid* grid, Work* work, const kiriMeshData* mesh)
{
    const kiriMemory* memory = mesh->memory;
    work->near.count = 0;
    if (!Fill(memory, &work->mark, grid->cells.count, 0) || !Fill(memory, &work->nearStart, grid->cells.count + 1, 0) ||
        !kiriArray_Reserve(memory, &work->near, OPEN_NEAR * (int64_t)grid->cells.count)) {
        return false;
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        if (!AddNearSteps(grid, work, mesh, c)) {
            return false;
        }
        work->nearStart.data[c + 1] = work->near.count;
    }
    return true;
}

static bool IsKnightMove(kiriStep step)
{
    return (step.u < 0 ? -step.u : step.u) + (step.v < 0 ? -step.v : step.v) == 3;
}

/* To cells reached straight, then diagonally, and also diagonally, then straight: a slit is never jumped. */
static bool AddKnightSteps(kiriGrid* grid, Work* work, const kiriMeshData* mesh, int32_t c)
{
    const int32_t* start = work->nearStart.data;
    const kiriStep* near = work->near.data;
    int32_t from = grid->steps.count;
    if (IsWholeAround(work, &mesh->squares, grid->cells.data[c].square, 2)) {
        return AddOpenSteps(grid, &grid->steps, mesh, c, OPEN_NEAR, OPEN_ALL);
    }
    for (int32_t i = start[c]; i < start[c + 1]; ++i) {
        for (int32_t j = start[near[i].cell]; j < start[near[i].cell + 1]; ++j) {
            if (near[i].length == near[j].length) {
                continue;
            }
            kiriStep step = Joined(near[i], near[j], KIRI_UNIT_KNIGHT);
            if (near[i].length == KIRI_UNIT) { /* straight ones come first */
                if (IsKnightMove(step)) {
                    work->mark.data[step.cell] = First(c);
                }
            } else if (work->mark.data[step.cell] == First(c)) {
                work->mark.data[step.cell] = Second(c);
                if (!kiriArray_Push(mesh->memory, &grid->steps, step)) {
                    return false;
                }
            }
        }
    }
    SortSteps(grid->steps.data, from, grid->steps.count);
    return true;
}

static bool AddSteps(kiriGrid* grid, Work* work, const kiriMeshData* mesh, int32_t c)
{
    int32_t* start = &grid->lengthStart.data[KIRI_STEP_LENGTHS * c];
    grid->stepStart.data[c] = start[0] = start[1] = grid->steps.count;
    for (int32_t i = work->nearStart.data[c]; i < work->nearStart.data[c + 1]; ++i) {
        if (!kiriArray_Push(mesh->memory, &grid->steps, work->near.data[i])) {
            return false;
        }
        start[1] += work->near.data[i].length == KIRI_UNIT;
    }
    start[2] = grid->steps.count;
    return AddKnightSteps(grid, work, mesh, c);
}

static bool BuildSteps(kiriGrid* grid, Work* work, const kiriMeshData* mesh)
{
    const kiriMemory* memory = mesh->memory;
    int32_t cellCount = grid->cells.count;
    grid->steps.count = grid->stepStart.count = 0;
    if (!BuildNearSteps(grid, work, mesh) || !Fill(memory, &work->mark, cellCount, 0) ||
        !kiriArray_Reserve(memory, &grid->steps, OPEN_ALL * (int64_t)cellCount) ||
        !kiriArray_Resize(memory, &grid->stepStart, (int64_t)cellCount + 1) ||
        !kiriArray_Resize(memory, &grid->lengthStart, KIRI_STEP_LENGTHS * (int64_t)cellCount + 1)) {
        return false;
    }
    for (int32_t c = 0; c < cellCount; ++c) {
        if (!AddSteps(grid, work, mesh, c)) {
            return false;
        }
    }
    grid->stepStart.data[cellCount] = grid->lengthStart.data[KIRI_STEP_LENGTHS * cellCount] = grid->steps.count;
    return true;
}

/* ---- The grid ---------------------------------------------------------------------------------------------------- */

bool kiriGrid_Build(kiriGrid* grid, const kiriMeshData* mesh)
{
    Work work = { 0 };
    bool built = BuildCells(grid, &work, mesh) && BuildFaces(grid, &work, mesh) &&
                 NumberPieces(grid, &work, mesh->memory) && BuildSteps(grid, &work, mesh);
    ReleaseWork(&work, mesh->memory);
    return built;
}

void kiriGrid_Release(kiriGrid* grid, const kiriMemory* memory)
{
    kiriArray_Release(memory, &grid->cells);
    kiriArray_Release(memory, &grid->faces);
    kiriArray_Release(memory, &grid->faceHead);
    kiriArray_Release(memory, &grid->stepStart);
    kiriArray_Release(memory, &grid->lengthStart);
    kiriArray_Release(memory, &grid->steps);
    kiriArray_Release(memory, &grid->squareCell);
    kiriArray_Release(memory, &grid->nodeCell);
}

int32_t kiriGrid_CellOf(const kiriGrid* grid, const kiriMeshData* mesh, int32_t triangle, kiriPoint at)
{
    int32_t square = kiriSquares_At(&mesh->squares, at);
    int32_t node = square == KIRI_NONE ? KIRI_NONE : mesh->squares.head[square];
    while (node != KIRI_NONE && mesh->squares.nodes.data[node].triangle != triangle) {
        node = mesh->squares.nodes.data[node].next;
    }
    return node == KIRI_NONE ? KIRI_NONE : grid->nodeCell.data[node];
}

int32_t kiriGrid_CellOfVertex(const kiriGrid* grid, const kiriMeshData* mesh, int32_t vertex)
{
    const kiriVertex* v = &mesh->vertices.data[vertex];
    return kiriGrid_CellOf(grid, mesh, v->edge / 3, v->at);
}

kiriVec2 kiriGrid_Middle(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, grid->cells.data[cell].square));
    return kiriVec2_Add(corner, kiriVec2_Make(0.5 * grid->side, 0.5 * grid->side));
}

kiriPoint kiriGrid_Anchor(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    kiriMoments largest = { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 };
    int32_t square = grid->cells.data[cell].square;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = mesh->squares.nodes.data[n].next) {
        if (grid->nodeCell.data[n] == cell) {
            kiriMoments material = MaterialInSquare(mesh, mesh->squares.nodes.data[n].triangle, square);
            largest = material.area > largest.area ? material : largest;
        }
    }
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    return kiriMesh_Snap(mesh, largest.area > 0.0 ? kiriVec2_Add(corner, kiriMoments_Center(&largest))
                                                  : kiriGrid_Middle(grid, mesh, cell));
}
