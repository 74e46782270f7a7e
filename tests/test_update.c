/* A cut costs what it touches, and no tick costs more than its budget; both without changing what comes of it. */
#include "host.h"

#include "layout_hash.h"

#include <stdio.h>

static uint64_t Layout(const Host* host, int32_t index)
{
    return Layout_Hash(host->world, Host_SheetAt(host, index));
}

/* ---- Blades that wander at random ---- */

typedef struct Wanderer {
    float at[2], heading[2];
    int32_t left;    /* points until it ends */
    kiriCut cuts[2]; /* in each of two worlds */
} Wanderer;

static void Turn(Wanderer* w, uint32_t* seed)
{
    w->heading[0] = (float)RandomBetween(seed, -1.0, 1.0);
    w->heading[1] = (float)RandomBetween(seed, -1.0, 1.0);
}

static void Enter(Wanderer* w, uint32_t* seed)
{
    w->at[0] = (float)RandomBetween(seed, -0.1, 1.1);
    w->at[1] = (float)RandomBetween(seed, -0.1, 1.1);
    w->left = 5 + (int32_t)(Random(seed) % 25);
    Turn(w, seed);
}

/* Mostly straight on, at times around a bend so tight that it comes back on its own way. */
static void Step(Wanderer* w, float length, uint32_t* seed)
{
    float turn = (float)RandomBetween(seed, -0.6, 0.9);
    float u = w->heading[0], v = w->heading[1], size = sqrtf(u * u + v * v) + 1e-3f;
    w->heading[0] = (u - turn * v) / size;
    w->heading[1] = (v + turn * u) / size;
    w->at[0] += length * w->heading[0];
    w->at[1] += length * w->heading[1];
    w->left -= 1;
}

static void Advance(Host hosts[2], kiriSheet sheets[2], Wanderer* w, float length, uint32_t* seed)
{
    bool isNew = w->left == 0;
    if (isNew) {
        Enter(w, seed);
    } else {
        Step(w, length, seed);
    }
    for (int k = 0; k < 2; ++k) {
        if (isNew) {
            OK(kiriBeginCut(hosts[k].world, sheets[k], w->at, &w->cuts[k]));
        } else {
            OK(kiriCut_Extend(hosts[k].world, w->cuts[k], w->at, 1));
        }
        if (w->left == 0) {
            OK(kiriCut_End(hosts[k].world, w->cuts[k]));
        }
    }
}

/* ---- Incremental equals from scratch ---- */

typedef struct Case {
    int32_t mesh, grid, frames, model, planar;
    float step;
    int32_t ticks;
} Case;

static kiriSheetDef DefOf(const Case* c)
{
    kiriSheetDef def = SheetOf(c->grid, c->frames);
    def.frameLength = 0.3f;
    def.maxFrames = c->frames + 12;
    def.collisionPoints = 40;
    def.model = c->model;
    def.planar = c->planar;
    def.iterations = 1;
    def.material.airDamping = 2.0f;
    return def;
}

static void Compare(const Host hosts[2], int32_t number, int32_t tick)
{
    uint64_t a = Layout(&hosts[0], 0), b = Layout(&hosts[1], 0);
    if (a != b) {
        fail_msg("case %d, tick %d: what a cut left differs from what is made from scratch", number, tick);
    }
    if (Host_Hash(&hosts[0]) != Host_Hash(&hosts[1])) {
        fail_msg("case %d, tick %d: the motion differs", number, tick);
    }
}

/* An edge is clamped; of two lines through the sheet one is hinged, one clamped. */
static void HoldLines(Host* host, kiriSheet sheet)
{
    static const float edge[4] = { 0.0f, 0.0f, 0.0f, 1.0f }, through[4] = { 0.3f, 0.93f, 0.97f, 0.52f };
    static const float across[4] = { 0.23f, 0.1f, 0.81f, 0.24f };
    kiriPin pin = World_Clamp(host->world, sheet, edge, edge + 2);
    OK(kiriSheet_HingeLine(host->world, sheet, through, through + 2, &pin));
    OK(kiriSheet_ClampLine(host->world, sheet, across, across + 2, &pin));
}

