#include "kiri_field_save.h"

#include "kiri_grid_work.h"
#include "kiri_link_work.h"
#include "kiri_place_work.h"
#include "kiri_shape_work.h"

static const kiriMember SiteMembers[] = {
    KIRI_RUN(8, kiriSite, at, at),
    KIRI_RUN(4, kiriSite, cell, cell),
};
const kiriRecord kiriSiteRecord = KIRI_RECORD(kiriSite, SiteMembers);

static const kiriMember FieldMembers[] = {
    KIRI_ITEMS(4, kiriField, distance), KIRI_ITEMS(4, kiriField, owner),        KIRI_ITEMS(4, kiriField, settled),
    KIRI_ITEMS(4, kiriField, log),      KIRI_ITEMS(4, kiriField, heap),         KIRI_ITEMS(4, kiriField, dirty),
    KIRI_ITEMS(1, kiriField, marks),    KIRI_RUN(4, kiriField, cursor, cursor),
};
const kiriRecord kiriFieldRecord = KIRI_RECORD(kiriField, FieldMembers);

static const kiriMember NewCellMembers[] = {
    KIRI_RUN(4, kiriNewCell, triangle, cell),
    KIRI_RUN(8, kiriNewCell, material, material),
};
static const kiriRecord NewCellRecord = KIRI_RECORD(kiriNewCell, NewCellMembers);

static const kiriMember FaceMembers[] = {
    KIRI_RUN(4, kiriFace, cell, axis),
    KIRI_RUN(8, kiriFace, width, moment),
};
static const kiriRecord FaceRecord = KIRI_RECORD(kiriFace, FaceMembers);

static const kiriMember OldFaceMembers[] = {
    KIRI_RUN(4, kiriOldFace, face, face),
    KIRI_PART(kiriOldFace, was, FaceRecord),
};
static const kiriRecord OldFaceRecord = KIRI_RECORD(kiriOldFace, OldFaceMembers);

static const kiriMember StepMembers[] = {
    KIRI_RUN(4, kiriStep, cell, cell),
    KIRI_RUN(2, kiriStep, length, length),
    KIRI_RUN(1, kiriStep, u, v),
};
static const kiriRecord StepRecord = KIRI_RECORD(kiriStep, StepMembers);

static const kiriMember GridWorkMembers[] = {
    KIRI_DROPPED(kiriGridWork, growing),
    KIRI_BOOLS(kiriGridWork, running, removed),
    KIRI_RUN(8, kiriGridWork, due, due),
    KIRI_RUN(4, kiriGridWork, stage, part),
    KIRI_BOOLS(kiriGridWork, isAmidPart, isAmidPart),
    KIRI_RUN(4, kiriGridWork, node, other),
    KIRI_BOOLS(kiriGridWork, isSame, isSorting),
    KIRI_RUN(4, kiriGridWork, sorting, sorting),
    KIRI_ITEMS(4, kiriGridWork, sortRoom),
    KIRI_BOOLS(kiriGridWork, isMerging, isMerging),
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
    KIRI_ITEMS(8, kiriGridWork, mark),
    KIRI_RUN(8, kiriGridWork, lastMark, lastMark),
    KIRI_PARTS(kiriGridWork, newCells, NewCellRecord),
    KIRI_PARTS(kiriGridWork, oldFaces, OldFaceRecord),
    KIRI_PARTS(kiriGridWork, steps, StepRecord),
};
static const kiriRecord GridWorkRecord = KIRI_RECORD(kiriGridWork, GridWorkMembers);

static const kiriMember CellMembers[] = {
    KIRI_RUN(4, kiriCell, square, firstFace),
    KIRI_RUN(8, kiriCell, material, material),
};
static const kiriRecord CellRecord = KIRI_RECORD(kiriCell, CellMembers);

static const kiriMember MaterialChangeMembers[] = {
    KIRI_RUN(4, kiriMaterialChange, cell, cell),
    KIRI_RUN(8, kiriMaterialChange, was, was),
};
static const kiriRecord MaterialChangeRecord = KIRI_RECORD(kiriMaterialChange, MaterialChangeMembers);

static const kiriMember GridChangesMembers[] = {
    KIRI_ITEMS(4, kiriGridChanges, made),  KIRI_ITEMS(4, kiriGridChanges, gone),
    KIRI_ITEMS(4, kiriGridChanges, steps), KIRI_PARTS(kiriGridChanges, material, MaterialChangeRecord),
    KIRI_ITEMS(4, kiriGridChanges, edges),
};
static const kiriRecord GridChangesRecord = KIRI_RECORD(kiriGridChanges, GridChangesMembers);

