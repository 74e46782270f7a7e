/* Settings of a sheet that its host may change while it lives. */
#ifndef KIRI_SETTINGS_H
#define KIRI_SETTINGS_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* What the def says of them. */
kiriSheetSettings kiriSettings_Of(const kiriSheetDef* def);

/* Takes them over, checked; `square` is the side of a grid square, m. What only the def says is there already. */
void kiriSettings_Take(kiriSettings* settings, const kiriSheetSettings* given, double square);

/* Hands the settings to the parts of a new sheet that keep their own. */
void kiriSettings_Apply(kiriSheetData* sheet);

/* Takes over others in a sheet that lives, with all that follows. False for memory: then nothing has changed. */
bool kiriSettings_Change(kiriSheetData* sheet, const kiriSheetSettings* given);

KIRI_C_END

#endif
