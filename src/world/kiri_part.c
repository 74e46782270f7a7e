#include "kiri_part.h"

#include "../sheet/kiri_ahead.h"
#include "../sheet/kiri_extract.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_remove.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_touch.h"
#include "../sheet/kiri_update.h"

#include <string.h>

/* A piece that is taken out. */
typedef struct Part {
    struct Source* from;
    kiriFrame frame;      /* that names it */
    kiriSheetData* sheet; /* that it becomes; null: not made yet */
    int32_t piece;
} Part;

/* A sheet that loses something. */
typedef struct Source {
    kiriRemoval removal;
    kiriExtraction extraction;
    bool leavesHoles;
    bool waits;     /* what is to become a sheet does so later */
    double samples; /* that it costs at once */
} Source;

/* What one call takes out of sheets. */
typedef struct Parting {
    kiriWorld* world;
    kiriMemory memory;
    Source* sources;
    int32_t sourceCount, sourceRoom;
    bool isInTick;
    KIRI_ARRAY(Part) parts;
} Parting;

static bool Parting_Start(Parting* parting, kiriWorld* world, int32_t sheets)
{
    memset(parting, 0, sizeof(*parting));
    parting->world = world;
    parting->memory = kiriMemory_Like(&world->memory);
    parting->sourceRoom = sheets;
    parting->sources = kiriMemory_AllocZeroed(&parting->memory, sheets * (int64_t)sizeof(Source));
    return parting->sources != NULL;
}

static void Parting_End(Parting* parting)
{
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        kiriExtraction_Drop(&parting->sources[k].extraction);
        kiriRemoval_Drop(&parting->sources[k].removal);
        if (!parting->sources[k].waits) {
            kiriAhead_Drop(parting->sources[k].removal.sheet, &parting->world->memory);
        }
    }
    kiriMemory_FreeAll(&parting->memory);
}

/* Work on a cut is at hand in the sheet. */
static bool IsBusy(const kiriSheetData* sheet)
{
    return !kiriUpdate_IsFieldCurrent(sheet->update);
}

/* ---- Which pieces ---- */

/* All of the sheet is left, for now, but for what is gone; null for memory. */
static Source* AddSource(Parting* parting, kiriSheetData* sheet)
{
    KIRI_ASSERT(parting->sourceCount < parting->sourceRoom);
    Source* source = &parting->sources[parting->sourceCount++];
    kiriRemoval* removal = &source->removal;
    if (!kiriRemoval_Init(removal, sheet)) {
        return NULL;
    }
    for (int32_t p = 0; p < removal->kept.pieces.count; ++p) {
        removal->kept.pieces.data[p] = !sheet->layout.pieces.data[p].isGone;
    }
    return source;
}

static Source* SourceFor(Parting* parting, kiriSheetData* sheet)
{
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        if (parting->sources[k].removal.sheet == sheet) {
            return &parting->sources[k];
        }
    }
    return AddSource(parting, sheet);
}

static bool IsSource(const Parting* parting, const kiriSheetData* sheet)
{
    bool any = false;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        any = any || parting->sources[k].removal.sheet == sheet;
    }
    return any;
}

static int32_t PieceOfFrame(const kiriWorld* world, kiriFrame frame)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
    return ((const kiriSheetData*)slot->owner)->layout.framePiece.data[slot->index];
}

/* Marks the pieces of frames to go, and lists each once. False for memory. */
static bool MarkPieces(Parting* parting, const kiriFrame* frames, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        kiriSheetData* sheet = kiriPool_Find(&parting->world->frameIds, frames[i])->owner;
        Part part = { SourceFor(parting, sheet), frames[i], NULL, PieceOfFrame(parting->world, frames[i]) };
        if (part.from == NULL) {
            return false;
        }
        uint8_t* stays = &part.from->removal.kept.pieces.data[part.piece];
        if (*stays && !kiriArray_Push(&parting->memory, &parting->parts, part)) {
            return false;
        }
        *stays = 0;
    }
    return true;
}

/* Does the piece wait to become a sheet? */
static bool IsLeaving(const kiriWorld* world, const kiriSheetData* sheet, int32_t piece)
{
    for (int32_t k = 0; k < sheet->leaving.count; ++k) {
        if (kiriPool_Find(&world->frameIds, sheet->leaving.data[k]) != NULL &&
            PieceOfFrame(world, sheet->leaving.data[k]) == piece) {
            return true;
        }
    }
    return false;
}

/* Is something left of each sheet? */
static bool LeavesSome(const Parting* parting)
{
    bool all = true;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        const kiriKept* kept = &parting->sources[k].removal.kept;
        bool some = false;
        for (int32_t p = 0; p < kept->pieces.count && !some; ++p) {
            some = kept->pieces.data[p] && !IsLeaving(parting->world, kept->from, p);
        }
        all = all && some;
    }
    return all;
}