static const kiriMember GridMembers[] = {
    KIRI_RUN(8, kiriGrid, side, side),
    KIRI_PARTS(kiriGrid, cells, CellRecord),
    KIRI_ITEMS(4, kiriGrid, runs),
    KIRI_PARTS(kiriGrid, steps, StepRecord),
    KIRI_RUN(4, kiriGrid, stepRoom, openTo),
    KIRI_PARTS(kiriGrid, faces, FaceRecord),
    KIRI_ITEMS(4, kiriGrid, squareCell),
    KIRI_ITEMS(4, kiriGrid, nodeCell),
    KIRI_ITEMS(4, kiriGrid, vertexCell),
    KIRI_ITEMS(1, kiriGrid, whole),
    KIRI_RUN(4, kiriGrid, cellCount, freeFace),
    KIRI_PART(kiriGrid, changes, GridChangesRecord),
    KIRI_OWNED(kiriGrid, work, GridWorkRecord),
};
const kiriRecord kiriGridRecord = KIRI_RECORD(kiriGrid, GridMembers);

static const kiriMember BorderCellsMembers[] = {
    KIRI_ITEMS(4, kiriBorderCells, first),
    KIRI_ITEMS(4, kiriBorderCells, cells),
};
static const kiriRecord BorderCellsRecord = KIRI_RECORD(kiriBorderCells, BorderCellsMembers);

static const kiriMember RegionsMembers[] = {
    KIRI_PART(kiriRegions, field, kiriFieldRecord),
    KIRI_ITEMS(4, kiriRegions, siteAt),
    KIRI_ITEMS(1, kiriRegions, onBorder),
    KIRI_PART(kiriRegions, border, BorderCellsRecord),
    KIRI_ITEMS(8, kiriRegions, material),
    KIRI_ITEMS(1, kiriRegions, dirty),
    KIRI_ITEMS(4, kiriRegions, changes),
    KIRI_ITEMS(4, kiriRegions, orphans),
    KIRI_BOOLS(kiriRegions, running, following),
    KIRI_RUN(4, kiriRegions, followed, followed),
    KIRI_ITEMS(1, kiriRegions, isChanged),
    KIRI_RUN(4, kiriRegions, seen, seen),
};
const kiriRecord kiriRegionsRecord = KIRI_RECORD(kiriRegions, RegionsMembers);

static const kiriMember ShapeFrameMembers[] = {
    KIRI_RUN(4, kiriShapeFrame, limit, firstTouch),
    KIRI_BOOLS(kiriShapeFrame, moved, dirty),
};
static const kiriRecord ShapeFrameRecord = KIRI_RECORD(kiriShapeFrame, ShapeFrameMembers);

static const kiriMember RawWeightMembers[] = {
    KIRI_RUN(4, kiriRawWeight, cell, frame),
    KIRI_RUN(8, kiriRawWeight, raw, raw),
};
static const kiriRecord RawWeightRecord = KIRI_RECORD(kiriRawWeight, RawWeightMembers);

static const kiriMember ShapeWorkMembers[] = {
    KIRI_PART(kiriShapeWork, fromSite, kiriFieldRecord),
    KIRI_PART(kiriShapeWork, fromBorder, kiriFieldRecord),
    KIRI_ITEMS(4, kiriShapeWork, seeds),
    KIRI_RUN(4, kiriShapeWork, frameStage, frameStage),
    KIRI_ITEMS(4, kiriShapeWork, loaded),
    KIRI_ITEMS(1, kiriShapeWork, isLoaded),
    KIRI_ITEMS(1, kiriShapeWork, marks),
    KIRI_ITEMS(4, kiriShapeWork, wasOwner),
    KIRI_ITEMS(4, kiriShapeWork, awaited),
    KIRI_ITEMS(8, kiriShapeWork, rigidShares),
    KIRI_ITEMS(4, kiriShapeWork, counted),
    KIRI_ITEMS(4, kiriShapeWork, sideCounts),
    KIRI_RUN(4, kiriShapeWork, sideRoom, sideRoom),
    KIRI_PARTS(kiriShapeWork, frames, ShapeFrameRecord),
    KIRI_ITEMS(4, kiriShapeWork, dirtyFrames),
    KIRI_ITEMS(4, kiriShapeWork, touches),
    KIRI_PARTS(kiriShapeWork, rawWeights, RawWeightRecord),
    KIRI_ITEMS(4, kiriShapeWork, dirty),
    KIRI_RUN(4, kiriShapeWork, stage, next),
};
static const kiriRecord ShapeWorkRecord = KIRI_RECORD(kiriShapeWork, ShapeWorkMembers);

