#include "kiri_mesh_check.h"

#include <string.h>

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static const kiriMust NodeMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_TRIANGLES, kiriSquareNode, triangle, triangle),
};

static const kiriMust TriangleMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_VERTICES, kiriTriangle, vertex, vertex),
    KIRI_INDEX_OR_NONE(KIRI_OF_HALF_EDGES, kiriTriangle, twin, twin),
    KIRI_INDEX_OR_NONE(KIRI_OF_TRIANGLES, kiriTriangle, parent, parent),
    KIRI_WITHIN(0, KIRI_TRIANGLE_OPEN, kiriTriangle, marks, marks),
};

static const kiriMust VertexMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_HALF_EDGES, kiriVertex, edge, edge),
    KIRI_INDEX_OR_NONE(KIRI_OF_VERTICES, kiriVertex, next, next),
};

static const kiriMust SourceCornerMust[] = {
    KIRI_WITHIN(0, KIRI_LATTICE, kiriLatticePoint, x, y),
};

static const kiriMust MeshMust[] = {
    KIRI_REALS(kiriMeshData, origin, step),
    KIRI_ITEMS_MUST(kiriMeshData, triangles, TriangleMust),
    KIRI_ITEMS_MUST(kiriMeshData, vertices, VertexMust),
    KIRI_ITEMS_MUST(kiriMeshData, squares.nodes, NodeMust),
    KIRI_ITEMS_MUST(kiriMeshData, sourceCorners, SourceCornerMust),
    KIRI_COUNTS(kiriMeshData, squares.effort, squares.effort),
};

void kiriMesh_Count(const kiriMeshData* mesh, kiriCheck* check)
{
    check->count[KIRI_OF_TRIANGLES] = mesh->triangles.count;
    check->count[KIRI_OF_HALF_EDGES] = 3 * (int64_t)mesh->triangles.count;
    check->count[KIRI_OF_VERTICES] = mesh->vertices.count;
    check->count[KIRI_OF_SQUARES] = (int64_t)mesh->squares.columns * mesh->squares.rows;
}

/* ---- Lines and corners ------------------------------------------------------------------------------------------- */

/* The far end of the last line is within what a lattice point may be. */
static bool AreLines(const kiriSquares* squares, int32_t first, int32_t count)
{
    return first >= 0 && count > 0 && ((int64_t)first + count) * squares->side <= (int64_t)KIRI_LATTICE * 2;
}

static bool AreSquares(const kiriSquares* squares)
{
    return squares->side > 0 && squares->side % 2 == 0 && squares->perStep == 1.0 / squares->side &&
           AreLines(squares, squares->firstColumn, squares->columns) &&
           AreLines(squares, squares->firstRow, squares->rows) && squares->dirty.capacity >= 0 &&
           squares->dirty.capacity >= (int64_t)squares->columns * squares->rows;
}

/* Blocks of corners, or those that a part lists. */
static bool AreSourceCorners(const kiriMeshData* mesh)
{
    int32_t count = mesh->sourceCorners.count / (3 * KIRI_SOURCES_A_BLOCK);
    bool areFine = mesh->sources.count > 0
                       ? 3 * (int64_t)mesh->sources.count == mesh->sourceCorners.count && mesh->sourceBlocks.count == 0
                       : mesh->sourceCorners.count % (3 * KIRI_SOURCES_A_BLOCK) == 0;
    for (int32_t k = 0; areFine && k < mesh->sourceBlocks.count; ++k) {
        areFine = mesh->sourceBlocks.data[k] >= KIRI_NONE && mesh->sourceBlocks.data[k] < count;
    }
    for (int32_t k = 0; areFine && k < mesh->sourceCorners.count; k += 3) {
        const kiriLatticePoint* c = &mesh->sourceCorners.data[k];
        bool isGone = (c[0].x | c[0].y | c[1].x | c[1].y | c[2].x | c[2].y) == 0;
        areFine = (isGone && mesh->sources.count == 0) || kiriOrient(c[0], c[1], c[2]) > 0;
    }
    return areFine;
}

