#include "kiri_stages.h"

#include "../motion/kiri_affine.h"
#include "kiri_pin.h"
#include "kiri_seen.h"

#include <string.h>

/* What affine frames need beside links. */
static bool BuildAreaElements(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    bool planar = sheet->settings.mechanics.planar;
    switch (sheet->settings.mechanics.model) {
    case KIRI_MODEL_AFFINE:
        return kiriAffine_Build(&u->next.areaElements, sheet->memory, sheet->links.next.data, sheet->links.next.count,
                                u->material.data, u->placing.sites.count, planar);
    case KIRI_MODEL_POINTS:
        return kiriIntegration_Build(&u->next.areaElements, &u->integration, sheet->memory, &sheet->grid, &sheet->mesh,
                                     &sheet->shape, u->material.data, sheet->settings.integrationPoints,
                                     sheet->settings.integrationOrder, planar);
    default:
        return true;
    }
}

static bool ReservePoints(kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    int64_t need = (int64_t)sheet->points.count + u->samples.newPoints.count;
    return kiriArray_Reserve(sheet->memory, &sheet->points, need) &&
           kiriPlaces_Reserve(&sheet->pointPlaces, sheet->memory, &sheet->mesh, need) &&
           kiriView_Resize(sheet, sheet->update->placing.sites.count, (int32_t)need);
}

static kiriSystem NextSystem(const kiriSheetData* sheet, int32_t frameCount)
{
    const kiriUpdate* u = sheet->update;
    kiriSystem next;
    memset(&next, 0, sizeof(next));
    next.mechanics = sheet->settings.mechanics;
    next.material = sheet->settings.material;
    next.frameCount = frameCount;
    next.links = sheet->links.next.data;
    next.linkCount = sheet->links.next.count;
    next.corners = sheet->links.nextCorners.data;
    next.cornerCount = sheet->links.nextCorners.count;
    next.areaElements = &u->next.areaElements;
    next.linkWas = sheet->links.was.count > 0 ? sheet->links.was.data : NULL;
    next.cornerWas = sheet->links.was.count > 0 ? sheet->links.wasCorner.data : NULL;
    return next;
}

bool kiriStage_Solver(kiriSheetData* sheet, int32_t frameCount)
{
    const kiriLayout* layout = &sheet->update->next;
    kiriSystem next = NextSystem(sheet, frameCount);
    return kiriSolver_Stage(sheet->solver, &next, layout->framePiece.data, layout->pieces.count);
}

/* In the ticks that pay for the commit, and not in its own. */
static kiriProgress ReserveFrames(kiriSheetData* sheet, kiriQuota* samples)
{
    enum { READY_BYTES = 1024 }; /* for an item */
    int32_t count = sheet->update->placing.sites.count;
    kiriSystem next = NextSystem(sheet, count);
    const kiriRoom frames = KIRI_ROOM(sheet->memory, &sheet->frames, count);
    kiriProgress progress = kiriRooms_MakeReady(&frames, 1, samples, READY_BYTES);
    return progress == KIRI_DONE ? kiriSolver_Reserve(sheet->solver, &next, samples, READY_BYTES) : progress;
}

/* ---- Steps ---- */

static kiriProgress StageOwnersOfMaterial(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    u->newFrames.count = 0;
    u->due = 0;
    return kiriRefit_Stage(&u->refit, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions, u->isScratch,
                           samples);
}

/* What PrepareCommit and kiri_commit.c do within one tick, in items. */
static int64_t ItemsOfCommit(const kiriSheetData* sheet)
{
    enum { WEIGHTS_AN_ITEM = 64, OWNERS_AN_ITEM = 256, ELEMENTS_AN_ITEM = 8, ITEMS_OF_FIT = 2 };
    const kiriUpdate* u = sheet->update;
    int64_t weights = (int64_t)sheet->vertexSkin.staged.count + sheet->pointSkin.staged.count;
    int64_t elements = (int64_t)sheet->links.next.count + sheet->links.nextCorners.count + u->placing.sites.count;
    return 1 + weights / WEIGHTS_AN_ITEM + u->refit.ownership.staged.count / OWNERS_AN_ITEM + u->newFrames.count +
           ITEMS_OF_FIT * (int64_t)u->refit.most + sheet->links.changed + elements / ELEMENTS_AN_ITEM;
}

/* Where new frames take their motion from the surface: their anchors, and the triangles there. */
static kiriProgress PlaceNewFrames(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    int32_t count = u->placing.sites.count - sheet->frames.count;
    kiriProgress progress = ReserveFrames(sheet, samples);
    if (progress != KIRI_DONE || !kiriArray_Reserve(sheet->memory, &u->newFrames, count)) {
        return progress != KIRI_DONE ? progress : KIRI_FAILED;
    }
    while (kiriQuota_Pay(samples, &u->due)) {
        if (u->newFrames.count == count) {
            u->due = ItemsOfCommit(sheet);
            return KIRI_DONE;
        }
        int32_t cell = u->placing.sites.data[sheet->frames.count + u->newFrames.count].cell;
        kiriNewFrame frame = { kiriGrid_Anchor(&sheet->grid, &sheet->mesh, cell), KIRI_NONE };
        frame.triangle = kiriMesh_Locate(&sheet->mesh, frame.anchor);
        frame.triangle = frame.triangle == KIRI_NONE ? sheet->grid.cells.data[cell].triangle : frame.triangle;
        u->newFrames.data[u->newFrames.count++] = frame;
        u->due = 1 + kiriSquares_CountNodes(&sheet->mesh.squares, sheet->grid.cells.data[cell].square) / 4;
    }
    return KIRI_MORE;
}

/* When the commit is paid: all that the host may change between two ticks. */
static kiriProgress PrepareCommit(kiriSheetData* sheet, kiriQuota* samples)
{
    kiriUpdate* u = sheet->update;
    if (!kiriQuota_Pay(samples, &u->due)) {
        return KIRI_MORE;
    }
    bool ok = (!kiriSheet_KeepsStrains(sheet) ||
               kiriStrainOffsets_Reserve(&sheet->strainOffsets, sheet->memory,
                                         kiriMax(sheet->links.next.count, sheet->links.links.count),
                                         u->placing.sites.count)) &&
              BuildAreaElements(sheet) && kiriPins_Stage(sheet) && ReservePoints(sheet) &&
              kiriArray_Reserve(sheet->memory, &sheet->frames, u->placing.sites.count) &&
              kiriStage_Solver(sheet, u->placing.sites.count);
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

kiriProgress kiriStage_Constants(kiriSheetData* sheet, kiriQuota* samples)
{
    static kiriStageStep* const steps[] = { StageOwnersOfMaterial, PlaceNewFrames, PrepareCommit };
    return kiriStage_RunSteps(sheet, samples, steps, (int32_t)(sizeof(steps) / sizeof(steps[0])));
}
