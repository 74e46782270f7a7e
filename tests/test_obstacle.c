/* Obstacles: their shapes against sums made another way, their place in a world, and what touches them. */
#include "sheet/kiri_obstacle.h"
#include "view/kiri_bounds.h"
#include "host.h"

/* ---- Shapes ------------------------------------------------------------------------------------------------------ */

static const kiriVec3 noPlane = { 0.0, 0.0, 0.0 };

typedef struct Solid {
    kiriObstacleShape shape;
    kiriVec2 corners[64], normals[64];
} Solid;

static void MakePolygon(Solid* solid, int32_t count, const kiriVec2* corners)
{
    solid->shape.outline = solid->corners;
    solid->shape.normals = solid->normals;
    solid->shape.count = count;
    for (int32_t i = 0; i < count; ++i) {
        solid->corners[i] = corners[i];
        kiriVec2 along = kiriVec2_Sub(corners[(i + 1) % count], corners[i]);
        solid->normals[i] = kiriVec2_Scale(1.0 / kiriVec2_Length(along), kiriVec2_Make(along.y, -along.x));
    }
}

enum { SOLIDS = 7 };

static void MakeSolid(Solid* solid, int which)
{
    static const kiriVec2 box[4] = { { -0.3, -0.2 }, { 0.3, -0.2 }, { 0.3, 0.2 }, { -0.3, 0.2 } };
    static const kiriVec2 wedge[5] = { { -0.4, -0.2 }, { 0.5, -0.3 }, { 0.6, 0.1 }, { 0.1, 0.4 }, { -0.3, 0.2 } };
    static const int32_t types[SOLIDS] = { KIRI_OBSTACLE_PLANE, KIRI_OBSTACLE_SPHERE,   KIRI_OBSTACLE_CAPSULE,
                                           KIRI_OBSTACLE_PRISM, KIRI_OBSTACLE_CYLINDER, KIRI_OBSTACLE_PRISM,
                                           KIRI_OBSTACLE_PRISM };
    memset(solid, 0, sizeof(*solid));
    solid->shape.type = types[which];
    solid->shape.radius = 0.3;
    solid->shape.half = which == 1 ? 0.0 : which == 6 ? KIRI_ENDLESS : 0.25;
    solid->shape.flat = 1.0;
    solid->shape.rounding = which == 5 ? 0.07 : 0.0;
    if (which == 3) {
        MakePolygon(solid, 4, box);
    } else if (which >= 5) {
        MakePolygon(solid, 5, wedge);
    }
}

/* The farthest that a solid reaches along a direction tells all of a convex one: the distance of a point outside is the
   largest of dot(n, p) - reach(n), and that of a point inside as well, over all directions. */
static double DistanceBySupport(const kiriObstacleShape* shape, kiriVec3 p, kiriVec3 start)
{
    kiriVec3 n = start;
    double best = kiriVec3_Dot(n, p) - kiriObstacleShape_Reach(shape, n), step = 0.5;
    uint32_t seed = 7;
    for (int i = 0; i < 4000; ++i) {
        kiriVec3 other = kiriVec3_Make(n.x + RandomBetween(&seed, -step, step), n.y + RandomBetween(&seed, -step, step),
                                       shape->half < KIRI_ENDLESS ? n.z + RandomBetween(&seed, -step, step) : 0.0);
        other = kiriVec3_Normalize(other);
        double value = kiriVec3_Dot(other, p) - kiriObstacleShape_Reach(shape, other);
        if (value > best) {
            best = value;
            n = other;
        } else {
            step = step > 1e-6 ? 0.995 * step : step;
        }
    }
    return best;
}

/* Random points around each shape: the distance is that of the supporting plane, and the normal is that plane's. */
TEST(DistanceIsThatOfTheSupportingPlane)
{
    uint32_t seed = 1;
    for (int which = 1; which < SOLIDS; ++which) {
        Solid solid;
        MakeSolid(&solid, which);
        for (int i = 0; i < 40; ++i) {
            kiriVec3 p = kiriVec3_Make(RandomBetween(&seed, -0.9, 0.9), RandomBetween(&seed, -0.7, 0.7),
                                       RandomBetween(&seed, -0.6, 0.6));
            kiriNearest nearest = kiriObstacleShape_Nearest(&solid.shape, p, noPlane);
            double plane = kiriVec3_Dot(nearest.normal, p) - kiriObstacleShape_Reach(&solid.shape, nearest.normal);
            assert_true(fabs(kiriVec3_Length(nearest.normal) - 1.0) < 1e-12);
            assert_true(fabs(plane - nearest.distance) < 1e-12);
            assert_true(DistanceBySupport(&solid.shape, p, nearest.normal) < nearest.distance + 1e-9);
            double other = DistanceBySupport(&solid.shape, p, kiriVec3_Normalize(kiriVec3_Make(p.x, p.y, 0.0)));
            assert_true(nearest.distance > 0.0 ? fabs(other - nearest.distance) < 2e-3
                                               : other < nearest.distance + 1e-9);
        }
    }
}

/* Inside a polygon a planar sheet goes out sideways, however near the cap is. */
TEST(PlanarSheetsGoOutSideways)
{
    Solid solid;
    MakeSolid(&solid, 3);
    kiriVec3 p = { 0.05, 0.1, 0.2499 }, up = { 0.0, 0.0, 1.0 };
    kiriNearest space = kiriObstacleShape_Nearest(&solid.shape, p, noPlane);
    kiriNearest flat = kiriObstacleShape_Nearest(&solid.shape, p, up);
    assert_true(space.normal.z == 1.0 && fabs(space.distance + 1e-4) < 1e-12);
    assert_true(flat.normal.y == 1.0 && fabs(flat.distance + 0.1) < 1e-12);
}

