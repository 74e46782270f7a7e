/* Contacts: points of a sheet that stay above planes, with friction. The module sheet/ finds contacts and writes their
   rows; the solver computes their forces. */
#ifndef KIRI_SOLVER_H
#define KIRI_SOLVER_H

#include "../field/kiri_shape.h"
#include "kiri_frame.h"
#include "kiri_strain.h"
#include "kiri_element.h"
#include "../solver/kiri_matrix.h"

#include <float.h>

KIRI_C_BEGIN

enum { KIRI_RECOILS = 6, KIRI_MOST_RECOILING = 8 };

/* The other side of contacts, if it can move: a body of the host, an obstacle, or another piece. */
typedef struct kiriYieldRow {
    int64_t number;          /* id chosen by the code that writes the row */
    double inverseMass;      /* 1/kg; 0: it does not move */
    kiriMat3 inverseInertia; /* 1/(kg m^2), world, about the centre; zero: it does not turn */
    kiriVec3 center;         /* m: its centre of mass at the start of the tick */
    kiriWrench impulse;      /* N s, N m s about the centre: given by sheets in this tick; a step adds to it */
    kiriVec3 lent;           /* N s: the part of its momentum that it gets in equal parts at the substeps of the tick */
    int32_t pressed;         /* scratch: contacts that press on it in the current step, and share its mass */
    /* Scratch, N s m/s, see kiri_contact_row.c: sums of push times speed along it, before and after the pushes act, and
       the upper limit of `after`. */
    double before, after, most;
    /* Scratch: unknowns of the obstacle in a step (kiri_recoil.c). It moves by `moving` times the first three, and turns by
       `turning` times the others. from: so far; at: of the poses that are tried; move: by the last system. */
    int32_t place; /* of the first unknown; KIRI_NONE: it has none */
    double moving;
    kiriMat3 turning;
    double from[KIRI_RECOILS], at[KIRI_RECOILS], move[KIRI_RECOILS];
} kiriYieldRow;

typedef struct kiriSolver kiriSolver;

enum { KIRI_CONTACT_MEMBERS = 8, KIRI_CONTACT_SIDE = 4, KIRI_STITCH_SIDE = 16 };

/* A frame that carries a point. Weights of a second point are negative: the point is then the difference of the two. */
typedef struct kiriContactMember {
    int32_t frame;
    double value;
    kiriVec2 at; /* local rest, m */
} kiriContactMember;

/* A material point, blended from frames by weights, that stays above a plane. The plane is given at the start of the
   tick. It moves with `velocity` and with the impulse of its yield row. In a mutual contact it moves with a second
   material point, of the same sheet or of another. */
typedef struct kiriContactRow {
    uint64_t key; /* identifies the contact from tick to tick; unique */
    /* The largest weights, scaled to the sum 1; all frames are of one piece. Places: the mean of the vertices that carry the
       point, by their weights for the frame. */
    kiriContactMember weights[KIRI_CONTACT_MEMBERS];
    int32_t weightCount;                      /* 1 or more; at most KIRI_CONTACT_SIDE in a mutual contact */
    bool isFold;                              /* both points are of one body */
    kiriSolver* other;                        /* solver of the sheet of the second point; null: no mutual contact */
    kiriContactMember otherWeights[KIRI_CONTACT_SIDE]; /* of the second point, likewise; a step moves their places along
                                                          the surface to where the first point is */
    int32_t otherCount;
    kiriVec3 otherNormal; /* the normal in the axes of its first frame, with which it turns */
    kiriVec3 place;       /* m: on the obstacle at the start of the tick, where it feels the forces; of a mutual contact, the offset
                             from the second point to the first one in these axes, to be kept along the surface */
    int32_t yield;                            /* index of a yield row; KIRI_NONE: the plane does not yield */
    double felt;    /* 1/kg: inverse mass of the yield row at the point, in any direction; below 0: from its mass and
                       inertia */
    kiriVec3 normal;   /* unit, to the side of the sheet */
    double offset;     /* m: dot(normal, x) of the plane, for x as blended from the frames. If the visible point differs
                          from x, the plane is shifted by the difference */
    kiriVec3 velocity; /* m/s: of the plane's material at the point */
    double friction;   /* coefficient of both sides together */
    double mass;  /* kg: of the material that the point represents; 0: the contact is not soft */
    double reach; /* m: largest depth of a soft contact; 0 for others */
    double pushSpeed;  /* m/s: limit of the speed at which a point below the plane is pushed out */
    kiriVec3 way;      /* m: displacement of the plane's material since the start of the tick; a step adds to it */
    kiriVec3 force;    /* N, on the sheet: in: from the last tick, or zero; out: from the last step */
    kiriVec3 impulse;  /* N s, on the sheet, since the start of the tick; a step adds to it */
    int32_t next;      /* next row of the same body, or KIRI_NONE: kiriSolver_ShareRows */
} kiriContactRow;

enum { KIRI_STITCH_MEMBERS = 2 * KIRI_STITCH_SIDE };

/* A stitch of a seam: a spring between two material points, of one body or of two. */
typedef struct kiriStitchRow {
    struct kiriStitchRow* next; /* of the same island; null: the last */
    int32_t body;               /* scratch of the caller */
    kiriSolver* solvers[2];     /* of the sheets of both points; null: the point does not move */
    int32_t counts[2];
    /* Of the first point, then of the second one. PrepareIsland replaces the frames of sheets by frames of the island. */
    kiriContactMember members[KIRI_STITCH_MEMBERS];
    kiriVec3 off;     /* m: the difference of the points that the spring keeps */
    double stiffness; /* N/m */
    /* Hinge: the frames of each point blend this vector of their material (u, v, normal); a spring keeps both alike. */
    kiriVec3 ways[2];
    double bending;   /* N m */
    kiriVec3 solved, force; /* N, on the first point: of the last system, and of the systems so far */
    kiriVec3 impulse; /* N s, on the first point, since the start of the tick; a step adds to it */
} kiriStitchRow;

