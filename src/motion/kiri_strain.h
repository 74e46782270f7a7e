/* The generalised strains of a link: how two rigid frames stand to each other where their regions meet. Those of
   gaps are in metres, those of bending and twist in radians. */
#ifndef KIRI_STRAIN_H
#define KIRI_STRAIN_H

#include "kiri_frame.h"
#include "../field/kiri_link.h"
#include "kiri_element.h"

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
   directions together: corners have it (kiri_strain.h). Beside a free edge there are no corners beyond the last row of
   sites, and no links but those along the edge. There, moment and tension across the edge vanish, as in a beam: bending
   has 1 - nu^2, stretch 1; and the links see one of the two halves of the twist.

   Bending and twist together are the Laplacian of the director, for d_j - d_i has no part along the mean d; |w| is the
   angle between the two, of which their difference is only the chord. Where the angle nears half a turn the mean axes
   lose their meaning: strains of a gap and plane bending fade out, and the stop takes all of the gap; and twist is no
   longer stiffer than bending, so that the energy does not depend on the axes.

   Open ends curl across while they bend, which is why they have 1 - nu^2. Bent further they cannot, for the edge would
   stretch: bending grows by a factor (kiri_strain.h), which is 1 for small angles. The trace sees it too, by up to 3 % of
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

/* Takes offsets off the strains of a link: the rest pulls. */
void kiriStrain_TakeOffsets(const double* strain, const double* offset, int count, bool isAffine, double* pulling);

/* The width of a strip that is clamped at both ends and as stiff against a normal gap. */
double kiriStrain_NormalGapWidth(const kiriLink* link, double poissonsRatio);

void kiriStrain_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_STRAINS]);

/* The traces of strain and curvature where three or four regions meet: what couples the links between rigid frames, see
   kiri_strain.h. Poisson's ratio is why: without it there are no such elements. */

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

/* Strains that links take over when a cut changes them. Frames stand to each other as they did, but the new borders of
   their regions see more or less of a gap between them, which in a bent stiff sheet is energy out of nowhere. So a
   link goes on with the strain that it had: the difference is its offset, which fades with time. */

/* What is taken off the strains of a link before they pull. */
typedef struct kiriStrainOffset {
    double strain[KIRI_STRAINS];
} kiriStrainOffset;

typedef struct kiriStrainOffsets {
    KIRI_ARRAY(kiriStrainOffset) strainOffsets; /* one a link; none where no cut has changed links */
    KIRI_ARRAY(kiriStrainOffset) older;         /* scratch: of links that get another index, by the old one; */
    KIRI_ARRAY(int32_t) from;                   /* the link that each goes on from, or KIRI_NONE */
    KIRI_ARRAY(kiriFrameData) frames;           /* as they were before the commit: those that it may move; */
    KIRI_ARRAY(uint8_t) mayMove;                /* which these are */
} kiriStrainOffsets;

/* Room for so many links and frames, so that the others do not fail. */
bool kiriStrainOffsets_Reserve(kiriStrainOffsets* strainOffsets, kiriMemory* memory, int32_t linkCount,
                               int32_t frameCount);

/* Before the commit. mayMove[f]: it may change where frame f is, or its centre. */
void kiriStrainOffsets_Remember(kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t frameCount,
                                const uint8_t* mayMove);

/* A frame as it was before the commit, as far as strains ask; frames: as they are. */
const kiriFrameData* kiriStrainOffsets_FrameBefore(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames,
                                                   int32_t frame);

/* After it: links of the same pair, in their order, go on with their strain; links that are new begin without any.
   was[k], if not null: which of the old ones link k is, bit for bit, or KIRI_NONE where that is not known. */
void kiriStrainOffsets_Take(kiriStrainOffsets* strainOffsets, const kiriLink* old, int32_t oldCount,
                            const kiriLink* links, int32_t linkCount, const int32_t* was, const kiriFrameData* frames,
                            const kiriMaterial* material);

/* Fades the offsets of these links to 1 / e within `time` (s). */
void kiriStrainOffsets_Advance(kiriStrainOffsets* strainOffsets, const kiriIndices* links, double dt, double time);

/* How the free edges of a strip stiffen as it bends. Bent to the curvature k, a strip curls across to -nu k and has the
   bending stiffness D (1 - nu^2) W. But the curl moves the edges away from the axis of bending, which stretches them.
   So a wide thin strip curls at its edges only, and between them bends as a cylinder, with D W (Lamb, Proc. London
   Math. Soc. 21, 1891; Ashwell, J. Roy. Aero. Soc. 54, 1950). The section is a beam on an elastic foundation,
   D w'''' + E h k^2 w = 0 with w'' = -nu k and w''' = 0 at both edges. With its solution the energy of a length is

       1/2 D W (1 - nu^2 F) k^2,   F = (2 / theta) (cosh theta - cos theta) / (sinh theta + sin theta),
       theta^4 = 3 (1 - nu^2) W^4 k^2 / h^2.

   Twisted by tau at the same time, its fibres stretch by k w + tau^2 y^2 / 2 beyond the mean. With
   w + tau^2 y^2 / (2 k) for w the equation is the same, and the energy is

       1/2 D W ((1 - nu^2) k^2 + 2 (1 - nu) tau^2 + (tau^2 - nu k^2)^2 (1 - F) / k^2),

   where (1 - F) / k^2 stays finite for small k: E h W^5 tau^4 / 1440 is what the edges of a helix stretch. A ribbon
   that bends is easier to twist, for the two can make a surface that does not stretch.

   Regions are straight across. So that is the stiffness of a link where W is the width of a strip one region wide;
   where a border is open at one end only, the outer width is half of such a strip. Further in, regions curl by turning
   against each other, and their bending in the plane holds the curl back. */

