/* Backward Euler as a minimisation over the poses of the frames at the end of the step. The objective is

       1/2 sum over mass points of m |x - x*|^2 / dt^2,  x* where the free prediction ends
     + energies of links (strain.h, affine.h), patches (patch.h), pins and contacts
     + flex damping: 1/2 k (flexDamping / dt) (strain - strain at the start of the step)^2 for each strain.

   All are squares, so a Gauss-Newton step solves with J^T k J + mass: positive definite by itself, with a pattern that
   only the links and patches decide. The order of summation is fixed. */
#include "kiri_solver.h"

#include "kiri_affine.h"
#include "kiri_block_factor.h"
#include "kiri_momentum.h"
#include "kiri_strain.h"

#include <float.h>
#include <string.h>

#define LONGEST_TURN 1.0              /* of a frame in one Gauss-Newton step: a Cayley vector */
#define HALVINGS 12                   /* of a step that does not lower the objective */
#define SECOND_CHANCES 4              /* more iterations where energy is gained or the objective ends too high, */
#define FRESH_STARTS 2                /* and iterations from the start of the step should they fail */
#define SHORT_STEP 0.3                /* a step of which no more than this is taken is not the last one */
#define WORTHWHILE 1e-6               /* of the objective, where a longer one would lower it by more */
#define MOST_BRAKED 0.5               /* of the kinetic energy, where a piece need not start anew */
#define ROUNDING 1e-12                /* of an objective, relative */
#define LAST_BITS (8.0 * DBL_EPSILON) /* of a length: what a few operations round off */
#define SLIDE_FLOOR 1e-9              /* m: a shorter way is no slide */

/* A link or patch has at most so many strains. */
enum { MOST_ROWS = (int)KIRI_STRAINS > (int)KIRI_AFFINE_STRAINS ? (int)KIRI_STRAINS : (int)KIRI_AFFINE_STRAINS };

/* By how much something changes with a frame: its move and its turn if it is rigid, else x and the columns of A. */
typedef struct Slots {
    kiriVec3 by[4];
} Slots;

/* One of a frame's unknowns: the part of a slot along an axis. */
typedef struct Unknown {
    int slot, number; /* of the axis */
    kiriVec3 axis;
} Unknown;

typedef KIRI_ARRAY(int32_t) Indices;

/* The objective, and what of it is energy that the sheet has: the rest is lost, or the inertia's. */
typedef struct Energy {
    double objective, potential;
} Energy;

/* The step of one piece. Pieces share no links, so each goes its own way, and none waits for another. */
typedef struct Course {
    Energy sum;            /* what was evaluated last */
    Energy start, now;     /* where the step starts, and where the iteration is */
    double noise;          /* J: what rounding leaves unknown of the objective */
    double kinetic;        /* J: after the step, beside that of the mean velocity */
    double gain;           /* J: what the energy grows by in the step beyond work */
    double scale, enough;  /* of the step that is tried, and the objective that it has to reach */
    double promise;        /* J: by how much the whole of it would lower the objective, were that quadratic */
    double keep, keepMean; /* of velocities that are braked: of their difference from the mean, and of that */
    kiriVec3 mean;         /* by mass, over its frames: of velocities, or of ways to go */
    double mass;
    bool isFree;     /* do only gravity and forces act on it? */
    bool isIterated; /* does the iteration go on? */
    bool isSought;   /* is a step sought that lowers the objective? */
} Course;

struct kiriSolver {
    kiriMemory* memory;
    kiriMechanics mechanics;
    double dt, damping; /* of this step; flexDamping / dt */
    bool isBraking;
    bool isHeld;  /* does the host move a frame? */
    int32_t size; /* unknowns a frame */
    Unknown unknowns[KIRI_MOST_UNKNOWNS];
    kiriMatrix *matrix, *nextMatrix; /* now, and room for the next pattern */
    Indices piece, nextPiece;        /* a frame's piece: what elements hold together */
    int32_t pieceCount, nextPieceCount;
    bool isStaged, isNextMatrix; /* is there a next configuration, and has it a pattern of its own? */
    int64_t renewals;            /* of the pattern */
    int64_t restarts;            /* of pieces */
    KIRI_ARRAY(kiriPair) pairs;  /* scratch: of the next configuration */
    /* Room for the larger of the two configurations. */
    KIRI_ARRAY(kiriPieceMomentum) pieces;
    KIRI_ARRAY(Course) courses;
    KIRI_ARRAY(kiriFrameData) before, after;  /* the step, flattened where the sheet is planar */
    KIRI_ARRAY(kiriPrediction) predictions;   /* one a frame, as are the poses */
    KIRI_ARRAY(kiriPose) start, poses, trial; /* at the start of the step, now, and where a step would lead */
    KIRI_ARRAY(double)
    stiffness, loss, startStrain;   /* MOST_ROWS an element; damping, and strains at the start of the step */
    KIRI_ARRAY(double) force, move; /* the right side: minus the gradient; and the solution */
    KIRI_ARRAY(uint8_t) stopping;   /* would a step have brought this element to its stop? */
    /* Scratch for one element. */
    Indices members;
    KIRI_ARRAY(kiriAffineRow) rows;
    KIRI_ARRAY(double) J;
};

int64_t kiriSolver_Restarts(const kiriSolver* solver)
{
    return solver->restarts;
}

static bool IsAffine(const kiriMechanics* mechanics)
{
    return mechanics->model != KIRI_MODEL_LINKS;
}

/* ---- Elements: links, then patches ------------------------------------------------------------------------------ */

static int32_t LinkElements(const kiriMechanics* mechanics, int32_t linkCount)
{
    return mechanics->model == KIRI_MODEL_POINTS ? 0 : linkCount;
}

static int32_t PatchElements(const kiriPatches* patches)
{
    return patches != NULL ? patches->patches.count : 0;
}

static int32_t ElementCount(const kiriSystem* system)
{
    return LinkElements(&system->mechanics, system->linkCount) + PatchElements(system->patches);
}

static const kiriLink* LinkOf(const kiriSystem* system, int32_t k)
{
    return k < LinkElements(&system->mechanics, system->linkCount) ? &system->links[k] : NULL;
}

static const kiriPatch* PatchOf(const kiriSystem* system, int32_t k)
{
    return &system->patches->patches.data[k - LinkElements(&system->mechanics, system->linkCount)];
}

/* Strains that can be other than zero. */
static int RowCount(const kiriSystem* system, int32_t k)
{
    bool planar = system->mechanics.planar;
    if (LinkOf(system, k) == NULL) {
        return PatchOf(system, k)->lastRow - PatchOf(system, k)->firstRow;
    }
    return IsAffine(&system->mechanics) ? (planar ? KIRI_AFFINE_BENDING : KIRI_AFFINE_STRAINS)
                                        : (planar ? KIRI_PLANE_BENDING + 1 : KIRI_STRAINS);
}

/* Writes the frames of an element, and returns how many there are. */
static int32_t MembersOf(const kiriSystem* system, int32_t k, int32_t* members)
{
    const kiriLink* link = LinkOf(system, k);
    if (link != NULL) {
        members[0] = link->i;
        members[1] = link->j;
        return 2;
    }
    const kiriPatch* patch = PatchOf(system, k);
    for (int32_t m = 0; m < patch->count; ++m) {
        members[m] = system->patches->shares.data[patch->first + m].frame;
    }
    return patch->count;
}

