/* Twins: a world that was saved and loaded, or whose snapshot was restored, goes on as the one that was not: in each of
   the coming ticks, with the same calls, it has the same state, shows the same and returns the same. Random worlds, at
   random ticks: cuts at work on small budgets, pieces that are taken out, calls and ticks that were refused memory,
   sheets that diverged or sleep, blades.

   test_saves [WORLDS [FIRST]]    so many worlds, from this one on */
#include "fuzz_saved.h"
#include "host.h"
#include "layout_hash.h"

enum { WORLDS = RUNS(24), MOST_TICKS = 24, TWIN_TICKS = 5 };

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

/* ---- Twins ---- */

typedef kiriResult ReadFn(kiriWorld* world, const void* bytes, int64_t size);

static bool IsWorkAtHand(const kiriWorld* world)
{
    kiriSheet sheets[64];
    int32_t count;
    bool isAtHand = false;
    OK(kiriWorld_GetSheets(world, sheets, 64, &count));
    for (int32_t i = 0; i < count && i < 64; ++i) {
        isAtHand |= Layout_Stage(world, sheets[i]) >= 0;
    }
    return isAtHand;
}

static void AssertAlike(const Weather* weather, const char* how, Storm* a, Storm* b, int32_t later)
{
    uint64_t one = 0, other = 0;
    OK(kiriWorld_GetStateHash(a->world, &one));
    OK(kiriWorld_GetStateHash(b->world, &other));
    bool isSeen = Storm_HashSeen(a) == Storm_HashSeen(b);
    if (one != other || !isSeen || a->results != b->results) {
        fail_msg("world %d (%s), %s in tick %d after %s, %d ticks later: state %d, seen %d, results %d",
                 (int)weather->world, weather->storm.type->name, how, (int)weather->tick, weather->last, (int)later,
                 one != other, !isSeen, a->results != b->results);
    }
}

/* After a load arrays have other rooms, and a budget pays for room: a cut may take effect in another tick. */
static bool MayDiffer(const kiriWorld* a, const kiriWorld* b)
{
    return IsWorkAtHand(a) || IsWorkAtHand(b); /* without a budget no tick leaves work */
}

/* The world goes back to the snapshot afterwards. */
static void CheckTwin(const Weather* weather, Host* other, const char* how, WriteFn* write, ReadFn* read)
{
    Storm a = weather->storm, b = weather->storm;
    SCOPED_AS(Bytes, start, Bytes_Free) = World_Write(a.world, kiriWorld_Snapshot);
    SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(a.world, write);
    b.world = other->world;
    if (read(b.world, bytes.data, bytes.size) != KIRI_OK) {
        fail_msg("world %d (%s), tick %d, after %s: %s", (int)weather->world, weather->storm.type->name,
                 (int)weather->tick, weather->last, kiriWorld_GetLastError(b.world));
    }
    AssertAlike(weather, how, &a, &b, 0);
    for (int32_t later = 1; later <= TWIN_TICKS; ++later) {
        Storm_Tick(&a);
        Storm_Tick(&b);
        if (write == kiriWorld_Save && MayDiffer(a.world, b.world)) {
            break;
        }
        AssertAlike(weather, how, &a, &b, later);
    }
    OK(kiriWorld_Restore(a.world, start.data, start.size));
}

static void CheckTwins(const Weather* weather, Host* other)
{
    const kiriBudget unlimited = { 0 };
    kiriWorld* world = weather->host.world;
    CheckTwin(weather, other, "restored", kiriWorld_Snapshot, kiriWorld_Restore);
    int64_t size = 0;
    bool isAtHand = IsWorkAtHand(world);
    assert_int_equal(kiriWorld_Save(world, NULL, 0, &size), isAtHand ? KIRI_PENDING : KIRI_OK);
    SCOPED_AS(Bytes, start, Bytes_Free) = World_Write(world, kiriWorld_Snapshot);
    if (isAtHand) {
        OK(kiriWorld_FinishCuts(world));
        assert_false(IsWorkAtHand(world));
    }
    if (weather->tick % 2 == 0) {
        OK(kiriWorld_SetBudget(world, &unlimited));
    }
    CheckTwin(weather, other, "loaded", kiriWorld_Save, kiriWorld_Load);
    OK(kiriWorld_Restore(world, start.data, start.size));
}

