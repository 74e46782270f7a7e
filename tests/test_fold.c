/* Folds: lines along which a sheet turns as a hinge. */
#include "../samples/creases.h"
#include "host.h"

#include "layout_hash.h"

static const float Dt = 1.0f / 60.0f;

static kiriSheetDef StiffDef(void)
{
    kiriSheetDef def = DefaultSheet();
    def.material = (kiriMaterial){ 2e9f, 0.3f, 3e-4f, 800.0f, 6.0f, 1e-4f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.sleepSpeed = 0.0f;
    def.fadeTime = 0.0f;
    return def;
}

static kiriSheet AddFolded(Host* host, kiriSheetDef* def, float width, float height, int32_t columns, int32_t rows,
                           const kiriFold* folds, int32_t count)
{
    kiriSheet sheet = 0;
    Rectangle r = Rectangle_Make(def, width, height, columns, rows);
    OK(kiriCreateFoldedSheet(host->world, def, folds, count, &sheet));
    Rectangle_Free(&r);
    Host_Validate(host);
    return sheet;
}

static void HoldLeftOf(Host* host, kiriSheet sheet, float u)
{
    kiriFrame frames[64];
    int32_t count = World_GetFrames(host->world, sheet, frames, 64);
    for (int32_t i = 0; i < count; ++i) {
        kiriFrameState state = World_FrameState(host->world, frames[i]);
        if (state.position[0] < u) {
            OK(kiriFrame_Hold(host->world, frames[i], state.position, state.rotation));
        }
    }
}

/* Vertices at one rest point are at one place, unless a cut is between them. */
static void CheckLips(const Host* host, kiriSheet sheet)
{
    kiriMesh mesh = Host_Mesh(host, sheet);
    int pairs = 0;
    for (int32_t v = 0; v < mesh.vertexCount; ++v) {
        for (int32_t w = 0; w < v; ++w) {
            if (memcmp(mesh.restPositions + 2 * v, mesh.restPositions + 2 * w, 8) == 0) {
                assert_memory_equal(mesh.positions + 3 * v, mesh.positions + 3 * w, 12);
                ++pairs;
            }
        }
    }
    assert_true(pairs > 0);
}

/* Half of a sheet hangs on the hinge between it and the other half, which is held: k theta = w b^2 / 2 cos theta.
   Returns the relative error of the angle. */
static double HangAtHinge(double k, int32_t frames, int32_t grid, int32_t columns)
{
    const kiriFold fold = { { 0.05f, 0.0f }, { 0.05f, 0.05f }, (float)k, 0.0f, 0.0f };
    kiriSheetDef def = StiffDef();
    START_HOST(host);
    host.every = 50;
    def.gridResolution = grid;
    def.frameCount = frames;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.05f, columns, columns / 2, &fold, 1);
    HoldLeftOf(&host, sheet, 0.05f);
    Host_Ticks(&host, 300, Dt, 1);
    double angle = -World_FoldState(host.world, sheet, 0).angle, weight = 800.0 * 3e-4 * 9.81, b = 0.05, low = 0.0,
           high = 1.6;
    for (int i = 0; i < 60; ++i) {
        double middle = 0.5 * (low + high);
        (k * middle < 0.5 * weight * b * b * cos(middle) ? (low = middle) : (high = middle));
    }
    CheckLips(&host, sheet);
    return angle / low - 1.0;
}

TEST(HalfASheetHangsOnItsHinge)
{
    const double stiffness[] = { 0.0005, 0.002, 0.005, 0.02 };
    const int32_t layouts[3][3] = { { 4, 32, 20 }, { 12, 48, 14 }, { 24, 64, 33 } };
    for (int l = 0; l < 3; ++l) {
        for (int k = 0; k < 4; ++k) {
            double error = HangAtHinge(stiffness[k], layouts[l][0], layouts[l][1], layouts[l][2]);
            print_message("%d frames, %g N: %+.2f %%\n", layouts[l][0], stiffness[k], 100.0 * error);
            assert_true(fabs(error) < 0.01);
        }
    }
}

