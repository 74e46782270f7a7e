/* Ids: kind in 3 bits, generation in 11, slot in 18. An id of another kind, or of something that is gone, finds
   nothing. A slot whose generations are used up is never used again, so no id ever comes twice. */
#ifndef KIRI_POOL_H
#define KIRI_POOL_H

#include "kiri_array.h"

enum { KIRI_KIND_SHEET = 1, KIRI_KIND_CUT = 2, KIRI_KIND_FRAME = 3, KIRI_KIND_PIN = 4 };

typedef struct kiriSlot {
    void* owner;   /* null: free */
    int32_t index; /* in the owner's array, or the next free slot */
    uint32_t generation;
} kiriSlot;

typedef struct kiriPool {
    uint32_t kind;
    int32_t freeSlot;
    KIRI_ARRAY(kiriSlot) slots;
} kiriPool;

void kiriPool_Init(kiriPool* pool, uint32_t kind);

/* After it, `count` calls of Add cannot fail. */
bool kiriPool_Reserve(kiriPool* pool, kiriMemory* memory, int32_t count);

/* 0 when there is no room. */
uint32_t kiriPool_Add(kiriPool* pool, kiriMemory* memory, void* owner, int32_t index);

/* Null for an id that names nothing here. */
kiriSlot* kiriPool_Find(const kiriPool* pool, uint32_t id);
void kiriPool_Remove(kiriPool* pool, uint32_t id);

#endif
