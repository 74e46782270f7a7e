#include "kiri_state.h"
#include "../core/kiri_archive.h"
#include "../sheet/kiri_detach.h"
#include "../sheet/kiri_sheet_save.h"
#include "kiri_blade.h"
#include "kiri_world_check.h"
#include "../sheet/kiri_update.h"

#include <string.h>

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

/* What was found is of the tick at hand alone. */
static const kiriMember PairMembers[] = {
    KIRI_RUN(4, kiriTouchingPair, upper, touches),
    KIRI_DROPPED(kiriTouchingPair, bodies),
    KIRI_DROPPED(kiriTouchingPair, nears),
};
static const kiriTable PairTable = KIRI_TABLE(kiriTouchingPair, PairMembers);

static const kiriMember PairsMembers[] = {
    KIRI_PARTS(kiriPairs, pairs, PairTable), KIRI_ROOM_OF(kiriPairs, next),     KIRI_ROOM_OF(kiriPairs, found),
    KIRI_ROOM_OF(kiriPairs, bodies),         KIRI_ROOM_OF(kiriPairs, order),    KIRI_ROOM_OF(kiriPairs, nears),
    KIRI_ROOM_OF(kiriPairs, parents),        KIRI_ROOM_OF(kiriPairs, islands),  KIRI_ROOM_OF(kiriPairs, touches),
    KIRI_ITEMS(8, kiriPairs, felt),          KIRI_ROOM_OF(kiriPairs, nextFelt),
};
static const kiriTable PairsTable = KIRI_TABLE(kiriPairs, PairsMembers);

static const kiriMember LoopMembers[] = {
    KIRI_BOOLS(kiriLoop, isOpen, isPassed),
    KIRI_RUN(8, kiriLoop, start, then),
};
static const kiriTable LoopTable = KIRI_TABLE(kiriLoop, LoopMembers);

static const kiriMember LayerMembers[] = {
    KIRI_RUN(4, kiriLayer, sheet, cut),
    KIRI_RUN(8, kiriLayer, rest, share),
    KIRI_PART(kiriLayer, loop, LoopTable),
};
static const kiriTable LayerTable = KIRI_TABLE(kiriLayer, LayerMembers);

static const kiriMember BladeDataMembers[] = {
    KIRI_RUN(4, kiriBladeData, id, sheet),
    KIRI_BOOLS(kiriBladeData, isPlaced, isPlaced),
    KIRI_RUN(8, kiriBladeData, edge, elapsed),
    KIRI_PARTS(kiriBladeData, layers, LayerTable),
};
static const kiriTable BladeDataTable = KIRI_TABLE(kiriBladeData, BladeDataMembers);

/* The owner of a slot is found by its id. */
static const kiriMember SlotMembers[] = {
    KIRI_DROPPED(kiriSlot, owner),
    KIRI_RUN(4, kiriSlot, index, generation),
};
static const kiriTable SlotTable = KIRI_TABLE(kiriSlot, SlotMembers);

static const kiriMember PoolMembers[] = {
    KIRI_RUN(4, kiriPool, kind, freeCount),
    KIRI_PARTS(kiriPool, slots, SlotTable),
};
static const kiriTable PoolTable = KIRI_TABLE(kiriPool, PoolMembers);

static const kiriMember MovesMembers[] = {
    KIRI_ROOM_OF(kiriMoves, of),     KIRI_ROOM_OF(kiriMoves, meets), KIRI_ROOM_OF(kiriMoves, order),
    KIRI_ROOM_OF(kiriMoves, parent), KIRI_ROOM_OF(kiriMoves, heads),
};
static const kiriTable MovesTable = KIRI_TABLE(kiriMoves, MovesMembers);

