/* Creation of a sheet from its def, and changes of its settings. */
#ifndef KIRI_BUILD_H
#define KIRI_BUILD_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Settings that the host may change after creation. */

/* Returns the sweeps of the detail layer. A planar sheet has no layer. */
int32_t kiriSettings_Detail(const kiriSettings* settings);

/* Copies the settings to the parts of a new sheet that store a copy. */
void kiriSettings_Apply(kiriSheetData* sheet);

/* Changes the settings of an existing sheet and updates dependent state. Changes nothing on out of memory: false. */
bool kiriSettings_Change(kiriSheetData* sheet, const kiriSheetSettings* given);

/* Creation of a sheet from its def. */

/* Builds a new sheet from a checked def. On failure the fault gives the reason, or "" if the result is enough, and the
   caller deletes the sheet. The world assigns the ids of sheet and frames. */
kiriResult kiriBuild_FromDef(kiriSheetData* sheet, const kiriSheetDef* def, const kiriFold* folds, int32_t foldCount,
                             kiriFault* fault);

/* Commits the first layout of a sheet, after all stages. Fails on out of memory. */
bool kiriBuild_Commit(kiriSheetData* sheet);

/* Adds a checked fold to the table; its creases are made later. KIRI_ERROR_ARGUMENT, with a fault, or out of memory. */
kiriResult kiriFolds_Add(kiriSheetData* sheet, const kiriFold* fold, kiriFault* fault);

KIRI_C_END

#endif
