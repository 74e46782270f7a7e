#include "kiri_sheet_check.h"

#include "../field/kiri_field_check.h"
#include "../motion/kiri_motion_check.h"
#include "../view/kiri_view_check.h"
#include "kiri_update.h"

/* ---- The work at hand -------------------------------------------------------------------------------------------- */

static const kiriMust MoveMust[] = {
    KIRI_INDEX(KIRI_OF_SITES, kiriSiteMove, frame, frame),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriSiteMove, was, was),
};

static const kiriMust MomentsMust[] = {
    KIRI_REALS(kiriMoments, area, vv),
};

static const kiriMust OwnMust[] = { KIRI_INDEX(KIRI_OF_SITES, kiriSpan, first, first) };

static const kiriMust PlacingMust[] = {
    KIRI_ITEMS_MUST(kiriUpdate, placing.own, OwnMust),
};

enum { MOST_STEPS = 16 };

static const kiriMust UpdateMust[] = {
    KIRI_WITHIN(KIRI_NONE, KIRI_READY, kiriUpdate, stage, stage),
    KIRI_WITHIN(0, MOST_STEPS, kiriUpdate, step, step),
    KIRI_COUNTS(kiriUpdate, spent, spent),
    KIRI_COUNTS(kiriUpdate, cut.stamp, cut.stamp),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, cut.count, cut.taken),
    KIRI_ITEMS_MUST(kiriUpdate, placing.moves, MoveMust),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, placing.movesSeen, placing.spread),
    KIRI_COUNTS(kiriUpdate, placing.search.owed, placing.search.owed),
    KIRI_REALS(kiriUpdate, placing.whole, placing.whole),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, placing.search.seen, placing.search.seen),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, placing.at, placing.at),
    KIRI_ITEMS_MUST(kiriUpdate, material, MomentsMust),
    KIRI_UP_TO(KIRI_OF_VERTICES, kiriUpdate, samples.oldVertices, samples.oldVertices),
    KIRI_WITHIN(0, INT32_MAX / 8, kiriUpdate, refit.most, refit.most),
    KIRI_COUNTS(kiriUpdate, due, due),
};

/* New samples are in cells; samples that move are points. */
static bool AreNewSamples(const kiriSheetData* sheet)
{
    const kiriSampleWork* work = &sheet->update->samples;
    bool areFine = true;
    for (int32_t k = 0; areFine && k < work->newPoints.count; ++k) {
        areFine = kiriSheet_IsInSquare(sheet, work->newPoints.data[k].at) && work->newPoints.data[k].cell >= 0 &&
                  work->newPoints.data[k].cell < sheet->grid.cells.count &&
                  kiriGrid_IsCell(&sheet->grid, work->newPoints.data[k].cell);
    }
    for (int32_t k = 0; areFine && k < work->movedPoints.count; ++k) {
        areFine = work->movedPoints.data[k].cell >= 0 && work->movedPoints.data[k].cell < sheet->grid.cells.count &&
                  work->movedPoints.data[k].frame >= 0 && work->movedPoints.data[k].frame < sheet->points.count;
    }
    return areFine;
}

/* Steps of kiri_stages.c and of those that it names: the last of each stage, and some after which more is there. */
enum { STEP_DIVIDE = 1, STEP_ORPHANS = 2 };
enum { STEP_SITES = 1, STEP_AGAIN = 2, STEP_LINKS = 3 };
enum { STEP_SAMPLES = 2, STEP_POINTS = 6, STEP_PREPARE = 2 };

static bool IsStepOfStage(const kiriUpdate* u)
{
    static const int32_t last[KIRI_READY + 1] = { 1, 0, STEP_ORPHANS, STEP_LINKS, STEP_POINTS, STEP_PREPARE, 0 };
    return u->stage == KIRI_NONE || u->step <= last[u->stage];
}