static void StiffnessOf(const kiriSystem* system, int32_t k, double* stiffness)
{
    const kiriLink* link = LinkOf(system, k);
    if (link == NULL) {
        kiriPatch_Stiffness(PatchOf(system, k), &system->material, stiffness);
    } else if (IsAffine(&system->mechanics)) {
        kiriAffine_Stiffness(link, &system->material, stiffness);
    } else {
        kiriStrain_Stiffness(link, &system->material, stiffness);
    }
}

static void MeasureRigid(const kiriLink* link, const kiriFrameData* const frames[2], const kiriPose* const poses[2],
                         double* strain, kiriAffineRow* rows)
{
    kiriStrainRow found[KIRI_STRAINS];
    kiriStrain_Measure(link, frames, poses, strain, rows != NULL ? found : NULL);
    for (int e = 0; rows != NULL && e < KIRI_STRAINS; ++e) {
        for (int end = 0; end < 2; ++end) {
            rows[2 * e + end].by[0] = found[e].end[end].move;
            rows[2 * e + end].by[1] = found[e].end[end].turn;
        }
    }
}

/* The part of a strain that pulls. */
static double Pulling(const kiriSystem* system, int32_t k, int e, double strain)
{
    bool strainOffsets = system->strainOffsets != NULL && k < system->linkCount && !IsAffine(&system->mechanics);
    double eased = strainOffsets ? system->strainOffsets[k].strain[e] : 0.0;
    if (e == KIRI_NORMAL_STOP && strainOffsets) {
        double over = fabs(strain) - fabs(eased); /* it only pushes */
        return over <= 0.0 ? 0.0 : strain > 0.0 ? over : -over;
    }
    return strain - eased;
}

/* The strains and, unless `rows` is null, their derivatives: one a strain and frame. */
static void Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain, kiriAffineRow* rows)
{
    const kiriLink* link = LinkOf(system, k);
    if (link == NULL) {
        kiriPatch_Measure(PatchOf(system, k), system->patches->shares.data, system->frames, poses, strain, rows);
        return;
    }
    const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
    const kiriPose* const ends[2] = { &poses[link->i], &poses[link->j] };
    if (IsAffine(&system->mechanics)) {
        kiriAffine_Measure(link, frames, ends, strain, (kiriAffineRow(*)[2])rows);
    } else {
        MeasureRigid(link, frames, ends, strain, rows);
    }
}

/* The same at the frames' own poses, the strains alone. */
static void MeasureFrames(const kiriSystem* system, int32_t k, double* strain)
{
    const kiriLink* link = LinkOf(system, k);
    if (link == NULL) {
        kiriPatch_Measure(PatchOf(system, k), system->patches->shares.data, system->frames, NULL, strain, NULL);
        return;
    }
    const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
    const kiriPose now[2] = { kiriPose_Of(frames[0]), kiriPose_Of(frames[1]) };
    const kiriPose* const ends[2] = { &now[0], &now[1] };
    if (IsAffine(&system->mechanics)) {
        kiriAffine_Measure(link, frames, ends, strain, NULL);
    } else {
        kiriStrain_Measure(link, frames, ends, strain, NULL);
    }
}

/* ---- Unknowns --------------------------------------------------------------------------------------------------- */

static void ChooseUnknowns(kiriSolver* solver, const kiriMechanics* mechanics)
{
    const kiriVec3 space[3] = { { 1.0, 0.0, 0.0 }, { 0.0, 1.0, 0.0 }, { 0.0, 0.0, 1.0 } };
    const kiriVec3 plane[3] = { mechanics->axes.u, mechanics->axes.v, mechanics->axes.d };
    bool affine = IsAffine(mechanics), planar = mechanics->planar;
    int slots = !affine ? 2 : planar ? 3 : 4;
    solver->size = 0;
    for (int slot = 0; slot < slots; ++slot) {
        for (int axis = 0; axis < 3; ++axis) {
            /* In the plane, a rigid frame turns about the normal; nothing else leaves along it. */
            bool turns = !affine && slot == 1;
            if (!planar || (axis == 2) == turns) {
                Unknown unknown = { slot, axis, planar ? plane[axis] : space[axis] };
                solver->unknowns[solver->size++] = unknown;
            }
        }
    }
}

static void Reduce(const kiriSolver* solver, const kiriVec3* slots, double* values)
{
    if (!solver->mechanics.planar) {
        memcpy(values, slots, sizeof(double) * (size_t)solver->size); /* the axes of space */
        return;
    }
    for (int32_t n = 0; n < solver->size; ++n) {
        values[n] = kiriVec3_Dot(slots[solver->unknowns[n].slot], solver->unknowns[n].axis);
    }
}

static Slots Expand(const kiriSolver* solver, double scale, const double* values)
{
    Slots slots;
    memset(&slots, 0, sizeof(slots));
    if (!solver->mechanics.planar) {
        for (int32_t n = 0; n < solver->size; n += 3) {
            slots.by[n / 3] = kiriVec3_Make(scale * values[n], scale * values[n + 1], scale * values[n + 2]);
        }
        return slots;
    }
    for (int32_t n = 0; n < solver->size; ++n) {
        kiriVec3* by = &slots.by[solver->unknowns[n].slot];
        *by = kiriVec3_AddScaled(*by, scale * values[n], solver->unknowns[n].axis);
    }
    return slots;
}

/* ---- Making ----------------------------------------------------------------------------------------------------- */

kiriSolver* kiriSolver_Create(kiriMemory* memory, const kiriMechanics* mechanics)
{
    kiriSolver* solver = kiriMemory_AllocZeroed(memory, sizeof(kiriSolver));
    if (solver == NULL) {
        return NULL;
    }
    solver->memory = memory;
    solver->mechanics = *mechanics;
    ChooseUnknowns(solver, mechanics);
    solver->matrix = kiriMatrix_Create(memory, solver->size);
    solver->nextMatrix = kiriMatrix_Create(memory, solver->size);
    return solver->matrix != NULL && solver->nextMatrix != NULL ? solver : NULL;
}

/* ---- Staging ---------------------------------------------------------------------------------------------------- */

static int32_t MostMembers(const kiriPatches* patches)
{
    int32_t most = 2;
    for (int32_t k = 0; k < PatchElements(patches); ++k) {
        most = patches->patches.data[k].count > most ? patches->patches.data[k].count : most;
    }
    return most;
}

/* Only scratch, so that nothing is lost by growing. */
static bool MakeRoom(kiriSolver* solver, int32_t frameCount, int32_t elementCount, int32_t most)
{
    kiriMemory* memory = solver->memory;
    int64_t unknowns = (int64_t)solver->size * frameCount, rows = (int64_t)MOST_ROWS * most;
    return kiriArray_Reserve(memory, &solver->nextPiece, frameCount) &&
           kiriArray_Reserve(memory, &solver->pieces, frameCount) &&
           kiriArray_Reserve(memory, &solver->courses, frameCount) &&
           kiriArray_Reserve(memory, &solver->before, frameCount) &&
           kiriArray_Reserve(memory, &solver->after, frameCount) &&
           kiriArray_Reserve(memory, &solver->predictions, frameCount) &&
           kiriArray_Reserve(memory, &solver->start, frameCount) &&
           kiriArray_Reserve(memory, &solver->poses, frameCount) &&
           kiriArray_Reserve(memory, &solver->trial, frameCount) &&
           kiriArray_Reserve(memory, &solver->stiffness, (int64_t)MOST_ROWS * elementCount) &&
           kiriArray_Reserve(memory, &solver->loss, (int64_t)MOST_ROWS * elementCount) &&
           kiriArray_Reserve(memory, &solver->startStrain, (int64_t)MOST_ROWS * elementCount) &&
           kiriArray_Reserve(memory, &solver->stopping, elementCount) &&
           kiriArray_Reserve(memory, &solver->force, unknowns) && kiriArray_Reserve(memory, &solver->move, unknowns) &&
           kiriArray_Reserve(memory, &solver->members, most) && kiriArray_Reserve(memory, &solver->rows, rows) &&
           kiriArray_Reserve(memory, &solver->J, rows * solver->size);
}

