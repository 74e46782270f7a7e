#include "kiri_build.h"

#include "../core/kiri_union_find.h"
#include "kiri_pipeline.h"
#include "kiri_seen.h"
#include "kiri_settings.h"
#include "kiri_site.h"
#include "kiri_stages.h"

#include <math.h>
#include <string.h>

/* ---- Settings ---- */

static kiriMat3 AxesOf(const kiriSheetDef* def)
{
    kiriMat3 axes;
    axes.u = kiriVec3_Normalize(kiriVec3_Load(def->axisU));
    axes.d = kiriVec3_Normalize(kiriVec3_Cross(axes.u, kiriVec3_Load(def->axisV)));
    axes.v = kiriVec3_Cross(axes.d, axes.u);
    return axes;
}

/* Newton's iteration from above. */
static double CubeRoot(double a)
{
    double x = kiriMax(a, 1.0);
    for (int i = 0; i < 200; ++i) {
        x = (2.0 * x + a / (x * x)) / 3.0;
    }
    return x;
}

/* Over which the material bends under its own weight: stiffness and weight of an area balance. */
static double BendingLength(const kiriMaterial* m)
{
    double h = m->thickness, nu = m->poissonsRatio;
    double stiffness = m->youngsModulus * h * h * h / (12.0 * (1.0 - nu * nu));
    return CubeRoot(stiffness / (m->density * h * 9.81));
}

/* The error of a shape falls with the square of the spacing, by the length over which it bends: that is the bending
   length, or the sheet where this is shorter. Measured: tests/test_estimate.c. */
static double SpacingFor(const kiriSheetDef* def, double longer)
{
    double bent = def->planar ? longer : 2.0 * BendingLength(&def->material);
    return sqrt((double)def->accuracy) * kiriMin(bent, longer);
}

static void SetFrames(kiriSettings* settings, const kiriMeshData* mesh, const kiriSheetDef* def)
{
    double area = kiriMesh_Area(mesh);
    double share = area / (def->frameCount > 0 ? def->frameCount : 1), points = 4.0 * def->frameCount;
    if (def->frameCount == 0) {
        double least = 3.0 * mesh->step * mesh->squares.side;
        double length = def->frameLength > 0.0f ? def->frameLength : SpacingFor(def, KIRI_LATTICE * mesh->step);
        settings->frameLength = kiriMax(length, least);
        share = settings->frameLength * settings->frameLength;
        points = kiriMin(4.0 * area / share, 1e6);
    }
    settings->integrationPoints = points;
    settings->rigidWeight = def->rigidWeight;
    settings->rigidArea = def->rigidArea > 0.0f ? def->rigidArea : 0.25 * share;
}

static void SetPaper(kiriSettings* settings, const kiriPaperOptions* paper)
{
    settings->integrationOrder = paper->integrationOrder;
    settings->fromScratch = paper->fromScratch != 0;
    settings->popping = paper->popping != 0;
    settings->eased = paper->linearWeights == 0 && settings->mechanics.model != KIRI_MODEL_POINTS;
    if (paper->integrationPoints > 0) {
        settings->integrationPoints = paper->integrationPoints;
    }
}

static void SetAll(kiriSettings* settings, const kiriMeshData* mesh, const kiriSheetDef* def)
{
    double longer = KIRI_LATTICE;
    SetFrames(settings, mesh, def);
    settings->snap = def->snapDistance > 0.0f ? def->snapDistance / mesh->step : 1e-4 * longer;
    settings->collisionPoints = def->collisionPoints;
    settings->mechanics.model = def->model;
    settings->mechanics.planar = def->planar != 0;
    settings->mechanics.axes = AxesOf(def);
    settings->leastFade = 1e-6 * longer * mesh->step; /* of the longer side */
    SetPaper(settings, &def->paper);
    kiriSheetSettings given = kiriSettings_Of(def);
    kiriSettings_Take(settings, &given, mesh->step * mesh->squares.side);
}

/* ---- Frames ---- */

