#include "kiri_momentum.h"

#include <float.h>

static void GatherCenters(const kiriFrameData* before, const kiriFrameData* after, const kiriAwake* awake,
                          const int32_t* piece, kiriPieceMomentum* pieces)
{
    KIRI_EACH(f, awake->frames) {
        kiriPieceMomentum* p = &pieces[piece[f]];
        double m = before[f].held ? 0.0 : before[f].mass;
        p->mass += m;
        p->centerBefore = kiriVec3_AddScaled(p->centerBefore, m, before[f].x);
        p->velocityBefore = kiriVec3_AddScaled(p->velocityBefore, m, before[f].velocity);
        p->centerAfter = kiriVec3_AddScaled(p->centerAfter, m, after[f].x);
        p->velocityAfter = kiriVec3_AddScaled(p->velocityAfter, m, after[f].velocity);
    }
    KIRI_EACH(i, awake->pieces) {
        kiriPieceMomentum* p = &pieces[i];
        double share = 1.0 / kiriMax(p->mass, DBL_MIN);
        p->centerBefore = kiriVec3_Scale(share, p->centerBefore);
        p->velocityBefore = kiriVec3_Scale(share, p->velocityBefore);
        p->centerAfter = kiriVec3_Scale(share, p->centerAfter);
        p->velocityAfter = kiriVec3_Scale(share, p->velocityAfter);
    }
}

/* What a frame adds, about a centre that moves. The true rate of A counts, by which affine frames also stretch. */
static kiriVec3 AngularAbout(const kiriFrameData* frame, const kiriMaterial* material, kiriVec3 center,
                             kiriVec3 velocity)
{
    kiriVec3 r = kiriVec3_Sub(frame->x, center), v = kiriVec3_Sub(frame->velocity, velocity);
    return kiriVec3_AddScaled(kiriFrame_AngularMomentum(frame, material), frame->mass, kiriVec3_Cross(r, v));
}

/* Forces act on arms as they are on the mean over the step. */
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

/* The steps keep the linear momentum exactly but for what is left of the iteration, and for pushes that were cut to
   what contacts can do. */
static void MoveTogether(kiriPieceMomentum* p)
{
    kiriVec3 velocity = kiriVec3_Scale(1.0 / p->mass, p->dueLinear);
    p->move = kiriVec3_Sub(velocity, p->velocityAfter);
    p->velocityAfter = velocity;
}

static void FindTurns(kiriPieceMomentum* pieces, const kiriAwake* awake, const kiriVec3* normal)
{
    KIRI_EACH(i, awake->pieces) {
        kiriPieceMomentum* p = &pieces[i];
        if (p->mass > 0.0) {
            bool isOwn = p->isFree || p->isPushed;
            kiriVec3 arm = kiriVec3_Scale(-1.0, p->centerAfter);
            p->due = kiriVec3_Add(p->due, kiriVec3_Add(p->pushed.moment, kiriVec3_Cross(arm, p->pushed.force)));
            if (p->isPushed) {
                p->dueLinear = kiriVec3_Add(p->dueLinear, p->pushed.force);
                MoveTogether(p);
            }
            kiriVec3 missing = kiriVec3_Sub(p->due, p->angular);
            if (normal != NULL) {
                missing = kiriVec3_Scale(kiriVec3_Dot(missing, *normal), *normal);
            }
            p->angular = isOwn ? kiriVec3_Add(p->angular, missing) : p->angular;
            p->turn = isOwn ? kiriMat3_Solve(&p->inertia, missing) : p->turn;
            p->spin = kiriMat3_Solve(&p->inertia, p->angular);
        }
    }
}

void kiriMomentum_Restore(const kiriFrameData* before, kiriFrameData* after, const kiriAwake* awake,
                          const int32_t* piece, kiriPieceMomentum* pieces, const kiriMaterial* material,
                          kiriVec3 gravity, double dt, const kiriVec3* normal)
{
    GatherCenters(before, after, awake, piece, pieces);
    KIRI_EACH(f, awake->frames) {
        if (!before[f].held) {
            AddFrameTurning(&pieces[piece[f]], &before[f], &after[f], material, gravity, dt);
        }
    }
    FindTurns(pieces, awake, normal);
    KIRI_EACH(f, awake->frames) {
        const kiriPieceMomentum* p = &pieces[piece[f]];
        if (p->isFree || p->isPushed) {
            kiriVec3 arm = kiriVec3_Sub(after[f].x, p->centerAfter);
            after[f].velocity = kiriVec3_Add(after[f].velocity, kiriVec3_Add(p->move, kiriVec3_Cross(p->turn, arm)));
            after[f].spin = kiriVec3_Add(after[f].spin, p->turn);
        }
    }
}
