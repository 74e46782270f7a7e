#include "kiri_obstacle.h"

#include <string.h>

kiriObstacleData* kiriObstacle_Alloc(kiriMemory* memory, int32_t corners)
{
    int64_t bytes = (int64_t)(sizeof(kiriObstacleData) + 2 * sizeof(kiriVec2) * (size_t)corners);
    kiriObstacleData* obstacle = kiriMemory_AllocZeroed(memory, bytes);
    if (obstacle != NULL) {
        obstacle->shape.count = corners;
        obstacle->shape.outline = (kiriVec2*)(obstacle + 1);
        obstacle->shape.normals = obstacle->shape.outline + corners;
    }
    return obstacle;
}

/* ---- Where it is ------------------------------------------------------------------------------------------------- */

/* m: for how far out the turning of a plane, or of what has no end, counts. */
#define LONG_LEVER 1e3

double kiriObstacle_TurnSpeed(const kiriObstacleData* obstacle)
{
    const kiriObstacleShape* shape = &obstacle->shape;
    kiriVec3 spin = kiriObstacle_ToLocal(obstacle, obstacle->spin);
    double aslant = sqrt(spin.x * spin.x + spin.y * spin.y);
    bool isPlane = shape->type == KIRI_OBSTACLE_PLANE, isLong = isPlane || !(shape->half < LONG_LEVER);
    double flat = isPlane ? 0.0 : shape->flat;
    return fabs(spin.z) * flat + aslant * (flat + (isLong ? LONG_LEVER : shape->half));
}

/* How far it reaches to both sides of its position along an axis of the world, with the way that it goes. */
static void BoundAlong(const kiriObstacleData* obstacle, kiriVec3 axis, double dt, double* lower, double* upper)
{
    const kiriObstacleShape* shape = &obstacle->shape;
    kiriVec3 local = kiriObstacle_ToLocal(obstacle, axis);
    double at = kiriVec3_Dot(axis, obstacle->position), way = dt * kiriVec3_Dot(axis, obstacle->velocity);
    double turn = dt * kiriObstacle_TurnSpeed(obstacle);
    *lower = at - kiriObstacleShape_Reach(shape, kiriVec3_Scale(-1.0, local)) - turn + kiriMin(way, 0.0);
    *upper = at + kiriObstacleShape_Reach(shape, local) + turn + kiriMax(way, 0.0);
}

void kiriObstacle_Bound(kiriObstacleData* obstacle, double dt)
{
    kiriVec3 x = { 1.0, 0.0, 0.0 }, y = { 0.0, 1.0, 0.0 }, z = { 0.0, 0.0, 1.0 };
    BoundAlong(obstacle, x, dt, &obstacle->lower.x, &obstacle->upper.x);
    BoundAlong(obstacle, y, dt, &obstacle->lower.y, &obstacle->upper.y);
    BoundAlong(obstacle, z, dt, &obstacle->lower.z, &obstacle->upper.z);
}

/* The least height of a box above a plane. */
static double HeightAbovePlane(const kiriObstacleData* plane, kiriVec3 lower, kiriVec3 upper)
{
    kiriVec3 n = plane->rotation.d;
    kiriVec3 lowest =
        kiriVec3_Make(n.x > 0.0 ? lower.x : upper.x, n.y > 0.0 ? lower.y : upper.y, n.z > 0.0 ? lower.z : upper.z);
    return kiriVec3_Dot(n, kiriVec3_Sub(lowest, plane->position));
}

bool kiriObstacle_IsNear(const kiriObstacleData* obstacle, kiriVec3 lower, kiriVec3 upper, double reach)
{
    if (obstacle->shape.type == KIRI_OBSTACLE_PLANE) {
        return HeightAbovePlane(obstacle, lower, upper) < reach;
    }
    return lower.x - reach < obstacle->upper.x && lower.y - reach < obstacle->upper.y &&
           lower.z - reach < obstacle->upper.z && upper.x + reach > obstacle->lower.x &&
           upper.y + reach > obstacle->lower.y && upper.z + reach > obstacle->lower.z;
}

/* The turn of a rotation vector to the fourth order in its angle: the Cayley map alone turns by 2 atan(angle / 2). */
static kiriMat3 Turn(kiriVec3 w)
{
    double half = 0.25 * kiriVec3_Dot(w, w); /* square of half the angle */
    double stretch = 1.0 + half * (1.0 / 3.0 + half * (2.0 / 15.0));
    return kiriMat3_Cayley(kiriVec3_Scale(stretch, w));
}

