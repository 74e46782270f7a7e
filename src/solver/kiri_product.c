#include "kiri_product.h"

/* Define KIRI_RUNTIME_AVX as 0 to leave the kernel out. Builds with -mavx do not need it: Eigen has AVX there. */
#if !defined(KIRI_RUNTIME_AVX)
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__)) && !defined(__AVX__)
#define KIRI_RUNTIME_AVX 1
#else
#define KIRI_RUNTIME_AVX 0
#endif
#endif

#if KIRI_RUNTIME_AVX

/* Vectors as they lie in memory, at the address of any double. */
typedef double Two __attribute__((vector_size(16), aligned(8), may_alias));
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));
#define INLINE static inline __attribute__((always_inline))
#define WITH_AVX __attribute__((target("avx"))) /* AVX has no fused multiply-add */
#ifdef __clang__
#define UNROLL _Pragma("unroll")
#else
#define UNROLL _Pragma("GCC unroll 6")
#endif

/* Three vectors of rows by three columns: nine sums, which fit the registers. */
#define DEFINE_TILE(SubtractTile, Lanes)                                                                               \
    INLINE void SubtractTile(const kiriProduct* p, int32_t row, int32_t column)                                        \
    {                                                                                                                  \
        double* out = p->out + (ptrdiff_t)column * p->outStride + row;                                                 \
        const double *a = p->a + row, *b = p->b + column;                                                              \
        Lanes *c0 = (Lanes*)out, *c1 = (Lanes*)(out + p->outStride),                                                   \
              *c2 = (Lanes*)(out + 2 * (ptrdiff_t)p->outStride);                                                       \
        Lanes s00 = c0[0], s10 = c0[1], s20 = c0[2], s01 = c1[0], s11 = c1[1], s21 = c1[2];                            \
        Lanes s02 = c2[0], s12 = c2[1], s22 = c2[2];                                                                   \
        for (int32_t k = 0; k < p->depth; ++k, a += p->aStride, b += p->bStride) {                                     \
            const Lanes a0 = ((const Lanes*)a)[0], a1 = ((const Lanes*)a)[1], a2 = ((const Lanes*)a)[2];               \
            s00 -= b[0] * a0, s10 -= b[0] * a1, s20 -= b[0] * a2;                                                      \
            s01 -= b[1] * a0, s11 -= b[1] * a1, s21 -= b[1] * a2;                                                      \
            s02 -= b[2] * a0, s12 -= b[2] * a1, s22 -= b[2] * a2;                                                      \
        }                                                                                                              \
        c0[0] = s00, c0[1] = s10, c0[2] = s20, c1[0] = s01, c1[1] = s11, c1[2] = s21;                                  \
        c2[0] = s02, c2[1] = s12, c2[2] = s22;                                                                         \
    }

DEFINE_TILE(SubtractThreeRows, double)
DEFINE_TILE(SubtractSixRows, Two)
DEFINE_TILE(SubtractTwelveRows, Four)

/* Six rows by six columns: the remainder of blocks of six below tiles of twelve rows. */
INLINE void SubtractSixBySix(const kiriProduct* p, int32_t row, int32_t column)
{
    double* out = p->out + (ptrdiff_t)column * p->outStride + row;
    const double *a = p->a + row, *b = p->b + column;
    Four s[6];
    Two t[6];
    UNROLL KIRI_TIMES(c, 6)
    {
        s[c] = *(const Four*)(out + (ptrdiff_t)c * p->outStride);
        t[c] = *(const Two*)(out + (ptrdiff_t)c * p->outStride + 4);
    }
    for (int32_t k = 0; k < p->depth; ++k, a += p->aStride, b += p->bStride) {
        const Four a0 = *(const Four*)a;
        const Two a1 = *(const Two*)(a + 4);
        UNROLL KIRI_TIMES(c, 6)
        {
            s[c] -= b[c] * a0, t[c] -= b[c] * a1;
        }
    }
    UNROLL KIRI_TIMES(c, 6)
    {
        *(Four*)(out + (ptrdiff_t)c * p->outStride) = s[c];
        *(Two*)(out + (ptrdiff_t)c * p->outStride + 4) = t[c];
    }
}

WITH_AVX void kiriProduct_SubtractByAvx(const kiriProduct* product)
{
    const kiriProduct local = *product, *p = &local; /* `out` cannot alias it */
    KIRI_ASSERT(p->rows % 3 == 0 && p->columns % 3 == 0);
    int32_t row = 0, column;
    for (; row + 12 <= p->rows; row += 12) {
        for (column = 0; column < p->columns; column += 3) {
            SubtractTwelveRows(p, row, column);
        }
    }
    for (; row + 6 <= p->rows; row += 6) {
        for (column = 0; column + 6 <= p->columns; column += 6) {
            SubtractSixBySix(p, row, column);
        }
        for (; column < p->columns; column += 3) {
            SubtractSixRows(p, row, column);
        }
    }
    for (; row < p->rows; row += 3) {
        for (column = 0; column < p->columns; column += 3) {
            SubtractThreeRows(p, row, column);
        }
    }
}

bool kiriProduct_HasAvx(void)
{
    return __builtin_cpu_supports("avx") != 0;
}

#else

bool kiriProduct_HasAvx(void)
{
    return false;
}

void kiriProduct_SubtractByAvx(const kiriProduct* product)
{
    (void)product;
    KIRI_ASSERT(false);
}

#endif
