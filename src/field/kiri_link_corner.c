#include "kiri_link_work.h"

#include <string.h>

/* Corners are hashed and compared byte by byte. */
typedef char CornerHasNoPadding[sizeof(kiriCorner) == 6 * sizeof(int32_t) + 9 * sizeof(double) ? 1 : -1];

/* ---- Rings ------------------------------------------------------------------------------------------------------ */

/* The next face of a cell, from `face` on, that joins it to a cell up (or down) the axis. */
static int32_t NextFaceAlong(const kiriGrid* grid, int32_t cell, int32_t face, int32_t axis, bool up)
{
    while (face != KIRI_NONE) {
        const kiriFace* f = &grid->faces.data[face];
        if (kiriFace_Axis(f) == axis && f->cell[up ? 0 : 1] == cell) {
            return face;
        }
        face = kiriFace_Next(f, cell);
    }
    return KIRI_NONE;
}

/* The face between two cells, `high` being up the axis from `low`, or KIRI_NONE. */
static int32_t FaceAlong(const kiriGrid* grid, int32_t low, int32_t high, int32_t axis)
{
    KIRI_ASSERT(low >= 0 && low < grid->cells.count);
    int32_t f = NextFaceAlong(grid, low, grid->cells.data[low].firstFace, axis, true);
    while (f != KIRI_NONE && grid->faces.data[f].cell[1] != high) {
        f = NextFaceAlong(grid, low, kiriFace_Next(&grid->faces.data[f], low), axis, true);
    }
    return f;
}

/* Where slits leave more than one ring the first in the order of cells counts. */
static bool IsRingBefore(const kiriGrid* grid, const int32_t a[2], const int32_t b[2])
{
    if (a[0] != b[0]) {
        return kiriGrid_IsBefore(grid, a[0], b[0]);
    }
    return kiriGrid_IsBefore(grid, a[1], b[1]);
}

/* Puts the cells and faces of a ring in order. near: the two sides of `face`; far: beyond them; across: the faces from
   near to far; last: the face between the far ones. */
static void SetRing(kiriRing* ring, const kiriFace* face, bool upper, const int32_t far[2], const int32_t faces[4])
{
    /* Where each stands in the ring, by the axis of the face and by which of its ends the node is. */
    static const int32_t places[2][2][4] = { { { 3, 2, 0, 1 }, { 0, 1, 3, 2 } }, { { 1, 2, 0, 3 }, { 0, 3, 1, 2 } } };
    const int32_t* place = places[kiriFace_Axis(face)][upper];
    const int32_t cells[4] = { face->cell[0], face->cell[1], far[0], far[1] };
    const int32_t joins[4][2] = { { 0, 1 }, { 0, 2 }, { 1, 3 }, { 2, 3 } };
    for (int k = 0; k < 4; ++k) {
        int32_t a = place[joins[k][0]], b = place[joins[k][1]];
        ring->cell[place[k]] = cells[k];
        ring->face[(a + 1) % 4 == b ? a : b] = faces[k];
    }
}

/* Cells with less of a square, and faces with less of a side, are slivers beside an edge. */
static const double kiriSliver = 1e-3;

static bool IsSliver(const kiriGrid* grid, int32_t cell)
{
    return kiriGrid_Area(grid, cell) < kiriSliver * grid->side * grid->side;
}

bool kiriBorder_FindRing(const kiriBorder* border, int32_t face, bool upper, kiriRing* ring)
{
    const kiriGrid* grid = border->grid;
    const kiriFace* f = &grid->faces.data[face];
    int32_t axis = 1 - kiriFace_Axis(f), best[2] = { KIRI_NONE, KIRI_NONE };
    for (int32_t g = NextFaceAlong(grid, f->cell[0], grid->cells.data[f->cell[0]].firstFace, axis, upper);
         g != KIRI_NONE;
         g = NextFaceAlong(grid, f->cell[0], kiriFace_Next(&grid->faces.data[g], f->cell[0]), axis, upper)) {
        for (int32_t h = NextFaceAlong(grid, f->cell[1], grid->cells.data[f->cell[1]].firstFace, axis, upper);
             h != KIRI_NONE;
             h = NextFaceAlong(grid, f->cell[1], kiriFace_Next(&grid->faces.data[h], f->cell[1]), axis, upper)) {
            int32_t far[2] = { kiriFace_Other(&grid->faces.data[g], f->cell[0]),
                               kiriFace_Other(&grid->faces.data[h], f->cell[1]) };
            int32_t faces[4] = { face, g, h, FaceAlong(grid, far[0], far[1], 1 - axis) };
            bool isNone = faces[3] == KIRI_NONE || IsSliver(grid, far[0]) || IsSliver(grid, far[1]);
            if (!isNone && (best[0] == KIRI_NONE || IsRingBefore(grid, far, best))) {
                SetRing(ring, f, upper, far, faces);
                memcpy(best, far, sizeof(best));
            }
        }
    }
    return best[0] != KIRI_NONE && !IsSliver(grid, f->cell[0]) && !IsSliver(grid, f->cell[1]);
}

