/* A symmetric positive definite matrix of square blocks, one row and column of blocks a frame, and its factorisation
   L D L^T. kiri_pattern.c decides where blocks are; kiri_matrix.cpp orders the frames, adds, factors and solves. Only
   kiriMatrix_Create, _Shape and a reading _Archive allocate. No call throws. */
#ifndef KIRI_MATRIX_H
#define KIRI_MATRIX_H

#include "../core/kiri_array.h"

KIRI_C_BEGIN

enum { KIRI_MOST_UNKNOWNS = 12 }; /* of a frame */

/* Two frames that share a block. */
typedef struct kiriPair {
    int32_t a, b;
} kiriPair;

/* Lists of blocks: rows of column c begin at start[c]. In a lower pattern they ascend: the diagonal block is first. */
typedef struct kiriColumns {
    kiriIndices start, row;
} kiriColumns;

/* Supernode: adjacent columns with the same rows below them. Its values are a tall matrix, column by column. The top is
   the lower triangle of a square: L, with D in place of its diagonal of ones. Numbers above D mean nothing. */
typedef struct kiriPanel {
    int32_t column, width; /* first column; count of columns */
    int32_t row, below;    /* into factor.row: rows below the columns, ascending; their count */
    int32_t update;        /* into `updates`: the first one that changes this panel, or KIRI_NONE */
    int64_t values;        /* into `factors` */
} kiriPanel;

/* Rows of an earlier panel that are columns of a later one. */
typedef struct kiriPanelUpdate {
    int32_t panel, first, count; /* into the earlier panel's rows */
    int32_t next;                /* update of the same later panel, by a later source; or KIRI_NONE */
} kiriPanelUpdate;

/* Rows and columns are positions in the order of unknowns, in blocks. Blocks of the matrix lie column by column, and so
   do the entries of a block. Other modules only read. */
typedef struct kiriMatrix {
    kiriMemory* memory;
    int32_t size, count; /* unknowns a frame; frames */
    bool usesAvx;
    int64_t products;    /* of blocks of size 6, in a factorisation */

    /* Arrays up to the end. */
    kiriColumns graph;           /* lower pattern by frames */
    kiriIndices order;           /* position of each frame */
    kiriColumns pattern, factor; /* lower patterns of the matrix and of the factor */
    KIRI_ARRAY(kiriPanel) panels;
    KIRI_ARRAY(kiriPanelUpdate) updates;
    kiriReals values, factors, right;
    kiriReals scaled, part;     /* scratch: rows of a panel times D; the right side of a panel */
    KIRI_ARRAY(kiriPair) pairs; /* scratch */
    kiriColumns rows, ways;     /* scratch: columns of each row, of the matrix and of the factor */
    kiriIndices parent, mark;   /* scratch: the elimination tree; position of a row in a panel */
    kiriIndices panelOf;        /* scratch: panel of each column */
} kiriMatrix;

/* ---- Pattern ---- */

/* Creates a matrix without frames. `size` is the unknowns a frame: 3, 6 or 12. Returns null on out of memory. */
kiriMatrix* kiriMatrix_Create(kiriMemory* memory, int32_t size);

/* Frees the matrix. Null is a no-op. */
void kiriMatrix_Destroy(kiriMatrix* matrix);

/* Sets the pattern, orders the frames and computes the symbolic factorisation. Pairs may repeat, in any order. The
   result depends on the set of pairs alone. Eigen takes scratch from malloc for the order, and frees it before this
   call returns. Returns false on out of memory: then only another Shape may follow. */
bool kiriMatrix_Shape(kiriMatrix* matrix, int32_t frameCount, const kiriPair* pairs, int64_t pairCount);

/* Copies the pairs of the pattern: each once, a < b, ascending. */
int32_t kiriMatrix_PairCount(const kiriMatrix* matrix);
void kiriMatrix_GetPairs(const kiriMatrix* matrix, kiriPair* pairs);

/* Hashes the pattern. The order of unknowns, and so the last bits of a solution, follow from it. */
uint64_t kiriMatrix_Hash(const kiriMatrix* matrix);

struct kiriArchive;

/* Writes or reads the pairs of the pattern: see core/kiri_archive.h. Reading checks untrusted bytes, then shapes the
   matrix. */
void kiriMatrix_Archive(struct kiriArchive* archive, kiriMatrix* matrix);

/* ---- Numbers ---- */

/* For Create: returns true if the compiler has the AVX kernel, and the processor has AVX. The bits are the same. */
bool kiriMatrix_HasAvx(void);

/* For Shape: orders the frames of the graph by approximate minimum degree, which keeps the factor sparse. Fails on out
   of memory. */
bool kiriMatrix_Order(kiriMatrix* matrix);

/* Returns true if the pattern contains the pair. */
bool kiriMatrix_Covers(const kiriMatrix* matrix, kiriPair pair);

void kiriMatrix_Clear(kiriMatrix* matrix);

/* Adds a symmetric block of size x size to the diagonal block of a frame. */
void kiriMatrix_AddOwn(kiriMatrix* matrix, int32_t frame, const double* block);

/* Adds J^T k J. J has `rows` rows, and size columns for each frame. The frames differ; all their pairs are in the
   pattern. */
void kiriMatrix_AddSquares(kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* k, int32_t rows);

/* Adds J^T pulls to the forces, `size` numbers a frame. J is as above. */
void kiriMatrix_AddForces(const kiriMatrix* matrix, const int32_t* frames, int32_t frameCount, const double* J,
                          const double* pulls, int32_t rows, double* forces);

/* Factors the matrix. If rounding makes a pivot negative, adds a few units in the last place to the diagonal first.
   Returns false if a pivot is still not positive. */
bool kiriMatrix_Factor(kiriMatrix* matrix);

/* Solves after Factor returned true. Both arrays have size numbers a frame. */
void kiriMatrix_Solve(kiriMatrix* matrix, const double* right, double* solution);

KIRI_C_END

#endif
