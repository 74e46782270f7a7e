#include "kiri_part.h"
#include "kiri_call.h"
#include "kiri_seam.h"
#include "../sheet/kiri_detach.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_update.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_touch.h"

/* A sheet that loses pieces. */
typedef struct PartSource {
    kiriDetach detach;
    kiriPast past;  /* of the sheet after the loss */
    bool waits;     /* its pieces leave in a later tick */
    double samples; /* the cost if they leave at once */
} PartSource;

/* A piece that leaves. */
typedef struct Part {
    PartSource* from;
    kiriFrame frame;      /* names the piece */
    kiriSheetData* sheet; /* that it becomes; null: not made yet */
    int32_t piece;
} Part;

/* The pieces that one call, or one tick of a sheet, detaches or removes. */
typedef struct Parting {
    kiriWorld* world;
    kiriMemory memory;
    KIRI_ARRAY(PartSource) sources; /* never moves: each owns memory */
    bool isInTick;
    KIRI_ARRAY(Part) parts;
} Parting;

/* Makes room for `sheets` sources. False for memory. Call EndParting in any case. */
static bool StartParting(Parting* parting, kiriWorld* world, int32_t sheets)
{
    KIRI_CLEAR(parting);
    parting->world = world;
    parting->memory = kiriMemory_Like(&world->memory);
    return kiriArray_ReserveJust(&parting->memory, &parting->sources, sheets);
}

static void EndParting(Parting* parting)
{
    KIRI_EACH(PartSource, source, parting->sources) {
        kiriDetach_Drop(&source->detach);
    }
    kiriMemory_FreeAll(&parting->memory);
}

/* ---- Which pieces ------------------------------------------------------------------------------------------------ */

/* Adds a sheet. All its pieces stay for now, except those that are gone. Null for memory. */
static PartSource* AddSource(Parting* parting, kiriSheetData* sheet)
{
    PartSource* source = &KIRI_NEXT(parting->sources);
    KIRI_CLEAR(source);
    if (!kiriDetach_Init(&source->detach, sheet)) {
        return NULL;
    }
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        source->detach.rest.pieces.data[p] = !sheet->layout.pieces.data[p].isGone;
    }
    return source;
}

static PartSource* FindSource(const Parting* parting, const kiriSheetData* sheet)
{
    KIRI_EACH(PartSource, source, parting->sources) {
        if (source->detach.sheet == sheet) {
            return source;
        }
    }
    return NULL;
}

static int32_t PieceOfFrame(const kiriWorld* world, kiriFrame frame)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
    KIRI_ASSERT(slot != NULL);
    return ((const kiriSheetData*)slot->owner)->layout.framePiece.data[slot->index];
}

/* Marks the pieces of frames to leave, and lists each once. False for memory. */
static bool MarkPieces(Parting* parting, const kiriFrame* frames, int32_t count)
{
    KIRI_TIMES(i, count) {
        kiriSheetData* sheet = kiriPool_Find(&parting->world->frameIds, frames[i])->owner;
        PartSource* source = FindSource(parting, sheet);
        Part part = { source != NULL ? source : AddSource(parting, sheet), frames[i], NULL,
                      PieceOfFrame(parting->world, frames[i]) };
        if (part.from == NULL) {
            return false;
        }
        uint8_t* stays = &part.from->detach.rest.pieces.data[part.piece];
        if (*stays && !kiriArray_Push(&parting->memory, &parting->parts, part)) {
            return false;
        }
        *stays = 0;
    }
    return true;
}

/* Returns true if the piece waits to become a sheet. */
static bool IsLeaving(const kiriWorld* world, const kiriSheetData* sheet, int32_t piece)
{
    KIRI_ASSERT_HAS(sheet->layout.pieces, piece);
    KIRI_EACH(const kiriFrame, at, sheet->leaving) {
        if (kiriPool_Find(&world->frameIds, *at) != NULL && PieceOfFrame(world, *at) == piece) {
            return true;
        }
    }
    return false;
}