/* What takes several ticks goes on in the stage and step that began it: elsewhere it would not be made ready. */
static bool AreJobsOfStage(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isShape = u->stage == KIRI_STAGE_SHAPE, isField = !u->needsRebuild;
    bool isDividing = (u->stage == KIRI_STAGE_REGIONS && u->step == STEP_DIVIDE) || (isShape && u->step == STEP_AGAIN);
    return (!isField || ((!kiriGrid_IsAtWork(&sheet->grid) || u->stage == KIRI_STAGE_GRID) &&
                         (!sheet->regions.running || isDividing) &&
                         (!kiriShape_IsAtWork(&sheet->shape) || (isShape && u->step == 0)))) &&
           (!kiriLinks_AreAtWork(&sheet->links) || (isShape && u->step == STEP_LINKS)) &&
           (u->samples.refresh.change == 0 || (u->stage == KIRI_STAGE_SAMPLES && u->step == STEP_SAMPLES)) &&
           (u->refit.ownership.next == 0 || u->stage == KIRI_STAGE_CONSTANTS);
}

/* Regions have followed all that the grid has changed, or nothing of it so far. */
static bool AreChangesSeen(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    const kiriGridChanges* changes = &sheet->grid.changes;
    kiriSeenChanges seen = sheet->regions.seen;
    bool isAll = seen.made == changes->made.count && seen.gone == changes->gone.count &&
                 seen.steps == changes->steps.count && seen.material == changes->material.count &&
                 seen.edges == changes->edges.count;
    bool isNone = seen.made == 0 && seen.gone == 0 && seen.steps == 0 && seen.material == 0 && seen.edges == 0;
    bool mayBeNone = u->stage == KIRI_STAGE_REGIONS && u->step <= STEP_DIVIDE;
    return u->needsRebuild || (u->stage <= KIRI_STAGE_GRID ? isNone : isAll || (mayBeNone && isNone));
}

/* Until sites are found again, regions are empty where all is made from scratch, and only there. */
static bool IsScratchSaid(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isEarly = u->stage < KIRI_STAGE_REGIONS || (u->stage == KIRI_STAGE_REGIONS && u->step == 0);
    return u->needsRebuild || !isEarly || u->isScratch == (sheet->regions.material.count == 0);
}

/* Between updates nothing is left of the last one, nor of grid, regions and shape functions before these have begun. */
static bool IsNothingLeft(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    const kiriGridChanges* changes = &sheet->grid.changes;
    const kiriRegions* regions = &sheet->regions;
    bool isEarly = !u->needsRebuild && u->stage <= KIRI_STAGE_GRID, isEarlier = isEarly && u->stage < KIRI_STAGE_GRID;
    bool isEmpty = changes->made.count == 0 && changes->gone.count == 0 && changes->steps.count == 0 &&
                   changes->material.count == 0 && changes->edges.count == 0;
    return (!isEarlier || isEmpty) &&
           (!isEarly ||
            (regions->changes.count == 0 && regions->orphans.count == 0 && sheet->shape.changes.count == 0)) &&
           (u->stage > KIRI_STAGE_GRID || u->placing.sites.count == sheet->frames.count) &&
           (u->stage >= KIRI_STAGE_CONSTANTS || u->refit.ownership.staged.count == 0) &&
           (u->stage > KIRI_STAGE_SHAPE || (sheet->vertexSkin.staged.count == 0 && sheet->pointSkin.staged.count == 0));
}

/* Points that are new are staged in their order; vertices have weights from their birth. */
static bool AreNewStaged(const kiriSheetData* sheet)
{
    int32_t points = 0, vertices = 0;
    for (int32_t k = 0; k < sheet->pointSkin.staged.count; ++k) {
        points += sheet->pointSkin.staged.data[k].sample >= sheet->points.count;
    }
    for (int32_t k = 0; k < sheet->vertexSkin.staged.count; ++k) {
        vertices += sheet->vertexSkin.staged.data[k].sample >= sheet->mesh.vertices.count;
    }
    return vertices == 0 && points == sheet->update->samples.newPoints.count;
}

/* The sample at which the work goes on is in the square at hand. */
static bool IsRefreshedSample(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    const kiriRefresh* refresh = &u->samples.refresh;
    bool ofPoints = u->step == STEP_POINTS - 1, isAtWork = u->step == STEP_POINTS - 2 || ofPoints;
    if (u->stage != KIRI_STAGE_SAMPLES || u->step < STEP_SAMPLES || refresh->sample == KIRI_NONE) {
        return true;
    }
    int32_t count = ofPoints ? sheet->points.count : sheet->mesh.vertices.count;
    if (!isAtWork || refresh->square >= refresh->squares.count || refresh->sample < 0 || refresh->sample >= count) {
        return false;
    }
    kiriLatticePoint at =
        ofPoints ? sheet->points.data[refresh->sample].at : sheet->mesh.vertices.data[refresh->sample].at;
    return (ofPoints || kiriMesh_IsVertex(&sheet->mesh, refresh->sample)) &&
           kiriSquares_At(&sheet->mesh.squares, at) == refresh->squares.data[refresh->square];
}

