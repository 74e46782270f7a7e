/* Worlds as bytes: a world that was loaded goes on as the one that was saved, bit for bit, and bytes that are none are
   refused. */
#include "host.h"
#include "storm.h"

typedef struct Bytes {
    uint8_t* data;
    int64_t size;
} Bytes;

static Bytes Save(const kiriWorld* world)
{
    Bytes bytes = { NULL, 0 };
    assert_int_equal(kiriWorld_Save(world, NULL, 0, &bytes.size), KIRI_OK);
    assert_true(bytes.size > 0);
    bytes.data = malloc((size_t)bytes.size);
    int64_t size = 0;
    assert_int_equal(kiriWorld_Save(world, bytes.data, bytes.size, &size), KIRI_OK);
    assert_int_equal(size, bytes.size);
    return bytes;
}

static uint64_t HashOf(const kiriWorld* world)
{
    uint64_t hash = 0;
    assert_int_equal(kiriWorld_GetStateHash(world, &hash), KIRI_OK);
    return hash;
}

static void AssertSame(Bytes a, Bytes b)
{
    assert_int_equal(a.size, b.size);
    for (int64_t n = 0; n < a.size; ++n) {
        if (a.data[n] != b.data[n]) {
            fail_msg("byte %lld of %lld differs", (long long)n, (long long)a.size);
        }
    }
}

/* ---- Storms ------------------------------------------------------------------------------------------------------ */

enum { STORM_TICKS = 30, EVERY = 5, GO_ON = 4 };

static void StartStorm(Storm* storm, Host* host, int32_t kind, uint32_t seed, const kiriBudget* budget)
{
    memset(host, 0, sizeof(*host));
    host->failAt = -1;
    kiriWorldDef def = Host_Def(host);
    assert_int_equal(Storm_Start(storm, kind, &def), KIRI_OK);
    storm->seed += 100 * seed;
    host->world = storm->world;
    if (budget != NULL) {
        assert_int_equal(kiriWorld_SetBudget(storm->world, budget), KIRI_OK);
    }
}

static void AssertAlike(Storm* a, Storm* b, int32_t saved, int32_t tick)
{
    if (HashOf(a->world) != HashOf(b->world) || Storm_HashSeen(a) != Storm_HashSeen(b) || a->results != b->results) {
        fail_msg("%s: saved at tick %d, other at tick %d: state %d, seen %d, results %d", a->type->name, (int)saved,
                 (int)tick, HashOf(a->world) != HashOf(b->world), Storm_HashSeen(a) != Storm_HashSeen(b),
                 a->results != b->results);
    }
}

/* The world of `other` becomes that of the storm, and both go on alike. */
static void CheckSave(const Storm* storm, kiriWorld* other, int32_t tick)
{
    Storm a = *storm, b = *storm;
    b.world = other;
    Bytes bytes = Save(a.world), again;
    assert_int_equal(kiriWorld_Load(other, bytes.data, bytes.size), KIRI_OK);
    again = Save(other);
    AssertSame(bytes, again);
    AssertAlike(&a, &b, tick, tick);
    for (int32_t k = 1; k <= GO_ON; ++k) {
        Storm_Tick(&a);
        Storm_Tick(&b);
        AssertAlike(&a, &b, tick, tick + k);
    }
    assert_int_equal(kiriWorld_Load(a.world, bytes.data, bytes.size), KIRI_OK);
    free(bytes.data);
    free(again.data);
}

static void RunStorm(int32_t kind, uint32_t seed, const kiriBudget* budget)
{
    Storm storm, other;
    Host host, otherHost;
    StartStorm(&storm, &host, kind, seed, budget);
    StartStorm(&other, &otherHost, (kind + 1) % STORM_TYPES, seed, NULL);
    for (int32_t tick = 0; tick < STORM_TICKS; ++tick) {
        if (tick % EVERY == 0) {
            CheckSave(&storm, other.world, tick);
        }
        Storm_Tick(&storm);
    }
    Host_Destroy(&host);
    Host_Destroy(&otherHost);
}

static void test_a_storm_goes_on(void** state)
{
    (void)state;
    for (int32_t kind = 0; kind < STORM_TYPES; ++kind) {
        RunStorm(kind, 0, NULL);
    }
}

