/* Reactions: forces and moments of pins, clamps and held frames on the sheet. Control frames. Time stepping. */
#ifndef KIRI_FRAME_H
#define KIRI_FRAME_H

#include "../core/kiri_vec.h"
#include "../core/kiri_array.h"
#include "../field/kiri_region.h"

KIRI_C_BEGIN

/* A force, N, with its moment about a point, N m; or an impulse, N s, with its moment, N m s. */
typedef struct kiriWrench {
    kiriVec3 force, moment;
} kiriWrench;

/* Action of a pin, a clamp or a held frame on the sheet, about the point where it holds the sheet. */
typedef struct kiriReaction {
    kiriWrench impulse; /* since the start of the tick */
    kiriWrench gain;    /* impulse of the last step */
    kiriWrench pull;    /* force at the end of the last step; history of this reaction, as in kiriHistory */
    kiriWrench solved, now; /* force in the current step: of the last system, and of the systems so far */
    kiriVec3 offset;    /* m; spring: of its target, see kiriPins_Keep */
} kiriReaction;

static inline void kiriWrench_Add(kiriWrench* sum, double scale, const kiriWrench* wrench)
{
    sum->force = kiriVec3_AddScaled(sum->force, scale, wrench->force);
    sum->moment = kiriVec3_AddScaled(sum->moment, scale, wrench->moment);
}

static inline void kiriWrench_Store(const kiriWrench* wrench, double force[3], double moment[3])
{
    kiriVec3_StoreDoubles(force, wrench->force);
    kiriVec3_StoreDoubles(moment, wrench->moment);
}

/* State of control frames (section 5 of the paper). */

/* Motion of a frame by inner forces (links, pins, contacts) in its last step, input for the scheme of the next step.
   Turns are in world axes: for a rigid frame only the column u is used, for an affine frame each column of A has its
   own. */
typedef struct kiriHistory {
    double dt;         /* s: length of the last step; 0: no history, all other fields are zero */
    double credit;     /* J: share of the energy that the body lost and may get back */
    int32_t isHalf;    /* the next step may be the second of a pair */
    int32_t isHeld;    /* the host moved the frame in the last step */
    kiriVec3 gain;     /* q, m/s: velocity gained from inner forces */
    kiriVec3 lag;      /* p, m: x after the step - x before it - dt velocity after it */
    kiriVec3 pull;     /* a, m/s^2: acceleration by inner forces at the end of the step */
    kiriMat3 turnGain; /* Q: angular momentum; affine: rate of the columns */
    kiriMat3 turnLag;  /* P: rotation vector; affine: columns */
    kiriMat3 turnPull; /* T: torque; affine: acceleration of the columns */
} kiriHistory;

typedef struct kiriPose {
    kiriVec3 x;
    kiriMat3 A;
} kiriPose;

/* A control frame. It maps the rest point p to x + A (p - center). The center is the centroid of the region, so x is
   the centre of mass. */
typedef struct kiriFrameData {
    kiriFrame id;
    uint64_t pieceData; /* set by the host, equal in all frames of a piece */
    kiriSite site;
    kiriLatticePoint anchor; /* a material point in the site's cell, used to find the cell after a cut */
    kiriVec2 center;         /* local m */
    double area;             /* m^2 */
    int64_t rigidAtStart;    /* kiriShape.rigid in the new sheet if the host gave the count; else 0 */
    double mass;             /* kg */
    double inertia[3];       /* integrals of density uu, uv, vv about the center, kg m^2 */
    kiriVec3 x;              /* m */
    kiriMat3 A;              /* a rotation; affine frames: any matrix */
    kiriVec3 velocity;       /* of x */
    kiriVec3 spin;           /* angular velocity, world */
    kiriMat3 rate;           /* derivative of A without spin x A, 1/s; zero for rigid frames */
    kiriPose last;           /* at the end of the last tick that moved it */
    kiriVec3 force, torque;  /* from the host, for one tick */
    kiriHistory history;
    int32_t held;          /* the host moves the frame */
    kiriVec3 heldPosition; /* position of the site at the end of the step */
    kiriMat3 heldRotation; /* rotation at the end of the step */
    kiriVec3 goalPosition; /* the host's position for the end of the tick */
    kiriMat3 goalRotation; /* the host's rotation for the end of the tick */
    kiriReaction reaction; /* action of the hold on the sheet, about the held site */
    kiriWrench bore;       /* mean of the reaction in the last tick that moved the sheet; zero if the frame was free */
} kiriFrameData;