/* The motion of frames: implicit steps as minimisations, solved by Gauss-Newton steps. */

/* A material point of a frame, attached to a target by a spring. */
typedef struct kiriPinRow {
    int32_t frame;
    kiriVec2 at; /* local rest, m */
    kiriVec3 target;
    double stiffness;       /* N/m */
    kiriReaction* reaction; /* a step adds to it; null: not computed */
} kiriPinRow;

/* Model of motion. */
typedef struct kiriMechanics {
    int32_t model;        /* KIRI_MODEL_... */
    bool planar;          /* frames stay in the plane of axes.u and axes.v */
    kiriMat3 axes;        /* orthonormal; used only if planar */
    int32_t timeStepping; /* KIRI_TIME_STEPPING_... */
} kiriMechanics;

/* Air flow past the sheet: see kiriWind in kiri.h. */
typedef struct kiriAir {
    kiriVec3 velocity;          /* m/s */
    double density, drag, lift; /* kg/m^3; coefficients */
} kiriAir;

/* What clamps leave of a link, 0 to 1: factors of its stiffness and of its outer width. A held edge is not free. */
typedef struct kiriLinkPart {
    double part, free;
} kiriLinkPart;

typedef struct kiriSystem {
    kiriMechanics mechanics;
    kiriFrameData* frames;
    int32_t frameCount;
    /* Per frame, if the frames are of several sheets; null: `material` and `air` */
    const kiriMaterial* const* materials;
    const kiriAir* const* airs;
    const kiriLink* links;
    int32_t linkCount;
    const kiriLinkPart* linkParts; /* null: all of every link */
    const kiriCorner* corners; /* corners of `links` */
    int32_t cornerCount;
    kiriStrainOffset* strainOffsets; /* one a link between rigid frames, or null; a step writes them where links flow */
    kiriPlastic* plastics; /* one a link, or null: no link flows. A step writes them */
    kiriYield* flows;      /* of the system of a body: one a link, or null */
    const kiriAreaElements* areaElements;  /* of affine frames; null: none */
    const kiriPinRow* pins;
    int32_t pinCount;
    kiriClampRow* clamps; /* elements; a step writes `start` at its end */
    int32_t clampCount;
    kiriContactRow* contacts; /* a step writes their forces and impulses, and the impulses of yield rows */
    int32_t contactCount;
    kiriYieldRow* yields;
    int32_t yieldCount;
    kiriStitchRow* stitches; /* of the system of an island: the first one, or null; a step adds to their impulses */
    kiriMaterial material;
    kiriVec3 gravity;
    const kiriAir* air; /* null: none */
    bool maySettle;     /* a body takes fewer iterations where the objective does not fall any more */
} kiriSystem;

/* The bodies of a sheet that ticks move, and their frames and links, by body. Bodies that sleep, that are pending or
   that were removed are not listed and cost nothing. */
typedef struct kiriMoved {
    kiriIndices bodies, frames, links;
    bool isListed;   /* false if bodies have changed since the lists were made */
    int64_t version; /* changes with the lists */
} kiriMoved;

typedef struct kiriIndexSpan {
    const int32_t* data;
    int32_t count;
} kiriIndexSpan;

/* Creates a solver without frames. Returns null on out of memory. */
kiriSolver* kiriSolver_Create(kiriMemory* memory, const kiriMechanics* mechanics);

/* Stages the bodies of a system, one a piece. Reads frameCount, links, corners, area elements and Poisson's ratio.
   framePiece[f] is the piece of frame f. All frames of an element are in one piece.
   Steps continue to use the committed bodies. A staged body keeps the matrix of a committed body with the same frames
   if its pattern covers all pairs of frames that elements couple. Otherwise the new pattern also contains the old
   pairs, unless there are more than twice as many. Replaces bodies staged earlier. Fails on out of memory: then nothing
   is staged. */
bool kiriSolver_Stage(kiriSolver* solver, const kiriSystem* next, const int32_t* framePiece, int32_t pieceCount);

/* Replaces the bodies with the staged ones, all of them moved. No-op if nothing is staged. Cannot fail. */
void kiriSolver_Commit(kiriSolver* solver);

/* Sets stiffness and rest angle of a fold. */
void kiriSolver_SetFold(kiriSolver* solver, int32_t fold, double hinge, double rest);

/* Makes bodies without elements, and with empty matrices, for a load. Fails on out of memory. */
bool kiriSolver_MakeBodies(kiriSolver* solver, const int32_t* framePiece, int32_t frameCount, int32_t pieceCount);

/* Reserves room for the rows of steps. Fails on out of memory. */
bool kiriSolver_ReserveRows(kiriSolver* solver, int64_t pins, int64_t clamps, int64_t contacts);

/* The same for obstacles with a mass. */
bool kiriSolver_ReserveBodies(kiriSolver* solver, int64_t bodies, int64_t frames);

/* Sets whether ticks move a body. */
void kiriSolver_SetMoved(kiriSolver* solver, int32_t body, bool isMoved);

