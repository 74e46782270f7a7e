/* Recordings: what is recorded, and what comes of it when it is replayed. */
#define _DEFAULT_SOURCE /* for MAP_ANONYMOUS */

#include "every_call.h"
#include "storm.h"

#include "world/kiri_call.h"

#include <stdio.h>
#include <sys/mman.h>

/* ---- A storm ----------------------------------------------------------------------------------------------------- */

enum { STORM_TICKS = 12 };

static const StormType storms[] = {
    { .name = "links", .obstacles = true, .touches = true, .sheets = 3 },
    { .name = "smooth", .skinning = KIRI_SKINNING_SMOOTH, .obstacles = true, .sheets = 2 },
    { .name = "affine", .model = KIRI_MODEL_AFFINE, .obstacles = true, .sheets = 1 },
    { .name = "points", .model = KIRI_MODEL_POINTS, .sheets = 1 },
    { .name = "planar", .planar = true, .timeStepping = KIRI_TIME_STEPPING_EULER, .sheets = 2 },
    { .name = "budget", .touches = true, .sheets = 3, .budget = { 64, 400, 100, 8 } },
};

static void StartStorm(Storm* storm, Tape* tape, const StormType* type)
{
    memset(storm, 0, sizeof *storm);
    storm->type = type;
    storm->seed = 7 + (uint32_t)(type - storms);
    kiriWorldDef def = Tape_Def(tape);
    def.budget = type->budget;
    OK(kiriCreateWorld(&def, &tape->host.world));
    storm->world = tape->host.world;
    for (int32_t i = 0; i < type->sheets; i++) {
        Storm_AddSheet(storm);
    }
    for (int32_t i = 0; type->obstacles && i < STORM_OBSTACLES; i++) {
        Storm_AddObstacle(storm);
    }
}

/* With looks at all that can be seen: they are not in the recording, and nothing depends on them. Nobody validates it:
   where settings changed, regions are marked until the next cut. */
static void RecordStorm(Tape* tape, const StormType* type, uint64_t hashes[STORM_TICKS])
{
    Storm storm;
    StartStorm(&storm, tape, type);
    for (int32_t tick = 0; tick < STORM_TICKS; tick++) {
        for (uint32_t acts = 4 + Storm_Random(&storm, 4); acts > 0; acts--) {
            Storm_Act(&storm);
        }
        kiriWorld_Tick(storm.world, 1.0f / 60.0f, 1 + (int32_t)Storm_Random(&storm, 3));
        Storm_HashSeen(&storm);
        hashes[tick] = Host_Hash(&tape->host);
    }
    Host_Destroy(&tape->host);
}

TEST(Storm)
{
    for (size_t i = 0; i < sizeof storms / sizeof storms[0]; i++) {
        Tape tape, again;
        uint64_t hashes[STORM_TICKS];
        RecordStorm(&tape, &storms[i], hashes);
        Tape_Start(&again);
        for (int32_t tick = 0; tick < STORM_TICKS; tick++) {
            assert_int_equal(Tape_Step(&again, &tape), KIRI_PENDING);
            assert_int_equal(again.replay.ticks, tick + 1);
            assert_true(Host_Hash(&again.host) == hashes[tick]);
        }
        OK(Tape_Step(&again, &tape));
        assert_int_equal(again.replay.offset, tape.size);
        Host_Destroy(&again.host);
        if (storms[i].budget.cells == 0) { /* the def of the replaying world is the recorded one's */
            assert_int_equal(again.size, tape.size);
            assert_memory_equal(again.bytes, tape.bytes, (size_t)tape.size);
        }
        Tape_Free(&again);
        Tape_Free(&tape);
    }
}

/* ---- Each call --------------------------------------------------------------------------------------------------- */

