#include "kiri_ahead.h"

#include "kiri_extract.h"

#include <string.h>

void kiriAhead_Drop(kiriSheetData* sheet, kiriMemory* memory)
{
    kiriGather_Pause(sheet);
    kiriSheet_Delete(sheet->ahead.part, memory);
    kiriMemory_FreeAll(&sheet->ahead.memory);
    memset(&sheet->ahead, 0, sizeof(sheet->ahead));
}

/* Pieces are numbered anew only where the mesh changes. */
static bool IsMadeOf(const kiriSheetData* sheet, kiriFrame frame)
{
    return sheet->ahead.frame == frame && sheet->ahead.revision == sheet->mesh.revision;
}

static int32_t IndexOf(const kiriSheetData* sheet, kiriFrame frame)
{
    int32_t i = 0;
    while (sheet->frames.data[i].id != frame) {
        ++i;
    }
    return i;
}

/* Maps of all items, which the first piece that leaves needs, take ticks of their own. */
static bool StartAhead(kiriSheetData* sheet, kiriQuotas* quotas)
{
    kiriAhead* ahead = &sheet->ahead;
    if (!kiriGather_IsReserved(sheet)) {
        return kiriGather_Reserve(sheet, &quotas->of[KIRI_QUOTA_CELLS]) != KIRI_FAILED;
    }
    ahead->gathered = kiriMemory_AllocZeroed(&ahead->memory, sizeof(*ahead->gathered));
    return ahead->gathered != NULL &&
           kiriGather_Start(ahead->gathered, sheet, &ahead->memory, IndexOf(sheet, ahead->frame));
}

static bool MakeSome(kiriSheetData* sheet, kiriMemory* memory, kiriQuotas* quotas)
{
    kiriAhead* ahead = &sheet->ahead;
    if (!ahead->gathered->isDone) {
        return kiriGather_GoOn(ahead->gathered, &quotas->of[KIRI_QUOTA_CELLS]) != KIRI_FAILED;
    }
    kiriExtraction extraction;
    bool ok = kiriExtraction_Init(&extraction, ahead->gathered);
    ahead->part = ahead->part == NULL ? kiriSheet_New(memory) : ahead->part;
    kiriProgress progress =
        ok && ahead->part != NULL ? kiriExtraction_GoOn(&extraction, ahead->piece, ahead->part, quotas) : KIRI_FAILED;
    kiriExtraction_Drop(&extraction);
    ahead->isMade = progress == KIRI_DONE;
    return progress != KIRI_FAILED;
}

bool kiriAhead_GoOn(kiriSheetData* sheet, kiriFrame frame, kiriMemory* memory, int64_t paid)
{
    enum { CELLS_FOR_A_SAMPLE = 5, SAMPLES_FOR_A_SAMPLE = 1 };
    kiriAhead* ahead = &sheet->ahead;
    if (!IsMadeOf(sheet, frame)) {
        kiriAhead_Drop(sheet, memory);
        ahead->frame = frame;
        ahead->piece = sheet->layout.framePiece.data[IndexOf(sheet, frame)];
        ahead->revision = sheet->mesh.revision;
        ahead->memory = kiriMemory_Like(memory);
    }
    int64_t more = paid - ahead->spent;
    if (ahead->isMade || more <= 0) {
        return true;
    }
    kiriQuotas quotas = kiriQuotas_Unlimited();
    quotas.of[KIRI_QUOTA_CELLS].left = CELLS_FOR_A_SAMPLE * more;
    quotas.of[KIRI_QUOTA_SAMPLES].left = SAMPLES_FOR_A_SAMPLE * more;
    ahead->spent = paid;
    bool ok = ahead->gathered == NULL ? StartAhead(sheet, &quotas) : MakeSome(sheet, memory, &quotas);
    if (!ok) {
        kiriAhead_Drop(sheet, memory);
    }
    return ok;
}

kiriSheetData* kiriAhead_Take(kiriSheetData* sheet, kiriFrame frame)
{
    kiriSheetData* part = IsMadeOf(sheet, frame) ? sheet->ahead.part : NULL;
    sheet->ahead.part = part != NULL ? NULL : sheet->ahead.part;
    return part;
}

const kiriGathered* kiriAhead_Gathered(const kiriSheetData* sheet, const uint8_t* stays)
{
    const kiriAhead* ahead = &sheet->ahead;
    bool isSame = ahead->gathered != NULL && ahead->gathered->isDone && IsMadeOf(sheet, ahead->frame);
    for (int32_t p = 0; isSame && p < sheet->layout.pieces.count; ++p) {
        isSame = (stays[p] == 0) == (p == ahead->piece);
    }
    return isSame ? ahead->gathered : NULL;
}
