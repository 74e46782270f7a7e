#include "kiri_vec.h"
#include "kiri_lanes.h"

#include <float.h>

double kiriVec2_PartOnWay(kiriVec2 p, kiriVec2 a, kiriVec2 b)
{
    kiriVec2 way = kiriVec2_Sub(b, a);
    double square = kiriVec2_Dot(way, way), part = square > 0.0 ? kiriVec2_Dot(kiriVec2_Sub(p, a), way) / square : 0.0;
    return kiriClamp(part, 0.0, 1.0);
}

double kiriVec2_DistanceToWay(kiriVec2 p, kiriVec2 a, kiriVec2 b)
{
    return kiriVec2_Distance(kiriVec2_Sub(p, a), kiriVec2_Scale(kiriVec2_PartOnWay(p, a, b), kiriVec2_Sub(b, a)));
}

double kiriAngle(double sine, double cosine)
{
    double length = sqrt(sine * sine + cosine * cosine), sum = 0.0;
    double t = length > 0.0 ? sine / (length + fabs(cosine)) : 0.0;
    KIRI_TIMES(k, 2) { /* t is the tangent of half the angle, then of a quarter and of an eighth */
        t /= 1.0 + sqrt(1.0 + t * t);
    }
    for (int n = 15; n > 0; n -= 2) {
        sum = 1.0 / n - t * t * sum;
    }
    double angle = 8.0 * t * sum;
    return cosine >= 0.0 ? angle : (sine < 0.0 ? -3.14159265358979324 : 3.14159265358979324) - angle;
}

kiriMat3 kiriMat3_AddScaled(const kiriMat3* A, double s, const kiriMat3* B)
{
    kiriMat3 r = { kiriVec3_AddScaled(A->u, s, B->u), kiriVec3_AddScaled(A->v, s, B->v),
                   kiriVec3_AddScaled(A->d, s, B->d) };
    return r;
}

kiriMat3 kiriMat3_Scale(double s, const kiriMat3* A)
{
    kiriMat3 r = { kiriVec3_Scale(s, A->u), kiriVec3_Scale(s, A->v), kiriVec3_Scale(s, A->d) };
    return r;
}

kiriMat3 kiriMat3_Cayley(kiriVec3 w)
{
    /* (I - K/2)^-1 (I + K/2) with K the cross product with w: I + (K + K K / 2) / (1 + |w|^2 / 4) */
    double s = 1.0 / (1.0 + 0.25 * kiriVec3_Dot(w, w)), h = 0.5 * s;
    double xx = h * w.x * w.x, yy = h * w.y * w.y, zz = h * w.z * w.z;
    double xy = h * w.x * w.y, yz = h * w.y * w.z, zx = h * w.z * w.x;
    kiriMat3 r;
    r.u = kiriVec3_Make(1.0 - yy - zz, xy + s * w.z, zx - s * w.y);
    r.v = kiriVec3_Make(xy - s * w.z, 1.0 - zz - xx, yz + s * w.x);
    r.d = kiriVec3_Make(zx + s * w.y, yz - s * w.x, 1.0 - xx - yy);
    return r;
}

/* Gram-Schmidt. Axes that a singular m leaves open are chosen. */
static kiriMat3 Orthonormal(kiriMat3 m)
{
    kiriMat3 r = KIRI_AXES;
    double lu = kiriVec3_Length(m.u), lv = kiriVec3_Length(m.v);
    if (lu > 0.0) {
        r.u = kiriVec3_Scale(1.0 / lu, m.u);
    }
    kiriVec3 v = kiriVec3_AddScaled(m.v, -kiriVec3_Dot(r.u, m.v), r.u);
    if (!(kiriVec3_Length(v) > 1e-9 * lv)) {
        kiriVec3 axis = kiriVec3_OtherAxis(r.u);
        v = kiriVec3_AddScaled(axis, -kiriVec3_Dot(r.u, axis), r.u);
    }
    r.v = kiriVec3_Normalize(v);
    r.d = kiriVec3_Cross(r.u, r.v);
    return r;
}

