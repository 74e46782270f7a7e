/* The mechanical models as a host sees them: every one is cut, held, pinned, touched, and counts its energy. */
#include "host.h"

typedef struct Choice {
    int32_t model, planar, points, order;
} Choice;

static const Choice choices[] = {
    { KIRI_MODEL_LINKS, 0, 0, 1 },  { KIRI_MODEL_LINKS, 1, 0, 1 },   { KIRI_MODEL_AFFINE, 0, 0, 1 },
    { KIRI_MODEL_AFFINE, 1, 0, 1 }, { KIRI_MODEL_POINTS, 0, 12, 1 }, { KIRI_MODEL_POINTS, 0, 0, 2 },
    { KIRI_MODEL_POINTS, 1, 9, 2 },
};
enum { CHOICES = sizeof(choices) / sizeof(choices[0]) };

static kiriSheetDef DefOf(const Choice* choice)
{
    kiriSheetDef def = Host_SmallDef();
    def.model = choice->model;
    def.planar = choice->planar;
    def.paper.integrationPoints = choice->points;
    def.paper.integrationOrder = choice->order;
    def.material.youngsModulus = 2e4f;
    return def;
}

static void SetGravity(Host* host, float x, float y, float z)
{
    const float gravity[3] = { x, y, z };
    OK(kiriWorld_SetGravity(host->world, gravity));
}

static kiriFrameState StateOf(const Host* host, kiriSheet sheet, int index)
{
    kiriFrame frames[64];
    int32_t count = World_GetFrames(host->world, sheet, frames, 64);
    assert_true(index < count);
    return World_FrameState(host->world, frames[index]);
}

static kiriFrame FrameOf(const Host* host, kiriSheet sheet, int index)
{
    kiriFrame frames[64];
    World_GetFrames(host->world, sheet, frames, 64);
    return frames[index];
}

/* ---- Cutting ---- */

/* Hung at two corners in a slanted field, cut in two, and on: the part that comes off falls. */
static uint64_t CutInTwo(const Choice* choice, float* fallen)
{
    static const float line[4] = { -0.1f, 0.52f, 1.1f, 0.49f };
    static const float at[2][2] = { { 0.0f, 1.0f }, { 1.0f, 1.0f } };
    kiriSheetDef def = DefOf(choice);
    START_HOST(host);
    SetGravity(&host, 0.5f, -9.81f, choice->planar ? 0.0f : 1.0f);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
    for (int k = 0; k < 2; ++k) {
        Host_Pin(&host, sheet, at[k][0], at[k][1], at[k][0], at[k][1], 0.0f);
    }
    for (int n = 0; n < 60; ++n) {
        if (n == 20) {
            Host_Cut(&host, sheet, line, 2);
        }
        OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 2));
        assert_int_equal(Host_Events(&host, KIRI_EVENT_PIECE_OFF, NULL), n == 20);
        kiriMesh mesh = Host_Mesh(&host, sheet);
        assert_true(AllFinite(mesh.positions, 3 * (int64_t)mesh.vertexCount));
    }
    kiriMesh mesh = Host_Mesh(&host, sheet);
    *fallen = 0.0f;
    for (int32_t v = 0; v < mesh.vertexCount; ++v) {
        float drop = mesh.restPositions[2 * v + 1] - mesh.positions[3 * v + 1];
        *fallen = drop > *fallen ? drop : *fallen;
        assert_true(!choice->planar || fabsf(mesh.positions[3 * v + 2]) < 1e-6f);
    }
    uint64_t hash = Host_Hash(&host);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    return hash;
}

TEST(CutsAllModels)
{
    uint64_t hashes[CHOICES];
    for (int k = 0; k < CHOICES; ++k) {
        float first, second;
        hashes[k] = CutInTwo(&choices[k], &first);
        assert_true(CutInTwo(&choices[k], &second) == hashes[k]); /* same calls, same bits */
        assert_true(first == second && first > 1.0f);             /* 40 ticks of free fall are 2 m */
        for (int n = 0; n < k; ++n) {
            assert_true(hashes[n] != hashes[k]);
        }
    }
}

static double LengthOf(const float* column)
{
    return sqrt((double)column[0] * column[0] + (double)column[1] * column[1] + (double)column[2] * column[2]);
}