bool kiriParts_StaySome(const kiriWorld* world, const kiriSheetData* sheet, const kiriFlags* rest)
{
    bool some = false;
    KIRI_ASSERT(sheet->layout.pieces.count > 0);
    KIRI_EACH_INDEX_WHILE(!some, p, sheet->layout.pieces) {
        bool isThere = rest != NULL ? rest->data[p] != 0 : !sheet->layout.pieces.data[p].isGone;
        some = isThere && !IsLeaving(world, sheet, p);
    }
    return some;
}

/* ---- Costs ------------------------------------------------------------------------------------------------------- */

/* Defers sheets whose pieces cost more than the remaining samples of a tick. Sheets with a cut in progress, or with
   other pending pieces, are always deferred. */
static void ChooseWhatWaits(Parting* parting, bool makesSheets)
{
    kiriWorld* world = parting->world;
    double left = world->budget.samples > 0 ? (double)world->budget.samples - (double)world->samplesDue : 1e18;
    KIRI_EACH(PartSource, source, parting->sources) {
        const kiriSheetData* sheet = source->detach.sheet;
        bool isBusy = !kiriUpdate_IsFieldCurrent(sheet->update);
        source->samples = kiriDetach_Samples(sheet, 1.0 - kiriSubset_Share(&source->detach.rest), makesSheets);
        source->waits = !parting->isInTick &&
                        (isBusy || (makesSheets && (source->samples > left || kiriParts_AreDue(sheet))));
        left -= source->waits ? 0.0 : source->samples;
    }
}

/* ---- Out of their sheets ----------------------------------------------------------------------------------------- */

static bool MapSources(Parting* parting, bool makesParts)
{
    bool ok = true;
    KIRI_EACH_WHILE(ok, PartSource, source, parting->sources) {
        ok = source->waits || kiriDetach_Map(&source->detach, makesParts);
    }
    return ok;
}

static bool StageSources(Parting* parting)
{
    bool ok = true;
    KIRI_EACH_WHILE(ok, PartSource, source, parting->sources) {
        const kiriPast past = kiriPast_At(&source->detach.sheet->past, parting->world->begun);
        ok = source->waits ||
             (kiriDetach_Stage(&source->detach) &&
              kiriPast_Keep(&source->past, &past, &parting->memory, &source->detach.rest.vertices));
    }
    return ok;
}

static void PointId(const kiriPool* pool, uint32_t id, kiriSheetData* sheet, int32_t index)
{
    kiriSlot* slot = kiriPool_Find(pool, id);
    slot->owner = sheet;
    slot->index = index;
}

/* Updates the ids of items that moved to this sheet, or to another index in it. */
static void PointIds(kiriWorld* world, kiriSheetData* sheet)
{
    KIRI_EACH_INDEX(i, sheet->frames) {
        PointId(&world->frameIds, sheet->frames.data[i].id, sheet, i);
    }
    KIRI_EACH_INDEX(i, sheet->pins) {
        PointId(&world->pinIds, sheet->pins.data[i].id, sheet, i);
    }
}

/* Charges the cost of a call to the coming ticks. KIRI_PENDING: some sheets wait. */
static kiriResult CommitSources(Parting* parting)
{
    kiriWorld* world = parting->world;
    kiriResult result = KIRI_OK;
    KIRI_EACH(PartSource, source, parting->sources) {
        kiriSheetData* sheet = source->detach.sheet;
        if (source->waits) {
            result = KIRI_PENDING;
            continue;
        }
        KIRI_ASSERT(kiriUpdate_IsFieldCurrent(sheet->update));
        kiriDetach_Commit(&source->detach, &world->retired);
        sheet->past = source->past;
        kiriMemory_Adopt(&world->retired, (void*)source->past.others);
        PointIds(world, sheet);
        world->samplesDue += world->budget.samples > 0 && !parting->isInTick ? (int64_t)source->samples : 0;
    }
    return result;
}

