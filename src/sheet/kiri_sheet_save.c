#include "kiri_sheet_save.h"

#include "../field/kiri_field_save.h"
#include "../mesh/kiri_mesh_check.h"
#include "../motion/kiri_motion_check.h"
#include "../view/kiri_view_check.h"
#include "kiri_touch.h"
#include "kiri_update.h"
#include "kiri_seen.h"

#include <string.h>

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

static const kiriMember SettingsMembers[] = {
    KIRI_RUN(4, kiriSettings, material, material),     KIRI_PART(kiriSettings, mechanics, kiriMechanicsTable),
    KIRI_RUN(4, kiriSettings, given, given),           KIRI_RUN(8, kiriSettings, snap, frameLength),
    KIRI_RUN(4, kiriSettings, maxFrames, skinning),    KIRI_RUN(8, kiriSettings, fadeTime, contactThickness),
    KIRI_RUN(4, kiriSettings, groups, groups),         KIRI_BOOLS(kiriSettings, touchesSheets, touchesSheets),
    KIRI_RUN(8, kiriSettings, air, integrationPoints), KIRI_RUN(4, kiriSettings, integrationOrder, integrationOrder),
    KIRI_BOOLS(kiriSettings, fromScratch, eased),
};
static const kiriTable SettingsTable = KIRI_TABLE(kiriSettings, SettingsMembers);

static const kiriMember RestMembers[] = {
    KIRI_RUN(8, kiriRest, calm, calm),
    KIRI_BOOLS(kiriRest, asleep, isFading),
};
static const kiriTable RestTable = KIRI_TABLE(kiriRest, RestMembers);

static const kiriMember PieceMembers[] = {
    KIRI_RUN(8, kiriPiece, area, area),        KIRI_RUN(4, kiriPiece, frame, origin),
    KIRI_BOOLS(kiriPiece, cameOff, isTouched), KIRI_RUN(4, kiriPiece, island, island),
    KIRI_PART(kiriPiece, rest, RestTable),
};
static const kiriTable PieceTable = KIRI_TABLE(kiriPiece, PieceMembers);

static const kiriMember SeveredLinkMembers[] = {
    KIRI_RUN(4, kiriSeveredLink, pin, link),
    KIRI_RUN(8, kiriSeveredLink, part, part),
};
static const kiriTable SeveredLinkTable = KIRI_TABLE(kiriSeveredLink, SeveredLinkMembers);

static const kiriMember LineShareMembers[] = {
    KIRI_RUN(4, kiriLineShare, frame, frame),
    KIRI_RUN(8, kiriLineShare, length, ends),
    KIRI_RUN(4, kiriLineShare, open, open),
};
static const kiriTable LineShareTable = KIRI_TABLE(kiriLineShare, LineShareMembers);

static const kiriMember PinShareMembers[] = {
    KIRI_RUN(4, kiriPinShare, pin, pin),
    KIRI_PART(kiriPinShare, share, LineShareTable),
    KIRI_RUN(8, kiriPinShare, offset, bore),
};
static const kiriTable PinShareTable = KIRI_TABLE(kiriPinShare, PinShareMembers);

static const kiriMember LayoutMembers[] = {
    KIRI_PARTS(kiriLayout, pieces, PieceTable),
    KIRI_ITEMS(4, kiriLayout, framePiece),
    KIRI_ITEMS(4, kiriLayout, pinFrame),
    KIRI_PARTS(kiriLayout, severed, SeveredLinkTable),
    KIRI_PARTS(kiriLayout, pinShares, PinShareTable),
    KIRI_PART(kiriLayout, areaElements, kiriAreaElementsTable),
};
static const kiriTable LayoutTable = KIRI_TABLE(kiriLayout, LayoutMembers);

static const kiriMember PinAnchorMembers[] = {
    KIRI_RUN(4, kiriPinAnchor, obstacle, obstacle),
    KIRI_RUN(8, kiriPinAnchor, local, softness),
};
static const kiriTable PinAnchorTable = KIRI_TABLE(kiriPinAnchor, PinAnchorMembers);

