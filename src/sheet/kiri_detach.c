#include "kiri_detach.h"
#include "kiri_meeting.h"
#include "kiri_piece.h"
#include "../core/kiri_array.h"
#include "kiri_update.h"
#include "kiri_build.h"
#include "kiri_pin.h"
#include "kiri_seen.h"

/* ---- Maps and lists ---------------------------------------------------------------------------------------------- */

static bool InitSubset(kiriSubset* subset, const kiriSheetData* from, kiriMemory* memory)
{
    subset->from = from;
    if (!kiriArray_Resize(memory, &subset->pieces, from->layout.pieces.count)) {
        return false;
    }
    kiriArray_Set(&subset->pieces, 0);
    return true;
}

bool kiriDetach_Init(kiriDetach* detach, kiriSheetData* sheet)
{
    KIRI_CLEAR(detach);
    detach->sheet = sheet;
    detach->memory = kiriMemory_Like(sheet->memory);
    return InitSubset(&detach->rest, sheet, &detach->memory);
}

void kiriDetach_Drop(kiriDetach* detach)
{
    if (detach->sheet != NULL) {
        kiriShown_Release(&detach->shown, &detach->sheet->shown);
        kiriArray_Release(&detach->sheet->shown, &detach->points);
        kiriMemory_FreeAll(&detach->memory);
    }
}

static bool HasFrame(const kiriSubset* subset, int32_t frame)
{
    return subset->pieces.data[subset->from->layout.framePiece.data[frame]] != 0;
}

int32_t kiriSubset_FrameOfPin(const kiriSubset* subset, int32_t pin)
{
    const kiriLayout* layout = &subset->from->layout;
    const kiriLineShare* longest = NULL;
    if (HasFrame(subset, layout->pinFrame.data[pin])) {
        return layout->pinFrame.data[pin];
    }
    KIRI_EACH(const kiriPinShare, pinned, layout->pinShares) {
        if (pinned->pin == pin && HasFrame(subset, pinned->share.frame) &&
            (longest == NULL || pinned->share.length > longest->length)) {
            longest = &pinned->share;
        }
    }
    return longest != NULL ? longest->frame : KIRI_NONE;
}

static double AreaOfAll(const kiriSheetData* sheet)
{
    double area = 0.0;
    KIRI_EACH(const kiriPiece, piece, sheet->layout.pieces) {
        area += piece->area;
    }
    return area;
}

double kiriSubset_Share(const kiriSubset* subset)
{
    double area = 0.0;
    KIRI_EACH_INDEX(p, subset->pieces) {
        area += subset->pieces.data[p] ? subset->from->layout.pieces.data[p].area : 0.0;
    }
    return area / AreaOfAll(subset->from);
}

double kiriDetach_Samples(const kiriSheetData* sheet, double share, bool makesParts)
{
    const double passSamples = 0.15, vertexSamples = 3.0, cellSamples = 1.4;
    double vertices = sheet->mesh.vertices.count;
    double parts = share * (vertexSamples * vertices + cellSamples * sheet->grid.cellCount);
    return 1.0 + passSamples * vertices + (makesParts ? parts : 0.0);
}

static int32_t PartOfPiece(const kiriDetach* detach, int32_t piece)
{
    KIRI_ASSERT_HAS(detach->rest.pieces, piece);
    return detach->rest.pieces.data[piece] ? KIRI_NONE : piece;
}

/* Returns the piece of item i of a kind if it leaves, else KIRI_NONE. */
static int32_t PartOf(const kiriDetach* detach, int32_t kind, int32_t i)
{
    const kiriSheetData* sheet = detach->sheet;
    const int32_t *framePart = detach->framePart.data, *vertexPart = detach->vertexPart.data;
    switch (kind) {
    case KIRI_LISTED_TRIANGLES:
        return vertexPart[sheet->mesh.triangles.data[i].vertex[0]];
    case KIRI_LISTED_FRAMES:
        return framePart[i];
    case KIRI_LISTED_POINTS:
        return framePart[sheet->points.data[i].frame];
    case KIRI_LISTED_LINKS:
        return framePart[sheet->links.links.data[i].i];
    case KIRI_LISTED_FADES:
        return vertexPart[sheet->seen.fades.fading.data[i].sample];
    case KIRI_LISTED_POINT_FADES:
        return framePart[sheet->points.data[sheet->seen.pointFades.fading.data[i].sample].frame];
    case KIRI_LISTED_LAST:
        return PartOfPiece(detach, kiriTouch_Piece(sheet, &sheet->touches.last.touches.data[i]));
    case KIRI_LISTED_SLEPT:
        return PartOfPiece(detach, kiriTouch_Piece(sheet, &sheet->touches.slept.touches.data[i]));
    default:
        return vertexPart[i];
    }
}

