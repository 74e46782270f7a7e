/* Pairs: pieces, of one sheet or of two, that are near each other, and which of them lies on which side of the other.

   A pair keeps its side for as long as the two are near: the upper piece stays on that side of the lower one, whose
   triangles have a side by their order in the rest plane. A side for each point would never come to rest where pieces
   have crossed: some points push one way, others the other way. The upper one is that against gravity, so that what
   lies on a floor is not pushed into it: planes carry it, and what it presses with becomes a load on the lower one. */
#ifndef KIRI_PAIR_H
#define KIRI_PAIR_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Finds the pairs of the coming tick, and what touches, by the surfaces as they are seen. Only sheets that have
   touchesSheets take part, and no planar ones: these lie in one plane. Nothing that is in force changes. False for
   memory. */
bool kiriPairs_Find(kiriWorld* world, double dt);

/* Stirs pieces that sleep and touch something awake, or lay on a gone piece. Returns whether any are stirred. */
bool kiriPairs_Stir(const kiriWorld* world);

/* Puts the new pairs in force. */
void kiriPairs_Commit(kiriWorld* world);

/* Adds planes of lower pieces to the sheets of upper pieces. Skips sheets that are not active: these do not move. Call
   it between kiriTouches_Begin and kiriTouches_Reserve. False for memory. */
bool kiriPairs_AddTouches(kiriWorld* world, double dt);

/* What the upper ones pressed with in the last tick acts on the lower ones in this one; and what they press with now is
   kept for the next. Before and after all sheets are moved. */
void kiriPairs_ApplyLoads(kiriWorld* world, double dt);
void kiriPairs_TakeLoads(kiriWorld* world, double dt);

/* After the sheets are moved: pieces that touch get no more energy from each other than they give each other. Before
   kiriPairs_TakeLoads. */
void kiriPairs_LimitEnergy(kiriWorld* world);

/* After these: pieces that touch are as calm as the least calm of them, so that they fall asleep together. */
void kiriPairs_JoinCalm(kiriWorld* world);

/* Pairs that are in force and do not sleep. */
int32_t kiriPairs_CountAwake(const kiriWorld* world);

/* Shared by the files of pairs: kiri_pair.c (which pieces are near each other), kiri_pair.c (where they touch),
   kiri_pair.c (loads) and kiri_pair.c (energy and calm of pieces that touch). No other file of the library
   includes it. */

static inline bool kiriPair_TakesPart(const kiriSheetData* sheet)
{
    return sheet->settings.touchesSheets && !sheet->settings.mechanics.planar;
}

/* The piece of a body, where it is there still; else null. */
kiriPiece* kiriPair_PieceOf(const kiriWorld* world, kiriFrame id);

/* m: so far apart two bodies stay. */
double kiriPair_Distance(const kiriBody* a, const kiriBody* b);

/* m/s: of the place that is near a probe. */
kiriVec3 kiriNear_PlaceVelocity(const kiriPairs* pairs, const kiriNear* near);

/* From what is near: where the pairs that come in force next touch. False for memory. */
bool kiriPairs_FindTouches(kiriWorld* world, double dt);

/* Makes room for the islands of the current tick. Call it when all sheets that may be active are listed. False for
   memory. */
bool kiriPairs_ReserveIslands(kiriWorld* world);

KIRI_C_END

#endif
