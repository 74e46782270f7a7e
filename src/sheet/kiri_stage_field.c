#include "kiri_stages.h"

#include "kiri_site.h"

/* The steps of the two stages that have more than one; each starts with its first, 0. */
enum { RELOCATE_SITES, DIVIDE_REGIONS, PLACE_IN_ORPHANS };
enum { WEIGH_CELLS, ADD_SITES, DIVIDE_AGAIN };

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
        if (!kiriOwnership_NoteDirty(&u->refit.ownership, sheet->memory, &sheet->mesh)) {
            return KIRI_FAILED;
        }
        kiriSquares_ClearDirty(&sheet->mesh.squares);
        u->counts.cells = changes->made.count + changes->material.count;
    }
    return progress;
}

/* ---- Regions ---- */

static kiriProgress DivideRegions(kiriSheetData* sheet, kiriQuota* cells)
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
    if (u->step == RELOCATE_SITES) {
        if (!kiriSites_Relocate(sheet)) {
            return KIRI_FAILED;
        }
        u->step = DIVIDE_REGIONS;
    }
    for (;;) {
        kiriProgress progress =
            u->step == DIVIDE_REGIONS ? DivideRegions(sheet, cells) : kiriSites_PlaceInOrphans(sheet, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (u->step == DIVIDE_REGIONS && sheet->regions.orphans.count == 0) {
            return KIRI_DONE;
        }
        if (u->step == DIVIDE_REGIONS && !kiriSites_ClearMarks(sheet, sheet->grid.cells.count)) {
            return KIRI_FAILED;
        }
        u->step = u->step == DIVIDE_REGIONS ? PLACE_IN_ORPHANS : DIVIDE_REGIONS;
    }
}

/* ---- Shape, and re-sampling (section 5) ---- */

static kiriProgress WeighCells(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    kiriProgress progress = kiriShape_Update(&sheet->shape, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions,
                                             u->placing.sites.data, u->placing.sites.count, u->placing.moves.data,
                                             u->placing.moves.count, cells);
    if (progress == KIRI_DONE) {
        if (!kiriOwnership_NoteChanges(&u->refit.ownership, sheet->memory, &sheet->grid, &sheet->mesh,
                                       &sheet->regions)) {
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
        kiriProgress progress = u->step == WEIGH_CELLS ? WeighCells(sheet, cells)
                                : u->step == ADD_SITES ? kiriSites_Resample(sheet, cells)
                                                       : DivideRegions(sheet, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (u->step == ADD_SITES && u->placing.moves.count == 0) {
            return MeasureRegions(sheet) ? KIRI_DONE : KIRI_FAILED;
        }
        if (u->step == WEIGH_CELLS && !kiriSites_ClearMarks(sheet, u->placing.sites.count)) {
            return KIRI_FAILED;
        }
        u->step = u->step == DIVIDE_AGAIN ? WEIGH_CELLS : u->step + 1;
    }
}
