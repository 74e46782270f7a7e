#include "kiri_world.h"

#include "../sheet/kiri_build.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_tear.h"

#define RESTING 0.5 /* s: a tear that does not go on for this long ends */
#define CALM 0.05    /* s: no tear begins by itself while another one goes on, which may unload the sheet */
#define TIPS 8       /* that tear at a time, if the host names no number */
#define LOOKS 4      /* tips measured in a tick, for each that may tear */

kiriResult kiriWorld_ReserveIds(kiriWorld* world, kiriPool* pool, int64_t count)
{
    if (!kiriPool_HasRoom(pool, count)) {
        return KIRI_ERROR_LIMIT;
    }
    return kiriPool_Reserve(pool, &world->memory, (int32_t)count) ? KIRI_OK : KIRI_ERROR_MEMORY;
}

void kiriWorld_RemovePin(kiriWorld* world, kiriSheetData* sheet, int32_t index)
{
    KIRI_ASSERT_HAS(sheet->pins, index);
    kiriPin pin = sheet->pins.data[index].id;
    kiriPins_ForgetHistory(sheet, index);
    kiriSheet_WakePin(sheet, index);
    kiriPins_Remove(sheet, index);
    if (index < sheet->pins.count) {
        kiriPool_Find(&world->pinIds, sheet->pins.data[index].id)->index = index;
    }
    kiriPool_Remove(&world->pinIds, pin);
}

kiriResult kiriWorld_ReserveSheets(kiriWorld* world, int32_t count)
{
    int64_t sheets = (int64_t)world->sheets.count + count;
    return kiriArrays_Reserve(&world->memory, sheets, &world->sheets, &world->active, &world->atWork)
               ? kiriWorld_ReserveIds(world, &world->sheetIds, count)
               : KIRI_ERROR_MEMORY;
}

kiriResult kiriWorld_AddSheet(kiriWorld* world, const kiriSheetDef* def, const kiriFold* folds, int32_t foldCount,
                              kiriSheet* id, kiriFault* fault)
{
    kiriSheetData* sheet = kiriSheet_New(&world->memory);
    kiriResult result = sheet != NULL ? kiriBuild_FromDef(sheet, def, folds, foldCount, fault) : KIRI_ERROR_MEMORY;
    if (sheet != NULL) {
        KIRI_EACH_WHILE(result == KIRI_OK, const kiriFrameData, frame, sheet->frames) {
            if (!kiriFrame_FitsFloats(frame)) {
                KIRI_SAY(fault, "floats cannot hold where it is, or how it moves");
                result = KIRI_ERROR_ARGUMENT;
            }
        }
    }
    if (result == KIRI_OK) {
        result = kiriWorld_ReserveSheets(world, 1);
    }
    if (result == KIRI_OK) {
        result = kiriWorld_ReserveIds(world, &world->frameIds, sheet->frames.count);
    }
    if (result != KIRI_OK) {
        kiriSheet_Delete(sheet, &world->memory);
        return result;
    }
    KIRI_NEXT(world->sheets) = sheet;
    sheet->id = kiriPool_Add(&world->sheetIds, sheet, 0);
    KIRI_EACH_INDEX(i, sheet->frames) {
        sheet->frames.data[i].id = kiriPool_Add(&world->frameIds, sheet, i);
    }
    kiriView_WritePositions(sheet);
    sheet->past = kiriPast_None(world->begun);
    *id = sheet->id;
    return KIRI_OK;
}

