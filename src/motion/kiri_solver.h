/* The motion of frames: implicit steps as minimisations, solved by Gauss-Newton steps. */
#ifndef KIRI_SOLVER_H
#define KIRI_SOLVER_H

#include "kiri_awake.h"
#include "kiri_strain_offset.h"
#include "kiri_area_element.h"
#include "kiri_clamp.h"
#include "kiri_contact.h"
#include "kiri_reaction.h"

KIRI_C_BEGIN

typedef struct kiriSolver kiriSolver;

/* A material point of a frame held at a place by a spring. */
typedef struct kiriPinRow {
    int32_t frame;
    kiriVec2 at; /* local rest, m */
    kiriVec3 target;
    double stiffness; /* N/m */
} kiriPinRow;

/* How frames move, and what joins them. */
typedef struct kiriMechanics {
    int32_t model;        /* KIRI_MODEL_... */
    bool planar;          /* frames stay in the plane of axes.u and axes.v */
    kiriMat3 axes;        /* orthonormal; only used then */
    int32_t timeStepping; /* KIRI_TIME_STEPPING_... */
} kiriMechanics;

/* Air that moves past the sheet: see kiriWind in kiri.h. */
typedef struct kiriAir {
    kiriVec3 velocity;          /* m/s */
    double density, drag, lift; /* kg/m^3; coefficients */
} kiriAir;

typedef struct kiriSystem {
    kiriMechanics mechanics;
    kiriFrameData* frames;
    int32_t frameCount;
    const kiriLink* links;
    int32_t linkCount;
    const double* linkParts;   /* what counts of each link, 0 to 1; null: all */
    const kiriCorner* corners; /* of these links */
    int32_t cornerCount;
    const int32_t *linkWas, *cornerWas;    /* KIRI_NONE of what is not in force before it is staged; null: not known */
    const kiriStrainOffset* strainOffsets; /* one a link between rigid frames, or null */
    const kiriAreaElements* areaElements;  /* of affine frames; may be null where there are none */
    const kiriPinRow* pins;
    int32_t pinCount;
    kiriClampRow* clamps; /* a step writes what is of that step, and `start` at its end */
    int32_t clampCount;
    kiriContactRow* contacts; /* a step writes what they did; so it does with what yields */
    int32_t contactCount;
    kiriYieldRow* yields;
    int32_t yieldCount;
    kiriReactions reactions; /* what a step adds to; null where nobody asks */
    kiriMaterial material;
    kiriVec3 gravity;
    const kiriAir* air; /* null: none */
} kiriSystem;

/* A solver for no frames yet. Null for memory. */
kiriSolver* kiriSolver_Create(kiriMemory* memory, const kiriMechanics* mechanics);

/* Room for this system, before it is staged: of a large one the system takes a while to give it. See
   kiriRooms_MakeReady. */
kiriProgress kiriSolver_Reserve(kiriSolver* solver, const kiriSystem* next, kiriQuota* quota, int64_t bytesAnItem);

/* Prepares for this system, of which only frameCount, links, corners, area elements and Poisson's ratio are read, and
   which elements are in force: these are not looked at where they need not be; replaces what was staged before. Steps
   go on with the current ones. framePiece[f] is the piece of frame f: no element joins frames of two pieces. The matrix
   gets a new pattern only where the current one does not cover the pairs of frames that elements couple, or where
   frameCount differs: links that vanish leave zero blocks, also in a new pattern, until these are more than twice as
   many as the others.
   Otherwise nothing is allocated but room that grows. False for memory: nothing is staged then. */
bool kiriSolver_Stage(kiriSolver* solver, const kiriSystem* next, const int32_t* framePiece, int32_t pieceCount);

/* Of a solver that was read: is it the one of this system, with room for its steps? */
bool kiriSolver_Fits(const kiriSolver* solver, const kiriSystem* system, const int32_t* framePiece, int32_t pieceCount);

/* What is staged, if anything, becomes current. */
void kiriSolver_Commit(kiriSolver* solver);

/* Of the current configuration: steps move what is awake and nothing else. All pieces are awake after a commit. Rows of
   pins, clamps and contacts must be of pieces that are awake. */
void kiriSolver_SetAwake(kiriSolver* solver, int32_t piece, bool isAwake);

/* Makes the lists of what is awake, where they are others than before, and returns whether they are. The system is of
   the current configuration. A step does so itself. */
bool kiriSolver_ListAwake(kiriSolver* solver, const kiriSystem* system);

/* These lists, as they were made last. */
const kiriAwake* kiriSolver_Awake(const kiriSolver* solver);

/* Of the pattern, which depends on what was staged before: the last bits of steps depend on it. */
uint64_t kiriSolver_Hash(const kiriSolver* solver);

/* Room for so many contacts: steps have no more. False for memory. */
bool kiriSolver_ReserveContacts(kiriSolver* solver, int32_t count);

enum { KIRI_EXTRA_SYSTEMS = 6 }; /* of a step, beside its iterations */

/* What a linear system of what is listed awake counts in a budget, see kiriBudget in kiri.h; and of all, asleep or
   not. */
int64_t kiriSolver_SystemItems(const kiriSolver* solver, int32_t contactCount);
int64_t kiriSolver_MostItems(const kiriSolver* solver, int32_t contactCount);

/* The linear systems that steps solved since this was last called. */
int32_t kiriSolver_TakeSolved(kiriSolver* solver);

/* Moves the frames by dt. Links, corners and area elements are those that were committed; normals of contacts are unit,
   heldRotation is a rotation. Returns the number of linear systems solved: `iterations`, and up to
   KIRI_EXTRA_SYSTEMS more where the motion asks for them, but at most `most` (1 or more). Or -1 when it cannot be
   continued (not finite); the frames are then as before the call. Allocates nothing. Forces on frames are used, not
   cleared; reactions are added to. */
int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations, int32_t most);

/* Elastic energy of all elements, J. */
double kiriSolver_ElasticEnergy(const kiriSystem* system);

KIRI_C_END

#endif
