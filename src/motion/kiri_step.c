#include "kiri_step.h"
#include "kiri_solver.h"

#include <string.h>

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

static void AddEnergy(kiriStepEnergy* sum, double stored, double lost)
{
    sum->potential += stored;
    sum->objective += stored + lost;
}

/* ---- Pins, clamps and contacts ---- */

static void AddPinEnergy(const kiriSystem* system, const kiriPinRow* pin, const kiriPose* poses, kiriStepEnergy* sum)
{
    kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, pin->frame, pin->at, poses), pin->target);
    AddEnergy(sum, 0.5 * pin->stiffness * kiriVec3_Dot(off, off), 0.0);
}

static void AddClampEnergy(const kiriSystem* system, kiriClampRow* row, const kiriPose* poses, kiriStepEnergy* sum)
{
    double strain[KIRI_CLAMP_STRAINS], pulling[KIRI_CLAMP_STRAINS];
    kiriClamp_Measure(row, &system->frames[row->frame], &row->pose, &poses[row->frame], strain, NULL);
    kiriClamp_TakeOffsets(row, strain, pulling);
    for (int e = 0; e < row->strainCount; ++e) {
        double change = strain[e] - row->startStrain[e];
        AddEnergy(sum, 0.5 * row->stiffness[e] * pulling[e] * pulling[e], 0.5 * row->loss[e] * change * change);
    }
    row->stopping |= kiriClamp_IsStopped(row, strain);
}

void kiriObjective_AddHost(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    for (int32_t k = 0; k < system->clampCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->clamps[k].frame);
        if (piece->isSearching) {
            AddClampEnergy(system, &system->clamps[k], poses, &piece->sum);
        }
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->pins[k].frame);
        if (piece->isSearching) {
            AddPinEnergy(system, &system->pins[k], poses, &piece->sum);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame);
        if (piece->isSearching) {
            AddEnergy(&piece->sum, 0.0, kiriContact_Energy(solver, system, k, poses));
        }
    }
    if (kiriSystem_HasWind(system)) {
        kiriWind_AddEnergy(solver, system, poses);
    }
}

/* ---- Elements and inertia ---- */

void kiriObjective_Measure(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strains)
{
    if (kiriElement_IsRigidCorner(system, k)) {
        kiriTrace trace = kiriElement_Trace(system, k, strains);
        memcpy(&strains[KIRI_MOST_STRAINS * k], trace.strain, sizeof(trace.strain));
    } else {
        kiriElement_Measure(system, k, poses, &strains[KIRI_MOST_STRAINS * k], NULL);
    }
}

void kiriObjective_AddElement(const kiriSolver* solver, const kiriSystem* system, int32_t k, const double* strain,
                              const double* pulling, kiriStepEnergy* sum)
{
    const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
    const double* loss = &solver->loss.data[KIRI_MOST_STRAINS * k];
    const double* start = &solver->startStrain.data[KIRI_MOST_STRAINS * k];
    int count = kiriElement_StrainCount(system, k);
    for (int e = 0; e < count; ++e) {
        double change = strain[e] - start[e];
        AddEnergy(sum, 0.5 * stiffness[e] * pulling[e] * pulling[e], 0.5 * loss[e] * change * change);
    }
}

void kiriObjective_AddInertia(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    KIRI_EACH(i, solver->awake.pieces) {
        memset(&solver->pieces.data[i].sum, 0, sizeof(kiriStepEnergy));
    }
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (piece->isSearching) {
            const kiriPrediction* prediction = &solver->predictions.data[f];
            kiriVec3 off = kiriVec3_Sub(poses[f].x, prediction->pose.x);
            double moved =
                system->frames[f].mass * kiriVec3_Dot(off, off) + kiriPrediction_TurnSquared(prediction, &poses[f].A);
            AddEnergy(&piece->sum, 0.0, 0.5 * moved / (piece->stepping.part * piece->stepping.part));
        }
    }
}

/* Is the element a link of rigid frames that may leave their plane? */
static bool HasStop(const kiriSystem* system, int32_t k)
{
    return kiriElement_IsRigidLink(system, k) && !system->mechanics.planar;
}

void kiriObjective_Evaluate(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    kiriObjective_AddInertia(solver, system, poses);
    /* Held frames start from where the host puts them: other strains than those at the start of the step. */
    bool isKnown = poses == solver->start.data && !solver->isHeld;
    KIRI_EACH(k, solver->awake.elements) {
        kiriPieceStep* piece = kiriSolver_PieceOfElement(solver, system, k);
        double pulling[KIRI_MOST_STRAINS];
        if (!piece->isSearching) {
            continue;
        }
        if (!isKnown) {
            kiriObjective_Measure(system, k, poses, solver->nowStrain.data);
        }
        const double* strain = &(isKnown ? solver->startStrain.data : solver->nowStrain.data)[KIRI_MOST_STRAINS * k];
        kiriElement_TakeOffsets(system, k, strain, pulling);
        kiriObjective_AddElement(solver, system, k, strain, pulling, &piece->sum);
        solver->stopping.data[k] |= !isKnown && HasStop(system, k) && strain[KIRI_NORMAL_STOP] != 0.0;
    }
    kiriObjective_AddHost(solver, system, poses);
}

/* ---- Noise ---- */

static double RigidLinkNoise(const kiriSolver* solver, const kiriLink* link, const double* stiffness)
{
    double reach = kiriVec3_Length(solver->start.data[link->i].x) + link->length;
    return reach * reach * (stiffness[KIRI_STRETCH] + stiffness[KIRI_SHEAR] + stiffness[KIRI_NORMAL_GAP]) +
           stiffness[KIRI_PLANE_BENDING] + stiffness[KIRI_BENDING] + stiffness[KIRI_TWIST];
}

