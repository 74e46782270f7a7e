/* The product of two dense blocks with AVX, chosen at run time, for builds whose flags do not allow AVX. */
#ifndef KIRI_PRODUCT_H
#define KIRI_PRODUCT_H

#include "../core/kiri_base.h"

KIRI_C_BEGIN

/* out -= a b: `a` is rows x depth and `out` rows x columns, column by column; `b` is depth x columns, row by row.
   Strides are in numbers. `rows` and `columns` are multiples of 3. */
typedef struct kiriProduct {
    double* out;
    const double *a, *b;
    int32_t outStride, aStride, bStride;
    int32_t rows, columns, depth;
} kiriProduct;

/* Returns true if kiriProduct_SubtractByAvx may be called: the compiler has the kernel, and the processor has AVX. */
bool kiriProduct_HasAvx(void);

/* Subtracts the product. Each number is summed separately, in ascending order, without fused multiply-add. So all
   vector lengths give the same bits. */
void kiriProduct_SubtractByAvx(const kiriProduct* product);

KIRI_C_END

#endif
