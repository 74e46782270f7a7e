#include "kiri_obstacle_work.h"

#include "../core/kiri_sort.h"
#include "kiri_piece.h"

/* So many patches a frame, about: its six unknowns need no more points, but for what bends within its reach. */
#define PATCHES_A_FRAME 4.0

/* Of the distance that is kept: by so much another vertex must be deeper to take the place of one that pushed. */
#define PREFERRED 0.5

/* Normals that differ by less are of one face: the cosine of 25 degrees. */
#define SAME_FACE 0.9

/* ---- The sheet as a whole ---------------------------------------------------------------------------------------- */

kiriBox kiriSheet_Box(const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    if (kiriBounds_IsFresh(sheet->seen.bounds, surface)) {
        return kiriBounds_All(sheet->seen.bounds);
    }
    int32_t first = 0;
    while (!kiriMesh_IsVertex(&sheet->mesh, first)) {
        ++first;
    }
    kiriBox box = { kiriSurface_At(surface, first), kiriSurface_At(surface, first) };
    for (int32_t v = first + 1; v < surface->vertexCount; ++v) {
        kiriVec3 x = kiriSurface_At(surface, kiriMesh_IsVertex(&sheet->mesh, v) ? v : first);
        box.lower = kiriVec3_Make(kiriMin(x.x, box.lower.x), kiriMin(x.y, box.lower.y), kiriMin(x.z, box.lower.z));
        box.upper = kiriVec3_Make(kiriMax(x.x, box.upper.x), kiriMax(x.y, box.upper.y), kiriMax(x.z, box.upper.z));
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

/* m: to the farthest point that the frame has a weight at: six radii of gyration of its region, or the sheet's end. */
static double Lever(const kiriFrameData* frame, const kiriBox* box)
{
    double corner = FarthestCorner(box, frame->x), square = frame->inertia[0] + frame->inertia[2];
    double radius = frame->mass > 0.0 ? 6.0 * kiriRoot(square / frame->mass) : corner;
    return kiriMin(radius, corner);
}

double kiriSheet_SpeedLimit(const kiriSheetData* sheet, const kiriBox* box)
{
    double fastest = 0.0;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        const kiriFrameData* frame = &sheet->frames.data[i];
        if (kiriSheet_PieceOf(sheet, i)->rest.asleep) {
            continue;
        }
        double turn = kiriVec3_Length(frame->spin) + kiriVec3_Length(frame->rate.u) + kiriVec3_Length(frame->rate.v);
        double speed = kiriVec3_Length(frame->velocity) + turn * Lever(frame, box);
        fastest = kiriMax(speed, fastest);
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

kiriVec3 kiriMeeting_VertexVelocity(const kiriSheetData* sheet, int32_t vertex)
{
    kiriSpan span = sheet->vertexSkin.spans.data[vertex];
    kiriVec3 velocity = { 0.0, 0.0, 0.0 };
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        kiriSampleWeight weight = sheet->vertexSkin.weights.data[k];
        velocity = kiriVec3_AddScaled(velocity, weight.value,
                                      kiriFrame_VelocityAt(&sheet->frames.data[kiriSheet_FrameOf(sheet, weight.label)],
                                                           sheet->seen.surface.rest.data[vertex]));
    }
    return velocity;
}

static int32_t LeadingFrame(const kiriSheetData* sheet, const kiriSkin* skin, int32_t sample)
{
    kiriSpan span = skin->spans.data[sample];
    kiriSampleWeight most = skin->weights.data[span.first];
    for (int32_t k = span.first + 1; k < span.first + span.count; ++k) {
        most = skin->weights.data[k].value > most.value ? skin->weights.data[k] : most;
    }
    return kiriSheet_FrameOf(sheet, most.label);
}

/* ---- Touches ----------------------------------------------------------------------------------------------------- */

/* A plane through a point of the obstacle, with all that a touch says but whom it touches. False where the plane of a
   planar sheet lies along it. */
bool kiriMeeting_MakePlane(const kiriMeeting* meeting, kiriVec3 normal, kiriVec3 at, double gap, kiriTouch* touch)
{
    const kiriMechanics* mechanics = &meeting->sheet->settings.mechanics;
    const kiriObstacleData* obstacle = meeting->obstacle;
    kiriVec3 slip = kiriVec3_AddScaled(obstacle->surface, -kiriVec3_Dot(obstacle->surface, normal), normal);
    memset(touch, 0, sizeof(*touch));
    touch->velocity = kiriVec3_Add(kiriObstacle_VelocityAt(obstacle, at), slip);
    touch->offset = kiriVec3_Dot(normal, at) + gap;
    if (mechanics->planar) {
        /* The line in which it cuts the sheet's plane. */
        double lean = kiriVec3_Dot(normal, mechanics->axes.d), along = 1.0 - lean * lean;
        double height = kiriVec3_Dot(mechanics->axes.d, meeting->sheet->frames.data[0].x);
        if (along < 1e-2) {
            return false;
        }
        normal = kiriVec3_Scale(1.0 / sqrt(along), kiriVec3_AddScaled(normal, -lean, mechanics->axes.d));
        touch->offset = (touch->offset - lean * height) / sqrt(along);
    }
    touch->normal = normal;
    touch->friction = meeting->friction;
    touch->pushSpeed = obstacle->pushSpeed;
    touch->yield = meeting->yield;
    touch->felt = -1.0;
    touch->point = KIRI_NONE;
    return true;
}

/* What a point of the material may move relative to the obstacle, twice as far as velocities and gravity tell. */
kiriVec3 kiriMeeting_Way(const kiriMeeting* meeting, kiriVec3 point, kiriVec3 velocity)
{
    const kiriObstacleSearch* search = meeting->search;
    kiriVec3 relative = kiriVec3_Sub(velocity, kiriObstacle_VelocityAt(meeting->obstacle, point));
    kiriVec3 way = kiriVec3_Scale(2.0 * search->dt, kiriVec3_AddScaled(relative, search->dt, search->gravity));
    if (meeting->sheet->settings.mechanics.planar) {
        kiriVec3 d = meeting->sheet->settings.mechanics.axes.d;
        way = kiriVec3_AddScaled(way, -kiriVec3_Dot(way, d), d);
    }
    return way;
}

void kiriMeeting_SetPlace(kiriTouch* touch, const int32_t* vertices, const double* shares, int32_t count)
{
    for (int k = 0; k < 3; ++k) {
        touch->vertex[k] = k < count ? vertices[k] : KIRI_NONE;
        touch->share[k] = k < count ? shares[k] : 0.0;
    }
}

bool kiriMeeting_IsBorder(const kiriSurface* surface, const kiriIndices* near, int32_t a, int32_t b)
{
    const int32_t* indices = surface->indices.data;
    for (int32_t i = 0; i < near->count; ++i) {
        const int32_t* v = &indices[3 * (int64_t)near->data[i]];
        if ((v[0] == b && v[1] == a) || (v[1] == b && v[2] == a) || (v[2] == b && v[0] == a)) {
            return false;
        }
    }
    return true;
}

enum { KEY_SLOTS = 1 << 22 };

/* Kind, whether it is of an edge, slot of the obstacle, and which vertex or point of an edge. */
uint64_t kiriMeeting_Key(const kiriMeeting* meeting, bool isEdge, uint32_t item)
{
    return (uint64_t)KIRI_TOUCH_OBSTACLE << 60 | (uint64_t)isEdge << 59 |
           (uint64_t)(meeting->obstacle->id & (KEY_SLOTS - 1)) << 32 | item;
}

bool kiriObstacle_FollowKey(uint64_t* key, const kiriKeep* vertices, const kiriKeep* triangles)
{
    bool isEdge = (*key >> 59 & 1) != 0, isRound = isEdge && (*key & KIRI_ROUND_ITEM) != 0;
    int32_t item = (int32_t)(*key & (KIRI_ROUND_ITEM - 1));
    if (isEdge && !isRound) {
        return true; /* of a point of the obstacle */
    }
    int32_t to = kiriKeep_To(isRound ? triangles : vertices, item);
    *key = (*key & ~(uint64_t)(KIRI_ROUND_ITEM - 1)) | (uint32_t)to;
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
    kiriVec3 middle = kiriVec3_Scale(0.5, kiriVec3_Add(box->lower, box->upper)), none = { 0.0, 0.0, 0.0 };
    double reach = meeting->reach + 0.5 * kiriVec3_Length(kiriVec3_Sub(box->upper, box->lower));
    kiriVec3 local = kiriObstacle_PointToLocal(meeting->obstacle, middle);
    return kiriObstacleShape_MayReach(shape, local, reach) &&
           kiriObstacleShape_Nearest(shape, local, none).distance < reach;
}

static int32_t PatchOf(const kiriMeeting* meeting, int32_t vertex)
{
    const kiriMeshData* mesh = &meeting->sheet->mesh;
    int32_t square = kiriSquares_At(&mesh->squares, mesh->vertices.data[vertex].at);
    int32_t column = square % mesh->squares.columns, row = square / mesh->squares.columns;
    return row / meeting->squares * meeting->columns + column / meeting->squares;
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

/* m: one that pushed counts as that much deeper, so that others, about as deep, do not take its place in turns. */
static double Preference(const kiriMeeting* meeting, int32_t vertex, double height)
{
    if (height > 2.0 * meeting->gap) {
        return 0.0;
    }
    kiriVec3 force = kiriTouches_ForceOf(meeting->sheet, kiriMeeting_Key(meeting, false, (uint32_t)vertex));
    return kiriVec3_Dot(force, force) > 0.0 ? PREFERRED * meeting->gap : 0.0;
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
    if (nearest.distance < meeting->reach) {
        double height = nearest.distance - Preference(meeting, vertex, nearest.distance);
        kiriNearVertex near = { vertex,
                                PatchOf(meeting, vertex),
                                LeadingFrame(meeting->sheet, &meeting->sheet->vertexSkin, vertex),
                                KIRI_NONE,
                                height,
                                nearest.normal };
        Choose(meeting->search, near);
    }
}

/* Each vertex of the triangles near once, in their order: so what is chosen does not depend on that of triangles. */
static void CollectVertices(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    const int32_t* indices = meeting->sheet->seen.surface.indices.data;
    int32_t low = INT32_MAX, high = -1;
    search->mark += 1;
    search->vertices.count = 0;
    for (int64_t i = 0; i < 3 * (int64_t)search->triangles.count; ++i) {
        int32_t vertex = indices[3 * (int64_t)search->triangles.data[i / 3] + i % 3];
        if (search->marks.data[vertex] != search->mark && kiriMesh_IsVertex(&meeting->sheet->mesh, vertex)) {
            search->marks.data[vertex] = search->mark;
            search->vertices.data[search->vertices.count++] = vertex;
            low = kiriMin(vertex, low);
            high = kiriMax(vertex, high);
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

static void ChooseVertices(const kiriMeeting* meeting)
{
    kiriObstacleSearch* search = meeting->search;
    search->chosen.count = 0;
    CollectVertices(meeting);
    for (int32_t i = 0; i < search->vertices.count; ++i) {
        LookAtVertex(meeting, search->vertices.data[i]);
    }
    for (int32_t i = 0; i < search->chosen.count; ++i) {
        search->heads.data[search->chosen.data[i].patch] = KIRI_NONE;
    }
}

/* The plane where the vertex enters, or that it comes near. */
static bool TouchVertex(const kiriMeeting* meeting, int32_t vertex, kiriTouch* touch)
{
    const kiriObstacleData* obstacle = meeting->obstacle;
    kiriVec3 x = kiriSurface_At(&meeting->sheet->seen.surface, vertex), from = kiriObstacle_PointToLocal(obstacle, x);
    kiriVec3 way =
        kiriObstacle_ToLocal(obstacle, kiriMeeting_Way(meeting, x, kiriMeeting_VertexVelocity(meeting->sheet, vertex)));
    kiriNearest nearest;
    double share = kiriObstacleShape_Enter(&obstacle->shape, from, way, meeting->gap, meeting->across, &nearest);
    if (share >= 1.0 && nearest.distance > (1.0 + KIRI_NEARBY) * meeting->gap) {
        return false;
    }
    kiriVec3 there = kiriVec3_AddScaled(kiriVec3_AddScaled(from, share, way), -nearest.distance, nearest.normal);
    if (!kiriMeeting_MakePlane(meeting, kiriObstacle_ToWorld(obstacle, nearest.normal),
                               kiriObstacle_PointToWorld(obstacle, there), meeting->gap, touch)) {
        return false;
    }
    kiriMeeting_SetPlace(touch, &vertex, (const double[1]){ 1.0 }, 1);
    touch->key = kiriMeeting_Key(meeting, false, (uint32_t)vertex);
    return true;
}

bool kiriMeeting_TouchVertices(const kiriMeeting* meeting)
{
    const kiriObstacleSearch* search = meeting->search;
    bool ok = true;
    ChooseVertices(meeting);
    for (int32_t i = 0; ok && i < search->chosen.count; ++i) {
        kiriTouch touch;
        if (TouchVertex(meeting, search->chosen.data[i].vertex, &touch)) {
            ok = kiriTouches_Add(meeting->sheet, &touch);
        }
    }
    return ok;
}

/* ---- Search ------------------------------------------------------------------------------------------------------ */

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
    const kiriSquares* squares = &sheet->mesh.squares;
    int32_t vertices = sheet->seen.surface.vertexCount, triangles = sheet->seen.surface.triangleCount;
    int32_t patches = squares->columns * squares->rows, oldMarks = search->marks.count, oldHeads = search->heads.count;
    if (!kiriArray_Reserve(search->memory, &search->triangles, triangles) ||
        !kiriArray_Reserve(search->memory, &search->crossed, triangles) ||
        !kiriArray_Reserve(search->memory, &search->vertices, (int64_t)vertices + 1) ||
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
                            1,
                            1,
                            sqrt(sheet->settings.friction * obstacle->friction),
                            yield };
    kiriBox box = kiriBounds_All(sheet->seen.bounds);
    double square = sheet->mesh.step * sheet->mesh.squares.side;
    meeting.squares = PatchSide(sheet, square);
    meeting.columns = (sheet->mesh.squares.columns + meeting.squares - 1) / meeting.squares;
    meeting.square = square;
    meeting.reach =
        kiriReach_Of(speed + SpeedOf(obstacle, &box), search->gravity, search->dt) + (1.0 + KIRI_NEARBY) * meeting.gap;
    if (sheet->settings.mechanics.planar) {
        meeting.across = kiriObstacle_ToLocal(obstacle, sheet->settings.mechanics.axes.d);
    }
    return meeting;
}

/* Of the movers, unless something else has been woken since, or shall wake. */
static int64_t VersionOf(const kiriSheetData* sheet)
{
    const kiriAwake* awake = kiriSolver_Awake(sheet->solver);
    bool isSame = awake->isListed && awake->lists == sheet->seen.lists;
    for (int32_t p = 0; isSame && p < sheet->layout.pieces.count; ++p) {
        isSame = awake->isAwake.data[p] || !kiriPiece_MayMove(&sheet->layout.pieces.data[p]);
    }
    return isSame ? awake->lists : 0;
}

/* Of the triangles found, those of pieces that move, or shall wake. */
static void DropSleepers(kiriObstacleSearch* search, const kiriSheetData* sheet)
{
    int32_t kept = 0;
    for (int32_t i = 0; i < search->triangles.count; ++i) {
        int32_t triangle = search->triangles.data[i], piece = kiriPiece_OfTriangle(sheet, triangle);
        KIRI_ASSERT(piece != KIRI_NONE); /* no hole is found */
        if (kiriPiece_MayMove(&sheet->layout.pieces.data[piece])) {
            search->triangles.data[kept++] = triangle;
        }
    }
    search->triangles.count = kept;
}

bool kiriObstacleSearch_Run(kiriObstacleSearch* search, kiriSheetData* sheet, const kiriObstacleData* obstacle,
                            double speed, int32_t yield)
{
    kiriMeeting meeting = MakeMeeting(search, sheet, obstacle, speed, yield);
    search->triangles.count = 0;
    if (!kiriBounds_FindLeaves(sheet->seen.bounds, &sheet->seen.surface, IsBoxNear, &meeting, VersionOf(sheet),
                               search->memory, &search->triangles)) {
        return false;
    }
    DropSleepers(search, sheet);
    return search->triangles.count == 0 ||
           (kiriMeeting_TouchVertices(&meeting) && kiriMeeting_TouchRounds(&meeting) &&
            (sheet->settings.mechanics.planar ? kiriMeeting_TouchCorners(&meeting) : kiriMeeting_TouchEdges(&meeting)));
}
