#include "kiri_remake.h"

#include "kiri_pipeline.h"
#include "kiri_stages.h"

#include <string.h>

/* Did the stages end where sites are found again, though all that this takes memory for is there? Then two sites are in
   one cell. */
static bool IsCrowded(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    return u->stage == KIRI_STAGE_REGIONS && u->step == 0 && u->placing.flags.count >= sheet->grid.cells.count &&
           u->placing.moves.capacity >= sheet->frames.count;
}

/* Are there as many frames as were read, in the same pieces? */
static bool IsLayoutThat(const kiriSheetData* sheet)
{
    const kiriLayout *made = &sheet->update->next, *read = &sheet->layout;
    int32_t frames = sheet->frames.count;
    return sheet->update->placing.sites.count == frames && made->pieces.count == read->pieces.count &&
           memcmp(made->framePiece.data, read->framePiece.data, sizeof(int32_t) * (size_t)frames) == 0;
}

/* Samples without weights, in their squares. */
static bool StartSamples(kiriSheetData* sheet)
{
    kiriSkin *vertices = &sheet->vertexSkin, *points = &sheet->pointSkin;
    bool ok = kiriArray_ResizeJust(sheet->memory, &vertices->spans, sheet->mesh.vertices.count) &&
              kiriArray_ResizeJust(sheet->memory, &points->spans, sheet->points.count) &&
              kiriPlaces_Reserve(&sheet->pointPlaces, sheet->memory, &sheet->mesh, sheet->points.count);
    for (int32_t i = 0; ok && i < vertices->spans.count; ++i) {
        vertices->spans.data[i] = (kiriSpan){ 0, 0 };
    }
    for (int32_t i = 0; ok && i < points->spans.count; ++i) {
        points->spans.data[i] = (kiriSpan){ 0, 0 };
        kiriPlaces_Add(&sheet->pointPlaces, sheet->memory, &sheet->mesh, sheet->points.data[i].at); /* has room */
    }
    return ok;
}

/* The stages from the grid to the owners of material, from scratch, as for a sheet that is made. No frame is added but
   where a piece has none. */
static bool RunStages(kiriSheetData* sheet, bool* isBad)
{
    kiriUpdate* u = sheet->update;
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    int32_t maxFrames = sheet->settings.maxFrames;
    if (!StartSamples(sheet) || !kiriArray_Resize(sheet->memory, &u->placing.sites, sheet->frames.count)) {
        return false;
    }
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        u->placing.sites.data[f] = (kiriSite){ sheet->frames.data[f].site.at, 0 };
    }
    sheet->settings.maxFrames = 0;
    u->isScratch = true;
    u->stage = KIRI_STAGE_GRID;
    bool ok = kiriPipeline_Make(sheet, KIRI_STAGE_CONSTANTS);
    *isBad = (!ok && IsCrowded(sheet)) || (ok && !IsLayoutThat(sheet));
    ok = ok && !*isBad && kiriStage_Owners(sheet, &unlimited.of[KIRI_QUOTA_SAMPLES]) == KIRI_DONE;
    sheet->settings.maxFrames = maxFrames;
    return ok;
}

/* Commits the remade data, like the commit of an update. Saved arrays stay. */
static bool Commit(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriLinks_Commit(&sheet->links);
    kiriSkin_Commit(&sheet->vertexSkin);
    kiriSkin_Commit(&sheet->pointSkin);
    kiriOwnership_Commit(&u->refit.ownership, &sheet->mesh);
    kiriShape_ClearChanges(&sheet->shape);
    kiriRefresh_Drop(&u->samples.refresh);
    kiriRefit_Drop(&u->refit);
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        sheet->frames.data[f].site = u->placing.sites.data[f];
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriSample* point = &sheet->points.data[i];
        point->cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, point->at);
        point->frame = sheet->regions.field.owner.data[point->cell];
    }
    u->samples.oldVertices = sheet->mesh.vertices.count;
    u->samples.movedPoints.count = 0;
    u->isScratch = false;
    u->stage = KIRI_NONE;
    u->step = 0;
    u->spent = 0;
    return kiriSkin_Sort(&sheet->vertexSkin, sheet->memory) && kiriSkin_Sort(&sheet->pointSkin, sheet->memory);
}

bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad)
{
    kiriArrayHeader dirty = kiriArray_GetHeader(&sheet->regions.dirty);
    memset(&sheet->regions.dirty, 0, sizeof(sheet->regions.dirty));
    *isBad = false;
    bool ok = RunStages(sheet, isBad) && Commit(sheet) &&
              kiriSurface_RemakeRest(&sheet->seen.surface, &sheet->shown, &sheet->mesh);
    if (ok) {
        memcpy(sheet->regions.dirty.data, dirty.data, (size_t)sheet->frames.count);
    }
    kiriMemory_Free(sheet->memory, dirty.data);
    return ok;
}
