/* What must hold for every mesh, checked without the code under test where that can be: used by the tests of the mesh
   and of cutting. */
#ifndef KIRI_TEST_CHECK_MESH_H
#define KIRI_TEST_CHECK_MESH_H

#include "mesh_copy.h"
#include "mesh/kiri_mesh.h"
#include "mesh_pieces.h"
#include "support.h"
#include "validate.h"

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
    kiriFault why;
    kiriResult result = kiriMesh_Init(
        mesh, Heap(), &(kiriMeshInput){ r.positions, r.vertexCount, r.indices, r.triangleCount, resolution, 0.0 },
        &why);
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

/* All but the pieces. Where corners of a part lie in the middle of another part's side, edges that come to lie on each
   other by later splits have no twins: then the mesh does not conform. */
static inline void CheckConnections(const kiriMeshData* mesh, bool isConforming)
{
    const char* wrong = Validate_Mesh(mesh, isConforming);
    if (wrong != NULL) {
        fail_msg("%s", wrong);
    }
}

/* All of it. Returns the number of pieces. */
static inline int32_t CheckMesh(const kiriMeshData* mesh)
{
    CheckConnections(mesh, true);
    return CheckPieces(mesh);
}

#endif
