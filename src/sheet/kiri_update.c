#include "kiri_update.h"

#include "../motion/kiri_affine.h"
#include "kiri_piece.h"
#include "../motion/kiri_integration.h"
#include "kiri_site.h"
#include "kiri_seen.h"

#include <string.h>

/* The steps of the stages that have more than one. */
enum {
    RELOCATE = 0,
    DIVIDE,
    PLACE,
    WEIGH = 0,
    RESAMPLE,
    REDIVIDE,
    BEGIN = 0,
    VERTICES,
    POINTS,
    NEW_POINTS,
};

/* ---- Begin and end ---- */

bool kiriUpdate_Start(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    if (u->stage == KIRI_NONE && sheet->queue.count > 0) {
        u->stage = u->step = u->count = u->taken = 0;
        u->meshChanged = false;
        u->stamp = sheet->queue.data[0].stamp;
        while (u->count < sheet->queue.count && sheet->queue.data[u->count].stamp == u->stamp) {
            u->count += 1;
        }
    }
    u->isBegun = false;
    sheet->fades.jump = sheet->fades.move = 0.0;
    return u->stage != KIRI_NONE;
}

void kiriUpdate_Finish(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        if (i < u->count) {
            sheet->queue.data[i].cut->waiting -= 1;
        } else {
            sheet->queue.data[i - u->count] = sheet->queue.data[i];
        }
    }
    sheet->queue.count -= u->count;
    u->stage = KIRI_NONE;
}

static void DropStaged(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    kiriSkin_Drop(&sheet->vertexSkin);
    kiriSkin_Drop(&sheet->pointSkin);
    u->newPoints.count = u->movedPoints.count = 0;
    u->sites.count = sheet->frames.count;
    u->moves.count = u->movesSeen = 0;
    u->isPlacing = false;
    u->step = 0;
    kiriRefit_Drop(&u->refit);
}

void kiriUpdate_Abort(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    if (!u->isBegun) {
        return;
    }
    kiriMesh_Rollback(&sheet->mesh);
    kiriSkin_Truncate(&sheet->vertexSkin, sheet->mesh.vertices.count);
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        sheet->cuts.data[i]->tip = sheet->cuts.data[i]->committed;
    }
    u->meshChanged = u->startMeshChanged;
    u->taken = u->startTaken;
    if (u->stage > 0) {
        DropStaged(sheet);
        u->needsRebuild = true;
    }
    bool isFresh = u->startStage == 0 && u->startTaken == 0 && !u->startMeshChanged;
    u->stage = u->startStage > 0 ? 1 : isFresh ? KIRI_NONE : 0;
    u->isBegun = false;
}

/* ---- Mesh ---- */

/* Moves the blade of a cut to the next point of its polyline. */
static kiriProgress TakeQueuedPoint(kiriSheetData* sheet, const kiriQueuedPoint* stroke, kiriQuota* triangles)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriTip* tip = &stroke->cut->tip;
    kiriVec2 from = tip->last, to = stroke->to;
    if (stroke->jump || !kiriCut_Clip(mesh, &from, &to)) {
        tip->last = stroke->to;
        tip->blade = kiriCut_Place(mesh, stroke->to);
        return KIRI_DONE;
    }
    kiriLatticePoint start = kiriMesh_Snap(mesh, from);
    if (tip->blade.vertex == KIRI_NONE && (start.x != tip->blade.at.x || start.y != tip->blade.at.y)) {
        tip->blade = kiriCut_Place(mesh, from); /* it comes from far outside */
    }
    kiriProgress progress = kiriCut_Move(mesh, &tip->blade, kiriMesh_Snap(mesh, to), sheet->snap, triangles);
    if (progress == KIRI_DONE) {
        tip->last = stroke->to;
    }
    return progress;
}

