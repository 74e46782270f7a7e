/* The generalised strains of a link: how two rigid frames stand to each other where their regions meet. Those of
   gaps are in metres, those of bending and twist in radians. */
#ifndef KIRI_STRAIN_H
#define KIRI_STRAIN_H

#include "kiri_prediction.h"
#include "../field/kiri_link.h"

KIRI_C_BEGIN

/* With gap(p) = x_j(p) - x_i(p); n, tau, d the mean axes of the two frames, orthonormal; D = E h^3 / (12 (1 - nu^2)).
   Every energy is 1/2 stiffness strain^2.

   strain         what                                                stiffness
   stretch        |(c + gap(b) . n, sqrt(6/5) gap(b) . d)| - c - a.n  E h W / l
   shear          gap(b) . tau - a . tau                              E h (W - 7/12 Wo) / l, Wo the outer width
   plane bending  ((A_j - A_i) tau) . n                               E h I / l
   bending        w . n, w along d_j - d_i                            D W / l
   twist          w . tau                                             D W / l
   normal gap     gap(m) . d                                          beta D W / l^3, beta = 12
   normal stop    what |gap(m) . d| has above l / 2                   E h W / l

   Bending and twist together are the Laplacian of the director, for d_j - d_i has no part along the mean d; |w| is the
   angle between the two, of which their difference is only the chord. Where the angle nears half a turn the mean axes
   lose their meaning: strains of a gap and plane bending fade out, and the stop takes all of the gap.

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
void kiriStrain_Measure(const kiriLink* link, const kiriFrameData* const frames[2], const kiriPose* const poses[2],
                        double strain[KIRI_STRAINS], kiriStrainRow* rows);

/* How much of its damping a link has in a step that starts with these strains: none when it is folded by half a turn,
   for there bending and twist change their signs while the sheet hardly moves. */
double kiriStrain_Damping(const double strain[KIRI_STRAINS]);

void kiriStrain_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_STRAINS]);

KIRI_C_END

#endif
