/* Pairs: pieces, of one sheet or of two, that are near each other, and the side of the lower piece on which the upper
   piece lies.

   A pair keeps its side as long as the two are near: the upper piece stays on that side of the lower one. Triangles
   have sides by the order of their corners in the rest plane. If each point had a separate side, pieces that have
   crossed would never come to rest: some points push one way, others the other way. Gravity decides which piece is called
   the upper one. */
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

/* Adds contacts to the sheets of upper pieces. Skips sheets that are not active, because they do not move. Call it
   between kiriTouches_Begin and kiriTouches_Reserve. Fails on out of memory. */
bool kiriPairs_AddTouches(kiriWorld* world);

/* Gives touching pieces the calm of the least calm of them, so that they fall asleep together. Call it last. */
void kiriPairs_JoinCalm(kiriWorld* world);

/* Returns the number of pairs that are awake. */
int32_t kiriPairs_CountAwake(const kiriWorld* world);

KIRI_C_END

#endif