bool kiriDetach_Map(kiriDetach* detach, bool makesParts)
{
    const kiriSheetData* sheet = detach->sheet;
    kiriMemory* memory = &detach->memory;
    kiriSubset *rest = &detach->rest, *part = &detach->part;
    const struct {
        kiriKeep *rest, *part;
        int32_t count;
    } kinds[KIRI_LISTED_COUNT] = {
        [KIRI_LISTED_VERTICES] = { &rest->vertices, &part->vertices, sheet->mesh.vertices.count },
        [KIRI_LISTED_TRIANGLES] = { &rest->triangles, &part->triangles, sheet->mesh.triangles.count },
        [KIRI_LISTED_FRAMES] = { &rest->frames, &part->frames, sheet->frames.count },
        [KIRI_LISTED_POINTS] = { &rest->points, &part->points, sheet->points.count },
        [KIRI_LISTED_LINKS] = { &rest->links, NULL, sheet->links.links.count },
        [KIRI_LISTED_FADES] = { NULL, NULL, sheet->seen.fades.fading.count },
        [KIRI_LISTED_POINT_FADES] = { NULL, NULL, sheet->seen.pointFades.fading.count },
        [KIRI_LISTED_LAST] = { NULL, NULL, sheet->touches.last.touches.count },
        [KIRI_LISTED_SLEPT] = { NULL, NULL, sheet->touches.slept.touches.count },
    };
    KIRI_ASSERT(kiriUpdate_IsFieldCurrent(sheet->update));
    KIRI_ASSERT(rest->pieces.count == sheet->layout.pieces.count);
    detach->area = AreaOfAll(sheet);
    bool ok = kiriArray_Resize(memory, &detach->framePart, sheet->frames.count) &&
              kiriArray_Resize(memory, &detach->vertexPart, sheet->mesh.vertices.count) &&
              (!makesParts || InitSubset(part, sheet, memory)) && kiriKeep_Init(&rest->pins, memory, sheet->pins.count);
    KIRI_EACH_INDEX_WHILE(ok, f, sheet->frames) {
        detach->framePart.data[f] = PartOfPiece(detach, sheet->layout.framePiece.data[f]);
    }
    KIRI_EACH_INDEX_WHILE(ok, v, sheet->mesh.vertices) {
        const kiriSpan* span = &sheet->vertexSkin.spans.data[v];
        KIRI_ASSERT(span->count > 0);
        detach->vertexPart.data[v] = detach->framePart.data[sheet->vertexSkin.weights.data[span->first].frame];
    }
    KIRI_TIMES_WHILE(ok, k, KIRI_LISTED_COUNT) {
        int32_t count = kinds[k].count;
        kiriKeep *mapOfRest = kinds[k].rest, *mapOfPart = makesParts ? kinds[k].part : NULL;
        if (mapOfRest == NULL && !makesParts) {
            continue;
        }
        kiriIndices parts = { 0 };
        ok = kiriArray_Resize(memory, &parts, count) &&
             (mapOfRest == NULL || kiriKeep_Init(mapOfRest, memory, count)) &&
             (mapOfPart == NULL || kiriKeep_Init(mapOfPart, memory, count));
        KIRI_TIMES_WHILE(ok, i, count) {
            parts.data[i] = PartOf(detach, k, i);
        }
        if (ok && mapOfRest != NULL) {
            kiriKeep_Fill(mapOfRest, parts.data, count);
        }
        if (ok && mapOfPart != NULL) {
            kiriKeep_Clear(mapOfPart, count); /* it keeps nothing yet */
        }
        ok = ok &&
             (!makesParts || kiriPieceItems_List(&detach->of[k], memory, detach->rest.pieces.count, parts.data, count));
        kiriArray_Release(memory, &parts);
    }
    KIRI_EACH_INDEX_WHILE(ok, i, sheet->pins) {
        kiriKeep_Add(&rest->pins, kiriSubset_FrameOfPin(rest, i) != KIRI_NONE);
    }
    return ok;
}

/* ---- Contacts ---------------------------------------------------------------------------------------------------- */

/* Renumbers the vertices of a contact. Returns false if one is not in the subset. */
static bool FollowVertices(const kiriSubset* subset, int32_t vertex[3])
{
    bool isIn = true;
    for (int n = 0; n < 3 && vertex[n] != KIRI_NONE; ++n) {
        vertex[n] = kiriKeep_To(&subset->vertices, vertex[n]);
        isIn = isIn && vertex[n] != KIRI_NONE;
    }
    return isIn;
}

