#include "kiri_strain.h"

#include "kiri_curl.h"

#include <string.h>

/* An offset g of the ends of a strip that is clamped there makes it longer by 3/5 g^2 / l, where a straight line has
   1/2. */
#define ARC_SHARE 1.2
/* Square of the angle at which the arc between two sites is taken for a half. */
#define ARC_FOLD 2.5
/* Timoshenko's 5/6: where no other links share a shear, it is not even over the width. */
#define SHEAR_BEAM (5.0 / 6.0)

/* Bent in its plane, a sheet stretches on one side of a corner and gives way on the other: of that the trace sees
   nothing where four square regions meet, and most where three do. What it lacks is 3 nu / (1 + nu) of the energy of
   the regions themselves in the first case, less than 1 in the second. */
#define PLANE_INNER 1.5

/* A normal gap costs so many times what it does in a strip that is clamped at both ends: between regions that have
   neighbours on both sides, and along an edge. Inside, 1.6 is the mean over directions for a plate under even shear,
   and 3 is nearer to plates with edges and slits, static and in motion. Twist leaves a plate at its edges, where shear
   that runs along them takes it up: the last row of regions carries it by its normal gaps. Less than 6 makes strips
   soft in torsion; ten times these values lock. */
#define GAP_INNER 3.0
#define GAP_OUTER 12.0

/* Square of the cosine of half the fold below which the strains that need the mean axes fade. */
#define FADING 0.1
/* A sum of axes that is shorter has no direction. */
#define LEAST_AXIS 1e-6

#define HALF_TURN 3.14159265358979
/* Folds up to this angle have all of their damping, and axes that can be relied on. */
#define OPEN_FOLD 2.5
/* Of the square of an angle, below that of half a turn. */
#define LEAST_ROOM 1e-6

/* The mean axes of two frames. When the frames turn by w_0 and w_1, the axes turn by the sum over k of
   n (nBy[k] . w_k) + tau (tauBy[k] . w_k) + d (dBy[k] . w_k). */
typedef struct MeanAxes {
    kiriVec3 n, tau, d;
    kiriVec3 nBy[2], tauBy[2], dBy[2];
    double open; /* cosine of half the angle between the directors: 1 where the sheet is flat, 0 where it is folded */
    kiriVec3 openBy[2];
} MeanAxes;

/* How the mean axes turn, from what they were made of. */
static void FindAxisTurns(MeanAxes* axes, const kiriVec3 normals[2], const kiriPose* const poses[2], double lean,
                          double lengthN, double lengthD)
{
    double perN = 1.0 / lengthN, perD = 1.0 / lengthD;
    for (int k = 0; k < 2; ++k) {
        axes->nBy[k] = kiriVec3_Scale(perD, kiriVec3_Cross(axes->tau, poses[k]->A.d));
        axes->tauBy[k] = kiriVec3_Scale(perD, kiriVec3_Cross(poses[k]->A.d, axes->n));
        kiriVec3 about = kiriVec3_AddScaled(kiriVec3_Cross(normals[k], axes->tau), lean, axes->nBy[k]);
        axes->dBy[k] = kiriVec3_Scale(perN, about);
    }
}

static kiriVec3 WithoutPart(kiriVec3 a, kiriVec3 d)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, d), d);
}

/* Where the normals have no mean those of the first frame serve, or its director where these lie along d; and all turns
   with that frame. */
static void TakeFirstAxes(MeanAxes* axes, const kiriLink* link, const kiriPose* first)
{
    kiriVec3 n = WithoutPart(kiriPose_Along(first, link->normal), axes->d);
    memset(axes->nBy, 0, sizeof(axes->nBy));
    memset(axes->tauBy, 0, sizeof(axes->tauBy));
    memset(axes->dBy, 0, sizeof(axes->dBy));
    axes->n = axes->nBy[0] = kiriVec3_Normalize(kiriVec3_Length(n) > 0.5 ? n : WithoutPart(first->A.d, axes->d));
    axes->tau = axes->tauBy[0] = kiriVec3_Cross(axes->d, axes->n);
    axes->dBy[0] = axes->d;
}

