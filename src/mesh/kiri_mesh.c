#include "kiri_mesh.h"
#include "../core/kiri_array.h"

/* ---- Making and changing ----------------------------------------------------------------------------------------- */

void kiriMesh_Link(kiriMeshData* mesh, int32_t h, int32_t g)
{
    KIRI_ASSERT(h >= 0 && h / 3 < mesh->triangles.count && g >= KIRI_NONE && g / 3 < mesh->triangles.count);
    mesh->triangles.data[h / 3].twin[h % 3] = g;
    if (g != KIRI_NONE) {
        mesh->triangles.data[g / 3].twin[g % 3] = h;
    }
}

void kiriMesh_SetMarks(kiriMeshData* mesh, int32_t h, int32_t marks)
{
    KIRI_ASSERT(h >= 0 && h / 3 < mesh->triangles.count && (marks & ~KIRI_EDGE_CREASE) == 0);
    kiriTriangle* t = &mesh->triangles.data[h / 3];
    t->marks = (t->marks & ~(KIRI_EDGE_CREASE << h % 3)) | marks << h % 3;
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
    KIRI_EACH_INDEX(t, mesh->triangles) {
        kiriLatticePoint corners[3];
        kiriMesh_Corners(mesh, t, corners);
        if (!kiriSquares_Insert(squares, memory, t, corners)) {
            return false;
        }
    }
    kiriArray_Shorten(memory, &squares->nodes, sizeof(*squares->nodes.data));
    return true;
}

/* ---- Questions --------------------------------------------------------------------------------------------------- */

bool kiriFoldLine_Has(const kiriFoldLine* fold, kiriLatticePoint a, kiriLatticePoint b)
{
    kiriVec2 from = { fold->from.x, fold->from.y }, to = { fold->to.x, fold->to.y };
    const kiriVec2 first = { a.x, a.y }, last = { b.x, b.y };
    KIRI_ASSERT(fold->reach >= 0.0 && !kiriLattice_IsSame(fold->from, fold->to));
    kiriVec2 beyond = kiriVec2_Scale(3.0 * fold->reach, kiriVec2_Normalize(kiriVec2_Sub(to, from)));
    from = kiriVec2_Sub(from, beyond);
    to = kiriVec2_Add(to, beyond);
    return kiriVec2_DistanceToWay(first, from, to) <= fold->reach &&
           kiriVec2_DistanceToWay(last, from, to) <= fold->reach;
}

bool kiriMesh_Holds(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at, int64_t least)
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, triangle, c);
    return kiriOrient(c[0], c[1], at) >= least && kiriOrient(c[1], c[2], at) >= least && kiriOrient(c[2], c[0], at) >= least;
}

int32_t kiriMesh_Locate(const kiriMeshData* mesh, kiriLatticePoint at)
{
    int32_t square = kiriSquares_At(&mesh->squares, at), found = KIRI_NONE;
    int32_t slot = square == KIRI_NONE ? KIRI_NONE : mesh->squares.head[square];
    for (; slot != KIRI_NONE; slot = mesh->squares.nodes.data[slot].next) {
        int32_t t = mesh->squares.nodes.data[slot].triangle;
        found = (found == KIRI_NONE || t < found) && kiriMesh_Holds(mesh, t, at, 0) ? t : found;
    }
    return found;
}

void kiriMesh_Shares(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at, double shares[3])
{
    kiriLatticePoint c[3];
    kiriMesh_Corners(mesh, triangle, c);
    double area = (double)kiriOrient(c[0], c[1], c[2]);
    KIRI_EACH_CORNER(k) {
        shares[k] = (double)kiriOrient(c[(k + 1) % 3], c[(k + 2) % 3], at) / area;
    }
}

double kiriMesh_Area(const kiriMeshData* mesh)
{
    int64_t sum = 0; /* exact */
    KIRI_EACH_INDEX(t, mesh->triangles) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        sum += kiriOrient(c[0], c[1], c[2]);
    }
    return 0.5 * (double)sum * mesh->step * mesh->step;
}

