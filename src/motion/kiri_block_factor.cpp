/* The only file that knows Eigen: its order of unknowns that keeps a factor sparse, and its small vectors. The Cholesky
   factorisation is our own, for Eigen's goes entry by entry: blocks whose size the compiler knows take a fraction of
   the time, and their memory is the host's. Vectors are only scaled and added, in a fixed order: the same bits
   everywhere. */

/* Before our own headers, which include C's headers as C. */
#include <Eigen/Sparse>
#include <algorithm>
#include <cfloat>
#include <new>
#include <vector>

#include "kiri_block_factor.h"
extern "C" {
#include "../core/kiri_array.h"
#include "../core/kiri_hash.h"
}

namespace
{

const double LAST_BITS = 8.0 * DBL_EPSILON; /* of an entry: what a few operations round off */

/* Which blocks there are on and below the diagonal: the rows of column c are those from start[c] on, ascending, so that
   the diagonal block comes first. */
struct Pattern {
    KIRI_ARRAY(int32_t) start, row;
};

/* A block of the factor left of the diagonal, and its column. */
struct Left {
    int32_t block, column;
};

} // namespace

/* Frames have places in the order of unknowns; rows and columns are places. Blocks lie one after the other, column by
   column, and so do the entries of a block. With ones on the diagonal of L, matrix = L D L^T; in a factor's diagonal
   block D stands on the diagonal, and what is above it means nothing. */
struct kiriMatrix {
    kiriMemory* memory;
    int32_t size, count;
    KIRI_ARRAY(int32_t) place; /* of a frame */
    Pattern own, factor;
    KIRI_ARRAY(int32_t) source;    /* what a block of the factor starts from: a block of the matrix, or KIRI_NONE */
    KIRI_ARRAY(int32_t) leftStart; /* of each row */
    KIRI_ARRAY(Left) left;
    KIRI_ARRAY(double) values, factors, right;
    KIRI_ARRAY(int64_t) keys;                 /* scratch: blocks to be sorted */
    KIRI_ARRAY(int32_t) child, sibling, mark; /* scratch: the elimination tree; a column's mark on its rows */
};

