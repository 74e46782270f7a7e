#include "kiri_mesh.h"

#include <string.h>

enum {
    LATTICE = 1 << 29,           /* steps along the longer side of the sheet's box */
    MOST_TRIANGLES = 1 << 29,    /* half-edges must fit 32 bits */
    OVERLAP_TOLERANCE = 64,      /* lattice steps that triangles may intrude on each other: the input is float */
    MOST_CHECK_SQUARES = 1 << 11 /* a side, when looking for overlaps */
};

/* ---- Rotating around a place ------------------------------------------------------------------------------------- */

/* Half-edge h stands for the corner to its left. The next corner of the same fan, or KIRI_NONE where the fan ends. */
static int32_t Clockwise(const kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    return twin == KIRI_NONE || kiriMesh_IsOpen(mesh, h) ? KIRI_NONE : kiriEdge_Next(twin);
}

static int32_t CounterClockwise(const kiriMeshData* mesh, int32_t h)
{
    int32_t previous = kiriEdge_Previous(h);
    return kiriMesh_IsOpen(mesh, previous) ? KIRI_NONE : kiriMesh_Twin(mesh, previous);
}

/* ---- The journal ------------------------------------------------------------------------------------------------- */

static bool SaveTriangle(kiriMeshData* mesh, int32_t triangle)
{
    kiriTriangle* t = &mesh->triangles.data[triangle];
    if (triangle >= mesh->oldTriangleCount || t->stamp == mesh->stamp) {
        return true;
    }
    kiriSavedTriangle saved = { triangle, *t };
    if (!kiriArray_Push(mesh->memory, &mesh->savedTriangles, saved)) {
        return false;
    }
    t->stamp = mesh->stamp;
    return true;
}

static bool SaveVertex(kiriMeshData* mesh, int32_t vertex)
{
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
    mesh->savedTriangles.count = 0;
    mesh->savedVertices.count = 0;
}

