/* Supernodal left-looking L D L^T on Eigen's fixed-size expressions; CHOLMOD has the same scheme (Chen, Davis, Hager,
   Rajamanickam 2008). Each number is summed separately, in ascending order, so vector length, compiler and optimisation
   do not change bits. Eigen's own factorisations are not used: their sums depend on the processor, or they go entry by
   entry. */
#include "../core/kiri_float.h"

#include "kiri_matrix.h"
#include "kiri_product.h"
extern "C" {
#include "../core/kiri_archive.h"
}

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
#include <algorithm>
#include <float.h>
#include <new>
#include <string.h>
#include <vector>

#if defined(__clang__)
#define KIRI_UNROLL _Pragma("unroll")
#elif defined(__GNUC__)
#define KIRI_UNROLL _Pragma("GCC unroll 12")
#else
#define KIRI_UNROLL
#endif

namespace
{

const double LAST_BITS = 8.0 * DBL_EPSILON; /* relative rounding of a few operations */

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

/* Lower block pattern: rows of column c begin at start[c] and ascend, so the diagonal block comes first. */
struct Pattern {
    kiriIndices start, row;
};

/* Supernode: adjacent columns with the same rows below them. Its values are a tall matrix, column by column. The top is
   the lower triangle of a square: L, with D in place of its diagonal of ones. Numbers above D mean nothing. */
struct Panel {
    int32_t column, width; /* first column; count of columns */
    int32_t row, below;    /* into factor.row: rows below the columns, ascending; their count */
    int32_t update;        /* into `updates`: the first one that changes this panel */
    int64_t values;        /* into `factors` */
};

/* Rows of an earlier panel that are columns of this one. */
struct Update {
    int32_t panel, first, count; /* into the panel's rows */
};

} // namespace

/* Rows and columns are positions in the order of unknowns, in blocks. Blocks of the matrix lie column by column, and so
   do the entries of a block. */
struct kiriMatrix {
    kiriMemory* memory;
    int32_t size, count;
    bool usesAvx;
    int64_t products;                 /* of blocks, in a factorisation */
    KIRI_ARRAY(kiriPair) pairs;       /* of the pattern: a < b, ascending */
    kiriIndices order;        /* position of each frame */
    Pattern pattern, factor;          /* of the matrix; of the factor, column by column */
    KIRI_ARRAY(Panel) panels;         /* and one more, where all of them end */
    kiriIndices panelOf;      /* of each column */
    KIRI_ARRAY(Update) updates;
    kiriReals values, factors, right;
    kiriReals scaled, part;          /* scratch: rows of a panel times D; the right side of a panel */
    KIRI_ARRAY(kiriPair) blocks;              /* scratch: column and row of each block */
    kiriIndices child, sibling, mark; /* scratch: the elimination tree; position of a row in a panel */
};

