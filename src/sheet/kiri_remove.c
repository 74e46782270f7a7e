#include "kiri_remove.h"

#include "kiri_ahead.h"
#include "kiri_blocks.h"
#include "kiri_motion.h"
#include "kiri_piece_list.h"
#include "kiri_pin.h"
#include "kiri_stages.h"
#include "kiri_touch.h"
#include "kiri_touch_memory.h"

#include <string.h>

bool kiriRemoval_Init(kiriRemoval* removal, kiriSheetData* sheet)
{
    memset(removal, 0, sizeof(*removal));
    removal->sheet = sheet;
    return kiriKept_Init(&removal->kept, sheet);
}

/* ---- Ready ---- */

/* Cells that go, in the order of squares. */
static bool ListCells(kiriRemoval* removal)
{
    const kiriSheetData* sheet = removal->sheet;
    kiriMemory* memory = &removal->kept.memory;
    bool ok = true;
    for (int32_t s = 0; ok && s < sheet->grid.squareCell.count; ++s) {
        bool isListed = false;
        for (int32_t c = sheet->grid.squareCell.data[s]; ok && c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            if (!kiriKeep_Has(&removal->kept.frames, sheet->regions.field.owner.data[c])) {
                ok = kiriArray_Push(memory, &removal->cells, c) &&
                     (isListed || kiriArray_Push(memory, &removal->squares, s));
                isListed = true;
            }
        }
    }
    return ok;
}

static bool ListGathered(kiriRemoval* removal)
{
    kiriGather_Mark(&removal->gathered);
    removal->cells = removal->gathered.cells;
    removal->squares = removal->gathered.squares;
    return kiriKept_LeaveHoles(&removal->kept);
}

static bool StagePieces(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriMemory* scratch = &removal->kept.memory;
    const kiriLayout* layout = &sheet->layout;
    kiriLayout* next = &sheet->update->next;
    kiriKeep pieces;
    next->pieces.count = next->framePiece.count = 0;
    bool ok = kiriKeep_Init(&pieces, scratch, layout->pieces.count) &&
              kiriArray_Reserve(sheet->memory, &next->pieces, layout->pieces.count) &&
              kiriArray_Reserve(sheet->memory, &next->framePiece, layout->framePiece.count);
    for (int32_t p = 0; ok && p < layout->pieces.count; ++p) {
        const kiriPiece* was = &layout->pieces.data[p];
        kiriPiece piece = { .area = was->area,
                            .frame = kiriKeep_To(&removal->kept.frames, was->frame),
                            .origin = KIRI_NONE,
                            .rest = was->rest };
        kiriKeep_Add(&pieces, removal->kept.pieces.data[p] != 0);
        if (removal->kept.pieces.data[p]) {
            next->pieces.data[next->pieces.count++] = piece;
        }
    }
    for (int32_t f = 0; ok && f < layout->framePiece.count; ++f) {
        if (kiriKeep_Has(&removal->kept.frames, f)) {
            next->framePiece.data[next->framePiece.count++] = kiriKeep_To(&pieces, layout->framePiece.data[f]);
        }
    }
    return ok;
}

static bool StagePins(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    const kiriLayout* layout = &sheet->layout;
    kiriLayout* next = &sheet->update->next;
    bool ok = true;
    next->pinFrame.count = next->pinShares.count = next->severed.count = 0;
    for (int32_t i = 0; ok && i < sheet->pins.count; ++i) {
        int32_t frame = kiriKept_FrameOfPin(kept, i);
        ok = frame == KIRI_NONE || kiriArray_Push(sheet->memory, &next->pinFrame, kiriKeep_To(&kept->frames, frame));
    }
    for (int32_t k = 0; ok && k < layout->pinShares.count; ++k) {
        kiriPinShare pinned = layout->pinShares.data[k];
        pinned.pin = kiriKeep_To(&kept->pins, pinned.pin);
        pinned.share.frame = kiriKeep_To(&kept->frames, pinned.share.frame);
        ok = pinned.share.frame == KIRI_NONE || kiriArray_Push(sheet->memory, &next->pinShares, pinned);
    }
    for (int32_t k = 0; ok && k < layout->severed.count; ++k) {
        kiriSeveredLink severed = layout->severed.data[k];
        severed.pin = kiriKeep_To(&kept->pins, severed.pin);
        severed.link = kiriKeep_To(&kept->links, severed.link);
        ok = severed.link == KIRI_NONE || kiriArray_Push(sheet->memory, &next->severed, severed);
    }
    return ok;
}

