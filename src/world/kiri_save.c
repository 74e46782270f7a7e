#include "kiri_save.h"

#include "../core/kiri_hash.h"
#include "../sheet/kiri_sheet_save.h"
#include "kiri_blade.h"

#include <string.h>

/* ---- Tables ------------------------------------------------------------------------------------------------------- */

/* What was found is of the tick at hand alone. */
static const kiriMember PairMembers[] = {
    KIRI_RUN(4, kiriTouchingPair, upper, touches),
    KIRI_DROPPED(kiriTouchingPair, bodies),
    KIRI_DROPPED(kiriTouchingPair, nears),
};
static const kiriRecord PairRecord = KIRI_RECORD(kiriTouchingPair, PairMembers);

static const kiriMember PairsMembers[] = {
    KIRI_PARTS(kiriPairs, pairs, PairRecord), KIRI_ROOM_OF(kiriPairs, next),     KIRI_ROOM_OF(kiriPairs, found),
    KIRI_ROOM_OF(kiriPairs, bodies),          KIRI_ROOM_OF(kiriPairs, order),    KIRI_ROOM_OF(kiriPairs, nears),
    KIRI_ROOM_OF(kiriPairs, islands),         KIRI_ROOM_OF(kiriPairs, calms),    KIRI_ROOM_OF(kiriPairs, touches),
    KIRI_ITEMS(8, kiriPairs, felt),           KIRI_ROOM_OF(kiriPairs, nextFelt),
};
static const kiriRecord PairsRecord = KIRI_RECORD(kiriPairs, PairsMembers);

static const kiriMember LoopMembers[] = {
    KIRI_BOOLS(kiriLoop, isOpen, isPassed),
    KIRI_RUN(8, kiriLoop, start, then),
};
static const kiriRecord LoopRecord = KIRI_RECORD(kiriLoop, LoopMembers);

static const kiriMember LayerMembers[] = {
    KIRI_RUN(4, kiriLayer, sheet, cut),
    KIRI_RUN(8, kiriLayer, rest, share),
    KIRI_PART(kiriLayer, loop, LoopRecord),
};
static const kiriRecord LayerRecord = KIRI_RECORD(kiriLayer, LayerMembers);

static const kiriMember BladeDataMembers[] = {
    KIRI_RUN(4, kiriBladeData, id, sheet),
    KIRI_BOOLS(kiriBladeData, isPlaced, isPlaced),
    KIRI_RUN(8, kiriBladeData, edge, elapsed),
    KIRI_PARTS(kiriBladeData, layers, LayerRecord),
};
static const kiriRecord BladeDataRecord = KIRI_RECORD(kiriBladeData, BladeDataMembers);

/* The owner of a slot is found by its id. */
static const kiriMember SlotMembers[] = {
    KIRI_DROPPED(kiriSlot, owner),
    KIRI_RUN(4, kiriSlot, index, generation),
};
static const kiriRecord SlotRecord = KIRI_RECORD(kiriSlot, SlotMembers);

static const kiriMember PoolMembers[] = {
    KIRI_RUN(4, kiriPool, kind, freeCount),
    KIRI_PARTS(kiriPool, slots, SlotRecord),
};
static const kiriRecord PoolRecord = KIRI_RECORD(kiriPool, PoolMembers);

static const kiriMember MovesMembers[] = {
    KIRI_ROOM_OF(kiriMoves, of),     KIRI_ROOM_OF(kiriMoves, meets), KIRI_ROOM_OF(kiriMoves, order),
    KIRI_ROOM_OF(kiriMoves, parent), KIRI_ROOM_OF(kiriMoves, heads),
};
static const kiriRecord MovesRecord = KIRI_RECORD(kiriMoves, MovesMembers);

/* Times are of this machine. */
static const kiriMember ProfileMembers[] = {
    KIRI_DROPPED(kiriProfile, seconds),
    KIRI_RUN(4, kiriProfile, cutSegments, sheetPairs),
    KIRI_RUN(8, kiriProfile, largestJump, largestFade),
};
static const kiriRecord ProfileRecord = KIRI_RECORD(kiriProfile, ProfileMembers);

