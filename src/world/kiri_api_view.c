#include "kiri_call.h"
#include "../motion/kiri_energy.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_update.h"
#include "../view/kiri_bounds.h"
#include "../view/kiri_surface.h"
#include "kiri_draw.h"

#include <string.h>

kiriResult kiriSheet_GetMesh(const kiriWorld* world, kiriSheet sheet, kiriMesh* mesh)
{
    KIRI_READS(world);
    KIRI_CHECK(mesh != NULL, "mesh is null");
    KIRI_FIND_SHEET(data, sheet);
    const kiriSurface* surface = &data->seen.surface;
    kiriSurface_LendIndices(surface, world->ticks);
    mesh->positions = surface->positions.data;
    mesh->normals = surface->wantsNormals ? surface->normals.data : NULL;
    mesh->restPositions = surface->restPositions.data;
    mesh->indices = surface->indices.data;
    mesh->sourceTriangles = surface->sourceTriangles.data;
    mesh->sourceWeights = surface->sourceWeights.data;
    mesh->vertexCount = surface->vertexCount;
    mesh->triangleCount = surface->triangleCount;
    mesh->revision = surface->revision;
    return KIRI_OK;
}

kiriResult kiriSheet_GetDirty(const kiriWorld* world, kiriSheet sheet, uint32_t sinceRevision, kiriDirty* dirty)
{
    KIRI_READS(world);
    KIRI_CHECK(dirty != NULL, "dirty is null");
    KIRI_FIND_SHEET(data, sheet);
    kiriSurface_GetDirty(&data->seen.surface, sinceRevision, dirty);
    return KIRI_OK;
}

/* The arrays are gone with the next tick. */
kiriResult kiriSheet_GetSolid(kiriWorld* world, kiriSheet sheet, float thickness, kiriSolid* solid)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(solid != NULL, "solid is null");
    KIRI_CHECK(kiriCall_IsAtLeast(thickness, 0.0f), "thickness is not finite, or below 0");
    KIRI_FIND_SHEET(data, sheet);
    kiriSurface_NeedNormals(&data->seen.surface);
    double thick = thickness > 0.0f ? thickness : data->settings.material.thickness;
    bool ok = kiriSolid_Build(solid, &world->retired, &data->seen.surface, &data->mesh, thick);
    KIRI_RETURN(ok ? KIRI_OK : KIRI_ERROR_MEMORY);
}

static bool IsRange(int32_t first, int32_t count, int32_t all)
{
    return first >= 0 && count >= 0 && first <= all && count <= all - first;
}

kiriResult kiriSheet_CopyVertices(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                  void* positions, int32_t positionStride, void* normals, int32_t normalStride)
{
    KIRI_READS(world);
    KIRI_CHECK((positions == NULL || positionStride >= 12) && (normals == NULL || normalStride >= 12),
               "a stride is below 12 bytes");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_CHECK(IsRange(first, count, data->seen.surface.vertexCount), "the sheet has no such vertices");
    if (normals != NULL && !data->seen.surface.wantsNormals) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the sheet makes no normals");
    }
    kiriSurface_CopyVertices(&data->seen.surface, first, count, positions, positionStride, normals, normalStride);
    return KIRI_OK;
}

kiriResult kiriSheet_CopyPrevious(const kiriWorld* world, kiriSheet sheet, int32_t first, int32_t count,
                                  int32_t* vertices, kiriSheet* from)
{
    KIRI_READS(world);
    KIRI_CHECK((count == 0 || vertices != NULL) && from != NULL, "vertices or from is null");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_CHECK(IsRange(first, count, data->seen.surface.vertexCount), "the sheet has no such vertices");
    const kiriPast past = kiriPast_At(&data->past, world->begun);
    for (int32_t i = 0; i < count; ++i) {
        vertices[i] = kiriPast_IndexOf(&past, first + i);
    }
    *from = past.sheet != 0 ? past.sheet : sheet;
    return KIRI_OK;
}

