/* A tick that is refused memory changes nothing. Storms in which each request of each tick is refused once: what saves
   say, all but the room of arrays, is what it was before; and what comes of the tick at last is what comes of it in
   another world, to which nothing is refused. `test_unchanged SEEDS [STORM]` (`make scarce`) runs longer, in so many
   storms of each type, or of one. */
#include "core/kiri_archive.h"

/* An archive that may leave out how much room an array has, in place of the library's. */
static bool leavesRoomOut;
#define kiriArchive_Int32(archive, number)                                                                             \
    (leavesRoomOut && sizeof(#number) == sizeof("&header.capacity") ? (void)0                                          \
                                                                    : kiriArchive_Numbers(archive, number, 4, 1))
#include "core/kiri_archive.c"
#undef kiriArchive_Int32

#include "host.h"
#include "layout_hash.h"
#include "storm.h"

#include "field/kiri_grid.h"
#include "field/kiri_shape.h"
#include "sheet/kiri_sheet_save.h"
#include "sheet/kiri_update.h"
#include "world/kiri_state.h"
#include "world/kiri_world.h"

/* ---- Memory ---- */

typedef struct Poor {
    int64_t attempt;       /* number of the tick at hand, with those that were refused */
    int64_t left;          /* requests until one is refused; negative: none */
    int64_t kept;          /* blocks of this attempt that are out */
    int64_t live, refused; /* blocks that are out; requests */
} Poor;

/* Before each block; 16 bytes, so that the block is aligned. */
typedef struct PoorBlock {
    int64_t attempt, unused;
} PoorBlock;

static void* PoorAlloc(void* user, int64_t bytes)
{
    Poor* poor = user;
    if (poor->left >= 0 && poor->left-- == 0) {
        poor->refused += 1;
        return NULL;
    }
    PoorBlock* block = malloc(sizeof(PoorBlock) + (size_t)bytes);
    assert_non_null(block);
    block->attempt = poor->attempt;
    poor->kept += 1;
    poor->live += 1;
    return memset(block + 1, 0xcd, (size_t)bytes);
}

static void PoorFree(void* user, void* pointer)
{
    Poor* poor = user;
    if (pointer != NULL) {
        PoorBlock* block = (PoorBlock*)pointer - 1;
        poor->kept -= block->attempt == poor->attempt;
        poor->live -= 1;
        free(block);
    }
}

/* ---- Bytes ---- */

enum { MOST_FRAMES = 512 };

typedef enum Part { WORLD, SAVED, SKIN, PARTS } Part;

static const char* const partNames[PARTS] = { "the world", "what saves have", "weights" };

typedef struct Bytes {
    uint8_t* data;
    int64_t size, capacity;
} Bytes;

typedef struct State {
    Bytes parts[PARTS];
} State;

static void Reserve(Bytes* bytes, int64_t capacity)
{
    if (capacity > bytes->capacity) {
        free(bytes->data);
        bytes->capacity = 2 * capacity;
        bytes->data = malloc((size_t)bytes->capacity);
        assert_non_null(bytes->data);
    }
}

static void FreeState(State* state)
{
    for (int part = 0; part < PARTS; ++part) {
        free(state->parts[part].data);
    }
}

/* The state without sheets. */
static void WriteWorld(Bytes* bytes, kiriWorld* world)
{
    int32_t sheets = world->sheets.count;
    world->sheets.count = 0;
    uint64_t hash = kiriStateHash_Of(world);
    world->sheets.count = sheets;
    Reserve(bytes, sizeof(hash));
    memcpy(bytes->data, &hash, sizeof(hash));
    bytes->size = sizeof(hash);
}

/* What each tick makes anew before it reads it, and the indices of cells. */
typedef struct Hidden {
    kiriSheetData sheet;
    kiriUpdate update;
    kiriBounds bounds;
    int32_t cells[MOST_FRAMES];
} Hidden;

static void Hide(kiriSheetData* sheet, Hidden* hidden)
{
    hidden->sheet = *sheet;
    hidden->update = *sheet->update;
    hidden->bounds = *sheet->seen.bounds;
    memset(&sheet->update->start, 0, sizeof(kiriUpdateStart));
    sheet->update->isBegun = false;
    sheet->seen.blocks.hasUnknown = false;
    sheet->seen.surface.hasNormals = false;
    sheet->seen.fades.jump = sheet->seen.fades.move = 0.0;
    sheet->seen.bounds->asked = sheet->seen.bounds->patience = sheet->seen.bounds->levelCount = 0;
    sheet->touches.found.count = sheet->regions.dirty.count = 0;
    sheet->touches.isShort = false;
    memset(&sheet->probes, 0, sizeof(kiriProbes));
    assert_in_range(sheet->frames.count, 1, MOST_FRAMES);
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        hidden->cells[i] = sheet->frames.data[i].site.cell;
        sheet->frames.data[i].site.cell = KIRI_NONE;
    }
}