/* Times are of this machine. */
static const kiriMember ProfileMembers[] = {
    KIRI_DROPPED(kiriProfile, seconds),
    KIRI_RUN(4, kiriProfile, cutSegments, sheetPairs),
    KIRI_RUN(8, kiriProfile, largestJump, largestFade),
};
static const kiriTable ProfileTable = KIRI_TABLE(kiriProfile, ProfileMembers);

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
    KIRI_RUN(4, kiriWorld, turn, newEvents),
    KIRI_PART(kiriWorld, sheetIds, PoolTable),
    KIRI_PART(kiriWorld, cutIds, PoolTable),
    KIRI_PART(kiriWorld, frameIds, PoolTable),
    KIRI_PART(kiriWorld, pinIds, PoolTable),
    KIRI_PART(kiriWorld, obstacleIds, PoolTable),
    KIRI_PART(kiriWorld, bladeIds, PoolTable),
    KIRI_SPACE_OF(kiriWorld, sheets),
    KIRI_ROOM_OF(kiriWorld, active),
    KIRI_ROOM_OF(kiriWorld, atWork),
    KIRI_SPACE_OF(kiriWorld, obstacles),
    KIRI_SPACE_OF(kiriWorld, blades),
    KIRI_ITEMS(4, kiriWorld, obstacleOrder),
    KIRI_DROPPED(kiriWorld, obstacleSearch),
    KIRI_DROPPED(kiriWorld, searches),
    KIRI_PART(kiriWorld, pairs, PairsTable),
    KIRI_PART(kiriWorld, moves, MovesTable),
    KIRI_ROOM_OF(kiriWorld, skinRanges),
    KIRI_ITEMS(4, kiriWorld, events),
    KIRI_PART(kiriWorld, profile, ProfileTable),
    KIRI_DROPPED(kiriWorld, begun),
    KIRI_DROPPED(kiriWorld, stage),
    KIRI_DROPPED(kiriWorld, stageStart),
    KIRI_DROPPED(kiriWorld, errorLine),
    KIRI_DROPPED(kiriWorld, isBusy),
    KIRI_DROPPED(kiriWorld, readers),
    KIRI_DROPPED(kiriWorld, logs),
};
static const kiriTable WorldTable = KIRI_TABLE(kiriWorld, WorldMembers);

/* ---- Both directions --------------------------------------------------------------------------------------------- */

enum { SAVE_VERSION = 2, HEAD_BYTES = 24, SUM_BYTES = 8 };

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

/* Each frame is of a piece: nothing has been checked yet. */
static bool HaveFramesPieces(const kiriSheetData* sheet)
{
    const kiriLayout* layout = &sheet->layout;
    bool have = layout->framePiece.count == sheet->frames.count;
    for (int32_t f = 0; have && f < sheet->frames.count; ++f) {
        have = layout->framePiece.data[f] >= 0 && layout->framePiece.data[f] < layout->pieces.count;
    }
    return have;
}

