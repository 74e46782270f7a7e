#include "kiri_mesh_edit.h"

#include <string.h>

enum {
    OVERLAP_TOLERANCE = 64,      /* lattice steps that triangles may intrude on each other: the input is float */
    MOST_CHECK_SQUARES = 1 << 11 /* a side, when looking for overlaps */
};

/* From pairs of numbers to a number: open addressing, in insertion order, so the same on every machine. */
typedef struct PairSlot {
    int32_t a, b, value;
} PairSlot;

typedef struct PairTable {
    PairSlot* slots;
    uint32_t mask;
} PairTable;

static bool PairTable_Init(PairTable* table, kiriMemory* memory, int64_t count)
{
    int64_t size = 16;
    while (size < 2 * count) {
        size *= 2;
    }
    table->mask = (uint32_t)(size - 1);
    table->slots = kiriMemory_Alloc(memory, size * (int64_t)sizeof(PairSlot));
    for (int64_t i = 0; table->slots != NULL && i < size; ++i) {
        table->slots[i].value = KIRI_NONE;
    }
    return table->slots != NULL;
}

/* The value of the pair; `value` becomes it when there is none. KIRI_NONE only asks. */
static int32_t PairTable_Put(PairTable* table, int32_t a, int32_t b, int32_t value)
{
    uint64_t hash = ((uint64_t)(uint32_t)a << 32 | (uint32_t)b) * 0x9E3779B97F4A7C15u;
    uint32_t i = (uint32_t)((hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u >> 32) & table->mask;
    while (table->slots[i].value != KIRI_NONE && (table->slots[i].a != a || table->slots[i].b != b)) {
        i = (i + 1) & table->mask;
    }
    if (table->slots[i].value == KIRI_NONE) {
        PairSlot slot = { a, b, value };
        table->slots[i] = slot;
    }
    return table->slots[i].value;
}

typedef struct MeshInput {
    const float* positions;
    int32_t vertexCount;
    const int32_t* indices;
    int32_t triangleCount;
} MeshInput;

static kiriResult RefuseMesh(const char** why, kiriResult result, const char* line)
{
    *why = line;
    return result;
}

static kiriResult RefuseForMemory(const char** why)
{
    return RefuseMesh(why, KIRI_ERROR_MEMORY, "the allocator returned null");
}

static kiriResult CheckInput(const MeshInput* input, int32_t resolution, const char** why)
{
    if (input->positions == NULL || input->indices == NULL) {
        return RefuseMesh(why, KIRI_ERROR_ARGUMENT, "restPositions or indices is null");
    }
    if (input->vertexCount < 3 || input->triangleCount < 1 || input->triangleCount > KIRI_MOST_TRIANGLES) {
        return RefuseMesh(why, KIRI_ERROR_ARGUMENT, "vertexCount or triangleCount is out of range");
    }
    if (resolution < 1 || resolution > 4096) {
        return RefuseMesh(why, KIRI_ERROR_ARGUMENT, "gridResolution is not 1 to 4096");
    }
    for (int64_t i = 0; i < 2 * (int64_t)input->vertexCount; ++i) {
        if (!(input->positions[i] - input->positions[i] == 0.0f)) {
            return RefuseMesh(why, KIRI_ERROR_ARGUMENT, "a rest position is not finite");
        }
    }
    for (int64_t i = 0; i < 3 * (int64_t)input->triangleCount; ++i) {
        if (input->indices[i] < 0 || input->indices[i] >= input->vertexCount) {
            return RefuseMesh(why, KIRI_ERROR_ARGUMENT, "an index is out of range");
        }
    }
    return KIRI_OK;
}

/* The vertices on the lattice. *extent is its upper corner. */
static kiriResult TakeVertices(kiriMeshData* mesh, const MeshInput* input, kiriLatticePoint* extent, const char** why)
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
    mesh->step = (width > height ? width : height) / KIRI_LATTICE;
    if (!(mesh->step > 0.0)) {
        return RefuseMesh(why, KIRI_ERROR_MESH, "all rest positions are the same point");
    }
    if (!kiriArray_Resize(mesh->memory, &mesh->vertices, input->vertexCount)) {
        return RefuseForMemory(why);
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

static kiriResult TakeTriangles(kiriMeshData* mesh, const MeshInput* input, const char** why)
{
    if (!kiriArray_Reserve(mesh->memory, &mesh->triangles, input->triangleCount) ||
        !kiriArray_Resize(mesh->memory, &mesh->sourceCorners, 3 * (int64_t)input->triangleCount)) {
        return RefuseForMemory(why);
    }
    for (int32_t t = 0; t < input->triangleCount; ++t) {
        const int32_t* v = &input->indices[3 * (int64_t)t];
        kiriLatticePoint* c = &mesh->sourceCorners.data[3 * (int64_t)t];
        kiriMesh_AddTriangle(mesh, v[0], v[1], v[2], t, KIRI_NONE);
        kiriMesh_Corners(mesh, t, c);
        int64_t area = kiriOrient(c[0], c[1], c[2]);
        if (area <= 0) {
            return RefuseMesh(why, KIRI_ERROR_MESH, area < 0 ? "a triangle is clockwise" : "a triangle has no area");
        }
        for (int i = 0; i < 3; ++i) {
            if (mesh->vertices.data[v[i]].edge == KIRI_NONE) {
                mesh->vertices.data[v[i]].edge = 3 * t + i;
                kiriMesh_SetSource(mesh, v[i], t);
            }
        }
    }
    for (int32_t i = 0; i < mesh->vertices.count; ++i) {
        if (mesh->vertices.data[i].edge == KIRI_NONE) {
            return RefuseMesh(why, KIRI_ERROR_MESH, "a vertex is in no triangle");
        }
    }
    return KIRI_OK;
}

/* Twins are found by lattice points: an edge whose ends are other vertices on its other side is open. `firstAt` of a
   vertex is the first vertex at its point. */
static kiriResult LinkTwins(kiriMeshData* mesh, PairTable* table, const int32_t* firstAt, const char** why)
{
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t a = kiriMesh_Tail(mesh, h), b = kiriMesh_Tail(mesh, kiriEdge_Next(h));
        if (PairTable_Put(table, firstAt[a], firstAt[b], h) != h) {
            return RefuseMesh(why, KIRI_ERROR_MESH, "two triangles use an edge in the same direction");
        }
    }
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t a = kiriMesh_Tail(mesh, h), b = kiriMesh_Tail(mesh, kiriEdge_Next(h));
        int32_t g = PairTable_Put(table, firstAt[b], firstAt[a], KIRI_NONE);
        kiriMesh_Link(mesh, h, g);
        kiriMesh_SetOpen(mesh, h,
                         g != KIRI_NONE && (kiriMesh_Tail(mesh, g) != b || kiriMesh_Tail(mesh, kiriEdge_Next(g)) != a));
    }
    return KIRI_OK;
}

