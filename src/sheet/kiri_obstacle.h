/* The shapes of obstacles, all convex, in axes of their own: how far a point is, where a moving point enters, and the
   edges and corners that stick out. */
#ifndef KIRI_OBSTACLE_H
#define KIRI_OBSTACLE_H

#include "../core/kiri_array.h"
#include "../core/kiri_vec.h"
#include "../motion/kiri_solver.h"

KIRI_C_BEGIN

/* Far above all coordinates: a plane, or a prism without end, reaches so far. */
#define KIRI_ENDLESS 1e30

typedef struct kiriObstacleShape {
    int32_t type;      /* KIRI_OBSTACLE_...; a box is kept as a prism of four corners */
    double radius;     /* m: of a sphere, capsule or cylinder */
    double half;       /* m: half of the height, KIRI_ENDLESS where a prism has no end */
    double rounding;   /* m */
    kiriVec2* outline; /* of a prism: corners, counter-clockwise, no two in one place, none on the way between two */
    kiriVec2* normals; /* out of the edge from each corner to the next */
    int32_t count;
    double flat; /* m: no point of it is farther from the third axis; KIRI_ENDLESS of a plane */
} kiriObstacleShape;

/* Where a point is: below 0 inside. The normal points out of the obstacle where it is nearest. */
typedef struct kiriNearest {
    double distance;
    kiriVec3 normal;
} kiriNearest;

/* `across` is zero; or, for a sheet that stays in a plane, the unit normal of that plane: then a point inside goes the
   shortest way out within the plane. */
kiriNearest kiriObstacleShape_Nearest(const kiriObstacleShape* shape, kiriVec3 point, kiriVec3 across);

/* Is the point, as far as a cylinder around the shape tells, nearer than `reach`? */
static inline bool kiriObstacleShape_MayReach(const kiriObstacleShape* shape, kiriVec3 point, double reach)
{
    double across = shape->flat + reach, along = shape->half + shape->rounding + reach;
    if (shape->type == KIRI_OBSTACLE_PLANE) {
        return point.z < reach;
    }
    along += shape->type == KIRI_OBSTACLE_CYLINDER ? 0.0 : shape->radius; /* round ends */
    return fabs(point.z) < along && point.x * point.x + point.y * point.y < across * across;
}

/* Where a point that moves straight comes as near as `gap`: the share of its way, 0 where it is so near from the start,
   1 where it does not come so near; and the obstacle there. The point starts at least `gap` off, or share is 0. */
double kiriObstacleShape_Enter(const kiriObstacleShape* shape, kiriVec3 from, kiriVec3 move, double gap,
                               kiriVec3 across, kiriNearest* nearest);

/* How far the shape reaches along a direction (unit) from its origin. */
double kiriObstacleShape_Reach(const kiriObstacleShape* shape, kiriVec3 direction);

/* An edge that sticks out, straight or, as the rims of a cylinder, round. Sheets touch it at points along it. */
typedef struct kiriObstacleEdge {
    kiriVec3 from, to; /* of a straight one; of a rim `from` is its middle */
    kiriVec3 faces[2]; /* normals of the faces beside it; of a rim one, and its radius tells the other */
    double radius;     /* of a rim; 0: straight */
    double thinnest;   /* m: how deep material may be below it and still be meant */
} kiriObstacleEdge;

/* There are this many; edges of a nearly even surface are left out (see kiriObstacleShape_EdgeAt). */
int32_t kiriObstacleShape_EdgeCount(const kiriObstacleShape* shape);

/* False for an edge that is left out: faces beside it turn by less than 20 degrees. */
bool kiriObstacleShape_EdgeAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleEdge* edge);

/* A corner of a prism that ends: three faces meet there. False for one that is nearly even along the outline: the edges
   beside it tell enough. */
typedef struct kiriObstacleCorner {
    kiriVec3 at, faces[3];
    double thinnest; /* as of an edge */
} kiriObstacleCorner;

int32_t kiriObstacleShape_CornerCount(const kiriObstacleShape* shape);
bool kiriObstacleShape_CornerAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleCorner* corner);

/* Point i of `count` (4 times a power of 2) on a circle of radius 1. */
kiriVec2 kiriCircle_At(int32_t i, int32_t count);

/* Obstacles: shapes that stand or move in the world, and what sheets give them. */

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
