#include "kiri_base.h"

#include <stdlib.h>

static void* DefaultAlloc(void* user, int64_t bytes)
{
    (void)user;
    return malloc((size_t)bytes);
}

static void DefaultFree(void* user, void* pointer)
{
    (void)user;
    free(pointer);
}

kiriMemory kiriMemory_Make(kiriAllocFn* alloc, kiriFreeFn* free, void* user)
{
    kiriMemory memory = { DefaultAlloc, DefaultFree, NULL };
    if (alloc != NULL) {
        memory.alloc = alloc;
        memory.free = free;
        memory.user = user;
    }
    return memory;
}

void* kiriMemory_Alloc(const kiriMemory* memory, int64_t bytes)
{
    return memory->alloc(memory->user, bytes > 0 ? bytes : 1);
}

void kiriMemory_Free(const kiriMemory* memory, void* pointer)
{
    if (pointer != NULL) {
        memory->free(memory->user, pointer);
    }
}