namespace
{

/* ---- Pattern ---- */

/* An order of the frames that keeps the factor sparse. */
void PlaceFrames(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount)
{
    int32_t count = matrix->count;
    std::vector<Eigen::Triplet<double>> entries;
    for (int32_t f = 0; f < count; ++f) {
        entries.push_back(Eigen::Triplet<double>(f, f, 1.0));
    }
    for (int64_t k = 0; k < pairCount; ++k) {
        KIRI_ASSERT(pairs[k].a >= 0 && pairs[k].a < count && pairs[k].b >= 0 && pairs[k].b < count);
        entries.push_back(Eigen::Triplet<double>(pairs[k].a, pairs[k].b, 1.0));
        entries.push_back(Eigen::Triplet<double>(pairs[k].b, pairs[k].a, 1.0));
    }
    Eigen::SparseMatrix<double> graph(count, count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(graph, order);
    for (int32_t place = 0; place < count; ++place) {
        matrix->place.data[order.indices()[place]] = place;
    }
}

bool PlaceBlocks(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount)
{
    Pattern* own = &matrix->own;
    const int32_t* place = matrix->place.data;
    if (!kiriArray_Resize(matrix->memory, &matrix->keys, matrix->count + pairCount) ||
        !kiriArray_Reserve(matrix->memory, &own->row, matrix->count + pairCount)) {
        return false;
    }
    int64_t *keys = matrix->keys.data, *end = keys;
    for (int32_t c = 0; c < matrix->count; ++c) {
        *end++ = ((int64_t)c << 32) + c;
    }
    for (int64_t k = 0; k < pairCount; ++k) {
        int32_t a = place[pairs[k].a], b = place[pairs[k].b];
        *end++ = ((int64_t)std::min(a, b) << 32) + std::max(a, b);
    }
    std::sort(keys, end);
    end = std::unique(keys, end);
    own->row.count = 0;
    for (const int64_t* key = keys; key != end; ++key) {
        int32_t column = (int32_t)(*key >> 32), row = (int32_t)(*key & INT32_MAX);
        if (row == column) {
            own->start.data[column] = own->row.count;
        }
        own->row.data[own->row.count++] = row;
    }
    own->start.data[matrix->count] = own->row.count;
    return true;
}

/* Adds the rows of a column, from `first` on, that the factor's column c does not have yet. */
bool AddRows(kiriMatrix* matrix, const Pattern* from, int32_t column, int32_t c)
{
    Pattern* factor = &matrix->factor;
    for (int32_t b = from->start.data[column]; b < from->start.data[column + 1]; ++b) {
        int32_t row = from->row.data[b];
        if (row >= c && matrix->mark.data[row] != c) {
            matrix->mark.data[row] = c;
            if (!kiriArray_Push(matrix->memory, &factor->row, row)) {
                return false;
            }
        }
    }
    return true;
}

/* A column of the factor has the rows of the matrix, and those of its children in the elimination tree: the columns
   whose first row below the diagonal it is. */
bool Eliminate(kiriMatrix* matrix)
{
    Pattern* factor = &matrix->factor;
    int32_t *child = matrix->child.data, *sibling = matrix->sibling.data;
    std::fill(child, child + matrix->count, (int32_t)KIRI_NONE);
    std::fill(matrix->mark.data, matrix->mark.data + matrix->count, (int32_t)KIRI_NONE);
    factor->start.data[0] = factor->row.count = 0;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = factor->row.count;
        bool ok = AddRows(matrix, &matrix->own, c, c);
        for (int32_t k = child[c]; ok && k != KIRI_NONE; k = sibling[k]) {
            ok = AddRows(matrix, factor, k, c);
        }
        if (!ok) {
            return false;
        }
        std::sort(factor->row.data + first, factor->row.data + factor->row.count);
        factor->start.data[c + 1] = factor->row.count;
        if (factor->row.count > first + 1) {
            int32_t parent = factor->row.data[first + 1];
            sibling[c] = child[parent];
            child[parent] = c;
        }
    }
    return true;
}

/* The rows of the factor, by the columns that they have blocks in. */
void CollectLeft(kiriMatrix* matrix)
{
    const Pattern* factor = &matrix->factor;
    int32_t *start = matrix->leftStart.data, count = matrix->count;
    std::fill(start, start + count + 1, 0);
    for (int32_t b = 0; b < factor->row.count; ++b) {
        ++start[factor->row.data[b]];
    }
    for (int32_t r = 0, sum = 0; r < count; ++r) {
        sum += start[r] - 1; /* not the diagonal block */
        start[r] = sum;
    }
    start[count] = factor->row.count - count;
    for (int32_t c = count - 1; c >= 0; --c) {
        for (int32_t b = factor->start.data[c] + 1; b < factor->start.data[c + 1]; ++b) {
            Left left = { b, c };
            matrix->left.data[--start[factor->row.data[b]]] = left;
        }
    }
}

void FindSources(kiriMatrix* matrix)
{
    const Pattern *own = &matrix->own, *factor = &matrix->factor;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t from = own->start.data[c], end = own->start.data[c + 1];
        for (int32_t b = factor->start.data[c]; b < factor->start.data[c + 1]; ++b) {
            bool isOwn = from < end && own->row.data[from] == factor->row.data[b];
            matrix->source.data[b] = isOwn ? from++ : (int32_t)KIRI_NONE;
        }
    }
}

bool MakeRoomForFrames(kiriMatrix* matrix)
{
    kiriMemory* memory = matrix->memory;
    int64_t count = matrix->count;
    return kiriArray_Resize(memory, &matrix->place, count) && kiriArray_Resize(memory, &matrix->child, count) &&
           kiriArray_Resize(memory, &matrix->sibling, count) && kiriArray_Resize(memory, &matrix->mark, count) &&
           kiriArray_Resize(memory, &matrix->own.start, count + 1) &&
           kiriArray_Resize(memory, &matrix->factor.start, count + 1) &&
           kiriArray_Resize(memory, &matrix->leftStart, count + 1) &&
           kiriArray_Resize(memory, &matrix->right, count * matrix->size);
}

