#include "kiri_solver.h"

#define LONGEST_TURN 1.0 /* of a frame in a step of second order */
#define TOUCHING_TURN 2.0 /* of one that may touch something: friction takes more than half a turn for a turn back, and drives it */

/* ---- Planar sheets ---- */

kiriVec3 kiriMechanics_InPlane(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_Across(a, mechanics->axes.d);
}

static kiriVec3 AlongNormal(const kiriMechanics* mechanics, kiriVec3 a)
{
    return kiriVec3_Scale(kiriVec3_Dot(a, mechanics->axes.d), mechanics->axes.d);
}

static kiriMat3 ColumnsInPlane(const kiriMechanics* mechanics, const kiriMat3* A)
{
    kiriMat3 flat = { .u = kiriMechanics_InPlane(mechanics, A->u), .v = kiriMechanics_InPlane(mechanics, A->v) };
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

/* Returns the frame; in a planar sheet, only with its motion in the plane. */
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
        kiriHistory* history = &frame.history;
        history->gain = kiriMechanics_InPlane(mechanics, history->gain);
        history->lag = kiriMechanics_InPlane(mechanics, history->lag);
        history->pull = kiriMechanics_InPlane(mechanics, history->pull);
        FlattenTurn(mechanics, &history->turnGain);
        FlattenTurn(mechanics, &history->turnLag);
        FlattenTurn(mechanics, &history->turnPull);
    }
    return frame;
}

kiriVec3 kiriSystem_Gravity(const kiriSystem* system)
{
    return system->mechanics.planar ? kiriMechanics_InPlane(&system->mechanics, system->gravity) : system->gravity;
}

/* ---- Predictions ---- */

/* Corrects the prediction of a free body. No inner force moves its centre of mass: it follows its parabola even if the
   body takes a single step of backward Euler between steps of second order. */
static void ShiftFreeBody(kiriSolver* solver, const kiriSystem* system)
{
    kiriVec3 mean = { 0 };
    double mass = 0.0;
    if (solver->support != KIRI_SUPPORT_NONE || !solver->stepping.isEuler ||
        system->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER) {
        return;
    }
    KIRI_TIMES(f, system->frameCount) {
        kiriVec3 change = kiriVec3_Sub(solver->predictions.data[f].velocity, solver->before.data[f].velocity);
        mean = kiriVec3_AddScaled(mean, system->frames[f].mass, change);
        mass += system->frames[f].mass;
    }
    KIRI_ASSERT(mass > 0.0);
    KIRI_TIMES(f, system->frameCount) {
        kiriPrediction* prediction = &solver->predictions.data[f];
        prediction->shift = kiriVec3_Scale(-0.5 * solver->stepping.h / mass, mean);
        prediction->pose.x = kiriVec3_Add(prediction->pose.x, prediction->shift);
    }
}

static void Predict(kiriSolver* solver, const kiriSystem* system)
{
    kiriVec3 gravity = kiriSystem_Gravity(system);
    bool isAffine = kiriMechanics_IsAffine(&system->mechanics);
    KIRI_TIMES(f, system->frameCount) {
        const kiriFrameData* frame = &solver->before.data[f];
        const kiriMaterial* material = kiriSystem_MaterialOf(system, f);
        solver->predictions.data[f] =
            frame->held ? kiriPrediction_Held(frame, material, solver->stepping.h)
                        : kiriPrediction_Free(frame, material, gravity, &solver->stepping, isAffine);
        solver->poses.data[f] = solver->predictions.data[f].guess;
    }
    solver->touch.isPlaced = false;
    ShiftFreeBody(solver, system);
}

/* ---- Schemes ----

   A body takes a step of second order where all of its frames have the history of one step. The body takes history as
   a whole, not frame by frame: else action and reaction would differ. */

static kiriStepping ChooseStepping(const kiriSolver* solver, const kiriSystem* system)
{
    kiriStepping chosen = kiriStepping_Euler(solver->dt);
    KIRI_TIMES(f, system->frameCount) {
        const kiriFrameData* frame = solver->sources.data[f];
        /* The last step says nothing of the next one: the frame was held, or is; or it turns so far in a step that
           directions have no past. */
        bool isBroken = !(frame->history.dt > 0.0) || frame->history.isHeld != frame->held ||
                        !(solver->dt * kiriVec3_Length(frame->spin) <= LONGEST_TURN);
        if (system->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER || isBroken) {
            return kiriStepping_Euler(solver->dt);
        }
        kiriStepping own = kiriStepping_After(&frame->history, solver->dt);
        if (f > 0 && (chosen.part != own.part || chosen.ahead != own.ahead)) {
            return kiriStepping_Euler(solver->dt);
        }
        chosen = f > 0 ? chosen : own;
    }
    return chosen;
}

/* Predicts a step of backward Euler. */
static void BecomeEuler(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_ASSERT(solver->dt > 0.0);
    solver->stepping = kiriStepping_Euler(solver->dt);
    solver->search.scale = 1.0;
    Predict(solver, system);
}

bool kiriSolver_AreTouching(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    kiriSolver_FindNear(solver, system, poses);
    KIRI_EACH_NEAR(contact, solver) {
        if (kiriContact_Depth(system, contact, poses) > 0.0) {
            return true;
        }
    }
    return false;
}

/* Returns true if a contact pushed in the last step: as a rule it goes on. */
static bool IsPushed(const kiriSolver* solver)
{
    KIRI_EACH_NEAR(contact, solver) {
        const kiriContactRow* row = contact->row;
        if (kiriVec3_Dot(row->force, row->normal) > 0.0) {
            return true;
        }
    }
    return false;
}

/* ---- Wind -------------------------------------------------------------------------------------------------------- */

/* Wind as part of the objective. The force on a small area is D (u - v): u is the velocity of the air, v the velocity
   of the material, and D = density / 2 |u - v| area (drag n n^T + lift (1 - n n^T)), constant from the start of the
   step. At the end of the step v is linear in the point's position x (kiri_frame.h): v = v* + (x - x*) / h'. So the
   force acts like a spring of stiffness D / h' with the target x* + h' (u - v*). It is implicit
   and never reverses u - v. */

/* Four points of a region, each with a quarter of its area, have its area, its centroid and its second moments. */
enum { SAMPLES = 4 };

/* A spring of the wind or of a pin on a point of a frame. */
typedef struct Spring {
    int32_t frame;
    kiriVec2 at;
    kiriVec3 normal, target;
    double across, along; /* N/m: along the normal, and in the plane */
} Spring;

static Spring SpringOfPin(const kiriPinRow* pin)
{
    return (Spring){ pin->frame, pin->at, { 0.0, 0.0, 1.0 }, pin->target, pin->stiffness, pin->stiffness };
}

static Spring SpringOfWind(const kiriSolver* solver, const kiriSystem* system, int32_t f, int k)
{
    const kiriFrameData* frame = &solver->before.data[f];
    const kiriPrediction* prediction = &solver->predictions.data[f];
    const kiriAir* air = kiriSystem_AirOf(system, f);
    double part = solver->stepping.part;
    Spring spring = { .frame = f };
    /* The columns of the root (Cholesky's) of the second moments of a unit area, both ways. */
    double uu = frame->inertia[0] / frame->mass, uv = frame->inertia[1] / frame->mass;
    double vv = frame->inertia[2] / frame->mass, first = kiriRoot(uu);
    double cross = first > 0.0 ? uv / first : 0.0, rest = kiriRoot(vv - cross * cross);
    kiriVec2 root = k < 2 ? kiriVec2_Make(first, cross) : kiriVec2_Make(0.0, rest);
    spring.at = kiriVec2_AddScaled(frame->center, k % 2 == 0 ? sqrt(2.0) : -sqrt(2.0), root);
    kiriVec3 wide = kiriVec3_Cross(frame->A.u, frame->A.v); /* an affine frame stretches its area */
    kiriVec3 past = kiriVec3_Sub(air->velocity, kiriFrame_VelocityAt(frame, spring.at));
    double c = 0.5 * air->density * kiriVec3_Length(past) * kiriVec3_Length(wide) * frame->area / SAMPLES;
    kiriVec2 from = kiriVec2_Sub(spring.at, frame->center);
    kiriVec3 turning = kiriVec3_AddScaled(kiriVec3_Scale(from.x, prediction->rate.u), from.y, prediction->rate.v);
    if (!kiriMechanics_IsAffine(&system->mechanics)) {
        turning = kiriVec3_Cross(prediction->spin, kiriPose_Along(&prediction->pose, from));
    }
    kiriVec3 velocity = kiriVec3_Add(prediction->velocity, turning);
    kiriVec3 ahead = kiriVec3_Sub(air->velocity, velocity);
    spring.normal = kiriVec3_Normalize(wide);
    kiriVec3 predicted = kiriVec3_Add(prediction->pose.x, kiriSystem_Arm(system, f, spring.at, &prediction->pose));
    spring.target = kiriVec3_AddScaled(predicted, part, ahead);
    spring.across = c * air->drag / part;
    spring.along = c * air->lift / part;
    return spring;
}

