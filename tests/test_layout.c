/* Sheets with crooked layouts of frames. Squares of paper, one edge clamped, hang as the heavy elastica without
   Poisson's ratio, whatever slit they have; strips with a crooked row of frames twist as others do. */
#include "host.h"

#include "reference.h"

#include <stdio.h>

#define SIDE 0.2f

enum { MOST_TICKS = 400, MOST_ROWS = 17 };

/* As stiff and as heavy as printing paper, and `thin` times as thick. */
static kiriSheetDef PaperDef(int32_t grid, float thin)
{
    kiriSheetDef def = DefaultSheet();
    OK(kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material));
    def.material.poissonsRatio = 0.0f;
    def.material.airDamping = 20.0f;
    def.material.flexDamping = 0.0f;
    def.material.yieldStress = 0.0f; /* theory is elastic */
    def.material.thickness *= thin;
    def.material.density /= thin;
    def.material.youngsModulus /= thin * thin * thin;
    def.gridResolution = grid;
    def.rigidWeight = 2.0f;
    def.iterations = 4;
    def.sleepSpeed = 0.0f;
    def.timeStepping = KIRI_TIME_STEPPING_EULER;
    return def;
}

static double TipInTheory(void)
{
    static Elastica elastica;
    kiriSheetDef def = PaperDef(1, 1.0f);
    double h = (double)def.material.thickness, L = (double)SIDE, x, drop;
    double bending = (double)def.material.youngsModulus * h * h * h / 12.0;
    Elastica_Solve(&elastica, (double)def.material.density * h * 9.81 * L * L * L / bending);
    Elastica_At(&elastica, 1.0, &x, &drop);
    return L * drop;
}

/* Clamps the edge u = 0, cuts the slit unless it is null, and lets the sheet hang. Returns the error of the far edge's
   mean drop. */
static double HangingError(Host* host, kiriSheet sheet, const float* slit)
{
    const float from[2] = { 0.0f, 0.0f }, to[2] = { 0.0f, SIDE };
    double drop = 0.0;
    int32_t found = 0;
    World_Clamp(host->world, sheet, from, to);
    if (slit != NULL) {
        Host_Cut(host, sheet, slit, 2);
    }
    for (int32_t tick = 0, calm = 0; calm < 3; ++tick) {
        assert_true(tick < MOST_TICKS);
        OK(kiriWorld_Tick(host->world, 0.05f, 1));
        kiriTotals totals = Host_Totals(host, sheet);
        calm = 0.05 * sqrt(2.0 * totals.kineticEnergy / totals.mass) < 1e-6 * (double)SIDE ? calm + 1 : 0;
    }
    kiriMesh mesh = Host_Mesh(host, sheet);
    for (int32_t i = 0; i < mesh.vertexCount; ++i) {
        if (mesh.restPositions[2 * i] > SIDE - 1e-6f) {
            drop -= (double)mesh.positions[3 * i + 2];
            ++found;
        }
    }
    return fabs(drop / found / TipInTheory() - 1.0);
}

/* ---- Slits ------------------------------------------------------------------------------------------------------- */

/* Half as long as the square, `aside` of its middle. The library spreads the frames: around the slit if it is there from
   the start, else before the cut. */
static double SlitError(int32_t frames, int32_t grid, double angle, double aside, bool isThere)
{
    float u = (float)(0.25 * cos(angle)) * SIDE, v = (float)(0.25 * sin(angle)) * SIDE, middle = 0.5f * SIDE + (float)aside;
    const float slit[4] = { middle - u, middle - v, middle + u, middle + v };
    Host host, mould;
    kiriSheetDef def = PaperDef(grid, 1.0f), plain = def;
    kiriSheet sheet;
    plain.frameCount = plain.maxFrames = 1;
    def.frameCount = def.maxFrames = frames;
    Host_Start(&host);
    Host_Start(&mould);
    host.every = 1000;
    if (isThere) {
        kiriSheet cut = Host_AddRectangle(&mould, &plain, SIDE, SIDE, grid, grid);
        Host_Cut(&mould, cut, slit, 2);
        OK(kiriWorld_Tick(mould.world, 1e-3f, 1));
        kiriMesh mesh = Host_Mesh(&mould, cut);
        def.restPositions = mesh.restPositions;
        def.vertexCount = mesh.vertexCount;
        def.indices = mesh.indices;
        def.triangleCount = mesh.triangleCount;
        OK(kiriCreateSheet(host.world, &def, &sheet));
    } else {
        sheet = Host_AddRectangle(&host, &def, SIDE, SIDE, grid, grid);
    }
    double error = HangingError(&host, sheet, isThere ? NULL : slit);
    Host_Stop(&mould);
    Host_Stop(&host);
    return error;
}

