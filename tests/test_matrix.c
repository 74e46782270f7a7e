/* The block matrix against a dense one, summed and solved here. */
#include "matrix_hash.h"
#include "solver/kiri_matrix.h"
#include "support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_FRAMES = 24, MOST = MOST_FRAMES * KIRI_MOST_UNKNOWNS, MOST_MEMBERS = 4, ROWS = 9 };

static double dense[MOST][MOST], right[MOST], solution[MOST];
static kiriPair pairs[MOST_FRAMES * MOST_FRAMES];
static int32_t pairCount;

/* An element couples all pairs of its frames. */
typedef struct Element {
    int32_t frames[MOST_MEMBERS], count;
    double J[ROWS * MOST_MEMBERS * KIRI_MOST_UNKNOWNS], k[ROWS];
} Element;

static Element elements[16];

static void FillElement(Element* element, int32_t size, uint32_t* seed)
{
    for (int32_t n = 0; n < ROWS * element->count * size; ++n) {
        element->J[n] = RandomBetween(seed, -1.0, 1.0);
    }
    for (int32_t n = 0; n < ROWS; ++n) {
        element->k[n] = RandomBetween(seed, 0.1, 10.0);
    }
}

static void MakeElements(uint32_t* seed, int32_t size, int32_t frames, int32_t count)
{
    pairCount = 0;
    for (int32_t e = 0; e < count; ++e) {
        Element* element = &elements[e];
        element->count = 1 + (int32_t)(Random(seed) % MOST_MEMBERS);
        for (int32_t m = 0; m < element->count; ++m) {
            element->frames[m] = (m * 5 + e * 7 + (int32_t)(Random(seed) % 5)) % frames; /* different: frames > 19 */
            for (int32_t n = 0; n < m; ++n) {
                pairs[pairCount++] = (kiriPair){ element->frames[n], element->frames[m] };
            }
        }
        FillElement(element, size, seed);
    }
}

static void Assemble(kiriMatrix* matrix, uint32_t* seed, int32_t size, int32_t frames, int32_t count)
{
    memset(dense, 0, sizeof(dense));
    kiriMatrix_Clear(matrix);
    for (int32_t f = 0; f < frames; ++f) {
        double block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS];
        for (int32_t r = 0; r < size; ++r) {
            for (int32_t c = 0; c <= r; ++c) {
                block[size * r + c] = block[size * c + r] = RandomBetween(seed, -0.05, 0.05) + (r == c ? 1.0 : 0.0);
                dense[size * f + r][size * f + c] = dense[size * f + c][size * f + r] = block[size * r + c];
            }
        }
        kiriMatrix_AddOwn(matrix, f, block);
    }
    for (int32_t e = 0; e < count; ++e) {
        const Element* element = &elements[e];
        int32_t stride = size * element->count, rows = 1 + e % ROWS;
        kiriMatrix_AddSquares(matrix, element->frames, element->count, element->J, element->k, rows);
        for (int32_t a = 0; a < stride; ++a) {
            for (int32_t b = 0; b < stride; ++b) {
                double* sum =
                    &dense[size * element->frames[a / size] + a % size][size * element->frames[b / size] + b % size];
                for (int32_t n = 0; n < rows; ++n) {
                    *sum += element->k[n] * element->J[n * stride + a] * element->J[n * stride + b];
                }
            }
        }
    }
}

/* The largest part of dense * solution - right. */
static double Residual(int32_t unknowns)
{
    double worst = 0.0;
    for (int32_t r = 0; r < unknowns; ++r) {
        double sum = -right[r];
        for (int32_t c = 0; c < unknowns; ++c) {
            sum += dense[r][c] * solution[c];
        }
        worst = fabs(sum) > worst ? fabs(sum) : worst;
    }
    return worst;
}

/* All blocks equal blocks of the dense matrix, before it is factored. */
static void CheckBlocks(const kiriMatrix* matrix, int32_t size, int32_t frames)
{
    int32_t frameOf[MOST_FRAMES] = { 0 };
    for (int32_t f = 0; f < frames; ++f) {
        frameOf[matrix->order.data[f]] = f;
    }
    for (int32_t c = 0; c < frames; ++c) {
        for (int32_t b = matrix->pattern.start.data[c]; b < matrix->pattern.start.data[c + 1]; ++b) {
            const double* block = matrix->values.data + size * size * b;
            int32_t down = size * frameOf[matrix->pattern.row.data[b]], across = size * frameOf[c];
            for (int32_t n = 0; n < size * size; ++n) {
                assert_true(fabs(block[n] - dense[down + n % size][across + n / size]) < 1e-12);
            }
        }
    }
}

