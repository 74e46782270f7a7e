#include "kiri_obstacle_touch.h"

#include "kiri_touch.h"

#include <string.h>

/* So many patches a frame, about: its six unknowns need no more points, but for what bends within its reach. */
#define PATCHES_A_FRAME 8.0

/* Normals that differ by less are of one face: the cosine of 25 degrees. */
#define SAME_FACE 0.9

/* Of the distance that is kept: a point so near above it is a touch already, though it may not come down in this tick. So
   one that rests does not lose its force whenever it lifts a little. */
#define NEARBY 0.5

/* A pair of sheet and obstacle. */
typedef struct Pair {
    kiriObstacleSearch* search;
    kiriSheetData* sheet;
    const kiriObstacleData* obstacle;
    kiriVec3 across;          /* local to the obstacle: normal of the plane of a planar sheet, else zero */
    double gap;               /* m: distance that is kept */
    double reach;             /* m: how far it may be between them and still touch in the tick */
    double patch;             /* m: how wide a patch is */
    int32_t squares, columns; /* of the grid along its side; patches in a row */
    double friction;          /* of both */
    int32_t yield;
} Pair;

/* ---- The sheet as a whole ----------------------------------------------------------------------------------------- */

kiriBox kiriSheet_Box(const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    if (kiriBounds_IsFresh(sheet->seen.bounds, surface)) {
        return kiriBounds_All(sheet->seen.bounds);
    }
    kiriBox box = { surface->exact.data[0], surface->exact.data[0] };
    for (int32_t v = 1; v < surface->vertexCount; ++v) {
        kiriVec3 x = surface->exact.data[v];
        box.lower = kiriVec3_Make(x.x < box.lower.x ? x.x : box.lower.x, x.y < box.lower.y ? x.y : box.lower.y,
                                  x.z < box.lower.z ? x.z : box.lower.z);
        box.upper = kiriVec3_Make(x.x > box.upper.x ? x.x : box.upper.x, x.y > box.upper.y ? x.y : box.upper.y,
                                  x.z > box.upper.z ? x.z : box.upper.z);
    }
    return box;
}

/* To the corner of the box that is farthest from a point. */
static double FarthestCorner(const kiriBox* box, kiriVec3 from)
{
    kiriVec3 a = kiriVec3_Sub(box->lower, from), b = kiriVec3_Sub(box->upper, from);
    return kiriVec3_Length(kiriVec3_Make(fabs(a.x) > fabs(b.x) ? a.x : b.x, fabs(a.y) > fabs(b.y) ? a.y : b.y,
                                         fabs(a.z) > fabs(b.z) ? a.z : b.z));
}

double kiriSheet_SpeedLimit(const kiriSheetData* sheet, const kiriBox* box)
{
    double fastest = 0.0;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        double turn = kiriVec3_Length(frame->spin) + kiriVec3_Length(frame->rate.u) + kiriVec3_Length(frame->rate.v);
        double speed = kiriVec3_Length(frame->velocity) + turn * FarthestCorner(box, frame->x);
        fastest = speed > fastest ? speed : fastest;
    }
    return fastest;
}

double kiriReach_Of(double speed, kiriVec3 gravity, double dt)
{
    return 2.0 * dt * (speed + dt * kiriVec3_Length(gravity));
}

/* No point of the obstacle within reach of the sheet's box is faster. */
static double SpeedOf(const kiriObstacleData* obstacle, const kiriBox* box)
{
    return kiriVec3_Length(obstacle->velocity) +
           kiriVec3_Length(obstacle->spin) * FarthestCorner(box, obstacle->position);
}

static kiriVec3 VertexVelocity(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec3 velocity = { 0.0, 0.0, 0.0 };
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        kiriWeight weight = sheet->vertexSkin.weights.data[k];
        velocity = kiriVec3_AddScaled(
            velocity, weight.value,
            kiriFrame_VelocityAt(&sheet->frames.data[weight.frame], sheet->seen.surface.rest.data[vertex]));
    }
    return velocity;
}

