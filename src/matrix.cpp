/* The only file that knows Eigen: its sparse Cholesky, of the upper triangle, with an order of unknowns that we choose. */

/* Before our own header, which includes C's headers as C. */
#include <Eigen/Sparse>
#include <algorithm>
#include <cfloat>
#include <new>
#include <vector>

#include "matrix.h"

namespace
{

typedef Eigen::SparseMatrix<double> Matrix;

const double LAST_BITS = 8.0 * DBL_EPSILON; /* of an entry: what a few operations round off */

/* Eigen's factorisation of the upper triangle, in our own order of unknowns: so it takes the matrix as it is, without a
   copy, and allocates nothing once it is analysed. */
class Factor : public Eigen::SimplicialLDLT<Matrix, Eigen::Upper, Eigen::NaturalOrdering<int>>
{
  public:
    void Analyze(const Matrix& matrix)
    {
        this->analyzePattern_preordered(matrix, true);
    }
    bool Factorize(const Matrix& matrix)
    {
        this->template factorize_preordered<true>(matrix);
        return info() == Eigen::Success && this->m_diag.size() > 0 && this->m_diag.minCoeff() > 0.0;
    }
};

} // namespace

struct kiriMatrix {
    kiriMemory memory;
    int32_t size;
    std::vector<int32_t> place;              /* a frame's place in the order of unknowns */
    std::vector<std::vector<int32_t>> above; /* of each block column: its block rows above the diagonal, ascending */
    Matrix values;
    Factor factor;
    Eigen::VectorXd right, solution; /* in the order of unknowns */

    /* The rows of block (row, column), row <= column, in one of its columns. */
    double* Block(int32_t row, int32_t column, int32_t inner)
    {
        const std::vector<int32_t>& rows = above[column];
        size_t block = row == column ? rows.size() : std::lower_bound(rows.begin(), rows.end(), row) - rows.begin();
        return values.valuePtr() + values.outerIndexPtr()[size * column + inner] + size * block;
    }
};

namespace
{

typedef std::vector<Eigen::Triplet<double>> Entries;

/* Where springs are stiffer than inertia by more than doubles tell apart, elimination cancels what the inertia put on
   the diagonal, and rounding decides the sign. An addition of the size of what is rounded off makes the matrix
   positive; so light a sheet then falls too slowly. */
void ShiftDiagonal(kiriMatrix* matrix)
{
    for (Eigen::Index c = 0; c < matrix->values.cols(); ++c) {
        matrix->values.valuePtr()[matrix->values.outerIndexPtr()[c + 1] - 1] *= 1.0 + LAST_BITS;
    }
}

/* An order of the frames that keeps the factor sparse. */
void PlaceFrames(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount)
{
    int32_t count = (int32_t)matrix->place.size();
    Entries entries;
    for (int32_t f = 0; f < count; ++f) {
        entries.push_back(Eigen::Triplet<double>(f, f, 1.0));
    }
    for (int64_t k = 0; k < pairCount; ++k) {
        entries.push_back(Eigen::Triplet<double>(pairs[k].a, pairs[k].b, 1.0));
        entries.push_back(Eigen::Triplet<double>(pairs[k].b, pairs[k].a, 1.0));
    }
    Matrix graph(count, count);
    graph.setFromTriplets(entries.begin(), entries.end());
    Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
    Eigen::AMDOrdering<int>()(graph, order);
    for (int32_t place = 0; place < count; ++place) {
        matrix->place[order.indices()[place]] = place;
    }
}

void PlaceBlocks(kiriMatrix* matrix, const kiriPair* pairs, int64_t pairCount)
{
    for (int64_t k = 0; k < pairCount; ++k) {
        int32_t a = matrix->place[pairs[k].a], b = matrix->place[pairs[k].b];
        if (a != b) {
            matrix->above[std::max(a, b)].push_back(std::min(a, b));
        }
    }
    for (std::vector<int32_t>& rows : matrix->above) {
        std::sort(rows.begin(), rows.end());
        rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    }
}

/* In each column the blocks above the diagonal, then the upper triangle of the diagonal block. */
void MakePattern(kiriMatrix* matrix)
{
    int32_t size = matrix->size, unknowns = size * (int32_t)matrix->place.size();
    Entries entries;
    for (int32_t c = 0; c < unknowns; ++c) {
        for (int32_t row : matrix->above[c / size]) {
            for (int32_t r = size * row; r < size * row + size; ++r) {
                entries.push_back(Eigen::Triplet<double>(r, c, 0.0));
            }
        }
        for (int32_t r = c - c % size; r <= c; ++r) {
            entries.push_back(Eigen::Triplet<double>(r, c, r == c ? 1.0 : 0.0));
        }
    }
    matrix->values.resize(unknowns, unknowns);
    matrix->values.setFromTriplets(entries.begin(), entries.end());
    matrix->factor.Analyze(matrix->values);
    matrix->right.setZero(unknowns);
    matrix->solution.setZero(unknowns);
}

/* One element: its derivatives, and the springs between them. */
struct Squares {
    const double* J;
    const double* k;
    int32_t rows, stride;
};

/* The block of frames number a and b of the element, a's unknowns down. The size is known to the compiler, for
   speed. */
template <int size>
void AddBlock(kiriMatrix* matrix, const Squares& s, int32_t a, int32_t row, int32_t b, int32_t column)
{
    for (int32_t c = 0; c < size; ++c) {
        double sum[size] = { 0.0 };
        for (int32_t e = 0; e < s.rows; ++e) {
            const double* J = s.J + e * s.stride;
            double pull = s.k[e] * J[size * b + c];
            for (int32_t r = 0; r < size; ++r) {
                sum[r] += pull * J[size * a + r];
            }
        }
        double* out = matrix->Block(row, column, c);
        int32_t count = row == column ? c + 1 : size;
        for (int32_t r = 0; r < count; ++r) {
            out[r] += sum[r];
        }
    }
}

template <int size> void AddBlocks(kiriMatrix* matrix, const Squares& squares, const int32_t* frames, int32_t count)
{
    for (int32_t b = 0; b < count; ++b) {
        for (int32_t a = 0; a < count; ++a) {
            int32_t row = matrix->place[frames[a]], column = matrix->place[frames[b]];
            if (row <= column) {
                AddBlock<size>(matrix, squares, a, row, b, column);
            }
        }
    }
}

} // namespace