/* Of the sums of strains that traces are. */
static double CornerNoise(const kiriSolver* solver, const kiriSystem* system, const kiriCorner* corner,
                          const double* stiffness)
{
    double weight = 0.0, reach = 0.0;
    for (int32_t k = 0; k < corner->count; ++k) {
        const kiriLink* link = &system->links[corner->link[k]];
        double size = kiriVec2_Length(corner->weight[k]);
        weight += size;
        reach += size * (kiriVec3_Length(solver->start.data[link->i].x) + link->length);
    }
    return stiffness[KIRI_TRACE_STRETCH] * reach * reach + stiffness[KIRI_TRACE_CURVATURE] * weight * weight;
}

/* The columns of A have lengths near 1. */
static double AffineNoise(const kiriSolver* solver, const kiriSystem* system, int32_t k, const double* stiffness)
{
    int32_t count = kiriElement_Members(system, k, solver->members.data);
    double strain[KIRI_MOST_STRAINS], sum = 0.0;
    kiriElement_Measure(system, k, solver->start.data, strain, solver->rows.data);
    for (int e = 0; e < kiriElement_StrainCount(system, k); ++e) {
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

/* The energy of every spring and of the inertia when lengths are off by their last bits: a sheet at rest has no more
   than that. */
void kiriObjective_FindNoise(kiriSolver* solver, const kiriSystem* system)
{
    const double share = KIRI_LAST_BITS * KIRI_LAST_BITS * (1.0 + solver->damping);
    KIRI_EACH(f, solver->awake.frames) {
        kiriVec3 x = solver->start.data[f].x;
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        double part = piece->stepping.part;
        piece->noise += share * system->frames[f].mass * kiriVec3_Dot(x, x) / (part * part);
    }
    KIRI_EACH(k, solver->awake.elements) {
        const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
        const kiriCorner* corner = kiriElement_Corner(system, k);
        double noise = kiriElement_IsRigidCorner(system, k) ? CornerNoise(solver, system, corner, stiffness)
                       : kiriElement_IsRigidLink(system, k)
                           ? RigidLinkNoise(solver, kiriElement_Link(system, k), stiffness)
                           : AffineNoise(solver, system, k, stiffness);
        kiriSolver_PieceOfElement(solver, system, k)->noise += share * noise;
    }
    for (int32_t k = 0; k < system->clampCount; ++k) {
        const kiriClampRow* row = &system->clamps[k];
        kiriSolver_PieceOf(solver, row->frame)->noise += share * kiriClamp_Noise(row, &solver->start.data[row->frame]);
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriVec3 x = solver->contacts.data[k].start;
        kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame)->noise +=
            share * solver->contacts.data[k].stiffness * kiriVec3_Dot(x, x);
    }
}

/* ---- Matrix and forces ------------------------------------------------------------------------------------------- */

/* A frame that is held, or whose piece has done its step, has the identity and no force: it stays where it is. */
static bool IsStill(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    return system->frames[f].held || !kiriSolver_PieceOf(solver, f)->isSearching;
}

static void AddIdentity(kiriSolver* solver, int32_t f)
{
    double block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS] = { 0.0 };
    for (int32_t n = 0; n < solver->size; ++n) {
        block[(solver->size + 1) * n] = 1.0;
    }
    kiriMatrix_AddOwn(solver->matrix, f, block);
}

/* Times h'^2. */
static kiriFrameRow InertiaForce(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriPrediction* prediction = &solver->predictions.data[f];
    const kiriPose* pose = &solver->poses.data[f];
    kiriFrameRow force;
    memset(&force, 0, sizeof(force));
    force.by[0] = kiriVec3_Scale(system->frames[f].mass, kiriVec3_Sub(prediction->pose.x, pose->x));
    if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriMat3 gradient = kiriPrediction_Gradient(prediction, &pose->A);
        force.by[1] = kiriVec3_Scale(-1.0, gradient.u);
        force.by[2] = kiriVec3_Scale(-1.0, gradient.v);
        force.by[3] = kiriVec3_Scale(-1.0, gradient.d);
    } else {
        force.by[1] = kiriVec3_Scale(-1.0, kiriPrediction_TurnGradient(prediction, &pose->A, &prediction->target));
    }
    return force;
}

static void AddFrameInertia(kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriMassMoments* m = &solver->predictions.data[f].moments;
    const double moments[4][4] = { { system->frames[f].mass, 0.0, 0.0, 0.0 },
                                   { 0.0, m->uu, m->uv, 0.0 },
                                   { 0.0, m->uv, m->vv, 0.0 },
                                   { 0.0, 0.0, 0.0, m->dd } };
    kiriMat3 inertia = kiriPrediction_Inertia(&solver->predictions.data[f], &solver->poses.data[f].A);
    double part = kiriSolver_PieceOf(solver, f)->stepping.part;
    double perTime = 1.0 / (part * part), block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS];
    for (int32_t r = 0; r < solver->size; ++r) {
        const kiriUnknown* a = &solver->unknowns[r];
        bool turns = a->vector == 1 && !kiriMechanics_IsAffine(&system->mechanics);
        kiriVec3 spun = turns ? kiriMat3_Mul(inertia, a->axis) : a->axis;
        for (int32_t c = 0; c < solver->size; ++c) {
            const kiriUnknown* b = &solver->unknowns[c];
            block[solver->size * r + c] = turns && b->vector == 1  ? perTime * kiriVec3_Dot(b->axis, spun)
                                          : a->number == b->number ? perTime * moments[a->vector][b->vector]
                                                                   : 0.0;
        }
    }
    kiriMatrix_AddOwn(solver->matrix, f, block);
    double* force = &solver->force.data[solver->size * f];
    kiriFrameRow inertiaForce = InertiaForce(solver, system, f);
    kiriSolver_Reduce(solver, &inertiaForce, force);
    for (int32_t n = 0; n < solver->size; ++n) {
        force[n] *= perTime;
    }
}