static bool CollectPairs(kiriSolver* solver, const kiriSystem* system)
{
    solver->pairs.count = 0;
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        int32_t* members = solver->members.data;
        int32_t count = MembersOf(system, k, members);
        for (int32_t b = 1; b < count; ++b) {
            for (int32_t a = 0; a < b; ++a) {
                kiriPair pair = { members[a], members[b] };
                if (!kiriArray_Push(solver->memory, &solver->pairs, pair)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* Numbers the pieces by their lowest frame. */
static void FindPieces(kiriSolver* solver, int32_t frameCount)
{
    int32_t *piece = solver->nextPiece.data, count = 0;
    for (int32_t f = 0; f < frameCount; ++f) {
        piece[f] = f; /* first: a lower frame of the same piece, or itself */
    }
    for (int32_t k = 0; k < solver->pairs.count; ++k) {
        int32_t a = solver->pairs.data[k].a, b = solver->pairs.data[k].b;
        while (piece[a] != a) {
            a = piece[a] = piece[piece[a]];
        }
        while (piece[b] != b) {
            b = piece[b] = piece[piece[b]];
        }
        piece[a > b ? a : b] = a > b ? b : a;
    }
    for (int32_t f = 0; f < frameCount; ++f) {
        piece[f] = piece[f] == f ? count++ : piece[piece[f]];
    }
    solver->nextPieceCount = count;
}

/* Does the pattern that is there have a block for every pair? */
static bool IsCovered(const kiriSolver* solver, int32_t frameCount)
{
    bool covered = kiriMatrix_FrameCount(solver->matrix) == frameCount;
    for (int32_t k = 0; covered && k < solver->pairs.count; ++k) {
        covered = kiriMatrix_Covers(solver->matrix, solver->pairs.data[k]);
    }
    return covered;
}

/* Regions that came apart may meet again as a blade goes round: a new pattern keeps the pairs of the old one, unless
   they are too many. */
static bool KeepPairs(kiriSolver* solver, int32_t frameCount)
{
    int32_t own = solver->pairs.count, old = kiriMatrix_PairCount(solver->matrix);
    if (kiriMatrix_FrameCount(solver->matrix) != frameCount || old > 2 * own) {
        return true;
    }
    if (!kiriArray_Resize(solver->memory, &solver->pairs, (int64_t)own + old)) {
        return false;
    }
    kiriMatrix_GetPairs(solver->matrix, solver->pairs.data + own);
    return true;
}

bool kiriSolver_Stage(kiriSolver* solver, int32_t frameCount, const kiriLink* links, int32_t linkCount,
                      const kiriPatches* patches)
{
    kiriSystem system;
    memset(&system, 0, sizeof(system));
    system.mechanics = solver->mechanics;
    system.frameCount = frameCount;
    system.links = links;
    system.linkCount = linkCount;
    system.patches = patches;
    solver->isStaged = false;
    if (!MakeRoom(solver, frameCount, ElementCount(&system), MostMembers(patches)) || !CollectPairs(solver, &system)) {
        return false;
    }
    FindPieces(solver, frameCount);
    solver->isNextMatrix = !IsCovered(solver, frameCount);
    solver->isStaged = !solver->isNextMatrix ||
                       (KeepPairs(solver, frameCount) &&
                        kiriMatrix_Shape(solver->nextMatrix, frameCount, solver->pairs.data, solver->pairs.count));
    return solver->isStaged;
}

void kiriSolver_Commit(kiriSolver* solver)
{
    if (!solver->isStaged) {
        return;
    }
    Indices piece = solver->piece;
    solver->piece = solver->nextPiece;
    solver->nextPiece = piece;
    solver->pieceCount = solver->nextPieceCount;
    if (solver->isNextMatrix) {
        kiriMatrix* matrix = solver->matrix;
        solver->matrix = solver->nextMatrix;
        solver->nextMatrix = matrix;
        ++solver->renewals;
    }
    solver->isStaged = false;
}

uint64_t kiriSolver_Hash(const kiriSolver* solver)
{
    return kiriMatrix_Hash(solver->matrix);
}

int64_t kiriSolver_Renewals(const kiriSolver* solver)
{
    return solver->renewals;
}

/* ---- Objective -------------------------------------------------------------------------------------------------- */

/* A material point as seen from its frame's x. */
static kiriVec3 ArmOf(const kiriSystem* system, int32_t frame, kiriVec2 at, const kiriPose* pose)
{
    return kiriPose_Along(pose, kiriVec2_Sub(at, system->frames[frame].center));
}

static kiriVec3 PointOf(const kiriSystem* system, int32_t frame, kiriVec2 at, const kiriPose* poses)
{
    return kiriVec3_Add(poses[frame].x, ArmOf(system, frame, at, &poses[frame]));
}

/* How far the point of a contact has slid since the start of the step. */
static kiriVec3 SlideOf(const kiriSystem* system, const kiriContactRow* contact, kiriVec3 point)
{
    kiriVec3 way = kiriVec3_Sub(point, kiriFrame_Carry(&system->frames[contact->frame], contact->at));
    return kiriVec3_AddScaled(way, -kiriVec3_Dot(way, contact->normal), contact->normal);
}

/* How deep a point is below the plane of its contact; 0 above. */
static double DepthOf(const kiriContactRow* contact, kiriVec3 point)
{
    double depth = contact->offset - kiriVec3_Dot(contact->normal, point);
    return depth > 0.0 ? depth : 0.0;
}

static void AddEnergy(Energy* sum, double stored, double lost)
{
    sum->potential += stored;
    sum->objective += stored + lost;
}

static void AddPinEnergy(const kiriSystem* system, const kiriPinRow* pin, const kiriPose* poses, Energy* sum)
{
    kiriVec3 off = kiriVec3_Sub(PointOf(system, pin->frame, pin->at, poses), pin->target);
    AddEnergy(sum, 0.5 * pin->stiffness * kiriVec3_Dot(off, off), 0.0);
}

/* The spring against sliding, N/m. Friction is at most `friction` times the push. Both are those before the iteration,
   so that the objective is a sum of squares while it is searched. */
static double BrakeOf(const kiriSolver* solver, const kiriSystem* system, const kiriContactRow* contact)
{
    kiriVec3 point = PointOf(system, contact->frame, contact->at, solver->poses.data);
    double push = contact->stiffness * DepthOf(contact, point);
    double slide = kiriVec3_Length(SlideOf(system, contact, point));
    double brake = contact->friction * push / (slide > SLIDE_FLOOR ? slide : SLIDE_FLOOR);
    return !solver->isBraking ? 0.0 : brake < contact->stiffness ? brake : contact->stiffness;
}

static void AddContactEnergy(const kiriSystem* system, const kiriContactRow* contact, double brake,
                             const kiriPose* poses, Energy* sum)
{
    kiriVec3 point = PointOf(system, contact->frame, contact->at, poses), slide = SlideOf(system, contact, point);
    double depth = DepthOf(contact, point);
    AddEnergy(sum, 0.5 * contact->stiffness * depth * depth, 0.5 * brake * kiriVec3_Dot(slide, slide));
}

/* `strain` of element k. */
static void AddStrainEnergy(const kiriSolver* solver, const kiriSystem* system, int32_t k, const double* strain,
                            Energy* sum)
{
    const double* stiffness = &solver->stiffness.data[MOST_ROWS * k];
    const double* loss = &solver->loss.data[MOST_ROWS * k];
    const double* start = &solver->startStrain.data[MOST_ROWS * k];
    int rows = RowCount(system, k);
    for (int e = 0; e < rows; ++e) {
        double change = strain[e] - start[e], pulling = Pulling(system, k, e, strain[e]);
        AddEnergy(sum, 0.5 * stiffness[e] * pulling * pulling, 0.5 * loss[e] * change * change);
    }
}

static Course* CourseOf(const kiriSolver* solver, int32_t frame)
{
    return &solver->courses.data[solver->piece.data[frame]];
}

/* Of an element. */
static Course* ElementCourse(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriLink* link = LinkOf(system, k);
    return CourseOf(solver, link != NULL ? link->i : system->patches->shares.data[PatchOf(system, k)->first].frame);
}

/* Starts the sums of the pieces that a step is sought for, with what the inertia has. */
static void SumInertia(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        memset(&solver->courses.data[i].sum, 0, sizeof(Energy));
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (CourseOf(solver, f)->isSought) {
            const kiriPrediction* prediction = &solver->predictions.data[f];
            kiriVec3 off = kiriVec3_Sub(poses[f].x, prediction->pose.x);
            double moved =
                system->frames[f].mass * kiriVec3_Dot(off, off) + kiriPrediction_TurnSquared(prediction, &poses[f].A);
            AddEnergy(&CourseOf(solver, f)->sum, 0.0, 0.5 * moved / (solver->dt * solver->dt));
        }
    }
}

/* Is the element a link of rigid frames that may leave their plane? */
static bool HasStop(const kiriSystem* system, int32_t k)
{
    return LinkOf(system, k) != NULL && !IsAffine(&system->mechanics) && !system->mechanics.planar;
}

static void SumHost(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    for (int32_t k = 0; k < system->pinCount; ++k) {
        Course* course = CourseOf(solver, system->pins[k].frame);
        if (course->isSought) {
            AddPinEnergy(system, &system->pins[k], poses, &course->sum);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriContactRow* contact = &system->contacts[k];
        Course* course = CourseOf(solver, contact->frame);
        if (course->isSought) {
            AddContactEnergy(system, contact, BrakeOf(solver, system, contact), poses, &course->sum);
        }
    }
}

static void Evaluate(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    SumInertia(solver, system, poses);
    /* Held frames start from where the host puts them. */
    bool isKnown = poses == solver->start.data && !solver->isHeld;
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        Course* course = ElementCourse(solver, system, k);
        double strain[MOST_ROWS];
        if (!course->isSought) {
            continue;
        }
        if (!isKnown) {
            Measure(system, k, poses, strain, NULL);
        }
        AddStrainEnergy(solver, system, k, isKnown ? &solver->startStrain.data[MOST_ROWS * k] : strain, &course->sum);
        solver->stopping.data[k] |= !isKnown && HasStop(system, k) && strain[KIRI_NORMAL_STOP] != 0.0;
    }
    SumHost(solver, system, poses);
}

static double LinkNoise(const kiriSolver* solver, const kiriLink* link, const double* stiffness)
{
    double reach = kiriVec3_Length(solver->start.data[link->i].x) + link->length;
    return reach * reach * (stiffness[KIRI_STRETCH] + stiffness[KIRI_SHEAR] + stiffness[KIRI_NORMAL_GAP]) +
           stiffness[KIRI_PLANE_BENDING] + stiffness[KIRI_BENDING] + stiffness[KIRI_TWIST];
}

/* The columns of A have lengths near 1. */
static double AffineNoise(const kiriSolver* solver, const kiriSystem* system, int32_t k, const double* stiffness)
{
    int32_t count = MembersOf(system, k, solver->members.data);
    double strain[MOST_ROWS], sum = 0.0;
    Measure(system, k, solver->start.data, strain, solver->rows.data);
    for (int e = 0; e < RowCount(system, k); ++e) {
        double reach = 0.0;
        for (int32_t m = 0; m < count; ++m) {
            const kiriVec3* by = solver->rows.data[count * e + m].by;
            reach += kiriVec3_Length(by[0]) * kiriVec3_Length(solver->start.data[solver->members.data[m]].x) +
                     kiriVec3_Length(by[1]) + kiriVec3_Length(by[2]) + kiriVec3_Length(by[3]);
        }
        sum += stiffness[e] * reach * reach;
    }
    return sum;
}

/* The energy of every spring and of the inertia when lengths are off by their last bits. A sheet at rest has no
   more. */
static void FindNoise(kiriSolver* solver, const kiriSystem* system)
{
    const double share = LAST_BITS * LAST_BITS * (1.0 + solver->damping);
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriVec3 x = solver->start.data[f].x;
        CourseOf(solver, f)->noise += share * system->frames[f].mass * kiriVec3_Dot(x, x) / (solver->dt * solver->dt);
    }
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        const double* stiffness = &solver->stiffness.data[MOST_ROWS * k];
        ElementCourse(solver, system, k)->noise +=
            share * (IsAffine(&system->mechanics) ? AffineNoise(solver, system, k, stiffness)
                                                  : LinkNoise(solver, LinkOf(system, k), stiffness));
    }
}

/* ---- Matrix and forces ------------------------------------------------------------------------------------------ */

/* A frame that is held, or whose piece has done its step, has the identity and no force: it stays where it is. */
static bool IsStill(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    return system->frames[f].held || !CourseOf(solver, f)->isSought;
}

static void AddHeld(kiriSolver* solver, int32_t f)
{
    double block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS] = { 0.0 };
    for (int32_t n = 0; n < solver->size; ++n) {
        block[(solver->size + 1) * n] = 1.0;
    }
    kiriMatrix_AddOwn(solver->matrix, f, block);
}

