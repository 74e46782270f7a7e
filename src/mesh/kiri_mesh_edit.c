#include "kiri_mesh_edit.h"

#include <string.h>

/* ---- The journal ------------------------------------------------------------------------------------------------- */

static bool SaveTriangle(kiriMeshData* mesh, int32_t triangle)
{
    KIRI_ASSERT(mesh->isOpen && triangle >= 0 && triangle < mesh->triangles.count);
    kiriTriangle* t = &mesh->triangles.data[triangle];
    if (triangle >= mesh->oldTriangleCount || (t->marks & KIRI_TRIANGLE_SAVED) != 0) {
        return true;
    }
    kiriSavedTriangle saved = { triangle, *t };
    if (!kiriArray_Push(mesh->memory, &mesh->savedTriangles, saved)) {
        return false;
    }
    t->marks |= KIRI_TRIANGLE_SAVED;
    return true;
}

static bool SaveVertex(kiriMeshData* mesh, int32_t vertex)
{
    KIRI_ASSERT(mesh->isOpen && vertex >= 0 && vertex < mesh->vertices.count);
    kiriVertex* v = &mesh->vertices.data[vertex];
    if (vertex >= mesh->oldVertexCount || v->stamp == mesh->stamp) {
        return true;
    }
    kiriSavedVertex saved = { vertex, *v };
    if (!kiriArray_Push(mesh->memory, &mesh->savedVertices, saved)) {
        return false;
    }
    v->stamp = mesh->stamp;
    return true;
}

static void EmptyJournal(kiriMeshData* mesh)
{
    for (int32_t i = 0; i < mesh->savedTriangles.count; ++i) {
        mesh->triangles.data[mesh->savedTriangles.data[i].index].marks &= ~KIRI_TRIANGLE_SAVED;
    }
    mesh->savedTriangles.count = 0;
    mesh->savedVertices.count = 0;
}

void kiriMesh_Begin(kiriMeshData* mesh)
{
    EmptyJournal(mesh);
    kiriSquares_Begin(&mesh->squares);
    mesh->isOpen = true;
    mesh->hasMet = false;
    ++mesh->stamp;
    mesh->oldTriangleCount = mesh->triangles.count;
    mesh->oldVertexCount = mesh->vertices.count;
    mesh->oldSourceCorners = mesh->sourceCorners.count;
    mesh->oldRevision = mesh->revision;
    mesh->births.count = 0;
}

void kiriMesh_Commit(kiriMeshData* mesh)
{
    EmptyJournal(mesh);
    kiriSquares_Commit(&mesh->squares);
    mesh->isOpen = false;
}

static bool InsertSquares(kiriMeshData* mesh, int32_t triangle)
{
    kiriLatticePoint corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    return kiriSquares_Insert(&mesh->squares, mesh->memory, triangle, corners);
}

/* The triangle is not as it was when its corners were these. */
static bool ReshapeInSquares(kiriMeshData* mesh, int32_t triangle, const kiriLatticePoint was[3])
{
    kiriLatticePoint is[3];
    kiriMesh_Corners(mesh, triangle, is);
    return kiriSquares_Reshape(&mesh->squares, mesh->memory, triangle, was, is);
}

void kiriMesh_Rollback(kiriMeshData* mesh)
{
    if (!mesh->isOpen) {
        return;
    }
    kiriSquares_Rollback(&mesh->squares);
    kiriMesh_RollbackSources(mesh);
    for (int32_t i = 0; i < mesh->savedVertices.count; ++i) {
        mesh->vertices.data[mesh->savedVertices.data[i].index] = mesh->savedVertices.data[i].was;
    }
    for (int32_t i = 0; i < mesh->savedTriangles.count; ++i) {
        mesh->triangles.data[mesh->savedTriangles.data[i].index] = mesh->savedTriangles.data[i].was;
    }
    for (int32_t v = mesh->vertices.count - 1; v >= mesh->oldVertexCount; --v) {
        const kiriVertex* vertex = &mesh->vertices.data[v];
        mesh->squares.vertexHead[kiriSquares_At(&mesh->squares, vertex->at)] = vertex->next;
    }
    mesh->triangles.count = mesh->oldTriangleCount;
    mesh->vertices.count = mesh->oldVertexCount;
    mesh->revision = mesh->oldRevision;
    mesh->births.count = 0;
    EmptyJournal(mesh);
}

