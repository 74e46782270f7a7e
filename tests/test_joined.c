/* Pending points are one update, whatever ticks they were given before, and sheets take turns. The result equals that
   without a budget, bit for bit. */
#include "host.h"

#include "layout_hash.h"

enum { PENS = 3, SQUARES = 20, STROKE_TICKS = 24, MOST_TICKS = 20000 };

static const float dt = 1.0f / 60.0f;

static void StartStill(Host* host, const kiriBudget* budget)
{
    Host_Start(host);
    World_StopGravity(host->world);
    OK(kiriWorld_SetBudget(host->world, budget));
}

/* Adds to *commits, and says whether work waits. */
static bool TickOnce(Host* host, int32_t* commits)
{
    kiriResult result = Host_Tick(host, dt, 1);
    assert_true(result >= 0);
    *commits += World_Profile(host->world).commits;
    return result == KIRI_PENDING;
}

static void TickOn(Host* host)
{
    int32_t commits = 0;
    TickOnce(host, &commits);
}

/* Ticks until nothing waits. */
static void Settle(Host* host, int32_t* commits)
{
    for (int32_t ticks = 0; TickOnce(host, commits); ++ticks) {
        assert_in_range(ticks, 0, MOST_TICKS);
    }
}

/* ---- Random strokes ---- */

/* Draws a stroke over some ticks, lifts some ticks later, and begins the next one. It reads its own seed alone, so two
   worlds get the same calls. */
typedef struct Pen {
    kiriCut cut;
    uint32_t seed;
    float at[2], way[2], start[2];
    int32_t ticks, rests; /* that it draws, and then waits before it ends */
    bool isRound;
} Pen;

static void BeginStroke(Pen* pen, const Host* host, kiriSheet sheet)
{
    bool fromBorder = Random(&pen->seed) % 3 == 0;
    double angle = RandomBetween(&pen->seed, 0.0, 6.283);
    float speed = (float)RandomBetween(&pen->seed, 0.02, 0.15);
    for (int k = 0; k < 2; ++k) {
        pen->at[k] = (float)RandomBetween(&pen->seed, 0.05, 0.95);
        pen->way[k] = speed * (float)(k == 0 ? cos(angle) : sin(angle));
    }
    if (fromBorder) {
        pen->at[0] = -0.03f;
        pen->way[0] = speed;
    }
    memcpy(pen->start, pen->at, sizeof(pen->at));
    pen->ticks = 1 + (int32_t)(Random(&pen->seed) % 12);
    pen->rests = Random(&pen->seed) % 2 == 0 ? (int32_t)(Random(&pen->seed) % 5) : 0;
    pen->isRound = Random(&pen->seed) % 3 == 0;
    OK(kiriBeginCut(host->world, sheet, pen->at, &pen->cut));
}

static void DrawOn(Pen* pen, const Host* host)
{
    float turn = pen->isRound ? 0.8f : (float)RandomBetween(&pen->seed, -0.3, 0.3);
    float way[2] = { pen->way[0] - turn * pen->way[1], pen->way[1] + turn * pen->way[0] };
    memcpy(pen->way, way, sizeof(way));
    pen->at[0] += way[0];
    pen->at[1] += way[1];
    if (pen->isRound && pen->ticks == 1) {
        memcpy(pen->at, pen->start, sizeof(pen->at));
    }
    OK(kiriCut_Extend(host->world, pen->cut, pen->at, 1));
}

static void MovePen(Pen* pen, const Host* host, kiriSheet sheet)
{
    if (pen->cut == 0) {
        BeginStroke(pen, host, sheet);
    }
    if (pen->ticks > 0) {
        for (int32_t points = 1 + (int32_t)(Random(&pen->seed) % 2); points > 0; --points) {
            DrawOn(pen, host);
        }
        pen->ticks -= 1;
    } else if (pen->rests > 0) {
        pen->rests -= 1;
    } else {
        OK(kiriCut_End(host->world, pen->cut));
        pen->cut = 0;
    }
}

static kiriSheetDef DefOf(uint32_t run)
{
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 16;
    def.collisionPoints = run % 2 == 0 ? 20 : 0;
    def.model = run % 7 == 6 ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS;
    def.crumbArea = run % 5 == 0 ? 0.004f : 0.0f;
    def.frameCount = run % 3 == 0 ? 0 : run % 3 == 1 ? 3 : 8;
    def.frameLength = 0.25f;
    def.rigidArea = run % 3 == 1 ? 0.02f : 0.0f;
    def.maxFrames = run % 4 == 3 ? 12 : 256;
    return def;
}

typedef struct Outcome {
    uint64_t layout;
    kiriCounts counts;
    int32_t commits, frames; /* updates; frames when the sheet was made */
} Outcome;

