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

/* Another block, of so many items, for what is there. */
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

bool kiriArray_GrowReady(kiriMemory* memory, void* array, int64_t need, size_t itemBytes)
{
    if (!kiriArray_Grow(memory, array, need, itemBytes)) {
        return false;
    }
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (header.capacity > header.count) {
        memset((char*)header.data + (size_t)header.count * itemBytes, 0,
               (size_t)(header.capacity - header.count) * itemBytes);
    }
    return true;
}

kiriProgress kiriArray_Fill(const kiriRoom* room, kiriQuota* quota, int64_t bytesAnItem)
{
    if (!kiriArray_Grow(room->memory, room->array, room->need, room->itemBytes)) {
        return KIRI_FAILED;
    }
    kiriArrayHeader header = kiriArray_GetHeader(room->array);
    int64_t most = bytesAnItem / (int64_t)room->itemBytes;
    while (header.count < room->need) {
        int64_t items = kiriMin(room->need - header.count, most);
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        memset((char*)header.data + (size_t)header.count * room->itemBytes, 0, (size_t)items * room->itemBytes);
        header.count += (int32_t)items;
        kiriArray_SetHeader(room->array, header);
    }
    return KIRI_DONE;
}

kiriProgress kiriRooms_MakeReady(const kiriRoom* rooms, int32_t count, kiriQuota* quota, int64_t bytesAnItem)
{
    for (int32_t i = 0; i < count; ++i) {
        const kiriRoom* room = &rooms[i];
        if (room->need <= kiriArray_GetHeader(room->array).capacity) {
            continue;
        }
        if (!kiriQuota_TakeAtMostAll(quota, room->need * (int64_t)room->itemBytes / bytesAnItem)) {
            return KIRI_MORE;
        }
        if (!kiriArray_GrowReady(room->memory, room->array, room->need, room->itemBytes)) {
            return KIRI_FAILED;
        }
    }
    return KIRI_DONE;
}

/* The new block of an array; false for memory. */
static bool BeginGrowing(kiriGrowing* growing, const kiriRoom* room, kiriArrayHeader header)
{
    kiriGrowing_Drop(growing);
    int64_t capacity = NextCapacity(header.capacity, room->need);
    char* data = capacity < room->need ? NULL : kiriMemory_Alloc(room->memory, capacity * (int64_t)room->itemBytes);
    if (data != NULL) {
        *growing = (kiriGrowing){ room->memory, header.data, data, capacity, 0, growing->owed };
    }
    return data != NULL;
}

static kiriProgress GrowRoom(kiriGrowing* growing, const kiriRoom* room, kiriQuota* quota, int64_t bytesAnItem)
{
    kiriArrayHeader header = kiriArray_GetHeader(room->array);
    int64_t size = header.count * (int64_t)room->itemBytes, atOnce = room->changes && size > 0 ? size : bytesAnItem;
    bool isGrowing = growing->data != NULL && growing->from == header.data && growing->capacity >= room->need;
    if (!isGrowing && !BeginGrowing(growing, room, header)) {
        return KIRI_FAILED;
    }
    while (growing->moved < size) {
        int64_t bytes = kiriMin(size - growing->moved, atOnce);
        if (!kiriQuota_Pay(quota, &growing->owed)) {
            return KIRI_MORE;
        }
        memcpy(growing->data + growing->moved, (const char*)header.data + growing->moved, (size_t)bytes);
        growing->moved += bytes;
        growing->owed += bytes / bytesAnItem;
    }
    kiriMemory_Free(room->memory, header.data);
    header.data = growing->data;
    header.capacity = (int32_t)growing->capacity;
    kiriArray_SetHeader(room->array, header);
    growing->data = NULL;
    return KIRI_DONE;
}

kiriProgress kiriGrowing_GoOn(kiriGrowing* growing, const kiriRoom* rooms, int32_t count, kiriQuota* quota,
                              int64_t bytesAnItem)
{
    kiriProgress progress = KIRI_DONE;
    for (int32_t i = 0; progress == KIRI_DONE && i < count; ++i) {
        if (rooms[i].need > kiriArray_GetHeader(rooms[i].array).capacity) {
            progress = GrowRoom(growing, &rooms[i], quota, bytesAnItem);
        }
    }
    if (progress == KIRI_DONE) {
        kiriGrowing_Drop(growing);
        progress = kiriQuota_Pay(quota, &growing->owed) ? KIRI_DONE : KIRI_MORE;
    }
    return progress;
}

void kiriGrowing_Drop(kiriGrowing* growing)
{
    if (growing->data != NULL) {
        kiriMemory_Free(growing->memory, growing->data);
        growing->data = NULL;
    }
}

void kiriArray_Release(kiriMemory* memory, void* array)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    const kiriArrayHeader empty = { NULL, 0, 0 };
    kiriMemory_Free(memory, header.data);
    kiriArray_SetHeader(array, empty);
}
