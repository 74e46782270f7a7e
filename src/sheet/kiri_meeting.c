#include "kiri_meeting.h"
#include "kiri_piece.h"
#include "kiri_seen.h"

#define PREFERRED 0.5 /* of the contact distance: a vertex must be deeper by this to replace one that pushed */
enum { PATCHES = 16 }; /* of a frame: with 4, strips tremble on a floor */

/* Cosine of 25 degrees. Normals with a smaller angle belong to one face. */
#define SAME_FACE 0.9

/* Fraction of the contact distance. A point this little above it is a touch, even if it cannot reach it in this tick.
   So a resting point that lifts a little keeps its force. */
#define NEARBY 0.5

/* A piece that is deeper than DEEP, of the side of a grid square, leaves an obstacle along its own normals, if the way out
   is shorter than FARTHER times the depth. */
#define DEEP 0.5
#define FARTHER 4.0
#define LONGEST_WAY 1e3 /* m: no way out is longer */

/* Key bit of round sides: the item is a triangle, not a point of an edge. */
#define ROUND_ITEM (UINT32_C(1) << 31)

/* Input of the searches for one sheet and one obstacle. */
typedef struct kiriMeeting {
    kiriObstacleSearch* search;
    kiriSheetData* sheet;
    const kiriObstacleData* obstacle;
    kiriVec3 across;          /* plane normal of a planar sheet, local to the obstacle; else zero */
    double gap;               /* m: contact distance */
    double reach;             /* m: largest distance at which they may touch in the tick */
    double near;              /* m: a point so near is a touch, wherever it goes */
    double square;            /* m: side of a grid square */
    double friction;          /* coefficient of the pair */
    int32_t yield;            /* yield row of the obstacle's body, or KIRI_NONE */
    bool isThinned;           /* one vertex a patch touches; else all vertices */
} kiriMeeting;

/* ---- Touches ----------------------------------------------------------------------------------------------------- */

static bool MakePlane(const kiriMeeting* meeting, kiriVec3 normal, kiriVec3 at, double gap, kiriTouch* touch)
{
    const kiriMechanics* mechanics = &meeting->sheet->settings.mechanics;
    const kiriObstacleData* obstacle = meeting->obstacle;
    kiriVec3 slip = kiriVec3_Across(obstacle->surface, normal);
    KIRI_CLEAR(touch);
    touch->velocity = kiriVec3_Add(kiriObstacle_VelocityAt(obstacle, at), slip);
    touch->offset = kiriVec3_Dot(normal, at) + gap;
    if (mechanics->planar) {
        /* The plane's intersection with the sheet's plane: a line. */
        double lean = kiriVec3_Dot(normal, mechanics->axes.d), along = 1.0 - lean * lean;
        double height = kiriVec3_Dot(mechanics->axes.d, meeting->sheet->frames.data[0].x);
        if (along < 1e-2) {
            return false;
        }
        normal = kiriVec3_Scale(1.0 / sqrt(along), kiriVec3_AddScaled(normal, -lean, mechanics->axes.d));
        touch->offset = (touch->offset - lean * height) / sqrt(along);
    }
    touch->normal = normal;
    touch->on = at;
    touch->friction = meeting->friction;
    touch->pushSpeed = obstacle->pushSpeed;
    touch->yield = meeting->yield;
    touch->felt = -1.0;
    touch->point = KIRI_NONE;
    return true;
}

/* Returns the normal of the sheet at a vertex, local to the obstacle. */
static kiriVec3 NormalAt(const kiriMeeting* meeting, int32_t vertex)
{
    int32_t frame = kiriSkin_LeadingFrame(&meeting->sheet->vertexSkin, vertex);
    return kiriVec3_Normalize(kiriObstacle_ToLocal(meeting->obstacle, meeting->sheet->frames.data[frame].A.d));
}

/* Returns the distance from a point inside to the surface along a unit direction, m. Moves back from a point outside. */
static double WayOut(const kiriMeeting* meeting, kiriVec3 from, kiriVec3 along)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    double beyond = kiriObstacleShape_Reach(shape, along) - kiriVec3_Dot(along, from) + 2.0 * meeting->gap;
    if (beyond > LONGEST_WAY) {
        return LONGEST_WAY;
    }
    kiriNearest nearest;
    kiriVec3 outside = kiriVec3_AddScaled(from, beyond, along), back = kiriVec3_Scale(-beyond, along);
    double share = kiriObstacleShape_Enter(shape, outside, back, meeting->gap, meeting->across, &nearest);
    return beyond * (1.0 - share) - meeting->gap;
}

/* Turns the nearest place of a point inside to the place where it leaves along the normal of the sheet, if its piece
   leaves so. */
static void LeaveAlong(const kiriMeeting* meeting, int32_t vertex, kiriVec3 from, kiriNearest* nearest)
{
    int32_t piece = kiriPiece_OfVertex(meeting->sheet, vertex);
    double side = meeting->isThinned ? 0.0 : meeting->search->ways.data[piece].side;
    if (side != 0.0 && nearest->distance < 0.0) {
        kiriVec3 along = kiriVec3_Scale(side, NormalAt(meeting, vertex));
        *nearest = (kiriNearest){ -WayOut(meeting, from, along), along };
    }
}

