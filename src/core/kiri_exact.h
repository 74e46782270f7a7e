/* Tells at run time what no macro tells of the arithmetic of floats, as clang's -ffp-contract=fast, which heeds no
   pragma. See kiri_float.h. */
#ifndef KIRI_EXACT_H
#define KIRI_EXACT_H

#include "kiri_base.h"

KIRI_C_BEGIN

/* Is each operation rounded by itself, in the order that the sources say? */
bool kiriExact_AreFloats(void);

KIRI_C_END

#endif
