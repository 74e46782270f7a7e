/* Supernodal left-looking L D L^T on Eigen's fixed-size expressions; CHOLMOD has the same scheme (Chen, Davis, Hager,
   Rajamanickam 2008). Each number is summed separately, in ascending order, so vector length, compiler and optimisation
   do not change bits. Eigen's own factorisations are not used: their sums depend on the processor, or they go entry by
   entry. */
#include "../core/kiri_float.h"

#include "kiri_matrix.h"

/* A host may use Eigen with other options: its instances of Eigen's inline functions must not replace ours. */
#define Eigen kiriEigen

/* Eigen's packets would fuse multiply-add by intrinsics, which no pragma forbids. With AVX-512 Eigen needs them. */
#undef __FMA__
#undef __AVX512F__

/* Debug builds prove that Eigen allocates for the order only. EIGEN_RUNTIME_NO_MALLOC does the same, but all threads
   share its flag. */
#if defined(KIRI_ASSERTS)
#define EIGEN_NO_MALLOC
static thread_local bool kiriIsOrdering;
#define KIRI_SET_ORDERING(isOrdering) (kiriIsOrdering = (isOrdering))
#define eigen_assert(condition) KIRI_ASSERT((condition) || kiriIsOrdering)
#else
#define KIRI_SET_ORDERING(isOrdering) ((void)0)
#define eigen_assert(condition) KIRI_ASSERT(condition)
#endif

#include <Eigen/Sparse>
#include <float.h>

#if defined(__clang__)
#define KIRI_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define KIRI_UNROLL _Pragma("GCC unroll 12")
#else
#define KIRI_UNROLL
#endif

/* Define KIRI_RUNTIME_AVX as 0 to leave out the kernel with AVX, chosen at run time. Builds with -mavx do not need it:
   Eigen has AVX there. */
#if !defined(KIRI_RUNTIME_AVX)
#if defined(__GNUC__) && (defined(__x86_64__) || defined(__i386__)) && !defined(__AVX__)
#define KIRI_RUNTIME_AVX 1
#else
#define KIRI_RUNTIME_AVX 0
#endif
#endif

extern "C" bool kiriMatrix_HasAvx(void)
{
#if KIRI_RUNTIME_AVX
    return __builtin_cpu_supports("avx") != 0;
#else
    return false;
#endif
}

/* ---- Order ---- */

extern "C" bool kiriMatrix_Order(kiriMatrix* matrix)
try {
    const int32_t count = matrix->count, *start = matrix->graph.start.data, *row = matrix->graph.row.data;
    KIRI_SET_ORDERING(true);
    /* Values do not matter. */
    Eigen::Map<const Eigen::SparseMatrix<int32_t>> graph(count, count, start[count], start, row, row);
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int32_t> order;
    Eigen::AMDOrdering<int32_t>()(graph.selfadjointView<Eigen::Lower>(), order);
    KIRI_ASSERT(order.indices().size() == count);
    for (int32_t position = 0; position < count; ++position) {
        matrix->order.data[order.indices()[position]] = position;
    }
    KIRI_SET_ORDERING(false);
    return true;
} catch (...) {
    KIRI_SET_ORDERING(false);
    return false;
}

/* ---- Products ---- */

