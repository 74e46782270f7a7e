/* Sheets and obstacles as bytes: see core/kiri_archive.h. */
#ifndef KIRI_SHEET_SAVE_H
#define KIRI_SHEET_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_obstacle.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

extern const kiriTable kiriUpdateTable;

/* Moves a sheet with its cuts. Where bytes are read the sheet is new; its cuts become blocks of `memory`. */
void kiriSheet_Archive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory);

/* When it is read, of bytes that nobody trusts: what follows from the mesh and the frames is forgotten, and with it
   the work at hand, which begins again. False for memory. */
bool kiriSheet_ForgetWork(kiriSheetData* sheet);

/* When it is read, and nothing has failed: what follows from them. False for memory. */
bool kiriSheet_EndReading(kiriSheetData* sheet);

/* One obstacle, which is made where bytes are read. */
void kiriObstacle_Archive(kiriArchive* archive, kiriObstacleData** obstacle, kiriMemory* memory);

KIRI_C_END

#endif
