/* Saves that somebody has made to do harm. The input changes some bytes of a good save, or of a difference, of a world to
   which a storm has happened, and the sum is made right. Such bytes are refused, and then nothing has changed; or what comes
   of them is a world that goes on: it ticks, is cut, is read and saved. It may move in any way, but it reads and writes no
   memory that is not its own, ends each call, and gives all memory back. */
#include "fuzz.h"
#include "storm.h"

#include "core/kiri_hash.h"

#include <stdlib.h>
#include <string.h>

enum { MOST_HELD = 256 << 20, SUM_BYTES = 8, HEAD_BYTES = 32, WORLDS = 96, MOST_CHANGES = 6 };

/* ---- A host that counts ---- */

typedef struct LoadHost {
    int64_t held;
} LoadHost;

static void* Allocate(void* user, int64_t bytes)
{
    LoadHost* host = user;
    int64_t* block = host->held + bytes <= MOST_HELD ? malloc((size_t)bytes + 16) : NULL;
    if (block == NULL) {
        return NULL;
    }
    host->held += bytes;
    *block = bytes;
    return memset(block + 2, 0xcd, (size_t)bytes);
}

static void Free(void* user, void* pointer)
{
    if (pointer != NULL) {
        int64_t* block = (int64_t*)pointer - 2;
        ((LoadHost*)user)->held -= *block;
        free(block);
    }
}

static kiriWorldDef DefOf(LoadHost* host)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.alloc = Allocate;
    def.free = Free;
    def.user = host;
    return def;
}

/* ---- Good saves ---- */

typedef struct Save {
    uint8_t* bytes;
    int64_t size;
} Save;

/* Of a storm: a save, a later one, and the difference between these. */
typedef struct Saved {
    Storm storm;
    Save base, later, difference;
} Saved;

static Saved worlds[WORLDS];

static Save SaveWorld(const kiriWorld* world, const Save* base)
{
    Save save = { NULL, 0 };
    for (int pass = 0; pass < 2; ++pass) {
        int64_t room = save.size;
        kiriResult result =
            base == NULL ? kiriWorld_Save(world, save.bytes, room, &save.size)
                         : kiriWorld_SaveDifference(world, base->bytes, base->size, save.bytes, room, &save.size);
        FUZZ_CHECK(result == KIRI_OK, "%s", kiriWorld_GetLastError(world));
        save.bytes = pass == 0 ? malloc((size_t)save.size) : save.bytes;
        FUZZ_CHECK(save.bytes != NULL, "no memory for a save");
    }
    return save;
}

/* Small, so that of what is changed much matters. */
static void AddSmallSheet(Storm* storm)
{
    enum { SQUARES = 4, CORNERS = SQUARES + 1 };
    float positions[2 * CORNERS * CORNERS];
    int32_t indices[6 * SQUARES * SQUARES];
    FUZZ_CHECK(kiriFillRectangle(1.0f, 1.0f, SQUARES, SQUARES, positions, indices) == KIRI_OK, "no rectangle");
    const StormType* type = storm->type;
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = CORNERS * CORNERS;
    def.triangleCount = 2 * SQUARES * SQUARES;
    def.position[2] = 0.1f * (float)storm->sheetCount;
    def.gridResolution = 8 + (int32_t)Storm_Random(storm, 4);
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
static void StartStorm(Storm* storm, int32_t index, LoadHost* host)
{
    static const kiriBudget budgets[] = { { 64, 5, 3, 2 }, { 64, 60, 2, 0 }, { 200, 15, 20, 0 }, { 64, 150, 60, 8 } };
    kiriWorldDef def = DefOf(host);
    memset(storm, 0, sizeof(*storm));
    storm->type = &Storm_Types[index % STORM_TYPES];
    storm->seed = 1 + (uint32_t)index;
    FUZZ_CHECK(kiriCreateWorld(&def, &storm->world) == KIRI_OK, "no world");
    AddSmallSheet(storm);
    if (storm->type->touches) {
        AddSmallSheet(storm);
    }
    for (int32_t i = 0; storm->type->obstacles && i < STORM_OBSTACLES; ++i) {
        Storm_AddObstacle(storm);
    }
    if (index >= STORM_TYPES) {
        FUZZ_CHECK(kiriWorld_SetBudget(storm->world, &budgets[index % 4]) == KIRI_OK, "no budget");
    }
}

static const Saved* GetWorld(int32_t index)
{
    Saved* saved = &worlds[index];
    if (saved->base.bytes == NULL) {
        LoadHost host = { 0 };
        StartStorm(&saved->storm, index, &host);
        for (int32_t tick = 0; tick < 3 + index / 4; ++tick) {
            Storm_Tick(&saved->storm);
        }
        saved->base = SaveWorld(saved->storm.world, NULL);
        Storm_Tick(&saved->storm);
        saved->later = SaveWorld(saved->storm.world, NULL);
        saved->difference = SaveWorld(saved->storm.world, &saved->base);
        kiriDestroyWorld(saved->storm.world);
        saved->storm.world = NULL;
    }
    return saved;
}

/* ---- Bytes that are changed ---- */

static int64_t GetWord(const uint8_t* bytes)
{
    return (int32_t)((uint32_t)bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 |
                     (uint32_t)bytes[3] << 24);
}

static void PutWord(uint8_t* bytes, int64_t word)
{
    for (int k = 0; k < 4; ++k) {
        bytes[k] = (uint8_t)((uint64_t)word >> 8 * k);
    }
}

/* Most numbers are floats: from some place on, where the next index or count seems to be. */
static int64_t FindSmall(const Save* save, int64_t at)
{
    int64_t end = save->size - SUM_BYTES - 4;
    while (at < end && (GetWord(save->bytes + at) < -1 || GetWord(save->bytes + at) > 1 << 20)) {
        ++at;
    }
    return at;
}

static void PutOddDouble(uint8_t* bytes, uint32_t choice)
{
    static const double odd[] = { 0.0, -1.0, 1e-300, 1e300, -1e30, 1e10 };
    double value = odd[choice % 6];
    uint64_t bits = choice % 8 == 6 ? UINT64_C(0x7ff8000000000000) : UINT64_C(0xfff0000000000000);
    memcpy(bytes, choice % 8 < 6 ? (const void*)&value : (const void*)&bits, 8);
}

static void Change(FuzzBytes* bytes, Save* save)
{
    static const int32_t odd[] = { 0, 1, -1, -2, INT32_MAX, INT32_MIN, 65536, 1 << 24 };
    uint32_t kind = FuzzBytes_Get(bytes), value = FuzzBytes_Get(bytes);
    int64_t length = save->size - HEAD_BYTES - SUM_BYTES - 8;
    int64_t at = HEAD_BYTES + (int64_t)(FuzzBytes_GetSome(bytes, 4) % (uint64_t)length), small = FindSmall(save, at);
    int64_t from = HEAD_BYTES + (int64_t)(FuzzBytes_GetSome(bytes, 3) % (uint64_t)length);
    switch (kind % 8) {
    case 0:
        save->bytes[at] ^= (uint8_t)(1 << value % 8);
        break;
    case 1:
        PutOddDouble(save->bytes + at, value);
        break;
    case 2:
        PutWord(save->bytes + small, odd[value % 8]);
        break;
    case 3:
        PutWord(save->bytes + small, GetWord(save->bytes + FindSmall(save, from)));
        break;
    default:
        PutWord(save->bytes + small, GetWord(save->bytes + small) + (int64_t)(value % 16) - 8 + (value % 16 >= 8));
        break;
    }
}

/* As the library makes it: all bytes before it, eight at a time. */
static void MendSum(Save* save)
{
    uint64_t sum = KIRI_HASH_START;
    int64_t count = save->size - SUM_BYTES;
    for (int64_t n = 0; n < count; n += 8) {
        uint64_t word = 0;
        for (int64_t k = 0; k < 8 && n + k < count; ++k) {
            word |= (uint64_t)save->bytes[n + k] << 8 * k;
        }
        kiriHash_Int64(&sum, (int64_t)word);
    }
    PutWord(save->bytes + count, (int64_t)(sum & 0xffffffff));
    PutWord(save->bytes + count + 4, (int64_t)(sum >> 32));
}

static Save Copy(const Save* save)
{
    Save copy = { malloc((size_t)save->size), save->size };
    FUZZ_CHECK(copy.bytes != NULL, "no memory for a copy");
    memcpy(copy.bytes, save->bytes, (size_t)save->size);
    return copy;
}

/* ---- What comes of them ---- */

/* As its budget has it, and then so that the work at hand is done. */
static void GoOn(Storm* storm)
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
    Save save = SaveWorld(storm->world, NULL);
    free(save.bytes);
}

