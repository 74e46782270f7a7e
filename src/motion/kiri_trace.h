/* The traces of strain and curvature where three or four regions meet: what couples the links between rigid frames, see
   kiri_strain.h. Poisson's ratio is why: without it there are no such elements. */
#ifndef KIRI_TRACE_H
#define KIRI_TRACE_H

#include "kiri_strain.h"

KIRI_C_BEGIN

/* With p_k the weight of link k (kiriCorner), n_k and tau_k its normal and tangent at rest:

   trace         what                                            stiffness
   of stretch    sum of p_k . (stretch_k n_k + shear_k tau_k)    nu E h / (1 - nu^2) A
   of curvature  sum of p_k . (bending_k n_k + twist_k tau_k)    nu D A

   With differences D s_k of an even gradient D both are its trace, whatever the layout, since the sum of p_k . D s_k is
   that of D : p_k s_k^T. In a fold bending and twist lose their meaning one by one, and fade out of the trace. */
enum { KIRI_TRACE_STRETCH, KIRI_TRACE_CURVATURE, KIRI_TRACES };

/* What traces are made of: these strains of their links. */
enum { KIRI_TRACED_STRETCH, KIRI_TRACED_SHEAR, KIRI_TRACED_BENDING, KIRI_TRACED_TWIST, KIRI_TRACED };

/* Which strain of a link that is. */
static inline int kiriTrace_Source(int traced)
{
    const int sources[KIRI_TRACED] = { KIRI_STRETCH, KIRI_SHEAR, KIRI_BENDING, KIRI_TWIST };
    return sources[traced];
}

/* Traces, and how they change with the strains of each link: stretch and shear are in the first, bending and twist in
   the second. */
typedef struct kiriTrace {
    double strain[KIRI_TRACES];
    double by[4][KIRI_TRACED];
} kiriTrace;

/* From the strains of the corner's links, KIRI_STRAINS of each. */
kiriTrace kiriTrace_Measure(const kiriCorner* corner, const kiriLink* links, const double* const strains[4],
                            bool planar);

/* The frames of its links, which are as many, in their order; and where among them the ends of each link are. */
void kiriTrace_Members(const kiriCorner* corner, const kiriLink* links, int32_t members[4], int32_t ends[4][2]);

void kiriTrace_Stiffness(const kiriCorner* corner, const kiriMaterial* material, double stiffness[KIRI_TRACES]);

KIRI_C_END

#endif