/* Moving points stop where a walk in small steps first comes within the gap. */
TEST(EntersWhereAWalkDoes)
{
    enum { STEPS = 20000 };
    const double gap = 0.01;
    uint32_t seed = 3;
    int met = 0;
    for (int i = 0; i < 200; ++i) {
        Solid solid;
        MakeSolid(&solid, i % SOLIDS);
        kiriVec3 from = kiriVec3_Make(RandomBetween(&seed, -1.5, 1.5), RandomBetween(&seed, -1.5, 1.5),
                                      RandomBetween(&seed, 0.4, 1.0));
        kiriVec3 to = kiriVec3_Make(RandomBetween(&seed, -0.5, 0.5), RandomBetween(&seed, -0.5, 0.5),
                                    RandomBetween(&seed, -1.0, 0.6));
        kiriVec3 move = kiriVec3_Sub(to, from);
        kiriNearest nearest;
        double share = kiriObstacleShape_Enter(&solid.shape, from, move, gap, noPlane, &nearest), walked = 1.0;
        for (int k = 0; k <= STEPS && walked >= 1.0; ++k) {
            kiriVec3 at = kiriVec3_AddScaled(from, (double)k / STEPS, move);
            walked =
                kiriObstacleShape_Nearest(&solid.shape, at, noPlane).distance < 1.01 * gap ? (double)k / STEPS : 1.0;
        }
        assert_true(fabs(share - walked) < 2e-3 || (share >= 1.0 && walked >= 1.0));
        met += share < 1.0;
    }
    assert_in_range(met, 60, 190);
}

TEST(CirclePointsAreEven)
{
    for (int32_t i = 0; i < 64; ++i) {
        kiriVec2 p = kiriCircle_At(i, 64);
        double angle = 2.0 * 3.14159265358979323846 * i / 64.0;
        assert_true(fabs(p.x - cos(angle)) < 1e-14 && fabs(p.y - sin(angle)) < 1e-14);
    }
}

/* ---- In a world -------------------------------------------------------------------------------------------------- */

static const float dt = 1.0f / 60.0f;

static kiriObstacleDef DefOf(int32_t type)
{
    static const float outline[8] = { -0.3f, -0.2f, 0.3f, -0.2f, 0.3f, 0.2f, -0.3f, 0.2f };
    kiriObstacleDef def = ObstacleOf(type);
    def.radius = 0.2f;
    def.height = 0.4f;
    def.size[0] = def.size[1] = def.size[2] = 0.4f;
    def.outline = outline;
    def.outlineCount = 4;
    return def;
}

static kiriObstacle Add(Host* host, const kiriObstacleDef* def)
{
    kiriObstacle obstacle = 0;
    OK(kiriCreateObstacle(host->world, def, &obstacle));
    return obstacle;
}

/* Describes a plate of one frame. */
static kiriSheetDef PlateDef(float contactThickness)
{
    kiriSheetDef def = SheetOf(8, 1);
    def.maxFrames = 1;
    def.contactThickness = contactThickness;
    return def;
}

/* A stiff plate, 0.2 m wide, that lies at a height, its middle over the origin. */
static kiriSheet AddPlate(Host* host, float z)
{
    kiriSheetDef def = PlateDef(0.01f);
    def.material.thickness = 0.001f;
    Set3(def.position, -0.1f, -0.1f, z);
    return Host_AddRectangle(host, &def, 0.2f, 0.2f, 8, 8);
}

static void Ticks(Host* host, int count)
{
    Host_Ticks(host, count, dt, 2);
}

#define REFUSED(result, call)                                                                                          \
    do {                                                                                                               \
        uint64_t hashBefore = Host_Hash(&host);                                                                        \
        assert_int_equal(call, result);                                                                                \
        assert_true(kiriWorld_GetLastError(host.world)[0] != '\0' && Host_Hash(&host) == hashBefore);                  \
    } while (0)

TEST(BadDefsAreRefused)
{
    static const float concave[8] = { -0.3f, -0.2f, 0.3f, -0.2f, 0.0f, -0.1f, -0.3f, 0.2f };
    static const float clockwise[6] = { 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f },
                       flat[6] = { 0.0f, 0.0f, 1.0f, 0.0f, 2.0f, 0.0f };
    static const float star[10] = { 0.0f, 1.0f, -0.588f, -0.809f, 0.951f, 0.309f, -0.951f, 0.309f, 0.588f, -0.809f };
    static const float* const outlines[] = { concave, clockwise, flat, star, NULL };
    static const int32_t counts[] = { 4, 3, 3, 5, 4 };
    START_HOST(host);
    kiriObstacle none = 1;
    for (int32_t type = KIRI_OBSTACLE_PLANE; type <= KIRI_OBSTACLE_PRISM; ++type) {
        kiriObstacleDef def = DefOf(type);
        struct {
            float* field;
            float value;
        } bad[] = {
            { &def.position[1], NAN },        { &def.rotation[0], 2.0f },         { &def.rotation[8], -1.0f },
            { &def.velocity[2], NAN },        { &def.friction, -0.1f },           { &def.mass, -1.0f },
            { &def.pushSpeed, 0.0f },         { &def.pushSpeed, INFINITY },       { &def.rounding, -1.0f },
            { &def.inertia[0], -1.0f },       { &def.inertia[3], 0.1f },          { &def.angularVelocity[0], INFINITY },
            { &def.surfaceVelocity[0], NAN }, { &def.centerOfMass[0], NAN },      { &def.position[2], -5e37f },
            { &def.velocity[0], 5e37f },      { &def.angularVelocity[1], 5e37f }, { &def.surfaceVelocity[2], -5e37f }
        };
        for (size_t i = 0; i < sizeof(bad) / sizeof(bad[0]); ++i) {
            float kept = *bad[i].field;
            *bad[i].field = bad[i].value;
            REFUSED(KIRI_ERROR_ARGUMENT, kiriCreateObstacle(host.world, &def, &none));
            assert_int_equal(none, 0);
            *bad[i].field = kept;
        }
        float* sizes[] = { &def.radius, &def.height, &def.size[1] };
        for (int i = 0; i < 3; ++i) {
            float kept = *sizes[i];
            *sizes[i] = -0.1f;
            bool isUsed =
                i == 0 ? type == KIRI_OBSTACLE_SPHERE || type == KIRI_OBSTACLE_CAPSULE || type == KIRI_OBSTACLE_CYLINDER
                : i == 1 ? type >= KIRI_OBSTACLE_CYLINDER || type == KIRI_OBSTACLE_CAPSULE
                         : type == KIRI_OBSTACLE_BOX;
            if (isUsed) {
                REFUSED(KIRI_ERROR_ARGUMENT, kiriCreateObstacle(host.world, &def, &none));
            }
            *sizes[i] = kept;
        }
    }
    kiriObstacleDef prism = DefOf(KIRI_OBSTACLE_PRISM);
    for (int i = 0; i < 5; ++i) {
        prism.outline = outlines[i];
        prism.outlineCount = counts[i];
        REFUSED(KIRI_ERROR_ARGUMENT, kiriCreateObstacle(host.world, &prism, &none));
    }
    prism = DefOf(7);
    REFUSED(KIRI_ERROR_ARGUMENT, kiriCreateObstacle(host.world, &prism, &none));
    prism.cookie = 1;
    REFUSED(KIRI_ERROR_DEF, kiriCreateObstacle(host.world, &prism, &none));
}

