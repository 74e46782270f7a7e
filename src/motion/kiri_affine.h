/* Affine frames joined by links: sheets that stretch visibly. */
#ifndef KIRI_AFFINE_H
#define KIRI_AFFINE_H

#include "kiri_area_element.h"

KIRI_C_BEGIN

/* The strains of a link. With gap(p) = x_j(p) - x_i(p) and the part in the plane what is left of a vector without its
   part along the mean director:

   strain         what                               stiffness
   gap            gap(b) in the plane                0.3 E h W / l    three rows
   plane bending  ((A_j - A_i) tau) in the plane     E h I / l        three rows
   bending        d_j - d_i                          B ((1 - nu) Wi + (1 - nu^2) Wo), three rows
   twist          (d_j - d_i) . mean of A tau        B (1 - nu)^2 Wo
   normal gap     gap(m) . d                         as of rigid frames
   normal stop    what |gap(m) . d| has above l / 2  E h W / l

   Widths, B, and what corners and curl add to bending are those of rigid frames: see kiri_strain.h. Twist here is what
   it has there beyond bending.

   The gap is a penalty: it holds together what the membrane energy of the regions, which sees means only, lets go.
   Plane bending is the rest of that energy, that of the strain's slope inside a region. Both vanish where the sheet
   stretches evenly. */
enum {
    KIRI_AFFINE_GAP,
    KIRI_AFFINE_PLANE_BENDING = 3,
    KIRI_AFFINE_BENDING = 6,
    KIRI_AFFINE_TWIST = 9,
    KIRI_AFFINE_NORMAL_GAP,
    KIRI_AFFINE_NORMAL_STOP,
    KIRI_AFFINE_STRAINS
};

/* As kiriStrain_Measure; two rows, of i and j, a strain. */
void kiriAffine_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double strain[KIRI_AFFINE_STRAINS], kiriFrameRow rows[][2]);
void kiriAffine_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_AFFINE_STRAINS]);

/* Adds what a link adds to the trace of the curvature in a corner, where its weight is p: (d_j - d_i) . A p, A the mean
   of both frames. Its stiffness is that of KIRI_TRACE_CURVATURE (kiri_trace.h). The rows are those of i and j, or
   null. */
void kiriAffine_AddTrace(kiriVec2 p, const kiriPose* const poses[2], double* strain, kiriFrameRow* const rows[2]);

/* Makes two area elements for each region, whose material is given. One has the membrane energy of F_i = A_i + 1/(2
   a_i) times the integral of gap (x) n over its border, which is the mean of the gradient when each border gap is
   shared by both sides: exact for an even stretch in any layout, inner forces included. The other keeps the director
   normal to the mid-surface; a planar sheet has none.

   Frames that lean all one way, in steps, make a free end longer: its F_i takes only a part of its slope from the
   border, a quarter at least. Under tension that would lay the sheet in steps (see kiri_strain.h). Leaning, d_i . F_i,
   therefore counts four times in the membrane strains; it vanishes where frames follow the sheet. */
bool kiriAffine_Build(kiriAreaElements* elements, kiriMemory* memory, const kiriLink* links, int32_t linkCount,
                      const kiriMoments* material, int32_t frameCount, bool planar);

KIRI_C_END

#endif
