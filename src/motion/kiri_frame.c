#include "kiri_frame.h"

#include <float.h>

#define MOST_GROWTH 2.0 /* of a step over the one before: BDF2 is stable up to 1 + sqrt 2 */

kiriStepping kiriStepping_Euler(double h)
{
    kiriStepping euler = { h, h, 0.0, 0.0, 0.0, 0.0, true, true };
    return euler;
}

kiriStepping kiriStepping_After(const kiriHistory* history, double h)
{
    KIRI_ASSERT(history->dt > 0.0);
    double r = h / history->dt;
    if (history->isHalf && r <= MOST_GROWTH) {
        double c = r * r / (1.0 + 2.0 * r);
        kiriStepping bdf2 = { h, h * (1.0 + r) / (1.0 + 2.0 * r), c, 0.0, c, r * r, false, false };
        return bdf2;
    }
    kiriStepping trapezoid = { h, 0.5 * h, 0.0, 0.5 * h, 0.0, r * r, false, true };
    return trapezoid;
}

kiriVec3 kiriStepping_Inner(const kiriStepping* stepping, const kiriHistory* history)
{
    return kiriVec3_AddScaled(kiriVec3_Scale(stepping->c, history->gain), stepping->l, history->pull);
}

kiriMat3 kiriStepping_InnerTurn(const kiriStepping* stepping, const kiriHistory* history)
{
    kiriMat3 carried = kiriMat3_Scale(stepping->c, &history->turnGain);
    return kiriMat3_AddScaled(&carried, stepping->l, &history->turnPull);
}

static void FindMassCenters(const kiriFrameData* before, const kiriFrameData* after, int32_t count,
                            kiriPieceMomentum* p)
{
    KIRI_TIMES(f, count) {
        double m = before[f].held ? 0.0 : before[f].mass;
        p->mass += m;
        p->centerBefore = kiriVec3_AddScaled(p->centerBefore, m, before[f].x);
        p->velocityBefore = kiriVec3_AddScaled(p->velocityBefore, m, before[f].velocity);
        p->centerAfter = kiriVec3_AddScaled(p->centerAfter, m, after[f].x);
        p->velocityAfter = kiriVec3_AddScaled(p->velocityAfter, m, after[f].velocity);
    }
    double share = 1.0 / kiriMax(p->mass, DBL_MIN);
    p->centerBefore = kiriVec3_Scale(share, p->centerBefore);
    p->velocityBefore = kiriVec3_Scale(share, p->velocityBefore);
    p->centerAfter = kiriVec3_Scale(share, p->centerAfter);
    p->velocityAfter = kiriVec3_Scale(share, p->velocityAfter);
}

/* Returns the angular momentum of a frame about a moving centre. Counts the true rate of A, by which affine frames also
   stretch. */
static kiriVec3 AngularAbout(const kiriFrameData* frame, const kiriMaterial* material, kiriVec3 center,
                             kiriVec3 velocity)
{
    kiriVec3 r = kiriVec3_Sub(frame->x, center), v = kiriVec3_Sub(frame->velocity, velocity);
    return kiriVec3_AddScaled(kiriFrame_AngularMomentum(frame, material), frame->mass, kiriVec3_Cross(r, v));
}

/* Adds the torque of a frame's forces, with their mean arms over the step. */
static void AddFrameTurning(kiriPieceMomentum* p, const kiriFrameData* before, const kiriFrameData* after,
                            const kiriMaterial* material, kiriVec3 gravity, double dt)
{
    kiriVec3 arm = kiriVec3_Sub(after->x, p->centerAfter);
    kiriVec3 arms = kiriVec3_Add(kiriVec3_Sub(before->x, p->centerBefore), arm);
    kiriVec3 torque = kiriVec3_AddScaled(before->torque, 0.5, kiriVec3_Cross(arms, before->force));
    kiriMat3 own = kiriFrame_Inertia(after, material), point = kiriMat3_PointInertia(before->mass, arm);
    p->due = kiriVec3_Add(p->due, AngularAbout(before, material, p->centerBefore, p->velocityBefore));
    p->due = kiriVec3_AddScaled(p->due, dt, torque);
    kiriVec3 push = kiriVec3_AddScaled(before->force, before->mass, gravity);
    p->dueLinear = kiriVec3_AddScaled(p->dueLinear, before->mass, before->velocity);
    p->dueLinear = kiriVec3_AddScaled(p->dueLinear, dt, push);
    p->angular = kiriVec3_Add(p->angular, AngularAbout(after, material, p->centerAfter, p->velocityAfter));
    p->inertia = kiriMat3_AddScaled(&p->inertia, 1.0, &own);
    p->inertia = kiriMat3_AddScaled(&p->inertia, 1.0, &point);
}

