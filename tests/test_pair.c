/* Sheets and pieces that touch each other. */
#include "crossing.h"
#include "host.h"

static int32_t Pairs(const Host* host)
{
    return World_Profile(host->world).sheetPairs;
}

/* A square of stiff paper, 0.2 m wide, whose corner is at a place. */
static kiriSheetDef SquareDef(float x, float y, float z)
{
    kiriSheetDef def = DefaultSheet();
    kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material);
    def.gridResolution = 16;
    def.frameCount = 4;
    def.touchesSheets = 1;
    def.contactThickness = 0.004f;
    Set3(def.position, x, y, z);
    return def;
}

static kiriSheet AddSquare(Host* host, const kiriSheetDef* def)
{
    kiriSheetDef own = *def;
    return Host_AddRectangle(host, &own, 0.2f, 0.2f, 16, 16);
}

TEST(PairsAreFoundWhereNear)
{
    const struct {
        float x, z;
        int32_t touches, pairs;
    } cases[] = {
        { 0.05f, 0.003f, 1, 1 }, { 0.05f, -0.003f, 1, 1 }, { 0.05f, 0.05f, 1, 0 },
        { 0.25f, 0.003f, 1, 0 }, { 0.05f, 0.003f, 0, 0 },  { 0.2f, 0.0f, 1, 0 }, /* beside each other in one plane */
    };
    for (int i = 0; i < (int)(sizeof cases / sizeof cases[0]); ++i) {
        START_HOST(host);
        World_StopGravity(host.world);
        kiriSheetDef def = SquareDef(0.0f, 0.0f, 0.0f);
        AddSquare(&host, &def);
        def = SquareDef(cases[i].x, 0.02f, cases[i].z);
        def.touchesSheets = cases[i].touches;
        AddSquare(&host, &def);
        OK(Host_Tick(&host, 1.0f / 60.0f, 2));
        assert_int_equal(Pairs(&host), cases[i].pairs);
    }
}

static const float dt = 1.0f / 60.0f;

/* A sheet that moved while it was the only one, and fell asleep, is found where it lies. */
TEST(WhoWasAloneIsFound)
{
    START_HOST(host);
    host.every = 30;
    World_AddFloor(host.world);
    kiriSheetDef def = SquareDef(0.0f, 0.0f, 0.3f);
    kiriSheet first = AddSquare(&host, &def);
    def = SquareDef(5.0f, 0.0f, 0.3f);
    kiriSheet other = AddSquare(&host, &def);
    OK(Host_Tick(&host, dt, 2)); /* both are known where they are */
    OK(kiriDestroySheet(host.world, other));
    for (int i = 0; i < 600 && World_IsAwake(host.world, first); ++i) {
        OK(Host_Tick(&host, dt, 2));
    }
    assert_false(World_IsAwake(host.world, first));
    def = SquareDef(0.02f, 0.0f, 0.006f);
    AddSquare(&host, &def);
    OK(Host_Tick(&host, dt, 2));
    assert_int_equal(Pairs(&host), 1);
}

/* A square that is pinned at its corners. */
static kiriSheet AddPinnedSquare(Host* host, float z, kiriPin pins[4])
{
    kiriSheetDef def = SquareDef(0.0f, 0.0f, z);
    def.material.airDamping = 5.0f;
    kiriSheet sheet = AddSquare(host, &def);
    for (int k = 0; k < 4; ++k) {
        float u = 0.2f * (float)(k % 2), v = 0.2f * (float)(k / 2);
        pins[k] = Host_Pin(host, sheet, u, v, u, v, z);
    }
    return sheet;
}

/* A sheet that fell asleep untouched is met by another: from below, so that it is the upper one, or from above. A tick
   that is refused on the way changes nothing. */
