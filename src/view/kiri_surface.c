#include "kiri_surface.h"
#include "../core/kiri_lanes.h"
#include "kiri_skin.h"

/* ---- Fades ------------------------------------------------------------------------------------------------------- */

void kiriFades_Trim(kiriFades* fades, kiriMemory* memory)
{
    if (fades->fading.count == 0 && fades->fading.capacity > 0) {
        kiriArray_Release(memory, &fades->fading);
    }
}

void kiriFades_Keep(kiriFades* fades, const kiriKeep* samples)
{
    KIRI_KEEP_IF(kiriFading, at, fades->fading, (at->sample = kiriKeep_To(samples, at->sample)) != KIRI_NONE);
}

/* Moves the old fades to the end of the room. From there they are merged to the front with the new jumps. There is room for
   every sample, so the front stays behind. */
void kiriFades_Start(kiriFades* fades)
{
    kiriFading* data = fades->fading.data;
    int32_t count = fades->fading.count;
    fades->older = fades->fading.capacity - count;
    if (count > 0) {
        memmove(data + fades->older, data, sizeof(*data) * count);
    }
    fades->fading.count = 0;
}

void kiriFades_TakeJump(kiriFades* fades, int32_t sample, kiriVec3 offset)
{
    kiriFading older = { sample, 0.0, { 0.0, 0.0, 0.0 } };
    if (kiriFades_Has(fades, sample)) {
        older = fades->fading.data[fades->older++];
    }
    double jump = kiriVec3_Distance(offset, older.offset), length = kiriVec3_Length(older.offset);
    fades->jump = kiriMax(jump, fades->jump);
    if (fades->time > 0.0 && kiriVec3_Length(offset) > fades->least) {
        /* A jump on top of another: the mean of both times, weighted by lengths. */
        double sum = length + jump, left = sum > 0.0 ? (length * older.left + jump * fades->time) / sum : 0.0;
        KIRI_ASSERT(fades->fading.count < fades->older); /* Reserve has made room */
        KIRI_NEXT(fades->fading) = (kiriFading){ sample, left, offset };
    }
}

void kiriFades_Advance(kiriFades* fades, double dt)
{
    int32_t kept = 0;
    KIRI_EACH(const kiriFading, at, fades->fading) {
        kiriFading fading = *at;
        double share = dt < fading.left ? (fading.left - dt) / fading.left : 0.0;
        double length = kiriVec3_Length(fading.offset), left = share * length;
        left = left > fades->least ? left : 0.0;
        fades->move = kiriMax(length - left, fades->move);
        fading.left -= dt;
        fading.offset = kiriVec3_Scale(share, fading.offset);
        if (left > 0.0) {
            fades->fading.data[kept++] = fading;
        }
    }
    fades->fading.count = kept;
}

/* ---- Solid ------------------------------------------------------------------------------------------------------- */

typedef struct SolidArrays {
    float *positions, *normals, *restPositions;
    int32_t *sources, *indices;
    int32_t vertexCount, triangleCount;
} SolidArrays;

/* Adds a vertex, `above` (m) along the normal of the surface. */
static void AddSolidVertex(SolidArrays* to, const kiriSurface* surface, int32_t vertex, double above, kiriVec3 normal)
{
    int32_t n = to->vertexCount++;
    kiriVec3 out = kiriVec3_Load(&surface->normals.data[3 * vertex]);
    KIRI_ASSERT(vertex >= 0 && vertex < surface->vertexCount);
    kiriVec3_Store(&to->positions[3 * n], kiriVec3_AddScaled(kiriSurface_DrawnAt(surface, vertex), above, out));
    kiriVec3_Store(&to->normals[3 * n], normal);
    memcpy(&to->restPositions[2 * n], &surface->restPositions.data[2 * vertex], 2 * sizeof(float));
    to->sources[n] = vertex;
}

static void AddSolidTriangle(SolidArrays* to, int32_t a, int32_t b, int32_t c)
{
    const int32_t corners[3] = { a, b, c };
    memcpy(&to->indices[3 * to->triangleCount++], corners, sizeof(corners));
}

