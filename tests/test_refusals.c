/* What a refused allocation leaves behind: for each call that changes a world, with work on a cut waiting at each
   stage, each seventh allocation is refused once, and all from there on; with the word "all" each one of each call. */
#include "every_call.h"
#include "look.h"

#include "layout_hash.h"

/* Each step-th allocation is refused of each stride-th call, others in each state of the work. */
static int32_t step = IS_SANITIZED ? 13 : 7, stride = IS_SANITIZED ? 6 : 3;

SETUP
{
    if (count > 1 && strcmp(words[1], "all") == 0) {
        step = stride = 1;
    }
}

/* Where the work on a cut waits. */
enum { NO_WORK = KIRI_STAGE_CONSTANTS /* and no limit */, NOT_BEGUN /* with a limit */, STATES };

static int32_t WaitingStage(const Host* host)
{
    kiriEvent event = { .stage = -1 };
    Host_Events(host, KIRI_EVENT_DEFERRED, &event);
    return event.stage;
}

/* Gives a way in and out, a loop whose piece needs frames and collision points, and cuts that fill their array: another
   cut allocates. */
static void GiveCuts(Stand* s)
{
    static const float line[10] = { -0.1f, 0.55f, 0.3f, 0.62f, 0.42f, 0.41f, 0.7f, 0.58f, 1.1f, 0.52f };
    static const float loop[10] = { 0.62f, 0.72f, 0.85f, 0.7f, 0.81f, 0.88f, 0.6f, 0.9f, 0.62f, 0.72f };
    Host* host = &s->tape.host;
    Host_Cut(host, s->given.sheet, line, 5);
    Host_Cut(host, s->given.sheet, loop, 5);
    OK(kiriCut_Extend(host->world, s->given.cut, line + 4, 2));
    for (int i = 3; i < 8; ++i) {
        World_BeginCut(host->world, s->given.sheet, line);
    }
}

static void Start(Stand* s, int32_t work)
{
    static const kiriBudget budget = { KIRI_LEAST_TRIANGLES, 25, 5, 0 };
    Stand_Start(s, NULL);
    Host* host = &s->tape.host;
    GiveCuts(s);
    if (work != NO_WORK) {
        OK(kiriWorld_SetBudget(host->world, &budget));
    }
    for (int tick = 0; work < NO_WORK && WaitingStage(host) != work; ++tick) {
        assert_true(tick < 2000);
        assert_int_equal(kiriWorld_Tick(host->world, 0.01f, 1), KIRI_PENDING);
    }
}

static kiriResult Make(Stand* s, const char* function)
{
    return Stand_Make(s, EveryCall_Find(function));
}

/* The first rows of the table: kiriWorld_Tick and kiriWorld_FinishCuts keep the work on cuts that is done. */
enum { TICK, FINISH, OTHERS };

/* The call with its n-th allocation refused, or all from there on. Its line names it. */
static kiriResult CallPoorly(Stand* s, const EveryCall* call, int64_t n, bool once)
{
    int32_t lines = s->tape.host.lines;
    s->tape.host.failAt = s->tape.host.calls + n;
    s->tape.host.failOnce = once;
    kiriResult result = Stand_Make(s, call);
    s->tape.host.failAt = -1;
    const char* line = kiriWorld_GetLastError(s->tape.host.world);
    if (result < 0) {
        assert_int_equal(s->tape.host.lines, lines + 1);
        assert_true(!call->changes || strcmp(line, s->tape.host.line) == 0);
        line = s->tape.host.line;
        if (strncmp(line, call->name, strlen(call->name)) != 0 || line[strlen(call->name)] != ':') {
            fail_msg("%s says \"%s\"", call->name, line);
        }
    } else if (call->changes) {
        assert_string_equal(line, "");
    }
    return result;
}

/* ---- What comes of it ---- */

static void LiftLimits(Stand* s)
{
    static const kiriBudget none = { 0, 0, 0, 0 };
    OK(kiriWorld_SetBudget(s->tape.host.world, &none));
}

/* Does all work that waits: in each tick what was given before the same one. */
static void Finish(Stand* s)
{
    LiftLimits(s);
    for (int tick = 0; tick < 4; ++tick) {
        kiriResult result = kiriWorld_Tick(s->tape.host.world, 0.01f, 1);
        assert_true(result == KIRI_OK || (result == KIRI_PENDING && tick < 2));
    }
}