namespace
{

/* ---- Symbolic factorisation ---- */

bool IsBefore(kiriPair one, kiriPair other)
{
    return one.a != other.a ? one.a < other.a : one.b < other.b;
}

kiriPair MakePair(int32_t one, int32_t other)
{
    kiriPair pair = { std::min(one, other), std::max(one, other) };
    return pair;
}

bool ReserveFrames(kiriMatrix* matrix)
{
    kiriMemory* memory = matrix->memory;
    int64_t count = matrix->count;
    return kiriArray_Resize(memory, &matrix->order, count) && kiriArray_Resize(memory, &matrix->child, count) &&
           kiriArray_Resize(memory, &matrix->sibling, count) && kiriArray_Resize(memory, &matrix->mark, count) &&
           kiriArray_Resize(memory, &matrix->panelOf, count) &&
           kiriArray_Resize(memory, &matrix->pattern.start, count + 1) &&
           kiriArray_Resize(memory, &matrix->factor.start, count + 1) &&
           kiriArray_Resize(memory, &matrix->right, count * matrix->size);
}

/* Copies the pairs: each once, the lower frame first, ascending. */
bool SortPairs(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount)
{
    if (!kiriArray_Resize(matrix->memory, &matrix->pairs, pairCount)) {
        return false;
    }
    kiriPair *begin = matrix->pairs.data, *end = begin;
    for (int64_t k = 0; k < pairCount; ++k) {
        kiriPair pair = MakePair(pairs[k].a, pairs[k].b);
        KIRI_ASSERT(pair.a >= 0 && pair.b < matrix->count);
        *end = pair;
        end += pair.a < pair.b;
    }
    std::sort(begin, end, IsBefore);
    end = std::unique(begin, end, [](kiriPair one, kiriPair other) { return !IsBefore(one, other); });
    matrix->pairs.count = (int32_t)(end - begin);
    return true;
}

/* Orders the frames by approximate minimum degree, which keeps the factor sparse. Fails on out of memory. */
bool OrderFrames(kiriMatrix* matrix)
try {
    int32_t count = matrix->count;
    KIRI_SET_ORDERING(true);
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve((size_t)count + 2 * (size_t)matrix->pairs.count);
    for (int32_t f = 0; f < count; ++f) {
        entries.emplace_back(f, f, 1.0);
    }
    for (int32_t k = 0; k < matrix->pairs.count; ++k) {
        kiriPair pair = matrix->pairs.data[k];
        entries.emplace_back(pair.a, pair.b, 1.0);
        entries.emplace_back(pair.b, pair.a, 1.0);
    }
    Eigen::SparseMatrix<double> graph(count, count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(graph, order);
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

bool FillPattern(kiriMatrix* matrix)
{
    Pattern* pattern = &matrix->pattern;
    int32_t count = matrix->count;
    int64_t blockCount = (int64_t)count + matrix->pairs.count;
    if (!kiriArray_Resize(matrix->memory, &matrix->blocks, blockCount) ||
        !kiriArray_Resize(matrix->memory, &pattern->row, blockCount)) {
        return false;
    }
    kiriPair* blocks = matrix->blocks.data;
    for (int32_t c = 0; c < count; ++c) {
        blocks[c] = MakePair(c, c);
    }
    for (int32_t k = 0; k < matrix->pairs.count; ++k) {
        kiriPair pair = matrix->pairs.data[k];
        blocks[count + k] = MakePair(matrix->order.data[pair.a], matrix->order.data[pair.b]);
    }
    std::sort(blocks, blocks + blockCount, IsBefore);
    for (int32_t k = 0; k < pattern->row.count; ++k) {
        if (blocks[k].a == blocks[k].b) {
            pattern->start.data[blocks[k].a] = k;
        }
        pattern->row.data[k] = blocks[k].b;
    }
    pattern->start.data[count] = pattern->row.count;
    return true;
}

/* Adds rows of a column, from c on, that column c of the factor lacks. */
bool AddRows(kiriMatrix* matrix, const Pattern* from, int32_t column, int32_t c)
{
    for (int32_t b = from->start.data[column]; b < from->start.data[column + 1]; ++b) {
        int32_t row = from->row.data[b];
        if (row >= c && matrix->mark.data[row] != c) {
            matrix->mark.data[row] = c;
            if (!kiriArray_Push(matrix->memory, &matrix->factor.row, row)) {
                return false;
            }
        }
    }
    return true;
}

/* Column c of the factor has the rows of the matrix and of the column's children in the elimination tree. A child is a
   column whose first row below the diagonal is c. Fails on out of memory, or on more than `most` blocks. */
bool Eliminate(kiriMatrix* matrix, int64_t most)
{
    Pattern* factor = &matrix->factor;
    int32_t *child = matrix->child.data, *sibling = matrix->sibling.data;
    std::fill(child, child + matrix->count, (int32_t)KIRI_NONE);
    std::fill(matrix->mark.data, matrix->mark.data + matrix->count, (int32_t)KIRI_NONE);
    factor->start.data[0] = factor->row.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = factor->row.count;
        bool isDone = AddRows(matrix, &matrix->pattern, c, c);
        for (int32_t k = child[c]; isDone && k != KIRI_NONE; k = sibling[k]) {
            isDone = AddRows(matrix, factor, k, c);
        }
        if (!isDone || factor->row.count > most) {
            return false;
        }
        std::sort(factor->row.data + first, factor->row.data + factor->row.count);
        KIRI_ASSERT(factor->row.data[first] == c);
        factor->start.data[c + 1] = factor->row.count;
        if (factor->row.count > first + 1) {
            int32_t parent = factor->row.data[first + 1];
            sibling[c] = child[parent];
            child[parent] = c;
        }
    }
    return true;
}

/* Joins a column to the last panel if that panel's rows are this column and its rows. */
bool JoinColumns(kiriMatrix* matrix)
{
    const Pattern* factor = &matrix->factor;
    matrix->panels.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = factor->start.data[c], below = factor->start.data[c + 1] - first - 1;
        Panel* last = matrix->panels.count > 0 ? &matrix->panels.data[matrix->panels.count - 1] : nullptr;
        if (last != nullptr && last->below == below + 1 && factor->row.data[last->row] == c) {
            last->width += 1;
            last->row = first + 1;
            last->below = below;
        } else {
            Panel panel = { c, 1, first + 1, below, 0, 0 };
            if (!kiriArray_Push(matrix->memory, &matrix->panels, panel)) {
                return false;
            }
        }
        matrix->panelOf.data[c] = matrix->panels.count - 1;
    }
    Panel end = { matrix->count, 0, 0, 0, 0, 0 };
    return kiriArray_Push(matrix->memory, &matrix->panels, end);
}

/* Reserves the values. */
bool PlacePanels(kiriMatrix* matrix)
{
    int64_t area = (int64_t)matrix->size * matrix->size, values = 0;
    int32_t highest = 0, widest = 0;
    for (int32_t p = 0; p < matrix->panels.count; ++p) {
        Panel* panel = &matrix->panels.data[p];
        panel->values = values;
        values += area * panel->width * (panel->width + panel->below);
        highest = std::max(highest, panel->width + panel->below);
        widest = std::max(widest, panel->width);
    }
    return kiriArray_Resize(matrix->memory, &matrix->values, area * matrix->pattern.row.count) &&
           kiriArray_Resize(matrix->memory, &matrix->factors, values) &&
           kiriArray_Resize(matrix->memory, &matrix->scaled, area * highest * widest) &&
           kiriArray_Resize(matrix->memory, &matrix->part, (int64_t)matrix->size * highest);
}

/* Calls visit(changed panel, update) for each run of rows of panel p that are columns of one panel. */
template <typename Visit> void VisitUpdates(const kiriMatrix* matrix, int32_t p, Visit visit)
{
    const Panel* panel = &matrix->panels.data[p];
    const int32_t *rows = matrix->factor.row.data + panel->row, *panelOf = matrix->panelOf.data;
    for (int32_t first = 0, end; first < panel->below; first = end) {
        for (end = first + 1; end < panel->below && panelOf[rows[end]] == panelOf[rows[first]];) {
            ++end;
        }
        KIRI_ASSERT(panelOf[rows[first]] > p);
        visit(&matrix->panels.data[panelOf[rows[first]]], Update{ p, first, end - first });
    }
}

/* Lists updates by the panel that they change, then by ascending source. */
bool ListUpdates(kiriMatrix* matrix)
{
    int32_t count = matrix->panels.count, total = 0;
    for (int32_t p = 0; p < count; ++p) {
        VisitUpdates(matrix, p, [](Panel* changed, Update) { changed->update += 1; });
    }
    for (int32_t p = 0; p < count; ++p) {
        total += matrix->panels.data[p].update;
        matrix->panels.data[p].update = total;
    }
    if (!kiriArray_Resize(matrix->memory, &matrix->updates, total)) {
        return false;
    }
    Update* updates = matrix->updates.data;
    for (int32_t p = count - 1; p >= 0; --p) {
        VisitUpdates(matrix, p, [=](Panel* changed, Update update) { updates[--changed->update] = update; });
    }
    return true;
}

/* Shapes the matrix of `pairs`. Fails on out of memory, or on more than `most` blocks of the factor. */
bool ShapePairs(kiriMatrix* matrix, int64_t most)
{
    if (!OrderFrames(matrix) || !FillPattern(matrix) || !Eliminate(matrix, most) || !JoinColumns(matrix) ||
        !PlacePanels(matrix) || !ListUpdates(matrix)) {
        return false;
    }
    matrix->products = 0;
    for (int32_t p = 0; p + 1 < matrix->panels.count; ++p) {
        const Panel* panel = &matrix->panels.data[p];
        for (int32_t n = 0; n < panel->width; ++n) {
            int64_t below = panel->below + n;
            matrix->products += below * (below + 1) / 2;
        }
    }
    return true;
}

} // namespace