static void WanderBothWays(const Case* c, int32_t number, uint32_t seed)
{
    HOST_PAIR(hosts);
    kiriSheet sheets[2];
    Wanderer wanderers[3];
    memset(wanderers, 0, sizeof(wanderers));
    for (int k = 0; k < 2; ++k) {
        kiriSheetDef def = DefOf(c);
        def.paper.fromScratch = k;
        Host_Start(&hosts[k]);
        hosts[k].every = 4; /* to save time, as in all of this file */
        sheets[k] = Host_AddRectangle(&hosts[k], &def, 1.0f, 1.0f, c->mesh, c->mesh);
    }
    int32_t blades = 1 + (int32_t)(Random(&seed) % 3);
    for (int k = 0; k < 2 && number % 2 == 1; ++k) {
        HoldLines(&hosts[k], sheets[k]);
    }
    for (int32_t tick = 0; tick < c->ticks; ++tick) {
        for (int32_t i = 0; i < blades; ++i) {
            Advance(hosts, sheets, &wanderers[i], c->step, &seed);
        }
        for (int k = 0; k < 2; ++k) {
            OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
        }
        Compare(hosts, number, tick);
    }
}

TEST(IncrementalEqualsFromScratch)
{
    for (int32_t number = 0; number < RUNS(80); ++number) {
        uint32_t seed = 1000u + (uint32_t)number;
        Case c;
        c.mesh = 4 + (int32_t)(Random(&seed) % 16);
        c.grid = 6 + (int32_t)(Random(&seed) % 24);
        c.frames = number % 6 == 5 ? 0 : 1 + (int32_t)(Random(&seed) % 8); /* 0: as many as it takes */
        c.model = number % 10 == 8 ? KIRI_MODEL_AFFINE : number % 10 == 9 ? KIRI_MODEL_POINTS : KIRI_MODEL_LINKS;
        c.planar = number % 7 == 3;
        c.step = (float)RandomBetween(&seed, 0.01, 0.12);
        c.ticks = 40;
        WanderBothWays(&c, number, seed);
    }
}

/* An outline passes the corners of squares at some steps of the lattice. A blade splits it at a point that is rounded to
   the lattice. Then squares that the sheet only just entered have no cell any more. */
TEST(OutlineLeavesSquares)
{
    int32_t gone = 0;
    for (uint32_t number = 0; number < 12; ++number) {
        static const int32_t indices[3] = { 0, 1, 2 };
        const float rest[6] = { 0.0f, (float)(2 + 2 * (number % 3)) / 536870912.0f, 1.0f, 0.0f, 1.0f, 1.0f };
        uint32_t seed = 31u + number;
        HOST_PAIR(hosts);
        kiriSheet sheets[2];
        for (int k = 0; k < 2; ++k) {
            kiriSheetDef def = Host_SmallDef();
            def.restPositions = rest;
            def.indices = indices;
            def.vertexCount = 3;
            def.triangleCount = 1;
            def.gridResolution = 16 + 4 * (int32_t)number;
            def.framePoints = NULL;
            def.paper.fromScratch = k;
            Host_Start(&hosts[k]);
            OK(kiriCreateSheet(hosts[k].world, &def, &sheets[k]));
        }
        for (int32_t tick = 0; tick < 12; ++tick) {
            float u = (float)RandomBetween(&seed, 0.1, 0.9), line[4] = { u - 0.01f, u + 0.01f, u + 0.03f, u - 0.02f };
            int32_t cells = Host_Counts(&hosts[0], sheets[0]).cells;
            for (int k = 0; k < 2; ++k) {
                Host_Cut(&hosts[k], sheets[k], line, 2);
                OK(Host_Tick(&hosts[k], 1.0f / 60.0f, 1));
            }
            cells -= Host_Counts(&hosts[0], sheets[0]).cells;
            gone += cells > 0 ? cells : 0;
            Compare(hosts, (int32_t)number, tick);
        }
    }
    assert_true(gone > 50);
}

/* ---- Budgets ---- */

static const kiriBudget tight = { .triangles = 20, .cells = 60, .samples = 15, .iterations = 0 };

static double ShareOf(int32_t items, int32_t limit)
{
    return limit > 0 ? (double)items / limit : 0.0;
}

