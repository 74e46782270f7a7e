#include "kiri_solver_work.h"

#define ONE_SIDED 0.5  /* of the pushes of a piece: less as their sum, and they push against each other */
#define MOST_MORE 30.0 /* times what contacts of a pinned piece say of themselves */

/* Pieces on which nothing acts but pins, contacts, gravity and forces. */
static void ChoosePinned(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->pinCount; ++k) {
        kiriSolver_PieceOf(solver, system->pins[k].frame)->isPinned = !kiriSystem_HasWind(system);
    }
    for (int32_t k = 0; k < system->clampCount; ++k) {
        kiriSolver_PieceOf(solver, system->clamps[k].frame)->isPinned = false;
    }
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        piece->isPinned = piece->isPinned && !system->frames[f].held;
    }
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->asked = piece->given = kiriVec3_Make(0.0, 0.0, 0.0);
        piece->pressed = piece->held = 0.0;
    }
}

/* `asked` of each piece: what its momentum and its pins say that contacts did, N s; `given`: what contacts say. */
static void SumPinned(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        const kiriFrameData *before = &solver->before.data[f], *after = &solver->after.data[f];
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        kiriVec3 gravity = kiriVec3_Scale(before->mass, kiriSystem_Gravity(system));
        kiriVec3 change = kiriVec3_Scale(before->mass, kiriVec3_Sub(after->velocity, before->velocity));
        change = kiriVec3_AddScaled(change, -solver->dt, kiriVec3_Add(gravity, before->force));
        piece->asked = kiriVec3_Add(piece->asked, change);
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        const kiriPinRow* pin = &system->pins[k];
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, pin->frame);
        kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, pin->frame, pin->at, solver->poses.data), pin->target);
        piece->asked = kiriVec3_AddScaled(piece->asked, piece->stepping.part * pin->stiffness, off);
        piece->held += pin->stiffness;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
        kiriVec3 impulse = kiriVec3_Scale(piece->stepping.part, kiriContact_Force(solver, system, k));
        piece->given = kiriVec3_Add(piece->given, impulse);
        piece->pressed += kiriVec3_Length(impulse);
    }
}

/* A pinned sheet that something heavy runs into stands stretched, after as many systems as there are, by more than the
   linear model of its contacts knows. What changed its momentum less what its pins bear is what contacts did. Contacts
   that press from two sides say nothing of their sum. */
static void FindMore(kiriSolver* solver)
{
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        double fit = kiriVec3_Dot(piece->asked, piece->given), size = kiriVec3_Dot(piece->given, piece->given);
        bool isClear = size > ONE_SIDED * ONE_SIDED * piece->pressed * piece->pressed;
        piece->more = 1.0;
        if (piece->isPinned && isClear && fit > 0.0) {
            double more = kiriMin(fit / size, MOST_MORE);
            piece->keepForces *= kiriMin(more, 1.0);
            piece->given = kiriVec3_Scale(kiriMin(more, 1.0), piece->given);
            piece->more = kiriMax(1.0, more);
        }
    }
}

/* ---- What obstacles may have of it ------------------------------------------------------------------------------- */

/* Did a contact on what may yield do more than it says? */
static bool IsShort(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    return system->contacts[k].yield != KIRI_NONE &&
           kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame)->more > 1.0;
}

/* The push on the obstacle times the speed of the obstacle along it, and of the sheet, N s m/s. */
static void FindPower(const kiriSolver* solver, const kiriSystem* system, int32_t k, double* ofObstacle,
                      double* ofSheet)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    kiriVec3 point = kiriContact_Point(solver, system, k, solver->poses.data), way = { 0.0, 0.0, 0.0 };
    double part = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame)->stepping.part;
    kiriVec3 push = kiriVec3_Scale(-part, kiriContact_Force(solver, system, k));
    for (int32_t m = 0; m < step->memberCount; ++m) {
        const kiriFrameData* frame = &solver->after.data[step->members[m].frame];
        kiriVec3 velocity = kiriFrame_VelocityAt(frame, system->contacts[k].at);
        way = kiriVec3_AddScaled(way, step->members[m].value, velocity);
    }
    *ofObstacle = kiriVec3_Dot(push, kiriContact_PlaneVelocity(system, k, point));
    *ofSheet = kiriVec3_Dot(push, way);
}

/* Gives obstacles what contacts say, and sums what that makes of their speeds. */
static void GivePushes(const kiriSolver* solver, const kiriSystem* system)
{
    double ofObstacle, ofSheet;
    for (int32_t k = 0; k < system->yieldCount; ++k) {
        system->yields[k].before = system->yields[k].after = system->yields[k].most = 0.0;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (IsShort(solver, system, k)) {
            FindPower(solver, system, k, &ofObstacle, &ofSheet);
            system->yields[system->contacts[k].yield].before += ofObstacle;
            system->yields[system->contacts[k].yield].most += kiriMax(ofSheet, 0.0);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContact_Give(solver, system, k, 1.0);
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (IsShort(solver, system, k)) {
            FindPower(solver, system, k, &ofObstacle, &ofSheet);
            system->yields[system->contacts[k].yield].after += ofObstacle;
        }
    }
}

/* More than what contacts say may stop an obstacle, or let it go as fast as the sheet does there, but not faster: the
   momentum that a cloth has can be thousands of times that of a light body on it. */
static void LimitMore(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
        if (IsShort(solver, system, k)) {
            const kiriYieldRow* yield = &system->yields[system->contacts[k].yield];
            double each = yield->after - yield->before, room = yield->most - yield->before;
            double most = room > each ? room / each : 1.0;
            piece->more = each > 0.0 && piece->more > most ? most : piece->more;
        }
    }
}

static void GiveMore(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
        if (IsShort(solver, system, k)) {
            kiriContact_Give(solver, system, k, piece->more - 1.0);
        }
    }
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->keepForces *= piece->more;
        piece->given = kiriVec3_Scale(piece->more, piece->given);
    }
}

/* ---- What pins have of it ---------------------------------------------------------------------------------------- */

/* Pins are stiff: where a frame turns in the last system, its pins stretch by other lengths than the system had. What
   changed the momentum of the piece and was not the contacts was the pins. Each gets of the rest by its stiffness, as
   if the piece stood a little aside. */
static void BalancePins(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; system->reactions.pins != NULL && k < system->pinCount; ++k) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->pins[k].frame);
        if (piece->isPinned && piece->isNear && piece->stepping.isEuler) {
            kiriVec3 left = kiriVec3_Sub(piece->asked, piece->given);
            kiriVec3* impulse = &system->reactions.pins[k].impulse.force;
            *impulse = kiriVec3_AddScaled(*impulse, system->pins[k].stiffness / piece->held, left);
        }
    }
}

void kiriSolver_BalancePinned(kiriSolver* solver, const kiriSystem* system)
{
    ChoosePinned(solver, system);
    SumPinned(solver, system);
    FindMore(solver);
    GivePushes(solver, system);
    LimitMore(solver, system);
    GiveMore(solver, system);
    BalancePins(solver, system);
}