/* Takes strokes as far as the quota goes. Newborn vertices stay on the surface as it is. */
kiriProgress kiriUpdate_SplitMesh(kiriSheetData* sheet, kiriQuota* triangles)
{
    kiriUpdate* u = &sheet->update;
    kiriProgress progress = KIRI_DONE;
    kiriMesh_Begin(&sheet->mesh);
    while (progress == KIRI_DONE && u->taken < u->count) {
        progress = TakeQueuedPoint(sheet, &sheet->queue.data[u->taken], triangles);
        u->taken += progress == KIRI_DONE;
    }
    u->meshChanged = u->meshChanged || sheet->mesh.savedTriangles.count > 0;
    bool hasRoom = progress != KIRI_FAILED && kiriSkin_Inherit(&sheet->vertexSkin, sheet->memory, &sheet->mesh) &&
                   kiriView_Resize(sheet, sheet->frames.count, sheet->points.count);
    return hasRoom ? progress : KIRI_FAILED;
}

void kiriUpdate_CommitMesh(kiriSheetData* sheet)
{
    if (sheet->mesh.savedTriangles.count > 0) {
        sheet->lists.isFresh = false;
        kiriView_WriteTopology(sheet);
    }
    kiriMesh_Commit(&sheet->mesh);
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        sheet->cuts.data[i]->committed = sheet->cuts.data[i]->tip;
    }
}

/* ---- Grid ---- */

kiriProgress kiriUpdate_Grid(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
    if (u->needsRebuild || (sheet->alwaysScratch && !u->isScratch)) {
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
        u->counts.cells = changes->made.count + changes->remade.count;
    }
    return progress;
}

/* ---- Regions ---- */

static kiriProgress Divide(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
    kiriProgress progress =
        kiriRegions_Update(&sheet->regions, sheet->memory, &sheet->grid, &sheet->mesh, u->sites.data, u->sites.count,
                           u->moves.data + u->movesSeen, u->moves.count - u->movesSeen, cells);
    if (progress == KIRI_DONE) {
        u->movesSeen = u->moves.count;
    }
    return progress;
}

kiriProgress kiriUpdate_Regions(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
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
            u->step = 0;
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
    kiriUpdate* u = &sheet->update;
    kiriProgress progress = kiriShape_Update(&sheet->shape, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions,
                                             u->sites.data, u->sites.count, u->moves.data, u->moves.count, cells);
    if (progress == KIRI_DONE) {
        if (!kiriOwnership_NoteChanges(&u->refit.ownership, sheet->memory, &sheet->grid, &sheet->mesh,
                                       &sheet->regions)) {
            return KIRI_FAILED;
        }
        kiriGrid_ClearChanges(&sheet->grid);
        kiriRegions_ClearChanges(&sheet->regions);
        u->moves.count = u->movesSeen = 0;
    }
    return progress;
}

static bool MeasureRegions(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    double extent = 536870912.0 * sheet->mesh.step; /* 2^29 lattice steps, see mesh.h */
    int32_t known = u->material.count;
    if (!kiriArray_Resize(sheet->memory, &u->material, u->sites.count)) {
        return false;
    }
    for (int32_t i = 0; i < u->sites.count; ++i) {
        if (i < known && !sheet->regions.dirty.data[i]) {
            continue;
        }
        u->material.data[i] = kiriTally_Moments(&sheet->regions.material.data[i], extent);
    }
    return kiriLinks_Update(&sheet->links, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions, &sheet->shape,
                            u->sites.data, u->sites.count);
}

kiriProgress kiriUpdate_Shape(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
    for (;;) {
        kiriProgress progress = u->step == WEIGH      ? Weigh(sheet, cells)
                                : u->step == RESAMPLE ? kiriSites_Resample(sheet, cells)
                                                      : Divide(sheet, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (u->step == RESAMPLE && u->moves.count == 0) {
            u->step = 0;
            return MeasureRegions(sheet) ? KIRI_DONE : KIRI_FAILED;
        }
        if (u->step == WEIGH && !kiriSites_ClearMarks(sheet, u->sites.count)) {
            return KIRI_FAILED;
        }
        u->step = u->step == REDIVIDE ? WEIGH : u->step + 1;
    }
}

/* ---- Samples ---- */

/* The points that were staged, in their new cells. */
static bool MovePoints(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    for (int32_t k = 0; k < sheet->pointSkin.staged.count; ++k) {
        int32_t point = sheet->pointSkin.staged.data[k].sample;
        kiriLatticePoint at = sheet->points.data[point].at;
        kiriSample moved = { at, kiriGrid_CellAround(&sheet->grid, &sheet->mesh, at), point };
        if (!kiriArray_Push(sheet->memory, &u->movedPoints, moved)) {
            return false;
        }
    }
    return true;
}

/* A piece with points only changes into one without when it falls apart. */
static bool NeedsPoints(const kiriSheetData* sheet)
{
    return sheet->pointCount > 0.0 && sheet->update.next.pieces.count != sheet->layout.pieces.count;
}

/* Marks the pieces that hold a point. */
static bool MarkPieces(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    if (!kiriSites_ClearMarks(sheet, u->next.pieces.count)) {
        return false;
    }
    u->whole = NeedsPoints(sheet) ? kiriMesh_Area(&sheet->mesh) : 0.0;
    for (int32_t i = 0; NeedsPoints(sheet) && i < sheet->points.count; ++i) {
        int32_t cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, sheet->points.data[i].at);
        u->marks.data[u->next.framePiece.data[sheet->regions.field.owner.data[cell]]] = 1;
    }
    return true;
}

