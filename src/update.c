#include "update.h"

#include "affine.h"
#include "point.h"
#include "view.h"

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
        u->isTorn = false;
        u->stamp = sheet->queue.data[0].stamp;
        while (u->count < sheet->queue.count && sheet->queue.data[u->count].stamp == u->stamp) {
            u->count += 1;
        }
    }
    u->isBegun = false;
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
    u->isTorn = u->startTorn;
    u->taken = u->startTaken;
    if (u->stage > 0) {
        DropStaged(sheet);
        u->isStale = true;
    }
    bool isFresh = u->startStage == 0 && u->startTaken == 0 && !u->startTorn;
    u->stage = u->startStage > 0 ? 1 : isFresh ? KIRI_NONE : 0;
    u->isBegun = false;
}

void kiriUpdate_Release(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    const kiriMemory* memory = sheet->memory;
    kiriArray_Release(memory, &u->sites);
    kiriArray_Release(memory, &u->moves);
    kiriPlacer_Release(&u->placer, memory);
    kiriArray_Release(memory, &u->marks);
    kiriArray_Release(memory, &u->allowed);
    kiriArray_Release(memory, &u->material);
    kiriArray_Release(memory, &u->parent);
    kiriRefresh_Release(&u->refresh, memory);
    kiriPointsWork_Release(&u->points, memory);
    kiriArray_Release(memory, &u->newPoints);
    kiriArray_Release(memory, &u->movedPoints);
}

/* ---- Mesh ---- */

/* Moves the blade of a cut to the next point of its polyline. */
static kiriProgress TakeStroke(kiriSheetData* sheet, const kiriStroke* stroke, kiriQuota* triangles)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriTip* tip = &stroke->cut->tip;
    kiriVec2 from = tip->last, to = stroke->to;
    if (stroke->jump || !kiriCut_Clip(mesh, &from, &to)) {
        tip->last = stroke->to;
        tip->blade = kiriCut_Place(mesh, stroke->to);
        return KIRI_DONE;
    }
    kiriPoint start = kiriMesh_Snap(mesh, from);
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
        progress = TakeStroke(sheet, &sheet->queue.data[u->taken], triangles);
        u->taken += progress == KIRI_DONE;
    }
    u->isTorn = u->isTorn || sheet->mesh.savedTriangles.count > 0;
    bool hasRoom = progress != KIRI_FAILED &&
                   kiriSkin_Inherit(&sheet->vertexSkin, sheet->memory, &sheet->mesh) &&
                   kiriView_Resize(sheet, sheet->frames.count, sheet->points.count);
    return hasRoom ? progress : KIRI_FAILED;
}

void kiriUpdate_CommitMesh(kiriSheetData* sheet)
{
    if (sheet->mesh.savedTriangles.count > 0) {
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
    if (u->isStale || (sheet->alwaysScratch && !u->isScratch)) {
        kiriGrid_Reset(&sheet->grid);
        kiriRegions_Reset(&sheet->regions);
        kiriShape_Reset(&sheet->shape);
        u->isStale = false;
        u->isScratch = true;
    }
    kiriProgress progress = kiriGrid_Update(&sheet->grid, &sheet->mesh, cells);
    if (progress == KIRI_DONE) {
        const kiriGridChanges* changes = &sheet->grid.changes;
        kiriSquares_ClearTouched(&sheet->mesh.squares);
        u->touched.cells = changes->made.count + changes->remade.count;
    }
    return progress;
}

/* ---- Regions ---- */

static bool Move(kiriSheetData* sheet, int32_t frame, int32_t was)
{
    kiriSiteMove move = { frame, was };
    return kiriArray_Push(sheet->memory, &sheet->update.moves, move);
}

static bool AddSite(kiriSheetData* sheet, kiriSite site)
{
    return kiriArray_Push(sheet->memory, &sheet->update.sites, site) &&
           Move(sheet, sheet->update.sites.count - 1, KIRI_NONE);
}

/* Does another site lie in the cell? Only sites of one square can be in each other's way. */
static bool IsTaken(const kiriUpdate* u, int32_t cell, int32_t before)
{
    for (int32_t m = 0; m < before; ++m) {
        if (u->sites.data[u->moves.data[m].frame].cell == cell) {
            return true;
        }
    }
    return false;
}

/* The cell of a site that was there. Cells only ever fall apart, so two sites that had cells of their own still can: where
   rounding says otherwise, the later site takes a free cell of its square. */
static void Relocate(kiriSheetData* sheet, int32_t m)
{
    kiriUpdate* u = &sheet->update;
    int32_t frame = u->moves.data[m].frame;
    int32_t cell = kiriSample_Around(&sheet->grid, &sheet->mesh, sheet->frames.data[frame].anchor);
    if (IsTaken(u, cell, m)) {
        cell = sheet->grid.squareCell.data[sheet->grid.cells.data[cell].square];
        while (IsTaken(u, cell, m) && sheet->grid.cells.data[cell].next != KIRI_NONE) {
            cell = sheet->grid.cells.data[cell].next;
        }
    }
    u->sites.data[frame].cell = cell;
}

/* Notes the frame whose site was in a cell that has changed, and those that share its square. */
static bool NoteSite(kiriSheetData* sheet, int32_t cell)
{
    kiriUpdate* u = &sheet->update;
    int32_t found = cell < sheet->regions.siteAt.count ? sheet->regions.siteAt.data[cell] : KIRI_NONE;
    if (found == KIRI_NONE) {
        return true;
    }
    int32_t square = kiriSquares_At(&sheet->mesh.squares, sheet->frames.data[found].anchor);
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        if (!u->marks.data[f] && kiriSquares_At(&sheet->mesh.squares, sheet->frames.data[f].anchor) == square) {
            u->marks.data[f] = 1;
            if (!Move(sheet, f, u->sites.data[f].cell)) {
                return false;
            }
        }
    }
    return true;
}

