/* Loads of the host on the material, for the next tick: they add to the forces of frames. */
#ifndef KIRI_LOAD_H
#define KIRI_LOAD_H

#include "kiri_point.h"

KIRI_C_BEGIN

/* A force (N) on a point of the material that the frame holds, and a torque (N m). */
void kiriLoad_AtPoint(kiriSheetData* sheet, int32_t frame, kiriVec2 at, kiriVec3 force, kiriVec3 torque);

/* A force along a line (N/m of the rest line) on what of it is in sheet->lineShares. */
void kiriLoad_AlongLine(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, kiriVec3 perLength);

/* A pressure (Pa) on the side that the normal leaves: it pushes along the normal of each frame as it is now. */
void kiriLoad_OnSurface(kiriSheetData* sheet, double pressure);

/* An impulse (N s) on a point as it is seen, at once: each frame that carries the point gets its share. The sheet gets
   the impulse, and its moment about where the point is seen. False, and changes nothing, where frames would not fit
   floats. */
bool kiriLoad_Impulse(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 impulse);

KIRI_C_END

#endif