extern "C" kiriMatrix* kiriMatrix_Create(kiriMemory* memory, int32_t size)
{
    KIRI_ASSERT(size == 3 || size == 6 || size == 12);
    void* room = kiriMemory_Alloc(memory, (int64_t)sizeof(kiriMatrix));
    if (room == nullptr) {
        return nullptr;
    }
    kiriMatrix* matrix = new (room) kiriMatrix();
    matrix->memory = memory;
    matrix->size = size;
    matrix->usesAvx = kiriProduct_HasAvx();
    return matrix;
}

extern "C" void kiriMatrix_Destroy(kiriMatrix* matrix)
{
    if (matrix != nullptr) {
        void* arrays[] = { &matrix->pairs,       &matrix->order,     &matrix->pattern.start, &matrix->pattern.row,
                           &matrix->factor.start, &matrix->factor.row, &matrix->panels,      &matrix->panelOf,
                           &matrix->updates,     &matrix->values,    &matrix->factors,       &matrix->right,
                           &matrix->scaled,      &matrix->part,      &matrix->blocks,        &matrix->child,
                           &matrix->sibling,     &matrix->mark };
        for (void* array : arrays) {
            kiriArray_Release(matrix->memory, array);
        }
        kiriMemory_Free(matrix->memory, matrix);
    }
}