static bool ClaimIdsOfSheet(kiriWorld* world, kiriSheetData* sheet)
{
    bool ok = HaveFramesPieces(sheet) && kiriPool_Claim(&world->sheetIds, sheet->id, sheet, 0);
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

/* ---- The format -------------------------------------------------------------------------------------------------- */

static const char saveMagic[8] = { 'K', 'i', 'r', 'i', 'S', 'a', 'v', 'e' };

/* What comes before the world; the sum of all bytes comes after it. */
typedef struct SaveHead {
    char magic[8];
    int32_t version, library;
    int64_t size; /* of all bytes */
} SaveHead;

static const kiriMember SaveHeadMembers[] = {
    KIRI_RUN(1, SaveHead, magic, magic),
    KIRI_RUN(4, SaveHead, version, library),
    KIRI_RUN(8, SaveHead, size, size),
};
static const kiriTable SaveHeadTable = KIRI_TABLE(SaveHead, SaveHeadMembers);

static uint64_t WordAt(const uint8_t* bytes, int64_t count)
{
    uint64_t word = 0;
    for (int64_t k = 0; k < 8 && k < count; ++k) {
        word |= (uint64_t)bytes[k] << (8 * k);
    }
    return word;
}

/* The same of eight bytes: compilers read them at once. */
static uint64_t WholeWordAt(const uint8_t* b)
{
    return b[0] | (uint64_t)b[1] << 8 | (uint64_t)b[2] << 16 | (uint64_t)b[3] << 24 | (uint64_t)b[4] << 32 |
           (uint64_t)b[5] << 40 | (uint64_t)b[6] << 48 | (uint64_t)b[7] << 56;
}

/* Eight bytes at a time. */
static uint64_t SumBytes(const uint8_t* bytes, int64_t count)
{
    uint64_t sum = KIRI_HASH_START;
    int64_t n = 0;
    for (; n + 8 <= count; n += 8) {
        kiriHash_Int64(&sum, (int64_t)WholeWordAt(bytes + n));
    }
    if (n < count) {
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

static bool IsWorkAtHand(const kiriWorld* world)
{
    bool isAtHand = false;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        isAtHand = isAtHand || world->sheets.data[i]->update->stage != KIRI_NONE;
    }
    return isAtHand;
}

kiriResult kiriSave_Write(const kiriWorld* world, void* bytes, int64_t capacity, int64_t* size)
{
    if (IsWorkAtHand(world)) {
        *size = 0;
        return KIRI_PENDING;
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
    bool isShort = false, isFine = kiriArchive_HasFailed(archive) || kiriWorld_Check(made, &isShort);
    archive->isShort |= isShort;
    kiriArchive_Expect(archive, isFine);
    for (int32_t i = 0; i < made->sheets.count && !kiriArchive_HasFailed(archive); ++i) {
        bool isBad = false, isMade = kiriRemake_Field(made->sheets.data[i], &isBad);
        archive->isShort |= !isMade && !isBad;
        kiriArchive_Expect(archive, !isBad);
    }
    isFine = kiriArchive_HasFailed(archive) || kiriWorld_CheckMade(made, &isShort);
    archive->isShort |= isShort;
    kiriArchive_Expect(archive, isFine);
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
    world->begun = was.begun;
    world->stage = was.stage;
    world->isBusy = was.isBusy;
    memcpy(world->errorLine, was.errorLine, sizeof(was.errorLine));
    kiriMemory_AdoptAll(&world->memory, &made->memory);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        world->sheets.data[i]->past = kiriPast_None(world->begun);
    }
}

/* From the bytes between head and sum. */
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

static void HashVec2(uint64_t* hash, kiriVec2 a)
{
    kiriHash_Double(hash, a.x);
    kiriHash_Double(hash, a.y);
}

static void HashVec3(uint64_t* hash, kiriVec3 a)
{
    kiriHash_Double(hash, a.x);
    kiriHash_Double(hash, a.y);
    kiriHash_Double(hash, a.z);
}

static void HashPoint(uint64_t* hash, kiriLatticePoint p)
{
    kiriHash_Pair(hash, p.x, p.y);
}

static void HashMesh(uint64_t* hash, const kiriMeshData* mesh)
{
    HashVec2(hash, mesh->origin);
    kiriHash_Double(hash, mesh->step);
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        const kiriTriangle* triangle = &mesh->triangles.data[t];
        for (int k = 0; k < 3; ++k) {
            kiriHash_Pair(hash, triangle->vertex[k], triangle->twin[k]);
        }
        kiriHash_Int32(hash, triangle->marks & KIRI_TRIANGLE_OPEN);
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        HashPoint(hash, mesh->vertices.data[v].at);
    }
}

static void HashSkin(uint64_t* hash, const kiriSheetData* sheet, const kiriSkin* skin)
{
    for (int32_t i = 0; i < skin->spans.count; ++i) {
        kiriSpan span = skin->spans.data[i];
        kiriHash_Int32(hash, span.count);
        for (int32_t k = span.first; k < span.first + span.count; ++k) {
            kiriHash_Int32(hash, kiriSheet_FrameOf(sheet, skin->weights.data[k].label));
            kiriHash_Double(hash, skin->weights.data[k].value);
        }
    }
}

static void HashLink(uint64_t* hash, const kiriLink* link)
{
    kiriHash_Int32(hash, link->i);
    kiriHash_Int32(hash, link->j);
    HashVec3(hash, kiriVec3_Make(link->width, link->length, link->moment));
    kiriHash_Double(hash, link->outer);
    HashVec2(hash, link->span);
    HashVec2(hash, link->normal);
    HashVec2(hash, link->tangent);
    HashVec2(hash, link->centroid);
    HashVec2(hash, link->crossing);
    HashVec2(hash, link->sum);
    HashVec2(hash, link->spread[0]);
    HashVec2(hash, link->spread[1]);
}

static void HashCorner(uint64_t* hash, const kiriCorner* corner)
{
    kiriHash_Int32(hash, corner->count);
    for (int32_t k = 0; k < corner->count; ++k) {
        kiriHash_Int32(hash, corner->link[k]);
        HashVec2(hash, corner->weight[k]);
    }
    kiriHash_Double(hash, corner->area);
}

static void HashAreaElements(uint64_t* hash, const kiriAreaElements* elements)
{
    for (int32_t i = 0; i < elements->elements.count; ++i) {
        kiriHash_Double(hash, elements->elements.data[i].area);
        kiriHash_Int32(hash, elements->elements.data[i].count);
    }
    for (int32_t i = 0; i < elements->shares.count; ++i) {
        const kiriFrameShare* share = &elements->shares.data[i];
        kiriHash_Int32(hash, share->frame);
        kiriHash_Double(hash, share->weight);
        HashVec2(hash, share->slope);
        HashVec2(hash, share->move);
        HashVec2(hash, share->u);
        HashVec2(hash, share->v);
    }
}

static void HashPinShare(uint64_t* hash, const kiriPinShare* pinned)
{
    const kiriLineShare* share = &pinned->share;
    kiriHash_Int32(hash, pinned->pin);
    kiriHash_Int32(hash, share->frame);
    HashVec3(hash, kiriVec3_Make(share->length, share->first, share->second));
    for (int end = 0; end < 2; ++end) {
        kiriHash_Double(hash, share->ends[end]);
        kiriHash_Int32(hash, share->open[end]);
    }
}

void kiriStateHash_AddLayout(uint64_t* hash, const kiriSheetData* sheet)
{
    HashMesh(hash, &sheet->mesh);
    const kiriLayout* layout = &sheet->layout;
    for (int32_t i = 0; i < sheet->links.links.count; ++i) {
        HashLink(hash, &sheet->links.links.data[i]);
    }
    for (int32_t i = 0; i < sheet->links.corners.count; ++i) {
        HashCorner(hash, &sheet->links.corners.data[i]);
    }
    HashAreaElements(hash, &layout->areaElements);
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        HashPoint(hash, sheet->points.data[i].at);
        kiriHash_Int32(hash, sheet->points.data[i].frame);
    }
    HashSkin(hash, sheet, &sheet->vertexSkin);
    HashSkin(hash, sheet, &sheet->pointSkin);
    for (int32_t i = 0; i < layout->framePiece.count; ++i) {
        kiriHash_Int32(hash, layout->framePiece.data[i]);
    }
    for (int32_t i = 0; i < layout->pinFrame.count; ++i) {
        kiriHash_Int32(hash, layout->pinFrame.data[i]);
    }
    for (int32_t k = 0; k < layout->severed.count; ++k) {
        kiriHash_Int32(hash, layout->severed.data[k].pin);
        kiriHash_Int32(hash, layout->severed.data[k].link);
        kiriHash_Double(hash, layout->severed.data[k].part);
    }
    for (int32_t k = 0; k < layout->pinShares.count; ++k) {
        HashPinShare(hash, &layout->pinShares.data[k]);
    }
}

