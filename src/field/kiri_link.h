/* Links: the connected stretches of border between regions, where the sheet's elasticity is measured; and corners,
   where borders meet (README, "Mechanics"). */
#ifndef KIRI_LINK_H
#define KIRI_LINK_H

#include "kiri_region.h"

KIRI_C_BEGIN

/* One connected stretch of border between regions i < j. */
typedef struct kiriLink {
    int32_t i, j;
    double width;      /* W: of the border, from end to end, m */
    double outer;      /* the part of W at open ends, m: each end at the outline or at a slit adds the way along the
                          tangent from the crossing to it; 0 where both ends are corners, to W where both are open */
    double length;     /* l: from site i to site j through it, m */
    double moment;     /* I: second moment of the border along the tangent about the centroid, m^3 */
    kiriVec2 span;     /* s: from site i to site j; l along the normal where the way between them is not straight */
    kiriVec2 normal;   /* unit, from i to j */
    kiriVec2 tangent;  /* unit, the normal turned left */
    kiriVec2 centroid; /* b: of the border, local m */
    kiriVec2
        crossing; /* m: where the way from i to j crosses it; the midpoint of the sites where that way is straight */
    /* Of the border as a staircase of cells, which is what regions are made of: the sum of its faces' widths, each
       times its normal, m; and the sum of (p - b)_u, and of (p - b)_v, times the same, m^2. */
    kiriVec2 sum, spread[2];
} kiriLink;

/* Where three or four regions meet. It couples curvatures, and stretches, of different directions: the sum over its
   links of weight . (strains along normal and tangent) is the trace of the curvature, or of the strain. */
typedef struct kiriCorner {
    int32_t count;      /* of its links: 3 or 4 */
    int32_t link[4];    /* into `links`, ascending; those beyond count are KIRI_NONE */
    int32_t unused;     /* 0: there is no padding */
    kiriVec2 weight[4]; /* p_k = N^-1 s_k, N = sum of s_k s_k^T over its links, s_k their spans; 1/m */
    double area;        /* m^2, of the triangle or quadrangle of its sites */
} kiriCorner;

typedef struct kiriLinkWork kiriLinkWork; /* private: kiri_link_work.h */

typedef struct kiriLinks {
    /* By (i, j), then by their lowest face: by square, axis, and the lowest triangles of its cells. */
    KIRI_ARRAY(kiriLink) links;
    KIRI_ARRAY(kiriLink) next; /* what kiriLinks_Update made; Commit swaps */
    int32_t changed;           /* of `next`: links that are other than before */
    /* Of each next link, and after the commit of each link: which one it was before, bit for bit, or KIRI_NONE where it
       was made; of corners the same, but for the indices of their links. Empty where that is not known: of links that
       were read, or are left. */
    KIRI_ARRAY(int32_t) was, wasCorner;
    /* Of `links`, by their links; where four regions meet, all four pairs of neighbours are linked. */
    KIRI_ARRAY(kiriCorner) corners;
    KIRI_ARRAY(kiriCorner) nextCorners; /* of `next` */
    kiriLinkWork* work;
} kiriLinks;

/* The links of the regions as they are, into `next`: those between regions that are neither dirty (regions->dirty) nor
   beside one that is are taken over from `links`, the others made anew; and their corners. An item of the quota is as
   long as one of the grid: a link counts as many. KIRI_MORE: call again before the regions change. KIRI_FAILED: `links`
   is as before. */
kiriProgress kiriLinks_Update(kiriLinks* links, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                              const kiriRegions* regions, const kiriSite* sites, int32_t siteCount, kiriQuota* quota);

/* Forgets an update at hand, and what one has made. */
void kiriLinks_Drop(kiriLinks* links);

/* Regions become dirty that were not: an update that is at hand begins again. */
void kiriLinks_BeginAgain(kiriLinks* links);

/* The same of what is left when links and frames are taken away: what is kept stays as it is. No link that is kept
   joins a frame that is not. */
bool kiriLinks_Keep(kiriLinks* links, kiriMemory* memory, const kiriKeep* kept, const kiriKeep* frames);
void kiriLinks_Commit(kiriLinks* links);

KIRI_C_END

#endif
