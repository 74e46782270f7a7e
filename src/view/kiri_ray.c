#include "kiri_ray.h"

#include <string.h>

/* ---- Rays ---- */

typedef struct Barycentric {
    double distance, b, c; /* along the ray; shares of the second and third corner */
} Barycentric;

/* Where a ray meets a triangle (Moeller and Trumbore 1997). */
static bool MeetTriangle(const kiriVec3 corner[3], kiriVec3 origin, kiriVec3 direction, Barycentric* at)
{
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec3 p = kiriVec3_Cross(direction, ac);
    double determinant = kiriVec3_Dot(ab, p);
    if (determinant == 0.0) {
        return false;
    }
    kiriVec3 s = kiriVec3_Sub(origin, corner[0]), q = kiriVec3_Cross(s, ab);
    at->b = kiriVec3_Dot(s, p) / determinant;
    at->c = kiriVec3_Dot(direction, q) / determinant;
    at->distance = kiriVec3_Dot(ac, q) / determinant;
    return at->b >= 0.0 && at->c >= 0.0 && at->b + at->c <= 1.0;
}

static void WorldCorners(const kiriSurface* surface, int32_t triangle, kiriVec3 corner[3])
{
    for (int k = 0; k < 3; ++k) {
        corner[k] = surface->exact.data[surface->indices.data[3 * (size_t)triangle + (size_t)k]];
    }
}

static kiriVec2 RestPoint(const kiriSurface* surface, int32_t triangle, double b, double c)
{
    const int32_t* vertex = &surface->indices.data[3 * (size_t)triangle];
    kiriVec2 p = kiriVec2_Scale(1.0 - b - c, surface->rest.data[vertex[0]]);
    p = kiriVec2_Add(p, kiriVec2_Scale(b, surface->rest.data[vertex[1]]));
    return kiriVec2_Add(p, kiriVec2_Scale(c, surface->rest.data[vertex[2]]));
}

static void WriteHit(const kiriSurface* surface, int32_t triangle, const kiriVec3 corner[3], Barycentric at,
                     kiriHit* hit)
{
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec2 rest = kiriVec2_Add(surface->origin, RestPoint(surface, triangle, at.b, at.c));
    hit->restPoint[0] = (float)rest.x;
    hit->restPoint[1] = (float)rest.y;
    kiriVec3_Store(hit->position, kiriVec3_AddScaled(kiriVec3_AddScaled(corner[0], at.b, ab), at.c, ac));
    kiriVec3_Store(hit->normal, kiriVec3_Normalize(kiriVec3_Cross(ab, ac)));
    hit->distance = (float)at.distance;
    hit->triangle = triangle;
}

typedef struct RaySearch {
    const kiriSurface* surface;
    kiriVec3 origin, direction;
    int32_t triangle; /* the first so far, or KIRI_NONE */
    Barycentric at;
} RaySearch;

/* The order in which triangles are tried makes no difference. */
static void TryTriangle(RaySearch* search, int32_t triangle, double* distance)
{
    kiriVec3 corner[3];
    Barycentric at;
    WorldCorners(search->surface, triangle, corner);
    if (MeetTriangle(corner, search->origin, search->direction, &at) && at.distance >= 0.0 &&
        (at.distance < *distance || (at.distance == *distance && triangle > search->triangle))) {
        *distance = at.distance;
        search->triangle = triangle;
        search->at = at;
    }
}

static void TryTriangles(void* context, const int32_t* triangles, int32_t count, double* distance)
{
    for (int32_t i = 0; i < count; ++i) {
        TryTriangle(context, triangles[i], distance);
    }
}

void kiriSurface_Raycast(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 origin, kiriVec3 direction,
                         double maxDistance, kiriHit* hit)
{
    RaySearch search = { surface, origin, direction, KIRI_NONE, { 0.0, 0.0, 0.0 } };
    memset(hit, 0, sizeof(*hit));
    hit->triangle = KIRI_NONE;
    if (bounds != NULL && kiriBounds_IsFresh(bounds, surface)) {
        kiriBounds_Ray(bounds, origin, direction, maxDistance, TryTriangles, &search);
    } else {
        for (int32_t t = 0; t < surface->triangleCount; ++t) {
            TryTriangle(&search, t, &maxDistance);
        }
    }
    if (search.triangle != KIRI_NONE) {
        kiriVec3 corner[3];
        WorldCorners(surface, search.triangle, corner);
        WriteHit(surface, search.triangle, corner, search.at, hit);
    }
}

/* ---- Blades ---- */

/* Where the segment p-q meets the triangle, as a share of the segment. */
static bool MeetSegment(const kiriVec3 corner[3], kiriVec3 p, kiriVec3 q, Barycentric* at)
{
    return MeetTriangle(corner, p, kiriVec3_Sub(q, p), at) && at->distance >= 0.0 && at->distance <= 1.0;
}

/* Adds the points in which a mesh triangle meets a blade triangle: sides of the one through the other, both ways. In
   general there are two. */
static int32_t MeetTriangles(const kiriSurface* surface, int32_t triangle, const kiriVec3 corner[3],
                             const kiriVec3 blade[3], kiriVec2 points[6])
{
    int32_t count = 0;
    Barycentric at;
    static const double cornerB[3] = { 0.0, 1.0, 0.0 }, cornerC[3] = { 0.0, 0.0, 1.0 };
    for (int k = 0; k < 3; ++k) {
        int n = (k + 1) % 3;
        if (MeetSegment(blade, corner[k], corner[n], &at)) {
            double b = cornerB[k] + at.distance * (cornerB[n] - cornerB[k]);
            double c = cornerC[k] + at.distance * (cornerC[n] - cornerC[k]);
            points[count++] = RestPoint(surface, triangle, b, c);
        }
        if (MeetSegment(corner, blade[k], blade[n], &at)) {
            points[count++] = RestPoint(surface, triangle, at.b, at.c);
        }
    }
    return count;
}

/* The two points farthest apart, for a point on a shared corner is found more than once. */
static void Farthest(const kiriVec2* points, int32_t count, kiriVec2* from, kiriVec2* to)
{
    double best = -1.0;
    for (int32_t i = 0; i < count; ++i) {
        for (int32_t j = i + 1; j < count; ++j) {
            double length = kiriVec2_Length(kiriVec2_Sub(points[j], points[i]));
            if (length > best) {
                best = length;
                *from = points[i];
                *to = points[j];
            }
        }
    }
}

bool kiriSurface_Slice(const kiriSurface* surface, kiriMemory* memory, const kiriVec3 quad[4], kiriRestPoints* segments)
{
    const kiriVec3 blades[2][3] = { { quad[0], quad[1], quad[2] }, { quad[0], quad[2], quad[3] } };
    for (int32_t t = 0; t < surface->triangleCount; ++t) {
        kiriVec3 corner[3];
        WorldCorners(surface, t, corner);
        for (int side = 0; side < 2; ++side) {
            kiriVec2 points[6], from, to;
            int32_t count = MeetTriangles(surface, t, corner, blades[side], points);
            if (count < 2) {
                continue;
            }
            Farthest(points, count, &from, &to);
            if (!kiriArray_Push(memory, segments, from) || !kiriArray_Push(memory, segments, to)) {
                return false;
            }
        }
    }
    return true;
}
