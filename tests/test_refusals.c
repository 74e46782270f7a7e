/* What a refused allocation leaves behind: for each call that changes a world, with work on a cut waiting at each
   stage, each allocation is refused once, and all from there on. */
#include "look.h"

#include "layout_hash.h"

static const float eye[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };

/* ---- A world with something to do for every call ---- */

/* Where the work on a cut waits. */
enum { NO_WORK = KIRI_STAGE_CONSTANTS /* and no limit */, NOT_BEGUN /* with a limit */, STATES };

/* So many pins and cuts fill the arrays: one more allocates. */
enum { FULL = 8 };

typedef struct Stand {
    Host host;
    kiriSheet sheet, made;
    kiriFrame frame; /* of the smaller piece */
    kiriPin pin, clamp, madePin;
    kiriCut cut, madeCut; /* not ended */
    Rectangle mesh;
    kiriSheetDef def;
} Stand;

static int32_t WaitingStage(const Host* host)
{
    kiriEvent event = { .stage = -1 };
    Host_Events(host, KIRI_EVENT_DEFERRED, &event);
    return event.stage;
}

/* A way in and out, and a loop whose piece needs frames and collision points of its own. */
static void GiveCuts(Stand* s)
{
    static const float line[10] = { -0.1f, 0.55f, 0.3f, 0.62f, 0.42f, 0.41f, 0.7f, 0.58f, 1.1f, 0.52f };
    static const float loop[10] = { 0.62f, 0.72f, 0.85f, 0.7f, 0.81f, 0.88f, 0.6f, 0.9f, 0.62f, 0.72f };
    Host_Cut(&s->host, s->sheet, line, 5);
    Host_Cut(&s->host, s->sheet, loop, 5);
    OK(kiriCut_Extend(s->host.world, s->cut, line + 4, 2));
    for (int i = 3; i < FULL; ++i) {
        World_BeginCut(s->host.world, s->sheet, line);
    }
}

/* A frame of the last piece, without the lists of pieces: a call is to make them. */
static kiriFrame FrameOfLastPiece(const Stand* s)
{
    kiriFrame frames[64];
    int32_t count, piece, last = Host_Counts(&s->host, s->sheet).pieces - 1;
    assert_int_equal(last, 1);
    OK(kiriSheet_GetFrames(s->host.world, s->sheet, frames, 64, &count));
    for (int32_t i = 0; i < count; ++i) {
        OK(kiriFrame_GetPiece(s->host.world, frames[i], &piece));
        if (piece == last) {
            return frames[i];
        }
    }
    return 0;
}

static void Stand_Start(Stand* s, int32_t work)
{
    static const float strip[4] = { -0.1f, 0.22f, 1.1f, 0.25f }, edge[4] = { 0.0f, 0.0f, 0.0f, 1.0f },
                       start[4] = { 0.3f, 0.8f, 0.4f, 0.7f };
    static const kiriBudget budget = { KIRI_LEAST_TRIANGLES, 25, 5, 0 };
    memset(s, 0, sizeof(*s));
    Host_Start(&s->host);
    kiriPinDef pin = Host_PinDef(0.1f, 0.9f, 0.1f, 0.9f, 0.0f);
    s->def = Host_SmallDef();
    s->def.framePoints = NULL;
    s->def.collisionPoints = 12;
    s->mesh = Rectangle_Make(&s->def, 1.0f, 1.0f, 4, 4);
    OK(kiriCreateSheet(s->host.world, &s->def, &s->sheet));
    for (int i = 0; i < FULL - 1; ++i) {
        OK(kiriCreatePin(s->host.world, s->sheet, &pin, &s->pin));
    }
    OK(kiriSheet_ClampLine(s->host.world, s->sheet, edge, edge + 2, &s->clamp)); /* over both pieces */
    Host_Cut(&s->host, s->sheet, strip, 2);
    OK(kiriBeginCut(s->host.world, s->sheet, start, &s->cut));
    OK(kiriCut_Extend(s->host.world, s->cut, start + 2, 1));
    OK(kiriWorld_Tick(s->host.world, 0.01f, 2));
    s->frame = FrameOfLastPiece(s);
    GiveCuts(s);
    if (work != NO_WORK) {
        OK(kiriWorld_SetBudget(s->host.world, &budget));
    }
    for (int tick = 0; work < NO_WORK && WaitingStage(&s->host) != work; ++tick) {
        assert_true(tick < 2000);
        assert_int_equal(kiriWorld_Tick(s->host.world, 0.01f, 1), KIRI_PENDING);
    }
}

