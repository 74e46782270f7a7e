#include "kiri_base.h"

#include <stdlib.h>

#if defined(KIRI_ASSERTS)
#include <stdio.h>

void kiriAssertFailed(const char* condition, const char* file, int line)
{
    fprintf(stderr, "%s:%d: assertion failed: %s\n", file, line, condition);
    abort();
}
#endif

enum { HEADER_BYTES = 16 }; /* keeps the alignment of the host's block */

/* Fails to compile where a block's header does not fit. */
typedef char HeaderFits[sizeof(kiriBlock) <= HEADER_BYTES ? 1 : -1];

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

static void* RefuseAlloc(void* user, int64_t bytes)
{
    (void)user;
    (void)bytes;
    return NULL;
}

kiriMemory kiriMemory_Make(kiriAllocFn* alloc, kiriFreeFn* free, void* user)
{
    kiriMemory memory = { DefaultAlloc, DefaultFree, NULL, NULL, NULL, 0, 0, false, false };
    if (alloc != NULL) {
        memory.alloc = alloc;
        memory.free = free;
        memory.user = user;
    }
    return memory;
}

kiriMemory kiriMemory_Like(const kiriMemory* memory)
{
    return kiriMemory_Make(memory->alloc, memory->free, memory->user);
}

kiriMemory kiriMemory_None(void)
{
    return kiriMemory_Make(RefuseAlloc, DefaultFree, NULL);
}

static kiriBlock* BlockOf(void* pointer)
{
    return (kiriBlock*)((char*)pointer - HEADER_BYTES);
}

static void LinkBlock(kiriMemory* memory, kiriBlock* block)
{
    block->next = memory->blocks;
    block->link = &memory->blocks;
    if (block->next != NULL) {
        block->next->link = &block->next;
    }
    memory->blocks = block;
}

static void UnlinkBlock(kiriBlock* block)
{
    KIRI_ASSERT(*block->link == block);
    *block->link = block->next;
    if (block->next != NULL) {
        block->next->link = block->link;
    }
}

static void* AllocOfHost(kiriMemory* memory, int64_t bytes)
{
    kiriBlock* block = memory->alloc(memory->user, bytes + HEADER_BYTES);
    if (block == NULL) {
        return NULL;
    }
    LinkBlock(memory, block);
    return (char*)block + HEADER_BYTES;
}

static void RefillSpare(kiriMemory* memory)
{
    if (memory->spare == NULL) {
        memory->spareBytes = 2 * memory->largest;
        memory->spare = AllocOfHost(memory, memory->spareBytes);
    }
}

void* kiriMemory_Alloc(kiriMemory* memory, int64_t bytes)
{
    KIRI_ASSERT(bytes >= 0);
    if (memory->isSparing) {
        RefillSpare(memory); /* an item may be refused more than once */
    }
    void* pointer = AllocOfHost(memory, bytes);
    memory->largest = kiriMax(memory->largest, bytes);
    if (pointer == NULL) {
        memory->wasRefused = true;
        if (memory->isSparing && memory->spare != NULL && bytes <= memory->spareBytes) {
            pointer = memory->spare;
            memory->spare = NULL;
        }
    }
    return pointer;
}

void kiriMemory_BeginSparing(kiriMemory* memory)
{
    KIRI_ASSERT(!memory->isSparing);
    if (memory->spare != NULL && memory->spareBytes < memory->largest) {
        kiriMemory_DropSpare(memory);
    }
    RefillSpare(memory);
    memory->isSparing = true;
    memory->wasRefused = false;
}

void kiriMemory_EndSparing(kiriMemory* memory)
{
    memory->isSparing = false;
}

void kiriMemory_DropSpare(kiriMemory* memory)
{
    kiriMemory_Free(memory, memory->spare);
    memory->spare = NULL;
}

void* kiriMemory_AllocZeroed(kiriMemory* memory, int64_t bytes)
{
    void* pointer = kiriMemory_Alloc(memory, bytes);
    return pointer != NULL ? memset(pointer, 0, (size_t)bytes) : NULL;
}

void kiriMemory_Free(kiriMemory* memory, void* pointer)
{
    if (pointer != NULL) {
        UnlinkBlock(BlockOf(pointer));
        memory->free(memory->user, BlockOf(pointer));
    }
}

void kiriMemory_FreeAll(kiriMemory* memory)
{
    while (memory->blocks != NULL) {
        kiriBlock* block = memory->blocks;
        memory->blocks = block->next;
        memory->free(memory->user, block);
    }
    memory->spare = NULL;
}

void kiriMemory_Adopt(kiriMemory* memory, void* pointer)
{
    if (pointer != NULL) {
        UnlinkBlock(BlockOf(pointer));
        LinkBlock(memory, BlockOf(pointer));
    }
}

void kiriMemory_AdoptAll(kiriMemory* memory, kiriMemory* from)
{
    while (from->blocks != NULL) {
        kiriBlock* block = from->blocks;
        UnlinkBlock(block);
        LinkBlock(memory, block);
    }
    from->spare = NULL;
}

#define RANGES_A_WORKER 8 /* so that they end at about the same time, though some items take longer than others */

void kiriTasks_Run(const kiriTasks* tasks, kiriTaskFn* task, int32_t count, int32_t least, void* context)
{
    KIRI_ASSERT(count >= 0 && least >= 1);
    if (!kiriTasks_AreGiven(tasks) || count <= least) {
        task(0, count, context);
        return;
    }
    int32_t even = count / tasks->workers / RANGES_A_WORKER;
    void* handle = tasks->start(tasks->user, task, count, kiriMax(even, least), context);
    if (handle != NULL) {
        tasks->finish(tasks->user, handle);
    }
}