TEST(SleeperIsMet)
{
    for (int way = 0; way < 4; ++way) {
        const float z = way % 2 == 0 ? -0.3f : 0.3f;
        kiriPin pins[4], moved[4];
        START_HOST(host);
        host.every = 30;
        kiriSheet sleeper = AddPinnedSquare(&host, 0.0f, pins);
        if (way < 2) {
            AddPinnedSquare(&host, z, moved);
        }
        for (int i = 0; i < 600 && World_IsAwake(host.world, sleeper); ++i) {
            OK(Host_Tick(&host, dt, 2));
        }
        assert_false(World_IsAwake(host.world, sleeper));
        if (way >= 2) {
            AddPinnedSquare(&host, z, moved); /* it was alone so far */
        }
        for (int tick = 0; tick < 60 && !World_IsAwake(host.world, sleeper); ++tick) {
            for (int k = 0; k < 4; ++k) {
                float height = z * (1.0f - (float)tick / 30.0f);
                float target[3] = { 0.2f * (float)(k % 2), 0.2f * (float)(k / 2), height };
                OK(kiriPin_SetTarget(host.world, moved[k], target));
            }
            uint64_t before = Host_Hash(&host);
            host.failOnce = true;
            host.failAt = host.calls;
            if (Host_Tick(&host, dt, 2) == KIRI_ERROR_MEMORY) {
                assert_true(Host_Hash(&host) == before);
                OK(Host_Tick(&host, dt, 2));
            }
            host.failAt = -1;
        }
        assert_true(World_IsAwake(host.world, sleeper));
        Host_Ticks(&host, 30, dt, 2);
    }
}

TEST(GroupsApart)
{
    START_HOST(host);
    kiriSheetDef def = SquareDef(0.0f, 0.0f, 0.0f);
    def.groups = 1;
    AddSquare(&host, &def);
    def = SquareDef(0.05f, 0.0f, 0.003f);
    def.groups = 2;
    AddSquare(&host, &def);
    OK(Host_Tick(&host, 1.0f / 60.0f, 2));
    assert_int_equal(Pairs(&host), 0);
}

enum { PILE = 4 };

/* Squares above a floor, one above the other, each a little beside the one below and turned. */
static void StartPile(Host* host, kiriSheet sheets[PILE])
{
    Host_Start(host);
    host->every = 30;
    World_AddFloor(host->world);
    for (int i = 0; i < PILE; ++i) {
        const double turn = 0.1 * i, c = 1.0 / sqrt(1.0 + turn * turn), s = turn * c;
        kiriSheetDef def = SquareDef(0.01f * (float)i, 0.005f * (float)i, 0.02f * (float)(i + 1));
        def.axisU[0] = def.axisV[1] = (float)c;
        def.axisU[1] = (float)s;
        def.axisV[0] = (float)-s;
        sheets[i] = AddSquare(host, &def);
    }
}

static void TickUntilAsleep(Host* host, const kiriSheet* sheets, int count, int most)
{
    int ticks = 0;
    do {
        OK(Host_Tick(host, dt, 2));
        assert_int_equal(Crossing_Measure(host->world, sheets, count).crossing, 0);
    } while (World_CountAwake(host->world, sheets, count) > 0 && ++ticks < most);
    assert_true(ticks < most);
}

TEST(PileRestsInOrder)
{
    HOST(host);
    kiriSheet sheets[PILE];
    StartPile(&host, sheets);
    TickUntilAsleep(&host, sheets, PILE, 300);
    double below = 0.0;
    for (int i = 0; i < PILE; ++i) {
        double height = Host_Totals(&host, sheets[i]).center[2], gap = i == 0 ? 0.002 : 0.004;
        assert_true(height - below > 0.9 * gap && height - below < 1.1 * gap);
        below = height;
    }
    OK(Host_Tick(&host, dt, 2));
    assert_int_equal(Pairs(&host), 0);
}

