#include "kiri_call.h"
#include "kiri_save.h"

kiriResult kiriWorld_Save(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    KIRI_READS(world);
    KIRI_CHECK(size != NULL && capacity >= 0, "size is null, or capacity below 0");
    kiriResult result = kiriSave_Write(world, bytes, capacity, size);
    KIRI_CHECK(result == KIRI_OK, "capacity is less than the bytes of a save");
    return KIRI_OK;
}

kiriResult kiriWorld_Load(kiriWorld* world, const void* bytes, int64_t size)
{
    int32_t count = size <= INT32_MAX ? (int32_t)size : INT32_MIN; /* recordings have no larger arrays */
    KIRI_CHANGES(world, KIRI_CALL_WORLD_LOAD, bytes, &count);
    KIRI_CHECK(bytes != NULL && size >= 0, "bytes is null, or size below 0");
    const char* why = NULL;
    kiriResult result = kiriSave_Read(world, bytes, size, true, &why);
    KIRI_RETURN_OR_SAY(result, why);
}

kiriResult kiriWorld_LoadUntrusted(kiriWorld* world, const void* bytes, int64_t size)
{
    int32_t count = size <= INT32_MAX ? (int32_t)size : INT32_MIN;
    KIRI_CHANGES(world, KIRI_CALL_WORLD_LOAD_UNTRUSTED, bytes, &count);
    KIRI_CHECK(bytes != NULL && size >= 0, "bytes is null, or size below 0");
    const char* why = NULL;
    kiriResult result = kiriSave_Read(world, bytes, size, false, &why);
    KIRI_RETURN_OR_SAY(result, why);
}