static kiriVec3 ForceOf(const Spring* spring, kiriVec3 point)
{
    kiriVec3 off = kiriVec3_Sub(spring->target, point);
    double across = kiriVec3_Dot(off, spring->normal);
    return kiriVec3_AddScaled(kiriVec3_Scale(spring->along, off), (spring->across - spring->along) * across,
                              spring->normal);
}

bool kiriSystem_HasWind(const kiriSystem* system)
{
    bool has = kiriAir_Blows(system->air);
    KIRI_TIMES_WHILE(system->airs != NULL && !has, f, system->frameCount) {
        has = kiriAir_Blows(system->airs[f]);
    }
    return has;
}

static double SpringEnergy(const kiriSystem* system, const Spring* spring, const kiriPose* poses)
{
    kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, spring->frame, spring->at, poses), spring->target);
    double across = kiriVec3_Dot(off, spring->normal);
    return 0.5 * spring->along * kiriVec3_Dot(off, off) + 0.5 * (spring->across - spring->along) * across * across;
}

/* Uses the larger of the work by the force at the start and at the end of the step, because it only guards against
   false gains of energy. */
double kiriWind_Work(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < system->frameCount);
    const kiriFrameData *start = &solver->before.data[f], *end = &solver->after.data[f];
    double part = solver->stepping.part, first = 0.0, last = 0.0;
    KIRI_TIMES(k, SAMPLES) {
        Spring spring = SpringOfWind(solver, system, f, k);
        kiriVec3 from = kiriFrame_Carry(start, spring.at), to = kiriFrame_Carry(end, spring.at);
        kiriVec3 way = kiriVec3_Sub(to, from);
        kiriVec3 past = kiriVec3_Sub(kiriSystem_AirOf(system, f)->velocity, kiriFrame_VelocityAt(start, spring.at));
        Spring before = spring;
        before.target = kiriVec3_AddScaled(from, part, past);
        first += kiriVec3_Dot(way, ForceOf(&before, from));
        last += kiriVec3_Dot(way, ForceOf(&spring, to));
    }
    return kiriMax(first, last);
}

static kiriWrench WindOnFrame(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    kiriWrench sum = { 0 };
    KIRI_TIMES(k, SAMPLES) {
        Spring spring = SpringOfWind(solver, system, f, k);
        kiriVec3 point = kiriSystem_Point(system, f, spring.at, solver->poses.data);
        kiriVec3 force = ForceOf(&spring, point);
        kiriWrench wrench = { force, kiriVec3_Cross(kiriVec3_Sub(point, solver->poses.data[f].x), force) };
        kiriWrench_Add(&sum, 1.0, &wrench);
    }
    return sum;
}

/* ---- Objective ---------------------------------------------------------------------------------------------------- */

static void AddEnergy(kiriStepEnergy* sum, double stored, double lost)
{
    sum->potential += stored;
    sum->objective += stored + lost;
}

static void AddFlow(kiriStepEnergy* sum, double flow)
{
    AddEnergy(sum, flow, 0.0);
    sum->flow += flow;
}

/* ---- Pins and contacts ---- */

static void AddHost(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses, kiriStepEnergy* sum)
{
    KIRI_TIMES(k, system->pinCount) {
        Spring spring = SpringOfPin(&system->pins[k]);
        AddEnergy(sum, SpringEnergy(system, &spring, poses), 0.0);
    }
    AddEnergy(sum, kiriStitches_Energy(system, poses), 0.0);
    KIRI_EACH_NEAR(contact, solver) {
        AddEnergy(sum, 0.0, kiriContact_Energy(solver, system, contact, poses));
    }
    AddEnergy(sum, 0.0, kiriRecoil_Energy(solver));
    int32_t springs = kiriSystem_HasWind(system) ? SAMPLES * system->frameCount : 0;
    KIRI_TIMES(n, springs) {
        Spring spring = SpringOfWind(solver, system, n / SAMPLES, n % SAMPLES);
        sum->objective += system->frames[spring.frame].held ? 0.0 : SpringEnergy(system, &spring, poses);
    }
}

/* ---- Elements and inertia ---- */

static void MeasureElement(const kiriSystem* system, int32_t k, const kiriPose* poses, double* strains)
{
    if (kiriElement_IsRigidCorner(system, k)) {
        kiriTrace trace = kiriElement_Trace(system, k, strains, KIRI_MOST_STRAINS);
        memcpy(&strains[KIRI_MOST_STRAINS * k], trace.strain, sizeof(trace.strain));
    } else {
        kiriElement_Measure(system, k, poses, &strains[KIRI_MOST_STRAINS * k], NULL);
    }
}

/* Adds the energies of springs and dampers; `pulling` are the strains without their offsets. */
static void AddElementEnergy(const kiriSolver* solver, const kiriSystem* system, int32_t k, const double* strain,
                             const double* pulling, kiriStepEnergy* sum)
{
    const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
    const double* loss = &solver->loss.data[KIRI_MOST_STRAINS * k];
    const double* start = &solver->startStrain.data[KIRI_MOST_STRAINS * k];
    KIRI_ASSERT(k >= 0 && k < solver->elementCount);
    int count = kiriElement_StrainCount(system, k);
    KIRI_TIMES(e, count) {
        double change = strain[e] - start[e];
        AddEnergy(sum, 0.5 * stiffness[e] * pulling[e] * pulling[e], 0.5 * loss[e] * change * change);
    }
}

static kiriStepEnergy InertiaEnergy(const kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    kiriStepEnergy sum = { 0 };
    double part = solver->stepping.part;
    KIRI_TIMES(f, system->frameCount) {
        const kiriPrediction* prediction = &solver->predictions.data[f];
        kiriVec3 off = kiriVec3_Sub(poses[f].x, prediction->pose.x);
        double moved = system->frames[f].mass * kiriVec3_Dot(off, off) +
                       kiriMat3_TurnSquared(&prediction->moments, &prediction->target, &poses[f].A);
        AddEnergy(&sum, 0.0, 0.5 * moved / (part * part));
    }
    return sum;
}

kiriStepEnergy kiriObjective_Evaluate(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    kiriSolver_FindNear(solver, system, poses);
    kiriStepEnergy sum = InertiaEnergy(solver, system, poses);
    bool isStart = poses == solver->start.data && !solver->isPut, hasStops = !system->mechanics.planar;
    KIRI_TIMES(k, solver->elementCount) {
        double pulling[KIRI_MOST_STRAINS];
        bool isKnown = isStart && kiriElement_Clamp(system, k) == NULL; /* clamps have moved */
        if (!isKnown) {
            MeasureElement(system, k, poses, solver->nowStrain.data);
        }
        const double* strain = &(isKnown ? solver->startStrain.data : solver->nowStrain.data)[KIRI_MOST_STRAINS * k];
        double flow = kiriElement_Flow(system, k, strain, solver->search.mayFlow);
        kiriElement_TakeOffsets(system, k, strain, pulling);
        AddElementEnergy(solver, system, k, strain, pulling, &sum);
        AddFlow(&sum, flow);
        bool counts = !isKnown || solver->isHeld; /* stops at the start do not, unless the host holds a frame */
        solver->stopping.data[k] |=
            counts && hasStops && kiriElement_IsRigidLink(system, k) && strain[KIRI_NORMAL_STOP] != 0.0;
    }
    AddHost(solver, system, poses, &sum);
    return sum;
}

/* ---- Noise ---- */

/* Returns the noise of a corner: of the sums of strains in its traces. */
static double CornerNoise(const kiriSolver* solver, const kiriSystem* system, const kiriCorner* corner,
                          const double* stiffness)
{
    double weight = 0.0, reach = 0.0;
    KIRI_TIMES(k, corner->count) {
        const kiriLink* link = &system->links[corner->link[k]];
        double size = kiriVec2_Length(corner->weight[k]);
        weight += size;
        reach += size * (kiriVec3_Length(solver->start.data[link->i].x) + link->length);
    }
    return stiffness[KIRI_TRACE_STRETCH] * reach * reach + stiffness[KIRI_TRACE_CURVATURE] * weight * weight;
}

