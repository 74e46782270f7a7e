#include "kiri_build.h"
#include "kiri_update.h"
#include "kiri_pin.h"
#include "kiri_seen.h"
#include "kiri_sheet_site.h"

#include <math.h>

/* Smallest contact thickness, as a fraction of a grid square. Less would need a finer contact search. */
#define LEAST_CONTACT_THICKNESS 0.05

/* The same between places of one piece, which bends sharply where it folds. */
#define FOLD_THICKNESS 0.125

static kiriSheetSettings SettingsOf(const kiriSheetDef* def)
{
    kiriSheetSettings given = { .material = def->material,
                                .maxFrames = def->maxFrames > 0 && def->maxFrames < def->frameCount ? def->frameCount
                                                                                                    : def->maxFrames,
                                .crumbArea = def->crumbArea,
                                .friction = def->friction,
                                .contactThickness = def->contactThickness,
                                .groups = def->groups,
                                .touchesSheets = def->touchesSheets,
                                .selfContact = def->selfContact,
                                .iterations = def->iterations,
                                .sleepSpeed = def->sleepSpeed,
                                .skinning = def->skinning,
                                .timeStepping = def->timeStepping,
                                .fadeTime = def->fadeTime,
                                .normals = def->normals };
    return given;
}

/* Copies checked settings. `square` is the side of a grid square, m. Settings of the def alone are already set. */
static void TakeSettings(kiriSettings* settings, const kiriSheetSettings* given, double square)
{
    double thickness = given->material.thickness, least = LEAST_CONTACT_THICKNESS * square;
    settings->given = *given;
    settings->given.cookie = 0;
    settings->material = given->material;
    settings->maxFrames = given->maxFrames;
    settings->crumbArea = given->crumbArea;
    settings->friction = given->friction;
    settings->contactThickness = given->contactThickness > 0.0f ? given->contactThickness : kiriMax(thickness, least);
    settings->foldThickness = kiriMax(settings->contactThickness, FOLD_THICKNESS * square);
    settings->groups = given->groups;
    settings->touchesSheets = given->touchesSheets != 0;
    settings->selfContact = given->selfContact != 0;
    settings->iterations = given->iterations;
    settings->sleepSpeed = given->sleepSpeed;
    settings->skinning = given->skinning;
    settings->mechanics.timeStepping = given->timeStepping;
    settings->fadeTime = settings->popping ? 0.0 : given->fadeTime;
}

int32_t kiriSettings_Detail(const kiriSettings* settings)
{
    return settings->mechanics.planar ? 0 : settings->material.detail;
}

void kiriSettings_Apply(kiriSheetData* sheet)
{
    const kiriSettings* settings = &sheet->settings;
    sheet->shape.rigidWeight = settings->rigidWeight;
    sheet->shape.eased = settings->eased;
    sheet->seen.surface.skinning = settings->skinning;
    sheet->seen.surface.wantsNormals = settings->given.normals != 0;
    kiriSurface_SetDetail(&sheet->seen.surface, kiriSettings_Detail(settings), sheet->seen.surface.detail.isHeld);
    sheet->seen.fades.time = sheet->seen.pointFades.time = settings->fadeTime;
    sheet->seen.fades.least = sheet->seen.pointFades.least = settings->leastFade;
    sheet->plastics.isKept |= kiriSettings_Bend(settings);
}

/* ---- Change --------------------------------------------------------------------------------------------------- */

/* Computes the masses for a new material; keeps poses and velocities. The next commit computes masses from the regions'
   exact moments. */
static void Weigh(kiriSheetData* sheet, const kiriMaterial* before)
{
    const kiriMaterial* now = &sheet->settings.material;
    double was = (double)before->density * before->thickness, is = (double)now->density * now->thickness;
    KIRI_EACH_INDEX(i, sheet->frames) {
        kiriFrameData* frame = &sheet->frames.data[i];
        frame->mass = is * frame->area;
        KIRI_TIMES(k, 3) {
            frame->inertia[k] *= is / was;
        }
        KIRI_CLEAR(&frame->history);
        sheet->regions.dirty.data[i] = 1;
    }
    kiriLinks_BeginAgain(&sheet->links);
}

/* Gives links and clamps another rest curvature. Offsets fade towards it. */
static void TakeRest(kiriSheetData* sheet, const kiriMaterial* before)
{
    const kiriMaterial* now = &sheet->settings.material;
    const kiriLink* links = sheet->links.links.data;
    if (memcmp(before->restCurvature, now->restCurvature, sizeof(now->restCurvature)) == 0) {
        return;
    }
    KIRI_TIMES(k, kiriLink_CountBorders(links, sheet->links.links.count)) {
        kiriPlastic_Rest(&sheet->plastics.links.data[k], before, now, &links[k]);
    }
    kiriPins_TakeRest(sheet, before);
}

