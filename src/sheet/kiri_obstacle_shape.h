/* The shapes of obstacles, all convex, in axes of their own: how far a point is, where a moving point enters, and the
   edges and corners that stick out. */
#ifndef KIRI_OBSTACLE_SHAPE_H
#define KIRI_OBSTACLE_SHAPE_H

#include "../core/kiri_array.h"
#include "../core/kiri_vec.h"

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

KIRI_C_END

#endif
