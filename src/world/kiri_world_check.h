/* Is a world that was read one with which ticks and calls may go on, whoever made the bytes? */
#ifndef KIRI_WORLD_CHECK_H
#define KIRI_WORLD_CHECK_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Ids have found what they name. False: it is none, or, *isShort, there was no memory to tell. */
bool kiriWorld_Check(kiriWorld* world, bool* isShort);

/* The same for derived data, after it was made. */
bool kiriWorld_CheckMade(kiriWorld* world, bool* isShort);

KIRI_C_END

#endif
