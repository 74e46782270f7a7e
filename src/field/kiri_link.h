/* Links: the connected stretches of border between regions, where the sheet's elasticity is measured; and corners,
   where borders meet (README, "Mechanics"). */
#ifndef KIRI_LINK_H
#define KIRI_LINK_H

#include "kiri_region.h"
#include "kiri_path.h"

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

typedef struct kiriLinkWork kiriLinkWork; /* private: kiri_link.h */

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

/* What the files of the links share: the update at hand, its faces, rings and ends. Private to kiri_link*.c. */

/* Of a face. */
typedef enum kiriFaceMark {
    KIRI_FACE_PASSED, /* not between the regions at hand, or already in a link */
    KIRI_FACE_FOUND,
    KIRI_FACE_GATHERED,
    KIRI_FACE_BENT /* the stretch is split where its normal turns */
} kiriFaceMark;

typedef enum kiriEndKind {
    KIRI_END_OPEN,   /* at the outline, or at a slit */
    KIRI_END_CORNER, /* other regions meet there */
    KIRI_END_INNER   /* a border that was split goes on there */
} kiriEndKind;

enum { KIRI_CORNER_REGIONS = 4 };

/* Where a border ends. Ends of links that meet in a corner are equal. */
typedef struct kiriLinkEnd {
    kiriEndKind kind;
    int32_t region[KIRI_CORNER_REGIONS]; /* that meet there, ascending, then KIRI_NONE; of corners */
    int32_t cell[2];                     /* of regions i and j, beside the border's last face */
    kiriVec2 at;                         /* local m */
    kiriVec2 look;                       /* in the material, a little before the end that the grid has */
    bool isExact;                        /* the end is where it is in the Euclidean metric, */
    bool isSeen;                         /* and both sites see it */
} kiriLinkEnd;

/* Both ends of a link: the one to its tangent's tail, and to its head. */
typedef struct kiriLinkEnds {
    kiriLinkEnd end[2];
    bool isShort; /* the grid does not have this border: see kiriBorder_MakeShort */
} kiriLinkEnds;

/* A link that was made anew, and its lowest face. */
typedef struct kiriNewLink {
    kiriLink link;
    kiriLinkEnds ends;
    int32_t face; /* KIRI_NONE where it is short, or kept with all links of its pair */
    bool isOld;   /* it is what it was: see kiriBorder_IsUntouched */
} kiriNewLink;

/* Of a region: its links are looked at; some, to a higher one, are made anew though both are not dirty. */
enum { KIRI_REGION_STALE = 1, KIRI_REGION_TOUCHED = 2 };

typedef struct kiriRegionPair {
    int32_t i, j;
} kiriRegionPair;

struct kiriLinkWork {
    bool running;                       /* an update is at hand: it waits for more quota */
    int32_t at;                         /* in `faces`: the next to look at; below 0 they are being found */
    int64_t due;                        /* items that are not paid yet */
    KIRI_ARRAY(uint8_t) marks;          /* a kiriFaceMark a face; all PASSED between updates */
    KIRI_ARRAY(uint8_t) stale;          /* of each region: KIRI_REGION_STALE... */
    KIRI_ARRAY(kiriRegionPair) touched; /* neither is dirty, but a region near the ends of a link of theirs is */
    KIRI_ARRAY(int32_t) faces;          /* border faces whose links are made anew */
    KIRI_ARRAY(int32_t) whole;          /* a connected stretch of them, in order, */
    KIRI_ARRAY(int32_t) stretch;        /* and the faces of the link at hand, in order */
    KIRI_ARRAY(kiriNewLink) made;
    KIRI_ARRAY(int32_t) order;         /* of what was made */
    KIRI_ARRAY(kiriLinkEnds) ends;     /* of kiriLinks.links, */
    KIRI_ARRAY(kiriLinkEnds) nextEnds; /* and of kiriLinks.next */
    KIRI_ARRAY(kiriRegionPair) pairs;  /* of kiriLinks.links: most are asked for nothing else; empty: not known */
    KIRI_ARRAY(kiriRegionPair) nextPairs;
    bool isTwin;                /* links, and their ends, are also in the room of the next ones, as `was` says */
    KIRI_ARRAY(int32_t) before; /* scratch: `was` of the links in force, */
    KIRI_ARRAY(int32_t) now;    /* and which one each is next; of those that are taken over */
    kiriSightEdges edges;       /* near the links that are made */
};

