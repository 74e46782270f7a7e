/* The end of a border that is being found. Private to kiri_link_border.c and kiri_link_turn.c. */
#ifndef KIRI_LINK_END_WORK_H
#define KIRI_LINK_END_WORK_H

#include "kiri_link_work.h"

KIRI_C_BEGIN

enum { KIRI_NEAR_REGIONS = 24 }; /* more than meet within two squares of a point, but in theory */

/* The distance to a region's site, near an end: from the last turn of the way, or the site itself, and what is behind
   it. */
typedef struct kiriEndReach {
    kiriVec2 from; /* local m */
    double behind; /* m */
    bool isKnown, isHidden;
} kiriEndReach;

/* The regions near an end: the two of the link, and those one step from its cells there. */
typedef struct kiriNearRegions {
    int32_t region[KIRI_NEAR_REGIONS], cell[KIRI_NEAR_REGIONS];
    kiriEndReach reach[KIRI_NEAR_REGIONS];
    int32_t count;
} kiriNearRegions;

/* The points that are as far from one site as from the other: through their midpoint, along the tangent. */
typedef struct kiriBorderLine {
    kiriVec2 middle, normal, tangent;
} kiriBorderLine;

/* An end that is being found. `ahead` is 1 towards the tangent's head, -1 towards its tail; ways along the line are
   counted ahead. */
typedef struct kiriEndSearch {
    const kiriBorder* border;
    const kiriLinkEnd* grid; /* as the grid has it */
    kiriNearRegions near;
    kiriSight sight;
    kiriBorderLine line;
    double ahead;
    double least; /* m: what is as near is one point */
} kiriEndSearch;

static inline kiriVec2 kiriBorder_SiteAt(const kiriBorder* border, int32_t region)
{
    return border->sites[region].at;
}

/* Adds the regions near an end: that of region i first, then that of region j. */
void kiriNearRegions_AddAt(const kiriBorder* border, const kiriLinkEnd* end, kiriNearRegions* near);

kiriSight kiriNearRegions_Sight(const kiriBorder* border, const kiriNearRegions* near);

/* Finds a region's reach near a point; `turns`: also where the way turns. */
bool kiriNearRegions_FindReach(const kiriBorder* border, const kiriSight* sight, kiriNearRegions* near, int32_t k,
                               kiriVec2 at, bool turns);

/* A point of the stretch about a square's side before the end. */
kiriVec2 kiriEndSearch_PointBefore(const kiriEndSearch* s);

void kiriLinkEnd_SetOpen(kiriLinkEnd* end, kiriVec2 at);

/* The corner of three regions, by Newton's method from where the grid has it. The reaches come in the order of regions,
   so that all links of the corner find the same. */
bool kiriEndSearch_FindTurnedCorner(const kiriEndSearch* s, kiriLinkEnd* end);

/* Where the border comes to an edge: it starts from the edge where the grid has the end, or from the one that the
   border leads to beyond a corner that is none. */
bool kiriEndSearch_FindTurnedOpenEnd(kiriEndSearch* s, kiriLinkEnd* end);

KIRI_C_END

#endif
