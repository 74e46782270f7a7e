/* Pins, clamps, hinges, held frames and loads in the steps of a tick; sheets that the host moves all at once. */
#ifndef KIRI_PIN_H
#define KIRI_PIN_H

#include "kiri_sheet.h"
#include "kiri_piece.h"
#include "kiri_seen.h"

KIRI_C_BEGIN

/* Transforms the sheet by x -> R x + t, with velocities, history and holds. Arrays that the host may hold get the owner
   `retired` and are replaced. Changes nothing on out of memory: false. */
bool kiriCarry_Sheet(kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t, kiriMemory* retired);

/* Transforms the target of a pin likewise. */
void kiriCarry_Pin(kiriSheetData* sheet, int32_t index, const kiriMat3* R, kiriVec3 t);

/* Shift moves the origin of the world and changes nothing else. Call Renew first: arrays that the host may hold get the
   owner `retired`, and the new ones are unset until positions are written. Renew changes nothing on out of memory:
   false. */
bool kiriCarry_Renew(kiriSheetData* sheet, kiriMemory* retired);
void kiriCarry_Shift(kiriSheetData* sheet, kiriVec3 origin);

/* Returns true if the transformed frames fit floats, see kiriFrame_FitsFloats. */
bool kiriCarry_FitsSheet(const kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t);

/* Sets the velocities of a piece, or of all (KIRI_NONE), to a rigid motion with `spin` about the center of mass.
   Returns false, and changes nothing, if frames would not fit floats. */
bool kiriCarry_SetVelocity(kiriSheetData* sheet, int32_t piece, kiriVec3 velocity, kiriVec3 spin);

/* Pins: points and lines of the material that the host holds. */

/* Adds a pin and reserves for it. `frame` holds a point; the frames of sheet->lineShares hold a line. Fails on out of
   memory. */
bool kiriPins_Add(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame);

/* Continues the frames of a pin with a step of backward Euler: the pin is new, or will be moved or removed. */
void kiriPins_ForgetHistory(kiriSheetData* sheet, int32_t index);

/* Removes a pin. The last pin takes its index. */
void kiriPins_Remove(kiriSheetData* sheet, int32_t index);

/* Stages the frames that pins hold after the next commit, and reserves for them. Fails on out of memory. */
bool kiriPins_Stage(kiriSheetData* sheet);

/* Writes sheet->linkParts. Call when links or clamps changed. Capacity is reserved. */
void kiriPins_WriteLinkParts(kiriSheetData* sheet);

/* Copies the reaction history to frames that were held before. Call after the commit. */
void kiriPins_KeepReactions(kiriSheetData* sheet, const kiriPinShares* old);

/* Keeps the strains of clamps across a commit, if links keep theirs (kiri_strain.h). `old` are the previous shares. On
   a frame that was not held before the strain starts at zero. Call after the commit. */
void kiriPins_KeepStrains(kiriSheetData* sheet, const kiriPinShares* old);

/* Fades the offsets of clamps to 1/e within `time` (s). */
void kiriPins_FadeOffsets(kiriSheetData* sheet, double dt, double time);

/* Sets the target pose of a line to the current pose of its material. */
void kiriPin_TakePose(const kiriSheetData* sheet, kiriPinData* pin);

/* Elastic energy between clamps and the sites of the frames that they hold, J. */
double kiriPins_ElasticEnergy(const kiriSheetData* sheet);

/* Write the rows and reactions of awake pieces. Targets move linearly within a tick: the rows are for a step between
   two fractions of the tick in [0, 1]. Reactions start at zero and keep their history. */
void kiriPins_WriteRows(kiriSheetData* sheet, double from, double to);
void kiriPins_BeginReactions(kiriSheetData* sheet);
void kiriPins_TakeReactions(kiriSheetData* sheet, double dt);

/* Adds the reactions of the shares of each line. */
void kiriPins_SumShares(kiriSheetData* sheet);

/* Clears the reactions of a tick in which the solver failed. */
void kiriPins_ClearReactions(kiriSheetData* sheet);

/* Targets of pins and held frames in the steps of a tick.

   Targets of the host are interpolated linearly over the steps.

   A pin holds the visible point. A smooth surface (KIRI_SKINNING_SMOOTH) is offset from the point of a single frame. So
   the target of a pin, or of a held frame, is shifted by the offset between the frame's point and the surface of the
   last tick. A clamp shifts its pose by the mean offset over all shares of a piece: separate offsets would bend the
   line and curl the sheet. The offset converges in some ticks; then the sheet may sleep. A hinge needs no offset: it
   turns freely, so the surface does not bend there and lies on the line.

   An obstacle with mass yields to a pin. The host applies the impulses of the whole tick at once and then moves the
   obstacle; the model here does the same. W is the velocity of the target per impulse, and J the impulse of the pin so
   far in the tick. At time t of the tick the target has moved by t W J, and the force F of a step h moves it by
   t h W F. */

/* Prepares the targets at the start of a tick of dt. */
void kiriFollow_Begin(kiriSheetData* sheet, double dt);

/* Sets the targets before step i of n, of h seconds. */
void kiriFollow_Step(kiriSheetData* sheet, int32_t i, int32_t n, double h);

/* Loads of the host for the next tick, added to the forces of frames. */

/* Adds a force (N) at a material point of the frame, and a torque (N m). */
void kiriLoad_AtPoint(kiriSheetData* sheet, int32_t frame, kiriVec2 at, kiriVec3 force, kiriVec3 torque);

/* Adds a force along a line (N/m of rest length), on its shares in sheet->lineShares. */
void kiriLoad_AlongLine(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, kiriVec3 perLength);

/* Adds a pressure (Pa) that pushes along the current normal of each frame. */
void kiriLoad_OnSurface(kiriSheetData* sheet, double pressure);

/* Applies an impulse (N s) at the visible position of a point, at once, to the frames that carry it. The sheet gains
   exactly this linear and angular momentum. Returns false, and changes nothing, if frames would not fit floats. */
bool kiriLoad_Impulse(kiriSheetData* sheet, const kiriPointPlace* place, kiriVec3 impulse);

KIRI_C_END

#endif
