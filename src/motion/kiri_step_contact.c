#include "kiri_solver_work.h"

#define STIFFNESS 1e4       /* of a contact: so many times the mass of its frames over h'^2, */
#define GRIP 30.0           /* and so many times for the slide of what sticks */
#define SINKING 1e-4        /* m: and so much that it sinks in no deeper by what it is known to push with */
#define MOST_SPRING 1e9     /* but no more times the mass over h'^2 than that */
#define SLIDE_HALVINGS 8    /* of the step, where friction ends it */
#define SLOPE 0.1           /* of what the step promises: less is no crossing */
#define EARLY 2             /* systems */
#define PUSH_TOLERANCE 0.02 /* of the largest push of the piece: forces that are off by less need no other iteration */
#define SINK_TOLERANCE 1e-5 /* m: nor do points that came below a plane by less */

/* ---- Points ------------------------------------------------------------------------------------------------------ */

kiriVec3 kiriSystem_PointOfMany(const kiriSystem* system, const kiriWeight* weights, int32_t count, kiriVec2 at,
                                const kiriPose* poses)
{
    kiriVec3 x = { 0.0, 0.0, 0.0 };
    for (int32_t m = 0; m < count; ++m) {
        x = kiriVec3_AddScaled(x, weights[m].value, kiriSystem_Point(system, weights[m].frame, at, poses));
    }
    return x;
}

kiriVec3 kiriContact_Point(const kiriSolver* solver, const kiriSystem* system, int32_t k, const kiriPose* poses)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    return kiriSystem_PointOfMany(system, step->members, step->memberCount, system->contacts[k].at, poses);
}

static double DepthAt(const kiriContactStep* step, const kiriContactRow* row, kiriVec3 point)
{
    return step->plane - kiriVec3_Dot(row->normal, point);
}

double kiriContact_Depth(const kiriSolver* solver, const kiriSystem* system, int32_t k, const kiriPose* poses)
{
    return DepthAt(&solver->contacts.data[k], &system->contacts[k], kiriContact_Point(solver, system, k, poses));
}

static kiriVec3 SlideAt(const kiriContactStep* step, const kiriContactRow* row, kiriVec3 point)
{
    kiriVec3 way = kiriVec3_Sub(point, step->start);
    return kiriVec3_AlongPlane(kiriVec3_Sub(way, step->carried), row->normal);
}

double kiriContact_Inertia(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    double part = kiriContact_PieceOf(solver, system, k)->stepping.part;
    return solver->contacts.data[k].mass / (part * part);
}

/* ---- Obstacles that yield ---------------------------------------------------------------------------------------- */

static const kiriYieldRow* YieldOf(const kiriSystem* system, int32_t k)
{
    return system->contacts[k].yield != KIRI_NONE ? &system->yields[system->contacts[k].yield] : NULL;
}

/* The velocity that an obstacle has at a point by what sheets gave it in this tick. */
static kiriVec3 Recoil(const kiriSystem* system, int32_t k, kiriVec3 point)
{
    const kiriYieldRow* yield = YieldOf(system, k);
    if (yield == NULL) {
        return kiriVec3_Make(0.0, 0.0, 0.0);
    }
    if (system->contacts[k].felt >= 0.0) {
        return kiriVec3_Scale(system->contacts[k].felt, yield->impulse.force);
    }
    kiriVec3 spin = kiriMat3_Mul(yield->inverseInertia, yield->impulse.moment);
    kiriVec3 round = kiriVec3_Cross(spin, kiriVec3_Sub(point, yield->center));
    return kiriVec3_AddScaled(round, yield->inverseMass, yield->impulse.force);
}

kiriVec3 kiriContact_PlaneVelocity(const kiriSystem* system, int32_t k, kiriVec3 point)
{
    return kiriVec3_Add(system->contacts[k].velocity, Recoil(system, k, point));
}

double kiriContact_InverseMass(const kiriSystem* system, int32_t k, kiriVec3 point, kiriVec3 along)
{
    const kiriYieldRow* yield = YieldOf(system, k);
    if (yield == NULL || system->contacts[k].felt >= 0.0) {
        return yield == NULL ? 0.0 : system->contacts[k].felt;
    }
    kiriVec3 arm = kiriVec3_Cross(kiriVec3_Sub(point, yield->center), along);
    return yield->inverseMass + kiriVec3_Dot(arm, kiriMat3_Mul(yield->inverseInertia, arm));
}

