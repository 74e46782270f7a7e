/* Seams: lips stay together, motion keeps momentum, and stitches stay with their points whatever happens to the sheets. */
#include "tape.h"

#include <float.h>

static const float dt = 1.0f / 60.0f;

enum { MOST_STITCHES = 128 };

typedef struct Pair {
    kiriSheet a, b;
    kiriSeam seam;
} Pair;

static kiriSeamDef SeamDef(kiriSheet a, const float* lineA, kiriSheet b, const float* lineB, int32_t count)
{
    kiriSeamDef def = DefaultSeam();
    def.sheetA = a;
    def.lineA = lineA;
    def.sheetB = b;
    def.lineB = lineB;
    def.countA = def.countB = count;
    return def;
}

static const float rightEdge[4] = { 0.5f, 0.0f, 0.5f, 0.5f }, leftEdge[4] = { 0.0f, 0.0f, 0.0f, 0.5f };

/* Two squares side by side, sewn where they meet. */
static Pair Pair_Make(Host* host, kiriSheetDef* def, int32_t framesA, int32_t framesB)
{
    Pair pair;
    def->framePoints = NULL;
    def->frameCount = framesA;
    pair.a = Host_AddRectangle(host, def, 0.5f, 0.5f, 8, 8);
    def->position[0] += 0.5f;
    def->frameCount = framesB;
    pair.b = Host_AddRectangle(host, def, 0.5f, 0.5f, 8, 8);
    kiriSeamDef seam = SeamDef(pair.a, rightEdge, pair.b, leftEdge, 2);
    OK(kiriCreateSeam(host->world, &seam, &pair.seam));
    return pair;
}

static int32_t GetStitches(const Host* host, kiriSeam seam, kiriStitch stitches[MOST_STITCHES])
{
    int32_t count = World_StitchCount(host->world, seam);
    assert_in_range(count, 1, MOST_STITCHES);
    for (int32_t k = 0; k < count; ++k) {
        OK(kiriSeam_GetStitch(host->world, seam, k, &stitches[k]));
    }
    assert_int_equal(kiriSeam_GetStitch(host->world, seam, count, &stitches[0]), KIRI_ERROR_ARGUMENT);
    return count;
}

/* Returns the number of stitches. *gap, *force: the largest. */
static int32_t Measure(const Host* host, kiriSeam seam, double* gap, double* force)
{
    kiriStitch stitches[MOST_STITCHES];
    int32_t count = GetStitches(host, seam, stitches);
    *gap = *force = 0.0;
    for (int32_t k = 0; k < count; ++k) {
        const float* f = stitches[k].force;
        *gap = fmax(stitches[k].gap, *gap);
        *force = fmax(sqrt(f[0] * f[0] + f[1] * f[1] + f[2] * f[2]), *force);
    }
    return count;
}

static double Gap(const Host* host, kiriSeam seam)
{
    double gap, force;
    assert_true(Measure(host, seam, &gap, &force) > 0);
    return gap;
}

static double Distance(const float a[3], const float b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) + (a[2] - b[2]) * (a[2] - b[2]));
}

static void HoldTop(Host* host, kiriSheet sheet)
{
    kiriPinDef pin = DefaultPin();
    kiriPin made = World_AddPin(host->world, sheet, &pin);
    pin.restPoint[1] = pin.target[1] = 0.5f;
    OK(kiriCreatePin(host->world, sheet, &pin, &made));
}

/* ---- Motion ------------------------------------------------------------------------------------------------------ */

typedef struct Sum {
    double mass, energy, momentum[6];
} Sum;

static Sum SumOf(const Host* host, const Pair* pair)
{
    Sum sum = { 0 };
    for (int k = 0; k < 2; ++k) {
        kiriTotals totals = World_Totals(host->world, k == 0 ? pair->a : pair->b);
        sum.mass += totals.mass;
        sum.energy += totals.kineticEnergy + totals.elasticEnergy;
        for (int i = 0; i < 3; ++i) {
            sum.momentum[i] += totals.momentum[i];
            sum.momentum[3 + i] += totals.angularMomentum[i];
        }
    }
    return sum;
}