bool MakeRoomForBlocks(kiriMatrix* matrix)
{
    kiriMemory* memory = matrix->memory;
    int64_t area = (int64_t)matrix->size * matrix->size;
    int64_t own = matrix->own.row.count, factor = matrix->factor.row.count;
    return area * factor <= INT32_MAX && kiriArray_Resize(memory, &matrix->source, factor) &&
           kiriArray_Resize(memory, &matrix->left, factor - matrix->count) &&
           kiriArray_Resize(memory, &matrix->values, area * own) &&
           kiriArray_Resize(memory, &matrix->factors, area * factor);
}

/* ---- Entries ---- */

/* The block (row, column) of the matrix, row >= column; KIRI_NONE where there is none. */
int32_t BlockAt(const kiriMatrix* matrix, int32_t row, int32_t column)
{
    const int32_t *rows = matrix->own.row.data, *end = rows + matrix->own.start.data[column + 1];
    const int32_t* at = std::lower_bound(rows + matrix->own.start.data[column], end, row);
    return at != end && *at == row ? (int32_t)(at - rows) : (int32_t)KIRI_NONE;
}

/* A column of a block: the compiler knows how long it is. */
template <int size> using Column = Eigen::Matrix<double, size, 1>;
template <int size> using In = Eigen::Map<const Column<size>>;
template <int size> using Out = Eigen::Map<Column<size>>;

/* What one element adds, J^T k J: rows of J, `stride` apart, and the stiffness k of each. */
struct Squares {
    const double* J;
    const double* k;
    int32_t rows, stride;
};

/* Columns that are summed together: a short one by itself would wait for each of its additions, and long ones together
   would find no registers. */
template <int size> struct Wide {
    enum { count = size == 6 ? 2 : 1 };
    typedef Eigen::Matrix<double, size, count> Columns;
};

/* Adds the block of frames number a and b of the element, a's unknowns down. */
template <int size> void AddBlock(double* block, const Squares& s, int32_t a, int32_t b)
{
    for (int32_t c = 0; c < size; c += Wide<size>::count) {
        typename Wide<size>::Columns sum = Wide<size>::Columns::Zero();
        for (int32_t e = 0; e < s.rows; ++e) {
            const double* J = s.J + e * s.stride;
            const double *across = J + size * b + c, *last = across + Wide<size>::count - 1;
            if (*across == 0.0 && *last == 0.0) {
                continue; /* half of the strains of rigid frames do not see them move */
            }
            In<size> down(J + size * a);
            for (int32_t n = 0; n < Wide<size>::count; ++n) {
                sum.col(n) += (s.k[e] * across[n]) * down;
            }
        }
        Eigen::Map<typename Wide<size>::Columns>(block + size * c) += sum;
    }
}

/* The same for two rows, which stay in registers. */
template <int size> void AddBlockOfTwo(double* block, const Squares& s, int32_t a, int32_t b)
{
    const double *first = s.J + size * b, *second = first + s.stride;
    const Column<size> downFirst = In<size>(s.J + size * a), downSecond = In<size>(s.J + size * a + s.stride);
    for (int32_t c = 0; c < size; ++c) {
        Out<size>(block + size * c) += (s.k[0] * first[c]) * downFirst + (s.k[1] * second[c]) * downSecond;
    }
}

template <int size> void AddBlocks(kiriMatrix* matrix, const Squares& squares, const int32_t* frames, int32_t count)
{
    for (int32_t b = 0; b < count; ++b) {
        for (int32_t a = 0; a < count; ++a) {
            int32_t row = matrix->place.data[frames[a]], column = matrix->place.data[frames[b]];
            if (row >= column) {
                int32_t block = BlockAt(matrix, row, column);
                KIRI_ASSERT(block != KIRI_NONE);
                double* values = &matrix->values.data[(int64_t)size * size * block];
                squares.rows == 2 ? AddBlockOfTwo<size>(values, squares, a, b) : AddBlock<size>(values, squares, a, b);
            }
        }
    }
}

