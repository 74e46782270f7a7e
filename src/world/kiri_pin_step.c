#include "kiri_pin_step.h"

#include "../sheet/kiri_carry.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"

#include <string.h>

kiriObstacleData* kiriPinStep_Obstacle(const kiriWorld* world, const kiriPinData* pin)
{
    const kiriSlot* slot = pin->anchor.obstacle != 0 ? kiriPool_Find(&world->obstacleIds, pin->anchor.obstacle) : NULL;
    return slot != NULL ? slot->owner : NULL;
}

void kiriPinStep_Fasten(const kiriWorld* world, kiriPinData* pin)
{
    const kiriObstacleData* obstacle = kiriPinStep_Obstacle(world, pin);
    if (obstacle != NULL) {
        pin->anchor.local = kiriObstacle_PointToLocal(obstacle, pin->target);
    }
}

void kiriPinStep_Carry(const kiriWorld* world, kiriSheetData* sheet, const kiriMat3* R, kiriVec3 t)
{
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (kiriPinStep_Obstacle(world, &sheet->pins.data[i]) == NULL) {
            kiriCarry_Pin(sheet, i, R, t);
        }
    }
}

/* Obstacles of one body share its mass; so do their pins. */
static bool AreOneBody(const kiriObstacleData* a, const kiriObstacleData* b)
{
    return a == b || (a->body != 0 && a->body == b->body);
}

static int32_t CountPinsOn(const kiriWorld* world, const kiriSheetData* sheet, const kiriObstacleData* obstacle)
{
    int32_t count = 0;
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        const kiriObstacleData* other = kiriPinStep_Obstacle(world, &sheet->pins.data[i]);
        count += other != NULL && AreOneBody(obstacle, other);
    }
    return count;
}

/* What an impulse along an axis gives the point. */
static kiriVec3 GiveAlong(const kiriYieldRow* body, kiriVec3 arm, kiriVec3 axis)
{
    kiriVec3 spin = kiriMat3_Mul(body->inverseInertia, kiriVec3_Cross(arm, axis));
    return kiriVec3_AddScaled(kiriVec3_Cross(spin, arm), body->inverseMass, axis);
}

/* Each of several pins on a body has its share of the mass. */
static void Soften(kiriPinAnchor* anchor, const kiriObstacleData* obstacle, kiriVec3 target, int32_t pins)
{
    kiriYieldRow body = kiriObstacle_YieldRow(obstacle);
    kiriVec3 arm = kiriVec3_Sub(target, body.center);
    anchor->give.u = kiriVec3_Scale(pins, GiveAlong(&body, arm, kiriVec3_Make(1.0, 0.0, 0.0)));
    anchor->give.v = kiriVec3_Scale(pins, GiveAlong(&body, arm, kiriVec3_Make(0.0, 1.0, 0.0)));
    anchor->give.d = kiriVec3_Scale(pins, GiveAlong(&body, arm, kiriVec3_Make(0.0, 0.0, 1.0)));
    double turning = anchor->give.u.x + anchor->give.v.y + anchor->give.d.z - 3.0 * pins * body.inverseMass;
    anchor->most = pins * body.inverseMass + kiriMax(turning, 0.0);
}

static void Clear(kiriPinAnchor* anchor)
{
    const kiriVec3 none = { 0.0, 0.0, 0.0 };
    memset(&anchor->give, 0, sizeof(anchor->give));
    anchor->most = anchor->softness = 0.0;
    anchor->way = none;
}

/* A piece that sleeps does not mind what moves less than it would itself before it woke. */
static bool IsTargetStill(const kiriSheetData* sheet, const kiriPinData* pin, kiriVec3 from, kiriVec3 to)
{
    double least = KIRI_CALM_SECONDS * sheet->settings.sleepSpeed;
    return kiriSheet_PieceOf(sheet, sheet->layout.pinFrame.data[pin - sheet->pins.data])->rest.asleep &&
           kiriVec3_Length(kiriVec3_Sub(from, pin->target)) <= least &&
           kiriVec3_Length(kiriVec3_Sub(to, pin->target)) <= least;
}

static void BeginPin(const kiriWorld* world, kiriSheetData* sheet, int32_t index, double dt)
{
    kiriPinData* pin = &sheet->pins.data[index];
    const kiriObstacleData* obstacle = kiriPinStep_Obstacle(world, pin);
    if (obstacle == NULL) {
        return;
    }
    kiriObstacleData later = *obstacle;
    kiriObstacle_Advance(&later, dt);
    kiriVec3 from = kiriObstacle_PointToWorld(obstacle, pin->anchor.local);
    kiriVec3 to = kiriObstacle_PointToWorld(&later, pin->anchor.local);
    if (!IsTargetStill(sheet, pin, from, to) &&
        (!kiriVec3_Equal(from, pin->target) || !kiriVec3_Equal(to, pin->target))) {
        pin->lastTarget = from;
        pin->target = to;
        kiriPins_ForgetHistory(sheet, index);
        kiriMotion_WakePin(sheet, index);
    }
    Soften(&pin->anchor, obstacle, from, CountPinsOn(world, sheet, obstacle));
}

void kiriPinStep_Begin(const kiriWorld* world, kiriSheetData* sheet, double dt)
{
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        Clear(&sheet->pins.data[i].anchor);
        BeginPin(world, sheet, i, dt);
    }
}

void kiriPinStep_End(const kiriWorld* world, const kiriSheetData* sheet, double dt, bool areMovable)
{
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        const kiriPinData* pin = &sheet->pins.data[i];
        kiriObstacleData* obstacle = kiriPinStep_Obstacle(world, pin);
        if (obstacle != NULL && kiriObstacle_IsMovable(obstacle) == areMovable) {
            kiriObstacle_TakeImpulse(obstacle, kiriVec3_Scale(-dt, pin->bore.force), pin->target);
        }
    }
}