namespace
{

/* out -= a b: `a` is rows x depth and `out` rows x columns, column by column; `b` is depth x columns, row by row.
   Strides are in numbers. `rows` and `columns` are multiples of 3. */
struct Product {
    double* out;
    const double *a, *b;
    int32_t outStride, aStride, bStride;
    int32_t rows, columns, depth;
};

enum {
    MOST_ROWS = 16,    /* of an element that are added together */
    MOST_COLUMNS = 48, /* whose products are subtracted at once: a multiple of all block sizes */
#if defined(EIGEN_VECTORIZE_AVX) || defined(EIGEN_VECTORIZE_NEON)
    TALL = 12, /* rows of a tile: three vectors by three columns fill the registers */
    LANES = 4  /* rows of a block column that are divided at once */
#else
    TALL = 6,
    LANES = 2
#endif
};

template <int Rows> using Column = Eigen::Matrix<double, Rows, 1>;
template <int Rows> using Target = Eigen::Map<Column<Rows>>;
template <int Rows> using Source = Eigen::Map<const Column<Rows>>;

/* x.unaryExpr(Times(d)) is d * x. gcc does not inline Eigen's own d * x below kiri_float.h's pragma. */
typedef Eigen::internal::bind1st_op<Eigen::internal::scalar_product_op<double>> Times;

/* Three columns of the product. They have names: an array of them would stay in memory. */
template <int Rows> inline void SubtractTile(const Product& product, int32_t row, int32_t column)
{
    double* out = product.out + (ptrdiff_t)column * product.outStride + row;
    const double *a = product.a + row, *b = product.b + column;
    const ptrdiff_t aStride = product.aStride, bStride = product.bStride;
    Target<Rows> out0(out), out1(out + product.outStride), out2(out + 2 * (ptrdiff_t)product.outStride);
    Column<Rows> sum0 = out0, sum1 = out1, sum2 = out2;
    for (int32_t k = product.depth; k > 0; --k, a += aStride, b += bStride) {
        const Source<Rows> from(a);
        sum0 -= from.unaryExpr(Times(b[0]));
        sum1 -= from.unaryExpr(Times(b[1]));
        sum2 -= from.unaryExpr(Times(b[2]));
    }
    out0 = sum0;
    out1 = sum1;
    out2 = sum2;
}

template <int Rows> inline int32_t SubtractTiles(const Product& product, int32_t row)
{
    for (; row + Rows <= product.rows; row += Rows) {
        for (int32_t c = 0; c < product.columns; c += 3) {
            SubtractTile<Rows>(product, row, c);
        }
    }
    return row;
}

#if KIRI_RUNTIME_AVX

/* Vectors as they lie in memory, at the address of any double. As arguments of templates they would lose attributes. */
struct One {
    typedef double Lanes;
};
struct Two {
    typedef double Lanes __attribute__((vector_size(16), aligned(8), may_alias));
};
struct Four {
    typedef double Lanes __attribute__((vector_size(32), aligned(8), may_alias));
};
#define INLINE inline __attribute__((always_inline))
#define WITH_AVX __attribute__((target("avx"))) /* AVX has no fused multiply-add */

/* Three vectors of rows by three columns: nine sums, which fit the registers. */
template <typename Vector> INLINE void SubtractVectors(const Product* p, int32_t row, int32_t column)
{
    typedef typename Vector::Lanes Lanes;
    double* out = p->out + (ptrdiff_t)column * p->outStride + row;
    const double *a = p->a + row, *b = p->b + column;
    Lanes *c0 = (Lanes*)out, *c1 = (Lanes*)(out + p->outStride), *c2 = (Lanes*)(out + 2 * (ptrdiff_t)p->outStride);
    Lanes s00 = c0[0], s10 = c0[1], s20 = c0[2], s01 = c1[0], s11 = c1[1], s21 = c1[2];
    Lanes s02 = c2[0], s12 = c2[1], s22 = c2[2];
    for (int32_t k = 0; k < p->depth; ++k, a += p->aStride, b += p->bStride) {
        const Lanes a0 = ((const Lanes*)a)[0], a1 = ((const Lanes*)a)[1], a2 = ((const Lanes*)a)[2];
        s00 -= b[0] * a0, s10 -= b[0] * a1, s20 -= b[0] * a2;
        s01 -= b[1] * a0, s11 -= b[1] * a1, s21 -= b[1] * a2;
        s02 -= b[2] * a0, s12 -= b[2] * a1, s22 -= b[2] * a2;
    }
    c0[0] = s00, c0[1] = s10, c0[2] = s20, c1[0] = s01, c1[1] = s11, c1[2] = s21;
    c2[0] = s02, c2[1] = s12, c2[2] = s22;
}

/* Six rows by six columns: the remainder of blocks of six below tiles of twelve rows. */
INLINE void SubtractSixBySix(const Product* p, int32_t row, int32_t column)
{
    double* out = p->out + (ptrdiff_t)column * p->outStride + row;
    const double *a = p->a + row, *b = p->b + column;
    Four::Lanes s[6];
    Two::Lanes t[6];
    KIRI_UNROLL KIRI_TIMES(c, 6)
    {
        s[c] = *(const Four::Lanes*)(out + (ptrdiff_t)c * p->outStride);
        t[c] = *(const Two::Lanes*)(out + (ptrdiff_t)c * p->outStride + 4);
    }
    for (int32_t k = 0; k < p->depth; ++k, a += p->aStride, b += p->bStride) {
        const Four::Lanes a0 = *(const Four::Lanes*)a;
        const Two::Lanes a1 = *(const Two::Lanes*)(a + 4);
        KIRI_UNROLL KIRI_TIMES(c, 6)
        {
            s[c] -= b[c] * a0, t[c] -= b[c] * a1;
        }
    }
    KIRI_UNROLL KIRI_TIMES(c, 6)
    {
        *(Four::Lanes*)(out + (ptrdiff_t)c * p->outStride) = s[c];
        *(Two::Lanes*)(out + (ptrdiff_t)c * p->outStride + 4) = t[c];
    }
}

/* Subtracts the product of two frames of an element. Constant strides save 40 % of its instructions. */
WITH_AVX void SubtractBlockByAvx(double* out, const double* a, int32_t aStride, const double* b, int32_t depth)
{
    const Product product = { out, a, b, 6, aStride, 6, 6, 6, depth };
    SubtractSixBySix(&product, 0, 0);
}

WITH_AVX void SubtractByAvx(const Product& product)
{
    const Product local = product, *p = &local; /* `out` cannot alias it */
    int32_t row = 0, column;
    for (; row + 12 <= p->rows; row += 12) {
        for (column = 0; column < p->columns; column += 3) {
            SubtractVectors<Four>(p, row, column);
        }
    }
    for (; row + 6 <= p->rows; row += 6) {
        for (column = 0; column + 6 <= p->columns; column += 6) {
            SubtractSixBySix(p, row, column);
        }
        for (; column < p->columns; column += 3) {
            SubtractVectors<Two>(p, row, column);
        }
    }
    for (; row < p->rows; row += 3) {
        for (column = 0; column < p->columns; column += 3) {
            SubtractVectors<One>(p, row, column);
        }
    }
}

#endif

inline void SubtractProduct(const kiriMatrix* matrix, const Product& product)
{
    KIRI_ASSERT(product.rows % 3 == 0 && product.columns % 3 == 0);
#if KIRI_RUNTIME_AVX
    if (matrix->usesAvx) {
        SubtractByAvx(product);
        return;
    }
#else
    (void)matrix;
#endif
    int32_t row = TALL > 6 ? SubtractTiles<TALL>(product, 0) : 0;
    SubtractTiles<3>(product, SubtractTiles<6>(product, row));
}

/* ---- Entries ---- */

/* Returns the index of the block of two positions; KIRI_NONE if the pattern lacks it. */
inline int32_t FindBlock(const kiriMatrix* matrix, int32_t a, int32_t b)
{
    int32_t row = kiriMax(a, b), column = kiriMin(a, b);
    const int32_t* rows = matrix->pattern.row.data;
    int32_t at = matrix->pattern.start.data[column], end = matrix->pattern.start.data[column + 1];
    while (at < end && rows[at] < row) { /* columns are short: binary search is slower */
        ++at;
    }
    return at < end && rows[at] == row ? at : KIRI_NONE;
}

inline double* BlockOf(const kiriMatrix* matrix, int32_t block)
{
    KIRI_ASSERT_HAS(matrix->pattern.row, block);
    return matrix->values.data + (int64_t)matrix->size * matrix->size * block;
}

inline double* DiagonalBlockOf(const kiriMatrix* matrix, int32_t column)
{
    return BlockOf(matrix, matrix->pattern.start.data[column]);
}

/* Calls function.Run<Size>() with the matrix's block size as a constant. */
template <typename Function> inline auto WithSize(const kiriMatrix* matrix, Function function)
{
    return matrix->size == 6   ? function(std::integral_constant<int, 6>())
           : matrix->size == 3 ? function(std::integral_constant<int, 3>())
                               : function(std::integral_constant<int, 12>());
}

/* Adds block column b of J^T k J, for at most MOST_ROWS rows. */
template <int Size>
void AddSquareColumn(kiriMatrix* matrix, const int32_t* frames, int32_t count, const double* J, const double* k,
                     int32_t rows, int32_t b)
{
    int32_t stride = Size * count, column = matrix->order.data[frames[b]];
    double scaled[MOST_ROWS * Size];
    for (int32_t e = 0; e < rows; ++e) {
        Target<Size>(scaled + Size * e) = Source<Size>(J + (ptrdiff_t)stride * e + Size * b).unaryExpr(Times(-k[e]));
    }
    for (int32_t a = 0; a < count; ++a) {
        int32_t row = matrix->order.data[frames[a]];
        if (row < column) {
            continue;
        }
        double* out = BlockOf(matrix, FindBlock(matrix, row, column));
#if KIRI_RUNTIME_AVX
        if (Size == 6 && matrix->usesAvx) {
            SubtractBlockByAvx(out, J + Size * a, stride, scaled, rows);
            continue;
        }
#endif
        SubtractProduct(matrix, { out, J + Size * a, scaled, Size, stride, Size, Size, Size, rows });
    }
}

template <int Size>
void AddForces(const int32_t* frames, int32_t count, const double* J, const double* pulls, int32_t rows, double* forces)
{
    for (int32_t e = 0; e < rows; ++e) {
        for (int32_t m = 0; m < count; ++m, J += Size) {
            Target<Size>(forces + (ptrdiff_t)Size * frames[m]) += Source<Size>(J).unaryExpr(Times(pulls[e]));
        }
    }
}

} // namespace

