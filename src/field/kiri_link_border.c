/* Exact borders. The grid says which stretches of border there are and what they end at; here a link gets the geometry
   of the Euclidean Voronoi diagram instead of that of a staircase of cells. */
#include "kiri_link_work.h"
#include "kiri_slit.h"

#include <string.h>

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
    double least; /* m: points nearer than this are one */
} kiriEndSearch;

static kiriVec2 kiriBorder_SiteAt(const kiriBorder* border, int32_t region)
{
    return border->sites[region].at;
}

/* ---- Regions near an end ----------------------------------------------------------------------------------------- */

static void AddRegion(const kiriBorder* border, kiriNearRegions* near, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < border->regions->field.owner.count);
    int32_t region = border->regions->field.owner.data[cell];
    for (int32_t k = 0; k < near->count; ++k) {
        if (near->region[k] == region) {
            return;
        }
    }
    if (near->count < KIRI_NEAR_REGIONS) {
        near->region[near->count] = region;
        near->cell[near->count] = cell;
        near->reach[near->count].isKnown = near->reach[near->count].isHidden = false;
        ++near->count;
    }
}

static void AddRegionsAround(const kiriBorder* border, kiriNearRegions* near, int32_t cell)
{
    kiriSteps steps;
    kiriGrid_GetSteps(border->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        AddRegion(border, near, steps.data[s].cell);
    }
}

/* Adds the regions near an end: region i first, then region j. */
static void kiriNearRegions_AddAt(const kiriBorder* border, const kiriLinkEnd* end, kiriNearRegions* near)
{
    AddRegion(border, near, end->cell[0]);
    AddRegion(border, near, end->cell[1]);
    AddRegionsAround(border, near, end->cell[0]);
    AddRegionsAround(border, near, end->cell[1]);
}

/* Those of links that are kept are: others may be of bytes that somebody made up. */
static bool AreCellsThere(const kiriGrid* grid, const kiriLinkEnd* end)
{
    bool areThere = true;
    for (int k = 0; areThere && k < 2; ++k) {
        areThere = end->cell[k] >= 0 && end->cell[k] < grid->cells.count && kiriGrid_IsCell(grid, end->cell[k]);
    }
    return areThere;
}

bool kiriBorder_IsUntouched(const kiriBorder* border, const kiriLinkEnds* ends)
{
    kiriNearRegions near;
    near.count = 0;
    if (!AreCellsThere(border->grid, &ends->end[0]) || !AreCellsThere(border->grid, &ends->end[1])) {
        return false;
    }
    kiriNearRegions_AddAt(border, &ends->end[0], &near);
    kiriNearRegions_AddAt(border, &ends->end[1], &near);
    for (int32_t k = 0; k < near.count; ++k) {
        if (border->regions->dirty.data[near.region[k]]) {
            return false;
        }
    }
    return near.count < KIRI_NEAR_REGIONS;
}

static kiriSight kiriNearRegions_Sight(const kiriBorder* border, const kiriNearRegions* near)
{
    return (kiriSight){ border->grid, border->mesh, border->regions->field.owner.data,
                        near->region, near->count,  &border->work->edges };
}

/* ---- Ways that turn ---------------------------------------------------------------------------------------------- */

/* The cell before this one on the shortest way from the site, or KIRI_NONE where the site's seed is nearer. */
static int32_t CellBefore(const kiriBorder* border, int32_t cell)
{
    const kiriField* field = &border->regions->field;
    int32_t region = field->owner.data[cell], distance = field->distance.data[cell];
    kiriSteps steps;
    kiriGrid_GetSteps(border->grid, cell, &steps);
    if (kiriSite_SeedAt(&border->sites[region], region, border->grid, border->mesh, cell).distance == distance) {
        return KIRI_NONE;
    }
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = steps.data[s];
        if (field->owner.data[step.cell] == region && field->distance.data[step.cell] + step.length == distance) {
            return step.cell;
        }
    }
    return KIRI_NONE;
}

/* Adds the corners along the shortest way on the grid from a cell to its site. */
static void AddTurnsAlong(const kiriBorder* border, const kiriSight* sight, int32_t cell, kiriTurns* turns)
{
    for (; cell != KIRI_NONE && !turns->isFull; cell = CellBefore(border, cell)) {
        kiriTurns_AddAround(turns, sight, cell);
    }
}