static void Show(kiriSheetData* sheet, const Hidden* hidden)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].site.cell = hidden->cells[i];
    }
    *sheet->seen.bounds = hidden->bounds;
    *sheet->update = hidden->update;
    *sheet = hidden->sheet;
}

static void WriteSaved(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory)
{
    static Hidden hidden;
    Hide(sheet, &hidden);
    kiriSheet_Archive(archive, sheet, memory);
    Show(sheet, &hidden);
}

/* Wherever they lie. */
static void WriteWeights(kiriArchive* archive, const kiriSkin* skin)
{
    for (int32_t i = 0; i < skin->spans.count; ++i) {
        kiriSpan span = skin->spans.data[i];
        kiriArchive_Numbers(archive, &span.count, 4, 1);
        kiriArchive_Numbers(archive, skin->weights.data + span.first, 4,
                            span.count * (int64_t)sizeof(kiriSampleWeight) / 4);
    }
}

static void WriteSheet(kiriArchive* archive, kiriWorld* world, kiriSheetData* sheet, Part part)
{
    if (part == SAVED) {
        WriteSaved(archive, sheet, &world->memory);
    } else {
        WriteWeights(archive, &sheet->vertexSkin);
        WriteWeights(archive, &sheet->pointSkin);
    }
}

static void WriteSheets(Bytes* bytes, kiriWorld* world, Part part)
{
    kiriArchive archive = kiriArchive_Measure();
    for (int writes = 0; writes < 2; ++writes) {
        for (int32_t i = 0; i < world->sheets.count; ++i) {
            WriteSheet(&archive, world, world->sheets.data[i], part);
        }
        if (writes == 0) {
            Reserve(bytes, archive.at);
            archive = kiriArchive_Write(bytes->data, archive.at);
        }
    }
    assert_true(!archive.isBad && archive.at == archive.size);
    bytes->size = archive.at;
}

static void Write(State* state, kiriWorld* world)
{
    leavesRoomOut = true;
    WriteWorld(&state->parts[WORLD], world);
    for (Part part = SAVED; part < PARTS; ++part) {
        WriteSheets(&state->parts[part], world, part);
    }
    leavesRoomOut = false;
}

static void Compare(const State* one, const State* other, const char* storm, int32_t tick, const char* what)
{
    for (int part = 0; part < PARTS; ++part) {
        const Bytes *a = &one->parts[part], *b = &other->parts[part];
        int64_t at = 0;
        while (at < a->size && at < b->size && a->data[at] == b->data[at]) {
            ++at;
        }
        if (at < a->size || at < b->size) {
            fail_msg("%s, tick %d: %s other in %s, byte %lld of %lld and %lld", storm, (int)tick, what, partNames[part],
                     (long long)at, (long long)a->size, (long long)b->size);
        }
    }
}

/* ---- Storms ---- */

enum { TICKS = 4, LONG_TICKS = 24 };

typedef struct Pair {
    Storm rich, poor;
    Poor memories[2];
    State before, after;
    int32_t tick;
} Pair;

static int32_t ticks = TICKS;
static uint32_t seeds = 1;
static const char* onlyStorm; /* or null */

static void StartOne(Storm* storm, int32_t kind, uint32_t seed, Poor* memory)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.alloc = PoorAlloc;
    def.free = PoorFree;
    def.user = memory;
    memset(memory, 0, sizeof(*memory));
    memory->left = -1;
    OK(Storm_Start(storm, kind, &def));
    storm->seed += 977 * seed;
}

/* Something happens, but for the tick. */
static int32_t Act(Storm* storm)
{
    for (uint32_t acts = 2 + Storm_Random(storm, 4); acts > 0; acts--) {
        Storm_Act(storm);
    }
    return 1 + (int32_t)Storm_Random(storm, 3);
}

/* A snapshot is restored then as the same world. */
static void CheckLoads(const Pair* pair)
{
    static Bytes bytes;
    kiriWorld* other;
    kiriWorldDef def;
    int64_t size;
    uint64_t one, two;
    const kiriWorld* world = pair->poor.world;
    kiriDefaultWorldDef(&def);
    OK(kiriCreateWorld(&def, &other));
    OK(kiriWorld_Snapshot(world, NULL, 0, &size));
    Reserve(&bytes, size);
    OK(kiriWorld_Snapshot(world, bytes.data, bytes.capacity, &size));
    if (kiriWorld_Restore(other, bytes.data, size) != KIRI_OK) {
        fail_msg("%s, tick %d: %s", pair->poor.type->name, (int)pair->tick, kiriWorld_GetLastError(other));
    }
    OK(kiriWorld_GetStateHash(world, &one));
    OK(kiriWorld_GetStateHash(other, &two));
    assert_true(one == two);
    kiriDestroyWorld(other);
}

