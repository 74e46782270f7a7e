#include "kiri_panel.h"

/* ---- Vectors of the processor ---- */

#if defined(__GNUC__)
#define INLINE static inline __attribute__((always_inline))
/* As they lie in memory, at the address of any double. */
typedef double Two __attribute__((vector_size(16), aligned(8), may_alias));
typedef double Four __attribute__((vector_size(32), aligned(8), may_alias));
#define TWO_LANES 2
#ifdef __clang__
#define UNROLL _Pragma("unroll")
#else
#define UNROLL _Pragma("GCC unroll 12")
#endif
#else
#define INLINE static inline
typedef double Two; /* one lane: the same numbers, one by one */
#define TWO_LANES 1
#define UNROLL
#endif

#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__))
#define HAS_FOUR_LANES 1
#define WITH_FOUR_LANES __attribute__((target("avx"))) /* has no fused multiply-add */
#endif

bool kiriPanel_HasLongVectors(void)
{
#ifdef HAS_FOUR_LANES
    return __builtin_cpu_supports("avx") != 0;
#else
    return false;
#endif
}

/* ---- Products ---- */

/* Three vectors of rows by three columns of `out`: as many sums as there are registers for. */
#define DEFINE_TILE(Tile, Lanes)                                                                                       \
    INLINE void Tile(double* out, ptrdiff_t outStride, const double* a, ptrdiff_t aStride, const double* b,            \
                     ptrdiff_t bStride, int32_t depth)                                                                 \
    {                                                                                                                  \
        Lanes *c0 = (Lanes*)out, *c1 = (Lanes*)(out + outStride), *c2 = (Lanes*)(out + 2 * outStride);                 \
        Lanes s00 = c0[0], s10 = c0[1], s20 = c0[2], s01 = c1[0], s11 = c1[1], s21 = c1[2];                            \
        Lanes s02 = c2[0], s12 = c2[1], s22 = c2[2];                                                                   \
        for (int32_t k = 0; k < depth; ++k, a += aStride, b += bStride) {                                              \
            const Lanes a0 = ((const Lanes*)a)[0], a1 = ((const Lanes*)a)[1], a2 = ((const Lanes*)a)[2];               \
            s00 -= b[0] * a0, s10 -= b[0] * a1, s20 -= b[0] * a2;                                                      \
            s01 -= b[1] * a0, s11 -= b[1] * a1, s21 -= b[1] * a2;                                                      \
            s02 -= b[2] * a0, s12 -= b[2] * a1, s22 -= b[2] * a2;                                                      \
        }                                                                                                              \
        c0[0] = s00, c0[1] = s10, c0[2] = s20, c1[0] = s01, c1[1] = s11, c1[2] = s21;                                  \
        c2[0] = s02, c2[1] = s12, c2[2] = s22;                                                                         \
    }

DEFINE_TILE(TileOfOne, double)
DEFINE_TILE(TileOfTwo, Two)
#ifdef HAS_FOUR_LANES
DEFINE_TILE(TileOfFour, Four)

/* Six rows by six columns: what is left of blocks of six below tiles of twelve rows. */
INLINE void TileOfSix(double* out, ptrdiff_t outStride, const double* a, ptrdiff_t aStride, const double* b,
                      ptrdiff_t bStride, int32_t depth)
{
    Four s[6];
    Two t[6];
    UNROLL for (int c = 0; c < 6; ++c)
    {
        s[c] = *(const Four*)(out + c * outStride), t[c] = *(const Two*)(out + c * outStride + 4);
    }
    for (int32_t k = 0; k < depth; ++k, a += aStride, b += bStride) {
        const Four a0 = *(const Four*)a;
        const Two a1 = *(const Two*)(a + 4);
        UNROLL for (int c = 0; c < 6; ++c)
        {
            s[c] -= b[c] * a0, t[c] -= b[c] * a1;
        }
    }
    UNROLL for (int c = 0; c < 6; ++c)
    {
        *(Four*)(out + c * outStride) = s[c], *(Two*)(out + c * outStride + 4) = t[c];
    }
}
#endif