static inline kiriVec3 kiriFrame_Carry(const kiriFrameData* frame, kiriVec2 p)
{
    return kiriVec3_AddScaled(kiriVec3_AddScaled(frame->x, p.x - frame->center.x, frame->A.u), p.y - frame->center.y,
                              frame->A.v);
}

/* Returns the derivative of A, 1/s. */
static inline kiriMat3 kiriFrame_Rate(const kiriFrameData* frame)
{
    kiriMat3 r = { kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.u), frame->rate.u),
                   kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.v), frame->rate.v),
                   kiriVec3_Add(kiriVec3_Cross(frame->spin, frame->A.d), frame->rate.d) };
    return r;
}

/* Returns the velocity of the rest point p. */
static inline kiriVec3 kiriFrame_VelocityAt(const kiriFrameData* frame, kiriVec2 p)
{
    kiriVec3 arm = kiriVec3_Sub(kiriFrame_Carry(frame, p), frame->x);
    kiriVec3 velocity = kiriVec3_Add(frame->velocity, kiriVec3_Cross(frame->spin, arm));
    velocity = kiriVec3_AddScaled(velocity, p.x - frame->center.x, frame->rate.u);
    return kiriVec3_AddScaled(velocity, p.y - frame->center.y, frame->rate.v);
}

/* Returns true if the host can read the frame as floats. The limit is an eighth of the largest float, which leaves room
   for sums and blends of frames. NaN does not fit. */
bool kiriFrame_FitsFloats(const kiriFrameData* frame);

/* Clears the velocities and the history. */
void kiriFrame_PutToRest(kiriFrameData* frame);

/* Clears the forces that the host set for one tick. */
void kiriFrame_DropForces(kiriFrameData* frame);

/* Sets the mass and the center to the values of the region. The motion of the material does not change. */
void kiriFrame_Recenter(kiriFrameData* frame, const kiriMoments* material, double densityPerArea);

/* Schemes of time stepping. Each step solves for the poses of the frames at its end,

       minimise  1/2 m |x - x*|^2 / h'^2 + V(x),

   and the schemes differ in four numbers only. v and x are values before the step, h is its length, and
   e = gravity + force / m. The last step left the history (kiriHistory): q, the velocity gained from inner forces,
   p = x+ - x - h v+, and a, the inner acceleration at its end:

       v* = v + h e + c q + l a                   D  = (x - x*) / h'
       x* = x + h v + d p + h' (v* - v)           v+ = v* + D
                                                  q+ = c q + l a + D,  p+ = d p - (h - h') (v+ - v),  a+ = D / h'

       backward Euler   h' = h                    c = 0                  l = 0       d = 0
       trapezoid        h' = h / 2                c = 0                  l = h / 2   d = 0
       BDF2             h' = h (1 + r)/(1 + 2 r)  c = r^2 / (1 + 2 r)    l = 0       d = c      r = h / last h

   Second order in time: trapezoid and BDF2 alternate, so a pair is a step of TR-BDF2 (Bank et al. 1985; Hosea and
   Shampine 1996) whose halves have equal lengths. The first step is backward Euler, and so is every step for which the
   history does not predict the motion: see ChooseSteppings in kiri_step.c. The next step may be the second of a pair.

   For turns, Q, P and T stand for q, p and a. Affine frames use the same formulas for the columns of A, in addition to
   their free turn. For rigid frames, Q is angular momentum, T torque, P a rotation vector, in world axes; I is the
   inertia at the end, w the spin.

       A* = Cayley(d P) (free turn of A over h with L)       A' = A* + h' I^-1 (c Q + l T + h torque) x A*
       minimise  1/2 m |A r - A' r|^2 / h'^2 + V             G, G' = sum of m (A* r, A' r) x (A r) / h'
       L+ = L + G,  w+ = I^-1 L+,  Q+ = c Q + l T + G',  P+ = d P - (h - h') I^-1 (L+ - L),  T+ = G' / h' */

