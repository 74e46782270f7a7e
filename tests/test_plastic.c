/* Plastic bending against the law of a section: the moment is c up to c = 1, then 3/2 - 1 / (2 c^2); c is the curvature over
   the curvature at which the surface yields. */
#include "host.h"

static const double Length = 0.03, Width = 0.006, Thickness = 1e-4, Young = 7e10, Yield = 1e8;
static const float Dt = 1.0f / 60.0f;

/* A strip along u, clamped at both ends. Its frames are in a row, or where a seed above 0 puts them. */
typedef struct Strip {
    Host host;
    kiriSheet sheet;
    kiriPin clamps[2];
    int32_t frames;
} Strip;

static void Strip_Start(Strip* s, int32_t frames, double yieldStress, double hardening, uint32_t seed)
{
    const float ends[2][2][2] = { { { 0.0f, 0.0f }, { 0.0f, (float)Width } },
                                  { { (float)Length, 0.0f }, { (float)Length, (float)Width } } };
    float points[2 * 32];
    kiriSheetDef def = DefaultSheet();
    memset(s, 0, sizeof(*s));
    Host_Start(&s->host);
    s->host.every = 100;
    World_StopGravity(s->host.world);
    for (int32_t i = 0; i < frames; ++i) {
        double u = seed > 0 ? RandomBetween(&seed, 0.25, 0.75) : 0.5, v = seed > 0 ? RandomBetween(&seed, 0.2, 0.8) : 0.5;
        points[2 * i] = (float)(Length * (i + u) / frames);
        points[2 * i + 1] = (float)(v * Width);
    }
    def.material = (kiriMaterial){ (float)Young, 0.0f, (float)Thickness, 2700.0f, 1.0f, 1e-4f, (float)yieldStress,
                                   (float)hardening, 0.0f, 0, { 0.0f } };
    def.gridResolution = 80;
    def.frameCount = s->frames = frames;
    def.framePoints = points;
    def.sleepSpeed = 0.0f;
    OK(kiriCreateRectangle(s->host.world, (float)Length, (float)Width, 60, 12, &def, &s->sheet));
    for (int k = 0; k < 2; ++k) {
        OK(kiriSheet_ClampLine(s->host.world, s->sheet, ends[k][0], ends[k][1], &s->clamps[k]));
    }
}

static kiriFrameState Strip_End(const Strip* s, double from, double to)
{
    kiriFrame frames[128];
    kiriFrameState last = { 0 };
    int32_t count = World_GetFrames(s->host.world, s->sheet, frames, 128);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState state = World_FrameState(s->host.world, frames[i]);
        bool isLast = state.restPoint[1] > from && state.restPoint[1] < to && state.restPoint[0] > last.restPoint[0];
        last = isLast ? state : last;
    }
    return last;
}

/* Bends the strip to an arc of a curvature by its second clamp, in this number of ticks. Returns the work of the clamp. */
static double Strip_Bend(Strip* s, double from, double to, int32_t ticks)
{
    double work = 0.0, was[3] = { 0.0, 0.0, 0.0 }; /* angle, x and z of the clamp */
    for (int32_t t = 0; t <= ticks; ++t) {
        double k = from + (to - from) * t / ticks, turn = k * Length, part = fabs(turn) < 1e-9 ? 1.0 : 0.0;
        double now[3] = { turn, part > 0.0 ? Length : sin(turn) / k, part > 0.0 ? 0.0 : (1.0 - cos(turn)) / k };
        float c = (float)cos(turn), n = (float)sin(turn);
        const float at[3] = { (float)now[1], (float)(0.5 * Width), (float)now[2] };
        const float rotation[9] = { c, 0.0f, n, 0.0f, 1.0f, 0.0f, -n, 0.0f, c };
        double force[3], torque[3];
        if (t > 0) {
            OK(kiriPin_SetPose(s->host.world, s->clamps[1], at, rotation));
            OK(Host_Tick(&s->host, Dt, 2));
            OK(kiriPin_GetReaction(s->host.world, s->clamps[1], force, torque));
            work += -torque[1] * (now[0] - was[0]) + force[0] * (now[1] - was[1]) + force[2] * (now[2] - was[2]);
        }
        memcpy(was, now, sizeof(was));
    }
    return work;
}

