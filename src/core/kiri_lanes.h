/* Four floats at a time: SSE2, NEON or plain C. Each operation is rounded by itself, so all three give the same bits.
   With KIRI_PLAIN_LANES it is plain C everywhere; tests/test_lanes.c compares. */
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

static inline kiriLanes kiriLanes_Four(float i, float j, float k, float l)
{
    return _mm_setr_ps(i, j, k, l);
}
static inline kiriLanes kiriLanes_Load(const float* four)
{
    return _mm_loadu_ps(four);
}
static inline void kiriLanes_Store(float* four, kiriLanes a)
{
    _mm_storeu_ps(four, a);
}
static inline kiriLanes kiriLanes_Splat(float a)
{
    return _mm_set1_ps(a);
}
static inline kiriLanes kiriLanes_Add(kiriLanes a, kiriLanes b)
{
    return _mm_add_ps(a, b);
}
static inline kiriLanes kiriLanes_Sub(kiriLanes a, kiriLanes b)
{
    return _mm_sub_ps(a, b);
}
static inline kiriLanes kiriLanes_Mul(kiriLanes a, kiriLanes b)
{
    return _mm_mul_ps(a, b);
}
static inline kiriLanes kiriLanes_Div(kiriLanes a, kiriLanes b)
{
    return _mm_div_ps(a, b);
}
static inline kiriLanes kiriLanes_Sqrt(kiriLanes a)
{
    return _mm_sqrt_ps(a);
}
/* Two floats, then two others. */
static inline kiriLanes kiriLanes_LoadTwice(const float* two, const float* others)
{
    return _mm_loadh_pi(_mm_castsi128_ps(_mm_loadl_epi64((const __m128i*)two)), (const __m64*)others);
}
static inline void kiriLanes_StoreThree(float* three, kiriLanes a)
{
    _mm_storel_pi((__m64*)three, a);
    _mm_store_ss(three + 2, _mm_movehl_ps(a, a));
}
/* The lanes of a that are named. */
#define kiriLanes_Pick(a, i, j, k, l) _mm_shuffle_ps((a), (a), _MM_SHUFFLE(l, k, j, i))
/* Two lanes of a, then two of b. */
#define kiriLanes_Join(a, i, j, b, k, l) _mm_shuffle_ps((a), (b), _MM_SHUFFLE(l, k, j, i))

#elif defined(KIRI_NEON_LANES)

typedef float32x4_t kiriLanes;

static inline kiriLanes kiriLanes_Load(const float* four)
{
    return vld1q_f32(four);
}
static inline void kiriLanes_Store(float* four, kiriLanes a)
{
    vst1q_f32(four, a);
}
static inline kiriLanes kiriLanes_Splat(float a)
{
    return vdupq_n_f32(a);
}
static inline kiriLanes kiriLanes_Add(kiriLanes a, kiriLanes b)
{
    return vaddq_f32(a, b);
}
static inline kiriLanes kiriLanes_Sub(kiriLanes a, kiriLanes b)
{
    return vsubq_f32(a, b);
}
static inline kiriLanes kiriLanes_Mul(kiriLanes a, kiriLanes b)
{
    return vmulq_f32(a, b);
}
static inline kiriLanes kiriLanes_Div(kiriLanes a, kiriLanes b)
{
    return vdivq_f32(a, b);
}
static inline kiriLanes kiriLanes_Sqrt(kiriLanes a)
{
    return vsqrtq_f32(a);
}
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
#define kiriLanes_Pick(a, i, j, k, l)                                                                                  \
    kiriLanes_Four(vgetq_lane_f32(a, i), vgetq_lane_f32(a, j), vgetq_lane_f32(a, k), vgetq_lane_f32(a, l))
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
    for (int k = 0; k < 4; ++k) {
        four[k] = a.at[k];
    }
}
static inline kiriLanes kiriLanes_Splat(float a)
{
    return kiriLanes_Four(a, a, a, a);
}
static inline kiriLanes kiriLanes_Add(kiriLanes a, kiriLanes b)
{
    return kiriLanes_Four(a.at[0] + b.at[0], a.at[1] + b.at[1], a.at[2] + b.at[2], a.at[3] + b.at[3]);
}
static inline kiriLanes kiriLanes_Sub(kiriLanes a, kiriLanes b)
{
    return kiriLanes_Four(a.at[0] - b.at[0], a.at[1] - b.at[1], a.at[2] - b.at[2], a.at[3] - b.at[3]);
}
static inline kiriLanes kiriLanes_Mul(kiriLanes a, kiriLanes b)
{
    return kiriLanes_Four(a.at[0] * b.at[0], a.at[1] * b.at[1], a.at[2] * b.at[2], a.at[3] * b.at[3]);
}
static inline kiriLanes kiriLanes_Div(kiriLanes a, kiriLanes b)
{
    return kiriLanes_Four(a.at[0] / b.at[0], a.at[1] / b.at[1], a.at[2] / b.at[2], a.at[3] / b.at[3]);
}
static inline kiriLanes kiriLanes_Sqrt(kiriLanes a)
{
    return kiriLanes_Four(sqrtf(a.at[0]), sqrtf(a.at[1]), sqrtf(a.at[2]), sqrtf(a.at[3]));
}
static inline kiriLanes kiriLanes_LoadTwice(const float* two, const float* others)
{
    return kiriLanes_Four(two[0], two[1], others[0], others[1]);
}
static inline void kiriLanes_StoreThree(float* three, kiriLanes a)
{
    for (int k = 0; k < 3; ++k) {
        three[k] = a.at[k];
    }
}
#define kiriLanes_Pick(a, i, j, k, l) kiriLanes_Four((a).at[i], (a).at[j], (a).at[k], (a).at[l])
#define kiriLanes_Join(a, i, j, b, k, l) kiriLanes_Four((a).at[i], (a).at[j], (b).at[k], (b).at[l])

#endif

/* x, y and z of a cross product. */
static inline kiriLanes kiriLanes_Cross(kiriLanes a, kiriLanes b)
{
    kiriLanes c =
        kiriLanes_Sub(kiriLanes_Mul(a, kiriLanes_Pick(b, 1, 2, 0, 3)), kiriLanes_Mul(kiriLanes_Pick(a, 1, 2, 0, 3), b));
    return kiriLanes_Pick(c, 1, 2, 0, 3);
}

KIRI_C_END

#endif