extern "C" kiriMatrix* kiriMatrix_Create(const kiriMemory* memory, int32_t size, int32_t frameCount,
                                         const kiriPair* pairs, int64_t pairCount)
{
    void* room = kiriMemory_Alloc(memory, (int64_t)sizeof(kiriMatrix));
    if (room == NULL) {
        return NULL;
    }
    kiriMatrix* matrix = NULL;
    try {
        matrix = new (room) kiriMatrix();
        matrix->memory = *memory;
        matrix->size = size;
        matrix->place.resize(frameCount);
        matrix->above.resize(frameCount);
        PlaceFrames(matrix, pairs, pairCount);
        PlaceBlocks(matrix, pairs, pairCount);
        MakePattern(matrix);
        return matrix;
    } catch (...) {
        if (matrix != NULL) {
            matrix->~kiriMatrix();
        }
        kiriMemory_Free(memory, room);
        return NULL;
    }
}

extern "C" void kiriMatrix_Destroy(kiriMatrix* matrix)
{
    if (matrix != NULL) {
        kiriMemory memory = matrix->memory;
        matrix->~kiriMatrix();
        kiriMemory_Free(&memory, matrix);
    }
}

extern "C" void kiriMatrix_Clear(kiriMatrix* matrix)
{
    std::fill(matrix->values.valuePtr(), matrix->values.valuePtr() + matrix->values.nonZeros(), 0.0);
}

extern "C" void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block)
{
    int32_t place = matrix->place[frame];
    for (int32_t c = 0; c < matrix->size; ++c) {
        double* out = matrix->Block(place, place, c);
        for (int32_t r = 0; r <= c; ++r) {
            out[r] += block[matrix->size * c + r];
        }
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
    try {
        if (matrix->factor.Factorize(matrix->values)) {
            return true;
        }
        ShiftDiagonal(matrix);
        return matrix->factor.Factorize(matrix->values);
    } catch (...) {
        return false;
    }
}

extern "C" void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution)
{
    int32_t size = matrix->size;
    for (size_t f = 0; f < matrix->place.size(); ++f) {
        std::copy(right + size * f, right + size * (f + 1), matrix->right.data() + size * matrix->place[f]);
    }
    /* Solves in place: nothing is thrown. */
    matrix->solution = matrix->factor.solve(matrix->right);
    for (size_t f = 0; f < matrix->place.size(); ++f) {
        const double* from = matrix->solution.data() + size * matrix->place[f];
        std::copy(from, from + size, solution + size * f);
    }
}
