#include "kiri_state.h"
#include "../core/kiri_archive.h"
#include "../sheet/kiri_sheet_save.h"
#include "../sheet/kiri_update.h"
#include "kiri_blade.h"
#include "kiri_call.h"
#include "kiri_part.h"
#include "kiri_seam.h"

#include <float.h>

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

/* Indices and nears are of the current tick alone. */
KIRI_TABLE(PairTable, kiriTouchingPair, {
    KIRI_WITHIN(-1, 1, side),
    KIRI_WITHIN(0, 1, touches),
    KIRI_UNHASHED,
    KIRI_RUN(4, ids),
    KIRI_DROPPED(nears),
})

KIRI_TABLE(PairsTable, kiriPairs, {
    KIRI_PARTS(pairs, PairTable),
    KIRI_UNHASHED,
    KIRI_ROOMS(next, found, bodies, order, nears, parents, calms),
    KIRI_ROOMS(touches),
})

KIRI_TABLE(LoopTable, kiriLoop, {
    KIRI_BOOLS(isOpen, isPassed),
    KIRI_REALS(start, then),
})

KIRI_TABLE(LayerTable, kiriLayer, {
    KIRI_REALS(rest, at),
    KIRI_PART(loop, LoopTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, sheet, cut),
})

KIRI_TABLE(BladeDataTable, kiriBladeData, {
    KIRI_BOOLS(isPlaced),
    KIRI_REALS(edge),
    KIRI_RUN(4, ticks),
    KIRI_PARTS(layers, LayerTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, id, sheet),
})

KIRI_TABLE(StitchTable, kiriStitchData, {
    KIRI_RUN(4, at),
    KIRI_REALS(inward, force),
    KIRI_RUN(4, number, next),
    KIRI_UNHASHED,
    KIRI_RUN(4, frames),
})

KIRI_TABLE(CornerTable, kiriSeamCorner, {
    KIRI_RUN(4, stitch),
    KIRI_REALS(part),
    KIRI_RUN(4, at),
})

KIRI_TABLE(SeamTable, kiriSeamData, {
    KIRI_REALS(breakForce, restAngle),
    KIRI_BOOLS(bends),
    KIRI_PARTS(stitches, StitchTable),
    KIRI_PARTS(corners, CornerTable),
    KIRI_UNHASHED,
    KIRI_RUN(4, id),
    KIRI_ROOM_OF(rows),
    KIRI_DROPPED(weld),
})

enum { MOST_GENERATIONS = 127 };

/* Owners are found by their ids. */
KIRI_TABLE(SlotTable, kiriSlot, {
    KIRI_RUN(4, index),
    KIRI_WITHIN(1, MOST_GENERATIONS, generation),
    KIRI_DROPPED(owner),
})

KIRI_TABLE(PoolTable, kiriPool, {
    KIRI_RUN(4, kind, freeCount),
    KIRI_PARTS(slots, SlotTable),
})

KIRI_TABLE(MovesTable, kiriMoves, {
    KIRI_ROOMS(of, order, parent, heads),
})

/* Times are of this machine. */
KIRI_TABLE(ProfileTable, kiriProfile, {
    KIRI_RUN(4, cutSegments, sheetPairs),
    KIRI_RUN(8, largestJump, largestFade),
    KIRI_DROPPED(seconds),
})

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
    KIRI_REALS(gravity),
    KIRI_WITHIN(0, INT32_MAX, budget),
    KIRI_COUNTS(samplesDue),
    KIRI_WITHIN(0, INT32_MAX, turn),
    KIRI_PART(pairs, PairsTable),
    KIRI_CUSTOM(ticks, HashTurn),
    KIRI_UNHASHED,
    KIRI_COUNTS(ticks),
    KIRI_WITHIN(0, INT32_MAX, newEvents),
    KIRI_PART(sheetIds, PoolTable),
    KIRI_PART(cutIds, PoolTable),
    KIRI_PART(frameIds, PoolTable),
    KIRI_PART(pinIds, PoolTable),
    KIRI_PART(obstacleIds, PoolTable),
    KIRI_PART(bladeIds, PoolTable),
    KIRI_PART(seamIds, PoolTable),
    KIRI_SPACE_OF(sheets),
    KIRI_SPACE_OF(obstacles),
    KIRI_SPACE_OF(blades),
    KIRI_SPACE_OF(seams),
    KIRI_ITEMS(4, obstacleOrder),
    KIRI_ITEMS(4, events),
    KIRI_DROPPED(islands),
    KIRI_PART(moves, MovesTable),
    KIRI_ROOMS(active, atWork, skinRanges),
    KIRI_ROOM_OF(weldNear),
    KIRI_PART(profile, ProfileTable),
    KIRI_KEPT(memory, retired),
    KIRI_DROPPED(log, user),
    KIRI_DROPPED(obstacleSearch, searches),
    KIRI_DROPPED(begun, logs),
})

