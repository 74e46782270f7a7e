#include "kiri_mesh_edit.h"
#include "kiri_overlap.h"
#include "kiri_weld.h"

#include <string.h>

static kiriResult CheckInput(const kiriMeshInput* input, kiriFault* fault)
{
    if (input->positions == NULL || input->indices == NULL) {
        KIRI_SAY(fault, "restPositions or indices is null");
    } else if (input->vertexCount < 3 || input->triangleCount < 1 || input->triangleCount > KIRI_MOST_TRIANGLES) {
        KIRI_SAY(fault, "vertexCount or triangleCount is out of range");
    } else if (input->resolution < 1 || input->resolution > 4096) {
        KIRI_SAY(fault, "gridResolution is not 1 to 4096");
    }
    for (int64_t i = 0; fault->line[0] == '\0' && i < 2 * (int64_t)input->vertexCount; ++i) {
        if (!(input->positions[i] - input->positions[i] == 0.0f)) {
            KIRI_SAY(fault, "the rest position of vertex %lld is not finite", (long long)(i / 2));
        }
    }
    for (int64_t i = 0; fault->line[0] == '\0' && i < 3 * (int64_t)input->triangleCount; ++i) {
        if (input->indices[i] < 0 || input->indices[i] >= input->vertexCount) {
            KIRI_SAY(fault, "triangle %lld has vertex %lld, which is not within 0 and %lld", (long long)(i / 3),
                     (long long)input->indices[i], (long long)input->vertexCount - 1);
        }
    }
    return fault->line[0] == '\0' ? KIRI_OK : KIRI_ERROR_ARGUMENT;
}

/* ---- Vertices ---- */

/* The caller's vertices: one entry each. */
typedef struct Welded {
    kiriLatticePoint* at;
    int32_t* to;     /* the one that it becomes; KIRI_NONE: no triangle has it */
    int32_t* number; /* its index in the mesh; KIRI_NONE: no triangle that is left has it */
} Welded;

static bool MakeWelded(Welded* welded, const kiriMeshInput* input, kiriMemory* scratch)
{
    int64_t count = input->vertexCount;
    welded->at = kiriMemory_Alloc(scratch, count * (int64_t)sizeof(kiriLatticePoint));
    welded->to = kiriMemory_Alloc(scratch, count * (int64_t)sizeof(int32_t));
    welded->number = kiriMemory_Alloc(scratch, count * (int64_t)sizeof(int32_t));
    if (welded->at == NULL || welded->to == NULL || welded->number == NULL) {
        return false;
    }
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        welded->to[v] = welded->number[v] = KIRI_NONE;
    }
    for (int64_t i = 0; i < 3 * (int64_t)input->triangleCount; ++i) {
        welded->to[input->indices[i]] = input->indices[i];
    }
    return true;
}

/* Of the vertices that a triangle has. *extent is the upper corner. */
static kiriResult PlaceVertices(kiriMeshData* mesh, const kiriMeshInput* input, const Welded* welded,
                                kiriLatticePoint* extent, kiriFault* fault)
{
    double low[2], high[2];
    int32_t first = 0;
    while (welded->to[first] == KIRI_NONE) {
        ++first;
    }
    for (int axis = 0; axis < 2; ++axis) {
        low[axis] = high[axis] = input->positions[2 * (int64_t)first + axis];
        for (int32_t v = first + 1; v < input->vertexCount; ++v) {
            double x = input->positions[2 * (int64_t)v + axis];
            low[axis] = welded->to[v] != KIRI_NONE && x < low[axis] ? x : low[axis];
            high[axis] = welded->to[v] != KIRI_NONE && x > high[axis] ? x : high[axis];
        }
    }
    double width = high[0] - low[0], height = high[1] - low[1];
    mesh->origin = kiriVec2_Make(low[0], low[1]);
    mesh->step = kiriMax(width, height) / KIRI_LATTICE;
    if (!(mesh->step > 0.0)) {
        KIRI_SAY(fault, "triangle 0 has no area: all rest positions are the same point");
        return KIRI_ERROR_MESH;
    }
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        const float* p = &input->positions[2 * (int64_t)v];
        if (welded->to[v] != KIRI_NONE) {
            welded->at[v] = kiriMesh_Snap(mesh, kiriVec2_Sub(kiriVec2_Make(p[0], p[1]), mesh->origin));
        }
    }
    *extent = kiriMesh_Snap(mesh, kiriVec2_Make(width, height));
    return KIRI_OK;
}

/* The vertices that a triangle becomes, of the caller's. False where two of them have become one: nothing is left of
   it. */