FIGURE(SlitSquaresHangAsTheyShould)
{
    static const struct {
        int32_t frames;
        double most;
    } cases[5] = { { 16, 0.02 }, { 25, 0.0125 }, { 36, 0.01 }, { 49, 0.01 }, { 81, 0.005 } };
    static const int32_t grids[3] = { 40, 60, 80 };
    for (int k = 0; k < 5; ++k) {
        double worst = 0.0;
        for (int turn = 0; turn < 8; ++turn) {
            double angle = 3.14159265358979 / 8.0 * turn, aside = 0.06 * (double)SIDE * (turn % 3 - 1);
            worst = fmax(worst, SlitError(cases[k].frames, grids[turn % 3], angle, aside, turn % 4 < 2));
        }
        print_message("%d frames: %.2f %%\n", cases[k].frames, 100.0 * worst);
        assert_true(worst < cases[k].most);
    }
}

/* ---- Rows -------------------------------------------------------------------------------------------------------- */

/* Rows of frames with each frame moved by up to a quarter of the spacing. */
FIGURE(JitteredRowsHangAsTheyShould)
{
    static const struct {
        int32_t rows;
        double most;
    } cases[3] = { { 5, 0.03 }, { 9, 0.01 }, { 17, 0.005 } };
    static const float thin[4] = { 10.0f, 3.0f, 1.0f, 0.3f };
    for (int k = 0; k < 12; ++k) {
        int32_t rows = cases[k / 4].rows, count = rows * rows;
        static float points[2 * MOST_ROWS * MOST_ROWS];
        uint32_t seed = 101 + (uint32_t)k;
        kiriSheetDef def = PaperDef(4 * rows, thin[k % 4]);
        for (int32_t i = 0; i < 2 * count; ++i) {
            int32_t row = i % 2 == 0 ? i / 2 % rows : i / 2 / rows;
            points[i] = SIDE * (((float)row + 0.5f) / (float)rows + (float)RandomBetween(&seed, -0.25, 0.25) / (float)rows);
        }
        def.frameCount = def.maxFrames = count;
        def.framePoints = points;
        START_HOST(host);
        host.every = 1000;
        kiriSheet sheet = Host_AddRectangle(&host, &def, SIDE, SIDE, 4 * rows, 4 * rows);
        double error = HangingError(&host, sheet, NULL);
        print_message("%d rows, h/L 1/%.0f: %.2f %%\n", rows, (double)(SIDE / def.material.thickness), 100.0 * error);
        assert_true(error < cases[k / 4].most);
    }
}

/* A strip of 0.2 x 0.02 m with one row of frames that zigzags by `aside` widths to both sides, clamped at both ends. */
static kiriSheet AddClampedStrip(Host* host, kiriSheetDef* def, int32_t count, double aside, const float gravity[3],
                                 int32_t columns, kiriPin clamps[2])
{
    const float length = 0.2f, width = 0.02f;
    const float ends[8] = { 0.0f, 0.0f, 0.0f, width, length, 0.0f, length, width };
    float points[2 * 64];
    def->frameCount = def->maxFrames = count;
    def->framePoints = points;
    for (int32_t i = 0; i < count; ++i) {
        points[2 * i] = length * ((float)i + 0.5f) / (float)count;
        points[2 * i + 1] = width * (float)(i % 2 == 0 ? 0.5 - aside : 0.5 + aside);
    }
    Host_Start(host);
    host->every = 1000;
    OK(kiriWorld_SetGravity(host->world, gravity));
    kiriSheet sheet = Host_AddRectangle(host, def, length, width, columns, columns / 10);
    OK(kiriSheet_ClampLine(host->world, sheet, ends, ends + 2, &clamps[0]));
    OK(kiriSheet_ClampLine(host->world, sheet, ends + 4, ends + 6, &clamps[1]));
    return sheet;
}