void kiriSolver_AddSquares(kiriSolver* solver, const int32_t* frames, int32_t frameCount, const double* J,
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
    int rows = kiriElement_StrainCount(system, k);
    bool hasStop = kiriElement_Link(system, k) != NULL && !system->mechanics.planar;
    return hasStop && strain[rows - 1] == 0.0 ? rows - 1 : rows;
}

/* The rows that corners are made of. */
static double* TracedRows(const kiriSolver* solver, int32_t link, int traced)
{
    return &solver->tracedRows.data[2 * (size_t)solver->size * (KIRI_TRACED * (size_t)link + (size_t)traced)];
}

static void KeepTracedRows(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    size_t row = 2 * (size_t)solver->size;
    for (int s = 0; s < (system->mechanics.planar ? KIRI_TRACED_BENDING : KIRI_TRACED); ++s) {
        memcpy(TracedRows(solver, k, s), &solver->J.data[row * (size_t)kiriTrace_Source(s)], sizeof(double) * row);
    }
}

/* The same as DeriveStrains, from what is kept of the corner's links. */
static void DeriveTraces(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t count, double* strain)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    kiriTrace trace = kiriElement_Trace(system, k, solver->nowStrain.data);
    int traces = kiriElement_StrainCount(system, k), size = solver->size;
    int32_t members[4], ends[4][2];
    kiriTrace_Members(corner, system->links, members, ends);
    memcpy(strain, trace.strain, sizeof(double) * (size_t)traces);
    memset(solver->J.data, 0, sizeof(double) * (size_t)(traces * count * size));
    for (int32_t n = 0; n < count; ++n) {
        for (int t = 0; t < traces; ++t) {
            const double *along = TracedRows(solver, corner->link[n], 2 * t), *across = along + 2 * size;
            for (int end = 0; end < 2; ++end, along += size, across += size) {
                double* J = &solver->J.data[size * (count * t + ends[n][end])];
                for (int u = t == KIRI_TRACE_STRETCH ? 0 : 3; u < size; ++u) { /* directors only turn */
                    J[u] += trace.by[n][2 * t] * along[u] + trace.by[n][2 * t + 1] * across[u];
                }
            }
        }
    }
}

/* The strains of an element at the poses, and J: their derivatives by the unknowns of its frames, zero for held
   ones. */
static void DeriveStrains(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t count, double* strain)
{
    size_t bytes = sizeof(double) * (size_t)solver->size;
    double* J = solver->J.data;
    if (kiriElement_IsRigidCorner(system, k)) {
        DeriveTraces(solver, system, k, count, strain);
        return;
    }
    if (kiriElement_IsRigidLink(system, k) && !system->mechanics.planar) {
        const kiriLink* link = kiriElement_Link(system, k);
        const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
        const kiriPose* const ends[2] = { &solver->poses.data[link->i], &solver->poses.data[link->j] };
        kiriStrain_Measure(link, &system->material, frames, ends, strain, (kiriStrainRow*)J); /* rows are J as it is */
    } else {
        kiriElement_Measure(system, k, solver->poses.data, strain, solver->rows.data);
        for (int32_t n = 0; n < kiriElement_StrainCount(system, k) * count; ++n) {
            kiriSolver_Reduce(solver, &solver->rows.data[n], &J[solver->size * n]);
        }
    }
    for (int32_t m = 0; solver->isHeld && m < count; ++m) {
        for (int e = 0; system->frames[solver->members.data[m]].held && e < kiriElement_StrainCount(system, k); ++e) {
            memset(&J[solver->size * (count * e + m)], 0, bytes);
        }
    }
    if (kiriElement_CornerCount(system) > 0 && kiriElement_IsRigidLink(system, k)) {
        KeepTracedRows(solver, system, k);
    }
}

static void AddElement(kiriSolver* solver, const kiriSystem* system, int32_t k, kiriStepEnergy* energy)
{
    const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
    const double* loss = &solver->loss.data[KIRI_MOST_STRAINS * k];
    const double* start = &solver->startStrain.data[KIRI_MOST_STRAINS * k];
    int32_t count = kiriElement_Members(system, k, solver->members.data);
    double *strain = &solver->nowStrain.data[KIRI_MOST_STRAINS * k], pulling[KIRI_MOST_STRAINS];
    double springs[KIRI_MOST_STRAINS], pulls[KIRI_MOST_STRAINS];
    DeriveStrains(solver, system, k, count, strain);
    kiriElement_TakeOffsets(system, k, strain, pulling);
    kiriObjective_AddElement(solver, system, k, strain, pulling, energy);
    int rows = ActiveRows(system, k, strain);
    for (int e = 0; e < rows; ++e) {
        springs[e] = stiffness[e] + loss[e];
        pulls[e] = -stiffness[e] * pulling[e] - loss[e] * (strain[e] - start[e]);
    }
    /* A stop that does not act yet has no derivative, and the line search halves every step that runs into it. So after
       a step that was cut short, the stops that it ran into resist as springs of no length. */
    bool wasShort = kiriSolver_PieceOfElement(solver, system, k)->scale < KIRI_SHORT_STEP;
    if (wasShort && solver->stopping.data[k] && rows == KIRI_NORMAL_STOP) {
        springs[KIRI_NORMAL_GAP] += stiffness[KIRI_NORMAL_STOP];
    }
    kiriSolver_AddSquares(solver, solver->members.data, count, solver->J.data, springs, pulls, rows);
}

