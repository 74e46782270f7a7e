/* Is a sheet that was read one with which ticks and calls may go on? */
#ifndef KIRI_SHEET_CHECK_H
#define KIRI_SHEET_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_obstacle.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

/* All of it, but for what the world knows: ids, and settings that the host gave. After it all rooms are large enough
   that ticks use without asking for them. */
bool kiriSheet_Check(kiriSheetData* sheet, kiriCheck* check);

/* In what may be cut of the rest plane. */
static inline bool kiriLattice_Has(kiriLatticePoint at)
{
    enum { MOST = KIRI_LATTICE + KIRI_LATTICE / 2 + 2 };
    return at.x >= -MOST && at.x <= MOST && at.y >= -MOST && at.y <= MOST;
}

/* The cuts of a sheet, and the points that wait. */
bool kiriCuts_Check(const kiriSheetData* sheet, kiriCheck* check);

/* The work on a cut: the grid and what follows from it; and the rest, when the sheet in force is right. */
bool kiriUpdate_CheckField(kiriCheck* check, const kiriSheetData* sheet);
bool kiriUpdate_CheckWork(kiriCheck* check, const kiriSheetData* sheet);

/* What both look at: pieces of a layout with so many frames; links that join frames of a piece; places with
   material. */
bool kiriSheet_ArePieces(kiriCheck* check, const kiriLayout* layout, int64_t frames);
bool kiriSheet_AreLinksOfPieces(const kiriLayout* layout, const kiriLink* links, int32_t count);
bool kiriSheet_IsInSquare(const kiriSheetData* sheet, kiriLatticePoint at);

bool kiriObstacle_Check(const kiriObstacleData* obstacle, kiriCheck* check);

KIRI_C_END

#endif