/* Adds one site; `holder` has the site in each cell. False, with a fault, if its cell is missing or taken. */
static bool TakeFramePoint(kiriSheetData* sheet, const kiriSheetDef* def, int32_t index, int32_t* holder,
                           kiriFault* fault)
{
    const float* point = &def->framePoints[2 * (size_t)index];
    kiriSites* sites = &sheet->update->placing.sites;
    kiriLatticePoint at;
    kiriSite site = { kiriSheet_ToLocal(sheet, point), KIRI_NONE };
    if (kiriSheet_ToLattice(sheet, point, &at)) {
        site.cell = kiriGrid_CellAt(&sheet->grid, &sheet->mesh, at);
    }
    if (site.cell == KIRI_NONE) {
        KIRI_SAY(fault, "frame point %lld lies outside the material", (long long)index);
        return false;
    }
    if (holder[site.cell] != KIRI_NONE || kiriSites_IsCrowded(&sheet->grid, sites, &site, holder)) {
        KIRI_SAY(fault,
                 "frame point %lld is less than a grid square from an earlier one; a finer grid (gridResolution) "
                 "tells them apart",
                 (long long)index);
        return false;
    }
    holder[site.cell] = sites->count;
    sites->data[sites->count++] = site;
    return true;
}

/* The sites that the caller gave, when the grid is there. */
static kiriResult TakeFramePoints(kiriSheetData* sheet, const kiriSheetDef* def, kiriFault* fault)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    if (!kiriArray_Resize(sheet->memory, &placing->own, sheet->grid.cells.count) ||
        !kiriArray_Reserve(sheet->memory, &placing->sites, def->frameCount)) {
        return KIRI_ERROR_MEMORY;
    }
    for (int32_t c = 0; c < placing->own.count; ++c) {
        placing->own.data[c] = KIRI_NONE;
    }
    for (int32_t i = 0; i < def->frameCount; ++i) {
        if (!TakeFramePoint(sheet, def, i, placing->own.data, fault)) {
            return KIRI_ERROR_ARGUMENT;
        }
    }
    return KIRI_OK;
}

static void LayFrame(kiriSheetData* sheet, const kiriSheetDef* def, int32_t index)
{
    kiriSite site = sheet->update->placing.sites.data[index];
    kiriFrameData* frame = &sheet->frames.data[index];
    memset(frame, 0, sizeof(*frame));
    frame->anchor = def->framePoints != NULL && index < def->frameCount ? kiriMesh_Snap(&sheet->mesh, site.at)
                                                                        : sheet->update->newFrames.data[index].anchor;
    frame->center = site.at;
    frame->rigidAtStart = def->frameCount > 0 ? sheet->shape.rigid.data[index] : 0;
    frame->A = sheet->settings.mechanics.axes;
    kiriVec2 rest = kiriVec2_Add(sheet->mesh.origin, site.at);
    frame->x =
        kiriVec3_AddScaled(kiriVec3_AddScaled(kiriVec3_Load(def->position), rest.x, frame->A.u), rest.y, frame->A.v);
    frame->velocity = kiriVec3_Load(def->velocity);
    if (sheet->settings.mechanics.planar) {
        double across = kiriVec3_Dot(frame->velocity, frame->A.d);
        frame->velocity = kiriVec3_AddScaled(frame->velocity, -across, frame->A.d);
    }
}

/* False for memory. */
static bool CountPieces(kiriSheetData* sheet, int32_t* pieces)
{
    const kiriGrid* grid = &sheet->grid;
    int32_t* parent = kiriMemory_Alloc(sheet->memory, grid->cells.count * (int64_t)sizeof(int32_t));
    if (parent == NULL) {
        return false;
    }
    kiriGrid_JoinCells(grid, parent);
    *pieces = 0;
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        *pieces += kiriGrid_IsCell(grid, c) && kiriUnion_Root(parent, c) == c;
    }
    kiriMemory_Free(sheet->memory, parent);
    return true;
}

