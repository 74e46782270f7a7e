/* Generalised strains of a link: the relative pose of two rigid frames at the border of their regions. Strains of gaps
   are in metres, strains of bending and twist in radians. */
#ifndef KIRI_STRAIN_H
#define KIRI_STRAIN_H

#include "kiri_frame.h"
#include "../field/kiri_link.h"
#include "kiri_element.h"
#include "kiri_plastic.h"

KIRI_C_BEGIN

/* Notation: gap(p) = x_j(p) - x_i(p); n, tau, d are the mean axes of the two frames, orthonormal;
   D = E h^3 / (12 (1 - nu^2)), M = E h / l, B = D / l; W = Wi + Wo, where Wo is the part of the width at open ends of
   the border (kiriLink.outer); Ws is the part towards ends where four regions meet. Every energy is 1/2 stiffness
   strain^2.

   strain         value                                               stiffness
   stretch        sqrt((c + gap(b) . n)^2 + 2 Y) - c - a.n            M (Wi / (1 + nu) + Wo)
   shear          gap(b) . tau - a . tau                              M (Wi + 5/12 Wo) / (1 + nu)
   plane bending  -2 sin of half the turn about d                     M I (1 + 3/2 nu / (1 + nu) Ws / W)
   bending        w . e, w along d_j - d_i                            B ((1 - nu) Wi + (1 - nu^2) Wo)
   twist          w . (d x e)                                         B (1 - nu) (Wi + 2 Wo)
   normal gap     gap(m) . d                                          12 B W' / l^2, W' of NormalGapWidth
   fold           the part of |w| that bending and twist lose         as twist
   normal stop    excess of |gap(m) . d| over l / 2                   M W
   fold slide     the part of gap(b) along the fold that shear loses  as shear

   A plate with the curvature tensor K has the energy D/2 ((1 - nu) |K|^2 + nu (tr K)^2) per area. Along a link,
   K n = (d_j - d_i) / l. Over the links of a Voronoi diagram the sum of W l |K n|^2 equals the area times |K|^2, so
   links represent the first term. The second term couples links of different directions, as does the second term of the
   membrane energy, E h / (1 - nu^2) / 2 ((1 - nu) |eps|^2 + nu (tr eps)^2). Corners represent these terms (see below).
   If the crossing m is beside the border, the outer width from m to the open end is larger than W. The part that W lacks
   (kiriLink.beyond) counts in Wo, and is subtracted from Wi; shear and plane bending leave it out.
   Beside a free edge, beyond the last row of sites, corners are missing, and all links run along the edge. There,
   moment and tension across the edge vanish, as in a beam: bending has the factor 1 - nu^2, stretch has 1, and the
   links see one of the two halves of the twist. So bending and twist are along and across e: the direction of the edge
   if one end of the border is open (kiriLink.lean), else n. With n, links aslant would read bending along the edge as
   twist. An edge that a clamp holds is not free: its outer width counts as inner (kiriLinkPart).

   Bending and twist together are the Laplacian of the director, because d_j - d_i has no part along the mean d. |w| is
   the angle between the two directors; their difference is only the chord. Near half a turn the mean axes are
   undefined, and a small turn swings them round. There all strains along them fade out; the fold takes over |w|, which
   needs no axes, and the stop acts on the whole gap. So strains and their derivatives are continuous for all poses, but
   for two maxima of the energy: opposite directors, and half a turn about d, where plane bending changes its sign.

   Open ends curl across while they bend, hence the factor 1 - nu^2. At larger curvature the edge would stretch and the
   curl is suppressed: bending grows by a factor (kiriCurl_Factor), which is 1 for small angles. The trace also contains
   the curl, with up to 3 % of the bending energy of links at edges; that is too little for a separate strain.
   Twisting a strip one region wide stretches its edges: its twist grows by a factor too, and the strip shortens.

   a = (s . w) w / 12. Between two sites that touch one circular arc, the chord is longer than the tangents by a. That
   is not stretch. In a row of frames, a only moves the frames. Elsewhere links of all directions would demand different
   moves, and lock.

   Stretch is measured along the line between the centres of mass, c apart (for a held frame, its site). An offset along
   the normal lengthens the line: Y = gap(m) . d (gap(q) . d - 2/5 gap(m) . d), q the middle of the centres of mass. In
   even bending gap(m) . d is zero; gap(b) . d is not if b is off m, and crooked layouts would lock. With gap(b) . n
   alone, tension would turn the frames away from that line and, above 12 D / l^2 newtons a metre of width, lay the sheet
   in steps, as tension buckles a column that is soft in shear; cloth would fall apart. An arc that is long compared with
   c would do the same, so its length is limited.
   Let g = c + gap(b) . n. If g < c, the offset adds to the strain as much as it adds to (c + g^2 / c) / 2; if g < 0, as
   much as it adds to c / 2. So frames that have passed through each other are pushed back, the strain grows with
   gap(b) . n everywhere, and it has no kink in which a motion could get stuck. If g < c, Y has 1/2 (1 - g / c) e gap(m) . d
   more, e up to a thousandth of l and of either sign, so a flat sheet that is pressed leaves its plane.

   Under tension, frames of crooked layouts would still tilt, each pair to the side where that shortens a gap. If frames tilt
   by u across a link and by v along it, beside a line that stays, the gap along tau changes by up to c u v / 2, of either
   sign, which is less than c (u^2 + v^2) / 4. The link sees c u as gap(m) . d, links across it see v. So shear grows by
   (gap(m) . d)^2 / c, with its own sign, four times as much. Where the line of tension passes m at the distance t along tau,
   it also has a lever on the twist: stretch above zero grows by (t w . tau)^2 / (4 c). Both terms stay below the strain itself
   and fade where that is below 5 h^2 / l, so offsets cost nothing without tension. They end where frames are more than a
   hundredth of a radian off.

   A slack material (kiriMaterial.slack) loses stiffness where stretch is below zero: there the strain shrinks, by the
   square root of the remaining part of the stiffness. Strain and slope are continuous.

   The stop limits the normal gap of sheets that bend within less than l. Nothing else bounds it. */
