#include "kiri_extract.h"

#include "kiri_build.h"
#include "kiri_piece.h"
#include "kiri_pin.h"
#include "kiri_pipeline.h"
#include "kiri_seen.h"
#include "kiri_settings.h"
#include "kiri_touch.h"

#include <string.h>

/* ---- What is kept ---- */

bool kiriExtract_Init(kiriExtract* extract, const kiriSheetData* from)
{
    memset(extract, 0, sizeof(*extract));
    extract->from = from;
    extract->memory = kiriMemory_Like(from->memory);
    if (!kiriArray_Resize(&extract->memory, &extract->keep, from->layout.pieces.count)) {
        return false;
    }
    memset(extract->keep.data, 0, (size_t)extract->keep.count);
    return true;
}

static bool IsFrameKept(const kiriExtract* extract, int32_t frame)
{
    return extract->keep.data[extract->from->layout.framePiece.data[frame]] != 0;
}

/* One of the kept frames that a pin holds: a line may hold more pieces than one. */
static int32_t KeptFrameOfPin(const kiriExtract* extract, int32_t pin)
{
    const kiriLayout* layout = &extract->from->layout;
    if (IsFrameKept(extract, layout->pinFrame.data[pin])) {
        return layout->pinFrame.data[pin];
    }
    for (int32_t k = 0; k < layout->pinShares.count; ++k) {
        const kiriPinShare* pinned = &layout->pinShares.data[k];
        if (pinned->pin == pin && IsFrameKept(extract, pinned->share.frame)) {
            return pinned->share.frame;
        }
    }
    return KIRI_NONE;
}

static bool MapMesh(kiriExtract* extract)
{
    const kiriSheetData* from = extract->from;
    const kiriMeshData* mesh = &from->mesh;
    int32_t triangles = 0, vertices = 0;
    if (!kiriArray_Resize(&extract->memory, &extract->triangleTo, mesh->triangles.count) ||
        !kiriArray_Resize(&extract->memory, &extract->vertexTo, mesh->vertices.count)) {
        return false;
    }
    for (int32_t v = 0; v < mesh->vertices.count; ++v) {
        bool kept = extract->keep.data[kiriPiece_OfVertex(from, v)] != 0;
        extract->vertexTo.data[v] = kept ? vertices++ : KIRI_NONE;
    }
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        bool kept = extract->vertexTo.data[mesh->triangles.data[t].vertex[0]] != KIRI_NONE;
        extract->triangleTo.data[t] = kept ? triangles++ : KIRI_NONE;
    }
    return true;
}

static bool MapRest(kiriExtract* extract)
{
    const kiriSheetData* from = extract->from;
    int32_t frames = 0, points = 0, pins = 0;
    if (!kiriArray_Resize(&extract->memory, &extract->frameTo, from->frames.count) ||
        !kiriArray_Resize(&extract->memory, &extract->pointTo, from->points.count) ||
        !kiriArray_Resize(&extract->memory, &extract->pinTo, from->pins.count)) {
        return false;
    }
    for (int32_t i = 0; i < from->frames.count; ++i) {
        extract->frameTo.data[i] = IsFrameKept(extract, i) ? frames++ : KIRI_NONE;
    }
    for (int32_t i = 0; i < from->points.count; ++i) {
        extract->pointTo.data[i] = IsFrameKept(extract, from->points.data[i].frame) ? points++ : KIRI_NONE;
    }
    for (int32_t i = 0; i < from->pins.count; ++i) {
        extract->pinTo.data[i] = KeptFrameOfPin(extract, i) != KIRI_NONE ? pins++ : KIRI_NONE;
    }
    return true;
}

/* ---- The part ---- */

/* What is spread over the sheet falls to its parts by area. */
static void CopySettings(kiriSheetData* to, const kiriSheetData* from)
{
    double share = kiriMesh_Area(&to->mesh) / kiriMesh_Area(&from->mesh);
    to->settings = from->settings;
    to->settings.collisionPoints = share * from->settings.collisionPoints;
    to->settings.integrationPoints = share * from->settings.integrationPoints;
    to->rest.calm = from->rest.calm;
    to->rest.asleep = from->rest.asleep;
    kiriSettings_Apply(to);
}

