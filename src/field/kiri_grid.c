#include "kiri_grid.h"

#include <string.h>

/* The least share of a square's area, or of its side, that a cell or a face is given. Whether they exist is decided
   exactly; their size is not, and may round to nothing where others divide by it. */
static const double leastShare = 1e-14;

typedef KIRI_ARRAY(int32_t) Ints;

/* What the update at hand does to a square. */
enum {
    SQUARE_COLLECTED = 1, /* its triangles are in `node` */
    SQUARE_REMADE = 2,    /* its cells and their faces are made again */
    SQUARE_RELINKED = 4,  /* a face of its cells came or went */
    SQUARE_RESTEPPED = 8, /* the steps of its cells are made again */
};

/* Which lists of changes a cell is in. */
enum { CELL_MADE = 1, CELL_REMADE = 2, CELL_RESTEPPED = 4 };

/* Where a square's triangles are in `node`. */
typedef struct Entries {
    int32_t first, end;
} Entries;

/* A cell as it should be, and its index. */
typedef struct Fresh {
    int32_t triangle, cell;
    kiriMoments material;
} Fresh;

typedef struct OldFace {
    int32_t face;
    kiriFace was;
} OldFace;

/* An update goes through stages, each over the items of a list. All faces need all cells, diagonal steps all faces, and
   knights all diagonal steps. */
struct kiriGridWork {
    bool running, fromScratch;
    bool removed;        /* a cell is gone */
    int32_t stage, item; /* where the update is */
    Ints remade;         /* squares whose cells and faces are made again */
    Ints relinked;       /* squares around which steps are made again */
    Ints stepped;        /* cells whose steps are made again */
    Ints knights;        /* those of them whose knights are not those of the open plane */

    KIRI_ARRAY(uint8_t) squareFlags; /* of each square */
    Ints flagged;                    /* squares that have flags */
    KIRI_ARRAY(Entries) entries;     /* of each square that is collected */
    Ints node;                       /* of squares that are collected: nodes by triangle */
    Ints parent;                     /* union-find over entries of `node` */

    KIRI_ARRAY(uint8_t) cellFlags; /* of each cell */
    KIRI_ARRAY(int64_t) mark;      /* of each cell, for cells that are reached in two ways */
    int64_t lastMark;

    KIRI_ARRAY(Fresh) fresh;      /* cells of a square */
    KIRI_ARRAY(OldFace) oldFaces; /* of a side */
    KIRI_ARRAY(kiriStep) steps;   /* of a cell */
};

static int32_t Least(int32_t a, int32_t b)
{
    return a < b ? a : b;
}
static int32_t Most(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* ---- What changes ------------------------------------------------------------------------------------------------ */

static bool IsFlagged(const kiriGridWork* work, int32_t square, int flag)
{
    return (work->squareFlags.data[square] & flag) != 0;
}

static bool FlagSquare(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag)
{
    uint8_t* flags = &work->squareFlags.data[square];
    bool ok = *flags != 0 || kiriArray_Push(memory, &work->flagged, square);
    *flags |= (uint8_t)flag;
    return ok;
}

/* Puts the square in the list of a flag, once an update. */
static bool ListSquare(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag, Ints* list)
{
    return IsFlagged(work, square, flag) ||
           (FlagSquare(work, memory, square, flag) && kiriArray_Push(memory, list, square));
}

static bool Restep(kiriGrid* grid, kiriMemory* memory, int32_t cell)
{
    uint8_t* flags = &grid->work->cellFlags.data[cell];
    bool listed = (*flags & CELL_RESTEPPED) != 0;
    *flags |= CELL_RESTEPPED;
    return listed || kiriArray_Push(memory, &grid->changes.restepped, cell);
}

/* The face between two cells comes or goes. */
static bool Relink(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b)
{
    kiriGridWork* work = grid->work;
    return work->fromScratch ||
           (Restep(grid, memory, a) && Restep(grid, memory, b) &&
            ListSquare(work, memory, grid->cells.data[a].square, SQUARE_RELINKED, &work->relinked) &&
            ListSquare(work, memory, grid->cells.data[b].square, SQUARE_RELINKED, &work->relinked));
}

static bool SetMaterial(kiriGrid* grid, kiriMemory* memory, int32_t c, const kiriMoments* material)
{
    kiriCell* cell = &grid->cells.data[c];
    kiriRemade remade = { c, cell->material };
    uint8_t* flags = &grid->work->cellFlags.data[c];
    if (memcmp(&cell->material, material, sizeof(*material)) == 0) {
        return true;
    }
    cell->material = *material;
    if ((*flags & (CELL_MADE | CELL_REMADE)) != 0) {
        return true;
    }
    *flags |= CELL_REMADE;
    return kiriArray_Push(memory, &grid->changes.remade, remade);
}

/* The index of a new cell, or KIRI_NONE for memory. */
static int32_t AddCell(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    const kiriCell cell = { square, KIRI_NONE, KIRI_NONE, KIRI_NONE, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 } };
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
    work->cellFlags.data[c] = CELL_MADE | CELL_RESTEPPED;
    bool ok = kiriArray_Push(memory, &grid->changes.made, c) && kiriArray_Push(memory, &grid->changes.restepped, c) &&
              (!work->fromScratch || kiriArray_Push(memory, &work->stepped, c));
    return ok ? c : KIRI_NONE;
}

static void FreeCell(kiriGrid* grid, int32_t c)
{
    grid->cells.data[c].next = grid->freeCell;
    grid->freeCell = c;
}

/* Takes cells that are gone from the other lists. Whoever follows the grid need not hear of those that also came since
   it was settled. */