static void HashMat3(uint64_t* hash, const kiriMat3* m)
{
    HashVec3(hash, m->u);
    HashVec3(hash, m->v);
    HashVec3(hash, m->d);
}

static void HashHistory(uint64_t* hash, const kiriHistory* history)
{
    kiriHash_Double(hash, history->dt);
    kiriHash_Int32(hash, history->isHalf);
    kiriHash_Int32(hash, history->isHeld);
    HashVec3(hash, history->gain);
    HashVec3(hash, history->lag);
    HashVec3(hash, history->pull);
    HashMat3(hash, &history->turnGain);
    HashMat3(hash, &history->turnLag);
    HashMat3(hash, &history->turnPull);
}

static void HashWrench(uint64_t* hash, const kiriWrench* wrench)
{
    HashVec3(hash, wrench->force);
    HashVec3(hash, wrench->moment);
}

static void HashReaction(uint64_t* hash, const kiriReaction* reaction, const kiriWrench* bore)
{
    HashWrench(hash, &reaction->gain);
    HashWrench(hash, &reaction->pull);
    HashWrench(hash, bore);
}

static void HashFrame(uint64_t* hash, const kiriFrameData* frame)
{
    HashVec2(hash, frame->site.at);
    HashVec2(hash, frame->center);
    kiriHash_Double(hash, frame->mass);
    kiriHash_Int64(hash, frame->rigidAtStart);
    HashVec3(hash, kiriVec3_Make(frame->inertia[0], frame->inertia[1], frame->inertia[2]));
    HashVec3(hash, frame->x);
    HashVec3(hash, frame->A.u);
    HashVec3(hash, frame->A.v);
    HashVec3(hash, frame->A.d);
    HashVec3(hash, frame->velocity);
    HashVec3(hash, frame->spin);
    HashVec3(hash, frame->rate.u);
    HashVec3(hash, frame->rate.v);
    HashVec3(hash, frame->rate.d);
    HashHistory(hash, &frame->history);
    HashVec3(hash, frame->force);
    HashVec3(hash, frame->torque);
    HashWrench(hash, &frame->load);
    HashVec3(hash, frame->support);
    HashPoint(hash, frame->anchor);
    kiriHash_Int32(hash, frame->held);
    if (frame->held) {
        HashVec3(hash, frame->heldPosition);
        HashMat3(hash, &frame->heldRotation);
        HashVec3(hash, frame->goalPosition);
        HashMat3(hash, &frame->goalRotation);
        HashVec3(hash, frame->heldOff);
        kiriHash_Int32(hash, frame->isOffKnown);
        HashReaction(hash, &frame->reaction, &frame->bore);
    }
}