/* ---- Changing the mesh ------------------------------------------------------------------------------------------- */

/* Half-edge h becomes half-edge g: its twin, its mark, and its tail's way to find it. */
static void MoveHalfEdge(kiriMeshData* mesh, int32_t h, int32_t g)
{
    kiriVertex* tail = &mesh->vertices.data[kiriMesh_Tail(mesh, g)];
    kiriMesh_SetOpen(mesh, g, kiriMesh_IsOpen(mesh, h));
    kiriMesh_Link(mesh, g, kiriMesh_Twin(mesh, h));
    kiriMesh_SetOpen(mesh, h, false);
    if (tail->edge == h) {
        tail->edge = g;
    }
}

/* Saves a triangle that is to be split. */
static bool SaveWhole(kiriMeshData* mesh, int32_t triangle)
{
    return SaveTriangle(mesh, triangle) && kiriMesh_KeepSource(mesh, triangle);
}

/* Saves what moving half-edge h to another triangle changes. */
static bool SaveHalfEdge(kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    return SaveVertex(mesh, kiriMesh_Tail(mesh, h)) && (twin == KIRI_NONE || SaveTriangle(mesh, twin / 3));
}

static bool ReserveSplit(kiriMeshData* mesh)
{
    int64_t vertices = (int64_t)mesh->vertices.count + 2, triangles = (int64_t)mesh->triangles.count + 2;
    return triangles <= KIRI_MOST_TRIANGLES && kiriArray_Reserve(mesh->memory, &mesh->vertices, vertices) &&
           kiriArray_Reserve(mesh->memory, &mesh->triangles, triangles) &&
           kiriArray_Reserve(mesh->memory, &mesh->births, (int64_t)mesh->births.count + 2);
}

/* Room for it is reserved. */
static int32_t AddVertex(kiriMeshData* mesh, kiriLatticePoint at, int32_t source, const kiriBirth* birth)
{
    KIRI_ASSERT(mesh->isOpen && mesh->vertices.count < mesh->vertices.capacity);
    KIRI_ASSERT(mesh->births.count == mesh->vertices.count - mesh->oldVertexCount);
    int32_t index = mesh->vertices.count++;
    kiriVertex* v = &mesh->vertices.data[index];
    memset(v, 0, sizeof(*v));
    v->at = at;
    v->edge = KIRI_NONE;
    kiriMesh_ListVertex(mesh, index);
    kiriMesh_SetSource(mesh, index, source);
    mesh->births.data[mesh->births.count++] = *birth;
    return index;
}

/* A new vertex on half-edge h, born of the two ends on its own side. */
static int32_t AddOnEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at)
{
    int32_t a = kiriMesh_Tail(mesh, h), b = kiriMesh_Tail(mesh, kiriEdge_Next(h));
    double toA = sqrt((double)kiriDistanceSquared(mesh->vertices.data[a].at, at));
    double toB = sqrt((double)kiriDistanceSquared(mesh->vertices.data[b].at, at));
    kiriBirth birth = { { a, b, KIRI_NONE }, { toB / (toA + toB), toA / (toA + toB), 0.0 } };
    return AddVertex(mesh, at, mesh->triangles.data[h / 3].source, &birth);
}

/* One side of a split edge: (a, b, c) with h from a to b becomes (a, p, c) and a new (p, b, c). Returns the half-edge
   from p to b. */
static int32_t SplitSide(kiriMeshData* mesh, int32_t h, int32_t p)
{
    int32_t next = kiriEdge_Next(h), b = kiriMesh_Tail(mesh, next), c = kiriMesh_Tail(mesh, kiriEdge_Previous(h));
    int32_t added = 3 * kiriMesh_AddTriangle(mesh, p, b, c, mesh->triangles.data[h / 3].source, h / 3);
    kiriMesh_SetOpen(mesh, added, kiriMesh_IsOpen(mesh, h));
    MoveHalfEdge(mesh, next, added + 1);
    mesh->triangles.data[next / 3].vertex[next % 3] = p;
    kiriMesh_Link(mesh, next, added + 2);
    mesh->vertices.data[p].edge = added;
    return added;
}

/* One side of a split edge: the triangle that it was, and the one that was added. */
static bool SideToSquares(kiriMeshData* mesh, int32_t h, const kiriLatticePoint was[3], int32_t added)
{
    return ReshapeInSquares(mesh, h / 3, was) && InsertSquares(mesh, added / 3);
}