extern "C" bool kiriMatrix_Shape(kiriMatrix* matrix, int32_t frameCount, const kiriPair* pairs, int64_t pairCount)
{
    matrix->count = frameCount;
    return ReserveFrames(matrix) && SortPairs(matrix, pairs, pairCount) && ShapePairs(matrix, INT64_MAX);
}

extern "C" int32_t kiriMatrix_FrameCount(const kiriMatrix* matrix)
{
    return matrix->count;
}

extern "C" int32_t kiriMatrix_PairCount(const kiriMatrix* matrix)
{
    return matrix->pairs.count;
}

extern "C" void kiriMatrix_GetPairs(const kiriMatrix* matrix, kiriPair* pairs)
{
    std::copy(matrix->pairs.data, matrix->pairs.data + matrix->pairs.count, pairs);
}

extern "C" uint64_t kiriMatrix_Hash(const kiriMatrix* matrix)
{
    uint64_t hash = KIRI_HASH_START;
    kiriHash_Int32(&hash, matrix->count);
    for (int32_t k = 0; k < matrix->pairs.count; ++k) {
        kiriHash_Pair(&hash, matrix->pairs.data[k].a, matrix->pairs.data[k].b);
    }
    return hash;
}

/* ---- Bytes ---- */

/* Pairs are stored as the count of higher partners of each frame, then the partners. A made-up pattern may fill the
   factor: `room` bounds it. */
