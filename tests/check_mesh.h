/* What must hold for every mesh, checked without the code under test where that can be: used by the tests of the mesh
   and of cutting. */
#ifndef KIRI_TEST_CHECK_MESH_H
#define KIRI_TEST_CHECK_MESH_H

#include "mesh/kiri_mesh_edit.h"
#include "mesh_pieces.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

/* A rectangle of columns x rows squares, two triangles each, with diagonals in turn. */
typedef struct Rectangle {
    float* positions;
    int32_t* indices;
    int32_t vertexCount, triangleCount;
} Rectangle;

static inline Rectangle Rectangle_Make(int32_t columns, int32_t rows, float width, float height)
{
    Rectangle r;
    r.vertexCount = (columns + 1) * (rows + 1);
    r.triangleCount = 2 * columns * rows;
    r.positions = malloc((size_t)r.vertexCount * 2 * sizeof(float));
    r.indices = malloc((size_t)r.triangleCount * 3 * sizeof(int32_t));
    for (int32_t i = 0; i < r.vertexCount; ++i) {
        r.positions[2 * i] = width * (float)(i % (columns + 1)) / (float)columns;
        r.positions[2 * i + 1] = height * (float)(i / (columns + 1)) / (float)rows;
    }
    for (int32_t i = 0; i < columns * rows; ++i) {
        int32_t column = i % columns, row = i / columns, a = row * (columns + 1) + column;
        int32_t corner[4] = { a, a + 1, a + columns + 2, a + columns + 1 };
        int32_t turn = (column + row) % 2;
        const int order[6] = { 0, 1, 2, 0, 2, 3 };
        for (int k = 0; k < 6; ++k) {
            r.indices[6 * i + k] = corner[(order[k] + turn) % 4];
        }
    }
    return r;
}

static inline void Rectangle_Free(Rectangle* r)
{
    free(r->positions);
    free(r->indices);
}

/* The default memory. */
static inline kiriMemory* Heap(void)
{
    static kiriMemory heap;
    if (heap.alloc == NULL) {
        heap = kiriMemory_Make(NULL, NULL, NULL);
    }
    return &heap;
}

static inline void InitRectangle(kiriMeshData* mesh, int32_t columns, int32_t rows, float width, float height,
                                 int32_t resolution)
{
    Rectangle r = Rectangle_Make(columns, rows, width, height);
    const char* why = NULL;
    kiriResult result =
        kiriMesh_Init(mesh, Heap(), r.positions, r.vertexCount, r.indices, r.triangleCount, resolution, &why);
    Rectangle_Free(&r);
    assert_int_equal(result, KIRI_OK);
}

/* ---- Unions ------------------------------------------------------------------------------------------------------ */

static inline int32_t* Unions_Make(int32_t count)
{
    int32_t* parent = malloc((size_t)count * sizeof(int32_t));
    for (int32_t i = 0; i < count; ++i) {
        parent[i] = i;
    }
    return parent;
}

static inline int32_t Unions_Root(int32_t* parent, int32_t i)
{
    while (parent[i] != i) {
        i = parent[i] = parent[parent[i]];
    }
    return i;
}

static inline void Unions_Join(int32_t* parent, int32_t i, int32_t j)
{
    parent[Unions_Root(parent, i)] = Unions_Root(parent, j);
}

/* ---- Edges, sorted ----------------------------------------------------------------------------------------------- */

typedef struct SortedEdge {
    int64_t low, high; /* keys of its ends */
    int32_t h;
    int32_t forward; /* runs from low to high */
} SortedEdge;

static inline int CompareEdges(const void* a, const void* b)
{
    const SortedEdge* p = a;
    const SortedEdge* q = b;
    if (p->low != q->low) {
        return p->low < q->low ? -1 : 1;
    }
    if (p->high != q->high) {
        return p->high < q->high ? -1 : 1;
    }
    return p->h < q->h ? -1 : p->h > q->h;
}

static inline kiriLatticePoint TailAt(const kiriMeshData* mesh, int32_t h)
{
    return mesh->vertices.data[kiriMesh_Tail(mesh, h)].at;
}

/* By place, or by vertex id. */
static inline SortedEdge* SortEdges(const kiriMeshData* mesh, bool byPlace)
{
    int32_t count = 3 * mesh->triangles.count;
    SortedEdge* edges = malloc((size_t)count * sizeof(SortedEdge));
    for (int32_t h = 0; h < count; ++h) {
        int32_t g = kiriEdge_Next(h);
        kiriLatticePoint p = TailAt(mesh, h), q = TailAt(mesh, g);
        int64_t a = byPlace ? (int64_t)p.x * 4294967296 + p.y : kiriMesh_Tail(mesh, h);
        int64_t b = byPlace ? (int64_t)q.x * 4294967296 + q.y : kiriMesh_Tail(mesh, g);
        edges[h].low = a < b ? a : b;
        edges[h].high = a < b ? b : a;
        edges[h].forward = a < b;
        edges[h].h = h;
    }
    qsort(edges, (size_t)count, sizeof(SortedEdge), CompareEdges);
    return edges;
}

