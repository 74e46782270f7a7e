/* Ids: 3 bits kind, 7 bits generation, 22 bits slot. An id of another kind, or a stale id, finds nothing. Generations
   start at 1, so no id is 0. A slot with all generations used is retired, so no id repeats. */
#ifndef KIRI_POOL_H
#define KIRI_POOL_H

#include "kiri_array.h"

KIRI_C_BEGIN

enum {
    KIRI_KIND_SHEET = 0,
    KIRI_KIND_CUT = 1,
    KIRI_KIND_FRAME = 2,
    KIRI_KIND_PIN = 3,
    KIRI_KIND_OBSTACLE = 4,
    KIRI_KIND_BLADE = 5,
    KIRI_KIND_SEAM = 6
};

typedef struct kiriSlot {
    void* owner;   /* null: free */
    int32_t index; /* in the owner's array, or the next free slot */
    uint32_t generation;
} kiriSlot;

typedef struct kiriPool {
    uint32_t kind;
    int32_t freeSlot, freeCount;
    KIRI_ARRAY(kiriSlot) slots;
} kiriPool;

void kiriPool_Init(kiriPool* pool, uint32_t kind);

/* Returns true if `count` ids are left. */
bool kiriPool_HasRoom(const kiriPool* pool, int64_t count);

/* Makes `count` calls of Add safe from failure. Returns false if fewer ids are left, or on out of memory. */
bool kiriPool_Reserve(kiriPool* pool, kiriMemory* memory, int32_t count);

/* Returns an id; 0 if none is left, or on out of memory. */
uint32_t kiriPool_Add(kiriPool* pool, kiriMemory* memory, void* owner, int32_t index);

/* Returns null for a stale or foreign id. */
kiriSlot* kiriPool_Find(const kiriPool* pool, uint32_t id);
void kiriPool_Remove(kiriPool* pool, uint32_t id);

/* Sets the owner of an id in a pool that was loaded without owners. Returns false if the id is not free. */
bool kiriPool_Claim(kiriPool* pool, uint32_t id, void* owner, int32_t index);

KIRI_C_END

#endif