/* One square is thrown, and drags the other along. */
static void Throw(int32_t preset, int32_t framesA, int32_t framesB, int32_t model)
{
    static const float velocity[3] = { 0.1f, 0.3f, 1.0f };
    START_HOST(host);
    World_StopGravity(host.world);
    kiriSheetDef def = Host_SmallDef();
    OK(kiriGetMaterial(preset, &def.material));
    def.material.airDamping = 0.0f;
    def.model = model;
    Pair pair = Pair_Make(&host, &def, framesA, framesB);
    OK(kiriSheet_SetVelocity(host.world, pair.b, velocity, noVector));
    Sum start = SumOf(&host, &pair);
    double size = start.mass * 1.05;
    for (int32_t tick = 0; tick < 90; ++tick) {
        OK(Host_Tick(&host, dt, 2));
        Sum now = SumOf(&host, &pair);
        for (int i = 0; i < 6; ++i) {
            assert_true(fabs(now.momentum[i] - start.momentum[i]) < 1e-6 * size);
        }
        assert_true(now.energy < start.energy * (1.0 + 1e-6));
        assert_true(Gap(&host, pair.seam) < 1e-3);
    }
}

TEST(Momentum)
{
    Throw(KIRI_MATERIAL_PAPER, 9, 9, KIRI_MODEL_LINKS);
    Throw(KIRI_MATERIAL_PAPER, 1, 16, KIRI_MODEL_LINKS);
    Throw(KIRI_MATERIAL_COTTON, 4, 16, KIRI_MODEL_LINKS);
    Throw(KIRI_MATERIAL_RUBBER, 9, 6, KIRI_MODEL_LINKS);
    Throw(KIRI_MATERIAL_CARD, 4, 9, KIRI_MODEL_LINKS);
    Throw(KIRI_MATERIAL_COTTON, 4, 5, KIRI_MODEL_AFFINE);
}

/* A square hangs on another one: they come to rest, sleep, and wake together. */
static void Hang(int32_t preset, int32_t framesA, int32_t framesB)
{
    int32_t awake[2] = { 1, 1 };
    START_HOST(host);
    host.every = 50;
    kiriSheetDef def = Host_SmallDef();
    OK(kiriGetMaterial(preset, &def.material));
    def.material.airDamping = 3.0f;
    def.sleepSpeed = 0.01f;
    Pair pair = Pair_Make(&host, &def, framesA, framesB);
    HoldTop(&host, pair.a);
    for (int32_t tick = 0; tick < 2000 && awake[0]; ++tick) {
        OK(Host_Tick(&host, dt, 2));
        OK(kiriSheet_IsAwake(host.world, pair.a, &awake[0]));
        OK(kiriSheet_IsAwake(host.world, pair.b, &awake[1]));
        assert_int_equal(awake[0], awake[1]);
    }
    assert_int_equal(awake[0], 0);
    double gap, force;
    Measure(&host, pair.seam, &gap, &force);
    assert_true(gap < 1e-5 * 0.5 && force > 0.0);
    OK(kiriSheet_Wake(host.world, pair.b));
    OK(Host_Tick(&host, dt, 2));
    OK(kiriSheet_IsAwake(host.world, pair.a, &awake[0]));
    assert_int_equal(awake[0], 1);
    OK(kiriDestroySeam(host.world, pair.seam));
    Host_Ticks(&host, 30, dt, 2);
    kiriTotals fallen = World_Totals(host.world, pair.b);
    assert_true(fallen.momentum[2] < -fallen.mass);
}

TEST(Sleep)
{
    Hang(KIRI_MATERIAL_COTTON, 9, 9);
    Hang(KIRI_MATERIAL_RUBBER, 4, 12);
}

/* Opposite edges of one sheet: a tube. The lips start apart, and are drawn together. */
TEST(Tube)
{
    START_HOST(host);
    host.every = 20;
    World_StopGravity(host.world);
    kiriSheetDef def = Host_SmallDef();
    def.framePoints = NULL;
    def.frameCount = 12;
    def.material.airDamping = 2.0f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 0.5f, 0.5f, 8, 8);
    kiriSeamDef seam = SeamDef(sheet, rightEdge, sheet, leftEdge, 2);
    kiriTotals totals;
    kiriSeam made = World_AddSeam(host.world, &seam);
    assert_true(Gap(&host, made) > 0.49);
    for (int32_t tick = 0; tick < 120; ++tick) {
        OK(Host_Tick(&host, dt, 2));
        OK(kiriSheet_GetTotals(host.world, sheet, &totals));
        for (int i = 0; i < 3; ++i) {
            assert_true(fabs(totals.momentum[i]) < 1e-6 * totals.mass);
        }
    }
    assert_true(Gap(&host, made) < 1e-4);
}

