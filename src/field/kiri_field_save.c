#include "kiri_field_save.h"

#include "kiri_grid.h"
#include "kiri_link.h"
#include "kiri_site.h"
#include "kiri_shape.h"

#include <string.h>

static const kiriMember SiteMembers[] = {
    KIRI_RUN(8, kiriSite, at, at),
    KIRI_RUN(4, kiriSite, cell, cell),
};
const kiriTable kiriSiteTable = KIRI_TABLE(kiriSite, SiteMembers);

static const kiriMember FieldMembers[] = {
    KIRI_ITEMS(4, kiriField, distance), KIRI_ITEMS(4, kiriField, owner),        KIRI_ITEMS(4, kiriField, settled),
    KIRI_ITEMS(4, kiriField, log),      KIRI_ITEMS(4, kiriField, heap),         KIRI_ITEMS(4, kiriField, dirty),
    KIRI_ITEMS(1, kiriField, marks),    KIRI_RUN(4, kiriField, cursor, stage),
};
static const kiriTable FieldTable = KIRI_TABLE(kiriField, FieldMembers);

static const kiriMember NewCellMembers[] = {
    KIRI_RUN(4, kiriNewCell, triangle, cell),
    KIRI_RUN(8, kiriNewCell, material, material),
};
static const kiriTable NewCellTable = KIRI_TABLE(kiriNewCell, NewCellMembers);

static const kiriMember OldFaceMembers[] = {
    KIRI_RUN(4, kiriOldFace, face, face),
    KIRI_RUN(8, kiriOldFace, was, was),
};
static const kiriTable OldFaceTable = KIRI_TABLE(kiriOldFace, OldFaceMembers);

static const kiriMember StepMembers[] = {
    KIRI_RUN(4, kiriStep, cell, cell),
    KIRI_RUN(2, kiriStep, length, length),
    KIRI_RUN(1, kiriStep, u, v),
};
static const kiriTable StepTable = KIRI_TABLE(kiriStep, StepMembers);

static const kiriMember GridWorkMembers[] = {
    KIRI_BOOLS(kiriGridWork, running, outOfMemory),
    KIRI_RUN(8, kiriGridWork, debt, debt),
    KIRI_RUN(4, kiriGridWork, stage, item),
    KIRI_ITEMS(4, kiriGridWork, facesDirty),
    KIRI_ITEMS(4, kiriGridWork, linksDirty),
    KIRI_ITEMS(4, kiriGridWork, stepsDirty),
    KIRI_ITEMS(4, kiriGridWork, knightsDirty),
    KIRI_ITEMS(1, kiriGridWork, squareFlags),
    KIRI_ITEMS(4, kiriGridWork, flagged),
    KIRI_ITEMS(4, kiriGridWork, ranges),
    KIRI_ITEMS(4, kiriGridWork, entries),
    KIRI_ITEMS(4, kiriGridWork, parent),
    KIRI_ITEMS(1, kiriGridWork, cellFlags),
    KIRI_ITEMS(4, kiriGridWork, mark),
    KIRI_RUN(4, kiriGridWork, lastMark, lastMark),
    KIRI_PARTS(kiriGridWork, newCells, NewCellTable),
    KIRI_PARTS(kiriGridWork, oldFaces, OldFaceTable),
    KIRI_PARTS(kiriGridWork, steps, StepTable),
};
static const kiriTable GridWorkTable = KIRI_TABLE(kiriGridWork, GridWorkMembers);

static const kiriMember MaterialChangeMembers[] = {
    KIRI_RUN(4, kiriMaterialChange, cell, cell),
    KIRI_RUN(8, kiriMaterialChange, was, was),
};
static const kiriTable MaterialChangeTable = KIRI_TABLE(kiriMaterialChange, MaterialChangeMembers);

static const kiriMember GridChangesMembers[] = {
    KIRI_ITEMS(4, kiriGridChanges, made),  KIRI_ITEMS(4, kiriGridChanges, gone),
    KIRI_ITEMS(4, kiriGridChanges, steps), KIRI_PARTS(kiriGridChanges, material, MaterialChangeTable),
    KIRI_ITEMS(4, kiriGridChanges, edges),
};
static const kiriTable GridChangesTable = KIRI_TABLE(kiriGridChanges, GridChangesMembers);