static double Past(const kiriVec3* p, double a, double b, double c)
{
    return kiriVec3_Distance(kiriVec3_AddScaled(kiriVec3_AddScaled(kiriVec3_Scale(a, p[0]), b, p[1]), c, p[2]), p[3]);
}

/* No other place of the triangle is nearer. Corners coincide or lie on a line in many triangles. */
TEST(TrianglesHaveNearestPlaces)
{
    for (uint32_t seed = 5, n = 0; n < 50000; ++n) {
        kiriVec3 p[4];
        double s[3], u = RandomBetween(&seed, 0.0, 1.0), v = RandomBetween(&seed, 0.0, 1.0 - u);
        KIRI_TIMES(k, 4) {
            p[k] = kiriVec3_Make(Random(&seed) >> 8 & 1, Random(&seed) >> 8 & 1, Random(&seed) >> 8 & 3);
        }
        kiriTriangle_Nearest(p, p[3], s);
        assert_true(Past(p, s[0], s[1], s[2]) < Past(p, 1.0 - u - v, u, v) + 1e-9);
        assert_true(fabs(s[0] + s[1] + s[2] - 1.0) < 1e-9 && fmin(fmin(s[0], s[1]), s[2]) > -1e-9);
    }
}

/* There it would be read as no float after a tick. Short of that it goes on, and comes back. */
TEST(WhereFloatsEndNothingMoves)
{
    const float beyond[3] = { 0.0f, 5e37f, 0.0f }, within[3] = { 4e37f, -4e37f, 4e37f };
    for (int32_t type = KIRI_OBSTACLE_PLANE; type <= KIRI_OBSTACLE_PRISM; ++type) {
        START_HOST(host);
        kiriObstacleDef def = DefOf(type);
        kiriObstacle obstacle = Add(&host, &def);
        AddPlate(&host, 2.0f);
        REFUSED(KIRI_ERROR_ARGUMENT, kiriObstacle_SetPose(host.world, obstacle, beyond, def.rotation));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriObstacle_SetVelocity(host.world, obstacle, beyond, noVector));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriObstacle_SetVelocity(host.world, obstacle, noVector, beyond));
        REFUSED(KIRI_ERROR_ARGUMENT, kiriObstacle_SetSurfaceVelocity(host.world, obstacle, beyond));
        OK(kiriObstacle_SetPose(host.world, obstacle, within, def.rotation));
        OK(kiriObstacle_SetVelocity(host.world, obstacle, within, within));
        for (int i = 0; i < 3; ++i) {
            kiriResult result = Host_Tick(&host, 10.0f, 1);
            assert_true(result == KIRI_OK || result == KIRI_DIVERGED);
            kiriObstacleState now = World_ObstacleState(host.world, obstacle);
            assert_true(AllFinite(now.position, 3) && AllFinite(now.rotation, 9));
        }
        OK(kiriObstacle_SetVelocity(host.world, obstacle, noVector, noVector));
        OK(kiriObstacle_SetPose(host.world, obstacle, noVector, def.rotation));
        OK(Host_Tick(&host, dt, 1));
    }
}

/* Half the contact thickness above the floor it comes to rest, and sleeps. The floor bears its weight all the time. */
TEST(PlateRestsOnAFloor)
{
    START_HOST(host);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_PLANE);
    kiriObstacle floor = Add(&host, &def);
    kiriSheet sheet = AddPlate(&host, 0.1f);
    int ticks = 0;
    for (; World_IsAwake(host.world, sheet) && ticks < 300; ++ticks) {
        OK(Host_Tick(&host, dt, 2));
    }
    assert_in_range(ticks, 30, 120);
    kiriTotals totals = Host_Totals(&host, sheet);
    double weight = -9.81 * totals.mass * (double)dt;
    assert_true(fabs(totals.center[2] - 0.005) < 1e-4);
    assert_true(fabs(World_ObstacleState(host.world, floor).impulse[2] / weight - 1.0) < 1e-3);
    Ticks(&host, 10);
    assert_false(World_IsAwake(host.world, sheet));
    assert_true(fabs(World_ObstacleState(host.world, floor).impulse[2] / weight - 1.0) < 1e-3);
    assert_true(fabs(World_ObstacleState(host.world, floor).angularImpulse[0] / weight) < 1e-3);
    assert_true(World_ObstacleState(host.world, floor).contacts >= 3);
}

static kiriSheet RestOn(Host* host, kiriObstacle obstacle)
{
    kiriSheet sheet = AddPlate(host, 0.2051f);
    for (int i = 0; i < 120 && World_IsAwake(host->world, sheet); ++i) {
        OK(Host_Tick(host, dt, 2));
    }
    assert_false(World_IsAwake(host->world, sheet));
    return sheet;
}

