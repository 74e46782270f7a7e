#include "kiri_check.h"

#include <string.h>

const kiriMust kiriMustBeReal[1] = { { KIRI_RULE_REALS, KIRI_OF_NOTHING, 0, 8, 0, 0, 0, NULL, 0 } };
const kiriMust kiriMustBeVector[1] = { { KIRI_RULE_REALS, KIRI_OF_NOTHING, 0, 16, 0, 0, 0, NULL, 0 } };
const kiriMust kiriMustBeFloat[1] = { { KIRI_RULE_FLOATS, KIRI_OF_NOTHING, 0, 4, 0, 0, 0, NULL, 0 } };

/* ---- Numbers ------------------------------------------------------------------------------------------------------ */

/* What numbers may be: as unsigned ones at most `most` above `low`. There may be none, as of indices of nothing. */
typedef struct Limits {
    uint32_t low, most;
    bool isSome;
} Limits;

static Limits LimitsOf(int64_t low, int64_t high)
{
    int64_t most = (high < INT32_MAX ? high : INT32_MAX) - low;
    return (Limits){ (uint32_t)low, (uint32_t)most, most >= 0 };
}

static bool AreBetween(const void* numbers, int32_t bytes, int64_t low, int64_t high)
{
    const uint32_t* number = numbers;
    Limits limits = LimitsOf(low, high);
    bool areFine = limits.isSome || bytes == 0;
    for (int32_t k = 0; k < bytes / 4; ++k) {
        areFine &= number[k] - limits.low <= limits.most;
    }
    return areFine;
}

/* What is due to a budget, say: sums of a few of them hold. */
static bool AreCounts(const void* numbers, int32_t bytes)
{
    const int64_t* number = numbers;
    bool areFine = true;
    for (int32_t k = 0; k < bytes / 8; ++k) {
        areFine &= number[k] >= 0 && number[k] < INT64_C(1) << 56;
    }
    return areFine;
}

/* Not all bits of the exponent. */
static bool AreReals(const void* numbers, int32_t bytes)
{
    const uint64_t exponent = UINT64_C(0x7ff0000000000000);
    bool areFine = true;
    for (int32_t k = 0; k < bytes; k += 8) {
        uint64_t bits;
        memcpy(&bits, (const char*)numbers + k, 8);
        areFine &= (bits & exponent) != exponent;
    }
    return areFine;
}

static bool AreFloats(const void* numbers, int32_t bytes)
{
    const uint32_t exponent = 0x7f800000u;
    bool areFine = true;
    for (int32_t k = 0; k < bytes; k += 4) {
        uint32_t bits;
        memcpy(&bits, (const char*)numbers + k, 4);
        areFine &= (bits & exponent) != exponent;
    }
    return areFine;
}

/* ---- Rules -------------------------------------------------------------------------------------------------------- */

static int64_t CountOf(const kiriCheck* check, const kiriMust* must)
{
    return must->of == KIRI_OF_NOTHING ? 0 : check->count[must->of];
}

/* Items that are one number have nothing between them: all are looked at as one row. */
static bool IsRow(const kiriMust* must, int64_t items)
{
    return must->ruleCount == 1 && must->rules->rules == NULL && must->rules->offset == 0 &&
           must->rules->size == must->size && must->rules->kind <= KIRI_RULE_FLOATS && items * must->size <= INT32_MAX;
}

static bool AreNumbers(const kiriMust* must, const void* at, int64_t low, int64_t high)
{
    switch (must->kind) {
    case KIRI_RULE_BETWEEN:
        return AreBetween(at, must->size, low, high);
    case KIRI_RULE_COUNTS:
        return AreCounts(at, must->size);
    case KIRI_RULE_REALS:
        return AreReals(at, must->size);
    default:
        return AreFloats(at, must->size);
    }
}

static bool AreAllNumbers(const kiriMust* rules, int32_t count)
{
    bool are = true;
    for (int32_t k = 0; k < count; ++k) {
        are &= rules[k].kind <= KIRI_RULE_FLOATS;
    }
    return are;
}

/* A number of each item; these are `apart` bytes from each other. */
static bool IsEachBetween(const char* at, int64_t items, int32_t apart, Limits limits)
{
    bool areFine = limits.isSome;
    for (int64_t n = 0; n < items; ++n, at += apart) {
        areFine &= *(const uint32_t*)(const void*)at - limits.low <= limits.most;
    }
    return areFine;
}

