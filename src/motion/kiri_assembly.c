#include "kiri_solver_work.h"

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

/* Times dt^2. */
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
        force.by[1] = kiriVec3_Scale(-1.0, kiriPrediction_TurnGradient(prediction, &pose->A));
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
    double perTime = 1.0 / (solver->dt * solver->dt), block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS];
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

/* Adds the squares of `rows` strains: J has their derivatives by the unknowns of the frames, each frame's together. */
static void AddSquares(kiriSolver* solver, const int32_t* frames, int32_t frameCount, const double* J,
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

/* The strains of an element at the poses, and J: their derivatives by the unknowns of its frames, zero for held
   ones. */
static void DeriveStrains(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t count, double* strain)
{
    size_t bytes = sizeof(double) * (size_t)solver->size;
    double* J = solver->J.data;
    if (kiriElement_IsRigidLink(system, k) && !system->mechanics.planar) {
        const kiriLink* link = kiriElement_Link(system, k);
        const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
        const kiriPose* const ends[2] = { &solver->poses.data[link->i], &solver->poses.data[link->j] };
        kiriStrain_Measure(link, frames, ends, strain, (kiriStrainRow*)J); /* rows are J as it is */
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
}

static void AddElement(kiriSolver* solver, const kiriSystem* system, int32_t k, kiriStepEnergy* energy)
{
    const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
    const double* loss = &solver->loss.data[KIRI_MOST_STRAINS * k];
    const double* start = &solver->startStrain.data[KIRI_MOST_STRAINS * k];
    int32_t count = kiriElement_Members(system, k, solver->members.data);
    double strain[KIRI_MOST_STRAINS], pulling[KIRI_MOST_STRAINS];
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
    AddSquares(solver, solver->members.data, count, solver->J.data, springs, pulls, rows);
}

/* A spring on a point of a frame, stretched by `length` along the unit vector `axis`. */
static void AddSpring(kiriSolver* solver, const kiriSystem* system, int32_t f, kiriVec2 at, kiriVec3 axis,
                      double length, double stiffness)
{
    kiriVec2 local = kiriVec2_Sub(at, system->frames[f].center);
    double J[KIRI_MOST_UNKNOWNS], pull = -stiffness * length;
    kiriFrameRow row = { { axis, kiriVec3_Scale(local.x, axis), kiriVec3_Scale(local.y, axis), { 0.0, 0.0, 0.0 } } };
    if (!kiriMechanics_IsAffine(&system->mechanics)) {
        row.by[1] = kiriVec3_Cross(kiriSystem_Arm(system, f, at, &solver->poses.data[f]), axis);
    }
    kiriSolver_Reduce(solver, &row, J);
    AddSquares(solver, &f, 1, J, &stiffness, &pull, 1);
}

static void AddPin(kiriSolver* solver, const kiriSystem* system, const kiriPinRow* pin)
{
    kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, pin->frame, pin->at, solver->poses.data), pin->target);
    AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(1.0, 0.0, 0.0), off.x, pin->stiffness);
    AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(0.0, 1.0, 0.0), off.y, pin->stiffness);
    AddSpring(solver, system, pin->frame, pin->at, kiriVec3_Make(0.0, 0.0, 1.0), off.z, pin->stiffness);
}

static void AddContact(kiriSolver* solver, const kiriSystem* system, const kiriContactRow* contact)
{
    kiriVec3 n = contact->normal, point = kiriSystem_Point(system, contact->frame, contact->at, solver->poses.data);
    double depth = kiriContact_Depth(contact, point), friction = kiriContact_Friction(solver, system, contact);
    if (depth > 0.0) {
        AddSpring(solver, system, contact->frame, contact->at, n, -depth, contact->stiffness);
    }
    if (friction > 0.0) {
        kiriVec3 axis = fabs(n.x) < 0.7 ? kiriVec3_Make(1.0, 0.0, 0.0) : kiriVec3_Make(0.0, 1.0, 0.0);
        kiriVec3 side = kiriVec3_Normalize(kiriVec3_Cross(n, axis)), ahead = kiriVec3_Cross(side, n);
        kiriVec3 slide = kiriContact_Slide(system, contact, point);
        AddSpring(solver, system, contact->frame, contact->at, side, kiriVec3_Dot(slide, side), friction);
        AddSpring(solver, system, contact->frame, contact->at, ahead, kiriVec3_Dot(slide, ahead), friction);
    }
}

void kiriSolver_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    kiriMatrix_Clear(solver->matrix);
    memset(solver->force.data, 0, sizeof(double) * (size_t)(solver->size * system->frameCount));
    for (int32_t f = 0; f < system->frameCount; ++f) {
        if (IsStill(solver, system, f)) {
            AddIdentity(solver, f);
        } else {
            AddFrameInertia(solver, system, f);
        }
    }
    kiriObjective_AddInertia(solver, system, solver->poses.data);
    for (int32_t k = 0; k < kiriElement_Count(system); ++k) {
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
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (!IsStill(solver, system, system->contacts[k].frame)) {
            AddContact(solver, system, &system->contacts[k]);
        }
    }
    kiriObjective_AddHost(solver, system, solver->poses.data);
}
