/* Small vectors, exact orientation, and the moments of an area. Plain + - x / and sqrt: the same bits everywhere. */
#ifndef KIRI_VEC_H
#define KIRI_VEC_H

#include "kiri_base.h"

#include <float.h>
#include <math.h>

KIRI_C_BEGIN

typedef struct kiriVec2 {
    double x, y;
} kiriVec2;

typedef struct kiriVec3 {
    double x, y, z;
} kiriVec3;

/* Columns. For a frame: direction of u, direction of v, director. */
typedef struct kiriMat3 {
    kiriVec3 u, v, d;
} kiriMat3;

/* Initialiser: the axes of space, as a matrix or as three vectors. */
#define KIRI_AXES                                                                                                      \
    {                                                                                                                  \
        { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 },                                                                          \
        {                                                                                                              \
            0.0, 0.0, 1.0                                                                                              \
        }                                                                                                              \
    }

/* A point of the rest plane's lattice. Vertices have even coordinates, grid lines odd ones, so no vertex ever lies on a
   grid line. Coordinates stay within 2^30 of each other: orientations fit 64 bits. */
typedef struct kiriLatticePoint {
    int32_t x, y;
} kiriLatticePoint;

/* Loops over the corners of a triangle. */
#define KIRI_EACH_CORNER(k) KIRI_TIMES(k, 3)

/* Twice the signed area of a, b, c: positive when counter-clockwise. Exact. */
static inline int64_t kiriOrient(kiriLatticePoint a, kiriLatticePoint b, kiriLatticePoint c)
{
    return ((int64_t)b.x - a.x) * ((int64_t)c.y - a.y) - ((int64_t)b.y - a.y) * ((int64_t)c.x - a.x);
}

static inline bool kiriLattice_IsSame(kiriLatticePoint a, kiriLatticePoint b)
{
    return a.x == b.x && a.y == b.y;
}

/* Returns (a - o) (b - o). Exact. */
static inline int64_t kiriLattice_Dot(kiriLatticePoint o, kiriLatticePoint a, kiriLatticePoint b)
{
    return ((int64_t)a.x - o.x) * ((int64_t)b.x - o.x) + ((int64_t)a.y - o.y) * ((int64_t)b.y - o.y);
}

static inline int64_t kiriDistanceSquared(kiriLatticePoint a, kiriLatticePoint b)
{
    int64_t x = (int64_t)b.x - a.x, y = (int64_t)b.y - a.y;
    return x * x + y * y;
}

static inline kiriVec2 kiriVec2_Make(double x, double y)
{
    kiriVec2 r = { x, y };
    return r;
}

static inline kiriVec2 kiriVec2_Add(kiriVec2 a, kiriVec2 b)
{
    return kiriVec2_Make(a.x + b.x, a.y + b.y);
}
static inline kiriVec2 kiriVec2_Sub(kiriVec2 a, kiriVec2 b)
{
    return kiriVec2_Make(a.x - b.x, a.y - b.y);
}
static inline kiriVec2 kiriVec2_Scale(double s, kiriVec2 a)
{
    return kiriVec2_Make(s * a.x, s * a.y);
}
static inline double kiriVec2_Dot(kiriVec2 a, kiriVec2 b)
{
    return a.x * b.x + a.y * b.y;
}
/* Square root of a number that may round below zero; returns 0 then. */
static inline double kiriRoot(double a)
{
    return a > 0.0 ? sqrt(a) : 0.0;
}
/* Returns the angle of a vector (cosine, sine) of any length, from -pi to pi. */
double kiriAngle(double sine, double cosine);

static inline double kiriVec2_Length(kiriVec2 a)
{
    return sqrt(kiriVec2_Dot(a, a));
}

/* Returns the unit vector along a, or 0 for 0. */
static inline kiriVec2 kiriVec2_Normalize(kiriVec2 a)
{
    double length = kiriVec2_Length(a);
    return kiriVec2_Scale(length > 0.0 ? 1.0 / length : 0.0, a);
}

static inline kiriVec2 kiriVec2_AddScaled(kiriVec2 a, double s, kiriVec2 b)
{
    return kiriVec2_Add(a, kiriVec2_Scale(s, b));
}
static inline double kiriVec2_Distance(kiriVec2 a, kiriVec2 b)
{
    return kiriVec2_Length(kiriVec2_Sub(a, b));
}
/* Positive if b is to the left of a. */
static inline double kiriVec2_Cross(kiriVec2 a, kiriVec2 b)
{
    return a.x * b.y - a.y * b.x;
}
/* Turns a to the left by a quarter. */
static inline kiriVec2 kiriVec2_Left(kiriVec2 a)
{
    return kiriVec2_Make(-a.y, a.x);
}

