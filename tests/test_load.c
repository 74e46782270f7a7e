/* Clamps, hinges and loads: that they mean what they say, by the elastica and other independent results; reactions, by
   weight and momentum. */
#include "host.h"

#include <stdio.h>

#define STRIP_LENGTH 0.2
#define STRIP_WIDTH 0.05
#define STRIP_THICKNESS 5e-4
#define GRAVITY 9.81

/* ---- A strip of one row ------------------------------------------------------------------------------------------ */

enum { MOST_ALONG = 33 };

typedef struct Strip {
    double length, width, thickness, youngs, density;
    int along;
} Strip;

static kiriSheetDef StripDef(const Strip* strip, float points[2 * MOST_ALONG])
{
    kiriSheetDef def = DefaultSheet();
    def.material.youngsModulus = (float)strip->youngs;
    def.material.poissonsRatio = 0.0f;
    def.material.thickness = (float)strip->thickness;
    def.material.density = (float)strip->density;
    def.material.airDamping = 10.0f;
    def.material.flexDamping = 0.0f;
    def.gridResolution = strip->along * (2 * (75 / strip->along) + 1); /* sites at the middles of squares */
    def.iterations = 8;
    def.sleepSpeed = 0.0f;
    def.frameCount = def.maxFrames = strip->along;
    def.framePoints = points;
    for (int i = 0; i < strip->along; ++i) {
        points[2 * i] = (float)(strip->length * (i + 0.5) / strip->along);
        points[2 * i + 1] = (float)(0.5 * strip->width);
    }
    return def;
}

static kiriSheet AddStrip(Host* host, const Strip* strip)
{
    float points[2 * MOST_ALONG];
    kiriSheetDef def = StripDef(strip, points);
    return Host_AddRectangle(host, &def, (float)strip->length, (float)strip->width, 40, 10);
}

/* Where the free end is: the last frame carries it, for there the strip is straight. */
static void TipOf(const Host* host, kiriSheet sheet, const Strip* strip, double tip[3])
{
    kiriFrame frames[MOST_ALONG];
    int32_t count = World_GetFrames(host->world, sheet, frames, MOST_ALONG);
    kiriFrameState state = World_FrameState(host->world, frames[count - 1]);
    for (int a = 0; a < 3; ++a) {
        tip[a] = state.position[a] + (strip->length - state.restPoint[0]) * state.rotation[a];
    }
}

static void ClampStart(Host* host, kiriSheet sheet, const Strip* strip, kiriPin* clamp)
{
    const float from[2] = { 0.0f, 0.0f }, to[2] = { 0.0f, (float)strip->width };
    OK(kiriSheet_ClampLine(host->world, sheet, from, to, clamp));
}

/* ---- Heavy cantilever -------------------------------------------------------------------------------------------- */

/* Distance of the tip from the elastica's, by how far that goes. */
static double HeavyError(int along, double gamma, double x, double drop)
{
    Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 0.0, 1000.0, along };
    strip.youngs = 12.0 * strip.density * GRAVITY * pow(strip.length, 3.0) / (gamma * pow(strip.thickness, 2.0));
    START_HOST(host);
    kiriSheet sheet = AddStrip(&host, &strip);
    kiriPin clamp;
    ClampStart(&host, sheet, &strip, &clamp);
    host.every = 100;
    Host_Ticks(&host, 300, 0.01f, 1);
    double tip[3];
    TipOf(&host, sheet, &strip, tip);
    Host_Stop(&host);
    double dx = tip[0] / strip.length - x, dz = tip[2] / strip.length + drop;
    return sqrt(dx * dx + dz * dz) / drop;
}

FIGURE(HeavyCantilever)
{
    FILE* file = fopen("tests/data/cantilever_master_curve.csv", "r");
    assert_non_null(file);
    char line[256];
    double gamma, x, drop;
    assert_non_null(fgets(line, sizeof line, file));
    while (fgets(line, sizeof line, file) != NULL && sscanf(line, "%lf,%lf,%lf", &gamma, &x, &drop) == 3) {
        if (gamma > 0.3 && gamma < 30.0) {
            double coarse = HeavyError(5, gamma, x, drop), middle = HeavyError(9, gamma, x, drop);
            double fine = HeavyError(17, gamma, x, drop);
            assert_true(middle < 0.01);
            assert_true(fine < 0.5 * middle && middle < 0.5 * coarse);
        }
    }
    fclose(file);
}

/* A clamp across a strip, wherever it lies between the sites: what is beyond it hangs as from its edge. */
FIGURE(ClampAcross)
{
    for (int k = 0; k < 10; ++k) {
        Strip strip = { 0.4, STRIP_WIDTH, STRIP_THICKNESS, 3e8, 1000.0, k < 5 ? 10 : 20 }, free = strip;
        double at = 0.5 * strip.length + 0.25 * (k % 5) * strip.length / strip.along, whole[3], tip[3];
        const float from[2] = { (float)at, 0.0f }, to[2] = { (float)at, (float)strip.width };
        free.length = strip.length - at;
        free.along = 33;
        for (int i = 0; i < 2; ++i) {
            kiriPin clamp;
            START_HOST(host);
            host.every = 100;
            kiriSheet sheet = AddStrip(&host, i == 0 ? &strip : &free);
            if (i == 0) {
                OK(kiriSheet_ClampLine(host.world, sheet, from, to, &clamp));
            } else {
                ClampStart(&host, sheet, &free, &clamp);
            }
            Host_Ticks(&host, 300, 0.01f, 1);
            TipOf(&host, sheet, i == 0 ? &strip : &free, i == 0 ? tip : whole);
        }
        double error = hypot(tip[0] - at - whole[0], tip[2] - whole[2]) / fabs(whole[2]);
        assert_true(error < (k < 5 ? 0.01 : 0.0015));
    }
}