#define KIRI_NORMAL_GAP_BETA 12.0 /* for a strip that is clamped at both ends */
#define KIRI_NORMAL_STOP_SHARE 0.5
#define KIRI_TAUTNESS 1.2 /* 2 (1 - 2/5): second derivative of the stretch by the normal gap, see Y; by length */

enum {
    KIRI_STRETCH,
    KIRI_SHEAR,
    KIRI_PLANE_BENDING,
    KIRI_BENDING,
    KIRI_TWIST,
    KIRI_NORMAL_GAP,
    KIRI_FOLD,
    KIRI_NORMAL_STOP,
    KIRI_FOLD_SLIDE,
    KIRI_STRAINS
};

/* Derivative of a strain by the moves and turns of frames i and j: a row of twelve numbers. */
typedef struct kiriStrainRow {
    struct {
        kiriVec3 move, turn;
    } end[2];
} kiriStrainRow;

/* Measures the strains and, unless `rows` is null, their derivatives. These are exact, so the inner forces and their
   moments sum to zero. Strains are invariant if both frames move as one rigid body. frames[] and poses[] are of i, j.
   Plane bending is without its offset, `turned`: this one fades up to half a turn about d, where the strain changes its
   sign, so the energy has no jump there. */
void kiriStrain_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double turned, double strain[KIRI_STRAINS],
                        kiriStrainRow* rows);

/* Measures the strains of a link in the current poses of frames i and j. */
void kiriStrain_MeasureLink(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* i,
                            const kiriFrameData* j, double turned, double strain[KIRI_STRAINS]);

/* Folds (kiriLink.fold) have the same strains, with another meaning: gaps at the middle of the line, along the axes of
   frame i; plane bending and twist are the parts of tau_j along n_i and d_i; bending is the angle by which the sheet is
   folded towards its normal, less the rest angle. So nothing is undefined at half a turn, and the law is linear in the
   angle. Returns the angle of the hinge alone, without the bending of the material up to the two sites; offset: of the
   bending strain. */