static bool IsEachReal(const char* at, int64_t items, int32_t apart)
{
    bool areFine = true;
    for (int64_t n = 0; n < items; ++n, at += apart) {
        areFine &= AreReals(at, 8);
    }
    return areFine;
}

static bool IsEachFloat(const char* at, int64_t items, int32_t apart)
{
    bool areFine = true;
    for (int64_t n = 0; n < items; ++n, at += apart) {
        areFine &= AreFloats(at, 4);
    }
    return areFine;
}

/* One rule, which may be about several numbers of an item. */
static bool IsEachFine(const kiriMust* rule, const char* at, int64_t items, int32_t apart, int64_t high)
{
    bool areFine = true;
    Limits limits = LimitsOf(rule->low, high);
    if (rule->kind == KIRI_RULE_COUNTS) {
        for (int64_t n = 0; n < items; ++n) {
            areFine &= AreCounts(at + n * apart, rule->size);
        }
        return areFine;
    }
    int32_t width = rule->kind == KIRI_RULE_REALS ? 8 : 4;
    for (int32_t k = 0; areFine && k < rule->size; k += width) {
        areFine = rule->kind == KIRI_RULE_BETWEEN ? IsEachBetween(at + k, items, apart, limits)
                  : rule->kind == KIRI_RULE_REALS ? IsEachReal(at + k, items, apart)
                                                  : IsEachFloat(at + k, items, apart);
    }
    return areFine;
}

enum { ITEMS_AT_ONCE = 128 };

/* Most of what is read are items of a few numbers: one rule after the other, for so many items that they stay near. */
static bool AreItems(const kiriCheck* check, const kiriMust* must, const char* data, int64_t items)
{
    bool areFine = true;
    for (int64_t first = 0; areFine && first < items; first += ITEMS_AT_ONCE) {
        int64_t some = items - first < ITEMS_AT_ONCE ? items - first : ITEMS_AT_ONCE;
        const char* at = data + first * must->size;
        for (int32_t k = 0; areFine && k < must->ruleCount; ++k) {
            const kiriMust* rule = &must->rules[k];
            areFine = IsEachFine(rule, at + rule->offset, some, must->size, rule->high + CountOf(check, rule));
        }
    }
    return areFine;
}

static bool HoldsForEach(kiriCheck* check, const kiriMust* must, const void* data, int64_t items)
{
    if (IsRow(must, items)) {
        kiriMust row = *must->rules;
        row.size = (int32_t)(items * must->size);
        return kiriCheck_Rules(check, &row, 1, data);
    }
    if (AreAllNumbers(must->rules, must->ruleCount)) {
        return AreItems(check, must, data, items);
    }
    bool areFine = true;
    for (int64_t n = 0; areFine && n < items; ++n) {
        areFine = kiriCheck_Rules(check, must->rules, must->ruleCount, (const char*)data + n * must->size);
    }
    return areFine;
}

static bool HoldsForOwned(kiriCheck* check, const kiriMust* must, const void* at)
{
    const void* object;
    memcpy(&object, at, sizeof(object));
    return object == NULL || kiriCheck_Rules(check, must->rules, must->ruleCount, object);
}

static bool MustHold(kiriCheck* check, const kiriMust* must, const void* at)
{
    if (must->kind <= KIRI_RULE_FLOATS) {
        return AreNumbers(must, at, must->low, must->high + CountOf(check, must));
    }
    switch (must->kind) {
    case KIRI_RULE_EACH: {
        kiriArrayHeader array = kiriArray_GetHeader(at);
        return HoldsForEach(check, must, array.data, array.count);
    }
    case KIRI_RULE_PART:
        return HoldsForEach(check, must, at, must->bytes / must->size);
    case KIRI_RULE_OWNED:
        return HoldsForOwned(check, must, at);
    case KIRI_RULE_LENGTH:
        return kiriArray_GetHeader(at).count == CountOf(check, must);
    default:
        return kiriArray_GetHeader(at).capacity >= CountOf(check, must);
    }
}

bool kiriCheck_Rules(kiriCheck* check, const kiriMust* rules, int32_t count, const void* object)
{
    bool areFine = kiriCheck_IsFine(check);
    for (int32_t k = 0; areFine && k < count; ++k) {
        areFine = MustHold(check, &rules[k], (const char*)object + rules[k].offset);
    }
    return kiriCheck_That(check, areFine);
}