/* Return the place on the segment between a and b that is nearest to p, 0 at a and 1 at b; and its distance from p. */
double kiriVec2_PartOnWay(kiriVec2 p, kiriVec2 a, kiriVec2 b);
double kiriVec2_DistanceToWay(kiriVec2 p, kiriVec2 a, kiriVec2 b);

static inline kiriVec3 kiriVec3_Make(double x, double y, double z)
{
    kiriVec3 r = { x, y, z };
    return r;
}

static inline kiriVec2 kiriVec2_Load(const float* f)
{
    return kiriVec2_Make(f[0], f[1]);
}

static inline void kiriVec2_Store(float* f, kiriVec2 a)
{
    f[0] = (float)a.x;
    f[1] = (float)a.y;
}

static inline kiriVec3 kiriVec3_Load(const float* f)
{
    return kiriVec3_Make(f[0], f[1], f[2]);
}

static inline void kiriVec3_Store(float* f, kiriVec3 a)
{
    f[0] = (float)a.x;
    f[1] = (float)a.y;
    f[2] = (float)a.z;
}

static inline void kiriVec3_StoreDoubles(double* to, kiriVec3 a)
{
    to[0] = a.x;
    to[1] = a.y;
    to[2] = a.z;
}

static inline kiriVec3 kiriVec3_Add(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Make(a.x + b.x, a.y + b.y, a.z + b.z);
}
static inline kiriVec3 kiriVec3_Sub(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Make(a.x - b.x, a.y - b.y, a.z - b.z);
}
static inline kiriVec3 kiriVec3_Scale(double s, kiriVec3 a)
{
    return kiriVec3_Make(s * a.x, s * a.y, s * a.z);
}
static inline kiriVec3 kiriVec3_AddScaled(kiriVec3 a, double s, kiriVec3 b)
{
    return kiriVec3_Add(a, kiriVec3_Scale(s, b));
}
static inline double kiriVec3_Dot(kiriVec3 a, kiriVec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Return the least, and the greatest, of each component. */
static inline kiriVec3 kiriVec3_Least(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Make(kiriMin(a.x, b.x), kiriMin(a.y, b.y), kiriMin(a.z, b.z));
}

static inline kiriVec3 kiriVec3_Most(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Make(kiriMax(a.x, b.x), kiriMax(a.y, b.y), kiriMax(a.z, b.z));
}

/* Returns the part of a vector across a unit vector. */
static inline kiriVec3 kiriVec3_Across(kiriVec3 a, kiriVec3 unit)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, unit), unit);
}

