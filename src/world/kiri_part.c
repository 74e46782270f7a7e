#include "kiri_part.h"
#include "../sheet/kiri_piece.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_update.h"
#include "../sheet/kiri_motion.h"
#include "../sheet/kiri_pin.h"
#include "../sheet/kiri_touch.h"

#include <string.h>

bool kiriParting_Start(kiriParting* parting, kiriWorld* world, int32_t sheets)
{
    memset(parting, 0, sizeof(*parting));
    parting->world = world;
    parting->memory = kiriMemory_Like(&world->memory);
    parting->sourceRoom = sheets;
    parting->sources = kiriMemory_AllocZeroed(&parting->memory, sheets * (int64_t)sizeof(kiriPartSource));
    return parting->sources != NULL;
}

void kiriParting_End(kiriParting* parting)
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

bool kiriPart_IsBusy(const kiriSheetData* sheet)
{
    return !kiriUpdate_IsFieldCurrent(sheet->update);
}

/* ---- Which pieces ---- */

kiriPartSource* kiriParting_AddSource(kiriParting* parting, kiriSheetData* sheet)
{
    KIRI_ASSERT(parting->sourceCount < parting->sourceRoom);
    kiriPartSource* source = &parting->sources[parting->sourceCount++];
    kiriRemoval* removal = &source->removal;
    if (!kiriRemoval_Init(removal, sheet)) {
        return NULL;
    }
    for (int32_t p = 0; p < removal->kept.pieces.count; ++p) {
        removal->kept.pieces.data[p] = !sheet->layout.pieces.data[p].isGone;
    }
    return source;
}

kiriPartSource* kiriParting_SourceFor(kiriParting* parting, kiriSheetData* sheet)
{
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        if (parting->sources[k].removal.sheet == sheet) {
            return &parting->sources[k];
        }
    }
    return kiriParting_AddSource(parting, sheet);
}

static bool IsSource(const kiriParting* parting, const kiriSheetData* sheet)
{
    bool any = false;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        any = any || parting->sources[k].removal.sheet == sheet;
    }
    return any;
}

int32_t kiriPart_PieceOfFrame(const kiriWorld* world, kiriFrame frame)
{
    const kiriSlot* slot = kiriPool_Find(&world->frameIds, frame);
    return ((const kiriSheetData*)slot->owner)->layout.framePiece.data[slot->index];
}

bool kiriParting_MarkPieces(kiriParting* parting, const kiriFrame* frames, int32_t count)
{
    for (int32_t i = 0; i < count; ++i) {
        kiriSheetData* sheet = kiriPool_Find(&parting->world->frameIds, frames[i])->owner;
        kiriPart part = { kiriParting_SourceFor(parting, sheet), frames[i], NULL,
                          kiriPart_PieceOfFrame(parting->world, frames[i]) };
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

bool kiriPart_IsLeaving(const kiriWorld* world, const kiriSheetData* sheet, int32_t piece)
{
    for (int32_t k = 0; k < sheet->leaving.count; ++k) {
        if (kiriPool_Find(&world->frameIds, sheet->leaving.data[k]) != NULL &&
            kiriPart_PieceOfFrame(world, sheet->leaving.data[k]) == piece) {
            return true;
        }
    }
    return false;
}

bool kiriParting_LeavesSome(const kiriParting* parting)
{
    bool all = true;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        const kiriKept* kept = &parting->sources[k].removal.kept;
        bool some = false;
        for (int32_t p = 0; p < kept->pieces.count && !some; ++p) {
            some = kept->pieces.data[p] && !kiriPart_IsLeaving(parting->world, kept->from, p);
        }
        all = all && some;
    }
    return all;
}

kiriResult kiriParting_Result(const kiriParting* parting)
{
    kiriResult result = KIRI_OK;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        result = parting->sources[k].waits ? KIRI_PENDING : result;
    }
    return result;
}

/* ---- What it costs ---- */