/* A sleeve of two panels around an arm that moves at 0.9 m/s: vertices of drawn lips lie on the drawn surface of the other
   panel. Edges of other meshes are other chords. */
static void MoveSleeve(int32_t preset, int32_t skinning, int32_t columns, float radius, double limit)
{
    static const float axes[9] = { 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 1.0f, 0.0f, 0.0f };
    static const float ways[5][3] = { { 0 }, { 0, 0.9f }, { 0, -0.9f }, { 0, 0, 0.9f }, { 0, 0, -0.9f } };
    const float lines[2][4] = { { 0.0f, 0.0f, 0.4f, 0.0f }, { 0.0f, 0.2f, 0.4f, 0.2f } };
    double most = 0.0; /* m */
    START_HOST(host);
    host.every = 50;
    kiriSheetDef def = Host_SmallDef();
    kiriSheet panels[2];
    OK(kiriGetMaterial(preset, &def.material));
    def.skinning = skinning;
    def.gridResolution = 32;
    def.framePoints = NULL;
    def.frameCount = 16;
    def.contactThickness = 0.004f;
    for (int k = 0; k < 2; ++k) {
        memcpy(def.position, (const float[]){ -0.2f, -0.1f, k == 0 ? 0.055f : -0.055f }, sizeof(def.position));
        panels[k] = Host_AddRectangle(&host, &def, 0.4f, 0.2f, k == 0 ? 24 : columns, 12);
    }
    for (int k = 0; k < 2; ++k) {
        kiriSeamDef seam = SeamDef(panels[0], lines[k], panels[1], lines[k], 2);
        World_AddSeam(host.world, &seam);
    }
    kiriObstacleDef arm = DefaultObstacle();
    arm.type = KIRI_OBSTACLE_CAPSULE;
    arm.radius = radius;
    arm.height = 0.5f;
    memcpy(arm.rotation, axes, sizeof(axes));
    kiriObstacle obstacle = World_AddObstacle(host.world, &arm);
    for (int32_t tick = 0; tick < 220; ++tick) {
        OK(kiriObstacle_SetVelocity(host.world, obstacle, ways[tick < 60 ? 0 : 1 + tick / 20 % 4], ways[0]));
        OK(Host_Tick(&host, dt, 2));
        for (int k = 0; k < 2 && tick >= 50; ++k) {
            kiriMesh mesh = World_Mesh(host.world, panels[k]);
            for (const float *at = mesh.positions, *p = mesh.restPositions; p < mesh.restPositions + 2 * mesh.vertexCount; at += 3, p += 2) {
                bool isLip = p[1] == lines[0][1] || p[1] == lines[1][1];
                most = isLip ? fmax(Distance(at, World_PointState(host.world, panels[1 - k], p).position), most) : most;
            }
        }
    }
    print_message("sleeve, preset %d, skinning %d, %d columns, arm of %g m: %.2g m apart\n", preset, skinning, columns,
                  (double)radius, most);
    assert_true(most < limit);
}

TEST(Sleeve)
{
    for (int32_t k = 0; k < 8; k += IS_SANITIZED ? 3 : 1) { /* each material, skinning and count once */
        MoveSleeve(k < 4 ? KIRI_MATERIAL_COTTON : KIRI_MATERIAL_PAPER, k % 2, k % 4 < 2 ? 24 : 17, 0.045f,
                   k % 4 < 2 ? 4e-7 : 1e-3);
    }
    /* Other arms do not press it into any shape either, when they turn back. */
    static const float radii[4] = { 0.043f, 0.0448f, 0.0452f, 0.0455f };
    for (int32_t k = 0; k < RUNS(4); ++k) {
        MoveSleeve(KIRI_MATERIAL_PAPER, 1, 24, radii[k], 5e-3);
        MoveSleeve(KIRI_MATERIAL_PAPER, 0, 24, radii[k], 5e-3);
    }
}