static bool StartPoints(kiriSheetData* sheet, int32_t piece)
{
    kiriUpdate* u = &sheet->update;
    int32_t frame = u->next.pieces.data[piece].frame;
    u->placer.sites.count = 0;
    return kiriPlacer_TakePiece(&u->placer, sheet->memory, &sheet->grid, u->sites.data[frame].cell) &&
           kiriPlacer_Start(&u->placer, sheet->memory, &sheet->grid, &sheet->mesh, NULL,
                            kiriSites_ShareOf(sheet, sheet->pointCount));
}

static bool AddPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    for (int32_t i = 0; i < u->placer.sites.count; ++i) {
        int32_t cell = u->placer.sites.data[i].cell, sample = sheet->points.count + u->newPoints.count;
        kiriSample point = { kiriGrid_Anchor(&sheet->grid, &sheet->mesh, cell), cell, KIRI_NONE };
        if (!kiriArray_Push(sheet->memory, &u->newPoints, point) ||
            !kiriSkin_Stage(&sheet->pointSkin, sheet->memory, &sheet->shape, &sheet->grid, &sheet->mesh, sample, cell,
                            kiriMesh_Local(&sheet->mesh, point.at))) {
            return false;
        }
    }
    return true;
}

/* Collision points for each piece that has none. */
static kiriProgress PlacePoints(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = &sheet->update;
    for (; NeedsPoints(sheet) && u->at < u->next.pieces.count; ++u->at) {
        if (u->marks.data[u->at]) {
            continue;
        }
        if (!u->isPlacing && !StartPoints(sheet, u->at)) {
            return KIRI_FAILED;
        }
        u->isPlacing = true;
        kiriProgress progress = kiriPlacer_Run(&u->placer, sheet->memory, &sheet->grid, &sheet->mesh, samples);
        if (progress != KIRI_DONE) {
            return progress;
        }
        u->isPlacing = false;
        if (!AddPoints(sheet)) {
            return KIRI_FAILED;
        }
    }
    return KIRI_DONE;
}

static bool BeginSamples(kiriSheetData* sheet)
{
    return kiriPieces_Stage(sheet) && kiriRefresh_Start(&sheet->update.refresh, sheet->memory, &sheet->shape,
                                                        &sheet->grid, &sheet->mesh, sheet->update.oldVertices);
}

kiriProgress kiriUpdate_Samples(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = &sheet->update;
    kiriProgress progress = KIRI_DONE;
    if (u->step == BEGIN) {
        progress = BeginSamples(sheet) ? KIRI_DONE : KIRI_FAILED;
        u->step = VERTICES;
    }
    if (progress == KIRI_DONE && u->step == VERTICES) {
        progress = kiriRefresh_Vertices(&u->refresh, &sheet->vertexSkin, sheet->memory, &sheet->shape, &sheet->grid,
                                        &sheet->mesh, samples);
        u->step += progress == KIRI_DONE;
    }
    if (progress == KIRI_DONE && u->step == POINTS) {
        progress = kiriRefresh_Points(&u->refresh, &sheet->pointSkin, &sheet->pointPlaces, &sheet->points,
                                      sheet->memory, &sheet->shape, &sheet->grid, &sheet->mesh, samples);
        u->step += progress == KIRI_DONE;
        if (progress == KIRI_DONE && !(MovePoints(sheet) && MarkPieces(sheet))) {
            return KIRI_FAILED;
        }
    }
    if (progress == KIRI_DONE) {
        progress = PlacePoints(sheet, samples);
    }
    u->step = progress == KIRI_DONE ? 0 : u->step;
    return progress;
}

