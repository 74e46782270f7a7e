/* Pieces of a sheet as a sheet of their own. */
#ifndef KIRI_EXTRACT_H
#define KIRI_EXTRACT_H

#include "kiri_kept.h"

KIRI_C_BEGIN

/* The sheet of the pieces that are kept, which are mapped: on the same lattice and squares, so that all that follows from
   the mesh is what it was bit for bit; frames, pins and contacts keep ids and state. `to` is new. Cuts stay behind. No
   cut has changed the mesh whose work is not done. False for memory. */
bool kiriExtract_Build(const kiriKept* kept, kiriSheetData* to);

KIRI_C_END

#endif
