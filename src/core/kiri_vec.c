#include "kiri_vec.h"

double kiriVec2_DistanceToWay(kiriVec2 p, kiriVec2 a, kiriVec2 b)
{
    kiriVec2 way = kiriVec2_Sub(b, a), to = kiriVec2_Sub(p, a);
    double square = kiriVec2_Dot(way, way), t = square > 0.0 ? kiriVec2_Dot(to, way) / square : 0.0;
    t = kiriClamp(t, 0.0, 1.0);
    return kiriVec2_Length(kiriVec2_Sub(to, kiriVec2_Scale(t, way)));
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

/* Gram-Schmidt, with axes of its own where m is singular. */
static kiriMat3 Orthonormal(kiriMat3 m)
{
    kiriMat3 r = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    double lu = kiriVec3_Length(m.u), lv = kiriVec3_Length(m.v);
    if (lu > 0.0) {
        r.u = kiriVec3_Scale(1.0 / lu, m.u);
    }
    kiriVec3 v = kiriVec3_AddScaled(m.v, -kiriVec3_Dot(r.u, m.v), r.u);
    if (!(kiriVec3_Length(v) > 1e-9 * lv)) {
        kiriVec3 axis = fabs(r.u.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
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
    for (int iteration = 0; iteration < 40; ++iteration) {
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
