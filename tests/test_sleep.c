/* Sheets that come to rest, sleep, and wake, through the public header alone. */
#include "host.h"

static const float dt = 1.0f / 60.0f;
enum { HALF_SECOND = 30 };

static bool IsAwake(const Host* host, kiriSheet sheet)
{
    int32_t awake = World_IsAwake(host->world, sheet);
    assert_true(awake == 0 || awake == 1);
    return awake == 1;
}

#define Tick(host) OK(Host_Tick(host, dt, 2))

/* Ticks until it sleeps: how many. */
static int TicksToSleep(Host* host, kiriSheet sheet, int most)
{
    int ticks = 0;
    for (; ticks < most && IsAwake(host, sheet); ++ticks) {
        Tick(host);
    }
    return ticks;
}

/* A damped cloth that hangs from two corners, at rest and asleep. */
static kiriSheet HangAsleep(Host* host, kiriPin pins[2])
{
    kiriSheetDef def = Host_SmallDef();
    def.material.airDamping = 4.0f;
    def.material.flexDamping = 0.01f;
    Host_Start(host);
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    pins[0] = Host_Pin(host, sheet, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f);
    pins[1] = Host_Pin(host, sheet, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f);
    int ticks = TicksToSleep(host, sheet, 3000);
    assert_true(ticks > HALF_SECOND && ticks < 3000);
    return sheet;
}

TEST(HangingSheetSleeps)
{
    HOST(host);
    kiriPin pins[2];
    float before[75];
    kiriSheet sheet = HangAsleep(&host, pins);
    memcpy(before, Host_Mesh(&host, sheet).positions, sizeof(before));
    uint64_t hash = Host_Hash(&host);
    for (int k = 0; k < 100; ++k) {
        Tick(&host);
        assert_int_equal(World_Profile(host.world).solverIterations, 0);
    }
    assert_false(IsAwake(&host, sheet));
    assert_true(Host_Hash(&host) == hash);
    assert_memory_equal(before, Host_Mesh(&host, sheet).positions, sizeof(before));
    assert_true(Host_Totals(&host, sheet).kineticEnergy == 0.0);
}

TEST(CutWakes)
{
    static const float across[4] = { -0.1f, 0.41f, 1.1f, 0.43f };
    HOST(host);
    kiriPin pins[2];
    kiriSheet sheet = HangAsleep(&host, pins);
    double height = Host_Totals(&host, sheet).center[2];
    kiriCut cut = World_BeginCut(host.world, sheet, across);
    assert_false(IsAwake(&host, sheet));
    OK(kiriCut_Extend(host.world, cut, across + 2, 1));
    Tick(&host);
    assert_true(IsAwake(&host, sheet));
    for (int k = 0; k < 20; ++k) {
        Tick(&host);
    }
    /* 0.42 of it falls for a third of a second, more than 0.2 m in air */
    assert_true(Host_Totals(&host, sheet).center[2] < height - 0.42 * 0.2);
}

/* Sheets with a cut that waits for the budget go on sleeping, and wake one after another as their cuts take effect. */
TEST(WaitingCutDoesNotWake)
{
    enum { SHEETS = 6 };
    static const float line[4] = { 0.3f, 0.41f, 0.7f, 0.43f };
    const kiriBudget budget = { .triangles = KIRI_LEAST_TRIANGLES, .cells = 40, .samples = 20 };
    kiriSheet sheets[SHEETS];
    START_HOST(host);
    World_StopGravity(host.world);
    for (int k = 0; k < SHEETS; ++k) {
        sheets[k] = Host_AddSmall(&host, 4);
    }
    assert_true(TicksToSleep(&host, sheets[SHEETS - 1], 100) < 100);
    OK(kiriWorld_SetBudget(host.world, &budget));
    for (int k = 0; k < SHEETS; ++k) {
        Host_Cut(&host, sheets[k], line, 2);
    }
    int commits = 0, most = 0;
    for (int tick = 0; tick < 1000 && commits < SHEETS; ++tick) {
        Host_Tick(&host, dt, 2);
        kiriProfile profile = World_Profile(host.world);
        commits += profile.commits;
        most = profile.commits > most ? profile.commits : most;
        for (int k = 0; k < SHEETS; ++k) {
            assert_true(IsAwake(&host, sheets[k]) <= (k < commits));
        }
    }
    assert_int_equal(commits, SHEETS);
    assert_true(most < SHEETS);
}

