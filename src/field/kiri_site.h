/* Where control frames are placed (section 5 of the paper): evenly, and in pairs at slit ends. */
#ifndef KIRI_SITE_H
#define KIRI_SITE_H

#include "kiri_region.h"

KIRI_C_BEGIN

/* Where an open edge ends inside the material. The sheet bends and stretches around slit ends, so borders between
   regions must be there. */
typedef struct kiriSlitEnd {
    kiriVec2 at;    /* local m */
    kiriVec2 along; /* unit: the way on from the slit */
    int32_t cell;   /* the cell that holds it */
} kiriSlitEnd;

typedef KIRI_ARRAY(kiriSlitEnd) kiriSlitEnds;

/* Returns true if a cut, or a sharp notch of the outline, ends at the vertex inside the material. *along: unit, the way on.
   */
bool kiriSlits_WayOn(const kiriMeshData* mesh, int32_t vertex, kiriVec2* along);

/* Finds the first slit end in a cell; false where there is none. Adds the number of vertices that it read to *looks. */
bool kiriSlits_FindEndIn(const kiriGrid* grid, int32_t cell, kiriSlitEnd* end, int32_t* looks);

/* Progress of a search that a budget may interrupt; zeros at its start. */
typedef struct kiriSlitSearch {
    int32_t seen; /* cells */
    int64_t owed; /* items for the last of them */
} kiriSlitSearch;

/* Finds the slit ends in these cells, one a cell at most, in the order of the cells. An item is 3 vertices, or 16
   cells. After KIRI_FAILED, start again. */
kiriProgress kiriSlits_FindEnds(kiriSlitEnds* ends, kiriSlitSearch* search, const kiriGrid* grid, const int32_t* cells,
                                int32_t cellCount, kiriQuota* quota);

/* Returns a site to the left of a slit end; left below 0: to its right. Its cell is KIRI_NONE where a cut or the outline is
   between. */
kiriSite kiriSlit_SiteBeside(const kiriGrid* grid, const kiriSlitEnd* end, double left);

/* Adds a pair of sites at each slit end, with a way of `spacing` from the one to the other over the end: so the line on
   which the slit would go on is a border between their regions. An end without room gets a closer pair, but not closer
   than two squares, and none where other sites are too near. In the order of the ends, until there are `most` sites,
   each in another cell. False when out of memory. */
bool kiriSlits_AddPairs(kiriSites* sites, const kiriGrid* grid, const kiriSlitEnds* ends, double spacing, int32_t most);

typedef struct kiriPlacerWork kiriPlacerWork; /* private */

/* Puts sites evenly into a part of the sheet: farthest-point sampling, then Lloyd relaxation of the new ones only. A
   job that a budget may interrupt. */
typedef struct kiriPlacer {
    kiriSites sites;   /* old sites, then the new ones; right when Run is done */
    int32_t oldCount;  /* sites before it stay where they are */
    kiriIndices cells; /* the part: cells that hang together, in their order (or all cells, of many pieces) */
    /* Distances to the sites that are there, as kiriRegions has them, where the caller knows them; they must stay
       until the job is done. Null: they are flooded. Start takes it, and makes it null. */
    const kiriField* known;
    /* Around slit ends sites are closer than elsewhere: `closeness` times (1 to 4) at an end, then less, in proportion
       to 1 / distance, and as elsewhere from `reach` (m) on. 0: they are as close everywhere. Start makes it 0. */
    kiriSlitEnds ends;
    double reach, closeness;
    kiriPlacerWork* work;
} kiriPlacer;

/* Lists the cells connected to this one over faces, in the order of cells, in placer->cells. Fails on out of memory. */
bool kiriPlacer_TakePiece(kiriPlacer* placer, const kiriGrid* grid, int32_t cell);

/* Find the piece in steps: Start, which fails on out of memory, then continue until it is done. An item of the quota is
   a number of cells. Done at once if the piece is already listed. After KIRI_FAILED or to give up, start again. */
bool kiriPlacer_StartPiece(kiriPlacer* placer, const kiriGrid* grid, int32_t cell);
kiriProgress kiriPlacer_GoOnWithPiece(kiriPlacer* placer, const kiriGrid* grid, kiriQuota* quota);