void kiriParting_ChooseWhatWaits(kiriParting* parting, bool makesSheets)
{
    kiriWorld* world = parting->world;
    double left = world->budget.samples > 0 ? (double)world->budget.samples - (double)world->samplesDue : 1e18;
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        kiriPartSource* source = &parting->sources[k];
        const kiriSheetData* sheet = source->removal.sheet;
        double share = 1.0 - kiriKept_Share(&source->removal.kept);
        source->leavesHoles = !kiriRemoval_IsWorthAPass(sheet, share);
        source->samples =
            kiriRemoval_Samples(sheet, share) + (makesSheets ? kiriExtraction_Samples(sheet, share) : 0.0);
        source->waits = !parting->isInTick && (kiriPart_IsBusy(sheet) ||
                                               (makesSheets && (source->samples > left || kiriParts_AreDue(sheet))));
        left -= source->waits ? 0.0 : source->samples;
    }
}

void kiriParting_Charge(const kiriParting* parting)
{
    kiriWorld* world = parting->world;
    for (int32_t k = 0; k < parting->sourceCount && world->budget.samples > 0 && !parting->isInTick; ++k) {
        world->samplesDue += parting->sources[k].waits ? 0 : (int64_t)parting->sources[k].samples;
    }
}

/* ---- Out of their sheets ---- */

bool kiriParting_Gather(kiriParting* parting, bool makesParts)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->sourceCount; ++k) {
        kiriPartSource* source = &parting->sources[k];
        bool isNeeded = makesParts || source->leavesHoles;
        ok = source->waits || !isNeeded || kiriRemoval_Gather(&source->removal);
    }
    return ok;
}

/* Vertices may get other indices. */
static bool StagePast(kiriParting* parting, kiriPartSource* source)
{
    const kiriRemoval* removal = &source->removal;
    const kiriPast past = kiriPast_At(&removal->sheet->past, parting->world->begun);
    source->past = past;
    return source->leavesHoles || kiriPast_Keep(&source->past, &past, &parting->memory, &removal->kept.vertices);
}

/* The host may hold the indices, but not at the end of a tick. */
static bool StageRemoval(kiriParting* parting, kiriPartSource* source)
{
    kiriSheetData* sheet = source->removal.sheet;
    return kiriRemoval_Stage(&source->removal, source->leavesHoles) && StagePast(parting, source) &&
           (!source->leavesHoles || parting->isInTick ||
            kiriSurface_RenewIndices(&sheet->seen.surface, &sheet->shown, &parting->world->retired,
                                     parting->world->ticks));
}

bool kiriParting_Stage(kiriParting* parting)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->sourceCount; ++k) {
        kiriPartSource* source = &parting->sources[k];
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

void kiriParting_Commit(kiriParting* parting)
{
    for (int32_t k = 0; k < parting->sourceCount; ++k) {
        if (!parting->sources[k].waits) {
            kiriRemoval_Commit(&parting->sources[k].removal, &parting->world->retired);
            parting->sources[k].removal.sheet->past = parting->sources[k].past;
            if (!parting->sources[k].leavesHoles) { /* else it is the one that it was */
                kiriMemory_Adopt(&parting->world->retired, (void*)parting->sources[k].past.others);
            }
            PointIds(parting->world, parting->sources[k].removal.sheet);
        }
    }
}

/* ---- Sheets of their own ---- */

static bool MakePastOfPart(kiriParting* parting, kiriPart* part)
{
    const kiriGathered* gathered = &part->from->removal.gathered;
    const kiriSheetData* from = part->from->removal.sheet;
    kiriSpan vertices = kiriGather_Find(gathered, part->piece)->vertices;
    const kiriPast past = kiriPast_At(&from->past, parting->world->begun);
    return kiriPast_Part(&part->sheet->past, &past, &parting->memory, from->id,
                         &gathered->vertices.data[vertices.first], vertices.count);
}

static bool MakePart(kiriParting* parting, kiriPart* part)
{
    kiriPartSource* from = part->from;
    part->sheet = kiriAhead_Take(from->removal.sheet, part->frame);
    part->sheet = part->sheet != NULL ? part->sheet : kiriSheet_New(&parting->world->memory);
    return part->sheet != NULL &&
           (from->extraction.kept.from != NULL || kiriExtraction_Init(&from->extraction, &from->removal.gathered)) &&
           kiriExtraction_Build(&from->extraction, part->piece, part->sheet) && MakePastOfPart(parting, part);
}

static bool MakeParts(kiriParting* parting)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < parting->parts.count; ++k) {
        kiriPart* part = &parting->parts.data[k];
        ok = part->from->waits || MakePart(parting, part);
    }
    return ok;
}

