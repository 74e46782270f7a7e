#include "kiri_field_save.h"

#include "kiri_grid.h"
#include "kiri_link.h"
#include "kiri_shape.h"
#include "kiri_site.h"

static const kiriMember SiteMembers[] = {
    KIRI_REALS(kiriSite, at, at),
    KIRI_DERIVED,
};
const kiriTable kiriSiteTable = KIRI_TABLE(kiriSite, SiteMembers);

static const kiriMember FieldMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriField, distance, owner, settled, log, heap, dirty, marks),
};
static const kiriTable FieldTable = KIRI_TABLE(kiriField, FieldMembers);

/* ---- The grid ---------------------------------------------------------------------------------------------------- */

static const kiriMember GridWorkMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriGridWork, facesDirty, linksDirty, stepsDirty, knightsDirty, squareFlags, flagged),
    KIRI_ARRAYS(kiriGridWork, ranges, entries, parent, cellFlags, mark, newCells, oldFaces, steps),
};
static const kiriTable GridWorkTable = KIRI_TABLE(kiriGridWork, GridWorkMembers);

static const kiriMember GridChangesMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriGridChanges, made, gone, steps, material, edges),
};
static const kiriTable GridChangesTable = KIRI_TABLE(kiriGridChanges, GridChangesMembers);

static const kiriMember GridMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriGrid, cells, runs, steps, faces, materials, stretches, unusedMaterials, unusedStretches),
    KIRI_ARRAYS(kiriGrid, squareCell, nodeCell, vertexCell, whole),
    KIRI_PART(kiriGrid, changes, GridChangesTable),
    KIRI_OWNED(kiriGrid, work, GridWorkTable),
};
const kiriTable kiriGridTable = KIRI_TABLE(kiriGrid, GridMembers);

/* ---- Regions and shape functions --------------------------------------------------------------------------------- */

static const kiriMember BorderCellsMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriBorderCells, first, cells),
};
static const kiriTable BorderCellsTable = KIRI_TABLE(kiriBorderCells, BorderCellsMembers);

static const kiriMember RegionsMembers[] = {
    KIRI_UNHASHED,
    KIRI_ITEMS(1, kiriRegions, dirty),
    KIRI_DERIVED,
    KIRI_PART(kiriRegions, field, FieldTable),
    KIRI_PART(kiriRegions, border, BorderCellsTable),
    KIRI_ARRAYS(kiriRegions, siteAt, onBorder, material, changes, orphans, isChanged),
};
const kiriTable kiriRegionsTable = KIRI_TABLE(kiriRegions, RegionsMembers);

static const kiriMember ShapeWorkMembers[] = {
    KIRI_DERIVED,
    KIRI_PART(kiriShapeWork, fromSite, FieldTable),
    KIRI_PART(kiriShapeWork, fromBorder, FieldTable),
    KIRI_ARRAYS(kiriShapeWork, seeds, loaded, isLoaded, marks, wasOwner, rigidShares, counted),
    KIRI_ARRAYS(kiriShapeWork, sideCounts, frames, dirtyFrames, touches, dirty, weights),
};
static const kiriTable ShapeWorkTable = KIRI_TABLE(kiriShapeWork, ShapeWorkMembers);

static const kiriMember ReachesMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriReaches, blocks, heads, ofCells, ofFrame),
};
static const kiriTable ReachesTable = KIRI_TABLE(kiriReaches, ReachesMembers);

static const kiriMember ShapeMembers[] = {
    KIRI_REALS(kiriShape, rigidWeight, rigidWeight),
    KIRI_UNHASHED,
    KIRI_BOOLS(kiriShape, eased, eased),
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriShape, spans, weights, rigid, changes),
    KIRI_PART(kiriShape, reaches, ReachesTable),
    KIRI_OWNED(kiriShape, work, ShapeWorkTable),
};
const kiriTable kiriShapeTable = KIRI_TABLE(kiriShape, ShapeMembers);

/* ---- Links ------------------------------------------------------------------------------------------------------- */

static const kiriMember SightEdgesMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriSightEdges, edges, squares, listed),
};
static const kiriTable SightEdgesTable = KIRI_TABLE(kiriSightEdges, SightEdgesMembers);

static const kiriMember LinkWorkMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriLinkWork, marks, stale, faces, to, made, ends, nextEnds),
    KIRI_ROOMS(kiriLinkWork, order, stretch),
    KIRI_PART(kiriLinkWork, edges, SightEdgesTable),
};
static const kiriTable LinkWorkTable = KIRI_TABLE(kiriLinkWork, LinkWorkMembers);

static const kiriMember LinksMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriLinks, links, next, corners, nextCorners),
    KIRI_ROOM_OF(kiriLinks, was),
    KIRI_OWNED(kiriLinks, work, LinkWorkTable),
};
const kiriTable kiriLinksTable = KIRI_TABLE(kiriLinks, LinksMembers);

/* ---- Sites ------------------------------------------------------------------------------------------------------- */

/* Points to its own field, or to the caller's: null until kiriSheet_Archive sets it. */
static void MoveOldField(kiriArchive* archive, void* object)
{
    kiriPlacerWork* work = object;
    int32_t isOwn = kiriArchive_Count(archive, work->old == &work->flooded, 0, 1);
    if (kiriArchive_Reads(archive)) {
        work->old = isOwn ? &work->flooded : NULL;
    }
}

static const kiriMember PlacerWorkMembers[] = {
    KIRI_DERIVED,
    KIRI_CUSTOM(kiriPlacerWork, old, MoveOldField),
    KIRI_PART(kiriPlacerWork, flooded, FieldTable),
    KIRI_PART(kiriPlacerWork, ends, FieldTable),
    KIRI_PART(kiriPlacerWork, fresh, FieldTable),
    KIRI_ARRAYS(kiriPlacerWork, sampled, holds, marks, targets, blocks, seeds),
    KIRI_DROPPED(kiriPlacerWork, winds, winds),
};
static const kiriTable PlacerWorkTable = KIRI_TABLE(kiriPlacerWork, PlacerWorkMembers);

static const kiriMember PlacerMembers[] = {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriPlacer, sites, cells, ends),
    KIRI_DROPPED(kiriPlacer, known, known),
    KIRI_OWNED(kiriPlacer, work, PlacerWorkTable),
};
const kiriTable kiriPlacerTable = KIRI_TABLE(kiriPlacer, PlacerMembers);
