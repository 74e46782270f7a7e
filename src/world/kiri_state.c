#include "kiri_state.h"
#include "../core/kiri_archive.h"
#include "../sheet/kiri_sheet_save.h"
#include "../sheet/kiri_update.h"
#include "kiri_blade.h"
#include "kiri_call.h"

#include <string.h>

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

/* Indices and nears are of the current tick alone. */
KIRI_TABLE(PairTable, kiriTouchingPair, {
    KIRI_WITHIN(-1, 1, kiriTouchingPair, side, side),
    KIRI_WITHIN(0, 1, kiriTouchingPair, touches, touches),
    KIRI_UNHASHED,
    KIRI_RUN(4, kiriTouchingPair, upper, lower),
    KIRI_DROPPED(kiriTouchingPair, bodies, nears),
});

KIRI_TABLE(PairsTable, kiriPairs, {
    KIRI_PARTS(kiriPairs, pairs, PairTable),
    KIRI_UNHASHED,
    KIRI_ROOMS(kiriPairs, next, found, bodies, order, nears, parents, calms),
    KIRI_ROOMS(kiriPairs, touches),
});

KIRI_TABLE(LoopTable, kiriLoop, {
    KIRI_BOOLS(kiriLoop, isOpen, isPassed),
    KIRI_REALS(kiriLoop, start, then),
});

KIRI_TABLE(LayerTable, kiriLayer, {
    KIRI_REALS(kiriLayer, rest, share),
    KIRI_PART(kiriLayer, loop, LoopTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, kiriLayer, sheet, cut),
});

KIRI_TABLE(BladeDataTable, kiriBladeData, {
    KIRI_BOOLS(kiriBladeData, isPlaced, isPlaced),
    KIRI_REALS(kiriBladeData, edge, elapsed),
    KIRI_PARTS(kiriBladeData, layers, LayerTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, kiriBladeData, id, sheet),
});

enum { MOST_GENERATIONS = 127 };

/* Owners are found by their ids. */
KIRI_TABLE(SlotTable, kiriSlot, {
    KIRI_RUN(4, kiriSlot, index, index),
    KIRI_WITHIN(1, MOST_GENERATIONS, kiriSlot, generation, generation),
    KIRI_DROPPED(kiriSlot, owner, owner),
});

KIRI_TABLE(PoolTable, kiriPool, {
    KIRI_RUN(4, kiriPool, kind, freeCount),
    KIRI_PARTS(kiriPool, slots, SlotTable),
});

KIRI_TABLE(MovesTable, kiriMoves, {
    KIRI_ROOMS(kiriMoves, of, meets, order, parent, heads),
});

/* Times are of this machine. */
KIRI_TABLE(ProfileTable, kiriProfile, {
    KIRI_RUN(4, kiriProfile, cutSegments, sheetPairs),
    KIRI_RUN(8, kiriProfile, largestJump, largestFade),
    KIRI_DROPPED(kiriProfile, seconds, seconds),
});

/* Whose turn it is under a budget. */
static void HashTurn(kiriArchive* archive, void* object)
{
    const kiriWorld* world = object;
    bool isLimited = world->budget.triangles > 0 || world->budget.cells > 0 || world->budget.samples > 0;
    int32_t isOdd = isLimited && world->ticks % 2 == 1;
    if (archive->mode == KIRI_ARCHIVE_HASH) {
        kiriArchive_Int32(archive, &isOdd);
    }
}

/* The world that reads keeps its hooks. */
KIRI_TABLE(WorldTable, kiriWorld, {
    KIRI_REALS(kiriWorld, gravity, gravity),
    KIRI_WITHIN(0, INT32_MAX, kiriWorld, budget, budget),
    KIRI_COUNTS(kiriWorld, samplesDue, samplesDue),
    KIRI_WITHIN(0, INT32_MAX, kiriWorld, turn, turn),
    KIRI_PART(kiriWorld, pairs, PairsTable),
    KIRI_CUSTOM(kiriWorld, ticks, HashTurn),
    KIRI_UNHASHED,
    KIRI_COUNTS(kiriWorld, ticks, ticks),
    KIRI_WITHIN(0, INT32_MAX, kiriWorld, newEvents, newEvents),
    KIRI_PART(kiriWorld, sheetIds, PoolTable),
    KIRI_PART(kiriWorld, cutIds, PoolTable),
    KIRI_PART(kiriWorld, frameIds, PoolTable),
    KIRI_PART(kiriWorld, pinIds, PoolTable),
    KIRI_PART(kiriWorld, obstacleIds, PoolTable),
    KIRI_PART(kiriWorld, bladeIds, PoolTable),
    KIRI_SPACE_OF(kiriWorld, sheets),
    KIRI_SPACE_OF(kiriWorld, obstacles),
    KIRI_SPACE_OF(kiriWorld, blades),
    KIRI_ITEMS(4, kiriWorld, obstacleOrder),
    KIRI_ITEMS(4, kiriWorld, events),
    KIRI_DROPPED(kiriWorld, islands, islands),
    KIRI_PART(kiriWorld, moves, MovesTable),
    KIRI_ROOMS(kiriWorld, active, atWork, skinRanges),
    KIRI_PART(kiriWorld, profile, ProfileTable),
    KIRI_KEPT(kiriWorld, memory, retired),
    KIRI_DROPPED(kiriWorld, log, user),
    KIRI_DROPPED(kiriWorld, obstacleSearch, searches),
    KIRI_DROPPED(kiriWorld, begun, logs),
});