/* ---- Constants ---- */

/* What affine frames need beside links. */
static bool BuildPatches(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    bool planar = sheet->mechanics.planar;
    switch (sheet->mechanics.model) {
    case KIRI_MODEL_AFFINE:
        return kiriAffine_Build(&u->next.patches, sheet->memory, sheet->links.next.data, sheet->links.next.count,
                                u->material.data, u->sites.count, planar);
    case KIRI_MODEL_POINTS:
        return kiriIntegration_Build(&u->next.patches, &u->points, sheet->memory, &sheet->grid, &sheet->mesh,
                                     &sheet->shape, u->material.data, sheet->integrationPoints, sheet->integrationOrder,
                                     planar);
    default:
        return true;
    }
}

static bool FindPinFrames(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update.next;
    if (!kiriArray_Resize(sheet->memory, &next->pinFrame, sheet->pins.count)) {
        return false;
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        int32_t cell = kiriGrid_CellAround(&sheet->grid, &sheet->mesh, sheet->pins.data[i].at);
        next->pinFrame.data[i] = sheet->regions.field.owner.data[cell];
    }
    return true;
}

static bool ReservePoints(kiriSheetData* sheet)
{
    const kiriUpdate* u = &sheet->update;
    int64_t need = (int64_t)sheet->points.count + u->newPoints.count;
    return kiriArray_Reserve(sheet->memory, &sheet->points, need) &&
           kiriPlaces_Reserve(&sheet->pointPlaces, sheet->memory, &sheet->mesh, need) &&
           kiriView_Resize(sheet, sheet->update.sites.count, (int32_t)need);
}

/* Do links go on with their strains when a cut changes them? */
static bool Eases(const kiriSheetData* sheet)
{
    return sheet->mechanics.model == KIRI_MODEL_LINKS && sheet->fades.time > 0.0;
}

static int32_t Larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

kiriProgress kiriUpdate_Constants(kiriSheetData* sheet, kiriQuota* none)
{
    kiriUpdate* u = &sheet->update;
    (void)none;
    bool ok = (!Eases(sheet) ||
               kiriStrainOffsets_Reserve(&sheet->strainOffsets, sheet->memory,
                                         Larger(sheet->links.next.count, sheet->links.links.count), u->sites.count)) &&
              BuildPatches(sheet) && FindPinFrames(sheet) && ReservePoints(sheet) &&
              kiriRefit_Stage(&u->refit, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions, u->isScratch) &&
              kiriArray_Reserve(sheet->memory, &sheet->frames, u->sites.count) &&
              kiriSolver_Stage(sheet->solver, u->sites.count, sheet->links.next.data, sheet->links.next.count,
                               &u->next.patches, u->next.framePiece.data, u->next.pieces.count);
    return ok ? KIRI_DONE : KIRI_FAILED;
}

/* ---- Commit ---- */

/* A frame that appears takes its motion from the surface: position, velocity, and the rotation nearest to its slope; an
   affine frame the slope itself. */
static kiriFrameData NewFrame(const kiriSheetData* sheet, kiriSite site)
{
    kiriFrameData frame;
    memset(&frame, 0, sizeof(frame));
    frame.anchor = kiriGrid_Anchor(&sheet->grid, &sheet->mesh, site.cell);
    frame.center = kiriMesh_Local(&sheet->mesh, frame.anchor);
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, frame.anchor);
    triangle = triangle == KIRI_NONE ? sheet->grid.cells.data[site.cell].triangle : triangle;
    kiriMotion motion = kiriSkin_Motion(&sheet->vertexSkin, sheet->frames.data, &sheet->mesh, triangle, frame.anchor);
    frame.x = motion.x;
    frame.velocity = motion.velocity;
    if (sheet->mechanics.model == KIRI_MODEL_LINKS) {
        frame.A = kiriMat3_Rotation(motion.A);
        frame.spin = motion.spin;
    } else {
        frame.A = motion.A;
        frame.spin = kiriMat3_Spin(&motion.A, &motion.rate);
        frame.rate = kiriMat3_Beside(&motion.A, &motion.rate, frame.spin);
    }
    return frame;
}