/* Returns the noise of an affine frame. The columns of A have lengths near 1. */
static double AffineNoise(const kiriSolver* solver, const kiriSystem* system, int32_t k, const double* stiffness)
{
    int32_t count = kiriElement_Members(system, k, solver->members.data);
    double strain[KIRI_MOST_STRAINS], sum = 0.0;
    kiriElement_Measure(system, k, solver->start.data, strain, solver->rows.data);
    KIRI_TIMES(e, kiriElement_StrainCount(system, k)) {
        double reach = 0.0;
        KIRI_TIMES(m, count) {
            const kiriVec3* by = solver->rows.data[count * e + m].by;
            reach += kiriVec3_Length(by[0]) * kiriVec3_Length(solver->start.data[solver->members.data[m]].x) +
                     kiriVec3_Length(by[1]) + kiriVec3_Length(by[2]) + kiriVec3_Length(by[3]);
        }
        sum += stiffness[e] * reach * reach;
    }
    return sum;
}

/* Finds the energy of all springs and of the inertia if lengths are wrong by their last bits. A sheet at rest has no
   more energy than that. */
static void FindNoise(kiriSolver* solver, const kiriSystem* system)
{
    double part = solver->stepping.part, sum = 0.0, damping = 0.0;
    KIRI_TIMES(f, system->frameCount) {
        damping = kiriMax((double)kiriSystem_MaterialOf(system, f)->flexDamping / solver->dt, damping);
    }
    const double share = KIRI_LAST_BITS * KIRI_LAST_BITS * (1.0 + damping);
    KIRI_TIMES(f, system->frameCount) {
        kiriVec3 x = solver->start.data[f].x;
        sum += share * system->frames[f].mass * kiriVec3_Dot(x, x) / (part * part);
    }
    KIRI_TIMES(k, solver->elementCount) {
        const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
        double noise = kiriElement_IsRigidCorner(system, k)
                           ? CornerNoise(solver, system, kiriElement_Corner(system, k), stiffness)
                       : !kiriElement_IsRigidLink(system, k) ? AffineNoise(solver, system, k, stiffness)
                                                             : 0.0;
        if (kiriElement_IsRigidLink(system, k)) {
            const kiriLink* link = kiriElement_Link(system, k);
            kiriElement_Members(system, k, solver->members.data);
            double reach = kiriVec3_Length(solver->start.data[solver->members.data[0]].x) + link->length;
            noise = reach * reach * (stiffness[KIRI_STRETCH] + stiffness[KIRI_SHEAR] + stiffness[KIRI_NORMAL_GAP]) +
                    stiffness[KIRI_PLANE_BENDING] + stiffness[KIRI_BENDING] + stiffness[KIRI_TWIST];
        }
        sum += share * noise;
    }
    solver->search.noise = sum + share * kiriStitches_Noise(solver, system);
}

/* ---- Begin ---- */

/* Returns the damping factor of an element. A corner has the factor of its least damped link. */
static double DampingShare(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriCorner* corner = kiriElement_IsRigidCorner(system, k) ? kiriElement_Corner(system, k) : NULL;
    const double* start = solver->startStrain.data;
    double least = kiriElement_IsRigidLink(system, k) ? kiriStrain_Damping(&start[KIRI_MOST_STRAINS * k]) : 1.0;
    KIRI_TIMES_WHILE(corner != NULL, n, corner->count) {
        double share = kiriStrain_Damping(&start[KIRI_MOST_STRAINS * corner->link[n]]);
        least = kiriMin(share, least);
    }
    return least;
}

static kiriSupport SupportOf(const kiriSolver* solver, const kiriSystem* system)
{
    bool isHeld = kiriSystem_HasWind(system) || solver->isHeld || system->pinCount > 0 || system->clampCount > 0;
    bool isPushed = false;
    KIRI_EACH_STITCH(row, system) {
        isHeld |= row->solvers[0] == NULL || row->solvers[1] == NULL;
    }
    KIRI_EACH(const kiriContactStep, contact, solver->contacts) {
        isPushed |= !kiriContact_IsMutual(contact);
    }
    return isHeld ? KIRI_SUPPORT_HELD : isPushed ? KIRI_SUPPORT_CONTACTS : KIRI_SUPPORT_NONE;
}

/* Prepares links and clamps that yield, from their strains at the start. */
static void BeginYields(kiriSolver* solver, const kiriSystem* system)
{
    solver->yields = system->flows != NULL;
    KIRI_TIMES(k, solver->elementCount) {
        kiriYield* yield = kiriElement_Yield(system, k);
        if (yield != NULL) {
            const kiriClampRow* clamp = kiriElement_Clamp(system, k);
            const kiriLink* link = kiriElement_Link(system, k);
            const kiriMaterial* material = clamp != NULL ? clamp->material : kiriSystem_MaterialOf(system, link->i);
            const kiriBentStrain strain = kiriBentStrain_Of(&solver->startStrain.data[KIRI_MOST_STRAINS * k]);
            const kiriBentStrain offset = kiriBentStrain_Of(kiriElement_Offset(system, k));
            kiriBentStrain stiffness = kiriBentStrain_Of(&solver->stiffness.data[KIRI_MOST_STRAINS * k]);
            double length = clamp != NULL ? link->length
                                          : kiriStrain_YieldLength(link, material, &stiffness, strain.bending);
            kiriYield_Begin(yield, clamp != NULL ? &clamp->plastic : &system->plastics[k], material, length, &stiffness,
                            &offset, &strain);
            solver->yields = true;
        }
    }
    if (system->flows != NULL) {
        kiriYields_Share(system->flows, system->links, system->linkCount, solver->regions.data, system->frameCount);
    }
}

void kiriSolver_Begin(kiriSolver* solver, const kiriSystem* system, double dt)
{
    KIRI_ASSERT(dt > 0.0 && system->frames == solver->before.data && system->frameCount <= solver->before.capacity);
    KIRI_ASSERT(kiriElement_Count(system) <= solver->stopping.capacity);
    KIRI_CLEAR(&solver->search);
    KIRI_CLEAR(&solver->touch);
    solver->touch.keepForces = 1.0;
    solver->dt = dt;
    solver->elementCount = kiriElement_Count(system);
    solver->isAlong = solver->isHeld = solver->isPut = false;
    solver->search.scale = 1.0;
    /* Air damping is applied first, so it only takes energy, whatever gravity does to the velocity. The second-order
       form equals exp(-z) up to the third power of z. Moving air adds the force that ends the fade at its velocity. */
    bool isEuler = system->mechanics.timeStepping == KIRI_TIME_STEPPING_EULER;
    KIRI_TIMES(f, system->frameCount) {
        double z = dt * (double)kiriSystem_MaterialOf(system, f)->airDamping;
        double fade = 1.0 / (1.0 + z + (isEuler ? 0.0 : 0.5 * z * z));
        const kiriAir* air = kiriSystem_AirOf(system, f);
        kiriFrameData frame = *solver->sources.data[f], *before = &solver->before.data[f];
        solver->isHeld |= frame.held != 0;
        solver->start.data[f] = kiriPose_Of(&frame);
        if (air != NULL) {
            frame.force = kiriVec3_AddScaled(frame.force, frame.mass * (1.0 - fade) / dt, air->velocity);
        }
        *before = FlattenFrame(&system->mechanics, &frame);
        before->velocity = kiriVec3_Scale(fade, before->velocity);
        before->spin = kiriVec3_Scale(fade, before->spin);
        before->rate = kiriMat3_Scale(fade, &before->rate);
    }
    kiriSolver_BeginContacts(solver, system);
    KIRI_TIMES_WHILE(solver->contacts.count > 0, f, system->frameCount) {
        kiriVec3* spin = &solver->before.data[f].spin;
        double turn = dt * kiriVec3_Length(*spin);
        *spin = turn > TOUCHING_TURN ? kiriVec3_Scale(TOUCHING_TURN / turn, *spin) : *spin;
    }
    solver->support = SupportOf(solver, system);
    solver->stepping = ChooseStepping(solver, system);
    Predict(solver, system);
    /* A contact pushes within a step, and then no more. */
    solver->isTouched = IsPushed(solver) ||
                        kiriSolver_AreTouching(solver, system, solver->start.data) ||
                        kiriSolver_AreTouching(solver, system, solver->poses.data);
    if (solver->isTouched && !solver->stepping.isEuler) {
        BecomeEuler(solver, system);
    }
    kiriSolver_CenterBody(solver, system);
    KIRI_TIMES(k, solver->elementCount) {
        double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
        kiriClampRow* clamp = kiriElement_Clamp(system, k);
        kiriElement_Stiffness(system, k, stiffness);
        if (clamp != NULL) { /* the line has not moved yet */
            kiriClamp_Measure(clamp, &system->frames[clamp->frame], &clamp->start, &solver->start.data[clamp->frame],
                              &solver->startStrain.data[KIRI_MOST_STRAINS * k], NULL);
        } else {
            MeasureElement(system, k, solver->start.data, solver->startStrain.data);
        }
        solver->stopping.data[k] = 0;
        kiriElement_Members(system, k, solver->members.data);
        const kiriMaterial* material = kiriSystem_MaterialOf(system, solver->members.data[0]);
        double damping = material->flexDamping / dt * DampingShare(solver, system, k);
        for (int e = 0, count = kiriElement_StrainCount(system, k); e < count; ++e) {
            solver->loss.data[KIRI_MOST_STRAINS * k + e] = damping * stiffness[e];
        }
        if (kiriElement_IsRigidLink(system, k) && solver->startStrain.data[KIRI_MOST_STRAINS * k + KIRI_FOLD] > 0.0) {
            solver->loss.data[KIRI_MOST_STRAINS * k + KIRI_PLANE_BENDING] = 0.0; /* they change their signs in folds */
            solver->loss.data[KIRI_MOST_STRAINS * k + KIRI_FOLD_SLIDE] = 0.0;
        }
    }
    KIRI_TIMES(f, system->frameCount) {
        if (system->frames[f].held) {
            const kiriPose was = solver->start.data[f];
            solver->start.data[f] = solver->predictions.data[f].pose;
            solver->isPut |= memcmp(&was, &solver->start.data[f], sizeof(was)) != 0;
        }
    }
    BeginYields(solver, system);
    FindNoise(solver, system);
    kiriSolver_CenterBody(solver, system);
}