/* Updates the lists of moved bodies. Returns true if they changed. */
bool kiriSolver_ListMoved(kiriSolver* solver);

/* Returns the frames of a body: indices of the sheet, ascending. */
kiriIndexSpan kiriSolver_FramesOf(const kiriSolver* solver, int32_t body);

/* Hashes the patterns. They depend on earlier stagings and determine the last bits of steps. */
uint64_t kiriSolver_Hash(const kiriSolver* solver);

enum { KIRI_EXTRA_SYSTEMS = 6 }; /* limit of systems in a step beyond its iterations */

/* Returns the work of a linear system of a body. Systems of several bodies that are solved in parallel count in a
   budget by the sum of their work, see kiriBudget in kiri.h. */
int64_t kiriSolver_WorkOf(const kiriSolver* solver, int32_t body, int32_t contactCount);

/* Converts work to items of a budget. An item takes the time of 16 frames, about 30 us. */
static inline int64_t kiriSolver_ItemsOf(int64_t work)
{
    return 1 + work / 64;
}

/* Returns the number of linear systems solved since the last call. */
int32_t kiriSolver_TakeSolved(kiriSolver* solver);

/* Assigns rows of pins, clamps and contacts to their bodies, all of which must be moved. Call it after rows were
   written and before a step. */
void kiriSolver_ShareRows(kiriSolver* solver, const kiriSystem* system);

/* A body of an island: bodies that one step moves as one system, because mutual contacts join them. */
typedef struct kiriIslandBody {
    kiriSolver* solver;       /* of its sheet */
    const kiriSystem* sheet;  /* system of its sheet, all of whose bodies are committed */
    int32_t body;
} kiriIslandBody;

/* The matrix of an island. It depends on the pairs alone, so it is kept from tick to tick while they are the same. */
typedef struct kiriIslandMatrix {
    kiriMatrix* matrix; /* null: none yet */
    KIRI_ARRAY(kiriPair) pairs, next; /* of the matrix, and of the island */
} kiriIslandMatrix;

/* Shapes the matrix of an island: pairs of the patterns of its bodies, and pairs of mutual contacts and of stitches.
   Reserves the scratch of `solver`, which steps the island. Rows are written and shared. Fails on out of memory. */
bool kiriSolver_PrepareIsland(kiriSolver* solver, kiriMemory* memory, kiriIslandMatrix* matrix,
                              const kiriIslandBody* bodies, int32_t count, kiriStitchRow* stitches);

/* Returns the work of a linear system of an island, see kiriSolver_WorkOf. */
int64_t kiriSolver_WorkOfIsland(const kiriMatrix* matrix, const kiriIslandBody* bodies, int32_t count);

/* Moves the frames of an island. `solver` has the scratch; its sheet has the same model as all sheets of the island.
   `stitches`: the first one, or null. Otherwise as kiriSolver_Step. */
int32_t kiriSolver_StepIsland(kiriSolver* solver, kiriMatrix* matrix, const kiriIslandBody* bodies, int32_t count,
                              kiriStitchRow* stitches, double dt, int32_t iterations, int32_t most);

/* Moves the frames of a body by dt. Links, corners and area elements must be the committed ones; normals of contacts
   must be unit vectors, heldRotation a rotation. Returns the number of linear systems solved: `iterations`, and up to
   KIRI_EXTRA_SYSTEMS more if the motion needs them, but at most `most` (1 or more) and a fresh start. Returns -1 if the
   motion is not finite: then the frames are unchanged. Allocates nothing. Reads forces on frames and does not clear them;
   adds to reactions of rows and of held frames. */
int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, int32_t body, double dt, int32_t iterations,
                        int32_t most);

/* Return the elastic energy of an element, and of all, J. */
double kiriElement_Energy(const kiriSystem* system, int32_t k);
double kiriSolver_ElasticEnergy(const kiriSystem* system);

/* Multiplies the offsets of these links by `keep`, but for their plastic parts (plastics: one a link, or null).
   mayTouch: the sheet is near contacts. Then, under gravity, a fade that would add much energy to a link is shorter, or
   waits until the link has less strain. */
void kiriSolver_FadeOffsets(const kiriSystem* system, kiriStrainOffset* offsets, const kiriPlastic* plastics,
                            const kiriIndices* links, double keep, bool mayTouch);

/* Elements join frames elastically. Their order is: links, except in the model of integration points; corners of these
   links, unless Poisson's ratio is zero; area elements; clamps, which join a frame to a line. Each element has several
   strains, each with a stiffness; its energy is the sum of 1/2 stiffness strain^2. */

/* Upper limit of the number of strains of an element. */
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
    /* Area elements represent the membrane of affine frames. */
    bool isFlat = kiriMechanics_IsAffine(&system->mechanics) && system->mechanics.planar;
    return isLinked && !isFlat ? system->cornerCount : 0;
}

static inline int32_t kiriElement_Count(const kiriSystem* system)
{
    return kiriElement_LinkCount(system) + kiriElement_CornerCount(system) +
           (system->areaElements != NULL ? system->areaElements->elements.count : 0) + system->clampCount;
}

/* Returns the clamp, or null. */
static inline kiriClampRow* kiriElement_Clamp(const kiriSystem* system, int32_t k)
{
    int32_t clamp = system->clampCount > 0 ? k - (kiriElement_Count(system) - system->clampCount) : KIRI_NONE;
    return clamp >= 0 ? &system->clamps[clamp] : NULL;
}