static void SortMoves(kiriUpdate* u)
{
    for (int32_t i = 1; i < u->moves.count; ++i) {
        kiriSiteMove move = u->moves.data[i];
        int32_t j = i;
        for (; j > 0 && u->moves.data[j - 1].frame > move.frame; --j) {
            u->moves.data[j] = u->moves.data[j - 1];
        }
        u->moves.data[j] = move;
    }
}

/* The frames whose sites may have to be found again: all of them when regions are made from scratch. */
static bool CollectMoves(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    const kiriGridChanges* changes = &sheet->grid.changes;
    bool ok = kiriArray_Resize(sheet->memory, &u->marks, sheet->frames.count);
    for (int32_t f = 0; ok && f < sheet->frames.count; ++f) {
        u->marks.data[f] = 0;
        ok = !u->isScratch || Move(sheet, f, KIRI_NONE);
    }
    if (u->isScratch) {
        return ok;
    }
    for (int32_t i = 0; ok && i < changes->gone.count; ++i) {
        ok = NoteSite(sheet, changes->gone.data[i]);
    }
    for (int32_t i = 0; ok && i < changes->restepped.count; ++i) {
        ok = NoteSite(sheet, changes->restepped.data[i]);
    }
    for (int32_t i = 0; ok && i < changes->remade.count; ++i) {
        ok = NoteSite(sheet, changes->remade.data[i].cell);
    }
    SortMoves(u);
    return ok;
}

static bool RelocateSites(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    u->moves.count = u->movesSeen = 0;
    if (!CollectMoves(sheet)) {
        return false;
    }
    int32_t kept = 0;
    for (int32_t m = 0; m < u->moves.count; ++m) {
        Relocate(sheet, m);
    }
    for (int32_t m = 0; m < u->moves.count; ++m) {
        kiriSiteMove move = u->moves.data[m];
        if (u->sites.data[move.frame].cell != move.was) {
            u->moves.data[kept++] = move;
        }
    }
    u->moves.count = kept;
    return true;
}

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

static double AreaOf(const kiriSheetData* sheet, const int32_t* cells, int32_t count)
{
    double area = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        area += sheet->grid.cells.data[cells[i]].material.area;
    }
    return area;
}

static double WholeArea(const kiriSheetData* sheet)
{
    return 0.5 * (double)kiriMesh_DoubledArea(&sheet->mesh) * sheet->mesh.step * sheet->mesh.step;
}

/* How many of `count` things spread over the sheet fall to the piece in the placer. */
static int32_t ShareOf(const kiriSheetData* sheet, int32_t count)
{
    const kiriPlacer* placer = &sheet->update.placer;
    if (count == 0) {
        return 1;
    }
    double share = AreaOf(sheet, placer->cells.data, placer->cells.count) / WholeArea(sheet);
    int32_t whole = (int32_t)(count * share + 0.5);
    return whole > 1 ? whole : 1;
}