extern "C" void kiriMatrix_Archive(kiriArchive* archive, kiriMatrix* matrix)
{
    bool reads = kiriArchive_Reads(archive);
    int64_t most = archive->room / ((int64_t)sizeof(double) * matrix->size * matrix->size), total = 0;
    int32_t count = kiriArchive_Count(archive, matrix->count, 0, reads ? archive->room / 256 : INT32_MAX);
    if (count == 0 || kiriArchive_HasFailed(archive)) {
        return;
    }
    if (!reads) { /* threads may write at the same time: into no array of the matrix */
        for (int32_t f = 0, k = 0, first = 0; f < count; ++f, first = k) {
            for (; k < matrix->pairs.count && matrix->pairs.data[k].a == f; ++k) {
            }
            int32_t partners = k - first;
            kiriArchive_Int32(archive, &partners);
        }
        for (int32_t k = 0; k < matrix->pairs.count; ++k) {
            int32_t partner = matrix->pairs.data[k].b;
            kiriArchive_Int32(archive, &partner);
        }
        return;
    }
    matrix->count = count;
    archive->isShort |= !ReserveFrames(matrix);
    if (archive->isShort) {
        return;
    }
    int32_t* partners = matrix->child.data;
    kiriArchive_Numbers(archive, partners, 4, count);
    for (int32_t f = 0; f < count; ++f) {
        kiriArchive_Expect(archive, partners[f] >= 0 && partners[f] < count - f);
        total += partners[f];
    }
    kiriArchive_Expect(archive, total <= most);
    archive->isShort |= !archive->isBad && !kiriArray_Resize(matrix->memory, &matrix->pairs, total);
    kiriPair* pair = matrix->pairs.data;
    for (int32_t f = 0; f < count && !kiriArchive_HasFailed(archive); ++f) {
        for (int32_t last = f, n = 0; n < partners[f]; last = pair->b, ++pair, ++n) {
            pair->a = f;
            kiriArchive_Int32(archive, &pair->b);
            kiriArchive_Expect(archive, pair->b > last && pair->b < count);
        }
    }
    if (!kiriArchive_HasFailed(archive) && !ShapePairs(matrix, most)) {
        bool isTooMuch = matrix->factor.row.count > most;
        kiriArchive_Expect(archive, !isTooMuch);
        archive->isShort |= !isTooMuch;
    }
}

extern "C" int64_t kiriMatrix_ProductCount(const kiriMatrix* matrix)
{
    return matrix->products * matrix->size * matrix->size * matrix->size / 216;
}

extern "C" void kiriMatrix_RefuseAvx(kiriMatrix* matrix)
{
    matrix->usesAvx = false;
}

/* ---- Products ---- */

