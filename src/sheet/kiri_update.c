#include "kiri_update.h"
#include "kiri_piece.h"
#include "kiri_pin.h"
#include "kiri_seen.h"
#include "kiri_sheet_site.h"

/* ---- Cut: appendix A --------------------------------------------------------------------------------------------- */

/* Moves the blade step by step, and before each reserves all arrays per vertex and per triangle, so that mesh, weights
   and visible state stay consistent. */
static kiriProgress MoveBlade(kiriSheetData* sheet, kiriBladeTip* blade, kiriLatticePoint to, kiriQuota* triangles)
{
    enum { MADE = 6 }; /* vertices and triangles a step, at most */
    for (;;) {
        const kiriViewCounts counts = { sheet->mesh.vertices.count + MADE, sheet->mesh.triangles.count + MADE,
                                        sheet->frames.count, sheet->points.count };
        if (!kiriSkin_ReserveBirths(&sheet->vertexSkin, sheet->memory, MADE, counts.frames) ||
            !kiriView_Reserve(sheet, counts) ||
            !kiriPast_Reserve(&sheet->past, &sheet->pastRoom, sheet->memory, sheet->seen.surface.vertexCount,
                              counts.vertices)) {
            return KIRI_FAILED;
        }
        int64_t most = blade->owed + KIRI_MOST_SPLITS;
        bool isLast = triangles->left <= most;
        kiriQuota step = { isLast ? triangles->left : most, 0, 0, false };
        kiriProgress progress = kiriCut_Move(&sheet->mesh, blade, to, sheet->settings.snap, &step);
        triangles->left -= step.used;
        triangles->used += step.used;
        kiriSkin_Inherit(&sheet->vertexSkin, &sheet->mesh);
        if (progress == KIRI_DONE) {
            (void)kiriQuota_Pay(triangles, &blade->owed);
        }
        if (progress != KIRI_MORE || isLast) {
            return progress;
        }
    }
}

static kiriBladeTip PlaceBlade(const kiriMeshData* mesh, const kiriTip* tip, kiriVec2 at)
{
    kiriBladeTip blade = kiriCut_Place(mesh, at);
    blade.fold = tip->blade.fold;
    return blade;
}

/* Moves the blade of a cut to the next point of its polyline. */
static kiriProgress TakeQueuedPoint(kiriSheetData* sheet, const kiriQueuedPoint* point, kiriQuota* triangles)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriTip* tip = &point->cut->tip;
    kiriVec2 from = tip->last, to = point->to;
    if (point->jump || !kiriCut_Clip(mesh, &from, &to)) {
        tip->last = point->to;
        tip->blade = PlaceBlade(mesh, tip, point->to);
        return KIRI_DONE;
    }
    kiriLatticePoint start = kiriMesh_Snap(mesh, from);
    if (tip->blade.vertex == KIRI_NONE && (start.x != tip->blade.at.x || start.y != tip->blade.at.y)) {
        tip->blade = PlaceBlade(mesh, tip, from); /* the blade starts far outside */
    }
    kiriProgress progress = MoveBlade(sheet, &tip->blade, kiriMesh_Snap(mesh, to), triangles);
    if (progress == KIRI_DONE) {
        tip->last = point->to;
    }
    return progress;
}

/* Takes queued points as far as the quota goes. New vertices lie on the visible surface. An update that settles sites
   ends with the tick of the last point; later points belong to the next update. */
static kiriProgress StageCut(kiriSheetData* sheet, kiriQuota* triangles)
{
    kiriCutWork* cut = &sheet->update->cut;
    kiriProgress progress = KIRI_DONE;
    kiriMesh_Begin(&sheet->mesh);
    while (progress == KIRI_DONE && cut->taken < cut->count) {
        const kiriQueuedPoint* point = &sheet->queue.data[cut->taken];
        progress = TakeQueuedPoint(sheet, point, triangles);
        cut->settlesSites = cut->settlesSites || sheet->mesh.hasMet;
        if (progress == KIRI_DONE) {
            cut->taken += 1;
            cut->settlesSites = cut->settlesSites || point->ends;
            int32_t fold = point->ends ? point->cut->tip.blade.fold : 0;
            if (fold > 0) {
                KIRI_ASSERT_HAS(sheet->mesh.folds, fold - 1);
                sheet->mesh.folds.data[fold - 1].isMade = 1;
                cut->meshChanged = true; /* it may lie along creases that there are */
            }
            bool isLast = cut->taken == sheet->queue.count || point[1].stamp != point->stamp; /* of its tick */
            cut->count = cut->settlesSites && isLast ? cut->taken : cut->count;
        }
    }
    cut->meshChanged =
        cut->meshChanged || sheet->mesh.changedTriangles.count > 0 ||
        (progress == KIRI_DONE && cut->settlesSites && sheet->update->isUnsettled && kiriSites_MayBeFew(sheet));
    return progress;
}

