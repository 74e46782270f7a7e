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
    int32_t pressed;         /* scratch: contacts that press on it in the step at hand, and share its mass; */
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
    const int32_t* linkWas; /* for each link: index in the system before, or KIRI_NONE; null: not known */
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

/* Elements: what joins frames elastically. First the links, unless the model is that of integration points, then the
   corners of these links, unless Poisson's ratio is zero, then the area elements. Element k of a system has strains,
   each with a stiffness; its energy is the sum of 1/2 stiffness strain^2. */

/* An element has at most so many strains. */
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

/* Null where the element is no link. */
static inline const kiriLink* kiriElement_Link(const kiriSystem* system, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < kiriElement_Count(system));
    return k < kiriElement_LinkCount(system) ? &system->links[k] : NULL;
}

/* Null where the element is no corner. */
static inline const kiriCorner* kiriElement_Corner(const kiriSystem* system, int32_t k)
{
    int32_t corner = k - kiriElement_LinkCount(system);
    return corner >= 0 && corner < kiriElement_CornerCount(system) ? &system->corners[corner] : NULL;
}

/* Is it a link between rigid frames? */
static inline bool kiriElement_IsRigidLink(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Link(system, k) != NULL;
}

/* Is it a corner between rigid frames? */
static inline bool kiriElement_IsRigidCorner(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Corner(system, k) != NULL;
}

/* Writes the frames of an element, and returns how many there are; all of them are of the piece of the first. */
int32_t kiriElement_Members(const kiriSystem* system, int32_t k, int32_t* members);
int32_t kiriElement_FirstMember(const kiriSystem* system, int32_t k);

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

/* What the files of the solver share: kiri_solver.c (unknowns, pattern, a step), kiri_step.c, kiri_step.c,
   kiri_step.c, kiri_contact_row.c, kiri_contact_row.c, kiri_contact_row.c, kiri_contact_row.c,
   kiri_energy.c and kiri_step.c. No other file of the library includes it.

   The step is a minimisation over the poses of the frames at its end. The objective is

       1/2 sum over mass points of m |x - x*|^2 / h'^2,  x* and h' by the scheme (kiri_frame.h)
     + energies of elements (kiri_solver.h), pins, clamps and contacts
     + flex damping: 1/2 k (flexDamping / dt) (strain - strain at the start of the step)^2 for each strain.

   All are squares, so a Gauss-Newton step solves with J^T k J + mass: positive definite by itself, with a pattern that
   only the elements decide. The order of summation is fixed. */

#define KIRI_ROUNDING 1e-12                /* of an objective, relative */
#define KIRI_LAST_BITS (8.0 * DBL_EPSILON) /* of a length: what a few operations round off */
#define KIRI_SHORT_STEP 0.3                /* a Gauss-Newton step of which no more than this is taken was cut short */

/* One of a frame's unknowns: the part along an axis of one of its vectors, see kiriFrameRow. */
typedef struct kiriUnknown {
    int vector, number; /* of the axis */
    kiriVec3 axis;
} kiriUnknown;

/* The objective, and what of it is energy that the sheet has: the rest is lost, or the inertia's. */
typedef struct kiriStepEnergy {
    double objective, potential;
} kiriStepEnergy;

enum { KIRI_CONTACT_MEMBERS = 8 };

#define KIRI_SLIDE_FLOOR 1e-9 /* m: a shorter way is no slide */

/* A contact in one step. While a linear system is solved, and along the step that it leads to, it is a spring on the
   depth, whether that is above zero or not, and either a spring on the slide or a force of a given size. After each
   system contacts are chosen anew (kiriSolver_ReviewContacts): those that would pull let go, those that came below
   their plane push; those that held with more than friction can slip, and those whose slide turned round stick. */