/* ---- Both directions --------------------------------------------------------------------------------------------- */

enum { SAVE_VERSION = 5, HEAD_BYTES = 24, SUM_BYTES = 8 };

static void ArchiveSheets(kiriArchive* archive, kiriWorld* world)
{
    KIRI_EACH_WHILE(!kiriArchive_HasFailed(archive), kiriSheetData*, sheet, world->sheets) {
        if (kiriArchive_Reads(archive)) {
            *sheet = kiriSheet_New(&world->memory);
            archive->isShort |= *sheet == NULL;
        }
        if (*sheet != NULL) {
            kiriSheet_Archive(archive, *sheet, &world->memory);
        }
    }
}

/* Moves a struct in a block of the world's memory, to which `pointer` points. */
static void ArchiveBlock(kiriArchive* archive, kiriMemory* memory, void* pointer, kiriTableFn* table)
{
    void* object;
    memcpy(&object, pointer, sizeof(object));
    if (kiriArchive_Reads(archive)) {
        object = kiriMemory_AllocZeroed(memory, table()->size);
        archive->isShort |= object == NULL;
        memcpy(pointer, &object, sizeof(object));
    }
    if (object != NULL) {
        kiriArchive_Object(archive, table, object);
    }
}

static void ArchiveWorld(kiriArchive* archive, kiriWorld* world)
{
    archive->memory = &world->memory;
    kiriArchive_Object(archive, WorldTable, world);
    KIRI_EACH_WHILE(!kiriArchive_HasFailed(archive), kiriObstacleData*, obstacle, world->obstacles) {
        kiriObstacle_Archive(archive, obstacle, &world->memory);
    }
    KIRI_EACH_WHILE(!kiriArchive_HasFailed(archive), kiriBladeData*, blade, world->blades) {
        ArchiveBlock(archive, &world->memory, blade, BladeDataTable);
    }
    KIRI_EACH_WHILE(!kiriArchive_HasFailed(archive), kiriSeamData*, seam, world->seams) {
        ArchiveBlock(archive, &world->memory, seam, SeamTable);
    }
    ArchiveSheets(archive, world);
}

/* ---- Ids --------------------------------------------------------------------------------------------------------- */

static bool ClaimIdsOfSheet(kiriWorld* world, kiriSheetData* sheet)
{
    bool ok = kiriPool_Claim(&world->sheetIds, sheet->id, sheet, 0);
    KIRI_EACH_INDEX_WHILE(ok, f, sheet->frames) {
        /* Those of pieces that the host has destroyed are stale. */
        ok = kiriSheet_IsGone(sheet, f) || kiriPool_Claim(&world->frameIds, sheet->frames.data[f].id, sheet, f);
    }
    KIRI_EACH_INDEX_WHILE(ok, p, sheet->pins) {
        ok = kiriPool_Claim(&world->pinIds, sheet->pins.data[p].id, sheet, p);
    }
    KIRI_EACH_OF_WHILE(ok, kiriCutData, cut, sheet->cuts) {
        ok = kiriPool_Claim(&world->cutIds, cut->id, cut, 0);
    }
    return ok;
}

