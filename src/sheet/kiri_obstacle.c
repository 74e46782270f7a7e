#include "kiri_obstacle.h"
#include "kiri_seen.h"
#include "kiri_touch.h"
#include "../core/kiri_array.h"

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

/* ---- Bounds and motion ------------------------------------------------------------------------------------------- */

/* Lever up to which the rotation of an infinite shape counts, m. */
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

/* Computes the bounds along a world axis, including the motion in the tick. */
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

bool kiriObstacle_IsNear(const kiriObstacleData* obstacle, kiriVec3 lower, kiriVec3 upper, double reach)
{
    if (obstacle->shape.type == KIRI_OBSTACLE_PLANE) {
        kiriVec3 n = obstacle->rotation.d; /* the lowest corner of the box counts */
        kiriVec3 lowest = { n.x > 0.0 ? lower.x : upper.x, n.y > 0.0 ? lower.y : upper.y,
                            n.z > 0.0 ? lower.z : upper.z };
        return kiriVec3_Dot(n, kiriVec3_Sub(lowest, obstacle->position)) < reach;
    }
    return lower.x - reach < obstacle->upper.x && lower.y - reach < obstacle->upper.y &&
           lower.z - reach < obstacle->upper.z && upper.x + reach > obstacle->lower.x &&
           upper.y + reach > obstacle->lower.y && upper.z + reach > obstacle->lower.z;
}

/* An obstacle farther from the origin does not move, m. */
#define FARTHEST 1e30

void kiriObstacle_Advance(kiriObstacleData* obstacle, double dt)
{
    double speed = kiriVec3_Length(obstacle->velocity), turn = kiriVec3_Length(obstacle->spin);
    kiriVec3 position = kiriVec3_AddScaled(obstacle->position, dt, obstacle->velocity);
    if (speed > 0.0 && kiriVec3_Length(position) < FARTHEST) {
        obstacle->position = position;
    }
    if (turn > 0.0) {
        /* The Cayley map alone turns by 2 atan(angle / 2); so the angle is of fourth order. */
        kiriVec3 w = kiriVec3_Scale(dt, obstacle->spin);
        double half = 0.25 * kiriVec3_Dot(w, w); /* square of half the angle */
        double stretch = 1.0 + half * (1.0 / 3.0 + half * (2.0 / 15.0));
        kiriMat3 by = kiriMat3_Cayley(kiriVec3_Scale(stretch, w));
        obstacle->rotation = kiriMat3_Rotation(kiriMat3_MulMat(by, obstacle->rotation));
    }
    obstacle->drift += dt * (speed + kiriObstacle_TurnSpeed(obstacle));
}

/* ---- Impulses ---------------------------------------------------------------------------------------------------- */