/* Adds the rim along an edge. It shares no vertices, so that it is flat and its edges are sharp. */
static void AddRim(SolidArrays* to, const kiriSurface* surface, int32_t a, int32_t b, double half)
{
    kiriVec3 along = kiriVec3_Sub(kiriSurface_DrawnAt(surface, b), kiriSurface_DrawnAt(surface, a));
    kiriVec3 up =
        kiriVec3_Add(kiriVec3_Load(&surface->normals.data[3 * a]), kiriVec3_Load(&surface->normals.data[3 * b]));
    kiriVec3 out = kiriVec3_Normalize(kiriVec3_Cross(along, up));
    int32_t first = to->vertexCount;
    KIRI_TIMES(k, 4) {
        AddSolidVertex(to, surface, k % 2 == 0 ? a : b, k < 2 ? half : -half, out);
    }
    AddSolidTriangle(to, first + 1, first, first + 2);
    AddSolidTriangle(to, first + 1, first + 2, first + 3);
}

bool kiriSolid_Build(kiriSolid* solid, kiriMemory* memory, const kiriSurface* surface, const kiriMeshData* mesh,
                     double thickness)
{
    const double half = 0.5 * thickness;
    int64_t borders = 0, halves = 3 * (int64_t)mesh->triangles.count;
    KIRI_ASSERT(mesh->triangles.count == surface->triangleCount);
    KIRI_TIMES(h, halves) {
        borders += kiriMesh_IsBorder(mesh, h);
    }
    int64_t vertices = 2 * (int64_t)surface->vertexCount + 4 * borders;
    int64_t triangles = 2 * (int64_t)surface->triangleCount + 2 * borders;
    float* block = vertices > INT32_MAX || triangles > INT32_MAX / 3
                       ? NULL
                       : kiriMemory_Alloc(memory, 8 * (int64_t)sizeof(float) * vertices +
                                                      (int64_t)sizeof(int32_t) * (vertices + 3 * triangles));
    if (block == NULL) {
        return false;
    }
    int32_t* sources = (int32_t*)(void*)(block + 8 * vertices);
    SolidArrays to = { block, block + 3 * vertices, block + 6 * vertices, sources, sources + vertices, 0, 0 };
    KIRI_TIMES(side, 2) {
        KIRI_TIMES(v, surface->vertexCount) {
            kiriVec3 normal = kiriVec3_Load(&surface->normals.data[3 * v]);
            AddSolidVertex(&to, surface, v, side == 0 ? half : -half, kiriVec3_Scale(side == 0 ? 1.0 : -1.0, normal));
        }
        for (int32_t t = 0, first = side * surface->vertexCount; t < surface->triangleCount; ++t) {
            const int32_t* corners = kiriSurface_Triangle(surface, t);
            AddSolidTriangle(&to, first + corners[0], first + corners[1 + side], first + corners[2 - side]);
        }
    }
    KIRI_TIMES(h, halves) {
        if (kiriMesh_IsBorder(mesh, h)) {
            AddRim(&to, surface, kiriMesh_Tail(mesh, h), kiriMesh_Head(mesh, h), half);
        }
    }
    KIRI_ASSERT(to.vertexCount == vertices && to.triangleCount == triangles);
    *solid = (kiriSolid){ to.positions, to.normals,     to.restPositions, to.indices,
                          to.sources,   to.vertexCount, to.triangleCount, 2 * surface->triangleCount };
    return true;
}

/* ---- Room -------------------------------------------------------------------------------------------------------- */

bool kiriSurface_Reserve(kiriSurface* surface, kiriMemory* memory, int64_t vertices, int64_t triangles,
                         int32_t frameCount)
{
    return kiriArrays_Reserve(memory, 3 * vertices + 1, &surface->positions, &surface->places) &&
           kiriArrays_Reserve(memory, 3 * vertices, &surface->before, &surface->normals, &surface->sourceWeights) &&
           kiriArray_Reserve(memory, &surface->restPositions, 2 * vertices) &&
           kiriArrays_Reserve(memory, vertices, &surface->sourceTriangles, &surface->rest) &&
           kiriArray_Reserve(memory, &surface->indices, 3 * triangles) &&
           kiriArray_Reserve(memory, &surface->slopes, 4 * vertices) &&
           kiriArray_Reserve(memory, &surface->turns, triangles / 2 + triangles % 2) &&
           kiriArrays_Reserve(memory, frameCount, &surface->carriers, &surface->bends) &&
           kiriPatches_Reserve(&surface->patches, memory, frameCount) &&
           kiriDetail_Reserve(&surface->detail, memory, vertices, triangles, frameCount);
}