double kiriFold_Angle(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                      const kiriPose* const poses[2], double offset);

/* Returns the damping factor of a link in a step that starts with these strains, 0 to 1. It is 0 at half a turn, where
   strains change fast while the sheet hardly moves. */
double kiriStrain_Damping(const double strain[KIRI_STRAINS]);

/* Subtracts the offsets from the strains of a link, but for plane bending. The result is the part that causes forces. */
void kiriStrain_TakeOffsets(const double* strain, const double* offset, int count, bool isAffine, double* pulling);

/* Returns D of a plate, N m. */
double kiriStrain_PlateStiffness(const kiriMaterial* material);

/* Returns the length at which bending stiffness and weight of the sheet balance, m. */
double kiriStrain_BalanceLength(const kiriMaterial* material);

void kiriStrain_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_STRAINS]);

/* Traces of strain and curvature where three or four regions meet. They couple the links between rigid frames. The
   coupling is proportional to Poisson's ratio: if it is zero, these elements do not exist. */

/* With p_k the weight of link k (kiriCorner), n_k and tau_k its normal and tangent at rest:

   trace         value                                           stiffness
   of stretch    sum of p_k . (stretch_k n_k + shear_k tau_k)    nu E h / (1 - nu^2) A
   of curvature  sum of p_k . (bending_k n_k + twist_k tau_k)    nu D A

   If the differences along links are D s_k for a uniform gradient D, both sums give tr D for every layout, because the
   sum of p_k . D s_k equals D : (sum of p_k s_k^T). */
enum { KIRI_TRACE_STRETCH, KIRI_TRACE_CURVATURE, KIRI_TRACES };

/* Strains of links that enter the traces. */
enum { KIRI_TRACED_STRETCH, KIRI_TRACED_SHEAR, KIRI_TRACED_BENDING, KIRI_TRACED_TWIST, KIRI_TRACED };

/* Returns the index of that strain among the strains of a link. */
static inline int kiriTrace_Source(int traced)
{
    const int sources[KIRI_TRACED] = { KIRI_STRETCH, KIRI_SHEAR, KIRI_BENDING, KIRI_TWIST };
    return sources[traced];
}

/* Traces, and their derivatives by the strains of each link. Stretch and shear enter the first trace, bending and twist
   the second. */
typedef struct kiriTrace {
    double strain[KIRI_TRACES];
    double by[4][KIRI_TRACED];
} kiriTrace;

/* Returns the length of a link whose bending strain by the curl (below) is the angle of a longer one: the law of plastic
   bending is in terms of the angle. A fold has the length of a strip that begins to yield at two thirds of its yield
   moment, so it carries hardly more than that; only its hinge flows, and nothing if it has none: then stiffness, of
   what flows, becomes zero. */
double kiriStrain_YieldLength(const kiriLink* link, const kiriMaterial* material, kiriBentStrain* stiffness,
                              double bending);

/* Measures the traces from the strains of the corner's links, KIRI_STRAINS for each link. */
kiriTrace kiriTrace_Measure(const kiriCorner* corner, const kiriLink* links, const double* const strains[4],
                            bool planar);

/* Writes the frames of the corner's links, in the order of the links (equal counts), and for each link the indices of
   its two ends in `members`. */
void kiriTrace_Members(const kiriCorner* corner, const kiriLink* links, int32_t members[4], int32_t ends[4][2]);

void kiriTrace_Stiffness(const kiriCorner* corner, const kiriMaterial* material, double stiffness[KIRI_TRACES]);

/* Strain offsets of links that a cut changed. The frames keep their poses, but the new borders of the regions may have
   larger or smaller gaps, which would add energy in a bent stiff sheet. So a link keeps its old strain: the difference
   is its offset, which fades with time. */

