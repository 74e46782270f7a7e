/* Which vertices of the caller's mesh are one. */
#ifndef KIRI_WELD_H
#define KIRI_WELD_H

#include "../core/kiri_vec.h"

KIRI_C_BEGIN

/* Writes for each vertex the one that it becomes: itself, or an earlier one that stays itself. The vertices are taken in
   their order. Each becomes the nearest one that stayed itself before and is nearer than `distance` (lattice steps), of
   several the first. So none moves by as much as the distance, and none that stays is within it of another. to[v] is
   KIRI_NONE on entry where vertex v is left out, and stays so. Coordinates are even, 0 to 2^30. Time grows as count.
   Scratch comes from `memory`; false where there is none. */
bool kiriWeld_Find(const kiriLatticePoint* at, int32_t count, double distance, int32_t* to, kiriMemory* memory);

KIRI_C_END

#endif