/* More calls that wake are in test_sleep_pieces.c. */
typedef enum Call { SAME_TARGET, SAME_GRAVITY, NO_FORCE, FREE_AGAIN, NO_CONTACTS, TARGET, GRAVITY, CALLS } Call;

static void Perform(Host* host, kiriSheet sheet, const kiriPin pins[2], Call call)
{
    static const float gravity[3] = { 0.0f, 0.0f, -9.81f }, lighter[3] = { 0.0f, 0.0f, -9.8f };
    static const float target[3] = { 0.0f, 1.0f, 0.0f }, farther[3] = { 0.0f, 1.001f, 0.0f };
    kiriFrame frames[8];
    World_GetFrames(host->world, sheet, frames, 8);
    switch (call) {
    case SAME_TARGET:
        OK(kiriPin_SetTarget(host->world, pins[0], target));
        break;
    case SAME_GRAVITY:
        OK(kiriWorld_SetGravity(host->world, gravity));
        break;
    case NO_FORCE:
        OK(kiriFrame_ApplyForce(host->world, frames[1], noVector, noVector));
        break;
    case FREE_AGAIN:
        OK(kiriFrame_Hold(host->world, frames[1], NULL, NULL));
        break;
    case NO_CONTACTS:
        OK(kiriSheet_SetContacts(host->world, sheet, NULL, 0));
        break;
    case TARGET:
        OK(kiriPin_SetTarget(host->world, pins[0], farther));
        break;
    default:
        OK(kiriWorld_SetGravity(host->world, lighter));
        break;
    }
}

/* What is new wakes it, and what is as it was does not. */
TEST(CallsWake)
{
    for (int call = 0; call < CALLS; ++call) {
        HOST(host);
        kiriPin pins[2];
        kiriSheet sheet = HangAsleep(&host, pins);
        Perform(&host, sheet, pins, (Call)call);
        Tick(&host);
        kiriProfile profile = World_Profile(host.world);
        if (IsAwake(&host, sheet) != (call >= TARGET) || (profile.solverIterations > 0) != (call >= TARGET)) {
            fail_msg("call %d", call);
        }
    }
}