/* KIRI_PENDING where some of it waits. */
static kiriResult ResultOf(const Parting* parting)
{
    kiriResult result = KIRI_OK;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        result = parting->sources[k].waits ? KIRI_PENDING : result;
    }
    return result;
}

/* ---- What it costs ---- */

/* A call does at once what is left of one tick's samples; the rest waits, each sheet's for itself. What work is at hand in,
   or has others that wait, waits in any case. */
static void ChooseWhatWaits(Parting* parting, bool makesSheets)
{
    kiriWorld* world = parting->world;
    double left = world->budget.samples > 0 ? (double)world->budget.samples - (double)world->samplesDue : 1e18;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        Source* source = &parting->sources[k];
        const kiriSheetData* sheet = source->removal.sheet;
        double share = 1.0 - kiriKept_Share(&source->removal.kept);
        source->leavesHoles = !kiriRemoval_IsWorthAPass(sheet, share);
        source->samples =
            kiriRemoval_Samples(sheet, share) + (makesSheets ? kiriExtraction_Samples(sheet, share) : 0.0);
        source->waits = !parting->isInTick &&
                        (IsBusy(sheet) || (makesSheets && (source->samples > left || kiriParts_AreDue(sheet))));
        left -= source->waits ? 0.0 : source->samples;
    }
}

/* Once it is done. */
static void ChargeCall(const Parting* parting)
{
    kiriWorld* world = parting->world;
    for (int32_t k = 0; k < parting->sourceCount && world->budget.samples > 0 && !parting->isInTick; ++k) {
        world->samplesDue += parting->sources[k].waits ? 0 : (int64_t)parting->sources[k].samples;
    }
}

/* ---- Out of their sheets ---- */

/* What the sheet loses is listed once for all its parts. */
static bool GatherSources(Parting* parting, bool makesParts)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->sourceCount; ++k) {
        Source* source = &parting->sources[k];
        bool isNeeded = makesParts || source->leavesHoles;
        ok = source->waits || !isNeeded || kiriRemoval_Gather(&source->removal);
    }
    return ok;
}

/* The host may hold the indices, but not at the end of a tick. */
static bool StageRemoval(Parting* parting, Source* source)
{
    kiriSheetData* sheet = source->removal.sheet;
    return kiriRemoval_Stage(&source->removal, source->leavesHoles) &&
           (!source->leavesHoles || parting->isInTick ||
            kiriSurface_RenewIndices(&sheet->seen.surface, &sheet->shown, &parting->world->retired));
}

static bool StageRemovals(Parting* parting)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->sourceCount; ++k) {
        Source* source = &parting->sources[k];
        ok = source->waits || StageRemoval(parting, source);
    }
    return ok;
}

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

static void CommitRemovals(Parting* parting)
{
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        if (!parting->sources[k].waits) {
            kiriRemoval_Commit(&parting->sources[k].removal, &parting->world->retired);
            PointIds(parting->world, parting->sources[k].removal.sheet);
        }
    }
}

/* ---- Sheets of their own ---- */

static bool MakePart(Parting* parting, Part* part)
{
    Source* from = part->from;
    part->sheet = kiriAhead_Take(from->removal.sheet, part->frame);
    part->sheet = part->sheet != NULL ? part->sheet : kiriSheet_New(&parting->world->memory);
    return part->sheet != NULL &&
           (from->extraction.kept.from != NULL || kiriExtraction_Init(&from->extraction, &from->removal.gathered)) &&
           kiriExtraction_Build(&from->extraction, part->piece, part->sheet);
}

static bool MakeParts(Parting* parting)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->parts.count; ++k) {
        Part* part = &parting->parts.data[k];
        ok = part->from->waits || MakePart(parting, part);
    }
    return ok;
}

static void DeleteParts(Parting* parting)
{
    for (int32_t k = 0; k < parting->parts.count; ++k) {
        kiriSheet_Delete(parting->parts.data[k].sheet, &parting->world->memory);
    }
}

