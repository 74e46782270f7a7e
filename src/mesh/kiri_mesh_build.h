/* Which vertices of the caller's mesh are one. */
#ifndef KIRI_MESH_BUILD_H
#define KIRI_MESH_BUILD_H

#include "../core/kiri_vec.h"
#include "kiri_mesh.h"

KIRI_C_BEGIN

/* Writes for each vertex the one that it becomes: itself, or an earlier one that stays itself. The vertices are taken in
   their order. Each becomes the nearest one that stayed itself before and is nearer than `distance` (lattice steps), of
   several the first. So none moves by as much as the distance, and none that stays is within it of another. to[v] is
   KIRI_NONE on entry where vertex v is left out, and stays so. Coordinates are even, 0 to 2^30. Time grows as count.
   Scratch comes from `memory`; false where there is none. */
bool kiriWeld_Find(const kiriLatticePoint* at, int32_t count, double distance, int32_t* to, kiriMemory* memory);

/* Whether triangles of a mesh overlap. */

/* Two triangles that overlap by more than what rounding of the input explains, the lower one first; pair[0] is
   KIRI_NONE where none do. Edges have their twins. Time grows as n
   log n for triangles that are not all long and thin, wherever they lie; n are the edges of the outline where it is one
   loop that nowhere meets itself. Scratch comes from `memory`; false where there is none. */
bool kiriOverlap_Find(const kiriMeshData* mesh, kiriMemory* memory, int32_t pair[2]);

KIRI_C_END

#endif
