/* The motion of a sheet: its frames, moved by the solver under gravity, pins, contacts and forces. */
#ifndef KIRI_MOTION_H
#define KIRI_MOTION_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* What makes pieces move that rest calls one of these: they are awake, for half a second at least. All pieces, one,
   that of a frame, those that a pin holds. */
void kiriMotion_Wake(kiriSheetData* sheet);
void kiriMotion_WakePiece(kiriSheetData* sheet, int32_t piece);
void kiriMotion_WakeFrame(kiriSheetData* sheet, int32_t frame);
void kiriMotion_WakePin(kiriSheetData* sheet, int32_t pin);

/* Of the sheet, from its pieces. */
void kiriMotion_SumRest(kiriSheetData* sheet);

/* Pieces that are stirred wake, or sleep on; none is stirred any more. */
void kiriMotion_WakeStirred(kiriSheetData* sheet);
void kiriMotion_LetRest(kiriSheetData* sheet);

/* Moves the frames by dt in equal substeps, but for those of pieces that sleep, fall asleep or wait
   (kiriPieceTurns). Items of the quota are what linear systems count (kiriSolver_SystemItems). KIRI_MORE: there was
   none left, and the frames are where they were. KIRI_FAILED: the motion could not be continued, the frames rest where
   they were. Forces and contacts are used up. */
kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems);

/* Instead of it, where no system is left for anybody and the sheet is seen as it is: it stands still, and what it would
   look at first, as which pieces fall asleep, waits until it gets its turn. False where somebody reads what it would
   do. */
bool kiriMotion_Wait(kiriSheetData* sheet, double dt);

/* The tick is over: no piece waits. */
void kiriMotion_EndTurns(kiriSheetData* sheet);

/* More of the quota it does not take in a tick. */
int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps);

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet);

/* The same of some frames (null: of the first ones), without the elastic energy. */
kiriTotals kiriMotion_Sum(const kiriSheetData* sheet, const int32_t* frames, int32_t count);

KIRI_C_END

#endif
