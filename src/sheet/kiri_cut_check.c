#include "kiri_sheet_check.h"

static const kiriMust TipMust[] = {
    KIRI_REALS(kiriTip, last, last),
    KIRI_INDEX_OR_NONE(KIRI_OF_VERTICES, kiriTip, blade.vertex, blade.vertex),
    KIRI_WITHIN(0, 0, kiriTip, blade.owed, blade.owed),
    KIRI_WITHIN(KIRI_BLADE_RESTS, KIRI_BLADE_RESTS, kiriTip, blade.phase, blade.phase),
};

static bool IsTip(kiriCheck* check, const kiriSheetData* sheet, const kiriTip* tip)
{
    const kiriBladeTip* blade = &tip->blade;
    bool isFine = kiriCheck_Object(check, TipMust, tip) &&
                  kiriCheck_That(check, kiriLattice_Has(blade->at) && kiriLattice_Has(blade->from) &&
                                            kiriLattice_Has(blade->to) && kiriLattice_Has(blade->goal) &&
                                            kiriLattice_Has(blade->lip));
    if (isFine && blade->vertex != KIRI_NONE) {
        kiriLatticePoint at = sheet->mesh.vertices.data[blade->vertex].at;
        isFine = kiriMesh_IsVertex(&sheet->mesh, blade->vertex) && at.x == blade->at.x && at.y == blade->at.y;
    }
    return kiriCheck_That(check, isFine);
}

/* As many points of each cut wait as it says. */
static bool ArePointsCounted(kiriCheck* check, const kiriSheetData* sheet)
{
    int32_t* waiting = (int32_t*)(void*)kiriCheck_Bytes(check, (int64_t)sizeof(int32_t) *
                                                                   (sheet->cuts.count > 0 ? sheet->cuts.count : 1));
    bool areFine = waiting != NULL;
    for (int32_t k = 0; areFine && k < sheet->queue.count; ++k) {
        waiting[sheet->queue.data[k].cut->index] += 1;
    }
    for (int32_t c = 0; areFine && c < sheet->cuts.count; ++c) {
        areFine = waiting[c] == sheet->cuts.data[c]->waiting;
    }
    kiriMemory_Free(&check->memory, waiting);
    return kiriCheck_That(check, areFine);
}

static bool AreCuts(kiriCheck* check, const kiriSheetData* sheet)
{
    bool areFine = true;
    for (int32_t c = 0; areFine && c < sheet->cuts.count; ++c) {
        areFine =
            IsTip(check, sheet, &sheet->cuts.data[c]->tip) && IsTip(check, sheet, &sheet->cuts.data[c]->committed);
    }
    return areFine && ArePointsCounted(check, sheet);
}

static const kiriMust PointMust[] = {
    KIRI_REALS(kiriQueuedPoint, to, to),
    KIRI_COUNTS(kiriQueuedPoint, stamp, stamp),
};

static bool IsQueue(kiriCheck* check, const kiriSheetData* sheet)
{
    bool isFine = true;
    for (int32_t k = 0; isFine && k < sheet->queue.count; ++k) {
        const kiriQueuedPoint* point = &sheet->queue.data[k];
        isFine = kiriCheck_Object(check, PointMust, point) && kiriCheck_That(check, !point->ends || point->cut->ended);
    }
    return isFine;
}

bool kiriCuts_Check(const kiriSheetData* sheet, kiriCheck* check)
{
    return AreCuts(check, sheet) && IsQueue(check, sheet);
}
