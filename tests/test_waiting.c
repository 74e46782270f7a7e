/* Worlds in which cuts and pieces wait for their budget: a world that is saved and loaded in any tick goes on as its
   twin, and a tick that is refused memory says so and loses nothing. */
#include "host.h"

#include "storm.h"

enum { LAST_ACT = 70, MOST_TICKS = 2000 };

/* ---- Play ---- */

static kiriSheet AnySheet(const Host* host, uint32_t* seed)
{
    return Host_SheetAt(host, (int32_t)(Random(seed) % (uint32_t)Host_SheetCount(host)));
}

/* Takes a piece out of a sheet that has more than one. */
static void TakePiece(Host* host, uint32_t* seed)
{
    kiriSheet sheet = AnySheet(host, seed), made;
    uint32_t piece = Random(seed), draw = Random(seed);
    int32_t pieces = Host_Counts(host, sheet).pieces;
    kiriPieceState state = World_PieceState(host->world, sheet, (int32_t)(piece % (uint32_t)pieces));
    if (pieces == 1 || state.frames == 0) {
        return;
    }
    kiriFrame frame = Host_FrameOf(host, sheet, (int32_t)(piece % (uint32_t)pieces));
    kiriResult result =
        draw % 4 == 0 ? kiriFrame_DestroyPiece(host->world, frame) : kiriFrame_DetachPiece(host->world, frame, &made);
    assert_true(result == KIRI_OK || result == KIRI_PENDING || result == KIRI_ERROR_STATE);
}

static void SetBudget(Host* host, uint32_t* seed)
{
    kiriBudget budget = { 0, 0, 10 + (int32_t)(Random(seed) % 300), 0 };
    budget.triangles = Random(seed) % 2 ? 16 + (int32_t)(Random(seed) % 200) : 0;
    budget.cells = Random(seed) % 2 ? 50 + (int32_t)(Random(seed) % 2000) : 0;
    budget.iterations = Random(seed) % 3 == 0 ? 2 + (int32_t)(Random(seed) % 30) : 0;
    OK(kiriWorld_SetBudget(host->world, &budget));
}

static void Start(Host* host, uint32_t run)
{
    uint32_t seed = 77u * run + 5u;
    Host_Start(host);
    host->every = 16;
    for (int32_t sheets = 1 + (int32_t)(run % 2); sheets > 0; --sheets) {
        int32_t squares = run % 8 == 7 ? 72 : 6 + (int32_t)(Random(&seed) % 14);
        kiriSheetDef def = SheetOf(8 + (int32_t)(Random(&seed) % 16), 3 + (int32_t)(Random(&seed) % 5));
        def.maxFrames = 64;
        def.collisionPoints = run % 3 == 0 ? 20 : 0;
        def.sleepSpeed = run % 4 == 0 ? def.sleepSpeed : 0.0f;
        def.skinning = run % 5 == 1 ? KIRI_SKINNING_SMOOTH : KIRI_SKINNING_LINEAR;
        def.model = run % 7 == 6 ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS;
        def.position[2] = (float)sheets;
        kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, squares, squares);
        World_Clamp(host->world, sheet, (float[]){ 0.0f, 1.0f }, (float[]){ 1.0f, 1.0f });
        Host_Cut(host, sheet, (float[]){ -0.1f, 0.431f, 1.1f, 0.522f }, 2);
        Host_Cut(host, sheet, (float[]){ 0.47f, -0.1f, 0.52f, 0.6f }, 2);
    }
    OK(kiriWorld_Tick(host->world, 1.0f / 60.0f, 1));
    SetBudget(host, &seed);
}

/* Acts of the host before a tick, until LAST_ACT. Then systems have no limit, so all work ends. */
static void Act(Host* host, uint32_t* seed, int32_t tick)
{
    uint32_t draw = Random(seed) % 24;
    if (tick == LAST_ACT) {
        OK(kiriWorld_SetBudget(host->world, &(kiriBudget){ 100, 1000, 100, 0 }));
    }
    if (tick >= LAST_ACT || Host_SheetCount(host) > 12) {
        return;
    }
    if (draw < 3) {
        Host_CutSomewhere(host, AnySheet(host, seed), seed);
    } else if (draw < 8) {
        TakePiece(host, seed);
    } else if (draw == 8) {
        SetBudget(host, seed);
    }
}

/* ---- Saves ---- */

/* One world goes on, the other one is loaded before each tick, or before some. */
static void RunTwins(uint32_t run, uint32_t often, int32_t* waited)
{
    HOST_PAIR(hosts);
    uint32_t seeds[2] = { 901u * run, 901u * run }, times = 31u * run;
    kiriResult results[2] = { KIRI_PENDING, KIRI_PENDING };
    Start(&hosts[0], run);
    Start(&hosts[1], run);
    for (int32_t tick = 0; tick <= LAST_ACT || results[0] == KIRI_PENDING; ++tick) {
        assert_in_range(tick, 0, MOST_TICKS);
        if (Random(&times) % often == 0) {
            World_Copy(hosts[1].world, hosts[1].world, kiriWorld_Snapshot); /* drops all caches */
        }
        for (int k = 0; k < 2; ++k) {
            Act(&hosts[k], &seeds[k], tick);
            results[k] = Host_Tick(&hosts[k], 1.0f / 60.0f, 1);
            assert_true(results[k] >= 0);
        }
        *waited += results[0] == KIRI_PENDING;
        if (results[0] != results[1] || Host_SheetCount(&hosts[0]) != Host_SheetCount(&hosts[1]) ||
            Host_Hash(&hosts[0]) != Host_Hash(&hosts[1])) {
            fail_msg("run %u, tick %d: %s and %s, %d and %d sheets", run, (int)tick, kiriGetResultName(results[0]),
                     kiriGetResultName(results[1]), (int)Host_SheetCount(&hosts[0]),
                     (int)Host_SheetCount(&hosts[1]));
        }
    }
}

