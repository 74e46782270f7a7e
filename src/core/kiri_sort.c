#include "kiri_sort.h"

#include <string.h>

static bool IsLess(const void* context, int32_t a, int32_t b)
{
    (void)context;
    return a < b;
}

/* Shell 1959, with Knuth's gaps: little code, and what is nearly in order costs next to nothing. */
void kiriSort(int32_t* items, int32_t count, kiriBeforeFn* before, const void* context)
{
    KIRI_ASSERT(count >= 0);
    int32_t gap = 1;
    before = before != NULL ? before : IsLess;
    while (gap < count / 3) {
        gap = 3 * gap + 1;
    }
    for (; gap > 0; gap /= 3) {
        for (int32_t i = gap; i < count; ++i) {
            int32_t moving = items[i], j = i;
            for (; j >= gap && before(context, moving, items[j - gap]); j -= gap) {
                items[j] = items[j - gap];
            }
            items[j] = moving;
        }
    }
}

enum { DIGIT_BITS = 11, DIGITS = 1 << DIGIT_BITS };

/* In the order of one digit, and of those below it as they were. */
static void SortByDigit(const int32_t* items, int32_t* to, int32_t count, int shift)
{
    int32_t first[DIGITS + 1] = { 0 };
    for (int32_t i = 0; i < count; ++i) {
        first[((items[i] >> shift) & (DIGITS - 1)) + 1] += 1;
    }
    for (int32_t d = 0; d < DIGITS; ++d) {
        first[d + 1] += first[d];
    }
    for (int32_t i = 0; i < count; ++i) {
        to[first[(items[i] >> shift) & (DIGITS - 1)]++] = items[i];
    }
}

void kiriSort_Numbers(int32_t* items, int32_t* room, int32_t count)
{
    int32_t all = 0, *from = items, *to = room;
    for (int32_t i = 0; i < count; ++i) {
        KIRI_ASSERT(items[i] >= 0);
        all |= items[i];
    }
    for (int shift = 0; shift < 31 && all >> shift > 0; shift += DIGIT_BITS) {
        SortByDigit(from, to, count, shift);
        from = to;
        to = from == items ? room : items;
    }
    if (from != items) {
        memcpy(items, from, sizeof(*items) * (size_t)count);
    }
}

/* Merges the two runs at hand, the left one from `room`; false where it did not come to the end of `most` moves. */
static bool MergeRuns(kiriSorting* s, int32_t* items, int32_t* room, int32_t count, kiriBeforeFn* before,
                      const void* context, int32_t* most)
{
    int32_t middle = s->block + s->width, end = count - middle > s->width ? middle + s->width : count;
    if (s->to < s->block) {
        if (before(context, items[middle - 1], items[middle])) {
            return true;
        }
        memcpy(room, items + s->block, sizeof(*items) * (size_t)s->width);
        s->to = s->block;
        s->left = 0;
        s->right = middle;
    }
    for (; s->left < s->width; --*most) {
        if (*most <= 0) {
            return false;
        }
        bool takesRight = s->right < end && before(context, items[s->right], room[s->left]);
        items[s->to++] = takesRight ? items[s->right++] : room[s->left++];
    }
    return true;
}

bool kiriSorting_GoOn(kiriSorting* s, int32_t* items, int32_t* room, int32_t count, kiriBeforeFn* before,
                      const void* context, int32_t most)
{
    before = before != NULL ? before : IsLess;
    s->to = s->width > 0 ? s->to : KIRI_NONE;
    for (s->width = s->width > 0 ? s->width : 1; s->width < count; s->width *= 2, s->block = 0) {
        for (; s->block < count - s->width; s->block += 2 * s->width, s->to = KIRI_NONE, --most) {
            if (most <= 0 || !MergeRuns(s, items, room, count, before, context, &most)) {
                return false;
            }
        }
    }
    return true;
}
