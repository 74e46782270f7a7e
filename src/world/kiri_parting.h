/* Pieces that get a sheet of their own, or are taken away. */
#ifndef KIRI_PARTING_H
#define KIRI_PARTING_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* For a sheet without work at hand, and a piece that is not the only one. On failure (memory, or ids) nothing has
   changed. The sheet's data moves: pointers to it are stale. */
kiriResult kiriWorld_DetachPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece, kiriSheet* id);
kiriResult kiriWorld_DestroyPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece);

/* Takes away all pieces below an area (m^2) but the largest. */
kiriResult kiriWorld_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count);

KIRI_C_END

#endif
