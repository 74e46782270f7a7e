#include "defaults.h"
#include "fuzz_saved.h"

#include "core/kiri_archive.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_HELD = 256 << 20, MOST_OF_LOAD = 64 << 20 }; /* saves have some hundred thousand bytes */

kiriWorldDef SavedHost_Def(Host* host)
{
    *host = (Host){ .failAt = -1, .room = MOST_HELD };
    kiriWorldDef def = Host_Def(host);
    def.log = NULL;
    return def;
}

/* ---- Good saves ---- */

static Saved worlds[SAVED_WORLDS];

Save Saved_Make(const kiriWorld* world)
{
    Save save = { NULL, 0 };
    for (int pass = 0; pass < 2; ++pass) {
        int64_t room = save.size;
        kiriResult result = kiriWorld_Save(world, save.bytes, room, &save.size);
        FUZZ_CHECK(result == KIRI_OK, "a save returns %d: %s", (int)result, kiriWorld_GetLastError(world));
        save.bytes = pass == 0 ? malloc((size_t)save.size) : save.bytes;
        FUZZ_CHECK(save.bytes != NULL, "no memory for a save");
    }
    return save;
}

/* Small, so that of what is changed much matters. `grid`: squares along it; 0: some, about twice as many as of the
   mesh. */
static void AddSmallSheet(Storm* storm, int32_t squares, int32_t grid)
{
    enum { MOST_SQUARES = 66, MOST_CORNERS = MOST_SQUARES + 1 };
    static float positions[2 * MOST_CORNERS * MOST_CORNERS];
    static int32_t indices[6 * MOST_SQUARES * MOST_SQUARES];
    FUZZ_CHECK(kiriFillRectangle(1.0f, 1.0f, squares, squares, positions, indices) == KIRI_OK, "no rectangle");
    const StormType* type = storm->type;
    kiriSheetDef def = DefaultSheet();
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = (squares + 1) * (squares + 1);
    def.triangleCount = 2 * squares * squares;
    def.position[2] = 0.1f * (float)storm->sheetCount;
    int32_t some = 8 + (int32_t)Storm_Random(storm, 4);
    def.gridResolution = grid > 0 ? grid : some;
    def.frameCount = 2 + (int32_t)Storm_Random(storm, 3);
    def.maxFrames = 12;
    def.collisionPoints = 6;
    def.touchesSheets = type->touches;
    def.model = type->model;
    def.skinning = type->skinning;
    def.timeStepping = type->timeStepping;
    def.planar = type->planar;
    def.normals = Storm_Random(storm, 4) > 0;
    def.paper.fromScratch = type->fromScratch;
    kiriSheet sheet = 0;
    FUZZ_CHECK(kiriCreateSheet(storm->world, &def, &sheet) == KIRI_OK, "%s", kiriWorld_GetLastError(storm->world));
    Storm_KeepSheet(storm, sheet);
}

/* Storms of all types; the later ones have so little budget that each stage of the work on a cut is caught half way. */
static void StartStorm(Storm* storm, int32_t index, Host* host)
{
    static const kiriBudget budgets[] = { { 64, 5, 3, 2 }, { 64, 60, 2, 0 }, { 200, 15, 20, 0 }, { 64, 150, 60, 8 } };
    kiriWorldDef def = SavedHost_Def(host);
    memset(storm, 0, sizeof(*storm));
    storm->type = &Storm_Types[index % STORM_TYPES];
    storm->seed = 1 + (uint32_t)index;
    FUZZ_CHECK(kiriCreateWorld(&def, &storm->world) == KIRI_OK, "no world");
    AddSmallSheet(storm, 4, index >= SAVED_LARGE ? 40 : 0);
    if (storm->type->touches) {
        AddSmallSheet(storm, 4, 0);
    }
    for (int32_t i = 0; storm->type->obstacles && i < STORM_OBSTACLES; ++i) {
        Storm_AddObstacle(storm);
    }
    if (index >= STORM_TYPES) {
        FUZZ_CHECK(kiriWorld_SetBudget(storm->world, &budgets[index % 4]) == KIRI_OK, "no budget");
    }
}

const Saved* Saved_Get(int32_t index)
{
    Saved* saved = &worlds[index];
    if (saved->base.bytes == NULL) {
        Host host;
        StartStorm(&saved->storm, index, &host);
        for (int32_t tick = 0; tick < (index < SAVED_LARGE ? 3 + index / 4 : 3); ++tick) {
            Storm_Tick(&saved->storm);
        }
        FUZZ_CHECK(kiriWorld_FinishCuts(saved->storm.world) == KIRI_OK, "work is not finished");
        saved->base = Saved_Make(saved->storm.world);
        Storm_Tick(&saved->storm);
        FUZZ_CHECK(kiriWorld_FinishCuts(saved->storm.world) == KIRI_OK, "work is not finished");
        saved->later = Saved_Make(saved->storm.world);
        kiriDestroyWorld(saved->storm.world);
        saved->storm.world = NULL;
    }
    return saved;
}