static const kiriMember PinDataMembers[] = {
    KIRI_RUN(4, kiriPinData, id, id),
    KIRI_RUN(8, kiriPinData, userData, userData),
    KIRI_RUN(4, kiriPinData, type, to),
    KIRI_RUN(8, kiriPinData, target, breakForce),
    KIRI_PART(kiriPinData, anchor, PinAnchorTable),
    KIRI_RUN(8, kiriPinData, off, off),
    KIRI_RUN(4, kiriPinData, offFrame, offFrame),
    KIRI_RUN(8, kiriPinData, stiffness, bore),
};
static const kiriTable PinDataTable = KIRI_TABLE(kiriPinData, PinDataMembers);

static const kiriMember GivenContactMembers[] = {
    KIRI_RUN(4, kiriGivenContact, contact, vertex),
    KIRI_RUN(8, kiriGivenContact, share, share),
};
static const kiriTable GivenContactTable = KIRI_TABLE(kiriGivenContact, GivenContactMembers);

static const kiriMember TouchMembers[] = {
    KIRI_RUN(8, kiriTouch, key, key),         KIRI_RUN(4, kiriTouch, point, vertex),
    KIRI_RUN(8, kiriTouch, share, pushSpeed), KIRI_RUN(4, kiriTouch, yield, yield),
    KIRI_RUN(8, kiriTouch, felt, cushion),    KIRI_RUN(4, kiriTouch, row, row),
    KIRI_RUN(8, kiriTouch, force, force),
};
static const kiriTable TouchTable = KIRI_TABLE(kiriTouch, TouchMembers);

static const kiriMember TouchMemoryMembers[] = {
    KIRI_PARTS(kiriTouchMemory, touches, TouchTable),
    KIRI_ITEMS(8, kiriTouchMemory, forces),
    KIRI_RUN(4, kiriTouchMemory, given, given),
};
static const kiriTable TouchMemoryTable = KIRI_TABLE(kiriTouchMemory, TouchMemoryMembers);

static const kiriMember ContactForceMembers[] = {
    KIRI_RUN(8, kiriContactForce, impulse, depth),
    KIRI_RUN(4, kiriContactForce, point, obstacle),
};
static const kiriTable ContactForceTable = KIRI_TABLE(kiriContactForce, ContactForceMembers);

/* Summed anew. */
static const kiriMember RestLoadsMembers[] = {
    KIRI_ROOM_OF(kiriRestLoads, on),
    KIRI_DROPPED(kiriRestLoads, dt),
    KIRI_DROPPED(kiriRestLoads, areSummed),
};
static const kiriTable RestLoadsTable = KIRI_TABLE(kiriRestLoads, RestLoadsMembers);

static const kiriMember TouchesMembers[] = {
    KIRI_SPACE_OF(kiriTouches, found),
    KIRI_ROOM_OF(kiriTouches, yields),
    KIRI_ROOM_OF(kiriTouches, rows),
    KIRI_PART(kiriTouches, last, TouchMemoryTable),
    KIRI_PART(kiriTouches, slept, TouchMemoryTable),
    KIRI_PART(kiriTouches, rests, RestLoadsTable),
    KIRI_ROOM_OF(kiriTouches, order),
    KIRI_BOOLS(kiriTouches, isShort, isShort),
    KIRI_DROPPED(kiriTouches, told),
    KIRI_DROPPED(kiriTouches, nextTold),
};
static const kiriTable TouchesTable = KIRI_TABLE(kiriTouches, TouchesMembers);

static const kiriMember BlocksMembers[] = {
    KIRI_ITEMS(1, kiriBlocks, touched), KIRI_ITEMS(1, kiriBlocks, stale),
    KIRI_ITEMS(4, kiriBlocks, movers),  KIRI_ITEMS(8, kiriBlocks, frames),
    KIRI_ITEMS(1, kiriBlocks, moved),   KIRI_BOOLS(kiriBlocks, hasUnknown, hasUnknown),
};
static const kiriTable BlocksTable = KIRI_TABLE(kiriBlocks, BlocksMembers);