static void HashSettings(uint64_t* hash, const kiriSheetData* sheet)
{
    const kiriMaterial* m = &sheet->settings.material;
    HashVec3(hash, kiriVec3_Make(m->youngsModulus, m->poissonsRatio, m->thickness));
    HashVec3(hash, kiriVec3_Make(m->density, m->airDamping, m->flexDamping));
    HashVec3(hash, kiriVec3_Make(sheet->settings.snap, sheet->shape.rigidWeight, sheet->settings.rigidArea));
    kiriHash_Double(hash, sheet->settings.crumbArea);
    kiriHash_Double(hash, sheet->settings.frameLength);
    kiriHash_Int32(hash, sheet->settings.mechanics.model);
    kiriHash_Int32(hash, sheet->settings.mechanics.planar);
    kiriHash_Int32(hash, sheet->settings.mechanics.timeStepping);
    kiriHash_Double(hash, sheet->settings.integrationPoints);
    kiriHash_Int32(hash, sheet->settings.integrationOrder);
    kiriHash_Int32(hash, sheet->settings.maxFrames);
    kiriHash_Int32(hash, sheet->settings.iterations);
    kiriHash_Double(hash, sheet->settings.collisionPoints);
    kiriHash_Int32(hash, sheet->settings.popping);
    kiriHash_Int32(hash, sheet->settings.eased);
    kiriHash_Double(hash, sheet->settings.friction);
    kiriHash_Double(hash, sheet->settings.contactThickness);
    kiriHash_Int32(hash, (int32_t)sheet->settings.groups);
    kiriHash_Int32(hash, sheet->settings.touchesSheets);
    HashVec3(hash, sheet->settings.air.velocity);
    HashVec3(hash, kiriVec3_Make(sheet->settings.air.density, sheet->settings.air.drag, sheet->settings.air.lift));
    if (sheet->settings.skinning != KIRI_SKINNING_LINEAR) {
        kiriHash_Int32(hash, sheet->settings.skinning); /* what fades is what is seen to jump */
    }
}

static void HashContacts(uint64_t* hash, const kiriSheetData* sheet)
{
    kiriHash_Int32(hash, sheet->contacts.count);
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        const kiriContact* contact = &sheet->contacts.data[i].contact;
        kiriHash_Int32(hash, contact->point);
        if (contact->point < 0) {
            HashVec2(hash, kiriVec2_Make(contact->restPoint[0], contact->restPoint[1]));
        }
        HashVec3(hash, kiriVec3_Load(contact->normal));
        HashVec3(hash, kiriVec3_Load(contact->velocity));
        HashVec3(hash, kiriVec3_Make(contact->offset, contact->friction, contact->inverseMass));
        kiriHash_Double(hash, contact->pushSpeed);
        kiriHash_Int32(hash, contact->obstacle);
    }
}

