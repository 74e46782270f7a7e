#include "kiri_mesh_check.h"

#include <string.h>

/* ---- Rules -------------------------------------------------------------------------------------------------------- */

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
    check->count[KIRI_OF_NODES] = mesh->squares.nodes.count;
}

/* ---- Lines and corners -------------------------------------------------------------------------------------------- */

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
        kiriLatticePoint corners[3];
        int32_t source = mesh->triangles.data[t].source;
        areFine = !kiriMesh_IsTriangle(mesh, t) ||
                  ((mesh->sources.count > 0 || source < most) && kiriMesh_SourceCorners(mesh, source, corners));
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

/* ---- Triangles ---------------------------------------------------------------------------------------------------- */

static bool IsHole(const kiriTriangle* triangle)
{
    bool isHole = triangle->marks == 0;
    for (int i = 0; i < 3; ++i) {
        isHole = isHole && triangle->vertex[i] == KIRI_NONE && triangle->twin[i] == KIRI_NONE;
    }
    return isHole;
}

static bool IsAtSamePlace(kiriLatticePoint a, kiriLatticePoint b)
{
    return a.x == b.x && a.y == b.y;
}

static kiriLatticePoint TailAt(const kiriMeshData* mesh, int32_t h)
{
    return mesh->vertices.data[kiriMesh_Tail(mesh, h)].at;
}

/* A half-edge and its twin are of one another; where they are closed they have the same vertices. */
static bool IsTwinSound(const kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    bool isOpen = kiriMesh_IsOpen(mesh, h);
    if (twin == KIRI_NONE) {
        return !isOpen;
    }
    return twin / 3 != h / 3 && kiriMesh_IsTriangle(mesh, twin / 3) && kiriMesh_Twin(mesh, twin) == h &&
           kiriMesh_IsOpen(mesh, twin) == isOpen && IsAtSamePlace(TailAt(mesh, h), TailAt(mesh, kiriEdge_Next(twin))) &&
           (isOpen || kiriMesh_Tail(mesh, h) == kiriMesh_Tail(mesh, kiriEdge_Next(twin)));
}

static bool IsSound(const kiriMeshData* mesh, int32_t t)
{
    const kiriTriangle* triangle = &mesh->triangles.data[t];
    if (triangle->parent >= t) {
        return false; /* it was split from an older one */
    }
    if (!kiriMesh_IsTriangle(mesh, t)) {
        return IsHole(triangle);
    }
    if (triangle->vertex[1] == KIRI_NONE || triangle->vertex[2] == KIRI_NONE) {
        return false;
    }
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, t, c);
    return kiriOrient(c[0], c[1], c[2]) > 0;
}

static bool AreTriangles(const kiriMeshData* mesh)
{
    bool areFine = true;
    int32_t holes = 0;
    for (int32_t t = 0; areFine && t < mesh->triangles.count; ++t) {
        areFine = IsSound(mesh, t);
        holes += !kiriMesh_IsTriangle(mesh, t);
    }
    for (int32_t h = 0; areFine && h < 3 * mesh->triangles.count; ++h) {
        areFine = !kiriMesh_IsTriangle(mesh, h / 3) || IsTwinSound(mesh, h);
    }
    return areFine && holes == mesh->triangleHoles && holes < mesh->triangles.count;
}

/* ---- Vertices ----------------------------------------------------------------------------------------------------- */

/* How many corners the fan of a vertex has. It ends, for each corner is followed by one, and follows one. */
static int32_t CountFan(const kiriMeshData* mesh, int32_t vertex)
{
    int32_t start = mesh->vertices.data[vertex].edge, count = 1, h;
    for (h = kiriMesh_CounterClockwise(mesh, start); h != KIRI_NONE && h != start;
         h = kiriMesh_CounterClockwise(mesh, h)) {
        ++count;
    }
    if (h == start) {
        return count;
    }
    for (h = kiriMesh_Clockwise(mesh, start); h != KIRI_NONE; h = kiriMesh_Clockwise(mesh, h)) {
        ++count;
    }
    return count;
}

static bool IsPlaced(const kiriMeshData* mesh, const kiriVertex* vertex)
{
    return vertex->at.x >= 0 && vertex->at.y >= 0 && vertex->at.x <= 2 * (int64_t)KIRI_LATTICE &&
           vertex->at.y <= 2 * (int64_t)KIRI_LATTICE && ((vertex->at.x | vertex->at.y) & 1) == 0 &&
           kiriSquares_At(&mesh->squares, vertex->at) != KIRI_NONE;
}

