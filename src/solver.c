/* Backward Euler as a minimisation over the poses of the frames at the end of the step. The objective is

       1/2 sum over mass points of m |x - x*|^2 / dt^2,  x* where the free flight ends
     + energies of links (strain.h, affine.h), patches (patch.h), pins and contacts
     + flex damping: 1/2 k (flexDamping / dt) (strain - strain at the start of the step)^2 for each strain.

   All are squares, so a Gauss-Newton step solves with J^T k J + mass: positive definite by itself, with a pattern that
   only the links and patches decide. The order of summation is fixed. */
#include "solver.h"

#include "affine.h"
#include "matrix.h"
#include "strain.h"

#include <string.h>

#define LONGEST_TURN 1.0 /* of a frame in one Gauss-Newton step: a Cayley vector */
#define HALVINGS 12      /* of a step that does not lower the objective */
#define SECOND_CHANCES 4 /* more iterations where the objective ends above that of the start of the step, */
#define FRESH_STARTS 2   /* and iterations from there should they fail */
#define ROUNDING 1e-9    /* of an objective, relative */
#define SLIDE_FLOOR 1e-9 /* m: a shorter way is no slide */

/* A link or patch has at most so many strains. */
enum { MOST_ROWS = (int)KIRI_STRAINS > (int)KIRI_AFFINE_STRAINS ? (int)KIRI_STRAINS : (int)KIRI_AFFINE_STRAINS };

/* By how much something changes with a frame: its move and its turn if it is rigid, else x and the columns of A. */
typedef struct Slots {
    kiriVec3 by[4];
} Slots;

/* One of a frame's unknowns: the part of a slot along an axis. */
typedef struct Unknown {
    int slot;
    kiriVec3 axis;
} Unknown;

struct kiriSolver {
    kiriMemory memory;
    double dt, damping; /* of this step; flexDamping / dt */
    bool isBraking;
    int32_t size; /* unknowns a frame */
    Unknown unknowns[KIRI_MOST_UNKNOWNS];
    kiriMatrix* matrix;
    KIRI_ARRAY(kiriFlight) flights;            /* one a frame, as are the poses */
    KIRI_ARRAY(kiriPose) start, poses, trial;  /* at the start of the step, now, and where a step would lead */
    KIRI_ARRAY(double) stiffness, startStrain; /* MOST_ROWS an element; strains at the start of the step */
    KIRI_ARRAY(double) force, move;            /* the right side: minus the gradient; and the solution */
    /* Scratch for one element. */
    KIRI_ARRAY(int32_t) members;
    KIRI_ARRAY(kiriAffineRow) rows;
    KIRI_ARRAY(double) J;
};

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
            rows[2 * e + end].by[0] = found[e].move[end];
            rows[2 * e + end].by[1] = found[e].turn[end];
        }
    }
}

/* The strains and, unless `rows` is null, their derivatives: one a strain and frame. Null poses: as the frames are. */
static void Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strain, kiriAffineRow* rows)
{
    const kiriLink* link = LinkOf(system, k);
    if (link == NULL) {
        kiriPatch_Measure(PatchOf(system, k), system->patches->shares.data, system->frames, poses, strain, rows);
        return;
    }
    const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
    const kiriPose now[2] = { poses != NULL ? poses[link->i] : kiriPose_Of(frames[0]),
                              poses != NULL ? poses[link->j] : kiriPose_Of(frames[1]) };
    const kiriPose* const ends[2] = { &now[0], &now[1] };
    if (IsAffine(&system->mechanics)) {
        kiriAffine_Measure(link, frames, ends, strain, (kiriAffineRow(*)[2])rows);
    } else {
        MeasureRigid(link, frames, ends, strain, rows);
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
                Unknown unknown = { slot, planar ? plane[axis] : space[axis] };
                solver->unknowns[solver->size++] = unknown;
            }
        }
    }
}

static void Reduce(const kiriSolver* solver, const kiriVec3* slots, double* values)
{
    for (int32_t n = 0; n < solver->size; ++n) {
        values[n] = kiriVec3_Dot(slots[solver->unknowns[n].slot], solver->unknowns[n].axis);
    }
}

