#include "kiri_seen.h"

#include "kiri_piece.h"

#include <string.h>

bool kiriView_ReserveFades(kiriSheetData* sheet, int32_t pointCount)
{
    int32_t vertices = sheet->mesh.vertices.count;
    return kiriArray_Reserve(sheet->memory, &sheet->seen.before, 3 * (int64_t)vertices) &&
           kiriArray_Reserve(sheet->memory, &sheet->seen.pointsBefore, pointCount) &&
           kiriFades_Reserve(&sheet->seen.fades, sheet->memory, vertices) &&
           kiriFades_Reserve(&sheet->seen.pointFades, sheet->memory, pointCount);
}

bool kiriView_Resize(kiriSheetData* sheet, int32_t frameCount, int32_t pointCount)
{
    return kiriSurface_Resize(&sheet->seen.surface, &sheet->shown, &sheet->mesh, frameCount) &&
           kiriArray_Resize(&sheet->shown, &sheet->seen.pointPositions, 3 * (int64_t)pointCount) &&
           kiriArray_Resize(sheet->memory, &sheet->seen.exactPoints, pointCount) &&
           (!sheet->update->isBegun || kiriView_ReserveFades(sheet, pointCount));
}

/* A newborn vertex lies on the triangle that was seen. */
static void PlaceNewborn(kiriSheetData* sheet, int32_t vertex)
{
    const kiriBirth* birth = &sheet->mesh.births.data[vertex - sheet->mesh.oldVertexCount];
    kiriVec3 at = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        at = kiriVec3_AddScaled(at, birth->share[k], kiriSurface_At(&sheet->seen.surface, birth->parent[k]));
    }
    kiriSurface_Place(&sheet->seen.surface, vertex, at);
}

static void HideTriangles(kiriSheetData* sheet)
{
    for (int32_t t = 0; t < sheet->mesh.triangles.count; ++t) {
        if (sheet->layout.pieces.data[kiriPiece_OfVertex(sheet, sheet->mesh.triangles.data[t].vertex[0])].isGone) {
            kiriSurface_HideTriangle(&sheet->seen.surface, t);
        }
    }
}

void kiriView_HideGone(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    kiriSurface_NeedNormals(surface); /* what is gone has them until the next tick */
    HideTriangles(sheet);
    surface->isWritten = false;
    sheet->mesh.revision += 1;
    surface->revision = sheet->mesh.revision;
    surface->changeCount = 0;
    surface->pose += 1;
}

void kiriView_WriteTopology(kiriSheetData* sheet)
{
    for (int32_t v = sheet->mesh.oldVertexCount; v < sheet->mesh.oldVertexCount + sheet->mesh.births.count; ++v) {
        PlaceNewborn(sheet, v);
    }
    kiriSurface_WriteTopology(&sheet->seen.surface, &sheet->mesh);
    if (kiriPieces_AnyGone(sheet)) {
        HideTriangles(sheet); /* a cut goes on in what is gone */
    }
    sheet->seen.isElsewhere = true;
}

static void BlendVertices(kiriSheetData* sheet)
{
    kiriSurface_Blend(&sheet->seen.surface, &sheet->vertexSkin, sheet->frames.data, sheet->frames.count,
                      sheet->links.links.data, sheet->links.links.count);
}

/* Linear whatever is seen: here contacts push (see kiri_motion.c). */
static void BlendPoints(kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, sheet->points.data[i].at);
        sheet->seen.exactPoints.data[i] = kiriSkin_Position(&sheet->pointSkin, i, sheet->frames.data, local);
    }
}

static void AddPointFades(kiriSheetData* sheet)
{
    for (int32_t k = 0; k < sheet->seen.pointFades.fading.count; ++k) {
        kiriFading fading = sheet->seen.pointFades.fading.data[k];
        kiriVec3* at = &sheet->seen.exactPoints.data[fading.sample];
        *at = kiriVec3_Add(*at, fading.offset);
    }
}

/* There is room. */
static void RememberPlaces(kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    sheet->seen.middleBefore = surface->middle;
    memcpy(sheet->seen.before.data, kiriSurface_Places(surface), 3 * sizeof(float) * (size_t)surface->vertexCount);
    memcpy(sheet->seen.pointsBefore.data, sheet->seen.exactPoints.data,
           sizeof(kiriVec3) * (size_t)sheet->seen.pointCount);
}

