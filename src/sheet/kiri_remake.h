/* Grid, regions, shape functions and the ends of links made anew of the mesh and the frames: what they are after a
   commit, whatever bytes have said. */
#ifndef KIRI_REMAKE_H
#define KIRI_REMAKE_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* Of a sheet without them (kiriSheet_ForgetWork) that is right in all else. Where the work on a cut has changed the
   mesh it makes them itself, when it goes on. False for memory, or, with *isBad, where they cannot be made, or are not
   those of the pieces: frames, or weights of vertices, are not where the material of their piece is. */
bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad);

KIRI_C_END

#endif
