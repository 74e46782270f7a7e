#include "extremes.h"
#include "host.h"

/* ---- The table --------------------------------------------------------------------------------------------------- */

static void AssertWell(const Extreme* e)
{
    Outcome o = Extreme_Run(e);
    if (o.failed != NULL || !o.finite) {
        fail_msg("%s: %s", e->name, o.failed != NULL ? o.failed : "not finite");
    }
    if (o.gain > Extreme_Gain(e)) {
        fail_msg("%s: gains %g in tick %d", e->name, o.gain, o.gainTick);
    }
    if (o.recovered < 0 && Extreme_Calm(e) < 1.0) {
        fail_msg("%s: has %g of its elastic energy left", e->name, o.elastic);
    }
}

FIGURE(Table)
{
    for (int i = 0; i < extremeCount; ++i) {
        if (!extremes[i].full) {
            AssertWell(&extremes[i]);
        }
    }
}

TEST(AtRandom)
{
    uint32_t seed = 98765;
    for (int i = 0; i < RUNS(40); ++i) {
        Extreme e = Extreme_Random(&seed);
        AssertWell(&e);
    }
}

/* ---- What cannot be continued ------------------------------------------------------------------------------------ */

typedef struct State {
    float positions[3 * 256], normals[3 * 256];
    kiriFrameState frames[8];
    int32_t vertexCount, frameCount;
} State;

static State Read(const Host* host, kiriSheet sheet)
{
    State s;
    kiriFrame ids[8];
    kiriMesh mesh = Host_Mesh(host, sheet);
    memset(&s, 0, sizeof(s));
    s.vertexCount = mesh.vertexCount;
    assert_true(mesh.vertexCount <= 256);
    memcpy(s.positions, mesh.positions, 3 * sizeof(float) * (size_t)mesh.vertexCount);
    memcpy(s.normals, mesh.normals, 3 * sizeof(float) * (size_t)mesh.vertexCount);
    OK(kiriSheet_GetFrames(host->world, sheet, ids, 8, &s.frameCount));
    for (int32_t i = 0; i < s.frameCount; ++i) {
        OK(kiriFrame_GetState(host->world, ids[i], &s.frames[i]));
    }
    return s;
}

static kiriSheet AddSheet(Host* host, float z)
{
    kiriSheetDef def = Host_SmallDef();
    def.position[2] = z;
    return Host_AddRectangle(host, &def, 1.0f, 1.0f, 8, 8);
}

static kiriFrame FirstFrame(const Host* host, kiriSheet sheet)
{
    kiriFrame frames[8];
    World_GetFrames(host->world, sheet, frames, 8);
    return frames[0];
}

static void Push(Host* host, kiriSheet sheet, float force)
{
    const float forces[3] = { force, 0.0f, force }, torque[3] = { 0.0f, force, 0.0f };
    OK(kiriFrame_ApplyForce(host->world, FirstFrame(host, sheet), forces, torque));
}

static void AssertDiverged(Host* host, kiriSheet bad)
{
    kiriEvent event;
    assert_int_equal(Host_Tick(host, 1.0f / 60.0f, 1), KIRI_DIVERGED);
    assert_non_null(strstr(kiriWorld_GetLastError(host->world), "put to rest"));
    assert_int_equal(Host_Events(host, KIRI_EVENT_DIVERGED, &event), 1);
    assert_int_equal(event.sheet, bad);
}

static void AssertAtRest(const State* now, const State* before)
{
    assert_memory_equal(now->positions, before->positions, sizeof(now->positions));
    for (int32_t i = 0; i < now->frameCount; ++i) {
        for (int k = 0; k < 3; ++k) {
            assert_true(now->frames[i].velocity[k] == 0.0f && now->frames[i].angularVelocity[k] == 0.0f);
        }
    }
}

/* Of three sheets the middle one is pushed beyond what floats hold. It rests where it was, and falls on afterwards as
   one that was let go there. The others do not notice. */
TEST(OneDiverges)
{
    Host host, other;
    Host_Start(&host);
    Host_Start(&other);
    kiriSheet first = AddSheet(&host, 0.0f), bad = AddSheet(&host, 5.0f), last = AddSheet(&host, 9.0f);
    kiriSheet twins[2] = { AddSheet(&other, 0.0f), AddSheet(&other, 9.0f) };
    for (int tick = 0; tick < 10; ++tick) {
        State before = Read(&host, bad), now;
        OK(Host_Tick(&other, 1.0f / 60.0f, 1));
        if (tick == 4) {
            Push(&host, bad, 3e38f);
            AssertDiverged(&host, bad);
            now = Read(&host, bad);
            AssertAtRest(&now, &before);
        } else {
            OK(Host_Tick(&host, 1.0f / 60.0f, 1));
            assert_int_equal(Host_Events(&host, KIRI_EVENT_DIVERGED, NULL), 0);
        }
        if (tick > 4) {
            kiriTotals totals = Host_Totals(&host, bad);
            double fallen = totals.momentum[2] / totals.mass + 9.81 * (tick - 4) / 60.0;
            assert_true(fallen > -1e-5 && fallen < 0.05 * 9.81 * (tick - 4) / 60.0); /* the air brakes */
        }
        now = Read(&host, first);
        before = Read(&other, twins[0]);
        assert_memory_equal(&now, &before, sizeof(now));
        now = Read(&host, last);
        before = Read(&other, twins[1]);
        assert_memory_equal(&now, &before, sizeof(now));
    }
    Host_Stop(&host);
    Host_Stop(&other);
}