/* Returns how far the free end of a clamped sheet hangs, m; with a fold of this stiffness, or below 0 without one. */
static double SagOf(float stiffness, float lean, int32_t frames)
{
    const kiriFold fold = { { 0.045f - lean, -1e-3f }, { 0.045f + lean, 0.051f }, 0.0f, 0.0f, 0.0f };
    kiriSheetDef def = StiffDef();
    START_HOST(host);
    host.every = 100;
    def.frameCount = frames;
    def.gridResolution = 48;
    kiriSheet sheet = stiffness < 0.0f ? Host_AddRectangle(&host, &def, 0.1f, 0.05f, 20, 10)
                                       : AddFolded(&host, &def, 0.1f, 0.05f, 20, 10, &fold, 1);
    if (stiffness >= 0.0f) { /* it was a free hinge */
        OK(kiriSheet_SetFold(host.world, sheet, 0, stiffness, 0.0f));
    }
    World_Clamp(host.world, sheet, (const float[]){ 0.0f, 0.0f }, (const float[]){ 0.0f, 0.05f });
    Host_Ticks(&host, 300, Dt, 2);
    return -(double)World_PointState(host.world, sheet, (const float[]){ 0.1f, 0.025f }).position[2];
}

/* A fold that is stiffer than the material bends as the material does. */
TEST(StiffFoldsAreLikeNone)
{
    for (int32_t frames = 12; frames <= 24; frames += 12) {
        double none = SagOf(-1.0f, 0.0f, frames);
        for (int lean = 0; lean < 2; ++lean) {
            double with = SagOf(1e3f, 0.02f * (float)lean, frames);
            print_message("%d frames: %.3f mm for %.3f mm\n", frames, 1e3 * with, 1e3 * none);
            assert_true(fabs(with / none - 1.0) < 0.025);
        }
    }
}

/* The seen surface is two planes, as far as rigid frames carry them. */
TEST(SeenSurfaceIsTwoPlanes)
{
    const kiriFold fold = { { 0.03f, 0.0f }, { 0.06f, 0.05f }, 0.0f, 0.0f, 0.0f };
    kiriSheetDef def = StiffDef();
    START_HOST(host);
    def.frameCount = 2;
    def.gridResolution = 40;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.05f, 17, 9, &fold, 1);
    HoldLeftOf(&host, sheet, 0.04f);
    Host_Ticks(&host, 90, Dt, 2);
    kiriMesh mesh = Host_Mesh(&host, sheet);
    double worst[2] = { 0.0, 0.0 };
    kiriFrame frames[2];
    kiriFrameState carrier[2];
    int32_t count = World_GetFrames(host.world, sheet, frames, 2);
    assert_int_equal(count, 2);
    for (int k = 0; k < 2; ++k) {
        OK(kiriFrame_GetState(host.world, frames[k], &carrier[k]));
    }
    for (int32_t v = 0; v < mesh.vertexCount; ++v) {
        const float* p = mesh.positions + 3 * v;
        double off[2];
        for (int k = 0; k < 2; ++k) {
            const float *x = carrier[k].position, *d = carrier[k].rotation + 6;
            off[k] = fabs((double)((p[0] - x[0]) * d[0] + (p[1] - x[1]) * d[1] + (p[2] - x[2]) * d[2]));
        }
        worst[0] = fmax(worst[0], fmin(off[0], off[1]));
        worst[1] = fmax(worst[1], fmax(off[0], off[1]));
    }
    print_message("off the planes by %.2g m, turned by %.3f rad\n", worst[0],
                  World_FoldState(host.world, sheet, 0).angle);
    assert_true(worst[0] < 1e-6 && worst[1] > 0.02); /* 1e-5 of the size */
}

/* A cut along a fold parts the sheet; one across it leaves one piece on each side, whose folds go on. */
TEST(CutsGoThroughFolds)
{
    const kiriFold folds[2] = { { { 0.05f, -1.0f }, { 0.05f, 1.0f }, 1e-4f, 0.5f, 0.0f },
                                { { 0.02f, 0.0f }, { 0.02f, 0.03f }, 1e-4f, 0.0f, 0.0f } };
    const float across[4] = { -0.1f, 0.02f, 0.2f, 0.03f }, along[4] = { 0.05f, -0.01f, 0.05f, 0.06f };
    kiriSheetDef def = StiffDef();
    START_HOST(host);
    def.frameCount = 8;
    kiriSheet part, sheet = AddFolded(&host, &def, 0.1f, 0.05f, 20, 10, folds, 2);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 1);
    assert_true(fabs(World_FoldState(host.world, sheet, 0).length - 0.05) < 1e-8);
    double inside = World_FoldState(host.world, sheet, 1).length;
    Host_Cut(&host, sheet, across, 2);
    OK(Host_Tick(&host, Dt, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    assert_true(fabs(World_FoldState(host.world, sheet, 0).length - 0.05) < 1e-8);
    assert_true(World_FoldState(host.world, sheet, 1).length >= inside - 1e-9);
    OK(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 1), &part));
    OK(Host_Tick(&host, Dt, 1));
    assert_true(
        fabs(World_FoldState(host.world, sheet, 0).length + World_FoldState(host.world, part, 0).length - 0.05) < 1e-8);
    OK(kiriSheet_SetFold(host.world, part, 0, 1e-3f, -0.5f));
    assert_true((double)World_FoldState(host.world, sheet, 0).fold.restAngle == 0.5);
    Host_Cut(&host, sheet, along, 2);
    Host_Cut(&host, part, along, 2);
    OK(Host_Tick(&host, Dt, 1));
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    assert_int_equal(Host_Counts(&host, part).pieces, 2);
    assert_true(World_FoldState(host.world, sheet, 0).length == 0.0 &&
                World_FoldState(host.world, sheet, 0).angle == 0.0);
}

