/* The nearest place of a piece to a point. */
#ifndef KIRI_NEAREST_H
#define KIRI_NEAREST_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Finds the place of the other body nearest to the probe, whose vertex and bodies are set. False where there is none
   within `reach`, or where it is the border of the other body and the probe lies beside it rather than above it or
   below. Of places equally near that of the lower triangle is taken. `distance` is what the two keep; the bounds of the
   other one are fresh. */
bool kiriNearest_Find(kiriNear* near, const kiriBody* bodies, double reach, double distance);

KIRI_C_END

#endif