static void PlayWorld(int32_t world)
{
    static Weather weather;
    StartWeather(&weather, world);
    START_HOST(other);
    int32_t ticks = 4 + (int32_t)Below(&weather.seed, MOST_TICKS);
    for (weather.tick = 0; weather.tick < ticks; ++weather.tick) {
        if (Below(&weather.seed, 3) == 0) {
            CheckTwins(&weather, &other);
        }
        GoOn(&weather);
    }
    CheckTwins(&weather, &other);
    Host_Destroy(&other);
    Host_Destroy(&weather.host);
}

TEST(TwinsAgree)
{
    for (int32_t k = 0; k < worldCount; ++k) {
        PlayWorld(firstWorld + k);
    }
}

/* Triangles that are large for the grid. */
TEST(OddMeshes)
{
    static Weather weather;
    for (int32_t world = SAVED_LARGE; world < SAVED_WORLDS; ++world) {
        const Saved* saved = Saved_Get(world);
        Host_Start(&weather.host);
        START_HOST(other);
        OK(kiriWorld_Load(weather.host.world, saved->later.bytes, saved->later.size));
        weather.storm = saved->storm;
        weather.storm.world = weather.host.world;
        weather.world = world;
        weather.last = "a load";
        CheckTwins(&weather, &other);
        Host_Destroy(&other);
        Host_Destroy(&weather.host);
    }
}

/* ---- Work that is finished --------------------------------------------------------------------------------------- */

static void StartCut(Host* host, const kiriBudget* budget)
{
    static const float around[] = { 0.2f, 0.5f, 0.8f, 0.5f, 0.8f, 0.9f, 0.4f, 0.9f, 0.4f, 0.2f, 0.9f, 0.2f };
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    def.collisionPoints = 20;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(host, sheet, around, 6);
    OK(kiriWorld_SetBudget(host->world, budget));
}

/* In whatever step a tick has left the work, and where memory is refused first: the cut does the same. */
TEST(FinishedCuts)
{
    const kiriBudget little = { 64, 5, 3, 0 }, unlimited = { 0 };
    Host host, whole;
    StartCut(&whole, &unlimited);
    OK(Host_Tick(&whole, 0.01f, 1));
    StartCut(&host, &little);
    int32_t refused = 0;
    for (int32_t tick = 0; Host_Tick(&host, 0.01f, 1) == KIRI_PENDING; ++tick) {
        Bytes snapshot = World_Write(host.world, kiriWorld_Snapshot);
        for (int64_t n = 0; n < 3; ++n) {
            host.failAt = n > 0 ? host.calls + tick % 7 + n : -1;
            host.failOnce = true;
            kiriResult result = kiriWorld_FinishCuts(host.world);
            host.failAt = -1;
            assert_true(result == KIRI_OK || (n > 0 && result == KIRI_ERROR_MEMORY));
            refused += result != KIRI_OK;
            OK(kiriWorld_FinishCuts(host.world));
            Host_Validate(&host);
            uint64_t layout = Layout_HashInForce(host.world, Host_SheetAt(&host, 0));
            assert_true(layout == Layout_HashInForce(whole.world, Host_SheetAt(&whole, 0)));
            OK(kiriWorld_Restore(host.world, snapshot.data, snapshot.size));
        }
        free(snapshot.data);
    }
    assert_true(refused > 10);
    Host_Destroy(&host);
    Host_Destroy(&whole);
}

/* ---- Bytes that are none ----------------------------------------------------------------------------------------- */

/* A small world with a bit of everything: a cut that waits, pins, an obstacle, a blade. */
static void StartSmall(Host* host)
{
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    def.gridResolution = 6;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 3, 3);
    const float points[4] = { -0.1f, 0.4f, 1.1f, 0.6f };
    Host_Pin(host, sheet, 0.0f, 0.0f, 0.0f, 0.0f, 0.0f);
    kiriObstacleDef obstacleDef = ObstacleOf(KIRI_OBSTACLE_BOX);
    obstacleDef.size[0] = obstacleDef.size[1] = obstacleDef.size[2] = 0.2f;
    kiriObstacle obstacle;
    assert_int_equal(kiriCreateObstacle(host->world, &obstacleDef, &obstacle), KIRI_OK);
    Host_Cut(host, sheet, points, 2);
    Host_Tick(host, 1.0f / 60.0f, 1);
    Host_Cut(host, sheet, points, 2);
}

