#include "kiri_obstacle_shape.h"

/* ---- In the plane of an outline ---- */

typedef struct Nearest2 {
    double distance;
    kiriVec2 normal;
} Nearest2;

static Nearest2 NearestOnDisc(double radius, kiriVec2 p)
{
    double length = kiriVec2_Length(p);
    Nearest2 nearest = { length - radius, kiriVec2_Make(1.0, 0.0) };
    if (length > 0.0) {
        nearest.normal = kiriVec2_Scale(1.0 / length, p);
    }
    return nearest;
}

static double AboveEdge(const kiriObstacleShape* shape, int32_t edge, kiriVec2 p)
{
    return kiriVec2_Dot(shape->normals[edge], kiriVec2_Sub(p, shape->outline[edge]));
}

/* The way from the nearest point of an edge. */
static kiriVec2 FromEdge(const kiriObstacleShape* shape, int32_t edge, kiriVec2 p)
{
    int32_t next = edge + 1 < shape->count ? edge + 1 : 0;
    kiriVec2 a = shape->outline[edge], along = kiriVec2_Sub(shape->outline[next], a);
    double t = kiriVec2_Dot(kiriVec2_Sub(p, a), along) / kiriVec2_Dot(along, along);
    t = kiriClamp(t, 0.0, 1.0);
    return kiriVec2_Sub(p, kiriVec2_Make(a.x + t * along.x, a.y + t * along.y));
}

static Nearest2 NearestOutside(const kiriObstacleShape* shape, kiriVec2 p, Nearest2 highest)
{
    Nearest2 nearest = highest;
    double least = KIRI_ENDLESS;
    for (int32_t i = 0; i < shape->count; ++i) {
        if (AboveEdge(shape, i, p) > 0.0) {
            kiriVec2 way = FromEdge(shape, i, p);
            double length = kiriVec2_Length(way);
            if (length < least) {
                least = length;
                nearest.distance = length;
                nearest.normal = kiriVec2_Scale(1.0 / length, way);
            }
        }
    }
    return nearest;
}

/* A convex polygon is what lies below all of its edges: inside, the highest one is the nearest. */
static Nearest2 NearestOnPolygon(const kiriObstacleShape* shape, kiriVec2 p)
{
    Nearest2 highest = { -KIRI_ENDLESS, { 1.0, 0.0 } };
    for (int32_t i = 0; i < shape->count; ++i) {
        double above = AboveEdge(shape, i, p);
        if (above > highest.distance) {
            highest.distance = above;
            highest.normal = shape->normals[i];
        }
    }
    return highest.distance > 0.0 ? NearestOutside(shape, p, highest) : highest;
}

/* ---- In space ---- */

static kiriVec3 Raise(kiriVec2 normal)
{
    return kiriVec3_Make(normal.x, normal.y, 0.0);
}

/* How far it is out over a face, where only steps in a plane count. */
static double WayOut(double depth, kiriVec3 normal, kiriVec3 across)
{
    double lean = kiriVec3_Dot(normal, across), along = 1.0 - lean * lean;
    return along > 1e-6 ? depth / sqrt(along) : KIRI_ENDLESS;
}

/* Of the faces that a point is below, the one that it is soonest out of. */
static void TryFace(kiriNearest* best, double* way, double distance, kiriVec3 normal, kiriVec3 across)
{
    double out = WayOut(-distance, normal, across);
    if (out < *way) {
        *way = out;
        best->distance = distance;
        best->normal = normal;
    }
}

static kiriNearest NearestInside(const kiriObstacleShape* shape, kiriVec3 p, Nearest2 side, double cap, kiriVec3 across)
{
    kiriNearest best = { side.distance, Raise(side.normal) };
    kiriVec3 up = kiriVec3_Make(0.0, 0.0, p.z < 0.0 ? -1.0 : 1.0);
    double way = 2.0 * KIRI_ENDLESS;
    TryFace(&best, &way, cap, up, across);
    if (shape->type == KIRI_OBSTACLE_CYLINDER) {
        TryFace(&best, &way, side.distance, Raise(side.normal), across);
    }
    for (int32_t i = 0; i < shape->count; ++i) {
        TryFace(&best, &way, AboveEdge(shape, i, kiriVec2_Make(p.x, p.y)), Raise(shape->normals[i]), across);
    }
    return best;
}

