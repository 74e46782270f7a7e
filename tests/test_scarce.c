/* The scenes of the samples with memory that is refused: in each tick the first request, then the next one, and so on until
   the tick goes through; then all has to be as if nothing had been refused. With an argument (`make scarce`) all requests
   of all scenes are refused once, else some of them, of some scenes. */
#include "host.h"

#include "../samples/scene.h"

/* malloc of the whole program is refused too, where the C library lets us stand in front of it: that of Eigen. */
#if defined(__has_feature)
#if __has_feature(address_sanitizer)
#define IS_SANITIZED 1
#endif
#endif
#if defined(__GLIBC__) && !defined(__SANITIZE_ADDRESS__) && !defined(IS_SANITIZED)
#define REFUSES_MALLOC 1
extern void* __libc_malloc(size_t bytes);
extern void __libc_free(void* pointer);
#define TAKE(bytes) __libc_malloc(bytes)
#define GIVE_BACK(pointer) __libc_free(pointer)
#else
#define REFUSES_MALLOC 0
#define TAKE(bytes) malloc(bytes)
#define GIVE_BACK(pointer) free(pointer)
#endif

typedef struct Scarcity {
    bool isArmed;      /* the tick has begun */
    int64_t left;      /* requests until one is refused; negative: none */
    int64_t live;      /* blocks of the hooks that are out */
    int64_t refused;   /* of the hooks, */
    int64_t refusedOf; /* and of others */
} Scarcity;

static Scarcity scarcity;
static bool refusesAll;

static bool IsRefused(void)
{
    return scarcity.isArmed && scarcity.left >= 0 && scarcity.left-- == 0;
}

#if REFUSES_MALLOC
void* malloc(size_t bytes)
{
    if (IsRefused()) {
        scarcity.refusedOf += 1;
        return NULL;
    }
    return TAKE(bytes);
}
#endif

static void* ScarceAlloc(void* user, int64_t bytes)
{
    (void)user;
    if (IsRefused()) {
        scarcity.refused += 1;
        return NULL;
    }
    scarcity.live += 1;
    return TAKE((size_t)bytes);
}

static void ScarceFree(void* user, void* pointer)
{
    (void)user;
    scarcity.live -= pointer != NULL;
    GIVE_BACK(pointer);
}

/* The first thing that a tick does is to look at the clock: what the scene does before it gets its memory. */
static double Arm(void* user)
{
    (void)user;
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

/* All that it asks for, or some of it, is refused once. */
static void TickPoorly(Scene* scene, uint32_t* seed)
{
    int64_t left = refusesAll ? 0 : Random(seed) % 4;
    bool isAgain = false;
    kiriResult result;
    while ((result = Try(scene, isAgain, left)) == KIRI_ERROR_MEMORY) {
        const char* wrong = Validate_World(scene->world);
        if (wrong != NULL) {
            fail_msg("%s, tick %d: %s", scene->type->name, (int)scene->tick, wrong);
        }
        isAgain = true;
        left += refusesAll ? 1 : 1 + Random(seed) % 12;
    }
    if (result < 0) {
        fail_msg("%s, tick %d: %s", scene->type->name, (int)scene->tick, kiriGetResultName(result));
    }
}

static uint64_t Run(const SceneType* type, bool isPoor)
{
    kiriWorldDef def;
    Scene scene;
    uint32_t seed = 2463534242u;
    uint64_t hash = 0;
    kiriDefaultWorldDef(&def);
    def.alloc = ScarceAlloc;
    def.free = ScarceFree;
    def.clock = Arm;
    scarcity.left = -1;
    assert_true(Scene_Start(&scene, type, &def, &(SceneOptions){ .plain = false }));
    int32_t ticks = type->lastCut + 10;
    for (int32_t i = 0; i < ticks; ++i) {
        if (isPoor) {
            TickPoorly(&scene, &seed);
        } else {
            assert_true(Try(&scene, false, -1) >= 0);
        }
    }
    OK(kiriWorld_GetStateHash(scene.world, &hash));
    Scene_Stop(&scene);
    assert_int_equal(scarcity.live, 0);
    return hash;
}

static void TestScenes(void** state)
{
    (void)state;
    for (int32_t i = 0; Scene_GetType(i) != NULL; ++i) {
        const char* name = Scene_GetType(i)->name;
        if (!refusesAll && strcmp(name, "bunny") != 0 && strcmp(name, "flat") != 0) {
            continue;
        }
        memset(&scarcity, 0, sizeof(scarcity));
        uint64_t poor = Run(Scene_GetType(i), true), rich = Run(Scene_GetType(i), false);
        print_message("%s: %d requests refused, %d more of others than the hooks\n", name, (int)scarcity.refused,
                      (int)scarcity.refusedOf);
        assert_true(scarcity.refused > 20);
        if (poor != rich) {
            fail_msg("%s ends in another state", name);
        }
    }
}

int main(int count, char** arguments)
{
    (void)arguments;
    const struct CMUnitTest tests[] = { cmocka_unit_test(TestScenes) };
    refusesAll = count > 1;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