/* A hold stays a hold however often it is said; one that moves, or ends, wakes. */
TEST(HeldSheetSleeps)
{
    static const float turned[9] = { 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    HOST(host);
    kiriPin pins[2];
    kiriSheet sheet = HangAsleep(&host, pins);
    kiriFrame frames[8];
    World_GetFrames(host.world, sheet, frames, 8);
    kiriFrameState at = World_FrameState(host.world, frames[0]);
    for (int k = 0; k < 3000 && (k < 2 || IsAwake(&host, sheet)); ++k) {
        OK(kiriFrame_Hold(host.world, frames[0], at.position, at.rotation));
        Tick(&host);
    }
    assert_false(IsAwake(&host, sheet));
    OK(kiriFrame_Hold(host.world, frames[0], at.position, turned));
    assert_true(IsAwake(&host, sheet));
    assert_true(TicksToSleep(&host, sheet, 3000) < 3000);
    OK(kiriFrame_Hold(host.world, frames[0], NULL, NULL));
    assert_true(IsAwake(&host, sheet));
}

/* ---- Floor ---- */

/* Contacts for the points near the floor, found anew from where they are seen. */
static void Touch(Host* host, kiriSheet sheet, float floor, float sway)
{
    kiriContact contacts[16];
    const float* points;
    int32_t count, found = 0;
    OK(kiriSheet_GetCollisionPoints(host->world, sheet, &points, &count));
    for (int32_t i = 0; i < count && i < 16; ++i) {
        if (points[3 * i + 2] < floor + 0.02f) {
            kiriContact contact = {
                .point = i, .normal = { sway, 0.0f, 1.0f }, .offset = floor + sway * points[3 * i], .friction = 0.5f
            };
            contacts[found++] = contact;
        }
    }
    OK(kiriSheet_SetContacts(host->world, sheet, contacts, found));
}

static kiriSheet LieAsleep(Host* host)
{
    kiriSheetDef def = Host_SmallDef();
    def.collisionPoints = 16;
    def.material.flexDamping = 0.02f;
    def.material.airDamping = 2.0f;
    def.position[2] = 0.05f;
    Host_Start(host);
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    int tick = 0;
    for (; tick < 3000 && IsAwake(host, sheet); ++tick) {
        Touch(host, sheet, 0.0f, 0.0f);
        Tick(host);
    }
    assert_true(tick > HALF_SECOND && tick < 3000);
    return sheet;
}

TEST(SheetOnFloorSleeps)
{
    static const struct {
        float floor, sway;
        bool wakes;
    } cases[] = { { 0.0f, 0.0f, false },  { 1e-5f, 0.0f, false }, { 0.0f, 1e-4f, false },
                  { 0.002f, 0.0f, true }, { 0.0f, 0.01f, true },  { -1.0f, 0.0f, true } };
    for (size_t i = 0; i < sizeof(cases) / sizeof(cases[0]); ++i) {
        HOST(host);
        kiriSheet sheet = LieAsleep(&host);
        for (int k = 0; k < 5; ++k) {
            Touch(&host, sheet, cases[i].floor, cases[i].sway);
            Tick(&host);
        }
        if (IsAwake(&host, sheet) != cases[i].wakes) {
            fail_msg("case %d", (int)i);
        }
    }
}

/* The floor creeps up, each tick by less than what wakes it: it is the floor that it fell asleep on that counts. */
TEST(CreepingFloorWakes)
{
    HOST(host);
    kiriSheet sheet = LieAsleep(&host);
    int tick = 0;
    for (; tick < 100 && !IsAwake(&host, sheet); ++tick) {
        Touch(&host, sheet, 5e-5f * (float)tick, 0.0f);
        Tick(&host);
    }
    assert_true(tick > 5 && tick < 20);
}

/* Lets a cloth fall on its edge, which leans by a tilt. Returns the ticks until it sleeps. */
static int CrumpleSheet(int32_t skinning, float tilt, double* lowest)
{
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    const float up[3] = { 0.0f, tilt, sqrtf(1.0f - tilt * tilt) };
    int tick = 0;
    World_AddFloor(host.world);
    def.gridResolution = 32;
    def.frameCount = def.maxFrames = 25;
    def.skinning = skinning;
    def.position[2] = 0.05f;
    memcpy(def.axisV, up, sizeof(up));
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 32, 32);
    for (; tick < 480 && IsAwake(&host, sheet); ++tick) {
        Tick(&host);
        kiriMesh mesh = Host_Mesh(&host, sheet);
        for (int32_t v = 0; v < mesh.vertexCount; ++v) {
            *lowest = fmin(mesh.positions[3 * v + 2], *lowest);
        }
    }
    return tick;
}

/* A cloth that falls on its edge crumples. It lies on the floor, and not in it. Few starts of ten stay awake. */
FIGURE(CrumpledSheetSleeps)
{
    static const float tilts[] = { 0.01f, 0.02f, 0.03f, 0.05f, 0.08f };
    double lowest = 0.0;
    int awake = 0;
    for (int32_t skinning = KIRI_SKINNING_LINEAR; skinning <= KIRI_SKINNING_SMOOTH; ++skinning) {
        for (size_t i = 0; i < sizeof(tilts) / sizeof(tilts[0]); ++i) {
            awake += CrumpleSheet(skinning, tilts[i], &lowest) == 480;
        }
    }
    if (awake > 2 || lowest < -12e-3) {
        fail_msg("%d of 10 awake after 480 ticks, %g m deep", awake, lowest);
    }
}