static int32_t LeadingFrame(const kiriSkin* skin, int32_t sample)
{
    kiriSpan span = skin->spans.data[sample];
    kiriWeight most = skin->weights.data[span.first];
    for (int32_t k = span.first + 1; k < span.first + span.count; ++k) {
        most = skin->weights.data[k].value > most.value ? skin->weights.data[k] : most;
    }
    return most.frame;
}

/* ---- Touches ------------------------------------------------------------------------------------------------------ */

/* A plane through a point of the obstacle, with all that a touch says but whom it touches. False where the plane of a
   planar sheet lies along it. */
static bool MakePlane(const Pair* pair, kiriVec3 normal, kiriVec3 at, double gap, kiriTouch* touch)
{
    const kiriMechanics* mechanics = &pair->sheet->settings.mechanics;
    const kiriObstacleData* obstacle = pair->obstacle;
    kiriVec3 slip = kiriVec3_AddScaled(obstacle->surface, -kiriVec3_Dot(obstacle->surface, normal), normal);
    memset(touch, 0, sizeof(*touch));
    touch->velocity = kiriVec3_Add(kiriObstacle_VelocityAt(obstacle, at), slip);
    touch->offset = kiriVec3_Dot(normal, at) + gap;
    if (mechanics->planar) {
        /* The line in which it cuts the sheet's plane. */
        double lean = kiriVec3_Dot(normal, mechanics->axes.d), along = 1.0 - lean * lean;
        double height = kiriVec3_Dot(mechanics->axes.d, pair->sheet->frames.data[0].x);
        if (along < 1e-2) {
            return false;
        }
        normal = kiriVec3_Scale(1.0 / sqrt(along), kiriVec3_AddScaled(normal, -lean, mechanics->axes.d));
        touch->offset = (touch->offset - lean * height) / sqrt(along);
    }
    touch->normal = normal;
    touch->friction = pair->friction;
    touch->pushSpeed = obstacle->pushSpeed;
    touch->yield = pair->yield;
    touch->felt = -1.0;
    touch->point = KIRI_NONE;
    return true;
}

/* What a point of the material may move relative to the obstacle, twice as far as velocities and gravity tell. */
static kiriVec3 RelativeWay(const Pair* pair, kiriVec3 point, kiriVec3 velocity)
{
    const kiriObstacleSearch* search = pair->search;
    kiriVec3 relative = kiriVec3_Sub(velocity, kiriObstacle_VelocityAt(pair->obstacle, point));
    kiriVec3 way = kiriVec3_Scale(2.0 * search->dt, kiriVec3_AddScaled(relative, search->dt, search->gravity));
    if (pair->sheet->settings.mechanics.planar) {
        kiriVec3 d = pair->sheet->settings.mechanics.axes.d;
        way = kiriVec3_AddScaled(way, -kiriVec3_Dot(way, d), d);
    }
    return way;
}

enum { KEY_SLOTS = 1 << 22 };

/* Kind, whether it is of an edge, slot of the obstacle, and which vertex or point of an edge. */
static uint64_t KeyOf(const Pair* pair, bool isEdge, uint32_t item)
{
    return (uint64_t)KIRI_TOUCH_OBSTACLE << 60 | (uint64_t)isEdge << 59 |
           (uint64_t)(pair->obstacle->id & (KEY_SLOTS - 1)) << 32 | item;
}

int32_t kiriObstacle_SlotOfKey(uint64_t key)
{
    return (int32_t)(key >> 32 & (KEY_SLOTS - 1));
}

/* ---- Vertices ----------------------------------------------------------------------------------------------------- */

static bool MeetsBox(const void* context, const kiriBox* box)
{
    const Pair* pair = context;
    kiriVec3 middle = kiriVec3_Scale(0.5, kiriVec3_Add(box->lower, box->upper));
    double half = 0.5 * kiriVec3_Length(kiriVec3_Sub(box->upper, box->lower));
    kiriVec3 local = kiriObstacle_PointToLocal(pair->obstacle, middle);
    kiriVec3 none = { 0.0, 0.0, 0.0 };
    return kiriObstacleShape_Nearest(&pair->obstacle->shape, local, none).distance < pair->reach + half;
}