/* What the frames with new material do, all from the motion before: see refit.h. */
static void FitFrames(kiriSheetData* sheet, int32_t oldCount)
{
    kiriUpdate* u = &sheet->update;
    if (!sheet->popping) {
        kiriRefit_Solve(&u->refit, sheet->frames.data, oldCount, &sheet->mesh, &sheet->regions, u->material.data,
                        &sheet->material, sheet->mechanics.model == KIRI_MODEL_LINKS);
    }
}

static void TakeFits(kiriSheetData* sheet)
{
    kiriRefit* refit = &sheet->update.refit;
    for (int32_t k = 0; k < refit->fits.count; ++k) {
        const kiriFrameData* state = &refit->fits.data[k].state;
        kiriFrameData* frame = &sheet->frames.data[refit->fits.data[k].frame];
        frame->x = state->x;
        frame->A = state->A;
        frame->velocity = state->velocity;
        frame->spin = state->spin;
        frame->rate = state->rate;
    }
    const kiriLayout* next = &sheet->update.next;
    kiriRefit_LimitEnergy(refit, sheet->frames.data, sheet->frames.count, next->framePiece.data, next->pieces.count,
                          &sheet->material);
    kiriRefit_Commit(refit, &sheet->mesh);
}

static void CommitFrames(kiriSheetData* sheet)
{
    const kiriUpdate* u = &sheet->update;
    double densityPerArea = (double)sheet->material.density * sheet->material.thickness;
    for (int32_t i = sheet->frames.count; i < u->sites.count; ++i) {
        sheet->frames.data[i] = NewFrame(sheet, u->sites.data[i]);
    }
    FitFrames(sheet, sheet->frames.count);
    sheet->frames.count = u->sites.count;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].site = u->sites.data[i];
        if (sheet->regions.dirty.data[i]) {
            kiriFrame_Recenter(&sheet->frames.data[i], &u->material.data[i], densityPerArea);
            sheet->regions.dirty.data[i] = 0;
        }
    }
    TakeFits(sheet);
}

static void CommitPoints(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    for (int32_t i = 0; i < u->movedPoints.count; ++i) {
        sheet->points.data[u->movedPoints.data[i].frame].cell = u->movedPoints.data[i].cell;
    }
    for (int32_t i = 0; i < u->newPoints.count; ++i) {
        sheet->points.data[sheet->points.count++] = u->newPoints.data[i];
        kiriPlaces_Add(&sheet->pointPlaces, sheet->memory, &sheet->mesh, u->newPoints.data[i].at);
    }
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        sheet->points.data[i].frame = sheet->regions.field.owner.data[sheet->points.data[i].cell];
    }
    u->newPoints.count = u->movedPoints.count = 0;
}

void kiriUpdate_Commit(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    u->counts.weights = (int32_t)sheet->shape.recomputed;
    u->counts.vertices = sheet->vertexSkin.staged.count;
    u->counts.points = sheet->pointSkin.staged.count;
    u->counts.links = sheet->links.changed;
    sheet->lists.isFresh = false;
    int32_t oldLinks = sheet->links.links.count;
    bool strainOffsets = Eases(sheet);
    if (strainOffsets) {
        kiriStrainOffsets_Remember(&sheet->strainOffsets, sheet->frames.data, sheet->frames.count);
    }
    CommitFrames(sheet);
    CommitPoints(sheet);
    kiriSkin_Commit(&sheet->vertexSkin);
    kiriSkin_Commit(&sheet->pointSkin);
    kiriLinks_Commit(&sheet->links);
    if (strainOffsets) {
        kiriStrainOffsets_Take(&sheet->strainOffsets, sheet->links.next.data, oldLinks, sheet->links.links.data,
                               sheet->links.links.count, sheet->frames.data);
    }
    kiriSolver_Commit(sheet->solver);
    kiriLayout layout = sheet->layout;
    sheet->layout = u->next;
    u->next = layout;
    kiriShape_ClearChanges(&sheet->shape);
    u->isScratch = false;
    sheet->isSeenElsewhere = true;
    u->oldVertices = sheet->mesh.vertices.count;
}
