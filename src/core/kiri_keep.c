#include "kiri_keep.h"

#include <string.h>

bool kiriKeep_Init(kiriKeep* keep, kiriMemory* memory, int32_t items)
{
    memset(keep, 0, sizeof(*keep));
    return kiriArray_Reserve(memory, &keep->to, items);
}

void kiriKeep_Clear(kiriKeep* keep, int32_t items)
{
    KIRI_ASSERT(items >= 0 && items <= keep->to.capacity);
    for (int32_t i = 0; i < items; ++i) {
        keep->to.data[i] = KIRI_NONE;
    }
    keep->to.count = items;
    keep->count = keep->first = 0;
}

void kiriKeep_Take(kiriKeep* keep, const int32_t* items, int32_t count)
{
    KIRI_ASSERT(keep->count == 0 && keep->first == 0);
    for (int32_t k = 0; k < count; ++k) {
        KIRI_ASSERT(items[k] < keep->to.count && (k == 0 || items[k] > items[k - 1]));
        keep->to.data[items[k]] = k;
    }
    keep->count = count;
}

void kiriKeep_Drop(kiriKeep* keep, const int32_t* items, int32_t count)
{
    KIRI_ASSERT(keep->count == count);
    for (int32_t k = 0; k < count; ++k) {
        keep->to.data[items[k]] = KIRI_NONE;
    }
    keep->count = 0;
}

/* Moves items from `first` on, run by run of items that are all kept or all removed. `to` may be `from`: no item moves
   up. */
static void MoveRuns(const kiriKeep* keep, unsigned char* to, const unsigned char* from, int32_t first,
                     size_t itemBytes)
{
    const int32_t* map = keep->to.data;
    for (int32_t i = first, end; i < keep->to.count; i = end) {
        end = i + 1;
        while (end < keep->to.count && (map[end] == KIRI_NONE) == (map[i] == KIRI_NONE)) {
            ++end;
        }
        if (map[i] != KIRI_NONE) {
            KIRI_ASSERT(map[i] <= i && map[end - 1] == map[i] + end - 1 - i);
            memmove(to + (size_t)map[i] * itemBytes, from + (size_t)i * itemBytes, (size_t)(end - i) * itemBytes);
        }
    }
}

void kiriKeep_Compact(const kiriKeep* keep, void* array, int32_t each, size_t entryBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (header.count > 0) {
        KIRI_ASSERT(header.count == each * keep->to.count);
        MoveRuns(keep, header.data, header.data, keep->first, (size_t)each * entryBytes);
        header.count = each * keep->count;
        kiriArray_SetHeader(array, header);
    }
}

void kiriKeep_Copy(const kiriKeep* keep, void* to, const void* from, size_t itemBytes)
{
    if (keep->first > 0) {
        memcpy(to, from, (size_t)keep->first * itemBytes);
    }
    MoveRuns(keep, to, from, keep->first, itemBytes);
}

static int32_t* LinkOf(int32_t* next, size_t strideBytes, int32_t item)
{
    return (int32_t*)((char*)next + (size_t)item * strideBytes);
}

/* Returns the new link for a link to `item`. Older items have their new links already, so the link of a removed item
   leads to the next kept one. */
static int32_t NewLink(const kiriKeep* keep, int32_t* next, size_t strideBytes, int32_t item)
{
    bool isRemoved = item != KIRI_NONE && !kiriKeep_Has(keep, item);
    return isRemoved ? *LinkOf(next, strideBytes, item) : kiriKeep_To(keep, item);
}

void kiriKeep_Relink(const kiriKeep* keep, int32_t* heads, int32_t headCount, int32_t* next, size_t strideBytes)
{
    for (int32_t i = keep->first; i < keep->to.count; ++i) {
        int32_t* link = LinkOf(next, strideBytes, i);
        KIRI_ASSERT(*link < i);
        *link = NewLink(keep, next, strideBytes, *link);
    }
    for (int32_t k = 0; k < headCount; ++k) {
        heads[k] = NewLink(keep, next, strideBytes, heads[k]);
    }
}