/* Does the site lie in the material of its cell? In a square that is divided it may lie in that of another, or beyond
   the outline: from there nothing is seen. */
static bool IsSiteInside(const kiriBorder* border, int32_t region)
{
    const kiriSite* site = &border->sites[region];
    return border->grid->whole.data[border->grid->cells.data[site->cell].square] ||
           kiriGrid_CellAt(border->grid, border->mesh, kiriMesh_Snap(border->mesh, site->at)) == site->cell;
}

/* No less than the true length of a way that is so long on the grid: that may cut a slit's end by a square, and starts
   and ends at the middles of cells. */
static double MostOf(const kiriBorder* border, int32_t length)
{
    return border->grid->side * (1.05 * length / KIRI_UNIT + 2.0);
}

/* Finds a region's reach near a point; `turns`: also where the way turns. */
static bool kiriNearRegions_FindReach(const kiriBorder* border, const kiriSight* sight, kiriNearRegions* near,
                                      int32_t k, kiriVec2 at, bool turns)
{
    kiriVec2 site = kiriBorder_SiteAt(border, near->region[k]);
    bool isInside = IsSiteInside(border, near->region[k]);
    kiriEndReach reach = { site, 0.0, isInside && kiriSight_IsClear(sight, site, at), false };
    if (!reach.isKnown && isInside && turns) {
        kiriTurns corners;
        kiriWay way;
        kiriTurns_Start(&corners, site, at, MostOf(border, border->regions->field.distance.data[near->cell[k]]));
        AddTurnsAlong(border, sight, near->cell[k], &corners);
        reach.isKnown = kiriWay_Find(&corners, sight, &way);
        if (reach.isKnown && way.turnCount > 0) {
            reach.from = way.turn[way.turnCount - 1];
            reach.behind = way.length - kiriVec2_Length(kiriVec2_Sub(at, reach.from));
        }
    }
    reach.isHidden = !reach.isKnown;
    near->reach[k] = reach;
    return reach.isKnown;
}

/* ---- Ends of a border -------------------------------------------------------------------------------------------- */

static kiriBorderLine LineBetween(kiriVec2 a, kiriVec2 b)
{
    kiriVec2 way = kiriVec2_Sub(b, a);
    kiriBorderLine line;
    line.middle = kiriVec2_Scale(0.5, kiriVec2_Add(a, b));
    double apart = kiriVec2_Length(way); /* 0: sites of two cells of one square; no line is needed then */
    line.normal = apart > 0.0 ? kiriVec2_Scale(1.0 / apart, way) : kiriVec2_Make(1.0, 0.0);
    line.tangent = kiriVec2_Make(-line.normal.y, line.normal.x);
    return line;
}

static kiriVec2 PointOn(const kiriBorderLine* line, double along)
{
    return kiriVec2_Add(line->middle, kiriVec2_Scale(along, line->tangent));
}

static double AlongLine(const kiriBorderLine* line, kiriVec2 p)
{
    return kiriVec2_Dot(kiriVec2_Sub(p, line->middle), line->tangent);
}

static const double kiriFarAhead = 1e30;

/* Does a region that the grid has at this end take part in it? */
static bool IsAtEnd(const kiriLinkEnd* end, int32_t region)
{
    for (int k = 0; k < KIRI_CORNER_REGIONS && end->kind == KIRI_END_CORNER; ++k) {
        if (end->region[k] == region) {
            return true;
        }
    }
    return false;
}

/* Finds how far the sites of the border are, and of others that the grid has at this end: they must be known. */
static bool FindReaches(kiriEndSearch* s)
{
    bool ok = true;
    for (int32_t k = 0; ok && k < s->near.count; ++k) {
        if (k < 2 || IsAtEnd(s->grid, s->near.region[k])) {
            ok = kiriNearRegions_FindReach(s->border, &s->sight, &s->near, k, s->grid->look, true);
        }
    }
    return ok;
}

/* A point of the stretch about a square's side before the end. */
static kiriVec2 kiriEndSearch_PointBefore(const kiriEndSearch* s)
{
    const kiriBorder* border = s->border;
    kiriVec2 best = { 0.0, 0.0 };
    double least = kiriFarAhead;
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        kiriVec2 middle = kiriGrid_Stretch(border->grid, border->mesh, border->work->stretch.data[k]).middle;
        double off = fabs(kiriVec2_Length(kiriVec2_Sub(middle, s->grid->at)) - border->grid->side);
        if (off < least) {
            least = off;
            best = middle;
        }
    }
    return best;
}

