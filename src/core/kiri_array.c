#include "kiri_array.h"

kiriArrayHeader kiriArray_GetHeader(const void* array)
{
    kiriArrayHeader header;
    memcpy(&header, array, sizeof(header));
    KIRI_ASSERT(header.count >= 0 && header.count <= header.capacity);
    return header;
}

void kiriArray_SetHeader(void* array, kiriArrayHeader header)
{
    memcpy(array, &header, sizeof(header));
}

void kiriArray_Swap(void* a, void* b)
{
    kiriArrayHeader header = kiriArray_GetHeader(a);
    kiriArray_SetHeader(a, kiriArray_GetHeader(b));
    kiriArray_SetHeader(b, header);
}

/* Moves the items to a new block of `capacity` items. The old one gets the owner `retired`; null: it is freed. */
static bool MoveArray(kiriMemory* memory, void* array, int64_t capacity, size_t itemBytes, kiriMemory* retired)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    void* data = capacity > INT32_MAX ? NULL : kiriMemory_Alloc(memory, capacity * (int64_t)itemBytes);
    if (data == NULL) {
        return false;
    }
    if (header.count > 0) {
        memcpy(data, header.data, header.count * itemBytes);
    }
    if (retired != NULL) {
        kiriMemory_Adopt(retired, header.data);
    } else {
        kiriMemory_Free(memory, header.data);
    }
    header.data = data;
    header.capacity = (int32_t)capacity;
    kiriArray_SetHeader(array, header);
    return true;
}

bool kiriArray_Grow(kiriMemory* memory, void* array, int64_t need, size_t itemBytes)
{
    int64_t has = kiriArray_GetHeader(array).capacity;
    /* An eighth more even at first, so that the first cut does not copy the whole sheet. Small arrays double. */
    int64_t capacity = kiriMax(need + need / 8, has < 4096 ? 2 * has : has + has / 4);
    capacity = kiriMin(INT32_MAX, kiriMax(8, capacity));
    return need <= has || (capacity >= need && MoveArray(memory, array, capacity, itemBytes, NULL));
}

bool kiriArrays_Grow(kiriMemory* memory, int64_t need, const kiriAnyArray* arrays)
{
    bool ok = true;
    for (; ok && arrays->array != NULL; ++arrays) {
        ok = kiriArray_Grow(memory, arrays->array, need, arrays->itemBytes);
    }
    return ok;
}

bool kiriArrays_SetCount(kiriMemory* memory, int64_t size, const kiriAnyArray* arrays)
{
    bool ok = kiriArrays_Grow(memory, size, arrays);
    for (; ok && arrays->array != NULL; ++arrays) {
        kiriArrayHeader header = kiriArray_GetHeader(arrays->array);
        header.count = (int32_t)size;
        kiriArray_SetHeader(arrays->array, header);
    }
    return ok;
}

bool kiriArray_GrowTo(kiriMemory* memory, void* array, int64_t need, size_t itemBytes)
{
    return need <= kiriArray_GetHeader(array).capacity || MoveArray(memory, array, need, itemBytes, NULL);
}

void kiriArray_Shorten(kiriMemory* memory, void* array, size_t itemBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    int64_t enough = header.count + (int64_t)header.count / 8;
    if (header.count > 0 && enough < header.capacity) {
        MoveArray(memory, array, enough, itemBytes, NULL);
    }
}

bool kiriArray_Renew(kiriMemory* memory, void* array, size_t itemBytes, kiriMemory* retired)
{
    return MoveArray(memory, array, kiriArray_GetHeader(array).capacity, itemBytes, retired);
}

void kiriArray_SetFrom(void* array, int32_t from, int byte, size_t itemBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (header.count > from) {
        memset((char*)header.data + from * itemBytes, byte, (header.count - from) * itemBytes);
    }
}

void kiriArray_ExtendTo(void* array, int32_t size, int byte, size_t itemBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    int32_t from = header.count;
    KIRI_ASSERT(size <= header.capacity);
    header.count = kiriMax(size, from);
    kiriArray_SetHeader(array, header);
    kiriArray_SetFrom(array, from, byte, itemBytes);
}

