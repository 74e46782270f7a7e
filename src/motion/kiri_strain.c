#include "kiri_strain.h"

/* The line between the pivots is longer by Y / l, with Y = gap(m) . d (gap(q) . d - 0.4 gap(m) . d): m is the crossing,
   q the middle of the pivots. If m = q, this is 3/5 g^2 / l, as for a clamped strip whose ends are offset by g. Bending
   leaves no gap at m. */
#define OFFSET_SHARE 0.4
#define BUMP 1e-3        /* see BumpOf; by length */
#define SLACK_REACH 1e-3 /* by length: compression at which half of the slack counts */
#define OFFSET_FOLD 0.12 /* 1 - cos of half the fold at which offsets at m and at b count equally */
/* Square of the angle at which the arc between two sites counts half. */
#define ARC_FOLD 2.5
/* Timoshenko's 5/6: a shear that no other links share is not uniform over the width. */
#define SHEAR_BEAM (5.0 / 6.0)

/* Missing energy of plane bending. Bent in its plane, a sheet stretches on one side of a corner and contracts on the
   other. The trace sees this where three regions meet, and not where four meet: there 3 nu / (1 + nu) of the regions' own
   energy are missing, and half of it suits narrow strips better. */
#define PLANE_SQUARE 1.5

/* Elongation of a link at which half of the terms of HoldTilt count, in h^2 / l: without them, tension buckles crooked
   layouts from there on. */
#define TAUT_ONSET 5.0
/* Part of the tension's lever on twist that HoldTilt takes away: with all of it, crooked layouts of thin sheets lock. */
#define TWIST_SHARE 0.25
/* Angle of frames to the line of tension beyond which it holds them no more. With 0.03, tears go other ways. */
#define MOST_TILT 0.01

/* Factors of the stiffness of a normal gap against a strip clamped at both ends: between regions with neighbours on
   both sides, and along an edge. Inside, 1.6 is the mean over directions for a plate under uniform shear, and 3 is
   closer to plates with edges and slits, static and in motion. A twisted plate carries its twist at the edges by shear
   along them: the last row of regions carries it by its normal gaps. Below 6, strips are soft in torsion; ten times
   these values lock. */
#define GAP_INNER 3.0
#define GAP_OUTER 12.0

/* Strains that need the mean axes fade below this square of the cosine of half the fold. */
#define FADING 0.1
/* A shorter sum of directors has no direction. */
#define LEAST_AXIS 1e-6
/* Cosine of the turn about d beyond which n leans to the normal of the first frame, where the mean vanishes. */
#define TURNED (-0.5)

#define HALF_TURN 3.14159265358979
/* Least cosine of half a turn about d, faded in folds, by which an offset of plane bending is divided. */
#define LEAST_COSINE 0.01
/* Limit of that offset: twice the tangent of half the turn about d that it hides. */
#define MOST_TURNED 10.0
/* Least difference of the squares of half a turn and of an angle. */
#define LEAST_ROOM 1e-6

/* Returns the row of a strain. rows: null if only strains are measured. */
#define ROW_OF(rows, s) ((rows) != NULL ? &(rows)[s] : NULL)

/* Weight of strains along the mean axes, and its derivative by `open`. If the directors are nearly opposite, a small
   turn swings the mean axes round: a gap with no energy along one axis would get the energy of stretch along the next,
   and block the motion. The squares of `keep` and of the part that is lost add up to 1. */
typedef struct AxisFade {
    double keep, slope, lost, lostSlope;
} AxisFade;

/* The mean axes of two frames: d is the mean director. The smallest turns that take the directors to d take the frames
   to two that differ by a turn about d: n and tau are their mean. When the frames turn by w_0 and w_1, the axes turn by
   the sum over k of n (nBy[k] . w_k) + tau (tauBy[k] . w_k) + d (dBy[k] . w_k). */
typedef struct MeanAxes {
    kiriVec3 n, tau, d;
    kiriVec3 nBy[2], tauBy[2], dBy[2];
    double open; /* cosine of half the angle between the directors: 1 where the sheet is flat, 0 where it is folded */
    kiriVec3 openBy[2];
    double sine, cosine; /* of half the turn about d; cosine >= 0 */
    kiriVec3 turnBy;     /* derivative of that turn by w_1; the opposite by w_0 */
    AxisFade fade;
} MeanAxes;

static kiriVec3 MeanDirectorOf(const kiriPose* const poses[2], kiriVec3 normal, double* open)
{
    kiriVec3 d = kiriVec3_Add(poses[0]->A.d, poses[1]->A.d);
    double length = kiriVec3_Length(d);
    *open = kiriMax(0.5 * length, 0.5 * LEAST_AXIS);
    /* Folded flat: the director of one of the two folds that lead there. */
    return length > LEAST_AXIS ? kiriVec3_Scale(1.0 / length, d) : kiriVec3_Scale(-1.0, normal);
}

/* Sets n and tau, and how fast they turn about d. Where the frames differ by half a turn about d, the sum of their
   normals vanishes, so the second one counts less and less as the turn nears that. */
static void TakeNormal(MeanAxes* axes, const kiriVec3 normals[2], const kiriPose* const poses[2])
{
    kiriVec3 moved[2], lean[2];
    double per = 1.0 / (1.0 + axes->open);
    KIRI_TIMES(k, 2) {
        lean[k] = kiriVec3_Scale(per, kiriVec3_Add(poses[k]->A.d, axes->d));
        moved[k] = kiriVec3_AddScaled(normals[k], -kiriVec3_Dot(normals[k], axes->d), lean[k]);
    }
    double cosine = kiriVec3_Dot(moved[0], moved[1]), sine = kiriVec3_Dot(axes->d, kiriVec3_Cross(moved[0], moved[1]));
    double beyond = (TURNED - cosine) / (1.0 + TURNED), share = 1.0, byTurn = 0.0;
    if (beyond > 0.0) {
        share = 1.0 - 0.5 * beyond * beyond;
        double bySine = -beyond * sine * sine / (1.0 + TURNED);
        byTurn = (share * (share + cosine) + bySine) / (1.0 + share * (share + 2.0 * cosine)) - 0.5;
    }
    axes->cosine = kiriRoot(0.5 * (1.0 + cosine));
    axes->sine = cosine > 0.0 ? 0.5 * sine / axes->cosine : kiriRoot(0.5 * (1.0 - cosine)) * (sine < 0.0 ? -1.0 : 1.0);
    axes->turnBy = kiriVec3_Scale(1.0 / axes->open, axes->d);
    axes->n = kiriVec3_Normalize(kiriVec3_AddScaled(moved[0], share, moved[1]));
    axes->tau = kiriVec3_Cross(axes->d, axes->n);
    KIRI_TIMES(k, 2) {
        axes->dBy[k] = kiriVec3_AddScaled(kiriVec3_Scale(0.5, lean[k]), k == 0 ? -byTurn : byTurn, axes->turnBy);
    }
}

static AxisFade FadeOf(double open)
{
    double share = open * open / FADING;
    AxisFade fade = { 1.0, 0.0, 0.0, 0.0 };
    if (share < 1.0) {
        fade.keep = share * (2.0 - share);
        fade.slope = 4.0 * (1.0 - share) * open / FADING;
        double root = sqrt(1.0 + fade.keep);
        fade.lost = (1.0 - share) * root;
        fade.lostSlope = -4.0 * open / FADING * fade.keep / root;
    }
    return fade;
}

static MeanAxes MeanAxesOf(const kiriLink* link, const kiriPose* const poses[2], bool turns)
{
    const kiriVec3 normals[2] = { kiriPose_Along(poses[0], link->normal), kiriPose_Along(poses[1], link->normal) };
    MeanAxes axes;
    axes.d = MeanDirectorOf(poses, normals[0], &axes.open);
    TakeNormal(&axes, normals, poses);
    axes.fade = FadeOf(axes.open);
    KIRI_TIMES_WHILE(turns, k, 2) {
        kiriVec3 by = kiriVec3_Scale(0.5 / axes.open, poses[k]->A.d);
        axes.nBy[k] = kiriVec3_Cross(axes.tau, by);
        axes.tauBy[k] = kiriVec3_Cross(by, axes.n);
        axes.openBy[k] = kiriVec3_Scale(0.5, kiriVec3_Cross(poses[k]->A.d, axes.d));
    }
    return axes;
}

/* A vector of each frame, and their difference, as a link sees them; for a point the arms from the frames' x, and the
   gap. */
typedef struct EndVectors {
    kiriVec3 ends[2], gap;
} EndVectors;

static EndVectors DirectionVectors(kiriVec3 first, kiriVec3 second)
{
    EndVectors pair = { { first, second }, kiriVec3_Sub(second, first) };
    return pair;
}

static EndVectors PointVectors(const kiriFrameData* const frames[2], const kiriPose* const poses[2], kiriVec2 at)
{
    EndVectors pair = DirectionVectors(kiriPose_Along(poses[0], kiriVec2_Sub(at, frames[0]->center)),
                                       kiriPose_Along(poses[1], kiriVec2_Sub(at, frames[1]->center)));
    pair.gap = kiriVec3_Add(pair.gap, kiriVec3_Sub(poses[1]->x, poses[0]->x));
    return pair;
}