void kiriStage_CommitMesh(kiriSheetData* sheet)
{
    if (sheet->mesh.changedTriangles.count > 0) {
        kiriPieceLists_Forget(&sheet->lists);
        sheet->probes.isFresh = sheet->tears.areListed = false;
        kiriView_WriteTopology(sheet);
    }
    kiriMesh_Commit(&sheet->mesh);
}

/* ---- Grid, regions, shape functions: sections 4.1, 4.2 and 5 ----------------------------------------------------- */

/* Steps of the two stages that have several; the first is 0. */
enum { RELOCATE_SITES, DIVIDE_REGIONS, PLACE_IN_ORPHANS };
enum { WEIGH_CELLS, ADD_SITES, DIVIDE_AGAIN, MAKE_LINKS };

static kiriProgress StageGrid(kiriSheetData* sheet, kiriQuota* cells)
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
        if (!kiriOwnership_NoteDirty(&u->refit.ownership, &sheet->mesh) ||
            !kiriRefresh_NoteDirty(&u->samples.refresh, &sheet->mesh)) {
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
    kiriProgress progress = kiriRegions_Update(&sheet->regions, &sheet->grid, u->placing.sites.data,
                                               u->placing.sites.count, u->placing.moves.data + u->placing.movesSeen,
                                               u->placing.moves.count - u->placing.movesSeen, cells);
    if (progress == KIRI_DONE) {
        u->placing.movesSeen = u->placing.moves.count;
    }
    return progress;
}