/* Finds the velocities that correct the momenta. Steps conserve the linear momentum exactly, except for the residual of
   the iteration and for pushes that were clamped to the limits of contacts. */
static void FindMissing(kiriPieceMomentum* p, const kiriVec3* normal)
{
    kiriVec3 arm = kiriVec3_Scale(-1.0, p->centerAfter);
    p->due = kiriVec3_Add(p->due, kiriVec3_Add(p->pushed.moment, kiriVec3_Cross(arm, p->pushed.force)));
    if (p->isPushed) {
        p->dueLinear = kiriVec3_Add(p->dueLinear, p->pushed.force);
        kiriVec3 velocity = kiriVec3_Scale(1.0 / p->mass, p->dueLinear);
        p->move = kiriVec3_Sub(velocity, p->velocityAfter);
        p->velocityAfter = velocity;
    }
    kiriVec3 missing = kiriVec3_Sub(p->due, p->angular);
    if (normal != NULL) {
        missing = kiriVec3_Scale(kiriVec3_Dot(missing, *normal), *normal);
    }
    if (p->isFree || p->isPushed) {
        p->angular = kiriVec3_Add(p->angular, missing);
        p->turn = kiriMat3_Solve(&p->inertia, missing);
    }
    p->spin = kiriMat3_Solve(&p->inertia, p->angular);
}

void kiriMomentum_Restore(const kiriFrameData* before, kiriFrameData* after, int32_t count, kiriPieceMomentum* p,
                          const kiriMaterial* const* materials, kiriVec3 gravity, double dt, const kiriVec3* normal)
{
    FindMassCenters(before, after, count, p);
    KIRI_TIMES(f, count) {
        if (!before[f].held) {
            AddFrameTurning(p, &before[f], &after[f], materials[f], gravity, dt);
        }
    }
    if (p->mass > 0.0) {
        FindMissing(p, normal);
    }
    KIRI_TIMES_WHILE(p->isFree || p->isPushed, f, count) {
        kiriVec3 arm = kiriVec3_Sub(after[f].x, p->centerAfter);
        after[f].velocity = kiriVec3_Add(after[f].velocity, kiriVec3_Add(p->move, kiriVec3_Cross(p->turn, arm)));
        after[f].spin = kiriVec3_Add(after[f].spin, p->turn);
    }
}

#define LONGEST_PART_TURN 1.0 /* of one part of a step: a Cayley vector */
#define MOST_PARTS 8          /* of a step */

static const kiriMat3 IdentityAxes = KIRI_AXES;

kiriVec3 kiriMat3_Solve(const kiriMat3* m, kiriVec3 a)
{
    kiriMat3 cofactors = { kiriVec3_Cross(m->v, m->d), kiriVec3_Cross(m->d, m->u), kiriVec3_Cross(m->u, m->v) };
    return kiriVec3_Scale(1.0 / kiriVec3_Dot(m->u, cofactors.u), kiriMat3_MulTransposed(&cofactors, a));
}

kiriMat3 kiriMat3_PointInertia(double m, kiriVec3 r)
{
    double rr = m * kiriVec3_Dot(r, r);
    kiriMat3 j = { kiriVec3_AddScaled(kiriVec3_Make(rr, 0.0, 0.0), -m * r.x, r),
                   kiriVec3_AddScaled(kiriVec3_Make(0.0, rr, 0.0), -m * r.y, r),
                   kiriVec3_AddScaled(kiriVec3_Make(0.0, 0.0, rr), -m * r.z, r) };
    return j;
}

kiriMassMoments kiriFrame_MassMoments(const kiriFrameData* frame, const kiriMaterial* material)
{
    double thickness = material->thickness;
    double least = frame->mass * thickness * thickness / 12.0;
    kiriMassMoments m = { frame->inertia[0] + least, frame->inertia[1], frame->inertia[2] + least, least };
    return m;
}

/* Returns A times the matrix of moments. */
static kiriMat3 Weighted(const kiriMassMoments* m, const kiriMat3* A)
{
    kiriMat3 r = { kiriVec3_AddScaled(kiriVec3_Scale(m->uu, A->u), m->uv, A->v),
                   kiriVec3_AddScaled(kiriVec3_Scale(m->vv, A->v), m->uv, A->u), kiriVec3_Scale(m->dd, A->d) };
    return r;
}