/* Half of a sheet hangs on a hinge: stiffness times angle is the moment of its weight. */
static void Hinge(int32_t frames, float stiffness)
{
    const float b = 0.05f, edge[4] = { b, 0.0f, b, b }, other[4] = { 0.0f, 0.0f, 0.0f, b };
    kiriFrame held[16];
    START_HOST(host);
    host.every = 100;
    kiriSheetDef def = Host_SmallDef();
    def.material = (kiriMaterial){ 2e9f, 0.0f, 3e-4f, 800.0f, 5.0f, 0.01f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.framePoints = NULL;
    kiriSheet a = Host_AddRectangle(&host, &def, b, b, 8, 8);
    def.position[0] = b;
    def.frameCount = frames;
    kiriSheet hanging = Host_AddRectangle(&host, &def, b, b, 8, 8);
    int32_t count = World_GetFrames(host.world, a, held, 16);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState frame = World_FrameState(host.world, held[i]);
        OK(kiriFrame_Hold(host.world, held[i], frame.position, worldAxes));
    }
    kiriSeamDef seam = SeamDef(a, edge, hanging, other, 2);
    kiriStitch stitch;
    kiriSeam made = World_AddSeam(host.world, &seam);
    OK(kiriSeam_SetHinge(host.world, made, stiffness, 0.0f));
    Host_Ticks(&host, 300, dt, 2);
    OK(kiriSeam_GetStitch(host.world, made, 1, &stitch));
    double moment = 800.0 * 3e-4 * 9.81 * b * b / 2.0 * cos(stitch.angle);
    assert_true(fabs(-stitch.angle * stiffness / moment - 1.0) < 0.03);
    OK(kiriSeam_SetHinge(host.world, made, 1.0f, 1.0f)); /* it lifts the sheet to the angle at which the hinge rests */
    Host_Ticks(&host, 300, dt, 2);
    OK(kiriSeam_GetStitch(host.world, made, 1, &stitch));
    assert_true(fabs(stitch.angle - 1.0) < 0.05);
}

TEST(Hinge)
{
    Hinge(4, 5e-3f);
    Hinge(9, 5e-4f);
}

/* A strip of paper becomes a ring: its bending energy is 1/2 E h^3 / 12 (2 pi)^2 width / length. */
TEST(Ring)
{
    enum { FRAMES = 12 };
    const float length = 0.3f, width = 0.03f;
    static const float end[4] = { 0.3f, 0.0f, 0.3f, 0.03f }, start[4] = { 0.0f, 0.0f, 0.0f, 0.03f };
    float points[2 * FRAMES];
    START_HOST(host);
    host.every = 100;
    World_StopGravity(host.world);
    kiriSheetDef def = Host_SmallDef();
    OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
    def.material.poissonsRatio = def.material.yieldStress = 0.0f;
    def.material.airDamping = 3.0f;
    for (int i = 0; i < FRAMES; ++i) {
        points[2 * i] = length * ((float)i + 0.5f) / FRAMES;
        points[2 * i + 1] = 0.5f * width;
    }
    def.framePoints = points;
    def.frameCount = FRAMES;
    def.gridResolution = 48;
    kiriSheet sheet = Host_AddRectangle(&host, &def, length, width, 48, 4);
    kiriFrame frames[FRAMES];
    int32_t count = World_GetFrames(host.world, sheet, frames, FRAMES);
    assert_int_equal(count, FRAMES);
    for (int i = 0; i < FRAMES; ++i) { /* roll it up */
        double turn = 2.0 * 3.14159265358979 * (i + 0.5) / FRAMES, radius = length / (2.0 * 3.14159265358979);
        float c = (float)cos(turn), s = (float)sin(turn);
        const float x[3] = { (float)radius * s, 0.5f * width, (float)radius * (1.0f - c) };
        const float axes[9] = { c, 0.0f, s, 0.0f, 1.0f, 0.0f, -s, 0.0f, c };
        OK(kiriFrame_Hold(host.world, frames[i], x, axes));
    }
    OK(Host_Tick(&host, dt, 2));
    kiriSeamDef seam = SeamDef(sheet, end, sheet, start, 2);
    seam.stiffness = 1e3f; /* glued */
    World_AddSeam(host.world, &seam);
    for (int i = 0; i < FRAMES; ++i) {
        OK(kiriFrame_Hold(host.world, frames[i], NULL, NULL));
    }
    Host_Ticks(&host, 300, dt, 2);
    kiriTotals totals = World_Totals(host.world, sheet);
    double h = def.material.thickness, stiffness = def.material.youngsModulus * h * h * h / 12.0;
    double theory = 0.5 * stiffness * 39.478417604 * width / length;
    double part = (FRAMES - 1.0) / FRAMES; /* the seam has the rest */
    assert_true(fabs(totals.elasticEnergy / (part * theory) - 1.0) < 0.01);
}