/* Blades in world space go through folds. */
TEST(BladesGoThroughFolds)
{
    const kiriFold fold = { { 0.05f, 0.0f }, { 0.05f, 0.05f }, 0.01f, 1.2f, 0.0f };
    const float quad[12] = { -1, 0.026f, -1, 2, 0.026f, -1, 2, 0.026f, 1, -1, 0.026f, 1 };
    kiriSheetDef def = StiffDef();
    kiriCut cut;
    START_HOST(host);
    World_StopGravity(host.world);
    def.material.airDamping = 20.0f;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.05f, 20, 10, &fold, 1);
    Host_Ticks(&host, 100, Dt, 2);
    OK(kiriSheet_Slice(host.world, sheet, quad, &cut));
    Host_Ticks(&host, 2, Dt, 2);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 2);
    kiriBlade blade = World_BeginBlade(host.world, sheet);
    for (int t = 0; t <= 20; ++t) {
        const float from[3] = { -0.05f + 0.01f * (float)t, 0.04f, -1.0f }, to[3] = { from[0], 0.04f, 1.0f };
        OK(kiriBlade_MoveEdge(host.world, blade, from, to));
        OK(Host_Tick(&host, Dt, 2));
    }
    OK(kiriBlade_End(host.world, blade));
    Host_Ticks(&host, 2, Dt, 2);
    assert_int_equal(Host_Counts(&host, sheet).pieces, 3);
}

/* Cloth with a detail layer: both sides of the drawn mesh stay together. */
TEST(ClothFolds)
{
    const kiriFold fold = { { 0.5f, 0.0f }, { 0.5f, 1.0f }, 1e-4f, 2.0f, 0.0f };
    START_HOST(host);
    host.every = 20;
    kiriSheetDef def = DefaultSheet();
    def.frameCount = 16;
    kiriSheet sheet = AddFolded(&host, &def, 1.0f, 1.0f, 20, 20, &fold, 1);
    World_Clamp(host.world, sheet, (const float[]){ 0.0f, 0.0f }, (const float[]){ 0.0f, 1.0f });
    for (int t = 0; t < 40; ++t) {
        OK(Host_Tick(&host, Dt, 2));
        CheckLips(&host, sheet);
    }
}

/* A fold goes to its rest angle, also beyond a right angle and in the air, and turns nothing as a whole. */
TEST(FoldsGoToTheirRestAngle)
{
    const kiriFold fold = { { 0.05f, 0.0f }, { 0.05f, 0.05f }, 0.01f, 0.0f, 0.0f };
    kiriSheetDef def = StiffDef();
    START_HOST(host);
    def.material.airDamping = 30.0f;
    World_StopGravity(host.world);
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.05f, 20, 10, &fold, 1);
    for (int k = -6; k <= 6; ++k) {
        float rest = 0.5f * (float)k;
        OK(kiriSheet_SetFold(host.world, sheet, 0, 0.01f, rest));
        Host_Ticks(&host, 120, Dt, 2);
        assert_true(fabs(World_FoldState(host.world, sheet, 0).angle - (double)rest) < 1e-3);
        kiriTotals totals = Host_Totals(&host, sheet);
        for (int a = 0; a < 3; ++a) {
            assert_true(fabs(totals.momentum[a]) < 1e-9 && fabs(totals.angularMomentum[a]) < 1e-9);
        }
    }
}

/* Bent by a right angle and let go, a fold with a yield moment springs back by that moment over its stiffness; one
   without springs back to its rest angle. */
