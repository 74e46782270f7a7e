#include "kiri_sheet_check.h"

static const kiriMust TipMust[] = {
    KIRI_REALS(kiriTip, last, last),
    KIRI_INDEX_OR_NONE(KIRI_OF_VERTICES, kiriTip, blade.vertex, blade.vertex),
    KIRI_COUNTS(kiriTip, blade.owed, blade.owed),
};

static bool IsTip(kiriCheck* check, const kiriSheetData* sheet, const kiriTip* tip)
{
    const kiriBladeTip* blade = &tip->blade;
    bool isFine = kiriCheck_Object(check, TipMust, tip) &&
                  kiriCheck_That(check, kiriLattice_Has(blade->at) && kiriLattice_Has(blade->from));
    if (isFine && blade->vertex != KIRI_NONE) {
        kiriLatticePoint at = sheet->mesh.vertices.data[blade->vertex].at;
        isFine = kiriMesh_IsVertex(&sheet->mesh, blade->vertex) && at.x == blade->at.x && at.y == blade->at.y;
    }
    return kiriCheck_That(check, isFine);
}

/* As many points of each cut wait as it says. */
static bool AreCuts(kiriCheck* check, const kiriSheetData* sheet)
{
    bool areFine = true;
    for (int32_t c = 0; areFine && c < sheet->cuts.count; ++c) {
        const kiriCutData* cut = sheet->cuts.data[c];
        areFine = IsTip(check, sheet, &cut->tip) && IsTip(check, sheet, &cut->committed) && cut->waiting >= 0;
    }
    int64_t waiting = 0;
    for (int32_t c = 0; areFine && c < sheet->cuts.count; ++c) {
        int32_t found = 0;
        for (int32_t k = 0; k < sheet->queue.count; ++k) {
            found += sheet->queue.data[k].cut == sheet->cuts.data[c];
        }
        areFine = found == sheet->cuts.data[c]->waiting;
        waiting += found;
    }
    return kiriCheck_That(check, areFine && waiting == sheet->queue.count);
}

static const kiriMust PointMust[] = {
    KIRI_REALS(kiriQueuedPoint, to, to),
    KIRI_COUNTS(kiriQueuedPoint, stamp, stamp),
};

static bool IsQueue(kiriCheck* check, const kiriSheetData* sheet)
{
    bool isFine = true;
    for (int32_t k = 0; isFine && k < sheet->queue.count; ++k) {
        isFine = kiriCheck_Object(check, PointMust, &sheet->queue.data[k]);
    }
    return isFine;
}

bool kiriCuts_Check(const kiriSheetData* sheet, kiriCheck* check)
{
    return AreCuts(check, sheet) && IsQueue(check, sheet);
}