/* Factors and solves for a right side at random. */
static void CheckSolution(kiriMatrix* matrix, int32_t unknowns, uint32_t* seed)
{
    for (int32_t n = 0; n < unknowns; ++n) {
        right[n] = RandomBetween(seed, -1.0, 1.0);
    }
    assert_true(kiriMatrix_Factor(matrix));
    kiriMatrix_Solve(matrix, right, solution);
    assert_true(Residual(unknowns) < 1e-10);
}

/* One matrix gets pattern after pattern; some cover more pairs than there are elements. */
TEST(Solves)
{
    static const int32_t sizes[3] = { 3, 6, 12 };
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    uint32_t seed = 77;
    for (int s = 0; s < 3; ++s) {
        kiriMatrix* matrix = kiriMatrix_Create(&memory, sizes[s]);
        assert_non_null(matrix);
        for (int trial = 0; trial < 40; ++trial) {
            int32_t frames = 20 + (int32_t)(Random(&seed) % 5), unknowns = sizes[s] * frames, count = trial % 16;
            MakeElements(&seed, sizes[s], frames, count);
            for (int extra = 0; extra < trial % 3; ++extra) {
                int32_t a = (int32_t)(Random(&seed) % 20), b = (a + 1 + extra) % 20;
                pairs[pairCount++] = (kiriPair){ a, b };
            }
            assert_true(kiriMatrix_Shape(matrix, frames, pairs, pairCount));
            for (int again = 0; again < 2; ++again) {
                Assemble(matrix, &seed, sizes[s], frames, count);
                CheckBlocks(matrix, sizes[s], frames);
                CheckSolution(matrix, unknowns, &seed);
            }
        }
        kiriMemory_FreeAll(&memory);
    }
}

/* All frames below `both` with each other, and all from there on less two: what the first have by themselves makes one
   panel, wider than is taken off at once. */
static void MakeWideElements(uint32_t* seed, int32_t size, int32_t frames, int32_t both)
{
    pairCount = 0;
    for (int32_t b = 0; b < frames; ++b) {
        for (int32_t a = b < both ? 0 : both - 2; a < b; ++a) {
            pairs[pairCount++] = (kiriPair){ a, b };
        }
    }
    for (int32_t e = 0; e < 16; ++e) {
        Element* element = &elements[e];
        int32_t first = e % 2 == 0 ? 0 : both - 2, last = e % 2 == 0 ? both : frames;
        element->count = MOST_MEMBERS;
        for (int32_t m = 0; m < MOST_MEMBERS; ++m) {
            int32_t quarter = (last - first) / MOST_MEMBERS;
            element->frames[m] = first + quarter * m + (int32_t)(Random(seed) % (uint32_t)quarter);
        }
        FillElement(element, size, seed);
    }
}

TEST(WidePanels)
{
    static const int32_t sizes[3] = { 3, 6, 12 };
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    uint32_t seed = 123;
    for (int trial = 0; trial < 12; ++trial) {
        int32_t size = sizes[trial % 3], frames = MOST_FRAMES, unknowns = size * frames;
        kiriMatrix* matrix = kiriMatrix_Create(&memory, size);
        assert_non_null(matrix);
        MakeWideElements(&seed, size, frames, 12 + trial / 3);
        assert_true(kiriMatrix_Shape(matrix, frames, pairs, pairCount));
        Assemble(matrix, &seed, size, frames, 16);
        CheckSolution(matrix, unknowns, &seed);
    }
    kiriMemory_FreeAll(&memory);
}

/* The AVX kernel and Eigen give the same bits. */
TEST(Vectors)
{
    static double other[MOST];
    static const int32_t sizes[3] = { 3, 6, 12 };
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    for (int trial = 0; trial < 30; ++trial) {
        int32_t size = sizes[trial % 3], frames = MOST_FRAMES;
        for (int refuses = 0; refuses < 2; ++refuses) {
            uint32_t seed = 99 + (uint32_t)trial;
            kiriMatrix* matrix = kiriMatrix_Create(&memory, size);
            assert_non_null(matrix);
            matrix->usesAvx &= !refuses;
            MakeElements(&seed, size, frames, 16);
            assert_true(kiriMatrix_Shape(matrix, frames, pairs, pairCount));
            Assemble(matrix, &seed, size, frames, 16);
            for (int32_t n = 0; n < size * frames; ++n) {
                right[n] = RandomBetween(&seed, -1.0, 1.0);
            }
            assert_true(kiriMatrix_Factor(matrix));
            kiriMatrix_Solve(matrix, right, refuses ? other : solution);
        }
        assert_memory_equal(other, solution, sizeof(double) * (size_t)(size * frames));
    }
    kiriMemory_FreeAll(&memory);
}