kiriVec2 kiriMesh_Direction(const kiriMeshData* mesh, int32_t from, int32_t to)
{
    kiriLatticePoint a = kiriMesh_At(mesh, from), b = kiriMesh_At(mesh, to);
    return kiriVec2_Normalize(kiriVec2_Make((double)b.x - a.x, (double)b.y - a.y));
}

bool kiriMesh_FindFan(const kiriMeshData* mesh, int32_t vertex, int32_t* first, int32_t* last)
{
    KIRI_ASSERT_HAS(mesh->vertices, vertex);
    int32_t start = mesh->vertices.data[vertex].edge;
    KIRI_ASSERT(start != KIRI_NONE);
    *first = *last = start;
    for (int32_t h = kiriMesh_Clockwise(mesh, start); h != KIRI_NONE; h = kiriMesh_Clockwise(mesh, h)) {
        if (h == start) {
            return false;
        }
        *first = h;
    }
    for (int32_t h = start; h != KIRI_NONE; h = kiriMesh_CounterClockwise(mesh, h)) {
        *last = h;
    }
    return true;
}

/* Returns an eighth of the integral of the directions between the first and the last edge of the fan. */
kiriVec2 kiriMesh_Lean(const kiriMeshData* mesh, int32_t vertex)
{
    int32_t first, last;
    if (!kiriMesh_FindFan(mesh, vertex, &first, &last)) {
        return kiriVec2_Make(0.0, 0.0);
    }
    kiriVec2 a = kiriMesh_Direction(mesh, vertex, kiriMesh_Head(mesh, first));
    kiriVec2 b = kiriMesh_Direction(mesh, vertex, kiriMesh_Tail(mesh, kiriEdge_Previous(last)));
    return kiriVec2_Make(0.125 * (b.y - a.y), 0.125 * (a.x - b.x));
}

/* Returns the nearest even number, clamped to four times the sheet's box. NaN maps to a bound. Input may be hostile. */
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

/* ---- The journal ------------------------------------------------------------------------------------------------- */

static void NoteTriangle(kiriMeshData* mesh, int32_t triangle)
{
    KIRI_ASSERT(mesh->isOpen && triangle >= 0 && triangle < mesh->triangles.count);
    kiriTriangle* t = &mesh->triangles.data[triangle];
    if (triangle < mesh->oldTriangleCount && (t->marks & KIRI_TRIANGLE_CHANGED) == 0) {
        KIRI_NEXT(mesh->changedTriangles) = triangle;
        t->marks |= KIRI_TRIANGLE_CHANGED;
    }
}

static void NoteVertex(kiriMeshData* mesh, int32_t vertex)
{
    KIRI_ASSERT(mesh->isOpen && vertex >= 0 && vertex < mesh->vertices.count);
    kiriVertex* v = &mesh->vertices.data[vertex];
    if (vertex < mesh->oldVertexCount && v->stamp != mesh->stamp) {
        KIRI_NEXT(mesh->changedVertices) = vertex;
        v->stamp = mesh->stamp;
    }
}

static void EmptyJournal(kiriMeshData* mesh)
{
    KIRI_EACH_LISTED(triangle, mesh->changedTriangles) {
        mesh->triangles.data[triangle].marks &= ~KIRI_TRIANGLE_CHANGED;
    }
    mesh->changedTriangles.count = mesh->changedVertices.count = 0;
}

void kiriMesh_Begin(kiriMeshData* mesh)
{
    EmptyJournal(mesh);
    mesh->isOpen = true;
    mesh->hasMet = false;
    ++mesh->stamp;
    mesh->oldTriangleCount = mesh->triangles.count;
    mesh->oldVertexCount = mesh->vertices.count;
    mesh->births.count = 0;
}

void kiriMesh_Commit(kiriMeshData* mesh)
{
    EmptyJournal(mesh);
    mesh->isOpen = false;
}

/* ---- Changing the mesh ------------------------------------------------------------------------------------------- */

