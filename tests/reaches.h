/* The cells that a frame reaches, and how far they are from its site and from the border of its region. */
#ifndef REACHES_H
#define REACHES_H

#include "../src/field/kiri_geodesic.h"

typedef struct Reach {
    int32_t cell; /* KIRI_NONE: there are no more */
    int32_t fromSite, fromBorder;
    int32_t block;
} Reach;

static inline Reach Reach_From(const kiriReaches* reaches, int32_t block, int32_t k)
{
    for (; block != KIRI_NONE; block = reaches->blocks.data[block].nextOfFrame, k = 0) {
        const kiriReachBlock* at = &reaches->blocks.data[block];
        for (; k < KIRI_BLOCK_CELLS; ++k) {
            if (at->fromSite[k] != KIRI_FAR) {
                return (Reach){ at->cells * KIRI_BLOCK_CELLS + k, at->fromSite[k], at->fromBorder[k], block };
            }
        }
    }
    return (Reach){ KIRI_NONE, KIRI_FAR, KIRI_FAR, KIRI_NONE };
}

/* In no order. */
static inline Reach Reaches_First(const kiriReaches* reaches, int32_t frame)
{
    return Reach_From(reaches, reaches->ofFrame.data[frame], 0);
}

static inline Reach Reaches_After(const kiriReaches* reaches, Reach reach)
{
    return Reach_From(reaches, reach.block, reach.cell % KIRI_BLOCK_CELLS + 1);
}

#endif
