/* What a tick does not write anew is seen as if it were: the world is validated after each tick, and that writes all of
   it. */
#include "defaults.h"
#include "look.h"

enum { SQUARES = 96, DICE = 12, TICKS = 150 };

static const float dt = 1.0f / 60.0f;

typedef struct Way {
    int32_t skinning, model;
    bool isFar, hasBudget, hasObstacle;
} Way;

static kiriSheet Dice(Host* host, const Way* way)
{
    kiriBudget budget = { .triangles = 60, .cells = 400, .samples = 60 };
    kiriSheetDef def = SheetOf(36, 4);
    def.maxFrames = 4096;
    def.rigidArea = 1.0f;
    def.skinning = way->skinning;
    def.model = way->model;
    def.collisionPoints = 100;
    def.normals = 1;
    def.sleepSpeed = 0.02f;
    def.material.airDamping = 20.0f;
    def.position[0] = way->isFar ? 1000.0f : 0.0f;
    World_StopGravity(host->world);
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, SQUARES, SQUARES);
    for (int32_t i = 1; i < DICE; ++i) {
        float at = ((float)i + 0.013f) / DICE;
        Host_Cut(host, sheet, (float[]){ at, -0.1f, at, 1.1f }, 2);
        Host_Cut(host, sheet, (float[]){ -0.1f, at, 1.1f, at }, 2);
    }
    OK(Host_Tick(host, dt, 1));
    assert_int_equal(Host_Counts(host, sheet).pieces, DICE * DICE);
    World_Ticks(host->world, 40, dt, 1);
    if (way->hasBudget) {
        OK(kiriWorld_SetBudget(host->world, &budget));
    }
    return sheet;
}

static kiriFrame FrameAtPlace(const Host* host, kiriSheet sheet, float u, float v)
{
    const float at[2] = { u, v };
    kiriPointState point;
    int32_t piece;
    bool isThere = kiriSheet_GetPoint(host->world, sheet, at, &point) == KIRI_OK &&
                   kiriFrame_GetPiece(host->world, point.frame, &piece) == KIRI_OK;
    return isThere ? point.frame : 0; /* a piece that goes may wait */
}

static int32_t CountAsleep(const Host* host, kiriSheet sheet)
{
    int32_t asleep = 0;
    for (int32_t p = 0; p < Host_Counts(host, sheet).pieces; ++p) {
        asleep += World_PieceState(host->world, sheet, p).asleep;
    }
    return asleep;
}

static float Unit(uint32_t* seed)
{
    return (float)(Random(seed) % 10000) / 10000.0f;
}

/* A push, a slit, a cut through a few pieces, a piece that goes, other settings, a push to all, or nothing. */
static void Disturb(Host* host, kiriSheet sheet, uint32_t* seed)
{
    float u = 0.02f + 0.96f * Unit(seed), v = 0.02f + 0.96f * Unit(seed);
    kiriFrame frame = FrameAtPlace(host, sheet, u, v);
    const float push[3] = { 0.1f * Unit(seed), 0.1f * Unit(seed), 0.3f * Unit(seed) };
    kiriSheetSettings settings;
    uint32_t what = Random(seed) % 32;
    if (what < 8) {
        assert_true(frame == 0 || kiriFrame_SetPieceVelocity(host->world, frame, push, push) == KIRI_OK);
    } else if (what < 16) {
        Host_Cut(host, sheet, (float[]){ u, v, u + 0.02f, v + 0.013f }, 2);
    } else if (what < 18) {
        Host_Cut(host, sheet, (float[]){ u, v, u + 0.1f, v + 0.1f }, 2);
    } else if (what < 22) {
        assert_true(frame == 0 || kiriFrame_DestroyPiece(host->world, frame) >= 0);
    } else if (what < 23) {
        OK(kiriSheet_GetSettings(host->world, sheet, &settings));
        settings.skinning = 1 - settings.skinning;
        OK(kiriSheet_SetSettings(host->world, sheet, &settings));
    } else if (what < 24) {
        OK(kiriSheet_SetVelocity(host->world, sheet, push, noVector));
    }
}

