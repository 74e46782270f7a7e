#include "kiri_extract.h"

#include "kiri_build.h"
#include "kiri_motion.h"
#include "kiri_pin.h"
#include "kiri_seen.h"
#include "kiri_settings.h"
#include "kiri_stages.h"
#include "kiri_touch.h"
#include "kiri_touch_memory.h"

#include <string.h>

/* What is spread over the sheet falls to its parts by area. */
static void CopySettings(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    double share = kiriKept_Share(kept);
    to->settings = from->settings;
    to->settings.collisionPoints = share * from->settings.collisionPoints;
    to->settings.integrationPoints = share * from->settings.integrationPoints;
    kiriSettings_Apply(to);
}

/* The cell of the part with the material of one of the sheet. */
static int32_t CellInPart(const kiriKept* kept, const kiriSheetData* to, int32_t cell)
{
    const kiriCell* was = &kept->from->grid.cells.data[cell];
    int32_t found =
        to->grid.squareCell.data[kiriSquares_InPart(&to->mesh.squares, &kept->from->mesh.squares, was->square)];
    while (to->grid.cells.data[found].triangle != kiriKeep_To(&kept->triangles, was->triangle)) {
        found = to->grid.cells.data[found].next;
    }
    return found;
}

static bool CopySites(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            kiriSite site = from->frames.data[i].site;
            site.cell = CellInPart(kept, to, site.cell);
            ok = kiriArray_Push(to->memory, &to->update->placing.sites, site);
        }
    }
    return ok;
}

static bool CopyPoints(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->points.count; ++i) {
        if (kiriKeep_To(&kept->points, i) != KIRI_NONE) {
            kiriSample point = { from->points.data[i].at, KIRI_NONE, KIRI_NONE };
            kiriSpan none = { 0, 0 };
            ok = kiriArray_Push(to->memory, &to->points, point) &&
                 kiriArray_Push(to->memory, &to->pointSkin.spans, none) &&
                 kiriPlaces_Add(&to->pointPlaces, to->memory, &to->mesh, point.at);
        }
    }
    return ok;
}

static bool CopyPins(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    bool ok = true;
    for (int32_t i = 0; ok && i < from->pins.count; ++i) {
        if (kiriKeep_To(&kept->pins, i) != KIRI_NONE) {
            ok = kiriPins_Add(to, &from->pins.data[i], kiriKeep_To(&kept->frames, kiriKept_FrameOfPin(kept, i)));
        }
    }
    return ok;
}

/* What pushed when the piece was moved last, with the force. */
static void CopyTouches(const kiriKept* kept, const kiriTouchMemory* from, kiriTouchMemory* to, kiriIndices* order)
{
    int32_t before = to->touches.count;
    for (int32_t i = 0; i < from->touches.count; ++i) {
        kiriTouch touch = from->touches.data[i];
        if (kiriKept_FollowTouch(kept, &touch)) {
            kiriTouchMemory_Add(to, &touch, kiriTouches_ForceOf(kept->from, from->touches.data[i].key));
        }
    }
    kiriTouchMemory_SortForces(to, before, order);
}

/* Room for contacts is what SetContacts reserves, so that none is needed later. */
static bool CopyContacts(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    const kiriTouches* touches = &from->touches;
    int32_t remembered = touches->last.touches.count + touches->slept.touches.count;
    int32_t most = kiriMax(from->contacts.count, remembered);
    if (!kiriArray_Reserve(to->memory, &to->contacts, most) ||
        !kiriArray_Reserve(&to->shown, &to->touches.nextTold, most) || !kiriTouches_Room(to, most)) {
        return false;
    }
    for (int32_t i = 0; i < from->contacts.count; ++i) {
        kiriGivenContact given = from->contacts.data[i];
        if (kiriKept_FollowContact(kept, &given)) {
            to->contacts.data[to->contacts.count++] = given;
        }
    }
    CopyTouches(kept, &touches->last, &to->touches.last, &to->touches.order);
    CopyTouches(kept, &touches->slept, &to->touches.slept, &to->touches.order);
    return true;
}

/* Frames as they are to the last bit, whatever a commit does to new ones. */
static void CopyFrames(const kiriKept* kept, kiriSheetData* to)
{
    to->frames.count = to->update->placing.sites.count;
    for (int32_t i = 0; i < kept->from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            kiriFrameData* frame = &to->frames.data[kiriKeep_To(&kept->frames, i)];
            *frame = kept->from->frames.data[i];
            frame->site = to->update->placing.sites.data[kiriKeep_To(&kept->frames, i)];
        }
    }
}