static void Stand_Stop(Stand* s)
{
    Rectangle_Free(&s->mesh);
    Host_Stop(&s->host);
}

/* ---- The calls ---- */

/* Calls of one line, and whether they allocate. */
#define SHORT_CALLS(X)                                                                                                 \
    X(kiriWorld_Tick, (world, 0.01f, 2), true)                                                                         \
    X(kiriWorld_SetGravity, (world, eye), false)                                                                       \
    X(kiriWorld_ShiftOrigin, (world, eye), true)                                                                       \
    X(kiriCreateSheet, (world, &s->def, &s->made), true)                                                               \
    X(kiriCreateRectangle, (world, 1.0f, 1.0f, 4, 4, &s->def, &s->made), true)                                         \
    X(kiriDestroySheet, (world, s->sheet), false)                                                                      \
    X(kiriSheet_Wake, (world, s->sheet), false)                                                                        \
    X(kiriFrame_DetachPiece, (world, s->frame, &s->made), true)                                                        \
    X(kiriFrame_DestroyPiece, (world, s->frame), true)                                                                 \
    X(kiriWorld_DetachPieces, (world, &s->frame, 1, &s->made), true)                                                   \
    X(kiriWorld_DestroyPieces, (world, &s->frame, 1), true)                                                            \
    X(kiriBeginCut, (world, s->sheet, eye, &s->madeCut), true)                                                         \
    X(kiriCut_End, (world, s->cut), false)                                                                             \
    X(kiriFrame_Hold, (world, s->frame, eye + 1, eye), false)                                                          \
    X(kiriFrame_ApplyForce, (world, s->frame, eye, eye), false)                                                        \
    X(kiriPin_SetPose, (world, s->clamp, eye, eye), false)                                                             \
    X(kiriSheet_ApplyForce, (world, s->sheet, eye, eye, eye), false)                                                   \
    X(kiriSheet_ApplyPressure, (world, s->sheet, 2.0f), false)                                                         \
    X(kiriPin_SetTarget, (world, s->pin, eye), false)                                                                  \
    X(kiriDestroyPin, (world, s->pin), false)

#define MAKE(name, arguments, allocates)                                                                               \
    static kiriResult Call_##name(Stand* s)                                                                            \
    {                                                                                                                  \
        kiriWorld* world = s->host.world;                                                                              \
        return name arguments;                                                                                         \
    }
SHORT_CALLS(MAKE)

static kiriResult CallSetBudget(Stand* s)
{
    kiriBudget budget = { 0, 30, 0, 0 };
    return kiriWorld_SetBudget(s->host.world, &budget);
}

static kiriResult CallGetPiece(Stand* s)
{
    kiriPieceState state;
    return kiriSheet_GetPiece(s->host.world, s->sheet, 0, &state);
}

static kiriResult CallGetPieceMesh(Stand* s)
{
    kiriPieceMesh mesh;
    return kiriSheet_GetPieceMesh(s->host.world, s->sheet, 0, &mesh);
}

static kiriResult CallGetPieceFrames(Stand* s)
{
    const kiriFrame* frames;
    int32_t count;
    return kiriSheet_GetPieceFrames(s->host.world, s->sheet, 0, &frames, &count);
}

static kiriResult CallDropCrumbs(Stand* s)
{
    int32_t count;
    return kiriSheet_DropCrumbs(s->host.world, s->sheet, 0.5f, &count);
}

static kiriResult CallExtend(Stand* s)
{
    float points[400];
    for (int i = 0; i < 400; ++i) {
        points[i] = 0.2f + 0.0015f * (float)((i * 37) % 400);
    }
    return kiriCut_Extend(s->host.world, s->cut, points, 200);
}

