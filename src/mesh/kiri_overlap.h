/* Whether triangles of a mesh overlap. */
#ifndef KIRI_OVERLAP_H
#define KIRI_OVERLAP_H

#include "kiri_mesh.h"

KIRI_C_BEGIN

/* *any: two triangles overlap by more than what rounding of the input explains. Edges have their twins. Time grows as n
   log n for triangles that are not all long and thin, wherever they lie; n are the edges of the outline where it is one
   loop that nowhere meets itself. Scratch comes from `memory`; false where there is none. */
bool kiriOverlap_Find(const kiriMeshData* mesh, kiriMemory* memory, bool* any);

KIRI_C_END

#endif
