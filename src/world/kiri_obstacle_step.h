/* The obstacles of a world, and what they do in a tick. */
#ifndef KIRI_OBSTACLE_STEP_H
#define KIRI_OBSTACLE_STEP_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Room and an id for one more. KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT. */
kiriResult kiriObstacles_Reserve(kiriWorld* world);

/* Takes over one that was made of a block of the world, and gives it its id. */
void kiriObstacles_Add(kiriWorld* world, kiriObstacleData* obstacle);

/* Sheets that rest near it wake. */
void kiriObstacles_Remove(kiriWorld* world, kiriObstacleData* obstacle);
void kiriObstacles_Put(kiriWorld* world, kiriObstacleData* obstacle, kiriVec3 position, kiriMat3 rotation);

/* ---- In a tick ---- */

/* Before anything is committed: what sheets may touch, and which of those that sleep shall wake. False for memory: then
   nothing has changed. */
bool kiriObstacles_FindTouches(kiriWorld* world, double dt);

/* The tick is not refused: nothing has been given yet, and sheets wake. */
void kiriObstacles_Begin(kiriWorld* world);

/* Before a sheet is moved: its yield rows get what other sheets gave the same bodies. */
void kiriObstacles_LoadYields(const kiriWorld* world, kiriSheetData* sheet);

/* After it, or while it sleeps: obstacles take what it gave them. */
void kiriObstacles_TakeImpulses(kiriWorld* world, const kiriSheetData* sheet, double dt);

/* They go on with their velocities. */
void kiriObstacles_End(kiriWorld* world, double dt);

KIRI_C_END

#endif