static Slots MassForce(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriPrediction* prediction = &solver->predictions.data[f];
    const kiriPose* pose = &solver->poses.data[f];
    Slots r;
    memset(&r, 0, sizeof(r));
    r.by[0] = kiriVec3_Scale(system->frames[f].mass, kiriVec3_Sub(prediction->pose.x, pose->x));
    if (IsAffine(&system->mechanics)) {
        kiriMat3 gradient = kiriPrediction_Gradient(prediction, &pose->A);
        r.by[1] = kiriVec3_Scale(-1.0, gradient.u);
        r.by[2] = kiriVec3_Scale(-1.0, gradient.v);
        r.by[3] = kiriVec3_Scale(-1.0, gradient.d);
    } else {
        r.by[1] = kiriVec3_Scale(-1.0, kiriPrediction_TurnGradient(prediction, &pose->A));
    }
    return r;
}

static void AddMass(kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriMassMoments* m = &solver->predictions.data[f].moments;
    const double moments[4][4] = { { system->frames[f].mass, 0.0, 0.0, 0.0 },
                                   { 0.0, m->uu, m->uv, 0.0 },
                                   { 0.0, m->uv, m->vv, 0.0 },
                                   { 0.0, 0.0, 0.0, m->dd } };
    kiriMat3 inertia = kiriPrediction_Inertia(&solver->predictions.data[f], &solver->poses.data[f].A);
    double perTime = 1.0 / (solver->dt * solver->dt), block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS];
    for (int32_t r = 0; r < solver->size; ++r) {
        const Unknown* a = &solver->unknowns[r];
        bool turns = a->slot == 1 && !IsAffine(&system->mechanics);
        kiriVec3 spun = turns ? kiriMat3_Mul(inertia, a->axis) : a->axis;
        for (int32_t c = 0; c < solver->size; ++c) {
            const Unknown* b = &solver->unknowns[c];
            block[solver->size * r + c] = turns && b->slot == 1    ? perTime * kiriVec3_Dot(b->axis, spun)
                                          : a->number == b->number ? perTime * moments[a->slot][b->slot]
                                                                   : 0.0;
        }
    }
    kiriMatrix_AddOwn(solver->matrix, f, block);
    double* force = &solver->force.data[solver->size * f];
    Slots gradient = MassForce(solver, system, f);
    Reduce(solver, gradient.by, force);
    for (int32_t n = 0; n < solver->size; ++n) {
        force[n] *= perTime;
    }
}