/* Returns how deep the end of a strip of paper hangs, m: of one piece, or of two that are sewn along it. */
static double SagOf(int32_t framesA, int32_t framesB)
{
    enum { WHOLE = 0 };
    const float length = 0.12f, width = framesB == WHOLE ? 0.06f : 0.03f;
    const float upper[4] = { 0.0f, width, length, width }, lower[4] = { 0.0f, 0.0f, length, 0.0f };
    Pair pair;
    kiriPin clamp;
    START_HOST(host);
    host.every = 100;
    kiriSheetDef def = Host_SmallDef();
    OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
    def.material.yieldStress = 0.0f;
    def.material.airDamping = 20.0f;
    def.gridResolution = 48;
    def.framePoints = NULL;
    for (int k = 0; k < (framesB == WHOLE ? 1 : 2); ++k) {
        def.frameCount = k == 0 ? framesA : framesB;
        def.position[1] = width * (float)k;
        kiriSheet sheet = Host_AddRectangle(&host, &def, length, width, 24, 6);
        OK(kiriSheet_ClampLine(host.world, sheet, lower, (const float[]){ 0.0f, width }, &clamp));
        *(k == 0 ? &pair.a : &pair.b) = sheet;
    }
    if (framesB != WHOLE) {
        kiriSeamDef seam = SeamDef(pair.a, upper, pair.b, lower, 2);
        OK(kiriCreateSeam(host.world, &seam, &pair.seam));
    }
    Host_Ticks(&host, 300, dt, 2);
    kiriPointState end = World_PointState(host.world, pair.a, lower + 2);
    return -(double)end.position[2];
}

/* Lips whose frames differ do not stiffen paper. */
TEST(Strip)
{
    static const int32_t frames[6][2] = { { 5, 8 }, { 7, 11 }, { 9, 4 }, { 12, 9 }, { 13, 17 }, { 16, 16 } };
    double whole = SagOf(24, 0);
    for (int i = 0; i < 6; ++i) {
        double sewn = SagOf(frames[i][0], frames[i][1]);
        print_message("%d and %d frames: %.2f mm for %.2f\n", frames[i][0], frames[i][1], 1e3 * sewn, 1e3 * whole);
        assert_true(fabs(sewn / whole - 1.0) < 0.045);
    }
}

/* A bag of two panels that are sewn on three sides and held at the mouth. */
static kiriSeam AddBag(Host* host, float thickness, int32_t frames, kiriSheet panels[2])
{
    static const float line[8] = { 0.0f, 0.3f, 0.0f, 0.0f, 0.3f, 0.0f, 0.3f, 0.3f };
    for (int k = 0; k < 2; ++k) {
        kiriSheetDef def = DefaultSheet();
        Set3(def.position, -0.15f, k == 0 ? -0.005f : 0.005f, 0.0f);
        Set3(def.axisV, 0.0f, 0.0f, 1.0f);
        def.frameCount = frames;
        def.skinning = KIRI_SKINNING_SMOOTH;
        def.touchesSheets = 1;
        def.contactThickness = thickness;
        panels[k] = Host_AddRectangle(host, &def, 0.3f, 0.3f, 30, 30);
        for (int i = 0; i < 2; ++i) {
            kiriPinDef pin = DefaultPin();
            pin.restPoint[0] = 0.1f * (float)(i + 1);
            pin.restPoint[1] = 0.3f;
            Set3(pin.target, pin.restPoint[0] - 0.15f, def.position[1], 0.3f);
            World_AddPin(host->world, panels[k], &pin);
        }
    }
    kiriSeamDef seam = SeamDef(panels[0], line, panels[1], line, 4);
    return World_AddSeam(host->world, &seam);
}