void kiriSolver_AddSpring(kiriSolver* solver, const kiriSystem* system, int32_t f, kiriVec2 at, kiriVec3 axis,
                          double length, double stiffness)
{
    kiriVec2 local = kiriVec2_Sub(at, system->frames[f].center);
    double J[KIRI_MOST_UNKNOWNS], pull = -stiffness * length;
    kiriFrameRow row = { { axis, kiriVec3_Scale(local.x, axis), kiriVec3_Scale(local.y, axis), { 0.0, 0.0, 0.0 } } };
    if (!kiriMechanics_IsAffine(&system->mechanics)) {
        row.by[1] = kiriVec3_Cross(kiriSystem_Arm(system, f, at, &solver->poses.data[f]), axis);
    }
    kiriSolver_Reduce(solver, &row, J);
    kiriSolver_AddSquares(solver, &f, 1, J, &stiffness, &pull, 1);
}

static void AddPin(kiriSolver* solver, const kiriSystem* system, const kiriPinRow* pin)
{
    kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, pin->frame, pin->at, solver->poses.data), pin->target);
    kiriSolver_AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(1.0, 0.0, 0.0), off.x, pin->stiffness);
    kiriSolver_AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(0.0, 1.0, 0.0), off.y, pin->stiffness);
    kiriSolver_AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(0.0, 0.0, 1.0), off.z, pin->stiffness);
}

/* As AddElement, of one frame. */
static void AddClamp(kiriSolver* solver, const kiriSystem* system, const kiriClampRow* row)
{
    kiriFrameRow rows[KIRI_CLAMP_STRAINS];
    double strain[KIRI_CLAMP_STRAINS], pulling[KIRI_CLAMP_STRAINS], J[KIRI_CLAMP_STRAINS * KIRI_MOST_UNKNOWNS];
    double springs[KIRI_CLAMP_STRAINS], pulls[KIRI_CLAMP_STRAINS];
    kiriClamp_Measure(row, &system->frames[row->frame], &row->pose, &solver->poses.data[row->frame], strain, rows);
    kiriClamp_TakeOffsets(row, strain, pulling);
    for (int e = 0; e < row->strainCount; ++e) {
        springs[e] = row->stiffness[e] + row->loss[e];
        pulls[e] = -row->stiffness[e] * pulling[e] - row->loss[e] * (strain[e] - row->startStrain[e]);
        kiriSolver_Reduce(solver, &rows[e], &J[solver->size * e]);
    }
    bool wasShort = kiriSolver_PieceOf(solver, row->frame)->scale < KIRI_SHORT_STEP;
    if (wasShort && row->stopping && !row->isAffine && !kiriClamp_IsStopped(row, strain)) {
        springs[KIRI_NORMAL_GAP] += row->stiffness[KIRI_NORMAL_STOP];
    }
    kiriSolver_AddSquares(solver, &row->frame, 1, J, springs, pulls, row->strainCount);
}

void kiriSolver_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    kiriMatrix_Clear(solver->matrix);
    kiriSolver_LinearizeContacts(solver, system);
    KIRI_EACH(f, solver->awake.frames) {
        memset(&solver->force.data[solver->size * f], 0, sizeof(double) * (size_t)solver->size);
        if (IsStill(solver, system, f)) {
            AddIdentity(solver, f);
        } else {
            AddFrameInertia(solver, system, f);
        }
    }
    kiriObjective_AddInertia(solver, system, solver->poses.data);
    KIRI_EACH(k, solver->awake.elements) {
        kiriPieceStep* piece = kiriSolver_PieceOfElement(solver, system, k);
        if (piece->isSearching) {
            AddElement(solver, system, k, &piece->sum);
        }
    }
    for (int32_t k = 0; k < system->pinCount; ++k) {
        if (!IsStill(solver, system, system->pins[k].frame)) {
            AddPin(solver, system, &system->pins[k]);
        }
    }
    for (int32_t k = 0; k < system->clampCount; ++k) {
        if (!IsStill(solver, system, system->clamps[k].frame)) {
            AddClamp(solver, system, &system->clamps[k]);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (kiriSolver_PieceOf(solver, system->contacts[k].weights[0].frame)->isSearching) {
            kiriContact_Assemble(solver, system, k);
        }
    }
    if (kiriSystem_HasWind(system)) {
        kiriWind_Assemble(solver, system);
    }
    solver->isAlong = true; /* contacts know where they are: nothing has moved since LinearizeContacts */
    kiriObjective_AddHost(solver, system, solver->poses.data);
    solver->isAlong = false;
}

/* Wind as part of the objective. The force on a small area is D (u - v), with u the velocity of the air, v that of the
   material, and D = density / 2 |u - v| area (drag n n^T + lift (1 - n n^T)) as it is at the start of the step. At the
   end of the step v is linear in the point's place x there (kiri_frame.h): v = v* + (x - x*) / h'. So the force is
   that of a spring of stiffness D / h' whose target is x* + h' (u - v*): implicit, and it never turns u - v round. */

/* Four points of a region, each with a quarter of its area, have its area, its centroid and its second moments. */
enum { SAMPLES = 4 };

typedef struct WindSpring {
    kiriVec2 at;
    kiriVec3 normal, target;
    double across, along; /* N/m: along the normal, and in the plane */
} WindSpring;

