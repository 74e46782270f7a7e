/* What a host expects beside cuts and contact: settings, points, impulses, wind, pins, velocities, data, and solids to
   draw. */
#include "host.h"

#define DT (1.0f / 60.0f)

/* ---- Settings ---------------------------------------------------------------------------------------------------- */

static kiriSheet Hang(Host* host, kiriSheetDef* def)
{
    kiriSheet sheet = Host_AddRectangle(host, def, 1.0f, 1.0f, 4, 4);
    Host_Pin(host, sheet, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f);
    return sheet;
}

/* Points near a held frame are drawn on the skin, unlike points near a pin. */
static kiriSheet HangByFrame(Host* host, kiriSheetDef* def)
{
    kiriSheet sheet = Host_AddRectangle(host, def, 1.0f, 1.0f, 4, 4);
    kiriFrame frame = World_PointState(host->world, sheet, (const float[]){ 0.05f, 0.95f }).frame;
    kiriFrameState state = World_FrameState(host->world, frame);
    OK(kiriFrame_Hold(host->world, frame, state.position, state.rotation));
    return sheet;
}

/* Each of them as a def would have it, before the first tick: then the runs are the same. */
TEST(SettingsAreADefs)
{
    uint64_t hash[2];
    for (int way = 0; way < 2; ++way) {
        kiriSheetDef def = Host_SmallDef(), other = def;
        const float line[4] = { -0.1f, 0.43f, 0.7f, 0.51f };
        START_HOST(host);
        OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &other.material)); /* with Poisson's ratio, which cotton has not */
        other.timeStepping = KIRI_TIME_STEPPING_EULER;
        other.skinning = KIRI_SKINNING_SMOOTH;
        other.iterations = 4;
        other.fadeTime = 0.0f;
        other.sleepSpeed = 0.0f;
        other.friction = 0.1f;
        other.groups = 1;
        other.crumbArea = 0.01f;
        other.maxFrames = 7;
        other.normals = 0;
        kiriSheet sheet = Host_AddRectangle(&host, way == 0 ? &other : &def, 1.0f, 1.0f, 4, 4);
        kiriSheetSettings settings = World_Settings(host.world, sheet);
        settings.material = other.material;
        settings.timeStepping = other.timeStepping;
        settings.skinning = other.skinning;
        settings.iterations = other.iterations;
        settings.fadeTime = other.fadeTime;
        settings.sleepSpeed = other.sleepSpeed;
        settings.friction = other.friction;
        settings.groups = other.groups;
        settings.crumbArea = other.crumbArea;
        settings.maxFrames = other.maxFrames;
        settings.normals = other.normals;
        OK(kiriSheet_SetSettings(host.world, sheet, &settings));
        Host_Cut(&host, sheet, line, 2); /* which touches all regions, so that masses are exact in both */
        for (int i = 0; i < 20; ++i) {
            assert_true(Host_Tick(&host, DT, 2) >= 0);
        }
        hash[way] = Host_Hash(&host);
    }
    assert_true(hash[0] == hash[1]);
}

TEST(SettingsChangeWhileItMoves)
{
    kiriSheetDef def = Host_SmallDef();
    START_HOST(host);
    kiriSheet sheet = Hang(&host, &def);
    Host_Ticks(&host, 20, DT, 2);
    kiriTotals before = Host_Totals(&host, sheet);
    kiriSheetSettings settings = World_Settings(host.world, sheet);
    settings.material.density *= 2.0f;
    settings.material.poissonsRatio = 0.3f;
    settings.skinning = KIRI_SKINNING_SMOOTH;
    OK(kiriSheet_SetSettings(host.world, sheet, &settings));
    kiriTotals after = Host_Totals(&host, sheet);
    for (int k = 0; k < 3; ++k) {
        assert_true(fabs(after.center[k] - before.center[k]) < 1e-12);
        assert_true(fabs(after.momentum[k] - 2.0 * before.momentum[k]) < 1e-6 * before.mass);
    }
    assert_true(fabs(after.mass - 2.0 * before.mass) < 1e-6 * before.mass);
    const float line[4] = { -0.1f, 0.5f, 0.7f, 0.5f };
    Host_Cut(&host, sheet, line, 2);
    Host_Ticks(&host, 20, DT, 2);
    settings.fadeTime = 0.0f; /* while strains of links fade */
    OK(kiriSheet_SetSettings(host.world, sheet, &settings));
    const float more[4] = { 0.5f, -0.1f, 0.55f, 0.4f };
    Host_Cut(&host, sheet, more, 2);
    OK(Host_Tick(&host, DT, 2));
}

/* Another look is seen to come little by little, from the tick on in which both are asked for. */
TEST(FadesMayBeginWithAnotherLook)
{
    for (int together = 0; together < 2; ++together) {
        kiriSheetDef def = Host_SmallDef();
        def.fadeTime = 0.0f;
        def.skinning = KIRI_SKINNING_LINEAR;
        START_HOST(host);
        kiriSheet sheet = Hang(&host, &def);
        Host_Ticks(&host, 20, DT, 2);
        kiriSheetSettings settings = World_Settings(host.world, sheet);
        settings.skinning = KIRI_SKINNING_SMOOTH;
        if (!together) {
            OK(kiriSheet_SetSettings(host.world, sheet, &settings));
        }
        settings.fadeTime = 1.0f;
        OK(kiriSheet_SetSettings(host.world, sheet, &settings));
        OK(Host_Tick(&host, DT, 2));
        kiriProfile profile = World_Profile(host.world);
        assert_true(profile.largestJump > 0.0 && profile.largestFade > 0.0);
    }
}

