/* A frame by itself: its mass, and the free prediction: how it moves over a step when no element, pin or contact acts
   on it. */
#ifndef KIRI_PREDICTION_H
#define KIRI_PREDICTION_H

#include "kiri_stepping.h"

KIRI_C_BEGIN

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

KIRI_C_END

#endif