/* Those that frames are still to be placed for live. */
static bool AreOrphans(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool areFine = true;
    for (int32_t k = 0; areFine && k < sheet->regions.orphans.count; ++k) {
        areFine = u->stage != KIRI_STAGE_REGIONS || u->step != STEP_ORPHANS ||
                  kiriGrid_IsCell(&sheet->grid, sheet->regions.orphans.data[k]);
    }
    return areFine;
}

/* Flags are down between uses. */
static bool AreFlagsDown(const kiriPlacingWork* placing)
{
    bool areDown = true;
    for (int32_t k = 0; k < placing->flags.count; ++k) {
        areDown &= placing->flags.data[k] == 0;
    }
    return areDown;
}

/* Marks are of cells, of frames or of pieces, as the step at hand has them. */
static bool AreMarks(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    int64_t marks = u->placing.marks.count;
    if (u->stage == KIRI_STAGE_REGIONS && u->step == STEP_ORPHANS) {
        return marks == sheet->grid.cells.count;
    }
    if (u->stage == KIRI_STAGE_SHAPE && u->step == STEP_SITES) {
        return marks == sheet->shape.rigid.count && marks == sheet->regions.material.count &&
               marks >= sheet->frames.count;
    }
    return u->stage != KIRI_STAGE_SAMPLES || u->step < STEP_POINTS || marks == u->next.pieces.count;
}

/* What is staged for the commit: pieces that links join. */
static bool IsStaged(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isLate = u->stage > KIRI_STAGE_SAMPLES || (u->stage == KIRI_STAGE_SAMPLES && u->step >= STEP_SAMPLES);
    if (u->stage == KIRI_READY || !isLate) {
        return kiriCheck_That(check, u->stage != KIRI_READY);
    }
    bool isFine =
        kiriSheet_ArePieces(check, &u->next, u->placing.sites.count) &&
        kiriCheck_That(check, kiriSheet_AreLinksOfPieces(&u->next, sheet->links.next.data, sheet->links.next.count));
    for (int32_t p = 0; isFine && p < u->next.pieces.count; ++p) {
        int32_t origin = u->next.pieces.data[p].origin;
        isFine = origin >= KIRI_NONE && origin < sheet->layout.pieces.count;
    }
    return kiriCheck_That(check, isFine && u->material.count == u->placing.sites.count);
}

/* Sites are in cells that live, once they were found again in the new grid, and no two in one. */
static bool AreSitesIn(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool areFound =
        u->stage < KIRI_STAGE_GRID || u->stage > KIRI_STAGE_REGIONS || (u->stage == KIRI_STAGE_REGIONS && u->step > 0);
    uint8_t* isHeld = kiriCheck_Bytes(check, sheet->grid.cells.count);
    bool areFine = isHeld != NULL;
    for (int32_t i = 0; areFine && i < u->placing.sites.count; ++i) {
        const kiriSite* site = &u->placing.sites.data[i];
        areFine = kiriCheck_That(check, kiriSite_IsOver(site, &sheet->mesh));
        if (areFine && (areFound || !u->isScratch)) {
            areFine =
                kiriCheck_Object(check, kiriSiteMust, site) &&
                kiriCheck_That(check, !areFound || (kiriGrid_IsCell(&sheet->grid, site->cell) && !isHeld[site->cell]));
            isHeld[areFine ? site->cell : 0] = 1;
        }
    }
    kiriMemory_Free(&check->memory, isHeld);
    return areFine;
}

/* Where regions have a site: in its cell, or where it was before a move that they have not followed yet. */
static void FindKnownCells(const kiriSheetData* sheet, int32_t* cells)
{
    const kiriPlacingWork* placing = &sheet->update->placing;
    int32_t known = sheet->regions.material.count;
    for (int32_t i = 0; i < known; ++i) {
        cells[i] = placing->sites.data[i].cell;
    }
    bool isFollowed = sheet->regions.running || sheet->update->stage < KIRI_STAGE_REGIONS;
    for (int32_t k = placing->movesSeen; !isFollowed && k < placing->moves.count; ++k) {
        kiriSiteMove move = placing->moves.data[k];
        if (move.frame >= 0 && move.frame < known) {
            cells[move.frame] = move.was;
        }
    }
}

