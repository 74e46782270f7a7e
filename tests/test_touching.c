/* Pieces that touch get no energy out of nothing. Their pins and obstacles stand still, so kinetic and
   potential energy together stay below the first value. No piece is faster than a free fall. A tick looks only at near
   pieces. Random layouts: grids, discs, strips, kirigami; free, hanging, without gravity, on a floor. Sheets that meet
   keep their momentum. `make test` runs one seed of each layout; with an argument the program runs 20 seeds and prints
   figures. */
#include "host.h"

enum { GRID, DISCS, STRIPS, KIRIGAMI, CORNERS, LAYOUTS };
enum { FREE, RESTING, HANGING, ON_A_FLOOR, WAYS };

static const float dt = 1.0f / 60.0f;
static const double g = 9.81, size = 0.3;

static bool isLoud = false;
static int32_t missed; /* layouts beyond the limits */

typedef struct Touching {
    Host host;
    kiriSheet sheet;
    uint32_t seed;
    int layout, way;
    double first, most; /* J: the first energy, and the largest of all ticks; */
    double fastest;     /* m/s */
    int32_t pieces, nears, contacts;
} Touching;

static void CutLine(Touching* t, double x, double y, double toX, double toY)
{
    const float line[] = { (float)x, (float)y, (float)toX, (float)toY };
    Host_Cut(&t->host, t->sheet, line, 2);
}

static void CutRound(Touching* t, double x, double y, double radius, int corners, double turn)
{
    float line[2 * 33];
    assert_true(corners <= 32);
    for (int k = 0; k <= corners; ++k) {
        double angle = turn + 6.283185307179586 * (k % corners) / corners;
        line[2 * k] = (float)(x + radius * cos(angle));
        line[2 * k + 1] = (float)(y + radius * sin(angle));
    }
    Host_Cut(&t->host, t->sheet, line, corners + 1);
}

static double Between(Touching* t, double low, double high)
{
    return RandomBetween(&t->seed, low, high);
}

static void CutGrid(Touching* t)
{
    int count = 3 + (int)(Random(&t->seed) % 6);
    for (int i = 1; i < count; ++i) {
        double at = size * i / count;
        CutLine(t, at, -0.1, at, 0.4);
        CutLine(t, -0.1, at, 0.4, at);
    }
}

/* Each with crumbs close by. */
static void CutDiscs(Touching* t)
{
    for (int i = 0; i < 2; ++i) {
        double x = size * (0.25 + 0.5 * i) + Between(t, -0.01, 0.01), y = Between(t, 0.06, 0.2), radius = 0.028;
        CutRound(t, x, y, radius, 24, 0.0);
        for (int k = 0; k < 8; ++k) {
            double angle = 0.785398 * k + Between(t, 0.0, 0.5), far = radius + Between(t, 0.0022, 0.004);
            CutRound(t, x + far * cos(angle), y + far * sin(angle), Between(t, 0.0007, 0.0012), 4, angle);
        }
    }
}

static void CutStrips(Touching* t)
{
    int count = 6 + (int)(Random(&t->seed) % 12);
    for (int i = 1; i < count; ++i) {
        double low = size * i / count + Between(t, -0.003, 0.003), high = size * i / count + Between(t, -0.003, 0.003);
        CutLine(t, low, -0.1, high, 0.4);
    }
}

/* Slits in rows that take turns, and holes between them. */
static void CutKirigami(Touching* t)
{
    int rows = 5 + (int)(Random(&t->seed) % 4);
    double pitch = size / (rows + 1);
    for (int j = 0; j < rows; ++j) {
        double y = pitch * (j + 1);
        for (int i = 0; i <= 3; ++i) {
            double x = 0.1 * i - (j % 2 == 0 ? 0.05 : 0.0);
            CutLine(t, x + 0.012, y, x + 0.088, y);
            CutRound(t, x + 0.05, y + 0.5 * pitch, 0.3 * pitch, 3 + (int)(Random(&t->seed) % 4), Between(t, 0.0, 3.0));
        }
    }
}

/* Off all corners, 1 to 64 mm from them. */
static void CutCorners(Touching* t)
{
    for (int k = 0; k < 4; ++k) {
        double x = k % 2 * size, y = k / 2 * size, far = 0.001 * (1 << 2 * k);
        double u = k % 2 == 0 ? far : -far, v = k / 2 == 0 ? far : -far;
        CutLine(t, x - u, y + 2.0 * v, x + 2.0 * u, y - v);
    }
}