/* The rows from `row` on, by three columns. */
INLINE void TakeOffRows(const kiriProduct* p, int32_t row, double* out, const double* b)
{
    for (; row + 3 * TWO_LANES <= p->rows; row += 3 * TWO_LANES) {
        TileOfTwo(out + row, p->outStride, p->a + row, p->aStride, b, p->bStride, p->depth);
    }
    for (; row < p->rows; row += 3) {
        TileOfOne(out + row, p->outStride, p->a + row, p->aStride, b, p->bStride, p->depth);
    }
}

#ifdef HAS_FOUR_LANES
WITH_FOUR_LANES static void TakeOffByFour(const kiriProduct* p)
{
    int32_t row = 0;
    for (; row + 12 <= p->rows; row += 12) {
        for (int32_t c = 0; c < p->columns; c += 3) {
            TileOfFour(p->out + (ptrdiff_t)c * p->outStride + row, p->outStride, p->a + row, p->aStride, p->b + c,
                       p->bStride, p->depth);
        }
    }
    int32_t column = 0;
    for (; row + 6 == p->rows && column + 6 <= p->columns; column += 6) {
        TileOfSix(p->out + (ptrdiff_t)column * p->outStride + row, p->outStride, p->a + row, p->aStride, p->b + column,
                  p->bStride, p->depth);
    }
    for (; column < p->columns; column += 3) {
        TakeOffRows(p, row, p->out + (ptrdiff_t)column * p->outStride, p->b + column);
    }
}
#endif

void kiriPanel_TakeOff(const kiriProduct* product, bool hasLongVectors)
{
    KIRI_ASSERT(product->rows % 3 == 0 && product->columns % 3 == 0);
#ifdef HAS_FOUR_LANES
    if (hasLongVectors) {
        TakeOffByFour(product);
        return;
    }
#endif
    (void)hasLongVectors;
    for (int32_t c = 0; c < product->columns; c += 3) {
        TakeOffRows(product, 0, product->out + (ptrdiff_t)c * product->outStride, product->b + c);
    }
}

INLINE void ScaleRows(const double* columns, int32_t height, int32_t first, int32_t depth, int32_t row, int32_t count,
                      double* out, const bool isByFour)
{
    (void)isByFour;
    for (int32_t k = 0; k < depth; ++k, columns += height, out += count) {
        double d = columns[first + k];
        const double* from = columns + row;
        int32_t n = 0;
#ifdef HAS_FOUR_LANES
        for (; isByFour && n + 4 <= count; n += 4) {
            *(Four*)(out + n) = d * *(const Four*)(from + n);
        }
#endif
        for (; n + TWO_LANES <= count; n += TWO_LANES) {
            *(Two*)(out + n) = d * *(const Two*)(from + n);
        }
        for (; n < count; ++n) {
            out[n] = d * from[n];
        }
    }
}

#ifdef HAS_FOUR_LANES
WITH_FOUR_LANES static void ScaleRowsByFour(const double* columns, int32_t height, int32_t first, int32_t depth,
                                            int32_t row, int32_t count, double* out)
{
    ScaleRows(columns, height, first, depth, row, count, out, true);
}
#endif

void kiriPanel_ScaleRows(const double* columns, int32_t height, int32_t first, int32_t depth, int32_t row,
                         int32_t count, double* out, bool hasLongVectors)
{
#ifdef HAS_FOUR_LANES
    if (hasLongVectors) {
        ScaleRowsByFour(columns, height, first, depth, row, count, out);
        return;
    }
#endif
    (void)hasLongVectors;
    ScaleRows(columns, height, first, depth, row, count, out, false);
}

/* ---- Factorisation of a block column: `size` is known to the compiler ---- */