static void ForgetGone(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    int32_t restepped = 0, remade = 0, made = 0;
    for (int32_t i = 0; i < changes->restepped.count; ++i) {
        changes->restepped.data[restepped] = changes->restepped.data[i];
        restepped += kiriGrid_IsCell(grid, changes->restepped.data[i]);
    }
    for (int32_t i = 0; i < changes->remade.count; ++i) {
        kiriRemade r = changes->remade.data[i];
        changes->remade.data[remade] = r;
        if (kiriGrid_IsCell(grid, r.cell)) {
            ++remade;
        } else {
            grid->cells.data[r.cell].material = r.was;
        }
    }
    for (int32_t i = 0; i < changes->made.count; ++i) {
        int32_t c = changes->made.data[i];
        changes->made.data[made] = c;
        if (kiriGrid_IsCell(grid, c)) {
            ++made;
        } else {
            FreeCell(grid, c);
        }
    }
    changes->restepped.count = restepped;
    changes->remade.count = remade;
    changes->made.count = made;
}

/* ---- Whole squares ----------------------------------------------------------------------------------------------- */

/* Does the outline or an open edge of the triangle run through the square? */
static bool BoundsSquare(const kiriMeshData* mesh, const kiriTriangle* t, int32_t square)
{
    for (int i = 0; i < 3; ++i) {
        if ((t->twin[i] == KIRI_NONE || (t->open >> i & 1) != 0) &&
            kiriSquares_RunsThrough(&mesh->squares, square, mesh->vertices.data[t->vertex[i]].at,
                                    mesh->vertices.data[t->vertex[(i + 1) % 3]].at)) {
            return true;
        }
    }
    return false;
}

/* A square is whole where there is material and neither the outline nor an open edge runs through it. Then it is wholly
   covered, its triangles all hang together in it, and it has one cell: no need to join or to clip. Most squares are. */
static bool IsWhole(const kiriMeshData* mesh, int32_t square)
{
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    int32_t first = mesh->squares.head[square];
    for (int32_t n = first; n != KIRI_NONE; n = nodes[n].next) {
        const kiriTriangle* t = &mesh->triangles.data[nodes[n].triangle];
        bool isInner = t->open == 0 && (t->twin[0] | t->twin[1] | t->twin[2]) >= 0; /* KIRI_NONE has the sign bit */
        if (!isInner && BoundsSquare(mesh, t, square)) {
            return false;
        }
    }
    return first != KIRI_NONE;
}

/* Steps touch the squares up to two rows away, in row v so many on each side of the column. */
enum { REACH = 2 };
static int32_t ReachInRow(int32_t v)
{
    return v == -REACH || v == REACH ? 1 : REACH;
}

/* Is the square whole, and all those around that a step may touch? */
static bool IsWholeAround(const kiriGrid* grid, const kiriSquares* squares, int32_t square)
{
    int32_t column = square % squares->columns, row = square / squares->columns;
    if (column < REACH || column >= squares->columns - REACH || row < REACH || row >= squares->rows - REACH) {
        return false;
    }
    for (int32_t v = -REACH; v <= REACH; ++v) {
        const uint8_t* whole = &grid->whole.data[square + v * squares->columns];
        for (int32_t u = -ReachInRow(v); u <= ReachInRow(v); ++u) {
            if (!whole[u]) {
                return false;
            }
        }
    }
    return true;
}

/* ---- Triangles of a square --------------------------------------------------------------------------------------- */

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

/* Where the square's triangles must be known one by one: for its cells, or for the faces of cells beside it. */
static bool Collect(kiriGridWork* work, const kiriMeshData* mesh, int32_t square)
{
    const kiriSquares* squares = &mesh->squares;
    if (IsFlagged(work, square, SQUARE_COLLECTED)) {
        return true;
    }
    int32_t first = work->node.count;
    for (int32_t n = squares->head[square]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
        if (!kiriArray_Push(mesh->memory, &work->parent, work->node.count) ||
            !kiriArray_Push(mesh->memory, &work->node, n)) {
            return false;
        }
    }
    SortNodes(squares->nodes.data, work->node.data + first, work->node.count - first);
    Entries entries = { first, work->node.count };
    work->entries.data[square] = entries;
    return FlagSquare(work, mesh->memory, square, SQUARE_COLLECTED);
}

static int32_t TriangleAt(const kiriGridWork* work, const kiriMeshData* mesh, int32_t entry)
{
    return mesh->squares.nodes.data[work->node.data[entry]].triangle;
}

/* The entry of a triangle among sorted ones, or KIRI_NONE. */
static int32_t FindEntry(const kiriGridWork* work, const kiriMeshData* mesh, int32_t from, int32_t end,
                         int32_t triangle)
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

/* Union-find; the lowest index stands for all. */
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

/* Joins the triangles of a square over the closed edges that run through it (algorithm 3). */
static void JoinTriangles(kiriGridWork* work, const kiriMeshData* mesh, int32_t square)
{
    Entries entries = work->entries.data[square];
    for (int32_t i = entries.first; i < entries.end; ++i) {
        int32_t triangle = TriangleAt(work, mesh, i);
        for (int32_t h = 3 * triangle; h < 3 * triangle + 3; ++h) {
            int32_t twin = kiriMesh_Twin(mesh, h);
            if (twin < h || kiriMesh_IsOpen(mesh, h)) {
                continue;
            }
            int32_t j = FindEntry(work, mesh, i + 1, entries.end, twin / 3);
            if (j != KIRI_NONE &&
                kiriSquares_RunsThrough(&mesh->squares, square, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                                        mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at)) {
                Join(work->parent.data, i, j);
            }
        }
    }
}

/* ---- Material ---------------------------------------------------------------------------------------------------- */

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