/* What an outline sweeps along the third axis, from -half to half. */
static kiriNearest NearestOnColumn(const kiriObstacleShape* shape, kiriVec3 p, kiriVec3 across)
{
    kiriVec2 flat = kiriVec2_Make(p.x, p.y);
    Nearest2 side =
        shape->type == KIRI_OBSTACLE_CYLINDER ? NearestOnDisc(shape->radius, flat) : NearestOnPolygon(shape, flat);
    double cap = fabs(p.z) - shape->half;
    kiriVec3 up = kiriVec3_Make(0.0, 0.0, p.z < 0.0 ? -1.0 : 1.0);
    kiriNearest nearest = { side.distance, Raise(side.normal) };
    if (side.distance > 0.0 && cap > 0.0) {
        nearest.distance = sqrt(side.distance * side.distance + cap * cap);
        nearest.normal = kiriVec3_Scale(1.0 / nearest.distance,
                                        kiriVec3_AddScaled(kiriVec3_Scale(cap, up), side.distance, nearest.normal));
    } else if (cap > 0.0) {
        nearest.distance = cap;
        nearest.normal = up;
    } else if (side.distance <= 0.0) {
        nearest = NearestInside(shape, p, side, cap, across);
    }
    return nearest;
}

/* Any direction across the axis will do in the middle, but one in the sheet's plane. */
static kiriVec3 AnySide(kiriVec3 across)
{
    kiriVec3 x = { 1.0, 0.0, 0.0 }, y = { 0.0, 1.0, 0.0 };
    return fabs(across.x) < 0.8 ? x : y;
}

/* All points so far from a part of the third axis: a capsule, or, where that has no length, a sphere. */
static kiriNearest NearestOnCapsule(const kiriObstacleShape* shape, kiriVec3 p, kiriVec3 across)
{
    double z = kiriClamp(p.z, -shape->half, shape->half);
    kiriVec3 way = kiriVec3_Make(p.x, p.y, p.z - z);
    double length = kiriVec3_Length(way);
    kiriNearest nearest = { length - shape->radius, AnySide(across) };
    if (length > 0.0) {
        nearest.normal = kiriVec3_Scale(1.0 / length, way);
    }
    return nearest;
}

kiriNearest kiriObstacleShape_Nearest(const kiriObstacleShape* shape, kiriVec3 point, kiriVec3 across)
{
    kiriNearest nearest = { point.z, { 0.0, 0.0, 1.0 } };
    if (shape->type == KIRI_OBSTACLE_SPHERE || shape->type == KIRI_OBSTACLE_CAPSULE) {
        nearest = NearestOnCapsule(shape, point, across);
    } else if (shape->type != KIRI_OBSTACLE_PLANE) {
        nearest = NearestOnColumn(shape, point, across);
    }
    nearest.distance -= shape->rounding;
    return nearest;
}

/* Steps as long as the distance never pass the surface. The last of many counts as there: that is a point that slides
   along at a grazing angle. */
double kiriObstacleShape_Enter(const kiriObstacleShape* shape, kiriVec3 from, kiriVec3 move, double gap,
                               kiriVec3 across, kiriNearest* nearest)
{
    enum { MOST_STEPS = 64 };
    double length = kiriVec3_Length(move), gone = 0.0, close = 1e-3 * gap + 1e-9;
    *nearest = kiriObstacleShape_Nearest(shape, from, across);
    for (int step = 0; step < MOST_STEPS && nearest->distance > gap + close; ++step) {
        gone += nearest->distance - gap;
        if (gone >= length) {
            *nearest = kiriObstacleShape_Nearest(shape, kiriVec3_Add(from, move), across);
            return 1.0;
        }
        *nearest = kiriObstacleShape_Nearest(shape, kiriVec3_AddScaled(from, gone / length, move), across);
    }
    return gone > 0.0 ? gone / length : 0.0;
}

double kiriObstacleShape_Reach(const kiriObstacleShape* shape, kiriVec3 direction)
{
    double flat = sqrt(direction.x * direction.x + direction.y * direction.y), reach = shape->half * fabs(direction.z);
    if (shape->type == KIRI_OBSTACLE_PLANE) {
        return KIRI_ENDLESS;
    }
    if (shape->type == KIRI_OBSTACLE_SPHERE || shape->type == KIRI_OBSTACLE_CAPSULE) {
        return reach + shape->radius;
    }
    if (shape->type == KIRI_OBSTACLE_CYLINDER) {
        return reach + shape->radius * flat + shape->rounding;
    }
    double farthest = -KIRI_ENDLESS;
    for (int32_t i = 0; i < shape->count; ++i) {
        double far = kiriVec2_Dot(shape->outline[i], kiriVec2_Make(direction.x, direction.y));
        farthest = kiriMax(far, farthest);
    }
    return reach + farthest + shape->rounding;
}