/* Offsets that are subtracted from the strains of a link before these cause forces; for plane bending, times the cosine
   of half the turn about d. */
typedef struct kiriStrainOffset {
    double strain[KIRI_STRAINS];
} kiriStrainOffset;

typedef struct kiriStrainOffsets {
    KIRI_ARRAY(kiriStrainOffset) strainOffsets; /* one a link; empty if no cut has changed links */
    KIRI_ARRAY(kiriStrainOffset) older;         /* scratch: before the commit */
    kiriIndices from;                           /* scratch: index of the old link, or KIRI_NONE */
    KIRI_ARRAY(kiriFrameData) frames;           /* scratch: frames before the commit, where mayMove is set */
    kiriFlags mayMove;                          /* scratch: 1 if the commit may move the frame */
} kiriStrainOffsets;

/* Reserves room for this number of links and frames, so that the functions below cannot fail. Fails on out of memory.
   */
bool kiriStrainOffsets_Reserve(kiriStrainOffsets* strainOffsets, kiriMemory* memory, int32_t linkCount,
                               int32_t frameCount);

/* Stores frames before the commit. mayMove[f]: the commit may change the position of frame f, or its center. */
void kiriStrainOffsets_Remember(kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t frameCount,
                                const uint8_t* mayMove);

/* Returns the frame as it was before the commit. Only fields that strains depend on are valid. frames: current frames.
   */
const kiriFrameData* kiriStrainOffsets_FrameBefore(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames,
                                                   int32_t frame);

/* Sets offsets and plastic parts after the commit. Links of the same pair of frames, matched in their order, keep their
   strain; new links have none. was[k], unless `was` is null: index of the old link that equals link k bit for bit, or
   KIRI_NONE if unknown. */
void kiriStrainOffsets_Take(kiriStrainOffsets* strainOffsets, kiriPlastics* plastics, const kiriLink* old,
                            int32_t oldCount, const kiriLink* links, int32_t linkCount, const int32_t* was,
                            const kiriFrameData* frames, const kiriMaterial* material);

/* Sets offsets so that strains pull as others did; `turned`: the strains, measured with 1 for the offset of plane bending;
   `was`, `older`: the others, and their offsets. */
void kiriStrainOffset_Keep(const double* strain, const double* turned, const double* was, const double* older,
                           double* offset);

/* Multiplies an offset by `keep`, but for its plastic part, if it has one. */
void kiriStrainOffset_Fade(double* offset, const kiriPlastic* plastic, int count, double keep);

/* The strains of a link that flow, and their places. */
static inline kiriBentStrain kiriBentStrain_Of(const double* strain)
{
    return (kiriBentStrain){ strain[KIRI_BENDING], strain[KIRI_TWIST], strain[KIRI_FOLD] };
}

static inline void kiriBentStrain_Write(const kiriBentStrain* bend, double* strain)
{
    strain[KIRI_BENDING] = bend->bending;
    strain[KIRI_TWIST] = bend->twist;
    strain[KIRI_FOLD] = bend->fold;
}

/* Finds the flow of a link at the end of a step, writes its offsets, and keeps the flow. */
static inline void kiriStrain_EndFlow(kiriYield* yield, const double* strain, kiriPlastic* plastic, double* offset)
{
    kiriBentStrain bend = kiriBentStrain_Of(strain), off;
    kiriYield_Flow(yield, &bend, true, &off);
    kiriYield_End(yield, &bend, plastic, &off);
    kiriBentStrain_Write(&off, offset);
}

