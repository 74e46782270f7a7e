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
    int32_t cell; /* the cell that holds it */
} kiriSite;

typedef KIRI_ARRAY(kiriSite) kiriSites;
typedef KIRI_ARRAY(kiriSeed) kiriSeeds;

/* Adds the seeds of distances to the site. If the site is off the middle of its square, the cells one step away are
   seeds as well, so that distances depend on its position in the cell. Fails on out of memory. */
bool kiriSite_Seed(const kiriSite* site, int32_t owner, const kiriGrid* grid, kiriSeeds* seeds);

/* Starts a flood from sites `first` to `end` - 1, without seeds in the cells of other sites (see NearestSiteSeed);
   holders: of each cell, the site in it, or negative. `seeds` is scratch. Fails on out of memory. */
bool kiriSites_StartFlood(kiriField* field, kiriSeeds* seeds, const kiriGrid* grid, const kiriSite* sites,
                          int32_t first, int32_t end, const int32_t* holders);

/* Returns the seed of the site in one cell; distance KIRI_FAR where it has none there. */
kiriSeed kiriSite_SeedAt(const kiriSite* site, int32_t owner, const kiriGrid* grid, int32_t cell);

typedef struct kiriRegions {
    kiriField field; /* owner: the frame whose region a cell is in; KIRI_NONE where its piece has no frame */

    kiriIndices siteAt; /* for each cell: the frame whose site it holds, or KIRI_NONE; two never share one */
    kiriFlags onBorder; /* for each cell: a step from it leads to another region */

    kiriBorderCells border;         /* for each frame: the border cells of its region */
    KIRI_ARRAY(kiriTally) material; /* for each frame: material of its region, exact */
    kiriFlags dirty;                /* for each frame, until the sheet's commit: its region, distances in it, or its
                                       cells' steps, material or edges changed */

    /* Since kiriRegions_ClearChanges: live cells whose owner or distance changed, with the old values. */
    KIRI_ARRAY(kiriSeed) changes;
    kiriIndices orphans;         /* all cells whose piece has no frame, in the order of cells */
    bool running;                /* an update waits for more quota */

    /* Private. */
    bool flooding;                 /* the update is one from scratch */
    bool hasSeenGrid;              /* an earlier update has followed the changes of the grid */
    bool following;                /* the field is right again; */
    int32_t followed;              /* entries of its log that have been followed */
    kiriFlags isChanged;           /* for each cell: it is in `changes` */
} kiriRegions;

/* A site that is new or has moved, be it only within its cell, or whose cell has another index. */
typedef struct kiriSiteMove {
    int32_t frame;
    int32_t was; /* the cell that held it, which may be gone; KIRI_NONE for a new one */
} kiriSiteMove;

/* Follows the changes of the grid and of sites. Sites are in live cells, no two in one, and are never taken away. From
   scratch: a zeroed or reset kiriRegions, and all sites in `moves`. Several updates, each with more sites, may come
   before the changes of grid and regions are cleared, together, and before the next update of the grid. Items of the
   quota: see kiriField_Repair, and two for a cell of its log. KIRI_MORE: call again with the same arguments.
   KIRI_FAILED: only kiriRegions_Reset helps. */
kiriProgress kiriRegions_Update(kiriRegions* regions, const kiriGrid* grid, const kiriSite* sites, int32_t siteCount,
                                const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota);

/* Takes away the frames that are not kept, and the cells of their regions, which `gone` lists; other frames get their
   new index. Not during an update, nor before its changes are cleared. Cannot fail. */
void kiriRegions_Keep(kiriRegions* regions, const kiriKeep* frames, const int32_t* gone, int32_t goneCount);

/* Clears `changes`; `dirty` stays until the sheet's commit clears it. */
void kiriRegions_ClearChanges(kiriRegions* regions);
void kiriRegions_Reset(kiriRegions* regions);

KIRI_C_END

#endif
