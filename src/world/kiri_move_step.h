/* Sheets are moved, side by side where they may. */
#ifndef KIRI_MOVE_STEP_H
#define KIRI_MOVE_STEP_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* When touches are found: room, and which sheets move the same body. False for memory. */
bool kiriMoves_Prepare(kiriWorld* world);

/* The k-th sheet that is moved, an index, where `turn` is the first whose turn it is. */
int32_t kiriMoves_SheetAt(const kiriWorld* world, int32_t turn, int32_t k);

/* Moves the active sheets, first the one that came too late in the last tick. In `of` is what became of each. */
void kiriMoves_Run(kiriWorld* world, double dt, int32_t substeps, kiriQuota* systems);

KIRI_C_END

#endif