/* ---- Sheets of their own ----------------------------------------------------------------------------------------- */

static bool MakeParts(Parting* parting)
{
    bool ok = true;
    KIRI_EACH_WHILE(ok, Part, part, parting->parts) {
        kiriDetach* detach = &part->from->detach;
        if (!part->from->waits) {
            const kiriPast past = kiriPast_At(&detach->sheet->past, parting->world->begun);
            const kiriPieceItems* vertices = &detach->of[KIRI_LISTED_VERTICES];
            kiriSpan span = kiriPieceItems_Of(vertices, part->piece);
            part->sheet = kiriSheet_New(&parting->world->memory);
            ok = part->sheet != NULL && kiriDetach_MakePart(detach, part->piece, part->sheet) &&
                 kiriPast_Part(&part->sheet->past, &past, &parting->memory, detach->sheet->id,
                               &vertices->items.data[span.first], span.count);
        }
    }
    return ok;
}

/* Reserves the ids of the parts and of pins that hold several, and room in the lists of those that wait. */
static kiriResult ReserveIdsOfParts(Parting* parting)
{
    int64_t pins = 0;
    int32_t made = 0;
    KIRI_EACH(const Part, part, parting->parts) {
        kiriSheetData* from = part->from->detach.sheet;
        pins += part->sheet != NULL ? part->sheet->pins.count : 0;
        made += part->sheet != NULL;
        if (!kiriArray_ReserveMore(from->memory, &from->leaving, parting->parts.count)) {
            return KIRI_ERROR_MEMORY;
        }
    }
    kiriResult result = kiriWorld_ReserveSheets(parting->world, made);
    return result == KIRI_OK ? kiriWorld_ReserveIds(parting->world, &parting->world->pinIds, pins) : result;
}

/* Gives sheet and pins of a part their ids. A line may hold several pieces: then the remaining sheet keeps the pin's id,
   or else the first part, and other parts get new ids. The ids of the remaining sheet do not point to its pins yet. */
static void AddSheetOfPart(kiriWorld* world, const Part* part)
{
    const kiriDetach* detach = &part->from->detach;
    kiriSheetData* sheet = part->sheet;
    KIRI_ASSERT(world->sheets.count < world->sheets.capacity && sheet->layout.pieces.count == 1);
    KIRI_NEXT(world->sheets) = sheet;
    sheet->id = kiriPool_Add(&world->sheetIds, sheet, 0);
    kiriMemory_Adopt(&world->retired, (void*)sheet->past.others);
    KIRI_EACH_INDEX(i, sheet->pins) {
        const kiriSlot* slot = kiriPool_Find(&world->pinIds, sheet->pins.data[i].id);
        if (slot->owner != detach->sheet || kiriKeep_Has(&detach->rest.pins, slot->index)) {
            sheet->pins.data[i].id = kiriPool_Add(&world->pinIds, sheet, i);
        }
    }
    PointIds(world, sheet);
}

static kiriResult Detach(Parting* parting)
{
    ChooseWhatWaits(parting, true);
    bool ok = MapSources(parting, parting->parts.count > 0) && MakeParts(parting) && StageSources(parting);
    kiriResult result = ok ? ReserveIdsOfParts(parting) : KIRI_ERROR_MEMORY;
    KIRI_EACH(const Part, part, parting->parts) {
        kiriSheetData* from = part->from->detach.sheet;
        if (result != KIRI_OK) {
            kiriSheet_Delete(part->sheet, &parting->world->memory);
        } else if (part->sheet != NULL) {
            AddSheetOfPart(parting->world, part);
        } else if (!IsLeaving(parting->world, from, part->piece)) {
            KIRI_ASSERT(part->from->waits);
            KIRI_NEXT(from->leaving) = part->frame;
            from->rest.isIdle = false;
        }
    }
    if (result != KIRI_OK) {
        return result;
    }
    return CommitSources(parting);
}

/* ---- Pieces that wait -------------------------------------------------------------------------------------------- */

