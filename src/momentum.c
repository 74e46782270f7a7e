#include "momentum.h"

static kiriVec3 Zero(void)
{
    return kiriVec3_Make(0.0, 0.0, 0.0);
}

static void GatherCenters(const kiriFrameData* frames, int32_t frameCount, const kiriPose* poses,
                          const kiriFlight* flights, const int32_t* piece, kiriPieceMomentum* pieces,
                          int32_t pieceCount)
{
    for (int32_t f = 0; f < frameCount; ++f) {
        kiriPieceMomentum* p = &pieces[piece[f]];
        double m = frames[f].mass;
        p->mass += m;
        p->centerBefore = kiriVec3_AddScaled(p->centerBefore, m, frames[f].x);
        p->velocityBefore = kiriVec3_AddScaled(p->velocityBefore, m, frames[f].velocity);
        p->centerAfter = kiriVec3_AddScaled(p->centerAfter, m, poses[f].x);
        p->velocityAfter = kiriVec3_AddScaled(p->velocityAfter, m, flights[f].velocity);
    }
    for (int32_t i = 0; i < pieceCount; ++i) {
        kiriPieceMomentum* p = &pieces[i];
        p->centerBefore = kiriVec3_Scale(1.0 / p->mass, p->centerBefore);
        p->velocityBefore = kiriVec3_Scale(1.0 / p->mass, p->velocityBefore);
        p->centerAfter = kiriVec3_Scale(1.0 / p->mass, p->centerAfter);
        p->velocityAfter = kiriVec3_Scale(1.0 / p->mass, p->velocityAfter);
    }
}

/* m (r^2 - r r^T), the inertia of a mass at r. */
static kiriMat3 PointInertia(double m, kiriVec3 r)
{
    double rr = m * kiriVec3_Dot(r, r);
    kiriMat3 j = { kiriVec3_AddScaled(kiriVec3_Make(rr, 0.0, 0.0), -m * r.x, r),
                   kiriVec3_AddScaled(kiriVec3_Make(0.0, rr, 0.0), -m * r.y, r),
                   kiriVec3_AddScaled(kiriVec3_Make(0.0, 0.0, rr), -m * r.z, r) };
    return j;
}

static void AddInertia(kiriMat3* sum, const kiriMat3* part)
{
    sum->u = kiriVec3_Add(sum->u, part->u);
    sum->v = kiriVec3_Add(sum->v, part->v);
    sum->d = kiriVec3_Add(sum->d, part->d);
}

/* What a frame adds: with inertia J about its centre, mass m at r with velocity v. */
static kiriVec3 Angular(const kiriMat3* J, kiriVec3 spin, double m, kiriVec3 r, kiriVec3 v)
{
    return kiriVec3_Add(kiriMat3_Mul(*J, spin), kiriVec3_Scale(m, kiriVec3_Cross(r, v)));
}

static void GatherTurning(const kiriFrameData* frames, int32_t frameCount, const kiriPose* poses,
                          const kiriFlight* flights, const int32_t* piece, kiriPieceMomentum* pieces, double fade,
                          double dt)
{
    for (int32_t f = 0; f < frameCount; ++f) {
        const kiriFrameData* frame = &frames[f];
        kiriPieceMomentum* p = &pieces[piece[f]];
        kiriMat3 before = kiriFlight_Inertia(&flights[f], &frame->A),
                 after = kiriFlight_Inertia(&flights[f], &poses[f].A);
        kiriVec3 r = kiriVec3_Sub(frame->x, p->centerBefore), s = kiriVec3_Sub(poses[f].x, p->centerAfter);
        kiriVec3 v = kiriVec3_Sub(frame->velocity, p->velocityBefore);
        kiriVec3 w = kiriVec3_Sub(flights[f].velocity, p->velocityAfter);
        kiriVec3 torque = kiriVec3_Add(frame->torque, kiriVec3_Cross(r, frame->force));
        kiriMat3 point = PointInertia(frame->mass, s);
        p->due = kiriVec3_AddScaled(p->due, fade, Angular(&before, frame->spin, frame->mass, r, v));
        p->due = kiriVec3_AddScaled(p->due, dt, torque);
        p->angular = kiriVec3_Add(p->angular, Angular(&after, flights[f].spin, frame->mass, s, w));
        AddInertia(&p->inertia, &after);
        AddInertia(&p->inertia, &point);
    }
}

/* The turns that are missing; returns the energy that they take. */
static double FindTurns(kiriPieceMomentum* pieces, int32_t pieceCount)
{
    double energy = 0.0;
    for (int32_t i = 0; i < pieceCount; ++i) {
        kiriPieceMomentum* p = &pieces[i];
        kiriVec3 missing = kiriVec3_Sub(p->due, p->angular);
        p->turn = p->isHeld ? Zero() : kiriMat3_Solve(&p->inertia, missing);
        energy += kiriVec3_Dot(p->turn, kiriVec3_AddScaled(p->angular, 0.5, missing));
    }
    return energy;
}

void kiriMomentum_Restore(const kiriFrameData* frames, int32_t frameCount, const kiriPose* poses, kiriFlight* flights,
                          const int32_t* piece, kiriPieceMomentum* pieces, int32_t pieceCount,
                          const kiriMaterial* material, double dt, double lost)
{
    for (int32_t i = 0; i < pieceCount; ++i) {
        int32_t isHeld = pieces[i].isHeld;
        kiriMat3 none = { { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 }, { 0.0, 0.0, 0.0 } };
        kiriPieceMomentum p = { isHeld, 0.0, Zero(), Zero(), Zero(), Zero(), Zero(), Zero(), none, Zero() };
        pieces[i] = p;
    }
    double fade = 1.0 / (1.0 + dt * material->airDamping);
    GatherCenters(frames, frameCount, poses, flights, piece, pieces, pieceCount);
    GatherTurning(frames, frameCount, poses, flights, piece, pieces, fade, dt);
    double energy = FindTurns(pieces, pieceCount), share = energy > lost ? lost / energy : 1.0;
    for (int32_t f = 0; f < frameCount; ++f) {
        const kiriPieceMomentum* p = &pieces[piece[f]];
        kiriVec3 turn = kiriVec3_Scale(share, p->turn);
        flights[f].velocity =
            kiriVec3_Add(flights[f].velocity, kiriVec3_Cross(turn, kiriVec3_Sub(poses[f].x, p->centerAfter)));
        flights[f].spin = kiriVec3_Add(flights[f].spin, turn);
    }
}
