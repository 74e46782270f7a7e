/* Links: the connected stretches of border between regions, where the sheet's elasticity is measured (README,
   "Mechanics"). */
#ifndef KIRI_LINK_H
#define KIRI_LINK_H

#include "kiri_shape.h"

KIRI_C_BEGIN

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

typedef struct kiriLinkWork kiriLinkWork; /* private to kiri_link.c */

typedef struct kiriLinks {
    /* By (i, j), then by their lowest face: by square, axis, and the lowest triangles of its cells. */
    KIRI_ARRAY(kiriLink) links;
    KIRI_ARRAY(kiriLink) next; /* what kiriLinks_Update made; Commit swaps */
    int32_t changed;           /* of `next`: links that are other than before */
    kiriLinkWork* work;
} kiriLinks;

/* The links of the regions as they are, into `next`: those between regions that are not dirty (regions->dirty) are
   taken over from `links`, the others made anew. False for memory: `links` is as before. */
bool kiriLinks_Update(kiriLinks* links, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      const kiriRegions* regions, const kiriShape* shape, const kiriSite* sites, int32_t siteCount);
void kiriLinks_Commit(kiriLinks* links);

KIRI_C_END

#endif