/* Returns the torque that twists a zigzag by 0.1 rad, by Saint-Venant's. */
static double TorqueOfZigzag(int32_t count, double aside, float poissonsRatio)
{
    const float length = 0.2f, width = 0.02f, angle = 0.1f;
    const float middle[3] = { length, 0.5f * width };
    const float turned[9] = { 1.0f, 0.0f, 0.0f, 0.0f, cosf(angle), sinf(angle), 0.0f, -sinf(angle), cosf(angle) };
    kiriSheetDef def = PaperDef(160, 1.0f);
    def.material = (kiriMaterial){ 7.4e8f, poissonsRatio, 5e-4f, 1000.0f, 20.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    Host host;
    kiriPin clamps[2];
    double force[3], torque[3];
    AddClampedStrip(&host, &def, count, aside, noVector, 160, clamps);
    OK(kiriPin_SetPose(host.world, clamps[1], middle, turned));
    World_Ticks(host.world, 200, 0.5f, 1);
    OK(kiriPin_GetReaction(host.world, clamps[1], force, torque));
    Host_Stop(&host);
    double nu = (double)poissonsRatio, h = 5e-4, D = 7.4e8 * h * h * h / (12.0 * (1.0 - nu * nu));
    return torque[0] / (2.0 * (1.0 - nu) * D * (double)width * (double)angle / (double)length);
}

FIGURE(ZigzagsTwistAsTheyShould)
{
    static const int32_t counts[4] = { 8, 12, 16, 24 };
    for (int k = 0; k < 8; ++k) {
        double worst = 0.0;
        for (int step = 0; step <= 5; ++step) {
            double off = fabs(TorqueOfZigzag(counts[k / 2], 0.05 * step, k % 2 == 0 ? 0.0f : 0.3f) - 1.0);
            worst = off > worst ? off : worst;
        }
        print_message("%d frames, nu %.1f: %.2f %%\n", counts[k / 2], 0.3 * (k % 2), 100.0 * worst);
        assert_true(worst < (counts[k / 2] > 12 ? 0.03 : 0.01));
    }
}

/* ---- Clamps ------------------------------------------------------------------------------------------------------ */

/* A strip between two clamps sags as a beam under a small load, and resists as a bar when it is pulled by 1 %. */
static void CheckClampedStrip(int32_t count, int32_t skinning)
{
    const float length = 0.2f, width = 0.02f;
    const double E = 7.4e8, h = 2e-4, sag = 0.02 * h, L = (double)length;
    const float load[3] = { 0.0f, 0.0f, (float)(-sag * 32.0 * E * h * h / (1000.0 * L * L * L * L)) };
    kiriSheetDef def = PaperDef(80, 1.0f);
    def.material = (kiriMaterial){ (float)E, 0.0f, (float)h, 1000.0f, 20.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.skinning = skinning;
    Host host;
    kiriPin clamps[2];
    kiriSheet sheet = AddClampedStrip(&host, &def, count, 0.0, load, 80, clamps);
    World_Ticks(host.world, 100, 0.5f, 1);
    kiriMesh mesh = Host_Mesh(&host, sheet);
    double low = 0.0, force[3], torque[3];
    for (int32_t i = 0; i < mesh.vertexCount; ++i) {
        low = fmin(low, (double)mesh.positions[3 * i + 2]);
    }
    for (int32_t tick = 0; tick < 900; ++tick) {
        const float target[3] = { length * (1.0f + (tick < 100 ? 1e-4f * (float)tick : 0.01f)), 0.5f * width, 0.0f };
        OK(kiriPin_SetTarget(host.world, clamps[1], target));
        OK(kiriWorld_Tick(host.world, 1.0f / 30.0f, 2));
    }
    OK(kiriPin_GetReaction(host.world, clamps[1], force, torque));
    Host_Stop(&host);
    double pull = force[0] / (E * h * (double)width * 0.01);
    print_message("%d frames, skinning %d: sag %.4f, force %.4f\n", count, skinning, -low / sag, pull);
    assert_true(fabs(-low / sag - 1.0) < 0.03);
    assert_true(fabs(pull - 1.0) < 0.005);
}

FIGURE(ClampedStripsAreAsStiffAsTheyShould)
{
    static const int32_t counts[4] = { 3, 5, 9, 17 };
    for (int k = 0; k < 8; ++k) {
        CheckClampedStrip(counts[k / 2], k % 2 == 0 ? KIRI_SKINNING_LINEAR : KIRI_SKINNING_SMOOTH);
    }
}

typedef enum Hold { HANGS, PULLED } Hold;

/* Returns the seen elongation of a soft smooth strip that hangs by its upper end, or is pulled at both ends by 2 %, over
   the elongation of theory. The ends are in clamps or hinges; sites are off rows by up to `jitter` of a spacing. */
static double ElongationOfStrip(Hold hold, bool isHinged, int32_t count, double jitter, uint32_t seed)
{
    enum { COLUMNS = 40, ROWS = 10 };
    const float length = 0.2f, width = 0.05f, strain = 0.02f;
    const float ends[8] = { 0.0f, 0.0f, 0.0f, width, length, 0.0f, length, width };
    float points[2 * 16];
    kiriPin pins[2];
    START_HOST(host);
    host.every = 1000;
    kiriSheetDef def = PaperDef(80, 1.0f);
    double E = hold == HANGS ? 1000.0 * 9.81 * (double)length / (2.0 * (double)strain) : 1e6;
    def.material = (kiriMaterial){ (float)E, 0.0f, 1e-3f, 1000.0f, 20.0f, 0.0f, 0.0f, 0.0f, 0.0f, 0, { 0.0f } };
    def.skinning = KIRI_SKINNING_SMOOTH;
    def.frameCount = def.maxFrames = count;
    def.framePoints = points;
    for (int32_t i = 0; i < count; ++i) {
        points[2 * i] = length * (float)(i + 0.5 + RandomBetween(&seed, -jitter, jitter)) / (float)count;
        points[2 * i + 1] = 0.5f * width;
    }
    OK(kiriWorld_SetGravity(host.world, (float[]){ hold == HANGS ? 9.81f : 0.0f, 0.0f, 0.0f }));
    kiriSheet sheet = Host_AddRectangle(&host, &def, length, width, COLUMNS, ROWS);
    for (int k = 0; k < (hold == HANGS ? 1 : 2); ++k) {
        OK(isHinged ? kiriSheet_HingeLine(host.world, sheet, ends + 4 * k, ends + 4 * k + 2, &pins[k])
                    : kiriSheet_ClampLine(host.world, sheet, ends + 4 * k, ends + 4 * k + 2, &pins[k]));
    }
    if (hold == PULLED) {
        OK(kiriPin_SetTarget(host.world, pins[1], (float[]){ length * (1.0f + strain), 0.5f * width, 0.0f }));
    }
    World_Ticks(host.world, 600, 1.0f / 60.0f, 2);
    kiriMesh mesh = Host_Mesh(&host, sheet);
    double far = 0.0, near = 0.0;
    for (int32_t row = 0; row <= ROWS; ++row) {
        near += (double)mesh.positions[3 * row * (COLUMNS + 1)] / (ROWS + 1);
        far += (double)mesh.positions[3 * (row * (COLUMNS + 1) + COLUMNS)] / (ROWS + 1);
    }
    return (far - near - (double)length) / (double)(length * strain);
}

FIGURE(SoftStripsAreSeenAsLongAsTheyShould)
{
    static const int32_t counts[3] = { 3, 5, 9 };
    for (uint32_t k = 0; k < 12; ++k) {
        Hold hold = k % 2 == 0 ? HANGS : PULLED;
        int32_t count = counts[k / 4];
        double even = ElongationOfStrip(hold, k / 2 % 2 == 1, count, 0.0, 0);
        double moved = ElongationOfStrip(hold, k / 2 % 2 == 1, count, 0.1, k + 1);
        print_message("%d frames, %s, %s: %.4f, %.4f\n", count, hold == HANGS ? "hangs" : "pulled",
                      k / 2 % 2 == 1 ? "hinged" : "clamped", even, moved);
        assert_true(fabs(even - 1.0) < 0.005 && fabs(moved - 1.0) < (hold == HANGS ? 0.03 : 0.005));
    }
}

/* Returns the height, over the length, of the teardrop that a strip of spread frames forms: its clamped ends come together
   and turn upward within `ticks`. */
static double HeightOfTeardrop(int32_t count, int32_t ticks)
{
    const float length = 0.2f, width = 0.02f;
    const float ends[8] = { 0.0f, 0.0f, 0.0f, width, length, 0.0f, length, width };
    kiriPin clamps[2];
    START_HOST(host);
    host.every = 1000;
    kiriSheetDef def = PaperDef(80, 1.0f);
    def.skinning = KIRI_SKINNING_SMOOTH;
    def.frameCount = def.maxFrames = count;
    World_StopGravity(host.world);
    kiriSheet sheet = Host_AddRectangle(&host, &def, length, width, 80, 8);
    for (int k = 0; k < 2; ++k) {
        OK(kiriSheet_ClampLine(host.world, sheet, ends + 4 * k, ends + 4 * k + 2, &clamps[k]));
    }
    for (int32_t tick = 1; tick <= ticks + 300; ++tick) {
        float part = fminf((float)tick / (float)ticks, 1.0f), c = cosf(1.57079633f * part), s = sinf(1.57079633f * part);
        for (int k = 0; k < 2; ++k) {
            float x = 0.5f * length * (k == 0 ? part : 2.0f - part), up = k == 0 ? s : -s;
            const float turned[9] = { c, 0.0f, up, 0.0f, 1.0f, 0.0f, -up, 0.0f, c };
            OK(kiriPin_SetPose(host.world, clamps[k], (float[]){ x, 0.5f * width, 0.0f }, turned));
        }
        OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 2));
    }
    kiriMesh mesh = Host_Mesh(&host, sheet);
    double height = 0.0;
    for (int32_t i = 0; i < mesh.vertexCount; ++i) {
        height = fmax(height, (double)mesh.positions[3 * i + 2]);
    }
    return height / (double)length;
}