/* ---- End load ---------------------------------------------------------------------------------------------------- */

/* Sze, Liu, Lo 2004, section 3.1: how far the tip moves in and down under a shear force P at the end. */
FIGURE(EndLoad)
{
    static const double cases[2][3] = { { 2.0, 1.604, 4.933 }, { 4.0, 3.286, 6.698 } };
    const Strip strip = { 10.0, 1.0, 0.1, 1.2e6, 0.1, 9 };
    for (int k = 0; k < 4; ++k) {
        START_HOST(host);
        const double* expected = cases[k % 2];
        const float down[3] = { 0.0f, 0.0f, (float)-expected[0] };
        const float tip[2] = { 10.0f, 0.5f }, from[2] = { 10.0f, 0.0f }, to[2] = { 10.0f, 1.0f };
        World_StopGravity(host.world);
        kiriSheet sheet = AddStrip(&host, &strip);
        kiriPin clamp;
        ClampStart(&host, sheet, &strip, &clamp);
        host.every = 100;
        for (int i = 0; i < 700; ++i) {
            OK(k < 2 ? kiriSheet_ApplyForce(host.world, sheet, tip, down, noVector)
                     : kiriSheet_ApplyLineLoad(host.world, sheet, from, to, down));
            OK(Host_Tick(&host, 0.1f, 1));
        }
        double end[3], force[3], torque[3];
        TipOf(&host, sheet, &strip, end);
        assert_float_equal(strip.length - end[0], expected[1], 0.002 * strip.length);
        assert_float_equal(-end[2], expected[2], 0.002 * strip.length);
        OK(kiriPin_GetReaction(host.world, clamp, force, torque));
        assert_float_equal(force[2], expected[0], 1e-6 * expected[0]);
        assert_float_equal(torque[1], -expected[0] * end[0], 1e-5 * expected[0] * end[0]);
    }
}

/* ---- Resultants of loads ----------------------------------------------------------------------------------------- */

/* Checks by a short tick that the loads of a free sheet add up to `scale` times `force` at a point. */
static void CheckResultant(Host* host, kiriSheet sheet, const float force[3], double scale, const double at[3])
{
    const double dt = 1.0 / 16384.0;
    kiriTotals before = Host_Totals(host, sheet);
    OK(Host_Tick(host, (float)dt, 1));
    kiriTotals after = Host_Totals(host, sheet);
    for (int a = 0; a < 3; ++a) {
        int b = (a + 1) % 3, c = (a + 2) % 3;
        double moment = at[b] * (double)force[c] - at[c] * (double)force[b];
        /* Corners are found to a 1024th of a square. */
        assert_float_equal((after.momentum[a] - before.momentum[a]) / dt, scale * (double)force[a], 2e-4);
        assert_float_equal((after.angularMomentum[a] - before.angularMomentum[a]) / dt, scale * moment, 3e-4);
    }
}

/* A line load has the force and the torque of the line that lies in the material: along edges, through the sheet, along
   edges of triangles, beyond the outline, and along a cut. */
TEST(LineLoads)
{
    static const float lines[][4] = {
        { 0.0f, 0.0f, 0.0f, 1.0f },  { 1.0f, 1.0f, 0.0f, 1.0f },    { 0.1f, 0.23f, 0.93f, 0.61f },
        { 0.0f, 0.0f, 1.0f, 1.0f },  { 1.0f, 0.0f, 0.0f, 1.0f },    { 0.5f, 0.0f, 0.5f, 1.0f },
        { -0.3f, 0.4f, 1.3f, 0.4f }, { 0.3f, 0.25f, 0.31f, 0.26f }, { 0.4f, 0.3f, 0.4f, 0.7f },
    };
    static const float clipped[4] = { 0.0f, 0.4f, 1.0f, 0.4f }, cut[4] = { 0.4f, 0.3f, 0.4f, 0.7f };
    static const float q[3] = { 0.5f, -1.0f, 2.0f };
    for (int i = 0; i < 2 * (int)(sizeof(lines) / sizeof(lines[0])); ++i) {
        START_HOST(host);
        kiriSheetDef def = SheetOf(24, 11);
        def.material.airDamping = 0.0f;
        World_StopGravity(host.world);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
        if (i % 2 == 1) {
            Host_Cut(&host, sheet, cut, 2);
            OK(Host_Tick(&host, 0.01f, 1));
        }
        const float *line = lines[i / 2], *inside = line[0] < 0.0f ? clipped : line;
        OK(kiriSheet_ApplyLineLoad(host.world, sheet, line, line + 2, q));
        double length = sqrt(pow((double)inside[2] - inside[0], 2.0) + pow((double)inside[3] - inside[1], 2.0));
        const double middle[3] = { 0.5 * ((double)inside[0] + inside[2]), 0.5 * ((double)inside[1] + inside[3]), 0.0 };
        CheckResultant(&host, sheet, q, length, middle);
    }
}

