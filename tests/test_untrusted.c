/* kiriWorld_LoadUntrusted: of a save that is honest it makes what kiriWorld_Load makes, where no cut is being worked
   on; and the cut that is being worked on does the same, if later. tests/fuzz_spoil.c has saves that are not honest. */
#include "fuzz_saved.h"
#include "host.h"

#include "core/kiri_hash.h"
#include "sheet/kiri_update.h"
#include "world/kiri_state_hash.h"
#include "world/kiri_world.h"

enum { STORM_TICKS = 24, EVERY = 6, GO_ON = 6 };

static uint64_t HashOf(const kiriWorld* world)
{
    uint64_t hash = 0;
    OK(kiriWorld_GetStateHash(world, &hash));
    return hash;
}

static bool IsAtWork(const kiriWorld* world)
{
    bool isAtWork = false;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriUpdate* u = world->sheets.data[i]->update;
        isAtWork |= u->stage > KIRI_STAGE_CUT || u->needsRebuild || (u->stage == KIRI_STAGE_CUT && u->cut.meshChanged);
    }
    return isAtWork;
}

/* ---- Storms ------------------------------------------------------------------------------------------------------ */

static void StartStorm(Storm* storm, Host* host, int32_t kind, uint32_t seed)
{
    Host_Start(host);
    kiriDestroyWorld(host->world);
    kiriWorldDef def = Host_Def(host);
    OK(Storm_Start(storm, kind, &def));
    storm->seed += 100 * seed;
    host->world = storm->world;
}

static void AssertAlike(Storm* a, Storm* b, int32_t saved, int32_t tick)
{
    if (HashOf(a->world) != HashOf(b->world) || Storm_HashSeen(a) != Storm_HashSeen(b) || a->results != b->results) {
        fail_msg("%s: saved at tick %d, other at tick %d: state %d, seen %d, results %d", a->type->name, (int)saved,
                 (int)tick, HashOf(a->world) != HashOf(b->world), Storm_HashSeen(a) != Storm_HashSeen(b),
                 a->results != b->results);
    }
}

/* From the same bytes, trusted and not. With a budget a later cut may take effect in another tick: from there on the
   worlds are others. */
static void CheckGoesOn(const Storm* storm, kiriWorld* trusting, kiriWorld* other, int32_t tick)
{
    Storm a = *storm, b = *storm;
    a.world = trusting;
    b.world = other;
    Save save = Saved_Make(storm->world);
    OK(kiriWorld_Load(trusting, save.bytes, save.size));
    OK(kiriWorld_LoadUntrusted(other, save.bytes, save.size));
    bool isAtWork = IsAtWork(storm->world);
    for (int32_t k = 0; k <= GO_ON && !isAtWork; ++k) {
        AssertAlike(&a, &b, tick, tick + k);
        Storm_Tick(&a);
        Storm_Tick(&b);
        isAtWork = IsAtWork(a.world) || IsAtWork(b.world);
    }
    free(save.bytes);
}

static void RunStorm(int32_t kind, uint32_t seed)
{
    const kiriBudget unlimited = { 0 };
    Storm storm, trusting, other;
    Host host, trustingHost, otherHost;
    StartStorm(&storm, &host, kind, seed);
    OK(kiriWorld_SetBudget(storm.world, &unlimited));
    StartStorm(&trusting, &trustingHost, (kind + 1) % STORM_TYPES, seed);
    StartStorm(&other, &otherHost, (kind + 2) % STORM_TYPES, seed);
    for (int32_t tick = 0; tick < STORM_TICKS; ++tick) {
        if (tick % EVERY == EVERY - 1) {
            CheckGoesOn(&storm, trusting.world, other.world, tick);
        }
        Storm_Tick(&storm);
    }
    Host_Destroy(&host);
    Host_Destroy(&trustingHost);
    Host_Destroy(&otherHost);
}

static void TestStormsGoOn(void** state)
{
    (void)state;
    for (int32_t kind = 0; kind < STORM_TYPES; ++kind) {
        RunStorm(kind, 1);
    }
}

/* Triangles that are large for the grid, and meshes with holes. */
static void TestMeshesGoOn(void** state)
{
    (void)state;
    for (int32_t world = SAVED_LARGE; world < SAVED_WORLDS; ++world) {
        const Saved* saved = Saved_Get(world);
        Host host, trustingHost, otherHost;
        Host_Start(&host);
        Host_Start(&trustingHost);
        Host_Start(&otherHost);
        OK(kiriWorld_Load(host.world, saved->later.bytes, saved->later.size));
        const kiriMeshData* mesh = &host.world->sheets.data[0]->mesh;
        assert_int_equal(mesh->vertexHoles > 0, world >= SAVED_HOLES);
        Storm storm = saved->storm;
        storm.world = host.world;
        CheckGoesOn(&storm, trustingHost.world, otherHost.world, world);
        Host_Destroy(&host);
        Host_Destroy(&trustingHost);
        Host_Destroy(&otherHost);
    }
}

/* ---- Work at hand ------------------------------------------------------------------------------------------------ */

enum { ROUND_POINTS = 6, MOST_TICKS = 4000 };

static const float around[2 * ROUND_POINTS] = {
    0.2f, 0.5f, 0.8f, 0.5f, 0.8f, 0.9f, 0.4f, 0.9f, 0.4f, 0.2f, 0.9f, 0.2f
};

static kiriSheet StartCut(Host* host, const kiriBudget* budget)
{
    Host_Start(host);
    kiriSheetDef def = Host_SmallDef();
    def.collisionPoints = 20;
    kiriSheet sheet = Host_AddRectangle(host, &def, 1.0f, 1.0f, 4, 4);
    Host_Cut(host, sheet, around, ROUND_POINTS);
    OK(kiriWorld_SetBudget(host->world, budget));
    return sheet;
}