static inline bool SameEnds(const SortedEdge* a, const SortedEdge* b)
{
    return a->low == b->low && a->high == b->high;
}

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

/* Half-edges at the same two places are twins, at most two, in opposite directions, and agree about being open. */
static inline void CheckTwins(const kiriMeshData* mesh)
{
    int32_t count = 3 * mesh->triangles.count;
    SortedEdge* edges = SortEdges(mesh, true);
    for (int32_t i = 0; i < count; ++i) {
        int32_t h = edges[i].h, twin = kiriMesh_Twin(mesh, h);
        bool before = i > 0 && SameEnds(&edges[i - 1], &edges[i]);
        bool after = i + 1 < count && SameEnds(&edges[i + 1], &edges[i]);
        assert_false(before && after);
        assert_int_equal(twin, before ? edges[i - 1].h : after ? edges[i + 1].h : KIRI_NONE);
        if (before) {
            assert_int_not_equal(edges[i].forward, edges[i - 1].forward);
            assert_int_equal(kiriMesh_IsOpen(mesh, h), kiriMesh_IsOpen(mesh, twin));
        }
        assert_true(twin != KIRI_NONE || !kiriMesh_IsOpen(mesh, h));
    }
    free(edges);
}

/* Corners joined over closed edges are a fan: each has exactly one vertex, and each vertex exactly one fan. */
static inline void CheckFans(const kiriMeshData* mesh)
{
    int32_t count = 3 * mesh->triangles.count;
    int32_t* fan = Unions_Make(count);
    int32_t* rootOf = malloc((size_t)mesh->vertices.count * sizeof(int32_t));
    memset(rootOf, 0xff, (size_t)mesh->vertices.count * sizeof(int32_t));
    for (int32_t h = 0; h < count; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin != KIRI_NONE && !kiriMesh_IsOpen(mesh, h)) {
            Unions_Join(fan, h, kiriEdge_Next(twin));
        }
    }
    for (int32_t h = 0; h < count; ++h) {
        int32_t vertex = kiriMesh_Tail(mesh, h), root = Unions_Root(fan, h);
        assert_in_range(vertex, 0, mesh->vertices.count - 1);
        rootOf[vertex] = rootOf[vertex] == KIRI_NONE ? root : rootOf[vertex];
        assert_int_equal(rootOf[vertex], root);
    }
    int32_t fans = 0;
    for (int32_t h = 0; h < count; ++h) {
        fans += fan[h] == h ? 1 : 0;
    }
    assert_int_equal(fans, mesh->vertices.count);
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        assert_int_equal(kiriMesh_Tail(mesh, mesh->vertices.data[v].edge), v);
    }
    free(rootOf);
    free(fan);
}

/* Pieces against a flood over edges with the same two vertices. */
static inline int32_t CheckPieces(const kiriMeshData* mesh)
{
    int32_t count = mesh->triangles.count, next = 0;
    int32_t* flood = Unions_Make(count);
    int32_t* piece = malloc((size_t)count * sizeof(int32_t));
    int32_t* number = malloc((size_t)count * sizeof(int32_t));
    SortedEdge* edges = SortEdges(mesh, false);
    for (int32_t i = 1; i < 3 * count; ++i) {
        if (SameEnds(&edges[i - 1], &edges[i])) {
            Unions_Join(flood, edges[i - 1].h / 3, edges[i].h / 3);
        }
    }
    int32_t pieces = NumberPieces(mesh, piece);
    memset(number, 0xff, (size_t)count * sizeof(int32_t));
    for (int32_t t = 0; t < count; ++t) {
        int32_t root = Unions_Root(flood, t);
        number[root] = number[root] == KIRI_NONE ? next++ : number[root];
        assert_int_equal(piece[t], number[root]);
    }
    assert_int_equal(pieces, next);
    free(edges);
    free(number);
    free(piece);
    free(flood);
    return pieces;
}