extern "C" bool kiriMatrix_Covers(const kiriMatrix* matrix, kiriPair pair)
{
    KIRI_ASSERT(pair.a >= 0 && pair.a < matrix->count && pair.b >= 0 && pair.b < matrix->count);
    return FindBlock(matrix, matrix->order.data[pair.a], matrix->order.data[pair.b]) != KIRI_NONE;
}

extern "C" void kiriMatrix_Clear(kiriMatrix* matrix)
{
    kiriArray_Set(&matrix->values, 0);
}

extern "C" void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block)
{
    KIRI_ASSERT_HAS(*matrix, frame);
    double* out = DiagonalBlockOf(matrix, matrix->order.data[frame]);
    for (int32_t n = 0; n < matrix->size * matrix->size; ++n) {
        out[n] += block[n];
    }
}

extern "C" void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                                      const double* k, int32_t rows)
{
    for (int32_t e = 0; e < rows; e += MOST_ROWS) {
        const double* part = J + (ptrdiff_t)matrix->size * frameCount * e;
        int32_t some = kiriMin(rows - e, MOST_ROWS);
        for (int32_t b = 0; b < frameCount; ++b) {
            WithSize(matrix,
                     [=](auto size) { AddSquareColumn<size.value>(matrix, frames, frameCount, part, k + e, some, b); });
        }
    }
}

