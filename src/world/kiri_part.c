#include "kiri_part_work.h"

#include "../sheet/kiri_ahead.h"
#include "../sheet/kiri_seen.h"
#include "../sheet/kiri_update.h"

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