static const kiriMember SeenMembers[] = {
    KIRI_DROPPED(kiriSeen, surface),
    KIRI_DROPPED(kiriSeen, bounds),
    KIRI_PART(kiriSeen, fades, kiriFadesTable),
    KIRI_PART(kiriSeen, pointFades, kiriFadesTable),
    KIRI_SHOWN_OF(kiriSeen, exactPoints),
    KIRI_RUN(4, kiriSeen, pointCount, pointCount),
    KIRI_DROPPED(kiriSeen, pointPositions),
    KIRI_ROOM_OF(kiriSeen, pointsBefore),
    KIRI_BOOLS(kiriSeen, isElsewhere, isElsewhere),
    KIRI_RUN(4, kiriSeen, vertexCount, vertexCount),
    KIRI_PART(kiriSeen, blocks, BlocksTable),
    KIRI_RUN(8, kiriSeen, lists, lists),
    KIRI_BOOLS(kiriSeen, areFadesAsleep, areFadesAsleep),
};
static const kiriTable SeenTable = KIRI_TABLE(kiriSeen, SeenMembers);

static const kiriMember CutWorkMembers[] = {
    KIRI_RUN(8, kiriCutWork, stamp, stamp),
    KIRI_RUN(4, kiriCutWork, count, taken),
    KIRI_BOOLS(kiriCutWork, meshChanged, settlesSites),
};
static const kiriTable CutWorkTable = KIRI_TABLE(kiriCutWork, CutWorkMembers);

static const kiriMember UpdateStartMembers[] = {
    KIRI_RUN(4, kiriUpdateStart, stage, stage),
    KIRI_PART(kiriUpdateStart, cut, CutWorkTable),
    KIRI_RUN(8, kiriUpdateStart, spent, spent),
};
static const kiriTable UpdateStartTable = KIRI_TABLE(kiriUpdateStart, UpdateStartMembers);

static const kiriMember SlitSearchMembers[] = {
    KIRI_RUN(4, kiriSlitSearch, seen, seen),
    KIRI_RUN(8, kiriSlitSearch, owed, owed),
};
static const kiriTable SlitSearchTable = KIRI_TABLE(kiriSlitSearch, SlitSearchMembers);

static const kiriMember PlacingWorkMembers[] = {
    KIRI_PARTS(kiriPlacingWork, sites, kiriSiteTable),
    KIRI_ITEMS(4, kiriPlacingWork, moves),
    KIRI_RUN(4, kiriPlacingWork, movesSeen, pieces),
    KIRI_PART(kiriPlacingWork, placer, kiriPlacerTable),
    KIRI_BOOLS(kiriPlacingWork, isTaking, isPlacing),
    KIRI_PART(kiriPlacingWork, search, SlitSearchTable),
    KIRI_BOOLS(kiriPlacingWork, isAgain, isFirst),
    KIRI_RUN(8, kiriPlacingWork, whole, whole),
    KIRI_RUN(4, kiriPlacingWork, at, at),
    KIRI_ITEMS(1, kiriPlacingWork, marks),
    KIRI_ITEMS(1, kiriPlacingWork, allowed),
    KIRI_ITEMS(1, kiriPlacingWork, flags),
    KIRI_ITEMS(4, kiriPlacingWork, own),
};
static const kiriTable PlacingWorkTable = KIRI_TABLE(kiriPlacingWork, PlacingWorkMembers);

static const kiriMember SampleWorkMembers[] = {
    KIRI_RUN(4, kiriSampleWork, oldVertices, oldVertices),
    KIRI_PART(kiriSampleWork, refresh, kiriRefreshTable),
    KIRI_ITEMS(4, kiriSampleWork, newPoints),
    KIRI_ITEMS(4, kiriSampleWork, movedPoints),
};
static const kiriTable SampleWorkTable = KIRI_TABLE(kiriSampleWork, SampleWorkMembers);