FIGURE(TeardropsAreAsHighAsTheyShould)
{
    static const int32_t counts[4] = { 12, 24, 36, 48 };
    for (int k = 0; k < 8; ++k) {
        double off = HeightOfTeardrop(counts[k / 2], k % 2 == 0 ? 143 : 20) / 0.424308 - 1.0; /* of the elastica */
        print_message("%d frames: %.2f %%\n", counts[k / 2], 100.0 * off);
        assert_true(fabs(off) < 0.03);
    }
}

/* N, with which a planar strip of nine frames resists a change of its length. */
static double ForceOfStrip(float slack, float strain)
{
    const float length = 0.2f, width = 0.02f;
    kiriSheetDef def = PaperDef(80, 1.0f);
    def.material = (kiriMaterial){ 7.4e8f, 0.0f, 2e-4f, 1000.0f, 20.0f, 0.0f, 0.0f, 0.0f, slack, 0, { 0.0f } };
    def.planar = 1;
    HOST(host);
    kiriPin clamps[2];
    AddClampedStrip(&host, &def, 9, 0.0, (float[]){ 0.0f, 0.0f, 0.0f }, 80, clamps);
    for (int32_t tick = 1; tick <= 400; ++tick) {
        float way = strain * fminf((float)tick / 100.0f, 1.0f);
        OK(kiriPin_SetTarget(host.world, clamps[1], (float[]){ length * (1.0f + way), 0.5f * width, 0.0f }));
        OK(kiriWorld_Tick(host.world, 1.0f / 30.0f, 2));
    }
    double force[3], torque[3];
    OK(kiriPin_GetReaction(host.world, clamps[1], force, torque));
    return force[0];
}