/* Renumbers a contact of the host. Returns false if its point is not in the subset. */
static bool FollowContact(const kiriSubset* subset, kiriGivenContact* given)
{
    if (given->contact.point >= 0) {
        given->contact.point = kiriKeep_To(&subset->points, given->contact.point);
        return given->contact.point != KIRI_NONE;
    }
    return FollowVertices(subset, given->vertex);
}

/* Renumbers a contact and its key. Returns false if it is not in the subset, or the key cannot be renumbered. */
static bool FollowTouch(const kiriSubset* subset, kiriTouch* touch)
{
    return touch->key >> 60 != KIRI_TOUCH_OBSTACLE
               ? kiriTouch_Follow(touch, &subset->points, &subset->vertices)
               : FollowVertices(subset, touch->vertex) &&
                     kiriObstacle_FollowKey(&touch->key, &subset->vertices, &subset->triangles);
}

/* ---- A part ------------------------------------------------------------------------------------------------------ */

/* Returns the items of a part, in ascending order. */
static kiriIndices ItemsOf(const kiriDetach* detach, int32_t kind, int32_t piece)
{
    KIRI_ASSERT(kind >= 0 && kind < KIRI_LISTED_COUNT && piece < detach->of[kind].spans.count);
    kiriSpan span = detach->of[kind].spans.data[piece];
    return (kiriIndices){ detach->of[kind].items.data + span.first, span.count, span.count };
}

/* Returns the cell of the part with the material of a cell of the sheet. */
static int32_t CellInPart(const kiriDetach* detach, const kiriSheetData* to, int32_t cell)
{
    const kiriSheetData* from = detach->sheet;
    const kiriCell* was = &from->grid.cells.data[cell];
    int32_t square = kiriSquares_InPart(&to->mesh.squares, &from->mesh.squares, was->square);
    int32_t found = to->grid.squareCell.data[square];
    KIRI_ASSERT(found != KIRI_NONE);
    while (to->grid.cells.data[found].triangle != kiriKeep_To(&detach->part.triangles, was->triangle)) {
        found = to->grid.cells.data[found].next;
    }
    return found;
}

static bool CopySites(const kiriDetach* detach, const kiriIndices* frames, kiriSheetData* to)
{
    kiriSites* sites = &to->update->placing.sites;
    if (!kiriArray_Resize(to->memory, sites, frames->count)) {
        return false;
    }
    KIRI_EACH_INDEX(k, *frames) {
        kiriSite site = detach->sheet->frames.data[frames->data[k]].site;
        site.cell = CellInPart(detach, to, site.cell);
        sites->data[k] = site;
    }
    return true;
}

static bool CopyPoints(const kiriDetach* detach, int32_t piece, kiriSheetData* to)
{
    const kiriIndices points = ItemsOf(detach, KIRI_LISTED_POINTS, piece);
    bool ok = true;
    KIRI_EACH_LISTED_WHILE(ok, was, points) {
        kiriSample point = { detach->sheet->points.data[was].at, KIRI_NONE, KIRI_NONE };
        kiriSpan none = { 0 };
        ok = kiriArray_Push(to->memory, &to->points, point) && kiriArray_Push(to->memory, &to->pointSkin.spans, none) &&
             kiriPlaces_Add(&to->pointPlaces, &to->mesh, point.at);
    }
    return ok;
}

/* Copies stored contacts with their forces. */
static void CopyTouches(const kiriDetach* detach, const kiriIndices* items, const kiriTouchMemory* from,
                        kiriSheetData* to, kiriTouchMemory* memory)
{
    int32_t before = memory->touches.count;
    KIRI_EACH_LISTED(item, *items) {
        kiriTouch touch = from->touches.data[item];
        kiriVec3 force = kiriTouches_ForceOf(detach->sheet, touch.key);
        if (FollowTouch(&detach->part, &touch)) {
            kiriTouchMemory_Add(memory, &touch, force);
        }
    }
    kiriTouchMemory_SortForces(memory, before, &to->touches.order);
}

/* Copies the contacts. Reserves the same arrays as SetContacts, so that later ticks do not allocate. */
static bool CopyContacts(const kiriDetach* detach, int32_t piece, kiriSheetData* to)
{
    const kiriSheetData* from = detach->sheet;
    const kiriIndices last = ItemsOf(detach, KIRI_LISTED_LAST, piece);
    const kiriIndices slept = ItemsOf(detach, KIRI_LISTED_SLEPT, piece);
    int32_t remembered = last.count + slept.count, most = kiriMax(from->contacts.count, remembered);
    if (!kiriArray_Reserve(to->memory, &to->contacts, most) ||
        !kiriArray_Reserve(&to->shown, &to->touches.nextTold, most) || !kiriTouches_Room(to, most)) {
        return false;
    }
    KIRI_EACH(const kiriGivenContact, at, from->contacts) {
        kiriGivenContact given = *at;
        if (FollowContact(&detach->part, &given)) {
            KIRI_NEXT(to->contacts) = given;
        }
    }
    CopyTouches(detach, &last, &from->touches.last, to, &to->touches.last);
    CopyTouches(detach, &slept, &from->touches.slept, to, &to->touches.slept);
    return true;
}