/* A plate that starts in a floor comes out, but no faster than the floor's pushSpeed. */
TEST(PushSpeedIsKept)
{
    static const float speeds[] = { 0.05f, 0.1f, 1.0f };
    for (int k = 0; k < 3; ++k) {
        START_HOST(host);
        World_StopGravity(host.world);
        kiriObstacleDef floor = DefOf(KIRI_OBSTACLE_PLANE);
        floor.pushSpeed = speeds[k];
        Add(&host, &floor);
        kiriSheetDef def = DefaultSheet();
        def.frameCount = def.maxFrames = 1;
        def.position[2] = -0.05f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 0.4f, 0.4f, 8, 8);
        double last = -0.05;
        for (int i = 0; i < 90; ++i) {
            OK(Host_Tick(&host, dt, 2));
            double height = Host_Totals(&host, sheet).center[2];
            assert_true(height >= 0.0 || height - last < 1.05 * (double)(speeds[k] * dt));
            last = height;
        }
        assert_true(last > (speeds[k] < 0.1f ? 0.0 : 0.004)); /* out, half of the contact thickness above */
    }
}

/* A hanging cloth that starts through a capsule, whichever part of it is below, comes out. */
TEST(DeepSheetsComeOut)
{
    for (int k = 0; k < 3; ++k) {
        START_HOST(host);
        kiriObstacleDef def = DefOf(KIRI_OBSTACLE_CAPSULE);
        def.radius = 0.15f;
        def.height = 0.3f;
        memcpy(def.position, (float[3]){ 0.3f, 0.3f, -0.05f * (float)k - 0.01f }, sizeof(def.position));
        Add(&host, &def);
        kiriSheetDef cloth = SheetOf(32, 16);
        kiriSheet sheet = Host_AddRectangle(&host, &cloth, 0.6f, 0.6f, 24, 24);
        Host_Pin(&host, sheet, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
        Host_Pin(&host, sheet, 0.0f, 0.6f, 0.0f, 0.6f, 0.0f);
        Ticks(&host, 120);
        kiriMesh mesh = World_Mesh(host.world, sheet);
        for (int32_t v = 0; v < mesh.vertexCount; ++v) {
            const float* x = &mesh.positions[3 * v];
            float a = x[0] - def.position[0], b = x[1] - def.position[1], c = fabsf(x[2] - def.position[2]) - 0.15f;
            assert_true(sqrtf(a * a + b * b + (c > 0.0f ? c * c : 0.0f)) > 0.147f);
        }
    }
}

/* Whatever takes a box from below a plate that sleeps on it wakes the plate; what happens far away does not. */
TEST(SleepersWake)
{
    enum { DESTROY, PUT, MOVE, MAKE, CHURN, CASES };
    const float away[3] = { 3.0f, 0.0f, 0.0f }, up[3] = { 0.0f, 0.0f, 0.1f };
    for (int which = 0; which < CASES; ++which) {
        for (int isFar = 0; isFar < 2; ++isFar) {
            START_HOST(host);
            kiriObstacleDef def = DefOf(KIRI_OBSTACLE_BOX);
            kiriObstacle box = Add(&host, &def), touched = box;
            kiriSheet sheet = RestOn(&host, box);
            def.position[0] = isFar ? 2.0f : 0.3f;
            if (isFar || which == MAKE) {
                touched = Add(&host, &def);
            }
            if (which == DESTROY) {
                OK(kiriDestroyObstacle(host.world, touched));
            } else if (which == PUT) {
                OK(kiriObstacle_SetPose(host.world, touched, away, def.rotation));
            } else if (which == MOVE) {
                OK(kiriObstacle_SetVelocity(host.world, touched, up, noVector));
            } else if (which == CHURN) {
                OK(kiriObstacle_SetSurfaceVelocity(host.world, touched, up));
            }
            OK(Host_Tick(&host, dt, 2));
            assert_int_equal(World_IsAwake(host.world, sheet), !isFar);
        }
    }
}

/* Too slow to see, an obstacle still carries along what sleeps on it. */
TEST(SlowLiftsCarry)
{
    START_HOST(host);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_BOX);
    kiriObstacle box = Add(&host, &def);
    kiriSheet sheet = RestOn(&host, box);
    const float up[3] = { 0.0f, 0.0f, 0.0008f };
    OK(kiriObstacle_SetVelocity(host.world, box, up, noVector));
    Host_Ticks(&host, 600, dt, 2);
    double height = Host_Totals(&host, sheet).center[2] - (double)World_ObstacleState(host.world, box).position[2];
    assert_true(fabs(World_ObstacleState(host.world, box).position[2] - 0.008) < 1e-5);
    assert_true(fabs(height - 0.205) < 8e-4);
}

TEST(LiftsAndConveyorsCarry)
{
    START_HOST(host);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_PLANE);
    def.velocity[2] = 0.5f;
    def.surfaceVelocity[0] = 0.3f;
    kiriObstacle lift = Add(&host, &def);
    kiriSheet sheet = AddPlate(&host, 0.006f);
    Ticks(&host, 60);
    kiriTotals totals = Host_Totals(&host, sheet);
    assert_true(fabs(totals.momentum[2] / totals.mass - 0.5) < 1e-3);
    assert_true(fabs(totals.momentum[0] / totals.mass - 0.3) < 1e-3);
    assert_true(fabs(totals.center[2] - World_ObstacleState(host.world, lift).position[2] - 0.005) < 2e-4);
}