static void TakeMeanAxes(MeanAxes* axes, const kiriLink* link, const kiriPose* const poses[2], bool turns)
{
    const kiriVec3 normals[2] = { kiriPose_Along(poses[0], link->normal), kiriPose_Along(poses[1], link->normal) };
    kiriVec3 d = kiriVec3_Add(poses[0]->A.d, poses[1]->A.d), n = kiriVec3_Add(normals[0], normals[1]);
    double lengthD = kiriVec3_Length(d);
    /* Folded flat, it is that of one of the two folds that may have led there. */
    axes->d = lengthD > LEAST_AXIS ? kiriVec3_Scale(1.0 / lengthD, d) : kiriVec3_Scale(-1.0, normals[0]);
    axes->open = 0.5 * lengthD;
    double lean = kiriVec3_Dot(n, axes->d);
    n = kiriVec3_AddScaled(n, -lean, axes->d);
    double lengthN = kiriVec3_Length(n);
    if (!(lengthD > LEAST_AXIS && lengthN > LEAST_AXIS)) {
        TakeFirstAxes(axes, link, poses[0]);
    } else {
        axes->n = kiriVec3_Scale(1.0 / lengthN, n);
        axes->tau = kiriVec3_Cross(axes->d, axes->n);
        if (turns) {
            FindAxisTurns(axes, normals, poses, lean, lengthN, lengthD);
        }
    }
    for (int k = 0; turns && k < 2; ++k) {
        axes->openBy[k] = kiriVec3_Scale(0.5, kiriVec3_Cross(poses[k]->A.d, axes->d));
    }
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

/* The derivative of gap . axis: the ends turn with their frames, and the axis with both. */
static void WriteTurns(const MeanAxes* axes, kiriVec3 axis, const EndVectors* pair, kiriStrainRow* row)
{
    kiriVec3 g = kiriVec3_Cross(axis, pair->gap), zero = { 0.0, 0.0, 0.0 };
    double gn = kiriVec3_Dot(g, axes->n), gtau = kiriVec3_Dot(g, axes->tau), gd = kiriVec3_Dot(g, axes->d);
    for (int k = 0; k < 2; ++k) {
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
    for (int k = 0; k < 2; ++k) {
        row->end[k].move = kiriVec3_Scale(a, row->end[k].move);
        row->end[k].turn = kiriVec3_Scale(a, row->end[k].turn);
    }
}

static void AddRow(kiriStrainRow* row, double a, const kiriStrainRow* other)
{
    for (int k = 0; k < 2; ++k) {
        row->end[k].move = kiriVec3_AddScaled(row->end[k].move, a, other->end[k].move);
        row->end[k].turn = kiriVec3_AddScaled(row->end[k].turn, a, other->end[k].turn);
    }
}

/* What a frame turns about: its centre of mass, or its site when the host holds it there. */
static kiriVec2 PivotOf(const kiriFrameData* frame)
{
    return frame->held ? frame->site.at : frame->center;
}

/* The length of the line that carries tension: between the centres of mass, so that tension has no lever to turn a
   frame with. Never much shorter than the way through the link, which may lead around a slit. */
static double LeverOf(const kiriLink* link, const kiriFrameData* const frames[2])
{
    double apart = kiriVec2_Dot(kiriVec2_Sub(PivotOf(frames[1]), PivotOf(frames[0])), link->normal), l = link->length;
    return apart < 0.5 * l ? 0.5 * l : kiriMin(apart, l);
}

/* The strain is signed along n: the length alone would be at rest again where the frames have passed through each
   other, and a sheet that was crushed would stay inside out. */
static void MeasureStretch(double lever, const MeanAxes* axes, const EndVectors* b, double* strain, kiriStrainRow* row)
{
    double ahead = lever + kiriVec3_Dot(b->gap, axes->n), aside = kiriVec3_Dot(b->gap, axes->d);
    double per = ahead < 0.0 ? 0.0 : ahead < lever ? ahead / lever : 1.0; /* base by ahead */
    double base = ahead > lever ? ahead : 0.5 * lever * (1.0 + per * per);
    double line = sqrt(base * base + ARC_SHARE * aside * aside);
    *strain = ahead - lever + (line - base);
    if (row != NULL) {
        kiriStrainRow d;
        WriteGap(axes, axes->d, b, &d);
        WriteGap(axes, axes->n, b, row);
        ScaleRow(row, 1.0 - per * (1.0 - base / line));
        AddRow(row, ARC_SHARE * aside / line, &d);
    }
}

/* How much of a strain along the mean axes counts, and how that changes with `open`. Where the directors are nearly
   opposite, a small turn swings the mean axes round: gaps of no energy along one would have all that of stretch along
   the next, and no motion would find a way past. */
typedef struct AxisFade {
    double keep, slope;
} AxisFade;

static AxisFade FadeOf(const MeanAxes* axes)
{
    double share = axes->open * axes->open / FADING;
    AxisFade fade = { 1.0, 0.0 };
    if (share < 1.0) {
        fade.keep = share * (2.0 - share);
        fade.slope = 4.0 * (1.0 - share) * axes->open / FADING;
    }
    return fade;
}

static void AddOpening(const MeanAxes* axes, double a, kiriStrainRow* row)
{
    for (int k = 0; k < 2; ++k) {
        row->end[k].turn = kiriVec3_AddScaled(row->end[k].turn, a, axes->openBy[k]);
    }
}

static void FadeStrain(const MeanAxes* axes, AxisFade fade, double* strain, kiriStrainRow* row)
{
    if (row != NULL) {
        ScaleRow(row, fade.keep);
        AddOpening(axes, fade.slope * *strain, row);
    }
    *strain *= fade.keep;
}

/* What the length of the gap has above `most`; only its part along the mean normal where that is known. */
static void MeasureStop(double most, const MeanAxes* axes, const EndVectors* m, double* strain, kiriStrainRow* row)
{
    AxisFade fade = FadeOf(axes);
    double normal = kiriVec3_Dot(m->gap, axes->d), lost = 1.0 - fade.keep;
    double aside = kiriVec3_Dot(m->gap, m->gap) - normal * normal;
    double length = sqrt(normal * normal + lost * lost * aside);
    *strain = length > most ? length - most : 0.0;
    if (row != NULL) {
        memset(row, 0, sizeof(*row));
    }
    if (row != NULL && length > most) {
        kiriStrainRow whole;
        double per = 1.0 / length;
        WriteGap(axes, axes->d, m, row);
        ScaleRow(row, per * (1.0 - lost * lost) * normal);
        WriteGap(axes, m->gap, m, &whole);
        AddRow(row, per * lost * lost, &whole);
        AddOpening(axes, -per * lost * aside * fade.slope, row);
    }
}

static void MeasureNormal(const kiriLink* link, const MeanAxes* axes, const EndVectors* m, double* strain,
                          kiriStrainRow* rows)
{
    strain[KIRI_NORMAL_GAP] = kiriVec3_Dot(m->gap, axes->d);
    if (rows != NULL) {
        WriteGap(axes, axes->d, m, &rows[KIRI_NORMAL_GAP]);
    }
    MeasureStop(KIRI_NORMAL_STOP_SHARE * link->length, axes, m, &strain[KIRI_NORMAL_STOP],
                rows != NULL ? &rows[KIRI_NORMAL_STOP] : NULL);
}

/* The difference of the directors is the chord of the angle between them, 2 sin(a / 2), and with e = 1 - cos(a / 2) its
   arc to the third order is longer by 1 + (2 e - e^2) / 6. The last term is what that lacks of half a turn, where the
   angle, unlike the chord, has a slope: no fold stays because it is complete. */
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

/* How long an arc may be so that tension does not turn the frames. With pivots c apart, e from their middle to b, psi
   the angle from their line to the mean of the frames and delta the angle between these, tension times

       0.1 c psi^2 - 1.2 e psi delta + (c / 8 + 0.6 e^2 / c - s / 12) delta^2

   is the work of turning them: positive for s < 1.5 c - 36 e^2 / c. */
static double LongestArc(const kiriLink* link, const kiriFrameData* const frames[2])
{
    double before = kiriVec2_Dot(kiriVec2_Sub(link->centroid, PivotOf(frames[0])), link->normal);
    double behind = kiriVec2_Dot(kiriVec2_Sub(PivotOf(frames[1]), link->centroid), link->normal);
    double c = before + behind, e = 0.5 * (before - behind);
    double most = c > 0.0 ? 1.4 * c - 36.0 * e * e / c : 0.0;
    return kiriMax(most, 0.0);
}

/* Takes off what the arc between the two sites adds to the gap. Folds of more than two radians are no arcs: there the
   term fades, or a crumpled sheet would find rest in them. */
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

static void FadeStrains(const MeanAxes* axes, double* strain, kiriStrainRow* rows)
{
    const int fading[] = { KIRI_STRETCH, KIRI_SHEAR, KIRI_PLANE_BENDING, KIRI_NORMAL_GAP };
    AxisFade fade = FadeOf(axes);
    for (int k = 0; fade.keep < 1.0 && k < (int)(sizeof(fading) / sizeof(fading[0])); ++k) {
        FadeStrain(axes, fade, &strain[fading[k]], rows != NULL ? &rows[fading[k]] : NULL);
    }
}

/* The bending of a strip that curls: see kiri_curl.h. */
static void TakeCurl(const kiriCurl* curl, double* strain, kiriStrainRow* row)
{
    if (curl->gain > 0.0) {
        double slope, squared = *strain * *strain, factor = kiriCurl_Factor(curl, squared, &slope);
        if (row != NULL) {
            ScaleRow(row, factor + 2.0 * slope * squared);
        }
        *strain *= factor;
    }
}

double kiriStrain_Openness(double bending, double twist, double* slope)
{
    const double per = 1.0 / (HALF_TURN * HALF_TURN - OPEN_FOLD * OPEN_FOLD);
    double share = per * (HALF_TURN * HALF_TURN - bending * bending - twist * twist);
    share = share < 0.0 ? 0.0 : kiriMin(share, 1.0);
    *slope = share > 0.0 && share < 1.0 ? -2.0 * per * (1.0 - share) : 0.0;
    return share * (2.0 - share);
}

/* Twist is stiffer than bending at open ends. In a fold bending becomes as stiff as twist, `most` being the ratio of
   their stiffnesses: at half a turn there is no telling one from the other. Were twist to become as weak as bending,
   its energy would fall before half a turn, and folds would stay there. */
static void TakeFold(double most, double twist, double* bending, kiriStrainRow* rows)
{
    double slope, open = kiriStrain_Openness(*bending, twist, &slope);
    if (open < 1.0) {
        double factor = sqrt(most + (1.0 - most) * open * open), per = (1.0 - most) * open * slope / factor;
        if (rows != NULL) {
            ScaleRow(&rows[KIRI_BENDING], factor + 2.0 * per * *bending * *bending);
            AddRow(&rows[KIRI_BENDING], 2.0 * per * *bending * twist, &rows[KIRI_TWIST]);
        }
        *bending *= factor;
    }
}

/* Twisted by t, a strip one region wide shortens by W^2 t^2 / (24 l), for its edges are helices; what these stretch
   beyond the mean is that of the curl, with t^2 - nu b^2 for -nu b^2: see kiri_curl.h. That counts as a larger twist,
   but as none beyond half a turn: with z for what it adds to t^2 and R = pi^2 - t^2 - b^2 it adds z R / sqrt(z^2 +
   R^2), which is z where the angle is small, and never lets the energy fall as it grows. */
static void TakeRibbon(const kiriLink* link, double poissonsRatio, const kiriCurl* curl, double* strain,
                       kiriStrainRow* rows)
{
    double lone = kiriLink_LoneWidth(link), nu = poissonsRatio, bySquare, byQ;
    double b = strain[KIRI_BENDING], t = strain[KIRI_TWIST], open = kiriStrain_Openness(b, t, &bySquare);
    double held = kiriCurl_Held(curl->perSquare * b * b, &byQ), sum = t * t - 2.0 * nu * b * b;
    double stiff = curl->perSquare * lone / ((1.0 - nu) * (link->width + link->outer)), part = stiff * held * sum;
    double z = t * t * part, room = HALF_TURN * HALF_TURN - t * t - b * b;
    double R = kiriMax(room, LEAST_ROOM), per = 1.0 / sqrt(z * z + R * R);
    double factor = sqrt(1.0 + part * R * per), shorter = lone * link->width / (24.0 * link->length);
    strain[KIRI_STRETCH] += shorter * open * t * t;
    strain[KIRI_TWIST] *= factor;
    if (rows != NULL) {
        double byPart = per * per * per * R * R * R, byTwist = -per * per * per * part * part * part * R * t * t;
        double byRoom = room > LEAST_ROOM ? -per * per * per * part * z * z : 0.0;
        double byT = byPart * stiff * held + byTwist + byRoom;
        double byB = byPart * stiff * (curl->perSquare * byQ * sum - 2.0 * nu * held) + byRoom;
        AddRow(&rows[KIRI_STRETCH], 2.0 * shorter * t * (open + bySquare * t * t), &rows[KIRI_TWIST]);
        AddRow(&rows[KIRI_STRETCH], 2.0 * shorter * t * t * bySquare * b, &rows[KIRI_BENDING]);
        ScaleRow(&rows[KIRI_TWIST], factor + t * t * byT / factor);
        AddRow(&rows[KIRI_TWIST], t * b * byB / factor, &rows[KIRI_BENDING]);
    }
}

/* After this bending and twist count as much as their stiffness says. */
static void TakeWidths(const kiriLink* link, const kiriMaterial* material, double* strain, kiriStrainRow* rows)
{
    if (link->outer > 0.0) {
        double nu = (double)material->poissonsRatio, outer = link->outer, inner = link->width - outer;
        double bending = (1.0 - nu) * (inner + (1.0 + nu) * outer) + nu * nu * outer;
        double most = (1.0 - nu) * (inner + 2.0 * outer) / bending;
        kiriCurl curl = kiriCurl_Of(link, material, outer);
        TakeFold(most, strain[KIRI_TWIST], &strain[KIRI_BENDING], rows);
        if (kiriLink_LoneWidth(link) > 0.0) {
            TakeRibbon(link, nu, &curl, strain, rows);
        }
        TakeCurl(&curl, &strain[KIRI_BENDING], rows != NULL ? &rows[KIRI_BENDING] : NULL);
    }
}

void kiriStrain_Measure(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* const frames[2],
                        const kiriPose* const poses[2], double strain[KIRI_STRAINS], kiriStrainRow* rows)
{
    MeanAxes axes;
    TakeMeanAxes(&axes, link, poses, rows != NULL);
    EndVectors b = PointVectors(frames, poses, link->centroid), m = PointVectors(frames, poses, link->crossing);
    EndVectors directors = DirectionVectors(poses[0]->A.d, poses[1]->A.d);
    EndVectors tangents =
        DirectionVectors(kiriPose_Along(poses[0], link->tangent), kiriPose_Along(poses[1], link->tangent));
    MeasureStretch(LeverOf(link, frames), &axes, &b, &strain[KIRI_STRETCH], rows != NULL ? &rows[KIRI_STRETCH] : NULL);
    MeasureNormal(link, &axes, &m, strain, rows);
    strain[KIRI_SHEAR] = kiriVec3_Dot(b.gap, axes.tau);
    strain[KIRI_PLANE_BENDING] = kiriVec3_Dot(tangents.gap, axes.n);
    strain[KIRI_BENDING] = kiriVec3_Dot(directors.gap, axes.n);
    strain[KIRI_TWIST] = kiriVec3_Dot(directors.gap, axes.tau);
    if (rows != NULL) {
        WriteGap(&axes, axes.tau, &b, &rows[KIRI_SHEAR]);
        WriteTurns(&axes, axes.n, &tangents, &rows[KIRI_PLANE_BENDING]);
        WriteTurns(&axes, axes.n, &directors, &rows[KIRI_BENDING]);
        WriteTurns(&axes, axes.tau, &directors, &rows[KIRI_TWIST]);
    }
    TakeAngle(&axes, strain, rows);
    TakeArc(link, frames, strain, rows);
    FadeStrains(&axes, strain, rows);
    TakeWidths(link, material, strain, rows);
}

double kiriStrain_Damping(const double strain[KIRI_STRAINS])
{
    double fold = strain[KIRI_BENDING] * strain[KIRI_BENDING] + strain[KIRI_TWIST] * strain[KIRI_TWIST];
    double share = (HALF_TURN * HALF_TURN - fold) / (HALF_TURN * HALF_TURN - OPEN_FOLD * OPEN_FOLD);
    return share < 0.0 ? 0.0 : kiriMin(share, 1.0);
}

double kiriStrain_NormalGapWidth(const kiriLink* link, double poissonsRatio)
{
    double outer = link->outer, lone = kiriLink_LoneWidth(link), nu = poissonsRatio;
    return GAP_INNER * (link->width - outer) + (1.0 - nu * nu) * (GAP_OUTER * (outer - lone) + lone);
}

void kiriStrain_Stiffness(const kiriLink* link, const kiriMaterial* material, double stiffness[KIRI_STRAINS])
{
    double h = (double)material->thickness, nu = (double)material->poissonsRatio, l = link->length;
    double membrane = (double)material->youngsModulus * h / l, bending = membrane * h * h / (12.0 * (1.0 - nu * nu));
    double outer = link->outer, inner = link->width - outer;
    stiffness[KIRI_STRETCH] = membrane * (inner / (1.0 + nu) + outer);
    stiffness[KIRI_SHEAR] = membrane * (inner + 0.5 * SHEAR_BEAM * outer) / (1.0 + nu);
    stiffness[KIRI_PLANE_BENDING] =
        membrane * link->moment * (1.0 + PLANE_INNER * nu / (1.0 + nu) * inner / link->width);
    stiffness[KIRI_BENDING] = bending * (1.0 - nu) * (inner + (1.0 + nu) * outer);
    stiffness[KIRI_TWIST] = bending * (1.0 - nu) * (inner + 2.0 * outer);
    stiffness[KIRI_NORMAL_GAP] = KIRI_NORMAL_GAP_BETA * bending * kiriStrain_NormalGapWidth(link, nu) / (l * l);
    stiffness[KIRI_NORMAL_STOP] = membrane * link->width;
}