static Outcome DrawAtRandom(uint32_t run, const kiriBudget* budget)
{
    HOST(host);
    Pen pens[PENS];
    Outcome outcome = { .commits = 0 };
    kiriSheetDef def = DefOf(run);
    StartStill(&host, budget);
    host.every = 5;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, SQUARES, SQUARES);
    outcome.frames = Host_Counts(&host, sheet).frames;
    for (uint32_t k = 0; k < PENS; ++k) {
        pens[k] = (Pen){ .cut = 0, .seed = 977u * run + 31u * k };
    }
    for (int32_t tick = 0; tick < STROKE_TICKS; ++tick) {
        for (uint32_t k = 0; k <= run % PENS; ++k) {
            MovePen(&pens[k], &host, sheet);
        }
        TickOnce(&host, &outcome.commits);
    }
    for (uint32_t k = 0; k < PENS; ++k) {
        if (pens[k].cut != 0) {
            OK(kiriCut_End(host.world, pens[k].cut));
        }
    }
    Settle(&host, &outcome.commits);
    outcome.layout = Layout_HashAll(host.world);
    outcome.counts = Host_Counts(&host, sheet);
    return outcome;
}

/* Mesh, grid, regions, frames, weights and links do not depend on the budget, though updates do. */
TEST(SameInTheEnd)
{
    static const kiriBudget none = { 0, 0, 0, 0 };
    static const kiriBudget budgets[] = { { 16, 6, 4, 0 },     { 40, 60, 20, 0 }, { 100, 400, 100, 0 },
                                          { 0, 1500, 400, 0 }, { 30, 0, 0, 0 },   { 0, 0, 50, 0 } };
    int32_t fewer = 0, added = 0, parted = 0;
    for (uint32_t run = 1; run <= RUNS(36); ++run) {
        Outcome plain = DrawAtRandom(run, &none);
        const kiriBudget* budget = &budgets[run % (sizeof(budgets) / sizeof(*budgets))];
        Outcome limited = DrawAtRandom(run, budget);
        assert_int_equal(plain.counts.triangles, limited.counts.triangles);
        assert_int_equal(plain.counts.pieces, limited.counts.pieces);
        assert_int_equal(plain.counts.frames, limited.counts.frames);
        if (plain.layout != limited.layout) {
            fail_msg("run %d: another end under a budget", (int)run);
        }
        fewer += limited.commits < plain.commits;
        added += plain.counts.frames > plain.frames + plain.counts.pieces - 1;
        parted += plain.counts.pieces > 1;
    }
    assert_true(fewer > RUNS(20) && added > RUNS(5) && parted > RUNS(10));
}

/* ---- Lips part soon ---- */

/* Returns the ticks from the last points of a blade, which crosses the sheet in `bladeTicks`, until there are two
   pieces. */
static int32_t TicksToPart(const kiriBudget* budget, int32_t squares, int32_t bladeTicks)
{
    HOST(host);
    int32_t ticks = 0;
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = squares;
    def.frameCount = def.maxFrames = 9;
    StartStill(&host, budget);
    host.every = 50;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, squares, squares);
    kiriCut cut = World_BeginCut(host.world, sheet, (const float[]){ -0.05f, 0.47f });
    for (int32_t k = 1; k <= bladeTicks; ++k) {
        float share = (float)k / (float)bladeTicks;
        OK(kiriCut_Extend(host.world, cut, (const float[]){ -0.05f + 1.1f * share, 0.47f + 0.06f * share }, 1));
        if (k == bladeTicks) {
            OK(kiriCut_End(host.world, cut));
        } else {
            TickOn(&host);
        }
    }
    while (Host_Counts(&host, sheet).pieces == 1) {
        TickOn(&host);
        assert_in_range(++ticks, 1, MOST_TICKS);
    }
    return ticks;
}

/* A slow hand does not make lips wait longer than an update that is at work when the blade leaves does. */
TEST(SlowBladePartsSoon)
{
    static const int32_t bladeTicks[] = { 4, 8, 16, 30, 60 };
    static const kiriBudget budget = { 0, 4000, 1000, 0 };
    int32_t atOnce = TicksToPart(&budget, 32, 1);
    assert_in_range(atOnce, 4, 16);
    for (size_t i = 0; i < sizeof(bladeTicks) / sizeof(*bladeTicks); ++i) {
        assert_in_range(TicksToPart(&budget, 32, bladeTicks[i]), 1, 3 * atOnce / 2);
    }
}

/* ---- Turns ---- */

static int32_t TicksToCommit(Host* host, kiriSheet sheet, kiriSheet busy, uint32_t every)
{
    int32_t ticks = 0;
    while (Host_Counts(host, sheet).pieces == 1) {
        float at = 0.1f + 0.011f * (float)(ticks % 60);
        if (every > 0 && (uint32_t)ticks % every == 0) {
            Host_Cut(host, busy, (const float[]){ at, 0.4f, at + 0.03f, 0.5f }, 2);
        }
        TickOn(host);
        assert_in_range(++ticks, 1, 3000);
    }
    return ticks;
}

static kiriSheet AddFine(Host* host, int32_t squares)
{
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = squares;
    def.frameCount = def.maxFrames = 6;
    return Host_AddRectangle(host, &def, 1.0f, 1.0f, squares, squares);
}

