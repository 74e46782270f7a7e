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
