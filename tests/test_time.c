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
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
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
    kiriFrameState state;
    OK(kiriFrame_GetState(s->host.world, s->frames[frame], &state));
    OK(kiriFrame_Hold(s->host.world, s->frames[frame], state.position, state.rotation));
}

static void Strip_Start(Strip* s, const StripDef* d, const float gravity[3])
{
    float sites[2 * 64];
    kiriSheetDef def = DefOfStrip(d);
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

/* ---- Torques ----------------------------------------------------------------------------------------------------- */

static const float None[3] = { 0.0f, 0.0f, 0.0f };

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
    kiriFrameState tip;
    Strip_Start(&s, d, None);
    float moment = (float)(angle * BendingStiffness(d)), torque[3] = { 0.0f, 0.0f, 0.0f };
    torque[d->planar ? 2 : 1] = d->planar ? moment : -moment;
    for (int tick = 0; tick < (int)(seconds * hertz); ++tick) {
        OK(kiriFrame_ApplyForce(s.host.world, s.frames[d->frames - 1], None, torque));
        OK(Host_Tick(&s.host, (float)(1.0 / hertz), 1));
    }
    OK(kiriFrame_GetState(s.host.world, s.frames[d->frames - 1], &tip));
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
static void TestTorqueArrives(void** state)
{
    const int frames[3] = { 5, 9, 17 };
    const double hertz[3] = { 60.0, 120.0, 480.0 };
    (void)state;
    for (int k = 0; k < 9; ++k) {
        StripDef d = { frames[k / 3], KIRI_MODEL_LINKS, 0, 0.0f };
        AssertTurns(&d, 0.5, hertz[k % 3], 0.01);
    }
}

/* Affine frames, whose normals the membrane keeps; and in the plane of the sheet, rigid and affine ones. The strip is
   soft enough for the plane, and one region wide: affine ones bend a little too easily in it. */
static void TestTorqueArrivesInOtherSheets(void** state)
{
    const StripDef defs[3] = { { 9, KIRI_MODEL_AFFINE, 0, 3e8f },
                               { 9, KIRI_MODEL_LINKS, 1, 1e5f },
                               { 9, KIRI_MODEL_AFFINE, 1, 1e5f } };
    const double tolerances[3] = { 0.01, 0.01, 0.04 };
    (void)state;
    for (int k = 0; k < 3; ++k) {
        AssertTurns(&defs[k], 0.3, 60.0, tolerances[k]);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestTorqueArrives),
        cmocka_unit_test(TestTorqueArrivesInOtherSheets),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
