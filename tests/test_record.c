/* Recordings: what is recorded, and what comes of it when it is replayed. */
#define _DEFAULT_SOURCE /* for MAP_ANONYMOUS */

#include "defaults.h"
#include "storm.h"
#include "tape.h"

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

static const float zero[3] = { 0.0f, 0.0f, 0.0f }, up[3] = { 0.0f, 0.0f, 1.0f };
static const float axes[9] = { 1.0f, 0.0f, 0.0f, 0.0f, 1.0f, 0.0f, 0.0f, 0.0f, 1.0f };
static const float middle[2] = { 0.5f, 0.5f };

static kiriFrame FrameAt(const Tape* tape, kiriSheet sheet, float u, float v)
{
    const float point[2] = { u, v };
    kiriPointState state = World_PointState(tape->host.world, sheet, point);
    return state.frame;
}

/* From side to side in the direction of v. */
static void Part(Tape* tape, kiriSheet sheet, float u)
{
    const float points[4] = { u, -0.1f, u + 0.01f, 1.1f };
    Host_Cut(&tape->host, sheet, points, 2);
    Tape_Tick(tape);
}

static void TakeParts(Tape* tape, kiriSheet sheet)
{
    kiriWorld* world = tape->host.world;
    kiriSheet detached[2];
    int32_t count;
    for (int i = 1; i < 6; i++) {
        Part(tape, sheet, 0.15f * (float)i);
    }
    OK(kiriFrame_DetachPiece(world, FrameAt(tape, sheet, 0.05f, 0.5f), &detached[0]));
    OK(kiriFrame_DestroyPiece(world, FrameAt(tape, sheet, 0.95f, 0.5f)));
    kiriFrame frames[2] = { FrameAt(tape, sheet, 0.25f, 0.5f), FrameAt(tape, sheet, 0.7f, 0.5f) };
    OK(kiriWorld_DetachPieces(world, frames, 2, detached));
    frames[0] = FrameAt(tape, sheet, 0.4f, 0.5f);
    OK(kiriWorld_DestroyPieces(world, frames, 1));
    OK(kiriSheet_DropCrumbs(world, detached[0], 0.001f, &count));
    Tape_Tick(tape);
}

static void Slash(Tape* tape, kiriSheet sheet)
{
    kiriWorld* world = tape->host.world;
    static const float swept[12] = { 0.5f, -1.0f, -9.0f, 0.5f, -1.0f, 9.0f, 0.5f, 0.6f, 9.0f, 0.5f, 0.6f, -9.0f };
    static const float edges[4][3] = {
        { 0.2f, -1.0f, 9.0f }, { 0.2f, -1.0f, -9.0f }, { 0.2f, 0.5f, 9.0f }, { 0.2f, 0.5f, -9.0f }
    };
    static const float origin[3] = { 0.2f, 0.7f, 9.0f }, down[3] = { 0.0f, 0.0f, -1.0f };
    kiriBlade blade;
    kiriCut cut;
    OK(kiriSheet_Slice(world, sheet, swept, &cut));
    OK(kiriBeginBlade(world, 0, &blade));
    OK(kiriBlade_MoveEdge(world, blade, edges[0], edges[1]));
    OK(kiriBlade_MoveEdge(world, blade, edges[2], edges[3]));
    OK(kiriBlade_MoveRay(world, blade, origin, down, 18.0f));
    OK(kiriBlade_End(world, blade));
    Tape_Tick(tape);
}

static void HoldAndLoad(Tape* tape, kiriSheet sheet)
{
    kiriWorld* world = tape->host.world;
    const float force[3] = { 0.01f, 0.0f, 0.02f }, from[2] = { 0.1f, 0.8f }, to[2] = { 0.9f, 0.8f };
    kiriFrame frame = FrameAt(tape, sheet, 0.9f, 0.9f);
    const kiriWind wind = { { 1.0f, 0.5f, 0.2f }, 1.2f, 1.1f, 0.1f };
    const kiriTearing tearing = { 200.0f, { 1.0f, 0.5f }, 2.0f, 1.0f, 3 };
    kiriContact contact = { -1, { 0.4f, 0.4f }, { 0.0f, 0.0f, 1.0f }, -0.1f, { 0 }, 0.5f, 0.0f, 0.0f, 3 };
    kiriFrameState state = World_FrameState(world, frame);
    OK(kiriFrame_Hold(world, frame, state.position, axes));
    OK(kiriFrame_ApplyForce(world, FrameAt(tape, sheet, 0.1f, 0.9f), force, zero));
    OK(kiriSheet_ApplyForce(world, sheet, from, force, zero));
    OK(kiriSheet_ApplyLineLoad(world, sheet, from, to, force));
    OK(kiriSheet_ApplyPressure(world, sheet, -0.5f));
    OK(kiriSheet_ApplyImpulse(world, sheet, to, force));
    OK(kiriSheet_SetWind(world, sheet, &wind));
    OK(kiriSheet_SetTearing(world, sheet, &tearing));
    OK(kiriSheet_SetContacts(world, sheet, &contact, 1));
    Tape_Tick(tape);
    OK(kiriFrame_Hold(world, frame, NULL, NULL));
}