void kiriSurface_Resize(kiriSurface* surface, int32_t vertices, int32_t triangles, int32_t frameCount)
{
    KIRI_ASSERT(3 * (int64_t)vertices < surface->positions.capacity &&
                4 * (int64_t)vertices <= surface->slopes.capacity);
    KIRI_ASSERT(3 * (int64_t)triangles <= surface->indices.capacity && frameCount <= surface->carriers.capacity);
    /* Places are written as soon as they are there: the tick in which a sheet comes far from the origin of the world
       shall not be the first to touch all of them. */
    if (3 * vertices > surface->places.count) {
        memset(surface->places.data + surface->places.count, 0,
               sizeof(float) * (3 * vertices - surface->places.count));
    }
    surface->positions.count = surface->places.count = surface->normals.count = 3 * vertices;
    surface->restPositions.count = 2 * vertices;
    surface->sourceWeights.count = 3 * vertices;
    surface->sourceTriangles.count = surface->rest.count = vertices;
    surface->slopes.count = 4 * vertices;
    surface->indices.count = 3 * triangles;
    surface->turns.count = triangles / 2 + triangles % 2;
    surface->carriers.count = surface->bends.count = frameCount;
    kiriDetail_Resize(&surface->detail, vertices, frameCount);
}

void kiriSurface_SetDetail(kiriSurface* surface, int32_t sweeps, bool isHeld)
{
    bool wasOn = kiriSurface_HasDetail(surface), isOther = sweeps != surface->detail.sweeps || isHeld != surface->detail.isHeld;
    surface->detail.sweeps = sweeps;
    surface->detail.isHeld = isHeld;
    bool isOn = kiriSurface_HasDetail(surface);
    if (isOther) {
        kiriDetail_Resize(&surface->detail, surface->vertexCount, surface->carriers.count);
        surface->isWritten = surface->isSteady = false;
        surface->pose += 1;
    }
    if (isOn != wasOn) {
        if (isOn && !kiriSurface_IsFar(surface) && surface->vertexCount > 0) {
            memcpy(surface->places.data, surface->positions.data, sizeof(float) * surface->positions.count);
        }
        kiriDetail_Draw(&surface->detail, surface->places.data, 0, isOn ? surface->vertexCount : 0);
    }
}

bool kiriSurface_ReserveHeld(kiriSurface* surface, kiriMemory* memory)
{
    kiriDetail detail = surface->detail;
    detail.isHeld = true;
    bool hasRoom = kiriDetail_Reserve(&detail, memory, surface->vertexCount, surface->triangleCount, surface->carriers.count);
    detail.isHeld = surface->detail.isHeld;
    surface->detail = detail;
    return hasRoom;
}

void kiriSurface_Remember(kiriSurface* surface)
{
    KIRI_ASSERT(3 * surface->vertexCount <= surface->before.capacity);
    surface->before.count = 3 * surface->vertexCount;
    surface->middleBefore = surface->middle;
    memcpy(surface->before.data, kiriSurface_Places(surface), sizeof(float) * surface->before.count);
}

/* ---- Topology ---------------------------------------------------------------------------------------------------- */

static void WriteSource(kiriSurface* surface, const kiriMeshData* mesh, int32_t v)
{
    KIRI_ASSERT_HAS(surface->sourceTriangles, v);
    surface->sourceTriangles.data[v] = mesh->vertices.data[v].source;
    kiriMesh_GetShare(mesh, v, &surface->sourceWeights.data[3 * v]);
}

static void WriteTurn(kiriSurface* surface, int32_t pair)
{
    KIRI_ASSERT_HAS(surface->turns, pair);
    const int32_t* indices = &surface->indices.data[6 * pair];
    surface->turns.data[pair] = kiriNormals_TurnOf(indices, 2 * pair + 1 == surface->triangleCount);
}

static void Extend(kiriRange* range, int32_t index)
{
    int32_t low = range->count == 0 || index < range->first ? index : range->first;
    int32_t end = range->count == 0 || index >= range->first + range->count ? index + 1 : range->first + range->count;
    range->first = low;
    range->count = end - low;
}