typedef struct kiriStepping {
    double h;       /* s: the step */
    double part;    /* h', s: the part of the step over which inner forces act on its end */
    double c, l, d; /* factors of q, a (s) and p */
    double ahead;   /* r^2: factor of p where the iteration starts */
    bool isEuler;
    bool isHalf; /* the next step may be the second of a pair */
} kiriStepping;

kiriStepping kiriStepping_Euler(double h);

/* Returns the scheme of the next step. The history must not be empty. */
kiriStepping kiriStepping_After(const kiriHistory* history, double h);

/* Return c q + l a, and c Q + l T. */
kiriVec3 kiriStepping_Inner(const kiriStepping* stepping, const kiriHistory* history);
kiriMat3 kiriStepping_InnerTurn(const kiriStepping* stepping, const kiriHistory* history);

/* A single frame: its mass, and its free prediction, the motion over a step without elements, pins and contacts. */

/* Second moments of the mass in the frame's own axes, kg m^2. */
typedef struct kiriMassMoments {
    double uu, uv, vv, dd;
} kiriMassMoments;

typedef struct kiriPrediction {
    kiriMassMoments moments;
    kiriPose pose; /* at the end of the step: x*, A* */
    kiriVec3 velocity, spin;
    kiriVec3 angular; /* angular momentum of a rigid frame about x */
    kiriMat3 rate;    /* derivative of A including the spin; affine frames only */
    kiriMat3 carried; /* rate without the terms of the history */
    kiriVec3 shift;   /* m: correction of pose.x that keeps the centre of mass of a free piece exact */
    kiriMat3 target;  /* pose.A, shifted by the host's torque; not a rotation */
    kiriPose guess;   /* where the iteration starts */
} kiriPrediction;

static inline kiriPose kiriPose_Of(const kiriFrameData* frame)
{
    kiriPose pose = { frame->x, frame->A };
    return pose;
}

/* Returns the world vector of a vector in the rest plane. */
static inline kiriVec3 kiriPose_Along(const kiriPose* pose, kiriVec2 a)
{
    return kiriVec3_AddScaled(kiriVec3_Scale(a.x, pose->A.u), a.y, pose->A.v);
}

/* Predicts a free frame under gravity, its own force, and the terms of its history. The iteration starts without inner
   forces, or with the inner forces of the last step. The host's torque shifts only the target, by h' h I^-1 torque x A:
   in the objective this is a torque, however large. As part of the free turn, it would rotate the target by more than a
   turn if h^2 torque / I exceeds 2 pi. An affine frame turns by its spin and continues to stretch. */
kiriPrediction kiriPrediction_Free(const kiriFrameData* frame, const kiriMaterial* material, kiriVec3 gravity,
                                   const kiriStepping* stepping, bool isAffine);

/* Returns A + change, except that the turning part of the change is applied as a rotation, which keeps lengths. */
kiriMat3 kiriMat3_Advance(const kiriMat3* A, const kiriMat3* change);

/* Spin returns the angular velocity that fits the rate of A best; Beside returns the rate minus spin x A. */
kiriVec3 kiriMat3_Spin(const kiriMat3* A, const kiriMat3* rate);
kiriMat3 kiriMat3_Beside(const kiriMat3* A, const kiriMat3* rate, kiriVec3 spin);