/* Each lip of a cut gets half, and is held whole. */
TEST(LineAlongCut)
{
    static const float across[4] = { 0.4f, -0.1f, 0.4f, 1.1f }, q[3] = { 0.0f, 0.0f, 3.0f };
    static const float down[3] = { 0.0f, 0.0f, -9.81f };
    START_HOST(host);
    World_StopGravity(host.world);
    kiriSheetDef def = Host_SmallDef();
    def.material.airDamping = 0.0f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(&host, sheet, across, 2);
    OK(Host_Tick(&host, 0.01f, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    OK(kiriSheet_ApplyLineLoad(host.world, sheet, across, across + 2, q));
    OK(Host_Tick(&host, 0.01f, 1));
    kiriSheet sheets[2] = { sheet };
    World_Clamp(host.world, sheet, across, across + 2);
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 1), &sheets[1]));
    for (int k = 0; k < 2; ++k) {
        assert_float_equal(Host_Totals(&host, sheets[k]).momentum[2], 0.015, 1e-6);
    }
    OK(kiriWorld_SetGravity(host.world, down));
    Host_Ticks(&host, 100, 0.01f, 1);
    for (int k = 0; k < 2; ++k) {
        assert_float_equal(Host_Totals(&host, sheets[k]).center[2], 0.0, 0.7); /* a free piece has fallen 4.9 m */
    }
}

TEST(PointLoads)
{
    static const float at[2] = { 0.9f, 0.35f }, force[3] = { 1.0f, -2.0f, 0.5f }, pressure[3] = { 0.0f, 0.0f, 4.0f };
    const double place[3] = { 0.9f, 0.35f, 0.0 }, middle[3] = { 0.5, 0.5, 0.0 };
    START_HOST(host);
    World_StopGravity(host.world);
    kiriSheetDef def = Host_SmallDef();
    def.material.airDamping = 0.0f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 4, 4);
    OK(kiriSheet_ApplyForce(host.world, sheet, at, force, noVector));
    CheckResultant(&host, sheet, force, 1.0, place);
    CheckResultant(&host, sheet, force, 0.0, place); /* used up */
    OK(kiriSheet_ApplyForce(host.world, sheet, at, force, noVector));
    OK(kiriSheet_ApplyForce(host.world, sheet, at, force, noVector));
    CheckResultant(&host, sheet, force, 2.0, place);
    OK(kiriSheet_ApplyPressure(host.world, sheet, 4.0f));
    CheckResultant(&host, sheet, pressure, 1.0, middle);
}

/* ---- Reactions --------------------------------------------------------------------------------------------------- */

enum { POINTS, HINGE, CLAMP, HOLD, MIXED, HOLDS };

/* Holds a sheet of 1 m x 1 m in one of these ways. */
static void HoldSheet(Host* host, kiriSheet sheet, int way)
{
    static const float edge[4] = { 0.0f, 0.0f, 0.0f, 1.0f }, inner[4] = { 0.7f, 0.2f, 0.8f, 0.9f };
    kiriPin pin;
    if (way == POINTS || way == MIXED) {
        for (int i = 0; i < 2; ++i) {
            Host_Pin(host, sheet, 0.0f, (float)i, 0.0f, (float)i, 0.0f);
        }
    }
    if (way == CLAMP || way == MIXED) {
        OK(kiriSheet_ClampLine(host->world, sheet, edge, edge + 2, &pin));
    }
    if (way == HINGE || way == MIXED) {
        OK(kiriSheet_HingeLine(host->world, sheet, inner, inner + 2, &pin));
    }
    if (way == HOLD || way == MIXED) {
        kiriFrame frame;
        World_GetFrames(host->world, sheet, &frame, 1);
        kiriFrameState state = World_FrameState(host->world, frame);
        OK(kiriFrame_Hold(host->world, frame, state.position, worldAxes));
    }
}

/* Of all pins and frames: force, and torque about the world's origin. */
static void SumReactions(const Host* host, kiriSheet sheet, double force[3], double torque[3])
{
    kiriPin pins[8];
    kiriFrame frames[64];
    int32_t pinCount = World_GetPins(host->world, sheet, pins, 8);
    int32_t frameCount = World_GetFrames(host->world, sheet, frames, 64);
    memset(force, 0, 3 * sizeof(double));
    memset(torque, 0, 3 * sizeof(double));
    for (int32_t i = 0; i < pinCount + frameCount; ++i) {
        double f[3], t[3];
        float at[3];
        if (i < pinCount) {
            OK(kiriPin_GetReaction(host->world, pins[i], f, t));
            kiriPinState state = World_PinState(host->world, pins[i]);
            memcpy(at, state.target, sizeof(at));
        } else {
            OK(kiriFrame_GetReaction(host->world, frames[i - pinCount], f, t));
            kiriFrameState state = World_FrameState(host->world, frames[i - pinCount]);
            memcpy(at, state.position, sizeof(at));
        }
        for (int a = 0; a < 3; ++a) {
            int b = (a + 1) % 3, c = (a + 2) % 3;
            force[a] += f[a];
            torque[a] += t[a] + ((double)at[b] * f[c] - (double)at[c] * f[b]);
        }
    }
}