/* What each touch that is remembered pushed with: of the last tick, and then of pieces that sleep. */
static bool ListForces(kiriRemoval* removal)
{
    const kiriTouches* touches = &removal->sheet->touches;
    int32_t last = touches->last.touches.count, slept = touches->slept.touches.count;
    if (!kiriArray_Resize(&removal->kept.memory, &removal->forces, (int64_t)last + slept)) {
        return false;
    }
    for (int32_t i = 0; i < last + slept; ++i) {
        const kiriTouch* touch = i < last ? &touches->last.touches.data[i] : &touches->slept.touches.data[i - last];
        removal->forces.data[i] = kiriTouches_ForceOf(removal->sheet, touch->key);
    }
    return true;
}

static bool StageLayout(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriAreaElements* elements = &sheet->update->next.areaElements;
    elements->elements.count = elements->shares.count = 0;
    return StagePieces(removal) && StagePins(removal) &&
           kiriAreaElements_Keep(elements, sheet->memory, &sheet->layout.areaElements, &removal->kept.frames) &&
           kiriLinks_Keep(&sheet->links, sheet->memory, &removal->kept.links, &removal->kept.frames);
}

bool kiriRemoval_Gather(kiriRemoval* removal)
{
    const kiriGathered* known = kiriAhead_Gathered(removal->sheet, removal->kept.pieces.data);
    if (known != NULL) {
        removal->gathered = *known;
    }
    return known != NULL ||
           kiriGather_Make(&removal->gathered, removal->sheet, &removal->kept.memory, removal->kept.pieces.data);
}

enum { SMALL_SHEET = 4096 }; /* vertices: a pass over them takes no longer than a tick */

bool kiriRemoval_IsWorthAPass(const kiriSheetData* sheet, double share)
{
    int32_t vertices = sheet->mesh.vertices.count, holes = sheet->mesh.vertexHoles;
    return vertices <= SMALL_SHEET || 2.0 * (holes + share * (vertices - holes)) > vertices;
}

double kiriRemoval_Samples(const kiriSheetData* sheet, double share)
{
    enum {
        RENUMBERED_VERTICES = 80,
        PASSED_VERTICES = 12
    }; /* for one: owners get other indices, and what a host holds is copied; all moves together */
    const kiriMeshData* mesh = &sheet->mesh;
    double vertices = (double)mesh->vertices.count - mesh->vertexHoles;
    double pass = kiriRemoval_IsWorthAPass(sheet, share) ? vertices / PASSED_VERTICES : 0.0;
    return 1.0 + vertices / RENUMBERED_VERTICES + pass;
}

static bool StageLabels(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriLabels* labels = &sheet->shape.labels;
    if (removal->leavesHoles) {
        return kiriLabels_Reserve(labels, sheet->memory, sheet->frames.count);
    }
    bool ok = kiriKeep_Init(&removal->labels, &removal->kept.memory, kiriLabels_Count(labels, sheet->frames.count));
    if (ok) {
        kiriLabels_Map(labels, &removal->kept.frames, &removal->labels);
    }
    return ok;
}

static bool StageItems(kiriRemoval* removal)
{
    const kiriKept* kept = &removal->kept;
    return removal->leavesHoles
               ? ListGathered(removal)
               : kiriKept_Map(&removal->kept) && ListCells(removal) &&
                     kiriShown_Reserve(&removal->shown, &removal->sheet->shown, &kept->triangles, &kept->vertices);
}

bool kiriRemoval_Stage(kiriRemoval* removal, bool leavesHoles)
{
    kiriSheetData* sheet = removal->sheet;
    KIRI_ASSERT(kiriUpdate_IsFieldCurrent(sheet->update));
    kiriGather_Pause(sheet);
    removal->leavesHoles = leavesHoles;
    return StageItems(removal) && StageLabels(removal) && ListForces(removal) && StageLayout(removal) &&
           kiriArray_Reserve(&sheet->shown, &removal->points, 3 * (int64_t)removal->kept.points.count) &&
           kiriStage_Solver(sheet, removal->kept.frames.count);
}

/* ---- Gone ---- */

/* What labels become, where all is passed over in any case. */
static const kiriKeep* LabelsOf(const kiriRemoval* removal)
{
    return removal->leavesHoles ? NULL : &removal->labels;
}

