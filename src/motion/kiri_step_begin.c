#include "kiri_solver_work.h"

#define LONGEST_TURN 1.0 /* of a frame in a step of second order */

/* ---- Planar sheets ---- */

kiriVec3 kiriMechanics_InPlane(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, mechanics->axes.d), mechanics->axes.d);
}

static kiriVec3 AlongNormal(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_Scale(kiriVec3_Dot(a, mechanics->axes.d), mechanics->axes.d);
}

static kiriMat3 ColumnsInPlane(const kiriMechanics* mechanics, const kiriMat3* A)
{
    kiriMat3 flat = { kiriMechanics_InPlane(mechanics, A->u),
                      kiriMechanics_InPlane(mechanics, A->v),
                      { 0.0, 0.0, 0.0 } };
    return flat;
}

static void FlattenTurn(const kiriMechanics* mechanics, kiriMat3* turn)
{
    if (kiriMechanics_IsAffine(mechanics)) {
        *turn = ColumnsInPlane(mechanics, turn);
    } else {
        turn->u = AlongNormal(mechanics, turn->u);
    }
}

static void FlattenHistory(const kiriMechanics* mechanics, kiriHistory* history)
{
    history->gain = kiriMechanics_InPlane(mechanics, history->gain);
    history->lag = kiriMechanics_InPlane(mechanics, history->lag);
    history->pull = kiriMechanics_InPlane(mechanics, history->pull);
    FlattenTurn(mechanics, &history->turnGain);
    FlattenTurn(mechanics, &history->turnLag);
    FlattenTurn(mechanics, &history->turnPull);
}

/* In a planar sheet, a frame with only what moves it in the plane. */
static kiriFrameData FlattenFrame(const kiriMechanics* mechanics, const kiriFrameData* from)
{
    kiriFrameData frame = *from;
    if (mechanics->planar) {
        kiriVec3 off = kiriVec3_Sub(frame.heldPosition, frame.x);
        frame.velocity = kiriMechanics_InPlane(mechanics, frame.velocity);
        frame.spin = AlongNormal(mechanics, frame.spin);
        frame.rate = ColumnsInPlane(mechanics, &frame.rate);
        frame.force = kiriMechanics_InPlane(mechanics, frame.force);
        frame.torque = AlongNormal(mechanics, frame.torque);
        frame.heldPosition = kiriVec3_Sub(frame.heldPosition, AlongNormal(mechanics, off));
        FlattenHistory(mechanics, &frame.history);
    }
    return frame;
}

/* The air acts first, so that it only takes energy, whatever gravity does to the velocity. Of second order, exp(-z) is
   1 / (1 + z + z^2 / 2) to the third power of z. */
static void FadeVelocities(const kiriSystem* system, double dt, kiriFrameData* frame)
{
    double z = dt * (double)system->material.airDamping;
    bool isEuler = system->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER;
    double fade = 1.0 / (1.0 + z + (isEuler ? 0.0 : 0.5 * z * z));
    frame->velocity = kiriVec3_Scale(fade, frame->velocity);
    frame->spin = kiriVec3_Scale(fade, frame->spin);
    frame->rate = kiriMat3_Scale(fade, &frame->rate);
}

kiriVec3 kiriSystem_Gravity(const kiriSystem* system)
{
    return system->mechanics.planar ? kiriMechanics_InPlane(&system->mechanics, system->gravity) : system->gravity;
}

/* ---- Predictions ---- */

static kiriPrediction PredictFrame(const kiriSystem* system, const kiriFrameData* frame, const kiriStepping* stepping)
{
    if (frame->held) {
        return kiriPrediction_Held(frame, &system->material, stepping->h);
    }
    kiriVec3 gravity = kiriSystem_Gravity(system);
    return kiriMechanics_IsAffine(&system->mechanics)
               ? kiriPrediction_Affine(frame, &system->material, gravity, stepping)
               : kiriPrediction_Free(frame, &system->material, gravity, stepping);
}

/* No inner force moves the centre of mass of a free piece: it falls on its parabola also where the piece takes a step
   of backward Euler between those of second order. */
static bool IsShifted(const kiriSystem* system, const kiriPieceStep* piece)
{
    return piece->isNew && piece->isFree && piece->stepping.isEuler &&
           system->mechanics.timeStepping != KIRI_TIME_STEPPING_EULER;
}

