/* Pieces of a sheet that take turns where the budget has too few linear systems for all of them. */
#include "host.h"

static const float dt = 1.0f / 60.0f, still[3] = { 0.0f, 0.0f, 0.0f };
enum { PARTS = 7, PIECES = PARTS * PARTS, MOST = 64 };

static void CutDice(Host* host, kiriSheet sheet)
{
    for (int i = 1; i < PARTS; ++i) {
        float at = ((float)i + 0.03f) / PARTS;
        Host_Cut(host, sheet, (float[]){ at, -0.1f, at, 1.1f }, 2);
        Host_Cut(host, sheet, (float[]){ -0.1f, at, 1.1f, at }, 2);
    }
}

static kiriSheet AddSheet(Host* host, const float position[3], int32_t skinning, int32_t frames, int32_t squares)
{
    kiriSheetDef def = SheetOf(28, frames);
    def.maxFrames = 1000;
    def.rigidArea = 1.0f;
    def.material.airDamping = 0.0f;
    def.skinning = skinning;
    def.normals = 1;
    memcpy(def.position, position, sizeof(def.position));
    return Host_AddRectangle(host, &def, 1.0f, 1.0f, squares, squares);
}

static void Limit(Host* host, int32_t systems)
{
    const kiriBudget budget = { .triangles = 0, .cells = 0, .samples = 0, .iterations = systems };
    OK(kiriWorld_SetBudget(host->world, &budget));
}

/* In pieces that are to move under a budget. */
static kiriSheet StartDice(Host* host, int32_t systems)
{
    Host_Start(host);
    World_StopGravity(host->world);
    kiriSheet sheet = AddSheet(host, (const float[3]){ 0.0f, 0.0f, 0.0f }, KIRI_SKINNING_LINEAR, 1, 14);
    CutDice(host, sheet);
    OK(Host_Tick(host, dt, 2));
    Limit(host, systems);
    return sheet;
}

static int32_t GetFrames(const Host* host, kiriSheet sheet, kiriFrame* frames, kiriFrameState* states)
{
    int32_t count = World_GetFrames(host->world, sheet, frames, MOST);
    assert_true(count <= MOST);
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_GetState(host->world, frames[i], &states[i]));
    }
    return count;
}

static int32_t SystemsOf(const Host* host)
{
    kiriProfile profile = World_Profile(host->world);
    return profile.solverIterations;
}

static void CheckMomentum(const Host* host, kiriSheet sheet, const double* momentum)
{
    kiriTotals totals = Host_Totals(host, sheet);
    for (int k = 0; k < 3; ++k) {
        assert_true(fabs(totals.momentum[k] - momentum[k]) < 1e-9 * totals.mass);
    }
}

/* Each gets as many ticks as any other, or one more or less. One that waits stays where it is and keeps its
   velocity. */
TEST(PiecesTakeTurns)
{
    HOST(host);
    kiriFrame frames[MOST];
    kiriFrameState was[MOST], is[MOST];
    int32_t ticks[MOST] = { 0 }, least = INT32_MAX, most = 0;
    kiriSheet sheet = StartDice(&host, 1);
    OK(kiriSheet_SetVelocity(host.world, sheet, (const float[3]){ 0.5f, 0.2f, 1.0f },
                             (const float[3]){ 0.0f, 0.3f, 0.1f }));
    kiriTotals totals = Host_Totals(&host, sheet);
    int32_t count = GetFrames(&host, sheet, frames, was);
    assert_int_equal(count, PIECES);
    for (int tick = 0; tick < 40; ++tick) {
        int32_t moved = 0;
        assert_int_equal(Host_Tick(&host, dt, 2), KIRI_PENDING);
        assert_int_equal(SystemsOf(&host), 1);
        GetFrames(&host, sheet, frames, is);
        for (int32_t i = 0; i < count; ++i) {
            bool isMoved = memcmp(was[i].position, is[i].position, sizeof(is[i].position)) != 0;
            ticks[i] += isMoved;
            moved += isMoved;
            if (!isMoved) {
                assert_memory_equal(&was[i], &is[i], sizeof(is[i]));
            }
        }
        assert_in_range(moved, 10, 15);
        memcpy(was, is, sizeof(was));
        CheckMomentum(&host, sheet, totals.momentum);
    }
    for (int32_t i = 0; i < count; ++i) {
        least = ticks[i] < least ? ticks[i] : least;
        most = ticks[i] > most ? ticks[i] : most;
    }
    assert_true(least >= 8 && most <= least + 1);
    Limit(&host, 0);
    OK(Host_Tick(&host, dt, 2));
}

