#include "kiri_solver.h"

#define STIFFNESS 1e4       /* spring of a contact, as a multiple of its frames' mass / h'^2 */
#define GRIP 30.0           /* spring on the slide of a sticking contact, in the same unit */
#define SINKING 1e-4        /* m: limit of the depth under the known push; makes the spring stiffer if necessary */
#define MOST_SPRING 1e9     /* upper limit of the spring, in the same unit */
#define EARLY 2             /* systems */
#define PUSH_TOLERANCE 0.02 /* of the body's largest push; smaller errors of forces need no other iteration */
#define SINK_TOLERANCE 1e-5 /* m: smaller depths of new contacts need no other iteration */

/* ---- Points ------------------------------------------------------------------------------------------------------ */

kiriVec3 kiriSystem_Blend(const kiriSystem* system, const kiriContactMember* members, int32_t count,
                          const kiriPose* poses)
{
    kiriVec3 x = { 0 };
    KIRI_TIMES(m, count) {
        kiriVec3 point = kiriSystem_Point(system, members[m].frame, members[m].at, poses);
        x = kiriVec3_AddScaled(x, members[m].value, point);
    }
    return x;
}

kiriVec3 kiriContact_Point(const kiriSystem* system, const kiriContactStep* step, const kiriPose* poses)
{
    return kiriSystem_Blend(system, step->members, step->memberCount, poses);
}

static double DepthAt(const kiriContactStep* step, kiriVec3 point)
{
    return step->plane - kiriVec3_Dot(step->row->normal, kiriVec3_Sub(point, kiriRecoil_Way(step)));
}

double kiriContact_Depth(const kiriSystem* system, const kiriContactStep* step, const kiriPose* poses)
{
    return DepthAt(step, kiriContact_Point(system, step, poses));
}

static kiriVec3 SlideAt(const kiriContactStep* step, kiriVec3 point)
{
    kiriVec3 way = kiriVec3_Sub(kiriVec3_Sub(point, step->start), kiriRecoil_Way(step));
    return kiriVec3_Across(kiriVec3_Sub(way, step->carried), step->row->normal);
}

static bool IsSoft(const kiriContactRow* row)
{
    return row->reach > 0.0;
}

/* Returns the resistance of a contact's point by inertia alone, N/m. */
static double InertiaOf(const kiriSolver* solver, const kiriContactStep* step)
{
    return step->mass / (solver->stepping.part * solver->stepping.part);
}

/* ---- Obstacles that yield ---------------------------------------------------------------------------------------- */

/* Returns the velocity of the obstacle's material at its place, including impulses of sheets in this tick, m/s. */
static kiriVec3 SurfaceVelocity(const kiriContactStep* step)
{
    const kiriContactRow* row = step->row;
    const kiriYieldRow* yield = step->yield;
    kiriVec3 recoil = { 0 };
    if (yield != NULL && row->felt >= 0.0) {
        recoil = kiriVec3_Scale(row->felt, yield->impulse.force);
    } else if (yield != NULL) {
        kiriVec3 round = kiriVec3_Cross(kiriMat3_Mul(yield->inverseInertia, yield->impulse.moment), step->arm);
        recoil = kiriVec3_AddScaled(round, yield->inverseMass, yield->impulse.force);
    }
    return kiriVec3_Add(row->velocity, recoil);
}

/* Returns the inverse mass of the obstacle at its place, along a direction, 1/kg. */
static double InverseMass(const kiriContactStep* step, kiriVec3 along)
{
    const kiriYieldRow* yield = step->yield;
    if (yield == NULL || step->row->felt >= 0.0) {
        return yield == NULL ? 0.0 : step->row->felt;
    }
    kiriVec3 arm = kiriVec3_Cross(step->arm, along);
    return yield->inverseMass + kiriVec3_Dot(arm, kiriMat3_Mul(yield->inverseInertia, arm));
}

/* ---- Begin of a step --------------------------------------------------------------------------------------------- */

#define LEAST_FREE 0.5 /* of a contact's weights: minimum for frames that the host does not hold */
#define FAR_BELOW 1e9  /* m: offset of planes that nothing can touch */

/* Writes the largest weights as members, scaled to the sum 1. Those whose frames all have blocks of the matrix in common
   come first. A hard contact has these alone: one system has to solve it. A soft one has to move as the surface does, or it
   gives energy to a sheet at rest. */
static void ChooseMembers(const kiriSolver* solver, const kiriContactMember* all, int32_t count, kiriContactStep* step)
{
    double sum = 0.0;
    KIRI_ASSERT(count > 0 && all[0].value > 0.0);
    step->memberCount = count;
    KIRI_TIMES(n, step->memberCount) {
        bool isCoupled = true;
        KIRI_TIMES_WHILE(isCoupled, m, step->coupledCount) {
            kiriPair pair = { step->members[m].frame, all[n].frame };
            isCoupled = kiriMatrix_Covers(solver->matrix, pair);
        }
        int32_t place = isCoupled ? step->coupledCount++ : n;
        step->members[n] = step->members[place];
        step->members[place] = all[n];
    }
    KIRI_ASSERT(step->coupledCount > 0 && step->coupledCount <= step->memberCount);
    step->memberCount = IsSoft(step->row) ? step->memberCount : step->coupledCount;
    KIRI_TIMES(m, step->memberCount) {
        sum += step->members[m].value;
    }
    KIRI_TIMES(m, step->memberCount) {
        step->members[m].value /= sum;
    }
}

/* Finds the mass of the members, and whether the host holds too much of them: such a point goes where held frames go.
   Other frames, which hardly carry it, would have to move many times as far as it is deep, and a contact has the force
   for that. In a mutual contact both sides may be held. */
static void WeighMembers(const kiriSystem* system, kiriContactStep* step)
{
    double free = 0.0;
    KIRI_TIMES(m, step->memberCount) {
        const kiriFrameData* frame = &system->frames[step->members[m].frame];
        free += frame->held ? 0.0 : fabs(step->members[m].value);
        step->mass += step->members[m].value * frame->mass;
    }
    step->isHeld = free < LEAST_FREE;
}

/* Places the plane as at the end of the step, and finds how far the obstacle goes. A point that starts below the plane
   ends no higher than `pushSpeed` lets it. all[]: the weights of the row. `share`: of the mass of the island. */
static void PlacePlane(const kiriSolver* solver, const kiriSystem* system, const kiriContactMember* all, int32_t count,
                       double share, kiriContactStep* step)
{
    const kiriContactRow* row = step->row;
    const kiriPose* poses = solver->start.data;
    KIRI_ASSERT(share > 0.0);
    step->start = kiriContact_Point(system, step, poses);
    kiriVec3 off = kiriVec3_Sub(step->start, kiriSystem_Blend(system, all, count, poses));
    step->carried = kiriVec3_Scale(solver->dt, SurfaceVelocity(step));
    double now = row->offset + kiriVec3_Dot(row->normal, kiriVec3_Add(row->way, off));
    double depth = now - kiriVec3_Dot(row->normal, step->start), pushed = row->pushSpeed * solver->dt;
    /* A soft contact rests within its reach. A fold may lie deeper: its push may not fall with the depth. */
    pushed += row->isFold ? row->reach : kiriClamp(2.0 * row->reach - depth, 0.0, row->reach);
    step->lowered = depth > pushed ? depth - pushed : 0.0;
    /* The point may gain energy so. A small body of an island would throw the others: it gains less. A soft contact that did
       not push in the last step gains none: no step put energy into it. */
    bool isLate = IsSoft(row) && !(step->lowered > 0.0) && !(kiriVec3_Dot(row->force, row->normal) > 0.0);
    bool gains = !isLate && !kiriContact_IsMutual(step);
    double out = gains ? kiriMax(depth - step->lowered, 0.0) : 0.0;
    out = kiriMax(kiriMin(out, row->reach), share * out);
    step->out = out;
    step->plane = now + kiriVec3_Dot(row->normal, step->carried) - step->lowered - (step->isHeld ? FAR_BELOW : 0.0);
}

