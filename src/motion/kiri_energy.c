#include "kiri_energy.h"
#include "kiri_solver.h"

/* ---- The frames after the step ---- */

/* Moves a free body to the predicted centre of mass, which no inner force moves, however incomplete the iteration. */
void kiriSolver_CenterBody(kiriSolver* solver, const kiriSystem* system)
{
    kiriVec3 mean = { 0 };
    double mass = 0.0, part = solver->stepping.part;
    if (solver->support != KIRI_SUPPORT_NONE) {
        return;
    }
    KIRI_TIMES(f, system->frameCount) {
        kiriVec3 off = kiriVec3_Sub(solver->predictions.data[f].pose.x, solver->poses.data[f].x);
        mean = kiriVec3_AddScaled(mean, system->frames[f].mass, off);
        mass += system->frames[f].mass;
    }
    if (0.5 * (kiriVec3_Dot(mean, mean) / (mass * part * part)) > solver->search.noise) {
        KIRI_TIMES(f, system->frameCount) {
            kiriVec3* x = &solver->poses.data[f].x;
            *x = kiriVec3_AddScaled(*x, 1.0 / mass, mean);
        }
        solver->touch.isPlaced = false;
    }
}

/* A frame at the end of a step: the velocities that follow from where its pose ended, and the history for the next
   step, by the formulas of kiri_frame.h. `after` has the pose. */

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

/* Ends the step of a rigid frame. The momentum grows by G about the end of the free turn, which includes the impulse of
   the host's torque. The rest, G', is due to inner forces. */