/* How many faces of the ring are between two regions. */
static int32_t CountBetween(const kiriBorder* border, const kiriRing* ring, int32_t i, int32_t j)
{
    const int32_t* owner = border->regions->field.owner.data;
    int32_t count = 0;
    for (int k = 0; k < 4; ++k) {
        int32_t a = owner[ring->cell[k]], b = owner[ring->cell[(k + 1) % 4]];
        count += (a == i && b == j) || (a == j && b == i);
    }
    return count;
}

/* The regions of a ring, ascending, then KIRI_NONE. */
static void ListRegions(const kiriBorder* border, const kiriRing* ring, int32_t region[KIRI_CORNER_REGIONS])
{
    int32_t count = 0;
    for (int k = 0; k < 4; ++k) {
        int32_t owner = border->regions->field.owner.data[ring->cell[k]], at = count;
        while (at > 0 && region[at - 1] > owner) {
            --at;
        }
        if (at == 0 || region[at - 1] != owner) {
            memmove(&region[at + 1], &region[at], sizeof(*region) * (size_t)(count - at));
            region[at] = owner;
            ++count;
        }
    }
    for (; count < KIRI_CORNER_REGIONS; ++count) {
        region[count] = KIRI_NONE;
    }
}

/* ---- Ends ------------------------------------------------------------------------------------------------------- */

static kiriVec2 StretchEnd(const kiriStretch* stretch, int32_t axis, bool upper)
{
    double half = upper ? 0.5 * stretch->width : -0.5 * stretch->width;
    return kiriVec2_Add(stretch->middle, axis == 0 ? kiriVec2_Make(0.0, half) : kiriVec2_Make(half, 0.0));
}

/* What the border does at an end of one of its faces; false where it goes on. */
static bool FindEnd(const kiriBorder* border, int32_t face, bool upper, bool bent, kiriLinkEnd* end)
{
    kiriRing ring;
    kiriBorderSide side = kiriBorder_SideOf(border, face);
    memset(end, 0, sizeof(*end));
    end->cell[0] = side.x;
    end->cell[1] = side.y;
    end->kind = KIRI_END_OPEN;
    kiriStretch stretch = kiriGrid_Stretch(border->grid, border->mesh, face);
    end->at = StretchEnd(&stretch, side.axis, upper);
    end->look = kiriVec2_Add(end->at, kiriVec2_Scale(1e-3, kiriVec2_Sub(stretch.middle, end->at)));
    if (kiriBorder_FindRing(border, face, upper, &ring)) {
        bool last = CountBetween(border, &ring, side.i, side.j) == 1;
        end->kind = last ? KIRI_END_CORNER : KIRI_END_INNER;
        int32_t upperRight = border->grid->cells.data[ring.cell[2]].square;
        end->at = kiriMesh_Local(border->mesh, kiriSquares_Corner(&border->mesh->squares, upperRight));
        if (last) {
            ListRegions(border, &ring, end->region);
        }
        return last || bent;
    }
    return true;
}

static bool IsSliverFace(const kiriBorder* border, int32_t face)
{
    const kiriGrid* grid = border->grid;
    const kiriFace* f = &grid->faces.data[face];
    return kiriGrid_Stretch(grid, border->mesh, face).width < kiriSliver * grid->side || IsSliver(grid, f->cell[0]) ||
           IsSliver(grid, f->cell[1]);
}

/* Slivers do not say where a border ends, unless it has nothing else. */
static bool HasOnlySlivers(const kiriBorder* border)
{
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        if (!IsSliverFace(border, border->work->stretch.data[k])) {
            return false;
        }
    }
    return true;
}

bool kiriBorder_IsSliver(const kiriBorder* border)
{
    double widest = 0.0;
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        double width = kiriGrid_Stretch(border->grid, border->mesh, border->work->stretch.data[k]).width;
        widest = kiriMax(width, widest);
    }
    bool isAlong = widest >= kiriSliver * border->grid->side, isNothing = widest < 1e-6 * border->grid->side;
    return (isAlong || isNothing) && HasOnlySlivers(border);
}