TEST(Covers)
{
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    uint32_t seed = 5;
    kiriMatrix* matrix = kiriMatrix_Create(&memory, 6);
    assert_non_null(matrix);
    for (int trial = 0; trial < 50; ++trial) {
        bool isIn[20][20] = { { false } };
        pairCount = trial;
        for (int32_t k = 0; k < pairCount; ++k) {
            pairs[k] = (kiriPair){ (int32_t)(Random(&seed) % 20), (int32_t)(Random(&seed) % 20) };
            isIn[pairs[k].a][pairs[k].b] = isIn[pairs[k].b][pairs[k].a] = true;
        }
        assert_true(kiriMatrix_Shape(matrix, 20, pairs, pairCount));
        for (int32_t a = 0; a < 20; ++a) {
            for (int32_t b = 0; b < 20; ++b) {
                kiriPair pair = { a, b };
                assert_int_equal(kiriMatrix_Covers(matrix, pair), isIn[a][b] || a == b);
            }
        }
        uint64_t hash = kiriMatrix_Hash(matrix);
        assert_true(kiriMatrix_Shape(matrix, 20, pairs, pairCount) && kiriMatrix_Hash(matrix) == hash);
        assert_true(kiriMatrix_Shape(matrix, 21, pairs, pairCount) && kiriMatrix_Hash(matrix) != hash);
    }
    kiriMemory_FreeAll(&memory);
}

/* No factor where a pivot is not positive by far; one all the same where only rounding says so. */
TEST(NotPositive)
{
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    kiriMatrix* matrix = kiriMatrix_Create(&memory, 3);
    kiriPair pair = { 0, 1 };
    double light[9] = { 1e-18, 0.0, 0.0, 0.0, 1e-18, 0.0, 0.0, 0.0, 1e-18 }, bad[9] = { 1.0, 2.0, 0.0, 2.0, 1.0 };
    double k[3] = { 1.0, 1.0, 1.0 }, J[18] = { 0.0 };
    int32_t frames[2] = { 0, 1 };
    bad[8] = 1.0;
    for (int n = 0; n < 3; ++n) {
        J[6 * n + n] = 1.0;
        J[6 * n + 3 + n] = -1.0;
    }
    assert_non_null(matrix);
    assert_true(kiriMatrix_Shape(matrix, 2, &pair, 1));
    for (int isBad = 0; isBad < 2; ++isBad) {
        kiriMatrix_Clear(matrix);
        kiriMatrix_AddOwn(matrix, 0, light);
        kiriMatrix_AddOwn(matrix, 1, isBad ? bad : light);
        kiriMatrix_AddSquares(matrix, frames, 2, J, k, isBad ? 0 : 3);
        assert_int_equal(kiriMatrix_Factor(matrix), !isBad);
    }
    kiriMemory_FreeAll(&memory);
}

/* Every target gives these bits. */
TEST(Hashes)
{
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    for (int k = 0; k < MATRIX_SIZES; ++k) {
        assert_true(MatrixHash(&memory, matrixGolden[k].size, false) == matrixGolden[k].hash);
        assert_true(MatrixHash(&memory, matrixGolden[k].size, true) == matrixGolden[k].hash);
    }
    kiriMemory_FreeAll(&memory);
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

/* Counts malloc of the whole program, and so C++'s new, where the C library lets us replace it. */
static int64_t requests;

#if REPLACES_MALLOC
extern void* __libc_malloc(size_t bytes);

void* malloc(size_t bytes)
{
    ++requests;
    return __libc_malloc(bytes);
}
#endif

static void* CountAlloc(void* user, int64_t bytes)
{
    ++requests;
    return malloc((size_t)bytes);
}

static void FreeCounted(void* user, void* pointer)
{
    free(pointer);
}

/* Neither the host nor malloc is asked for memory after Shape. */
TEST(NoMemory)
{
    static const int32_t sizes[3] = { 3, 6, 12 };
    kiriMemory memory = kiriMemory_Make(CountAlloc, FreeCounted, NULL);
    uint32_t seed = 31;
    for (int s = 0; s < 3; ++s) {
        kiriMatrix* matrix = kiriMatrix_Create(&memory, sizes[s]);
        MakeElements(&seed, sizes[s], MOST_FRAMES, 16);
        requests = 0;
        assert_true(kiriMatrix_Shape(matrix, MOST_FRAMES, pairs, pairCount));
        assert_true(requests > 10);
        requests = 0;
        Assemble(matrix, &seed, sizes[s], MOST_FRAMES, 16);
        assert_true(kiriMatrix_Factor(matrix));
        kiriMatrix_Solve(matrix, right, solution);
        kiriMatrix_Clear(matrix);
        assert_int_equal(requests, 0);
    }
    kiriMemory_FreeAll(&memory);
}
