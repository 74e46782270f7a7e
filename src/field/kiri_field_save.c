#include "kiri_field_save.h"

#include "kiri_grid.h"
#include "kiri_link.h"
#include "kiri_shape.h"
#include "kiri_site.h"

KIRI_SHARED_TABLE(kiriSiteTable, kiriSite, {
    KIRI_REALS(kiriSite, at, at),
    KIRI_DERIVED,
});

KIRI_TABLE(FieldTable, kiriField, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriField, distance, owner, settled, log, seeds, dirty, marks),
    KIRI_ARRAYS(kiriField, ring[0], ring[1], ring[2], ring[3]),
});

/* ---- The grid ---------------------------------------------------------------------------------------------------- */

KIRI_TABLE(GridWorkTable, kiriGridWork, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriGridWork, facesDirty, linksDirty, stepsDirty, knightsDirty, squareFlags, flagged),
    KIRI_ARRAYS(kiriGridWork, ranges, entries, parent, cellFlags, mark, newCells, oldFaces, steps),
});

KIRI_TABLE(GridChangesTable, kiriGridChanges, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriGridChanges, made, gone, steps, material, edges),
});

KIRI_SHARED_TABLE(kiriGridTable, kiriGrid, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriGrid, cells, runs, steps, faces, materials, stretches, unusedMaterials, unusedStretches),
    KIRI_ARRAYS(kiriGrid, squareCell, nodeCell, vertexCell, whole),
    KIRI_PART(kiriGrid, changes, GridChangesTable),
    KIRI_OWNED(kiriGrid, work, GridWorkTable),
});

/* ---- Regions and shape functions --------------------------------------------------------------------------------- */

KIRI_TABLE(BorderCellsTable, kiriBorderCells, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriBorderCells, first, cells),
});

KIRI_SHARED_TABLE(kiriRegionsTable, kiriRegions, {
    KIRI_UNHASHED,
    KIRI_ITEMS(1, kiriRegions, dirty),
    KIRI_DERIVED,
    KIRI_PART(kiriRegions, field, FieldTable),
    KIRI_PART(kiriRegions, border, BorderCellsTable),
    KIRI_ARRAYS(kiriRegions, siteAt, onBorder, material, changes, orphans, isChanged),
});

KIRI_TABLE(ShapeWorkTable, kiriShapeWork, {
    KIRI_DERIVED,
    KIRI_PART(kiriShapeWork, fromSite, FieldTable),
    KIRI_PART(kiriShapeWork, fromBorder, FieldTable),
    KIRI_ARRAYS(kiriShapeWork, seeds, loaded, isLoaded, marks, wasOwner, rigidShares, counted),
    KIRI_ARRAYS(kiriShapeWork, sideCounts, frames, dirtyFrames, touches, dirty, weights),
});

KIRI_TABLE(ReachesTable, kiriReaches, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriReaches, blocks, heads, ofCells, ofFrame),
});

KIRI_SHARED_TABLE(kiriShapeTable, kiriShape, {
    KIRI_REALS(kiriShape, rigidWeight, rigidWeight),
    KIRI_UNHASHED,
    KIRI_BOOLS(kiriShape, eased, eased),
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriShape, spans, weights, rigid, changes),
    KIRI_PART(kiriShape, reaches, ReachesTable),
    KIRI_OWNED(kiriShape, work, ShapeWorkTable),
});

/* ---- Links ------------------------------------------------------------------------------------------------------- */

KIRI_TABLE(SightEdgesTable, kiriSightEdges, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriSightEdges, edges, squares, listed),
});

KIRI_TABLE(LinkWorkTable, kiriLinkWork, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriLinkWork, marks, stale, faces, to, made, ends, nextEnds),
    KIRI_ROOMS(kiriLinkWork, order, stretch),
    KIRI_PART(kiriLinkWork, edges, SightEdgesTable),
});

KIRI_SHARED_TABLE(kiriLinksTable, kiriLinks, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriLinks, links, next, corners, nextCorners),
    KIRI_ROOM_OF(kiriLinks, was),
    KIRI_OWNED(kiriLinks, work, LinkWorkTable),
});

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

KIRI_TABLE(PlacerWorkTable, kiriPlacerWork, {
    KIRI_DERIVED,
    KIRI_CUSTOM(kiriPlacerWork, old, MoveOldField),
    KIRI_PART(kiriPlacerWork, flooded, FieldTable),
    KIRI_PART(kiriPlacerWork, ends, FieldTable),
    KIRI_PART(kiriPlacerWork, fresh, FieldTable),
    KIRI_ARRAYS(kiriPlacerWork, sampled, holds, marks, targets, blocks, seeds),
    KIRI_DROPPED(kiriPlacerWork, winds, winds),
});

KIRI_SHARED_TABLE(kiriPlacerTable, kiriPlacer, {
    KIRI_DERIVED,
    KIRI_ARRAYS(kiriPlacer, sites, cells, ends),
    KIRI_DROPPED(kiriPlacer, known, known),
    KIRI_OWNED(kiriPlacer, work, PlacerWorkTable),
});