typedef struct kiriContactStep {
    kiriWeight members[KIRI_CONTACT_MEMBERS]; /* the frames that it acts on */
    int32_t memberCount;
    bool isHeld;      /* are they held, half of them by weight? */
    double mass;      /* kg: of the frames, by their weights */
    kiriVec3 start;   /* m: its point at the start of the step */
    kiriVec3 carried; /* m: how far the obstacle goes in the step */
    double plane;     /* m: offset at the end of the step, as far up as the point may be pushed: */
    double lowered;   /* so much below the obstacle's surface */
    double lift;      /* m: how far the plane lifts the point at most */
    kiriVec3 held;    /* N: friction of the last step: so what sticks does not creep */
    bool isActive, sticks;
    double limit;           /* N: of friction where it slips */
    kiriVec3 direction;     /* of the slide: unit or zero */
    double known;           /* N: the largest push that is known of */
    double stiffness, grip; /* N/m: of the springs on depth and slide */
    double give;            /* m/N: how far the obstacle yields in the step, and its cushion */
    double shared;          /* m/N: the same for what holds the point up after the last system */
    double depth, sinks;    /* m: where the system was assembled, and how it changes by the whole solution */
    kiriVec3 slide, slides; /* m: the same */
    double solved;          /* N: the push that the last system left, before the piece was held up */
    double push;            /* N: by the systems solved so far, */
    kiriVec3 drag;          /* N: and friction */
} kiriContactStep;

/* The step of one piece. No element joins two, so each has a line search and an energy limit of its own. */
typedef struct kiriPieceStep {
    kiriStepEnergy sum;        /* what was evaluated last */
    kiriStepEnergy start, now; /* where the step starts, and where the iteration is */
    double noise;              /* J: what rounding leaves unknown of the objective */
    kiriStepping stepping;     /* the scheme of this step */
    double kinetic;            /* J: after the step, beside that of the mean velocity; */
    double turning;            /* of it, that of turning as one body; */
    double moving;             /* J: and that of the mean velocity */
    double gain;               /* J: what the energy grows by in the step beyond work */
    double scale;              /* the part of the Gauss-Newton step that is tried, */
    double enough;             /* the objective that it has to reach, */
    double promise;            /* J: and by how much all of it would lower the objective, were that quadratic */
    /* What the energy limit leaves of velocities: of the mean, of turning as one body, of the rest. */
    double keepMean, keepTurning, keepRest;
    bool isShared; /* do other pieces press on it, or it on them? */
    double stored; /* J: in links, pins and clamps by the step */
    kiriVec3 mean; /* by mass, over its frames: of offsets, or of what is carried on from the last step */
    double mass;
    int32_t wanted;          /* systems that are solved for it at least */
    bool isFree;             /* do only gravity and forces act on it? */
    bool isPushed;           /* is it free but for contacts? */
    bool isUnsettled;        /* do contacts want another system? */
    bool isNear;             /* has it contacts? */
    bool isPinned;           /* is it free but for pins and contacts? */
    double pressed;          /* N s: sum of what contacts gave, without their directions */
    double obstacleSpeed;    /* m/s: the fastest that an obstacle moves at a contact */
    double means;            /* J: of a piece with contacts: more than it had, and so much, it cannot store */
    bool isHeldUp;           /* were frames moved up to planes after the last system? */
    bool isThrown;           /* did contacts push it too hard? */
    double mostPush;         /* N: the largest */
    kiriVec3 asked, given;   /* N: the sum of what contacts should do, and of what they can; */
    double keepForces;       /* and what is left of each force */
    double more;             /* what contacts did, times what they say of themselves; 1 where nobody knows better */
    double held;             /* N/m: by its pins, all together */
    int32_t solved;          /* systems, since it began */
    bool isCrossing;         /* does friction end the step before all of it is taken? */
    double slope, low, high; /* J: of the objective by the part that is taken; parts between which it is zero */
    bool isTouched;          /* by a contact in this step, or carried about by a hold */
    bool isNew;              /* does it start (anew, by backward Euler)? */
    int suspect;             /* after so many Gauss-Newton steps it had gained too much energy, one after another */
    bool isFirst;            /* is its next Gauss-Newton step the first? */
    bool isIterated;         /* does the iteration go on? */
    bool isSearching;        /* is a step sought that lowers the objective? */
} kiriPieceStep;

