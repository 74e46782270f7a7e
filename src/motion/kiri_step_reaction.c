#include "kiri_solver_work.h"

/* What a strain that pulls with -`pull` does to a frame, by its derivative. */
static void AddPull(const kiriSolver* solver, const kiriFrameRow* row, double pull, const kiriMat3* A, kiriWrench* sum)
{
    kiriVec3 torque = row->by[1];
    if (kiriMechanics_IsAffine(&solver->mechanics)) {
        torque = kiriVec3_Add(kiriVec3_Cross(A->u, row->by[1]), kiriVec3_Cross(A->v, row->by[2]));
        torque = kiriVec3_Add(torque, kiriVec3_Cross(A->d, row->by[3]));
    }
    sum->force = kiriVec3_AddScaled(sum->force, pull, row->by[0]);
    sum->moment = kiriVec3_AddScaled(sum->moment, pull, torque);
}

static kiriWrench ForceAt(const kiriSolver* solver, int32_t frame, kiriVec3 point, kiriVec3 force)
{
    kiriWrench wrench = { force, kiriVec3_Cross(kiriVec3_Sub(point, solver->poses.data[frame].x), force) };
    return wrench;
}

/* A wrench about a frame's x, about another point. */
static kiriWrench AboutPoint(const kiriWrench* wrench, kiriVec3 x, kiriVec3 point)
{
    kiriVec3 arm = kiriVec3_Sub(x, point);
    kiriWrench moved = { wrench->force, kiriVec3_Add(wrench->moment, kiriVec3_Cross(arm, wrench->force)) };
    return moved;
}

/* Whatever acts on the frame beside its own forces and the host's hold: the hold takes it up. */
static void TakeFromHold(const kiriSolver* solver, const kiriSystem* system, int32_t frame, kiriWrench wrench)
{
    if (system->reactions.frames != NULL && system->frames[frame].held) {
        kiriVec3 held = solver->before.data[frame].heldPosition;
        wrench = AboutPoint(&wrench, solver->poses.data[frame].x, held);
        kiriWrench_Add(&system->reactions.frames[frame].now, -1.0, &wrench);
    }
}

static void AddPinPulls(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->pinCount; ++k) {
        const kiriPinRow* pin = &system->pins[k];
        kiriVec3 point = kiriSystem_Point(system, pin->frame, pin->at, solver->poses.data);
        kiriVec3 force = kiriVec3_Scale(-pin->stiffness, kiriVec3_Sub(point, pin->target));
        if (system->reactions.pins != NULL) {
            system->reactions.pins[k].now.force = force;
        }
        TakeFromHold(solver, system, pin->frame, ForceAt(solver, pin->frame, point, force));
    }
}

static void AddClamps(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->clampCount; ++k) {
        const kiriClampRow* row = &system->clamps[k];
        const kiriPose* pose = &solver->poses.data[row->frame];
        double strain[KIRI_CLAMP_STRAINS], pulling[KIRI_CLAMP_STRAINS];
        kiriFrameRow rows[KIRI_CLAMP_STRAINS];
        kiriWrench wrench = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
        kiriClamp_Measure(row, &system->frames[row->frame], &row->pose, pose, strain, rows);
        kiriClamp_TakeOffsets(row, strain, pulling);
        for (int e = 0; e < row->strainCount; ++e) {
            double pull = -row->stiffness[e] * pulling[e] - row->loss[e] * (strain[e] - row->startStrain[e]);
            AddPull(solver, &rows[e], pull, &pose->A, &wrench);
        }
        if (system->reactions.clamps != NULL) {
            system->reactions.clamps[k].now = AboutPoint(&wrench, pose->x, row->pose.x);
        }
        TakeFromHold(solver, system, row->frame, wrench);
    }
}

static void AddContacts(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriContactStep* step = &solver->contacts.data[k];
        kiriVec3 force = kiriContact_Force(solver, system, k);
        for (int32_t m = 0; m < step->memberCount; ++m) {
            int32_t frame = step->members[m].frame;
            kiriVec3 point = kiriSystem_Point(system, frame, system->contacts[k].at, solver->poses.data);
            kiriVec3 part = kiriVec3_Scale(step->members[m].value, force);
            TakeFromHold(solver, system, frame, ForceAt(solver, frame, point, part));
        }
    }
}

static void AddWind(const kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        if (kiriSystem_HasWind(system) && system->frames[f].held) {
            TakeFromHold(solver, system, f, kiriWind_OnFrame(solver, system, f));
        }
    }
}

