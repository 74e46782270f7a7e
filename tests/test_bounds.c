/* Boxes over a surface: what a ray, a box or any other shape meets by them is what a look at every triangle finds, on
   random surfaces, after cuts, however far the parts have moved; and who never asks has none. */
#include "host.h"
#include "scene.h"
#include "view/kiri_bounds.h"
#include "view/kiri_section.h"
#include "world/kiri_world.h"

/* ---- A surface without a sheet ---- */

typedef struct Cloth {
    Scene scene;
    kiriMemory room; /* of the surface and its bounds */
    kiriSurface surface;
    kiriBounds bounds;
} Cloth;

/* Where the vertices are is up to the test, so the surface follows no frames. */
static void Show(Cloth* cloth)
{
    int32_t vertices = cloth->scene.mesh.vertices.count, triangles = cloth->scene.mesh.triangles.count;
    assert_true(kiriSurface_Reserve(&cloth->surface, &cloth->room, vertices, triangles, 0));
    kiriSurface_Resize(&cloth->surface, vertices, triangles, 0);
    kiriSurface_WriteTopology(&cloth->surface, &cloth->scene.mesh);
    kiriMesh_Commit(&cloth->scene.mesh);
}

static void Cloth_Init(Cloth* cloth, uint32_t* seed)
{
    int32_t columns = 1 + (int32_t)(Random(seed) % 24), rows = 1 + (int32_t)(Random(seed) % 24);
    memset(cloth, 0, sizeof(*cloth));
    Scene_InitMesh(&cloth->scene, 1.0, RandomBetween(seed, 0.2, 1.0), columns, rows, 8, 0.2, *seed);
    cloth->room = kiriMemory_Like(&cloth->scene.memory);
    Show(cloth);
}

static void Cloth_Release(Cloth* cloth)
{
    kiriMemory_FreeAll(&cloth->room);
    Scene_Release(&cloth->scene);
}

static void CutAtRandom(Cloth* cloth, uint32_t* seed)
{
    kiriMeshData* mesh = &cloth->scene.mesh;
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    kiriMesh_Begin(mesh);
    kiriBladeTip tip = kiriCut_Place(mesh, RandomVec2(seed, -0.2, 1.2));
    for (int k = 0; k < 4; ++k) {
        kiriLatticePoint to = kiriMesh_Snap(mesh, RandomVec2(seed, -0.2, 1.2));
        assert_int_equal(kiriCut_Move(mesh, &tip, to, 1e-4 * KIRI_LATTICE, &quota), KIRI_DONE);
    }
    Show(cloth);
}

/* A bent sheet somewhere; now and then every vertex flies off by itself. */
static void MoveAtRandom(Cloth* cloth, uint32_t* seed)
{
    double bend = RandomBetween(seed, -3.0, 3.0), far = Random(seed) % 4 == 0 ? RandomBetween(seed, -1e4, 1e4) : 0.0;
    double noise = Random(seed) % 3 == 0 ? 5.0 : Random(seed) % 2 == 0 ? 0.02 : 0.0;
    for (int32_t v = 0; v < cloth->surface.vertexCount; ++v) {
        kiriVec2 p = cloth->surface.rest.data[v];
        kiriVec3 at = kiriVec3_Make(p.x + far, p.y - far, bend * p.x * (p.x - p.y));
        at.x += noise * RandomBetween(seed, -1.0, 1.0);
        at.y += noise * RandomBetween(seed, -1.0, 1.0);
        at.z += noise * RandomBetween(seed, -1.0, 1.0);
        kiriSurface_Place(&cloth->surface, v, at);
    }
    kiriSurface_SumNormals(&cloth->surface);
    kiriSurface_WriteRange(&cloth->surface, 0, cloth->surface.vertexCount);
    assert_false(kiriBounds_IsFresh(&cloth->bounds, &cloth->surface));
    assert_true(kiriBounds_Update(&cloth->bounds, &cloth->room, &cloth->surface));
    assert_true(kiriBounds_IsFresh(&cloth->bounds, &cloth->surface));
}

