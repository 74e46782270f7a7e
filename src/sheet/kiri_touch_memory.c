#include "kiri_touch_memory.h"

#include "../core/kiri_sort.h"

/* The first that has this key or a larger one. */
static int32_t FindForce(const kiriTouchMemory* memory, uint64_t key)
{
    int32_t low;
    KIRI_SEARCH(low, 0, memory->forces.count, memory->forces.data[middle].key < key);
    return low;
}

bool kiriTouchMemory_Find(const kiriTouchMemory* memory, uint64_t key, kiriVec3* force)
{
    int32_t at = FindForce(memory, key);
    bool found = at < memory->forces.count && memory->forces.data[at].key == key;
    *force = found ? memory->forces.data[at].force : *force;
    return found;
}

void kiriTouchMemory_Add(kiriTouchMemory* memory, const kiriTouch* touch, kiriVec3 force)
{
    KIRI_ASSERT(memory->touches.count < memory->touches.capacity);
    memory->given += kiriTouch_IsOfKind(touch, KIRI_TOUCH_HOST);
    memory->touches.data[memory->touches.count] = *touch;
    memory->touches.data[memory->touches.count++].force = force;
}

static bool IsKeyBefore(const void* context, int32_t a, int32_t b)
{
    const kiriTouch* touches = context;
    return touches[a].key < touches[b].key || (touches[a].key == touches[b].key && a < b);
}

/* From the last one on, so that those that are there move up once. Of equal keys the older force comes first. */
static void MergeForces(kiriTouchMemory* memory, const int32_t* order, int32_t count)
{
    int32_t left = memory->forces.count;
    memory->forces.count += count;
    KIRI_ASSERT(memory->forces.count <= memory->forces.capacity);
    for (int32_t to = memory->forces.count - 1; count > 0; --to) {
        const kiriTouch* added = &memory->touches.data[order[count - 1]];
        if (left > 0 && memory->forces.data[left - 1].key > added->key) {
            memory->forces.data[to] = memory->forces.data[--left];
        } else {
            memory->forces.data[to].key = added->key;
            memory->forces.data[to].force = added->force;
            count -= 1;
        }
    }
}

void kiriTouchMemory_SortForces(kiriTouchMemory* memory, int32_t first, kiriIndices* order)
{
    order->count = 0;
    for (int32_t i = first; i < memory->touches.count; ++i) {
        kiriVec3 force = memory->touches.data[i].force;
        if (kiriVec3_Dot(force, force) > 0.0) {
            KIRI_ASSERT(order->count < order->capacity);
            order->data[order->count++] = i;
        }
    }
    kiriSort(order->data, order->count, IsKeyBefore, memory->touches.data);
    MergeForces(memory, order->data, order->count);
}

static bool IsNone(kiriVec3 force)
{
    return force.x == 0.0 && force.y == 0.0 && force.z == 0.0;
}

kiriVec3 kiriTouchMemory_Take(kiriTouchMemory* memory, uint64_t key)
{
    const kiriVec3 none = { 0.0, 0.0, 0.0 };
    for (int32_t at = FindForce(memory, key); at < memory->forces.count && memory->forces.data[at].key == key; ++at) {
        kiriVec3 force = memory->forces.data[at].force;
        if (!IsNone(force)) {
            memory->forces.data[at].force = none;
            return force;
        }
    }
    return none;
}

void kiriTouchMemory_DropTaken(kiriTouchMemory* memory)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < memory->forces.count; ++i) {
        if (!IsNone(memory->forces.data[i].force)) {
            memory->forces.data[kept++] = memory->forces.data[i];
        }
    }
    memory->forces.count = kept;
}