/* Drops stale frames of pieces that were removed, or detached by a call, in the meantime. */
static void ForgetStaleLeaving(kiriWorld* world, kiriSheetData* sheet)
{
    const kiriSlot* slot;
    KIRI_KEEP_IF(const kiriFrame, frame, sheet->leaving,
                 (slot = kiriPool_Find(&world->frameIds, *frame)) != NULL && slot->owner == sheet);
}

bool kiriParts_AreDue(const kiriSheetData* sheet)
{
    return kiriUpdate_IsFieldCurrent(sheet->update) && (sheet->leaving.count > 0 || kiriPieces_AnyGone(sheet));
}

/* Returns how many of the pieces that wait `samples` pay for, first come first, with all that are gone. KIRI_NONE: less
   than the first. *cost is the cost of these, or of the first. */
static int32_t CountPaid(const kiriWorld* world, const kiriSheetData* sheet, int64_t samples, int64_t* cost)
{
    const kiriPiece* pieces = sheet->layout.pieces.data;
    double whole = 0.0, gone = 0.0, leaving = 0.0, none = kiriDetach_Samples(sheet, 0.0, true);
    KIRI_EACH_INDEX(p, sheet->layout.pieces) {
        whole += pieces[p].area;
        gone += pieces[p].isGone ? pieces[p].area : 0.0;
    }
    KIRI_ASSERT(gone < whole);
    *cost = (int64_t)none;
    KIRI_EACH_INDEX(k, sheet->leaving) {
        leaving += pieces[PieceOfFrame(world, sheet->leaving.data[k])].area;
        int64_t next = (int64_t)kiriDetach_Samples(sheet, leaving / whole, true);
        if (k > 0 && next > samples) {
            return k;
        }
        *cost = next;
        if (next > samples) {
            return KIRI_NONE;
        }
    }
    return *cost <= samples ? sheet->leaving.count : KIRI_NONE;
}

void kiriParts_Pay(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples)
{
    if (!kiriParts_AreDue(sheet)) {
        return;
    }
    ForgetStaleLeaving(world, sheet);
    int64_t paid = sheet->leavingPaid, cost;
    CountPaid(world, sheet, samples->left < INT64_MAX - paid ? paid + samples->left : INT64_MAX, &cost);
    int64_t due = cost > paid ? cost - paid : 0;
    (void)kiriQuota_Pay(samples, &due);
    sheet->leavingPaid = kiriMax(cost - due, paid);
}

static kiriResult LeaveFirst(kiriWorld* world, kiriSheetData* sheet, int32_t count)
{
    Parting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    bool hasRoom = StartParting(&parting, world, 1) && kiriArray_ReserveMore(&world->memory, &world->events, count);
    parting.isInTick = true;
    if (hasRoom && AddSource(&parting, sheet) != NULL && MarkPieces(&parting, sheet->leaving.data, count)) {
        result = Detach(&parting);
    }
    EndParting(&parting);
    return result;
}

kiriResult kiriParts_Leave(kiriWorld* world, kiriSheetData* sheet)
{
    if (!kiriParts_AreDue(sheet)) {
        return KIRI_OK;
    }
    ForgetStaleLeaving(world, sheet);
    int64_t cost;
    int32_t count = CountPaid(world, sheet, sheet->leavingPaid, &cost);
    kiriResult result = count != KIRI_NONE ? LeaveFirst(world, sheet, count) : KIRI_OK;
    if (result != KIRI_OK || count == KIRI_NONE) {
        return result;
    }
    KIRI_TIMES(k, count) {
        const kiriSheetData* part = kiriPool_Find(&world->frameIds, sheet->leaving.data[k])->owner;
        kiriEvent* event = kiriWorld_AddEvent(world, KIRI_EVENT_PIECE_DETACHED, part);
        event->frame = sheet->leaving.data[k];
        event->area = (float)part->layout.pieces.data[0].area;
        world->newEvents += 1;
    }
    KIRI_FROM_TO(k, count, sheet->leaving.count) {
        sheet->leaving.data[k - count] = sheet->leaving.data[k];
    }
    KIRI_ASSERT(count <= sheet->leaving.count);
    sheet->leaving.count -= count;
    sheet->leavingPaid = 0;
    return KIRI_OK;
}

