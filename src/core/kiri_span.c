#include "kiri_span.h"

#include <string.h>

/* The size class of a span with so many items: its room is 1 << class. */
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

/* Room of a size class; KIRI_NONE for memory. */
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

/* Moves into free room of the new size, so that its own stays whole: halves are never joined again. Where there is no
   free room it keeps the start of its own and gives back the halves that it no longer needs. */
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

bool kiriSpan_IsAlike(kiriSpan a, kiriSpan b)
{
    return a.count > 0 && b.count > 0 && SizeClassOf(a.count) == SizeClassOf(b.count);
}