typedef struct kiriBorder {
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const kiriRegions* regions;
    const kiriSite* sites;
    int32_t siteCount;
    kiriLinkWork* work;
} kiriBorder;

/* A border face seen from the region with the lower index. */
typedef struct kiriBorderSide {
    int32_t x, y; /* its cells in regions i and j, i < j */
    int32_t i, j;
    int32_t axis;
    double sign; /* of the normal from i to j along the axis */
} kiriBorderSide;

kiriBorderSide kiriBorder_SideOf(const kiriBorder* border, int32_t face);

/* For kiriSort, context: the border. By square, axis, and the lowest triangles of the two cells: not by indices. No two
   faces share all of it. */
bool kiriBorder_IsFaceBefore(const void* context, int32_t a, int32_t b);

/* Adds the links of the stretch through a face, which is in none yet, to what was made. False for memory. */
bool kiriBorder_MakeLinksAt(const kiriBorder* border, int32_t face);

/* The four cells around a node of the grid, counter-clockwise from the lower left one, where faces join each to the
   next, and none is a sliver: no slit and no outline runs to the node. */
typedef struct kiriRing {
    int32_t cell[4];
    int32_t face[4]; /* between cell k and the next */
} kiriRing;

/* The ring around the lower or upper end of a face; false where there is none. */
bool kiriBorder_FindRing(const kiriBorder* border, int32_t face, bool upper, kiriRing* ring);

/* The ends of the stretch at hand, whose link has its tangent. `bent`: it is a part of a border that was split. */
kiriLinkEnds kiriBorder_FindEnds(const kiriBorder* border, const kiriLink* link, bool bent);

/* Does the stretch at hand run along slivers of cells beside a slit, or across the end of such ones? Their middles are
   off by half a square, and so is what region they are in: there is no such border. Across a narrow strip there is. */
bool kiriBorder_IsSliver(const kiriBorder* border);

/* Is no region dirty on which a link with these ends depends? They are as the grid has them. */
bool kiriBorder_IsUntouched(const kiriBorder* border, const kiriLinkEnds* ends);

/* Puts the ends where they are in the Euclidean metric, and with them the border, where the sites see it. */
void kiriBorder_MakeExact(const kiriBorder* border, kiriLink* link, kiriLinkEnds* ends);

/* Makes the link of the regions of two cells, i < j, where their border is so short that the grid has none; near: an
   end of a link of region i, in its first cell. False where there is no such border, or it is not seen. Depends on
   nothing but regions one step from the first cell. */
bool kiriBorder_MakeShort(const kiriBorder* border, const kiriLinkEnd* near, const int32_t cells[2], kiriNewLink* made);

/* The next step from the end's cell `which` to a region of higher index: from *at on, which starts at 0. */
bool kiriBorder_FindBeside(const kiriBorder* border, const kiriLinkEnd* end, int which, int32_t* at, int32_t cells[2]);

/* The shortest way from site i to site j over this border; over: a point of it on the grid's shortest way, between
   these cells. False where it cannot be told. */
bool kiriBorder_FindWay(const kiriBorder* border, const kiriLink* link, const kiriLinkEnds* ends,
                        const int32_t cells[2], kiriVec2 over, kiriWay* way);

/* The first link of a pair of regions, or of a later pair, in a row of links in order. */
int32_t kiriLink_FirstOfPair(const kiriLink* links, int32_t count, int32_t i, int32_t j);

/* Sets `outer`: the link has all else. */
void kiriLink_SetOuter(kiriLink* link, const kiriLinkEnds* ends);

/* The corners of links->next, from the ends of the links. False for memory. */
bool kiriBorder_MakeCorners(const kiriBorder* border, kiriLinks* links);

KIRI_C_END

#endif