/* Copies the frames with all bits. A commit changes new frames: so it is called before and after. */
static void CopyFrames(const kiriSheetData* from, const kiriIndices* frames, kiriSheetData* to)
{
    KIRI_ASSERT(to->update->placing.sites.count == frames->count && to->frames.capacity >= frames->count);
    to->frames.count = frames->count;
    KIRI_EACH_INDEX(k, *frames) {
        to->frames.data[k] = from->frames.data[frames->data[k]];
        to->frames.data[k].site = to->update->placing.sites.data[k];
    }
}

/* Copies the fades of vertices or points. */
static bool CopyFades(const kiriIndices* items, const kiriFades* from, const kiriKeep* samples, kiriFades* to,
                      kiriMemory* memory)
{
    if (items->count > 0 && !kiriArray_Reserve(memory, &to->fading, samples->count)) {
        return false;
    }
    KIRI_EACH_LISTED(item, *items) {
        kiriFading fading = from->fading.data[item];
        fading.sample = kiriKeep_To(samples, fading.sample);
        KIRI_NEXT(to->fading) = fading;
    }
    return true;
}

/* Copies the history of pins. Their shares also have the same order. */
static void CopyPinHistory(const kiriSubset* part, kiriSheetData* to)
{
    const kiriPinShares* shares = &part->from->layout.pinShares;
    int32_t count = 0;
    KIRI_EACH_WHILE(count < to->layout.pinShares.count, const kiriPinShare, from, *shares) {
        if (kiriKeep_Has(&part->frames, from->share.frame)) {
            kiriPinShare* share = &to->layout.pinShares.data[count++];
            memcpy(share->offset, from->offset, sizeof(share->offset));
            share->plastic = from->plastic;
            memcpy(share->reactions, from->reactions, sizeof(share->reactions));
            share->bore = from->bore;
        }
    }
}

/* Makes the part. Adds no frames; the next cut adds them if there are too few. */
static bool FillPart(kiriDetach* detach, int32_t piece, kiriSheetData* to)
{
    const kiriSheetData* from = detach->sheet;
    const kiriSubset* part = &detach->part;
    const kiriIndices frames = ItemsOf(detach, KIRI_LISTED_FRAMES, piece);
    const kiriIndices links = ItemsOf(detach, KIRI_LISTED_LINKS, piece);
    const kiriIndices fades = ItemsOf(detach, KIRI_LISTED_FADES, piece);
    const kiriIndices pointFades = ItemsOf(detach, KIRI_LISTED_POINT_FADES, piece);
    const kiriMeshPart vertices = { ItemsOf(detach, KIRI_LISTED_VERTICES, piece), &part->vertices };
    const kiriMeshPart triangles = { ItemsOf(detach, KIRI_LISTED_TRIANGLES, piece), &part->triangles };
    double share = from->layout.pieces.data[piece].area / detach->area;
    to->settings = from->settings;
    to->settings.collisionPoints *= share; /* counts over the whole sheet are divided by area */
    to->settings.integrationPoints *= share;
    to->settings.maxFrames = 0;
    to->seen.surface.detail.isHeld = from->seen.surface.detail.isHeld;
    kiriSettings_Apply(to);
    to->plastics.isKept = from->plastics.isKept;
    to->seen.bounds->patience = from->seen.bounds->patience;
    to->solver = kiriSolver_Create(to->memory, &to->settings.mechanics);
    bool ok = to->solver != NULL && kiriArray_Resize(to->memory, &to->tearLines, from->tearLines.count) &&
              kiriMesh_MakePart(&to->mesh, to->memory, &from->mesh, &triangles, &vertices) &&
              kiriPipeline_Make(to, KIRI_STAGE_REGIONS) && CopySites(detach, &frames, to) &&
              CopyPoints(detach, piece, to);
    KIRI_EACH_INDEX_WHILE(ok, i, from->tearLines) {
        to->tearLines.data[i] = from->tearLines.data[i];
    }
    KIRI_EACH_INDEX_WHILE(ok, i, from->pins) {
        int32_t frame = kiriSubset_FrameOfPin(part, i);
        ok = frame == KIRI_NONE || kiriPins_Add(to, &from->pins.data[i], kiriKeep_To(&part->frames, frame));
    }
    KIRI_EACH_LISTED_WHILE(ok, vertex, vertices.items) { /* to weigh them gives the same bits */
        ok = kiriSkin_StageCopy(&to->vertexSkin, to->memory, &from->vertexSkin, vertex, &part->frames);
    }
    if (!ok || !CopyContacts(detach, piece, to) || !kiriPipeline_Make(to, KIRI_READY) ||
        !CopyFades(&fades, &from->seen.fades, &part->vertices, &to->seen.fades, to->memory) ||
        !CopyFades(&pointFades, &from->seen.pointFades, &part->points, &to->seen.pointFades, to->memory)) {
        return false;
    }
    CopyFrames(from, &frames, to);
    if (!kiriBuild_Commit(to)) {
        return false;
    }
    CopyFrames(from, &frames, to);
    KIRI_EACH_INDEX(k, frames) { /* a changed material leaves regions dirty, see kiri_sheet.c */
        to->regions.dirty.data[k] = from->regions.dirty.data[frames.data[k]];
    }
    KIRI_EACH_INDEX_WHILE(from->strainOffsets.strainOffsets.count > 0, k, links) {
        KIRI_ASSERT(to->strainOffsets.strainOffsets.count == links.count); /* links have the same order as in the sheet */
        to->strainOffsets.strainOffsets.data[k] = from->strainOffsets.strainOffsets.data[links.data[k]];
    }
    KIRI_EACH_INDEX_WHILE(from->plastics.links.count > 0, k, links) {
        KIRI_ASSERT(to->plastics.links.count == links.count);
        to->plastics.links.data[k] = from->plastics.links.data[links.data[k]];
    }
    KIRI_EACH_INDEX_WHILE(kiriSurface_HasDetail(&to->seen.surface), k, vertices.items) {
        memcpy(to->seen.surface.detail.offsets.data + 3 * k,
               from->seen.surface.detail.offsets.data + 3 * vertices.items.data[k], 3 * sizeof(float));
    }
    CopyPinHistory(part, to);
    kiriPins_SumShares(to);
    to->layout.pieces.data[0].rest = from->layout.pieces.data[piece].rest;
    kiriSheet_SumRest(to);
    kiriView_WritePositions(to);
    to->settings.maxFrames = from->settings.maxFrames;
    return true;
}

