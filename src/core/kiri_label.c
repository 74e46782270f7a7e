#include "kiri_label.h"

bool kiriLabels_AreSound(const kiriLabels* labels, int32_t items)
{
    int32_t listed = labels->labelOf.count, next = 0;
    bool areSound =
        listed <= items && listed <= labels->itemOf.count && labels->itemOf.count - listed <= INT32_MAX - items;
    for (int32_t label = 0; areSound && label < labels->itemOf.count; ++label) {
        int32_t item = labels->itemOf.data[label];
        areSound = item == KIRI_NONE || (item == next && next < listed && labels->labelOf.data[next] == label);
        next += item != KIRI_NONE;
    }
    return areSound && next == listed;
}

bool kiriLabels_Reserve(kiriLabels* labels, kiriMemory* memory, int32_t items)
{
    return kiriArray_Reserve(memory, &labels->itemOf, kiriLabels_Count(labels, items)) &&
           kiriArray_Reserve(memory, &labels->labelOf, items);
}

/* Those that follow are listed, too. */
static void ListLabels(kiriLabels* labels, int32_t items)
{
    int32_t count = kiriLabels_Count(labels, items), label = labels->itemOf.count;
    KIRI_ASSERT(count <= labels->itemOf.capacity && items <= labels->labelOf.capacity);
    for (int32_t item = labels->labelOf.count; label < count; ++label) {
        labels->itemOf.data[label] = item++;
    }
    labels->itemOf.count = count;
}

void kiriLabels_Keep(kiriLabels* labels, const kiriKeep* items)
{
    int32_t used = 0;
    ListLabels(labels, items->to.count);
    labels->labelOf.count = 0;
    for (int32_t label = 0; label < labels->itemOf.count; ++label) {
        int32_t item = kiriKeep_To(items, labels->itemOf.data[label]);
        labels->itemOf.data[label] = item;
        if (item != KIRI_NONE) {
            KIRI_ASSERT(item == labels->labelOf.count);
            labels->labelOf.data[labels->labelOf.count++] = label;
            used = label + 1;
        }
    }
    labels->itemOf.count = used;
}

void kiriLabels_Map(const kiriLabels* labels, const kiriKeep* items, kiriKeep* map)
{
    int32_t count = kiriLabels_Count(labels, items->to.count);
    for (int32_t label = 0; label < count; ++label) {
        kiriKeep_Add(map, kiriKeep_Has(items, kiriLabels_Item(labels, label)));
    }
}

void kiriLabels_Forget(kiriLabels* labels)
{
    labels->itemOf.count = labels->labelOf.count = 0;
}
