/* Pins, clamps, hinges and held frames in the steps of a tick. */
#ifndef KIRI_PIN_H
#define KIRI_PIN_H

#include "kiri_sheet.h"
#include "kiri_piece.h"
#include "kiri_seen.h"

KIRI_C_BEGIN

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

/* After a commit: copies the history of reactions to frames that were held before. Clamps may keep their strains, and
   springs their pull, by offsets; these start at zero on other frames. `old`: the previous layout. */
void kiriPins_Keep(kiriSheetData* sheet, const kiriLayout* old);

/* Gives clamps the rest curvature of the sheet's material. before: the material until now. */
void kiriPins_TakeRest(kiriSheetData* sheet, const kiriMaterial* before);

/* Fades the offsets of clamps to 1/e within `time` (s). */
void kiriPins_FadeOffsets(kiriSheetData* sheet, double dt, double time);

/* Sets the target pose of a line to the current pose of its material. */
void kiriPin_TakePose(const kiriSheetData* sheet, kiriPinData* pin);

/* Returns the elastic energy of clamps, J. `system`: of the sheet. */
double kiriPins_ElasticEnergy(const kiriSheetData* sheet, kiriSystem system);

/* Writes the rows of all clamps at the end of the tick; `rows` has room for one a share. Returns how many. */
int32_t kiriPins_WriteClamps(const kiriSheetData* sheet, kiriClampRow* rows);

/* Write the rows of awake pieces, and clear and read their reactions. Targets move linearly within a tick: the rows are
   for a step between two fractions of the tick in [0, 1]. Reactions keep their history. */
void kiriPins_WriteRows(kiriSheetData* sheet, double from, double to);
void kiriPins_BeginReactions(kiriSheetData* sheet);
void kiriPins_TakeReactions(kiriSheetData* sheet, double dt);

/* Adds the reactions of the shares of each line. */
void kiriPins_SumShares(kiriSheetData* sheet);

/* Returns the stiffness of a pin whose def gives none, N/m. */
static inline double kiriPins_Stiffness(const kiriSheetData* sheet)
{
    return 10.0 * sheet->settings.material.youngsModulus * sheet->settings.material.thickness;
}

/* Draws points and lines where pins hold them. The skin blends several frames, their patches bend less than the sheet at a
   clamp, and pins yield. So patches of the frames at a pin get one offset each of the drawn surface (kiriShift), which
   fades with their weights; at a clamp they leave the line in its direction. Motion, contacts and blades do not see it. No offset where the skin is farther from its pin
   than a region is wide, where a pin is softer than a tenth of kiriPins_Stiffness (its spring is seen longer), and in
   sheets with seams, whose lips move likewise. */
void kiriPins_Draw(kiriSheetData* sheet, double dt);

/* Targets of pins and held frames in the steps of a tick.

   Targets of the host are interpolated linearly over the steps.

   Pins hold points of frames: targets that follow the drawn surface of the last tick would do work on the sheet.

   An obstacle with mass yields to a pin. The host applies the impulses of the whole tick at once and then moves the
   obstacle; the model here does the same. W is the velocity of the target per impulse, and J the impulse of the pin so
   far in the tick. At time t of the tick the target has moved by t W J, and the force F of a step h moves it by
   t h W F. */

/* Sets the targets before step i of n, of h seconds. */
void kiriFollow_Step(kiriSheetData* sheet, int32_t i, int32_t n, double h);

KIRI_C_END

#endif