TEST(AsWrittenAnew)
{
    static const Way ways[] = {
        { KIRI_SKINNING_LINEAR, KIRI_MODEL_LINKS, false, false, false },
        { KIRI_SKINNING_SMOOTH, KIRI_MODEL_LINKS, false, true, true },
        { KIRI_SKINNING_LINEAR, KIRI_MODEL_LINKS, true, true, false },
        { KIRI_SKINNING_LINEAR, KIRI_MODEL_LINKS, false, true, true },
    };
    for (size_t w = 0; w < sizeof(ways) / sizeof(ways[0]); ++w) {
        uint32_t seed = 7u + (uint32_t)w;
        int32_t both = 0;
        START_HOST(host);
        host.every = 7;
        kiriSheet sheet = Dice(&host, &ways[w]);
        if (ways[w].hasObstacle) {
            kiriObstacleDef def = DefaultObstacle();
            def.radius = 0.1f;
            def.position[2] = -0.3f;
            def.velocity[0] = def.velocity[1] = 0.4f;
            def.velocity[2] = 0.2f;
            def.type = KIRI_OBSTACLE_SPHERE;
            World_AddObstacle(host.world, &def);
        }
        for (int32_t tick = 0; tick < TICKS; ++tick) {
            if (tick % 4 == 0) {
                Disturb(&host, sheet, &seed);
            }
            assert_true(Host_Tick(&host, dt, 1) >= 0);
            int32_t asleep = CountAsleep(&host, sheet), pieces = Host_Counts(&host, sheet).pieces;
            both += asleep > pieces / 2 && asleep < pieces;
        }
        assert_true(both > TICKS / 4);
    }
}

/* Pieces that are cut in two sleep, and each part wakes alone: vertices have other frames than when they moved last. */
TEST(PartsWakeAlone)
{
    enum { CUTS = 6 };
    static const float up[3] = { 0.0f, 0.0f, 0.2f };
    const Way way = { KIRI_SKINNING_LINEAR, KIRI_MODEL_LINKS, false, false, false };
    START_HOST(host);
    kiriSheet sheet = Dice(&host, &way);
    for (int32_t k = 0; k < CUTS; ++k) {
        float u = (1.5f + (float)k) / DICE, v = (2.5f + (float)k) / DICE;
        Host_Cut(&host, sheet, (float[]){ u - 0.5f / DICE, v + 0.003f, u + 0.6f / DICE, v + 0.004f }, 2);
    }
    World_Ticks(host.world, 45, dt, 1);
    int32_t pieces = Host_Counts(&host, sheet).pieces;
    assert_int_equal(pieces, DICE * DICE + CUTS);
    assert_int_equal(CountAsleep(&host, sheet), pieces);
    for (int32_t k = 0; k < 2 * CUTS; ++k) {
        float u = (1.5f + (float)(k / 2)) / DICE, v = (2.5f + (float)(k / 2) + (k % 2 ? 0.3f : -0.3f)) / DICE;
        OK(kiriFrame_SetPieceVelocity(host.world, FrameAtPlace(&host, sheet, u, v), up, noVector));
        OK(Host_Tick(&host, dt, 1));
        assert_int_equal(CountAsleep(&host, sheet), pieces - 1 - k);
    }
}

