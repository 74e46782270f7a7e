#include "kiri_momentum.h"

static void GatherCenters(const kiriFrameData* before, const kiriFrameData* after, int32_t frameCount,
                          const int32_t* piece, kiriPieceMomentum* pieces, int32_t pieceCount)
{
    for (int32_t f = 0; f < frameCount; ++f) {
        kiriPieceMomentum* p = &pieces[piece[f]];
        double m = before[f].mass;
        p->mass += m;
        p->centerBefore = kiriVec3_AddScaled(p->centerBefore, m, before[f].x);
        p->velocityBefore = kiriVec3_AddScaled(p->velocityBefore, m, before[f].velocity);
        p->centerAfter = kiriVec3_AddScaled(p->centerAfter, m, after[f].x);
        p->velocityAfter = kiriVec3_AddScaled(p->velocityAfter, m, after[f].velocity);
    }
    for (int32_t i = 0; i < pieceCount; ++i) {
        kiriPieceMomentum* p = &pieces[i];
        p->centerBefore = kiriVec3_Scale(1.0 / p->mass, p->centerBefore);
        p->velocityBefore = kiriVec3_Scale(1.0 / p->mass, p->velocityBefore);
        p->centerAfter = kiriVec3_Scale(1.0 / p->mass, p->centerAfter);
        p->velocityAfter = kiriVec3_Scale(1.0 / p->mass, p->velocityAfter);
    }
}

/* What a frame adds, about a centre that moves. The true rate of A counts, by which affine frames also stretch. */
static kiriVec3 AngularAbout(const kiriFrameData* frame, const kiriMaterial* material, kiriVec3 center,
                             kiriVec3 velocity)
{
    kiriVec3 r = kiriVec3_Sub(frame->x, center), v = kiriVec3_Sub(frame->velocity, velocity);
    return kiriVec3_AddScaled(kiriFrame_AngularMomentum(frame, material), frame->mass, kiriVec3_Cross(r, v));
}

static void GatherTurning(const kiriFrameData* before, const kiriFrameData* after, int32_t frameCount,
                          const int32_t* piece, kiriPieceMomentum* pieces, const kiriMaterial* material, double dt)
{
    double fade = 1.0 / (1.0 + dt * (double)material->airDamping);
    for (int32_t f = 0; f < frameCount; ++f) {
        const kiriFrameData* frame = &before[f];
        kiriPieceMomentum* p = &pieces[piece[f]];
        kiriVec3 arm = kiriVec3_Sub(frame->x, p->centerBefore);
        kiriVec3 torque = kiriVec3_Add(frame->torque, kiriVec3_Cross(arm, frame->force));
        kiriMat3 own = kiriFrame_Inertia(&after[f], material);
        kiriMat3 point = kiriMat3_PointInertia(frame->mass, kiriVec3_Sub(after[f].x, p->centerAfter));
        p->due = kiriVec3_AddScaled(p->due, fade, AngularAbout(frame, material, p->centerBefore, p->velocityBefore));
        p->due = kiriVec3_AddScaled(p->due, dt, torque);
        p->angular = kiriVec3_Add(p->angular, AngularAbout(&after[f], material, p->centerAfter, p->velocityAfter));
        p->inertia = kiriMat3_AddScaled(&p->inertia, 1.0, &own);
        p->inertia = kiriMat3_AddScaled(&p->inertia, 1.0, &point);
    }
}

/* The turns that are missing, as far as the energy goes. */
static void FindMissingTurns(kiriPieceMomentum* pieces, int32_t pieceCount)
{
    for (int32_t i = 0; i < pieceCount; ++i) {
        kiriPieceMomentum* p = &pieces[i];
        kiriVec3 missing = kiriVec3_Sub(p->due, p->angular);
        p->turn = p->isHeld ? kiriVec3_Make(0.0, 0.0, 0.0) : kiriMat3_Solve(&p->inertia, missing);
        double energy = kiriVec3_Dot(p->turn, kiriVec3_AddScaled(p->angular, 0.5, missing));
        p->turn = kiriVec3_Scale(energy > p->lost ? p->lost / energy : 1.0, p->turn);
    }
}

void kiriMomentum_Restore(const kiriFrameData* before, kiriFrameData* after, int32_t frameCount, const int32_t* piece,
                          kiriPieceMomentum* pieces, int32_t pieceCount, const kiriMaterial* material, double dt)
{
    for (int32_t i = 0; i < pieceCount; ++i) {
        pieces[i] = (kiriPieceMomentum){ .isHeld = pieces[i].isHeld, .lost = pieces[i].lost };
    }
    GatherCenters(before, after, frameCount, piece, pieces, pieceCount);
    GatherTurning(before, after, frameCount, piece, pieces, material, dt);
    FindMissingTurns(pieces, pieceCount);
    for (int32_t f = 0; f < frameCount; ++f) {
        const kiriPieceMomentum* p = &pieces[piece[f]];
        kiriVec3 arm = kiriVec3_Sub(after[f].x, p->centerAfter);
        after[f].velocity = kiriVec3_Add(after[f].velocity, kiriVec3_Cross(p->turn, arm));
        after[f].spin = kiriVec3_Add(after[f].spin, p->turn);
    }
}
