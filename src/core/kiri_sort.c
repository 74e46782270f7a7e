#include "kiri_sort.h"

enum { FEW_ITEMS = 24 };

typedef struct Sorting {
    kiriBeforeFn* before;
    const void* context;
} Sorting;

static bool IsLess(const void* context, int32_t a, int32_t b)
{
    (void)context;
    return a < b;
}

static bool Precedes(const Sorting* sorting, int32_t a, int32_t b)
{
    return sorting->before(sorting->context, a, b);
}

static void SwapItems(int32_t* a, int32_t* b)
{
    int32_t item = *a;
    *a = *b;
    *b = item;
}

static void InsertionSort(const Sorting* sorting, int32_t* items, int32_t count)
{
    for (int32_t i = 1; i < count; ++i) {
        int32_t moving = items[i], j = i;
        for (; j > 0 && Precedes(sorting, moving, items[j - 1]); --j) {
            items[j] = items[j - 1];
        }
        items[j] = moving;
    }
}

/* Lets the item at `root` sink to its level in the heap. */
static void SiftDown(const Sorting* sorting, int32_t* items, int32_t root, int32_t count)
{
    for (int32_t child = 2 * root + 1; child < count; child = 2 * root + 1) {
        child += child + 1 < count && Precedes(sorting, items[child], items[child + 1]) ? 1 : 0;
        if (!Precedes(sorting, items[root], items[child])) {
            return;
        }
        SwapItems(&items[root], &items[child]);
        root = child;
    }
}

static void HeapSort(const Sorting* sorting, int32_t* items, int32_t count)
{
    for (int32_t i = count / 2; i-- > 0;) {
        SiftDown(sorting, items, i, count);
    }
    for (int32_t end = count - 1; end > 0; --end) {
        SwapItems(&items[0], &items[end]);
        SiftDown(sorting, items, 0, end);
    }
}

static int32_t MedianOf(const Sorting* sorting, int32_t a, int32_t b, int32_t c)
{
    if (Precedes(sorting, b, a)) {
        SwapItems(&a, &b);
    }
    return Precedes(sorting, b, c) ? b : Precedes(sorting, a, c) ? c : a;
}

/* No item of the first part comes after one of the second; the first part's length, neither 0 nor all (Hoare 1961). */
static int32_t Partition(const Sorting* sorting, int32_t* items, int32_t count)
{
    int32_t pivot = MedianOf(sorting, items[0], items[count / 2], items[count - 1]), i = 0, j = count - 1;
    for (;; ++i, --j) {
        while (Precedes(sorting, items[i], pivot)) {
            ++i;
        }
        while (Precedes(sorting, pivot, items[j])) {
            --j;
        }
        if (i >= j) {
            return j + 1 < count ? j + 1 : count - 1;
        }
        SwapItems(&items[i], &items[j]);
    }
}

/* Quicksort, and heapsort where the pivots divide too badly (Musser 1997). */
static void IntroSort(const Sorting* sorting, int32_t* items, int32_t count, int depth)
{
    while (count > FEW_ITEMS) {
        if (depth-- == 0) {
            HeapSort(sorting, items, count);
            return;
        }
        int32_t first = Partition(sorting, items, count), second = count - first;
        bool isFirstShorter = first < second;
        IntroSort(sorting, isFirstShorter ? items : items + first, isFirstShorter ? first : second, depth);
        items += isFirstShorter ? first : 0;
        count = isFirstShorter ? second : first;
    }
    InsertionSort(sorting, items, count);
}

void kiriSort(int32_t* items, int32_t count, kiriBeforeFn* before, const void* context)
{
    const Sorting sorting = { before != NULL ? before : IsLess, context };
    KIRI_ASSERT(count >= 0);
    int depth = 0;
    for (int32_t n = count; n > 0; n /= 2) {
        depth += 2;
    }
    IntroSort(&sorting, items, count, depth);
}
