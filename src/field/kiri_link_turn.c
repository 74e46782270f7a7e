/* Shortest ways that turn at corners of the material: how far sites are that a point does not see, and where borders
   end between such sites. */
#include "kiri_link_end_work.h"

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

bool kiriNearRegions_FindReach(const kiriBorder* border, const kiriSight* sight, kiriNearRegions* near, int32_t k,
                               kiriVec2 at, bool turns)
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

bool kiriEndSearch_FindTurnedCorner(const kiriEndSearch* s, kiriLinkEnd* end)
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

/* How much farther the site of region i is than that of region j. */
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

bool kiriEndSearch_FindTurnedOpenEnd(kiriEndSearch* s, kiriLinkEnd* end)
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
