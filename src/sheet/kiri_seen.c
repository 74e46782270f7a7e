#include "kiri_seen.h"

#include <string.h>

bool kiriView_Resize(kiriSheetData* sheet, int32_t frameCount, int32_t pointCount)
{
    return kiriSurface_Resize(&sheet->surface, &sheet->shown, &sheet->mesh, frameCount) &&
           kiriArray_Resize(&sheet->shown, &sheet->pointPositions, 3 * (int64_t)pointCount) &&
           kiriArray_Resize(sheet->memory, &sheet->exactPoints, pointCount) &&
           (!sheet->update.isBegun || (kiriFades_Reserve(&sheet->fades, sheet->memory, sheet->mesh.vertices.count) &&
                                       kiriFades_Reserve(&sheet->pointFades, sheet->memory, pointCount)));
}

/* A newborn vertex lies on the triangle that was seen. */
static void PlaceNewborn(kiriSheetData* sheet, int32_t vertex)
{
    const kiriBirth* birth = &sheet->mesh.births.data[vertex - sheet->mesh.oldVertexCount];
    kiriVec3 at = { 0.0, 0.0, 0.0 };
    for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
        at = kiriVec3_AddScaled(at, birth->share[k], sheet->surface.exact.data[birth->parent[k]]);
    }
    sheet->surface.exact.data[vertex] = at;
}

void kiriView_WriteTopology(kiriSheetData* sheet)
{
    for (int32_t v = sheet->mesh.oldVertexCount; v < sheet->mesh.oldVertexCount + sheet->mesh.births.count; ++v) {
        PlaceNewborn(sheet, v);
    }
    kiriSurface_WriteTopology(&sheet->surface, &sheet->mesh);
    sheet->isSeenElsewhere = true;
}

static void WriteExact(kiriSheetData* sheet)
{
    kiriSurface_WritePositions(&sheet->surface, &sheet->vertexSkin, sheet->frames.data, sheet->frames.count,
                               sheet->links.links.data, sheet->links.links.count);
}

/* Linear whatever is seen: here contacts push (see motion.c). */
static void WriteExactPoints(kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriVec2 local = kiriMesh_Local(&sheet->mesh, sheet->points.data[i].at);
        sheet->exactPoints.data[i] = kiriSkin_Position(&sheet->pointSkin, i, sheet->frames.data, local);
    }
}

static void AddPointFades(kiriSheetData* sheet)
{
    for (int32_t k = 0; k < sheet->pointFades.fading.count; ++k) {
        kiriFading fading = sheet->pointFades.fading.data[k];
        kiriVec3* at = &sheet->exactPoints.data[fading.sample];
        *at = kiriVec3_Add(*at, fading.offset);
    }
}

/* Points that are new have not been seen elsewhere. */
static void TakePointJump(kiriSheetData* sheet)
{
    kiriFades* fades = &sheet->pointFades;
    kiriFades_Remember(fades, &sheet->exactPoints.data, &sheet->exactPoints.capacity);
    WriteExactPoints(sheet);
    for (int32_t i = sheet->seenPoints; i < sheet->points.count; ++i) {
        fades->seen.data[i] = sheet->exactPoints.data[i];
    }
    kiriFades_Take(fades, sheet->exactPoints.data, sheet->points.count);
    AddPointFades(sheet);
    sheet->seenPoints = sheet->points.count;
}

void kiriView_TakeJump(kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->surface;
    if (sheet->isSeenElsewhere) {
        kiriFades_Remember(&sheet->fades, &surface->exact.data, &surface->exact.capacity);
        WriteExact(sheet);
        kiriFades_Take(&sheet->fades, surface->exact.data, surface->vertexCount);
        TakePointJump(sheet);
        sheet->isSeenElsewhere = false;
    }
}

void kiriView_Fade(kiriSheetData* sheet, double dt)
{
    kiriFades_Advance(&sheet->fades, dt);
    kiriFades_Advance(&sheet->pointFades, dt);
    if (!sheet->update.isBegun) {
        kiriFades_Trim(&sheet->fades, sheet->memory);
        kiriFades_Trim(&sheet->pointFades, sheet->memory);
    }
}

void kiriView_WritePositions(kiriSheetData* sheet)
{
    WriteExact(sheet);
    kiriSurface_AddFades(&sheet->surface, &sheet->fades);
    kiriSurface_WriteNormals(&sheet->surface);
    WriteExactPoints(sheet);
    AddPointFades(sheet);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        kiriVec3_Store(&sheet->pointPositions.data[3 * i], sheet->exactPoints.data[i]);
    }
    sheet->seenPoints = sheet->points.count;
    sheet->isSeenElsewhere = false;
}

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

static void WriteHit(const kiriSheetData* sheet, int32_t triangle, const kiriVec3 corner[3], Barycentric at,
                     kiriHit* hit)
{
    kiriVec3 ab = kiriVec3_Sub(corner[1], corner[0]), ac = kiriVec3_Sub(corner[2], corner[0]);
    kiriVec2 rest = kiriVec2_Add(sheet->mesh.origin, RestPoint(&sheet->surface, triangle, at.b, at.c));
    hit->restPoint[0] = (float)rest.x;
    hit->restPoint[1] = (float)rest.y;
    kiriVec3_Store(hit->position, kiriVec3_AddScaled(kiriVec3_AddScaled(corner[0], at.b, ab), at.c, ac));
    kiriVec3_Store(hit->normal, kiriVec3_Normalize(kiriVec3_Cross(ab, ac)));
    hit->distance = (float)at.distance;
    hit->triangle = triangle;
}

void kiriView_Raycast(const kiriSheetData* sheet, kiriVec3 origin, kiriVec3 direction, double maxDistance, kiriHit* hit)
{
    memset(hit, 0, sizeof(*hit));
    hit->triangle = KIRI_NONE;
    for (int32_t t = 0; t < sheet->surface.triangleCount; ++t) {
        kiriVec3 corner[3];
        Barycentric at;
        WorldCorners(&sheet->surface, t, corner);
        if (MeetTriangle(corner, origin, direction, &at) && at.distance >= 0.0 && at.distance <= maxDistance) {
            maxDistance = at.distance;
            WriteHit(sheet, t, corner, at, hit);
        }
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

bool kiriView_Slice(const kiriSheetData* sheet, const kiriVec3 quad[4], kiriRestPoints* segments)
{
    const kiriVec3 blades[2][3] = { { quad[0], quad[1], quad[2] }, { quad[0], quad[2], quad[3] } };
    for (int32_t t = 0; t < sheet->surface.triangleCount; ++t) {
        kiriVec3 corner[3];
        WorldCorners(&sheet->surface, t, corner);
        for (int side = 0; side < 2; ++side) {
            kiriVec2 points[6], from, to;
            int32_t count = MeetTriangles(&sheet->surface, t, corner, blades[side], points);
            if (count < 2) {
                continue;
            }
            Farthest(points, count, &from, &to);
            if (!kiriArray_Push(sheet->memory, segments, from) || !kiriArray_Push(sheet->memory, segments, to)) {
                return false;
            }
        }
    }
    return true;
}
