#include "kiri_call.h"
#include "../motion/kiri_energy.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_update.h"
#include "../view/kiri_bounds.h"
#include "../view/kiri_surface.h"

#include <float.h>

kiriResult kiriSheet_GetMesh(const kiriWorld* world, kiriSheet sheet, kiriMesh* mesh)
{
    KIRI_READS_OF(sheet, mesh);
    const kiriSurface* surface = &found->seen.surface;
    mesh->positions = surface->positions.data;
    mesh->normals = surface->wantsNormals ? surface->normals.data : NULL;
    mesh->restPositions = surface->restPositions.data;
    mesh->indices = surface->indices.data;
    mesh->sourceTriangles = surface->sourceTriangles.data;
    mesh->sourceWeights = surface->sourceWeights.data;
    mesh->vertexCount = surface->vertexCount;
    mesh->triangleCount = surface->triangleCount;
    mesh->revision = world->loadedAt + surface->revision;
    return KIRI_OK;
}

kiriResult kiriSheet_GetDirty(const kiriWorld* world, kiriSheet sheet, uint32_t sinceRevision, kiriDirty* dirty)
{
    KIRI_READS_OF(sheet, dirty);
    kiriSurface_GetDirty(&found->seen.surface, sinceRevision - world->loadedAt, dirty);
    dirty->revision += world->loadedAt;
    return KIRI_OK;
}

/* The next tick frees the arrays. */
kiriResult kiriSheet_GetSolid(kiriWorld* world, kiriSheet sheet, float thickness, kiriSolid* solid)
{
    KIRI_PREPARES(world);
    KIRI_CHECK_OUT(solid);
    KIRI_CHECK_NUMBER(thickness, 0.0f, FLT_MAX);
    KIRI_FIND(sheet);
    kiriSurface_NeedNormals(&found->seen.surface);
    double thick = thickness > 0.0f ? thickness : found->settings.material.thickness;
    bool ok = kiriSolid_Build(solid, &world->retired, &found->seen.surface, &found->mesh, thick);
    KIRI_RETURN(ok ? KIRI_OK : KIRI_ERROR_MEMORY);
}

/* Checks that items first to first + count - 1 are among all. */
#define CHECK_RANGE(first, count, all)                                                                                 \
    KIRI_CHECK_NUMBER(first, 0, all);                                                                                  \
    KIRI_CHECK_NUMBER(count, 0, (all) - (first))

kiriResult kiriSheet_CopyVertices(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                  void* positions, int32_t positionStride, void* normals, int32_t normalStride)
{
    KIRI_READS(world);
    KIRI_CHECK_NUMBER(positionStride, positions == NULL ? INT32_MIN : 12, INT32_MAX);
    KIRI_CHECK_NUMBER(normalStride, normals == NULL ? INT32_MIN : 12, INT32_MAX);
    KIRI_FIND(sheet);
    CHECK_RANGE(first, count, found->seen.surface.vertexCount);
    KIRI_REQUIRE(normals == NULL || found->seen.surface.wantsNormals, KIRI_ERROR_STATE, "the sheet makes no normals");
    kiriSurface_CopyVertices(&found->seen.surface, first, count, positions, positionStride, normals, normalStride);
    return KIRI_OK;
}

kiriResult kiriSheet_CopyPrevious(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                  int32_t* vertices, kiriSheet* from)
{
    KIRI_READS(world);
    KIRI_CHECK((count == 0 || vertices != NULL) && from != NULL, "vertices or from is null");
    KIRI_FIND(sheet);
    CHECK_RANGE(first, count, found->seen.surface.vertexCount);
    const kiriPast past = kiriPast_At(&found->past, world->begun);
    KIRI_TIMES(i, count) {
        vertices[i] = kiriPast_IndexOf(&past, first + i);
    }
    *from = past.sheet != 0 ? past.sheet : sheet;
    return KIRI_OK;
}

