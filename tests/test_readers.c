/* Reading a world changes nothing: neither its bytes nor its last error, whether the call goes through or fails; so any
   number of threads may read at the same time. */
#define _POSIX_C_SOURCE 200809L

#include "look.h"

#include <pthread.h>

/* ---- A host that several threads may call ---- */

typedef struct Hall {
    pthread_mutex_t lock;
    Host host; /* its world has the hooks below */
} Hall;

static void* LockedAlloc(void* user, int64_t bytes)
{
    Hall* hall = user;
    pthread_mutex_lock(&hall->lock);
    void* block = Host_Alloc(&hall->host, bytes);
    pthread_mutex_unlock(&hall->lock);
    return block;
}

static void LockedFree(void* user, void* pointer)
{
    Hall* hall = user;
    pthread_mutex_lock(&hall->lock);
    Host_Free(&hall->host, pointer);
    pthread_mutex_unlock(&hall->lock);
}

static void LockedLog(void* user, const char* line)
{
    Hall* hall = user;
    pthread_mutex_lock(&hall->lock);
    Host_Log(&hall->host, line);
    pthread_mutex_unlock(&hall->lock);
}

typedef struct Scene {
    Hall hall;
    kiriSheet sheet;
    kiriFrame frame;
} Scene;

static const kiriWorld* WorldOf(const Scene* scene)
{
    return scene->hall.host.world;
}

/* Two pieces; and on a limit work that waits. */
static void Scene_Start(Scene* scene, bool isWaiting)
{
    static const float line[4] = { -0.1f, 0.3f, 1.1f, 0.35f }, other[4] = { -0.1f, 0.7f, 1.1f, 0.6f };
    static const kiriBudget budget = { 0, 20, 0, 0 };
    memset(scene, 0, sizeof(*scene));
    Host* host = &scene->hall.host;
    pthread_mutex_init(&scene->hall.lock, NULL);
    host->failAt = -1;
    kiriWorldDef worldDef = Host_Def(host);
    worldDef.alloc = LockedAlloc;
    worldDef.free = LockedFree;
    worldDef.log = LockedLog;
    worldDef.user = &scene->hall;
    OK(kiriCreateWorld(&worldDef, &host->world));
    kiriSheetDef def = Host_SmallDef();
    scene->sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 6, 6);
    Host_Cut(host, scene->sheet, line, 2);
    OK(kiriWorld_Tick(host->world, 0.01f, 1));
    scene->frame = Host_FrameOf(host, scene->sheet, 1);
    Host_Cut(host, scene->sheet, other, 2);
    if (isWaiting) {
        OK(kiriWorld_SetBudget(host->world, &budget));
    }
    assert_int_equal(kiriWorld_Tick(host->world, 0.01f, 1), isWaiting ? KIRI_PENDING : KIRI_OK);
    assert_int_equal(kiriWorld_Tick(host->world, 0.0f, 1), KIRI_ERROR_ARGUMENT); /* a last error to keep */
}

static void Scene_Stop(Scene* scene)
{
    Host_Stop(&scene->hall.host);
    pthread_mutex_destroy(&scene->hall.lock);
}

/* ---- All functions that only read ---- */

/* The call with what it wants, or with something that it refuses. */
typedef kiriResult ReadFn(const Scene* scene, bool well);

/* A call of that name, and its variables. `sheet` is another kind of id where the call is to be refused. */
#define READER(name, call, ...)                                                                                        \
    static kiriResult name(const Scene* scene, bool well)                                                              \
    {                                                                                                                  \
        const kiriWorld* world = WorldOf(scene);                                                                       \
        const kiriSheet sheet = well ? scene->sheet : scene->frame;                                                    \
        __VA_ARGS__                                                                                                    \
        (void)sheet;                                                                                                   \
        return call;                                                                                                   \
    }

READER(ReadHash, kiriWorld_GetStateHash(world, well ? &hash : NULL), uint64_t hash;)
READER(ReadEvents, kiriWorld_GetEvents(world, &events, well ? &count : NULL), const kiriEvent* events; int32_t count;)
READER(ReadProfile, kiriWorld_GetProfile(world, well ? &profile : NULL), kiriProfile profile;)
READER(ReadMesh, kiriSheet_GetMesh(world, sheet, &mesh), kiriMesh mesh;)
READER(ReadDirty, kiriSheet_GetDirty(world, sheet, 1, &dirty), kiriDirty dirty;)
READER(ReadVertices, kiriSheet_CopyVertices(world, scene->sheet, well ? 3 : -1, 10, positions, 12, normals, 12),
       float positions[30], normals[30];)