int32_t kiriMesh_SplitEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at)
{
    KIRI_ASSERT(kiriMesh_CanSplitEdge(mesh, h, at));
    int32_t g = kiriMesh_Twin(mesh, h);
    if (!ReserveSplit(mesh) || !SaveWhole(mesh, h / 3) || !SaveHalfEdge(mesh, kiriEdge_Next(h)) ||
        (g != KIRI_NONE && (!SaveWhole(mesh, g / 3) || !SaveHalfEdge(mesh, kiriEdge_Next(g))))) {
        return KIRI_NONE;
    }
    kiriLatticePoint was[3], wasBeyond[3];
    kiriMesh_Corners(mesh, h / 3, was);
    ++mesh->revision;
    int32_t p = AddOnEdge(mesh, h, at);
    int32_t added = SplitSide(mesh, h, p);
    if (g == KIRI_NONE) {
        return SideToSquares(mesh, h, was, added) ? p : KIRI_NONE;
    }
    kiriMesh_Corners(mesh, g / 3, wasBeyond);
    int32_t q = kiriMesh_IsOpen(mesh, g) ? AddOnEdge(mesh, g, at) : p;
    int32_t addedBeyond = SplitSide(mesh, g, q);
    kiriMesh_Link(mesh, h, addedBeyond);
    kiriMesh_Link(mesh, added, g);
    return SideToSquares(mesh, h, was, added) && SideToSquares(mesh, g, wasBeyond, addedBeyond) ? p : KIRI_NONE;
}

static kiriBirth BirthInside(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, triangle, c);
    double area = (double)kiriOrient(c[0], c[1], c[2]);
    kiriBirth birth;
    for (int i = 0; i < 3; ++i) {
        birth.parent[i] = mesh->triangles.data[triangle].vertex[i];
        birth.share[i] = (double)kiriOrient(c[(i + 1) % 3], c[(i + 2) % 3], at) / area;
    }
    return birth;
}

int32_t kiriMesh_SplitTriangle(kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at)
{
    KIRI_ASSERT(kiriMesh_CanSplitTriangle(mesh, triangle, at));
    int32_t h = 3 * triangle;
    if (!ReserveSplit(mesh) || !SaveWhole(mesh, triangle) || !SaveHalfEdge(mesh, h + 1) || !SaveHalfEdge(mesh, h + 2)) {
        return KIRI_NONE;
    }
    kiriLatticePoint corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    ++mesh->revision;
    kiriTriangle was = mesh->triangles.data[triangle];
    kiriBirth birth = BirthInside(mesh, triangle, at);
    int32_t p = AddVertex(mesh, at, was.source, &birth);
    int32_t k = 3 * kiriMesh_AddTriangle(mesh, was.vertex[1], was.vertex[2], p, was.source, triangle);
    int32_t l = 3 * kiriMesh_AddTriangle(mesh, was.vertex[2], was.vertex[0], p, was.source, triangle);
    MoveHalfEdge(mesh, h + 1, k);
    MoveHalfEdge(mesh, h + 2, l);
    mesh->triangles.data[triangle].vertex[2] = p;
    mesh->vertices.data[p].edge = h + 2;
    kiriMesh_Link(mesh, h + 1, k + 2);
    kiriMesh_Link(mesh, k + 1, l + 2);
    kiriMesh_Link(mesh, l + 1, h + 2);
    return ReshapeInSquares(mesh, triangle, corners) && InsertSquares(mesh, k / 3) && InsertSquares(mesh, l / 3)
               ? p
               : KIRI_NONE;
}

bool kiriMesh_FlipEdge(kiriMeshData* mesh, int32_t h)
{
    KIRI_ASSERT(kiriMesh_CanFlipEdge(mesh, h));
    int32_t g = kiriMesh_Twin(mesh, h), nextH = kiriEdge_Next(h), nextG = kiriEdge_Next(g);
    if (!SaveWhole(mesh, h / 3) || !SaveWhole(mesh, g / 3) || !SaveHalfEdge(mesh, nextH) ||
        !SaveHalfEdge(mesh, nextG)) {
        return false;
    }
    kiriLatticePoint was[3], wasBeyond[3];
    kiriMesh_Corners(mesh, h / 3, was);
    kiriMesh_Corners(mesh, g / 3, wasBeyond);
    ++mesh->revision;
    int32_t c = kiriMesh_Tail(mesh, kiriEdge_Previous(h)), d = kiriMesh_Tail(mesh, kiriEdge_Previous(g));
    MoveHalfEdge(mesh, nextG, h);
    MoveHalfEdge(mesh, nextH, g);
    mesh->triangles.data[h / 3].vertex[nextH % 3] = d;
    mesh->triangles.data[g / 3].vertex[nextG % 3] = c;
    kiriMesh_Link(mesh, nextH, nextG);
    return ReshapeInSquares(mesh, h / 3, was) && ReshapeInSquares(mesh, g / 3, wasBeyond);
}