typedef struct Outcome {
    kiriResult result;
    uint64_t hash, look, end, layout;
    int64_t live, liveAtEnd;
} Outcome;

static void After(Stand* s, Outcome* outcome)
{
    outcome->hash = Host_Hash(&s->tape.host);
    outcome->look = Look_World(s->tape.host.world);
    outcome->live = s->tape.host.live;
    Finish(s);
    outcome->end = Host_Hash(&s->tape.host);
    outcome->layout = Layout_HashAll(s->tape.host.world);
    outcome->liveAtEnd = s->tape.host.live;
}

static uint64_t LookWithProfile(const Stand* s)
{
    return Look_Profile(Look_World(s->tape.host.world), s->tape.host.world);
}

static Outcome OutcomeOf(const EveryCall* call, int32_t work)
{
    SCOPED(Stand, s, Stand_Stop);
    Outcome outcome;
    Start(&s, work);
    LookWithProfile(&s); /* who holds the indices gets others */
    outcome.result = CallPoorly(&s, call, INT32_MAX, true);
    assert_true(outcome.result != KIRI_ERROR_MEMORY);
    After(&s, &outcome);
    return outcome;
}

/* Refused again and again, until it goes through, the call leaves the world as it was; then all goes on as if it had
   gone through at once. Returns how often it was refused. */
static int32_t CheckCall(const EveryCall* call, int32_t work, bool once)
{
    Outcome rich = OutcomeOf(call, work), poor;
    SCOPED(Stand, s, Stand_Stop);
    int32_t refused = 0;
    Start(&s, work);
    uint64_t hash = Host_Hash(&s.tape.host), look = LookWithProfile(&s);
    while ((poor.result = CallPoorly(&s, call, refused, once)) == KIRI_ERROR_MEMORY) {
        if (Host_Hash(&s.tape.host) != hash || LookWithProfile(&s) != look) {
            fail_msg("%s, work %d, allocation %d: %s", call->name, work, refused,
                     Host_Hash(&s.tape.host) != hash ? "another hash" : "another look");
        }
        refused += step;
    }
    After(&s, &poor);
    if (poor.result != rich.result || poor.hash != rich.hash || poor.look != rich.look || poor.end != rich.end ||
        poor.layout != rich.layout) {
        fail_msg("%s, work %d, after %d refusals: result %d and %d, hash %d, look %d, end %d, layout %d", call->name,
                 work, refused, poor.result, rich.result, poor.hash == rich.hash, poor.look == rich.look,
                 poor.end == rich.end, poor.layout == rich.layout);
    }
    assert_int_equal(poor.live, rich.live);
    assert_int_equal(poor.liveAtEnd, rich.liveAtEnd);
    return refused;
}

TEST(CallsRefused)
{
    int32_t all = 0, calls = 0;
    for (int32_t work = 0; work < STATES; ++work) {
        const EveryCall* call = everyCall + OTHERS + work % stride;
        for (; call < everyCall + everyCallCount; call += stride) {
            int32_t refused = CheckCall(call, work, work % 2 == 0);
            calls += refused > 0 && work == NO_WORK;
            all += refused;
        }
    }
    print_message("%d allocations of %d calls refused\n", all, calls);
    assert_true(all > 10000 / step / stride && calls > 25 / stride);
}

/* A tick that is refused memory keeps the work that is done, and in the end the layout is the same; so does
   kiriWorld_FinishCuts. Where the limits are lifted the tick does all of the work that waits. */
static int32_t CheckWork(const EveryCall* call, int32_t work, bool isLifted, bool once)
{
    uint64_t layout = OutcomeOf(call, work).layout;
    for (int32_t refused = 0;; refused += step) {
        SCOPED(Stand, s, Stand_Stop);
        Outcome poor;
        Start(&s, work);
        if (isLifted) {
            LiftLimits(&s);
        }
        poor.result = CallPoorly(&s, call, refused, once);
        Host_Validate(&s.tape.host);
        After(&s, &poor);
        if (poor.layout != layout) {
            fail_msg("%s, work %d, allocation %d: another end", call->name, work, refused);
        }
        if (poor.result != KIRI_ERROR_MEMORY) {
            return refused;
        }
    }
}