static int32_t TicksOfShort(const kiriBudget* budget, bool isOtherCut)
{
    HOST(host);
    StartStill(&host, budget);
    host.every = 50;
    kiriSheet large = AddFine(&host, 60), small = AddFine(&host, 12);
    if (isOtherCut) {
        Host_Cut(&host, large, (const float[]){ -0.1f, 0.31f, 1.1f, 0.67f }, 2);
        TickOn(&host);
        TickOn(&host);
    }
    Host_Cut(&host, small, (const float[]){ -0.1f, 0.41f, 1.1f, 0.47f }, 2);
    int32_t ticks = TicksToCommit(&host, small, large, 0);
    assert_true(!isOtherCut || Host_Counts(&host, large).pieces == 1); /* it takes longer */
    return ticks;
}

/* A long cut in one sheet does not hold up a short one in another. */
TEST(ShortCutGoesFirst)
{
    static const kiriBudget budget = { 0, 600, 200, 0 };
    int32_t alone = TicksOfShort(&budget, false), beside = TicksOfShort(&budget, true);
    assert_in_range(beside, alone, 2 * alone + 2);
}

/* Nor do short ones hold up a long one for ever, however many come. */
TEST(LongCutComesToItsEnd)
{
    static const kiriBudget budget = { 0, 600, 200, 0 };
    int32_t ticks[2];
    for (int k = 0; k < 2; ++k) {
        HOST(host);
        StartStill(&host, &budget);
        host.every = 50;
        kiriSheet small = AddFine(&host, 40), large = AddFine(&host, 40);
        Host_Cut(&host, large, (const float[]){ -0.1f, 0.31f, 1.1f, 0.67f }, 2);
        ticks[k] = TicksToCommit(&host, large, small, k == 0 ? 0 : 1);
    }
    assert_in_range(ticks[1], ticks[0], 2 * ticks[0] + 4);
}

/* ---- When sites are settled ---- */

/* Slits that part nothing make frames rigid; more are added when the cut ends, in whatever tick. */
TEST(FramesWhenCutEnds)
{
    static const kiriBudget budgets[] = { { 0, 0, 0, 0 }, { 30, 90, 30, 0 } };
    for (size_t k = 0; k < 2; ++k) {
        HOST(host);
        kiriSheetDef def = DefaultSheet();
        def.frameCount = 0;
        def.frameLength = 0.5f;
        StartStill(&host, &budgets[k]);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 30, 30);
        int32_t frames = Host_Counts(&host, sheet).frames, commits = 0;
        kiriCut cut = World_BeginCut(host.world, sheet, (const float[]){ 0.5f, 0.05f });
        static const float spiral[] = { 0.95f, 0.05f, 0.95f, 0.95f, 0.05f, 0.95f, 0.05f, 0.25f, 0.75f, 0.25f,
                                        0.75f, 0.75f, 0.25f, 0.75f, 0.25f, 0.45f, 0.55f, 0.45f, 0.55f, 0.55f };
        for (size_t i = 0; i < sizeof(spiral) / sizeof(*spiral); i += 2) {
            OK(kiriCut_Extend(host.world, cut, spiral + i, 1));
            Settle(&host, &commits);
        }
        assert_true(commits > 5);
        assert_int_equal(Host_Counts(&host, sheet).frames, frames);
        Settle(&host, &commits);
        OK(kiriCut_End(host.world, cut));
        Settle(&host, &commits);
        assert_true(Host_Counts(&host, sheet).frames > frames + 3);
        assert_true(kiriCut_End(host.world, cut) == KIRI_ERROR_ID);
    }
}

/* kiriCut_End queues a point where the cut has none in this tick. A refused allocation fails the call, which may be made
   again. */
TEST(EndIsRefused)
{
    int32_t refused = 0;
    for (int32_t points = 1; points < 40; ++points) {
        HOST(host);
        kiriEvent event;
        static const kiriBudget budget = { 16, 10, 10, 0 };
        StartStill(&host, &budget);
        kiriSheet sheet = AddFine(&host, 8);
        kiriCut cut = World_BeginCut(host.world, sheet, (const float[]){ 0.2f, 0.5f });
        for (int32_t k = 1; k < points; ++k) {
            OK(kiriCut_Extend(host.world, cut, (const float[]){ 0.2f + 0.01f * (float)k, 0.5f }, 1));
        }
        TickOn(&host);
        host.failAt = host.calls;
        kiriResult result = kiriCut_End(host.world, cut);
        host.failAt = -1;
        if (result != KIRI_OK) {
            assert_int_equal(result, KIRI_ERROR_MEMORY);
            OK(kiriCut_End(host.world, cut));
            refused += 1;
        }
        int32_t finished = 0;
        for (int32_t tick = 0; tick < 2000 && finished == 0; ++tick) {
            TickOn(&host);
            finished = Host_Events(&host, KIRI_EVENT_CUT_FINISHED, &event);
        }
        assert_int_equal(finished, 1);
    }
    assert_true(refused > 0);
}