/* Room for the ids of the parts, and of pins that hold more than one; and in the lists of those that wait. */
static kiriResult ReserveIdsOfParts(Parting* parting)
{
    int64_t pins = 0;
    int32_t made = 0;
    for (int32_t k = 0; k < parting->parts.count; ++k) {
        kiriSheetData *sheet = parting->parts.data[k].sheet, *from = parting->parts.data[k].from->removal.sheet;
        pins += sheet != NULL ? sheet->pins.count : 0;
        made += sheet != NULL;
        if (!kiriArray_Reserve(from->memory, &from->leaving, (int64_t)from->leaving.count + parting->parts.count)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    kiriResult result = kiriWorld_ReserveSheets(parting->world, made);
    return result == KIRI_OK ? kiriWorld_ReserveIds(parting->world, &parting->world->pinIds, pins) : result;
}

/* A line may hold more pieces than one: then what is left keeps the pin's id, or else the first part, and others get
   another. What is left does not point to its pins yet. */
static void NamePins(kiriWorld* world, const Part* part)
{
    for (int32_t i = 0; i < part->sheet->pins.count; ++i) {
        kiriPinData* pin = &part->sheet->pins.data[i];
        const kiriSlot* slot = kiriPool_Find(&world->pinIds, pin->id);
        if (slot->owner != part->from->removal.sheet || kiriKeep_Has(&part->from->removal.kept.pins, slot->index)) {
            pin->id = kiriPool_Add(&world->pinIds, &world->memory, part->sheet, i);
        }
    }
}

static void AddSheetOfPart(kiriWorld* world, const Part* part)
{
    kiriSheetData* sheet = part->sheet;
    world->sheets.data[world->sheets.count++] = sheet;
    sheet->id = kiriPool_Add(&world->sheetIds, &world->memory, sheet, 0);
    NamePins(world, part);
    PointIds(world, sheet);
}

/* When the work at hand is done, unless it is listed already. */
static void AddLeaving(kiriWorld* world, const Part* part)
{
    kiriSheetData* sheet = part->from->removal.sheet;
    if (!IsLeaving(world, sheet, part->piece)) {
        sheet->leaving.data[sheet->leaving.count++] = part->frame;
        sheet->rest.isIdle = false;
    }
}

static kiriResult Detach(Parting* parting)
{
    ChooseWhatWaits(parting, true);
    bool ok = GatherSources(parting, parting->parts.count > 0) && MakeParts(parting) && StageRemovals(parting);
    kiriResult result = ok ? ReserveIdsOfParts(parting) : KIRI_ERROR_MEMORY;
    if (result != KIRI_OK) {
        DeleteParts(parting);
        return result;
    }
    for (int32_t k = 0; k < parting->parts.count; ++k) {
        const Part* part = &parting->parts.data[k];
        part->sheet != NULL ? AddSheetOfPart(parting->world, part) : AddLeaving(parting->world, part);
    }
    CommitRemovals(parting);
    ChargeCall(parting);
    return ResultOf(parting);
}

kiriResult kiriParts_Detach(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* ids)
{
    Parting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    if (Parting_Start(&parting, world, count < world->sheets.count ? count : world->sheets.count) &&
        MarkPieces(&parting, frames, count)) {
        result = LeavesSome(&parting) ? Detach(&parting) : KIRI_ERROR_STATE;
    }
    for (int32_t i = 0; result >= 0 && i < count; ++i) {
        const kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frames[i])->owner;
        ids[i] = IsSource(&parting, sheet) ? 0 : sheet->id; /* else the frame would have left it */
    }
    Parting_End(&parting);
    return result;
}

/* ---- Taken away ---- */

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
static bool RenewIndices(Parting* parting)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->sourceCount; ++k) {
        kiriSheetData* sheet = parting->sources[k].removal.sheet;
        ok = !parting->sources[k].waits ||
             kiriSurface_RenewIndices(&sheet->seen.surface, &sheet->shown, &parting->world->retired);
    }
    return ok;
}