static void Finish(Host* host)
{
    kiriResult result = KIRI_PENDING;
    for (int32_t tick = 0; tick < MOST_TICKS && result == KIRI_PENDING; ++tick) {
        result = Host_Tick(host, 0.01f, 1);
    }
    assert_int_equal(result, KIRI_OK);
    const kiriUpdate* u = host->world->sheets.data[0]->update;
    assert_int_equal(u->stage, KIRI_NONE);
    assert_false(u->needsRebuild);
}

/* Triangles, frames, pieces and the weights of vertices: not where they are. */
static uint64_t LayoutOf(const Host* host)
{
    uint64_t hash = KIRI_HASH_START;
    kiriStateHash_AddLayout(&hash, host->world->sheets.data[0]);
    return hash;
}

/* In whatever step a tick has left the work: the cut does the same. */
static void TestWorkBeginsAgain(void** state)
{
    (void)state;
    const kiriBudget little = { 64, 5, 3, 0 }, unlimited = { 0 };
    Host host, whole, other;
    uint8_t isSeen[KIRI_READY] = { 0 };
    StartCut(&whole, &unlimited);
    Finish(&whole);
    StartCut(&host, &little);
    Host_Start(&other);
    bool isDone = false;
    for (int32_t tick = 0; tick < MOST_TICKS && !isDone; ++tick) {
        isDone = Host_Tick(&host, 0.01f, 1) == KIRI_OK;
        Save save = Saved_Make(host.world);
        int32_t stage = host.world->sheets.data[0]->update->stage;
        isSeen[isDone ? 0 : stage] = 1;
        OK(kiriWorld_LoadUntrusted(other.world, save.bytes, save.size));
        OK(kiriWorld_SetBudget(other.world, &unlimited));
        Finish(&other);
        if (LayoutOf(&other) != LayoutOf(&whole)) {
            fail_msg("from tick %d, in stage %d, the cut has done something else", (int)tick, (int)stage);
        }
        free(save.bytes);
    }
    assert_true(isDone);
    for (int32_t stage = 0; stage < KIRI_READY; ++stage) {
        assert_true(isSeen[stage]);
    }
    Host_Destroy(&host);
    Host_Destroy(&whole);
    Host_Destroy(&other);
}

/* ---- What it takes ----------------------------------------------------------------------------------------------- */

enum { MEMORY_FREE = 2 << 20, MEMORY_A_BYTE = 128 };

/* Of a save whose every number says once that there is a lot of something. */
static int64_t MostMemory(const Save* good, int32_t number)
{
    int64_t most = 0;
    for (int64_t at = SAVED_HEAD_BYTES; at + 4 <= good->size - SAVED_SUM_BYTES; ++at) {
        SavedHost host = { 0 };
        kiriWorldDef def = SavedHost_Def(&host);
        kiriWorld* world = NULL;
        Save save = Saved_Copy(good);
        memcpy(save.bytes + at, &number, sizeof(number));
        Saved_MendSum(&save);
        OK(kiriCreateWorld(&def, &world));
        kiriWorld_LoadUntrusted(world, save.bytes, save.size);
        most = host.most > most ? host.most : most;
        kiriDestroyWorld(world);
        assert_int_equal(host.held, 0);
        free(save.bytes);
    }
    return most;
}

static void TestSmallSavesTakeLittle(void** state)
{
    (void)state;
    static const int32_t numbers[] = { INT32_MAX, 1 << 24, 1 << 16, 5000 };
    Host host;
    Host_Start(&host);
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.gridResolution = 2;
    def.frameCount = 1;
    Host_AddRectangle(&host, &def, 1.0f, 1.0f, 1, 1);
    OK(Host_Tick(&host, 0.01f, 1));
    Save good = Saved_Make(host.world);
    for (size_t k = 0; k < sizeof(numbers) / sizeof(numbers[0]); ++k) {
        assert_true(MostMemory(&good, numbers[k]) <= MEMORY_FREE + MEMORY_A_BYTE * good.size);
    }
    free(good.bytes);
    Host_Destroy(&host);
}

/* Each request in turn, alone or with all after it: a lack of memory is no wrong data, and changes nothing. */
static void TestMemoryMayBeRefused(void** state)
{
    (void)state;
    const kiriBudget unlimited = { 0 };
    Host host, other;
    StartCut(&host, &unlimited);
    Finish(&host);
    Host_Start(&other);
    Save save = Saved_Make(host.world);
    uint64_t hash = HashOf(other.world);
    kiriResult result = KIRI_ERROR_MEMORY;
    for (int64_t n = 0; result == KIRI_ERROR_MEMORY; ++n) {
        int64_t live = other.live;
        other.failAt = other.calls + n / 2;
        other.failOnce = n % 2 == 0;
        result = kiriWorld_LoadUntrusted(other.world, save.bytes, save.size);
        if (result != KIRI_OK) {
            assert_int_equal(result, KIRI_ERROR_MEMORY);
            assert_int_equal(other.live, live);
            assert_true(HashOf(other.world) == hash);
        }
    }
    assert_int_equal(result, KIRI_OK);
    assert_true(HashOf(other.world) == HashOf(host.world));
    free(save.bytes);
    Host_Destroy(&host);
    Host_Destroy(&other);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(TestStormsGoOn),           cmocka_unit_test(TestMeshesGoOn),
        cmocka_unit_test(TestWorkBeginsAgain),      cmocka_unit_test(TestMemoryMayBeRefused),
        cmocka_unit_test(TestSmallSavesTakeLittle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