/* Begins a function that copies data of triangles. */
#define READS_TRIANGLES(out)                                                                                           \
    KIRI_READS(world);                                                                                                 \
    KIRI_CHECK(count == 0 || (out) != NULL, #out " is null");                                                          \
    KIRI_FIND(sheet);                                                                                                  \
    CHECK_RANGE(firstTriangle, count, found->seen.surface.triangleCount)

kiriResult kiriSheet_CopyIndices16(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                   uint16_t* indices)
{
    READS_TRIANGLES(indices);
    KIRI_REQUIRE(kiriSurface_CopyIndices16(&found->seen.surface, firstTriangle, count, indices), KIRI_ERROR_STATE,
                 "16 bits are not enough for so many vertices");
    return KIRI_OK;
}

kiriResult kiriSheet_CopySources(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                 int32_t* sources)
{
    READS_TRIANGLES(sources);
    KIRI_TIMES(i, count) {
        sources[i] = found->mesh.triangles.data[firstTriangle + i].source;
    }
    return KIRI_OK;
}

kiriResult kiriSheet_CopySourceWeights(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                       float* weights)
{
    READS_TRIANGLES(weights);
    for (int64_t i = 0; i < 3 * (int64_t)count; ++i) {
        const kiriTriangle* triangle = &found->mesh.triangles.data[firstTriangle + i / 3];
        kiriMesh_GetShareIn(&found->mesh, triangle->vertex[i % 3], triangle->source, &weights[3 * i]);
    }
    return KIRI_OK;
}

kiriResult kiriSheet_GetCollisionPoints(const kiriWorld* world, kiriSheet sheet, const float** positions,
                                        int32_t* count)
{
    KIRI_READS_OF(sheet, positions);
    KIRI_CHECK_OUT(count);
    *positions = found->seen.pointPositions.data;
    *count = found->points.count;
    return KIRI_OK;
}

kiriResult kiriSheet_GetCounts(const kiriWorld* world, kiriSheet sheet, kiriCounts* counts)
{
    KIRI_READS_OF(sheet, counts);
    counts->vertices = found->mesh.vertices.count;
    counts->triangles = found->mesh.triangles.count;
    counts->cells = found->grid.cellCount;
    counts->frames = found->frames.count;
    counts->links = found->links.links.count;
    counts->pieces = found->layout.pieces.count;
    counts->collisionPoints = found->points.count;
    return KIRI_OK;
}

kiriResult kiriSheet_GetTotals(const kiriWorld* world, kiriSheet sheet, kiriTotals* totals)
{
    KIRI_READS_OF(sheet, totals);
    *totals = kiriMotion_Totals(found);
    return KIRI_OK;
}

kiriResult kiriSheet_IsAwake(const kiriWorld* world, kiriSheet sheet, int32_t* awake)
{
    KIRI_READS_OF(sheet, awake);
    *awake = !found->rest.asleep;
    return KIRI_OK;
}

kiriResult kiriSheet_Wake(kiriWorld* world, kiriSheet sheet)
{
    KIRI_CHANGES(Sheet_Wake, &sheet);
    kiriSheet_WakeAll(call->sheet);
    KIRI_RETURN(KIRI_OK);
}

/* ---- Rays ---- */

#define CHECK_RAY()                                                                                                    \
    KIRI_CHECK_OUT(hit);                                                                                               \
    KIRI_CHECK_FLOATS(origin, 3);                                                                                      \
    KIRI_CHECK_FLOATS(direction, 3);                                                                                   \
    KIRI_CHECK_NUMBER(maxDistance, 0.0f, FLT_MAX);                                                                     \
    KIRI_CHECK(direction[0] != 0.0f || direction[1] != 0.0f || direction[2] != 0.0f, "direction is zero")

static void CastRay(const kiriSheetData* sheet, const float origin[3], const float direction[3], float maxDistance,
                    kiriHit* hit)
{
    kiriBounds_Ask(sheet->seen.bounds);
    kiriSurface_Raycast(&sheet->seen.surface, sheet->seen.bounds, kiriVec3_Load(origin),
                        kiriVec3_Normalize(kiriVec3_Load(direction)), maxDistance, hit);
}

kiriResult kiriSheet_Raycast(const kiriWorld* world, kiriSheet sheet, const float origin[3], const float direction[3],
                             float maxDistance, kiriHit* hit)
{
    KIRI_READS(world);
    CHECK_RAY();
    KIRI_FIND(sheet);
    CastRay(found, origin, direction, maxDistance, hit);
    return KIRI_OK;
}

/* Among sheets at the same distance the first one counts. */
kiriResult kiriWorld_Raycast(const kiriWorld* world, const float origin[3], const float direction[3], float maxDistance,
                             kiriSheet* sheet, kiriHit* hit)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(sheet);
    CHECK_RAY();
    *sheet = 0;
    KIRI_CLEAR(hit);
    hit->triangle = KIRI_NONE;
    KIRI_EACH_OF(kiriSheetData, other, world->sheets) {
        kiriHit next;
        CastRay(other, origin, direction, maxDistance, &next);
        if (next.triangle != KIRI_NONE && (*sheet == 0 || next.distance < hit->distance)) {
            *sheet = other->id;
            *hit = next;
            maxDistance = next.distance;
        }
    }
    return KIRI_OK;
}