/* Returns trace(M) - A M A^T, with M the moments. */
static kiriMat3 InertiaAbout(const kiriMassMoments* m, double trace, const kiriMat3* A)
{
    kiriMat3 w = Weighted(m, A), r;
    r.u = kiriVec3_Sub(kiriVec3_Make(trace, 0.0, 0.0), kiriMat3_Mul(w, kiriVec3_Make(A->u.x, A->v.x, A->d.x)));
    r.v = kiriVec3_Sub(kiriVec3_Make(0.0, trace, 0.0), kiriMat3_Mul(w, kiriVec3_Make(A->u.y, A->v.y, A->d.y)));
    r.d = kiriVec3_Sub(kiriVec3_Make(0.0, 0.0, trace), kiriMat3_Mul(w, kiriVec3_Make(A->u.z, A->v.z, A->d.z)));
    return r;
}

static double SumDot(const kiriMat3* A, const kiriMat3* B)
{
    return kiriVec3_Dot(A->u, B->u) + kiriVec3_Dot(A->v, B->v) + kiriVec3_Dot(A->d, B->d);
}

static kiriVec3 SumCross(const kiriMat3* A, const kiriMat3* B)
{
    return kiriVec3_Add(kiriVec3_Add(kiriVec3_Cross(A->u, B->u), kiriVec3_Cross(A->v, B->v)),
                        kiriVec3_Cross(A->d, B->d));
}

static kiriMat3 CrossColumns(kiriVec3 w, const kiriMat3* A)
{
    kiriMat3 r = { kiriVec3_Cross(w, A->u), kiriVec3_Cross(w, A->v), kiriVec3_Cross(w, A->d) };
    return r;
}

kiriMat3 kiriPrediction_Gradient(const kiriPrediction* prediction, const kiriMat3* A)
{
    kiriMat3 off = kiriMat3_AddScaled(A, -1.0, &prediction->target);
    return Weighted(&prediction->moments, &off);
}

kiriMat3 kiriPrediction_Inertia(const kiriPrediction* prediction, const kiriMat3* A)
{
    const kiriMassMoments* m = &prediction->moments;
    return InertiaAbout(m, m->uu + m->vv + m->dd, A);
}

kiriVec3 kiriFrame_AngularMomentum(const kiriFrameData* frame, const kiriMaterial* material)
{
    kiriMassMoments moments = kiriFrame_MassMoments(frame, material);
    kiriMat3 weighted = Weighted(&moments, &frame->A), rate = kiriFrame_Rate(frame);
    return SumCross(&weighted, &rate);
}

double kiriFrame_KineticEnergy(const kiriFrameData* frame, const kiriMaterial* material)
{
    kiriMassMoments moments = kiriFrame_MassMoments(frame, material);
    kiriMat3 rate = kiriFrame_Rate(frame), weighted = Weighted(&moments, &rate);
    return 0.5 * frame->mass * kiriVec3_Dot(frame->velocity, frame->velocity) + 0.5 * SumDot(&weighted, &rate);
}

double kiriMat3_TurnSquared(const kiriMassMoments* moments, const kiriMat3* from, const kiriMat3* A)
{
    kiriMat3 off = kiriMat3_AddScaled(A, -1.0, from), w = Weighted(moments, &off);
    return SumDot(&w, &off);
}

kiriVec3 kiriPrediction_TurnGradient(const kiriPrediction* prediction, const kiriMat3* A, const kiriMat3* target)
{
    kiriMat3 w = Weighted(&prediction->moments, target);
    return SumCross(&w, A);
}

static kiriVec3 Shortened(kiriVec3 turn)
{
    double length = kiriVec3_Length(turn);
    return length > LONGEST_PART_TURN ? kiriVec3_Scale(LONGEST_PART_TURN / length, turn) : turn;
}

/* Rotates freely over h with the angular momentum L, in parts, by the implicit midpoint rule for L in the body's axes, which
   Newton's method solves: a simple iteration diverges for slender frames. The map is a Cayley rotation. It conserves L and the
   energy for any length of the Cayley vector. */