static void TakeVertexJumps(kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    const float *was = sheet->seen.before.data, *is = kiriSurface_Places(surface);
    kiriVec3 shift = kiriVec3_Sub(sheet->seen.middleBefore, surface->middle);
    kiriFades_Start(&sheet->seen.fades);
    for (int32_t v = 0; v < surface->vertexCount; ++v, was += 3, is += 3) {
        kiriVec3 offset = kiriVec3_Sub(kiriVec3_Load(was), kiriVec3_Load(is));
        kiriFades_Take(&sheet->seen.fades, v, kiriVec3_Add(offset, shift));
    }
}

/* Points that are new have not been seen elsewhere. */
static void TakePointJumps(kiriSheetData* sheet)
{
    const kiriVec3 *was = sheet->seen.pointsBefore.data, *is = sheet->seen.exactPoints.data;
    kiriFades_Start(&sheet->seen.pointFades);
    for (int32_t i = 0; i < sheet->seen.pointCount; ++i) {
        kiriFades_Take(&sheet->seen.pointFades, i, kiriVec3_Sub(was[i], is[i]));
    }
    sheet->seen.pointCount = sheet->points.count;
}

void kiriView_TakeJump(kiriSheetData* sheet)
{
    if (sheet->seen.isElsewhere) {
        RememberPlaces(sheet);
        BlendVertices(sheet);
        BlendPoints(sheet);
        TakeVertexJumps(sheet);
        TakePointJumps(sheet);
        AddPointFades(sheet);
    }
}

/* Gives memory back where nothing fades. */
static void TrimFades(kiriSheetData* sheet)
{
    kiriFades_Trim(&sheet->seen.fades, sheet->memory);
    kiriFades_Trim(&sheet->seen.pointFades, sheet->memory);
    if (sheet->seen.fades.fading.count == 0 && sheet->seen.before.capacity > 0) {
        kiriArray_Release(sheet->memory, &sheet->seen.before);
        kiriArray_Release(sheet->memory, &sheet->seen.pointsBefore);
    }
}

void kiriView_Fade(kiriSheetData* sheet, double dt)
{
    kiriFades_Advance(&sheet->seen.fades, dt);
    kiriFades_Advance(&sheet->seen.pointFades, dt);
}

void kiriView_Trim(kiriSheetData* sheet)
{
    if (!sheet->update->isBegun) {
        TrimFades(sheet);
    }
}

void kiriView_TakeFrames(kiriSheetData* sheet)
{
    kiriSurface_TakeFrames(&sheet->seen.surface, sheet->frames.data, sheet->frames.count, sheet->links.links.data,
                           sheet->links.links.count);
    sheet->seen.surface.isWritten &= sheet->seen.fades.fading.count == 0;
}

void kiriView_BlendRange(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    if (!sheet->seen.surface.isWritten) {
        kiriSurface_BlendRange(&sheet->seen.surface, &sheet->vertexSkin, begin, end);
    }
}

void kiriView_Sum(kiriSheetData* sheet)
{
    if (!sheet->seen.surface.isWritten) {
        kiriSurface_AddFades(&sheet->seen.surface, &sheet->seen.fades);
        kiriSurface_SumNormals(&sheet->seen.surface);
    }
    BlendPoints(sheet);
    AddPointFades(sheet);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriVec3_Store(&sheet->seen.pointPositions.data[3 * i], sheet->seen.exactPoints.data[i]);
    }
    sheet->seen.pointCount = sheet->points.count;
    sheet->seen.isElsewhere = false;
}

void kiriView_WriteRange(kiriSheetData* sheet, int32_t begin, int32_t end)
{
    if (!sheet->seen.surface.isWritten) {
        kiriSurface_WriteRange(&sheet->seen.surface, begin, end);
    }
}

void kiriView_EndWriting(kiriSheetData* sheet)
{
    sheet->seen.surface.isWritten = sheet->seen.fades.fading.count == 0;
}

void kiriView_WritePositions(kiriSheetData* sheet)
{
    int32_t count = sheet->seen.surface.vertexCount;
    kiriView_TakeFrames(sheet);
    kiriView_BlendRange(sheet, 0, count);
    kiriView_Sum(sheet);
    kiriView_WriteRange(sheet, 0, count);
    kiriView_EndWriting(sheet);
}
