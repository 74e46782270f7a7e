/* Sheets and obstacles as bytes: see core/kiri_archive.h. */
#ifndef KIRI_SHEET_SAVE_H
#define KIRI_SHEET_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_obstacle.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Moves a sheet with its cuts. Where bytes are read the sheet is new; its cuts become blocks of `memory`. */
void kiriSheet_Archive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory);

/* The part of it that any tick changes; the other part comes before. */
void kiriSheet_ArchiveLive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory);

/* Hashes sizes and places of all fields of a sheet. */
void kiriSheet_HashLayout(uint64_t* hash);

/* Derives vertices, boxes and probes of a sheet that was read without a failure. False for memory. */
bool kiriSheet_EndReading(kiriSheetData* sheet, bool isWhole);

/* One obstacle, which is made where bytes are read. */
void kiriObstacle_Archive(kiriArchive* archive, kiriObstacleData** obstacle, kiriMemory* memory);

KIRI_C_END

#endif
