/* Contacts: points of a sheet that stay above planes, with friction. Whoever finds them (sheet/) writes rows; the
   solver finds forces. */
#ifndef KIRI_SOLVER_H
#define KIRI_SOLVER_H

#include "../field/kiri_shape.h"
#include "kiri_frame.h"
#include "kiri_strain.h"
#include "kiri_element.h"
#include "../solver/kiri_matrix.h"

#include <float.h>
#include <string.h>

KIRI_C_BEGIN

/* The other side of contacts where it can yield: a body of a host, an obstacle, or another piece. */
typedef struct kiriYieldRow {
    int64_t number;          /* whose it is, as its finder likes */
    double inverseMass;      /* 1/kg; 0: it does not move */
    kiriMat3 inverseInertia; /* 1/(kg m^2), world, about the centre; zero: it does not turn */
    kiriVec3 center;         /* m: its centre of mass at the start of the tick */
    kiriWrench impulse;      /* N s, N m s about the centre: what sheets gave it in this tick; a step adds to it */
    int32_t pressed;         /* scratch: contacts that press on it in the current step, and share its mass; */
    int32_t held;            /* those that may be held up when its systems are solved */
    /* Scratch, see kiri_contact_row.c: pushes times the speed along them, N s m/s, of it before and after it gets
       them, and the most that they may leave it. */
    double before, after, most;
} kiriYieldRow;

enum { KIRI_CONTACT_WEIGHTS = 16 }; /* of a row: the largest, made to sum to 1 */

/* A point of the material, carried by frames with these weights, that stays above a plane. Planes are as at the start
   of the tick, and move with `velocity` and with what their yield row gets. */
typedef struct kiriContactRow {
    uint64_t key; /* the same contact has it in the next tick, and no other: so it is remembered */
    kiriWeight weights[KIRI_CONTACT_WEIGHTS]; /* largest first; all frames are of one piece */
    int32_t weightCount;                      /* 1 or more */
    int32_t yield;                            /* index of a yield row; KIRI_NONE: the plane does not yield */
    double felt;    /* 1/kg: of the yield row as felt there in any direction; below 0: as its mass and inertia say */
    double cushion; /* 1/kg: the contact is soft as if the obstacle had so much more inverse mass, but gets no recoil */
    kiriVec2 at;    /* local rest, m */
    kiriVec3 normal;   /* unit, to the side of the sheet */
    double offset;     /* m: dot(normal, x) of the plane, for x as the frames blend it: the seen point may be off that,
                          then the plane is moved by as much */
    kiriVec3 velocity; /* m/s: of the plane's material at the point */
    double friction;   /* both sides together */
    double mass;  /* kg: of the material that the point stands for; 0: the contact is not soft */
    double reach; /* m: how deep a soft contact may go; 0 for others */
    double pushSpeed;  /* m/s: how fast it is pushed out at most, where it starts below the plane */
    kiriVec3 way;      /* m: of the plane's material since the start of the tick; a step adds to it */
    kiriVec3 force;    /* N, on the sheet: remembered from the last tick, or zero; then as the last step left it */
    kiriVec3 impulse;  /* N s, on the sheet, since the start of the tick; a step adds to it */
} kiriContactRow;

/* The motion of frames: implicit steps as minimisations, solved by Gauss-Newton steps. */

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
    const kiriStrainOffset* strainOffsets; /* one a link between rigid frames, or null */
    const kiriAreaElements* areaElements;  /* of affine frames; may be null where there are none */
    const kiriPinRow* pins;
    int32_t pinCount;
    kiriClampRow* clamps; /* a step writes `start` at its end */
    int32_t clampCount;
    kiriContactRow* contacts; /* a step writes their forces and impulses, and those of yields */
    int32_t contactCount;
    kiriYieldRow* yields;
    int32_t yieldCount;
    kiriReactions reactions; /* a step adds to them; null: not wanted */
    kiriMaterial material;
    kiriVec3 gravity;
    const kiriAir* air; /* null: none */
} kiriSystem;