/* Before triangles, which ask where vertices are. */
static bool ArePlaces(const kiriMeshData* mesh)
{
    bool areFine = true;
    int32_t holes = 0;
    for (int32_t v = 0; areFine && v < mesh->vertices.count; ++v) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        areFine = IsPlaced(mesh, vertex);
        holes += !kiriMesh_IsVertex(mesh, v);
    }
    return areFine && holes == mesh->vertexHoles;
}

/* Each corner is in the fan of its vertex. */
static bool AreFans(const kiriMeshData* mesh)
{
    int64_t corners = 3 * ((int64_t)mesh->triangles.count - mesh->triangleHoles);
    bool areFine = true;
    for (int32_t v = 0; areFine && v < mesh->vertices.count; ++v) {
        int32_t edge = mesh->vertices.data[v].edge;
        areFine = edge == KIRI_NONE || (kiriMesh_IsTriangle(mesh, edge / 3) && kiriMesh_Tail(mesh, edge) == v);
        corners -= areFine && edge != KIRI_NONE ? CountFan(mesh, v) : 0;
    }
    return areFine && corners == 0;
}

/* ---- Squares ------------------------------------------------------------------------------------------------------ */

enum { FEW_SQUARES = 64 };

/* In which squares a triangle lies, of those in its box: bit k is the k-th, row by row. What was listed is taken out. */
typedef struct Overlaps {
    int32_t low, from, columns; /* row and column of the first, and how many columns */
    int32_t left;               /* where there are too many for bits: squares that were not listed yet */
    uint64_t bits;
} Overlaps;

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

/* The columns that a triangle overlaps in a row hang together, and with those of the row before: so it takes no longer than
   there are squares, however large the box is. */
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

/* How many squares the triangle overlaps. */
static int64_t FindOverlaps(const kiriSquares* squares, const kiriLatticePoint c[3], Overlaps* o)
{
    SquaresBox box = FindBox(squares, c);
    int64_t columns = box.to - box.from + 1, count = columns * (box.high - box.low + 1), found = 0;
    bool isFew = count <= FEW_SQUARES;
    *o = (Overlaps){ box.low, box.from, isFew ? (int32_t)columns : 0, 0, count == 1 };
    int32_t first = box.from, last = box.to;
    for (int32_t row = box.low; count > 1 && row <= box.high; ++row) {
        FindInRow(&box, row, &first, &last);
        found += last - first + 1;
        for (int32_t column = first; isFew && column <= last; ++column) {
            o->bits |= UINT64_C(1) << ((row - box.low) * columns + column - box.from);
        }
    }
    o->left = isFew ? 0 : (int32_t)found;
    return count == 1 ? 1 : found;
}

/* Null where memory is short; and where there are more than nodes, which are one for each. */
static Overlaps* FindAllOverlaps(kiriCheck* check, const kiriMeshData* mesh)
{
    Overlaps* all =
        (Overlaps*)(void*)kiriCheck_Bytes(check, (int64_t)sizeof(Overlaps) * check->count[KIRI_OF_TRIANGLES]);
    int64_t left = mesh->squares.nodes.count;
    for (int32_t t = 0; all != NULL && left >= 0 && t < mesh->triangles.count; ++t) {
        if (kiriMesh_IsTriangle(mesh, t)) {
            kiriLatticePoint c[3];
            kiriMesh_Corners(mesh, t, c);
            left -= FindOverlaps(&mesh->squares, c, &all[t]);
        }
    }
    if (!kiriCheck_That(check, left >= 0)) {
        kiriMemory_Free(&check->memory, all);
        return NULL;
    }
    return all;
}

/* Takes a square out; false where the triangle is not in it, or was listed there before. Squares come in their order. */
static bool TakeOverlap(const kiriMeshData* mesh, int32_t square, int32_t t, Overlaps* o)
{
    int32_t row = square / mesh->squares.columns - o->low, column = square % mesh->squares.columns - o->from;
    if (o->columns > 0) {
        int64_t bit = (int64_t)row * o->columns + column;
        bool isIn = row >= 0 && column >= 0 && column < o->columns && bit < FEW_SQUARES && (o->bits >> bit & 1) != 0;
        o->bits &= isIn ? ~(UINT64_C(1) << bit) : o->bits;
        return isIn;
    }
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, t, c);
    bool isNew = o->bits != (uint64_t)square + 1; /* the square that listed it last */
    o->bits = (uint64_t)square + 1;
    o->left -= 1;
    return isNew && kiriSquares_Overlap(&mesh->squares, square, c);
}