/* Returns true if a soft contact is with an obstacle at rest, which throws nothing. */
static bool OnlyLifts(const kiriContactStep* step)
{
    return IsSoft(step->row) && !(kiriVec3_Dot(step->carried, step->carried) > 0.0);
}

/* Returns the energy that an obstacle can supply by moving along the normal, J: its kinetic energy. One without a mass could
   supply any, and would press the sheet into any shape: it supplies what following it takes (FindMeans). A heavy ball needs
   its own energy, or it falls through a cloth that is held. */
static double MeansOf(const kiriContactStep* step, double dt)
{
    double speed = kiriVec3_Dot(step->row->normal, step->carried) / dt;
    double inverse = InverseMass(step, step->row->normal);
    return inverse > 0.0 ? 0.5 * speed * speed / inverse : 0.0;
}

/* Finds the energy available to a body in a step with contacts, J: its own, and the energy that gravity, forces and
   obstacles may add. */
static void FindMeans(kiriSolver* solver, const kiriSystem* system)
{
    kiriContactSum* touch = &solver->touch;
    double obstacleSpeed = 0.0, gravity = kiriVec3_Length(kiriSystem_Gravity(system));
    KIRI_EACH(const kiriContactStep, step, solver->contacts) {
        if (!step->isHeld) {
            double out = OnlyLifts(step) && solver->islandCount > 1 ? 0.0 : step->out;
            double lift = kiriVec3_Dot(step->row->normal, step->carried) + out;
            double fast = (kiriVec3_Length(step->carried) + fabs(lift)) / solver->dt;
            double given = MeansOf(step, solver->dt);
            obstacleSpeed = kiriMax(fast, obstacleSpeed);
            touch->means = kiriMax(given, touch->means);
            touch->isNear = true;
        }
    }
    KIRI_TIMES_WHILE(touch->isNear, f, system->frameCount) {
        const kiriFrameData* frame = &solver->before.data[f];
        double pull = gravity + kiriVec3_Length(frame->force) / frame->mass;
        double own = kiriVec3_Length(frame->velocity), speed = own + solver->dt * pull + obstacleSpeed;
        touch->means += kiriFrame_KineticEnergy(frame, kiriSystem_MaterialOf(system, f)) +
                        0.5 * frame->mass * (speed * speed - own * own);
    }
}

/* Returns the yield row of a body of the host. Sheets of an island have a row each; the first one counts. */
static kiriYieldRow* FindYield(const kiriSolver* solver, const kiriIslandBody* member, int32_t index)
{
    kiriYieldRow* own = &member->sheet->yields[index];
    KIRI_ASSERT(index >= 0 && index < member->sheet->yieldCount);
    KIRI_TIMES(n, solver->islandCount) {
        const kiriSystem* sheet = solver->islandBodies[n].sheet;
        KIRI_TIMES_WHILE(sheet != member->sheet && own->number > 0, k, sheet->yieldCount) {
            if (sheet->yields[k].number == own->number) {
                return &sheet->yields[k];
            }
        }
        if (sheet == member->sheet) {
            break;
        }
    }
    return own;
}

/* Appends the weights of a side: frames of the island. */
static int32_t AddSide(const kiriSolver* of, const kiriContactMember* weights, int32_t count, double sign,
                       kiriContactMember* all)
{
    KIRI_TIMES(n, count) {
        const kiriSolverBody* body = &of->bodies.bodies.data[of->bodies.bodyOf.data[weights[n].frame]];
        all[n].frame = body->island + of->bodies.place.data[weights[n].frame];
        all[n].value = sign * weights[n].value;
        all[n].at = weights[n].at;
    }
    return count;
}

/* Turns a mutual contact with the surface of the second point, and moves this point to where the first one is now. So a
   step has the contact as a search at its start would find it. `others`: the members of the second point. */
static void FollowSurface(const kiriSolver* solver, const kiriSystem* system, kiriContactRow* row,
                          kiriContactMember* all)
{
    kiriContactMember* others = &all[row->weightCount];
    const kiriMat3* A = &solver->start.data[others[0].frame].A;
    if (kiriMechanics_IsAffine(&system->mechanics)) {
        return; /* its axes stretch */
    }
    row->normal = kiriMat3_Mul(*A, row->otherNormal);
    kiriVec3 apart = kiriSystem_Blend(system, all, row->weightCount + row->otherCount, solver->start.data);
    kiriVec3 off = kiriVec3_Sub(kiriMat3_MulTransposed(A, apart), row->place);
    off = kiriVec3_Across(off, row->otherNormal);
    KIRI_TIMES(n, row->otherCount) {
        others[n].at = kiriVec2_Add(others[n].at, kiriVec2_Make(off.x, off.y));
        row->otherWeights[n].at = others[n].at;
    }
}

/* Prepares a contact that may push in this step. all[]: the weights of the row. */
static void PrepareContact(const kiriSolver* solver, const kiriSystem* system, const kiriContactMember* all, int32_t count,
                           double share, kiriContactStep* step)
{
    KIRI_ASSERT(count > 0 && count <= KIRI_CONTACT_MEMBERS);
    if (!kiriContact_IsMutual(step)) {
        ChooseMembers(solver, all, count, step);
    }
    WeighMembers(system, step);
    PlacePlane(solver, system, all, count, share, step);
}

#define FAR_ROUNDING 1e-9 /* relative to the distance from the origin */

/* Finds whether the contact is far at the start of the step. A contact that pushed in the last step is never far: it has forces
   to go on from. */
static void BeginFar(kiriSolver* solver, const kiriSystem* system, const kiriContactMember* all, int32_t count,
                     kiriContactStep* step)
{
    const kiriContactRow* row = step->row;
    kiriVec3 x = kiriSystem_Blend(system, all, count, solver->start.data), none = { 0.0, 0.0, 0.0 };
    memcpy(step->members, all, sizeof(kiriContactMember) * (size_t)count);
    step->memberCount = count;
    step->carried = kiriVec3_Scale(solver->dt, SurfaceVelocity(step));
    step->plane = row->offset + kiriVec3_Dot(row->normal, kiriVec3_Add(row->way, step->carried));
    step->above = -DepthAt(step, x) - FAR_ROUNDING * (1.0 + kiriVec3_Length(x));
    step->isFar = step->above > 0.0 && kiriVec3_Equal(row->force, none);
    KIRI_TIMES(m, step->memberCount) {
        kiriVec2 local = kiriVec2_Sub(step->members[m].at, system->frames[step->members[m].frame].center);
        step->lever = kiriMax(fabs(local.x) + fabs(local.y), step->lever);
    }
    solver->touch.hasFar |= step->isFar;
}

static void BeginContact(kiriSolver* solver, const kiriSystem* system, const kiriIslandBody* member, int32_t k,
                         double share)
{
    KIRI_ASSERT(solver->contacts.count < solver->contacts.capacity && k < member->sheet->contactCount);
    kiriContactStep* step = &KIRI_NEXT(solver->contacts);
    kiriContactRow* row = &member->sheet->contacts[k];
    kiriContactMember all[KIRI_CONTACT_MEMBERS];
    KIRI_CLEAR(step);
    step->row = row;
    step->yield = row->yield != KIRI_NONE ? FindYield(solver, member, row->yield) : NULL;
    step->arm = step->yield != NULL ? kiriVec3_Sub(row->place, step->yield->center) : step->arm;
    KIRI_ASSERT(row->weightCount > 0 && row->weightCount <= KIRI_CONTACT_MEMBERS);
    bool recoils = IsSoft(row) && step->yield != NULL && step->yield->inverseMass > 0.0;
    if (recoils && step->yield->place == KIRI_NONE) {
        row->reach = row->mass = 0.0; /* hard */
    }
    int32_t count = AddSide(member->solver, row->weights, row->weightCount, 1.0, all);
    if (row->other != NULL) {
        KIRI_ASSERT(row->weightCount <= KIRI_CONTACT_SIDE && row->otherCount <= KIRI_CONTACT_SIDE);
        count += AddSide(row->other, row->otherWeights, row->otherCount, -1.0, &all[count]);
        FollowSurface(solver, system, row, all);
        memcpy(step->members, all, sizeof(kiriContactMember) * (size_t)count);
        step->memberCount = step->coupledCount = count;
    } else if (IsSoft(row) && !recoils && !solver->isHeld) {
        BeginFar(solver, system, all, count, step);
    }
    if (!step->isFar) {
        PrepareContact(solver, system, all, count, share, step);
    }
    if (recoils && IsSoft(row)) {
        kiriRecoil_Join(solver, step);
    }
}