static void ShiftFreePieces(kiriSolver* solver, const kiriSystem* system)
{
    kiriSolver_ClearMeans(solver);
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        double mass = system->frames[f].mass;
        kiriVec3 change = kiriVec3_Sub(solver->predictions.data[f].velocity, solver->before.data[f].velocity);
        piece->mean = kiriVec3_AddScaled(piece->mean, mass, change);
        piece->mass += mass;
    }
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        kiriPrediction* prediction = &solver->predictions.data[f];
        if (IsShifted(system, piece)) {
            prediction->shift = kiriVec3_Scale(-0.5 * piece->stepping.h / piece->mass, piece->mean);
            prediction->pose.x = kiriVec3_Add(prediction->pose.x, prediction->shift);
        }
    }
}

/* Of the pieces that begin. */
static void Predict(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (piece->isNew) {
            solver->predictions.data[f] = PredictFrame(system, &solver->before.data[f], &piece->stepping);
            solver->poses.data[f] = solver->predictions.data[f].guess;
        }
    }
    ShiftFreePieces(solver, system);
}

/* ---- Schemes ----

   A piece takes a step of second order where all of its frames have the history of one step. History is taken by the
   piece and never by the frame: else action and reaction would differ. */

/* Did the last step of this frame say nothing of the next one? It was held, or is; or it turns so far in a step that
   directions have no past. */
static bool IsBroken(const kiriFrameData* frame, double dt)
{
    return !(frame->history.dt > 0.0) || frame->history.isHeld != frame->held ||
           !(dt * kiriVec3_Length(frame->spin) <= LONGEST_TURN);
}

static void ChooseSteppings(kiriSolver* solver, const kiriSystem* system)
{
    bool isEuler = system->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER;
    KIRI_EACH(f, solver->awake.frames) {
        const kiriFrameData* frame = &system->frames[f];
        kiriStepping* chosen = &kiriSolver_PieceOf(solver, f)->stepping;
        kiriStepping own = isEuler || IsBroken(frame, solver->dt) ? kiriStepping_Euler(solver->dt)
                                                                  : kiriStepping_After(&frame->history, solver->dt);
        bool isFirst = chosen->h == 0.0, isSame = chosen->part == own.part && chosen->ahead == own.ahead;
        *chosen = isFirst ? own : isSame ? *chosen : kiriStepping_Euler(solver->dt);
    }
}

void kiriSolver_FindTouched(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
        piece->isTouched = piece->isTouched || kiriContact_Depth(solver, system, k, poses) > 0.0;
    }
}

/* What pushed in the last step goes on as a rule. */
static void FindPushed(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriContactRow* row = &system->contacts[k];
        kiriSolver_PieceOf(solver, row->weights[0].frame)->isTouched |= kiriVec3_Dot(row->force, row->normal) > 0.0;
    }
}

void kiriSolver_BecomeEuler(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        if (piece->isNew) {
            piece->stepping = kiriStepping_Euler(solver->dt);
            piece->scale = 1.0;
        }
    }
    Predict(solver, system);
    kiriSolver_CenterFreePieces(solver, system);
}

static bool IsSamePose(const kiriPose* a, const kiriPose* b)
{
    return kiriVec3_Equal(a->x, b->x) && kiriVec3_Equal(a->A.u, b->A.u) && kiriVec3_Equal(a->A.v, b->A.v) &&
           kiriVec3_Equal(a->A.d, b->A.d);
}

/* The host moves a held frame, or a clamp, to its place at once. */
static void FindCarried(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPose *from = &solver->start.data[f], *to = &solver->predictions.data[f].pose;
        if (system->frames[f].held && !IsSamePose(from, to)) {
            kiriSolver_PieceOf(solver, f)->isTouched = true;
        }
    }
    for (int32_t k = 0; k < system->clampCount; ++k) {
        const kiriClampRow* row = &system->clamps[k];
        if (!IsSamePose(&row->start, &row->pose)) {
            kiriSolver_PieceOf(solver, row->frame)->isTouched = true;
        }
    }
}

/* A contact, or a held frame that is carried about, pushes within a step, and then no more. */
static void StepTouchedByEuler(kiriSolver* solver, const kiriSystem* system)
{
    FindCarried(solver, system);
    FindPushed(solver, system);
    kiriSolver_FindTouched(solver, system, solver->start.data);
    kiriSolver_FindTouched(solver, system, solver->poses.data);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->isNew = piece->isTouched && !piece->stepping.isEuler;
    }
    kiriSolver_BecomeEuler(solver, system);
}

/* ---- Begin ---- */

/* A corner is damped as the link that is damped least. */
static double DampingShare(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriCorner* corner = kiriElement_IsRigidCorner(system, k) ? kiriElement_Corner(system, k) : NULL;
    double least = 1.0;
    if (kiriElement_IsRigidLink(system, k)) {
        least = kiriStrain_Damping(&solver->startStrain.data[KIRI_MOST_STRAINS * k]);
    }
    for (int32_t n = 0; corner != NULL && n < corner->count; ++n) {
        double share = kiriStrain_Damping(&solver->startStrain.data[KIRI_MOST_STRAINS * corner->link[n]]);
        least = kiriMin(share, least);
    }
    return least;
}

