/* The scenes of the samples with memory that is refused: the sheets move on, cuts go on when there is memory, and what
   cuts leave in the end is as if nothing had been refused. With an argument (`make scarce`) each request of each tick of all scenes is refused once, or of the scene that a second
   argument names; else some of them, of some scenes. */
#include "host.h"
#include "layout_hash.h"

#include "../samples/scene.h"

/* malloc of the whole program is refused too, where the C library lets us stand in front of it: that of Eigen. */
#if REPLACES_MALLOC
extern void* __libc_malloc(size_t bytes);
extern void __libc_free(void* pointer);
#define TAKE(bytes) __libc_malloc(bytes)
#define GIVE_BACK(pointer) __libc_free(pointer)
#else
#define TAKE(bytes) malloc(bytes)
#define GIVE_BACK(pointer) free(pointer)
#endif

enum { MOST_REQUESTS = 1 << 16 };

/* A request for memory within a tick. Those of others than the hooks count their bytes below zero. */
typedef struct Request {
    int64_t bytes;
    bool isKept; /* its block outlives the tick: so it is not made again */
} Request;

/* Before each block of the hooks; 16 bytes, so that the block is aligned. */
typedef struct ScarceBlock {
    int64_t tick; /* that asked for it, by count */
    int64_t request;
} ScarceBlock;

typedef struct Scarcity {
    bool isArmed;      /* the tick has begun */
    int64_t left;      /* requests until one is refused; negative: none */
    int64_t live;      /* blocks of the hooks that are out */
    int64_t refused;   /* of the hooks, */
    int64_t refusedOf; /* and of others */
    int poison;        /* what blocks have that nobody has written: another one where memory is refused */

    /* Where all are refused: the requests of the tick at hand, and those that were granted or refused before. */
    int64_t tick, known, matched;
    int32_t count;
} Scarcity;

static Scarcity scarcity;
static bool refusesAll;
static const char* onlyScene; /* or null */
static Request requests[MOST_REQUESTS];
static int64_t knownRequests[MOST_REQUESTS];

/* Requests come in one order each time, but for those whose blocks are there already. The first that is none of those
   that came before is refused. */
static bool IsUnknown(int64_t bytes)
{
    while (scarcity.matched < scarcity.known && knownRequests[scarcity.matched] != bytes) {
        scarcity.matched += 1;
    }
    scarcity.matched += 1;
    return scarcity.matched > scarcity.known;
}

static bool IsRefused(int64_t bytes)
{
    if (!scarcity.isArmed || scarcity.left < 0) {
        return false;
    }
    if (!refusesAll) {
        return scarcity.left-- == 0;
    }
    bool isRefused = IsUnknown(bytes);
    if (scarcity.count < MOST_REQUESTS) {
        requests[scarcity.count++] = (Request){ bytes, !isRefused && bytes >= 0 };
    }
    scarcity.left = isRefused ? -1 : scarcity.left;
    return isRefused;
}

#if REPLACES_MALLOC
void* malloc(size_t bytes)
{
    if (IsRefused(-1 - (int64_t)bytes)) {
        scarcity.refusedOf += 1;
        return NULL;
    }
    return TAKE(bytes);
}
#endif

static void* ScarceAlloc(void* user, int64_t bytes)
{
    if (IsRefused(bytes)) {
        scarcity.refused += 1;
        return NULL;
    }
    ScarceBlock* block = TAKE(sizeof(ScarceBlock) + (size_t)bytes);
    scarcity.live += 1;
    block->tick = scarcity.tick;
    block->request = scarcity.isArmed && scarcity.left >= 0 ? scarcity.count - 1 : -1;
    return memset(block + 1, scarcity.poison, (size_t)bytes);
}

static void ScarceFree(void* user, void* pointer)
{
    if (pointer == NULL) {
        return;
    }
    ScarceBlock* block = (ScarceBlock*)pointer - 1;
    if (block->tick == scarcity.tick && block->request >= 0) {
        requests[block->request].isKept = false;
    }
    scarcity.live -= 1;
    GIVE_BACK(block);
}

/* The first thing that a tick does is to look at the clock: what the scene does before it gets its memory. */
static double Arm(void* user)
{
    scarcity.isArmed = scarcity.left >= 0;
    return 0.0;
}

static kiriResult Try(Scene* scene, bool isAgain, int64_t left)
{
    scarcity.left = left;
    kiriResult result = isAgain ? kiriWorld_Tick(scene->world, 1.0f / 60.0f, scene->type->substeps) : Scene_Tick(scene);
    scarcity.isArmed = false;
    scarcity.left = -1;
    return result;
}

static void CheckWorld(const Scene* scene)
{
    const char* wrong = Validate_World(scene->world);
    if (wrong != NULL) {
        fail_msg("%s, tick %d: %s", scene->type->name, (int)scene->tick, wrong);
    }
}

static void CheckTick(const Scene* scene, kiriResult result)
{
    if (result < 0) {
        fail_msg("%s, tick %d: %s", scene->type->name, (int)scene->tick, kiriGetResultName(result));
    }
}