/* ---- Points and impulses ----------------------------------------------------------------------------------------- */

static kiriPointState PointAt(const Host* host, kiriSheet sheet, float u, float v)
{
    const float rest[2] = { u, v };
    return World_PointState(host->world, sheet, rest);
}

static double Apart(const float* a, const float* b)
{
    double x = (double)a[0] - b[0], y = (double)a[1] - b[1], z = (double)a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

/* At vertices it is what the mesh shows; its velocity is that by which it goes on. */
TEST(PointIsWhatIsSeen)
{
    for (int32_t skinning = 0; skinning < 2; ++skinning) {
        kiriSheetDef def = Host_SmallDef();
        const float line[4] = { -0.1f, 0.4f, 0.6f, 0.55f };
        START_HOST(host);
        def.skinning = skinning;
        kiriSheet sheet = HangByFrame(&host, &def);
        Host_Cut(&host, sheet, line, 2);
        Host_Ticks(&host, 30, DT, 2);
        kiriMesh mesh = Host_Mesh(&host, sheet);
        for (int32_t t = 0; t < mesh.triangleCount; ++t) {
            float rest[2] = { 0.0f, 0.0f }, x[3] = { 0.0f, 0.0f, 0.0f };
            for (int k = 0; k < 3; ++k) {
                for (int e = 0; e < 2; ++e) {
                    rest[e] += mesh.restPositions[2 * mesh.indices[3 * t + k] + e] / 3.0f;
                }
                for (int e = 0; e < 3; ++e) {
                    x[e] += mesh.positions[3 * mesh.indices[3 * t + k] + e] / 3.0f;
                }
            }
            kiriPointState point = PointAt(&host, sheet, rest[0], rest[1]);
            assert_true(Apart(point.position, x) < 1e-5);
            float none[3] = { 0.0f, 0.0f, 0.0f };
            assert_true(fabs(Apart(point.normal, none) - 1.0) < 1e-5);
        }
        kiriSheetSettings settings; /* the detail layer moves after the frames do */
        OK(kiriSheet_GetSettings(host.world, sheet, &settings));
        settings.material.detail = 0;
        settings.fadeTime = 0.0f;
        OK(kiriSheet_SetSettings(host.world, sheet, &settings));
        OK(Host_Tick(&host, DT, 2));
        kiriPointState before = PointAt(&host, sheet, 0.7f, 0.3f);
        OK(Host_Tick(&host, 1e-4f, 1));
        kiriPointState after = PointAt(&host, sheet, 0.7f, 0.3f);
        double way = 0.0, size = 0.0;
        for (int k = 0; k < 3; ++k) {
            double v = ((double)after.position[k] - before.position[k]) / 1e-4;
            double mean = 0.5 * ((double)before.velocity[k] + after.velocity[k]);
            way += (v - mean) * (v - mean);
            size += v * v;
        }
        /* The normal that a smooth patch leaves by turns a little beside its weights. */
        assert_true(size > 0.01 && way < (skinning == 0 ? 1e-3 : 0.05) * size);
    }
}

/* A square of two triangles, one of them turned over: within the other the normals of the corners cancel out somewhere,
   and there the point has that of the triangle; or where that has no area, that of the corner next to it. */
TEST(PointHasANormal)
{
    static const float sites[8] = { 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 1.0f, 1.0f, 1.0f };
    static const float places[4][3] = { { 0.0f }, { 1.0f, 2.0f }, { 0.0f, 1.0f }, { 1.0f, 0.0f } };
    static const float signs[4] = { -1.0f, -1.0f, 1.0f, -1.0f };
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    def.framePoints = sites;
    def.material.detail = 0;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 1, 1);
    kiriFrame frames[4];
    World_GetFrames(host.world, sheet, frames, 4);
    for (int i = 0; i < 4; ++i) {
        OK(kiriFrame_Hold(host.world, frames[i], places[i], worldAxes));
    }
    OK(Host_Tick(&host, DT, 1));
    for (int hasNormals = 0; hasNormals < 2; ++hasNormals) {
        kiriPointState point = PointAt(&host, sheet, 0.25f, 0.75f);
        assert_true(point.normal[0] == 0.0f && point.normal[1] == 0.0f && point.normal[2] == 1.0f);
        kiriMesh mesh = Host_Mesh(&host, sheet); /* which makes normals */
        for (int v = 0; v < 4; ++v) {
            assert_true(fabs((double)(mesh.normals[3 * v + 2] - signs[v])) < 1e-6);
        }
    }
    OK(kiriFrame_Hold(host.world, frames[2], places[3], worldAxes)); /* two vertices at one place */
    OK(Host_Tick(&host, DT, 1));
    for (int hasNormals = 0; hasNormals < 2; ++hasNormals) {
        kiriPointState point = PointAt(&host, sheet, 0.25f, 0.75f);
        assert_true(point.normal[0] == 0.0f && point.normal[1] == 0.0f && point.normal[2] == 1.0f);
        Host_Mesh(&host, sheet);
    }
}

TEST(PointNamesItsPiece)
{
    const float line[4] = { 0.5f, -0.1f, 0.5f, 1.1f }, outside[2] = { 1.5f, 0.5f };
    int32_t pieces[2];
    kiriPointState point;
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 4);
    Host_Cut(&host, sheet, line, 2);
    OK(Host_Tick(&host, DT, 1));
    for (int k = 0; k < 2; ++k) {
        point = PointAt(&host, sheet, k == 0 ? 0.49f : 0.51f, 0.5f);
        OK(kiriFrame_GetPiece(host.world, point.frame, &pieces[k]));
    }
    assert_int_not_equal(pieces[0], pieces[1]);
    assert_int_equal(kiriSheet_GetPoint(host.world, sheet, outside, &point), KIRI_ERROR_ARGUMENT);
}