/* Returns the link, which may be of a clamp, or null if the element is a corner or an area element. */
static inline const kiriLink* kiriElement_Link(const kiriSystem* system, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < kiriElement_Count(system));
    const kiriClampRow* clamp = kiriElement_Clamp(system, k);
    return k < kiriElement_LinkCount(system) ? &system->links[k] : clamp != NULL ? &clamp->link : NULL;
}

/* Returns the corner, or null. */
static inline const kiriCorner* kiriElement_Corner(const kiriSystem* system, int32_t k)
{
    int32_t corner = k - kiriElement_LinkCount(system);
    return corner >= 0 && corner < kiriElement_CornerCount(system) ? &system->corners[corner] : NULL;
}

/* Returns true for a link between rigid frames, or from a line to one. */
static inline bool kiriElement_IsRigidLink(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Link(system, k) != NULL;
}

/* Returns true for a corner between rigid frames. */
static inline bool kiriElement_IsRigidCorner(const kiriSystem* system, int32_t k)
{
    return !kiriMechanics_IsAffine(&system->mechanics) && kiriElement_Corner(system, k) != NULL;
}

/* Writes the frames of an element, all in one piece, and returns their number. */
int32_t kiriElement_Members(const kiriSystem* system, int32_t k, int32_t* members);

/* The largest number of frames that an element has, 2 or more. */
int32_t kiriElement_MostMembers(const kiriSystem* system);

/* Returns the number of strains that can be nonzero. They come first. */
int kiriElement_StrainCount(const kiriSystem* system, int32_t k);

void kiriElement_Stiffness(const kiriSystem* system, int32_t k, double* stiffness);

/* Measures the strains and, unless `rows` is null, their derivatives: one row for each strain and member. poses[] has
   all frames; null: the current poses of the frames. */
void kiriElement_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain,
                         kiriFrameRow* rows);

/* Returns the trace of a corner between rigid frames. strains[]: KIRI_MOST_STRAINS of each element, already measured.
   */
kiriTrace kiriElement_Trace(const kiriSystem* system, int32_t k, const double* strains, size_t each);

/* Returns the offsets of the strains of a link or a clamp, or null. */
static inline double* kiriElement_Offset(const kiriSystem* system, int32_t k)
{
    kiriClampRow* clamp = kiriElement_Clamp(system, k);
    bool hasOffset = system->strainOffsets != NULL && kiriElement_IsRigidLink(system, k);
    return clamp != NULL ? clamp->offset : hasOffset ? system->strainOffsets[k].strain : NULL;
}

/* Returns the yielding of a link or a clamp in this step, or null. */
static inline kiriYield* kiriElement_Yield(const kiriSystem* system, int32_t k)
{
    kiriClampRow* clamp = kiriElement_Clamp(system, k);
    if (clamp != NULL) {
        return clamp->keptPlastic != NULL ? &clamp->yield : NULL;
    }
    return system->flows != NULL && kiriElement_IsRigidLink(system, k) ? &system->flows[k] : NULL;
}

/* Finds the flow at these strains. Returns the energy that it takes, J. Corners read the offsets of links, so links come
   first. */
static inline double kiriElement_Flow(const kiriSystem* system, int32_t k, const double* strain, bool mayFlow)
{
    kiriYield* yield = kiriElement_Yield(system, k);
    if (yield != NULL) {
        kiriBentStrain bend = kiriBentStrain_Of(strain), off;
        kiriYield_Flow(yield, &bend, mayFlow, &off);
        kiriBentStrain_Write(&off, kiriElement_Offset(system, k));
    }
    return yield != NULL ? yield->lost : 0.0;
}

/* Subtracts the offsets from the strains. The result is the part that causes forces. */
void kiriElement_TakeOffsets(const kiriSystem* system, int32_t k, const double* strain, double* pulling);

/* A step of a body (kiri_solver.c, kiri_step.c, kiri_contact_row.c, kiri_energy.c) minimises an objective over the
   poses of the frames at its end:

       1/2 sum over mass points of m |x - x*|^2 / h'^2,  x* and h' by the scheme (kiri_frame.h)
     + energies of elements, pins and contacts
     + flex damping: 1/2 k (flexDamping / dt) (strain - strain at the start of the step)^2 for each strain.

   All terms are squares, so the matrix of a Gauss-Newton step is J^T k J + mass: always positive definite, with a
   pattern that depends only on the elements. The order of summation is fixed.

   The system of a body has its own indices of frames, links, corners, pins and clamps. Its frames are solver->before.
   Contacts refer to rows of the sheet (kiriContactStep.row). */

#define KIRI_ROUNDING 1e-12                /* rounding error of an objective, relative */
#define KIRI_LAST_BITS (8.0 * DBL_EPSILON) /* rounding error of a length after a few operations, relative */
#define KIRI_SHORT_STEP 0.3                /* a Gauss-Newton step scaled by less than this was cut short */

/* An unknown of a frame: the component of one of its vectors (see kiriFrameRow) along an axis. */
typedef struct kiriUnknown {
    int vector, number; /* indices of the vector and of the axis */
    kiriVec3 axis;
} kiriUnknown;

/* The objective, and the elastic and contact energy in it. The rest is damping and inertia. */
typedef struct kiriStepEnergy {
    double objective, potential;
    double flow; /* J: part of the potential that plastic flow takes */
} kiriStepEnergy;

#define KIRI_SLIDE_FLOOR 1e-9 /* m: shorter slides count as zero */