/* Contacts that moved otherwise than the surface gave energy to cloths over the rim of a table, in these layouts for ever. */
FIGURE(TableclothsSleep)
{
    static const int32_t rows[][3] = { { 25, 32, 1 }, { 49, 24, 1 }, { 49, 32, 1 }, { 30, 32, 0 }, { 42, 48, 0 } };
    for (size_t i = 0; i < sizeof(rows) / sizeof(rows[0]); ++i) {
        START_HOST(host);
        kiriObstacleDef table = DefaultObstacle();
        kiriSheetDef def = DefaultSheet();
        table.type = KIRI_OBSTACLE_CYLINDER, table.radius = 0.4f, table.height = 0.7f, table.position[2] = 0.35f;
        World_AddObstacle(host.world, &table);
        def.frameCount = def.maxFrames = rows[i][0], def.gridResolution = rows[i][1], def.skinning = rows[i][2];
        def.position[0] = -0.588f, def.position[1] = -0.612f, def.position[2] = 0.75f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.2f, 1.2f, 32, 32);
        for (int tick = 0; tick < 900 && IsAwake(&host, sheet); ++tick) {
            Tick(&host);
        }
        assert_false(IsAwake(&host, sheet));
    }
}

/* A sheet on one or two pins, clamps or held frames gains no energy. Where it falls asleep it is in balance: awake again, it stays. It lies flat
   at first, so none stands on its pins. Some swing for long. */
FIGURE(PinnedSheetsAreLeftAlone)
{
    int slept = 0;
    for (int k = 0; k < 12; ++k) {
        HOST(host);
        float before[3 * 169];
        uint32_t seed = (uint32_t)k + 1;
        kiriSheetDef def = SheetOf(16, 4 + k);
        OK(kiriGetMaterial(k % KIRI_MATERIAL_COUNT, &def.material));
        def.material.detail = 0;
        def.model = k / 5 % 2;
        def.skinning = k < 10 ? KIRI_SKINNING_SMOOTH : KIRI_SKINNING_LINEAR;
        def.maxFrames = def.frameCount;
        def.iterations = 1 + k / 3 % 4;
        Host_Start(&host);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 0.8f, 0.6f, 12, 12);
        for (int i = 0; i <= k % 2; ++i) {
            const float at[2] = { (float)RandomBetween(&seed, 0.1, 0.7), (float)RandomBetween(&seed, 0.1, 0.5) };
            if (k % 3 == 0) {
                const float to[2] = { (float)RandomBetween(&seed, 0.1, 0.7), (float)RandomBetween(&seed, 0.1, 0.5) };
                World_Clamp(host.world, sheet, at, to);
            } else if (k % 4 == 1) {
                kiriFrame frame = World_PointState(host.world, sheet, at).frame;
                kiriFrameState state = World_FrameState(host.world, frame);
                OK(kiriFrame_Hold(host.world, frame, state.position, state.rotation));
            } else {
                Host_Pin(&host, sheet, at[0], at[1], at[0], at[1], 0.0f);
            }
        }
        double most = World_Energy(host.world, sheet) + 0.01 * 9.81 * Host_Totals(&host, sheet).mass;
        for (int tick = 0; tick < 1200 && IsAwake(&host, sheet); ++tick) {
            OK(kiriWorld_Tick(host.world, dt, 1 + k % 4));
            assert_true(World_Energy(host.world, sheet) <= most);
        }
        memcpy(before, Host_Mesh(&host, sheet).positions, sizeof(before));
        int sleeps = !IsAwake(&host, sheet);
        slept += sleeps;
        for (int tick = 0; tick < 120 * sleeps; ++tick) {
            OK(kiriSheet_Wake(host.world, sheet));
            OK(kiriWorld_Tick(host.world, dt, 1 + k % 4));
            for (int n = 0; n < 3 * 169; ++n) {
                assert_true(fabs((double)(Host_Mesh(&host, sheet).positions[n] - before[n])) < 0.004);
            }
        }
    }
    assert_true(slept >= 9);
}
