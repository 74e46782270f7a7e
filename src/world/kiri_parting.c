#include "kiri_parting.h"

#include "../sheet/kiri_extract.h"

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
    if (rest == NULL) {
        kiriSheet_Delete(part, &world->memory);
        return result != KIRI_OK ? result : KIRI_ERROR_MEMORY;
    }
    ReplaceByRest(world, extract, sheet, rest);
    world->sheets.data[world->sheets.count++] = part;
    part->id = *id = kiriPool_Add(&world->sheetIds, &world->memory, part, 0);
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