static const kiriMember CellWeightMembers[] = {
    KIRI_RUN(4, kiriCellWeight, frame, frame),
    KIRI_RUN(8, kiriCellWeight, value, raw),
};
static const kiriRecord CellWeightRecord = KIRI_RECORD(kiriCellWeight, CellWeightMembers);

static const kiriMember ReachesMembers[] = {
    KIRI_ITEMS(4, kiriReaches, blocks),
    KIRI_ITEMS(4, kiriReaches, ofCells),
    KIRI_ITEMS(4, kiriReaches, ofFrame),
    KIRI_RUN(4, kiriReaches, freeBlocks, freeBlock),
};
static const kiriRecord ReachesRecord = KIRI_RECORD(kiriReaches, ReachesMembers);

static const kiriMember ShapeMembers[] = {
    KIRI_ITEMS(4, kiriShape, spans),
    KIRI_PARTS(kiriShape, weights, CellWeightRecord),
    KIRI_RUN(4, kiriShape, room, room),
    KIRI_PART(kiriShape, reaches, ReachesRecord),
    KIRI_ITEMS(8, kiriShape, rigid),
    KIRI_RUN(8, kiriShape, rigidWeight, rigidWeight),
    KIRI_BOOLS(kiriShape, eased, eased),
    KIRI_ITEMS(4, kiriShape, changes),
    KIRI_RUN(8, kiriShape, recomputed, recomputed),
    KIRI_OWNED(kiriShape, work, ShapeWorkRecord),
};
const kiriRecord kiriShapeRecord = KIRI_RECORD(kiriShape, ShapeMembers);

static const kiriMember LinkMembers[] = {
    KIRI_RUN(4, kiriLink, i, j),
    KIRI_RUN(8, kiriLink, width, spread),
};
static const kiriRecord LinkRecord = KIRI_RECORD(kiriLink, LinkMembers);

static const kiriMember LinkEndMembers[] = {
    KIRI_RUN(4, kiriLinkEnd, kind, cell),
    KIRI_RUN(8, kiriLinkEnd, at, look),
    KIRI_BOOLS(kiriLinkEnd, isExact, isSeen),
};
static const kiriRecord LinkEndRecord = KIRI_RECORD(kiriLinkEnd, LinkEndMembers);

static const kiriMember LinkEndsMembers[] = {
    KIRI_PART(kiriLinkEnds, end, LinkEndRecord),
    KIRI_BOOLS(kiriLinkEnds, isShort, isShort),
};
static const kiriRecord LinkEndsRecord = KIRI_RECORD(kiriLinkEnds, LinkEndsMembers);

static const kiriMember NewLinkMembers[] = {
    KIRI_PART(kiriNewLink, link, LinkRecord),
    KIRI_PART(kiriNewLink, ends, LinkEndsRecord),
    KIRI_RUN(4, kiriNewLink, face, face),
    KIRI_BOOLS(kiriNewLink, isOld, isOld),
};
static const kiriRecord NewLinkRecord = KIRI_RECORD(kiriNewLink, NewLinkMembers);

static const kiriMember SightEdgeMembers[] = {
    KIRI_RUN(8, kiriSightEdge, tail, after),
    KIRI_RUN(4, kiriSightEdge, edge, cell),
    KIRI_BOOLS(kiriSightEdge, isTurn, isTurn),
};
static const kiriRecord SightEdgeRecord = KIRI_RECORD(kiriSightEdge, SightEdgeMembers);

static const kiriMember SightEdgesMembers[] = {
    KIRI_DROPPED(kiriSightEdges, memory),       KIRI_PARTS(kiriSightEdges, edges, SightEdgeRecord),
    KIRI_ITEMS(4, kiriSightEdges, spans),       KIRI_ITEMS(4, kiriSightEdges, squares),
    KIRI_BOOLS(kiriSightEdges, failed, failed),
};
static const kiriRecord SightEdgesRecord = KIRI_RECORD(kiriSightEdges, SightEdgesMembers);

static const kiriMember LinkWorkMembers[] = {
    KIRI_BOOLS(kiriLinkWork, running, running),
    KIRI_RUN(4, kiriLinkWork, at, at),
    KIRI_RUN(8, kiriLinkWork, due, due),
    KIRI_ITEMS(1, kiriLinkWork, marks),
    KIRI_ITEMS(1, kiriLinkWork, stale),
    KIRI_ITEMS(4, kiriLinkWork, touched),
    KIRI_ITEMS(4, kiriLinkWork, faces),
    KIRI_ITEMS(4, kiriLinkWork, whole),
    KIRI_ITEMS(4, kiriLinkWork, stretch),
    KIRI_PARTS(kiriLinkWork, made, NewLinkRecord),
    KIRI_ITEMS(4, kiriLinkWork, order),
    KIRI_PARTS(kiriLinkWork, ends, LinkEndsRecord),
    KIRI_PARTS(kiriLinkWork, nextEnds, LinkEndsRecord),
    KIRI_ITEMS(4, kiriLinkWork, was),
    KIRI_ITEMS(4, kiriLinkWork, now),
    KIRI_PART(kiriLinkWork, edges, SightEdgesRecord),
};
static const kiriRecord LinkWorkRecord = KIRI_RECORD(kiriLinkWork, LinkWorkMembers);

