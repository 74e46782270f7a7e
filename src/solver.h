/* The motion of frames: backward Euler as a minimisation, solved by Gauss-Newton steps. */
#ifndef KIRI_SOLVER_H
#define KIRI_SOLVER_H

#include "patch.h"

typedef struct kiriSolver kiriSolver;

/* A material point of a frame held at a place by a spring. */
typedef struct kiriPinRow {
    int32_t frame;
    kiriVec2 at; /* local rest, m */
    kiriVec3 target;
    double stiffness; /* N/m */
} kiriPinRow;

/* A material point of a frame kept above a plane. */
typedef struct kiriContactRow {
    int32_t frame;
    kiriVec2 at;
    kiriVec3 normal;
    double offset, friction, stiffness;
} kiriContactRow;

/* What moves, and how. */
typedef struct kiriMechanics {
    int32_t model; /* KIRI_MODEL_... */
    bool planar;   /* frames stay in the plane of axes.u and axes.v */
    kiriMat3 axes; /* orthonormal; only used then */
} kiriMechanics;

typedef struct kiriSystem {
    kiriMechanics mechanics;
    kiriFrameData* frames;
    int32_t frameCount;
    const kiriLink* links;
    int32_t linkCount;
    const kiriPatches* patches; /* of affine frames; may be null where there are none */
    const kiriPinRow* pins;
    int32_t pinCount;
    const kiriContactRow* contacts;
    int32_t contactCount;
    kiriMaterial material;
    kiriVec3 gravity;
} kiriSystem;

/* Pattern and symbolic factorisation for these links and patches. Null for memory. A step allocates nothing. */
kiriSolver* kiriSolver_CreateFor(const kiriMemory* memory, const kiriMechanics* mechanics, int32_t frameCount,
                                 const kiriLink* links, int32_t linkCount, const kiriPatches* patches);

/* For rigid frames joined by links, in space. */
kiriSolver* kiriSolver_Create(const kiriMemory* memory, int32_t frameCount, const kiriLink* links, int32_t linkCount);
void kiriSolver_Destroy(kiriSolver* solver);

/* Moves the frames by dt. Mechanics, links and patches are those that it was created for; normals of contacts are unit,
   heldRotation is a rotation. Returns the number of linear systems solved: `iterations`, and up to 6 more where the motion asks for them.
   Or -1 when it cannot be continued (not finite, or no memory); the frames are then as before the call. Forces on
   frames are used, not cleared. */
int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations);

/* Elastic energy of links and patches, J. */
double kiriSolver_ElasticEnergy(const kiriSystem* system);

#endif
