#include "kiri_pair_work.h"

#include "../core/kiri_sort.h"
#include "../motion/kiri_prediction.h"
#include "../sheet/kiri_touch.h"

#include <string.h>

#define FEELING 0.3    /* s */
#define CLOSE_LOAD 0.1 /* of the thickness of contact: what is no farther above its plane lies on it */
#define SLOW 20.0      /* times sleepSpeed: what lies on something and moves no faster than that */
#define SETTLED 0.01   /* s: comes to rest within that time */

/* ---- Loads for the lower one ---- */

void kiriPairs_ApplyLoads(kiriWorld* world, double dt)
{
    for (int32_t k = 0; k < world->active.count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        for (int32_t f = 0; sheet->settings.touchesSheets && !sheet->rest.asleep && f < sheet->frames.count; ++f) {
            kiriFrameData* frame = &sheet->frames.data[f];
            if (!kiriSheet_Moves(sheet, f)) {
                continue;
            }
            frame->load.force = kiriVec3_Scale(1.0 / dt, frame->load.force);
            frame->load.moment = kiriVec3_Scale(1.0 / dt, frame->load.moment);
            frame->force = kiriVec3_Add(frame->force, frame->load.force);
            frame->torque = kiriVec3_Add(frame->torque, frame->load.moment);
            frame->gained = frame->passed = 0.0;
            memset(&frame->received, 0, sizeof(kiriVec3));
        }
    }
}

static void ForgetLoads(kiriWorld* world)
{
    for (int32_t k = 0; k < world->active.count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        for (int32_t f = 0; sheet->settings.touchesSheets && f < sheet->frames.count; ++f) {
            memset(&sheet->frames.data[f].load, 0, sizeof(kiriWrench));
        }
    }
}

/* An impulse at a vertex goes to the frames that carry it, by their weights. */
static void LoadVertex(kiriSheetData* sheet, int32_t vertex, kiriVec3 impulse)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec2 local = sheet->seen.surface.rest.data[vertex];
    for (int32_t i = span.first; i < span.first + span.count; ++i) {
        kiriSampleWeight weight = sheet->vertexSkin.weights.data[i];
        int32_t f = kiriSheet_FrameOf(sheet, weight.label);
        kiriFrameData* frame = &sheet->frames.data[f];
        if (!kiriPiece_IsAwake(kiriSheet_PieceOf(sheet, f))) {
            continue; /* it is not moved, and would get all of it when it wakes */
        }
        kiriVec3 arm = kiriVec3_Sub(kiriFrame_Carry(frame, local), frame->x),
                 part = kiriVec3_Scale(weight.value, impulse);
        kiriWrench load = { part, kiriVec3_Cross(arm, part) };
        kiriWrench_Add(&frame->load, 1.0, &load);
    }
}

static kiriVec3 FeltForce(const kiriPairs* pairs, uint64_t key)
{
    int32_t low;
    KIRI_SEARCH(low, 0, pairs->felt.count, pairs->felt.data[middle].key < key);
    return low < pairs->felt.count && pairs->felt.data[low].key == key ? pairs->felt.data[low].force
                                                                       : kiriVec3_Make(0.0, 0.0, 0.0);
}

static bool HasLowerKey(const void* context, int32_t a, int32_t b)
{
    const kiriPairTouch* touches = context;
    return touches[a].key < touches[b].key || (touches[a].key == touches[b].key && a < b);
}

/* What the lower one feels follows what is pushed within FEELING seconds. Felt at once it would still be one tick late,
   and pieces would throw each other. */
static kiriVec3 Feel(const kiriWorld* world, const kiriPairTouch* touch, double dt)
{
    const kiriPairs* pairs = &world->pairs;
    const kiriTouches* touches = &touch->upper.sheet->touches;
    kiriVec3 was = FeltForce(pairs, touch->key);
    KIRI_ASSERT(touch->touch < touches->found.count);
    int32_t row = touch->touch != KIRI_NONE ? touches->found.data[touch->touch].row : KIRI_NONE;
    if (row == KIRI_NONE) {
        return was; /* it was not moved */
    }
    KIRI_ASSERT(row < touches->rows.count && touches->rows.data[row].key == touch->key);
    double part = dt / (dt + FEELING);
    KIRI_ASSERT(kiriSheet_Moves(touch->upper.sheet, touches->rows.data[row].weights[0].frame));
    const kiriPiece* piece = kiriSheet_PieceOf(touch->upper.sheet, touches->rows.data[row].weights[0].frame);
    kiriVec3 push = kiriVec3_Scale(pairs->islands.data[piece->island].keepPush / dt, touches->rows.data[row].impulse);
    return kiriVec3_AddScaled(was, part, kiriVec3_Sub(push, was));
}

