/* Copies of a mesh, to compare with and to go back to. */
#ifndef KIRI_MESH_COPY_H
#define KIRI_MESH_COPY_H

#include "mesh/kiri_mesh.h"

#include <stdlib.h>
#include <string.h>

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
    kiriSquares squares;  /* its arrays are copies, */
    kiriMeshData sources; /* and those of sources */
} Whole;

static inline void* CopyOf(const void* data, size_t bytes)
{
    void* copy = malloc(bytes + 1);
    return bytes > 0 ? memcpy(copy, data, bytes) : copy;
}

static inline Whole Whole_Make(const kiriMeshData* mesh)
{
    Whole whole = { Copy_Make(mesh), mesh->squares, *mesh };
    kiriSquares* s = &whole.squares;
    size_t count = (size_t)s->columns * (size_t)s->rows;
    s->head = CopyOf(s->head, count * sizeof(int32_t));
    s->vertexHead = CopyOf(s->vertexHead, count * sizeof(int32_t));
    s->isDirty = CopyOf(s->isDirty, count);
    s->nodes.data = CopyOf(s->nodes.data, (size_t)s->nodes.count * sizeof(kiriSquareNode));
    s->dirty.data = CopyOf(s->dirty.data, (size_t)s->dirty.count * sizeof(int32_t));
    kiriMeshData* m = &whole.sources;
    m->sourceBlocks.data = CopyOf(m->sourceBlocks.data, (size_t)m->sourceBlocks.count * sizeof(int32_t));
    m->sourceCorners.data = CopyOf(m->sourceCorners.data, (size_t)m->sourceCorners.count * sizeof(kiriLatticePoint));
    return whole;
}

static inline bool SourcesEqual(const kiriMeshData* a, const kiriMeshData* b)
{
    return a->originals == b->originals && a->sourceBlocks.count == b->sourceBlocks.count &&
           a->sourceCorners.count == b->sourceCorners.count &&
           memcmp(a->sourceBlocks.data, b->sourceBlocks.data, (size_t)a->sourceBlocks.count * sizeof(int32_t)) == 0 &&
           (a->sourceCorners.count == 0 || memcmp(a->sourceCorners.data, b->sourceCorners.data,
                                                  (size_t)a->sourceCorners.count * sizeof(kiriLatticePoint)) == 0);
}

static inline bool Whole_Equals(const Whole* whole, const kiriMeshData* mesh)
{
    const kiriSquares *a = &whole->squares, *b = &mesh->squares;
    size_t count = (size_t)a->columns * (size_t)a->rows;
    return Copy_Equals(&whole->mesh, mesh) && SourcesEqual(&whole->sources, mesh) &&
           memcmp(a->head, b->head, count * sizeof(int32_t)) == 0 &&
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
    free(whole->sources.sourceBlocks.data);
    free(whole->sources.sourceCorners.data);
}

static inline void Whole_Write(const void* copy, void* array, size_t count, size_t itemBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    KIRI_ASSERT(count <= (size_t)header.capacity);
    if (count > 0) {
        memcpy(header.data, copy, count * itemBytes);
    }
    header.count = (int32_t)count;
    kiriArray_SetHeader(array, header);
}

/* The mesh is again what it was, without a journal. Who follows it finds all squares dirty. */
static inline void Whole_Restore(const Whole* whole, kiriMeshData* mesh)
{
    kiriSquares* squares = &mesh->squares;
    const kiriSquares* was = &whole->squares;
    size_t count = (size_t)was->columns * (size_t)was->rows;
    Whole_Write(whole->mesh.triangles, &mesh->triangles, (size_t)whole->mesh.triangleCount, sizeof(kiriTriangle));
    Whole_Write(whole->mesh.vertices, &mesh->vertices, (size_t)whole->mesh.vertexCount, sizeof(kiriVertex));
    Whole_Write(was->nodes.data, &squares->nodes, (size_t)was->nodes.count, sizeof(kiriSquareNode));
    Whole_Write(whole->sources.sourceBlocks.data, &mesh->sourceBlocks, (size_t)whole->sources.sourceBlocks.count,
                sizeof(int32_t));
    Whole_Write(whole->sources.sourceCorners.data, &mesh->sourceCorners, (size_t)whole->sources.sourceCorners.count,
                sizeof(kiriLatticePoint));
    memcpy(squares->head, was->head, count * sizeof(int32_t));
    memcpy(squares->vertexHead, was->vertexHead, count * sizeof(int32_t));
    squares->freeNode = was->freeNode;
    for (size_t square = 0; square < count; ++square) {
        squares->isDirty[square] = 1;
        squares->dirty.data[square] = (int32_t)square;
    }
    squares->dirty.count = (int32_t)count;
    mesh->revision = whole->mesh.revision;
    mesh->changedTriangles.count = mesh->changedVertices.count = mesh->births.count = 0;
    mesh->oldTriangleCount = mesh->triangles.count;
    mesh->oldVertexCount = mesh->vertices.count;
}

#endif
