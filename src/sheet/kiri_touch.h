/* Touches: where points of a sheet may meet something in a tick. Whoever knows what is around the sheet adds them
   before cuts take effect, from where the sheet is seen; the solver gets a contact row for each, with the weights that
   are in force then. What contacts pushed with is remembered by key until the next tick. */
#ifndef KIRI_TOUCH_H
#define KIRI_TOUCH_H

#include "kiri_update.h"

KIRI_C_BEGIN

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

KIRI_C_END

#endif
