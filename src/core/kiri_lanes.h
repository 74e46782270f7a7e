/* Four floats at a time: SSE2, NEON or plain C. Each operation is rounded separately, so all three give the same bits.
   KIRI_PLAIN_LANES selects plain C; tests/test_base.c compares. */
#ifndef KIRI_LANES_H
#define KIRI_LANES_H

#include "kiri_base.h"

#include <math.h>

#if defined(KIRI_PLAIN_LANES)
#elif defined(__SSE2__) || defined(_M_X64)
#define KIRI_SSE2_LANES
#include <emmintrin.h>
#elif defined(__aarch64__) && defined(__ARM_NEON)
#define KIRI_NEON_LANES
#include <arm_neon.h>
#endif

KIRI_C_BEGIN

#if defined(KIRI_SSE2_LANES)

typedef __m128 kiriLanes;

#define kiriLanes_Four _mm_setr_ps
#define kiriLanes_Load _mm_loadu_ps
#define kiriLanes_Store _mm_storeu_ps
#define kiriLanes_Splat _mm_set1_ps
#define kiriLanes_Add _mm_add_ps
#define kiriLanes_Sub _mm_sub_ps
#define kiriLanes_Mul _mm_mul_ps
#define kiriLanes_Div _mm_div_ps
#define kiriLanes_Sqrt _mm_sqrt_ps
#define kiriLanes_Max _mm_max_ps /* of numbers */
/* Loads two floats, then two others. */
static inline kiriLanes kiriLanes_LoadTwice(const float* two, const float* others)
{
    return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64((const __m128i*)two)), (const __m64*)others);
}
static inline void kiriLanes_StoreThree(float* three, kiriLanes a)
{
    _mm_storel_pi((__m64*)three, a);
    _mm_store_ss(three + 2, _mm_movehl_ps(a, a));
}
/* Four lanes of a. */
#define kiriLanes_Pick(a, i, j, k, l) _mm_shuffle_ps((a), (a), _MM_SHUFFLE(l, k, j, i))
/* Two lanes of a, then two of b. */
#define kiriLanes_Join(a, i, j, b, k, l) _mm_shuffle_ps((a), (b), _MM_SHUFFLE(l, k, j, i))

#elif defined(KIRI_NEON_LANES)

typedef float32x4_t kiriLanes;

#define kiriLanes_Load vld1q_f32
#define kiriLanes_Store vst1q_f32
#define kiriLanes_Splat vdupq_n_f32
#define kiriLanes_Add vaddq_f32
#define kiriLanes_Sub vsubq_f32
#define kiriLanes_Mul vmulq_f32
#define kiriLanes_Div vdivq_f32
#define kiriLanes_Sqrt vsqrtq_f32
#define kiriLanes_Max vmaxq_f32
static inline kiriLanes kiriLanes_LoadTwice(const float* two, const float* others)
{
    return vcombine_f32(vld1_f32(two), vld1_f32(others));
}
static inline void kiriLanes_StoreThree(float* three, kiriLanes a)
{
    vst1_f32(three, vget_low_f32(a));
    vst1q_lane_f32(three + 2, a, 2);
}
static inline kiriLanes kiriLanes_Four(float i, float j, float k, float l)
{
    const float four[4] = { i, j, k, l };
    return vld1q_f32(four);
}
#define kiriLanes_Pick(a, i, j, k, l) kiriLanes_Join(a, i, j, a, k, l)
#define kiriLanes_Join(a, i, j, b, k, l)                                                                               \
    kiriLanes_Four(vgetq_lane_f32(a, i), vgetq_lane_f32(a, j), vgetq_lane_f32(b, k), vgetq_lane_f32(b, l))

#else

typedef struct kiriLanes {
    float at[4];
} kiriLanes;

static inline kiriLanes kiriLanes_Four(float i, float j, float k, float l)
{
    kiriLanes r = { { i, j, k, l } };
    return r;
}
static inline kiriLanes kiriLanes_Load(const float* four)
{
    return kiriLanes_Four(four[0], four[1], four[2], four[3]);
}
static inline void kiriLanes_Store(float* four, kiriLanes a)
{
    KIRI_TIMES(k, 4) {
        four[k] = a.at[k];
    }
}
static inline kiriLanes kiriLanes_Splat(float a)
{
    return kiriLanes_Four(a, a, a, a);
}
#define KIRI_LANES_OPERATION(name, sign)                                                                               \
    static inline kiriLanes name(kiriLanes a, kiriLanes b)                                                             \
    {                                                                                                                  \
        return kiriLanes_Four(a.at[0] sign b.at[0], a.at[1] sign b.at[1], a.at[2] sign b.at[2], a.at[3] sign b.at[3]); \
    }
KIRI_LANES_OPERATION(kiriLanes_Add, +)
KIRI_LANES_OPERATION(kiriLanes_Sub, -)
KIRI_LANES_OPERATION(kiriLanes_Mul, *)
KIRI_LANES_OPERATION(kiriLanes_Div, /)
static inline kiriLanes kiriLanes_Sqrt(kiriLanes a)
{
    return kiriLanes_Four(sqrtf(a.at[0]), sqrtf(a.at[1]), sqrtf(a.at[2]), sqrtf(a.at[3]));
}
static inline kiriLanes kiriLanes_Max(kiriLanes a, kiriLanes b)
{
    return kiriLanes_Four(kiriMax(a.at[0], b.at[0]), kiriMax(a.at[1], b.at[1]), kiriMax(a.at[2], b.at[2]),
                          kiriMax(a.at[3], b.at[3]));
}
static inline kiriLanes kiriLanes_LoadTwice(const float* two, const float* others)
{
    return kiriLanes_Four(two[0], two[1], others[0], others[1]);
}
static inline void kiriLanes_StoreThree(float* three, kiriLanes a)
{
    KIRI_TIMES(k, 3) {
        three[k] = a.at[k];
    }
}
#define kiriLanes_Pick(a, i, j, k, l) kiriLanes_Join(a, i, j, a, k, l)
#define kiriLanes_Join(a, i, j, b, k, l) kiriLanes_Four((a).at[i], (a).at[j], (b).at[k], (b).at[l])

#endif

/* Returns x, y and z of a cross product. */
static inline kiriLanes kiriLanes_Cross(kiriLanes a, kiriLanes b)
{
    kiriLanes c =
        kiriLanes_Sub(kiriLanes_Mul(a, kiriLanes_Pick(b, 1, 2, 0, 3)), kiriLanes_Mul(kiriLanes_Pick(a, 1, 2, 0, 3), b));
    return kiriLanes_Pick(c, 1, 2, 0, 3);
}

KIRI_C_END

#endif