static kiriVec3 WayOf(const kiriMeeting* meeting, kiriVec3 point, kiriVec3 velocity)
{
    const kiriObstacleSearch* search = meeting->search;
    kiriVec3 relative = kiriVec3_Sub(velocity, kiriObstacle_VelocityAt(meeting->obstacle, point));
    kiriVec3 way = kiriVec3_Scale(2.0 * search->dt, kiriVec3_AddScaled(relative, search->dt, search->gravity));
    if (meeting->sheet->settings.mechanics.planar) {
        way = kiriVec3_Across(way, meeting->sheet->settings.mechanics.axes.d);
    }
    return way;
}

static void SetPlace(kiriTouch* touch, const int32_t* vertices, const double* shares, int32_t count)
{
    KIRI_TIMES(k, 3) {
        touch->vertex[k] = k < count ? vertices[k] : KIRI_NONE;
        touch->share[k] = k < count ? shares[k] : 0.0;
    }
}

/* Makes the touch of a blend of up to three vertices with the plane through `on`. `above` is the height of the blend, at
   `at`, over that plane, m. Returns false if it stays more than `most` above the plane in the tick. */
static bool TouchMixed(const kiriMeeting* meeting, const int32_t* v, const double* share, int32_t count, kiriVec3 at,
                       kiriVec3 normal, double above, double most, kiriVec3 on, double gap, kiriTouch* touch)
{
    kiriVec3 velocity = { 0 };
    KIRI_TIMES(k, count) {
        velocity = kiriVec3_AddScaled(velocity, share[k], kiriProbe_Velocity(meeting->sheet, v[k]));
    }
    if (above + kiriVec3_Dot(normal, WayOf(meeting, at, velocity)) > most ||
        !MakePlane(meeting, normal, on, gap, touch)) {
        return false;
    }
    SetPlace(touch, v, share, count);
    return true;
}

static bool IsBorderEdge(const kiriSurface* surface, const kiriIndices* near, int32_t a, int32_t b)
{
    KIRI_EACH_LISTED(triangle, *near) {
        const int32_t* v = kiriSurface_Triangle(surface, triangle);
        if ((v[0] == b && v[1] == a) || (v[1] == b && v[2] == a) || (v[2] == b && v[0] == a)) {
            return false;
        }
    }
    return true;
}

enum { KEY_SLOTS = 1 << 22 };

static uint64_t MakeKey(const kiriMeeting* meeting, bool isEdge, uint32_t item)
{
    return (uint64_t)KIRI_TOUCH_OBSTACLE << 60 | (uint64_t)isEdge << 59 |
           (uint64_t)(meeting->obstacle->id & (KEY_SLOTS - 1)) << 32 | item;
}

bool kiriObstacle_FollowKey(uint64_t* key, const kiriKeep* vertices, const kiriKeep* triangles)
{
    bool isEdge = (*key >> 59 & 1) != 0, isRound = isEdge && (*key & ROUND_ITEM) != 0;
    int32_t item = (int32_t)(*key & (ROUND_ITEM - 1));
    if (isEdge && !isRound) {
        return true; /* the item is a point of the obstacle */
    }
    const kiriKeep* keep = isRound ? triangles : vertices;
    int32_t to = item < keep->to.count ? kiriKeep_To(keep, item) : KIRI_NONE; /* keys of a save may say anything */
    *key = (*key & ~(uint64_t)(ROUND_ITEM - 1)) | (uint32_t)to;
    return to != KIRI_NONE;
}

int32_t kiriObstacle_SlotOfKey(uint64_t key)
{
    return (int32_t)(key >> 32 & (KEY_SLOTS - 1));
}

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

static bool IsBoxNear(const void* context, const kiriBox* box)
{
    const kiriMeeting* meeting = context;
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    kiriVec3 middle = kiriVec3_Scale(0.5, kiriVec3_Add(box->lower, box->upper)), none = { 0 };
    double reach = meeting->reach + 0.5 * kiriVec3_Distance(box->upper, box->lower);
    kiriVec3 local = kiriObstacle_PointToLocal(meeting->obstacle, middle);
    return kiriObstacleShape_MayReach(shape, local, reach) &&
           kiriObstacleShape_Nearest(shape, local, none).distance < reach;
}

/* Adds a vertex. Keeps the deepest one on each face of a patch. */
static void Choose(kiriObstacleSearch* search, kiriNearVertex near)
{
    int32_t* link = &search->heads.data[near.patch];
    while (*link != KIRI_NONE) {
        kiriNearVertex* chosen = &search->chosen.data[*link];
        if (kiriVec3_Dot(chosen->normal, near.normal) > SAME_FACE) {
            if (near.height < chosen->height) {
                near.next = chosen->next;
                *chosen = near;
            }
            return;
        }
        link = &chosen->next;
    }
    *link = search->chosen.count;
    KIRI_NEXT(search->chosen) = near;
}

