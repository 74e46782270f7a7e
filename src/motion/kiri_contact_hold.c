/* What holds where the systems of a step do not settle which contacts push: nothing goes through an obstacle. */
#include "kiri_solver_work.h"

#define MOST_DEPTH 5e-3      /* m: less is left to the next step, which pushes it out: what rests needs that */
#define TOLERABLE_DEPTH 1e-3 /* m: what is left where something is held */
#define MOST_TURN 0.3        /* of a frame, roughly its angle, while it is held */
#define LEAST_WEIGHT 0.05    /* of a frame that is held */
#define SWEEPS 12            /* over all contacts */

/* ---- Which are too deep ------------------------------------------------------------------------------------------ */

/* m: how far the obstacle is pushed down. */
static double Yielded(const kiriContactStep* step)
{
    double held = step->push - kiriMax(step->solved, 0.0);
    double more = held > 0.0 ? held * (step->shared - step->give) : 0.0;
    return step->push > 0.0 ? step->push * step->give + more : 0.0;
}

/* Marks the pieces that are too deep in something, and keeps where the systems left them. */
static bool FindDeep(kiriSolver* solver, const kiriSystem* system)
{
    bool any = false;
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isHeldUp = solver->pieces.data[i].isSearching = false;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContactStep* step = &solver->contacts.data[k];
        step->solved = step->push;
        double depth = kiriContact_Depth(solver, system, k, solver->poses.data) - Yielded(step);
        if (depth > MOST_DEPTH) {
            kiriContact_PieceOf(solver, system, k)->isSearching = any = true;
        }
    }
    if (any) {
        KIRI_EACH(f, solver->awake.frames) {
            solver->trial.data[f] = solver->poses.data[f];
        }
    }
    return any;
}

/* Contacts that pressed in the last system shared the mass of an obstacle. Many more may be held: all that may be share
   it now, else each would push the obstacle out as if it were the only one, and a light body would be shot off. */
static void ShareMass(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->yieldCount; ++k) {
        system->yields[k].held = 0;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        int32_t yield = system->contacts[k].yield;
        if (yield != KIRI_NONE && kiriContact_PieceOf(solver, system, k)->isSearching) {
            system->yields[yield].held += 1;
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriYieldRow* yield =
            system->contacts[k].yield != KIRI_NONE ? &system->yields[system->contacts[k].yield] : NULL;
        kiriContactStep* step = &solver->contacts.data[k];
        int32_t pressed = yield != NULL && yield->pressed > 1 ? yield->pressed : 1;
        step->shared = yield != NULL && yield->held > pressed ? step->give * yield->held / pressed : step->give;
    }
}

/* ---- Frame by frame ---------------------------------------------------------------------------------------------- */

/* Touches are found for frames as they are turned at the start: else other points of the material are below planes. */
static void TurnBack(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        const kiriMat3 *start = &solver->start.data[f].A, *end = &solver->poses.data[f].A;
        kiriVec3 u = kiriVec3_Sub(end->u, start->u), v = kiriVec3_Sub(end->v, start->v);
        double turn = kiriVec3_Dot(u, u) + kiriVec3_Dot(v, v);
        if (kiriSolver_PieceOf(solver, f)->isSearching && !system->frames[f].held && turn > MOST_TURN * MOST_TURN) {
            solver->poses.data[f].A = *start;
        }
    }
}

static kiriVec3 Along(const kiriSystem* system, int32_t k)
{
    kiriVec3 normal = system->contacts[k].normal;
    return system->mechanics.planar ? kiriMechanics_InPlane(&system->mechanics, normal) : normal;
}

/* Pushes a frame so far that it carries the point no further than to the plane. It only moves, and does not turn: so
   depths change as they should, however far it has turned. That each frame does so, and not their blend alone, keeps
   frames from passing each other on their way to the plane, and with them what is between the points. */