kiriResult kiriSheet_CopyIndices16(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                   uint16_t* indices)
{
    KIRI_READS(world);
    KIRI_CHECK(count == 0 || indices != NULL, "indices is null");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_CHECK(IsRange(firstTriangle, count, data->seen.surface.triangleCount), "the sheet has no such triangles");
    if (!kiriSurface_CopyIndices16(&data->seen.surface, firstTriangle, count, indices)) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "16 bits are not enough for so many vertices");
    }
    return KIRI_OK;
}

kiriResult kiriSheet_CopySources(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                 int32_t* sources)
{
    KIRI_READS(world);
    KIRI_CHECK(count == 0 || sources != NULL, "sources is null");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_CHECK(IsRange(firstTriangle, count, data->seen.surface.triangleCount), "the sheet has no such triangles");
    for (int32_t i = 0; i < count; ++i) {
        sources[i] = data->mesh.triangles.data[firstTriangle + i].source;
    }
    return KIRI_OK;
}

kiriResult kiriSheet_CopySourceWeights(const kiriWorld* world, kiriSheet sheet, int32_t firstTriangle, int32_t count,
                                       float* weights)
{
    KIRI_READS(world);
    KIRI_CHECK(count == 0 || weights != NULL, "weights is null");
    KIRI_FIND_SHEET(data, sheet);
    KIRI_CHECK(IsRange(firstTriangle, count, data->seen.surface.triangleCount), "the sheet has no such triangles");
    for (int64_t i = 0; i < 3 * (int64_t)count; ++i) {
        const kiriTriangle* triangle = &data->mesh.triangles.data[firstTriangle + i / 3];
        kiriMesh_GetShareIn(&data->mesh, triangle->vertex[i % 3], triangle->source, &weights[3 * i]);
    }
    return KIRI_OK;
}

kiriResult kiriSheet_GetCollisionPoints(const kiriWorld* world, kiriSheet sheet, const float** positions,
                                        int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(positions != NULL && count != NULL, "positions or count is null");
    KIRI_FIND_SHEET(data, sheet);
    *positions = data->seen.pointPositions.data;
    *count = data->points.count;
    return KIRI_OK;
}

kiriResult kiriSheet_GetCounts(const kiriWorld* world, kiriSheet sheet, kiriCounts* counts)
{
    KIRI_READS(world);
    KIRI_CHECK(counts != NULL, "counts is null");
    KIRI_FIND_SHEET(data, sheet);
    counts->vertices = data->mesh.vertices.count;
    counts->triangles = data->mesh.triangles.count;
    counts->cells = data->grid.cellCount;
    counts->frames = data->frames.count;
    counts->links = data->links.links.count;
    counts->pieces = data->layout.pieces.count;
    counts->collisionPoints = data->points.count;
    return KIRI_OK;
}

kiriResult kiriSheet_GetTotals(const kiriWorld* world, kiriSheet sheet, kiriTotals* totals)
{
    KIRI_READS(world);
    KIRI_CHECK(totals != NULL, "totals is null");
    KIRI_FIND_SHEET(data, sheet);
    *totals = kiriMotion_Totals(data);
    return KIRI_OK;
}

kiriResult kiriSheet_IsAwake(const kiriWorld* world, kiriSheet sheet, int32_t* awake)
{
    KIRI_READS(world);
    KIRI_CHECK(awake != NULL, "awake is null");
    KIRI_FIND_SHEET(data, sheet);
    *awake = !data->rest.asleep;
    return KIRI_OK;
}

kiriResult kiriSheet_Wake(kiriWorld* world, kiriSheet sheet)
{
    KIRI_CHANGES(world, KIRI_CALL_SHEET_WAKE, &sheet);
    KIRI_FIND_SHEET(data, sheet);
    kiriMotion_Wake(data);
    KIRI_RETURN(KIRI_OK);
}

/* ---- Rays ---- */

