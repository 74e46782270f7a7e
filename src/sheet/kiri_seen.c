#include "kiri_seen.h"

#include "kiri_piece.h"

#include <string.h>

bool kiriView_Resize(kiriSheetData* sheet, int32_t frameCount, int32_t pointCount)
{
    return kiriSurface_Resize(&sheet->seen.surface, &sheet->shown, &sheet->mesh, frameCount) &&
           kiriArray_Resize(&sheet->shown, &sheet->seen.pointPositions, 3 * (int64_t)pointCount) &&
           kiriArray_Resize(sheet->memory, &sheet->seen.exactPoints, pointCount) &&
           (!sheet->update->isBegun ||
            (kiriFades_Reserve(&sheet->seen.fades, sheet->memory, sheet->mesh.vertices.count) &&
             kiriFades_Reserve(&sheet->seen.pointFades, sheet->memory, pointCount)));
}

/* A newborn vertex lies on the triangle that was seen. */
static void PlaceNewborn(kiriSheetData* sheet, int32_t vertex)
{
    const kiriBirth* birth = &sheet->mesh.births.data[vertex - sheet->mesh.oldVertexCount];
    kiriVec3 at = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        at = kiriVec3_AddScaled(at, birth->share[k], sheet->seen.surface.exact.data[birth->parent[k]]);
    }
    sheet->seen.surface.exact.data[vertex] = at;
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
    HideTriangles(sheet);
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

/* Points that are new have not been seen elsewhere. */
static void TakePointJump(kiriSheetData* sheet)
{
    kiriFades* fades = &sheet->seen.pointFades;
    kiriFades_Remember(fades, &sheet->seen.exactPoints.data, &sheet->seen.exactPoints.capacity);
    BlendPoints(sheet);
    for (int32_t i = sheet->seen.pointCount; i < sheet->points.count; ++i) {
        fades->seen.data[i] = sheet->seen.exactPoints.data[i];
    }
    kiriFades_Take(fades, sheet->seen.exactPoints.data, sheet->points.count);
    AddPointFades(sheet);
    sheet->seen.pointCount = sheet->points.count;
}

void kiriView_TakeJump(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    if (sheet->seen.isElsewhere) {
        kiriFades_Remember(&sheet->seen.fades, &surface->exact.data, &surface->exact.capacity);
        BlendVertices(sheet);
        kiriFades_Take(&sheet->seen.fades, surface->exact.data, surface->vertexCount);
        TakePointJump(sheet);
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
        kiriFades_Trim(&sheet->seen.fades, sheet->memory);
        kiriFades_Trim(&sheet->seen.pointFades, sheet->memory);
    }
}

void kiriView_WritePositions(kiriSheetData* sheet)
{
    BlendVertices(sheet);
    kiriSurface_AddFades(&sheet->seen.surface, &sheet->seen.fades);
    kiriSurface_WriteArrays(&sheet->seen.surface);
    BlendPoints(sheet);
    AddPointFades(sheet);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriVec3_Store(&sheet->seen.pointPositions.data[3 * i], sheet->seen.exactPoints.data[i]);
    }
    sheet->seen.pointCount = sheet->points.count;
    sheet->seen.isElsewhere = false;
}
