/* Tells at run time what no macro tells of the arithmetic of floats, as clang's -ffp-contract=fast, which heeds no
   pragma. See kiri_float.h. */
#ifndef KIRI_EXACT_H
#define KIRI_EXACT_H

#include "kiri_base.h"

KIRI_C_BEGIN

/* Is each operation rounded by itself, in the order that the sources say? */
bool kiriExact_AreFloats(void);

/* Is the processor, in this thread, in the mode in which programs start: sums are rounded to the nearest number, and
   none is taken for zero because it is small? */
bool kiriExact_IsModePlain(void);

KIRI_C_END

#endif
