/* Index maps: the new index of each item of an array from which items are removed. Orders are kept. */
#ifndef KIRI_KEEP_H
#define KIRI_KEEP_H

#include "kiri_array.h"

KIRI_C_BEGIN

typedef struct kiriKeep {
    KIRI_ARRAY(int32_t) to; /* per item: new index, or KIRI_NONE */
    int32_t count;          /* count of kept items */
    int32_t first;          /* first removed item, or the count of items: items before it keep their index */
} kiriKeep;

/* Makes an empty map with capacity for `items`. Fails on out of memory. */
bool kiriKeep_Init(kiriKeep* keep, kiriMemory* memory, int32_t items);

/* Take keeps these items, in ascending order, in a map that keeps none; Drop removes them again. O(count). */
void kiriKeep_Take(kiriKeep* keep, const int32_t* items, int32_t count);
void kiriKeep_Drop(kiriKeep* keep, const int32_t* items, int32_t count);

/* Appends an item. Capacity is reserved. */
static inline void kiriKeep_Add(kiriKeep* keep, bool isKept)
{
    KIRI_ASSERT(keep->to.count < keep->to.capacity);
    keep->first += isKept && keep->first == keep->to.count;
    keep->to.data[keep->to.count++] = isKept ? keep->count++ : KIRI_NONE;
}

/* Makes a map of `items` that keeps none. Capacity is reserved. */
void kiriKeep_Clear(kiriKeep* keep, int32_t items);

/* Returns the new index of an item; KIRI_NONE if it is not kept, and for KIRI_NONE. */
static inline int32_t kiriKeep_To(const kiriKeep* keep, int32_t item)
{
    KIRI_ASSERT(item >= KIRI_NONE && item < keep->to.count);
    if (item < keep->first) {
        return item;
    }
    return keep->to.data[item];
}

static inline bool kiriKeep_Has(const kiriKeep* keep, int32_t item)
{
    return kiriKeep_To(keep, item) != KIRI_NONE;
}

/* Returns true if a kept item gets another index. */
static inline bool kiriKeep_Moves(const kiriKeep* keep)
{
    return keep->count > keep->first;
}

/* Removes items from a KIRI_ARRAY, which has `each` entries of entryBytes an item, or is empty. */
void kiriKeep_Compact(const kiriKeep* keep, void* array, int32_t each, size_t entryBytes);

/* Copies the kept items, of itemBytes each, to another array. */
void kiriKeep_Copy(const kiriKeep* keep, void* to, const void* from, size_t itemBytes);

/* Removes items from linked lists, in which each item links to an older one, and renumbers the links. `next` is the
   link of item 0, with strideBytes from one link to the next. Call it before items are moved. */
void kiriKeep_Relink(const kiriKeep* keep, int32_t* heads, int32_t headCount, int32_t* next, size_t strideBytes);

KIRI_C_END

#endif
