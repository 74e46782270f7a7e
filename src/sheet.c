#include "sheet.h"

#include "affine.h"
#include "point.h"
#include "view.h"

#include <string.h>

/* ---- Making and releasing ---- */

static void ReleaseModel(kiriModel* model, const kiriMemory* memory)
{
    kiriGrid_Release(&model->grid, memory);
    kiriArray_Release(memory, &model->pieces);
    kiriArray_Release(memory, &model->sites);
    kiriRegions_Release(&model->regions, memory);
    kiriShape_Release(&model->shape, memory);
    kiriArray_Release(memory, &model->points);
    kiriSkin_Release(&model->vertexSkin, memory);
    kiriSkin_Release(&model->pointSkin, memory);
    kiriPatches_Release(&model->patches, memory);
    kiriArray_Release(memory, &model->pinFrame);
    kiriSolver_Destroy(model->solver);
}

void kiriSheet_Release(kiriSheetData* sheet)
{
    const kiriMemory* memory = sheet->memory;
    ReleaseModel(&sheet->model, memory);
    ReleaseModel(&sheet->next, memory);
    kiriField_Release(&sheet->field, memory);
    kiriMesh_Release(&sheet->mesh);
    kiriArray_Release(memory, &sheet->frames);
    kiriArray_Release(memory, &sheet->queue);
    kiriArray_Release(memory, &sheet->cuts);
    kiriArray_Release(memory, &sheet->pins);
    kiriArray_Release(memory, &sheet->contacts);
    kiriArray_Release(memory, &sheet->pinRows);
    kiriArray_Release(memory, &sheet->contactRows);
    kiriView_Release(sheet);
}

static kiriMat3 AxesOf(const kiriSheetDef* def)
{
    kiriMat3 axes;
    axes.u = kiriVec3_Normalize(kiriVec3_Load(def->axisU));
    axes.d = kiriVec3_Normalize(kiriVec3_Cross(axes.u, kiriVec3_Load(def->axisV)));
    axes.v = kiriVec3_Cross(axes.d, axes.u);
    return axes;
}

static void SetParameters(kiriSheetData* sheet, const kiriSheetDef* def)
{
    double longer = 536870912.0; /* 2^29 lattice steps, see mesh.h */
    double area = 0.5 * (double)kiriMesh_DoubledArea(&sheet->mesh) * sheet->mesh.step * sheet->mesh.step;
    sheet->material = def->material;
    sheet->snap = def->snapDistance > 0.0f ? def->snapDistance / sheet->mesh.step : 1e-4 * longer;
    sheet->rigidWeight = def->rigidWeight;
    sheet->rigidArea = def->rigidArea > 0.0f ? def->rigidArea : 0.25 * area / def->frameCount;
    sheet->maxFrames = def->maxFrames > def->frameCount ? def->maxFrames : def->frameCount;
    sheet->iterations = def->iterations;
    sheet->pointCount = def->collisionPoints;
    sheet->mechanics.model = def->model;
    sheet->mechanics.planar = def->planar != 0;
    sheet->mechanics.axes = AxesOf(def);
    sheet->integrationPoints = def->integrationPoints > 0 ? def->integrationPoints : 4 * def->frameCount;
    sheet->integrationOrder = def->integrationOrder;
}

bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriPoint* at)
{
    kiriVec2 local = kiriSheet_ToLocal(sheet, rest), end = local;
    bool inRange = kiriCut_Clip(&sheet->mesh, &local, &end);
    if (inRange) {
        *at = kiriMesh_Snap(&sheet->mesh, local);
    }
    return inRange;
}

