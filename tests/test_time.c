/* Time stepping through the public header: torques that arrive, and motion that lasts. */
#include "host.h"

/* A strip of paper, 0.2 m by 0.05 m along u, clamped at the first of its frames. */
typedef struct Strip {
    Host host;
    kiriSheet sheet;
    kiriFrame frames[64];
    int32_t frameCount;
} Strip;

typedef struct StripDef {
    int frames, model, planar;
    float youngsModulus;
} StripDef;

static const float Length = 0.2f, Width = 0.05f;

static kiriSheetDef DefOfStrip(const StripDef* d)
{
    kiriSheetDef def = DefaultSheet();
    OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
    def.material.poissonsRatio = 0.0f;
    def.material.airDamping = 2.0f;
    def.material.youngsModulus = d->youngsModulus > 0.0f ? d->youngsModulus : def.material.youngsModulus;
    def.gridResolution = 80;
    def.frameCount = def.maxFrames = d->frames;
    def.model = d->model;
    def.planar = d->planar;
    def.sleepSpeed = 0.0f;
    return def;
}

static void Hold(Strip* s, int32_t frame)
{
    kiriFrameState state = World_FrameState(s->host.world, s->frames[frame]);
    OK(kiriFrame_Hold(s->host.world, s->frames[frame], state.position, state.rotation));
}

static void Strip_StartWith(Strip* s, const StripDef* d, const float gravity[3], int timeStepping)
{
    float sites[2 * 64];
    kiriSheetDef def = DefOfStrip(d);
    def.timeStepping = timeStepping;
    Host_Start(&s->host);
    s->host.every = 100;
    OK(kiriWorld_SetGravity(s->host.world, gravity));
    for (int i = 0; i < d->frames; ++i) {
        sites[2 * i] = Length * ((float)i + 0.5f) / (float)d->frames;
        sites[2 * i + 1] = 0.5f * Width;
    }
    def.framePoints = sites;
    s->sheet = Host_AddRectangle(&s->host, &def, Length, Width, 80, 8);
    OK(kiriSheet_GetFrames(s->host.world, s->sheet, s->frames, 64, &s->frameCount));
    assert_int_equal(s->frameCount, d->frames);
    Hold(s, 0);
}

static void Strip_Start(Strip* s, const StripDef* d, const float gravity[3])
{
    Strip_StartWith(s, d, gravity, KIRI_TIME_STEPPING_SECOND_ORDER);
}

/* ---- Torques ----------------------------------------------------------------------------------------------------- */

/* The bending stiffness of the strip out of its plane, or in it, over the length between the outermost frames. */
static double BendingStiffness(const StripDef* d)
{
    kiriSheetDef def = DefOfStrip(d);
    double w = Width, h = def.material.thickness;
    double I = d->planar ? h * w * w * w / 12.0 : w * h * h * h / 12.0;
    return (double)def.material.youngsModulus * I / ((double)Length * (d->frames - 1) / d->frames);
}

/* By how much the tip has turned when it has come to rest under a torque that should turn it by `angle`. */
static double TipAngle(const StripDef* d, double angle, double hertz, double seconds)
{
    Strip s;
    Strip_Start(&s, d, noVector);
    float moment = (float)(angle * BendingStiffness(d)), torque[3] = { 0.0f, 0.0f, 0.0f };
    torque[d->planar ? 2 : 1] = d->planar ? moment : -moment;
    for (int tick = 0; tick < (int)(seconds * hertz); ++tick) {
        OK(kiriFrame_ApplyForce(s.host.world, s.frames[d->frames - 1], noVector, torque));
        OK(Host_Tick(&s.host, (float)(1.0 / hertz), 1));
    }
    kiriFrameState tip = World_FrameState(s.host.world, s.frames[d->frames - 1]);
    Host_Stop(&s.host);
    return atan2(tip.rotation[d->planar ? 1 : 2], tip.rotation[0]);
}

static void AssertTurns(const StripDef* d, double angle, double hertz, double tolerance)
{
    double turned = TipAngle(d, angle, hertz, 6.0);
    print_message("model %d%s, %2d frames, %3.0f Hz: the tip turned by %.4f of %.2f rad\n", d->model,
                  d->planar ? ", planar" : "", d->frames, hertz, turned, angle);
    if (!(fabs(turned - angle) <= tolerance * angle)) {
        fail_msg("%d frames, %g Hz: %g is not %g rad", d->frames, hertz, turned, angle);
    }
}