/* ---- Edges ---- */

#define EVEN_COSINE 0.94 /* of 20 degrees */

int32_t kiriObstacleShape_EdgeCount(const kiriObstacleShape* shape)
{
    bool hasEnd = shape->half < KIRI_ENDLESS;
    if (shape->type == KIRI_OBSTACLE_CYLINDER) {
        return 2;
    }
    return shape->type == KIRI_OBSTACLE_PRISM ? (hasEnd ? 3 : 1) * shape->count : 0;
}

/* The least half width of the outline: half the way through it from its middle on. */
static double HalfWidth(const kiriObstacleShape* shape)
{
    double least = shape->type == KIRI_OBSTACLE_CYLINDER ? 2.0 * shape->radius : KIRI_ENDLESS;
    for (int32_t i = 0; i < shape->count; ++i) {
        double deepest = 0.0;
        for (int32_t k = 0; k < shape->count; ++k) {
            double below = -AboveEdge(shape, i, shape->outline[k]);
            deepest = kiriMax(below, deepest);
        }
        least = kiriMin(deepest, least);
    }
    return 0.5 * least;
}

static bool RimAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleEdge* edge)
{
    double side = index == 0 ? 1.0 : -1.0;
    edge->from = edge->to = kiriVec3_Make(0.0, 0.0, side * shape->half);
    edge->faces[0] = edge->faces[1] = kiriVec3_Make(0.0, 0.0, side);
    edge->radius = shape->radius;
    return true;
}

/* Edges along the axis first, then those around both ends. */
static bool PrismEdgeAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleEdge* edge)
{
    int32_t corner = index % shape->count, next = (corner + 1) % shape->count;
    int32_t last = (corner + shape->count - 1) % shape->count;
    kiriVec2 a = shape->outline[corner], b = shape->outline[next];
    double z = index / shape->count == 1 ? shape->half : -shape->half;
    edge->radius = 0.0;
    edge->faces[0] = Raise(shape->normals[corner]);
    if (index < shape->count) {
        edge->from = kiriVec3_Make(a.x, a.y, -shape->half);
        edge->to = kiriVec3_Make(a.x, a.y, shape->half);
        edge->faces[1] = Raise(shape->normals[last]);
        return kiriVec3_Dot(edge->faces[0], edge->faces[1]) < EVEN_COSINE;
    }
    edge->from = kiriVec3_Make(a.x, a.y, z);
    edge->to = kiriVec3_Make(b.x, b.y, z);
    edge->faces[1] = kiriVec3_Make(0.0, 0.0, z < 0.0 ? -1.0 : 1.0);
    return true;
}

bool kiriObstacleShape_EdgeAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleEdge* edge)
{
    double width = HalfWidth(shape);
    edge->thinnest = kiriMin(width, shape->half);
    return shape->type == KIRI_OBSTACLE_CYLINDER ? RimAt(shape, index, edge) : PrismEdgeAt(shape, index, edge);
}

int32_t kiriObstacleShape_CornerCount(const kiriObstacleShape* shape)
{
    return shape->type == KIRI_OBSTACLE_PRISM && shape->half < KIRI_ENDLESS ? 2 * shape->count : 0;
}

bool kiriObstacleShape_CornerAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleCorner* corner)
{
    kiriObstacleEdge edge;
    bool isSharp = kiriObstacleShape_EdgeAt(shape, index % shape->count, &edge);
    corner->at = index < shape->count ? edge.from : edge.to;
    corner->faces[0] = edge.faces[0];
    corner->faces[1] = edge.faces[1];
    corner->faces[2] = kiriVec3_Make(0.0, 0.0, index < shape->count ? -1.0 : 1.0);
    corner->thinnest = edge.thinnest;
    return isSharp;
}

/* Halves the quarter that holds the point again and again: no sine is needed. */
kiriVec2 kiriCircle_At(int32_t i, int32_t count)
{
    static const kiriVec2 quarters[4] = { { 1.0, 0.0 }, { 0.0, 1.0 }, { -1.0, 0.0 }, { 0.0, -1.0 } };
    int32_t step = count / 4, quarter = i / step, rest = i % step;
    kiriVec2 a = quarters[quarter % 4], b = quarters[(quarter + 1) % 4];
    while (rest > 0) {
        kiriVec2 middle = kiriVec2_Make(a.x + b.x, a.y + b.y);
        middle = kiriVec2_Scale(1.0 / kiriVec2_Length(middle), middle);
        step /= 2;
        if (rest >= step) {
            a = middle;
            rest -= step;
        } else {
            b = middle;
        }
    }
    return a;
}