/* Share of the area whose in-plane strain exceeds 5 %. */
static double StrainedShare(const kiriMesh* mesh)
{
    double all = 0.0, strained = 0.0;
    for (int32_t t = 0; t < mesh->triangleCount; ++t) {
        const int32_t* v = mesh->indices + 3 * t;
        double rest[2][2], along[2][3], p = 0.0, q = 0.0, s = 0.0;
        for (int k = 0; k < 2; ++k) {
            for (int i = 0; i < 3; ++i) {
                along[k][i] = mesh->positions[3 * v[k + 1] + i] - mesh->positions[3 * v[0] + i];
                rest[k][i % 2] = mesh->restPositions[2 * v[k + 1] + i % 2] - mesh->restPositions[2 * v[0] + i % 2];
            }
        }
        double area = rest[0][0] * rest[1][1] - rest[0][1] * rest[1][0];
        for (int i = 0; i < 3; ++i) {
            double du = (rest[1][1] * along[0][i] - rest[0][1] * along[1][i]) / area;
            double dv = (rest[0][0] * along[1][i] - rest[1][0] * along[0][i]) / area;
            p += du * du;
            q += dv * dv;
            s += du * dv;
        }
        double middle = 0.5 * (p + q), by = sqrt(0.25 * (p - q) * (p - q) + s * s);
        all += area;
        strained += middle + by > 1.05 * 1.05 || middle - by < 0.95 * 0.95 ? area : 0.0;
    }
    return strained / all;
}

/* A curtain whose upper corners come together, or a cloth that falls over a ball. */
static kiriSheet AddCloth(Host* host, int32_t detail, int32_t frames, kiriPin pins[2])
{
    kiriSheetDef def = DefaultSheet();
    def.material.detail = detail;
    def.frameCount = frames;
    host->every = 20;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 48, 48);
    for (int k = 0; pins != NULL && k < 2; ++k) {
        pins[k] = Host_Pin(host, sheet, (float)k, 1.0f, (float)k, 1.0f, 0.0f);
    }
    return sheet;
}

/* The detail layer takes the strain out of gathered cloth, and moves no frame; a commit does not make it jump. */
FIGURE(DetailOfCurtain)
{
    enum { GATHER = 60, HANG = 300 };
    for (int32_t frames = 25; frames <= 100; frames += 75) {
        HOST_PAIR(hosts);
        kiriSheet sheet[2];
        kiriPin pins[2];
        kiriMesh mesh[2];
        for (int32_t i = 0; i < 2; ++i) {
            Host_Start(&hosts[i]);
            sheet[i] = AddCloth(&hosts[i], 2 * i, frames, pins);
            for (int32_t tick = 0; tick < HANG; ++tick) {
                float in = 0.35f * (float)(tick < GATHER ? tick + 1 : GATHER) / GATHER;
                OK(kiriPin_SetTarget(hosts[i].world, pins[0], (float[]){ in, 1.0f, 0.0f }));
                OK(kiriPin_SetTarget(hosts[i].world, pins[1], (float[]){ 1.0f - in, 1.0f, 0.0f }));
                OK(Host_Tick(&hosts[i], dt, 4));
            }
            mesh[i] = Host_Mesh(&hosts[i], sheet[i]);
        }
        kiriTotals plain = Host_Totals(&hosts[0], sheet[0]), detailed = Host_Totals(&hosts[1], sheet[1]);
        assert_memory_equal(&plain, &detailed, sizeof(plain));
        double without = StrainedShare(&mesh[0]), with = StrainedShare(&mesh[1]);
        assert_true(without > 0.2);
        assert_true(with < (frames == 25 ? 0.2 * without : 0.01)); /* 25 frames leave more than the layer takes */
        int32_t count = mesh[1].vertexCount;
        float most = 0.0f, *before = malloc(12 * (size_t)count);
        memcpy(before, mesh[1].positions, 12 * (size_t)count);
        Host_Cut(&hosts[1], sheet[1], (float[]){ 0.4f, -0.1f, 0.6f, 0.8f }, 2);
        OK(kiriWorld_FinishCuts(hosts[1].world));
        mesh[1] = Host_Mesh(&hosts[1], sheet[1]);
        assert_true(mesh[1].vertexCount > count);
        for (int32_t k = 0; k < 3 * count; ++k) {
            most = fmaxf(most, fabsf(mesh[1].positions[k] - before[k]));
        }
        assert_true(most < 1e-4f / 32.0f);
        free(before);
    }
}