static double LetGo(float yieldMoment)
{
    const kiriFold fold = { { 0.05f, 0.0f }, { 0.05f, 0.05f }, 0.01f, 0.0f, yieldMoment };
    kiriSheetDef def = StiffDef();
    kiriFrame frames[2];
    START_HOST(host);
    World_StopGravity(host.world);
    def.material.yieldStress = 1e8f;
    def.material.airDamping = 30.0f;
    def.frameCount = 2;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.05f, 20, 10, &fold, 1);
    HoldLeftOf(&host, sheet, 0.05f);
    World_GetFrames(host.world, sheet, frames, 2);
    for (int k = 0; k < 2; ++k) {
        kiriFrameState state = World_FrameState(host.world, frames[k]);
        for (int t = 1; t <= 90 && state.position[0] > 0.05f; ++t) {
            double turn = 1.57079632679 * t / 90.0, off = (double)state.position[0] - 0.05;
            float c = (float)cos(turn), n = (float)sin(turn);
            const float at[3] = { (float)(0.05 + off * cos(turn)), state.position[1], (float)(off * sin(turn)) };
            const float rotation[9] = { c, 0.0f, n, 0.0f, 1.0f, 0.0f, -n, 0.0f, c };
            OK(kiriFrame_Hold(host.world, frames[k], at, rotation));
            OK(Host_Tick(&host, Dt, 2));
        }
        if (state.position[0] > 0.05f) {
            OK(kiriFrame_Hold(host.world, frames[k], NULL, NULL));
        }
    }
    Host_Ticks(&host, 200, Dt, 2);
    double angle = World_FoldState(host.world, sheet, 0).angle;
    return angle;
}

/* A fold that a running sheet gets is like one that it was made with, and begins without a jerk. */
TEST(FoldsAreAddedLater)
{
    const kiriFold fold = { { 0.05f, 0.0f }, { 0.05f, 0.05f }, 0.01f, 1.0f, 0.0f };
    const kiriBudget budget = { 32, 500, 100, 0 };
    kiriSheetDef def = StiffDef();
    int32_t index, ticks = 0;
    START_HOST(host);
    World_StopGravity(host.world);
    OK(kiriWorld_SetBudget(host.world, &budget));
    def.fadeTime = 0.2f;
    def.material.airDamping = 30.0f;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 0.1f, 0.05f, 20, 10);
    OK(kiriSheet_AddFold(host.world, sheet, &fold, &index));
    assert_int_equal(index, 0);
    assert_true(World_FoldState(host.world, sheet, 0).length == 0.0);
    while (Host_Tick(&host, Dt, 2) == KIRI_PENDING) {
        ++ticks;
    }
    assert_in_range(ticks, 1, 60);
    assert_true(fabs(World_FoldState(host.world, sheet, 0).length - 0.05) < 1e-8);
    assert_true(fabs(World_FoldState(host.world, sheet, 0).angle) < 0.5); /* it goes on from flat */
    Host_Ticks(&host, 200, Dt, 2);
    assert_true(fabs(World_FoldState(host.world, sheet, 0).angle - 1.0) < 2e-3);
    CheckLips(&host, sheet);
}

TEST(FoldsKeepAnAngle)
{
    double elastic = LetGo(0.0f), yields = LetGo(0.002f);
    print_message("let go at a right angle: %.4f and %.4f rad\n", elastic, yields);
    assert_true(fabs(elastic) < 1e-3);
    assert_true(fabs(yields - (1.57079632679 - 0.2)) < 0.02);
}

/* ---- Vertices ---- */

static const double Degree = 3.14159265358979 / 180.0;

/* A Miura sheet of columns x rows cells: zigzags cross straight lines at `acute`. sign: which way a fold turns. */
typedef struct Miura {
    kiriFold folds[64];
    int count;
    bool isZig[64];
    double sign[64];
} Miura;

static void Miura_Add(Miura* m, const double from[2], const double to[2], bool isZig, double sign)
{
    m->isZig[m->count] = isZig;
    m->sign[m->count] = sign;
    kiriFold* fold = &m->folds[m->count++];
    *fold = (kiriFold){ { (float)from[0], (float)from[1] }, { (float)to[0], (float)to[1] }, 0.0f, 0.0f, 0.0f };
}

static void Miura_Make(Miura* m, int columns, int rows, double width, double height, double acute)
{
    double a = width / columns, b = height / rows, shift = b / tan(acute);
    memset(m, 0, sizeof(*m));
    for (int i = 1; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            const double from[2] = { i * a + (j % 2) * shift - 0.5 * shift, j * b };
            const double to[2] = { i * a + ((j + 1) % 2) * shift - 0.5 * shift, (j + 1) * b };
            Miura_Add(m, from, to, true, i % 2 == 0 ? 1.0 : -1.0);
        }
    }
    for (int j = 1; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            double off = (j % 2) * shift - 0.5 * shift;
            const double from[2] = { i > 0 ? i * a + off : 0.0, j * b };
            const double to[2] = { i + 1 < columns ? (i + 1) * a + off : width, j * b };
            Miura_Add(m, from, to, false, (i % 2 == 0 ? 1.0 : -1.0) * (j % 2 == 0 ? -1.0 : 1.0));
        }
    }
}