/* Half-edge h has just been opened: where that divides the fan at its tail, the part on its left gets a new vertex. */
static bool TearFan(kiriMeshData* mesh, int32_t h)
{
    int32_t old = kiriMesh_Tail(mesh, h), twin = kiriMesh_Twin(mesh, h), last = h;
    for (int32_t c = h; c != KIRI_NONE; c = kiriMesh_CounterClockwise(mesh, c)) {
        last = c;
        if (!SaveTriangle(mesh, c / 3)) {
            return false;
        }
    }
    if (kiriEdge_Previous(last) == twin) {
        return true; /* all around: the end of a cut */
    }
    if (!SaveVertex(mesh, old) || !ReserveSplit(mesh)) {
        return false;
    }
    kiriBirth birth = { { old, KIRI_NONE, KIRI_NONE }, { 1.0, 0.0, 0.0 } };
    int32_t torn = AddVertex(mesh, mesh->vertices.data[old].at, mesh->triangles.data[h / 3].source, &birth);
    for (int32_t c = h; c != KIRI_NONE; c = kiriMesh_CounterClockwise(mesh, c)) {
        mesh->triangles.data[c / 3].vertex[c % 3] = torn;
    }
    mesh->vertices.data[torn].edge = h;
    mesh->vertices.data[old].edge = kiriEdge_Next(twin);
    kiriMesh_SetSource(mesh, old, mesh->triangles.data[twin / 3].source);
    return true;
}

bool kiriMesh_Open(kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    if (twin == KIRI_NONE || kiriMesh_IsOpen(mesh, h)) {
        return true;
    }
    if (!SaveTriangle(mesh, h / 3) || !SaveTriangle(mesh, twin / 3)) {
        return false;
    }
    int32_t before = mesh->vertices.count;
    ++mesh->revision;
    kiriMesh_SetOpen(mesh, h, true);
    kiriMesh_SetOpen(mesh, twin, true);
    kiriSquares_MarkEdgeDirty(&mesh->squares, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                              mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at);
    bool ok = TearFan(mesh, h) && TearFan(mesh, twin);
    mesh->hasMet |= mesh->vertices.count == before + 2; /* both ends are torn */
    return ok;
}

static bool CanSplitSide(const kiriMeshData* mesh, int32_t h, kiriLatticePoint at)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, h / 3, c);
    kiriLatticePoint a = c[h % 3], b = c[(h + 1) % 3], apex = c[(h + 2) % 3];
    return kiriOrient(a, at, apex) > 0 && kiriOrient(at, b, apex) > 0;
}

bool kiriMesh_CanSplitEdge(const kiriMeshData* mesh, int32_t h, kiriLatticePoint at)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    return CanSplitSide(mesh, h, at) && (twin == KIRI_NONE || CanSplitSide(mesh, twin, at));
}

bool kiriMesh_CanSplitTriangle(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, triangle, c);
    return kiriOrient(c[0], c[1], at) > 0 && kiriOrient(c[1], c[2], at) > 0 && kiriOrient(c[2], c[0], at) > 0;
}

bool kiriMesh_CanFlipEdge(const kiriMeshData* mesh, int32_t h)
{
    int32_t g = kiriMesh_Twin(mesh, h);
    if (g == KIRI_NONE || kiriMesh_IsOpen(mesh, h) ||
        mesh->triangles.data[h / 3].source != mesh->triangles.data[g / 3].source) {
        return false;
    }
    kiriLatticePoint t[3], u[3];
    kiriMesh_Corners(mesh, h / 3, t);
    kiriMesh_Corners(mesh, g / 3, u);
    kiriLatticePoint a = t[h % 3], b = t[(h + 1) % 3], c = t[(h + 2) % 3], d = u[(g + 2) % 3];
    return kiriOrient(a, d, c) > 0 && kiriOrient(b, c, d) > 0;
}
