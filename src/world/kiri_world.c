#include "kiri_world.h"

#include "../sheet/kiri_build.h"
#include "../sheet/kiri_extract.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_seen.h"

kiriResult kiriWorld_ReserveIds(kiriWorld* world, kiriPool* pool, int64_t count)
{
    if (!kiriPool_HasRoom(pool, count)) {
        return KIRI_ERROR_LIMIT;
    }
    return kiriPool_Reserve(pool, &world->memory, (int32_t)count) ? KIRI_OK : KIRI_ERROR_MEMORY;
}

/* Room in the list of sheets, and an id for one more. */
void kiriWorld_RemovePin(kiriWorld* world, kiriSheetData* sheet, int32_t index)
{
    kiriPin pin = sheet->pins.data[index].id;
    kiriPins_ForgetHistory(sheet, index);
    kiriPins_Remove(sheet, index);
    kiriMotion_Wake(sheet);
    if (index < sheet->pins.count) {
        kiriPool_Find(&world->pinIds, sheet->pins.data[index].id)->index = index;
    }
    kiriPool_Remove(&world->pinIds, pin);
}

kiriResult kiriWorld_ReserveSheet(kiriWorld* world)
{
    return kiriArray_Reserve(&world->memory, &world->sheets, (int64_t)world->sheets.count + 1)
               ? kiriWorld_ReserveIds(world, &world->sheetIds, 1)
               : KIRI_ERROR_MEMORY;
}

kiriResult kiriWorld_AddSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* id, const char** why)
{
    kiriSheetData* sheet = kiriSheet_New(&world->memory);
    kiriResult result = sheet != NULL ? kiriBuild_FromDef(sheet, def, why) : KIRI_ERROR_MEMORY;
    if (result == KIRI_OK) {
        *why = NULL;
        result = kiriWorld_ReserveSheet(world);
    }
    if (result == KIRI_OK) {
        result = kiriWorld_ReserveIds(world, &world->frameIds, sheet->frames.count);
    }
    if (result != KIRI_OK) {
        kiriSheet_Delete(sheet, &world->memory);
        return result;
    }
    world->sheets.data[world->sheets.count++] = sheet;
    sheet->id = kiriPool_Add(&world->sheetIds, &world->memory, sheet, 0);
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        sheet->frames.data[i].id = kiriPool_Add(&world->frameIds, &world->memory, sheet, i);
    }
    kiriView_WritePositions(sheet);
    *id = sheet->id;
    return KIRI_OK;
}

void kiriWorld_RemoveSheet(kiriWorld* world, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriPool_Remove(&world->frameIds, sheet->frames.data[i].id);
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriPool_Remove(&world->pinIds, sheet->pins.data[i].id);
    }
    for (int32_t i = 0; i < sheet->cuts.count; ++i) {
        kiriWorld_RemoveCut(world, sheet->cuts.data[i]);
    }
    kiriPool_Remove(&world->sheetIds, sheet->id);
    int32_t kept = 0;
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        if (world->sheets.data[i] != sheet) {
            world->sheets.data[kept++] = world->sheets.data[i];
        }
    }
    world->sheets.count = kept;
    kiriMemory_AdoptAll(&world->retired, &sheet->shown);
    kiriSheet_Delete(sheet, &world->memory);
}

kiriResult kiriWorld_AddCut(kiriWorld* world, kiriSheetData* sheet, int64_t points, kiriCutData** made)
{
    if (!kiriArray_Reserve(&world->memory, &sheet->queue, sheet->queue.count + points) ||
        !kiriArray_Reserve(&world->memory, &sheet->cuts, (int64_t)sheet->cuts.count + 1)) {
        return KIRI_ERROR_MEMORY;
    }
    kiriResult result = kiriWorld_ReserveIds(world, &world->cutIds, 1);
    kiriCutData* cut = result == KIRI_OK ? kiriMemory_AllocZeroed(&world->memory, sizeof(*cut)) : NULL;
    if (cut == NULL) {
        return result != KIRI_OK ? result : KIRI_ERROR_MEMORY;
    }
    kiriWorld_EnlistCut(world, sheet, cut);
    *made = cut;
    return KIRI_OK;
}

void kiriWorld_EnlistCut(kiriWorld* world, kiriSheetData* sheet, kiriCutData* cut)
{
    KIRI_ASSERT(sheet->cuts.count < sheet->cuts.capacity);
    cut->sheet = sheet;
    cut->tip.blade.vertex = cut->committed.blade.vertex = KIRI_NONE;
    cut->id = kiriPool_Add(&world->cutIds, &world->memory, cut, 0);
    cut->index = sheet->cuts.count;
    sheet->cuts.data[sheet->cuts.count++] = cut;
}

void kiriWorld_QueuePoint(const kiriWorld* world, kiriCutData* cut, kiriVec2 to, bool jump)
{
    kiriSheetData* sheet = cut->sheet;
    const kiriQueuedPoint point = { cut, to, world->ticks, jump };
    KIRI_ASSERT(sheet->queue.count < sheet->queue.capacity);
    cut->waiting += 1;
    sheet->queue.data[sheet->queue.count++] = point;
}

void kiriWorld_RemoveCut(kiriWorld* world, kiriCutData* cut)
{
    kiriPool_Remove(&world->cutIds, cut->id);
    kiriMemory_Free(&world->memory, cut);
}

/* ---- Pieces that get a sheet of their own, or are taken away ------------------------------------------------------ */

/* Ids name what has moved to this sheet, or to another place in it. */
static void PointIds(kiriWorld* world, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        kiriSlot* slot = kiriPool_Find(&world->frameIds, sheet->frames.data[i].id);
        slot->owner = sheet;
        slot->index = i;
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriSlot* slot = kiriPool_Find(&world->pinIds, sheet->pins.data[i].id);
        slot->owner = sheet;
        slot->index = i;
    }
}

