/* Motion of a sheet: the solver moves its frames under gravity, pins, contacts and forces. */
#ifndef KIRI_MOTION_H
#define KIRI_MOTION_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Moves the frames by dt in equal substeps, except in pieces that sleep, fall asleep or are deferred (kiriPieceTurns).
   The quota counts items of linear systems (kiriSolver_SystemItems). KIRI_MORE: no items left, frames unchanged.
   KIRI_FAILED: the solver failed; frames keep their positions and stop. Consumes forces and contacts. */
kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems);

/* The parts of kiriMotion_Solve, for sheets that are moved together: see world/kiri_island.h. Begin chooses the pieces to
   move, all that are awake if `systems` is null, and writes their rows and the system. Returns a frame of the first
   deferred piece, or 0. End takes the results of the steps. */
int32_t kiriMotion_Begin(kiriSheetData* sheet, kiriVec3 gravity, double dt, const kiriQuota* systems, kiriSystem* system);
void kiriMotion_End(kiriSheetData* sheet, kiriProgress progress, bool isMoved, double dt);

enum { KIRI_MOST_ROUNDS = 64 + KIRI_EXTRA_SYSTEMS }; /* linear systems of a body in a step */

/* Returns the count of linear systems of these items that the quota has left; at least one if nothing of it is used. */
int64_t kiriMotion_SystemsLeft(const kiriQuota* quota, int64_t items);

/* Replaces kiriMotion_Solve if no linear system is left and the visible state is current. The sheet stands still; sleep
   and other updates are deferred to its turn. Returns false if their results are read in this tick. */
bool kiriMotion_Wait(kiriSheetData* sheet, double dt);

/* Clears the deferred pieces at the end of a tick. */
void kiriMotion_EndTurns(kiriSheetData* sheet);

/* Returns an upper bound of the items that a tick takes. */
int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps);

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet);

KIRI_C_END

#endif
