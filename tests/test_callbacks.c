/* Callbacks that call their own world: each function of the header from within each callback. While a function that
   changes the world runs, all are refused; while one that only reads does, those that change it. */
#include "every_call.h"

#include <stdio.h>

enum {
    IN_ALLOC = 1,
    IN_FREE = 2,
    IN_LOG = 4,
    IN_CLOCK = 8,
    IN_RECORD = 16,
    IN_START = 32,
    IN_FINISH = 64,
    IN_DRAW = 128
};

typedef struct Caller {
    Host host; /* first: the allocator takes it */
    int32_t armed;
    int32_t most;        /* times that each callback calls, after Arm */
    bool isRead;         /* the world is only read */
    int32_t called[256]; /* times, by callback */
    int64_t noted;       /* bytes of the recording */
} Caller;

/* ---- All functions ---- */

/* The list has each function that the header declares with a world, with const or without. */
TEST(ListIsWhole)
{
    char line[512];
    int32_t found = 0;
    FILE* header = fopen("include/kiri/kiri.h", "r");
    assert_non_null(header);
    while (fgets(line, sizeof(line), header) != NULL) {
        char name[128];
        bool isFunction = sscanf(line, "KIRI_API kiriResult %127[A-Za-z0-9_](", name) == 1;
        if (isFunction && strstr(line, "kiriWorld* world") != NULL) {
            bool isListed = false;
            for (int32_t i = 0; i < everyCallCount; ++i) {
                isListed |= strcmp(everyCall[i].name, name) == 0 &&
                            everyCall[i].changes == (strstr(line, "const kiriWorld*") == NULL);
            }
            if (!isListed) {
                fail_msg("%s is not in every_call.h", name);
            }
            ++found;
        }
    }
    fclose(header);
    assert_int_equal(found, everyCallCount);
}

/* ---- Callbacks ---- */

static void CallAll(Caller* caller, int32_t callback)
{
    if ((caller->armed & callback) == 0 || caller->called[callback] >= caller->most) {
        return;
    }
    static const Given none;
    kiriWorld* world = caller->host.world;
    char before[256];
    int32_t armed = caller->armed, lines = caller->host.lines;
    caller->armed = 0;
    strcpy(before, kiriWorld_GetLastError(world));
    for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; ++call) {
        kiriResult result = call->make(world, &none);
        if ((result == KIRI_ERROR_STATE) != (call->changes || !caller->isRead)) {
            fail_msg("%s from within callback %d: %s", call->name, (int)callback, kiriGetResultName(result));
        }
        /* A line for each, but to the log that calls. */
        bool isTold = callback != IN_LOG && call->changes;
        if (isTold) {
            assert_true(strstr(caller->host.line, call->name) == caller->host.line);
        }
    }
    kiriDestroyWorld(world);
    assert_true(callback == IN_LOG ? caller->isRead || caller->host.lines == lines
                                   : caller->host.lines >= lines + everyCallCount / 2);
    assert_string_equal(before, kiriWorld_GetLastError(world));
    caller->armed = armed;
    caller->called[callback] += 1;
}

static void* Alloc(void* user, int64_t bytes)
{
    CallAll(user, IN_ALLOC);
    return Host_Alloc(user, bytes);
}

static void Free(void* user, void* pointer)
{
    CallAll(user, IN_FREE);
    Host_Free(user, pointer);
}

static void Log(void* user, const char* line)
{
    Host_Log(user, line);
    CallAll(user, IN_LOG);
}

static double Clock(void* user)
{
    CallAll(user, IN_CLOCK);
    return 0.0;
}

static void Record(void* user, const void* bytes, int32_t count)
{
    ((Caller*)user)->noted += count;
    CallAll(user, IN_RECORD);
}

static void* StartTask(void* user, kiriTaskFn* task, int32_t itemCount, int32_t minRange, void* taskContext)
{
    CallAll(user, IN_START);
    task(0, itemCount, taskContext);
    return user;
}

static void FinishTask(void* user, void* handle)
{
    CallAll(user, IN_FINISH);
}

static void Draw(void* user, const kiriDrawVertex* vertices, int32_t count)
{
    CallAll(user, IN_DRAW);
}

/* ---- What runs ---- */

static void Start(Caller* caller)
{
    memset(caller, 0, sizeof(*caller));
    kiriWorldDef def = Host_Def(&caller->host);
    caller->host.failAt = -1;
    caller->most = 3;
    def.alloc = Alloc;
    def.free = Free;
    def.log = Log;
    def.clock = Clock;
    def.record = Record;
    def.startTask = StartTask;
    def.finishTask = FinishTask;
    def.workerCount = 2;
    def.user = caller;
    OK(kiriCreateWorld(&def, &caller->host.world));
}

static void Arm(Caller* caller, bool isRead)
{
    caller->armed = 255;
    caller->isRead = isRead;
    for (int32_t i = 0; i < 256; ++i) {
        caller->called[i] = 0;
    }
}