/* What of a sheet ticks move: bodies, and their frames and links, by body. A body that sleeps, waits or is gone is in none, and costs nothing. */
typedef struct kiriMoved {
    kiriIndices bodies, frames, links;
    bool isListed;   /* since bodies changed */
    int64_t version; /* of the lists */
} kiriMoved;

typedef struct kiriIndexSpan {
    const int32_t* data;
    int32_t count;
} kiriIndexSpan;

/* Creates a solver without frames. Returns null on out of memory. */
kiriSolver* kiriSolver_Create(kiriMemory* memory, const kiriMechanics* mechanics);

/* Stages the bodies of a system: one a piece. Reads frameCount, links, corners, area elements and Poisson's
   ratio. framePiece[f] is the piece of frame f. All frames of an element are in one piece.
   Steps go on with the bodies in force. A body with the frames of one in force keeps its matrix if the pattern covers
   all pairs of frames that elements couple. Else the new pattern keeps the old pairs, unless these are more than twice
   as many. Replaces what was staged before. Fails on out of memory: then nothing is staged. */
bool kiriSolver_Stage(kiriSolver* solver, const kiriSystem* next, const int32_t* framePiece, int32_t pieceCount);

/* Puts the staged bodies in force, all of them moved. No-op if nothing is staged. Cannot fail. */
void kiriSolver_Commit(kiriSolver* solver);

/* Makes bodies without elements, and with empty matrices: for a load. Fails on out of memory. */
bool kiriSolver_MakeBodies(kiriSolver* solver, const int32_t* framePiece, int32_t frameCount, int32_t pieceCount);

/* Reserves room for the rows of steps. Fails on out of memory. */
bool kiriSolver_ReserveRows(kiriSolver* solver, int64_t pins, int64_t clamps, int64_t contacts);

/* Sets whether ticks move a body. */
void kiriSolver_SetMoved(kiriSolver* solver, int32_t body, bool isMoved);

/* Updates the lists of moved bodies. Returns true if they changed. */
bool kiriSolver_ListMoved(kiriSolver* solver);

const kiriMoved* kiriSolver_Moved(const kiriSolver* solver);

/* Returns the frames of a body: indices of the sheet, ascending. */
kiriIndexSpan kiriSolver_FramesOf(const kiriSolver* solver, int32_t body);

/* Hashes the patterns. They depend on what was staged before, and the last bits of steps depend on them. */
uint64_t kiriSolver_Hash(const kiriSolver* solver);

enum { KIRI_EXTRA_SYSTEMS = 6 }; /* of a step, beside its iterations */

/* Returns the work of a linear system of a body, in contacts. Systems of several bodies that are solved side by side
   count in a budget by the sum of their work, see kiriBudget in kiri.h. */
int64_t kiriSolver_WorkOf(const kiriSolver* solver, int32_t body, int32_t contactCount);

/* An item is the time of 16 frames, about 30 us. */
static inline int64_t kiriSolver_ItemsOf(int64_t work)
{
    return 1 + work / 64;
}

/* Returns the items of a system of all bodies. */
int64_t kiriSolver_MostItems(const kiriSolver* solver, int32_t contactCount);

/* Returns the linear systems that steps solved since the last call. */
int32_t kiriSolver_TakeSolved(kiriSolver* solver);

/* Assigns rows of pins, clamps and contacts to their bodies. All are of bodies that are moved. Steps need that whenever
   rows were written. */
void kiriSolver_ShareRows(kiriSolver* solver, const kiriSystem* system);

/* Moves the frames of a body by dt. Links, corners and area elements are those in force; normals of contacts are unit,
   heldRotation is a rotation. Returns the number of linear systems solved: `iterations`, and up to KIRI_EXTRA_SYSTEMS
   more where the motion asks for them, but at most `most` (1 or more). Returns -1 if the motion cannot be continued (not
   finite): then the frames are as before the call. Allocates nothing. Reads forces on frames and does not clear them;
   adds to reactions. */
