/* Tears in a tick. */
#ifndef KIRI_TEARING_H
#define KIRI_TEARING_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Begins tears, and queues the next point of each. KIRI_ERROR_MEMORY, KIRI_ERROR_LIMIT: some wait. */
kiriResult kiriTears_Grow(kiriWorld* world, double dt);

/* Ends the tears that rest. */
void kiriTears_EndResting(kiriWorld* world, double dt);

KIRI_C_END

#endif
