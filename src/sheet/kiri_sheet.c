#include "kiri_sheet.h"

#include "kiri_piece.h"
#include "kiri_update.h"
#include "kiri_seen.h"

#include <string.h>

/* ---- Making and releasing ---- */

kiriSheetData* kiriSheet_New(kiriMemory* memory)
{
    kiriSheetData* sheet = kiriMemory_AllocZeroed(memory, sizeof(*sheet));
    if (sheet != NULL) {
        sheet->own = kiriMemory_Like(memory);
        sheet->shown = kiriMemory_Like(memory);
        sheet->memory = &sheet->own;
        sheet->update.stage = KIRI_NONE;
    }
    return sheet;
}

void kiriSheet_Delete(kiriSheetData* sheet, kiriMemory* memory)
{
    if (sheet != NULL) {
        kiriMemory_FreeAll(&sheet->shown);
        kiriMemory_FreeAll(&sheet->own);
        kiriArray_Release(memory, &sheet->queue);
        kiriArray_Release(memory, &sheet->cuts);
        kiriMemory_Free(memory, sheet);
    }
}

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
    double x = a > 1.0 ? a : 1.0;
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

static void SetFrames(kiriSheetData* sheet, const kiriSheetDef* def, double area)
{
    double share = area / (def->frameCount > 0 ? def->frameCount : 1), points = 4.0 * def->frameCount;
    sheet->maxFrames = def->maxFrames > def->frameCount ? def->maxFrames : def->frameCount;
    if (def->frameCount == 0) {
        double least = 3.0 * sheet->mesh.step * sheet->mesh.squares.side;
        double length = def->frameLength > 0.0f ? def->frameLength : BendingLength(&sheet->material);
        sheet->frameLength = length > least ? length : least;
        share = sheet->frameLength * sheet->frameLength;
        points = 4.0 * area / share < 1e6 ? 4.0 * area / share : 1e6;
    }
    sheet->integrationPoints = def->integrationPoints > 0 ? def->integrationPoints : points;
    sheet->shape.rigidWeight = def->rigidWeight;
    sheet->rigidArea = def->rigidArea > 0.0f ? def->rigidArea : 0.25 * share;
}

static void SetParameters(kiriSheetData* sheet, const kiriSheetDef* def)
{
    double longer = 536870912.0; /* 2^29 lattice steps, see mesh.h */
    double area = kiriMesh_Area(&sheet->mesh);
    sheet->material = def->material;
    sheet->snap = def->snapDistance > 0.0f ? def->snapDistance / sheet->mesh.step : 1e-4 * longer;
    SetFrames(sheet, def, area);
    sheet->crumbArea = def->crumbArea;
    sheet->iterations = def->iterations;
    sheet->pointCount = def->collisionPoints;
    sheet->mechanics.model = def->model;
    sheet->mechanics.planar = def->planar != 0;
    sheet->mechanics.axes = AxesOf(def);
    sheet->integrationOrder = def->integrationOrder;
    sheet->sleepSpeed = def->sleepSpeed;
    sheet->surface.skinning = def->skinning;
    sheet->alwaysScratch = def->fromScratch != 0;
    sheet->popping = def->popping != 0;
    sheet->fades.time = sheet->popping ? 0.0 : def->fadeTime;
    sheet->fades.least = 1e-7 * longer * sheet->mesh.step; /* of the longer side */
    sheet->pointFades = sheet->fades;
}