static const kiriMember SavedUpdateMembers[] = {
    KIRI_BOOLS(kiriUpdate, isUnsettled, isUnsettled),
};
static const kiriTable SavedUpdateTable = KIRI_TABLE(kiriUpdate, SavedUpdateMembers);

static const kiriMember UpdateMembers[] = {
    KIRI_RUN(4, kiriUpdate, stage, step),
    KIRI_RUN(8, kiriUpdate, spent, spent),
    KIRI_BOOLS(kiriUpdate, needsRebuild, isScratch),
    KIRI_PART(kiriUpdate, start, UpdateStartTable),
    KIRI_BOOLS(kiriUpdate, isBegun, isBegun),
    KIRI_PART(kiriUpdate, cut, CutWorkTable),
    KIRI_PART(kiriUpdate, placing, PlacingWorkTable),
    KIRI_ITEMS(8, kiriUpdate, material),
    KIRI_PART(kiriUpdate, samples, SampleWorkTable),
    KIRI_PART(kiriUpdate, refit, kiriRefitTable),
    KIRI_RUN(8, kiriUpdate, due, due),
    KIRI_ITEMS(4, kiriUpdate, newFrames),
    KIRI_DROPPED(kiriUpdate, integration),
    KIRI_PART(kiriUpdate, next, LayoutTable),
    KIRI_ITEMS(4, kiriUpdate, parent),
    KIRI_RUN(4, kiriUpdate, counts, counts),
};
static const kiriTable UpdateTable = KIRI_TABLE(kiriUpdate, UpdateMembers);

static const kiriMember BladeTipMembers[] = {
    KIRI_RUN(4, kiriBladeTip, at, lip),
    KIRI_RUN(8, kiriBladeTip, owed, owed),
};
static const kiriTable BladeTipTable = KIRI_TABLE(kiriBladeTip, BladeTipMembers);

static const kiriMember TipMembers[] = {
    KIRI_RUN(8, kiriTip, last, last),
    KIRI_PART(kiriTip, blade, BladeTipTable),
};
static const kiriTable TipTable = KIRI_TABLE(kiriTip, TipMembers);

static const kiriMember CutDataMembers[] = {
    KIRI_RUN(4, kiriCutData, id, id),
    KIRI_DROPPED(kiriCutData, sheet),
    KIRI_RUN(4, kiriCutData, index, index),
    KIRI_PART(kiriCutData, tip, TipTable),
    KIRI_PART(kiriCutData, committed, TipTable),
    KIRI_RUN(4, kiriCutData, waiting, waiting),
    KIRI_BOOLS(kiriCutData, ended, ended),
};
static const kiriTable CutDataTable = KIRI_TABLE(kiriCutData, CutDataMembers);

static const kiriMember QueuedPointMembers[] = {
    KIRI_DROPPED(kiriQueuedPoint, cut),
    KIRI_RUN(8, kiriQueuedPoint, to, stamp),
    KIRI_BOOLS(kiriQueuedPoint, jump, ends),
};
static const kiriTable QueuedPointTable = KIRI_TABLE(kiriQueuedPoint, QueuedPointMembers);

/* Arrays that the host may hold, which are of another owner. */
static const kiriMember ToldMembers[] = {
    KIRI_PARTS(kiriTouches, told, ContactForceTable),
    KIRI_ROOM_OF(kiriTouches, nextTold),
};
static const kiriTable ToldTable = KIRI_TABLE(kiriTouches, ToldMembers);

static const kiriMember ShownPointsMembers[] = {
    KIRI_SHOWN_OF(kiriSeen, pointPositions),
};
static const kiriTable ShownPointsTable = KIRI_TABLE(kiriSeen, ShownPointsMembers);

