#include "kiri_stages.h"

#include "kiri_site.h"

/* The steps of the two stages that have more than one; each starts with its first, 0. */
enum { RELOCATE, DIVIDE, PLACE };
enum { WEIGH, RESAMPLE, REDIVIDE };

kiriProgress kiriStage_Grid(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    if (u->needsRebuild || (sheet->settings.fromScratch && !u->isScratch)) {
        kiriGrid_Reset(&sheet->grid);
        kiriRegions_Reset(&sheet->regions);
        kiriShape_Reset(&sheet->shape);
        u->needsRebuild = false;
        u->isScratch = true;
    }
    kiriProgress progress = kiriGrid_Update(&sheet->grid, &sheet->mesh, cells);
    if (progress == KIRI_DONE) {
        const kiriGridChanges* changes = &sheet->grid.changes;
        if (!kiriRefit_NoteDirty(&u->refit, sheet->memory, &sheet->mesh)) {
            return KIRI_FAILED;
        }
        kiriSquares_ClearDirty(&sheet->mesh.squares);
        u->counts.cells = changes->made.count + changes->remade.count;
    }
    return progress;
}

/* ---- Regions ---- */

static kiriProgress Divide(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    kiriProgress progress = kiriRegions_Update(
        &sheet->regions, sheet->memory, &sheet->grid, &sheet->mesh, u->placing.sites.data, u->placing.sites.count,
        u->placing.moves.data + u->placing.movesSeen, u->placing.moves.count - u->placing.movesSeen, cells);
    if (progress == KIRI_DONE) {
        u->placing.movesSeen = u->placing.moves.count;
    }
    return progress;
}

kiriProgress kiriStage_Regions(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    if (u->step == RELOCATE) {
        if (!kiriSites_Relocate(sheet)) {
            return KIRI_FAILED;
        }
        u->step = DIVIDE;
    }
    for (;;) {
        kiriProgress progress = u->step == DIVIDE ? Divide(sheet, cells) : kiriSites_PlaceInOrphans(sheet, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (u->step == DIVIDE && sheet->regions.orphans.count == 0) {
            return KIRI_DONE;
        }
        if (u->step == DIVIDE && !kiriSites_ClearMarks(sheet, sheet->grid.cells.count)) {
            return KIRI_FAILED;
        }
        u->step = u->step == DIVIDE ? PLACE : DIVIDE;
    }
}

/* ---- Shape, and re-sampling (section 5) ---- */

static kiriProgress Weigh(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    kiriProgress progress = kiriShape_Update(&sheet->shape, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions,
                                             u->placing.sites.data, u->placing.sites.count, u->placing.moves.data,
                                             u->placing.moves.count, cells);
    if (progress == KIRI_DONE) {
        if (!kiriRefit_NoteChanges(&u->refit, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions)) {
            return KIRI_FAILED;
        }
        kiriGrid_ClearChanges(&sheet->grid);
        kiriRegions_ClearChanges(&sheet->regions);
        u->placing.moves.count = u->placing.movesSeen = 0;
    }
    return progress;
}

static bool MeasureRegions(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    double extent = kiriSheet_Extent(sheet);
    int32_t known = u->material.count;
    if (!kiriArray_Resize(sheet->memory, &u->material, u->placing.sites.count)) {
        return false;
    }
    for (int32_t i = 0; i < u->placing.sites.count; ++i) {
        if (i < known && !sheet->regions.dirty.data[i]) {
            continue;
        }
        u->material.data[i] = kiriTally_Moments(&sheet->regions.material.data[i], extent);
    }
    return kiriLinks_Update(&sheet->links, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions, &sheet->shape,
                            u->placing.sites.data, u->placing.sites.count);
}

kiriProgress kiriStage_Shape(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    for (;;) {
        kiriProgress progress = u->step == WEIGH      ? Weigh(sheet, cells)
                                : u->step == RESAMPLE ? kiriSites_Resample(sheet, cells)
                                                      : Divide(sheet, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (u->step == RESAMPLE && u->placing.moves.count == 0) {
            return MeasureRegions(sheet) ? KIRI_DONE : KIRI_FAILED;
        }
        if (u->step == WEIGH && !kiriSites_ClearMarks(sheet, u->placing.sites.count)) {
            return KIRI_FAILED;
        }
        u->step = u->step == REDIVIDE ? WEIGH : u->step + 1;
    }
}