/* ---- Both directions --------------------------------------------------------------------------------------------- */

enum { SAVE_VERSION = 3, HEAD_BYTES = 24, SUM_BYTES = 8 };

static void ArchiveSheets(kiriArchive* archive, kiriWorld* world)
{
    for (int32_t i = 0; i < world->sheets.count && !kiriArchive_HasFailed(archive); ++i) {
        if (kiriArchive_Reads(archive)) {
            world->sheets.data[i] = kiriSheet_New(&world->memory);
            archive->isShort |= world->sheets.data[i] == NULL;
        }
        if (world->sheets.data[i] != NULL) {
            kiriSheet_Archive(archive, world->sheets.data[i], &world->memory);
        }
    }
}

static void ArchiveBlades(kiriArchive* archive, kiriWorld* world)
{
    for (int32_t i = 0; i < world->blades.count && !kiriArchive_HasFailed(archive); ++i) {
        if (kiriArchive_Reads(archive)) {
            world->blades.data[i] = kiriMemory_AllocZeroed(&world->memory, sizeof(kiriBladeData));
            archive->isShort |= world->blades.data[i] == NULL;
        }
        if (world->blades.data[i] != NULL) {
            kiriArchive_Object(archive, &BladeDataTable, world->blades.data[i]);
        }
    }
}

static void ArchiveWorld(kiriArchive* archive, kiriWorld* world)
{
    archive->memory = &world->memory;
    kiriArchive_Object(archive, &WorldTable, world);
    for (int32_t i = 0; i < world->obstacles.count && !kiriArchive_HasFailed(archive); ++i) {
        kiriObstacle_Archive(archive, &world->obstacles.data[i], &world->memory);
    }
    ArchiveBlades(archive, world);
    ArchiveSheets(archive, world);
}

/* ---- Ids --------------------------------------------------------------------------------------------------------- */

static bool ClaimIdsOfSheet(kiriWorld* world, kiriSheetData* sheet)
{
    bool ok = kiriPool_Claim(&world->sheetIds, sheet->id, sheet, 0);
    for (int32_t f = 0; ok && f < sheet->frames.count; ++f) {
        /* Those of pieces that the host has destroyed are stale. */
        ok = kiriSheet_IsGone(sheet, f) || kiriPool_Claim(&world->frameIds, sheet->frames.data[f].id, sheet, f);
    }
    for (int32_t p = 0; ok && p < sheet->pins.count; ++p) {
        ok = kiriPool_Claim(&world->pinIds, sheet->pins.data[p].id, sheet, p);
    }
    for (int32_t c = 0; ok && c < sheet->cuts.count; ++c) {
        ok = kiriPool_Claim(&world->cutIds, sheet->cuts.data[c]->id, sheet->cuts.data[c], 0);
    }
    return ok;
}

/* Gives each object the slot that its id names. */
static bool ClaimIds(kiriWorld* world)
{
    bool ok = true;
    for (int32_t i = 0; i < world->obstacles.count; ++i) {
        ok = ok && kiriPool_Claim(&world->obstacleIds, world->obstacles.data[i]->id, world->obstacles.data[i], 0);
    }
    for (int32_t i = 0; i < world->blades.count; ++i) {
        ok = ok && kiriPool_Claim(&world->bladeIds, world->blades.data[i]->id, world->blades.data[i], 0);
    }
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        ok = ok && ClaimIdsOfSheet(world, world->sheets.data[i]);
    }
    return ok;
}

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