/* Adds the squares of `rows` strains: J has their derivatives by the unknowns of the frames, each frame's together. */
static void AddSquares(kiriSolver* solver, const int32_t* frames, int32_t frameCount, const double* J,
                       const double* springs, const double* pulls, int rows)
{
    int32_t size = solver->size;
    for (int e = 0; e < rows; ++e) {
        for (int32_t m = 0; m < frameCount; ++m, J += size) {
            double* force = &solver->force.data[size * frames[m]];
            for (int32_t n = 0; n < size; ++n) {
                force[n] += pulls[e] * J[n];
            }
        }
    }
    J -= size * frameCount * rows;
    kiriMatrix_AddSquares(solver->matrix, frames, frameCount, J, springs, rows);
}

/* Strains that change: the stop of a link comes last, and has no derivative where it does not act. */
static int ActiveRows(const kiriSystem* system, int32_t k, const double* strain)
{
    int rows = RowCount(system, k);
    bool isStopped = LinkOf(system, k) == NULL || system->mechanics.planar || strain[rows - 1] != 0.0;
    return isStopped ? rows : rows - 1;
}

/* The strains of an element at the poses, and J: their derivatives by the unknowns of its frames, zero for held
   ones. */
static void Derive(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t count, double* strain)
{
    size_t bytes = sizeof(double) * (size_t)solver->size;
    bool isRigid = LinkOf(system, k) != NULL && !IsAffine(&system->mechanics);
    double* J = solver->J.data;
    if (isRigid && !system->mechanics.planar) {
        const kiriLink* link = LinkOf(system, k);
        const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
        const kiriPose* const ends[2] = { &solver->poses.data[link->i], &solver->poses.data[link->j] };
        kiriStrain_Measure(link, frames, ends, strain, (kiriStrainRow*)J); /* rows are J as it is */
    } else {
        Measure(system, k, solver->poses.data, strain, solver->rows.data);
        for (int32_t n = 0; n < RowCount(system, k) * count; ++n) {
            Reduce(solver, solver->rows.data[n].by, &J[solver->size * n]);
        }
    }
    for (int32_t m = 0; solver->isHeld && m < count; ++m) {
        for (int e = 0; system->frames[solver->members.data[m]].held && e < RowCount(system, k); ++e) {
            memset(&J[solver->size * (count * e + m)], 0, bytes);
        }
    }
}

static void AddElement(kiriSolver* solver, const kiriSystem* system, int32_t k, Energy* energy)
{
    const double* stiffness = &solver->stiffness.data[MOST_ROWS * k];
    const double* loss = &solver->loss.data[MOST_ROWS * k];
    const double* start = &solver->startStrain.data[MOST_ROWS * k];
    int32_t count = MembersOf(system, k, solver->members.data);
    double strain[MOST_ROWS], springs[MOST_ROWS], pulls[MOST_ROWS];
    Derive(solver, system, k, count, strain);
    AddStrainEnergy(solver, system, k, strain, energy);
    int rows = ActiveRows(system, k, strain);
    for (int e = 0; e < rows; ++e) {
        springs[e] = stiffness[e] + loss[e];
        pulls[e] = -stiffness[e] * Pulling(system, k, e, strain[e]) - loss[e] * (strain[e] - start[e]);
    }
    /* No step gets past a stop that it does not see: after one that was cut short, those count that it ran into. */
    bool wasShort = ElementCourse(solver, system, k)->scale < SHORT_STEP;
    if (wasShort && solver->stopping.data[k] && rows == KIRI_NORMAL_STOP) {
        springs[KIRI_NORMAL_GAP] += stiffness[KIRI_NORMAL_STOP];
    }
    AddSquares(solver, solver->members.data, count, solver->J.data, springs, pulls, rows);
}

/* A spring on a point of a frame, stretched by `length` along the unit vector `axis`. */
static void AddSpring(kiriSolver* solver, const kiriSystem* system, int32_t f, kiriVec2 at, kiriVec3 axis,
                      double length, double stiffness)
{
    kiriVec2 local = kiriVec2_Sub(at, system->frames[f].center);
    double J[KIRI_MOST_UNKNOWNS], pull = -stiffness * length;
    Slots slots = { { axis, kiriVec3_Scale(local.x, axis), kiriVec3_Scale(local.y, axis), { 0.0, 0.0, 0.0 } } };
    if (!IsAffine(&system->mechanics)) {
        slots.by[1] = kiriVec3_Cross(ArmOf(system, f, at, &solver->poses.data[f]), axis);
    }
    Reduce(solver, slots.by, J);
    AddSquares(solver, &f, 1, J, &stiffness, &pull, 1);
}

static void AddPin(kiriSolver* solver, const kiriSystem* system, const kiriPinRow* pin)
{
    kiriVec3 off = kiriVec3_Sub(PointOf(system, pin->frame, pin->at, solver->poses.data), pin->target);
    AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(1.0, 0.0, 0.0), off.x, pin->stiffness);
    AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(0.0, 1.0, 0.0), off.y, pin->stiffness);
    AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(0.0, 0.0, 1.0), off.z, pin->stiffness);
}

