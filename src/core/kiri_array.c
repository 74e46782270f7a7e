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

bool kiriArray_Grow(kiriMemory* memory, void* array, int64_t need, size_t itemBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (need <= header.capacity) {
        return true;
    }
    /* An eighth more even at first, so that the first cut does not copy the whole sheet. */
    int64_t capacity = 2 * (int64_t)header.capacity, least = need + need / 8;
    capacity = capacity < least ? least : capacity;
    capacity = capacity < 8 ? 8 : capacity;
    capacity = capacity > INT32_MAX ? INT32_MAX : capacity;
    if (capacity < need) {
        return false;
    }
    void* data = kiriMemory_Alloc(memory, capacity * (int64_t)itemBytes);
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

void kiriArray_Release(kiriMemory* memory, void* array)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    const kiriArrayHeader empty = { NULL, 0, 0 };
    kiriMemory_Free(memory, header.data);
    kiriArray_SetHeader(array, empty);
}