void kiriMesh_Begin(kiriMeshData* mesh)
{
    EmptyJournal(mesh);
    kiriSquares_Begin(&mesh->squares);
    mesh->isOpen = true;
    ++mesh->stamp;
    mesh->oldTriangleCount = mesh->triangles.count;
    mesh->oldVertexCount = mesh->vertices.count;
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

static bool RemoveSquares(kiriMeshData* mesh, int32_t triangle)
{
    kiriLatticePoint corners[3];
    kiriMesh_Corners(mesh, triangle, corners);
    return kiriSquares_Remove(&mesh->squares, mesh->memory, triangle, corners);
}

void kiriMesh_Rollback(kiriMeshData* mesh)
{
    if (!mesh->isOpen) {
        return;
    }
    kiriSquares_Rollback(&mesh->squares);
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

/* A vertex never moves, so it stays in the list of its square, which begins with the latest. */
static void ListVertex(kiriMeshData* mesh, int32_t vertex)
{
    kiriVertex* v = &mesh->vertices.data[vertex];
    int32_t* head = &mesh->squares.vertexHead[kiriSquares_At(&mesh->squares, v->at)];
    v->next = *head;
    *head = vertex;
}

/* ---- Changing the mesh ------------------------------------------------------------------------------------------- */

/* Where the vertex is in a triangle of the caller. Rounding to the lattice may have put it a step outside. */
static void SetSource(kiriMeshData* mesh, int32_t vertex, int32_t source)
{
    const kiriLatticePoint* c = &mesh->sourceCorners.data[3 * (source - mesh->firstSource)];
    kiriVertex* v = &mesh->vertices.data[vertex];
    double share[3], sum = 0.0;
    for (int i = 0; i < 3; ++i) {
        int64_t area = kiriOrient(c[(i + 1) % 3], c[(i + 2) % 3], v->at);
        share[i] = area > 0 ? (double)area : 0.0;
        sum += share[i];
    }
    v->source = source;
    for (int i = 0; i < 3; ++i) {
        v->share[i] = (float)(share[i] / sum);
    }
}

/* Half-edges h and g run along the same edge in opposite directions; g may be KIRI_NONE. */
static void Link(kiriMeshData* mesh, int32_t h, int32_t g)
{
    mesh->triangles.data[h / 3].twin[h % 3] = g;
    if (g != KIRI_NONE) {
        mesh->triangles.data[g / 3].twin[g % 3] = h;
    }
}

static void SetOpen(kiriMeshData* mesh, int32_t h, bool open)
{
    kiriTriangle* t = &mesh->triangles.data[h / 3];
    t->open = (t->open & ~(1 << (h % 3))) | ((open ? 1 : 0) << (h % 3));
}

/* Half-edge h becomes half-edge g: its twin, its mark, and its tail's way to find it. */
static void MoveHalfEdge(kiriMeshData* mesh, int32_t h, int32_t g)
{
    kiriVertex* tail = &mesh->vertices.data[kiriMesh_Tail(mesh, g)];
    SetOpen(mesh, g, kiriMesh_IsOpen(mesh, h));
    Link(mesh, g, kiriMesh_Twin(mesh, h));
    SetOpen(mesh, h, false);
    if (tail->edge == h) {
        tail->edge = g;
    }
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
    return triangles <= MOST_TRIANGLES && kiriArray_Reserve(mesh->memory, &mesh->vertices, vertices) &&
           kiriArray_Reserve(mesh->memory, &mesh->triangles, triangles) &&
           kiriArray_Reserve(mesh->memory, &mesh->births, (int64_t)mesh->births.count + 2);
}

/* Room for it is reserved. */
static int32_t AddVertex(kiriMeshData* mesh, kiriLatticePoint at, int32_t source, const kiriBirth* birth)
{
    int32_t index = mesh->vertices.count++;
    kiriVertex* v = &mesh->vertices.data[index];
    memset(v, 0, sizeof(*v));
    v->at = at;
    v->edge = KIRI_NONE;
    ListVertex(mesh, index);
    SetSource(mesh, index, source);
    mesh->births.data[mesh->births.count++] = *birth;
    return index;
}

static int32_t AddTriangle(kiriMeshData* mesh, int32_t a, int32_t b, int32_t c, int32_t source, int32_t parent)
{
    int32_t index = mesh->triangles.count++;
    kiriTriangle t = { { a, b, c }, { KIRI_NONE, KIRI_NONE, KIRI_NONE }, source, parent, 0, 0 };
    mesh->triangles.data[index] = t;
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
    int32_t added = 3 * AddTriangle(mesh, p, b, c, mesh->triangles.data[h / 3].source, h / 3);
    SetOpen(mesh, added, kiriMesh_IsOpen(mesh, h));
    MoveHalfEdge(mesh, next, added + 1);
    mesh->triangles.data[next / 3].vertex[next % 3] = p;
    Link(mesh, next, added + 2);
    mesh->vertices.data[p].edge = added;
    return added;
}

int32_t kiriMesh_SplitEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at)
{
    int32_t g = kiriMesh_Twin(mesh, h);
    if (!ReserveSplit(mesh) || !SaveTriangle(mesh, h / 3) || !SaveHalfEdge(mesh, kiriEdge_Next(h)) ||
        !RemoveSquares(mesh, h / 3) ||
        (g != KIRI_NONE &&
         (!SaveTriangle(mesh, g / 3) || !SaveHalfEdge(mesh, kiriEdge_Next(g)) || !RemoveSquares(mesh, g / 3)))) {
        return KIRI_NONE;
    }
    ++mesh->revision;
    int32_t p = AddOnEdge(mesh, h, at);
    int32_t added = SplitSide(mesh, h, p);
    if (g == KIRI_NONE) {
        return InsertSquares(mesh, h / 3) && InsertSquares(mesh, added / 3) ? p : KIRI_NONE;
    }
    int32_t q = kiriMesh_IsOpen(mesh, g) ? AddOnEdge(mesh, g, at) : p;
    int32_t addedBeyond = SplitSide(mesh, g, q);
    Link(mesh, h, addedBeyond);
    Link(mesh, added, g);
    return InsertSquares(mesh, h / 3) && InsertSquares(mesh, added / 3) && InsertSquares(mesh, g / 3) &&
                   InsertSquares(mesh, addedBeyond / 3)
               ? p
               : KIRI_NONE;
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
    int32_t h = 3 * triangle;
    if (!ReserveSplit(mesh) || !SaveTriangle(mesh, triangle) || !SaveHalfEdge(mesh, h + 1) ||
        !SaveHalfEdge(mesh, h + 2) || !RemoveSquares(mesh, triangle)) {
        return KIRI_NONE;
    }
    ++mesh->revision;
    kiriTriangle was = mesh->triangles.data[triangle];
    kiriBirth birth = BirthInside(mesh, triangle, at);
    int32_t p = AddVertex(mesh, at, was.source, &birth);
    int32_t k = 3 * AddTriangle(mesh, was.vertex[1], was.vertex[2], p, was.source, triangle);
    int32_t l = 3 * AddTriangle(mesh, was.vertex[2], was.vertex[0], p, was.source, triangle);
    MoveHalfEdge(mesh, h + 1, k);
    MoveHalfEdge(mesh, h + 2, l);
    mesh->triangles.data[triangle].vertex[2] = p;
    mesh->vertices.data[p].edge = h + 2;
    Link(mesh, h + 1, k + 2);
    Link(mesh, k + 1, l + 2);
    Link(mesh, l + 1, h + 2);
    return InsertSquares(mesh, triangle) && InsertSquares(mesh, k / 3) && InsertSquares(mesh, l / 3) ? p : KIRI_NONE;
}

/* Half-edge h has just been opened: where that divides the fan at its tail, the part on its left gets a new vertex. */
static bool TearFan(kiriMeshData* mesh, int32_t h)
{
    int32_t old = kiriMesh_Tail(mesh, h), twin = kiriMesh_Twin(mesh, h), last = h;
    for (int32_t c = h; c != KIRI_NONE; c = CounterClockwise(mesh, c)) {
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
    for (int32_t c = h; c != KIRI_NONE; c = CounterClockwise(mesh, c)) {
        mesh->triangles.data[c / 3].vertex[c % 3] = torn;
    }
    mesh->vertices.data[torn].edge = h;
    mesh->vertices.data[old].edge = kiriEdge_Next(twin);
    SetSource(mesh, old, mesh->triangles.data[twin / 3].source);
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
    ++mesh->revision;
    SetOpen(mesh, h, true);
    SetOpen(mesh, twin, true);
    kiriSquares_MarkEdgeDirty(&mesh->squares, mesh->vertices.data[kiriMesh_Tail(mesh, h)].at,
                              mesh->vertices.data[kiriMesh_Tail(mesh, kiriEdge_Next(h))].at);
    return TearFan(mesh, h) && TearFan(mesh, twin);
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
        kiriLatticePoint c[3];
        kiriMesh_Corners(mesh, t, c);
        sum += kiriOrient(c[0], c[1], c[2]);
    }
    return sum;
}

double kiriMesh_Area(const kiriMeshData* mesh)
{
    return 0.5 * (double)kiriMesh_DoubledArea(mesh) * mesh->step * mesh->step;
}

static int32_t FindRoot(int32_t* parent, int32_t t)
{
    while (parent[t] != t) {
        parent[t] = parent[parent[t]];
        t = parent[t];
    }
    return t;
}

void kiriMesh_Pieces(const kiriMeshData* mesh, int32_t* piece, int32_t* count)
{
    /* Union and find in place: parents never have a higher index, so a root is the lowest of its piece. */
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        piece[t] = t;
        for (int32_t h = 3 * t; h < 3 * t + 3; ++h) {
            int32_t twin = kiriMesh_Twin(mesh, h);
            if (twin != KIRI_NONE && twin < h && !kiriMesh_IsOpen(mesh, h)) {
                int32_t a = FindRoot(piece, t), b = FindRoot(piece, twin / 3);
                piece[a > b ? a : b] = a < b ? a : b;
            }
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        piece[t] = piece[piece[t]];
    }
    *count = 0;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        piece[t] = piece[t] == t ? (*count)++ : piece[piece[t]];
    }
}