static void AddContact(kiriSolver* solver, const kiriSystem* system, const kiriContactRow* contact)
{
    kiriVec3 n = contact->normal, point = PointOf(system, contact->frame, contact->at, solver->poses.data);
    double depth = DepthOf(contact, point), brake = BrakeOf(solver, system, contact);
    if (depth > 0.0) {
        AddSpring(solver, system, contact->frame, contact->at, n, -depth, contact->stiffness);
    }
    if (brake > 0.0) {
        kiriVec3 axis = fabs(n.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
        kiriVec3 side = kiriVec3_Normalize(kiriVec3_Cross(n, axis)), ahead = kiriVec3_Cross(side, n);
        kiriVec3 slide = SlideOf(system, contact, point);
        AddSpring(solver, system, contact->frame, contact->at, side, kiriVec3_Dot(slide, side), brake);
        AddSpring(solver, system, contact->frame, contact->at, ahead, kiriVec3_Dot(slide, ahead), brake);
    }
}

/* The system of a Gauss-Newton step from the poses, and the energy there, as Evaluate does. */
static void Assemble(kiriSolver* solver, const kiriSystem* system)
{
    kiriMatrix_Clear(solver->matrix);
    memset(solver->force.data, 0, sizeof(double) * (size_t)(solver->size * system->frameCount));
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (IsStill(solver, system, f)) {
            AddHeld(solver, f);
        } else {
            AddMass(solver, system, f);
        }
    }
    SumInertia(solver, system, solver->poses.data);
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        Course* course = ElementCourse(solver, system, k);
        if (course->isSought) {
            AddElement(solver, system, k, &course->sum);
        }
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        if (!IsStill(solver, system, system->pins[k].frame)) {
            AddPin(solver, system, &system->pins[k]);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (!IsStill(solver, system, system->contacts[k].frame)) {
            AddContact(solver, system, &system->contacts[k]);
        }
    }
    SumHost(solver, system, solver->poses.data);
}

/* ---- Iteration --------------------------------------------------------------------------------------------------- */

/* What is left of a vector in the plane. */
static kiriVec3 InPlane(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, mechanics->axes.d), mechanics->axes.d);
}

static kiriVec3 AlongNormal(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_Scale(kiriVec3_Dot(a, mechanics->axes.d), mechanics->axes.d);
}

/* In a planar sheet, a frame with only what moves it in the plane. */
static kiriFrameData FlattenedOf(const kiriMechanics* mechanics, const kiriFrameData* from)
{
    kiriFrameData frame = *from;
    if (mechanics->planar) {
        kiriVec3 off = kiriVec3_Sub(frame.heldPosition, frame.x);
        frame.velocity = InPlane(mechanics, frame.velocity);
        frame.spin = AlongNormal(mechanics, frame.spin);
        frame.force = InPlane(mechanics, frame.force);
        frame.torque = AlongNormal(mechanics, frame.torque);
        frame.heldPosition = kiriVec3_Sub(frame.heldPosition, AlongNormal(mechanics, off));
    }
    return frame;
}

static kiriVec3 GravityOf(const kiriSystem* system)
{
    return system->mechanics.planar ? InPlane(&system->mechanics, system->gravity) : system->gravity;
}

static kiriPrediction PredictionOf(const kiriSystem* system, const kiriFrameData* frame, double dt)
{
    if (frame->held) {
        return kiriPrediction_Held(frame, &system->material, dt);
    }
    return IsAffine(&system->mechanics) ? kiriPrediction_Affine(frame, &system->material, GravityOf(system), dt)
                                        : kiriPrediction_Free(frame, &system->material, GravityOf(system), dt);
}

static void BeginElement(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    double *stiffness = &solver->stiffness.data[MOST_ROWS * k], *strain = &solver->startStrain.data[MOST_ROWS * k];
    StiffnessOf(system, k, stiffness);
    Measure(system, k, solver->start.data, strain, NULL);
    bool isRigid = LinkOf(system, k) != NULL && !IsAffine(&system->mechanics);
    solver->stopping.data[k] = 0;
    double damping = solver->damping * (isRigid ? kiriStrain_Damping(strain) : 1.0);
    for (int e = 0; e < RowCount(system, k); ++e) {
        solver->loss.data[MOST_ROWS * k + e] = damping * stiffness[e];
    }
}

/* Which pieces are free, and nothing more. */
static void BeginCourses(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        memset(&solver->courses.data[i], 0, sizeof(Course));
        solver->courses.data[i].isFree = true;
        solver->courses.data[i].scale = 1.0;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        CourseOf(solver, f)->isFree &= !system->frames[f].held;
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        CourseOf(solver, system->pins[k].frame)->isFree = false;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        CourseOf(solver, system->contacts[k].frame)->isFree = false;
    }
}

static void Begin(kiriSolver* solver, const kiriSystem* system, double dt)
{
    solver->dt = dt;
    solver->damping = (double)system->material.flexDamping / dt;
    solver->isBraking = solver->isHeld = false;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        solver->isHeld |= system->frames[f].held != 0;
        solver->start.data[f] = kiriPose_Of(&system->frames[f]);
        solver->before.data[f] = FlattenedOf(&system->mechanics, &system->frames[f]);
        solver->predictions.data[f] = PredictionOf(system, &solver->before.data[f], dt);
        solver->poses.data[f] = solver->predictions.data[f].coast;
    }
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        BeginElement(solver, system, k);
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (system->frames[f].held) {
            solver->start.data[f] = solver->predictions.data[f].pose;
        }
    }
    BeginCourses(solver, system);
    FindNoise(solver, system);
}

/* Sets out from the whole of the Gauss-Newton step, or as much as turns no frame too far. */
static void StartSearch(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        course->now = course->isSought ? course->sum : course->now;
        course->enough = course->now.objective * (1.0 + ROUNDING) + course->noise;
        course->scale = LONGEST_TURN;
        course->promise = 0.0;
    }
    for (int32_t n = 0; n < solver->size * system->frameCount; ++n) {
        CourseOf(solver, n / solver->size)->promise += 0.5 * solver->force.data[n] * solver->move.data[n];
    }
    for (int32_t f = 0; !IsAffine(&system->mechanics) && f < system->frameCount; ++f) {
        Slots change = Expand(solver, 1.0, &solver->move.data[solver->size * f]);
        double turn = kiriVec3_Length(change.by[1]);
        CourseOf(solver, f)->scale = turn > CourseOf(solver, f)->scale ? turn : CourseOf(solver, f)->scale;
    }
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        solver->courses.data[i].scale = LONGEST_TURN / solver->courses.data[i].scale;
    }
}

static void Try(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriPose* pose = &solver->poses.data[f];
        if (!CourseOf(solver, f)->isSought) {
            continue;
        }
        Slots change = Expand(solver, CourseOf(solver, f)->scale, &solver->move.data[solver->size * f]);
        kiriMat3 columns = { change.by[1], change.by[2], change.by[3] };
        solver->trial.data[f].x = kiriVec3_Add(pose->x, change.by[0]);
        solver->trial.data[f].A = IsAffine(&system->mechanics)
                                      ? kiriMat3_Advance(&pose->A, &columns)
                                      : kiriMat3_MulMat(kiriMat3_Cayley(change.by[1]), pose->A);
    }
    Evaluate(solver, system, solver->trial.data);
}

/* Pieces whose step is good enough take it. Returns whether there are others. */
static bool TakeTrial(kiriSolver* solver, const kiriSystem* system)
{
    bool isLeft = false;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const Course* course = CourseOf(solver, f);
        if (course->isSought && course->sum.objective <= course->enough) {
            solver->poses.data[f] = solver->trial.data[f];
        }
    }
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        if (course->isSought && course->sum.objective <= course->enough) {
            course->now = course->sum;
            course->isSought = false;
        }
        isLeft |= course->isSought;
    }
    return isLeft;
}