/* Gives each object the slot that its id names. */
static bool ClaimIds(kiriWorld* world)
{
    bool ok = true;
    KIRI_EACH_OF_WHILE(ok, kiriObstacleData, obstacle, world->obstacles) {
        ok = kiriPool_Claim(&world->obstacleIds, obstacle->id, obstacle, 0);
    }
    KIRI_EACH_OF_WHILE(ok, kiriBladeData, blade, world->blades) {
        ok = kiriPool_Claim(&world->bladeIds, blade->id, blade, 0);
    }
    KIRI_EACH_OF_WHILE(ok, kiriSeamData, seam, world->seams) {
        ok = kiriPool_Claim(&world->seamIds, seam->id, seam, 0);
    }
    KIRI_EACH_OF_WHILE(ok, kiriSheetData, sheet, world->sheets) {
        ok = ClaimIdsOfSheet(world, sheet);
    }
    return ok;
}

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

/* Returns true if the points of all stitches are in sheets that can be sewn. */
static bool IsSeam(const kiriWorld* world, const kiriSeamData* seam)
{
    bool isFine = seam->breakForce >= 0.0 && seam->breakForce <= (double)FLT_MAX && seam->bending >= 0.0 &&
                  seam->bending <= (double)FLT_MAX && fabs(seam->restAngle) <= KIRI_MOST_FOLD &&
                  seam->stitches.count > 0 && seam->rows.capacity >= seam->stitches.count;
    KIRI_EACH_WHILE(isFine, const kiriStitchData, stitch, seam->stitches) {
        const kiriSheetData* sheets[2];
        isFine = stitch->length > 0.0 && stitch->length <= (double)FLT_MAX && stitch->share > 0.0 &&
                 stitch->share <= 1.0;
        KIRI_TIMES_WHILE(isFine, end, 2) {
            sheets[end] = kiriStitch_Sheet(world, stitch, end);
            isFine = fabs(kiriVec2_Length(stitch->inward[end]) - 1.0) < 1e-6 && sheets[end] != NULL &&
                     !sheets[end]->settings.mechanics.planar && sheets[end]->seen.surface.detail.isHeld &&
                     kiriMesh_Locate(&sheets[end]->mesh, stitch->at[end]) != KIRI_NONE &&
                     sheets[end]->settings.mechanics.model == sheets[0]->settings.mechanics.model;
        }
    }
    KIRI_EACH_WHILE(isFine, const kiriSeamCorner, corner, seam->corners) {
        isFine = corner->part > 0.0 && corner->part < 1.0;
    }
    return isFine;
}

/* Returns true if settings are legal, and leaving pieces are pieces of this sheet, but not all. */
static bool IsSheet(const kiriWorld* world, const kiriSheetData* sheet)
{
    const kiriSettings* settings = &sheet->settings;
    const kiriSheetSettings* given = &settings->given;
    kiriFault fault;
    bool isFine = kiriStruct_Check(kiriSettingsStruct(), "", NULL, given, &fault) == KIRI_OK &&
                  memcmp(&given->material, &settings->material, sizeof(given->material)) == 0 &&
                  given->iterations == settings->iterations && given->skinning == settings->skinning &&
                  given->timeStepping == settings->mechanics.timeStepping;
    KIRI_EACH_WHILE(isFine, const kiriFrame, at, sheet->leaving) {
        const kiriSlot* slot = kiriPool_Find(&world->frameIds, *at);
        isFine = slot == NULL || slot->owner == sheet;
    }
    return isFine && kiriParts_StaySome(world, sheet, NULL);
}

/* ---- The format -------------------------------------------------------------------------------------------------- */

/* Precedes the world. Bytes of another version, or snapshots of another build, have another layout. */
typedef struct Head {
    char magic[8];
    uint64_t layout;
    int64_t size; /* of all bytes */
} Head;

KIRI_TABLE(HeadTable, Head, {
    KIRI_RUN(1, magic),
    KIRI_RUN(8, layout, size),
})

static Head HeadOfSave(int64_t size)
{
    return (Head){ { 'K', 'i', 'r', 'i', 'S', 'a', 'v', 'e' }, SAVE_VERSION | (uint64_t)KIRI_VERSION << 32, size };
}