/* Cells say which site they hold. */
static bool AreSitesKnown(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriRegions* regions = &sheet->regions;
    int32_t known = regions->material.count, held = 0;
    int32_t* cells = (int32_t*)(void*)kiriCheck_Bytes(check, (int64_t)sizeof(int32_t) * known);
    bool areFine = cells != NULL;
    if (areFine) {
        FindKnownCells(sheet, cells);
    }
    for (int32_t i = 0; areFine && i < known; ++i) {
        areFine = cells[i] >= 0 && cells[i] < regions->siteAt.count && regions->siteAt.data[cells[i]] == i;
    }
    for (int32_t c = 0; areFine && c < regions->siteAt.count; ++c) {
        held += regions->siteAt.data[c] != KIRI_NONE;
    }
    kiriMemory_Free(&check->memory, cells);
    return kiriCheck_That(check, areFine && held == known);
}

/* But for rounding. */
static bool IsInSquareOf(const kiriSheetData* sheet, const kiriSite* site)
{
    kiriVec2 off = kiriVec2_Sub(site->at, kiriGrid_Middle(&sheet->grid, &sheet->mesh, site->cell));
    double most = 0.51 * sheet->grid.side;
    return fabs(off.x) <= most && fabs(off.y) <= most;
}

/* Frames are at their sites, and between updates in their cells; sites that are new are in theirs. */
static bool AreFramesAtSites(const kiriSheetData* sheet)
{
    const kiriSites* sites = &sheet->update->placing.sites;
    bool isCurrent = kiriUpdate_IsFieldCurrent(sheet->update), areAt = true;
    for (int32_t f = 0; areAt && f < sheet->frames.count; ++f) {
        const kiriSite *is = &sheet->frames.data[f].site, *site = &sites->data[f];
        areAt = is->at.x == site->at.x && is->at.y == site->at.y && (!isCurrent || is->cell == site->cell);
    }
    for (int32_t k = sheet->frames.count; areAt && k < sites->count; ++k) {
        int32_t cell = sites->data[k].cell;
        areAt = cell >= 0 && cell < sheet->grid.cells.count && kiriGrid_IsCell(&sheet->grid, cell) &&
                IsInSquareOf(sheet, &sites->data[k]);
    }
    return areAt;
}

/* Frames that appear take their motion from where there is a triangle. */
static bool AreNewFrames(const kiriSheetData* sheet)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < sheet->update->newFrames.count; ++k) {
        int32_t triangle = sheet->update->newFrames.data[k].triangle;
        areFine =
            triangle >= 0 && triangle < sheet->mesh.triangles.count && kiriMesh_IsTriangle(&sheet->mesh, triangle);
    }
    return areFine;
}

/* Only what has changed the mesh comes to later stages; and squares that changed are forgotten when the grid is that of
   the mesh again. */
static bool IsMeshFollowed(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isCutting = u->stage == KIRI_STAGE_CUT && u->cut.meshChanged;
    return (u->stage <= KIRI_STAGE_CUT || u->cut.meshChanged) &&
           (isCutting || u->stage == KIRI_STAGE_GRID || u->needsRebuild || sheet->mesh.squares.dirty.count == 0);
}

/* What rests has whatever the last work left there. */
static bool ArePartsOfWork(const kiriUpdate* u, const kiriSheetData* sheet)
{
    int64_t sites = u->placing.sites.count, fresh = sites - sheet->frames.count;
    bool isPlaced = u->stage == KIRI_STAGE_CONSTANTS && u->step > 0;
    if (u->stage == KIRI_NONE) {
        return fresh == 0;
    }
    return u->cut.taken <= u->cut.count && u->cut.count <= sheet->queue.count &&
           (u->stage == KIRI_STAGE_CUT || u->cut.taken == u->cut.count) &&
           u->placing.movesSeen <= u->placing.moves.count && IsStepOfStage(u) &&
           (!isPlaced || u->newFrames.count <= fresh) &&
           (u->step < STEP_PREPARE || !isPlaced || u->newFrames.count == fresh) &&
           ((!u->placing.isTaking && !u->placing.isPlacing) || u->placing.placer.work != NULL);
}