/* Of models and skinnings, with fades on the way. */
TEST(ImpulseIsMomentum)
{
    for (int32_t way = 0; way < 4; ++way) {
        kiriSheetDef def = Host_SmallDef();
        const float line[4] = { -0.1f, 0.4f, 0.6f, 0.55f }, at[2] = { 0.9f, 0.2f }, outside[2] = { -0.1f, 0.0f };
        const float impulse[3] = { 0.01f, -0.02f, 0.05f };
        START_HOST(host);
        def.skinning = way % 2;
        def.material.detail = 0; /* impulses act on the surface without it */
        def.model = way < 2 ? KIRI_MODEL_LINKS : KIRI_MODEL_AFFINE;
        kiriSheet sheet = HangByFrame(&host, &def);
        Host_Ticks(&host, 20, DT, 2);
        Host_Cut(&host, sheet, line, 2);
        OK(Host_Tick(&host, DT, 2));
        kiriTotals before = Host_Totals(&host, sheet);
        kiriPointState point = PointAt(&host, sheet, at[0], at[1]);
        OK(kiriSheet_ApplyImpulse(host.world, sheet, at, impulse));
        kiriTotals after = Host_Totals(&host, sheet);
        for (int k = 0; k < 3; ++k) {
            int i = (k + 1) % 3, j = (k + 2) % 3;
            double moment = (double)point.position[i] * impulse[j] - (double)point.position[j] * impulse[i];
            assert_true(fabs(after.momentum[k] - before.momentum[k] - impulse[k]) < 1e-14);
            assert_true(fabs(after.angularMomentum[k] - before.angularMomentum[k] - moment) < 1e-8);
        }
        assert_int_equal(kiriSheet_ApplyImpulse(host.world, sheet, outside, impulse), KIRI_ERROR_ARGUMENT);
        OK(Host_Tick(&host, DT, 2));
    }
}

/* One that is planar takes what is in its plane. */
TEST(ImpulseInPlane)
{
    kiriSheetDef def = Host_SmallDef();
    const float at[2] = { 0.9f, 0.2f }, impulse[3] = { 0.01f, -0.02f, 0.05f };
    START_HOST(host);
    def.planar = 1;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    OK(kiriSheet_ApplyImpulse(host.world, sheet, at, impulse));
    kiriTotals totals = Host_Totals(&host, sheet);
    assert_true(fabs(totals.momentum[0] - 0.01) < 1e-9 && fabs(totals.momentum[1] + 0.02) < 1e-9);
    assert_true(totals.momentum[2] == 0.0);
    assert_true(fabs(totals.angularMomentum[2] - (0.9 * -0.02 - 0.2 * 0.01)) < 1e-8);
}

/* ---- Wind -------------------------------------------------------------------------------------------------------- */

static kiriWind Wind(float x, float y, float z, float drag, float lift)
{
    const kiriWind wind = { { x, y, z }, 1.2f, drag, lift };
    return wind;
}

/* m g = density / 2 drag area v^2, flat, in still air; and edge on, by the force along the sheet. */
TEST(TerminalVelocity)
{
    for (int way = 0; way < 6; ++way) {
        kiriSheetDef def = Host_SmallDef();
        kiriWind wind = way % 2 == 0 ? Wind(0.0f, 0.0f, 0.0f, 1.2f, 0.02f) : Wind(0.0f, 0.0f, 0.0f, 1.2f, 1.2f);
        START_HOST(host);
        OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
        def.material.airDamping = 0.0f;
        def.model = way < 4 ? KIRI_MODEL_LINKS : KIRI_MODEL_AFFINE;
        if (way % 2 == 1) {
            def.axisV[1] = 0.0f;
            def.axisV[2] = 1.0f;
        }
        def.timeStepping = way / 2 % 2;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
        OK(kiriSheet_SetWind(host.world, sheet, &wind));
        Host_Ticks(&host, 240, DT, 2);
        kiriTotals totals = Host_Totals(&host, sheet);
        double law = sqrt(totals.mass * 9.81 / (0.5 * 1.2 * 1.2 * totals.area));
        assert_true(fabs(-totals.momentum[2] / totals.mass / law - 1.0) < 0.001);
        assert_true(totals.angularMomentum[0] * 0.0 == 0.0);
    }
}

/* By drag, damping or both: never faster than itself, but for what steps of second order carry on of a drag. */
TEST(WindIsNotOvertaken)
{
    for (int way = 0; way < 18; ++way) {
        kiriSheetDef def = Host_SmallDef();
        kiriWind wind = Wind(0.0f, 0.0f, 200.0f, way / 6 < 2 ? 1.5f : 0.0f, way / 6 < 2 ? 0.1f : 0.0f);
        START_HOST(host);
        OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
        World_StopGravity(host.world);
        def.material.airDamping = way < 6 ? 0.0f : way < 12 ? 2.0f : 50.0f;
        def.timeStepping = way % 2;
        def.model = way / 2 % 3;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
        OK(kiriSheet_SetWind(host.world, sheet, &wind));
        for (int i = 0; i < 60; ++i) {
            OK(Host_Tick(&host, DT, 1));
            kiriTotals totals = Host_Totals(&host, sheet);
            double speed = totals.momentum[2] / totals.mass;
            assert_true(speed > (i < 10 ? 50.0 : 199.0) && speed < (way / 6 == 1 ? 200.1 : 200.0 + 1e-6));
            assert_true(totals.kineticEnergy < 0.5001 * totals.mass * 200.0 * 200.0);
        }
    }
}