static void AssertRefused(Host* host, const uint8_t* bytes, int64_t size, uint64_t hash)
{
    assert_int_equal(kiriWorld_Load(host->world, bytes, size), KIRI_ERROR_DATA);
    assert_true(host->line[0] != 0);
    assert_int_equal(Host_Hash(host), hash);
}

TEST(BytesCutShort)
{
    HOST(host);
    StartSmall(&host);
    SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(host.world, kiriWorld_Save);
    uint64_t hash = Host_Hash(&host);
    for (int64_t size = 0; size < bytes.size; ++size) {
        uint8_t* part = malloc((size_t)size + 1); /* so that a sanitizer sees who reads beyond */
        memcpy(part + 1, bytes.data, (size_t)size);
        assert_int_equal(kiriWorld_Load(host.world, part + 1, size), KIRI_ERROR_DATA);
        free(part);
    }
    assert_int_equal(Host_Hash(&host), hash);
    assert_int_equal(kiriWorld_Load(host.world, bytes.data, bytes.size), KIRI_OK);
}

TEST(BitsThatChange)
{
    HOST(host);
    StartSmall(&host);
    SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(host.world, kiriWorld_Save);
    uint64_t hash = Host_Hash(&host);
    for (int64_t bit = 0; bit < 8 * bytes.size; bit += bit < 8 * 256 ? 1 : 61) {
        bytes.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
        assert_int_equal(kiriWorld_Load(host.world, bytes.data, bytes.size), KIRI_ERROR_DATA);
        bytes.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
    }
    AssertRefused(&host, (const uint8_t*)"a picture, say, or whatever a host has there instead", 50, hash);
}