/* In a high pile the lower sheets are stopped in the tick in which those above still fall. */
TEST(HighPileRests)
{
    enum { HIGH = 16 };
    kiriSheet sheets[HIGH];
    START_HOST(host);
    host.every = 30;
    World_AddFloor(host.world);
    for (int i = 0; i < HIGH; ++i) {
        kiriSheetDef def = SquareDef(0.002f * (float)i, 0.0f, 0.02f * (float)(i + 1));
        sheets[i] = AddSquare(&host, &def);
    }
    TickUntilAsleep(&host, sheets, HIGH, 120);
}

/* At rest the pushes of the last step are right: the first system of a step changes nothing, and is the last. */
TEST(PileAtRestTakesOneSystem)
{
    HOST(host);
    kiriSheet sheets[PILE];
    int32_t substeps = 2;
    StartPile(&host, sheets);
    for (int i = 0; i < PILE; ++i) {
        kiriSheetSettings settings = World_Settings(host.world, sheets[i]);
        settings.sleepSpeed = 0.0f;
        OK(kiriSheet_SetSettings(host.world, sheets[i], &settings));
    }
    Host_Ticks(&host, 240, dt, substeps);
    assert_int_equal(World_Profile(host.world).systemsSolved, substeps);
}

TEST(WhatTouchesWakesAndFallsAsleepTogether)
{
    HOST(host);
    kiriSheet sheets[PILE];
    StartPile(&host, sheets);
    TickUntilAsleep(&host, sheets, PILE, 300);
    OK(kiriSheet_Wake(host.world, sheets[0]));
    Host_Ticks(&host, PILE, dt, 2);
    assert_int_equal(World_CountAwake(host.world, sheets, PILE), PILE);
    TickUntilAsleep(&host, sheets, PILE, 300);
    /* What lay on a sheet that is gone falls. */
    double height = Host_Totals(&host, sheets[1]).center[2];
    OK(kiriDestroySheet(host.world, sheets[0]));
    Host_Ticks(&host, 20, dt, 2);
    assert_true(Host_Totals(&host, sheets[1]).center[2] < height - 0.003);
}

/* A heavy square falls into a cloth that hangs by its four corners. */
static double Sag(bool isLoaded)
{
    START_HOST(host);
    host.every = 30;
    kiriSheetDef def = SheetOf(16, 9);
    def.touchesSheets = 1;
    def.material.airDamping = 2.0f;
    def.contactThickness = 0.004f;
    kiriSheet cloth = Host_AddRectangle(&host, &def, 0.4f, 0.4f, 16, 16);
    for (int k = 0; k < 4; ++k) {
        float u = k % 2 == 0 ? 0.0f : 0.4f, v = k < 2 ? 0.0f : 0.4f;
        Host_Pin(&host, cloth, u, v, u, v, 0.0f);
    }
    if (isLoaded) {
        def.position[0] = def.position[1] = 0.15f;
        def.position[2] = 0.02f;
        def.material.density *= 20.0f;
        def.frameCount = def.maxFrames = 1;
        Host_AddRectangle(&host, &def, 0.1f, 0.1f, 8, 8);
    }
    Host_Ticks(&host, 240, dt, 2);
    return -Host_Totals(&host, cloth).center[2];
}

TEST(LowerSheetFeelsTheWeight)
{
    double own = Sag(false), loaded = Sag(true);
    assert_true(own > 0.0 && own < 0.2 && loaded > 1.05 * own && loaded < 0.2);
}

/* Two sheets that fall together do so as one that falls alone. */
TEST(FallingPairFallsFreely)
{
    START_HOST(host);
    kiriSheetDef def = SquareDef(0.0f, 0.0f, 0.0f);
    kiriSheet lower = AddSquare(&host, &def);
    def = SquareDef(0.01f, 0.01f, 0.0045f);
    kiriSheet upper = AddSquare(&host, &def);
    def = SquareDef(2.0f, 0.0f, 0.0045f);
    kiriSheet alone = AddSquare(&host, &def);
    Host_Ticks(&host, 30, dt, 2);
    double fallen = Host_Totals(&host, alone).center[2];
    assert_true(fallen < -1.0);
    assert_true(fabs(Host_Totals(&host, upper).center[2] - fallen) < 0.005);
    assert_true(fabs(Host_Totals(&host, lower).center[2] - (fallen - 0.0045)) < 0.005);
}