/* Some of what it asks for is refused, until it goes through. */
static void TickPoorly(Scene* scene, uint32_t* seed)
{
    int64_t left = Random(seed) % 4;
    kiriResult result = Try(scene, false, left);
    for (int32_t tries = 0; result == KIRI_ERROR_MEMORY; ++tries) {
        if (!IS_SANITIZED || (scene->tick + tries) % 7 == 0) {
            CheckWorld(scene);
        }
        left += 1 + Random(seed) % 12;
        result = Try(scene, true, left);
    }
    CheckTick(scene, result);
}

/* A world that was loaded has little room: its tick asks for ten times as much. */
static void TakeRoomAway(Scene* scene)
{
    int64_t size;
    OK(kiriWorld_Save(scene->world, NULL, 0, &size));
    void* bytes = TAKE((size_t)size);
    assert_non_null(bytes);
    OK(kiriWorld_Save(scene->world, bytes, size, &size));
    OK(kiriWorld_Load(scene->world, bytes, size));
    GIVE_BACK(bytes);
}

/* What the next try will ask for again. */
static void RememberRequests(void)
{
    scarcity.known = 0;
    for (int32_t i = 0; i < scarcity.count; ++i) {
        if (!requests[i].isKept) {
            knownRequests[scarcity.known++] = requests[i].bytes;
        }
    }
}

static kiriResult TryNext(Scene* scene, bool isAgain)
{
    scarcity.tick += 1;
    scarcity.matched = scarcity.count = 0;
    return Try(scene, isAgain, 0);
}

/* Each request is refused once: the first, then the next after it, and so on until a tick goes through. */
static void RefuseEach(Scene* scene)
{
    enum { EVERY = 16, ROOMLESS = 32, MOST_TRIES = 4000 };
    scarcity.known = 0;
    kiriResult result = TryNext(scene, false);
    if (result == KIRI_ERROR_MEMORY && scene->tick % ROOMLESS == 0 && kiriWorld_FinishCuts(scene->world) == KIRI_OK) {
        TakeRoomAway(scene);
    }
    for (int32_t tries = 0; result == KIRI_ERROR_MEMORY; ++tries) {
        if (tries % EVERY == 0) {
            CheckWorld(scene);
        }
        if (tries > MOST_TRIES) {
            fail_msg("%s, tick %d: requests have no end", scene->type->name, (int)scene->tick);
        }
        result = TryNext(scene, true);
        RememberRequests();
    }
    CheckTick(scene, result);
}

static uint64_t LayoutOf(const Scene* scene)
{
    OK(kiriWorld_FinishCuts(scene->world));
    CheckWorld(scene);
    return Layout_HashAll(scene->world);
}

static uint64_t Run(const SceneType* type, bool isPoor)
{
    Scene scene;
    uint32_t seed = 2463534242u;
    kiriWorldDef def = DefaultWorld();
    def.alloc = ScarceAlloc;
    def.free = ScarceFree;
    def.clock = Arm;
    memset(&scarcity, 0, sizeof(scarcity));
    scarcity.poison = isPoor ? 0x5a : 0xcd;
    scarcity.left = -1;
    assert_true(Scene_Start(&scene, type, &def, &(SceneOptions){ .plain = false }));
    for (int32_t i = 0; i < type->lastCut + 10; ++i) {
        if (isPoor && refusesAll) {
            RefuseEach(&scene);
        } else if (isPoor) {
            TickPoorly(&scene, &seed);
        } else {
            CheckTick(&scene, Try(&scene, false, -1));
        }
    }
    uint64_t layout = LayoutOf(&scene);
    Scene_Stop(&scene);
    assert_int_equal(scarcity.live, 0);
    return layout;
}

/* Once with all the memory there is, and once without. Blades in world space cut where sheets are: that is elsewhere
   after a refusal. */
static void RunBoth(const SceneType* type)
{
    uint64_t rich = Run(type, false), poor = Run(type, true);
    print_message("%s: %d requests refused, %d more of others than the hooks\n", type->name, (int)scarcity.refused,
                  (int)scarcity.refusedOf);
    assert_true(scarcity.refused > 20);
    if (rich != poor) {
        fail_msg("%s: cuts leave something else", type->name);
    }
}

static bool IsMeant(const char* name)
{
    static const char* const some[] = { "bunny", "flat", "rubber", "fallingguy" };
    bool isSome = false;
    for (int i = 0; i < RUNS(4); ++i) {
        isSome = isSome || strcmp(name, some[i]) == 0;
    }
    return onlyScene != NULL ? strcmp(name, onlyScene) == 0 : refusesAll || isSome;
}

TEST(Scenes)
{
    for (int32_t i = 0; Scene_GetType(i) != NULL; ++i) {
        if (IsMeant(Scene_GetType(i)->name)) {
            RunBoth(Scene_GetType(i));
        }
    }
}

SETUP
{
    refusesAll = count > 1;
    onlyScene = count > 2 ? words[2] : NULL;
}