bool kiriSettings_Change(kiriSheetData* sheet, const kiriSheetSettings* given)
{
    kiriSheetSettings before = sheet->settings.given, after = *given;
    after.cookie = before.cookie;
    if (memcmp(&before, &after, sizeof(after)) == 0) { /* fields of four bytes: no padding */
        return true;
    }
    bool looksOther = sheet->seen.isElsewhere || given->skinning != before.skinning ||
                      given->material.detail != before.material.detail;
    bool isOther = memcmp(&given->material, &before.material, offsetof(kiriMaterial, detail)) != 0;
    kiriDetail* detail = &sheet->seen.surface.detail;
    int32_t sweeps = detail->sweeps;
    kiriSettings next = sheet->settings;
    next.material = given->material;
    detail->sweeps = sheet->settings.mechanics.planar ? 0 : given->material.detail;
    bool hasRoom = kiriDetail_Reserve(detail, &sheet->shown, sheet->mesh.vertices.count, sheet->mesh.triangles.count,
                                      sheet->frames.count);
    detail->sweeps = sweeps;
    if (!hasRoom || (looksOther &&
         !kiriView_ReserveFades(sheet, sheet->mesh.vertices.count, sheet->points.count, given->fadeTime)) ||
        (kiriSettings_Bend(&next) &&
         (!kiriPlastics_Reserve(&sheet->plastics, sheet->memory, sheet->links.links.count, sheet->frames.count) ||
          !kiriStrainOffsets_Reserve(&sheet->strainOffsets, sheet->memory, sheet->links.links.count,
                                     sheet->frames.count))) ||
        (isOther && !kiriStage_Solver(sheet, sheet->frames.count, &given->material, false))) {
        return false;
    }
    TakeSettings(&sheet->settings, given, sheet->mesh.step * sheet->mesh.squares.side);
    kiriSettings_Apply(sheet);
    sheet->seen.isElsewhere |= looksOther;
    if (sheet->seen.surface.wantsNormals) {
        kiriSurface_NeedNormals(&sheet->seen.surface);
    }
    if (sheet->plastics.isKept) { /* links that never yielded */
        kiriArray_Extend(&sheet->plastics.links, sheet->links.links.count, 0);
        kiriArray_Extend(&sheet->strainOffsets.strainOffsets, sheet->links.links.count, 0);
        TakeRest(sheet, &before.material);
    }
    if (!kiriSheet_KeepsStrains(sheet)) { /* without fadeTime links and clamps have no strain offsets (kiri_strain.h) */
        sheet->strainOffsets.strainOffsets.count = 0;
        KIRI_EACH(kiriPinShare, share, sheet->layout.pinShares) {
            memset(share->offset, 0, sizeof(share->offset));
        }
    }
    if (isOther) {
        kiriSolver_Commit(sheet->solver);
        Weigh(sheet, &before.material);
    }
    kiriSheet_WakeAll(sheet);
    return true;
}

/* ---- Settings ---- */

static void SetFrames(kiriSettings* settings, const kiriMeshData* mesh, const kiriSheetDef* def)
{
    double area = kiriMesh_Area(mesh);
    double share = area / (def->frameCount > 0 ? def->frameCount : 1), points = 4.0 * def->frameCount;
    if (def->frameCount == 0) {
        double least = 3.0 * mesh->step * mesh->squares.side;
        /* The error grows with (spacing / whole)^2, where whole is the longer side, or if it is shorter twice the length at
           which bending stiffness and weight of the material balance. Measured: tests/test_estimate.c. */
        double twice = 2.0 * kiriStrain_BalanceLength(&def->material), longer = KIRI_LATTICE * mesh->step;
        double whole = def->planar ? longer : kiriMin(twice, longer);
        double length = def->frameLength > 0.0f ? def->frameLength : sqrt((double)def->accuracy) * whole;
        settings->frameLength = kiriMax(length, least);
        share = settings->frameLength * settings->frameLength;
        points = kiriMin(4.0 * area / share, 1e6);
    }
    settings->integrationPoints = points;
    settings->rigidWeight = def->rigidWeight;
    settings->rigidArea = def->rigidArea > 0.0f ? def->rigidArea : 0.25 * share;
}