/* A contact in one step. In a linear system, and along the resulting Gauss-Newton step, it is a spring on the depth, of
   either sign, and either a spring on the slide or a constant friction force. After each system,
   kiriSolver_ReviewContacts updates the state of each contact: contacts that would pull let go, contacts below their
   plane push; sticking contacts that exceed the friction limit slip, slipping contacts whose slide reversed stick. */
typedef struct kiriContactStep {
    kiriContactRow* row;
    /* A soft contact that no pose of this step has brought to its plane so far: it adds exactly nothing, and has only its row,
       the members of the row, and `carried`. above, lever: see kiriSolver_FindNear. */
    bool isFar;
    double above, lever; /* m: height over the plane at the start; the farthest member from its frame */
    kiriYieldRow* yield; /* of the row, or null */
    kiriYieldRow* body;  /* the same if its unknowns are in the system */
    kiriVec3 arm;        /* m: from the centre of `yield` */
    kiriContactMember members[KIRI_CONTACT_MEMBERS];
    int32_t memberCount, coupledCount; /* the first ones all have blocks of the matrix in common */
    bool isHeld;      /* the host holds half of the frames or more, by weight */
    double mass;      /* kg: of the frames, by weight */
    kiriVec3 start;   /* m: position of the point at the start of the step */
    kiriVec3 point;   /* m: see kiriSolver_PlaceContacts */
    kiriVec3 tried;   /* m, of a soft contact: at the poses that were evaluated last */
    kiriVec3 carried; /* m: displacement of the obstacle in the step */
    double plane;     /* m: offset at the end of the step, limited by pushSpeed */
    double lowered;   /* m: distance of that plane below the obstacle's surface */
    double out;       /* m: upper limit of the distance by which the plane lifts the point out of the obstacle */
    kiriVec3 held;    /* N: friction of the last step, which keeps sticking points from creeping */
    bool isActive, sticks;
    double limit;           /* N: friction limit while slipping */
    kiriVec3 direction;     /* of the slide: unit or zero */
    double known;           /* N: largest push in any system so far; of a soft contact, the expected or last one */
    double stiffness, grip; /* N/m: springs on depth and slide */
    double give;            /* m/N: compliance of the obstacle in the step */
    double depth, sinks;    /* m: depth at assembly, and its change by the whole solution */
    kiriVec3 slide, slides; /* m: slide at assembly, and its change by the whole solution */
    /* Soft contacts only. */
    double soft, mostStiffness; /* m: the softness; N/m */
    double was;                 /* N: push in the last step */
    double spring, tie;         /* N/m: springs on depth and slide in this system */
    double pull;                /* N: push at assembly */
    kiriVec3 drags;             /* N: friction at assembly */
    double solved;          /* N: push after the last system, before the body was held up */
    double push;            /* N: push after the systems solved so far */
    double change;          /* N: of the push by the last system */
    kiriVec3 drag;          /* N: friction after the systems solved so far */
} kiriContactStep;

/* Objects that act on a body, apart from gravity and the host's forces. */
typedef enum kiriSupport {
    KIRI_SUPPORT_NONE,     /* nothing: momentum is conserved */
    KIRI_SUPPORT_CONTACTS, /* contacts alone */
    KIRI_SUPPORT_HELD      /* pins, clamps, holds or wind */
} kiriSupport;

/* Newton's iteration. */
typedef struct kiriSearch {
    kiriStepEnergy start, now; /* at the start of the step, and at the current iterate */
    double noise;              /* J: rounding error of the objective */
    double scale;              /* part of the Gauss-Newton step to try, 0 to 1 */
    double enough;             /* J: the try succeeds if the objective is not larger */
    double promise;            /* J: decrease of the objective by the whole Gauss-Newton step, if it were quadratic */
    int32_t wanted;            /* minimum number of systems */
    int32_t solved;            /* systems solved since the iteration started */
    int32_t suspects;          /* consecutive Gauss-Newton steps that gained too much energy */
    bool isFirst;              /* the next Gauss-Newton step is the first */
    bool isTaken;              /* a part of the last Gauss-Newton step was taken: the strains belong to the poses */
    bool mayFlow;              /* links yield; the first iterations are elastic */
} kiriSearch;

#define KIRI_SPARE_MEANS 0.05 /* of kiriContactSum.means: rounding and rest gain less */

/* The contacts of a body together. */
typedef struct kiriContactSum {
    bool isNear;       /* some contacts can push */
    bool hasFar;       /* some contacts were far at the start */
    bool isPlaced;     /* points of contacts belong to the poses */
    bool isUnsettled;  /* some contacts need another system */
    bool isHeldUp;     /* frames were moved up to planes after the last system */
    double means;      /* J: allowance of the stored energy beyond its value at the start */
    double keepForces; /* factor of every contact force, 0 to 1 */
} kiriContactSum;

/* Energies after the step, J. */
typedef struct kiriEnergyStep {
    double kinetic; /* kinetic energy without the mean velocity */
    double turning; /* part of `kinetic`: rotation as one body */
    double moving;  /* kinetic energy of the mean velocity */
    double gain;    /* increase of energy in the step beyond work */
    double owed;    /* by obstacles: the part that a body with pins could not give from its velocities */
} kiriEnergyStep;

/* A connected piece of a sheet, solved as one system. Spans index arrays of kiriSolverBodies. */
typedef struct kiriSolverBody {
    kiriSpan frames, links, corners, elements;
    kiriMatrix* matrix;
    bool ownsMatrix; /* while staged: the matrix is new, not taken from a committed body */
    bool isMoved;
    int32_t pin, clamp, contact; /* first row of each kind in the tick, or KIRI_NONE */
    int32_t contactCount;
    int32_t island; /* scratch: its first frame in the island that contains it */
} kiriSolverBody;

