/* The generalised strains of a link: how two rigid frames stand to each other where their regions meet. Those of
   gaps are in metres, those of bending and twist in radians. */
#ifndef KIRI_STRAIN_H
#define KIRI_STRAIN_H

#include "kiri_prediction.h"
#include "../field/kiri_link.h"

KIRI_C_BEGIN

/* With gap(p) = x_j(p) - x_i(p); n, tau, d the mean axes of the two frames, orthonormal; D = E h^3 / (12 (1 - nu^2)),
   M = E h / l, B = D / l; W = Wi + Wo, Wo the part of the width at open ends of the border (kiriLink.outer). Every
   energy is 1/2 stiffness strain^2.

   strain         what                                                stiffness
   stretch        |(c + gap(b) . n, sqrt(6/5) gap(b) . d)| - c - a.n  M (Wi / (1 + nu) + Wo)
   shear          gap(b) . tau - a . tau                              M (Wi + 5/12 Wo) / (1 + nu)
   plane bending  ((A_j - A_i) tau) . n                               M I (1 + 3/2 nu / (1 + nu) Wi / W)
   bending        w . n, w along d_j - d_i                            B ((1 - nu) Wi + (1 - nu^2) Wo)
   twist          w . tau                                             B (1 - nu) (Wi + 2 Wo)
   normal gap     gap(m) . d                                          12 B W' / l^2, W' of kiriStrain_NormalGapWidth
   normal stop    what |gap(m) . d| has above l / 2                   M W

   A plate with the curvatures K has D/2 ((1 - nu) |K|^2 + nu (tr K)^2) an area. Over the links of a Voronoi diagram the
   sum of W l |K n|^2 is that of the area times |K|^2, for K n = (d_j - d_i) / l: so the links have the first part. The
   second, like that of the membrane, E h / (1 - nu^2) / 2 ((1 - nu) |eps|^2 + nu (tr eps)^2), needs links of different
   directions together: corners have it (kiri_trace.h). Beside a free edge there are no corners beyond the last row of
   sites, and no links but those along the edge. There, moment and tension across the edge vanish, as in a beam: bending
   has 1 - nu^2, stretch 1; and the links see one of the two halves of the twist.

   Bending and twist together are the Laplacian of the director, for d_j - d_i has no part along the mean d; |w| is the
   angle between the two, of which their difference is only the chord. Where the angle nears half a turn the mean axes
   lose their meaning: strains of a gap and plane bending fade out, and the stop takes all of the gap; and twist is no
   longer stiffer than bending, so that the energy does not depend on the axes.

   Open ends curl across while they bend, which is why they have 1 - nu^2. Bent further they cannot, for the edge would
   stretch: bending grows by a factor (kiri_curl.h), which is 1 for small angles. The trace sees it too, by up to 3 % of
   the bending of links at edges: too little for a strain of its own. A strip one region wide, twisted far, stretches
   its edges: its twist grows by a factor too, and it gets shorter.

   a = (s . w) w / 12: between two sites that touch one circular arc, the chord is that much longer than their tangents
   reach, which is no stretch. In a row of frames a only moves them; where frames lie in no row, links of all directions
   would demand different moves, and lock.

   Stretch is that of the line between the centres of mass, c apart (for a held frame, of its site): an offset along the
   normal makes it longer. With gap(b) . n alone, tension would turn the frames away from that line and, above
   12 D / l^2 newtons a metre of width, lay the sheet in steps, as tension buckles a column that is soft in shear; cloth
   would fall apart. An arc that is long beside c would do the same, and is cut short.
   Where a = c + gap(b) . n is less than c, what the offset adds to it is what it adds to (c + a^2 / c) / 2, and to
   c / 2 where a < 0: so frames that have passed through each other are pushed back, the strain grows with gap(b) . n
   everywhere, and it has no kink for a motion to be caught in.

   The stop catches sheets that bend within less than l, whose normal gap nothing would bound. */
#define KIRI_NORMAL_GAP_BETA 12.0 /* of a strip that is clamped at both ends */
#define KIRI_NORMAL_STOP_SHARE 0.5

enum {
    KIRI_STRETCH,
    KIRI_SHEAR,
    KIRI_PLANE_BENDING,
    KIRI_BENDING,
    KIRI_TWIST,
    KIRI_NORMAL_GAP,
    KIRI_NORMAL_STOP,
    KIRI_STRAINS
};

/* The derivative of a strain by the moves and the turns of frames i and j: twelve numbers in a row. */
typedef struct kiriStrainRow {
    struct {
        kiriVec3 move, turn;
    } end[2];
} kiriStrainRow;

/* The strains and, unless `rows` is null, their derivatives, which are exact: so the inner forces and their moments sum
   to zero. Strains do not change when both frames move rigidly. frames and poses are those of i and j. */
void kiriStrain_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double strain[KIRI_STRAINS], kiriStrainRow* rows);

/* How much a link's axes can be relied on, by its fold: 1 up to a fold of 2.5 rad, 0 at half a turn, where a small
   motion swings them round. *slope is the derivative by the square of the angle. */
double kiriStrain_Openness(double bending, double twist, double* slope);

/* How much of its damping a link has in a step that starts with these strains: none when it is folded by half a turn,
   for there bending and twist change their signs while the sheet hardly moves. */
double kiriStrain_Damping(const double strain[KIRI_STRAINS]);

/* The width of a strip that is clamped at both ends and as stiff against a normal gap. */
double kiriStrain_NormalGapWidth(const kiriLink* link, double poissonsRatio);

void kiriStrain_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_STRAINS]);

KIRI_C_END

#endif
