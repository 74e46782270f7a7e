/* What of a system is awake: steps move its pieces and nothing else. A piece that sleeps, or that is gone, is in none
   of the lists, and costs nothing. */
#ifndef KIRI_AWAKE_H
#define KIRI_AWAKE_H

#include "../core/kiri_array.h"

KIRI_C_BEGIN

typedef struct kiriAwake {
    KIRI_ARRAY(uint8_t) isAwake;          /* of each piece */
    bool isListed;                        /* are the lists of these? */
    kiriIndices pieces, frames, elements; /* ascending */
    int64_t lists, wakes;                 /* how often lists were made, and pieces woken */
} kiriAwake;

/* The loop over a list: `index` is each of its items. */
#define KIRI_EACH(index, list)                                                                                         \
    for (int32_t index##At = 0, index = 0; index##At < (list).count && (index = (list).data[index##At], true);         \
         ++index##At)

/* Other pieces: all of them are awake, and nothing is listed. There is room. */
void kiriAwake_Start(kiriAwake* awake, int32_t pieceCount);

void kiriAwake_Set(kiriAwake* awake, int32_t piece, bool isAwake);

KIRI_C_END

#endif