bool kiriDetach_MakePart(kiriDetach* detach, int32_t piece, kiriSheetData* to)
{
    KIRI_ASSERT(piece >= 0 && piece < detach->part.pieces.count && !detach->rest.pieces.data[piece]);
    kiriKeep* maps[] = { &detach->part.vertices, &detach->part.triangles, &detach->part.frames, &detach->part.points };
    detach->part.pieces.data[piece] = 1;
    for (int k = KIRI_LISTED_VERTICES; k <= KIRI_LISTED_POINTS; ++k) {
        const kiriIndices items = ItemsOf(detach, k, piece);
        kiriKeep_Take(maps[k], items.data, items.count);
    }
    bool ok = FillPart(detach, piece, to);
    for (int k = KIRI_LISTED_VERTICES; k <= KIRI_LISTED_POINTS; ++k) {
        const kiriIndices items = ItemsOf(detach, k, piece);
        kiriKeep_Drop(maps[k], items.data, items.count);
    }
    detach->part.pieces.data[piece] = 0;
    return ok;
}

/* ---- The rest ---------------------------------------------------------------------------------------------------- */

/* Lists the cells that leave, in the order of squares. */
static bool ListCells(kiriDetach* detach)
{
    const kiriSheetData* sheet = detach->sheet;
    kiriMemory* memory = &detach->memory;
    bool ok = true;
    KIRI_EACH_INDEX_WHILE(ok, s, sheet->grid.squareCell) {
        bool isListed = false;
        for (int32_t c = sheet->grid.squareCell.data[s]; ok && c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            if (!kiriKeep_Has(&detach->rest.frames, sheet->regions.field.owner.data[c])) {
                ok = kiriArray_Push(memory, &detach->cells, c) &&
                     (isListed || kiriArray_Push(memory, &detach->squares, s));
                isListed = true;
            }
        }
    }
    return ok;
}