static void WriteTriangle(kiriSurface* surface, const kiriMeshData* mesh, int32_t t)
{
    KIRI_ASSERT_HAS(mesh->triangles, t);
    memcpy(kiriSurface_Triangle(surface, t), mesh->triangles.data[t].vertex, 3 * sizeof(int32_t));
}

/* The journal has more triangles than change: those with another neighbour. */
static void WriteOldTriangles(kiriSurface* surface, const kiriMeshData* mesh, kiriChange* change)
{
    KIRI_EACH_LISTED(t, mesh->changedTriangles) {
        const int32_t* vertex = mesh->triangles.data[t].vertex;
        if (t < change->oldTriangleCount &&
            memcmp(vertex, kiriSurface_Triangle(surface, t), 3 * sizeof(int32_t)) != 0) {
            WriteTriangle(surface, mesh, t);
            Extend(&change->triangles, t);
        }
    }
    /* When all of them are written: two that share an edge may both change. */
    KIRI_EACH_LISTED(changed, mesh->changedTriangles) {
        if (changed < change->oldTriangleCount) {
            WriteTurn(surface, changed / 2);
        }
    }
}

void kiriSurface_Derive(kiriSurface* surface, const kiriMeshData* mesh, int32_t firstVertex, int32_t firstTriangle)
{
    KIRI_ASSERT(surface->vertexCount == mesh->vertices.count && surface->triangleCount == mesh->triangles.count);
    KIRI_ASSERT(surface->rest.count == surface->vertexCount && surface->indices.count == 3 * surface->triangleCount);
    surface->origin = mesh->origin;
    surface->longer = KIRI_LATTICE * mesh->step;
    KIRI_FROM_TO(v, firstVertex, surface->vertexCount) {
        surface->rest.data[v] = kiriMesh_LocalOf(mesh, v);
        kiriVec2_Store(&surface->restPositions.data[2 * v], kiriVec2_Add(mesh->origin, surface->rest.data[v]));
        WriteSource(surface, mesh, v);
    }
    KIRI_FROM_TO(t, firstTriangle, surface->triangleCount) {
        WriteTriangle(surface, mesh, t);
    }
    KIRI_FROM_TO(pair, firstTriangle / 2, surface->turns.count) {
        WriteTurn(surface, pair);
    }
}

void kiriSurface_WriteTopology(kiriSurface* surface, const kiriMeshData* mesh)
{
    kiriChange change = {
        surface->revision, mesh->revision, surface->vertexCount, surface->triangleCount, { 0, 0 }, { 0, 0 }
    };
    surface->pose += 1;
    surface->isWritten = surface->isSteady = false;
    surface->before.count = 0;
    surface->revision = mesh->revision;
    surface->vertexCount = mesh->vertices.count;
    surface->triangleCount = mesh->triangles.count;
    kiriSurface_Derive(surface, mesh, change.oldVertexCount, change.oldTriangleCount);
    /* Vertices never move in the rest plane, but a tear may give one to another triangle of the caller. */
    KIRI_EACH_LISTED(v, mesh->changedVertices) {
        if (v < change.oldVertexCount && mesh->vertices.data[v].source != surface->sourceTriangles.data[v]) {
            WriteSource(surface, mesh, v);
            Extend(&change.vertices, v);
        }
    }
    WriteOldTriangles(surface, mesh, &change);
    if (change.oldVertexCount > 0 && change.from != change.to) {
        surface->lastChange = (surface->lastChange + 1) % KIRI_CHANGES;
        surface->changes[surface->lastChange] = change;
        surface->changeCount += surface->changeCount < KIRI_CHANGES ? 1 : 0;
    }
}

/* Extends a range by the part of another one below `end`. Items from there on are new. */
static void Unite(kiriRange* range, kiriRange more, int32_t end)
{
    if (more.count > 0 && more.first < end) {
        int32_t last = more.first + more.count - 1;
        Extend(range, more.first);
        Extend(range, kiriMin(last, end - 1));
    }
}