/* Writes the derivative of gap . axis. The ends turn with their frames, the axis with both frames. */
static void WriteTurns(const MeanAxes* axes, kiriVec3 axis, const EndVectors* pair, kiriStrainRow* row)
{
    kiriVec3 g = kiriVec3_Cross(axis, pair->gap), zero = { 0 };
    double gn = kiriVec3_Dot(g, axes->n), gtau = kiriVec3_Dot(g, axes->tau), gd = kiriVec3_Dot(g, axes->d);
    KIRI_TIMES(k, 2) {
        kiriVec3 arm = kiriVec3_Cross(axis, pair->ends[k]), turn = k == 0 ? arm : kiriVec3_Scale(-1.0, arm);
        turn = kiriVec3_AddScaled(turn, gn, axes->nBy[k]);
        turn = kiriVec3_AddScaled(turn, gtau, axes->tauBy[k]);
        row->end[k].turn = kiriVec3_AddScaled(turn, gd, axes->dBy[k]);
        row->end[k].move = zero;
    }
}

static void WriteGap(const MeanAxes* axes, kiriVec3 axis, const EndVectors* points, kiriStrainRow* row)
{
    WriteTurns(axes, axis, points, row);
    row->end[0].move = kiriVec3_Scale(-1.0, axis);
    row->end[1].move = axis;
}

static void ScaleRow(kiriStrainRow* row, double a)
{
    KIRI_TIMES(k, 2) {
        row->end[k].move = kiriVec3_Scale(a, row->end[k].move);
        row->end[k].turn = kiriVec3_Scale(a, row->end[k].turn);
    }
}

static void AddRow(kiriStrainRow* row, double a, const kiriStrainRow* other)
{
    KIRI_TIMES(k, 2) {
        row->end[k].move = kiriVec3_AddScaled(row->end[k].move, a, other->end[k].move);
        row->end[k].turn = kiriVec3_AddScaled(row->end[k].turn, a, other->end[k].turn);
    }
}

static void AddOpening(const MeanAxes* axes, double a, kiriStrainRow* row)
{
    KIRI_TIMES(k, 2) {
        row->end[k].turn = kiriVec3_AddScaled(row->end[k].turn, a, axes->openBy[k]);
    }
}

/* Returns the point about which a frame turns: its centre of mass, or its site if the host holds it. */
static kiriVec2 PivotOf(const kiriFrameData* frame)
{
    return frame->held ? frame->site.at : frame->center;
}

/* Returns a times one pair of vectors plus b times another. */
static EndVectors Combine(double a, const EndVectors* x, double b, const EndVectors* y)
{
    EndVectors sum = { { kiriVec3_AddScaled(kiriVec3_Scale(a, x->ends[0]), b, y->ends[0]),
                         kiriVec3_AddScaled(kiriVec3_Scale(a, x->ends[1]), b, y->ends[1]) },
                       kiriVec3_AddScaled(kiriVec3_Scale(a, x->gap), b, y->gap) };
    return sum;
}

/* Returns the normal offset (m) at which a crushed link would be straight, of either sign by where the link is. A flat
   sheet that is pressed in its plane has no other reason to leave it. */
static double BumpOf(const kiriLink* link)
{
    double place = fabs(12.9898 * link->crossing.x + 78.233 * link->crossing.y) / link->length;
    double part = place - (double)(int64_t)place;
    return BUMP * link->length * (2.0 * part - 1.0);
}

/* Measures stretch, signed along n. With the unsigned length, frames that have passed through each other would be at
   rest again, and a crushed sheet would stay inside out. In folds the offsets at m and q give way to those at b: a
   narrow border beside the line of sites resists twist by its offset at b, and not at m. */
static void MeasureStretch(double lever, double bump, const MeanAxes* axes, const EndVectors* b, const EndVectors* m,
                           const EndVectors* q, double* strain, kiriStrainRow* row)
{
    double fold = (1.0 - axes->open) / OFFSET_FOLD, flat = 1.0 / (1.0 + fold * fold);
    EndVectors aside = Combine(flat, m, 1.0 - flat, b), beside = Combine(flat, q, 1.0 - flat, b);
    double y = kiriVec3_Dot(aside.gap, axes->d), z = kiriVec3_Dot(beside.gap, axes->d);
    double ahead = lever + kiriVec3_Dot(b->gap, axes->n);
    double per = ahead < 0.0 ? 0.0 : ahead < lever ? ahead / lever : 1.0; /* base by ahead */
    double base = ahead > lever ? ahead : 0.5 * lever * (1.0 + per * per);
    double off = bump * (1.0 - per), longer = 2.0 * y * (z - OFFSET_SHARE * y) + off * y,
           root = sqrt(base * base + fabs(longer)), share = base / root;
    bool isShorter = longer < 0.0;
    *strain = ahead - lever + (isShorter ? base * share : root) - base;
    if (row != NULL) {
        double byBase = isShorter ? share * (2.0 - share * share) : share,
               by = (isShorter ? share * share : 1.0) / root;
        double byY = by * (z - 2.0 * OFFSET_SHARE * y + 0.5 * off), byZ = by * y;
        EndVectors offset = Combine(byY, &aside, byZ, &beside), change = Combine(byY, m, byZ, q);
        kiriStrainRow d;
        WriteTurns(axes, axes->d, &offset, &d);
        d.end[1].move = kiriVec3_Scale(byY + byZ, axes->d);
        d.end[0].move = kiriVec3_Scale(-1.0, d.end[1].move);
        WriteGap(axes, axes->n, b, row);
        double byPer = per > 0.0 && per < 1.0 ? -0.5 * by * bump * y / lever : 0.0;
        ScaleRow(row, 1.0 + per * (byBase - 1.0) + byPer);
        AddRow(row, 1.0, &d);
        double byFlat = kiriVec3_Dot(change.gap, axes->d) - (byY + byZ) * kiriVec3_Dot(b->gap, axes->d);
        AddOpening(axes, 2.0 / OFFSET_FOLD * fold * flat * flat * byFlat, row);
    }
}

/* Adds share e^2 to a strain, e an offset of a link: the force of the strain then resists the offset. The addition stays
   below the strain itself, and below share most^2, so that frames which are far off turn freely. */
static void HoldOffset(double share, double most, double onset, double e, const kiriStrainRow* byOffset, double* strain,
                       kiriStrainRow* row)
{
    double size = fabs(*strain), sign = *strain < 0.0 ? -1.0 : 1.0, near = 1.0 / (1.0 + e * e / (most * most));
    double w = share * e * e * near, per = 1.0 / (size + w + onset);
    *strain += sign * size * w * per;
    if (row != NULL) {
        ScaleRow(row, 1.0 + w * (w + onset) * per * per);
        AddRow(row, 2.0 * sign * share * e * near * near * size * (size + onset) * per * per, byOffset);
    }
}

/* Lets tension hold frames that tilt (kiri_strain.h). `aside`: the part along tau of the way from m to q. */
static void HoldTilt(double aside, double lever, double onset, double* strain, kiriStrainRow* rows)
{
    if (strain[KIRI_STRETCH] > 0.0) {
        HoldOffset(TWIST_SHARE * aside * aside / lever, MOST_TILT, onset, strain[KIRI_TWIST], ROW_OF(rows, KIRI_TWIST),
                   &strain[KIRI_STRETCH], ROW_OF(rows, KIRI_STRETCH));
    }
    HoldOffset(1.0 / lever, MOST_TILT * lever, onset, strain[KIRI_NORMAL_GAP], ROW_OF(rows, KIRI_NORMAL_GAP),
               &strain[KIRI_SHEAR], ROW_OF(rows, KIRI_SHEAR));
}

/* Measures the excess of the gap over `most`: of its part along the mean normal and, as the axes fade, of all of it. In a
   fold the row derives the length, with or without an excess: the solver uses it for steps that run into the stop. */
static void MeasureStop(double most, const MeanAxes* axes, const EndVectors* m, double* strain, kiriStrainRow* row)
{
    double normal = kiriVec3_Dot(m->gap, axes->d), lost = 1.0 - axes->fade.keep;
    double aside = kiriVec3_Dot(m->gap, m->gap) - normal * normal;
    double length = sqrt(normal * normal + lost * lost * aside);
    *strain = length > most ? length - most : 0.0;
    if (row != NULL) {
        KIRI_CLEAR(row);
    }
    if (row != NULL && length > (lost > 0.0 ? 0.0 : most)) {
        kiriStrainRow whole;
        double per = 1.0 / length;
        WriteGap(axes, axes->d, m, row);
        ScaleRow(row, per * (1.0 - lost * lost) * normal);
        WriteGap(axes, m->gap, m, &whole);
        AddRow(row, per * lost * lost, &whole);
        AddOpening(axes, -per * lost * aside * axes->fade.slope, row);
    }
}

/* Converts the chord between the directors, 2 sin(a / 2), to the angle a. With e = 1 - cos(a / 2) the arc is longer by
   the factor 1 + (2 e - e^2) / 6, to third order. The last term makes the result exact at half a turn. There the angle,
   unlike the chord, has a slope: so a complete fold is not a rest state. */
static void TakeAngle(const MeanAxes* axes, double* strain, kiriStrainRow* rows)
{
    const double lacking = 0.5 * HALF_TURN - 7.0 / 6.0;
    double e = axes->open < 1.0 ? 1.0 - axes->open : 0.0, e3 = e * e * e;
    double longer = 1.0 + (2.0 * e - e * e) / 6.0 + lacking * e3 * e, slope = (1.0 - e) / 3.0 + 4.0 * lacking * e3;
    for (int s = KIRI_BENDING; s <= KIRI_TWIST; ++s) {
        if (rows != NULL) {
            ScaleRow(&rows[s], longer);
            AddOpening(axes, -slope * strain[s], &rows[s]);
        }
        strain[s] *= longer;
    }
}

/* Returns the longest arc for which tension does not turn the frames. The pivots are c apart along n, e is the distance
   along n from their middle to m, psi the angle from their line to the mean of the frames, delta the angle between the
   frames. The work of turning them is the tension times

       0.1 c psi^2 - 0.2 e psi delta + (c / 8 - 0.4 e^2 / c - s / 12) delta^2

   It is positive for s < 1.5 c - 6 e^2 / c. */