/* Probes are chosen anew; those of a sheet that sleeps keep the velocities that they had. */
static const kiriMember ProbesMembers[] = {
    KIRI_BOOLS(kiriProbes, isFresh, isFresh), KIRI_RUN(4, kiriProbes, block, block),
    KIRI_DROPPED(kiriProbes, sheet),          KIRI_DROPPED(kiriProbes, areGrouped),
    KIRI_DROPPED(kiriProbes, firstBody),      KIRI_DROPPED(kiriProbes, vertexPiece),
    KIRI_DROPPED(kiriProbes, isBorder),       KIRI_DROPPED(kiriProbes, leans),
    KIRI_DROPPED(kiriProbes, isChosen),       KIRI_DROPPED(kiriProbes, list),
    KIRI_DROPPED(kiriProbes, boxes),          KIRI_DROPPED(kiriProbes, touch),
};
static const kiriTable ProbesTable = KIRI_TABLE(kiriProbes, ProbesMembers);

static const kiriMember ProbeSpeedsMembers[] = {
    KIRI_ITEMS(8, kiriProbes, velocities),
    KIRI_ITEMS(8, kiriProbes, speeds),
};
static const kiriTable ProbeSpeedsTable = KIRI_TABLE(kiriProbes, ProbeSpeedsMembers);

/* Of the world's memory. Pointers are put in by hand. */
static const kiriMember QueueMembers[] = {
    KIRI_SPACE_OF(kiriSheetData, queue),
    KIRI_SPACE_OF(kiriSheetData, cuts),
};
static const kiriTable QueueTable = KIRI_TABLE(kiriSheetData, QueueMembers);

/* What changes with the work on cuts alone. */
static const kiriMember StillSheetMembers[] = {
    KIRI_PART(kiriSheetData, mesh, kiriMeshTable),
    KIRI_DROPPED(kiriSheetData, grid),
    KIRI_PART(kiriSheetData, regions, kiriSavedRegionsTable),
    KIRI_PART(kiriSheetData, shape, kiriSavedShapeTable),
    KIRI_OWNED(kiriSheetData, update, SavedUpdateTable),
    KIRI_DROPPED(kiriSheetData, links),
    KIRI_ITEMS(4, kiriSheetData, points),
    KIRI_DROPPED(kiriSheetData, vertexSkin),
    KIRI_DROPPED(kiriSheetData, pointSkin),
    KIRI_DROPPED(kiriSheetData, pointPlaces),
};
static const kiriTable StillSheetTable = KIRI_TABLE(kiriSheetData, StillSheetMembers);

/* And in any tick. */
static const kiriMember LiveSheetMembers[] = {
    KIRI_RUN(4, kiriSheetData, id, id),
    KIRI_DROPPED(kiriSheetData, memory),
    KIRI_DROPPED(kiriSheetData, own),
    KIRI_DROPPED(kiriSheetData, shown),
    KIRI_PART(kiriSheetData, settings, SettingsTable),
    KIRI_PARTS(kiriSheetData, frames, kiriFrameTable),
    KIRI_PART(kiriSheetData, layout, LayoutTable),
    KIRI_PART(kiriSheetData, strainOffsets, kiriStrainOffsetsTable),
    KIRI_DROPPED(kiriSheetData, solver),
    KIRI_DROPPED(kiriSheetData, queue),
    KIRI_DROPPED(kiriSheetData, cuts),
    KIRI_PARTS(kiriSheetData, pins, PinDataTable),
    KIRI_PARTS(kiriSheetData, contacts, GivenContactTable),
    KIRI_ITEMS(4, kiriSheetData, leaving),
    KIRI_RUN(8, kiriSheetData, leavingPaid, leavingPaid),
    KIRI_ITEMS(8, kiriSheetData, linkParts),
    KIRI_ROOM_OF(kiriSheetData, pinRows),
    KIRI_ROOM_OF(kiriSheetData, clampRows),
    KIRI_ROOM_OF(kiriSheetData, pinReactions),
    KIRI_ROOM_OF(kiriSheetData, clampReactions),
    KIRI_ROOM_OF(kiriSheetData, frameReactions),
    KIRI_DROPPED(kiriSheetData, line),
    KIRI_DROPPED(kiriSheetData, lineShares),
    KIRI_PART(kiriSheetData, touches, TouchesTable),
    KIRI_BOOLS(kiriSheetData, rest, rest),
    KIRI_RUN(4, kiriSheetData, turns, turns),
    KIRI_DROPPED(kiriSheetData, seen),
    KIRI_DROPPED(kiriSheetData, lists),
    KIRI_DROPPED(kiriSheetData, probes),
    KIRI_DROPPED(kiriSheetData, past),
    KIRI_DROPPED(kiriSheetData, pastRoom),
};
static const kiriTable LiveSheetTable = KIRI_TABLE(kiriSheetData, LiveSheetMembers);