void kiriArray_Release(kiriMemory* memory, void* array)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    const kiriArrayHeader empty = { 0 };
    kiriMemory_Free(memory, header.data);
    kiriArray_SetHeader(array, empty);
}

static bool IsLess(const void* context, int32_t a, int32_t b)
{
    (void)context;
    return a < b;
}

/* Shell sort (1959) with Knuth's gaps: little code, and fast on nearly sorted input. */
void kiriSort(int32_t* items, int32_t count, kiriBeforeFn* before, const void* context)
{
    KIRI_ASSERT(count >= 0);
    int32_t gap = 1;
    before = before != NULL ? before : IsLess;
    while (gap < count / 3) {
        gap = 3 * gap + 1;
    }
    for (; gap > 0; gap /= 3) {
        KIRI_FROM_TO(i, gap, count) {
            int32_t moving = items[i], j = i;
            for (; j >= gap && before(context, moving, items[j - gap]); j -= gap) {
                items[j] = items[j - gap];
            }
            items[j] = moving;
        }
    }
}

bool kiriSort_Order(kiriMemory* memory, kiriIndices* order, int32_t count, kiriBeforeFn* before,
                    const void* context)
{
    if (!kiriArray_Resize(memory, order, count)) {
        return false;
    }
    KIRI_EACH_INDEX(i, *order) {
        order->data[i] = i;
    }
    kiriSort(order->data, count, before, context);
    return true;
}

/* Returns the size class of a span of `count` items. Its capacity is 1 << class. */
static int SizeClassOf(int32_t count)
{
    int size = 0;
    while ((int64_t)1 << size < count) {
        ++size;
    }
    return size;
}

static unsigned char* ItemAt(const void* array, size_t itemBytes, int32_t index)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    KIRI_ASSERT_HAS(header, index);
    return (unsigned char*)header.data + index * itemBytes;
}

/* Returns the first item of free room of a size class; KIRI_NONE on out of memory. */
static int32_t TakeRoom(kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes, int size)
{
    int32_t first = spans->freeHead[size] - 1;
    if (first != KIRI_NONE) {
        memcpy(&spans->freeHead[size], ItemAt(array, itemBytes, first), sizeof(int32_t));
        return first;
    }
    first = kiriArray_GetHeader(array).count;
    int64_t need = first + ((int64_t)1 << size);
    bool ok = kiriArrays_SetCount(memory, need, (const kiriAnyArray[]){ { array, itemBytes }, { NULL, 0 } });
    return ok ? first : KIRI_NONE;
}

static void GiveRoom(kiriSpans* spans, void* array, size_t itemBytes, int32_t first, int size)
{
    memcpy(ItemAt(array, itemBytes, first), &spans->freeHead[size], sizeof(int32_t));
    spans->freeHead[size] = first + 1;
}

/* Moves the span into free room of the new size, so that its room stays whole: halves are never joined again. Without
   free room the span keeps the start of its room and frees the upper halves. */
static void ShrinkSpan(kiriSpan* span, kiriSpans* spans, void* array, size_t itemBytes, int32_t count)
{
    int from = SizeClassOf(span->count), to = SizeClassOf(count);
    int32_t was = span->first;
    if (spans->freeHead[to] != 0) {
        span->first = TakeRoom(spans, NULL, array, itemBytes, to);
        memcpy(ItemAt(array, itemBytes, span->first), ItemAt(array, itemBytes, was), itemBytes * count);
        GiveRoom(spans, array, itemBytes, was, from);
        return;
    }
    KIRI_FROM_TO(size, to, from) {
        GiveRoom(spans, array, itemBytes, was + ((int32_t)1 << size), size);
    }
}