static Slots Expand(const kiriSolver* solver, double scale, const double* values)
{
    Slots slots;
    memset(&slots, 0, sizeof(slots));
    for (int32_t n = 0; n < solver->size; ++n) {
        kiriVec3* by = &slots.by[solver->unknowns[n].slot];
        *by = kiriVec3_AddScaled(*by, scale * values[n], solver->unknowns[n].axis);
    }
    return slots;
}

/* ---- Making ----------------------------------------------------------------------------------------------------- */

typedef KIRI_ARRAY(kiriPair) Pairs;

static bool CollectPairs(const kiriMemory* memory, const kiriSystem* system, int32_t* members, Pairs* pairs)
{
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        int32_t count = MembersOf(system, k, members);
        for (int32_t b = 1; b < count; ++b) {
            for (int32_t a = 0; a < b; ++a) {
                kiriPair pair = { members[a], members[b] };
                if (!kiriArray_Push(memory, pairs, pair)) {
                    return false;
                }
            }
        }
    }
    return true;
}

static int32_t MostMembers(const kiriPatches* patches)
{
    int32_t most = 2;
    for (int32_t k = 0; k < PatchElements(patches); ++k) {
        most = patches->patches.data[k].count > most ? patches->patches.data[k].count : most;
    }
    return most;
}

static bool MakeRoom(kiriSolver* solver, int32_t frameCount, int32_t elementCount, int32_t most)
{
    const kiriMemory* memory = &solver->memory;
    int64_t unknowns = (int64_t)solver->size * frameCount, rows = (int64_t)MOST_ROWS * most;
    return kiriArray_Resize(memory, &solver->flights, frameCount) &&
           kiriArray_Resize(memory, &solver->start, frameCount) &&
           kiriArray_Resize(memory, &solver->poses, frameCount) &&
           kiriArray_Resize(memory, &solver->trial, frameCount) &&
           kiriArray_Resize(memory, &solver->stiffness, (int64_t)MOST_ROWS * elementCount) &&
           kiriArray_Resize(memory, &solver->startStrain, (int64_t)MOST_ROWS * elementCount) &&
           kiriArray_Resize(memory, &solver->force, unknowns) && kiriArray_Resize(memory, &solver->move, unknowns) &&
           kiriArray_Resize(memory, &solver->members, most) && kiriArray_Resize(memory, &solver->rows, rows) &&
           kiriArray_Resize(memory, &solver->J, rows * solver->size);
}

static bool Prepare(kiriSolver* solver, const kiriSystem* system)
{
    Pairs pairs = { NULL, 0, 0 };
    ChooseUnknowns(solver, &system->mechanics);
    if (MakeRoom(solver, system->frameCount, ElementCount(system), MostMembers(system->patches)) &&
        CollectPairs(&solver->memory, system, solver->members.data, &pairs)) {
        solver->matrix = kiriMatrix_Create(&solver->memory, solver->size, system->frameCount, pairs.data, pairs.count);
    }
    kiriArray_Release(&solver->memory, &pairs);
    return solver->matrix != NULL;
}

kiriSolver* kiriSolver_CreateFor(const kiriMemory* memory, const kiriMechanics* mechanics, int32_t frameCount,
                                 const kiriLink* links, int32_t linkCount, const kiriPatches* patches)
{
    kiriSolver* solver = kiriMemory_Alloc(memory, (int64_t)sizeof(kiriSolver));
    if (solver == NULL) {
        return NULL;
    }
    kiriSystem system;
    memset(&system, 0, sizeof(system));
    memset(solver, 0, sizeof(*solver));
    solver->memory = *memory;
    system.mechanics = *mechanics;
    system.frameCount = frameCount;
    system.links = links;
    system.linkCount = linkCount;
    system.patches = patches;
    if (!Prepare(solver, &system)) {
        kiriSolver_Destroy(solver);
        return NULL;
    }
    return solver;
}

kiriSolver* kiriSolver_Create(const kiriMemory* memory, int32_t frameCount, const kiriLink* links, int32_t linkCount)
{
    kiriMechanics mechanics;
    memset(&mechanics, 0, sizeof(mechanics));
    return kiriSolver_CreateFor(memory, &mechanics, frameCount, links, linkCount, NULL);
}

