#include "kiri_stages.h"

#include "kiri_seen.h"
#include "../motion/kiri_affine.h"

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

static bool FindPinFrames(kiriSheetData* sheet)
{
    kiriLayout* next = &sheet->update->next;
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
    const kiriUpdate* u = sheet->update;
    int64_t need = (int64_t)sheet->points.count + u->samples.newPoints.count;
    return kiriArray_Reserve(sheet->memory, &sheet->points, need) &&
           kiriPlaces_Reserve(&sheet->pointPlaces, sheet->memory, &sheet->mesh, need) &&
           kiriView_Resize(sheet, sheet->update->placing.sites.count, (int32_t)need);
}

static int32_t Larger(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

kiriProgress kiriStage_Constants(kiriSheetData* sheet, kiriQuota* none)
{
    kiriUpdate* u = sheet->update;
    (void)none;
    bool ok = (!kiriSheet_KeepsStrains(sheet) ||
               kiriStrainOffsets_Reserve(&sheet->strainOffsets, sheet->memory,
                                         Larger(sheet->links.next.count, sheet->links.links.count),
                                         u->placing.sites.count)) &&
              BuildAreaElements(sheet) && FindPinFrames(sheet) && ReservePoints(sheet) &&
              kiriRefit_Stage(&u->refit, sheet->memory, &sheet->grid, &sheet->mesh, &sheet->regions, u->isScratch) &&
              kiriArray_Reserve(sheet->memory, &sheet->frames, u->placing.sites.count) &&
              kiriSolver_Stage(sheet->solver, u->placing.sites.count, sheet->links.next.data, sheet->links.next.count,
                               &u->next.areaElements, u->next.framePiece.data, u->next.pieces.count);
    return ok ? KIRI_DONE : KIRI_FAILED;
}
