/* Where a sheet touches an obstacle, or may within the tick: on the surface as it is seen, at the start of the tick.

   Vertices touch the obstacle's nearest face, or the one that they would enter by. They are thinned: of those in a
   patch of the material, a few squares of the grid, over one face, the deepest stands for all. Between vertices the
   edges of the obstacle touch triangles, at points along them a square apart. */
#ifndef KIRI_OBSTACLE_TOUCH_H
#define KIRI_OBSTACLE_TOUCH_H

#include "kiri_obstacle.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

/* A vertex that stands for its patch. */
typedef struct kiriNearVertex {
    int32_t vertex, patch, frame; /* frame: the one that carries most of it */
    int32_t next;                 /* in the same patch, or KIRI_NONE */
    double height;                /* above the obstacle, m */
    kiriVec3 normal;              /* local to the obstacle */
} kiriNearVertex;

/* Room to search, for one sheet and obstacle after another. Nothing in it lasts. */
typedef struct kiriObstacleSearch {
    kiriMemory* memory;
    double dt;
    kiriVec3 gravity;
    kiriIndices triangles;      /* near the obstacle, in no order */
    kiriIndices vertices;       /* of these, in order */
    kiriIndices crossed;        /* near a point of an edge */
    KIRI_ARRAY(uint32_t) marks; /* of each vertex: the search that has seen it last */
    uint32_t mark;              /* of this search */
    kiriIndices heads;          /* of each patch: the first vertex that stands for it, or KIRI_NONE */
    KIRI_ARRAY(kiriNearVertex) chosen;
} kiriObstacleSearch;

/* The key that the touch of an obstacle gets when vertices and triangles are taken away; false where its own is. */
bool kiriObstacle_FollowKey(uint64_t* key, const kiriKeep* vertices, const kiriKeep* triangles);

/* The slot of the obstacle whose touch has the key. */
int32_t kiriObstacle_SlotOfKey(uint64_t key);

/* The least box around the surface as it is seen. */
kiriBox kiriSheet_Box(const kiriSheetData* sheet);

/* m/s: no point of the sheet moves faster. `box` is around the sheet. */
double kiriSheet_SpeedLimit(const kiriSheetData* sheet, const kiriBox* box);

/* m: how far a point may come in a tick with this speed, by velocity and gravity, twice. */
double kiriReach_Of(double speed, kiriVec3 gravity, double dt);

/* Makes room for this sheet, so that no search in it needs memory. */
bool kiriObstacleSearch_Reserve(kiriObstacleSearch* search, const kiriSheetData* sheet);

/* Finds the triangles whose box is within reach of that of the obstacle; bounds must be fresh. False for memory. */
bool kiriObstacleSearch_Near(kiriObstacleSearch* search, const kiriSheetData* sheet, const kiriObstacleData* obstacle,
                             double reach);

/* Adds touches of the pieces that move, or shall wake, of the sheet, whose bounds must be fresh; `yield` is the row of
   the obstacle's body. False for memory. */
bool kiriObstacleSearch_Run(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle,
                            double speed, int32_t yield);

KIRI_C_END

#endif