static void Strip_Rest(Strip* s, int32_t ticks)
{
    Host_Ticks(&s->host, ticks, Dt, 2);
}

static void Strip_Cut(const Strip* s, double u, double v, double toU, double toV)
{
    kiriCut cut;
    OK(kiriSheet_Cut(s->host.world, s->sheet, (float[]){ (float)u, (float)v, (float)toU, (float)toV }, 2, &cut));
}

static double TurnOf(const kiriFrameState* state)
{
    return atan2(-(double)state->rotation[6], (double)state->rotation[8]);
}

/* Returns the mean curvature between the first and the last frame of the material with v in a range. */
static double Curvature(const Host* host, kiriSheet sheet, double from, double to)
{
    kiriFrame frames[128];
    kiriFrameState state, first = { 0 }, last = { 0 };
    int32_t count, seen = 0;
    OK(kiriSheet_GetFrames(host->world, sheet, frames, 128, &count));
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_GetState(host->world, frames[i], &state));
        if (state.restPoint[1] > from && state.restPoint[1] < to) {
            first = seen == 0 || state.restPoint[0] < first.restPoint[0] ? state : first;
            last = seen == 0 || state.restPoint[0] > last.restPoint[0] ? state : last;
            ++seen;
        }
    }
    assert_true(seen > 1);
    return fabs(TurnOf(&last) - TurnOf(&first)) / ((double)last.restPoint[0] - (double)first.restPoint[0]);
}

static double MomentOf(double c, double hardening)
{
    return c <= 1.0 ? c : (1.0 - hardening) * (1.5 - 0.5 / (c * c)) + hardening * c;
}

static double YieldCurvature(void)
{
    return 2.0 * Yield / (Young * Thickness);
}

/* Curvature that is left when a strip that was bent to a curvature is let go. */
static double Residual(double curvature, double hardening)
{
    double most = YieldCurvature();
    return curvature - most * MomentOf(curvature / most, hardening);
}

static void CheckSpringback(int32_t frames, double radius, double hardening, int32_t ticks, double tolerance)
{
    Strip s;
    double force[3], torque[3], ratio = 1.0 / (radius * YieldCurvature());
    double moment = Young * pow(Thickness, 3.0) / 12.0 * YieldCurvature() * Width;
    Strip_Start(&s, frames, Yield, hardening, 0);
    Strip_Bend(&s, 0.0, 1.0 / radius, ticks);
    Strip_Rest(&s, 30);
    OK(kiriPin_GetReaction(s.host.world, s.clamps[1], force, torque));
    double theory = Residual(1.0 / radius, hardening);
    if (ticks >= 30) {
        assert_true(fabs(fabs(torque[1]) / (moment * MomentOf(ratio, hardening)) - 1.0) < 2e-3);
    }
    OK(kiriDestroyPin(s.host.world, s.clamps[1]));
    Strip_Rest(&s, 200);
    double curvature = Curvature(&s.host, s.sheet, 0.0, Width);
    print_message("%d frames, R %.0f mm, %d ticks: %.3f 1/m, theory %.3f (%+.2f %%)\n", (int)frames, 1e3 * radius,
                  (int)ticks, curvature, theory, theory > 0.0 ? 100.0 * (curvature / theory - 1.0) : 0.0);
    assert_true(fabs(curvature - theory) <= tolerance * theory + 1e-3);
    Host_Stop(&s.host);
}

TEST(Springback)
{
    const int32_t frames[3] = { 5, 9, 17 };
    const double tolerance[3] = { 5e-3, 1e-3, 5e-4 };
    for (int k = 0; k < 3; ++k) {
        CheckSpringback(frames[k], 0.02, 0.0, 60, tolerance[k]);
        CheckSpringback(frames[k], 0.01, 0.0, 60, tolerance[k]);
        CheckSpringback(frames[k], 0.01, 0.0, 5, 0.01);
    }
    CheckSpringback(9, 0.02, 0.0, 5, 0.01);
    CheckSpringback(9, 0.01, 0.2, 60, 2e-3);
    CheckSpringback(9, 0.05, 0.0, 60, 0.0); /* below the yield curvature all of it springs back */
}

