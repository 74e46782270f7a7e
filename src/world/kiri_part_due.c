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

static int32_t CountFrames(const kiriSheetData* sheet, int32_t piece)
{
    int32_t count = 0;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        count += sheet->layout.framePiece.data[i] == piece;
    }
    return count;
}

/* Samples for the pieces that are gone, and for the first `count` pieces that leave. The first of these is made ahead,
   which takes more work than making it at once. */
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
    int32_t first = count > 0 ? kiriPart_PieceOfFrame(world, sheet->leaving.data[0]) : KIRI_NONE;
    double ahead = first != KIRI_NONE ? pieces[first].area / whole : 0.0;
    for (int32_t k = 1; k < count; ++k) {
        share += pieces[kiriPart_PieceOfFrame(world, sheet->leaving.data[k])].area / whole;
    }
    double samples = kiriRemoval_Samples(sheet, gone + ahead + share) + kiriExtraction_Samples(sheet, share);
    return (int64_t)(samples +
                     (first != KIRI_NONE ? kiriExtraction_SamplesAhead(sheet, ahead, CountFrames(sheet, first)) : 0.0));
}

/* Number of leaving pieces that these samples pay for, with all that are gone. KIRI_NONE: less than the first. */
static int32_t CountWithin(const kiriWorld* world, const kiriSheetData* sheet, int64_t samples)
{
    int32_t least = sheet->leaving.count > 0, end;
    if (CostOfLeaving(world, sheet, least) > samples) {
        return KIRI_NONE;
    }
    KIRI_SEARCH(end, least + 1, sheet->leaving.count + 1, CostOfLeaving(world, sheet, middle) <= samples);
    return end - 1;
}

void kiriParts_Pay(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples)
{
    if (!kiriParts_AreDue(sheet)) {
        return;
    }
    ForgetStaleLeaving(world, sheet);
    int64_t paid = sheet->leavingPaid;
    int32_t count = CountWithin(world, sheet, samples->left < INT64_MAX - paid ? paid + samples->left : INT64_MAX);
    int64_t cost = CostOfLeaving(world, sheet, count != KIRI_NONE ? count : sheet->leaving.count > 0);
    int64_t due = cost > paid ? cost - paid : 0;
    (void)kiriQuota_Pay(samples, &due);
    sheet->leavingPaid = kiriMax(cost - due, paid);
}

static kiriResult Part(kiriWorld* world, kiriSheetData* sheet, int32_t count)
{
    kiriParting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    bool hasRoom = kiriParting_Start(&parting, world, 1) &&
                   kiriArray_Reserve(&world->memory, &world->events, (int64_t)world->events.count + count);
    parting.isInTick = true;
    if (hasRoom && kiriParting_SourceFor(&parting, sheet) != NULL &&
        kiriParting_MarkPieces(&parting, sheet->leaving.data, count)) {
        result = kiriParting_Detach(&parting);
    }
    kiriParting_End(&parting);
    return result;
}

static void TellMade(kiriWorld* world, kiriSheetData* sheet, int32_t count)
{
    for (int32_t k = 0; k < count; ++k) {
        const kiriSheetData* part = kiriPool_Find(&world->frameIds, sheet->leaving.data[k])->owner;
        kiriEvent* event = kiriWorld_AddEvent(world, KIRI_EVENT_PIECE_DETACHED, part);
        event->frame = sheet->leaving.data[k];
        event->area = (float)part->layout.pieces.data[0].area;
        world->newEvents += 1;
    }
    for (int32_t k = count; k < sheet->leaving.count; ++k) {
        sheet->leaving.data[k - count] = sheet->leaving.data[k];
    }
    sheet->leaving.count -= count;
    sheet->leavingPaid = 0;
}

kiriResult kiriParts_Leave(kiriWorld* world, kiriSheetData* sheet)
{
    if (!kiriParts_AreDue(sheet)) {
        return KIRI_OK;
    }
    ForgetStaleLeaving(world, sheet);
    int32_t count = CountWithin(world, sheet, sheet->leavingPaid);
    if (count == KIRI_NONE) {
        bool ok = sheet->leaving.count == 0 ||
                  kiriAhead_GoOn(sheet, sheet->leaving.data[0], &world->memory, sheet->leavingPaid);
        return ok ? KIRI_OK : KIRI_ERROR_MEMORY;
    }
    kiriResult result = Part(world, sheet, count);
    if (result == KIRI_OK) {
        TellMade(world, sheet, count);
    }
    return result;
}