/* The caller's triangles come first, each once. */
static bool AreOriginals(const kiriMeshData* mesh)
{
    bool areFine = mesh->originals >= 0 && mesh->originals <= mesh->triangles.count &&
                   (mesh->sources.count == 0 || mesh->originals == 0);
    for (int32_t t = 1; areFine && t < mesh->originals; ++t) {
        areFine = mesh->triangles.data[t - 1].source < mesh->triangles.data[t].source;
    }
    return areFine;
}

/* Of each triangle, and so of each vertex. */
static bool AreSourcesThere(const kiriMeshData* mesh)
{
    bool areFine = true;
    int64_t most = KIRI_SOURCES_A_BLOCK * (int64_t)mesh->sourceBlocks.count;
    for (int32_t t = 0; areFine && t < mesh->triangles.count; ++t) {
        bool isKnown = mesh->sources.count > 0 || mesh->triangles.data[t].source < most;
        areFine = isKnown && kiriMesh_HasSource(mesh, t);
    }
    return areFine;
}

/* Between ticks nothing is amid a change. */
static bool IsClosed(const kiriMeshData* mesh)
{
    return !mesh->isOpen && !mesh->squares.isOpen && mesh->savedTriangles.count == 0 &&
           mesh->savedVertices.count == 0 && mesh->squares.undo.count == 0 && mesh->triangles.count > 0 &&
           mesh->triangles.count <= KIRI_MOST_TRIANGLES && mesh->squares.nodes.count > 0;
}

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

/* The lattice points that are within some squares: lines are odd, and points even. */
typedef struct LatticeBox {
    kiriLatticePoint low, high;
} LatticeBox;

static LatticeBox BoxOfSquares(const kiriSquares* squares, int32_t row, int32_t column, int32_t rows, int32_t columns)
{
    int32_t side = squares->side, x = (squares->firstColumn + column) * side - 1,
            y = (squares->firstRow + row) * side - 1;
    return (LatticeBox){ { x, y }, { x + columns * side, y + rows * side } };
}

static bool IsWithin(const LatticeBox* box, kiriLatticePoint at)
{
    return at.x > box->low.x && at.x < box->high.x && at.y > box->low.y && at.y < box->high.y;
}

/* Checks where vertices are, before triangles need it. The link of each vertex leads to an earlier one:
   kiriKeep_Relink follows all of them. */
static bool ArePlaces(const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    LatticeBox box = BoxOfSquares(squares, 0, 0, squares->rows, squares->columns);
    bool areFine = true;
    for (int32_t v = 0; areFine && v < mesh->vertices.count; ++v) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        areFine = vertex->edge != KIRI_NONE && IsWithin(&box, vertex->at) &&
                  ((vertex->at.x | vertex->at.y) & 1) == 0 && vertex->next < v;
    }
    return areFine;
}

/* The vertices of a square, later ones first. Counts them, and writes where they are. */
static bool AreVerticesOf(const kiriMeshData* mesh, kiriSquarePlace at, kiriSquarePlace* in, int64_t* listed)
{
    const kiriSquares* squares = &mesh->squares;
    LatticeBox box = BoxOfSquares(squares, at.row, at.column, 1, 1);
    int32_t last = mesh->vertices.count;
    for (int32_t v = squares->vertexHead[at.row * squares->columns + at.column]; v != KIRI_NONE;
         v = mesh->vertices.data[v].next) {
        if (v < 0 || v >= last || !IsWithin(&box, mesh->vertices.data[v].at)) {
            return false;
        }
        in[v] = at;
        last = v;
        ++*listed;
    }
    return true;
}