static double LongestArc(const kiriLink* link, const kiriFrameData* const frames[2])
{
    double before = kiriVec2_Dot(kiriVec2_Sub(link->crossing, PivotOf(frames[0])), link->normal);
    double behind = kiriVec2_Dot(kiriVec2_Sub(PivotOf(frames[1]), link->crossing), link->normal);
    double c = before + behind, e = 0.5 * (before - behind);
    double most = c > 0.0 ? 1.4 * c - 6.0 * e * e / c : 0.0;
    return kiriMax(most, 0.0);
}

/* Subtracts the contribution of the arc between the two sites from the gap. Folds of more than two radians are not
   arcs: the term fades, because it would give a crumpled sheet false rest states. */
static void TakeArc(const kiriLink* link, const kiriFrameData* const frames[2], double* strain, kiriStrainRow* rows)
{
    double length = kiriVec2_Length(link->span), most = LongestArc(link, frames);
    double twelfth = length > most ? most / (12.0 * length) : 1.0 / 12.0;
    double n = twelfth * kiriVec2_Dot(link->span, link->normal);
    double tau = twelfth * kiriVec2_Dot(link->span, link->tangent);
    double bending = strain[KIRI_BENDING], twist = strain[KIRI_TWIST], turn = n * bending + tau * twist;
    const double perFold = 1.0 / ARC_FOLD;
    double fold = perFold * (bending * bending + twist * twist), keep = 1.0 / (1.0 + fold * fold);
    strain[KIRI_STRETCH] -= keep * turn * bending;
    strain[KIRI_SHEAR] -= keep * turn * twist;
    if (rows != NULL) {
        double fade = 4.0 * keep * keep * fold * perFold * turn;
        double byBending = keep * n - fade * bending, byTwist = keep * tau - fade * twist;
        AddRow(&rows[KIRI_STRETCH], -(keep * turn + bending * byBending), &rows[KIRI_BENDING]);
        AddRow(&rows[KIRI_STRETCH], -bending * byTwist, &rows[KIRI_TWIST]);
        AddRow(&rows[KIRI_SHEAR], -twist * byBending, &rows[KIRI_BENDING]);
        AddRow(&rows[KIRI_SHEAR], -(keep * turn + twist * byTwist), &rows[KIRI_TWIST]);
    }
}

/* Fades what depends on the mean axes. What bending and twist lose goes to the fold: as stiff as twist whichever way it
   is folded, for the two are indistinguishable at half a turn. So the energy grows up to there. */
static void FadeStrains(const MeanAxes* axes, double bending, const kiriStrainRow* byBending, double* strain,
                        kiriStrainRow* rows)
{
    const AxisFade* fade = &axes->fade;
    double twist = strain[KIRI_TWIST], angle = sqrt(bending * bending + twist * twist);
    strain[KIRI_FOLD] = fade->lost * angle;
    if (rows != NULL) {
        KIRI_CLEAR(&rows[KIRI_FOLD]);
    }
    if (!(fade->lost > 0.0)) {
        return;
    }
    if (rows != NULL && angle > 0.0) {
        AddRow(&rows[KIRI_FOLD], fade->lost * bending / angle, byBending);
        AddRow(&rows[KIRI_FOLD], fade->lost * twist / angle, &rows[KIRI_TWIST]);
        AddOpening(axes, fade->lostSlope * angle, &rows[KIRI_FOLD]);
    }
    for (int s = 0; s <= KIRI_NORMAL_GAP; ++s) {
        if (rows != NULL) {
            ScaleRow(&rows[s], fade->keep);
            AddOpening(axes, fade->slope * strain[s], &rows[s]);
        }
        strain[s] *= fade->keep;
    }
}

/* Measures the gap along the fold. The axis of the turn between the frames is defined up to half a turn and beyond, unlike
   the mean axes; with the turn t and the matrix R it is along R a + a R + (1 - trace) a, for any a. */
static void MeasureSlide(const MeanAxes* axes, const kiriPose* const poses[2], const EndVectors* b, double* strain,
                         kiriStrainRow* row)
{
    double lost = axes->fade.lost;
    *strain = 0.0;
    if (row != NULL) {
        KIRI_CLEAR(row);
    }
    if (!(lost > 0.0)) {
        return;
    }
    const kiriMat3 *from = &poses[0]->A, *to = &poses[1]->A;
    double uu = kiriVec3_Dot(from->u, to->u), vv = kiriVec3_Dot(from->v, to->v);
    double trace = uu + vv + kiriVec3_Dot(from->d, to->d);
    kiriVec3 a = uu > vv ? from->u : from->v;
    kiriVec3 both = kiriVec3_Add(uu > vv ? to->u : to->v, kiriMat3_Mul(*from, kiriMat3_MulTransposed(to, a)));
    kiriVec3 axis = kiriVec3_Normalize(kiriVec3_AddScaled(both, 1.0 - trace, a));
    double slide = kiriVec3_Dot(b->gap, axis);
    *strain = lost * slide;
    if (row != NULL) {
        kiriVec3 sine = kiriVec3_Add(kiriVec3_Cross(from->u, to->u), kiriVec3_Cross(from->v, to->v));
        double cotangent = kiriVec3_Dot(axis, kiriVec3_Add(sine, kiriVec3_Cross(from->d, to->d))) / (3.0 - trace); /* of t / 2 */
        kiriVec3 swing = kiriVec3_Scale(0.5 * cotangent, kiriVec3_AddScaled(b->gap, -slide, axis));
        KIRI_TIMES(k, 2) {
            double sign = k == 0 ? -lost : lost;
            kiriVec3 arm = kiriVec3_AddScaled(b->ends[k], k == 0 ? 0.5 : -0.5, b->gap);
            row->end[k].move = kiriVec3_Scale(sign, axis);
            row->end[k].turn = kiriVec3_Scale(sign, kiriVec3_Add(kiriVec3_Cross(arm, axis), swing));
        }
        AddOpening(axes, axes->fade.lostSlope * slide, row);
    }
}

/* Adds the stretch of the edges of a twisted strip. Twisted by t, a strip one region wide shortens by W^2 t^2 / (24 l),
   because its edges are helices. Their stretch beyond the mean has the energy of the curl, with t^2 - nu b^2 in place
   of -nu b^2 (kiri_strain.h). It is added to t^2, but fades at half a turn: if z is the addition to t^2 and
   R = pi^2 - t^2 - b^2, it adds z R / sqrt(z^2 + R^2). That is z for small angles, and the energy never falls as the
   angle grows. As the axes fade, z does. */
static void TakeRibbon(const kiriLink* link, const MeanAxes* axes, double poissonsRatio, const kiriCurl* curl,
                       double* strain, kiriStrainRow* rows)
{
    double lone = kiriLink_LoneWidth(link), nu = poissonsRatio, byQ;
    double b = strain[KIRI_BENDING], t = strain[KIRI_TWIST];
    double held = kiriCurl_Held(curl->perSquare * b * b, &byQ), sum = t * t - 2.0 * nu * b * b;
    double whole = curl->perSquare * lone / ((1.0 - nu) * (link->width + link->outer)), stiff = axes->fade.keep * whole;
    double part = stiff * held * sum;
    double z = t * t * part, room = HALF_TURN * HALF_TURN - t * t - b * b;
    double R = kiriMax(room, LEAST_ROOM), per = 1.0 / sqrt(z * z + R * R);
    double factor = sqrt(1.0 + part * R * per), shorter = lone * link->width / (24.0 * link->length);
    strain[KIRI_STRETCH] += shorter * t * t;
    strain[KIRI_TWIST] *= factor;
    if (rows != NULL) {
        double byPart = per * per * per * R * R * R, byTwist = -per * per * per * part * part * part * R * t * t;
        double byRoom = room > LEAST_ROOM ? -per * per * per * part * z * z : 0.0;
        double byT = byPart * stiff * held + byTwist + byRoom;
        double byB = byPart * stiff * (curl->perSquare * byQ * sum - 2.0 * nu * held) + byRoom;
        AddRow(&rows[KIRI_STRETCH], 2.0 * shorter * t, &rows[KIRI_TWIST]);
        ScaleRow(&rows[KIRI_TWIST], factor + t * t * byT / factor);
        AddRow(&rows[KIRI_TWIST], t * b * byB / factor, &rows[KIRI_BENDING]);
        AddOpening(axes, 0.5 * t * byPart * whole * held * sum * axes->fade.slope / factor, &rows[KIRI_TWIST]);
    }
}

/* Takes bending and twist along and across the edge of the material instead of the link's normal. */
static void FollowEdge(const kiriLink* link, double* strain, kiriStrainRow* rows)
{
    double c = 1.0 / sqrt(1.0 + link->lean * link->lean), s = c * link->lean, bending = strain[KIRI_BENDING];
    strain[KIRI_BENDING] = c * bending + s * strain[KIRI_TWIST];
    strain[KIRI_TWIST] = c * strain[KIRI_TWIST] - s * bending;
    if (rows != NULL) {
        kiriStrainRow byBending = rows[KIRI_BENDING];
        ScaleRow(&rows[KIRI_BENDING], c);
        AddRow(&rows[KIRI_BENDING], s, &rows[KIRI_TWIST]);
        ScaleRow(&rows[KIRI_TWIST], c);
        AddRow(&rows[KIRI_TWIST], -s, &byBending);
    }
}