/* Most triangles reach over few sides of a square, if any: whole numbers tell faster. */
static void ClipToSquare(Polygon* part, const kiriLatticePoint c[3], kiriLatticePoint low, int32_t side)
{
    kiriLatticePoint high = { low.x + side, low.y + side };
    if (c[0].x < low.x || c[1].x < low.x || c[2].x < low.x) {
        Clip(part, 0, false, side);
    }
    if (c[0].x > high.x || c[1].x > high.x || c[2].x > high.x) {
        Clip(part, 0, true, side);
    }
    if (c[0].y < low.y || c[1].y < low.y || c[2].y < low.y) {
        Clip(part, 1, false, side);
    }
    if (c[0].y > high.y || c[1].y > high.y || c[2].y > high.y) {
        Clip(part, 1, true, side);
    }
}

/* The part of a triangle in a square, about the square's lower corner, so that nothing cancels in a small one. */
static kiriMoments MaterialInSquare(const kiriMeshData* mesh, int32_t triangle, int32_t square)
{
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    Polygon part;
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
    double area = leastShare * side * side, half = 0.5 * side;
    kiriMoments m = { area, half * area, half * area, half * half * area, half * half * area, half * half * area };
    return m;
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

/* Null for memory. */
static kiriFace* AddFace(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    kiriCell *cellA = &grid->cells.data[a], *cellB = &grid->cells.data[b];
    const kiriFace face = { { a, b }, { cellA->firstFace, cellB->firstFace }, axis, 0.0, { 0.0, 0.0 }, 0.0 };
    int32_t f = grid->freeFace;
    if (f != KIRI_NONE) {
        grid->freeFace = grid->faces.data[f].next[0];
        grid->faces.data[f] = face;
    } else if (kiriArray_Push(memory, &grid->faces, face)) {
        f = grid->faces.count - 1;
    }
    if (f == KIRI_NONE || !Relink(grid, memory, a, b)) {
        return NULL;
    }
    cellA->firstFace = cellB->firstFace = f;
    return &grid->faces.data[f];
}

static void UnlinkFace(kiriGrid* grid, int32_t f, int32_t cell)
{
    int32_t* link = &grid->cells.data[cell].firstFace;
    while (*link != f) {
        kiriFace* face = &grid->faces.data[*link];
        link = &face->next[face->cell[1] == cell];
    }
    *link = NextFace(&grid->faces.data[f], cell);
}

static bool RemoveFace(kiriGrid* grid, kiriMemory* memory, int32_t f)
{
    kiriFace* face = &grid->faces.data[f];
    bool ok = Relink(grid, memory, face->cell[0], face->cell[1]);
    UnlinkFace(grid, f, face->cell[0]);
    UnlinkFace(grid, f, face->cell[1]);
    face->cell[0] = KIRI_NONE;
    face->next[0] = grid->freeFace;
    grid->freeFace = f;
    return ok;
}

/* The face between two cells, new if there is none yet; null for memory. Looks from both ends at once, since a cell
   with many faces, a comb, most often touches cells with few. */
static kiriFace* FaceBetween(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b, int axis)
{
    int32_t f = grid->cells.data[a].firstFace, g = grid->cells.data[b].firstFace;
    while (f != KIRI_NONE && g != KIRI_NONE) {
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

/* A stretch of a side: its ends, in lattice steps from the lower end of the side. */
typedef struct Stretch {
    double from, to;
} Stretch;

/* The stretch that a triangle covers of the lower side of a square along the axis. Two of the triangle's edges meet the
   grid line, and no corner lies on it. */
static Stretch CoveredStretch(const kiriMeshData* mesh, int32_t triangle, int32_t square, int axis)
{
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square), corners[3];
    double side = mesh->squares.side;
    Stretch stretch = { side, 0.0 };
    kiriMesh_Corners(mesh, triangle, corners);
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint p = corners[i], q = corners[(i + 1) % 3];
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

/* Adds a stretch by the parallel axis rule: each term is positive, so a narrow face has a sound moment too. */
static void AddStretch(kiriFace* face, const kiriMeshData* mesh, kiriLatticePoint low, Stretch stretch)
{
    double width = mesh->step * (stretch.to - stretch.from), least = leastShare * mesh->step * mesh->squares.side;
    width = width > least ? width : least;
    kiriVec2 corner = kiriMesh_Local(mesh, low);
    double along = 0.5 * mesh->step * (stretch.from + stretch.to);
    kiriVec2 middle =
        face->axis == 0 ? kiriVec2_Make(corner.x, corner.y + along) : kiriVec2_Make(corner.x + along, corner.y);
    if (face->width == 0.0) {
        face->width = width;
        face->middle = middle;
        face->moment = width * width * width / 12.0;
        return;
    }
    kiriVec2 apart = kiriVec2_Sub(middle, face->middle);
    double sum = face->width + width;
    face->moment += width * width * width / 12.0 + kiriVec2_Dot(apart, apart) * face->width * width / sum;
    face->middle = kiriVec2_Add(face->middle, kiriVec2_Scale(width / sum, apart));
    face->width = sum;
}

/* Whole squares share their whole side. */
static bool AddWholeFace(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis)
{
    Stretch side = { 0.0, mesh->squares.side };
    kiriFace* face =
        FaceBetween(grid, mesh->memory, grid->squareCell.data[before], grid->squareCell.data[square], axis);
    if (face != NULL) {
        AddStretch(face, mesh, kiriSquares_Corner(&mesh->squares, square), side);
    }
    return face != NULL;
}

/* Links the cells of a square to those of the one before it along the axis. A triangle with material in both covers a
   stretch of the side between them, for both together are convex. */
static bool AddFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis)
{
    kiriGridWork* work = grid->work;
    if (grid->whole.data[before] && grid->whole.data[square]) {
        return AddWholeFace(grid, mesh, before, square, axis);
    }
    if (!Collect(work, mesh, before) || !Collect(work, mesh, square)) {
        return false;
    }
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square);
    Entries a = work->entries.data[before], b = work->entries.data[square];
    for (int32_t i = a.first, j = b.first; i < a.end && j < b.end;) {
        int32_t t = TriangleAt(work, mesh, i), u = TriangleAt(work, mesh, j);
        if (t == u) {
            kiriFace* face = FaceBetween(grid, mesh->memory, grid->nodeCell.data[work->node.data[i]],
                                         grid->nodeCell.data[work->node.data[j]], axis);
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

/* Empties the faces on the lower side of a square along the axis, and keeps what they were. */
static bool EmptyFaces(kiriGrid* grid, kiriMemory* memory, int32_t square, int axis)
{
    kiriGridWork* work = grid->work;
    work->oldFaces.count = 0;
    for (int32_t c = work->fromScratch ? KIRI_NONE : grid->squareCell.data[square]; c != KIRI_NONE;
         c = grid->cells.data[c].next) {
        for (int32_t f = grid->cells.data[c].firstFace; f != KIRI_NONE; f = NextFace(&grid->faces.data[f], c)) {
            kiriFace* face = &grid->faces.data[f];
            if (face->cell[1] == c && face->axis == axis) {
                OldFace old = { f, *face };
                if (!kiriArray_Push(memory, &work->oldFaces, old)) {
                    return false;
                }
                face->width = face->moment = 0.0;
            }
        }
    }
    return true;
}

/* Finds out what became of the faces that were emptied. */
static bool CompareFaces(kiriGrid* grid, kiriMemory* memory)
{
    for (int32_t i = 0; i < grid->work->oldFaces.count; ++i) {
        const OldFace* old = &grid->work->oldFaces.data[i];
        const kiriFace *was = &old->was, *is = &grid->faces.data[old->face];
        if (is->width == 0.0) {
            if (!RemoveFace(grid, memory, old->face)) {
                return false;
            }
        } else if (is->width != was->width || is->moment != was->moment || is->middle.x != was->middle.x ||
                   is->middle.y != was->middle.y) {
            if (!Restep(grid, memory, is->cell[0]) || !Restep(grid, memory, is->cell[1])) {
                return false;
            }
        }
    }
    return true;
}

static bool MakeSide(kiriGrid* grid, const kiriMeshData* mesh, int32_t before, int32_t square, int axis)
{
    if (grid->squareCell.data[before] == KIRI_NONE || grid->squareCell.data[square] == KIRI_NONE) {
        return true;
    }
    return EmptyFaces(grid, mesh->memory, square, axis) && AddFaces(grid, mesh, before, square, axis) &&
           CompareFaces(grid, mesh->memory);
}

/* The faces on all sides of a square. Between two squares that are both made again, the one behind does it. */
static bool MakeFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t item)
{
    const kiriGridWork* work = grid->work;
    int32_t square = work->remade.data[item], columns = mesh->squares.columns, column = square % columns;
    bool right = column + 1 < columns && !IsFlagged(work, square + 1, SQUARE_REMADE);
    bool above = square + columns < work->squareFlags.count && !IsFlagged(work, square + columns, SQUARE_REMADE);
    return (column == 0 || MakeSide(grid, mesh, square - 1, square, 0)) &&
           (square < columns || MakeSide(grid, mesh, square - columns, square, 1)) &&
           (!right || MakeSide(grid, mesh, square, square + 1, 0)) &&
           (!above || MakeSide(grid, mesh, square, square + columns, 1));
}

/* ---- Room for steps ---------------------------------------------------------------------------------------------- */

/* How many steps a cell amid whole squares has: straight and diagonal ones, and all. */
enum { OPEN_NEAR = 8, OPEN_ALL = 16 };

/* There is room for those at least, so that most runs never move. */
static int32_t RoomFor(int32_t count)
{
    return count == 0 ? 0 : Most(count, OPEN_ALL);
}

static int32_t CountSteps(const kiriStepRun* run)
{
    return run->end[KIRI_STEP_LENGTHS - 1] - run->first;
}

/* Room for so many steps; false for memory. */
static bool SetStepCount(kiriGrid* grid, kiriMemory* memory, int32_t c, int32_t count)
{
    kiriStepRun* run = &grid->runs.data[c];
    kiriSpan span = { run->first, RoomFor(CountSteps(run)) };
    bool ok = kiriSpan_Resize(&span, &grid->stepRoom, memory, &grid->steps, sizeof(kiriStep), RoomFor(count));
    run->first = span.first;
    run->end[0] = run->end[1] = run->end[2] = span.first + count;
    return ok;
}

/* The cell's steps become those in `work`, so many of each length. */
static bool SetSteps(kiriGrid* grid, kiriMemory* memory, int32_t c, int32_t straight, int32_t near)
{
    const kiriGridWork* work = grid->work;
    kiriStepRun* run = &grid->runs.data[c];
    size_t bytes = sizeof(kiriStep) * (size_t)work->steps.count;
    if (CountSteps(run) == work->steps.count && run->end[0] - run->first == straight &&
        run->end[1] - run->first == near &&
        (bytes == 0 || memcmp(&grid->steps.data[run->first], work->steps.data, bytes) == 0)) {
        return true;
    }
    if (!SetStepCount(grid, memory, c, work->steps.count)) {
        return false;
    }
    if (bytes > 0) {
        memcpy(&grid->steps.data[run->first], work->steps.data, bytes);
    }
    run->end[0] = run->first + straight;
    run->end[1] = run->first + near;
    return Restep(grid, memory, c);
}

/* ---- Cells ------------------------------------------------------------------------------------------------------- */

static bool RemoveCell(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    kiriCell* cell = &grid->cells.data[c];
    while (cell->firstFace != KIRI_NONE) {
        if (!RemoveFace(grid, memory, cell->firstFace)) {
            return false;
        }
    }
    (void)SetStepCount(grid, memory, c, 0); /* cannot fail: it shrinks */
    cell->square = cell->next = KIRI_NONE;
    --grid->cellCount;
    grid->work->removed = true;
    return (grid->work->cellFlags.data[c] & CELL_MADE) != 0 || kiriArray_Push(memory, &grid->changes.gone, c);
}

/* The one cell of a whole square holds all its triangles. Where it was whole before, only they may be others. */
static void FillWholeCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    const kiriSquareNode* nodes = mesh->squares.nodes.data;
    int32_t c = grid->squareCell.data[square], lowest = INT32_MAX;
    for (int32_t n = mesh->squares.head[square]; n != KIRI_NONE; n = nodes[n].next) {
        lowest = Least(lowest, nodes[n].triangle);
        grid->nodeCell.data[n] = c;
    }
    grid->cells.data[c].triangle = lowest;
}

static bool FindWholeCell(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    double x = grid->side, area = x * x;
    kiriMoments about = {
        area, x / 2.0 * area, x / 2.0 * area, area * area / 3.0, area * area / 4.0, area * area / 3.0
    };
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    Fresh fresh = { KIRI_NONE, KIRI_NONE, kiriMoments_About(&about, kiriVec2_Scale(-1.0, corner)) };
    return kiriArray_Push(mesh->memory, &grid->work->fresh, fresh);
}

/* The cells of a square that is not whole, by lowest triangle. */
static bool FindCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t square)
{
    kiriGridWork* work = grid->work;
    if (!Collect(work, mesh, square)) {
        return false;
    }
    JoinTriangles(work, mesh, square);
    for (int32_t i = work->entries.data[square].first; i < work->entries.data[square].end; ++i) {
        int32_t root = Find(work->parent.data, i), node = work->node.data[i], triangle = TriangleAt(work, mesh, i);
        const Fresh none = { triangle, KIRI_NONE, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 } };
        if (root == i && !kiriArray_Push(mesh->memory, &work->fresh, none)) {
            return false;
        }
        int32_t rank = root == i ? work->fresh.count - 1 : grid->nodeCell.data[work->node.data[root]];
        kiriMoments part = MaterialInSquare(mesh, triangle, square);
        kiriMoments_Add(&work->fresh.data[rank].material, &part);
        grid->nodeCell.data[node] = rank;
    }
    kiriVec2 corner = kiriMesh_Local(mesh, kiriSquares_Corner(&mesh->squares, square));
    for (int32_t rank = 0; rank < work->fresh.count; ++rank) {
        kiriMoments* material = &work->fresh.data[rank].material;
        if (!(material->area > leastShare * grid->side * grid->side)) {
            *material = Speck(grid->side);
        }
        *material = kiriMoments_About(material, kiriVec2_Scale(-1.0, corner));
    }
    return true;
}