/* Each vertex is in the list of its square. */
static bool AreVertexLists(const kiriMeshData* mesh, kiriSquarePlace* in)
{
    const kiriSquares* squares = &mesh->squares;
    kiriSquarePlace at = { 0, 0 };
    int64_t listed = 0;
    bool areFine = true;
    for (at.row = 0; areFine && at.row < squares->rows; ++at.row) {
        for (at.column = 0; areFine && at.column < squares->columns; ++at.column) {
            areFine = AreVerticesOf(mesh, at, in, &listed);
        }
    }
    return areFine && listed == mesh->vertices.count;
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

typedef struct SquaresBox {
    const kiriSquares* squares;
    const kiriLatticePoint* corners;
    int32_t low, high, from, to; /* rows and columns */
} SquaresBox;

static SquaresBox FindBox(const kiriSquares* squares, const kiriLatticePoint c[3])
{
    SquaresBox box = { squares, c, INT32_MAX, 0, INT32_MAX, 0 };
    for (int i = 0; i < 3; ++i) {
        int32_t square = kiriSquares_At(squares, c[i]), row = square / squares->columns,
                column = square % squares->columns;
        box.low = row < box.low ? row : box.low;
        box.high = row > box.high ? row : box.high;
        box.from = column < box.from ? column : box.from;
        box.to = column > box.to ? column : box.to;
    }
    return box;
}

static bool IsOverlap(const SquaresBox* box, int32_t row, int32_t column)
{
    return column >= box->from && column <= box->to &&
           kiriSquares_Overlap(box->squares, row * box->squares->columns + column, box->corners);
}

/* The columns that a triangle overlaps in a row hang together, and with those of the row before: so it takes no longer
   than there are squares, however large the box is. */
static void FindInRow(const SquaresBox* box, int32_t row, int32_t* first, int32_t* last)
{
    int32_t at = *first;
    while (at <= *last && !IsOverlap(box, row, at)) {
        ++at;
    }
    *first = *last = at;
    while (IsOverlap(box, row, *first - 1)) {
        --*first;
    }
    while (IsOverlap(box, row, *last + 1)) {
        ++*last;
    }
}

/* How many squares a triangle overlaps whose box is large. */
static int64_t CountOverlapsByRow(const kiriSquares* squares, const kiriLatticePoint c[3])
{
    SquaresBox box = FindBox(squares, c);
    int64_t found = 0;
    int32_t first = box.from, last = box.to;
    for (int32_t row = box.low; row <= box.high; ++row) {
        FindInRow(&box, row, &first, &last);
        found += last - first + 1;
    }
    return found;
}

/* Its corners are there, and counter-clockwise. Writes the squares that it overlaps, and takes their number from those
   that are left. */
static bool IsSound(const kiriMeshData* mesh, int32_t t, const kiriSquarePlace* in, kiriOverlaps* overlaps,
                    int64_t* left)
{
    const int32_t* vertex = mesh->triangles.data[t].vertex;
    if (vertex[0] == KIRI_NONE || vertex[1] == KIRI_NONE || vertex[2] == KIRI_NONE) {
        return false;
    }
    kiriLatticePoint c[3];
    const kiriSquarePlace cornersIn[3] = { in[vertex[0]], in[vertex[1]], in[vertex[2]] };
    kiriMesh_Corners(mesh, t, c);
    if (kiriOrient(c[0], c[1], c[2]) <= 0) {
        return false;
    }
    if (!kiriSquares_FindOverlaps(&mesh->squares, c, cornersIn, overlaps)) {
        int64_t found = CountOverlapsByRow(&mesh->squares, c);
        *left -= found;
        overlaps->left = (int32_t)found;
    }
    return *left >= 0;
}

/* Each was split from an older one. What large ones overlap is no more than there are nodes, which are one for each. */
static bool AreTriangles(const kiriMeshData* mesh, const kiriSquarePlace* in, kiriOverlaps* overlaps)
{
    int64_t left = mesh->squares.nodes.count;
    bool areFine = mesh->triangles.count > 0;
    for (int32_t t = 0; areFine && t < mesh->triangles.count; ++t) {
        areFine = mesh->triangles.data[t].parent < t && IsSound(mesh, t, in, &overlaps[t], &left);
    }
    return areFine;
}

/* ---- Fans -------------------------------------------------------------------------------------------------------- */

/* Corners of a vertex. */
typedef struct Fan {
    const kiriMeshData* mesh;
    int32_t vertex, source, count;
    bool isFine, hasSource; /* hasSource: that of the vertex is that of a triangle */
} Fan;

/* Of a triangle: where half-edge 3 `triangle` + `at` begins. */
typedef struct Corner {
    uint32_t triangle, at;
} Corner;

static Corner CornerOfHalfEdge(int32_t h)
{
    uint32_t t = (uint32_t)h / 3;
    return (Corner){ t, (uint32_t)h - 3 * t };
}

static bool IsAtPlaceOf(const kiriMeshData* mesh, int32_t v, int32_t w)
{
    kiriLatticePoint a = mesh->vertices.data[v].at;
    return w != KIRI_NONE && a.x == mesh->vertices.data[w].at.x && a.y == mesh->vertices.data[w].at.y;
}

/* The half-edge that leads to a corner of the fan, and its twin, are of one another, and the twin begins where it ends,
   if it is closed at the same vertex. */
static inline bool IsTwin(const Fan* fan, Corner edge, Corner twin, uint32_t isOpen)
{
    const kiriTriangle* other = &fan->mesh->triangles.data[twin.triangle];
    int32_t vertex = other->vertex[twin.at];
    return other->twin[twin.at] == (int32_t)(3 * edge.triangle + edge.at) && twin.triangle != edge.triangle &&
           ((uint32_t)other->marks >> twin.at & 1) == isOpen &&
           (vertex == fan->vertex || (isOpen && IsAtPlaceOf(fan->mesh, fan->vertex, vertex)));
}

/* Takes a corner, and looks at the half-edge that leads to it: where all corners are taken, all half-edges were looked
   at. Moves on to the next corner, counter-clockwise; false where there is none. */
static inline bool TakeCorner(Fan* fan, Corner* corner)
{
    const kiriTriangle* triangle = &fan->mesh->triangles.data[corner->triangle];
    Corner before = { corner->triangle, corner->at == 0 ? 2 : corner->at - 1 };
    int32_t twin = triangle->twin[before.at];
    uint32_t isOpen = (uint32_t)triangle->marks >> before.at & 1;
    fan->hasSource |= triangle->source == fan->source;
    fan->count += 1;
    if (twin == KIRI_NONE) {
        fan->isFine = triangle->vertex[corner->at] == fan->vertex && !isOpen;
        return false;
    }
    Corner next = CornerOfHalfEdge(twin);
    fan->isFine = triangle->vertex[corner->at] == fan->vertex && IsTwin(fan, before, next, isOpen);
    *corner = next;
    return fan->isFine && !isOpen;
}

/* All corners from one on: each is followed by one, and follows one. So it ends: it does not come back but to the
   start. */
static void TakeFan(Fan* fan, int32_t start)
{
    const Corner first = CornerOfHalfEdge(start);
    Corner corner = first;
    bool isRound = false;
    while (!isRound && TakeCorner(fan, &corner)) {
        isRound = corner.triangle == first.triangle && corner.at == first.at;
    }
    for (int32_t h = isRound ? KIRI_NONE : start; fan->isFine && h != KIRI_NONE;) {
        const Corner after = CornerOfHalfEdge(h);
        h = kiriMesh_Clockwise(fan->mesh, h);
        if (h != KIRI_NONE) {
            corner = CornerOfHalfEdge(h);
            TakeCorner(fan, &corner);
            fan->isFine = fan->isFine && corner.triangle == after.triangle && corner.at == after.at;
        }
    }
}

/* Each corner is in the fan of its vertex. The source of a vertex is that of a triangle around it: so a part has its
   corners. */
static bool AreFans(const kiriMeshData* mesh)
{
    int32_t corners = 3 * mesh->triangles.count;
    bool areFine = true;
    for (int32_t v = 0; areFine && v < mesh->vertices.count; ++v) {
        Fan fan = { mesh, v, mesh->vertices.data[v].source, 0, true, false };
        TakeFan(&fan, mesh->vertices.data[v].edge);
        areFine = fan.isFine && fan.hasSource;
        corners -= fan.count;
    }
    return areFine && corners == 0;
}

/* ---- Squares ----------------------------------------------------------------------------------------------------- */

/* Where the box is large. Squares come in their order. */
static bool TakeFromLargeBox(const kiriMeshData* mesh, int32_t square, int32_t t, kiriOverlaps* o)
{
    bool isNew = o->left > 0 && o->bits != (uint64_t)square + 1; /* the square that listed it last */
    kiriLatticePoint c[3];
    if (!isNew) {
        return false;
    }
    kiriMesh_Corners(mesh, t, c);
    o->bits = (uint64_t)square + 1;
    o->left -= 1;
    return kiriSquares_Overlap(&mesh->squares, square, c);
}

/* Takes a square out; false where the triangle is not in it, or was listed there before. */
static bool TakeOverlap(const kiriMeshData* mesh, int32_t row, int32_t column, int32_t t, kiriOverlaps* o)
{
    if (o->columns == 0) {
        return TakeFromLargeBox(mesh, row * mesh->squares.columns + column, t, o);
    }
    uint32_t rows = (uint32_t)(row - o->row), columns = (uint32_t)(column - o->column);
    if (rows >= KIRI_FEW_SQUARES || columns >= (uint32_t)o->columns) {
        return false;
    }
    uint32_t k = rows * (uint32_t)o->columns + columns;
    uint64_t bit = k < KIRI_FEW_SQUARES ? UINT64_C(1) << k : 0;
    bool isIn = (o->bits & bit) != 0;
    o->bits &= ~bit;
    return isIn;
}

/* What lists of nodes have taken. */
typedef struct NodeLists {
    kiriChains chains;
    kiriOverlaps* overlaps;
} NodeLists;

/* A square lists triangles that lie in it, each once; and no other list has these nodes. */
static bool ListsSquare(const kiriMeshData* mesh, int32_t row, int32_t column, NodeLists* lists)
{
    const kiriSquares* squares = &mesh->squares;
    bool isFine = true;
    for (int32_t n = squares->head[row * squares->columns + column]; isFine && n != KIRI_NONE;
         n = squares->nodes.data[n].next) {
        if (!kiriChains_Take(&lists->chains, n)) {
            return false;
        }
        int32_t t = squares->nodes.data[n].triangle;
        isFine = t != KIRI_NONE && TakeOverlap(mesh, row, column, t, &lists->overlaps[t]);
    }
    return isFine;
}

/* And none is left out. */
static bool AreAllListed(const kiriMeshData* mesh, const kiriOverlaps* overlaps)
{
    bool areListed = true;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        areListed &= overlaps[t].columns > 0 ? overlaps[t].bits == 0 : overlaps[t].left == 0;
    }
    return areListed;
}