/* Pieces for which a step is still sought may reach the objective of the free prediction, without the springs. */
static void AllowPrediction(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        solver->trial.data[f] = solver->predictions.data[f].pose;
    }
    bool isBraking = solver->isBraking;
    solver->isBraking = false;
    Evaluate(solver, system, solver->trial.data);
    solver->isBraking = isBraking;
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        double allowed = course->sum.objective * (1.0 + ROUNDING) + course->noise;
        course->enough = course->isSought && allowed > course->enough ? allowed : course->enough;
    }
}

/* One Gauss-Newton step, halved until the objective falls; the first one may also reach that of the free prediction. False
   when the matrix has no factor. */
static bool Iterate(kiriSolver* solver, const kiriSystem* system, bool isFirst)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        solver->courses.data[i].isSought = solver->courses.data[i].isIterated;
    }
    Assemble(solver, system);
    if (!kiriMatrix_Factor(solver->matrix)) {
        return false;
    }
    kiriMatrix_Solve(solver->matrix, solver->force.data, solver->move.data);
    StartSearch(solver, system);
    Try(solver, system);
    bool isLeft = TakeTrial(solver, system);
    if (isLeft && isFirst) {
        AllowPrediction(solver, system);
        Try(solver, system);
        isLeft = TakeTrial(solver, system);
    }
    for (int halving = 0; isLeft && halving < HALVINGS; ++halving) {
        for (int32_t i = 0; i < solver->pieceCount; ++i) {
            solver->courses.data[i].scale *= 0.5;
        }
        Try(solver, system);
        isLeft = TakeTrial(solver, system);
    }
    return true;
}

/* ---- Energy ----------------------------------------------------------------------------------------------------- */

/* By how much the rate of A differs from that of the free prediction. */
static void LandAffine(const kiriPrediction* prediction, double perTime, kiriFrameData* frame)
{
    kiriMat3 rate = prediction->rate;
    rate.u = kiriVec3_AddScaled(rate.u, perTime, kiriVec3_Sub(frame->A.u, prediction->pose.A.u));
    rate.v = kiriVec3_AddScaled(rate.v, perTime, kiriVec3_Sub(frame->A.v, prediction->pose.A.v));
    rate.d = kiriVec3_AddScaled(rate.d, perTime, kiriVec3_Sub(frame->A.d, prediction->pose.A.d));
    frame->spin = kiriMat3_Spin(&frame->A, &rate);
    frame->rate = kiriMat3_Beside(&frame->A, &rate, frame->spin);
}

/* The frames at the end of the step, if it ended here. */
static void Land(kiriSolver* solver, const kiriSystem* system)
{
    double perTime = 1.0 / solver->dt;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriPrediction* prediction = &solver->predictions.data[f];
        kiriFrameData* frame = &solver->after.data[f];
        *frame = solver->before.data[f];
        frame->x = solver->poses.data[f].x;
        frame->A = solver->poses.data[f].A;
        frame->velocity = kiriVec3_AddScaled(prediction->velocity, perTime, kiriVec3_Sub(frame->x, prediction->pose.x));
        if (frame->held) {
            frame->spin = prediction->spin;
            frame->rate = prediction->rate;
        } else if (IsAffine(&system->mechanics)) {
            LandAffine(prediction, perTime, frame);
        } else {
            kiriMat3 inertia = kiriPrediction_Inertia(prediction, &frame->A);
            kiriVec3 turn = kiriMat3_Solve(&inertia, kiriPrediction_TurnGradient(prediction, &frame->A));
            frame->spin = kiriVec3_AddScaled(prediction->spin, perTime, turn);
        }
    }
}

/* The mean velocity of each piece, by mass. */
static void FindMeans(kiriSolver* solver, int32_t frameCount)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        course->mean = kiriVec3_Make(0.0, 0.0, 0.0);
        course->mass = 0.0;
    }
    for (int32_t f = 0; f < frameCount; ++f) {
        const kiriFrameData* frame = &solver->after.data[f];
        Course* course = CourseOf(solver, f);
        if (!frame->held) {
            course->mass += frame->mass;
            course->mean = kiriVec3_AddScaled(course->mean, frame->mass, frame->velocity);
        }
    }
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        course->mean = kiriVec3_Scale(1.0 / (course->mass > DBL_MIN ? course->mass : DBL_MIN), course->mean);
    }
}

/* Of a frame after the step, beside what its piece's mean velocity has. */
static double OwnKinetic(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    kiriFrameData frame = solver->after.data[f];
    frame.velocity = kiriVec3_Sub(frame.velocity, CourseOf(solver, f)->mean);
    return kiriFrame_KineticEnergy(&frame, &system->material);
}

/* What brakes can take: the velocity of the centre of mass of a free piece is not theirs. */
static double Brakeable(const Course* course)
{
    return course->kinetic + (course->isFree ? 0.0 : 0.5 * course->mass * kiriVec3_Dot(course->mean, course->mean));
}

/* By how much kinetic and potential energy grow in the step beyond the work of gravity and of the host's forces; what
   rounding explains is no gain. A held frame counts as moved before the step. */
static void FindGains(kiriSolver* solver, const kiriSystem* system)
{
    FindMeans(solver, system->frameCount);
    kiriVec3 gravity = GravityOf(system);
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        course->kinetic = 0.0;
        course->gain = -ROUNDING * (course->start.potential + course->now.potential) - course->noise +
                       course->now.potential - course->start.potential;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriFrameData *start = &solver->before.data[f], *end = &solver->after.data[f];
        if (!start->held) {
            kiriVec3 way = kiriVec3_Sub(end->x, start->x);
            double before = kiriFrame_KineticEnergy(start, &system->material);
            double after = kiriFrame_KineticEnergy(end, &system->material);
            double work = start->mass * kiriVec3_Dot(gravity, way) + kiriVec3_Dot(start->force, way) +
                          solver->dt * kiriVec3_Dot(start->torque, end->spin);
            CourseOf(solver, f)->kinetic += OwnKinetic(solver, system, f);
            CourseOf(solver, f)->gain += after - before - work - ROUNDING * (before + after + fabs(work));
        }
    }
}

/* The factor that takes an energy out of velocities that have `kinetic`; what they do not have is left in `energy`. */
static double Keep(double kinetic, double* energy)
{
    double taken = kinetic < *energy ? kinetic : *energy;
    *energy -= taken;
    return taken < kinetic ? sqrt(1.0 - taken / kinetic) : 0.0;
}

static void Slow(kiriFrameData* frame, double keep, kiriVec3 mean, double keepMean)
{
    kiriVec3 own = kiriVec3_Sub(frame->velocity, mean);
    frame->velocity = kiriVec3_AddScaled(kiriVec3_Scale(keepMean, mean), keep, own);
    frame->spin = kiriVec3_Scale(keep, frame->spin);
    frame->rate.u = kiriVec3_Scale(keep, frame->rate.u);
    frame->rate.v = kiriVec3_Scale(keep, frame->rate.v);
    frame->rate.d = kiriVec3_Scale(keep, frame->rate.d);
}

/* Takes what pieces gained out of their velocities: as they differ from the mean first, for so momentum stays. Only
   where something changes momentum can there be more to take. */
static void Brake(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        double energy = course->gain > 0.0 ? course->gain : 0.0;
        course->keep = Keep(course->kinetic, &energy);
        course->keepMean =
            course->isFree ? 1.0 : Keep(0.5 * course->mass * kiriVec3_Dot(course->mean, course->mean), &energy);
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const Course* course = CourseOf(solver, f);
        if (course->gain > 0.0 && !solver->after.data[f].held) {
            Slow(&solver->after.data[f], course->keep, course->mean, course->keepMean);
        }
    }
}