static void Pin(Tape* tape, kiriSheet sheet, kiriObstacle obstacle)
{
    kiriWorld* world = tape->host.world;
    const float from[2] = { 0.1f, 0.8f }, to[2] = { 0.4f, 0.8f };
    kiriPin pins[3];
    kiriPinState state;
    kiriPinDef def;
    kiriDefaultPinDef(&def);
    def.restPoint[0] = def.restPoint[1] = 0.1f;
    def.target[0] = def.target[1] = 0.1f;
    def.stiffness = 20.0f;
    def.obstacle = obstacle;
    OK(kiriCreatePin(world, sheet, &def, &pins[0]));
    OK(kiriSheet_ClampLine(world, sheet, from, to, &pins[1]));
    OK(kiriSheet_HingeLine(world, sheet, from, to, &pins[2]));
    Tape_Tick(tape);
    OK(kiriPin_GetState(world, pins[1], &state));
    state.target[2] += 0.01f;
    OK(kiriPin_SetTarget(world, pins[0], up));
    OK(kiriPin_SetPose(world, pins[1], state.target, state.rotation));
    OK(kiriPin_SetBreakForce(world, pins[0], 3.0f));
    OK(kiriPin_SetUserData(world, pins[2], UINT64_MAX));
    Tape_Tick(tape);
    OK(kiriDestroyPin(world, pins[1]));
}

/* The seam goes with the other sheet. */
static void Sew(Tape* tape, kiriSheet sheet, kiriSheet other)
{
    static const float line[4] = { 0.55f, 0.9f, 0.55f, 0.95f };
    kiriWorld* world = tape->host.world;
    kiriSeamDef def;
    kiriSeam seam;
    kiriDefaultSeamDef(&def);
    def.sheetA = sheet;
    def.sheetB = other;
    def.lineA = def.lineB = line;
    def.countA = def.countB = 2;
    def.breakForce = 1e-3f;
    OK(kiriCreateSeam(world, &def, &seam));
    OK(kiriDestroySeam(world, seam));
    OK(kiriCreateSeam(world, &def, &seam));
    OK(kiriSeam_SetHinge(world, seam, 0.01f, 0.5f));
    Tape_Tick(tape);
}

static kiriObstacle Obstruct(Tape* tape)
{
    static const float outline[8] = { -1.0f, -1.0f, 1.0f, -1.0f, 1.0f, 1.0f, -1.0f, 1.0f };
    static const float inertia[6] = { 1.0f, 1.0f, 1.0f, 0.0f, 0.0f, 0.0f }, below[3] = { 0.5f, 0.5f, -0.3f };
    kiriWorld* world = tape->host.world;
    kiriObstacle obstacle, other;
    kiriObstacleDef def = DefaultObstacle();
    def.type = KIRI_OBSTACLE_PRISM;
    def.outline = outline;
    def.outlineCount = 4;
    def.height = 0.1f;
    OK(kiriCreateObstacle(world, &def, &obstacle));
    def.type = KIRI_OBSTACLE_SPHERE;
    def.outline = (const float*)(const void*)&def; /* no outline: nobody may read it */
    def.radius = 0.1f;
    OK(kiriCreateObstacle(world, &def, &other));
    OK(kiriObstacle_SetPose(world, obstacle, below, axes));
    OK(kiriObstacle_SetVelocity(world, obstacle, up, zero));
    OK(kiriObstacle_SetSurfaceVelocity(world, obstacle, up));
    OK(kiriObstacle_SetMass(world, obstacle, 2.0f, inertia, zero));
    OK(kiriDestroyObstacle(world, other));
    return obstacle;
}