/* The frames that the caller placed. */
static kiriResult TakeSites(kiriSheetData* sheet, const kiriSheetDef* def, const char** why)
{
    kiriModel* next = &sheet->next;
    for (int32_t i = 0; i < def->frameCount; ++i) {
        kiriPoint at;
        kiriSite site = { kiriSheet_ToLocal(sheet, &def->framePoints[2 * i]), KIRI_NONE };
        if (kiriSheet_ToLattice(sheet, &def->framePoints[2 * i], &at)) {
            site.cell = kiriSample_Cell(&next->grid, &sheet->mesh, at);
        }
        if (site.cell == KIRI_NONE) {
            *why = "a frame point lies outside the material";
            return KIRI_ERROR_ARGUMENT;
        }
        for (int32_t j = 0; j < i; ++j) {
            if (next->sites.data[j].cell == site.cell) {
                *why = "two frame points lie in one grid cell; a finer grid tells them apart";
                return KIRI_ERROR_ARGUMENT;
            }
        }
        if (!kiriArray_Push(sheet->memory, &next->sites, site)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    return KIRI_OK;
}

static void StartFrame(kiriSheetData* sheet, const kiriSheetDef* def, int32_t index)
{
    kiriSite site = sheet->next.sites.data[index];
    kiriFrameData* frame = &sheet->frames.data[index];
    memset(frame, 0, sizeof(*frame));
    frame->site = site;
    frame->anchor = def->framePoints != NULL && index < def->frameCount
                        ? kiriMesh_Snap(&sheet->mesh, site.at)
                        : kiriGrid_Anchor(&sheet->next.grid, &sheet->mesh, site.cell);
    frame->center = site.at;
    frame->A = sheet->mechanics.axes;
    kiriVec2 rest = kiriVec2_Add(sheet->mesh.origin, site.at);
    frame->x =
        kiriVec3_AddScaled(kiriVec3_AddScaled(kiriVec3_Load(def->position), rest.x, frame->A.u), rest.y, frame->A.v);
    frame->velocity = kiriVec3_Load(def->velocity);
    if (sheet->mechanics.planar) {
        double across = kiriVec3_Dot(frame->velocity, frame->A.d);
        frame->velocity = kiriVec3_AddScaled(frame->velocity, -across, frame->A.d);
    }
}

/* Frames for the pieces that have none, at least one each. */
static bool SpreadSites(kiriSheetData* sheet, int32_t count)
{
    kiriModel* next = &sheet->next;
    return kiriSites_Spread(&next->sites, sheet->memory, &next->grid, &sheet->mesh, &sheet->field, count);
}

static kiriResult Build(kiriSheetData* sheet, const kiriSheetDef* def, const char** why)
{
    kiriResult result = KIRI_OK;
    if (!kiriSheet_BuildGrid(sheet)) {
        return KIRI_ERROR_MEMORY;
    }
    if (def->framePoints != NULL) {
        result = TakeSites(sheet, def, why);
    }
    if (result != KIRI_OK) {
        return result;
    }
    if (!SpreadSites(sheet, def->framePoints != NULL ? 0 : def->frameCount) || !kiriSheet_BuildShape(sheet) ||
        !kiriSheet_BuildSamples(sheet) || !kiriSheet_BuildConstants(sheet)) {
        return KIRI_ERROR_MEMORY;
    }
    sheet->frames.count = sheet->next.sites.count;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        StartFrame(sheet, def, i);
    }
    kiriSheet_SwapModel(sheet);
    kiriSheet_Commit(sheet);
    return KIRI_OK;
}

kiriResult kiriSheet_Init(kiriSheetData* sheet, const kiriMemory* memory, const kiriSheetDef* def, const char** why)
{
    memset(sheet, 0, sizeof(*sheet));
    sheet->memory = memory;
    kiriResult result = kiriMesh_Init(&sheet->mesh, memory, def->restPositions, def->vertexCount, def->indices,
                                      def->triangleCount, def->gridResolution, why);
    if (result != KIRI_OK) {
        return result;
    }
    SetParameters(sheet, def);
    kiriMesh_Begin(&sheet->mesh);
    result = Build(sheet, def, why);
    if (result != KIRI_OK) {
        kiriSheet_Release(sheet);
    }
    return result;
}

/* ---- The stages of a cut ---- */

/* Moves the blade of a cut to the next point of its polyline. */
static bool TakeStroke(kiriSheetData* sheet, const kiriStroke* stroke)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriTip* tip = &stroke->cut->tip;
    kiriVec2 from = tip->last, to = stroke->to;
    tip->last = stroke->to;
    if (stroke->jump || !kiriCut_Clip(mesh, &from, &to)) {
        tip->blade = kiriCut_Place(mesh, stroke->to);
        return true;
    }
    kiriPoint start = kiriMesh_Snap(mesh, from);
    if (tip->blade.vertex == KIRI_NONE && (start.x != tip->blade.at.x || start.y != tip->blade.at.y)) {
        tip->blade = kiriCut_Place(mesh, from); /* it comes from far outside */
    }
    kiriQuota all = { INT64_MAX, 0 };
    return kiriCut_Move(mesh, &tip->blade, kiriMesh_Snap(mesh, to), sheet->snap, &all) == KIRI_DONE;
}