static int32_t PatchOf(const Pair* pair, int32_t vertex)
{
    const kiriMeshData* mesh = &pair->sheet->mesh;
    int32_t square = kiriSquares_At(&mesh->squares, mesh->vertices.data[vertex].at);
    int32_t column = square % mesh->squares.columns, row = square / mesh->squares.columns;
    return row / pair->squares * pair->columns + column / pair->squares;
}

static bool IsSamePlace(const kiriNearVertex* a, const kiriNearVertex* b)
{
    return a->frame == b->frame && kiriVec3_Dot(a->normal, b->normal) > SAME_FACE;
}

/* Of those in the same place the deepest stays; of equals the one that came first. */
static void Choose(kiriObstacleSearch* search, kiriNearVertex near)
{
    int32_t* link = &search->heads.data[near.patch];
    while (*link != KIRI_NONE) {
        kiriNearVertex* chosen = &search->chosen.data[*link];
        if (IsSamePlace(chosen, &near)) {
            if (near.height < chosen->height) {
                near.next = chosen->next;
                *chosen = near;
            }
            return;
        }
        link = &chosen->next;
    }
    *link = search->chosen.count;
    search->chosen.data[search->chosen.count++] = near;
}

static void LookAtVertex(const Pair* pair, int32_t vertex)
{
    kiriVec3 x = pair->sheet->seen.surface.exact.data[vertex];
    kiriNearest nearest =
        kiriObstacleShape_Nearest(&pair->obstacle->shape, kiriObstacle_PointToLocal(pair->obstacle, x), pair->across);
    if (nearest.distance < pair->reach) {
        kiriNearVertex near = { vertex,    PatchOf(pair, vertex), LeadingFrame(&pair->sheet->vertexSkin, vertex),
                                KIRI_NONE, nearest.distance,      nearest.normal };
        Choose(pair->search, near);
    }
}

static void ChooseVertices(const Pair* pair)
{
    kiriObstacleSearch* search = pair->search;
    const int32_t* indices = pair->sheet->seen.surface.indices.data;
    search->chosen.count = 0;
    search->mark += 1;
    for (int32_t i = 0; i < search->triangles.count; ++i) {
        for (int k = 0; k < 3; ++k) {
            int32_t vertex = indices[3 * (int64_t)search->triangles.data[i] + k];
            if (search->marks.data[vertex] != search->mark) {
                search->marks.data[vertex] = search->mark;
                LookAtVertex(pair, vertex);
            }
        }
    }
    for (int32_t i = 0; i < search->chosen.count; ++i) {
        search->heads.data[search->chosen.data[i].patch] = KIRI_NONE;
    }
}

/* The plane where the vertex enters, or that it comes near. */
static bool TouchVertex(const Pair* pair, int32_t vertex, kiriTouch* touch)
{
    const kiriObstacleData* obstacle = pair->obstacle;
    kiriVec3 x = pair->sheet->seen.surface.exact.data[vertex], from = kiriObstacle_PointToLocal(obstacle, x);
    kiriVec3 way = kiriObstacle_ToLocal(obstacle, RelativeWay(pair, x, VertexVelocity(pair->sheet, vertex)));
    kiriNearest nearest;
    double share = kiriObstacleShape_Enter(&obstacle->shape, from, way, pair->gap, pair->across, &nearest);
    if (share >= 1.0 && nearest.distance > (1.0 + NEARBY) * pair->gap) {
        return false;
    }
    kiriVec3 there = kiriVec3_AddScaled(kiriVec3_AddScaled(from, share, way), -nearest.distance, nearest.normal);
    if (!MakePlane(pair, kiriObstacle_ToWorld(obstacle, nearest.normal), kiriObstacle_PointToWorld(obstacle, there),
                   pair->gap, touch)) {
        return false;
    }
    touch->vertex[0] = vertex;
    touch->vertex[1] = touch->vertex[2] = KIRI_NONE;
    touch->share[0] = 1.0;
    touch->key = KeyOf(pair, false, (uint32_t)vertex);
    return true;
}