READER(ReadIndices, kiriSheet_CopyIndices16(world, scene->sheet, 2, well ? 10 : INT32_MAX, indices),
       uint16_t indices[30];)
READER(ReadPrevious, kiriSheet_CopyPrevious(world, sheet, 3, 10, vertices, &from),
       int32_t vertices[10]; kiriSheet from;)
READER(ReadSources, kiriSheet_CopySources(world, scene->sheet, well ? 2 : -1, 10, sources), int32_t sources[10];)
READER(ReadSourceWeights, kiriSheet_CopySourceWeights(world, scene->sheet, 2, well ? 10 : INT32_MAX, weights),
       float weights[90];)
READER(ReadPoints, kiriSheet_GetCollisionPoints(world, sheet, &positions, &count),
       const float* positions; int32_t count;)
READER(ReadCounts, kiriSheet_GetCounts(world, sheet, &counts), kiriCounts counts;)
READER(ReadTotals, kiriSheet_GetTotals(world, sheet, &totals), kiriTotals totals;)
READER(ReadEstimate, kiriSheet_EstimateError(world, sheet, &relative), double relative;)
READER(ReadAwake, kiriSheet_IsAwake(world, sheet, &awake), int32_t awake;)
READER(ReadRay, kiriSheet_Raycast(world, scene->sheet, origin, down, 3.0f, &hit),
       const float origin[3] = { 0.4f, 0.5f, 1.0f }, down[3] = { 0.0f, 0.0f, well ? -1.0f : 0.0f }; kiriHit hit;)
READER(ReadRayOfAll, kiriWorld_Raycast(world, origin, down, 3.0f, &met, &hit),
       const float origin[3] = { 0.4f, 0.5f, 1.0f }, down[3] = { 0.0f, 0.0f, well ? -1.0f : 0.0f }; kiriSheet met; kiriHit hit;)
READER(ReadWeights, kiriSheet_GetWeights(world, scene->sheet, at, frames, weights, gradients, 16, &count),
       const float at[2] = { well ? 0.41f : 7.0f, 0.53f }; kiriFrame frames[16]; float weights[16], gradients[32]; int32_t count;)
READER(ReadFramePiece, kiriFrame_GetPiece(world, well ? scene->frame : scene->sheet, &piece), int32_t piece;)
READER(ReadFrames, kiriSheet_GetFrames(world, scene->sheet, frames, well ? 4 : -1, &count),
       kiriFrame frames[4]; int32_t count;)
READER(ReadState, kiriFrame_GetState(world, well ? scene->frame : 0, &state), kiriFrameState state;)

typedef struct Reader {
    const char* name;
    ReadFn* read;
} Reader;

static const Reader readers[] = {
    { "kiriWorld_GetStateHash", ReadHash },
    { "kiriWorld_GetEvents", ReadEvents },
    { "kiriWorld_GetProfile", ReadProfile },
    { "kiriSheet_GetMesh", ReadMesh },
    { "kiriSheet_GetDirty", ReadDirty },
    { "kiriSheet_CopyVertices", ReadVertices },
    { "kiriSheet_CopyIndices16", ReadIndices },
    { "kiriSheet_CopyPrevious", ReadPrevious },
    { "kiriSheet_CopySources", ReadSources },
    { "kiriSheet_CopySourceWeights", ReadSourceWeights },
    { "kiriSheet_GetCollisionPoints", ReadPoints },
    { "kiriSheet_GetCounts", ReadCounts },
    { "kiriSheet_GetTotals", ReadTotals },
    { "kiriSheet_EstimateError", ReadEstimate },
    { "kiriSheet_IsAwake", ReadAwake },
    { "kiriSheet_Raycast", ReadRay },
    { "kiriWorld_Raycast", ReadRayOfAll },
    { "kiriSheet_GetWeights", ReadWeights },
    { "kiriFrame_GetPiece", ReadFramePiece },
    { "kiriSheet_GetFrames", ReadFrames },
    { "kiriFrame_GetState", ReadState },
};

enum { READERS = sizeof(readers) / sizeof(readers[0]) };

/* ---- Tests ---- */

/* All that a reader must leave alone. */
typedef struct Bytes {
    uint64_t hash, look, snapshot;
    char lastError[256];
} Bytes;