static bool StagePieces(kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    const kiriSubset* rest = &detach->rest;
    const kiriLayout* layout = &sheet->layout;
    kiriLayout* next = &sheet->update->next;
    kiriKeep pieces;
    next->pieces.count = next->framePiece.count = 0;
    bool ok = kiriKeep_Init(&pieces, &detach->memory, layout->pieces.count) &&
              kiriArray_Reserve(sheet->memory, &next->pieces, layout->pieces.count) &&
              kiriArray_Reserve(sheet->memory, &next->framePiece, layout->framePiece.count);
    KIRI_EACH_INDEX_WHILE(ok, p, layout->pieces) {
        const kiriPiece* was = &layout->pieces.data[p];
        kiriPiece piece = { .area = was->area,
                            .frame = kiriKeep_To(&rest->frames, was->frame),
                            .origin = KIRI_NONE,
                            .rest = was->rest };
        kiriKeep_Add(&pieces, rest->pieces.data[p] != 0);
        if (rest->pieces.data[p]) {
            KIRI_NEXT(next->pieces) = piece;
        }
    }
    KIRI_EACH_INDEX_WHILE(ok, f, layout->framePiece) {
        if (kiriKeep_Has(&rest->frames, f)) {
            KIRI_NEXT(next->framePiece) = kiriKeep_To(&pieces, layout->framePiece.data[f]);
        }
    }
    return ok;
}

static bool StagePins(kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    const kiriSubset* rest = &detach->rest;
    const kiriLayout* layout = &sheet->layout;
    kiriLayout* next = &sheet->update->next;
    bool ok = true;
    next->pinFrame.count = next->pinShares.count = next->severed.count = 0;
    KIRI_EACH_INDEX_WHILE(ok, i, sheet->pins) {
        int32_t frame = kiriSubset_FrameOfPin(rest, i);
        ok = frame == KIRI_NONE || kiriArray_Push(sheet->memory, &next->pinFrame, kiriKeep_To(&rest->frames, frame));
    }
    KIRI_EACH_WHILE(ok, const kiriPinShare, share, layout->pinShares) {
        kiriPinShare pinned = *share;
        pinned.pin = kiriKeep_To(&rest->pins, pinned.pin);
        pinned.share.frame = kiriKeep_To(&rest->frames, pinned.share.frame);
        ok = pinned.share.frame == KIRI_NONE || kiriArray_Push(sheet->memory, &next->pinShares, pinned);
    }
    KIRI_EACH_WHILE(ok, const kiriSeveredLink, link, layout->severed) {
        kiriSeveredLink severed = *link;
        severed.pin = kiriKeep_To(&rest->pins, severed.pin);
        severed.link = kiriKeep_To(&rest->links, severed.link);
        ok = severed.link == KIRI_NONE || kiriArray_Push(sheet->memory, &next->severed, severed);
    }
    return ok;
}

bool kiriDetach_Stage(kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    const kiriSubset* rest = &detach->rest;
    kiriAreaElements* elements = &sheet->update->next.areaElements;
    KIRI_ASSERT(kiriUpdate_IsFieldCurrent(sheet->update));
    KIRI_ASSERT(rest->frames.to.count == sheet->frames.count && rest->frames.count > 0);
    elements->elements.count = elements->shares.count = 0;
    return ListCells(detach) && StagePieces(detach) && StagePins(detach) &&
           kiriAreaElements_Keep(elements, sheet->memory, &sheet->layout.areaElements, &rest->frames) &&
           kiriLinks_Keep(&sheet->links, sheet->memory, &rest->links, &rest->frames) &&
           kiriShown_Reserve(&detach->shown, &sheet->shown, &rest->triangles, &rest->vertices) &&
           kiriArray_Reserve(&sheet->shown, &detach->points, 3 * (int64_t)rest->points.count) &&
           kiriStage_Solver(sheet, rest->frames.count, &sheet->settings.material, true);
}

static void KeepFields(kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    const kiriSubset* rest = &detach->rest;
    KIRI_ASSERT(rest->vertices.count > 0 && rest->triangles.count > 0);
    const int32_t *cells = detach->cells.data, *squares = detach->squares.data;
    int32_t cellCount = detach->cells.count, squareCount = detach->squares.count;
    kiriMesh_Keep(&sheet->mesh, &rest->triangles, &rest->vertices, squares, squareCount);
    kiriGrid_Keep(&sheet->grid, &rest->triangles, &rest->vertices, cells, cellCount);
    kiriRegions_Keep(&sheet->regions, &rest->frames, cells, cellCount);
    kiriShape_Keep(&sheet->shape, sheet->memory, &rest->frames, cells, cellCount);
    kiriOwnership_Keep(&sheet->update->refit.ownership, &sheet->grid, &sheet->regions, &rest->triangles, &rest->frames,
                       squares, squareCount);
}