static void DeleteParts(kiriParting* parting)
{
    for (int32_t k = 0; k < parting->parts.count; ++k) {
        kiriSheet_Delete(parting->parts.data[k].sheet, &parting->world->memory);
    }
}

/* Room for the ids of the parts, and of pins that hold more than one; and in the lists of those that wait. */
static kiriResult ReserveIdsOfParts(kiriParting* parting)
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
static void NamePins(kiriWorld* world, const kiriPart* part)
{
    for (int32_t i = 0; i < part->sheet->pins.count; ++i) {
        kiriPinData* pin = &part->sheet->pins.data[i];
        const kiriSlot* slot = kiriPool_Find(&world->pinIds, pin->id);
        if (slot->owner != part->from->removal.sheet || kiriKeep_Has(&part->from->removal.kept.pins, slot->index)) {
            pin->id = kiriPool_Add(&world->pinIds, &world->memory, part->sheet, i);
        }
    }
}

static void AddSheetOfPart(kiriWorld* world, const kiriPart* part)
{
    kiriSheetData* sheet = part->sheet;
    world->sheets.data[world->sheets.count++] = sheet;
    sheet->id = kiriPool_Add(&world->sheetIds, &world->memory, sheet, 0);
    kiriMemory_Adopt(&world->retired, (void*)sheet->past.others);
    NamePins(world, part);
    PointIds(world, sheet);
}

/* When the work at hand is done, unless it is listed already. */
static void AddLeaving(kiriWorld* world, const kiriPart* part)
{
    kiriSheetData* sheet = part->from->removal.sheet;
    if (!kiriPart_IsLeaving(world, sheet, part->piece)) {
        sheet->leaving.data[sheet->leaving.count++] = part->frame;
        sheet->rest.isIdle = false;
    }
}

kiriResult kiriParting_Detach(kiriParting* parting)
{
    kiriParting_ChooseWhatWaits(parting, true);
    bool ok = kiriParting_Gather(parting, parting->parts.count > 0) && MakeParts(parting) && kiriParting_Stage(parting);
    kiriResult result = ok ? ReserveIdsOfParts(parting) : KIRI_ERROR_MEMORY;
    if (result != KIRI_OK) {
        DeleteParts(parting);
        return result;
    }
    for (int32_t k = 0; k < parting->parts.count; ++k) {
        const kiriPart* part = &parting->parts.data[k];
        part->sheet != NULL ? AddSheetOfPart(parting->world, part) : AddLeaving(parting->world, part);
    }
    kiriParting_Commit(parting);
    kiriParting_Charge(parting);
    return kiriParting_Result(parting);
}

kiriResult kiriParts_Detach(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* ids)
{
    kiriParting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    if (kiriParting_Start(&parting, world, kiriMin(count, world->sheets.count)) &&
        kiriParting_MarkPieces(&parting, frames, count)) {
        result = kiriParting_LeavesSome(&parting) ? kiriParting_Detach(&parting) : KIRI_ERROR_STATE;
    }
    for (int32_t i = 0; result >= 0 && i < count; ++i) {
        const kiriSheetData* sheet = kiriPool_Find(&world->frameIds, frames[i])->owner;
        ids[i] = IsSource(&parting, sheet) ? 0 : sheet->id; /* else the frame would have left it */
    }
    kiriParting_End(&parting);
    return result;
}

/* Pieces that wait: for the end of the work on a cut, or until the budget has paid for them. */

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
    return !kiriPart_IsBusy(sheet) && (sheet->leaving.count > 0 || kiriPieces_AnyGone(sheet));
}

static int32_t CountFrames(const kiriSheetData* sheet, int32_t piece)
{
    int32_t count = 0;
    for (int32_t i = 0; i < sheet->frames.count; ++i) {
        count += sheet->layout.framePiece.data[i] == piece;
    }
    return count;
}

