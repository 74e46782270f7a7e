/* Sheets and obstacles as bytes: see core/kiri_archive.h. */
#ifndef KIRI_SHEET_SAVE_H
#define KIRI_SHEET_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_obstacle.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

extern const kiriTable kiriUpdateTable;

/* What only the work on cuts changes, and whoever takes pieces out; then what changes in any tick, with the cuts. Where
   bytes are read the sheet is new, and what is not its own is made of blocks of `memory`. */
void kiriSheet_ArchiveStill(kiriArchive* archive, kiriSheetData* sheet);
void kiriSheet_ArchiveLive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory);

/* When both are read, of bytes that nobody trusts: what follows from the mesh and the frames is forgotten, and with it
   the work at hand, which begins again. False for memory. */
bool kiriSheet_ForgetWork(kiriSheetData* sheet);

/* When both are read, and nothing has failed: what follows from them. False for memory. */
bool kiriSheet_EndReading(kiriSheetData* sheet);

/* One obstacle, which is made where bytes are read. */
void kiriObstacle_Archive(kiriArchive* archive, kiriObstacleData** obstacle, kiriMemory* memory);

KIRI_C_END

#endif