/* Forces that are just within reach fling the sheet to where floats end; until then all that is read is finite. */
TEST(ForcesUpTo)
{
    START_HOST(host);
    kiriSheet sheet = AddSheet(&host, 0.0f);
    int diverged = 0;
    for (int tick = 0; tick < 120; ++tick) {
        float force = 1.0f;
        for (int k = 0; k < tick % 40; ++k) {
            force *= 10.0f;
        }
        if (tick % 40 < 39) {
            Push(&host, sheet, tick < 80 ? force : -force);
        }
        kiriResult result = Host_Tick(&host, tick < 40 ? 1e-6f : tick < 80 ? 1.0f / 60.0f : 10.0f, 1);
        assert_true(result == KIRI_OK || result == KIRI_DIVERGED);
        diverged += result == KIRI_DIVERGED;
        State now = Read(&host, sheet);
        assert_true(AllFinite(now.positions, 3 * now.vertexCount) && AllFinite(now.normals, 3 * now.vertexCount));
        for (int32_t i = 0; i < now.frameCount; ++i) {
            assert_true(AllFinite(now.frames[i].position, 3) && AllFinite(now.frames[i].rotation, 9));
            assert_true(AllFinite(now.frames[i].velocity, 3) && AllFinite(now.frames[i].angularVelocity, 3));
        }
    }
    assert_true(diverged > 0 && diverged < 20);
}

/* A ball that spins rubs the sheet along. Frames that may stretch are torn; a smooth surface takes squares of that. */
TEST(SpinsUpTo)
{
    int diverged = 0;
    for (int k = 0; k < 38; ++k) {
        START_HOST(host);
        kiriSheetDef def = Host_SmallDef();
        def.model = KIRI_MODEL_AFFINE;
        def.skinning = KIRI_SKINNING_SMOOTH;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
        kiriObstacleDef ball = ObstacleOf(KIRI_OBSTACLE_SPHERE);
        ball.radius = 0.5f;
        ball.position[0] = ball.position[1] = 0.3f;
        ball.position[2] = -0.4f;
        ball.angularVelocity[0] = powf(10.0f, (float)k);
        World_AddObstacle(host.world, &ball);
        for (int tick = 0; tick < 8; ++tick) {
            kiriResult result = Host_Tick(&host, 1.0f / 60.0f, 1);
            assert_true(result == KIRI_OK || result == KIRI_DIVERGED);
            diverged += result == KIRI_DIVERGED;
            State now = Read(&host, sheet);
            assert_true(AllFinite(now.positions, 3 * now.vertexCount) && AllFinite(now.normals, 3 * now.vertexCount));
        }
    }
    assert_in_range(diverged, 1, 150);
}

/* A frame that is held where no float reaches: every tick says so, and the sheet goes on when it is let go. */
TEST(HeldOutOfReach)
{
    const float far[3] = { 3e38f, -3e38f, 3e38f }, rotation[9] = { 1, 0, 0, 0, 1, 0, 0, 0, 1 };
    START_HOST(host);
    kiriSheet sheet = AddSheet(&host, 0.0f);
    State before = Read(&host, sheet);
    OK(kiriFrame_Hold(host.world, FirstFrame(&host, sheet), far, rotation));
    for (int tick = 0; tick < 3; ++tick) {
        AssertDiverged(&host, sheet);
        State now = Read(&host, sheet);
        AssertAtRest(&now, &before);
    }
    OK(kiriFrame_Hold(host.world, FirstFrame(&host, sheet), NULL, NULL));
    OK(Host_Tick(&host, 1.0f / 60.0f, 1));
    assert_true(Host_Totals(&host, sheet).momentum[2] < 0.0);
}

/* ---- Far from the origin ----------------------------------------------------------------------------------------- */

/* Positions are read as floats, 0.0078 m apart; normals are not made of those. */
TEST(NormalsFarAway)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    def.position[0] = def.position[1] = def.position[2] = 1e5f;
    def.axisU[0] = 0.6f;
    def.axisU[2] = 0.8f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 40, 40);
    OK(Host_Tick(&host, 1.0f / 60.0f, 1));
    kiriMesh mesh = Host_Mesh(&host, sheet);
    for (int32_t v = 0; v < mesh.vertexCount; ++v) {
        assert_true(fabs(mesh.normals[3 * v] + 0.8) < 1e-5 && fabs(mesh.normals[3 * v + 2] - 0.6) < 1e-5);
    }
}
