#include "kiri_solver_work.h"

#define SLIDE_FLOOR 1e-9 /* m: a shorter way is no slide */

static void AddEnergy(kiriStepEnergy* sum, double stored, double lost)
{
    sum->potential += stored;
    sum->objective += stored + lost;
}

/* ---- Pins and contacts ---- */

kiriVec3 kiriSystem_Arm(const kiriSystem* system, int32_t frame, kiriVec2 at, const kiriPose* pose)
{
    return kiriPose_Along(pose, kiriVec2_Sub(at, system->frames[frame].center));
}

kiriVec3 kiriSystem_Point(const kiriSystem* system, int32_t frame, kiriVec2 at, const kiriPose* poses)
{
    KIRI_ASSERT(frame >= 0 && frame < system->frameCount);
    return kiriVec3_Add(poses[frame].x, kiriSystem_Arm(system, frame, at, &poses[frame]));
}

kiriVec3 kiriContact_Slide(const kiriSystem* system, const kiriContactRow* contact, kiriVec3 point)
{
    kiriVec3 way = kiriVec3_Sub(point, kiriFrame_Carry(&system->frames[contact->frame], contact->at));
    return kiriVec3_AddScaled(way, -kiriVec3_Dot(way, contact->normal), contact->normal);
}

double kiriContact_Depth(const kiriContactRow* contact, kiriVec3 point)
{
    double depth = contact->offset - kiriVec3_Dot(contact->normal, point);
    return depth > 0.0 ? depth : 0.0;
}

/* Friction is at most `friction` times the push. Both are those before the iteration, so that the objective is a sum of
   squares during the line search. */
double kiriContact_Friction(const kiriSolver* solver, const kiriSystem* system, const kiriContactRow* contact)
{
    kiriVec3 point = kiriSystem_Point(system, contact->frame, contact->at, solver->poses.data);
    double push = contact->stiffness * kiriContact_Depth(contact, point);
    double slide = kiriVec3_Length(kiriContact_Slide(system, contact, point));
    double friction = contact->friction * push / (slide > SLIDE_FLOOR ? slide : SLIDE_FLOOR);
    return !solver->hasFriction ? 0.0 : friction < contact->stiffness ? friction : contact->stiffness;
}

static void AddPinEnergy(const kiriSystem* system, const kiriPinRow* pin, const kiriPose* poses, kiriStepEnergy* sum)
{
    kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, pin->frame, pin->at, poses), pin->target);
    AddEnergy(sum, 0.5 * pin->stiffness * kiriVec3_Dot(off, off), 0.0);
}

static void AddContactEnergy(const kiriSystem* system, const kiriContactRow* contact, double friction,
                             const kiriPose* poses, kiriStepEnergy* sum)
{
    kiriVec3 point = kiriSystem_Point(system, contact->frame, contact->at, poses);
    kiriVec3 slide = kiriContact_Slide(system, contact, point);
    double depth = kiriContact_Depth(contact, point);
    AddEnergy(sum, 0.5 * contact->stiffness * depth * depth, 0.5 * friction * kiriVec3_Dot(slide, slide));
}

void kiriObjective_AddHost(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    for (int32_t k = 0; k < system->pinCount; ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, system->pins[k].frame);
        if (piece->isSearching) {
            AddPinEnergy(system, &system->pins[k], poses, &piece->sum);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriContactRow* contact = &system->contacts[k];
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, contact->frame);
        if (piece->isSearching) {
            AddContactEnergy(system, contact, kiriContact_Friction(solver, system, contact), poses, &piece->sum);
        }
    }
}

/* ---- Elements and inertia ---- */

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
    for (int32_t i = 0; i < solver->pieceCount; ++i) {
        memset(&solver->pieces.data[i].sum, 0, sizeof(kiriStepEnergy));
    }
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        if (piece->isSearching) {
            const kiriPrediction* prediction = &solver->predictions.data[f];
            kiriVec3 off = kiriVec3_Sub(poses[f].x, prediction->pose.x);
            double moved =
                system->frames[f].mass * kiriVec3_Dot(off, off) + kiriPrediction_TurnSquared(prediction, &poses[f].A);
            AddEnergy(&piece->sum, 0.0, 0.5 * moved / (solver->dt * solver->dt));
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
    for (int32_t k = 0; k < kiriElement_Count(system); ++k) {
        kiriPieceStep* piece = kiriSolver_PieceOfElement(solver, system, k);
        double measured[KIRI_MOST_STRAINS], pulling[KIRI_MOST_STRAINS];
        if (!piece->isSearching) {
            continue;
        }
        if (!isKnown) {
            kiriElement_Measure(system, k, poses, measured, NULL);
        }
        const double* strain = isKnown ? &solver->startStrain.data[KIRI_MOST_STRAINS * k] : measured;
        kiriElement_TakeOffsets(system, k, strain, pulling);
        kiriObjective_AddElement(solver, system, k, strain, pulling, &piece->sum);
        solver->stopping.data[k] |= !isKnown && HasStop(system, k) && measured[KIRI_NORMAL_STOP] != 0.0;
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
    for (int32_t f = 0; f < system->frameCount; ++f) {
        kiriVec3 x = solver->start.data[f].x;
        kiriSolver_PieceOf(solver, f)->noise +=
            share * system->frames[f].mass * kiriVec3_Dot(x, x) / (solver->dt * solver->dt);
    }
    for (int32_t k = 0; k < kiriElement_Count(system); ++k) {
        const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
        kiriSolver_PieceOfElement(solver, system, k)->noise +=
            share * (kiriMechanics_IsAffine(&system->mechanics)
                         ? AffineNoise(solver, system, k, stiffness)
                         : RigidLinkNoise(solver, kiriElement_Link(system, k), stiffness));
    }
}