bool kiriSheet_SplitMesh(kiriSheetData* sheet)
{
    kiriMesh_Begin(&sheet->mesh);
    for (int32_t i = 0; i < sheet->granted; ++i) {
        if (!TakeStroke(sheet, &sheet->queue.data[i])) {
            return false;
        }
    }
    return kiriSkin_Inherit(&sheet->model.vertexSkin, sheet->memory, &sheet->mesh);
}

bool kiriSheet_IsTorn(const kiriSheetData* sheet)
{
    return sheet->mesh.savedTriangles.count > 0;
}

bool kiriSheet_BuildGrid(kiriSheetData* sheet)
{
    kiriField_Release(&sheet->field, sheet->memory);
    return kiriGrid_Build(&sheet->next.grid, &sheet->mesh) &&
           kiriField_Init(&sheet->field, sheet->memory, sheet->next.grid.cells.count);
}

int32_t kiriSheet_CellAt(const kiriModel* model, const kiriMeshData* mesh, kiriPoint at)
{
    int32_t cell = kiriSample_Cell(&model->grid, mesh, at);
    if (cell == KIRI_NONE) {
        /* A point on a slanted outline may be off the material by a rounding of the lattice after a cut. */
        int32_t square = kiriSquares_At(&mesh->squares, at);
        cell = square == KIRI_NONE ? KIRI_NONE : model->grid.squareCell.data[square];
    }
    return cell;
}

/* The sites of the frames that are there, in the cells of the new grid. Cells only ever fall apart, so two sites that had
   cells of their own still can: where rounding says otherwise, the later site takes a free cell of its square. */
static bool RelocateSites(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->next;
    kiriField_Reset(&sheet->field);
    next->sites.count = 0;
    if (!kiriArray_Reserve(sheet->memory, &next->sites, sheet->frames.count)) {
        return false;
    }
    int32_t* taken = sheet->field.owner.data;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriSite site = sheet->frames.data[i].site;
        site.cell = kiriSheet_CellAt(next, &sheet->mesh, sheet->frames.data[i].anchor);
        if (taken[site.cell] != KIRI_NONE) {
            site.cell = next->grid.squareCell.data[next->grid.cells.data[site.cell].square];
            while (taken[site.cell] != KIRI_NONE && next->grid.cells.data[site.cell].next != KIRI_NONE) {
                site.cell = next->grid.cells.data[site.cell].next;
            }
        }
        taken[site.cell] = i;
        next->sites.data[next->sites.count++] = site;
    }
    for (int32_t i = 0; i < next->sites.count; ++i) {
        taken[next->sites.data[i].cell] = KIRI_NONE;
    }
    return true;
}

bool kiriSheet_BuildRegions(kiriSheetData* sheet)
{
    return RelocateSites(sheet) && SpreadSites(sheet, 0);
}

static int32_t PieceOfSite(const kiriModel* model, int32_t site)
{
    return model->grid.cells.data[model->sites.data[site].cell].piece;
}

