/* Tearing: cuts go on by themselves where the sheet sets more energy free than a longer cut takes. */
#ifndef KIRI_TEAR_H
#define KIRI_TEAR_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* s: strain offsets fade within this while a sheet tears. Those of moved sites hide the force on the tear. */
#define KIRI_TEAR_FADE 0.01

enum { KIRI_TEAR_ITERATIONS = 16 }; /* of a sheet that tears, at least */

/* Returns true if tears may grow in the sheet. */
static inline bool kiriTears_MayGrow(const kiriSheetData* sheet)
{
    return sheet->settings.tearing.toughness > 0.0f && sheet->settings.mechanics.model == KIRI_MODEL_LINKS;
}

/* Returns true if a cut is a tear. */
bool kiriTears_AreGrowing(const kiriSheetData* sheet);

/* Returns the distance of frames in a piece, m: the root of the mean area of its regions. */
double kiriTears_Spacing(const kiriSheetData* sheet, int32_t piece);

/* Finds the tips, in the order of their points. No update may be in progress. Fails on out of memory. */
bool kiriTears_List(kiriSheetData* sheet);

/* Measures the links. Tips are listed. Fails on out of memory. */
bool kiriTears_Measure(kiriSheetData* sheet);

/* Returns where a tip goes in this tick, at most this far (m); the tip itself if the sheet holds there. *along: the
   direction. */
kiriVec2 kiriTear_Next(const kiriSheetData* sheet, const kiriTearTip* tip, double most, kiriVec2* along);

/* Finds where a new tear begins in this tick, at most this long (m): where the stress exceeds the strength most. False:
   nowhere. */
bool kiriTears_FindStart(const kiriSheetData* sheet, double most, kiriVec2* from, kiriVec2* to);

KIRI_C_END

#endif
