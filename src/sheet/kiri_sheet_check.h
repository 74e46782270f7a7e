/* Is a sheet that was read one with which ticks and calls may go on? */
#ifndef KIRI_SHEET_CHECK_H
#define KIRI_SHEET_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_obstacle.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Checks all saved fields, but not ids and settings of the host: the world checks these. */
bool kiriSheet_Check(kiriSheetData* sheet, kiriCheck* check);

/* Checks arrays with an item a link, after kiriRemake_Field. Then all rooms are large enough for ticks that do not ask
   for room. */
bool kiriSheet_CheckMade(const kiriSheetData* sheet, kiriCheck* check);

/* In what may be cut of the rest plane. */
static inline bool kiriLattice_Has(kiriLatticePoint at)
{
    enum { MOST = KIRI_LATTICE + KIRI_LATTICE / 2 + 2 };
    return at.x >= -MOST && at.x <= MOST && at.y >= -MOST && at.y <= MOST;
}

/* The cuts of a sheet, and the points that wait. */
bool kiriCuts_Check(const kiriSheetData* sheet, kiriCheck* check);

bool kiriObstacle_Check(const kiriObstacleData* obstacle, kiriCheck* check);

KIRI_C_END

#endif
