/* Estimates the error of a sheet's shape against a sheet with many more frames, from the shape alone. */
#ifndef KIRI_ENERGY_H
#define KIRI_ENERGY_H

#include "kiri_strain.h"

KIRI_C_BEGIN

/* Estimates the relative error of the deformation under steady loads. The strains of links are a field with one value
   on each link and jumps between links. A smoother field is recovered from them (Zienkiewicz and Zhu 1987): each region
   has the curvatures and strains that fit its links and clamps best, and between two regions, and from a region to a
   clamped line, they vary linearly. The energy of the difference of the two fields, divided by the energy of both, is
   the relative error of the energy. A smooth sheet has no normal gaps: the energy of a gap counts where it is larger.
   Under steady loads this is also the relative error of the work, and so of the displacement. A soft sheet that hangs from
   a clamp stores much less than half of the work of gravity: if less than a quarter, this quarter divides. A taut sheet
   stores much more: the missing energy of bending, divided by this work, is the result if it is larger. The error
   falls with the square of the spacing. piece[f]: of frame f. *relative: 0 for a flat sheet, 1 if no two links meet, else
   at most 1. Fails on out of memory. */
bool kiriEstimate_Error(kiriMemory* memory, const kiriFrameData* frames, int32_t frameCount, const kiriLink* links,
                        int32_t linkCount, const kiriClampRow* clamps, int32_t clampCount,
                        const kiriMaterial* material, const int32_t* piece, kiriVec3 gravity, double* relative);

KIRI_C_END

#endif