/* So that each stage is caught half way. */
static void test_work_that_waits_goes_on(void** state)
{
    static const kiriBudget budgets[] = { { 64, 5, 3, 2 }, { 64, 60, 20, 0 }, { 200, 15, 2, 0 } };
    (void)state;
    for (int32_t k = 0; k < 3; ++k) {
        RunStorm(3 * k % STORM_TYPES, (uint32_t)(1 + k), &budgets[k]);
    }
}

/* ---- Inside a square --------------------------------------------------------------------------------------------- */

/* A square of the grid with many triangles takes more than a tick: the work on it is saved wherever it stops. */
static void test_work_inside_a_square_goes_on(void** state)
{
    (void)state;
    Host host, other;
    Host_Start(&host);
    Host_Start(&other);
    kiriSheetDef def = Host_SmallDef();
    def.gridResolution = 2;
    kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 40, 40);
    kiriBudget budget = { 0 };
    budget.triangles = budget.samples = 1000;
    budget.cells = 6;
    budget.iterations = 100;
    assert_int_equal(kiriWorld_SetBudget(host.world, &budget), KIRI_OK);
    const float points[8] = { -0.1f, 0.4f, 1.1f, 0.6f, 0.7f, 1.1f, 0.3f, -0.1f };
    Host_Cut(&host, sheet, points, 4);
    kiriResult result = KIRI_PENDING;
    int32_t ticks = 0;
    for (; result == KIRI_PENDING && ticks < 2000; ++ticks) {
        result = Host_Tick(&host, 1.0f / 60.0f, 1);
        Bytes bytes = Save(host.world), again;
        assert_int_equal(kiriWorld_Load(other.world, bytes.data, bytes.size), KIRI_OK);
        again = Save(other.world);
        AssertSame(bytes, again);
        free(bytes.data);
        free(again.data);
        result = Host_Tick(&host, 1.0f / 60.0f, 1);
        assert_int_equal(Host_Tick(&other, 1.0f / 60.0f, 1), result);
        assert_true(HashOf(other.world) == HashOf(host.world));
    }
    assert_int_equal(result, KIRI_OK);
    assert_true(ticks > 20);
    Host_Destroy(&host);
    Host_Destroy(&other);
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
    kiriPinDef pin;
    kiriDefaultPinDef(&pin);
    kiriPin pinned;
    assert_int_equal(kiriCreatePin(host->world, sheet, &pin, &pinned), KIRI_OK);
    kiriObstacleDef obstacleDef;
    kiriDefaultObstacleDef(&obstacleDef);
    obstacleDef.type = KIRI_OBSTACLE_BOX;
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
    assert_int_equal(HashOf(host->world), hash);
}

static void test_what_is_cut_short_is_refused(void** state)
{
    (void)state;
    Host host;
    StartSmall(&host);
    Bytes bytes = Save(host.world);
    uint64_t hash = HashOf(host.world);
    for (int64_t size = 0; size < bytes.size; ++size) {
        uint8_t* part = malloc((size_t)size + 1); /* so that a sanitizer sees who reads beyond */
        memcpy(part + 1, bytes.data, (size_t)size);
        assert_int_equal(kiriWorld_Load(host.world, part + 1, size), KIRI_ERROR_DATA);
        free(part);
    }
    assert_int_equal(HashOf(host.world), hash);
    assert_int_equal(kiriWorld_Load(host.world, bytes.data, bytes.size), KIRI_OK);
    free(bytes.data);
    Host_Stop(&host);
}

static void test_no_bit_may_change(void** state)
{
    (void)state;
    Host host;
    StartSmall(&host);
    Bytes bytes = Save(host.world);
    uint64_t hash = HashOf(host.world);
    for (int64_t bit = 0; bit < 8 * bytes.size; bit += bit < 8 * 256 ? 1 : 61) {
        bytes.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
        assert_int_equal(kiriWorld_Load(host.world, bytes.data, bytes.size), KIRI_ERROR_DATA);
        bytes.data[bit / 8] ^= (uint8_t)(1 << bit % 8);
    }
    AssertRefused(&host, (const uint8_t*)"a picture, say, or whatever a host has there instead", 50, hash);
    free(bytes.data);
    Host_Stop(&host);
}

