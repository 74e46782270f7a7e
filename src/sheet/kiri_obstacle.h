/* Obstacles: shapes that stand or move in the world, and what sheets give them. */
#ifndef KIRI_OBSTACLE_H
#define KIRI_OBSTACLE_H

#include "../motion/kiri_contact.h"
#include "kiri_obstacle_shape.h"

KIRI_C_BEGIN

typedef struct kiriObstacleData {
    kiriObstacle id;
    kiriObstacleShape shape;
    kiriVec3 position;
    kiriMat3 rotation;
    kiriVec3 velocity, spin; /* m/s of its position, rad/s */
    kiriVec3 surface;        /* m/s: of its surface beside that */
    double friction;
    double mass;             /* kg; 0: nothing moves it */
    kiriMat3 inverseInertia; /* 1/(kg m^2), in its own axes */
    kiriVec3 center;         /* m, in its own axes: of mass, from its position */
    uint32_t body;           /* obstacles with the same number, but 0, share what sheets give them */
    double pushSpeed;        /* m/s */
    uint32_t groups;

    kiriWrench
        impulse;      /* N s, N m s about its centre of mass then: from sheets and pins in this tick, or the last one */
    int32_t contacts; /* of the same tick */

    /* For sheets that sleep. */
    double drift; /* m: how far it went, by its farthest point, since those near it woke last; KIRI_ENDLESS: new */

    /* Around it, m, with the way that it goes in the tick: as kiriObstacle_Bound found it. */
    kiriVec3 lower, upper;
} kiriObstacleData;

/* Zeroed, with its outline of so many corners behind it, in one block. Null for memory. */
kiriObstacleData* kiriObstacle_Alloc(kiriMemory* memory, int32_t corners);

static inline bool kiriObstacle_IsMovable(const kiriObstacleData* obstacle)
{
    return obstacle->mass > 0.0;
}

static inline kiriVec3 kiriObstacle_ToLocal(const kiriObstacleData* obstacle, kiriVec3 direction)
{
    return kiriVec3_Make(kiriVec3_Dot(obstacle->rotation.u, direction), kiriVec3_Dot(obstacle->rotation.v, direction),
                         kiriVec3_Dot(obstacle->rotation.d, direction));
}

static inline kiriVec3 kiriObstacle_PointToLocal(const kiriObstacleData* obstacle, kiriVec3 point)
{
    return kiriObstacle_ToLocal(obstacle, kiriVec3_Sub(point, obstacle->position));
}

static inline kiriVec3 kiriObstacle_ToWorld(const kiriObstacleData* obstacle, kiriVec3 local)
{
    return kiriMat3_Mul(obstacle->rotation, local);
}

static inline kiriVec3 kiriObstacle_PointToWorld(const kiriObstacleData* obstacle, kiriVec3 local)
{
    return kiriVec3_Add(obstacle->position, kiriMat3_Mul(obstacle->rotation, local));
}

/* m/s: of its material at a point, without what its surface does beside. */
static inline kiriVec3 kiriObstacle_VelocityAt(const kiriObstacleData* obstacle, kiriVec3 point)
{
    return kiriVec3_Add(obstacle->velocity, kiriVec3_Cross(obstacle->spin, kiriVec3_Sub(point, obstacle->position)));
}

static inline kiriVec3 kiriObstacle_CenterOfMass(const kiriObstacleData* obstacle)
{
    return kiriObstacle_PointToWorld(obstacle, obstacle->center);
}

/* m/s: no point of it goes faster by its turning; of a plane, and of what has no end, as far as 1 km out. */
double kiriObstacle_TurnSpeed(const kiriObstacleData* obstacle);

/* Writes lower and upper for a tick of dt. */
void kiriObstacle_Bound(kiriObstacleData* obstacle, double dt);

/* Does the box come nearer than `reach` to it, as far as boxes tell, and planes? */
bool kiriObstacle_IsNear(const kiriObstacleData* obstacle, kiriVec3 lower, kiriVec3 upper, double reach);

/* The body that it is a part of, as contacts see it; nothing has been given to it yet. */
kiriYieldRow kiriObstacle_YieldRow(const kiriObstacleData* obstacle);

/* Takes an impulse (N s) that a sheet or a pin gives it at a point. */
void kiriObstacle_TakeImpulse(kiriObstacleData* obstacle, kiriVec3 impulse, kiriVec3 at);

/* It goes on with its velocities. */
void kiriObstacle_Advance(kiriObstacleData* obstacle, double dt);

/* The inverse of inertia xx yy zz xy xz yz; an axis with a zero on the diagonal does not turn. False where that is no
   inertia: the products on such an axis are not zero, or what is left is not positive definite. */
bool kiriObstacle_InvertInertia(const float inertia[6], kiriMat3* inverse);

KIRI_C_END

#endif