/* Panels face to face keep apart: but not where they are sewn. Skins of lips may cross there, by more than thin cloth keeps. */
FIGURE(Bag)
{
    static const float thickness[3] = { 0.005f, 0.001f, 0.0005f }, frames[3] = { 36.0f, 25.0f, 16.0f };
    for (int i = 0; i < 3; ++i) {
        double gap, force;
        kiriSheet panels[2];
        START_HOST(host);
        host.every = 50;
        kiriSeam made = AddBag(&host, thickness[i], (int32_t)frames[i], panels);
        Host_Ticks(&host, 240, dt, 2);
        Measure(&host, made, &gap, &force);
        assert_true(gap < 3e-4 && force < 1.0);
        for (int k = 0; k < 25; ++k) {
            const float at[2] = { 0.0375f * (float)(k % 5 + 2), 0.0375f * (float)(k / 5 + 2) };
            float apart = World_PointState(host.world, panels[1], at).position[1];
            assert_true(apart - World_PointState(host.world, panels[0], at).position[1] > 0.5f * thickness[i]);
        }
    }
}

/* A budget of motion moves one pair in a tick, and the other in the next. Stitches keep the force of the last tick that
   moved them. */
TEST(ForcesStay)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    Pair pairs[2];
    for (int k = 0; k < 2; ++k) {
        def.position[0] = 0.0f;
        def.position[1] = (float)k;
        pairs[k] = Pair_Make(&host, &def, 6, 6);
        HoldTop(&host, pairs[k].a);
    }
    const kiriBudget budget = { .iterations = 4 };
    OK(kiriWorld_SetBudget(host.world, &budget));
    int32_t left = 0;
    for (int32_t tick = 0; tick < 60; ++tick) {
        kiriResult result = Host_Tick(&host, dt, 2);
        left += result == KIRI_PENDING;
        for (int k = 0; k < 2 && tick > 20; ++k) {
            double gap, force;
            Measure(&host, pairs[k].seam, &gap, &force);
            assert_true(force > 0.0);
        }
    }
    assert_true(left > 20);
}

/* ---- Cuts, pieces and sheets ------------------------------------------------------------------------------------- */

/* A cut through both sheets parts the seam. Pieces become sheets, and are destroyed. */
TEST(Pieces)
{
    static const float cut[4] = { -0.1f, 0.23f, 0.6f, 0.23f };
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    Pair pair = Pair_Make(&host, &def, 9, 9);
    kiriStitch stitches[MOST_STITCHES], now[MOST_STITCHES];
    int32_t left, lower = 0;
    HoldTop(&host, pair.a);
    int32_t count = GetStitches(&host, pair.seam, stitches);
    for (int32_t k = 0; k < count; ++k) {
        lower += stitches[k].restB[1] < cut[1];
    }
    assert_true(lower > 0 && lower < count);
    Host_Cut(&host, pair.a, cut, 2);
    Host_Cut(&host, pair.b, cut, 2);
    Host_Ticks(&host, 20, dt, 2);
    assert_int_equal(Host_Counts(&host, pair.b).pieces, 2);
    assert_true(Gap(&host, pair.seam) < 1e-3);
    const float below[2] = { 0.25f, 0.1f };
    kiriPointState point = World_PointState(host.world, pair.b, below);
    kiriSheet part = World_Detach(host.world, point.frame);
    assert_int_equal(GetStitches(&host, pair.seam, now), count);
    for (int32_t k = 0; k < count; ++k) {
        assert_memory_equal(now[k].restB, stitches[k].restB, sizeof(now[k].restB));
        assert_int_equal(now[k].sheetB, stitches[k].restB[1] < cut[1] ? part : pair.b);
        assert_int_equal(now[k].sheetA, pair.a);
    }
    Host_Ticks(&host, 20, dt, 2);
    assert_true(Gap(&host, pair.seam) < 1e-3);
    OK(kiriSheet_GetPoint(host.world, pair.a, below, &point));
    OK(kiriFrame_DestroyPiece(host.world, point.frame));
    Host_Validate(&host);
    assert_int_equal(GetStitches(&host, pair.seam, now), count - lower);
    OK(Host_Tick(&host, dt, 2));
    OK(kiriDestroySheet(host.world, pair.b));
    assert_int_equal(kiriSeam_GetCount(host.world, pair.seam, &left), KIRI_ERROR_ID);
    OK(kiriWorld_GetSeams(host.world, NULL, 0, &left));
    assert_int_equal(left, 0);
    OK(Host_Tick(&host, dt, 2));
}