/* ---- Pins -------------------------------------------------------------------------------------------------------- */

/* Pins a point where it is, to an obstacle or, for 0, to the world. */
static kiriPin PinTo(Host* host, kiriSheet sheet, kiriObstacle obstacle, float u, float v)
{
    kiriPointState point = PointAt(host, sheet, u, v);
    kiriPinDef def = Host_PinDef(u, v, point.position[0], point.position[1], point.position[2]);
    def.obstacle = obstacle;
    return World_AddPin(host->world, sheet, &def);
}

static double ForceOn(const Host* host, kiriPin pin)
{
    double force[3], torque[3];
    OK(kiriPin_GetReaction(host->world, pin, force, torque));
    return sqrt(force[0] * force[0] + force[1] * force[1] + force[2] * force[2]);
}

/* Three hold; each breaks in the tick in which it bears more than it can, and no sooner. */
TEST(PinsBreak)
{
    const float from[2] = { 0.0f, 1.0f }, to[2] = { 1.0f, 1.0f };
    kiriEvent event = { 0 };
    kiriPin pins[4];
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 4);
    OK(kiriSheet_ClampLine(host.world, sheet, from, to, &pins[0]));
    pins[1] = PinTo(&host, sheet, 0, 0.1f, 0.1f);
    double weight = 9.81 * Host_Totals(&host, sheet).mass;
    OK(kiriPin_SetBreakForce(host.world, pins[0], (float)(3.0 * weight)));
    OK(kiriPin_SetBreakForce(host.world, pins[1], (float)(0.05 * weight)));
    kiriPinState pinState = World_PinState(host.world, pins[1]);
    assert_true(pinState.breakForce == (float)(0.05 * weight));
    double most = 0.0;
    int32_t broken = 0;
    for (int i = 0; i < 60 && broken == 0; ++i) {
        double before = ForceOn(&host, pins[1]);
        OK(Host_Tick(&host, DT, 2));
        broken = Host_Events(&host, KIRI_EVENT_PIN_BROKE, &event);
        most = before > most ? before : most;
    }
    assert_int_equal(broken, 1);
    assert_true(event.pin == pins[1] && event.sheet == sheet && most < 0.0501 * weight);
    assert_int_equal(kiriPin_GetState(host.world, pins[1], &pinState), KIRI_ERROR_ID);
    int32_t count = World_GetPins(host.world, sheet, pins, 4);
    assert_int_equal(count, 1);
    const float pull[3] = { 0.0f, 0.0f, (float)(-10.0 * weight) };
    const float at[2] = { 0.5f, 0.5f };
    for (int i = 0; i < 20 && count > 0; ++i) {
        OK(kiriSheet_ApplyForce(host.world, sheet, at, pull, noVector));
        OK(Host_Tick(&host, DT, 2));
        OK(kiriSheet_GetPins(host.world, sheet, pins, 4, &count));
    }
    assert_int_equal(count, 0);
    assert_int_equal(Host_Events(&host, KIRI_EVENT_PIN_BROKE, &event), 1);
    OK(Host_Tick(&host, DT, 2));
    assert_int_equal(Host_Events(&host, KIRI_EVENT_PIN_BROKE, &event), 0);
}

/* A sheet that is drawn along by a corner, without gravity: what more substeps find must not differ by much. Returns
   the rms force of the pin. */
static double Draw(int32_t substeps)
{
    double squares = 0.0;
    kiriSheetDef def = DefaultSheet();
    START_HOST(host);
    host.every = 60;
    World_StopGravity(host.world);
    def.frameCount = 25;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 16, 16);
    kiriPin pin = PinTo(&host, sheet, 0, 0.0f, 1.0f);
    for (int i = 0; i < 240; ++i) {
        const float target[3] = { 3.0f * (float)(i + 1) * DT, 1.0f, 0.0f };
        OK(kiriPin_SetTarget(host.world, pin, target));
        OK(Host_Tick(&host, DT, substeps));
        squares += i >= 120 ? ForceOn(&host, pin) * ForceOn(&host, pin) / 120.0 : 0.0;
    }
    return sqrt(squares);
}

TEST(DrawnPinDoesNotJerk)
{
    double one = Draw(1), four = Draw(4);
    print_message("a cloth drawn by its corner: %.3f N rms with 1 substep, %.3f N with 4\n", one, four);
    assert_true(four < 2.0 * one);
}

TEST(HeldFrameMovesEvenly)
{
    kiriFrame frames[8];
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 4);
    World_GetFrames(host.world, sheet, frames, 8);
    kiriFrameState frame = World_FrameState(host.world, frames[0]);
    float position[3] = { frame.position[0], frame.position[1], frame.position[2] };
    for (int i = 0; i < 10; ++i) {
        position[0] += 0.01f;
        OK(kiriFrame_Hold(host.world, frames[0], position, worldAxes));
        OK(Host_Tick(&host, DT, 4));
        OK(kiriFrame_GetState(host.world, frames[0], &frame));
        assert_true(Apart(frame.position, position) < 1e-6 && fabs(frame.velocity[0] - 0.6) < 1e-4);
    }
}

