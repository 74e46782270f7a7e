/* Links across a line that is clamped. What is on its two sides has nothing to do with each other there: the sites on
   both sides are linked with the line instead. */
#ifndef KIRI_SEVER_H
#define KIRI_SEVER_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* For a line whose shares are in sheet->lineShares. Adds to the shares: a frame whose region the line meets has its
   site on one side, so what the line has in the region goes, on the other side, to the frames that it is linked with
   across the line. And adds to `severed` the links in place of which the clamp of index `pin` then is. isStaged: with
   links and sites of the next commit. False for memory. */
bool kiriSever_Across(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, int32_t pin, bool isStaged,
                      kiriSevered* severed);

KIRI_C_END

#endif