static int32_t NearestEven(double x)
{
    double half = 0.5 * x + 0.5;
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

/* ---- Taking over the caller's triangles -------------------------------------------------------------------------- */

/* From pairs of numbers to a number: open addressing, in insertion order, so the same on every machine. */
typedef struct Slot {
    int32_t a, b, value;
} Slot;

typedef struct Table {
    Slot* slots;
    uint32_t mask;
} Table;

static bool Table_Init(Table* table, kiriMemory* memory, int64_t count)
{
    int64_t size = 16;
    while (size < 2 * count) {
        size *= 2;
    }
    table->mask = (uint32_t)(size - 1);
    table->slots = kiriMemory_Alloc(memory, size * (int64_t)sizeof(Slot));
    for (int64_t i = 0; table->slots != NULL && i < size; ++i) {
        table->slots[i].value = KIRI_NONE;
    }
    return table->slots != NULL;
}

/* The value of the pair; `value` becomes it when there is none. KIRI_NONE only asks. */
static int32_t Table_Put(Table* table, int32_t a, int32_t b, int32_t value)
{
    uint64_t hash = ((uint64_t)(uint32_t)a << 32 | (uint32_t)b) * 0x9E3779B97F4A7C15u;
    uint32_t i = (uint32_t)((hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u >> 32) & table->mask;
    while (table->slots[i].value != KIRI_NONE && (table->slots[i].a != a || table->slots[i].b != b)) {
        i = (i + 1) & table->mask;
    }
    if (table->slots[i].value == KIRI_NONE) {
        Slot slot = { a, b, value };
        table->slots[i] = slot;
    }
    return table->slots[i].value;
}

typedef struct Input {
    const float* positions;
    int32_t vertexCount;
    const int32_t* indices;
    int32_t triangleCount;
} Input;

static kiriResult Refuse(const char** why, kiriResult result, const char* line)
{
    *why = line;
    return result;
}

static kiriResult RefuseMemory(const char** why)
{
    return Refuse(why, KIRI_ERROR_MEMORY, "the allocator returned null");
}

static kiriResult CheckInput(const Input* input, int32_t resolution, const char** why)
{
    if (input->positions == NULL || input->indices == NULL) {
        return Refuse(why, KIRI_ERROR_ARGUMENT, "restPositions or indices is null");
    }
    if (input->vertexCount < 3 || input->triangleCount < 1 || input->triangleCount > MOST_TRIANGLES) {
        return Refuse(why, KIRI_ERROR_ARGUMENT, "vertexCount or triangleCount is out of range");
    }
    if (resolution < 1 || resolution > 4096) {
        return Refuse(why, KIRI_ERROR_ARGUMENT, "gridResolution is not 1 to 4096");
    }
    for (int64_t i = 0; i < 2 * (int64_t)input->vertexCount; ++i) {
        if (!(input->positions[i] - input->positions[i] == 0.0f)) {
            return Refuse(why, KIRI_ERROR_ARGUMENT, "a rest position is not finite");
        }
    }
    for (int64_t i = 0; i < 3 * (int64_t)input->triangleCount; ++i) {
        if (input->indices[i] < 0 || input->indices[i] >= input->vertexCount) {
            return Refuse(why, KIRI_ERROR_ARGUMENT, "an index is out of range");
        }
    }
    return KIRI_OK;
}

/* The vertices on the lattice. *extent is its upper corner. */
static kiriResult TakeVertices(kiriMeshData* mesh, const Input* input, kiriLatticePoint* extent, const char** why)
{
    double low[2], high[2];
    for (int axis = 0; axis < 2; ++axis) {
        low[axis] = high[axis] = input->positions[axis];
        for (int32_t i = 1; i < input->vertexCount; ++i) {
            double x = input->positions[2 * (int64_t)i + axis];
            low[axis] = x < low[axis] ? x : low[axis];
            high[axis] = x > high[axis] ? x : high[axis];
        }
    }
    double width = high[0] - low[0], height = high[1] - low[1];
    mesh->origin = kiriVec2_Make(low[0], low[1]);
    mesh->step = (width > height ? width : height) / LATTICE;
    if (!(mesh->step > 0.0)) {
        return Refuse(why, KIRI_ERROR_MESH, "all rest positions are the same point");
    }
    if (!kiriArray_Resize(mesh->memory, &mesh->vertices, input->vertexCount)) {
        return RefuseMemory(why);
    }
    for (int32_t i = 0; i < input->vertexCount; ++i) {
        const float* p = &input->positions[2 * (int64_t)i];
        kiriVertex* v = &mesh->vertices.data[i];
        memset(v, 0, sizeof(*v));
        v->at = kiriMesh_Snap(mesh, kiriVec2_Sub(kiriVec2_Make(p[0], p[1]), mesh->origin));
        v->edge = KIRI_NONE;
    }
    *extent = kiriMesh_Snap(mesh, kiriVec2_Make(width, height));
    return KIRI_OK;
}

static kiriResult TakeTriangles(kiriMeshData* mesh, const Input* input, const char** why)
{
    if (!kiriArray_Reserve(mesh->memory, &mesh->triangles, input->triangleCount) ||
        !kiriArray_Resize(mesh->memory, &mesh->sourceCorners, 3 * (int64_t)input->triangleCount)) {
        return RefuseMemory(why);
    }
    for (int32_t t = 0; t < input->triangleCount; ++t) {
        const int32_t* v = &input->indices[3 * (int64_t)t];
        kiriLatticePoint* c = &mesh->sourceCorners.data[3 * (int64_t)t];
        AddTriangle(mesh, v[0], v[1], v[2], t, KIRI_NONE);
        kiriMesh_Corners(mesh, t, c);
        int64_t area = kiriOrient(c[0], c[1], c[2]);
        if (area <= 0) {
            return Refuse(why, KIRI_ERROR_MESH, area < 0 ? "a triangle is clockwise" : "a triangle has no area");
        }
        for (int i = 0; i < 3; ++i) {
            if (mesh->vertices.data[v[i]].edge == KIRI_NONE) {
                mesh->vertices.data[v[i]].edge = 3 * t + i;
                SetSource(mesh, v[i], t);
            }
        }
    }
    for (int32_t i = 0; i < mesh->vertices.count; ++i) {
        if (mesh->vertices.data[i].edge == KIRI_NONE) {
            return Refuse(why, KIRI_ERROR_MESH, "a vertex is in no triangle");
        }
    }
    return KIRI_OK;
}

/* Twins are found by place: an edge whose ends are other vertices on its other side is open. `place` of a vertex is the
   first vertex there. */
static kiriResult LinkTwins(kiriMeshData* mesh, Table* table, const int32_t* place, const char** why)
{
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t a = kiriMesh_Tail(mesh, h), b = kiriMesh_Tail(mesh, kiriEdge_Next(h));
        if (Table_Put(table, place[a], place[b], h) != h) {
            return Refuse(why, KIRI_ERROR_MESH, "two triangles use an edge in the same direction");
        }
    }
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t a = kiriMesh_Tail(mesh, h), b = kiriMesh_Tail(mesh, kiriEdge_Next(h));
        int32_t g = Table_Put(table, place[b], place[a], KIRI_NONE);
        Link(mesh, h, g);
        SetOpen(mesh, h, g != KIRI_NONE && (kiriMesh_Tail(mesh, g) != b || kiriMesh_Tail(mesh, kiriEdge_Next(g)) != a));
    }
    return KIRI_OK;
}

