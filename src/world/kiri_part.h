/* Pieces that get a sheet of their own, or are taken away: at once where no work on a cut is at hand in their sheet,
   else when it is done. Then pieces that are taken away are gone as far as anybody sees, but for their place in the
   mesh. */
#ifndef KIRI_PART_H
#define KIRI_PART_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* The pieces of these frames, whose ids are known to be right; all in one pass. KIRI_PENDING: some wait. ids[i] becomes
   the sheet of frames[i], 0 where it waits. KIRI_ERROR_STATE: nothing would be left of a sheet. On failure (also for
   memory, or ids) nothing has changed. */
kiriResult kiriParts_Detach(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* ids);
kiriResult kiriParts_Destroy(kiriWorld* world, const kiriFrame* frames, int32_t count);

/* Takes away all pieces below an area (m^2) but the largest. The same. */
kiriResult kiriParts_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count);

/* Does something wait, while no work is at hand in the sheet? No work begins before that is done. */
bool kiriParts_AreDue(const kiriSheetData* sheet);

/* Pays for the pieces that are due, with the samples that are left at the end of a tick. */
void kiriParts_Pay(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples);

/* Takes out the pieces that are paid, at the start of a tick, and adds an event for each new sheet. If the first piece
   is not paid in full, goes on with its cache. The paid samples alone decide. On failure nothing has changed. */
kiriResult kiriParts_Leave(kiriWorld* world, kiriSheetData* sheet);

KIRI_C_END

#endif