/* Of a link: its stiffness against bending by the angle b is that at b = 0 times 1 + gain (1 - F), theta^4 = perSquare
   b^2. */
typedef struct kiriCurl {
    double gain, perSquare;
} kiriCurl;

/* The part of a link's width that is open at both of its ends, m. */
static inline double kiriLink_LoneWidth(const kiriLink* link)
{
    double lone = 2.0 * link->outer - link->width;
    return kiriMax(lone, 0.0);
}

/* Where `curling` of the outer width stiffens. */
kiriCurl kiriCurl_Of(const kiriLink* link, const kiriMaterial* material, double curling);

/* By how much an angle counts more than at small angles: the square root of that factor; *slope is its derivative by
   the square of the angle. */
double kiriCurl_Factor(const kiriCurl* curl, double squaredAngle, double* slope);

/* (1 - F) / theta^4, which is 1 / 180 where theta is small; *slope is its derivative by theta^4. */
double kiriCurl_Held(double q, double* slope);

/* Affine frames joined by links: sheets that stretch visibly. */

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

/* Returns how many strains of a link can be other than zero: they come first. */
static inline int kiriStrain_Count(bool isAffine, bool isPlanar)
{
    return isAffine ? (isPlanar ? (int)KIRI_AFFINE_BENDING : (int)KIRI_AFFINE_STRAINS)
                    : (isPlanar ? (int)KIRI_PLANE_BENDING + 1 : (int)KIRI_STRAINS);
}

/* As kiriStrain_Measure; two rows, of i and j, a strain. */
void kiriAffine_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double strain[KIRI_AFFINE_STRAINS], kiriFrameRow rows[][2]);
void kiriAffine_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_AFFINE_STRAINS]);

/* Adds what a link adds to the trace of the curvature in a corner, where its weight is p: (d_j - d_i) . A p, A the mean
   of both frames. Its stiffness is that of KIRI_TRACE_CURVATURE (kiri_strain.h). The rows are those of i and j, or
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

/* Clamps: lines of the material whose place and direction the host holds. */

enum { KIRI_CLAMP_STRAINS = kiriMax((int)KIRI_STRAINS, (int)KIRI_AFFINE_STRAINS) };

/* What a line has in one region. It stands for a link: the line is a held frame whose site is the foot of the way from
   the region's site to the line, so strains, stiffness and damping are those of a link between them (kiri_strain.h).
   As between two regions, the border lies halfway: then a strip that bends evenly from the line on has no gaps.

   An affine frame stretches by itself as far as the line, so gaps in the plane are measured there, with a stiffness
   that leaves little of them (KIRI_CLAMP_AFFINE_GAP E h W / l). */
#define KIRI_CLAMP_AFFINE_GAP 10.0

typedef struct kiriClampRow {
    int32_t frame; /* of the region */
    kiriLink link; /* from the line to the region; i is KIRI_NONE */
    kiriVec2 foot;
    kiriPose pose, start;              /* of the line, with x at the foot; and before this step */
    double offset[KIRI_CLAMP_STRAINS]; /* of strains, see kiri_strain.h */

    double outer; /* of the width, at free ends; the link's own is zero, for it does not curl */
    const kiriMaterial* material;
    bool isAffine;

    /* Of the step at hand: */
    int strainCount;
    double stiffness[KIRI_CLAMP_STRAINS], loss[KIRI_CLAMP_STRAINS], startStrain[KIRI_CLAMP_STRAINS];
    bool stopping; /* would a step have brought it to its stop? */
} kiriClampRow;

/* The link from a line, with the foot, to a frame's site: what of the line lies in the frame's region is `width` long,
   with this centroid and second moment about it, and `outer` of the width is at free ends. */
typedef struct kiriClampShape {
    kiriVec2 from, along; /* the line: a point of it, and its direction, unit */
    kiriVec2 centroid;
    double width, moment, outer;
    const kiriMaterial* material;
    double least; /* m: a shorter way from the site to the line counts as that long */
    bool isAffine;
} kiriClampShape;

void kiriClamp_Shape(kiriClampRow* row, const kiriClampShape* shape, kiriVec2 site);

/* Prepares for a step from the frame's pose at its start. */
void kiriClamp_Begin(kiriClampRow* row, bool isPlanar, const kiriMaterial* material, double damping,
                     const kiriFrameData* frame, const kiriPose* start);

/* The strains with the line at `line` and the frame at `pose`; unless null, their derivatives by the frame. */
void kiriClamp_Measure(const kiriClampRow* row, const kiriFrameData* frame, const kiriPose* line, const kiriPose* pose,
                       double* strain, kiriFrameRow* rows);

/* The strains without their offsets: those that pull. */
void kiriClamp_TakeOffsets(const kiriClampRow* row, const double* strain, double* pulling);

/* Do these strains have it at its stop? Never where the sheet is planar, or frames are affine. */
bool kiriClamp_IsStopped(const kiriClampRow* row, const double* strain);

/* The energy of all springs, J, when lengths and angles are off by themselves; times the square of a rounding. */
double kiriClamp_Noise(const kiriClampRow* row, const kiriPose* start);

KIRI_C_END

#endif