/* What is farther out than this stays where it is. */
#define FARTHEST 1e30

void kiriObstacle_Advance(kiriObstacleData* obstacle, double dt)
{
    double speed = kiriVec3_Length(obstacle->velocity), turn = kiriVec3_Length(obstacle->spin);
    kiriVec3 position = kiriVec3_AddScaled(obstacle->position, dt, obstacle->velocity);
    if (speed > 0.0 && kiriVec3_Length(position) < FARTHEST) {
        obstacle->position = position;
    }
    if (turn > 0.0) {
        kiriMat3 turned = kiriMat3_MulMat(Turn(kiriVec3_Scale(dt, obstacle->spin)), obstacle->rotation);
        obstacle->rotation = kiriMat3_Rotation(turned);
    }
    obstacle->drift += dt * (speed + kiriObstacle_TurnSpeed(obstacle));
}

/* ---- What sheets give it ----------------------------------------------------------------------------------------- */

/* From its own axes to those of the world. */
static kiriMat3 TurnTensor(const kiriMat3* rotation, const kiriMat3* tensor)
{
    const kiriMat3* r = rotation;
    kiriMat3 transposed = { { r->u.x, r->v.x, r->d.x }, { r->u.y, r->v.y, r->d.y }, { r->u.z, r->v.z, r->d.z } };
    return kiriMat3_MulMat(kiriMat3_MulMat(*rotation, *tensor), transposed);
}

kiriYieldRow kiriObstacle_YieldRow(const kiriObstacleData* obstacle)
{
    kiriYieldRow row;
    memset(&row, 0, sizeof(row));
    row.center = kiriObstacle_CenterOfMass(obstacle);
    if (obstacle->mass > 0.0) {
        row.inverseMass = 1.0 / obstacle->mass;
        row.inverseInertia = TurnTensor(&obstacle->rotation, &obstacle->inverseInertia);
    }
    return row;
}

void kiriObstacle_TakeImpulse(kiriObstacleData* obstacle, kiriVec3 impulse, kiriVec3 at)
{
    kiriVec3 arm = kiriVec3_Sub(at, kiriObstacle_CenterOfMass(obstacle));
    obstacle->impulse.force = kiriVec3_Add(obstacle->impulse.force, impulse);
    obstacle->impulse.moment = kiriVec3_Add(obstacle->impulse.moment, kiriVec3_Cross(arm, impulse));
}

bool kiriObstacle_InvertInertia(const float inertia[6], kiriMat3* inverse)
{
    bool stiff[3] = { inertia[0] == 0.0f, inertia[1] == 0.0f, inertia[2] == 0.0f };
    if ((stiff[0] && (inertia[3] != 0.0f || inertia[4] != 0.0f)) ||
        (stiff[1] && (inertia[3] != 0.0f || inertia[5] != 0.0f)) ||
        (stiff[2] && (inertia[4] != 0.0f || inertia[5] != 0.0f))) {
        return false;
    }
    kiriVec3 x = { stiff[0] ? 1.0 : inertia[0], inertia[3], inertia[4] };
    kiriVec3 y = { inertia[3], stiff[1] ? 1.0 : inertia[1], inertia[5] };
    kiriVec3 z = { inertia[4], inertia[5], stiff[2] ? 1.0 : inertia[2] };
    kiriVec3 yz = kiriVec3_Cross(y, z), zx = kiriVec3_Cross(z, x), xy = kiriVec3_Cross(x, y);
    double det = kiriVec3_Dot(x, yz);
    if (!(x.x > 0.0 && x.x * y.y - x.y * y.x > 0.0 && det > 0.0)) {
        return false;
    }
    inverse->u = kiriVec3_Scale(1.0 / det, yz);
    inverse->v = kiriVec3_Scale(1.0 / det, zx);
    inverse->d = kiriVec3_Scale(1.0 / det, xy);
    inverse->u.x = stiff[0] ? 0.0 : inverse->u.x;
    inverse->v.y = stiff[1] ? 0.0 : inverse->v.y;
    inverse->d.z = stiff[2] ? 0.0 : inverse->d.z;
    return true;
}
