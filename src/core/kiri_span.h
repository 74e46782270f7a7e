/* Rows of items that grow and shrink, all in one array: the weights of each sample, say. A span has room for the least
   power of two that holds its items; room that is given back is used again. */
#ifndef KIRI_SPAN_H
#define KIRI_SPAN_H

#include "kiri_array.h"

KIRI_C_BEGIN

typedef struct kiriSpan {
    int32_t first, count;
} kiriSpan;

enum { KIRI_SPAN_SIZES = 31 };

/* Where the free room is: heads of lists that run through the free items themselves. */
typedef struct kiriSpans {
    int32_t freeHead[KIRI_SPAN_SIZES]; /* plus 1, so that zeroed spans are empty */
} kiriSpans;

/* Gives the span room for `count` items and sets its count; the first items stay what they are, new ones are not
   initialised. It may move the items, also where it shrinks. `array` points to the KIRI_ARRAY that holds the items of
   all spans; an item has itemBytes, at least 4. False for memory, and then nothing has changed. To shrink, or to count
   0, never fails. */
bool kiriSpan_Resize(kiriSpan* span, kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes,
                     int32_t count);

/* Have both room for the same number of items? */
bool kiriSpan_IsAlike(kiriSpan a, kiriSpan b);

KIRI_C_END

#endif