/* Pinned points and clamped lines are drawn where they are held, held frames nearly, and the sheet falls asleep. */
TEST(SeenIsHeld)
{
    for (int k = 0; k < 6; ++k) {
        const float from[2] = { 0.0f, 1.0f }, to[2] = { 1.0f, 1.0f }, nearer[3] = { 0.8f, 1.0f, 0.0f };
        int kind = k / 2;
        double off = 0.0;
        kiriPin pin;
        kiriFrame frames[9];
        kiriFrameState held;
        START_HOST(host);
        host.every = 60;
        kiriSheetDef def = DefaultSheet();
        OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
        def.frameCount = 9;
        def.skinning = k % 2;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 20, 20);
        World_GetFrames(host.world, sheet, frames, 9);
        held = World_FrameState(host.world, frames[8]);
        if (kind == 0) {
            PinTo(&host, sheet, 0, 0.0f, 1.0f);
            OK(kiriPin_SetTarget(host.world, PinTo(&host, sheet, 0, 1.0f, 1.0f), nearer));
        } else if (kind == 1) {
            OK(kiriSheet_ClampLine(host.world, sheet, from, to, &pin));
        } else {
            OK(kiriFrame_Hold(host.world, frames[8], held.position, held.rotation));
        }
        assert_true(Host_Sleeps(&host, sheet, DT, 1800));
        for (int i = 0; i <= 20; i += kind == 0 ? 20 : 1) {
            const float u = kind == 2 ? held.restPoint[0] : 0.05f * (float)i, v = kind == 2 ? held.restPoint[1] : 1.0f;
            const float at[3] = { kind == 0 && i == 20 ? 0.8f : u, v, 0.0f };
            off = fmax(off, Apart(PointAt(&host, sheet, u, v).position, at));
        }
        if (kind == 1) { /* it leaves the clamp in its direction */
            assert_true(Apart(PointAt(&host, sheet, 0.5f, 0.95f).position, (float[]){ 0.5f, 0.95f, 0.0f }) < 6e-3);
        }
        print_message("case %d: seen %.2f mm off\n", k, 1e3 * off);
        assert_true(off < (kind == 0 ? 1e-4 : kind == 1 ? 1e-3 : 4e-3));
    }
}

static kiriObstacle AddBall(Host* host, float x, float y, float z, float mass)
{
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_SPHERE);
    def.radius = 0.05f;
    def.groups = 0; /* the pin alone */
    def.mass = mass;
    Set3(def.position, x, y, z);
    return World_AddObstacle(host->world, &def);
}

/* Where it goes the point goes, by velocity and by turning; what the pin bears the obstacle gets. */
TEST(PinGoesWithObstacle)
{
    const float velocity[3] = { 1.0f, 0.0f, 0.5f }, spin[3] = { 0.0f, 0.0f, 2.0f };
    kiriObstacleState ball;
    kiriPinState pinState;
    START_HOST(host);
    kiriSheet sheet = Host_AddSmall(&host, 4);
    kiriObstacle obstacle = AddBall(&host, 0.1f, 1.0f, 0.0f, 0.0f);
    kiriPin pin = PinTo(&host, sheet, obstacle, 0.0f, 1.0f), other;
    OK(kiriObstacle_SetVelocity(host.world, obstacle, velocity, spin));
    for (int i = 0; i < 60; ++i) {
        double force[3], torque[3], off = 0.0;
        OK(Host_Tick(&host, DT, 2));
        OK(kiriObstacle_GetState(host.world, obstacle, &ball));
        OK(kiriPin_GetState(host.world, pin, &pinState));
        OK(kiriPin_GetReaction(host.world, pin, force, torque));
        for (int k = 0; k < 3; ++k) {
            double there = (double)ball.position[k] - 0.1 * ball.rotation[k];
            off = fmax(off, fabs(there - pinState.target[k]));
            assert_true(fabs(ball.impulse[k] + force[k] / 60.0) < 1e-6);
        }
        assert_true(off < 1e-5 && Apart(PointAt(&host, sheet, 0.0f, 1.0f).position, pinState.target) < 0.02);
        assert_true(pinState.obstacle == obstacle);
    }
    assert_true(fabs(ball.rotation[0] - cos(2.0)) < 1e-3 && fabs(ball.position[0] - 1.1) < 1e-4);
    OK(kiriObstacle_SetVelocity(host.world, obstacle, noVector, noVector));
    OK(kiriDestroyObstacle(host.world, obstacle));
    float last[3] = { pinState.target[0], pinState.target[1], pinState.target[2] };
    OK(Host_Tick(&host, DT, 2));
    OK(kiriPin_GetState(host.world, pin, &pinState));
    assert_true(pinState.obstacle == 0 && Apart(last, pinState.target) == 0.0);
    kiriPinDef bad = DefaultPin();
    bad.obstacle = obstacle;
    assert_int_equal(kiriCreatePin(host.world, sheet, &bad, &other), KIRI_ERROR_ID);
}

/* A body of the host hangs at a sheet by a pin, without gravity, and is thrown: together they keep their momentum, and
   the pin holds, whatever the masses. */