/* ---- Step ------------------------------------------------------------------------------------------------------- */

/* Nothing holds the centre of mass of a free piece: it is where the prediction ends, however far the iteration came. */
static void Center(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        solver->courses.data[i].mean = kiriVec3_Make(0.0, 0.0, 0.0);
        solver->courses.data[i].mass = 0.0;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        Course* course = CourseOf(solver, f);
        kiriVec3 off = kiriVec3_Sub(solver->predictions.data[f].pose.x, solver->poses.data[f].x);
        course->mean = kiriVec3_AddScaled(course->mean, system->frames[f].mass, off);
        course->mass += system->frames[f].mass;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const Course* course = CourseOf(solver, f);
        kiriVec3* x = &solver->poses.data[f].x;
        double squared = kiriVec3_Dot(course->mean, course->mean) / (course->mass * solver->dt * solver->dt);
        if (course->isFree && 0.5 * squared > course->noise) {
            *x = kiriVec3_AddScaled(*x, 1.0 / course->mass, course->mean);
        }
    }
}

/* The frames at the end of the step, and what energy they gained. */
static void Arrive(kiriSolver* solver, const kiriSystem* system)
{
    Center(solver, system);
    Land(solver, system);
    FindGains(solver, system);
}

/* Pieces go on that gained energy, or whose steps were cut short. Returns whether there are any. */
static bool ChooseUnfinished(kiriSolver* solver)
{
    bool any = false;
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        bool isShort = course->scale < SHORT_STEP && course->promise > WORTHWHILE * course->now.objective;
        course->isIterated = course->isIterated && (!(course->gain <= 0.0) || isShort);
        any |= course->isIterated;
    }
    return any;
}

/* Of these, only those go on that would lose too much of their motion to brakes; they stand where they stood
   before the step. Returns whether there are any. */
static bool Restart(kiriSolver* solver, const kiriSystem* system)
{
    bool any = false;
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        Course* course = &solver->courses.data[i];
        bool isOver = !(course->now.objective <= course->start.objective * (1.0 + ROUNDING) + course->noise);
        double most = (isOver ? MOST_BRAKED : 1.0) * Brakeable(course);
        course->isIterated = course->isIterated && !(course->gain <= most);
        course->now = course->isIterated ? course->start : course->now;
        solver->restarts += course->isIterated;
        any |= course->isIterated;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (CourseOf(solver, f)->isIterated) {
            solver->poses.data[f] = solver->start.data[f];
        }
    }
    return any;
}

static void EvaluateStart(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        solver->courses.data[i].isIterated = solver->courses.data[i].isSought = true;
    }
    Evaluate(solver, system, solver->start.data);
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        solver->courses.data[i].start = solver->courses.data[i].sum;
    }
}

/* The iteration starts where the frames coast by their velocities: a strip that swings is then nearly there, and one at
   rest is there. The first step may raise the objective up to that of the free prediction: it has to turn stiff frames,
   which stretches links before the next step lets them go, and halving it there would freeze the turning.

   Pieces that have gained energy, or took only a part of their last step, are iterated on. What a piece has gained even
   then is taken out of its velocities. Where that would all but stop it, it starts anew from not moving, and its
   objective only falls from there. Then, with v the velocities before and w those after the step,

   potential after + 1/2 m (w - v)^2  <=  potential before + 1/2 m v^2 + work,

   which bounds w by 2 v and no better. At the minimum w^2 stands for (w - v)^2, but for parts of the energy that are
   not convex. Nothing is ever flung away, however long the step. */
static int32_t Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, int32_t most)
{
    int32_t done = 0, last = iterations + SECOND_CHANCES;
    bool isLeft = true, isFresh = false;
    EvaluateStart(solver, system);
    while (isLeft && done < most && done < last) {
        /* Before the first step the push is that of the free prediction, far too strong at an impact. */
        solver->isBraking = done > 0 || iterations == 1;
        if (!Iterate(solver, system, done == 0)) {
            return -1;
        }
        ++done;
        if (done >= iterations) {
            Arrive(solver, system);
            isLeft = ChooseUnfinished(solver);
        }
        if (isLeft && !isFresh && (done == last || done == most)) {
            isLeft = Restart(solver, system);
            Arrive(solver, system);
            isFresh = true;
            last += FRESH_STARTS;
        }
    }
    return done;
}

/* What the energy gained or lost in the step asks of the velocities. */
static void Settle(kiriSolver* solver, const kiriSystem* system)
{
    Brake(solver, system);
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        const Course* course = &solver->courses.data[i];
        solver->pieces.data[i].isHeld = !course->isFree || course->gain > 0.0;
        solver->pieces.data[i].lost = course->gain < 0.0 ? -course->gain : 0.0;
    }
    kiriMomentum_Restore(solver->before.data, solver->after.data, system->frameCount, solver->piece.data,
                         solver->pieces.data, solver->pieceCount, &system->material, solver->dt);
}

/* The host reads floats. An eighth leaves room for the sums and blends that they are made of. NaN does not fit. */
static bool Fits(kiriVec3 a)
{
    const double most = 0.125 * (double)FLT_MAX;
    return fabs(a.x) <= most && fabs(a.y) <= most && fabs(a.z) <= most;
}

static bool CanBeRead(const kiriSolver* solver, int32_t frameCount)
{
    for (int32_t f = 0; f < frameCount; ++f) {
        const kiriFrameData* frame = &solver->after.data[f];
        if (!Fits(frame->x) || !Fits(frame->A.u) || !Fits(frame->A.v) || !Fits(frame->A.d) || !Fits(frame->velocity) ||
            !Fits(frame->spin) || !Fits(frame->rate.u) || !Fits(frame->rate.v) || !Fits(frame->rate.d) ||
            !Fits(kiriFrame_VelocityAt(frame, frame->site.at))) {
            return false;
        }
    }
    return true;
}

static void Finish(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriFrameData* frame = &system->frames[f];
        const kiriFrameData* end = &solver->after.data[f];
        frame->x = end->x;
        frame->A = frame->held                    ? frame->heldRotation
                   : IsAffine(&system->mechanics) ? end->A
                                                  : kiriMat3_Rotation(end->A);
        frame->velocity = end->velocity;
        frame->spin = end->spin;
        frame->rate = end->rate;
    }
}

int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations, int32_t most)
{
    Begin(solver, system, dt);
    int32_t done = Minimise(solver, system, iterations < most ? iterations : most, most);
    if (done < 0) {
        return -1;
    }
    Settle(solver, system);
    if (!CanBeRead(solver, system->frameCount)) {
        return -1;
    }
    Finish(solver, system);
    return done;
}

double kiriSolver_ElasticEnergy(const kiriSystem* system)
{
    double sum = 0.0;
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        double strain[MOST_ROWS], stiffness[MOST_ROWS];
        MeasureFrames(system, k, strain);
        StiffnessOf(system, k, stiffness);
        for (int e = 0; e < RowCount(system, k); ++e) {
            double pulling = Pulling(system, k, e, strain[e]);
            sum += 0.5 * stiffness[e] * pulling * pulling;
        }
    }
    return sum;
}
