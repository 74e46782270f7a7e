/* Exact sums: the same whatever the order of adding, and what was added can be taken away again. So the mass of a
   region needs no walk over its cells when one of them changes. */
#ifndef KIRI_TALLY_H
#define KIRI_TALLY_H

#include "kiri_vec.h"

#ifdef __cplusplus
extern "C" {
#endif

/* A share of a scale: high * 2^-60 + low * 2^-122, with 0 <= low < 2^62. So each number has one form only, and a
   sliver of 1e-14 of a square of a grid of 4096 squares keeps the digits of its double. */
typedef struct kiriExact {
    int64_t high, low;
} kiriExact;

/* Moments of material (see kiriMoments); coordinates are at most `extent` (m, local). */
typedef struct kiriTally {
    kiriExact area, u, v, uu, uv, vv;
} kiriTally;

/* The area in a tally, of however many parts, is at most 7 extent^2 at a time. `sign` is 1 or -1. */
void kiriTally_Add(kiriTally* tally, const kiriMoments* moments, int sign, double extent);
kiriMoments kiriTally_Moments(const kiriTally* tally, double extent);

#ifdef __cplusplus
}
#endif

#endif
