/* The patches that frames carry: flat ones, or bent as their neighbours tell. */
#ifndef KIRI_CARRIER_H
#define KIRI_CARRIER_H

#include "../field/kiri_link.h"
#include "../motion/kiri_frame.h"

KIRI_C_BEGIN

/* The patch that a frame carries: the rest point p goes to x + a u + b v + c d. In a flat patch (a, b) is q = p -
   center and c is 0; a bent one follows the arc that its curvature gives, see kiri_carrier.c. */
typedef struct kiriCarrier {
    kiriVec3 u, v, d, x;
    kiriVec2 center;
    double uu, uv, vv, six; /* curvature K, 1/m; 6 for a rigid frame */
} kiriCarrier;

/* What a frame's neighbours tell about its curvature: normal equations. */
typedef struct kiriBend {
    double uu, uv, vv;    /* sums of W s s */
    double ruu, ruv, rvv; /* and of W s t, t being how the director turns over s */
} kiriBend;

/* Flat patches; `count` frames have one each. Here and below only `some` of them are written, unless that is null. */
void kiriCarriers_Write(kiriCarrier* carriers, const kiriFrameData* frames, int32_t count, const kiriIndices* some);

/* Bends them as the links tell: all, or those of `someLinks`, ascending, that are below linkCount. `bends` is scratch,
   one a frame. */
void kiriCarriers_Bend(kiriCarrier* carriers, kiriBend* bends, const kiriFrameData* frames, int32_t count,
                       const kiriLink* links, int32_t linkCount, const kiriIndices* some, const kiriIndices* someLinks);

KIRI_C_END

#endif