void kiriSurface_GetDirty(const kiriSurface* surface, uint32_t sinceRevision, kiriDirty* dirty)
{
    KIRI_CLEAR(dirty);
    dirty->revision = surface->revision;
    int32_t back = 0, vertices = surface->vertexCount, triangles = surface->triangleCount;
    uint32_t at = surface->revision;
    while (at != sinceRevision && back < surface->changeCount) {
        const kiriChange* change = &surface->changes[(surface->lastChange + KIRI_CHANGES - back) % KIRI_CHANGES];
        at = change->from;
        vertices = change->oldVertexCount;
        triangles = change->oldTriangleCount;
        ++back;
    }
    if (at != sinceRevision) {
        vertices = triangles = back = 0;
    }
    dirty->newVertices = (kiriRange){ vertices, surface->vertexCount - vertices };
    dirty->newTriangles = (kiriRange){ triangles, surface->triangleCount - triangles };
    KIRI_TIMES(i, back) {
        const kiriChange* change = &surface->changes[(surface->lastChange + KIRI_CHANGES - i) % KIRI_CHANGES];
        Unite(&dirty->oldVertices, change->vertices, vertices);
        Unite(&dirty->oldTriangles, change->triangles, triangles);
    }
}

/* ---- Hidden triangles -------------------------------------------------------------------------------------------- */

void kiriSurface_HideTriangle(kiriSurface* surface, int32_t triangle)
{
    int32_t* corners = kiriSurface_Triangle(surface, triangle);
    KIRI_ASSERT(triangle >= 0 && triangle < surface->triangleCount);
    corners[1] = corners[2] = corners[0];
    WriteTurn(surface, triangle / 2);
}

/* ---- Compaction -------------------------------------------------------------------------------------------------- */

/* The arrays that the host may hold: numbers an item, and which items. */
#define HOST_ARRAYS(X)                                                                                                 \
    X(positions, 3, vertices)                                                                                          \
    X(normals, 3, vertices)                                                                                            \
    X(restPositions, 2, vertices)                                                                                      \
    X(sourceWeights, 3, vertices)                                                                                      \
    X(sourceTriangles, 1, vertices)                                                                                    \
    X(indices, 3, triangles)

bool kiriShown_Reserve(kiriShown* shown, kiriMemory* memory, const kiriKeep* triangles, const kiriKeep* vertices)
{
    bool ok = true;
    KIRI_CLEAR(shown);
#define RESERVE_HOST_ARRAY(name, each, of)                                                                             \
    ok = ok && kiriArray_Reserve(memory, &shown->name, (each) * (int64_t)(of)->count + 1);
    HOST_ARRAYS(RESERVE_HOST_ARRAY)
    return ok;
}

void kiriShown_Release(kiriShown* shown, kiriMemory* memory)
{
#define RELEASE_HOST_ARRAY(name, each, of) kiriArray_Release(memory, &shown->name);
    HOST_ARRAYS(RELEASE_HOST_ARRAY)
}

void kiriShown_Take(const kiriKeep* keep, void* array, const void* fresh, int32_t each, kiriMemory* retired)
{
    kiriArrayHeader was = kiriArray_GetHeader(array), is = kiriArray_GetHeader(fresh);
    kiriKeep_Copy(keep, is.data, was.data, 4 * (size_t)each);
    is.count = each * keep->count;
    KIRI_ASSERT(is.count <= is.capacity);
    kiriArray_SetHeader(array, is);
    kiriMemory_Adopt(retired, was.data);
}