/* Slack changes compression alone: beyond a few thousandths, the part that stays resists. */
TEST(SlackGivesUnderCompression)
{
    double full = ForceOfStrip(0.0f, -0.02f), slack = ForceOfStrip(0.9f, -0.02f);
    print_message("a strip pressed by 2 %%: %.2f N, with slack %.2f N\n", full, slack);
    assert_true(slack / full > 0.105 && slack / full < 0.115);
    assert_true(ForceOfStrip(0.9f, 0.01f) == ForceOfStrip(0.0f, 0.01f));
}

/* ---- Folds ------------------------------------------------------------------------------------------------------- */

static void PinCorners(Host* host, kiriSheet sheet, kiriPin pins[2])
{
    for (int32_t corner = 0; corner < 2; ++corner) {
        pins[corner] = Host_Pin(host, sheet, (float)corner, 1.0f, (float)corner, 1.0f, 0.0f);
    }
}

/* A square that hangs in its plane by two corners, which come half as near in a second: it leaves the plane. */
TEST(FlatSquaresFold)
{
    static const int32_t materials[3] = { KIRI_MATERIAL_COTTON, KIRI_MATERIAL_PAPER, KIRI_MATERIAL_RUBBER };
    for (int k = 0; k < 6; ++k) {
        const float down[3] = { 0.0f, -9.81f, 0.0f };
        kiriPin pins[2];
        START_HOST(host);
        host.every = 100;
        OK(kiriWorld_SetGravity(host.world, down));
        kiriSheetDef def = DefaultSheet();
        OK(kiriGetMaterial(materials[k / 2], &def.material));
        def.frameCount = k % 2 == 0 ? 9 : 25;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 40, 40);
        PinCorners(&host, sheet, pins);
        for (int32_t tick = 1; tick <= 60; ++tick) {
            float way = 0.25f / 60.0f * (float)tick;
            OK(kiriPin_SetTarget(host.world, pins[0], (float[]){ way, 1.0f, 0.0f }));
            OK(kiriPin_SetTarget(host.world, pins[1], (float[]){ 1.0f - way, 1.0f, 0.0f }));
            OK(Host_Tick(&host, 1.0f / 60.0f, 4));
        }
        kiriMesh mesh = Host_Mesh(&host, sheet);
        double off = 0.0;
        for (int32_t i = 0; i < mesh.vertexCount; ++i) {
            off = fmax(off, fabs((double)mesh.positions[3 * i + 2]));
        }
        print_message("material %d, %d frames: %.3f m off the plane\n", materials[k / 2], def.frameCount, off);
        assert_true(off > 0.02);
    }
}