static kiriMat3 TurnFreely(const kiriMat3* A, const kiriMat3* bodyInertia, kiriVec3 L, double angle, double h)
{
    const kiriMat3* e = &IdentityAxes;
    const kiriMat3 by = { kiriMat3_Solve(bodyInertia, e->u), kiriMat3_Solve(bodyInertia, e->v), kiriMat3_Solve(bodyInertia, e->d) };
    int parts = angle < 2.0 ? 1 + (int)(4.0 * angle) : MOST_PARTS;
    kiriMat3 turned = *A;
    h = kiriMin(h / parts, h * LONGEST_PART_TURN / kiriMax(angle, LONGEST_PART_TURN));
    KIRI_TIMES(part, parts) {
        kiriVec3 start = kiriMat3_MulTransposed(&turned, L), middle = start, w = start;
        double scale = 1.0;
        KIRI_TIMES(iteration, 30) {
            w = kiriMat3_Mul(by, kiriVec3_Scale(h, middle)); /* the Cayley vector of |w| about it, to the sixth order: */
            scale = 1.0 + kiriVec3_Dot(w, w) * (1.0 / 12.0 + kiriVec3_Dot(w, w) / 120.0);
            kiriVec3 half = kiriVec3_Scale(0.5 * scale, w), reach = kiriVec3_Scale(0.5 * scale * h, middle);
            kiriVec3 off = kiriVec3_Add(kiriVec3_Sub(start, middle), kiriVec3_Cross(middle, half));
            kiriMat3 slope = CrossColumns(half, e), more = CrossColumns(reach, &by);
            slope = kiriMat3_AddScaled(&slope, -1.0, &more);
            slope = kiriMat3_AddScaled(e, 1.0, &slope);
            kiriVec3 change = kiriMat3_Solve(&slope, off);
            middle = kiriVec3_Add(middle, change);
            if (!(kiriVec3_Length(change) > 1e-15 * kiriVec3_Length(L))) {
                break;
            }
        }
        turned = kiriMat3_MulMat(turned, kiriMat3_Cayley(kiriVec3_Scale(scale, w)));
    }
    return turned;
}

/* Returns the shift of the target by an angular impulse. In the objective 1/2 m |A p - A* p|^2 / h'^2, a shift by
   h' I^-1 impulse x A* adds -(impulse / h') . turn, to first order. `turned`: A at the end of the free turn. */
static kiriMat3 ShiftBy(kiriVec3 impulse, const kiriMat3* inertia, const kiriMat3* turned, double part)
{
    kiriMat3 turning = CrossColumns(kiriMat3_Solve(inertia, impulse), turned);
    return kiriMat3_Scale(part, &turning);
}

static void PredictPlace(const kiriFrameData* frame, kiriVec3 gravity, const kiriStepping* s,
                         kiriPrediction* prediction)
{
    kiriVec3 push = kiriVec3_AddScaled(gravity, 1.0 / frame->mass, frame->force);
    kiriVec3 velocity = kiriVec3_AddScaled(frame->velocity, s->h, push);
    prediction->velocity = kiriVec3_Add(velocity, kiriStepping_Inner(s, &frame->history));
    kiriVec3 x = kiriVec3_AddScaled(frame->x, s->h - s->part, frame->velocity);
    x = kiriVec3_AddScaled(x, s->part, prediction->velocity);
    prediction->pose.x = kiriVec3_AddScaled(x, s->d, frame->history.lag);
    /* The iteration starts without inner forces, or with the inner forces of the last step. */
    kiriVec3 guess = kiriVec3_AddScaled(frame->x, s->h, frame->velocity);
    prediction->guess.x = kiriVec3_AddScaled(guess, -s->ahead, frame->history.lag);
}

/* Predicts the rotation: a free turn by the current angular momentum, then by the lag of the last step. The terms of
   the history shift the target, like the host's torque: both may be large and cancel each other. */