/* Zigzags are driven by their rest angles, lines are free. Returns the largest error of an angle against rigid facets,
   degrees. */
static double FoldMiura(int columns, int rows, double acute, int32_t frames, int32_t grid)
{
    double worst = 0.0;
    Miura m;
    START_HOST(host);
    host.every = 50;
    World_StopGravity(host.world);
    Miura_Make(&m, columns, rows, 0.1, 0.1, acute);
    for (int i = 0; i < m.count; ++i) {
        m.folds[i].stiffness = m.isZig[i] ? 0.01f : 0.0f;
    }
    kiriSheetDef def = StiffDef();
    def.material.thickness = 1e-3f;
    def.gridResolution = grid;
    def.frameCount = frames;
    def.iterations = 4;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.1f, 10, 10, m.folds, m.count);
    kiriFrameState state = World_FrameState(host.world, Host_FrameOf(&host, sheet, 0));
    const float u = state.restPoint[0], v = state.restPoint[1] + 1e-4f, ends[4] = { u - 5e-3f, v, u + 5e-3f, v };
    World_Clamp(host.world, sheet, ends, ends + 2); /* holds a facet, and no fold beside it */
    for (int degrees = 0; degrees <= 80; ++degrees) {
        double zig = degrees * Degree, line = 2.0 * atan(cos(acute) * tan(0.5 * zig));
        for (int i = 0; i < m.count; ++i) {
            if (m.isZig[i]) {
                OK(kiriSheet_SetFold(host.world, sheet, i, m.folds[i].stiffness, (float)(m.sign[i] * zig)));
            }
        }
        Host_Ticks(&host, (degrees % 20 == 0 ? 60 : 4), Dt, 2);
        for (int i = 0; i < m.count && degrees % 20 == 0; ++i) {
            double want = m.sign[i] * (m.isZig[i] ? zig : line), is = World_FoldState(host.world, sheet, i).angle;
            worst = fmax(worst, fabs(is - want) / Degree);
        }
    }
    return worst;
}

TEST(VerticesFollowRigidFacets)
{
    assert_true(FoldMiura(2, 2, 60.0 * Degree, 4, 32) < 0.3);
    assert_true(FoldMiura(2, 2, 70.0 * Degree, 12, 40) < 0.3);
    assert_true(FoldMiura(3, 3, 60.0 * Degree, 9, 48) < 0.3);
}

enum { MODE_FRAMES = 32 };

typedef struct Modes {
    kiriFrame frames[MODE_FRAMES];
    double at[3 * MODE_FRAMES], mode[2][3 * MODE_FRAMES]; /* centres at rest; ways that they move, of length 1 */
    int32_t size;
} Modes;

/* Loads the frames by a mode until they rest, and makes the mode of the way that they went. Returns the compliance. */
static double Comply(Host* host, Modes* modes, int k, double load)
{
    double *mode = modes->mode[k], moved[3 * MODE_FRAMES], length = 0.0, compliance = 0.0, share = 0.0;
    for (int t = 0; t < 200; ++t) {
        for (int32_t i = 0; i < modes->size; i += 3) {
            const float force[3] = { (float)(load * mode[i]), (float)(load * mode[i + 1]), (float)(load * mode[i + 2]) };
            OK(kiriFrame_ApplyForce(host->world, modes->frames[i / 3], force, noVector));
        }
        OK(Host_Tick(host, Dt, 2));
    }
    for (int32_t i = 0; i < modes->size; ++i) {
        kiriFrameState state = World_FrameState(host->world, modes->frames[i / 3]);
        moved[i] = ((double)state.position[i % 3] - modes->at[i]) / load;
        compliance += mode[i] * moved[i];
        share += k > 0 ? modes->mode[0][i] * moved[i] : 0.0;
    }
    for (int32_t i = 0; i < modes->size; ++i) {
        mode[i] = moved[i] - share * modes->mode[0][i];
        length += mode[i] * mode[i];
    }
    for (int32_t i = 0; i < modes->size; ++i) {
        mode[i] /= sqrt(length);
    }
    return compliance;
}

/* Folds a Miura sheet to 40 degrees, holds a frame, and finds the two softest modes by power iteration. Returns how many
   times softer the first one is. */