/* Predicts a frame that the host moves: its motion is known. */
kiriPrediction kiriPrediction_Held(const kiriFrameData* frame, const kiriMaterial* material, double dt);

/* Returns the second moments of mass. The thickness keeps the moments of slivers above zero. */
kiriMassMoments kiriFrame_MassMoments(const kiriFrameData* frame, const kiriMaterial* material);

/* Return the kinetic energy, J; the angular momentum about the centre of mass; and its derivative by the spin,
   symmetric, in world axes. For rigid and affine frames. */
double kiriFrame_KineticEnergy(const kiriFrameData* frame, const kiriMaterial* material);
kiriVec3 kiriFrame_AngularMomentum(const kiriFrameData* frame, const kiriMaterial* material);
kiriMat3 kiriFrame_Inertia(const kiriFrameData* frame, const kiriMaterial* material);

/* Returns the inertia tensor of a rigid frame, symmetric, in world axes. */
kiriMat3 kiriPrediction_Inertia(const kiriPrediction* prediction, const kiriMat3* A);

/* Returns the sum over the region's mass points p of m |A p - B p|^2, with B = `from`. */
double kiriMat3_TurnSquared(const kiriMassMoments* moments, const kiriMat3* from, const kiriMat3* A);

/* Returns half the gradient of TurnSquared by the columns of A. */
kiriMat3 kiriPrediction_Gradient(const kiriPrediction* prediction, const kiriMat3* A);

/* Returns half the gradient of TurnSquared by a turn of A: an angular impulse times h'. `target` replaces A*; with
   pose.A the result includes the host's torque. */
kiriVec3 kiriPrediction_TurnGradient(const kiriPrediction* prediction, const kiriMat3* A, const kiriMat3* target);

/* Return m^-1 a for an invertible m; and m (r^2 - r r^T), the inertia of a point mass at r. */
kiriVec3 kiriMat3_Solve(const kiriMat3* m, kiriVec3 a);
kiriMat3 kiriMat3_PointInertia(double m, kiriVec3 r);

/* Angular momentum of a free body. Steps conserve the linear momentum exactly, but not the angular momentum: a rotating
   frame is predicted along its tangent, and the forces that pull it back act at the end of the step, not at its
   start. */

/* Sums over the frames that the host does not hold, about their centre of mass. */
typedef struct kiriPieceMomentum {
    bool isFree;       /* no pins, clamps, holds or contacts act: momentum is conserved */
    bool isPushed;     /* free except for contacts */
    kiriWrench pushed; /* N s: impulse of the contacts in the step, about the origin */
    double mass;
    kiriVec3 centerBefore, velocityBefore, centerAfter, velocityAfter;
    kiriVec3 due;       /* angular momentum to reach after the step */
    kiriVec3 angular;   /* actual angular momentum after the step */
    kiriMat3 inertia;   /* inertia after the step */
    kiriVec3 dueLinear; /* linear momentum to reach after the step */
    kiriVec3 move;      /* m/s: correction of the velocity, for the linear momentum */
    kiriVec3 turn;      /* rad/s: correction of the spin, for the angular momentum */
    kiriVec3 spin;      /* rad/s: spin of the rigid body with the same momenta */
} kiriPieceMomentum;

/* Turns a free body like a rigid one until it has the angular momentum `due`. A body with contacts alone gets the whole
   momentum of their impulse. before[] and after[] are the frames before and after the step. The caller sets isFree,
   isPushed and pushed in `momentum` and clears the rest, which the function writes. materials[]: per frame. `normal`:
   normal of the plane of a planar sheet, else null. */
void kiriMomentum_Restore(const kiriFrameData* before, kiriFrameData* after, int32_t count, kiriPieceMomentum* momentum,
                          const kiriMaterial* const* materials, kiriVec3 gravity, double dt, const kiriVec3* normal);

KIRI_C_END

#endif
