/* What the files of pairs share: kiri_pair.c (which pieces are near each other), kiri_pair_touch.c (where they touch)
   and kiri_pair_load.c (what they press with). No other file of the library includes it. */
#ifndef KIRI_PAIR_WORK_H
#define KIRI_PAIR_WORK_H

#include "kiri_pair.h"

KIRI_C_BEGIN

/* m: so far apart two bodies stay. */
double kiriPair_Distance(const kiriBody* a, const kiriBody* b);

/* m/s: of the place that is near a probe. */
kiriVec3 kiriNear_PlaceVelocity(const kiriPairs* pairs, const kiriNear* near);

/* From what is near: where the pairs that come in force next touch. False for memory. */
bool kiriPairs_FindTouches(kiriWorld* world, double dt);

KIRI_C_END

#endif