static void KeepMesh(kiriRemoval* removal)
{
    kiriMeshData* mesh = &removal->sheet->mesh;
    const kiriKept* kept = &removal->kept;
    const kiriGathered* gone = &removal->gathered;
    if (removal->leavesHoles) {
        const kiriMeshLoss loss = { &gone->triangles, &gone->vertices, &gone->squares, kept->triangles,
                                    kept->vertices };
        kiriMesh_LeaveHoles(mesh, &loss);
    } else {
        kiriMesh_Keep(mesh, &kept->triangles, &kept->vertices, removal->squares.data, removal->squares.count);
    }
}

static void KeepFields(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    const int32_t *cells = removal->cells.data, *squares = removal->squares.data;
    int32_t cellCount = removal->cells.count, squareCount = removal->squares.count;
    KeepMesh(removal);
    kiriGrid_Keep(&sheet->grid, sheet->memory, &kept->triangles, &kept->vertices, cells, cellCount);
    kiriRegions_Keep(&sheet->regions, &kept->frames, cells, cellCount);
    kiriShape_Keep(&sheet->shape, sheet->memory, &kept->frames, LabelsOf(removal), cells, cellCount);
    kiriOwnership_Keep(&sheet->update->refit.ownership, &sheet->grid, &sheet->mesh, &sheet->regions, &kept->triangles,
                       &kept->frames, squares, squareCount);
}

static void KeepPoints(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriKeep_Compact(&removal->kept.points, &sheet->points, 1, sizeof(kiriSample));
    for (int32_t i = 0; i < sheet->points.count; ++i) {
        sheet->points.data[i].frame = kiriKeep_To(&removal->kept.frames, sheet->points.data[i].frame);
    }
    kiriPlaces_Keep(&sheet->pointPlaces, &removal->kept.points);
    kiriSkin_Keep(&sheet->pointSkin, &removal->kept.points, LabelsOf(removal));
    if (removal->leavesHoles) {
        kiriSkin_LeaveHoles(&sheet->vertexSkin, &removal->gathered.vertices);
    } else {
        kiriSkin_Keep(&sheet->vertexSkin, &removal->kept.vertices, LabelsOf(removal));
    }
}

static void KeepContacts(const kiriKept* kept, kiriSheetData* sheet)
{
    int32_t left = 0;
    for (int32_t i = 0; i < sheet->contacts.count; ++i) {
        kiriGivenContact given = sheet->contacts.data[i];
        if (kiriKept_FollowContact(kept, &given)) {
            sheet->contacts.data[left++] = given;
        }
    }
    sheet->contacts.count = left;
}

/* Forces go by keys, and keys by indices: they are remembered anew. */
static void KeepTouches(kiriRemoval* removal, kiriTouchMemory* memory, const kiriVec3* forces)
{
    int32_t count = memory->touches.count;
    memory->touches.count = memory->forces.count = memory->given = 0;
    for (int32_t i = 0; i < count; ++i) {
        kiriTouch touch = memory->touches.data[i];
        if (kiriKept_FollowTouch(&removal->kept, &touch)) {
            kiriTouchMemory_Add(memory, &touch, forces[i]);
        }
    }
    kiriTouchMemory_SortForces(memory, 0, &removal->sheet->touches.order);
}

/* What the sheet keeps of its pieces from tick to tick, beside fields and what is staged: state that is new belongs
   here, and into kiri_extract.c. */
static void KeepState(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriUpdate* u = sheet->update;
    const kiriKept* kept = &removal->kept;
    kiriKeep_Compact(&kept->frames, &sheet->frames, 1, sizeof(kiriFrameData));
    kiriKeep_Compact(&kept->frames, &u->material, 1, sizeof(kiriMoments));
    kiriKeep_Compact(&kept->frames, &u->placing.sites, 1, sizeof(kiriSite));
    kiriKeep_Compact(&kept->pins, &sheet->pins, 1, sizeof(kiriPinData));
    kiriKeep_Compact(&kept->links, &sheet->strainOffsets.strainOffsets, 1, sizeof(kiriStrainOffset));
    KeepContacts(kept, sheet);
    int32_t last = sheet->touches.last.touches.count;
    KeepTouches(removal, &sheet->touches.last, removal->forces.data);
    KeepTouches(removal, &sheet->touches.slept, removal->forces.data + last);
    sheet->touches.rests.areSummed = false;
    kiriFades_Keep(&sheet->seen.fades, &kept->vertices);
    kiriFades_Keep(&sheet->seen.pointFades, &kept->points);
    u->samples.oldVertices = sheet->mesh.vertices.count;
}