static kiriResult FindTwins(kiriMeshData* mesh, const char** why)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    Table places = { NULL, 0 }, edges = { NULL, 0 };
    kiriResult result = KIRI_OK;
    int32_t* place = kiriMemory_Alloc(&scratch, mesh->vertices.count * (int64_t)sizeof(int32_t));
    if (place == NULL || !Table_Init(&places, &scratch, mesh->vertices.count) ||
        !Table_Init(&edges, &scratch, 3 * (int64_t)mesh->triangles.count)) {
        result = RefuseMemory(why);
    } else {
        for (int32_t i = 0; i < mesh->vertices.count; ++i) {
            place[i] = Table_Put(&places, mesh->vertices.data[i].at.x, mesh->vertices.data[i].at.y, i);
        }
        result = LinkTwins(mesh, &edges, place, why);
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

/* Gives h's fan a vertex of its own when another fan has taken its vertex before. While this runs, the stamps mark the
   vertices that are taken and the corners that are done. */
static bool ClaimFan(kiriMeshData* mesh, int32_t h)
{
    int32_t first = h, vertex = kiriMesh_Tail(mesh, h);
    for (int32_t c = Clockwise(mesh, h); c != KIRI_NONE && c != h; c = Clockwise(mesh, c)) {
        first = c;
    }
    if (mesh->vertices.data[vertex].stamp != 0) {
        kiriVertex copy = mesh->vertices.data[vertex];
        vertex = mesh->vertices.count;
        if (!kiriArray_Push(mesh->memory, &mesh->vertices, copy)) {
            return false;
        }
        SetSource(mesh, vertex, mesh->triangles.data[h / 3].source);
    }
    mesh->vertices.data[vertex].stamp = 1;
    mesh->vertices.data[vertex].edge = h;
    int32_t c = first;
    do {
        mesh->triangles.data[c / 3].vertex[c % 3] = vertex;
        mesh->triangles.data[c / 3].stamp |= 1u << (c % 3);
        c = CounterClockwise(mesh, c);
    } while (c != KIRI_NONE && c != first);
    return true;
}

static bool ClaimFans(kiriMeshData* mesh)
{
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        if ((mesh->triangles.data[h / 3].stamp >> (h % 3) & 1u) == 0 && !ClaimFan(mesh, h)) {
            return false;
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        mesh->triangles.data[t].stamp = 0;
    }
    for (int32_t i = 0; i < mesh->vertices.count; ++i) {
        mesh->vertices.data[i].stamp = 0;
    }
    return true;
}

/* Is triangle b on the outer side of an edge of triangle a, but for the tolerance? */
static bool EdgeSeparates(const kiriLatticePoint a[3], const kiriLatticePoint b[3])
{
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint p = a[i], q = a[(i + 1) % 3];
        int64_t length = (q.x > p.x ? (int64_t)q.x - p.x : (int64_t)p.x - q.x) +
                         (q.y > p.y ? (int64_t)q.y - p.y : (int64_t)p.y - q.y);
        int64_t most = OVERLAP_TOLERANCE * length;
        if (kiriOrient(p, q, b[0]) <= most && kiriOrient(p, q, b[1]) <= most && kiriOrient(p, q, b[2]) <= most) {
            return true;
        }
    }
    return false;
}

