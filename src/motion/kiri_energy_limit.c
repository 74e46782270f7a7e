#include "kiri_solver_work.h"

/* ---- The frames after the step ---- */

static void ClearMeans(kiriSolver* solver)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        solver->pieces.data[i].mean = kiriVec3_Make(0.0, 0.0, 0.0);
        solver->pieces.data[i].mass = 0.0;
    }
}

/* No inner force moves the centre of mass of a free piece: it is where the prediction ends, however far the iteration
   came. */
static void CenterFreePieces(kiriSolver* solver, const kiriSystem* system)
{
    ClearMeans(solver);
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        kiriVec3 off = kiriVec3_Sub(solver->predictions.data[f].pose.x, solver->poses.data[f].x);
        piece->mean = kiriVec3_AddScaled(piece->mean, system->frames[f].mass, off);
        piece->mass += system->frames[f].mass;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        kiriVec3* x = &solver->poses.data[f].x;
        double squared = kiriVec3_Dot(piece->mean, piece->mean) / (piece->mass * solver->dt * solver->dt);
        if (piece->isFree && 0.5 * squared > piece->noise) {
            *x = kiriVec3_AddScaled(*x, 1.0 / piece->mass, piece->mean);
        }
    }
}

/* The rate of A differs from that of the free prediction as A does, over the step. */
static void TakeAffineRate(const kiriPrediction* prediction, double perTime, kiriFrameData* frame)
{
    kiriMat3 rate = prediction->rate;
    rate.u = kiriVec3_AddScaled(rate.u, perTime, kiriVec3_Sub(frame->A.u, prediction->pose.A.u));
    rate.v = kiriVec3_AddScaled(rate.v, perTime, kiriVec3_Sub(frame->A.v, prediction->pose.A.v));
    rate.d = kiriVec3_AddScaled(rate.d, perTime, kiriVec3_Sub(frame->A.d, prediction->pose.A.d));
    frame->spin = kiriMat3_Spin(&frame->A, &rate);
    frame->rate = kiriMat3_Beside(&frame->A, &rate, frame->spin);
}

static void WriteStepEnd(kiriSolver* solver, const kiriSystem* system)
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
        } else if (kiriMechanics_IsAffine(&system->mechanics)) {
            TakeAffineRate(prediction, perTime, frame);
        } else {
            kiriMat3 inertia = kiriPrediction_Inertia(prediction, &frame->A);
            kiriVec3 change = kiriPrediction_TurnGradient(prediction, &frame->A, &prediction->pose.A);
            kiriVec3 turn = kiriMat3_Solve(&inertia, change);
            frame->spin = kiriVec3_AddScaled(prediction->spin, perTime, turn);
        }
    }
}

/* ---- Gains ---- */

/* The mean velocity of each piece, by mass. */
static void FindMeanVelocities(kiriSolver* solver, int32_t frameCount)
{
    ClearMeans(solver);
    for (int32_t f = 0; f < frameCount; ++f) {
        const kiriFrameData* frame = &solver->after.data[f];
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (!frame->held) {
            piece->mass += frame->mass;
            piece->mean = kiriVec3_AddScaled(piece->mean, frame->mass, frame->velocity);
        }
    }
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->mean = kiriVec3_Scale(1.0 / (piece->mass > DBL_MIN ? piece->mass : DBL_MIN), piece->mean);
    }
}

/* Of a frame after the step, beside what its piece's mean velocity has. */
static double OwnKinetic(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    kiriFrameData frame = solver->after.data[f];
    frame.velocity = kiriVec3_Sub(frame.velocity, kiriSolver_PieceOf(solver, f)->mean);
    return kiriFrame_KineticEnergy(&frame, &system->material);
}

/* The velocity of the centre of mass of a free piece stays. */
double kiriPieceStep_MostTaken(const kiriPieceStep* piece)
{
    return piece->kinetic + (piece->isFree ? 0.0 : 0.5 * piece->mass * kiriVec3_Dot(piece->mean, piece->mean));
}

/* By how much kinetic and potential energy grow in the step beyond the work of gravity and of the host's forces; what
   rounding explains is no gain. A held frame counts as moved before the step. */
static void SumGains(kiriSolver* solver, const kiriSystem* system)
{
    FindMeanVelocities(solver, system->frameCount);
    kiriVec3 gravity = kiriSystem_Gravity(system);
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->kinetic = 0.0;
        piece->gain = -KIRI_ROUNDING * (piece->start.potential + piece->now.potential) - piece->noise +
                      piece->now.potential - piece->start.potential;
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriFrameData *start = &solver->before.data[f], *end = &solver->after.data[f];
        if (!start->held) {
            kiriVec3 way = kiriVec3_Sub(end->x, start->x);
            double before = kiriFrame_KineticEnergy(start, &system->material);
            double after = kiriFrame_KineticEnergy(end, &system->material);
            double work = start->mass * kiriVec3_Dot(gravity, way) + kiriVec3_Dot(start->force, way) +
                          solver->dt * kiriVec3_Dot(start->torque, end->spin);
            kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
            piece->kinetic += OwnKinetic(solver, system, f);
            piece->gain += after - before - work - KIRI_ROUNDING * (before + after + fabs(work));
        }
    }
}

void kiriSolver_FindGains(kiriSolver* solver, const kiriSystem* system)
{
    CenterFreePieces(solver, system);
    WriteStepEnd(solver, system);
    SumGains(solver, system);
}

/* ---- Limit ---- */

/* The factor that takes an energy out of velocities that have `kinetic`; what they do not have is left in `energy`. */
static double TakeEnergy(double kinetic, double* energy)
{
    double taken = kinetic < *energy ? kinetic : *energy;
    *energy -= taken;
    return taken < kinetic ? sqrt(1.0 - taken / kinetic) : 0.0;
}

static void ScaleVelocities(kiriFrameData* frame, double keep, kiriVec3 mean, double keepMean)
{
    kiriVec3 own = kiriVec3_Sub(frame->velocity, mean);
    frame->velocity = kiriVec3_AddScaled(kiriVec3_Scale(keepMean, mean), keep, own);
    frame->spin = kiriVec3_Scale(keep, frame->spin);
    frame->rate.u = kiriVec3_Scale(keep, frame->rate.u);
    frame->rate.v = kiriVec3_Scale(keep, frame->rate.v);
    frame->rate.d = kiriVec3_Scale(keep, frame->rate.d);
}

/* First out of what velocities have beside their mean, which leaves momentum as it is; the rest out of the mean, unless
   the piece is free. */
void kiriSolver_LimitEnergy(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        double energy = piece->gain > 0.0 ? piece->gain : 0.0;
        piece->keep = TakeEnergy(piece->kinetic, &energy);
        piece->keepMean =
            piece->isFree ? 1.0 : TakeEnergy(0.5 * piece->mass * kiriVec3_Dot(piece->mean, piece->mean), &energy);
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        const kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (piece->gain > 0.0 && !solver->after.data[f].held) {
            ScaleVelocities(&solver->after.data[f], piece->keep, piece->mean, piece->keepMean);
        }
    }
}

void kiriSolver_RestoreMomentum(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        const kiriPieceStep* piece = &solver->pieces.data[i];
        solver->momenta.data[i].isHeld = !piece->isFree || piece->gain > 0.0;
        solver->momenta.data[i].lost = piece->gain < 0.0 ? -piece->gain : 0.0;
    }
    kiriMomentum_Restore(solver->before.data, solver->after.data, system->frameCount, solver->framePiece.data,
                         solver->momenta.data, solver->pieceCount, &system->material, solver->dt);
}
