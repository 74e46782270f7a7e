#include "kiri_world_check.h"

#include "../sheet/kiri_sheet_check.h"
#include "kiri_blade.h"
#include "kiri_call.h"

#include <string.h>

/* ---- Ids --------------------------------------------------------------------------------------------------------- */

enum { MOST_GENERATIONS = 127 };

/* Slots that are free are in one list; what was claimed is in none. */
static bool IsPool(kiriCheck* check, const kiriPool* pool, uint32_t kind)
{
    bool isFine = kiriCheck_That(check, pool->kind == kind && pool->freeCount >= 0);
    kiriChains chains;
    if (!isFine || pool->slots.count == 0) {
        return isFine && kiriCheck_That(check, pool->freeSlot == KIRI_NONE && pool->freeCount == 0);
    }
    for (int32_t k = 0; isFine && k < pool->slots.count; ++k) {
        isFine = pool->slots.data[k].generation >= 1 && pool->slots.data[k].generation <= MOST_GENERATIONS;
    }
    isFine = kiriCheck_That(check, isFine) &&
             kiriCheck_StartChains(check, &chains, &pool->slots.data->index, sizeof(kiriSlot), pool->slots.count) &&
             kiriCheck_Chain(check, &chains, pool->freeSlot);
    for (int32_t k = 0; isFine && k < pool->slots.count; ++k) {
        isFine = !chains.seen[k] || pool->slots.data[k].owner == NULL;
    }
    return kiriCheck_That(check, isFine && chains.listed == pool->freeCount);
}

static bool ArePools(kiriCheck* check, const kiriWorld* world)
{
    return IsPool(check, &world->sheetIds, KIRI_KIND_SHEET) && IsPool(check, &world->cutIds, KIRI_KIND_CUT) &&
           IsPool(check, &world->frameIds, KIRI_KIND_FRAME) && IsPool(check, &world->pinIds, KIRI_KIND_PIN) &&
           IsPool(check, &world->obstacleIds, KIRI_KIND_OBSTACLE) && IsPool(check, &world->bladeIds, KIRI_KIND_BLADE);
}

/* ---- Blades ------------------------------------------------------------------------------------------------------ */

static const kiriMust LayerMust[] = {
    KIRI_REALS(kiriLayer, rest, share),
    KIRI_REALS(kiriLayer, loop.start, loop.then),
};

static const kiriMust BladeMust[] = {
    KIRI_REALS(kiriBladeData, edge, elapsed),
    KIRI_ITEMS_MUST(kiriBladeData, layers, LayerMust),
};

/* The cut of a layer is one of its sheet. */
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

static bool AreBlades(kiriCheck* check, const kiriWorld* world)
{
    bool areFine = true;
    for (int32_t i = 0; areFine && i < world->blades.count; ++i) {
        areFine = kiriCheck_Object(check, BladeMust, world->blades.data[i]) &&
                  kiriCheck_That(check, AreLayers(world, world->blades.data[i]));
    }
    return areFine;
}

/* ---- The world --------------------------------------------------------------------------------------------------- */

static const kiriMust TouchingPairMust[] = {
    KIRI_WITHIN(-1, 1, kiriTouchingPair, side, side),
    KIRI_WITHIN(0, 1, kiriTouchingPair, touches, touches),
};

static const kiriMust FeltMust[] = {
    KIRI_REALS(kiriFeltPush, force, force),
};

static const kiriMust WorldMust[] = {
    KIRI_REALS(kiriWorld, gravity, gravity),
    KIRI_WITHIN(0, INT32_MAX, kiriWorld, budget, budget),
    KIRI_COUNTS(kiriWorld, samplesDue, ticks),
    KIRI_WITHIN(0, INT32_MAX, kiriWorld, turn, turn),
    KIRI_ITEMS_MUST(kiriWorld, pairs.pairs, TouchingPairMust),
    KIRI_ITEMS_MUST(kiriWorld, pairs.felt, FeltMust),
};

/* Their order is made anew by each tick. */
static bool AreObstacles(kiriCheck* check, const kiriWorld* world)
{
    bool areFine = true;
    for (int32_t i = 0; areFine && i < world->obstacles.count; ++i) {
        areFine = kiriObstacle_Check(world->obstacles.data[i], check);
    }
    return areFine;
}

static bool HasRooms(const kiriWorld* world)
{
    int32_t sheets = world->sheets.count;
    return world->active.capacity >= sheets && world->atWork.capacity >= sheets && world->newEvents >= 0 &&
           world->newEvents <= world->events.count;
}

/* ---- Sheets ------------------------------------------------------------------------------------------------------ */

/* What the host gave is what it may give. */
static bool AreGiven(const kiriSettings* settings)
{
    kiriFault fault;
    const kiriSheetSettings* given = &settings->given;
    return kiriStruct_Check(&kiriSettingsStruct, "", NULL, given, &fault) == KIRI_OK &&
           memcmp(&given->material, &settings->material, sizeof(given->material)) == 0 &&
           given->iterations == settings->iterations && given->skinning == settings->skinning &&
           given->timeStepping == settings->mechanics.timeStepping;
}

/* Pieces that leave are of this sheet. */
static bool AreLeaving(const kiriWorld* world, const kiriSheetData* sheet)
{
    bool areFine = sheet->leavingPaid >= 0;
    for (int32_t k = 0; areFine && k < sheet->leaving.count; ++k) {
        const kiriSlot* slot = kiriPool_Find(&world->frameIds, sheet->leaving.data[k]);
        areFine = slot == NULL || slot->owner == sheet;
    }
    return areFine;
}

bool kiriWorld_CheckMade(kiriWorld* world, bool* isShort)
{
    kiriCheck check;
    memset(&check, 0, sizeof(check));
    bool isFine = true;
    for (int32_t i = 0; isFine && i < world->sheets.count; ++i) {
        isFine = kiriSheet_CheckMade(world->sheets.data[i], &check);
    }
    *isShort = check.isShort && !check.isBad;
    return isFine && kiriCheck_IsFine(&check);
}

bool kiriWorld_Check(kiriWorld* world, bool* isShort)
{
    kiriCheck check;
    memset(&check, 0, sizeof(check));
    check.memory = kiriMemory_Like(&world->memory);
    bool isFine = ArePools(&check, world) && kiriCheck_Object(&check, WorldMust, world) &&
                  kiriCheck_That(&check, HasRooms(world)) && AreObstacles(&check, world);
    for (int32_t i = 0; isFine && i < world->sheets.count; ++i) {
        kiriSheetData* sheet = world->sheets.data[i];
        isFine = kiriSheet_Check(sheet, &check) &&
                 kiriCheck_That(&check, AreGiven(&sheet->settings) && AreLeaving(world, sheet));
        kiriMemory_FreeAll(&check.memory);
    }
    isFine = isFine && AreBlades(&check, world);
    kiriMemory_FreeAll(&check.memory);
    *isShort = check.isShort && !check.isBad;
    return isFine && kiriCheck_IsFine(&check);
}
