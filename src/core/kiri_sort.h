/* Sorting of indices in place, without memory. */
#ifndef KIRI_SORT_H
#define KIRI_SORT_H

#include "kiri_base.h"

KIRI_C_BEGIN

/* Does item a come before item b? A strict order: of two different items one comes before the other, so that the result
   does not depend on the order before. */
typedef bool kiriBeforeFn(const void* context, int32_t a, int32_t b);

/* `before` null: by the items themselves. */
void kiriSort(int32_t* items, int32_t count, kiriBeforeFn* before, const void* context);

KIRI_C_END

#endif
