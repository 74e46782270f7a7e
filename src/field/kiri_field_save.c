#include "kiri_field_save.h"

#include "kiri_grid.h"
#include "kiri_link.h"
#include "kiri_shape.h"
#include "kiri_site.h"

KIRI_SHARED_TABLE(kiriSiteTable, kiriSite, {
    KIRI_REALS(at),
    KIRI_DERIVED,
})

KIRI_TABLE(FieldTable, kiriField, {
    KIRI_DERIVED,
    KIRI_ARRAYS(distance, owner, settled, log, seeds, dirty, marks),
    KIRI_ARRAYS(ring[0], ring[1], ring[2], ring[3]),
})

/* ---- The grid ---------------------------------------------------------------------------------------------------- */

KIRI_TABLE(GridWorkTable, kiriGridWork, {
    KIRI_DERIVED,
    KIRI_ARRAYS(facesDirty, linksDirty, stepsDirty, knightsDirty, squareFlags, flagged),
    KIRI_ARRAYS(ranges, entries, parent, cellFlags, mark, newCells, oldFaces, steps),
})

KIRI_TABLE(GridChangesTable, kiriGridChanges, {
    KIRI_DERIVED,
    KIRI_ARRAYS(made, gone, steps, material, edges),
})

KIRI_SHARED_TABLE(kiriGridTable, kiriGrid,
                  {
                      KIRI_DROPPED(mesh),
                      KIRI_DERIVED,
                      KIRI_ARRAYS(cells, runs, steps, faces, materials, stretches, unusedMaterials, unusedStretches),
                      KIRI_ARRAYS(squareCell, nodeCell, vertexCell, whole),
                      KIRI_PART(changes, GridChangesTable),
                      KIRI_OWNED(work, GridWorkTable),
                  })

/* ---- Regions and shape functions --------------------------------------------------------------------------------- */

KIRI_TABLE(BorderCellsTable, kiriBorderCells, {
    KIRI_DERIVED,
    KIRI_ARRAYS(first, cells),
})

KIRI_SHARED_TABLE(kiriRegionsTable, kiriRegions, {
    KIRI_UNHASHED,
    KIRI_ITEMS(1, dirty),
    KIRI_DERIVED,
    KIRI_PART(field, FieldTable),
    KIRI_PART(border, BorderCellsTable),
    KIRI_ARRAYS(siteAt, onBorder, material, changes, orphans, isChanged),
})

KIRI_TABLE(ShapeWorkTable, kiriShapeWork, {
    KIRI_DERIVED,
    KIRI_PART(fromSite, FieldTable),
    KIRI_PART(fromBorder, FieldTable),
    KIRI_ARRAYS(seeds, loaded, isLoaded, marks, wasOwner, rigidShares, counted),
    KIRI_ARRAYS(sideCounts, frames, dirtyFrames, touches, dirty, weights),
})

KIRI_TABLE(ReachesTable, kiriReaches, {
    KIRI_DERIVED,
    KIRI_ARRAYS(blocks, heads, ofCells, ofFrame),
})

KIRI_SHARED_TABLE(kiriShapeTable, kiriShape, {
    KIRI_REALS(rigidWeight),
    KIRI_UNHASHED,
    KIRI_BOOLS(eased),
    KIRI_DERIVED,
    KIRI_ARRAYS(spans, weights, rigid, changes),
    KIRI_PART(reaches, ReachesTable),
    KIRI_OWNED(work, ShapeWorkTable),
})

/* ---- Links ------------------------------------------------------------------------------------------------------- */

KIRI_TABLE(SightEdgesTable, kiriSightEdges, {
    KIRI_DERIVED,
    KIRI_ARRAYS(edges, squares, listed),
})

KIRI_TABLE(LinkWorkTable, kiriLinkWork, {
    KIRI_DERIVED,
    KIRI_ARRAYS(marks, stale, faces, to, made, ends, nextEnds),
    KIRI_ROOMS(order, stretch, parts),
    KIRI_RUN(4, foldCount),
    KIRI_PART(edges, SightEdgesTable),
})

KIRI_SHARED_TABLE(kiriLinksTable, kiriLinks, {
    KIRI_DERIVED,
    KIRI_ARRAYS(links, next, corners, nextCorners, was),
    KIRI_OWNED(work, LinkWorkTable),
})

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
    KIRI_CUSTOM(old, MoveOldField),
    KIRI_PART(flooded, FieldTable),
    KIRI_PART(ends, FieldTable),
    KIRI_PART(fresh, FieldTable),
    KIRI_ARRAYS(sampled, holds, marks, targets, blocks, seeds),
})

KIRI_SHARED_TABLE(kiriPlacerTable, kiriPlacer, {
    KIRI_DERIVED,
    KIRI_ARRAYS(sites, cells, ends),
    KIRI_DROPPED(known),
    KIRI_OWNED(work, PlacerWorkTable),
})