/* Free slots are in one list, and have no owners. */
static bool IsPool(const kiriPool* pool, uint32_t kind)
{
    bool isFine = pool->kind == kind && pool->freeCount >= 0;
    int32_t slot = pool->freeSlot;
    for (int32_t k = 0; isFine && k < pool->freeCount; ++k) {
        isFine = slot >= 0 && slot < pool->slots.count && pool->slots.data[slot].owner == NULL;
        slot = isFine ? pool->slots.data[slot].index : slot;
    }
    return isFine && slot == KIRI_NONE;
}

static bool IsWorld(const kiriWorld* world)
{
    int32_t sheets = world->sheets.count;
    return IsPool(&world->sheetIds, KIRI_KIND_SHEET) && IsPool(&world->cutIds, KIRI_KIND_CUT) &&
           IsPool(&world->frameIds, KIRI_KIND_FRAME) && IsPool(&world->pinIds, KIRI_KIND_PIN) &&
           IsPool(&world->obstacleIds, KIRI_KIND_OBSTACLE) && IsPool(&world->bladeIds, KIRI_KIND_BLADE) &&
           world->active.capacity >= sheets && world->atWork.capacity >= sheets &&
           world->newEvents <= world->events.count;
}

/* Returns true if the cut of each layer belongs to the sheet of the layer. */
static bool AreLayers(const kiriWorld* world, const kiriBladeData* blade)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < blade->layers.count; ++k) {
        const kiriLayer* layer = &blade->layers.data[k];
        const kiriSlot* cut = kiriPool_Find(&world->cutIds, layer->cut);
        areFine = cut == NULL || ((const kiriCutData*)cut->owner)->sheet->id == layer->sheet;
    }
    return areFine;
}

/* Returns true if settings are legal, and leaving pieces are pieces of this sheet. */
static bool IsSheet(const kiriWorld* world, const kiriSheetData* sheet)
{
    const kiriSettings* settings = &sheet->settings;
    const kiriSheetSettings* given = &settings->given;
    kiriFault fault;
    bool isFine = kiriStruct_Check(&kiriSettingsStruct, "", NULL, given, &fault) == KIRI_OK &&
                  memcmp(&given->material, &settings->material, sizeof(given->material)) == 0 &&
                  given->iterations == settings->iterations && given->skinning == settings->skinning &&
                  given->timeStepping == settings->mechanics.timeStepping;
    for (int32_t k = 0; isFine && k < sheet->leaving.count; ++k) {
        const kiriSlot* slot = kiriPool_Find(&world->frameIds, sheet->leaving.data[k]);
        isFine = slot == NULL || slot->owner == sheet;
    }
    return isFine;
}

/* ---- The format -------------------------------------------------------------------------------------------------- */

static const char saveMagic[8] = { 'K', 'i', 'r', 'i', 'S', 'a', 'v', 'e' };

/* Precedes the world. The sum of all bytes follows it. */
typedef struct SaveHead {
    char magic[8];
    int32_t version, library;
    int64_t size; /* of all bytes */
} SaveHead;

KIRI_TABLE(SaveHeadTable, SaveHead, {
    KIRI_RUN(1, SaveHead, magic, magic),
    KIRI_RUN(4, SaveHead, version, library),
    KIRI_RUN(8, SaveHead, size, size),
});

static uint64_t WordAt(const uint8_t* b, int64_t count)
{
    uint64_t word = 0;
    if (count >= 8) { /* compilers read these bytes at once */
        return b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 | (uint64_t)b[4] << 32 |
               (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 | (uint64_t)b[7] << 56;
    }
    for (int64_t k = 0; k < count; ++k) {
        word |= (uint64_t)b[k] << (8 * k);
    }
    return word;
}

static uint64_t SumBytes(const uint8_t* bytes, int64_t count)
{
    uint64_t sum = KIRI_HASH_START;
    for (int64_t n = 0; n < count; n += 8) {
        kiriHash_Int64(&sum, (int64_t)WordAt(bytes + n, count - n));
    }
    return sum;
}

static kiriWorld* Unlocked(const kiriWorld* world)
{
    return (kiriWorld*)(uintptr_t)world; /* archives that do not read bytes change nothing */
}

/* Returns the fault of the bytes, or null. */
static const char* FaultOfBytes(const uint8_t* bytes, int64_t size)
{
    SaveHead head;
    kiriArchive archive = kiriArchive_Read(bytes, size, NULL);
    kiriArchive_Object(&archive, &SaveHeadTable, &head);
    if (archive.isBad || memcmp(head.magic, saveMagic, sizeof(head.magic)) != 0) {
        return "these bytes are no save of kiriWorld_Save";
    }
    if (head.version != SAVE_VERSION || head.library != KIRI_VERSION) {
        return "the bytes are of another version of the library";
    }
    if (head.size != size || size < HEAD_BYTES + SUM_BYTES) {
        return "the bytes are not as many as were saved";
    }
    bool isSame = WordAt(bytes + size - SUM_BYTES, SUM_BYTES) == SumBytes(bytes, size - SUM_BYTES);
    return isSame ? NULL : "the bytes are not those that were saved";
}

kiriResult kiriSave_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    *size = 0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (world->sheets.data[i]->update->stage != KIRI_NONE) {
            return KIRI_PENDING;
        }
    }
    kiriArchive archive = kiriArchive_Measure();
    ArchiveWorld(&archive, Unlocked(world));
    *size = HEAD_BYTES + archive.at + SUM_BYTES;
    if (bytes == NULL || capacity < *size) {
        return bytes == NULL ? KIRI_OK : KIRI_ERROR_ARGUMENT;
    }
    SaveHead head = { { 0 }, SAVE_VERSION, KIRI_VERSION, *size };
    memcpy(head.magic, saveMagic, sizeof(head.magic));
    archive = kiriArchive_Write(bytes, *size);
    kiriArchive_Object(&archive, &SaveHeadTable, &head);
    ArchiveWorld(&archive, Unlocked(world));
    uint64_t sum = SumBytes(bytes, archive.at);
    kiriArchive_Numbers(&archive, &sum, 8, 1);
    KIRI_ASSERT(!archive.isBad && archive.at == *size);
    return KIRI_OK;
}