/* The columns of the root (Cholesky's) of the second moments of a unit area, both ways. */
static kiriVec2 SamplePoint(const kiriFrameData* frame, int k)
{
    double uu = frame->inertia[0] / frame->mass, uv = frame->inertia[1] / frame->mass;
    double vv = frame->inertia[2] / frame->mass, first = kiriRoot(uu);
    double side = first > 0.0 ? uv / first : 0.0, rest = kiriRoot(vv - side * side);
    kiriVec2 root = k < 2 ? kiriVec2_Make(first, side) : kiriVec2_Make(0.0, rest);
    return kiriVec2_Add(frame->center, kiriVec2_Scale(k % 2 == 0 ? sqrt(2.0) : -sqrt(2.0), root));
}

static kiriVec3 PredictedVelocity(const kiriSystem* system, const kiriPrediction* prediction, kiriVec2 from)
{
    if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriVec3 turning = kiriVec3_AddScaled(kiriVec3_Scale(from.x, prediction->rate.u), from.y, prediction->rate.v);
        return kiriVec3_Add(prediction->velocity, turning);
    }
    kiriVec3 arm = kiriPose_Along(&prediction->pose, from);
    return kiriVec3_Add(prediction->velocity, kiriVec3_Cross(prediction->spin, arm));
}

static WindSpring SpringAt(const kiriSolver* solver, const kiriSystem* system, int32_t f, int k)
{
    const kiriFrameData* frame = &solver->before.data[f];
    const kiriPrediction* prediction = &solver->predictions.data[f];
    double part = kiriSolver_PieceOf(solver, f)->stepping.part;
    WindSpring spring;
    spring.at = SamplePoint(frame, k);
    kiriVec3 wide = kiriVec3_Cross(frame->A.u, frame->A.v); /* an affine frame stretches its area */
    kiriVec3 past = kiriVec3_Sub(system->air->velocity, kiriFrame_VelocityAt(frame, spring.at));
    double c = 0.5 * system->air->density * kiriVec3_Length(past) * kiriVec3_Length(wide) * frame->area / SAMPLES;
    kiriVec3 velocity = PredictedVelocity(system, prediction, kiriVec2_Sub(spring.at, frame->center));
    kiriVec3 ahead = kiriVec3_Sub(system->air->velocity, velocity);
    spring.normal = kiriVec3_Normalize(wide);
    kiriVec3 predicted = kiriVec3_Add(prediction->pose.x, kiriSystem_Arm(system, f, spring.at, &prediction->pose));
    spring.target = kiriVec3_AddScaled(predicted, part, ahead);
    spring.across = c * system->air->drag / part;
    spring.along = c * system->air->lift / part;
    return spring;
}

static kiriVec3 ForceOf(const WindSpring* spring, kiriVec3 point)
{
    kiriVec3 off = kiriVec3_Sub(spring->target, point);
    double across = kiriVec3_Dot(off, spring->normal);
    return kiriVec3_AddScaled(kiriVec3_Scale(spring->along, off), (spring->across - spring->along) * across,
                              spring->normal);
}

bool kiriSystem_HasWind(const kiriSystem* system)
{
    return system->air != NULL && system->air->density > 0.0 && (system->air->drag > 0.0 || system->air->lift > 0.0);
}

void kiriWind_AddEnergy(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        for (int k = 0; piece->isSearching && !system->frames[f].held && k < SAMPLES; ++k) {
            WindSpring spring = SpringAt(solver, system, f, k);
            kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, f, spring.at, poses), spring.target);
            double across = kiriVec3_Dot(off, spring.normal);
            piece->sum.objective +=
                0.5 * spring.along * kiriVec3_Dot(off, off) + 0.5 * (spring.across - spring.along) * across * across;
        }
    }
}

void kiriWind_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        bool isStill = system->frames[f].held || !kiriSolver_PieceOf(solver, f)->isSearching;
        for (int k = 0; !isStill && k < SAMPLES; ++k) {
            WindSpring spring = SpringAt(solver, system, f, k);
            kiriVec3 n = spring.normal, x = kiriSystem_Point(system, f, spring.at, solver->poses.data);
            kiriVec3 off = kiriVec3_Sub(x, spring.target);
            kiriVec3 axis = fabs(n.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
            kiriVec3 side = kiriVec3_Normalize(kiriVec3_Cross(n, axis)), ahead = kiriVec3_Cross(side, n);
            kiriSolver_AddSpring(solver, system, f, spring.at, n, kiriVec3_Dot(off, n), spring.across);
            if (spring.along > 0.0) {
                kiriSolver_AddSpring(solver, system, f, spring.at, side, kiriVec3_Dot(off, side), spring.along);
                kiriSolver_AddSpring(solver, system, f, spring.at, ahead, kiriVec3_Dot(off, ahead), spring.along);
            }
        }
    }
}

/* The scheme takes a part of it by the force at the start of the step: the larger of the two counts, for this only
   guards against energy from nowhere. */
double kiriWind_Work(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    const kiriFrameData *start = &solver->before.data[f], *end = &solver->after.data[f];
    double part = kiriSolver_PieceOf(solver, f)->stepping.part, first = 0.0, last = 0.0;
    for (int k = 0; k < SAMPLES; ++k) {
        WindSpring spring = SpringAt(solver, system, f, k);
        kiriVec3 from = kiriFrame_Carry(start, spring.at), to = kiriFrame_Carry(end, spring.at);
        kiriVec3 way = kiriVec3_Sub(to, from);
        kiriVec3 past = kiriVec3_Sub(system->air->velocity, kiriFrame_VelocityAt(start, spring.at));
        WindSpring before = spring;
        before.target = kiriVec3_AddScaled(from, part, past);
        first += kiriVec3_Dot(way, ForceOf(&before, from));
        last += kiriVec3_Dot(way, ForceOf(&spring, to));
    }
    return kiriMax(first, last);
}

