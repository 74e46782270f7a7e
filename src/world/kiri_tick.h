/* The tick. */
#ifndef KIRI_TICK_H
#define KIRI_TICK_H

#include "kiri_world.h"

#ifdef __cplusplus
extern "C" {
#endif

/* One tick: KIRI_OK, KIRI_PENDING (work waits), KIRI_DIVERGED; or KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT, and then nothing
   moved. */
kiriResult kiriWorld_Advance(kiriWorld* world, double dt, int32_t substeps);

#ifdef __cplusplus
}
#endif

#endif
