/* Numbers of the items of a row that stay when other items are taken away and the row moves together: what names items
   in long lists names them so, and need not be written anew. */
#ifndef KIRI_LABEL_H
#define KIRI_LABEL_H

#include "kiri_keep.h"

KIRI_C_BEGIN

/* Labels ascend with items. Items that are not listed have the labels that follow: so at first each is its own. */
typedef struct kiriLabels {
    KIRI_ARRAY(int32_t) itemOf;  /* of each label; KIRI_NONE: it has been taken away */
    KIRI_ARRAY(int32_t) labelOf; /* of each item */
} kiriLabels;

/* The item with a label that is in use. */
static inline int32_t kiriLabels_Item(const kiriLabels* labels, int32_t label)
{
    KIRI_ASSERT(label >= 0);
    int32_t listed = labels->itemOf.count;
    return label < listed ? labels->itemOf.data[label] : label - listed + labels->labelOf.count;
}

static inline int32_t kiriLabels_Of(const kiriLabels* labels, int32_t item)
{
    KIRI_ASSERT(item >= 0);
    int32_t listed = labels->labelOf.count;
    return item < listed ? labels->labelOf.data[item] : item - listed + labels->itemOf.count;
}

/* So many labels do `items` have, with those that are no longer used. */
static inline int32_t kiriLabels_Count(const kiriLabels* labels, int32_t items)
{
    return items + labels->itemOf.count - labels->labelOf.count;
}

/* Is this the label of one of so many items? */
static inline bool kiriLabels_Has(const kiriLabels* labels, int32_t label, int32_t items)
{
    return (uint32_t)label < (uint32_t)kiriLabels_Count(labels, items) &&
           (label >= labels->itemOf.count || labels->itemOf.data[label] != KIRI_NONE);
}

/* Do labels ascend, and is each listed where its item is? For bytes that come from elsewhere. */
bool kiriLabels_AreSound(const kiriLabels* labels, int32_t items);

/* Room to list the labels of so many items. False for memory. */
bool kiriLabels_Reserve(kiriLabels* labels, kiriMemory* memory, int32_t items);

/* Items are taken away, and labels stay. There is room. */
void kiriLabels_Keep(kiriLabels* labels, const kiriKeep* items);

/* The same, but labels move together as well: what each becomes is its item's new index, so that each item is its own
   label again. Map has room for all labels; after it Forget may be called. */
void kiriLabels_Map(const kiriLabels* labels, const kiriKeep* items, kiriKeep* map);
void kiriLabels_Forget(kiriLabels* labels);

KIRI_C_END

#endif