int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, int32_t body, double dt, int32_t iterations,
                        int32_t most);

/* Elastic energy of all elements, J. */
double kiriSolver_ElasticEnergy(const kiriSystem* system);

/* Elements join frames elastically. First the links, except in the model of integration points, then the
   corners of these links, unless Poisson's ratio is zero, then the area elements. Element k of a system has strains,
   each with a stiffness; its energy is the sum of 1/2 stiffness strain^2. */

/* The most strains of an element. */
enum { KIRI_MOST_STRAINS = kiriMax((int)KIRI_STRAINS, (int)KIRI_AFFINE_STRAINS) };

static inline bool kiriMechanics_IsAffine(const kiriMechanics* mechanics)
{
    return mechanics->model != KIRI_MODEL_LINKS;
}

static inline int32_t kiriElement_LinkCount(const kiriSystem* system)
{
    return system->mechanics.model == KIRI_MODEL_POINTS ? 0 : system->linkCount;
}

static inline int32_t kiriElement_CornerCount(const kiriSystem* system)
{
    bool isLinked = kiriElement_LinkCount(system) > 0 && system->material.poissonsRatio > 0.0f;
    /* Area elements have the membrane of affine frames. */
    bool isFlat = kiriMechanics_IsAffine(&system->mechanics) && system->mechanics.planar;
    return isLinked && !isFlat ? system->cornerCount : 0;
}

static inline int32_t kiriElement_Count(const kiriSystem* system)
{
    return kiriElement_LinkCount(system) + kiriElement_CornerCount(system) +
           (system->areaElements != NULL ? system->areaElements->elements.count : 0);
}

/* Returns null if the element is no link. */
static inline const kiriLink* kiriElement_Link(const kiriSystem* system, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < kiriElement_Count(system));
    return k < kiriElement_LinkCount(system) ? &system->links[k] : NULL;
}

/* Returns null if the element is no corner. */
static inline const kiriCorner* kiriElement_Corner(const kiriSystem* system, int32_t k)
{
    int32_t corner = k - kiriElement_LinkCount(system);
    return corner >= 0 && corner < kiriElement_CornerCount(system) ? &system->corners[corner] : NULL;
}

/* Returns true for a link between rigid frames. */
static inline bool kiriElement_IsRigidLink(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Link(system, k) != NULL;
}

/* Returns true for a corner between rigid frames. */
static inline bool kiriElement_IsRigidCorner(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Corner(system, k) != NULL;
}

/* Writes the frames of an element and returns their count. All are in one piece. */
int32_t kiriElement_Members(const kiriSystem* system, int32_t k, int32_t* members);

/* The largest number of frames that an element has, 2 or more. */
int32_t kiriElement_MostMembers(const kiriSystem* system);

/* The strains that can be other than zero come first: how many they are. */
int kiriElement_StrainCount(const kiriSystem* system, int32_t k);

void kiriElement_Stiffness(const kiriSystem* system, int32_t k, double* stiffness);

/* The strains and, unless `rows` is null, their derivatives: one row a strain and member. Poses are those of all
   frames; null: as the frames are. */
void kiriElement_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain,
                         kiriFrameRow* rows);

/* The trace of a corner between rigid frames from strains that are known already, KIRI_MOST_STRAINS of each element. */
kiriTrace kiriElement_Trace(const kiriSystem* system, int32_t k, const double* strains);

/* The strains without their offsets: those that pull. */
void kiriElement_TakeOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling);

/* A step of a body (kiri_solver.c, kiri_step.c, kiri_contact_row.c, kiri_energy.c). It is a minimisation over the poses
   of the frames at its end. The objective is

       1/2 sum over mass points of m |x - x*|^2 / h'^2,  x* and h' by the scheme (kiri_frame.h)
     + energies of elements, pins, clamps and contacts
     + flex damping: 1/2 k (flexDamping / dt) (strain - strain at the start of the step)^2 for each strain.

   All are squares, so a Gauss-Newton step solves with J^T k J + mass: positive definite by itself, with a pattern that
   only the elements decide. The order of summation is fixed.

   The system of a body numbers its frames, links, corners, pins and clamps by themselves. Its frames are
   solver->before. Contacts stay rows of the sheet (kiriContactStep.row). */