/* The old cells of the square become the new ones in their order; what is left over comes or goes. */
static bool ReplaceCells(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    int32_t old = grid->squareCell.data[square], last = KIRI_NONE;
    grid->squareCell.data[square] = KIRI_NONE;
    for (int32_t i = 0; i < grid->work->fresh.count; ++i) {
        Fresh* fresh = &grid->work->fresh.data[i];
        fresh->cell = old != KIRI_NONE ? old : AddCell(grid, memory, square);
        if (fresh->cell == KIRI_NONE || !SetMaterial(grid, memory, fresh->cell, &fresh->material)) {
            return false;
        }
        kiriCell* cell = &grid->cells.data[fresh->cell];
        old = cell->next;
        cell->triangle = fresh->triangle;
        cell->next = KIRI_NONE;
        *(last == KIRI_NONE ? &grid->squareCell.data[square] : &grid->cells.data[last].next) = fresh->cell;
        last = fresh->cell;
    }
    while (old != KIRI_NONE) {
        int32_t gone = old;
        old = grid->cells.data[gone].next;
        if (!RemoveCell(grid, memory, gone)) {
            return false;
        }
    }
    return true;
}

/* The square's triangles learn their cells: so far they have ranks. */
static void FillCells(kiriGrid* grid, int32_t square)
{
    const kiriGridWork* work = grid->work;
    for (int32_t i = work->entries.data[square].first; i < work->entries.data[square].end; ++i) {
        int32_t* cell = &grid->nodeCell.data[work->node.data[i]];
        *cell = work->fresh.data[*cell].cell;
    }
}