struct kiriSolver {
    kiriMemory* memory;
    kiriMechanics mechanics;
    double dt, damping; /* h of this step; flexDamping / dt */
    bool isAlong;       /* are poses those along the step that was solved for? */
    bool isHeld;        /* does the host move a frame? */
    int32_t solved;     /* linear systems since TakeSolved */
    int32_t size;       /* unknowns a frame */
    kiriUnknown unknowns[KIRI_MOST_UNKNOWNS];
    kiriMatrix *matrix, *nextMatrix;        /* the current one, and one with room for the next pattern */
    kiriIndices framePiece, nextFramePiece; /* of each frame */
    int32_t pieceCount, nextPieceCount;
    int32_t frameCount, nextFrameCount;
    int32_t elementCount, nextElementCount;
    kiriAwake awake;
    bool isStaged, isNextMatrix; /* is there a next configuration, and has it a pattern of its own? */
    KIRI_ARRAY(kiriPair) pairs;  /* scratch: of the next configuration */
    /* Room for the larger of the two configurations. */
    KIRI_ARRAY(kiriPieceStep) pieces;
    KIRI_ARRAY(kiriPieceMomentum) momenta; /* of pieces */
    KIRI_ARRAY(kiriContactStep) contacts;
    /* The step; flattened where the sheet is planar, and with velocities that the air has slowed. */
    KIRI_ARRAY(kiriFrameData) before, after;
    KIRI_ARRAY(kiriPrediction) predictions;   /* one a frame, as are the poses */
    KIRI_ARRAY(kiriPose) start, poses, trial; /* at the start of the step, now, and where a step would lead */
    /* KIRI_MOST_STRAINS an element: stiffness, damping, and strains at the start of the step. */
    KIRI_ARRAY(double) stiffness, loss, startStrain;
    /* As measured last: corners take strains of their links from there, and their derivatives by the unknowns, both
       ends of each. */
    KIRI_ARRAY(double) nowStrain, tracedRows;
    KIRI_ARRAY(double) force, move; /* the right side: minus the gradient; and the solution */
    KIRI_ARRAY(uint8_t) stopping;   /* would a step have brought this element to its stop? */
    /* Scratch for one element. */
    kiriIndices members;
    KIRI_ARRAY(kiriFrameRow) rows;
    KIRI_ARRAY(double) J;
};

static inline kiriPieceStep* kiriSolver_PieceOf(const kiriSolver* solver, int32_t frame)
{
    KIRI_ASSERT(frame >= 0 && frame < solver->frameCount);
    return &solver->pieces.data[solver->framePiece.data[frame]];
}

static inline kiriPieceStep* kiriSolver_PieceOfElement(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    return kiriSolver_PieceOf(solver, kiriElement_FirstMember(system, k));
}

/* ---- Unknowns (kiri_solver.c) ---- */

/* The derivative by the unknowns from that by the vectors of a frame; and the vectors that unknowns stand for, times
   `scale`. */
void kiriSolver_Reduce(const kiriSolver* solver, const kiriFrameRow* row, double* values);
kiriFrameRow kiriSolver_Expand(const kiriSolver* solver, double scale, const double* values);

/* In a planar sheet: what is left of a vector in its plane. */
kiriVec3 kiriMechanics_InPlane(const kiriMechanics* mechanics, kiriVec3 a);
kiriVec3 kiriSystem_Gravity(const kiriSystem* system);

/* ---- Begin of a step (kiri_step.c) ---- */

/* Chooses the scheme of each piece, predicts, and clears the rest. */
void kiriSolver_Begin(kiriSolver* solver, const kiriSystem* system, double dt);

/* The pieces that are new take this step by backward Euler; their poses are where that starts. */
void kiriSolver_BecomeEuler(kiriSolver* solver, const kiriSystem* system);

/* Marks the pieces of which contacts touch a point at these poses. */
void kiriSolver_FindTouched(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);

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

