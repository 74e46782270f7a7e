#include "kiri_mesh_edit.h"
#include "kiri_overlap.h"

#include <string.h>

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

static bool MakeTrianglesRoom(kiriMeshData* mesh, int32_t count)
{
    int64_t blocks = ((int64_t)count + KIRI_SOURCES_A_BLOCK - 1) / KIRI_SOURCES_A_BLOCK;
    if (!kiriArray_Reserve(mesh->memory, &mesh->triangles, count) ||
        !kiriArray_ResizeJust(mesh->memory, &mesh->sourceBlocks, blocks)) {
        return false;
    }
    for (int32_t k = 0; k < blocks; ++k) {
        mesh->sourceBlocks.data[k] = KIRI_NONE;
    }
    mesh->originals = count;
    return true;
}

static kiriResult TakeTriangles(kiriMeshData* mesh, const MeshInput* input, const char** why)
{
    if (!MakeTrianglesRoom(mesh, input->triangleCount)) {
        return RefuseForMemory(why);
    }
    for (int32_t t = 0; t < input->triangleCount; ++t) {
        const int32_t* v = &input->indices[3 * (int64_t)t];
        kiriLatticePoint c[3];
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

/* ---- Twins ---- */

/* Twins are found by lattice points: an edge whose ends are other vertices on its other side is open. Each edge is
   listed at the one of its ends that has fewer: in a plane these lists are short, even around a hub (Chiba and
   Nishizeki 1985). */
typedef struct TwinEntry {
    int32_t half;  /* the half-edge, or its complement where it leads to the point of the list */
    int32_t other; /* the point at its other end */
} TwinEntry;

typedef struct TwinWork {
    int32_t* point;     /* of each vertex: the first vertex at its lattice point */
    bool hasDoubles;    /* there is another one somewhere */
    int32_t* degree;    /* of each point: how many half-edges leave it */
    int32_t* end;       /* of each point: where its list ends */
    TwinEntry* entries; /* list by list */
} TwinWork;

static uint32_t HashPlace(kiriLatticePoint at)
{
    uint64_t hash = ((uint64_t)(uint32_t)at.x << 32 | (uint32_t)at.y) * 0x9E3779B97F4A7C15u;
    return (uint32_t)((hash ^ hash >> 29) * 0xBF58476D1CE4E5B9u >> 32);
}

/* Open addressing, in the order of vertices: the same on every machine. */
static bool FindPoints(const kiriMeshData* mesh, kiriMemory* memory, TwinWork* work)
{
    int64_t size = 16;
    while (size < 2 * (int64_t)mesh->vertices.count) {
        size *= 2;
    }
    int32_t* slots = kiriMemory_Alloc(memory, size * (int64_t)sizeof(int32_t));
    for (int64_t i = 0; slots != NULL && i < size; ++i) {
        slots[i] = KIRI_NONE;
    }
    for (int32_t v = 0; slots != NULL && v < mesh->vertices.count; ++v) {
        const kiriVertex* vertices = mesh->vertices.data;
        kiriLatticePoint at = vertices[v].at;
        uint32_t i = HashPlace(at) & (uint32_t)(size - 1);
        while (slots[i] != KIRI_NONE && (vertices[slots[i]].at.x != at.x || vertices[slots[i]].at.y != at.y)) {
            i = (i + 1) & (uint32_t)(size - 1);
        }
        slots[i] = slots[i] == KIRI_NONE ? v : slots[i];
        work->point[v] = slots[i];
        work->hasDoubles |= slots[i] != v;
    }
    return slots != NULL;
}

/* The points of a triangle where its half-edges are listed, and their entries there. */
static void EntriesOf(const kiriMeshData* mesh, const TwinWork* work, int32_t t, int32_t at[3], TwinEntry entries[3])
{
    const int32_t* v = mesh->triangles.data[t].vertex;
    const int32_t points[4] = { work->point[v[0]], work->point[v[1]], work->point[v[2]], work->point[v[0]] };
    for (int i = 0; i < 3; ++i) {
        int32_t a = points[i], b = points[i + 1], more = work->degree[a] - work->degree[b], h = 3 * t + i;
        bool atHead = more > 0 || (more == 0 && b < a);
        entries[i] = atHead ? (TwinEntry){ ~h, a } : (TwinEntry){ h, b };
        at[i] = atHead ? b : a;
    }
}

/* First `end` counts, then it is where lists begin, and at last where they end. */
static void ListEdges(const kiriMeshData* mesh, TwinWork* work)
{
    int32_t sum = 0, at[3];
    TwinEntry entries[3];
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        for (int i = 0; i < 3; ++i) {
            ++work->degree[work->point[mesh->triangles.data[t].vertex[i]]];
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        EntriesOf(mesh, work, t, at, entries);
        for (int i = 0; i < 3; ++i) {
            ++work->end[at[i]];
        }
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t count = work->end[v];
        work->end[v] = sum;
        sum += count;
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        EntriesOf(mesh, work, t, at, entries);
        for (int i = 0; i < 3; ++i) {
            work->entries[work->end[at[i]]++] = entries[i];
        }
    }
}

/* The half-edges run along the same edge. False where they do so in the same direction. */
static bool LinkEntries(kiriMeshData* mesh, TwinEntry a, TwinEntry b, bool hasDoubles)
{
    if ((a.half < 0) == (b.half < 0)) {
        return false;
    }
    int32_t h = a.half < 0 ? ~a.half : a.half, g = b.half < 0 ? ~b.half : b.half;
    kiriMesh_Link(mesh, h, g);
    if (hasDoubles) {
        bool open = kiriMesh_Tail(mesh, g) != kiriMesh_Tail(mesh, kiriEdge_Next(h)) ||
                    kiriMesh_Tail(mesh, h) != kiriMesh_Tail(mesh, kiriEdge_Next(g));
        kiriMesh_SetOpen(mesh, h, open);
        kiriMesh_SetOpen(mesh, g, open);
    }
    return true;
}

static kiriResult LinkTwins(kiriMeshData* mesh, const TwinWork* work, const char** why)
{
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t first = v > 0 ? work->end[v - 1] : 0;
        for (int32_t i = first; i < work->end[v]; ++i) {
            for (int32_t j = i + 1; j < work->end[v]; ++j) {
                if (work->entries[i].other == work->entries[j].other &&
                    !LinkEntries(mesh, work->entries[i], work->entries[j], work->hasDoubles)) {
                    return RefuseMesh(why, KIRI_ERROR_MESH, "two triangles use an edge in the same direction");
                }
            }
        }
    }
    return KIRI_OK;
}

static kiriResult FindTwins(kiriMeshData* mesh, const char** why)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    int64_t bytes = mesh->vertices.count * (int64_t)sizeof(int32_t);
    TwinWork work = { kiriMemory_Alloc(&scratch, bytes), false, kiriMemory_AllocZeroed(&scratch, bytes),
                      kiriMemory_AllocZeroed(&scratch, bytes),
                      kiriMemory_Alloc(&scratch, 3 * mesh->triangles.count * (int64_t)sizeof(TwinEntry)) };
    kiriResult result = KIRI_OK;
    if (work.point == NULL || work.degree == NULL || work.end == NULL || work.entries == NULL ||
        !FindPoints(mesh, &scratch, &work)) {
        result = RefuseForMemory(why);
    } else {
        ListEdges(mesh, &work);
        result = LinkTwins(mesh, &work, why);
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

/* In the marks of a triangle, of corner 0; those of the others follow. */
enum { FAN_DONE = 16 };

static void ClaimCorner(kiriMeshData* mesh, int32_t c, int32_t vertex)
{
    kiriTriangle* triangle = &mesh->triangles.data[c / 3];
    triangle->vertex[c % 3] = vertex;
    triangle->marks |= FAN_DONE << (c % 3);
}

/* Gives h's fan a vertex of its own when another fan has taken its vertex before. While this runs, the stamps mark the
   vertices that are taken. */
static bool ClaimFan(kiriMeshData* mesh, int32_t h)
{
    int32_t vertex = kiriMesh_Tail(mesh, h), c = h;
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
    do {
        ClaimCorner(mesh, c, vertex);
        c = kiriMesh_Clockwise(mesh, c);
    } while (c != KIRI_NONE && c != h);
    for (c = c == h ? KIRI_NONE : kiriMesh_CounterClockwise(mesh, h); c != KIRI_NONE;) {
        ClaimCorner(mesh, c, vertex);
        c = kiriMesh_CounterClockwise(mesh, c);
    }
    return true;
}

static bool ClaimFans(kiriMeshData* mesh)
{
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        for (int i = 0; i < 3; ++i) {
            if ((mesh->triangles.data[t].marks & FAN_DONE << i) == 0 && !ClaimFan(mesh, 3 * t + i)) {
                return false;
            }
        }
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        mesh->triangles.data[t].marks &= KIRI_TRIANGLE_OPEN;
    }
    for (int32_t i = 0; i < mesh->vertices.count; ++i) {
        mesh->vertices.data[i].stamp = 0;
    }
    return true;
}

static kiriResult CheckOverlaps(const kiriMeshData* mesh, const char** why)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    kiriResult result = KIRI_OK;
    bool any = false;
    if (!kiriOverlap_Find(mesh, &scratch, &any)) {
        result = RefuseForMemory(why);
    } else if (any) {
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
    result = result == KIRI_OK ? CheckOverlaps(mesh, why) : result;
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