/* Where a frame has a mass that the next commit is to take from its region again: other material gives it one, see
   kiri_settings.c. */
static void CopyDirty(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    for (int32_t i = 0; i < from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            to->regions.dirty.data[kiriKeep_To(&kept->frames, i)] = from->regions.dirty.data[i];
        }
    }
}

/* What is still seen elsewhere goes on to fade. Samples keep their order. */
static bool CopyFades(kiriFades* to, kiriMemory* memory, const kiriFades* from, const kiriKeep* samples)
{
    if (from->fading.count == 0) {
        return true;
    }
    if (!kiriFades_Reserve(to, memory, samples->count)) {
        return false;
    }
    for (int32_t k = 0; k < from->fading.count; ++k) {
        kiriFading fading = from->fading.data[k];
        fading.sample = kiriKeep_To(samples, fading.sample);
        if (fading.sample != KIRI_NONE) {
            to->fading.data[to->fading.count++] = fading;
        }
    }
    return true;
}

static bool CopyAllFades(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    return CopyFades(&to->seen.fades, to->memory, &from->seen.fades, &kept->vertices) &&
           CopyFades(&to->seen.pointFades, to->memory, &from->seen.pointFades, &kept->points);
}

/* Links come in the order that they had. */
static void CopyStrainOffsets(const kiriKept* kept, kiriSheetData* to)
{
    const kiriSheetData* from = kept->from;
    int32_t count = 0;
    for (int32_t k = 0; k < from->strainOffsets.strainOffsets.count && count < to->strainOffsets.strainOffsets.count;
         ++k) {
        if (kiriKeep_To(&kept->frames, from->links.links.data[k].i) != KIRI_NONE) {
            to->strainOffsets.strainOffsets.data[count++] = from->strainOffsets.strainOffsets.data[k];
        }
    }
}

/* Shares come in the order that they had. */
static void CopyPinHistory(const kiriKept* kept, kiriSheetData* to)
{
    const kiriPinShares* shares = &kept->from->layout.pinShares;
    int32_t count = 0;
    for (int32_t k = 0; k < shares->count && count < to->layout.pinShares.count; ++k) {
        if (kiriKeep_To(&kept->frames, shares->data[k].share.frame) != KIRI_NONE) {
            kiriPinShare* share = &to->layout.pinShares.data[count++];
            memcpy(share->offset, shares->data[k].offset, sizeof(share->offset));
            memcpy(share->reactions, shares->data[k].reactions, sizeof(share->reactions));
            share->bore = shares->data[k].bore;
            share->off = shares->data[k].off;
        }
    }
}

/* Of the one piece that it is. */
static void CopyRest(const kiriKept* kept, kiriSheetData* to)
{
    for (int32_t i = 0; i < kept->from->frames.count; ++i) {
        if (kiriKeep_To(&kept->frames, i) != KIRI_NONE) {
            to->layout.pieces.data[0].rest = kiriSheet_PieceOf(kept->from, i)->rest;
        }
    }
    kiriMotion_SumRest(to);
}

/* What may change until the piece leaves: all but the fields. */
static bool CopyMotion(const kiriKept* kept, kiriSheetData* to)
{
    to->solver = kiriSolver_Create(to->memory, &to->settings.mechanics);
    if (to->solver == NULL || !CopyPins(kept, to) || !CopyContacts(kept, to) || !kiriPipeline_Make(to, KIRI_READY) ||
        !CopyAllFades(kept, to)) {
        return false;
    }
    CopyFrames(kept, to);
    if (!kiriBuild_Commit(to)) {
        return false;
    }
    CopyFrames(kept, to);
    CopyDirty(kept, to);
    CopyStrainOffsets(kept, to);
    CopyPinHistory(kept, to);
    kiriPins_SumShares(to);
    CopyRest(kept, to);
    kiriView_WritePositions(to);
    return true;
}

/* ---- One piece after the other ---- */

bool kiriExtraction_Init(kiriExtraction* extraction, const kiriGathered* gathered)
{
    memset(extraction, 0, sizeof(*extraction));
    extraction->gathered = gathered;
    return kiriKept_InitParts(&extraction->kept, gathered->sheet);
}

static kiriIndices ItemsOfSpan(const kiriIndices* items, kiriSpan span)
{
    return (kiriIndices){ items->data + span.first, span.count, span.count };
}