#define KIRI_ROUNDING 1e-12                /* of an objective, relative */
#define KIRI_LAST_BITS (8.0 * DBL_EPSILON) /* of a length: rounding of a few operations */
#define KIRI_SHORT_STEP 0.3                /* a Gauss-Newton step of which no more than this is taken was cut short */

/* An unknown of a frame: the part of one of its vectors along an axis, see kiriFrameRow. */
typedef struct kiriUnknown {
    int vector, number; /* of the axis */
    kiriVec3 axis;
} kiriUnknown;

/* The objective, and the part of it that is energy of the sheet: the rest is lost, or inertia. */
typedef struct kiriStepEnergy {
    double objective, potential;
} kiriStepEnergy;

enum { KIRI_CONTACT_MEMBERS = 8 };

#define KIRI_SLIDE_FLOOR 1e-9 /* m: shorter ways are no slides */

/* A contact in one step. In a linear system, and along the step that it leads to, it is a spring on the depth, above
   zero or not, and either a spring on the slide or a force of a given size. After each system contacts are chosen anew
   (kiriSolver_ReviewContacts): those that would pull let go, those below their plane push; those that held with more
   than friction can slip, and those whose slide turned round stick. */
typedef struct kiriContactStep {
    kiriContactRow* row;
    kiriWeight members[KIRI_CONTACT_MEMBERS]; /* the frames that it acts on */
    int32_t memberCount;
    bool isHeld;      /* the host holds half of them or more, by weight */
    double mass;      /* kg: of the frames, by their weights */
    kiriVec3 start;   /* m: its point at the start of the step */
    kiriVec3 carried; /* m: how far the obstacle goes in the step */
    double plane;     /* m: offset at the end of the step, no farther up than the point may be pushed: */
    double lowered;   /* that much below the obstacle's surface */
    double lift;      /* m: how far the plane lifts the point at most */
    kiriVec3 held;    /* N: friction of the last step, so that what sticks does not creep */
    bool isActive, sticks;
    double limit;           /* N: of friction where it slips */
    kiriVec3 direction;     /* of the slide: unit or zero */
    double known;           /* N: the largest push that any system had */
    double stiffness, grip; /* N/m: of the springs on depth and slide */
    double give;            /* m/N: how far the obstacle yields in the step, and its cushion */
    double shared;          /* m/N: the same for what holds the point up after the last system */
    double depth, sinks;    /* m: where the system was assembled, and its change by the whole solution */
    kiriVec3 slide, slides; /* m: the same */
    /* Soft contacts only. */
    double soft, mostStiffness; /* m: the softness; N/m */
    double was;                 /* N: the push of the last step */
    double spring, tie;         /* N/m: on depth and slide, in this system */
    double pull;                /* N: the push where the system was assembled, */
    kiriVec3 drags;             /* and friction */
    double solved;          /* N: the push that the last system left, before the body was held up */
    double push;            /* N: by the systems solved so far, */
    kiriVec3 drag;          /* N: and friction */
} kiriContactStep;

/* What acts on a body beside gravity and forces. */
typedef enum kiriSupport {
    KIRI_SUPPORT_NONE,     /* nothing: its momentum is its own */
    KIRI_SUPPORT_CONTACTS, /* contacts alone */
    KIRI_SUPPORT_HELD      /* pins, clamps, holds or wind */
} kiriSupport;