/* How many frames the piece in the placer starts with. */
static int32_t FramesFor(const kiriSheetData* sheet)
{
    const kiriPlacer* placer = &sheet->update.placer;
    if (sheet->frameLength == 0.0) {
        return ShareOf(sheet, sheet->update.spread);
    }
    double area = AreaOf(sheet, placer->cells.data, placer->cells.count);
    double count = area / (sheet->frameLength * sheet->frameLength) + 0.5;
    int32_t most = sheet->maxFrames - sheet->update.sites.count;
    return count < 1.0 || most < 1 ? 1 : count < most ? (int32_t)count : most;
}

/* Starts placing frames in the piece of an orphan, and marks its cells as seen to. */
static bool StartOrphan(kiriSheetData* sheet, int32_t cell)
{
    kiriUpdate* u = &sheet->update;
    u->placer.sites.count = 0;
    if (!kiriPlacer_TakePiece(&u->placer, sheet->memory, &sheet->grid, cell)) {
        return false;
    }
    for (int32_t i = 0; i < u->placer.cells.count; ++i) {
        u->marks.data[u->placer.cells.data[i]] = 1;
    }
    return kiriPlacer_Start(&u->placer, sheet->memory, &sheet->grid, &sheet->mesh, NULL, FramesFor(sheet));
}