static const kiriMember GridMembers[] = {
    KIRI_RUN(8, kiriGrid, side, side),
    KIRI_ITEMS(4, kiriGrid, cells),
    KIRI_ITEMS(4, kiriGrid, runs),
    KIRI_PARTS(kiriGrid, steps, StepTable),
    KIRI_RUN(4, kiriGrid, stepRoom, openTo),
    KIRI_ITEMS(4, kiriGrid, faces),
    KIRI_ITEMS(8, kiriGrid, materials),
    KIRI_ITEMS(8, kiriGrid, stretches),
    KIRI_ITEMS(4, kiriGrid, unusedMaterials),
    KIRI_ITEMS(4, kiriGrid, unusedStretches),
    KIRI_ITEMS(4, kiriGrid, squareCell),
    KIRI_ITEMS(4, kiriGrid, nodeCell),
    KIRI_ITEMS(4, kiriGrid, vertexCell),
    KIRI_ITEMS(1, kiriGrid, whole),
    KIRI_RUN(4, kiriGrid, cellCount, freeFace),
    KIRI_PART(kiriGrid, changes, GridChangesTable),
    KIRI_OWNED(kiriGrid, work, GridWorkTable),
};
const kiriTable kiriGridTable = KIRI_TABLE(kiriGrid, GridMembers);

static const kiriMember BorderCellsMembers[] = {
    KIRI_ITEMS(4, kiriBorderCells, first),
    KIRI_ITEMS(4, kiriBorderCells, cells),
};
static const kiriTable BorderCellsTable = KIRI_TABLE(kiriBorderCells, BorderCellsMembers);

static const kiriMember RegionsMembers[] = {
    KIRI_PART(kiriRegions, field, FieldTable),    KIRI_ITEMS(4, kiriRegions, siteAt),
    KIRI_ITEMS(1, kiriRegions, onBorder),         KIRI_PART(kiriRegions, border, BorderCellsTable),
    KIRI_ITEMS(8, kiriRegions, material),         KIRI_ITEMS(4, kiriRegions, changes),
    KIRI_ITEMS(4, kiriRegions, orphans),          KIRI_BOOLS(kiriRegions, running, following),
    KIRI_RUN(4, kiriRegions, followed, followed), KIRI_ITEMS(1, kiriRegions, isChanged),
    KIRI_RUN(4, kiriRegions, seen, seen),
};
const kiriTable kiriRegionsTable = KIRI_TABLE(kiriRegions, RegionsMembers);

static const kiriMember SavedRegionsMembers[] = {
    KIRI_ITEMS(1, kiriRegions, dirty),
};
const kiriTable kiriSavedRegionsTable = KIRI_TABLE(kiriRegions, SavedRegionsMembers);

static const kiriMember ShapeFrameMembers[] = {
    KIRI_RUN(4, kiriShapeFrame, limit, firstTouch),
    KIRI_BOOLS(kiriShapeFrame, moved, dirty),
};
static const kiriTable ShapeFrameTable = KIRI_TABLE(kiriShapeFrame, ShapeFrameMembers);

static const kiriMember ShapeWorkMembers[] = {
    KIRI_PART(kiriShapeWork, fromSite, FieldTable),
    KIRI_PART(kiriShapeWork, fromBorder, FieldTable),
    KIRI_ITEMS(4, kiriShapeWork, seeds),
    KIRI_ITEMS(4, kiriShapeWork, loaded),
    KIRI_ITEMS(1, kiriShapeWork, isLoaded),
    KIRI_ITEMS(1, kiriShapeWork, marks),
    KIRI_ITEMS(4, kiriShapeWork, wasOwner),
    KIRI_ITEMS(8, kiriShapeWork, rigidShares),
    KIRI_ITEMS(4, kiriShapeWork, counted),
    KIRI_ITEMS(4, kiriShapeWork, sideCounts),
    KIRI_RUN(4, kiriShapeWork, sideRoom, sideRoom),
    KIRI_PARTS(kiriShapeWork, frames, ShapeFrameTable),
    KIRI_ITEMS(4, kiriShapeWork, dirtyFrames),
    KIRI_ITEMS(4, kiriShapeWork, touches),
    KIRI_ITEMS(4, kiriShapeWork, dirty),
    KIRI_ITEMS(4, kiriShapeWork, weights),
    KIRI_BOOLS(kiriShapeWork, running, isMeasuring),
    KIRI_RUN(4, kiriShapeWork, stage, item),
    KIRI_RUN(8, kiriShapeWork, debt, debt),
};
static const kiriTable ShapeWorkTable = KIRI_TABLE(kiriShapeWork, ShapeWorkMembers);

static const kiriMember LabelsMembers[] = {
    KIRI_ITEMS(4, kiriLabels, itemOf),
    KIRI_ITEMS(4, kiriLabels, labelOf),
};
static const kiriTable LabelsTable = KIRI_TABLE(kiriLabels, LabelsMembers);

static const kiriMember ReachesMembers[] = {
    KIRI_ITEMS(4, kiriReaches, blocks),
    KIRI_ITEMS(4, kiriReaches, heads),
    KIRI_ITEMS(4, kiriReaches, ofCells),
    KIRI_ITEMS(4, kiriReaches, ofLabel),
    KIRI_RUN(4, kiriReaches, freeBlocks, freeBlock),
};
static const kiriTable ReachesTable = KIRI_TABLE(kiriReaches, ReachesMembers);

