/* Shared by the files of pairs: kiri_pair.c (which pieces are near each other), kiri_pair_touch.c (where they touch),
   kiri_pair_load.c (loads) and kiri_pair_island.c (energy and calm of pieces that touch). No other file of the library
   includes it. */
#ifndef KIRI_PAIR_WORK_H
#define KIRI_PAIR_WORK_H

#include "kiri_pair.h"

KIRI_C_BEGIN

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
