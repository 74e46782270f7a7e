#include "kiri_array.h"

#include <string.h>

kiriArrayHeader kiriArray_GetHeader(const void* array)
{
    kiriArrayHeader header;
    memcpy(&header, array, sizeof(header));
    KIRI_ASSERT(header.count >= 0 && header.count <= header.capacity);
    return header;
}

void kiriArray_SetHeader(void* array, kiriArrayHeader header)
{
    memcpy(array, &header, sizeof(header));
}

/* An eighth more even at first, so that the first cut does not copy the whole sheet. */
static int64_t NextCapacity(int64_t capacity, int64_t need)
{
    int64_t next = 2 * capacity, least = need + need / 8;
    next = kiriMax(least, next);
    next = kiriMax(8, next);
    return kiriMin(INT32_MAX, next);
}

/* Moves the items to a new block of `capacity` items. */
static bool MoveArray(kiriMemory* memory, void* array, int64_t capacity, size_t itemBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    void* data = capacity > INT32_MAX ? NULL : kiriMemory_Alloc(memory, capacity * (int64_t)itemBytes);
    if (data == NULL) {
        return false;
    }
    if (header.count > 0) {
        memcpy(data, header.data, (size_t)header.count * itemBytes);
    }
    kiriMemory_Free(memory, header.data);
    header.data = data;
    header.capacity = (int32_t)capacity;
    kiriArray_SetHeader(array, header);
    return true;
}

bool kiriArray_Grow(kiriMemory* memory, void* array, int64_t need, size_t itemBytes)
{
    int64_t has = kiriArray_GetHeader(array).capacity, capacity = NextCapacity(has, need);
    return need <= has || (capacity >= need && MoveArray(memory, array, capacity, itemBytes));
}

bool kiriArray_GrowTo(kiriMemory* memory, void* array, int64_t need, size_t itemBytes)
{
    return need <= kiriArray_GetHeader(array).capacity || MoveArray(memory, array, need, itemBytes);
}

void kiriArray_Shorten(kiriMemory* memory, void* array, size_t itemBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    int64_t enough = header.count + (int64_t)header.count / 8;
    if (header.count > 0 && enough < header.capacity) {
        MoveArray(memory, array, enough, itemBytes);
    }
}

void kiriArray_Release(kiriMemory* memory, void* array)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    const kiriArrayHeader empty = { NULL, 0, 0 };
    kiriMemory_Free(memory, header.data);
    kiriArray_SetHeader(array, empty);
}

static bool IsLess(const void* context, int32_t a, int32_t b)
{
    (void)context;
    return a < b;
}

/* Shell sort (1959) with Knuth's gaps: little code, and fast on nearly sorted input. */
void kiriSort(int32_t* items, int32_t count, kiriBeforeFn* before, const void* context)
{
    KIRI_ASSERT(count >= 0);
    int32_t gap = 1;
    before = before != NULL ? before : IsLess;
    while (gap < count / 3) {
        gap = 3 * gap + 1;
    }
    for (; gap > 0; gap /= 3) {
        for (int32_t i = gap; i < count; ++i) {
            int32_t moving = items[i], j = i;
            for (; j >= gap && before(context, moving, items[j - gap]); j -= gap) {
                items[j] = items[j - gap];
            }
            items[j] = moving;
        }
    }
}

enum { DIGIT_BITS = 11, DIGITS = 1 << DIGIT_BITS };

/* Sorts by one digit. Stable. */
static void SortByDigit(const int32_t* items, int32_t* to, int32_t count, int shift)
{
    int32_t first[DIGITS + 1] = { 0 };
    for (int32_t i = 0; i < count; ++i) {
        first[((items[i] >> shift) & (DIGITS - 1)) + 1] += 1;
    }
    for (int32_t d = 0; d < DIGITS; ++d) {
        first[d + 1] += first[d];
    }
    for (int32_t i = 0; i < count; ++i) {
        to[first[(items[i] >> shift) & (DIGITS - 1)]++] = items[i];
    }
}

