/* Reactions: what holds the sheet has to bear. */
#ifndef KIRI_FRAME_H
#define KIRI_FRAME_H

#include "../core/kiri_vec.h"
#include "../core/kiri_array.h"
#include "../field/kiri_region.h"

KIRI_C_BEGIN

/* A force, N, with its moment about a point, N m; or an impulse, N s, with its own, N m s. */
typedef struct kiriWrench {
    kiriVec3 force, moment;
} kiriWrench;

/* With what a pin, a clamp or a held frame acts on the sheet, about where it holds it. */
typedef struct kiriReaction {
    kiriWrench impulse; /* since the start of the tick */
    kiriWrench gain;    /* impulse of the last step, */
    kiriWrench pull;    /* and force at its end: the history of kiri_frame.h, for forces one by one */
    kiriWrench now;     /* force at the end of the step at hand */
} kiriReaction;

/* One for each pin row, clamp row and frame of a system; each may be null. Those of free frames stay zero. */
typedef struct kiriReactions {
    kiriReaction *pins, *clamps, *frames;
} kiriReactions;

static inline void kiriWrench_Add(kiriWrench* sum, double scale, const kiriWrench* wrench)
{
    sum->force = kiriVec3_AddScaled(sum->force, scale, wrench->force);
    sum->moment = kiriVec3_AddScaled(sum->moment, scale, wrench->moment);
}

/* Control frames: their state (section 5 of the paper). */

/* What the last step of a frame leaves for the next one, see kiri_frame.h: how inner forces (of links, pins and
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
    kiriVec3 heldOff; /* m: see sheet/kiri_pin.h; */
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

/* Schemes of time stepping. Each step solves for the poses of the frames at its end,

       minimise  1/2 m |x - x*|^2 / h'^2 + V(x),

   and the schemes differ in four numbers only. With v, x before the step, h its length, e = gravity + force / m, and
   the history that the last step left (kiriHistory: q the velocity that inner forces gave in it, p = x+ - x - h v+, and
   a the inner acceleration at its end):

       v* = v + h e + c q + l a                   D  = (x - x*) / h'
       x* = x + h v + d p + h' (v* - v)           v+ = v* + D
                                                  q+ = c q + l a + D,  p+ = d p - (h - h') (v+ - v),  a+ = D / h'

       backward Euler   h' = h                    c = 0                  l = 0       d = 0
       trapezoid        h' = h / 2                c = 0                  l = h / 2   d = 0
       BDF2             h' = h (1 + r)/(1 + 2 r)  c = r^2 / (1 + 2 r)    l = 0       d = c      r = h / last h

   Second order in time: trapezoid and BDF2 by turns, so a pair is a step of TR-BDF2 (Bank et al. 1985; Hosea and
   Shampine 1996) whose halves are of one length. Backward Euler starts it, and takes its place where the past says
   nothing of the step: see ChooseSteppings in kiri_step.c. Its next step may be the second of a pair.

   Turns, with Q, P and T for q, p and a. Affine frames: the same, by the columns of A, beside their free turn. Rigid
   frames: Q is angular momentum, T torque, P a rotation vector, in world axes; I is the inertia at the end, w the spin.

       A* = Cayley(d P) (free turn of A over h with L)       A' = A* + h' I^-1 (c Q + l T + h torque) x A*
       minimise  1/2 m |A r - A' r|^2 / h'^2 + V             G, G' = sum of m (A* r, A' r) x (A r) / h'
       L+ = L + G,  w+ = I^-1 L+,  Q+ = c Q + l T + G',  P+ = d P - (h - h') I^-1 (L+ - L),  T+ = G' / h' */

typedef struct kiriStepping {
    double h;       /* s: the step */
    double part;    /* h': that of it over which inner forces act on the end */
    double c, l, d; /* shares of q, a (s) and p */
    double ahead;   /* r^2: of p, for where the iteration starts */
    bool isEuler;
    bool isHalf; /* the next may be the second of a pair */
} kiriStepping;

kiriStepping kiriStepping_Euler(double h);

/* The step that comes after this history, of frames that have one. */
kiriStepping kiriStepping_After(const kiriHistory* history, double h);

/* c q + l a, and the same of the turn. */
kiriVec3 kiriStepping_Inner(const kiriStepping* stepping, const kiriHistory* history);
kiriMat3 kiriStepping_InnerTurn(const kiriStepping* stepping, const kiriHistory* history);

/* A frame by itself: its mass, and the free prediction: how it moves over a step when no element, pin or contact acts
   on it. */

typedef struct kiriPose {
    kiriVec3 x;
    kiriMat3 A;
} kiriPose;

/* Second moments of the mass in the frame's own axes, kg m^2. */
typedef struct kiriMassMoments {
    double uu, uv, vv, dd;
} kiriMassMoments;

typedef struct kiriPrediction {
    kiriMassMoments moments;
    kiriPose pose; /* at the end of the step: x*, A* */
    kiriVec3 velocity, spin;
    kiriVec3 angular; /* momentum of a rigid frame about x */
    kiriMat3 rate;    /* of A, all of it; of affine frames only */
    kiriMat3 carried; /* the rate without what the scheme takes from the history */
    kiriVec3 shift;   /* of pose.x for the sake of the centre of mass of a free piece */
    kiriMat3 target;  /* pose.A, shifted by the host's torque: no rotation */
    kiriPose guess;   /* where the iteration starts */
} kiriPrediction;