static void kiriLinkEnd_SetOpen(kiriLinkEnd* end, kiriVec2 at)
{
    memset(end->region, 0, sizeof(end->region));
    end->kind = KIRI_END_OPEN;
    end->at = at;
}

/* ---- Ends behind turns ------------------------------------------------------------------------------------------- */

/* How much farther one reach is than another; *slope: how that grows with the place. */
static double Farther(const kiriEndReach* a, const kiriEndReach* b, kiriVec2 at, kiriVec2* slope)
{
    kiriVec2 x = kiriVec2_Sub(at, a->from), y = kiriVec2_Sub(at, b->from);
    double p = kiriVec2_Length(x), q = kiriVec2_Length(y);
    *slope = kiriVec2_Sub(kiriVec2_Scale(p > 0.0 ? 1.0 / p : 0.0, x), kiriVec2_Scale(q > 0.0 ? 1.0 / q : 0.0, y));
    return a->behind + p - b->behind - q;
}

static kiriVec2 AtMost(kiriVec2 step, double most)
{
    double size = kiriVec2_Length(step);
    return size > most ? kiriVec2_Scale(most / size, step) : step;
}

/* The corner of three regions, by Newton's method from where the grid has it. The reaches come in the order of regions,
   so that all links of the corner find the same. */
static bool kiriEndSearch_FindTurnedCorner(const kiriEndSearch* s, kiriLinkEnd* end)
{
    const kiriEndReach* reach[3] = { NULL, NULL, NULL };
    double side = s->border->grid->side, off[2] = { 0.0, 0.0 };
    for (int32_t k = 0; k < s->near.count; ++k) {
        for (int r = 0; r < 3; ++r) {
            reach[r] = s->grid->region[r] == s->near.region[k] ? &s->near.reach[k] : reach[r];
        }
    }
    if (s->grid->region[3] != KIRI_NONE || reach[0] == NULL || reach[1] == NULL || reach[2] == NULL) {
        return false;
    }
    for (int round = 0; round < 12; ++round) {
        kiriVec2 slope[2];
        off[0] = Farther(reach[0], reach[1], end->at, &slope[0]);
        off[1] = Farther(reach[0], reach[2], end->at, &slope[1]);
        double det = slope[0].x * slope[1].y - slope[0].y * slope[1].x;
        if (!(fabs(det) > 1e-6)) {
            return false;
        }
        kiriVec2 step = { (slope[1].y * off[0] - slope[0].y * off[1]) / det,
                          (slope[0].x * off[1] - slope[1].x * off[0]) / det };
        end->at = kiriVec2_Sub(end->at, AtMost(step, 0.5 * side));
    }
    return fabs(off[0]) + fabs(off[1]) < s->least && kiriSight_IsClear(&s->sight, s->grid->look, end->at);
}

/* How much farther the site of region i is than the site of region j. */
static double FartherAt(const kiriEndSearch* s, kiriVec2 at)
{
    kiriVec2 slope;
    return Farther(&s->near.reach[0], &s->near.reach[1], at, &slope);
}

/* Where both are as far, between two points where one is and where the other is farther: by the rule of Illinois. */
static kiriVec2 FindBetweenOnEdge(const kiriEndSearch* s, kiriVec2 a, double farA, kiriVec2 b, double farB)
{
    kiriVec2 way = kiriVec2_Sub(b, a);
    double low = 0.0, high = 1.0;
    for (int round = 0; round < 24 && farB != farA; ++round) {
        double at = high - farB * (high - low) / (farB - farA);
        double far = FartherAt(s, kiriVec2_Add(a, kiriVec2_Scale(at, way)));
        if ((far > 0.0) != (farB > 0.0)) {
            low = high;
            farA = farB;
        } else {
            farA *= 0.5;
        }
        high = at;
        farB = far;
    }
    return kiriVec2_Add(a, kiriVec2_Scale(high, way));
}

/* Do both reaches see a point of an edge, a little to its left? Those that do not are found anew for there. */
static bool IsLipSeen(kiriEndSearch* s, kiriVec2 at, kiriVec2 way)
{
    double size = kiriVec2_Length(way), off = size > 0.0 ? 1e-3 * s->border->grid->side / size : 0.0;
    kiriVec2 beside = kiriVec2_Add(at, kiriVec2_Make(-off * way.y, off * way.x));
    bool seen = true;
    for (int32_t k = 0; k < 2; ++k) {
        if (!kiriSight_IsClear(&s->sight, s->near.reach[k].from, beside)) {
            seen = false;
            kiriNearRegions_FindReach(s->border, &s->sight, &s->near, k, beside, true);
        }
    }
    return seen;
}