/* Scales bending by the curl of the strip. */
static void TakeCurl(const kiriCurl* curl, double* bending, kiriStrainRow* row)
{
    double slope, squared = *bending * *bending, factor = kiriCurl_Factor(curl, squared, &slope);
    if (row != NULL) {
        ScaleRow(row, factor + 2.0 * slope * squared);
    }
    *bending *= factor;
}

double kiriStrain_PlateStiffness(const kiriMaterial* material)
{
    double h = material->thickness, nu = material->poissonsRatio;
    return material->youngsModulus * h * h * h / (12.0 * (1.0 - nu * nu));
}

double kiriStrain_BalanceLength(const kiriMaterial* material)
{
    double cube = kiriStrain_PlateStiffness(material) / (material->density * (double)material->thickness * 9.81);
    double root = kiriMax(cube, 1.0);
    KIRI_TIMES(i, 200) { /* Newton's iteration from above */
        root = (2.0 * root + cube / (root * root)) / 3.0;
    }
    return root;
}

/* Measures the part along a vector that frame i carries, of a vector that j carries, or of the gap at a point: `from`
   has the arms of the gap, or is null. */
static double MeasureAlong(kiriVec3 axis, kiriVec3 vector, const EndVectors* from, kiriStrainRow* row)
{
    if (row != NULL) {
        kiriVec3 turn = kiriVec3_Cross(axis, vector), move = from != NULL ? axis : (kiriVec3){ 0 };
        row->end[0].turn = from != NULL ? kiriVec3_Add(turn, kiriVec3_Cross(axis, from->ends[0])) : turn;
        row->end[1].turn = kiriVec3_Cross(from != NULL ? from->ends[1] : vector, axis);
        row->end[0].move = kiriVec3_Scale(-1.0, move);
        row->end[1].move = move;
    }
    return kiriVec3_Dot(axis, vector);
}

/* Measures the angle by which j is folded up against i. It is counted from half a turn before to half a turn behind a
   quarter of the rest angle: so both the flat sheet and the rest angle are within the range. */
static double MeasureHinge(const kiriLink* link, const kiriVec3 axes[2][3], kiriStrainRow* row)
{
    kiriStrainRow byCosine;
    double sine = MeasureAlong(axes[0][2], axes[1][0], NULL, row);
    double cosine = MeasureAlong(axes[0][2], axes[1][2], NULL, row != NULL ? &byCosine : NULL);
    double square = kiriMax(sine * sine + cosine * cosine, LEAST_AXIS), angle = kiriAngle(sine, cosine);
    double low = 0.25 * link->rest - HALF_TURN, high = 0.25 * link->rest + HALF_TURN;
    if (row != NULL) {
        ScaleRow(row, cosine / square);
        AddRow(row, -sine / square, &byCosine);
    }
    return angle < low ? angle + 2.0 * HALF_TURN : angle > high ? angle - 2.0 * HALF_TURN : angle;
}

/* Measures the strains of a fold, see kiri_strain.h. */
static void MeasureFold(const kiriLink* link, const kiriFrameData* const frames[2], const kiriPose* const poses[2],
                        double turned, double strain[KIRI_STRAINS], kiriStrainRow* rows)
{
    KIRI_ASSERT(link->fold > 0 && link->hinge >= 0.0);
    EndVectors b = PointVectors(frames, poses, link->centroid);
    kiriVec3 axes[2][3];
    KIRI_TIMES(k, 2) {
        axes[k][0] = kiriPose_Along(poses[k], link->normal);
        axes[k][1] = kiriPose_Along(poses[k], link->tangent);
        axes[k][2] = poses[k]->A.d;
    }
    strain[KIRI_STRETCH] = MeasureAlong(axes[0][0], b.gap, &b, ROW_OF(rows, KIRI_STRETCH));
    strain[KIRI_SHEAR] = MeasureAlong(axes[0][1], b.gap, &b, ROW_OF(rows, KIRI_SHEAR));
    strain[KIRI_NORMAL_GAP] = MeasureAlong(axes[0][2], b.gap, &b, ROW_OF(rows, KIRI_NORMAL_GAP));
    strain[KIRI_PLANE_BENDING] = MeasureAlong(axes[0][0], axes[1][1], NULL, ROW_OF(rows, KIRI_PLANE_BENDING)) - turned;
    strain[KIRI_TWIST] = MeasureAlong(axes[0][2], axes[1][1], NULL, ROW_OF(rows, KIRI_TWIST));
    strain[KIRI_BENDING] = MeasureHinge(link, (const kiriVec3(*)[3])axes, ROW_OF(rows, KIRI_BENDING)) - link->rest;
    for (int s = KIRI_FOLD; s < KIRI_STRAINS; ++s) {
        strain[s] = 0.0;
        if (rows != NULL) {
            KIRI_CLEAR(&rows[s]);
        }
    }
}

double kiriFold_Angle(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                      const kiriPose* const poses[2], double offset)
{
    double strain[KIRI_STRAINS], stiffness[KIRI_STRAINS];
    MeasureFold(link, frames, poses, 0.0, strain, NULL);
    kiriStrain_Stiffness(link, material, stiffness);
    double moment = stiffness[KIRI_BENDING] * (strain[KIRI_BENDING] - offset);
    double bending = kiriStrain_PlateStiffness(material) * link->width / link->length;
    return strain[KIRI_BENDING] + link->rest - moment / bending;
}

void kiriStrain_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double turned, double strain[KIRI_STRAINS],
                        kiriStrainRow* rows)
{
    KIRI_ASSERT(link->length > 0.0 && link->width > 0.0);
    if (link->fold != 0) {
        MeasureFold(link, frames, poses, turned, strain, rows);
        return;
    }
    MeanAxes axes = MeanAxesOf(link, poses, rows != NULL);
    EndVectors b = PointVectors(frames, poses, link->centroid), m = PointVectors(frames, poses, link->crossing);
    kiriVec2 middle = kiriVec2_Scale(0.5, kiriVec2_Add(PivotOf(frames[0]), PivotOf(frames[1])));
    EndVectors q = PointVectors(frames, poses, middle);
    EndVectors directors = DirectionVectors(poses[0]->A.d, poses[1]->A.d);
    /* The line that carries tension joins the centres of mass, so tension has no lever to turn a frame. It is never much
       shorter than the path through the link, which may lead around a slit. */
    double apart = kiriVec2_Dot(kiriVec2_Sub(PivotOf(frames[1]), PivotOf(frames[0])), link->normal);
    double lever = kiriClamp(apart, 0.5 * link->length, link->length);
    MeasureStretch(lever, BumpOf(link), &axes, &b, &m, &q, &strain[KIRI_STRETCH], ROW_OF(rows, KIRI_STRETCH));
    MeasureStop(KIRI_NORMAL_STOP_SHARE * link->length, &axes, &m, &strain[KIRI_NORMAL_STOP],
                ROW_OF(rows, KIRI_NORMAL_STOP));
    strain[KIRI_NORMAL_GAP] = kiriVec3_Dot(m.gap, axes.d);
    strain[KIRI_SHEAR] = kiriVec3_Dot(b.gap, axes.tau);
    strain[KIRI_PLANE_BENDING] = -2.0 * axes.sine - turned * axes.cosine;
    strain[KIRI_BENDING] = kiriVec3_Dot(directors.gap, axes.n);
    strain[KIRI_TWIST] = kiriVec3_Dot(directors.gap, axes.tau);
    if (rows != NULL) {
        WriteGap(&axes, axes.d, &m, &rows[KIRI_NORMAL_GAP]);
        WriteGap(&axes, axes.tau, &b, &rows[KIRI_SHEAR]);
        KIRI_CLEAR(&rows[KIRI_PLANE_BENDING]);
        double byTurn = 0.5 * turned * axes.sine - axes.cosine;
        rows[KIRI_PLANE_BENDING].end[0].turn = kiriVec3_Scale(-byTurn, axes.turnBy);
        rows[KIRI_PLANE_BENDING].end[1].turn = kiriVec3_Scale(byTurn, axes.turnBy);
        WriteTurns(&axes, axes.n, &directors, &rows[KIRI_BENDING]);
        WriteTurns(&axes, axes.tau, &directors, &rows[KIRI_TWIST]);
    }
    double onset = TAUT_ONSET * material->thickness * material->thickness / link->length;
    HoldTilt(kiriVec2_Dot(kiriVec2_Sub(middle, link->crossing), link->tangent), lever, onset, strain, rows);
    TakeAngle(&axes, strain, rows);
    TakeArc(link, frames, strain, rows);
    if (link->lean != 0.0) {
        FollowEdge(link, strain, rows);
    }
    kiriCurl curl = kiriCurl_Of(link, material, link->outer);
    if (link->outer >= link->width) { /* open at both ends */
        TakeRibbon(link, &axes, material->poissonsRatio, &curl, strain, rows);
    }
    if (material->slack > 0.0f && strain[KIRI_STRETCH] < 0.0) {
        double keep = sqrt(1.0 - material->slack), reach = SLACK_REACH * link->length;
        double share = reach / (reach - strain[KIRI_STRETCH]);
        strain[KIRI_STRETCH] *= keep + (1.0 - keep) * share;
        if (rows != NULL) {
            ScaleRow(&rows[KIRI_STRETCH], keep + (1.0 - keep) * share * share);
        }
    }
    double bending = strain[KIRI_BENDING];
    kiriStrainRow byBending;
    if (rows != NULL) {
        byBending = rows[KIRI_BENDING];
    }
    if (curl.gain > 0.0) {
        TakeCurl(&curl, &strain[KIRI_BENDING], ROW_OF(rows, KIRI_BENDING));
    }
    FadeStrains(&axes, bending, &byBending, strain, rows);
    MeasureSlide(&axes, poses, &b, &strain[KIRI_FOLD_SLIDE], ROW_OF(rows, KIRI_FOLD_SLIDE));
}