TEST(BodyAtPinKeepsMomentum)
{
    for (int decade = -2; decade <= 3; ++decade) {
        kiriSheetDef def = Host_SmallDef();
        START_HOST(host);
        World_StopGravity(host.world);
        def.material.airDamping = 0.0f;
        def.sleepSpeed = 0.0f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
        double mass = Host_Totals(&host, sheet).mass * pow(10.0, decade), v[3] = { 0.0, 0.0, 1.0 };
        double x[3] = { 0.0, 1.0, 0.0 }, worst = 0.0, apart = 0.0;
        kiriObstacle obstacle = AddBall(&host, 0.0f, 1.0f, 0.0f, (float)mass);
        PinTo(&host, sheet, obstacle, 0.0f, 1.0f);
        for (int i = 0; i < 120; ++i) {
            const float velocity[3] = { (float)v[0], (float)v[1], (float)v[2] };
            const float position[3] = { (float)x[0], (float)x[1], (float)x[2] };
            OK(kiriObstacle_SetPose(host.world, obstacle, position, worldAxes));
            OK(kiriObstacle_SetVelocity(host.world, obstacle, velocity, noVector));
            OK(Host_Tick(&host, DT, 2));
            kiriObstacleState ball = World_ObstacleState(host.world, obstacle);
            kiriTotals totals = Host_Totals(&host, sheet);
            for (int k = 0; k < 3; ++k) {
                v[k] += ball.impulse[k] / mass;
                x[k] += v[k] / 60.0;
                worst = fmax(worst, fabs(totals.momentum[k] + mass * v[k] - (k == 2 ? mass : 0.0)) / mass);
            }
            const float there[3] = { (float)x[0], (float)x[1], (float)x[2] };
            apart = fmax(apart, Apart(PointAt(&host, sheet, 0.0f, 1.0f).position, there));
        }
        print_message("a body of 1e%d of the sheet: momentum off by %.1e, pin by %.1f mm, %.2f m/s at the end\n",
                      decade, worst, 1e3 * apart, sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]));
        assert_true(worst < 0.01 && apart < 1e-4);
        assert_true(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] < 1.3);
    }
}

/* ---- Place, velocity, data --------------------------------------------------------------------------------------- */

/* A sheet that is carried to another place in free fall goes on as it would have there: rotated gravity, rotated
   start. */
TEST(TransformMovesAll)
{
    const float quarter[9] = { 0.0f, 1.0f, 0.0f, -1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f }, away[3] = { 3.0f, -2.0f, 5.0f };
    const float line[4] = { -0.1f, 0.4f, 0.6f, 0.55f }, at[2] = { 0.9f, 0.2f }, impulse[3] = { 0.01f, -0.02f, 0.05f };
    for (int32_t way = 0; way < 3; ++way) {
        kiriSheetDef def = Host_SmallDef();
        kiriSheet sheets[2];
        START_HOST(host);
        def.model = way < 2 ? KIRI_MODEL_LINKS : KIRI_MODEL_AFFINE;
        def.skinning = way % 2;
        for (int i = 0; i < 2; ++i) {
            sheets[i] = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
            OK(kiriSheet_ApplyImpulse(host.world, sheets[i], at, impulse));
            Host_Cut(&host, sheets[i], line, 2);
        }
        Host_Ticks(&host, 10, DT, 2);
        kiriMesh held = Host_Mesh(&host, sheets[1]);
        float first[3] = { held.positions[0], held.positions[1], held.positions[2] };
        OK(kiriSheet_Transform(host.world, sheets[1], quarter, away));
        assert_memory_equal(first, held.positions, sizeof(first)); /* as it was until the next tick */
        for (int i = 0; i < 10; ++i) {
            kiriMesh a = Host_Mesh(&host, sheets[0]), b = Host_Mesh(&host, sheets[1]);
            for (int32_t v = 0; v < a.vertexCount; ++v) {
                const float *x = &a.positions[3 * v], *n = &a.normals[3 * v];
                const float there[3] = { -x[1] + away[0], x[0] + away[1], x[2] + away[2] };
                const float normal[3] = { -n[1], n[0], n[2] };
                assert_true(Apart(there, &b.positions[3 * v]) < 1e-5 && Apart(normal, &b.normals[3 * v]) < 1e-3);
            }
            OK(Host_Tick(&host, DT, 2));
        }
    }
}

TEST(TransformIsChecked)
{
    const float quarter[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, -1.0f, 0.0f }, away[3] = { 3.0f, -2.0f, 5.0f };
    const float mirror[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, -1.0f };
    kiriSheetDef def = Host_SmallDef();
    START_HOST(host);
    def.planar = 1;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    uint64_t hash = Host_Hash(&host);
    assert_int_equal(kiriSheet_Transform(host.world, sheet, quarter, away), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriSheet_Transform(host.world, sheet, mirror, away), KIRI_ERROR_ARGUMENT);
    assert_true(Host_Hash(&host) == hash);
}

TEST(VelocityIsRigid)
{
    const float velocity[3] = { 1.0f, 2.0f, -0.5f }, spin[3] = { 0.3f, -0.2f, 2.0f };
    const float line[4] = { 0.5f, -0.1f, 0.5f, 1.1f };
    for (int32_t model = 0; model < 2; ++model) {
        kiriSheetDef def = Host_SmallDef();
        START_HOST(host);
        def.material.detail = 0; /* velocities are of the surface without it */
        def.model = model;
        kiriSheet sheet = HangByFrame(&host, &def);
        Host_Ticks(&host, 10, DT, 2);
        OK(kiriSheet_SetVelocity(host.world, sheet, velocity, spin));
        kiriTotals totals = Host_Totals(&host, sheet);
        for (int k = 0; k < 3; ++k) {
            assert_true(fabs(totals.momentum[k] - (double)velocity[k] * totals.mass) < 1e-12);
        }
        kiriPointState a = PointAt(&host, sheet, 0.1f, 0.2f), b = PointAt(&host, sheet, 0.8f, 0.7f);
        double grows = 0.0;
        for (int k = 0; k < 3; ++k) {
            grows += ((double)a.velocity[k] - b.velocity[k]) * ((double)a.position[k] - b.position[k]);
        }
        assert_true(fabs(grows) < 1e-6);
        Host_Cut(&host, sheet, line, 2);
        OK(Host_Tick(&host, DT, 2));
        OK(kiriSheet_SetVelocity(host.world, sheet, noVector, noVector));
        OK(kiriFrame_SetPieceVelocity(host.world, Host_FrameOf(&host, sheet, 1), velocity, noVector));
        kiriPieceState piece = World_PieceState(host.world, sheet, 0);
        assert_true(piece.momentum[0] == 0.0);
        OK(kiriSheet_GetPiece(host.world, sheet, 1, &piece));
        assert_true(fabs(piece.momentum[0] - piece.mass) < 1e-12);
    }
}