/* Hooks stay those of the world that bytes are read into. */
static const kiriMember WorldMembers[] = {
    KIRI_DROPPED(kiriWorld, memory),
    KIRI_DROPPED(kiriWorld, retired),
    KIRI_DROPPED(kiriWorld, log),
    KIRI_DROPPED(kiriWorld, clock),
    KIRI_DROPPED(kiriWorld, tasks),
    KIRI_DROPPED(kiriWorld, user),
    KIRI_DROPPED(kiriWorld, recorder),
    KIRI_RUN(8, kiriWorld, gravity, gravity),
    KIRI_RUN(4, kiriWorld, budget, budget),
    KIRI_RUN(8, kiriWorld, samplesDue, ticks),
    KIRI_RUN(4, kiriWorld, turn, turn),
    KIRI_PART(kiriWorld, sheetIds, PoolRecord),
    KIRI_PART(kiriWorld, cutIds, PoolRecord),
    KIRI_PART(kiriWorld, frameIds, PoolRecord),
    KIRI_PART(kiriWorld, pinIds, PoolRecord),
    KIRI_PART(kiriWorld, obstacleIds, PoolRecord),
    KIRI_PART(kiriWorld, bladeIds, PoolRecord),
    KIRI_SPACE_OF(kiriWorld, sheets),
    KIRI_ROOM_OF(kiriWorld, active),
    KIRI_ROOM_OF(kiriWorld, atWork),
    KIRI_SPACE_OF(kiriWorld, obstacles),
    KIRI_SPACE_OF(kiriWorld, blades),
    KIRI_ITEMS(4, kiriWorld, obstacleOrder),
    KIRI_DROPPED(kiriWorld, obstacleSearch),
    KIRI_DROPPED(kiriWorld, searches),
    KIRI_PART(kiriWorld, pairs, PairsRecord),
    KIRI_PART(kiriWorld, moves, MovesRecord),
    KIRI_ROOM_OF(kiriWorld, skinRanges),
    KIRI_ITEMS(4, kiriWorld, events),
    KIRI_PART(kiriWorld, profile, ProfileRecord),
    KIRI_DROPPED(kiriWorld, stage),
    KIRI_DROPPED(kiriWorld, stageStart),
    KIRI_DROPPED(kiriWorld, errorLine),
};
static const kiriRecord WorldRecord = KIRI_RECORD(kiriWorld, WorldMembers);

/* ---- Both directions ---------------------------------------------------------------------------------------------- */

static void ArchiveSheets(kiriArchive* archive, kiriWorld* world)
{
    for (int32_t i = 0; i < world->sheets.count && !kiriArchive_HasFailed(archive); ++i) {
        if (kiriArchive_Reads(archive)) {
            world->sheets.data[i] = kiriSheet_New(&world->memory);
            archive->isShort |= world->sheets.data[i] == NULL;
        }
        if (world->sheets.data[i] != NULL) {
            kiriSheet_ArchiveStill(archive, world->sheets.data[i]);
        }
        if (world->sheets.data[i] != NULL && !kiriArchive_HasFailed(archive)) {
            kiriSheet_ArchiveLive(archive, world->sheets.data[i], &world->memory);
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
            kiriArchive_Object(archive, &BladeDataRecord, world->blades.data[i]);
        }
    }
}

/* Each thing has the slot of its id, and each slot that is not free has one. */
static void ArchiveWorld(kiriArchive* archive, kiriWorld* world)
{
    archive->memory = &world->memory;
    kiriArchive_Object(archive, &WorldRecord, world);
    for (int32_t i = 0; i < world->obstacles.count && !kiriArchive_HasFailed(archive); ++i) {
        kiriObstacle_Archive(archive, &world->obstacles.data[i], &world->memory);
    }
    ArchiveBlades(archive, world);
    ArchiveSheets(archive, world);
}

/* ---- Ids ---------------------------------------------------------------------------------------------------------- */

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

/* Each thing takes the slot that its id names. */
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

/* ---- The format --------------------------------------------------------------------------------------------------- */

enum { SAVE_VERSION = 1, HEAD_BYTES = 32, SUM_BYTES = 8 };

static const char saveMagic[8] = { 'K', 'i', 'r', 'i', 'S', 'a', 'v', 'e' };

/* What comes before the world; the sum of all bytes comes after it. */
typedef struct SaveHead {
    char magic[8];
    int32_t version, library;
    int64_t size; /* of all bytes */
    uint64_t base;
} SaveHead;

static const kiriMember SaveHeadMembers[] = {
    KIRI_RUN(1, SaveHead, magic, magic),
    KIRI_RUN(4, SaveHead, version, library),
    KIRI_RUN(8, SaveHead, size, base),
};
static const kiriRecord SaveHeadRecord = KIRI_RECORD(SaveHead, SaveHeadMembers);

