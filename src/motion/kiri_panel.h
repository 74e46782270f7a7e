/* Dense arithmetic for the factorisation: products that are taken off, and what solves with a panel. A panel is a tall
   matrix, column by column, whose top is the lower triangle of a square: L, with D in place of its diagonal of ones,
   and what is above it means nothing. All heights and widths are multiples of 3.

   Each number is summed by itself and in a fixed order, without fused multiply-add, so vectors of any length give the
   same bits: long ones are taken where the processor has them. */
#ifndef KIRI_PANEL_H
#define KIRI_PANEL_H

#include "../core/kiri_base.h"

KIRI_C_BEGIN

/* Has this processor vectors of four doubles? */
bool kiriPanel_HasLongVectors(void);

/* out -= a b: `a` is rows x depth and `out` rows x columns, column by column; `b` is depth x columns, row by row.
   Strides are in numbers. */
typedef struct kiriProduct {
    double* out;
    const double *a, *b;
    int32_t outStride, aStride, bStride;
    int32_t rows, columns, depth;
} kiriProduct;

void kiriPanel_TakeOff(const kiriProduct* product, bool hasLongVectors);

/* `count` rows of `depth` columns of a panel times D, into `out` row by row of D. `columns` is where column `first` of
   the panel begins. */
void kiriPanel_ScaleRows(const double* columns, int32_t height, int32_t first, int32_t depth, int32_t row,
                         int32_t count, double* out, bool hasLongVectors);

/* Factors the first `size` (3, 6 or 12) columns of a panel of `height` rows, of which the first ones are the diagonal
   block. False where it is not positive definite. */
bool kiriPanel_Factor(double* panel, int32_t height, int32_t stride, int32_t size, bool hasLongVectors);

/* y has `height` numbers, the first `width` of which are the panel's. L y' = y, and the rest of y is what that takes
   off the rows below; then y' / D. */
void kiriPanel_SolveDown(const double* panel, int32_t height, int32_t width, double* y);

/* L^T x = y for the first `width` of x, which start as y; the rest is known. */
void kiriPanel_SolveUp(const double* panel, int32_t height, int32_t width, double* x);

KIRI_C_END

#endif