namespace
{

template <int Rows> using Column = Eigen::Matrix<double, Rows, 1>;
template <int Rows> using Target = Eigen::Map<Column<Rows>>;
template <int Rows> using Source = Eigen::Map<const Column<Rows>>;

/* x.unaryExpr(Times(d)) is d * x. gcc does not inline Eigen's own d * x below kiri_float.h's pragma. */
typedef Eigen::internal::bind1st_op<Eigen::internal::scalar_product_op<double>> Times;

/* Three columns of the product. They have names: an array of them would stay in memory. */
template <int Rows> inline void SubtractTile(const kiriProduct& product, int32_t row, int32_t column)
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

template <int Rows> inline int32_t SubtractTiles(const kiriProduct& product, int32_t row)
{
    for (; row + Rows <= product.rows; row += Rows) {
        for (int32_t c = 0; c < product.columns; c += 3) {
            SubtractTile<Rows>(product, row, c);
        }
    }
    return row;
}

inline void SubtractProduct(const kiriMatrix* matrix, const kiriProduct& product)
{
    KIRI_ASSERT(product.rows % 3 == 0 && product.columns % 3 == 0);
    if (matrix->usesAvx) {
        kiriProduct_SubtractByAvx(&product);
    } else {
        int32_t row = TALL > 6 ? SubtractTiles<TALL>(product, 0) : 0;
        SubtractTiles<3>(product, SubtractTiles<6>(product, row));
    }
}

/* ---- Entries ---- */

/* Returns the index of the block of two positions; KIRI_NONE if the pattern lacks it. */
inline int32_t FindBlock(const kiriMatrix* matrix, int32_t a, int32_t b)
{
    int32_t row = std::max(a, b), column = std::min(a, b);
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
    kiriProduct product = { nullptr, nullptr, scaled, Size, stride, Size, Size, Size, rows };
    for (int32_t a = 0; a < count; ++a) {
        int32_t row = matrix->order.data[frames[a]];
        if (row >= column) {
            product.out = BlockOf(matrix, FindBlock(matrix, row, column));
            product.a = J + Size * a;
            SubtractProduct(matrix, product);
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
    std::fill(matrix->values.data, matrix->values.data + matrix->values.count, 0.0);
}

extern "C" void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block)
{
    KIRI_ASSERT_HAS(*matrix, frame);
    double* out = DiagonalBlockOf(matrix, matrix->order.data[frame]);
    for (int32_t n = 0; n < matrix->size * matrix->size; ++n) {
        out[n] += block[n];
    }
}

extern "C" void kiriMatrix_GetBlock(const kiriMatrix* matrix, int32_t down, int32_t across, double* block)
{
    int32_t size = matrix->size, row = matrix->order.data[down], column = matrix->order.data[across];
    const double* values = BlockOf(matrix, FindBlock(matrix, row, column));
    for (int32_t c = 0; c < size; ++c) {
        for (int32_t r = 0; r < size; ++r) {
            block[size * c + r] = row < column ? values[size * r + c] : values[size * c + r];
        }
    }
}

extern "C" void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                                      const double* k, int32_t rows)
{
    for (int32_t e = 0; e < rows; e += MOST_ROWS) {
        const double* part = J + (ptrdiff_t)matrix->size * frameCount * e;
        int32_t some = std::min(rows - e, (int32_t)MOST_ROWS);
        for (int32_t b = 0; b < frameCount; ++b) {
            WithSize(matrix,
                     [=](auto size) { AddSquareColumn<size.value>(matrix, frames, frameCount, part, k + e, some, b); });
        }
    }
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
void StartPanel(kiriMatrix* matrix, const Panel* panel)
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
void SubtractColumns(kiriMatrix* matrix, const Panel* panel, const Update* update, int32_t k, kiriProduct product)
{
    int32_t size = matrix->size;
    const Panel* from = &matrix->panels.data[update->panel];
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
void UpdatePanel(kiriMatrix* matrix, const Panel* panel, const Update* update)
{
    int32_t size = matrix->size;
    const Panel* from = &matrix->panels.data[update->panel];
    int32_t width = size * from->width, height = width + size * from->below, count = size * update->count;
    ScaleRows(matrix->factors.data + from->values, height, 0, width, size * (from->width + update->first), count,
              matrix->scaled.data);
    for (int32_t k = 0; k < width; k += MOST_COLUMNS) {
        int32_t depth = std::min(width - k, (int32_t)MOST_COLUMNS);
        int32_t target = size * (panel->width + panel->below);
        kiriProduct product = { nullptr, nullptr, nullptr, target, height, count, 0, size, depth };
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
    kiriProduct product = { out, from + c, matrix->scaled.data, height, height, size, height - c, size, last - first };
    ScaleRows(from, height, first, last - first, c, size, matrix->scaled.data);
    SubtractProduct(matrix, product);
}

/* Factors block column by block column. MOST_COLUMNS are subtracted from all later columns at once, while they are in
   the cache. */
template <int Size> bool FactorPanel(kiriMatrix* matrix, const Panel* panel)
{
    int32_t height = Size * (panel->width + panel->below), width = Size * panel->width;
    double* values = matrix->factors.data + panel->values;
    for (int32_t first = 0, last; first < width; first = last) {
        last = std::min(first + (int32_t)MOST_COLUMNS, width);
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
    for (int32_t p = 0; p + 1 < matrix->panels.count; ++p) {
        const Panel* panel = &matrix->panels.data[p];
        StartPanel(matrix, panel);
        for (int32_t n = panel->update; n < panel[1].update; ++n) {
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
            block[(matrix->size + 1) * n] *= 1.0 + LAST_BITS;
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
    for (int32_t p = 0; p + 1 < matrix->panels.count; ++p) {
        const Panel* panel = &matrix->panels.data[p];
        const int32_t width = Size * panel->width, *rows = matrix->factor.row.data + panel->row;
        CopyNumbers(part, all + Size * panel->column, width);
        memset(part + width, 0, sizeof(double) * (size_t)(Size * panel->below));
        SolvePanelDown(matrix->factors.data + panel->values, width + Size * panel->below, width, part);
        CopyNumbers(all + Size * panel->column, part, width);
        for (int32_t n = 0; n < panel->below; ++n) {
            Target<Size>(all + Size * rows[n]) += Source<Size>(part + width + Size * n);
        }
    }
    for (int32_t p = matrix->panels.count - 2; p >= 0; --p) {
        const Panel* panel = &matrix->panels.data[p];
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