bool kiriSpan_Resize(kiriSpan* span, kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes, int32_t count)
{
    KIRI_ASSERT(count >= 0 && span->count >= 0 && itemBytes >= sizeof(int32_t));
    int from = SizeClassOf(span->count), to = SizeClassOf(count);
    if (count > 0 && (span->count == 0 || from < to)) {
        int32_t first = TakeRoom(spans, memory, array, itemBytes, to);
        if (first == KIRI_NONE) {
            return false;
        }
        if (span->count > 0) {
            memcpy(ItemAt(array, itemBytes, first), ItemAt(array, itemBytes, span->first),
                   itemBytes * span->count);
            GiveRoom(spans, array, itemBytes, span->first, from);
        }
        span->first = first;
    } else if (count == 0 && span->count > 0) {
        GiveRoom(spans, array, itemBytes, span->first, from);
    } else if (count > 0 && to < from) {
        ShrinkSpan(span, spans, array, itemBytes, count);
    }
    span->count = count;
    return true;
}

static kiriSpan* SpanAt(kiriSpan* spans, size_t strideBytes, int32_t group)
{
    KIRI_ASSERT(group >= 0);
    return (kiriSpan*)((char*)spans + strideBytes * group);
}

int32_t kiriSpans_Group(const int32_t* of, int32_t count, kiriSpan* spans, size_t strideBytes, int32_t groups,
                        int32_t* items)
{
    int32_t all = 0;
    KIRI_TIMES(g, groups) {
        SpanAt(spans, strideBytes, g)->count = 0;
    }
    KIRI_TIMES(i, count) {
        KIRI_ASSERT(of[i] >= KIRI_NONE && of[i] < groups);
        if (of[i] != KIRI_NONE) {
            SpanAt(spans, strideBytes, of[i])->count += 1;
        }
    }
    KIRI_TIMES(g, groups) {
        kiriSpan* span = SpanAt(spans, strideBytes, g);
        span->first = all;
        all += span->count;
        span->count = 0;
    }
    KIRI_TIMES(i, count) {
        if (of[i] != KIRI_NONE) {
            kiriSpan* span = SpanAt(spans, strideBytes, of[i]);
            items[span->first + span->count++] = i;
        }
    }
    return all;
}

/* ---- Index maps ---- */

bool kiriKeep_Init(kiriKeep* keep, kiriMemory* memory, int32_t items)
{
    KIRI_CLEAR(keep);
    return kiriArray_Reserve(memory, &keep->to, items);
}

void kiriKeep_Fill(kiriKeep* keep, const int32_t* parts, int32_t items)
{
    KIRI_ASSERT(items >= 0 && items <= keep->to.capacity);
    int32_t *to = keep->to.data, kept = 0;
    for (keep->first = 0; keep->first < items && parts[keep->first] == KIRI_NONE;) {
        ++keep->first;
    }
    KIRI_TIMES(i, items) {
        to[i] = parts[i] == KIRI_NONE ? kept : KIRI_NONE;
        kept += parts[i] == KIRI_NONE;
    }
    keep->to.count = items;
    keep->count = kept;
}

void kiriKeep_Clear(kiriKeep* keep, int32_t items)
{
    KIRI_ASSERT(items >= 0 && items <= keep->to.capacity);
    keep->to.count = items;
    kiriArray_Set(&keep->to, KIRI_NONE);
    keep->count = keep->first = 0;
}

void kiriKeep_Take(kiriKeep* keep, const int32_t* items, int32_t count)
{
    KIRI_ASSERT(keep->count == 0 && keep->first == 0);
    KIRI_TIMES(k, count) {
        KIRI_ASSERT(items[k] < keep->to.count && (k == 0 || items[k] > items[k - 1]));
        keep->to.data[items[k]] = k;
    }
    keep->count = count;
}

void kiriKeep_Drop(kiriKeep* keep, const int32_t* items, int32_t count)
{
    KIRI_ASSERT(keep->count == count);
    KIRI_TIMES(k, count) {
        keep->to.data[items[k]] = KIRI_NONE;
    }
    keep->count = 0;
}

