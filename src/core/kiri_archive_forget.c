#include "kiri_archive.h"

#include <string.h>

/* Else there is nothing to give back. */
static bool HasMemory(const kiriTable* table)
{
    bool has = false;
    for (int32_t k = 0; k < table->count && !has; ++k) {
        const kiriMember* member = &table->fields[k];
        has = member->kind == KIRI_MEMBER_PART
                  ? HasMemory(member->table)
                  : member->kind != KIRI_MEMBER_RUN && member->kind != KIRI_MEMBER_BOOLS &&
                        member->kind != KIRI_MEMBER_CUSTOM && member->kind != KIRI_MEMBER_DROPPED;
    }
    return has;
}

static void ForgetObjects(const kiriTable* table, void* objects, int64_t count, kiriMemory* memory)
{
    for (int64_t n = 0; n < count && HasMemory(table); ++n) {
        kiriArchive_Forget(table, (uint8_t*)objects + n * table->size, memory);
    }
}

static void ForgetOwned(const kiriTable* table, void* pointer, kiriMemory* memory)
{
    void* object;
    memcpy(&object, pointer, sizeof(object));
    if (object != NULL) {
        kiriArchive_Forget(table, object, memory);
        kiriMemory_Free(memory, object);
    }
}

static void ForgetArray(const kiriMember* member, void* array, kiriMemory* memory)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (member->kind == KIRI_MEMBER_PARTS) {
        ForgetObjects(member->table, header.data, header.count, memory);
    }
    kiriArray_Release(memory, array);
}

void kiriArchive_Forget(const kiriTable* table, void* object, kiriMemory* memory)
{
    for (int32_t k = 0; k < table->count; ++k) {
        const kiriMember* member = &table->fields[k];
        void* at = (uint8_t*)object + member->offset;
        switch (member->kind) {
        case KIRI_MEMBER_PART:
            ForgetObjects(member->table, at, member->size / member->table->size, memory);
            break;
        case KIRI_MEMBER_OWNED:
            ForgetOwned(member->table, at, memory);
            break;
        case KIRI_MEMBER_ITEMS:
        case KIRI_MEMBER_PARTS:
        case KIRI_MEMBER_ROOM:
        case KIRI_MEMBER_SPACE:
            ForgetArray(member, at, memory);
            break;
        default:
            break;
        }
    }
    memset(object, 0, (size_t)table->size);
}