/* The cells of a square that has changed. */
static bool MakeCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t item)
{
    kiriGridWork* work = grid->work;
    int32_t square = work->fromScratch ? item : mesh->squares.dirty.data[item];
    bool wasWhole = grid->whole.data[square], isWhole = IsWhole(mesh, square);
    grid->whole.data[square] = isWhole;
    work->fresh.count = 0;
    if (!(wasWhole && isWhole) && (!ListSquare(work, mesh->memory, square, SQUARE_REMADE, &work->remade) ||
                                   !(isWhole ? FindWholeCell(grid, mesh, square) : FindCells(grid, mesh, square)) ||
                                   !ReplaceCells(grid, mesh->memory, square))) {
        return false;
    }
    if (isWhole) {
        FillWholeCell(grid, mesh, square);
    } else {
        FillCells(grid, square);
    }
    return true;
}

/* ---- Steps ------------------------------------------------------------------------------------------------------- */

/* The steps of the square's cells are to be made again. */
static bool StepSquare(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    if (IsFlagged(grid->work, square, SQUARE_RESTEPPED)) {
        return true;
    }
    for (int32_t c = grid->squareCell.data[square]; c != KIRI_NONE; c = grid->cells.data[c].next) {
        if (!kiriArray_Push(memory, &grid->work->stepped, c)) {
            return false;
        }
    }
    return FlagSquare(grid->work, memory, square, SQUARE_RESTEPPED);
}