/* From a point of an edge along the edges of the material, the way on which the difference of distances falls, to where
   there is none; up to three squares' sides. */
static bool WalkToEnd(const kiriEndSearch* s, int32_t* on, kiriVec2 at, kiriLinkEnd* end)
{
    const kiriMeshData* mesh = s->border->mesh;
    int32_t edge = *on;
    kiriVec2 slope, tail = kiriMesh_Local(mesh, mesh->vertices.data[kiriMesh_Tail(mesh, edge)].at);
    kiriVec2 head = kiriMesh_Local(mesh, kiriSight_HeadOf(mesh, edge));
    double far = Farther(&s->near.reach[0], &s->near.reach[1], at, &slope), left = 3.0 * s->border->grid->side;
    bool ahead = far * kiriVec2_Dot(slope, kiriVec2_Sub(head, tail)) < 0.0;
    for (int steps = 0; steps < 32 && left > 0.0; ++steps) {
        kiriVec2 goal = ahead ? head : tail;
        double goalFar = FartherAt(s, goal);
        if (far == 0.0 || (far > 0.0) != (goalFar > 0.0)) {
            kiriLinkEnd_SetOpen(end, far == 0.0 ? at : FindBetweenOnEdge(s, at, far, goal, goalFar));
            *on = edge;
            return true;
        }
        left -= kiriVec2_Length(kiriVec2_Sub(goal, at));
        at = goal;
        far = goalFar;
        edge = ahead ? kiriSight_EdgeAfter(mesh, edge) : kiriSight_EdgeBefore(mesh, edge);
        tail = kiriMesh_Local(mesh, mesh->vertices.data[kiriMesh_Tail(mesh, edge)].at);
        head = kiriMesh_Local(mesh, kiriSight_HeadOf(mesh, edge));
    }
    return false;
}

/* The same, with reaches that see the end: where those of the start do not, once more with those of the end. */
static bool FindEndOnEdge(kiriEndSearch* s, int32_t edge, kiriVec2 at, kiriLinkEnd* end)
{
    const kiriMeshData* mesh = s->border->mesh;
    for (int round = 0; round < 2; ++round) {
        if (!WalkToEnd(s, &edge, at, end)) {
            return false;
        }
        kiriVec2 tail = kiriMesh_Local(mesh, mesh->vertices.data[kiriMesh_Tail(mesh, edge)].at);
        if (IsLipSeen(s, end->at, kiriVec2_Sub(kiriMesh_Local(mesh, kiriSight_HeadOf(mesh, edge)), tail))) {
            return true;
        }
        if (!s->near.reach[0].isKnown || !s->near.reach[1].isKnown) {
            return false;
        }
        at = end->at;
    }
    return WalkToEnd(s, &edge, at, end);
}

/* A point of the border beside the stretch, and the border's direction ahead there. */
static bool FindBorderBefore(const kiriEndSearch* s, kiriVec2* at, kiriVec2* ahead)
{
    double side = s->border->grid->side, size = 0.0;
    kiriVec2 before = kiriEndSearch_PointBefore(s), slope = { 0.0, 0.0 };
    *at = before;
    for (int round = 0; round < 8; ++round) {
        double far = Farther(&s->near.reach[0], &s->near.reach[1], *at, &slope);
        size = kiriVec2_Length(slope);
        if (!(size > 1e-3)) {
            return false;
        }
        *at = kiriVec2_Sub(*at, AtMost(kiriVec2_Scale(far / (size * size), slope), 0.5 * side));
    }
    *ahead = kiriVec2_Scale(s->ahead / size, kiriVec2_Make(-slope.y, slope.x));
    return kiriVec2_Length(kiriVec2_Sub(*at, before)) < 2.0 * side && kiriSight_IsClear(&s->sight, before, *at);
}

/* Where the border comes to an edge: it starts from the edge where the grid has the end, or from the one that the
   border leads to beyond a corner that is none. */