static void AddFolded(kiriWorld* world)
{
    const kiriFold folds[2] = { { { 0.0f, 0.5f }, { 1.0f, 0.5f }, 1e-3f, 0.5f, 0.0f },
                                { { 0.5f, 0.0f }, { 0.5f, 1.0f }, 0.0f, 0.0f, 1e-4f } };
    kiriSheetDef def = Host_SmallDef();
    kiriSheet sheet;
    int32_t index;
    SCOPED_AS(Rectangle, mesh, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 4, 4);
    def.position[0] = 5.0f;
    OK(kiriCreateFoldedSheet(world, &def, folds, 2, &sheet));
    OK(kiriSheet_SetFold(world, sheet, 0, 2e-3f, -0.5f));
    OK(kiriSheet_AddFold(world, sheet, &folds[1], &index));
    assert_int_equal(index, 2);
}

static void Change(Tape* tape, kiriSheet sheet)
{
    kiriWorld* world = tape->host.world;
    const float gravity[3] = { 0.0f, 0.1f, -5.0f }, way[3] = { 0.0f, 0.0f, 0.1f };
    const kiriBudget budget = { 1000, 100000, 100000, 1000 };
    kiriSheetSettings settings = World_Settings(world, sheet);
    settings.friction = 0.25f;
    OK(kiriSheet_SetSettings(world, sheet, &settings));
    OK(kiriWorld_SetGravity(world, gravity));
    OK(kiriWorld_ShiftOrigin(world, way));
    OK(kiriWorld_SetBudget(world, &budget));
    OK(kiriSheet_Wake(world, sheet));
    OK(kiriSheet_Transform(world, sheet, axes, way));
    OK(kiriSheet_SetVelocity(world, sheet, up, zero));
    OK(kiriFrame_SetPieceVelocity(world, FrameAt(tape, sheet, 0.5f, 0.1f), zero, up));
    OK(kiriSheet_SetUserData(world, sheet, 12345678901234567u));
    AddFolded(world);
    OK(kiriFrame_SetPieceUserData(world, FrameAt(tape, sheet, 0.5f, 0.1f), 1));
    OK(kiriWorld_Note(world, "a note", 6));
    Tape_Tick(tape);
}