/* ---- Rays ---- */

static kiriVec3 RandomVec3(uint32_t* seed, double size)
{
    double x = RandomBetween(seed, -size, size), y = RandomBetween(seed, -size, size);
    return kiriVec3_Make(x, y, RandomBetween(seed, -size, size));
}

/* Towards a place in a random triangle, or at an edge or a corner of it; some straight along an axis. */
static void RandomRay(const Cloth* cloth, uint32_t* seed, kiriVec3* origin, kiriVec3* direction)
{
    const kiriSurface* surface = &cloth->surface;
    const int32_t* v = &surface->indices.data[3 * (Random(seed) % (uint32_t)surface->triangleCount)];
    double b = Random(seed) % 4 == 0 ? 0.0 : RandomBetween(seed, 0.0, 1.0);
    double c = Random(seed) % 4 == 0 ? 0.0 : RandomBetween(seed, 0.0, 1.1 - b);
    kiriVec3 at = kiriVec3_Scale(1.0 - b - c, kiriSurface_At(surface, v[0]));
    at = kiriVec3_AddScaled(kiriVec3_AddScaled(at, b, kiriSurface_At(surface, v[1])), c, kiriSurface_At(surface, v[2]));
    kiriVec3 way = RandomVec3(seed, 3.0);
    uint32_t axis = Random(seed) % 6;
    way = axis == 0   ? kiriVec3_Make(0.0, 0.0, way.z)
          : axis == 1 ? kiriVec3_Make(0.0, way.y, 0.0)
          : axis == 2 ? kiriVec3_Make(way.x, 0.0, 0.0)
                      : way;
    *origin = kiriVec3_AddScaled(at, -1.0, way);
    *direction = kiriVec3_Normalize(way);
}

static int32_t CheckRay(const Cloth* cloth, uint32_t* seed)
{
    kiriVec3 origin, direction;
    kiriHit hit, plain;
    RandomRay(cloth, seed, &origin, &direction);
    double distance = Random(seed) % 3 == 0 ? RandomBetween(seed, 0.0, 3.0) : 1e9;
    kiriSurface_Raycast(&cloth->surface, &cloth->bounds, origin, direction, distance, &hit);
    kiriSurface_Raycast(&cloth->surface, NULL, origin, direction, distance, &plain);
    assert_memory_equal(&hit, &plain, sizeof(hit));
    return hit.triangle != KIRI_NONE;
}

/* ---- Boxes ---- */

typedef struct Ball {
    kiriVec3 center;
    double radius;
} Ball;

static double Outside(double x, double low, double high)
{
    return x < low ? low - x : x > high ? x - high : 0.0;
}

static bool MeetsBall(const void* context, const kiriBox* box)
{
    const Ball* ball = context;
    double x = Outside(ball->center.x, box->lower.x, box->upper.x);
    double y = Outside(ball->center.y, box->lower.y, box->upper.y);
    double z = Outside(ball->center.z, box->lower.z, box->upper.z);
    return x * x + y * y + z * z <= ball->radius * ball->radius;
}

/* Found are those, and only those, in the order of triangles, after what was in the list. */
static void CheckFound(const Cloth* cloth, kiriMeetsFn* meets, const void* context, const kiriIndices* found)
{
    int32_t count = 1;
    assert_int_equal(found->data[0], -7);
    for (int32_t t = 0; t < cloth->surface.triangleCount; ++t) {
        kiriBox box = kiriBox_OfTriangle(&cloth->surface, t);
        if (meets(context, &box)) {
            assert_true(count < found->count);
            assert_int_equal(found->data[count++], t);
        }
    }
    assert_int_equal(count, found->count);
}

static bool MeetsBox(const void* context, const kiriBox* box)
{
    return kiriBox_Meet(context, box);
}