static void Refuse(kiriWorld* world, kiriSheet sheet)
{
    static const float nan[3] = { 0.0f, NAN, 0.0f }, middle[2] = { 0.5f, 0.5f };
    kiriSheet made;
    kiriSheetDef def = DefaultSheet();
    assert_int_equal(kiriCreateSheet(world, &def, &made), KIRI_ERROR_ARGUMENT);
    def.vertexCount = -1;
    def.restPositions = (const float*)(const void*)&def; /* nobody may read it */
    def.indices = (const int32_t*)(const void*)&def;
    def.triangleCount = INT32_MAX;
    assert_int_equal(kiriCreateSheet(world, &def, &made), KIRI_ERROR_ARGUMENT);
    memset(&def, 0x5a, sizeof def);
    assert_int_equal(kiriCreateSheet(world, &def, &made), KIRI_ERROR_DEF);
    assert_int_equal(kiriCreateSheet(world, NULL, &made), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriCreateSheet(world, &def, NULL), KIRI_ERROR_DEF);
    assert_int_equal(kiriCut_Extend(world, UINT32_MAX, middle, INT32_MAX), KIRI_ERROR_ID);
    assert_int_equal(kiriWorld_SetGravity(world, nan), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_DetachPieces(world, NULL, -2, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_DestroyPieces(world, &sheet, 1), KIRI_ERROR_ID);
    assert_int_equal(kiriWorld_Note(world, NULL, 3), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_Tick(world, -1.0f, 1), KIRI_ERROR_ARGUMENT);
}

/* Adds a prism with an outline, and a ball. The library must not read the outline of the ball. */
static void Obstruct(kiriWorld* world)
{
    static const float outline[8] = { -1.0f, -1.0f, 1.0f, -1.0f, 1.0f, 1.0f, -1.0f, 1.0f };
    kiriObstacleDef def = ObstacleOf(KIRI_OBSTACLE_PRISM);
    def.outline = outline;
    def.outlineCount = 4;
    def.height = 0.1f;
    def.position[2] = -0.3f;
    World_AddObstacle(world, &def);
    def.type = KIRI_OBSTACLE_SPHERE;
    def.outline = (const float*)(const void*)&def;
    def.radius = 0.1f;
    World_AddObstacle(world, &def);
}

/* Every call goes well, and some fail. A call that earlier ones have made impossible is made after the first world is
   loaded. */
static void RecordAll(Stand* s, kiriRecordFn* write)
{
    Stand_Start(s, write);
    kiriWorld* world = s->tape.host.world;
    for (int32_t i = 0; i < everyCallCount; i++) {
        if (!everyCall[i].changes || strcmp(everyCall[i].name, "kiriWorld_Restore") == 0) {
            continue;
        }
        if (Stand_Make(s, &everyCall[i]) < 0) {
            OK(kiriWorld_Load(world, s->given.save, s->given.saveBytes));
            assert_true(Stand_Make(s, &everyCall[i]) >= 0);
        }
        if (i % 4 == 0) {
            Tape_Tick(&s->tape);
        }
    }
    assert_int_equal(Stand_Make(s, EveryCall_Find("kiriWorld_Restore")), KIRI_ERROR_STATE); /* not recorded */
    assert_int_equal(kiriWorld_Load(world, s->given.save, s->given.saveBytes - 1), KIRI_ERROR_DATA);
    OK(kiriWorld_Load(world, s->given.save, s->given.saveBytes));
    OK(kiriFrame_Hold(world, s->given.frame, NULL, NULL));
    Obstruct(world);
    Refuse(world, s->given.sheet);
    Tape_Tick(&s->tape);
    Tape_Stop(&s->tape);
}

TEST(All)
{
    Stand s;
    RecordAll(&s, Tape_Write);
    Tape_PlayAll(&s.tape);
}

/* ---- What is in it ----------------------------------------------------------------------------------------------- */

/* How often each call succeeded. A recorder that is open has begun a call, and its bytes start with the number. */
static int32_t counts[KIRI_CALL_COUNT];
static int32_t openCall = KIRI_NONE;

static void WriteAndCount(void* user, const void* bytes, int32_t count)
{
    const kiriWorld* world = ((Tape*)user)->host.world;
    uint8_t first = *(const uint8_t*)bytes;
    Tape_Write(user, bytes, count);
    if (world != NULL && world->recorder.isOpen) {
        openCall = openCall == KIRI_NONE ? first : openCall;
        assert_in_range(openCall, 0, KIRI_CALL_COUNT - 1);
    } else if (openCall != KIRI_NONE) {
        counts[openCall] += first % 2 == 0; /* odd: below 0 */
        openCall = KIRI_NONE;
    }
}

TEST(AllCallsAreRecorded)
{
    SCOPED(Stand, s, Stand_Stop);
    RecordAll(&s, WriteAndCount);
    for (int32_t number = KIRI_CALL_DestroyWorld; number < KIRI_CALL_COUNT; number++) {
        if (counts[number] == 0) {
            fail_msg("%s is not in the recording of all calls", kiriCallRows[number].name);
        }
    }
}

/* These take a world that is not const, and no tick depends on them; or others of the header do all that they do. */
static bool IsLook(const char* name)
{
    static const char* const looks[] = { "kiriSheet_GetSolid",       "kiriSheet_GetPiece", "kiriSheet_GetPieceMesh",
                                         "kiriSheet_GetPieceFrames", "kiriWorld_Replay",   "kiriCreateRectangle",
                                         "kiriWorld_Restore" };
    bool isLook = false;
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++) {
        isLook |= strcmp(looks[i], name) == 0;
    }
    return isLook;
}

/* test_callbacks.c compares every_call.h with the header. */
TEST(TablesAgree)
{
    for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; call++) {
        bool isInTable = false;
        for (int32_t number = 0; number < KIRI_CALL_COUNT; number++) {
            isInTable |= strcmp(kiriCallRows[number].name, call->name) == 0;
        }
        if (isInTable != (call->changes && !IsLook(call->name))) {
            fail_msg("%s is to be in kiri_call.h, or in IsLook", call->name);
        }
    }
}