/* A square is cut out of a sheet that hangs, and falls clear of it. */
TEST(PieceFallsClear)
{
    static const float square[] = { 0.35f, 0.3f, 0.65f, 0.3f, 0.65f, 0.6f, 0.35f, 0.6f, 0.35f, 0.3f };
    START_HOST(host);
    host.every = 30;
    kiriSheetDef def = DefaultSheet();
    def.frameCount = 9;
    def.touchesSheets = 1;
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 32, 32);
    for (int k = 0; k < 3; ++k) {
        Host_Pin(&host, sheet, 0.5f * (float)k, 1.0f, 0.5f * (float)k, 0.0f, 1.0f);
    }
    OK(Host_Tick(&host, dt, 2));
    Host_Cut(&host, sheet, square, 5);
    for (int tick = 0; tick < 60; ++tick) {
        OK(Host_Tick(&host, dt, 2));
        /* In the first ticks lips that lie beside each other may be behind one another by a few triangles. */
        assert_true(Crossing_Measure(host.world, &sheet, 1).crossing <= (tick < 4 ? 6 : 0));
    }
    kiriPieceState piece = World_PieceState(host.world, sheet, 1);
    assert_true(piece.upper[2] < 0.0f); /* below the sheet's lower edge */
}

/* Lays one half of a cloth over the other, and lets go. Returns the triangles that cross. */
static int32_t FoldOnce(int32_t selfContact, int32_t frames)
{
    kiriPin pins[3];
    START_HOST(host);
    World_AddFloor(host.world);
    kiriSheetDef def = DefaultSheet();
    def.frameCount = frames;
    def.selfContact = selfContact;
    def.contactThickness = 0.004f;
    def.position[2] = 0.005f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 0.6f, 0.6f, 32, 32);
    for (int tick = 0; tick < 150; ++tick) {
        float angle = 3.1f * fminf((float)tick / 90.0f, 1.0f);
        for (int i = 0; i < 3; ++i) {
            const float y = 0.001f + 0.299f * (float)i;
            const float target[3] = { 0.3f + 0.3f * cosf(angle), y, 0.005f + 0.3f * sinf(angle) };
            kiriPinDef pin = Host_PinDef(0.599f, y, target[0], y, target[2]);
            OK(tick == 0 ? kiriCreatePin(host.world, sheet, &pin, &pins[i]) :
               tick < 110 ? kiriPin_SetTarget(host.world, pins[i], target) :
               tick == 110 ? kiriDestroyPin(host.world, pins[i]) : KIRI_OK);
        }
        OK(Host_Tick(&host, dt, 2));
    }
    return Crossing_MeasureSelf(host.world, sheet).crossing;
}

TEST(FoldsStayApart)
{
    assert_true(FoldOnce(0, 36) > 0);
    assert_true(FoldOnce(1, 36) == 0 && FoldOnce(1, 16) == 0);
}

