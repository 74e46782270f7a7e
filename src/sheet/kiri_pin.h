/* Pins: points of the material that the host holds. */
#ifndef KIRI_PIN_H
#define KIRI_PIN_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* The index of the frame that holds a point of the material; KIRI_NONE outside. */
int32_t kiriPins_FrameAt(const kiriSheetData* sheet, kiriLatticePoint at);

/* Adds a pin and all the room that it needs; false for memory. */
bool kiriPins_Add(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame);

/* The last pin takes its index. */
void kiriPins_Remove(kiriSheetData* sheet, int32_t index);

KIRI_C_END

#endif