/* ---- Matrix and forces ------------------------------------------------------------------------------------------- */

static void AddFrameInertia(kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < system->frameCount);
    const kiriPrediction* prediction = &solver->predictions.data[f];
    const kiriPose* pose = &solver->poses.data[f];
    const kiriMassMoments* m = &prediction->moments;
    const double moments[4][4] = { { system->frames[f].mass, 0.0, 0.0, 0.0 },
                                   { 0.0, m->uu, m->uv, 0.0 },
                                   { 0.0, m->uv, m->vv, 0.0 },
                                   { 0.0, 0.0, 0.0, m->dd } };
    kiriMat3 inertia = kiriPrediction_Inertia(prediction, &pose->A);
    double part = solver->stepping.part;
    double perTime = 1.0 / (part * part), block[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS];
    KIRI_TIMES(r, solver->size) {
        const kiriUnknown* a = &solver->unknowns[r];
        bool turns = a->vector == 1 && !kiriMechanics_IsAffine(&system->mechanics);
        kiriVec3 spun = turns ? kiriMat3_Mul(inertia, a->axis) : a->axis;
        KIRI_TIMES(c, solver->size) {
            const kiriUnknown* b = &solver->unknowns[c];
            block[solver->size * r + c] = turns && b->vector == 1  ? perTime * kiriVec3_Dot(b->axis, spun)
                                          : a->number == b->number ? perTime * moments[a->vector][b->vector]
                                                                   : 0.0;
        }
    }
    kiriMatrix_AddOwn(solver->matrix, f, block);
    double* force = &solver->force.data[solver->size * f];
    kiriFrameRow row = { { kiriVec3_Scale(system->frames[f].mass, kiriVec3_Sub(prediction->pose.x, pose->x)) } };
    if (kiriMechanics_IsAffine(&system->mechanics)) {
        kiriMat3 gradient = kiriPrediction_Gradient(prediction, &pose->A);
        row.by[1] = kiriVec3_Scale(-1.0, gradient.u);
        row.by[2] = kiriVec3_Scale(-1.0, gradient.v);
        row.by[3] = kiriVec3_Scale(-1.0, gradient.d);
    } else {
        row.by[1] = kiriVec3_Scale(-1.0, kiriPrediction_TurnGradient(prediction, &pose->A, &prediction->target));
    }
    kiriSolver_Reduce(solver, &row, force);
    KIRI_TIMES(n, solver->size) {
        force[n] *= perTime;
    }
}

void kiriSolver_AddSquares(kiriSolver* solver, const int32_t* frames, int32_t frameCount, const double* J,
                           const double* springs, const double* pulls, int rows)
{
    kiriMatrix_AddForces(solver->matrix, frames, frameCount, J, pulls, rows, solver->force.data);
    kiriMatrix_AddSquares(solver->matrix, frames, frameCount, J, springs, rows);
}

/* Returns the stored derivatives of a link's strains that corners use. */
static double* TracedRows(const kiriSolver* solver, int32_t link, int traced)
{
    return &solver->tracedRows.data[2 * (size_t)solver->size * (KIRI_TRACED * (size_t)link + (size_t)traced)];
}

/* Derives the strains of a corner from the rows of its links. */
static void DeriveTraces(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t count, double* strain)
{
    const kiriCorner* corner = kiriElement_Corner(system, k);
    kiriTrace trace = kiriElement_Trace(system, k, solver->nowStrain.data, KIRI_MOST_STRAINS);
    int traces = kiriElement_StrainCount(system, k), size = solver->size;
    int32_t members[4], ends[4][2];
    kiriTrace_Members(corner, system->links, members, ends);
    memcpy(strain, trace.strain, sizeof(double) * (size_t)traces);
    memset(solver->J.data, 0, sizeof(double) * (size_t)(traces * count * size));
    KIRI_TIMES(n, count) {
        KIRI_TIMES(t, traces) {
            const double *along = TracedRows(solver, corner->link[n], 2 * t), *across = along + 2 * size;
            for (int end = 0; end < 2; ++end, along += size, across += size) {
                double* J = &solver->J.data[size * (count * t + ends[n][end])];
                KIRI_FROM_TO(u, t == KIRI_TRACE_STRETCH ? 0 : 3, size) { /* directors only turn */
                    J[u] += trace.by[n][2 * t] * along[u] + trace.by[n][2 * t + 1] * across[u];
                }
            }
        }
    }
}

/* Measures the strains of an element at the poses, and J, their derivatives by the unknowns of its frames. */
static void DeriveStrains(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t count, double* strain)
{
    size_t bytes = sizeof(double) * (size_t)solver->size;
    double* J = solver->J.data;
    if (kiriElement_IsRigidCorner(system, k)) {
        DeriveTraces(solver, system, k, count, strain);
        return;
    }
    bool isRigidLink = k < kiriElement_LinkCount(system) && kiriElement_IsRigidLink(system, k);
    if (isRigidLink && !system->mechanics.planar) {
        const kiriLink* link = kiriElement_Link(system, k);
        const kiriFrameData* const frames[2] = { &system->frames[link->i], &system->frames[link->j] };
        const kiriPose* const ends[2] = { &solver->poses.data[link->i], &solver->poses.data[link->j] };
        kiriStrain_Measure(link, kiriSystem_MaterialOf(system, link->i), frames, ends, kiriSystem_Turned(system, link),
                           strain, (kiriStrainRow*)J); /* rows are J as it is */
    } else {
        kiriElement_Measure(system, k, solver->poses.data, strain, solver->rows.data);
        KIRI_TIMES(n, kiriElement_StrainCount(system, k) * count) {
            kiriSolver_Reduce(solver, &solver->rows.data[n], &J[solver->size * n]);
        }
    }
    bool isTraced = kiriElement_CornerCount(system) > 0 && isRigidLink;
    KIRI_TIMES_WHILE(isTraced, s, system->mechanics.planar ? KIRI_TRACED_BENDING : KIRI_TRACED) {
        memcpy(TracedRows(solver, k, s), &J[2 * solver->size * kiriTrace_Source(s)], 2 * bytes);
    }
}