static double MassOf(const kiriSystem* system, int32_t first, int32_t count)
{
    double mass = 0.0;
    KIRI_ASSERT(first >= 0 && count > 0 && first + count <= system->frameCount);
    KIRI_FROM_TO(f, first, first + count) {
        mass += system->frames[f].mass;
    }
    return mass;
}

/* Chooses the obstacles that have unknowns. */
static void ChooseRecoils(const kiriSolver* solver)
{
    kiriYieldRow* chosen[KIRI_MOST_RECOILING];
    int32_t count = 0;
    KIRI_TIMES(n, solver->islandCount) {
        const kiriIslandBody* member = &solver->islandBodies[n];
        KIRI_TIMES(k, member->sheet->yieldCount) {
            kiriYieldRow* row = &member->sheet->yields[k];
            row->place = KIRI_NONE;
            if (row->inverseMass > 0.0) {
                kiriRecoil_Choose(FindYield(solver, member, k), chosen, &count);
            }
        }
    }
    KIRI_TIMES(n, count) {
        chosen[n]->place = 0;
    }
}

void kiriSolver_BeginContacts(kiriSolver* solver, const kiriSystem* system)
{
    double mass = MassOf(system, 0, system->frameCount);
    solver->contacts.count = solver->recoil.bodies.count = 0;
    ChooseRecoils(solver);
    KIRI_TIMES(n, solver->islandCount) {
        const kiriIslandBody* member = &solver->islandBodies[n];
        const kiriSolverBody* body = &member->solver->bodies.bodies.data[member->body];
        int32_t k = body->contact, first = body->island, count = body->frames.count;
        double share = k != KIRI_NONE ? MassOf(system, first, count) / mass : 0.0;
        for (; k != KIRI_NONE; k = member->sheet->contacts[k].next) {
            BeginContact(solver, system, member, k, share);
        }
    }
    FindMeans(solver, system);
}

/* Returns the friction if the contact stuck, N. */
static kiriVec3 Trial(const kiriContactStep* step, kiriVec3 slide)
{
    return kiriVec3_AddScaled(step->held, -step->grip, slide);
}

/* ---- Soft contacts ------------------------------------------------------------------------------------------------

   A contact with a fixed obstacle is a smooth energy of the objective. It is never switched on or off, so a sheet at
   rest does not tremble. At depth p, with softness d and stiffness k, the push is k p^2 / (2 d) up to p = d, and
   k (p - d / 2) beyond. Friction is T = held - grip slide, where `held` is the friction of the last step. T is clamped
   to the friction limit (Huber). */

#define SOFT_STIFFNESS 1e3 /* minimum, as a multiple of the mass of the sample / h'^2 */
#define FOLD_STIFFNESS 3e2  /* the same for two places of one body. It does not grow, so a fold gains no energy */
#define SOFT_SHARE 0.2     /* of the reach: d */
#define SOFT_GROWTH 30.0   /* limit of the growth of the stiffness in a step, if a point is deeper than its reach */
#define UNSETTLED 0.05    /* of the largest push: a larger pull, or a larger change of a mutual push, needs another system; */
#define EARLY_MUTUAL 3    /* a change only if fewer were solved */

/* Return the push at a depth (N), its derivative (N/m) and its integral (J). */
static double PushAt(const kiriContactStep* step, double p)
{
    double k = step->stiffness, d = step->soft;
    return p <= 0.0 ? 0.0 : p < d ? 0.5 * k * p * p / d : k * (p - 0.5 * d);
}

static double SoftSpringAt(const kiriContactStep* step, double p)
{
    return p <= 0.0 ? 0.0 : p < step->soft ? step->stiffness * p / step->soft : step->stiffness;
}

static double PushEnergy(const kiriContactStep* step, double p)
{
    double k = step->stiffness, d = step->soft;
    return p <= 0.0 ? 0.0 : p < d ? k * p * p * p / (6.0 * d) : k * (0.5 * p * (p - d) + d * d / 6.0);
}

/* Returns the depth at which the push has this size, m. */
static double DepthOfPush(const kiriContactStep* step, double push)
{
    double k = step->stiffness, d = step->soft;
    return push < 0.5 * k * d ? kiriRoot(2.0 * push * d / k) : push / k + 0.5 * d;
}

/* Sets the stiffness: half of the reach stops the motion that goes on. `depth`: its depth. Expects the push of the last step, or
   what stops that motion. Masses of both sides count: else two sides of a light obstacle store energy, and throw it. */
static void GuessSoft(const kiriSolver* solver, kiriContactStep* step, double depth)
{
    const kiriContactRow* row = step->row;
    double part = solver->stepping.part, inverse = InverseMass(step, row->normal);
    double inertia = row->mass / (part * part) / (1.0 + row->mass * inverse);
    double most = inverse > 0.0 ? SOFT_STIFFNESS / (inverse * part * part) : DBL_MAX;
    step->soft = SOFT_SHARE * row->reach;
    double least = row->isFold ? FOLD_STIFFNESS : SOFT_STIFFNESS;
    step->was = kiriVec3_Dot(row->normal, row->force);
    step->stiffness = kiriMax(2.0 * inertia * depth / row->reach, least * inertia);
    double lasting = step->body != NULL ? 2.0 * step->was / row->reach : 0.0, growth = row->isFold ? 1.0 : SOFT_GROWTH;
    step->stiffness = kiriMax(kiriMin(lasting, most), step->stiffness);
    step->mostStiffness = kiriMax(kiriMin(growth * step->stiffness, most), step->stiffness);
    step->grip = step->body != NULL ? GRIP / SOFT_STIFFNESS * step->stiffness : GRIP * inertia;
    step->known = step->was > 0.0 ? step->was : kiriMax(inertia * depth, 0.0);
    step->limit = row->friction * step->known;
}

/* Sets springs and forces for a system: the first one is tangent to the push that is expected, later ones to the push
   at the poses. A slide that turned round sticks. */
static void LinearizeSoft(kiriContactStep* step, bool isFirst)
{
    if (step->depth > step->row->reach) {
        double wanted = kiriMin(2.0 * step->push / step->row->reach, step->mostStiffness);
        step->stiffness = kiriMax(wanted, step->stiffness);
    }
    bool isGuess = isFirst && step->known > 0.0;
    double at = isGuess ? DepthOfPush(step, step->known) : step->depth;
    step->spring = SoftSpringAt(step, at);
    step->pull = PushAt(step, at) + step->spring * (step->depth - at);
    /* A single system spreads pushes unevenly: so friction is limited by the push of the last step, or, of a new contact, of
       the last system. */
    double limiting = !(step->push > 0.0) ? 0.0 : step->was > 0.0 ? step->was : step->push;
    step->limit = step->row->friction * (isGuess ? step->known : limiting);
    kiriVec3 trial = Trial(step, step->slide);
    double size = kiriVec3_Length(trial);
    bool hasTurned = !isFirst && !step->sticks && kiriVec3_Dot(trial, step->direction) > 0.0;
    step->sticks = size <= step->limit || (hasTurned && step->limit > 0.0);
    step->direction = kiriVec3_Scale(size > 0.0 ? -1.0 / size : 0.0, trial);
    step->tie = !(step->limit > 0.0) ? 0.0 : step->sticks ? step->grip : step->grip * step->limit / size;
    step->drags = step->sticks ? trial : kiriVec3_Scale(-step->limit, step->direction);
    step->isActive = step->spring > 0.0 || step->tie > 0.0;
}