static void Refuse(Tape* tape, kiriSheet sheet)
{
    kiriWorld* world = tape->host.world;
    const float nan[3] = { 0.0f, NAN, 0.0f };
    kiriSheet made;
    kiriCut cut;
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
    assert_int_equal(kiriBeginCut(world, sheet + 100, middle, &cut), KIRI_ERROR_ID);
    assert_int_equal(kiriBeginCut(world, sheet, middle, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriCut_Extend(world, UINT32_MAX, middle, INT32_MAX), KIRI_ERROR_ID);
    assert_int_equal(kiriCut_Extend(world, 0, middle, 1), KIRI_ERROR_ID);
    assert_int_equal(kiriWorld_SetGravity(world, nan), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_SetGravity(world, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_DetachPieces(world, NULL, 2, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_DetachPieces(world, NULL, -2, NULL), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_DestroyPieces(world, &sheet, 1), KIRI_ERROR_ID);
    assert_int_equal(kiriSheet_SetContacts(world, sheet, NULL, 1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_Note(world, NULL, 3), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_Tick(world, -1.0f, 1), KIRI_ERROR_ARGUMENT);
}

/* Back to what was saved two ticks before. */
static void GoBack(Tape* tape)
{
    kiriWorld* world = tape->host.world;
    int64_t size;
    OK(kiriWorld_FinishCuts(world));
    OK(kiriWorld_Save(world, NULL, 0, &size));
    void* bytes = malloc((size_t)size);
    assert_non_null(bytes);
    OK(kiriWorld_Save(world, bytes, size, &size));
    Tape_Tick(tape);
    Tape_Tick(tape);
    OK(kiriWorld_Load(world, bytes, size));
    assert_int_equal(kiriWorld_Load(world, bytes, size - 1), KIRI_ERROR_DATA);
    assert_int_equal(kiriWorld_Restore(world, bytes, size), KIRI_ERROR_STATE); /* no recording has snapshots */
    free(bytes);
    Tape_Tick(tape);
}

/* Every call that there is succeeds, and some fail. */
static void RecordAll(Tape* tape, kiriRecordFn* write)
{
    kiriWorldDef def = Tape_Def(tape);
    def.record = write;
    OK(kiriCreateWorld(&def, &tape->host.world));
    kiriSheet sheet = Tape_AddSheet(tape, 0.0f), other = Tape_AddSheet(tape, 0.5f);
    kiriObstacle obstacle = Obstruct(tape);
    TakeParts(tape, other);
    Slash(tape, sheet);
    HoldAndLoad(tape, sheet);
    Pin(tape, sheet, obstacle);
    Change(tape, sheet);
    Sew(tape, sheet, other);
    GoBack(tape);
    Refuse(tape, sheet);
    OK(kiriDestroySheet(tape->host.world, other));
    Tape_Tick(tape);
    Tape_Stop(tape);
}

TEST(All)
{
    Tape tape;
    RecordAll(&tape, Tape_Write);
    Tape_PlayAll(&tape);
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
    SCOPED(Tape, tape, Tape_Free);
    RecordAll(&tape, WriteAndCount);
    for (int32_t number = KIRI_CALL_DestroyWorld; number < KIRI_CALL_COUNT; number++) {
        if (counts[number] == 0) {
            fail_msg("%s is not in the recording of all calls", kiriCallRows[number].name);
        }
    }
}

static bool IsInTable(const char* name)
{
    for (int32_t number = 0; number < KIRI_CALL_COUNT; number++) {
        if (strcmp(kiriCallRows[number].name, name) == 0) {
            return true;
        }
    }
    return false;
}

/* These take a world that is not const, and no tick depends on them; or others of the header do all that they do. */
static bool IsLook(const char* name)
{
    static const char* const looks[] = { "kiriSheet_GetSolid",       "kiriSheet_GetPiece", "kiriSheet_GetPieceMesh",
                                         "kiriSheet_GetPieceFrames", "kiriWorld_Replay",   "kiriCreateRectangle",
                                         "kiriWorld_Restore" };
    for (size_t i = 0; i < sizeof looks / sizeof looks[0]; i++) {
        if (strcmp(looks[i], name) == 0) {
            return true;
        }
    }
    return false;
}

TEST(HeaderAndTableAgree)
{
    FILE* header = fopen("include/kiri/kiri.h", "r");
    assert_non_null(header);
    char line[512], name[128];
    int32_t found = 0;
    while (fgets(line, sizeof line, header) != NULL) {
        if (sscanf(line, "KIRI_API kiriResult %127[A-Za-z_](kiriWorld* world", name) != 1 ||
            strstr(line, "(kiriWorld* world") == NULL) {
            continue;
        }
        found++;
        if (IsInTable(name) == IsLook(name)) {
            fail_msg("%s is to be in kiri_call.h, or in IsLook", name);
        }
    }
    fclose(header);
    assert_true(found >= 50);
}

/* Every byte of a struct is recorded, but for its cookie, pointers and padding. */
static void CheckStruct(const char* name, const kiriStruct* of)
{
    bool covered[1024] = { false };
    int32_t pointers = 0;
    for (int32_t i = 0; i < of->count; i++) {
        const kiriValue* member = &of->members[i];
        bool isPointer = member->form >= KIRI_FORM_FLOATS_AT;
        int32_t bytes = isPointer                            ? (int32_t)sizeof(void*)
                        : member->form == KIRI_FORM_STRUCT ? member->of->bytes
                                                             : 4 * member->count;
        pointers += isPointer;
        for (int32_t k = 0; k < bytes; k++) {
            assert_false(covered[member->offset + k]);
            covered[member->offset + k] = true;
        }
        if (member->form == KIRI_FORM_STRUCT) {
            CheckStruct(name, member->of);
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
        const kiriStruct* of = value->item != NULL ? value->item->of : value->of;
        if (of != NULL) {
            CheckStruct("an argument", of);
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
    kiriObstacleDef obstacleDef;
    kiriObstacle obstacle;
    kiriSheet sheet;
    SCOPED(Tape, tape, Tape_Free);
    Tape_Start(&tape);
    kiriWorld* world = tape.host.world;
    kiriSheetDef def = Host_SmallDef();
    SCOPED_AS(Rectangle, mesh, Rectangle_Free) = Rectangle_Make(&def, 1.0f, 1.0f, 4, 4);
    def.restPositions = Freeze(mesh.positions, sizeof(float) * 50);
    def.indices = Freeze(mesh.indices, sizeof(int32_t) * 96);
    kiriDefaultObstacleDef(&obstacleDef);
    OK(kiriCreateSheet(world, Freeze(&def, sizeof def), &sheet));
    OK(kiriCreateObstacle(world, Freeze(&obstacleDef, sizeof obstacleDef), &obstacle));
    OK(kiriWorld_SetBudget(world, Freeze(&budget, sizeof budget)));
    OK(kiriSheet_SetContacts(world, sheet, Freeze(&contact, sizeof contact), 1));
    kiriFrame frame = FrameAt(&tape, sheet, 0.5f, 0.5f);
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
        Part(&tape, sheet, 0.5f);
        OK(kiriWorld_Note(tape.host.world, "hello", 5));
        calls[records] = tape.host.calls;
    }
    assert_int_equal(calls[0], calls[1]);
}