kiriResult kiriSheet_EstimateError(const kiriWorld* world, kiriSheet sheet, double* relative)
{
    KIRI_READS_OF(sheet, relative);
    KIRI_REQUIRE(found->settings.mechanics.model == KIRI_MODEL_LINKS, KIRI_ERROR_STATE,
                 "only sheets of KIRI_MODEL_LINKS have an estimate");
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    int64_t shares = found->layout.pinShares.count;
    kiriCall_BeginCallbacks(world);
    kiriClampRow* clamps = shares > 0 ? kiriMemory_Alloc(&scratch, shares * (int64_t)sizeof(*clamps)) : NULL;
    bool ok = (shares == 0 || clamps != NULL) &&
              kiriEstimate_Error(&scratch, found->frames.data, found->frames.count, found->links.links.data,
                                 found->links.links.count, clamps, kiriPins_WriteClamps(found, clamps),
                                 &found->settings.material, found->layout.framePiece.data, world->gravity, relative);
    kiriMemory_Free(&scratch, clamps);
    kiriCall_EndCallbacks(world);
    return ok ? KIRI_OK : KIRI_FAIL(KIRI_ERROR_MEMORY, "out of memory");
}

kiriResult kiriSheet_GetPoint(const kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriPointState* state)
{
    KIRI_READS_OF(sheet, state);
    KIRI_CHECK_FLOATS(restPoint, 2);
    kiriLatticePoint at;
    kiriPointPlace place;
    KIRI_CHECK_INSIDE(kiriSheet_ToLattice(found, restPoint, &at) && kiriPoint_Find(found, at, &place), restPoint);
    KIRI_ASSERT(place.triangle >= 0 && place.triangle < found->mesh.triangles.count);
    int32_t frame = kiriOwner_At(found, at);
    KIRI_CHECK(frame != KIRI_NONE, "restPoint lies in a piece that is destroyed");
    kiriVec3_Store(state->position, kiriPoint_Drawn(found, &place));
    kiriVec3_Store(state->normal, kiriPoint_Normal(found, &place));
    kiriVec3_Store(state->velocity, kiriPoint_Blend(found, &place).velocity);
    state->frame = found->frames.data[frame].id;
    return KIRI_OK;
}

kiriResult kiriSheet_GetWeights(const kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriFrame* frames,
                                float* weights, float* gradients, int32_t capacity, int32_t* count)
{
    KIRI_READS_OF(sheet, count);
    KIRI_CHECK_FLOATS(restPoint, 2);
    KIRI_CHECK(capacity == 0 || (capacity > 0 && frames != NULL && weights != NULL),
               "capacity without frames and weights");
    KIRI_REQUIRE(kiriUpdate_IsFieldCurrent(found->update), KIRI_ERROR_STATE,
                 "a cut is being worked on; ask again when its work is done");
    kiriLatticePoint at;
    bool inRange = kiriSheet_ToLattice(found, restPoint, &at);
    int32_t cell = inRange ? kiriGrid_CellAt(&found->grid, at) : KIRI_NONE;
    KIRI_CHECK_INSIDE(cell != KIRI_NONE, restPoint);
    kiriPointWeights point = { 0 };
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    kiriCall_BeginCallbacks(world);
    bool ok = kiriShape_At(&found->shape, &scratch, &found->grid, cell, kiriMesh_Local(&found->mesh, at), &point);
    for (int32_t i = 0; ok && i < point.count && i < capacity; ++i) {
        KIRI_ASSERT(point.data[i].frame >= 0 && point.data[i].frame < found->frames.count);
        frames[i] = found->frames.data[point.data[i].frame].id;
        weights[i] = (float)point.data[i].value;
        if (gradients != NULL) {
            gradients[2 * i] = (float)point.data[i].gradient.x;
            gradients[2 * i + 1] = (float)point.data[i].gradient.y;
        }
    }
    *count = ok ? point.count : *count;
    kiriMemory_FreeAll(&scratch);
    kiriCall_EndCallbacks(world);
    return ok ? KIRI_OK : KIRI_FAIL(KIRI_ERROR_MEMORY, "out of memory");
}
