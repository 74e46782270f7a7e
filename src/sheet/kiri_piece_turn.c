#include "kiri_piece_turn.h"

#include "kiri_touch.h"

enum { WORK_OF_FRAME = 4 }; /* in contacts, as kiriSolver_SystemItems counts them */

/* Of all pieces that are listed awake; returns their sum. */
static int64_t FindWork(kiriSheetData* sheet)
{
    kiriPiece* pieces = sheet->layout.pieces.data;
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    int64_t sum = 0;
    KIRI_EACH(p, awake->pieces) {
        pieces[p].work = 0;
    }
    KIRI_EACH(f, awake->frames) {
        kiriSheet_PieceOf(sheet, f)->work += WORK_OF_FRAME;
        sum += WORK_OF_FRAME;
    }
    for (int32_t i = 0; i < sheet->touches.found.count; ++i) {
        int32_t piece = kiriTouch_Piece(sheet, &sheet->touches.found.data[i]);
        if (awake->isAwake.data[piece]) {
            pieces[piece].work += 1;
            sum += 1;
        }
    }
    return sum;
}

static int32_t FirstPiece(const kiriSheetData* sheet)
{
    return sheet->turns.next < sheet->frames.count ? sheet->layout.framePiece.data[sheet->turns.next] : 0;
}

/* Those whose turn it is, one at least, as long as they have no more than `most` work together; the others wait.
   Returns their work. */
static int64_t ChooseTurns(kiriSheetData* sheet, int64_t most)
{
    int32_t count = sheet->layout.pieces.count, first = FirstPiece(sheet);
    int64_t sum = 0;
    bool isFull = false;
    sheet->turns.waiting = 0;
    for (int32_t k = 0; k < count; ++k) {
        kiriPiece* piece = &sheet->layout.pieces.data[(first + k) % count];
        if (kiriPiece_IsAwake(piece)) {
            isFull = isFull || (sum > 0 && sum + piece->work > most);
            sum += isFull ? 0 : piece->work;
            piece->rest.waits = isFull;
            sheet->turns.waiting += isFull;
        }
    }
    return sum;
}

static int64_t ContactsOf(const kiriSheetData* sheet, int64_t work)
{
    return work - (int64_t)WORK_OF_FRAME * kiriSolver_Awake(sheet->solver)->frames.count;
}

static void ListMoved(kiriSheetData* sheet, const kiriSystem* system)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        kiriSolver_SetAwake(sheet->solver, p, kiriPiece_IsMoved(&sheet->layout.pieces.data[p]));
    }
    kiriSolver_ListAwake(sheet->solver, system);
}

/* Those of pieces that are moved are used up when they have been. */
static void DropWaitingForces(kiriSheetData* sheet)
{
    for (int32_t f = 0; f < sheet->frames.count; ++f) {
        if (kiriSheet_PieceOf(sheet, f)->rest.waits) {
            kiriFrame_DropForces(&sheet->frames.data[f]);
        }
    }
}

/* What fades goes on to do so where it waits. */
static void NoteFading(kiriSheetData* sheet)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        const kiriRest* rest = &sheet->layout.pieces.data[p].rest;
        sheet->seen.areFadesAsleep = sheet->seen.areFadesAsleep || (rest->waits && rest->isFading);
    }
}

/* Pieces are chosen by frames and contacts; what their factorisation takes is known when they are listed. */
bool kiriPieceTurns_Begin(kiriSheetData* sheet, const kiriSystem* system, const kiriQuota* systems)
{
    int64_t items = kiriSolver_SystemItems(sheet->solver, sheet->touches.found.count), left = systems->left;
    KIRI_ASSERT(sheet->turns.waiting == 0);
    if (items <= left || left <= 0 || kiriSolver_Awake(sheet->solver)->pieces.count < 2) {
        return false;
    }
    int64_t most = (int64_t)((double)FindWork(sheet) * (double)left / (double)items), work;
    do {
        work = ChooseTurns(sheet, most);
        ListMoved(sheet, system);
        items = kiriSolver_SystemItems(sheet->solver, (int32_t)ContactsOf(sheet, work));
        most = work / 2;
    } while (items > left && kiriSolver_Awake(sheet->solver)->pieces.count > 1);
    DropWaitingForces(sheet);
    NoteFading(sheet);
    return true;
}

void kiriPieceTurns_Take(kiriSheetData* sheet)
{
    int32_t count = sheet->layout.pieces.count, first = FirstPiece(sheet), k = 0;
    while (k < count && !sheet->layout.pieces.data[(first + k) % count].rest.waits) {
        ++k;
    }
    sheet->turns.next = k < count ? sheet->layout.pieces.data[(first + k) % count].frame : 0;
}

void kiriPieceTurns_End(kiriSheetData* sheet)
{
    for (int32_t p = 0; sheet->turns.waiting > 0 && p < sheet->layout.pieces.count; ++p) {
        sheet->layout.pieces.data[p].rest.waits = false;
    }
    sheet->turns.waiting = 0;
}