/* Work on cuts shares a tick. */
static void CheckBudget(const Host* host, const kiriBudget* budget)
{
    kiriProfile profile = World_Profile(host->world);
    assert_true(budget->triangles == 0 || profile.trianglesSplit <= budget->triangles);
    assert_true(budget->cells == 0 || profile.cellsSettled <= budget->cells);
    assert_true(budget->samples == 0 || profile.samplesRefreshed <= budget->samples);
    assert_true(budget->iterations == 0 || profile.solverIterations <= budget->iterations);
    double share = ShareOf(profile.trianglesSplit, budget->triangles) + ShareOf(profile.cellsSettled, budget->cells) +
                   ShareOf(profile.samplesRefreshed, budget->samples);
    assert_true(share <= 1.0 + 1e-9);
}

/* Ticks until nothing waits; returns how many ticks it took. */
static int32_t Settle(Host* host, const kiriBudget* budget)
{
    for (int32_t ticks = 1; ticks < 100000; ++ticks) {
        kiriResult result = Host_Tick(host, 1.0f / 60.0f, 1);
        CheckBudget(host, budget);
        int32_t deferred = Host_Events(host, KIRI_EVENT_DEFERRED, NULL);
        if (result == KIRI_OK) {
            assert_int_equal(deferred, 0);
            return ticks;
        }
        assert_int_equal(result, KIRI_PENDING);
        assert_true(deferred > 0);
    }
    fail_msg("the work never ends");
    return 0;
}

static void StartPair(Host hosts[2], const kiriBudget* budget)
{
    for (int k = 0; k < 2; ++k) {
        Host_Start(&hosts[k]);
        hosts[k].every = 8;
        World_StopGravity(hosts[k].world);
    }
    OK(kiriWorld_SetBudget(hosts[1].world, budget));
}

static void CompareLayouts(const Host hosts[2])
{
    for (int32_t i = 0; i < Host_SheetCount(&hosts[0]); ++i) {
        assert_true(Layout(&hosts[0], i) == Layout(&hosts[1], i));
    }
}

/* Points on a circle that closes: a piece comes off. */
static void Circle(float* points, int32_t count, float u, float v, float radius)
{
    for (int32_t i = 0; i < count; ++i) {
        double t = 2.0 * 3.14159265358979 * i / (count - 1);
        points[2 * i] = u + radius * (float)cos(t);
        points[2 * i + 1] = v + radius * (float)sin(t);
    }
    points[2 * count - 2] = points[0];
    points[2 * count - 1] = points[1];
}

static void GiveSpiral(Host* host, kiriSheet sheet, int32_t index)
{
    enum { COUNT = 2000 };
    static float points[2 * COUNT];
    for (int32_t i = 0; i < COUNT; ++i) {
        double t = 6.0 * 3.14159265358979 * i / (COUNT - 1), r = 0.1 + 0.35 * i / (COUNT - 1);
        points[2 * i] = (float)(0.5 + r * cos(t) + 0.01 * sin(9.0 * t));
        points[2 * i + 1] = (float)(0.5 + r * sin(t));
    }
    Host_Cut(host, sheet, points, COUNT);
}

static void GiveSlash(Host* host, kiriSheet sheet, int32_t index)
{
    Host_Cut(host, sheet, (float[]){ -0.1f, 0.31f, 1.1f, 0.63f }, 2);
}

enum { DICE_LINES = 6 };

static void GiveDice(Host* host, kiriSheet sheet, int32_t index)
{
    for (int i = 0; i < 2 * DICE_LINES; ++i) {
        float at = ((float)(i / 2) + 0.613f) / DICE_LINES;
        float line[4] = { i % 2 ? at : -0.1f, i % 2 ? -0.1f : at, i % 2 ? at : 1.1f, i % 2 ? 1.1f : at };
        Host_Cut(host, sheet, line, 2);
    }
}

static void GiveCircle(Host* host, kiriSheet sheet, int32_t index)
{
    enum { COUNT = 40 };
    float points[2 * COUNT];
    Circle(points, COUNT, 0.5f, 0.45f, 0.2f + 0.004f * (float)index);
    Host_Cut(host, sheet, points, COUNT);
}