/* ---- One linear system ------------------------------------------------------------------------------------------- */

static void CountPressed(const kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->yieldCount; ++k) {
        system->yields[k].pressed = 0;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        if (solver->contacts.data[k].isActive && system->contacts[k].yield != KIRI_NONE) {
            system->yields[system->contacts[k].yield].pressed += 1;
        }
    }
}

/* The spring of the contact is so stiff that nobody sees it, in series with the inertia of the obstacle. Contacts that
   press on one obstacle each have the same share of its mass: then none of them can give it more than is there, and
   together they give all (mass splitting; Tonge, Benevolenski, Voroshilov 2012). */
static void SetSprings(const kiriSolver* solver, const kiriSystem* system, int32_t k, kiriVec3 point)
{
    kiriContactStep* step = &solver->contacts.data[k];
    const kiriContactRow* row = &system->contacts[k];
    const kiriYieldRow* yield = YieldOf(system, k);
    double inertia = kiriContact_Inertia(solver, system, k),
           part = kiriContact_PieceOf(solver, system, k)->stepping.part;
    double asked = step->known / SINKING, most = MOST_SPRING * inertia;
    double spring = kiriMax(asked, STIFFNESS * inertia);
    spring = kiriMin(spring, most);
    double share = yield != NULL && yield->pressed > 1 ? yield->pressed : 1.0;
    double soft = part * part * share;
    kiriVec3 along = kiriVec3_Length(step->direction) > 0.5 ? step->direction : row->normal;
    step->give = soft * (row->cushion + kiriContact_InverseMass(system, k, point, row->normal));
    step->stiffness = 1.0 / (1.0 / spring + step->give);
    step->grip = 1.0 / (1.0 / (GRIP * inertia) + soft * kiriContact_InverseMass(system, k, point, along));
}

void kiriSolver_LinearizeContacts(kiriSolver* solver, const kiriSystem* system)
{
    CountPressed(solver, system);
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContactStep* step = &solver->contacts.data[k];
        if (kiriContact_PieceOf(solver, system, k)->isSearching) {
            kiriVec3 point = kiriContact_Point(solver, system, k, solver->poses.data);
            SetSprings(solver, system, k, point);
            step->depth = DepthAt(step, &system->contacts[k], point);
            step->slide = SlideAt(step, &system->contacts[k], point);
            step->sinks = 0.0;
            step->slides = kiriVec3_Make(0.0, 0.0, 0.0);
        }
    }
}

/* N: what friction would be if it stuck. */
static kiriVec3 Trial(const kiriContactStep* step, kiriVec3 slide)
{
    return kiriVec3_AddScaled(step->held, -step->grip, slide);
}

/* N/m: what turns the direction of a slide. */
double kiriContactStep_TurnSpring(const kiriContactStep* step)
{
    double trial = kiriVec3_Length(Trial(step, step->slide));
    return trial > step->limit ? step->grip * step->limit / trial : step->grip;
}

static kiriVec3 Beside(kiriVec3 a, kiriVec3 direction)
{
    return kiriVec3_AddScaled(a, -kiriVec3_Dot(a, direction), direction);
}

/* J: of the linear model, at a depth and a slide. */
static double EnergyAt(const kiriContactStep* step, double depth, kiriVec3 slide)
{
    double energy = 0.5 * step->stiffness * depth * depth;
    if (step->sticks) {
        return energy - kiriVec3_Dot(step->held, slide) + 0.5 * step->grip * kiriVec3_Dot(slide, slide);
    }
    kiriVec3 beside = Beside(slide, step->direction);
    return energy + step->limit * kiriVec3_Dot(step->direction, slide) +
           0.5 * kiriContactStep_TurnSpring(step) * kiriVec3_Dot(beside, beside);
}

double kiriContact_Energy(const kiriSolver* solver, const kiriSystem* system, int32_t k, const kiriPose* poses)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    if (!step->isActive) {
        return 0.0;
    }
    if (solver->isAlong) {
        double part = kiriContact_PieceOf(solver, system, k)->scale;
        return EnergyAt(step, step->depth + part * step->sinks, kiriVec3_AddScaled(step->slide, part, step->slides));
    }
    kiriVec3 point = kiriContact_Point(solver, system, k, poses);
    return EnergyAt(step, DepthAt(step, &system->contacts[k], point), SlideAt(step, &system->contacts[k], point));
}