double kiriStrain_Damping(const double strain[KIRI_STRAINS])
{
    double share = kiriMin(1.0 - strain[KIRI_FOLD] / HALF_TURN, 2.0 - fabs(strain[KIRI_PLANE_BENDING]));
    return share < 0.0 ? 0.0 : kiriMin(share, 1.0);
}

void kiriStrain_TakeOffsets(const double* strain, const double* offset, int count, bool isAffine, double* pulling)
{
    KIRI_ASSERT(count > 0 && count <= (isAffine ? (int)KIRI_AFFINE_STRAINS : (int)KIRI_STRAINS));
    KIRI_TIMES(e, count) {
        pulling[e] = strain[e] - (e == KIRI_PLANE_BENDING ? 0.0 : offset[e]);
    }
    for (int e = KIRI_FOLD; !isAffine && e < count; ++e) { /* folds and stops only push */
        double over = fabs(strain[e]) - fabs(offset[e]);
        pulling[e] = over <= 0.0 ? 0.0 : strain[e] > 0.0 ? over : -over;
    }
}

/* Returns the width of a strip, clamped at both ends, that has the same stiffness against a normal gap. */
static double NormalGapWidth(const kiriLink* link, double poissonsRatio)
{
    double outer = link->outer, lone = kiriLink_LoneWidth(link), nu = poissonsRatio;
    return GAP_INNER * (link->width - outer - link->beyond) +
           (1.0 - nu * nu) * (GAP_OUTER * (outer - lone + link->beyond) + lone);
}

/* Part of the turn of a fold that the material makes at which a fold is half a hinge, half a plate. */
#define HALF_HINGE 0.05

/* Sets the stiffness of a fold. Along its line the material neither stretches nor curls. The hinge and the material up
   to the two sites turn in series. At a soft hinge both sides are as stiff as in their plane, or they would come apart
   visibly; the regions beyond bend and twist. A stiff hinge bends and twists as a plate. */