/* Marks the cells in which the weight of one frame exceeds rigidWeight, where these have more than rigidArea in all. */
static bool MarkRigidCells(const kiriSheetData* sheet, uint8_t* rigid)
{
    const kiriModel* next = &sheet->next;
    double* areas = kiriMemory_Alloc(sheet->memory, (int64_t)sizeof(double) * next->sites.count);
    if (areas == NULL) {
        return false;
    }
    for (int32_t i = 0; i < next->sites.count; ++i) {
        areas[i] = 0.0;
    }
    for (int pass = 0; pass < 2; ++pass) {
        for (int32_t c = 0; c < next->grid.cells.count; ++c) {
            rigid[c] = 0;
            for (int32_t k = next->shape.start.data[c]; k < next->shape.start.data[c + 1]; ++k) {
                kiriWeight weight = next->shape.weights.data[k];
                if (weight.value > sheet->rigidWeight) {
                    areas[weight.frame] += pass == 0 ? next->grid.cells.data[c].material.area : 0.0;
                    rigid[c] |= areas[weight.frame] > sheet->rigidArea;
                }
            }
        }
    }
    kiriMemory_Free(sheet->memory, areas);
    return true;
}

static bool PlaceIn(kiriSheetData* sheet, int32_t piece, const uint8_t* allowed, int32_t count)
{
    kiriModel* next = &sheet->next;
    return kiriFrames_Place(&next->sites, sheet->memory, &next->grid, &sheet->mesh, &sheet->field, piece, allowed,
                            count);
}

/* One more site in the piece, in a rigid cell. In a piece all of whose sites are new they are all placed again, to lie
   evenly. */
static bool Resample(kiriSheetData* sheet, int32_t piece, const uint8_t* rigid)
{
    kiriModel* next = &sheet->next;
    int32_t kept = sheet->frames.count, again = 1;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (PieceOfSite(next, i) == piece) {
            return PlaceIn(sheet, piece, rigid, 1);
        }
    }
    for (int32_t i = kept; i < next->sites.count; ++i) {
        if (PieceOfSite(next, i) == piece) {
            again += 1;
        } else {
            next->sites.data[kept++] = next->sites.data[i];
        }
    }
    next->sites.count = kept;
    return PlaceIn(sheet, piece, NULL, again);
}

/* The re-sampling of section 5: one more frame for each piece with rigid cells. *added says whether there was one. */
static bool AddFrames(kiriSheetData* sheet, bool* added)
{
    kiriModel* next = &sheet->next;
    int32_t before = next->sites.count, done = KIRI_NONE;
    uint8_t* rigid = kiriMemory_Alloc(sheet->memory, next->grid.cells.count);
    bool ok = rigid != NULL && MarkRigidCells(sheet, rigid);
    for (int32_t c = 0; ok && c < next->grid.cells.count && next->sites.count < sheet->maxFrames; ++c) {
        /* Each piece once; one that comes out of order has its turn in the next round. */
        int32_t piece = next->grid.cells.data[c].piece;
        if (rigid[c] && piece > done) {
            done = piece;
            ok = Resample(sheet, piece, rigid);
        }
    }
    kiriMemory_Free(sheet->memory, rigid);
    *added = next->sites.count > before;
    return ok;
}

bool kiriSheet_BuildShape(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->next;
    bool added = true;
    while (added) {
        if (!kiriRegions_Build(&next->regions, sheet->memory, &next->grid, &sheet->mesh, &sheet->field,
                               next->sites.data, next->sites.count) ||
            !kiriShape_Build(&next->shape, sheet->memory, &next->grid, &sheet->mesh, &next->regions, &sheet->field,
                             next->sites.data, next->sites.count) ||
            !AddFrames(sheet, &added)) {
            return false;
        }
    }
    return true;
}

/* The collision points that were there, in their new cells, and some for each piece that has none. */
static bool BuildPoints(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->next;
    const kiriSamples* old = &sheet->model.points;
    next->points.count = 0;
    if (sheet->pointCount == 0) {
        return true;
    }
    if (!kiriArray_Reserve(sheet->memory, &next->points, old->count)) {
        return false;
    }
    for (int32_t i = 0; i < old->count; ++i) {
        kiriSample sample = { old->data[i].at, kiriSheet_CellAt(next, &sheet->mesh, old->data[i].at) };
        next->points.data[next->points.count++] = sample;
    }
    return kiriSamples_Spread(&next->points, sheet->memory, &next->grid, &sheet->mesh, &sheet->field,
                              sheet->pointCount);
}