/* Looks at a vertex near a plane or a body with mass. The patches of its frame are 4 x 4 round the centre of mass: so a frame rests
   on points on all sides, however small or narrow its piece is. A vertex far from the centre counts as deeper, so a flat patch has
   its corner; and one that had a force, so that vertices of similar depth do not alternate. */
static void ChooseInPatch(const kiriMeeting* meeting, int32_t vertex, const kiriNearest* nearest)
{
    const kiriSheetData* sheet = meeting->sheet;
    int32_t f = kiriSkin_LeadingFrame(&sheet->vertexSkin, vertex);
    const kiriFrameData* frame = &sheet->frames.data[f];
    kiriVec2 from = kiriVec2_Sub(sheet->seen.surface.rest.data[vertex], frame->center);
    bool pushed = nearest->distance <= 2.0 * meeting->gap && meeting->search->marks.data[vertex] > meeting->search->mark;
    bool yields = kiriTouches_CanYield(sheet, meeting->yield); /* the deepest point stops a body with mass */
    double side = sqrt(frame->area), inner = 0.25 * side, deeper = pushed + (yields ? 0.0 : kiriVec2_Length(from) / side);
    int32_t patch = (from.x >= 0.0) + 2 * (from.y >= 0.0) + 4 * (fabs(from.x) > inner) + 8 * (fabs(from.y) > inner);
    KIRI_ASSERT(side > 0.0 && patch < PATCHES);
    Choose(meeting->search, (kiriNearVertex){ vertex, PATCHES * f + patch, KIRI_NONE,
                                              nearest->distance - PREFERRED * meeting->gap * deeper, nearest->normal });
}

static void LookAtVertex(const kiriMeeting* meeting, int32_t vertex)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    kiriVec3 x = kiriSurface_At(&meeting->sheet->seen.surface, vertex);
    kiriVec3 local = kiriObstacle_PointToLocal(meeting->obstacle, x);
    if (!kiriObstacleShape_MayReach(shape, local, meeting->reach)) {
        return;
    }
    kiriNearest nearest = kiriObstacleShape_Nearest(shape, local, meeting->across);
    if (nearest.distance < meeting->reach && meeting->isThinned) {
        ChooseInPatch(meeting, vertex, &nearest);
    } else if (nearest.distance < meeting->reach) {
        KIRI_NEXT(meeting->search->chosen) = (kiriNearVertex){ .vertex = vertex, .height = nearest.distance };
    }
}

/* Lists each vertex of the near triangles once, ascending, so that the choice does not depend on the order of
   triangles. */
static void CollectVertices(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    const int32_t* indices = meeting->sheet->seen.surface.indices.data;
    int32_t low = INT32_MAX, high = -1;
    search->mark += 2;
    search->vertices.count = 0;
    KIRI_EACH_LISTED(triangle, search->triangles) {
        KIRI_EACH_CORNER(k) {
            int32_t vertex = indices[3 * triangle + k];
            if (search->marks.data[vertex] != search->mark) {
                search->marks.data[vertex] = search->mark;
                KIRI_NEXT(search->vertices) = vertex;
                low = kiriMin(vertex, low);
                high = kiriMax(vertex, high);
            }
        }
    }
    if (high - low > 16 * (int64_t)search->vertices.count) {
        kiriSort(search->vertices.data, search->vertices.count, NULL, NULL);
        return;
    }
    search->vertices.count = 0;
    for (int32_t v = low; v <= high; ++v) {
        search->vertices.data[search->vertices.count] = v;
        search->vertices.count += search->marks.data[v] == search->mark;
    }
}

/* Marks the found vertices that had a force. */
static void MarkPushed(const kiriMeeting* meeting, const kiriTouchMemory* memory)
{
    kiriObstacleSearch* search = meeting->search;
    uint64_t first = MakeKey(meeting, false, 0), end = MakeKey(meeting, false, (uint32_t)search->marks.count);
    for (int32_t k = kiriTouchMemory_FirstFrom(memory, first); k < memory->forces.count; ++k) {
        uint64_t key = memory->forces.data[k].key;
        if (key >= end) {
            return;
        }
        search->marks.data[key - first] += search->marks.data[key - first] == search->mark;
    }
}

static void ChooseVertices(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    search->chosen.count = 0;
    CollectVertices(meeting);
    MarkPushed(meeting, &meeting->sheet->touches.last);
    MarkPushed(meeting, &meeting->sheet->touches.slept);
    KIRI_EACH_LISTED(vertex, search->vertices) {
        LookAtVertex(meeting, vertex);
    }
    KIRI_EACH_WHILE(meeting->isThinned, const kiriNearVertex, chosen, search->chosen) {
        search->heads.data[chosen->patch] = KIRI_NONE;
    }
}

/* Returns the part of a way after which it goes away from the obstacle, and the nearest place there. A plane of a later place may
   have the start below it, and would push what only passes by. */
static double PassBy(const kiriMeeting* meeting, kiriVec3 from, kiriVec3 way, kiriNearest* nearest)
{
    enum { BISECTIONS = 12 };
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    double low = 0.0, high = 1.0;
    KIRI_TIMES(bisection, BISECTIONS) {
        double middle = 0.5 * (low + high);
        kiriVec3 at = kiriVec3_AddScaled(from, middle, way);
        *nearest = kiriObstacleShape_Nearest(shape, at, meeting->across);
        *(kiriVec3_Dot(nearest->normal, way) > 0.0 ? &high : &low) = middle;
    }
    *nearest = kiriObstacleShape_Nearest(shape, kiriVec3_AddScaled(from, low, way), meeting->across);
    return low;
}

