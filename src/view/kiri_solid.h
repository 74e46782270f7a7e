/* The surface with a thickness, to draw: its two sides, and a rim along all borders, lips of cuts included. */
#ifndef KIRI_SOLID_H
#define KIRI_SOLID_H

#include "kiri_surface.h"

KIRI_C_BEGIN

/* Of the surface as it is seen now; `mesh` says where it is open. The arrays are blocks of `memory`. False for memory:
   nothing is left of them. */
bool kiriSolid_Build(kiriSolid* solid, kiriMemory* memory, const kiriSurface* surface, const kiriMeshData* mesh,
                     double thickness);

KIRI_C_END

#endif