static bool kiriEndSearch_FindTurnedOpenEnd(kiriEndSearch* s, kiriLinkEnd* end)
{
    kiriVec2 from = s->grid->look, ahead = kiriVec2_Sub(s->grid->at, s->grid->look), goal;
    kiriSightHit hit;
    goal = kiriVec2_Add(s->grid->at, ahead);
    if (s->grid->kind != KIRI_END_OPEN) {
        if (!FindBorderBefore(s, &from, &ahead)) {
            return false;
        }
        goal = kiriVec2_Add(from, kiriVec2_Scale(4.0 * s->border->grid->side, ahead));
    }
    return kiriSight_Cast(&s->sight, from, goal, &hit) == KIRI_SIGHT_EDGE &&
           FindEndOnEdge(s, hit.edge, kiriVec2_Add(from, kiriVec2_Scale(hit.share, kiriVec2_Sub(goal, from))), end);
}

/* ---- The way from site to site ----------------------------------------------------------------------------------- */

/* Does a site see the other, and both the border? */
static bool IsWaySeen(const kiriSight* sight, const kiriLinkEnds* ends, kiriVec2 a, kiriVec2 b, kiriVec2 over)
{
    bool isSeen = ends->end[0].isSeen && ends->end[1].isSeen;
    return kiriSight_IsClear(sight, a, b) &&
           (isSeen || (kiriSight_IsClear(sight, a, over) && kiriSight_IsClear(sight, b, over)));
}

bool kiriBorder_FindWay(const kiriBorder* border, const kiriLink* link, const kiriLinkEnds* ends,
                        const int32_t cells[2], kiriVec2 over, kiriWay* way)
{
    kiriNearRegions near;
    kiriTurns turns;
    kiriVec2 a = kiriBorder_SiteAt(border, link->i), b = kiriBorder_SiteAt(border, link->j);
    const int32_t* distance = border->regions->field.distance.data;
    near.count = 0;
    kiriTurns_Start(&turns, a, b, MostOf(border, distance[cells[0]] + KIRI_UNIT + distance[cells[1]]));
    kiriNearRegions_AddAt(border, &ends->end[0], &near);
    kiriNearRegions_AddAt(border, &ends->end[1], &near);
    kiriSight sight = kiriNearRegions_Sight(border, &near);
    if (!IsSiteInside(border, link->i) || !IsSiteInside(border, link->j)) {
        return false;
    }
    if (IsWaySeen(&sight, ends, a, b, over)) {
        way->turnCount = 0;
        way->length = kiriVec2_Length(kiriVec2_Sub(b, a));
        return true;
    }
    AddTurnsAlong(border, &sight, cells[0], &turns);
    AddTurnsAlong(border, &sight, cells[1], &turns);
    return kiriWay_Find(&turns, &sight, way);
}

/* ---- Ends that the sites see ------------------------------------------------------------------------------------- */

/* How far ahead the site of a region is as near as the two, if it is seen: beyond it is nearer. FAR where it never
   is. */
static double LimitBy(const kiriEndSearch* s, int32_t k)
{
    kiriVec2 a = kiriBorder_SiteAt(s->border, s->near.region[0]), b = kiriBorder_SiteAt(s->border, s->near.region[k]);
    kiriVec2 way = kiriVec2_Sub(b, a), half = kiriVec2_Sub(kiriVec2_Scale(0.5, kiriVec2_Add(a, b)), s->line.middle);
    double pace = s->ahead * kiriVec2_Dot(way, s->line.tangent);
    return !s->near.reach[k].isHidden && pace > 1e-9 * kiriVec2_Length(way) ? kiriVec2_Dot(half, way) / pace
                                                                            : kiriFarAhead;
}

/* Looks for the site of a region, unless that was done. */
static bool IsSiteSeen(kiriEndSearch* s, int32_t k)
{
    kiriEndReach* reach = &s->near.reach[k];
    if (!reach->isKnown && !reach->isHidden) {
        kiriNearRegions_FindReach(s->border, &s->sight, &s->near, k, s->grid->look, false);
    }
    return reach->isKnown;
}

/* Where ahead the first other region is as near, of those that are seen. */
static double FindLimit(kiriEndSearch* s)
{
    for (;;) {
        double limit = kiriFarAhead;
        int32_t first = KIRI_NONE;
        for (int32_t k = 2; k < s->near.count; ++k) {
            double by = LimitBy(s, k);
            first = by < limit ? k : first;
            limit = kiriMin(by, limit);
        }
        if (first == KIRI_NONE || IsSiteSeen(s, first)) {
            return limit;
        }
    }
}

