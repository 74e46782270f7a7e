#include "kiri_obstacle_work.h"

#include "../core/kiri_sort.h"

/* The point of a segment, given by its ends. */
static double ShareOfSegment(kiriVec3 a, kiriVec3 b, kiriVec3 p)
{
    kiriVec3 along = kiriVec3_Sub(b, a);
    double square = kiriVec3_Dot(along, along);
    double t = square > 0.0 ? kiriVec3_Dot(kiriVec3_Sub(p, a), along) / square : 0.0;
    return kiriClamp(t, 0.0, 1.0);
}

static kiriVec3 BlendOfThree(const kiriVec3 x[3], const double share[3])
{
    return kiriVec3_AddScaled(kiriVec3_AddScaled(kiriVec3_Scale(share[0], x[0]), share[1], x[1]), share[2], x[2]);
}

/* The shares of the point of a triangle that is nearest to p: above its inside, or the nearest of its sides. */
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
    for (int k = 0; k < 3; ++k) {
        int next = (k + 1) % 3;
        double t = ShareOfSegment(x[k], x[next], p);
        double far = kiriVec3_Length(kiriVec3_Sub(kiriVec3_AddScaled(kiriVec3_Scale(1.0 - t, x[k]), t, x[next]), p));
        if (far < least) {
            least = far;
            share[k] = 1.0 - t;
            share[next] = t;
            share[3 - k - next] = 0.0;
        }
    }
}

/* The point of a triangle that is nearest to the axis of a round obstacle, by turns from one to the other: both are
   convex. */
static void NearestToAxis(double half, const kiriVec3 x[3], double share[3])
{
    enum { TURNS = 24 };
    kiriVec3 onAxis = { 0.0, 0.0, 0.0 };
    for (int turn = 0; turn < TURNS; ++turn) {
        NearestOfTriangle(x, onAxis, share);
        double z = BlendOfThree(x, share).z;
        onAxis.z = kiriClamp(z, -half, half);
        if (half <= 0.0) {
            return;
        }
    }
}

/* A side so long bridges an arc of the obstacle that its ends do not see. */
static bool IsCoarse(const kiriMeeting* meeting, const kiriVec3 x[3])
{
    double longest = 0.0;
    for (int k = 0; k < 3; ++k) {
        double length = kiriVec3_Length(kiriVec3_Sub(x[(k + 1) % 3], x[k]));
        longest = kiriMax(length, longest);
    }
    return longest * longest > 16.0 * meeting->gap * meeting->obstacle->shape.radius;
}

/* A vertex is seen to elsewhere; of a planar sheet only points on its border touch. */
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

/* Local to the obstacle. */
static void GetCorners(const kiriMeeting* meeting, int32_t triangle, kiriVec3 x[3])
{
    const kiriSurface* surface = &meeting->sheet->seen.surface;
    for (int k = 0; k < 3; ++k) {
        int32_t vertex = surface->indices.data[3 * (int64_t)triangle + k];
        x[k] = kiriObstacle_PointToLocal(meeting->obstacle, kiriSurface_At(surface, vertex));
    }
}

static bool TouchRound(const kiriMeeting* meeting, int32_t triangle, kiriTouch* touch)
{
    const kiriSheetData* sheet = meeting->sheet;
    const kiriObstacleData* obstacle = meeting->obstacle;
    const int32_t* v = &sheet->seen.surface.indices.data[3 * (int64_t)triangle];
    kiriVec3 x[3], velocity = { 0.0, 0.0, 0.0 };
    double share[3];
    GetCorners(meeting, triangle, x);
    NearestToAxis(obstacle->shape.half, x, share);
    if (!CountsBetween(meeting, v, share)) {
        return false;
    }
    for (int k = 0; k < 3; ++k) {
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

/* The triangles near that are coarse, in order. */
static bool CollectCoarse(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    bool ok = true;
    search->crossed.count = 0;
    for (int32_t i = 0; ok && i < search->triangles.count; ++i) {
        kiriVec3 x[3];
        GetCorners(meeting, search->triangles.data[i], x);
        ok = !IsCoarse(meeting, x) || kiriArray_Push(search->memory, &search->crossed, search->triangles.data[i]);
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
    for (int32_t i = 0; ok && i < coarse->count; ++i) {
        kiriTouch touch;
        if (TouchRound(meeting, coarse->data[i], &touch)) {
            touch.key = kiriMeeting_Key(meeting, true, KIRI_ROUND_ITEM | (uint32_t)coarse->data[i]);
            ok = kiriTouches_Add(meeting->sheet, &touch);
        }
    }
    return ok;
}