static kiriSheetDef ReactionDef(int model)
{
    kiriSheetDef def = DefaultSheet();
    OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
    def.material.thickness = 1e-3f;
    def.material.airDamping = 0.0f;
    def.gridResolution = 24;
    def.frameCount = def.maxFrames = 12;
    def.iterations = 16;
    def.sleepSpeed = 0.0f;
    def.model = model;
    return def;
}

/* At rest reactions bear the weight, at the centre of mass. */
FIGURE(ReactionsAtRest)
{
    for (int k = 0; k < 2 * HOLDS; ++k) {
        START_HOST(host);
        kiriSheetDef def = ReactionDef(k < HOLDS ? KIRI_MODEL_LINKS : KIRI_MODEL_AFFINE);
        def.material.airDamping = 8.0f;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 6, 6);
        HoldSheet(&host, sheet, k % HOLDS);
        host.every = 50;
        double force[3], torque[3];
        Host_Ticks(&host, 250, 0.04f, 1);
        kiriTotals totals = Host_Totals(&host, sheet);
        SumReactions(&host, sheet, force, torque);
        double weight = totals.mass * (double)9.81f;
        const double expected[3] = { 0.0, 0.0, weight };
        const double moment[3] = { totals.center[1] * weight, -totals.center[0] * weight, 0.0 };
        for (int a = 0; a < 3; ++a) {
            /* The hung sheet never quite rests: its frames move by some nanometres. */
            assert_float_equal(force[a], expected[a], 2e-5 * weight);
            assert_float_equal(torque[a], moment[a], 2e-5 * weight);
        }
    }
}

/* In motion they change momentum, together with the weight: exactly, however few systems are solved. */
TEST(ReactionsInMotion)
{
    const float dt = 0.01f;
    for (int k = 0; k < 4 * HOLDS; ++k) {
        START_HOST(host);
        kiriSheetDef def = ReactionDef(k % 2 == 0 ? KIRI_MODEL_LINKS : KIRI_MODEL_AFFINE);
        if (k / 2 % 2 == 1) {
            OK(kiriGetMaterial(KIRI_MATERIAL_FOIL, &def.material));
            def.material.airDamping = 0.0f;
            def.iterations = 1 + k / 4 % 2;
        }
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 6, 6);
        HoldSheet(&host, sheet, k / 4);
        host.every = 50;
        double worst = 0.0, weight = Host_Totals(&host, sheet).mass * (double)9.81f;
        for (int i = 0; i < RUNS(40); ++i) {
            double force[3], torque[3];
            kiriTotals before = Host_Totals(&host, sheet);
            OK(Host_Tick(&host, dt, 2));
            kiriTotals after = Host_Totals(&host, sheet);
            SumReactions(&host, sheet, force, torque);
            for (int a = 0; a < 3; ++a) {
                double due = (after.momentum[a] - before.momentum[a]) / (double)dt + (a == 2 ? weight : 0.0);
                worst = fabs(force[a] - due) > worst ? fabs(force[a] - due) : worst;
            }
        }
        assert_true(worst < 1e-10 * weight);
    }
}

/* What wind does to a sheet that is held everywhere, the holds bear: the pressure of its area, at its centre. */
TEST(HoldsBearWind)
{
    const kiriWind wind = { { 3.0f, -2.0f, 5.0f }, 1.2f, 1.1f, 0.3f };
    for (int model = KIRI_MODEL_LINKS; model <= KIRI_MODEL_AFFINE; ++model) {
        START_HOST(host);
        kiriSheetDef def = ReactionDef(model);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.5f, 6, 3);
        kiriFrame frames[64];
        int32_t count = World_GetFrames(host.world, sheet, frames, 64);
        for (int32_t i = 0; i < count; ++i) {
            kiriFrameState frame = World_FrameState(host.world, frames[i]);
            OK(kiriFrame_Hold(host.world, frames[i], frame.position, worldAxes));
        }
        OK(kiriSheet_SetWind(host.world, sheet, &wind));
        double force[3], torque[3];
        Host_Ticks(&host, 3, 0.01f, 2);
        SumReactions(&host, sheet, force, torque);
        kiriTotals totals = Host_Totals(&host, sheet);
        double speed = sqrt(9.0 + 4.0 + 25.0), pressure = 0.5 * 1.2 * speed * totals.area;
        const double due[3] = { -pressure * 0.3 * 3.0, pressure * 0.3 * 2.0,
                                totals.mass * 9.81 - pressure * 1.1 * 5.0 };
        double tolerance = 1e-5 * sqrt(due[0] * due[0] + due[1] * due[1] + due[2] * due[2]);
        for (int a = 0; a < 3; ++a) {
            int b = (a + 1) % 3, c = (a + 2) % 3;
            assert_float_equal(force[a], due[a], tolerance);
            assert_float_equal(torque[a], totals.center[b] * due[c] - totals.center[c] * due[b], tolerance);
        }
    }
}

/* ---- Strips by theory -------------------------------------------------------------------------------------------- */

typedef struct Beam {
    Host host;
    Strip strip;
    kiriSheet sheet;
    kiriPin ends[2];
} Beam;