/* How the free edges of a strip stiffen as it bends. Bent to the curvature k, a strip curls across to -nu k and has the
   bending stiffness D (1 - nu^2) W. But the curl moves the edges away from the axis of bending, which stretches them.
   So a wide thin strip curls at its edges only, and between them bends as a cylinder, with D W (Lamb, Proc. London
   Math. Soc. 21, 1891; Ashwell, J. Roy. Aero. Soc. 54, 1950). The section is a beam on an elastic foundation,
   D w'''' + E h k^2 w = 0 with w'' = -nu k and w''' = 0 at both edges. Its solution gives the energy per length

       1/2 D W (1 - nu^2 F) k^2,   F = (2 / theta) (cosh theta - cos theta) / (sinh theta + sin theta),
       theta^4 = 3 (1 - nu^2) W^4 k^2 / h^2.

   Twisted by tau at the same time, its fibres stretch by k w + tau^2 y^2 / 2 more than their mean. Substituting
   w + tau^2 y^2 / (2 k) for w gives the same equation, and the energy per length

       1/2 D W ((1 - nu^2) k^2 + 2 (1 - nu) tau^2 + (tau^2 - nu k^2)^2 (1 - F) / k^2),

   where (1 - F) / k^2 stays finite for small k. The edges of a helix stretch with the energy E h W^5 tau^4 / 1440. A
   bent ribbon is easier to twist, because bending and twist together can form a surface that does not stretch.

   Regions are straight across. So a link has that stiffness if W is the width of a strip one region wide. If a border
   is open at one end only, the outer width is half of such a strip. Regions farther inside curl by turning against each
   other, and their bending in the plane suppresses the curl. */

/* Growth of a link's bending stiffness: the stiffness at the angle b is its value at b = 0 times 1 + gain (1 - F), with
   theta^4 = perSquare b^2. */
typedef struct kiriCurl {
    double gain, perSquare;
} kiriCurl;

/* Returns the part of a link's width that is open at both of its ends, m. A border beside its crossing is open at one end:
   the part fades over a twentieth of the width. */
static inline double kiriLink_LoneWidth(const kiriLink* link)
{
    double lone = 2.0 * link->outer - link->width - 20.0 * link->beyond;
    return kiriMax(lone, 0.0);
}

/* Returns the growth if the part `curling` of the outer width stiffens. */
kiriCurl kiriCurl_Of(const kiriLink* link, const kiriMaterial* material, double curling);

/* Returns the factor by which the angle grows: the square root of the growth of the stiffness, 1 at small angles.
   *slope: derivative by the square of the angle. */
double kiriCurl_Factor(const kiriCurl* curl, double squaredAngle, double* slope);

/* Returns (1 - F) / theta^4 for theta^4 = q; it tends to 1 / 180 for small theta. *slope: derivative by q. */
double kiriCurl_Held(double q, double* slope);

/* Affine frames joined by links: sheets that stretch visibly. */

/* Strains of a link. gap(p) = x_j(p) - x_i(p). "In the plane" means without the part along the mean director.

   strain         value                              stiffness
   gap            gap(b) in the plane                0.3 E h W / l    three rows
   plane bending  ((A_j - A_i) tau) in the plane     E h I / l        three rows
   bending        d_j - d_i                          B ((1 - nu) Wi + (1 - nu^2) Wo), three rows
   twist          (d_j - d_i) . mean of A tau        B (1 - nu)^2 Wo
   normal gap     gap(m) . d                         as between rigid frames
   normal stop    excess of |gap(m) . d| over l / 2  E h W / l

   Widths, B, and the growth of bending by corners and curl are defined as for rigid frames (see above). Twist is the
   part of the twist energy of rigid frames that bending does not contain.

   The gap is a penalty: it couples the regions, because their membrane energy depends only on mean gaps. Plane bending
   is the remaining energy: the energy of the slope of the strain within a region. Both vanish if the sheet stretches
   uniformly. */
enum {
    KIRI_AFFINE_GAP,
    KIRI_AFFINE_PLANE_BENDING = 3,
    KIRI_AFFINE_BENDING = 6,
    KIRI_AFFINE_TWIST = 9,
    KIRI_AFFINE_NORMAL_GAP,
    KIRI_AFFINE_NORMAL_STOP,
    KIRI_AFFINE_STRAINS
};

/* Same as kiriStrain_Measure. Each strain has two rows, for i and j. */
void kiriAffine_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double strain[KIRI_AFFINE_STRAINS], kiriFrameRow rows[][2]);
void kiriAffine_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_AFFINE_STRAINS]);