static double SoftEnergy(const kiriContactStep* step, kiriVec3 point)
{
    double energy = PushEnergy(step, DepthAt(step, point)), limit = step->limit;
    if (limit > 0.0) {
        double pull = kiriVec3_Length(Trial(step, SlideAt(step, point)));
        energy += (pull <= limit ? 0.5 * pull * pull : limit * (pull - 0.5 * limit)) / step->grip;
    }
    return energy;
}

/* Takes the forces of the linear model, after `part` of the solution was taken. */
static void TakeSoft(kiriContactStep* step, kiriVec3 point, double part)
{
    bool isJoined = step->body != NULL; /* frames and obstacle get the forces of the linear model */
    double whole = 1.0 / part, sinks = isJoined ? step->sinks : whole * (DepthAt(step, point) - step->depth);
    kiriVec3 slides = isJoined ? step->slides : kiriVec3_Scale(whole, kiriVec3_Sub(SlideAt(step, point), step->slide));
    double push = step->pull + step->spring * sinks;
    slides = step->sticks ? slides : kiriVec3_Across(slides, step->direction);
    kiriVec3 drag = kiriVec3_AddScaled(step->drags, -step->tie, slides);
    step->change = part * fabs(push - step->known);
    step->known = push;
    step->push = (1.0 - part) * step->push + part * push;
    step->drag = kiriVec3_AddScaled(kiriVec3_Scale(1.0 - part, step->drag), part, drag);
}

/* Returns the point at the end of free motion: the guess of the step, or the prediction. */
static kiriVec3 FreePoint(const kiriSolver* solver, const kiriSystem* system, const kiriContactStep* step, bool isGuess)
{
    kiriVec3 x = { 0 };
    KIRI_TIMES(m, step->memberCount) {
        const kiriPrediction* prediction = &solver->predictions.data[step->members[m].frame];
        const kiriPose* pose = isGuess ? &prediction->guess : &prediction->pose;
        kiriVec3 arm = kiriSystem_Arm(system, step->members[m].frame, step->members[m].at, pose);
        x = kiriVec3_AddScaled(x, step->members[m].value, kiriVec3_Add(pose->x, arm));
    }
    return x;
}

/* Guesses the initial state. A contact that free motion runs into pushes with the force that stops the motion. A
   contact that pushed in the last step continues, unless free motion leaves it. It sticks if friction can stop its
   slide. */
static void GuessState(const kiriSolver* solver, const kiriSystem* system, kiriContactStep* step)
{
    const kiriContactRow* row = step->row;
    double inertia = InertiaOf(solver, step), was = kiriVec3_Dot(row->normal, row->force);
    double gap = kiriVec3_Dot(row->normal, FreePoint(solver, system, step, true)) - step->plane;
    step->held = kiriVec3_Across(row->force, row->normal);
    step->push = 0.0;
    step->drag = kiriVec3_Make(0.0, 0.0, 0.0);
    if (IsSoft(row)) {
        GuessSoft(solver, step, -gap);
        return;
    }
    kiriVec3 predicted = FreePoint(solver, system, step, false);
    double stop = inertia * (step->plane - kiriVec3_Dot(row->normal, predicted));
    kiriVec3 slide = kiriVec3_Sub(kiriVec3_Sub(predicted, step->start), step->carried);
    slide = kiriVec3_Across(slide, row->normal);
    step->isActive = was > 0.0 ? was + stop > 0.0 : gap < 0.0;
    double pressing = was > 0.0 ? was : kiriMax(stop, 0.0);
    step->limit = step->isActive ? row->friction * pressing : 0.0;
    double length = kiriVec3_Length(slide);
    step->sticks = inertia * length <= step->limit || kiriVec3_Length(step->held) < 0.999 * row->friction * was;
    step->direction = kiriVec3_Scale(length > KIRI_SLIDE_FLOOR ? 1.0 / length : 0.0, slide);
    step->known = kiriMax(pressing, stop);
}

void kiriSolver_GuessContacts(kiriSolver* solver, const kiriSystem* system)
{
    kiriRecoil_Begin(solver);
    kiriSolver_FindNear(solver, system, solver->poses.data);
    KIRI_EACH_NEAR(contact, solver) {
        GuessState(solver, system, contact);
    }
}

/* ---- One linear system ------------------------------------------------------------------------------------------- */

static void CountPressed(const kiriSolver* solver)
{
    KIRI_EACH(kiriContactStep, contact, solver->contacts) {
        if (contact->yield != NULL) {
            contact->yield->pressed = 0;
        }
    }
    KIRI_EACH(const kiriContactStep, step, solver->contacts) {
        if (step->isActive && step->yield != NULL) {
            step->yield->pressed += 1;
        }
    }
}

/* Sets the springs. The contact's spring is stiff enough to be invisible, in series with the inertia of the obstacle.
   Contacts that press on one obstacle each get an equal share of its mass: then no contact gives it more than its
   momentum, and together they give all of it (mass splitting; Tonge, Benevolenski, Voroshilov 2012). */
static void SetSprings(const kiriSolver* solver, kiriContactStep* step)
{
    const kiriContactRow* row = step->row;
    const kiriYieldRow* yield = step->yield;
    double inertia = InertiaOf(solver, step), part = solver->stepping.part;
    double asked = step->known / SINKING, most = MOST_SPRING * inertia;
    double spring = kiriMax(asked, STIFFNESS * inertia);
    spring = kiriMin(spring, most);
    double share = yield != NULL && yield->pressed > 1 ? yield->pressed : 1.0;
    double soft = part * part * share;
    kiriVec3 along = kiriVec3_Length(step->direction) > 0.5 ? step->direction : row->normal;
    step->give = soft * InverseMass(step, row->normal);
    step->stiffness = 1.0 / (1.0 / spring + step->give);
    step->grip = 1.0 / (1.0 / (GRIP * inertia) + soft * InverseMass(step, along));
}

void kiriSolver_PlaceContacts(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH_WHILE(!solver->touch.isPlaced, kiriContactStep, step, solver->contacts) {
        step->point = step->isFar ? step->point : kiriContact_Point(system, step, solver->poses.data);
    }
    solver->touch.isPlaced = true;
}

static void LinearizeContact(const kiriSolver* solver, kiriContactStep* step)
{
    step->depth = DepthAt(step, step->point);
    step->slide = SlideAt(step, step->point);
    if (IsSoft(step->row)) {
        double share = kiriMax(step->body != NULL ? step->yield->pressed : 0, 1), part = solver->stepping.part;
        LinearizeSoft(step, solver->search.isFirst);
        step->give = part * part * share * InverseMass(step, step->row->normal);
        return;
    }
    SetSprings(solver, step);
    step->sinks = 0.0;
    step->slides = kiriVec3_Make(0.0, 0.0, 0.0);
}

void kiriSolver_LinearizeContacts(kiriSolver* solver, const kiriSystem* system)
{
    CountPressed(solver);
    kiriSolver_PlaceContacts(solver, system);
    KIRI_EACH_NEAR(step, solver) {
        LinearizeContact(solver, step);
    }
}

/* Prepares a contact as if it had been near from the start on. It gains no energy so (PlacePlane): its share does not count. */
static void ComeNear(kiriSolver* solver, const kiriSystem* system, kiriContactStep* step)
{
    kiriContactMember all[KIRI_CONTACT_MEMBERS];
    KIRI_ASSERT(step->isFar && IsSoft(step->row) && !kiriContact_IsMutual(step));
    memcpy(all, step->members, sizeof(all));
    step->isFar = false;
    PrepareContact(solver, system, all, step->memberCount, 1.0, step);
    GuessState(solver, system, step);
    step->point = kiriContact_Point(system, step, solver->poses.data);
    LinearizeContact(solver, step);
}