/* Each square lists exactly the triangles that overlap it; the other nodes are free. */
static inline void CheckSquares(const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int32_t listed = 0, expected = 0, freeNodes = 0;
    int32_t* seen = malloc((size_t)mesh->triangles.count * sizeof(int32_t));
    memset(seen, 0xff, (size_t)mesh->triangles.count * sizeof(int32_t));
    for (int32_t s = 0; s < squares->columns * squares->rows; ++s) {
        for (int32_t i = squares->head[s]; i != KIRI_NONE; i = squares->nodes.data[i].next) {
            int32_t t = squares->nodes.data[i].triangle;
            kiriLatticePoint corners[3];
            assert_in_range(t, 0, mesh->triangles.count - 1);
            kiriMesh_Corners(mesh, t, corners);
            assert_true(seen[t] != s && kiriSquares_Overlap(squares, s, corners));
            seen[t] = s;
            ++listed;
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        int32_t low[2] = { INT32_MAX, INT32_MAX }, high[2] = { INT32_MIN, INT32_MIN };
        for (int i = 0; i < 3; ++i) {
            int32_t xy[2] = { (c[i].x + 1) / squares->side, (c[i].y + 1) / squares->side };
            for (int axis = 0; axis < 2; ++axis) {
                low[axis] = xy[axis] < low[axis] ? xy[axis] : low[axis];
                high[axis] = xy[axis] > high[axis] ? xy[axis] : high[axis];
            }
        }
        for (int32_t row = low[1]; row <= high[1]; ++row) {
            for (int32_t column = low[0]; column <= high[0]; ++column) {
                expected += kiriSquares_Overlap(squares, row * squares->columns + column, c) ? 1 : 0;
            }
        }
    }
    for (int32_t i = squares->freeNode; i != KIRI_NONE; i = squares->nodes.data[i].next) {
        assert_int_equal(squares->nodes.data[i].triangle, KIRI_NONE);
        ++freeNodes;
    }
    assert_int_equal(listed, expected);
    assert_int_equal(listed + freeNodes, squares->nodes.count);
    free(seen);
}

/* Each vertex is in the list of its square, and the dirty squares are marked, each once. */
static inline void CheckLists(const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    int32_t listed = 0, marked = 0;
    for (int32_t s = 0; s < squares->columns * squares->rows; ++s) {
        int32_t last = INT32_MAX;
        for (int32_t v = squares->vertexHead[s]; v != KIRI_NONE; v = mesh->vertices.data[v].next) {
            assert_in_range(v, 0, mesh->vertices.count - 1);
            assert_true(v < last);
            assert_int_equal(kiriSquares_At(squares, mesh->vertices.data[v].at), s);
            last = v;
            ++listed;
        }
        marked += squares->isDirty[s] ? 1 : 0;
    }
    for (int32_t i = 0; i < squares->dirty.count; ++i) {
        assert_true(squares->isDirty[squares->dirty.data[i]]);
    }
    assert_int_equal(listed, mesh->vertices.count);
    assert_int_equal(marked, squares->dirty.count);
}

/* The fan of a vertex has a part of the vertex's source triangle: a torn vertex takes nothing from the other lip. */
static inline void CheckSources(const kiriMeshData* mesh)
{
    char* found = calloc((size_t)mesh->vertices.count, 1);
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t v = kiriMesh_Tail(mesh, h);
        found[v] |= mesh->vertices.data[v].source == mesh->triangles.data[h / 3].source;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        assert_true(found[v]);
    }
    free(found);
}

/* Source and share give the vertex's place back; so do its parents, for those born since Begin. */
static inline void CheckProvenance(const kiriMeshData* mesh)
{
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        double x = 0.0, y = 0.0, sum = 0.0, size = 536870912.0;
        for (int i = 0; i < 3; ++i) {
            kiriLatticePoint c = mesh->sourceCorners.data[3 * (vertex->source - mesh->firstSource) + i];
            assert_true(vertex->share[i] >= 0.0f);
            x += (double)vertex->share[i] * c.x;
            y += (double)vertex->share[i] * c.y;
            sum += (double)vertex->share[i];
        }
        assert_true(fabs(sum - 1.0) < 2e-7);
        assert_true(fabs(x - vertex->at.x) < 3e-7 * size && fabs(y - vertex->at.y) < 3e-7 * size);
    }
    CheckSources(mesh);
    assert_int_equal(mesh->births.count, mesh->vertices.count - mesh->oldVertexCount);
    for (int32_t i = 0; i < mesh->births.count; ++i) {
        const kiriBirth* birth = &mesh->births.data[i];
        kiriLatticePoint at = mesh->vertices.data[mesh->oldVertexCount + i].at;
        double x = 0.0, y = 0.0;
        for (int k = 0; k < 3; ++k) {
            assert_true(birth->parent[k] < mesh->oldVertexCount + i);
            if (birth->parent[k] != KIRI_NONE) {
                x += birth->share[k] * mesh->vertices.data[birth->parent[k]].at.x;
                y += birth->share[k] * mesh->vertices.data[birth->parent[k]].at.y;
            }
        }
        assert_true(fabs(x - at.x) < 3.0 && fabs(y - at.y) < 3.0);
    }
}

/* Memory that fails at one chosen allocation, and counts what is not freed. */
typedef struct Meter {
    int32_t untilFailure; /* -1: never */
    int32_t live;
} Meter;