/* Moves half-edge h to half-edge g: its twin, its mark, and the link from its tail. */
static void MoveHalfEdge(kiriMeshData* mesh, int32_t h, int32_t g)
{
    kiriVertex* tail = &mesh->vertices.data[kiriMesh_Tail(mesh, g)];
    kiriMesh_SetMarks(mesh, g, kiriMesh_MarksOf(mesh, h));
    kiriMesh_Link(mesh, g, kiriMesh_Twin(mesh, h));
    kiriMesh_SetMarks(mesh, h, 0);
    if (tail->edge == h) {
        tail->edge = g;
    }
}

/* Notes a triangle that is to be split. */
static void NoteSplit(kiriMeshData* mesh, int32_t triangle)
{
    NoteTriangle(mesh, triangle);
    kiriMesh_KeepSource(mesh, triangle);
}

/* Notes what moving half-edge h to another triangle changes. */
static void NoteHalfEdge(kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    NoteVertex(mesh, kiriMesh_Tail(mesh, h));
    if (twin != KIRI_NONE) {
        NoteTriangle(mesh, twin / 3);
    }
}

bool kiriMesh_Reserve(kiriMeshData* mesh, int32_t changes)
{
    int64_t more = 2 * (int64_t)changes, triangles = mesh->triangles.count + more;
    int64_t corners = mesh->sources.count > 0 ? 0 : mesh->sourceCorners.count + 3 * KIRI_SOURCES_A_BLOCK * more;
    KIRI_ASSERT(mesh->isOpen && changes > 0);
    /* An opening may change all triangles around a vertex. */
    return triangles <= KIRI_MOST_TRIANGLES &&
           kiriArray_Reserve(mesh->memory, &mesh->vertices, mesh->vertices.count + more) &&
           kiriArray_Reserve(mesh->memory, &mesh->triangles, triangles) &&
           kiriArray_Reserve(mesh->memory, &mesh->births, mesh->births.count + more) &&
           kiriArray_Reserve(mesh->memory, &mesh->changedTriangles, mesh->oldTriangleCount) &&
           kiriArray_Reserve(mesh->memory, &mesh->changedVertices, mesh->changedVertices.count + more) &&
           kiriArray_Reserve(mesh->memory, &mesh->sourceCorners, corners);
}

/* Reserves room for one change that leaves these triangles where it makes or reshapes some. */
static bool ReserveChange(kiriMeshData* mesh, const kiriLatticePoint (*corners)[3], int32_t count)
{
    int64_t nodes = mesh->squares.nodes.count;
    KIRI_TIMES(k, count) {
        nodes += kiriSquares_MostNodes(&mesh->squares, corners[k]);
    }
    return kiriMesh_Reserve(mesh, 1) && kiriArray_Reserve(mesh->memory, &mesh->squares.nodes, nodes);
}

/* Room for it is reserved. */
static int32_t AddVertex(kiriMeshData* mesh, kiriLatticePoint at, int32_t source, const kiriBirth* birth)
{
    KIRI_ASSERT(mesh->isOpen && mesh->vertices.count < mesh->vertices.capacity);
    KIRI_ASSERT(mesh->births.count == mesh->vertices.count - mesh->oldVertexCount);
    int32_t index = mesh->vertices.count++;
    kiriVertex* v = &mesh->vertices.data[index];
    KIRI_CLEAR(v);
    v->at = at;
    v->edge = KIRI_NONE;
    kiriMesh_ListVertex(mesh, index);
    v->source = source;
    KIRI_NEXT(mesh->births) = *birth;
    return index;
}

/* Adds a vertex on half-edge h, born of the two ends on its own side. */
static int32_t AddOnEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at)
{
    int32_t a = kiriMesh_Tail(mesh, h), b = kiriMesh_Tail(mesh, kiriEdge_Next(h));
    double toA = sqrt((double)kiriDistanceSquared(kiriMesh_At(mesh, a), at));
    double toB = sqrt((double)kiriDistanceSquared(kiriMesh_At(mesh, b), at));
    kiriBirth birth = { { a, b, KIRI_NONE }, { toB / (toA + toB), toA / (toA + toB), 0.0 } };
    return AddVertex(mesh, at, mesh->triangles.data[h / 3].source, &birth);
}

/* One side of a split edge: (a, b, c) with h from a to b becomes (a, p, c) and a new (p, b, c). Returns the half-edge
   from p to b. */