/* Rubber of crooked frames that is pulled by 2 in a thousand: tension holds most layouts in their plane, however they are
   pushed. */
FIGURE(TautSheetsStayFlat)
{
    enum { COLUMNS = 5, ROWS = 4, TICKS = 240, PUSHED = 160 };
    static const float flat[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
    int32_t left = 0;
    for (uint32_t k = 0; k < 6; ++k) {
        uint32_t seed = 77 + k;
        float points[2 * COLUMNS * ROWS];
        for (int i = 0; i < COLUMNS * ROWS; ++i) {
            points[2 * i] = (float)((i % COLUMNS + 0.5 + RandomBetween(&seed, -0.25, 0.25)) / COLUMNS);
            points[2 * i + 1] = (float)(0.8 * (i / COLUMNS + 0.5 + RandomBetween(&seed, -0.25, 0.25)) / ROWS);
        }
        START_HOST(host);
        host.every = 100;
        OK(kiriWorld_SetGravity(host.world, (float[]){ 0.0f, 0.0f, 0.0f }));
        kiriSheetDef def = DefaultSheet();
        OK(kiriGetMaterial(KIRI_MATERIAL_RUBBER, &def.material));
        def.frameCount = def.maxFrames = COLUMNS * ROWS;
        def.framePoints = points;
        def.iterations = 4;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.8f, 20, 16);
        kiriPin clamps[2];
        OK(kiriSheet_ClampLine(host.world, sheet, (float[]){ 0.0f, 0.0f }, (float[]){ 0.0f, 0.8f }, &clamps[0]));
        OK(kiriSheet_ClampLine(host.world, sheet, (float[]){ 1.0f, 0.0f }, (float[]){ 1.0f, 0.8f }, &clamps[1]));
        kiriPinState start;
        OK(kiriPin_GetState(host.world, clamps[1], &start));
        for (int32_t tick = 0; tick < TICKS; ++tick) {
            float target[3] = { start.target[0] + 0.002f * fminf((float)tick / PUSHED, 1.0f), start.target[1], 0.0f };
            const float at[2] = { 0.2f + 0.1f * (float)(tick % 7), 0.1f + 0.1f * (float)(tick % 6) };
            OK(kiriPin_SetPose(host.world, clamps[1], target, flat));
            if (tick < PUSHED) {
                const float push[3] = { 0.0f, 0.0f, tick % 2 == 0 ? 1e-3f : -1e-3f };
                OK(kiriSheet_ApplyForce(host.world, sheet, at, push, (float[]){ 0.0f, 0.0f, 0.0f }));
            }
            OK(Host_Tick(&host, 1.0f / 60.0f, 2));
        }
        kiriMesh mesh = Host_Mesh(&host, sheet);
        double off = 0.0;
        for (int32_t i = 0; i < mesh.vertexCount; ++i) {
            off = fmax(off, fabs((double)mesh.positions[3 * i + 2]));
        }
        print_message("layout %u: %.3g m off the plane\n", k, off);
        left += off > 1e-3;
    }
    assert_in_range(left, 0, 2);
}