/* What two plates lose, the crate that they fall on gets; and it is not more than its mass can take. */
TEST(SheetsShareAnObstacle)
{
    START_HOST(host);
    World_StopGravity(host.world);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_BOX);
    def.mass = 0.02f;
    def.friction = 0.0f;
    kiriObstacle crate = Add(&host, &def);
    const float down[3] = { 0.0f, 0.0f, -1.0f };
    kiriSheetDef plate = PlateDef(0.01f);
    plate.material.airDamping = 0.0f;
    memcpy(plate.velocity, down, sizeof(down));
    double before = 0.0, after = 0.0, given = 0.0;
    kiriSheet plates[2];
    for (int i = 0; i < 2; ++i) {
        plate.position[0] = i == 0 ? -0.2f : 0.02f;
        plate.position[1] = -0.1f;
        plate.position[2] = 0.215f;
        plates[i] = Host_AddRectangle(&host, &plate, 0.18f, 0.2f, 8, 8);
        before += Host_Totals(&host, plates[i]).momentum[2];
    }
    OK(Host_Tick(&host, dt, 2));
    given = World_ObstacleState(host.world, crate).impulse[2];
    for (int i = 0; i < 2; ++i) {
        after += Host_Totals(&host, plates[i]).momentum[2];
    }
    assert_true(given < 0.0 && fabs(before - after - given) < 1e-9 * fabs(before) + 1e-12);
    /* No faster than all of them together can be: nobody was pushed out by more than came in. */
    double slowest = before / (0.02 + 2.0 * Host_Totals(&host, plates[0]).mass);
    assert_true(given / 0.02 > 2.0 * slowest && after > before);
}

/* m/s: of the fastest frame of a sheet of four, one of them held, in the ticks in which a box comes up to it and goes
   through. */
static double FastestOverBox(int32_t skinning, float beside)
{
    enum { FRAMES = 4, TICKS = 90 };
    START_HOST(host);
    kiriSheetDef sheetDef = Host_SmallDef();
    sheetDef.skinning = skinning;
    kiriSheet sheet = Host_AddRectangle(&host, &sheetDef, 1.0f, 1.0f, 8, 8);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_BOX);
    def.size[0] = def.size[1] = 0.3f;
    def.size[2] = 0.1f;
    def.position[0] = def.position[1] = 0.1875f + beside;
    def.velocity[2] = 1.0f;
    kiriObstacle box = Add(&host, &def);
    kiriFrame frames[FRAMES];
    double fastest = 0.0;
    int32_t count = World_GetFrames(host.world, sheet, frames, FRAMES);
    kiriFrameState frame = World_FrameState(host.world, frames[0]);
    OK(kiriFrame_Hold(host.world, frames[0], frame.position, frame.rotation));
    for (int t = 0; t < TICKS; ++t) {
        def.position[2] = -0.4f + (float)t / 60.0f;
        OK(kiriObstacle_SetPose(host.world, box, def.position, def.rotation));
        OK(Host_Tick(&host, dt, 2));
        for (int32_t i = 0; i < count; ++i) {
            OK(kiriFrame_GetState(host.world, frames[i], &frame));
            const float* v = frame.velocity;
            double speed = sqrt((double)(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
            fastest = speed > fastest ? speed : fastest;
        }
    }
    return fastest;
}

/* An obstacle cannot move what is held. It does not move the other frames in its place, which hardly carry the material
   there: they would have to go many times as far. */
TEST(ObstaclesDoNotMoveWhatIsHeld)
{
    for (int i = 0; i < 4; ++i) {
        assert_true(FastestOverBox(i % 2, i / 2 == 0 ? 0.0f : 0.1f) < 20.0);
    }
}

/* Edge-on against a wall of 1 cm: plates, and cloths of many frames, for which no step settles which points push. */
TEST(FastSheetsDoNotPass)
{
    static const struct {
        int32_t frames, substeps;
        float speed, size, height;
    } cases[] = { { 1, 1, 100.0f, 0.2f, 1.2f },
                  { 1, 4, 100.0f, 0.2f, 1.2f },
                  { 16, 2, 40.0f, 1.0f, 1.3f },
                  { 16, 2, 100.0f, 1.0f, 1.3f },
                  { 16, 8, 100.0f, 1.0f, 1.3f } };
    for (size_t k = 0; k < sizeof(cases) / sizeof(cases[0]); ++k) {
        START_HOST(host);
        kiriObstacleDef def = DefOf(KIRI_OBSTACLE_BOX);
        def.size[0] = def.size[1] = 8.0f;
        def.size[2] = 0.01f;
        Add(&host, &def);
        kiriSheetDef cloth = SheetOf(32, cases[k].frames);
        cloth.maxFrames = cases[k].frames;
        cloth.axisV[1] = 0.0f;
        cloth.axisV[2] = 1.0f;
        cloth.position[2] = cases[k].height;
        cloth.velocity[2] = -cases[k].speed;
        kiriSheet sheet = Host_AddRectangle(&host, &cloth, cases[k].size, cases[k].size, 32, 32);
        for (int i = 0; i < 20; ++i) {
            OK(Host_Tick(&host, dt, cases[k].substeps));
            kiriMesh mesh = World_Mesh(host.world, sheet);
            int32_t passed = 0;
            for (int32_t v = 0; v < mesh.vertexCount; ++v) {
                passed += mesh.positions[3 * v + 2] < (cases[k].frames == 1 ? 0.0f : -0.005f);
            }
            assert_true(1000 * passed <= (cases[k].frames == 1 ? 0 : mesh.vertexCount));
        }
    }
}

/* A ball of a mass on the middle of a cloth of 1 m. */
static kiriObstacleDef BallDef(double mass)
{
    const float middle[3] = { 0.513f, 0.507f, 0.103f };
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_SPHERE);
    def.radius = 0.1f;
    def.mass = (float)mass;
    memcpy(def.position, middle, sizeof(middle));
    return def;
}