static bool TouchVertices(const Pair* pair)
{
    const kiriObstacleSearch* search = pair->search;
    bool ok = true;
    ChooseVertices(pair);
    for (int32_t i = 0; ok && i < search->chosen.count; ++i) {
        kiriTouch touch;
        if (TouchVertex(pair, search->chosen.data[i].vertex, &touch)) {
            ok = kiriTouches_Add(pair->sheet, &touch);
        }
    }
    return ok;
}

/* ---- Edges of the obstacle ---------------------------------------------------------------------------------------- */

/* A point on an edge, in the world. */
typedef struct EdgePoint {
    kiriVec3 at, out; /* out: unit, half-way between the faces */
    kiriVec3 faces[2];
    double below, above; /* m: how far material may be along `out` */
    uint32_t item;
} EdgePoint;

/* Where the line of the point meets the triangle; false where it passes by. */
static bool MeetTriangle(const kiriVec3 x[3], const EdgePoint* point, double* height, double share[3])
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
static bool IsTangent(const EdgePoint* point, kiriVec3 normal)
{
    return kiriVec3_Dot(normal, point->faces[0]) > -0.2 && kiriVec3_Dot(normal, point->faces[1]) > -0.2;
}

static bool TouchTriangle(const Pair* pair, const EdgePoint* point, int32_t triangle, kiriTouch* touch)
{
    const kiriSheetData* sheet = pair->sheet;
    const int32_t* v = &sheet->seen.surface.indices.data[3 * (int64_t)triangle];
    kiriVec3 x[3] = { sheet->seen.surface.exact.data[v[0]], sheet->seen.surface.exact.data[v[1]],
                      sheet->seen.surface.exact.data[v[2]] };
    kiriVec3 normal = kiriVec3_Normalize(kiriVec3_Cross(kiriVec3_Sub(x[1], x[0]), kiriVec3_Sub(x[2], x[0])));
    double height, share[3], gap = pair->gap + pair->obstacle->shape.rounding;
    if (!MeetTriangle(x, point, &height, share)) {
        return false;
    }
    normal = kiriVec3_Dot(normal, point->out) < 0.0 ? kiriVec3_Scale(-1.0, normal) : normal;
    kiriVec3 velocity = { 0.0, 0.0, 0.0 }, at = kiriVec3_AddScaled(point->at, height, point->out);
    for (int k = 0; k < 3; ++k) {
        velocity = kiriVec3_AddScaled(velocity, share[k], VertexVelocity(sheet, v[k]));
    }
    double above = height * kiriVec3_Dot(normal, point->out) - gap;
    double rise = kiriVec3_Dot(normal, RelativeWay(pair, at, velocity));
    if (above + rise > NEARBY * gap || !IsTangent(point, normal) || !MakePlane(pair, normal, point->at, gap, touch)) {
        return false;
    }
    memcpy(touch->vertex, v, sizeof(touch->vertex));
    memcpy(touch->share, share, sizeof(share));
    return true;
}

static kiriBox BoxAround(const EdgePoint* point)
{
    kiriVec3 a = kiriVec3_AddScaled(point->at, point->above, point->out);
    kiriVec3 b = kiriVec3_AddScaled(point->at, -point->below, point->out);
    kiriBox box = { { a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z },
                    { a.x < b.x ? b.x : a.x, a.y < b.y ? b.y : a.y, a.z < b.z ? b.z : a.z } };
    return box;
}

/* Several layers may lie over a point: each has a touch, up to a number. */
static bool TouchPoint(const Pair* pair, const EdgePoint* point)
{
    enum { MOST_LAYERS = 4 };
    kiriSheetData* sheet = pair->sheet;
    kiriObstacleSearch* search = pair->search;
    kiriBox box = BoxAround(point);
    search->crossed.count = 0;
    bool ok = kiriBounds_Box(sheet->seen.bounds, &sheet->seen.surface, &box, search->memory, &search->crossed);
    uint32_t layers = 0;
    for (int32_t i = 0; ok && i < search->crossed.count && layers < MOST_LAYERS; ++i) {
        kiriTouch touch;
        if (TouchTriangle(pair, point, search->crossed.data[i], &touch)) {
            touch.key = KeyOf(pair, true, point->item * MOST_LAYERS + layers++);
            ok = kiriTouches_Add(sheet, &touch);
        }
    }
    return ok;
}