/* Frames for the pieces that have none, at least one each (section 5 of the paper). */
static kiriProgress PlaceInOrphans(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
    for (; u->at < sheet->regions.orphans.count; ++u->at) {
        int32_t cell = sheet->regions.orphans.data[u->at];
        if (!u->isPlacing && u->marks.data[cell]) {
            continue;
        }
        if (!u->isPlacing && !StartOrphan(sheet, cell)) {
            return KIRI_FAILED;
        }
        u->isPlacing = true;
        kiriProgress progress = kiriPlacer_Run(&u->placer, sheet->memory, &sheet->grid, &sheet->mesh, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        u->isPlacing = false;
        for (int32_t i = 0; i < u->placer.sites.count; ++i) {
            if (!AddSite(sheet, u->placer.sites.data[i])) {
                return KIRI_FAILED;
            }
        }
    }
    return KIRI_DONE;
}

static bool ClearMarks(kiriSheetData* sheet, int32_t count)
{
    kiriUpdate* u = &sheet->update;
    u->at = 0;
    if (!kiriArray_Resize(sheet->memory, &u->marks, count)) {
        return false;
    }
    if (count > 0) {
        memset(u->marks.data, 0, (size_t)count);
    }
    return true;
}

kiriProgress kiriUpdate_Regions(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
    if (u->step == RELOCATE) {
        if (!RelocateSites(sheet)) {
            return KIRI_FAILED;
        }
        u->step = DIVIDE;
    }
    for (;;) {
        kiriProgress progress = u->step == DIVIDE ? Divide(sheet, cells) : PlaceInOrphans(sheet, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (u->step == DIVIDE && sheet->regions.orphans.count == 0) {
            u->step = 0;
            return KIRI_DONE;
        }
        if (u->step == DIVIDE && !ClearMarks(sheet, sheet->grid.cells.count)) {
            return KIRI_FAILED;
        }
        u->step = u->step == DIVIDE ? PLACE : DIVIDE;
    }
}

/* ---- Shape, and re-sampling (section 5) ---- */

/* Has the frame a weight above rigidWeight over more than rigidArea? */
static bool IsRigid(const kiriSheetData* sheet, int32_t frame)
{
    double square = sheet->grid.side * sheet->grid.side / 1099511627776.0; /* 2^40, see kiriShape.rigid */
    return (double)sheet->shape.rigid.data[frame] * square > sheet->rigidArea;
}

/* Is the region of the frame too large to be one? By its radius of gyration, so that long ones count as large; a square is as
   large as its side. */
static bool IsLarge(const kiriSheetData* sheet, int32_t frame)
{
    if (sheet->frameLength == 0.0) {
        return false;
    }
    kiriMoments m = kiriTally_Moments(&sheet->regions.material.data[frame], 536870912.0 * sheet->mesh.step);
    kiriMoments about = kiriMoments_About(&m, kiriMoments_Center(&m));
    /* A quarter more than the length that frames are placed at: their regions differ. */
    return 6.0 * (about.uu + about.vv) > 1.5625 * sheet->frameLength * sheet->frameLength * m.area;
}

static bool NeedsAnother(const kiriSheetData* sheet, int32_t frame)
{
    return IsRigid(sheet, frame) || IsLarge(sheet, frame);
}

/* Marks the cells of the piece in which the weight of a rigid frame exceeds rigidWeight, or whose region is too large. */
static bool MarkRigidCells(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    if (!kiriArray_Resize(sheet->memory, &u->allowed, sheet->grid.cells.count)) {
        return false;
    }
    int32_t last = KIRI_NONE; /* cells come region by region, more or less */
    bool isLarge = false;
    for (int32_t i = 0; i < u->placer.cells.count; ++i) {
        int32_t cell = u->placer.cells.data[i], owner = sheet->regions.field.owner.data[cell];
        kiriSpan span = sheet->shape.spans.data[cell];
        isLarge = owner == last ? isLarge : IsLarge(sheet, owner);
        last = owner;
        u->allowed.data[cell] = isLarge;
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            const kiriCellWeight* weight = &sheet->shape.weights.data[k];
            u->allowed.data[cell] |= weight->value > sheet->shape.rigidWeight && IsRigid(sheet, weight->frame);
        }
    }
    return true;
}

/* The sites of the piece in the placer, by frame; their frames are marked as seen to. *old says whether one of them was there
   before this update. */
static bool TakeSites(kiriSheetData* sheet, bool* old)
{
    kiriUpdate* u = &sheet->update;
    u->placer.sites.count = 0;
    *old = false;
    for (int32_t i = 0; i < u->placer.cells.count; ++i) {
        int32_t frame = sheet->regions.siteAt.data[u->placer.cells.data[i]];
        if (frame != KIRI_NONE) {
            u->marks.data[frame] = 2; /* of the piece at hand */
            *old = *old || frame < sheet->frames.count;
        }
    }
    for (int32_t f = 0; f < u->marks.count; ++f) {
        if (u->marks.data[f] == 2 && !kiriArray_Push(sheet->memory, &u->placer.sites, u->sites.data[f])) {
            return false;
        }
    }
    return true;
}

/* One more site in the piece of the frame, in a rigid cell. In a piece all of whose sites are new they are all placed
   again, to lie evenly. */
static bool StartResample(kiriSheetData* sheet, int32_t frame)
{
    kiriUpdate* u = &sheet->update;
    bool old;
    int32_t count = 1;
    if (!kiriPlacer_TakePiece(&u->placer, sheet->memory, &sheet->grid, u->sites.data[frame].cell) ||
        !MarkRigidCells(sheet) || !TakeSites(sheet, &old)) {
        return false;
    }
    if (!old) {
        count += u->placer.sites.count;
        u->placer.sites.count = 0;
    }
    u->placer.known = old ? &sheet->regions.field : NULL;
    return kiriPlacer_Start(&u->placer, sheet->memory, &sheet->grid, &sheet->mesh, old ? u->allowed.data : NULL, count);
}

/* New sites take the indices of those of the piece that were placed again, then new ones. */
static bool GiveSites(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    int32_t next = u->placer.oldCount, known = u->marks.count;
    bool again = next == 0, ok = true;
    for (int32_t f = 0; ok && f < known; ++f) {
        if (u->marks.data[f] == 2) {
            u->marks.data[f] = 1;
            if (again && next < u->placer.sites.count) {
                ok = Move(sheet, f, u->sites.data[f].cell);
                u->sites.data[f] = u->placer.sites.data[next++];
            }
        }
    }
    while (ok && next < u->placer.sites.count) {
        ok = AddSite(sheet, u->placer.sites.data[next++]);
    }
    return ok;
}

/* One more frame for each piece with a rigid one. */
static kiriProgress Resample(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
    for (; u->at < u->marks.count && u->sites.count < sheet->maxFrames; ++u->at) {
        if (!u->isPlacing && (u->marks.data[u->at] || !NeedsAnother(sheet, u->at))) {
            continue;
        }
        if (!u->isPlacing && !StartResample(sheet, u->at)) {
            return KIRI_FAILED;
        }
        u->isPlacing = true;
        kiriProgress progress = kiriPlacer_Run(&u->placer, sheet->memory, &sheet->grid, &sheet->mesh, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        u->isPlacing = false;
        if (!GiveSites(sheet)) {
            return KIRI_FAILED;
        }
    }
    return KIRI_DONE;
}

static kiriProgress Weigh(kiriSheetData* sheet, kiriQuota* cells)
{
    kiriUpdate* u = &sheet->update;
    kiriProgress progress = kiriShape_Update(&sheet->shape, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions,
                                             u->sites.data, u->sites.count, u->moves.data, u->moves.count, cells);
    if (progress == KIRI_DONE) {
        kiriGrid_Settle(&sheet->grid);
        kiriRegions_Settle(&sheet->regions);
        u->moves.count = u->movesSeen = 0;
    }
    return progress;
}

static bool MeasureRegions(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    double extent = 536870912.0 * sheet->mesh.step; /* 2^29 lattice steps, see mesh.h */
    if (!kiriArray_Resize(sheet->memory, &u->material, u->sites.count)) {
        return false;
    }
    for (int32_t i = 0; i < u->sites.count; ++i) {
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
                                : u->step == RESAMPLE ? Resample(sheet, cells)
                                                      : Divide(sheet, cells);
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (u->step == RESAMPLE && u->moves.count == 0) {
            u->step = 0;
            return MeasureRegions(sheet) ? KIRI_DONE : KIRI_FAILED;
        }
        if (u->step == WEIGH && !ClearMarks(sheet, u->sites.count)) {
            return KIRI_FAILED;
        }
        u->step = u->step == REDIVIDE ? WEIGH : u->step + 1;
    }
}

/* ---- Pieces ---- */

static int32_t Find(int32_t* parent, int32_t i)
{
    while (parent[i] != i) {
        parent[i] = parent[parent[i]];
        i = parent[i];
    }
    return i;
}

/* Regions that links join are one piece, and others are not. */
static bool JoinFrames(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    if (!kiriArray_Resize(sheet->memory, &u->parent, u->sites.count)) {
        return false;
    }
    for (int32_t i = 0; i < u->sites.count; ++i) {
        u->parent.data[i] = i;
    }
    for (int32_t k = 0; k < sheet->links.next.count; ++k) {
        const kiriLink* link = &sheet->links.next.data[k];
        int32_t i = Find(u->parent.data, link->i), j = Find(u->parent.data, link->j);
        u->parent.data[i < j ? j : i] = i < j ? i : j;
    }
    return true;
}

/* The old piece that the material of a frame was in: of a new one, that of a frame which moves it on the old surface. */
static int32_t OriginOf(const kiriSheetData* sheet, int32_t frame)
{
    if (frame < sheet->frames.count) {
        return sheet->model.framePiece.data[frame];
    }
    if (sheet->frames.count == 0) {
        return KIRI_NONE;
    }
    int32_t triangle = sheet->grid.cells.data[sheet->update.sites.data[frame].cell].triangle;
    int32_t vertex = sheet->mesh.triangles.data[triangle].vertex[0];
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    return sheet->model.framePiece.data[sheet->vertexSkin.weights.data[span.first].frame];
}

/* Of the parts of one old piece the largest goes on, and the others came off. */
static void MarkCameOff(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->update.next;
    int32_t* largest = sheet->update.parent.data; /* of each origin; there are no more of them than frames */
    for (int32_t o = 0; o < sheet->model.pieces.count; ++o) {
        largest[o] = KIRI_NONE;
    }
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        int32_t o = next->pieces.data[p].origin;
        if (o != KIRI_NONE && (largest[o] == KIRI_NONE ||
                               next->pieces.data[p].area > next->pieces.data[largest[o]].area)) {
            largest[o] = p;
        }
    }
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        kiriPiece* piece = &next->pieces.data[p];
        piece->cameOff = piece->origin != KIRI_NONE && largest[piece->origin] != p;
    }
}