static kiriResult CallSlice(Stand* s)
{
    static const float blade[12] = { 0.6f, -1.0f, -1.0f, 0.6f, -1.0f, 1.0f, 0.6f, 2.0f, 1.0f, 0.6f, 2.0f, -1.0f };
    return kiriSheet_Slice(s->host.world, s->sheet, blade, &s->madeCut);
}

static kiriResult CallCreatePin(Stand* s)
{
    kiriPinDef def = Host_PinDef(0.9f, 0.1f, 0.9f, 0.1f, 0.0f);
    return kiriCreatePin(s->host.world, s->sheet, &def, &s->madePin);
}

/* Lines over more frames than there is room for. */
static kiriResult CallClampLine(Stand* s)
{
    static const float from[2] = { 0.02f, 0.0f }, to[2] = { 1.0f, 0.98f };
    return kiriSheet_ClampLine(s->host.world, s->sheet, from, to, &s->madePin);
}

static kiriResult CallHingeLine(Stand* s)
{
    static const float from[2] = { 0.0f, 0.97f }, to[2] = { 0.99f, 0.01f };
    return kiriSheet_HingeLine(s->host.world, s->sheet, from, to, &s->madePin);
}

static kiriResult CallApplyLineLoad(Stand* s)
{
    static const float from[2] = { -0.1f, 0.03f }, to[2] = { 1.1f, 0.96f };
    return kiriSheet_ApplyLineLoad(s->host.world, s->sheet, from, to, eye);
}

static kiriResult CallSetContacts(Stand* s)
{
    kiriContact contacts[12];
    for (int i = 0; i < 12; ++i) {
        kiriContact contact = { .point = i, .normal = { 0.0f, 0.0f, 1.0f }, .offset = 0.001f, .friction = 0.3f };
        contacts[i] = contact;
    }
    return kiriSheet_SetContacts(s->host.world, s->sheet, contacts, 12);
}

typedef struct Call {
    const char* name;
    kiriResult (*make)(Stand* s);
    bool allocates; /* where it does its work */
} Call;

#define ROW(name, arguments, allocates) { #name, Call_##name, allocates },
static const Call calls[] = {
    SHORT_CALLS(ROW)
    { "kiriWorld_SetBudget", CallSetBudget, false },
    { "kiriSheet_GetPiece", CallGetPiece, true },
    { "kiriSheet_GetPieceMesh", CallGetPieceMesh, true },
    { "kiriSheet_GetPieceFrames", CallGetPieceFrames, true },
    { "kiriSheet_DropCrumbs", CallDropCrumbs, true },
    { "kiriCut_Extend", CallExtend, true },
    { "kiriSheet_Slice", CallSlice, true },
    { "kiriSheet_ApplyLineLoad", CallApplyLineLoad, true },
    { "kiriCreatePin", CallCreatePin, true },
    { "kiriSheet_ClampLine", CallClampLine, true },
    { "kiriSheet_HingeLine", CallHingeLine, true },
    { "kiriSheet_SetContacts", CallSetContacts, true },
};

enum { CALLS = sizeof(calls) / sizeof(calls[0]) };

/* The call with its n-th allocation refused, or all from there on. Its line names it. */
static kiriResult CallPoorly(Stand* s, const Call* call, int64_t n, bool once)
{
    int32_t lines = s->host.lines;
    s->host.failAt = s->host.calls + n;
    s->host.failOnce = once;
    kiriResult result = call->make(s);
    s->host.failAt = -1;
    const char* line = kiriWorld_GetLastError(s->host.world);
    if (result < 0) {
        assert_int_equal(s->host.lines, lines + 1);
        assert_string_equal(line, s->host.line);
        if (strncmp(line, call->name, strlen(call->name)) != 0 || line[strlen(call->name)] != ':') {
            fail_msg("%s says \"%s\"", call->name, line);
        }
    } else {
        assert_string_equal(line, "");
    }
    return result;
}

/* ---- What comes of it ---- */

static void LiftLimits(Stand* s)
{
    static const kiriBudget none = { 0, 0, 0, 0 };
    OK(kiriWorld_SetBudget(s->host.world, &none));
}

