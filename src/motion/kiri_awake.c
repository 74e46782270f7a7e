#include "kiri_awake.h"

#include <string.h>

void kiriAwake_Start(kiriAwake* awake, int32_t pieceCount)
{
    KIRI_ASSERT(pieceCount <= awake->isAwake.capacity);
    if (pieceCount > 0) {
        memset(awake->isAwake.data, 1, (size_t)pieceCount);
    }
    awake->isAwake.count = pieceCount;
    awake->isListed = false;
    awake->wakes += 1;
}

void kiriAwake_Set(kiriAwake* awake, int32_t piece, bool isAwake)
{
    KIRI_ASSERT(piece >= 0 && piece < awake->isAwake.count);
    awake->isListed = awake->isListed && awake->isAwake.data[piece] == isAwake;
    awake->wakes += isAwake && !awake->isAwake.data[piece];
    awake->isAwake.data[piece] = isAwake;
}