/* A point of the edge (local), with the faces beside it. */
static EdgePoint MakePoint(const Pair* pair, const kiriObstacleEdge* edge, kiriVec3 at, kiriVec3 side, uint32_t item)
{
    const kiriObstacleData* obstacle = pair->obstacle;
    double rounding = obstacle->shape.rounding;
    EdgePoint point;
    point.at = kiriObstacle_PointToWorld(obstacle, at);
    point.faces[0] = kiriObstacle_ToWorld(obstacle, edge->faces[0]);
    point.faces[1] = kiriObstacle_ToWorld(obstacle, side);
    point.out = kiriVec3_Normalize(kiriVec3_Add(point.faces[0], point.faces[1]));
    point.below = edge->thinnest < pair->patch ? edge->thinnest : pair->patch;
    point.above = rounding + pair->gap + pair->reach;
    point.item = item;
    return point;
}

static bool TouchRim(const Pair* pair, const kiriObstacleEdge* edge, int32_t index)
{
    int32_t count = 8;
    while (count < 1024 && count * pair->patch < 6.3 * edge->radius) {
        count *= 2;
    }
    bool ok = true;
    for (int32_t i = 0; ok && i < count; ++i) {
        kiriVec2 circle = kiriCircle_At(i, count);
        kiriVec3 side = kiriVec3_Make(circle.x, circle.y, 0.0);
        EdgePoint point = MakePoint(pair, edge, kiriVec3_AddScaled(edge->from, edge->radius, side), side,
                                    (uint32_t)(index * 1024 + i));
        ok = TouchPoint(pair, &point);
    }
    return ok;
}

/* The part of an edge, counted in steps, that is in the sheet's box. */
static void ClipEdge(const Pair* pair, kiriVec3 from, kiriVec3 step, int32_t* first, int32_t* last)
{
    kiriBox box = kiriBounds_All(pair->sheet->seen.bounds);
    const double lower[3] = { box.lower.x, box.lower.y, box.lower.z },
                 upper[3] = { box.upper.x, box.upper.y, box.upper.z };
    const double a[3] = { from.x, from.y, from.z }, d[3] = { step.x, step.y, step.z };
    double start = *first, end = *last, margin = pair->reach + pair->gap + pair->patch;
    for (int k = 0; k < 3; ++k) {
        double enter = lower[k] - margin - a[k], leave = upper[k] + margin - a[k];
        if (fabs(d[k]) * (end - start + 1.0) < 1e-9) {
            end = enter > 0.0 || leave < 0.0 ? start - 1.0 : end;
            continue;
        }
        double s = d[k] > 0.0 ? enter / d[k] : leave / d[k], t = d[k] > 0.0 ? leave / d[k] : enter / d[k];
        start = s > start ? s : start;
        end = t < end ? t : end;
    }
    *first = start <= end ? (int32_t)start : 0;
    *last = start <= end ? (int32_t)end : -1;
}

/* An edge without end has points as far as anybody may look. */
static bool TouchStraight(const Pair* pair, const kiriObstacleEdge* edge, int32_t index)
{
    enum { MOST_POINTS = 1 << 18 };
    kiriVec3 from = edge->from, way = kiriVec3_Sub(edge->to, edge->from);
    if (pair->obstacle->shape.half >= KIRI_ENDLESS) {
        way = kiriVec3_Make(0.0, 0.0, MOST_POINTS * pair->patch);
        from.z = -0.5 * way.z;
    }
    double length = kiriVec3_Length(way), wanted = length / pair->patch;
    int32_t count = wanted < 1.0 ? 1 : wanted < MOST_POINTS ? (int32_t)wanted + 1 : MOST_POINTS;
    int32_t first = 0, last = count;
    kiriVec3 step = kiriVec3_Scale(1.0 / count, way);
    ClipEdge(pair, kiriObstacle_PointToWorld(pair->obstacle, from), kiriObstacle_ToWorld(pair->obstacle, step), &first,
             &last);
    bool ok = true;
    for (int32_t i = first; ok && i <= last && i <= count; ++i) {
        EdgePoint point = MakePoint(pair, edge, kiriVec3_AddScaled(from, i, step), edge->faces[1],
                                    (uint32_t)(index * (MOST_POINTS + 1) + i));
        ok = TouchPoint(pair, &point);
    }
    return ok;
}