/* All cells from which a step may touch a square where a face came or went. */
static bool Spread(kiriGrid* grid, const kiriMeshData* mesh, int32_t item)
{
    kiriGridWork* work = grid->work;
    const kiriSquares* squares = &mesh->squares;
    int32_t square = work->relinked.data[item], column = square % squares->columns, row = square / squares->columns;
    for (int32_t v = Most(-REACH, -row); v <= REACH && row + v < squares->rows; ++v) {
        int32_t reach = ReachInRow(v);
        for (int32_t u = Most(-reach, -column); u <= reach && column + u < squares->columns; ++u) {
            if (!StepSquare(grid, mesh->memory, square + v * squares->columns + u)) {
                return false;
            }
        }
    }
    return true;
}

/* All steps from a cell amid whole squares, in their order. */
static const kiriStep openSteps[] = {
    { 0, KIRI_UNIT, 0, -1 },          { 0, KIRI_UNIT, -1, 0 },           { 0, KIRI_UNIT, 1, 0 },
    { 0, KIRI_UNIT, 0, 1 },           { 0, KIRI_UNIT_DIAGONAL, -1, -1 }, { 0, KIRI_UNIT_DIAGONAL, 1, -1 },
    { 0, KIRI_UNIT_DIAGONAL, -1, 1 }, { 0, KIRI_UNIT_DIAGONAL, 1, 1 },   { 0, KIRI_UNIT_KNIGHT, -1, -2 },
    { 0, KIRI_UNIT_KNIGHT, 1, -2 },   { 0, KIRI_UNIT_KNIGHT, -2, -1 },   { 0, KIRI_UNIT_KNIGHT, 2, -1 },
    { 0, KIRI_UNIT_KNIGHT, -2, 1 },   { 0, KIRI_UNIT_KNIGHT, 2, 1 },     { 0, KIRI_UNIT_KNIGHT, -1, 2 },
    { 0, KIRI_UNIT_KNIGHT, 1, 2 },
};

static bool AddStep(kiriGrid* grid, kiriMemory* memory, kiriStep step)
{
    return kiriArray_Push(memory, &grid->work->steps, step);
}

/* Adds steps that the cell has. */
static bool AddSteps(kiriGrid* grid, kiriMemory* memory, int32_t from, int32_t end)
{
    kiriGridWork* work = grid->work;
    int32_t count = work->steps.count;
    if (!kiriArray_Resize(memory, &work->steps, (int64_t)count + end - from)) {
        return false;
    }
    if (from < end) {
        memcpy(&work->steps.data[count], &grid->steps.data[from], sizeof(kiriStep) * (size_t)(end - from));
    }
    return true;
}

/* The steps of a cell amid whole squares. */
static bool MakeOpenSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t c)
{
    int32_t square = grid->cells.data[c].square;
    if (!kiriArray_Resize(mesh->memory, &grid->work->steps, OPEN_ALL)) {
        return false;
    }
    kiriStep* steps = grid->work->steps.data;
    for (int k = 0; k < OPEN_ALL; ++k) {
        steps[k] = openSteps[k];
        steps[k].cell = grid->squareCell.data[square + steps[k].v * mesh->squares.columns + steps[k].u];
    }
    return SetSteps(grid, mesh->memory, c, OPEN_NEAR / 2, OPEN_NEAR);
}

/* Does step a come before b? Both from the same cell: the way tells the order of squares. */
static bool ComesBefore(const kiriGrid* grid, kiriStep a, kiriStep b)
{
    if (a.length != b.length) {
        return a.length < b.length;
    }
    if (a.v != b.v) {
        return a.v < b.v;
    }
    return a.u != b.u ? a.u < b.u : grid->cells.data[a.cell].triangle < grid->cells.data[b.cell].triangle;
}