/* Newton's iteration. */
typedef struct kiriSearch {
    kiriStepEnergy start, now; /* where the step starts, and where the iteration is */
    double noise;              /* J: what rounding leaves unknown of the objective */
    double scale;              /* the part of the Gauss-Newton step that is tried, */
    double enough;             /* the objective that it has to reach, */
    double promise;            /* J: and by how much all of it would lower the objective, were that quadratic */
    int32_t wanted;            /* systems that are solved at least */
    int32_t solved;            /* systems since the body began */
    int32_t suspects;          /* Gauss-Newton steps in a row that gained too much energy */
    bool isFirst;              /* the next Gauss-Newton step is the first */
} kiriSearch;

/* The contacts of a body together. */
typedef struct kiriContactSum {
    bool isNear;       /* it has contacts that can push */
    bool isUnsettled;  /* they want another system */
    bool isHeldUp;     /* frames were moved up to planes after the last system */
    double means;      /* J: the body cannot store more than it had and this */
    double keepForces; /* the part that is left of each force */
} kiriContactSum;

/* J: energies after the step. */
typedef struct kiriEnergyStep {
    double kinetic; /* without the mean velocity; */
    double turning; /* part of it: turning as one body; */
    double moving;  /* of the mean velocity */
    double gain;    /* growth of energy in the step beyond work */
} kiriEnergyStep;

/* A connected piece of a sheet as a system of its own. Spans are into kiriSolverBodies. */
typedef struct kiriSolverBody {
    kiriSpan frames, links, corners, elements;
    kiriMatrix* matrix;
    bool ownsMatrix; /* while staged: no body in force has it */
    bool isMoved;
    int32_t pin, clamp, contact; /* the first of its rows in the tick, or KIRI_NONE */
    int32_t contactCount;
} kiriSolverBody;

/* All bodies of a sheet, numbered as its pieces. What belongs to one lies together, in the order of the sheet. */
typedef struct kiriSolverBodies {
    KIRI_ARRAY(kiriSolverBody) bodies;
    kiriIndices bodyOf, place;        /* of each frame of the sheet: its body, and its number there */
    kiriIndices frames, links;        /* of the sheet */
    KIRI_ARRAY(kiriLink) ownLinks;    /* with frames of the body */
    KIRI_ARRAY(kiriCorner) corners;   /* with links of the body */
    kiriAreaElements areaElements;    /* with frames of the body; shares in the order of the sheet */
} kiriSolverBodies;

struct kiriSolver {
    kiriMemory* memory;
    kiriMechanics mechanics;
    int32_t size; /* unknowns a frame */
    kiriUnknown unknowns[KIRI_MOST_UNKNOWNS];
    int32_t solved; /* linear systems since TakeSolved */
    int64_t allWork; /* of a system of each body, without contacts */
    kiriSolverBodies bodies, next; /* in force; staged */
    bool isStaged;
    kiriMoved moved;
    KIRI_ARRAY(kiriPair) pairs;                  /* scratch: of a staged body */
    kiriIndices linkPlace, order;                /* scratch: of each staged link, its number in its body */
    kiriIndices nextPin, nextClamp, nextContact; /* of each row, the next one of its body; or KIRI_NONE */

