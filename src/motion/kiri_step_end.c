#include "kiri_step_end.h"

#include <string.h>

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

/* G by which the momentum grows is that about where the free turn ended: it has the impulse of the host's torque. Inner
   forces gave the rest. */
void kiriStepEnd_Rigid(const kiriPrediction* prediction, const kiriStepping* s, const kiriFrameData* before,
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

/* The rate of A differs from that of the prediction as A does, over h'. */
void kiriStepEnd_Affine(const kiriPrediction* prediction, const kiriStepping* s, const kiriFrameData* before,
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

void kiriStepEnd_Held(const kiriPrediction* prediction, const kiriStepping* s, kiriFrameData* after)
{
    after->velocity = prediction->velocity;
    after->spin = prediction->spin;
    after->rate = prediction->rate;
    memset(&after->history, 0, sizeof(after->history));
    after->history.dt = s->h;
    after->history.isHalf = s->isHalf;
    after->history.isHeld = 1;
}