static int32_t SplitSide(kiriMeshData* mesh, int32_t h, int32_t p)
{
    int32_t next = kiriEdge_Next(h), b = kiriMesh_Tail(mesh, next), c = kiriMesh_Tail(mesh, kiriEdge_Previous(h));
    int32_t added = 3 * kiriMesh_AddTriangle(mesh, p, b, c, mesh->triangles.data[h / 3].source, h / 3);
    kiriMesh_SetMarks(mesh, added, kiriMesh_MarksOf(mesh, h));
    MoveHalfEdge(mesh, next, added + 1);
    mesh->triangles.data[next / 3].vertex[next % 3] = p;
    kiriMesh_Link(mesh, next, added + 2);
    mesh->vertices.data[p].edge = added;
    return added;
}

static void InsertInSquares(kiriMeshData* mesh, int32_t triangle)
{
    kiriLatticePoint corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    bool ok = kiriSquares_Insert(&mesh->squares, mesh->memory, triangle, corners);
    KIRI_ASSERT(ok);
    (void)ok;
}

/* The triangle had other corners before. */
static void ReshapeInSquares(kiriMeshData* mesh, int32_t triangle, const kiriLatticePoint was[3])
{
    kiriLatticePoint is[3];
    kiriMesh_Corners(mesh, triangle, is);
    kiriSquares_Reshape(&mesh->squares, triangle, was, is);
}

int32_t kiriMesh_SplitEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at)
{
    KIRI_ASSERT(kiriMesh_CanSplitEdge(mesh, h, at));
    int32_t g = kiriMesh_Twin(mesh, h), count = g == KIRI_NONE ? 2 : 4;
    kiriLatticePoint made[4][3];
    KIRI_TIMES(k, count) {
        int32_t edge = k < 2 ? h : g;
        kiriMesh_Corners(mesh, edge / 3, made[k]);
        made[k][(edge + k) % 3] = at; /* edge % 3 and the next corner */
    }
    if (!ReserveChange(mesh, (const kiriLatticePoint(*)[3])made, count)) {
        return KIRI_NONE;
    }
    NoteSplit(mesh, h / 3);
    NoteHalfEdge(mesh, kiriEdge_Next(h));
    if (g != KIRI_NONE) {
        NoteSplit(mesh, g / 3);
        NoteHalfEdge(mesh, kiriEdge_Next(g));
    }
    kiriLatticePoint was[3], wasBeyond[3];
    kiriMesh_Corners(mesh, h / 3, was);
    ++mesh->revision;
    int32_t p = AddOnEdge(mesh, h, at), added = SplitSide(mesh, h, p), addedBeyond = KIRI_NONE;
    if (g != KIRI_NONE) {
        kiriMesh_Corners(mesh, g / 3, wasBeyond);
        addedBeyond = SplitSide(mesh, g, kiriMesh_IsOpen(mesh, g) ? AddOnEdge(mesh, g, at) : p);
        kiriMesh_Link(mesh, h, addedBeyond);
        kiriMesh_Link(mesh, added, g);
    }
    ReshapeInSquares(mesh, h / 3, was);
    InsertInSquares(mesh, added / 3);
    if (g != KIRI_NONE) {
        ReshapeInSquares(mesh, g / 3, wasBeyond);
        InsertInSquares(mesh, addedBeyond / 3);
    }
    return p;
}

int32_t kiriMesh_SplitTriangle(kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at)
{
    KIRI_ASSERT(kiriMesh_Holds(mesh, triangle, at, 1));
    int32_t h = 3 * triangle;
    kiriLatticePoint corners[3], made[3][3];
    kiriMesh_Corners(mesh, triangle, corners);
    KIRI_EACH_CORNER(k) {
        memcpy(made[k], corners, sizeof(corners));
        made[k][k] = at;
    }
    if (!ReserveChange(mesh, (const kiriLatticePoint(*)[3])made, 3)) {
        return KIRI_NONE;
    }
    NoteSplit(mesh, triangle);
    NoteHalfEdge(mesh, h + 1);
    NoteHalfEdge(mesh, h + 2);
    ++mesh->revision;
    kiriTriangle was = mesh->triangles.data[triangle];
    kiriBirth birth;
    memcpy(birth.parent, was.vertex, sizeof(birth.parent));
    kiriMesh_Shares(mesh, triangle, at, birth.share);
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
    ReshapeInSquares(mesh, triangle, corners);
    InsertInSquares(mesh, k / 3);
    InsertInSquares(mesh, l / 3);
    return p;
}

