/* Contacts of a sheet with an obstacle in a tick, found on the visible surface at the start of the tick.

   A vertex touches the nearest face of the obstacle, or the face by which it would enter. Vertices are thinned: in each
   patch of the material (a few grid squares), the deepest vertex over a face represents the others. Between vertices,
   edges of the obstacle touch triangles at points one grid square apart. */
#ifndef KIRI_MEETING_H
#define KIRI_MEETING_H

#include "kiri_obstacle.h"
#include "kiri_touch.h"

KIRI_C_BEGIN

/* A vertex that represents its patch. */
typedef struct kiriNearVertex {
    int32_t vertex, patch;
    int32_t next;    /* next entry of the patch, or KIRI_NONE */
    double height;   /* m, above the obstacle */
    kiriVec3 normal; /* local to the obstacle */
} kiriNearVertex;

/* How a piece leaves an obstacle in which it lies deep. */
typedef struct kiriWayOut {
    double depth;       /* m: of its deepest vertex */
    double front, back; /* m: longest ways out of its vertices along the normals of the sheet, and against them */
    double side;        /* 1: it leaves to the front, -1: to the back, 0: each vertex at its nearest place */
} kiriWayOut;

/* Scratch of a search, reused for each sheet and obstacle. */
typedef struct kiriObstacleSearch {
    kiriMemory* memory;
    double dt;
    kiriVec3 gravity;
    kiriIndices triangles;      /* near the obstacle, in no order */
    kiriIndices vertices;       /* vertices of these triangles, ascending */
    kiriIndices crossed;        /* triangles near a point of an edge */
    KIRI_ARRAY(uint32_t) marks; /* per vertex: `mark` of the last search that visited it, and 1 if it had a force */
    uint32_t mark;              /* twice the number of this search */
    kiriIndices heads;          /* per patch: first entry of `chosen`, or KIRI_NONE */
    KIRI_ARRAY(kiriNearVertex) chosen;
    KIRI_ARRAY(kiriWayOut) ways; /* of each piece */
} kiriObstacleSearch;

/* Updates the key of an obstacle touch after vertices and triangles were removed. Returns false if its item was. */
bool kiriObstacle_FollowKey(uint64_t* key, const kiriKeep* vertices, const kiriKeep* triangles);

/* Returns the slot of the obstacle in the key. */
int32_t kiriObstacle_SlotOfKey(uint64_t key);

/* Reserves for this sheet, so that no search in it allocates. */
bool kiriObstacleSearch_Reserve(kiriObstacleSearch* search, const kiriSheetData* sheet);

/* Finds triangles whose box is within `reach` of the obstacle's box. Bounds must be fresh. Fails on out of memory. */
bool kiriObstacleSearch_Near(kiriObstacleSearch* search, const kiriSheetData* sheet, const kiriObstacleData* obstacle,
                             double reach);

/* Adds touches of the pieces that move, or wake in this tick. Bounds must be fresh. `yield` is the row of the
   obstacle's body. Fails on out of memory. */
bool kiriObstacleSearch_Run(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle,
                            double speed, int32_t yield);

/* While the detail layer relaxes: keeps its vertices out of obstacles, and at the contact distance where the skin is. */
void kiriObstacles_PushDetail(kiriObstacleData* const* obstacles, int32_t count, kiriSheetData* sheet);

KIRI_C_END

#endif