/* Of the last tick that moved the sheet. */
static void HashTouch(uint64_t* hash, const kiriTouch* touch)
{
    kiriHash_Word(hash, touch->key);
    HashVec3(hash, touch->normal);
    HashVec3(hash, touch->velocity);
    kiriHash_Double(hash, touch->offset);
    kiriHash_Double(hash, touch->friction);
}

static void HashTouchForces(uint64_t* hash, const kiriTouchMemory* memory)
{
    for (int32_t i = 0; i < memory->forces.count; ++i) {
        kiriHash_Word(hash, memory->forces.data[i].key);
        HashVec3(hash, memory->forces.data[i].force);
    }
}

static void HashTouches(uint64_t* hash, const kiriTouchMemory* last, const kiriTouchMemory* slept)
{
    kiriHash_Int32(hash, last->touches.count + slept->touches.count);
    for (int32_t i = 0; i < last->touches.count; ++i) {
        HashTouch(hash, &last->touches.data[i]);
    }
    for (int32_t i = 0; i < slept->touches.count; ++i) {
        HashTouch(hash, &slept->touches.data[i]);
    }
    kiriHash_Int32(hash, last->forces.count + slept->forces.count);
    HashTouchForces(hash, last);
    HashTouchForces(hash, slept);
}

/* How far the work on a cut has come. Which items of it are done follows from how many, for their order does. What is
   made again after a refused allocation counts where it can change when a cut takes effect. */
static void HashWork(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    const kiriUpdate* u = sheet->update;
    bool isLimited = world->budget.cells > 0 || world->budget.samples > 0;
    kiriHash_Int32(hash, isLimited && sheet->settings.fromScratch);
    kiriHash_Int32(hash, (isLimited || u->stage != KIRI_NONE) && (u->needsRebuild || u->isScratch));
    kiriHash_Int32(hash, u->isUnsettled);
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

static void HashPin(uint64_t* hash, const kiriPinData* pin)
{
    HashPoint(hash, pin->at);
    HashVec3(hash, pin->target);
    HashVec3(hash, pin->lastTarget);
    HashVec3(hash, pin->off);
    kiriHash_Int32(hash, pin->offFrame != 0);
    kiriHash_Double(hash, pin->breakForce);
    kiriHash_Int32(hash, pin->anchor.obstacle != 0);
    HashVec3(hash, pin->anchor.local);
    kiriHash_Double(hash, pin->stiffness);
    HashReaction(hash, &pin->reaction, &pin->bore);
    if (pin->type == KIRI_PIN_POINT) {
        return;
    }
    kiriHash_Int32(hash, pin->type);
    HashPoint(hash, pin->to);
    HashVec3(hash, pin->rotation.u);
    HashVec3(hash, pin->rotation.v);
    HashVec3(hash, pin->lastRotation.u);
    HashVec3(hash, pin->lastRotation.v);
}

/* Pieces that go when the work at hand is done. */
static void HashLeaving(uint64_t* hash, const kiriSheetData* sheet)
{
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        if (sheet->layout.pieces.data[p].isGone) {
            kiriHash_Int32(hash, p);
        }
    }
    for (int32_t k = 0; k < sheet->leaving.count; ++k) {
        kiriHash_Int32(hash, (int32_t)sheet->leaving.data[k]);
    }
    if (sheet->leavingPaid > 0) {
        kiriHash_Int32(hash, (int32_t)sheet->leavingPaid);
    }
}

static void HashWaiting(uint64_t* hash, const kiriWorld* world, const kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->queue.count; ++i) {
        const kiriQueuedPoint* point = &sheet->queue.data[i];
        HashVec2(hash, point->to);
        kiriHash_Int32(hash, point->jump);
        kiriHash_Int32(hash, point->ends);
        kiriHash_Int64(hash, world->ticks - point->stamp);
        kiriHash_Int32(hash, point->cut->index);
    }
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        HashVec2(hash, sheet->cuts.data[i]->tip.last);
        HashPoint(hash, sheet->cuts.data[i]->tip.blade.at);
        kiriHash_Int32(hash, sheet->cuts.data[i]->tip.blade.vertex);
        if (sheet->cuts.data[i]->tip.blade.phase != KIRI_BLADE_RESTS) {
            kiriHash_Int32(hash, sheet->cuts.data[i]->tip.blade.phase);
        }
        if (sheet->cuts.data[i]->tip.blade.owed > 0) {
            kiriHash_Int64(hash, sheet->cuts.data[i]->tip.blade.owed);
        }
        kiriHash_Int32(hash, sheet->cuts.data[i]->ended);
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        HashPin(hash, &sheet->pins.data[i]);
    }
    HashContacts(hash, sheet);
    HashLeaving(hash, sheet);
}