static const kiriMember ShapeMembers[] = {
    KIRI_ITEMS(4, kiriShape, spans),
    KIRI_ITEMS(4, kiriShape, weights),
    KIRI_RUN(4, kiriShape, room, room),
    KIRI_PART(kiriShape, reaches, ReachesTable),
    KIRI_ITEMS(8, kiriShape, rigid),
    KIRI_ITEMS(4, kiriShape, changes),
    KIRI_RUN(8, kiriShape, recomputed, recomputed),
    KIRI_OWNED(kiriShape, work, ShapeWorkTable),
};
const kiriTable kiriShapeTable = KIRI_TABLE(kiriShape, ShapeMembers);

static const kiriMember SavedShapeMembers[] = {
    KIRI_PART(kiriShape, labels, LabelsTable),
    KIRI_RUN(8, kiriShape, rigidWeight, rigidWeight),
    KIRI_BOOLS(kiriShape, eased, eased),
};
const kiriTable kiriSavedShapeTable = KIRI_TABLE(kiriShape, SavedShapeMembers);

static const kiriMember LinkMembers[] = {
    KIRI_RUN(4, kiriLink, i, j),
    KIRI_RUN(8, kiriLink, width, spread),
};
static const kiriTable LinkTable = KIRI_TABLE(kiriLink, LinkMembers);

static const kiriMember LinkEndMembers[] = {
    KIRI_RUN(4, kiriLinkEnd, kind, cell),
    KIRI_RUN(8, kiriLinkEnd, at, look),
    KIRI_BOOLS(kiriLinkEnd, isExact, isSeen),
};
static const kiriTable LinkEndTable = KIRI_TABLE(kiriLinkEnd, LinkEndMembers);

static const kiriMember LinkEndsMembers[] = {
    KIRI_PART(kiriLinkEnds, end, LinkEndTable),
    KIRI_BOOLS(kiriLinkEnds, isShort, isShort),
};
static const kiriTable LinkEndsTable = KIRI_TABLE(kiriLinkEnds, LinkEndsMembers);

static const kiriMember NewLinkMembers[] = {
    KIRI_PART(kiriNewLink, link, LinkTable),
    KIRI_PART(kiriNewLink, ends, LinkEndsTable),
    KIRI_RUN(4, kiriNewLink, face, face),
};
static const kiriTable NewLinkTable = KIRI_TABLE(kiriNewLink, NewLinkMembers);

static const kiriMember SightEdgeMembers[] = {
    KIRI_RUN(8, kiriSightEdge, tail, after),
    KIRI_RUN(4, kiriSightEdge, edge, cell),
    KIRI_BOOLS(kiriSightEdge, isTurn, isTurn),
};
static const kiriTable SightEdgeTable = KIRI_TABLE(kiriSightEdge, SightEdgeMembers);

static const kiriMember SightEdgesMembers[] = {
    KIRI_PARTS(kiriSightEdges, edges, SightEdgeTable),
    KIRI_ITEMS(4, kiriSightEdges, squares),
    KIRI_ITEMS(4, kiriSightEdges, spans),
    KIRI_ITEMS(4, kiriSightEdges, listed),
    KIRI_BOOLS(kiriSightEdges, failed, failed),
};
static const kiriTable SightEdgesTable = KIRI_TABLE(kiriSightEdges, SightEdgesMembers);

static const kiriMember LinkWorkMembers[] = {
    KIRI_BOOLS(kiriLinkWork, running, running),
    KIRI_RUN(4, kiriLinkWork, at, at),
    KIRI_RUN(8, kiriLinkWork, due, due),
    KIRI_ITEMS(1, kiriLinkWork, marks),
    KIRI_ITEMS(1, kiriLinkWork, stale),
    KIRI_ITEMS(4, kiriLinkWork, faces),
    KIRI_PARTS(kiriLinkWork, made, NewLinkTable),
    KIRI_ITEMS(4, kiriLinkWork, to),
    KIRI_PARTS(kiriLinkWork, ends, LinkEndsTable),
    KIRI_PARTS(kiriLinkWork, nextEnds, LinkEndsTable),
    KIRI_PART(kiriLinkWork, edges, SightEdgesTable),
    KIRI_ROOM_OF(kiriLinkWork, order),
    KIRI_ROOM_OF(kiriLinkWork, stretch),
};
static const kiriTable LinkWorkTable = KIRI_TABLE(kiriLinkWork, LinkWorkMembers);