static void SetAll(kiriSettings* settings, const kiriMeshData* mesh, const kiriSheetDef* def)
{
    const kiriPaperOptions* paper = &def->paper;
    kiriMat3* axes = &settings->mechanics.axes;
    double longer = KIRI_LATTICE;
    SetFrames(settings, mesh, def);
    settings->snap = def->snapDistance > 0.0f ? def->snapDistance / mesh->step : 1e-4 * longer;
    settings->collisionPoints = def->collisionPoints;
    settings->mechanics.model = def->model;
    settings->mechanics.planar = def->planar != 0;
    axes->u = kiriVec3_Normalize(kiriVec3_Load(def->axisU));
    axes->d = kiriVec3_Normalize(kiriVec3_Cross(axes->u, kiriVec3_Load(def->axisV)));
    axes->v = kiriVec3_Cross(axes->d, axes->u);
    settings->leastFade = 1e-6 * longer * mesh->step; /* 1e-6 of the longer side */
    settings->integrationOrder = paper->integrationOrder;
    settings->fromScratch = paper->fromScratch != 0;
    settings->popping = paper->popping != 0;
    settings->eased = paper->linearWeights == 0 && settings->mechanics.model != KIRI_MODEL_POINTS;
    if (paper->integrationPoints > 0) {
        settings->integrationPoints = paper->integrationPoints;
    }
    kiriSheetSettings given = SettingsOf(def);
    TakeSettings(settings, &given, mesh->step * mesh->squares.side);
}

/* ---- Frames ---- */