kiriWrench kiriWind_OnFrame(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    kiriWrench sum = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
    for (int k = 0; k < SAMPLES; ++k) {
        WindSpring spring = SpringAt(solver, system, f, k);
        kiriVec3 point = kiriSystem_Point(system, f, spring.at, solver->poses.data);
        kiriVec3 force = ForceOf(&spring, point);
        kiriWrench wrench = { force, kiriVec3_Cross(kiriVec3_Sub(point, solver->poses.data[f].x), force) };
        kiriWrench_Add(&sum, 1.0, &wrench);
    }
    return sum;
}

#define LONGEST_ITERATION_TURN 1.0 /* of a frame in one Gauss-Newton step: a Cayley vector */
#define HALVINGS 12                /* of a step that does not lower the objective */
#define SECOND_CHANCES 4           /* more iterations where energy is gained or the last step was cut short, */
#define FRESH_STARTS 2             /* and iterations from the start of the step should they fail */
#define FREE_SYSTEMS 2             /* of a piece that contacts touch: after them it stores no more than it has */
#define WORTHWHILE 1e-6            /* of the objective, where a longer step would lower it by more */
#define MOST_RISE 100.0            /* of the objective in the first step of a piece */
#define MOST_TAKEN 0.5             /* of the kinetic energy, where a piece need not start anew */
#define TOLERABLE_GAIN 1e-2        /* in a step of second order: of the energy that the limit could take, */
#define NEGLIGIBLE_GAIN 1e-9       /* and of all */

/* ---- One Gauss-Newton step ---- */

/* The line search begins with the whole of the Gauss-Newton step, or as much of it as turns no frame too far. */
static void StartSearch(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->now = piece->isSearching ? piece->sum : piece->now;
        piece->enough = piece->now.objective * (1.0 + KIRI_ROUNDING) + piece->noise;
        piece->scale = LONGEST_ITERATION_TURN;
        piece->promise = 0.0;
    }
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        for (int32_t n = solver->size * f; n < solver->size * (f + 1); ++n) {
            piece->promise += 0.5 * solver->force.data[n] * solver->move.data[n];
        }
        if (!kiriMechanics_IsAffine(&system->mechanics)) {
            kiriFrameRow change = kiriSolver_Expand(solver, 1.0, &solver->move.data[solver->size * f]);
            double turn = kiriVec3_Length(change.by[1]);
            piece->scale = kiriMax(turn, piece->scale);
        }
    }
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].scale = LONGEST_ITERATION_TURN / solver->pieces.data[i].scale;
    }
    kiriSolver_LimitByFriction(solver, system);
}

static void TryStep(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        const kiriPose* pose = &solver->poses.data[f];
        if (!piece->isSearching) {
            continue;
        }
        kiriFrameRow change = kiriSolver_Expand(solver, piece->scale, &solver->move.data[solver->size * f]);
        kiriMat3 columns = { change.by[1], change.by[2], change.by[3] };
        solver->trial.data[f].x = kiriVec3_Add(pose->x, change.by[0]);
        solver->trial.data[f].A = kiriMechanics_IsAffine(&system->mechanics)
                                      ? kiriMat3_Advance(&pose->A, &columns)
                                      : kiriMat3_MulMat(kiriMat3_Cayley(change.by[1]), pose->A);
    }
    solver->isAlong = true;
    kiriObjective_Evaluate(solver, system, solver->trial.data);
    solver->isAlong = false;
}

/* Contact that a step runs into has far more energy than the piece, and a line search by that alone would let links
   stretch by as much. The first systems may do so, as they turn frames; later ones only store what the piece has. */
static bool IsAffordable(const kiriPieceStep* piece)
{
    double most = piece->start.potential + piece->means;
    most = kiriMax(most, piece->now.potential);
    return !piece->isNear || piece->solved < FREE_SYSTEMS || piece->sum.potential <= most;
}

static bool IsGood(const kiriPieceStep* piece)
{
    return piece->isSearching && piece->sum.objective <= piece->enough && IsAffordable(piece);
}

/* Pieces whose step is good enough take it. Returns whether there are others. */
static bool TakeTrial(kiriSolver* solver)
{
    bool isLeft = false;
    KIRI_EACH(f, solver->awake.frames) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (IsGood(piece)) {
            solver->poses.data[f] = solver->trial.data[f];
        }
    }
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        if (IsGood(piece)) {
            piece->now = piece->sum;
            piece->isSearching = false;
        }
        isLeft |= piece->isSearching;
    }
    return isLeft;
}

/* Pieces in their first step that still search may end where the objective is that of the free prediction, or some
   times as large as where they start. */
static void AllowPrediction(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(f, solver->awake.frames) {
        solver->trial.data[f] = solver->predictions.data[f].pose;
    }
    kiriObjective_Evaluate(solver, system, solver->trial.data);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        double rise = MOST_RISE * piece->now.objective, predicted = piece->sum.objective;
        double allowed = kiriMax(predicted, rise) * (1.0 + KIRI_ROUNDING) + piece->noise;
        bool isAllowed = piece->isSearching && piece->isFirst;
        piece->enough = isAllowed && allowed > piece->enough ? allowed : piece->enough;
    }
}