/* Makes the touch of a vertex: the plane where it enters the obstacle, or the nearest one. Returns false if none. */
static bool TouchVertex(const kiriMeeting* meeting, int32_t vertex, kiriTouch* touch)
{
    const kiriObstacleData* obstacle = meeting->obstacle;
    kiriVec3 x = kiriSurface_At(&meeting->sheet->seen.surface, vertex), from = kiriObstacle_PointToLocal(obstacle, x);
    kiriVec3 velocity = kiriProbe_Velocity(meeting->sheet, vertex);
    kiriNearest nearest;
    if (kiriVec3_Dot(obstacle->spin, obstacle->spin) > 0.0) { /* a turn moves the surface along its normal only */
        nearest = kiriObstacleShape_Nearest(&obstacle->shape, from, meeting->across);
        velocity = kiriVec3_Add(velocity, kiriVec3_Across(kiriVec3_Sub(kiriObstacle_VelocityAt(obstacle, x), obstacle->velocity),
                                                          kiriObstacle_ToWorld(obstacle, nearest.normal)));
    }
    kiriVec3 way = kiriObstacle_ToLocal(obstacle, WayOf(meeting, x, velocity));
    double share = kiriObstacleShape_Enter(&obstacle->shape, from, way, meeting->gap, meeting->across, &nearest);
    bool enters = share < 1.0;
    if (!enters && nearest.distance > meeting->near + kiriVec3_Length(way)) {
        return false; /* no place of the way is near */
    }
    if (share > 0.0 && kiriVec3_Dot(nearest.normal, way) > 0.0) {
        share = PassBy(meeting, from, way, &nearest);
    }
    if (!enters && nearest.distance > meeting->near) {
        return false;
    }
    LeaveAlong(meeting, vertex, from, &nearest);
    kiriVec3 there = kiriVec3_AddScaled(kiriVec3_AddScaled(from, share, way), -nearest.distance, nearest.normal);
    if (!MakePlane(meeting, kiriObstacle_ToWorld(obstacle, nearest.normal), kiriObstacle_PointToWorld(obstacle, there),
                   meeting->gap, touch)) {
        return false;
    }
    KIRI_ASSERT(!(share > 0.0) ||
                kiriVec3_Dot(touch->normal, x) > touch->offset - 0.01 * meeting->gap - 1e-12 * fabs(touch->offset));
    SetPlace(touch, &vertex, (const double[1]){ 1.0 }, 1);
    touch->key = MakeKey(meeting, false, (uint32_t)vertex);
    return true;
}

/* Chooses for each piece to which side it leaves. If it lies deep in the obstacle, the nearest places of its vertices are on
   all sides: they would stretch it, or hold it there. So it leaves along its normals, by the shorter way. */
static void ChooseSides(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    search->ways.count = meeting->sheet->layout.pieces.count;
    KIRI_EACH(kiriWayOut, way, search->ways) {
        KIRI_CLEAR(way);
    }
    KIRI_EACH_WHILE(!meeting->sheet->settings.mechanics.planar, const kiriNearVertex, chosen, search->chosen) {
        if (chosen->height < 0.0) {
            kiriWayOut* way = &search->ways.data[kiriPiece_OfVertex(meeting->sheet, chosen->vertex)];
            kiriVec3 x = kiriSurface_At(&meeting->sheet->seen.surface, chosen->vertex);
            kiriVec3 from = kiriObstacle_PointToLocal(meeting->obstacle, x), normal = NormalAt(meeting, chosen->vertex);
            double front = WayOut(meeting, from, normal), back = WayOut(meeting, from, kiriVec3_Scale(-1.0, normal));
            way->depth = kiriMax(-chosen->height, way->depth);
            way->front = kiriMax(front, way->front);
            way->back = kiriMax(back, way->back);
        }
    }
    KIRI_EACH(kiriWayOut, way, search->ways) {
        bool leaves = way->depth > DEEP * meeting->square && kiriMin(way->front, way->back) < FARTHER * way->depth;
        way->side = !leaves ? 0.0 : way->front <= way->back ? 1.0 : -1.0;
    }
}

static bool TouchVertices(const kiriMeeting* meeting)
{
    bool ok = true;
    ChooseVertices(meeting);
    if (!meeting->isThinned) {
        ChooseSides(meeting);
    }
    KIRI_EACH_WHILE(ok, const kiriNearVertex, chosen, meeting->search->chosen) {
        kiriTouch touch;
        if (TouchVertex(meeting, chosen->vertex, &touch)) {
            ok = kiriTouches_Add(meeting->sheet, &touch);
        }
    }
    return ok;
}

/* ---- Between vertices ---- */

static kiriVec3 BlendOfThree(const kiriVec3 x[3], const double share[3])
{
    return kiriVec3_AddScaled(kiriVec3_AddScaled(kiriVec3_Scale(share[0], x[0]), share[1], x[1]), share[2], x[2]);
}