/* Adds one site; `holder` has the site in each cell. False, with a fault, if its cell is missing or taken. */
static bool TakeFramePoint(kiriSheetData* sheet, const kiriSheetDef* def, int32_t index, int32_t* holder,
                           kiriFault* fault)
{
    const float* point = &def->framePoints[2 * index];
    kiriSites* sites = &sheet->update->placing.sites;
    kiriLatticePoint at;
    kiriSite site = { kiriSheet_ToLocal(sheet, point), KIRI_NONE };
    if (kiriSheet_ToLattice(sheet, point, &at)) {
        site.cell = kiriGrid_CellAt(&sheet->grid, at);
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
    KIRI_NEXT(*sites) = site;
    return true;
}

/* Adds the sites of the def. The grid must exist. */
static kiriResult TakeFramePoints(kiriSheetData* sheet, const kiriSheetDef* def, kiriFault* fault)
{
    kiriPlacingWork* placing = &sheet->update->placing;
    if (!kiriArray_Resize(sheet->memory, &placing->own, sheet->grid.cells.count) ||
        !kiriArray_Reserve(sheet->memory, &placing->sites, def->frameCount)) {
        return KIRI_ERROR_MEMORY;
    }
    kiriArray_Set(&placing->own, KIRI_NONE);
    KIRI_TIMES(i, def->frameCount) {
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
    KIRI_CLEAR(frame);
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

/* Counts the pieces of the grid. Fails on out of memory. */
static bool CountPieces(kiriSheetData* sheet, int32_t* pieces)
{
    const kiriGrid* grid = &sheet->grid;
    int32_t* parent = kiriMemory_Alloc(sheet->memory, grid->cells.count * (int64_t)sizeof(int32_t));
    if (parent == NULL) {
        return false;
    }
    kiriGrid_JoinCells(grid, parent);
    *pieces = 0;
    KIRI_EACH_INDEX(c, grid->cells) {
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
    }
    if (result != KIRI_OK) {
        return result;
    }
    sheet->update->placing.whole = kiriMesh_Area(&sheet->mesh);
    sheet->update->placing.spread =
        def->framePoints != NULL ? 0 : kiriMin(def->frameCount, kiriSites_MostIn(sheet->grid.cellCount));
    sheet->update->cut.settlesSites = def->frameCount == 0;
    if (sheet->update->placing.spread > 0 && !CountPieces(sheet, &sheet->update->placing.pieces)) {
        return KIRI_ERROR_MEMORY;
    }
    if (!kiriPipeline_Make(sheet, KIRI_READY)) {
        return KIRI_ERROR_MEMORY;
    }
    sheet->frames.count = sheet->update->placing.sites.count;
    KIRI_EACH_INDEX(i, sheet->frames) {
        LayFrame(sheet, def, i);
    }
    sheet->update->isNew = def->frameCount == 0 && !(def->frameLength > 0.0f);
    return kiriBuild_Commit(sheet) ? KIRI_OK : KIRI_ERROR_MEMORY;
}

/* Frees scratch arrays as large as the new sheet. Later updates need only the size of their changes. */
static void DropScratch(kiriSheetData* sheet)
{
    kiriOwnership* ownership = &sheet->update->refit.ownership;
    KIRI_ASSERT(sheet->vertexSkin.staged.count == 0 && ownership->staged.count == 0 && ownership->dirty.count == 0);
    kiriGrid_DropScratch(&sheet->grid);
    kiriShape_DropScratch(&sheet->shape, sheet->memory);
    kiriArray_Release(sheet->memory, &sheet->regions.changes);
    kiriArray_Release(sheet->memory, &sheet->regions.orphans);
    kiriArray_Release(sheet->memory, &sheet->regions.field.settled);
    kiriArray_Release(sheet->memory, &sheet->vertexSkin.staged);
    kiriArray_Release(sheet->memory, &sheet->update->samples.refresh.noted);
    kiriArray_Release(sheet->memory, &ownership->staged);
    kiriArray_Release(sheet->memory, &ownership->dirty);
}

bool kiriBuild_Commit(kiriSheetData* sheet)
{
    kiriStage_Commit(sheet);
    if (!kiriSkin_Sort(&sheet->vertexSkin, sheet->memory)) {
        return false;
    }
    kiriView_WriteTopology(sheet);
    kiriMesh_Commit(&sheet->mesh);
    sheet->update->stage = KIRI_NONE;
    sheet->update->placing.spread = 0;
    DropScratch(sheet);
    return true;
}

/* ---- Folds ------------------------------------------------------------------------------------------------------ */

/* Distance from the line within which its creases are, in snap distances: ends are within 3/2 (kiri_cut.h), or go on to a
   slanted lip within 4 times this. */
#define FOLD_REACH 2.0
#define ROUNDED_REACH 32.0 /* lattice steps: the least, for vertices along a line are rounded */

kiriResult kiriFolds_Add(kiriSheetData* sheet, const kiriFold* fold, kiriFault* fault)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriVec2 from = kiriSheet_ToLocal(sheet, fold->from), to = kiriSheet_ToLocal(sheet, fold->to);
    bool isInside = kiriCut_Clip(mesh, &from, &to);
    kiriFoldLine line = { kiriMesh_Snap(mesh, from),
                          kiriMesh_Snap(mesh, to),
                          kiriClamp(FOLD_REACH * sheet->settings.snap, ROUNDED_REACH, KIRI_MOST_FOLD_REACH),
                          fold->stiffness,
                          fold->restAngle,
                          fold->yieldMoment,
                          0 };
    isInside = isInside && !kiriLattice_IsSame(line.from, line.to);
    if (isInside && !kiriLine_Trace(&sheet->line, sheet->memory, mesh, line.from, line.to)) {
        return KIRI_ERROR_MEMORY;
    }
    if (!isInside || sheet->line.parts.count == 0) {
        KIRI_SAY(fault, "fold %lld is a point, or meets no material", (long long)mesh->folds.count);
        return KIRI_ERROR_ARGUMENT;
    }
    return kiriArray_Push(sheet->memory, &mesh->folds, line) ? KIRI_OK : KIRI_ERROR_MEMORY;
}

/* Creases the mesh along folds. */
static kiriResult AddFolds(kiriSheetData* sheet, const kiriFold* folds, int32_t count, kiriFault* fault)
{
    kiriMeshData* mesh = &sheet->mesh;
    kiriResult result = KIRI_OK;
    KIRI_TIMES_WHILE(result == KIRI_OK, i, count) {
        result = kiriFolds_Add(sheet, &folds[i], fault);
        if (result == KIRI_OK) {
            const kiriFoldLine* line = &mesh->folds.data[i];
            kiriQuota unlimited = { INT64_MAX, 0, 0, false };
            kiriBladeTip blade = kiriCut_PlaceAt(line->from);
            blade.fold = i + 1;
            mesh->folds.data[i].isMade = 1;
            kiriProgress progress = kiriCut_Move(mesh, &blade, line->to, sheet->settings.snap, &unlimited);
            result = progress == KIRI_DONE ? KIRI_OK : KIRI_ERROR_MEMORY;
        }
    }
    kiriMesh_Begin(mesh);
    return result;
}

kiriResult kiriBuild_FromDef(kiriSheetData* sheet, const kiriSheetDef* def, const kiriFold* folds, int32_t foldCount,
                             kiriFault* fault)
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
    result = AddFolds(sheet, folds, foldCount, fault);
    if (result != KIRI_OK) {
        return result;
    }
    sheet->solver = kiriSolver_Create(sheet->memory, &sheet->settings.mechanics);
    return sheet->solver != NULL ? BuildFromMesh(sheet, def, fault) : KIRI_ERROR_MEMORY;
}