static void PredictTurn(const kiriFrameData* frame, const kiriStepping* s, kiriPrediction* prediction)
{
    kiriMat3 body = kiriPrediction_Inertia(prediction, &IdentityAxes);
    kiriMat3 inertia = kiriPrediction_Inertia(prediction, &frame->A);
    kiriVec3 L = kiriMat3_Mul(inertia, frame->spin), lag = frame->history.turnLag.u;
    kiriMat3 turned = TurnFreely(&frame->A, &body, L, s->h * kiriVec3_Length(frame->spin), s->h);
    prediction->pose.A = kiriMat3_MulMat(kiriMat3_Cayley(Shortened(kiriVec3_Scale(s->d, lag))), turned);
    prediction->guess.A = kiriMat3_MulMat(kiriMat3_Cayley(Shortened(kiriVec3_Scale(-s->ahead, lag))), turned);
    kiriMat3 inertiaAfter = kiriPrediction_Inertia(prediction, &prediction->pose.A);
    /* Turns of more than two radians a step are approximate; there a slender region might gain energy, so the energy is
       capped. */
    double before = kiriVec3_Dot(L, kiriMat3_Solve(&inertia, L)),
           after = kiriVec3_Dot(L, kiriMat3_Solve(&inertiaAfter, L));
    prediction->angular = after > before ? kiriVec3_Scale(kiriRoot(before / after), L) : L;
    prediction->spin = kiriMat3_Solve(&inertiaAfter, prediction->angular);
    kiriVec3 impulse = kiriVec3_AddScaled(kiriStepping_InnerTurn(s, &frame->history).u, s->h, frame->torque);
    kiriMat3 shift = ShiftBy(impulse, &inertiaAfter, &prediction->pose.A, s->part);
    prediction->target = kiriMat3_AddScaled(&prediction->pose.A, 1.0, &shift);
}

static kiriPrediction Standing(const kiriFrameData* frame, const kiriMaterial* material)
{
    kiriPrediction prediction = { 0 };
    prediction.moments = kiriFrame_MassMoments(frame, material);
    prediction.pose = prediction.guess = kiriPose_Of(frame);
    return prediction;
}

/* ---- Affine frames ---- */

/* Returns the inertia of an A that is not a rotation. It has an inverse even if A has collapsed. */
static kiriMat3 AffineInertia(const kiriMassMoments* m, const kiriMat3* A)
{
    kiriMat3 w = Weighted(m, A);
    double trace = SumDot(&w, A);
    return InertiaAbout(m, trace + 1e-12 * (trace + m->uu + m->vv + m->dd), A);
}

kiriMat3 kiriFrame_Inertia(const kiriFrameData* frame, const kiriMaterial* material)
{
    kiriMassMoments moments = kiriFrame_MassMoments(frame, material);
    return AffineInertia(&moments, &frame->A);
}

kiriVec3 kiriMat3_Spin(const kiriMat3* A, const kiriMat3* rate)
{
    const kiriMassMoments even = { 1.0, 0.0, 1.0, 1.0 };
    kiriMat3 inertia = AffineInertia(&even, A);
    return kiriMat3_Solve(&inertia, SumCross(A, rate));
}

kiriMat3 kiriMat3_Beside(const kiriMat3* A, const kiriMat3* rate, kiriVec3 spin)
{
    kiriMat3 turning = CrossColumns(spin, A);
    return kiriMat3_AddScaled(rate, -1.0, &turning);
}

kiriMat3 kiriMat3_Advance(const kiriMat3* A, const kiriMat3* change)
{
    kiriVec3 w = Shortened(kiriMat3_Spin(A, change));
    kiriMat3 rest = kiriMat3_Beside(A, change, w), grown = kiriMat3_AddScaled(A, 1.0, &rest);
    return kiriMat3_MulMat(kiriMat3_Cayley(w), grown);
}

/* Predicts the columns of A. They turn by the angular momentum like a rigid body. The rate without the spin turns with
   them and stretches them further. The terms of the history are added to the columns. */
static void PredictColumns(const kiriFrameData* frame, const kiriStepping* s, kiriPrediction* prediction)
{
    kiriMat3 inertia = AffineInertia(&prediction->moments, &frame->A);
    kiriMat3 inner = kiriStepping_InnerTurn(s, &frame->history);
    kiriVec3 L = kiriMat3_Mul(inertia, frame->spin);
    kiriMat3 turn = TurnFreely(&IdentityAxes, &inertia, L, s->h * kiriVec3_Length(frame->spin), s->h);
    kiriMat3 grown = kiriMat3_AddScaled(&frame->A, s->h, &frame->rate);
    kiriMat3 free = kiriMat3_MulMat(turn, grown), rate = kiriMat3_MulMat(turn, frame->rate);
    kiriVec3 spin = kiriMat3_Mul(turn, kiriMat3_Solve(&inertia, kiriMat3_MulTransposed(&turn, L)));
    double before = kiriVec3_Dot(L, kiriMat3_Solve(&inertia, L)), after = kiriVec3_Dot(L, spin);
    prediction->spin = after > before ? kiriVec3_Scale(kiriRoot(before / after), spin) : spin;
    kiriMat3 turning = CrossColumns(prediction->spin, &free);
    prediction->carried = kiriMat3_AddScaled(&turning, 1.0, &rate);
    prediction->rate = kiriMat3_AddScaled(&prediction->carried, 1.0, &inner);
    prediction->pose.A = kiriMat3_AddScaled(&free, s->part, &inner);
    prediction->pose.A = kiriMat3_AddScaled(&prediction->pose.A, s->d, &frame->history.turnLag);
    kiriMat3 ahead = kiriMat3_Scale(-s->ahead, &frame->history.turnLag);
    prediction->guess.A = s->isEuler ? free : kiriMat3_Advance(&free, &ahead);
    inertia = AffineInertia(&prediction->moments, &free);
    kiriMat3 shift = ShiftBy(kiriVec3_Scale(s->h, frame->torque), &inertia, &free, s->part);
    prediction->target = kiriMat3_AddScaled(&prediction->pose.A, 1.0, &shift);
}

