#include "kiri_mesh_edit.h"

#include "../core/kiri_sort.h"

#include <string.h>

/* Half-edges keep their place in their triangle. */
static int32_t EdgeTo(const kiriKeep* triangles, int32_t h)
{
    int32_t triangle = h == KIRI_NONE ? KIRI_NONE : kiriKeep_To(triangles, h / 3);
    return triangle == KIRI_NONE ? KIRI_NONE : 3 * triangle + h % 3;
}

/* An open edge whose other side is not kept becomes one of the outline. Who a triangle was split from matters only
   until the cut is in force: see kiri_ownership.c. */
static void RenumberTriangle(kiriTriangle* t, const kiriKeep* triangles, const kiriKeep* vertices)
{
    for (int i = 0; i < 3; ++i) {
        t->vertex[i] = kiriKeep_To(vertices, t->vertex[i]);
        t->twin[i] = EdgeTo(triangles, t->twin[i]);
        t->marks &= t->twin[i] == KIRI_NONE ? ~(1 << i) : ~0;
    }
    t->parent = kiriKeep_To(triangles, t->parent);
}

/* ---- A part as a mesh of its own --------------------------------------------------------------------------------- */

enum { COPIED_AN_ITEM = 4, LISTED_AN_ITEM = 8 };

static bool StartPart(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshData* from, const kiriMeshPart* triangles,
                      const kiriMeshPart* vertices)
{
    memset(mesh, 0, sizeof(*mesh));
    mesh->memory = memory;
    mesh->origin = from->origin;
    mesh->step = from->step;
    mesh->revision = from->revision + 1;
    return kiriArray_Reserve(memory, &mesh->vertices, vertices->items.count) &&
           kiriArray_Reserve(memory, &mesh->triangles, triangles->items.count);
}

static bool CopyVertices(kiriMeshData* mesh, const kiriMeshData* from, const kiriMeshPart* triangles,
                         const kiriMeshPart* vertices, kiriQuota* quota)
{
    while (mesh->vertices.count < vertices->items.count) {
        int32_t k = mesh->vertices.count;
        if (k % COPIED_AN_ITEM == 0 && !kiriQuota_Take(quota, 1)) {
            return false;
        }
        kiriVertex vertex = from->vertices.data[vertices->items.data[k]];
        vertex.edge = EdgeTo(triangles->keep, vertex.edge);
        KIRI_ASSERT(vertex.edge != KIRI_NONE);
        vertex.stamp = 0;
        mesh->vertices.data[mesh->vertices.count++] = vertex;
    }
    return true;
}

static bool CopyTriangles(kiriMeshData* mesh, const kiriMeshData* from, const kiriMeshPart* triangles,
                          const kiriMeshPart* vertices, kiriQuota* quota)
{
    while (mesh->triangles.count < triangles->items.count) {
        int32_t k = mesh->triangles.count;
        if (k % COPIED_AN_ITEM == 0 && !kiriQuota_Take(quota, 1)) {
            return false;
        }
        kiriTriangle triangle = from->triangles.data[triangles->items.data[k]];
        RenumberTriangle(&triangle, triangles->keep, vertices->keep);
        triangle.marks &= KIRI_TRIANGLE_OPEN;
        mesh->triangles.data[mesh->triangles.count++] = triangle;
    }
    return true;
}

static int32_t DropRepeated(int32_t* sorted, int32_t count)
{
    int32_t left = 0;
    for (int32_t i = 0; i < count; ++i) {
        if (left == 0 || sorted[i] != sorted[left - 1]) {
            sorted[left++] = sorted[i];
        }
    }
    return left;
}