/* One Gauss-Newton step, halved until the objective falls; the first one may also raise it to that of the free
   prediction. False when the matrix has no factor. */
static bool IterateOnce(kiriSolver* solver, const kiriSystem* system)
{
    bool isFirst = false;
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isSearching = solver->pieces.data[i].isIterated;
        isFirst |= solver->pieces.data[i].isIterated && solver->pieces.data[i].isFirst;
    }
    kiriSolver_Assemble(solver, system);
    if (!kiriMatrix_Factor(solver->matrix)) {
        return false;
    }
    kiriMatrix_Solve(solver->matrix, solver->force.data, solver->move.data);
    kiriSolver_MoveContacts(solver, system);
    StartSearch(solver, system);
    TryStep(solver, system);
    bool isLeft = TakeTrial(solver);
    if (isLeft && isFirst) {
        AllowPrediction(solver, system);
        TryStep(solver, system);
        isLeft = TakeTrial(solver);
    }
    for (int halving = 0; isLeft && halving < HALVINGS; ++halving) {
        KIRI_EACH(i, solver->awake.pieces) {
            solver->pieces.data[i].scale *= 0.5;
        }
        TryStep(solver, system);
        isLeft = TakeTrial(solver);
    }
    kiriSolver_ReviewContacts(solver, system);
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isFirst &= !solver->pieces.data[i].isIterated;
    }
    return true;
}

/* ---- The iteration as a whole ---- */

/* A step of second order gains a little energy as often as not, which the limit of energy takes out. Where it is more
   than that the iteration goes on, and if that does not help, the piece takes the step anew by backward Euler. Nothing
   else may decide that: where a piece rests, rounding would. */
static bool IsSuspect(const kiriPieceStep* piece)
{
    double brakeable = kiriPieceStep_MostTaken(piece);
    double all = piece->kinetic + piece->moving + piece->start.potential + piece->now.potential;
    return !piece->stepping.isEuler && !(piece->gain <= TOLERABLE_GAIN * brakeable + NEGLIGIBLE_GAIN * all);
}

/* Pieces go on that gained energy, or whose steps were cut short. Returns whether there are any. */
static bool ChooseUnfinished(kiriSolver* solver, int32_t done)
{
    bool any = false;
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        bool isShort = piece->scale < KIRI_SHORT_STEP && piece->promise > WORTHWHILE * piece->now.objective;
        bool hasGained = piece->stepping.isEuler && !(piece->gain <= 0.0);
        bool isSuspect = piece->isIterated && IsSuspect(piece);
        piece->isNew = isSuspect && piece->suspect > 1;
        piece->suspect = isSuspect ? piece->suspect + 1 : 0;
        piece->isIterated =
            piece->isIterated && (done < piece->wanted || hasGained || isSuspect || isShort || piece->isUnsettled);
        any |= piece->isIterated;
    }
    return any;
}

/* The pieces that are new, at these poses. */
static void EvaluateStart(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].isSearching = solver->pieces.data[i].isNew;
    }
    kiriSolver_GuessContacts(solver, system);
    kiriObjective_Evaluate(solver, system, solver->start.data);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->start = piece->isNew ? piece->sum : piece->start;
        piece->isFirst |= piece->isNew;
        piece->solved = piece->isNew ? 0 : piece->solved;
        piece->isIterated |= piece->isNew;
        piece->isNew = false;
    }
}

/* Pieces whose step was no good begin it again. */
static void TakeAnew(kiriSolver* solver, const kiriSystem* system, int32_t wanted)
{
    bool any = false;
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->wanted = piece->isNew ? wanted : piece->wanted;
        any |= piece->isNew;
    }
    if (any) {
        kiriSolver_BecomeEuler(solver, system);
        EvaluateStart(solver, system);
    }
}

/* Of the pieces that are left, those go on from which the energy limit would take too much of their motion: by backward
   Euler, and from where they stood before the step. Returns whether there are any. */
static bool RestartPieces(kiriSolver* solver, const kiriSystem* system)
{
    bool any = false;
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        bool isOver = !(piece->now.objective <= piece->start.objective * (1.0 + KIRI_ROUNDING) + piece->noise);
        double most = (isOver ? MOST_TAKEN : 1.0) * kiriPieceStep_MostTaken(piece);
        piece->isIterated = piece->isNew = piece->isIterated && !(piece->gain <= most);
        any |= piece->isIterated;
    }
    if (any) {
        kiriSolver_BecomeEuler(solver, system);
        EvaluateStart(solver, system);
    }
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->now = piece->isIterated ? piece->start : piece->now;
        piece->solved = piece->isIterated ? FREE_SYSTEMS : piece->solved;
        piece->isFirst = false;
    }
    KIRI_EACH(f, solver->awake.frames) {
        if (kiriSolver_PieceOf(solver, f)->isIterated) {
            solver->poses.data[f] = solver->start.data[f];
        }
    }
    return any;
}

/* The iteration starts from free motion, without forces or with those of the last step: a strip that swings is then
   nearly at the minimum, and one at rest is there. The first Gauss-Newton step may raise the objective: it has to turn
   stiff frames, which stretches links until the next step relaxes them, and a line search would not let it turn them.

   Pieces that have gained energy, or took only a part of their last step, are iterated on. What a piece has gained even
   then is taken out of its velocities. Where that would all but stop it, it starts anew from its pose before the step,
   and its objective only falls from there. Then, with v the velocities before and w those after the step,

   potential after + 1/2 m (w - v)^2  <=  potential before + 1/2 m v^2 + work,

   which bounds w by 2 v. At the minimum it holds with w^2 in place of (w - v)^2, but for parts of the energy that are
   not convex. So velocities stay bounded however long the step. */