bool kiriMesh_FlipEdge(kiriMeshData* mesh, int32_t h)
{
    KIRI_ASSERT(kiriMesh_CanFlipEdge(mesh, h));
    int32_t g = kiriMesh_Twin(mesh, h), nextH = kiriEdge_Next(h), nextG = kiriEdge_Next(g);
    kiriLatticePoint was[3], wasBeyond[3], made[2][3];
    kiriMesh_Corners(mesh, h / 3, was);
    kiriMesh_Corners(mesh, g / 3, wasBeyond);
    memcpy(made[0], was, sizeof(was));
    memcpy(made[1], wasBeyond, sizeof(wasBeyond));
    made[0][nextH % 3] = wasBeyond[(g + 2) % 3];
    made[1][nextG % 3] = was[(h + 2) % 3];
    if (!ReserveChange(mesh, (const kiriLatticePoint(*)[3])made, 2)) {
        return false;
    }
    NoteSplit(mesh, h / 3);
    NoteSplit(mesh, g / 3);
    NoteHalfEdge(mesh, nextH);
    NoteHalfEdge(mesh, nextG);
    ++mesh->revision;
    int32_t c = kiriMesh_Tail(mesh, kiriEdge_Previous(h)), d = kiriMesh_Tail(mesh, kiriEdge_Previous(g));
    MoveHalfEdge(mesh, nextG, h);
    MoveHalfEdge(mesh, nextH, g);
    mesh->triangles.data[h / 3].vertex[nextH % 3] = d;
    mesh->triangles.data[g / 3].vertex[nextG % 3] = c;
    kiriMesh_Link(mesh, nextH, nextG);
    ReshapeInSquares(mesh, h / 3, was);
    ReshapeInSquares(mesh, g / 3, wasBeyond);
    return true;
}

/* Tears the fan at the tail of half-edge h, which has just been opened: if the fan is divided, its left part gets a new
   vertex. */
static void TearFan(kiriMeshData* mesh, int32_t h)
{
    int32_t old = kiriMesh_Tail(mesh, h), twin = kiriMesh_Twin(mesh, h), last = h;
    for (int32_t c = h; c != KIRI_NONE; c = kiriMesh_CounterClockwise(mesh, c)) {
        last = c;
        NoteTriangle(mesh, c / 3);
    }
    if (kiriEdge_Previous(last) == twin) {
        return; /* all around: the end of a cut */
    }
    NoteVertex(mesh, old);
    kiriBirth birth = { { old, KIRI_NONE, KIRI_NONE }, { 1.0, 0.0, 0.0 } };
    int32_t torn = AddVertex(mesh, kiriMesh_At(mesh, old), mesh->triangles.data[h / 3].source, &birth);
    for (int32_t c = h; c != KIRI_NONE; c = kiriMesh_CounterClockwise(mesh, c)) {
        mesh->triangles.data[c / 3].vertex[c % 3] = torn;
    }
    mesh->vertices.data[torn].edge = h;
    mesh->vertices.data[old].edge = kiriEdge_Next(twin);
    mesh->vertices.data[old].source = mesh->triangles.data[twin / 3].source;
}

