/* The pieces that links make of frames, found in the plainest way. */
#ifndef KIRI_TEST_PIECES_H
#define KIRI_TEST_PIECES_H

#include "field/kiri_link.h"

/* Writes the piece of each frame, numbered by lowest frame, and returns how many there are. */
static inline int32_t FindPieces(const kiriLink* links, int32_t linkCount, int32_t frameCount, int32_t* framePiece)
{
    bool changed = true;
    int32_t count = 0;
    for (int32_t f = 0; f < frameCount; ++f) {
        framePiece[f] = f;
    }
    while (changed) {
        changed = false;
        for (int32_t k = 0; k < linkCount; ++k) {
            int32_t *a = &framePiece[links[k].i], *b = &framePiece[links[k].j], lower = *a < *b ? *a : *b;
            changed = changed || *a != *b;
            *a = *b = lower;
        }
    }
    for (int32_t f = 0; f < frameCount; ++f) {
        framePiece[f] = framePiece[f] == f ? count++ : framePiece[framePiece[f]];
    }
    return count;
}

#endif