/* A strip in no gravity, its ends held by clamps or hinges, or left free. */
static void Beam_Start(Beam* beam, const Strip* strip,
                       kiriResult (*first)(kiriWorld*, kiriSheet, const float*, const float*, kiriPin*),
                       kiriResult (*last)(kiriWorld*, kiriSheet, const float*, const float*, kiriPin*))
{
    const float length = (float)strip->length, width = (float)strip->width;
    const float from[2][2] = { { 0.0f, 0.0f }, { length, width } }, to[2][2] = { { 0.0f, width }, { length, 0.0f } };
    memset(beam, 0, sizeof(*beam));
    beam->strip = *strip;
    Host_Start(&beam->host);
    beam->host.every = 100;
    World_StopGravity(beam->host.world);
    beam->sheet = AddStrip(&beam->host, strip);
    if (first != NULL) {
        OK(first(beam->host.world, beam->sheet, from[0], to[0], &beam->ends[0]));
    }
    if (last != NULL) {
        OK(last(beam->host.world, beam->sheet, from[1], to[1], &beam->ends[1]));
    }
}

static kiriFrameState FrameStateOf(const Beam* beam, int32_t frame)
{
    kiriFrame frames[MOST_ALONG];
    World_GetFrames(beam->host.world, beam->sheet, frames, MOST_ALONG);
    return World_FrameState(beam->host.world, frames[frame]);
}

/* A strip between two supports under pressure sinks in its middle by 5/384 p L^4 / D between hinges, and by a fifth of
   that between clamps, whose moment is p L^2 / 12. */
TEST(PressureBetweenSupports)
{
    const Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 1e9, 1000.0, 9 };
    const double D = strip.youngs * pow(strip.thickness, 3.0) / 12.0, sag = 0.02 * strip.thickness;
    for (int k = 0; k < 2; ++k) {
        const double share = k == 0 ? 5.0 / 384.0 : 1.0 / 384.0;
        const float pressure = (float)(sag * D / (share * pow(strip.length, 4.0)));
        Beam beam;
        Beam_Start(&beam, &strip, k == 0 ? kiriSheet_HingeLine : kiriSheet_ClampLine,
                   k == 0 ? kiriSheet_HingeLine : kiriSheet_ClampLine);
        double force[3], torque[3];
        for (int i = 0; i < 300; ++i) {
            OK(kiriSheet_ApplyPressure(beam.host.world, beam.sheet, pressure));
            OK(Host_Tick(&beam.host, 0.01f, 1));
        }
        double w = FrameStateOf(&beam, 4).position[2];
        assert_float_equal(w, sag, 0.005 * sag);
        /* what is stored is half of the work of a load that grows slowly; a strip bent by p: p^2 L^5 W / (240 D)
           between hinges, a sixth of that between clamps */
        double stored = pow(pressure, 2.0) * pow(strip.length, 5.0) * strip.width / ((k == 0 ? 240.0 : 1440.0) * D);
        assert_true(fabs(Host_Totals(&beam.host, beam.sheet).elasticEnergy / stored - 1.0) < 0.02);
        OK(kiriPin_GetReaction(beam.host.world, beam.ends[0], force, torque));
        double half = 0.5 * pressure * strip.length * strip.width;
        assert_float_equal(force[2], -half, 1e-3 * half);
        assert_float_equal(fabs(torque[1]), k == 0 ? 0.0 : half * strip.length / 6.0, 0.01 * half * strip.length / 6.0);
        Host_Stop(&beam.host);
    }
}

/* A strip that is pulled along, and one that is pushed aside in its plane, give way by F L / (E h W) and by
   F L^3 / (3 E I) and shear, whether a clamp or a hinge holds them. */
FIGURE(PullAndPush)
{
    const float tip[2] = { STRIP_LENGTH, 0.5f * STRIP_WIDTH };
    for (int k = 0; k < 8; ++k) {
        const Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 1e8, 1000.0, k < 4 ? 5 : 9 };
        bool isPull = k % 4 < 2;
        /* Aside, 0.0074 N would buckle the strip out of its plane. */
        const double F = isPull ? 0.1 : 0.004, E = strip.youngs, h = strip.thickness, L = strip.length, W = strip.width;
        const float along[3] = { (float)F, 0.0f, 0.0f }, aside[3] = { 0.0f, (float)F, 0.0f };
        Beam beam;
        Beam_Start(&beam, &strip, k % 2 == 0 ? kiriSheet_ClampLine : kiriSheet_HingeLine, NULL);
        for (int i = 0; i < 700; ++i) {
            OK(kiriSheet_ApplyForce(beam.host.world, beam.sheet, tip, isPull ? along : aside, noVector));
            OK(Host_Tick(&beam.host, 0.01f, 1));
        }
        double end[3];
        TipOf(&beam.host, beam.sheet, &strip, end);
        double half = 0.5 * L / strip.along; /* beyond the last site the strip is rigid */
        double pulled = F * (L - half) / (E * h * W), bent = F * pow(L, 3.0) / (3.0 * E * h * pow(W, 3.0) / 12.0);
        bent += F * L / (5.0 / 12.0 * E * h * W);
        kiriFrameState last = FrameStateOf(&beam, strip.along - 1);
        double moved = isPull ? end[0] - L : last.position[1] - 0.5 * W + half * last.rotation[1];
        assert_float_equal(moved, isPull ? pulled : bent, (isPull ? 0.001 : 0.02) * (isPull ? pulled : bent));
        Host_Stop(&beam.host);
    }
}

