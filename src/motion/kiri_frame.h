/* Control frames: their state (section 5 of the paper). */
#ifndef KIRI_FRAME_H
#define KIRI_FRAME_H

#include "../field/kiri_region.h"

KIRI_C_BEGIN

/* A frame carries the rest point p to x + A (p - center). The center is the centroid of its region, so x is its
   centre of mass. */
typedef struct kiriFrameData {
    kiriFrame id;
    kiriSite site;
    kiriLatticePoint anchor; /* a point of the material in the site's cell: finds the cell again after a cut */
    kiriVec2 center;         /* local m */
    double area;             /* m^2 */
    double mass;             /* kg */
    double inertia[3];       /* integrals of density uu, uv, vv about the center, kg m^2 */
    kiriVec3 x;              /* m */
    kiriMat3 A;              /* rotation, but for affine frames */
    kiriVec3 velocity;       /* of x */
    kiriVec3 spin;           /* angular velocity, world */
    kiriMat3 rate;           /* how A changes beside spin x A, 1/s: not at all, but for affine frames */
    kiriVec3 force, torque;  /* from the host, for one tick */
    int32_t held;            /* the host moves it: */
    kiriVec3 heldPosition;   /* of the site, */
    kiriMat3 heldRotation;
} kiriFrameData;

static inline kiriVec3 kiriFrame_Carry(const kiriFrameData* frame, kiriVec2 p)
{
    return kiriVec3_AddScaled(kiriVec3_AddScaled(frame->x, p.x - frame->center.x, frame->A.u), p.y - frame->center.y,
                              frame->A.v);
}

/* How A changes, 1/s. */
static inline kiriMat3 kiriFrame_Rate(const kiriFrameData* frame)
{
    kiriMat3 r = { kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.u), frame->rate.u),
                   kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.v), frame->rate.v),
                   kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.d), frame->rate.d) };
    return r;
}

/* The velocity of the rest point p. */
static inline kiriVec3 kiriFrame_VelocityAt(const kiriFrameData* frame, kiriVec2 p)
{
    kiriVec3 arm = kiriVec3_Sub(kiriFrame_Carry(frame, p), frame->x);
    kiriVec3 velocity = kiriVec3_Add(frame->velocity, kiriVec3_Cross(frame->spin, arm));
    velocity = kiriVec3_AddScaled(velocity, p.x - frame->center.x, frame->rate.u);
    return kiriVec3_AddScaled(velocity, p.y - frame->center.y, frame->rate.v);
}

/* Gives the frame the mass and centre of its region; the motion of the material does not change. */
void kiriFrame_Recenter(kiriFrameData* frame, const kiriMoments* material, double densityPerArea);

KIRI_C_END

#endif
