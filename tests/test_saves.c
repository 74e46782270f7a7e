/* What kiriWorld_Save has written is loaded, whatever state the world is in, and comes out the same: the checks of
   kiriWorld_Load and kiriWorld_LoadUntrusted ask for nothing that an honest save may lack. Random worlds, at random
   ticks: cuts at work on small budgets, pieces that are taken out, calls and ticks that were refused memory, sheets
   that diverged or sleep, blades.

   test_saves [WORLDS [FIRST]]    so many worlds, from this one on */
#include "host.h"
#include "storm.h"

#include "sheet/kiri_update.h"
#include "world/kiri_world.h"

enum { WORLDS = 24, MOST_TICKS = 24 };

static int32_t worldCount = WORLDS, firstWorld = 0;

static uint32_t Below(uint32_t* seed, uint32_t end)
{
    return (Random(seed) >> 8) % end;
}

/* None, tight in one thing, or in all. */
static kiriBudget AnyBudget(uint32_t* seed)
{
    static const int32_t least[] = { 64, 1, 1, 1 };
    kiriBudget budget = { 0, 0, 0, 0 };
    int32_t* limits[] = { &budget.triangles, &budget.cells, &budget.samples, &budget.iterations };
    uint32_t kind = Below(seed, 6);
    for (int k = 0; k < 4; ++k) {
        bool isLimited = kind < 3 || (uint32_t)k + 3 == kind;
        *limits[k] =
            isLimited && (k < 3 || kind == 0) ? least[k] + (int32_t)Below(seed, 1u << (3 + Below(seed, 7))) : 0;
    }
    return budget;
}

typedef struct Weather {
    Storm storm;
    Host host;
    uint32_t seed;
    const char* last; /* what was done before the save */
    int32_t world, tick;
} Weather;

static void StartWeather(Weather* weather, int32_t world)
{
    weather->world = world;
    weather->seed = 2654435761u * (uint32_t)(world + 1);
    Host_Start(&weather->host);
    kiriDestroyWorld(weather->host.world);
    kiriWorldDef def = Host_Def(&weather->host);
    OK(Storm_Start(&weather->storm, (int32_t)Below(&weather->seed, STORM_TYPES), &def));
    weather->storm.seed = Random(&weather->seed);
    weather->host.world = weather->storm.world;
    kiriBudget budget = AnyBudget(&weather->seed);
    OK(kiriWorld_SetBudget(weather->storm.world, &budget));
}

/* So fast that the next tick cannot follow it. */
static void Diverge(Weather* weather)
{
    const float velocity[3] = { 1e30f, 1e30f, 0.0f }, spin[3] = { 0.0f, 0.0f, 1e6f };
    kiriSheet_SetVelocity(weather->storm.world, Storm_AnySheet(&weather->storm), velocity, spin);
}

static void GoOn(Weather* weather)
{
    uint32_t kind = Below(&weather->seed, 16);
    int32_t substeps = 1 + (int32_t)Below(&weather->seed, 3);
    weather->last = "a tick";
    if (kind == 0) {
        weather->last = "a tick that may diverge";
        Diverge(weather);
    } else if (kind <= 3) {
        weather->last = "calls, and a tick that may be refused memory";
        weather->host.failOnce = Below(&weather->seed, 2) == 0;
        weather->host.failAt = weather->host.calls + Below(&weather->seed, 1u << Below(&weather->seed, 11));
    } else if (kind <= 5) {
        weather->last = "a tick without a call";
        kiriWorld_Tick(weather->storm.world, 1.0f / 60.0f, substeps);
        return;
    } else if (kind == 6) {
        weather->last = "calls without a tick";
        Storm_Act(&weather->storm);
        Storm_Act(&weather->storm);
        return;
    }
    Storm_Tick(&weather->storm);
    weather->host.failAt = -1;
}

/* Does the state hash tell what kiriWorld_LoadUntrusted does? Work at hand begins again, and grids that are to be made
   from scratch are. */