static inline void* MeterAlloc(void* user, int64_t bytes)
{
    Meter* meter = user;
    if (meter->untilFailure == 0) {
        return NULL;
    }
    meter->untilFailure -= meter->untilFailure > 0 ? 1 : 0;
    ++meter->live;
    return malloc((size_t)bytes);
}

static inline void MeterFree(void* user, void* pointer)
{
    --((Meter*)user)->live;
    free(pointer);
}

/* A copy to compare with. */
typedef struct Copy {
    kiriTriangle* triangles;
    kiriVertex* vertices;
    int32_t triangleCount, vertexCount;
    uint32_t revision;
} Copy;

static inline Copy Copy_Make(const kiriMeshData* mesh)
{
    size_t triangleBytes = (size_t)mesh->triangles.count * sizeof(kiriTriangle);
    size_t vertexBytes = (size_t)mesh->vertices.count * sizeof(kiriVertex);
    Copy copy = { malloc(triangleBytes), malloc(vertexBytes), mesh->triangles.count, mesh->vertices.count,
                  mesh->revision };
    memcpy(copy.triangles, mesh->triangles.data, triangleBytes);
    memcpy(copy.vertices, mesh->vertices.data, vertexBytes);
    return copy;
}

static inline bool Copy_Equals(const Copy* copy, const kiriMeshData* mesh)
{
    return copy->triangleCount == mesh->triangles.count && copy->vertexCount == mesh->vertices.count &&
           copy->revision == mesh->revision &&
           memcmp(copy->triangles, mesh->triangles.data, (size_t)copy->triangleCount * sizeof(kiriTriangle)) == 0 &&
           memcmp(copy->vertices, mesh->vertices.data, (size_t)copy->vertexCount * sizeof(kiriVertex)) == 0;
}

static inline void Copy_Free(Copy* copy)
{
    free(copy->triangles);
    free(copy->vertices);
}

/* The mesh and its squares, slot for slot. */
typedef struct Whole {
    Copy mesh;
    kiriSquares squares; /* its arrays are copies */
} Whole;

static inline void* CopyOf(const void* data, size_t bytes)
{
    void* copy = malloc(bytes + 1);
    return bytes > 0 ? memcpy(copy, data, bytes) : copy;
}

static inline Whole Whole_Make(const kiriMeshData* mesh)
{
    Whole whole = { Copy_Make(mesh), mesh->squares };
    kiriSquares* s = &whole.squares;
    size_t count = (size_t)s->columns * (size_t)s->rows;
    s->head = CopyOf(s->head, count * sizeof(int32_t));
    s->vertexHead = CopyOf(s->vertexHead, count * sizeof(int32_t));
    s->isDirty = CopyOf(s->isDirty, count);
    s->nodes.data = CopyOf(s->nodes.data, (size_t)s->nodes.count * sizeof(kiriSquareNode));
    s->dirty.data = CopyOf(s->dirty.data, (size_t)s->dirty.count * sizeof(int32_t));
    return whole;
}

static inline bool Whole_Equals(const Whole* whole, const kiriMeshData* mesh)
{
    const kiriSquares *a = &whole->squares, *b = &mesh->squares;
    size_t count = (size_t)a->columns * (size_t)a->rows;
    return Copy_Equals(&whole->mesh, mesh) && memcmp(a->head, b->head, count * sizeof(int32_t)) == 0 &&
           memcmp(a->vertexHead, b->vertexHead, count * sizeof(int32_t)) == 0 &&
           memcmp(a->isDirty, b->isDirty, count) == 0 && a->freeNode == b->freeNode &&
           a->nodes.count == b->nodes.count && a->dirty.count == b->dirty.count &&
           memcmp(a->nodes.data, b->nodes.data, (size_t)a->nodes.count * sizeof(kiriSquareNode)) == 0 &&
           memcmp(a->dirty.data, b->dirty.data, (size_t)a->dirty.count * sizeof(int32_t)) == 0;
}

static inline void Whole_Free(Whole* whole)
{
    Copy_Free(&whole->mesh);
    free(whole->squares.head);
    free(whole->squares.vertexHead);
    free(whole->squares.isDirty);
    free(whole->squares.nodes.data);
    free(whole->squares.dirty.data);
}

/* All of it. Returns the number of pieces. */
static inline int32_t CheckMesh(const kiriMeshData* mesh)
{
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        assert_true(kiriOrient(c[0], c[1], c[2]) > 0);
        assert_true(((c[0].x | c[0].y | c[1].x | c[1].y | c[2].x | c[2].y) & 1) == 0);
    }
    CheckTwins(mesh);
    CheckFans(mesh);
    CheckSquares(mesh);
    CheckLists(mesh);
    CheckProvenance(mesh);
    return CheckPieces(mesh);
}

#endif