static void HashStrainOffsets(uint64_t* hash, const kiriStrainOffsets* strainOffsets)
{
    for (int32_t k = 0; k < strainOffsets->strainOffsets.count; ++k) {
        for (int e = 0; e < KIRI_STRAINS; ++e) {
            kiriHash_Double(hash, strainOffsets->strainOffsets.data[k].strain[e]);
        }
    }
}

static void HashPinHistory(uint64_t* hash, const kiriPinShares* shares)
{
    for (int32_t k = 0; k < shares->count; ++k) {
        for (int e = 0; e < KIRI_CLAMP_STRAINS; ++e) {
            kiriHash_Double(hash, shares->data[k].offset[e]);
        }
        for (int spring = 0; spring < 2; ++spring) {
            HashWrench(hash, &shares->data[k].reactions[spring].gain);
            HashWrench(hash, &shares->data[k].reactions[spring].pull);
        }
        HashWrench(hash, &shares->data[k].bore);
        HashVec3(hash, shares->data[k].off);
    }
}

static void HashFades(uint64_t* hash, const kiriFades* fades)
{
    kiriHash_Double(hash, fades->time);
    for (int32_t k = 0; k < fades->fading.count; ++k) {
        kiriHash_Int32(hash, fades->fading.data[k].sample);
        kiriHash_Double(hash, fades->fading.data[k].left);
        HashVec3(hash, fades->fading.data[k].offset);
    }
}

static void HashRest(uint64_t* hash, const kiriSheetData* sheet)
{
    kiriHash_Double(hash, sheet->settings.sleepSpeed);
    const kiriPiece* pieces = sheet->layout.pieces.data;
    double least = pieces[0].rest.calm;
    for (int32_t p = 1; p < sheet->layout.pieces.count; ++p) {
        least = kiriMin(pieces[p].rest.calm, least);
    }
    kiriHash_Double(hash, least);
    kiriHash_Int32(hash, sheet->rest.asleep);
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        if (pieces[p].rest.calm != least || pieces[p].rest.asleep != sheet->rest.asleep) {
            kiriHash_Int32(hash, p);
            kiriHash_Double(hash, pieces[p].rest.calm);
            kiriHash_Int32(hash, pieces[p].rest.asleep);
        }
    }
    if (sheet->turns.next > 0) {
        kiriHash_Int32(hash, sheet->turns.next);
    }
    HashTouches(hash, &sheet->touches.last, &sheet->touches.slept);
}

/* What it gave sheets and took from them in the last tick does not matter for the coming ones. */
static void HashObstacle(uint64_t* hash, const kiriObstacleData* obstacle)
{
    const kiriObstacleShape* shape = &obstacle->shape;
    kiriHash_Int32(hash, shape->type);
    HashVec3(hash, kiriVec3_Make(shape->radius, shape->half, shape->rounding));
    for (int32_t i = 0; i < shape->count; ++i) {
        HashVec2(hash, shape->outline[i]);
    }
    HashVec3(hash, obstacle->position);
    HashMat3(hash, &obstacle->rotation);
    HashVec3(hash, obstacle->velocity);
    HashVec3(hash, obstacle->spin);
    HashVec3(hash, obstacle->surface);
    HashVec3(hash, kiriVec3_Make(obstacle->friction, obstacle->mass, obstacle->pushSpeed));
    HashMat3(hash, &obstacle->inverseInertia);
    HashVec3(hash, obstacle->center);
    kiriHash_Int32(hash, (int32_t)obstacle->body);
    kiriHash_Int32(hash, (int32_t)obstacle->groups);
    kiriHash_Double(hash, obstacle->drift);
}

