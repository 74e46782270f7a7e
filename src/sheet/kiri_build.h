/* A sheet from its def. */
#ifndef KIRI_BUILD_H
#define KIRI_BUILD_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Builds a new sheet from a def that has been checked. On failure the fault says why, or ""
   where the result says it all, and the sheet is to be deleted. Ids of sheet and frames are given by the world. */
kiriResult kiriBuild_FromDef(kiriSheetData* sheet, const kiriSheetDef* def, kiriFault* fault);

/* Puts the first layout of a sheet in force, when all stages are done. False for memory. */
bool kiriBuild_Commit(kiriSheetData* sheet);

KIRI_C_END

#endif