/* A torque acts through the objective, as other forces do, and not on the free turn over the step: with dt^2 torque /
   inertia far above a turn (some hundred with 17 frames at 60 Hz) that one would wrap around. */
TEST(TorqueArrives)
{
    const int frames[3] = { 5, 9, 17 };
    const double hertz[3] = { 60.0, 120.0, 480.0 };
    for (int k = 0; k < 9; ++k) {
        StripDef d = { frames[k / 3], KIRI_MODEL_LINKS, 0, 0.0f };
        AssertTurns(&d, 0.5, hertz[k % 3], 0.01);
    }
}

/* Affine frames, whose normals the membrane keeps; and in the plane of the sheet, rigid and affine ones. The strip is
   soft enough for the plane, and one region wide: affine ones bend a little too easily in it. */
TEST(TorqueArrivesInOtherSheets)
{
    const StripDef defs[3] = { { 9, KIRI_MODEL_AFFINE, 0, 3e8f },
                               { 9, KIRI_MODEL_LINKS, 1, 1e5f },
                               { 9, KIRI_MODEL_AFFINE, 1, 1e5f } };
    const double tolerances[3] = { 0.01, 0.01, 0.04 };
    for (int k = 0; k < 3; ++k) {
        AssertTurns(&defs[k], 0.3, 60.0, tolerances[k]);
    }
}

/* At rest under a steady torque the links give as much as the torque takes: no step is taken anew. */
TEST(TorqueAtRest)
{
    for (int frames = 5; frames <= 17; frames += 6) {
        const StripDef d = { frames, KIRI_MODEL_LINKS, 0, 0.0f };
        const float torque[3] = { 0.0f, (float)(-0.5 * BendingStiffness(&d)), 0.0f };
        Strip s;
        Strip_Start(&s, &d, noVector);
        for (int tick = 0; tick < 720; ++tick) {
            OK(kiriFrame_ApplyForce(s.host.world, s.frames[frames - 1], noVector, torque));
            OK(Host_Tick(&s.host, 1.0f / 60.0f, 1));
            kiriProfile profile = World_Profile(s.host.world);
            assert_true(tick < 600 || profile.systemsSolved == 2);
        }
        Host_Stop(&s.host);
    }
}

/* ---- Motion that lasts ------------------------------------------------------------------------------------------- */

/* A strip that hangs from pins at its upper corners, set swinging by a spin about the line of the pins. */
typedef struct Pendulum {
    Strip strip;
    kiriPin pins[2];
} Pendulum;

typedef struct Swing {
    int timeStepping, substeps, iterations;
    bool uneven; /* ticks of other lengths, up to 8 times, and other numbers of substeps */
    double spin; /* rad/s */
} Swing;

static void PinTop(Pendulum* p, int k)
{
    kiriPinDef def = DefaultPin();
    def.restPoint[0] = 0.001f;
    def.restPoint[1] = def.target[1] = k == 0 ? 0.001f : Width - 0.001f;
    def.target[2] = -def.restPoint[0];
    OK(kiriCreatePin(p->strip.host.world, p->strip.sheet, &def, &p->pins[k]));
}

static void Kick(Pendulum* p, double spin)
{
    const float dt = 1e-4f;
    kiriWorld* world = p->strip.host.world;
    for (int32_t i = 0; i < p->strip.frameCount; ++i) {
        kiriFrameState state = World_FrameState(world, p->strip.frames[i]);
        double size = (double)Length / p->strip.frameCount, inertia = (double)state.mass * size * size / 12.0;
        float force[3] = { -state.mass * (float)spin * state.position[2] / dt, 0.0f, 0.0f };
        float torque[3] = { 0.0f, (float)(-inertia * spin) / dt, 0.0f };
        OK(kiriFrame_ApplyForce(world, p->strip.frames[i], force, torque));
    }
    OK(Host_Tick(&p->strip.host, dt, 1));
}