void kiriSurface_Keep(kiriSurface* surface, kiriShown* shown, const kiriKeep* triangles, const kiriKeep* vertices,
                      const kiriMeshData* mesh, int32_t frameCount, kiriMemory* retired)
{
    kiriSurface_NeedNormals(surface); /* in another order sums have other bits */
#define TAKE_HOST_ARRAY(name, each, of) kiriShown_Take(of, &surface->name, &shown->name, each, retired);
    HOST_ARRAYS(TAKE_HOST_ARRAY)
    kiriKeep_Compact(vertices, &surface->rest, 1, sizeof(kiriVec2));
    kiriKeep_Compact(vertices, &surface->places, 3, sizeof(float));
    kiriKeep_Compact(vertices, &surface->before, 3, sizeof(float));
    if (kiriSurface_HasDetail(surface)) {
        kiriKeep_Compact(vertices, &surface->detail.offsets, 3, sizeof(float));
        kiriKeep_Compact(vertices, &surface->detail.drawn, 3, sizeof(float));
        kiriDetail_Resize(&surface->detail, vertices->count, frameCount);
    }
    surface->slopes.count = 4 * vertices->count;
    surface->hasSlopes = false;
    surface->carriers.count = surface->bends.count = frameCount;
    surface->vertexCount = vertices->count;
    surface->triangleCount = triangles->count;
    surface->revision = mesh->revision;
    surface->changeCount = 0;
    surface->pose += 1;
    surface->isWritten = surface->isSteady = false;
    kiriPatches_Forget(&surface->patches);
    surface->turns.count = surface->triangleCount / 2 + surface->triangleCount % 2;
    KIRI_TIMES(t, triangles->first) { /* their vertices have other indices, their turns stay */
        WriteTriangle(surface, mesh, t);
    }
    kiriSurface_Derive(surface, mesh, surface->vertexCount, triangles->first);
}

/* ---- Copies ------------------------------------------------------------------------------------------------------ */

static void CopyStrided(const float* from, int32_t count, void* to, int32_t stride)
{
    KIRI_TIMES_WHILE(to != NULL, i, count) {
        memcpy((char*)to + (int64_t)i * stride, from + 3 * (int64_t)i, 3 * sizeof(float));
    }
}

void kiriSurface_CopyVertices(const kiriSurface* surface, int32_t first, int32_t count, void* positions,
                              int32_t positionStride, void* normals, int32_t normalStride)
{
    if (count > 0) {
        CopyStrided(surface->positions.data + 3 * first, count, positions, positionStride);
        CopyStrided(surface->normals.data + 3 * first, count, normals, normalStride);
    }
}

bool kiriSurface_CopyIndices16(const kiriSurface* surface, int32_t firstTriangle, int32_t count, uint16_t* indices)
{
    if (surface->vertexCount > UINT16_MAX) {
        return false;
    }
    for (int64_t i = 0; i < 3 * (int64_t)count; ++i) {
        indices[i] = (uint16_t)surface->indices.data[3 * firstTriangle + i];
    }
    return true;
}

/* ---- Positions --------------------------------------------------------------------------------------------------- */

static double RoundToFloats(double x, double unit)
{
    double steps = x / unit;
    if (steps > -1e15 && steps < 1e15) {
        x = unit * (double)(int64_t)(steps < 0.0 ? steps - 0.5 : steps + 0.5);
    }
    return (float)x;
}

/* Returns the middle of the frames, rounded to a power of two between two and four times the longer side: so it is 0 for all
   sheets near the origin of the world, and seldom changes. */
static kiriVec3 FindMiddle(const kiriFrameData* frames, int32_t frameCount, double longer)
{
    double unit = 1.0;
    while (unit < 2.0 * longer) {
        unit *= 2.0;
    }
    while (unit > 4.0 * longer) {
        unit *= 0.5;
    }
    kiriVec3 sum = { 0 };
    KIRI_TIMES(i, frameCount) {
        sum = kiriVec3_AddScaled(sum, 1.0 / frameCount, frames[i].x);
    }
    return kiriVec3_Make(RoundToFloats(sum.x, unit), RoundToFloats(sum.y, unit), RoundToFloats(sum.z, unit));
}

void kiriSurface_TakeFrames(kiriSurface* surface, const kiriFrameData* frames, int32_t frameCount,
                            const kiriPulls* pulls, const kiriIndices* moved, const kiriIndices* movedLinks)
{
    bool isBent = surface->skinning == KIRI_SKINNING_SMOOTH && pulls->count > 0;
    kiriVec3 was = surface->middle, middle = FindMiddle(frames, frameCount, surface->longer);
    surface->middle = middle;
    if (!kiriVec3_Equal(was, middle)) {
        kiriPatches_Forget(&surface->patches);
    }
    surface->isPartly = moved != NULL && surface->isSteady && surface->patches.isBent == isBent &&
                        surface->patches.count == frameCount;
    const kiriIndices* some = surface->isPartly ? moved : NULL;
    kiriCarriers_Write(surface->carriers.data, frames, frameCount, some);
    if (isBent) {
        kiriCarriers_Fit(surface->carriers.data, surface->bends.data, frames, frameCount, pulls, some,
                         surface->isPartly ? movedLinks : NULL);
    }
    bool isOther = kiriPatches_Write(&surface->patches, surface->carriers.data, frameCount, middle, isBent, some);
    surface->isWritten = surface->isWritten && !isOther;
}