static void EndRigid(const kiriPrediction* prediction, const kiriStepping* s, const kiriFrameData* before,
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

/* Ends the step of an affine frame. The rate of A differs from the predicted rate by (A - A*) / h'. */
static void EndAffine(const kiriPrediction* prediction, const kiriStepping* s, const kiriFrameData* before,
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

static void WriteStepEnd(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_TIMES(f, system->frameCount) {
        const kiriPrediction* prediction = &solver->predictions.data[f];
        const kiriFrameData* before = &solver->before.data[f];
        kiriFrameData* frame = &solver->after.data[f];
        *frame = *before;
        frame->x = solver->poses.data[f].x;
        frame->A = solver->poses.data[f].A;
        if (frame->held) {
            frame->velocity = prediction->velocity;
            frame->spin = prediction->spin;
            frame->rate = prediction->rate;
            KIRI_CLEAR(&frame->history);
            frame->history.dt = solver->stepping.h;
            frame->history.isHalf = solver->stepping.isHalf;
            frame->history.isHeld = 1;
        } else if (kiriMechanics_IsAffine(&system->mechanics)) {
            EndAffine(prediction, &solver->stepping, before, frame);
        } else {
            EndRigid(prediction, &solver->stepping, before, frame);
        }
    }
}

static void RestoreMomentum(kiriSolver* solver, const kiriSystem* system)
{
    const kiriVec3* normal = system->mechanics.planar ? &system->mechanics.axes.d : NULL;
    kiriPieceMomentum momentum = { .isFree = solver->support == KIRI_SUPPORT_NONE,
                                   .isPushed = solver->support == KIRI_SUPPORT_CONTACTS };
    kiriSolver_PlaceContacts(solver, system);
    KIRI_EACH_NEAR(step, solver) {
        kiriVec3 impulse = kiriVec3_Scale(solver->stepping.part, kiriContact_Force(solver, step));
        if (system->mechanics.planar) {
            impulse = kiriMechanics_InPlane(&system->mechanics, impulse);
        }
        kiriWrench given = { impulse, kiriVec3_Cross(step->point, impulse) };
        if (kiriContact_IsMutual(step)) { /* it acts on both sides, whose points are `point` apart */
            given.force = kiriVec3_Make(0.0, 0.0, 0.0);
        }
        kiriWrench_Add(&momentum.pushed, 1.0, &given);
    }
    kiriMomentum_Restore(solver->before.data, solver->after.data, system->frameCount, &momentum, solver->materials.data,
                         kiriSystem_Gravity(system), solver->dt, normal);
    KIRI_ASSERT(!(momentum.mass < 0.0));
    solver->momentum = momentum;
}

/* ---- Gains ---- */

/* If contacts alone act, the velocity of the centre of mass is kept. */
double kiriSolver_MostTaken(const kiriSolver* solver)
{
    return solver->energy.kinetic + (solver->support == KIRI_SUPPORT_HELD ? solver->energy.moving : 0.0);
}

#define OUT_SPEED 0.2 /* m/s: at which obstacles throw out bodies */

/* Finds the increase of kinetic and potential energy in the step beyond the work of gravity and of the host's forces.
   Increases within the rounding error do not count. Held frames count as if they had moved before the step. */
static void SumGains(kiriSolver* solver, const kiriSystem* system)
{
    kiriVec3 gravity = kiriSystem_Gravity(system), mean = solver->momentum.velocityAfter;
    const kiriSearch* search = &solver->search;
    kiriEnergyStep* energy = &solver->energy;
    bool hasWind = kiriSystem_HasWind(system);
    double weight = 0.0; /* J: that the step raised */
    energy->kinetic = 0.0;
    energy->turning = 0.5 * kiriVec3_Dot(solver->momentum.spin, solver->momentum.angular);
    energy->moving = 0.5 * solver->momentum.mass * kiriVec3_Dot(mean, mean);
    energy->gain = -KIRI_ROUNDING * (search->start.potential + search->now.potential) - search->noise +
                   search->now.potential - search->start.potential;
    KIRI_TIMES(f, system->frameCount) {
        const kiriFrameData *start = &solver->before.data[f], *end = &solver->after.data[f];
        if (!start->held) {
            const kiriMaterial* material = kiriSystem_MaterialOf(system, f);
            kiriVec3 way = kiriVec3_Sub(end->x, start->x);
            double before = kiriFrame_KineticEnergy(start, material);
            double after = kiriFrame_KineticEnergy(end, material);
            double fallen = start->mass * kiriVec3_Dot(gravity, way);
            weight -= fallen;
            kiriVec3 lag = end->history.turnLag.u; /* a frame moves by h v+ + p+ in the step, and turns likewise */
            lag = kiriMechanics_IsAffine(&system->mechanics) ? kiriMat3_Spin(&end->A, &end->history.turnLag) : lag;
            double work = fallen + kiriVec3_Dot(start->force, way) +
                          kiriVec3_Dot(start->torque, kiriVec3_AddScaled(lag, solver->dt, end->spin)) +
                          (hasWind ? kiriWind_Work(solver, system, f) : 0.0);
            kiriFrameData beside = *end;
            beside.velocity = kiriVec3_Sub(end->velocity, mean);
            energy->kinetic += kiriFrame_KineticEnergy(&beside, material);
            energy->gain += after - before - work - KIRI_ROUNDING * (before + after + fabs(work));
        }
    }
    double lifting = 0.0; /* J */
    KIRI_EACH_NEAR(step, solver) {
        energy->gain -= kiriContact_Work(solver, step, &lifting);
    }
    double thrown = 0.5 * OUT_SPEED * OUT_SPEED * solver->momentum.mass;
    energy->gain -= kiriClamp(lifting, 0.0, kiriMax(weight, 0.0) + thrown);
}

void kiriSolver_FindGains(kiriSolver* solver, const kiriSystem* system)
{
    kiriSolver_CenterBody(solver, system);
    WriteStepEnd(solver, system);
    RestoreMomentum(solver, system);
    SumGains(solver, system);
}

/* ---- Limit ---- */

/* Returns the factor for velocities of the energy `kinetic` that takes `energy` out of them. Leaves the rest in
   `energy`. */
static double TakeEnergy(double kinetic, double* energy)
{
    double taken = kiriMin(kinetic, *energy);
    *energy -= taken;
    return taken < kinetic ? kiriRoot(1.0 - taken / kinetic) : 0.0;
}

#define MOST_CREDIT 0.02 /* of the kinetic energy */

/* Takes energy first from velocities that differ from a rigid body's, which keeps the momenta; then from the rotation
   as one body; and last from the mean velocity, unless the body is free. Along a swing, steps of second order take and
   give energy by turns. The energy that they lost, and that damping took, is the credit of the body: a limit without credit
   would take each gain, and swings would fade. Contacts give no credit. */
void kiriSolver_LimitEnergy(kiriSolver* solver, const kiriSystem* system)
{
    const kiriEnergyStep* has = &solver->energy;
    const kiriPieceMomentum* momentum = &solver->momentum;
    double credit = 0.0, most = MOST_CREDIT * (has->kinetic + has->moving);
    bool hasCredit = !solver->stepping.isEuler && solver->support != KIRI_SUPPORT_CONTACTS;
    KIRI_TIMES_WHILE(hasCredit, f, system->frameCount) {
        credit += solver->before.data[f].history.credit;
    }
    credit = kiriMax(kiriMin(credit, most), 0.0);
    double energy = kiriMax(has->gain - credit, 0.0), beside = has->kinetic - has->turning;
    double keepRest = TakeEnergy(kiriMax(beside, 0.0), &energy), keepTurning = TakeEnergy(has->turning, &energy);
    bool isTouched = solver->support == KIRI_SUPPORT_CONTACTS;
    double spare = solver->touch.isHeldUp ? 0.0 : KIRI_SPARE_MEANS * solver->touch.means;
    bool isOwn = solver->support == KIRI_SUPPORT_NONE || (isTouched && !(has->gain - has->kinetic > spare));
    double keepMean = isOwn ? 1.0 : TakeEnergy(has->moving, &energy);
    solver->energy.owed = solver->support == KIRI_SUPPORT_HELD ? energy : 0.0;
    double left = hasCredit ? kiriMax(credit - has->gain, 0.0) / momentum->mass : 0.0;
    KIRI_TIMES(f, system->frameCount) {
        kiriFrameData* frame = &solver->after.data[f];
        frame->history.credit = frame->held ? 0.0 : left * frame->mass;
        if (!frame->held && has->gain > credit) {
            kiriVec3 mean = momentum->velocityAfter, arm = kiriVec3_Sub(frame->x, momentum->centerAfter);
            kiriVec3 round = kiriVec3_Cross(momentum->spin, arm);
            kiriVec3 rest = kiriVec3_Sub(kiriVec3_Sub(frame->velocity, mean), round);
            kiriVec3 spin = kiriVec3_Sub(frame->spin, momentum->spin);
            frame->velocity = kiriVec3_AddScaled(kiriVec3_Scale(keepMean, mean), keepTurning, round);
            frame->velocity = kiriVec3_AddScaled(frame->velocity, keepRest, rest);
            frame->spin = kiriVec3_Scale(keepTurning, momentum->spin);
            frame->spin = kiriVec3_AddScaled(frame->spin, keepRest, spin);
            frame->rate = kiriMat3_Scale(keepRest, &frame->rate);
        }
    }
}

/* ---- Estimate of the error --------------------------------------------------------------------------------------- */

/* The fields at a region: a least-squares fit to its links. A link with the span s gives the value of T s for a tensor
   T. */
typedef struct Fit {
    kiriTensor matrix;          /* sum of w s s^T */
    kiriVec2 bendingBy[2];  /* sum of w s (K s)^T: of its two rows */
    kiriVec2 strainBy[2];   /* the same of the strain */
    kiriVec2 turnBy;        /* sum of w s turn */
    double weight;          /* sum of w s . s */
    kiriVec2 at;            /* times where the links are: then where the fields are measured */
    kiriTensor bending, strain; /* 1/m; 1 */
    kiriVec2 turn;          /* slope of the turn in the plane, 1/m */
} Fit;

/* The values of one link. */
typedef struct LinkStrains {
    kiriVec2 bending; /* K s */
    kiriVec2 strain;  /* strain times s, m */
    double turn;      /* in the plane, rad */
    double gap;       /* along the mean director, m */
} LinkStrains;

/* Bending and twist are along and across the edge of the material, see kiri_strain.h. */
static LinkStrains TakeStrains(const kiriLink* link, const double* strain)
{
    LinkStrains strains = { kiriLink_FromEdge(link, kiriVec2_Make(strain[KIRI_BENDING], strain[KIRI_TWIST])),
                            kiriVec2_AddScaled(kiriVec2_Scale(strain[KIRI_STRETCH], link->normal), strain[KIRI_SHEAR],
                                               link->tangent),
                            strain[KIRI_PLANE_BENDING], strain[KIRI_NORMAL_GAP] };
    return strains;
}

static LinkStrains StrainsOfLink(const kiriLink* link, const kiriMaterial* material, const kiriFrameData* frames)
{
    double strain[KIRI_STRAINS];
    kiriStrain_MeasureLink(link, material, &frames[link->i], &frames[link->j], 0.0, strain);
    return TakeStrains(link, strain);
}

static LinkStrains StrainsOfClamp(const kiriClampRow* clamp, const kiriFrameData* frames)
{
    kiriPose pose = kiriPose_Of(&frames[clamp->frame]);
    kiriClampRow row = *clamp;
    double strain[KIRI_CLAMP_STRAINS];
    row.offset[KIRI_PLANE_BENDING] = 0.0;
    kiriClamp_Measure(&row, &frames[clamp->frame], &clamp->pose, &pose, strain, NULL);
    return TakeStrains(&clamp->link, strain);
}

/* ---- Recovery ---- */

static void AddOuter(kiriVec2 rows[2], double w, kiriVec2 s, kiriVec2 value)
{
    rows[0] = kiriVec2_AddScaled(rows[0], w * value.x, s);
    rows[1] = kiriVec2_AddScaled(rows[1], w * value.y, s);
}

static void AddToFit(Fit* fit, const kiriLink* link, const LinkStrains* strains)
{
    kiriVec2 s = link->span;
    double w = link->width / link->length, weight = w * kiriVec2_Dot(s, s);
    fit->matrix.uu += w * s.x * s.x;
    fit->matrix.uv += w * s.x * s.y;
    fit->matrix.vv += w * s.y * s.y;
    AddOuter(fit->bendingBy, w, s, strains->bending);
    AddOuter(fit->strainBy, w, s, strains->strain);
    fit->turnBy = kiriVec2_AddScaled(fit->turnBy, w * strains->turn, s);
    fit->weight += weight;
    fit->at = kiriVec2_AddScaled(fit->at, weight, link->crossing);
}

static void SolveFit(Fit* fit)
{
    kiriTensor m = fit->matrix;
    double least = 0.02 * (m.uu + m.vv);
    m.uu += least;
    m.vv += least;
    double determinant = m.uu * m.vv - m.uv * m.uv;
    fit->bending = kiriTensor_Solve(m, fit->bendingBy);
    fit->strain = kiriTensor_Solve(m, fit->strainBy);
    fit->turn = kiriVec2_Make((m.vv * fit->turnBy.x - m.uv * fit->turnBy.y) / determinant,
                              (m.uu * fit->turnBy.y - m.uv * fit->turnBy.x) / determinant);
    fit->at = kiriVec2_Scale(1.0 / fit->weight, fit->at);
}

/* ---- Energies ---- */

typedef struct Rigidity {
    double bending, strain, turn; /* N m; N/m; N/m: of the energies of curvature, strain, and turn times moment */
} Rigidity;

static double EnergyOf(const kiriLink* link, const LinkStrains* strains, Rigidity rigidity)
{
    double w = link->width / link->length;
    return rigidity.bending * w * kiriVec2_Dot(strains->bending, strains->bending) +
           rigidity.strain * w * kiriVec2_Dot(strains->strain, strains->strain) +
           rigidity.turn * link->moment / link->length * strains->turn * strains->turn;
}

static double SquaredChange(kiriTensor a, kiriTensor b)
{
    double uu = b.uu - a.uu, uv = b.uv - a.uv, vv = b.vv - a.vv;
    return uu * uu + 2.0 * uv * uv + vv * vv;
}

/* Returns the missing energy. A field that changes by c over the length l differs from its mean by c^2 / 12 in the mean
   square. If a region has links on one side only, its fields are those links' values, and the change occurs over a
   shorter distance. */
static double MissingIn(const kiriLink* link, const Fit* a, const Fit* b, Rigidity rigidity)
{
    double l = link->length, apart = kiriVec2_Distance(b->at, a->at);
    double turn = kiriVec2_Dot(kiriVec2_Sub(b->turn, a->turn), link->normal);
    double longer = apart > 0.5 * l ? l / apart : 2.0;
    double energy = rigidity.bending * link->width * SquaredChange(a->bending, b->bending) +
                    rigidity.strain * link->width * SquaredChange(a->strain, b->strain) +
                    rigidity.turn * link->moment * turn * turn;
    return longer * longer * l * energy / 12.0;
}

/* Returns the work of gravity on clamped pieces since they lay flat as their first clamp holds them, J. */
static double WorkOfGravity(kiriVec3 gravity, const kiriFrameData* frames, int32_t frameCount, const int32_t* piece,
                            const kiriClampRow* clamps, int32_t clampCount)
{
    double work = 0.0;
    KIRI_TIMES(f, frameCount) {
        int32_t k = 0;
        while (k < clampCount && piece[clamps[k].frame] != piece[f]) {
            ++k;
        }
        if (k < clampCount) {
            kiriVec3 arm = kiriPose_Along(&clamps[k].pose, kiriVec2_Sub(frames[f].center, clamps[k].foot));
            kiriVec3 way = kiriVec3_Sub(kiriVec3_Sub(frames[f].x, clamps[k].pose.x), arm);
            work += frames[f].mass * kiriVec3_Dot(gravity, way);
        }
    }
    return work;
}

/* Returns the missing part of the energy that a sheet holds, or of the work of gravity if it is larger; half of it where
   strains count. Energies here are twice the energies of the sheet. */
static double RatioOf(const Fit* fits, const kiriFrameData* frames, const kiriLink* links, int32_t linkCount,
                      const kiriClampRow* clamps, int32_t clampCount, const kiriMaterial* material,
                      Rigidity rigidity, double work)
{
    double missing = 0.0, held = 0.0;
    KIRI_TIMES(k, linkCount) {
        LinkStrains strains = StrainsOfLink(&links[k], material, frames);
        double stiffness[KIRI_STRAINS];
        kiriStrain_Stiffness(&links[k], material, stiffness);
        missing += kiriMax(MissingIn(&links[k], &fits[links[k].i], &fits[links[k].j], rigidity),
                           stiffness[KIRI_NORMAL_GAP] * strains.gap * strains.gap); /* a smooth sheet has no gaps */
        held += EnergyOf(&links[k], &strains, rigidity);
    }
    KIRI_TIMES(k, clampCount) {
        LinkStrains strains = StrainsOfClamp(&clamps[k], frames);
        /* The clamp has the strains halfway; so from the region to the line they change by twice the difference. */
        const kiriTensor *K = &fits[clamps[k].frame].bending, *E = &fits[clamps[k].frame].strain;
        kiriVec2 s = clamps[k].link.span;
        LinkStrains off = {
            { strains.bending.x - K->uu * s.x - K->uv * s.y, strains.bending.y - K->uv * s.x - K->vv * s.y },
            { strains.strain.x - E->uu * s.x - E->uv * s.y, strains.strain.y - E->uv * s.x - E->vv * s.y },
            strains.turn - kiriVec2_Dot(fits[clamps[k].frame].turn, s), 0.0
        };
        missing += EnergyOf(&clamps[k].link, &off, rigidity) / 3.0;
        held += EnergyOf(&clamps[k].link, &strains, rigidity);
    }
    held = kiriMax(held, rigidity.strain > 0.0 ? 0.5 * work - missing : work);
    return missing > 0.0 ? missing / (missing + held) : 0.0;
}

bool kiriEstimate_Error(kiriMemory* memory, const kiriFrameData* frames, int32_t frameCount, const kiriLink* links,
                        int32_t linkCount, const kiriClampRow* clamps, int32_t clampCount,
                        const kiriMaterial* material, const int32_t* piece, kiriVec3 gravity, double* relative)
{
    Fit* fits = kiriMemory_AllocZeroed(memory, (int64_t)sizeof(Fit) * frameCount);
    linkCount = kiriLink_CountBorders(links, linkCount);
    if (fits == NULL) {
        return false;
    }
    KIRI_TIMES(k, linkCount) {
        LinkStrains strains = StrainsOfLink(&links[k], material, frames);
        AddToFit(&fits[links[k].i], &links[k], &strains);
        AddToFit(&fits[links[k].j], &links[k], &strains);
    }
    KIRI_TIMES(k, clampCount) {
        LinkStrains strains = StrainsOfClamp(&clamps[k], frames);
        AddToFit(&fits[clamps[k].frame], &clamps[k].link, &strains);
    }
    KIRI_TIMES(i, frameCount) {
        if (fits[i].weight > 0.0) {
            SolveFit(&fits[i]);
        }
    }
    double work = WorkOfGravity(gravity, frames, frameCount, piece, clamps, clampCount);
    double h = material->thickness, nu = material->poissonsRatio;
    double membrane = material->youngsModulus * h, plate = membrane / (1.0 - nu * nu);
    const Rigidity all = { plate * h * h / 12.0, plate, membrane }, bending = { all.bending, 0.0, 0.0 };
    double ratio = RatioOf(fits, frames, links, linkCount, clamps, clampCount, material, all, work);
    if (work > 0.0) { /* most energy of a taut sheet is of strains that its clamps made, not its weight */
        double sag = RatioOf(fits, frames, links, linkCount, clamps, clampCount, material, bending, work);
        ratio = kiriMax(ratio, sag);
    }
    *relative = linkCount > 1 ? ratio : 1.0;
    kiriMemory_Free(memory, fits);
    return true;
}