static kiriResult Load(kiriWorld* world, const Saved* saved, const Save* changed, int32_t which)
{
    switch (which) {
    case 0:
        return kiriWorld_Load(world, changed->bytes, changed->size);
    case 1:
        return kiriWorld_LoadDifference(world, saved->base.bytes, saved->base.size, changed->bytes, changed->size);
    default:
        return kiriWorld_LoadDifference(world, changed->bytes, changed->size, saved->difference.bytes,
                                        saved->difference.size);
    }
}

/* A difference names the sum of its base. */
static void NameBase(Save* difference, const Save* base)
{
    memcpy(difference->bytes + HEAD_BYTES - 8, base->bytes + base->size - SUM_BYTES, SUM_BYTES);
    MendSum(difference);
}

static kiriResult LoadChanged(kiriWorld* world, const Saved* saved, FuzzBytes* bytes)
{
    int32_t which = FuzzBytes_Below(bytes, 5), count = 1 + FuzzBytes_Below(bytes, MOST_CHANGES);
    which = which < 3 ? 0 : which - 2;
    Saved used = *saved;
    Save changed = Copy(which == 0 ? &saved->later : which == 1 ? &saved->difference : &saved->base);
    for (int32_t k = 0; k < count && !FuzzBytes_AtEnd(bytes); ++k) {
        Change(bytes, &changed);
    }
    MendSum(&changed);
    if (which == 2) {
        used.difference = Copy(&saved->difference);
        NameBase(&used.difference, &changed);
    }
    kiriResult result = Load(world, &used, &changed, which);
    if (which == 2) {
        free(used.difference.bytes);
    }
    free(changed.bytes);
    return result;
}

int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size)
{
    FuzzBytes bytes = { data, size, 0, 0.0f };
    const Saved* saved = GetWorld(FuzzBytes_Below(&bytes, WORLDS));
    Storm storm = saved->storm;
    LoadHost host = { 0 };
    kiriWorldDef def = DefOf(&host);
    uint64_t before = 0, after = 0;
    FUZZ_CHECK(kiriCreateWorld(&def, &storm.world) == KIRI_OK, "no world");
    kiriWorld_GetStateHash(storm.world, &before);
    kiriResult result = LoadChanged(storm.world, saved, &bytes);
    if (result == KIRI_OK) {
        GoOn(&storm);
    } else {
        FUZZ_CHECK(result == KIRI_ERROR_DATA || result == KIRI_ERROR_MEMORY, "a load returns %d", (int)result);
        kiriWorld_GetStateHash(storm.world, &after);
        FUZZ_CHECK(before == after, "a load that failed has changed the world");
    }
    kiriDestroyWorld(storm.world);
    FUZZ_CHECK(host.held == 0, "%lld bytes leak", (long long)host.held);
    return 0;
}
