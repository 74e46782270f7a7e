/* The angular momentum of pieces that nothing holds. Backward Euler keeps the linear one exactly, but bleeds the
   angular: a frame that goes round is predicted along the tangent, and is pulled back by forces that act where the step
   ends, not where it starts. */
#ifndef KIRI_MOMENTUM_H
#define KIRI_MOMENTUM_H

#include "kiri_prediction.h"

KIRI_C_BEGIN

/* Of one piece, about its centre of mass; sums while they are gathered. */
typedef struct kiriPieceMomentum {
    int32_t isHeld; /* by pins, contacts or the host: its momentum is not its own */
    double lost;    /* J: the energy that the step has lost */
    double mass;
    kiriVec3 centerBefore, velocityBefore, centerAfter, velocityAfter;
    kiriVec3 due;     /* the angular momentum that it should have after the step, */
    kiriVec3 angular; /* that it has, */
    kiriMat3 inertia; /* and its inertia then */
    kiriVec3 turn;    /* the angular velocity that makes up for the difference */
} kiriPieceMomentum;

/* Turns the pieces that are not held as rigid bodies until they have the angular momentum that they should have, as far
   as their `lost` energy goes. Frames are those before and after the step; piece[f] is the piece of frame f; isHeld and
   lost are set in `pieces`, the rest is scratch. */
void kiriMomentum_Restore(const kiriFrameData* before, kiriFrameData* after, int32_t frameCount, const int32_t* piece,
                          kiriPieceMomentum* pieces, int32_t pieceCount, const kiriMaterial* material, double dt);

KIRI_C_END

#endif