static void KeepSamples(kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    const kiriSubset* rest = &detach->rest;
    kiriKeep_Compact(&rest->points, &sheet->points, 1, sizeof(kiriSample));
    KIRI_EACH(kiriSample, point, sheet->points) {
        point->frame = kiriKeep_To(&rest->frames, point->frame);
    }
    kiriPlaces_Keep(&sheet->pointPlaces, &rest->points);
    kiriSkin_Keep(&sheet->pointSkin, &rest->points, &rest->frames);
    kiriSkin_Keep(&sheet->vertexSkin, &rest->vertices, &rest->frames);
    kiriFades_Keep(&sheet->seen.fades, &rest->vertices);
    kiriFades_Keep(&sheet->seen.pointFades, &rest->points);
    sheet->update->samples.oldVertices = sheet->mesh.vertices.count;
}

/* Keys contain indices, so forces are looked up before any of these change. */
static void RecallForces(const kiriSheetData* sheet, kiriTouchMemory* memory)
{
    KIRI_EACH(kiriTouch, touch, memory->touches) {
        touch->force = kiriTouches_ForceOf(sheet, touch->key);
    }
}

static void KeepTouches(const kiriDetach* detach, kiriTouchMemory* memory)
{
    int32_t count = memory->touches.count;
    memory->touches.count = memory->forces.count = memory->given = 0;
    KIRI_TIMES(i, count) {
        kiriTouch touch = memory->touches.data[i];
        if (FollowTouch(&detach->rest, &touch)) {
            kiriTouchMemory_Add(memory, &touch, touch.force);
        }
    }
    kiriTouchMemory_SortForces(memory, 0, &detach->sheet->touches.order);
}

/* Commits the staged layout, like kiriStage_Commit. */
static void CommitLayout(kiriDetach* detach)
{
    kiriSheetData* sheet = detach->sheet;
    const kiriSubset* rest = &detach->rest;
    kiriLayout layout = sheet->layout;
    kiriKeep_Compact(&rest->frames, &sheet->frames, 1, sizeof(kiriFrameData));
    kiriKeep_Compact(&rest->frames, &sheet->update->material, 1, sizeof(kiriMoments));
    kiriKeep_Compact(&rest->frames, &sheet->update->placing.sites, 1, sizeof(kiriSite));
    kiriKeep_Compact(&rest->pins, &sheet->pins, 1, sizeof(kiriPinData));
    kiriKeep_Compact(&rest->links, &sheet->strainOffsets.strainOffsets, 1, sizeof(kiriStrainOffset));
    kiriKeep_Compact(&rest->links, &sheet->plastics.links, 1, sizeof(kiriPlastic));
    kiriLinks_Commit(&sheet->links);
    kiriSolver_Commit(sheet->solver);
    sheet->layout = sheet->update->next;
    sheet->update->next = layout;
    kiriPins_WriteLinkParts(sheet);
    kiriPins_SumShares(sheet);
    kiriSheet_SumRest(sheet);
}

static void KeepSeen(kiriDetach* detach, kiriMemory* retired)
{
    kiriSheetData* sheet = detach->sheet;
    kiriSeen* seen = &sheet->seen;
    const kiriSubset* rest = &detach->rest;
    kiriBlocks_Renumber(&seen->blocks, rest->vertices.count, rest->frames.count);
    kiriSurface_Keep(&seen->surface, &detach->shown, &rest->triangles, &rest->vertices, &sheet->mesh,
                     rest->frames.count, retired);
    seen->bounds->levelCount = 0;
    seen->vertexCount = rest->vertices.count;
    kiriKeep_Compact(&rest->points, &seen->exactPoints, 1, sizeof(kiriVec3));
    kiriShown_Take(&rest->points, &seen->pointPositions, &detach->points, 3, retired);
    seen->pointCount = rest->points.count;
    KIRI_CLEAR(&detach->shown);
    KIRI_CLEAR(&detach->points);
    kiriPieceLists_Retire(&sheet->lists, retired);
    sheet->probes.isFresh = sheet->tears.areListed = false;
}

/* To maintain: state that a sheet keeps between ticks must be handled here and in FillPart. */
void kiriDetach_Commit(kiriDetach* detach, kiriMemory* retired)
{
    kiriSettings* settings = &detach->sheet->settings;
    kiriTouches* touches = &detach->sheet->touches;
    KIRI_ASSERT(detach->sheet->update->next.framePiece.count == detach->rest.frames.count); /* staged */
    double share = kiriSubset_Share(&detach->rest); /* by the old layout */
    settings->collisionPoints *= share;
    settings->integrationPoints *= share;
    KeepFields(detach);
    KeepSamples(detach);
    KIRI_KEEP_IF(kiriGivenContact, given, detach->sheet->contacts, FollowContact(&detach->rest, given));
    RecallForces(detach->sheet, &touches->last);
    RecallForces(detach->sheet, &touches->slept);
    KeepTouches(detach, &touches->last);
    KeepTouches(detach, &touches->slept);
    touches->rests.areSummed = false;
    CommitLayout(detach);
    KIRI_EACH_OF(kiriCutData, cut, detach->sheet->cuts) {
        int32_t* vertex = &cut->tip.blade.vertex;
        *vertex = kiriKeep_To(&detach->rest.vertices, *vertex);
    }
    KeepSeen(detach, retired);
}