static const char* FaultOfRay(const float origin[3], const float direction[3], float maxDistance, const kiriHit* hit)
{
    if (origin == NULL || direction == NULL || hit == NULL) {
        return "origin, direction or hit is null";
    }
    if (!kiriCall_AreFinite(origin, 3) || !kiriCall_AreFinite(direction, 3) || !kiriCall_IsAtLeast(maxDistance, 0.0f)) {
        return "origin, direction or maxDistance is not finite, or maxDistance below 0";
    }
    bool isZero = direction[0] == 0.0f && direction[1] == 0.0f && direction[2] == 0.0f;
    return isZero ? "direction is zero" : NULL;
}

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
    const char* fault = FaultOfRay(origin, direction, maxDistance, hit);
    KIRI_CHECK(fault == NULL, fault);
    KIRI_FIND_SHEET(data, sheet);
    CastRay(data, origin, direction, maxDistance, hit);
    return KIRI_OK;
}

/* At the same distance the sheet that was made first. */
kiriResult kiriWorld_Raycast(const kiriWorld* world, const float origin[3], const float direction[3], float maxDistance,
                             kiriSheet* sheet, kiriHit* hit)
{
    KIRI_READS(world);
    KIRI_CHECK(sheet != NULL, "sheet is null");
    const char* fault = FaultOfRay(origin, direction, maxDistance, hit);
    KIRI_CHECK(fault == NULL, fault);
    *sheet = 0;
    memset(hit, 0, sizeof(*hit));
    hit->triangle = KIRI_NONE;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriHit next;
        CastRay(world->sheets.data[i], origin, direction, maxDistance, &next);
        if (next.triangle != KIRI_NONE && (*sheet == 0 || next.distance < hit->distance)) {
            *sheet = world->sheets.data[i]->id;
            *hit = next;
            maxDistance = next.distance;
        }
    }
    return KIRI_OK;
}

kiriResult kiriSheet_EstimateError(const kiriWorld* world, kiriSheet sheet, double* relative)
{
    KIRI_READS(world);
    KIRI_CHECK(relative != NULL, "relative is null");
    KIRI_FIND_SHEET(data, sheet);
    if (data->settings.mechanics.model != KIRI_MODEL_LINKS) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "only sheets of KIRI_MODEL_LINKS have an estimate");
    }
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    kiriCall_BeginCallbacks(world);
    bool ok = kiriEstimate_Error(&scratch, data->frames.data, data->frames.count, data->links.links.data,
                                 data->links.links.count, &data->settings.material, relative);
    kiriCall_EndCallbacks(world);
    return ok ? KIRI_OK : KIRI_FAIL(KIRI_ERROR_MEMORY, "out of memory");
}

kiriResult kiriSheet_GetPoint(const kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriPointState* state)
{
    KIRI_READS(world);
    KIRI_CHECK(restPoint != NULL && kiriCall_AreFinite(restPoint, 2), "restPoint is null or not finite");
    KIRI_CHECK(state != NULL, "state is null");
    KIRI_FIND_SHEET(data, sheet);
    kiriLatticePoint at;
    kiriPointPlace place;
    KIRI_CHECK(kiriSheet_ToLattice(data, restPoint, &at) && kiriPoint_Find(data, at, &place),
               "restPoint lies outside the material");
    int32_t frame = kiriOwner_At(data, at);
    KIRI_CHECK(frame != KIRI_NONE, "restPoint lies in a piece that is destroyed");
    kiriVec3_Store(state->position, kiriPoint_Position(data, &place));
    kiriVec3_Store(state->normal, kiriPoint_Normal(data, &place));
    kiriVec3_Store(state->velocity, kiriPoint_Blend(data, &place).velocity);
    state->frame = data->frames.data[frame].id;
    return KIRI_OK;
}