static kiriResult FindTwins(kiriMeshData* mesh, const char** why)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    PairTable points = { NULL, 0 }, edges = { NULL, 0 };
    kiriResult result = KIRI_OK;
    int32_t* firstAt = kiriMemory_Alloc(&scratch, mesh->vertices.count * (int64_t)sizeof(int32_t));
    if (firstAt == NULL || !PairTable_Init(&points, &scratch, mesh->vertices.count) ||
        !PairTable_Init(&edges, &scratch, 3 * (int64_t)mesh->triangles.count)) {
        result = RefuseForMemory(why);
    } else {
        for (int32_t i = 0; i < mesh->vertices.count; ++i) {
            firstAt[i] = PairTable_Put(&points, mesh->vertices.data[i].at.x, mesh->vertices.data[i].at.y, i);
        }
        result = LinkTwins(mesh, &edges, firstAt, why);
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

/* Gives h's fan a vertex of its own when another fan has taken its vertex before. While this runs, the stamps mark the
   vertices that are taken and the corners that are done. */
static bool ClaimFan(kiriMeshData* mesh, int32_t h)
{
    int32_t first = h, vertex = kiriMesh_Tail(mesh, h);
    for (int32_t c = kiriMesh_Clockwise(mesh, h); c != KIRI_NONE && c != h; c = kiriMesh_Clockwise(mesh, c)) {
        first = c;
    }
    if (mesh->vertices.data[vertex].stamp != 0) {
        kiriVertex copy = mesh->vertices.data[vertex];
        vertex = mesh->vertices.count;
        if (!kiriArray_Push(mesh->memory, &mesh->vertices, copy)) {
            return false;
        }
        kiriMesh_SetSource(mesh, vertex, mesh->triangles.data[h / 3].source);
    }
    mesh->vertices.data[vertex].stamp = 1;
    mesh->vertices.data[vertex].edge = h;
    int32_t c = first;
    do {
        mesh->triangles.data[c / 3].vertex[c % 3] = vertex;
        mesh->triangles.data[c / 3].stamp |= 1u << (c % 3);
        c = kiriMesh_CounterClockwise(mesh, c);
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
        !kiriMesh_FillSquares(mesh, &squares, &scratch)) {
        result = RefuseForMemory(why);
    } else if (AnyOverlap(mesh, &squares)) {
        result = RefuseMesh(why, KIRI_ERROR_MESH, "two triangles overlap");
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

static kiriResult BuildMesh(kiriMeshData* mesh, const MeshInput* input, int32_t resolution, const char** why)
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
        !kiriMesh_FillSquares(mesh, &mesh->squares, mesh->memory)) {
        return RefuseForMemory(why);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriMesh_ListVertex(mesh, v);
    }
    return KIRI_OK;
}

kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const float* positions, int32_t vertexCount,
                         const int32_t* indices, int32_t triangleCount, int32_t resolution, const char** why)
{
    MeshInput input = { positions, vertexCount, indices, triangleCount };
    memset(mesh, 0, sizeof(*mesh));
    mesh->memory = memory;
    *why = "";
    kiriResult result = BuildMesh(mesh, &input, resolution, why);
    if (result != KIRI_OK) {
        return result;
    }
    mesh->revision = 1;
    kiriMesh_Begin(mesh);
    return KIRI_OK;
}
