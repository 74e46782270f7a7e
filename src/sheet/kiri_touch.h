/* Contacts of a sheet with an obstacle in a tick, found on the visible surface at the start of the tick.

   A vertex touches the nearest face of the obstacle, or the face by which it would enter. Vertices are thinned: in each
   patch of the material (a few grid squares), the deepest vertex over a face represents the others. Between vertices,
   edges of the obstacle touch triangles at points one grid square apart. */
#ifndef KIRI_TOUCH_H
#define KIRI_TOUCH_H

#include "kiri_obstacle.h"
#include "kiri_sheet.h"

#include <string.h>

KIRI_C_BEGIN

/* A vertex that represents its patch. */
typedef struct kiriNearVertex {
    int32_t vertex, patch, frame; /* frame: the one with the largest weight */
    int32_t next;                 /* next entry of the patch, or KIRI_NONE */
    double height;                /* m, above the obstacle */
    kiriVec3 normal;              /* local to the obstacle */
} kiriNearVertex;

/* Scratch of a search, reused for each sheet and obstacle. */
typedef struct kiriObstacleSearch {
    kiriMemory* memory;
    double dt;
    kiriVec3 gravity;
    kiriIndices triangles;      /* near the obstacle, in no order */
    kiriIndices vertices;       /* vertices of these triangles, ascending */
    kiriIndices crossed;        /* triangles near a point of an edge */
    KIRI_ARRAY(uint32_t) marks; /* per vertex: `mark` of the last search that visited it */
    uint32_t mark;              /* number of this search */
    kiriIndices heads;          /* per patch: first entry of `chosen`, or KIRI_NONE */
    KIRI_ARRAY(kiriNearVertex) chosen;
} kiriObstacleSearch;

/* Updates the key of an obstacle touch after vertices and triangles were removed. Returns false if its item was. */
bool kiriObstacle_FollowKey(uint64_t* key, const kiriKeep* vertices, const kiriKeep* triangles);

/* Returns the slot of the obstacle in the key. */
int32_t kiriObstacle_SlotOfKey(uint64_t key);

/* Returns the bounding box of the visible surface. */
kiriBox kiriSheet_Box(const kiriSheetData* sheet);

/* Returns an upper bound of the speed of any point, m/s. `box` contains the sheet. */
double kiriSheet_SpeedLimit(const kiriSheetData* sheet, const kiriBox* box);

/* Returns twice the distance that a point of this speed can move in a tick under gravity, m. */
double kiriReach_Of(double speed, kiriVec3 gravity, double dt);

/* Reserves for this sheet, so that no search in it allocates. */
bool kiriObstacleSearch_Reserve(kiriObstacleSearch* search, const kiriSheetData* sheet);

/* Finds triangles whose box is within `reach` of the obstacle's box. Bounds must be fresh. Fails on out of memory. */
bool kiriObstacleSearch_Near(kiriObstacleSearch* search, const kiriSheetData* sheet, const kiriObstacleData* obstacle,
                             double reach);

/* Adds touches of the pieces that move, or wake in this tick. Bounds must be fresh. `yield` is the row of the
   obstacle's body. Fails on out of memory. */
bool kiriObstacleSearch_Run(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle,
                            double speed, int32_t yield);

/* Touches: possible contacts of points of a sheet in a tick. The searches add them before cuts take effect, from the
   visible positions. After the commit the solver gets a contact row for each, with the committed weights. Contact
   forces are stored by key until the next tick. */

/* Drops the touches of the previous tick and adds the host's contacts. On out of memory this and the next three return
   false, or KIRI_NONE, and the tick is refused. */
bool kiriTouches_Begin(kiriSheetData* sheet);

/* Adds a touch and writes its `seen`. Its vertices must be visible, not new. Add only touches whose plane the point can
   reach within the tick: each costs a row. */
bool kiriTouches_Add(kiriSheetData* sheet, const kiriTouch* touch);