static void CheckBoxes(Cloth* cloth, uint32_t* seed)
{
    const kiriSurface* surface = &cloth->surface;
    kiriIndices found = { NULL, 0, 0 };
    kiriVec3 at = kiriSurface_At(surface, Random(seed) % (uint32_t)surface->vertexCount), size = RandomVec3(seed, 0.5);
    const Ball ball = { kiriVec3_Add(at, RandomVec3(seed, 0.1)), RandomBetween(seed, 0.0, 0.4) };
    const kiriBox box = { kiriVec3_Add(at, kiriVec3_Make(-fabs(size.x), -fabs(size.y), -fabs(size.z))),
                          kiriVec3_Add(at, kiriVec3_Make(fabs(size.y), fabs(size.z), fabs(size.x))) };
    assert_true(kiriArray_Push(&cloth->room, &found, -7));
    assert_true(kiriBounds_Find(&cloth->bounds, surface, MeetsBall, &ball, &cloth->room, &found));
    CheckFound(cloth, MeetsBall, &ball, &found);
    found.count = 1;
    assert_true(kiriBounds_Box(&cloth->bounds, surface, &box, &cloth->room, &found));
    CheckFound(cloth, MeetsBox, &box, &found);
    kiriArray_Release(&cloth->room, &found);
}

/* The nearest first corner of a triangle; of equally near ones that of the lower triangle. */
typedef struct Nearest {
    const kiriSurface* surface;
    kiriVec3 from;
    double least;
    int32_t triangle, looks;
} Nearest;

static double LookAtCorner(void* context, int32_t triangle)
{
    Nearest* nearest = context;
    kiriVec3 corner = kiriSurface_At(nearest->surface, nearest->surface->indices.data[3 * triangle]);
    kiriVec3 off = kiriVec3_Sub(corner, nearest->from);
    double square = kiriVec3_Dot(off, off);
    bool isLower = square == nearest->least && triangle < nearest->triangle;
    nearest->looks += 1;
    if (square < nearest->least || isLower) {
        nearest->least = square;
        nearest->triangle = triangle;
    }
    return nearest->least;
}

/* Leaves with triangles of several groups. */
static int32_t CountMixed(const kiriBounds* bounds)
{
    int32_t mixed = 0, leaves = bounds->levelCount > 1 ? bounds->firsts[1] : 1;
    for (int32_t leaf = 0; leaf < leaves; ++leaf) {
        uint64_t groups = bounds->groups.data[leaf];
        mixed += (groups & (groups - 1)) != 0;
    }
    return mixed;
}

static void CheckNearest(Cloth* cloth, uint32_t* seed)
{
    const kiriSurface* surface = &cloth->surface;
    kiriVec3 at = kiriSurface_At(surface, Random(seed) % (uint32_t)surface->vertexCount);
    double reach = RandomBetween(seed, 0.0, 2.0);
    /* Bands of vertices, so that some boxes are of one group, and some of several; or mixed so that the tree is made
       anew. */
    bool isMixed = Random(seed) % 4 == 0;
    int32_t* ofVertex = malloc(sizeof(int32_t) * (size_t)surface->vertexCount);
    int32_t groups = Random(seed) % 4 == 0 ? 200 : 3; /* also more than a set of them has bits */
    kiriGroup group = { ofVertex, (int32_t)(Random(seed) % (uint32_t)groups) };
    assert_non_null(ofVertex);
    for (int32_t v = 0; v < surface->vertexCount; ++v) {
        ofVertex[v] = isMixed ? (int32_t)(Random(seed) % (uint32_t)groups) : groups * v / surface->vertexCount;
    }
    Nearest all = { surface, kiriVec3_Add(at, RandomVec3(seed, 0.3)), reach * reach, KIRI_NONE, 0 }, found = all;
    for (int32_t t = 0; t < surface->triangleCount; ++t) {
        if (ofVertex[surface->indices.data[3 * t]] == group.group) {
            LookAtCorner(&all, t);
        }
    }
    assert_true(kiriBounds_Group(&cloth->bounds, &cloth->room, surface, ofVertex, groups));
    assert_true(CountMixed(&cloth->bounds) <= groups + surface->triangleCount / 8 / 16);
    kiriBounds_Nearest(&cloth->bounds, surface, group, found.from, found.least, LookAtCorner, &found);
    assert_int_equal(found.triangle, all.triangle);
    assert_true(found.least == all.least && found.looks <= all.looks);
    free(ofVertex);
}

