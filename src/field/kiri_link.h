/* Links: the connected stretches of border between regions, where the sheet's elasticity is measured; and corners,
   where borders meet (README, "Mechanics"). */
#ifndef KIRI_LINK_H
#define KIRI_LINK_H

#include "kiri_region.h"
#include "kiri_path.h"

KIRI_C_BEGIN

/* One connected stretch of border between regions i < j; or, along a fold, the part of it that two regions share. */
typedef struct kiriLink {
    int32_t i, j;
    int32_t fold;      /* 0: a border; else index of the fold line + 1 */
    int32_t unused;    /* always 0: fills the padding */
    double hinge, rest, yield; /* of a fold: stiffness and yield moment, N m/rad and N m per m; rest angle, rad */
    double width;      /* W: the border from end to end, m */
    double outer;      /* part of W at open ends, m: each end at the outline or at a slit adds the way along the tangent
                          from the crossing to it; 0 where both ends are corners, to W where both are open */
    double beyond;     /* excess of the same ways over W if the crossing is beside the border, m */
    double square;     /* part of W up to ends where four regions meet, m */
    double lean;       /* tangent of the angle from the normal to the edge of the material, if one end is open; else 0 */
    double length;     /* l: the way from site i to site j through the border, m */
    double moment;     /* I: second moment of the border along the tangent about the centroid, m^3 */
    kiriVec2 span;     /* s: from site i to site j; l along the normal where the way between them is not straight */
    kiriVec2 normal;   /* unit, from i to j */
    kiriVec2 tangent;  /* unit, the normal turned left */
    kiriVec2 centroid; /* b: middle of the border, local m */
    kiriVec2 crossing; /* m: where the way crosses the border; the midpoint of the sites where the way is straight */
    /* The border as a staircase of cells, as regions have it: the sum of its faces' widths, each times its normal, m;
       and the sum of (p - b)_u, and of (p - b)_v, times the same, m^2. */
    kiriVec2 sum, spread[2];
} kiriLink;

/* Turn a vector of parts along normal and tangent to parts along and across the edge of the material, and back into the
   rest plane. */
static inline kiriVec2 kiriLink_AlongEdge(const kiriLink* link, kiriVec2 parts)
{
    double c = 1.0 / sqrt(1.0 + link->lean * link->lean), s = c * link->lean;
    return kiriVec2_Make(c * parts.x + s * parts.y, c * parts.y - s * parts.x);
}
static inline kiriVec2 kiriLink_FromEdge(const kiriLink* link, kiriVec2 parts)
{
    double c = 1.0 / sqrt(1.0 + link->lean * link->lean), s = c * link->lean;
    double along = c * parts.x - s * parts.y, across = c * parts.y + s * parts.x;
    return kiriVec2_Add(kiriVec2_Scale(along, link->normal), kiriVec2_Scale(across, link->tangent));
}

/* Orders links by their regions; folds come last, and in their order. */
static inline bool kiriLink_IsBefore(const kiriLink* a, const kiriLink* b)
{
    bool isFold = a->fold != 0;
    if (isFold != (b->fold != 0)) {
        return !isFold;
    }
    return a->i != b->i ? a->i < b->i : a->j != b->j ? a->j < b->j : a->fold < b->fold;
}

/* Sets stiffness and rest angle of the links of a fold. */
static inline void kiriLink_SetFolds(kiriLink* links, int32_t count, int32_t fold, double hinge, double rest)
{
    KIRI_TIMES(k, count) {
        if (links[k].fold == fold + 1) {
            links[k].hinge = hinge;
            links[k].rest = rest;
        }
    }
}

/* Returns the number of links of borders: links of folds come after them. */
static inline int32_t kiriLink_CountBorders(const kiriLink* links, int32_t count)
{
    while (count > 0 && links[count - 1].fold != 0) {
        --count;
    }
    return count;
}

/* Where three or four regions meet. It couples curvatures, and stretches, of different directions: the sum over its
   links of weight . (strains along normal and tangent) is the trace of the curvature, or of the strain. */
typedef struct kiriCorner {
    int32_t count;      /* of its links: 3 or 4 */
    int32_t link[4];    /* into `links`, ascending; those beyond count are KIRI_NONE */
    int32_t unused;     /* always 0: fills the padding */
    /* p_k = w_k / l_k N^-1 s_k, 1/m, N = sum of w_k / l_k s_k s_k^T over its links: s_k their spans, w_k their widths from
       the crossing to the corner. If no w_k is 0, the traces of even states load the borders as the plate does. */
    kiriVec2 weight[4];
    double area;        /* m^2, of the triangle or quadrangle of its sites */
} kiriCorner;

/* Where a border ends, in the first guess of the grid. */
typedef enum kiriEndKind {
    KIRI_END_OPEN,   /* at the outline, or at a slit */
    KIRI_END_CORNER, /* other regions meet there */
    KIRI_END_INNER   /* a border that was split goes on there */
} kiriEndKind;

enum { KIRI_CORNER_REGIONS = 4 };