/* A hinge lets the sheet hang, wherever it began; what hangs pulls along itself. */
TEST(HangsFromHinge)
{
    const Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 1e9, 1000.0, 5 };
    const float down[3] = { 0.0f, 0.0f, -9.81f };
    Beam beam;
    Beam_Start(&beam, &strip, kiriSheet_HingeLine, NULL);
    OK(kiriWorld_SetGravity(beam.host.world, down));
    Host_Ticks(&beam.host, 1500, 0.01f, 1);
    double end[3], force[3], torque[3];
    TipOf(&beam.host, beam.sheet, &strip, end);
    assert_float_equal(end[0], 0.0, 1e-5);
    assert_float_equal(end[2], -strip.length, 1e-5);
    OK(kiriPin_GetReaction(beam.host.world, beam.ends[0], force, torque));
    assert_float_equal(torque[1], 0.0, 1e-6);
    Host_Stop(&beam.host);
}

static void Turn(double angle, float rotation[9])
{
    const float turned[9] = { (float)cos(angle), 0.0f, (float)-sin(angle), 0.0f, 1.0f, 0.0f,
                              (float)sin(angle), 0.0f, (float)cos(angle) };
    memcpy(rotation, turned, sizeof(turned));
}

/* What a clamp moves follows it, twice around. */
TEST(ClampThatMoves)
{
    const Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 1e9, 1000.0, 5 };
    Beam beam;
    Beam_Start(&beam, &strip, kiriSheet_ClampLine, NULL);
    float rotation[9], target[3] = { 0.0f, 0.5f * STRIP_WIDTH, 0.0f };
    double angle = 0.0;
    for (int i = 0; i < 700; ++i) {
        double end[3], force[3], torque[3];
        angle += i < 240 ? 3.0 * 3.14159265358979 / 180.0 : 0.0;
        target[0] = 0.001f * (float)(i < 200 ? i : 200);
        Turn(angle, rotation);
        OK(kiriPin_SetPose(beam.host.world, beam.ends[0], target, rotation));
        OK(Host_Tick(&beam.host, 0.02f, 2));
        TipOf(&beam.host, beam.sheet, &strip, end);
        OK(kiriPin_GetReaction(beam.host.world, beam.ends[0], force, torque));
        double off = hypot(end[0] - target[0] - strip.length * cos(angle), end[2] + strip.length * sin(angle));
        assert_true(off < (i < 390 ? 0.3 : 1e-5) * strip.length);
        assert_true(i < 390 || hypot(force[0], force[2]) < 1e-6);
    }
    assert_float_equal(angle, 4.0 * 3.14159265358979, 1e-9);
    Host_Stop(&beam.host);
}

/* ---- Other models ------------------------------------------------------------------------------------------------ */

/* The clamped strip of affine frames, under its own weight; and in its plane, pulled. */
TEST(Models)
{
    const float down[3] = { 0.0f, 0.0f, -9.81f };
    for (int k = 0; k < 4; ++k) {
        Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 0.0, 1000.0, 9 };
        double gamma = 6.951927962, tip[2] = { 0.7646665783, -0.5994022678 };
        bool isPlanar = k % 2 == 1;
        strip.youngs = 12.0 * strip.density * GRAVITY * pow(strip.length, 3.0) / (gamma * pow(strip.thickness, 2.0));
        START_HOST(host);
        host.every = 50;
        OK(kiriWorld_SetGravity(host.world, isPlanar ? noVector : down));
        float points[2 * MOST_ALONG];
        kiriSheetDef def = StripDef(&strip, points);
        def.model = k < 2 ? KIRI_MODEL_LINKS : KIRI_MODEL_AFFINE;
        def.planar = isPlanar;
        kiriSheet sheet = Host_AddRectangle(&host, &def, (float)strip.length, (float)strip.width, 40, 10);
        kiriPin clamp;
        ClampStart(&host, sheet, &strip, &clamp);
        const float from[2] = { (float)strip.length, 0.0f }, to[2] = { (float)strip.length, (float)strip.width };
        const float pull[3] = { 20.0f, 0.0f, 5.0f };
        for (int i = 0; i < 700; ++i) {
            if (isPlanar) {
                OK(kiriSheet_ApplyLineLoad(host.world, sheet, from, to, pull));
            }
            OK(Host_Tick(&host, 0.01f, 1));
        }
        double end[3];
        TipOf(&host, sheet, &strip, end);
        if (isPlanar) {
            /* the half of a region beyond the last site is rigid */
            double stretch =
                20.0 * (strip.length - 0.5 * strip.length / strip.along) / (strip.youngs * strip.thickness);
            assert_float_equal(end[0] - strip.length, stretch, 0.01 * stretch);
            assert_float_equal(end[2], 0.0, 1e-9);
        } else {
            assert_float_equal(hypot(end[0] / strip.length - tip[0], end[2] / strip.length - tip[1]), 0.0, 0.02);
        }
    }
}

/* ---- Sleep ------------------------------------------------------------------------------------------------------- */