static void Start(Touching* t, int layout, int way, uint32_t seed)
{
    static void (*const cut[])(Touching*) = { CutGrid, CutDiscs, CutStrips, CutKirigami, CutCorners };
    kiriPin pin;
    memset(t, 0, sizeof(*t));
    Host_Start(&t->host);
    t->host.every = 20;
    t->seed = 2654435761u * (seed + 1);
    t->layout = layout;
    t->way = way;
    const float gravity[3] = { 0.0f, way == HANGING ? -(float)g : 0.0f, way == FREE || way == ON_A_FLOOR ? -(float)g : 0.0f };
    OK(kiriWorld_SetGravity(t->host.world, gravity));
    kiriSheetDef def = DefaultSheet();
    kiriGetMaterial(seed % 2 == 0 ? KIRI_MATERIAL_COTTON : KIRI_MATERIAL_PAPER, &def.material);
    def.frameCount = 9;
    def.touchesSheets = 1;
    def.position[2] = way == ON_A_FLOOR ? 0.05f : 0.0f;
    t->sheet = Host_AddRectangle(&t->host, &def, (float)size, (float)size, 48, 48);
    if (way == HANGING) {
        OK(kiriSheet_HingeLine(t->host.world, t->sheet, (float[]){ 0.0f, (float)size },
                               (float[]){ (float)size, (float)size }, &pin));
    }
    if (way == ON_A_FLOOR) {
        World_AddFloor(t->host.world);
    }
    OK(Host_Tick(&t->host, dt, 1));
    cut[layout](t);
}

static void Look(Touching* t, int tick)
{
    kiriTotals totals = Host_Totals(&t->host, t->sheet);
    double fall = t->way == HANGING ? totals.center[1] : t->way == RESTING ? 0.0 : totals.center[2];
    double energy = totals.kineticEnergy + totals.mass * g * fall + totals.elasticEnergy;
    t->pieces = Host_Counts(&t->host, t->sheet).pieces;
    t->first = tick == 0 ? energy : t->first;
    t->most = tick == 0 || energy > t->most ? energy : t->most;
    for (int32_t i = 0; i < t->pieces; ++i) {
        kiriPieceState piece = World_PieceState(t->host.world, t->sheet, i);
        const double* p = piece.momentum;
        t->fastest = fmax(sqrt(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) / piece.mass, t->fastest);
    }
    kiriProfile profile = World_Profile(t->host.world);
    t->nears = profile.sheetPairs > t->nears ? profile.sheetPairs : t->nears;
    t->contacts = profile.contacts > t->contacts ? profile.contacts : t->contacts;
}

/* A floor pushes out deep points at 1 m/s; crumbs between it and a sheet get a few times as fast. */
static double MostSpeed(int way, int ticks)
{
    return way == RESTING ? 0.0 : way == ON_A_FLOOR ? 6.0 : g * (ticks + 1) * (double)dt;
}

/* Runs one layout. Tolerances: of energy a thousandth of the weight times the size of the sheet; of speed 0.2 m/s. At
   most 8 pairs and 400 contacts a piece. */
static void Run(int layout, int way, uint32_t seed, int ticks)
{
    Touching t;
    Start(&t, layout, way, seed);
    for (int tick = 0; tick < ticks; ++tick) {
        assert_true(Host_Tick(&t.host, dt, 1) >= KIRI_OK);
        Look(&t, tick);
    }
    double whole = Host_Totals(&t.host, t.sheet).mass * g * size, rise = (t.most - t.first) / whole;
    double falls = MostSpeed(way, ticks);
    if (isLoud) {
        print_message("layout %d way %d seed %2u: %3d pieces, energy %+.2g, "
                      "fastest %.3g above %.3g m/s, %d pairs, %d contacts\n",
                      layout, way, seed, t.pieces, rise, t.fastest, falls, t.nears, t.contacts);
    }
    assert_true(t.pieces > 1);
    if (!(rise < 1e-3 && t.fastest < falls + 0.2)) {
        print_message("missed: layout %d way %d seed %u\n", layout, way, seed);
        missed += 1;
    }
    assert_true(t.nears <= 8 * t.pieces && t.contacts <= 400 * t.pieces);
    Host_Stop(&t.host);
}

TEST(EnergyNeverRises)
{
    for (int layout = 0; layout < LAYOUTS; ++layout) {
        for (int way = 0; way < WAYS; ++way) {
            for (uint32_t seed = 0; seed < (isLoud ? 20 : 1); ++seed) {
                Run(layout, way, (isLoud ? 0 : (uint32_t)(layout + way)) + seed, 40);
            }
        }
    }
    assert_int_equal(missed, 0);
}

/* A piece rests on a floor, however small it is. */
TEST(CornersRest)
{
    for (uint32_t seed = 0; seed < 2; ++seed) {
        Touching t;
        Start(&t, CORNERS, ON_A_FLOOR, seed);
        assert_true(Host_Sleeps(&t.host, t.sheet, dt, 120) && Host_Counts(&t.host, t.sheet).pieces == 5);
        Host_Stop(&t.host);
    }
}

/* A crumb that turns once a step stops: friction sees that it turns. */
TEST(SpinsEnd)
{
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.position[2] = 0.5f * def.contactThickness;
    kiriSheet crumb = Host_AddRectangle(&host, &def, 0.004f, 0.004f, 2, 2);
    World_AddFloor(host.world);
    OK(kiriSheet_SetVelocity(host.world, crumb, noVector, (float[]){ 0.0f, 0.0f, 753.98f }));
    assert_true(Host_Sleeps(&host, crumb, dt, 120));
}