void kiriSurface_BlendRange(kiriSurface* surface, const kiriSkin* skin, int32_t begin, int32_t end)
{
    kiriSkin_WritePositions(skin, &surface->patches, surface->rest.data, begin, end, kiriSurface_Places(surface));
}

void kiriSurface_AddFades(kiriSurface* surface, const kiriFades* fades)
{
    KIRI_EACH(const kiriFading, at, fades->fading) {
        kiriFading fading = *at;
        kiriSurface_Place(surface, fading.sample, kiriVec3_Add(kiriSurface_At(surface, fading.sample), fading.offset));
    }
}

void kiriSurface_DrawRange(kiriSurface* surface, int32_t begin, int32_t end)
{
    if (kiriSurface_HasDetail(surface)) {
        kiriDetail_Draw(&surface->detail, surface->places.data, begin, end);
    }
}

static kiriCorners CornersOfSurface(const kiriSurface* surface)
{
    return (kiriCorners){ surface->indices.data, surface->turns.data, surface->triangleCount };
}

static void SumSlopes(kiriSurface* surface)
{
    kiriCorners corners = CornersOfSurface(surface);
    surface->hasSlopes = true;
    kiriNormals_Sum(surface->slopes.data, surface->vertexCount, kiriSurface_Drawn(surface), &corners);
}

bool kiriSurface_SumNormal(kiriSurface* surface, const kiriMeshData* mesh, int32_t vertex)
{
    KIRI_ASSERT_HAS(mesh->vertices, vertex);
    kiriCorners corners = CornersOfSurface(surface);
    return kiriNormals_SumOne(surface->slopes.data, vertex, kiriSurface_Drawn(surface), &corners, mesh);
}

void kiriSurface_SumNormals(kiriSurface* surface)
{
    surface->pose += 1;
    surface->hasNormals = surface->hasSlopes = surface->wantsNormals;
    if (surface->hasNormals) {
        SumSlopes(surface);
    }
}

void kiriSurface_WriteRange(kiriSurface* surface, int32_t begin, int32_t end)
{
    const kiriVec3 m = surface->middle;
    const float middle[6] = { (float)m.x, (float)m.y, (float)m.z, (float)m.x, (float)m.y, (float)m.z };
    const float* drawn = kiriSurface_Drawn(surface);
    const ptrdiff_t last = drawn != surface->positions.data ? 3 * end : 0;
    ptrdiff_t i = 3 * begin;
    KIRI_ASSERT(begin >= 0 && begin <= end && end <= surface->vertexCount);
    /* Four vertices at a time are three lanes: x, y, z, x and so on. */
    for (; i + 12 <= last; i += 12) {
        KIRI_EACH_CORNER(k) {
            kiriLanes local = kiriLanes_Load(drawn + i + 4 * k);
            kiriLanes_Store(surface->positions.data + i + 4 * k, kiriLanes_Add(kiriLanes_Load(middle + k), local));
        }
    }
    for (; i < last; ++i) {
        surface->positions.data[i] = middle[i % 3] + drawn[i];
    }
    if (surface->hasNormals) {
        kiriNormals_Write(surface->normals.data, surface->slopes.data, begin, end);
    }
}

void kiriSurface_NeedNormals(kiriSurface* surface)
{
    if (!surface->hasNormals) {
        surface->hasNormals = true;
        SumSlopes(surface);
        kiriNormals_Write(surface->normals.data, surface->slopes.data, 0, surface->vertexCount);
    }
}

/* ---- Saves ------------------------------------------------------------------------------------------------------- */

KIRI_SHARED_TABLE(kiriSkinTable, kiriSkin, {
    KIRI_DERIVED,
    KIRI_ARRAYS(spans, weights, staged),
})

KIRI_SHARED_TABLE(kiriPlacesTable, kiriPlaces, {
    KIRI_DERIVED,
    KIRI_ARRAYS(head, next),
})