void kiriSolver_Destroy(kiriSolver* solver)
{
    if (solver == NULL) {
        return;
    }
    kiriMemory memory = solver->memory;
    kiriMatrix_Destroy(solver->matrix);
    kiriArray_Release(&memory, &solver->flights);
    kiriArray_Release(&memory, &solver->start);
    kiriArray_Release(&memory, &solver->poses);
    kiriArray_Release(&memory, &solver->trial);
    kiriArray_Release(&memory, &solver->stiffness);
    kiriArray_Release(&memory, &solver->startStrain);
    kiriArray_Release(&memory, &solver->force);
    kiriArray_Release(&memory, &solver->move);
    kiriArray_Release(&memory, &solver->members);
    kiriArray_Release(&memory, &solver->rows);
    kiriArray_Release(&memory, &solver->J);
    kiriMemory_Free(&memory, solver);
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

static double PinEnergy(const kiriSystem* system, const kiriPinRow* pin, const kiriPose* poses)
{
    kiriVec3 off = kiriVec3_Sub(PointOf(system, pin->frame, pin->at, poses), pin->target);
    return 0.5 * pin->stiffness * kiriVec3_Dot(off, off);
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

static double ContactEnergy(const kiriSystem* system, const kiriContactRow* contact, double brake,
                            const kiriPose* poses)
{
    kiriVec3 point = PointOf(system, contact->frame, contact->at, poses), slide = SlideOf(system, contact, point);
    double depth = DepthOf(contact, point);
    return 0.5 * contact->stiffness * depth * depth + 0.5 * brake * kiriVec3_Dot(slide, slide);
}

static double ElementEnergy(const kiriSolver* solver, const kiriSystem* system, int32_t k, const kiriPose* poses)
{
    const double* stiffness = &solver->stiffness.data[MOST_ROWS * k];
    const double* start = &solver->startStrain.data[MOST_ROWS * k];
    double strain[MOST_ROWS], sum = 0.0;
    Measure(system, k, poses, strain, NULL);
    for (int e = 0; e < RowCount(system, k); ++e) {
        double change = strain[e] - start[e];
        sum += 0.5 * stiffness[e] * (strain[e] * strain[e] + solver->damping * change * change);
    }
    return sum;
}

static double Objective(const kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    double moved = 0.0, sum = 0.0;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriFlight* flight = &solver->flights.data[f];
        kiriVec3 off = kiriVec3_Sub(poses[f].x, flight->pose.x);
        moved += system->frames[f].mass * kiriVec3_Dot(off, off) + kiriFlight_TurnSquared(flight, &poses[f].A);
    }
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        sum += ElementEnergy(solver, system, k, poses);
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        sum += PinEnergy(system, &system->pins[k], poses);
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        sum += ContactEnergy(system, &system->contacts[k], BrakeOf(solver, system, &system->contacts[k]), poses);
    }
    return sum + 0.5 * moved / (solver->dt * solver->dt);
}

/* ---- Matrix and forces ------------------------------------------------------------------------------------------ */

/* A held frame has the identity and no force: it stays where it was put. */
static void AddHeld(kiriSolver* solver, int32_t f)
{
    double block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS] = { 0.0 };
    for (int32_t n = 0; n < solver->size; ++n) {
        block[(solver->size + 1) * n] = 1.0;
    }
    kiriMatrix_AddOwn(solver->matrix, f, block);
}

/* The mass matrix times a change of the frame; `inertia` is that of a rigid one. */
static Slots Massive(const kiriSolver* solver, const kiriSystem* system, int32_t f, const kiriMat3* inertia,
                     const Slots* a)
{
    const kiriMassMoments* m = &solver->flights.data[f].moments;
    Slots r;
    memset(&r, 0, sizeof(r));
    r.by[0] = kiriVec3_Scale(system->frames[f].mass, a->by[0]);
    if (IsAffine(&system->mechanics)) {
        r.by[1] = kiriVec3_AddScaled(kiriVec3_Scale(m->uu, a->by[1]), m->uv, a->by[2]);
        r.by[2] = kiriVec3_AddScaled(kiriVec3_Scale(m->vv, a->by[2]), m->uv, a->by[1]);
        r.by[3] = kiriVec3_Scale(m->dd, a->by[3]);
    } else {
        r.by[1] = kiriMat3_Mul(*inertia, a->by[1]);
    }
    return r;
}