/* ---- Sums ---- */

/* As the library makes it: of all bytes before it, eight at a time. */
static uint64_t SumOf(const Save* save)
{
    uint64_t sum = KIRI_HASH_START;
    int64_t count = save->size - SAVED_SUM_BYTES;
    for (int64_t n = 0; n < count; n += 8) {
        uint64_t word = 0;
        for (int64_t k = 0; k < 8 && n + k < count; ++k) {
            word |= (uint64_t)save->bytes[n + k] << 8 * k;
        }
        kiriHash_Int64(&sum, (int64_t)word);
    }
    return sum;
}

void Saved_MendSum(Save* save)
{
    uint64_t sum = SumOf(save);
    for (int k = 0; k < SAVED_SUM_BYTES; ++k) {
        save->bytes[save->size - SAVED_SUM_BYTES + k] = (uint8_t)(sum >> 8 * k);
    }
}

bool Saved_HasSum(const Save* save)
{
    Save mended = Saved_Copy(save);
    Saved_MendSum(&mended);
    bool has = memcmp(mended.bytes, save->bytes, (size_t)save->size) == 0;
    free(mended.bytes);
    return has;
}

Save Saved_Copy(const Save* save)
{
    Save copy = { malloc((size_t)save->size), save->size };
    FUZZ_CHECK(copy.bytes != NULL, "no memory for a copy");
    memcpy(copy.bytes, save->bytes, (size_t)save->size);
    return copy;
}

/* ---- What comes of them ---- */

void Saved_GoOn(Storm* storm)
{
    const kiriBudget unlimited = { 0, 0, 0, 0 };
    for (int32_t tick = 0; tick < 6; ++tick) {
        Storm_HashSeen(storm);
        Storm_Tick(storm);
        if (tick == 1) {
            FUZZ_CHECK(kiriWorld_SetBudget(storm->world, &unlimited) == KIRI_OK, "no budget");
        } else if (tick == 3) {
            Storm_Cut(storm);
            Storm_Slice(storm);
        }
    }
    Storm_HashSeen(storm);
    uint64_t hash = 0;
    FUZZ_CHECK(kiriWorld_GetStateHash(storm->world, &hash) == KIRI_OK, "no hash");
    kiriResult result = kiriWorld_FinishCuts(storm->world);
    FUZZ_CHECK(result == KIRI_OK || result == KIRI_ERROR_MEMORY || result == KIRI_ERROR_LIMIT, "finishing gives %d",
               (int)result);
    if (result == KIRI_OK) {
        Save save = Saved_Make(storm->world);
        free(save.bytes);
    }
}

static void CheckRefused(kiriWorld* world, kiriResult result, const Host* host, uint64_t before)
{
    uint64_t after = 0;
    FUZZ_CHECK(result == KIRI_ERROR_DATA || (result == KIRI_ERROR_MEMORY && host->refused > 0),
               "a load returns %d, of %d requests refused", (int)result, (int)host->refused);
    kiriWorld_GetStateHash(world, &after);
    FUZZ_CHECK(before == after, "a load that failed has changed the world");
}

static kiriWorld* StartWorld(Host* host, uint64_t* hash)
{
    kiriWorld* world = NULL;
    kiriWorldDef def = SavedHost_Def(host);
    FUZZ_CHECK(kiriCreateWorld(&def, &world) == KIRI_OK, "no world");
    kiriWorld_GetStateHash(world, hash);
    return world;
}

static void StopWorld(kiriWorld* world, const Host* host)
{
    kiriDestroyWorld(world);
    FUZZ_CHECK(host->bytes == 0, "%lld bytes leak", (long long)host->bytes);
}

void Saved_Try(const Save* save, const Storm* from)
{
    Storm storm = *from;
    Host host;
    uint64_t before = 0;
    storm.world = StartWorld(&host, &before);
    kiriResult result = kiriWorld_Load(storm.world, save->bytes, save->size);
    FUZZ_CHECK(host.peak <= MOST_OF_LOAD, "a load takes %lld bytes", (long long)host.peak);
    if (result == KIRI_OK) {
        Saved_GoOn(&storm);
    } else {
        CheckRefused(storm.world, result, &host, before);
    }
    StopWorld(storm.world, &host);
}

void Saved_Refuse(kiriResult load(kiriWorld* world, const void* context), const void* context)
{
    Host host;
    uint64_t before = 0;
    kiriWorld* world = StartWorld(&host, &before);
    CheckRefused(world, load(world, context), &host, before);
    FUZZ_CHECK(host.peak <= MOST_OF_LOAD, "a load takes %lld bytes", (long long)host.peak);
    StopWorld(world, &host);
}