/* ---- Fields of a load -------------------------------------------------------------------------------------------- */

/* Runs the stages from the grid to the owners of material, as for a new sheet. Adds no frames, except in a piece
   without one. */
static bool RunStages(kiriSheetData* sheet, bool* isBad)
{
    kiriUpdate* u = sheet->update;
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    kiriSkin *vertices = &sheet->vertexSkin, *points = &sheet->pointSkin;
    int32_t maxFrames = sheet->settings.maxFrames;
    if (!kiriArray_ResizeJust(sheet->memory, &vertices->spans, sheet->mesh.vertices.count) ||
        !kiriArray_ResizeJust(sheet->memory, &points->spans, sheet->points.count) ||
        !kiriPlaces_Reserve(&sheet->pointPlaces, &sheet->mesh, sheet->points.count) ||
        !kiriArray_Resize(sheet->memory, &u->placing.sites, sheet->frames.count)) {
        return false;
    }
    kiriArray_Set(&vertices->spans, 0);
    kiriArray_Set(&points->spans, 0);
    KIRI_EACH(const kiriSample, point, sheet->points) {
        kiriPlaces_Add(&sheet->pointPlaces, &sheet->mesh, point->at); /* has room */
    }
    KIRI_EACH_INDEX(f, sheet->frames) {
        u->placing.sites.data[f] = (kiriSite){ sheet->frames.data[f].site.at, 0 };
    }
    sheet->settings.maxFrames = 0;
    u->isScratch = true;
    u->stage = KIRI_STAGE_GRID;
    bool ok = kiriPipeline_Make(sheet, KIRI_STAGE_CONSTANTS);
    const kiriLayout *made = &u->next, *read = &sheet->layout;
    bool isSame =
        u->placing.sites.count == sheet->frames.count && made->pieces.count == read->pieces.count &&
        memcmp(made->framePiece.data, read->framePiece.data, sizeof(int32_t) * sheet->frames.count) == 0;
    /* kiriSites_Relocate failed although its arrays are reserved: two sites share a cell. */
    bool isCrowded = u->stage == KIRI_STAGE_REGIONS && u->step == 0 &&
                     u->placing.flags.count >= sheet->grid.cells.count &&
                     u->placing.moves.capacity >= sheet->frames.count;
    *isBad = ok ? !isSame : isCrowded;
    ok = ok && !*isBad && kiriStage_Owners(sheet, &unlimited.of[KIRI_QUOTA_SAMPLES]) == KIRI_DONE;
    sheet->settings.maxFrames = maxFrames;
    return ok;
}

/* Commits the remade data, like the commit of an update. Saved arrays stay. */
static bool Commit(kiriSheetData* sheet)
{
    kiriUpdate* u = sheet->update;
    kiriLinks_Commit(&sheet->links);
    kiriSkin_Commit(&sheet->vertexSkin);
    kiriSkin_Commit(&sheet->pointSkin);
    kiriRefit_Commit(&u->refit, &sheet->mesh);
    kiriShape_ClearChanges(&sheet->shape);
    kiriRefresh_Drop(&u->samples.refresh);
    KIRI_EACH_INDEX(f, sheet->frames) {
        sheet->frames.data[f].site = u->placing.sites.data[f];
    }
    KIRI_EACH(kiriSample, point, sheet->points) {
        point->cell = kiriGrid_CellAround(&sheet->grid, point->at);
        point->frame = sheet->regions.field.owner.data[point->cell];
    }
    u->samples.oldVertices = sheet->mesh.vertices.count;
    u->samples.movedPoints.count = 0;
    u->isScratch = false;
    u->stage = KIRI_NONE;
    u->step = 0;
    u->spent = 0;
    return kiriSkin_Sort(&sheet->vertexSkin, sheet->memory) && kiriSkin_Sort(&sheet->pointSkin, sheet->memory);
}

bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad)
{
    kiriArrayHeader dirty = kiriArray_GetHeader(&sheet->regions.dirty);
    KIRI_CLEAR(&sheet->regions.dirty);
    *isBad = false;
    bool ok = RunStages(sheet, isBad) && Commit(sheet);
    if (ok) {
        memcpy(sheet->regions.dirty.data, dirty.data, sheet->frames.count);
    }
    kiriMemory_Free(sheet->memory, dirty.data);
    return ok;
}