static Head HeadOfSnapshot(int64_t size)
{
    Head head = { { 'K', 'i', 'r', 'i', 'S', 'n', 'a', 'p' }, KIRI_HASH_START, size };
    kiriHash_Int32(&head.layout, KIRI_VERSION);
    kiriArchive_HashLayout(WorldTable, &head.layout);
    kiriArchive_HashLayout(BladeDataTable, &head.layout);
    kiriArchive_HashLayout(SeamTable, &head.layout);
    kiriArchive_HashLayout(StitchTable, &head.layout);
    kiriSheet_HashLayout(&head.layout);
    return head;
}

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

/* Returns the number of bytes, and writes them if they fit. The sum of all before it ends a save. */
static int64_t WriteWorld(const kiriWorld* world, bool isWhole, void* bytes, int64_t capacity)
{
    kiriArchive archive = kiriArchive_Measure();
    archive.isWhole = isWhole;
    ArchiveWorld(&archive, Unlocked(world));
    int64_t size = HEAD_BYTES + archive.at + (isWhole ? 0 : SUM_BYTES);
    if (bytes != NULL && capacity >= size) {
        Head head = isWhole ? HeadOfSnapshot(size) : HeadOfSave(size);
        archive = kiriArchive_Write(bytes, size);
        archive.isWhole = isWhole;
        kiriArchive_Object(&archive, HeadTable, &head);
        ArchiveWorld(&archive, Unlocked(world));
        if (!isWhole) {
            uint64_t sum = SumBytes(bytes, archive.at);
            kiriArchive_Numbers(&archive, &sum, 8, 1);
        }
        KIRI_ASSERT(!archive.isBad && archive.at == size);
    }
    return size;
}

kiriResult kiriWorld_Save(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(size);
    KIRI_CHECK_NUMBER(capacity, 0, FLT_MAX);
    *size = 0;
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        if (sheet->update->stage != KIRI_NONE) {
            return KIRI_PENDING;
        }
    }
    *size = WriteWorld(world, false, bytes, capacity);
    KIRI_CHECK_NUMBER(capacity, bytes == NULL ? 0 : *size, FLT_MAX);
    return KIRI_OK;
}

kiriResult kiriWorld_Snapshot(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    KIRI_READS(world);
    KIRI_CHECK_OUT(size);
    KIRI_CHECK_NUMBER(capacity, 0, FLT_MAX);
    *size = WriteWorld(world, true, bytes, capacity);
    KIRI_CHECK_NUMBER(capacity, bytes == NULL ? 0 : *size, FLT_MAX);
    return KIRI_OK;
}

/* ---- A world from bytes ------------------------------------------------------------------------------------------ */

static void DropSheets(kiriWorld* world, kiriMemory* shown)
{
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        if (sheet != NULL && shown != NULL) {
            kiriMemory_AdoptAll(shown, &sheet->shown);
            world->mostRevision = kiriMax(sheet->seen.surface.revision, world->mostRevision);
        }
        kiriSheet_Delete(sheet, &world->memory);
    }
    world->sheets.count = 0;
}