static bool HasHeldMember(const kiriSolver* solver, const kiriSystem* system, int32_t count)
{
    bool any = false;
    for (int32_t m = 0; m < count; ++m) {
        any |= system->frames[solver->members.data[m]].held != 0;
    }
    return any;
}

/* What element k does to the frames that are held. */
static void AddHeldElement(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    int32_t count = kiriElement_Members(system, k, solver->members.data);
    double strain[KIRI_MOST_STRAINS], pulling[KIRI_MOST_STRAINS];
    if (!HasHeldMember(solver, system, count)) {
        return;
    }
    kiriElement_Measure(system, k, solver->poses.data, strain, solver->rows.data);
    kiriElement_TakeOffsets(system, k, strain, pulling);
    for (int32_t m = 0; m < count; ++m) {
        int32_t frame = solver->members.data[m];
        kiriWrench wrench = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
        for (int e = 0; e < kiriElement_StrainCount(system, k); ++e) {
            int32_t n = KIRI_MOST_STRAINS * k + e;
            double change = strain[e] - solver->startStrain.data[n];
            double pull = -solver->stiffness.data[n] * pulling[e] - solver->loss.data[n] * change;
            AddPull(solver, &solver->rows.data[count * e + m], pull, &solver->poses.data[frame].A, &wrench);
        }
        TakeFromHold(solver, system, frame, wrench);
    }
}

/* What changes the momentum of a held frame in the step, beside gravity and the host's forces on it. */
static void AddMomentum(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriFrameData *before = &solver->before.data[f], *after = &solver->after.data[f];
    kiriVec3 gravity = kiriVec3_Scale(before->mass, kiriSystem_Gravity(system));
    kiriVec3 gained = kiriVec3_Scale(before->mass, kiriVec3_Sub(after->velocity, before->velocity));
    kiriVec3 turned = kiriVec3_Sub(kiriFrame_AngularMomentum(after, &system->material),
                                   kiriFrame_AngularMomentum(before, &system->material));
    kiriWrench wrench = { kiriVec3_AddScaled(gained, -solver->dt, kiriVec3_Add(gravity, before->force)),
                          kiriVec3_AddScaled(turned, -solver->dt, before->torque) };
    wrench = AboutPoint(&wrench, solver->poses.data[f].x, before->heldPosition);
    kiriWrench_Add(&system->reactions.frames[f].impulse, 1.0, &wrench);
}

/* What was found at the end of the step gives an impulse as inner forces do by the step's scheme (kiri_stepping.h):
   so impulses add up to the momentum that frames have got. */
static void EndReaction(const kiriStepping* stepping, kiriReaction* reaction)
{
    kiriWrench gain = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } }, none = gain;
    kiriWrench_Add(&gain, stepping->c, &reaction->gain);
    kiriWrench_Add(&gain, stepping->l, &reaction->pull);
    kiriWrench_Add(&gain, stepping->part, &reaction->now);
    kiriWrench_Add(&reaction->impulse, 1.0, &gain);
    reaction->gain = gain;
    reaction->pull = reaction->now;
    reaction->now = none;
}

static void EndReactions(const kiriSolver* solver, const kiriSystem* system)
{
    const kiriReactions* reactions = &system->reactions;
    for (int32_t k = 0; reactions->pins != NULL && k < system->pinCount; ++k) {
        EndReaction(&kiriSolver_PieceOf(solver, system->pins[k].frame)->stepping, &reactions->pins[k]);
    }
    for (int32_t k = 0; reactions->clamps != NULL && k < system->clampCount; ++k) {
        EndReaction(&kiriSolver_PieceOf(solver, system->clamps[k].frame)->stepping, &reactions->clamps[k]);
    }
    KIRI_EACH(f, solver->awake.frames) {
        if (reactions->frames != NULL && system->frames[f].held) {
            EndReaction(&kiriSolver_PieceOf(solver, f)->stepping, &reactions->frames[f]);
            AddMomentum(solver, system, f);
        }
    }
}

void kiriSolver_AddReactions(kiriSolver* solver, const kiriSystem* system)
{
    AddPinPulls(solver, system);
    AddClamps(solver, system);
    if (solver->isHeld && system->reactions.frames != NULL) {
        AddContacts(solver, system);
        AddWind(solver, system);
        KIRI_EACH(k, solver->awake.elements) {
            AddHeldElement(solver, system, k);
        }
    }
    EndReactions(solver, system);
}