extern "C" void kiriMatrix_AddForces(const kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                                     const double* pulls, int32_t rows, double* forces)
{
    WithSize(matrix, [=](auto size) { AddForces<size.value>(frames, frameCount, J, pulls, rows, forces); });
}

/* ---- Factorisation ---- */

namespace
{

/* Copies a frame's numbers: a call of memcpy takes longer. */
inline void CopyNumbers(double* to, const double* from, int32_t count)
{
    for (int32_t n = 0; n < count; n += 3) {
        Target<3>(to + n) = Source<3>(from + n);
    }
}

/* Copies the matrix's columns into the panel, and marks the position of each row in it. */
void StartPanel(kiriMatrix* matrix, const kiriPanel* panel)
{
    int32_t size = matrix->size, height = size * (panel->width + panel->below), *mark = matrix->mark.data;
    double* values = matrix->factors.data + panel->values;
    memset(values, 0, sizeof(double) * (size_t)height * (size_t)(size * panel->width));
    for (int32_t n = 0; n < panel->width; ++n) {
        mark[panel->column + n] = n;
    }
    for (int32_t n = 0; n < panel->below; ++n) {
        mark[matrix->factor.row.data[panel->row + n]] = panel->width + n;
    }
    for (int32_t n = 0; n < panel->width; ++n) {
        const int32_t* start = &matrix->pattern.start.data[panel->column + n];
        for (int32_t b = start[0]; b < start[1]; ++b) {
            const double* from = BlockOf(matrix, b);
            double* to = values + (ptrdiff_t)height * size * n + size * mark[matrix->pattern.row.data[b]];
            for (int32_t k = 0; k < size; ++k, from += size, to += height) {
                CopyNumbers(to, from, size);
            }
        }
    }
}

/* Multiplies `count` rows of `depth` columns of a panel by D, into `out` row by row of D. `columns` is where column
   `first` of the panel begins. */
void ScaleRows(const double* columns, int32_t height, int32_t first, int32_t depth, int32_t row, int32_t count,
               double* out)
{
    for (int32_t k = 0; k < depth; ++k, columns += height, out += count) {
        const double d = columns[first + k], *from = columns + row;
        int32_t n = 0;
        for (; n + 6 <= count; n += 6) {
            Target<6>(out + n) = Source<6>(from + n).unaryExpr(Times(d));
        }
        for (; n < count; n += 3) {
            Target<3>(out + n) = Source<3>(from + n).unaryExpr(Times(d));
        }
    }
}

/* Subtracts the product of some columns of an earlier panel: for each column of the update, runs of rows that are
   adjacent in both panels at once. `k` is the first of the columns. */
void SubtractColumns(kiriMatrix* matrix, const kiriPanel* panel, const kiriPanelUpdate* update, int32_t k,
                     Product product)
{
    int32_t size = matrix->size;
    const kiriPanel* from = &matrix->panels.data[update->panel];
    const double* values = matrix->factors.data + from->values + (ptrdiff_t)product.aStride * k;
    const int32_t *rows = matrix->factor.row.data + from->row, *mark = matrix->mark.data;
    for (int32_t c = 0; c < update->count; ++c) {
        int32_t first = update->first + c;
        double* out = matrix->factors.data + panel->values + (ptrdiff_t)product.outStride * size * mark[rows[first]];
        product.b = matrix->scaled.data + (ptrdiff_t)product.bStride * k + size * c;
        for (int32_t n = first, end; n < from->below; n = end) {
            for (end = n + 1; end < from->below && mark[rows[end]] == mark[rows[n]] + end - n;) {
                ++end;
            }
            product.a = values + size * (from->width + n);
            product.out = out + size * mark[rows[n]];
            product.rows = size * (end - n);
            SubtractProduct(matrix, product);
        }
    }
}

/* Subtracts an earlier panel, MOST_COLUMNS at once: their rows stay in the cache for all columns of the panel. */
void UpdatePanel(kiriMatrix* matrix, const kiriPanel* panel, const kiriPanelUpdate* update)
{
    int32_t size = matrix->size;
    const kiriPanel* from = &matrix->panels.data[update->panel];
    int32_t width = size * from->width, height = width + size * from->below, count = size * update->count;
    ScaleRows(matrix->factors.data + from->values, height, 0, width, size * (from->width + update->first), count,
              matrix->scaled.data);
    for (int32_t k = 0; k < width; k += MOST_COLUMNS) {
        int32_t depth = kiriMin(width - k, MOST_COLUMNS);
        int32_t target = size * (panel->width + panel->below);
        Product product = { nullptr, nullptr, nullptr, target, height, count, 0, size, depth };
        SubtractColumns(matrix, panel, update, k, product);
    }
}

/* Factors a diagonal block. `divisor` gets the rows of L, column by column, and `inverse` 1 / D. Fails if a pivot is
   not positive. */
template <int Size> bool FactorBlock(double* block, ptrdiff_t stride, double* divisor, double* inverse)
{
    for (int m = 0; m < Size; ++m) {
        double* column = block + stride * m;
        if (!(column[m] > 0.0)) {
            return false;
        }
        inverse[m] = 1.0 / column[m];
        for (int c = m + 1; c < Size; ++c) {
            double l = inverse[m] * column[c], *other = block + stride * c;
            divisor[Size * m + c] = l;
            for (int r = c; r < Size; ++r) {
                other[r] -= l * column[r];
            }
        }
        for (int r = m + 1; r < Size; ++r) {
            column[r] = divisor[Size * m + r];
        }
    }
    return true;
}

/* Multiplies rows below a diagonal block by (L D)^-T. */
template <int Size, int Rows>
inline void DivideRows(double* rows, ptrdiff_t stride, const double* divisor, const double* inverse)
{
    Column<Rows> column[Size];
    KIRI_UNROLL for (int m = 0; m < Size; ++m)
    {
        column[m] = Source<Rows>(rows + stride * m);
        KIRI_UNROLL for (int n = 0; n < m; ++n)
        {
            column[m] -= column[n].unaryExpr(Times(divisor[Size * n + m]));
        }
    }
    KIRI_UNROLL for (int m = 0; m < Size; ++m)
    {
        Target<Rows>(rows + stride * m) = column[m].unaryExpr(Times(inverse[m]));
    }
}

/* Factors a block column of `height` rows, which begins at its diagonal block. */
template <int Size> bool FactorBlockColumn(double* columns, int32_t height, ptrdiff_t stride)
{
    double divisor[Size * Size], inverse[Size];
    if (!FactorBlock<Size>(columns, stride, divisor, inverse)) {
        return false;
    }
    int32_t r = Size;
    for (; r + LANES <= height; r += LANES) {
        DivideRows<Size, LANES>(columns + r, stride, divisor, inverse);
    }
    for (; r < height; ++r) {
        DivideRows<Size, 1>(columns + r, stride, divisor, inverse);
    }
    return true;
}

/* Subtracts the product of columns `first` to `last` of a panel from its block column c, from the diagonal on. */
void SubtractOwn(kiriMatrix* matrix, double* values, int32_t height, int32_t first, int32_t last, int32_t c)
{
    int32_t size = matrix->size;
    const double* from = values + (ptrdiff_t)height * first;
    double* out = values + (ptrdiff_t)height * c + c;
    Product product = { out, from + c, matrix->scaled.data, height, height, size, height - c, size, last - first };
    ScaleRows(from, height, first, last - first, c, size, matrix->scaled.data);
    SubtractProduct(matrix, product);
}

/* Factors block column by block column. MOST_COLUMNS are subtracted from all later columns at once, while they are in
   the cache. */
template <int Size> bool FactorPanel(kiriMatrix* matrix, const kiriPanel* panel)
{
    int32_t height = Size * (panel->width + panel->below), width = Size * panel->width;
    double* values = matrix->factors.data + panel->values;
    for (int32_t first = 0, last; first < width; first = last) {
        last = kiriMin(first + MOST_COLUMNS, width);
        for (int32_t c = first; c < last; c += Size) {
            if (c > first) {
                SubtractOwn(matrix, values, height, first, c, c);
            }
            if (!FactorBlockColumn<Size>(values + (ptrdiff_t)height * c + c, height - c, height)) {
                return false;
            }
        }
        for (int32_t c = last; c < width; c += Size) {
            SubtractOwn(matrix, values, height, first, last, c);
        }
    }
    return true;
}

template <int Size> bool FactorPanels(kiriMatrix* matrix)
{
    KIRI_EACH(const kiriPanel, panel, matrix->panels) {
        StartPanel(matrix, panel);
        for (int32_t n = panel->update; n != KIRI_NONE; n = matrix->updates.data[n].next) {
            UpdatePanel(matrix, panel, &matrix->updates.data[n]);
        }
        if (!FactorPanel<Size>(matrix, panel)) {
            return false;
        }
    }
    return true;
}

} // namespace