/* Eight bytes at a time. */
static uint64_t SumBytes(const uint8_t* bytes, int64_t count)
{
    uint64_t sum = KIRI_HASH_START;
    for (int64_t n = 0; n < count; n += 8) {
        uint64_t word = 0;
        for (int64_t k = n; k < n + 8 && k < count; ++k) {
            word |= (uint64_t)bytes[k] << (8 * (k - n));
        }
        kiriHash_Int64(&sum, (int64_t)word);
    }
    return sum;
}

static int64_t MeasureWorld(const kiriWorld* world)
{
    kiriArchive archive = kiriArchive_Measure();
    ArchiveWorld(&archive, (kiriWorld*)(uintptr_t)world); /* which only reads it */
    return HEAD_BYTES + archive.at + SUM_BYTES;
}

kiriResult kiriSave_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    *size = MeasureWorld(world);
    if (bytes == NULL) {
        return KIRI_OK;
    }
    if (capacity < *size) {
        return KIRI_ERROR_ARGUMENT;
    }
    kiriArchive archive = kiriArchive_Write(bytes, *size);
    SaveHead head = { { 0 }, SAVE_VERSION, KIRI_VERSION, *size, 0 };
    memcpy(head.magic, saveMagic, sizeof(saveMagic));
    kiriArchive_Object(&archive, &SaveHeadRecord, &head);
    ArchiveWorld(&archive, (kiriWorld*)(uintptr_t)world);
    uint64_t sum = SumBytes(bytes, archive.at);
    kiriArchive_Numbers(&archive, &sum, 8, 1);
    KIRI_ASSERT(archive.at == *size);
    return KIRI_OK;
}

/* What is wrong with the bytes as such, or null. */
static const char* FaultOfBytes(const uint8_t* bytes, int64_t size)
{
    SaveHead head;
    uint64_t sum;
    kiriArchive archive = kiriArchive_Read(bytes, size, NULL);
    kiriArchive_Object(&archive, &SaveHeadRecord, &head);
    if (archive.isBad || memcmp(head.magic, saveMagic, sizeof(saveMagic)) != 0) {
        return "these bytes are no save of kiriWorld_Save";
    }
    if (head.version != SAVE_VERSION) {
        return "the bytes are of another version of the format";
    }
    if (head.size != size) {
        return "the bytes are not as many as were saved";
    }
    archive = kiriArchive_Read(bytes + size - SUM_BYTES, SUM_BYTES, NULL);
    kiriArchive_Numbers(&archive, &sum, 8, 1);
    return sum == SumBytes(bytes, size - SUM_BYTES) ? NULL : "the bytes are not those that were saved";
}

/* ---- A world from bytes ------------------------------------------------------------------------------------------- */

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

static kiriResult ReadWorld(kiriWorld* made, const uint8_t* bytes, int64_t size)
{
    kiriArchive archive = kiriArchive_Read(bytes + HEAD_BYTES, size - HEAD_BYTES - SUM_BYTES, &made->memory);
    ArchiveWorld(&archive, made);
    kiriArchive_Expect(&archive, archive.at == archive.size);
    kiriArchive_Expect(&archive, kiriArchive_HasFailed(&archive) || ClaimIds(made));
    for (int32_t i = 0; i < made->sheets.count && !kiriArchive_HasFailed(&archive); ++i) {
        archive.isShort |= !kiriSheet_EndReading(made->sheets.data[i]);
    }
    return archive.isBad ? KIRI_ERROR_DATA : archive.isShort ? KIRI_ERROR_MEMORY : KIRI_OK;
}

/* What the host may hold of the old state lives until the next tick. */
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
    world->stage = was.stage;
    memcpy(world->errorLine, was.errorLine, sizeof(was.errorLine));
    kiriMemory_AdoptAll(&world->memory, &made->memory);
}

kiriResult kiriSave_Read(kiriWorld* world, const void* bytes, int64_t size, const char** why)
{
    *why = FaultOfBytes(bytes, size);
    if (*why != NULL) {
        return KIRI_ERROR_DATA;
    }
    kiriWorld made;
    memset(&made, 0, sizeof(made));
    made.memory = kiriMemory_Like(&world->memory);
    kiriResult result = ReadWorld(&made, bytes, size);
    if (result != KIRI_OK) {
        *why = result == KIRI_ERROR_MEMORY ? NULL : "the bytes have a right sum, but no world";
        DropSheets(&made, NULL);
        kiriMemory_FreeAll(&made.memory);
        return result;
    }
    TakeWorld(world, &made);
    return KIRI_OK;
}