void kiriSolver_FindNear(kiriSolver* solver, const kiriSystem* system, const kiriPose* poses)
{
    const kiriPose* start = solver->start.data;
    double longest = 0.0, most = 0.0, *turns = solver->turns.data; /* of all frames: squared way, turn */
    KIRI_TIMES_WHILE(solver->touch.hasFar, f, system->frameCount) {
        kiriVec3 way = kiriVec3_Sub(poses[f].x, start[f].x), u = kiriVec3_Sub(poses[f].A.u, start[f].A.u);
        kiriVec3 v = kiriVec3_Sub(poses[f].A.v, start[f].A.v);
        turns[f] = sqrt(kiriVec3_Dot(u, u) + kiriVec3_Dot(v, v));
        longest = kiriMax(kiriVec3_Dot(way, way), longest);
        most = kiriMax(turns[f], most);
    }
    KIRI_EACH_WHILE(solver->touch.hasFar, kiriContactStep, step, solver->contacts) {
        double sinks = 0.0;
        if (!step->isFar) {
            continue;
        }
        bool isSure = sqrt(longest) + step->lever * most < step->above;
        KIRI_TIMES_WHILE(!isSure, m, step->memberCount) {
            int32_t f = step->members[m].frame;
            kiriVec3 way = kiriVec3_Sub(poses[f].x, start[f].x);
            sinks += step->members[m].value * (step->lever * turns[f] - kiriVec3_Dot(step->row->normal, way));
        }
        if (!(sinks < step->above)) {
            ComeNear(solver, system, step);
        }
        KIRI_ASSERT(!step->isFar || !(kiriContact_Depth(system, step, poses) > 0.0));
    }
}

/* Returns the spring against turning the direction of a slide, N/m. */
static double TurnSpring(const kiriContactStep* step)
{
    double trial = kiriVec3_Length(Trial(step, step->slide));
    return trial > step->limit ? step->grip * step->limit / trial : step->grip;
}

/* Returns the energy of the linear model at a depth and a slide, J. */
static double EnergyAt(const kiriContactStep* step, double depth, kiriVec3 slide)
{
    double energy = 0.5 * step->stiffness * depth * depth;
    if (step->sticks) {
        return energy - kiriVec3_Dot(step->held, slide) + 0.5 * step->grip * kiriVec3_Dot(slide, slide);
    }
    kiriVec3 beside = kiriVec3_Across(slide, step->direction);
    return energy + step->limit * kiriVec3_Dot(step->direction, slide) +
           0.5 * TurnSpring(step) * kiriVec3_Dot(beside, beside);
}

double kiriContact_Energy(const kiriSolver* solver, const kiriSystem* system, kiriContactStep* step, const kiriPose* poses)
{
    if (IsSoft(step->row)) {
        bool isKnown = solver->isAlong && poses == solver->poses.data;
        step->tried = isKnown ? step->point : kiriContact_Point(system, step, poses);
        return SoftEnergy(step, step->tried);
    }
    if (!step->isActive) {
        return 0.0;
    }
    if (solver->isAlong) {
        double part = solver->search.scale;
        return EnergyAt(step, step->depth + part * step->sinks, kiriVec3_AddScaled(step->slide, part, step->slides));
    }
    kiriVec3 point = kiriContact_Point(system, step, poses);
    return EnergyAt(step, DepthAt(step, point), SlideAt(step, point));
}

/* Returns the friction of the linear model on the sheet, N. */
static kiriVec3 DragOf(const kiriContactStep* step, double part)
{
    kiriVec3 slide = kiriVec3_AddScaled(step->slide, part, step->slides);
    return step->sticks ? kiriVec3_AddScaled(step->held, -step->grip, slide)
                        : kiriVec3_AddScaled(kiriVec3_Scale(-step->limit, step->direction),
                                             -TurnSpring(step), kiriVec3_Across(slide, step->direction));
}

