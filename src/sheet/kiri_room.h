/* Room for what a cut makes: arrays as large as the sheet grow before it, over several ticks where the budget says so. */
#ifndef KIRI_ROOM_H
#define KIRI_ROOM_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* Before the first of the points of an update: room for what they may make. What they make beyond it gets room when
   arrays are full. */
kiriProgress kiriRoom_ForCut(kiriSheetData* sheet, kiriQuota* triangles);

KIRI_C_END

#endif