static inline kiriPose kiriPose_Of(const kiriFrameData* frame)
{
    kiriPose pose = { frame->x, frame->A };
    return pose;
}

/* A vector of the rest plane in space. */
static inline kiriVec3 kiriPose_Along(const kiriPose* pose, kiriVec2 a)
{
    return kiriVec3_AddScaled(kiriVec3_Scale(a.x, pose->A.u), a.y, pose->A.v);
}

/* The prediction of a free frame under gravity, its own force, and what the scheme takes from its history. The
   iteration starts without forces, or with those of the last step. The host's torque shifts the target alone, by
   h' h I^-1 torque x A: in the objective that is a torque, whatever its size. Were it part of the free turn, the target
   would go round where h^2 torque / I exceeds a turn. */
kiriPrediction kiriPrediction_Free(const kiriFrameData* frame, const kiriMaterial* material, kiriVec3 gravity,
                                   const kiriStepping* stepping);

/* The same of an affine frame, which turns by its spin and goes on stretching. */
kiriPrediction kiriPrediction_Affine(const kiriFrameData* frame, const kiriMaterial* material, kiriVec3 gravity,
                                     const kiriStepping* stepping);

/* A after a change of `change`: the part of it that turns A does so as a rotation, and leaves lengths as they are. */
kiriMat3 kiriMat3_Advance(const kiriMat3* A, const kiriMat3* change);

/* The spin that comes nearest to the rate at which A changes, and what is left of the rate without it. */
kiriVec3 kiriMat3_Spin(const kiriMat3* A, const kiriMat3* rate);
kiriMat3 kiriMat3_Beside(const kiriMat3* A, const kiriMat3* rate, kiriVec3 spin);

/* The prediction of a frame that the host moves: its motion is known. */
kiriPrediction kiriPrediction_Held(const kiriFrameData* frame, const kiriMaterial* material, double dt);

/* Second moments of mass. The thickness keeps those of a sliver above zero. */
kiriMassMoments kiriFrame_MassMoments(const kiriFrameData* frame, const kiriMaterial* material);

/* Kinetic energy, J, and angular momentum about the centre of mass, rigid or not; and by how much the latter grows with
   the spin, symmetric, in space. */
double kiriFrame_KineticEnergy(const kiriFrameData* frame, const kiriMaterial* material);
kiriVec3 kiriFrame_AngularMomentum(const kiriFrameData* frame, const kiriMaterial* material);
kiriMat3 kiriFrame_Inertia(const kiriFrameData* frame, const kiriMaterial* material);

/* The inertia tensor of a rigid frame, symmetric, in space. */
kiriMat3 kiriPrediction_Inertia(const kiriPrediction* prediction, const kiriMat3* A);

/* Sum over the region's mass points p of m |A p - A* p|^2, with A* the target. */
double kiriPrediction_TurnSquared(const kiriPrediction* prediction, const kiriMat3* A);

/* Half its gradient by the columns of A. */
kiriMat3 kiriPrediction_Gradient(const kiriPrediction* prediction, const kiriMat3* A);

/* Half its gradient by turning A: a turning impulse, times h'. With pose.A for A* the torque is part of it. */
kiriVec3 kiriPrediction_TurnGradient(const kiriPrediction* prediction, const kiriMat3* A, const kiriMat3* target);

/* m^-1 a, for an m that has an inverse; and m (r^2 - r r^T), the inertia of a mass at r. */
kiriVec3 kiriMat3_Solve(const kiriMat3* m, kiriVec3 a);
kiriMat3 kiriMat3_PointInertia(double m, kiriVec3 r);

/* The angular momentum of a body that nothing holds. The steps keep the linear one exactly, but not the angular: a
   frame that goes round is predicted along the tangent, and is pulled back by forces that act where the step ends, not
   where it starts. */

/* Over the frames that the host does not hold, about their centre of mass. */
typedef struct kiriPieceMomentum {
    bool isFree;       /* from pins, contacts and the host: its momentum is its own */
    bool isPushed;     /* free but for contacts, */
    kiriWrench pushed; /* N s: the impulse of these in the step, about the origin */
    double mass;
    kiriVec3 centerBefore, velocityBefore, centerAfter, velocityAfter;
    kiriVec3 due;       /* the angular momentum that it should have after the step, */
    kiriVec3 angular;   /* that it has, */
    kiriMat3 inertia;   /* and its inertia then */
    kiriVec3 dueLinear; /* the linear momentum that it should have */
    kiriVec3 move;      /* the velocity that makes up for the difference of linear momenta, */
    kiriVec3 turn;      /* and the angular velocity for that of angular momenta */
    kiriVec3 spin;      /* of the rigid body that has its momenta */
} kiriPieceMomentum;

/* Turns a free body as a rigid one until it has the angular momentum that it should have; a body on which contacts
   alone act gets the whole momentum that these gave. Frames are those before and after the step. isFree, isPushed and
   pushed are set in `momentum`, the rest is zero, and written. `normal` is that of the plane of a planar sheet, else
   null. */
void kiriMomentum_Restore(const kiriFrameData* before, kiriFrameData* after, int32_t count, kiriPieceMomentum* momentum,
                          const kiriMaterial* material, kiriVec3 gravity, double dt, const kiriVec3* normal);

KIRI_C_END

#endif