/* Moves a ball for a tick as an engine does, and returns its state. */
static kiriObstacleState TickBall(Host* host, kiriObstacle ball, kiriObstacleDef* def, int32_t substeps)
{
    def->velocity[2] -= 9.81f * dt;
    OK(kiriObstacle_SetPose(host->world, ball, def->position, def->rotation));
    OK(kiriObstacle_SetVelocity(host->world, ball, def->velocity, def->angularVelocity));
    OK(kiriWorld_Tick(host->world, dt, substeps));
    kiriObstacleState now = World_ObstacleState(host->world, ball);
    for (int i = 0; i < 3; ++i) {
        def->velocity[i] += now.impulse[i] / def->mass;
        def->position[i] += dt * def->velocity[i];
    }
    return now;
}

/* A ball of 100 times the mass of a cloth that is held all round: it stretches the cloth, swings, and comes to rest. */
FIGURE(HeavyBodiesRestOnCloth)
{
    static const float corners[5][2] = { { 0, 0 }, { 1, 0 }, { 1, 1 }, { 0, 1 }, { 0, 0 } };
    for (int substeps = 2; substeps <= 8; substeps += 6) {
        START_HOST(host);
        kiriSheetDef cloth = DefaultSheet();
        cloth.frameCount = 25;
        kiriSheet sheet = Host_AddRectangle(&host, &cloth, 1.0f, 1.0f, 40, 40);
        double weight = 0.0, mass = 100.0 * Host_Totals(&host, sheet).mass;
        for (int i = 0; i < 4; ++i) {
            World_Hinge(host.world, sheet, corners[i], corners[i + 1]);
        }
        kiriObstacleDef def = BallDef(mass);
        kiriObstacle ball = Add(&host, &def);
        for (int tick = 0; tick < 360; ++tick) {
            double push = TickBall(&host, ball, &def, substeps).impulse[2];
            assert_true(def.position[2] > -0.8f); /* it falls to 0.55 m */
            weight += tick >= 300 ? push / (60.0 * mass * 9.81 * (double)dt) : 0.0;
        }
        assert_true(fabs(weight - 1.0) < 0.02 && fabsf(def.velocity[2]) < 0.05f);
    }
}

/* 100 balls with a mass touch a cloth: all takes 5 MB. What grows with the square of their number takes 4 more. */
TEST(MemoryOfManyBalls)
{
    START_HOST(host);
    kiriSheetDef cloth = SheetOf(32, 25);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_SPHERE);
    Host_AddRectangle(&host, &cloth, 1.0f, 1.0f, 32, 32);
    def.radius = 0.03f;
    def.mass = 0.05f;
    for (int i = 0; i < 100; ++i) {
        Set3(def.position, 0.05f + 0.1f * (float)(i % 10), 0.05f + 0.1f * (float)(i / 10), -0.031f);
        Add(&host, &def);
    }
    Host_Ticks(&host, 3, dt, 2);
    assert_true(host.bytes < 7000000);
}

TEST(HeavyArmsStayOutOfCurtains)
{
    for (int substeps = 2; substeps <= 8; substeps += 6) {
        START_HOST(host);
        kiriSheetDef cloth = SheetOf(32, 25);
        kiriObstacleDef def = DefOf(KIRI_OBSTACLE_CAPSULE);
        const float lying[9] = { 1, 0, 0, 0, 0, 1, 0, -1, 0 };
        cloth.axisU[0] = cloth.axisV[1] = 0.0f;
        cloth.axisU[1] = cloth.axisV[2] = 1.0f;
        memcpy(def.rotation, lying, sizeof(lying));
        Set3(def.position, -0.08f, 0.4f, 0.62f);
        def.radius = 0.05f;
        def.mass = 1e4f;
        def.velocity[0] = 1.0f;
        kiriSheet sheet = Host_AddRectangle(&host, &cloth, 0.8f, 1.0f, 32, 40);
        for (int i = 0; i <= 4; ++i) {
            Host_Pin(&host, sheet, 0.2f * (float)i, 1.0f, 0.0f, 0.2f * (float)i, 1.0f);
        }
        Add(&host, &def);
        for (int tick = 1; tick <= 40; ++tick) {
            OK(kiriWorld_Tick(host.world, dt, substeps));
            kiriMesh mesh = World_Mesh(host.world, sheet);
            for (int32_t v = 0; v < mesh.vertexCount; ++v) {
                const float* x = &mesh.positions[3 * v];
                assert_true(hypotf(x[0] + 0.08f - (float)tick * dt, x[2] - 0.62f) > 0.049f || fabsf(x[1] - 0.4f) > 0.2f);
            }
        }
    }
}

/* Two light fingers press on a cloth that hangs: it stays between them, and each feels the force of the other's motor. */
TEST(FingersHoldACloth)
{
    START_HOST(host);
    kiriSheetDef cloth = DefaultSheet();
    double felt = 0.0;
    memcpy(cloth.axisV, (const float[3]){ 0.0f, 0.0f, 1.0f }, sizeof(cloth.axisV));
    kiriSheet sheet = Host_AddRectangle(&host, &cloth, 0.4f, 0.4f, 40, 40);
    Host_Pin(&host, sheet, 0.0f, 0.4f, 0.0f, 0.0f, 0.4f);
    Host_Pin(&host, sheet, 0.4f, 0.4f, 0.4f, 0.0f, 0.4f);
    kiriObstacle fingers[2];
    kiriObstacleDef defs[2] = { DefOf(KIRI_OBSTACLE_BOX), DefOf(KIRI_OBSTACLE_BOX) };
    for (int i = 0; i < 2; ++i) {
        memcpy(defs[i].size, (const float[3]){ 0.03f, 0.01f, 0.02f }, sizeof(defs[i].size));
        memcpy(defs[i].position, (const float[3]){ 0.2f, i == 0 ? -0.025f : 0.025f, 0.36f }, sizeof(defs[i].position));
        defs[i].mass = 0.1f;
        fingers[i] = Add(&host, &defs[i]);
    }
    for (int tick = 0; tick < 120; ++tick) {
        for (int i = 0; i < 2; ++i) {
            defs[i].velocity[1] += (i == 0 ? 5.0f : -5.0f) / defs[i].mass * dt;
            OK(kiriObstacle_SetPose(host.world, fingers[i], defs[i].position, defs[i].rotation));
            OK(kiriObstacle_SetVelocity(host.world, fingers[i], defs[i].velocity, defs[i].angularVelocity));
        }
        OK(Host_Tick(&host, dt, 2));
        for (int i = 0; i < 2; ++i) {
            double impulse = World_ObstacleState(host.world, fingers[i]).impulse[1];
            defs[i].velocity[1] += (float)impulse / defs[i].mass;
            defs[i].position[1] += dt * defs[i].velocity[1];
            felt += tick >= 60 ? (i == 0 ? -0.5 : 0.5) * impulse : 0.0;
        }
    }
    assert_true(fabs(felt / 5.0 - 1.0) < 0.01 && defs[0].position[1] < defs[1].position[1]);
}