bool kiriSheet_ToLattice(const kiriSheetData* sheet, const float rest[2], kiriLatticePoint* at)
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
    kiriUpdate* u = &sheet->update;
    for (int32_t i = 0; i < def->frameCount; ++i) {
        kiriLatticePoint at;
        kiriSite site = { kiriSheet_ToLocal(sheet, &def->framePoints[2 * i]), KIRI_NONE };
        if (kiriSheet_ToLattice(sheet, &def->framePoints[2 * i], &at)) {
            site.cell = kiriGrid_CellAt(&sheet->grid, &sheet->mesh, at);
        }
        if (site.cell == KIRI_NONE) {
            *why = "a frame point lies outside the material";
            return KIRI_ERROR_ARGUMENT;
        }
        for (int32_t j = 0; j < i; ++j) {
            if (u->sites.data[j].cell == site.cell) {
                *why = "two frame points lie in one grid cell; a finer grid tells them apart";
                return KIRI_ERROR_ARGUMENT;
            }
        }
        kiriSiteMove move = { i, KIRI_NONE };
        if (!kiriArray_Push(sheet->memory, &u->sites, site) || !kiriArray_Push(sheet->memory, &u->moves, move)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    return KIRI_OK;
}

static void StartFrame(kiriSheetData* sheet, const kiriSheetDef* def, int32_t index)
{
    kiriSite site = sheet->update.sites.data[index];
    kiriFrameData* frame = &sheet->frames.data[index];
    memset(frame, 0, sizeof(*frame));
    frame->anchor = def->framePoints != NULL && index < def->frameCount
                        ? kiriMesh_Snap(&sheet->mesh, site.at)
                        : kiriGrid_Anchor(&sheet->grid, &sheet->mesh, site.cell);
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

bool kiriSheet_StartSkin(kiriSheetData* sheet)
{
    kiriSkin* skin = &sheet->vertexSkin;
    if (!kiriArray_Resize(sheet->memory, &skin->spans, sheet->mesh.vertices.count)) {
        return false;
    }
    memset(skin->spans.data, 0, sizeof(kiriSpan) * (size_t)skin->spans.count);
    return true;
}

/* The first update: all stages but the mesh's, without a limit. */
static bool BuildAll(kiriSheetData* sheet, const kiriSheetDef* def)
{
    kiriUpdate* u = &sheet->update;
    kiriQuota all = { INT64_MAX, 0 };
    u->step = 1; /* sites that the caller placed are where they shall be */
    u->whole = kiriMesh_Area(&sheet->mesh);
    u->spread = def->framePoints != NULL ? 0 : def->frameCount;
    return kiriSheet_StartSkin(sheet) && kiriUpdate_Regions(sheet, &all) == KIRI_DONE &&
           kiriUpdate_Shape(sheet, &all) == KIRI_DONE && kiriUpdate_Samples(sheet, &all) == KIRI_DONE &&
           kiriUpdate_Constants(sheet, &all) == KIRI_DONE;
}

static kiriResult Build(kiriSheetData* sheet, const kiriSheetDef* def, const char** why)
{
    kiriQuota all = { INT64_MAX, 0 };
    kiriResult result = KIRI_OK;
    sheet->update.isScratch = true;
    if (kiriUpdate_Grid(sheet, &all) != KIRI_DONE) {
        return KIRI_ERROR_MEMORY;
    }
    if (def->framePoints != NULL) {
        result = TakeSites(sheet, def, why);
    }
    if (result != KIRI_OK) {
        return result;
    }
    if (!BuildAll(sheet, def)) {
        return KIRI_ERROR_MEMORY;
    }
    sheet->frames.count = sheet->update.sites.count;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        StartFrame(sheet, def, i);
    }
    kiriUpdate_Commit(sheet);
    kiriView_WriteTopology(sheet);
    kiriMesh_Commit(&sheet->mesh);
    sheet->update.spread = 0;
    return KIRI_OK;
}

kiriResult kiriSheet_Init(kiriSheetData* sheet, const kiriSheetDef* def, const char** why)
{
    kiriResult result = kiriMesh_Init(&sheet->mesh, sheet->memory, def->restPositions, def->vertexCount, def->indices,
                                      def->triangleCount, def->gridResolution, why);
    if (result != KIRI_OK) {
        return result;
    }
    SetParameters(sheet, def);
    kiriMesh_Begin(&sheet->mesh);
    sheet->solver = kiriSolver_Create(sheet->memory, &sheet->mechanics);
    return sheet->solver != NULL ? Build(sheet, def, why) : KIRI_ERROR_MEMORY;
}

/* ---- Pins ---- */

/* While an update is at hand regions may be half done: then the frame that weighs most at the corners. */
static int32_t HeaviestAt(const kiriSheetData* sheet, int32_t triangle)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    kiriWeight heaviest = { KIRI_NONE, 0.0 };
    for (int corner = 0; corner < 3; ++corner) {
        kiriSpan span = skin->spans.data[sheet->mesh.triangles.data[triangle].vertex[corner]];
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            if (skin->weights.data[k].value > heaviest.value) {
                heaviest = skin->weights.data[k];
            }
        }
    }
    return heaviest.frame;
}

int32_t kiriSheet_FrameAt(const kiriSheetData* sheet, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    if (triangle == KIRI_NONE) {
        return KIRI_NONE;
    }
    if (sheet->update.stage > 0 || sheet->update.needsRebuild) {
        return HeaviestAt(sheet, triangle);
    }
    int32_t cell = kiriGrid_CellOf(&sheet->grid, &sheet->mesh, triangle, at);
    return cell == KIRI_NONE ? HeaviestAt(sheet, triangle) : sheet->regions.field.owner.data[cell];
}

bool kiriSheet_AddPin(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame)
{
    int64_t need = (int64_t)sheet->pins.count + 1;
    if (!kiriArray_Reserve(sheet->memory, &sheet->pins, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->pinRows, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->layout.pinFrame, need)) {
        return false;
    }
    sheet->pins.data[sheet->pins.count++] = *pin;
    sheet->layout.pinFrame.data[sheet->layout.pinFrame.count++] = frame;
    return true;
}

void kiriSheet_RemovePin(kiriSheetData* sheet, int32_t index)
{
    int32_t last = --sheet->pins.count;
    sheet->layout.pinFrame.count = last;
    sheet->pins.data[index] = sheet->pins.data[last];
    sheet->layout.pinFrame.data[index] = sheet->layout.pinFrame.data[last];
}