/* Puts the end where the first other region is as near, and lists the regions that meet there. */
static void SetCornerAt(kiriEndSearch* s, double limit, kiriLinkEnd* end)
{
    int32_t count = 0;
    end->kind = KIRI_END_CORNER;
    end->at = PointOn(&s->line, s->ahead * limit);
    for (int32_t k = 0; k < s->near.count && count < KIRI_CORNER_REGIONS; ++k) {
        int32_t at = count;
        if (k < 2 || (LimitBy(s, k) <= limit + s->least && IsSiteSeen(s, k))) {
            for (; at > 0 && end->region[at - 1] > s->near.region[k]; --at) {
                end->region[at] = end->region[at - 1];
            }
            end->region[at] = s->near.region[k];
            ++count;
        }
    }
    for (; count < KIRI_CORNER_REGIONS; ++count) {
        end->region[count] = KIRI_NONE;
    }
}

/* Do both sites see the end, a little before it? They see the one that the grid has: an edge is another. */
static bool IsEndSeen(const kiriEndSearch* s, const kiriLinkEnd* end)
{
    double back = -1e-3 * s->border->grid->side * s->ahead;
    kiriVec2 at = kiriVec2_Add(end->at, kiriVec2_Scale(back, s->line.tangent));
    return kiriSight_IsClear(&s->sight, s->near.reach[0].from, at) &&
           kiriSight_IsClear(&s->sight, s->near.reach[1].from, at);
}

/* Along the line, from a point of it, to where the first other region is nearer, or to an edge before that; the sites
   see it. Another region may be nearer from the start: where both ends of a border say so, there is none. */
static bool FindSeenEnd(kiriEndSearch* s, kiriVec2 from, kiriLinkEnd* end)
{
    double start = s->ahead * AlongLine(&s->line, from), extent = s->border->mesh->step * KIRI_LATTICE;
    double limit = FindLimit(s), goal = kiriMin(limit, start + 2.0 * extent);
    SetCornerAt(s, limit, end);
    if (goal <= start) {
        return true;
    }
    kiriSightHit hit;
    kiriSightEnd what = kiriSight_Cast(&s->sight, from, PointOn(&s->line, s->ahead * goal), &hit);
    if (what == KIRI_SIGHT_EDGE) {
        kiriLinkEnd_SetOpen(end, PointOn(&s->line, s->ahead * (start + hit.share * (goal - start))));
        return IsEndSeen(s, end);
    }
    return what == KIRI_SIGHT_CLEAR && goal == limit;
}

/* From beside the stretch. */
static bool FindSeenEndOf(kiriEndSearch* s, kiriLinkEnd* end)
{
    kiriVec2 before = kiriEndSearch_PointBefore(s), from = PointOn(&s->line, AlongLine(&s->line, before));
    return kiriSight_IsClear(&s->sight, before, from) && FindSeenEnd(s, from, end);
}

/* ---- Slit ends --------------------------------------------------------------------------------------------------- */

/* Does the border run straight into the end of this slit, as if it were the slit's way on, and do both sites see it?
   Elsewhere on such a slit both are as near as well: it is no edge for the border to end at. */
static bool IsSlitAhead(const kiriEndSearch* s, const kiriSlitEnd* slit)
{
    double side = s->border->grid->side;
    double aside = kiriVec2_Dot(kiriVec2_Sub(slit->at, s->line.middle), s->line.normal);
    double back = s->ahead * kiriVec2_Dot(slit->along, s->line.tangent);
    kiriVec2 before = kiriVec2_Add(slit->at, kiriVec2_Scale(1e-3 * side, slit->along));
    return fabs(aside) < 0.02 * side && back < -0.9 &&
           kiriSight_IsClear(&s->sight, kiriBorder_SiteAt(s->border, s->near.region[0]), before) &&
           kiriSight_IsClear(&s->sight, kiriBorder_SiteAt(s->border, s->near.region[1]), before);
}