/* The strains of element k at the poses. `strains` has KIRI_MOST_STRAINS an element; those of a corner's links are
   there already. */
void kiriObjective_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strains);

/* Adds the energy of element k, whose strains these are; `pulling` without their offsets. */
void kiriObjective_AddElement(const kiriSolver* solver, const kiriSystem* system, int32_t k, const double* strain,
                              const double* pulling, kiriStepEnergy* sum);

/* Starts the sums of the pieces that search with what the inertia has; adds what pins, clamps and contacts have. */
void kiriObjective_AddInertia(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);
void kiriObjective_AddHost(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);

/* The sums of the pieces that search, at these poses. */
void kiriObjective_Evaluate(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);

/* What rounding leaves unknown of the objective of each piece. */
void kiriObjective_FindNoise(kiriSolver* solver, const kiriSystem* system);

/* ---- Assembly ---- */

/* Adds the squares of `rows` strains: J has their derivatives by the unknowns of the frames, each frame's together. */
void kiriSolver_AddSquares(kiriSolver* solver, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* springs, const double* pulls, int rows);

/* The linear system of a Gauss-Newton step from the poses, and the sums there, as kiriObjective_Evaluate has them. */
void kiriSolver_Assemble(kiriSolver* solver, const kiriSystem* system);

/* A spring on a point of a frame, stretched by `length` along the unit vector `axis`. */
void kiriSolver_AddSpring(kiriSolver* solver, const kiriSystem* system, int32_t f, kiriVec2 at, kiriVec3 axis,
                          double length, double stiffness);

/* ---- Wind (kiri_step.c) ---- */

bool kiriSystem_HasWind(const kiriSystem* system);

/* Where there is: its part of the objective of the pieces that search, and of their linear system. */
void kiriWind_AddEnergy(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);
void kiriWind_Assemble(kiriSolver* solver, const kiriSystem* system);

/* Its work on a frame in the step, J, when solver->after is known; and with what it acts at the poses, about x. */
double kiriWind_Work(const kiriSolver* solver, const kiriSystem* system, int32_t f);
kiriWrench kiriWind_OnFrame(const kiriSolver* solver, const kiriSystem* system, int32_t f);

/* ---- Newton iteration ---- */

/* Returns the number of linear systems solved, or -1 where one has no solution. */
int32_t kiriSolver_Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, int32_t most);

/* ---- Limit of energy ---- */

/* `mean` and `mass` of all pieces. */
void kiriSolver_ClearMeans(kiriSolver* solver);

/* Moves free pieces to where the prediction has their centre of mass. */
void kiriSolver_CenterFreePieces(kiriSolver* solver, const kiriSystem* system);

/* The frames after the step, if it ended at the poses, and what energy each piece gained. Free pieces are
   centered, and get the angular momentum that is due. */
void kiriSolver_FindGains(kiriSolver* solver, const kiriSystem* system);

/* The most that the energy limit can take out of the velocities of a piece, J. */
double kiriPieceStep_MostTaken(const kiriPieceStep* piece);

/* Takes what pieces gained out of their velocities. */
void kiriSolver_LimitEnergy(kiriSolver* solver, const kiriSystem* system);

/* Then, of a piece on which others press, or which they feel: adds to frames of it by how much its energy grew in the
   step beyond the work of gravity, of the host's forces and of obstacles that move (`gained`), and the work and the
   impulse of the other pieces (`passed`, `received`). */
void kiriSolver_AddGained(kiriSolver* solver, const kiriSystem* system);

/* ---- Contacts (kiri_contact_row.c) ---- */

static inline kiriPieceStep* kiriContact_PieceOf(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    return kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
}

static inline kiriVec3 kiriVec3_AlongPlane(kiriVec3 a, kiriVec3 normal)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, normal), normal);
}

/* Where frames have a point by these weights. */
kiriVec3 kiriSystem_PointOfMany(const kiriSystem* system, const kiriWeight* weights, int32_t count, kiriVec2 at,
                                const kiriPose* poses);