void kiriWorld_RemoveSheet(kiriWorld* world, kiriSheetData* sheet)
{
    KIRI_EACH(const kiriFrameData, frame, sheet->frames) {
        kiriPool_Remove(&world->frameIds, frame->id);
    }
    KIRI_EACH(const kiriPinData, pin, sheet->pins) {
        kiriPool_Remove(&world->pinIds, pin->id);
    }
    KIRI_EACH_OF(kiriCutData, cut, sheet->cuts) {
        kiriWorld_RemoveCut(world, cut);
    }
    kiriPool_Remove(&world->sheetIds, sheet->id);
    KIRI_KEEP_IF(kiriSheetData*, at, world->sheets, *at != sheet);
    kiriMemory_AdoptAll(&world->retired, &sheet->shown);
    world->mostRevision = kiriMax(sheet->seen.surface.revision, world->mostRevision);
    kiriSheet_Delete(sheet, &world->memory);
}

kiriResult kiriWorld_AddCut(kiriWorld* world, kiriSheetData* sheet, int64_t points, kiriCutData** made)
{
    if (!kiriArray_Reserve(&world->memory, &sheet->queue, sheet->queue.count + points + 1) ||
        !kiriArray_ReserveMore(&world->memory, &sheet->cuts, 1)) {
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
    cut->sheet = sheet;
    cut->tip.blade.vertex = KIRI_NONE;
    cut->id = kiriPool_Add(&world->cutIds, cut, 0);
    cut->index = sheet->cuts.count;
    KIRI_NEXT(sheet->cuts) = cut;
    sheet->rest.isIdle = false;
}

void kiriWorld_QueuePoint(const kiriWorld* world, kiriCutData* cut, kiriVec2 to, bool jump)
{
    kiriSheetData* sheet = cut->sheet;
    const kiriQueuedPoint point = { cut, to, world->ticks, jump, false };
    cut->waiting += 1;
    KIRI_NEXT(sheet->queue) = point;
}

void kiriWorld_EndCut(const kiriWorld* world, kiriCutData* cut)
{
    kiriSheetData* sheet = cut->sheet;
    int32_t last = sheet->queue.count - 1;
    while (last >= 0 && sheet->queue.data[last].cut != cut && sheet->queue.data[last].stamp == world->ticks) {
        --last;
    }
    if (last < 0 || sheet->queue.data[last].stamp != world->ticks) {
        kiriWorld_QueuePoint(world, cut, cut->tip.last, true);
        last = sheet->queue.count - 1;
    }
    sheet->queue.data[last].ends = true;
    cut->ended = true;
}

void kiriWorld_RemoveCut(kiriWorld* world, kiriCutData* cut)
{
    kiriPool_Remove(&world->cutIds, cut->id);
    kiriMemory_Free(&world->memory, cut);
}

/* ---- Events ---- */

kiriEvent* kiriWorld_AddEvent(kiriWorld* world, int32_t type, const kiriSheetData* sheet)
{
    kiriEvent* event = &KIRI_NEXT(world->events);
    KIRI_CLEAR(event);
    event->type = type;
    event->sheet = sheet->id;
    event->stage = KIRI_NONE;
    return event;
}

/* ---- Tears ---- */

/* Adds a point to a tear; null: begins one. */
static kiriResult GoOn(kiriWorld* world, kiriSheetData* sheet, kiriCutData* cut, kiriVec2 from, kiriVec2 to,
                       kiriVec2 along)
{
    if (!kiriArray_ReserveMore(&world->memory, &world->events, 1) ||
        !kiriArray_ReserveMore(&world->memory, &sheet->queue, 2)) {
        return KIRI_ERROR_MEMORY;
    }
    if (cut == NULL) {
        kiriResult result = kiriWorld_AddCut(world, sheet, 2, &cut);
        if (result != KIRI_OK) {
            return result;
        }
        kiriWorld_QueuePoint(world, cut, from, true);
        kiriWorld_AddEvent(world, KIRI_EVENT_TEAR_BEGAN, sheet)->cut = cut->id;
        world->newEvents += 1;
    }
    KIRI_ASSERT(cut->sheet == sheet && cut->waiting <= 1 && !cut->ended);
    kiriWorld_QueuePoint(world, cut, to, false);
    cut->tears = along;
    cut->rests = 0.0;
    return KIRI_OK;
}

/* Measures tears, and a number of other tips, by turns. */
static kiriResult GrowIn(kiriWorld* world, kiriSheetData* sheet, double dt, kiriQuota* systems)
{
    const kiriTearing* tearing = &sheet->settings.tearing;
    const kiriTears* tears = &sheet->tears;
    bool isMeasured = kiriTears_List(sheet) &&
                      kiriMotion_Foresee(sheet, world->gravity, dt, world->seams.count > 0 ? NULL : systems) &&
                      kiriTears_Measure(sheet);
    kiriResult result = isMeasured ? KIRI_OK : KIRI_ERROR_MEMORY;
    int32_t count = tears->order.count, left = tearing->maxTips > 0 ? tearing->maxTips : TIPS;
    int32_t looks = (int32_t)kiriMin((int64_t)LOOKS * left, (int64_t)count);
    int32_t first = count > 0 ? (int32_t)(world->ticks * looks % count) : 0;
    double most = tearing->maxSpeed > 0.0f ? tearing->maxSpeed * dt : 1e9;
    for (int32_t n = 0; result == KIRI_OK && n < count && left > 0; ++n) {
        kiriTearTip tip = tears->found.data[tears->order.data[(first + n) % count]];
        kiriCutData* cut = NULL;
        bool isLed = false; /* the host goes on with the cut */
        KIRI_EACH_OF(kiriCutData, each, sheet->cuts) {
            if (!each->ended && kiriLattice_IsSame(each->tip.blade.at, tip.point)) {
                isLed |= !kiriCut_IsTear(each);
                cut = kiriCut_IsTear(each) ? each : cut;
            }
        }
        int32_t piece = kiriPiece_OfVertex(sheet, tip.vertex);
        bool isDue = cut != NULL ? cut->waiting == 0 : n < looks;
        if (isLed || !isDue || !kiriPiece_IsAwake(&sheet->layout.pieces.data[piece])) {
            continue;
        }
        tip.along = cut != NULL ? cut->tears : tip.along;
        kiriVec2 along, to = kiriTear_Next(sheet, &tip, most, &along), from = kiriMesh_Local(&sheet->mesh, tip.point);
        if (to.x != from.x || to.y != from.y) {
            result = GoOn(world, sheet, cut, from, to, along);
            left -= 1;
        }
    }
    bool mayStart = tearing->strength > 0.0f && result == KIRI_OK;
    KIRI_EACH_OF(kiriCutData, cut, sheet->cuts) {
        mayStart &= !kiriCut_IsTear(cut) || cut->rests > CALM;
    }
    kiriVec2 from, to;
    if (mayStart && kiriTears_FindStart(sheet, most, &from, &to)) {
        result = GoOn(world, sheet, NULL, from, to, kiriVec2_Normalize(kiriVec2_Sub(to, from)));
    }
    kiriMotion_Return(sheet);
    return result;
}

kiriResult kiriTears_Grow(kiriWorld* world, double dt, kiriQuota* systems)
{
    kiriResult result = KIRI_OK;
    KIRI_EACH_ACTIVE(sheet, world) {
        if (result == KIRI_OK && kiriTears_MayGrow(sheet) && sheet->update->stage == KIRI_NONE) {
            result = GrowIn(world, sheet, dt, systems);
        }
    }
    return result;
}

void kiriTears_EndResting(kiriWorld* world, double dt)
{
    KIRI_EACH_ACTIVE(sheet, world) {
        KIRI_EACH_OF(kiriCutData, cut, sheet->cuts) {
            cut->rests += kiriCut_IsTear(cut) && cut->waiting == 0 ? dt : 0.0;
            if (cut->rests > RESTING && !cut->ended && kiriArray_ReserveMore(&world->memory, &sheet->queue, 1)) {
                kiriWorld_EndCut(world, cut);
            }
        }
    }
}
