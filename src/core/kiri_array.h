/* Growable arrays, and ids. KIRI_ARRAY(T) declares an array; a zeroed array is empty. Growing keeps the items, or fails
   and changes nothing. */
#ifndef KIRI_ARRAY_H
#define KIRI_ARRAY_H

#include "kiri_base.h"

KIRI_C_BEGIN

#define KIRI_ARRAY(T)                                                                                                  \
    struct {                                                                                                           \
        T* data;                                                                                                       \
        int32_t count;                                                                                                 \
        int32_t capacity;                                                                                              \
    }

/* Common layout of every KIRI_ARRAY. Functions for any of them copy it out and back with memcpy, because the type of
   `data` differs. */
typedef struct kiriArrayHeader {
    void* data;
    int32_t count;
    int32_t capacity;
} kiriArrayHeader;

kiriArrayHeader kiriArray_GetHeader(const void* array);
void kiriArray_SetHeader(void* array, kiriArrayHeader header);
void kiriArray_Swap(void* a, void* b);

typedef KIRI_ARRAY(int32_t) kiriIndices;
typedef KIRI_ARRAY(uint8_t) kiriFlags;
typedef KIRI_ARRAY(double) kiriReals;
typedef KIRI_ARRAY(float) kiriFloats;

/* Loops over the items of an array; `item` points to each. KIRI_EACH_OF is for an array of pointers, and
   KIRI_EACH_LISTED for a list of indices: `item` is each of them. The array may lose items meanwhile, but not grow. It
   must exist even where the condition is false. KIRI_EACH_INDEX is for what needs the index; _BACK goes from the last
   item to the first, which may be removed. */
#define KIRI_EACH(Type, item, array) KIRI_EACH_WHILE(true, Type, item, array)
#define KIRI_EACH_WHILE(condition, Type, item, array)                                                                  \
    for (Type* item = (array).data; (condition) && item < (array).data + (array).count; ++item)
