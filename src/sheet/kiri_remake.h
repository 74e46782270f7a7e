/* Grid, regions, shape functions and links made anew of the mesh and the frames: what they are after a
   commit, whatever bytes have said. */
#ifndef KIRI_REMAKE_H
#define KIRI_REMAKE_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* Of a sheet that was read from a save and is right in all else. False for memory, or, with *isBad, where they cannot be
   made, or are not those of the pieces: frames, or weights of vertices, are not where the material of their piece
   is. */
bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad);

KIRI_C_END

#endif
