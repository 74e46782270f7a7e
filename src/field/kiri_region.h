/* Regions: the geodesic Voronoi diagram of the frames on the grid. */
#ifndef KIRI_REGION_H
#define KIRI_REGION_H

#include "kiri_grid.h"
#include "kiri_geodesic.h"
#include "../core/kiri_vec.h"

KIRI_C_BEGIN

/* A frame's place in the rest plane. */
typedef struct kiriSite {
    kiriVec2 at;  /* local m */
    int32_t cell; /* that holds it */
} kiriSite;

typedef KIRI_ARRAY(kiriSite) kiriSites;
typedef KIRI_ARRAY(kiriSeed) kiriSeeds;

/* Adds the seeds of distances to the site. Where it lies off the middle of its square, the cells one step away are
   seeds as well, so that distances know where in its cell the site is. False for memory. */
bool kiriSite_Seed(const kiriSite* site, int32_t owner, kiriMemory* memory, const kiriGrid* grid,
                   const kiriMeshData* mesh, kiriSeeds* seeds);

/* The seed of the site in one cell: distance KIRI_FAR where it sends none there. */
kiriSeed kiriSite_SeedAt(const kiriSite* site, int32_t owner, const kiriGrid* grid, const kiriMeshData* mesh,
                         int32_t cell);

/* How much of each list of the grid's changes an update has followed already. */
typedef struct kiriSeenChanges {
    int32_t made, gone, steps, material, edges;
} kiriSeenChanges;

typedef struct kiriRegions {
    kiriField field; /* owner: the frame whose region a cell is in; KIRI_NONE where no frame is in the piece */

    /* Of each cell: */
    KIRI_ARRAY(int32_t) siteAt;   /* the frame whose site it holds, or KIRI_NONE; two sites never share one */
    KIRI_ARRAY(uint8_t) onBorder; /* a step from it leads to another region */

    kiriBorderCells border; /* of each frame: those of its region on a border */

    /* Of each frame: */
    KIRI_ARRAY(kiriTally) material; /* of its region, exact */
    KIRI_ARRAY(uint8_t) dirty;      /* its region, distances in it, or its cells' steps, material or edges changed */

    /* Since kiriRegions_ClearChanges: cells that live whose owner or distance changed, and what they were. */
    KIRI_ARRAY(kiriSeed) changes;
    KIRI_ARRAY(int32_t) orphans; /* all cells with no frame in their piece, in the order of cells */
    bool running;                /* an update is at hand: it waits for more quota */

    /* Private. */
    bool flooding;                 /* the update is one from scratch */
    bool following;                /* the field is right again; */
    int32_t followed;              /* so much of its log has been followed */
    KIRI_ARRAY(uint8_t) isChanged; /* of each cell: it is in `changes` */
    kiriSeenChanges seen;
} kiriRegions;

/* A site that is new or has moved, be it only within its cell, or whose cell has another index. */
typedef struct kiriSiteMove {
    int32_t frame;
    int32_t was; /* the cell that held it, which may be gone; KIRI_NONE for a new one */
} kiriSiteMove;

/* Follows the grid's changes and those of the sites. Sites are in cells that live, no two in one, and are never taken
   away. Items of the quota: see kiriField_Repair, and two for a cell of its log. From scratch: a zeroed or reset
   kiriRegions, and all sites in `moves`. KIRI_MORE: call again with the same arguments. KIRI_FAILED: only
   kiriRegions_Reset helps. Several updates, each with more sites, may come before the changes of grid and regions are
   cleared, which is together, and before the grid is updated again. */
kiriProgress kiriRegions_Update(kiriRegions* regions, kiriMemory* memory, const kiriGrid* grid,
                                const kiriMeshData* mesh, const kiriSite* sites, int32_t siteCount,
                                const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota);

/* The cells go that are listed, which are all of the regions of the frames that are not kept; others get their new
   index. Not during an update, nor before its changes are cleared. Never fails. */
void kiriRegions_Keep(kiriRegions* regions, const kiriKeep* frames, const int32_t* gone, int32_t goneCount);

/* All who follow the regions have seen `changes`; `dirty` stays until the sheet's commit clears it. */
void kiriRegions_ClearChanges(kiriRegions* regions);
void kiriRegions_Reset(kiriRegions* regions);

KIRI_C_END

#endif
