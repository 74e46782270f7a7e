#include "kiri_pool.h"

enum {
    ID_SLOT_BITS = 22,
    ID_GENERATION_BITS = 7,
    ID_KIND_SHIFT = ID_SLOT_BITS + ID_GENERATION_BITS,
    MOST_SLOTS = 1 << ID_SLOT_BITS,
    LAST_GENERATION = (1 << ID_GENERATION_BITS) - 1
};

void kiriPool_Init(kiriPool* pool, uint32_t kind)
{
    KIRI_ASSERT(kind >> (32 - ID_KIND_SHIFT) == 0);
    kiriPool empty = { kind, KIRI_NONE, 0, { NULL, 0, 0 } };
    *pool = empty;
}

bool kiriPool_HasRoom(const kiriPool* pool, int64_t count)
{
    return count <= (int64_t)pool->freeCount + MOST_SLOTS - pool->slots.count;
}

bool kiriPool_Reserve(kiriPool* pool, kiriMemory* memory, int32_t count)
{
    KIRI_ASSERT(count >= 0);
    int64_t fresh = count > pool->freeCount ? (int64_t)count - pool->freeCount : 0;
    return kiriPool_HasRoom(pool, count) && kiriArray_Reserve(memory, &pool->slots, pool->slots.count + fresh);
}

uint32_t kiriPool_Add(kiriPool* pool, kiriMemory* memory, void* owner, int32_t index)
{
    KIRI_ASSERT(owner != NULL);
    int32_t slot = pool->freeSlot;
    if (slot != KIRI_NONE) {
        pool->freeSlot = pool->slots.data[slot].index;
        pool->freeCount -= 1;
    } else {
        kiriSlot fresh = { NULL, 0, 1u };
        if (!kiriPool_Reserve(pool, memory, 1)) {
            return 0;
        }
        slot = pool->slots.count++;
        pool->slots.data[slot] = fresh;
    }
    kiriSlot* s = &pool->slots.data[slot];
    KIRI_ASSERT(s->owner == NULL);
    s->owner = owner;
    s->index = index;
    return pool->kind << ID_KIND_SHIFT | s->generation << ID_SLOT_BITS | (uint32_t)slot;
}

/* Returns the slot of an id of this kind and generation, or null. */
static kiriSlot* SlotOfId(const kiriPool* pool, uint32_t id)
{
    uint32_t slot = id & (MOST_SLOTS - 1), generation = id >> ID_SLOT_BITS & LAST_GENERATION;
    bool isKnown = id >> ID_KIND_SHIFT == pool->kind && slot < (uint32_t)pool->slots.count;
    return isKnown && pool->slots.data[slot].generation == generation ? &pool->slots.data[slot] : NULL;
}

kiriSlot* kiriPool_Find(const kiriPool* pool, uint32_t id)
{
    kiriSlot* s = SlotOfId(pool, id);
    return s != NULL && s->owner != NULL ? s : NULL;
}

bool kiriPool_Claim(kiriPool* pool, uint32_t id, void* owner, int32_t index)
{
    kiriSlot* s = SlotOfId(pool, id);
    bool isFree = s != NULL && s->owner == NULL && s->index == index;
    if (isFree) {
        s->owner = owner;
    }
    return isFree;
}

void kiriPool_Remove(kiriPool* pool, uint32_t id)
{
    kiriSlot* s = kiriPool_Find(pool, id);
    if (s == NULL) {
        return;
    }
    s->owner = NULL;
    if (s->generation < LAST_GENERATION) {
        s->generation += 1;
        s->index = pool->freeSlot;
        pool->freeSlot = (int32_t)(id & (MOST_SLOTS - 1));
        pool->freeCount += 1;
    }
}