/* Adds a link's part of the trace of the curvature in a corner: (d_j - d_i) . A p, with p the link's weight there and A
   the mean of both frames. The stiffness is the same as KIRI_TRACE_CURVATURE. Unless `rows` is null, adds the
   derivatives to the rows of i and j. */
void kiriAffine_AddTrace(kiriVec2 p, const kiriPose* const poses[2], double* strain, kiriFrameRow* const rows[2]);

/* Makes two area elements for each region. `material` has one entry a region. The first has the membrane energy of
   F_i = A_i + 1 / (2 a_i) times the integral of gap (x) n over the region's border. That is the mean of the gradient if
   each border gap is shared by both sides. It is exact for a uniform stretch in any layout, inner forces included. The
   second keeps the director normal to the mid-surface; a planar sheet has none.

   If frames all lean the same way, in steps, a free end becomes longer: its F_i takes only a part of its slope from the
   border, at least a quarter. Under tension that would lay the sheet in steps (see above). So the lean, d_i . F_i, has
   four times the weight in the membrane strains. It vanishes if frames are parallel to the sheet. */
bool kiriAffine_Build(kiriAreaElements* elements, kiriMemory* memory, const kiriLink* links, int32_t linkCount,
                      const kiriMoments* material, int32_t frameCount, bool planar);

/* Clamps: lines of the material whose position and direction the host holds. */

enum { KIRI_CLAMP_STRAINS = kiriMax((int)KIRI_STRAINS, (int)KIRI_AFFINE_STRAINS) };

/* The part of a clamp in one region. It acts like a link: the line is a held frame whose site is the foot of the
   perpendicular from the region's site to the line, with the strains, stiffness and damping of a link between the two.
   The border lies halfway, as between two regions, so a strip that bends uniformly from the line on has no gaps.

   An affine frame stretches as far as the line, so gaps in the plane are measured at the line. The stiffness
   KIRI_CLAMP_AFFINE_GAP E h W / l keeps these gaps small. */
#define KIRI_CLAMP_AFFINE_GAP 10.0

typedef struct kiriClampRow {
    int32_t frame; /* the region's frame */
    kiriLink link; /* from the line to the region; i is KIRI_NONE */
    kiriVec2 foot;
    kiriPose pose, start;              /* of the line, x at the foot: at the end and at the start of the step */
    double offset[KIRI_CLAMP_STRAINS]; /* subtracted from strains, see kiriStrainOffset */
    kiriPlastic plastic;
    double* keptOffset; /* where a step writes offset and plastic part at its end; null: the clamp is elastic */
    kiriPlastic* keptPlastic;
    kiriReaction* reaction; /* a step adds to it; null: not computed */

    double outer; /* m: part of the width at free ends; link.outer is zero, because the line does not curl */
    const kiriMaterial* material;
    bool isAffine;
    kiriYield yield; /* in the current step */
} kiriClampRow;

/* Input for the link from a line to a frame's site. `width`, `centroid` and `moment` (second moment about the centroid)
   describe the part of the line within the frame's region; `outer` is the part of the width at free ends. */
typedef struct kiriClampShape {
    kiriVec2 from, along; /* the line: a point of it, and its direction, unit */
    kiriVec2 centroid;
    double width, moment, outer;
    const kiriMaterial* material;
    double least; /* m: lower bound for the distance from the site to the line */
    bool isAffine;
} kiriClampShape;

void kiriClamp_Shape(kiriClampRow* row, const kiriClampShape* shape, kiriVec2 site);

void kiriClamp_Stiffness(const kiriClampRow* row, double* stiffness);

/* Measures the strains for these poses of the line and the frame and, unless `rows` is null, their derivatives by the
   frame. */
void kiriClamp_Measure(const kiriClampRow* row, const kiriFrameData* frame, const kiriPose* line, const kiriPose* pose,
                       double* strain, kiriFrameRow* rows);

KIRI_C_END

#endif
