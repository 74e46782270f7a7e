/* Where contacts start in a step: whom they act on, where their planes are, and the first guess of what they do. */
#include "kiri_solver_work.h"

#define LEAST_FREE 0.5 /* of the weights of a contact: those of frames that the host does not hold */
#define FAR_BELOW 1e9  /* m: of planes that nothing can touch */

bool kiriSolver_ReserveContacts(kiriSolver* solver, int32_t count)
{
    return kiriArray_Reserve(solver->memory, &solver->contacts, count);
}

/* The row acts on its largest frames that all have a block of the matrix in common: so that what it couples is solved
   for exactly. */
static void ChooseMembers(const kiriSolver* solver, const kiriContactRow* row, kiriContactStep* step)
{
    double sum = 0.0;
    step->memberCount = 0;
    for (int32_t n = 0; n < row->weightCount && step->memberCount < KIRI_CONTACT_MEMBERS; ++n) {
        bool isCoupled = true;
        for (int32_t m = 0; isCoupled && m < step->memberCount; ++m) {
            kiriPair pair = { step->members[m].frame, row->weights[n].frame };
            isCoupled = kiriMatrix_Covers(solver->matrix, pair);
        }
        if (isCoupled) {
            step->members[step->memberCount++] = row->weights[n];
            sum += row->weights[n].value;
        }
    }
    for (int32_t m = 0; m < step->memberCount; ++m) {
        step->members[m].value /= sum;
    }
}

/* Where the plane is at the end of the step, and how far the obstacle goes. A point that starts below the plane ends no
   higher than `pushSpeed` lets it. */
static void PlacePlane(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriContactRow* row = &system->contacts[k];
    kiriContactStep* step = &solver->contacts.data[k];
    const kiriPose* poses = solver->start.data;
    step->start = kiriContact_Point(solver, system, k, poses);
    kiriVec3 off =
        kiriVec3_Sub(step->start, kiriSystem_PointOfMany(system, row->weights, row->weightCount, row->at, poses));
    step->carried = kiriVec3_Scale(solver->dt, kiriContact_PlaneVelocity(system, k, step->start));
    double now = row->offset + kiriVec3_Dot(row->normal, kiriVec3_Add(row->way, off));
    double depth = now - kiriVec3_Dot(row->normal, step->start), pushed = row->pushSpeed * solver->dt;
    step->lowered = depth > pushed ? depth - pushed : 0.0;
    step->lift = kiriVec3_Dot(row->normal, step->carried) + (depth > 0.0 ? depth - step->lowered : 0.0);
    step->plane = now + kiriVec3_Dot(row->normal, step->carried) - step->lowered - (step->isHeld ? FAR_BELOW : 0.0);
}

/* A point that goes with frames that the host holds goes where these go. Other frames, which hardly carry it, would
   have to move many times as far as it is deep, and a contact has the force for that. */
static bool IsHeld(const kiriSystem* system, const kiriContactStep* step)
{
    double free = 0.0;
    for (int32_t m = 0; m < step->memberCount; ++m) {
        free += system->frames[step->members[m].frame].held ? 0.0 : step->members[m].value;
    }
    return free < LEAST_FREE;
}

static double MassOf(const kiriSystem* system, const kiriContactStep* step)
{
    double mass = 0.0;
    for (int32_t m = 0; m < step->memberCount; ++m) {
        mass += step->members[m].value * system->frames[step->members[m].frame].mass;
    }
    return mass;
}

/* J: what an obstacle can give by moving along the normal: its kinetic energy; or no end of it, where it does not
   yield. Another piece has no more than its cushion says. */
static double MeansOf(const kiriSystem* system, int32_t k, const kiriContactStep* step, double dt)
{
    double speed = kiriVec3_Dot(system->contacts[k].normal, step->carried) / dt;
    double inverse = kiriContact_InverseMass(system, k, step->start, system->contacts[k].normal);
    inverse += system->contacts[k].cushion;
    return !(fabs(speed) > 0.0) ? 0.0 : inverse > 0.0 ? 0.5 * speed * speed / inverse : DBL_MAX;
}