/* Returns an axis of space that is not along a unit vector. */
static inline kiriVec3 kiriVec3_OtherAxis(kiriVec3 unit)
{
    return fabs(unit.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
}

static inline double kiriVec3_Length(kiriVec3 a)
{
    return sqrt(kiriVec3_Dot(a, a));
}

static inline double kiriVec3_Distance(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Length(kiriVec3_Sub(a, b));
}

/* Returns true if the vector rounds to these floats, which the host reads. */
static inline bool kiriVec3_Shows(kiriVec3 a, const float shown[3])
{
    return (float)a.x == shown[0] && (float)a.y == shown[1] && (float)a.z == shown[2];
}
static inline bool kiriVec3_Equal(kiriVec3 a, kiriVec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* Returns true if positions (m) or speeds (m/s, 1/s) are small enough that sums of a few of them fit floats. */
static inline bool kiriVec3_FitsFloats(kiriVec3 a)
{
    const double most = 0.125 * (double)FLT_MAX;
    return fabs(a.x) <= most && fabs(a.y) <= most && fabs(a.z) <= most;
}

static inline kiriVec3 kiriVec3_Cross(kiriVec3 a, kiriVec3 b)
{
    return kiriVec3_Make(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* Returns the unit vector, or zero for the zero vector. */
static inline kiriVec3 kiriVec3_Normalize(kiriVec3 a)
{
    double length = kiriVec3_Length(a);
    return length > 0.0 ? kiriVec3_Scale(1.0 / length, a) : a;
}

static inline bool kiriMat3_Equal(const kiriMat3* a, const kiriMat3* b)
{
    return kiriVec3_Equal(a->u, b->u) && kiriVec3_Equal(a->v, b->v) && kiriVec3_Equal(a->d, b->d);
}

/* Returns true if the matrix rounds to these floats, or equals `given`, the rotation nearest to them. */
static inline bool kiriMat3_Shows(const kiriMat3* m, const kiriMat3* given, const float shown[9])
{
    return (kiriVec3_Shows(m->u, &shown[0]) && kiriVec3_Shows(m->v, &shown[3]) && kiriVec3_Shows(m->d, &shown[6])) ||
           (kiriVec3_Equal(m->u, given->u) && kiriVec3_Equal(m->v, given->v));
}

/* Loads the columns in order. */
static inline kiriMat3 kiriMat3_Load(const float columns[9])
{
    kiriMat3 m = { kiriVec3_Load(&columns[0]), kiriVec3_Load(&columns[3]), kiriVec3_Load(&columns[6]) };
    return m;
}
static inline void kiriMat3_Store(float columns[9], kiriMat3 m)
{
    kiriVec3_Store(&columns[0], m.u);
    kiriVec3_Store(&columns[3], m.v);
    kiriVec3_Store(&columns[6], m.d);
}

static inline kiriVec3 kiriMat3_Mul(kiriMat3 m, kiriVec3 a)
{
    return kiriVec3_AddScaled(kiriVec3_AddScaled(kiriVec3_Scale(a.x, m.u), a.y, m.v), a.z, m.d);
}

/* Returns the transposed matrix times a vector. */
static inline kiriVec3 kiriMat3_MulTransposed(const kiriMat3* m, kiriVec3 a)
{
    return kiriVec3_Make(kiriVec3_Dot(m->u, a), kiriVec3_Dot(m->v, a), kiriVec3_Dot(m->d, a));
}

static inline kiriMat3 kiriMat3_MulMat(kiriMat3 m, kiriMat3 n)
{
    kiriMat3 r = { kiriMat3_Mul(m, n.u), kiriMat3_Mul(m, n.v), kiriMat3_Mul(m, n.d) };
    return r;
}

/* A + s B, and s A. */
kiriMat3 kiriMat3_AddScaled(const kiriMat3* A, double s, const kiriMat3* B);
kiriMat3 kiriMat3_Scale(double s, const kiriMat3* A);

/* Returns the rotation of a rotation vector by the Cayley map, by the angle 2 atan(|w| / 2). Exact, no trigonometry. */
kiriMat3 kiriMat3_Cayley(kiriVec3 w);

/* Returns the rotation nearest to m (its polar factor); for a singular m any rotation near it. */
kiriMat3 kiriMat3_Rotation(kiriMat3 m);

/* Likewise, starting from a rotation near m. Where m hardly determines the rotation, keeps the start. */
kiriMat3 kiriMat3_RotationFrom(kiriMat3 start, kiriMat3 m);

/* Moments of an area of material about the origin of the rest coordinates: integrals of 1, u, v, u^2, u v, v^2. */
typedef struct kiriMoments {
    double area, u, v, uu, uv, vv;
} kiriMoments;

/* Returns the moments of a counter-clockwise triangle. */
kiriMoments kiriMoments_Triangle(kiriVec2 a, kiriVec2 b, kiriVec2 c);
void kiriMoments_Add(kiriMoments* sum, const kiriMoments* part);

/* Returns the centroid. The area must be above zero. */
kiriVec2 kiriMoments_Center(const kiriMoments* m);

/* Returns the moments about another origin. */
kiriMoments kiriMoments_About(const kiriMoments* m, kiriVec2 origin);

/* Run-time checks of float arithmetic that no macro reports, such as clang's -ffp-contract=fast, which ignores pragmas.
   See kiri_float.h. */

/* Returns true if each operation is rounded separately, in source order. */
bool kiriExact_AreFloats(void);

/* Returns true if this thread has the default float mode: rounding to nearest, and denormals not flushed to zero. */
bool kiriExact_IsModePlain(void);

/* Exact sums: independent of order, and parts can be subtracted again. So the mass of a region can be updated without a
   walk over its cells when one of them changes. */

/* A fixed-point fraction of a scale: high * 2^-60 + low * 2^-122, with 0 <= low < 2^62, so the form is unique. A sliver
   of 1e-14 of a square, in a grid of 4096 squares, keeps all digits of its double. */
typedef struct kiriExact {
    int64_t high, low;
} kiriExact;

/* Moments of material, in the order of kiriMoments; coordinates are at most `extent` (m, local). */
typedef struct kiriTally {
    kiriExact of[6];
} kiriTally;

/* Adds (sign 1) or subtracts (-1) moments. The total area is at most 7 extent^2 at any time. */
void kiriTally_Add(kiriTally* tally, const kiriMoments* moments, int sign, double extent);
kiriMoments kiriTally_Moments(const kiriTally* tally, double extent);

KIRI_C_END

#endif