static void Pendulum_Start(Pendulum* p, const Swing* swing)
{
    const StripDef d = { .frames = 9 };
    kiriSheetDef def = DefOfStrip(&d);
    float sites[18];
    Host_Start(&p->strip.host);
    p->strip.host.every = 100;
    def.material.airDamping = def.material.flexDamping = 0.0f;
    def.axisU[0] = 0.0f;
    def.axisU[2] = -1.0f;
    def.gridResolution = 40;
    def.iterations = swing->iterations;
    def.timeStepping = swing->timeStepping;
    for (int i = 0; i < 9; ++i) {
        sites[2 * i] = Length * ((float)i + 0.5f) / 9.0f;
        sites[2 * i + 1] = 0.5f * Width;
    }
    def.framePoints = sites;
    p->strip.sheet = Host_AddRectangle(&p->strip.host, &def, Length, Width, 40, 10);
    OK(kiriSheet_GetFrames(p->strip.host.world, p->strip.sheet, p->strip.frames, 64, &p->strip.frameCount));
    PinTop(p, 0);
    PinTop(p, 1);
    Kick(p, swing->spin);
}

/* Above where it hangs straight, J. */
static double Energy(const Pendulum* p)
{
    kiriTotals t = Host_Totals(&p->strip.host, p->strip.sheet);
    return t.kineticEnergy + t.elasticEnergy + t.mass * 9.81 * (t.center[2] + 0.5 * (double)Length);
}

/* Ticks for so long; returns the share of the energy after the first second that is left. */
static double EnergyLeft(const Swing* swing, double seconds)
{
    Pendulum p;
    uint32_t seed = 1234567u;
    double first = 0.0, time = 0.0;
    Pendulum_Start(&p, swing);
    while (time < seconds) {
        double dt = 1.0 / 60.0;
        int32_t substeps = swing->substeps;
        if (swing->uneven) {
            dt *= pow(8.0, RandomBetween(&seed, -0.5, 0.5));
            substeps = 1 + (int32_t)(Random(&seed) % 4);
        }
        OK(Host_Tick(&p.strip.host, (float)dt, substeps));
        time += dt;
        first = first == 0.0 && time >= 1.0 ? Energy(&p) : first;
    }
    double left = Energy(&p) / first;
    Host_Stop(&p.strip.host);
    print_message("%s, %d substeps%s, %d iterations: %.2f %% of the energy left after %g s\n",
                  swing->timeStepping == KIRI_TIME_STEPPING_EULER ? "backward Euler" : "second order", swing->substeps,
                  swing->uneven ? ", uneven" : "", swing->iterations, 100.0 * left, seconds);
    return left;
}

TEST(SwingLasts)
{
    const Swing two = { 0, 2, 1, false, 1.5 }, four = { 0, 4, 1, false, 1.5 }, euler = { 1, 2, 1, false, 1.5 };
    const Swing uneven = { 0, 0, 1, true, 1.5 }, more = { 0, 0, 2, true, 1.5 };
    double left = EnergyLeft(&two, 10.0), finer = EnergyLeft(&four, 10.0);
    assert_true(left > 0.95 && left < 1.0 && finer > 0.99 && finer < 1.0);
    assert_true(EnergyLeft(&euler, 10.0) < 0.05);
    double rough = EnergyLeft(&uneven, 10.0), iterated = EnergyLeft(&more, 10.0);
    assert_true(rough > 0.7 && rough < 1.0 && iterated > 0.7 && iterated < 1.0);
}

/* ---- Taut cloth -------------------------------------------------------------------------------------------------- */

/* Lets a cotton of many frames hang by two corners. Returns the systems of a substep; positions: after the last tick. */
static double HangCloth(int32_t frames, int32_t iterations, float* positions, int32_t* vertices)
{
    enum { TICKS = 100 };
    double systems = 0.0;
    START_HOST(host);
    host.every = TICKS;
    kiriSheetDef def = DefaultSheet();
    OK(kiriGetMaterial(KIRI_MATERIAL_COTTON, &def.material));
    def.frameCount = def.maxFrames = frames;
    def.gridResolution = 64;
    def.iterations = iterations;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 24, 24);
    Host_Pin(&host, sheet, 0.0f, 1.0f, 0.0f, 1.0f, 0.0f);
    Host_Pin(&host, sheet, 1.0f, 1.0f, 1.0f, 1.0f, 0.0f);
    for (int32_t tick = 0; tick < TICKS; ++tick) {
        OK(Host_Tick(&host, 1.0f / 60.0f, 2));
        systems += World_Profile(host.world).systemsSolved / (2.0 * TICKS);
    }
    kiriMesh mesh = Host_Mesh(&host, sheet);
    *vertices = mesh.vertexCount;
    assert_true(mesh.vertexCount <= 1000);
    memcpy(positions, mesh.positions, sizeof(float) * 3 * (size_t)mesh.vertexCount);
    Host_Stop(&host);
    return systems;
}