/* Blocks that a refused tick keeps are not asked for again. So the next request to refuse is the one after those that
   it asks for again, and after the one that was refused. */
static kiriResult TickPoorly(Pair* pair, int32_t substeps)
{
    Storm* storm = &pair->poor;
    Poor* memory = &pair->memories[1];
    kiriResult result = KIRI_ERROR_MEMORY;
    for (int64_t granted = 0; result == KIRI_ERROR_MEMORY; granted += 1 - memory->kept) {
        Write(&pair->before, storm->world);
        memory->attempt += 1;
        memory->kept = 0;
        memory->left = granted;
        result = kiriWorld_Tick(storm->world, 1.0f / 60.0f, substeps);
        memory->left = -1;
        if (result == KIRI_ERROR_MEMORY) {
            Write(&pair->after, storm->world);
            Compare(&pair->before, &pair->after, storm->type->name, pair->tick, "a refused tick leaves what is");
            if (memory->refused % 7 == 0) {
                CheckLoads(pair);
            }
        }
    }
    return result;
}

static uint64_t HashOf(const Storm* storm)
{
    uint64_t hash;
    OK(kiriWorld_GetStateHash(storm->world, &hash));
    return hash;
}

/* But for the profile: work that is made again may be more. */
static void CompareBoth(Pair* pair)
{
    const char* name = pair->rich.type->name;
    kiriProfile profile = pair->poor.world->profile;
    pair->poor.world->profile = pair->rich.world->profile;
    Write(&pair->before, pair->rich.world);
    Write(&pair->after, pair->poor.world);
    pair->poor.world->profile = profile;
    Compare(&pair->before, &pair->after, name, pair->tick, "after refusals a tick ends");
    if (HashOf(&pair->rich) != HashOf(&pair->poor) || pair->rich.results != pair->poor.results) {
        fail_msg("%s, tick %d: after refusals another state", name, (int)pair->tick);
    }
    for (int32_t i = 0; i < pair->rich.world->sheets.count; ++i) {
        assert_true(HashLayout(pair->rich.world->sheets.data[i]) == HashLayout(pair->poor.world->sheets.data[i]));
    }
}

static int64_t RunPair(int32_t kind, uint32_t seed)
{
    static Pair pair;
    memset(&pair, 0, sizeof(pair));
    StartOne(&pair.rich, kind, seed, &pair.memories[0]);
    StartOne(&pair.poor, kind, seed, &pair.memories[1]);
    bool isLimited = pair.rich.type->budget.cells > 0;
    for (; pair.tick < ticks; ++pair.tick) {
        int32_t substeps = Act(&pair.poor);
        kiriResult result = TickPoorly(&pair, substeps);
        if (!isLimited) {
            assert_int_equal(Act(&pair.rich), substeps);
            assert_int_equal(kiriWorld_Tick(pair.rich.world, 1.0f / 60.0f, substeps), result);
            CompareBoth(&pair);
        }
    }
    kiriDestroyWorld(pair.rich.world);
    kiriDestroyWorld(pair.poor.world);
    assert_true(pair.memories[0].live == 0 && pair.memories[1].live == 0);
    FreeState(&pair.before);
    FreeState(&pair.after);
    return pair.memories[1].refused;
}

static void TestStorms(void** state)
{
    (void)state;
    for (int32_t kind = 0; kind < STORM_TYPES; ++kind) {
        const char* name = Storm_Types[kind].name;
        int64_t refused = 0;
        if (onlyStorm != NULL && strcmp(name, onlyStorm) != 0) {
            continue;
        }
        for (uint32_t seed = 0; seed < seeds; ++seed) {
            refused += RunPair(kind, seed);
        }
        print_message("%s: %lld requests refused\n", name, (long long)refused);
        assert_true(refused > 40);
    }
}

int main(int count, char** arguments)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(TestStorms) };
    ticks = count > 1 ? LONG_TICKS : TICKS;
    seeds = count > 1 ? (uint32_t)atoi(arguments[1]) : 1;
    onlyStorm = count > 2 ? arguments[2] : NULL;
    return cmocka_run_group_tests(tests, NULL, NULL);
}