kiriPrediction kiriPrediction_Free(const kiriFrameData* frame, const kiriMaterial* material, kiriVec3 gravity,
                                   const kiriStepping* stepping, bool isAffine)
{
    kiriPrediction prediction = Standing(frame, material);
    PredictPlace(frame, gravity, stepping, &prediction);
    (isAffine ? PredictColumns : PredictTurn)(frame, stepping, &prediction);
    return prediction;
}

/* ---- Held frames ---- */

kiriPrediction kiriPrediction_Held(const kiriFrameData* frame, const kiriMaterial* material, double dt)
{
    kiriPrediction prediction = Standing(frame, material);
    prediction.pose = (kiriPose){ frame->heldPosition, frame->heldRotation };
    kiriVec3 arm = kiriPose_Along(&prediction.pose, kiriVec2_Sub(frame->site.at, frame->center));
    prediction.pose.x = kiriVec3_Sub(frame->heldPosition, arm);
    prediction.velocity = kiriVec3_Scale(1.0 / dt, kiriVec3_Sub(prediction.pose.x, frame->x));
    /* The turn from one rotation to the other: the inverse of Cayley, its length made an angle to the fourth order. */
    kiriVec3 sine = SumCross(&frame->A, &prediction.pose.A);
    kiriVec3 w = kiriVec3_Scale(2.0 / kiriMax(1.0 + SumDot(&frame->A, &prediction.pose.A), 1e-3), sine);
    w = kiriVec3_Scale(1.0 / (1.0 + kiriVec3_Dot(w, w) / 12.0), w);
    prediction.spin = kiriVec3_Scale(1.0 / dt, w);
    prediction.target = prediction.pose.A;
    prediction.guess = prediction.pose;
    return prediction;
}

bool kiriFrame_FitsFloats(const kiriFrameData* frame)
{
    return kiriVec3_FitsFloats(frame->x) && kiriVec3_FitsFloats(frame->A.u) && kiriVec3_FitsFloats(frame->A.v) &&
           kiriVec3_FitsFloats(frame->A.d) && kiriVec3_FitsFloats(frame->velocity) &&
           kiriVec3_FitsFloats(frame->spin) && kiriVec3_FitsFloats(frame->rate.u) &&
           kiriVec3_FitsFloats(frame->rate.v) && kiriVec3_FitsFloats(frame->rate.d) &&
           kiriVec3_FitsFloats(kiriFrame_VelocityAt(frame, frame->site.at));
}

void kiriFrame_PutToRest(kiriFrameData* frame)
{
    KIRI_CLEAR(&frame->velocity);
    KIRI_CLEAR(&frame->spin);
    KIRI_CLEAR(&frame->rate);
    KIRI_CLEAR(&frame->history);
}

void kiriFrame_DropForces(kiriFrameData* frame)
{
    KIRI_CLEAR(&frame->force);
    KIRI_CLEAR(&frame->torque);
}

void kiriFrame_Recenter(kiriFrameData* frame, const kiriMoments* material, double densityPerArea)
{
    kiriVec2 center = kiriMoments_Center(material);
    kiriMoments about = kiriMoments_About(material, center);
    kiriVec3 x = kiriFrame_Carry(frame, center);
    frame->velocity = kiriFrame_VelocityAt(frame, center);
    frame->x = x;
    frame->center = center;
    frame->area = material->area;
    frame->mass = densityPerArea * about.area;
    frame->inertia[0] = densityPerArea * about.uu;
    frame->inertia[1] = densityPerArea * about.uv;
    frame->inertia[2] = densityPerArea * about.vv;
}
