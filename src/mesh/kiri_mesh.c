#include "kiri_mesh.h"

#include <string.h>

/* ---- Making and changing ----------------------------------------------------------------------------------------- */

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
    t->marks = (t->marks & ~(1 << (h % 3))) | ((open ? 1 : 0) << (h % 3));
}

int32_t kiriMesh_AddTriangle(kiriMeshData* mesh, int32_t a, int32_t b, int32_t c, int32_t source, int32_t parent)
{
    KIRI_ASSERT(mesh->triangles.count < mesh->triangles.capacity);
    int32_t index = mesh->triangles.count++;
    kiriTriangle t = { { a, b, c }, { KIRI_NONE, KIRI_NONE, KIRI_NONE }, source, parent, 0 };
    mesh->triangles.data[index] = t;
    return index;
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

/* What lies farther out than four times the sheet's box stays as far out, and what is no number is there, too: bytes
   that were made up may say anything. */
static int32_t NearestEven(double x)
{
    const double most = (1 << 30) - 1;
    double half = 0.5 * x + 0.5;
    half = kiriMin(half, most);
    half = kiriMax(half, -most);
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