/* ---- Lists -------------------------------------------------------------------------------------------------------- */

uint8_t* kiriCheck_Bytes(kiriCheck* check, int64_t count)
{
    uint8_t* bytes = check->isShort ? NULL : kiriMemory_AllocZeroed(&check->memory, count > 0 ? count : 1);
    check->isShort |= bytes == NULL;
    return bytes;
}

bool kiriCheck_Indices(kiriCheck* check, const kiriIndices* indices, int64_t end)
{
    bool areFine = true;
    for (int32_t k = 0; k < indices->count; ++k) {
        areFine &= indices->data[k] >= 0 && indices->data[k] < end;
    }
    return kiriCheck_That(check, areFine);
}

bool kiriCheck_Distinct(kiriCheck* check, const kiriIndices* indices, int64_t end)
{
    if (indices->count == 0 || !kiriCheck_Indices(check, indices, end)) {
        return kiriCheck_IsFine(check);
    }
    uint8_t* seen = kiriCheck_Bytes(check, end);
    bool areFine = seen != NULL;
    for (int32_t k = 0; areFine && k < indices->count; ++k) {
        areFine = !seen[indices->data[k]];
        seen[indices->data[k]] = 1;
    }
    kiriMemory_Free(&check->memory, seen);
    return kiriCheck_That(check, areFine);
}

bool kiriCheck_Marked(kiriCheck* check, const kiriIndices* list, int64_t end, const uint8_t* marks, uint8_t mark)
{
    bool areFine = kiriCheck_Distinct(check, list, end);
    for (int32_t k = 0; areFine && k < list->count; ++k) {
        areFine = (marks[list->data[k]] & mark) != 0;
    }
    return kiriCheck_That(check, areFine);
}

bool kiriCheck_StartChains(kiriCheck* check, kiriChains* chains, const void* next, size_t stride, int32_t items)
{
    *chains = (kiriChains){ kiriCheck_Bytes(check, items), next, (int64_t)stride, items, 0 };
    return chains->seen != NULL;
}

bool kiriCheck_Chain(kiriCheck* check, kiriChains* chains, int32_t head)
{
    while (head != KIRI_NONE) {
        if (!kiriCheck_That(check, kiriChains_Take(chains, head))) {
            return false;
        }
        head = kiriChains_After(chains, head);
    }
    return true;
}

/* ---- Spans -------------------------------------------------------------------------------------------------------- */

static bool TakeRoomOf(kiriCheck* check, kiriRooms* rooms, int64_t first, int64_t room)
{
    bool isFine = first >= 0 && first + room <= rooms->items.count;
    for (int64_t k = first; isFine && k < first + room; ++k) {
        isFine = !rooms->taken[k];
        rooms->taken[k] = 1;
    }
    return kiriCheck_That(check, isFine);
}

bool kiriCheck_Span(kiriCheck* check, kiriRooms* rooms, kiriSpan span)
{
    int64_t room = 1;
    while (room < span.count) {
        room *= 2;
    }
    return kiriCheck_That(check, span.count >= 0) && (span.count == 0 || TakeRoomOf(check, rooms, span.first, room));
}

/* The list of free room of a size runs through its items. */
static bool TakeFreeRooms(kiriCheck* check, kiriRooms* rooms, int32_t head, int64_t room)
{
    bool isFine = true;
    for (int32_t first = head; isFine && first != 0;) {
        isFine = TakeRoomOf(check, rooms, (int64_t)first - 1, room);
        if (isFine) {
            memcpy(&first, (const char*)rooms->items.data + (size_t)(first - 1) * rooms->itemBytes, sizeof(first));
        }
    }
    return isFine;
}

bool kiriCheck_StartRooms(kiriCheck* check, kiriRooms* rooms, const void* array, size_t itemBytes,
                          const kiriSpans* spans)
{
    kiriArrayHeader items = kiriArray_GetHeader(array);
    *rooms = (kiriRooms){ kiriCheck_Bytes(check, items.count), items, itemBytes };
    bool isFine = rooms->taken != NULL;
    for (int size = 0; isFine && size < KIRI_SPAN_SIZES; ++size) {
        isFine = TakeFreeRooms(check, rooms, spans->freeHead[size], (int64_t)1 << size);
    }
    return isFine;
}