TEST(WorkRefused)
{
    for (int32_t work = 0; work < STATES; ++work) {
        for (int kind = 0; kind < 3; ++kind) {
            const EveryCall* call = &everyCall[kind < 2 ? TICK : FINISH];
            int32_t refused = CheckWork(call, work, kind == 1, (work + kind) % 2 == 0);
            print_message("work %d: %d allocations of %s refused\n", work, refused, call->name);
            assert_true(refused > 4 || kind == 0);
        }
    }
}

/* Refused at random, again and again, under random budgets. */
TEST(RefusedAtRandom)
{
    uint64_t layout = OutcomeOf(&everyCall[TICK], NO_WORK).layout;
    int32_t refused[KIRI_STAGE_COUNT + 1] = { 0 };
    for (uint32_t run = 1; run <= 60; ++run) {
        uint32_t seed = 7919u * run;
        SCOPED(Stand, s, Stand_Stop);
        Start(&s, NO_WORK);
        kiriResult result = KIRI_PENDING;
        for (int tick = 0; result != KIRI_OK; ++tick) {
            kiriBudget budget = { (int32_t)(16 + Random(&seed) % 30), (int32_t)(20 + Random(&seed) % 200),
                                  (int32_t)(10 + Random(&seed) % 40), 0 };
            OK(kiriWorld_SetBudget(s.tape.host.world, &budget));
            int32_t stage = Layout_Stage(s.tape.host.world, s.given.sheet);
            bool poorly = tick < 500 && Random(&seed) % 3 == 0;
            result = CallPoorly(&s, &everyCall[TICK], poorly ? (int64_t)(Random(&seed) % 3) : INT32_MAX, run % 2 == 0);
            if (result < 0) {
                assert_int_equal(result, KIRI_ERROR_MEMORY);
                refused[stage < 0 ? KIRI_STAGE_COUNT : stage] += 1;
            }
        }
        assert_true(Layout_HashAll(s.tape.host.world) == layout);
    }
    for (int32_t stage = KIRI_STAGE_CUT; stage <= KIRI_STAGE_SAMPLES; ++stage) {
        print_message("%d ticks refused at stage %s\n", refused[stage], kiriGetStageName(stage));
        assert_true(refused[stage] > 0);
    }
}

/* ---- Snapshots after a refused tick ---- */

/* Restores what a snapshot has then, and goes on with both worlds. False where nothing was refused. */
static bool GoOnFromSnapshot(int32_t work, int64_t n)
{
    SCOPED(Stand, s, Stand_Stop);
    Host other;
    Start(&s, work);
    LiftLimits(&s);
    bool isRefused = CallPoorly(&s, &everyCall[TICK], n, n % 2 == 0) == KIRI_ERROR_MEMORY;
    if (isRefused) {
        Host_Start(&other);
        World_Copy(other.world, s.tape.host.world, kiriWorld_Snapshot);
        for (int tick = 0; tick < 3; ++tick) {
            assert_true(Host_Hash(&other) == Host_Hash(&s.tape.host));
            OK(Make(&s, "kiriWorld_Tick"));
            OK(kiriWorld_Tick(other.world, 0.01f, 2));
        }
        Host_Stop(&other);
    }
    return isRefused;
}

TEST(SnapshotAfterRefusal)
{
    for (int32_t work = 0; work < STATES; ++work) {
        int64_t n = 0;
        while (GoOnFromSnapshot(work, n)) {
            n += step;
        }
        assert_true(n > 4);
    }
}

/* The journal of the mesh is closed then: pieces may leave the sheet. */
TEST(DetachAfterRefusal)
{
    kiriResult result = KIRI_ERROR_MEMORY;
    int32_t refused = 0;
    for (; result == KIRI_ERROR_MEMORY; refused += step) {
        SCOPED(Stand, s, Stand_Stop);
        Start(&s, NO_WORK);
        result = CallPoorly(&s, &everyCall[TICK], refused, true);
        if (result == KIRI_ERROR_MEMORY) {
            kiriResult detached = Make(&s, "kiriFrame_DetachPiece");
            assert_true(detached >= 0);
            assert_int_equal(Make(&s, "kiriWorld_Tick"), detached); /* the work is done, the piece goes */
            OK(Make(&s, "kiriWorld_Tick"));
        }
    }
    assert_true(refused > 4);
}