/* Adds a row for the body that several touches press on. Returns its index. */
int32_t kiriTouches_AddYield(kiriSheetData* sheet, const kiriYieldRow* yield);

/* Returns the index of the yield row with this number, or KIRI_NONE. */
int32_t kiriTouches_FindYield(const kiriSheetData* sheet, int64_t number);

/* Reserves all arrays for `count` touches. */
bool kiriTouches_Room(kiriSheetData* sheet, int64_t count);

/* Reserves all arrays for the touches found. Call when the searches are done. */
bool kiriTouches_Reserve(kiriSheetData* sheet);

/* Writes a row for each touch of an awake piece, in order. Call after the commit. */
void kiriTouches_WriteRows(kiriSheetData* sheet);

/* Makes the contact of a touch with a row soft. `distance`: that they keep, m. If the place on the other sheet moves in this tick, and both sheets have
   the same model, makes the contact mutual and returns true. Otherwise its plane stays fixed. */
bool kiriTouches_JoinRow(kiriSheetData* sheet, const kiriTouch* touch, double distance, kiriSheetData* other,
                         const int32_t vertex[3], const double share[3]);

/* Finds the next calm piece whose host contacts differ from the ones in its last motion. Returns false at the end.
   *at starts at 0. A piece may come more than once. */
bool kiriTouches_NextNew(kiriSheetData* sheet, int32_t* at, int32_t* piece);

/* Returns the piece of a touch. */
int32_t kiriTouch_Piece(const kiriSheetData* sheet, const kiriTouch* touch);

/* Moves stored touches between `last` and `slept`. Call when the set of moved pieces changed. */
void kiriTouches_Sort(kiriSheetData* sheet);

/* Stores the contact forces. Call after the sheet was moved. */
void kiriTouches_End(kiriSheetData* sheet);

/* Writes the results of the host's contacts and removes the contacts. `dt` is the time step, s. A sleeping piece
   reports the force with which it fell asleep. */
void kiriTouches_Tell(kiriSheetData* sheet, double dt);

/* Clears the forces of awake pieces, after the solver failed. */
void kiriTouches_Clear(kiriSheetData* sheet);

/* Returns the contact with this key in the last motion of its piece, or null if it did not push; and its force, N, or zero. */
const kiriTouchForce* kiriTouches_Find(const kiriSheetData* sheet, uint64_t key);
kiriVec3 kiriTouches_ForceOf(const kiriSheetData* sheet, uint64_t key);

/* Maps a touch to a detached part with these points and vertices. Returns false if it belongs to another part, or only
   the search that found it can map it. */
bool kiriTouch_Follow(kiriTouch* touch, const kiriKeep* points, const kiriKeep* vertices);

/* Shared by kiri_touch.c and kiri_obstacle.c. */

/* Fraction of the contact distance. A point this little above it is a touch, even if it cannot reach it in this tick.
   So a resting point that lifts a little keeps its force. */
#define KIRI_NEARBY 0.5

/* Key bit of round sides: the item is a triangle, not a point of an edge. */
#define KIRI_ROUND_ITEM (UINT32_C(1) << 31)

/* Input of the searches for one sheet and one obstacle. */
typedef struct kiriMeeting {
    kiriObstacleSearch* search;
    kiriSheetData* sheet;
    const kiriObstacleData* obstacle;
    kiriVec3 across;          /* plane normal of a planar sheet, local to the obstacle; else zero */
    double gap;               /* m: contact distance */
    double reach;             /* m: largest distance at which they may touch in the tick */
    double square;            /* m: side of a grid square */
    int32_t squares, columns; /* grid squares along the side of a patch; patches in a row */
    double friction;          /* coefficient of the pair */
    int32_t yield;            /* yield row of the obstacle's body, or KIRI_NONE */
    bool isThinned;           /* one vertex a patch touches; else all vertices */
} kiriMeeting;

/* Returns the velocity of a vertex, blended from the frames, m/s. */
kiriVec3 kiriMeeting_VertexVelocity(const kiriSheetData* sheet, int32_t vertex);