/* Which sheet it is, and which of its cuts: ids are no part of the state. */
static void HashLayer(uint64_t* hash, const kiriWorld* world, const kiriLayer* layer)
{
    const kiriSlot *sheet = kiriPool_Find(&world->sheetIds, layer->sheet),
                   *cut = kiriPool_Find(&world->cutIds, layer->cut);
    int32_t index = KIRI_NONE;
    for (int32_t i = 0; sheet != NULL && i < world->sheets.count; ++i) {
        index = world->sheets.data[i] == sheet->owner ? i : index;
    }
    kiriHash_Int32(hash, index);
    kiriHash_Int32(hash, cut != NULL ? ((const kiriCutData*)cut->owner)->index : KIRI_NONE);
    HashVec2(hash, layer->rest);
    HashVec3(hash, layer->at);
    kiriHash_Double(hash, layer->share);
    kiriHash_Int32(hash, layer->loop.isOpen);
    kiriHash_Int32(hash, layer->loop.isPassed);
    HashVec2(hash, layer->loop.start);
    HashVec2(hash, layer->loop.near);
    kiriHash_Double(hash, layer->loop.length);
    kiriHash_Double(hash, layer->loop.then);
}

static void HashBlade(uint64_t* hash, const kiriWorld* world, const kiriBladeData* blade)
{
    const kiriSlot* sheet = kiriPool_Find(&world->sheetIds, blade->sheet);
    kiriHash_Int32(hash, blade->sheet == 0 ? 0 : sheet == NULL ? 1 : 2);
    kiriHash_Int32(hash, blade->isPlaced);
    HashVec3(hash, blade->edge[0]);
    HashVec3(hash, blade->edge[1]);
    kiriHash_Double(hash, blade->elapsed);
    kiriHash_Int32(hash, blade->layers.count);
    for (int32_t i = 0; i < blade->layers.count; ++i) {
        HashLayer(hash, world, &blade->layers.data[i]);
    }
}

static void HashPairs(uint64_t* hash, const kiriPairs* pairs)
{
    for (int32_t i = 0; i < pairs->pairs.count; ++i) {
        kiriHash_Int32(hash, pairs->pairs.data[i].side);
        kiriHash_Int32(hash, pairs->pairs.data[i].touches);
    }
    for (int32_t i = 0; i < pairs->felt.count; ++i) {
        HashVec3(hash, pairs->felt.data[i].force);
    }
}

uint64_t kiriStateHash_Of(const kiriWorld* world)
{
    uint64_t hash = KIRI_HASH_START;
    HashVec3(&hash, world->gravity);
    kiriHash_Int32(&hash, world->budget.triangles);
    kiriHash_Int32(&hash, world->budget.cells);
    kiriHash_Int32(&hash, world->budget.samples);
    kiriHash_Int32(&hash, world->budget.iterations);
    kiriHash_Int32(&hash, world->turn);
    bool isLimited = world->budget.triangles > 0 || world->budget.cells > 0 || world->budget.samples > 0;
    kiriHash_Int32(&hash, isLimited && world->ticks % 2 == 1); /* whose turn it is */
    if (world->samplesDue > 0) {
        kiriHash_Int64(&hash, world->samplesDue);
    }
    for (int32_t i = 0; i < world->blades.count; ++i) {
        HashBlade(&hash, world, world->blades.data[i]);
    }
    HashPairs(&hash, &world->pairs);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        const kiriSheetData* sheet = world->sheets.data[i];
        HashSettings(&hash, sheet);
        kiriStateHash_AddLayout(&hash, sheet);
        uint64_t pattern = kiriSolver_Hash(sheet->solver);
        kiriHash_Word(&hash, pattern);
        HashWork(&hash, world, sheet);
        HashWaiting(&hash, world, sheet);
        HashRest(&hash, sheet);
        HashStrainOffsets(&hash, &sheet->strainOffsets);
        HashPinHistory(&hash, &sheet->layout.pinShares);
        HashFades(&hash, &sheet->seen.fades);
        HashFades(&hash, &sheet->seen.pointFades);
        for (int32_t f = 0; f < sheet->frames.count; ++f) {
            HashFrame(&hash, &sheet->frames.data[f]);
        }
    }
    for (int32_t i = 0; i < world->obstacles.count; ++i) {
        HashObstacle(&hash, world->obstacles.data[i]);
    }
    return hash;
}