/* The friction of the linear model, on the sheet. */
kiriVec3 kiriContactStep_Drag(const kiriContactStep* step, double part)
{
    kiriVec3 slide = kiriVec3_AddScaled(step->slide, part, step->slides);
    return step->sticks ? kiriVec3_AddScaled(step->held, -step->grip, slide)
                        : kiriVec3_AddScaled(kiriVec3_Scale(-step->limit, step->direction),
                                             -kiriContactStep_TurnSpring(step), Beside(slide, step->direction));
}

/* How the point moves by the solution, to first order. */
static kiriVec3 MoveOf(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    for (int32_t m = 0; m < step->memberCount; ++m) {
        kiriWeight member = step->members[m];
        kiriVec2 local = kiriVec2_Sub(system->contacts[k].at, system->frames[member.frame].center);
        kiriFrameRow by = kiriSolver_Expand(solver, 1.0, &solver->move.data[solver->size * member.frame]);
        kiriVec3 turn = kiriVec3_AddScaled(kiriVec3_Scale(local.x, by.by[1]), local.y, by.by[2]);
        if (!kiriMechanics_IsAffine(&system->mechanics)) {
            turn = kiriVec3_Cross(by.by[1], kiriPose_Along(&solver->poses.data[member.frame], local));
        }
        sum = kiriVec3_AddScaled(sum, member.value, kiriVec3_Add(by.by[0], turn));
    }
    return sum;
}

void kiriSolver_MoveContacts(kiriSolver* solver, const kiriSystem* system)
{
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContactStep* step = &solver->contacts.data[k];
        if (kiriContact_PieceOf(solver, system, k)->isSearching && step->isActive) {
            kiriVec3 move = MoveOf(solver, system, k);
            step->sinks = -kiriVec3_Dot(system->contacts[k].normal, move);
            step->slides = kiriVec3_AlongPlane(move, system->contacts[k].normal);
        }
    }
}

/* ---- How far to go ----------------------------------------------------------------------------------------------- */

/* J: how the energy of friction differs, along the step after a part of it, from that of the linear model: the
   derivative. */
static double FrictionSlope(const kiriContactStep* step, double part)
{
    kiriVec3 trial = Trial(step, kiriVec3_AddScaled(step->slide, part, step->slides));
    double size = kiriVec3_Length(trial);
    kiriVec3 drag = size > step->limit ? kiriVec3_Scale(step->limit / size, trial) : trial;
    return kiriVec3_Dot(kiriVec3_Sub(kiriContactStep_Drag(step, part), drag), step->slides);
}

static void SumForceSlopes(const kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->slope = -2.0 * piece->promise * (1.0 - piece->scale);
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriContact_PieceOf(solver, system, k);
        const kiriContactStep* step = &solver->contacts.data[k];
        if (piece->isSearching && step->isActive && piece->solved >= EARLY) {
            piece->slope += FrictionSlope(step, piece->scale);
        }
    }
}

void kiriSolver_LimitByFriction(kiriSolver* solver, const kiriSystem* system)
{
    bool any = false;
    SumForceSlopes(solver, system);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->isCrossing = piece->isSearching && piece->solved >= EARLY && piece->slope > SLOPE * piece->promise;
        piece->low = 0.0;
        piece->high = piece->scale;
        any |= piece->isCrossing;
    }
    for (int halving = 0; any && halving < SLIDE_HALVINGS; ++halving) {
        KIRI_EACH(i, solver->awake.pieces) {
            kiriPieceStep* piece = &solver->pieces.data[i];
            piece->scale = piece->isCrossing ? 0.5 * (piece->low + piece->high) : piece->scale;
        }
        SumForceSlopes(solver, system);
        KIRI_EACH(i, solver->awake.pieces) {
            kiriPieceStep* piece = &solver->pieces.data[i];
            piece->low = piece->slope > 0.0 ? piece->low : piece->scale;
            piece->high = piece->slope > 0.0 ? piece->scale : piece->high;
        }
    }
}

/* ---- Which contacts push, and how -------------------------------------------------------------------------------- */

/* The forces after a step of which `part` was taken: those of the linear model, for their sum is what frames get,
   however far turned frames leave their tangents. */
static void TakeForces(kiriContactStep* step, double part)
{
    double push = step->isActive ? step->stiffness * (step->depth + step->sinks) : 0.0;
    kiriVec3 drag = step->isActive ? kiriContactStep_Drag(step, 1.0) : kiriVec3_Make(0.0, 0.0, 0.0);
    step->push = (1.0 - part) * step->push + part * push;
    step->drag = kiriVec3_AddScaled(kiriVec3_Scale(1.0 - part, step->drag), part, drag);
}