static void CheckAll(const Cloth* cloth)
{
    kiriBox all = kiriBounds_All(&cloth->bounds), seen = kiriBox_OfTriangle(&cloth->surface, 0);
    for (int32_t v = 0; v < cloth->surface.vertexCount; ++v) {
        kiriVec3 p = kiriSurface_At(&cloth->surface, v);
        seen.lower = kiriVec3_Make(fmin(p.x, seen.lower.x), fmin(p.y, seen.lower.y), fmin(p.z, seen.lower.z));
        seen.upper = kiriVec3_Make(fmax(p.x, seen.upper.x), fmax(p.y, seen.upper.y), fmax(p.z, seen.upper.z));
    }
    assert_true(kiriVec3_Equal(all.lower, seen.lower) && kiriVec3_Equal(all.upper, seen.upper));
}

static void TestFindsWhatIsThere(void** state)
{
    (void)state;
    uint32_t seed = 11;
    int32_t hits = 0, rays = 0;
    for (int round = 0; round < 60; ++round) {
        Cloth cloth;
        Cloth_Init(&cloth, &seed);
        for (int step = 0; step < 6; ++step) {
            MoveAtRandom(&cloth, &seed);
            CheckAll(&cloth);
            for (int k = 0; k < 40; ++k, ++rays) {
                hits += CheckRay(&cloth, &seed);
                CheckBoxes(&cloth, &seed);
                CheckNearest(&cloth, &seed);
            }
            CutAtRandom(&cloth, &seed);
        }
        Cloth_Release(&cloth);
    }
    assert_true(hits > rays / 2 && hits < rays);
}

/* ---- Sections ---- */

/* A part of a plane near the cloth, and what is on its two edges. */
typedef struct Board {
    kiriVec3 corner[4], from, to;
    kiriWindow window;
} Board;

static bool Board_Make(Board* board, const Cloth* cloth, uint32_t* seed)
{
    kiriVec3 at = kiriSurface_At(&cloth->surface, Random(seed) % (uint32_t)cloth->surface.vertexCount);
    kiriVec3 a = RandomVec3(seed, 0.6), b = RandomVec3(seed, 0.6), half = kiriVec3_Scale(0.5, kiriVec3_Add(a, b));
    kiriVec3 start = kiriVec3_Sub(kiriVec3_Add(at, RandomVec3(seed, 0.05)), half);
    board->corner[0] = start;
    board->corner[1] = kiriVec3_Add(start, a);
    board->corner[2] = kiriVec3_Add(board->corner[1], b);
    board->corner[3] = kiriVec3_Add(start, b);
    board->from = kiriVec3_AddScaled(start, 0.3, a);
    board->to = kiriVec3_Add(board->from, b);
    return kiriWindow_Make(&board->window, board->corner, board->from, board->to);
}

/* How long the stretch is that a triangle has in the window, in the rest plane: found by itself, cut off by
   bisection. */
