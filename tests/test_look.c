/* What is seen of sheets whose frames the host holds on an arc: how blending strains and creases the surface. */
#include "host.h"

#include <math.h>

enum { FRAMES = 7, LENGTHWISE = 560 };

static const double LENGTH = 0.7, WIDTH = 0.1;

typedef struct Looks {
    double strain; /* of the edges along the strip, at worst */
    double crease; /* angle from edge to edge beyond the arc's own, at worst, in angles between frames */
} Looks;

/* Every 0.1 m a frame, and from frame to frame so many radians. */
static void HoldOnArc(const Host* host, kiriSheet sheet, double angle)
{
    kiriFrame frames[FRAMES];
    int32_t count;
    OK(kiriSheet_GetFrames(host->world, sheet, frames, FRAMES, &count));
    assert_int_equal(count, FRAMES);
    for (int i = 0; i < FRAMES; ++i) {
        kiriFrameState state;
        OK(kiriFrame_GetState(host->world, frames[i], &state));
        double radius = LENGTH / FRAMES / angle, turn = state.restPoint[0] / radius, c = cos(turn), s = sin(turn);
        const float position[3] = { (float)(radius * s), state.restPoint[1], (float)(radius * (1.0 - c)) };
        const float rotation[9] = { (float)c, 0.0f, (float)s, 0.0f, 1.0f, 0.0f, (float)-s, 0.0f, (float)c };
        OK(kiriFrame_Hold(host->world, frames[i], position, rotation));
    }
}

/* Along the middle line, from the first frame to the last. */
static Looks LookAlong(const kiriMesh* mesh, double angle)
{
    const int row = LENGTHWISE + 1, first = LENGTHWISE / FRAMES / 2, last = LENGTHWISE - first;
    double edge = LENGTH / LENGTHWISE, own = angle * FRAMES / LENGTHWISE, before = 0.0;
    Looks looks = { 0.0, 0.0 };
    for (int i = first; i < last; ++i) {
        const float* p = mesh->positions + 3 * (row + i);
        double x = (double)p[3] - p[0], z = (double)p[5] - p[2], at = atan2(z, x);
        double turn = i > first ? at - before : own;
        turn -= turn > 3.0 ? 6.283185307179586 : 0.0; /* past the direction of -x */
        turn += turn < -3.0 ? 6.283185307179586 : 0.0;
        looks.strain = fmax(looks.strain, fabs(sqrt(x * x + z * z) / edge - 1.0));
        looks.crease = fmax(looks.crease, fabs(turn - own) / angle);
        before = at;
    }
    return looks;
}

static Looks LookAtArc(double angle, int32_t linear)
{
    Host host;
    float points[2 * FRAMES];
    for (int i = 0; i < FRAMES; ++i) {
        points[2 * i] = (float)((i + 0.5) * LENGTH / FRAMES);
        points[2 * i + 1] = 0.05f;
    }
    Host_Start(&host);
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.gridResolution = 280;
    def.frameCount = def.maxFrames = FRAMES;
    def.framePoints = points;
    def.paper.linearWeights = linear;
    kiriSheet sheet = Host_AddRectangle(&host, &def, (float)LENGTH, (float)WIDTH, LENGTHWISE, 2);
    HoldOnArc(&host, sheet, angle);
    OK(Host_Tick(&host, 0.01f, 1));
    kiriMesh mesh = Host_Mesh(&host, sheet);
    Looks looks = LookAlong(&mesh, angle);
    Host_Stop(&host);
    return looks;
}

/* Frames at an angle t on a circle. Linear weights stretch the surface beside a frame by 3/8 t^2, and crease it there by t
   within two cells, here four edges. With weights that are flat at the frames the stretch is half as much, and the
   curvature, over the circle's, at most 4 more. */
static void EasedWeightsLeaveNoCrease(void** state)
{
    (void)state;
    static const double angles[] = { 0.1, 0.3, 0.6, 1.0 };
    for (size_t k = 0; k < sizeof(angles) / sizeof(angles[0]); ++k) {
        double t = angles[k];
        Looks linear = LookAtArc(t, 1), eased = LookAtArc(t, 0);
        if (!(linear.strain > 0.3 * t * t && eased.strain < 0.2 * t * t && linear.crease > 0.15 &&
              eased.crease < 4.2 * FRAMES / LENGTHWISE)) {
            fail_msg("%.1f rad: strain %.4f %.4f, crease %.3f %.3f", t, linear.strain, eased.strain, linear.crease,
                     eased.crease);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(EasedWeightsLeaveNoCrease),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
