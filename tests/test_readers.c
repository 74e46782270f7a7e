/* Reading a world changes nothing: neither its bytes nor its last error, whether the call goes through or fails; so any
   number of threads may read at the same time. */
#define _POSIX_C_SOURCE 200809L

#include "every_call.h"
#include "look.h"

#include <pthread.h>

/* ---- A host that several threads may call ---- */

static pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;

static void* LockedAlloc(void* user, int64_t bytes)
{
    pthread_mutex_lock(&lock);
    void* block = Host_Alloc(user, bytes);
    pthread_mutex_unlock(&lock);
    return block;
}

static void LockedFree(void* user, void* pointer)
{
    pthread_mutex_lock(&lock);
    Host_Free(user, pointer);
    pthread_mutex_unlock(&lock);
}

static void LockedLog(void* user, const char* line)
{
    pthread_mutex_lock(&lock);
    Host_Log(user, line);
    pthread_mutex_unlock(&lock);
}

/* isWaiting: a limit makes work wait. */
static void Start(Stand* s, bool isWaiting)
{
    static const float line[4] = { -0.1f, 0.7f, 1.1f, 0.6f };
    static const kiriBudget budget = { 0, 20, 0, 0 };
    kiriWorldDef def = Tape_Def(&s->tape);
    def.alloc = LockedAlloc;
    def.free = LockedFree;
    def.log = LockedLog;
    def.record = NULL;
    Stand_StartBy(s, &def);
    Host* host = &s->tape.host;
    Host_Cut(host, s->given.sheet, line, 2);
    if (isWaiting) {
        OK(kiriWorld_SetBudget(host->world, &budget));
    }
    assert_int_equal(kiriWorld_Tick(host->world, 0.01f, 1), isWaiting ? KIRI_PENDING : KIRI_OK);
    assert_int_equal(kiriWorld_Tick(host->world, 0.0f, 1), KIRI_ERROR_ARGUMENT); /* a last error to keep */
}

/* ---- Tests ---- */

/* All that a reader must leave alone. */
typedef struct Picture {
    uint64_t hash, look, snapshot;
    char lastError[256];
} Picture;

static Picture Take(Stand* s)
{
    kiriWorld* world = s->tape.host.world;
    Picture picture;
    memset(&picture, 0, sizeof(picture));
    picture.hash = Host_Hash(&s->tape.host);
    picture.look = Look_World(world);
    /* The snapshot has what these two leave: that the host has the arrays, and boxes. */
    OK(Stand_Make(s, EveryCall_Find("kiriWorld_Raycast")));
    SCOPED_AS(Bytes, snapshot, Bytes_Free) = World_Write(world, kiriWorld_Snapshot);
    picture.snapshot = Look_Bytes(0, snapshot.data, (size_t)snapshot.size);
    strcpy(picture.lastError, kiriWorld_GetLastError(world));
    return picture;
}

/* Calls with valid arguments, then with none: *failures counts how often it failed. */
static void Read(const EveryCall* call, kiriWorld* world, const Given* given, int32_t* failures)
{
    static const Given none;
    *failures += call->make(world, given) < 0;
    *failures += call->make(world, &none) < 0;
}

TEST(NothingChanges)
{
    for (int isWaiting = 0; isWaiting < 2; ++isWaiting) {
        SCOPED(Stand, s, Stand_Stop);
        Start(&s, isWaiting != 0);
        Host* host = &s.tape.host;
        assert_int_equal(strncmp(kiriWorld_GetLastError(host->world), "kiriWorld_Tick:", 15), 0);
        for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; ++call) {
            if (call->changes) {
                continue;
            }
            Picture before = Take(&s);
            int64_t live = host->live;
            int32_t lines = host->lines, failures = 0;
            Read(call, host->world, &s.given, &failures);
            assert_in_range(failures, 1, 1 + isWaiting);
            assert_int_equal(host->lines, lines + failures);
            if (strncmp(host->line, call->name, strlen(call->name)) != 0) {
                fail_msg("%s says \"%s\"", call->name, host->line);
            }
            Picture after = Take(&s);
            if (memcmp(&before, &after, sizeof(before)) != 0 || host->live != live) {
                fail_msg("%s changes the world", call->name);
            }
        }
    }
}

enum { ROUNDS = 60 };

typedef struct Thread {
    Stand stand; /* a copy, for its results */
    int32_t first;
    uint64_t looks; /* sum over all rounds */
    int32_t failures;
} Thread;

/* Failures are counted and asserted by the main thread. */
static void* ReadAll(void* argument)
{
    Thread* thread = argument;
    Stand* own = &thread->stand;
    kiriWorld* world = own->tape.host.world;
    own->given.id = &own->ids[8];
    own->given.ids = own->ids;
    own->given.count = &own->count;
    own->given.out = own->given.spare = own->out;
    own->given.more = own->out + 32;
    for (int32_t round = 0; round < ROUNDS; ++round) {
        for (int32_t i = 0; i < everyCallCount; ++i) {
            const EveryCall* call = &everyCall[(i + thread->first) % everyCallCount];
            if (!call->changes) {
                Read(call, world, &own->given, &thread->failures);
            }
        }
        thread->looks += Look_World(world);
    }
    return NULL;
}

TEST(TwoThreads)
{
    for (int isWaiting = 0; isWaiting < 2; ++isWaiting) {
        SCOPED(Stand, s, Stand_Stop);
        pthread_t ids[2];
        Start(&s, isWaiting != 0);
        Picture before = Take(&s);
        int32_t failures = 0; /* of a round */
        for (const EveryCall* call = everyCall; call < everyCall + everyCallCount; ++call) {
            if (!call->changes) {
                Read(call, s.tape.host.world, &s.given, &failures);
            }
        }
        Thread threads[2] = { { s, 0, 0, 0 }, { s, everyCallCount / 2, 0, 0 } };
        for (int i = 0; i < 2; ++i) {
            assert_int_equal(pthread_create(&ids[i], NULL, ReadAll, &threads[i]), 0);
        }
        for (int i = 0; i < 2; ++i) {
            assert_int_equal(pthread_join(ids[i], NULL), 0);
            assert_true(threads[i].looks == ROUNDS * before.look);
            assert_int_equal(threads[i].failures, ROUNDS * failures);
        }
        Picture after = Take(&s);
        assert_true(memcmp(&before, &after, sizeof(before)) == 0);
    }
}