void kiriSort_Numbers(int32_t* items, int32_t* room, int32_t count)
{
    enum { FEW = 64 };
    if (count <= FEW) {
        for (int32_t i = 1, j; i < count; ++i) {
            int32_t item = items[i];
            for (j = i; j > 0 && items[j - 1] > item; --j) {
                items[j] = items[j - 1];
            }
            items[j] = item;
        }
        return;
    }
    int32_t all = 0, *from = items, *to = room;
    for (int32_t i = 0; i < count; ++i) {
        KIRI_ASSERT(items[i] >= 0);
        all |= items[i];
    }
    for (int shift = 0; shift < 31 && all >> shift > 0; shift += DIGIT_BITS) {
        SortByDigit(from, to, count, shift);
        from = to;
        to = from == items ? room : items;
    }
    if (from != items) {
        memcpy(items, from, sizeof(*items) * (size_t)count);
    }
}

/* Returns the size class of a span of `count` items. Its capacity is 1 << class. */
static int SizeClassOf(int32_t count)
{
    int size = 0;
    while ((int64_t)1 << size < count) {
        ++size;
    }
    return size;
}

static unsigned char* ItemAt(const void* array, size_t itemBytes, int32_t index)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    KIRI_ASSERT(index >= 0 && index < header.count);
    return (unsigned char*)header.data + (size_t)index * itemBytes;
}

/* Returns the first item of free room of a size class; KIRI_NONE on out of memory. */
static int32_t TakeRoom(kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes, int size)
{
    int32_t first = spans->freeHead[size] - 1;
    if (first != KIRI_NONE) {
        memcpy(&spans->freeHead[size], ItemAt(array, itemBytes, first), sizeof(int32_t));
        return first;
    }
    first = kiriArray_GetHeader(array).count;
    int64_t need = first + ((int64_t)1 << size);
    if (!kiriArray_Grow(memory, array, need, itemBytes)) {
        return KIRI_NONE;
    }
    kiriArrayHeader header = kiriArray_GetHeader(array);
    header.count = (int32_t)need;
    kiriArray_SetHeader(array, header);
    return first;
}

static void GiveRoom(kiriSpans* spans, void* array, size_t itemBytes, int32_t first, int size)
{
    memcpy(ItemAt(array, itemBytes, first), &spans->freeHead[size], sizeof(int32_t));
    spans->freeHead[size] = first + 1;
}

/* Moves the span into free room of the new size, so that its room stays whole: halves are never joined again. Without
   free room the span keeps the start of its room and frees the upper halves. */
static void ShrinkSpan(kiriSpan* span, kiriSpans* spans, void* array, size_t itemBytes, int32_t count)
{
    int from = SizeClassOf(span->count), to = SizeClassOf(count);
    int32_t was = span->first;
    if (spans->freeHead[to] != 0) {
        span->first = TakeRoom(spans, NULL, array, itemBytes, to);
        memcpy(ItemAt(array, itemBytes, span->first), ItemAt(array, itemBytes, was), itemBytes * (size_t)count);
        GiveRoom(spans, array, itemBytes, was, from);
        return;
    }
    for (int size = to; size < from; ++size) {
        GiveRoom(spans, array, itemBytes, was + ((int32_t)1 << size), size);
    }
}

bool kiriSpan_Resize(kiriSpan* span, kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes, int32_t count)
{
    KIRI_ASSERT(count >= 0 && span->count >= 0 && itemBytes >= sizeof(int32_t));
    int from = SizeClassOf(span->count), to = SizeClassOf(count);
    if (count > 0 && (span->count == 0 || from < to)) {
        int32_t first = TakeRoom(spans, memory, array, itemBytes, to);
        if (first == KIRI_NONE) {
            return false;
        }
        if (span->count > 0) {
            memcpy(ItemAt(array, itemBytes, first), ItemAt(array, itemBytes, span->first),
                   itemBytes * (size_t)span->count);
            GiveRoom(spans, array, itemBytes, span->first, from);
        }
        span->first = first;
    } else if (count == 0 && span->count > 0) {
        GiveRoom(spans, array, itemBytes, span->first, from);
    } else if (count > 0 && to < from) {
        ShrinkSpan(span, spans, array, itemBytes, count);
    }
    span->count = count;
    return true;
}