/* A square lists triangles that lie in it, each once. */
static bool ListsSquare(const kiriMeshData* mesh, int32_t square, Overlaps* overlaps)
{
    const kiriSquares* squares = &mesh->squares;
    bool isFine = true;
    for (int32_t n = squares->head[square]; isFine && n != KIRI_NONE; n = squares->nodes.data[n].next) {
        int32_t t = squares->nodes.data[n].triangle;
        isFine = t != KIRI_NONE && kiriMesh_IsTriangle(mesh, t) && TakeOverlap(mesh, square, t, &overlaps[t]);
    }
    return isFine;
}

/* And none is left out. */
static bool AreAllListed(const kiriMeshData* mesh, const Overlaps* overlaps)
{
    bool areListed = true;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        areListed &= overlaps[t].columns > 0 ? overlaps[t].bits == 0 : overlaps[t].left == 0;
    }
    return areListed;
}

/* Lists of nodes, one a square, and one of those that are free. */
static bool AreNodeLists(kiriCheck* check, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    kiriChains chains;
    bool areFine =
        kiriCheck_StartChains(check, &chains, &squares->nodes.data->next, sizeof(kiriSquareNode), squares->nodes.count);
    for (int64_t s = 0; areFine && s < check->count[KIRI_OF_SQUARES]; ++s) {
        areFine = kiriCheck_Chain(check, &chains, squares->head[s]);
    }
    areFine = areFine && kiriCheck_Chain(check, &chains, squares->freeNode) &&
              kiriCheck_That(check, chains.listed == squares->nodes.count);
    kiriMemory_Free(&check->memory, chains.seen);
    return areFine;
}

static bool AreSquareLists(kiriCheck* check, const kiriMeshData* mesh)
{
    if (!AreNodeLists(check, mesh)) {
        return false;
    }
    Overlaps* overlaps = FindAllOverlaps(check, mesh);
    bool areFine = overlaps != NULL;
    for (int32_t s = 0; areFine && s < check->count[KIRI_OF_SQUARES]; ++s) {
        areFine = ListsSquare(mesh, s, overlaps);
    }
    areFine = areFine && AreAllListed(mesh, overlaps);
    kiriMemory_Free(&check->memory, overlaps);
    return kiriCheck_That(check, areFine);
}

/* Each vertex is in the list of its square, later ones first. */
static bool AreVertexLists(kiriCheck* check, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int64_t listed = 0;
    bool areFine = true;
    for (int32_t s = 0; areFine && s < check->count[KIRI_OF_SQUARES]; ++s) {
        int32_t last = mesh->vertices.count;
        for (int32_t v = squares->vertexHead[s]; areFine && v != KIRI_NONE; ++listed) {
            areFine = v >= 0 && v < last && kiriMesh_IsVertex(mesh, v) &&
                      kiriSquares_At(squares, mesh->vertices.data[v].at) == s;
            last = v;
            v = areFine ? mesh->vertices.data[v].next : KIRI_NONE;
        }
    }
    return kiriCheck_That(check, areFine && listed == mesh->vertices.count - mesh->vertexHoles);
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

/* The source of a vertex is that of a triangle around it: so a part has its corners. */
static bool AreSourcesOfTriangles(const kiriMeshData* mesh, kiriCheck* check)
{
    uint8_t* has = kiriCheck_Bytes(check, mesh->vertices.count);
    bool areFine = has != NULL;
    for (int32_t c = 0; areFine && c < 3 * mesh->triangles.count; ++c) {
        const kiriTriangle* triangle = &mesh->triangles.data[c / 3];
        if (kiriMesh_IsTriangle(mesh, c / 3)) {
            int32_t v = triangle->vertex[c % 3];
            has[v] |= mesh->vertices.data[v].source == triangle->source;
        }
    }
    for (int32_t v = 0; areFine && v < mesh->vertices.count; ++v) {
        areFine = has[v] || !kiriMesh_IsVertex(mesh, v);
    }
    kiriMemory_Free(&check->memory, has);
    return kiriCheck_That(check, areFine);
}

/* In an order in which each trusts what those before have seen. */
bool kiriMesh_Check(const kiriMeshData* mesh, kiriCheck* check)
{
    return kiriCheck_That(check, AreSquares(&mesh->squares) && IsClosed(mesh)) &&
           kiriCheck_Object(check, MeshMust, mesh) && kiriCheck_That(check, mesh->step > 0.0) &&
           kiriCheck_That(check, AreSourceCorners(mesh) && AreOriginals(mesh) && ArePlaces(mesh) &&
                                     AreTriangles(mesh) && AreSourcesThere(mesh) && AreFans(mesh)) &&
           AreSourcesOfTriangles(mesh, check) && AreSquareLists(check, mesh) && AreVertexLists(check, mesh) &&
           AreDirty(check, mesh);
}
