/* A symmetric positive definite matrix of square blocks, one row and column of blocks a frame, and its factorisation
   L D L^T. Only kiriMatrix_Create, _Shape and a reading _Archive allocate. No call throws. */
#ifndef KIRI_MATRIX_H
#define KIRI_MATRIX_H

#include "../core/kiri_base.h"

KIRI_C_BEGIN

enum { KIRI_MOST_UNKNOWNS = 12 }; /* of a frame */

typedef struct kiriMatrix kiriMatrix;

/* Two frames that share a block. */
typedef struct kiriPair {
    int32_t a, b;
} kiriPair;

/* Creates a matrix without frames. `size` is the unknowns a frame: 3, 6 or 12. Returns null on out of memory. */
kiriMatrix* kiriMatrix_Create(kiriMemory* memory, int32_t size);

/* Frees the matrix. Null is a no-op. */
void kiriMatrix_Destroy(kiriMatrix* matrix);

/* Sets the pattern, orders the frames and computes the symbolic factorisation. Pairs may repeat, in any order. The
   result depends on the set of pairs alone. Eigen takes scratch from malloc for the order, and frees it before this
   call returns. Returns false on out of memory: then only another Shape may follow. */
bool kiriMatrix_Shape(kiriMatrix* matrix, int32_t frameCount, const kiriPair* pairs, int64_t pairCount);

int32_t kiriMatrix_FrameCount(const kiriMatrix* matrix);

/* Copies the pairs of the pattern: each once, a < b, ascending. */
int32_t kiriMatrix_PairCount(const kiriMatrix* matrix);
void kiriMatrix_GetPairs(const kiriMatrix* matrix, kiriPair* pairs);

/* Counts the products of blocks of size 6 in a factorisation. */
int64_t kiriMatrix_ProductCount(const kiriMatrix* matrix);

/* Returns true if the pattern contains the pair. */
bool kiriMatrix_Covers(const kiriMatrix* matrix, kiriPair pair);

/* Hashes the pattern. The order of unknowns, and so the last bits of a solution, follow from it. */
uint64_t kiriMatrix_Hash(const kiriMatrix* matrix);

struct kiriArchive;

/* Writes or reads the pairs of the pattern: see core/kiri_archive.h. Reading checks untrusted bytes, then shapes the
   matrix. */
void kiriMatrix_Archive(struct kiriArchive* archive, kiriMatrix* matrix);

/* Disables the AVX kernel of this matrix, for tests: the bits are the same. */
void kiriMatrix_RefuseAvx(kiriMatrix* matrix);

void kiriMatrix_Clear(kiriMatrix* matrix);

/* Adds a symmetric block of size x size to the diagonal block of a frame. */
void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block);

/* Copies a block in the pattern as it was added: for tools that compare solvers. */
void kiriMatrix_GetBlock(const kiriMatrix* matrix, int32_t down, int32_t across, double* block);

/* Adds J^T k J. J has `rows` rows, and size columns for each frame. The frames differ; all their pairs are in the
   pattern. */
void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* k, int32_t rows);

/* Factors the matrix. If rounding makes a pivot negative, adds a few units in the last place to the diagonal first.
   Returns false if a pivot is still not positive. */
bool kiriMatrix_Factor(kiriMatrix* matrix);

/* Solves after Factor returned true. Both arrays have size numbers a frame. */
void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution);

KIRI_C_END

#endif