/* 1/kg: of the obstacle at a point, along a direction. N/m: of what resists the point of a contact by its inertia
   alone. */
double kiriContact_InverseMass(const kiriSystem* system, int32_t k, kiriVec3 point, kiriVec3 along);
double kiriContact_Inertia(const kiriSolver* solver, const kiriSystem* system, int32_t k);

/* Places planes and points for a step; then, once a piece has its scheme and its prediction, guesses what its contacts
   do (kiri_contact_row.c). */
void kiriSolver_BeginContacts(kiriSolver* solver, const kiriSystem* system);
void kiriSolver_GuessContacts(kiriSolver* solver, const kiriSystem* system);

/* Where the members have the point. */
kiriVec3 kiriContact_Point(const kiriSolver* solver, const kiriSystem* system, int32_t k, const kiriPose* poses);
double kiriContact_Depth(const kiriSolver* solver, const kiriSystem* system, int32_t k, const kiriPose* poses);

/* Before a system is assembled: springs, depths and slides there. After it is solved: how they change. */
void kiriSolver_LinearizeContacts(kiriSolver* solver, const kiriSystem* system);
void kiriContact_Assemble(kiriSolver* solver, const kiriSystem* system, int32_t k); /* kiri_contact_row.c */
void kiriSolver_MoveContacts(kiriSolver* solver, const kiriSystem* system);

/* N: friction by the linear model after a part of the step, on the sheet. N/m: what turns the direction of a slide. */
kiriVec3 kiriContactStep_Drag(const kiriContactStep* step, double part);
double kiriContactStep_TurnSpring(const kiriContactStep* step);

/* Shortens the step of a piece to where friction, which slips instead of sticking or the other way, ends it: where the
   derivative of the objective along it is zero. */
void kiriSolver_LimitByFriction(kiriSolver* solver, const kiriSystem* system);

/* What the contact adds to the objective, by its linear model after a part of the step. */
double kiriContact_Energy(const kiriSolver* solver, const kiriSystem* system, int32_t k, const kiriPose* poses);

/* After a step: its forces, and what contacts do in the next system. */
void kiriSolver_ReviewContacts(kiriSolver* solver, const kiriSystem* system);

/* After the last system (kiri_contact_row.c): moves what still is well below planes back up, frame by frame or, where
   that would store more energy than the piece has, as a whole, and counts what that takes as pushes. */
void kiriSolver_HoldContacts(kiriSolver* solver, const kiriSystem* system);

/* Before the forces are asked for: fits them to where pieces ended. */
void kiriSolver_BalanceContacts(kiriSolver* solver, const kiriSystem* system);

/* The force on the sheet, N, within the cone of friction; and how much work the obstacle may have done with it, J. */
kiriVec3 kiriContact_Force(const kiriSolver* solver, const kiriSystem* system, int32_t k);
double kiriContact_Work(const kiriSolver* solver, const kiriSystem* system, int32_t k);

/* m/s: of the material of the obstacle at a point, with what sheets gave it in this tick. */
kiriVec3 kiriContact_PlaneVelocity(const kiriSystem* system, int32_t k, kiriVec3 point);

/* Gives what yields so many times what the contact did in the step. */
void kiriContact_Give(const kiriSolver* solver, const kiriSystem* system, int32_t k, double times);

/* Gives what yields what contacts did in the step. Of a pinned piece that is what its momentum and its pins say, as far
   as obstacles may have it; its pins have the rest (kiri_contact_row.c). */
void kiriSolver_BalancePinned(kiriSolver* solver, const kiriSystem* system);

/* Writes what the step did to rows, contacts' and those of what yields. */
void kiriSolver_EndContacts(kiriSolver* solver, const kiriSystem* system);

/* ---- Reactions (kiri_step.c) ---- */

/* Adds what pins, clamps and holds did in the step: by the gradient of the objective at its end. */
void kiriSolver_AddReactions(kiriSolver* solver, const kiriSystem* system);

KIRI_C_END

#endif
