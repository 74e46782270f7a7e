/* Convex shapes of obstacles, in local axes: distance of a point, entry of a moving point, and convex edges and
   corners. */
#ifndef KIRI_OBSTACLE_H
#define KIRI_OBSTACLE_H

#include "../core/kiri_array.h"
#include "../core/kiri_vec.h"
#include "../motion/kiri_solver.h"
#include "../core/kiri_archive.h"

KIRI_C_BEGIN

/* Extent of planes and infinite prisms, m: far above all coordinates. */
#define KIRI_ENDLESS 1e30

typedef struct kiriObstacleShape {
    int32_t type;      /* KIRI_OBSTACLE_...; a box is kept as a prism of four corners */
    double radius;     /* m: sphere, capsule or cylinder */
    double half;       /* m: half height; KIRI_ENDLESS for an infinite prism */
    double rounding;   /* m: radius added around the shape */
    kiriVec2* outline; /* prism: corners, counter-clockwise, without duplicate or collinear ones */
    kiriVec2* normals; /* outward normal of the edge from each corner to the next */
    int32_t count;     /* of corners */
    double flat; /* m: largest distance of a point from the third axis; KIRI_ENDLESS for a plane */
} kiriObstacleShape;

/* Signed distance of a point (m, below 0 inside), and the outward normal at the nearest point of the surface. */
typedef struct kiriNearest {
    double distance;
    kiriVec3 normal;
} kiriNearest;

/* Finds the nearest point of the surface. `across` is zero; or the unit normal of the plane of a planar sheet: then a
   point inside leaves by the shortest way within the plane. */
kiriNearest kiriObstacleShape_Nearest(const kiriObstacleShape* shape, kiriVec3 point, kiriVec3 across);

/* Returns true if the point is within `reach` (m) of a cylinder around the shape. */
static inline bool kiriObstacleShape_MayReach(const kiriObstacleShape* shape, kiriVec3 point, double reach)
{
    double across = shape->flat + reach, along = shape->half + shape->rounding + reach;
    if (shape->type == KIRI_OBSTACLE_PLANE) {
        return point.z < reach;
    }
    along += shape->type == KIRI_OBSTACLE_CYLINDER ? 0.0 : shape->radius; /* round ends */
    return fabs(point.z) < along && point.x * point.x + point.y * point.y < across * across;
}

/* Finds where a point on a straight move comes within `gap` (m) of the shape. Returns the fraction of the move: 0 if it
   starts within `gap`, 1 if it never comes that near. *nearest is the surface there. */
double kiriObstacleShape_Enter(const kiriObstacleShape* shape, kiriVec3 from, kiriVec3 move, double gap,
                               kiriVec3 across, kiriNearest* nearest);

/* Returns the extent of the shape from its origin along a unit direction, m (support function). */
double kiriObstacleShape_Reach(const kiriObstacleShape* shape, kiriVec3 direction);

/* A convex edge: straight, or the round rim of a cylinder. Sheets touch it at points along it. */
typedef struct kiriObstacleEdge {
    kiriVec3 from, to; /* ends of a straight edge; for a rim `from` is the center */
    kiriVec3 faces[2]; /* normals of the adjacent faces; for a rim only the first, the other is radial */
    double radius;     /* m: of a rim; 0: straight */
    double thinnest;   /* m: largest depth at which material below the edge still counts as a touch */
} kiriObstacleEdge;

/* Returns the count of edges, including the nearly flat ones that kiriObstacleShape_EdgeAt skips. */
int32_t kiriObstacleShape_EdgeCount(const kiriObstacleShape* shape);

/* Returns false for a nearly flat edge: the angle between its faces is less than 20 degrees. */
bool kiriObstacleShape_EdgeAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleEdge* edge);

/* Returns point i of `count` (4 times a power of 2) on the unit circle. */
kiriVec2 kiriCircle_At(int32_t i, int32_t count);

/* Obstacles: shapes in the world, their motion, and the impulses of sheets on them. */

typedef struct kiriObstacleData {
    kiriObstacle id;
    kiriObstacleShape shape;
    kiriVec3 position;
    kiriMat3 rotation;
    kiriVec3 velocity, spin; /* m/s, at `position`; rad/s */
    kiriVec3 surface;        /* m/s: added velocity of the surface, as of a conveyor belt */
    double friction;
    double mass;             /* kg; 0: immovable */
    kiriMat3 inverseInertia; /* 1/(kg m^2), local */
    kiriVec3 center;         /* m, local: center of mass relative to `position` */
    uint32_t body;           /* obstacles with the same nonzero number are one rigid body */
    double pushSpeed;        /* m/s */
    uint32_t groups;

    kiriVec3 was;     /* m/s: velocity of the center of mass in the last tick, before sheets changed it */
    kiriWrench
        impulse;      /* N s, N m s about the center of mass: from sheets and pins in this tick, or the last one */
    int32_t contacts; /* count in the same tick */

    /* For sleeping sheets. */
    double drift; /* m: motion of its farthest point since it last woke sheets nearby; KIRI_ENDLESS: new */

    /* Bounding box, m, including its motion in the tick. Written by kiriObstacle_Bound. */
    kiriVec3 lower, upper;
} kiriObstacleData;

/* Allocates a zeroed obstacle and its outline of `corners` corners in one block. Returns null on out of memory. */
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

/* Returns the rigid velocity at a point, m/s, without `surface`. */
static inline kiriVec3 kiriObstacle_VelocityAt(const kiriObstacleData* obstacle, kiriVec3 point)
{
    return kiriVec3_Add(obstacle->velocity, kiriVec3_Cross(obstacle->spin, kiriVec3_Sub(point, obstacle->position)));
}

static inline kiriVec3 kiriObstacle_CenterOfMass(const kiriObstacleData* obstacle)
{
    return kiriObstacle_PointToWorld(obstacle, obstacle->center);
}

/* Returns an upper bound of the speed by rotation, m/s. For infinite shapes it covers 1 km from the position. */
double kiriObstacle_TurnSpeed(const kiriObstacleData* obstacle);

/* Writes lower and upper for a tick of dt. */
void kiriObstacle_Bound(kiriObstacleData* obstacle, double dt);

/* Returns true if the box is within `reach` (m) of the bounding box, or of the plane. */
bool kiriObstacle_IsNear(const kiriObstacleData* obstacle, kiriVec3 lower, kiriVec3 upper, double reach);

/* Returns the yield row of its body for contacts, without impulses. */
kiriYieldRow kiriObstacle_YieldRow(const kiriObstacleData* obstacle);

/* Adds an impulse (N s) of a sheet or a pin at a point. */
void kiriObstacle_TakeImpulse(kiriObstacleData* obstacle, kiriVec3 impulse, kiriVec3 at);

/* Moves the obstacle by its velocities over dt (s). */
void kiriObstacle_Advance(kiriObstacleData* obstacle, double dt);

/* Inverts inertia xx yy zz xy xz yz. An axis with a zero diagonal is locked. Returns false for an invalid inertia:
   nonzero products on a locked axis, or not positive definite on the others. */
bool kiriObstacle_InvertInertia(const float inertia[6], kiriMat3* inverse);

/* Saves one obstacle, or creates one from a save. */
void kiriObstacle_Archive(kiriArchive* archive, kiriObstacleData** obstacle, kiriMemory* memory);

KIRI_C_END

#endif