/* Frames anywhere: how far the strip springs back, and a cut along it, hardly depend on them. */
TEST(AnyFrames)
{
    double theory = Residual(100.0, 0.0);
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        Strip s;
        Strip_Start(&s, seed % 2 == 0 ? 9 : 14, Yield, 0.0, seed);
        Strip_Bend(&s, 0.0, 100.0, 60);
        OK(kiriDestroyPin(s.host.world, s.clamps[1]));
        Strip_Rest(&s, 200);
        kiriFrameState end = Strip_End(&s, 0.0, Width);
        double bent = fabs(TurnOf(&end)) / (double)end.restPoint[0];
        Strip_Cut(&s, -0.001, 0.0028, Length + 0.001, 0.0033);
        Strip_Rest(&s, 200);
        for (int half = 0; half < 2; ++half) {
            end = Strip_End(&s, half == 0 ? 0.0 : 0.0033, half == 0 ? 0.0028 : Width);
            double now = fabs(TurnOf(&end)) / (double)end.restPoint[0];
            assert_true(fabs(now / theory - 1.0) < 0.1);
        }
        assert_true(fabs(bent / theory - 1.0) < 0.03);
        Host_Stop(&s.host);
    }
}

/* Bends a strip to and fro. Its elastic energy is the energy of the elastic curvature, and the rest of the work is what flow
   takes: by the law, whose reach grows with all that has flowed. */
TEST(Energy)
{
    const double goals[4] = { 100.0, 0.0, -60.0, 0.0 };
    double stiffness = Young * pow(Thickness, 3.0) / 12.0 * Width * Length, most = YieldCurvature();
    double elastic = 0.0, flowed = 0.0, reach = 1.0, work = 0.0, lost = 0.0, at = 0.0;
    Strip s;
    Strip_Start(&s, 9, Yield, 0.0, 0);
    for (int leg = 0; leg < 4; ++leg) {
        enum { PARTS = 20000 };
        double step = (goals[leg] - at) / PARTS;
        for (int n = 0; n < PARTS; ++n) {
            double trial = elastic + step, c = fabs(trial) / most + flowed, g = MomentOf(c, 0.0), next = trial;
            if (c > reach) {
                next = trial > 0.0 ? most * g : -most * g;
                flowed += (fabs(trial) - fabs(next)) / most;
                reach = c;
            }
            lost += stiffness * 0.5 * (elastic + next) * (step - (next - elastic));
            elastic = next;
        }
        work += Strip_Bend(&s, at, goals[leg], 120);
        at = goals[leg];
        kiriTotals totals = World_Totals(s.host.world, s.sheet);
        double stored = 0.5 * stiffness * elastic * elastic, taken = work - totals.elasticEnergy;
        print_message("to %.0f 1/m: elastic %.4e J (law %.4e), taken %.4e J (law %.4e)\n", at, totals.elasticEnergy, stored,
                      taken, lost);
        assert_true(fabs(totals.elasticEnergy - stored) < 0.01 * stored + 1e-3 * lost);
        assert_true(fabs(taken - lost) < 0.015 * lost);
    }
    Host_Stop(&s.host);
}

/* A material that never reaches its yield stress moves as an elastic one, bit for bit: through a cut, too. */
TEST(StrongIsElastic)
{
    Strip s[2];
    for (int k = 0; k < 2; ++k) {
        Strip_Start(&s[k], 9, k == 0 ? 0.0 : 1e12, 0.1, 0);
        Strip_Bend(&s[k], 0.0, 60.0, 20);
        Strip_Cut(&s[k], 0.012, -0.001, 0.016, 0.004);
        OK(kiriDestroyPin(s[k].host.world, s[k].clamps[1]));
        Strip_Rest(&s[k], 40);
    }
    kiriMesh mesh[2];
    for (int k = 0; k < 2; ++k) {
        OK(kiriSheet_GetMesh(s[k].host.world, s[k].sheet, &mesh[k]));
    }
    assert_int_equal(mesh[0].vertexCount, mesh[1].vertexCount);
    assert_memory_equal(mesh[0].positions, mesh[1].positions, 3 * sizeof(float) * (size_t)mesh[0].vertexCount);
    Host_Stop(&s[0].host);
    Host_Stop(&s[1].host);
}

