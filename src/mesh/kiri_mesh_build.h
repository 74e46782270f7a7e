/* Makes the mesh from the caller's triangles. The functions that kiri_mesh_build.c has for a mesh are in kiri_mesh.h. */
#ifndef KIRI_MESH_BUILD_H
#define KIRI_MESH_BUILD_H

#include "kiri_mesh.h"

KIRI_C_BEGIN

/* Writes for each vertex the vertex that it is welded to: itself, or a lower one that is welded to itself. Vertices are
   taken in ascending order. Each is welded to the nearest kept vertex nearer than `distance` (lattice steps), the lowest
   of several; it is kept if there is none. to[v] is KIRI_NONE on entry if vertex v is left out, and stays so.
   Coordinates are even, 0 to 2^30. O(count). Scratch comes from `memory`. Returns false on out of memory. */
bool kiriWeld_Find(const kiriLatticePoint* at, int32_t count, double distance, int32_t* to, kiriMemory* memory);

KIRI_C_END

#endif