static double SofterBy(int columns, int32_t frameCount, float stiffness)
{
    Miura m;
    Modes modes;
    double compliance[2];
    START_HOST(host);
    host.every = 1000;
    World_StopGravity(host.world);
    Miura_Make(&m, columns, columns, 0.1, 0.1, 60.0 * Degree);
    kiriSheetDef def = StiffDef();
    def.material.thickness = 1e-3f;
    def.material.density = 8.0f;
    def.frameCount = frameCount;
    def.iterations = 4;
    def.gridResolution = 40;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.1f, 10, 10, m.folds, m.count);
    for (int t = 0; t <= 260; ++t) {
        for (int i = 0; i < m.count; ++i) {
            float zig = t < 200 ? 0.01f : stiffness, angle = (float)(m.sign[i] * fmin(40.0, 0.25 * t) * Degree);
            OK(kiriSheet_SetFold(host.world, sheet, i, m.isZig[i] ? zig : 0.0f, angle));
        }
        OK(Host_Tick(&host, Dt, 2));
    }
    modes.size = 3 * World_GetFrames(host.world, sheet, modes.frames, MODE_FRAMES);
    kiriFrameState first = World_FrameState(host.world, modes.frames[0]);
    OK(kiriFrame_Hold(host.world, modes.frames[0], first.position, first.rotation));
    for (int32_t i = 0; i < modes.size; ++i) {
        modes.at[i] = (double)World_FrameState(host.world, modes.frames[i / 3]).position[i % 3];
        modes.mode[0][i] = sin(1.0 + 2.0 * i);
        modes.mode[1][i] = cos(0.7 * i * i);
    }
    for (int k = 0; k < 2; ++k) {
        for (int turn = 0; turn < 5; ++turn) { /* the first turn of the second mode has a share of the first one */
            compliance[k] = Comply(&host, &modes, k, k == 0 || turn == 0 ? 1e-3 * (double)stiffness : 1e-3);
        }
    }
    print_message("%d frames, folds of %g N: %.3g and %.3g m/N, %.0f times softer\n", (int)modes.size / 3, (double)stiffness,
                  compliance[0], compliance[1], compliance[0] / compliance[1]);
    return compliance[0] / compliance[1];
}

/* A Miura sheet has one degree of freedom, but where folds are as stiff as the facets. */
FIGURE(MiuraHasOneSoftMode)
{
    for (int32_t frames = 4; frames <= 16; frames += 6) {
        assert_true(SofterBy(2, frames, 0.001f) > 100.0);
    }
    assert_true(SofterBy(3, 18, 0.001f) > 100.0 && SofterBy(2, 16, 3.0f) < 20.0);
}

/* A waterbomb base from a FOLD file folds from flat to a flat triangle. */
TEST(WaterbombFolds)
{
    static const char file[] =
        "{\"file_spec\":1.1,\"frame_classes\":[\"creasePattern\"],\"frame_unit\":\"mm\","
        "\"vertices_coords\":[[0,0],[100,0],[100,50],[100,100],[0,100],[0,50],[50,50]],"
        "\"edges_vertices\":[[0,1],[1,2],[2,3],[3,4],[4,5],[5,0],[6,0],[6,1],[6,3],[6,4],[6,2],[6,5]],"
        "\"edges_assignment\":[\"B\",\"B\",\"B\",\"B\",\"B\",\"B\",\"V\",\"V\",\"V\",\"V\",\"M\",\"M\"]}";
    enum { MOST = 16, TICKS = 300 };
    const float stiffness = 0.01f, pi = 3.14159265f;
    kiriFold folds[MOST];
    float ways[MOST];
    Import drawing = { 0 };
    START_HOST(host);
    host.every = 50;
    World_StopGravity(host.world);
    assert_true(Import_Read(&drawing, file, (int64_t)strlen(file), 0.01) && Import_Join(&drawing, 0.01));
    int32_t count = Creases_Make(&drawing, 0.001f, stiffness, folds, ways, MOST);
    Import_Free(&drawing);
    assert_in_range(count, 3, 6); /* lines that go straight through the middle are one */
    kiriSheetDef def = StiffDef();
    def.frameCount = 12;
    def.material.airDamping = 10.0f;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.1f, 20, 20, folds, count);
    for (int t = 1; t <= TICKS + 100; ++t) {
        float angle = t < TICKS ? pi * (float)t / TICKS : pi;
        for (int32_t i = 0; i < count; ++i) {
            OK(kiriSheet_SetFold(host.world, sheet, i, stiffness, ways[i] * angle));
        }
        OK(Host_Tick(&host, Dt, 2));
    }
    kiriPieceState piece = World_PieceState(host.world, sheet, 0);
    double size[3], most = 0.0, least = 1.0, all = 0.0;
    for (int a = 0; a < 3; ++a) {
        size[a] = (double)piece.upper[a] - (double)piece.lower[a];
        most = fmax(most, size[a]);
        least = fmin(least, size[a]);
        all += size[a];
    }
    print_message("folded to %.4f x %.4f x %.1g m\n", most, all - most - least, least);
    assert_true(fabs(most - 0.1) < 1e-4 && fabs(all - most - least - 0.05) < 1e-4 && least < 1e-4);
}