/* ---- Both directions --------------------------------------------------------------------------------------------- */

/* What saves derive from the mesh and the frames, and the work on a cut. */
static void ArchiveDerived(kiriArchive* archive, kiriSheetData* sheet)
{
    kiriArchive_Object(archive, &kiriGridTable, &sheet->grid);
    kiriArchive_Object(archive, &kiriRegionsTable, &sheet->regions);
    kiriArchive_Object(archive, &kiriShapeTable, &sheet->shape);
    kiriArchive_Object(archive, &kiriLinksTable, &sheet->links);
    kiriArchive_Object(archive, &UpdateTable, sheet->update);
    kiriArchive_Object(archive, &kiriSkinTable, &sheet->vertexSkin);
    kiriArchive_Object(archive, &kiriSkinTable, &sheet->pointSkin);
    kiriArchive_Object(archive, &kiriPlacesTable, &sheet->pointPlaces);
    archive->memory = &sheet->shown;
    kiriArchive_Object(archive, &kiriRestSurfaceTable, &sheet->seen.surface);
    archive->memory = &sheet->own;
    if (kiriArchive_Reads(archive) && !kiriArchive_HasFailed(archive)) {
        kiriPlacer_EndReading(&sheet->update->placing.placer, &sheet->regions.field);
    }
}

static void ArchiveStill(kiriArchive* archive, kiriSheetData* sheet)
{
    bool reads = kiriArchive_Reads(archive);
    archive->memory = &sheet->own;
    kiriArchive_Object(archive, &StillSheetTable, sheet);
    archive->memory = &sheet->shown;
    kiriArchive_Object(archive, &kiriStillSurfaceTable, &sheet->seen.surface);
    archive->memory = &sheet->own;
    kiriArchive_Expect(archive, sheet->update != NULL);
    if (reads && !kiriArchive_HasFailed(archive)) {
        kiriMesh_EndReading(&sheet->mesh, &sheet->own);
    }
}

static void MoveQueue(kiriArchive* archive, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->queue.count && !kiriArchive_HasFailed(archive); ++i) {
        kiriQueuedPoint* point = &sheet->queue.data[i];
        int32_t cut = kiriArchive_Count(archive, point->cut != NULL ? point->cut->index : 0, 0, sheet->cuts.count - 1);
        kiriArchive_Object(archive, &QueuedPointTable, point);
        if (kiriArchive_Reads(archive) && cut < sheet->cuts.count) {
            point->cut = sheet->cuts.data[cut];
        }
    }
}

static void MoveCuts(kiriArchive* archive, kiriSheetData* sheet)
{
    for (int32_t i = 0; i < sheet->cuts.count && !kiriArchive_HasFailed(archive); ++i) {
        if (kiriArchive_Reads(archive)) {
            sheet->cuts.data[i] = kiriMemory_AllocZeroed(archive->memory, sizeof(kiriCutData));
            archive->isShort |= sheet->cuts.data[i] == NULL;
        }
        if (sheet->cuts.data[i] != NULL) {
            kiriArchive_Object(archive, &CutDataTable, sheet->cuts.data[i]);
            kiriArchive_Expect(archive, sheet->cuts.data[i]->index == i);
            sheet->cuts.data[i]->sheet = sheet;
        }
    }
}