/* ---- A world from bytes ------------------------------------------------------------------------------------------ */

static void DropSheets(kiriWorld* world, kiriMemory* shown)
{
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (world->sheets.data[i] != NULL && shown != NULL) {
            kiriMemory_AdoptAll(shown, &world->sheets.data[i]->shown);
        }
        kiriSheet_Delete(world->sheets.data[i], &world->memory);
    }
    world->sheets.count = 0;
}

/* Checks the fields of a save, and derives the others. */
static void FinishSave(kiriArchive* archive, kiriWorld* made)
{
    kiriArchive_Expect(archive, kiriArchive_HasFailed(archive) || IsWorld(made));
    for (int32_t i = 0; i < made->sheets.count && !kiriArchive_HasFailed(archive); ++i) {
        kiriArchive_Expect(archive, IsSheet(made, made->sheets.data[i]));
        if (!kiriArchive_HasFailed(archive)) {
            kiriSheet_Derive(made->sheets.data[i], archive);
        }
    }
    for (int32_t i = 0; i < made->blades.count && !kiriArchive_HasFailed(archive); ++i) {
        kiriArchive_Expect(archive, AreLayers(made, made->blades.data[i]));
    }
}

static kiriResult ReadWorld(kiriWorld* made, const uint8_t* bytes, int64_t size, bool isWhole)
{
    kiriArchive archive = kiriArchive_Read(bytes, size, &made->memory);
    archive.isWhole = isWhole;
    archive.room = isWhole ? INT64_MAX : archive.room;
    ArchiveWorld(&archive, made);
    kiriArchive_Expect(&archive, archive.at == archive.size);
    kiriArchive_Expect(&archive, kiriArchive_HasFailed(&archive) || ClaimIds(made));
    if (!isWhole) {
        FinishSave(&archive, made);
    }
    for (int32_t i = 0; i < made->sheets.count && !kiriArchive_HasFailed(&archive); ++i) {
        archive.isShort |= !kiriSheet_EndReading(made->sheets.data[i], isWhole);
    }
    return archive.isBad ? KIRI_ERROR_DATA : archive.isShort ? KIRI_ERROR_MEMORY : KIRI_OK;
}

/* Arrays of the old state that the host may hold live until the next tick. */
static void TakeWorld(kiriWorld* world, kiriWorld* made)
{
    DropSheets(world, &world->retired);
    kiriMemory_AdoptAll(&world->retired, &world->memory);
    kiriWorld was = *world;
    *world = *made;
    world->memory = was.memory;
    world->retired = was.retired;
    world->log = was.log;
    world->clock = was.clock;
    world->tasks = was.tasks;
    world->user = was.user;
    world->recorder = was.recorder;
    world->begun = was.begun;
    world->stage = was.stage;
    world->isBusy = was.isBusy;
    memcpy(world->errorLine, was.errorLine, sizeof(was.errorLine));
    kiriMemory_AdoptAll(&world->memory, &made->memory);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        world->sheets.data[i]->past = kiriPast_None(world->begun);
    }
}

