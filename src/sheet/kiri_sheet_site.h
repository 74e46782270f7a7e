/* Links across a clamped line. The clamp replaces them: it couples the sites on either side with the line instead of
   with each other. */
#ifndef KIRI_SHEET_SITE_H
#define KIRI_SHEET_SITE_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Extends the shares of the line in sheet->lineShares to both sides. A region that the line meets has its site on one
   side; its share of the line also goes, on the other side, to the frames linked with it across the line. Adds to
   `severed` the links that the clamp of index `pin` replaces. isStaged: uses links and sites of the next commit. Fails
   on out of memory. */
bool kiriSever_Across(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, int32_t pin, bool isStaged,
                      kiriSevered* severed);

/* Sites of frames in an update: located again after a cut, added to pieces without a frame, and added where frames are
   too few (section 5 of the paper). The steps change sites and moves in sheet->update. */

/* Finds the cells of the existing sites in the current grid, and adds a move for each site that changed its cell. Fails
   on out of memory. */
bool kiriSites_Relocate(kiriSheetData* sheet);

/* Moves the two sites nearest to the tip of each tear beside it. Fails on out of memory. */
bool kiriSites_FollowTears(kiriSheetData* sheet);

/* Places at least one site in each piece of orphans. Needs cleared marks, one a cell. */
kiriProgress kiriSites_PlaceInOrphans(kiriSheetData* sheet, kiriQuota* cells);

/* Adds sites to each piece in which a frame exceeds rigidWeight or has too large a region. Adds moves for them. Needs
   cleared marks, one a frame. */
kiriProgress kiriSites_Resample(kiriSheetData* sheet, kiriQuota* cells);

/* Returns true if the pins of a new sheet need frames that are placed again. Then shortens frameLength between pins. */
bool kiriSites_MeetPins(kiriSheetData* sheet);

/* Returns true if a piece may need more frames, or if this is unknown. */
bool kiriSites_MayBeFew(const kiriSheetData* sheet);

/* Sets placing.marks to `count` zeros, and placing.at to 0. Fails on out of memory. */
bool kiriSites_ClearMarks(kiriSheetData* sheet, int32_t count);

/* Returns the largest count of frames for this count of cells. The grid measures length and width of links, which needs
   more than a square between sites. */
int32_t kiriSites_MostIn(int32_t cells);

/* Returns true if another site is less than a square away, within one step of the grid. `holder` is the site in each
   cell, or KIRI_NONE. */
bool kiriSites_IsCrowded(const kiriGrid* grid, const kiriSites* sites, const kiriSite* site, const int32_t* holder);

/* Continues the placer. isPlacing stays true if it must continue in the next tick. */
kiriProgress kiriSites_RunPlacer(kiriSheetData* sheet, kiriQuota* quota);

/* Returns the share of the current piece, by area, in `count` items over the sheet; at least 1. */
int32_t kiriSites_ShareOf(const kiriSheetData* sheet, double count);

KIRI_C_END

#endif