/* 256 pieces side by side, which nothing moves: they stay where they are, and nothing is looked at. */
TEST(SideBySideRests)
{
    enum { SIDE = 16 };
    Touching t;
    memset(&t, 0, sizeof(t));
    Host_Start(&t.host);
    t.host.every = 20;
    t.way = RESTING;
    World_StopGravity(t.host.world);
    kiriSheetDef def = DefaultSheet();
    def.touchesSheets = 1;
    t.sheet = Host_AddRectangle(&t.host, &def, (float)size, (float)size, 48, 48);
    for (int i = 1; i < SIDE; ++i) {
        double at = size * i / SIDE;
        CutLine(&t, at, -0.1, at, 0.4);
        CutLine(&t, -0.1, at, 0.4, at);
    }
    for (int tick = 0; tick < 20; ++tick) {
        OK(Host_Tick(&t.host, dt, 1));
        Look(&t, tick);
    }
    assert_int_equal(t.pieces, SIDE * SIDE);
    assert_true(t.fastest < 1e-9 && t.nears == 0 && t.contacts == 0);
    Host_Stop(&t.host);
}

/* Two sheets without gravity: one meets the other at 1 m/s. The second one has `width`, and is `off` aside. */
static void Meet(double off, double width, bool isUpwards)
{
    const float velocity[3] = { 0.0f, 0.0f, isUpwards ? 1.0f : -1.0f };
    kiriSheet sheets[2];
    double first = 0.0, due = 0.0;
    START_HOST(host);
    host.every = 20;
    World_StopGravity(host.world);
    for (int i = 0; i < 2; ++i) {
        kiriSheetDef def = DefaultSheet();
        kiriGetMaterial(KIRI_MATERIAL_PAPER, &def.material);
        def.material.airDamping = 0.0f;
        def.touchesSheets = 1;
        def.frameCount = 4;
        def.gridResolution = 16;
        def.contactThickness = 0.004f;
        Set3(def.position, (float)(i * off), 0.0f, 0.02f * (float)i);
        float side = i == 0 ? 0.2f : (float)width;
        sheets[i] = Host_AddRectangle(&host, &def, side, side, 16, 16);
    }
    OK(kiriSheet_SetVelocity(host.world, sheets[isUpwards ? 0 : 1], velocity, noVector));
    for (int tick = 0; tick < 60; ++tick) {
        OK(Host_Tick(&host, dt, 2));
        kiriTotals a = Host_Totals(&host, sheets[0]), b = Host_Totals(&host, sheets[1]);
        double energy = a.kineticEnergy + a.elasticEnergy + b.kineticEnergy + b.elasticEnergy;
        first = tick == 0 ? energy : first;
        due = isUpwards ? a.mass : -b.mass;
        assert_true(energy < 1.001 * first);
        assert_true(fabs(a.momentum[2] + b.momentum[2] - due) < 0.01 * fabs(due));
    }
    double slower = Host_Totals(&host, sheets[isUpwards ? 1 : 0]).momentum[2] / due;
    assert_true(slower > 0.1); /* it was pushed */
}

TEST(MomentumStays)
{
    Meet(0.0, 0.2, false);
    Meet(0.1, 0.2, false);
    Meet(0.0, 0.1, false);
    Meet(0.0, 0.2, true);
    Meet(0.05, 0.1, true);
}

/* A tick without memory for contacts between sheets moves them without these contacts, or moves nothing. A heap stays
   finite, stops nowhere, and rests when there is memory again. */
TEST(ScarceMemory)
{
    for (int every = 2; every <= 7; ++every) {
        Touching t;
        int32_t refused = 0, awake = 1;
        memset(&t, 0, sizeof(t));
        Host_Start(&t.host);
        for (int i = 0; i < 4; ++i) {
            kiriSheetDef def = DefaultSheet();
            def.touchesSheets = 1;
            def.gridResolution = 8;
            def.contactThickness = 0.004f;
            def.position[2] = 0.01f * (float)(i + 1);
            t.sheet = Host_AddRectangle(&t.host, &def, 0.2f, 0.2f, 8, 8);
        }
        World_AddFloor(t.host.world);
        for (int tick = 0; tick < 240 && awake; ++tick) {
            t.host.failEvery = tick < 40 ? every : 0;
            kiriResult result = kiriWorld_Tick(t.host.world, dt, 2);
            t.host.failEvery = 0;
            assert_true(result >= KIRI_OK || result == KIRI_ERROR_MEMORY);
            refused += result == KIRI_ERROR_MEMORY;
            OK(kiriSheet_IsAwake(t.host.world, t.sheet, &awake));
        }
        assert_true(refused > 0 && !awake);
        Host_Stop(&t.host);
    }
}
