/* Growable arrays. KIRI_ARRAY(T) declares one; a zeroed one is empty. Growing keeps what is there, or fails and changes
   nothing. */
#ifndef KIRI_ARRAY_H
#define KIRI_ARRAY_H

#include "kiri_base.h"

#ifdef __cplusplus
extern "C" {
#endif

#define KIRI_ARRAY(T)                                                                                                  \
    struct {                                                                                                           \
        T* data;                                                                                                       \
        int32_t count;                                                                                                 \
        int32_t capacity;                                                                                              \
    }

/* What every KIRI_ARRAY looks like. Functions for any of them copy it out and back with memcpy, for the type of `data`
   differs. */
typedef struct kiriArrayHeader {
    void* data;
    int32_t count;
    int32_t capacity;
} kiriArrayHeader;

kiriArrayHeader kiriArray_GetHeader(const void* array);
void kiriArray_SetHeader(void* array, kiriArrayHeader header);

/* Makes room for `need` items in all. `array` points to a KIRI_ARRAY whose items have itemBytes. */
bool kiriArray_Grow(kiriMemory* memory, void* array, int64_t need, size_t itemBytes);

/* Frees the items and leaves the array empty. */
void kiriArray_Release(kiriMemory* memory, void* array);

#define kiriArray_Reserve(memory, array, need)                                                                         \
    ((int64_t)(need) <= (array)->capacity || kiriArray_Grow((memory), (array), (need), sizeof(*(array)->data)))

/* Room for `size` items, and the count set to it; new items are not initialised. */
#define kiriArray_Resize(memory, array, size)                                                                          \
    (kiriArray_Reserve(memory, array, size) ? ((array)->count = (int32_t)(size), true) : false)

#define kiriArray_Push(memory, array, item)                                                                            \
    (kiriArray_Reserve(memory, array, (int64_t)(array)->count + 1) ? ((array)->data[(array)->count++] = (item), true)  \
                                                                   : false)

#ifdef __cplusplus
}
#endif

#endif
