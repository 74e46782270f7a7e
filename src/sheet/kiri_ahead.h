/* The sheet of a piece is made little by little while the piece waits to leave: so the tick in which it does has less
   to do. Nothing depends on how far that has come, and what is made may be dropped at any time. */
#ifndef KIRI_AHEAD_H
#define KIRI_AHEAD_H

#include "kiri_gather.h"
#include "kiri_pipeline.h"

KIRI_C_BEGIN

/* Goes on with the sheet of the piece of this frame, as far as the quotas go; of any other piece it is dropped. Fields
   belong to the mesh as it is. `memory` is that of all sheets. Where it is refused all begins anew. */
void kiriAhead_GoOn(kiriSheetData* sheet, kiriFrame frame, kiriMemory* memory, kiriQuotas* quotas);

/* Has the sheet of the piece of this frame been begun, and is not all there yet that can be made ahead? */
bool kiriAhead_IsAtWork(const kiriSheetData* sheet, kiriFrame frame);

/* What has been made for the piece of this frame, which is the caller's from now on; null: nothing. */
kiriSheetData* kiriAhead_Take(kiriSheetData* sheet, kiriFrame frame);

/* What belongs to the pieces that `stays` is 0 for, where that is known, until the next call; or null. */
const kiriGathered* kiriAhead_Gathered(const kiriSheetData* sheet, const uint8_t* stays);

void kiriAhead_Drop(kiriSheetData* sheet, kiriMemory* memory);

KIRI_C_END

#endif
