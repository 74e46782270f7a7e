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

KIRI_C_END

#endif
