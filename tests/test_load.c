/* Clamps, hinges and loads: that they mean what they say, by the elastica and other independent results; reactions, by
   weight and momentum. */
#include "look.h"

#include "sheet/kiri_sheet.h"

#include <stdio.h>

#define STRIP_LENGTH 0.2
#define STRIP_WIDTH 0.05
#define STRIP_THICKNESS 5e-4
#define GRAVITY 9.81

/* ---- A strip of one row ------------------------------------------------------------------------------------------- */

enum { MOST_ALONG = 33 };

typedef struct Strip {
    double length, width, thickness, youngs, density;
    int along;
} Strip;

static kiriSheetDef StripDef(const Strip* strip, float points[2 * MOST_ALONG])
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
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
    kiriFrameState state;
    int32_t count;
    OK(kiriSheet_GetFrames(host->world, sheet, frames, MOST_ALONG, &count));
    OK(kiriFrame_GetState(host->world, frames[count - 1], &state));
    for (int a = 0; a < 3; ++a) {
        tip[a] = state.position[a] + (strip->length - state.restPoint[0]) * state.rotation[a];
    }
}

static void ClampStart(Host* host, kiriSheet sheet, const Strip* strip, kiriPin* clamp)
{
    const float from[2] = { 0.0f, 0.0f }, to[2] = { 0.0f, (float)strip->width };
    OK(kiriSheet_ClampLine(host->world, sheet, from, to, clamp));
}

/* ---- Heavy cantilever --------------------------------------------------------------------------------------------- */

/* Distance of the tip from the elastica's, by how far that goes. */
static double HeavyError(int along, double gamma, double x, double drop)
{
    Strip strip = { STRIP_LENGTH, STRIP_WIDTH, STRIP_THICKNESS, 0.0, 1000.0, along };
    strip.youngs = 12.0 * strip.density * GRAVITY * pow(strip.length, 3.0) / (gamma * pow(strip.thickness, 2.0));
    Host host;
    Host_Start(&host);
    kiriSheet sheet = AddStrip(&host, &strip);
    kiriPin clamp;
    ClampStart(&host, sheet, &strip, &clamp);
    host.every = 100;
    for (int i = 0; i < 300; ++i) {
        OK(Host_Tick(&host, 0.01f, 1));
    }
    double tip[3];
    TipOf(&host, sheet, &strip, tip);
    Host_Stop(&host);
    double dx = tip[0] / strip.length - x, dz = tip[2] / strip.length + drop;
    return sqrt(dx * dx + dz * dz) / drop;
}

static void TestHeavyCantilever(void** state)
{
    (void)state;
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

/* ---- End load ----------------------------------------------------------------------------------------------------- */

/* Sze, Liu, Lo 2004, section 3.1: how far the tip moves in and down under a shear force P at the end. */
static void TestEndLoad(void** state)
{
    (void)state;
    static const double cases[2][3] = { { 2.0, 1.604, 4.933 }, { 4.0, 3.286, 6.698 } };
    const Strip strip = { 10.0, 1.0, 0.1, 1.2e6, 0.1, 9 };
    for (int k = 0; k < 4; ++k) {
        Host host;
        Host_Start(&host);
        const double* expected = cases[k % 2];
        const float none[3] = { 0.0f, 0.0f, 0.0f }, down[3] = { 0.0f, 0.0f, (float)-expected[0] };
        const float tip[2] = { 10.0f, 0.5f }, from[2] = { 10.0f, 0.0f }, to[2] = { 10.0f, 1.0f };
        OK(kiriWorld_SetGravity(host.world, none));
        kiriSheet sheet = AddStrip(&host, &strip);
        kiriPin clamp;
        ClampStart(&host, sheet, &strip, &clamp);
        host.every = 100;
        for (int i = 0; i < 400; ++i) {
            OK(k < 2 ? kiriSheet_ApplyForce(host.world, sheet, tip, down, none)
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
        Host_Stop(&host);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestHeavyCantilever),
        cmocka_unit_test(TestEndLoad),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