    /* The body that steps. Arrays have room for the largest body, in force or staged. */
    const kiriSolverBody* body;
    kiriMatrix* matrix;
    kiriFrameData* sheetFrames;
    const int32_t* sheetFrame; /* of each frame of the body */
    double dt, damping;        /* h of this step; flexDamping / dt */
    int32_t elementCount;
    bool isAlong;   /* poses are those along the step that was solved for */
    bool isHeld;    /* the host moves a frame */
    bool isTouched; /* by a contact in this step, or carried about by a hold */
    kiriSupport support;
    kiriStepping stepping;
    kiriSearch search;
    kiriContactSum touch;
    kiriEnergyStep energy;
    kiriPieceMomentum momentum;
    kiriAreaElements areaElements; /* of the body */
    KIRI_ARRAY(kiriPinRow) pins;
    KIRI_ARRAY(kiriClampRow) clamps;
    kiriIndices pinRow, clampRow; /* of each: the row of the sheet */
    KIRI_ARRAY(kiriContactStep) contacts;
    KIRI_ARRAY(double) linkParts;
    KIRI_ARRAY(kiriStrainOffset) strainOffsets;
    /* Flattened where the sheet is planar, and with velocities that the air has slowed. */
    KIRI_ARRAY(kiriFrameData) before, after;
    KIRI_ARRAY(kiriPrediction) predictions;   /* one a frame, as are the poses */
    KIRI_ARRAY(kiriPose) start, poses, trial; /* at the start of the step, now, and where a step would lead */
    /* KIRI_MOST_STRAINS an element: stiffness, damping, and strains at the start of the step. */
    KIRI_ARRAY(double) stiffness, loss, startStrain;
    /* As measured last: corners take strains of their links from there, and their derivatives by the unknowns, both
       ends of each. */
    KIRI_ARRAY(double) nowStrain, tracedRows;
    KIRI_ARRAY(double) force, move; /* the right side: minus the gradient; and the solution */
    KIRI_ARRAY(uint8_t) stopping;   /* of each element: a step would have brought it to its stop */
    /* Scratch for one element. */
    kiriIndices members;
    KIRI_ARRAY(kiriFrameRow) rows;
    KIRI_ARRAY(double) J;
};

/* ---- Unknowns (kiri_solver.c) ---- */

/* Derives by the unknowns from the derivative by the vectors of a frame; and expands unknowns, times `scale`, to the
   vectors that they stand for. */
void kiriSolver_Reduce(const kiriSolver* solver, const kiriFrameRow* row, double* values);
kiriFrameRow kiriSolver_Expand(const kiriSolver* solver, double scale, const double* values);

/* In a planar sheet: the part of a vector in its plane. */
kiriVec3 kiriMechanics_InPlane(const kiriMechanics* mechanics, kiriVec3 a);
kiriVec3 kiriSystem_Gravity(const kiriSystem* system);

/* ---- Begin of a step (kiri_step.c) ---- */

/* Opens a body for a step: returns its system. Begin reads its frames. */
kiriSystem kiriSolver_Open(kiriSolver* solver, const kiriSystem* sheet, int32_t body);

/* Reads the frames from those of the sheet, chooses the scheme, predicts, and clears the rest. */
void kiriSolver_Begin(kiriSolver* solver, const kiriSystem* system, double dt);

/* Returns true if contacts touch a point at these poses. */
bool kiriSolver_AreTouching(const kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);

/* ---- Objective ---- */

/* A material point as seen from its frame's x, and in space. */
static inline kiriVec3 kiriSystem_Arm(const kiriSystem* system, int32_t frame, kiriVec2 at, const kiriPose* pose)
{
    return kiriPose_Along(pose, kiriVec2_Sub(at, system->frames[frame].center));
}

static inline kiriVec3 kiriSystem_Point(const kiriSystem* system, int32_t frame, kiriVec2 at, const kiriPose* poses)
{
    KIRI_ASSERT(frame >= 0 && frame < system->frameCount);
    return kiriVec3_Add(poses[frame].x, kiriSystem_Arm(system, frame, at, &poses[frame]));
}

/* Returns the objective at these poses. */
kiriStepEnergy kiriObjective_Evaluate(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);

/* ---- Assembly ---- */

/* Adds the squares of `rows` strains: J has their derivatives by the unknowns of the frames, each frame's together. */
void kiriSolver_AddSquares(kiriSolver* solver, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* springs, const double* pulls, int rows);

/* Assembles the linear system of a Gauss-Newton step from the poses, and returns the objective there. */
kiriStepEnergy kiriSolver_Assemble(kiriSolver* solver, const kiriSystem* system);

/* ---- Wind (kiri_step.c) ---- */

bool kiriSystem_HasWind(const kiriSystem* system);

/* J: its work on a frame in the step, when solver->after is known. */
double kiriWind_Work(const kiriSolver* solver, const kiriSystem* system, int32_t f);

/* ---- Newton iteration ---- */