/* Cotton that hangs by two corners while a spiral is cut into it. Its links fold by half a turn. */
TEST(SpiralsNeverFreeze)
{
    static const int32_t counts[2] = { 24, 40 };
    static const double rounds[8] = { 2.0, 2.5, 3.0, 3.5, 4.0, 4.85, 4.5, 4.95 };
    for (int k = 0; k < RUNS(8); ++k) {
        static float were[3 * 8000];
        double turns = rounds[k];
        int32_t systems = 0, still = 0;
        START_HOST(host);
        host.every = 100;
        kiriSheetDef def = DefaultSheet();
        OK(kiriGetMaterial(KIRI_MATERIAL_COTTON, &def.material));
        def.frameCount = counts[k % 2];
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 40, 40);
        kiriPin pins[2];
        PinCorners(&host, sheet, pins);
        kiriCut cut = 0;
        for (int32_t tick = 0; tick < 400; ++tick) {
            double share = (tick - 20) / 200.0, r = 0.42 * (1.0 - 0.85 * share), angle = 6.28318530717958 * turns * share;
            const float to[2] = { (float)(0.5 + r * cos(angle)), (float)(0.5 + r * sin(angle)) };
            if (tick == 20) {
                OK(kiriBeginCut(host.world, sheet, to, &cut));
            } else if (tick > 20 && tick < 220) {
                OK(kiriCut_Extend(host.world, cut, to, 1));
            } else if (tick == 220) {
                OK(kiriCut_End(host.world, cut));
            }
            OK(Host_Tick(&host, 1.0f / 60.0f, 2));
            kiriMesh mesh = Host_Mesh(&host, sheet);
            double moved = 0.0;
            assert_true(mesh.vertexCount <= 8000);
            systems += World_Profile(host.world).systemsSolved;
            for (int32_t i = 0; i < 3 * mesh.vertexCount; ++i) {
                moved = fmax(moved, fabs((double)mesh.positions[i] - (double)were[i]));
                were[i] = mesh.positions[i];
            }
            still += moved < 1e-6;
        }
        print_message("%d frames, %.1f turns: %d still ticks, %.1f systems\n", counts[k % 2], turns, still,
                      systems / 400.0);
        assert_int_equal(still, 0);
    }
}