/* Puts `count` sites, or up to `most` for even rows, in straight rows into the part in placer->cells, if it is a rectangle
   along the axes and has a square of the grid for each site; otherwise it leaves no sites. Regions have the same area.
   False when out of memory. */
bool kiriPlacer_PlaceRows(kiriPlacer* placer, const kiriGrid* grid, int32_t count, int32_t most);

/* Starts to place `count` more sites in the part in placer->cells, or one in each free cell where there are fewer. The
   sites in placer->sites lie in the part, each in another cell. Sampling takes only cells that `allowed` marks (one
   byte a cell of the grid; null: all); it is read now and not kept. One site in a part without sites goes to the cell
   nearest to the centroid, without relaxation: confetti comes in thousands. False when out of memory. */
bool kiriPlacer_Start(kiriPlacer* placer, const kiriGrid* grid, const uint8_t* allowed, int32_t count);

/* Continues the work. An item of the quota is a settled cell, or four visited ones. After KIRI_FAILED, start again. */
kiriProgress kiriPlacer_Run(kiriPlacer* placer, const kiriGrid* grid, kiriQuota* quota);

/* Work of a placer. Private to kiri_site.c and to snapshots. */

typedef enum PlacerStage {
    PLACER_RESTS,
    FLOOD_ENDS,    /* distances to the slit ends */
    FLOOD_OLD,     /* distances to the old sites */
    SAMPLE,        /* for the farthest cell */
    FLOOD_NEW,     /* distances to the site just sampled, where it is the nearest */
    LOWER,         /* the distances of sampling by these */
    FLOOD_ALL_NEW, /* distances to all new sites, where they are the nearest */
    SUM,           /* the material of their regions */
    AIM_NEAR,      /* for the cells nearest to the regions' centroids, where these are, */
    AIM,           /* and in whole regions that do not hold theirs */
    SUM_PART,      /* the material of the part, */
    AIM_PART,      /* and the cell nearest to its centroid, for one site by itself */
    PLACER_STAGES
} PlacerStage;

/* Where a new site goes. The material is summed in whole numbers, so that the order of adding does not matter:
   area in units of 1 / AREA_UNITS of a square, moments in as many of its sides. */
typedef struct SiteTarget {
    int64_t area, u, v;
    kiriVec2 center;
    int32_t cell; /* the cell of the region nearest to the center, so far */
    bool isFound; /* the search is over */
    double distance;
} SiteTarget;

/* The farthest free cell of a block when it was looked at: since then cells have only come nearer, or been taken. */
typedef struct SampleBlock {
    int64_t distance; /* below zero: none is free */
    int32_t cell;
    int32_t seen; /* how many sites there were then */
    bool isCovered;
} SampleBlock;

struct kiriPlacerWork {
    bool hasOld;          /* there are old sites, */
    const kiriField* old; /* and distances from them: `flooded`, or the caller's; else null */
    kiriField flooded;
    kiriField ends;                 /* from the slit ends */
    int64_t reach;                  /* of these, on the grid, times CLOSENESS; 0: sites are as close everywhere */
    int32_t closest;                /* closeness at the ends, times CLOSENESS */
    kiriField fresh;                /* from the site just sampled, or from all new ones */
    kiriIndices sampled;            /* of each cell: distance to the nearest new site while sampling */
    kiriIndices holds;              /* of each cell: the site in it, or KIRI_CELL_FREE, or barred to sampling */
    kiriFlags marks;                /* of each cell: zero, but while a piece is taken */
    bool isTaking;                  /* a piece */
    KIRI_ARRAY(SiteTarget) targets; /* of each new site */
    KIRI_ARRAY(SampleBlock) blocks; /* of the part */
    kiriSeeds seeds;
    PlacerStage stage;
    int32_t cursor; /* cells of its list that the stage has done */
    int64_t due;    /* cells that were read and not paid yet */
    int32_t left;   /* sites still to sample */
    int32_t lost;   /* targets that AIM_NEAR has not found */
    int32_t round;
};

enum { KIRI_CELL_FREE = KIRI_NONE };

KIRI_C_END

#endif
