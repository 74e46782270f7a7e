/* What touches pushed with, by key: of those of the last tick, and of those of pieces that sleep. */
#ifndef KIRI_TOUCH_MEMORY_H
#define KIRI_TOUCH_MEMORY_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

static inline bool kiriTouch_IsOfKind(const kiriTouch* touch, int32_t kind)
{
    return touch->key >> 60 == (uint64_t)kind;
}

/* Remembers a touch with its force. There is room. Forces are found by key after kiriTouchMemory_SortForces. */
void kiriTouchMemory_Add(kiriTouchMemory* memory, const kiriTouch* touch, kiriVec3 force);

/* Sorts the forces of the touches from `first` on, but for those that are zero, into those that are there. `order` has
   room for as many. */
void kiriTouchMemory_SortForces(kiriTouchMemory* memory, int32_t first, kiriIndices* order);

/* The force of that key; false, and *force as it was, where there is none. */
bool kiriTouchMemory_Find(const kiriTouchMemory* memory, uint64_t key, kiriVec3* force);

/* Takes the first force of that key that was not taken; zero where there is none. It stays in its place, as zero, until
   all are dropped that were taken. */
kiriVec3 kiriTouchMemory_Take(kiriTouchMemory* memory, uint64_t key);
void kiriTouchMemory_DropTaken(kiriTouchMemory* memory);

KIRI_C_END

#endif