static void Activate(kiriContactStep* step, double friction, double inertia, double depth, kiriVec3 slide)
{
    double length = kiriVec3_Length(slide);
    step->isActive = true;
    step->limit = friction * inertia * depth;
    step->known = kiriMax(inertia * depth, step->known);
    step->sticks = inertia * length <= step->limit;
    step->direction = kiriVec3_Scale(length > KIRI_SLIDE_FLOOR ? 1.0 / length : 0.0, slide);
}

/* Slides that turned round stick: in the first systems, for later ones do not go so far (LimitByFriction). */
static bool WillStick(const kiriContactStep* step, double limit, kiriVec3 slide, bool isEarly)
{
    bool turned = !step->sticks && isEarly && kiriVec3_Dot(slide, step->direction) < 0.0;
    return turned || kiriVec3_Length(Trial(step, slide)) <= limit;
}

/* Returns whether friction is other than in the last system. */
static bool ReviewFriction(kiriContactStep* step, double limit, kiriVec3 slide, bool isEarly, double tolerance)
{
    kiriVec3 trial = Trial(step, slide), drag = step->drag;
    double size = kiriVec3_Length(trial);
    step->sticks = WillStick(step, limit, slide, isEarly);
    step->direction = kiriVec3_Scale(size > 0.0 ? -1.0 / size : 0.0, trial);
    step->limit = limit;
    kiriVec3 next = size > limit ? kiriVec3_Scale(limit / size, trial) : trial;
    return kiriVec3_Length(kiriVec3_Sub(next, drag)) > tolerance;
}

/* Chooses what the contact does in the next system, and returns whether that is other than in the last one. */
static bool Review(const kiriSolver* solver, const kiriSystem* system, int32_t k, double tolerance)
{
    kiriContactStep* step = &solver->contacts.data[k];
    const kiriContactRow* row = &system->contacts[k];
    kiriVec3 point = kiriContact_Point(solver, system, k, solver->poses.data), slide = SlideAt(step, row, point);
    double inertia = kiriContact_Inertia(solver, system, k), depth = DepthAt(step, row, point);
    if (!step->isActive) {
        if (depth > 0.0) {
            Activate(step, row->friction, inertia, depth, slide);
        }
        return depth > SINK_TOLERANCE;
    }
    double beyond = depth - step->push / step->stiffness;
    step->known = kiriMax(step->push, step->known);
    if (!(step->push + inertia * beyond > 0.0)) {
        step->isActive = false;
        return step->push < -tolerance;
    }
    return ReviewFriction(step, row->friction * kiriMax(step->push, 0.0), slide,
                          kiriContact_PieceOf(solver, system, k)->solved <= EARLY, tolerance);
}

void kiriSolver_ReviewContacts(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].mostPush = 0.0;
        solver->pieces.data[i].isUnsettled = false;
        solver->pieces.data[i].solved += solver->pieces.data[i].isIterated;
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriContact_PieceOf(solver, system, k);
        if (piece->isIterated) {
            kiriContactStep* step = &solver->contacts.data[k];
            TakeForces(step, piece->scale);
            piece->mostPush = kiriMax(step->push, piece->mostPush);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriPieceStep* piece = kiriContact_PieceOf(solver, system, k);
        if (piece->isIterated) {
            piece->isUnsettled |= Review(solver, system, k, PUSH_TOLERANCE * piece->mostPush);
        }
    }
}

/* ---- What came of it --------------------------------------------------------------------------------------------- */

/* What the contact can do of what the systems asked of it: it does not pull, nor hold by more than friction. */
static kiriVec3 WithinCone(const kiriContactStep* step, const kiriContactRow* row)
{
    if (!(step->push > 0.0)) {
        return kiriVec3_Make(0.0, 0.0, 0.0);
    }
    double most = row->friction * step->push, drag = kiriVec3_Length(step->drag);
    kiriVec3 held = drag > most ? kiriVec3_Scale(most / drag, step->drag) : step->drag;
    return kiriVec3_AddScaled(held, step->push, row->normal);
}

kiriVec3 kiriContact_Force(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    kiriVec3 force = WithinCone(&solver->contacts.data[k], &system->contacts[k]);
    return kiriVec3_Scale(kiriContact_PieceOf(solver, system, k)->keepForces, force);
}

