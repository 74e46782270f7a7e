#include "kiri_link.h"
#include "../core/kiri_array.h"
#include "kiri_site.h"

/* Links and corners are hashed and compared byte by byte. */
typedef char LinkHasNoPadding[sizeof(kiriLink) == 4 * sizeof(int32_t) + 26 * sizeof(double) ? 1 : -1];
typedef char CornerHasNoPadding[sizeof(kiriCorner) == 6 * sizeof(int32_t) + 9 * sizeof(double) ? 1 : -1];

/* Cost in items of the budget: a border cell whose steps are read, one whose faces are read, a kept link beside a dirty
   region, a link, and a face of its stretch. */
enum { STALE_ITEMS = 1, FACES_ITEMS = 1, KEPT_ITEMS = 4, LINK_ITEMS = 80, STRETCH_FACE_ITEMS = 5 };

/* Marks of a face. */
enum {
    FACE_PASSED, /* not listed, or already in a link */
    FACE_FOUND,
    FACE_GATHERED,
    FACE_BENT /* in a stretch that is split where its normal turns */
};

/* Flags of a region: it is dirty or beside a dirty one; and some of its links to higher regions are made again though
   both regions are clean. */
enum { REGION_STALE = 1, REGION_TOUCHED = 2 };

typedef struct LinkUpdate {
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriRegions* regions;
    const int32_t* owner; /* region of each cell */
    const kiriSite* sites;
    int32_t siteCount;
    kiriLinks* links;
    kiriLinkWork* work;
} LinkUpdate;

static bool IsStale(const LinkUpdate* u, int32_t region)
{
    KIRI_ASSERT(region >= 0 && region < u->siteCount);
    return (u->work->stale.data[region] & REGION_STALE) != 0;
}

static bool IsOfPair(const kiriLink* link, int32_t i, int32_t j)
{
    return link->i == i && link->j == j && link->fold == 0;
}

/* Returns the first link of a pair of regions, or of the next pair, in a sorted array. */
static int32_t FirstOfPair(const kiriLink* links, int32_t count, int32_t i, int32_t j)
{
    int32_t low;
    KIRI_ASSERT(i >= 0 && i < j);
    const kiriLink wanted = { .i = i, .j = j };
    KIRI_SEARCH(low, 0, count, kiriLink_IsBefore(&links[middle], &wanted));
    return low;
}

/* ---- Stretches of border ----------------------------------------------------------------------------------------- */

/* Cells with less than this share of a square, and faces with less of a side, are slivers beside an edge. */
static const double kiriSliver = 1e-3;

static bool IsSliver(const kiriGrid* grid, int32_t cell)
{
    return kiriGrid_Area(grid, cell) < kiriSliver * grid->side * grid->side;
}

/* Sets the key of a face: square, axis, and the lowest triangles of the two cells. It is unique and independent of
   indices. */
static void SetFaceKey(const kiriGrid* grid, int32_t face, int32_t key[4])
{
    const kiriFace* f = &grid->faces.data[face];
    const kiriCell *low = &grid->cells.data[f->cell[0]], *high = &grid->cells.data[f->cell[1]];
    key[0] = high->square;
    key[1] = kiriFace_Axis(f);
    key[2] = low->triangle;
    key[3] = high->triangle;
}

static bool IsFaceBefore(const void* grid, int32_t a, int32_t b)
{
    int32_t x[4], y[4];
    SetFaceKey(grid, a, x);
    SetFaceKey(grid, b, y);
    int k = 0;
    while (k < 3 && x[k] == y[k]) {
        ++k;
    }
    return x[k] < y[k];
}

/* Returns a border face without its stretch. */
static kiriBorderFace BorderFaceOf(const LinkUpdate* u, int32_t face)
{
    KIRI_ASSERT_HAS(u->grid->faces, face);
    const kiriFace* f = &u->grid->faces.data[face];
    KIRI_ASSERT(f->cell[0] != KIRI_NONE && u->owner[f->cell[0]] != u->owner[f->cell[1]]);
    int32_t low = u->owner[f->cell[0]] < u->owner[f->cell[1]] ? 0 : 1;
    int32_t x = f->cell[low], y = f->cell[1 - low];
    KIRI_ASSERT(u->owner[x] != KIRI_NONE);
    return (kiriBorderFace){ .face = face,
                             .region = { u->owner[x], u->owner[y] },
                             .cell = { x, y },
                             .axis = kiriFace_Axis(f),
                             .sign = low == 0 ? 1.0 : -1.0 };
}