TEST(LoadedTwins)
{
    int32_t waited = 0;
    for (uint32_t run = 1; run <= 5; ++run) {
        RunTwins(run, 1, &waited);
        RunTwins(run, 7, &waited);
    }
    assert_true(waited > 100);
}

/* ---- Memory ---- */

/* A tick whose requests for memory are refused from one on, or that one alone. A spare block may take its place. */
static kiriResult TickRefused(Host* host, int64_t from, bool once)
{
    int64_t before = host->refused;
    int32_t lines = host->lines;
    host->failAt = host->calls + from;
    host->failOnce = once;
    kiriResult result = Host_Tick(host, 1.0f / 60.0f, 1);
    host->failAt = -1;
    if (result == KIRI_ERROR_MEMORY) {
        assert_true(host->refused > before);
        assert_int_equal(host->lines, lines + 1);
        assert_true(strlen(kiriWorld_GetLastError(host->world)) > 0);
    } else {
        assert_true(result >= 0 || result == KIRI_DIVERGED);
    }
    return result;
}

/* One piece waits, and from some tick on nothing is given, for 60 ticks: each that asked in vain says so. Then it
   leaves, and the host hears of it once. */
static void RunStarved(int32_t squares, int32_t from, int64_t request)
{
    kiriSheet sheet, part;
    int32_t detached = 0;
    kiriBudget budget = { 0, 0, 60, 0 };
    START_HOST(host);
    host.every = 16;
    kiriSheetDef def = SheetOf(24, 3);
    def.maxFrames = 8;
    sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, squares, squares);
    Host_Cut(&host, sheet, (float[]){ -0.1f, 0.45f, 1.1f, 0.55f }, 2);
    OK(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1));
    OK(kiriWorld_SetBudget(host.world, &budget));
    assert_int_equal(kiriFrame_DetachPiece(host.world, Host_FrameOf(&host, sheet, 1), &part), KIRI_PENDING);
    for (int32_t tick = 0; tick < from; ++tick) {
        assert_true(Host_Tick(&host, 1.0f / 60.0f, 1) >= 0);
        detached += Host_Events(&host, KIRI_EVENT_PIECE_DETACHED, NULL);
    }
    kiriResult result = KIRI_PENDING;
    for (int32_t tick = 0; tick < 60; ++tick) {
        int32_t sheets = Host_SheetCount(&host);
        result = TickRefused(&host, tick == 0 ? request : 0, false);
        if (Host_SheetCount(&host) > sheets) { /* a tick that did nothing shows the events of the last one */
            detached += Host_Events(&host, KIRI_EVENT_PIECE_DETACHED, NULL);
        }
    }
    assert_true(result == KIRI_OK || result == KIRI_ERROR_MEMORY); /* it does not wait for ever */
    for (int32_t tick = 0; tick < 400 && result != KIRI_OK; ++tick) {
        result = Host_Tick(&host, 1.0f / 60.0f, 1);
        detached += Host_Events(&host, KIRI_EVENT_PIECE_DETACHED, NULL);
    }
    assert_int_equal(result, KIRI_OK);
    assert_int_equal(detached, 1);
    assert_int_equal(Host_SheetCount(&host), 2);
}

TEST(Starved)
{
    for (int32_t from = 0; from < 40; from += IS_SANITIZED ? 7 : 3) {
        for (int64_t request = 0; request < 120; request += request < 8 ? 1 : 13) {
            RunStarved(6 + from % 5, from, request);
        }
    }
}

/* Storms, in which each tick is tried without memory first. Blades that follow sheets, contacts, tasks: all kinds. */
TEST(Storms)
{
    int32_t refused = 0;
    for (int32_t kind = 0; kind < STORM_TYPES; ++kind) {
        Host host = { .failAt = -1, .every = 8 };
        Storm storm;
        uint32_t draws = 5u + (uint32_t)kind;
        kiriWorldDef def = Host_Def(&host);
        OK(Storm_Start(&storm, kind, &def));
        host.world = storm.world;
        for (int32_t tick = 0; tick < 16; ++tick) {
            Storm_Act(&storm);
            Storm_MoveBlade(&storm);
            for (int32_t again = 0; again < 4; ++again) {
                int64_t from = (int64_t)(Random(&draws) % (again < 2 ? 8 : 80));
                refused += TickRefused(&host, from, again % 2) == KIRI_ERROR_MEMORY;
            }
            Storm_Tick(&storm);
        }
        Host_Stop(&host);
    }
    assert_true(refused > 200);
}