/* One end of a border. The ends of links that meet in a corner are equal. */
typedef struct kiriLinkEnd {
    kiriEndKind kind;
    int32_t region[KIRI_CORNER_REGIONS]; /* regions that meet in a corner, ascending, then KIRI_NONE */
    int32_t cell[2];                     /* cells of regions i and j beside the border's last face */
    kiriVec2 at;                         /* local m */
    kiriVec2 look;                       /* a point of the material just before the end that the grid has */
    kiriVec2 edge;                       /* at an open end, the direction of the edge there, unit; 0: unknown */
    bool isExact;                        /* `at` is the end in the Euclidean metric, */
    bool isSeen;                         /* and both sites see it */
} kiriLinkEnd;

/* Both ends of a link: at the tail of its tangent, and at the head. */
typedef struct kiriLinkEnds {
    kiriLinkEnd end[2];
    bool isShort; /* the border is too short for the grid: MakeShortLink found it */
} kiriLinkEnds;

/* A link that an update made. Its key: regions i < j, then the lowest face. */
typedef struct kiriNewLink {
    kiriLink link;
    kiriLinkEnds ends;
    int32_t face; /* KIRI_NONE: the link is short, and the only one of its regions */
} kiriNewLink;

/* A border face, seen from the region with the lower index. */
typedef struct kiriBorderFace {
    int32_t face;
    int32_t region[2]; /* i < j */
    int32_t cell[2];   /* one in each region */
    int32_t axis;
    double sign;         /* direction along the axis of the normal from i to j */
    kiriStretch stretch; /* the part of its side that the face covers */
    bool isSliver;       /* its material is next to nothing: it does not say where a border ends */
} kiriBorderFace;

/* The part of a fold that a crease has in a square. */
typedef struct kiriFoldPart {
    double from, to;   /* m along the fold */
    int32_t region[2]; /* left and right of it */
} kiriFoldPart;

/* An update in progress. Private to kiri_link.c and to snapshots. */
typedef struct kiriLinkWork {
    bool running;                       /* the update waits for more quota */
    int32_t at;                         /* next item: a region, then the old links, then a face, then the merge */
    int64_t due;                        /* items done that the quota has not paid yet */
    kiriFlags marks;                    /* a mark for each face; all are zero between updates */
    kiriFlags stale;                    /* flags for each region */
    kiriIndices faces;                  /* border faces whose links are made */
    KIRI_ARRAY(kiriNewLink) made;       /* in no order */
    kiriIndices to;                     /* for each old link: index in `next`, or KIRI_NONE where it is made again */
    KIRI_ARRAY(kiriLinkEnds) ends;      /* for each link of kiriLinks.links */
    KIRI_ARRAY(kiriLinkEnds) nextEnds;  /* for each link of kiriLinks.next */
    kiriSightEdges edges;               /* cache, for the squares near the links that are made */
    kiriIndices order;                  /* scratch: faces of a stretch, or `made` by key */
    KIRI_ARRAY(kiriBorderFace) stretch; /* scratch: faces of the link that is being made, in order */
    KIRI_ARRAY(kiriFoldPart) parts;     /* scratch: of a fold */
    int32_t foldCount;                  /* folds when the update began */
} kiriLinkWork;

typedef struct kiriLinks {
    /* Sorted by key: (i, j), then the lowest face: by square, axis, and the lowest triangles of its cells. Then the
       links of folds, by (i, j) and fold. */
    KIRI_ARRAY(kiriLink) links;
    KIRI_ARRAY(kiriLink) next; /* result of kiriLinks_Update; Commit swaps */
    int32_t changed;           /* links of `next` that differ from the old ones */
    /* Index of the equal old link for each next link, after the commit for each link; KIRI_NONE where the link was
       made. Empty: unknown. */
    kiriIndices was;
    /* Sorted by their links. Where four regions meet, all four pairs of neighbours are linked. */
    KIRI_ARRAY(kiriCorner) corners;
    KIRI_ARRAY(kiriCorner) nextCorners; /* corners of `next` */
    kiriLinkWork* work;
} kiriLinks;

/* Makes `next` and `nextCorners` for the regions. Only links that a dirty region (regions->dirty) touches are computed;
   the others are copied from `links`. The result equals one from scratch to the bit. A link counts as 80 items.
   KIRI_MORE: call again before the regions change. KIRI_FAILED: out of memory, `links` is unchanged. */
kiriProgress kiriLinks_Update(kiriLinks* links, const kiriGrid* grid, const kiriRegions* regions, const kiriSite* sites,
                              int32_t siteCount, kiriQuota* quota);

/* Drops an update, also a finished one. */
void kiriLinks_Drop(kiriLinks* links);

/* Restarts an unfinished update, because more regions became dirty. */
void kiriLinks_BeginAgain(kiriLinks* links);

/* Copies the kept links and corners to `next` with new indices. No kept link joins a frame that is not kept. False when
   out of memory. */
bool kiriLinks_Keep(kiriLinks* links, kiriMemory* memory, const kiriKeep* kept, const kiriKeep* frames);

/* Swaps `next` and `links`. Cannot fail. */
void kiriLinks_Commit(kiriLinks* links);

KIRI_C_END

#endif
