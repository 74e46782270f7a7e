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
        piece->pressed = 0.0;
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
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
        kiriVec3 impulse = kiriVec3_Scale(piece->stepping.part, kiriContact_Force(solver, system, k));
        piece->given = kiriVec3_Add(piece->given, impulse);
        piece->pressed += kiriVec3_Length(impulse);
    }
}

/* A pinned sheet that something heavy runs into stands stretched, after as many systems as there are, by more than the
   linear model of its contacts knows. What changed its momentum less what its pins bear is what contacts did: so
   obstacles feel as much, and are stopped. Contacts that press from two sides say nothing of their sum. */
void kiriSolver_BalancePinned(kiriSolver* solver, const kiriSystem* system)
{
    ChoosePinned(solver, system);
    SumPinned(solver, system);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        double fit = kiriVec3_Dot(piece->asked, piece->given), size = kiriVec3_Dot(piece->given, piece->given);
        bool isClear = size > ONE_SIDED * ONE_SIDED * piece->pressed * piece->pressed;
        if (piece->isPinned && isClear && fit > 0.0) {
            piece->keepForces *= fit / size < MOST_MORE ? fit / size : MOST_MORE;
        }
    }
}
