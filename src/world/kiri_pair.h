/* Pairs: pieces, of one sheet or of two, that are near each other, and their contacts.

   Two pieces that do not fold stay on one side of each other. Else each probe stays on its side of the layers near it. Where
   surfaces have crossed, the line in which they cross is made shorter until it is gone. */
#ifndef KIRI_PAIR_H
#define KIRI_PAIR_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Finds the pairs and touches of the coming tick, by the visible surfaces. Only sheets with touchesSheets take part,
   but not planar sheets, which all lie in one plane. Changes nothing committed. Fails on out of memory. */
bool kiriPairs_Find(kiriWorld* world, double dt);

/* Stirs pieces that sleep and touch something awake, or lay on a removed piece. Returns true if any are stirred. */
bool kiriPairs_Stir(const kiriWorld* world);

/* Replaces the pairs by the new ones. */
void kiriPairs_Commit(kiriWorld* world);

/* Adds contacts to the sheets of upper places. Skips sheets that are not active, because they do not move. Call it
   between kiriTouches_Begin and kiriTouches_Reserve. Fails on out of memory. */
bool kiriPairs_AddTouches(kiriWorld* world);

/* Gives touching pieces the calm of the least calm of them, so that they fall asleep together. Call it last. */
void kiriPairs_JoinCalm(kiriWorld* world);

/* Returns the number of pairs that are awake. */
int32_t kiriPairs_CountAwake(const kiriWorld* world);

KIRI_C_END

#endif
