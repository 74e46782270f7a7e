/* Pins that go with obstacles. */
#ifndef KIRI_PIN_STEP_H
#define KIRI_PIN_STEP_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* The obstacle that a pin goes with, or null. */
kiriObstacleData* kiriPinStep_Obstacle(const kiriWorld* world, const kiriPinData* pin);

/* The target as it is now is where the obstacle has it from now on. */
void kiriPinStep_Fasten(const kiriWorld* world, kiriPinData* pin);

/* The sheet has gone to R x + t: so do the targets of its pins, but those on obstacles. */
void kiriPinStep_Carry(const kiriWorld* world, kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t);

/* Before a sheet is moved: targets go from where obstacles are to where they will be at the end of the tick. Wakes the
   sheet where one has moved. */
void kiriPinStep_Begin(const kiriWorld* world, kiriSheetData* sheet, double dt);

/* After it, or while it sleeps: obstacles that may be moved, or the others, take what pins gave them. */
void kiriPinStep_End(const kiriWorld* world, const kiriSheetData* sheet, double dt, bool areMovable);

KIRI_C_END

#endif
