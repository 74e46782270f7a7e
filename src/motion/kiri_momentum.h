/* The angular momentum of pieces that nothing holds. The steps keep the linear one exactly, but not the angular: a
   frame that goes round is predicted along the tangent, and is pulled back by forces that act where the step ends, not
   where it starts. */
#ifndef KIRI_MOMENTUM_H
#define KIRI_MOMENTUM_H

#include "kiri_awake.h"
#include "kiri_prediction.h"

KIRI_C_BEGIN

/* Of one piece, over the frames that the host does not hold, about its centre of mass; sums while they are gathered. */
typedef struct kiriPieceMomentum {
    bool isFree;       /* from pins, contacts and the host: its momentum is its own */
    bool isPushed;     /* but for contacts, */
    kiriWrench pushed; /* N s: what these gave to it in the step, about the origin */
    double mass;
    kiriVec3 centerBefore, velocityBefore, centerAfter, velocityAfter;
    kiriVec3 due;       /* the angular momentum that it should have after the step, */
    kiriVec3 angular;   /* that it has, */
    kiriMat3 inertia;   /* and its inertia then */
    kiriVec3 dueLinear; /* and the linear one */
    kiriVec3 move;      /* the velocity that makes up for the difference of that, */
    kiriVec3 turn;      /* and the angular velocity that makes up for the difference */
    kiriVec3 spin;      /* of the rigid body that has its momenta */
} kiriPieceMomentum;

/* Turns free pieces as rigid bodies until they have the angular momentum that they should have; pieces on which
   contacts alone act get the whole momentum that these gave; of what is awake. Frames are those before
   and after the step; piece[f] is the piece of frame f; isFree, isPushed and pushed are set in `pieces`, the
   rest is zero, and written. In a planar
   sheet `normal` is that of its plane; else null. */
void kiriMomentum_Restore(const kiriFrameData* before, kiriFrameData* after, const kiriAwake* awake,
                          const int32_t* piece, kiriPieceMomentum* pieces, const kiriMaterial* material,
                          kiriVec3 gravity, double dt, const kiriVec3* normal);

KIRI_C_END

#endif