/* All bodies of a sheet, with the indices of their pieces. The items of a body are contiguous, in the order of the
   sheet. */
typedef struct kiriSolverBodies {
    KIRI_ARRAY(kiriSolverBody) bodies;
    kiriIndices bodyOf, place;        /* per frame of the sheet: its body, and its index in the body */
    kiriIndices frames, links;        /* indices of the sheet */
    KIRI_ARRAY(kiriLink) ownLinks;    /* refer to frames of the body */
    KIRI_ARRAY(kiriCorner) corners;   /* refer to links of the body */
    kiriAreaElements areaElements;    /* refer to frames of the body; shares in the order of the sheet */
} kiriSolverBodies;

/* The obstacles of a step that have a mass, and what couples them with the frames. */
typedef struct kiriRecoil {
    KIRI_ARRAY(kiriYieldRow*) bodies;
    /* border: a column of the matrix for each unknown of an obstacle; corner: their own block; pull: right-hand side, then
       solution. */
    kiriReals border, corner, pull, right;
    double promise; /* J: share of kiriSearch.promise */
} kiriRecoil;

struct kiriSolver {
    kiriMemory* memory;
    kiriMechanics mechanics;
    int32_t size; /* unknowns per frame */
    kiriUnknown unknowns[KIRI_MOST_UNKNOWNS];
    int32_t solved; /* linear systems since TakeSolved */
    int64_t allWork; /* work of one system of each body, without contacts */
    kiriSolverBodies bodies, next; /* committed; staged */
    bool isStaged;
    kiriMoved moved;
    KIRI_ARRAY(kiriPair) pairs;                  /* scratch: of a staged body */
    kiriIndices linkPlace;                       /* scratch: per staged link, its index in its body */
    kiriIndices itemBody, order;                 /* scratch: of staged items */
    kiriIndices nextPin, nextClamp;              /* per row: next row of the same body, or KIRI_NONE */

    /* State of the body that steps. Arrays have room for the largest body, committed or staged. */
    int64_t mostElements; /* of a body, without clamps */
    kiriMatrix* matrix;
    const kiriIslandBody* islandBodies;
    int32_t islandCount;
    KIRI_ARRAY(kiriFrameData*) sources; /* per frame: the frame of its sheet */
    KIRI_ARRAY(const kiriMaterial*) materials;
    KIRI_ARRAY(const kiriAir*) airs;
    KIRI_ARRAY(kiriLink) islandLinks;     /* if there are several bodies, copies of theirs */
    KIRI_ARRAY(kiriCorner) islandCorners;
    kiriAreaElements islandElements;
    double dt; /* s, h of this step */
    int32_t elementCount;
    bool isAlong;   /* poses lie on the Gauss-Newton step of the last system */
    bool isHeld;    /* the host holds a frame */
    bool isPut;     /* the host moves a held frame, so the strains at `start` are not startStrain */
    bool isTouched; /* a contact acts in this step, or a hold carries the body */
    bool yields;    /* the material may flow */
    kiriSupport support;
    kiriStepping stepping;
    kiriSearch search;
    kiriContactSum touch;
    kiriEnergyStep energy;
    kiriPieceMomentum momentum;
    kiriAreaElements areaElements; /* of the body */
    KIRI_ARRAY(kiriPinRow) pins;
    KIRI_ARRAY(kiriClampRow) clamps;
    KIRI_ARRAY(kiriClampRow*) clampRows; /* per clamp: its row in the sheet */
    KIRI_ARRAY(kiriContactStep) contacts;
    kiriRecoil recoil;
    KIRI_ARRAY(kiriLinkPart) linkParts;
    KIRI_ARRAY(kiriStrainOffset) strainOffsets;
    KIRI_ARRAY(kiriPlastic) plastics;
    KIRI_ARRAY(kiriYield) flows;
    KIRI_ARRAY(kiriPlasticRegion) regions;
    /* Flattened if the sheet is planar. Velocities include the air damping. */
    KIRI_ARRAY(kiriFrameData) before, after;
    KIRI_ARRAY(kiriPrediction) predictions;   /* one a frame */
    KIRI_ARRAY(kiriPose) start, poses, trial; /* one a frame: at the start of the step, current, and tried */
    kiriReals turns; /* scratch, one a frame: since the start, upper limit of the change of a unit vector in its plane */
    /* KIRI_MOST_STRAINS an element: stiffness, damping, and strains at the start of the step. */
    kiriReals stiffness, loss, startStrain;
    /* Results of the last measurement: strains, which corners read for their links, and derivatives of these strains by
       the unknowns of both ends of a link. */
    kiriReals nowStrain, tracedRows;
    kiriReals force, move; /* right-hand side (minus the gradient), and solution */
    kiriFlags stopping;    /* per element: 1 if a tried step would have reached its normal stop */
    /* Scratch for one element. */
    kiriIndices members;
    KIRI_ARRAY(kiriFrameRow) rows;
    kiriReals J;
};

/* ---- Unknowns (kiri_solver.c) ---- */

/* Reduce converts a derivative by the vectors of a frame to one by the unknowns. Expand converts unknowns, times
   `scale`, to vectors. */
void kiriSolver_Reduce(const kiriSolver* solver, const kiriFrameRow* row, double* values);
kiriFrameRow kiriSolver_Expand(const kiriSolver* solver, double scale, const double* values);