static void SortSteps(kiriGrid* grid, int32_t from)
{
    kiriStep* steps = grid->work->steps.data;
    for (int32_t i = from + 1; i < grid->work->steps.count; ++i) {
        kiriStep step = steps[i];
        int32_t j = i;
        for (; j > from && ComesBefore(grid, step, steps[j - 1]); --j) {
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

/* A step counts where two ways lead to its cell, and counts once: the first way marks the cell with the number that
   this returns, the second way finds it and makes it one more. */
static int64_t NewMark(kiriGridWork* work)
{
    work->lastMark += 2;
    return work->lastMark;
}

static bool AddStraightSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    for (int32_t f = grid->cells.data[c].firstFace; f != KIRI_NONE; f = NextFace(&grid->faces.data[f], c)) {
        if (!AddStep(grid, memory, Straight(&grid->faces.data[f], c))) {
            return false;
        }
    }
    return true;
}

/* To cells reached along u, then v, and also along v, then u: both ways around the corner. */
static bool AddDiagonalSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    const kiriFace* faces = grid->faces.data;
    const kiriCell* cells = grid->cells.data;
    int64_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    for (int axis = 0; axis < 2; ++axis) {
        for (int32_t f = cells[c].firstFace; f != KIRI_NONE; f = NextFace(&faces[f], c)) {
            int32_t between = OtherCell(&faces[f], c);
            int32_t g = faces[f].axis == axis ? cells[between].firstFace : KIRI_NONE;
            for (; g != KIRI_NONE; g = NextFace(&faces[g], between)) {
                if (faces[g].axis == axis) {
                    continue;
                }
                kiriStep step = Joined(Straight(&faces[f], c), Straight(&faces[g], between), KIRI_UNIT_DIAGONAL);
                if (axis == 0) {
                    mark[step.cell] = first;
                } else if (mark[step.cell] == first) {
                    mark[step.cell] = first + 1;
                    if (!AddStep(grid, memory, step)) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

/* A cell's straight and diagonal steps. Its knights stay for the time being, or are those of the open plane. */
static bool MakeNearSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item)
{
    kiriGridWork* work = grid->work;
    kiriMemory* memory = mesh->memory;
    int32_t c = work->stepped.data[item];
    const kiriStepRun* run = &grid->runs.data[c];
    work->steps.count = 0;
    if (IsWholeAround(grid, &mesh->squares, grid->cells.data[c].square)) {
        return MakeOpenSteps(grid, mesh, c);
    }
    if (!AddStraightSteps(grid, memory, c)) {
        return false;
    }
    int32_t straight = work->steps.count;
    if (!AddDiagonalSteps(grid, memory, c)) {
        return false;
    }
    int32_t near = work->steps.count;
    SortSteps(grid, 0);
    return AddSteps(grid, memory, run->end[1], run->end[2]) && SetSteps(grid, memory, c, straight, near) &&
           kiriArray_Push(memory, &work->knights, c);
}

/* Does a diagonal step after a straight one lead on, not back? */
static bool IsKnightMove(kiriStep straight, kiriStep diagonal)
{
    return straight.u == diagonal.u || straight.v == diagonal.v;
}

/* To cells reached straight, then diagonally, and also diagonally, then straight: a slit is never jumped. */
static bool AddKnightSteps(kiriGrid* grid, kiriMemory* memory, const kiriStepRun* run)
{
    const kiriStep* steps = grid->steps.data;
    const kiriStepRun* runs = grid->runs.data;
    int64_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    for (int32_t i = run->first; i < run->end[0]; ++i) {
        for (int32_t j = runs[steps[i].cell].end[0]; j < runs[steps[i].cell].end[1]; ++j) {
            if (IsKnightMove(steps[i], steps[j])) {
                mark[steps[j].cell] = first;
            }
        }
    }
    for (int32_t i = run->end[0]; i < run->end[1]; ++i) {
        for (int32_t j = runs[steps[i].cell].first; j < runs[steps[i].cell].end[0]; ++j) {
            if (mark[steps[j].cell] == first) {
                mark[steps[j].cell] = first + 1;
                if (!AddStep(grid, memory, Joined(steps[i], steps[j], KIRI_UNIT_KNIGHT))) {
                    return false;
                }
            }
        }
    }
    return true;
}

static bool MakeKnightSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item)
{
    kiriMemory* memory = mesh->memory;
    int32_t c = grid->work->knights.data[item];
    const kiriStepRun run = grid->runs.data[c];
    grid->work->steps.count = 0;
    if (!AddSteps(grid, memory, run.first, run.end[1]) || !AddKnightSteps(grid, memory, &run)) {
        return false;
    }
    SortSteps(grid, run.end[1] - run.first);
    return SetSteps(grid, memory, c, run.end[0] - run.first, run.end[1] - run.first);
}

/* ---- The update -------------------------------------------------------------------------------------------------- */

enum { STAGE_CELLS, STAGE_FACES, STAGE_SPREAD, STAGE_NEAR_STEPS, STAGE_KNIGHT_STEPS, STAGES };

static int32_t CountItems(const kiriGridWork* work, const kiriMeshData* mesh)
{
    switch (work->stage) {
    case STAGE_CELLS:
        return work->fromScratch ? mesh->squares.columns * mesh->squares.rows : mesh->squares.dirty.count;
    case STAGE_FACES:
        return work->remade.count;
    case STAGE_SPREAD:
        return work->relinked.count;
    case STAGE_NEAR_STEPS:
        return work->stepped.count;
    default:
        return work->knights.count;
    }
}

static bool MakeItem(kiriGrid* grid, const kiriMeshData* mesh)
{
    int32_t item = grid->work->item++;
    switch (grid->work->stage) {
    case STAGE_CELLS:
        return MakeCells(grid, mesh, item);
    case STAGE_FACES:
        return MakeFaces(grid, mesh, item);
    case STAGE_SPREAD:
        return Spread(grid, mesh, item);
    case STAGE_NEAR_STEPS:
        return MakeNearSteps(grid, mesh, item);
    default:
        return MakeKnightSteps(grid, mesh, item);
    }
}

/* Room for a cell a square and for more that cuts make, so that the first cut need not move everything. */
static bool ReserveCells(kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriGridWork* work = grid->work;
    kiriMemory* memory = mesh->memory;
    int64_t squares = 0;
    for (int32_t s = 0; s < grid->squareCell.count; ++s) {
        squares += mesh->squares.head[s] != KIRI_NONE;
    }
    int64_t cells = squares + squares / 4 + 64;
    return kiriArray_Reserve(memory, &grid->cells, cells) && kiriArray_Reserve(memory, &grid->runs, cells) &&
           kiriArray_Reserve(memory, &work->cellFlags, cells) && kiriArray_Reserve(memory, &work->mark, cells) &&
           kiriArray_Reserve(memory, &grid->changes.made, cells) &&
           kiriArray_Reserve(memory, &grid->changes.restepped, cells) &&
           kiriArray_Reserve(memory, &work->stepped, cells) && kiriArray_Reserve(memory, &grid->faces, 2 * cells) &&
           kiriArray_Reserve(memory, &grid->steps, OPEN_ALL * cells);
}

/* Before the first update ever, or after a reset. */
static bool StartFromScratch(kiriGrid* grid, const kiriMeshData* mesh)
{
    kiriGridWork* work = grid->work;
    int32_t squareCount = mesh->squares.columns * mesh->squares.rows;
    if (!kiriArray_Resize(mesh->memory, &grid->squareCell, squareCount) ||
        !kiriArray_Resize(mesh->memory, &grid->whole, squareCount) ||
        !kiriArray_Resize(mesh->memory, &work->squareFlags, squareCount) ||
        !kiriArray_Resize(mesh->memory, &work->entries, squareCount)) {
        return false;
    }
    memset(grid->whole.data, 0, (size_t)squareCount);
    memset(work->squareFlags.data, 0, (size_t)squareCount);
    for (int32_t s = 0; s < squareCount; ++s) {
        grid->squareCell.data[s] = KIRI_NONE;
    }
    grid->side = mesh->step * mesh->squares.side;
    grid->freeCell = grid->freeFace = KIRI_NONE;
    return ReserveCells(grid, mesh);
}

static bool Start(kiriGrid* grid, const kiriMeshData* mesh)
{
    if (grid->work == NULL) {
        grid->work = kiriMemory_AllocZeroed(mesh->memory, sizeof(*grid->work));
    }
    if (grid->work == NULL) {
        return false;
    }
    grid->work->fromScratch = grid->squareCell.count == 0;
    grid->work->running = true;
    return (!grid->work->fromScratch || StartFromScratch(grid, mesh)) &&
           kiriArray_Reserve(mesh->memory, &grid->nodeCell, mesh->squares.nodes.capacity) &&
           kiriArray_Resize(mesh->memory, &grid->nodeCell, mesh->squares.nodes.count);
}

/* Forgets the update at hand. */
static void Rest(kiriGridWork* work)
{
    for (int32_t i = 0; i < work->flagged.count; ++i) {
        work->squareFlags.data[work->flagged.data[i]] = 0;
    }
    work->flagged.count = work->remade.count = work->relinked.count = work->stepped.count = work->knights.count = 0;
    work->node.count = work->parent.count = 0;
    work->stage = work->item = 0;
    work->running = work->removed = false;
}

kiriProgress kiriGrid_Update(kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota)
{
    if ((grid->work == NULL || !grid->work->running) && !Start(grid, mesh)) {
        return KIRI_FAILED;
    }
    kiriGridWork* work = grid->work;
    for (; work->stage < STAGES; ++work->stage, work->item = 0) {
        while (work->item < CountItems(work, mesh)) {
            if (!kiriQuota_Take(quota, 1)) {
                return KIRI_MORE;
            }
            if (!MakeItem(grid, mesh)) {
                return KIRI_FAILED;
            }
        }
    }
    if (work->removed) {
        ForgetGone(grid);
    }
    Rest(work);
    return KIRI_DONE;
}

void kiriGrid_ClearChanges(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    for (int32_t i = 0; i < changes->gone.count; ++i) {
        FreeCell(grid, changes->gone.data[i]);
    }
    for (int32_t i = 0; i < changes->restepped.count; ++i) {
        grid->work->cellFlags.data[changes->restepped.data[i]] = 0;
    }
    for (int32_t i = 0; i < changes->remade.count; ++i) {
        grid->work->cellFlags.data[changes->remade.data[i].cell] = 0;
    }
    changes->made.count = changes->gone.count = changes->restepped.count = changes->remade.count = 0;
}

void kiriGrid_Reset(kiriGrid* grid)
{
    kiriGridChanges* changes = &grid->changes;
    grid->cells.count = grid->runs.count = grid->steps.count = grid->faces.count = grid->squareCell.count = 0;
    grid->nodeCell.count = grid->whole.count = grid->cellCount = 0;
    changes->made.count = changes->gone.count = changes->restepped.count = changes->remade.count = 0;
    memset(&grid->stepRoom, 0, sizeof(grid->stepRoom));
    if (grid->work != NULL) {
        grid->work->cellFlags.count = grid->work->mark.count = 0;
        Rest(grid->work);
    }
}

/* ---- Questions --------------------------------------------------------------------------------------------------- */

/* Shell 1959; what is sorted already, as after an update from scratch, costs next to nothing. */
void kiriGrid_SortCells(const kiriGrid* grid, int32_t* cells, int32_t count)
{
    int32_t gap = 1;
    while (gap < count / 3) {
        gap = 3 * gap + 1;
    }
    for (; gap > 0; gap /= 3) {
        for (int32_t i = gap; i < count; ++i) {
            int32_t moving = cells[i], j = i;
            for (; j >= gap && kiriGrid_IsBefore(grid, moving, cells[j - gap]); j -= gap) {
                cells[j] = cells[j - gap];
            }
            cells[j] = moving;
        }
    }
}

int32_t kiriGrid_CellOf(const kiriGrid* grid, const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at)
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

kiriLatticePoint kiriGrid_Anchor(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
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

int32_t kiriGrid_CellAt(const kiriGrid* grid, const kiriMeshData* mesh, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(mesh, at);
    return triangle == KIRI_NONE ? KIRI_NONE : kiriGrid_CellOf(grid, mesh, triangle, at);
}

int32_t kiriGrid_CellAround(const kiriGrid* grid, const kiriMeshData* mesh, kiriLatticePoint at)
{
    int32_t square = kiriSquares_At(&mesh->squares, at);
    int32_t first = square == KIRI_NONE ? KIRI_NONE : grid->squareCell.data[square];
    if (first == KIRI_NONE || grid->cells.data[first].next == KIRI_NONE) {
        return first; /* there is no choice */
    }
    int32_t cell = kiriGrid_CellAt(grid, mesh, at);
    return cell == KIRI_NONE ? first : cell;
}
