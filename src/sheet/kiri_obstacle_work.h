/* What the files of kiri_obstacle_touch.h share. */
#ifndef KIRI_OBSTACLE_WORK_H
#define KIRI_OBSTACLE_WORK_H

#include "kiri_obstacle_touch.h"
#include "kiri_touch.h"

#include <string.h>

KIRI_C_BEGIN

/* Of the distance that is kept: a point so near above it is a touch already, though it may not come down in this tick.
   So one that rests does not lose its force whenever it lifts a little. */
#define KIRI_NEARBY 0.5

/* Marks keys of round sides: their item is a triangle, not a point of an edge. */
#define KIRI_ROUND_ITEM (UINT32_C(1) << 31)

/* A sheet near an obstacle. */
typedef struct kiriMeeting {
    kiriObstacleSearch* search;
    kiriSheetData* sheet;
    const kiriObstacleData* obstacle;
    kiriVec3 across;          /* local to the obstacle: normal of the plane of a planar sheet, else zero */
    double gap;               /* m: distance that is kept */
    double reach;             /* m: how far it may be between them and still touch in the tick */
    double square;            /* m: of the grid */
    int32_t squares, columns; /* of the grid along its side; patches in a row */
    double friction;          /* of both */
    int32_t yield;
} kiriMeeting;

/* m/s: of a vertex, as frames blend it. */
kiriVec3 kiriMeeting_VertexVelocity(const kiriSheetData* sheet, int32_t vertex);

/* m: what a point of the material may move relative to the obstacle, twice as far as velocities and gravity tell. */
kiriVec3 kiriMeeting_Way(const kiriMeeting* meeting, kiriVec3 point, kiriVec3 velocity);

/* A plane through a point of the obstacle, with all that a touch says but whom it touches. False where the plane of a
   planar sheet lies along it. */
bool kiriMeeting_MakePlane(const kiriMeeting* meeting, kiriVec3 normal, kiriVec3 at, double gap, kiriTouch* touch);

/* Between vertices: of up to three, by their shares. */
void kiriMeeting_SetPlace(kiriTouch* touch, const int32_t* vertices, const double* shares, int32_t count);

/* Kind, whether it is between vertices, slot of the obstacle, and an item: a vertex, or a point of an edge. */
uint64_t kiriMeeting_Key(const kiriMeeting* meeting, bool isBetween, uint32_t item);

/* Is the side from a to b part of the border? All triangles with it are among those near. */
bool kiriMeeting_IsBorder(const kiriSurface* surface, const kiriIndices* near, int32_t a, int32_t b);

/* Adds the touches of each kind. False for memory. */
bool kiriMeeting_TouchVertices(const kiriMeeting* meeting);
bool kiriMeeting_TouchEdges(const kiriMeeting* meeting);   /* of the obstacle, against triangles, */
bool kiriMeeting_TouchCorners(const kiriMeeting* meeting); /* and where they go through the plane of a planar sheet */
bool kiriMeeting_TouchRounds(const kiriMeeting* meeting);  /* round sides between vertices that are far apart */

KIRI_C_END

#endif