/* A sheet that sleeps says what it weighs. What may move it wakes it; what cannot does not. */
TEST(Sleep)
{
    static const float some[3] = { 0.0f, 1e-3f, 0.0f }, at[2] = { 0.5f, 0.5f };
    START_HOST(host);
    host.every = 20;
    kiriSheetDef def = ReactionDef(KIRI_MODEL_LINKS);
    def.material.airDamping = 8.0f;
    def.sleepSpeed = 1e-4f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 6, 6);
    HoldSheet(&host, sheet, CLAMP);
    kiriPin clamp;
    World_GetPins(host.world, sheet, &clamp, 1);
    kiriPinState pose = World_PinState(host.world, clamp);
    double weight = Host_Totals(&host, sheet).mass * (double)9.81f;
    for (int k = 0; k < 6; ++k) {
        int ticks = 0;
        for (; World_IsAwake(host.world, sheet); ++ticks) {
            assert_true(ticks < 2000);
            OK(Host_Tick(&host, 0.04f, 1));
        }
        double force[3], torque[3], later[3];
        OK(kiriPin_GetReaction(host.world, clamp, force, torque));
        assert_float_equal(force[2], weight, 1e-2 * weight);
        OK(kiriSheet_ApplyForce(host.world, sheet, at, noVector, noVector));
        OK(kiriSheet_ApplyLineLoad(host.world, sheet, at, pose.to, noVector));
        OK(kiriSheet_ApplyPressure(host.world, sheet, 0.0f));
        OK(kiriPin_SetPose(host.world, clamp, pose.target, pose.rotation));
        OK(Host_Tick(&host, 0.04f, 1));
        assert_false(World_IsAwake(host.world, sheet));
        OK(kiriPin_GetReaction(host.world, clamp, later, torque));
        assert_memory_equal(force, later, sizeof(force));
        if (k == 0) {
            OK(kiriSheet_ApplyForce(host.world, sheet, at, some, noVector));
        } else if (k == 1) {
            OK(kiriSheet_ApplyForce(host.world, sheet, at, noVector, some));
        } else if (k == 2) {
            OK(kiriSheet_ApplyLineLoad(host.world, sheet, at, pose.to, some));
        } else if (k == 3) {
            OK(kiriSheet_ApplyPressure(host.world, sheet, -1e-3f));
        } else if (k == 4) {
            pose.target[0] += 0.001f;
            OK(kiriPin_SetPose(host.world, clamp, pose.target, pose.rotation));
        } else {
            OK(kiriSheet_HingeLine(host.world, sheet, at, pose.to, &clamp));
        }
        assert_true(World_IsAwake(host.world, sheet));
    }
}

/* ---- Cuts and pieces --------------------------------------------------------------------------------------------- */

/* A curtain that is clamped along its top and cut into two strips. */
static kiriSheet HangCurtain(Host* host, kiriPin* clamp)
{
    static const float top[4] = { 0.0f, 1.0f, 1.0f, 1.0f }, cut[4] = { 0.47f, -0.1f, 0.53f, 1.1f };
    static const float back[3] = { 0.0f, -9.81f, 0.5f };
    Host_Start(host);
    host->every = 20;
    OK(kiriWorld_SetGravity(host->world, back));
    kiriSheetDef def = SheetOf(24, 12);
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 6, 6);
    OK(kiriSheet_ClampLine(host->world, sheet, top, top + 2, clamp));
    Host_Ticks(host, 20, 1.0f / 60.0f, 2);
    Host_Cut(host, sheet, cut, 2);
    OK(Host_Tick(host, 1.0f / 60.0f, 2));
    assert_int_equal(Host_Counts(host, sheet).pieces, 2);
    return sheet;
}

/* Of the pins of a sheet together. */
static void SumPins(const Host* host, kiriSheet sheet, double force[3])
{
    kiriPin pins[4];
    int32_t count = World_GetPins(host->world, sheet, pins, 4);
    assert_int_equal(count, 2);
    for (int32_t i = 0; i < count; ++i) {
        double one[3], torque[3];
        OK(kiriPin_GetReaction(host->world, pins[i], one, torque));
        for (int a = 0; a < 3; ++a) {
            force[a] += one[a];
        }
    }
}

static void CheckDetached(Host hosts[2], const kiriSheet sheets[2], kiriSheet detached)
{
    double together = Host_Totals(&hosts[0], sheets[0]).elasticEnergy, whole[3] = { 0.0, 0.0, 0.0 };
    double apart = Host_Totals(&hosts[1], sheets[1]).elasticEnergy + Host_Totals(&hosts[1], detached).elasticEnergy;
    double parts[3] = { 0.0, 0.0, 0.0 };
    assert_true(together > 0.0 && fabs(together - apart) < 1e-12 * together);
    SumPins(&hosts[0], sheets[0], whole);
    SumPins(&hosts[1], sheets[1], parts);
    SumPins(&hosts[1], detached, parts);
    for (int a = 0; a < 3; ++a) {
        assert_true(fabs(whole[a] - parts[a]) < 1e-11);
    }
}

/* A piece that gets a sheet of its own is held by clamps of its own, along the edge and across, and goes on to the last
   bit. */
