#include "kiri_stages.h"

#include "kiri_piece_list.h"
#include "kiri_pin.h"
#include "kiri_room.h"
#include "kiri_seen.h"
#include "kiri_site.h"

#include <string.h>

/* ---- Cut: appendix A --------------------------------------------------------------------------------------------- */

/* Moves the blade of a cut to the next point of its polyline. */
static kiriProgress TakeQueuedPoint(kiriSheetData* sheet, const kiriQueuedPoint* point, kiriQuota* triangles)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriTip* tip = &point->cut->tip;
    kiriVec2 from = tip->last, to = point->to;
    if (point->jump || !kiriCut_Clip(mesh, &from, &to)) {
        tip->last = point->to;
        tip->blade = kiriCut_Place(mesh, point->to);
        return KIRI_DONE;
    }
    kiriLatticePoint start = kiriMesh_Snap(mesh, from);
    if (tip->blade.vertex == KIRI_NONE && (start.x != tip->blade.at.x || start.y != tip->blade.at.y)) {
        tip->blade = kiriCut_Place(mesh, from); /* it comes from far outside */
    }
    kiriProgress progress = kiriCut_Move(mesh, &tip->blade, kiriMesh_Snap(mesh, to), sheet->settings.snap, triangles);
    if (progress == KIRI_DONE) {
        tip->last = point->to;
    }
    return progress;
}

/* The steps of the stage; the first is 0. */
enum { MAKE_ROOM, CUT_MESH };

/* Ends the update with the tick of the last point, where that settles sites: later points are for the next one. */
static void EndWithTick(kiriSheetData* sheet, const kiriQueuedPoint* last)
{
    kiriCutWork* cut = &sheet->update->cut;
    bool isLast = cut->taken == sheet->queue.count || last[1].stamp != last->stamp;
    cut->settlesSites = cut->settlesSites || last->ends;
    cut->count = cut->settlesSites && isLast ? cut->taken : cut->count;
}

/* Takes queued points as far as the quota goes. Newborn vertices stay on the surface as it is. */
kiriProgress kiriStage_SplitMesh(kiriSheetData* sheet, kiriQuota* triangles)
{
    kiriUpdate* u = sheet->update;
    u->step = u->step == CUT_MESH && kiriRoom_IsLow(sheet, triangles) ? MAKE_ROOM : u->step;
    kiriProgress progress = u->step == MAKE_ROOM ? kiriRoom_ForCut(sheet, triangles) : KIRI_DONE;
    u->step = progress == KIRI_DONE ? CUT_MESH : u->step;
    kiriMesh_Begin(&sheet->mesh);
    while (progress == KIRI_DONE && u->cut.taken < u->cut.count) {
        const kiriQueuedPoint* point = &sheet->queue.data[u->cut.taken];
        progress = TakeQueuedPoint(sheet, point, triangles);
        u->cut.settlesSites = u->cut.settlesSites || sheet->mesh.hasMet;
        if (progress == KIRI_DONE) {
            u->cut.taken += 1;
            EndWithTick(sheet, point);
        }
    }
    u->cut.meshChanged = u->cut.meshChanged || sheet->mesh.savedTriangles.count > 0 ||
                         (progress == KIRI_DONE && u->cut.settlesSites && u->isUnsettled && kiriSites_MayBeFew(sheet));
    bool hasRoom = progress != KIRI_FAILED && kiriSkin_Inherit(&sheet->vertexSkin, sheet->memory, &sheet->mesh) &&
                   kiriView_Resize(sheet, sheet->frames.count, sheet->points.count);
    return hasRoom ? progress : KIRI_FAILED;
}

void kiriStage_CommitMesh(kiriSheetData* sheet)
{
    if (sheet->mesh.savedTriangles.count > 0) {
        kiriPieceLists_Forget(&sheet->lists);
        sheet->probes.isFresh = false;
        kiriView_WriteTopology(sheet);
    }
    kiriMesh_Commit(&sheet->mesh);
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        sheet->cuts.data[i]->committed = sheet->cuts.data[i]->tip;
    }
}

/* ---- Grid, regions, shape functions: sections 4.1, 4.2 and 5 ----------------------------------------------------- */

/* The steps of the two stages that have more than one; each starts with its first, 0. */
enum { RELOCATE_SITES, DIVIDE_REGIONS, PLACE_IN_ORPHANS };
enum { WEIGH_CELLS, ADD_SITES, DIVIDE_AGAIN, MAKE_LINKS };

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
        if (!kiriOwnership_NoteDirty(&u->refit.ownership, sheet->memory, &sheet->mesh) ||
            !kiriRefresh_NoteDirty(&u->samples.refresh, sheet->memory, &sheet->mesh)) {
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
        u->placing.isFirst = true;
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
    return true;
}