/* ---- Pieces that are removed ------------------------------------------------------------------------------------- */

static void ForgetFrames(kiriWorld* world, const kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    KIRI_EACH_INDEX(i, sheet->frames) {
        if (!detach->rest.pieces.data[sheet->layout.framePiece.data[i]]) {
            kiriPool_Remove(&world->frameIds, sheet->frames.data[i].id);
            sheet->frames.data[i].id = 0;
        }
    }
}

/* Removes pins that hold nothing of the rest. The last pin takes the place of each. */
static void RemovePins(kiriWorld* world, const kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    KIRI_EACH_INDEX_BACK(i, sheet->pins) {
        if (kiriSubset_FrameOfPin(&detach->rest, i) == KIRI_NONE) {
            kiriPool_Remove(&world->pinIds, sheet->pins.data[i].id);
            kiriPins_Remove(sheet, i);
        }
    }
    KIRI_EACH_INDEX(i, sheet->pins) {
        kiriPool_Find(&world->pinIds, sheet->pins.data[i].id)->index = i;
    }
}

/* Hides the pieces until they can be removed. */
static void HidePieces(kiriWorld* world, const kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    ForgetFrames(world, detach);
    RemovePins(world, detach);
    KIRI_EACH_INDEX(p, detach->rest.pieces) {
        sheet->layout.pieces.data[p].isGone = !detach->rest.pieces.data[p];
    }
    kiriTouches_Sort(sheet); /* nothing that is gone pushes */
    kiriSheet_SumRest(sheet);
    kiriView_HideGone(sheet);
}

static kiriResult Destroy(Parting* parting)
{
    ChooseWhatWaits(parting, false);
    bool ok = MapSources(parting, false) && StageSources(parting);
    KIRI_EACH_WHILE(ok, const PartSource, source, parting->sources) { /* triangles will be hidden in the indices */
        kiriSheetData* sheet = source->detach.sheet;
        ok = !source->waits || kiriArray_Renew(&sheet->shown, &sheet->seen.surface.indices, sizeof(int32_t),
                                               &parting->world->retired);
    }
    if (!ok) {
        return KIRI_ERROR_MEMORY;
    }
    KIRI_EACH(const PartSource, source, parting->sources) {
        const kiriDetach* detach = &source->detach;
        if (source->waits) {
            HidePieces(parting->world, detach);
        } else {
            ForgetFrames(parting->world, detach);
            KIRI_EACH_INDEX(i, detach->sheet->pins) {
                if (!kiriKeep_Has(&detach->rest.pins, i)) {
                    kiriPool_Remove(&parting->world->pinIds, detach->sheet->pins.data[i].id);
                }
            }
        }
    }
    kiriResult result = CommitSources(parting);
    kiriSeams_DropStale(parting->world);
    return result;
}

/* Detaches the pieces of these frames in one pass for each sheet; if ids is null, removes them. KIRI_PENDING: some are
   pending. ids[i] becomes the sheet of frames[i], or 0 while pending. KIRI_ERROR_STATE: a sheet would lose all of its
   pieces. On failure, also for memory or ids, nothing has changed. */