/* (trace(P) I - P)^-1 t with P the symmetric part of m r^T; t itself over the trace where that is not positive. */
static kiriVec3 NewtonTurn(kiriMat3 r, kiriMat3 m, kiriVec3 t, double along)
{
    double xx = r.u.x * m.u.x + r.v.x * m.v.x + r.d.x * m.d.x, yy = r.u.y * m.u.y + r.v.y * m.v.y + r.d.y * m.d.y;
    double zz = r.u.z * m.u.z + r.v.z * m.v.z + r.d.z * m.d.z;
    double xy = 0.5 * (r.u.x * m.u.y + r.v.x * m.v.y + r.d.x * m.d.y + r.u.y * m.u.x + r.v.y * m.v.x + r.d.y * m.d.x);
    double yz = 0.5 * (r.u.y * m.u.z + r.v.y * m.v.z + r.d.y * m.d.z + r.u.z * m.u.y + r.v.z * m.v.y + r.d.z * m.d.y);
    double zx = 0.5 * (r.u.z * m.u.x + r.v.z * m.v.x + r.d.z * m.d.x + r.u.x * m.u.z + r.v.x * m.v.z + r.d.x * m.d.z);
    kiriVec3 a = { yy + zz, -xy, -zx }, b = { -xy, zz + xx, -yz }, c = { -zx, -yz, xx + yy };
    kiriVec3 bc = kiriVec3_Cross(b, c);
    double det = kiriVec3_Dot(a, bc), s = fabs(along);
    if (!(a.x > 1e-6 * s && a.x * b.y - xy * xy > 1e-6 * s * s && det > 1e-6 * s * s * s)) {
        return kiriVec3_Scale(1.0 / (s + 1e-300), t);
    }
    kiriVec3 w = { kiriVec3_Dot(t, bc), kiriVec3_Dot(t, kiriVec3_Cross(c, a)), kiriVec3_Dot(t, kiriVec3_Cross(a, b)) };
    return kiriVec3_Scale(1.0 / det, w);
}

kiriMat3 kiriMat3_RotationFrom(kiriMat3 start, kiriMat3 m)
{
    kiriMat3 r = start;
    KIRI_TIMES(iteration, 40) {
        kiriVec3 turn =
            kiriVec3_Add(kiriVec3_Add(kiriVec3_Cross(r.u, m.u), kiriVec3_Cross(r.v, m.v)), kiriVec3_Cross(r.d, m.d));
        double along = fabs(kiriVec3_Dot(r.u, m.u) + kiriVec3_Dot(r.v, m.v) + kiriVec3_Dot(r.d, m.d));
        if (!(kiriVec3_Length(turn) > 1e-14 * along)) {
            break;
        }
        r = kiriMat3_MulMat(kiriMat3_Cayley(NewtonTurn(r, m, turn, along)), r);
    }
    return Orthonormal(r);
}

kiriMat3 kiriMat3_Rotation(kiriMat3 m)
{
    return kiriMat3_RotationFrom(Orthonormal(m), m);
}

kiriMoments kiriMoments_Triangle(kiriVec2 a, kiriVec2 b, kiriVec2 c)
{
    kiriVec2 ab = kiriVec2_Sub(b, a), ac = kiriVec2_Sub(c, a);
    kiriVec2 sum = kiriVec2_Add(kiriVec2_Add(a, b), c);
    double area = 0.5 * (ab.x * ac.y - ab.y * ac.x), k = area / 12.0;
    kiriMoments m;
    m.area = area;
    m.u = area * sum.x / 3.0;
    m.v = area * sum.y / 3.0;
    m.uu = k * (a.x * a.x + b.x * b.x + c.x * c.x + sum.x * sum.x);
    m.uv = k * (a.x * a.y + b.x * b.y + c.x * c.y + sum.x * sum.y);
    m.vv = k * (a.y * a.y + b.y * b.y + c.y * c.y + sum.y * sum.y);
    return m;
}

void kiriMoments_Add(kiriMoments* sum, const kiriMoments* part)
{
    sum->area += part->area;
    sum->u += part->u;
    sum->v += part->v;
    sum->uu += part->uu;
    sum->uv += part->uv;
    sum->vv += part->vv;
}

kiriVec2 kiriMoments_Center(const kiriMoments* m)
{
    return m->area > 0.0 ? kiriVec2_Make(m->u / m->area, m->v / m->area) : kiriVec2_Make(0.0, 0.0);
}

