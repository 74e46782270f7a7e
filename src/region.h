/* Regions: the geodesic Voronoi diagram of the frames on the grid; and the links between them, where the sheet's
   elasticity is measured (README, "Mechanics"). */
#ifndef KIRI_REGION_H
#define KIRI_REGION_H

#include "geodesic.h"

/* A frame's place in the rest plane. */
typedef struct kiriSite {
    kiriVec2 at;  /* local m */
    int32_t cell; /* that holds it */
} kiriSite;

typedef KIRI_ARRAY(kiriSeed) kiriSeeds;

/* Adds the seeds of distances to the site. Where it lies off the middle of its square, the cells one step away are
   seeds as well, so that distances know where in its cell the site is. False for memory. */
bool kiriSite_Seed(const kiriSite* site, int32_t owner, const kiriMemory* memory, const kiriGrid* grid,
                   const kiriMeshData* mesh, kiriSeeds* seeds);

typedef struct kiriRegion {
    kiriMoments material; /* about the local origin */
    int32_t reach;        /* d_max: the largest distance in it from its frame */
    double spread[3];     /* half the sum of W l n n over its links: uu, uv, vv; about the area times the identity
                             where neighbours are all around, less at free edges */
} kiriRegion;

/* One connected stretch of border between regions i < j. */
typedef struct kiriLink {
    int32_t i, j;
    double width;      /* W: length of the vector sum of its faces, m */
    double length;     /* l: from site i to site j through it, m */
    double moment;     /* I: second moment of the border along the tangent about the centroid, m^3 */
    double braced;     /* how far its regions have neighbours along the tangent: 0 in a strip one region wide, to 1 */
    kiriVec2 span;     /* s: from site i to site j; l along the normal where the way between them is not straight */
    kiriVec2 normal;   /* unit, from i to j */
    kiriVec2 tangent;  /* unit, the normal turned left */
    kiriVec2 centroid; /* b: of the border, local m */
    kiriVec2
        crossing; /* m: where the way from i to j crosses it; the midpoint of the sites where that way is straight */
    kiriVec2 spread[2]; /* integrals over the border of (p - b)_u and of (p - b)_v, times its normal, m^2 */
} kiriLink;

typedef struct kiriRegions {
    KIRI_ARRAY(int32_t) owner;      /* of each cell; KIRI_NONE where no frame is in the piece */
    KIRI_ARRAY(int32_t) distance;   /* of each cell to its owner's site */
    KIRI_ARRAY(kiriRegion) regions; /* one a site */
    KIRI_ARRAY(kiriLink) links;     /* by (i, j), then by their lowest face */
} kiriRegions;

/* From scratch; two sites never share a cell. `field` is scratch of the grid's size, reset before and after. */
bool kiriRegions_Build(kiriRegions* regions, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                       kiriField* field, const kiriSite* sites, int32_t siteCount);

/* Owner and distance only, for placing frames. A site always owns its own cell. */
bool kiriRegions_Divide(kiriRegions* regions, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        kiriField* field, const kiriSite* sites, int32_t siteCount);
void kiriRegions_Release(kiriRegions* regions, const kiriMemory* memory);

#endif