static Slots MassForce(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriFlight* flight = &solver->flights.data[f];
    const kiriPose* pose = &solver->poses.data[f];
    Slots r;
    memset(&r, 0, sizeof(r));
    r.by[0] = kiriVec3_Scale(system->frames[f].mass, kiriVec3_Sub(flight->pose.x, pose->x));
    if (IsAffine(&system->mechanics)) {
        kiriMat3 gradient = kiriFlight_Gradient(flight, &pose->A);
        r.by[1] = kiriVec3_Scale(-1.0, gradient.u);
        r.by[2] = kiriVec3_Scale(-1.0, gradient.v);
        r.by[3] = kiriVec3_Scale(-1.0, gradient.d);
    } else {
        r.by[1] = kiriVec3_Scale(-1.0, kiriFlight_TurnGradient(flight, &pose->A));
    }
    return r;
}

static void AddMass(kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    double perTime = 1.0 / (solver->dt * solver->dt), block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS];
    double* force = &solver->force.data[solver->size * f];
    kiriMat3 inertia = kiriFlight_Inertia(&solver->flights.data[f], &solver->poses.data[f].A);
    for (int32_t n = 0; n < solver->size; ++n) {
        double unit[KIRI_MOST_UNKNOWNS] = { 0.0 };
        unit[n] = perTime;
        Slots change = Expand(solver, 1.0, unit), mass = Massive(solver, system, f, &inertia, &change);
        Reduce(solver, mass.by, &block[solver->size * n]);
    }
    kiriMatrix_AddOwn(solver->matrix, f, block);
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
    int32_t stride = solver->size * frameCount;
    for (int32_t column = 0; column < stride; ++column) {
        double force = 0.0;
        for (int e = 0; e < rows; ++e) {
            force += pulls[e] * J[e * stride + column];
        }
        solver->force.data[solver->size * frames[column / solver->size] + column % solver->size] += force;
    }
    kiriMatrix_AddSquares(solver->matrix, frames, frameCount, J, springs, rows);
}

/* The derivatives by the unknowns of a held frame are zero. */
static void AddElement(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const double* stiffness = &solver->stiffness.data[MOST_ROWS * k];
    const double* start = &solver->startStrain.data[MOST_ROWS * k];
    int rows = RowCount(system, k);
    int32_t count = MembersOf(system, k, solver->members.data);
    double strain[MOST_ROWS], springs[MOST_ROWS], pulls[MOST_ROWS];
    Measure(system, k, solver->poses.data, strain, solver->rows.data);
    for (int e = 0; e < rows; ++e) {
        springs[e] = stiffness[e] * (1.0 + solver->damping);
        pulls[e] = -stiffness[e] * (strain[e] + solver->damping * (strain[e] - start[e]));
        for (int32_t m = 0; m < count; ++m) {
            double* J = &solver->J.data[solver->size * (count * e + m)];
            if (system->frames[solver->members.data[m]].held) {
                memset(J, 0, sizeof(double) * (size_t)solver->size);
            } else {
                Reduce(solver, solver->rows.data[count * e + m].by, J);
            }
        }
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

static void Assemble(kiriSolver* solver, const kiriSystem* system)
{
    kiriMatrix_Clear(solver->matrix);
    memset(solver->force.data, 0, sizeof(double) * (size_t)solver->force.count);
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (system->frames[f].held) {
            AddHeld(solver, f);
        } else {
            AddMass(solver, system, f);
        }
    }
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        AddElement(solver, system, k);
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        if (!system->frames[system->pins[k].frame].held) {
            AddPin(solver, system, &system->pins[k]);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (!system->frames[system->contacts[k].frame].held) {
            AddContact(solver, system, &system->contacts[k]);
        }
    }
}

/* ---- Step ------------------------------------------------------------------------------------------------------- */

/* What is left of a vector in the plane. */
static kiriVec3 InPlane(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, mechanics->axes.d), mechanics->axes.d);
}

static kiriVec3 AlongNormal(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_Scale(kiriVec3_Dot(a, mechanics->axes.d), mechanics->axes.d);
}

/* A frame of a planar sheet, with only what moves it in the plane. */
static void Flatten(const kiriMechanics* mechanics, kiriFrameData* frame)
{
    kiriVec3 off = kiriVec3_Sub(frame->heldPosition, frame->x);
    frame->velocity = InPlane(mechanics, frame->velocity);
    frame->spin = AlongNormal(mechanics, frame->spin);
    frame->force = InPlane(mechanics, frame->force);
    frame->torque = AlongNormal(mechanics, frame->torque);
    frame->heldPosition = kiriVec3_Sub(frame->heldPosition, AlongNormal(mechanics, off));
}