/* J: the energy that a piece has to spend in a step in which contacts touch it: its own, and what gravity, forces and
   obstacles may add. */
static void FindMeans(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriContact_PieceOf(solver, system, k);
        const kiriContactStep* step = &solver->contacts.data[k];
        if (step->isHeld) {
            continue;
        }
        double fast = (kiriVec3_Length(step->carried) + fabs(step->lift)) / solver->dt;
        double given = MeansOf(system, k, step, solver->dt);
        piece->obstacleSpeed = kiriMax(fast, piece->obstacleSpeed);
        piece->means = kiriMax(given, piece->means);
        piece->isNear = true;
    }
    double gravity = kiriVec3_Length(kiriSystem_Gravity(system));
    KIRI_EACH(f, solver->awake.frames) {
        const kiriFrameData* frame = &solver->before.data[f];
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (piece->isNear) {
            double pull = gravity + kiriVec3_Length(frame->force) / frame->mass;
            double own = kiriVec3_Length(frame->velocity), speed = own + solver->dt * pull + piece->obstacleSpeed;
            piece->means +=
                kiriFrame_KineticEnergy(frame, &system->material) + 0.5 * frame->mass * (speed * speed - own * own);
        }
    }
}

void kiriSolver_BeginContacts(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_ASSERT(solver->contacts.capacity >= system->contactCount);
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContactStep* step = &solver->contacts.data[k];
        memset(step, 0, sizeof(*step));
        ChooseMembers(solver, &system->contacts[k], step);
        step->isHeld = IsHeld(system, step);
        step->mass = MassOf(system, step);
        PlacePlane(solver, system, k);
    }
    FindMeans(solver, system);
}

/* The first guess: what free motion runs into pushes with what stops it, and what pushed in the last step goes on,
   unless free motion leaves it. It sticks where friction can stop its slide. */
static void GuessState(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriContactRow* row = &system->contacts[k];
    kiriContactStep* step = &solver->contacts.data[k];
    double inertia = kiriContact_Inertia(solver, system, k), was = kiriVec3_Dot(row->normal, row->force);
    kiriVec3 predicted = { 0.0, 0.0, 0.0 }, free = predicted;
    for (int32_t m = 0; m < step->memberCount; ++m) {
        const kiriPrediction* prediction = &solver->predictions.data[step->members[m].frame];
        kiriVec3 arm = kiriSystem_Arm(system, step->members[m].frame, row->at, &prediction->pose);
        predicted = kiriVec3_AddScaled(predicted, step->members[m].value, kiriVec3_Add(prediction->pose.x, arm));
        arm = kiriSystem_Arm(system, step->members[m].frame, row->at, &prediction->guess);
        free = kiriVec3_AddScaled(free, step->members[m].value, kiriVec3_Add(prediction->guess.x, arm));
    }
    double stop = inertia * (step->plane - kiriVec3_Dot(row->normal, predicted));
    double gap = kiriVec3_Dot(row->normal, free) - step->plane;
    kiriVec3 slide = kiriVec3_Sub(kiriVec3_Sub(predicted, step->start), step->carried);
    slide = kiriVec3_AlongPlane(slide, row->normal);
    step->held = kiriVec3_AlongPlane(row->force, row->normal);
    step->isActive = was > 0.0 ? was + stop > 0.0 : gap < 0.0;
    step->push = 0.0;
    step->drag = kiriVec3_Make(0.0, 0.0, 0.0);
    double pressing = was > 0.0 ? was : kiriMax(stop, 0.0);
    step->limit = step->isActive ? row->friction * pressing : 0.0;
    double length = kiriVec3_Length(slide);
    step->sticks = inertia * length <= step->limit || kiriVec3_Length(step->held) < 0.999 * row->friction * was;
    step->direction = kiriVec3_Scale(length > KIRI_SLIDE_FLOOR ? 1.0 / length : 0.0, slide);
    step->known = kiriMax(pressing, stop);
}

/* Of the pieces that are new. */
void kiriSolver_GuessContacts(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (kiriContact_PieceOf(solver, system, k)->isNew) {
            GuessState(solver, system, k);
        }
    }
}