static bool AnyOverlap(const kiriMeshData* mesh, const kiriSquares* squares)
{
    const kiriSquareNode* nodes = squares->nodes.data;
    for (int32_t square = 0; square < squares->columns * squares->rows; ++square) {
        for (int32_t i = squares->head[square]; i != KIRI_NONE; i = nodes[i].next) {
            kiriLatticePoint a[3], b[3];
            kiriMesh_Corners(mesh, nodes[i].triangle, a);
            for (int32_t j = nodes[i].next; j != KIRI_NONE; j = nodes[j].next) {
                kiriMesh_Corners(mesh, nodes[j].triangle, b);
                if (!EdgeSeparates(a, b) && !EdgeSeparates(b, a)) {
                    return true;
                }
            }
        }
    }
    return false;
}

static bool FillSquares(const kiriMeshData* mesh, kiriSquares* squares, kiriMemory* memory)
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

/* Every two triangles that share a square, in squares of their own that hold a few triangles each. */
static kiriResult CheckOverlaps(const kiriMeshData* mesh, kiriLatticePoint extent, const char** why)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    double longer = extent.x > extent.y ? extent.x : extent.y, shorter = extent.x > extent.y ? extent.y : extent.x;
    double resolution = sqrt(mesh->triangles.count * longer / (shorter + 1.0)) + 1.0;
    kiriResult result = KIRI_OK;
    kiriSquares squares;
    if (!kiriSquares_Init(&squares, &scratch, extent,
                          (int32_t)(resolution < MOST_CHECK_SQUARES ? resolution : MOST_CHECK_SQUARES)) ||
        !FillSquares(mesh, &squares, &scratch)) {
        result = RefuseMemory(why);
    } else if (AnyOverlap(mesh, &squares)) {
        result = Refuse(why, KIRI_ERROR_MESH, "two triangles overlap");
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

static kiriResult Build(kiriMeshData* mesh, const Input* input, int32_t resolution, const char** why)
{
    kiriLatticePoint extent = { 0, 0 };
    kiriResult result = CheckInput(input, resolution, why);
    result = result == KIRI_OK ? TakeVertices(mesh, input, &extent, why) : result;
    result = result == KIRI_OK ? TakeTriangles(mesh, input, why) : result;
    result = result == KIRI_OK ? FindTwins(mesh, why) : result;
    result = result == KIRI_OK ? CheckOverlaps(mesh, extent, why) : result;
    if (result != KIRI_OK) {
        return result;
    }
    if (!ClaimFans(mesh) || !kiriSquares_Init(&mesh->squares, mesh->memory, extent, resolution) ||
        !FillSquares(mesh, &mesh->squares, mesh->memory)) {
        return RefuseMemory(why);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        ListVertex(mesh, v);
    }
    return KIRI_OK;
}

kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const float* positions, int32_t vertexCount,
                         const int32_t* indices, int32_t triangleCount, int32_t resolution, const char** why)
{
    Input input = { positions, vertexCount, indices, triangleCount };
    memset(mesh, 0, sizeof(*mesh));
    mesh->memory = memory;
    *why = "";
    kiriResult result = Build(mesh, &input, resolution, why);
    if (result != KIRI_OK) {
        return result;
    }
    mesh->revision = 1;
    kiriMesh_Begin(mesh);
    return KIRI_OK;
}

/* ---- A part of a mesh -------------------------------------------------------------------------------------------- */

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
        vertex.edge = 3 * triangleTo[vertex.edge / 3] + vertex.edge % 3;
        vertex.stamp = 0;
        if (vertexTo[v] != KIRI_NONE) {
            ok = kiriArray_Push(mesh->memory, &mesh->vertices, vertex);
        }
    }
    for (int32_t t = 0; ok && t < from->triangles.count; ++t) {
        if (triangleTo[t] != KIRI_NONE) {
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
        !FillSquares(mesh, &mesh->squares, mesh->memory)) {
        return false;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        ListVertex(mesh, v);
    }
    kiriMesh_Begin(mesh);
    return true;
}