/* Samples for the pieces that are gone, and for the first `count` pieces that leave. The first of these is made ahead,
   which takes more work than making it at once. */
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
    int32_t first = count > 0 ? kiriPart_PieceOfFrame(world, sheet->leaving.data[0]) : KIRI_NONE;
    double ahead = first != KIRI_NONE ? pieces[first].area / whole : 0.0;
    for (int32_t k = 1; k < count; ++k) {
        share += pieces[kiriPart_PieceOfFrame(world, sheet->leaving.data[k])].area / whole;
    }
    double samples = kiriRemoval_Samples(sheet, gone + ahead + share) + kiriExtraction_Samples(sheet, share);
    return (int64_t)(samples +
                     (first != KIRI_NONE ? kiriExtraction_SamplesAhead(sheet, ahead, CountFrames(sheet, first)) : 0.0));
}

/* Number of leaving pieces that these samples pay for, with all that are gone. KIRI_NONE: less than the first. */
static int32_t CountWithin(const kiriWorld* world, const kiriSheetData* sheet, int64_t samples)
{
    int32_t least = sheet->leaving.count > 0, end;
    if (CostOfLeaving(world, sheet, least) > samples) {
        return KIRI_NONE;
    }
    KIRI_SEARCH(end, least + 1, sheet->leaving.count + 1, CostOfLeaving(world, sheet, middle) <= samples);
    return end - 1;
}

void kiriParts_Pay(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples)
{
    if (!kiriParts_AreDue(sheet)) {
        return;
    }
    ForgetStaleLeaving(world, sheet);
    int64_t paid = sheet->leavingPaid;
    int32_t count = CountWithin(world, sheet, samples->left < INT64_MAX - paid ? paid + samples->left : INT64_MAX);
    int64_t cost = CostOfLeaving(world, sheet, count != KIRI_NONE ? count : sheet->leaving.count > 0);
    int64_t due = cost > paid ? cost - paid : 0;
    (void)kiriQuota_Pay(samples, &due);
    sheet->leavingPaid = kiriMax(cost - due, paid);
}

static kiriResult Part(kiriWorld* world, kiriSheetData* sheet, int32_t count)
{
    kiriParting parting;
    kiriResult result = KIRI_ERROR_MEMORY;
    bool hasRoom = kiriParting_Start(&parting, world, 1) &&
                   kiriArray_Reserve(&world->memory, &world->events, (int64_t)world->events.count + count);
    parting.isInTick = true;
    if (hasRoom && kiriParting_SourceFor(&parting, sheet) != NULL &&
        kiriParting_MarkPieces(&parting, sheet->leaving.data, count)) {
        result = kiriParting_Detach(&parting);
    }
    kiriParting_End(&parting);
    return result;
}

static void TellMade(kiriWorld* world, kiriSheetData* sheet, int32_t count)
{
    for (int32_t k = 0; k < count; ++k) {
        const kiriSheetData* part = kiriPool_Find(&world->frameIds, sheet->leaving.data[k])->owner;
        kiriEvent* event = kiriWorld_AddEvent(world, KIRI_EVENT_PIECE_DETACHED, part);
        event->frame = sheet->leaving.data[k];
        event->area = (float)part->layout.pieces.data[0].area;
        world->newEvents += 1;
    }
    for (int32_t k = count; k < sheet->leaving.count; ++k) {
        sheet->leaving.data[k - count] = sheet->leaving.data[k];
    }
    sheet->leaving.count -= count;
    sheet->leavingPaid = 0;
}

kiriResult kiriParts_Leave(kiriWorld* world, kiriSheetData* sheet)
{
    if (!kiriParts_AreDue(sheet)) {
        return KIRI_OK;
    }
    ForgetStaleLeaving(world, sheet);
    int32_t count = CountWithin(world, sheet, sheet->leavingPaid);
    if (count == KIRI_NONE) {
        bool ok = sheet->leaving.count == 0 ||
                  kiriAhead_GoOn(sheet, sheet->leaving.data[0], &world->memory, sheet->leavingPaid);
        return ok ? KIRI_OK : KIRI_ERROR_MEMORY;
    }
    kiriResult result = Part(world, sheet, count);
    if (result == KIRI_OK) {
        TellMade(world, sheet, count);
    }
    return result;
}

/* Pieces that are taken away. */

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