double kiriExtraction_Samples(const kiriSheetData* sheet, double share)
{
    const double vertexSamples = 3.0, cellSamples = 1.4;
    double vertices = (double)sheet->mesh.vertices.count - sheet->mesh.vertexHoles;
    return share * (vertexSamples * vertices + cellSamples * sheet->grid.cellCount);
}

/* Measured over meshes of 16 to 200 squares, grids of 16 to 128 and 3 to 80 frames, with a tenth on top. Shape
   functions cost more for each cell where the piece has more frames. */
double kiriExtraction_SamplesAhead(const kiriSheetData* sheet, double share, int32_t frames)
{
    const double vertexSamples = 3.5, cellSamples = 2.2, frameSamples = 100.0, most = 6.8, lost = 12.5;
    double vertices = (double)sheet->mesh.vertices.count - sheet->mesh.vertexHoles, shape = most - lost / frames;
    return share * (vertexSamples * vertices + (cellSamples + kiriMax(shape, 0.5)) * sheet->grid.cellCount) +
           frameSamples * frames;
}

/* The part at hand: its vertices and triangles. */
typedef struct PartMembers {
    kiriMeshPart vertices, triangles;
} PartMembers;

static PartMembers TakeItemsOf(kiriExtraction* extraction, int32_t piece)
{
    kiriKept* kept = &extraction->kept;
    const kiriGatheredPiece* found = kiriGather_Find(extraction->gathered, piece);
    PartMembers items = { { ItemsOfSpan(&extraction->gathered->vertices, found->vertices), &kept->vertices },
                          { ItemsOfSpan(&extraction->gathered->triangles, found->triangles), &kept->triangles } };
    kiriKept_TakePart(kept, piece, &items.vertices.items, &items.triangles.items);
    return items;
}

static void DropPiece(kiriExtraction* extraction, int32_t piece, const PartMembers* items)
{
    kiriKept_DropPart(&extraction->kept, piece, &items->vertices.items, &items->triangles.items);
}

static kiriProgress MakeMeshOfPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuota* quota)
{
    if (to->mesh.isOpen) {
        return KIRI_DONE;
    }
    PartMembers items = TakeItemsOf(extraction, piece);
    kiriProgress progress = kiriMesh_MakePart(&to->mesh, to->memory, &extraction->kept.from->mesh, &items.triangles,
                                              &items.vertices, quota);
    if (progress == KIRI_DONE) {
        CopySettings(&extraction->kept, to);
    }
    DropPiece(extraction, piece, &items);
    return progress;
}

/* When its cells are there. */
static bool FillCellsOfPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to)
{
    PartMembers items = TakeItemsOf(extraction, piece);
    bool ok = CopySites(&extraction->kept, to) && CopyPoints(&extraction->kept, to);
    DropPiece(extraction, piece, &items);
    return ok;
}

static kiriProgress MakeFieldsOfPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuotas* quotas)
{
    to->settings.maxFrames = 0; /* whoever wants another frame has asked before, or asks with the next cut */
    kiriProgress progress = kiriPipeline_MakeSome(to, KIRI_STAGE_REGIONS, quotas);
    if (progress == KIRI_DONE && to->update->placing.sites.count == 0 && !FillCellsOfPart(extraction, piece, to)) {
        return KIRI_FAILED;
    }
    return progress == KIRI_DONE ? kiriPipeline_MakeSome(to, KIRI_STAGE_CONSTANTS, quotas) : progress;
}

enum { VERTICES_AN_ITEM = 8 }; /* of samples: of what passes over all of them, but writes no weights */

/* A step that takes so long with all vertices is paid as a whole. */
static bool PayPass(const kiriSheetData* to, kiriQuotas* quotas)
{
    return kiriQuota_Take(&quotas->of[KIRI_QUOTA_SAMPLES], 1 + to->mesh.vertices.count / VERTICES_AN_ITEM);
}

/* Weights where they are read fastest, before the commit: nothing changes them any more. */
static kiriProgress SortWeightsOfPart(kiriSheetData* to, kiriQuotas* quotas)
{
    kiriSkin* skin = &to->vertexSkin;
    if (skin->staged.count > 0) {
        kiriSkin_Commit(skin);
    }
    if (skin->settling.count > 0) {
        if (!PayPass(to, quotas)) {
            return KIRI_MORE;
        }
        return kiriSkin_Sort(skin, to->memory) ? KIRI_DONE : KIRI_FAILED;
    }
    return KIRI_DONE;
}