TEST(Detach)
{
    static const float across[4] = { 0.0f, 0.7f, 1.0f, 0.74f };
    HOST_PAIR(hosts);
    kiriPin clamps[2], lower, own[2], rest[2];
    kiriSheet sheets[2];
    kiriFrame frames[64];
    for (int k = 0; k < 2; ++k) {
        sheets[k] = HangCurtain(&hosts[k], &clamps[k]);
        OK(kiriSheet_ClampLine(hosts[k].world, sheets[k], across, across + 2, &lower));
        OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 2));
    }
    kiriSheet detached = World_Detach(hosts[1].world, Host_FrameOf(&hosts[1], sheets[1], 1));
    int32_t count = World_GetPins(hosts[1].world, sheets[1], rest, 2);
    assert_true(count == 2 && rest[0] == clamps[1] && rest[1] == lower);
    OK(kiriSheet_GetPins(hosts[1].world, detached, own, 2, &count));
    assert_true(count == 2 && own[0] != rest[0] && own[1] != rest[1]);
    for (int i = 0; i < 60; ++i) {
        CheckDetached(hosts, sheets, detached);
        for (int k = 0; k < 2; ++k) {
            OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 2));
        }
    }
    OK(kiriSheet_GetFrames(hosts[0].world, sheets[0], frames, 64, &count));
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState a = World_FrameState(hosts[0].world, frames[i]);
        kiriFrameState b = World_FrameState(hosts[1].world, frames[i]);
        assert_memory_equal(&a, &b, sizeof(a));
    }
    OK(kiriDestroySheet(hosts[1].world, detached));
    assert_int_equal(kiriDestroyPin(hosts[1].world, own[0]), KIRI_ERROR_ID);
    OK(kiriDestroyPin(hosts[1].world, rest[0]));
}

/* A clamp outlives a piece that it held, and goes with the last one. */
TEST(DestroyPieces)
{
    HOST(host);
    kiriPin clamp;
    static const float beside[4] = { 0.1f, 0.2f, 0.2f, 0.2f };
    kiriSheet sheet = HangCurtain(&host, &clamp);
    kiriPin left = World_Clamp(host.world, sheet, beside, beside + 2);
    kiriFrame frame;
    kiriPointState ofLeft = World_PointState(host.world, sheet, (float[]){ 0.15f, 0.2f });
    OK(kiriFrame_DestroyPiece(host.world, ofLeft.frame));
    assert_int_equal(kiriDestroyPin(host.world, left), KIRI_ERROR_ID);
    World_GetFrames(host.world, sheet, &frame, 1);
    World_PieceOf(host.world, frame);
    OK(Host_Tick(&host, 0.01f, 1));
    double force[3], torque[3];
    OK(kiriPin_GetReaction(host.world, clamp, force, torque));
    OK(kiriDestroyPin(host.world, clamp));
}

/* Pins come and go in any order; those that are left hold what they held. */
TEST(PinsComeAndGo)
{
    START_HOST(host);
    kiriSheetDef def = ReactionDef(KIRI_MODEL_LINKS);
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 6, 6);
    kiriPin pins[16], ids[16];
    kiriPinState states[16], now;
    uint32_t seed = 7;
    int32_t count = 0, found;
    for (int i = 0; i < 300; ++i) {
        if (count < 16 && (count < 2 || Random(&seed) % 2 == 0)) {
            float line[4];
            for (int a = 0; a < 4; ++a) {
                line[a] = 0.05f + 0.9f * (float)(Random(&seed) % 1000) / 1000.0f;
            }
            kiriPinDef point = DefaultPin();
            memcpy(point.restPoint, line, sizeof(point.restPoint));
            int type = (int)(Random(&seed) % 3);
            OK(type == 0   ? kiriCreatePin(host.world, sheet, &point, &pins[count])
               : type == 1 ? kiriSheet_HingeLine(host.world, sheet, line, line + 2, &pins[count])
                           : kiriSheet_ClampLine(host.world, sheet, line, line + 2, &pins[count]));
            OK(kiriPin_GetState(host.world, pins[count], &states[count]));
            assert_int_equal(states[count].type, type);
            ++count;
        } else {
            int32_t gone = (int32_t)(Random(&seed) % (uint32_t)count);
            OK(kiriDestroyPin(host.world, pins[gone]));
            --count;
            pins[gone] = pins[count];
            states[gone] = states[count];
        }
        Host_Validate(&host);
        OK(kiriSheet_GetPins(host.world, sheet, ids, 16, &found));
        assert_int_equal(found, count);
        for (int32_t k = 0; k < count; ++k) {
            OK(kiriPin_GetState(host.world, pins[k], &now));
            assert_memory_equal(&now, &states[k], sizeof(now));
        }
    }
}

/* A slit from the clamped edge on gives an arm to another frame, which the clamp did not hold. What it holds on keeps
   its strain, in three fifths of the width, until the motion changes it; the arm begins without any. */
TEST(CutAtClamp)
{
    static const float slit[4] = { -0.01f, 0.02f, 0.1f, 0.02f };
    const Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 1e9, 1000.0, 5 };
    const double weight = GRAVITY * strip.density * strip.length * strip.width * strip.thickness;
    START_HOST(host);
    host.every = 20;
    kiriSheet sheet = AddStrip(&host, &strip);
    kiriPin clamp;
    ClampStart(&host, sheet, &strip, &clamp);
    double force[3], torque[3];
    Host_Ticks(&host, 300, 0.01f, 1);
    OK(kiriPin_GetReaction(host.world, clamp, force, torque));
    assert_float_equal(force[2], weight, 1e-4 * weight);
    Host_Cut(&host, sheet, slit, 2);
    OK(Host_Tick(&host, 0.001f, 1));
    OK(kiriPin_GetReaction(host.world, clamp, force, torque));
    assert_float_equal(force[2], 0.8 * weight, 0.25 * weight); /* 0.6 at the end, 1 before */
    Host_Ticks(&host, 600, 0.01f, 1);
    OK(kiriPin_GetReaction(host.world, clamp, force, torque));
    assert_float_equal(force[2], weight, 1e-4 * weight);
}

/* ---- Extremes ---------------------------------------------------------------------------------------------------- */