/* Returns the part of a vector in the plane of a planar sheet. */
kiriVec3 kiriMechanics_InPlane(const kiriMechanics* mechanics, kiriVec3 a);
kiriVec3 kiriSystem_Gravity(const kiriSystem* system);

/* ---- Begin of a step (kiri_step.c) ---- */

/* Opens an island for a step and returns its system. kiriSolver_Begin fills in the frames. */
kiriSystem kiriSolver_Open(kiriSolver* solver, const kiriIslandBody* bodies, int32_t count, kiriMatrix* matrix);

/* Returns the material, and the air, of a frame. */
static inline const kiriMaterial* kiriSystem_MaterialOf(const kiriSystem* system, int32_t frame)
{
    KIRI_ASSERT(frame >= 0 && frame < system->frameCount);
    return system->materials != NULL ? system->materials[frame] : &system->material;
}

/* Returns the offset of plane bending of a link between rigid frames. */
static inline double kiriSystem_Turned(const kiriSystem* system, const kiriLink* link)
{
    return system->strainOffsets != NULL ? system->strainOffsets[link - system->links].strain[KIRI_PLANE_BENDING] : 0.0;
}

static inline const kiriAir* kiriSystem_AirOf(const kiriSystem* system, int32_t frame)
{
    return system->airs != NULL ? system->airs[frame] : system->air;
}

/* Copies the frames from the sheet, chooses the scheme, predicts, and clears the other state. */
void kiriSolver_Begin(kiriSolver* solver, const kiriSystem* system, double dt);

/* Returns true if contacts touch a point at these poses. */
bool kiriSolver_AreTouching(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);

/* ---- Objective ---- */

/* Return a material point: relative to its frame's x, and in world space. */
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

/* Adds the squares of `rows` strains. J: their derivatives by the unknowns, grouped by frame. */
void kiriSolver_AddSquares(kiriSolver* solver, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* springs, const double* pulls, int rows);

/* Assembles the linear system of a Gauss-Newton step from the poses, and returns the objective there. */
kiriStepEnergy kiriSolver_Assemble(kiriSolver* solver, const kiriSystem* system);

/* ---- Wind (kiri_step.c) ---- */

static inline bool kiriAir_Blows(const kiriAir* air)
{
    return air != NULL && air->density > 0.0 && (air->drag > 0.0 || air->lift > 0.0);
}

bool kiriSystem_HasWind(const kiriSystem* system);

/* Returns the work of the wind on a frame in the step, J. Requires solver->after. */
double kiriWind_Work(const kiriSolver* solver, const kiriSystem* system, int32_t f);

/* ---- Newton iteration ---- */

/* Iterates to the minimum. Returns the number of linear systems solved, or -1 if one has no solution. */
int32_t kiriSolver_Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, int32_t most);

/* ---- Limit of energy (kiri_energy.c) ---- */

/* Moves a free body so that its centre of mass is at the predicted place. */
void kiriSolver_CenterBody(kiriSolver* solver, const kiriSystem* system);

/* Computes the frames after the step from the current poses, and the energy that the body gained. Centers a free body
   and gives it the angular momentum that is due. */
void kiriSolver_FindGains(kiriSolver* solver, const kiriSystem* system);

/* Returns the largest energy that the limit can take out of the velocities, J. */
double kiriSolver_MostTaken(const kiriSolver* solver);

/* Takes the energy gain of the body out of its velocities. */
void kiriSolver_LimitEnergy(kiriSolver* solver, const kiriSystem* system);

/* ---- Contacts (kiri_contact_row.c) ---- */

static inline bool kiriContact_IsMutual(const kiriContactStep* step)
{
    return step->row->other != NULL;
}

/* BeginContacts makes the contacts of the island: planes and points for a step. GuessContacts guesses their initial
   state, after the scheme and the prediction are set. */
void kiriSolver_BeginContacts(kiriSolver* solver, const kiriSystem* system);

/* Prepares the far contacts that these poses may bring to their planes. Call it before contacts are used at other poses. */
void kiriSolver_FindNear(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses);

#define KIRI_EACH_NEAR(step, solver)                                                                                   \
    KIRI_EACH(kiriContactStep, step, (solver)->contacts)                                                               \
        if (!(step)->isFar)

void kiriSolver_GuessContacts(kiriSolver* solver, const kiriSystem* system);

/* Return the position of the point, blended from the members, and its depth below the plane. */
kiriVec3 kiriContact_Point(const kiriSystem* system, const kiriContactStep* step, const kiriPose* poses);
double kiriContact_Depth(const kiriSystem* system, const kiriContactStep* step, const kiriPose* poses);

/* Finds the points of near contacts at solver->poses, unless these have not changed since. */
void kiriSolver_PlaceContacts(kiriSolver* solver, const kiriSystem* system);

/* Linearize sets springs, depths and slides before a system is assembled. MoveContacts sets their changes after the
   system is solved. */
void kiriSolver_LinearizeContacts(kiriSolver* solver, const kiriSystem* system);
void kiriContact_Assemble(kiriSolver* solver, const kiriSystem* system, const kiriContactStep* step);
void kiriSolver_MoveContacts(kiriSolver* solver, const kiriSystem* system);

/* Returns the contribution of the contact to the objective, by its linear model along the step. */
double kiriContact_Energy(const kiriSolver* solver, const kiriSystem* system, kiriContactStep* step, const kiriPose* poses);

/* Finds the contact forces after a Gauss-Newton step and chooses the state of contacts for the next system. */
void kiriSolver_ReviewContacts(kiriSolver* solver, const kiriSystem* system);

