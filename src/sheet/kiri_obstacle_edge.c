#include "kiri_obstacle_work.h"

#include "../core/kiri_sort.h"

#define LINE_SLACK 1e-9 /* m: what lies in the side of a box is in it */

/* A point on an edge or a corner, in the world. */
typedef struct EdgePoint {
    kiriVec3 at, out; /* out: unit, half-way between the faces */
    kiriVec3 faces[3];
    int32_t faceCount;
    double below, above; /* m: how far material may be along `out` */
    uint32_t item;
} EdgePoint;

/* Where the line of the point meets the triangle; false where it passes by. */
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

/* The triangle lies over the edge as a tangent plane may: towards none of its faces. */
static bool IsTangentTo(const EdgePoint* point, kiriVec3 normal)
{
    for (int32_t k = 0; k < point->faceCount; ++k) {
        if (kiriVec3_Dot(normal, point->faces[k]) < -0.2) {
            return false;
        }
    }
    return true;
}

/* The normal that is seen at the point, smooth over the sides of triangles, towards the outside of the obstacle. */
static kiriVec3 SeenNormal(kiriSurface* surface, const int32_t* v, const double share[3], kiriVec3 out)
{
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
    kiriSurface_NeedNormals(surface);
    for (int k = 0; k < 3; ++k) {
        sum = kiriVec3_AddScaled(sum, share[k], kiriVec3_Load(&surface->normals.data[3 * (int64_t)v[k]]));
    }
    return kiriVec3_Scale(kiriVec3_Dot(sum, out) < 0.0 ? -1.0 : 1.0, kiriVec3_Normalize(sum));
}

static bool TouchTriangle(const kiriMeeting* meeting, const EdgePoint* point, int32_t triangle, kiriTouch* touch)
{
    kiriSheetData* sheet = meeting->sheet;
    const int32_t* v = &sheet->seen.surface.indices.data[3 * (int64_t)triangle];
    kiriVec3 x[3] = { kiriSurface_At(&sheet->seen.surface, v[0]), kiriSurface_At(&sheet->seen.surface, v[1]),
                      kiriSurface_At(&sheet->seen.surface, v[2]) };
    double height, share[3], gap = meeting->gap + meeting->obstacle->shape.rounding;
    if (!MeetsTriangle(x, point, &height, share)) {
        return false;
    }
    kiriVec3 normal = SeenNormal(&sheet->seen.surface, v, share, point->out);
    kiriVec3 velocity = { 0.0, 0.0, 0.0 }, at = kiriVec3_AddScaled(point->at, height, point->out);
    for (int k = 0; k < 3; ++k) {
        velocity = kiriVec3_AddScaled(velocity, share[k], kiriMeeting_VertexVelocity(sheet, v[k]));
    }
    double above = height * kiriVec3_Dot(normal, point->out) - gap;
    double rise = kiriVec3_Dot(normal, kiriMeeting_Way(meeting, at, velocity));
    if (above + rise > KIRI_NEARBY * gap || !IsTangentTo(point, normal) ||
        !kiriMeeting_MakePlane(meeting, normal, point->at, gap, touch)) {
        return false;
    }
    kiriMeeting_SetPlace(touch, v, share, 3);
    return true;
}

/* Does the line of the point meet a box? By slabs. */
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

/* The triangles that the line of the point meets, in order: those beside each other have the same keys in each tick. */
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
    for (int32_t i = 0; i < crossed->count; ++i) {
        const int32_t* v = &surface->indices.data[3 * (int64_t)crossed->data[i]];
        kiriVec3 x[3] = { kiriSurface_At(surface, v[0]), kiriSurface_At(surface, v[1]), kiriSurface_At(surface, v[2]) };
        double height, share[3];
        if (MeetsTriangle(x, point, &height, share)) {
            crossed->data[kept++] = crossed->data[i];
        }
    }
    crossed->count = kept;
    if (kept > 1) {
        kiriSort(crossed->data, kept, NULL, NULL);
    }
    return true;
}

/* Several layers may lie over a point: each has a touch, up to a number. */
static bool TouchPoint(const kiriMeeting* meeting, const EdgePoint* point)
{
    enum { MOST_LAYERS = 4 };
    const kiriIndices* crossed = &meeting->search->crossed;
    bool ok = FindCrossed(meeting, point);
    uint32_t layers = 0;
    for (int32_t i = 0; ok && i < crossed->count && layers < MOST_LAYERS; ++i) {
        kiriTouch touch;
        if (TouchTriangle(meeting, point, crossed->data[i], &touch)) {
            touch.key = kiriMeeting_Key(meeting, true, point->item * MOST_LAYERS + layers++);
            ok = kiriTouches_Add(meeting->sheet, &touch);
        }
    }
    return ok;
}

/* Local to the obstacle. */
static EdgePoint MakePoint(const kiriMeeting* meeting, kiriVec3 at, const kiriVec3* faces, int32_t faceCount,
                           double thinnest)
{
    const kiriObstacleData* obstacle = meeting->obstacle;
    kiriVec3 sum = { 0.0, 0.0, 0.0 };
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

/* The part of an edge, counted in steps, that is in the sheet's box. */
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

/* As many steps along an edge as squares, each with a point in its middle: at the ends are corners. An edge without end
   has points as far as anybody may look. */
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
    const uint32_t tips = UINT32_C(1) << 28; /* beyond all points of edges */
    bool ok = true;
    for (int32_t i = 0; ok && i < kiriObstacleShape_CornerCount(shape); ++i) {
        kiriObstacleCorner corner;
        if (kiriObstacleShape_CornerAt(shape, i, &corner)) {
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

/* Where an edge of the obstacle goes through the sheet's plane there is a corner of what the plane cuts out of it.
   False where it does not, or lies along it. */
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

/* Where the line of the point crosses a side, in the plane; false where it passes by. */
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
    /* The material is on the left of its border: inwards is away from the obstacle. */
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

static kiriBox BoxAround(const EdgePoint* point)
{
    kiriVec3 a = kiriVec3_AddScaled(point->at, point->above, point->out);
    kiriVec3 b = kiriVec3_AddScaled(point->at, -point->below, point->out);
    kiriBox box = { { kiriMin(a.x, b.x), kiriMin(a.y, b.y), kiriMin(a.z, b.z) },
                    { kiriMax(b.x, a.x), kiriMax(b.y, a.y), kiriMax(b.z, a.z) } };
    return box;
}

static bool TouchCorner(const kiriMeeting* meeting, const EdgePoint* point)
{
    enum { MOST_SIDES = 4 };
    kiriSheetData* sheet = meeting->sheet;
    kiriObstacleSearch* search = meeting->search;
    kiriBox box = BoxAround(point);
    uint32_t sides = 0;
    search->crossed.count = 0;
    bool ok = kiriBounds_Box(sheet->seen.bounds, &sheet->seen.surface, &box, search->memory, &search->crossed);
    for (int32_t i = 0; ok && i < 3 * search->crossed.count && sides < MOST_SIDES; ++i) {
        const int32_t* v = &sheet->seen.surface.indices.data[3 * (int64_t)search->crossed.data[i / 3]];
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