static void SetFoldStiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_STRAINS])
{
    double nu = material->poissonsRatio, W = link->width, l = link->length;
    double membrane = (double)material->youngsModulus * material->thickness / l;
    double bending = kiriStrain_PlateStiffness(material) / l;
    double share = link->hinge / (bending + link->hinge);
    double stiff = share * share / (HALF_HINGE * HALF_HINGE), loose = 1.0 / (1.0 + stiff * stiff);
    stiffness[KIRI_STRETCH] = membrane * W;
    stiffness[KIRI_SHEAR] = membrane * W / (1.0 + nu);
    stiffness[KIRI_PLANE_BENDING] = membrane * kiriMax(link->moment, W * W * W / 12.0);
    stiffness[KIRI_BENDING] = W * bending * share;
    stiffness[KIRI_TWIST] = bending * (1.0 - nu) * W + loose * stiffness[KIRI_PLANE_BENDING];
    stiffness[KIRI_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * W / (l * l) + loose * membrane * W;
    stiffness[KIRI_FOLD] = stiffness[KIRI_NORMAL_STOP] = stiffness[KIRI_FOLD_SLIDE] = 0.0;
}

void kiriStrain_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_STRAINS])
{
    if (link->fold != 0) {
        SetFoldStiffness(link, material, stiffness);
        return;
    }
    double h = material->thickness, nu = material->poissonsRatio, l = link->length;
    double membrane = material->youngsModulus * h / l, bending = membrane * h * h / (12.0 * (1.0 - nu * nu));
    double outer = link->outer, inner = link->width - outer, beyond = link->beyond;
    stiffness[KIRI_STRETCH] = membrane * (inner / (1.0 + nu) + outer + nu / (1.0 + nu) * beyond);
    stiffness[KIRI_SHEAR] = membrane * (inner + 0.5 * SHEAR_BEAM * outer) / (1.0 + nu);
    stiffness[KIRI_PLANE_BENDING] =
        membrane * link->moment * (1.0 + PLANE_SQUARE * nu / (1.0 + nu) * link->square / link->width);
    stiffness[KIRI_BENDING] = bending * (1.0 - nu) * (inner + (1.0 + nu) * outer + nu * beyond);
    stiffness[KIRI_TWIST] = bending * (1.0 - nu) * (inner + 2.0 * outer + beyond);
    stiffness[KIRI_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * NormalGapWidth(link, nu) / (l * l);
    stiffness[KIRI_FOLD] = stiffness[KIRI_TWIST];
    stiffness[KIRI_NORMAL_STOP] = membrane * link->width;
    stiffness[KIRI_FOLD_SLIDE] = stiffness[KIRI_SHEAR];
}

kiriTrace kiriTrace_Measure(const kiriCorner* corner, const kiriLink* links, const double* const strains[4],
                            bool planar)
{
    kiriTrace trace;
    trace.strain[KIRI_TRACE_STRETCH] = trace.strain[KIRI_TRACE_CURVATURE] = 0.0;
    KIRI_TIMES(k, corner->count) {
        const kiriLink* link = &links[corner->link[k]];
        double alongNormal = kiriVec2_Dot(corner->weight[k], link->normal);
        double alongTangent = kiriVec2_Dot(corner->weight[k], link->tangent);
        trace.by[k][KIRI_TRACED_STRETCH] = alongNormal;
        trace.by[k][KIRI_TRACED_SHEAR] = alongTangent;
        trace.strain[KIRI_TRACE_STRETCH] +=
            alongNormal * strains[k][KIRI_STRETCH] + alongTangent * strains[k][KIRI_SHEAR];
        if (!planar) {
            kiriVec2 by = kiriLink_AlongEdge(link, kiriVec2_Make(alongNormal, alongTangent)); /* see FollowEdge */
            trace.by[k][KIRI_TRACED_BENDING] = by.x;
            trace.by[k][KIRI_TRACED_TWIST] = by.y;
            trace.strain[KIRI_TRACE_CURVATURE] += trace.by[k][KIRI_TRACED_BENDING] * strains[k][KIRI_BENDING] +
                                                  trace.by[k][KIRI_TRACED_TWIST] * strains[k][KIRI_TWIST];
        }
    }
    return trace;
}

/* Adds a frame to those that there are, in order, unless it is there. */
static int32_t AddMember(int32_t* members, int32_t count, int32_t frame)
{
    int32_t at = count;
    while (at > 0 && members[at - 1] > frame) {
        --at;
    }
    if (at > 0 && members[at - 1] == frame) {
        return count;
    }
    KIRI_ASSERT(count < 4);
    for (int32_t m = count; m > at; --m) {
        members[m] = members[m - 1];
    }
    members[at] = frame;
    return count + 1;
}

static int32_t PlaceOf(const int32_t* members, int32_t count, int32_t frame)
{
    int32_t at = 0;
    while (at < count && members[at] != frame) {
        ++at;
    }
    return at;
}

void kiriTrace_Members(const kiriCorner* corner, const kiriLink* links, int32_t members[4], int32_t ends[4][2])
{
    int32_t count = 0;
    KIRI_ASSERT(corner->count == 3 || corner->count == 4);
    KIRI_TIMES(k, corner->count) {
        count = AddMember(members, count, links[corner->link[k]].i);
        count = AddMember(members, count, links[corner->link[k]].j);
    }
    KIRI_ASSERT(count == corner->count);
    KIRI_TIMES(k, corner->count) {
        ends[k][0] = PlaceOf(members, count, links[corner->link[k]].i);
        ends[k][1] = PlaceOf(members, count, links[corner->link[k]].j);
    }
}

void kiriTrace_Stiffness(const kiriCorner* corner, const kiriMaterial* material, double stiffness[KIRI_TRACES])
{
    double h = material->thickness, nu = material->poissonsRatio;
    double membrane = material->youngsModulus * h / (1.0 - nu * nu);
    stiffness[KIRI_TRACE_STRETCH] = nu * membrane * corner->area;
    stiffness[KIRI_TRACE_CURVATURE] = nu * membrane * h * h / 12.0 * corner->area;
}

bool kiriStrainOffsets_Reserve(kiriStrainOffsets* strainOffsets, kiriMemory* memory, int32_t linkCount,
                               int32_t frameCount)
{
    return kiriArrays_Reserve(memory, linkCount, &strainOffsets->strainOffsets, &strainOffsets->older,
                              &strainOffsets->from) &&
           kiriArrays_Reserve(memory, frameCount, &strainOffsets->frames, &strainOffsets->mayMove);
}

void kiriStrainOffsets_Remember(kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t frameCount,
                                const uint8_t* mayMove)
{
    KIRI_ASSERT(frameCount <= strainOffsets->frames.capacity && frameCount <= strainOffsets->mayMove.capacity);
    strainOffsets->frames.count = strainOffsets->mayMove.count = frameCount;
    KIRI_TIMES(f, frameCount) {
        strainOffsets->mayMove.data[f] = mayMove[f];
        if (mayMove[f]) {
            strainOffsets->frames.data[f] = frames[f];
        }
    }
}

/* Frames are compared byte by byte, so they must have no padding. */
typedef char kiriPoseHasNoPadding[sizeof(kiriPose) == 12 * sizeof(double) ? 1 : -1];

void kiriStrain_MeasureLink(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* i,
                            const kiriFrameData* j, double turned, double strain[KIRI_STRAINS])
{
    const kiriFrameData* const ends[2] = { i, j };
    const kiriPose now[2] = { kiriPose_Of(i), kiriPose_Of(j) };
    const kiriPose* const poses[2] = { &now[0], &now[1] };
    kiriStrain_Measure(link, material, ends, poses, turned, strain, NULL);
}

void kiriStrainOffset_Keep(const double* strain, const double* turned, const double* was, const double* older,
                           double* offset)
{
    double cosine = strain[KIRI_PLANE_BENDING] - turned[KIRI_PLANE_BENDING];
    KIRI_TIMES(e, KIRI_STRAINS) {
        offset[e] = strain[e] - was[e] + (e == KIRI_PLANE_BENDING ? 0.0 : older[e]);
    }
    offset[KIRI_PLANE_BENDING] /= kiriMax(cosine, LEAST_COSINE);
    offset[KIRI_PLANE_BENDING] = kiriClamp(offset[KIRI_PLANE_BENDING], -MOST_TURNED, MOST_TURNED);
}

const kiriFrameData* kiriStrainOffsets_FrameBefore(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames,
                                                   int32_t frame)
{
    KIRI_ASSERT_HAS(strainOffsets->mayMove, frame);
    return strainOffsets->mayMove.data[frame] ? &strainOffsets->frames.data[frame] : &frames[frame];
}

static bool IsFrameUnmoved(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t f)
{
    const kiriFrameData *was = kiriStrainOffsets_FrameBefore(strainOffsets, frames, f), *is = &frames[f];
    return was == is || (memcmp(&was->x, &is->x, sizeof(is->x)) == 0 && memcmp(&was->A, &is->A, sizeof(is->A)) == 0 &&
                         memcmp(&was->center, &is->center, sizeof(is->center)) == 0);
}

/* Returns the offset of a link; `old` is the link that it goes on from, or null. */
static kiriStrainOffset StrainOffsetOf(const kiriStrainOffsets* strainOffsets, const kiriLink* link,
                                       const kiriLink* old, const kiriStrainOffset* older, const kiriFrameData* frames,
                                       const kiriMaterial* material)
{
    kiriStrainOffset offset;
    double strain[KIRI_STRAINS], turned[KIRI_STRAINS], was[KIRI_STRAINS] = { 0 };
    double before[KIRI_STRAINS], after[KIRI_STRAINS];
    kiriStrain_MeasureLink(link, material, &frames[link->i], &frames[link->j], 0.0, strain);
    kiriStrain_MeasureLink(link, material, &frames[link->i], &frames[link->j], 1.0, turned);
    if (old != NULL) {
        kiriStrain_MeasureLink(old, material, kiriStrainOffsets_FrameBefore(strainOffsets, frames, old->i),
                    kiriStrainOffsets_FrameBefore(strainOffsets, frames, old->j), older->strain[KIRI_PLANE_BENDING], was);
        kiriStrain_Stiffness(old, material, before);
        kiriStrain_Stiffness(link, material, after);
        KIRI_TIMES(e, KIRI_FOLD) { /* a link that becomes stiffer keeps its force: else it would gain energy */
            double hidden = e == KIRI_PLANE_BENDING ? 0.0 : older->strain[e];
            was[e] = after[e] > before[e] ? hidden + before[e] / after[e] * (was[e] - hidden) : was[e];
        }
    }
    kiriStrainOffset_Keep(strain, turned, was, older->strain, offset.strain);
    return offset;
}

/* Finds the old link that each link goes on from. */
static void FindOlder(kiriStrainOffsets* strainOffsets, const kiriLink* old, int32_t oldCount, const kiriLink* links,
                      int32_t linkCount, const int32_t* was)
{
    int32_t o = 0;
    KIRI_TIMES(k, linkCount) {
        bool known = was != NULL && was[k] == o;
        if (!known) {
            while (o < oldCount && kiriLink_IsBefore(&old[o], &links[k])) {
                ++o;
            }
            known = o < oldCount && !kiriLink_IsBefore(&links[k], &old[o]);
        }
        strainOffsets->from.data[k] = known ? o : KIRI_NONE;
        o += known;
    }
}

void kiriStrainOffsets_Take(kiriStrainOffsets* strainOffsets, kiriPlastics* plastics, const kiriLink* old,
                            int32_t oldCount, const kiriLink* links, int32_t linkCount, const int32_t* was,
                            const kiriFrameData* frames, const kiriMaterial* material)
{
    KIRI_ASSERT(linkCount <= strainOffsets->strainOffsets.capacity && linkCount <= strainOffsets->from.capacity);
    const kiriStrainOffset none = { { 0.0 } };
    int32_t had = strainOffsets->strainOffsets.count;
    kiriStrainOffset* offsets = strainOffsets->strainOffsets.data;
    FindOlder(strainOffsets, old, oldCount, links, linkCount, was);
    if (had > 0) {
        memcpy(strainOffsets->older.data, offsets, sizeof(*offsets) * (size_t)had);
    }
    KIRI_TIMES(k, linkCount) {
        int32_t from = strainOffsets->from.data[k];
        const kiriStrainOffset* older = from == KIRI_NONE || from >= had ? &none : &strainOffsets->older.data[from];
        bool isSame = from != KIRI_NONE &&
                      ((was != NULL && was[k] == from) || memcmp(&old[from], &links[k], sizeof(*links)) == 0);
        if (!isSame || !IsFrameUnmoved(strainOffsets, frames, links[k].i) ||
            !IsFrameUnmoved(strainOffsets, frames, links[k].j)) {
            offsets[k] = StrainOffsetOf(strainOffsets, &links[k], from != KIRI_NONE ? &old[from] : NULL, older, frames,
                                        material);
        } else {
            offsets[k] = *older;
        }
    }
    strainOffsets->strainOffsets.count = linkCount;
    if (plastics->isKept) {
        kiriPlastics_Take(plastics, old, links, linkCount, strainOffsets->from.data, material);
    }
}

void kiriStrainOffset_Fade(double* offset, const kiriPlastic* plastic, int count, double keep)
{
    if (plastic != NULL) {
        offset[KIRI_BENDING] -= plastic->part.bending;
        offset[KIRI_TWIST] -= plastic->part.twist;
        offset[KIRI_FOLD] -= plastic->part.fold;
    }
    KIRI_TIMES(e, count) {
        offset[e] = fabs(offset[e]) > 1e-12 ? keep * offset[e] : 0.0;
    }
    if (plastic != NULL) {
        offset[KIRI_BENDING] += plastic->part.bending;
        offset[KIRI_TWIST] += plastic->part.twist;
        offset[KIRI_FOLD] += plastic->part.fold;
    }
}

kiriCurl kiriCurl_Of(const kiriLink* link, const kiriMaterial* material, double curling)
{
    double nu = material->poissonsRatio, h = material->thickness;
    double W = 2.0 * link->outer - kiriLink_LoneWidth(link); /* of the strip */
    double inner = (1.0 - nu) * (link->width - link->outer), outer = (1.0 - nu * nu) * link->outer;
    double ratio = W * W / (link->length * h);
    kiriCurl curl = { nu * nu * curling / (inner + outer), 3.0 * (1.0 - nu * nu) * ratio * ratio };
    return curl;
}

/* F to 0.01, without functions other than the square root: with q = theta^4 it is 1 - q / 180 where theta is small,
   2 / theta where it is large. */
#define CURL_FIT 0.0054
#define CURL_FIRST (CURL_FIT + 1.0 / 45.0)
#define CURL_SECOND (CURL_FIT / 16.0)

static double CurledShare(double q, double* slope)
{
    double above = 1.0 + CURL_FIT * q, below = 1.0 + (CURL_FIRST + CURL_SECOND * q) * q;
    double share = sqrt(sqrt(above / below));
    *slope = 0.25 * share * (CURL_FIT / above - (CURL_FIRST + 2.0 * CURL_SECOND * q) / below);
    return share;
}

/* 1 - F = (1 - F^4) / (1 + F + F^2 + F^3). */
double kiriCurl_Held(double q, double* slope)
{
    double byQ, share = CurledShare(q, &byQ), below = 1.0 + (CURL_FIRST + CURL_SECOND * q) * q;
    double sum = (1.0 + share) * (1.0 + share * share), bySum = byQ * (1.0 + (2.0 + 3.0 * share) * share);
    double held = (1.0 / 45.0 + CURL_SECOND * q) / (below * sum);
    *slope = CURL_SECOND / (below * sum) - held * ((CURL_FIRST + 2.0 * CURL_SECOND * q) / below + bySum / sum);
    return held;
}

double kiriCurl_Factor(const kiriCurl* curl, double squaredAngle, double* slope)
{
    double byQ, share = CurledShare(curl->perSquare * squaredAngle, &byQ);
    double factor = sqrt(1.0 + curl->gain * (1.0 - share));
    *slope = -0.5 * curl->gain * curl->perSquare * byQ / factor;
    return factor;
}

double kiriStrain_YieldLength(const kiriLink* link, const kiriMaterial* material, kiriBentStrain* stiffness,
                              double bending)
{
    double slope;
    if (link->fold != 0) {
        double perAngle = 2.0 * material->yieldStress / ((double)material->youngsModulus * material->thickness);
        bool yields = link->yield > 0.0 && stiffness->bending > 0.0;
        double limit = yields ? link->yield * link->width / (1.5 * stiffness->bending) : 0.0;
        *stiffness = (kiriBentStrain){ limit > 0.0 ? stiffness->bending : 0.0, 0.0, 0.0 };
        return limit / perAngle;
    }
    kiriCurl curl = kiriCurl_Of(link, material, link->outer);
    return link->length * (curl.gain > 0.0 ? kiriCurl_Factor(&curl, bending * bending, &slope) : 1.0);
}

#define GAP_SHARE 0.3    /* of the membrane stiffness, against gaps in the plane */
#define LEAN_PENALTY 3.0 /* see kiri_strain.h: leaning counts 1 + 3 times */

/* ---- Links ------------------------------------------------------------------------------------------------------ */

/* The mean director of two frames. It changes with the director of end k by by[k] times the part of that change across
   the mean. */
typedef struct MeanDirector {
    kiriVec3 d;
    double by[2];
} MeanDirector;

/* Returns the mean director. If the sheet is folded flat on itself, uses the director of the first frame. */
static MeanDirector FindMeanDirector(const kiriPose* const poses[2])
{
    kiriVec3 sum = kiriVec3_Add(poses[0]->A.d, poses[1]->A.d);
    double length = kiriVec3_Length(sum), first = kiriVec3_Length(poses[0]->A.d);
    if (length > 1e-6) {
        MeanDirector mean = { kiriVec3_Scale(1.0 / length, sum), { 1.0 / length, 1.0 / length } };
        return mean;
    }
    MeanDirector mean = { kiriVec3_Scale(first > 1e-6 ? 1.0 / first : 0.0, poses[0]->A.d),
                          { first > 1e-6 ? 1.0 / first : 0.0, 0.0 } };
    return mean;
}

static kiriVec3 AcrossDirector(const MeanDirector* mean, kiriVec3 a)
{
    return kiriVec3_Across(a, mean->d);
}

/* A difference of the two frames, sum over the ends of +-(x move + A_u at.x + A_v at.y): the gap at a point, or, with
   move 0, the difference of the slopes along a direction. */
typedef struct FrameDifference {
    double move;
    kiriVec2 at[2];
    kiriVec3 value;
} FrameDifference;

static FrameDifference TakeDifference(double move, kiriVec2 first, kiriVec2 second, const kiriPose* const poses[2])
{
    FrameDifference g = { move, { first, second }, { 0.0, 0.0, 0.0 } };
    g.value = kiriVec3_Scale(move, kiriVec3_Sub(poses[1]->x, poses[0]->x));
    kiriVec3 along = kiriVec3_Sub(kiriPose_Along(poses[1], second), kiriPose_Along(poses[0], first));
    g.value = kiriVec3_Add(g.value, along);
    return g;
}

static FrameDifference GapAt(const kiriFrameData* const frames[2], const kiriPose* const poses[2], kiriVec2 at)
{
    return TakeDifference(1.0, kiriVec2_Sub(at, frames[0]->center), kiriVec2_Sub(at, frames[1]->center), poses);
}

/* Writes the derivative of a strain by the ends of a difference and by the turn of its mean director. */
static void WriteRow(const FrameDifference* g, const MeanDirector* mean, kiriVec3 byValue, kiriVec3 byMean,
                     kiriFrameRow row[2])
{
    KIRI_TIMES(k, 2) {
        kiriVec3 by = kiriVec3_Scale(k == 0 ? -1.0 : 1.0, byValue);
        row[k].by[0] = kiriVec3_Scale(g->move, by);
        row[k].by[1] = kiriVec3_Scale(g->at[k].x, by);
        row[k].by[2] = kiriVec3_Scale(g->at[k].y, by);
        row[k].by[3] = kiriVec3_Scale(mean->by[k], AcrossDirector(mean, byMean));
    }
}

/* Measures the part in the plane, one row for each axis of space: P g = g - d (d . g). */
static void MeasureInPlane(const FrameDifference* g, const MeanDirector* mean, double* strain, kiriFrameRow rows[][2])
{
    const kiriVec3 axes[3] = KIRI_AXES;
    double along = kiriVec3_Dot(g->value, mean->d);
    KIRI_TIMES(a, 3) {
        double lean = kiriVec3_Dot(axes[a], mean->d);
        strain[a] = kiriVec3_Dot(axes[a], g->value) - along * lean;
        if (rows != NULL) {
            kiriVec3 byMean = kiriVec3_Scale(-1.0, kiriVec3_AddScaled(kiriVec3_Scale(along, axes[a]), lean, g->value));
            WriteRow(g, mean, AcrossDirector(mean, axes[a]), byMean, rows[a]);
        }
    }
}

/* Measures the difference of the directors, scaled up by the curl of the strip: see kiri_strain.h. */
static void MeasureBending(const kiriCurl* curl, const kiriPose* const poses[2], double* strain, kiriFrameRow rows[][2])
{
    const kiriVec3 axes[3] = KIRI_AXES, zero = { 0 };
    kiriVec3 bent = kiriVec3_Sub(poses[1]->A.d, poses[0]->A.d);
    double slope, factor = kiriCurl_Factor(curl, kiriVec3_Dot(bent, bent), &slope);
    KIRI_TIMES(a, 3) {
        double part = kiriVec3_Dot(axes[a], bent);
        strain[a] = factor * part;
        if (rows != NULL) {
            kiriVec3 by = kiriVec3_AddScaled(kiriVec3_Scale(factor, axes[a]), 2.0 * slope * part, bent);
            kiriFrameRow first = { { zero, zero, zero, kiriVec3_Scale(-1.0, by) } };
            kiriFrameRow second = { { zero, zero, zero, by } };
            rows[a][0] = first;
            rows[a][1] = second;
        }
    }
}

void kiriAffine_AddTrace(kiriVec2 p, const kiriPose* const poses[2], double* strain, kiriFrameRow* const rows[2])
{
    kiriVec3 bent = kiriVec3_Sub(poses[1]->A.d, poses[0]->A.d);
    kiriVec3 along = kiriVec3_Add(kiriPose_Along(poses[0], p), kiriPose_Along(poses[1], p));
    *strain += 0.5 * kiriVec3_Dot(bent, along);
    KIRI_TIMES_WHILE(rows != NULL, k, 2) {
        kiriVec3* by = rows[k]->by;
        by[1] = kiriVec3_AddScaled(by[1], 0.5 * p.x, bent);
        by[2] = kiriVec3_AddScaled(by[2], 0.5 * p.y, bent);
        by[3] = kiriVec3_AddScaled(by[3], k == 0 ? -0.5 : 0.5, along);
    }
}

static void MeasureTwist(const kiriLink* link, const kiriPose* const poses[2], double* strain, kiriFrameRow row[2])
{
    *strain = 0.0;
    if (row == NULL) {
        kiriAffine_AddTrace(link->tangent, poses, strain, NULL);
    } else {
        kiriFrameRow* const rows[2] = { &row[0], &row[1] };
        memset(row, 0, 2 * sizeof(*row));
        kiriAffine_AddTrace(link->tangent, poses, strain, rows);
    }
}

static void MeasureNormalGap(const kiriLink* link, const FrameDifference* g, const MeanDirector* mean, double* strain,
                             kiriFrameRow rows[][2])
{
    kiriVec3 zero = { 0 };
    double gap = kiriVec3_Dot(g->value, mean->d), over = fabs(gap) - KIRI_NORMAL_STOP_SHARE * link->length;
    strain[0] = gap;
    strain[1] = over <= 0.0 ? 0.0 : gap > 0.0 ? over : -over;
    if (rows != NULL) {
        WriteRow(g, mean, mean->d, g->value, rows[0]);
        WriteRow(g, mean, over > 0.0 ? mean->d : zero, over > 0.0 ? g->value : zero, rows[1]);
    }
}

void kiriAffine_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double strain[KIRI_AFFINE_STRAINS], kiriFrameRow rows[][2])
{
    /* Rows of bending see twist too, which does not stiffen: only of strips one region wide, where it is little. */
    kiriCurl curl = kiriCurl_Of(link, material, kiriLink_LoneWidth(link));
    MeanDirector mean = FindMeanDirector(poses);
    FrameDifference b = GapAt(frames, poses, link->centroid), m = GapAt(frames, poses, link->crossing);
    FrameDifference side = TakeDifference(0.0, link->tangent, link->tangent, poses);
    MeasureInPlane(&b, &mean, strain + KIRI_AFFINE_GAP, rows);
    MeasureInPlane(&side, &mean, strain + KIRI_AFFINE_PLANE_BENDING, ROW_OF(rows, KIRI_AFFINE_PLANE_BENDING));
    MeasureBending(&curl, poses, strain + KIRI_AFFINE_BENDING, ROW_OF(rows, KIRI_AFFINE_BENDING));
    MeasureTwist(link, poses, strain + KIRI_AFFINE_TWIST, rows != NULL ? rows[KIRI_AFFINE_TWIST] : NULL);
    MeasureNormalGap(link, &m, &mean, strain + KIRI_AFFINE_NORMAL_GAP, ROW_OF(rows, KIRI_AFFINE_NORMAL_GAP));
}

