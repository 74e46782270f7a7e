#include "kiri_array.h"

#include <string.h>

/* What every KIRI_ARRAY looks like. Read and written with memcpy, for the type of `data` differs. */
typedef struct Header {
    void* data;
    int32_t count;
    int32_t capacity;
} Header;

bool kiriArray_Grow(kiriMemory* memory, void* array, int64_t need, size_t itemBytes)
{
    Header header;
    memcpy(&header, array, sizeof(header));
    if (need <= header.capacity) {
        return true;
    }
    /* An eighth more even at first: what was made at once is not copied by the first cut. */
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
    memcpy(array, &header, sizeof(header));
    return true;
}

void kiriArray_Release(kiriMemory* memory, void* array)
{
    Header header;
    memcpy(&header, array, sizeof(header));
    kiriMemory_Free(memory, header.data);
    memset(array, 0, sizeof(header));
}
