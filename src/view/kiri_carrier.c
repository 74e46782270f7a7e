#include "kiri_carrier.h"

#include <string.h>

static int32_t CarrierCount(const kiriIndices* list, int32_t count)
{
    return list != NULL ? list->count : count;
}

static int32_t CarrierAt(const kiriIndices* list, int32_t n)
{
    return list != NULL ? list->data[n] : n;
}

void kiriCarriers_Write(kiriCarrier* carriers, const kiriFrameData* frames, int32_t count, const kiriIndices* some)
{
    for (int32_t n = 0; n < CarrierCount(some, count); ++n) {
        int32_t i = CarrierAt(some, n);
        kiriCarrier* carrier = &carriers[i];
        memset(carrier, 0, sizeof(*carrier));
        carrier->u = frames[i].A.u;
        carrier->v = frames[i].A.v;
        carrier->x = frames[i].x;
        carrier->center = frames[i].center;
        carrier->six = 6.0;
        carrier->d = kiriVec3_Normalize(kiriVec3_Cross(carrier->u, carrier->v));
    }
}

/* ---- Curvature ----

   In a flat patch the surface bulges: half-way between two frames that stand at an angle t on a cylinder of radius R,
   both patches are R t^2 / 8 outside. So the patch of a frame follows the arc that its neighbours' directors tell. Be K
   the curvature, g = K q and f^2 = g . g: the patch goes from q to q sin f / f in the plane, and up by
   q . g (1 - cos f) / f^2. That is exact for one direction of bending, which is what thin sheets have, and right to the
   second order elsewhere.

   A frame that stretches by s has arcs s times as long for the same angles: K and six, divided by s^2, say so. */

/* The angle, of which this is the cosine, over its sine: Pade's [4/4] of the half-angle's arc tangent, 0.7 % off at 120
   degrees. Never above 8: frames back to back tell nothing. */
static double AngleOverSine(double cosine)
{
    double lower = kiriMax(1.0 + cosine, 0.1), x = (2.0 - lower) / lower;
    double angle = (945.0 + x * (735.0 + 64.0 * x)) / (945.0 + x * (1050.0 + 225.0 * x));
    return angle * (1.0 + x);
}

/* How the director of `other` leans, seen from a frame, where it is s away. */
static void AddDirectorTurn(kiriBend* bend, const kiriCarrier* carrier, kiriVec3 other, kiriVec2 s, double weight)
{
    double k = -weight * AngleOverSine(kiriVec3_Dot(carrier->d, other));
    double tu = k * kiriVec3_Dot(carrier->u, other), tv = k * kiriVec3_Dot(carrier->v, other);
    bend->uu += weight * s.x * s.x;
    bend->uv += weight * s.x * s.y;
    bend->vv += weight * s.y * s.y;
    bend->ruu += s.x * tu;
    bend->ruv += s.y * tu + s.x * tv;
    bend->rvv += s.y * tv;
}

/* The symmetric K that best takes each way s to its lean; where the neighbours, all in a row, leave it open, the least.
   That share, a thousandth, also says how far K may follow the noise across a row. */
static void Curve(kiriCarrier* carrier, const kiriBend* bend)
{
    double least = 1e-3 * (bend->uu + bend->vv), m = bend->uv;
    double a = bend->uu + least, c = bend->vv + least, b = bend->uu + bend->vv + 2.0 * least;
    double det = a * (b * c - m * m) - m * m * c;
    double square = kiriVec3_Length(kiriVec3_Cross(carrier->u, carrier->v));
    /* A patch that is nearly a line, or is stretched 1e12 times, stays flat: floats cannot hold `six`. */
    if (!(det > 0.0 && square > 1e-24 && square < 1e24)) {
        return;
    }
    double scale = 1.0 / (square * det);
    carrier->six = 6.0 / square;
    carrier->uu = scale * ((b * c - m * m) * bend->ruu - m * c * bend->ruv + m * m * bend->rvv);
    carrier->uv = scale * (-m * c * bend->ruu + a * c * bend->ruv - a * m * bend->rvv);
    carrier->vv = scale * (m * m * bend->ruu - a * m * bend->ruv + (a * b - m * m) * bend->rvv);
}

/* rad: rms of the angle by which a patch may turn over its region. On an arc that is 40 degrees from frame to frame. */
static const double mostTurn = 0.2;

/* Where neighbours turn farther, they do not tell how the region bends: there are creases, narrow bridges, and
   neighbours on both sides of a slit that bend apart. A patch that is less bent is strained less there. */
static void LimitCurve(kiriCarrier* carrier, const kiriFrameData* frame)
{
    double uu = carrier->uu, uv = carrier->uv, vv = carrier->vv;
    const double* m = frame->inertia;
    double square = (uu * uu + uv * uv) * m[0] + 2.0 * uv * (uu + vv) * m[1] + (uv * uv + vv * vv) * m[2];
    double turn = frame->mass > 0.0 && square > 0.0 ? sqrt(6.0 * square / (carrier->six * frame->mass)) : 0.0;
    if (turn > mostTurn) {
        carrier->uu *= mostTurn / turn;
        carrier->uv *= mostTurn / turn;
        carrier->vv *= mostTurn / turn;
    }
}

void kiriCarriers_Bend(kiriCarrier* carriers, kiriBend* bends, const kiriFrameData* frames, int32_t count,
                       const kiriLink* links, int32_t linkCount, const kiriIndices* some, const kiriIndices* someLinks)
{
    for (int32_t n = 0; n < CarrierCount(some, count); ++n) {
        memset(&bends[CarrierAt(some, n)], 0, sizeof(kiriBend));
    }
    for (int32_t n = 0; n < CarrierCount(someLinks, linkCount) && CarrierAt(someLinks, n) < linkCount; ++n) {
        const kiriLink* link = &links[CarrierAt(someLinks, n)];
        kiriCarrier *i = &carriers[link->i], *j = &carriers[link->j];
        kiriVec2 start = kiriVec2_Sub(frames[link->i].site.at, frames[link->i].center);
        kiriVec2 end = kiriVec2_Sub(frames[link->j].center, frames[link->j].site.at);
        kiriVec2 way = kiriVec2_Add(kiriVec2_Add(start, link->span), end); /* from centre to centre */
        AddDirectorTurn(&bends[link->i], i, j->d, way, link->width);
        AddDirectorTurn(&bends[link->j], j, i->d, kiriVec2_Scale(-1.0, way), link->width);
    }
    for (int32_t n = 0; n < CarrierCount(some, count); ++n) {
        int32_t i = CarrierAt(some, n);
        Curve(&carriers[i], &bends[i]);
        LimitCurve(&carriers[i], &frames[i]);
    }
}