static bool HoldMember(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t f)
{
    kiriContactStep* step = &solver->contacts.data[k];
    kiriVec3 normal = system->contacts[k].normal, along = Along(system, k);
    kiriVec2 at = system->contacts[k].at;
    kiriVec3 way = kiriVec3_Sub(kiriSystem_Point(system, f, at, solver->poses.data),
                                kiriSystem_Point(system, f, at, solver->start.data));
    double depth = step->plane - kiriVec3_Dot(normal, kiriVec3_Add(step->start, way)) - Yielded(step);
    double part = kiriSolver_PieceOf(solver, f)->stepping.part, share = kiriVec3_Dot(along, along);
    if (system->frames[f].held || !(depth > TOLERABLE_DEPTH) || !(share > 0.0)) {
        return false;
    }
    double inertia = system->frames[f].mass / (part * part), push = depth / (share / inertia + step->shared);
    step->push += push;
    solver->poses.data[f].x = kiriVec3_AddScaled(solver->poses.data[f].x, push / inertia, along);
    return true;
}

static bool HoldFrames(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    bool any = false;
    for (int32_t m = 0; m < step->memberCount; ++m) {
        any |= step->members[m].value > LEAST_WEIGHT && HoldMember(solver, system, k, step->members[m].frame);
    }
    return any;
}

/* ---- As a whole -------------------------------------------------------------------------------------------------- */

/* Moves all frames of the piece alike, which stores no energy in it. */
static bool HoldPiece(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    kiriContactStep* step = &solver->contacts.data[k];
    const kiriPieceStep* piece = kiriContact_PieceOf(solver, system, k);
    kiriVec3 along = Along(system, k);
    double depth = kiriContact_Depth(solver, system, k, solver->poses.data) - Yielded(step);
    double inertia = piece->mass / (piece->stepping.part * piece->stepping.part), share = kiriVec3_Dot(along, along);
    if (!(piece->mass > 0.0) || !(depth > TOLERABLE_DEPTH) || !(share > 0.0)) {
        return false;
    }
    double push = depth / (share / inertia + step->shared);
    step->push += push;
    KIRI_EACH(f, solver->awake.frames) {
        if (kiriSolver_PieceOf(solver, f) == piece && !system->frames[f].held) {
            solver->poses.data[f].x = kiriVec3_AddScaled(solver->poses.data[f].x, push / inertia, along);
        }
    }
    return true;
}

static void SumMasses(kiriSolver* solver, const kiriSystem* system)
{
    kiriSolver_ClearMeans(solver);
    KIRI_EACH(f, solver->awake.frames) {
        kiriSolver_PieceOf(solver, f)->mass += system->frames[f].held ? 0.0 : system->frames[f].mass;
    }
}

/* ---- Both -------------------------------------------------------------------------------------------------------- */

static void SweepHolds(kiriSolver* solver, const kiriSystem* system, bool isWhole)
{
    bool isLeft = true;
    for (int sweep = 0; isLeft && sweep < SWEEPS; ++sweep) {
        isLeft = false;
        for (int32_t k = 0; k < system->contactCount; ++k) {
            if (kiriContact_PieceOf(solver, system, k)->isSearching) {
                isLeft |= isWhole ? HoldPiece(solver, system, k) : HoldFrames(solver, system, k);
            }
        }
    }
}

/* Pieces that would store more than they have are put back where the systems left them. Returns whether there are
   any. */
static bool TakeHeld(kiriSolver* solver, const kiriSystem* system)
{
    bool isLeft = false;
    kiriObjective_Evaluate(solver, system, solver->poses.data);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        double most = piece->start.potential + piece->means;
        most = kiriMax(most, piece->now.potential);
        if (piece->isSearching && piece->sum.potential <= most) {
            piece->now = piece->sum;
            piece->isHeldUp = true;
            piece->isSearching = false;
        }
        isLeft |= piece->isSearching;
    }
    KIRI_EACH(f, solver->awake.frames) {
        if (kiriSolver_PieceOf(solver, f)->isSearching) {
            solver->poses.data[f] = solver->trial.data[f];
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContactStep* step = &solver->contacts.data[k];
        step->push = kiriContact_PieceOf(solver, system, k)->isSearching ? step->solved : step->push;
    }
    return isLeft;
}

void kiriSolver_HoldContacts(kiriSolver* solver, const kiriSystem* system)
{
    if (!FindDeep(solver, system)) {
        return;
    }
    ShareMass(solver, system);
    TurnBack(solver, system);
    SweepHolds(solver, system, false);
    if (TakeHeld(solver, system)) {
        SumMasses(solver, system);
        SweepHolds(solver, system, true);
        TakeHeld(solver, system);
    }
    kiriSolver_FindGains(solver, system);
}