/* Turns the rows and the springs of an element that flows. */
static void TurnFlow(kiriSolver* solver, const kiriSystem* system, int32_t k, int32_t count, double* springs,
                     double* pulls)
{
    const kiriYield* yield = kiriElement_Yield(system, k);
    const double *strain = &solver->nowStrain.data[KIRI_MOST_STRAINS * k],
                 *start = &solver->startStrain.data[KIRI_MOST_STRAINS * k];
    double *J = solver->J.data, *traced[2] = { NULL, NULL };
    int width = count * solver->size;
    KIRI_TIMES_WHILE(count == 2 && kiriElement_CornerCount(system) > 0, s, 2) {
        traced[s] = TracedRows(solver, k, KIRI_TRACED_BENDING + s);
    }
    kiriYield_TurnRows(yield, width, &J[width * KIRI_BENDING], &J[width * KIRI_TWIST], traced);
    kiriBentStrain now = kiriBentStrain_Of(strain), then = kiriBentStrain_Of(start), stiff = kiriBentStrain_Of(springs),
                   pull = kiriBentStrain_Of(pulls);
    kiriBentStrain change = { now.bending - then.bending, now.twist - then.twist, now.fold - then.fold };
    kiriYield_TurnSprings(yield, solver->loss.data[KIRI_MOST_STRAINS * k + KIRI_BENDING], &change, &stiff, &pull);
    kiriBentStrain_Write(&stiff, springs);
    kiriBentStrain_Write(&pull, pulls);
}

/* The linear model of an element at the poses. Its derivatives are in solver->J, its frames in solver->members. */
typedef struct ElementModel {
    int32_t count; /* frames */
    int rows;
    double flow; /* J */
    double pulling[KIRI_MOST_STRAINS], springs[KIRI_MOST_STRAINS], pulls[KIRI_MOST_STRAINS];
} ElementModel;

#define QUICK_BEND 0.1 /* rad: of a link in a step */

/* Adds the second derivatives of the stretch of a taut link. Without them a Gauss-Newton step swings taut sheets too far, and is
   cut short. The line between the frames turns; they leave it; bent, they are longer than the arc between them. The
   tension is that at the start of the step, or less: false stretch while frames turn does not count. The first system
   of a step must turn frames freely; not near contacts, where it would stretch links instead. Lines are held after a step
   that was cut short: else stiff paper that snaps stays out of balance, and plastic links flow by tension that passes. */
static void AddTension(kiriSolver* solver, const kiriSystem* system, int32_t k, const double* strain, ElementModel* model)
{
    const kiriLink* link = kiriElement_Link(system, k);
    double now = model->pulling[KIRI_STRETCH], start = solver->startStrain.data[KIRI_MOST_STRAINS * k + KIRI_STRETCH];
    double least = kiriMin(start - strain[KIRI_STRETCH] + now, now);
    if ((solver->search.solved == 0 && !solver->touch.isNear) || link->fold != 0 || !(least > 0.0)) {
        return;
    }
    double taut = solver->stiffness.data[KIRI_MOST_STRAINS * k + KIRI_STRETCH] * least / link->length;
    double bent = strain[KIRI_BENDING] - solver->startStrain.data[KIRI_MOST_STRAINS * k + KIRI_BENDING];
    if (fabs(bent) > QUICK_BEND || solver->search.scale >= KIRI_SHORT_STEP) { /* lines turn freely, too */
        model->springs[KIRI_NORMAL_GAP] += KIRI_TAUTNESS * taut;
        return;
    }
    KIRI_ASSERT(model->rows < KIRI_MOST_STRAINS);
    double* J = &solver->J.data[solver->size * model->count * model->rows];
    const kiriClampRow* clamp = kiriElement_Clamp(system, k);
    const kiriPose *j = &solver->poses.data[solver->members.data[model->count - 1]],
                   *i = clamp != NULL ? &clamp->pose : &solver->poses.data[solver->members.data[0]];
    kiriVec3 line = kiriVec3_Normalize(kiriVec3_Sub(j->x, i->x)), d = kiriVec3_Add(i->A.d, j->A.d);
    d = kiriVec3_Normalize(kiriVec3_AddScaled(d, -kiriVec3_Dot(d, line), line));
    memset(J, 0, sizeof(double) * (size_t)(solver->size * model->count));
    kiriVec3_StoreDoubles(J, kiriVec3_Scale(-1.0, d)); /* a clamp has one frame: the next line overwrites it */
    kiriVec3_StoreDoubles(&J[solver->size * (model->count - 1)], d);
    model->springs[KIRI_NORMAL_GAP] += (KIRI_TAUTNESS - 1.0) * taut;
    model->springs[KIRI_BENDING] += taut * link->length * link->length / 12.0;
    model->springs[model->rows] = taut;
    model->pulls[model->rows++] = 0.0;
}

static void LinearizeElement(kiriSolver* solver, const kiriSystem* system, int32_t k, ElementModel* model)
{
    const double* stiffness = &solver->stiffness.data[KIRI_MOST_STRAINS * k];
    const double* loss = &solver->loss.data[KIRI_MOST_STRAINS * k];
    const double* start = &solver->startStrain.data[KIRI_MOST_STRAINS * k];
    double *strain = &solver->nowStrain.data[KIRI_MOST_STRAINS * k], *springs = model->springs;
    model->count = kiriElement_Members(system, k, solver->members.data);
    DeriveStrains(solver, system, k, model->count, strain);
    model->flow = kiriElement_Flow(system, k, strain, solver->search.mayFlow);
    kiriElement_TakeOffsets(system, k, strain, model->pulling);
    /* Fold, stop and slide of a link come last, and push only where they are not zero. But the line search halves every step
       that runs into a stop. So after a step that was cut short, the stops that it ran into resist as springs of no
       length. */
    int rows = kiriElement_StrainCount(system, k), always = rows;
    bool isStopping = solver->search.scale < KIRI_SHORT_STEP && solver->stopping.data[k];
    if (kiriElement_Link(system, k) != NULL && !system->mechanics.planar) {
        always = kiriElement_IsRigidLink(system, k) ? KIRI_FOLD : rows - 1;
    }
    while (rows > always && strain[rows - 1] == 0.0 && !isStopping) {
        --rows;
    }
    KIRI_TIMES(e, rows) {
        springs[e] = stiffness[e] + loss[e];
        model->pulls[e] = -stiffness[e] * model->pulling[e] - loss[e] * (strain[e] - start[e]);
    }
    model->rows = rows;
    if (always == KIRI_FOLD) {
        AddTension(solver, system, k, strain, model);
    }
    if (model->flow > 0.0) {
        TurnFlow(solver, system, k, model->count, springs, model->pulls);
    }
    if (isStopping && strain[KIRI_NORMAL_STOP] == 0.0) {
        springs[KIRI_NORMAL_GAP] += stiffness[KIRI_NORMAL_STOP];
    }
}

static void AddElement(kiriSolver* solver, const kiriSystem* system, int32_t k, kiriStepEnergy* energy)
{
    ElementModel model;
    LinearizeElement(solver, system, k, &model);
    AddElementEnergy(solver, system, k, &solver->nowStrain.data[KIRI_MOST_STRAINS * k], model.pulling, energy);
    AddFlow(energy, model.flow);
    KIRI_TIMES_WHILE(solver->isHeld, m, model.count) { /* held frames do not move */
        KIRI_TIMES_WHILE(system->frames[solver->members.data[m]].held, e, model.rows) {
            memset(&solver->J.data[solver->size * (model.count * e + m)], 0, sizeof(double) * (size_t)solver->size);
        }
    }
    kiriSolver_AddSquares(solver, solver->members.data, model.count, solver->J.data, model.springs, model.pulls,
                          model.rows);
}

static void AddSpring(kiriSolver* solver, const kiriSystem* system, const Spring* spring)
{
    kiriVec3 force = ForceOf(spring, kiriSystem_Point(system, spring->frame, spring->at, solver->poses.data));
    const kiriContactMember member = { spring->frame, 1.0, spring->at };
    kiriPointSprings at = { .share = 1.0, .spring = { spring->across, spring->along, spring->along } };
    at.axis[0] = spring->normal;
    at.axis[1] = kiriVec3_Normalize(kiriVec3_Cross(spring->normal, kiriVec3_OtherAxis(spring->normal)));
    at.axis[2] = kiriVec3_Cross(at.axis[1], spring->normal);
    KIRI_TIMES(e, KIRI_POINT_ROWS) {
        at.pull[e] = kiriVec3_Dot(force, at.axis[e]);
    }
    kiriSolver_AddPointSprings(solver, system, &member, 1, NULL, &at);
}

