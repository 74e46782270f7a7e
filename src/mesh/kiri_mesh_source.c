/* The caller's triangles, of which all others are parts: where their corners are. */
#include "kiri_mesh.h"

#include <string.h>

/* ---- Corners ----------------------------------------------------------------------------------------------------- */

/* In a list of ascending numbers, `stride` bytes apart: the first that is not below `number`. */
static int32_t FirstFrom(const int32_t* numbers, size_t stride, int32_t count, int32_t number)
{
    int32_t low;
    KIRI_SEARCH(low, 0, count, *(const int32_t*)(const void*)((const char*)numbers + stride * (size_t)middle) < number);
    return low;
}

/* The triangle that the caller gave, or what splits have left in its place; KIRI_NONE where it is gone. It has its
   number as long as none before it has gone. */
static int32_t FindOriginal(const kiriMeshData* mesh, int32_t source)
{
    const kiriTriangle* triangles = mesh->triangles.data;
    int32_t count = mesh->originals, t = source;
    if (t < 0 || count == 0) {
        return KIRI_NONE;
    }
    if (t >= count || triangles[t].source != source) {
        t = FirstFrom(&triangles->source, sizeof(kiriTriangle), count, source);
    }
    return t < count && triangles[t].source == source && kiriMesh_IsTriangle(mesh, t) ? t : KIRI_NONE;
}

/* Those of a triangle that is there, unless it has been split. */
static bool FindCorners(const kiriMeshData* mesh, int32_t source, kiriLatticePoint corners[3])
{
    int32_t t = FindOriginal(mesh, source);
    if (t != KIRI_NONE) {
        kiriMesh_Corners(mesh, t, corners);
    }
    return t != KIRI_NONE;
}

/* Where the corners are stored, or KIRI_NONE. */
static int64_t StoredAt(const kiriMeshData* mesh, int32_t source)
{
    if (mesh->sources.count > 0) {
        int32_t k = FirstFrom(mesh->sources.data, sizeof(int32_t), mesh->sources.count, source);
        return k < mesh->sources.count && mesh->sources.data[k] == source ? 3 * (int64_t)k : KIRI_NONE;
    }
    int32_t k = source >= 0 ? source / KIRI_SOURCES_A_BLOCK : KIRI_NONE;
    int32_t block = k >= 0 && k < mesh->sourceBlocks.count ? mesh->sourceBlocks.data[k] : KIRI_NONE;
    return block == KIRI_NONE ? KIRI_NONE : 3 * ((int64_t)block * KIRI_SOURCES_A_BLOCK + source % KIRI_SOURCES_A_BLOCK);
}

/* In a block, those that were gone when it was made are one point. */
bool kiriMesh_SourceCorners(const kiriMeshData* mesh, int32_t source, kiriLatticePoint corners[3])
{
    int64_t at = StoredAt(mesh, source);
    if (at == KIRI_NONE) {
        return FindCorners(mesh, source, corners);
    }
    memcpy(corners, &mesh->sourceCorners.data[at], 3 * sizeof(kiriLatticePoint));
    return corners[0].x != corners[1].x || corners[0].y != corners[1].y;
}

bool kiriMesh_HasSource(const kiriMeshData* mesh, int32_t triangle)
{
    int32_t source = mesh->triangles.data[triangle].source;
    kiriLatticePoint corners[3];
    return kiriMesh_SourceCorners(mesh, source, corners) &&
           (StoredAt(mesh, source) != KIRI_NONE || FindOriginal(mesh, source) == triangle);
}

/* ---- Blocks ------------------------------------------------------------------------------------------------------ */

bool kiriMesh_KeepSource(kiriMeshData* mesh, int32_t triangle)
{
    enum { BLOCK_CORNERS = 3 * KIRI_SOURCES_A_BLOCK };
    int32_t k = mesh->triangles.data[triangle].source / KIRI_SOURCES_A_BLOCK, count = mesh->sourceCorners.count;
    if (mesh->sources.count > 0 || mesh->sourceBlocks.data[k] != KIRI_NONE) {
        return true;
    }
    if (!kiriArray_Resize(mesh->memory, &mesh->sourceCorners, (int64_t)count + BLOCK_CORNERS)) {
        return false;
    }
    kiriLatticePoint* corners = &mesh->sourceCorners.data[count];
    memset(corners, 0, BLOCK_CORNERS * sizeof(*corners));
    for (int32_t i = 0; i < KIRI_SOURCES_A_BLOCK; ++i) {
        FindCorners(mesh, KIRI_SOURCES_A_BLOCK * k + i, corners + 3 * (ptrdiff_t)i);
    }
    mesh->sourceBlocks.data[k] = count / BLOCK_CORNERS;
    return true;
}

void kiriMesh_RollbackSources(kiriMeshData* mesh)
{
    for (int32_t i = 0; i < mesh->savedTriangles.count && mesh->sources.count == 0; ++i) {
        int32_t* block = &mesh->sourceBlocks.data[mesh->savedTriangles.data[i].was.source / KIRI_SOURCES_A_BLOCK];
        *block = 3 * KIRI_SOURCES_A_BLOCK * (int64_t)*block < mesh->oldSourceCorners ? *block : KIRI_NONE;
    }
    mesh->sourceCorners.count = mesh->oldSourceCorners;
}

/* ---- Shares ------------------------------------------------------------------------------------------------------ */

/* Shares on the nearest edge, for a point that rounding has put beside the triangle. Areas do not tell it where the
   triangle is a sliver. */
static void ShareNearestEdge(const kiriLatticePoint c[3], kiriLatticePoint at, double share[3])
{
    double nearest = 0.0;
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint a = c[i], b = c[(i + 1) % 3];
        double x = (double)b.x - a.x, y = (double)b.y - a.y, u = (double)at.x - a.x, v = (double)at.y - a.y;
        double along = (u * x + v * y) / (x * x + y * y);
        along = kiriClamp(along, 0.0, 1.0);
        double du = u - along * x, dv = v - along * y, distance = du * du + dv * dv;
        if (i == 0 || distance < nearest) {
            nearest = distance;
            share[i] = 1.0 - along;
            share[(i + 1) % 3] = along;
            share[(i + 2) % 3] = 0.0;
        }
    }
}

void kiriMesh_SetSource(kiriMeshData* mesh, int32_t vertex, int32_t source)
{
    KIRI_ASSERT(vertex >= 0 && vertex < mesh->vertices.count);
    mesh->vertices.data[vertex].source = source;
}

void kiriMesh_GetShare(const kiriMeshData* mesh, int32_t vertex, float to[3])
{
    kiriMesh_GetShareIn(mesh, vertex, mesh->vertices.data[vertex].source, to);
}

void kiriMesh_GetShareIn(const kiriMeshData* mesh, int32_t vertex, int32_t source, float to[3])
{
    const kiriVertex* v = &mesh->vertices.data[vertex];
    kiriLatticePoint c[3];
    bool isThere = kiriMesh_SourceCorners(mesh, source, c);
    KIRI_ASSERT(isThere);
    (void)isThere;
    double share[3], sum = 0.0;
    bool isInside = true;
    for (int i = 0; i < 3; ++i) {
        share[i] = (double)kiriOrient(c[(i + 1) % 3], c[(i + 2) % 3], v->at);
        isInside = isInside && share[i] >= 0.0;
        sum += share[i];
    }
    if (!isInside) {
        ShareNearestEdge(c, v->at, share);
        sum = 1.0;
    }
    for (int i = 0; i < 3; ++i) {
        to[i] = (float)(share[i] / sum);
    }
}