bool kiriMesh_Open(kiriMeshData* mesh, int32_t h, bool isCrease)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    bool wasCrease = twin != KIRI_NONE && kiriMesh_IsCrease(mesh, h);
    KIRI_ASSERT(twin == KIRI_NONE || kiriMesh_IsCrease(mesh, twin) == wasCrease);
    if (twin == KIRI_NONE || (kiriMesh_IsOpen(mesh, h) && (isCrease || !wasCrease))) {
        return true;
    }
    if (!kiriMesh_Reserve(mesh, 1)) {
        return false;
    }
    NoteTriangle(mesh, h / 3);
    NoteTriangle(mesh, twin / 3);
    int32_t before = mesh->vertices.count;
    ++mesh->revision;
    kiriMesh_SetMarks(mesh, h, isCrease ? KIRI_EDGE_CREASE : KIRI_EDGE_OPEN);
    kiriMesh_SetMarks(mesh, twin, isCrease ? KIRI_EDGE_CREASE : KIRI_EDGE_OPEN);
    kiriSquares_MarkEdgeDirty(&mesh->squares, kiriMesh_TailAt(mesh, h), kiriMesh_HeadAt(mesh, h));
    if (!wasCrease) {
        TearFan(mesh, h);
        TearFan(mesh, twin);
    }
    mesh->hasMet |= wasCrease || mesh->vertices.count == before + 2; /* both ends are torn */
    return true;
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

bool kiriMesh_FlipKeepsCells(const kiriMeshData* mesh, int32_t h)
{
    bool keeps = true;
    KIRI_ASSERT(h >= 0 && h < 3 * mesh->triangles.count);
    for (int32_t g = h; keeps && g != KIRI_NONE; g = g == h ? kiriMesh_Twin(mesh, h) : KIRI_NONE) {
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, g / 3, c);
        keeps = kiriSquares_RunsThroughAll(&mesh->squares, kiriMesh_TailAt(mesh, h), kiriMesh_HeadAt(mesh, h), c);
    }
    return keeps;
}

/* Half-edges keep their place in their triangle. */
static int32_t EdgeTo(const kiriKeep* triangles, int32_t h)
{
    int32_t t = h == KIRI_NONE ? KIRI_NONE : (int32_t)((uint32_t)h / 3), to = kiriKeep_To(triangles, t);
    return to == KIRI_NONE ? KIRI_NONE : h + 3 * (to - t);
}

/* Renumbers a kept triangle. An open edge whose other side is removed becomes part of the outline. The parent is used
   only until the cut is committed: see kiri_refit.c. */
static void RenumberTriangle(kiriTriangle* t, const kiriKeep* triangles, const kiriKeep* vertices)
{
    KIRI_EACH_CORNER(i) {
        t->vertex[i] = kiriKeep_To(vertices, t->vertex[i]);
        t->twin[i] = EdgeTo(triangles, t->twin[i]);
        t->marks &= t->twin[i] == KIRI_NONE ? ~(KIRI_EDGE_CREASE << i) : ~0;
    }
    t->parent = kiriKeep_To(triangles, t->parent);
}

/* ---- Copying a part ---------------------------------------------------------------------------------------------- */

static bool CopyItems(kiriMeshData* mesh, const kiriMeshData* from, const kiriMeshPart* triangles,
                      const kiriMeshPart* vertices)
{
    if (!kiriArray_Resize(mesh->memory, &mesh->vertices, vertices->items.count) ||
        !kiriArray_Resize(mesh->memory, &mesh->triangles, triangles->items.count)) {
        return false;
    }
    KIRI_EACH_INDEX(k, mesh->vertices) {
        kiriVertex vertex = from->vertices.data[vertices->items.data[k]];
        vertex.edge = EdgeTo(triangles->keep, vertex.edge);
        KIRI_ASSERT(vertex.edge != KIRI_NONE);
        vertex.stamp = 0;
        mesh->vertices.data[k] = vertex;
    }
    KIRI_EACH_INDEX(k, mesh->triangles) {
        kiriTriangle triangle = from->triangles.data[triangles->items.data[k]];
        RenumberTriangle(&triangle, triangles->keep, vertices->keep);
        triangle.marks &= KIRI_TRIANGLE_OPEN | KIRI_TRIANGLE_CREASE;
        mesh->triangles.data[k] = triangle;
    }
    return true;
}

