/* A symmetric positive definite matrix of square blocks, one row and column of blocks a frame, and its factorisation.
   Nothing is allocated but by Shape, and nothing is thrown across this header. */
#ifndef KIRI_BLOCK_FACTOR_H
#define KIRI_BLOCK_FACTOR_H

#include "../core/kiri_base.h"

KIRI_C_BEGIN

enum { KIRI_MOST_UNKNOWNS = 12 }; /* of a frame */

typedef struct kiriMatrix kiriMatrix;

/* Two frames that share a block. */
typedef struct kiriPair {
    int32_t a, b;
} kiriPair;

/* A matrix without frames. `size` is the unknowns a frame: 3, 6 or 12. Null for memory. */
kiriMatrix* kiriMatrix_Create(kiriMemory* memory, int32_t size);

/* Gives it a pattern, and the symbolic factorisation of it; pairs may come more than once. Memory is kept from one
   pattern to the next; Eigen's search for an order of the frames takes its own from malloc, frees it before it returns,
   and no exception leaves this call. False for memory, of either: the matrix is then good for nothing but another
   call. */
bool kiriMatrix_Shape(kiriMatrix* matrix, int32_t frameCount, const kiriPair* pairs, int64_t pairCount);

int32_t kiriMatrix_FrameCount(const kiriMatrix* matrix);

/* The pairs of the pattern, each once. */
int32_t kiriMatrix_PairCount(const kiriMatrix* matrix);
void kiriMatrix_GetPairs(kiriMatrix* matrix, kiriPair* pairs);

/* How many products of blocks a factorisation of what is chosen, or of all, takes, as of blocks of size 6. */
int64_t kiriMatrix_ProductCount(const kiriMatrix* matrix, bool chosen);

/* Is the pair in the pattern? */
bool kiriMatrix_Covers(const kiriMatrix* matrix, kiriPair pair);

/* Of the pattern and the order of unknowns, on which the last bits of a solution depend. */
uint64_t kiriMatrix_Hash(const kiriMatrix* matrix);

struct kiriArchive;

/* The pattern and the order of unknowns, as bytes: see core/kiri_archive.h. Only where these are read the matrix is
   changed, and has the factorisation of the pattern then. */
void kiriMatrix_Archive(struct kiriArchive* archive, kiriMatrix* matrix);

/* Does without the long vectors of the processor, for tests: the bits are the same. */
void kiriMatrix_RefuseLongVectors(kiriMatrix* matrix);

/* Clear, Factor and Solve leave out all frames but these, which ascend: blocks that they share with others stay zero,
   and no block of others is added. Shape chooses all. */
void kiriMatrix_Choose(kiriMatrix* matrix, const int32_t* frames, int32_t count);

void kiriMatrix_Clear(kiriMatrix* matrix);

/* Adds a symmetric block of size x size to a frame's own. */
void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block);

/* Adds the block of a pair in the pattern, the unknowns of frame `down` down; and what mirrors it. Of one frame with
   itself it is symmetric. */
void kiriMatrix_AddBlock(kiriMatrix* matrix, int32_t down, int32_t across, const double* block);

/* Reads a block, which is in the pattern, as it was added: for who compares solvers. */
void kiriMatrix_GetBlock(const kiriMatrix* matrix, int32_t down, int32_t across, double* block);

/* Adds J^T k J, J of `rows` rows and size columns for each of the frames, which are all different; all pairs of them
   are in the pattern. */
void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* k, int32_t rows);

/* May add to the diagonal what rounding takes off. False when there is no factor even then. Solve needs one; both sides
   have size numbers a frame. */
bool kiriMatrix_Factor(kiriMatrix* matrix);
void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution);

KIRI_C_END

#endif