static bool TouchEdges(const Pair* pair)
{
    const kiriObstacleShape* shape = &pair->obstacle->shape;
    bool ok = true;
    for (int32_t i = 0; ok && i < kiriObstacleShape_EdgeCount(shape); ++i) {
        kiriObstacleEdge edge;
        if (kiriObstacleShape_EdgeAt(shape, i, &edge)) {
            ok = edge.radius > 0.0 ? TouchRim(pair, &edge, i) : TouchStraight(pair, &edge, i);
        }
    }
    return ok;
}

/* ---- Search ------------------------------------------------------------------------------------------------------- */

/* Squares along the side of a patch. */
static int32_t PatchSide(const kiriSheetData* sheet, double square)
{
    double area = 0.0;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        area += sheet->frames.data[i].area;
    }
    double side = sqrt(area / (PATCHES_A_FRAME * sheet->frames.count)) / square;
    return side < 2.0 ? 1 : side < 4096.0 ? (int32_t)side : 4096;
}

bool kiriObstacleSearch_Reserve(kiriObstacleSearch* search, const kiriSheetData* sheet)
{
    const kiriSquares* squares = &sheet->mesh.squares;
    int32_t vertices = sheet->seen.surface.vertexCount, triangles = sheet->seen.surface.triangleCount;
    int32_t patches = squares->columns * squares->rows, oldMarks = search->marks.count, oldHeads = search->heads.count;
    if (!kiriArray_Reserve(search->memory, &search->triangles, triangles) ||
        !kiriArray_Reserve(search->memory, &search->crossed, triangles) ||
        !kiriArray_Reserve(search->memory, &search->chosen, vertices) ||
        (oldMarks < vertices && !kiriArray_Resize(search->memory, &search->marks, vertices)) ||
        (oldHeads < patches && !kiriArray_Resize(search->memory, &search->heads, patches))) {
        return false;
    }
    for (int32_t i = oldMarks; i < search->marks.count; ++i) {
        search->marks.data[i] = 0;
    }
    for (int32_t i = oldHeads; i < search->heads.count; ++i) {
        search->heads.data[i] = KIRI_NONE;
    }
    return true;
}

static Pair MakePair(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle, double speed,
                     int32_t yield)
{
    Pair pair = { search,
                  sheet,
                  obstacle,
                  { 0.0, 0.0, 0.0 },
                  0.5 * sheet->settings.contactThickness,
                  0.0,
                  0.0,
                  1,
                  1,
                  sqrt(sheet->settings.friction * obstacle->friction),
                  yield };
    kiriBox box = kiriBounds_All(sheet->seen.bounds);
    double square = sheet->mesh.step * sheet->mesh.squares.side;
    pair.squares = PatchSide(sheet, square);
    pair.columns = (sheet->mesh.squares.columns + pair.squares - 1) / pair.squares;
    pair.patch = square * pair.squares;
    pair.reach = kiriReach_Of(speed + SpeedOf(obstacle, &box), search->gravity, search->dt) + (1.0 + NEARBY) * pair.gap;
    if (sheet->settings.mechanics.planar) {
        pair.across = kiriObstacle_ToLocal(obstacle, sheet->settings.mechanics.axes.d);
    }
    return pair;
}

bool kiriObstacleSearch_Run(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle,
                            double speed, int32_t yield)
{
    Pair pair = MakePair(search, sheet, obstacle, speed, yield);
    search->triangles.count = 0;
    if (!kiriBounds_Find(sheet->seen.bounds, &sheet->seen.surface, MeetsBox, &pair, search->memory,
                         &search->triangles)) {
        return false;
    }
    return search->triangles.count == 0 ||
           (TouchVertices(&pair) && (sheet->settings.mechanics.planar || TouchEdges(&pair)));
}