/* Those of the caller's triangles that the part has something of. */
static bool ListSources(kiriMeshData* mesh)
{
    int32_t count = mesh->triangles.count;
    int32_t* room = kiriMemory_Alloc(mesh->memory, (int64_t)sizeof(int32_t) * count);
    bool ok = room != NULL && kiriArray_Resize(mesh->memory, &mesh->sources, count);
    for (int32_t t = 0; ok && t < count; ++t) {
        mesh->sources.data[t] = mesh->triangles.data[t].source;
    }
    if (ok) {
        kiriSort_Numbers(mesh->sources.data, room, count);
        mesh->sources.count = DropRepeated(mesh->sources.data, count);
    }
    kiriMemory_Free(mesh->memory, room);
    return ok;
}

static kiriProgress CopySources(kiriMeshData* mesh, const kiriMeshData* from, kiriQuota* quota)
{
    if (mesh->sources.count > 0) {
        return KIRI_DONE;
    }
    if (!kiriQuota_Take(quota, mesh->triangles.count / COPIED_AN_ITEM)) {
        return KIRI_MORE;
    }
    if (!ListSources(mesh) ||
        !kiriArray_ResizeJust(mesh->memory, &mesh->sourceCorners, 3 * (int64_t)mesh->sources.count)) {
        return KIRI_FAILED;
    }
    for (int32_t k = 0; k < mesh->sources.count; ++k) {
        kiriMesh_SourceCorners(from, mesh->sources.data[k], &mesh->sourceCorners.data[3 * (size_t)k]);
    }
    return KIRI_DONE;
}

static bool StartSquares(kiriMeshData* mesh, const kiriMeshData* from)
{
    kiriLatticePoint lower = mesh->vertices.data[0].at, upper = lower;
    for (int32_t v = 1; v < mesh->vertices.count; ++v) {
        kiriLatticePoint at = mesh->vertices.data[v].at;
        lower.x = kiriMin(at.x, lower.x);
        lower.y = kiriMin(at.y, lower.y);
        upper.x = kiriMax(at.x, upper.x);
        upper.y = kiriMax(at.y, upper.y);
    }
    return kiriSquares_InitPart(&mesh->squares, mesh->memory, &from->squares, lower, upper);
}

/* Until kiriMesh_Begin the old counts say how many triangles and vertices are in their squares. */
static kiriProgress FillSquaresOfPart(kiriMeshData* mesh, const kiriMeshData* from, kiriQuota* quota)
{
    if (mesh->squares.columns == 0 && !StartSquares(mesh, from)) {
        return KIRI_FAILED;
    }
    for (; mesh->oldTriangleCount < mesh->triangles.count; ++mesh->oldTriangleCount) {
        kiriLatticePoint corners[3];
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        kiriMesh_Corners(mesh, mesh->oldTriangleCount, corners);
        if (!kiriSquares_Insert(&mesh->squares, mesh->memory, mesh->oldTriangleCount, corners)) {
            return KIRI_FAILED;
        }
    }
    for (; mesh->oldVertexCount < mesh->vertices.count; ++mesh->oldVertexCount) {
        if (mesh->oldVertexCount % LISTED_AN_ITEM == 0 && !kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        kiriMesh_ListVertex(mesh, mesh->oldVertexCount);
    }
    return KIRI_DONE;
}

kiriProgress kiriMesh_MakePart(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshData* from,
                               const kiriMeshPart* triangles, const kiriMeshPart* vertices, kiriQuota* quota)
{
    KIRI_ASSERT(!mesh->isOpen);
    if (mesh->memory == NULL && !StartPart(mesh, memory, from, triangles, vertices)) {
        return KIRI_FAILED;
    }
    if (!CopyVertices(mesh, from, triangles, vertices, quota) ||
        !CopyTriangles(mesh, from, triangles, vertices, quota)) {
        return KIRI_MORE;
    }
    kiriProgress progress = CopySources(mesh, from, quota);
    progress = progress == KIRI_DONE ? FillSquaresOfPart(mesh, from, quota) : progress;
    if (progress == KIRI_DONE) {
        kiriMesh_Begin(mesh);
    }
    return progress;
}

/* ---- What is left ------------------------------------------------------------------------------------------------ */

static void EndLoss(kiriMeshData* mesh)
{
    mesh->births.count = 0;
    mesh->oldTriangleCount = mesh->triangles.count;
    mesh->oldVertexCount = mesh->vertices.count;
    mesh->revision += 1;
}

void kiriMesh_Keep(kiriMeshData* mesh, const kiriKeep* triangles, const kiriKeep* vertices, const int32_t* squares,
                   int32_t squareCount)
{
    KIRI_ASSERT(!mesh->isOpen && mesh->savedTriangles.count == 0);
    int32_t originals = 0;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        if (kiriKeep_Has(triangles, t)) {
            RenumberTriangle(&mesh->triangles.data[t], triangles, vertices);
            originals += t < mesh->originals;
        }
    }
    mesh->originals = originals;
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        mesh->vertices.data[v].edge = EdgeTo(triangles, mesh->vertices.data[v].edge);
    }
    kiriKeep_Relink(vertices, mesh->squares.vertexHead, mesh->squares.columns * mesh->squares.rows,
                    &mesh->vertices.data[0].next, sizeof(kiriVertex));
    kiriSquares_Keep(&mesh->squares, triangles, squares, squareCount);
    kiriKeep_Compact(triangles, &mesh->triangles, 1, sizeof(kiriTriangle));
    kiriKeep_Compact(vertices, &mesh->vertices, 1, sizeof(kiriVertex));
    mesh->triangleHoles = mesh->vertexHoles = 0;
    EndLoss(mesh);
}

