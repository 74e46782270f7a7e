/* The motion of a sheet: its frames, moved by the solver under gravity, pins, contacts and forces. */
#ifndef KIRI_MOTION_H
#define KIRI_MOTION_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* What makes a sheet move that rests calls this: it is awake, for half a second at least. */
void kiriMotion_Wake(kiriSheetData* sheet);

/* Moves the frames by dt in equal substeps, unless the sheet sleeps or falls asleep. Items of the quota are what
   linear systems count (kiriSolver_SystemItems). KIRI_MORE: there was none left, and the frames are where they were. KIRI_FAILED: the motion could not
   be continued, the frames rest where they were. Forces and contacts are used up. */
kiriProgress kiriMotion_Solve(kiriSheetData* sheet, kiriVec3 gravity, double dt, int32_t substeps, kiriQuota* systems);

/* More of the quota it does not take in a tick. */
int64_t kiriMotion_MostItems(const kiriSheetData* sheet, int32_t substeps);

kiriTotals kiriMotion_Totals(const kiriSheetData* sheet);

/* The same of some frames (null: of the first ones), without the elastic energy. */
kiriTotals kiriMotion_Sum(const kiriSheetData* sheet, const int32_t* frames, int32_t count);

KIRI_C_END

#endif