/* Which callbacks have called since. */
static int32_t Disarm(Caller* caller)
{
    int32_t callbacks = 0;
    caller->armed = 0;
    for (int32_t i = 0; i < 256; ++i) {
        callbacks |= caller->called[i] > 0 ? i : 0;
    }
    return callbacks;
}

/* A run in which everything calls back; *callbacks are those that did. */
static uint64_t Run(Caller* caller, bool isArmed, int32_t* callbacks)
{
    kiriWorld* world = caller->host.world;
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet, piece;
    *callbacks = 0;
    for (int32_t step = 0; step < 8; ++step) {
        if (isArmed) {
            Arm(caller, false);
        }
        if (step == 0) {
            OK(kiriCreateRectangle(world, 1.0f, 1.0f, 8, 8, &def, &sheet));
            OK(kiriCreateRectangle(world, 1.0f, 1.0f, 8, 8, &def, &piece));
        } else if (step == 2) {
            Host_Cut(&caller->host, sheet, (float[]){ -0.1f, 0.42f, 1.1f, 0.57f }, 2);
        } else if (step == 4) {
            OK(kiriFrame_DetachPiece(world, Host_FrameOf(&caller->host, sheet, 1), &piece));
        } else if (step == 6) {
            assert_int_equal(kiriWorld_SetGravity(world, NULL), KIRI_ERROR_ARGUMENT);
            assert_true(strstr(kiriWorld_GetLastError(world), "kiriWorld_SetGravity") != NULL);
        }
        OK(kiriWorld_Tick(world, 1.0f / 60.0f, 2));
        *callbacks |= Disarm(caller);
    }
    return Host_Hash(&caller->host);
}

TEST(Changing)
{
    static Caller callers[2];
    int32_t callbacks;
    Start(&callers[0]);
    Start(&callers[1]);
    uint64_t plain = Run(&callers[0], false, &callbacks);
    assert_int_equal(callbacks, 0);
    assert_true(plain == Run(&callers[1], true, &callbacks));
    assert_int_equal(callbacks, 255 & ~IN_DRAW);
    assert_true(callers[0].noted == callers[1].noted); /* no recording has refused calls */

    /* Saves: the world that is read stays busy. */
    Bytes bytes = World_Write(callers[1].host.world, kiriWorld_Save);
    Arm(&callers[1], false);
    OK(kiriWorld_Load(callers[1].host.world, bytes.data, bytes.size));
    assert_true((Disarm(&callers[1]) & (IN_ALLOC | IN_FREE)) == (IN_ALLOC | IN_FREE));
    OK(kiriWorld_Tick(callers[1].host.world, 1.0f / 60.0f, 2));
    Bytes_Free(&bytes);
    for (int k = 0; k < 2; ++k) {
        callers[k].isRead = false;
        callers[k].armed = k == 0 ? 0 : IN_FREE | IN_RECORD; /* while the world goes */
        Host_Destroy(&callers[k].host);
    }
}

TEST(Reading)
{
    static Caller caller;
    int32_t callbacks, count;
    kiriFrame frames[16];
    float weights[16];
    double error;
    Start(&caller);
    kiriWorld* world = caller.host.world;
    uint64_t hash = Run(&caller, false, &callbacks);
    kiriSheet sheet = 0;
    OK(kiriWorld_GetSheets(world, &sheet, 1, &count));
    kiriDebugDraw draw;
    kiriDefaultDebugDraw(&draw);
    draw.points = draw.lines = draw.triangles = Draw;
    draw.flags = KIRI_DRAW_ALL;
    draw.user = &caller;
    Arm(&caller, true);
    OK(kiriWorld_DebugDraw(world, &draw));
    OK(kiriSheet_GetWeights(world, sheet, (float[]){ 0.5f, 0.2f }, frames, weights, NULL, 16, &count));
    OK(kiriSheet_EstimateError(world, sheet, &error));
    assert_int_equal(kiriWorld_GetSheets(world, NULL, 0, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Disarm(&caller), IN_ALLOC | IN_FREE | IN_LOG | IN_DRAW);
    assert_true(hash == Host_Hash(&caller.host));
    OK(kiriWorld_Tick(world, 1.0f / 60.0f, 1)); /* all that was refused may be called again */
    Host_Destroy(&caller.host);
}

/* Two worlds share nothing: a callback of one may call the other. */
static kiriWorld* other;

static double TickOther(void* user)
{
    OK(kiriWorld_Tick(other, 1.0f / 60.0f, 1));
    return 0.0;
}

TEST(OtherWorld)
{
    HOST_PAIR(hosts);
    Host_Start(&hosts[0]);
    other = hosts[0].world;
    memset(&hosts[1], 0, sizeof(hosts[1]));
    hosts[1].failAt = -1;
    kiriWorldDef def = Host_Def(&hosts[1]);
    def.clock = TickOther;
    OK(kiriCreateWorld(&def, &hosts[1].world));
    OK(kiriWorld_Tick(hosts[1].world, 1.0f / 60.0f, 1));
}
