/* Turns: where the budget has too few systems left for all pieces of a sheet that are awake, some of them are moved in
   a tick, and the others wait: a piece that waits stays where it is, with the velocity that it has, as a whole sheet
   does for which nothing is left. In the next tick the first that waited comes first. What it touched last is
   remembered as for a piece that sleeps. Pieces are independent of each other in a step, so that any of them may go. */
#ifndef KIRI_PIECE_TURN_H
#define KIRI_PIECE_TURN_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* When what is awake is listed, and touches are found: chooses which of it waits. Returns whether any does: then other
   pieces are listed. */
bool kiriPieceTurns_Begin(kiriSheetData* sheet, const kiriSystem* system, const kiriQuota* systems);

/* The pieces that were chosen are moved: who is next? */
void kiriPieceTurns_Take(kiriSheetData* sheet);

/* The tick is over: nobody waits. */
void kiriPieceTurns_End(kiriSheetData* sheet);

KIRI_C_END

#endif