/* The cell of the part with the material of one of the sheet. */
static int32_t CellInPart(const kiriExtract* extract, const kiriSheetData* to, int32_t cell)
{
    const kiriCell* was = &extract->from->grid.cells.data[cell];
    int32_t found = to->grid.squareCell.data[was->square];
    while (to->grid.cells.data[found].triangle != extract->triangleTo.data[was->triangle]) {
        found = to->grid.cells.data[found].next;
    }
    return found;
}

static bool CopySites(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->frames.count; ++i) {
        if (extract->frameTo.data[i] != KIRI_NONE) {
            kiriSite site = from->frames.data[i].site;
            site.cell = CellInPart(extract, to, site.cell);
            ok = kiriArray_Push(to->memory, &to->update->placing.sites, site);
        }
    }
    return ok;
}

static bool CopyPoints(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->points.count; ++i) {
        if (extract->pointTo.data[i] != KIRI_NONE) {
            kiriSample point = { from->points.data[i].at, KIRI_NONE, KIRI_NONE };
            kiriSpan none = { 0, 0 };
            ok = kiriArray_Push(to->memory, &to->points, point) &&
                 kiriArray_Push(to->memory, &to->pointSkin.spans, none) &&
                 kiriPlaces_Add(&to->pointPlaces, to->memory, &to->mesh, point.at);
        }
    }
    return ok;
}

static bool CopyPins(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->pins.count; ++i) {
        if (extract->pinTo.data[i] != KIRI_NONE) {
            ok = kiriPins_Add(to, &from->pins.data[i], extract->frameTo.data[KeptFrameOfPin(extract, i)]);
        }
    }
    return ok;
}

static void CopyGivenContacts(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    for (int32_t i = 0; i < from->contacts.count; ++i) {
        kiriGivenContact given = from->contacts.data[i];
        bool isKept = true;
        if (given.contact.point >= 0) {
            given.contact.point = extract->pointTo.data[given.contact.point];
            isKept = given.contact.point != KIRI_NONE;
        }
        for (int n = 0; n < 3 && given.vertex[n] != KIRI_NONE; ++n) {
            given.vertex[n] = extract->vertexTo.data[given.vertex[n]];
            isKept = isKept && given.vertex[n] != KIRI_NONE;
        }
        if (isKept) {
            to->contacts.data[to->contacts.count++] = given;
        }
    }
}

static void CopyTouches(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriTouches* from = &extract->from->touches;
    kiriTouches* touches = &to->touches;
    for (int32_t i = 0; i < from->last.count; ++i) {
        kiriTouch touch = from->last.data[i];
        if (kiriTouch_Follow(&touch, extract->pointTo.data, extract->vertexTo.data)) {
            touches->last.data[touches->last.count++] = touch;
            kiriVec3 force = kiriTouches_ForceOf(extract->from, from->last.data[i].key);
            if (kiriVec3_Dot(force, force) > 0.0) {
                kiriTouches_Remember(to, touch.key, force);
            }
        }
    }
}

/* Room for contacts is what SetContacts reserves, so that none is needed later. */
static bool CopyContacts(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    int32_t most = from->contacts.count > from->touches.last.count ? from->contacts.count : from->touches.last.count;
    if (!kiriArray_Reserve(to->memory, &to->contacts, most) ||
        !kiriArray_Reserve(&to->shown, &to->touches.nextTold, most) || !kiriTouches_Room(to, most)) {
        return false;
    }
    CopyGivenContacts(extract, to);
    CopyTouches(extract, to);
    return true;
}

/* No frame is added: whoever wants one has asked before, or asks with the next cut. */
static bool RunStages(const kiriExtract* extract, kiriSheetData* to)
{
    if (!kiriPipeline_Make(to, KIRI_STAGE_REGIONS) || !CopySites(extract, to) || !CopyPoints(extract, to) ||
        !CopyPins(extract, to) || !CopyContacts(extract, to)) {
        return false;
    }
    to->settings.maxFrames = 0;
    bool ok = kiriPipeline_Make(to, KIRI_READY);
    to->settings.maxFrames = extract->from->settings.maxFrames;
    return ok;
}

/* Frames as they are to the last bit, whatever a commit does to new ones. */
static void CopyFrames(const kiriExtract* extract, kiriSheetData* to)
{
    to->frames.count = to->update->placing.sites.count;
    for (int32_t i = 0; i < extract->from->frames.count; ++i) {
        if (extract->frameTo.data[i] != KIRI_NONE) {
            kiriFrameData* frame = &to->frames.data[extract->frameTo.data[i]];
            *frame = extract->from->frames.data[i];
            frame->site = to->update->placing.sites.data[extract->frameTo.data[i]];
        }
    }
}

