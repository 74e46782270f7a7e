/* Derives the data that saves leave out from the mesh and the frames: grid, regions, shape functions, links, weights of
   samples, owners of material. */
#ifndef KIRI_REMAKE_H
#define KIRI_REMAKE_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* Runs the stages of a sheet whose saved fields were checked. False for memory; or, with *isBad, if two sites share a
   cell, or frames lie in other pieces than the save says. */
bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad);

KIRI_C_END

#endif