/* Any work ends, as without a budget: a long cut; squares that take many ticks each, and squares that are many more than
   a tick takes; many pieces at once; many sheets. */
TEST(AnyBudgetEqualsNone)
{
    static const struct {
        void (*give)(Host* host, kiriSheet sheet, int32_t index);
        int32_t sheets, mesh, grid, frames, points, pieces, leastTicks, every;
    } rows[] = {
        { GiveSpiral, 1, 16, 24, 4, 6, 0, 100, 8 },
        { GiveSlash, 1, 40, 2, 2, 6, 2, 20, 100 },
        { GiveSlash, 1, 4, 60, 2, 6, 2, 20, 100 },
        { GiveDice, 1, 12, 20, 4, 40, (DICE_LINES + 1) * (DICE_LINES + 1), 100, 8 },
        { GiveCircle, 50, 8, 8, 4, 6, 2, 50, 150 },
    };
    for (size_t r = 0; r < sizeof(rows) / sizeof(rows[0]); ++r) {
        HOST_PAIR(hosts);
        int32_t ticks[2];
        StartPair(hosts, &tight);
        hosts[1].every = rows[r].every;
        for (int k = 0; k < 2; ++k) {
            for (int32_t i = 0; i < rows[r].sheets; ++i) {
                kiriSheetDef def = Host_SmallDef();
                def.gridResolution = rows[r].grid;
                def.frameCount = rows[r].frames;
                def.maxFrames = rows[r].frames == 2 ? 2 : def.maxFrames;
                def.collisionPoints = rows[r].points;
                def.position[0] = 2.0f * (float)i;
                kiriSheet sheet = Host_AddRectangle(&hosts[k], &def, 1.0f, 1.0f, rows[r].mesh, rows[r].mesh);
                rows[r].give(&hosts[k], sheet, i);
            }
            ticks[k] = Settle(&hosts[k], k == 0 ? &(kiriBudget){ 0, 0, 0, 0 } : &tight);
            for (int32_t i = 0; i < rows[r].sheets && rows[r].pieces > 0; ++i) {
                assert_int_equal(Host_Counts(&hosts[k], Host_SheetAt(&hosts[k], i)).pieces, rows[r].pieces);
            }
        }
        assert_int_equal(ticks[0], 1);
        assert_true(ticks[1] > rows[r].leastTicks);
        CompareLayouts(hosts);
    }
}

/* Points come every tick, faster than the budget takes them; what is given before one tick still takes effect
   together. */
TEST(BladeFasterThanItsBudget)
{
    for (uint32_t number = 0; number < RUNS(12); ++number) {
        HOST_PAIR(hosts);
        kiriSheet sheets[2];
        Wanderer wanderers[2];
        uint32_t seed = 77u + number;
        memset(wanderers, 0, sizeof(wanderers));
        StartPair(hosts, &tight);
        for (int k = 0; k < 2; ++k) {
            kiriSheetDef def = Host_SmallDef();
            def.gridResolution = 16;
            def.collisionPoints = 30;
            sheets[k] = Host_AddRectangle(&hosts[k], &def, 1.0f, 1.0f, 12, 12);
        }
        for (int32_t tick = 0; tick < 30; ++tick) {
            for (int32_t i = 0; i < 8; ++i) {
                Advance(hosts, sheets, &wanderers[i % 2], 0.07f, &seed);
            }
            OK(Host_Tick(&hosts[0], 1.0f / 60.0f, 1));
            kiriResult result = Host_Tick(&hosts[1], 1.0f / 60.0f, 1);
            assert_true(result == KIRI_OK || result == KIRI_PENDING);
            CheckBudget(&hosts[1], &tight);
            assert_true(AllFinite(Host_Mesh(&hosts[1], sheets[1]).positions, 3));
        }
        assert_true(Settle(&hosts[1], &tight) > 10);
        CompareLayouts(hosts);
    }
}