/* Checks the fields of a save, and derives the others. */
static void FinishSave(kiriArchive* archive, kiriWorld* made)
{
#define CHECK_POOL(pool, kind) kiriPool_IsSound(&made->pool, KIRI_KIND_##kind) &&
    bool isFine = kiriArchive_HasFailed(archive) ||
                  (KIRI_POOLS(CHECK_POOL) made->active.capacity >= made->sheets.count &&
                   made->atWork.capacity >= made->sheets.count && made->newEvents <= made->events.count);
    kiriArchive_Expect(archive, isFine);
    KIRI_EACH_OF_WHILE(!kiriArchive_HasFailed(archive), kiriSheetData, sheet, made->sheets) {
        kiriArchive_Expect(archive, IsSheet(made, sheet));
        if (!kiriArchive_HasFailed(archive)) {
            kiriSheet_Derive(sheet, archive);
        }
    }
    KIRI_EACH_OF_WHILE(!kiriArchive_HasFailed(archive), kiriBladeData, blade, made->blades) {
        KIRI_EACH(const kiriLayer, layer, blade->layers) {
            const kiriSlot* cut = kiriPool_Find(&made->cutIds, layer->cut);
            kiriArchive_Expect(archive, cut == NULL || ((const kiriCutData*)cut->owner)->sheet->id == layer->sheet);
        }
    }
    KIRI_EACH_OF_WHILE(!kiriArchive_HasFailed(archive), kiriSeamData, seam, made->seams) {
        kiriArchive_Expect(archive, IsSeam(made, seam));
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
    KIRI_EACH_OF_WHILE(!kiriArchive_HasFailed(&archive), kiriSheetData, sheet, made->sheets) {
        archive.isShort |= !kiriSheet_EndReading(sheet, isWhole);
    }
    KIRI_EACH_OF_WHILE(!kiriArchive_HasFailed(&archive), kiriSeamData, seam, made->seams) {
        archive.isShort |= !kiriWeld_Make(made, seam);
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
    world->loadedAt = was.loadedAt + was.mostRevision;
    world->isBusy = was.isBusy;
    memcpy(world->errorLine, was.errorLine, sizeof(was.errorLine));
    kiriMemory_AdoptAll(&world->memory, &made->memory);
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        sheet->past = kiriPast_None(world->begun);
    }
}

/* Reads a world from the bytes between the header and the checksum. */
static kiriResult BecomeWorld(kiriWorld* world, const uint8_t* bytes, int64_t size, bool isWhole)
{
    kiriWorld made = { 0 };
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

/* Returns the fault of the bytes of a save, or null. */
static const char* FaultOfBytes(const uint8_t* bytes, int64_t size)
{
    Head head, own = HeadOfSave(size);
    kiriArchive archive = kiriArchive_Read(bytes, size, NULL);
    kiriArchive_Object(&archive, HeadTable, &head);
    if (archive.isBad || memcmp(head.magic, own.magic, sizeof(head.magic)) != 0) {
        return "these bytes are no save";
    }
    if (head.layout != own.layout) {
        return "the bytes are of another version of the library";
    }
    if (head.size != size || size < HEAD_BYTES + SUM_BYTES) {
        return "the bytes are not as many as were saved";
    }
    bool isSame = WordAt(bytes + size - SUM_BYTES, SUM_BYTES) == SumBytes(bytes, size - SUM_BYTES);
    return isSame ? NULL : "the bytes are not those that were saved";
}

kiriResult kiriWorld_Load(kiriWorld* world, const void* bytes, int64_t size)
{
    int32_t count = size >= 0 && size <= INT32_MAX ? (int32_t)size : KIRI_NONE;
    KIRI_CHANGES(World_Load, bytes, &count);
    KIRI_CHECK_OUT(bytes);
    KIRI_CHECK_NUMBER(size, 0, INT32_MAX);
    const char* why = FaultOfBytes(bytes, size);
    KIRI_REQUIRE(why == NULL, KIRI_ERROR_DATA, why);
    kiriResult result = BecomeWorld(world, (const uint8_t*)bytes + HEAD_BYTES, size - HEAD_BYTES - SUM_BYTES, false);
    return KIRI_FAIL(result, result == KIRI_ERROR_DATA ? "the bytes have a right sum, but no world" : NULL);
}

kiriResult kiriWorld_Restore(kiriWorld* world, const void* bytes, int64_t size)
{
    KIRI_PREPARES(world);
    KIRI_CHECK_OUT(bytes);
    KIRI_CHECK_NUMBER(size, 0, FLT_MAX);
    KIRI_REQUIRE(world->recorder.write == NULL, KIRI_ERROR_STATE,
                 "the world is recorded: snapshots are of one process, recordings are not");
    const Head head = HeadOfSnapshot(size);
    bool isOurs = size >= HEAD_BYTES && memcmp(bytes, &head, sizeof(head)) == 0;
    kiriResult result =
        isOurs ? BecomeWorld(world, (const uint8_t*)bytes + HEAD_BYTES, size - HEAD_BYTES, true) : KIRI_ERROR_DATA;
    return KIRI_FAIL(result, result == KIRI_ERROR_DATA ? "the bytes are no snapshot of this build" : NULL);
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
    KIRI_EACH_OF(kiriSheetData, sheet, world->sheets) {
        HashWork(&archive.hash, world, sheet);
    }
    return archive.hash;
}
