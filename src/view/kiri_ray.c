#include "kiri_ray.h"

#include <string.h>

/* ---- Rays ---- */

typedef struct Barycentric {
    double distance, b, c; /* along the ray; shares of the second and third corner */
} Barycentric;

/* Where a ray meets a triangle (Moeller and Trumbore 1997), or the rim around it: shares down to -rim count, too. */
static bool MeetTriangle(const kiriVec3 corner[3], kiriVec3 origin, kiriVec3 direction, double rim, Barycentric* at)
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
    return at->b >= -rim && at->c >= -rim && at->b + at->c <= 1.0 + rim;
}

static void WorldCorners(const kiriSurface* surface, int32_t triangle, kiriVec3 corner[3])
{
    for (int k = 0; k < 3; ++k) {
        corner[k] = kiriSurface_At(surface, surface->indices.data[3 * (size_t)triangle + (size_t)k]);
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
    if (MeetTriangle(corner, search->origin, search->direction, 0.0, &at) && at.distance >= 0.0 &&
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

/* ---- Edges ---- */

typedef struct EdgeSearch {
    const kiriSurface* surface;
    kiriVec3 from, way;
    kiriMemory* memory;
    kiriCrossings* crossings;
    int32_t first; /* of those that were found for this edge */
    bool failed;
} EdgeSearch;

/* In the order of triangles, for that in which they are tried depends on how the bounds came about. */
static void AddCrossing(EdgeSearch* search, const kiriCrossing* crossing)
{
    kiriCrossings* all = search->crossings;
    if (!kiriArray_Push(search->memory, all, *crossing)) {
        search->failed = true;
        return;
    }
    int32_t i = all->count - 1;
    for (; i > search->first && all->data[i - 1].triangle > crossing->triangle; --i) {
        all->data[i] = all->data[i - 1];
    }
    all->data[i] = *crossing;
}

/* With a rim, or an edge may slip through between two triangles, by rounding. */
static void CrossTriangles(void* context, const int32_t* triangles, int32_t count, double* distance)
{
    EdgeSearch* search = context;
    (void)distance;
    for (int32_t i = 0; i < count; ++i) {
        kiriVec3 corner[3];
        Barycentric at;
        WorldCorners(search->surface, triangles[i], corner);
        if (MeetTriangle(corner, search->from, search->way, 1e-9, &at) && at.distance >= 0.0 && at.distance <= 1.0) {
            const kiriCrossing crossing = { RestPoint(search->surface, triangles[i], at.b, at.c),
                                            kiriVec3_AddScaled(search->from, at.distance, search->way), at.distance,
                                            triangles[i] };
            AddCrossing(search, &crossing);
        }
    }
}

static bool IsKnown(const EdgeSearch* search, int32_t count, kiriVec2 rest, double apart)
{
    bool isKnown = false;
    for (int32_t i = search->first; !isKnown && i < count; ++i) {
        isKnown = kiriVec2_Length(kiriVec2_Sub(search->crossings->data[i].rest, rest)) < apart;
    }
    return isKnown;
}

bool kiriSurface_Cross(const kiriSurface* surface, const kiriBounds* bounds, kiriVec3 from, kiriVec3 to, double apart,
                       kiriMemory* memory, kiriCrossings* crossings)
{
    EdgeSearch search = { surface, from, kiriVec3_Sub(to, from), memory, crossings, crossings->count, false };
    int32_t kept = crossings->count;
    kiriBounds_Ray(bounds, from, search.way, 1.0, CrossTriangles, &search);
    for (int32_t i = search.first; i < crossings->count; ++i) {
        if (!IsKnown(&search, kept, crossings->data[i].rest, apart)) {
            crossings->data[kept++] = crossings->data[i];
        }
    }
    crossings->count = kept;
    return !search.failed;
}