TEST(Misuse)
{
    HOST(host);
    StartSmall(&host);
    SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(host.world, kiriWorld_Save);
    uint64_t hash = Host_Hash(&host);
    int64_t size = 0;
    FREED(uint8_t, few) = malloc((size_t)bytes.size - 1);
    for (int64_t capacity = bytes.size - 1; capacity >= 0; capacity = capacity / 2 - (capacity == 0)) {
        memset(few, 0x77, (size_t)bytes.size - 1);
        size = 0;
        assert_int_equal(kiriWorld_Save(host.world, few, capacity, &size), KIRI_ERROR_ARGUMENT);
        assert_int_equal(size, bytes.size);
        for (int64_t n = 0; n < bytes.size - 1; ++n) {
            assert_int_equal(few[n], 0x77); /* nothing is written */
        }
    }
    assert_int_equal(kiriWorld_Load(host.world, bytes.data, -1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(Host_Hash(&host), hash);
}

/* Which is said before anything is read: another version may have written the same bytes for other things. */
TEST(OtherVersions)
{
    enum { FORMAT = 8, LIBRARY = 12 };
    HOST(host);
    StartSmall(&host);
    SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(host.world, kiriWorld_Save);
    uint64_t hash = Host_Hash(&host);
    const int places[] = { FORMAT, LIBRARY };
    for (int k = 0; k < 2; ++k) {
        bytes.data[places[k]] += 1;
        AssertRefused(&host, bytes.data, bytes.size, hash);
        assert_non_null(strstr(host.line, "another version"));
        bytes.data[places[k]] -= 1;
    }
    assert_int_equal(kiriWorld_Load(host.world, bytes.data, bytes.size), KIRI_OK);
}

/* Writing asks for none; reading fails as a whole. */
static void CheckRefusedMemory(WriteFn* write, ReadFn* read)
{
    Host host, other;
    StartSmall(&host);
    StartSmall(&other);
    Host_Tick(&other, 1.0f / 60.0f, 1);
    int64_t calls = host.calls;
    SCOPED_AS(Bytes, bytes, Bytes_Free) = World_Write(host.world, write);
    assert_int_equal(host.calls, calls);
    uint64_t hash = Host_Hash(&other);
    kiriResult result = KIRI_ERROR_MEMORY;
    for (int64_t n = 0; result == KIRI_ERROR_MEMORY; ++n) {
        int64_t live = other.live;
        other.failAt = other.calls + n / 2;
        other.failOnce = n % 2 == 0;
        result = read(other.world, bytes.data, bytes.size);
        if (result != KIRI_OK) {
            assert_int_equal(result, KIRI_ERROR_MEMORY);
            assert_int_equal(other.live, live);
            assert_true(Host_Hash(&other) == hash);
        }
    }
    other.failAt = -1;
    assert_true(Host_Hash(&other) == Host_Hash(&host));
    Host_Stop(&host);
    Host_Stop(&other);
}

TEST(RefusedMemory)
{
    CheckRefusedMemory(kiriWorld_Save, kiriWorld_Load);
    CheckRefusedMemory(kiriWorld_Snapshot, kiriWorld_Restore);
}

/* Snapshots of other builds, saves, and bytes that are cut short are no snapshots. */
TEST(NoSnapshots)
{
    HOST(host);
    StartSmall(&host);
    SCOPED_AS(Bytes, snapshot, Bytes_Free) = World_Write(host.world, kiriWorld_Snapshot);
    SCOPED_AS(Bytes, save, Bytes_Free) = World_Write(host.world, kiriWorld_Save);
    uint64_t hash = Host_Hash(&host);
    for (int32_t byte = 0; byte < 24; ++byte) {
        snapshot.data[byte] ^= 1;
        assert_int_equal(kiriWorld_Restore(host.world, snapshot.data, snapshot.size), KIRI_ERROR_DATA);
        snapshot.data[byte] ^= 1;
    }
    assert_int_equal(kiriWorld_Restore(host.world, snapshot.data, snapshot.size - 1), KIRI_ERROR_DATA);
    assert_int_equal(kiriWorld_Restore(host.world, snapshot.data, 0), KIRI_ERROR_DATA);
    assert_int_equal(kiriWorld_Restore(host.world, save.data, save.size), KIRI_ERROR_DATA);
    assert_int_equal(kiriWorld_Load(host.world, snapshot.data, snapshot.size), KIRI_ERROR_DATA);
    assert_true(Host_Hash(&host) == hash);
    OK(kiriWorld_Restore(host.world, snapshot.data, snapshot.size));
}

/* ---- Memory in proportion ---------------------------------------------------------------------------------------- */

enum { MEMORY_FREE = 8 << 20, MEMORY_A_BYTE = 128 };

/* Of a save whose every number says once that there is a lot of something. */
static int64_t MostMemory(const Save* good, int32_t number)
{
    int64_t most = 0;
    for (int64_t at = SAVED_HEAD_BYTES; at + 4 <= good->size - SAVED_SUM_BYTES; ++at) {
        Host host;
        kiriWorldDef def = SavedHost_Def(&host);
        kiriWorld* world = NULL;
        Save save = Saved_Copy(good);
        memcpy(save.bytes + at, &number, sizeof(number));
        Saved_MendSum(&save);
        OK(kiriCreateWorld(&def, &world));
        kiriWorld_Load(world, save.bytes, save.size);
        most = host.peak > most ? host.peak : most;
        kiriDestroyWorld(world);
        assert_int_equal(host.bytes, 0);
        free(save.bytes);
    }
    return most;
}

TEST(SmallSavesTakeLittle)
{
    static const int32_t numbers[] = { INT32_MAX, 1 << 24, 1 << 16, 5000 };
    START_HOST(host);
    kiriSheetDef def = SheetOf(2, 1);
    Host_AddRectangle(&host, &def, 1.0f, 1.0f, 1, 1);
    OK(Host_Tick(&host, 0.01f, 1));
    Save good = Saved_Make(host.world);
    for (size_t k = 0; k < sizeof(numbers) / sizeof(numbers[0]); ++k) {

        assert_true(MostMemory(&good, numbers[k]) <= MEMORY_FREE + MEMORY_A_BYTE * good.size);
    }
    free(good.bytes);
    Host_Destroy(&host);
}
