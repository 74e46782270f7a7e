#include "kiri_check.h"

#include <string.h>

const kiriMust kiriMustBeReal[1] = { { KIRI_RULE_REALS, KIRI_OF_NOTHING, 0, 8, 0, 0, 0, NULL, 0 } };
const kiriMust kiriMustBeFloat[1] = { { KIRI_RULE_FLOATS, KIRI_OF_NOTHING, 0, 4, 0, 0, 0, NULL, 0 } };

/* ---- Numbers ----------------------------------------------------------------------------------------------------- */

static bool AreBetween(const void* numbers, int32_t bytes, int32_t low, int32_t high)
{
    const int32_t* number = numbers;
    int32_t areOut = 0;
    for (int32_t k = 0; k < bytes / 4; ++k) {
        areOut |= (number[k] < low) | (number[k] > high);
    }
    return areOut == 0;
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

/* ---- Rules ------------------------------------------------------------------------------------------------------- */

static int64_t CountOf(const kiriCheck* check, const kiriMust* must)
{
    return must->of == KIRI_OF_NOTHING ? 0 : check->count[must->of];
}

/* Items that are one number have nothing between them: all are looked at as one row. */
static bool IsRow(const kiriMust* must, int64_t items)
{
    return must->ruleCount == 1 && must->rules->rules == NULL && must->rules->offset == 0 &&
           must->rules->size == must->size && must->rules->kind <= KIRI_RULE_COUNTS && items * must->size <= INT32_MAX;
}

static int32_t HighOf(const kiriCheck* check, const kiriMust* must)
{
    int64_t high = must->high + CountOf(check, must);
    return (int32_t)(high < INT32_MAX ? high : INT32_MAX);
}

static bool AreNumbers(const kiriMust* must, const void* at, int32_t low, int32_t high)
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

/* ---- Items of whole numbers ---- */

enum { ITEMS_AT_ONCE = 4, MOST_NUMBERS = 16 };

/* What each number of so many items may be; all that no rule is about. */
typedef struct Pattern {
    int32_t low[ITEMS_AT_ONCE * MOST_NUMBERS], high[ITEMS_AT_ONCE * MOST_NUMBERS];
} Pattern;

static bool HasPattern(const kiriMust* must)
{
    bool has = must->size % 4 == 0 && must->size <= 4 * MOST_NUMBERS;
    for (int32_t k = 0; k < must->ruleCount; ++k) {
        has &= must->rules[k].kind == KIRI_RULE_BETWEEN;
    }
    return has;
}

static void Pattern_Make(Pattern* pattern, const kiriCheck* check, const kiriMust* must)
{
    int32_t width = must->size / 4;
    for (int32_t k = 0; k < width; ++k) {
        pattern->low[k] = INT32_MIN;
        pattern->high[k] = INT32_MAX;
    }
    for (int32_t r = 0; r < must->ruleCount; ++r) {
        const kiriMust* rule = &must->rules[r];
        int32_t high = HighOf(check, rule);
        for (int32_t k = rule->offset / 4; k < (rule->offset + rule->size) / 4; ++k) {
            pattern->low[k] = rule->low > pattern->low[k] ? rule->low : pattern->low[k];
            pattern->high[k] = high < pattern->high[k] ? high : pattern->high[k];
        }
    }
    for (int32_t k = width; k < ITEMS_AT_ONCE * width; ++k) {
        pattern->low[k] = pattern->low[k - width];
        pattern->high[k] = pattern->high[k - width];
    }
}

/* Compilers make this several numbers at a time. */
static bool IsOfPattern(const Pattern* pattern, const char* at, int32_t count)
{
    int32_t areOut = 0;
    for (int32_t k = 0; k < count; ++k) {
        int32_t number;
        memcpy(&number, at + 4 * k, sizeof(number));
        areOut |= (number < pattern->low[k]) | (number > pattern->high[k]);
    }
    return areOut == 0;
}

/* Most of what is read are items of a few numbers. */
static bool AreItems(const kiriCheck* check, const kiriMust* must, const char* data, int64_t items)
{
    Pattern pattern;
    bool areFine = true;
    Pattern_Make(&pattern, check, must);
    for (int64_t n = 0; areFine && n < items; n += ITEMS_AT_ONCE) {
        int32_t some = (int32_t)(items - n < ITEMS_AT_ONCE ? items - n : ITEMS_AT_ONCE);
        areFine = IsOfPattern(&pattern, data + n * must->size, some * (must->size / 4));
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
    if (HasPattern(must)) {
        return AreItems(check, must, data, items);
    }
    bool areFine = true;
    for (int64_t n = 0; areFine && n < items; ++n) {
        areFine = kiriCheck_Rules(check, must->rules, must->ruleCount, (const char*)data + n * must->size);
    }
    return areFine;
}

static bool MustHold(kiriCheck* check, const kiriMust* must, const void* at)
{
    if (must->kind <= KIRI_RULE_COUNTS) {
        return AreNumbers(must, at, must->low, HighOf(check, must));
    }
    switch (must->kind) {
    case KIRI_RULE_EACH: {
        kiriArrayHeader array = kiriArray_GetHeader(at);
        return HoldsForEach(check, must, array.data, array.count);
    }
    case KIRI_RULE_PART:
        return HoldsForEach(check, must, at, must->bytes / must->size);
    default:
        return kiriArray_GetHeader(at).count == CountOf(check, must);
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

/* ---- Lists ------------------------------------------------------------------------------------------------------- */

uint8_t* kiriCheck_Bytes(kiriCheck* check, int64_t count)
{
    uint8_t* bytes = check->isShort ? NULL : kiriMemory_AllocZeroed(&check->memory, count > 0 ? count : 1);
    check->isShort |= bytes == NULL;
    return bytes;
}

static bool AreIndices(kiriCheck* check, const kiriIndices* indices, int64_t end)
{
    bool areFine = true;
    for (int32_t k = 0; k < indices->count; ++k) {
        areFine &= indices->data[k] >= 0 && indices->data[k] < end;
    }
    return kiriCheck_That(check, areFine);
}

bool kiriCheck_Distinct(kiriCheck* check, const kiriIndices* indices, int64_t end)
{
    if (indices->count == 0 || !AreIndices(check, indices, end)) {
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