/* A piece is cut out of a sheet that hangs and is stretched: its new frame goes on with the stretch. */
TEST(NewFramesAreStretched)
{
    static const float loop[10] = { 0.62f, 0.62f, 0.71f, 0.63f, 0.7f, 0.72f, 0.61f, 0.71f, 0.62f, 0.62f };
    Choice choice = { KIRI_MODEL_AFFINE, 0, 0, 1 };
    kiriSheetDef def = DefOf(&choice);
    START_HOST(host);
    SetGravity(&host, 0.0f, -9.81f, 0.0f);
    def.material.airDamping = 5.0f;
    def.framePoints = NULL;
    def.frameCount = def.maxFrames = 12;
    def.gridResolution = 32;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    for (int k = 0; k < 5; ++k) {
        Host_Pin(&host, sheet, 0.25f * k, 1.0f, 0.25f * k, 1.0f, 0.0f);
    }
    World_Ticks(host.world, 200, 0.02f, 1);
    int32_t frames = Host_Counts(&host, sheet).frames;
    Host_Cut(&host, sheet, loop, 5);
    OK(kiriWorld_Tick(host.world, 1e-5f, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    assert_int_equal(Host_Counts(&host, sheet).frames, frames + 1);
    kiriFrameState fresh = StateOf(&host, sheet, frames);
    print_message("the new frame is %.3f long in v, %.3f in u\n", LengthOf(&fresh.rotation[3]),
                  LengthOf(&fresh.rotation[0]));
    assert_true(LengthOf(&fresh.rotation[3]) > 1.05 && LengthOf(&fresh.rotation[3]) < 1.3);
    assert_true(LengthOf(&fresh.rotation[0]) > 0.85 && LengthOf(&fresh.rotation[0]) < 1.02);
}

/* ---- Totals ---- */

/* A free sheet keeps its momentum, and energy only falls. */
TEST(TotalsHold)
{
    for (int k = 0; k < CHOICES; ++k) {
        kiriSheetDef def = DefOf(&choices[k]);
        START_HOST(host);
        SetGravity(&host, 0.0f, 0.0f, 0.0f);
        def.velocity[0] = 1.0f;
        def.material.airDamping = def.material.flexDamping = 0.0f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
        const float force[3] = { 0.5f, 1.0f, choices[k].planar ? 0.0f : 0.7f };
        const float torque[3] = { 0.0f, 0.0f, 0.02f };
        OK(kiriFrame_ApplyForce(host.world, FrameOf(&host, sheet, 0), force, torque));
        OK(kiriWorld_Tick(host.world, 0.01f, 1));
        kiriTotals before = Host_Totals(&host, sheet);
        double mass = 400.0 * 5e-4;
        assert_true(fabs(before.mass - mass) < 1e-6 * mass);
        assert_true(fabs(before.momentum[1] - 0.01) < 1e-8);
        assert_true(before.elasticEnergy > 0.0);
        for (int n = 0; n < 30; ++n) {
            OK(kiriWorld_Tick(host.world, 0.01f, 1));
            kiriTotals after = Host_Totals(&host, sheet);
            for (int a = 0; a < 3; ++a) {
                assert_true(fabs(after.momentum[a] - before.momentum[a]) < 1e-9 * mass);
                /* The torque arrives in two steps of second order. */
                assert_true(n < 2 || fabs(after.angularMomentum[a] - before.angularMomentum[a]) < 1e-12 * mass);
            }
            assert_true(after.kineticEnergy + after.elasticEnergy <
                        (before.kineticEnergy + before.elasticEnergy) * (1.0 + 1e-4));
            before = after;
        }
    }
}

/* ---- Planes ---- */

/* A sheet whose axes are slanted, with forces across its plane and a hold off it, stays in its plane. */
TEST(PlanarSheetsStayInTheirPlane)
{
    for (int k = 0; k < CHOICES; ++k) {
        uint32_t seed = 31;
        kiriSheetDef def = DefOf(&choices[k]);
        const float u[3] = { 0.6f, 0.0f, 0.8f }, v[3] = { 0.0f, 1.0f, 0.0f }, across[3] = { -0.8f, 0.0f, 0.6f };
        START_HOST(host);
        def.planar = 1;
        memcpy(def.axisU, u, sizeof(u));
        memcpy(def.axisV, v, sizeof(v));
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
        kiriFrameState held = StateOf(&host, sheet, 0);
        for (int a = 0; a < 3; ++a) {
            held.position[a] += 0.1f * across[a];
        }
        OK(kiriFrame_Hold(host.world, FrameOf(&host, sheet, 0), held.position, held.rotation));
        for (int tick = 0; tick < 60; ++tick) {
            for (int i = 0; i < 4; ++i) {
                float force[3], torque[3];
                for (int a = 0; a < 3; ++a) {
                    force[a] = (float)RandomBetween(&seed, -0.1, 0.1);
                    torque[a] = (float)RandomBetween(&seed, -1e-3, 1e-3);
                }
                OK(kiriFrame_ApplyForce(host.world, FrameOf(&host, sheet, i), force, torque));
            }
            OK(Host_Tick(&host, 0.01f, 2));
        }
        kiriMesh mesh = Host_Mesh(&host, sheet);
        double way = 0.0;
        for (int32_t n = 0; n < mesh.vertexCount; ++n) {
            const float *x = mesh.positions + 3 * n, *rest = mesh.restPositions + 2 * n;
            assert_true(fabs((double)across[0] * x[0] + (double)across[2] * x[2]) < 1e-6);
            way = fmax(way, fabs((double)x[1] - rest[1]));
        }
        assert_true(way > 1e-3);
    }
}

/* In its plane a sheet moves alike with and without motion across it. */
TEST(PlanarEqualsSpace)
{
    for (int k = 0; k < CHOICES; ++k) {
        kiriFrameState states[2];
        for (int planar = 0; planar < 2; ++planar) {
            Choice choice = choices[k];
            choice.planar = planar;
            kiriSheetDef def = DefOf(&choice);
            START_HOST(host);
            SetGravity(&host, 0.4f, -0.2f, 0.0f);
            kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
            kiriFrameState held = StateOf(&host, sheet, 0);
            OK(kiriFrame_Hold(host.world, FrameOf(&host, sheet, 0), held.position, held.rotation));
            Host_Ticks(&host, 60, 0.01f, 2);
            states[planar] = StateOf(&host, sheet, 3);
            assert_true(fabs((double)states[planar].position[0] - states[planar].restPoint[0]) > 1e-4);
        }
        for (int a = 0; a < 3; ++a) {
            assert_float_equal(states[0].position[a], states[1].position[a], 2e-7);
            assert_float_equal(states[0].velocity[a], states[1].velocity[a], 2e-6);
        }
    }
}

/* A strip that spins about its normal stays in its plane, however slender it is and however far it turns in a tick. */
TEST(SpinsStayFlat)
{
    for (int k = 0; k < 8; ++k) {
        float size = k / 4 == 0 ? 90.0f : 900.0f, spin[3] = { -0.8f * size, 0.0f, 0.6f * size };
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        def.planar = k % 2;
        def.frameCount = 1;
        def.axisU[0] = 0.6f;
        def.axisU[2] = 0.8f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, k / 2 % 2 == 0 ? 0.1f : 0.03f, 8, 2);
        OK(kiriSheet_SetVelocity(host.world, sheet, (float[3]){ 0.0f, 0.0f, 0.0f }, spin));
        Host_Ticks(&host, 60, 0.01f, 1);
        kiriFrameState state = StateOf(&host, sheet, 0);
        assert_true(fabs(state.rotation[6] + 0.8) + fabs(state.rotation[8] - 0.6) < 1e-5);
    }
}

/* A sheet that is pulled at one end, and was not quite flat, becomes flat: tension does not make it buckle. */
TEST(TensionDoesNotBuckle)
{
    for (int k = 0; k < CHOICES; ++k) {
        static const float pull[3] = { 4.0f, 0.0f, 0.0f }, push[3] = { 0.0f, 0.0f, 1e-3f };
        kiriSheetDef def = DefOf(&choices[k]);
        START_HOST(host);
        host.every = 30;
        SetGravity(&host, 0.0f, 0.0f, 0.0f);
        def.material.youngsModulus = 1e6f;
        def.material.airDamping = 5.0f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
        for (int i = 0; i < 4; i += 2) {
            kiriFrameState held = StateOf(&host, sheet, i);
            OK(kiriFrame_Hold(host.world, FrameOf(&host, sheet, i), held.position, held.rotation));
        }
        for (int tick = 0; tick < 300; ++tick) {
            OK(kiriSheet_ApplyLineLoad(host.world, sheet, (float[]){ 1.0f, 0.0f }, (float[]){ 1.0f, 1.0f }, pull));
            if (tick < 10) {
                OK(kiriFrame_ApplyForce(host.world, FrameOf(&host, sheet, 1), push, (float[]){ 0.0f, 0.0f, 0.0f }));
            }
            OK(Host_Tick(&host, 1.0f / 60.0f, 1));
        }
        kiriMesh mesh = Host_Mesh(&host, sheet);
        for (int32_t n = 0; n < mesh.vertexCount; ++n) {
            assert_true(fabsf(mesh.positions[3 * n + 2]) < 1e-4f && mesh.positions[3 * n] < 1.2f);
        }
    }
}

/* ---- Memory ---- */

/* A tick without a cut allocates nothing; a cut survives every refusal. */
TEST(MemoryIsKept)
{
    static const float line[4] = { -0.2f, 0.45f, 1.2f, 0.55f };
    for (int k = 0; k < CHOICES; ++k) {
        kiriSheetDef def = DefOf(&choices[k]);
        SCOPED_AS(Rectangle, rectangle, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 3, 3);
        kiriSheet sheet = 0;
        kiriResult result = KIRI_ERROR_MEMORY;
        START_HOST(host);
        for (int n = 0; result != KIRI_OK; ++n) {
            host.calls = 0;
            host.failAt = n;
            result = kiriCreateSheet(host.world, &def, &sheet);
            assert_true(result == KIRI_OK || result == KIRI_ERROR_MEMORY);
        }
        host.failAt = -1;
        OK(kiriWorld_Tick(host.world, 0.01f, 1));
        host.calls = 0;
        OK(kiriWorld_Tick(host.world, 0.01f, 3));
        assert_int_equal(host.calls, 0);
        Host_Cut(&host, sheet, line, 2);
        result = KIRI_ERROR_MEMORY;
        for (int n = 0; result != KIRI_OK; ++n) {
            host.calls = 0;
            host.failAt = n;
            result = kiriWorld_Tick(host.world, 0.01f, 1);
            assert_true(result == KIRI_OK || result == KIRI_ERROR_MEMORY);
        }
        host.failAt = -1;
        assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    }
}

/* ---- Arguments ---- */

static kiriResult TryDef(Host* host, int32_t model, int32_t planar, int32_t points, int32_t order)
{
    Choice choice = { model, planar, points, order };
    kiriSheetDef def = DefOf(&choice);
    kiriSheet sheet;
    return Host_TryRectangle(host, &def, 1.0f, 1.0f, 3, 3, &sheet);
}

TEST(ArgumentsAreChecked)
{
    static const float out[9] = { 0.8f, 0.0f, 0.6f, 0.0f, 1.0f, 0.0f, -0.6f, 0.0f, 0.8f };
    static const float turned[9] = { 0.8f, 0.6f, 0.0f, -0.6f, 0.8f, 0.0f, 0.0f, 0.0f, 1.0f },
                       at[3] = { 0.2f, 0.2f, 0.3f };
    Choice planar = { KIRI_MODEL_AFFINE, 1, 0, 1 };
    kiriSheetDef def = DefOf(&planar);
    START_HOST(host);
    assert_int_equal(TryDef(&host, -1, 0, 0, 1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(TryDef(&host, 3, 0, 0, 1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(TryDef(&host, 0, 2, 0, 1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(TryDef(&host, 2, 0, -1, 1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(TryDef(&host, 2, 0, 0, 3), KIRI_ERROR_ARGUMENT);
    assert_int_equal(TryDef(&host, 2, 0, 0, 0), KIRI_ERROR_ARGUMENT);
    assert_int_equal(TryDef(&host, 2, 1, 5, 2), KIRI_OK);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 3, 3);
    kiriFrame frame = FrameOf(&host, sheet, 0);
    assert_int_equal(kiriFrame_Hold(host.world, frame, at, out), KIRI_ERROR_ARGUMENT);
    OK(kiriFrame_Hold(host.world, frame, at, turned));
    OK(kiriWorld_Tick(host.world, 0.01f, 1));
    kiriFrameState now = StateOf(&host, sheet, 0);
    assert_true(fabsf(now.position[0] - 0.2f) < 1e-6f && fabsf(now.position[2]) < 1e-6f);
    assert_true(fabsf(now.rotation[1] - 0.6f) < 1e-6f && now.held == 1);
}