/* Such a slit end in a cell beside the stretch, up to three squares from the end that the grid has. */
static bool FindSlitEnd(const kiriEndSearch* s, kiriLinkEnd* end)
{
    const kiriBorder* border = s->border;
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        int32_t face = border->work->stretch.data[k];
        kiriVec2 off = kiriVec2_Sub(kiriGrid_Stretch(border->grid, border->mesh, face).middle, s->grid->at);
        bool isNear = kiriVec2_Length(off) < 3.0 * border->grid->side;
        for (int side = 0; isNear && side < 2; ++side) {
            kiriSlitEnd slit;
            if (kiriSlits_FindEndIn(border->grid, border->mesh, border->grid->faces.data[face].cell[side], &slit) &&
                IsSlitAhead(s, &slit)) {
                kiriLinkEnd_SetOpen(end, PointOn(&s->line, AlongLine(&s->line, slit.at)));
                return true;
            }
        }
    }
    return false;
}

/* ---- The link ---------------------------------------------------------------------------------------------------- */

/* Two points as near as this, of a square's side, are one; a border as short is none. */
static const double kiriBorderLeast = 1e-6;

/* Can the border be a straight line: are all sites seen, and the two of them apart? */
static bool IsStraightReach(const kiriEndSearch* s)
{
    if (kiriVec2_Length(kiriVec2_Sub(s->near.reach[0].from, s->near.reach[1].from)) <= s->least) {
        return false;
    }
    for (int32_t k = 0; k < s->near.count; ++k) {
        if (s->near.reach[k].isKnown && s->near.reach[k].behind > 0.0) {
            return false;
        }
    }
    return true;
}

/* The end of a border, at its tangent's tail (0) or head (1). False: it stays as the grid has it. */
static bool FindExactEnd(const kiriBorder* border, const kiriLink* link, int which, kiriLinkEnd* end)
{
    kiriEndSearch s;
    kiriLinkEnd found = *end;
    s.border = border;
    s.grid = end;
    s.ahead = which == 0 ? -1.0 : 1.0;
    s.least = kiriBorderLeast * border->grid->side;
    s.near.count = 0;
    kiriNearRegions_AddAt(border, end, &s.near);
    s.sight = kiriNearRegions_Sight(border, &s.near);
    s.line = LineBetween(kiriBorder_SiteAt(border, link->i), kiriBorder_SiteAt(border, link->j));
    if (end->kind == KIRI_END_INNER) {
        return false;
    }
    if (FindSlitEnd(&s, &found)) {
        found.isExact = found.isSeen = true;
    } else if (!FindReaches(&s)) {
        return false;
    } else if (IsStraightReach(&s)) {
        found.isExact = found.isSeen = FindSeenEndOf(&s, &found);
    } else {
        found.isExact = end->kind == KIRI_END_CORNER && kiriEndSearch_FindTurnedCorner(&s, &found);
        found.isExact = found.isExact || kiriEndSearch_FindTurnedOpenEnd(&s, &found);
    }
    /* Farther from where the grid has it the border would be one that the grid does not know. */
    found.isExact = found.isExact && kiriVec2_Length(kiriVec2_Sub(found.at, end->at)) < 3.0 * border->grid->side;
    if (found.isExact) {
        *end = found;
    }
    return found.isExact;
}

/* A straight border from end to end. */
static void SetStraight(kiriLink* link, const kiriLinkEnds* ends)
{
    kiriVec2 way = kiriVec2_Sub(ends->end[1].at, ends->end[0].at);
    link->width = kiriVec2_Length(way);
    link->tangent = kiriVec2_Scale(1.0 / link->width, way);
    link->normal = kiriVec2_Make(link->tangent.y, -link->tangent.x);
    link->centroid = kiriVec2_Scale(0.5, kiriVec2_Add(ends->end[0].at, ends->end[1].at));
    link->moment = link->width * link->width * link->width / 12.0;
}

/* What the grid takes for a border and is none. Its regions stay joined, by next to nothing: what hangs together on the
   grid is one piece. */
static void SetSpurious(const kiriBorder* border, kiriLink* link, kiriLinkEnds* ends)
{
    kiriBorderLine line = LineBetween(kiriBorder_SiteAt(border, link->i), kiriBorder_SiteAt(border, link->j));
    double along = 0.5 * (AlongLine(&line, ends->end[0].at) + AlongLine(&line, ends->end[1].at));
    double half = 0.5 * kiriBorderLeast * border->grid->side;
    for (int k = 0; k < 2; ++k) {
        ends->end[k].kind = KIRI_END_INNER;
        ends->end[k].at = PointOn(&line, k == 0 ? along - half : along + half);
    }
    SetStraight(link, ends);
}