static double StretchIn(const Cloth* cloth, const kiriWindow* window, int32_t triangle)
{
    const int32_t* v = &cloth->surface.indices.data[3 * (size_t)triangle];
    kiriSectionPoint end[2];
    int count = 0;
    for (int k = 0; k < 3; ++k) {
        int32_t a = v[k], b = v[(k + 1) % 3];
        double ha = kiriVec3_Dot(window->normal, kiriSurface_At(&cloth->surface, a)) - window->offset;
        double hb = kiriVec3_Dot(window->normal, kiriSurface_At(&cloth->surface, b)) - window->offset;
        if ((ha >= 0.0) != (hb >= 0.0) && count < 2) {
            double t = ha / (ha - hb);
            kiriVec2 ra = cloth->surface.rest.data[a], rb = cloth->surface.rest.data[b];
            kiriVec3 xa = kiriSurface_At(&cloth->surface, a), xb = kiriSurface_At(&cloth->surface, b);
            end[count].rest = kiriVec2_Add(ra, kiriVec2_Scale(t, kiriVec2_Sub(rb, ra)));
            end[count++].at = kiriVec3_AddScaled(xa, t, kiriVec3_Sub(xb, xa));
        }
    }
    double low = 0.0, high = 1.0;
    for (int side = 0; count == 2 && side < KIRI_SIDES; ++side) {
        double d0 = kiriVec3_Dot(window->inward[side], end[0].at) - window->level[side];
        double d1 = kiriVec3_Dot(window->inward[side], end[1].at) - window->level[side];
        if (d0 < 0.0 && d1 < 0.0) {
            return 0.0;
        }
        double t = d0 / (d0 - d1);
        low = d0 < 0.0 && t > low ? t : low;
        high = d1 < 0.0 && t < high ? t : high;
    }
    return count == 2 && high > low ? (high - low) * kiriVec2_Length(kiriVec2_Sub(end[1].rest, end[0].rest)) : 0.0;
}

/* The lines hold what the triangles hold one by one. */
static void CheckLengths(const Cloth* cloth, const Board* board, const kiriSection* section)
{
    double lines = 0.0, triangles = 0.0;
    for (int32_t i = 0; i < section->lines.count; ++i) {
        const kiriSectionLine* line = &section->lines.data[i];
        assert_true(line->count >= 2 && line->first + line->count <= section->points.count);
        for (int32_t k = line->first; k + 1 < line->first + line->count; ++k) {
            lines += kiriVec2_Length(kiriVec2_Sub(section->points.data[k + 1].rest, section->points.data[k].rest));
        }
    }
    for (int32_t t = 0; t < cloth->surface.triangleCount; ++t) {
        triangles += StretchIn(cloth, &board->window, t);
    }
    AssertNear(lines, triangles, 1e-7 * (1.0 + triangles));
}

/* Lines end on sides of the window, or where the material ends: a little beyond it there is none, or another lip. */
static void CheckEnds(const Cloth* cloth, const Board* board, const kiriSection* section, int32_t ends[7])
{
    for (int32_t i = 0; i < section->lines.count; ++i) {
        const kiriSectionLine* line = &section->lines.data[i];
        for (int k = 0; k < 2; ++k) {
            const kiriSectionPoint* p = &section->points.data[line->first + (k == 0 ? 0 : line->count - 1)];
            ++ends[line->end[k]];
            AssertNear(kiriVec3_Dot(board->window.normal, p->at), board->window.offset, 1e-6);
            if (line->end[k] < KIRI_SIDES) {
                double length = kiriVec3_Length(board->window.inward[line->end[k]]);
                AssertNear(kiriVec3_Dot(board->window.inward[line->end[k]], p->at), board->window.level[line->end[k]],
                           1e-6 * (1.0 + length) + 1e-9 * fabs(board->window.level[line->end[k]]));
            } else if (line->end[k] == KIRI_END_BORDER) {
                kiriVec2 beyond = kiriVec2_Add(p->rest, kiriVec2_Scale(1e-4, line->out[k]));
                kiriVec2 before = kiriVec2_Add(p->rest, kiriVec2_Scale(-1e-7, line->out[k]));
                bool isIn = kiriMesh_Locate(&cloth->scene.mesh, kiriMesh_Snap(&cloth->scene.mesh, beyond)) != KIRI_NONE;
                AssertNear(kiriVec2_Length(line->out[k]), 1.0, 1e-12);
                assert_int_not_equal(kiriMesh_Locate(&cloth->scene.mesh, kiriMesh_Snap(&cloth->scene.mesh, before)),
                                     KIRI_NONE);
                ends[6] += isIn; /* a lip */
            }
        }
    }
}