static bool BuildPieces(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    kiriModel* next = &u->next;
    next->pieces.count = 0;
    if (!JoinFrames(sheet) || !kiriArray_Resize(sheet->memory, &next->framePiece, u->sites.count)) {
        return false;
    }
    for (int32_t i = 0; i < u->sites.count; ++i) {
        int32_t root = Find(u->parent.data, i);
        if (root == i) {
            kiriPiece piece = { 0.0, OriginOf(sheet, i), false };
            next->framePiece.data[i] = next->pieces.count;
            if (!kiriArray_Push(sheet->memory, &next->pieces, piece)) {
                return false;
            }
        }
        next->framePiece.data[i] = next->framePiece.data[root];
        next->pieces.data[next->framePiece.data[i]].area += u->material.data[i].area;
    }
    MarkCameOff(sheet);
    return true;
}

/* ---- Samples ---- */

/* The points that were staged, in their new cells. */
static bool MovePoints(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    for (int32_t k = 0; k < sheet->pointSkin.staged.count; ++k) {
        int32_t point = sheet->pointSkin.staged.data[k].sample;
        kiriPoint at = sheet->points.data[point].at;
        kiriSample moved = { at, kiriSample_Around(&sheet->grid, &sheet->mesh, at), point };
        if (!kiriArray_Push(sheet->memory, &u->movedPoints, moved)) {
            return false;
        }
    }
    return true;
}