/* Lists of nodes, one a square, and one of those that are free. */
static bool AreSquareLists(kiriCheck* check, const kiriMeshData* mesh, kiriOverlaps* overlaps)
{
    const kiriSquares* squares = &mesh->squares;
    NodeLists lists;
    lists.overlaps = overlaps;
    bool areFine = kiriCheck_StartChains(check, &lists.chains, &squares->nodes.data->next, sizeof(kiriSquareNode),
                                         squares->nodes.count);
    for (int32_t row = 0; areFine && row < squares->rows; ++row) {
        for (int32_t column = 0; areFine && column < squares->columns; ++column) {
            areFine = ListsSquare(mesh, row, column, &lists);
        }
    }
    areFine = areFine && AreAllListed(mesh, overlaps) && kiriCheck_Chain(check, &lists.chains, squares->freeNode) &&
              lists.chains.listed == squares->nodes.count;
    kiriMemory_Free(&check->memory, lists.chains.seen);
    return kiriCheck_That(check, areFine);
}

/* What is in squares. */
static bool AreInSquares(kiriCheck* check, const kiriMeshData* mesh)
{
    int64_t vertices = mesh->vertices.count, triangles = mesh->triangles.count;
    kiriSquarePlace* in = (kiriSquarePlace*)(void*)kiriCheck_Bytes(check, (int64_t)sizeof(*in) * vertices);
    kiriOverlaps* overlaps = (kiriOverlaps*)(void*)kiriCheck_Bytes(check, (int64_t)sizeof(*overlaps) * triangles);
    bool areFine = in != NULL && overlaps != NULL &&
                   kiriCheck_That(check, AreVertexLists(mesh, in) && AreTriangles(mesh, in, overlaps)) &&
                   AreSquareLists(check, mesh, overlaps);
    kiriMemory_Free(&check->memory, overlaps);
    kiriMemory_Free(&check->memory, in);
    return areFine;
}

