#include "kiri_pool.h"

enum { SLOT_BITS = 18, GENERATION_BITS = 11, KIND_SHIFT = SLOT_BITS + GENERATION_BITS };

static const uint32_t slotMask = (1u << SLOT_BITS) - 1u;
static const uint32_t generationMask = (1u << GENERATION_BITS) - 1u;

void kiriPool_Init(kiriPool* pool, uint32_t kind)
{
    kiriPool empty = { kind, KIRI_NONE, { NULL, 0, 0 } };
    *pool = empty;
}

bool kiriPool_Reserve(kiriPool* pool, kiriMemory* memory, int32_t count)
{
    int64_t need = (int64_t)pool->slots.count + count;
    for (int32_t slot = pool->freeSlot; slot != KIRI_NONE && count > 0; slot = pool->slots.data[slot].index) {
        need -= 1;
        count -= 1;
    }
    return need <= (int64_t)slotMask + 1 && kiriArray_Reserve(memory, &pool->slots, need);
}

uint32_t kiriPool_Add(kiriPool* pool, kiriMemory* memory, void* owner, int32_t index)
{
    int32_t slot = pool->freeSlot;
    if (slot != KIRI_NONE) {
        pool->freeSlot = pool->slots.data[slot].index;
    } else {
        kiriSlot fresh = { NULL, 0, 1u };
        if (!kiriPool_Reserve(pool, memory, 1)) {
            return 0;
        }
        slot = pool->slots.count++;
        pool->slots.data[slot] = fresh;
    }
    kiriSlot* s = &pool->slots.data[slot];
    s->owner = owner;
    s->index = index;
    return pool->kind << KIND_SHIFT | s->generation << SLOT_BITS | (uint32_t)slot;
}

kiriSlot* kiriPool_Find(const kiriPool* pool, uint32_t id)
{
    uint32_t slot = id & slotMask;
    if (id >> KIND_SHIFT != pool->kind || slot >= (uint32_t)pool->slots.count) {
        return NULL;
    }
    kiriSlot* s = &pool->slots.data[slot];
    return s->owner != NULL && s->generation == (id >> SLOT_BITS & generationMask) ? s : NULL;
}

void kiriPool_Remove(kiriPool* pool, uint32_t id)
{
    kiriSlot* s = kiriPool_Find(pool, id);
    if (s == NULL) {
        return;
    }
    s->owner = NULL;
    if (s->generation < generationMask) {
        s->generation += 1;
        s->index = pool->freeSlot;
        pool->freeSlot = (int32_t)(id & slotMask);
    }
}
