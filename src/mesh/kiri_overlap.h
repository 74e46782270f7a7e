/* Whether triangles of a mesh overlap. */
#ifndef KIRI_OVERLAP_H
#define KIRI_OVERLAP_H

#include "kiri_mesh.h"

KIRI_C_BEGIN

/* Two triangles that overlap by more than what rounding of the input explains, the lower one first; pair[0] is
   KIRI_NONE where none do. Edges have their twins. Time grows as n
   log n for triangles that are not all long and thin, wherever they lie; n are the edges of the outline where it is one
   loop that nowhere meets itself. Scratch comes from `memory`; false where there is none. */
bool kiriOverlap_Find(const kiriMeshData* mesh, kiriMemory* memory, int32_t pair[2]);

KIRI_C_END

#endif