/* A line may hold both parts: then the rest, which has its ids already, keeps the pin's, and the part gets another. */
static void NamePins(kiriWorld* world, const kiriSheetData* rest, kiriSheetData* part)
{
    for (int32_t i = 0; i < part->pins.count; ++i) {
        if (kiriPool_Find(&world->pinIds, part->pins.data[i].id)->owner == rest) {
            part->pins.data[i].id = kiriPool_Add(&world->pinIds, &world->memory, part, i);
        }
    }
}

/* A sheet of the pieces that are kept, without ids; null for memory. */
static kiriSheetData* MakePart(kiriWorld* world, kiriExtract* extract)
{
    kiriSheetData* part = kiriSheet_New(&world->memory);
    if (part != NULL && !kiriExtract_Build(extract, part)) {
        kiriSheet_Delete(part, &world->memory);
        part = NULL;
    }
    return part;
}

/* The rest takes the place of the sheet, which is deleted. */
static void ReplaceByRest(kiriWorld* world, const kiriExtract* extract, kiriSheetData* sheet, kiriSheetData* rest)
{
    kiriExtract_MoveCuts(extract, sheet, rest);
    for (int32_t i = 0; i < world->sheets.count; ++i) {
        world->sheets.data[i] = world->sheets.data[i] == sheet ? rest : world->sheets.data[i];
    }
    kiriPool_Find(&world->sheetIds, rest->id)->owner = rest;
    PointIds(world, rest);
    kiriMemory_AdoptAll(&world->retired, &sheet->shown);
    kiriSheet_Delete(sheet, &world->memory);
}

/* The pieces that are kept, or all others. */
static void KeepOthers(kiriExtract* extract)
{
    for (int32_t p = 0; p < extract->keep.count; ++p) {
        extract->keep.data[p] = !extract->keep.data[p];
    }
}

static kiriResult DetachKept(kiriWorld* world, kiriSheetData* sheet, kiriExtract* extract, kiriSheet* id)
{
    kiriResult result = kiriWorld_ReserveSheet(world);
    kiriSheetData* part = result == KIRI_OK ? MakePart(world, extract) : NULL;
    KeepOthers(extract);
    kiriSheetData* rest = part != NULL ? MakePart(world, extract) : NULL;
    if (rest != NULL) {
        int64_t inBoth = (int64_t)part->pins.count + rest->pins.count - sheet->pins.count;
        result = kiriWorld_ReserveIds(world, &world->pinIds, inBoth);
    }
    if (rest == NULL || result != KIRI_OK) {
        kiriSheet_Delete(part, &world->memory);
        kiriSheet_Delete(rest, &world->memory);
        return result != KIRI_OK ? result : KIRI_ERROR_MEMORY;
    }
    ReplaceByRest(world, extract, sheet, rest);
    world->sheets.data[world->sheets.count++] = part;
    part->id = *id = kiriPool_Add(&world->sheetIds, &world->memory, part, 0);
    NamePins(world, rest, part);
    PointIds(world, part);
    return KIRI_OK;
}

/* Only what is kept stays. */
static kiriResult KeepOnly(kiriWorld* world, kiriSheetData* sheet, kiriExtract* extract)
{
    kiriSheetData* rest = MakePart(world, extract);
    if (rest == NULL) {
        return KIRI_ERROR_MEMORY;
    }
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (extract->frameTo.data[i] == KIRI_NONE) {
            kiriPool_Remove(&world->frameIds, sheet->frames.data[i].id);
        }
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        if (extract->pinTo.data[i] == KIRI_NONE) {
            kiriPool_Remove(&world->pinIds, sheet->pins.data[i].id);
        }
    }
    ReplaceByRest(world, extract, sheet, rest);
    return KIRI_OK;
}

kiriResult kiriWorld_DetachPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece, kiriSheet* id)
{
    kiriExtract extract;
    kiriResult result = KIRI_ERROR_MEMORY;
    if (kiriExtract_Init(&extract, sheet)) {
        extract.keep.data[piece] = 1;
        result = DetachKept(world, sheet, &extract, id);
    }
    kiriMemory_FreeAll(&extract.memory);
    return result;
}

kiriResult kiriWorld_DestroyPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece)
{
    kiriExtract extract;
    kiriResult result = KIRI_ERROR_MEMORY;
    if (kiriExtract_Init(&extract, sheet)) {
        extract.keep.data[piece] = 1;
        KeepOthers(&extract);
        result = KeepOnly(world, sheet, &extract);
    }
    kiriMemory_FreeAll(&extract.memory);
    return result;
}

/* Marks what stays, and returns how many pieces do not. */
static int32_t KeepAbove(kiriExtract* extract, double area)
{
    const kiriLayout* layout = &extract->from->layout;
    int32_t largest = 0, dropped = 0;
    for (int32_t p = 1; p < layout->pieces.count; ++p) {
        largest = layout->pieces.data[p].area > layout->pieces.data[largest].area ? p : largest;
    }
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        extract->keep.data[p] = p == largest || layout->pieces.data[p].area >= area;
        dropped += !extract->keep.data[p];
    }
    return dropped;
}

kiriResult kiriWorld_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count)
{
    kiriExtract extract;
    kiriResult result = KIRI_ERROR_MEMORY;
    *count = 0;
    if (kiriExtract_Init(&extract, sheet)) {
        int32_t dropped = KeepAbove(&extract, area);
        result = dropped > 0 ? KeepOnly(world, sheet, &extract) : KIRI_OK;
        *count = result == KIRI_OK ? dropped : 0;
    }
    kiriMemory_FreeAll(&extract.memory);
    return result;
}