static const kiriMember CornerMembers[] = {
    KIRI_RUN(4, kiriCorner, count, unused),
    KIRI_RUN(8, kiriCorner, weight, area),
};
static const kiriRecord CornerRecord = KIRI_RECORD(kiriCorner, CornerMembers);

static const kiriMember LinksMembers[] = {
    KIRI_PARTS(kiriLinks, links, LinkRecord),         KIRI_PARTS(kiriLinks, next, LinkRecord),
    KIRI_RUN(4, kiriLinks, changed, changed),         KIRI_PARTS(kiriLinks, corners, CornerRecord),
    KIRI_PARTS(kiriLinks, nextCorners, CornerRecord), KIRI_OWNED(kiriLinks, work, LinkWorkRecord),
};
const kiriRecord kiriLinksRecord = KIRI_RECORD(kiriLinks, LinksMembers);

static const kiriMember SlitEndMembers[] = {
    KIRI_RUN(8, kiriSlitEnd, at, along),
    KIRI_RUN(4, kiriSlitEnd, cell, cell),
};
static const kiriRecord SlitEndRecord = KIRI_RECORD(kiriSlitEnd, SlitEndMembers);

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
static const kiriRecord SiteTargetRecord = KIRI_RECORD(SiteTarget, SiteTargetMembers);

static const kiriMember SampleBlockMembers[] = {
    KIRI_RUN(8, SampleBlock, distance, distance),
    KIRI_RUN(4, SampleBlock, cell, seen),
    KIRI_BOOLS(SampleBlock, isCovered, isCovered),
};
static const kiriRecord SampleBlockRecord = KIRI_RECORD(SampleBlock, SampleBlockMembers);

static const kiriMember PlacerWorkMembers[] = {
    KIRI_CUSTOM(kiriPlacerWork, old, MoveOldField),
    KIRI_PART(kiriPlacerWork, flooded, kiriFieldRecord),
    KIRI_PART(kiriPlacerWork, ends, kiriFieldRecord),
    KIRI_RUN(8, kiriPlacerWork, reach, reach),
    KIRI_RUN(4, kiriPlacerWork, closest, closest),
    KIRI_PART(kiriPlacerWork, fresh, kiriFieldRecord),
    KIRI_ITEMS(4, kiriPlacerWork, sampled),
    KIRI_ITEMS(4, kiriPlacerWork, holds),
    KIRI_ITEMS(1, kiriPlacerWork, marks),
    KIRI_BOOLS(kiriPlacerWork, isTaking, isTaking),
    KIRI_PARTS(kiriPlacerWork, targets, SiteTargetRecord),
    KIRI_PARTS(kiriPlacerWork, blocks, SampleBlockRecord),
    KIRI_ITEMS(4, kiriPlacerWork, seeds),
    KIRI_RUN(4, kiriPlacerWork, stage, cursor),
    KIRI_RUN(8, kiriPlacerWork, due, due),
    KIRI_RUN(4, kiriPlacerWork, left, round),
};
static const kiriRecord PlacerWorkRecord = KIRI_RECORD(kiriPlacerWork, PlacerWorkMembers);

static const kiriMember PlacerMembers[] = {
    KIRI_PARTS(kiriPlacer, sites, kiriSiteRecord),
    KIRI_RUN(4, kiriPlacer, oldCount, oldCount),
    KIRI_ITEMS(4, kiriPlacer, cells),
    KIRI_DROPPED(kiriPlacer, known),
    KIRI_PARTS(kiriPlacer, ends, SlitEndRecord),
    KIRI_RUN(8, kiriPlacer, reach, closeness),
    KIRI_OWNED(kiriPlacer, work, PlacerWorkRecord),
};
const kiriRecord kiriPlacerRecord = KIRI_RECORD(kiriPlacer, PlacerMembers);

void kiriLinks_EndReading(kiriLinks* links, kiriMemory* memory)
{
    if (links->work != NULL) {
        links->work->edges.memory = memory;
    }
}

void kiriPlacer_EndReading(kiriPlacer* placer, const kiriField* known)
{
    if (placer->work != NULL && placer->work->old == NULL) {
        placer->work->old = known;
    }
}