/* Moves points that are still deep below planes back up after the last system, frame by frame. Counts the moves as pushes. */
void kiriSolver_HoldContacts(kiriSolver* solver, const kiriSystem* system);

/* Returns the force on the sheet, within the friction cone, N. */
kiriVec3 kiriContact_Force(const kiriSolver* solver, const kiriContactStep* step);

/* Returns the upper limit of the obstacle's work, J. Adds the work of a soft contact that pushes a point out to
   `lifting`. */
double kiriContact_Work(const kiriSolver* solver, const kiriContactStep* step, double* lifting);

/* Writes forces and impulses of the step to the contact rows, and impulses to the yield rows. */
void kiriSolver_EndContacts(kiriSolver* solver, const kiriSystem* system);

/* ---- Points of several frames (kiri_contact_row.c) ---- */

/* Springs on a point along three axes, and what each pulls with. */
enum { KIRI_POINT_ROWS = 3 };
typedef struct kiriPointSprings {
    kiriVec3 axis[KIRI_POINT_ROWS];
    double spring[KIRI_POINT_ROWS], pull[KIRI_POINT_ROWS];
    const kiriContactStep* contact; /* with an obstacle in the system, or null */
    double share;                   /* sum of the members' weights: springs are divided by it */
} kiriPointSprings;

/* Adds the springs to the system. A frame may carry both points. ways[]: springs on the blend of these vectors of the
   material (u, v, normal), one a member; null: on the point. */
void kiriSolver_AddPointSprings(kiriSolver* solver, const kiriSystem* system, const kiriContactMember* members,
                                int32_t count, const kiriVec3* ways, const kiriPointSprings* at);

/* ---- Obstacles with a mass (kiri_recoil.c) ----

   An obstacle that soft contacts touch has six unknowns in the system, and is in the line search. They are solved last: so
   the pattern of the frames does not change. The cost grows with the square of their number, so only the heaviest
   KIRI_MOST_RECOILING of a system have them. Contacts with others are hard. */

/* Choose begins a step: it may give unknowns to the obstacle of this row. Join lists the obstacle of a contact. */
void kiriRecoil_Choose(kiriYieldRow* row, kiriYieldRow** chosen, int32_t* count);
void kiriRecoil_Join(kiriSolver* solver, kiriContactStep* step);

/* Return the way of the obstacle at the contact beyond its velocity, m: at the poses that are tried; by the last system. */
kiriVec3 kiriRecoil_Way(const kiriContactStep* step);
kiriVec3 kiriRecoil_Move(const kiriContactStep* step);

/* Begin sets all unknowns to 0. Clear begins a system. AddSprings adds springs of a contact; J: the derivatives for the
   frames; share: of the members, by weight. Solve solves the whole system, and fails if it has no factor. Try sets the
   unknowns to a part of the solution; Take keeps them. */
void kiriRecoil_Begin(const kiriSolver* solver);
void kiriRecoil_Clear(kiriSolver* solver, int32_t frameCount);
void kiriRecoil_AddSprings(kiriSolver* solver, const kiriSystem* system, const int32_t* frames, int32_t frameCount,
                           const double* J, const kiriPointSprings* at);
bool kiriRecoil_Solve(kiriSolver* solver, int32_t frameCount);
void kiriRecoil_Try(const kiriSolver* solver, double part);
void kiriRecoil_Take(const kiriSolver* solver);

/* Returns the inertia of the obstacles in the objective, J. */
double kiriRecoil_Energy(const kiriSolver* solver);

/* Returns the move of a point by the solution, to first order. */
kiriVec3 kiriSolver_MoveOf(const kiriSolver* solver, const kiriSystem* system, const kiriContactMember* members,
                           int32_t count);

/* Returns the position of a point that is blended from frames by these weights. */
kiriVec3 kiriSystem_Blend(const kiriSystem* system, const kiriContactMember* members, int32_t count,
                          const kiriPose* poses);

/* ---- Stitches ----

   A stitch is an elastic energy of the objective, like an element: 1/2 k |a - b - off|^2, with a and b its points. Its
   force is an inner one, so bodies that stitches join keep their momentum, without a lag. */

#define KIRI_EACH_STITCH(row, system) for (kiriStitchRow* row = (system)->stitches; row != NULL; row = row->next)

double kiriStitches_Energy(const kiriSystem* system, const kiriPose* poses);
double kiriStitches_Noise(const kiriSolver* solver, const kiriSystem* system);
void kiriStitches_Assemble(kiriSolver* solver, const kiriSystem* system);

/* After a system is solved: find the forces of its linear model, and take them as far as the step was taken. Forces at
   poses of stiff springs are wrong by what turned frames leave. */
void kiriStitches_Solve(const kiriSolver* solver, const kiriSystem* system);
void kiriStitches_TakeForces(const kiriSolver* solver, const kiriSystem* system);

/* Returns the moment of the hinge on a member, N m. */
kiriVec3 kiriStitch_Moment(const kiriStitchRow* row, int32_t member, const kiriPose* poses);

/* ---- Reactions (kiri_step.c) ---- */

/* Returns the impulse that changed a frame's momentum in the step, without gravity and the host's force, N s. */
kiriVec3 kiriSolver_GainOf(const kiriSolver* solver, const kiriSystem* system, int32_t f);

/* Adds the impulses of pins, clamps and holds in the step to their reactions. Call it after EndContacts. */
void kiriSolver_EndReactions(kiriSolver* solver, const kiriSystem* system);

KIRI_C_END

#endif
