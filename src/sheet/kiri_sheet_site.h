/* Links across a line that is clamped. What is on its two sides has nothing to do with each other there: the sites on
   both sides are linked with the line instead. */
#ifndef KIRI_SHEET_SITE_H
#define KIRI_SHEET_SITE_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* For a line whose shares are in sheet->lineShares. Adds to the shares: a frame whose region the line meets has its
   site on one side, so what the line has in the region goes, on the other side, to the frames that it is linked with
   across the line. And adds to `severed` the links in place of which the clamp of index `pin` then is. isStaged: with
   links and sites of the next commit. False for memory. */
bool kiriSever_Across(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, int32_t pin, bool isStaged,
                      kiriSevered* severed);

/* Where the frames of a sheet have their sites: found again after a cut, added to pieces that have none, and where
   frames are too few (section 5 of the paper). Steps of an update; what they change is in sheet->update: sites and
   moves. */

/* The cells of the sites that were there, in the grid as it is; a move for each that is in another cell. False for
   memory. */
bool kiriSites_Relocate(kiriSheetData* sheet);

/* Sites for the pieces of orphans, at least one each; marks are cleared before, one a cell. */
kiriProgress kiriSites_PlaceInOrphans(kiriSheetData* sheet, kiriQuota* cells);

/* One more site for each piece with a frame that weighs too much or has too large a region; marks are cleared before,
   one a frame. There are moves after it where it added any. */
kiriProgress kiriSites_Resample(kiriSheetData* sheet, kiriQuota* cells);

/* May a frame want another beside it? Also true where nothing is known of frames. */
bool kiriSites_MayBeFew(const kiriSheetData* sheet);

/* Makes sheet->update.marks `count` zeros, and starts at the first. False for memory. */
bool kiriSites_ClearMarks(kiriSheetData* sheet, int32_t count);

/* How many frames so many cells carry: links are measured on the grid, and it takes more than a square from site to
   site to tell how long and how wide they are. */
int32_t kiriSites_MostIn(int32_t cells);

/* Is a site of the list less than a square away, over a step at most? `holder` has the site in each cell, or
   KIRI_NONE. */
bool kiriSites_IsCrowded(const kiriGrid* grid, const kiriSites* sites, const kiriSite* site, const int32_t* holder);

/* Carries on what the placer has started; isPlacing says whether it goes on in the next tick. */
kiriProgress kiriSites_RunPlacer(kiriSheetData* sheet, kiriQuota* quota);

/* How many of `count` things spread over the sheet fall to the piece in the placer: one at least. */
int32_t kiriSites_ShareOf(const kiriSheetData* sheet, double count);

KIRI_C_END

#endif
