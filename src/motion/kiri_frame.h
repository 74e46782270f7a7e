/* Control frames: their state (section 5 of the paper). */
#ifndef KIRI_FRAME_H
#define KIRI_FRAME_H

#include "../field/kiri_region.h"
#include "kiri_reaction.h"

KIRI_C_BEGIN

/* What the last step of a frame leaves for the next one, see kiri_stepping.h: how inner forces (of links, pins and
   contacts) moved it. Turns are in world axes: of a rigid frame in u alone, of an affine one by the columns of A. */
typedef struct kiriHistory {
    double dt;         /* s: of that step; 0: there is no history, all is zero */
    int32_t isHalf;    /* the next step may be the second of a pair */
    int32_t isHeld;    /* the host moved the frame in it */
    kiriVec3 gain;     /* q, m/s: the velocity that they gave */
    kiriVec3 lag;      /* p, m: x after the step, less x before it, less dt times the velocity after it */
    kiriVec3 pull;     /* a, m/s^2: the acceleration that they gave at its end */
    kiriMat3 turnGain; /* angular momentum, or rate of the columns, */
    kiriMat3 turnLag;  /* rotation vector, or columns, */
    kiriMat3 turnPull; /* torque, or acceleration of the columns */
} kiriHistory;

/* A frame carries the rest point p to x + A (p - center). The center is the centroid of its region, so x is its
   centre of mass. */
typedef struct kiriFrameData {
    kiriFrame id;
    uint64_t pieceData; /* the host's own, the same in all frames of a piece */
    kiriSite site;
    kiriLatticePoint anchor; /* a point of the material in the site's cell: finds the cell again after a cut */
    kiriVec2 center;         /* local m */
    double area;             /* m^2 */
    int64_t rigidAtStart;    /* kiriShape.rigid in the new sheet, where the host gave the count; else 0 */
    double mass;             /* kg */
    double inertia[3];       /* integrals of density uu, uv, vv about the center, kg m^2 */
    kiriVec3 x;              /* m */
    kiriMat3 A;              /* rotation, but for affine frames */
    kiriVec3 velocity;       /* of x */
    kiriVec3 spin;           /* angular velocity, world */
    kiriMat3 rate;           /* how A changes beside spin x A, 1/s: not at all, but for affine frames */
    kiriVec3 force, torque;  /* from the host, for one tick */
    kiriWrench load;         /* N s, N m s about x: what other pieces pressed with in the last tick, for the next one;
                                N, N m while a tick moves frames */
    kiriVec3 support;        /* where what it lies on pushed it in the last tick: unit, or zero */
    double gained, passed;   /* scratch, J: see kiriSolver_AddGained; a step adds to them */
    kiriVec3 received;       /* the same, N s */
    kiriHistory history;
    int32_t held;          /* the host moves it: */
    kiriVec3 heldPosition; /* of the site at the end of the step, */
    kiriMat3 heldRotation;
    kiriVec3 goalPosition; /* and where the host has it at the end of the tick */
    kiriMat3 goalRotation;
    kiriVec3 heldOff; /* m: see sheet/kiri_follow.h; */
    bool isOffKnown;
    kiriReaction reaction; /* of the hold on the sheet, about the held site */
    kiriWrench bore;       /* its mean in the last tick that moved the sheet; zero where it was free */
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

/* Can the host read it as floats? An eighth of these leaves room for the sums and blends that they are made of. NaN
   does not fit. */
bool kiriFrame_FitsFloats(const kiriFrameData* frame);

/* Stays where it is. */
void kiriFrame_PutToRest(kiriFrameData* frame);

/* What the host gave for a tick is used up. */
void kiriFrame_DropForces(kiriFrameData* frame);

/* Gives the frame the mass and centre of its region; the motion of the material does not change. */
void kiriFrame_Recenter(kiriFrameData* frame, const kiriMoments* material, double densityPerArea);

KIRI_C_END

#endif