/* Of the diagonal block. What divides the rows below: `divisor` has the entries L D of each column, and `inverse` those
   of D. */
INLINE bool FactorDiagonal(double* block, ptrdiff_t stride, const int size, double* divisor, double* inverse)
{
    for (int m = 0; m < size; ++m) {
        double* column = block + stride * m;
        if (!(column[m] > 0.0)) {
            return false;
        }
        inverse[m] = 1.0 / column[m];
        for (int c = m + 1; c < size; ++c) {
            double l = inverse[m] * column[c], *other = block + stride * c;
            divisor[size * m + c] = l;
            for (int r = c; r < size; ++r) {
                other[r] -= l * column[r];
            }
        }
        for (int r = m + 1; r < size; ++r) {
            column[r] = divisor[size * m + r];
        }
    }
    return true;
}

/* Rows below the diagonal block times (L D)^-T. */
#define DEFINE_DIVIDE(Divide, Lanes)                                                                                   \
    INLINE void Divide(double* rows, ptrdiff_t stride, const int size, const double* divisor, const double* inverse)   \
    {                                                                                                                  \
        Lanes row[12];                                                                                                 \
        UNROLL for (int m = 0; m < size; ++m)                                                                          \
        {                                                                                                              \
            row[m] = *(Lanes*)(rows + stride * m);                                                                     \
            UNROLL for (int n = 0; n < m; ++n)                                                                         \
            {                                                                                                          \
                row[m] -= divisor[size * n + m] * row[n];                                                              \
            }                                                                                                          \
        }                                                                                                              \
        UNROLL for (int m = 0; m < size; ++m)                                                                          \
        {                                                                                                              \
            *(Lanes*)(rows + stride * m) = inverse[m] * row[m];                                                        \
        }                                                                                                              \
    }

DEFINE_DIVIDE(DivideOne, double)
DEFINE_DIVIDE(DivideTwo, Two)
#ifdef HAS_FOUR_LANES
DEFINE_DIVIDE(DivideFour, Four)
#endif

INLINE bool FactorColumns(double* panel, int32_t height, ptrdiff_t stride, const int size, const bool isByFour)
{
    double divisor[12 * 12], inverse[12];
    if (!FactorDiagonal(panel, stride, size, divisor, inverse)) {
        return false;
    }
    int32_t r = size;
    (void)isByFour;
#ifdef HAS_FOUR_LANES
    for (; isByFour && r + 4 <= height; r += 4) {
        DivideFour(panel + r, stride, size, divisor, inverse);
    }
#endif
    for (; r + TWO_LANES <= height; r += TWO_LANES) {
        DivideTwo(panel + r, stride, size, divisor, inverse);
    }
    for (; r < height; ++r) {
        DivideOne(panel + r, stride, size, divisor, inverse);
    }
    return true;
}

/* One function a size of blocks and length of vectors. */
#define DEFINE_FACTOR(Factor, size, target, isByFour)                                                                  \
    target static bool Factor(double* panel, int32_t height, ptrdiff_t stride)                                         \
    {                                                                                                                  \
        return FactorColumns(panel, height, stride, size, isByFour);                                                   \
    }

DEFINE_FACTOR(FactorThree, 3, , false)
DEFINE_FACTOR(FactorSix, 6, , false)
DEFINE_FACTOR(FactorTwelve, 12, , false)
#ifdef HAS_FOUR_LANES
DEFINE_FACTOR(FactorSixByFour, 6, WITH_FOUR_LANES, true)
DEFINE_FACTOR(FactorTwelveByFour, 12, WITH_FOUR_LANES, true)
#endif