kiriLinkEnds kiriBorder_FindEnds(const kiriBorder* border, const kiriLink* link, bool bent)
{
    kiriLinkEnds ends;
    double low = 0.0, high = 0.0;
    bool any = false, takesAll = HasOnlySlivers(border);
    memset(&ends, 0, sizeof(ends));
    kiriBorderSide first = kiriBorder_SideOf(border, border->work->stretch.data[0]);
    for (int k = 0; k < 2; ++k) { /* a border that closes on itself */
        ends.end[k].kind = KIRI_END_INNER;
        ends.end[k].cell[0] = first.x;
        ends.end[k].cell[1] = first.y;
    }
    ends.end[0].at = ends.end[1].at = link->centroid;
    for (int32_t k = 0; k < 2 * border->work->stretch.count; ++k) {
        kiriLinkEnd end;
        int32_t face = border->work->stretch.data[k / 2];
        if ((takesAll || !IsSliverFace(border, face)) && FindEnd(border, face, k % 2 != 0, bent, &end)) {
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

void kiriLink_SetOuter(kiriLink* link, const kiriLinkEnds* ends)
{
    double sum = 0.0;
    for (int k = 0; k < 2; ++k) {
        double way = kiriVec2_Dot(kiriVec2_Sub(ends->end[k].at, link->crossing), link->tangent);
        way = k == 0 ? -way : way;
        if (ends->end[k].kind == KIRI_END_OPEN && way > 0.0) {
            sum += way;
        }
    }
    bool all = ends->end[0].kind == KIRI_END_OPEN && ends->end[1].kind == KIRI_END_OPEN;
    link->outer = all || sum > link->width ? link->width : sum;
}

/* ---- Corners ---------------------------------------------------------------------------------------------------- */

/* Below this determinant of N, of its trace squared, the links of a corner have one direction. */
static const double kiriFlatCorner = 1e-3;

/* An end that is as the grid has it may be off by two squares. */
static bool AreEndsOne(const kiriLinkEnd* a, const kiriLinkEnd* b, double side)
{
    return a->kind == KIRI_END_CORNER && b->kind == KIRI_END_CORNER &&
           memcmp(a->region, b->region, sizeof(a->region)) == 0 &&
           kiriVec2_Length(kiriVec2_Sub(a->at, b->at)) <= (a->isExact && b->isExact ? 1e-6 : 2.0) * side;
}

/* Lists the links that have this end, ascending; their number, or 5 where there are more than 4. */
static int32_t ListLinksAt(const kiriBorder* border, const kiriLinks* links, const kiriLinkEnd* end, int32_t list[4])
{
    int32_t count = 0;
    for (int a = 0; a < KIRI_CORNER_REGIONS && end->region[a] != KIRI_NONE; ++a) {
        for (int b = a + 1; b < KIRI_CORNER_REGIONS && end->region[b] != KIRI_NONE; ++b) {
            int32_t i = end->region[a], j = end->region[b];
            for (int32_t k = kiriLink_FirstOfPair(links->next.data, links->next.count, i, j);
                 k < links->next.count && links->next.data[k].i == i && links->next.data[k].j == j; ++k) {
                const kiriLinkEnds* ends = &border->work->nextEnds.data[k];
                double side = border->grid->side;
                if (AreEndsOne(&ends->end[0], end, side) || AreEndsOne(&ends->end[1], end, side)) {
                    if (count == 4) {
                        return 5;
                    }
                    list[count++] = k;
                }
            }
        }
    }
    return count;
}

/* Do the links form a ring: is each region between two of them? */
static bool IsRing(const kiriLinks* links, const kiriLinkEnd* end, const int32_t* list, int32_t count)
{
    for (int a = 0; a < KIRI_CORNER_REGIONS; ++a) {
        int32_t region = end->region[a], found = 0;
        for (int32_t k = 0; k < count; ++k) {
            found += links->next.data[list[k]].i == region || links->next.data[list[k]].j == region;
        }
        if (found != (a < count ? 2 : 0)) {
            return false;
        }
    }
    return true;
}

/* Of the triangle or quadrangle of the sites. Two links that share a region are two of its sides; where the ways bend
   these are not quite closed, so the areas that they give are averaged. */
static double AreaOf(const kiriLinks* links, const kiriCorner* corner)
{
    double sum = 0.0;
    for (int32_t a = 0; a < corner->count; ++a) {
        for (int32_t b = a + 1; b < corner->count; ++b) {
            const kiriLink *x = &links->next.data[corner->link[a]], *y = &links->next.data[corner->link[b]];
            bool shareRegion = x->i == y->i || x->i == y->j || x->j == y->i || x->j == y->j;
            sum += shareRegion ? fabs(x->span.x * y->span.y - x->span.y * y->span.x) : 0.0;
        }
    }
    return corner->count == 3 ? sum / 6.0 : sum / 4.0;
}

/* Sets the weights; false where the links have hardly more than one direction. */
static bool SetWeights(const kiriLinks* links, kiriCorner* corner)
{
    double xx = 0.0, xy = 0.0, yy = 0.0;
    for (int32_t k = 0; k < corner->count; ++k) {
        kiriVec2 s = links->next.data[corner->link[k]].span;
        xx += s.x * s.x;
        xy += s.x * s.y;
        yy += s.y * s.y;
    }
    double det = xx * yy - xy * xy, trace = xx + yy;
    if (!(det >= kiriFlatCorner * trace * trace)) {
        return false;
    }
    for (int32_t k = 0; k < corner->count; ++k) {
        kiriVec2 s = links->next.data[corner->link[k]].span;
        corner->weight[k] = kiriVec2_Make((yy * s.x - xy * s.y) / det, (xx * s.y - xy * s.x) / det);
    }
    return true;
}

/* The corner at an end of link k; false where there is none, or where a lower link has it as well. */
static bool MakeCorner(const kiriBorder* border, const kiriLinks* links, int32_t k, const kiriLinkEnd* end,
                       kiriCorner* corner)
{
    int32_t list[4], count = end->kind == KIRI_END_CORNER ? ListLinksAt(border, links, end, list) : 0;
    memset(corner, 0, sizeof(*corner));
    if (count < 3 || count > 4 || list[0] != k || !IsRing(links, end, list, count)) {
        return false;
    }
    corner->count = count;
    for (int32_t c = 0; c < 4; ++c) {
        corner->link[c] = c < count ? list[c] : KIRI_NONE;
    }
    corner->area = AreaOf(links, corner);
    return SetWeights(links, corner);
}

/* Is no region stale at the corners of a link? Then all links there are what they were. */
static bool AreCornersOld(const kiriBorder* border, const kiriLinks* links, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < links->was.count);
    const kiriLinkWork* work = border->work;
    bool isOld = links->was.data[k] != KIRI_NONE;
    for (int e = 0; isOld && e < 2; ++e) {
        const kiriLinkEnd* end = &work->nextEnds.data[k].end[e];
        for (int a = 0; end->kind == KIRI_END_CORNER && a < KIRI_CORNER_REGIONS && end->region[a] != KIRI_NONE; ++a) {
            isOld = isOld && (work->stale.data[end->region[a]] & KIRI_REGION_STALE) == 0;
        }
    }
    return isOld;
}

/* The corners whose lowest link is link k, as they are in force; *at goes on through these. */
static bool TakeCorners(const kiriBorder* border, kiriLinks* links, int32_t k, int32_t* at)
{
    KIRI_ASSERT(k >= 0 && k < links->was.count);
    const kiriLinkWork* work = border->work;
    bool ok = true;
    while (*at < links->corners.count && links->corners.data[*at].link[0] < links->was.data[k]) {
        ++*at;
    }
    for (; ok && *at < links->corners.count && links->corners.data[*at].link[0] == links->was.data[k]; ++*at) {
        kiriCorner corner = links->corners.data[*at];
        for (int32_t c = 0; c < corner.count; ++c) {
            corner.link[c] = work->now.data[corner.link[c]];
        }
        ok = kiriArray_Push(border->memory, &links->nextCorners, corner) &&
             kiriArray_Push(border->memory, &links->wasCorner, *at);
    }
    return ok;
}

static bool MakeCornersOf(const kiriBorder* border, kiriLinks* links, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < border->work->nextEnds.count);
    bool ok = true;
    for (int e = 0; ok && e < 2; ++e) {
        kiriCorner corner;
        if (MakeCorner(border, links, k, &border->work->nextEnds.data[k].end[e], &corner)) {
            ok = kiriArray_Push(border->memory, &links->nextCorners, corner) &&
                 kiriArray_Push(border->memory, &links->wasCorner, KIRI_NONE);
        }
    }
    return ok;
}

bool kiriBorder_MakeCorners(const kiriBorder* border, kiriLinks* links)
{
    int32_t at = 0;
    bool ok = true;
    links->nextCorners.count = 0;
    for (int32_t k = 0; ok && k < links->next.count; ++k) {
        ok = AreCornersOld(border, links, k) ? TakeCorners(border, links, k, &at) : MakeCornersOf(border, links, k);
    }
    return ok;
}
