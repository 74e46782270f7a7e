/* Where a sheet touches an obstacle, or may within the tick: on the surface as it is seen, at the start of the tick.

   Vertices touch the obstacle's nearest face, or the one that they would enter by. They are thinned: of those in a
   patch of the material, a few squares of the grid, over one face, the deepest stands for all. Between vertices the
   edges of the obstacle touch triangles, at points along them a square apart. */
#ifndef KIRI_TOUCH_H
#define KIRI_TOUCH_H

#include "kiri_obstacle.h"
#include "kiri_sheet.h"
#include "kiri_update.h"

#include <string.h>

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

/* Touches: where points of a sheet may meet something in a tick. Whoever knows what is around the sheet adds them
   before cuts take effect, from where the sheet is seen; the solver gets a contact row for each, with the weights that
   are in force then. What contacts pushed with is remembered by key until the next tick. */

/* Forgets the touches that were found for another tick, and adds the contacts that the host gave. This and the next
   three are false, or KIRI_NONE, for memory; then the tick is refused. */
bool kiriTouches_Begin(kiriSheetData* sheet);

/* `seen` is written; vertices are below the number of those that are seen. A touch that pushes within the tick wants
   its plane no farther than the point can go: others cost a row each. */
bool kiriTouches_Add(kiriSheetData* sheet, const kiriTouch* touch);

/* What several touches press on, and its index. */
int32_t kiriTouches_AddYield(kiriSheetData* sheet, const kiriYieldRow* yield);

/* The index of the yield row with that number, or KIRI_NONE. */
int32_t kiriTouches_FindYield(const kiriSheetData* sheet, int64_t number);

/* Room for so many touches, in all that comes of them. */
bool kiriTouches_Room(kiriSheetData* sheet, int64_t count);

/* When all are found: room for what comes of them. */
bool kiriTouches_Reserve(kiriSheetData* sheet);

/* After the commit: a row for each touch of a piece that is awake, in their order. */
void kiriTouches_WriteRows(kiriSheetData* sheet);

/* The next calm piece of which the host's contacts are others than those by which it was moved last; false where there
   is none. *at is 0 at first. A piece may come more than once. */
bool kiriTouches_NextNew(kiriSheetData* sheet, int32_t* at, int32_t* piece);

/* The piece that has it. */
int32_t kiriTouch_Piece(const kiriSheetData* sheet, const kiriTouch* touch);

/* When other pieces are moved: what is remembered of them is there where it belongs. */
void kiriTouches_Sort(kiriSheetData* sheet);

/* After the sheet was moved: remembers what pushed. */
void kiriTouches_End(kiriSheetData* sheet);

/* What the host is told of its contacts; the contacts are gone then. `dt` s: of the tick. A piece that sleeps pushes
   with what it fell asleep with. */
void kiriTouches_Tell(kiriSheetData* sheet, double dt);

/* The motion could not be continued: nothing that is awake pushed. */
void kiriTouches_Clear(kiriSheetData* sheet);

/* What the contact of that key pushed with when its piece was moved last, N; zero where there was none. */
kiriVec3 kiriTouches_ForceOf(const kiriSheetData* sheet, uint64_t key);

/* The same touch in a part of the sheet, whose collision points and vertices have these indices; false where it is of
   another part, or its finder alone knows it. */
bool kiriTouch_Follow(kiriTouch* touch, const kiriKeep* points, const kiriKeep* vertices);

/* What the files of kiri_touch.h share. */

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

/* Probes: the vertices by which a sheet feels others. A dozen a frame or more inside of a piece, at most one a grid
   square, and along its border twice as close, the sharpest corners first: between them the surface hardly bends. */

/* Chooses the probes anew where mesh or pieces have changed, and puts the boxes of pieces and the velocities of probes
   where the surface is seen now, unless the sheet sleeps and they are there. The mesh is the one that is seen. False
   for memory. */
bool kiriProbes_Update(kiriSheetData* sheet);

/* Of a sheet that was read from bytes: chooses them as they were chosen, which is by `block`. */
bool kiriProbes_Remake(kiriSheetData* sheet);

/* m/s: of a vertex. */
kiriVec3 kiriProbe_Velocity(const kiriSheetData* sheet, int32_t vertex);

/* What touches pushed with, by key: of those of the last tick, and of those of pieces that sleep. */

static inline bool kiriTouch_IsOfKind(const kiriTouch* touch, int32_t kind)
{
    return touch->key >> 60 == (uint64_t)kind;
}

/* Remembers a touch with its force. There is room. Forces are found by key after kiriTouchMemory_SortForces. */
void kiriTouchMemory_Add(kiriTouchMemory* memory, const kiriTouch* touch, kiriVec3 force);

/* Sorts the forces of the touches from `first` on, but for those that are zero, into those that are there. `order` has
   room for as many. */
void kiriTouchMemory_SortForces(kiriTouchMemory* memory, int32_t first, kiriIndices* order);

/* The force of that key; false, and *force as it was, where there is none. */
bool kiriTouchMemory_Find(const kiriTouchMemory* memory, uint64_t key, kiriVec3* force);

/* Takes the first force of that key that was not taken; zero where there is none. It stays in its place, as zero, until
   all are dropped that were taken. */
kiriVec3 kiriTouchMemory_Take(kiriTouchMemory* memory, uint64_t key);
void kiriTouchMemory_DropTaken(kiriTouchMemory* memory);

KIRI_C_END

#endif