/* A weak seam opens under the weight of the sheet, and names its stitches in events. */
TEST(Break)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    Pair pair = Pair_Make(&host, &def, 9, 9);
    HoldTop(&host, pair.a);
    OK(kiriDestroySeam(host.world, pair.seam));
    kiriSeamDef seam = SeamDef(pair.a, rightEdge, pair.b, leftEdge, 2);
    seam.breakForce = 0.05f;
    OK(kiriCreateSeam(host.world, &seam, &pair.seam));
    int32_t left, events = 0;
    for (int32_t tick = 0; tick < 200 && (events == 0 || left > 0); ++tick) {
        kiriEvent event;
        OK(Host_Tick(&host, dt, 2));
        if (Host_Events(&host, KIRI_EVENT_SEAM_BROKE, &event) > 0) {
            assert_int_equal(event.seam, pair.seam);
            left = event.stitches;
            ++events;
        }
    }
    assert_true(events > 0);
    assert_int_equal(left, 0);
    assert_int_equal(kiriDestroySeam(host.world, pair.seam), KIRI_ERROR_ID);
}

/* Strips of paper, end to end or on each other, are pulled apart by a force that grows. Returns the force at which the
   seam breaks, relative to its strength. */
static double Pull(int32_t framesA, int32_t framesB, bool peels)
{
    static const float edge[4] = { 0.1f, 0.0f, 0.1f, 0.08f }, start[4] = { 0.0f, 0.0f, 0.0f, 0.08f };
    const float strength = 2.0f;
    Host host;
    kiriPin clamp;
    int32_t tick = 0, count;
    Host_Start(&host);
    host.every = 100;
    World_StopGravity(host.world);
    kiriSheetDef def = Host_SmallDef();
    OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
    def.material.airDamping = peels ? 200.0f : 20.0f;
    def.gridResolution = 32;
    def.framePoints = NULL;
    def.frameCount = framesA;
    kiriSheet a = Host_AddRectangle(&host, &def, 0.1f, 0.08f, 10, 8);
    def.position[0] = peels ? 0.0f : 0.1f;
    def.frameCount = framesB;
    kiriSheet b = Host_AddRectangle(&host, &def, 0.1f, 0.08f, 10, 8);
    if (!peels) {
        OK(kiriSheet_ClampLine(host.world, a, start, start + 2, &clamp));
    }
    kiriSeamDef seam = SeamDef(a, peels ? start : edge, b, start, 2);
    seam.breakForce = strength;
    kiriSeam made = World_AddSeam(host.world, &seam);
    for (; kiriSeam_GetCount(host.world, made, &count) == KIRI_OK; ++tick) {
        const float size = strength * 0.002f * (float)tick;
        const float force[3] = { peels ? 0.0f : size, 0.0f, peels ? size : 0.0f }, back[3] = { 0.0f, 0.0f, -size };
        OK(kiriSheet_ApplyLineLoad(host.world, b, edge, edge + 2, force));
        if (peels) {
            OK(kiriSheet_ApplyLineLoad(host.world, a, edge, edge + 2, back));
        }
        OK(Host_Tick(&host, dt, 2));
        assert_true(tick < 600);
    }
    Host_Stop(&host);
    print_message("%d and %d frames: %.3f\n", framesA, framesB, 0.002 * tick);
    return 0.002 * tick;
}

FIGURE(Strength)
{
    static const int32_t frames[5][2] = { { 6, 6 }, { 9, 9 }, { 16, 16 }, { 9, 16 }, { 12, 7 } };
    for (int i = 0; i < 10; ++i) {
        assert_true(fabs(Pull(frames[i % 5][0], frames[i % 5][1], i >= 5) - 1.0) < 0.1);
    }
}

/* ---- Bytes ------------------------------------------------------------------------------------------------------- */

/* A loaded world goes on as the saved one. */
TEST(Saves)
{
    for (int isSave = 0; isSave < 2; ++isSave) {
        START_HOST(host);
        START_HOST(twin);
        kiriSheetDef def = Host_SmallDef();
        Pair pair = Pair_Make(&host, &def, 9, 5);
        HoldTop(&host, pair.a);
        Host_Ticks(&host, 10, dt, 2);
        SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(host.world, isSave ? kiriWorld_Save : kiriWorld_Snapshot);
        OK((isSave ? kiriWorld_Load : kiriWorld_Restore)(twin.world, bytes.data, bytes.size));
        for (int32_t tick = 0; tick < 20; ++tick) {
            assert_true(Host_Hash(&host) == Host_Hash(&twin));
            OK(Host_Tick(&host, dt, 2));
            OK(Host_Tick(&twin, dt, 2));
        }
    }
}