/* ---- The linear system ---- */

kiriStepEnergy kiriSolver_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_ASSERT(solver->matrix->count == system->frameCount);
    kiriMatrix_Clear(solver->matrix);
    kiriRecoil_Clear(solver, system->frameCount);
    kiriSolver_LinearizeContacts(solver, system);
    KIRI_TIMES(f, system->frameCount) {
        memset(&solver->force.data[solver->size * f], 0, sizeof(double) * (size_t)solver->size);
        if (!system->frames[f].held) {
            AddFrameInertia(solver, system, f);
            continue;
        }
        double identity[KIRI_MOST_UNKNOWNS * KIRI_MOST_UNKNOWNS] = { 0 }; /* it stays where it is */
        KIRI_TIMES(n, solver->size) {
            identity[(solver->size + 1) * n] = 1.0;
        }
        kiriMatrix_AddOwn(solver->matrix, f, identity);
    }
    kiriStepEnergy sum = InertiaEnergy(solver, system, solver->poses.data);
    KIRI_TIMES(k, solver->elementCount) {
        AddElement(solver, system, k, &sum);
    }
    KIRI_TIMES(k, system->pinCount) {
        Spring spring = SpringOfPin(&system->pins[k]);
        AddSpring(solver, system, &spring);
    }
    kiriStitches_Assemble(solver, system);
    KIRI_EACH_NEAR(contact, solver) {
        kiriContact_Assemble(solver, system, contact);
    }
    int32_t springs = kiriSystem_HasWind(system) ? SAMPLES * system->frameCount : 0;
    KIRI_TIMES(n, springs) {
        Spring spring = SpringOfWind(solver, system, n / SAMPLES, n % SAMPLES);
        AddSpring(solver, system, &spring);
    }
    solver->isAlong = true; /* contacts know where they are: nothing has moved since LinearizeContacts */
    AddHost(solver, system, solver->poses.data, &sum);
    solver->isAlong = false;
    return sum;
}

/* ---- Reactions ----------------------------------------------------------------------------------------------------

   Forces of pins, clamps and holds are forces of the linear model of each system, as far as its step was taken. With the
   inertia and the other forces the model is in balance. At the poses, stiff springs are wrong by what turned frames
   leave. */

/* Returns a reaction of the body by its number: of a pin, of a clamp, or of a held frame. Null: it is not computed. */
static kiriReaction* ReactionAt(const kiriSolver* solver, const kiriSystem* system, int32_t n)
{
    int32_t clamp = n - system->pinCount, frame = clamp - system->clampCount;
    KIRI_ASSERT(n >= 0 && frame < system->frameCount);
    if (frame >= 0) {
        return system->frames[frame].held ? &solver->sources.data[frame]->reaction : NULL;
    }
    return clamp >= 0 ? system->clamps[clamp].reaction : system->pins[n].reaction;
}

#define EACH_REACTION(reaction)                                                                                        \
    KIRI_TIMES(n_, system->pinCount + system->clampCount + (solver->isHeld ? system->frameCount : 0))                  \
        for (kiriReaction* reaction = ReactionAt(solver, system, n_); reaction != NULL; reaction = NULL)

/* Converts a wrench about a frame's x to a wrench about another point. */
static kiriWrench AboutPoint(const kiriWrench* wrench, kiriVec3 x, kiriVec3 point)
{
    kiriVec3 arm = kiriVec3_Sub(x, point);
    kiriWrench moved = { wrench->force, kiriVec3_Add(wrench->moment, kiriVec3_Cross(arm, wrench->force)) };
    return moved;
}

/* Takes a wrench about x of a frame from its hold: the hold bears all but the frame's own forces. */
static void TakeFromHold(const kiriSolver* solver, const kiriSystem* system, int32_t frame, kiriWrench wrench)
{
    if (system->frames[frame].held) {
        kiriVec3 held = solver->before.data[frame].heldPosition;
        wrench = AboutPoint(&wrench, solver->poses.data[frame].x, held);
        kiriWrench_Add(&solver->sources.data[frame]->reaction.solved, -1.0, &wrench);
    }
}

/* Takes a force on a point of several frames from their holds. */
static void TakePointFromHolds(const kiriSolver* solver, const kiriSystem* system, const kiriContactMember* members,
                               int32_t count, kiriVec3 force)
{
    KIRI_TIMES(m, count) {
        kiriVec3 arm = kiriSystem_Arm(system, members[m].frame, members[m].at, &solver->poses.data[members[m].frame]);
        kiriVec3 part = kiriVec3_Scale(members[m].value, force);
        TakeFromHold(solver, system, members[m].frame, (kiriWrench){ part, kiriVec3_Cross(arm, part) });
    }
}

/* Takes from the holds of frames what an element does to them, and sets the force of a clamp. */
static void SolveElement(kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriClampRow* clamp = kiriElement_Clamp(system, k);
    int32_t count = kiriElement_Members(system, k, solver->members.data), size = solver->size;
    bool isAny = clamp != NULL && clamp->reaction != NULL;
    KIRI_TIMES(m, count) {
        isAny |= system->frames[solver->members.data[m]].held != 0;
    }
    if (!isAny) {
        return;
    }
    ElementModel model;
    LinearizeElement(solver, system, k, &model);
    KIRI_TIMES(e, model.rows) {
        KIRI_TIMES(n, count * size) {
            double move = solver->move.data[size * solver->members.data[n / size] + n % size];
            model.pulls[e] -= model.springs[e] * solver->J.data[size * count * e + n] * move;
        }
    }
    KIRI_TIMES(m, count) {
        int32_t frame = solver->members.data[m];
        const kiriMat3* A = &solver->poses.data[frame].A;
        kiriWrench sum = { 0 };
        KIRI_TIMES(e, model.rows) {
            kiriFrameRow row = kiriSolver_Expand(solver, model.pulls[e], &solver->J.data[size * (count * e + m)]);
            kiriWrench wrench = { row.by[0], row.by[1] };
            if (kiriMechanics_IsAffine(&solver->mechanics)) {
                wrench.moment = kiriVec3_Add(kiriVec3_Cross(A->u, row.by[1]), kiriVec3_Cross(A->v, row.by[2]));
                wrench.moment = kiriVec3_Add(wrench.moment, kiriVec3_Cross(A->d, row.by[3]));
            }
            kiriWrench_Add(&sum, 1.0, &wrench);
        }
        if (clamp != NULL && clamp->reaction != NULL) {
            clamp->reaction->solved = AboutPoint(&sum, solver->poses.data[frame].x, clamp->pose.x);
        }
        TakeFromHold(solver, system, frame, sum);
    }
}

/* Finds the forces of the linear model after a system is solved. */
static void SolveReactions(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_TIMES(k, system->pinCount) {
        const kiriPinRow* pin = &system->pins[k];
        const kiriContactMember member = { pin->frame, 1.0, pin->at };
        kiriVec3 end = kiriVec3_Add(kiriSystem_Point(system, pin->frame, pin->at, solver->poses.data),
                                    kiriSolver_MoveOf(solver, system, &member, 1));
        kiriVec3 force = kiriVec3_Scale(pin->stiffness, kiriVec3_Sub(pin->target, end));
        if (pin->reaction != NULL) {
            pin->reaction->solved.force = force;
        }
        TakePointFromHolds(solver, system, &member, 1, force);
    }
    KIRI_EACH_STITCH(row, system) {
        TakePointFromHolds(solver, system, row->members, row->counts[0] + row->counts[1], row->solved);
    }
    KIRI_FROM_TO(k, solver->isHeld ? 0 : solver->elementCount - system->clampCount, solver->elementCount) {
        SolveElement(solver, system, k);
    }
}

/* Turns the force at the end of the step into an impulse by the step's scheme (kiri_frame.h), as inner forces are: so
   impulses add up to the momentum of the frames. */
static void EndReaction(const kiriStepping* stepping, kiriReaction* reaction)
{
    kiriWrench gain = { 0 }, none = gain;
    KIRI_ASSERT(stepping->part > 0.0);
    kiriWrench_Add(&reaction->now, 1.0, &reaction->solved);
    kiriWrench_Add(&gain, stepping->c, &reaction->gain);
    kiriWrench_Add(&gain, stepping->l, &reaction->pull);
    kiriWrench_Add(&gain, stepping->part, &reaction->now);
    kiriWrench_Add(&reaction->impulse, 1.0, &gain);
    reaction->gain = gain;
    reaction->pull = reaction->now;
    reaction->now = reaction->solved = none;
}