bool kiriPanel_Factor(double* panel, int32_t height, int32_t stride, int32_t size, bool hasLongVectors)
{
    KIRI_ASSERT(size == 3 || size == 6 || size == 12);
#ifdef HAS_FOUR_LANES
    if (hasLongVectors && size > 3) {
        return size == 6 ? FactorSixByFour(panel, height, stride) : FactorTwelveByFour(panel, height, stride);
    }
#endif
    (void)hasLongVectors;
    return size == 3   ? FactorThree(panel, height, stride)
           : size == 6 ? FactorSix(panel, height, stride)
                       : FactorTwelve(panel, height, stride);
}

/* ---- Solution, three columns at a time ---- */

/* y -= the sum of f x, of three columns. */
INLINE void TakeOffThree(double* y, const double f[3], const double* const x[3], int32_t count)
{
    int32_t n = 0;
    for (; n + TWO_LANES <= count; n += TWO_LANES) {
        Two sum = *(Two*)(y + n);
        sum -= f[0] * *(const Two*)(x[0] + n);
        sum -= f[1] * *(const Two*)(x[1] + n);
        sum -= f[2] * *(const Two*)(x[2] + n);
        *(Two*)(y + n) = sum;
    }
    for (; n < count; ++n) {
        y[n] = y[n] - f[0] * x[0][n] - f[1] * x[1][n] - f[2] * x[2][n];
    }
}

void kiriPanel_SolveDown(const double* panel, int32_t height, int32_t width, double* y)
{
    for (int32_t c = 0; c < width; c += 3) {
        const double* column[3];
        for (int32_t n = 0; n < 3; ++n) {
            column[n] = panel + (ptrdiff_t)height * (c + n);
        }
        y[c + 1] -= y[c] * column[0][c + 1];
        y[c + 2] -= y[c] * column[0][c + 2];
        y[c + 2] -= y[c + 1] * column[1][c + 2];
        const double* const below[3] = { column[0] + c + 3, column[1] + c + 3, column[2] + c + 3 };
        TakeOffThree(y + c + 3, y + c, below, height - c - 3);
    }
    for (int32_t c = 0; c < width; ++c) {
        y[c] /= panel[(ptrdiff_t)height * c + c];
    }
}

/* The sums of x y, of three columns x: those of even numbers and those of odd ones first by themselves. */
INLINE void SumThree(double sums[3], const double* const x[3], const double* y, int32_t count)
{
    double even[3] = { 0.0, 0.0, 0.0 }, odd[3] = { 0.0, 0.0, 0.0 };
    int32_t n = 0;
#if TWO_LANES == 2
    Two s0 = { 0.0, 0.0 }, s1 = s0, s2 = s0;
    for (; n + 2 <= count; n += 2) {
        const Two other = *(const Two*)(y + n);
        s0 += *(const Two*)(x[0] + n) * other;
        s1 += *(const Two*)(x[1] + n) * other;
        s2 += *(const Two*)(x[2] + n) * other;
    }
    even[0] = s0[0], even[1] = s1[0], even[2] = s2[0];
    odd[0] = s0[1], odd[1] = s1[1], odd[2] = s2[1];
#endif
    for (; n < count; ++n) {
        double* sum = n % 2 == 0 ? even : odd;
        sum[0] += x[0][n] * y[n];
        sum[1] += x[1][n] * y[n];
        sum[2] += x[2][n] * y[n];
    }
    for (int32_t k = 0; k < 3; ++k) {
        sums[k] = even[k] + odd[k];
    }
}

void kiriPanel_SolveUp(const double* panel, int32_t height, int32_t width, double* x)
{
    for (int32_t c = width - 3; c >= 0; c -= 3) {
        const double *first = panel + (ptrdiff_t)height * c, *second = first + height, *third = second + height;
        const double* const below[3] = { first + c + 3, second + c + 3, third + c + 3 };
        double sums[3];
        SumThree(sums, below, x + c + 3, height - c - 3);
        x[c + 2] -= sums[2];
        x[c + 1] -= sums[1] + second[c + 2] * x[c + 2];
        x[c] -= sums[0] + first[c + 2] * x[c + 2] + first[c + 1] * x[c + 1];
    }
}