static kiriFlight FlightOf(const kiriSystem* system, int32_t f, double dt)
{
    const kiriMechanics* mechanics = &system->mechanics;
    kiriFrameData frame = system->frames[f];
    kiriVec3 gravity = system->gravity;
    if (mechanics->planar) {
        Flatten(mechanics, &frame);
        gravity = InPlane(mechanics, gravity);
    }
    if (frame.held) {
        return kiriFlight_Held(&frame, &system->material, dt);
    }
    return IsAffine(mechanics) ? kiriFlight_Affine(&frame, &system->material, gravity, dt)
                               : kiriFlight_Free(&frame, &system->material, gravity, dt);
}

static void Begin(kiriSolver* solver, const kiriSystem* system, double dt)
{
    solver->dt = dt;
    solver->damping = (double)system->material.flexDamping / dt;
    solver->isBraking = false;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        solver->start.data[f] = kiriPose_Of(&system->frames[f]);
        solver->flights.data[f] = FlightOf(system, f, dt);
        solver->poses.data[f] = solver->flights.data[f].coast;
        solver->trial.data[f] = solver->flights.data[f].pose;
    }
    for (int32_t k = 0; k < ElementCount(system); ++k) {
        StiffnessOf(system, k, &solver->stiffness.data[MOST_ROWS * k]);
        Measure(system, k, solver->start.data, &solver->startStrain.data[MOST_ROWS * k], NULL);
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (system->frames[f].held) {
            solver->start.data[f] = solver->flights.data[f].pose;
        }
    }
}

/* How much of the Gauss-Newton step turns no frame too far. */
static double LongestStep(const kiriSolver* solver, const kiriSystem* system)
{
    double longest = LONGEST_TURN;
    for (int32_t f = 0; f < system->frameCount; ++f) {
        Slots change = Expand(solver, 1.0, &solver->move.data[solver->size * f]);
        double turn = kiriVec3_Length(change.by[1]);
        longest = !IsAffine(&system->mechanics) && turn > longest ? turn : longest;
    }
    return LONGEST_TURN / longest;
}

static void Try(kiriSolver* solver, const kiriSystem* system, double scale)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriPose* pose = &solver->poses.data[f];
        Slots change = Expand(solver, scale, &solver->move.data[solver->size * f]);
        kiriMat3 columns = { change.by[1], change.by[2], change.by[3] };
        solver->trial.data[f].x = kiriVec3_Add(pose->x, change.by[0]);
        solver->trial.data[f].A = IsAffine(&system->mechanics)
                                      ? kiriMat3_Advance(&pose->A, &columns)
                                      : kiriMat3_MulMat(kiriMat3_Cayley(change.by[1]), pose->A);
    }
}

static void TakeTrial(kiriSolver* solver)
{
    kiriPose* taken = solver->trial.data;
    solver->trial.data = solver->poses.data;
    solver->poses.data = taken;
}

/* One Gauss-Newton step, halved until the objective falls, or is at most `allowed`. False when the matrix has no
   factor. */
static bool Iterate(kiriSolver* solver, const kiriSystem* system, double allowed, double* objective)
{
    Assemble(solver, system);
    if (!kiriMatrix_Factor(solver->matrix)) {
        return false;
    }
    kiriMatrix_Solve(solver->matrix, solver->force.data, solver->move.data);
    *objective = Objective(solver, system, solver->poses.data);
    double most = allowed > *objective ? allowed : *objective, scale = LongestStep(solver, system), taken = 0.0;
    for (int halving = 0; halving <= HALVINGS && taken == 0.0; ++halving, scale *= 0.5) {
        Try(solver, system, scale);
        double value = Objective(solver, system, solver->trial.data);
        if (value <= most * (1.0 + ROUNDING)) {
            *objective = value;
            taken = scale;
        }
    }
    Try(solver, system, taken);
    TakeTrial(solver);
    return true;
}