/* If springs are stiffer than inertia by more than the digits of a double, elimination cancels the inertia on the
   diagonal, and rounding decides the sign. A shift by the rounding makes the matrix positive; such a light sheet then
   falls too slowly. */
extern "C" bool kiriMatrix_Factor(kiriMatrix* matrix)
{
    auto factor = [=](auto size) { return FactorPanels<size.value>(matrix); };
    if (WithSize(matrix, factor)) {
        return true;
    }
    for (int32_t c = 0; c < matrix->count; ++c) {
        double* block = DiagonalBlockOf(matrix, c);
        for (int32_t n = 0; n < matrix->size; ++n) {
            block[(matrix->size + 1) * n] *= 1.0 + 8.0 * DBL_EPSILON;
        }
    }
    return WithSize(matrix, factor);
}

/* ---- Solution, three columns at a time ---- */

namespace
{

/* Subtracts x[0], x[1], x[2] times three columns from y. */
template <int Rows>
inline int32_t SubtractThree(double* y, const double* x, const double* columns, ptrdiff_t stride, int32_t row,
                             int32_t height)
{
    for (; row + Rows <= height; row += Rows) {
        Column<Rows> sum = Source<Rows>(y + row);
        sum -= Source<Rows>(columns + row).unaryExpr(Times(x[0]));
        sum -= Source<Rows>(columns + stride + row).unaryExpr(Times(x[1]));
        sum -= Source<Rows>(columns + 2 * stride + row).unaryExpr(Times(x[2]));
        Target<Rows>(y + row) = sum;
    }
    return row;
}

/* Solves L y' = y, subtracts L times y' from the rows below, and divides the panel's rows by D. */
void SolvePanelDown(const double* panel, int32_t height, int32_t width, double* y)
{
    for (int32_t c = 0; c < width; c += 3) {
        const double *column = panel + (ptrdiff_t)height * c, *next = column + height;
        y[c + 1] -= y[c] * column[c + 1];
        y[c + 2] -= y[c] * column[c + 2];
        y[c + 2] -= y[c + 1] * next[c + 2];
        int32_t row = SubtractThree<6>(y, y + c, column, height, c + 3, height);
        SubtractThree<3>(y, y + c, column, height, row, height);
    }
    for (int32_t c = 0; c < width; ++c) {
        y[c] /= panel[(ptrdiff_t)height * c + c];
    }
}

/* Sums x[n] y[n] of three columns x, in six sums each, which are then added in ascending order. */
inline void SumThree(double sums[3], const double* x, ptrdiff_t stride, const double* y, int32_t count)
{
    typedef Column<6> Six;
    Six sum[3] = { Six::Zero(), Six::Zero(), Six::Zero() };
    int32_t n = 0;
    for (; n + 6 <= count; n += 6) {
        const Source<6> other(y + n);
        sum[0] += Source<6>(x + n).cwiseProduct(other);
        sum[1] += Source<6>(x + stride + n).cwiseProduct(other);
        sum[2] += Source<6>(x + 2 * stride + n).cwiseProduct(other);
    }
    for (int k = 0; k < 3; ++k) {
        if (n < count) {
            sum[k].head<3>() += Source<3>(x + k * stride + n).cwiseProduct(Source<3>(y + n));
        }
        sums[k] = ((((sum[k][0] + sum[k][1]) + sum[k][2]) + sum[k][3]) + sum[k][4]) + sum[k][5];
    }
}

/* Solves L^T x = y for the first `width` of x, which start as y; the other numbers are known. */
void SolvePanelUp(const double* panel, int32_t height, int32_t width, double* x)
{
    for (int32_t c = width - 3; c >= 0; c -= 3) {
        const double *first = panel + (ptrdiff_t)height * c, *second = first + height;
        double sums[3];
        SumThree(sums, first + c + 3, height, x + c + 3, height - c - 3);
        x[c + 2] -= sums[2];
        x[c + 1] -= sums[1] + second[c + 2] * x[c + 2];
        x[c] -= sums[0] + first[c + 2] * x[c + 2] + first[c + 1] * x[c + 1];
    }
}

template <int Size> void SolvePanels(kiriMatrix* matrix)
{
    double *all = matrix->right.data, *part = matrix->part.data;
    KIRI_EACH(const kiriPanel, panel, matrix->panels) {
        const int32_t width = Size * panel->width, *rows = matrix->factor.row.data + panel->row;
        CopyNumbers(part, all + Size * panel->column, width);
        memset(part + width, 0, sizeof(double) * (size_t)(Size * panel->below));
        SolvePanelDown(matrix->factors.data + panel->values, width + Size * panel->below, width, part);
        CopyNumbers(all + Size * panel->column, part, width);
        for (int32_t n = 0; n < panel->below; ++n) {
            Target<Size>(all + Size * rows[n]) += Source<Size>(part + width + Size * n);
        }
    }
    KIRI_EACH_INDEX_BACK(p, matrix->panels) {
        const kiriPanel* panel = &matrix->panels.data[p];
        const int32_t width = Size * panel->width, *rows = matrix->factor.row.data + panel->row;
        CopyNumbers(part, all + Size * panel->column, width);
        for (int32_t n = 0; n < panel->below; ++n) {
            CopyNumbers(part + width + Size * n, all + Size * rows[n], Size);
        }
        SolvePanelUp(matrix->factors.data + panel->values, width + Size * panel->below, width, part);
        CopyNumbers(all + Size * panel->column, part, width);
    }
}

} // namespace

extern "C" void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution)
{
    int32_t size = matrix->size;
    for (int32_t f = 0; f < matrix->count; ++f) {
        CopyNumbers(matrix->right.data + size * matrix->order.data[f], right + size * f, size);
    }
    WithSize(matrix, [=](auto constant) { SolvePanels<constant.value>(matrix); });
    for (int32_t f = 0; f < matrix->count; ++f) {
        CopyNumbers(solution + size * f, matrix->right.data + size * matrix->order.data[f], size);
    }
}