static void TakeBytes(const Scene* scene, Bytes* bytes)
{
    const kiriWorld* world = WorldOf(scene);
    memset(bytes, 0, sizeof(*bytes));
    static uint8_t snapshot[1 << 22];
    int64_t size;
    bytes->hash = Host_Hash(&scene->hall.host);
    bytes->look = Look_World(world);
    OK(ReadRay(scene, true)); /* the snapshot has what these two leave: that the host has the arrays, and boxes */
    OK(kiriWorld_Snapshot(world, snapshot, sizeof(snapshot), &size));
    bytes->snapshot = Look_Bytes(0, snapshot, (size_t)size);
    strcpy(bytes->lastError, kiriWorld_GetLastError(world));
}

static void CheckReader(Scene* scene, const Reader* reader, bool isWaiting)
{
    Host* host = &scene->hall.host;
    Bytes before, after;
    TakeBytes(scene, &before);
    int64_t live = host->live;
    int32_t lines = host->lines;
    bool refuses = isWaiting && reader->read == ReadWeights;
    assert_int_equal(reader->read(scene, true), refuses ? KIRI_ERROR_STATE : KIRI_OK);
    assert_int_equal(host->lines, lines + refuses);
    lines = host->lines;
    assert_true(reader->read(scene, false) < 0);
    assert_int_equal(host->lines, lines + 1);
    if (strncmp(host->line, reader->name, strlen(reader->name)) != 0) {
        fail_msg("%s says \"%s\"", reader->name, host->line);
    }
    TakeBytes(scene, &after);
    if (memcmp(&before, &after, sizeof(before)) != 0) {
        fail_msg("%s changes the world", reader->name);
    }
    assert_int_equal(host->live, live);
}

TEST(NothingChanges)
{
    for (int isWaiting = 0; isWaiting < 2; ++isWaiting) {
        SCOPED(Scene, scene, Scene_Stop);
        Scene_Start(&scene, isWaiting != 0);
        assert_int_equal(strncmp(kiriWorld_GetLastError(WorldOf(&scene)), "kiriWorld_Tick:", 15), 0);
        for (int i = 0; i < READERS; ++i) {
            CheckReader(&scene, &readers[i], isWaiting != 0);
        }
    }
}

/* Weights take memory; refused, they say so, and nothing is left behind. */
TEST(WeightsWithoutMemory)
{
    SCOPED(Scene, scene, Scene_Stop);
    Bytes before, after;
    Scene_Start(&scene, false);
    Host* host = &scene.hall.host;
    int64_t live = host->live, refused = 0;
    kiriResult result;
    TakeBytes(&scene, &before);
    do {
        host->failAt = host->calls + refused;
        result = ReadWeights(&scene, true);
        host->failAt = -1;
        TakeBytes(&scene, &after);
        assert_true(memcmp(&before, &after, sizeof(before)) == 0);
        assert_int_equal(host->live, live);
        refused += result == KIRI_ERROR_MEMORY;
    } while (result == KIRI_ERROR_MEMORY);
    assert_int_equal(result, KIRI_OK);
    assert_true(refused > 0);
}

enum { ROUNDS = 60 };

typedef struct Thread {
    const Scene* scene;
    int32_t first;
    uint64_t looks; /* sum over all rounds */
    int32_t failures;
} Thread;

/* Failures are counted and asserted by the main thread. */
static void* ReadAll(void* argument)
{
    Thread* thread = argument;
    for (int32_t round = 0; round < ROUNDS; ++round) {
        for (int32_t i = 0; i < READERS; ++i) {
            const Reader* reader = &readers[(i + thread->first) % READERS];
            thread->failures += reader->read(thread->scene, true) < 0;
            thread->failures += reader->read(thread->scene, false) < 0;
        }
        thread->looks += Look_World(WorldOf(thread->scene));
    }
    return NULL;
}

TEST(TwoThreads)
{
    for (int isWaiting = 0; isWaiting < 2; ++isWaiting) {
        SCOPED(Scene, scene, Scene_Stop);
        Bytes before, after;
        pthread_t ids[2];
        Scene_Start(&scene, isWaiting != 0);
        TakeBytes(&scene, &before);
        Thread threads[2] = { { &scene, 0, 0, 0 }, { &scene, READERS / 2, 0, 0 } };
        for (int i = 0; i < 2; ++i) {
            assert_int_equal(pthread_create(&ids[i], NULL, ReadAll, &threads[i]), 0);
        }
        for (int i = 0; i < 2; ++i) {
            assert_int_equal(pthread_join(ids[i], NULL), 0);
            assert_true(threads[i].looks == ROUNDS * before.look);
            assert_int_equal(threads[i].failures, ROUNDS * (READERS + isWaiting));
        }
        TakeBytes(&scene, &after);
        assert_true(memcmp(&before, &after, sizeof(before)) == 0);
    }
}