/* Every byte of a struct is recorded, but for its cookie, pointers and padding. */
static void CheckStruct(const char* name, const kiriStruct* of)
{
    bool covered[1024] = { false };
    int32_t pointers = 0;
    for (int32_t i = 0; i < of->count; i++) {
        const kiriValue* member = &of->members[i];
        bool isPointer = member->form >= KIRI_FORM_FLOATS_AT;
        int32_t bytes = isPointer                          ? (int32_t)sizeof(void*)
                        : member->form == KIRI_FORM_STRUCT ? member->of()->bytes
                                                           : 4 * member->count;
        pointers += isPointer;
        for (int32_t k = 0; k < bytes; k++) {
            assert_false(covered[member->offset + k]);
            covered[member->offset + k] = true;
        }
        if (member->form == KIRI_FORM_STRUCT) {
            CheckStruct(name, member->of());
        }
    }
    int32_t left = 0;
    for (int32_t i = of->cookie != 0 ? 4 : 0; i < of->bytes; i++) {
        left += !covered[i];
    }
    /* Padding: before pointers, and at the end. */
    if (left % 4 != 0 || left > (pointers > 0 ? 4 * (pointers + 1) : 0)) {
        fail_msg("%s: %d bytes of its struct are in no field", name, left);
    }
}

TEST(AllFieldsAreRecorded)
{
    int32_t found = 0;
    for (int32_t kind = 0; kind < KIRI_ARGUMENT_KINDS; kind++) {
        const kiriValue* value = &kiriArguments[kind];
        kiriStructFn* of = value->item != NULL ? value->item->of : value->of;
        if (of != NULL) {
            CheckStruct("an argument", of());
            found++;
        }
    }
    assert_int_equal(found, 11);
}

/* ---- Read-only arguments ----------------------------------------------------------------------------------------- */

/* A copy that nobody may change. */
static const void* Freeze(const void* bytes, size_t size)
{
    void* page = mmap(NULL, size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    assert_true(page != MAP_FAILED);
    memcpy(page, bytes, size);
    assert_int_equal(mprotect(page, size, PROT_READ), 0);
    return page;
}

/* What a host gives is not even written with what is in it. */
TEST(ReadOnlyArguments)
{
    const kiriBudget budget = { 1000, 100000, 100000, 1000 };
    const kiriContact contact = { -1, { 0.4f, 0.4f }, { 0.0f, 0.0f, 1.0f }, -0.1f, { 0 }, 0.5f, 0.0f, 0.0f, 3 };
    kiriObstacle obstacle;
    kiriSheet sheet;
    SCOPED(Tape, tape, Tape_Free);
    Tape_Start(&tape);
    kiriWorld* world = tape.host.world;
    kiriSheetDef def = Host_SmallDef();
    SCOPED_AS(Rectangle, mesh, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 4, 4);
    def.restPositions = Freeze(mesh.positions, sizeof(float) * 50);
    def.indices = Freeze(mesh.indices, sizeof(int32_t) * 96);
    kiriObstacleDef obstacleDef = DefaultObstacle();
    OK(kiriCreateSheet(world, Freeze(&def, sizeof def), &sheet));
    OK(kiriCreateObstacle(world, Freeze(&obstacleDef, sizeof obstacleDef), &obstacle));
    OK(kiriWorld_SetBudget(world, Freeze(&budget, sizeof budget)));
    OK(kiriSheet_SetContacts(world, sheet, Freeze(&contact, sizeof contact), 1));
    kiriFrame frame = Host_FrameOf(&tape.host, sheet, 0);
    assert_int_equal(kiriWorld_DestroyPieces(world, Freeze(&frame, sizeof frame), 1), KIRI_ERROR_STATE);
    OK(kiriWorld_Note(world, Freeze("hello", 5), 5));
}

/* ---- What it costs ----------------------------------------------------------------------------------------------- */

TEST(Size)
{
    SCOPED(Tape, tape, Tape_Free);
    float stroke[200];
    for (int i = 0; i < 200; i++) {
        stroke[i] = 0.005f * (float)i;
    }
    Tape_Start(&tape);
    kiriSheet sheet = Tape_AddSheet(&tape, 0.0f);
    assert_true(tape.size < 700); /* 25 vertices, 32 triangles */
    int64_t before = tape.size;
    Host_Cut(&tape.host, sheet, stroke, 100);
    assert_in_range(tape.size - before, 800, 830);
    before = tape.size;
    Tape_Tick(&tape);
    assert_in_range(tape.size - before, 7, 16);
}

/* A world that records allocates as one that does not. */
TEST(NoMemory)
{
    int64_t calls[2];
    for (int records = 0; records < 2; records++) {
        SCOPED(Tape, tape, Tape_Free);
        kiriWorldDef def = Tape_Def(&tape);
        def.record = records ? Tape_Write : NULL;
        OK(kiriCreateWorld(&def, &tape.host.world));
        kiriSheet sheet = Tape_AddSheet(&tape, 0.0f);
        Host_Cut(&tape.host, sheet, (float[]){ 0.5f, -0.1f, 0.51f, 1.1f }, 2);
        Tape_Tick(&tape);
        OK(kiriWorld_Note(tape.host.world, "hello", 5));
        calls[records] = tape.host.calls;
    }
    assert_int_equal(calls[0], calls[1]);
}