/* The iteration starts where the frames coast by their velocities: a strip that swings is then nearly there, and one at
   rest is there. The first step may raise the objective up to that of the free flight: it has to turn stiff frames,
   which stretches links before the next step lets them go, and halving it there would freeze the turning.

   The objective must not end above that of not moving at all. Then kinetic and elastic energy at the end are at most
   those at the start and the work of the forces, however long the step: nothing is ever flung away. Should it end above
   all the same, the iteration starts anew from not moving, from where it only falls. */
static int32_t Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations)
{
    double allowed = Objective(solver, system, solver->trial.data), objective = HUGE_VAL;
    double limit = Objective(solver, system, solver->start.data) * (1.0 + ROUNDING);
    int32_t done = 0, chances = iterations + SECOND_CHANCES;
    while (done < iterations || (done < chances + FRESH_STARTS && !(objective <= limit))) {
        if (done == chances) {
            memcpy(solver->poses.data, solver->start.data, sizeof(kiriPose) * (size_t)system->frameCount);
        }
        /* Before the first step the push is that of the free flight, far too strong at an impact. */
        solver->isBraking = done > 0 || iterations == 1;
        if (!Iterate(solver, system, done == 0 ? allowed : 0.0, &objective)) {
            return -1;
        }
        ++done;
    }
    return done;
}

static bool IsFinite(kiriVec3 a)
{
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static bool AreFinite(const kiriMat3* A)
{
    return IsFinite(A->u) && IsFinite(A->v) && IsFinite(A->d);
}

/* By how much the rate of A differs from that of the free flight. */
static void LandAffine(const kiriSolver* solver, int32_t f)
{
    kiriFlight* flight = &solver->flights.data[f];
    const kiriMat3 *A = &solver->poses.data[f].A, *free = &flight->pose.A;
    double perTime = 1.0 / solver->dt;
    flight->rate.u = kiriVec3_AddScaled(flight->rate.u, perTime, kiriVec3_Sub(A->u, free->u));
    flight->rate.v = kiriVec3_AddScaled(flight->rate.v, perTime, kiriVec3_Sub(A->v, free->v));
    flight->rate.d = kiriVec3_AddScaled(flight->rate.d, perTime, kiriVec3_Sub(A->d, free->d));
    flight->spin = kiriMat3_Spin(A, &flight->rate);
    flight->rate = kiriMat3_Beside(A, &flight->rate, flight->spin);
}

/* Velocities at the end of the step. False when something is not finite. */
static bool Land(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriFlight* flight = &solver->flights.data[f];
        const kiriPose* pose = &solver->poses.data[f];
        flight->velocity =
            kiriVec3_AddScaled(flight->velocity, 1.0 / solver->dt, kiriVec3_Sub(pose->x, flight->pose.x));
        if (!IsAffine(&system->mechanics)) {
            kiriMat3 inertia = kiriFlight_Inertia(flight, &pose->A);
            kiriVec3 turn = kiriMat3_Solve(&inertia, kiriFlight_TurnGradient(flight, &pose->A));
            flight->spin = kiriVec3_AddScaled(flight->spin, 1.0 / solver->dt, turn);
        } else if (!system->frames[f].held) {
            LandAffine(solver, f);
        }
        if (!IsFinite(pose->x) || !AreFinite(&pose->A) || !AreFinite(&flight->rate) || !IsFinite(flight->velocity) ||
            !IsFinite(flight->spin)) {
            return false;
        }
    }
    return true;
}

static void Finish(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriFrameData* frame = &system->frames[f];
        const kiriPose* pose = &solver->poses.data[f];
        frame->x = pose->x;
        frame->A = frame->held                    ? frame->heldRotation
                   : IsAffine(&system->mechanics) ? pose->A
                                                  : kiriMat3_Rotation(pose->A);
        frame->velocity = solver->flights.data[f].velocity;
        frame->spin = solver->flights.data[f].spin;
        frame->rate = solver->flights.data[f].rate;
    }
}

int32_t kiriSolver_Step(kiriSolver* solver, const kiriSystem* system, double dt, int32_t iterations)
{
    Begin(solver, system, dt);
    int32_t done = Minimise(solver, system, iterations);
    if (done < 0 || !Land(solver, system)) {
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
        Measure(system, k, NULL, strain, NULL);
        StiffnessOf(system, k, stiffness);
        for (int e = 0; e < RowCount(system, k); ++e) {
            sum += 0.5 * stiffness[e] * strain[e] * strain[e];
        }
    }
    return sum;
}
