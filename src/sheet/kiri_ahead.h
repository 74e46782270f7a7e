/* A cache: the sheet of a piece is made little by little while the piece waits to leave, so that the tick in which it
   leaves has less to do. No tick depends on how far it has come, saves leave it out, and it may be dropped at any
   time. */
#ifndef KIRI_AHEAD_H
#define KIRI_AHEAD_H

#include "kiri_gather.h"
#include "kiri_pipeline.h"

KIRI_C_BEGIN

/* Goes on with the sheet of the piece of this frame, as far as `paid` samples pay in all. Drops the cache of another
   piece. After a load the first call catches up. Fields belong to the mesh as it is. `memory` owns all sheets. False
   for memory: the cache is dropped. */
bool kiriAhead_GoOn(kiriSheetData* sheet, kiriFrame frame, kiriMemory* memory, int64_t paid);

/* What has been made for the piece of this frame, which is the caller's from now on; null: nothing. */
kiriSheetData* kiriAhead_Take(kiriSheetData* sheet, kiriFrame frame);

/* What belongs to the pieces that `stays` is 0 for, where that is known, until the next call; or null. */
const kiriGathered* kiriAhead_Gathered(const kiriSheetData* sheet, const uint8_t* stays);

void kiriAhead_Drop(kiriSheetData* sheet, kiriMemory* memory);

KIRI_C_END

#endif