static kiriResult TakeOut(kiriCall* call, const kiriFrame* frames, int32_t count, kiriSheet* ids)
{
    kiriWorld* world = call->world;
    Parting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    kiriFault fault;
    if (StartParting(&parting, world, kiriMin(count, world->sheets.count)) && MarkPieces(&parting, frames, count)) {
        bool areLeft = true; /* pieces of each sheet */
        KIRI_EACH_WHILE(areLeft, const PartSource, source, parting.sources) {
            areLeft = kiriParts_StaySome(world, source->detach.sheet, &source->detach.rest.pieces);
            KIRI_SAY(&fault, "nothing would be left of sheet %lld: use that, or kiriDestroySheet",
                     (long long)source->detach.sheet->id);
        }
        result = !areLeft ? KIRI_ERROR_STATE : ids != NULL ? Detach(&parting) : Destroy(&parting);
    }
    KIRI_TIMES_WHILE(ids != NULL && result >= 0, i, count) {
        const kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frames[i])->owner;
        ids[i] = FindSource(&parting, sheet) != NULL ? 0 : sheet->id; /* else the frame would have left it */
    }
    EndParting(&parting);
    return kiriCall_End(world, call, call->function, result,
                        result == KIRI_ERROR_STATE ? fault.line : NULL);
}

kiriResult kiriFrame_DetachPiece(kiriWorld* world, kiriFrame frame, kiriSheet* detached)
{
    KIRI_CHANGES(Frame_DetachPiece, &frame, detached);
    return TakeOut(call, &frame, 1, detached);
}

kiriResult kiriFrame_DestroyPiece(kiriWorld* world, kiriFrame frame)
{
    KIRI_CHANGES(Frame_DestroyPiece, &frame);
    return TakeOut(call, &frame, 1, NULL);
}

kiriResult kiriWorld_DetachPieces(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* detached)
{
    KIRI_CHANGES(World_DetachPieces, frames, &count, detached);
    return TakeOut(call, frames, count, detached);
}

kiriResult kiriWorld_DestroyPieces(kiriWorld* world, const kiriFrame* frames, int32_t count)
{
    KIRI_CHANGES(World_DestroyPieces, frames, &count);
    return TakeOut(call, frames, count, NULL);
}

/* ---- Crumbs ------------------------------------------------------------------------------------------------------ */

/* Returns the largest piece of the subset. isToStay: skips pieces that are about to become sheets. */
static int32_t LargestOf(const kiriWorld* world, const kiriSubset* subset, bool isToStay)
{
    const kiriPiece* pieces = subset->from->layout.pieces.data;
    int32_t largest = KIRI_NONE;
    KIRI_EACH_INDEX(p, subset->pieces) {
        bool isLarger = largest == KIRI_NONE || pieces[p].area > pieces[largest].area;
        if (subset->pieces.data[p] && isLarger && !(isToStay && IsLeaving(world, subset->from, p))) {
            largest = p;
        }
    }
    return largest;
}

/* Marks the pieces to leave, and returns their number. */
static int32_t MarkBelow(const kiriWorld* world, kiriSubset* rest, double area)
{
    const kiriPiece* pieces = rest->from->layout.pieces.data;
    int32_t dropped = 0, largest = LargestOf(world, rest, false);
    int32_t second = IsLeaving(world, rest->from, largest) ? LargestOf(world, rest, true) : largest;
    KIRI_EACH_INDEX(p, rest->pieces) {
        bool stays = p == largest || p == second || pieces[p].area >= area;
        dropped += rest->pieces.data[p] && !stays;
        rest->pieces.data[p] = rest->pieces.data[p] && stays;
    }
    return dropped;
}

kiriResult kiriSheet_DropCrumbs(kiriWorld* world, kiriSheet sheet, float area, int32_t* count)
{
    KIRI_CHANGES(Sheet_DropCrumbs, &sheet, &area, count);
    Parting parting;
    PartSource* source = StartParting(&parting, world, 1) ? AddSource(&parting, call->sheet) : NULL;
    kiriResult result = source != NULL ? KIRI_OK : KIRI_ERROR_MEMORY;
    *count = 0;
    if (result == KIRI_OK) {
        int32_t dropped = MarkBelow(world, &source->detach.rest, area);
        result = dropped > 0 ? Destroy(&parting) : KIRI_OK;
        *count = result >= 0 ? dropped : 0;
    }
    EndParting(&parting);
    KIRI_RETURN(result);
}