/* The drawn surface goes through pins and held frames. */
TEST(DetailIsHeld)
{
    enum { FRAMES = 25, MIDDLE = 12 };
    kiriPin pins[2];
    kiriFrame frames[FRAMES];
    START_HOST(host);
    kiriSheet sheet = AddCloth(&host, 2, FRAMES, pins);
    World_GetFrames(host.world, sheet, frames, FRAMES);
    kiriFrameState start = World_FrameState(host.world, frames[MIDDLE]);
    OK(kiriFrame_Hold(host.world, frames[MIDDLE], start.position, worldAxes));
    for (int32_t tick = 0; tick < 120; ++tick) {
        const float in = 0.003f * (float)(tick < 100 ? tick : 100);
        const float corners[2][3] = { { in, 1.0f, 0.0f }, { 1.0f - in, 1.0f, 0.0f } };
        for (int k = 0; k < 2; ++k) {
            OK(kiriPin_SetTarget(host.world, pins[k], corners[k]));
        }
        OK(Host_Tick(&host, dt, 4));
        for (int k = 0; k < 3; ++k) {
            const float corner[2] = { (float)k, 1.0f }, *to = k < 2 ? corners[k] : start.position;
            kiriPointState point = World_PointState(host.world, sheet, k < 2 ? corner : start.restPoint);
            assert_true(fabsf(point.position[0] - to[0]) < 1e-3f && fabsf(point.position[1] - to[1]) < 1e-3f);
            assert_true(fabsf(point.position[2] - to[2]) < 1e-3f);
        }
    }
}

/* The detail layer is at most as deep in a ball as the skin, and sleeps with its piece. */
TEST(DetailOnBall)
{
    HOST_PAIR(hosts);
    kiriSheet sheet[2];
    kiriMesh mesh[2];
    int32_t awake = 1;
    for (int32_t i = 0; i < 2; ++i) {
        Host_Start(&hosts[i]);
        sheet[i] = AddCloth(&hosts[i], 2 * i, 25, NULL);
        kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_SPHERE);
        def.radius = 0.3f;
        def.position[0] = def.position[1] = 0.5f;
        def.position[2] = -0.31f;
        kiriObstacle ball = World_AddObstacle(hosts[i].world, &def);
        def.type = KIRI_OBSTACLE_PLANE;
        def.position[2] = -0.62f;
        OK(kiriCreateObstacle(hosts[i].world, &def, &ball));
    }
    for (int32_t tick = 0; awake && tick < 900; ++tick) {
        for (int32_t i = 0; i < 2; ++i) {
            OK(Host_Tick(&hosts[i], dt, 4));
            mesh[i] = Host_Mesh(&hosts[i], sheet[i]);
        }
        for (int32_t v = 0; tick % 20 == 0 && v < mesh[1].vertexCount; ++v) {
            double from[2];
            for (int32_t i = 0; i < 2; ++i) {
                const float* x = mesh[i].positions + 3 * (size_t)v;
                from[i] = sqrt((x[0] - 0.5) * (x[0] - 0.5) + (x[1] - 0.5) * (x[1] - 0.5) + (x[2] + 0.31) * (x[2] + 0.31));
            }
            assert_true(from[1] > fmin(from[0], 0.3) - 1e-5);
        }
        OK(kiriSheet_IsAwake(hosts[1].world, sheet[1], &awake));
    }
    assert_false(awake);
    uint64_t seen = Look_Sheet(0, hosts[1].world, sheet[1]);
    OK(Host_Tick(&hosts[1], dt, 4));
    assert_true(Look_Sheet(0, hosts[1].world, sheet[1]) == seen);
}

/* Stretched, let go, and stretched again: an event each time, though the world is loaded from its save all the time. */
TEST(Strained)
{
    kiriSheetDef def = SheetOf(16, 4);
    kiriPin pins[4];
    START_HOST(host);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 16, 16);
    for (int32_t tick = 0, told = 0; tick < 800; ++tick) {
        for (int32_t k = 0; k < 4; ++k) {
            const float u = (float)(k % 2), v = (float)(k / 2), at[3] = { u + 0.4f * u * (float)(tick / 200 % 2), v, 0.0f };
            pins[k] = tick == 0 ? Host_Pin(&host, sheet, u, v, u, v, 0.0f) : pins[k];
            OK(kiriPin_SetTarget(host.world, pins[k], at));
        }
        OK(Host_Tick(&host, dt, 2));
        told += Host_Events(&host, KIRI_EVENT_STRAINED, NULL);
        assert_true(host.lines == told && told <= (tick / 200 + 1) / 2 && (told == (tick / 200 + 1) / 2 || tick % 200 < 199));
        World_Copy(host.world, host.world, tick % 2 == 0 ? kiriWorld_Save : kiriWorld_Snapshot);
    }
}