/* In the order of keys. */
static void FeelAll(kiriWorld* world, double dt)
{
    kiriPairs* pairs = &world->pairs;
    KIRI_ASSERT(pairs->order.capacity >= pairs->touches.count && pairs->nextFelt.capacity >= pairs->touches.count);
    pairs->order.count = pairs->touches.count;
    for (int32_t i = 0; i < pairs->touches.count; ++i) {
        pairs->order.data[i] = i;
    }
    kiriSort(pairs->order.data, pairs->order.count, HasLowerKey, pairs->touches.data);
    pairs->nextFelt.count = pairs->touches.count;
    for (int32_t i = 0; i < pairs->order.count; ++i) {
        const kiriPairTouch* touch = &pairs->touches.data[pairs->order.data[i]];
        kiriFeltPush felt = { touch->key, Feel(world, touch, dt) };
        pairs->nextFelt.data[i] = felt;
        for (int k = 0; k < 3 && touch->lower.vertex[k] != KIRI_NONE; ++k) {
            LoadVertex(touch->lower.sheet, touch->lower.vertex[k],
                       kiriVec3_Scale(-dt * touch->lower.share[k], felt.force));
        }
    }
    kiriArrayHeader last = kiriArray_GetHeader(&pairs->felt);
    kiriArray_SetHeader(&pairs->felt, kiriArray_GetHeader(&pairs->nextFelt));
    kiriArray_SetHeader(&pairs->nextFelt, last);
}

/* ---- Rest ---- */

static bool LiesOnPlane(const kiriSheetData* sheet, const kiriContactRow* row)
{
    kiriVec3 x = { 0.0, 0.0, 0.0 };
    for (int32_t m = 0; m < row->weightCount; ++m) {
        const kiriFrameData* frame = &sheet->frames.data[row->weights[m].frame];
        x = kiriVec3_AddScaled(x, row->weights[m].value, kiriFrame_Carry(frame, row->at));
    }
    double above = kiriVec3_Dot(row->normal, kiriVec3_Sub(x, row->way)) - row->offset;
    return above < CLOSE_LOAD * sheet->settings.contactThickness;
}

static void FindSupport(kiriSheetData* sheet)
{
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    KIRI_EACH(f, awake->frames) {
        memset(&sheet->frames.data[f].support, 0, sizeof(kiriVec3));
    }
    for (int32_t k = 0; k < sheet->touches.rows.count; ++k) {
        const kiriContactRow* row = &sheet->touches.rows.data[k];
        kiriVec3* support = &sheet->frames.data[row->weights[0].frame].support;
        *support = LiesOnPlane(sheet, row) ? kiriVec3_Add(*support, row->normal) : *support;
    }
    KIRI_EACH(f, awake->frames) {
        sheet->frames.data[f].support = kiriVec3_Normalize(sheet->frames.data[f].support);
    }
}

/* Frames that lie on something and hardly move come to rest: else each change of what carries how much would stir all
   that lies above. */
static void SettleFrames(kiriSheetData* sheet, double dt)
{
    double slow = SLOW * sheet->settings.sleepSpeed, keep = SETTLED / (SETTLED + dt);
    KIRI_EACH(f, kiriSolver_Awake(sheet->solver)->frames) {
        kiriFrameData* frame = &sheet->frames.data[f];
        double energy = kiriFrame_KineticEnergy(frame, &sheet->settings.material);
        bool isCarried = kiriVec3_Dot(frame->support, frame->support) > 0.0;
        if (isCarried && !frame->held && energy < 0.5 * frame->mass * slow * slow) {
            frame->velocity = kiriVec3_Scale(keep, frame->velocity);
            frame->spin = kiriVec3_Scale(keep, frame->spin);
            frame->rate = kiriMat3_Scale(keep, &frame->rate);
        }
    }
}

void kiriPairs_TakeLoads(kiriWorld* world, double dt)
{
    ForgetLoads(world);
    FeelAll(world, dt);
    for (int32_t k = 0; k < world->active.count; ++k) {
        kiriSheetData* sheet = kiriWorld_Active(world, k);
        if (sheet->settings.touchesSheets && !sheet->rest.asleep) {
            FindSupport(sheet);
            SettleFrames(sheet, dt);
        }
    }
}