/* Where springs are stiffer than inertia by more than the digits of a double, elimination cancels what the inertia put
   on the diagonal, and rounding decides the sign. An addition of the size of what is rounded off makes the matrix
   positive; such a light sheet then falls too slowly. */
void ShiftDiagonal(kiriMatrix* matrix)
{
    int32_t size = matrix->size;
    for (int32_t c = 0; c < matrix->count; ++c) {
        double* block = &matrix->values.data[(int64_t)size * size * matrix->own.start.data[c]];
        for (int32_t n = 0; n < size; ++n) {
            block[(size + 1) * n] *= 1.0 + LAST_BITS;
        }
    }
}

/* ---- Factorisation ---- */

/* out -= a b^T */
template <int size> void SubtractProduct(double* out, const double* a, const double* b)
{
    typedef typename Wide<size>::Columns Columns;
    for (int32_t c = 0; c < size; c += Wide<size>::count) {
        Columns sum = Eigen::Map<const Columns>(out + size * c);
        for (int32_t m = 0; m < size; ++m) {
            In<size> column(a + size * m);
            for (int32_t n = 0; n < Wide<size>::count; ++n) {
                sum.col(n) -= b[size * m + c + n] * column;
            }
        }
        Eigen::Map<Columns>(out + size * c) = sum;
    }
}

/* Of a diagonal block, with the inverses of D. False where it is not positive definite. */
template <int size> bool FactorBlock(double* block, double* inverse)
{
    for (int32_t m = 0; m < size; ++m) {
        double d = block[(size + 1) * m];
        if (!(d > 0.0)) {
            return false;
        }
        inverse[m] = 1.0 / d;
        for (int32_t c = m + 1; c < size; ++c) {
            double l = inverse[m] * block[size * m + c];
            for (int32_t r = c; r < size; ++r) {
                block[size * c + r] -= l * block[size * m + r];
            }
        }
        for (int32_t r = m + 1; r < size; ++r) {
            block[size * m + r] *= inverse[m];
        }
    }
    return true;
}

/* What is below the diagonal: block (L D)^-T */
template <int size> void DivideBlock(double* block, const double* diagonal, const double* inverse)
{
    for (int32_t m = 0; m < size; ++m) {
        Column<size> column = Out<size>(block + size * m);
        for (int32_t n = 0; n < m; ++n) {
            column -= diagonal[size * n + m] * In<size>(block + size * n);
        }
        Out<size>(block + size * m) = column;
    }
    for (int32_t m = 0; m < size; ++m) {
        Out<size>(block + size * m) *= inverse[m];
    }
}

template <int size> void StartColumn(kiriMatrix* matrix, int32_t column)
{
    const int64_t area = size * size;
    for (int32_t b = matrix->factor.start.data[column]; b < matrix->factor.start.data[column + 1]; ++b) {
        double* out = &matrix->factors.data[area * b];
        int32_t source = matrix->source.data[b];
        matrix->mark.data[matrix->factor.row.data[b]] = b;
        if (source != KIRI_NONE) {
            std::copy(&matrix->values.data[area * source], &matrix->values.data[area * source] + area, out);
        } else {
            std::fill(out, out + area, 0.0);
        }
    }
}

/* Takes off what the columns before it put into the column. */
template <int size> void UpdateColumn(kiriMatrix* matrix, int32_t column)
{
    const int64_t area = size * size;
    double* factors = matrix->factors.data;
    for (int32_t k = matrix->leftStart.data[column]; k < matrix->leftStart.data[column + 1]; ++k) {
        Left left = matrix->left.data[k];
        const double* diagonal = &factors[area * matrix->factor.start.data[left.column]];
        double scaled[size * size]; /* times D */
        for (int32_t m = 0; m < size; ++m) {
            Out<size>(scaled + size * m) = diagonal[(size + 1) * m] * In<size>(&factors[area * left.block + size * m]);
        }
        for (int32_t b = left.block; b < matrix->factor.start.data[left.column + 1]; ++b) {
            double* out = &factors[area * matrix->mark.data[matrix->factor.row.data[b]]];
            SubtractProduct<size>(out, &factors[area * b], scaled);
        }
    }
}

