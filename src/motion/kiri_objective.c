#include "kiri_solver_work.h"

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