bool kiriSheet_BuildSamples(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->next;
    return BuildPoints(sheet) &&
           kiriSkin_BuildVertices(&next->vertexSkin, sheet->memory, &next->shape, &next->grid, &sheet->mesh) &&
           kiriSkin_BuildSamples(&next->pointSkin, sheet->memory, &next->shape, &next->grid, &sheet->mesh,
                                 &next->points);
}

/* The old piece that the material of a cell was in: that of a frame which moves it on the old surface. */
static int32_t OriginOf(const kiriSheetData* sheet, int32_t cell)
{
    const kiriModel* old = &sheet->model;
    if (old->grid.pieces == 0) {
        return KIRI_NONE;
    }
    int32_t triangle = sheet->next.grid.cells.data[cell].triangle;
    int32_t vertex = sheet->mesh.triangles.data[triangle].vertex[0];
    return PieceOfSite(old, old->vertexSkin.weights.data[old->vertexSkin.start.data[vertex]].frame);
}

/* largest[o] becomes the largest piece of origin o. */
static void FindLargest(const kiriModel* next, int32_t* largest, int32_t count)
{
    for (int32_t o = 0; o < count; ++o) {
        largest[o] = KIRI_NONE;
    }
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        const kiriPiece* piece = &next->pieces.data[p];
        if (piece->origin != KIRI_NONE) {
            int32_t* best = &largest[piece->origin];
            *best = *best == KIRI_NONE || piece->area > next->pieces.data[*best].area ? p : *best;
        }
    }
}

static bool BuildPieces(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->next;
    int32_t oldCount = sheet->model.grid.pieces;
    int32_t* largest = kiriMemory_Alloc(sheet->memory, (int64_t)sizeof(int32_t) * oldCount);
    if (largest == NULL || !kiriArray_Resize(sheet->memory, &next->pieces, next->grid.pieces)) {
        kiriMemory_Free(sheet->memory, largest);
        return false;
    }
    next->pieces.count = 0;
    for (int32_t c = 0; c < next->grid.cells.count; ++c) {
        const kiriCell* cell = &next->grid.cells.data[c];
        if (cell->piece == next->pieces.count) {
            next->pieces.data[next->pieces.count++] = (kiriPiece){ 0.0, OriginOf(sheet, c), false };
        }
        next->pieces.data[cell->piece].area += cell->material.area;
    }
    FindLargest(next, largest, oldCount);
    for (int32_t p = 0; p < next->pieces.count; ++p) {
        kiriPiece* piece = &next->pieces.data[p];
        piece->cameOff = piece->origin != KIRI_NONE && largest[piece->origin] != p;
    }
    kiriMemory_Free(sheet->memory, largest);
    return true;
}

/* What affine frames need beside links. */
static bool BuildPatches(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->next;
    bool planar = sheet->mechanics.planar;
    switch (sheet->mechanics.model) {
    case KIRI_MODEL_AFFINE:
        return kiriAffine_Build(&next->patches, sheet->memory, &next->regions, planar);
    case KIRI_MODEL_POINTS:
        return kiriPoints_Build(&next->patches, sheet->memory, &next->grid, &sheet->mesh, &sheet->field, &next->shape,
                                &next->regions, sheet->integrationPoints, sheet->integrationOrder, planar);
    default:
        return true;
    }
}

bool kiriSheet_BuildConstants(kiriSheetData* sheet)
{
    kiriModel* next = &sheet->next;
    kiriSolver_Destroy(next->solver);
    next->solver = NULL;
    if (!BuildPatches(sheet)) {
        return false;
    }
    next->solver = kiriSolver_CreateFor(sheet->memory, &sheet->mechanics, next->sites.count, next->regions.links.data,
                                        next->regions.links.count, &next->patches);
    if (next->solver == NULL || !kiriArray_Resize(sheet->memory, &next->pinFrame, sheet->pins.count)) {
        return false;
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        next->pinFrame.data[i] = next->regions.owner.data[kiriSheet_CellAt(next, &sheet->mesh, sheet->pins.data[i].at)];
    }
    return BuildPieces(sheet) && kiriArray_Reserve(sheet->memory, &sheet->frames, next->sites.count) &&
           kiriView_Resize(sheet, next->points.count);
}