/* Finds the point of a triangle nearest to the axis of a round obstacle, by alternating projections. Both are convex,
   so they converge. */
static void NearestToAxis(double half, const kiriVec3 x[3], double share[3])
{
    enum { TURNS = 24 };
    kiriVec3 onAxis = { 0 };
    KIRI_TIMES(turn, TURNS) {
        kiriTriangle_Nearest(x, onAxis, share);
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
    return zero != KIRI_NONE && IsBorderEdge(&meeting->sheet->seen.surface, &meeting->search->triangles,
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
    kiriVec3 x[3];
    double share[3];
    GetCorners(meeting, triangle, x);
    NearestToAxis(obstacle->shape.half, x, share);
    if (!CountsBetween(meeting, v, share)) {
        return false;
    }
    kiriVec3 local = BlendOfThree(x, share);
    kiriNearest nearest = kiriObstacleShape_Nearest(&obstacle->shape, local, meeting->across);
    LeaveAlong(meeting, v[0], local, &nearest);
    kiriVec3 on = kiriObstacle_PointToWorld(obstacle, kiriVec3_AddScaled(local, -nearest.distance, nearest.normal));
    return TouchMixed(meeting, v, share, 3, kiriObstacle_PointToWorld(obstacle, local),
                      kiriObstacle_ToWorld(obstacle, nearest.normal), nearest.distance, meeting->near, on, meeting->gap,
                      touch);
}

/* Lists the coarse triangles nearby, ascending: a side is so long that an arc of the obstacle fits between its ends. */
static bool CollectCoarse(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    bool ok = true;
    search->crossed.count = 0;
    KIRI_EACH_LISTED_WHILE(ok, triangle, search->triangles) {
        kiriVec3 x[3];
        double longest = 0.0;
        GetCorners(meeting, triangle, x);
        KIRI_EACH_CORNER(k) {
            double length = kiriVec3_Distance(x[(k + 1) % 3], x[k]);
            longest = kiriMax(length, longest);
        }
        bool isCoarse = longest * longest > 16.0 * meeting->gap * meeting->obstacle->shape.radius;
        ok = !isCoarse || kiriArray_Push(search->memory, &search->crossed, triangle);
    }
    if (search->crossed.count > 0) {
        kiriSort(search->crossed.data, search->crossed.count, NULL, NULL);
    }
    return ok;
}

static bool TouchRounds(const kiriMeeting* meeting)
{
    const kiriIndices* coarse = &meeting->search->crossed;
    if (!(meeting->obstacle->shape.radius > 0.0)) {
        return true;
    }
    bool ok = CollectCoarse(meeting);
    KIRI_EACH_LISTED_WHILE(ok, triangle, *coarse) {
        kiriTouch touch;
        if (TouchRound(meeting, triangle, &touch)) {
            touch.key = MakeKey(meeting, true, ROUND_ITEM | (uint32_t)triangle);
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

/* Returns true if the normal can be of a tangent plane at the edge: it opposes none of the faces. */
static bool IsTangentTo(const EdgePoint* point, kiriVec3 normal)
{
    KIRI_TIMES(k, point->faceCount) {
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
    kiriVec3 x[3];
    double height, share[3], gap = meeting->gap + meeting->obstacle->shape.rounding;
    kiriSurface_Corners(surface, triangle, x);
    if (!kiriTriangle_Cross(x, point->at, point->out, &height, share) || !(height > -point->below) ||
        !(height < point->above)) {
        return false;
    }
    kiriVec3 at = kiriVec3_AddScaled(point->at, height, point->out);
    kiriSurface_NeedNormals(surface);
    kiriVec3 normal = kiriTriangle_SkinNormal(sheet, triangle, share);
    normal = kiriVec3_Scale(kiriVec3_Dot(normal, point->out) < 0.0 ? -1.0 : 1.0, normal); /* on the side of `out` */
    double above = height * kiriVec3_Dot(normal, point->out) - gap;
    return IsTangentTo(point, normal) &&
           TouchMixed(meeting, v, share, 3, at, normal, above, meeting->near - meeting->gap, point->at, gap, touch);
}

static bool MeetsLine(const void* context, const kiriBox* box)
{
    const EdgePoint* point = context;
    double from = -point->below, to = point->above;
    return kiriBox_Clip(box, LINE_SLACK, point->at, point->out, &from, &to);
}

/* Adds a touch for each layer over a point, up to MOST_LAYERS. Triangles ascend, so that layers get the same keys in each
   tick. */
static bool TouchPoint(const kiriMeeting* meeting, const EdgePoint* point)
{
    enum { MOST_LAYERS = 4 };
    kiriObstacleSearch* search = meeting->search;
    uint32_t layers = 0;
    search->crossed.count = 0;
    bool ok = kiriBounds_Find(meeting->sheet->seen.bounds, &meeting->sheet->seen.surface, MeetsLine, point,
                              search->memory, &search->crossed);
    KIRI_EACH_LISTED_WHILE(ok && layers < MOST_LAYERS, triangle, search->crossed) {
        kiriTouch touch;
        if (TouchTriangle(meeting, point, triangle, &touch)) {
            touch.key = MakeKey(meeting, true, point->item * MOST_LAYERS + layers++);
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
    KIRI_TIMES(k, faceCount) {
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
    KIRI_TIMES_WHILE(ok, i, count) {
        kiriVec2 circle = kiriCircle_At(i, count);
        kiriVec3 faces[2] = { edge->faces[0], { circle.x, circle.y, 0.0 } };
        EdgePoint point =
            MakePoint(meeting, kiriVec3_AddScaled(edge->from, edge->radius, faces[1]), faces, 2, edge->thinnest);
        point.item = (uint32_t)(index * 1024 + i);
        ok = TouchPoint(meeting, &point);
    }
    return ok;
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
    int32_t count = wanted < MOST_POINTS - 1 ? (int32_t)wanted + 1 : MOST_POINTS;
    double first = 0.0, last = count - 1.0, margin = meeting->reach + meeting->gap + meeting->square;
    kiriVec3 step = kiriVec3_Scale(1.0 / count, way);
    from = kiriVec3_AddScaled(from, 0.5, step);
    kiriBox box = kiriBounds_All(meeting->sheet->seen.bounds);
    bool ok = true;
    if (!kiriBox_Clip(&box, margin, kiriObstacle_PointToWorld(meeting->obstacle, from),
                      kiriObstacle_ToWorld(meeting->obstacle, step), &first, &last)) {
        return true;
    }
    for (int32_t i = (int32_t)first; ok && i <= (int32_t)last; ++i) {
        EdgePoint point = MakePoint(meeting, kiriVec3_AddScaled(from, i, step), edge->faces, 2, edge->thinnest);
        point.item = (uint32_t)index * MOST_POINTS + (uint32_t)i;
        ok = TouchPoint(meeting, &point);
    }
    return ok;
}

/* Corners of a finite prism, where three faces meet. One that is nearly flat along the outline has edges enough. */
static bool TouchTips(const kiriMeeting* meeting)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    const uint32_t tips = UINT32_C(1) << 28; /* first item number of corners, above all points of edges */
    int32_t count = shape->type == KIRI_OBSTACLE_PRISM && shape->half < KIRI_ENDLESS ? 2 * shape->count : 0;
    bool ok = true;
    KIRI_TIMES_WHILE(ok, i, count) {
        kiriObstacleEdge edge;
        if (kiriObstacleShape_EdgeAt(shape, i % shape->count, &edge)) {
            bool isLow = i < shape->count;
            const kiriVec3 faces[3] = { edge.faces[0], edge.faces[1], { 0.0, 0.0, isLow ? -1.0 : 1.0 } };
            EdgePoint point = MakePoint(meeting, isLow ? edge.from : edge.to, faces, 3, edge.thinnest);
            point.item = tips + (uint32_t)i;
            ok = TouchPoint(meeting, &point);
        }
    }
    return ok;
}

static bool TouchEdges(const kiriMeeting* meeting)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    bool ok = TouchTips(meeting);
    KIRI_TIMES_WHILE(ok, i, kiriObstacleShape_EdgeCount(shape)) {
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
    KIRI_TIMES(k, 2) {
        kiriVec3 face = point->faces[k];
        point->faces[k] = kiriVec3_Normalize(kiriVec3_Across(face, d));
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
        !IsBorderEdge(&sheet->seen.surface, &meeting->search->crossed, a, b)) {
        return false;
    }
    /* The material is left of its border, so the normal points into the material, away from the obstacle. */
    kiriVec3 normal = kiriVec3_Normalize(kiriVec3_Cross(d, kiriVec3_Sub(to, from)));
    double above = height * kiriVec3_Dot(normal, point->out) - gap, shares[2] = { 1.0 - share, share };
    return IsTangentTo(point, normal) &&
           TouchMixed(meeting, (const int32_t[2]){ a, b }, shares, 2, kiriVec3_AddScaled(point->at, height, point->out),
                      normal, above, meeting->near - meeting->gap, point->at, gap, touch);
}

static bool MeetsBox(const void* context, const kiriBox* box)
{
    return kiriBox_Meet(context, box);
}

static bool TouchCorner(const kiriMeeting* meeting, const EdgePoint* point)
{
    enum { MOST_SIDES = 4 };
    kiriSheetData* sheet = meeting->sheet;
    kiriObstacleSearch* search = meeting->search;
    kiriVec3 a = kiriVec3_AddScaled(point->at, point->above, point->out);
    kiriVec3 b = kiriVec3_AddScaled(point->at, -point->below, point->out);
    kiriBox box = KIRI_EMPTY_BOX;
    uint32_t sides = 0;
    kiriBox_Add(&box, a);
    kiriBox_Add(&box, b);
    search->crossed.count = 0;
    bool ok =
        kiriBounds_Find(sheet->seen.bounds, &sheet->seen.surface, MeetsBox, &box, search->memory, &search->crossed);
    for (int32_t i = 0; ok && i < 3 * search->crossed.count && sides < MOST_SIDES; ++i) {
        const int32_t* v = kiriSurface_Triangle(&sheet->seen.surface, search->crossed.data[i / 3]);
        kiriTouch touch;
        if (TouchSide(meeting, point, v[i % 3], v[(i + 1) % 3], &touch)) {
            touch.key = MakeKey(meeting, true, point->item * MOST_SIDES + sides++);
            ok = kiriTouches_Add(sheet, &touch);
        }
    }
    return ok;
}

static bool TouchCorners(const kiriMeeting* meeting)
{
    const kiriObstacleShape* shape = &meeting->obstacle->shape;
    bool ok = true;
    KIRI_TIMES_WHILE(ok, i, kiriObstacleShape_EdgeCount(shape)) {
        kiriObstacleEdge edge;
        EdgePoint point;
        if (kiriObstacleShape_EdgeAt(shape, i, &edge) && CutEdge(meeting, &edge, i, &point)) {
            ok = TouchCorner(meeting, &point);
        }
    }
    return ok;
}

/* ---- Search ------------------------------------------------------------------------------------------------------ */

typedef struct NearBox {
    const kiriObstacleData* obstacle;
    double reach;
} NearBox;

static bool IsBoxWithin(const void* context, const kiriBox* box)
{
    const NearBox* near = context;
    return kiriObstacle_IsNear(near->obstacle, box->lower, box->upper, near->reach);
}

bool kiriObstacleSearch_Near(kiriObstacleSearch* search, const kiriSheetData* sheet, const kiriObstacleData* obstacle,
                             double reach)
{
    const NearBox near = { obstacle, reach };
    search->triangles.count = 0;
    return kiriBounds_Find(sheet->seen.bounds, &sheet->seen.surface, IsBoxWithin, &near, search->memory,
                           &search->triangles);
}

bool kiriObstacleSearch_Reserve(kiriObstacleSearch* search, const kiriSheetData* sheet)
{
    int32_t vertices = sheet->seen.surface.vertexCount, triangles = sheet->seen.surface.triangleCount;
    int32_t patches = PATCHES * sheet->frames.count, oldMarks = search->marks.count, oldHeads = search->heads.count;
    if (!kiriArrays_Reserve(search->memory, triangles, &search->triangles, &search->crossed) ||
        !kiriArray_Reserve(search->memory, &search->vertices, (int64_t)vertices + 1) ||
        !kiriArray_Reserve(search->memory, &search->chosen, vertices) ||
        !kiriArray_Reserve(search->memory, &search->ways, sheet->layout.pieces.count) ||
        (oldMarks < vertices && !kiriArray_Resize(search->memory, &search->marks, vertices)) ||
        (oldHeads < patches && !kiriArray_Resize(search->memory, &search->heads, patches))) {
        return false;
    }
    KIRI_FROM_TO(i, oldMarks, search->marks.count) {
        search->marks.data[i] = 0;
    }
    KIRI_FROM_TO(i, oldHeads, search->heads.count) {
        search->heads.data[i] = KIRI_NONE;
    }
    return true;
}

#define ORDINARY 100.0 /* m/s^2: acceleration by a sheet's own weight and tension, where it lies on what cannot move */

/* Returns how far the forces of the last tick could move the frames that bear them in this tick, m. A heavy obstacle
   stretches the sheet: a point of it that slips off moves by hundreds of g. */
static double WayUnderLoad(const kiriSheetData* sheet, const kiriObstacleData* obstacle, double dt)
{
    double fastest = 0.0;
    KIRI_EACH(const kiriTouch, touch, sheet->touches.last.touches) {
        if (kiriTouch_IsOfKind(touch, KIRI_TOUCH_OBSTACLE) &&
            kiriObstacle_SlotOfKey(touch->key) == (int32_t)(obstacle->id & (KEY_SLOTS - 1))) {
            double mass = sheet->frames.data[kiriSkin_LeadingFrame(&sheet->vertexSkin, touch->vertex[0])].mass;
            double force = kiriVec3_Length(kiriTouches_ForceOf(sheet, touch->key));
            fastest = kiriMax(force / mass, fastest);
        }
    }
    return dt * dt * kiriMax(fastest - (kiriObstacle_IsMovable(obstacle) ? 0.0 : ORDINARY), 0.0);
}

static kiriMeeting MakeMeeting(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle,
                               double speed, int32_t yield)
{
    kiriMeeting meeting = { search,
                            sheet,
                            obstacle,
                            { 0.0, 0.0, 0.0 },
                            0.5 * sheet->settings.contactThickness,
                            0.0,
                            0.0,
                            0.0,
                            sqrt(sheet->settings.friction * obstacle->friction),
                            yield,
                            obstacle->shape.type == KIRI_OBSTACLE_PLANE || kiriTouches_CanYield(sheet, yield) };
    kiriBox box = kiriBounds_All(sheet->seen.bounds);
    meeting.square = sheet->mesh.step * sheet->mesh.squares.side;
    meeting.near = (1.0 + NEARBY) * meeting.gap + WayUnderLoad(sheet, obstacle, search->dt);
    double turns = kiriVec3_Length(obstacle->spin) * kiriBox_Farthest(&box, obstacle->position);
    speed += kiriVec3_Length(obstacle->velocity) + turns; /* at most: of the obstacle within the sheet's box */
    meeting.reach = kiriReach_Of(speed, search->gravity, search->dt) + meeting.near;
    if (sheet->settings.mechanics.planar) {
        meeting.across = kiriObstacle_ToLocal(obstacle, sheet->settings.mechanics.axes.d);
    }
    return meeting;
}

/* Returns the version of the movers; 0 if another piece woke since, or wakes in this tick. */
static int64_t VersionOf(const kiriSheetData* sheet)
{
    const kiriMoved* moved = &sheet->solver->moved;
    bool isSame = moved->isListed && moved->version == sheet->seen.lists;
    KIRI_EACH_INDEX_WHILE(isSame, p, sheet->layout.pieces) {
        isSame = sheet->solver->bodies.bodies.data[p].isMoved || !kiriPiece_MayMove(&sheet->layout.pieces.data[p]);
    }
    return isSame ? moved->version : 0;
}

bool kiriObstacleSearch_Run(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle,
                            double speed, int32_t yield)
{
    kiriMeeting meeting = MakeMeeting(search, sheet, obstacle, speed, yield);
    bool isPlane = obstacle->shape.type == KIRI_OBSTACLE_PLANE; /* vertices alone touch planes: each is looked at */
    search->triangles.count = 0;
    if (!kiriBounds_FindMoving(sheet->seen.bounds, &sheet->seen.surface, IsBoxNear, &meeting, isPlane, VersionOf(sheet),
                               search->memory, &search->triangles)) {
        return false;
    }
    bool allMove = true;
    KIRI_EACH(const kiriPiece, piece, sheet->layout.pieces) {
        allMove &= kiriPiece_MayMove(piece);
    }
    if (!allMove) { /* drops the triangles of pieces that neither move nor wake in this tick */
        KIRI_KEEP_IF(const int32_t, at, search->triangles,
                     kiriPiece_MayMove(&sheet->layout.pieces.data[kiriPiece_OfTriangle(sheet, *at)]));
    }
    return search->triangles.count == 0 ||
           (TouchVertices(&meeting) && TouchRounds(&meeting) &&
            (sheet->settings.mechanics.planar ? TouchCorners(&meeting) : TouchEdges(&meeting)));
}

/* ---- Detail layer ------------------------------------------------------------------------------------------------ */

/* Returns the box of the vertices that the layer moves. */
static kiriBox BoxOfDetail(const kiriSurface* surface)
{
    const kiriDetail* detail = &surface->detail;
    kiriBox box = KIRI_EMPTY_BOX;
    KIRI_EACH(const kiriDetailVertex, item, detail->vertices) {
        kiriBox_Add(&box, kiriVec3_Load(detail->moving.data + 4 * item->vertex));
    }
    box.lower = kiriVec3_Add(box.lower, surface->middle);
    box.upper = kiriVec3_Add(box.upper, surface->middle);
    return box;
}

/* Ends the way from the skin to the drawn vertex where it enters the obstacle; the rest of it slides along there. So thin
   obstacles stop it, too. */
static void PushDetail(const kiriObstacleData* obstacle, kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    const kiriVec3 across = { 0.0, 0.0, 0.0 };
    double gap = 0.5 * sheet->settings.contactThickness;
    KIRI_ASSERT(surface->detail.isListed && !surface->isWritten);
    KIRI_EACH(const kiriDetailVertex, item, surface->detail.vertices) {
        float* moving = surface->detail.moving.data + 4 * item->vertex;
        kiriVec3 skin = kiriVec3_Load(kiriSurface_Places(surface) + 3 * item->vertex);
        kiriVec3 way = kiriObstacle_ToLocal(obstacle, kiriVec3_Sub(kiriVec3_Load(moving), skin));
        kiriVec3 from = kiriObstacle_PointToLocal(obstacle, kiriVec3_Add(surface->middle, skin));
        if (item->leash < 0.0f || !kiriObstacleShape_MayReach(&obstacle->shape, from, gap + kiriVec3_Length(way))) {
            continue;
        }
        kiriNearest nearest;
        double share = kiriObstacleShape_Enter(&obstacle->shape, from, way, gap, across, &nearest);
        double into = (1.0 - share) * kiriVec3_Dot(way, nearest.normal);
        if (share < 1.0 && into < 0.0) {
            way = kiriVec3_AddScaled(way, -into, nearest.normal);
            kiriVec3_Store(moving, kiriVec3_Add(skin, kiriObstacle_ToWorld(obstacle, way)));
        }
    }
}

void kiriObstacles_PushDetail(kiriObstacleData* const* obstacles, int32_t count, kiriSheetData* sheet)
{
    kiriBox box = count > 0 ? BoxOfDetail(&sheet->seen.surface) : (kiriBox){ 0 };
    KIRI_TIMES(i, count) {
        if ((obstacles[i]->groups & sheet->settings.groups) != 0 &&
            kiriObstacle_IsNear(obstacles[i], box.lower, box.upper, sheet->settings.contactThickness)) {
            PushDetail(obstacles[i], sheet);
        }
    }
}