/* ---- With holes -------------------------------------------------------------------------------------------------- */

/* What is left beside a triangle that goes ends there. Only an edge that is open may have it beside it. */
static void LeaveNeighbours(kiriMeshData* mesh, const kiriMeshLoss* loss, int32_t triangle)
{
    const kiriTriangle* t = &mesh->triangles.data[triangle];
    for (int i = 0; i < 3; ++i) {
        int32_t twin = t->marks & 1 << i ? t->twin[i] : KIRI_NONE;
        if (twin != KIRI_NONE && kiriKeep_Has(&loss->keepTriangles, twin / 3)) {
            kiriTriangle* beside = &mesh->triangles.data[twin / 3];
            beside->twin[twin % 3] = KIRI_NONE;
            beside->marks &= ~(1 << (twin % 3));
        }
    }
}

static void UnlistVertices(kiriMeshData* mesh, const kiriKeep* keep, int32_t square)
{
    int32_t* link = &mesh->squares.vertexHead[square];
    while (*link != KIRI_NONE) {
        kiriVertex* vertex = &mesh->vertices.data[*link];
        if (kiriKeep_Has(keep, *link)) {
            link = &vertex->next;
        } else {
            *link = vertex->next;
        }
    }
}

void kiriMesh_LeaveHoles(kiriMeshData* mesh, const kiriMeshLoss* loss)
{
    KIRI_ASSERT(!mesh->isOpen && mesh->savedTriangles.count == 0);
    for (int32_t k = 0; k < loss->squares->count; ++k) {
        UnlistVertices(mesh, &loss->keepVertices, loss->squares->data[k]);
    }
    kiriSquares_Keep(&mesh->squares, &loss->keepTriangles, loss->squares->data, loss->squares->count);
    for (int32_t k = 0; k < loss->triangles->count; ++k) {
        LeaveNeighbours(mesh, loss, loss->triangles->data[k]);
        kiriTriangle* t = &mesh->triangles.data[loss->triangles->data[k]];
        *t = (kiriTriangle){
            { KIRI_NONE, KIRI_NONE, KIRI_NONE }, { KIRI_NONE, KIRI_NONE, KIRI_NONE }, t->source, KIRI_NONE, 0
        };
    }
    for (int32_t k = 0; k < loss->vertices->count; ++k) {
        mesh->vertices.data[loss->vertices->data[k]].edge = KIRI_NONE;
    }
    mesh->triangleHoles += loss->triangles->count;
    mesh->vertexHoles += loss->vertices->count;
    EndLoss(mesh);
}