/* A piece with points only changes into one without when it falls apart. */
static bool NeedsPoints(const kiriSheetData* sheet)
{
    return sheet->pointCount > 0 && sheet->update.next.pieces.count != sheet->model.pieces.count;
}

/* Marks the pieces that hold a point. */
static bool MarkPieces(kiriSheetData* sheet)
{
    kiriUpdate* u = &sheet->update;
    if (!ClearMarks(sheet, u->next.pieces.count)) {
        return false;
    }
    for (int32_t i = 0; NeedsPoints(sheet) && i < sheet->points.count; ++i) {
        int32_t cell = kiriSample_Around(&sheet->grid, &sheet->mesh, sheet->points.data[i].at);
        u->marks.data[u->next.framePiece.data[sheet->regions.field.owner.data[cell]]] = 1;
    }
    return true;
}

static bool StartPoints(kiriSheetData* sheet, int32_t piece)
{
    kiriUpdate* u = &sheet->update;
    int32_t frame = 0;
    while (u->next.framePiece.data[frame] != piece) {
        ++frame;
    }
    u->placer.sites.count = 0;
    return kiriPlacer_TakePiece(&u->placer, sheet->memory, &sheet->grid, u->sites.data[frame].cell) &&
           kiriPlacer_Start(&u->placer, sheet->memory, &sheet->grid, &sheet->mesh, NULL,
                            ShareOf(sheet, sheet->pointCount));
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
    return BuildPieces(sheet) &&
           kiriRefresh_Start(&sheet->update.refresh, sheet->memory, &sheet->shape, &sheet->grid, &sheet->mesh,
                             sheet->update.oldVertices);
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
        return kiriPoints_Build(&u->next.patches, &u->points, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->shape,
                                u->material.data, sheet->integrationPoints, sheet->integrationOrder, planar);
    default:
        return true;
    }
}

static bool FindPinFrames(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->update.next;
    if (!kiriArray_Resize(sheet->memory, &next->pinFrame, sheet->pins.count)) {
        return false;
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        int32_t cell = kiriSample_Around(&sheet->grid, &sheet->mesh, sheet->pins.data[i].at);
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

kiriProgress kiriUpdate_Constants(kiriSheetData* sheet, kiriQuota* none)
{
    kiriUpdate* u = &sheet->update;
    (void)none;
    bool ok = BuildPatches(sheet) && FindPinFrames(sheet) && ReservePoints(sheet) &&
              kiriArray_Reserve(sheet->memory, &sheet->frames, u->sites.count) &&
              kiriSolver_Stage(sheet->solver, u->sites.count, sheet->links.next.data, sheet->links.next.count,
                               &u->next.patches);
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

static void CommitFrames(kiriSheetData* sheet)
{
    const kiriUpdate* u = &sheet->update;
    double densityPerArea = (double)sheet->material.density * sheet->material.thickness;
    for (int32_t i = sheet->frames.count; i < u->sites.count; ++i) {
        sheet->frames.data[i] = NewFrame(sheet, u->sites.data[i]);
    }
    sheet->frames.count = u->sites.count;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].site = u->sites.data[i];
        if (sheet->regions.touched.data[i]) {
            kiriFrame_Recenter(&sheet->frames.data[i], &u->material.data[i], densityPerArea);
            sheet->regions.touched.data[i] = 0;
        }
    }
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
    u->touched.weights = (int32_t)sheet->shape.recomputed;
    u->touched.vertices = sheet->vertexSkin.staged.count;
    u->touched.points = sheet->pointSkin.staged.count;
    u->touched.links = sheet->links.rebuilt;
    CommitFrames(sheet);
    CommitPoints(sheet);
    kiriSkin_Commit(&sheet->vertexSkin);
    kiriSkin_Commit(&sheet->pointSkin);
    kiriLinks_Commit(&sheet->links);
    kiriSolver_Commit(sheet->solver);
    kiriModel model = sheet->model;
    sheet->model = u->next;
    u->next = model;
    kiriShape_Settle(&sheet->shape);
    u->isScratch = false;
    u->oldVertices = sheet->mesh.vertices.count;
}
