#include "kiri_mesh.h"

#include <string.h>

/* ---- Making and changing ------------------------------------------------------------------------------------------ */

void kiriMesh_Link(kiriMeshData* mesh, int32_t h, int32_t g)
{
    KIRI_ASSERT(h >= 0 && h / 3 < mesh->triangles.count && g >= KIRI_NONE && g / 3 < mesh->triangles.count);
    mesh->triangles.data[h / 3].twin[h % 3] = g;
    if (g != KIRI_NONE) {
        mesh->triangles.data[g / 3].twin[g % 3] = h;
    }
}

void kiriMesh_SetOpen(kiriMeshData* mesh, int32_t h, bool open)
{
    kiriTriangle* t = &mesh->triangles.data[h / 3];
    t->open = (t->open & ~(1 << (h % 3))) | ((open ? 1 : 0) << (h % 3));
}

int32_t kiriMesh_AddTriangle(kiriMeshData* mesh, int32_t a, int32_t b, int32_t c, int32_t source, int32_t parent)
{
    KIRI_ASSERT(mesh->triangles.count < mesh->triangles.capacity);
    int32_t index = mesh->triangles.count++;
    kiriTriangle t = { { a, b, c }, { KIRI_NONE, KIRI_NONE, KIRI_NONE }, source, parent, 0, 0 };
    mesh->triangles.data[index] = t;
    return index;
}

const kiriLatticePoint* kiriMesh_SourceCorners(const kiriMeshData* mesh, int32_t source)
{
    int32_t low = 0, high = mesh->sources.count;
    while (low < high) {
        int32_t middle = (low + high) / 2;
        if (mesh->sources.data[middle] < source) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    bool hasAll = mesh->sources.count == 0;
    bool isThere = hasAll ? source >= 0 && source < mesh->sourceCorners.count / 3
                          : low < mesh->sources.count && mesh->sources.data[low] == source;
    return isThere ? &mesh->sourceCorners.data[3 * (int64_t)(hasAll ? source : low)] : NULL;
}

/* Rounding to the lattice may have put the vertex a step outside. */
/* Shares on the nearest edge, for a point that rounding has put beside the triangle. Areas do not tell it where the
   triangle is a sliver. */
static void ShareNearestEdge(const kiriLatticePoint c[3], kiriLatticePoint at, double share[3])
{
    double nearest = 0.0;
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint a = c[i], b = c[(i + 1) % 3];
        double x = (double)b.x - a.x, y = (double)b.y - a.y, u = (double)at.x - a.x, v = (double)at.y - a.y;
        double along = (u * x + v * y) / (x * x + y * y);
        along = along < 0.0 ? 0.0 : along > 1.0 ? 1.0 : along;
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
    KIRI_ASSERT(kiriMesh_SourceCorners(mesh, source) != NULL && vertex >= 0 && vertex < mesh->vertices.count);
    mesh->vertices.data[vertex].source = source;
}

void kiriMesh_GetShare(const kiriMeshData* mesh, int32_t vertex, float to[3])
{
    const kiriVertex* v = &mesh->vertices.data[vertex];
    const kiriLatticePoint* c = kiriMesh_SourceCorners(mesh, v->source);
    KIRI_ASSERT(c != NULL);
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

void kiriMesh_ListVertex(kiriMeshData* mesh, int32_t vertex)
{
    kiriVertex* v = &mesh->vertices.data[vertex];
    int32_t square = kiriSquares_At(&mesh->squares, v->at);
    KIRI_ASSERT(square != KIRI_NONE);
    int32_t* head = &mesh->squares.vertexHead[square];
    v->next = *head;
    *head = vertex;
}

bool kiriMesh_FillSquares(const kiriMeshData* mesh, kiriSquares* squares, kiriMemory* memory)
{
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        kiriLatticePoint corners[3];
        kiriMesh_Corners(mesh, t, corners);
        if (!kiriSquares_Insert(squares, memory, t, corners)) {
            return false;
        }
    }
    return true;
}

/* ---- Questions --------------------------------------------------------------------------------------------------- */

int32_t kiriMesh_Locate(const kiriMeshData* mesh, kiriLatticePoint at)
{
    int32_t square = kiriSquares_At(&mesh->squares, at), found = KIRI_NONE;
    int32_t slot = square == KIRI_NONE ? KIRI_NONE : mesh->squares.head[square];
    for (; slot != KIRI_NONE; slot = mesh->squares.nodes.data[slot].next) {
        int32_t t = mesh->squares.nodes.data[slot].triangle;
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        if ((found == KIRI_NONE || t < found) && kiriOrient(c[0], c[1], at) >= 0 && kiriOrient(c[1], c[2], at) >= 0 &&
            kiriOrient(c[2], c[0], at) >= 0) {
            found = t;
        }
    }
    return found;
}

int64_t kiriMesh_DoubledArea(const kiriMeshData* mesh)
{
    int64_t sum = 0;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        if (kiriMesh_IsTriangle(mesh, t)) {
            kiriLatticePoint c[3];
            kiriMesh_Corners(mesh, t, c);
            sum += kiriOrient(c[0], c[1], c[2]);
        }
    }
    return sum;
}

double kiriMesh_Area(const kiriMeshData* mesh)
{
    return 0.5 * (double)kiriMesh_DoubledArea(mesh) * mesh->step * mesh->step;
}

kiriVec2 kiriMesh_Direction(const kiriMeshData* mesh, int32_t from, int32_t to)
{
    kiriLatticePoint a = mesh->vertices.data[from].at, b = mesh->vertices.data[to].at;
    kiriVec2 way = kiriVec2_Make((double)b.x - a.x, (double)b.y - a.y);
    return kiriVec2_Scale(1.0 / kiriVec2_Length(way), way);
}

/* An eighth of the integral of the directions between the first and the last edge of the fan. */
kiriVec2 kiriMesh_Lean(const kiriMeshData* mesh, int32_t vertex)
{
    int32_t start = mesh->vertices.data[vertex].edge, first = start, last = start, h;
    while ((h = kiriMesh_Clockwise(mesh, first)) != KIRI_NONE && h != start) {
        first = h;
    }
    if (h == start) {
        return kiriVec2_Make(0.0, 0.0);
    }
    while ((h = kiriMesh_CounterClockwise(mesh, last)) != KIRI_NONE) {
        last = h;
    }
    kiriVec2 a = kiriMesh_Direction(mesh, vertex, kiriMesh_Tail(mesh, kiriEdge_Next(first)));
    kiriVec2 b = kiriMesh_Direction(mesh, vertex, kiriMesh_Tail(mesh, kiriEdge_Previous(last)));
    return kiriVec2_Make(0.125 * (b.y - a.y), 0.125 * (a.x - b.x));
}

/* What lies farther out than four times the sheet's box stays as far out: bytes that were made up may say anything. */
static int32_t NearestEven(double x)
{
    const double most = (1 << 30) - 1;
    double half = 0.5 * x + 0.5;
    half = half > most ? most : half < -most ? -most : half;
    int64_t floor = (int64_t)half;
    floor -= (double)floor > half ? 1 : 0;
    return (int32_t)(2 * floor);
}

kiriLatticePoint kiriMesh_Round(kiriVec2 lattice)
{
    kiriLatticePoint p = { NearestEven(lattice.x), NearestEven(lattice.y) };
    return p;
}

kiriLatticePoint kiriMesh_Snap(const kiriMeshData* mesh, kiriVec2 local)
{
    return kiriMesh_Round(kiriVec2_Make(local.x / mesh->step, local.y / mesh->step));
}