/* Adds the faces of a cell that continue the stretch of `from`, and gives them the mark `next`. */
static bool GatherFacesAt(const LinkUpdate* u, const kiriBorderFace* from, int32_t cell, uint8_t mark, uint8_t next)
{
    KIRI_ASSERT_HAS(u->regions->onBorder, cell);
    bool may = u->regions->onBorder.data[cell] && u->owner[cell] == from->region[0];
    int32_t f = may ? u->grid->cells.data[cell].firstFace : KIRI_NONE;
    for (; f != KIRI_NONE; f = kiriFace_Next(&u->grid->faces.data[f], cell)) {
        if (u->work->marks.data[f] == mark) {
            kiriBorderFace face = BorderFaceOf(u, f);
            bool sameWay = face.axis == from->axis && face.sign == from->sign;
            if (face.cell[0] == cell && face.region[1] == from->region[1] && (sameWay || mark != FACE_BENT) &&
                (face.cell[1] == from->cell[1] ||
                 kiriGrid_HasStep(u->grid, face.cell[1], from->cell[1], KIRI_DIAGONAL))) {
                u->work->marks.data[f] = next;
                if (!kiriArray_Push(u->memory, &u->work->order, f)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/* Gathers the connected stretch of faces with the mark of this one, in order; their mark becomes `next`. */
static bool GatherStretch(const LinkUpdate* u, int32_t face, uint8_t next)
{
    kiriLinkWork* work = u->work;
    kiriIndices* found = &work->order;
    KIRI_ASSERT_HAS(work->marks, face);
    uint8_t mark = work->marks.data[face];
    KIRI_ASSERT(mark != next);
    found->count = 0;
    work->marks.data[face] = next;
    bool ok = kiriArray_Push(u->memory, found, face);
    KIRI_TIMES_WHILE(ok, k, found->count) {
        kiriBorderFace from = BorderFaceOf(u, found->data[k]);
        ok = GatherFacesAt(u, &from, from.cell[0], mark, next);
        KIRI_EACH_STEP(step, u->grid, from.cell[0], KIRI_DIAGONAL) {
            ok = ok && GatherFacesAt(u, &from, step.cell, mark, next);
        }
    }
    if (!ok || !kiriArray_Resize(u->memory, &work->stretch, found->count)) {
        return false;
    }
    kiriSort(found->data, found->count, IsFaceBefore, u->grid);
    KIRI_EACH_INDEX(k, *found) {
        kiriBorderFace* f = &work->stretch.data[k];
        *f = BorderFaceOf(u, found->data[k]);
        f->stretch = kiriGrid_Stretch(u->grid, f->face);
        f->isSliver = f->stretch.width < kiriSliver * u->grid->side || IsSliver(u->grid, f->cell[0]) ||
                      IsSliver(u->grid, f->cell[1]);
    }
    return true;
}

/* ---- Ends as the grid has them ----------------------------------------------------------------------------------- */

static void SetEnd(kiriLinkEnd* end, kiriEndKind kind, kiriVec2 at)
{
    end->kind = kind;
    end->at = at;
    end->edge = kiriVec2_Make(0.0, 0.0);
    KIRI_TIMES(k, KIRI_CORNER_REGIONS) {
        end->region[k] = KIRI_NONE;
    }
}

/* Adds a region to those that meet in a corner, ascending and each once. There is room. */
static void AddEndRegion(kiriLinkEnd* end, int32_t region)
{
    int at = 0;
    while (at < KIRI_CORNER_REGIONS && end->region[at] != KIRI_NONE && end->region[at] < region) {
        ++at;
    }
    KIRI_ASSERT(at < KIRI_CORNER_REGIONS);
    if (end->region[at] != region) {
        KIRI_ASSERT(end->region[KIRI_CORNER_REGIONS - 1] == KIRI_NONE);
        memmove(&end->region[at + 1], &end->region[at], sizeof(region) * (KIRI_CORNER_REGIONS - 1 - at));
        end->region[at] = region;
    }
}

/* Finds the four cells around a node of the grid, the lower or upper end of a face, in a circle from the face's cells
   on. Faces join each to the next, and none is a sliver: no slit and no outline runs to the node. Where slits leave
   more than one ring the first in the order of cells counts, which is the order of steps. */
static bool FindRing(const LinkUpdate* u, const kiriFace* face, bool upper, int32_t ring[4])
{
    const kiriGrid* grid = u->grid;
    int axis = 1 - kiriFace_Axis(face), way = upper ? 1 : -1;
    if (IsSliver(grid, face->cell[0]) || IsSliver(grid, face->cell[1])) {
        return false;
    }
    kiriSteps a = kiriGrid_GetSteps(grid, face->cell[0]), b = kiriGrid_GetSteps(grid, face->cell[1]);
    KIRI_TIMES(s, a.end[0]) {
        KIRI_TIMES(t, b.end[0]) {
            kiriStep to = kiriSteps_At(&a, s), beside = kiriSteps_At(&b, t);
            if ((axis == 0 ? to.u : to.v) == way && (axis == 0 ? beside.u : beside.v) == way &&
                kiriGrid_HasStep(grid, to.cell, beside.cell, KIRI_STRAIGHT) && !IsSliver(grid, to.cell) &&
                !IsSliver(grid, beside.cell)) {
                ring[0] = face->cell[0];
                ring[1] = face->cell[1];
                ring[2] = beside.cell;
                ring[3] = to.cell;
                return true;
            }
        }
    }
    return false;
}

/* Finds how the border ends at one end of a face; false where it goes on. */
static bool FindBorderEnd(const LinkUpdate* u, const kiriBorderFace* face, bool upper, bool isPart, kiriLinkEnd* end)
{
    int32_t ring[4], between = 0;
    kiriVec2 middle = face->stretch.middle;
    double half = upper ? 0.5 * face->stretch.width : -0.5 * face->stretch.width;
    KIRI_CLEAR(end);
    memcpy(end->cell, face->cell, sizeof(end->cell));
    SetEnd(end, KIRI_END_OPEN,
           kiriVec2_Add(middle, face->axis == 0 ? kiriVec2_Make(0.0, half) : kiriVec2_Make(half, 0.0)));
    end->look = kiriVec2_AddScaled(end->at, 1e-3, kiriVec2_Sub(middle, end->at));
    if (!FindRing(u, &u->grid->faces.data[face->face], upper, ring)) {
        return true;
    }
    KIRI_TIMES(k, 4) {
        int32_t a = u->owner[ring[k]], b = u->owner[ring[(k + 1) % 4]];
        between += kiriMin(a, b) == face->region[0] && kiriMax(a, b) == face->region[1];
    }
    int32_t upperRight = u->grid->cells.data[ring[upper ? 2 : 1]].square;
    kiriVec2 node = kiriMesh_Local(u->grid->mesh, kiriSquares_Corner(&u->grid->mesh->squares, upperRight));
    SetEnd(end, between == 1 ? KIRI_END_CORNER : KIRI_END_INNER, node);
    KIRI_TIMES_WHILE(between == 1, k, 4) {
        AddEndRegion(end, u->owner[ring[k]]);
    }
    return between == 1 || isPart;
}

/* Returns true if the border has only slivers. Otherwise slivers do not determine its ends. */
static bool HasOnlySlivers(const LinkUpdate* u)
{
    KIRI_EACH(const kiriBorderFace, face, u->work->stretch) {
        if (!face->isSliver) {
            return false;
        }
    }
    return true;
}

/* Finds the ends of the stretch: the outermost along the tangent. `isPart`: the border was split. */
static kiriLinkEnds FindEnds(const LinkUpdate* u, const kiriLink* link, bool isPart)
{
    kiriLinkEnds ends = { 0 };
    double low = 0.0, high = 0.0;
    bool any = false, takesAll = HasOnlySlivers(u);
    KIRI_TIMES(k, 2) { /* a border that closes on itself has no other */
        SetEnd(&ends.end[k], KIRI_END_INNER, link->centroid);
        memcpy(ends.end[k].cell, u->work->stretch.data[0].cell, sizeof(ends.end[k].cell));
    }
    KIRI_TIMES(k, 2 * u->work->stretch.count) {
        kiriLinkEnd end;
        const kiriBorderFace* face = &u->work->stretch.data[k / 2];
        if ((takesAll || !face->isSliver) && FindBorderEnd(u, face, k % 2 != 0, isPart, &end)) {
            double along = kiriVec2_Dot(kiriVec2_Sub(end.at, link->centroid), link->tangent);
            if (!any || along < low) {
                ends.end[0] = end;
                low = along;
            }
            if (!any || along > high) {
                ends.end[1] = end;
                high = along;
            }
            any = true;
        }
    }
    return ends;
}

/* ---- Regions near an end, and how far their sites are ------------------------------------------------------------

   From here on a link gets the geometry of the Euclidean Voronoi diagram instead of a staircase of cells. The grid says
   which stretches of border exist and where they end. */

enum { KIRI_NEAR_REGIONS = 24 }; /* in practice fewer meet within two squares of a point */

/* The regions of a link, i and j, then those one step from its cells at an end. */
typedef struct NearRegions {
    int32_t region[KIRI_NEAR_REGIONS], cell[KIRI_NEAR_REGIONS];
    int32_t count;
} NearRegions;

/* The distance from an end to a region's site: straight to `from`, the site or the last turn of the way, and then
   `behind`. */
typedef struct SiteReach {
    kiriVec2 from; /* local m */
    double behind; /* m */
    enum { REACH_UNKNOWN, REACH_KNOWN, REACH_HIDDEN } state;
} SiteReach;

/* The points that are as far from one site as from another: through their midpoint, along the tangent. */
typedef struct BorderLine {
    kiriVec2 middle, normal, tangent;
} BorderLine;

/* Search for an end. Distances along the line are counted ahead. */
typedef struct EndSearch {
    const LinkUpdate* u;
    const kiriLinkEnd* grid; /* the end that the grid has */
    NearRegions near;
    SiteReach reach[KIRI_NEAR_REGIONS];
    kiriSight sight;
    BorderLine line;
    double ahead; /* 1 towards the tangent's head, -1 towards its tail */
    double least; /* m: points nearer than this are one */
} EndSearch;

static kiriVec2 SiteAt(const LinkUpdate* u, int32_t region)
{
    KIRI_ASSERT(region >= 0 && region < u->siteCount);
    return u->sites[region].at;
}

static void AddRegion(const LinkUpdate* u, NearRegions* near, int32_t cell)
{
    KIRI_ASSERT_HAS(u->regions->field.owner, cell);
    KIRI_EACH_INDEX(k, *near) {
        if (near->region[k] == u->owner[cell]) {
            return;
        }
    }
    if (near->count < KIRI_NEAR_REGIONS) {
        near->region[near->count] = u->owner[cell];
        near->cell[near->count++] = cell;
    }
}

/* Adds the regions of two cells, then those one step from the first or from both. */
static void AddRegionsAt(const LinkUpdate* u, NearRegions* near, const int32_t cells[2], int around)
{
    AddRegion(u, near, cells[0]);
    AddRegion(u, near, cells[1]);
    KIRI_TIMES(k, around) {
        KIRI_EACH_STEP(step, u->grid, cells[k], KIRI_KNIGHT) {
            AddRegion(u, near, step.cell);
        }
    }
}

static kiriSight SightOf(const LinkUpdate* u, const NearRegions* near)
{
    return (kiriSight){ u->grid, u->owner, near->region, near->count, &u->work->edges };
}

/* Returns the cell before this one on the shortest way from the site, or KIRI_NONE where the site's seed is nearer. */
static int32_t CellBefore(const LinkUpdate* u, int32_t cell)
{
    const kiriField* field = &u->regions->field;
    int32_t region = field->owner.data[cell], distance = field->distance.data[cell];
    KIRI_ASSERT(region != KIRI_NONE && distance != KIRI_FAR);
    if (kiriSite_SeedAt(&u->sites[region], region, u->grid, cell).distance == distance) {
        return KIRI_NONE;
    }
    KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
        if (field->owner.data[step.cell] == region && field->distance.data[step.cell] + step.length == distance) {
            return step.cell;
        }
    }
    return KIRI_NONE;
}

/* Adds the corners along the shortest way on the grid from a cell to its site. */
static void AddTurnsAlong(const LinkUpdate* u, const kiriSight* sight, int32_t cell, kiriTurns* turns)
{
    for (; cell != KIRI_NONE && !turns->isFull; cell = CellBefore(u, cell)) {
        kiriTurns_AddAround(turns, sight, cell);
    }
}

/* Does the site lie in the material of its cell? In a divided square it may lie in another cell's, or beyond the
   outline: nothing is seen from there. */
static bool IsSiteInside(const LinkUpdate* u, int32_t region)
{
    const kiriSite* site = &u->sites[region];
    const kiriMeshData* mesh = u->grid->mesh;
    int32_t square = u->grid->cells.data[site->cell].square;
    bool isInside = u->grid->whole.data[square];
    KIRI_EACH_NODE(node, &mesh->squares, square) {
        isInside = isInside || (u->grid->nodeCell.data[node] == site->cell &&
                                kiriMesh_Holds(mesh, mesh->squares.nodes.data[node].triangle, kiriMesh_Snap(mesh, site->at), 0));
    }
    return isInside;
}

/* Returns an upper bound, m, of the true length of a way with this length on the grid, which may cut the end of a slit
   by a square, and starts and ends at the middles of cells. */
static double MostOf(const LinkUpdate* u, int32_t length)
{
    return u->grid->side * (1.05 * length / KIRI_UNIT + 2.0);
}

/* Finds the distance from a point to the site of near region k; with `turns` also where the way turns. */
static bool FindReach(EndSearch* s, int32_t k, kiriVec2 at, bool turns)
{
    const LinkUpdate* u = s->u;
    int32_t region = s->near.region[k], cell = s->near.cell[k];
    kiriVec2 site = SiteAt(u, region);
    bool isInside = IsSiteInside(u, region), isKnown = isInside && kiriSight_IsClear(&s->sight, site, at);
    s->reach[k] = (SiteReach){ site, 0.0, REACH_HIDDEN };
    if (!isKnown && isInside && turns) {
        kiriTurns corners;
        kiriWay way;
        kiriTurns_Start(&corners, site, at, MostOf(u, u->regions->field.distance.data[cell]));
        AddTurnsAlong(u, &s->sight, cell, &corners);
        isKnown = kiriWay_Find(&corners, &s->sight, &way);
        if (isKnown && way.turnCount > 0) {
            s->reach[k].from = way.turn[way.turnCount - 1];
            s->reach[k].behind = way.length - kiriVec2_Distance(at, s->reach[k].from);
        }
    }
    s->reach[k].state = isKnown ? REACH_KNOWN : REACH_HIDDEN;
    return isKnown;
}

static BorderLine LineBetween(kiriVec2 a, kiriVec2 b)
{
    kiriVec2 way = kiriVec2_Sub(b, a);
    double apart = kiriVec2_Length(way); /* 0: sites of two cells of one square; no line is needed then */
    kiriVec2 normal = apart > 0.0 ? kiriVec2_Scale(1.0 / apart, way) : kiriVec2_Make(1.0, 0.0);
    return (BorderLine){ kiriVec2_Scale(0.5, kiriVec2_Add(a, b)), normal, kiriVec2_Left(normal) };
}

static kiriVec2 PointOn(const BorderLine* line, double along)
{
    return kiriVec2_AddScaled(line->middle, along, line->tangent);
}

static double AlongLine(const BorderLine* line, kiriVec2 p)
{
    return kiriVec2_Dot(kiriVec2_Sub(p, line->middle), line->tangent);
}

/* Two points as near as this, in sides of a square, are one; a border as short is none. */
static const double kiriBorderLeast = 1e-6;

static void StartEndSearch(EndSearch* s, const LinkUpdate* u, const kiriLinkEnd* grid, const int32_t cells[2],
                           int around)
{
    s->u = u;
    s->grid = grid;
    s->least = kiriBorderLeast * u->grid->side;
    s->near.count = 0;
    AddRegionsAt(u, &s->near, cells, around);
    KIRI_EACH_INDEX(k, s->near) {
        s->reach[k].state = REACH_UNKNOWN;
    }
    s->sight = SightOf(u, &s->near);
    s->line = LineBetween(SiteAt(u, s->near.region[0]), SiteAt(u, s->near.region[1]));
}

/* Returns the head or the tail of a half-edge, local m. */
static kiriVec2 EdgeEnd(const kiriMeshData* mesh, int32_t edge, bool isHead)
{
    return kiriMesh_Local(mesh, isHead ? kiriMesh_HeadAt(mesh, edge) : kiriMesh_TailAt(mesh, edge));
}

/* Sets an open end on an edge of the material. */
static void SetOpenEnd(const LinkUpdate* u, kiriLinkEnd* end, kiriVec2 at, int32_t edge)
{
    kiriVec2 way = kiriVec2_Sub(EdgeEnd(u->grid->mesh, edge, true), EdgeEnd(u->grid->mesh, edge, false));
    SetEnd(end, KIRI_END_OPEN, at);
    end->edge = kiriVec2_Normalize(way);
}

/* ---- Ends that the sites see ------------------------------------------------------------------------------------- */

static const double kiriFarAhead = 1e30;

/* Returns how far ahead the site of a region is as near as the two, if it is not hidden; beyond that it is nearer. A site
   in a row with the two, between them, is nearer all along. */
static double LimitBy(const EndSearch* s, int32_t k)
{
    kiriVec2 a = SiteAt(s->u, s->near.region[0]), b = SiteAt(s->u, s->near.region[k]);
    kiriVec2 way = kiriVec2_Sub(b, a), half = kiriVec2_Sub(kiriVec2_Scale(0.5, kiriVec2_Add(a, b)), s->line.middle);
    double pace = s->ahead * kiriVec2_Dot(way, s->line.tangent), least = 1e-9 * kiriVec2_Length(way);
    double farther = kiriVec2_Dot(half, way);
    bool isFar = s->reach[k].state == REACH_HIDDEN || pace < (farther > 0.0 ? least : -least);
    return isFar ? kiriFarAhead : farther / kiriMax(pace, least);
}

/* Is the site of a region seen from before the end? */
static bool IsSiteSeen(EndSearch* s, int32_t k)
{
    return s->reach[k].state == REACH_UNKNOWN ? FindReach(s, k, s->grid->look, false)
                                              : s->reach[k].state == REACH_KNOWN;
}

/* Returns where ahead the first other region is as near, of those that are seen. */
static double FindFirstLimit(EndSearch* s)
{
    for (;;) {
        double limit = kiriFarAhead;
        int32_t first = KIRI_NONE;
        KIRI_FROM_TO(k, 2, s->near.count) {
            double by = LimitBy(s, k);
            first = by < limit ? k : first;
            limit = kiriMin(by, limit);
        }
        if (first == KIRI_NONE || IsSiteSeen(s, first)) {
            return limit;
        }
    }
}

/* Do both sites see the end from a little before it? At the end itself an edge may hide it. */
static bool IsEndSeen(const EndSearch* s, const kiriLinkEnd* end)
{
    double back = -1e-3 * s->u->grid->side * s->ahead;
    kiriVec2 at = kiriVec2_AddScaled(end->at, back, s->line.tangent);
    return kiriSight_IsClear(&s->sight, s->reach[0].from, at) && kiriSight_IsClear(&s->sight, s->reach[1].from, at);
}

/* Follows the line from one of its points to the place where another region becomes nearer, or to an edge before that;
   the sites must see it. If another region is nearer from the start at both ends, the border does not exist. */
static bool FindSeenEnd(EndSearch* s, kiriVec2 from, kiriLinkEnd* end)
{
    double start = s->ahead * AlongLine(&s->line, from), extent = s->u->grid->mesh->step * KIRI_LATTICE;
    double limit = FindFirstLimit(s), goal = kiriMin(limit, start + 2.0 * extent);
    SetEnd(end, KIRI_END_CORNER, PointOn(&s->line, s->ahead * limit));
    KIRI_EACH_INDEX_WHILE(end->region[KIRI_CORNER_REGIONS - 1] == KIRI_NONE, k, s->near) {
        if (k < 2 || (LimitBy(s, k) <= limit + s->least && IsSiteSeen(s, k))) {
            AddEndRegion(end, s->near.region[k]);
        }
    }
    if (goal <= start) {
        return true;
    }
    kiriSightHit hit;
    kiriSightEnd met = kiriSight_Cast(&s->sight, from, PointOn(&s->line, s->ahead * goal), &hit);
    if (met == KIRI_SIGHT_EDGE) {
        SetOpenEnd(s->u, end, PointOn(&s->line, s->ahead * (start + hit.share * (goal - start))), hit.edge);
        return IsEndSeen(s, end);
    }
    return met == KIRI_SIGHT_CLEAR && goal == limit;
}

/* Returns a point of the stretch about a square's side before the end. */
static kiriVec2 PointBefore(const EndSearch* s)
{
    kiriVec2 best = { 0 };
    double least = kiriFarAhead;
    KIRI_EACH(const kiriBorderFace, face, s->u->work->stretch) {
        kiriVec2 middle = face->stretch.middle;
        double off = fabs(kiriVec2_Distance(middle, s->grid->at) - s->u->grid->side);
        if (off < least) {
            least = off;
            best = middle;
        }
    }
    return best;
}

/* Finds a slit that ends in a cell beside the stretch, up to three squares from the end that the grid has. The border
   runs straight into it, as if it were the slit's way on, and both sites see that. Elsewhere on such a slit both sites
   are as near as well, so it is not an edge where the border ends. */
static bool FindSlitEnd(const EndSearch* s, kiriLinkEnd* end)
{
    const LinkUpdate* u = s->u;
    double side = u->grid->side;
    KIRI_TIMES(k, 2 * u->work->stretch.count) {
        const kiriBorderFace* face = &u->work->stretch.data[k / 2];
        int32_t looks = 0;
        kiriSlitEnd slit;
        if (kiriVec2_Distance(face->stretch.middle, s->grid->at) < 3.0 * side &&
            kiriSlits_FindEndIn(u->grid, u->grid->faces.data[face->face].cell[k % 2], &slit, &looks)) {
            double aside = kiriVec2_Dot(kiriVec2_Sub(slit.at, s->line.middle), s->line.normal);
            double back = s->ahead * kiriVec2_Dot(slit.along, s->line.tangent);
            kiriVec2 before = kiriVec2_AddScaled(slit.at, 1e-3 * side, slit.along);
            if (fabs(aside) < 0.02 * side && back < -0.9 &&
                kiriSight_IsClear(&s->sight, SiteAt(u, s->near.region[0]), before) &&
                kiriSight_IsClear(&s->sight, SiteAt(u, s->near.region[1]), before)) {
                SetEnd(end, KIRI_END_OPEN, PointOn(&s->line, AlongLine(&s->line, slit.at)));
                return true;
            }
        }
    }
    return false;
}

/* ---- Ends behind turns ------------------------------------------------------------------------------------------- */

/* Returns how much farther one site is than another; *slope: how that grows with the place. */
static double Farther(const SiteReach* a, const SiteReach* b, kiriVec2 at, kiriVec2* slope)
{
    kiriVec2 x = kiriVec2_Sub(at, a->from), y = kiriVec2_Sub(at, b->from);
    *slope = kiriVec2_Sub(kiriVec2_Normalize(x), kiriVec2_Normalize(y));
    return a->behind + kiriVec2_Length(x) - b->behind - kiriVec2_Length(y);
}

static kiriVec2 AtMost(kiriVec2 step, double most)
{
    double size = kiriVec2_Length(step);
    return size > most ? kiriVec2_Scale(most / size, step) : step;
}

/* Finds the corner of three regions by Newton's method, from where the grid has it. Reaches are taken in the order of
   regions, so that all links of the corner find the same. */
static bool FindTurnedCorner(const EndSearch* s, kiriLinkEnd* end)
{
    const SiteReach* reach[3] = { 0 };
    double off[2] = { 0 };
    KIRI_EACH_INDEX(k, s->near) {
        KIRI_TIMES(r, 3) {
            reach[r] = s->grid->region[r] == s->near.region[k] ? &s->reach[k] : reach[r];
        }
    }
    if (s->grid->region[3] != KIRI_NONE || reach[0] == NULL || reach[1] == NULL || reach[2] == NULL) {
        return false;
    }
    KIRI_TIMES(round, 12) {
        kiriVec2 slope[2];
        off[0] = Farther(reach[0], reach[1], end->at, &slope[0]);
        off[1] = Farther(reach[0], reach[2], end->at, &slope[1]);
        double det = kiriVec2_Cross(slope[0], slope[1]);
        if (!(fabs(det) > 1e-6)) {
            return false;
        }
        kiriVec2 step = { (slope[1].y * off[0] - slope[0].y * off[1]) / det,
                          (slope[0].x * off[1] - slope[1].x * off[0]) / det };
        end->at = kiriVec2_Sub(end->at, AtMost(step, 0.5 * s->u->grid->side));
    }
    return fabs(off[0]) + fabs(off[1]) < s->least && kiriSight_IsClear(&s->sight, s->grid->look, end->at);
}

/* Returns how much farther the site of region i is than the site of region j. */
static double FartherAt(const EndSearch* s, kiriVec2 at)
{
    kiriVec2 slope;
    return Farther(&s->reach[0], &s->reach[1], at, &slope);
}

/* Finds the point at equal distances from both sites, between a point nearer to one and a point nearer to the other, by
   the Illinois rule. */
static kiriVec2 FindBetweenOnEdge(const EndSearch* s, kiriVec2 a, double farA, kiriVec2 b, double farB)
{
    kiriVec2 way = kiriVec2_Sub(b, a);
    double low = 0.0, high = 1.0;
    KIRI_TIMES_WHILE(farB != farA, round, 24) {
        double at = high - farB * (high - low) / (farB - farA);
        double far = FartherAt(s, kiriVec2_AddScaled(a, at, way));
        if ((far > 0.0) != (farB > 0.0)) {
            low = high;
            farA = farB;
        } else {
            farA *= 0.5;
        }
        high = at;
        farB = far;
    }
    return kiriVec2_AddScaled(a, high, way);
}

/* Goes from a point of an edge along the edges of the material, up to three squares' sides, in the direction in which
   the difference of distances falls, to where it vanishes. */
static bool WalkToEnd(const EndSearch* s, int32_t* on, kiriVec2 at, kiriLinkEnd* end)
{
    const kiriMeshData* mesh = s->u->grid->mesh;
    int32_t edge = *on;
    kiriVec2 slope;
    KIRI_ASSERT(s->reach[0].state == REACH_KNOWN && s->reach[1].state == REACH_KNOWN);
    double far = Farther(&s->reach[0], &s->reach[1], at, &slope), left = 3.0 * s->u->grid->side;
    bool ahead = far * kiriVec2_Dot(slope, kiriVec2_Sub(EdgeEnd(mesh, edge, true), EdgeEnd(mesh, edge, false))) < 0.0;
    KIRI_TIMES_WHILE(left > 0.0, steps, 32) {
        kiriVec2 goal = EdgeEnd(mesh, edge, ahead);
        double goalFar = FartherAt(s, goal);
        if (far == 0.0 || (far > 0.0) != (goalFar > 0.0)) {
            SetOpenEnd(s->u, end, far == 0.0 ? at : FindBetweenOnEdge(s, at, far, goal, goalFar), edge);
            *on = edge;
            return true;
        }
        left -= kiriVec2_Distance(goal, at);
        at = goal;
        far = goalFar;
        edge = kiriSight_EdgeBeside(mesh, edge, ahead);
    }
    return false;
}

/* Do both reaches see a point of an edge, from a little to its left? Those that do not are found again from there. */
static bool IsLipSeen(EndSearch* s, int32_t edge, kiriVec2 at)
{
    kiriVec2 way = kiriVec2_Sub(EdgeEnd(s->u->grid->mesh, edge, true), EdgeEnd(s->u->grid->mesh, edge, false));
    double size = kiriVec2_Length(way), off = size > 0.0 ? 1e-3 * s->u->grid->side / size : 0.0;
    kiriVec2 beside = kiriVec2_Add(at, kiriVec2_Make(-off * way.y, off * way.x));
    bool seen = true;
    KIRI_TIMES(k, 2) {
        if (!kiriSight_IsClear(&s->sight, s->reach[k].from, beside)) {
            seen = false;
            FindReach(s, k, beside, true);
        }
    }
    return seen;
}

/* Finds the end on the edges of the material from a point of one on. Where the reaches of the start do not see the end,
   those that do try twice more. */
static bool FindEndOnEdge(EndSearch* s, int32_t edge, kiriVec2 at, kiriLinkEnd* end)
{
    KIRI_TIMES(round, 2) {
        if (!WalkToEnd(s, &edge, at, end)) {
            return false;
        }
        if (IsLipSeen(s, edge, end->at)) {
            return true;
        }
        if (s->reach[0].state != REACH_KNOWN || s->reach[1].state != REACH_KNOWN) {
            return false;
        }
        at = end->at;
    }
    return WalkToEnd(s, &edge, at, end);
}

/* Finds a point of the border beside the stretch, and the border's direction ahead there. */
static bool FindBorderBefore(const EndSearch* s, kiriVec2* at, kiriVec2* ahead)
{
    double side = s->u->grid->side, size = 0.0;
    kiriVec2 before = PointBefore(s), slope = { 0 };
    *at = before;
    KIRI_TIMES(round, 8) {
        double far = Farther(&s->reach[0], &s->reach[1], *at, &slope);
        size = kiriVec2_Length(slope);
        if (!(size > 1e-3)) {
            return false;
        }
        *at = kiriVec2_Sub(*at, AtMost(kiriVec2_Scale(far / (size * size), slope), 0.5 * side));
    }
    *ahead = kiriVec2_Scale(s->ahead / size, kiriVec2_Left(slope));
    return kiriVec2_Distance(*at, before) < 2.0 * side && kiriSight_IsClear(&s->sight, before, *at);
}

/* Finds the point where the border meets an edge. Starts at the grid's edge of the end or, if the grid's corner is not
   a corner of the border, at the edge to which the border leads. */
static bool FindTurnedOpenEnd(EndSearch* s, kiriLinkEnd* end)
{
    kiriVec2 from = s->grid->look, ahead = kiriVec2_Sub(s->grid->at, s->grid->look);
    kiriVec2 goal = kiriVec2_Add(s->grid->at, ahead);
    kiriSightHit hit;
    if (s->grid->kind != KIRI_END_OPEN) {
        if (!FindBorderBefore(s, &from, &ahead)) {
            return false;
        }
        goal = kiriVec2_AddScaled(from, 4.0 * s->u->grid->side, ahead);
    }
    return kiriSight_Cast(&s->sight, from, goal, &hit) == KIRI_SIGHT_EDGE &&
           FindEndOnEdge(s, hit.edge, kiriVec2_AddScaled(from, hit.share, kiriVec2_Sub(goal, from)), end);
}

/* ---- Exact ends -------------------------------------------------------------------------------------------------- */

/* Finds the distances to the sites that take part in the end: both of the link, and others that the grid has there. */
static bool FindReaches(EndSearch* s)
{
    KIRI_EACH_INDEX(k, s->near) {
        bool takesPart = k < 2;
        KIRI_TIMES_WHILE(s->grid->kind == KIRI_END_CORNER, r, KIRI_CORNER_REGIONS) {
            takesPart |= s->grid->region[r] == s->near.region[k];
        }
        if (takesPart && !FindReach(s, k, s->grid->look, true)) {
            return false;
        }
    }
    return true;
}

/* Can the border be a straight line: are all sites seen, and the two of them apart? */
static bool IsStraightReach(const EndSearch* s)
{
    bool isStraight = kiriVec2_Distance(s->reach[0].from, s->reach[1].from) > s->least;
    KIRI_EACH_INDEX_WHILE(isStraight, k, s->near) {
        isStraight = s->reach[k].state != REACH_KNOWN || !(s->reach[k].behind > 0.0);
    }
    return isStraight;
}

/* Puts the end of a border, at its tangent's tail (0) or head (1), where it is in the Euclidean metric. False: it stays
   as the grid has it. */
static bool FindExactEnd(const LinkUpdate* u, int which, kiriLinkEnd* end)
{
    EndSearch s;
    kiriLinkEnd found = *end;
    if (end->kind == KIRI_END_INNER) {
        return false;
    }
    StartEndSearch(&s, u, end, end->cell, 2);
    s.ahead = which == 0 ? -1.0 : 1.0;
    if (FindSlitEnd(&s, &found)) {
        found.isExact = found.isSeen = true;
    } else if (!FindReaches(&s)) {
        return false;
    } else if (IsStraightReach(&s)) {
        kiriVec2 before = PointBefore(&s), from = PointOn(&s.line, AlongLine(&s.line, before));
        found.isExact = found.isSeen = kiriSight_IsClear(&s.sight, before, from) && FindSeenEnd(&s, from, &found);
    } else {
        found.isExact = end->kind == KIRI_END_CORNER && FindTurnedCorner(&s, &found);
        found.isExact = found.isExact || FindTurnedOpenEnd(&s, &found);
    }
    /* Farther from where the grid has it the border would be one that the grid does not know. */
    found.isExact = found.isExact && kiriVec2_Distance(found.at, end->at) < 3.0 * u->grid->side;
    if (found.isExact) {
        *end = found;
    }
    return found.isExact;
}

/* Sets a straight border from end to end. */
static void SetStraight(kiriLink* link, const kiriLinkEnds* ends)
{
    kiriVec2 way = kiriVec2_Sub(ends->end[1].at, ends->end[0].at);
    link->width = kiriVec2_Length(way);
    link->tangent = kiriVec2_Scale(1.0 / link->width, way);
    link->normal = kiriVec2_Make(link->tangent.y, -link->tangent.x);
    link->centroid = kiriVec2_Scale(0.5, kiriVec2_Add(ends->end[0].at, ends->end[1].at));
    link->moment = link->width * link->width * link->width / 12.0;
}

/* Gives a border that only the grid has next to no width. Its regions stay joined, because cells that are connected on
   the grid are one piece. */
static void SetSpurious(const LinkUpdate* u, kiriLink* link, kiriLinkEnds* ends)
{
    BorderLine line = LineBetween(SiteAt(u, link->i), SiteAt(u, link->j));
    double along = 0.5 * (AlongLine(&line, ends->end[0].at) + AlongLine(&line, ends->end[1].at));
    double half = 0.5 * kiriBorderLeast * u->grid->side;
    KIRI_TIMES(k, 2) {
        SetEnd(&ends->end[k], KIRI_END_INNER, PointOn(&line, k == 0 ? along - half : along + half));
    }
    SetStraight(link, ends);
}

/* Returns true if the stretch runs along slivers of cells beside a slit, or across the end of such slivers. Their
   middles are off by half a square, so their regions are arbitrary and the border is spurious. A border across a narrow
   strip is genuine. */
static bool IsAlongSlivers(const LinkUpdate* u)
{
    double widest = 0.0;
    KIRI_EACH(const kiriBorderFace, face, u->work->stretch) {
        widest = kiriMax(face->stretch.width, widest);
    }
    bool isAlong = widest >= kiriSliver * u->grid->side, isNothing = widest < 1e-6 * u->grid->side;
    return (isAlong || isNothing) && HasOnlySlivers(u);
}

/* Puts the ends, and with them the border, where they are in the Euclidean metric, as far as the sites see it. */
static void MakeExact(const LinkUpdate* u, kiriLink* link, kiriLinkEnds* ends)
{
    kiriLinkEnds grid = *ends;
    if (IsAlongSlivers(u)) {
        SetSpurious(u, link, ends);
        return;
    }
    bool tail = FindExactEnd(u, 0, &ends->end[0]), head = FindExactEnd(u, 1, &ends->end[1]);
    double width = kiriVec2_Dot(kiriVec2_Sub(ends->end[1].at, ends->end[0].at), link->tangent);
    if (!tail && !head) {
        return;
    }
    if (width > kiriBorderLeast * u->grid->side) {
        SetStraight(link, ends);
    } else if (tail && head) {
        SetSpurious(u, link, ends);
    } else {
        *ends = grid;
    }
}

/* ---- The way from site to site ----------------------------------------------------------------------------------- */

/* The shortest way on the grid from site i to site j over the border. */
typedef struct SitesWay {
    int32_t length;
    kiriVec2 crossing;
    int32_t overFaces; /* length of the shortest way over a face, */
    int32_t cell[2];   /* the cells beside the face, of regions i and j, */
    kiriVec2 over;     /* and its middle */
} SitesWay;

/* Tries the steps of every length from `cell` over the border into region `to`. */
static void TryLongSteps(const LinkUpdate* u, int32_t cell, int32_t to, SitesWay* way)
{
    const kiriField* field = &u->regions->field;
    KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
        if (field->owner.data[step.cell] == to) {
            int32_t length = field->distance.data[cell] + step.length + field->distance.data[step.cell];
            if (length < way->length) {
                kiriVec2 a = kiriGrid_Middle(u->grid, cell);
                way->length = length;
                way->crossing = kiriVec2_Scale(0.5, kiriVec2_Add(a, kiriGrid_Middle(u->grid, step.cell)));
            }
        }
    }
}

static SitesWay FindGridWay(const LinkUpdate* u)
{
    const int32_t* distance = u->regions->field.distance.data;
    SitesWay way = { KIRI_FAR, { 0.0, 0.0 }, KIRI_FAR, { KIRI_NONE, KIRI_NONE }, { 0.0, 0.0 } };
    KIRI_EACH(const kiriBorderFace, face, u->work->stretch) {
        int32_t length = distance[face->cell[0]] + KIRI_UNIT + distance[face->cell[1]];
        if (length < way.overFaces) {
            way.overFaces = length;
            memcpy(way.cell, face->cell, sizeof(way.cell));
            way.over = face->stretch.middle;
        }
        TryLongSteps(u, face->cell[0], face->region[1], &way);
        TryLongSteps(u, face->cell[1], face->region[0], &way);
    }
    if (way.overFaces <= way.length) {
        way.length = way.overFaces;
        way.crossing = way.over;
    }
    return way;
}

/* Finds the shortest way from site i to site j over the border, guided by the one on the grid. */
static bool FindWay(const LinkUpdate* u, const kiriLink* link, const kiriLinkEnds* ends, const SitesWay* grid,
                    kiriWay* way)
{
    NearRegions near;
    kiriTurns turns;
    kiriVec2 a = SiteAt(u, link->i), b = SiteAt(u, link->j);
    if (!IsSiteInside(u, link->i) || !IsSiteInside(u, link->j)) {
        return false;
    }
    near.count = 0;
    AddRegionsAt(u, &near, ends->end[0].cell, 2);
    AddRegionsAt(u, &near, ends->end[1].cell, 2);
    kiriSight sight = SightOf(u, &near);
    bool isSeen = ends->end[0].isSeen && ends->end[1].isSeen;
    if (kiriSight_IsClear(&sight, a, b) &&
        (isSeen || (kiriSight_IsClear(&sight, a, grid->over) && kiriSight_IsClear(&sight, b, grid->over)))) {
        way->turnCount = 0;
        way->length = kiriVec2_Distance(a, b);
        return true;
    }
    kiriTurns_Start(&turns, a, b, MostOf(u, grid->overFaces));
    AddTurnsAlong(u, &sight, grid->cell[0], &turns);
    AddTurnsAlong(u, &sight, grid->cell[1], &turns);
    return kiriWay_Find(&turns, &sight, way);
}

/* Sets length, span and crossing, which is half-way: both sites are as far from there. Lengths on the grid exceed true
   ones by up to 3 %, and by parts of a side at both ends. They are taken only where the true way is not found, and
   where they are not clearly longer the way is straight. */
static void SetLength(const LinkUpdate* u, kiriLink* link, const kiriLinkEnds* ends)
{
    kiriVec2 a = SiteAt(u, link->i), b = SiteAt(u, link->j);
    SitesWay grid = FindGridWay(u);
    kiriWay way;
    bool found = FindWay(u, link, ends, &grid, &way);
    if (!found) {
        double straight = kiriVec2_Distance(a, b);
        way.length = grid.length * (u->grid->side / KIRI_UNIT);
        way.turnCount = 1;
        way.turn[0] = grid.crossing;
        if (way.length < 1.08 * straight + 0.5 * u->grid->side) {
            way.length = straight;
            way.turnCount = 0;
        }
    }
    link->crossing = found || way.turnCount == 0 ? kiriWay_At(&way, a, b, 0.5 * way.length) : way.turn[0];
    link->span = way.turnCount == 0 ? kiriVec2_Sub(b, a) : kiriVec2_Scale(way.length, link->normal);
    double least = 0.1 * u->grid->side;
    link->length = kiriMax(way.length, least);
}

/* ---- Links ------------------------------------------------------------------------------------------------------- */

/* Sets centroid and second moment along the tangent; a face counts by its width as seen along the normal. */
static void SetMoments(const LinkUpdate* u, kiriLink* link)
{
    double normal[2] = { link->normal.x, link->normal.y }, total = 0.0;
    kiriVec2 first = { 0 };
    KIRI_EACH(const kiriBorderFace, face, u->work->stretch) {
        double weight = face->stretch.width * fabs(normal[face->axis]);
        total += weight;
        first = kiriVec2_AddScaled(first, weight, face->stretch.middle);
    }
    link->centroid = kiriVec2_Scale(1.0 / total, first);
    KIRI_EACH(const kiriBorderFace, face, u->work->stretch) {
        /* The side's direction along the tangent is as its normal along the normal. */
        double share = fabs(normal[face->axis]);
        double s = kiriVec2_Dot(kiriVec2_Sub(face->stretch.middle, link->centroid), link->tangent);
        link->moment += share * (face->stretch.width * s * s + face->stretch.moment * share * share);
    }
}

/* Cosine of the angle to the normal beyond which an edge has no say. */
#define LEAST_ALONG 0.5

/* Sets the outer width, `beyond` and `lean`, after everything else of the link. A border of hardly any width has no
   `beyond`, because it may lie on a slit. */
static void SetOuter(const LinkUpdate* u, kiriLink* link, const kiriLinkEnds* ends)
{
    bool all = ends->end[0].kind == KIRI_END_OPEN && ends->end[1].kind == KIRI_END_OPEN;
    double sum = 0.0, square = 0.0;
    KIRI_TIMES(k, 2) {
        double way = kiriVec2_Dot(kiriVec2_Sub(ends->end[k].at, link->crossing), link->tangent);
        way = k == 0 ? -way : way;
        sum += ends->end[k].kind == KIRI_END_OPEN && way > 0.0 ? way : 0.0;
        bool isSquare = ends->end[k].kind == KIRI_END_CORNER && ends->end[k].region[3] != KIRI_NONE;
        square += isSquare && way > 0.0 ? way : 0.0;
        double along = kiriVec2_Dot(ends->end[k].edge, link->normal);
        if (!all && ends->end[k].kind == KIRI_END_OPEN && ends->end[k].isExact && fabs(along) > LEAST_ALONG) {
            link->lean = kiriVec2_Dot(ends->end[k].edge, link->tangent) / along;
        }
    }
    link->outer = all ? link->width : kiriMin(sum, link->width);
    link->square = kiriMin(square, link->width - link->outer);
    link->beyond = !all && link->width > kiriSliver * u->grid->side ? kiriMax(sum - link->width, 0.0) : 0.0;
}

/* Turns the axes of a border that runs aslant from edge to edge. A strip bends and stretches along its edges, so the
   normal is the mean of their directions, and width and length are measured across and along it. A way with turns keeps
   its length. */
static void FollowEdges(const LinkUpdate* u, kiriLink* link, const kiriLinkEnds* ends)
{
    kiriVec2 way = kiriVec2_Sub(ends->end[1].at, ends->end[0].at), mean = { 0 };
    kiriVec2 straight = kiriVec2_Sub(SiteAt(u, link->j), SiteAt(u, link->i));
    KIRI_TIMES(k, 2) {
        double along = kiriVec2_Dot(ends->end[k].edge, link->normal);
        if (fabs(along) < LEAST_ALONG || !ends->end[k].isExact) {
            return;
        }
        mean = kiriVec2_AddScaled(mean, along < 0.0 ? -1.0 : 1.0, ends->end[k].edge);
    }
    link->normal = kiriVec2_Normalize(mean);
    link->tangent = kiriVec2_Left(link->normal);
    link->width = kiriVec2_Dot(way, link->tangent);
    link->moment = link->width * link->width * link->width / 12.0;
    double along = kiriVec2_Dot(straight, link->normal);
    bool isStraight = link->span.x == straight.x && link->span.y == straight.y && along > 0.1 * u->grid->side;
    link->length = isStraight ? along : link->length;
}

/* Makes the link of the gathered stretch. A border that turns back on itself, around the tip of a slit for instance,
   loses its width in the vector sum: its faces are marked, to be gathered in parts of one normal each. */
static bool MakeLink(const LinkUpdate* u, bool isPart)
{
    kiriLinkWork* work = u->work;
    double n[2] = { 0 }, sum = 0.0;
    KIRI_ASSERT(work->stretch.count > 0);
    KIRI_EACH(const kiriBorderFace, face, work->stretch) {
        n[face->axis] += face->sign * face->stretch.width;
        sum += face->stretch.width;
    }
    kiriVec2 normal = { n[0], n[1] };
    double width = kiriVec2_Length(normal);
    if (!isPart && width < 0.5 * sum) {
        KIRI_EACH(const kiriBorderFace, face, work->stretch) {
            work->marks.data[face->face] = FACE_BENT;
        }
        return true;
    }
    kiriNewLink made = { 0 };
    kiriLink* link = &made.link;
    made.face = work->stretch.data[0].face;
    link->i = work->stretch.data[0].region[0];
    link->j = work->stretch.data[0].region[1];
    link->width = width;
    link->normal = kiriVec2_Scale(1.0 / width, normal);
    link->tangent = kiriVec2_Left(link->normal);
    link->sum = normal;
    SetMoments(u, link);
    made.ends = FindEnds(u, link, isPart);
    if (!isPart) {
        MakeExact(u, link, &made.ends);
    }
    KIRI_EACH(const kiriBorderFace, face, work->stretch) { /* the spread about the centroid */
        kiriVec2 arm = kiriVec2_Sub(face->stretch.middle, link->centroid);
        double along = face->sign * face->stretch.width;
        normal = kiriVec2_Make(face->axis == 0 ? along : 0.0, face->axis == 0 ? 0.0 : along);
        link->spread[0] = kiriVec2_AddScaled(link->spread[0], arm.x, normal);
        link->spread[1] = kiriVec2_AddScaled(link->spread[1], arm.y, normal);
    }
    SetLength(u, link, &made.ends);
    FollowEdges(u, link, &made.ends);
    SetOuter(u, link, &made.ends);
    return kiriArray_Push(u->memory, &work->made, made);
}

/* Makes the links of the stretch through a listed face, unless that was done. */
static bool MakeLinksAt(const LinkUpdate* u, int32_t face)
{
    const uint8_t* mark = &u->work->marks.data[face];
    bool ok = true;
    if (*mark == FACE_FOUND) {
        ok = GatherStretch(u, face, FACE_GATHERED);
        u->work->due += STRETCH_FACE_ITEMS * (int64_t)u->work->order.count + LINK_ITEMS;
        ok = ok && MakeLink(u, false);
    }
    if (ok && *mark == FACE_BENT) {
        ok = GatherStretch(u, face, FACE_PASSED) && MakeLink(u, true);
    }
    return ok;
}

/* ---- Links that are too short for the grid ----------------------------------------------------------------------- */

/* Finds a point between the limits of a line, or beside the only one; false where there is none. */
static bool FindBetweenLimits(EndSearch* s, kiriVec2* at)
{
    double limit[2], inside = 0.25 * s->u->grid->side;
    KIRI_TIMES(k, 2) {
        s->ahead = k == 0 ? -1.0 : 1.0;
        limit[k] = FindFirstLimit(s);
    }
    if (limit[0] == kiriFarAhead && limit[1] == kiriFarAhead) {
        return false;
    }
    double low = -limit[0], high = limit[1];
    low = limit[0] == kiriFarAhead ? high - 2.0 * inside : low;
    high = limit[1] == kiriFarAhead ? low + 2.0 * inside : high;
    *at = PointOn(&s->line, 0.5 * (low + high));
    return high - low > s->least;
}

/* Makes the link of the regions of two cells, i < j, where their border is so short that the grid has none. near: an
   end of a link of region i, in the first cell. False where no such border is seen. Reads only regions one step from
   the first cell. */
static bool MakeShortLink(const LinkUpdate* u, const kiriLinkEnd* near, const int32_t cells[2], kiriNewLink* made)
{
    EndSearch s;
    kiriVec2 at;
    double most = 4.0 * u->grid->side;
    kiriLink* link = &made->link;
    StartEndSearch(&s, u, near, cells, 1);
    KIRI_CLEAR(made);
    made->ends.isShort = true;
    made->face = KIRI_NONE;
    link->i = s.near.region[0];
    link->j = s.near.region[1];
    KIRI_ASSERT(link->i < link->j);
    if (!FindBetweenLimits(&s, &at) || kiriVec2_Distance(at, near->look) > most ||
        !kiriSight_IsClear(&s.sight, near->look, at) || !IsSiteSeen(&s, 0) || !IsSiteSeen(&s, 1)) {
        return false;
    }
    KIRI_TIMES(k, 2) {
        kiriLinkEnd* end = &made->ends.end[k];
        s.ahead = k == 0 ? -1.0 : 1.0;
        memcpy(end->cell, cells, sizeof(end->cell));
        end->isExact = true;
        if (!FindSeenEnd(&s, at, end) || !IsEndSeen(&s, end)) {
            return false;
        }
    }
    SetStraight(link, &made->ends);
    link->span = kiriVec2_Sub(SiteAt(u, link->j), SiteAt(u, link->i));
    link->length = kiriVec2_Length(link->span);
    link->crossing = s.line.middle;
    SetOuter(u, link, &made->ends);
    return link->width < 0.5 * most;
}

/* Is there a link of two regions in `next`, or among those made from `first` on? */
static bool IsLinked(const LinkUpdate* u, int32_t i, int32_t j, int32_t first)
{
    const kiriLink* next = u->links->next.data;
    int32_t at = FirstOfPair(next, u->links->next.count, i, j);
    bool isLinked = at < u->links->next.count && IsOfPair(&next[at], i, j);
    KIRI_FROM_TO_WHILE(!isLinked, k, first, u->work->made.count) {
        isLinked = IsOfPair(&u->work->made.data[k].link, i, j);
    }
    return isLinked;
}

/* Makes short links from a cell at the end of a link to higher regions one step away. */
static bool MakeShortLinksAt(const LinkUpdate* u, const kiriLinkEnd* end, int32_t cell, int32_t first)
{
    int32_t last = KIRI_NONE;
    KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
        int32_t cells[2] = { cell, step.cell }, i = u->owner[cell], j = u->owner[cells[1]];
        kiriNewLink made;
        if (j > i && j != last) {
            last = j;
            if (!IsLinked(u, i, j, first) && MakeShortLink(u, end, cells, &made) &&
                !kiriArray_Push(u->memory, &u->work->made, made)) {
                return false;
            }
        }
    }
    return true;
}

/* Borders that the grid misses are found where other borders of their lower region end, if that region is stale. */
static bool MakeShortLinks(const LinkUpdate* u)
{
    int32_t first = u->work->made.count;
    bool ok = true;
    KIRI_EACH_INDEX_WHILE(ok, k, u->links->next) {
        const kiriLink* link = &u->links->next.data[k];
        const kiriLinkEnds* ends = &u->work->nextEnds.data[k];
        KIRI_TIMES_WHILE(ok && !ends->isShort, e, 4) {
            if (IsStale(u, e % 2 == 0 ? link->i : link->j)) {
                ok = MakeShortLinksAt(u, &ends->end[e / 2], ends->end[e / 2].cell[e % 2], first);
            }
        }
    }
    return ok;
}

/* ---- Merging by key ---------------------------------------------------------------------------------------------- */

static bool IsMadeBefore(const void* context, int32_t a, int32_t b)
{
    const LinkUpdate* u = context;
    const kiriNewLink *x = &u->work->made.data[a], *y = &u->work->made.data[b];
    if (y->link.fold != 0 || !IsOfPair(&x->link, y->link.i, y->link.j)) {
        return kiriLink_IsBefore(&x->link, &y->link);
    }
    KIRI_ASSERT(x->face != KIRI_NONE && y->face != KIRI_NONE);
    KIRI_ASSERT(x->face != y->face);
    return IsFaceBefore(u->grid, x->face, y->face);
}

static void AddNext(const LinkUpdate* u, const kiriLink* link, const kiriLinkEnds* ends, int32_t was)
{
    KIRI_NEXT(u->links->was) = was;
    KIRI_NEXT(u->links->next) = *link;
    KIRI_NEXT(u->work->nextEnds) = *ends;
}

/* Sorts the links that were made by their keys, and merges them with the kept ones; no pair of regions has both. Counts
   the made ones that differ from the old link with the same key. */
static bool MergeLinks(const LinkUpdate* u)
{
    kiriLinks* links = u->links;
    kiriLinkWork* work = u->work;
    int32_t old = 0;
    int64_t most = (int64_t)links->links.count + work->made.count;
    if (!kiriSort_Order(u->memory, &work->order, work->made.count, IsMadeBefore, u) ||
        !kiriArrays_Reserve(u->memory, most, &links->next, &work->nextEnds, &links->was)) {
        return false;
    }
    links->next.count = work->nextEnds.count = links->was.count = links->changed = 0;
    for (int32_t k = 0; k <= work->order.count; ++k) {
        const kiriNewLink* made = k < work->order.count ? &work->made.data[work->order.data[k]] : NULL;
        for (; old < links->links.count && (made == NULL || kiriLink_IsBefore(&links->links.data[old], &made->link));
             ++old) {
            if (work->to.data[old] != KIRI_NONE) {
                work->to.data[old] = links->next.count;
                AddNext(u, &links->links.data[old], &work->ends.data[old], old);
            }
        }
        if (made != NULL) {
            bool hasOld = old < links->links.count && !kiriLink_IsBefore(&made->link, &links->links.data[old]);
            links->changed += !hasOld || memcmp(&links->links.data[old], &made->link, sizeof(made->link)) != 0;
            old += hasOld;
            AddNext(u, &made->link, &made->ends, KIRI_NONE);
        }
    }
    return true;
}

/* ---- Corners ----------------------------------------------------------------------------------------------------- */

/* Returns true if the ends are the same. An end that is taken from the grid may be off by two squares. */
static bool AreEndsOne(const kiriLinkEnd* a, const kiriLinkEnd* b, double side)
{
    return a->kind == KIRI_END_CORNER && b->kind == KIRI_END_CORNER &&
           memcmp(a->region, b->region, sizeof(a->region)) == 0 &&
           kiriVec2_Distance(a->at, b->at) <= (a->isExact && b->isExact ? 1e-6 : 2.0) * side;
}

/* Lists the links that have this end, ascending; returns their number, or 5 for more than 4. */
static int32_t ListLinksAt(const LinkUpdate* u, const kiriLinkEnd* end, int32_t list[4])
{
    const kiriLinks* links = u->links;
    int32_t count = 0;
    KIRI_TIMES(pair, KIRI_CORNER_REGIONS * KIRI_CORNER_REGIONS) {
        int32_t i = end->region[pair / KIRI_CORNER_REGIONS], j = end->region[pair % KIRI_CORNER_REGIONS];
        if (i == KIRI_NONE || j <= i) {
            continue;
        }
        for (int32_t k = FirstOfPair(links->next.data, links->next.count, i, j);
             k < links->next.count && IsOfPair(&links->next.data[k], i, j); ++k) {
            const kiriLinkEnds* ends = &u->work->nextEnds.data[k];
            if (AreEndsOne(&ends->end[0], end, u->grid->side) || AreEndsOne(&ends->end[1], end, u->grid->side)) {
                if (count == 4) {
                    return 5;
                }
                list[count++] = k;
            }
        }
    }
    return count;
}

/* Do the links form a ring: is each region between two of them? */
static bool IsRing(const kiriLinks* links, const kiriLinkEnd* end, const int32_t* list, int32_t count)
{
    KIRI_TIMES(a, KIRI_CORNER_REGIONS) {
        int32_t region = end->region[a], found = 0;
        KIRI_TIMES(k, count) {
            found += links->next.data[list[k]].i == region || links->next.data[list[k]].j == region;
        }
        if (found != (a < count ? 2 : 0)) {
            return false;
        }
    }
    return true;
}

/* Below this determinant of N, relative to its trace squared, the links of a corner have one direction. */
static const double kiriFlatCorner = 1e-3;

/* Adds the corner at an end of link k, unless there is none, or a lower link has it as well. The sites are a triangle
   or a quadrangle, and two links that share a region are two of its sides. Where ways bend the sides do not quite
   close, so the areas that they give are averaged. */
static bool AddLinkCorner(const LinkUpdate* u, int32_t k, const kiriLinkEnd* end)
{
    const kiriLink* next = u->links->next.data;
    int32_t list[4], count = end->kind == KIRI_END_CORNER ? ListLinksAt(u, end, list) : 0;
    double sum = 0.0, xx = 0.0, xy = 0.0, yy = 0.0, share[4];
    kiriCorner corner = { 0 };
    if (count < 3 || count > 4 || list[0] != k || !IsRing(u->links, end, list, count)) {
        return true;
    }
    KIRI_TIMES(a, count) {
        const kiriLink* x = &next[list[a]];
        const kiriLinkEnd* ends = u->work->nextEnds.data[list[a]].end;
        bool isTail = AreEndsOne(&ends[0], end, u->grid->side);
        double way = kiriVec2_Dot(kiriVec2_Sub(ends[isTail ? 0 : 1].at, x->crossing), x->tangent);
        /* The part of its width between its crossing and this end: 0 if the crossing is beyond, because weights of both signs
           would make narrow corners stiff. */
        share[a] = kiriMax(isTail ? -way : way, 0.0) / x->length;
        xx += share[a] * x->span.x * x->span.x;
        xy += share[a] * x->span.x * x->span.y;
        yy += share[a] * x->span.y * x->span.y;
        KIRI_FROM_TO(b, a + 1, count) {
            const kiriLink* y = &next[list[b]];
            bool shareRegion = x->i == y->i || x->i == y->j || x->j == y->i || x->j == y->j;
            sum += shareRegion ? fabs(kiriVec2_Cross(x->span, y->span)) : 0.0;
        }
    }
    double det = xx * yy - xy * xy, trace = xx + yy;
    if (!(det >= kiriFlatCorner * trace * trace)) {
        return true;
    }
    corner.count = count;
    corner.area = count == 3 ? sum / 6.0 : sum / 4.0;
    KIRI_TIMES(c, 4) {
        corner.link[c] = c < count ? list[c] : KIRI_NONE;
        kiriVec2 s = c < count ? kiriVec2_Scale(share[c], next[list[c]].span) : kiriVec2_Make(0.0, 0.0);
        corner.weight[c] = kiriVec2_Make((yy * s.x - xy * s.y) / det, (xx * s.y - xy * s.x) / det);
    }
    return kiriArray_Push(u->memory, &u->links->nextCorners, corner);
}

/* Is a link kept, and no region stale at its corners? Then these have all their links and are kept, too. */
static bool AreCornersKept(const LinkUpdate* u, int32_t k)
{
    bool areKept = u->links->was.data[k] != KIRI_NONE;
    KIRI_TIMES_WHILE(areKept, a, 2 * KIRI_CORNER_REGIONS) {
        const kiriLinkEnd* end = &u->work->nextEnds.data[k].end[a / KIRI_CORNER_REGIONS];
        int32_t region = end->region[a % KIRI_CORNER_REGIONS];
        areKept = end->kind != KIRI_END_CORNER || region == KIRI_NONE || !IsStale(u, region);
    }
    return areKept;
}

/* Makes the corners of `next`, each with its lowest link. Corners of kept links are copied. */
static bool MakeCorners(const LinkUpdate* u)
{
    kiriLinks* links = u->links;
    int32_t old = 0;
    bool ok = true;
    links->nextCorners.count = 0;
    KIRI_EACH_INDEX_WHILE(ok, k, links->next) {
        if (!AreCornersKept(u, k)) {
            ok = AddLinkCorner(u, k, &u->work->nextEnds.data[k].end[0]) &&
                 AddLinkCorner(u, k, &u->work->nextEnds.data[k].end[1]);
            continue;
        }
        for (; ok && old < links->corners.count && links->corners.data[old].link[0] <= links->was.data[k]; ++old) {
            kiriCorner corner = links->corners.data[old];
            if (corner.link[0] == links->was.data[k]) {
                KIRI_EACH_INDEX(c, corner) {
                    corner.link[c] = u->work->to.data[corner.link[c]];
                    KIRI_ASSERT(corner.link[c] != KIRI_NONE);
                }
                ok = kiriArray_Push(u->memory, &links->nextCorners, corner);
            }
        }
    }
    return ok;
}

/* ---- Folds ------------------------------------------------------------------------------------------------------- */

/* Clips the part of the segment from a to b, as shares, to a square. */
static bool ClipToSquare(const kiriMeshData* mesh, int32_t square, kiriLatticePoint a, kiriLatticePoint b,
                         double share[2])
{
    kiriLatticePoint low = kiriSquares_Corner(&mesh->squares, square);
    const double from[2] = { (double)a.x - low.x, (double)a.y - low.y };
    const double way[2] = { (double)b.x - a.x, (double)b.y - a.y };
    share[0] = 0.0;
    share[1] = 1.0;
    KIRI_TIMES(k, 4) {
        double s = k % 2 == 0 ? -from[k / 2] : (double)mesh->squares.side - from[k / 2], v = way[k / 2];
        bool isEntry = (k % 2 == 0) == (v > 0.0);
        if (v != 0.0) {
            share[isEntry ? 0 : 1] = isEntry ? kiriMax(s / v, share[0]) : kiriMin(s / v, share[1]);
        } else if (k % 2 == 0 ? s > 0.0 : s < 0.0) {
            return false;
        }
    }
    return share[0] < share[1];
}

/* Returns the region of a triangle's material in a square, or KIRI_NONE. */
static int32_t RegionIn(const LinkUpdate* u, int32_t square, int32_t triangle)
{
    KIRI_EACH_NODE(node, &u->grid->mesh->squares, square) {
        if (u->grid->mesh->squares.nodes.data[node].triangle == triangle) {
            return u->owner[u->grid->nodeCell.data[node]];
        }
    }
    return KIRI_NONE;
}

/* Adds the part of a crease that lies in a square; h runs along the fold. */
static bool AddFoldPart(const LinkUpdate* u, const kiriFoldLine* fold, int32_t square, int32_t h)
{
    const kiriMeshData* mesh = u->grid->mesh;
    kiriLatticePoint ends[2] = { kiriMesh_TailAt(mesh, h), kiriMesh_HeadAt(mesh, h) };
    kiriVec2 start = kiriMesh_Local(mesh, fold->from), way = kiriVec2_Sub(kiriMesh_Local(mesh, fold->to), start);
    double length = kiriVec2_Length(way), along[2], share[2];
    KIRI_TIMES(k, 2) {
        along[k] = kiriVec2_Dot(kiriVec2_Sub(kiriMesh_Local(mesh, ends[k]), start), way) / length;
    }
    int32_t twin = kiriMesh_Twin(mesh, h);
    KIRI_ASSERT(length > 0.0 && twin != KIRI_NONE && kiriMesh_IsOpen(mesh, h));
    if (!(along[0] < along[1]) || !kiriFoldLine_Has(fold, ends[0], ends[1]) ||
        !ClipToSquare(mesh, square, ends[0], ends[1], share)) {
        return true;
    }
    kiriFoldPart part = { along[0] + share[0] * (along[1] - along[0]), along[0] + share[1] * (along[1] - along[0]),
                          { RegionIn(u, square, h / 3), RegionIn(u, square, twin / 3) } };
    bool isDivided = part.region[0] != KIRI_NONE && part.region[1] != KIRI_NONE && part.region[0] != part.region[1];
    return !isDivided || kiriArray_Push(u->memory, &u->work->parts, part);
}

/* Orders the parts of a fold by pairs of regions, then along it: in the same way however the mesh came about. */
static bool IsPartBefore(const void* context, int32_t a, int32_t b)
{
    const kiriFoldPart *x = (const kiriFoldPart*)context + a, *y = (const kiriFoldPart*)context + b;
    KIRI_TIMES(k, 2) {
        if (x->region[k] != y->region[k]) {
            return x->region[k] < y->region[k];
        }
    }
    return x->from != y->from ? x->from < y->from : x->to < y->to;
}

/* Makes the link of parts order[first] to order[end - 1], of one pair of regions. */
static bool MakeFoldLink(const LinkUpdate* u, int32_t fold, int32_t first, int32_t end)
{
    const kiriFoldLine* line = &u->grid->mesh->folds.data[fold];
    const int32_t* order = u->work->order.data;
    kiriVec2 start = kiriMesh_Local(u->grid->mesh, line->from);
    kiriVec2 along = kiriVec2_Normalize(kiriVec2_Sub(kiriMesh_Local(u->grid->mesh, line->to), start));
    kiriNewLink made = { 0 };
    kiriLink* link = &made.link;
    double sum = 0.0, second = 0.0;
    KIRI_FROM_TO(k, first, end) {
        const kiriFoldPart* part = &u->work->parts.data[order[k]];
        double length = part->to - part->from;
        link->width += length;
        sum += 0.5 * length * (part->from + part->to);
        second += length * (part->from * part->from + part->from * part->to + part->to * part->to) / 3.0;
    }
    const int32_t* region = u->work->parts.data[order[first]].region;
    bool isLeft = region[0] < region[1];
    KIRI_ASSERT(first < end && region[0] != region[1] && link->width > 0.0);
    double middle = sum / link->width, spread = second - sum * middle;
    link->i = region[isLeft ? 0 : 1];
    link->j = region[isLeft ? 1 : 0];
    link->fold = fold + 1;
    link->tangent = isLeft ? along : kiriVec2_Scale(-1.0, along);
    link->normal = kiriVec2_Make(link->tangent.y, -link->tangent.x);
    link->centroid = kiriVec2_AddScaled(start, middle, along);
    link->moment = kiriMax(spread, 0.0);
    double before = kiriVec2_Dot(kiriVec2_Sub(link->centroid, SiteAt(u, link->i)), link->normal);
    double behind = kiriVec2_Dot(kiriVec2_Sub(SiteAt(u, link->j), link->centroid), link->normal);
    link->length = kiriMax(fabs(before) + fabs(behind), u->grid->side);
    link->span = kiriVec2_Scale(link->length, link->normal);
    link->crossing = kiriVec2_AddScaled(link->centroid, 0.5 * (behind - before), link->normal);
    made.ends.isShort = true;
    return kiriArray_Push(u->memory, &u->work->made, made);
}

static bool MakeLinksOfFold(const LinkUpdate* u, int32_t fold)
{
    const kiriFoldLine* line = &u->grid->mesh->folds.data[fold];
    kiriLinkWork* work = u->work;
    const kiriMeshData* mesh = u->grid->mesh;
    kiriStrips strips = kiriStrips_Begin(&mesh->squares, line->from, line->to, 4.0 * line->reach);
    work->parts.count = 0;
    while (kiriStrips_Next(&strips)) {
        KIRI_EACH_INDEX(i, strips) {
            int32_t square = strips.square + i * strips.stride;
            int32_t nodes = kiriSquares_CountNodes(&mesh->squares, square);
            work->due += 1 + nodes;
            KIRI_EACH_NODE(node, &mesh->squares, square) {
                KIRI_EACH_CORNER(k) {
                    int32_t h = 3 * mesh->squares.nodes.data[node].triangle + k;
                    if (kiriMesh_IsCrease(mesh, h)) {
                        work->due += nodes; /* its regions are looked for among them */
                        if (!AddFoldPart(u, line, square, h)) {
                            return false;
                        }
                    }
                }
            }
        }
    }
    work->due += work->parts.count;
    if (!kiriSort_Order(u->memory, &work->order, work->parts.count, IsPartBefore, work->parts.data)) {
        return false;
    }
    for (int32_t first = 0, end; first < work->order.count; first = end) {
        const int32_t* region = work->parts.data[work->order.data[first]].region;
        for (end = first; end < work->order.count; ++end) {
            const int32_t* other = work->parts.data[work->order.data[end]].region;
            if (other[0] != region[0] || other[1] != region[1]) {
                break;
            }
        }
        if (!MakeFoldLink(u, fold, first, end)) {
            return false;
        }
    }
    return true;
}

/* Appends the links of folds to the others, with what the host has set of each fold by now. */
static bool AppendFoldLinks(const LinkUpdate* u)
{
    bool any = false;
    KIRI_EACH(kiriNewLink, made, u->work->made) {
        if (made->link.fold != 0) {
            const kiriFoldLine* line = &u->grid->mesh->folds.data[made->link.fold - 1];
            made->link.hinge = line->stiffness;
            made->link.rest = line->restAngle;
            made->link.yield = line->yieldMoment;
            any = true;
        }
    }
    return !any || MergeLinks(u);
}

/* ---- Updates ----------------------------------------------------------------------------------------------------- */

static bool BeginLinks(const LinkUpdate* u)
{
    kiriLinkWork* work = u->work;
    int32_t marks = work->marks.count, faces = u->grid->faces.count;
    u->links->next.count = work->nextEnds.count = u->links->changed = 0;
    work->faces.count = work->made.count = work->at = 0;
    work->due = 0;
    work->foldCount = u->grid->mesh->folds.count;
    if (!kiriSightEdges_Start(&work->edges, u->grid->mesh) ||
        !kiriArray_Resize(u->memory, &work->stale, u->siteCount) ||
        !kiriArray_Resize(u->memory, &work->marks, kiriMax(marks, faces))) {
        return false;
    }
    for (; marks < faces; ++marks) {
        work->marks.data[marks] = FACE_PASSED;
    }
    KIRI_TIMES(i, u->siteCount) {
        work->stale.data[i] = u->regions->dirty.data[i] ? REGION_STALE : 0;
    }
    work->running = true;
    return true;
}

/* Is a face between two regions listed from the first one? It is from the dirty one, or else from the lower one. */
static bool IsListedFrom(const LinkUpdate* u, int32_t region, int32_t other)
{
    const uint8_t* dirty = u->regions->dirty.data;
    if (dirty[region] || dirty[other]) {
        return dirty[region] && (region < other || !dirty[other]);
    }
    const kiriLinks* links = u->links;
    int32_t at =
        region < other ? FirstOfPair(links->links.data, links->links.count, region, other) : links->links.count;
    return at < links->links.count && IsOfPair(&links->links.data[at], region, other) &&
           u->work->to.data[at] == KIRI_NONE;
}

/* Lists the border faces of a region whose links are made. A dirty region also makes those beside it stale: where a
   link ends depends on the regions there. */
static bool ListFaces(const LinkUpdate* u, int32_t region)
{
    const kiriRegions* regions = u->regions;
    bool isDirty = regions->dirty.data[region];
    int32_t cell = regions->border.first.data[region];
    for (; cell != KIRI_NONE; cell = regions->border.cells.data[cell].next) {
        if (isDirty) {
            KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
                u->work->stale.data[u->owner[step.cell]] |= REGION_STALE;
            }
        }
        KIRI_EACH_FACE(f, u->grid, cell) {
            int32_t other = u->owner[kiriFace_Other(&u->grid->faces.data[f], cell)];
            if (other != region && IsListedFrom(u, region, other)) {
                if (!kiriArray_Push(u->memory, &u->work->faces, f)) {
                    return false;
                }
                u->work->marks.data[f] = FACE_FOUND;
            }
        }
        u->work->due += isDirty ? STALE_ITEMS + FACES_ITEMS : FACES_ITEMS;
    }
    return true;
}

/* Is no region dirty on which a link with these ends depends? */
static bool AreEndsClean(const LinkUpdate* u, const kiriLinkEnds* ends)
{
    NearRegions near;
    near.count = 0;
    KIRI_TIMES(k, 2) {
        KIRI_ASSERT(kiriGrid_IsCell(u->grid, ends->end[k].cell[0]) && kiriGrid_IsCell(u->grid, ends->end[k].cell[1]));
        AddRegionsAt(u, &near, ends->end[k].cell, 2);
    }
    bool areClean = near.count < KIRI_NEAR_REGIONS;
    KIRI_EACH_INDEX(k, near) {
        areClean = areClean && !u->regions->dirty.data[near.region[k]];
    }
    return areClean;
}

/* Decides which old links are kept: links of two regions that are not stale; and, if one region is stale but not dirty,
   links for which no dirty region is near the ends of any link of the pair. If both are stale, a new end may be
   anywhere along the border. Lists the faces of other pairs without a dirty region. */
static bool KeepLinks(const LinkUpdate* u)
{
    kiriLinkWork* work = u->work;
    const kiriLinks* links = u->links;
    bool ok = kiriArray_Resize(u->memory, &work->to, links->links.count);
    for (int32_t first = 0, end = 0; ok && first < links->links.count; first = end) {
        if (links->links.data[first].fold != 0) {
            work->to.data[first] = KIRI_NONE;
            end = first + 1;
            continue;
        }
        int32_t i = links->links.data[first].i, j = links->links.data[first].j;
        bool isShort = work->ends.data[first].isShort, isKept = !IsStale(u, i) && (!IsStale(u, j) || isShort);
        bool mayKeep = !isKept && !isShort && !u->regions->dirty.data[i] && !u->regions->dirty.data[j];
        bool areClean = mayKeep && (!IsStale(u, i) || !IsStale(u, j));
        for (; end < links->links.count && IsOfPair(&links->links.data[end], i, j); ++end) {
            areClean = areClean && AreEndsClean(u, &work->ends.data[end]);
        }
        KIRI_FROM_TO(k, first, end) {
            work->to.data[k] = isKept || areClean ? k : KIRI_NONE;
        }
        work->due += areClean ? KEPT_ITEMS * (end - first) : 0;
        work->stale.data[i] |= mayKeep && !areClean ? REGION_TOUCHED : 0;
    }
    KIRI_TIMES_WHILE(ok, i, u->siteCount) {
        bool isTouched = (work->stale.data[i] & REGION_TOUCHED) != 0 && !u->regions->dirty.data[i];
        ok = !isTouched || ListFaces(u, i);
    }
    return ok;
}

/* Goes on with the update, item by item. Edges that are seen first are an item each: a square may have thousands. */
static kiriProgress RunLinks(const LinkUpdate* u, kiriQuota* quota)
{
    kiriLinkWork* work = u->work;
    bool ok = true;
    while (ok && !kiriMemory_MustPause(u->memory) && kiriQuota_Pay(quota, &work->due)) {
        int32_t at = work->at++, face = at - u->siteCount - 1, seen = work->edges.edges.count;
        int32_t fold = face - work->faces.count - 1;
        if (at < u->siteCount) {
            ok = !u->regions->dirty.data[at] || ListFaces(u, at);
        } else if (face < 0) {
            ok = KeepLinks(u);
        } else if (face < work->faces.count) {
            ok = MakeLinksAt(u, work->faces.data[face]);
        } else if (face == work->faces.count) {
            int32_t made = work->made.count;
            ok = MergeLinks(u) && MakeShortLinks(u) && (work->made.count == made || MergeLinks(u)) && MakeCorners(u);
            work->due += 2 * (int64_t)u->links->next.count;
        } else if (fold < work->foldCount) {
            ok = u->grid->mesh->folds.data[fold].isMade == 0 || MakeLinksOfFold(u, fold);
        } else if (fold == work->foldCount) {
            ok = AppendFoldLinks(u);
        } else {
            return KIRI_DONE;
        }
        ok = ok && !work->edges.failed;
        work->due += work->edges.edges.count - seen;
    }
    return ok ? KIRI_MORE : KIRI_FAILED;
}

static void EndLinks(kiriLinkWork* work)
{
    KIRI_EACH_LISTED_WHILE(work->running, listed, work->faces) {
        work->marks.data[listed] = FACE_PASSED;
    }
    work->running = false;
    work->made.count = 0;
}

kiriProgress kiriLinks_Update(kiriLinks* links, const kiriGrid* grid, const kiriRegions* regions, const kiriSite* sites,
                              int32_t siteCount, kiriQuota* quota)
{
    KIRI_ASSERT(regions->dirty.count == siteCount && regions->border.first.count == siteCount && !regions->running);
    if (links->work == NULL) {
        links->work = kiriMemory_AllocZeroed(grid->mesh->memory, sizeof(*links->work));
    }
    if (links->work == NULL) {
        return KIRI_FAILED;
    }
    LinkUpdate u = {
        grid->mesh->memory, grid, regions, regions->field.owner.data, sites, siteCount, links, links->work
    };
    KIRI_ASSERT(links->work->ends.count == links->links.count);
    kiriProgress progress = links->work->running || BeginLinks(&u) ? RunLinks(&u, quota) : KIRI_FAILED;
    if (progress != KIRI_MORE) {
        EndLinks(links->work);
    }
    return progress;
}

void kiriLinks_Drop(kiriLinks* links)
{
    links->next.count = links->nextCorners.count = links->was.count = 0;
    if (links->work != NULL) {
        EndLinks(links->work);
        links->work->nextEnds.count = 0;
    }
}

void kiriLinks_BeginAgain(kiriLinks* links)
{
    if (links->work != NULL && links->work->running) {
        kiriLinks_Drop(links);
    }
}

bool kiriLinks_Keep(kiriLinks* links, kiriMemory* memory, const kiriKeep* kept, const kiriKeep* frames)
{
    kiriLinkWork* work = links->work;
    bool ok = true;
    kiriLinks_Drop(links);
    links->changed = 0;
    KIRI_EACH_INDEX_WHILE(ok, k, links->links) {
        kiriLink link = links->links.data[k];
        kiriLinkEnds ends = work->ends.data[k];
        if (kiriKeep_Has(kept, k)) {
            link.i = kiriKeep_To(frames, link.i);
            link.j = kiriKeep_To(frames, link.j);
            KIRI_ASSERT(link.i != KIRI_NONE && link.j != KIRI_NONE);
            KIRI_TIMES(r, 2 * KIRI_CORNER_REGIONS) {
                int32_t* region = &ends.end[r / KIRI_CORNER_REGIONS].region[r % KIRI_CORNER_REGIONS];
                *region = kiriKeep_To(frames, *region);
            }
            ok = kiriArray_Push(memory, &links->next, link) && kiriArray_Push(memory, &work->nextEnds, ends);
        }
    }
    KIRI_EACH_WHILE(ok, const kiriCorner, old, links->corners) {
        kiriCorner corner = *old;
        if (kiriKeep_Has(kept, corner.link[0])) {
            KIRI_EACH_INDEX(k, corner) {
                corner.link[k] = kiriKeep_To(kept, corner.link[k]);
            }
            ok = kiriArray_Push(memory, &links->nextCorners, corner);
        }
    }
    return ok;
}

void kiriLinks_Commit(kiriLinks* links)
{
    KIRI_ASSERT(!links->work->running && links->work->nextEnds.count == links->next.count);
    kiriArray_Swap(&links->links, &links->next);
    kiriArray_Swap(&links->corners, &links->nextCorners);
    kiriArray_Swap(&links->work->ends, &links->work->nextEnds);
    links->next.count = links->nextCorners.count = links->work->nextEnds.count = 0;
}