static const kiriMember CornerMembers[] = {
    KIRI_RUN(4, kiriCorner, count, unused),
    KIRI_RUN(8, kiriCorner, weight, area),
};
static const kiriTable CornerTable = KIRI_TABLE(kiriCorner, CornerMembers);

static const kiriMember LinksMembers[] = {
    KIRI_PARTS(kiriLinks, links, LinkTable),     KIRI_PARTS(kiriLinks, next, LinkTable),
    KIRI_RUN(4, kiriLinks, changed, changed),    KIRI_ROOM_OF(kiriLinks, was),
    KIRI_PARTS(kiriLinks, corners, CornerTable), KIRI_PARTS(kiriLinks, nextCorners, CornerTable),
    KIRI_OWNED(kiriLinks, work, LinkWorkTable),
};
const kiriTable kiriLinksTable = KIRI_TABLE(kiriLinks, LinksMembers);

static const kiriMember SlitEndMembers[] = {
    KIRI_RUN(8, kiriSlitEnd, at, along),
    KIRI_RUN(4, kiriSlitEnd, cell, cell),
};
static const kiriTable SlitEndTable = KIRI_TABLE(kiriSlitEnd, SlitEndMembers);

/* Its own, or the caller's: that one follows. */
static void MoveOldField(kiriArchive* archive, void* object)
{
    kiriPlacerWork* work = object;
    if (kiriArchive_Count(archive, work->old == &work->flooded, 0, 1) == 1 && kiriArchive_Reads(archive)) {
        work->old = &work->flooded;
    }
}

static const kiriMember SiteTargetMembers[] = {
    KIRI_RUN(8, SiteTarget, area, center),
    KIRI_RUN(4, SiteTarget, cell, cell),
    KIRI_BOOLS(SiteTarget, isFound, isFound),
    KIRI_RUN(8, SiteTarget, distance, distance),
};
static const kiriTable SiteTargetTable = KIRI_TABLE(SiteTarget, SiteTargetMembers);

static const kiriMember SampleBlockMembers[] = {
    KIRI_RUN(8, SampleBlock, distance, distance),
    KIRI_RUN(4, SampleBlock, cell, seen),
    KIRI_BOOLS(SampleBlock, isCovered, isCovered),
};
static const kiriTable SampleBlockTable = KIRI_TABLE(SampleBlock, SampleBlockMembers);

static const kiriMember PlacerWorkMembers[] = {
    KIRI_BOOLS(kiriPlacerWork, hasOld, hasOld),
    KIRI_CUSTOM(kiriPlacerWork, old, MoveOldField),
    KIRI_PART(kiriPlacerWork, flooded, FieldTable),
    KIRI_PART(kiriPlacerWork, ends, FieldTable),
    KIRI_RUN(8, kiriPlacerWork, reach, reach),
    KIRI_RUN(4, kiriPlacerWork, closest, closest),
    KIRI_PART(kiriPlacerWork, fresh, FieldTable),
    KIRI_ITEMS(4, kiriPlacerWork, sampled),
    KIRI_ITEMS(4, kiriPlacerWork, holds),
    KIRI_ITEMS(1, kiriPlacerWork, marks),
    KIRI_BOOLS(kiriPlacerWork, isTaking, isTaking),
    KIRI_PARTS(kiriPlacerWork, targets, SiteTargetTable),
    KIRI_PARTS(kiriPlacerWork, blocks, SampleBlockTable),
    KIRI_ITEMS(4, kiriPlacerWork, seeds),
    KIRI_RUN(4, kiriPlacerWork, stage, cursor),
    KIRI_RUN(8, kiriPlacerWork, due, due),
    KIRI_RUN(4, kiriPlacerWork, left, round),
    KIRI_DROPPED(kiriPlacerWork, winds),
};
static const kiriTable PlacerWorkTable = KIRI_TABLE(kiriPlacerWork, PlacerWorkMembers);

static const kiriMember PlacerMembers[] = {
    KIRI_PARTS(kiriPlacer, sites, kiriSiteTable),
    KIRI_RUN(4, kiriPlacer, oldCount, oldCount),
    KIRI_ITEMS(4, kiriPlacer, cells),
    KIRI_DROPPED(kiriPlacer, known),
    KIRI_PARTS(kiriPlacer, ends, SlitEndTable),
    KIRI_RUN(8, kiriPlacer, reach, closeness),
    KIRI_OWNED(kiriPlacer, work, PlacerWorkTable),
};
const kiriTable kiriPlacerTable = KIRI_TABLE(kiriPlacer, PlacerMembers);

void kiriPlacer_EndReading(kiriPlacer* placer, const kiriField* known)
{
    if (placer->work != NULL && placer->work->hasOld && placer->work->old == NULL) {
        placer->work->old = known;
    }
}