#define KIRI_EACH_OF(Type, item, array) KIRI_EACH_OF_WHILE(true, Type, item, array)
#define KIRI_EACH_OF_WHILE(condition, Type, item, array)                                                               \
    for (Type** item##At = (array).data, *item;                                                                        \
         (condition) && item##At < (array).data + (array).count && (item = *item##At, true); ++item##At)
#define KIRI_EACH_LISTED(item, list) KIRI_EACH_LISTED_WHILE(true, item, list)
#define KIRI_EACH_LISTED_WHILE(condition, item, list)                                                                  \
    for (int32_t item##At = 0, item;                                                                                   \
         (condition) && item##At < (list).count && (item = (list).data[item##At], true); ++item##At)
#define KIRI_EACH_INDEX(i, array) KIRI_TIMES(i, (array).count)
#define KIRI_EACH_INDEX_WHILE(condition, i, array) KIRI_TIMES_WHILE(condition, i, (array).count)
#define KIRI_EACH_INDEX_BACK(i, array) for (int32_t i = (array).count - 1; i >= 0; --i)

#define KIRI_ASSERT_HAS(array, index) KIRI_ASSERT((index) >= 0 && (index) < (array).count)

/* Removes the items for which a condition of `item`, a pointer to each, is false. The others keep their order. */
#define KIRI_KEEP_IF(Type, item, array, condition)                                                                     \
    do {                                                                                                               \
        int32_t itemsKept = 0;                                                                                         \
        KIRI_EACH(Type, item, array) {                                                                                 \
            if (condition) {                                                                                           \
                (array).data[itemsKept++] = *item;                                                                     \
            }                                                                                                          \
        }                                                                                                              \
        (array).count = itemsKept;                                                                                     \
    } while (0)

/* Set all items, or new ones up to `size`, for which there is room, to bytes: 0, or -1 for KIRI_NONE. */
#define kiriArray_Set(array, byte) kiriArray_SetFrom((array), 0, (byte), sizeof(*(array)->data))
#define kiriArray_Extend(array, size, byte) kiriArray_ExtendTo((array), (size), (byte), sizeof(*(array)->data))
void kiriArray_SetFrom(void* array, int32_t from, int byte, size_t itemBytes);
void kiriArray_ExtendTo(void* array, int32_t size, int byte, size_t itemBytes);

/* Appends an item, for which there is room: to be assigned. */
#define KIRI_NEXT(array) (*(KIRI_ASSERT((array).count < (array).capacity), (array).data + (array).count++))

/* Makes room for `need` items in all. `array` points to a KIRI_ARRAY whose items have itemBytes. */
bool kiriArray_Grow(kiriMemory* memory, void* array, int64_t need, size_t itemBytes);

/* Grows to exactly `need` items: for arrays that are built once, or as long as another. */
bool kiriArray_GrowTo(kiriMemory* memory, void* array, int64_t need, size_t itemBytes);

/* Reduces the capacity to 9/8 of the count. Keeps the capacity on out of memory. */
void kiriArray_Shorten(kiriMemory* memory, void* array, size_t itemBytes);

/* Moves the items to a new block. The old one gets the owner `retired`. Fails on out of memory, and changes nothing. */
bool kiriArray_Renew(kiriMemory* memory, void* array, size_t itemBytes, kiriMemory* retired);

/* Frees the items and leaves the array empty. */
void kiriArray_Release(kiriMemory* memory, void* array);

#define kiriArray_Reserve(memory, array, need)                                                                         \
    ((int64_t)(need) <= (array)->capacity || kiriArray_Grow((memory), (array), (need), sizeof(*(array)->data)))

/* Makes room for `more` items behind those that there are. */
#define kiriArray_ReserveMore(memory, array, more) kiriArray_Reserve(memory, array, (int64_t)(array)->count + (more))

#define kiriArray_ReserveJust(memory, array, need)                                                                     \
    ((int64_t)(need) <= (array)->capacity || kiriArray_GrowTo((memory), (array), (need), sizeof(*(array)->data)))

/* Reserves and sets the count; new items are not initialised. */
#define kiriArray_Resize(memory, array, size)                                                                          \
    (kiriArray_Reserve(memory, array, size) ? ((array)->count = (int32_t)(size), true) : false)

/* Reserves exactly `size` items and sets the count. */
#define kiriArray_ResizeJust(memory, array, size)                                                                      \
    (kiriArray_ReserveJust(memory, array, size) ? ((array)->count = (int32_t)(size), true) : false)

#define kiriArray_Push(memory, array, item)                                                                            \
    (kiriArray_ReserveMore(memory, array, 1) ? ((array)->data[(array)->count++] = (item), true) : false)

/* Applies a macro to up to eight arguments. KIRI_ONCE_MORE is for the preprocessor of MSVC, which passes __VA_ARGS__ on
   as one argument. */
#define KIRI_ONCE_MORE(x) x
#define KIRI_EACH_1(M, a) M(a)
#define KIRI_EACH_2(M, a, ...) M(a), KIRI_ONCE_MORE(KIRI_EACH_1(M, __VA_ARGS__))
#define KIRI_EACH_3(M, a, ...) M(a), KIRI_ONCE_MORE(KIRI_EACH_2(M, __VA_ARGS__))
#define KIRI_EACH_4(M, a, ...) M(a), KIRI_ONCE_MORE(KIRI_EACH_3(M, __VA_ARGS__))
#define KIRI_EACH_5(M, a, ...) M(a), KIRI_ONCE_MORE(KIRI_EACH_4(M, __VA_ARGS__))
#define KIRI_EACH_6(M, a, ...) M(a), KIRI_ONCE_MORE(KIRI_EACH_5(M, __VA_ARGS__))
#define KIRI_EACH_7(M, a, ...) M(a), KIRI_ONCE_MORE(KIRI_EACH_6(M, __VA_ARGS__))
#define KIRI_EACH_8(M, a, ...) M(a), KIRI_ONCE_MORE(KIRI_EACH_7(M, __VA_ARGS__))
#define KIRI_EACH_PICK(a, b, c, d, e, f, g, h, Each, ...) Each
#define KIRI_EACH_FIELD(M, ...)                                                                                        \
    KIRI_ONCE_MORE(KIRI_EACH_PICK(__VA_ARGS__, KIRI_EACH_8, KIRI_EACH_7, KIRI_EACH_6, KIRI_EACH_5, KIRI_EACH_4,        \
                                  KIRI_EACH_3, KIRI_EACH_2, KIRI_EACH_1, )(M, __VA_ARGS__))

/* Reserve, or resize, up to eight arrays for the same count: kiriArrays_Reserve(memory, need, &a, &b). If one fails,
   Resize sets no count. */
#define kiriArrays_Reserve(memory, need, ...) kiriArrays_Grow((memory), (need), KIRI_ARRAYS_OF(__VA_ARGS__))
#define kiriArrays_Resize(memory, size, ...) kiriArrays_SetCount((memory), (size), KIRI_ARRAYS_OF(__VA_ARGS__))
#define KIRI_ARRAYS_OF(...) ((const kiriAnyArray[]){ KIRI_EACH_FIELD(KIRI_ANY_ARRAY, __VA_ARGS__), { NULL, 0 } })
#define KIRI_ANY_ARRAY(array) { (array), sizeof(*(array)->data) }

typedef struct kiriAnyArray {
    void* array; /* null: the end of a list */
    size_t itemBytes;
} kiriAnyArray;

bool kiriArrays_Grow(kiriMemory* memory, int64_t need, const kiriAnyArray* arrays);
bool kiriArrays_SetCount(kiriMemory* memory, int64_t size, const kiriAnyArray* arrays);

/* Sorting of indices. */

/* Returns true if item a comes before item b. A strict total order: the result does not depend on the input order. */
typedef bool kiriBeforeFn(const void* context, int32_t a, int32_t b);

/* Sorts in place, without memory. `before` null: by the items themselves. */
void kiriSort(int32_t* items, int32_t count, kiriBeforeFn* before, const void* context);

/* Fills an array with the indices from 0 to count - 1 and sorts them. */
bool kiriSort_Order(kiriMemory* memory, kiriIndices* order, int32_t count, kiriBeforeFn* before,
                    const void* context);

/* Spans: many small lists in one array, such as the weights of each sample. The capacity of a span is the smallest
   power of two that holds its items; freed room is reused. */

typedef struct kiriSpan {
    int32_t first, count;
} kiriSpan;

enum { KIRI_SPAN_SIZES = 31 };

/* Free room: heads of lists that run through the free items themselves. */
typedef struct kiriSpans {
    int32_t freeHead[KIRI_SPAN_SIZES]; /* plus 1, so that zeroed spans are empty */
} kiriSpans;

/* Sets the count of a span and reserves for it. Keeps the first items; new ones are not initialised. May move the
   items, even when it shrinks. `array` is the KIRI_ARRAY with the items of all spans; itemBytes is at least 4. Changes
   nothing on out of memory: false. Shrinking cannot fail. */
bool kiriSpan_Resize(kiriSpan* span, kiriSpans* spans, kiriMemory* memory, void* array, size_t itemBytes,
                     int32_t count);

/* Sorts the indices of items by group, ascending in each. of[i] is the group of item i, or KIRI_NONE. Writes the span of
   each group, which lie strideBytes apart. `items` has room for all. Returns how many items are in groups. */
int32_t kiriSpans_Group(const int32_t* of, int32_t count, kiriSpan* spans, size_t strideBytes, int32_t groups,
                        int32_t* items);

/* Loops over the indices of a span. */
#define KIRI_EACH_IN(i, span) KIRI_FROM_TO(i, (span).first, (span).first + (span).count)

/* Union-find over indices. The caller owns the array `parent`, with an entry for each item. The root of a set is its
   lowest item, in any order of joins. */

/* Makes each item a separate set. */
static inline void kiriUnion_Init(int32_t* parent, int32_t count)
{
    KIRI_TIMES(i, count) {
        parent[i] = i;
    }
}

/* Returns the root of an item. Halves the path. */
static inline int32_t kiriUnion_Root(int32_t* parent, int32_t i)
{
    KIRI_ASSERT(i >= 0);
    while (parent[i] != i) {
        KIRI_ASSERT(parent[i] >= 0 && parent[i] < i);
        i = parent[i] = parent[parent[i]];
    }
    return i;
}

static inline void kiriUnion_Join(int32_t* parent, int32_t i, int32_t j)
{
    int32_t a = kiriUnion_Root(parent, i), b = kiriUnion_Root(parent, j);
    parent[kiriMax(b, a)] = kiriMin(a, b);
}

/* Index maps: the new index of each item of an array from which items are removed. Orders are kept. */

typedef struct kiriKeep {
    kiriIndices to;         /* per item: new index, or KIRI_NONE */
    int32_t count;          /* count of kept items */
    int32_t first;          /* first removed item, or the count of items: items before it keep their index */
} kiriKeep;

/* Makes an empty map with capacity for `items`. Fails on out of memory. */
bool kiriKeep_Init(kiriKeep* keep, kiriMemory* memory, int32_t items);

/* Take keeps these items, in ascending order, in a map that keeps none; Drop removes them again. O(count). */
void kiriKeep_Take(kiriKeep* keep, const int32_t* items, int32_t count);
void kiriKeep_Drop(kiriKeep* keep, const int32_t* items, int32_t count);

/* Appends an item. Capacity is reserved. */
static inline void kiriKeep_Add(kiriKeep* keep, bool isKept)
{
    keep->first += isKept && keep->first == keep->to.count;
    KIRI_NEXT(keep->to) = isKept ? keep->count++ : KIRI_NONE;
}

/* Makes a map that keeps the items whose part is KIRI_NONE. Capacity is reserved. */
void kiriKeep_Fill(kiriKeep* keep, const int32_t* parts, int32_t items);

/* Makes a map of `items` that keeps none. Capacity is reserved. */
void kiriKeep_Clear(kiriKeep* keep, int32_t items);

/* Returns the new index of an item; KIRI_NONE if it is not kept, and for KIRI_NONE. */
static inline int32_t kiriKeep_To(const kiriKeep* keep, int32_t item)
{
    KIRI_ASSERT(item >= KIRI_NONE && item < keep->to.count);
    if (item < keep->first) {
        return item;
    }
    return keep->to.data[item];
}

static inline bool kiriKeep_Has(const kiriKeep* keep, int32_t item)
{
    return kiriKeep_To(keep, item) != KIRI_NONE;
}

/* Returns true if a kept item gets another index. */
static inline bool kiriKeep_Moves(const kiriKeep* keep)
{
    return keep->count > keep->first;
}

/* Removes items from a KIRI_ARRAY, which has `each` entries of entryBytes an item, or is empty. */
void kiriKeep_Compact(const kiriKeep* keep, void* array, int32_t each, size_t entryBytes);

/* Copies the kept items, of itemBytes each, to another array. */
void kiriKeep_Copy(const kiriKeep* keep, void* to, const void* from, size_t itemBytes);

/* Removes items from linked lists, in which each item links to an older one, and renumbers the links. `next` is the
   link of item 0, with strideBytes from one link to the next. Call it before items are moved. */
void kiriKeep_Relink(const kiriKeep* keep, int32_t* heads, int32_t headCount, int32_t* next, size_t strideBytes);

/* ---- Ids ---- */

/* An id has 3 bits kind, 7 bits generation, 22 bits slot. An id of another kind, or a stale id, finds nothing.
   Generations start at 1, so no id is 0. A slot with all generations used is retired, so no id repeats. */
enum {
    KIRI_KIND_SHEET,
    KIRI_KIND_CUT,
    KIRI_KIND_FRAME,
    KIRI_KIND_PIN,
    KIRI_KIND_OBSTACLE,
    KIRI_KIND_BLADE,
    KIRI_KIND_SEAM
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

/* Makes room for `count` calls of Add. Returns false if fewer ids are left, or on out of memory. */
bool kiriPool_Reserve(kiriPool* pool, kiriMemory* memory, int32_t count);

/* Returns an id, for which there is room. */
uint32_t kiriPool_Add(kiriPool* pool, void* owner, int32_t index);

/* Returns null for a stale or foreign id. */
kiriSlot* kiriPool_Find(const kiriPool* pool, uint32_t id);
void kiriPool_Remove(kiriPool* pool, uint32_t id);

/* Sets the owner of an id in a pool that was loaded without owners. Returns false if the id is not free. */
bool kiriPool_Claim(kiriPool* pool, uint32_t id, void* owner, int32_t index);

/* Returns true if a loaded pool is of this kind, and its free slots are in one list and have no owners. */
bool kiriPool_IsSound(const kiriPool* pool, uint32_t kind);

KIRI_C_END

#endif