void kiriBorder_MakeExact(const kiriBorder* border, kiriLink* link, kiriLinkEnds* ends)
{
    kiriLinkEnds grid = *ends;
    if (kiriBorder_IsSliver(border)) {
        SetSpurious(border, link, ends);
        return;
    }
    bool tail = FindExactEnd(border, link, 0, &ends->end[0]), head = FindExactEnd(border, link, 1, &ends->end[1]);
    double width = kiriVec2_Dot(kiriVec2_Sub(ends->end[1].at, ends->end[0].at), link->tangent);
    if (!tail && !head) {
        return;
    }
    if (width > kiriBorderLeast * border->grid->side) {
        SetStraight(link, ends);
    } else if (tail && head) {
        SetSpurious(border, link, ends);
    } else {
        *ends = grid;
    }
}

/* ---- Borders that the grid misses -------------------------------------------------------------------------------- */

/* A point between the limits of a line, or beside the one that there is; false where there is none. */
static bool FindBetween(kiriEndSearch* s, kiriVec2* at)
{
    double limit[2];
    for (int k = 0; k < 2; ++k) {
        s->ahead = k == 0 ? -1.0 : 1.0;
        limit[k] = FindLimit(s);
    }
    double inside = 0.25 * s->border->grid->side, low = -limit[0], high = limit[1];
    if (limit[0] == kiriFarAhead && limit[1] == kiriFarAhead) {
        return false;
    }
    low = limit[0] == kiriFarAhead ? high - 2.0 * inside : low;
    high = limit[1] == kiriFarAhead ? low + 2.0 * inside : high;
    *at = PointOn(&s->line, 0.5 * (low + high));
    return high - low > s->least;
}

static void StartShort(const kiriBorder* border, const kiriLinkEnd* near, const int32_t cells[2], kiriEndSearch* s)
{
    s->border = border;
    s->grid = near;
    s->least = kiriBorderLeast * border->grid->side;
    s->near.count = 0;
    AddRegion(border, &s->near, cells[0]);
    AddRegion(border, &s->near, cells[1]);
    AddRegionsAround(border, &s->near, cells[0]);
    s->sight = kiriNearRegions_Sight(border, &s->near);
    s->line = LineBetween(kiriBorder_SiteAt(border, s->near.region[0]), kiriBorder_SiteAt(border, s->near.region[1]));
}

bool kiriBorder_MakeShort(const kiriBorder* border, const kiriLinkEnd* near, const int32_t cells[2], kiriNewLink* made)
{
    kiriEndSearch s;
    kiriVec2 at;
    double most = 4.0 * border->grid->side;
    StartShort(border, near, cells, &s);
    memset(made, 0, sizeof(*made));
    made->ends.isShort = true;
    made->face = KIRI_NONE;
    made->link.i = s.near.region[0];
    made->link.j = s.near.region[1];
    if (!FindBetween(&s, &at) || kiriVec2_Length(kiriVec2_Sub(at, near->look)) > most ||
        !kiriSight_IsClear(&s.sight, near->look, at) || !IsSiteSeen(&s, 0) || !IsSiteSeen(&s, 1)) {
        return false;
    }
    for (int k = 0; k < 2; ++k) {
        kiriLinkEnd* end = &made->ends.end[k];
        s.ahead = k == 0 ? -1.0 : 1.0;
        memcpy(end->cell, cells, sizeof(end->cell));
        end->isExact = true;
        if (!FindSeenEnd(&s, at, end) || !IsEndSeen(&s, end)) {
            return false;
        }
    }
    SetStraight(&made->link, &made->ends);
    made->link.span = kiriVec2_Sub(kiriBorder_SiteAt(border, made->link.j), kiriBorder_SiteAt(border, made->link.i));
    made->link.length = kiriVec2_Length(made->link.span);
    made->link.crossing = s.line.middle;
    kiriLink_SetOuter(&made->link, &made->ends);
    return made->link.width < 0.5 * most;
}

bool kiriBorder_FindBeside(const kiriBorder* border, const kiriLinkEnd* end, int which, int32_t* at, int32_t cells[2])
{
    kiriSteps steps;
    kiriGrid_GetSteps(border->grid, end->cell[which], &steps);
    const int32_t* owner = border->regions->field.owner.data;
    cells[0] = end->cell[which];
    for (int32_t s = *at; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        cells[1] = steps.data[s].cell;
        if (owner[cells[1]] > owner[cells[0]]) {
            *at = s + 1;
            return true;
        }
    }
    return false;
}
