/* How far a sheet's shape is from that of a sheet with many more frames, estimated from the shape alone. */
#ifndef KIRI_ENERGY_H
#define KIRI_ENERGY_H

#include "kiri_strain.h"

KIRI_C_BEGIN

/* An estimate of the relative error of the deformation under steady loads. The strains of links are those of a field
   that has one value on each link, and jumps between them. A smoother field is recovered from them (Zienkiewicz and
   Zhu 1987): each region has the curvatures and strains that fit its links best, and between two regions they change
   evenly. The energy of what the two fields differ by, over that of both, tells the relative error of the energy, and
   under steady loads that of the work that these did, so of the way the sheet went. It falls with the square of the
   spacing, as the error does. 0 for a sheet that is flat, 1 where no two links
   meet, else at most 0.5. False for memory. */
bool kiriEstimate_Error(kiriMemory* memory, const kiriFrameData* frames, int32_t frameCount, const kiriLink* links,
                        int32_t linkCount, const kiriMaterial* material, double* relative);

KIRI_C_END

#endif