/* Two systems a substep are enough for cloth under tension: it hangs where eight systems put it. */
FIGURE(TautClothConverges)
{
    for (int32_t frames = 144; frames <= 272; frames += 128) {
        static float few[3000], many[3000];
        int32_t vertices, same;
        double sum = 0.0, systems = HangCloth(frames, 2, few, &vertices);
        HangCloth(frames, 8, many, &same);
        for (int32_t i = 0; i < 3 * vertices; ++i) {
            sum += ((double)few[i] - many[i]) * ((double)few[i] - many[i]);
        }
        double off = sqrt(sum / vertices);
        print_message("%d frames: %.2f systems a substep, %.1f mm from eight\n", (int)frames, systems, 1e3 * off);
        assert_true(vertices == same && systems < 2.2 && off < 0.03);
    }
}

/* ---- Order ------------------------------------------------------------------------------------------------------- */

/* The tip of a cantilever that was let go 0.4 s ago, as seen by the tip's frame. */
static void Sag(int timeStepping, int substeps, double tip[3])
{
    Strip s;
    const StripDef d = { .frames = 5, .youngsModulus = 2e9f };
    const float down[3] = { 0.0f, 0.0f, -9.81f };
    Strip_StartWith(&s, &d, down, timeStepping);
    Host_Ticks(&s.host, 24, 1.0f / 60.0f, substeps);
    kiriFrameState state = World_FrameState(s.host.world, s.frames[4]);
    for (int k = 0; k < 3; ++k) {
        tip[k] = (double)state.position[k];
    }
    Host_Stop(&s.host);
}

static double SagError(int timeStepping, int substeps, const double exact[3])
{
    double tip[3];
    Sag(timeStepping, substeps, tip);
    double error = sqrt((tip[0] - exact[0]) * (tip[0] - exact[0]) + (tip[2] - exact[2]) * (tip[2] - exact[2]));
    print_message("%s, %3d substeps: the tip is off by %.2e m\n",
                  timeStepping == KIRI_TIME_STEPPING_EULER ? "backward Euler" : "second order", substeps, error);
    return error;
}

TEST(Order)
{
    double exact[3];
    Sag(KIRI_TIME_STEPPING_SECOND_ORDER, 64, exact);
    double coarse = SagError(KIRI_TIME_STEPPING_SECOND_ORDER, 2, exact);
    double fine = SagError(KIRI_TIME_STEPPING_SECOND_ORDER, 4, exact);
    double euler = SagError(KIRI_TIME_STEPPING_EULER, 4, exact);
    assert_true(fine < 0.35 * coarse && fine < 0.1 * euler);
}

/* ---- A slit that grows ------------------------------------------------------------------------------------------- */

/* While a blade moves up a swinging strip each tick commits new weights; energy stays. */
static double EnergyLeftBesideSlit(int timeStepping)
{
    const Swing swing = { timeStepping, 2, 2, false, 1.5 };
    Pendulum p;
    kiriCut cut = 0;
    double first = 0.0;
    const float start[2] = { 1.05f * Length, 0.5f * Width };
    Pendulum_Start(&p, &swing);
    OK(kiriBeginCut(p.strip.host.world, p.strip.sheet, start, &cut));
    for (int tick = 0; tick < 300; ++tick) {
        const float to[2] = { Length * (1.0f - 0.8f * (float)(tick - 60) / 240.0f), 0.5f * Width };
        if (tick >= 60) {
            OK(kiriCut_Extend(p.strip.host.world, cut, to, 1));
        }
        OK(Host_Tick(&p.strip.host, 1.0f / 60.0f, 2));
        first = tick == 59 ? Energy(&p) : first;
    }
    double left = Energy(&p) / first;
    Host_Stop(&p.strip.host);
    print_message("%s, a slit grows: %.1f %% of the energy left\n",
                  timeStepping == KIRI_TIME_STEPPING_EULER ? "backward Euler" : "second order", 100.0 * left);
    return left;
}

TEST(SlitGrows)
{
    double left = EnergyLeftBesideSlit(KIRI_TIME_STEPPING_SECOND_ORDER);
    assert_true(left > 0.8 && left < 1.02);
    assert_true(EnergyLeftBesideSlit(KIRI_TIME_STEPPING_EULER) < 0.5);
}

/* ---- History ----------------------------------------------------------------------------------------------------- */