static void KeepSettings(kiriRemoval* removal)
{
    kiriSettings* settings = &removal->sheet->settings;
    double share = kiriKept_Share(&removal->kept);
    settings->collisionPoints *= share;
    settings->integrationPoints *= share;
}

static void MoveBlade(const kiriRemoval* removal, kiriBladeTip* blade)
{
    blade->vertex = kiriKeep_To(&removal->kept.vertices, blade->vertex);
}

static void MoveBlades(const kiriRemoval* removal)
{
    for (int32_t i = 0; i < removal->sheet->cuts.count; ++i) {
        kiriCutData* cut = removal->sheet->cuts.data[i];
        MoveBlade(removal, &cut->tip.blade);
        MoveBlade(removal, &cut->committed.blade);
    }
}

/* What is staged comes in force, as in kiriStage_Commit. */
static void CommitStaged(kiriRemoval* removal)
{
    kiriSheetData* sheet = removal->sheet;
    kiriLayout layout = sheet->layout;
    kiriLinks_Commit(&sheet->links);
    kiriSolver_Commit(sheet->solver);
    sheet->layout = sheet->update->next;
    sheet->update->next = layout;
    kiriPins_WriteLinkParts(sheet);
    kiriPins_SumShares(sheet);
    kiriMotion_SumRest(sheet);
}

static void ReplaceFloats(void* array, void* fresh, kiriMemory* retired)
{
    kiriArrayHeader was = kiriArray_GetHeader(array);
    kiriArray_SetHeader(array, kiriArray_GetHeader(fresh));
    kiriMemory_Adopt(retired, was.data);
}

static void KeepSurface(kiriRemoval* removal, kiriMemory* retired)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    if (removal->leavesHoles) {
        kiriSurface_LeaveHoles(&sheet->seen.surface, &removal->gathered.triangles, &sheet->mesh, kept->frames.count);
        kiriBlocks_LeaveHoles(&sheet->seen.blocks, &removal->gathered.vertices, &kept->frames);
    } else {
        kiriBlocks_Forget(&sheet->seen.blocks);
        kiriSurface_Keep(&sheet->seen.surface, &removal->shown, &kept->triangles, &kept->vertices, &sheet->mesh,
                         kept->frames.count, retired);
        kiriBounds_Forget(sheet->seen.bounds);
        sheet->seen.vertexCount = kept->vertices.count;
    }
}

static void KeepSeen(kiriRemoval* removal, kiriMemory* retired)
{
    kiriSheetData* sheet = removal->sheet;
    const kiriKept* kept = &removal->kept;
    KeepSurface(removal, retired);
    kiriBlocks_Truncate(&sheet->seen.blocks, sheet->seen.surface.vertexCount, sheet->frames.count);
    kiriKeep_Compact(&kept->points, &sheet->seen.exactPoints, 1, sizeof(kiriVec3));
    if (sheet->seen.pointPositions.count > 0) {
        kiriKeep_Copy(&kept->points, removal->points.data, sheet->seen.pointPositions.data, 3 * sizeof(float));
        removal->points.count = 3 * kept->points.count;
    }
    ReplaceFloats(&sheet->seen.pointPositions, &removal->points, retired);
    sheet->seen.pointCount = kept->points.count;
}

static void KeepLists(kiriRemoval* removal, kiriMemory* retired)
{
    kiriPieceLists* lists = &removal->sheet->lists;
    if (removal->leavesHoles) {
        kiriPieceLists_LeaveHoles(lists, removal->kept.pieces.data, retired);
    } else {
        kiriPieceLists_Retire(lists, retired);
    }
}

void kiriRemoval_Commit(kiriRemoval* removal, kiriMemory* retired)
{
    KeepSettings(removal); /* by the layout as it is */
    KeepFields(removal);
    KeepPoints(removal);
    KeepState(removal);
    CommitStaged(removal);
    MoveBlades(removal);
    KeepSeen(removal, retired);
    KeepLists(removal, retired);
    removal->sheet->probes.isFresh = false;
    memset(&removal->shown, 0, sizeof(removal->shown));
    memset(&removal->points, 0, sizeof(removal->points));
}

void kiriRemoval_Drop(kiriRemoval* removal)
{
    if (removal->sheet != NULL) {
        kiriGather_Unmark(&removal->gathered);
        kiriShown_Release(&removal->shown, &removal->sheet->shown);
        kiriArray_Release(&removal->sheet->shown, &removal->points);
        kiriMemory_FreeAll(&removal->kept.memory);
    }
}