kiriVec3 kiriSolver_GainOf(const kiriSolver* solver, const kiriSystem* system, int32_t f)
{
    KIRI_ASSERT(f >= 0 && f < system->frameCount);
    const kiriFrameData *before = &solver->before.data[f], *after = &solver->after.data[f];
    kiriVec3 gravity = kiriVec3_Scale(before->mass, kiriSystem_Gravity(system));
    kiriVec3 gained = kiriVec3_Scale(before->mass, kiriVec3_Sub(after->velocity, before->velocity));
    return kiriVec3_AddScaled(gained, -solver->dt, kiriVec3_Add(gravity, before->force));
}

/* Adds the rest of the change of momentum to the reactions, in proportion to their size. A step that was cut short from
   its start leaves a rest, and the limit of energy does. */
static void BearRest(const kiriSolver* solver, const kiriSystem* system)
{
    kiriVec3 rest = { 0.0, 0.0, 0.0 };
    double all = 0.0;
    EACH_REACTION(reaction) {
        rest = kiriVec3_Sub(rest, reaction->gain.force);
        all += kiriVec3_Length(reaction->gain.force);
    }
    bool isKnown = all > 0.0 && !kiriSystem_HasWind(system);
    KIRI_EACH_STITCH(row, system) {
        isKnown = isKnown && row->solvers[0] != NULL && row->solvers[1] != NULL;
    }
    KIRI_EACH_WHILE(isKnown, const kiriContactStep, step, solver->contacts) {
        double part = kiriContact_IsMutual(step) ? 0.0 : solver->stepping.part;
        rest = kiriVec3_AddScaled(rest, -part, kiriContact_Force(solver, step));
    }
    KIRI_TIMES_WHILE(isKnown, f, system->frameCount) {
        kiriVec3 gain = kiriSolver_GainOf(solver, system, f);
        rest = kiriVec3_AddScaled(rest, system->frames[f].held ? 0.0 : 1.0, gain);
    }
    EACH_REACTION(reaction) {
        double share = isKnown ? kiriVec3_Length(reaction->gain.force) / all : 0.0;
        reaction->impulse.force = kiriVec3_AddScaled(reaction->impulse.force, share, rest);
    }
}

void kiriSolver_EndReactions(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH_STITCH(row, system) {
        row->impulse = kiriVec3_AddScaled(row->impulse, solver->dt, row->force);
        KIRI_TIMES_WHILE(row->bending > 0.0, m, row->counts[0] + row->counts[1]) {
            kiriWrench turn = { { 0.0, 0.0, 0.0 }, kiriStitch_Moment(row, m, solver->poses.data) };
            TakeFromHold(solver, system, row->members[m].frame, turn);
        }
    }
    KIRI_EACH_WHILE(solver->isHeld, const kiriContactStep, step, solver->contacts) {
        TakePointFromHolds(solver, system, step->members, step->memberCount, kiriContact_Force(solver, step));
    }
    KIRI_TIMES_WHILE(solver->isHeld && kiriSystem_HasWind(system), f, system->frameCount) {
        TakeFromHold(solver, system, f, WindOnFrame(solver, system, f));
    }
    EACH_REACTION(reaction) {
        EndReaction(&solver->stepping, reaction);
    }
    BearRest(solver, system);
    KIRI_TIMES_WHILE(solver->isHeld, f, system->frameCount) {
        const kiriFrameData *before = &solver->before.data[f], *after = &solver->after.data[f];
        const kiriMaterial* material = kiriSystem_MaterialOf(system, f);
        kiriVec3 spun = kiriVec3_Sub(kiriFrame_AngularMomentum(after, material),
                                     kiriFrame_AngularMomentum(before, material));
        kiriWrench own = { kiriSolver_GainOf(solver, system, f),
                           kiriVec3_AddScaled(spun, -solver->dt, before->torque) };
        own = AboutPoint(&own, solver->poses.data[f].x, before->heldPosition);
        kiriWrench_Add(&solver->sources.data[f]->reaction.impulse, before->held ? 1.0 : 0.0, &own);
    }
}

#define LONGEST_ITERATION_TURN 1.0 /* limit of a frame's turn in one Gauss-Newton step: a Cayley vector */
#define HALVINGS 12                /* of a step that does not lower the objective */
#define SECOND_CHANCES 4           /* extra iterations if energy is gained or the last step was cut short */
#define FRESH_STARTS 2             /* further iterations, from the start of the step, if these fail */
#define FREE_SYSTEMS 2             /* systems of a body near contacts before its stored energy is limited */
#define WORTHWHILE 1e-6            /* of the objective: smaller promises of a step that was cut short do not count */
#define LASTING 1e-2               /* of the energy that flow takes: a larger promise counts, for a false flow stays */
#define MOST_RISE 100.0            /* limit of the objective after the first step, relative to its start */
#define MOST_TAKEN 0.5             /* of the kinetic energy: a body with a raised objective that loses more restarts */
#define TOLERABLE_GAIN 1e-2        /* in a step of second order: of the energy that the limit can take, */
#define NEGLIGIBLE_GAIN 1e-9       /* plus this part of the whole energy */

/* ---- One Gauss-Newton step ---- */

/* Starts the line search with the whole Gauss-Newton step, or the part of it that turns no frame too far. */
static void StartSearch(kiriSolver* solver, const kiriSystem* system)
{
    kiriSearch* search = &solver->search;
    double longest = LONGEST_ITERATION_TURN;
    search->enough = search->now.objective * (1.0 + KIRI_ROUNDING) + search->noise;
    search->promise = solver->recoil.promise;
    KIRI_TIMES(f, system->frameCount) {
        KIRI_FROM_TO(n, solver->size * f, solver->size * (f + 1)) {
            search->promise += 0.5 * solver->force.data[n] * solver->move.data[n];
        }
        if (!kiriMechanics_IsAffine(&system->mechanics)) {
            kiriFrameRow change = kiriSolver_Expand(solver, 1.0, &solver->move.data[solver->size * f]);
            double turn = kiriVec3_Length(change.by[1]);
            longest = kiriMax(turn, longest);
        }
    }
    search->scale = LONGEST_ITERATION_TURN / longest;
    KIRI_ASSERT(!(search->scale > 1.0));
}

/* Returns true if the body may store this energy. A contact reached during the step has far more energy than the body.
   A line search by the objective alone would let links stretch by the same energy. The first systems are exempt,
   because they turn frames; later systems may store only the energy that the body has. */
static bool IsAffordable(const kiriSolver* solver, const kiriStepEnergy* energy)
{
    const kiriSearch* search = &solver->search;
    double most = search->start.potential + solver->touch.means;
    most = kiriMax(most, search->now.potential);
    return !solver->touch.isNear || search->solved < FREE_SYSTEMS || energy->potential <= most;
}

/* Takes a part of the Gauss-Newton step, unless the objective or the stored energy is too large. */
static void TryNewtonStep(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_TIMES(f, system->frameCount) {
        const kiriPose* pose = &solver->poses.data[f];
        kiriFrameRow change =
            kiriSolver_Expand(solver, solver->search.scale, &solver->move.data[solver->size * f]);
        kiriMat3 columns = { change.by[1], change.by[2], change.by[3] };
        solver->trial.data[f].x = kiriVec3_Add(pose->x, change.by[0]);
        solver->trial.data[f].A = kiriMechanics_IsAffine(&system->mechanics)
                                      ? kiriMat3_Advance(&pose->A, &columns)
                                      : kiriMat3_MulMat(kiriMat3_Cayley(change.by[1]), pose->A);
    }
    kiriRecoil_Try(solver, solver->search.scale);
    solver->isAlong = true;
    kiriStepEnergy energy = kiriObjective_Evaluate(solver, system, solver->trial.data);
    solver->isAlong = false;
    solver->search.isTaken = energy.objective <= solver->search.enough && IsAffordable(solver, &energy);
    if (solver->search.isTaken) {
        memcpy(solver->poses.data, solver->trial.data, sizeof(kiriPose) * (size_t)system->frameCount);
        solver->search.now = energy;
    }
}

/* Raises the limit for the first step to the objective of the free prediction, or MOST_RISE times the objective at its
   start. */
