#include "kiri_ahead.h"

#include "kiri_extract.h"

#include <string.h>

void kiriAhead_Drop(kiriSheetData* sheet, kiriMemory* memory)
{
    kiriSheet_Delete(sheet->ahead.part, memory);
    kiriMemory_FreeAll(&sheet->ahead.memory);
    memset(&sheet->ahead, 0, sizeof(sheet->ahead));
}

/* Pieces are numbered anew only where the mesh changes. */
static bool IsMadeOf(const kiriSheetData* sheet, kiriFrame frame)
{
    return sheet->ahead.frame == frame && sheet->ahead.revision == sheet->mesh.revision;
}

static int32_t PieceWith(const kiriSheetData* sheet, kiriFrame frame)
{
    int32_t i = 0;
    while (sheet->frames.data[i].id != frame) {
        ++i;
    }
    return sheet->layout.framePiece.data[i];
}

static bool GatherAhead(kiriSheetData* sheet)
{
    kiriAhead* ahead = &sheet->ahead;
    kiriGathered* gathered = kiriMemory_AllocZeroed(&ahead->memory, sizeof(*gathered));
    uint8_t* stays = kiriMemory_Alloc(&ahead->memory, sheet->layout.pieces.count);
    if (gathered == NULL || stays == NULL) {
        return false;
    }
    memset(stays, 1, (size_t)sheet->layout.pieces.count);
    stays[ahead->piece] = 0;
    ahead->gathered = gathered;
    return kiriGather_Make(gathered, sheet, &ahead->memory, stays);
}

static bool MakeSome(kiriSheetData* sheet, kiriMemory* memory, kiriQuotas* quotas)
{
    kiriAhead* ahead = &sheet->ahead;
    kiriExtraction extraction;
    bool ok = kiriExtraction_Init(&extraction, ahead->gathered);
    if (ok && ahead->part == NULL) {
        ahead->part = kiriSheet_New(memory);
        ok = ahead->part != NULL && kiriExtraction_Begin(&extraction, ahead->piece, ahead->part);
    } else if (ok) {
        ok = kiriExtraction_GoOn(&extraction, ahead->piece, ahead->part, quotas) != KIRI_FAILED;
    }
    kiriExtraction_Drop(&extraction);
    return ok;
}

void kiriAhead_GoOn(kiriSheetData* sheet, kiriFrame frame, kiriMemory* memory, kiriQuotas* quotas)
{
    kiriAhead* ahead = &sheet->ahead;
    if (!IsMadeOf(sheet, frame)) {
        kiriAhead_Drop(sheet, memory);
        ahead->frame = frame;
        ahead->piece = PieceWith(sheet, frame);
        ahead->revision = sheet->mesh.revision;
        ahead->memory = kiriMemory_Like(memory);
    }
    if (!(ahead->gathered == NULL ? GatherAhead(sheet) : MakeSome(sheet, memory, quotas))) {
        kiriAhead_Drop(sheet, memory);
    }
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
    bool isSame = ahead->gathered != NULL && IsMadeOf(sheet, ahead->frame);
    for (int32_t p = 0; isSame && p < sheet->layout.pieces.count; ++p) {
        isSame = (stays[p] == 0) == (p == ahead->piece);
    }
    return isSame ? ahead->gathered : NULL;
}
