/* A sheet, or a piece of it, that the host puts elsewhere or gives another velocity, all at once. */
#ifndef KIRI_CARRY_H
#define KIRI_CARRY_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Each point x of the sheet goes to R x + t, with its velocity and history, and with its holds. The arrays that the
   host may hold go to `retired`, and others are written. False for memory: nothing has changed. */
bool kiriCarry_Sheet(kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t, kiriMemory* retired);

/* The same for where a pin holds it. */
void kiriCarry_Pin(kiriSheetData* sheet, int32_t index, const kiriMat3* R, kiriVec3 t);

/* The origin of the world goes to another place, and nothing else changes. Before it kiriCarry_Renew: arrays that the
   host may hold go to `retired`; until positions are written the new ones have none. False for memory: nothing has
   changed. */
bool kiriCarry_Renew(kiriSheetData* sheet, kiriMemory* retired);
void kiriCarry_Shift(kiriSheetData* sheet, kiriVec3 origin);

/* Would frames still fit floats, see kiriFrame_FitsFloats? */
bool kiriCarry_FitsSheet(const kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t);

/* The frames of a piece, or of all (KIRI_NONE), move as one rigid body: `spin` about their centre of mass. False, and
   changes nothing, where frames would not fit floats. */
bool kiriCarry_SetVelocity(kiriSheetData* sheet, int32_t piece, kiriVec3 velocity, kiriVec3 spin);

KIRI_C_END

#endif