/* Forces are of one tick, also for those that wait in it. */
TEST(ForcesAreUsedUp)
{
    HOST(host);
    kiriFrame frames[MOST];
    kiriFrameState states[MOST], after[MOST];
    kiriSheet sheet = StartDice(&host, 1);
    int32_t count = GetFrames(&host, sheet, frames, states), pushed = 0;
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_ApplyForce(host.world, frames[i], (const float[3]){ 0.0f, 0.0f, states[i].mass },
                                (const float[3]){ 0.0f, 0.0f, 0.0f }));
    }
    for (int tick = 0; tick < 8; ++tick) {
        assert_int_equal(Host_Tick(&host, dt, 2), KIRI_PENDING);
    }
    GetFrames(&host, sheet, frames, after);
    for (int32_t i = 0; i < count; ++i) {
        pushed += after[i].velocity[2] > 0.0f;
        assert_true(after[i].velocity[2] < 1.01f * dt);
    }
    assert_in_range(pushed, 10, 15);
}

/* Small sheets that come after the dice are moved as well. */
TEST(SheetsTakeTurns)
{
    enum { OTHERS = 3 };
    HOST(host);
    kiriSheet others[OTHERS];
    int32_t moved[OTHERS] = { 0 }, dice = 0;
    double last[OTHERS + 1] = { 0.0 };
    kiriSheet sheet = StartDice(&host, 1);
    OK(kiriSheet_SetVelocity(host.world, sheet, (const float[3]){ 0.0f, 0.0f, 1.0f }, still));
    for (int k = 0; k < OTHERS; ++k) {
        others[k] = AddSheet(&host, (const float[3]){ 2.0f + (float)k, 0.0f, 0.0f }, KIRI_SKINNING_LINEAR, 1, 14);
        OK(kiriSheet_SetVelocity(host.world, others[k], (const float[3]){ 0.0f, 0.0f, 1.0f }, still));
    }
    for (int tick = 0; tick < 80; ++tick) {
        assert_int_equal(Host_Tick(&host, dt, 2), KIRI_PENDING);
        assert_true(SystemsOf(&host) <= 1);
        for (int k = 0; k < OTHERS; ++k) {
            double z = Host_Totals(&host, others[k]).center[2];
            moved[k] += z > last[k];
            last[k] = z;
        }
        double z = Host_Totals(&host, sheet).center[2];
        dice += z > last[OTHERS];
        last[OTHERS] = z;
    }
    for (int k = 0; k < OTHERS; ++k) {
        assert_in_range(moved[k], 80 / (OTHERS + 1) - 2, 80 / (OTHERS + 1) + 2);
    }
    assert_in_range(dice, 80 / (OTHERS + 1) - 2, 80 / (OTHERS + 1) + 2);
}

static kiriObstacle AddFloor(Host* host)
{
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_PLANE);
    def.position[2] = -0.05f;
    return World_AddObstacle(host->world, &def);
}

/* What is seen is what is there, whoever waits: far away, with normals, with and without fades, with patches that bend,
   in the tick of the cut or later. Host_Tick looks. */
static void CutWhileWaiting(int32_t skinning, float x, float fadeTime, int32_t cells)
{
    START_HOST(host);
    kiriSheet sheet = AddSheet(&host, (const float[3]){ x, 0.0f, 0.0f }, skinning, 6, 56);
    kiriSheetSettings settings = World_Settings(host.world, sheet);
    settings.fadeTime = fadeTime;
    OK(kiriSheet_SetSettings(host.world, sheet, &settings));
    World_Clamp(host.world, sheet, (const float[2]){ 0.0f, 1.0f }, (const float[2]){ 1.0f, 1.0f });
    const kiriBudget budget = { .triangles = 0, .cells = cells, .samples = cells, .iterations = 1 };
    OK(kiriWorld_SetBudget(host.world, &budget));
    for (int tick = 0; tick < 60; ++tick) {
        assert_true(Host_Tick(&host, dt, 2) >= 0);
        if (tick % 20 == 5) {
            CutDice(&host, sheet);
        }
        if (tick % 20 == 12) {
            float at = 0.3f + 0.01f * (float)tick;
            Host_Cut(&host, sheet, (float[]){ at, at, at + 0.1f, at - 0.1f }, 2);
        }
    }
}

TEST(SeenWhileWaiting)
{
    for (int32_t cells = 0; cells <= 5000; cells += 2500) {
        CutWhileWaiting(KIRI_SKINNING_LINEAR, 0.0f, 0.25f, cells);
        CutWhileWaiting(KIRI_SKINNING_LINEAR, 0.0f, 0.0f, cells);
        CutWhileWaiting(KIRI_SKINNING_SMOOTH, 1000.0f, 0.25f, cells);
        CutWhileWaiting(KIRI_SKINNING_SMOOTH, 1000.0f, 0.0f, cells);
    }
}