/* The placer is amid a piece: which step it is of is known by the stage. */
static bool IsPlacing(const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isAmid = u->placing.isTaking || u->placing.isPlacing;
    bool may =
        (u->stage == KIRI_STAGE_REGIONS && u->step == STEP_ORPHANS && u->placing.at < sheet->regions.orphans.count) ||
        (u->stage == KIRI_STAGE_SHAPE && u->step == STEP_SITES && u->placing.at < u->placing.marks.count) ||
        (u->stage == KIRI_STAGE_SAMPLES && u->step == STEP_POINTS);
    return !isAmid || (may && u->placing.isTaking != u->placing.isPlacing);
}

/* Grid, regions, shape functions, and what was done with them. */
static bool IsFollowed(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool areOwned = u->stage <= KIRI_STAGE_CUT || u->stage > KIRI_STAGE_REGIONS;
    bool isDividing = u->stage == KIRI_STAGE_SHAPE && u->step == STEP_LINKS - 1;
    return kiriGrid_Check(&sheet->grid, &sheet->mesh, check) && AreSitesIn(check, sheet) &&
           kiriRegions_Check(&sheet->regions, &sheet->grid, check, areOwned && !isDividing) &&
           AreSitesKnown(check, sheet) && kiriShape_Check(&sheet->shape, &sheet->grid, &sheet->regions, check) &&
           kiriPlacer_Check(&u->placing.placer, &sheet->grid, &sheet->mesh, check, u->placing.isTaking,
                            u->placing.isPlacing) &&
           kiriOwnership_Check(&u->refit.ownership, check, &sheet->mesh) &&
           kiriCheck_That(check, AreFramesAtSites(sheet) && AreNewSamples(sheet) && AreMarks(sheet) &&
                                     IsPlacing(sheet) && AreOrphans(sheet));
}

/* Grid, regions and shape functions that an update left behind are made anew before anybody asks them. */
static bool AreLeft(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    check->count[KIRI_OF_CELLS] = INT32_MAX;
    check->count[KIRI_OF_FACES] = INT32_MAX;
    const kiriUpdate* u = sheet->update;
    return kiriCheck_That(check, u->stage <= KIRI_STAGE_GRID && !u->placing.isTaking && !u->placing.isPlacing) &&
           kiriGrid_CheckLeft(grid, check) &&
           kiriPlacer_Check(&u->placing.placer, grid, &sheet->mesh, check, false, false) &&
           kiriOwnership_Check(&u->refit.ownership, check, &sheet->mesh);
}

/* What it works on: grid, regions, shape functions, and what was done with them. */
bool kiriUpdate_CheckField(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriPlacingWork* placing = &sheet->update->placing;
    return kiriCheck_That(check, placing->movesSeen >= 0 && AreJobsOfStage(sheet) && AreChangesSeen(sheet) &&
                                     IsScratchSaid(sheet) && IsNothingLeft(sheet)) &&
           (sheet->update->needsRebuild ? AreLeft(check, sheet) : IsFollowed(check, sheet));
}

bool kiriUpdate_CheckWork(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    check->count[KIRI_OF_SAMPLES] =
        u->stage == KIRI_STAGE_SAMPLES && u->step == STEP_POINTS - 1 ? sheet->points.count : sheet->mesh.vertices.count;
    bool isPlaced = u->stage == KIRI_STAGE_CONSTANTS && u->step > 0;
    return kiriCheck_Object(check, UpdateMust, u) &&
           kiriCheck_That(check, AreNewStaged(sheet) && AreFlagsDown(&u->placing)) &&
           (!isPlaced || kiriCheck_That(check, AreNewFrames(sheet) && kiriRefit_HasRoom(&u->refit))) &&
           (!u->placing.isPlacing || u->stage != KIRI_STAGE_SHAPE || kiriCheck_Object(check, PlacingMust, u)) &&
           kiriCheck_That(check, IsMeshFollowed(sheet) && ArePartsOfWork(u, sheet)) &&
           kiriRefresh_Check(&u->samples.refresh, check) &&
           kiriCheck_That(check, IsRefreshedSample(sheet)) && IsStaged(check, sheet);
}
