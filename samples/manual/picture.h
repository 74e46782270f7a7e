/* Before a program of the manual: it takes pictures of the world in some ticks, of what the variable KIRI_PICTURE says:
   "FILE; ticks 1 6; floor -1; eye X Y Z; target X Y Z; view DEGREES; draw blades frames links". */
#ifndef PICTURE_H
#define PICTURE_H

#include "kiri/kiri.h"

kiriResult Picture_CreateObstacle(kiriWorld* world, const kiriObstacleDef* def, kiriObstacle* obstacle);
kiriResult Picture_Tick(kiriWorld* world, float dt, int32_t substeps);

/* Writes the file. */
void Picture_Destroy(kiriWorld* world);

#define kiriCreateObstacle Picture_CreateObstacle
#define kiriWorld_Tick Picture_Tick
#define kiriDestroyWorld Picture_Destroy

#endif