/* Dirty squares are marked, each once. */
static bool AreDirty(kiriCheck* check, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    kiriIndices dirty = { squares->dirty.data, squares->dirty.count, squares->dirty.capacity };
    int64_t marked = 0;
    if (!kiriCheck_Distinct(check, &dirty, check->count[KIRI_OF_SQUARES])) {
        return false;
    }
    for (int64_t s = 0; s < check->count[KIRI_OF_SQUARES]; ++s) {
        marked += squares->isDirty[s] != 0;
    }
    bool areFine = marked == dirty.count;
    for (int32_t k = 0; k < dirty.count; ++k) {
        areFine = areFine && squares->isDirty[dirty.data[k]];
    }
    return kiriCheck_That(check, areFine);
}

/* In an order in which each trusts what those before have seen. */
bool kiriMesh_Check(const kiriMeshData* mesh, kiriCheck* check)
{
    return kiriCheck_That(check, AreSquares(&mesh->squares) && IsClosed(mesh)) &&
           kiriCheck_Object(check, MeshMust, mesh) && kiriCheck_That(check, mesh->step > 0.0) &&
           kiriCheck_That(check, AreSourceCorners(mesh) && AreOriginals(mesh) && ArePlaces(mesh)) &&
           AreInSquares(check, mesh) && kiriCheck_That(check, AreSourcesThere(mesh) && AreFans(mesh)) &&
           AreDirty(check, mesh);
}