/* Vertices and normals are what patches, fades and triangles make of them, but when weights, or what is seen, have
   changed since they were written. */
static bool AreWeightsSeen(const kiriSheetData* sheet)
{
    const kiriSurface* surface = &sheet->seen.surface;
    return !sheet->seen.isElsewhere && surface->isSteady &&
           surface->patches.count == kiriLabels_Count(&sheet->shape.labels, sheet->frames.count) &&
           surface->vertexCount == sheet->seen.vertexCount && surface->vertexCount == sheet->mesh.vertices.count;
}

static void MoveVertices(kiriArchive* archive, kiriSheetData* sheet)
{
    kiriSurface* surface = &sheet->seen.surface;
    bool areSeen = AreWeightsSeen(sheet);
    kiriArchive_Expect(archive, kiriSurface_HasRoom(surface));
    kiriArchive_Expect(archive, kiriArchive_Count(archive, areSeen, 0, 1) == areSeen);
    if (!areSeen && !kiriArchive_HasFailed(archive)) {
        kiriArchive_Numbers(archive, kiriSurface_Places(surface), 4, 3 * (int64_t)surface->vertexCount);
        kiriArchive_Numbers(archive, surface->normals.data, 4, surface->normals.count);
    }
}

static void MovePoints(kiriArchive* archive, kiriSheetData* sheet)
{
    kiriArchive_Numbers(archive, sheet->seen.exactPoints.data, 8, 3 * (int64_t)sheet->seen.exactPoints.count);
    kiriArchive_Numbers(archive, sheet->seen.pointPositions.data, 4, sheet->seen.pointPositions.count);
}

static void MoveSeen(kiriArchive* archive, kiriSheetData* sheet)
{
    archive->memory = &sheet->own;
    kiriArchive_Object(archive, &SeenTable, &sheet->seen);
    archive->memory = &sheet->shown;
    kiriArchive_Object(archive, &ShownPointsTable, &sheet->seen);
    kiriArchive_Object(archive, &ToldTable, &sheet->touches);
    kiriArchive_Object(archive, &kiriLiveSurfaceTable, &sheet->seen.surface);
    archive->memory = &sheet->own;
    if (!archive->isWhole && !kiriArchive_HasFailed(archive)) {
        MoveVertices(archive, sheet);
        MovePoints(archive, sheet);
    }
}

static void MoveBounds(kiriArchive* archive, kiriBounds* bounds)
{
    int32_t isThere = kiriArchive_Count(archive, bounds->levelCount > 0, 0, 1);
    kiriArchive_Int32(archive, &bounds->asked);
    kiriArchive_Int32(archive, &bounds->patience);
    kiriArchive_Expect(archive, bounds->patience >= 0 && bounds->patience <= KIRI_BOUNDS_PATIENCE);
    bounds->levelCount = isThere && kiriArchive_Reads(archive) ? 1 : bounds->levelCount;
}

static void MoveProbes(kiriArchive* archive, kiriSheetData* sheet)
{
    kiriArchive_Object(archive, &ProbesTable, &sheet->probes);
    if (sheet->probes.isFresh && sheet->rest.asleep) {
        kiriArchive_Object(archive, &ProbeSpeedsTable, &sheet->probes);
    }
}

void kiriSheet_ArchiveLive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory)
{
    archive->memory = &sheet->own;
    kiriArchive_Object(archive, &LiveSheetTable, sheet);
    kiriSolver_Archive(archive, &sheet->solver, &sheet->settings.mechanics);
    if (!kiriArchive_HasFailed(archive)) {
        MoveSeen(archive, sheet);
        MoveBounds(archive, sheet->seen.bounds);
        MoveProbes(archive, sheet);
    }
    if (archive->isWhole && !kiriArchive_HasFailed(archive)) {
        ArchiveDerived(archive, sheet);
    }
    archive->memory = memory;
    kiriArchive_Object(archive, &QueueTable, sheet);
    MoveCuts(archive, sheet);
    MoveQueue(archive, sheet);
}