static kiriResult Destroy(Parting* parting)
{
    ChooseWhatWaits(parting, false);
    if (!GatherSources(parting, false) || !StageRemovals(parting) || !RenewIndices(parting)) {
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
    CommitRemovals(parting);
    ChargeCall(parting);
    return ResultOf(parting);
}

kiriResult kiriParts_Destroy(kiriWorld* world, const kiriFrame* frames, int32_t count)
{
    Parting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    if (Parting_Start(&parting, world, count < world->sheets.count ? count : world->sheets.count) &&
        MarkPieces(&parting, frames, count)) {
        result = LeavesSome(&parting) ? Destroy(&parting) : KIRI_ERROR_STATE;
    }
    Parting_End(&parting);
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
        if (kept->pieces.data[p] && isLarger && !(isToStay && IsLeaving(world, kept->from, p))) {
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
    int32_t second = IsLeaving(world, kept->from, largest) ? LargestKept(world, kept, true) : largest;
    for (int32_t p = 0; p < layout->pieces.count; ++p) {
        bool stays = p == largest || p == second || layout->pieces.data[p].area >= area;
        dropped += kept->pieces.data[p] && !stays;
        kept->pieces.data[p] = kept->pieces.data[p] && stays;
    }
    return dropped;
}

kiriResult kiriParts_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count)
{
    Parting parting;
    Source* source = Parting_Start(&parting, world, 1) ? AddSource(&parting, sheet) : NULL;
    kiriResult result = source != NULL ? KIRI_OK : KIRI_ERROR_MEMORY;
    *count = 0;
    if (result == KIRI_OK) {
        int32_t dropped = MarkBelow(world, &source->removal.kept, area);
        result = dropped > 0 ? Destroy(&parting) : KIRI_OK;
        *count = result >= 0 ? dropped : 0;
    }
    Parting_End(&parting);
    return result;
}

/* ---- What waits ---- */

/* Those that are destroyed meanwhile become nothing; others were detached by a call while the budget was awaited. */
static void ForgetStaleLeaving(kiriWorld* world, kiriSheetData* sheet)
{
    int32_t kept = 0;
    for (int32_t k = 0; k < sheet->leaving.count; ++k) {
        kiriFrame frame = sheet->leaving.data[k];
        const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
        if (slot != NULL && slot->owner == sheet) {
            sheet->leaving.data[kept++] = frame;
        }
    }
    sheet->leaving.count = kept;
}

bool kiriParts_AreDue(const kiriSheetData* sheet)
{
    return !IsBusy(sheet) && (sheet->leaving.count > 0 || kiriPieces_AnyGone(sheet));
}

/* Samples for what is gone, and for the first `count` of those that leave. */
static int64_t CostOfLeaving(const kiriWorld* world, const kiriSheetData* sheet, int32_t count)
{
    const kiriPiece* pieces = sheet->layout.pieces.data;
    double whole = 0.0, gone = 0.0, share = 0.0;
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        whole += pieces[p].area;
    }
    for (int32_t p = 0; p < sheet->layout.pieces.count; ++p) {
        gone += pieces[p].isGone ? pieces[p].area / whole : 0.0;
    }
    for (int32_t k = 0; k < count; ++k) {
        share += pieces[PieceOfFrame(world, sheet->leaving.data[k])].area / whole;
    }
    return (int64_t)(kiriRemoval_Samples(sheet, gone + share) + kiriExtraction_Samples(sheet, share));
}

/* How many of those that leave the samples pay for, what was paid before with them: one at least, which takes several ticks
   if need be. KIRI_NONE: it is not paid for yet. */
static int32_t PayForLeaving(const kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples)
{
    int32_t count = sheet->leaving.count > 0, most = sheet->leaving.count;
    int64_t paid = sheet->leavingPaid, cost = CostOfLeaving(world, sheet, count);
    while (count < most) {
        int32_t more = most - count > 16 ? count + (most - count) / 2 : count + 1;
        int64_t costOfMore = CostOfLeaving(world, sheet, more);
        if (costOfMore - paid > samples->left) {
            most = more - 1;
        } else {
            count = more;
            cost = costOfMore;
        }
    }
    int64_t due = cost > paid ? cost - paid : 0;
    bool isPaid = kiriQuota_Pay(samples, &due);
    sheet->leavingPaid = cost - due;
    return isPaid ? count : KIRI_NONE;
}

/* With what has just been paid: somewhat faster than that, so that all is made when all is paid. Cells of a sheet that is
   made anew take less than those beside a cut. */
static void GoAhead(kiriWorld* world, kiriSheetData* sheet, int64_t samples)
{
    enum { CELLS_FOR_A_SAMPLE = 24 };
    kiriQuotas quotas = kiriQuotas_Unlimited();
    quotas.of[KIRI_QUOTA_CELLS].left = CELLS_FOR_A_SAMPLE * samples;
    quotas.of[KIRI_QUOTA_SAMPLES].left = samples + samples / 2;
    if (sheet->leaving.count > 0 && samples > 0) {
        kiriAhead_GoOn(sheet, sheet->leaving.data[0], &world->memory, &quotas);
    }
}

int32_t kiriParts_Finish(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples)
{
    Parting parting;
    if (!kiriParts_AreDue(sheet)) {
        return 0;
    }
    ForgetStaleLeaving(world, sheet);
    int64_t used = samples->used;
    int32_t count = PayForLeaving(world, sheet, samples);
    if (count == KIRI_NONE) {
        GoAhead(world, sheet, samples->used - used);
        return 0;
    }
    bool isDone = Parting_Start(&parting, world, 1);
    parting.isInTick = true;
    isDone = isDone && SourceFor(&parting, sheet) != NULL && MarkPieces(&parting, sheet->leaving.data, count) &&
             Detach(&parting) == KIRI_OK;
    sheet->leavingPaid = isDone ? 0 : sheet->leavingPaid;
    Parting_End(&parting);
    return isDone ? count : 0;
}

void kiriParts_ForgetMade(kiriSheetData* sheet, int32_t made)
{
    for (int32_t k = made; k < sheet->leaving.count; ++k) {
        sheet->leaving.data[k - made] = sheet->leaving.data[k];
    }
    sheet->leaving.count -= made;
}