template <int size> bool FactorAll(kiriMatrix* matrix)
{
    const int64_t area = size * size;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = matrix->factor.start.data[c], end = matrix->factor.start.data[c + 1];
        double* diagonal = &matrix->factors.data[area * first];
        StartColumn<size>(matrix, c);
        UpdateColumn<size>(matrix, c);
        double inverse[size];
        if (!FactorBlock<size>(diagonal, inverse)) {
            return false;
        }
        for (int32_t b = first + 1; b < end; ++b) {
            DivideBlock<size>(&matrix->factors.data[area * b], diagonal, inverse);
        }
    }
    return true;
}

/* L y = right in place, then y / D. */
template <int size> void SolveDown(kiriMatrix* matrix, double* right)
{
    const int64_t area = size * size;
    for (int32_t c = 0; c < matrix->count; ++c) {
        int32_t first = matrix->factor.start.data[c], end = matrix->factor.start.data[c + 1];
        const double* diagonal = &matrix->factors.data[area * first];
        double* y = right + size * c;
        for (int32_t m = 0; m < size; ++m) {
            for (int32_t r = m + 1; r < size; ++r) {
                y[r] -= diagonal[size * m + r] * y[m];
            }
        }
        for (int32_t b = first + 1; b < end; ++b) {
            const double* block = &matrix->factors.data[area * b];
            Out<size> below(right + size * matrix->factor.row.data[b]);
            for (int32_t m = 0; m < size; ++m) {
                below -= y[m] * In<size>(block + size * m);
            }
        }
        for (int32_t m = 0; m < size; ++m) {
            y[m] /= diagonal[(size + 1) * m];
        }
    }
}

/* L^T x = y in place. */
template <int size> void SolveUp(kiriMatrix* matrix, double* y)
{
    const int64_t area = size * size;
    for (int32_t c = matrix->count - 1; c >= 0; --c) {
        int32_t first = matrix->factor.start.data[c], end = matrix->factor.start.data[c + 1];
        const double* diagonal = &matrix->factors.data[area * first];
        double* x = y + size * c;
        for (int32_t b = first + 1; b < end; ++b) {
            const double *block = &matrix->factors.data[area * b], *below = y + size * matrix->factor.row.data[b];
            for (int32_t m = 0; m < size; ++m) {
                double sum = 0.0;
                for (int32_t r = 0; r < size; ++r) {
                    sum += block[size * m + r] * below[r];
                }
                x[m] -= sum;
            }
        }
        for (int32_t m = size - 1; m >= 0; --m) {
            for (int32_t r = m + 1; r < size; ++r) {
                x[m] -= diagonal[size * m + r] * x[r];
            }
        }
    }
}

bool FactorOnce(kiriMatrix* matrix)
{
    return matrix->size == 3 ? FactorAll<3>(matrix) : matrix->size == 6 ? FactorAll<6>(matrix) : FactorAll<12>(matrix);
}

template <int size> void SolveBoth(kiriMatrix* matrix)
{
    SolveDown<size>(matrix, matrix->right.data);
    SolveUp<size>(matrix, matrix->right.data);
}

} // namespace

extern "C" kiriMatrix* kiriMatrix_Create(kiriMemory* memory, int32_t size)
{
    void* room = kiriMemory_Alloc(memory, (int64_t)sizeof(kiriMatrix));
    if (room == NULL) {
        return NULL;
    }
    kiriMatrix* matrix = new (room) kiriMatrix();
    matrix->memory = memory;
    matrix->size = size;
    return matrix;
}

