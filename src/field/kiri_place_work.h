/* The work of a placer at hand: private to kiri_place.c, and to who saves it. */
#ifndef KIRI_PLACE_WORK_H
#define KIRI_PLACE_WORK_H

#include "kiri_place.h"

KIRI_C_BEGIN

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

/* Where a new site shall go. The material is summed in whole numbers, so that the order of adding does not matter:
   area in units of 1 / AREA_UNITS of a square, moments in as many of its sides. */
typedef struct SiteTarget {
    int64_t area, u, v;
    kiriVec2 center;
    int32_t cell; /* of the region, nearest to the center */
    bool isFound; /* it need not be looked for */
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
    const kiriField* old; /* from the old sites: `flooded`, or the caller's */
    kiriField flooded;
    kiriField ends;                 /* from the slit ends */
    int64_t reach;                  /* of these, on the grid, times CLOSENESS; 0: sites are as close everywhere */
    int32_t closest;                /* closeness at the ends, times CLOSENESS */
    kiriField fresh;                /* from the site just sampled, or from all new ones */
    KIRI_ARRAY(int32_t) sampled;    /* of each cell: distance to the nearest new site while sampling */
    KIRI_ARRAY(int32_t) holds;      /* of each cell: the site in it, or CELL_FREE, or CELL_BARRED to sampling */
    KIRI_ARRAY(uint8_t) marks;      /* of each cell: zero, but while a piece is taken */
    bool isTaking;                  /* a piece */
    KIRI_ARRAY(SiteTarget) targets; /* of each new site */
    KIRI_ARRAY(SampleBlock) blocks; /* of the part */
    kiriSeeds seeds;
    PlacerStage stage;
    int32_t cursor;   /* of the stage: how many cells of its list it has seen */
    int64_t due;      /* cells that were looked at, and that the quota has not given yet */
    int32_t left;     /* sites still to sample */
    int32_t farthest; /* cell found so far, or KIRI_NONE */
    int32_t lost;     /* targets that AIM_NEAR has not found */
    int32_t round;
};

KIRI_C_END

#endif
