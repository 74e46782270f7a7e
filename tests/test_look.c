/* What is seen of sheets whose frames the host holds on an arc: how blending strains and creases the surface. */
#include "host.h"

#include <math.h>
#include <stdlib.h>

enum { FRAMES = 7, LENGTHWISE = 560 };

static const double LENGTH = 0.7, WIDTH = 0.1;

typedef struct Looks {
    double strain; /* of the edges along the strip, at worst */
    double crease; /* angle from edge to edge beyond the arc's own, at worst, in angles between frames */
    double away;   /* m: the farthest that a vertex is from the cylinder */
    double lean;   /* rad: the most that a normal leans from the normal of the cylinder */
    float row[3 * (LENGTHWISE + 1)]; /* positions along the middle line */
} Looks;

/* Every 0.1 m a frame, and from frame to frame so many radians. */
static void HoldOnArc(const Host* host, kiriSheet sheet, double angle)
{
    kiriFrame frames[FRAMES];
    int32_t count = World_GetFrames(host->world, sheet, frames, FRAMES);
    assert_int_equal(count, FRAMES);
    for (int i = 0; i < FRAMES; ++i) {
        kiriFrameState state = World_FrameState(host->world, frames[i]);
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
    Looks looks = { .strain = 0.0 };
    memcpy(looks.row, mesh->positions + 3 * row, sizeof(looks.row));
    double radius = LENGTH / FRAMES / angle;
    for (int i = first; i < last; ++i) {
        const float *p = mesh->positions + 3 * (row + i), *normal = mesh->normals + 3 * (row + i);
        double to = hypot(p[0], p[2] - radius), cosine = (normal[2] * (radius - p[2]) - normal[0] * p[0]) / to;
        looks.away = fmax(looks.away, fabs(to - radius));
        looks.lean = fmax(looks.lean, acos(fmin(cosine, 1.0)));
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

static Looks LookAtArc(double angle, int32_t linear, int32_t skinning)
{
    float points[2 * FRAMES];
    for (int i = 0; i < FRAMES; ++i) {
        points[2 * i] = (float)((i + 0.5) * LENGTH / FRAMES);
        points[2 * i + 1] = 0.05f;
    }
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 280;
    def.material.detail = 0; /* weights alone */
    def.frameCount = def.maxFrames = FRAMES;
    def.framePoints = points;
    def.paper.linearWeights = linear;
    def.skinning = skinning;
    kiriSheet sheet = Host_AddRectangle(&host, &def, (float)LENGTH, (float)WIDTH, LENGTHWISE, 2);
    HoldOnArc(&host, sheet, angle);
    OK(Host_Tick(&host, 0.01f, 1));
    kiriMesh mesh = Host_Mesh(&host, sheet);
    Looks looks = LookAlong(&mesh, angle);
    return looks;
}

/* Frames at an angle t on a circle. Linear weights stretch the surface beside a frame by 3/8 t^2, and crease it there
   by t within two cells, here four edges. With weights that are flat at the frames the stretch is half as much, and the
   curvature, over the circle's, at most 4 more. */
TEST(EasedWeightsLeaveNoCrease)
{
    static const double angles[] = { 0.1, 0.3, 0.6, 1.0 };
    for (size_t k = 0; k < sizeof(angles) / sizeof(angles[0]); ++k) {
        double t = angles[k];
        Looks linear = LookAtArc(t, 1, KIRI_SKINNING_LINEAR), eased = LookAtArc(t, 0, KIRI_SKINNING_LINEAR);
        if (!(linear.strain > 0.3 * t * t && eased.strain < 0.2 * t * t && linear.crease > 0.15 &&
              eased.crease < 4.2 * FRAMES / LENGTHWISE)) {
            fail_msg("%.1f rad: strain %.4f %.4f, crease %.3f %.3f", t, linear.strain, eased.strain, linear.crease,
                     eased.crease);
        }
    }
}

/* The same frames: a smooth surface is nearly the cylinder, a linear one is not. */
TEST(SmoothSurfacesAreRound)
{
    static const double angles[] = { 0.09, 0.26, 0.52 };
    for (size_t k = 0; k < sizeof(angles) / sizeof(angles[0]); ++k) {
        Looks flat = LookAtArc(angles[k], 0, KIRI_SKINNING_LINEAR), round = LookAtArc(angles[k], 0, KIRI_SKINNING_SMOOTH);
        if (!(flat.away > 20.0 * round.away && flat.lean > 4.0 * round.lean)) {
            fail_msg("%.2f rad: %g and %g m away, normals lean by %g and %g", angles[k], flat.away, round.away, flat.lean,
                     round.lean);
        }
    }
}

/* Creases: a patch bends by at most 0.2 rad, rms over its region, which is a sag of 9 mm, whatever its neighbors do. */
TEST(StrongBendsAreLimited)
{
    static const double angles[] = { 0.52, 1.26, 2.4 };
    for (size_t k = 0; k < sizeof(angles) / sizeof(angles[0]); ++k) {
        Looks flat = LookAtArc(angles[k], 0, KIRI_SKINNING_LINEAR), bent = LookAtArc(angles[k], 0, KIRI_SKINNING_SMOOTH);
        double sag = 0.0;
        for (int i = 0; i <= LENGTHWISE; ++i) {
            const float *a = &flat.row[3 * i], *b = &bent.row[3 * i];
            sag = fmax(sag, hypot(a[0] - b[0], a[2] - b[2]));
        }
        if (!(sag > 4e-3 && sag < 10e-3)) {
            fail_msg("%.2f rad: patches sag by %g m", angles[k], sag);
        }
    }
}

/* Frames that turn past back to back: patches sag to neither side there, so the visible surface does not jump. */
TEST(BackToBackIsSteady)
{
    static const double angles[2] = { 3.11, 3.17 };
    double sags[2][2 * (LENGTHWISE + 1)];
    for (int k = 0; k < 2; ++k) {
        Looks flat = LookAtArc(angles[k], 0, KIRI_SKINNING_LINEAR), bent = LookAtArc(angles[k], 0, KIRI_SKINNING_SMOOTH);
        for (int i = 0; i <= LENGTHWISE; ++i) {
            sags[k][2 * i] = bent.row[3 * i] - flat.row[3 * i];
            sags[k][2 * i + 1] = bent.row[3 * i + 2] - flat.row[3 * i + 2];
        }
    }
    for (int i = 0; i < 2 * (LENGTHWISE + 1); ++i) {
        if (!(fabs(sags[1][i] - sags[0][i]) < 3e-3)) {
            fail_msg("coordinate %d jumps by %g m", i, sags[1][i] - sags[0][i]);
        }
    }
}

/* ---- Lips ---- */

enum { SQUARES = 120 };

/* A square of 0.6 m with a slit from below to (0.3, end), `slant` being du / dv. Ahead of the slit the sheet lies flat,
   and the flaps beside it turn up and down. */
static kiriSheet SlitSheet(Host* host, double end, double slant)
{
    static const float points[8] = { 0.15f, 0.1f, 0.45f, 0.1f, 0.15f, 0.5f, 0.45f, 0.5f };
    const float slit[4] = { (float)(0.3 - slant * (end + 0.01)), -0.01f, 0.3f, (float)end };
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 30;
    def.frameCount = def.maxFrames = 4;
    def.framePoints = points;
    def.fadeTime = 0.0f;
    kiriSheet sheet = Host_AddRectangle(host, &def, 0.6f, 0.6f, SQUARES, SQUARES);
    Host_Cut(host, sheet, slit, 2);
    OK(Host_Tick(host, 0.01f, 1));
    kiriFrame frames[4];
    World_GetFrames(host->world, sheet, frames, 4);
    for (int i = 0; i < 4; ++i) {
        kiriFrameState state = World_FrameState(host->world, frames[i]);
        double c = i < 2 ? 0.8 : 1.0, s = i < 2 ? (i == 0 ? 0.6 : -0.6) : 0.0, v = state.restPoint[1];
        const float position[3] = { state.restPoint[0], (float)(0.5 + c * (v - 0.5)), (float)(s * (v - 0.5)) };
        const float rotation[9] = { 1.0f, 0.0f, 0.0f, 0.0f, (float)c, (float)s, 0.0f, (float)-s, (float)c };
        OK(kiriFrame_Hold(host->world, frames[i], position, rotation));
    }
    OK(Host_Tick(host, 0.01f, 1));
    return sheet;
}

/* How far apart the lips are in a point of both. */
typedef struct Opening {
    double v, gap;
} Opening;

static int CompareOpenings(const void* left, const void* right)
{
    double l = ((const Opening*)left)->v, r = ((const Opening*)right)->v;
    return (l < r) - (l > r);
}

static int FindOpenings(const kiriMesh* mesh, Opening* openings, double end)
{
    int count = 0;
    for (int32_t a = 0; a < mesh->vertexCount; ++a) {
        for (int32_t b = a + 1; b < mesh->vertexCount; ++b) {
            const float *p = mesh->restPositions + 2 * a, *q = mesh->restPositions + 2 * b;
            if (p[0] == q[0] && p[1] == q[1]) {
                const float *x = mesh->positions + 3 * a, *y = mesh->positions + 3 * b;
                openings[count].v = p[1];
                openings[count++].gap = sqrt(pow(x[0] - y[0], 2) + pow(x[1] - y[1], 2) + pow(x[2] - y[2], 2));
            }
        }
    }
    openings[count].v = end;
    openings[count++].gap = 0.0;
    qsort(openings, (size_t)count, sizeof(Opening), CompareOpenings);
    return count;
}

/* The largest growth of the gap along the first 0.1 m of the slit, over the mean. */
static double SteepestOpening(double end, double slant)
{
    static Opening openings[1000];
    double gap = 0.0, steepest = 0.0;
    START_HOST(host);
    kiriMesh mesh = Host_Mesh(&host, SlitSheet(&host, end, slant));
    int count = FindOpenings(&mesh, openings, end), i = 1;
    for (; i < count && openings[i].v > end - 0.1; ++i) {
        double way = openings[i - 1].v - openings[i].v, growth = openings[i].gap - openings[i - 1].gap;
        steepest = fmax(steepest, growth / fmax(way, 0.002)); /* a tenth of a cell: lips have short edges */
        gap = openings[i].gap;
    }
    assert_true(i > 20 && gap > 0.05);
    return steepest * 0.1 / gap;
}

/* Wherever in a cell it ends. Lips that stay together as far as their cell does, and then jump apart, have 2.5 in the
   mean, and up to 3.9. */
FIGURE(SlitsOpenFromTheirEnd)
{
    static const double slants[] = { 0.37, -0.2, 0.5 };
    double sum = 0.0, worst = 0.0;
    for (int k = 0; k < 18; ++k) {
        double steepest = SteepestOpening(0.3 + 0.02 * (k % 6 + 0.3) / 6.0, slants[k / 6]);
        sum += steepest;
        worst = fmax(worst, steepest);
    }
    if (!(sum / 18.0 < 1.8 && worst < 3.0)) {
        fail_msg("lips open %.3f times as fast as in the mean, up to %.3f", sum / 18.0, worst);
    }
}