void kiriSheet_Archive(kiriArchive* archive, kiriSheetData* sheet, kiriMemory* memory)
{
    ArchiveStill(archive, sheet);
    if (!kiriArchive_HasFailed(archive)) {
        kiriSheet_ArchiveLive(archive, sheet, memory);
    }
}

void kiriSheet_HashLayout(uint64_t* hash)
{
    const kiriTable* tables[] = {
        &StillSheetTable, &LiveSheetTable,   &kiriStillSurfaceTable, &kiriLiveSurfaceTable, &SeenTable,
        &ToldTable,       &kiriGridTable,    &kiriRegionsTable,      &kiriShapeTable,       &kiriLinksTable,
        &UpdateTable,     &kiriSkinTable,    &kiriPlacesTable,       &kiriRestSurfaceTable, &ProbesTable,
        &CutDataTable,    &QueuedPointTable,
    };
    for (size_t k = 0; k < sizeof(tables) / sizeof(tables[0]); ++k) {
        kiriArchive_HashLayout(tables[k], hash);
    }
}

/* What array `from` has goes to `to`, which has as many items or was empty. */
static void TakeSpeeds(void* to, const void* from, size_t itemBytes)
{
    kiriArrayHeader old = kiriArray_GetHeader(from), fresh = kiriArray_GetHeader(to);
    if (old.count == fresh.count && old.count > 0) {
        memcpy(fresh.data, old.data, itemBytes * (size_t)old.count);
    }
}

static bool RemakeProbes(kiriSheetData* sheet)
{
    kiriProbes read = sheet->probes;
    if (!read.isFresh) {
        return true;
    }
    memset(&sheet->probes, 0, sizeof(sheet->probes));
    sheet->probes.block = read.block > 0 ? read.block : 1;
    sheet->probes.isFresh = true;
    bool ok = kiriProbes_Remake(sheet);
    if (ok) {
        TakeSpeeds(&sheet->probes.velocities, &read.velocities, sizeof(kiriVec3));
        TakeSpeeds(&sheet->probes.speeds, &read.speeds, sizeof(double));
    }
    kiriArray_Release(sheet->memory, &read.velocities);
    kiriArray_Release(sheet->memory, &read.speeds);
    return ok;
}

/* Boxes, normals and probes are made anew where they were there. */
bool kiriSheet_EndReading(kiriSheetData* sheet, bool isWhole)
{
    kiriSurface* surface = &sheet->seen.surface;
    bool hasNormals = surface->hasNormals, isKept = isWhole || !AreWeightsSeen(sheet),
         hasBounds = sheet->seen.bounds->levelCount > 0;
    if (!isKept) {
        kiriSurface_BlendRange(surface, &sheet->vertexSkin, 0, surface->vertexCount);
        kiriSurface_AddFades(surface, &sheet->seen.fades);
    }
    surface->hasNormals = false;
    if (!isWhole) {
        kiriSurface_WriteRange(surface, 0, surface->vertexCount);
    }
    if (hasNormals && !isKept) {
        kiriSurface_NeedNormals(surface);
    }
    surface->hasNormals = hasNormals;
    int32_t patience = sheet->seen.bounds->patience;
    sheet->seen.bounds->levelCount = 0;
    bool ok = !hasBounds || kiriBounds_Update(sheet->seen.bounds, sheet->memory, surface);
    sheet->seen.bounds->patience = patience;
    ok = ok && kiriSheet_RestageSolver(sheet, &sheet->settings.material) &&
         kiriSolver_ReserveRows(sheet->solver, sheet->pins.count + 2 * (int64_t)sheet->layout.pinShares.count,
                                sheet->layout.pinShares.count, 0);
    kiriSolver_Commit(sheet->solver);
    return ok && RemakeProbes(sheet);
}