/* Does all work that waits: in each tick what was given before the same one. */
static void Finish(Stand* s)
{
    LiftLimits(s);
    for (int tick = 0; tick < 4; ++tick) {
        kiriResult result = kiriWorld_Tick(s->host.world, 0.01f, 1);
        assert_true(result == KIRI_OK || (result == KIRI_PENDING && tick < 2));
    }
}

static uint64_t LayoutOf(const Stand* s)
{
    return Layout_HashAll(s->host.world);
}

typedef struct Outcome {
    kiriResult result;
    uint64_t hash, look, end, layout;
    int64_t live, liveAtEnd;
} Outcome;

static void After(Stand* s, Outcome* outcome)
{
    outcome->hash = Host_Hash(&s->host);
    outcome->look = Look_World(s->host.world);
    outcome->live = s->host.live;
    Finish(s);
    outcome->end = Host_Hash(&s->host);
    outcome->layout = LayoutOf(s);
    outcome->liveAtEnd = s->host.live;
}

static uint64_t LookWithProfile(const Stand* s)
{
    return Look_Profile(Look_World(s->host.world), s->host.world);
}

static Outcome OutcomeOf(const Call* call, int32_t work)
{
    SCOPED(Stand, s, Stand_Stop);
    Outcome outcome;
    Stand_Start(&s, work);
    LookWithProfile(&s); /* who holds the indices gets others */
    outcome.result = CallPoorly(&s, call, INT32_MAX, true);
    assert_true(outcome.result != KIRI_ERROR_MEMORY);
    After(&s, &outcome);
    return outcome;
}

/* Refused again and again, until it goes through, the call leaves the world as it was; then all goes on as if it had
   gone through at once. Returns how often it was refused. */