static void AllowPrediction(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_TIMES(f, system->frameCount) {
        solver->trial.data[f] = solver->predictions.data[f].pose;
    }
    double rise = MOST_RISE * solver->search.now.objective;
    kiriRecoil_Try(solver, 0.0);
    double predicted = kiriObjective_Evaluate(solver, system, solver->trial.data).objective;
    double allowed = kiriMax(predicted, rise) * (1.0 + KIRI_ROUNDING) + solver->search.noise;
    solver->search.enough = kiriMax(allowed, solver->search.enough);
}

/* Takes one Gauss-Newton step, halved until the objective falls. The first step may instead raise the objective, see
   AllowPrediction. Returns false if the matrix has no factor. */
static bool IterateOnce(kiriSolver* solver, const kiriSystem* system)
{
    kiriSearch* search = &solver->search;
    search->now = kiriSolver_Assemble(solver, system);
    if (!kiriMatrix_Factor(solver->matrix) || !kiriRecoil_Solve(solver, system->frameCount)) {
        return false;
    }
    kiriSolver_MoveContacts(solver, system);
    kiriStitches_Solve(solver, system);
    SolveReactions(solver, system);
    StartSearch(solver, system);
    TryNewtonStep(solver, system);
    if (!search->isTaken && search->isFirst) {
        AllowPrediction(solver, system);
        TryNewtonStep(solver, system);
    }
    KIRI_TIMES_WHILE(!search->isTaken, halving, HALVINGS) {
        search->scale *= 0.5;
        TryNewtonStep(solver, system);
    }
    search->isFirst = false;
    ++search->solved;
    ++solver->solved;
    kiriStitches_TakeForces(solver, system);
    double part = search->isTaken ? search->scale : 0.0;
    kiriRecoil_Try(solver, part);
    kiriRecoil_Take(solver);
    EACH_REACTION(reaction) {
        kiriWrench_Add(&reaction->now, -part, &reaction->now);
        kiriWrench_Add(&reaction->now, part, &reaction->solved);
        KIRI_CLEAR(&reaction->solved);
    }
    kiriSolver_ReviewContacts(solver, system);
    return true;
}

/* ---- The iteration as a whole ---- */

/* Returns true if the body gained too much energy in a step of second order. Such a step often gains a little, which
   the energy limit takes out. If the gain is larger, the iteration continues, and if that fails, the body repeats the
   step by backward Euler. This must be the only criterion: for a body at rest, any other would depend on rounding. */
static bool IsSuspect(const kiriSolver* solver)
{
    const kiriEnergyStep* energy = &solver->energy;
    double brakeable = kiriSolver_MostTaken(solver);
    double all = energy->kinetic + energy->moving + solver->search.start.potential + solver->search.now.potential;
    return !solver->stepping.isEuler && !(energy->gain <= TOLERABLE_GAIN * brakeable + NEGLIGIBLE_GAIN * all);
}

/* Returns true if the body gained energy or its step was cut short, so the iteration continues. */
static bool IsUnfinished(const kiriSolver* solver, int32_t done)
{
    const kiriSearch* search = &solver->search;
    bool isShort = search->scale < KIRI_SHORT_STEP && search->promise > WORTHWHILE * search->now.objective;
    bool hasGained = solver->stepping.isEuler && !(solver->energy.gain <= 0.0);
    bool isFlowing = search->now.flow > 0.0 && search->promise > LASTING * search->now.flow;
    return done < search->wanted || isFlowing || hasGained || search->suspects > 0 || isShort || solver->touch.isUnsettled;
}

/* Restarts the iteration at the poses before the step. */
static void EvaluateStart(kiriSolver* solver, const kiriSystem* system)
{
    kiriSolver_GuessContacts(solver, system);
    EACH_REACTION(reaction) {
        reaction->now = reaction->pull;
    }
    solver->search.mayFlow = false;
    solver->search.start = kiriObjective_Evaluate(solver, system, solver->start.data);
    solver->search.isFirst = true;
    solver->search.solved = 0;
}

/* Lets links flow, from the poses of the elastic iteration on. At the poses before the step, a clamp that moves bends one
   link by the whole step, and that link would take all of the flow. The objective changes only where one flows. */
static void BeginFlow(kiriSolver* solver, const kiriSystem* system, int32_t done)
{
    kiriSearch* search = &solver->search;
    bool isFlowing = !search->isTaken || system->clampCount > 0; /* else the strains of links are known */
    KIRI_TIMES_WHILE(!isFlowing, k, system->linkCount) {
        isFlowing = kiriElement_Flow(system, k, &solver->nowStrain.data[KIRI_MOST_STRAINS * k], true) > 0.0;
    }
    search->mayFlow = true;
    if (isFlowing) {
        search->now = kiriObjective_Evaluate(solver, system, solver->poses.data);
        search->wanted = search->now.flow > 0.0 ? kiriMax(done + 1, search->wanted) : search->wanted;
    }
}

/* Repeats the step by backward Euler. */
static void TakeAnew(kiriSolver* solver, const kiriSystem* system)
{
    BecomeEuler(solver, system);
    kiriSolver_CenterBody(solver, system);
    EvaluateStart(solver, system);
}

/* Restarts a body from its poses before the step, by backward Euler, if the energy limit would take too much of its
   motion. Obstacles in the system may supply a part of theirs. Returns false otherwise. */
static bool Restart(kiriSolver* solver, const kiriSystem* system)
{
    kiriSearch* search = &solver->search;
    bool isOver = !(search->now.objective <= search->start.objective * (1.0 + KIRI_ROUNDING) + search->noise);
    double own = solver->recoil.bodies.count > 0 ? KIRI_SPARE_MEANS * solver->touch.means : 0.0;
    if (solver->energy.gain <= (isOver ? MOST_TAKEN : 1.0) * kiriSolver_MostTaken(solver) + own) {
        return false;
    }
    TakeAnew(solver, system);
    search->now = search->start;
    search->solved = FREE_SYSTEMS;
    search->isFirst = false;
    memcpy(solver->poses.data, solver->start.data, sizeof(kiriPose) * (size_t)system->frameCount);
    solver->touch.isPlaced = false;
    kiriSolver_FindGains(solver, system);
    return true;
}

/* Minimises the objective. The iteration starts from free motion, without inner forces or with the forces of the last
   step: a swinging strip is then nearly at the minimum, and a strip at rest is there. The first Gauss-Newton step may
   raise the objective. It must turn stiff frames, which stretches links until the next step relaxes them; a line search
   would prevent the turn.

   The iteration continues for a body that gained energy or took only a part of its last step. The remaining gain is
   taken out of its velocities. If that would nearly stop the body, it restarts from its poses before the step, from
   where its objective only falls. Then, with v the velocities before and w the velocities after the step,

       potential after + 1/2 m (w - v)^2  <=  potential before + 1/2 m v^2 + work,

   which limits w to 2 v. At the minimum it holds with w^2 in place of (w - v)^2, except for parts of the energy
   that are not convex. So velocities stay bounded, however long the step. */
int32_t kiriSolver_Minimise(kiriSolver* solver, const kiriSystem* system, int32_t iterations, int32_t most)
{
    KIRI_ASSERT(iterations >= 1 && iterations <= most);
    int32_t done = 0, last = kiriMin(iterations + SECOND_CHANCES, most);
    bool isLeft = true, isFresh = false;
    EvaluateStart(solver, system);
    while (isLeft && done < last) {
        if (!IterateOnce(solver, system)) {
            return -1;
        }
        ++done;
        bool isBad = false;
        bool mayRest = solver->touch.isNear || system->maySettle;
        bool isAtRest = mayRest && solver->search.promise <= WORTHWHILE * solver->search.now.objective;
        isLeft = done < iterations && !isAtRest;
        if (!isLeft && !solver->search.mayFlow && solver->yields) {
            BeginFlow(solver, system, done);
        }
        if (!isLeft) {
            kiriSolver_FindGains(solver, system);
            solver->search.suspects = IsSuspect(solver) ? solver->search.suspects + 1 : 0;
            isBad = solver->search.suspects > 2;
            isLeft = IsUnfinished(solver, done);
        }
        if (isLeft && !isFresh && done == last) {
            isLeft = Restart(solver, system);
            isFresh = true;
            last += FRESH_STARTS; /* beyond `most`, or a small budget would hold the body still for good */
        } else if (isBad && done < last) {
            solver->search.wanted = done + iterations;
            TakeAnew(solver, system);
        }
    }
    KIRI_ASSERT(done <= iterations + KIRI_EXTRA_SYSTEMS);
    kiriSolver_HoldContacts(solver, system);
    return done;
}
