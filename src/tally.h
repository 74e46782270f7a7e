/* Exact sums: the same whatever the order of adding, and what was added can be taken away again. So the mass of a region
   needs no walk over its cells when one of them changes. */
#ifndef KIRI_TALLY_H
#define KIRI_TALLY_H

#include "vec.h"

/* A number in units of 2^-98 of a scale: value = (high * 2^38 + low) units. */
typedef struct kiriExact {
    int64_t high, low;
} kiriExact;

/* Moments of material (see kiriMoments); coordinates are at most `extent` (m, local) and areas at most its square. */
typedef struct kiriTally {
    kiriExact area, u, v, uu, uv, vv;
} kiriTally;

/* Up to 2^24 cells may be in a tally at a time. `sign` is 1 or -1. */
void kiriTally_Add(kiriTally* tally, const kiriMoments* moments, int sign, double extent);
kiriMoments kiriTally_Moments(const kiriTally* tally, double extent);

#endif