static int32_t CheckCall(const Call* call, int32_t work, bool once)
{
    Outcome rich = OutcomeOf(call, work), poor;
    SCOPED(Stand, s, Stand_Stop);
    int32_t refused = 0;
    Stand_Start(&s, work);
    uint64_t hash = Host_Hash(&s.host), look = LookWithProfile(&s);
    while ((poor.result = CallPoorly(&s, call, refused, once)) == KIRI_ERROR_MEMORY) {
        if (Host_Hash(&s.host) != hash || LookWithProfile(&s) != look) {
            fail_msg("%s, work %d, allocation %d: %s", call->name, work, refused,
                     Host_Hash(&s.host) != hash ? "another hash" : "another look");
        }
        ++refused;
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

/* Calls that change a world, but for ticks. */
TEST(CallsRefused)
{
    int32_t all = 0;
    for (int32_t work = 0; work < STATES; ++work) {
        for (int32_t k = 1; k < CALLS; ++k) { /* the first is a tick */
            int32_t refused = 0;
            for (int once = 0; once < 2; ++once) {
                refused += CheckCall(&calls[k], work, once != 0);
            }
            assert_true(refused == 0 || calls[k].allocates);
            if (refused == 0 && calls[k].allocates && work == NO_WORK) {
                fail_msg("%s allocates nothing", calls[k].name);
            }
            all += refused;
        }
    }
    print_message("%d allocations refused\n", all);
    assert_true(all > 2000);
}

/* A tick that is refused memory keeps the work that is done, and in the end the layout is the same. Where the limits are
   lifted the tick does all of the work that waits. */
static int32_t CheckTick(int32_t work, bool isLifted, bool once, const Outcome* rich)
{
    for (int32_t refused = 0;; ++refused) {
        Stand s;
        Outcome poor;
        Stand_Start(&s, work);
        if (isLifted) {
            LiftLimits(&s);
        }
        poor.result = CallPoorly(&s, &calls[0], refused, once);
        bool isThrough = poor.result != KIRI_ERROR_MEMORY;
        Host_Validate(&s.host);
        After(&s, &poor);
        if (poor.layout != rich->layout) {
            fail_msg("a tick, work %d, allocation %d: another end", work, refused);
        }
        Stand_Stop(&s);
        if (isThrough) {
            return refused;
        }
    }
}

TEST(TicksRefused)
{
    for (int32_t work = 0; work < STATES; ++work) {
        Outcome rich = OutcomeOf(&calls[0], work);
        for (int isLifted = 0; isLifted < 2; ++isLifted) {
            int32_t refused =
                CheckTick(work, isLifted != 0, true, &rich) + CheckTick(work, isLifted != 0, false, &rich);
            print_message("work %d: %d allocations of a tick refused\n", work, refused);
            assert_true(refused > 4 || !isLifted);
        }
    }
}

/* Refused at random, again and again, under random budgets. */
TEST(RefusedAtRandom)
{
    uint64_t layout = OutcomeOf(&calls[0], NO_WORK).layout;
    int32_t refused[KIRI_STAGE_COUNT + 1] = { 0 };
    for (uint32_t run = 1; run <= 60; ++run) {
        uint32_t seed = 7919u * run;
        SCOPED(Stand, s, Stand_Stop);
        Stand_Start(&s, NO_WORK);
        kiriResult result = KIRI_PENDING;
        for (int tick = 0; result != KIRI_OK; ++tick) {
            kiriBudget budget = { (int32_t)(16 + Random(&seed) % 30), (int32_t)(20 + Random(&seed) % 200),
                                  (int32_t)(10 + Random(&seed) % 40), 0 };
            OK(kiriWorld_SetBudget(s.host.world, &budget));
            int32_t stage = Layout_Stage(s.host.world, s.sheet);
            bool poorly = tick < 500 && Random(&seed) % 3 == 0;
            result = CallPoorly(&s, &calls[0], poorly ? (int64_t)(Random(&seed) % 3) : INT32_MAX, run % 2 == 0);
            if (result < 0) {
                assert_int_equal(result, KIRI_ERROR_MEMORY);
                refused[stage < 0 ? KIRI_STAGE_COUNT : stage] += 1;
            }
        }
        assert_true(LayoutOf(&s) == layout);
    }
    for (int32_t stage = KIRI_STAGE_CUT; stage <= KIRI_STAGE_SAMPLES; ++stage) {
        print_message("%d ticks refused at stage %s\n", refused[stage], kiriGetStageName(stage));
        assert_true(refused[stage] > 0);
    }
}

/* ---- Snapshots after a refused tick ---- */

static void RestoreIn(Host* host, const kiriWorld* world)
{
    int64_t size;
    OK(kiriWorld_Snapshot(world, NULL, 0, &size));
    FREED(void, bytes) = malloc((size_t)size);
    assert_non_null(bytes);
    OK(kiriWorld_Snapshot(world, bytes, size, &size));
    OK(kiriWorld_Restore(host->world, bytes, size));
}

/* Restores what a snapshot has then, and goes on with both worlds. False where nothing was refused. */
static bool GoOnFromSnapshot(int32_t work, int64_t n)
{
    SCOPED(Stand, s, Stand_Stop);
    Host other;
    Stand_Start(&s, work);
    LiftLimits(&s);
    bool isRefused = CallPoorly(&s, &calls[0], n, n % 2 == 0) == KIRI_ERROR_MEMORY;
    if (isRefused) {
        Host_Start(&other);
        RestoreIn(&other, s.host.world);
        for (int tick = 0; tick < 3; ++tick) {
            assert_true(Host_Hash(&other) == Host_Hash(&s.host));
            OK(Call_kiriWorld_Tick(&s));
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
            ++n;
        }
        assert_true(n > 4);
    }
}

/* The journal of the mesh is closed then: pieces may leave the sheet. */
TEST(DetachAfterRefusal)
{
    kiriResult result = KIRI_ERROR_MEMORY;
    int32_t refused = 0;
    for (; result == KIRI_ERROR_MEMORY; ++refused) {
        SCOPED(Stand, s, Stand_Stop);
        Stand_Start(&s, NO_WORK);
        result = CallPoorly(&s, &calls[0], refused, true);
        if (result == KIRI_ERROR_MEMORY) {
            kiriResult detached = Call_kiriFrame_DetachPiece(&s);
            assert_true(detached >= 0);
            assert_int_equal(Call_kiriWorld_Tick(&s), detached); /* the work is done, the piece goes */
            OK(Call_kiriWorld_Tick(&s));
        }
    }
    assert_true(refused > 4);
}