/* ---- Random sheets ---- */

static void AnyPoint(float point[2], uint32_t* seed)
{
    point[0] = (float)RandomBetween(seed, -0.1, 1.1);
    point[1] = (float)RandomBetween(seed, -0.1, 1.1);
}

static void AnyFold(kiriFold* fold, uint32_t* seed)
{
    AnyPoint(fold->from, seed);
    fold->to[0] = (float)RandomBetween(seed, 0.0, 1.0);
    fold->to[1] = (float)RandomBetween(seed, 0.0, 1.0);
    if (Random(seed) % 3 == 0) { /* along a line of the mesh, or of the grid */
        fold->to[0] = fold->from[0] = (float)(Random(seed) % 9) / 8.0f;
    }
    fold->stiffness = (float)RandomBetween(seed, 0.0, 1e-3);
    fold->restAngle = (float)RandomBetween(seed, -3.0, 3.0);
    fold->yieldMoment = 0.0f;
}

static void TakePieces(Host* host)
{
    kiriSheet sheet = Host_SheetAt(host, 0), part;
    kiriCounts counts = Host_Counts(host, sheet);
    if (counts.pieces > 1) {
        assert_true(kiriFrame_DetachPiece(host->world, Host_FrameOf(host, sheet, counts.pieces - 1), &part) >= 0);
    }
}

/* A twin that was saved and loaded, or restored, and then writes its whole surface again, goes on in the same way. */
static void CheckTwin(Host* host, bool isSnapshot)
{
    START_HOST(twin);
    for (int t = 0; t < 4; ++t) {
        OK(kiriWorld_FinishCuts(host->world));
        World_Copy(twin.world, host->world, isSnapshot ? kiriWorld_Snapshot : kiriWorld_Save);
        assert_true(Host_Hash(host) == Host_Hash(&twin));
        OK(kiriWorld_FinishCuts(twin.world));
        kiriMesh mesh = Host_Mesh(host, Host_SheetAt(host, 0)), other = Host_Mesh(&twin, Host_SheetAt(&twin, 0));
        assert_memory_equal(mesh.positions, other.positions, 3 * sizeof(float) * (size_t)mesh.vertexCount);
        assert_int_equal(Host_Tick(&twin, Dt, 1), Host_Tick(host, Dt, 1));
        assert_true(Host_Hash(host) == Host_Hash(&twin));
        assert_true(Layout_HashAll(host->world) == Layout_HashAll(twin.world));
    }
}

static void CutBothWays(uint32_t seed)
{
    enum { FOLDS = 6 };
    Host hosts[2];
    int32_t index;
    kiriResult added[2];
    kiriFold folds[FOLDS];
    const uint32_t first = seed;
    for (int i = 0; i < FOLDS; ++i) {
        AnyFold(&folds[i], &seed);
    }
    int32_t count = 1 + (int32_t)(Random(&seed) % FOLDS);
    kiriSheetDef def = StiffDef();
    def.fadeTime = 0.2f;
    def.gridResolution = 16 + (int32_t)(Random(&seed) % 24);
    def.frameCount = (int32_t)(Random(&seed) % 3) * 6;
    def.frameLength = 0.3f;
    def.maxFrames = 60;
    def.collisionPoints = 10;
    def.skinning = (int32_t)(first >> 8) % 2;
    for (int k = 0; k < 2; ++k) {
        Host_Start(&hosts[k]);
        def.paper.fromScratch = k;
        AddFolded(&hosts[k], &def, 1.0f, 1.0f, 8 + (int32_t)(first % 7), 8, folds, count);
    }
    for (int t = 0; t < 12; ++t) {
        float line[4];
        AnyPoint(line, &seed);
        AnyPoint(line + 2, &seed);
        if (t % 4 == 3) { /* along a fold */
            memcpy(line, folds[0].from, sizeof(line));
        }
        kiriFold fold;
        AnyFold(&fold, &seed);
        for (int k = 0; k < 2; ++k) {
            Host_Cut(&hosts[k], Host_SheetAt(&hosts[k], 0), line, 2);
            if (t % 3 == 1) {
                added[k] = kiriSheet_AddFold(hosts[k].world, Host_SheetAt(&hosts[k], 0), &fold, &index);
                assert_true(added[k] == added[0] && (added[0] == KIRI_OK || added[0] == KIRI_ERROR_ARGUMENT));
            }
            assert_true(Host_Tick(&hosts[k], Dt, 1) >= 0);
            if (t % 3 == 2) {
                TakePieces(&hosts[k]);
            }
        }
        if (Layout_HashAll(hosts[0].world) != Layout_HashAll(hosts[1].world)) {
            fail_msg("seed %u, tick %d: what a cut left differs from what is made from scratch", first, t);
        }
        if (Host_Hash(&hosts[0]) != Host_Hash(&hosts[1])) {
            fail_msg("seed %u, tick %d: the motion differs", first, t);
        }
        if (t % 4 == 1) {
            for (int k = 0; k < 2; ++k) {
                CheckTwin(&hosts[k], (t + k) % 2 == 0);
            }
        }
    }
    for (int k = 0; k < 2; ++k) {
        Host_Stop(&hosts[k]);
    }
}