/* The end of a ribbon is pinned to a wheel that turns: it is not drawn through the winding above it. */
TEST(PinsAreNotDrawnThroughLayers)
{
    START_HOST(host);
    host.every = 30;
    kiriObstacleDef wheel = ObstacleOf(KIRI_OBSTACLE_CYLINDER);
    wheel.radius = 0.06f;
    wheel.height = 0.2f;
    memcpy(wheel.rotation, (const float[]){ 1, 0, 0, 0, 0, 1, 0, -1, 0 }, sizeof wheel.rotation);
    kiriSheetDef def = SheetOf(80, 40);
    def.selfContact = 1;
    def.contactThickness = 0.005f;
    Set3(def.position, 0.0f, -0.03f, 0.061f);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.2f, 0.06f, 80, 4);
    kiriPinDef pin = Host_PinDef(0.001f, 0.0f, 0.0f, 0.0f, 0.061f);
    pin.obstacle = World_AddObstacle(host.world, &wheel);
    OK(kiriObstacle_SetVelocity(host.world, pin.obstacle, noVector, (const float[]){ 0.0f, -5.0f, 0.0f }));
    for (int i = 0; i < 3; ++i) {
        pin.restPoint[1] = 0.001f + 0.029f * (float)i;
        pin.target[1] = pin.restPoint[1] - 0.03f;
        OK(kiriCreatePin(host.world, sheet, &pin, &(kiriPin){ 0 }));
    }
    Host_Ticks(&host, 90, dt, 2);
    assert_int_equal(Crossing_MeasureSelf(host.world, sheet).crossing, 0);
}

/* Drags two corners of a cloth through it while slits are cut; `restores`: and restores the world in each tick. */
static uint64_t TangleOnce(bool restores)
{
    kiriPin pins[2];
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.frameCount = 36;
    def.selfContact = 1;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 20, 20);
    for (int tick = 0; tick < 60; ++tick) {
        float way = (float)tick / 30.0f, at = (float)(tick * 7 % 16) / 20.0f;
        for (int i = 0; i < 2; ++i) {
            float x = i == 0 ? way : 1.0f - way, z = (i == 0 ? -0.3f : 0.3f) * sinf(3.0f * way);
            kiriPinDef pin = Host_PinDef((float)i, (float)i, x, 0.1f * (float)i + 0.9f * x, z);
            OK(tick == 0 ? kiriCreatePin(host.world, sheet, &pin, &pins[i]) :
               kiriPin_SetTarget(host.world, pins[i], pin.target));
        }
        if (tick % 5 == 3) {
            Host_Cut(&host, sheet, (const float[]){ at, 0.8f - at, at + 0.2f, 0.9f - at }, 2);
        }
        if (restores) {
            World_Copy(host.world, host.world, kiriWorld_Snapshot);
        }
        OK(Host_Tick(&host, dt, 1));
    }
    return Host_Hash(&host);
}

TEST(TanglesGoOnAfterARestore)
{
    assert_true(TangleOnce(true) == TangleOnce(false));
}

TEST(PlainTicksAllocateNothing)
{
    HOST(host);
    kiriSheet sheets[PILE];
    StartPile(&host, sheets);
    TickUntilAsleep(&host, sheets, PILE, 300);
    OK(kiriSheet_Wake(host.world, sheets[0]));
    Host_Ticks(&host, 10, dt, 2);
    assert_true(Pairs(&host) >= PILE - 1);
    int64_t calls = host.calls;
    Host_Ticks(&host, 10, dt, 2);
    assert_true(host.calls == calls);
}

/* A tick that is refused leaves the world as it was, and the next ones go on as if nothing had been. */
TEST(RefusedTicksChangeNothing)
{
    enum { TICKS = 6 };
    uint64_t expected = 0;
    for (int64_t fail = -1; fail < 40; ++fail) {
        HOST(host);
        kiriSheet sheets[PILE];
        StartPile(&host, sheets);
        int64_t first = host.calls;
        for (int tick = 0; tick < TICKS; ++tick) {
            host.failAt = fail < 0 ? -1 : first + fail;
            host.failOnce = true;
            uint64_t before = Host_Hash(&host);
            if (Host_Tick(&host, dt, 2) == KIRI_ERROR_MEMORY) {
                assert_true(Host_Hash(&host) == before);
                OK(Host_Tick(&host, dt, 2));
            }
        }
        host.failAt = -1;
        expected = fail < 0 ? Host_Hash(&host) : expected;
        assert_true(Host_Hash(&host) == expected);
    }
}
