/* The tick. */
#ifndef KIRI_TICK_H
#define KIRI_TICK_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* One tick: KIRI_OK, KIRI_PENDING (work waits), KIRI_DIVERGED; or KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT, and then
   nothing moved. */
kiriResult kiriWorld_Advance(kiriWorld* world, double dt, int32_t substeps);

/* Finishes the updates that are at work, or begins and finishes those that wait, whatever the budget is. Nothing moves.
   KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT: as a tick that is refused. */
kiriResult kiriWorld_FinishUpdates(kiriWorld* world);

KIRI_C_END

#endif
