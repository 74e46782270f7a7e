#include "kiri_sheet_check.h"

#include "../motion/kiri_motion_check.h"
#include "kiri_update.h"

static const kiriMust UpdateMust[] = {
    KIRI_WITHIN(KIRI_NONE, KIRI_STAGE_GRID, kiriUpdate, stage, stage),
    KIRI_COUNTS(kiriUpdate, spent, spent),
    KIRI_COUNTS(kiriUpdate, cut.stamp, cut.stamp),
    KIRI_WITHIN(0, INT32_MAX, kiriUpdate, cut.count, cut.taken),
    KIRI_UP_TO(KIRI_OF_VERTICES, kiriUpdate, samples.oldVertices, samples.oldVertices),
};

/* Points are taken from the queue in the first stage. */
static bool IsCutting(const kiriUpdate* u, const kiriSheetData* sheet)
{
    int32_t steps = u->stage == KIRI_STAGE_CUT ? 1 : 0;
    return u->stage == KIRI_NONE ||
           (u->step >= 0 && u->step <= steps && u->cut.taken <= u->cut.count && u->cut.count <= sheet->queue.count &&
            (u->stage == KIRI_STAGE_CUT || u->cut.taken == u->cut.count));
}

bool kiriUpdate_Check(kiriCheck* check, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    return kiriCheck_Object(check, UpdateMust, u) && kiriCheck_That(check, IsCutting(u, sheet)) &&
           kiriOwnership_Check(&u->refit.ownership, check, &sheet->mesh);
}
