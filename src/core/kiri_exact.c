#include "kiri_exact.h"

#include "kiri_lanes.h"

#include <float.h>

/* What is volatile is not known to the compiler, which would compute it by itself, without the processor's
   instructions. */

/* a b + c is zero where a b is rounded, and what was rounded off where it is not. */
static bool IsProductRounded(void)
{
    volatile double a = 1.0 + DBL_EPSILON, c = -(1.0 + 2.0 * DBL_EPSILON);
    volatile float f = 1.0f + FLT_EPSILON, g = -(1.0f + 2.0f * FLT_EPSILON);
    double d = a, e = c;
    float h = f, k = g;
    return d * d + e == 0.0 && h * h + k == 0.0f;
}

static bool AreLanesRounded(void)
{
    volatile float f = 1.0f + FLT_EPSILON, g = -(1.0f + 2.0f * FLT_EPSILON);
    kiriLanes lanes = kiriLanes_Splat(f);
    float sums[4];
    kiriLanes_Store(sums, kiriLanes_Add(kiriLanes_Mul(lanes, lanes), kiriLanes_Splat(g)));
    return sums[0] == 0.0f && sums[1] == 0.0f && sums[2] == 0.0f && sums[3] == 0.0f;
}

/* Sums go from left to right, and x / y is no x times 1 / y. */
static bool IsOrderKept(void)
{
    volatile double large = 2.0 / DBL_EPSILON, small = 1.0, three = 3.0, five = 5.0;
    double l = large, s = small, x = five, y = three;
    volatile double inverse = 1.0 / y;
    return s + l - l == 0.0 && x / y != x * inverse;
}

bool kiriExact_AreFloats(void)
{
    return IsProductRounded() && AreLanesRounded() && IsOrderKept();
}

/* The least normal number halves, and the half doubles again, which it does not where it is read as zero. */
static bool AreSmallKept(void)
{
    volatile double least = DBL_MIN, half = 0.5 * DBL_MIN;
    volatile float leastFloat = FLT_MIN, halfFloat = 0.5f * FLT_MIN;
    double d = least, e = half;
    float f = leastFloat, g = halfFloat;
    return 0.5 * d > 0.0 && 2.0 * e == d && 0.5f * f > 0.0f && 2.0f * g == f;
}

static bool AreNearest(void)
{
    volatile double one = 1.0, less = 0.25 * DBL_EPSILON, more = 0.75 * DBL_EPSILON;
    double a = one, b = less, c = more;
    return a + b == a && a + c > a && -a - b == -a && -a - c < -a;
}

bool kiriExact_IsModePlain(void)
{
    return AreSmallKept() && AreNearest();
}