/* Clamped at both ends, with frames of 6 cm beside each other along a clamp: the drawn surface stays at the frames. */
TEST(ClampedClothIsDrawnAtItsFrames)
{
    START_HOST(host);
    kiriSheetDef def = SheetOf(32, 25);
    float points[50];
    for (int i = 0; i < 50; ++i) {
        points[i] = i % 2 == 0 ? 0.1f + 0.2f * (float)(i / 2 % 5) : 0.03f + 0.06f * (float)(i / 10);
    }
    OK(kiriGetMaterial(KIRI_MATERIAL_SILK, &def.material));
    def.framePoints = points;
    World_StopGravity(host.world);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.3f, 32, 9);
    World_Clamp(host.world, sheet, (const float[]){ 0.0f, 0.0f }, (const float[]){ 0.0f, 0.3f });
    World_Clamp(host.world, sheet, (const float[]){ 1.0f, 0.0f }, (const float[]){ 1.0f, 0.3f });
    for (int tick = 0; tick < 300; ++tick) {
        const float push[3] = { 0.0f, 0.0f, tick % 2 == 0 ? 1e-3f : -1e-3f };
        OK(kiriSheet_ApplyForce(host.world, sheet, &points[2 * (tick * 7 % 25)], push, noVector));
        OK(kiriWorld_Tick(host.world, dt, 2));
        kiriMesh mesh = World_Mesh(host.world, sheet);
        for (int32_t v = 0; v < mesh.vertexCount; ++v) {
            assert_true(fabsf(mesh.positions[3 * v + 2]) < 0.05f);
        }
    }
}

/* A sheet is thrown about its pins at 1 to 3 m/s: each point is drawn at its pin, whether a vertex is there or not;
   corners at soft springs are drawn away from them. */
TEST(PinnedPointsAreDrawnAtTheirPins)
{
    static const float points[4][2] = { { 0.0f, 1.0f }, { 1.0f, 1.0f }, { 0.52f, 1.0f }, { 0.31f, 0.73f } };
    for (int n = 0; n < 13; ++n) {
        START_HOST(host);
        kiriSheetDef def = SheetOf(32, n % 4 < 2 ? 9 : 25);
        OK(kiriGetMaterial(n % 12 / 4, &def.material)); /* paper, cotton, rubber */
        def.skinning = n % 2;
        Set3(def.axisV, 0.0f, 0.0f, 1.0f);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 16, 16);
        for (int k = 0; k < 4; ++k) {
            kiriPinDef pin = DefaultPin();
            pin.stiffness = n < 12 ? 0.0f : 5.0f;
            memcpy(pin.restPoint, points[k], sizeof(pin.restPoint));
            Set3(pin.target, points[k][0], 0.0f, points[k][1]);
            World_AddPin(host.world, sheet, &pin);
        }
        OK(kiriSheet_SetVelocity(host.world, sheet, (const float[3]){ 0.0f, 1.0f + (float)(n % 3), 0.0f }, noVector));
        for (int tick = 0; tick < 60; ++tick) {
            OK(Host_Tick(&host, dt, 2));
            for (int k = 0; k < 4; ++k) {
                kiriPointState at;
                OK(kiriSheet_GetPoint(host.world, sheet, points[k], &at));
                at.position[0] -= points[k][0];
                double away = hypot(hypot(at.position[0], at.position[1]), at.position[2] - points[k][1]);
                assert_true(n < 12 ? away < 1e-4 : tick < 30 || k > 1 || away > 5e-3);
            }
        }
    }
}