/* A ball without friction gets no torque, and pushes the same with any spin. */
TEST(SmoothBallsFeelNoTorque)
{
    double given[2] = { 0.0, 0.0 };
    for (int k = 0; k < 2; ++k) {
        START_HOST(host);
        kiriSheetDef cloth = DefaultSheet();
        cloth.frameCount = 16;
        kiriSheet sheet = Host_AddRectangle(&host, &cloth, 1.0f, 1.0f, 32, 32);
        for (int i = 0; i < 4; ++i) {
            Host_Pin(&host, sheet, (float)(i % 2), (float)(i / 2), (float)(i % 2), (float)(i / 2), 0.0f);
        }
        kiriObstacleDef def = BallDef(1.0);
        def.friction = 0.0f;
        def.angularVelocity[0] = k == 0 ? 0.0f : 50.0f;
        kiriObstacle ball = Add(&host, &def);
        for (int tick = 0; tick < 60; ++tick) {
            kiriObstacleState now = TickBall(&host, ball, &def, 2);
            double x = now.impulse[0], y = now.impulse[1], z = now.impulse[2], most = 1e-7 * sqrt(x * x + y * y + z * z);
            assert_true(fabs(now.angularImpulse[0]) + fabs(now.angularImpulse[1]) + fabs(now.angularImpulse[2]) <= most);
            given[k] += now.impulse[2];
        }
    }
    assert_true(given[0] > 1.0 && fabs(given[0] - given[1]) < 1e-3 * given[0]);
}

TEST(GroupsTellWhoTouches)
{
    START_HOST(host);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_PLANE);
    def.groups = 2;
    Add(&host, &def);
    kiriSheetDef plate = DefaultSheet();
    plate.gridResolution = 4;
    plate.frameCount = plate.maxFrames = 1;
    plate.position[2] = 0.05f;
    plate.groups = 3;
    kiriSheet holds = Host_AddRectangle(&host, &plate, 0.2f, 0.2f, 4, 4);
    plate.groups = 5;
    kiriSheet passes = Host_AddRectangle(&host, &plate, 0.2f, 0.2f, 4, 4);
    Ticks(&host, 40);
    assert_true(Host_Totals(&host, holds).center[2] > 0.0);
    assert_true(Host_Totals(&host, passes).center[2] < -1.0);
}

/* Of a rigid planar plate that stands on its edge at a height. */
static kiriSheetDef UprightPlate(float contactThickness, float height)
{
    kiriSheetDef plate = PlateDef(contactThickness);
    plate.planar = 1;
    plate.axisV[1] = 0.0f;
    plate.axisV[2] = 1.0f;
    plate.position[0] = -0.1f;
    plate.position[2] = height;
    return plate;
}

/* A planar sheet comes to rest on a prism without end along its normal, and within a box's height. */
TEST(PlanarSheetsRestOnPolygons)
{
    for (int which = 0; which < 3; ++which) {
        START_HOST(host);
        kiriObstacleDef def = DefOf(which == 0 ? KIRI_OBSTACLE_PRISM : KIRI_OBSTACLE_BOX);
        const float turned[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, -1.0f, 0.0f };
        memcpy(def.rotation, turned, sizeof(turned));
        def.height = 0.0f;
        def.size[which == 1 ? 2 : 0] = which == 1 ? 0.001f : 0.6f; /* thin along the normal of the sheet: no matter */
        Add(&host, &def);
        kiriSheetDef plate = UprightPlate(0.01f, 0.25f);
        kiriSheet sheet = Host_AddRectangle(&host, &plate, 0.2f, 0.1f, 8, 4);
        Ticks(&host, 60);
        assert_true(fabs(Host_Totals(&host, sheet).center[2] - 0.2 - 0.005 - 0.05) < 1e-3);
        assert_true(fabs(Host_Totals(&host, sheet).center[0]) < 1e-2);
    }
}

/* Two corners that point up hold a plate of two triangles between its vertices. */
TEST(PlanarBordersRestOnCorners)
{
    START_HOST(host);
    for (int i = 0; i < 2; ++i) {
        kiriObstacleDef def = DefOf(KIRI_OBSTACLE_BOX);
        const float diamond[9] = { 0.70710678f, 0.0f, 0.70710678f, -0.70710678f, 0.0f, 0.70710678f, 0.0f, -1.0f, 0.0f };
        memcpy(def.rotation, diamond, sizeof(diamond));
        def.size[0] = def.size[1] = 0.1f;
        def.position[0] = i == 0 ? -0.06f : 0.05f;
        def.position[2] = -0.070710678f;
        Add(&host, &def);
    }
    kiriSheetDef plate = UprightPlate(0.004f, 0.05f);
    kiriSheet sheet = Host_AddRectangle(&host, &plate, 0.2f, 0.1f, 1, 1);
    Ticks(&host, 60);
    assert_true(fabs(Host_Totals(&host, sheet).center[2] - 0.002 - 0.05) < 1e-3);
    assert_true(fabs(Host_Totals(&host, sheet).center[0]) < 1e-2);
}