enum { SHOWN_ROOMS = 9 };

static void ListShownRooms(kiriSheetData* to, kiriRoom rooms[SHOWN_ROOMS])
{
    kiriMemory* shown = &to->shown;
    kiriSurface* s = &to->seen.surface;
    int64_t vertices = to->mesh.vertices.count, triangles = to->mesh.triangles.count;
    const kiriRoom all[SHOWN_ROOMS] = { KIRI_ROOM(shown, &s->positions, 3 * vertices + 1),
                                        KIRI_ROOM(shown, &s->normals, 3 * vertices),
                                        KIRI_ROOM(shown, &s->slopes, 4 * vertices),
                                        KIRI_ROOM(shown, &s->restPositions, 2 * vertices),
                                        KIRI_ROOM(shown, &s->rest, vertices),
                                        KIRI_ROOM(shown, &s->sourceWeights, 3 * vertices),
                                        KIRI_ROOM(shown, &s->sourceTriangles, vertices),
                                        KIRI_ROOM(shown, &s->indices, 3 * triangles),
                                        KIRI_ROOM(shown, &s->turns, (triangles + 1) / 2) };
    memcpy(rooms, all, sizeof(all));
}

/* The system gives fresh memory when it is written first: so that is done now, and not all at once in the tick in which
   the piece leaves. */
static kiriProgress TouchShownRooms(kiriSheetData* to, kiriQuotas* quotas)
{
    enum { TOUCHED_BYTES = 1024 }; /* for an item */
    kiriRoom rooms[SHOWN_ROOMS];
    kiriQuota* samples = &quotas->of[KIRI_QUOTA_SAMPLES];
    kiriProgress progress = KIRI_DONE;
    ListShownRooms(to, rooms);
    for (int i = 0; progress == KIRI_DONE && i < SHOWN_ROOMS && samples->left < INT64_MAX / 2; ++i) {
        progress = kiriArray_Fill(&rooms[i], samples, TOUCHED_BYTES);
    }
    return progress;
}

/* All that is seen of it but where. */
static kiriProgress WriteTopologyOfPart(kiriSheetData* to, kiriQuotas* quotas)
{
    if (to->seen.surface.vertexCount > 0) {
        return KIRI_DONE;
    }
    kiriProgress progress = TouchShownRooms(to, quotas);
    if (progress != KIRI_DONE) {
        return progress;
    }
    if (!PayPass(to, quotas)) {
        return KIRI_MORE;
    }
    if (!kiriView_Resize(to, to->update->placing.sites.count, to->points.count)) {
        return KIRI_FAILED;
    }
    kiriSurface_WriteTopology(&to->seen.surface, &to->mesh);
    return KIRI_DONE;
}

kiriProgress kiriExtraction_GoOn(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuotas* quotas)
{
    kiriProgress progress = MakeMeshOfPart(extraction, piece, to, &quotas->of[KIRI_QUOTA_CELLS]);
    progress = progress == KIRI_DONE ? MakeFieldsOfPart(extraction, piece, to, quotas) : progress;
    progress = progress == KIRI_DONE ? SortWeightsOfPart(to, quotas) : progress;
    progress = progress == KIRI_DONE ? kiriStage_Owners(to, &quotas->of[KIRI_QUOTA_SAMPLES]) : progress;
    return progress == KIRI_DONE ? WriteTopologyOfPart(to, quotas) : progress;
}

static bool EndPart(kiriExtraction* extraction, int32_t piece, kiriSheetData* to)
{
    const kiriSheetData* from = extraction->kept.from;
    PartMembers items = TakeItemsOf(extraction, piece);
    CopySettings(&extraction->kept, to); /* as they are now */
    to->settings.maxFrames = 0;
    to->seen.bounds->patience = from->seen.bounds->patience;
    bool ok = CopyMotion(&extraction->kept, to);
    to->settings.maxFrames = from->settings.maxFrames;
    DropPiece(extraction, piece, &items);
    return ok;
}

bool kiriExtraction_Build(kiriExtraction* extraction, int32_t piece, kiriSheetData* to)
{
    kiriQuotas unlimited = kiriQuotas_Unlimited();
    return kiriExtraction_GoOn(extraction, piece, to, &unlimited) == KIRI_DONE && EndPart(extraction, piece, to);
}

void kiriExtraction_Drop(kiriExtraction* extraction)
{
    if (extraction->kept.from != NULL) {
        kiriMemory_FreeAll(&extraction->kept.memory);
    }
}
