#include "kiri_stages.h"

#include "kiri_piece.h"
#include "kiri_site.h"

/* The points that were staged, in their new cells. */
static bool MoveCollisionPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    for (int32_t k = 0; k < sheet->pointSkin.staged.count; ++k) {
        int32_t point = sheet->pointSkin.staged.data[k].sample;
        kiriLatticePoint at = sheet->points.data[point].at;
        kiriSample moved = { at, kiriGrid_CellAround(&sheet->grid, &sheet->mesh, at), point };
        if (!kiriArray_Push(sheet->memory, &u->samples.movedPoints, moved)) {
            return false;
        }
    }
    return true;
}

/* A piece with points only changes into one without when it falls apart. */
static bool NeedsPoints(const kiriSheetData* sheet)
{
    return sheet->settings.collisionPoints > 0.0 && sheet->update->next.pieces.count != sheet->layout.pieces.count;
}

/* Marks the pieces that hold a point. */
static bool MarkPiecesWithPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    if (!kiriSites_ClearMarks(sheet, u->next.pieces.count)) {
        return false;
    }
    u->placing.whole = NeedsPoints(sheet) ? kiriMesh_Area(&sheet->mesh) : 0.0;
    for (int32_t i = 0; NeedsPoints(sheet) && i < sheet->points.count; ++i) {
        int32_t cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, sheet->points.data[i].at);
        u->placing.marks.data[u->next.framePiece.data[sheet->regions.field.owner.data[cell]]] = 1;
    }
    return true;
}

static bool StartPlacingPoints(kiriSheetData* sheet, int32_t piece)
{
    kiriUpdate* u = sheet->update;
    int32_t frame = u->next.pieces.data[piece].frame;
    u->placing.placer.sites.count = 0;
    return kiriPlacer_TakePiece(&u->placing.placer, sheet->memory, &sheet->grid, u->placing.sites.data[frame].cell) &&
           kiriPlacer_Start(&u->placing.placer, sheet->memory, &sheet->grid, &sheet->mesh, NULL,
                            kiriSites_ShareOf(sheet, sheet->settings.collisionPoints));
}

static bool AddCollisionPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    for (int32_t i = 0; i < u->placing.placer.sites.count; ++i) {
        int32_t cell = u->placing.placer.sites.data[i].cell, sample = sheet->points.count + u->samples.newPoints.count;
        kiriSample point = { kiriGrid_Anchor(&sheet->grid, &sheet->mesh, cell), cell, KIRI_NONE };
        if (!kiriArray_Push(sheet->memory, &u->samples.newPoints, point) ||
            !kiriSkin_Stage(&sheet->pointSkin, sheet->memory, &sheet->shape, &sheet->grid, &sheet->mesh, sample, cell,
                            kiriMesh_Local(&sheet->mesh, point.at))) {
            return false;
        }
    }
    return true;
}

/* Collision points for each piece that has none. */
static kiriProgress PlaceCollisionPoints(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    for (; NeedsPoints(sheet) && u->placing.at < u->next.pieces.count; ++u->placing.at) {
        if (u->placing.marks.data[u->placing.at]) {
            continue;
        }
        if (!u->placing.isPlacing && !StartPlacingPoints(sheet, u->placing.at)) {
            return KIRI_FAILED;
        }
        u->placing.isPlacing = true;
        kiriProgress progress = kiriPlacer_Run(&u->placing.placer, sheet->memory, &sheet->grid, &sheet->mesh, samples);
        if (progress != KIRI_DONE) {
            return progress;
        }
        u->placing.isPlacing = false;
        if (!AddCollisionPoints(sheet)) {
            return KIRI_FAILED;
        }
    }
    return KIRI_DONE;
}

static kiriProgress BeginSamples(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriSampleWork* work = &sheet->update->samples;
    (void)samples;
    return kiriPieces_Stage(sheet) && kiriRefresh_Start(&work->refresh, sheet->memory, &sheet->shape, &sheet->grid,
                                                        &sheet->mesh, work->oldVertices)
               ? KIRI_DONE
               : KIRI_FAILED;
}

static kiriProgress WeighVertices(kiriSheetData* sheet, kiriQuota* samples)
{
    return kiriRefresh_Vertices(&sheet->update->samples.refresh, &sheet->vertexSkin, sheet->memory, &sheet->shape,
                                &sheet->grid, &sheet->mesh, samples);
}

static kiriProgress WeighPoints(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriProgress progress =
        kiriRefresh_Points(&sheet->update->samples.refresh, &sheet->pointSkin, &sheet->pointPlaces, &sheet->points,
                           sheet->memory, &sheet->shape, &sheet->grid, &sheet->mesh, samples);
    return progress != KIRI_DONE || (MoveCollisionPoints(sheet) && MarkPiecesWithPoints(sheet)) ? progress
                                                                                                : KIRI_FAILED;
}

kiriProgress kiriStage_Samples(kiriSheetData* sheet, kiriQuota* samples)
{
    static kiriProgress (*const steps[])(kiriSheetData*, kiriQuota*) = { BeginSamples, WeighVertices, WeighPoints,
                                                                         PlaceCollisionPoints };
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && sheet->update->step < (int32_t)(sizeof(steps) / sizeof(steps[0]))) {
        progress = steps[sheet->update->step](sheet, samples);
        sheet->update->step += progress == KIRI_DONE;
    }
    return progress;
}