/* Two triangles, 0.2 m wide, bridge balls of 2 cm and rods: flat, and as the border of a planar sheet. */
TEST(RoundObstaclesHoldBetweenVertices)
{
    static const float places[4][2] = { { -0.06f, -0.05f }, { 0.07f, -0.06f }, { 0.05f, 0.06f }, { -0.05f, 0.07f } };
    static const int32_t types[3] = { KIRI_OBSTACLE_SPHERE, KIRI_OBSTACLE_CAPSULE, KIRI_OBSTACLE_CYLINDER };
    for (int which = 0; which < 6; ++which) {
        bool planar = which >= 3;
        START_HOST(host);
        for (int i = 0; i < 4; ++i) {
            kiriObstacleDef def = DefOf(types[which % 3]);
            const float lying[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, -1.0f, 0.0f };
            memcpy(def.rotation, lying, sizeof(lying));
            def.radius = 0.01f;
            def.height = 0.02f;
            Set3(def.position, places[i][0], planar ? 0.0f : places[i][1], -0.01f);
            Add(&host, &def);
        }
        kiriSheetDef plate = PlateDef(0.004f);
        plate.planar = planar;
        plate.axisV[1] = planar ? 0.0f : 1.0f;
        plate.axisV[2] = planar ? 1.0f : 0.0f;
        Set3(plate.position, -0.1f, planar ? 0.0f : -0.1f, 0.02f);
        kiriSheet sheet = Host_AddRectangle(&host, &plate, 0.2f, 0.2f, 1, 1);
        Ticks(&host, 90);
        assert_true(fabs(Host_Totals(&host, sheet).center[2] - (planar ? 0.102 : 0.002)) < 1e-3);
    }
}

/* An obstacle goes on by its velocities: turned about its axis in the end, and where it should be. */
TEST(ObstaclesAdvance)
{
    START_HOST(host);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_CAPSULE);
    def.velocity[0] = 2.0f;
    def.angularVelocity[2] = 3.0f;
    kiriObstacle obstacle = Add(&host, &def);
    Ticks(&host, 60);
    kiriObstacleState is = World_ObstacleState(host.world, obstacle);
    assert_true(fabs(is.position[0] - 2.0) < 1e-5);
    assert_true(fabs(is.rotation[0] - cos(3.0)) < 1e-6 && fabs(is.rotation[1] - sin(3.0)) < 1e-6);
}

/* A world of everything, to be driven twice and with refusals. */
static void FillWorld(Host* host, kiriSheet sheets[2])
{
    for (int32_t type = KIRI_OBSTACLE_PLANE; type <= KIRI_OBSTACLE_PRISM; ++type) {
        kiriObstacleDef def = DefOf(type);
        def.position[0] = type == KIRI_OBSTACLE_PLANE ? 0.0f : 0.3f * ((float)type - 3.0f);
        def.position[2] = type == KIRI_OBSTACLE_PLANE ? -0.2f : 0.0f;
        def.velocity[1] = type == KIRI_OBSTACLE_BOX ? 0.1f : 0.0f;
        Add(host, &def);
    }
    for (int i = 0; i < 2; ++i) {
        kiriSheetDef def = DefaultSheet();
        def.gridResolution = 8;
        def.frameCount = def.maxFrames = 4;
        Set3(def.position, -0.8f + 0.7f * (float)i, -0.4f, 0.41f);
        sheets[i] = Host_AddRectangle(host, &def, 0.8f, 0.8f, 12, 12);
    }
}

TEST(CreationMayBeRefused)
{
    START_HOST(host);
    kiriObstacleDef def = DefOf(KIRI_OBSTACLE_PRISM);
    kiriObstacle obstacle = 1;
    uint64_t before = Host_Hash(&host);
    int n = 0;
    for (;; ++n) {
        host.failAt = host.calls + n;
        kiriResult result = kiriCreateObstacle(host.world, &def, &obstacle);
        host.failAt = -1;
        if (result == KIRI_OK) {
            break;
        }
        assert_int_equal(result, KIRI_ERROR_MEMORY);
        assert_true(obstacle == 0 && Host_Hash(&host) == before);
    }
    assert_in_range(n, 1, 5);
}

/* What touched once takes no memory to touch again. */
TEST(TouchingAgainAllocatesNothing)
{
    kiriSheet sheets[2];
    START_HOST(host);
    host.every = 20;
    FillWorld(&host, sheets);
    Ticks(&host, 60);
    for (int i = 0; i < 2; ++i) {
        World_PieceState(host.world, sheets[i], 0);
    }
    int64_t calls = host.calls;
    int32_t touched = 0;
    for (int i = 0; i < 10; ++i) {
        OK(kiriWorld_Tick(host.world, dt, 2));
        touched += World_Profile(host.world).contacts;
    }
    assert_int_equal(host.calls, calls);
    assert_true(touched > 0);
}

/* A sheet that swings from a corner is nowhere farther after a tick than was said before it. */
TEST(ReachHoldsTheTick)
{
    START_HOST(host);
    host.every = 10;
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 8;
    def.frameCount = def.maxFrames = 9;
    def.material.detail = 0; /* the reach is of the surface without it */
    def.velocity[0] = 1.0f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 0.8f, 0.8f, 12, 12);
    Host_Pin(&host, sheet, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
    double most = 0.0;
    for (int i = 0; i < 90; ++i) {
        float lower[3], upper[3], least = INFINITY;
        OK(kiriSheet_GetReach(host.world, sheet, dt, lower, upper));
        OK(Host_Tick(&host, dt, 2));
        kiriMesh mesh = World_Mesh(host.world, sheet);
        for (int32_t n = 0; n < 3 * mesh.vertexCount; ++n) {
            assert_true(mesh.positions[n] >= lower[n % 3] && mesh.positions[n] <= upper[n % 3]);
            least = fminf(least, fminf(mesh.positions[n] - lower[n % 3], upper[n % 3] - mesh.positions[n]));
        }
        most = fmax(most, least);
    }
    assert_true(most < 0.6); /* and is not said to be anywhere */
}
