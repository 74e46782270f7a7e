/* Which items of a row are kept when others are taken away, and the index that each gets. Orders are kept. */
#ifndef KIRI_KEEP_H
#define KIRI_KEEP_H

#include "kiri_array.h"

KIRI_C_BEGIN

typedef struct kiriKeep {
    KIRI_ARRAY(int32_t) to; /* of each item: its new index, or KIRI_NONE */
    int32_t count;          /* items that are kept */
    int32_t first;          /* the first that is not, or the number of items: those before it stay where they are */
} kiriKeep;

/* A map of no items, with room for so many. False for memory. */
bool kiriKeep_Init(kiriKeep* keep, kiriMemory* memory, int32_t items);

/* Where none is kept: these are, from the lowest to the highest. And none again. */
void kiriKeep_Take(kiriKeep* keep, const int32_t* items, int32_t count);
void kiriKeep_Drop(kiriKeep* keep, const int32_t* items, int32_t count);

/* The next item. There is room. */
static inline void kiriKeep_Add(kiriKeep* keep, bool isKept)
{
    KIRI_ASSERT(keep->to.count < keep->to.capacity);
    keep->first += isKept && keep->first == keep->to.count;
    keep->to.data[keep->to.count++] = isKept ? keep->count++ : KIRI_NONE;
}

/* A map of so many items, of which none is kept. There is room. */
void kiriKeep_Clear(kiriKeep* keep, int32_t items);

/* The new index of an item; KIRI_NONE where it is not kept, and for KIRI_NONE. */
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

/* Does any item get another index? */
static inline bool kiriKeep_Moves(const kiriKeep* keep)
{
    return keep->count > keep->first;
}

/* Moves the kept items of a KIRI_ARRAY together, which has `each` entries of entryBytes an item; an empty one stays
   empty. */
void kiriKeep_Compact(const kiriKeep* keep, void* array, int32_t each, size_t entryBytes);

/* Copies the kept items, of itemBytes each. */
void kiriKeep_Copy(const kiriKeep* keep, void* to, const void* from, size_t itemBytes);

/* Lists of items, linked from each to an older one: those that are not kept leave them, and the others get their new
   index. `next` is the link of item 0, and strideBytes from one to the next. To be called before items are moved. */
void kiriKeep_Relink(const kiriKeep* keep, int32_t* heads, int32_t headCount, int32_t* next, size_t strideBytes);

KIRI_C_END

#endif