TEST(BudgetsThatAreNone)
{
    START_HOST(host);
    kiriBudget few = { .triangles = KIRI_LEAST_TRIANGLES - 1, .cells = 0, .samples = 0, .iterations = 0 };
    kiriBudget below = { .triangles = 0, .cells = -1, .samples = 0, .iterations = 0 };
    assert_int_equal(kiriWorld_SetBudget(host.world, &few), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_SetBudget(host.world, &below), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_SetBudget(host.world, NULL), KIRI_ERROR_ARGUMENT);
    few.triangles = KIRI_LEAST_TRIANGLES;
    OK(kiriWorld_SetBudget(host.world, &few));
}

TEST(BudgetFromTime)
{
    kiriProfile profile;
    memset(&profile, 0, sizeof(profile));
    kiriBudget budget = { 100, 200, 300, 400 };
    OK(kiriFitBudget(&profile, 500.0f, &budget));
    assert_int_equal(budget.cells, 200); /* nothing is known */
    profile.seconds[KIRI_STAGE_GRID] = 1e-3;
    profile.seconds[KIRI_STAGE_SOLVE] = 1e-3;
    profile.cellsSettled = 5000;
    profile.solverIterations = 8;
    OK(kiriFitBudget(&profile, 500.0f, &budget));
    assert_int_equal(budget.triangles, 100);
    assert_int_equal(budget.cells, 1250);
    assert_int_equal(budget.samples, 300);
    assert_int_equal(budget.iterations, 2);
    profile.seconds[KIRI_STAGE_CUT] = 2e-3;
    profile.trianglesSplit = 1000;
    OK(kiriFitBudget(&profile, 4000.0f, &budget));
    assert_true(budget.triangles == 1000 && budget.cells == 10000 && budget.iterations == 16);
    profile.seconds[KIRI_STAGE_SOLVE] = 0.1; /* of a hundred ticks: no less is left for cuts */
    profile.solverIterations = 800;
    OK(kiriFitBudget(&profile, 4000.0f, &budget));
    assert_true(budget.triangles == 1000 && budget.cells == 10000 && budget.iterations == 16);
    assert_int_equal(kiriFitBudget(&profile, -1.0f, &budget), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriFitBudget(NULL, 1.0f, &budget), KIRI_ERROR_ARGUMENT);
}

/* ---- Calls amid the work ---- */

/* One cut, with so little budget that shape functions and links take many ticks. The material becomes another before one of these; *ticks
   is how many there are. */
static uint64_t LayoutAfterCut(uint32_t seed, int32_t changeAt, int32_t* ticks)
{
    START_HOST(host);
    kiriSheetDef def = Host_SmallDef();
    def.framePoints = NULL;
    def.frameCount = 20;
    def.gridResolution = 16;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 8, 8);
    const kiriBudget some = { .cells = 200 }, few = { .cells = 12 };
    OK(kiriWorld_SetBudget(host.world, &some));
    float u = (float)RandomBetween(&seed, 0.1, 0.8), v = (float)RandomBetween(&seed, 0.1, 0.8);
    Host_Cut(&host, sheet, (const float[]){ u, v, u + 0.13f, v + 0.07f }, 2);
    host.every = INT32_MAX;
    *ticks = 0;
    while (Host_Tick(&host, 1.0f / 60.0f, 1) == KIRI_PENDING) {
        bool isShape = Layout_Stage(host.world, sheet) == KIRI_STAGE_SHAPE;
        OK(kiriWorld_SetBudget(host.world, isShape ? &few : &some));
        *ticks += isShape;
        if (*ticks == changeAt) {
            kiriSheetSettings settings = World_Settings(host.world, sheet);
            settings.material.density *= 2.0f;
            OK(kiriSheet_SetSettings(host.world, sheet, &settings));
            changeAt = 0;
        }
    }
    Host_Validate(&host);
    uint64_t layout = Layout(&host, 0);
    Host_Destroy(&host);
    return layout;
}

/* What comes of a cut does not depend on it: links that are being made look at all regions that have become dirty. */
TEST(MaterialChangesAmidWork)
{
    for (uint32_t seed = 1; seed <= RUNS(2); ++seed) {
        int32_t count, ticks;
        uint64_t layout = LayoutAfterCut(seed, 0, &count);
        assert_true(count > 30);
        for (int32_t at = 1; at < count; at += 1 + count / 12) {
            assert_true(LayoutAfterCut(seed, at, &ticks) == layout);
        }
    }
}
