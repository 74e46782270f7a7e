/* Detaches pieces as new sheets, or removes them. While a cut is worked on in their sheet, pieces wait for its end:
   until then removed pieces stay in the mesh, but are invisible and touch nothing. */
#ifndef KIRI_PART_H
#define KIRI_PART_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Returns true if pieces wait and no cut is worked on in the sheet. No such work begins before they have left. */
bool kiriParts_AreDue(const kiriSheetData* sheet);

/* Returns true if a piece of the sheet neither is gone nor waits. `rest`: only these pieces count, unless it is null. */
bool kiriParts_StaySome(const kiriWorld* world, const kiriSheetData* sheet, const kiriFlags* rest);

/* Pays for the pieces that are due, with the samples that are left at the end of a tick. */
void kiriParts_Pay(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples);

/* Removes the pieces that are paid, at the start of a tick, and adds an event for each new sheet. The paid samples alone
   decide. On failure nothing has changed. */
kiriResult kiriParts_Leave(kiriWorld* world, kiriSheetData* sheet);

KIRI_C_END

#endif