/* ---- Refusals ---------------------------------------------------------------------------------------------------- */

static void Refused(Host* host, const kiriSeamDef* def, kiriResult result, const char* line)
{
    kiriSeam seam = 1;
    uint64_t hash = Host_Hash(host);
    assert_int_equal(kiriCreateSeam(host->world, def, &seam), result);
    assert_non_null(strstr(kiriWorld_GetLastError(host->world), line));
    assert_true(seam == 0 && Host_Hash(host) == hash);
}

/* Extreme numbers move something finite. */
TEST(Ranges)
{
    static const float numbers[] = { 0.0f, FLT_MIN, 1e-3f, 1e4f, FLT_MAX };
    static const float angles[] = { -3.14159f, 0.0f, 1e-20f, 3.14159f };
    for (int i = 0; i < 5 * 4 * 2; ++i) {
        START_HOST(host);
        kiriSheetDef def = Host_SmallDef();
        Pair pair = Pair_Make(&host, &def, 4, 5);
        kiriSeamDef seam = SeamDef(pair.b, rightEdge, pair.a, leftEdge, 2);
        seam.stiffness = numbers[i % 5];
        seam.breakForce = numbers[i / 20 * 3 + i % 2];
        seam.restAngle = angles[i / 5 % 4];
        seam.stitches = i % 7 == 0 ? 1024 : 2 * (i % 3);
        World_AddSeam(host.world, &seam);
        for (int32_t tick = 0; tick < 4; ++tick) {
            assert_true(Host_Tick(&host, dt, 2) >= 0);
        }
    }
}

TEST(Arguments)
{
    static const float outside[4] = { 0.5f, 0.0f, 0.7f, 0.5f }, point[4] = { 0.1f, 0.1f, 0.1f, 0.1f };
    static const float bad[4] = { 0.1f, NAN, 0.1f, 0.1f };
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    Pair pair = Pair_Make(&host, &def, 4, 4);
    def.planar = 1;
    kiriSheet planar = Host_AddRectangle(&host, &def, 0.5f, 0.5f, 8, 8);
    def.planar = 0;
    def.model = KIRI_MODEL_AFFINE;
    kiriSheet affine = Host_AddRectangle(&host, &def, 0.5f, 0.5f, 8, 8);
    kiriSeamDef d = SeamDef(planar, leftEdge, pair.b, rightEdge, 2);
    Refused(&host, &d, KIRI_ERROR_ARGUMENT, "planar");
    d = SeamDef(affine, leftEdge, pair.b, rightEdge, 2);
    Refused(&host, &d, KIRI_ERROR_ARGUMENT, "models");
    d = SeamDef(pair.a, outside, pair.b, rightEdge, 2);
    Refused(&host, &d, KIRI_ERROR_ARGUMENT, "lineA leaves");
    d = SeamDef(pair.a, leftEdge, pair.b, outside, 2);
    Refused(&host, &d, KIRI_ERROR_ARGUMENT, "lineB leaves");
    d = SeamDef(pair.a, point, pair.b, leftEdge, 2);
    Refused(&host, &d, KIRI_ERROR_ARGUMENT, "no length");
    const float doubled[8] = { 0.5f, 0.0f, 0.5f, 0.0f, 0.5f, 0.5f, 0.5f, 0.5f };
    kiriStitch stitches[MOST_STITCHES];
    d = SeamDef(pair.a, doubled, pair.b, leftEdge, 4);
    d.countB = 2;
    d.stiffness = 0.01f;
    kiriSeam seam = World_AddSeam(host.world, &d);
    for (int32_t k = 0, count = GetStitches(&host, seam, stitches); k < count; ++k) {
        assert_true(fabs((double)stitches[k].angle) < 1e-3); /* points twice in a line: no segment without a side */
    }
    OK(kiriDestroySeam(host.world, seam));
    d = SeamDef(pair.a, bad, pair.b, rightEdge, 2);
    Refused(&host, &d, KIRI_ERROR_ARGUMENT, "NaN");
    d = SeamDef(pair.a, NULL, pair.b, rightEdge, 2);
    Refused(&host, &d, KIRI_ERROR_ARGUMENT, "no lineA");
    d = SeamDef(pair.a + 100, leftEdge, pair.b, rightEdge, 2);
    Refused(&host, &d, KIRI_ERROR_ID, "there is no sheet with this id");
}
