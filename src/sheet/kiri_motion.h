/* Motion of a sheet: the solver moves its frames under gravity, pins, contacts and forces. */
#ifndef KIRI_MOTION_H
#define KIRI_MOTION_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Chooses the pieces to move: not those that sleep or fall asleep. With `systems`, the limit of items of linear systems
   (kiriSolver_ItemsOf), it defers pieces that it does not suffice for (kiriPieceTurns). Writes rows and the system. The
   steps are in world/kiri_island.c. Returns a frame of the first deferred piece, or 0. */
int32_t kiriMotion_Begin(kiriSheetData* sheet, kiriVec3 gravity, double dt, const kiriQuota* systems,
                         kiriSystem* system);

/* Returns the linear systems of a step. Sheets that tear take more, since errors of poses pull at clamps. */
int32_t kiriMotion_Iterations(const kiriSheetData* sheet);

/* Moves the frames of a sheet with tips as the tick will: legs that become taut in it pull with many times the force of
   a tear. Only writes the rows of pins where a step changes more than frames, where contacts act, or if systems are few or
   null; pays for those it takes. kiriMotion_Return puts the frames back. Fails on out of memory. */
bool kiriMotion_Foresee(kiriSheetData* sheet, kiriVec3 gravity, double dt, kiriQuota* systems);
void kiriMotion_Return(kiriSheetData* sheet);

/* Takes the results of the steps; consumes forces and contacts. KIRI_MORE: no items were left, frames are unchanged.
   KIRI_FAILED: the solver failed; frames keep their positions and stop. */
void kiriMotion_End(kiriSheetData* sheet, kiriProgress progress, bool isMoved, double dt);

/* Returns the work of a linear system of a body. */
int64_t kiriMotion_WorkOf(const kiriSheetData* sheet, int32_t body);

enum { KIRI_MOST_ROUNDS = 64 + KIRI_EXTRA_SYSTEMS }; /* linear systems of a body in a step */

/* Returns the count of linear systems of these items that the quota has left; at least one if nothing of it is used. */
int64_t kiriMotion_SystemsLeft(const kiriQuota* quota, int64_t items);

/* Replaces a motion if no linear system is left and the visible state is current. The sheet stands still; sleep
   and other updates are deferred to its turn. Returns false if their results are read in this tick. */
bool kiriMotion_Wait(kiriSheetData* sheet, double dt);

/* Clears the deferred pieces at the end of a tick. */
void kiriMotion_EndTurns(kiriSheetData* sheet);

/* Returns an upper bound of the items that a tick takes. */
int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps);

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet);

KIRI_C_END

#endif