static uint64_t PieceData(const Host* host, kiriSheet sheet, int32_t piece)
{
    uint64_t data;
    OK(kiriFrame_GetPieceUserData(host->world, Host_FrameOf(host, sheet, piece), &data));
    return data;
}

TEST(UserDataStays)
{
    const float line[4] = { 0.5f, -0.1f, 0.5f, 1.1f }, across[4] = { 0.4f, 0.4f, 1.1f, 0.4f };
    kiriSheetDef def = Host_SmallDef();
    uint64_t data;
    START_HOST(host);
    kiriSheet sheet = Hang(&host, &def);
    kiriPin pin = PinTo(&host, sheet, 0, 0.8f, 0.2f);
    uint64_t hash = Host_Hash(&host);
    OK(kiriSheet_SetUserData(host.world, sheet, UINT64_MAX));
    OK(kiriPin_SetUserData(host.world, pin, 1234567890123ull));
    OK(kiriFrame_SetPieceUserData(host.world, Host_FrameOf(&host, sheet, 0), 5));
    assert_true(Host_Hash(&host) == hash);
    Host_Cut(&host, sheet, line, 2);
    OK(Host_Tick(&host, DT, 2));
    assert_true(PieceData(&host, sheet, 0) == 5 && PieceData(&host, sheet, 1) == 5);
    OK(kiriFrame_SetPieceUserData(host.world, Host_FrameOf(&host, sheet, 1), 6));
    Host_Cut(&host, sheet, across, 2); /* one of the parts gets a new frame, perhaps */
    OK(Host_Tick(&host, DT, 2));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 3);
    assert_true(PieceData(&host, sheet, 0) == 5 && PieceData(&host, sheet, 1) == 6 && PieceData(&host, sheet, 2) == 6);
    kiriPointState point = PointAt(&host, sheet, 0.8f, 0.2f);
    kiriSheet detached = World_Detach(host.world, point.frame);
    OK(kiriFrame_GetPieceUserData(host.world, point.frame, &data));
    assert_true(data == 6);
    OK(kiriPin_GetUserData(host.world, pin, &data));
    assert_true(data == 1234567890123ull);
    OK(kiriSheet_GetUserData(host.world, detached, &data));
    assert_true(data == UINT64_MAX);
}

/* ---- Solids ------------------------------------------------------------------------------------------------------ */

/* Rims have vertices of their own: here a vertex is one of the sheet on one of its sides. */
static int64_t Welded(const kiriSolid* solid, int32_t seen, int32_t vertex)
{
    int32_t side = vertex < 2 * seen ? vertex / seen : (vertex - 2 * seen) % 4 / 2;
    return 2 * (int64_t)solid->sources[vertex] + side;
}

static int CompareEdges(const void* a, const void* b)
{
    const int64_t *x = a, *y = b;
    return x[0] != y[0] ? (x[0] > y[0]) - (x[0] < y[0]) : (x[1] > y[1]) - (x[1] < y[1]);
}

/* Each edge is there once in either direction. */
static void CheckClosed(const kiriSolid* solid, int32_t seen)
{
    int32_t count = 3 * solid->triangleCount;
    FREED(int64_t, edges) = malloc(2 * sizeof(int64_t) * (size_t)count);
    for (int32_t n = 0; n < count; ++n) {
        int32_t next = n % 3 == 2 ? n - 2 : n + 1;
        edges[2 * n] = Welded(solid, seen, solid->indices[n]);
        edges[2 * n + 1] = Welded(solid, seen, solid->indices[next]);
    }
    qsort(edges, (size_t)count, 2 * sizeof(int64_t), CompareEdges);
    for (int32_t n = 0; n < count; ++n) {
        const int64_t back[2] = { edges[2 * n + 1], edges[2 * n] };
        assert_true(n == 0 || CompareEdges(&edges[2 * n - 2], &edges[2 * n]) != 0);
        assert_non_null(bsearch(back, edges, (size_t)count, 2 * sizeof(int64_t), CompareEdges));
    }
}

static double VolumeOf(const kiriSolid* solid)
{
    double sum = 0.0;
    for (int32_t t = 0; t < solid->triangleCount; ++t) {
        const float *a = &solid->positions[3 * solid->indices[3 * t]],
                    *b = &solid->positions[3 * solid->indices[3 * t + 1]],
                    *c = &solid->positions[3 * solid->indices[3 * t + 2]];
        sum += (double)a[0] * ((double)b[1] * c[2] - (double)b[2] * c[1]) +
               (double)a[1] * ((double)b[2] * c[0] - (double)b[0] * c[2]) +
               (double)a[2] * ((double)b[0] * c[1] - (double)b[1] * c[0]);
    }
    return sum / 6.0;
}