/* Returns twice the displacement of a material point relative to the obstacle in the tick, under gravity, m. */
kiriVec3 kiriMeeting_Way(const kiriMeeting* meeting, kiriVec3 point, kiriVec3 velocity);

/* Makes the touch with the plane through a point of the obstacle; its vertices and key are not set. Returns false if
   the plane is parallel to the plane of a planar sheet. */
bool kiriMeeting_MakePlane(const kiriMeeting* meeting, kiriVec3 normal, kiriVec3 at, double gap, kiriTouch* touch);

/* Sets the point of a touch to a blend of up to three vertices. */
void kiriMeeting_SetPlace(kiriTouch* touch, const int32_t* vertices, const double* shares, int32_t count);

/* Returns the key: kind, isBetween (vertices), slot of the obstacle, and item (a vertex, or a point of an edge). */
uint64_t kiriMeeting_Key(const kiriMeeting* meeting, bool isBetween, uint32_t item);

/* Returns true if the edge from a to b is on the border. `near` contains all triangles of the edge. */
bool kiriMeeting_IsBorder(const kiriSurface* surface, const kiriIndices* near, int32_t a, int32_t b);

/* Add the touches of each kind. Fail on out of memory. */
bool kiriMeeting_TouchVertices(const kiriMeeting* meeting);
bool kiriMeeting_TouchEdges(const kiriMeeting* meeting);   /* edges of the obstacle against triangles */
bool kiriMeeting_TouchCorners(const kiriMeeting* meeting); /* edges of the obstacle against a planar sheet's border */
bool kiriMeeting_TouchRounds(const kiriMeeting* meeting);  /* round sides against the inside of coarse triangles */

/* Probes: the vertices that may touch other sheets. Inside a piece there are a dozen a frame or more, at most one a
   grid square; on its border they are twice as dense, sharpest corners first. Between probes the surface hardly
   bends. */

/* Chooses the probes again if mesh or pieces changed. Then updates boxes of pieces and velocities of probes from the
   visible surface; skips this if the sheet sleeps and they are current. The mesh must be the visible one. Fails on out
   of memory. */
bool kiriProbes_Update(kiriSheetData* sheet);

/* Chooses the probes of a loaded sheet, with the stored `block`. */
bool kiriProbes_Remake(kiriSheetData* sheet);

/* Returns the frame with the largest weight. */
int32_t kiriSkin_LeadingFrame(const kiriSkin* skin, int32_t sample);

/* Sets vertexFrame, and lists the probes by frame. Probes are up to date. Fails on out of memory. */
bool kiriProbes_ListRegions(kiriSheetData* sheet);

/* Returns the velocity of a vertex, m/s. */
kiriVec3 kiriProbe_Velocity(const kiriSheetData* sheet, int32_t vertex);

/* Stored contact forces, by key. */

static inline bool kiriTouch_IsOfKind(const kiriTouch* touch, int32_t kind)
{
    return touch->key >> 60 == (uint64_t)kind;
}

/* Stores a touch and its force. Capacity is reserved. kiriTouches_Find works after kiriTouchMemory_SortForces. */
void kiriTouchMemory_Add(kiriTouchMemory* memory, const kiriTouch* touch, kiriVec3 force);

/* Merges the nonzero forces of the touches from `first` on into the sorted forces. `order` has capacity for them. */
void kiriTouchMemory_SortForces(kiriTouchMemory* memory, int32_t first, kiriIndices* order);

/* Takes the first remaining force of a key; returns zero if there is none. Its entry stays, zeroed, until DropTaken. */
kiriVec3 kiriTouchMemory_Take(kiriTouchMemory* memory, uint64_t key);
void kiriTouchMemory_DropTaken(kiriTouchMemory* memory);

/* While the detail layer relaxes: keeps its vertices out of obstacles, and at the contact distance where the skin is. */
void kiriObstacles_PushDetail(kiriObstacleData* const* obstacles, int32_t count, kiriSheetData* sheet);

KIRI_C_END

#endif