kiriVec3 kiriSolver_MoveOf(const kiriSolver* solver, const kiriSystem* system, const kiriContactMember* members,
                           int32_t count)
{
    kiriVec3 sum = { 0 };
    KIRI_TIMES(m, count) {
        kiriContactMember member = members[m];
        kiriVec2 local = kiriVec2_Sub(member.at, system->frames[member.frame].center);
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
    KIRI_EACH(kiriContactStep, step, solver->contacts) {
        if (step->isActive && (!IsSoft(step->row) || step->body != NULL)) {
            kiriVec3 move = kiriSolver_MoveOf(solver, system, step->members, step->memberCount);
            move = step->body != NULL ? kiriVec3_Sub(move, kiriRecoil_Move(step)) : move;
            step->sinks = -kiriVec3_Dot(step->row->normal, move);
            step->slides = kiriVec3_Across(move, step->row->normal);
        }
    }
}

/* ---- Assembly ---------------------------------------------------------------------------------------------------- */

/* Writes the derivatives of a vector's move by a member's unknowns. `local`, `arm`: the vector, in the material and now;
   `along`: the axis, times the member's weight. isPoint: it moves with the frame's x. */
static inline void DerivePoint(const kiriSolver* solver, const kiriSystem* system, kiriVec3 local, kiriVec3 arm,
                               bool isPoint, kiriVec3 along, double* J)
{
    kiriVec3 moved = isPoint ? along : kiriVec3_Make(0.0, 0.0, 0.0);
    if (solver->size == 6 && !system->mechanics.planar) { /* a row is J as it is */
        kiriVec3_StoreDoubles(J, moved);
        kiriVec3_StoreDoubles(J + 3, kiriVec3_Cross(arm, along));
    } else {
        kiriFrameRow row = { { moved, kiriVec3_Scale(local.x, along), kiriVec3_Scale(local.y, along),
                               kiriVec3_Scale(local.z, along) } };
        if (!kiriMechanics_IsAffine(&system->mechanics)) {
            row.by[1] = kiriVec3_Cross(arm, along);
        }
        kiriSolver_Reduce(solver, &row, J);
    }
}

/* Finds two axes of the plane. The first is along the slide if it slips. */
static void FindAxes(const kiriContactStep* step, kiriVec3 normal, kiriVec3 axes[2])
{
    bool slips = !step->sticks && kiriVec3_Length(step->direction) > 0.5;
    axes[1] = kiriVec3_Normalize(kiriVec3_Cross(normal, slips ? step->direction : kiriVec3_OtherAxis(normal)));
    axes[0] = kiriVec3_Cross(axes[1], normal);
}

static kiriPointSprings SpringsOf(const kiriContactStep* step, kiriVec3 normal)
{
    bool isSoft = IsSoft(step->row);
    kiriVec3 drag = isSoft ? step->drags : DragOf(step, 0.0);
    kiriPointSprings at = { .axis = { normal }, .spring = { isSoft ? step->spring : step->stiffness } };
    FindAxes(step, normal, &at.axis[1]);
    at.spring[2] = isSoft ? step->tie : step->sticks ? step->grip : TurnSpring(step);
    at.spring[1] = step->sticks ? at.spring[2] : 0.0;
    at.pull[0] = isSoft ? step->pull : step->stiffness * step->depth;
    at.pull[1] = kiriVec3_Dot(drag, at.axis[1]);
    at.pull[2] = kiriVec3_Dot(drag, at.axis[2]);
    return at;
}

void kiriSolver_AddPointSprings(kiriSolver* solver, const kiriSystem* system, const kiriContactMember* members,
                                int32_t count, const kiriVec3* ways, const kiriPointSprings* at)
{
    double J[KIRI_POINT_ROWS * KIRI_STITCH_MEMBERS * KIRI_MOST_UNKNOWNS], own[KIRI_MOST_UNKNOWNS], springs[KIRI_POINT_ROWS];
    int32_t frames[KIRI_STITCH_MEMBERS], places[KIRI_STITCH_MEMBERS], different = 0;
    bool isAgain[KIRI_STITCH_MEMBERS];
    KIRI_ASSERT(count > 0 && count <= KIRI_STITCH_MEMBERS && at->share > 0.0);
    KIRI_TIMES(m, count) { /* a frame may carry both points */
        places[m] = 0;
        while (places[m] < different && frames[places[m]] != members[m].frame) {
            places[m] += 1;
        }
        frames[places[m]] = members[m].frame;
        isAgain[m] = places[m] < different;
        different = kiriMax(places[m] + 1, different);
    }
    KIRI_TIMES(m, count) {
        const kiriPose* pose = &solver->poses.data[members[m].frame];
        const kiriFrameData* frame = &system->frames[members[m].frame];
        double weight = frame->held ? 0.0 : members[m].value;
        kiriVec2 off = kiriVec2_Sub(members[m].at, frame->center);
        kiriVec3 local = ways != NULL ? ways[m] : kiriVec3_Make(off.x, off.y, 0.0);
        kiriVec3 arm = ways != NULL ? kiriMat3_Mul(pose->A, local) : kiriPose_Along(pose, off);
        KIRI_TIMES(e, KIRI_POINT_ROWS) {
            double* to = &J[solver->size * (different * e + places[m])];
            kiriVec3 along = kiriVec3_Scale(weight, at->axis[e]);
            DerivePoint(solver, system, local, arm, ways == NULL, along, isAgain[m] ? own : to);
            KIRI_TIMES_WHILE(isAgain[m], n, solver->size) {
                to[n] += own[n];
            }
        }
    }
    KIRI_TIMES(e, KIRI_POINT_ROWS) {
        springs[e] = at->spring[e] / at->share;
    }
    kiriSolver_AddSquares(solver, frames, different, J, springs, at->pull, KIRI_POINT_ROWS);
    if (at->contact != NULL) {
        kiriRecoil_AddSprings(solver, system, frames, different, J, at);
    }
}

/* A member without a common block gets a separate spring, which its weight scales. All springs together are at least as stiff as
   the spring of the point, and exactly as stiff where all frames move alike. */
void kiriContact_Assemble(kiriSolver* solver, const kiriSystem* system, const kiriContactStep* step)
{
    if (step->isActive) {
        kiriPointSprings at = SpringsOf(step, step->row->normal);
        double share = 1.0; /* of the coupled members: the largest weight is one of them */
        at.contact = step->body != NULL ? step : NULL;
        KIRI_FROM_TO(m, step->coupledCount, step->memberCount) {
            at.share = step->members[m].value;
            share -= at.share;
            kiriSolver_AddPointSprings(solver, system, &step->members[m], 1, NULL, &at);
        }
        at.share = share;
        kiriSolver_AddPointSprings(solver, system, step->members, step->coupledCount, NULL, &at);
    }
}

/* ---- Which contacts push, and how -------------------------------------------------------------------------------- */

/* Sets the forces after taking `part` of a step. They are the forces of the linear model, because frames receive their
   sum, however far turned frames leave their tangents. */
static void TakeForces(kiriContactStep* step, double part)
{
    double push = step->isActive ? step->stiffness * (step->depth + step->sinks) : 0.0;
    kiriVec3 drag = step->isActive ? DragOf(step, 1.0) : kiriVec3_Make(0.0, 0.0, 0.0);
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

/* Returns true if the contact will stick. In the first systems, a reversed slide sticks. */
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
    return kiriVec3_Distance(next, drag) > tolerance;
}

/* Chooses the state of the contact in the next system. Returns true if the contact needs another system. */
static bool Review(const kiriSolver* solver, const kiriSystem* system, kiriContactStep* step, double mostPush)
{
    const kiriContactRow* row = step->row;
    if (IsSoft(row)) {
        bool isEarly = kiriContact_IsMutual(step) && solver->search.solved < EARLY_MUTUAL;
        return kiriMax(-step->push, isEarly ? step->change : 0.0) > UNSETTLED * mostPush;
    }
    step->point = kiriContact_Point(system, step, solver->poses.data);
    kiriVec3 slide = SlideAt(step, step->point);
    double inertia = InertiaOf(solver, step), tolerance = PUSH_TOLERANCE * mostPush, depth = DepthAt(step, step->point);
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
    return ReviewFriction(step, row->friction * kiriMax(step->push, 0.0), slide, solver->search.solved <= EARLY,
                          tolerance);
}

void kiriSolver_ReviewContacts(kiriSolver* solver, const kiriSystem* system)
{
    double mostPush = 0.0; /* N */
    KIRI_EACH_NEAR(step, solver) {
        step->point = IsSoft(step->row) && solver->search.isTaken ? step->tried : step->point;
        if (!IsSoft(step->row)) {
            TakeForces(step, solver->search.scale);
        } else if (solver->search.scale > 0.0) {
            TakeSoft(step, step->point, solver->search.scale);
        }
        mostPush = kiriMax(step->push, mostPush);
    }
    solver->touch.isUnsettled = false;
    KIRI_EACH_NEAR(contact, solver) {
        solver->touch.isUnsettled |= Review(solver, system, contact, mostPush);
    }
    solver->touch.isPlaced = true;
}

/* ---- Holding ----------------------------------------------------------------------------------------------------- */

/* Moves points out of obstacles after the last system, if the systems of a step have not settled which contacts push.
   Nothing passes through an obstacle. */

#define MOST_DEPTH 5e-3      /* m: smaller depths are left for the next step, as resting sheets need them */
#define TOLERABLE_DEPTH 1e-3 /* m: depth that holding leaves */
#define LEAST_WEIGHT 0.05    /* minimum weight of a frame that is held */
#define SWEEPS 12            /* over all contacts */

/* Returns how far the obstacle is pushed down, m. */
static double Yielded(const kiriContactStep* step)
{
    double push = step->body != NULL ? step->push - kiriMax(step->solved, 0.0) : step->push; /* the poses have the rest */
    return step->push > 0.0 ? kiriMax(push, 0.0) * step->give : 0.0;
}

/* Returns true if a point of the body is too deep. Stores the pushes of the systems in `solved`. */
static bool IsDeep(kiriSolver* solver)
{
    bool isDeep = false;
    KIRI_EACH_NEAR(step, solver) {
        step->solved = step->push;
        double depth = DepthAt(step, step->point) - Yielded(step);
        isDeep |= !kiriContact_IsMutual(step) && depth > MOST_DEPTH + step->row->reach;
    }
    return isDeep;
}

/* Pushes a frame until the point, as it carries it, is on the plane. The frame moves without turning, so depths change
   as expected, however far it has turned. Each frame is pushed by itself, not only their blend. This keeps frames, and
   the material between the points, from passing each other on their way to the plane. */
static bool HoldMember(kiriSolver* solver, const kiriSystem* system, kiriContactStep* step, const kiriContactMember* member)
{
    int32_t f = member->frame;
    kiriVec3 normal = step->row->normal;
    kiriVec3 along = system->mechanics.planar ? kiriMechanics_InPlane(&system->mechanics, normal) : normal;
    kiriVec3 way = kiriVec3_Sub(kiriSystem_Point(system, f, member->at, solver->poses.data),
                                kiriSystem_Point(system, f, member->at, solver->start.data));
    double depth = DepthAt(step, kiriVec3_Add(step->start, way)) - Yielded(step);
    double part = solver->stepping.part, share = kiriVec3_Dot(along, along);
    if (system->frames[f].held || !(depth > TOLERABLE_DEPTH) || !(share > 0.0)) {
        return false;
    }
    double inertia = system->frames[f].mass / (part * part), push = depth / (share / inertia + step->give);
    step->push += push;
    solver->poses.data[f].x = kiriVec3_AddScaled(solver->poses.data[f].x, push / inertia, along);
    return true;
}

static bool HoldFrames(kiriSolver* solver, const kiriSystem* system, kiriContactStep* step)
{
    bool any = false;
    KIRI_TIMES(m, step->memberCount) {
        any |= step->members[m].value > LEAST_WEIGHT && HoldMember(solver, system, step, &step->members[m]);
    }
    return any;
}

/* Keeps the poses after the systems if the body stores more energy than allowed in the held ones. */
void kiriSolver_HoldContacts(kiriSolver* solver, const kiriSystem* system)
{
    bool isLeft = true;
    if (!IsDeep(solver)) {
        return;
    }
    KIRI_EACH_WHILE(solver->touch.hasFar, kiriContactStep, step, solver->contacts) {
        if (step->isFar) {
            ComeNear(solver, system, step); /* frames are held by themselves, and the point of one may be deep */
        }
    }
    solver->touch.isPlaced = false;
    memcpy(solver->trial.data, solver->poses.data, sizeof(kiriPose) * (size_t)system->frameCount);
    KIRI_TIMES_WHILE(isLeft, sweep, SWEEPS) {
        isLeft = false;
        KIRI_EACH(kiriContactStep, step, solver->contacts) {
            isLeft |= !kiriContact_IsMutual(step) && HoldFrames(solver, system, step);
        }
    }
    kiriStepEnergy energy = kiriObjective_Evaluate(solver, system, solver->poses.data);
    double most = kiriMax(solver->search.start.potential + solver->touch.means, solver->search.now.potential);
    solver->touch.isHeldUp = energy.potential <= most;
    if (solver->touch.isHeldUp) {
        solver->search.now = energy;
    } else {
        memcpy(solver->poses.data, solver->trial.data, sizeof(kiriPose) * (size_t)system->frameCount);
        KIRI_EACH(kiriContactStep, contact, solver->contacts) {
            contact->push = contact->solved;
        }
    }
    kiriSolver_FindGains(solver, system);
}

/* ---- Results ----------------------------------------------------------------------------------------------------- */

/* Returns the force of the systems, clamped to the friction cone: no pull, and no friction beyond the limit. */
static kiriVec3 WithinCone(const kiriContactStep* step)
{
    if (!(step->push > 0.0)) {
        return kiriVec3_Make(0.0, 0.0, 0.0);
    }
    double most = step->row->friction * step->push, drag = kiriVec3_Length(step->drag);
    kiriVec3 held = drag > most ? kiriVec3_Scale(most / drag, step->drag) : step->drag;
    return kiriVec3_AddScaled(held, step->push, step->row->normal);
}

kiriVec3 kiriContact_Force(const kiriSolver* solver, const kiriContactStep* step)
{
    /* a soft contact may still pull slightly; the others then push by as much more */
    kiriVec3 given = IsSoft(step->row) ? kiriVec3_AddScaled(step->drag, step->push, step->row->normal) : WithinCone(step);
    return kiriVec3_Scale(solver->touch.keepForces, given);
}

double kiriContact_Work(const kiriSolver* solver, const kiriContactStep* step, double* lifting)
{
    kiriVec3 force = kiriContact_Force(solver, step);
    double work = kiriVec3_Dot(force, kiriVec3_Add(step->carried, kiriRecoil_Way(step)));
    if (!solver->touch.isHeldUp) { /* else it is moved out of obstacles, which throws nothing */
        *(OnlyLifts(step) ? lifting : &work) += kiriVec3_Dot(force, step->row->normal) * step->out;
    }
    return work;
}

/* Gives the yield row `times` the impulse of the contact in the step. */
static void Give(const kiriSolver* solver, const kiriContactStep* step, double times)
{
    if (step->yield != NULL) {
        kiriVec3 impulse = kiriVec3_Scale(solver->stepping.part, kiriContact_Force(solver, step));
        kiriWrench given = { impulse, kiriVec3_Cross(step->arm, impulse) };
        kiriWrench_Add(&step->yield->impulse, -times, &given);
    }
}

/* ---- Pinned bodies ----------------------------------------------------------------------------------------------- */

#define ONE_SIDED 0.5  /* of the sum of push magnitudes: if the vector sum is smaller, contacts oppose each other */
#define MOST_MORE 30.0 /* upper limit of Pinned.more */

/* A body with pins. Sums are N s. */
typedef struct Pinned {
    bool isPinned;         /* only pins, contacts, gravity and forces act */
    kiriVec3 asked, given; /* impulse of contacts: from momentum and pins; from the contacts themselves */
    double pressed;        /* sum of the magnitudes of contact impulses */
    double more;           /* ratio of the true impulse of contacts to `given`; 1 if unknown */
} Pinned;

static Pinned SumPinned(const kiriSolver* solver, const kiriSystem* system)
{
    double part = solver->stepping.part;
    Pinned sum = { .isPinned = !kiriSystem_HasWind(system) && system->clampCount == 0 && !solver->isHeld, .more = 1.0 };
    KIRI_TIMES(f, system->frameCount) {
        sum.asked = kiriVec3_Add(sum.asked, kiriSolver_GainOf(solver, system, f));
    }
    KIRI_TIMES(k, system->pinCount) {
        const kiriPinRow* pin = &system->pins[k];
        kiriVec3 off = kiriVec3_Sub(kiriSystem_Point(system, pin->frame, pin->at, solver->poses.data), pin->target);
        sum.asked = kiriVec3_AddScaled(sum.asked, part * pin->stiffness, off);
    }
    KIRI_EACH(kiriContactStep, contact, solver->contacts) {
        if (kiriContact_IsMutual(contact)) {
            continue;
        }
        kiriVec3 impulse = kiriVec3_Scale(part, kiriContact_Force(solver, contact));
        sum.given = kiriVec3_Add(sum.given, impulse);
        sum.pressed += kiriVec3_Length(impulse);
    }
    return sum;
}

/* Sets `more`. After few systems, a pinned sheet hit by something heavy is stretched more than in the linear model of
   its contacts. The true impulse of contacts is the change of momentum minus the impulse of the pins. It is unknown if
   contacts press from two sides. */
static void FindMore(kiriSolver* solver, Pinned* sum)
{
    double fit = kiriVec3_Dot(sum->asked, sum->given), size = kiriVec3_Dot(sum->given, sum->given);
    bool isClear = size > ONE_SIDED * ONE_SIDED * sum->pressed * sum->pressed;
    if (sum->isPinned && isClear && fit > 0.0) {
        double more = kiriMin(fit / size, MOST_MORE);
        solver->touch.keepForces *= kiriMin(more, 1.0);
        sum->given = kiriVec3_Scale(kiriMin(more, 1.0), sum->given);
        sum->more = kiriMax(1.0, more);
    }
}

/* Computes the push on the obstacle times the obstacle's, and times the sheet's, speed along it, N s m/s. */
static void FindPower(const kiriSolver* solver, const kiriContactStep* step, double* ofObstacle, double* ofSheet)
{
    kiriVec3 push = kiriVec3_Scale(-solver->stepping.part, kiriContact_Force(solver, step)), way = { 0 };
    KIRI_TIMES(m, step->memberCount) {
        kiriVec3 velocity = kiriFrame_VelocityAt(&solver->after.data[step->members[m].frame], step->members[m].at);
        way = kiriVec3_AddScaled(way, step->members[m].value, velocity);
    }
    *ofObstacle = kiriVec3_Dot(push, SurfaceVelocity(step));
    *ofSheet = kiriVec3_Dot(push, way);
}

/* Gives obstacles the impulses of contacts. If isMore, sums the power of the pushes before and after that. */
static void GivePushes(const kiriSolver* solver, bool isMore)
{
    double ofObstacle, ofSheet;
    KIRI_EACH(kiriContactStep, contact, solver->contacts) {
        kiriYieldRow* yield = contact->yield;
        if (yield != NULL) {
            yield->before = yield->after = yield->most = 0.0;
        }
    }
    KIRI_EACH_WHILE(isMore, const kiriContactStep, step, solver->contacts) {
        kiriYieldRow* yield = step->yield;
        if (yield != NULL) {
            FindPower(solver, step, &ofObstacle, &ofSheet);
            yield->before += ofObstacle;
            yield->most += kiriMax(ofSheet, 0.0);
        }
    }
    KIRI_EACH_NEAR(contact, solver) {
        Give(solver, contact, 1.0);
    }
    KIRI_EACH_WHILE(isMore, const kiriContactStep, step, solver->contacts) {
        kiriYieldRow* yield = step->yield;
        if (yield != NULL) {
            FindPower(solver, step, &ofObstacle, &ofSheet);
            yield->after += ofObstacle;
        }
    }
}

/* Limits the ratio `more`: the additional impulse may stop an obstacle, or accelerate it to the speed of the sheet, but
   no further, and gives it no more energy than the sheet lost in the step. The momentum of a cloth can be thousands of
   times the momentum of a light body on it. */
static double LimitMore(const kiriSolver* solver, double more)
{
    KIRI_EACH_WHILE(more > 1.0, kiriContactStep, contact, solver->contacts) {
        const kiriYieldRow* yield = contact->yield;
        if (yield != NULL) {
            double each = yield->after - yield->before, room = yield->most - yield->before;
            double most = room > each ? room / each : 1.0;
            more = each > 0.0 && more > most ? most : more;
            double gives = yield->after * yield->after + 2.0 * each * kiriMax(-solver->energy.gain, 0.0);
            most = each > 0.0 && contact->body != NULL ? 1.0 + (kiriRoot(gives) - yield->after) / each : more;
            more = kiriMax(kiriMin(most, more), 1.0);
        }
    }
    return more;
}

/* Returns the ratio, `more` or another one, with which obstacles pay for the energy that a pinned body owes, as far as
   they can. Times r, the pushes give obstacles r before + r^2 each / 2. The sheet gets -r (before + r each): obstacles move
   with their velocity at the end of the step. */
static double Pay(const kiriSolver* solver, double more)
{
    double before = 0.0, after = 0.0, owed = solver->energy.owed;
    KIRI_EACH_WHILE(owed > 0.0, const kiriContactStep, contact, solver->contacts) {
        if (contact->yield != NULL && contact->yield->inverseMass > 0.0) {
            before += contact->yield->before;
            after += contact->yield->after;
            contact->yield->before = contact->yield->after = 0.0;
        } else if (!contact->isFar) {
            return more; /* who owes it is unknown */
        }
    }
    KIRI_ASSERT(owed >= 0.0);
    double each = after - before, square = before * before;
    if (!(each > 0.0)) {
        return more;
    }
    double root = kiriRoot(kiriMax(square + 4.0 * each * (after - owed), 0.0));
    if (before + 2.0 * each >= 0.0) {
        return kiriMax((root - before) / (2.0 * each), 0.0);
    }
    double rest = kiriRoot(kiriMax(square + 2.0 * each * (after - owed), 0.0));
    return kiriMax(kiriMax((-before - root) / (2.0 * each), (-before - rest) / each), more);
}

/* Gives yield rows the impulses of contacts in the step. For a pinned body these follow from its momentum and its pins,
   as far as obstacles can receive them. Then writes impulses, and displacements of the planes. */
void kiriSolver_EndContacts(kiriSolver* solver, const kiriSystem* system)
{
    Pinned sum = { .more = 1.0 };
    if (solver->contacts.count > 0 && system->pinCount > 0) {
        sum = SumPinned(solver, system);
        FindMore(solver, &sum);
    }
    GivePushes(solver, sum.more > 1.0 || solver->energy.owed > 0.0);
    sum.more = LimitMore(solver, sum.more);
    double given = Pay(solver, sum.more), known = solver->touch.keepForces * sum.more;
    KIRI_EACH_WHILE(given != 1.0, kiriContactStep, contact, solver->contacts) {
        Give(solver, contact, given - 1.0);
    }
    solver->touch.keepForces *= given;
    KIRI_EACH(const kiriContactStep, step, solver->contacts) {
        kiriContactRow* row = step->row;
        if (!step->isFar) {
            row->impulse = kiriVec3_AddScaled(row->impulse, solver->stepping.part, kiriContact_Force(solver, step));
            row->force = kiriVec3_Scale(known, WithinCone(step));
        }
        row->way = kiriVec3_AddScaled(row->way, solver->dt, SurfaceVelocity(step));
    }
}

/* ---- Stitches --------------------------------------------------------------------------------------------------- */

static int32_t CountOf(const kiriStitchRow* row)
{
    KIRI_ASSERT(row->counts[0] >= 0 && row->counts[1] >= 0 && row->counts[0] + row->counts[1] <= KIRI_STITCH_MEMBERS);
    return row->counts[0] + row->counts[1];
}

/* Returns the force of the stitch on its first point at these poses, N. */
static kiriVec3 StitchForce(const kiriSystem* system, const kiriStitchRow* row, const kiriPose* poses)
{
    kiriVec3 apart = kiriVec3_Sub(kiriSystem_Blend(system, row->members, CountOf(row), poses), row->off);
    return kiriVec3_Scale(-row->stiffness, apart);
}

/* Returns the vector of a member's material as its frame carries it. */
static kiriVec3 MemberWay(const kiriStitchRow* row, int32_t member, const kiriPose* poses)
{
    return kiriMat3_Mul(poses[row->members[member].frame].A, row->ways[member >= row->counts[0]]);
}

/* Returns the pull of the hinge's spring on the blend of the vectors, N m. */
static kiriVec3 PullOf(const kiriStitchRow* row, const kiriPose* poses)
{
    kiriVec3 apart = { 0.0, 0.0, 0.0 };
    KIRI_TIMES(m, CountOf(row)) {
        apart = kiriVec3_AddScaled(apart, row->members[m].value, MemberWay(row, m, poses));
    }
    return kiriVec3_Scale(-row->bending, apart);
}

kiriVec3 kiriStitch_Moment(const kiriStitchRow* row, int32_t member, const kiriPose* poses)
{
    KIRI_ASSERT(member < CountOf(row));
    kiriVec3 pull = kiriVec3_Scale(row->members[member].value, PullOf(row, poses));
    return kiriVec3_Cross(MemberWay(row, member, poses), pull);
}

double kiriStitches_Energy(const kiriSystem* system, const kiriPose* poses)
{
    double sum = 0.0;
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 force = StitchForce(system, row, poses);
        sum += 0.5 * kiriVec3_Dot(force, force) / row->stiffness;
        if (row->bending > 0.0) {
            kiriVec3 pull = PullOf(row, poses);
            sum += 0.5 * kiriVec3_Dot(pull, pull) / row->bending;
        }
    }
    return sum;
}