/* Where contacts alone act, the sum of their forces is what took the piece from where free motion ends, on whatever
   path the iteration came there. */
static void SumWays(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        piece->asked = piece->isHeldUp && piece->isPushed ? kiriVec3_Make(0.0, 0.0, 0.0) : piece->asked;
    }
    KIRI_EACH(f, solver->awake.frames) {
        kiriPieceStep* piece = kiriSolver_PieceOf(solver, f);
        double part = piece->stepping.part;
        if (piece->isHeldUp && piece->isPushed) {
            kiriVec3 way = kiriVec3_Sub(solver->poses.data[f].x, solver->predictions.data[f].pose.x);
            piece->asked = kiriVec3_AddScaled(piece->asked, system->frames[f].mass / (part * part), way);
        }
    }
}

/* Pulls that are left out would make the others throw the piece up: where it ended, the sum of all is what moved it. So
   all are as much less as makes their sum fit that. */
void kiriSolver_BalanceContacts(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH(i, solver->awake.pieces) {
        solver->pieces.data[i].asked = solver->pieces.data[i].given = kiriVec3_Make(0.0, 0.0, 0.0);
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        const kiriContactStep* step = &solver->contacts.data[k];
        kiriPieceStep* piece = kiriContact_PieceOf(solver, system, k);
        piece->asked = kiriVec3_Add(piece->asked, step->drag);
        piece->asked = kiriVec3_AddScaled(piece->asked, step->push, system->contacts[k].normal);
        piece->given = kiriVec3_Add(piece->given, WithinCone(step, &system->contacts[k]));
    }
    SumWays(solver, system);
    KIRI_EACH(i, solver->awake.pieces) {
        kiriPieceStep* piece = &solver->pieces.data[i];
        double fit = kiriVec3_Dot(piece->asked, piece->given), size = kiriVec3_Dot(piece->given, piece->given);
        piece->keepForces = fit >= size ? 1.0 : fit > 0.0 ? fit / size : 0.0;
    }
}

double kiriContact_Work(const kiriSolver* solver, const kiriSystem* system, int32_t k)
{
    const kiriContactStep* step = &solver->contacts.data[k];
    kiriVec3 force = kiriContact_Force(solver, system, k), normal = system->contacts[k].normal;
    if (kiriContact_PieceOf(solver, system, k)->isHeldUp) {
        return kiriVec3_Dot(force, step->carried); /* it is moved out of obstacles, which throws nothing */
    }
    return kiriVec3_Dot(force, normal) * step->lift + kiriVec3_Dot(force, kiriVec3_AlongPlane(step->carried, normal));
}

void kiriContact_Give(const kiriSolver* solver, const kiriSystem* system, int32_t k, double times)
{
    const kiriContactRow* row = &system->contacts[k];
    if (row->yield != KIRI_NONE) {
        kiriYieldRow* yield = &system->yields[row->yield];
        kiriVec3 impulse =
            kiriVec3_Scale(kiriContact_PieceOf(solver, system, k)->stepping.part, kiriContact_Force(solver, system, k));
        kiriVec3 arm = kiriVec3_Sub(kiriContact_Point(solver, system, k, solver->poses.data), yield->center);
        kiriWrench given = { impulse, kiriVec3_Cross(arm, impulse) };
        kiriWrench_Add(&yield->impulse, -times, &given);
    }
}

/* Impulses of the step, then where it leaves the planes. */
void kiriSolver_EndContacts(kiriSolver* solver, const kiriSystem* system)
{
    if (system->contactCount > 0 && system->pinCount > 0) {
        kiriSolver_BalancePinned(solver, system);
    } else {
        for (int32_t k = 0; k < system->contactCount; ++k) {
            kiriContact_Give(solver, system, k, 1.0);
        }
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContactRow* row = &system->contacts[k];
        row->force = kiriContact_Force(solver, system, k);
        double part = kiriContact_PieceOf(solver, system, k)->stepping.part;
        row->impulse = kiriVec3_AddScaled(row->impulse, part, row->force);
    }
    for (int32_t k = 0; k < system->contactCount; ++k) {
        kiriContactRow* row = &system->contacts[k];
        kiriVec3 point = kiriContact_Point(solver, system, k, solver->poses.data);
        row->way = kiriVec3_AddScaled(row->way, solver->dt, kiriContact_PlaneVelocity(system, k, point));
    }
}