static void TestSections(void** state)
{
    (void)state;
    uint32_t seed = 29;
    int32_t ends[7] = { 0 }, lines = 0;
    for (int round = 0; round < 40; ++round) {
        Cloth cloth;
        Cloth_Init(&cloth, &seed);
        for (int step = 0; step < 4; ++step) {
            kiriSection section = { { NULL, 0, 0 }, { NULL, 0, 0 } };
            Board board;
            MoveAtRandom(&cloth, &seed);
            for (int k = 0; k < 20; ++k) {
                section.points.count = section.lines.count = 0;
                if (Board_Make(&board, &cloth, &seed)) {
                    assert_true(kiriSection_Add(&section, &cloth.room, &cloth.surface, &cloth.bounds, &board.window));
                    CheckLengths(&cloth, &board, &section);
                    CheckEnds(&cloth, &board, &section, ends);
                    lines += section.lines.count;
                }
            }
            kiriArray_Release(&cloth.room, &section.points);
            kiriArray_Release(&cloth.room, &section.lines);
            CutAtRandom(&cloth, &seed);
        }
        Cloth_Release(&cloth);
    }
    assert_true(lines > 2000);
    for (int k = 0; k < 7; ++k) {
        assert_true(k == KIRI_END_LOOP || ends[k] > 100);
    }
}

/* An update is refused or done; refused, nothing is found wrong, and a later one goes through. */
static void TestWithoutMemory(void** state)
{
    (void)state;
    uint32_t seed = 3;
    Cloth cloth;
    Cloth_Init(&cloth, &seed);
    kiriSurface_SumNormals(&cloth.surface);
    kiriSurface_WriteRange(&cloth.surface, 0, cloth.surface.vertexCount);
    int64_t refused = 0;
    for (cloth.scene.purse.budget = 0; !kiriBounds_Update(&cloth.bounds, &cloth.room, &cloth.surface); ++refused) {
        assert_false(kiriBounds_IsFresh(&cloth.bounds, &cloth.surface));
        cloth.scene.purse.budget = refused + 1;
    }
    cloth.scene.purse.budget = -1;
    assert_true(refused >= 2);
    MoveAtRandom(&cloth, &seed);
    CheckAll(&cloth);
    Cloth_Release(&cloth);
}

/* ---- In a world ---- */

static const float down[3] = { 0.0f, 0.0f, -1.0f };

static kiriHit Cast(const Host* host, kiriSheet sheet, float x, float y)
{
    const float origin[3] = { x, y, 5.0f };
    kiriHit hit;
    OK(kiriSheet_Raycast(host->world, sheet, origin, down, 100.0f, &hit));
    return hit;
}

/* A sheet has no boxes before somebody asks, has them from the next tick on, and gives them back when nobody asks any
   more. */
static void TestWhoAsks(void** state)
{
    (void)state;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 16, 16);
    const kiriSheetData* data = host.world->sheets.data[0];
    OK(Host_Tick(&host, 0.01f, 1));
    int64_t live = host.live;
    assert_int_equal(data->seen.bounds->levelCount, 0);
    kiriHit first = Cast(&host, sheet, 0.3f, 0.4f);
    assert_int_equal(host.live, live);
    OK(Host_Tick(&host, 0.01f, 1));
    assert_true(kiriBounds_IsFresh(data->seen.bounds, &data->seen.surface));
    int64_t calls = host.calls;
    for (int k = 0; k < KIRI_BOUNDS_PATIENCE - 2; ++k) {
        OK(Host_Tick(&host, 0.01f, 1));
        assert_true(kiriBounds_IsFresh(data->seen.bounds, &data->seen.surface));
    }
    assert_int_equal(host.calls, calls); /* no room is taken but once */
    assert_int_equal(Cast(&host, sheet, 0.3f, 0.4f).triangle, first.triangle);
    for (int k = 0; k < KIRI_BOUNDS_PATIENCE + 2; ++k) {
        OK(Host_Tick(&host, 0.01f, 1));
    }
    assert_int_equal(data->seen.bounds->levelCount, 0);
    assert_int_equal(host.live, live);
    Host_Stop(&host);
}