/* A strip that was bent for good is cut along its length, where one half has no frames; then the half leaves; then the world is
   loaded. All keep the curvature. */
TEST(PiecesKeepTheirShape)
{
    Strip s;
    Strip_Start(&s, 9, Yield, 0.0, 0);
    Strip_Bend(&s, 0.0, 100.0, 60);
    OK(kiriDestroyPin(s.host.world, s.clamps[1]));
    Strip_Rest(&s, 200);
    double theory = Residual(100.0, 0.0), cutAt = 0.0033;
    Strip_Cut(&s, -0.001, cutAt, Length + 0.001, cutAt);
    Strip_Rest(&s, 120);
    kiriCounts counts = World_Counts(s.host.world, s.sheet);
    assert_int_equal(counts.pieces, 2);
    assert_true(counts.frames > 12);
    assert_true(fabs(Curvature(&s.host, s.sheet, 0.0, cutAt) / theory - 1.0) < 5e-3);
    assert_true(fabs(Curvature(&s.host, s.sheet, cutAt, Width) / theory - 1.0) < 5e-3);
    for (int half = 0; half < 2; ++half) { /* and so they do at the clamp, where one half has new frames */
        kiriFrameState end = Strip_End(&s, half == 0 ? 0.0 : cutAt, half == 0 ? cutAt : Width);
        assert_true(fabs(fabs(TurnOf(&end)) / (theory * (double)end.restPoint[0]) - 1.0) < 5e-3);
    }

    kiriFrame frames[128], leaver = 0;
    kiriSheet part = 0;
    int32_t count = World_GetFrames(s.host.world, s.sheet, frames, 128);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState state = World_FrameState(s.host.world, frames[i]);
        leaver = state.restPoint[1] > cutAt ? frames[i] : leaver;
    }
    OK(kiriFrame_DetachPiece(s.host.world, leaver, &part));
    Strip_Rest(&s, 2);
    SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(s.host.world, kiriWorld_Save);
    Strip_Rest(&s, 120);
    uint64_t hash = Host_Hash(&s.host);
    assert_true(fabs(Curvature(&s.host, s.sheet, 0.0, Width) / theory - 1.0) < 5e-3);
    assert_true(fabs(Curvature(&s.host, part, 0.0, Width) / theory - 1.0) < 5e-3);
    OK(kiriWorld_Load(s.host.world, bytes.data, bytes.size));
    Strip_Rest(&s, 120);
    assert_true(Host_Hash(&s.host) == hash);
    Host_Stop(&s.host);
}

/* The material may begin to yield, and become elastic again: the bend stays. */
TEST(MaterialChanges)
{
    Strip s;
    Strip_Start(&s, 9, 0.0, 0.0, 0);
    Strip_Bend(&s, 0.0, 30.0, 10);
    kiriSheetSettings settings = World_Settings(s.host.world, s.sheet);
    settings.material.yieldStress = (float)Yield;
    OK(kiriSheet_SetSettings(s.host.world, s.sheet, &settings));
    Strip_Bend(&s, 30.0, 100.0, 60);
    settings.material.yieldStress = 0.0f;
    settings.fadeTime = 0.0f;
    OK(kiriSheet_SetSettings(s.host.world, s.sheet, &settings));
    OK(kiriDestroyPin(s.host.world, s.clamps[1]));
    Strip_Rest(&s, 200);
    double curvature = Curvature(&s.host, s.sheet, 0.0, Width);
    assert_true(fabs(curvature / Residual(100.0, 0.0) - 1.0) < 5e-3);
    Host_Stop(&s.host);
}