/* One number a square. */
static int64_t CountSquares(const kiriSquares* squares)
{
    return (int64_t)squares->columns * squares->rows;
}

static void MoveHeads(kiriArchive* archive, void* object)
{
    kiriSquares* squares = object;
    kiriArchive_Expect(archive, squares->columns > 0 && squares->rows > 0 && CountSquares(squares) <= INT32_MAX &&
                                    squares->side > 0);
    kiriArchive_Block(archive, (void**)&squares->head, 4, CountSquares(squares));
    kiriArchive_Block(archive, (void**)&squares->vertexHead, 4, CountSquares(squares));
    kiriArchive_Block(archive, (void**)&squares->isDirty, 1, CountSquares(squares));
}

static const kiriMember SquaresMembers[] = {
    KIRI_RUN(4, kiriSquares, columns, side),
    KIRI_RUN(8, kiriSquares, perStep, perStep),
    KIRI_CUSTOM(kiriSquares, head, MoveHeads),
    KIRI_ITEMS(4, kiriSquares, nodes),
    KIRI_RUN(4, kiriSquares, freeNode, freeNode),
    KIRI_DROPPED(kiriSquares, vertexHead),
    KIRI_ITEMS(4, kiriSquares, dirty),
    KIRI_DROPPED(kiriSquares, isDirty),
    KIRI_RUN(8, kiriSquares, effort, effort),
    KIRI_BOOLS(kiriSquares, isOpen, isOpen),
    KIRI_ITEMS(4, kiriSquares, undo),
    KIRI_RUN(4, kiriSquares, oldNodeCount, oldDirtyCount),
};
static const kiriTable SquaresTable = KIRI_TABLE(kiriSquares, SquaresMembers);

static const kiriMember BirthMembers[] = {
    KIRI_RUN(4, kiriBirth, parent, parent),
    KIRI_RUN(8, kiriBirth, share, share),
};
static const kiriTable BirthTable = KIRI_TABLE(kiriBirth, BirthMembers);

static const kiriMember MeshDataMembers[] = {
    KIRI_DROPPED(kiriMeshData, memory),
    KIRI_RUN(8, kiriMeshData, origin, step),
    KIRI_ITEMS(4, kiriMeshData, triangles),
    KIRI_ITEMS(4, kiriMeshData, vertices),
    KIRI_PART(kiriMeshData, squares, SquaresTable),
    KIRI_RUN(4, kiriMeshData, revision, originals),
    KIRI_ITEMS(4, kiriMeshData, sourceBlocks),
    KIRI_ITEMS(4, kiriMeshData, sourceCorners),
    KIRI_ITEMS(4, kiriMeshData, sources),
    KIRI_BOOLS(kiriMeshData, isOpen, isOpen),
    KIRI_DROPPED(kiriMeshData, hasMet),
    KIRI_RUN(4, kiriMeshData, stamp, oldRevision),
    KIRI_ITEMS(4, kiriMeshData, savedTriangles),
    KIRI_ITEMS(4, kiriMeshData, savedVertices),
    KIRI_PARTS(kiriMeshData, births, BirthTable),
};
const kiriTable kiriMeshTable = KIRI_TABLE(kiriMeshData, MeshDataMembers);

void kiriMesh_EndReading(kiriMeshData* mesh, kiriMemory* memory)
{
    mesh->memory = memory;
}
