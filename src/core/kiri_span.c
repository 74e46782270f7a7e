#include "kiri_span.h"

#include <string.h>

/* Any KIRI_ARRAY. */
typedef KIRI_ARRAY(unsigned char) Bytes;

/* The size class of a span with so many items: its room is 1 << class. */
static int SizeOf(int32_t count)
{
    int size = 0;
    while ((int64_t)1 << size < count) {
        ++size;
    }
    return size;
}

static void* ItemAt(void* array, size_t itemBytes, int32_t index)
{
    return ((Bytes*)array)->data + (size_t)index * itemBytes;
}

/* Room of a size class; KIRI_NONE for memory. */
static int32_t Take(kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes, int size)
{
    int32_t first = spans->freeHead[size] - 1;
    if (first != KIRI_NONE) {
        memcpy(&spans->freeHead[size], ItemAt(array, itemBytes, first), sizeof(int32_t));
        return first;
    }
    Bytes* bytes = array;
    int64_t need = bytes->count + ((int64_t)1 << size);
    if (need > bytes->capacity && !kiriArray_Grow(memory, array, need, itemBytes)) {
        return KIRI_NONE;
    }
    first = bytes->count;
    bytes->count = (int32_t)need;
    return first;
}

static void Give(kiriSpans* spans, void* array, size_t itemBytes, int32_t first, int size)
{
    memcpy(ItemAt(array, itemBytes, first), &spans->freeHead[size], sizeof(int32_t));
    spans->freeHead[size] = first + 1;
}

bool kiriSpan_Resize(kiriSpan* span, kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes, int32_t count)
{
    int from = SizeOf(span->count), to = SizeOf(count);
    if (count > 0 && (span->count == 0 || from < to)) {
        int32_t first = Take(spans, memory, array, itemBytes, to);
        if (first == KIRI_NONE) {
            return false;
        }
        if (span->count > 0) {
            memcpy(ItemAt(array, itemBytes, first), ItemAt(array, itemBytes, span->first),
                   itemBytes * (size_t)span->count);
            Give(spans, array, itemBytes, span->first, from);
        }
        span->first = first;
    } else if (count == 0 && span->count > 0) {
        Give(spans, array, itemBytes, span->first, from);
    } else if (count > 0 && to < from) {
        /* The halves of its room that it no longer needs. */
        for (int size = to; size < from; ++size) {
            Give(spans, array, itemBytes, span->first + ((int32_t)1 << size), size);
        }
    }
    span->count = count;
    return true;
}