static bool CornersLeft(const kiriMeshInput* input, const Welded* welded, int32_t triangle, int32_t corners[3])
{
    for (int i = 0; i < 3; ++i) {
        corners[i] = welded->to[input->indices[3 * (int64_t)triangle + i]];
    }
    return !(input->weldDistance > 0.0) ||
           (corners[0] != corners[1] && corners[1] != corners[2] && corners[2] != corners[0]);
}

/* Vertices of the mesh have the order of the caller's. Returns how many triangles are left. */
static int32_t NumberVertices(const kiriMeshInput* input, Welded* welded, int32_t* vertexCount)
{
    int32_t triangles = 0, corners[3];
    for (int32_t t = 0; t < input->triangleCount; ++t) {
        if (CornersLeft(input, welded, t, corners)) {
            welded->number[corners[0]] = welded->number[corners[1]] = welded->number[corners[2]] = 0;
            ++triangles;
        }
    }
    *vertexCount = 0;
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        welded->number[v] = welded->number[v] != KIRI_NONE ? (*vertexCount)++ : KIRI_NONE;
    }
    return triangles;
}

static void AddVertices(kiriMeshData* mesh, const kiriMeshInput* input, const Welded* welded)
{
    for (int32_t v = 0; v < input->vertexCount; ++v) {
        if (welded->number[v] != KIRI_NONE) {
            kiriVertex* vertex = &mesh->vertices.data[welded->number[v]];
            memset(vertex, 0, sizeof(*vertex));
            vertex->at = welded->at[v];
            vertex->edge = KIRI_NONE;
        }
    }
}

/* ---- Triangles ---- */