/* Lists the caller's triangles of which the part has something, and their corners. */
static bool CopySources(kiriMeshData* mesh, const kiriMeshData* from)
{
    int32_t count = mesh->triangles.count, left = 0;
    bool ok = kiriArray_Resize(mesh->memory, &mesh->sources, count);
    int32_t* sources = mesh->sources.data;
    KIRI_TIMES_WHILE(ok, t, count) {
        sources[t] = mesh->triangles.data[t].source;
    }
    kiriSort(sources, ok ? count : 0, NULL, NULL);
    KIRI_TIMES_WHILE(ok, i, count) {
        if (left == 0 || sources[i] != sources[left - 1]) {
            sources[left++] = sources[i];
        }
    }
    mesh->sources.count = left;
    ok = ok && kiriArray_ResizeJust(mesh->memory, &mesh->sourceCorners, 3 * (int64_t)left);
    KIRI_TIMES_WHILE(ok, k, left) {
        kiriMesh_SourceCorners(from, sources[k], &mesh->sourceCorners.data[3 * k]);
    }
    return ok;
}

static bool StartSquares(kiriMeshData* mesh, const kiriMeshData* from)
{
    kiriLatticePoint lower = kiriMesh_At(mesh, 0), upper = lower;
    KIRI_FROM_TO(v, 1, mesh->vertices.count) {
        kiriLatticePoint at = kiriMesh_At(mesh, v);
        lower.x = kiriMin(at.x, lower.x);
        lower.y = kiriMin(at.y, lower.y);
        upper.x = kiriMax(at.x, upper.x);
        upper.y = kiriMax(at.y, upper.y);
    }
    return kiriSquares_InitPart(&mesh->squares, mesh->memory, &from->squares, lower, upper);
}

bool kiriMesh_MakePart(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshData* from,
                       const kiriMeshPart* triangles, const kiriMeshPart* vertices)
{
    KIRI_ASSERT(mesh->memory == NULL && triangles->items.count > 0 && vertices->items.count > 0);
    KIRI_CLEAR(mesh);
    mesh->memory = memory;
    mesh->origin = from->origin;
    mesh->step = from->step;
    mesh->revision = from->revision + 1;
    if (!CopyItems(mesh, from, triangles, vertices) || !CopySources(mesh, from) || !StartSquares(mesh, from) ||
        !kiriMesh_FillSquares(mesh, &mesh->squares, memory) ||
        !kiriArray_Resize(memory, &mesh->folds, from->folds.count)) {
        return false;
    }
    KIRI_EACH_INDEX(k, mesh->folds) {
        mesh->folds.data[k] = from->folds.data[k];
    }
    KIRI_EACH_INDEX(v, mesh->vertices) {
        kiriMesh_ListVertex(mesh, v);
    }
    kiriMesh_Begin(mesh);
    return true;
}

/* ---- Removal ----------------------------------------------------------------------------------------------------- */

void kiriMesh_Keep(kiriMeshData* mesh, const kiriKeep* triangles, const kiriKeep* vertices, const int32_t* squares,
                   int32_t squareCount)
{
    KIRI_ASSERT(!mesh->isOpen && mesh->changedTriangles.count == 0);
    int32_t originals = 0;
    KIRI_EACH_INDEX(t, mesh->triangles) {
        if (kiriKeep_Has(triangles, t)) {
            kiriTriangle triangle = mesh->triangles.data[t];
            RenumberTriangle(&triangle, triangles, vertices);
            mesh->triangles.data[kiriKeep_To(triangles, t)] = triangle;
            originals += t < mesh->originals;
        }
    }
    mesh->originals = originals;
    mesh->triangles.count = triangles->count;
    KIRI_EACH(kiriVertex, vertex, mesh->vertices) {
        vertex->edge = EdgeTo(triangles, vertex->edge);
    }
    kiriKeep_Relink(vertices, mesh->squares.vertexHead, mesh->squares.columns * mesh->squares.rows,
                    &mesh->vertices.data[0].next, sizeof(kiriVertex));
    kiriSquares_Keep(&mesh->squares, triangles, squares, squareCount);
    kiriKeep_Compact(vertices, &mesh->vertices, 1, sizeof(kiriVertex));
    mesh->births.count = 0;
    mesh->oldTriangleCount = mesh->triangles.count;
    mesh->oldVertexCount = mesh->vertices.count;
    mesh->revision += 1;
}