TEST(IncrementalEqualsFromScratch)
{
    for (uint32_t world = 1; world <= RUNS(10); ++world) {
        CutBothWays(world * 2654435761u | 1u);
    }
}

/* Sets folds in one tick of a cut that takes many. Returns true if that was the last one of them. */
static bool SetInTick(int32_t when)
{
    enum { FOLDS = 5 };
    const float cut[4] = { -0.01f, 0.02f, 0.11f, 0.03f };
    const kiriBudget budget = { 16, 400, 100, 0 };
    kiriFold folds[FOLDS];
    kiriSheetDef def = StiffDef();
    START_HOST(host);
    host.every = 50;
    for (int f = 0; f < FOLDS; ++f) {
        float u = 0.1f * (float)(f + 1) / (FOLDS + 1);
        folds[f] = (kiriFold){ { u, -0.01f }, { u, 0.06f }, 0.01f, 0.0f, 0.0f };
    }
    World_StopGravity(host.world);
    def.material.airDamping = 30.0f;
    kiriSheet sheet = AddFolded(&host, &def, 0.1f, 0.05f, 10, 5, folds, FOLDS);
    OK(kiriWorld_SetBudget(host.world, &budget));
    Host_Cut(&host, sheet, cut, 2);
    int32_t tick = 0;
    for (; Host_Tick(&host, Dt, 2) == KIRI_PENDING; ++tick) {
        for (int f = 0; tick == when && f < FOLDS; ++f) {
            OK(kiriSheet_SetFold(host.world, sheet, f, 0.02f, 0.3f));
        }
    }
    assert_in_range(tick, 20, 200);
    Host_Ticks(&host, tick > when ? 60 : 0, Dt, 2);
    for (int f = 0; f < FOLDS && tick > when; ++f) {
        assert_true(fabs(World_FoldState(host.world, sheet, f).angle - 0.3) < 0.03);
    }
    return tick <= when;
}

/* Folds keep what is set, also while links are being made. */
TEST(FoldsAreSetInACut)
{
    int32_t when = 0;
    while (!SetInTick(when)) {
        when += IS_SANITIZED ? 3 : 1;
    }
}

/* Vertices along a fold are rounded, by more than a small snap distance. The fold is whole, and its pieces come off. An end that
   goes on to a border at a slant, by more than two snap distances, belongs to it. */
TEST(SnapsJoinFolds)
{
    static const float snaps[] = { 1e-6f, 1e-9f, 1e-12f, 0.01f }, lengths[] = { 1.172f, 1.172f, 1.172f, 0.345f };
    for (int k = 0; k < 4; ++k) {
        kiriFold fold = k < 3 ? (kiriFold){ { -0.1f, 0.137f }, { 1.1f, 0.871f }, 0.01f, 0.0f, 0.0f }
                              : (kiriFold){ { 0.7015f, 0.0126f }, { 0.4318f, 0.189f }, 0.01f, 0.0f, 0.0f };
        kiriSheetDef def = StiffDef();
        START_HOST(host);
        def.frameCount = 12;
        def.snapDistance = snaps[k];
        kiriSheet sheet = AddFolded(&host, &def, 1.0f, 1.0f, 16, 16, &fold, 1);
        assert_true(fabs(World_FoldState(host.world, sheet, 0).length - lengths[k]) < 0.01);
    }
}