/* Moves items from `first` on, run by run of items that are all kept or all removed. `to` may be `from`: no item moves
   up. */
static void MoveRuns(const kiriKeep* keep, unsigned char* to, const unsigned char* from, int32_t first,
                     size_t itemBytes)
{
    enum { AHEAD = 8 };
    const int32_t* map = keep->to.data;
    for (int32_t i = first, end; i < keep->to.count; i = end) {
        end = i + 1;
        while (map[i] != KIRI_NONE && end + AHEAD < keep->to.count && map[end + AHEAD] == map[i] + end + AHEAD - i) {
            end += AHEAD; /* kept items have consecutive indices: so all up to there are kept */
        }
        while (end < keep->to.count && (map[end] == KIRI_NONE) == (map[i] == KIRI_NONE)) {
            ++end;
        }
        if (map[i] != KIRI_NONE) {
            KIRI_ASSERT(map[i] <= i && map[end - 1] == map[i] + end - 1 - i);
            memmove(to + map[i] * itemBytes, from + i * itemBytes, (end - i) * itemBytes);
        }
    }
}

void kiriKeep_Compact(const kiriKeep* keep, void* array, int32_t each, size_t entryBytes)
{
    kiriArrayHeader header = kiriArray_GetHeader(array);
    if (header.count > 0) {
        KIRI_ASSERT(header.count == each * keep->to.count);
        MoveRuns(keep, header.data, header.data, keep->first, each * entryBytes);
        header.count = each * keep->count;
        kiriArray_SetHeader(array, header);
    }
}

void kiriKeep_Copy(const kiriKeep* keep, void* to, const void* from, size_t itemBytes)
{
    if (keep->first > 0) {
        memcpy(to, from, keep->first * itemBytes);
    }
    MoveRuns(keep, to, from, keep->first, itemBytes);
}

static int32_t* LinkOf(int32_t* next, size_t strideBytes, int32_t item)
{
    return (int32_t*)((char*)next + item * strideBytes);
}

/* Returns the new link for a link to `item`. Older items have their new links already, so the link of a removed item
   leads to the next kept one. */
static int32_t NewLink(const kiriKeep* keep, int32_t* next, size_t strideBytes, int32_t item)
{
    bool isRemoved = item != KIRI_NONE && !kiriKeep_Has(keep, item);
    return isRemoved ? *LinkOf(next, strideBytes, item) : kiriKeep_To(keep, item);
}

void kiriKeep_Relink(const kiriKeep* keep, int32_t* heads, int32_t headCount, int32_t* next, size_t strideBytes)
{
    KIRI_FROM_TO(i, keep->first, keep->to.count) {
        int32_t* link = LinkOf(next, strideBytes, i);
        KIRI_ASSERT(*link < i);
        *link = NewLink(keep, next, strideBytes, *link);
    }
    KIRI_TIMES(k, headCount) {
        heads[k] = NewLink(keep, next, strideBytes, heads[k]);
    }
}

/* ---- Ids ---- */

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

uint32_t kiriPool_Add(kiriPool* pool, void* owner, int32_t index)
{
    KIRI_ASSERT(owner != NULL);
    int32_t slot = pool->freeSlot;
    if (slot != KIRI_NONE) {
        pool->freeSlot = pool->slots.data[slot].index;
        pool->freeCount -= 1;
    } else {
        slot = pool->slots.count;
        KIRI_NEXT(pool->slots) = (kiriSlot){ NULL, 0, 1u };
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

bool kiriPool_IsSound(const kiriPool* pool, uint32_t kind)
{
    bool isFine = pool->kind == kind && pool->freeCount >= 0;
    int32_t slot = pool->freeSlot;
    KIRI_TIMES_WHILE(isFine, k, pool->freeCount) {
        isFine = slot >= 0 && slot < pool->slots.count && pool->slots.data[slot].owner == NULL;
        slot = isFine ? pool->slots.data[slot].index : slot;
    }
    return isFine && slot == KIRI_NONE;
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