/* A strip takes its rest curvature wherever its frames are, keeps it in both halves of a cut, and becomes flat again. */
TEST(RestCurvature)
{
    for (uint32_t seed = 0; seed < 5; ++seed) {
        Strip s;
        Strip_Start(&s, seed % 2 == 0 ? 9 : 14, seed == 4 ? Yield : 0.0, 0.0, seed);
        kiriSheetSettings settings = World_Settings(s.host.world, s.sheet);
        OK(kiriDestroyPin(s.host.world, s.clamps[1]));
        for (int part = 0; part < 3; ++part) {
            double cut = 0.0033, rest = part < 2 ? 40.0 : 0.0;
            settings.material.restCurvature[0] = (float)rest;
            OK(kiriSheet_SetSettings(s.host.world, s.sheet, &settings));
            if (part == 1) {
                Strip_Cut(&s, -0.001, cut, Length + 0.001, cut);
            }
            Strip_Rest(&s, 200);
            for (int half = 0; half < 2; ++half) {
                kiriFrameState end = Strip_End(&s, part > 0 && half > 0 ? cut : 0.0, part > 0 && half == 0 ? cut : Width);
                assert_true(fabs(TurnOf(&end) - rest * (double)end.restPoint[0]) < 1e-3);
            }
        }
        Host_Stop(&s.host);
    }
}

/* Carries all frames of a square sheet, in rows, to a cylinder that is bent along the direction (c, a). Returns its elastic
   energy. */
static double EnergyOfRoll(double c, double a, double curvature, double yieldStress)
{
    enum { SIDE = 8, TICKS = 40 };
    const double size = 0.08;
    float points[2 * SIDE * SIDE];
    kiriFrame frames[SIDE * SIDE];
    kiriSheetDef def = DefaultSheet();
    START_HOST(host);
    host.every = 100;
    World_StopGravity(host.world);
    for (int i = 0; i < SIDE * SIDE; ++i) {
        points[2 * i] = (float)(size * (i % SIDE + 0.5) / SIDE);
        points[2 * i + 1] = (float)(size * (i / SIDE + 0.5) / SIDE);
    }
    def.material = (kiriMaterial){ (float)Young, 0.0f, (float)Thickness, 2700.0f, 1.0f, 1e-3f, (float)yieldStress,
                                   0.0f, 0.0f, 0, { 0.0f } };
    def.gridResolution = 48;
    def.frameCount = SIDE * SIDE;
    def.framePoints = points;
    kiriSheet sheet = World_AddRectangle(host.world, (float)size, (float)size, 32, 32, &def);
    int32_t count = World_GetFrames(host.world, sheet, frames, SIDE * SIDE);
    for (int t = 1; t <= TICKS; ++t) {
        for (int i = 0; i < count; ++i) {
            double u = (double)points[2 * i] - 0.5 * size, v = (double)points[2 * i + 1] - 0.5 * size;
            double bend = curvature * t / TICKS, s = c * u + a * v, w = c * v - a * u;
            double cosine = cos(bend * s), sine = sin(bend * s), x = sine / bend, z = (1.0 - cosine) / bend;
            const float at[3] = { (float)(c * x - a * w), (float)(a * x + c * w), (float)z };
            const double rotation[9] = { c * c * cosine + a * a, a * c * (cosine - 1.0), c * sine,
                                         a * c * (cosine - 1.0), a * a * cosine + c * c, a * sine,
                                         -c * sine,              -a * sine,              cosine };
            float columns[9];
            for (int k = 0; k < 9; ++k) {
                columns[k] = (float)rotation[k];
            }
            OK(kiriFrame_Hold(host.world, frames[i], at, columns));
        }
        OK(Host_Tick(&host, Dt, 2));
    }
    return World_Totals(host.world, sheet).elasticEnergy;
}

/* A sheet yields at the same curvature in whichever direction it is rolled. */
TEST(AnyDirection)
{
    const double curvature = 60.0, ratio = curvature / YieldCurvature();
    for (int k = 0; k < 3; ++k) {
        double a = k == 0 ? 0.0 : k == 1 ? 0.4 : sqrt(0.5), c = sqrt(1.0 - a * a);
        double elastic = EnergyOfRoll(c, a, curvature, 0.0), plastic = EnergyOfRoll(c, a, curvature, Yield);
        double moment = sqrt(plastic / elastic) * ratio, theory = MomentOf(ratio, 0.0);
        assert_true(fabs(moment / theory - 1.0) < 0.05);
    }
}
