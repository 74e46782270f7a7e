/* Pieces that wait: for the end of the work on a cut, or until the budget has paid for them. */
#include "kiri_part_work.h"

#include "../sheet/kiri_ahead.h"
#include "../sheet/kiri_piece.h"

/* Those that are destroyed meanwhile become nothing; others were detached by a call while the budget was awaited. */
static void ForgetStaleLeaving(kiriWorld* world, kiriSheetData* sheet)
{
    int32_t kept = 0;
    for (int32_t k = 0; k < sheet->leaving.count; ++k) {
        kiriFrame frame = sheet->leaving.data[k];
        const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
        if (slot != NULL && slot->owner == sheet) {
            sheet->leaving.data[kept++] = frame;
        }
    }
    sheet->leaving.count = kept;
}

bool kiriParts_AreDue(const kiriSheetData* sheet)
{
    return !kiriPart_IsBusy(sheet) && (sheet->leaving.count > 0 || kiriPieces_AnyGone(sheet));
}

/* Samples for what is gone, and for the first `count` of those that leave. */
static int64_t CostOfLeaving(const kiriWorld* world, const kiriSheetData* sheet, int32_t count)
{
    const kiriPiece* pieces = sheet->layout.pieces.data;
    double whole = 0.0, gone = 0.0, share = 0.0;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        whole += pieces[p].area;
    }
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        gone += pieces[p].isGone ? pieces[p].area / whole : 0.0;
    }
    for (int32_t k = 0; k < count; ++k) {
        share += pieces[kiriPart_PieceOfFrame(world, sheet->leaving.data[k])].area / whole;
    }
    return (int64_t)(kiriRemoval_Samples(sheet, gone + share) + kiriExtraction_Samples(sheet, share));
}

/* Is the first of those that leave made ahead, and not done? Where there is no limit it is done at once. */
static bool IsAtWork(const kiriWorld* world, const kiriSheetData* sheet)
{
    return world->budget.samples > 0 && sheet->leaving.count > 0 && kiriAhead_IsAtWork(sheet, sheet->leaving.data[0]);
}

/* How many of those that leave the samples pay for, what was paid before with them: one at least, which takes several
   ticks if need be. KIRI_NONE: it is not paid for yet. */
static int32_t PayForLeaving(const kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples)
{
    int32_t count = sheet->leaving.count > 0, most = IsAtWork(world, sheet) ? 1 : sheet->leaving.count;
    int64_t paid = sheet->leavingPaid, cost = CostOfLeaving(world, sheet, count);
    while (count < most) {
        int32_t more = most - count > 16 ? count + (most - count) / 2 : count + 1;
        int64_t costOfMore = CostOfLeaving(world, sheet, more);
        if (costOfMore - paid > samples->left) {
            most = more - 1;
        } else {
            count = more;
            cost = costOfMore;
        }
    }
    int64_t due = cost > paid ? cost - paid : 0;
    bool isPaid = kiriQuota_Pay(samples, &due);
    sheet->leavingPaid = cost - due;
    return isPaid ? count : KIRI_NONE;
}

/* With what has just been paid: faster than that, so that all is made when all is paid. Cells and samples of a sheet
   that is made anew take less than those beside a cut. */
static void GoAhead(kiriWorld* world, kiriSheetData* sheet, int64_t samples)
{
    enum { CELLS_FOR_A_SAMPLE = 5, SAMPLES_FOR_A_SAMPLE = 1 };
    kiriQuotas quotas = kiriQuotas_Unlimited();
    quotas.of[KIRI_QUOTA_CELLS].left = CELLS_FOR_A_SAMPLE * samples;
    quotas.of[KIRI_QUOTA_SAMPLES].left = SAMPLES_FOR_A_SAMPLE * samples;
    if (sheet->leaving.count > 0 && samples > 0) {
        kiriAhead_GoOn(sheet, sheet->leaving.data[0], &world->memory, &quotas);
    }
}

int32_t kiriParts_Finish(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples)
{
    kiriParting parting;
    if (!kiriParts_AreDue(sheet)) {
        return 0;
    }
    ForgetStaleLeaving(world, sheet);
    int64_t used = samples->used;
    int32_t count = PayForLeaving(world, sheet, samples);
    if (IsAtWork(world, sheet)) {
        int64_t rest = count != KIRI_NONE ? samples->left : 0; /* it has cost more than was thought */
        (void)kiriQuota_Pay(samples, &rest);
        count = KIRI_NONE;
    }
    if (count == KIRI_NONE) {
        GoAhead(world, sheet, samples->used - used);
        return 0;
    }
    bool isDone = kiriParting_Start(&parting, world, 1);
    parting.isInTick = true;
    isDone = isDone && kiriParting_SourceFor(&parting, sheet) != NULL &&
             kiriParting_MarkPieces(&parting, sheet->leaving.data, count) && kiriParting_Detach(&parting) == KIRI_OK;
    sheet->leavingPaid = isDone ? 0 : sheet->leavingPaid;
    kiriParting_End(&parting);
    return isDone ? count : 0;
}

void kiriParts_ForgetMade(kiriSheetData* sheet, int32_t made)
{
    for (int32_t k = made; k < sheet->leaving.count; ++k) {
        sheet->leaving.data[k - made] = sheet->leaving.data[k];
    }
    sheet->leaving.count -= made;
}
