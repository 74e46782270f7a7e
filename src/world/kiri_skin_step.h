/* Sheets are skinned, side by side; large ones by ranges of their vertices. */
#ifndef KIRI_SKIN_STEP_H
#define KIRI_SKIN_STEP_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Room for the ranges. False for memory. */
bool kiriSkinStep_Prepare(kiriWorld* world);

/* Of the sheets that the tick at hand looks at. */
void kiriSkinStep_Run(kiriWorld* world, double dt);

KIRI_C_END

#endif
