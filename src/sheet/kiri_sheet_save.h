/* Sheets as bytes, and the checks of sheets that were loaded: see core/kiri_archive.h. */
#ifndef KIRI_SHEET_SAVE_H
#define KIRI_SHEET_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Moves a sheet with its cuts. READ: the sheet is new; its cuts become blocks of `memory`. */
void kiriSheet_Archive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory);

/* Ends the load of a save after ids are claimed: checks the sheet and derives the other fields. The world checks the
   host's settings. */
void kiriSheet_Derive(kiriSheetData* sheet, kiriArchive* archive);

/* Derives vertices, bounds and probes of a loaded sheet. Fails on out of memory. */
bool kiriSheet_EndReading(kiriSheetData* sheet, bool isWhole);

/* Hashes sizes and offsets of all fields of a sheet. */
void kiriSheet_HashLayout(uint64_t* hash);

KIRI_C_END

#endif