/* What is still seen elsewhere goes on to fade. Samples keep their order. */
static bool CopyFades(kiriFades* to, kiriMemory* memory, const kiriFades* from, const int32_t* sampleTo,
                      int32_t sampleCount)
{
    if (from->fading.count == 0) {
        return true;
    }
    if (!kiriFades_Reserve(to, memory, sampleCount)) {
        return false;
    }
    for (int32_t k = 0; k < from->fading.count; ++k) {
        kiriFading fading = from->fading.data[k];
        fading.sample = sampleTo[fading.sample];
        if (fading.sample != KIRI_NONE) {
            to->fading.data[to->fading.count++] = fading;
        }
    }
    return true;
}

static bool CopyAllFades(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    return CopyFades(&to->seen.fades, to->memory, &from->seen.fades, extract->vertexTo.data, to->mesh.vertices.count) &&
           CopyFades(&to->seen.pointFades, to->memory, &from->seen.pointFades, extract->pointTo.data, to->points.count);
}

/* Links come in the order that they had. */
static void CopyStrainOffsets(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    int32_t count = 0;
    for (int32_t k = 0; k < from->strainOffsets.strainOffsets.count && count < to->strainOffsets.strainOffsets.count;
         ++k) {
        if (extract->frameTo.data[from->links.links.data[k].i] != KIRI_NONE) {
            to->strainOffsets.strainOffsets.data[count++] = from->strainOffsets.strainOffsets.data[k];
        }
    }
}

/* Shares come in the order that they had. */
static void CopyPinHistory(const kiriExtract* extract, kiriSheetData* to)
{
    const kiriPinShares* shares = &extract->from->layout.pinShares;
    int32_t count = 0;
    for (int32_t k = 0; k < shares->count && count < to->layout.pinShares.count; ++k) {
        if (extract->frameTo.data[shares->data[k].share.frame] != KIRI_NONE) {
            kiriPinShare* share = &to->layout.pinShares.data[count++];
            memcpy(share->offset, shares->data[k].offset, sizeof(share->offset));
            memcpy(share->reactions, shares->data[k].reactions, sizeof(share->reactions));
            share->bore = shares->data[k].bore;
            share->off = shares->data[k].off;
        }
    }
}

static bool BuildPart(const kiriExtract* extract, kiriSheetData* to)
{
    to->solver = kiriSolver_Create(to->memory, &to->settings.mechanics);
    if (to->solver == NULL || !RunStages(extract, to) || !CopyAllFades(extract, to)) {
        return false;
    }
    CopyFrames(extract, to);
    kiriBuild_Commit(to);
    CopyFrames(extract, to);
    CopyStrainOffsets(extract, to);
    CopyPinHistory(extract, to);
    kiriPins_SumShares(to);
    kiriView_WritePositions(to);
    return true;
}

bool kiriExtract_Build(kiriExtract* extract, kiriSheetData* to)
{
    const kiriSheetData* from = extract->from;
    if (!MapMesh(extract) || !MapRest(extract) ||
        !kiriMesh_InitPart(&to->mesh, to->memory, &from->mesh, extract->triangleTo.data, extract->vertexTo.data)) {
        return false;
    }
    CopySettings(to, from);
    to->seen.bounds->patience = from->seen.bounds->patience;
    return BuildPart(extract, to);
}

/* ---- The rest ---- */

static void MoveBlade(const kiriExtract* extract, kiriBladeTip* blade)
{
    if (blade->vertex != KIRI_NONE) {
        blade->vertex = extract->vertexTo.data[blade->vertex];
    }
}

void kiriExtract_MoveCuts(const kiriExtract* extract, kiriSheetData* sheet, kiriSheetData* rest)
{
    rest->id = sheet->id;
    memcpy(&rest->queue, &sheet->queue, sizeof(sheet->queue));
    memcpy(&rest->cuts, &sheet->cuts, sizeof(sheet->cuts));
    memset(&sheet->queue, 0, sizeof(sheet->queue));
    memset(&sheet->cuts, 0, sizeof(sheet->cuts));
    for (int32_t i = 0; i < rest->cuts.count; ++i) {
        rest->cuts.data[i]->sheet = rest;
        MoveBlade(extract, &rest->cuts.data[i]->tip.blade);
        MoveBlade(extract, &rest->cuts.data[i]->committed.blade);
    }
}