int32_t kiriSolver_Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, int32_t most)
{
    int32_t done = 0, last = iterations + SECOND_CHANCES;
    bool isLeft = true, isFresh = false;
    EvaluateStart(solver, system); /* all pieces are new */
    while (isLeft && done < most && done < last) {
        if (!IterateOnce(solver, system)) {
            return -1;
        }
        ++done;
        solver->solved += 1;
        if (done >= iterations) {
            kiriSolver_FindGains(solver, system);
            isLeft = ChooseUnfinished(solver, done);
        }
        if (isLeft && !isFresh && (done == last || done == most)) {
            isLeft = RestartPieces(solver, system);
            kiriSolver_FindGains(solver, system);
            isFresh = true;
            last += FRESH_STARTS;
        } else if (isLeft && done < most && done < last) {
            TakeAnew(solver, system, done + iterations);
        }
    }
    KIRI_ASSERT(done <= iterations + KIRI_EXTRA_SYSTEMS);
    kiriSolver_HoldContacts(solver, system);
    return done;
}

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

/* What was found at the end of the step gives an impulse as inner forces do by the step's scheme (kiri_frame.h):
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

static void EndMove(const kiriPrediction* prediction, const kiriStepping* s, const kiriFrameData* before,
                    kiriFrameData* after)
{
    kiriVec3 off = kiriVec3_Sub(after->x, prediction->pose.x), D = kiriVec3_Scale(1.0 / s->part, off);
    kiriHistory* history = &after->history;
    after->velocity = kiriVec3_Add(prediction->velocity, D);
    kiriVec3 change = kiriVec3_Sub(after->velocity, before->velocity);
    history->dt = s->h;
    history->isHalf = s->isHalf;
    history->isHeld = 0;
    history->gain = kiriVec3_Add(kiriStepping_Inner(s, &before->history), D);
    history->lag = kiriVec3_AddScaled(kiriVec3_Scale(s->d, before->history.lag), s->part - s->h, change);
    history->lag = kiriVec3_Add(history->lag, prediction->shift);
    history->pull = kiriVec3_Scale(1.0 / s->part, D);
}

/* G by which the momentum grows is that about where the free turn ended: it has the impulse of the host's torque. Inner
   forces gave the rest. */
void kiriStepEnd_Rigid(const kiriPrediction* prediction, const kiriStepping* s, const kiriFrameData* before,
                       kiriFrameData* after)
{
    EndMove(prediction, s, before, after);
    kiriMat3 inertia = kiriPrediction_Inertia(prediction, &after->A);
    kiriMat3 was = kiriPrediction_Inertia(prediction, &before->A);
    kiriVec3 whole = kiriPrediction_TurnGradient(prediction, &after->A, &prediction->pose.A);
    kiriVec3 inner = kiriPrediction_TurnGradient(prediction, &after->A, &prediction->target);
    kiriVec3 L = kiriVec3_AddScaled(prediction->angular, 1.0 / s->part, whole);
    kiriVec3 change = kiriVec3_Sub(L, kiriMat3_Mul(was, before->spin));
    kiriVec3 lag = kiriVec3_Scale(s->d, before->history.turnLag.u);
    kiriHistory* history = &after->history;
    history->turnGain = history->turnLag = history->turnPull = (kiriMat3){ 0 };
    after->spin = kiriMat3_Solve(&inertia, L);
    inner = kiriVec3_Scale(1.0 / s->part, inner);
    history->turnGain.u = kiriVec3_Add(kiriStepping_InnerTurn(s, &before->history).u, inner);
    history->turnLag.u = kiriVec3_AddScaled(lag, s->part - s->h, kiriMat3_Solve(&inertia, change));
    history->turnPull.u = kiriVec3_Scale(1.0 / s->part, inner);
}

/* The rate of A differs from that of the prediction as A does, over h'. */
void kiriStepEnd_Affine(const kiriPrediction* prediction, const kiriStepping* s, const kiriFrameData* before,
                        kiriFrameData* after)
{
    EndMove(prediction, s, before, after);
    kiriHistory* history = &after->history;
    kiriMat3 off = kiriMat3_AddScaled(&after->A, -1.0, &prediction->pose.A);
    kiriMat3 inner = kiriMat3_AddScaled(&after->A, -1.0, &prediction->target);
    kiriMat3 rate = kiriMat3_AddScaled(&prediction->rate, 1.0 / s->part, &off);
    kiriMat3 change = kiriMat3_AddScaled(&rate, -1.0, &prediction->carried);
    kiriMat3 lag = kiriMat3_Scale(s->d, &before->history.turnLag);
    kiriMat3 gain = kiriStepping_InnerTurn(s, &before->history);
    after->spin = kiriMat3_Spin(&after->A, &rate);
    after->rate = kiriMat3_Beside(&after->A, &rate, after->spin);
    history->turnGain = kiriMat3_AddScaled(&gain, 1.0 / s->part, &inner);
    history->turnLag = kiriMat3_AddScaled(&lag, s->part - s->h, &change);
    history->turnPull = kiriMat3_Scale(1.0 / (s->part * s->part), &inner);
}

void kiriStepEnd_Held(const kiriPrediction* prediction, const kiriStepping* s, kiriFrameData* after)
{
    after->velocity = prediction->velocity;
    after->spin = prediction->spin;
    after->rate = prediction->rate;
    memset(&after->history, 0, sizeof(after->history));
    after->history.dt = s->h;
    after->history.isHalf = s->isHalf;
    after->history.isHeld = 1;
}
