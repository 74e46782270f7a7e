#include "kiri_call.h"
#include "kiri_save.h"
#include "kiri_tick.h"

kiriResult kiriWorld_Save(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    KIRI_READS(world);
    KIRI_CHECK(size != NULL && capacity >= 0, "size is null, or capacity below 0");
    kiriResult result = kiriSave_Write(world, bytes, capacity, size);
    KIRI_CHECK(result != KIRI_ERROR_ARGUMENT, "capacity is less than the bytes of a save");
    return result;
}

kiriResult kiriWorld_Load(kiriWorld* world, const void* bytes, int64_t size)
{
    int32_t count = size <= INT32_MAX ? (int32_t)size : INT32_MIN; /* recordings have no larger arrays */
    KIRI_CHANGES(world, KIRI_CALL_WORLD_LOAD, bytes, &count);
    KIRI_CHECK(bytes != NULL && size >= 0, "bytes is null, or size below 0");
    const char* why = NULL;
    kiriResult result = kiriSave_Read(world, bytes, size, &why);
    KIRI_RETURN_OR_SAY(result, why);
}

kiriResult kiriWorld_FinishCuts(kiriWorld* world)
{
    KIRI_CHANGES(world, KIRI_CALL_WORLD_FINISH_CUTS, NULL);
    world->begun += 1; /* vertices change as in a tick */
    kiriResult result = kiriWorld_FinishUpdates(world);
    KIRI_RETURN_OR_SAY(result, result == KIRI_ERROR_LIMIT ? "there are no ids left for new frames" : NULL);
}

kiriResult kiriWorld_Snapshot(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    KIRI_READS(world);
    KIRI_CHECK(size != NULL && capacity >= 0, "size is null, or capacity below 0");
    kiriResult result = kiriSnapshot_Write(world, bytes, capacity, size);
    KIRI_CHECK(result == KIRI_OK, "capacity is less than the bytes of a snapshot");
    return KIRI_OK;
}

kiriResult kiriWorld_Restore(kiriWorld* world, const void* bytes, int64_t size)
{
    KIRI_PREPARES(world);
    KIRI_CHECK(bytes != NULL && size >= 0, "bytes is null, or size below 0");
    if (world->recorder.sink.write != NULL) {
        return KIRI_FAIL(KIRI_ERROR_STATE, "the world is recorded: snapshots are of one process, recordings are not");
    }
    kiriResult result = kiriSnapshot_Read(world, bytes, size);
    KIRI_RETURN_OR_SAY(result, result == KIRI_ERROR_DATA ? "the bytes are no snapshot of this build" : NULL);
}