static kiriProgress StageRegions(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = sheet->update;
    if (u->step == RELOCATE_SITES) {
        if (!kiriSites_Relocate(sheet) || !kiriSites_FollowTears(sheet)) {
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
    kiriProgress progress =
        kiriShape_Update(&sheet->shape, &sheet->grid, &sheet->regions, u->placing.sites.data, u->placing.sites.count,
                         u->placing.moves.data, u->placing.moves.count, cells);
    if (progress == KIRI_DONE) {
        if (!kiriOwnership_NoteChanges(&u->refit.ownership, &sheet->grid, &sheet->regions)) {
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
    KIRI_EACH_INDEX(i, u->placing.sites) {
        if (i < known && !sheet->regions.dirty.data[i]) {
            continue;
        }
        u->material.data[i] = kiriTally_Moments(&sheet->regions.material.data[i], extent);
    }
    return true;
}

/* Adds sites until no frame needs another, if the update settles them. */
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

static kiriProgress StageShape(kiriSheetData* sheet, kiriQuota* cells)
{
    if (sheet->update->step != MAKE_LINKS) {
        kiriProgress progress = SettleSites(sheet, cells);
        if (progress != KIRI_DONE || !MeasureRegions(sheet)) {
            return progress != KIRI_DONE ? progress : KIRI_FAILED;
        }
        sheet->update->step = MAKE_LINKS;
    }
    const kiriSites* sites = &sheet->update->placing.sites;
    return kiriLinks_Update(&sheet->links, &sheet->grid, &sheet->regions, sites->data, sites->count, cells);
}

/* ---- Samples: section 6 ------------------------------------------------------------------------------------------ */

/* Lists the staged points with their new cells. */
static bool MoveCollisionPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    KIRI_EACH(const kiriReweighed, staged, sheet->pointSkin.staged) {
        int32_t point = staged->sample;
        kiriLatticePoint at = sheet->points.data[point].at;
        kiriSample moved = { at, kiriGrid_CellAround(&sheet->grid, at), point };
        if (!kiriArray_Push(sheet->memory, &u->samples.movedPoints, moved)) {
            return false;
        }
    }
    return true;
}

/* Returns true if a piece may have no points: only a split can leave one without. */
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
    KIRI_EACH_WHILE(NeedsPoints(sheet), const kiriSample, point, sheet->points) {
        int32_t cell = kiriGrid_CellAround(&sheet->grid, point->at);
        u->placing.marks.data[u->next.framePiece.data[sheet->regions.field.owner.data[cell]]] = 1;
    }
    return true;
}

static bool AddCollisionPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    KIRI_EACH(const kiriSite, site, u->placing.placer.sites) {
        int32_t cell = site->cell, sample = sheet->points.count + u->samples.newPoints.count;
        kiriLatticePoint at = kiriGrid_Anchor(&sheet->grid, cell);
        cell = kiriGrid_CellAround(&sheet->grid, at); /* the anchor may lie in a neighboring cell */
        kiriSample point = { at, cell, KIRI_NONE };
        if (!kiriArray_Push(sheet->memory, &u->samples.newPoints, point) ||
            !kiriSkin_Stage(&sheet->pointSkin, &sheet->shape, &sheet->grid, sample, cell,
                            kiriMesh_Local(&sheet->mesh, point.at))) {
            return false;
        }
    }
    return true;
}

/* Places collision points in each piece that has none. */
static kiriProgress PlaceCollisionPoints(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    for (; NeedsPoints(sheet) && u->placing.at < u->next.pieces.count; ++u->placing.at) {
        if (u->placing.marks.data[u->placing.at]) {
            continue;
        }
        kiriPlacer* placer = &u->placing.placer;
        int32_t cell = u->placing.sites.data[u->next.pieces.data[u->placing.at].frame].cell;
        placer->sites.count = u->placing.isPlacing ? placer->sites.count : 0;
        if (!u->placing.isPlacing && (!kiriPlacer_TakePiece(placer, &sheet->grid, cell) ||
                                      !kiriPlacer_Start(placer, &sheet->grid, NULL,
                                                        kiriSites_ShareOf(sheet, sheet->settings.collisionPoints)))) {
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

static kiriSampleSource VertexSource(kiriSheetData* sheet)
{
    return (kiriSampleSource){ sheet->memory, &sheet->shape, &sheet->grid, &sheet->vertexSkin, NULL, NULL };
}

static kiriProgress FindSamples(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriSampleWork* work = &sheet->update->samples;
    kiriSampleSource source = VertexSource(sheet);
    return kiriRefresh_Start(&work->refresh, &source, work->oldVertices, samples);
}

static kiriProgress WeighVertices(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriSampleSource source = VertexSource(sheet);
    kiriRefresh* refresh = &sheet->update->samples.refresh;
    bool areCopied = refresh->square == 0 && refresh->sample == KIRI_NONE &&
                     sheet->vertexSkin.staged.count == sheet->mesh.vertices.count; /* see kiri_detach.c */
    return areCopied ? KIRI_DONE : kiriRefresh_Stage(refresh, &source, samples);
}

static kiriProgress WeighPoints(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriSampleSource source = VertexSource(sheet);
    source.skin = &sheet->pointSkin;
    source.places = &sheet->pointPlaces;
    source.points = &sheet->points;
    kiriProgress progress = kiriRefresh_Stage(&sheet->update->samples.refresh, &source, samples);
    return progress != KIRI_DONE || (MoveCollisionPoints(sheet) && MarkPiecesWithPoints(sheet)) ? progress
                                                                                                : KIRI_FAILED;
}

/* Part of a stage. */
typedef kiriProgress StageStep(kiriSheetData* sheet, kiriQuota* quota);

/* Runs a stage in steps, from sheet->update->step on, which starts at 0. */
static kiriProgress RunSteps(kiriSheetData* sheet, kiriQuota* quota, StageStep* const* steps, int32_t count)
{
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && sheet->update->step < count) {
        progress = steps[sheet->update->step](sheet, quota);
        sheet->update->step += progress == KIRI_DONE;
    }
    return progress;
}

static kiriProgress StageSamples(kiriSheetData* sheet, kiriQuota* samples)
{
    static StageStep* const steps[] = { JoinPieces, FindSamples, WeighVertices, WeighPoints, PlaceCollisionPoints };
    return RunSteps(sheet, samples, steps, (int32_t)(sizeof(steps) / sizeof(steps[0])));
}

/* ---- Constants ---- */

/* Builds the elements that affine frames need in addition to links. */
static bool BuildAreaElements(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    bool planar = sheet->settings.mechanics.planar;
    switch (sheet->settings.mechanics.model) {
    case KIRI_MODEL_AFFINE:
        return kiriAffine_Build(&u->next.areaElements, sheet->memory, sheet->links.next.data, sheet->links.next.count,
                                u->material.data, u->placing.sites.count, planar);
    case KIRI_MODEL_POINTS:
        return kiriIntegration_Build(&u->next.areaElements, &u->integration, &sheet->grid, &sheet->shape,
                                     u->material.data, sheet->settings.integrationPoints,
                                     sheet->settings.integrationOrder, planar);
    default:
        return true;
    }
}

bool kiriStage_Solver(kiriSheetData* sheet, int32_t frameCount, const kiriMaterial* material, bool isNext)
{
    const kiriLinks* links = &sheet->links;
    const kiriLayout* layout = isNext ? &sheet->update->next : &sheet->layout;
    const kiriSystem system = { .mechanics = sheet->settings.mechanics,
                                .material = *material,
                                .frameCount = frameCount,
                                .links = isNext ? links->next.data : links->links.data,
                                .linkCount = isNext ? links->next.count : links->links.count,
                                .corners = isNext ? links->nextCorners.data : links->corners.data,
                                .cornerCount = isNext ? links->nextCorners.count : links->corners.count,
                                .areaElements = &layout->areaElements };
    return kiriSolver_Stage(sheet->solver, &system, layout->framePiece.data, layout->pieces.count);
}

static kiriProgress StageOwnersOfMaterial(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    u->newFrames.count = 0;
    u->due = 0;
    return kiriRefit_Stage(&u->refit, &sheet->grid, &sheet->regions, u->isScratch, samples);
}

/* Finds the anchors of new frames and the triangles that they take their motion from. */
static kiriProgress PlaceNewFrames(kiriSheetData* sheet, kiriQuota* samples)
{
    enum { WEIGHTS_AN_ITEM = 64, OWNERS_AN_ITEM = 256, ELEMENTS_AN_ITEM = 8, ITEMS_OF_FIT = 2 }; /* of the commit */
    kiriUpdate* u = sheet->update;
    int32_t count = u->placing.sites.count - sheet->frames.count;
    if (!kiriArray_Reserve(sheet->memory, &u->newFrames, count)) {
        return KIRI_FAILED;
    }
    while (kiriQuota_Pay(samples, &u->due)) {
        if (u->newFrames.count == count) {
            int64_t weights = (int64_t)sheet->vertexSkin.staged.count + sheet->pointSkin.staged.count;
            int64_t elements =
                (int64_t)sheet->links.next.count + sheet->links.nextCorners.count + u->placing.sites.count;
            u->due = 1 + weights / WEIGHTS_AN_ITEM + u->refit.ownership.staged.count / OWNERS_AN_ITEM + count +
                     ITEMS_OF_FIT * (int64_t)u->refit.most + sheet->links.changed + elements / ELEMENTS_AN_ITEM;
            return KIRI_DONE;
        }
        int32_t cell = u->placing.sites.data[sheet->frames.count + u->newFrames.count].cell;
        kiriNewFrame frame = { kiriGrid_Anchor(&sheet->grid, cell), KIRI_NONE };
        frame.triangle = kiriMesh_Locate(&sheet->mesh, frame.anchor);
        frame.triangle = frame.triangle == KIRI_NONE ? sheet->grid.cells.data[cell].triangle : frame.triangle;
        KIRI_NEXT(u->newFrames) = frame;
        u->due = 1 + kiriSquares_CountNodes(&sheet->mesh.squares, sheet->grid.cells.data[cell].square) / 4;
    }
    return KIRI_MORE;
}

/* Stages the state that the host may change between ticks, once the commit is paid. */
static kiriProgress PrepareCommit(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    if (!kiriQuota_Pay(samples, &u->due)) {
        return KIRI_MORE;
    }
    int32_t points = sheet->points.count + u->samples.newPoints.count;
    const kiriViewCounts counts = { sheet->mesh.vertices.count, sheet->mesh.triangles.count, u->placing.sites.count,
                                    points };
    bool ok =
        (!kiriSheet_KeepsPulls(sheet) ||
         kiriStrainOffsets_Reserve(&sheet->strainOffsets, sheet->memory,
                                   kiriMax(sheet->links.next.count, sheet->links.links.count),
                                   u->placing.sites.count)) &&
        (!sheet->plastics.isKept ||
         kiriPlastics_Reserve(&sheet->plastics, sheet->memory,
                              kiriMax(sheet->links.next.count, sheet->links.links.count), u->placing.sites.count)) &&
        BuildAreaElements(sheet) && kiriPins_Stage(sheet) && kiriArray_Reserve(sheet->memory, &sheet->points, points) &&
        kiriPlaces_Reserve(&sheet->pointPlaces, &sheet->mesh, points) && kiriView_Reserve(sheet, counts) &&
        kiriArray_Reserve(sheet->memory, &sheet->frames, u->placing.sites.count) &&
        kiriStage_Solver(sheet, u->placing.sites.count, &sheet->settings.material, true);
    return ok ? KIRI_DONE : KIRI_FAILED;
}

kiriProgress kiriStage_Owners(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    KIRI_ASSERT(u->stage == KIRI_STAGE_CONSTANTS && u->isScratch);
    kiriProgress progress = u->step == 0 ? StageOwnersOfMaterial(sheet, samples) : KIRI_DONE;
    u->step = progress == KIRI_DONE ? 1 : 0;
    return progress;
}

/* The last step of the stage: the state that the host may change between ticks. */
enum { PREPARE_COMMIT = 2 };

static kiriProgress StageConstants(kiriSheetData* sheet, kiriQuota* samples)
{
    static StageStep* const steps[] = { StageOwnersOfMaterial, PlaceNewFrames, PrepareCommit };
    KIRI_ASSERT(steps[PREPARE_COMMIT] == PrepareCommit);
    return RunSteps(sheet, samples, steps, (int32_t)(sizeof(steps) / sizeof(steps[0])));
}

/* ---- Pipeline ---- */

typedef struct PipelineStage {
    int quota;
    StageStep* run;
} PipelineStage;

/* The stages after a cut, in the order of KIRI_STAGE. Each may spend its quota, or run out of memory; the solver uses
   the results only after the commit. */
static const PipelineStage pipeline[KIRI_READY] = {
    { KIRI_QUOTA_TRIANGLES, StageCut },     /* appendix A, algorithm 4 */
    { KIRI_QUOTA_CELLS, StageGrid },        /* section 4.2, algorithm 3 */
    { KIRI_QUOTA_CELLS, StageRegions },     /* section 5: frames for pieces that have none */
    { KIRI_QUOTA_CELLS, StageShape },       /* section 4.1, algorithm 2; re-sampling of section 5 */
    { KIRI_QUOTA_SAMPLES, StageSamples },   /* section 6 */
    { KIRI_QUOTA_SAMPLES, StageConstants }, /* owners of material, new frames, the pattern of the matrix */
};

kiriQuotas kiriQuotas_Of(const kiriBudget* budget)
{
    const int32_t items[KIRI_QUOTA_COUNT] = { budget->triangles, budget->cells, budget->samples, budget->iterations };
    kiriQuotas quotas;
    KIRI_TIMES(kind, KIRI_QUOTA_COUNT) {
        quotas.limits[kind] = items[kind] > 0 ? items[kind] : INT64_MAX;
        quotas.of[kind] = (kiriQuota){ quotas.limits[kind], 0, 0, false };
    }
    return quotas;
}

kiriQuotas kiriQuotas_Unlimited(void)
{
    const kiriBudget unlimited = { 0 };
    return kiriQuotas_Of(&unlimited);
}

void kiriQuotas_Share(kiriQuotas* quotas, int spent)
{
    int64_t left = quotas->of[spent].left, limit = quotas->limits[spent];
    KIRI_TIMES(kind, KIRI_QUOTA_ITERATIONS) {
        if (kind != spent && left < limit && limit < INT64_MAX && quotas->limits[kind] < INT64_MAX) {
            int64_t most = left * quotas->limits[kind] / limit; /* each has 31 bits */
            kiriQuota* quota = &quotas->of[kind];
            quota->left = kiriMin(quota->left, most);
            quota->isShared = true;
        }
    }
}

static kiriProgress RunUpTo(kiriSheetData* sheet, int32_t end, kiriQuotas* quotas, const kiriWatch* watch)
{
    kiriUpdate* u = sheet->update;
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && u->stage < end) {
        KIRI_ASSERT(u->stage >= KIRI_STAGE_CUT && u->stage < KIRI_READY);
        kiriQuota* quota = &quotas->of[pipeline[u->stage].quota];
        int64_t done = quota->used + quota->beyond;
        if (watch != NULL) {
            watch->enter(watch->context, u->stage);
            kiriMemory_BeginSparing(sheet->memory);
        }
        progress = quota->left > 0 ? pipeline[u->stage].run(sheet, quota) : KIRI_MORE;
        u->spent += quota->used + quota->beyond - done;
        quota->left = progress == KIRI_MORE ? 0 : quota->left; /* the rest is too small for the next item: discard */
        kiriQuotas_Share(quotas, pipeline[u->stage].quota);
        if (progress == KIRI_DONE) {
            /* A blade may move outside the sheet, or along edges that are open already. */
            bool isOver = u->stage == KIRI_STAGE_CUT && !u->cut.meshChanged;
            u->stage = isOver ? KIRI_READY : u->stage + 1;
            u->step = 0;
            progress = kiriMemory_MustPause(sheet->memory) ? KIRI_MORE : KIRI_DONE;
        }
        kiriMemory_EndSparing(sheet->memory);
    }
    return progress;
}

bool kiriPipeline_Make(kiriSheetData* sheet, int32_t end)
{
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    if (sheet->update == NULL) {
        sheet->update = kiriMemory_AllocZeroed(sheet->memory, sizeof(kiriUpdate));
        kiriSkin* skin = &sheet->vertexSkin;
        if (sheet->update == NULL || !kiriArray_Resize(sheet->memory, &skin->spans, sheet->mesh.vertices.count)) {
            return false;
        }
        kiriArray_Set(&skin->spans, 0);
        sheet->update->stage = KIRI_STAGE_GRID;
        sheet->update->isScratch = true;
        sheet->update->cut.settlesSites = true;
    }
    return RunUpTo(sheet, end, &unlimited, NULL) == KIRI_DONE;
}

void kiriPipeline_Start(kiriSheetData* sheet, int64_t ticks)
{
    kiriUpdate* u = sheet->update;
    bool spreads = u->isNew && kiriSites_MeetPins(sheet);
    u->isNew = false;
    if (u->stage == KIRI_NONE && (sheet->queue.count > 0 || spreads)) {
        int64_t stamp = sheet->queue.count > 0 ? sheet->queue.data[0].stamp : ticks;
        u->cut = (kiriCutWork){ stamp, sheet->queue.count, 0, spreads, spreads };
        u->placing.isAfresh = spreads;
        u->stage = KIRI_STAGE_CUT;
        u->step = 0;
        u->spent = 0;
    }
    sheet->seen.fades.jump = sheet->seen.fades.move = 0.0;
}

bool kiriPipeline_CanRun(const kiriSheetData* sheet, const kiriQuotas* quotas)
{
    int32_t stage = sheet->update->stage;
    KIRI_ASSERT(stage != KIRI_NONE);
    return stage == KIRI_READY || quotas->of[pipeline[stage].quota].left > 0;
}

static void DropStaged(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriSkin_Drop(&sheet->vertexSkin);
    kiriSkin_Drop(&sheet->pointSkin);
    u->samples.newPoints.count = u->samples.movedPoints.count = 0;
    u->placing.sites.count = sheet->frames.count;
    KIRI_EACH_INDEX(f, sheet->frames) {
        u->placing.sites.data[f] = sheet->frames.data[f].site;
    }
    u->placing.moves.count = u->placing.movesSeen = 0;
    u->placing.isTaking = u->placing.isPlacing = false;
    kiriLinks_Drop(&sheet->links);
    kiriRefresh_Drop(&u->samples.refresh);
    kiriRefit_Drop(&u->refit);
}

/* Makes the grid again after an item failed halfway. That is rare, because the item could use the spare block. */
static void StartAgain(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    if (u->stage >= KIRI_STAGE_GRID && u->stage <= KIRI_STAGE_SAMPLES) {
        DropStaged(sheet);
        u->needsRebuild = true;
        u->stage = KIRI_STAGE_GRID;
        u->step = 0;
    }
}

kiriProgress kiriPipeline_Run(kiriSheetData* sheet, kiriQuotas* quotas, const kiriWatch* watch)
{
    KIRI_ASSERT(sheet->update->stage != KIRI_NONE);
    sheet->memory->wasRefused = false;
    kiriProgress progress = RunUpTo(sheet, KIRI_READY, quotas, watch);
    if (progress == KIRI_FAILED) {
        StartAgain(sheet);
    }
    return sheet->memory->wasRefused ? KIRI_FAILED : progress;
}

void kiriPipeline_Finish(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    KIRI_ASSERT(u->stage == KIRI_READY && u->cut.taken == u->cut.count && u->cut.count <= sheet->queue.count);
    KIRI_EACH_INDEX(i, sheet->queue) {
        if (i < u->cut.count) {
            sheet->queue.data[i].cut->waiting -= 1;
        } else {
            sheet->queue.data[i - u->cut.count] = sheet->queue.data[i];
        }
    }
    sheet->queue.count -= u->cut.count;
    u->isUnsettled = !u->cut.settlesSites && (u->isUnsettled || u->cut.meshChanged);
    u->stage = KIRI_NONE;
}

void kiriPipeline_Wait(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    if (u->stage == KIRI_READY && u->cut.meshChanged) {
        u->stage = KIRI_STAGE_CONSTANTS;
        u->step = PREPARE_COMMIT;
    }
}

/* Sets the motion of a frame from the surface: position, velocity, and the rotation nearest to the deformation
   gradient; an affine frame gets the gradient itself. */
static void TakeMotion(const kiriSheetData* sheet, kiriFrameData* frame, int32_t triangle)
{
    kiriMotion motion = kiriSkin_Motion(&sheet->vertexSkin, sheet->frames.data, &sheet->mesh, triangle, frame->anchor);
    frame->x = motion.x;
    frame->velocity = motion.velocity;
    if (sheet->settings.mechanics.model == KIRI_MODEL_LINKS) {
        frame->A = kiriMat3_Rotation(motion.A);
        frame->spin = motion.spin;
    } else {
        frame->A = motion.A;
        frame->spin = kiriMat3_Spin(&motion.A, &motion.rate);
        frame->rate = kiriMat3_Beside(&motion.A, &motion.rate, frame->spin);
    }
}

static void TakeFits(kiriSheetData* sheet)
{
    kiriRefit* refit = &sheet->update->refit;
    KIRI_EACH(const kiriFit, fit, refit->fits) {
        const kiriFrameData* state = &fit->state;
        kiriFrameData* frame = &sheet->frames.data[fit->frame];
        frame->x = state->x;
        frame->A = state->A;
        frame->velocity = state->velocity;
        frame->spin = state->spin;
        frame->rate = state->rate;
    }
    const kiriLayout* next = &sheet->update->next;
    kiriRefit_LimitEnergy(refit, sheet->frames.data, sheet->frames.count, next->framePiece.data, next->pieces.count,
                          &sheet->settings.material);
    /* Frames that do not fit floats: their piece diverged, so a fit of its rotation overflowed. Without fits velocities are
       from the host and in range. */
    KIRI_EACH_WHILE(refit->fits.count > 0, kiriFrameData, each, sheet->frames) {
        if (!kiriFrame_FitsFloats(each)) {
            kiriFrame_PutToRest(each);
        }
    }
    kiriRefit_Commit(refit, &sheet->mesh);
}

/* Adds new frames and fits frames with new material. New frames without a fit take their motion from the surface. */
static void AddFrames(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriRefit* refit = &u->refit;
    int32_t oldCount = sheet->frames.count, fit = 0;
    int32_t firstNew = u->placing.sites.count - u->newFrames.count; /* in a new sheet the frames already exist */
    KIRI_FROM_TO(i, oldCount, u->placing.sites.count) {
        const kiriNewFrame* from = &u->newFrames.data[i - firstNew];
        kiriFrameData* frame = &sheet->frames.data[i];
        KIRI_CLEAR(frame);
        frame->anchor = from->anchor;
        frame->center = kiriMesh_Local(&sheet->mesh, frame->anchor);
        /* All frames that carry a vertex are in one piece, and store its data. A new sheet has no frames. */
        kiriSpan span = sheet->vertexSkin.spans.data[sheet->mesh.triangles.data[from->triangle].vertex[0]];
        if (span.count > 0) {
            frame->pieceData = sheet->frames.data[sheet->vertexSkin.weights.data[span.first].frame].pieceData;
        }
    }
    if (!sheet->settings.popping) {
        kiriRefit_Solve(refit, sheet->frames.data, oldCount, &sheet->mesh, &sheet->regions, u->material.data,
                        &sheet->settings.material, sheet->settings.mechanics.model == KIRI_MODEL_LINKS);
    }
    KIRI_FROM_TO(i, oldCount, u->placing.sites.count) {
        while (fit < refit->fits.count && refit->fits.data[fit].frame < i) {
            ++fit;
        }
        if (fit == refit->fits.count || refit->fits.data[fit].frame != i) {
            TakeMotion(sheet, &sheet->frames.data[i], u->newFrames.data[i - firstNew].triangle);
        }
    }
    sheet->frames.count = u->placing.sites.count;
}

static void CommitFrames(kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    double densityPerArea = (double)sheet->settings.material.density * sheet->settings.material.thickness;
    AddFrames(sheet);
    KIRI_EACH_INDEX(i, sheet->frames) {
        kiriFrameData* frame = &sheet->frames.data[i];
        kiriVec2 was = frame->site.at;
        frame->site = u->placing.sites.data[i];
        if (i < u->placing.sites.count - u->newFrames.count && memcmp(&was, &frame->site.at, sizeof(was)) != 0) {
            frame->anchor = kiriGrid_Anchor(&sheet->grid, frame->site.cell); /* it followed a tear */
        }
        if (sheet->regions.dirty.data[i]) {
            double before = frame->mass;
            kiriFrame_Recenter(frame, &u->material.data[i], densityPerArea);
            /* Accelerations stay; torque and angular momentum of a rigid frame scale with its mass. */
            if (before > 0.0 && sheet->settings.mechanics.model == KIRI_MODEL_LINKS) {
                frame->history.turnGain = kiriMat3_Scale(frame->mass / before, &frame->history.turnGain);
                frame->history.turnPull = kiriMat3_Scale(frame->mass / before, &frame->history.turnPull);
            }
            sheet->regions.dirty.data[i] = 0;
        }
    }
    TakeFits(sheet);
}

static void CommitPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    KIRI_EACH(const kiriSample, moved, u->samples.movedPoints) {
        sheet->points.data[moved->frame].cell = moved->cell;
    }
    KIRI_EACH(const kiriSample, fresh, u->samples.newPoints) {
        KIRI_NEXT(sheet->points) = *fresh;
        kiriPlaces_Add(&sheet->pointPlaces, &sheet->mesh, fresh->at);
    }
    KIRI_EACH(kiriSample, point, sheet->points) {
        point->frame = sheet->regions.field.owner.data[point->cell];
    }
    u->samples.newPoints.count = u->samples.movedPoints.count = 0;
}

void kiriStage_Commit(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    u->counts.weights = (int32_t)sheet->shape.recomputed;
    u->counts.vertices = sheet->vertexSkin.staged.count;
    u->counts.points = sheet->pointSkin.staged.count;
    u->counts.links = sheet->links.changed;
    kiriPieceLists_Forget(&sheet->lists);
    sheet->probes.isFresh = false;
    int32_t oldLinks = sheet->links.links.count;
    bool keepsStrains = kiriSheet_KeepsStrains(sheet);
    if (kiriSheet_KeepsPulls(sheet)) {
        kiriStrainOffsets_Remember(&sheet->strainOffsets, sheet->frames.data, sheet->frames.count,
                                   sheet->regions.dirty.data);
    }
    if (sheet->plastics.isKept) {
        kiriPlastics_Remember(&sheet->plastics, sheet->links.links.data, oldLinks, sheet->frames.count,
                              u->placing.sites.count, &u->refit.ownership, &sheet->settings.material,
                              kiriSheet_Extent(sheet));
    }
    CommitFrames(sheet);
    CommitPoints(sheet);
    kiriView_TouchStaged(sheet);
    kiriSkin_Commit(&sheet->vertexSkin);
    kiriSkin_Commit(&sheet->pointSkin);
    kiriLinks_Commit(&sheet->links);
    if (keepsStrains) {
        const int32_t* was = sheet->links.was.count > 0 ? sheet->links.was.data : NULL;
        kiriStrainOffsets_Take(&sheet->strainOffsets, &sheet->plastics, sheet->links.next.data, oldLinks,
                               sheet->links.links.data, sheet->links.links.count, was, sheet->frames.data,
                               &sheet->settings.material);
    }
    kiriSolver_Commit(sheet->solver);
    kiriLayout layout = sheet->layout;
    sheet->layout = u->next;
    u->next = layout;
    kiriPieces_Keep(sheet, &u->next);
    kiriPins_WriteLinkParts(sheet);
    kiriPins_Keep(sheet, &u->next);
    kiriShape_ClearChanges(&sheet->shape);
    u->isScratch = false;
    kiriView_Resize(sheet, sheet->frames.count);
    sheet->seen.isElsewhere = true;
    u->samples.oldVertices = sheet->mesh.vertices.count;
}
