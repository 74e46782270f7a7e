#include "kiri_pin.h"

/* While an update is at hand regions may be half done: then the frame that weighs most at the corners. */
static int32_t HeaviestAt(const kiriSheetData* sheet, int32_t triangle)
{
    const kiriSkin* skin = &sheet->vertexSkin;
    kiriWeight heaviest = { KIRI_NONE, 0.0 };
    for (int corner = 0; corner < 3; ++corner) {
        kiriSpan span = skin->spans.data[sheet->mesh.triangles.data[triangle].vertex[corner]];
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            if (skin->weights.data[k].value > heaviest.value) {
                heaviest = skin->weights.data[k];
            }
        }
    }
    return heaviest.frame;
}

int32_t kiriPins_FrameAt(const kiriSheetData* sheet, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    if (triangle == KIRI_NONE) {
        return KIRI_NONE;
    }
    if (!kiriUpdate_IsFieldCurrent(sheet->update)) {
        return HeaviestAt(sheet, triangle);
    }
    int32_t cell = kiriGrid_CellOf(&sheet->grid, &sheet->mesh, triangle, at);
    return cell == KIRI_NONE ? HeaviestAt(sheet, triangle) : sheet->regions.field.owner.data[cell];
}

bool kiriPins_Add(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame)
{
    int64_t need = (int64_t)sheet->pins.count + 1;
    if (!kiriArray_Reserve(sheet->memory, &sheet->pins, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->pinRows, need) ||
        !kiriArray_Reserve(sheet->memory, &sheet->layout.pinFrame, need)) {
        return false;
    }
    sheet->pins.data[sheet->pins.count++] = *pin;
    sheet->layout.pinFrame.data[sheet->layout.pinFrame.count++] = frame;
    return true;
}

void kiriPins_Remove(kiriSheetData* sheet, int32_t index)
{
    KIRI_ASSERT(index >= 0 && index < sheet->pins.count && sheet->layout.pinFrame.count == sheet->pins.count);
    int32_t last = --sheet->pins.count;
    sheet->layout.pinFrame.count = last;
    sheet->pins.data[index] = sheet->pins.data[last];
    sheet->layout.pinFrame.data[index] = sheet->layout.pinFrame.data[last];
}
