/* Sheets are moved, side by side where they may. */
#ifndef KIRI_MOVE_H
#define KIRI_MOVE_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* When touches are found: room, and which sheets move the same body. False for memory. */
bool kiriMoves_Prepare(kiriWorld* world);

/* The k-th sheet that is moved, an index, where `turn` is the first whose turn it is. */
int32_t kiriMoves_SheetAt(const kiriWorld* world, int32_t turn, int32_t k);

/* Moves the active sheets, first the one that came too late in the last tick. In `of` is what became of each. */
void kiriMoves_Run(kiriWorld* world, double dt, int32_t substeps, kiriQuota* systems);

/* Pins that go with obstacles. */

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

/* The obstacles of a world, and what they do in a tick. */

/* Room and an id for one more. KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT. */
kiriResult kiriObstacles_Reserve(kiriWorld* world);

/* Takes over one that was made of a block of the world, and gives it its id. */
void kiriObstacles_Add(kiriWorld* world, kiriObstacleData* obstacle);

/* Sheets that rest near it wake. */
void kiriObstacles_Remove(kiriWorld* world, kiriObstacleData* obstacle);
void kiriObstacles_Put(kiriWorld* world, kiriObstacleData* obstacle, kiriVec3 position, kiriMat3 rotation);

/* Of its body: above zero, that of an obstacle on its own below 2^32 and odd. */
int64_t kiriObstacles_NumberOf(const kiriObstacleData* obstacle);

/* The obstacle of a touch; null for what is no touch of an obstacle. */
kiriObstacleData* kiriObstacles_OwnerOf(const kiriWorld* world, uint64_t key);

/* ---- In a tick ---- */

/* Before anything is committed: what sheets may touch, and which of those that sleep shall wake. False for memory: then
   nothing has changed. */
bool kiriObstacles_FindTouches(kiriWorld* world, double dt);

/* Room for what pieces of the sheet that sleep press with. False for memory. */
bool kiriObstacles_ReserveRests(const kiriWorld* world, kiriSheetData* sheet);

/* The tick is not refused: nothing has been given yet. */
void kiriObstacles_Begin(kiriWorld* world);

/* Before a sheet is moved: its yield rows get what other sheets gave the same bodies. */
void kiriObstacles_LoadYields(const kiriWorld* world, kiriSheetData* sheet);

/* After it, or while it sleeps: obstacles that it may move, or the others, take what it gave them. */
void kiriObstacles_TakeImpulses(const kiriWorld* world, kiriSheetData* sheet, double dt, bool areMovable);

/* They go on with their velocities. */
void kiriObstacles_End(kiriWorld* world, double dt);

/* Sheets are skinned, side by side; large ones by ranges of their vertices. */

/* Room for the ranges. False for memory. */
bool kiriSkinStep_Prepare(kiriWorld* world);

/* Of the sheets that the tick at hand looks at. */
void kiriSkinStep_Run(kiriWorld* world, double dt);

KIRI_C_END

#endif