static kiriResult BuildFromMesh(kiriSheetData* sheet, const kiriSheetDef* def, kiriFault* fault)
{
    kiriResult result = kiriPipeline_Make(sheet, KIRI_STAGE_REGIONS) ? KIRI_OK : KIRI_ERROR_MEMORY;
    if (result == KIRI_OK && def->framePoints != NULL) {
        result = TakeFramePoints(sheet, def, fault);
    } else if (result == KIRI_OK && def->frameCount > kiriSites_MostIn(sheet->grid.cellCount)) {
        KIRI_SAY(fault, "the grid carries one frame for every two cells at most; a finer one (gridResolution) carries "
                        "more");
        result = KIRI_ERROR_ARGUMENT;
    }
    if (result != KIRI_OK) {
        return result;
    }
    sheet->update->placing.whole = kiriMesh_Area(&sheet->mesh);
    sheet->update->placing.spread = def->framePoints != NULL ? 0 : def->frameCount;
    sheet->update->cut.settlesSites = def->frameCount == 0;
    if (sheet->update->placing.spread > 0 && !CountPieces(sheet, &sheet->update->placing.pieces)) {
        return KIRI_ERROR_MEMORY;
    }
    if (!kiriPipeline_Make(sheet, KIRI_READY)) {
        return KIRI_ERROR_MEMORY;
    }
    sheet->frames.count = sheet->update->placing.sites.count;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        LayFrame(sheet, def, i);
    }
    return kiriBuild_Commit(sheet) ? KIRI_OK : KIRI_ERROR_MEMORY;
}

/* What is as long as all that has just been made, and later as what a cut changes. */
static void DropScratch(kiriSheetData* sheet)
{
    kiriOwnership* ownership = &sheet->update->refit.ownership;
    KIRI_ASSERT(sheet->vertexSkin.staged.count == 0 && ownership->staged.count == 0 && ownership->dirty.count == 0);
    kiriGrid_DropScratch(&sheet->grid, sheet->memory);
    kiriShape_DropScratch(&sheet->shape, sheet->memory);
    kiriArray_Release(sheet->memory, &sheet->regions.changes);
    kiriArray_Release(sheet->memory, &sheet->regions.orphans);
    kiriArray_Release(sheet->memory, &sheet->vertexSkin.settling);
    kiriArray_Release(sheet->memory, &sheet->update->samples.refresh.noted);
    kiriArray_Release(sheet->memory, &ownership->staged);
    kiriArray_Release(sheet->memory, &ownership->dirty);
}

bool kiriBuild_Commit(kiriSheetData* sheet)
{
    kiriStage_Commit(sheet);
    bool isSorted = sheet->vertexSkin.settling.count == 0; /* see kiri_extract.c */
    if (!isSorted && !kiriSkin_Sort(&sheet->vertexSkin, sheet->memory)) {
        return false;
    }
    kiriView_WriteTopology(sheet);
    kiriMesh_Commit(&sheet->mesh);
    sheet->update->stage = KIRI_NONE;
    sheet->update->placing.spread = 0;
    DropScratch(sheet);
    return true;
}

kiriResult kiriBuild_FromDef(kiriSheetData* sheet, const kiriSheetDef* def, kiriFault* fault)
{
    const kiriMeshInput input = { def->restPositions, def->vertexCount,    def->indices,
                                  def->triangleCount, def->gridResolution, def->weldDistance };
    kiriResult result = kiriMesh_Init(&sheet->mesh, sheet->memory, &input, fault);
    if (result != KIRI_OK) {
        return result;
    }
    SetAll(&sheet->settings, &sheet->mesh, def);
    kiriSettings_Apply(sheet);
    kiriMesh_Begin(&sheet->mesh);
    sheet->solver = kiriSolver_Create(sheet->memory, &sheet->settings.mechanics);
    return sheet->solver != NULL ? BuildFromMesh(sheet, def, fault) : KIRI_ERROR_MEMORY;
}
