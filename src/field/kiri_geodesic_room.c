/* Room of a field, and how it is emptied after a flood. */
#include "kiri_geodesic.h"

/* The one with room for all cells. */
static kiriIndices* LongList(kiriField* field)
{
    return field->settled.capacity < field->dirty.capacity ? &field->dirty : &field->settled;
}

bool kiriField_Resize(kiriField* field, kiriMemory* memory, int32_t cellCount)
{
    if (!kiriArray_Reserve(memory, &field->distance, cellCount) ||
        !kiriArray_Reserve(memory, &field->owner, cellCount) ||
        !kiriArray_Reserve(memory, LongList(field), cellCount) ||
        !kiriArray_Reserve(memory, &field->marks, cellCount)) {
        return false;
    }
    for (int32_t c = field->distance.count; c < cellCount; ++c) {
        field->distance.data[c] = KIRI_FAR;
        field->owner.data[c] = KIRI_NONE;
        field->marks.data[c] = 0;
    }
    field->distance.count = field->owner.count = field->marks.count = cellCount;
    return true;
}

void kiriField_Reset(kiriField* field)
{
    for (int32_t i = 0; i < field->settled.count; ++i) {
        field->distance.data[field->settled.data[i]] = KIRI_FAR;
        field->owner.data[field->settled.data[i]] = KIRI_NONE;
    }
    field->settled.count = 0;
}