/* A rim looks away from the material: its triangles turn as its normals say. */
static void CheckRims(const kiriSolid* solid)
{
    for (int32_t t = solid->rimTriangle; t < solid->triangleCount; ++t) {
        const int32_t* corners = &solid->indices[3 * t];
        double e[2][3], n[3], dot = 0.0;
        for (int k = 0; k < 6; ++k) {
            e[k / 3][k % 3] =
                (double)solid->positions[3 * corners[1 + k / 3] + k % 3] - solid->positions[3 * corners[0] + k % 3];
        }
        for (int k = 0; k < 3; ++k) {
            n[k] = e[0][(k + 1) % 3] * e[1][(k + 2) % 3] - e[0][(k + 2) % 3] * e[1][(k + 1) % 3];
            dot += n[k] * solid->normals[3 * corners[0] + k];
        }
        assert_true(dot > 0.9 * sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]));
    }
}

TEST(SolidIsClosed)
{
    kiriSheetDef def = Host_SmallDef();
    kiriSolid solid, again;
    const float cuts[5][4] = { { -0.1f, 0.4f, 0.6f, 0.55f },
                               { 0.3f, 0.2f, 0.31f, 0.7f },
                               { 0.25f, 0.0f, 0.25f, 0.25f }, /* one edge of the mesh, */
                               { 0.75f, 0.25f, 0.75f, 0.5f }, /* and one with both ends inside */
                               { 0.6f, -0.1f, 0.9f, 1.1f } };
    START_HOST(host);
    kiriSheet sheet = Hang(&host, &def);
    for (int i = -1; i < 5; ++i) {
        if (i >= 0) {
            Host_Cut(&host, sheet, cuts[i], 2);
            OK(Host_Tick(&host, 1e-6f, 1));
        }
        kiriMesh mesh = Host_Mesh(&host, sheet);
        OK(kiriSheet_GetSolid(host.world, sheet, 0.01f, &solid));
        CheckClosed(&solid, mesh.vertexCount);
        CheckRims(&solid);
        assert_true(fabs(VolumeOf(&solid) - 0.01 * Host_Totals(&host, sheet).area) < 1e-8);
        assert_int_equal(solid.rimTriangle, 2 * mesh.triangleCount);
    }
    Host_Ticks(&host, 30, DT, 2);
    OK(kiriSheet_GetSolid(host.world, sheet, 0.01f, &solid));
    for (int32_t v = solid.indices[3 * solid.rimTriangle + 1]; v < solid.vertexCount; v += 4) { /* rims of drawn edges */
        double dot = 0.0;
        for (int k = 0; k < 3; ++k) {
            const float* p = &solid.positions[3 * v + k];
            dot += solid.normals[3 * v + k] * ((double)p[3] - p[0] + p[9] - p[6]);
        }
        assert_true(fabs(dot) < 1e-6);
    }
    float x = solid.positions[0];
    OK(kiriSheet_GetSolid(host.world, sheet, 0.0f, &again));
    CheckClosed(&solid, Host_Mesh(&host, sheet).vertexCount);
    assert_true(solid.positions[0] == x && VolumeOf(&solid) / 0.01 > 0.8 && VolumeOf(&solid) / 0.01 < 1.0);
    assert_true(fabs(VolumeOf(&again) / (double)def.material.thickness - VolumeOf(&solid) / 0.01) < 1e-3);
}

/* ---- Axes -------------------------------------------------------------------------------------------------------- */

/* With y up, (x, y, z) is what (x, -z, y) is with z up. */
static void ToZUp(const float* y, float z[3])
{
    z[0] = y[0];
    z[1] = -y[2];
    z[2] = y[1];
}

static kiriSheet HangIn(Host* host, bool isYUp)
{
    const float down[2][3] = { { 0.0f, 0.0f, -9.81f }, { 0.0f, -9.81f, 0.0f } };
    const float line[4] = { -0.1f, 0.4f, 0.6f, 0.55f };
    kiriSheetDef def = Host_SmallDef();
    Host_Start(host);
    OK(kiriWorld_SetGravity(host->world, down[isYUp]));
    def.axisV[1] = isYUp ? 1.0f : 0.0f;
    def.axisV[2] = isYUp ? 0.0f : 1.0f;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    PinTo(host, sheet, 0, 0.0f, 1.0f);
    kiriWind wind = isYUp ? Wind(1.0f, 0.0f, -3.0f, 1.2f, 0.05f) : Wind(1.0f, 3.0f, 0.0f, 1.2f, 0.05f);
    OK(kiriSheet_SetWind(host->world, sheet, &wind));
    Host_Cut(host, sheet, line, 2);
    return sheet;
}

TEST(NoAxisIsUp)
{
    HOST_PAIR(hosts);
    kiriSheet sheets[2] = { HangIn(&hosts[0], false), HangIn(&hosts[1], true) };
    double moved = 0.0;
    for (int i = 0; i < 60; ++i) {
        OK(Host_Tick(&hosts[0], DT, 2));
        OK(Host_Tick(&hosts[1], DT, 2));
        kiriMesh z = Host_Mesh(&hosts[0], sheets[0]), y = Host_Mesh(&hosts[1], sheets[1]);
        for (int32_t v = 0; v < z.vertexCount; ++v) {
            float there[3];
            ToZUp(&y.positions[3 * v], there);
            assert_true(Apart(there, &z.positions[3 * v]) < 1e-5);
            moved = fmax(moved, fabs((double)there[1]));
        }
    }
    assert_true(moved > 0.1);
}