extern "C" bool kiriMatrix_Shape(kiriMatrix* matrix, int32_t frameCount, const kiriPair* pairs, int64_t pairCount)
{
    matrix->count = frameCount;
    if (!MakeRoomForFrames(matrix)) {
        return false;
    }
    try {
        PlaceFrames(matrix, pairs, pairCount);
    } catch (...) {
        return false;
    }
    if (!PlaceBlocks(matrix, pairs, pairCount) || !Eliminate(matrix) || !MakeRoomForBlocks(matrix)) {
        return false;
    }
    CollectLeft(matrix);
    FindSources(matrix);
    return true;
}

extern "C" int32_t kiriMatrix_FrameCount(const kiriMatrix* matrix)
{
    return matrix->count;
}

extern "C" int32_t kiriMatrix_PairCount(const kiriMatrix* matrix)
{
    return matrix->own.row.count - matrix->count;
}

extern "C" void kiriMatrix_GetPairs(kiriMatrix* matrix, kiriPair* pairs)
{
    int32_t* frameAt = matrix->child.data; /* of each place */
    for (int32_t f = 0; f < matrix->count; ++f) {
        frameAt[matrix->place.data[f]] = f;
    }
    for (int32_t c = 0; c < matrix->count; ++c) {
        for (int32_t b = matrix->own.start.data[c] + 1; b < matrix->own.start.data[c + 1]; ++b) {
            kiriPair pair = { frameAt[c], frameAt[matrix->own.row.data[b]] };
            *pairs++ = pair;
        }
    }
}

extern "C" bool kiriMatrix_Covers(const kiriMatrix* matrix, kiriPair pair)
{
    KIRI_ASSERT(pair.a >= 0 && pair.a < matrix->count && pair.b >= 0 && pair.b < matrix->count);
    int32_t a = matrix->place.data[pair.a], b = matrix->place.data[pair.b];
    return BlockAt(matrix, std::max(a, b), std::min(a, b)) != KIRI_NONE;
}

extern "C" uint64_t kiriMatrix_Hash(const kiriMatrix* matrix)
{
    uint64_t hash = KIRI_HASH_START;
    for (int32_t f = 0; f < matrix->count; ++f) {
        kiriHash_Word(&hash, (uint64_t)matrix->place.data[f]);
    }
    for (int32_t b = 0; matrix->count > 0 && b < matrix->own.row.count; ++b) {
        kiriHash_Word(&hash, (uint64_t)matrix->own.row.data[b]);
    }
    return hash;
}

extern "C" void kiriMatrix_Clear(kiriMatrix* matrix)
{
    std::fill(matrix->values.data, matrix->values.data + matrix->values.count, 0.0);
}

extern "C" void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block)
{
    KIRI_ASSERT(frame >= 0 && frame < matrix->count);
    int32_t area = matrix->size * matrix->size;
    double* out = &matrix->values.data[(int64_t)area * matrix->own.start.data[matrix->place.data[frame]]];
    for (int32_t n = 0; n < area; ++n) {
        out[n] += block[n];
    }
}

extern "C" void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                                      const double* k, int32_t rows)
{
    const Squares squares = { J, k, rows, matrix->size * frameCount };
    matrix->size == 3   ? AddBlocks<3>(matrix, squares, frames, frameCount)
    : matrix->size == 6 ? AddBlocks<6>(matrix, squares, frames, frameCount)
                        : AddBlocks<12>(matrix, squares, frames, frameCount);
}

extern "C" bool kiriMatrix_Factor(kiriMatrix* matrix)
{
    if (FactorOnce(matrix)) {
        return true;
    }
    ShiftDiagonal(matrix);
    return FactorOnce(matrix);
}

extern "C" void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution)
{
    int32_t size = matrix->size;
    for (int32_t f = 0; f < matrix->count; ++f) {
        std::copy(right + size * f, right + size * (f + 1), matrix->right.data + size * matrix->place.data[f]);
    }
    matrix->size == 3 ? SolveBoth<3>(matrix) : matrix->size == 6 ? SolveBoth<6>(matrix) : SolveBoth<12>(matrix);
    for (int32_t f = 0; f < matrix->count; ++f) {
        const double* from = matrix->right.data + size * matrix->place.data[f];
        std::copy(from, from + size, solution + size * f);
    }
}
