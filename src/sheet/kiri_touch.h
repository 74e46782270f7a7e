/* Touches: possible contacts of points of a sheet in a tick. The searches add them before cuts take effect, from the
   visible positions. After the commit the solver gets a contact row for each, with the committed weights. Contact
   forces are stored by key until the next tick. */
#ifndef KIRI_TOUCH_H
#define KIRI_TOUCH_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Returns the bounding box of the visible surface. */
kiriBox kiriSheet_Box(const kiriSheetData* sheet);

/* Returns an upper bound of the speed of any point, m/s. `box` contains the sheet. */
double kiriSheet_SpeedLimit(const kiriSheetData* sheet, const kiriBox* box);

/* Returns twice the distance that a point of this speed can move in a tick under gravity, m. */
double kiriReach_Of(double speed, kiriVec3 gravity, double dt);

/* Drops the touches of the previous tick and adds the host's contacts. On out of memory this and the next three return
   false, or KIRI_NONE, and the tick is refused. */
bool kiriTouches_Begin(kiriSheetData* sheet);

/* Adds a touch and writes its `seen`. Its vertices must be visible, not new. Add only touches whose plane the point can
   reach within the tick: each costs a row. */
bool kiriTouches_Add(kiriSheetData* sheet, const kiriTouch* touch);

/* Returns where the surface shows the point of a touch now. */
kiriVec3 kiriTouch_Seen(const kiriSheetData* sheet, const kiriTouch* touch);

/* Adds a row for the body that several touches press on. Returns its index. */
int32_t kiriTouches_AddYield(kiriSheetData* sheet, const kiriYieldRow* yield);

/* Returns the index of the yield row with this number, or KIRI_NONE. */
int32_t kiriTouches_FindYield(const kiriSheetData* sheet, int64_t number);

/* Returns true if the obstacle of the row can move. Fixed obstacles have rows too, which sum their impulses. */
static inline bool kiriTouches_CanYield(const kiriSheetData* sheet, int32_t yield)
{
    return yield != KIRI_NONE && sheet->touches.yields.data[yield].inverseMass > 0.0;
}

/* Reserves all arrays for `count` touches. */
bool kiriTouches_Room(kiriSheetData* sheet, int64_t count);

/* Reserves all arrays for the touches found. Call when the searches are done. */
bool kiriTouches_Reserve(kiriSheetData* sheet);

/* Writes a row for each touch of an awake piece, in order. Call after the commit. */
void kiriTouches_WriteRows(kiriSheetData* sheet);

/* Makes the contact of a touch with a row soft. `distance`: that they keep, m. If the place on the other sheet moves in
   this tick, and both have the same model, makes the contact mutual and returns true. Else its plane stays fixed. */
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

/* Returns the velocity of a vertex, m/s. */
kiriVec3 kiriProbe_Velocity(const kiriSheetData* sheet, int32_t vertex);

/* Writes the largest weights of a material point, up to KIRI_STITCH_SIDE, largest first, with the sum 1. All frames
   are of one piece. Returns their number; 0 outside the material. */
int32_t kiriTouches_WeighPoint(const kiriSheetData* sheet, kiriLatticePoint at, kiriContactMember* weights);

/* Returns the point that frames carry by these weights. */
kiriVec3 kiriSheet_CarriedPoint(const kiriSheetData* sheet, const kiriContactMember* weights, int32_t count);

/* Stored contact forces, by key. */

static inline bool kiriTouch_IsOfKind(const kiriTouch* touch, int32_t kind)
{
    return touch->key >> 60 == (uint64_t)kind;
}

/* Stores a touch and its force. Capacity is reserved. kiriTouches_Find works after kiriTouchMemory_SortForces. */
void kiriTouchMemory_Add(kiriTouchMemory* memory, const kiriTouch* touch, kiriVec3 force);

/* Merges the nonzero forces of the touches from `first` on into the sorted forces. `order` has capacity for them. */
void kiriTouchMemory_SortForces(kiriTouchMemory* memory, int32_t first, kiriIndices* order);

/* Returns the index of the first force whose key is not less. */
int32_t kiriTouchMemory_FirstFrom(const kiriTouchMemory* memory, uint64_t key);

/* Takes the first remaining force of a key; returns zero if there is none. Its entry stays, zeroed, until DropTaken. */
kiriVec3 kiriTouchMemory_Take(kiriTouchMemory* memory, uint64_t key);
void kiriTouchMemory_DropTaken(kiriTouchMemory* memory);

KIRI_C_END

#endif
