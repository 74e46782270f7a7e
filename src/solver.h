/* The motion of rigid frames joined by links: backward Euler as a minimisation, solved by Gauss-Newton steps with
   Eigen's sparse Cholesky. The only file that knows Eigen; nothing is thrown across this header. */
#ifndef KIRI_SOLVER_H
#define KIRI_SOLVER_H

#ifdef __cplusplus
extern "C" {
#endif

#include "frame.h"

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

typedef struct kiriSystem {
    kiriFrameData* frames;
    int32_t frameCount;
    const kiriLink* links;
    int32_t linkCount;
    const kiriPinRow* pins;
    int32_t pinCount;
    const kiriContactRow* contacts;
    int32_t contactCount;
    kiriMaterial material;
    kiriVec3 gravity;
} kiriSystem;

/* Pattern and symbolic factorisation for these links. Null for memory. The solver itself lies in `memory`; Eigen's
   matrices take theirs from malloc, here and not in a step. */
kiriSolver* kiriSolver_Create(const kiriMemory* memory, int32_t frameCount, const kiriLink* links, int32_t linkCount);
void kiriSolver_Destroy(kiriSolver* solver);

/* Moves the frames by dt. Links are those of kiriSolver_Create; normals of contacts are unit, heldRotation is a
   rotation. Returns the number of linear systems solved: `iterations`, and up to 6 more where the motion asks for them.
   Or -1 when it cannot be continued (not finite, or no memory); the frames are then as before the call. Forces on
   frames are used, not cleared. */
int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations);

/* Elastic energy of the links, J. */
double kiriSolver_ElasticEnergy(const kiriSystem* system);

#ifdef __cplusplus
}
#endif

#endif
