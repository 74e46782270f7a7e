/* Pins: points and lines of the material that the host holds. */
#ifndef KIRI_PIN_H
#define KIRI_PIN_H

#include "kiri_owner.h"

KIRI_C_BEGIN

/* Adds a pin and all the room that it needs. A point is held by `frame`; a line by the frames of sheet->lineShares.
   False for memory. */
bool kiriPins_Add(kiriSheetData* sheet, const kiriPinData* pin, int32_t frame);

/* What the pin holds goes on with a step of backward Euler: it was made, or will be moved or removed. */
void kiriPins_ForgetHistory(kiriSheetData* sheet, int32_t index);

/* The last pin takes its index. */
void kiriPins_Remove(kiriSheetData* sheet, int32_t index);

/* Stages which frames the pins hold after the next commit, with all the room that they need. False for memory. */
bool kiriPins_Stage(kiriSheetData* sheet);

/* Writes what clamps leave of the links: whenever links or clamps have changed. There is room. */
void kiriPins_WriteLinkParts(kiriSheetData* sheet);

/* After the commit: reactions on a frame that was held before go on with their history. */
void kiriPins_KeepReactions(kiriSheetData* sheet, const kiriPinShares* old);

/* After the commit, where links keep their strains (kiri_strain_offset.h): clamps go on with the strains that they had
   when frames were as before it and shares were `old`; on a frame that they did not hold they begin without any. */
void kiriPins_KeepStrains(kiriSheetData* sheet, const kiriPinShares* old);

/* The offsets that this leaves fade to 1/e within `time` (s). */
void kiriPins_FadeOffsets(kiriSheetData* sheet, double dt, double time);

/* The middle (local m) of what a share has of its line; and where the pin has such a point. */
kiriVec2 kiriPin_Centroid(const kiriSheetData* sheet, const kiriPinShare* pinned);
kiriVec3 kiriPin_PlaceOf(const kiriSheetData* sheet, const kiriPinData* pin, kiriVec2 point);

/* The pose of a line where its material is now. */
void kiriPin_TakePose(const kiriSheetData* sheet, kiriPinData* pin);

/* Elastic energy between clamps and the sites of the frames that they hold, J. */
double kiriPins_ElasticEnergy(const kiriSheetData* sheet);

/* Is it a pin of a point whose piece is awake? Such pins have the first of the rows, in their order. */
bool kiriPins_IsAwakePoint(const kiriSheetData* sheet, int32_t index);

/* Writes what the solver reads of what is awake. Pins that the host moves go on evenly within a tick: rows are those of
   a step from one part of it, 0 to 1, to another. Reactions begin with a tick; after it they are what pins and held
   frames had to bear. */
void kiriPins_WriteRows(kiriSheetData* sheet, double from, double to);
void kiriPins_BeginReactions(kiriSheetData* sheet);
void kiriPins_TakeReactions(kiriSheetData* sheet, double dt);

/* What a line bore is the sum of what its shares did. */
void kiriPins_SumShares(kiriSheetData* sheet);

/* Where the motion could not be continued: pins and holds had nothing to bear. */
void kiriPins_ClearReactions(kiriSheetData* sheet);

KIRI_C_END

#endif
