/* Sorting of indices. */
#ifndef KIRI_SORT_H
#define KIRI_SORT_H

#include "kiri_base.h"

KIRI_C_BEGIN

/* Does item a come before item b? A strict order: of two different items one comes before the other, so that the result
   does not depend on the order before. */
typedef bool kiriBeforeFn(const void* context, int32_t a, int32_t b);

/* In place, without memory. `before` null: by the items themselves. */
void kiriSort(int32_t* items, int32_t count, kiriBeforeFn* before, const void* context);

/* Items of 0 and above, the lowest first, in a time that grows as their number. `room` has room for as many. */
void kiriSort_Numbers(int32_t* items, int32_t* room, int32_t count);

/* How far a sorting that may be interrupted has come; zeroed: at its start. */
typedef struct kiriSorting {
    int32_t width, block;    /* the runs that are merged, and the first of the two at hand */
    int32_t to, left, right; /* where the merged run goes on, and its two halves; `to` below `block`: not begun */
} kiriSorting;

/* Goes on sorting for about `most` moves; true when it is done. Merges runs, and leaves alone what is in order. `room`
   has room for as many items. */
bool kiriSorting_GoOn(kiriSorting* sorting, int32_t* items, int32_t* room, int32_t count, kiriBeforeFn* before,
                      const void* context, int32_t most);

KIRI_C_END

#endif
