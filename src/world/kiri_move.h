/* Motion of sheets in a tick, in parallel where possible; pins on obstacles; obstacles; skinning. */
#ifndef KIRI_MOVE_H
#define KIRI_MOVE_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Reserves room, and finds the sheets that move the same body. Call it after touches are found. Fails on out of memory.
   */
bool kiriMoves_Prepare(kiriWorld* world);

/* Begins the pins of sheets in clusters. Call it before kiriIslands_Prepare. */
void kiriMoves_BeginClusters(kiriWorld* world, double dt);

/* Returns the index of the k-th sheet to move. The order starts at `turn`. */
int32_t kiriMoves_SheetAt(const kiriWorld* world, int32_t turn, int32_t k);

/* Moves the active sheets, starting with the sheet for which the last tick had no systems left. Writes `moves.of`. */
void kiriMoves_Run(kiriWorld* world, double dt, int32_t substeps, kiriQuota* systems);

/* ---- Pins on obstacles ---- */

/* Returns the obstacle that a pin is attached to, or null. */
kiriObstacleData* kiriPinStep_Obstacle(const kiriWorld* world, const kiriPinData* pin);

/* Attaches the pin's current target to the obstacle. */
void kiriPinStep_Fasten(const kiriWorld* world, kiriPinData* pin);

/* ---- Obstacles ---- */

/* Reserves room and an id for one more obstacle. Returns KIRI_OK, KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT. */
kiriResult kiriObstacles_Reserve(kiriWorld* world);

/* Adds an obstacle, made in a block of the world's memory, and gives it its id. */
void kiriObstacles_Add(kiriWorld* world, kiriObstacleData* obstacle);

/* Remove or move an obstacle. Sheets that rest near it wake. */
void kiriObstacles_Remove(kiriWorld* world, kiriObstacleData* obstacle);
void kiriObstacles_Put(kiriWorld* world, kiriObstacleData* obstacle, kiriVec3 position, kiriMat3 rotation);

/* ---- In a tick ---- */

/* Finds the possible touches of sheets, and the sleeping pieces to wake. Call it before anything is committed. Fails on
   out of memory: then nothing has changed. */
bool kiriObstacles_FindTouches(kiriWorld* world, double dt);

/* Reserves room for the loads of the sheet's sleeping pieces on obstacles. Fails on out of memory. */
bool kiriObstacles_ReserveRests(const kiriWorld* world, kiriSheetData* sheet);

/* Clears the impulses of obstacles. Call it when the tick cannot be refused any more. */
void kiriObstacles_Begin(kiriWorld* world);

/* Moves the obstacles by their velocities. */
void kiriObstacles_End(kiriWorld* world, double dt);

/* ---- Skinning, in parallel; large sheets by ranges of vertices ---- */

/* Reserves room for the ranges. Fails on out of memory. */
bool kiriSkinStep_Prepare(kiriWorld* world);

/* Skins the active sheets. */
void kiriSkinStep_Run(kiriWorld* world, double dt);

KIRI_C_END

#endif