static kiriProgress MakeLinks(kiriSheetData* sheet, kiriQuota* cells)
{
    const kiriSites* sites = &sheet->update->placing.sites;
    return kiriLinks_Update(&sheet->links, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions, sites->data,
                            sites->count, cells);
}

/* Sites are added until no frame asks for one, where the update settles them. */
static kiriProgress SettleSites(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    for (;;) {
        kiriProgress progress = u->step == WEIGH_CELLS ? WeighCells(sheet, cells)
                                : u->step == ADD_SITES ? kiriSites_Resample(sheet, cells)
                                                       : DivideRegions(sheet, cells);
        bool isSettled =
            u->step == WEIGH_CELLS ? !u->cut.settlesSites : u->step == ADD_SITES && u->placing.moves.count == 0;
        if (progress != KIRI_DONE || isSettled) {
            return progress;
        }
        if (u->step == WEIGH_CELLS && !kiriSites_ClearMarks(sheet, u->placing.sites.count)) {
            return KIRI_FAILED;
        }
        u->placing.isFirst = u->placing.isFirst && u->step != ADD_SITES;
        u->step = u->step == DIVIDE_AGAIN ? WEIGH_CELLS : u->step + 1;
    }
}

kiriProgress kiriStage_Shape(kiriSheetData* sheet, kiriQuota* cells)
{
    if (sheet->update->step != MAKE_LINKS) {
        kiriProgress progress = SettleSites(sheet, cells);
        if (progress != KIRI_DONE || !MeasureRegions(sheet)) {
            return progress != KIRI_DONE ? progress : KIRI_FAILED;
        }
        sheet->update->step = MAKE_LINKS;
    }
    return MakeLinks(sheet, cells);
}

/* ---- Samples: section 6 ------------------------------------------------------------------------------------------ */

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
        kiriLatticePoint at = kiriGrid_Anchor(&sheet->grid, &sheet->mesh, cell);
        cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, at); /* the tip of a triangle may be another's, too */
        kiriSample point = { at, cell, KIRI_NONE };
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
        kiriProgress progress = kiriSites_RunPlacer(sheet, samples);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (!AddCollisionPoints(sheet)) {
            return KIRI_FAILED;
        }
    }
    return KIRI_DONE;
}

static kiriProgress JoinPieces(kiriSheetData* sheet, kiriQuota* samples)
{
    if (!kiriQuota_Take(samples, 1)) {
        return KIRI_MORE;
    }
    return kiriPieces_Stage(sheet) ? KIRI_DONE : KIRI_FAILED;
}

static kiriProgress FindSamples(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriSampleWork* work = &sheet->update->samples;
    return kiriRefresh_Start(&work->refresh, sheet->memory, &sheet->shape, &sheet->grid, &sheet->mesh,
                             work->oldVertices, samples);
}

static kiriProgress WeighVertices(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriProgress progress = kiriRoom_ForMoreWeights(sheet, samples);
    return progress == KIRI_DONE
               ? kiriRefresh_Vertices(&sheet->update->samples.refresh, &sheet->vertexSkin, sheet->memory, &sheet->shape,
                                      &sheet->grid, &sheet->mesh, samples)
               : progress;
}

static kiriProgress WeighPoints(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriProgress progress =
        kiriRefresh_Points(&sheet->update->samples.refresh, &sheet->pointSkin, &sheet->pointPlaces, &sheet->points,
                           sheet->memory, &sheet->shape, &sheet->grid, &sheet->mesh, samples);
    return progress != KIRI_DONE || (MoveCollisionPoints(sheet) && MarkPiecesWithPoints(sheet)) ? progress
                                                                                                : KIRI_FAILED;
}

kiriProgress kiriStage_RunSteps(kiriSheetData* sheet, kiriQuota* quota, kiriStageStep* const* steps, int32_t count)
{
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && sheet->update->step < count) {
        progress = steps[sheet->update->step](sheet, quota);
        sheet->update->step += progress == KIRI_DONE;
    }
    return progress;
}

kiriProgress kiriStage_Settle(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriProgress progress = kiriSkin_Settle(&sheet->vertexSkin, samples);
    return progress == KIRI_DONE ? kiriSkin_Settle(&sheet->pointSkin, samples) : progress;
}

kiriProgress kiriStage_Samples(kiriSheetData* sheet, kiriQuota* samples)
{
    static kiriStageStep* const steps[] = { kiriStage_Settle, JoinPieces,  FindSamples,         kiriRoom_ForWeights,
                                            WeighVertices,    WeighPoints, PlaceCollisionPoints };
    return kiriStage_RunSteps(sheet, samples, steps, (int32_t)(sizeof(steps) / sizeof(steps[0])));
}