/* ---- Commit and rollback ---- */

/* A frame that moves like the old surface at its anchor. */
static kiriFrameData NewFrame(const kiriSheetData* sheet, kiriSite site)
{
    kiriFrameData frame;
    memset(&frame, 0, sizeof(frame));
    frame.site = site;
    frame.anchor = kiriGrid_Anchor(&sheet->next.grid, &sheet->mesh, site.cell);
    frame.center = kiriMesh_Local(&sheet->mesh, frame.anchor);
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, frame.anchor);
    triangle = triangle == KIRI_NONE ? sheet->next.grid.cells.data[site.cell].triangle : triangle;
    kiriMotion motion =
        kiriSkin_Motion(&sheet->model.vertexSkin, sheet->frames.data, &sheet->mesh, triangle, frame.anchor);
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

void kiriSheet_SwapModel(kiriSheetData* sheet)
{
    kiriModel old = sheet->model;
    int32_t oldCount = sheet->frames.count;
    for (int32_t i = oldCount; i < sheet->next.sites.count; ++i) {
        sheet->frames.data[i] = NewFrame(sheet, sheet->next.sites.data[i]);
    }
    sheet->frames.count = sheet->next.sites.count;
    sheet->model = sheet->next;
    sheet->next = old;
    double densityPerArea = (double)sheet->material.density * sheet->material.thickness;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriFrameData* frame = &sheet->frames.data[i];
        frame->site = sheet->model.sites.data[i];
        kiriFrame_Recenter(frame, &sheet->model.regions.regions.data[i].material, densityPerArea);
    }
    kiriView_WriteTopology(sheet);
}

void kiriSheet_Commit(kiriSheetData* sheet)
{
    kiriMesh_Commit(&sheet->mesh);
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        if (i < sheet->granted) {
            sheet->queue.data[i].cut->waiting -= 1;
        } else {
            sheet->queue.data[i - sheet->granted] = sheet->queue.data[i];
        }
    }
    sheet->queue.count -= sheet->granted;
    sheet->granted = 0;
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        sheet->cuts.data[i]->committed = sheet->cuts.data[i]->tip;
    }
}

void kiriSheet_Rollback(kiriSheetData* sheet)
{
    kiriMesh_Rollback(&sheet->mesh);
    kiriSkin_Truncate(&sheet->model.vertexSkin, sheet->mesh.vertices.count);
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        sheet->cuts.data[i]->tip = sheet->cuts.data[i]->committed;
    }
}

/* ---- Pins ---- */

int32_t kiriSheet_FrameAt(const kiriSheetData* sheet, kiriPoint at)
{
    int32_t cell = kiriSample_Cell(&sheet->model.grid, &sheet->mesh, at);
    return cell == KIRI_NONE ? KIRI_NONE : sheet->model.regions.owner.data[cell];
}

bool kiriSheet_AddPin(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame)
{
    int64_t need = (int64_t)sheet->pins.count + 1;
    if (!kiriArray_Reserve(sheet->memory, &sheet->pins, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->pinRows, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->model.pinFrame, need)) {
        return false;
    }
    sheet->pins.data[sheet->pins.count++] = *pin;
    sheet->model.pinFrame.data[sheet->model.pinFrame.count++] = frame;
    return true;
}

void kiriSheet_RemovePin(kiriSheetData* sheet, int32_t index)
{
    int32_t last = --sheet->pins.count;
    sheet->model.pinFrame.count = last;
    sheet->pins.data[index] = sheet->pins.data[last];
    sheet->model.pinFrame.data[index] = sheet->model.pinFrame.data[last];
}