/* Returns the energy if lengths are wrong by their last bits, relative to the square of this error. */
double kiriStitches_Noise(const kiriSolver* solver, const kiriSystem* system)
{
    double sum = 0.0;
    KIRI_EACH_STITCH(row, system) {
        KIRI_ASSERT(CountOf(row) > 0 && row->members[0].frame < system->frameCount);
        kiriVec3 x = solver->start.data[row->members[0].frame].x;
        sum += row->stiffness * kiriVec3_Dot(x, x) + row->bending;
    }
    return sum;
}

static void AddSprings(kiriSolver* solver, const kiriSystem* system, const kiriStitchRow* row, const kiriVec3* ways,
                       double k, kiriVec3 pull)
{
    kiriPointSprings at = { .axis = KIRI_AXES, .share = 1.0, .spring = { k, k, k }, .pull = { pull.x, pull.y, pull.z } };
    kiriSolver_AddPointSprings(solver, system, row->members, CountOf(row), ways, &at);
}

void kiriStitches_Assemble(kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 ways[KIRI_STITCH_MEMBERS];
        AddSprings(solver, system, row, NULL, row->stiffness, StitchForce(system, row, solver->poses.data));
        if (row->bending > 0.0) {
            KIRI_TIMES(m, CountOf(row)) {
                ways[m] = row->ways[m >= row->counts[0]];
            }
            AddSprings(solver, system, row, ways, row->bending, PullOf(row, solver->poses.data));
        }
    }
}

void kiriStitches_Solve(const kiriSolver* solver, const kiriSystem* system)
{
    KIRI_EACH_STITCH(row, system) {
        kiriVec3 move = kiriSolver_MoveOf(solver, system, row->members, CountOf(row));
        row->solved = StitchForce(system, row, solver->poses.data);
        row->solved = kiriVec3_AddScaled(row->solved, -row->stiffness, move);
    }
}

void kiriStitches_TakeForces(const kiriSolver* solver, const kiriSystem* system)
{
    double part = solver->search.scale;
    KIRI_EACH_STITCH(row, system) {
        row->force = kiriVec3_AddScaled(kiriVec3_Scale(1.0 - part, row->force), part, row->solved);
    }
}