/* Of the caller's triangles each block of sources may be split some day. */
static bool MakeTrianglesRoom(kiriMeshData* mesh, int32_t count, int32_t sources)
{
    int64_t blocks = ((int64_t)sources + KIRI_SOURCES_A_BLOCK - 1) / KIRI_SOURCES_A_BLOCK;
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

static kiriResult RefuseShape(kiriFault* fault, int32_t triangle, int64_t area, bool isWelded)
{
    KIRI_SAY(fault, "triangle %lld %s%s", (long long)triangle, area < 0 ? "is clockwise" : "has no area",
             isWelded ? ", when vertices nearer than weldDistance are one" : "");
    return KIRI_ERROR_MESH;
}

static kiriResult AddTriangles(kiriMeshData* mesh, const kiriMeshInput* input, const Welded* welded, kiriFault* fault)
{
    int32_t v[3];
    for (int32_t t = 0; t < input->triangleCount; ++t) {
        if (!CornersLeft(input, welded, t, v)) {
            continue;
        }
        int64_t area = kiriOrient(welded->at[v[0]], welded->at[v[1]], welded->at[v[2]]);
        if (area <= 0) {
            return RefuseShape(fault, t, area, input->weldDistance > 0.0);
        }
        int32_t added =
            kiriMesh_AddTriangle(mesh, welded->number[v[0]], welded->number[v[1]], welded->number[v[2]], t, KIRI_NONE);
        for (int i = 0; i < 3; ++i) {
            kiriVertex* vertex = &mesh->vertices.data[welded->number[v[i]]];
            if (vertex->edge == KIRI_NONE) {
                vertex->edge = 3 * added + i;
                kiriMesh_SetSource(mesh, welded->number[v[i]], t);
            }
        }
    }
    return KIRI_OK;
}

static kiriResult TakeWelded(kiriMeshData* mesh, const kiriMeshInput* input, Welded* welded, kiriLatticePoint* extent,
                             kiriMemory* scratch, kiriFault* fault)
{
    int32_t vertices;
    kiriResult result = PlaceVertices(mesh, input, welded, extent, fault);
    if (result != KIRI_OK) {
        return result;
    }
    if (input->weldDistance > 0.0 &&
        !kiriWeld_Find(welded->at, input->vertexCount, input->weldDistance / mesh->step, welded->to, scratch)) {
        return KIRI_ERROR_MEMORY;
    }
    int32_t triangles = NumberVertices(input, welded, &vertices);
    if (triangles == 0) {
        KIRI_SAY(fault, "triangle 0 and all others have two corners nearer than weldDistance");
        return KIRI_ERROR_MESH;
    }
    if (!kiriArray_Resize(mesh->memory, &mesh->vertices, vertices) ||
        !MakeTrianglesRoom(mesh, triangles, input->triangleCount)) {
        return KIRI_ERROR_MEMORY;
    }
    AddVertices(mesh, input, welded);
    return AddTriangles(mesh, input, welded, fault);
}

/* Vertices that no triangle has are left out, and triangles of which two corners become one vertex. */
static kiriResult TakeTriangles(kiriMeshData* mesh, const kiriMeshInput* input, kiriLatticePoint* extent,
                                kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    Welded welded;
    kiriResult result = MakeWelded(&welded, input, &scratch) ? TakeWelded(mesh, input, &welded, extent, &scratch, fault)
                                                             : KIRI_ERROR_MEMORY;
    kiriMemory_FreeAll(&scratch);
    return result;
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

/* Names are the caller's. */
static kiriResult RefuseEdge(const kiriMeshData* mesh, const kiriMeshInput* input, TwinEntry a, TwinEntry b,
                             kiriFault* fault)
{
    int32_t h = a.half < 0 ? ~a.half : a.half, g = b.half < 0 ? ~b.half : b.half;
    int64_t first = mesh->triangles.data[h / 3].source, second = mesh->triangles.data[g / 3].source;
    KIRI_SAY(fault, "triangles %lld and %lld use the edge from vertex %lld to vertex %lld in the same direction",
             (long long)first, (long long)second, (long long)input->indices[3 * first + h % 3],
             (long long)input->indices[3 * first + (h + 1) % 3]);
    return KIRI_ERROR_MESH;
}

static kiriResult LinkTwins(kiriMeshData* mesh, const kiriMeshInput* input, const TwinWork* work, kiriFault* fault)
{
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        int32_t first = v > 0 ? work->end[v - 1] : 0;
        for (int32_t i = first; i < work->end[v]; ++i) {
            for (int32_t j = i + 1; j < work->end[v]; ++j) {
                if (work->entries[i].other == work->entries[j].other &&
                    !LinkEntries(mesh, work->entries[i], work->entries[j], work->hasDoubles)) {
                    return RefuseEdge(mesh, input, work->entries[i], work->entries[j], fault);
                }
            }
        }
    }
    return KIRI_OK;
}

static kiriResult FindTwins(kiriMeshData* mesh, const kiriMeshInput* input, kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    int64_t bytes = mesh->vertices.count * (int64_t)sizeof(int32_t);
    TwinWork work = { kiriMemory_Alloc(&scratch, bytes), false, kiriMemory_AllocZeroed(&scratch, bytes),
                      kiriMemory_AllocZeroed(&scratch, bytes),
                      kiriMemory_Alloc(&scratch, 3 * mesh->triangles.count * (int64_t)sizeof(TwinEntry)) };
    kiriResult result = KIRI_OK;
    if (work.point == NULL || work.degree == NULL || work.end == NULL || work.entries == NULL ||
        !FindPoints(mesh, &scratch, &work)) {
        result = KIRI_ERROR_MEMORY;
    } else {
        ListEdges(mesh, &work);
        result = LinkTwins(mesh, input, &work, fault);
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

static kiriResult CheckOverlaps(const kiriMeshData* mesh, kiriFault* fault)
{
    kiriMemory scratch = kiriMemory_Like(mesh->memory);
    kiriResult result = KIRI_OK;
    int32_t pair[2];
    if (!kiriOverlap_Find(mesh, &scratch, pair)) {
        result = KIRI_ERROR_MEMORY;
    } else if (pair[0] != KIRI_NONE) {
        KIRI_SAY(fault, "triangles %lld and %lld overlap", (long long)mesh->triangles.data[pair[0]].source,
                 (long long)mesh->triangles.data[pair[1]].source);
        result = KIRI_ERROR_MESH;
    }
    kiriMemory_FreeAll(&scratch);
    return result;
}

static kiriResult BuildMesh(kiriMeshData* mesh, const kiriMeshInput* input, kiriFault* fault)
{
    kiriLatticePoint extent = { 0, 0 };
    kiriResult result = CheckInput(input, fault);
    result = result == KIRI_OK ? TakeTriangles(mesh, input, &extent, fault) : result;
    result = result == KIRI_OK ? FindTwins(mesh, input, fault) : result;
    result = result == KIRI_OK ? CheckOverlaps(mesh, fault) : result;
    if (result != KIRI_OK) {
        return result;
    }
    if (!ClaimFans(mesh) || !kiriSquares_Init(&mesh->squares, mesh->memory, extent, input->resolution) ||
        !kiriMesh_FillSquares(mesh, &mesh->squares, mesh->memory)) {
        return KIRI_ERROR_MEMORY;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        kiriMesh_ListVertex(mesh, v);
    }
    return KIRI_OK;
}

kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshInput* input, kiriFault* fault)
{
    memset(mesh, 0, sizeof(*mesh));
    mesh->memory = memory;
    fault->line[0] = '\0';
    kiriResult result = BuildMesh(mesh, input, fault);
    if (result != KIRI_OK) {
        return result;
    }
    mesh->revision = 1;
    kiriMesh_Begin(mesh);
    return KIRI_OK;
}