/* Returns the number of linear systems solved, or -1 where one has no solution. */
int32_t kiriSolver_Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, int32_t most);

/* ---- Limit of energy (kiri_energy.c) ---- */

/* Moves a free body to where the prediction has its centre of mass. */
void kiriSolver_CenterBody(kiriSolver* solver, const kiriSystem* system);

/* Finds the frames after the step, if it ended at the poses, and the energy that the body gained. A free body is
   centered, and gets the angular momentum that is due. */
void kiriSolver_FindGains(kiriSolver* solver, const kiriSystem* system);

/* J: the most that the energy limit can take out of the velocities. */
double kiriSolver_MostTaken(const kiriSolver* solver);

/* Takes what the body gained out of its velocities. */
void kiriSolver_LimitEnergy(kiriSolver* solver, const kiriSystem* system);

/* Then, if other bodies press on it, or it on them: adds to frames of the sheet by how much energy grew in the step
   beyond the work of gravity, of the host's forces and of obstacles that move (`gained`), and the work and the impulse
   of other bodies (`passed`, `received`). */
void kiriSolver_AddGained(kiriSolver* solver, const kiriSystem* system);

/* ---- Contacts (kiri_contact_row.c) ---- */

static inline kiriVec3 kiriVec3_AlongPlane(kiriVec3 a, kiriVec3 normal)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, normal), normal);
}

/* Makes the contacts of the body: places planes and points for a step. Once the body has its scheme and its prediction,
   GuessContacts guesses what they do. */
void kiriSolver_BeginContacts(kiriSolver* solver, const kiriSystem* system);
void kiriSolver_GuessContacts(kiriSolver* solver, const kiriSystem* system);

/* Where the members have the point. */
kiriVec3 kiriContact_Point(const kiriSystem* system, const kiriContactStep* step, const kiriPose* poses);
double kiriContact_Depth(const kiriSystem* system, const kiriContactStep* step, const kiriPose* poses);

/* Before a system is assembled: springs, depths and slides there. After it is solved: how they change. */
void kiriSolver_LinearizeContacts(kiriSolver* solver, const kiriSystem* system);
void kiriContact_Assemble(kiriSolver* solver, const kiriSystem* system, const kiriContactStep* step);
void kiriSolver_MoveContacts(kiriSolver* solver, const kiriSystem* system);

/* Shortens the step to where friction, which slips instead of sticking or the other way, ends it: where the derivative
   of the objective along it is zero. */
void kiriSolver_LimitByFriction(kiriSolver* solver);

/* Returns what the contact adds to the objective, by its linear model after a part of the step. */
double kiriContact_Energy(const kiriSolver* solver, const kiriSystem* system, const kiriContactStep* step,
                          const kiriPose* poses);

/* After a step: finds its forces, and chooses what contacts do in the next system. */
void kiriSolver_ReviewContacts(kiriSolver* solver, const kiriSystem* system);

/* After the last system: moves what still is well below planes back up, frame by frame or, where that would store more
   energy than the body has, as a whole, and counts what that takes as pushes. */
void kiriSolver_HoldContacts(kiriSolver* solver, const kiriSystem* system);

/* Before the forces are asked for: fits them to where the body ended. */
void kiriSolver_BalanceContacts(kiriSolver* solver, const kiriSystem* system);

/* N: the force on the sheet, within the cone of friction; and J: how much work the obstacle may have done with it. */
kiriVec3 kiriContact_Force(const kiriSolver* solver, const kiriContactStep* step);
double kiriContact_Work(const kiriSolver* solver, const kiriContactStep* step);

/* Writes what the step did to rows of contacts and of what yields. */
void kiriSolver_EndContacts(kiriSolver* solver, const kiriSystem* system);

/* ---- Reactions (kiri_step.c) ---- */

/* Adds what pins, clamps and holds did in the step: by the gradient of the objective at its end. */
void kiriSolver_AddReactions(kiriSolver* solver, const kiriSystem* system);

KIRI_C_END

#endif