static bool IsWorkAtHand(const kiriWorld* world)
{
    bool isAtHand = false;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriUpdate* u = world->sheets.data[i]->update;
        isAtHand |= u->needsRebuild || u->stage > KIRI_STAGE_CUT || (u->stage == KIRI_STAGE_CUT && u->cut.meshChanged);
    }
    return isAtHand;
}

/* By a world that has had others. */
static bool IsLoadedBy(Host* other, const Host* host)
{
    int64_t size = 0;
    OK(kiriWorld_Save(host->world, NULL, 0, &size));
    uint8_t* bytes = malloc((size_t)size);
    OK(kiriWorld_Save(host->world, bytes, size, &size));
    bool isLoaded = kiriWorld_LoadUntrusted(other->world, bytes, size) == KIRI_OK &&
                    (IsWorkAtHand(host->world) || Host_Hash(other) == Host_Hash(host));
    isLoaded = isLoaded && kiriWorld_Load(other->world, bytes, size) == KIRI_OK && Host_Hash(other) == Host_Hash(host);
    free(bytes);
    return isLoaded;
}

static void CheckLoads(const Weather* weather, Host* other)
{
    if (!IsLoadedBy(other, &weather->host)) {
        fail_msg("world %d (%s), tick %d, after %s: a save is not loaded: %s", (int)weather->world,
                 weather->storm.type->name, (int)weather->tick, weather->last, kiriWorld_GetLastError(other->world));
    }
}

static void PlayWorld(int32_t world)
{
    static Weather weather;
    Host other;
    StartWeather(&weather, world);
    Host_Start(&other);
    int32_t ticks = 4 + (int32_t)Below(&weather.seed, MOST_TICKS);
    for (weather.tick = 0; weather.tick < ticks; ++weather.tick) {
        CheckLoads(&weather, &other);
        GoOn(&weather);
    }
    CheckLoads(&weather, &other);
    Host_Destroy(&other);
    Host_Destroy(&weather.host);
}

static void TestHonestSavesLoad(void** state)
{
    (void)state;
    for (int32_t k = 0; k < worldCount; ++k) {
        PlayWorld(firstWorld + k);
    }
}

/* A save of one of these was refused once, or would have been; 16011 freed memory in a task. */
static void TestWorldsThatWereRefused(void** state)
{
    (void)state;
    static const int32_t worlds[] = { 10,   63,    107,   1307,  1404,  2233,  2375, 6607,
                                      9226, 14440, 14606, 16011, 17095, 17599, 22202 };
    for (size_t k = 0; k < sizeof(worlds) / sizeof(worlds[0]); ++k) {
        PlayWorld(worlds[k]);
    }
}

/* Many triangles on a side of a square: its faces are caught half way. */
static void TestLargeSquares(void** state)
{
    (void)state;
    enum { TRIANGLES = 32, TICKS = 60 };
    const float line[] = { 0.1f, 0.3f, 0.9f, 0.6f };
    const kiriBudget budget = { 0, 1, 0, 0 };
    Host host, other;
    Host_Start(&host);
    Host_Start(&other);
    OK(kiriWorld_SetBudget(host.world, &budget));
    kiriSheetDef def = Host_SmallDef();
    def.gridResolution = 2;
    def.frameCount = 2;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, TRIANGLES, TRIANGLES);
    Host_Cut(&host, sheet, line, 2);
    for (int32_t tick = 0; tick < TICKS; ++tick) {
        assert_true(kiriWorld_Tick(host.world, 1.0f / 60.0f, 1) >= KIRI_OK);
        assert_true(IsLoadedBy(&other, &host));
    }
    Host_Destroy(&host);
    Host_Destroy(&other);
}

int main(int count, char** arguments)
{
    worldCount = count > 1 ? atoi(arguments[1]) : WORLDS;
    firstWorld = count > 2 ? atoi(arguments[2]) : 0;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestWorldsThatWereRefused),
        cmocka_unit_test(TestLargeSquares),
        cmocka_unit_test(TestHonestSavesLoad),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
