/* Room for what a cut makes: arrays as large as the sheet grow before it, over several ticks where the budget says
   so. */
#ifndef KIRI_ROOM_H
#define KIRI_ROOM_H

#include "../core/kiri_archive.h"
#include "kiri_update.h"

KIRI_C_BEGIN

/* Before points of an update are taken: room for what they may make. More than was guessed gets room when arrays are
   full, all at one go: so whoever goes on in a new tick asks whether room is low. */
bool kiriRoom_IsLow(kiriSheetData* sheet, const kiriQuota* triangles);
kiriProgress kiriRoom_ForCut(kiriSheetData* sheet, kiriQuota* triangles);

/* Before samples are weighed, of which the squares are known. */
kiriProgress kiriRoom_ForWeights(kiriSheetData* sheet, kiriQuota* samples);

/* Where squares have more samples than an even mesh has: room for those that the quota leaves for this tick. */
kiriProgress kiriRoom_ForMoreWeights(kiriSheetData* sheet, kiriQuota* samples);

/* The array that is growing, as bytes, after all else of the sheet. */
void kiriRoom_ArchiveGrowing(kiriArchive* archive, kiriSheetData* sheet);

KIRI_C_END

#endif