/* Reads a world from the bytes between the header and the checksum. */
static kiriResult BecomeWorld(kiriWorld* world, const uint8_t* bytes, int64_t size, bool isWhole)
{
    kiriWorld made;
    memset(&made, 0, sizeof(made));
    made.memory = kiriMemory_Like(&world->memory);
    kiriResult result = ReadWorld(&made, bytes, size, isWhole);
    if (result == KIRI_OK) {
        TakeWorld(world, &made);
    } else {
        DropSheets(&made, NULL);
        kiriMemory_FreeAll(&made.memory);
    }
    return result;
}

kiriResult kiriSave_Read(kiriWorld* world, const void* bytes, int64_t size, const char** why)
{
    *why = FaultOfBytes(bytes, size);
    if (*why != NULL) {
        return KIRI_ERROR_DATA;
    }
    kiriResult result = BecomeWorld(world, (const uint8_t*)bytes + HEAD_BYTES, size - HEAD_BYTES - SUM_BYTES, false);
    *why = result == KIRI_ERROR_DATA ? "the bytes have a right sum, but no world" : NULL;
    return result;
}

/* ---- Snapshots --------------------------------------------------------------------------------------------------- */

/* Comes before the world. Bytes of another build, or of another layout, do not match. */
typedef struct SnapshotHead {
    char magic[8];
    uint64_t layout;
    int64_t size;
} SnapshotHead;

static SnapshotHead HeadOfSnapshot(int64_t size)
{
    SnapshotHead head = { { 'K', 'i', 'r', 'i', 'S', 'n', 'a', 'p' }, KIRI_HASH_START, size };
    kiriHash_Int32(&head.layout, KIRI_VERSION);
    kiriArchive_HashLayout(&WorldTable, &head.layout);
    kiriArchive_HashLayout(&BladeDataTable, &head.layout);
    kiriSheet_HashLayout(&head.layout);
    return head;
}

kiriResult kiriSnapshot_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    kiriArchive archive = kiriArchive_Measure();
    archive.isWhole = true;
    ArchiveWorld(&archive, Unlocked(world));
    *size = (int64_t)sizeof(SnapshotHead) + archive.at;
    if (bytes == NULL || capacity < *size) {
        return bytes == NULL ? KIRI_OK : KIRI_ERROR_ARGUMENT;
    }
    SnapshotHead head = HeadOfSnapshot(*size);
    memcpy(bytes, &head, sizeof(head));
    archive = kiriArchive_Write((uint8_t*)bytes + sizeof(head), *size - (int64_t)sizeof(head));
    archive.isWhole = true;
    ArchiveWorld(&archive, Unlocked(world));
    KIRI_ASSERT(!archive.isBad && archive.at == archive.size);
    return KIRI_OK;
}

kiriResult kiriSnapshot_Read(kiriWorld* world, const void* bytes, int64_t size)
{
    const SnapshotHead head = HeadOfSnapshot(size);
    if (size < (int64_t)sizeof(head) || memcmp(bytes, &head, sizeof(head)) != 0) {
        return KIRI_ERROR_DATA;
    }
    return BecomeWorld(world, (const uint8_t*)bytes + sizeof(head), size - (int64_t)sizeof(head), true);
}

/* ---- The state hash ---------------------------------------------------------------------------------------------- */

/* How far the work on a cut has come. Which items are done follows from their number. Work that a refused allocation
   repeats counts if it can change when a cut takes effect. */
static void HashWork(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    KIRI_ASSERT(!sheet->mesh.isOpen);
    bool isLimited = world->budget.cells > 0 || world->budget.samples > 0;
    kiriHash_Int32(hash, isLimited && sheet->settings.fromScratch);
    kiriHash_Int32(hash, (isLimited || u->stage != KIRI_NONE) && (u->needsRebuild || u->isScratch));
    kiriHash_Int32(hash, u->stage);
    if (u->stage != KIRI_NONE) {
        kiriHash_Int32(hash, u->step);
        kiriHash_Int64(hash, u->spent);
        kiriHash_Int64(hash, world->ticks - u->cut.stamp);
        kiriHash_Int32(hash, u->cut.count);
        kiriHash_Int32(hash, u->cut.taken);
        kiriHash_Int32(hash, u->cut.meshChanged);
        kiriHash_Int32(hash, u->cut.settlesSites);
        kiriGrid_HashProgress(&sheet->grid, hash);
        kiriShape_HashProgress(&sheet->shape, hash);
    }
}

uint64_t kiriStateHash_Of(const kiriWorld* world)
{
    kiriArchive archive = kiriArchive_Hash();
    ArchiveWorld(&archive, Unlocked(world));
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        HashWork(&archive.hash, world, world->sheets.data[i]);
    }
    return archive.hash;
}