/* The stencil is gathered again. */
static void ForgetStencil(kiriArchive* archive, void* object)
{
    if (kiriArchive_Reads(archive)) {
        ((kiriRefresh*)object)->stencil.cell = KIRI_NONE;
    }
}

KIRI_SHARED_TABLE(kiriRefreshTable, kiriRefresh, {
    KIRI_DERIVED,
    KIRI_ARRAYS(noted, squares, marks),
    KIRI_ROOM_OF(joined),
    KIRI_DROPPED(stencil, mean),
    KIRI_CUSTOM(stencil, ForgetStencil),
})

KIRI_TABLE(FadingTable, kiriFading, {
    KIRI_WITHIN(0, INT32_MAX, sample),
    KIRI_REALS(left, offset),
})

KIRI_SHARED_TABLE(kiriFadesTable, kiriFades, {
    KIRI_REALS(time, least),
    KIRI_PARTS(fading, FadingTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, older),
    KIRI_REALS(jump, move),
})

KIRI_TABLE(PatchesTable, kiriPatches, {
    KIRI_FLOAT_ITEMS(floats),
    KIRI_ITEMS(1, isOther),
    KIRI_WITHIN(0, INT32_MAX, count),
    KIRI_BOOLS(isBent, areOther),
})

KIRI_TABLE(DetailTable, kiriDetail, {
    KIRI_HANDED,
    KIRI_WITHIN(0, KIRI_MOST_DETAIL, sweeps),
    KIRI_FLOAT_ITEMS(offsets),
    KIRI_UNHASHED,
    KIRI_BOOLS(isHeld),
    KIRI_DROPPED(longest),
    KIRI_DROPPED(isListed),
    KIRI_DERIVED,
    KIRI_ARRAYS(drawn, moving, vertices, edges, awake, shifts),
})

KIRI_SHARED_TABLE(kiriSurfaceTable, kiriSurface, {
    KIRI_FLOAT_ITEMS(before),
    KIRI_REALS(middleBefore),
    KIRI_PART(detail, DetailTable),
    KIRI_UNHASHED,
    KIRI_HANDED,
    KIRI_WITHIN(KIRI_SKINNING_LINEAR, KIRI_SKINNING_SMOOTH, skinning),
    KIRI_RUN(4, revision),
    KIRI_COUNTS(pose),
    KIRI_REALS(middle),
    KIRI_ITEMS(8, carriers),
    KIRI_PART(patches, PatchesTable),
    KIRI_BOOLS(isWritten, hasNormals),
    KIRI_RUN(4, changes),
    KIRI_WITHIN(0, KIRI_CHANGES, changeCount),
    KIRI_WITHIN(0, KIRI_CHANGES - 1, lastChange),
    KIRI_DROPPED(hasSlopes),
    KIRI_DERIVED,
    KIRI_ARRAYS(positions, normals, restPositions, sourceWeights, indices, sourceTriangles),
    KIRI_ARRAYS(rest, turns, slopes, places, bends),
})

bool kiriFades_AreSound(const kiriFades* fades, int32_t samples)
{
    bool areFine = true;
    KIRI_EACH_INDEX_WHILE(areFine, k, fades->fading) {
        int32_t before = k > 0 ? fades->fading.data[k - 1].sample : KIRI_NONE, sample = fades->fading.data[k].sample;
        areFine = before < sample && sample < samples && fades->fading.data[k].left > 0.0;
    }
    return areFine;
}

/* Hosts copy these ranges. */
static bool IsRangeUpTo(kiriRange range, int32_t end)
{
    return range.first >= 0 && range.count >= 0 && range.first + (int64_t)range.count <= end;
}

bool kiriSurface_AreChangesSound(const kiriSurface* surface)
{
    bool areFine = true;
    KIRI_TIMES(k, surface->changeCount) {
        const kiriChange* change = &surface->changes[(surface->lastChange + KIRI_CHANGES - k) % KIRI_CHANGES];
        areFine = areFine && change->oldVertexCount >= 0 && change->oldVertexCount <= surface->vertexCount &&
                  change->oldTriangleCount >= 0 && change->oldTriangleCount <= surface->triangleCount &&
                  IsRangeUpTo(change->vertices, surface->vertexCount) &&
                  IsRangeUpTo(change->triangles, surface->triangleCount);
    }
    return areFine;
}
