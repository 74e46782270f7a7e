#include "kiri_sort.h"

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