kiriResult kiriSheet_GetWeights(const kiriWorld* world, kiriSheet sheet, const float restPoint[2], kiriFrame* frames,
                                float* weights, float* gradients, int32_t capacity, int32_t* count)
{
    KIRI_READS(world);
    KIRI_CHECK(restPoint != NULL && kiriCall_AreFinite(restPoint, 2) && count != NULL,
               "restPoint or count is null, or not finite");
    KIRI_CHECK(capacity == 0 || (capacity > 0 && frames != NULL && weights != NULL),
               "capacity without frames and weights");
    KIRI_FIND_SHEET(data, sheet);
    if (!kiriUpdate_IsFieldCurrent(data->update)) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "a cut is being worked on; ask again when its work is done");
    }
    kiriLatticePoint at;
    bool inRange = kiriSheet_ToLattice(data, restPoint, &at);
    int32_t cell = inRange ? kiriGrid_CellAt(&data->grid, &data->mesh, at) : KIRI_NONE;
    KIRI_CHECK(cell != KIRI_NONE, "restPoint lies outside the material");
    kiriPointWeights found = { NULL, 0, 0 };
    kiriMemory scratch = kiriMemory_Like(&world->memory);
    kiriCall_BeginCallbacks(world);
    bool ok =
        kiriShape_At(&data->shape, &scratch, &data->grid, &data->mesh, cell, kiriMesh_Local(&data->mesh, at), &found);
    for (int32_t i = 0; ok && i < found.count && i < capacity; ++i) {
        frames[i] = data->frames.data[found.data[i].frame].id;
        weights[i] = (float)found.data[i].value;
        if (gradients != NULL) {
            gradients[2 * i] = (float)found.data[i].gradient.x;
            gradients[2 * i + 1] = (float)found.data[i].gradient.y;
        }
    }
    *count = ok ? found.count : *count;
    kiriMemory_FreeAll(&scratch);
    kiriCall_EndCallbacks(world);
    return ok ? KIRI_OK : KIRI_FAIL(KIRI_ERROR_MEMORY, "out of memory");
}

void kiriDefaultDebugDraw(kiriDebugDraw* draw)
{
    if (draw != NULL) {
        memset(draw, 0, sizeof(*draw));
        draw->cookie = KIRI_COOKIE(kiriDebugDraw);
        draw->flags = KIRI_DRAW_ALL & ~(KIRI_DRAW_TRIANGLES | KIRI_DRAW_EDGES);
        draw->size = 0.05f;
    }
}

static void BeginBatch(kiriDrawBatch* batch, kiriDrawFn* draw, void* user)
{
    batch->draw = draw;
    batch->user = user;
    batch->count = 0;
}

static void DrawWorld(kiriDrawing* drawing)
{
    const kiriWorld* world = drawing->world;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        kiriDrawing_Sheet(drawing, world->sheets.data[i]);
    }
    if ((drawing->flags & KIRI_DRAW_OBSTACLES) != 0) {
        kiriDrawing_Obstacles(drawing);
    }
    if ((drawing->flags & KIRI_DRAW_BLADES) != 0) {
        kiriDrawing_Blades(drawing);
    }
}

kiriResult kiriWorld_DebugDraw(const kiriWorld* world, const kiriDebugDraw* draw)
{
    KIRI_READS(world);
    KIRI_CHECK(draw != NULL, "draw is null");
    if (draw->cookie != KIRI_COOKIE(kiriDebugDraw)) {
        return KIRI_FAIL(KIRI_ERROR_DEF, "draw was not filled by kiriDefaultDebugDraw");
    }
    KIRI_CHECK((draw->flags & ~(uint32_t)KIRI_DRAW_ALL) == 0, "flags has more than those of KIRI_DRAW");
    KIRI_CHECK(kiriCall_IsAbove(draw->size, 0.0f), "size is not finite, or not above 0");
    kiriDrawing drawing;
    drawing.world = world;
    drawing.flags = draw->flags;
    drawing.size = draw->size;
    BeginBatch(&drawing.points, draw->points, draw->user);
    BeginBatch(&drawing.lines, draw->lines, draw->user);
    BeginBatch(&drawing.triangles, draw->triangles, draw->user);
    const kiriSheetData* only = kiriCall_Owner(&world->sheetIds, draw->sheet);
    if (only == NULL && draw->sheet != 0) {
        return KIRI_FAIL(KIRI_ERROR_ID, "there is no sheet with this id");
    }
    kiriCall_BeginCallbacks(world);
    if (only != NULL) {
        kiriDrawing_Sheet(&drawing, only);
    } else {
        DrawWorld(&drawing);
    }
    kiriDrawing_End(&drawing);
    kiriCall_EndCallbacks(world);
    return KIRI_OK;
}
