#include "kiri_mesh_edit.h"

#include <string.h>

/* An open edge whose other side is not kept becomes one of the outline. */
static kiriTriangle PartOf(const kiriTriangle* was, const int32_t* triangleTo, const int32_t* vertexTo)
{
    kiriTriangle t = *was;
    t.stamp = 0;
    for (int i = 0; i < 3; ++i) {
        int32_t twin = was->twin[i] == KIRI_NONE ? KIRI_NONE : triangleTo[was->twin[i] / 3];
        t.vertex[i] = vertexTo[was->vertex[i]];
        t.twin[i] = twin == KIRI_NONE ? KIRI_NONE : 3 * twin + was->twin[i] % 3;
        t.open &= twin == KIRI_NONE ? ~(1 << i) : ~0;
    }
    return t;
}

static bool CopyPart(kiriMeshData* mesh, const kiriMeshData* from, const int32_t* triangleTo, const int32_t* vertexTo)
{
    bool ok = true;
    for (int32_t v = 0; ok && v < from->vertices.count; ++v) {
        kiriVertex vertex = from->vertices.data[v];
        if (vertexTo[v] != KIRI_NONE) {
            KIRI_ASSERT(vertexTo[v] == mesh->vertices.count && triangleTo[vertex.edge / 3] != KIRI_NONE);
            vertex.edge = 3 * triangleTo[vertex.edge / 3] + vertex.edge % 3;
            vertex.stamp = 0;
            ok = kiriArray_Push(mesh->memory, &mesh->vertices, vertex);
        }
    }
    for (int32_t t = 0; ok && t < from->triangles.count; ++t) {
        if (triangleTo[t] != KIRI_NONE) {
            KIRI_ASSERT(triangleTo[t] == mesh->triangles.count);
            kiriTriangle triangle = PartOf(&from->triangles.data[t], triangleTo, vertexTo);
            ok = kiriArray_Push(mesh->memory, &mesh->triangles, triangle);
        }
    }
    return ok;
}

/* Those of the caller's triangles that the part has something of, and those between. */
static bool CopySources(kiriMeshData* mesh, const kiriMeshData* from)
{
    int32_t first = INT32_MAX, last = 0;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        int32_t source = mesh->triangles.data[t].source;
        first = source < first ? source : first;
        last = source > last ? source : last;
    }
    int32_t count = 3 * (last - first + 1);
    mesh->firstSource = first;
    if (!kiriArray_Resize(mesh->memory, &mesh->sourceCorners, count)) {
        return false;
    }
    memcpy(mesh->sourceCorners.data, &from->sourceCorners.data[3 * (first - from->firstSource)],
           sizeof(kiriLatticePoint) * (size_t)count);
    return true;
}

bool kiriMesh_InitPart(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshData* from, const int32_t* triangleTo,
                       const int32_t* vertexTo)
{
    memset(mesh, 0, sizeof(*mesh));
    mesh->memory = memory;
    mesh->origin = from->origin;
    mesh->step = from->step;
    mesh->revision = from->revision + 1;
    if (!CopyPart(mesh, from, triangleTo, vertexTo) || !CopySources(mesh, from) ||
        !kiriSquares_InitLike(&mesh->squares, mesh->memory, &from->squares) ||
        !kiriMesh_FillSquares(mesh, &mesh->squares, mesh->memory)) {
        return false;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriMesh_ListVertex(mesh, v);
    }
    kiriMesh_Begin(mesh);
    return true;
}
