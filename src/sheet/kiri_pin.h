/* Pins, clamps, hinges, held frames and loads in the steps of a tick; sheets that the host moves all at once. */
#ifndef KIRI_PIN_H
#define KIRI_PIN_H

#include "kiri_sheet.h"
#include "kiri_piece.h"
#include "kiri_seen.h"

KIRI_C_BEGIN

/* Each point x of the sheet goes to R x + t, with its velocity and history, and with its holds. The arrays that the
   host may hold go to `retired`, and others are written. False for memory: nothing has changed. */
bool kiriCarry_Sheet(kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t, kiriMemory* retired);

/* The same for where a pin holds it. */
void kiriCarry_Pin(kiriSheetData* sheet, int32_t index, const kiriMat3* R, kiriVec3 t);

/* The origin of the world goes to another place, and nothing else changes. Before it kiriCarry_Renew: arrays that the
   host may hold go to `retired`; until positions are written the new ones have none. False for memory: nothing has
   changed. */
bool kiriCarry_Renew(kiriSheetData* sheet, kiriMemory* retired);
void kiriCarry_Shift(kiriSheetData* sheet, kiriVec3 origin);

/* Would frames still fit floats, see kiriFrame_FitsFloats? */
bool kiriCarry_FitsSheet(const kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t);

/* The frames of a piece, or of all (KIRI_NONE), move as one rigid body: `spin` about their centre of mass. False, and
   changes nothing, where frames would not fit floats. */
bool kiriCarry_SetVelocity(kiriSheetData* sheet, int32_t piece, kiriVec3 velocity, kiriVec3 spin);

/* Pins: points and lines of the material that the host holds. */

/* Adds a pin and all the room that it needs. A point is held by `frame`; a line by the frames of sheet->lineShares.
   False for memory. */
bool kiriPins_Add(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame);

/* Continues the frames of a pin with a step of backward Euler: the pin is new, or will be moved or removed. */
void kiriPins_ForgetHistory(kiriSheetData* sheet, int32_t index);

/* The last pin takes its index. */
void kiriPins_Remove(kiriSheetData* sheet, int32_t index);

/* Stages which frames the pins hold after the next commit, with all the room that they need. False for memory. */
bool kiriPins_Stage(kiriSheetData* sheet);

/* Writes what clamps leave of the links: whenever links or clamps have changed. There is room. */
void kiriPins_WriteLinkParts(kiriSheetData* sheet);

/* After the commit: reactions on a frame that was held before go on with their history. */
void kiriPins_KeepReactions(kiriSheetData* sheet, const kiriPinShares* old);

/* After the commit, where links keep their strains (kiri_strain.h): clamps go on with the strains that they had
   when frames were as before it and shares were `old`; on a frame that they did not hold they begin without any. */
void kiriPins_KeepStrains(kiriSheetData* sheet, const kiriPinShares* old);

/* Fades the offsets of clamps to 1/e within `time` (s). */
void kiriPins_FadeOffsets(kiriSheetData* sheet, double dt, double time);

/* Sets the pose of a line to where its material is now. */
void kiriPin_TakePose(const kiriSheetData* sheet, kiriPinData* pin);

/* Elastic energy between clamps and the sites of the frames that they hold, J. */
double kiriPins_ElasticEnergy(const kiriSheetData* sheet);

/* Write the rows and reactions of pieces that are awake. Pins that the host moves go on evenly within a tick: rows belong
   to a step from one part of the tick, 0 to 1, to another. Reactions start at zero, but for their history. */
void kiriPins_WriteRows(kiriSheetData* sheet, double from, double to);
void kiriPins_BeginReactions(kiriSheetData* sheet);
void kiriPins_TakeReactions(kiriSheetData* sheet, double dt);

/* Adds the reactions of the shares of each line. */
void kiriPins_SumShares(kiriSheetData* sheet);

/* Clears the reactions of a tick in which the motion could not be continued. */
void kiriPins_ClearReactions(kiriSheetData* sheet);

/* Where pins and held frames hold the sheet in the steps of a tick.

   Goals of the host are reached evenly: each step takes its part of the way.

   The held point is the one that is seen. A smooth surface (KIRI_SKINNING_SMOOTH) lies off the point that a frame
   alone gives. So the target of a pin, or of a held frame, is moved by the offset of the frame's point from the
   surface of the last tick. A clamp moves its pose by the mean offset of the surface from its line, all shares of a
   piece together: a line that bends would curl the sheet. That takes some ticks; when it changes no more the sheet may
   sleep. Hinges turn freely, so the surface does not bend at them, and lies on the line anyway.

   An obstacle with mass yields to a pin. Its host gives it the impulses of the whole tick at once, before it moves it:
   so it does here. With W the velocity that an impulse gives the target, and J what the pin has given so far in the
   tick, the target is t W J away at the time t of the tick, and the force F of a step of h moves it by t h W F. */

/* At the start of a tick of dt. */
void kiriFollow_Begin(kiriSheetData* sheet, double dt);

/* Before step i of n, of h seconds. */
void kiriFollow_Step(kiriSheetData* sheet, int32_t i, int32_t n, double h);

/* Loads of the host on the material, for the next tick: they add to the forces of frames. */

/* A force (N) on a point of the material that the frame holds, and a torque (N m). */
void kiriLoad_AtPoint(kiriSheetData* sheet, int32_t frame, kiriVec2 at, kiriVec3 force, kiriVec3 torque);

/* A force along a line (N/m of the rest line) on what of it is in sheet->lineShares. */
void kiriLoad_AlongLine(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, kiriVec3 perLength);

/* A pressure (Pa) on the side that the normal leaves: it pushes along the normal of each frame as it is now. */
void kiriLoad_OnSurface(kiriSheetData* sheet, double pressure);

/* An impulse (N s) on a point as it is seen, at once: each frame that carries the point gets its share. The sheet gets
   the impulse, and its moment about where the point is seen. False, and changes nothing, where frames would not fit
   floats. */
bool kiriLoad_Impulse(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 impulse);

KIRI_C_END

#endif