/* Who comes next is a part of the state. */
TEST(SaveWhileWaiting)
{
    Host host, other;
    kiriSheet sheet = StartDice(&host, 1);
    OK(kiriSheet_SetVelocity(host.world, sheet, (const float[3]){ 0.5f, 0.2f, 1.0f }, still));
    AddFloor(&host);
    for (int tick = 0; tick < 3; ++tick) {
        assert_int_equal(Host_Tick(&host, dt, 2), KIRI_PENDING);
    }
    Host_Start(&other);
    World_Copy(other.world, host.world, kiriWorld_Save);
    for (int tick = 0; tick < 20; ++tick) {
        assert_true(Host_Hash(&host) == Host_Hash(&other));
        assert_int_equal(Host_Tick(&host, dt, 2), KIRI_PENDING);
        assert_int_equal(Host_Tick(&other, dt, 2), KIRI_PENDING);
    }
    Host_Stop(&host);
    Host_Stop(&other);
}

/* ---- Steps that cost more than the budget ------------------------------------------------------------------------ */

enum Holding { BY_PINS, BY_A_CLAMP, ON_A_BALL, BY_A_SEAM, HOLDINGS };

/* A level sheet that is let go: held at one side, above a ball, or sewn to one that is held. */
static void StartLevel(Host* host, kiriSheet sheets[2], enum Holding holding, int32_t preset, int32_t model)
{
    static const float corners[4] = { 0.0f, 1.0f, 1.0f, 1.0f }, lower[4] = { 0.0f, 0.0f, 1.0f, 0.0f };
    kiriSheetDef def = SheetOf(24, 49);
    OK(kiriGetMaterial(preset, &def.material));
    def.model = model;
    Host_Start(host);
    sheets[0] = sheets[1] = Host_AddRectangle(host, &def, 1.0f, 1.0f, 12, 12);
    if (holding == BY_A_CLAMP) {
        World_Clamp(host->world, sheets[0], corners, corners + 2);
    } else if (holding == ON_A_BALL) {
        kiriObstacleDef ball = ObstacleOf(KIRI_OBSTACLE_SPHERE);
        ball.radius = 0.2f;
        Set3(ball.position, 0.5f, 0.5f, -0.25f);
        World_AddObstacle(host->world, &ball);
    } else {
        for (int k = 0; k < 2; ++k) {
            kiriPinDef pin = DefaultPin();
            memcpy(pin.restPoint, corners + 2 * k, sizeof(pin.restPoint));
            memcpy(pin.target, corners + 2 * k, sizeof(pin.restPoint));
            World_AddPin(host->world, sheets[0], &pin);
        }
    }
    if (holding == BY_A_SEAM) {
        def.position[1] = -1.0f;
        sheets[1] = Host_AddRectangle(host, &def, 1.0f, 1.0f, 12, 12);
        kiriSeamDef seam = DefaultSeam();
        seam.sheetA = sheets[0];
        seam.sheetB = sheets[1];
        seam.lineA = lower;
        seam.lineB = corners;
        seam.countA = seam.countB = 2;
        World_AddSeam(host->world, &seam);
    }
}

/* A linear system of 49 frames counts 4, and 8 or more where sheets touch. A sheet that is out of balance moves on all the
   same, as far as 1 mm in 6 ticks, and gains no energy. */
FIGURE(SmallBudgetsMove)
{
    enum { WINDOW = 6, TICKS = 24, PRESETS = KIRI_MATERIAL_CARD + 1 };
    for (int n = 0; n < HOLDINGS * PRESETS * 3; ++n) {
        HOST(host);
        kiriSheet sheets[2];
        double energy = 0.0, way = 0.0;
        int kind = n / HOLDINGS / PRESETS;
        StartLevel(&host, sheets, n % HOLDINGS, n / HOLDINGS % PRESETS, kind == 2 ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS);
        Limit(&host, kind == 1 ? 12 : 1 + n % 3);
        kiriTotals last = Host_Totals(&host, sheets[1]);
        for (int tick = 0; tick < TICKS; ++tick) {
            assert_true(kiriWorld_Tick(host.world, dt, 2) >= 0);
            kiriTotals totals = Host_Totals(&host, sheets[0]);
            energy = totals.kineticEnergy + totals.elasticEnergy + 9.81 * totals.mass * totals.center[2];
            totals = Host_Totals(&host, sheets[1]);
            energy += totals.kineticEnergy + totals.elasticEnergy + 9.81 * totals.mass * totals.center[2];
            assert_true(energy < 1e-6 * totals.mass);
            for (int k = 0; k < 3; ++k) {
                way += fabs(totals.center[k] - last.center[k]);
            }
            last = totals;
            if (tick % WINDOW == WINDOW - 1) {
                assert_true(way > 1e-3);
                way = 0.0;
            }
        }
    }
}
