#include "kiri_obstacle.h"
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
    KIRI_TIMES_WHILE(nearest->distance > gap + close, step, MOST_STEPS) {
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

/* Bisects the quarter that contains the point; needs no sine. */
kiriVec2 kiriCircle_At(int32_t i, int32_t count)
{
    static const kiriVec2 quarters[4] = { { 1.0, 0.0 }, { 0.0, 1.0 }, { -1.0, 0.0 }, { 0.0, -1.0 } };
    int32_t step = count / 4, quarter = i / step, rest = i % step;
    kiriVec2 a = quarters[quarter % 4], b = quarters[(quarter + 1) % 4];
    while (rest > 0) {
        kiriVec2 middle = kiriVec2_Make(a.x + b.x, a.y + b.y);
        middle = kiriVec2_Normalize(middle);
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
    KIRI_REALS(was, impulse),
    KIRI_UNHASHED,
    KIRI_RUN(4, id),
    KIRI_WITHIN(0, INT32_MAX, contacts),
    KIRI_REALS(lower, upper),
})

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
        const kiriObstacleShape* shape = &(*made)->shape;
        bool isPrism = shape->type == KIRI_OBSTACLE_PRISM;
        bool isFine =
            shape->type != KIRI_OBSTACLE_BOX && (isPrism ? corners >= 3 : corners == 0) && (*made)->mass >= 0.0;
        KIRI_TIMES(k, 2 * corners) { /* normals follow the outline */
            isFine = isFine && fabs(shape->outline[k].x) <= 2e6 && fabs(shape->outline[k].y) <= 2e6;
        }
        kiriArchive_Expect(archive, archive->isWhole || isFine);
    }
}