kiriYieldRow kiriObstacle_YieldRow(const kiriObstacleData* obstacle)
{
    kiriYieldRow row = { 0 };
    row.center = kiriObstacle_CenterOfMass(obstacle);
    if (obstacle->mass > 0.0) {
        row.inverseMass = 1.0 / obstacle->mass;
        const kiriMat3* r = &obstacle->rotation;
        kiriMat3 transposed = { { r->u.x, r->v.x, r->d.x }, { r->u.y, r->v.y, r->d.y }, { r->u.z, r->v.z, r->d.z } };
        row.inverseInertia = kiriMat3_MulMat(kiriMat3_MulMat(*r, obstacle->inverseInertia), transposed);
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

/* ---- In the plane of an outline ---- */

typedef struct Nearest2 {
    double distance;
    kiriVec2 normal;
} Nearest2;

static double AboveEdge(const kiriObstacleShape* shape, int32_t edge, kiriVec2 p)
{
    return kiriVec2_Dot(shape->normals[edge], kiriVec2_Sub(p, shape->outline[edge]));
}

static Nearest2 NearestOutside(const kiriObstacleShape* shape, kiriVec2 p, Nearest2 highest)
{
    Nearest2 nearest = highest;
    double least = KIRI_ENDLESS;
    KIRI_EACH_INDEX(i, *shape) {
        if (AboveEdge(shape, i, p) > 0.0) {
            int32_t next = i + 1 < shape->count ? i + 1 : 0;
            kiriVec2 a = shape->outline[i], along = kiriVec2_Sub(shape->outline[next], a);
            double t = kiriVec2_Dot(kiriVec2_Sub(p, a), along) / kiriVec2_Dot(along, along);
            t = kiriClamp(t, 0.0, 1.0);
            kiriVec2 way = kiriVec2_Sub(p, kiriVec2_AddScaled(a, t, along));
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

/* Finds the nearest point of a convex polygon. A point inside is below all edges, and the highest edge is nearest. */
static Nearest2 NearestOnPolygon(const kiriObstacleShape* shape, kiriVec2 p)
{
    Nearest2 highest = { -KIRI_ENDLESS, { 1.0, 0.0 } };
    KIRI_EACH_INDEX(i, *shape) {
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

/* Takes a face if it is the shortest way out so far, along the plane with normal `across`. */
static void TryFace(kiriNearest* best, double* way, double distance, kiriVec3 normal, kiriVec3 across)
{
    double lean = kiriVec3_Dot(normal, across), along = 1.0 - lean * lean;
    double out = along > 1e-6 ? -distance / sqrt(along) : KIRI_ENDLESS;
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
    KIRI_EACH_INDEX(i, *shape) {
        TryFace(&best, &way, AboveEdge(shape, i, kiriVec2_Make(p.x, p.y)), Raise(shape->normals[i]), across);
    }
    return best;
}

/* Finds the nearest point of an outline extruded along the third axis, from -half to half. */
static kiriNearest NearestOnColumn(const kiriObstacleShape* shape, kiriVec3 p, kiriVec3 across)
{
    kiriVec2 flat = kiriVec2_Make(p.x, p.y);
    double length = kiriVec2_Length(flat);
    Nearest2 side = { length - shape->radius, { 1.0, 0.0 } };
    if (shape->type != KIRI_OBSTACLE_CYLINDER) {
        side = NearestOnPolygon(shape, flat);
    } else if (length > 0.0) {
        side.normal = kiriVec2_Scale(1.0 / length, flat);
    }
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

/* Finds the nearest point of a capsule along the third axis; of a sphere if half is 0. A point on the axis gets any normal
   that is not normal to the sheet's plane. */
static kiriNearest NearestOnCapsule(const kiriObstacleShape* shape, kiriVec3 p, kiriVec3 across)
{
    double z = kiriClamp(p.z, -shape->half, shape->half);
    kiriVec3 way = kiriVec3_Make(p.x, p.y, p.z - z);
    double length = kiriVec3_Length(way);
    kiriNearest nearest = { length - shape->radius, { 1.0, 0.0, 0.0 } };
    if (length > 0.0) {
        nearest.normal = kiriVec3_Scale(1.0 / length, way);
    } else if (!(fabs(across.x) < 0.8)) {
        nearest.normal = kiriVec3_Make(0.0, 1.0, 0.0);
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

/* Sphere tracing: a step as long as the distance never crosses the surface. The point after MOST_STEPS counts as the
   entry: it moves at a grazing angle. */
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
    KIRI_EACH_INDEX(i, *shape) {
        double far = kiriVec2_Dot(shape->outline[i], kiriVec2_Make(direction.x, direction.y));
        farthest = kiriMax(far, farthest);
    }
    return reach + farthest + shape->rounding;
}

/* ---- Edges ---- */

#define EVEN_COSINE 0.94 /* cosine of 20 degrees */

int32_t kiriObstacleShape_EdgeCount(const kiriObstacleShape* shape)
{
    bool hasEnd = shape->half < KIRI_ENDLESS;
    if (shape->type == KIRI_OBSTACLE_CYLINDER) {
        return 2;
    }
    return shape->type == KIRI_OBSTACLE_PRISM ? (hasEnd ? 3 : 1) * shape->count : 0;
}

/* Returns half of the smallest width of the outline. */
static double HalfWidth(const kiriObstacleShape* shape)
{
    double least = shape->type == KIRI_OBSTACLE_CYLINDER ? 2.0 * shape->radius : KIRI_ENDLESS;
    KIRI_EACH_INDEX(i, *shape) {
        double deepest = 0.0;
        KIRI_EACH_INDEX(k, *shape) {
            double below = -AboveEdge(shape, i, shape->outline[k]);
            deepest = kiriMax(below, deepest);
        }
        least = kiriMin(deepest, least);
    }
    return 0.5 * least;
}

/* Returns edge `index` of a prism: first the edges along the axis, then the edges of both ends. */
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
    if (shape->type != KIRI_OBSTACLE_CYLINDER) {
        return PrismEdgeAt(shape, index, edge);
    }
    double side = index == 0 ? 1.0 : -1.0;
    edge->from = edge->to = kiriVec3_Make(0.0, 0.0, side * shape->half);
    edge->faces[0] = edge->faces[1] = kiriVec3_Make(0.0, 0.0, side);
    edge->radius = shape->radius;
    return true;
}

static int32_t CornerCount(const kiriObstacleShape* shape)
{
    return shape->type == KIRI_OBSTACLE_PRISM && shape->half < KIRI_ENDLESS ? 2 * shape->count : 0;
}

static bool CornerAt(const kiriObstacleShape* shape, int32_t index, kiriObstacleCorner* corner)
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

/* Bisects the quarter that contains the point; needs no sine. */
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

static kiriVec3 BlendOfThree(const kiriVec3 x[3], const double share[3])
{
    return kiriVec3_AddScaled(kiriVec3_AddScaled(kiriVec3_Scale(share[0], x[0]), share[1], x[1]), share[2], x[2]);
}

/* Computes the barycentric coordinates of the point of a triangle nearest to p: its projection, or on a side. */
static void NearestOfTriangle(const kiriVec3 x[3], kiriVec3 p, double share[3])
{
    kiriVec3 ab = kiriVec3_Sub(x[1], x[0]), ac = kiriVec3_Sub(x[2], x[0]), to = kiriVec3_Sub(p, x[0]);
    kiriVec3 n = kiriVec3_Cross(ab, ac);
    double square = kiriVec3_Dot(n, n), least = KIRI_ENDLESS;
    share[1] = kiriVec3_Dot(n, kiriVec3_Cross(to, ac)) / square;
    share[2] = kiriVec3_Dot(n, kiriVec3_Cross(ab, to)) / square;
    share[0] = 1.0 - share[1] - share[2];
    if (square > 0.0 && share[0] >= 0.0 && share[1] >= 0.0 && share[2] >= 0.0) {
        return;
    }
    KIRI_EACH_CORNER(k) {
        int next = (k + 1) % 3;
        kiriVec3 along = kiriVec3_Sub(x[next], x[k]);
        double side = kiriVec3_Dot(along, along),
               t = side > 0.0 ? kiriVec3_Dot(kiriVec3_Sub(p, x[k]), along) / side : 0.0;
        t = kiriClamp(t, 0.0, 1.0);
        double far = kiriVec3_Distance(kiriVec3_AddScaled(kiriVec3_Scale(1.0 - t, x[k]), t, x[next]), p);
        if (far < least) {
            least = far;
            share[k] = 1.0 - t;
            share[next] = t;
            share[3 - k - next] = 0.0;
        }
    }
}

/* Finds the point of a triangle nearest to the axis of a round obstacle, by alternating projections. Both are convex,
   so they converge. */
static void NearestToAxis(double half, const kiriVec3 x[3], double share[3])
{
    enum { TURNS = 24 };
    kiriVec3 onAxis = { 0 };
    for (int turn = 0; turn < TURNS; ++turn) {
        NearestOfTriangle(x, onAxis, share);
        double z = BlendOfThree(x, share).z;
        onAxis.z = kiriClamp(z, -half, half);
        if (half <= 0.0) {
            return;
        }
    }
}

/* Returns true for a point that is not a vertex; in a planar sheet, only for a point on the border. */
static bool CountsBetween(const kiriMeeting* meeting, const int32_t* v, const double share[3])
{
    int zero = share[0] <= 0.0 ? 0 : share[1] <= 0.0 ? 1 : share[2] <= 0.0 ? 2 : KIRI_NONE;
    if (share[0] >= 1.0 || share[1] >= 1.0 || share[2] >= 1.0) {
        return false;
    }
    if (!meeting->sheet->settings.mechanics.planar) {
        return true;
    }
    return zero != KIRI_NONE && kiriMeeting_IsBorder(&meeting->sheet->seen.surface, &meeting->search->triangles,
                                                     v[(zero + 1) % 3], v[(zero + 2) % 3]);
}

/* Computes the corners of a triangle in the axes of the obstacle. */
static void GetCorners(const kiriMeeting* meeting, int32_t triangle, kiriVec3 x[3])
{
    const kiriSurface* surface = &meeting->sheet->seen.surface;
    KIRI_EACH_CORNER(k) {
        x[k] = kiriObstacle_PointToLocal(meeting->obstacle,
                                         kiriSurface_At(surface, kiriSurface_Triangle(surface, triangle)[k]));
    }
}

static bool TouchRound(const kiriMeeting* meeting, int32_t triangle, kiriTouch* touch)
{
    const kiriSheetData* sheet = meeting->sheet;
    const kiriObstacleData* obstacle = meeting->obstacle;
    const int32_t* v = kiriSurface_Triangle(&sheet->seen.surface, triangle);
    kiriVec3 x[3], velocity = { 0 };
    double share[3];
    GetCorners(meeting, triangle, x);
    NearestToAxis(obstacle->shape.half, x, share);
    if (!CountsBetween(meeting, v, share)) {
        return false;
    }
    KIRI_EACH_CORNER(k) {
        velocity = kiriVec3_AddScaled(velocity, share[k], kiriMeeting_VertexVelocity(sheet, v[k]));
    }
    kiriVec3 local = BlendOfThree(x, share);
    kiriNearest nearest = kiriObstacleShape_Nearest(&obstacle->shape, local, meeting->across);
    kiriVec3 normal = kiriObstacle_ToWorld(obstacle, nearest.normal);
    double rise = kiriVec3_Dot(normal, kiriMeeting_Way(meeting, kiriObstacle_PointToWorld(obstacle, local), velocity));
    kiriVec3 on = kiriObstacle_PointToWorld(obstacle, kiriVec3_AddScaled(local, -nearest.distance, nearest.normal));
    if (nearest.distance + rise > (1.0 + KIRI_NEARBY) * meeting->gap ||
        !kiriMeeting_MakePlane(meeting, normal, on, meeting->gap, touch)) {
        return false;
    }
    kiriMeeting_SetPlace(touch, v, share, 3);
    return true;
}

/* Lists the coarse triangles nearby, ascending: a side is so long that an arc of the obstacle fits between its ends. */
static bool CollectCoarse(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    bool ok = true;
    search->crossed.count = 0;
    KIRI_EACH_WHILE(ok, const int32_t, at, search->triangles) {
        kiriVec3 x[3];
        double longest = 0.0;
        GetCorners(meeting, *at, x);
        KIRI_EACH_CORNER(k) {
            double length = kiriVec3_Distance(x[(k + 1) % 3], x[k]);
            longest = kiriMax(length, longest);
        }
        bool isCoarse = longest * longest > 16.0 * meeting->gap * meeting->obstacle->shape.radius;
        ok = !isCoarse || kiriArray_Push(search->memory, &search->crossed, *at);
    }
    if (search->crossed.count > 0) {
        kiriSort(search->crossed.data, search->crossed.count, NULL, NULL);
    }
    return ok;
}

bool kiriMeeting_TouchRounds(const kiriMeeting* meeting)
{
    const kiriIndices* coarse = &meeting->search->crossed;
    if (!(meeting->obstacle->shape.radius > 0.0)) {
        return true;
    }
    bool ok = CollectCoarse(meeting);
    KIRI_EACH_WHILE(ok, const int32_t, triangle, *coarse) {
        kiriTouch touch;
        if (TouchRound(meeting, *triangle, &touch)) {
            touch.key = kiriMeeting_Key(meeting, true, KIRI_ROUND_ITEM | (uint32_t)*triangle);
            ok = kiriTouches_Add(meeting->sheet, &touch);
        }
    }
    return ok;
}

#define LINE_SLACK 1e-9 /* m: tolerance, so that a line in the side of a box meets it */

/* A point on an edge or a corner, in the world. */
typedef struct EdgePoint {
    kiriVec3 at, out; /* out: unit bisector of the faces' normals */
    kiriVec3 faces[3];
    int32_t faceCount;
    double below, above; /* m: search range along `out` */
    uint32_t item;
} EdgePoint;

/* Intersects the line of the point with a triangle. Returns false if it misses. */
static bool MeetsTriangle(const kiriVec3 x[3], const EdgePoint* point, double* height, double share[3])
{
    kiriVec3 ab = kiriVec3_Sub(x[1], x[0]), ac = kiriVec3_Sub(x[2], x[0]), to = kiriVec3_Sub(point->at, x[0]);
    kiriVec3 across = kiriVec3_Cross(point->out, ac), other = kiriVec3_Cross(to, ab);
    double det = kiriVec3_Dot(ab, across);
    if (!(fabs(det) > 0.0)) {
        return false;
    }
    share[1] = kiriVec3_Dot(to, across) / det;
    share[2] = kiriVec3_Dot(point->out, other) / det;
    share[0] = 1.0 - share[1] - share[2];
    *height = kiriVec3_Dot(ac, other) / det;
    return share[0] >= 0.0 && share[1] >= 0.0 && share[2] >= 0.0 && *height > -point->below && *height < point->above;
}

/* Returns true if the normal can be of a tangent plane at the edge: it opposes none of the faces. */
static bool IsTangentTo(const EdgePoint* point, kiriVec3 normal)
{
    for (int32_t k = 0; k < point->faceCount; ++k) {
        if (kiriVec3_Dot(normal, point->faces[k]) < -0.2) {
            return false;
        }
    }
    return true;
}

static bool TouchTriangle(const kiriMeeting* meeting, const EdgePoint* point, int32_t triangle, kiriTouch* touch)
{
    kiriSheetData* sheet = meeting->sheet;
    kiriSurface* surface = &sheet->seen.surface;
    const int32_t* v = kiriSurface_Triangle(surface, triangle);
    kiriVec3 x[3] = { kiriSurface_At(surface, v[0]), kiriSurface_At(surface, v[1]), kiriSurface_At(surface, v[2]) };
    double height, share[3], gap = meeting->gap + meeting->obstacle->shape.rounding;
    if (!MeetsTriangle(x, point, &height, share)) {
        return false;
    }
    kiriVec3 sum = { 0 }, velocity = sum, at = kiriVec3_AddScaled(point->at, height, point->out);
    kiriSurface_NeedNormals(surface);
    KIRI_EACH_CORNER(k) {
        sum = kiriVec3_AddScaled(sum, share[k], kiriVertex_SkinNormal(sheet, v[k]));
        velocity = kiriVec3_AddScaled(velocity, share[k], kiriMeeting_VertexVelocity(sheet, v[k]));
    }
    /* The interpolated surface normal, on the side of `out`. */
    kiriVec3 normal = kiriVec3_Scale(kiriVec3_Dot(sum, point->out) < 0.0 ? -1.0 : 1.0, kiriVec3_Normalize(sum));
    double above = height * kiriVec3_Dot(normal, point->out) - gap;
    double rise = kiriVec3_Dot(normal, kiriMeeting_Way(meeting, at, velocity));
    if (above + rise > KIRI_NEARBY * gap || !IsTangentTo(point, normal) ||
        !kiriMeeting_MakePlane(meeting, normal, point->at, gap, touch)) {
        return false;
    }
    kiriMeeting_SetPlace(touch, v, share, 3);
    return true;
}

/* Returns true if the line of the point meets a box (slab test). */
static bool MeetsLine(const void* context, const kiriBox* box)
{
    const EdgePoint* point = context;
    const double at[3] = { point->at.x, point->at.y, point->at.z },
                 out[3] = { point->out.x, point->out.y, point->out.z };
    const double lower[3] = { box->lower.x, box->lower.y, box->lower.z };
    const double upper[3] = { box->upper.x, box->upper.y, box->upper.z };
    double from = -point->below, to = point->above;
    for (int k = 0; k < 3; ++k) {
        double low = lower[k] - at[k] - LINE_SLACK, high = upper[k] - at[k] + LINE_SLACK;
        if (fabs(out[k]) < 1e-12) {
            to = low > 0.0 || high < 0.0 ? from - 1.0 : to;
            continue;
        }
        double enter = (out[k] > 0.0 ? low : high) / out[k], leave = (out[k] > 0.0 ? high : low) / out[k];
        from = kiriMax(enter, from);
        to = kiriMin(leave, to);
    }
    return from <= to;
}

/* Lists the triangles that the line of the point meets, ascending, so that layers get the same keys in each tick. */
static bool FindCrossed(const kiriMeeting* meeting, const EdgePoint* point)
{
    const kiriSurface* surface = &meeting->sheet->seen.surface;
    kiriIndices* crossed = &meeting->search->crossed;
    int32_t kept = 0;
    crossed->count = 0;
    if (!kiriBounds_FindLeaves(meeting->sheet->seen.bounds, surface, MeetsLine, point, 0, meeting->search->memory,
                               crossed)) {
        return false;
    }
    KIRI_EACH(const int32_t, triangle, *crossed) {
        const int32_t* v = kiriSurface_Triangle(surface, *triangle);
        kiriVec3 x[3] = { kiriSurface_At(surface, v[0]), kiriSurface_At(surface, v[1]), kiriSurface_At(surface, v[2]) };
        double height, share[3];
        if (MeetsTriangle(x, point, &height, share)) {
            crossed->data[kept++] = *triangle;
        }
    }
    crossed->count = kept;
    if (kept > 1) {
        kiriSort(crossed->data, kept, NULL, NULL);
    }
    return true;
}

/* Adds a touch for each layer over a point, up to MOST_LAYERS. */
static bool TouchPoint(const kiriMeeting* meeting, const EdgePoint* point)
{
    enum { MOST_LAYERS = 4 };
    const kiriIndices* crossed = &meeting->search->crossed;
    bool ok = FindCrossed(meeting, point);
    uint32_t layers = 0;
    KIRI_EACH_WHILE(ok && layers < MOST_LAYERS, const int32_t, triangle, *crossed) {
        kiriTouch touch;
        if (TouchTriangle(meeting, point, *triangle, &touch)) {
            touch.key = kiriMeeting_Key(meeting, true, point->item * MOST_LAYERS + layers++);
            ok = kiriTouches_Add(meeting->sheet, &touch);
        }
    }
    return ok;
}

/* Makes a point from local coordinates of the obstacle. */
static EdgePoint MakePoint(const kiriMeeting* meeting, kiriVec3 at, const kiriVec3* faces, int32_t faceCount,
                           double thinnest)
{
    const kiriObstacleData* obstacle = meeting->obstacle;
    kiriVec3 sum = { 0 };
    EdgePoint point;
    point.at = kiriObstacle_PointToWorld(obstacle, at);
    point.faceCount = faceCount;
    for (int32_t k = 0; k < faceCount; ++k) {
        point.faces[k] = kiriObstacle_ToWorld(obstacle, faces[k]);
        sum = kiriVec3_Add(sum, point.faces[k]);
    }
    point.out = kiriVec3_Normalize(sum);
    point.below = kiriMin(thinnest, meeting->square);
    point.above = obstacle->shape.rounding + meeting->gap + meeting->reach;
    point.item = 0;
    return point;
}

static bool TouchRim(const kiriMeeting* meeting, const kiriObstacleEdge* edge, int32_t index)
{
    int32_t count = 8;
    while (count < 1024 && count * meeting->square < 6.3 * edge->radius) {
        count *= 2;
    }
    bool ok = true;
    for (int32_t i = 0; ok && i < count; ++i) {
        kiriVec2 circle = kiriCircle_At(i, count);
        kiriVec3 faces[2] = { edge->faces[0], { circle.x, circle.y, 0.0 } };
        EdgePoint point =
            MakePoint(meeting, kiriVec3_AddScaled(edge->from, edge->radius, faces[1]), faces, 2, edge->thinnest);
        point.item = (uint32_t)(index * 1024 + i);
        ok = TouchPoint(meeting, &point);
    }
    return ok;
}

/* Clips the steps of an edge to the sheet's box. */
static void ClipEdge(const kiriMeeting* meeting, kiriVec3 from, kiriVec3 step, int32_t* first, int32_t* last)
{
    kiriBox box = kiriBounds_All(meeting->sheet->seen.bounds);
    const double lower[3] = { box.lower.x, box.lower.y, box.lower.z },
                 upper[3] = { box.upper.x, box.upper.y, box.upper.z };
    const double a[3] = { from.x, from.y, from.z }, d[3] = { step.x, step.y, step.z };
    double start = *first, end = *last, margin = meeting->reach + meeting->gap + meeting->square;
    for (int k = 0; k < 3; ++k) {
        double enter = lower[k] - margin - a[k], leave = upper[k] + margin - a[k];
        if (fabs(d[k]) * (end - start + 1.0) < 1e-9) {
            end = enter > 0.0 || leave < 0.0 ? start - 1.0 : end;
            continue;
        }
        double s = d[k] > 0.0 ? enter / d[k] : leave / d[k], t = d[k] > 0.0 ? leave / d[k] : enter / d[k];
        start = kiriMax(s, start);
        end = kiriMin(t, end);
    }
    *first = start <= end ? (int32_t)start : 0;
    *last = start <= end ? (int32_t)end : -1;
}

/* Touches a straight edge at the middles of steps about one grid square long; its ends are corners. An infinite edge
   has MOST_POINTS steps. */
static bool TouchStraight(const kiriMeeting* meeting, const kiriObstacleEdge* edge, int32_t index)
{
    enum { MOST_POINTS = 1 << 18 };
    kiriVec3 from = edge->from, way = kiriVec3_Sub(edge->to, edge->from);
    if (meeting->obstacle->shape.half >= KIRI_ENDLESS) {
        way = kiriVec3_Make(0.0, 0.0, MOST_POINTS * meeting->square);
        from.z = -0.5 * way.z;
    }
    double wanted = kiriVec3_Length(way) / meeting->square;
    int32_t count = wanted < MOST_POINTS - 1 ? (int32_t)wanted + 1 : MOST_POINTS, first = 0, last = count - 1;
    kiriVec3 step = kiriVec3_Scale(1.0 / count, way);
    from = kiriVec3_AddScaled(from, 0.5, step);
    ClipEdge(meeting, kiriObstacle_PointToWorld(meeting->obstacle, from), kiriObstacle_ToWorld(meeting->obstacle, step),
             &first, &last);
    bool ok = true;
    for (int32_t i = first; ok && i <= last; ++i) {
        EdgePoint point = MakePoint(meeting, kiriVec3_AddScaled(from, i, step), edge->faces, 2, edge->thinnest);
        point.item = (uint32_t)index * MOST_POINTS + (uint32_t)i;
        ok = TouchPoint(meeting, &point);
    }
    return ok;
}

static bool TouchTips(const kiriMeeting* meeting)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    const uint32_t tips = UINT32_C(1) << 28; /* first item number of corners, above all points of edges */
    bool ok = true;
    for (int32_t i = 0; ok && i < CornerCount(shape); ++i) {
        kiriObstacleCorner corner;
        if (CornerAt(shape, i, &corner)) {
            EdgePoint point = MakePoint(meeting, corner.at, corner.faces, 3, corner.thinnest);
            point.item = tips + (uint32_t)i;
            ok = TouchPoint(meeting, &point);
        }
    }
    return ok;
}

bool kiriMeeting_TouchEdges(const kiriMeeting* meeting)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    bool ok = TouchTips(meeting);
    for (int32_t i = 0; ok && i < kiriObstacleShape_EdgeCount(shape); ++i) {
        kiriObstacleEdge edge;
        if (kiriObstacleShape_EdgeAt(shape, i, &edge)) {
            ok = edge.radius > 0.0 ? TouchRim(meeting, &edge, i) : TouchStraight(meeting, &edge, i);
        }
    }
    return ok;
}

/* ---- Corners against the borders of planar sheets ---------------------------------------------------------------- */

/* Intersects an edge of the obstacle with the sheet's plane: a corner of the section. Returns false if they do not
   meet, or are nearly parallel. */
static bool CutEdge(const kiriMeeting* meeting, const kiriObstacleEdge* edge, int32_t index, EdgePoint* point)
{
    kiriVec3 d = meeting->sheet->settings.mechanics.axes.d, onPlane = meeting->sheet->frames.data[0].x;
    kiriVec3 from = kiriObstacle_PointToWorld(meeting->obstacle, edge->from);
    kiriVec3 way = kiriObstacle_ToWorld(meeting->obstacle, kiriVec3_Sub(edge->to, edge->from));
    double rise = kiriVec3_Dot(way, d), below = kiriVec3_Dot(kiriVec3_Sub(onPlane, from), d);
    if (edge->radius > 0.0 || !(fabs(rise) > 0.1 * kiriVec3_Length(way)) || below / rise < 0.0 || below / rise > 1.0) {
        return false;
    }
    *point = MakePoint(meeting, edge->from, edge->faces, 2, edge->thinnest);
    point->item = (uint32_t)index;
    point->at = kiriVec3_AddScaled(from, below / rise, way);
    for (int k = 0; k < 2; ++k) {
        kiriVec3 face = point->faces[k];
        point->faces[k] = kiriVec3_Normalize(kiriVec3_AddScaled(face, -kiriVec3_Dot(face, d), d));
    }
    point->out = kiriVec3_Normalize(kiriVec3_Add(point->faces[0], point->faces[1]));
    return true;
}

/* Intersects the line of the point with a side, in the sheet's plane. Returns false if it misses. */
static bool MeetSide(kiriVec3 a, kiriVec3 b, kiriVec3 d, const EdgePoint* point, double* height, double* share)
{
    kiriVec3 along = kiriVec3_Sub(b, a), to = kiriVec3_Sub(point->at, a);
    double det = kiriVec3_Dot(d, kiriVec3_Cross(point->out, along));
    if (!(fabs(det) > 0.0)) {
        return false;
    }
    *share = kiriVec3_Dot(d, kiriVec3_Cross(point->out, to)) / det;
    *height = kiriVec3_Dot(d, kiriVec3_Cross(along, to)) / det;
    return *share >= 0.0 && *share <= 1.0 && *height > -point->below && *height < point->above;
}

static bool TouchSide(const kiriMeeting* meeting, const EdgePoint* point, int32_t a, int32_t b, kiriTouch* touch)
{
    const kiriSheetData* sheet = meeting->sheet;
    kiriVec3 d = sheet->settings.mechanics.axes.d;
    kiriVec3 from = kiriSurface_At(&sheet->seen.surface, a), to = kiriSurface_At(&sheet->seen.surface, b);
    double height, share, gap = meeting->gap + meeting->obstacle->shape.rounding;
    if (!MeetSide(from, to, d, point, &height, &share) ||
        !kiriMeeting_IsBorder(&sheet->seen.surface, &meeting->search->crossed, a, b)) {
        return false;
    }
    /* The material is left of its border, so the normal points into the material, away from the obstacle. */
    kiriVec3 normal = kiriVec3_Normalize(kiriVec3_Cross(d, kiriVec3_Sub(to, from)));
    kiriVec3 velocity = kiriVec3_AddScaled(kiriVec3_Scale(1.0 - share, kiriMeeting_VertexVelocity(sheet, a)), share,
                                           kiriMeeting_VertexVelocity(sheet, b));
    double above = height * kiriVec3_Dot(normal, point->out) - gap;
    double rise =
        kiriVec3_Dot(normal, kiriMeeting_Way(meeting, kiriVec3_AddScaled(point->at, height, point->out), velocity));
    if (above + rise > KIRI_NEARBY * gap || !IsTangentTo(point, normal) ||
        !kiriMeeting_MakePlane(meeting, normal, point->at, gap, touch)) {
        return false;
    }
    kiriMeeting_SetPlace(touch, (const int32_t[2]){ a, b }, (const double[2]){ 1.0 - share, share }, 2);
    return true;
}

static bool TouchCorner(const kiriMeeting* meeting, const EdgePoint* point)
{
    enum { MOST_SIDES = 4 };
    kiriSheetData* sheet = meeting->sheet;
    kiriObstacleSearch* search = meeting->search;
    kiriVec3 a = kiriVec3_AddScaled(point->at, point->above, point->out);
    kiriVec3 b = kiriVec3_AddScaled(point->at, -point->below, point->out);
    const kiriBox box = { { kiriMin(a.x, b.x), kiriMin(a.y, b.y), kiriMin(a.z, b.z) },
                          { kiriMax(b.x, a.x), kiriMax(b.y, a.y), kiriMax(b.z, a.z) } };
    uint32_t sides = 0;
    search->crossed.count = 0;
    bool ok = kiriBounds_Box(sheet->seen.bounds, &sheet->seen.surface, &box, search->memory, &search->crossed);
    for (int32_t i = 0; ok && i < 3 * search->crossed.count && sides < MOST_SIDES; ++i) {
        const int32_t* v = kiriSurface_Triangle(&sheet->seen.surface, search->crossed.data[i / 3]);
        kiriTouch touch;
        if (TouchSide(meeting, point, v[i % 3], v[(i + 1) % 3], &touch)) {
            touch.key = kiriMeeting_Key(meeting, true, point->item * MOST_SIDES + sides++);
            ok = kiriTouches_Add(sheet, &touch);
        }
    }
    return ok;
}

bool kiriMeeting_TouchCorners(const kiriMeeting* meeting)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    bool ok = true;
    for (int32_t i = 0; ok && i < kiriObstacleShape_EdgeCount(shape); ++i) {
        kiriObstacleEdge edge;
        EdgePoint point;
        if (kiriObstacleShape_EdgeAt(shape, i, &edge) && CutEdge(meeting, &edge, i, &point)) {
            ok = TouchCorner(meeting, &point);
        }
    }
    return ok;
}

KIRI_TABLE(ObstacleShapeTable, kiriObstacleShape, {
    KIRI_WITHIN(KIRI_OBSTACLE_PLANE, KIRI_OBSTACLE_PRISM, type),
    KIRI_REALS(radius, rounding),
    KIRI_REALS(flat),
    KIRI_KEPT(outline, count),
})

KIRI_TABLE(ObstacleDataTable, kiriObstacleData, {
    KIRI_PART(shape, ObstacleShapeTable),
    KIRI_REALS(position, center),
    KIRI_RUN(4, body),
    KIRI_REALS(pushSpeed),
    KIRI_RUN(4, groups),
    KIRI_REALS(drift),
    KIRI_UNHASHED,
    KIRI_RUN(4, id),
    KIRI_REALS(impulse),
    KIRI_WITHIN(0, INT32_MAX, contacts),
    KIRI_REALS(lower, upper),
})

static bool IsObstacle(const kiriObstacleData* obstacle)
{
    const kiriObstacleShape* shape = &obstacle->shape;
    bool isPrism = shape->type == KIRI_OBSTACLE_PRISM;
    bool isFine = shape->type != KIRI_OBSTACLE_BOX && (isPrism ? shape->count >= 3 : shape->count == 0) &&
                  obstacle->mass >= 0.0;
    for (int32_t k = 0; k < 2 * shape->count; ++k) {
        isFine = isFine && fabs(shape->outline[k].x) <= 2e6 && fabs(shape->outline[k].y) <= 2e6;
    }
    return isFine;
}

void kiriObstacle_Archive(kiriArchive* archive, kiriObstacleData** made, kiriMemory* memory)
{
    enum { MOST_OUTLINE = 64 };
    bool reads = kiriArchive_Reads(archive);
    int32_t corners = kiriArchive_Count(archive, reads ? 0 : (*made)->shape.count, 0, MOST_OUTLINE);
    if (reads) {
        *made = kiriArchive_HasFailed(archive) ? NULL : kiriObstacle_Alloc(memory, corners);
        archive->isShort |= *made == NULL && !archive->isBad;
    }
    if (*made != NULL) {
        kiriArchive_Object(archive, ObstacleDataTable, *made);
        kiriArchive_Numbers(archive, (*made)->shape.outline, 8, 4 * (int64_t)corners);
        kiriArchive_Expect(archive, archive->isWhole || IsObstacle(*made));
    }
}
