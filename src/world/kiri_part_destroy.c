/* Pieces that are taken away. */
#include "kiri_part_work.h"

#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_touch.h"

static void ForgetIds(kiriWorld* world, const kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        if (!removal->kept.pieces.data[sheet->layout.framePiece.data[i]]) {
            kiriPool_Remove(&world->frameIds, sheet->frames.data[i].id);
            sheet->frames.data[i].id = 0;
        }
    }
}

/* Those that hold nothing of what is left. The last one takes the place of each. */
static void RemovePins(kiriWorld* world, const kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    for (int32_t i = sheet->pins.count - 1; i >= 0; --i) {
        if (kiriKept_FrameOfPin(&removal->kept, i) == KIRI_NONE) {
            kiriPool_Remove(&world->pinIds, sheet->pins.data[i].id);
            kiriPins_Remove(sheet, i);
        }
    }
    for (int32_t i = 0; i < sheet->pins.count; ++i) {
        kiriPool_Find(&world->pinIds, sheet->pins.data[i].id)->index = i;
    }
}

/* Nobody sees or touches the pieces any more, until they can be taken away. */
static void MarkRemoved(kiriWorld* world, const kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    ForgetIds(world, removal);
    RemovePins(world, removal);
    for (int32_t p = 0; p < removal->kept.pieces.count; ++p) {
        sheet->layout.pieces.data[p].isGone = !removal->kept.pieces.data[p];
    }
    kiriTouches_Sort(sheet); /* nothing that is gone pushes */
    kiriMotion_SumRest(sheet);
    kiriView_HideGone(sheet);
}

static void ForgetPins(kiriWorld* world, const kiriRemoval* removal)
{
    for (int32_t i = 0; i < removal->sheet->pins.count; ++i) {
        if (!kiriKeep_Has(&removal->kept.pins, i)) {
            kiriPool_Remove(&world->pinIds, removal->sheet->pins.data[i].id);
        }
    }
}

/* The host may hold the indices. */
static bool RenewIndices(kiriParting* parting)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->sourceCount; ++k) {
        kiriSheetData* sheet = parting->sources[k].removal.sheet;
        ok = !parting->sources[k].waits || kiriSurface_RenewIndices(&sheet->seen.surface, &sheet->shown,
                                                                    &parting->world->retired, parting->world->ticks);
    }
    return ok;
}

static kiriResult Destroy(kiriParting* parting)
{
    kiriParting_ChooseWhatWaits(parting, false);
    if (!kiriParting_Gather(parting, false) || !kiriParting_Stage(parting) || !RenewIndices(parting)) {
        return KIRI_ERROR_MEMORY;
    }
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        const kiriRemoval* removal = &parting->sources[k].removal;
        if (parting->sources[k].waits) {
            MarkRemoved(parting->world, removal);
        } else {
            ForgetIds(parting->world, removal);
            ForgetPins(parting->world, removal);
        }
    }
    kiriParting_Commit(parting);
    kiriParting_Charge(parting);
    return kiriParting_Result(parting);
}

kiriResult kiriParts_Destroy(kiriWorld* world, const kiriFrame* frames, int32_t count)
{
    kiriParting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    if (kiriParting_Start(&parting, world, kiriMin(count, world->sheets.count)) &&
        kiriParting_MarkPieces(&parting, frames, count)) {
        result = kiriParting_LeavesSome(&parting) ? Destroy(&parting) : KIRI_ERROR_STATE;
    }
    kiriParting_End(&parting);
    return result;
}

/* ---- Crumbs ---- */

/* The largest of the pieces that are kept; or of those of them that do not wait to become a sheet. */
static int32_t LargestKept(const kiriWorld* world, const kiriKept* kept, bool isToStay)
{
    const kiriLayout* layout = &kept->from->layout;
    int32_t largest = KIRI_NONE;
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        bool isLarger = largest == KIRI_NONE || layout->pieces.data[p].area > layout->pieces.data[largest].area;
        if (kept->pieces.data[p] && isLarger && !(isToStay && kiriPart_IsLeaving(world, kept->from, p))) {
            largest = p;
        }
    }
    return largest;
}

/* Marks what goes, and returns how many pieces these are. */
static int32_t MarkBelow(const kiriWorld* world, kiriKept* kept, double area)
{
    const kiriLayout* layout = &kept->from->layout;
    int32_t dropped = 0, largest = LargestKept(world, kept, false);
    int32_t second = kiriPart_IsLeaving(world, kept->from, largest) ? LargestKept(world, kept, true) : largest;
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        bool stays = p == largest || p == second || layout->pieces.data[p].area >= area;
        dropped += kept->pieces.data[p] && !stays;
        kept->pieces.data[p] = kept->pieces.data[p] && stays;
    }
    return dropped;
}

kiriResult kiriParts_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count)
{
    kiriParting parting;
    kiriPartSource* source = kiriParting_Start(&parting, world, 1) ? kiriParting_AddSource(&parting, sheet) : NULL;
    kiriResult result = source != NULL ? KIRI_OK : KIRI_ERROR_MEMORY;
    *count = 0;
    if (result == KIRI_OK) {
        int32_t dropped = MarkBelow(world, &source->removal.kept, area);
        result = dropped > 0 ? Destroy(&parting) : KIRI_OK;
        *count = result >= 0 ? dropped : 0;
    }
    kiriParting_End(&parting);
    return result;
}
