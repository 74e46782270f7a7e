/* Motion of a sheet: the solver moves its frames under gravity, pins, contacts and forces. */
#ifndef KIRI_MOTION_H
#define KIRI_MOTION_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Wake all pieces, one piece, the piece of a frame, or the pieces that a pin holds. They stay awake for half a second
   at least. */
void kiriMotion_Wake(kiriSheetData* sheet);
void kiriMotion_WakePiece(kiriSheetData* sheet, int32_t piece);
void kiriMotion_WakeFrame(kiriSheetData* sheet, int32_t frame);
void kiriMotion_WakePin(kiriSheetData* sheet, int32_t pin);

/* Computes the sleep state of the sheet from its pieces. */
void kiriMotion_SumRest(kiriSheetData* sheet);

/* Wake the stirred pieces, or let them sleep. Both clear isStirred. */
void kiriMotion_WakeStirred(kiriSheetData* sheet);
void kiriMotion_LetRest(kiriSheetData* sheet);

/* Moves the frames by dt in equal substeps, except in pieces that sleep, fall asleep or are deferred (kiriPieceTurns).
   The quota counts items of linear systems (kiriSolver_SystemItems). KIRI_MORE: no items left, frames unchanged.
   KIRI_FAILED: the solver failed; frames keep their positions and stop. Consumes forces and contacts. */
kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems);

/* Replaces kiriMotion_Solve if no linear system is left and the visible state is current. The sheet stands still; sleep
   and other updates are deferred to its turn. Returns false if their results are read in this tick. */
bool kiriMotion_Wait(kiriSheetData* sheet, double dt);

/* Clears the deferred pieces at the end of a tick. */
void kiriMotion_EndTurns(kiriSheetData* sheet);

/* Returns an upper bound of the items that a tick takes. */
int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps);

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet);

/* Returns the totals of some frames (null: the first `count`), without the elastic energy. */
kiriTotals kiriMotion_Sum(const kiriSheetData* sheet, const int32_t* frames, int32_t count);

KIRI_C_END

#endif