kiriMoments kiriMoments_About(const kiriMoments* m, kiriVec2 o)
{
    kiriMoments r = *m;
    r.u = m->u - o.x * m->area;
    r.v = m->v - o.y * m->area;
    r.uu = m->uu - 2.0 * o.x * m->u + o.x * o.x * m->area;
    r.uv = m->uv - o.x * m->v - o.y * m->u + o.x * o.y * m->area;
    r.vv = m->vv - 2.0 * o.y * m->v + o.y * o.y * m->area;
    r.uu = kiriMax(r.uu, 0.0);
    r.vv = kiriMax(r.vv, 0.0);
    return r;
}

/* Volatile values keep the compiler from computing these tests by itself. */

bool kiriExact_AreFloats(void)
{
    volatile double a = 1.0 + DBL_EPSILON, c = -(1.0 + 2.0 * DBL_EPSILON);
    volatile double large = 2.0 / DBL_EPSILON, small = 1.0, three = 3.0, five = 5.0;
    volatile float f = 1.0f + FLT_EPSILON, g = -(1.0f + 2.0f * FLT_EPSILON);
    double d = a, e = c, l = large, s = small, x = five, y = three;
    float h = f, k = g, sums[4];
    kiriLanes lanes = kiriLanes_Splat(h);
    kiriLanes_Store(sums, kiriLanes_Add(kiriLanes_Mul(lanes, lanes), kiriLanes_Splat(k)));
    /* a a + c is 0 if a a is rounded, else the rounding error. */
    bool isRounded = d * d + e == 0.0 && h * h + k == 0.0f && sums[0] == 0.0f && sums[1] == 0.0f && sums[2] == 0.0f &&
                     sums[3] == 0.0f;
    /* Sums go from left to right, and x / y differs from x times 1 / y. */
    volatile double inverse = 1.0 / y;
    return isRounded && s + l - l == 0.0 && x / y != x * inverse;
}

bool kiriExact_IsModePlain(void)
{
    volatile double least = DBL_MIN, half = 0.5 * DBL_MIN, one = 1.0, less = 0.25 * DBL_EPSILON,
                    more = 0.75 * DBL_EPSILON;
    volatile float leastFloat = FLT_MIN, halfFloat = 0.5f * FLT_MIN;
    double d = least, e = half, a = one, b = less, c = more;
    float f = leastFloat, g = halfFloat;
    /* Half of the least normal number is not 0, and doubles again. */
    bool isSmallKept = 0.5 * d > 0.0 && 2.0 * e == d && 0.5f * f > 0.0f && 2.0f * g == f;
    return isSmallKept && a + b == a && a + c > a && -a - b == -a && -a - c < -a;
}

/* ---- Exact sums -------------------------------------------------------------------------------------------------- */

static const int64_t lowRange = (int64_t)1 << 62;
static const double highUnits = 1152921504606846976.0; /* 2^60 */
static const double lowUnits = 4611686018427387904.0;  /* 2^62 */

static double ToShare(kiriExact sum)
{
    return ((double)sum.high + (double)sum.low / lowUnits) / highUnits;
}

void kiriTally_Add(kiriTally* tally, const kiriMoments* moments, int sign, double extent)
{
    KIRI_ASSERT((sign == 1 || sign == -1) && extent > 0.0);
    double one = 1.0 / extent, two = one * one, three = two * one, four = two * two;
    const double shares[6] = { two * moments->area, three * moments->u, three * moments->v,
                               four * moments->uu,  four * moments->uv, four * moments->vv };
    KIRI_TIMES(k, 6) { /* whole numbers are rounded in the same way when they are added and when they are subtracted */
        kiriExact* sum = &tally->of[k];
        double scaled = shares[k] * highUnits;
        int64_t high = (int64_t)scaled;
        int64_t low = (int64_t)((scaled - (double)high) * lowUnits);
        sum->low += sign * low;
        /* -1, 0 or 1: at random, so without a branch. */
        int64_t carry = (int64_t)(((uint64_t)sum->low + (uint64_t)lowRange) >> 62) - 1;
        sum->high += sign * high + carry;
        sum->low -= carry * lowRange;
    }
}

kiriMoments kiriTally_Moments(const kiriTally* tally, double extent)
{
    double two = extent * extent, three = two * extent, four = two * two;
    kiriMoments moments = { two * ToShare(tally->of[0]),  three * ToShare(tally->of[1]), three * ToShare(tally->of[2]),
                            four * ToShare(tally->of[3]), four * ToShare(tally->of[4]),  four * ToShare(tally->of[5]) };
    return moments;
}
