/* Probes: the vertices by which a sheet feels others. A dozen a frame or more inside of a piece, at most one a grid
   square, and along its border twice as close, the sharpest corners first: between them the surface hardly bends. */
#ifndef KIRI_PROBE_H
#define KIRI_PROBE_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Chooses the probes anew where mesh or pieces have changed, and puts the boxes of pieces and the velocities of probes
   where the surface is seen now, unless the sheet sleeps and they are there. The mesh is the one that is seen. False
   for memory. */
bool kiriProbes_Update(kiriSheetData* sheet);

/* Of a sheet that was read from bytes: chooses them as they were chosen, which is by `block`. */
bool kiriProbes_Remake(kiriSheetData* sheet);

/* m/s: of a vertex. */
kiriVec3 kiriProbe_Velocity(const kiriSheetData* sheet, int32_t vertex);

KIRI_C_END

#endif