static void test_calls_are_checked(void** state)
{
    (void)state;
    Host host;
    StartSmall(&host);
    Bytes bytes = Save(host.world);
    uint64_t hash = HashOf(host.world);
    int64_t size = 0;
    uint8_t* few = malloc((size_t)bytes.size - 1);
    assert_int_equal(kiriWorld_Save(host.world, NULL, 0, NULL), KIRI_ERROR_ARGUMENT);
    for (int64_t capacity = bytes.size - 1; capacity >= 0; capacity = capacity / 2 - (capacity == 0)) {
        memset(few, 0x77, (size_t)bytes.size - 1);
        size = 0;
        assert_int_equal(kiriWorld_Save(host.world, few, capacity, &size), KIRI_ERROR_ARGUMENT);
        assert_int_equal(size, bytes.size);
        for (int64_t n = 0; n < bytes.size - 1; ++n) {
            assert_int_equal(few[n], 0x77); /* nothing is written */
        }
    }
    assert_int_equal(kiriWorld_Load(host.world, NULL, 100), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_Load(host.world, bytes.data, -1), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_Save(NULL, NULL, 0, &size), KIRI_ERROR_ARGUMENT);
    assert_int_equal(kiriWorld_Load(NULL, bytes.data, bytes.size), KIRI_ERROR_ARGUMENT);
    assert_int_equal(HashOf(host.world), hash);
    free(few);
    free(bytes.data);
    Host_Stop(&host);
}

/* Which is said before anything is read: another version may have written the same bytes for other things. */
static void test_saves_of_other_versions_are_refused(void** state)
{
    (void)state;
    enum { FORMAT = 8, LIBRARY = 12 };
    Host host;
    StartSmall(&host);
    Bytes bytes = Save(host.world);
    uint64_t hash = HashOf(host.world);
    const int places[] = { FORMAT, LIBRARY };
    for (int k = 0; k < 2; ++k) {
        bytes.data[places[k]] += 1;
        AssertRefused(&host, bytes.data, bytes.size, hash);
        assert_non_null(strstr(host.line, "another version"));
        bytes.data[places[k]] -= 1;
    }
    assert_int_equal(kiriWorld_Load(host.world, bytes.data, bytes.size), KIRI_OK);
    free(bytes.data);
    Host_Stop(&host);
}

/* Saving asks for none; loading fails as a whole. */
static void test_memory_may_be_refused(void** state)
{
    (void)state;
    Host host, other;
    StartSmall(&host);
    StartSmall(&other);
    Host_Tick(&other, 1.0f / 60.0f, 1);
    int64_t calls = host.calls;
    Bytes bytes = Save(host.world);
    assert_int_equal(host.calls, calls);
    uint64_t hash = HashOf(other.world);
    kiriResult result = KIRI_ERROR_MEMORY;
    for (int64_t n = 0; result == KIRI_ERROR_MEMORY; ++n) {
        int64_t live = other.live;
        other.failAt = other.calls + n;
        other.failOnce = n % 2 == 0;
        result = kiriWorld_Load(other.world, bytes.data, bytes.size);
        if (result != KIRI_OK) {
            assert_int_equal(result, KIRI_ERROR_MEMORY);
            assert_int_equal(other.live, live);
            assert_int_equal(HashOf(other.world), hash);
        }
    }
    other.failAt = -1;
    assert_int_equal(HashOf(other.world), HashOf(host.world));
    free(bytes.data);
    Host_Stop(&host);
    Host_Stop(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_a_storm_goes_on),
        cmocka_unit_test(test_work_that_waits_goes_on),
        cmocka_unit_test(test_work_inside_a_square_goes_on),
        cmocka_unit_test(test_what_is_cut_short_is_refused),
        cmocka_unit_test(test_no_bit_may_change),
        cmocka_unit_test(test_calls_are_checked),
        cmocka_unit_test(test_saves_of_other_versions_are_refused),
        cmocka_unit_test(test_memory_may_be_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
