#include "kiri_solid.h"

#include <string.h>

typedef struct SolidArrays {
    float *positions, *normals, *restPositions;
    int32_t *indices, *sources;
    int32_t vertexCount, triangleCount;
} SolidArrays;

static int32_t SolidCorner(const kiriMeshData* mesh, int32_t t, int k)
{
    KIRI_ASSERT(t >= 0 && t < mesh->triangles.count);
    return mesh->triangles.data[t].vertex[k % 3];
}

static int32_t CountBorders(const kiriMeshData* mesh)
{
    int32_t count = 0;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        for (int k = 0; k < 3; ++k) {
            count += kiriMesh_IsTriangle(mesh, t) && kiriMesh_IsBorder(mesh, 3 * t + k);
        }
    }
    return count;
}

static bool Allocate(SolidArrays* to, kiriMemory* memory, int64_t vertices, int64_t triangles)
{
    const int64_t f = sizeof(float), n = sizeof(int32_t);
    to->positions = kiriMemory_Alloc(memory, 3 * f * vertices);
    to->normals = kiriMemory_Alloc(memory, 3 * f * vertices);
    to->restPositions = kiriMemory_Alloc(memory, 2 * f * vertices);
    to->sources = kiriMemory_Alloc(memory, n * vertices);
    to->indices = kiriMemory_Alloc(memory, 3 * n * triangles);
    if (to->positions != NULL && to->normals != NULL && to->restPositions != NULL && to->sources != NULL &&
        to->indices != NULL) {
        return true;
    }
    kiriMemory_Free(memory, to->positions);
    kiriMemory_Free(memory, to->normals);
    kiriMemory_Free(memory, to->restPositions);
    kiriMemory_Free(memory, to->sources);
    kiriMemory_Free(memory, to->indices);
    return false;
}

/* `above` m along the normal of the surface. */
static void AddSolidVertex(SolidArrays* to, const kiriSurface* surface, int32_t vertex, double above, kiriVec3 normal)
{
    int32_t n = to->vertexCount++;
    kiriVec3 out = kiriVec3_Load(&surface->normals.data[3 * vertex]);
    kiriVec3_Store(&to->positions[3 * n], kiriVec3_AddScaled(kiriSurface_At(surface, vertex), above, out));
    kiriVec3_Store(&to->normals[3 * n], normal);
    memcpy(&to->restPositions[2 * n], &surface->restPositions.data[2 * vertex], 2 * sizeof(float));
    to->sources[n] = vertex;
}

static void AddSolidTriangle(SolidArrays* to, int32_t a, int32_t b, int32_t c)
{
    const int32_t corners[3] = { a, b, c };
    memcpy(&to->indices[3 * (int64_t)to->triangleCount++], corners, sizeof(corners));
}

static void AddSides(SolidArrays* to, const kiriSurface* surface, double half)
{
    for (int side = 0; side < 2; ++side) {
        for (int32_t v = 0; v < surface->vertexCount; ++v) {
            kiriVec3 normal = kiriVec3_Load(&surface->normals.data[3 * v]);
            AddSolidVertex(to, surface, v, side == 0 ? half : -half, kiriVec3_Scale(side == 0 ? 1.0 : -1.0, normal));
        }
    }
    for (int side = 0; side < 2; ++side) {
        int32_t first = side * surface->vertexCount;
        for (int32_t t = 0; t < surface->triangleCount; ++t) {
            const int32_t* corners = &surface->indices.data[3 * (int64_t)t];
            AddSolidTriangle(to, first + corners[0], first + corners[1 + side], first + corners[2 - side]);
        }
    }
}

/* Four vertices of their own, so that it is flat and its edges are sharp. */
static void AddRim(SolidArrays* to, const kiriSurface* surface, int32_t a, int32_t b, double half)
{
    kiriVec3 along = kiriVec3_Sub(kiriSurface_At(surface, b), kiriSurface_At(surface, a));
    kiriVec3 up =
        kiriVec3_Add(kiriVec3_Load(&surface->normals.data[3 * a]), kiriVec3_Load(&surface->normals.data[3 * b]));
    kiriVec3 out = kiriVec3_Normalize(kiriVec3_Cross(along, up));
    int32_t first = to->vertexCount;
    AddSolidVertex(to, surface, a, half, out);
    AddSolidVertex(to, surface, b, half, out);
    AddSolidVertex(to, surface, a, -half, out);
    AddSolidVertex(to, surface, b, -half, out);
    AddSolidTriangle(to, first + 1, first, first + 2);
    AddSolidTriangle(to, first + 1, first + 2, first + 3);
}

bool kiriSolid_Build(kiriSolid* solid, kiriMemory* memory, const kiriSurface* surface, const kiriMeshData* mesh,
                     double thickness)
{
    int64_t borders = CountBorders(mesh);
    int64_t vertices = 2 * (int64_t)surface->vertexCount + 4 * borders;
    int64_t triangles = 2 * (int64_t)surface->triangleCount + 2 * borders;
    SolidArrays to = { NULL, NULL, NULL, NULL, NULL, 0, 0 };
    KIRI_ASSERT(mesh->triangles.count == surface->triangleCount);
    if (vertices > INT32_MAX || triangles > INT32_MAX / 3 || !Allocate(&to, memory, vertices, triangles)) {
        return false;
    }
    AddSides(&to, surface, 0.5 * thickness);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        for (int k = 0; k < 3; ++k) {
            if (kiriMesh_IsTriangle(mesh, t) && kiriMesh_IsBorder(mesh, 3 * t + k)) {
                AddRim(&to, surface, SolidCorner(mesh, t, k), SolidCorner(mesh, t, k + 1), 0.5 * thickness);
            }
        }
    }
    *solid = (kiriSolid){ to.positions, to.normals,     to.restPositions, to.indices,
                          to.sources,   to.vertexCount, to.triangleCount, 2 * surface->triangleCount };
    return true;
}