static void CheckSheetRay(const kiriSheetData* data, const float origin[3], const float way[3], const kiriHit* hit)
{
    kiriHit plain;
    kiriSurface_Raycast(&data->seen.surface, NULL, kiriVec3_Load(origin), kiriVec3_Normalize(kiriVec3_Load(way)), 100.0,
                        &plain);
    assert_memory_equal(hit, &plain, sizeof(plain));
}

/* A sheet that falls and is cut to pieces, tick by tick, asked in each. */
static void TestWhileItIsCut(void** state)
{
    (void)state;
    uint32_t seed = 17;
    Host host;
    Host_Start(&host);
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
    int32_t hits = 0;
    for (int tick = 0; tick < 40; ++tick) {
        float way[4];
        for (int k = 0; k < 4; ++k) {
            way[k] = (float)RandomBetween(&seed, -0.2, 1.2);
        }
        if (tick % 2 == 0) {
            Host_Cut(&host, sheet, way, 2);
        }
        OK(Host_Tick(&host, 0.01f, 1));
        for (int k = 0; k < 10; ++k) {
            const float origin[3] = { (float)RandomBetween(&seed, -0.1, 1.1), (float)RandomBetween(&seed, -0.1, 1.1),
                                      4.0f };
            kiriHit hit;
            OK(kiriSheet_Raycast(host.world, sheet, origin, down, 100.0f, &hit));
            CheckSheetRay(host.world->sheets.data[0], origin, down, &hit);
            assert_true(tick == 0 || kiriBounds_IsFresh(host.world->sheets.data[0]->seen.bounds,
                                                        &host.world->sheets.data[0]->seen.surface));
            hits += hit.triangle >= 0;
        }
    }
    assert_true(hits > 200);
    Host_Stop(&host);
}

/* The sheet that a ray meets first, of three above each other, with and without boxes. */
static void TestAllSheets(void** state)
{
    (void)state;
    Host host;
    kiriSheet sheets[3], met;
    kiriHit hit;
    const float heights[3] = { 0.5f, 2.0f, 1.0f }, up[3] = { 0.0f, 0.0f, 4.0f };
    Host_Start(&host);
    kiriSheetDef def = Host_SmallDef();
    const float still[3] = { 0.0f, 0.0f, 0.0f };
    OK(kiriWorld_SetGravity(host.world, still));
    for (int k = 0; k < 3; ++k) {
        def.position[2] = heights[k];
        sheets[k] = Host_AddRectangle(&host, &def, 1.0f, 1.0f + (float)k, 4, 4);
    }
    for (int round = 0; round < 2; ++round) {
        const float over[3] = { 0.4f, 0.5f, 9.0f }, under[3] = { 0.4f, 0.5f, -1.0f }, beyond[3] = { 0.4f, 2.5f, 9.0f };
        OK(kiriWorld_Raycast(host.world, over, down, 100.0f, &met, &hit));
        assert_int_equal(met, sheets[1]);
        assert_float_equal(hit.distance, 7.0f, 1e-6f);
        OK(kiriWorld_Raycast(host.world, under, up, 100.0f, &met, &hit));
        assert_int_equal(met, sheets[0]);
        assert_float_equal(hit.distance, 1.5f, 1e-6f);
        OK(kiriWorld_Raycast(host.world, beyond, down, 100.0f, &met, &hit));
        assert_int_equal(met, sheets[2]);
        OK(kiriWorld_Raycast(host.world, over, up, 100.0f, &met, &hit));
        assert_int_equal(met, 0);
        assert_int_equal(hit.triangle, -1);
        OK(kiriWorld_Raycast(host.world, over, down, 6.9f, &met, &hit));
        assert_int_equal(met, 0);
        OK(Host_Tick(&host, 0.01f, 1));
    }
    Host_Stop(&host);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestFindsWhatIsThere), cmocka_unit_test(TestSections),     cmocka_unit_test(TestWithoutMemory),
        cmocka_unit_test(TestWhoAsks),          cmocka_unit_test(TestWhileItIsCut), cmocka_unit_test(TestAllSheets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