static void BeginElement(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
    kiriElement_Stiffness(system, k, stiffness);
    kiriObjective_Measure(system, k, solver->start.data, solver->startStrain.data);
    solver->stopping.data[k] = 0;
    double damping = solver->damping * DampingShare(solver, system, k);
    for (int e = 0; e < kiriElement_StrainCount(system, k); ++e) {
        solver->loss.data[KIRI_MOST_STRAINS * k + e] = damping * stiffness[e];
    }
}

static void BeginClamp(const kiriSolver* solver, const kiriSystem* system, kiriClampRow* row)
{
    KIRI_ASSERT(row->isAffine == kiriMechanics_IsAffine(&system->mechanics));
    kiriClamp_Begin(row, system->mechanics.planar, &system->material, solver->damping, &system->frames[row->frame],
                    &solver->start.data[row->frame]);
}

/* Finds which pieces are free, and clears the rest. */
static void BeginPieces(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        memset(&solver->pieces.data[i], 0, sizeof(kiriPieceStep));
        solver->pieces.data[i].isFree = !kiriSystem_HasWind(system);
        solver->pieces.data[i].scale = 1.0;
    }
    KIRI_EACH(f, solver->awake.frames) {
        kiriSolver_PieceOf(solver, f)->isFree &= !system->frames[f].held;
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        kiriSolver_PieceOf(solver, system->pins[k].frame)->isFree = false;
    }
    for (int32_t k = 0; k < system->clampCount; ++k) {
        kiriSolver_PieceOf(solver, system->clamps[k].frame)->isFree = false;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
        piece->isPushed |= piece->isFree;
        piece->isFree = false;
    }
}

static kiriVec3* CarriedOn(const kiriStepping* stepping, kiriHistory* history)
{
    return stepping->l > 0.0 ? &history->pull : &history->gain;
}

/* Inner forces do not move a free piece as a whole. A commit that changed masses may have left a mean. */
static void CenterHistories(kiriSolver* solver)
{
    kiriSolver_ClearMeans(solver);
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        kiriFrameData* frame = &solver->before.data[f];
        const kiriVec3* carried = CarriedOn(&piece->stepping, &frame->history);
        piece->mean = kiriVec3_AddScaled(piece->mean, frame->mass, *carried);
        piece->mass += frame->mass;
    }
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        kiriVec3* carried = CarriedOn(&piece->stepping, &solver->before.data[f].history);
        if (piece->isFree && !piece->stepping.isEuler) {
            *carried = kiriVec3_AddScaled(*carried, -1.0 / piece->mass, piece->mean);
        }
    }
}

static void SetNew(kiriSolver* solver)
{
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isNew = true;
    }
}

void kiriSolver_Begin(kiriSolver* solver, const kiriSystem* system, double dt)
{
    KIRI_ASSERT(dt > 0.0 && system->frameCount == solver->frameCount);
    KIRI_ASSERT(kiriElement_Count(system) == solver->elementCount);
    kiriSolver_ListAwake(solver, system);
    solver->dt = dt;
    solver->damping = (double)system->material.flexDamping / dt;
    solver->isAlong = solver->isHeld = false;
    BeginPieces(solver, system);
    KIRI_EACH(f, solver->awake.frames) {
        solver->isHeld |= system->frames[f].held != 0;
        solver->start.data[f] = kiriPose_Of(&system->frames[f]);
        solver->before.data[f] = FlattenFrame(&system->mechanics, &system->frames[f]);
        FadeVelocities(system, dt, &solver->before.data[f]);
    }
    kiriSolver_BeginContacts(solver, system);
    SetNew(solver);
    ChooseSteppings(solver, system);
    CenterHistories(solver);
    Predict(solver, system);
    StepTouchedByEuler(solver, system);
    KIRI_EACH(k, solver->awake.elements) {
        BeginElement(solver, system, k);
    }
    for (int32_t k = 0; k < system->clampCount; ++k) {
        BeginClamp(solver, system, &system->clamps[k]);
    }
    KIRI_EACH(f, solver->awake.frames) {
        if (system->frames[f].held) {
            solver->start.data[f] = solver->predictions.data[f].pose;
        }
    }
    SetNew(solver);
    kiriObjective_FindNoise(solver, system);
    kiriSolver_CenterFreePieces(solver, system);
}