void kiriAffine_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_AFFINE_STRAINS])
{
    double h = material->thickness, nu = material->poissonsRatio, l = link->length;
    double membrane = material->youngsModulus * h / l, bending = membrane * h * h / (12.0 * (1.0 - nu * nu));
    KIRI_TIMES(a, 3) {
        stiffness[KIRI_AFFINE_GAP + a] = GAP_SHARE * membrane * link->width;
        stiffness[KIRI_AFFINE_PLANE_BENDING + a] = membrane * link->moment;
        stiffness[KIRI_AFFINE_BENDING + a] = bending * (1.0 - nu) * (link->width + nu * link->outer);
    }
    stiffness[KIRI_AFFINE_TWIST] = bending * (1.0 - nu) * (1.0 - nu) * link->outer;
    stiffness[KIRI_AFFINE_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * NormalGapWidth(link, nu) / (l * l);
    stiffness[KIRI_AFFINE_NORMAL_STOP] = membrane * link->width;
}

/* ---- Regions ---------------------------------------------------------------------------------------------------- */

/* Returns the share of a frame in the last element, adding it if necessary. Shares are sorted by frame. */
static kiriFrameShare* FrameShareOf(kiriAreaElements* elements, kiriMemory* memory, kiriAreaElement* element,
                                    int32_t frame)
{
    int32_t k = element->first + element->count;
    while (k > element->first && elements->shares.data[k - 1].frame > frame) {
        --k;
    }
    if (k > element->first && elements->shares.data[k - 1].frame == frame) {
        return &elements->shares.data[k - 1];
    }
    kiriFrameShare fresh = { frame, { 0.0, 0.0 }, { 0.0, 0.0 }, { 0.0, 0.0 }, 0.0, { 0.0, 0.0 } };
    if (!kiriArray_Push(memory, &elements->shares, fresh)) {
        return NULL;
    }
    for (int32_t n = elements->shares.count - 1; n > k; --n) {
        elements->shares.data[n] = elements->shares.data[n - 1];
    }
    elements->shares.data[k] = fresh;
    ++element->count;
    return &elements->shares.data[k];
}

/* Input of the elements of regions. */
typedef struct RegionLinks {
    kiriMemory* memory;
    const kiriMoments* material; /* of each region */
    const kiriLink* links;
    KIRI_ARRAY(kiriSpan) spans;  /* of each region: of ends */
    kiriIndices ends;            /* 2 k, 2 k + 1: the regions of link k */
} RegionLinks;

static bool AddBorder(kiriAreaElements* elements, const RegionLinks* regions, kiriAreaElement* element,
                      const kiriLink* link)
{
    KIRI_TIMES(end, 2) {
        int32_t frame = end == 0 ? link->i : link->j;
        kiriFrameShare* share = FrameShareOf(elements, regions->memory, element, frame);
        if (share == NULL) {
            return false;
        }
        double scale = (end == 0 ? -0.5 : 0.5) / element->area;
        kiriVec2 normal = kiriVec2_Scale(scale, link->sum);
        kiriVec2 arm = kiriVec2_Sub(link->centroid, kiriMoments_Center(&regions->material[frame]));
        kiriVec2 u = kiriVec2_AddScaled(kiriVec2_Scale(arm.x, normal), scale, link->spread[0]);
        kiriVec2 v = kiriVec2_AddScaled(kiriVec2_Scale(arm.y, normal), scale, link->spread[1]);
        share->move = kiriVec2_Add(share->move, normal);
        share->u = kiriVec2_Add(share->u, u);
        share->v = kiriVec2_Add(share->v, v);
    }
    return true;
}

/* Adds an element with the frame's own A, and with its borders if it is a membrane. */
static bool AddRegionElement(kiriAreaElements* elements, const RegionLinks* regions, int32_t frame,
                             kiriAreaElement element, bool hasBorders)
{
    element.area = regions->material[frame].area;
    element.first = elements->shares.count;
    kiriFrameShare* share = FrameShareOf(elements, regions->memory, &element, frame);
    if (share == NULL) {
        return false;
    }
    share->u.x = share->v.y = share->weight = 1.0;
    bool ok = true;
    kiriSpan span = regions->spans.data[frame];
    KIRI_FROM_TO_WHILE(ok && hasBorders, k, span.first, span.first + span.count) {
        ok = AddBorder(elements, regions, &element, &regions->links[regions->ends.data[k] / 2]);
    }
    return ok && kiriArray_Push(regions->memory, &elements->elements, element);
}

bool kiriAffine_Build(kiriAreaElements* elements, kiriMemory* memory, const kiriLink* links, int32_t linkCount,
                      const kiriMoments* material, int32_t frameCount, bool planar)
{
    RegionLinks regions = { memory, material, links, { 0 }, { 0 } };
    kiriIndices of = { 0 };
    elements->elements.count = elements->shares.count = 0;
    bool ok = kiriArray_Resize(memory, &regions.spans, frameCount) &&
              kiriArrays_Resize(memory, 2 * (int64_t)linkCount, &of, &regions.ends);
    KIRI_TIMES_WHILE(ok, k, linkCount) {
        of.data[2 * k] = links[k].i;
        of.data[2 * k + 1] = links[k].j;
    }
    if (ok) {
        kiriSpans_Group(of.data, of.count, regions.spans.data, sizeof(kiriSpan), frameCount, regions.ends.data);
    }
    KIRI_TIMES_WHILE(ok, i, frameCount) {
        const kiriAreaElement membrane = { 0.0, LEAN_PENALTY, 0, 0, KIRI_AREA_DILATION, KIRI_AREA_SHEAR + 1 };
        const kiriAreaElement director = { 0.0, 0.0, 0, 0, KIRI_AREA_LEAN_U, KIRI_AREA_STRAINS };
        ok = AddRegionElement(elements, &regions, i, membrane, true) &&
             (planar || AddRegionElement(elements, &regions, i, director, false));
    }
    kiriArray_Release(memory, &regions.spans);
    kiriArray_Release(memory, &regions.ends);
    kiriArray_Release(memory, &of);
    return ok;
}

void kiriClamp_Shape(kiriClampRow* row, const kiriClampShape* shape, kiriVec2 site)
{
    kiriLink* link = &row->link;
    kiriVec2 off = kiriVec2_Sub(site, shape->from), left = { -shape->along.y, shape->along.x };
    double away = kiriVec2_Dot(off, left);
    row->foot = kiriVec2_AddScaled(shape->from, kiriVec2_Dot(off, shape->along), shape->along);
    row->isAffine = shape->isAffine;
    KIRI_CLEAR(link);
    link->i = KIRI_NONE;
    link->j = row->frame;
    link->width = shape->width;
    link->moment = shape->moment;
    row->outer = shape->outer;
    row->material = shape->material;
    link->length = kiriMax(fabs(away), shape->least);
    link->normal = away < 0.0 ? kiriVec2_Scale(-1.0, left) : left;
    link->tangent = kiriVec2_Make(-link->normal.y, link->normal.x);
    link->span = kiriVec2_Scale(link->length, link->normal);
    kiriVec2 half = kiriVec2_Scale(0.5, link->span);
    link->centroid = shape->isAffine ? shape->centroid : kiriVec2_Add(shape->centroid, half);
    link->crossing = kiriVec2_Add(row->foot, half);
}

void kiriClamp_Measure(const kiriClampRow* row, const kiriFrameData* frame, const kiriPose* line, const kiriPose* pose,
                       double* strain, kiriFrameRow* rows)
{
    kiriFrameData held; /* the line: strains of a link read no more of a held frame */
    KIRI_CLEAR(&held);
    held.site.at = held.center = row->foot;
    held.held = 1;
    const kiriFrameData* const frames[2] = { &held, frame };
    const kiriPose* const poses[2] = { line, pose };
    if (row->isAffine) {
        kiriFrameRow both[KIRI_AFFINE_STRAINS][2];
        kiriAffine_Measure(&row->link, row->material, frames, poses, strain, rows != NULL ? both : NULL);
        KIRI_TIMES_WHILE(rows != NULL, e, KIRI_AFFINE_STRAINS) {
            rows[e] = both[e][1];
        }
    } else {
        kiriStrainRow both[KIRI_STRAINS];
        kiriStrain_Measure(&row->link, row->material, frames, poses, row->offset[KIRI_PLANE_BENDING], strain,
                           rows != NULL ? both : NULL);
        KIRI_TIMES_WHILE(rows != NULL, e, KIRI_STRAINS) {
            KIRI_CLEAR(&rows[e]);
            rows[e].by[0] = both[e].end[1].move;
            rows[e].by[1] = both[e].end[1].turn;
        }
    }
}

/* Writes the stiffness for a rigid frame. Along the line the material neither stretches nor curls, and beside it hardly:
   so it is as stiff as if both directions were strained. */
static void RigidStiffness(const kiriClampRow* row, double* stiffness)
{
    const kiriMaterial* material = row->material;
    double h = material->thickness, nu = material->poissonsRatio, l = row->link.length;
    double membrane = material->youngsModulus * h / (l * (1.0 - nu * nu)), bending = membrane * h * h / 12.0;
    kiriStrain_Stiffness(&row->link, material, stiffness);
    stiffness[KIRI_STRETCH] = membrane * row->link.width;
    stiffness[KIRI_BENDING] = bending * row->link.width;
    stiffness[KIRI_TWIST] = bending * (1.0 - nu) * (row->link.width + row->outer);
    stiffness[KIRI_FOLD] = kiriMax(stiffness[KIRI_BENDING], stiffness[KIRI_TWIST]);
    stiffness[KIRI_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * row->link.width / (l * l);
}

/* Writes the stiffness for an affine frame, whose bending strains include twist. */
static void AffineStiffness(const kiriClampRow* row, double* stiffness)
{
    const kiriMaterial* material = row->material;
    double h = material->thickness, nu = material->poissonsRatio, l = row->link.length;
    double W = row->link.width, membrane = material->youngsModulus * h / l;
    double bending = membrane * h * h / (12.0 * (1.0 - nu * nu)), twisted = (1.0 - nu) * (W + row->outer) - W;
    kiriAffine_Stiffness(&row->link, material, stiffness);
    KIRI_TIMES(a, 3) {
        stiffness[KIRI_AFFINE_GAP + a] = KIRI_CLAMP_AFFINE_GAP * membrane * W;
        stiffness[KIRI_AFFINE_BENDING + a] = bending * W;
    }
    stiffness[KIRI_AFFINE_TWIST] = twisted > 0.0 ? bending * twisted : 0.0;
    stiffness[KIRI_AFFINE_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * W / (l * l);
}

void kiriClamp_Stiffness(const kiriClampRow* row, double* stiffness)
{
    (row->isAffine ? AffineStiffness : RigidStiffness)(row, stiffness);
}
