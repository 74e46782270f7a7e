#include "kiri_field_check.h"
#include "kiri_link_work.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------ */

static const kiriMust IsLinkFace[] = { KIRI_INDEX(KIRI_OF_FACES, kiriSpan, first, first) };

static const kiriMust LinkMust[] = {
    KIRI_INDEX(KIRI_OF_REGIONS, kiriLink, i, j),
    KIRI_REALS(kiriLink, width, spread),
};

static const kiriMust LinkEndMust[] = {
    KIRI_WITHIN(KIRI_END_OPEN, KIRI_END_INNER, kiriLinkEnd, kind, kind),
    KIRI_INDEX_OR_NONE(KIRI_OF_SITES, kiriLinkEnd, region, region),
    KIRI_REALS(kiriLinkEnd, at, look),
};

static const kiriMust LinkEndsMust[] = {
    KIRI_PART_MUST(kiriLinkEnds, end, kiriLinkEnd, LinkEndMust),
};

static const kiriMust NewLinkMust[] = {
    KIRI_INDEX(KIRI_OF_SITES, kiriNewLink, link.i, link.j),
    KIRI_PART_MUST(kiriNewLink, ends, kiriLinkEnds, LinkEndsMust),
    KIRI_REALS(kiriNewLink, link.width, link.spread),
    KIRI_INDEX_OR_NONE(KIRI_OF_FACES, kiriNewLink, face, face),
};

static const kiriMust CornerMust[] = {
    KIRI_WITHIN(3, 4, kiriCorner, count, count),
    KIRI_INDEX_OR_NONE(KIRI_OF_LINKS, kiriCorner, link, link),
    KIRI_REALS(kiriCorner, weight, area),
};

static const kiriMust RegionPairMust[] = {
    KIRI_INDEX(KIRI_OF_SITES, kiriRegionPair, i, j),
};

static const kiriMust SightEdgeMust[] = {
    KIRI_REALS(kiriSightEdge, tail, after),
    KIRI_INDEX(KIRI_OF_HALF_EDGES, kiriSightEdge, edge, edge),
    KIRI_INDEX(KIRI_OF_CELLS, kiriSightEdge, cell, cell),
};

static const kiriMust RunningLinksMust[] = {
    KIRI_WITHIN(INT32_MIN, INT32_MAX - 1, kiriLinkWork, at, at),
    KIRI_COUNTS(kiriLinkWork, due, due),
    KIRI_LENGTH(KIRI_OF_SITES, kiriLinkWork, stale),
    KIRI_ITEMS_MUST(kiriLinkWork, touched, RegionPairMust),
    KIRI_ITEMS_MUST(kiriLinkWork, faces, IsLinkFace),
    KIRI_ITEMS_MUST(kiriLinkWork, made, NewLinkMust),
    KIRI_LENGTH(KIRI_OF_SQUARES, kiriLinkWork, edges.listed),
    KIRI_ITEMS_MUST(kiriLinkWork, edges.edges, SightEdgeMust),
};

static const kiriMust EndsOfLinksMust[] = {
    KIRI_ITEMS_MUST(kiriLinkWork, ends, LinkEndsMust),
};

static bool AreRowOfLinks(kiriCheck* check, const kiriLink* links, int32_t count, int64_t frames)
{
    check->count[KIRI_OF_REGIONS] = frames;
    bool areFine = true;
    for (int32_t k = 0; areFine && k < count; ++k) {
        const kiriLink* link = &links[k];
        areFine = kiriCheck_Object(check, LinkMust, link) &&
                  kiriCheck_That(check, link->i < link->j && link->width > 0.0 && link->length > 0.0) &&
                  kiriCheck_That(check, k == 0 || links[k - 1].i < link->i ||
                                            (links[k - 1].i == link->i && links[k - 1].j <= link->j));
    }
    return areFine;
}

/* Its links join as many frames as there are links, in a ring: each is of two of them. */
static bool IsRingOfLinks(const kiriCorner* corner, const kiriLink* links)
{
    bool isRing = true;
    for (int32_t c = 0; isRing && c < 2 * corner->count; ++c) {
        const kiriLink* link = &links[corner->link[c / 2]];
        int32_t frame = c % 2 == 0 ? link->i : link->j, times = 0;
        for (int32_t k = 0; k < corner->count; ++k) {
            times += links[corner->link[k]].i == frame || links[corner->link[k]].j == frame;
        }
        isRing = times == 2;
    }
    return isRing;
}

static bool AreCornersOfLinks(kiriCheck* check, const kiriCorner* corners, int32_t count, const kiriLink* links,
                              int32_t linkCount)
{
    bool areFine = true;
    check->count[KIRI_OF_LINKS] = linkCount;
    for (int32_t k = 0; areFine && k < count; ++k) {
        const kiriCorner* corner = &corners[k];
        areFine = kiriCheck_Object(check, CornerMust, corner);
        for (int32_t c = 0; areFine && c < corner->count; ++c) {
            areFine = kiriCheck_That(check, corner->link[c] > (c > 0 ? corner->link[c - 1] : KIRI_NONE));
        }
        areFine = areFine && kiriCheck_That(check, IsRingOfLinks(corner, links));
    }
    return areFine;
}

/* Edges that were seen, by square: of a square that is not in the list nothing is known. */
static bool AreSights(kiriCheck* check, const kiriLinkWork* work)
{
    const kiriSightEdges* edges = &work->edges;
    kiriIndices squares = { edges->squares.data, edges->squares.count, edges->squares.capacity };
    bool areFine = kiriCheck_Distinct(check, &squares, edges->listed.count);
    int32_t known = 0;
    for (int32_t s = 0; areFine && s < edges->listed.count; ++s) {
        known += edges->listed.data[s] != KIRI_NONE;
    }
    for (int32_t k = 0; areFine && k < edges->spans.count; ++k) {
        kiriSpan span = edges->spans.data[k];
        areFine = k < squares.count && edges->listed.data[squares.data[k]] == k && span.count >= 0 && span.first >= 0 &&
                  (int64_t)span.first + span.count <= edges->edges.count;
    }
    return kiriCheck_That(check, areFine && known == edges->spans.count &&
                                     edges->listed.count <= check->count[KIRI_OF_SQUARES]);
}

/* They are of the border of the material: a walk around a vertex that begins at one ends. */
static bool AreOfMaterial(const kiriSightEdges* edges, const kiriMeshData* mesh)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < edges->edges.count; ++k) {
        int32_t h = edges->edges.data[k].edge;
        areFine = kiriMesh_IsTriangle(mesh, h / 3) && (kiriMesh_Twin(mesh, h) == KIRI_NONE || kiriMesh_IsOpen(mesh, h));
    }
    return areFine;
}

/* Marked are faces at hand alone, each of which comes once. */
static bool AreMarksOfFaces(kiriCheck* check, const kiriLinkWork* work, int32_t faces)
{
    kiriIndices listed = { work->faces.data, work->running ? work->faces.count : 0, work->faces.capacity };
    bool areFine = (!work->running || work->marks.count >= faces) &&
                   kiriCheck_Distinct(check, &listed, work->marks.count);
    int32_t marked = 0;
    for (int32_t k = 0; areFine && k < work->marks.count; ++k) {
        areFine = work->marks.data[k] <= KIRI_FACE_BENT;
        marked += work->marks.data[k] != KIRI_FACE_PASSED;
    }
    for (int32_t k = 0; areFine && k < listed.count; ++k) {
        marked -= work->marks.data[listed.data[k]] != KIRI_FACE_PASSED;
    }
    return areFine && marked == 0;
}

static bool IsFaceOfBorder(const kiriGrid* grid, const int32_t* owner, int32_t f, int32_t i, int32_t j)
{
    const int32_t* cell = grid->faces.data[f].cell;
    return cell[0] != KIRI_NONE && ((owner[cell[0]] == i && owner[cell[1]] == j) ||
                                    (owner[cell[0]] == j && owner[cell[1]] == i));
}

/* It is of a face between its regions; or is one of the links in force, of which there are none that are made. */
static bool IsMadeLink(const kiriLinks* links, const kiriGrid* grid, const kiriRegions* regions,
                       const kiriNewLink* made)
{
    const kiriLink* link = &made->link;
    const int32_t* owner = regions->field.owner.data;
    if (link->i >= link->j || (!made->isOld && !(link->width > 0.0 && link->length > 0.0))) {
        return false;
    }
    if (made->face != KIRI_NONE) {
        return IsFaceOfBorder(grid, owner, made->face, link->i, link->j);
    }
    int32_t first = kiriLink_FirstOfPair(links->links.data, links->links.count, link->i, link->j);
    return made->isOld && first < links->links.count && links->links.data[first].i == link->i &&
           links->links.data[first].j == link->j;
}

static bool AreCellsOfEnds(const kiriGrid* grid, const kiriLinkEnds* ends)
{
    bool areFine = true;
    for (int e = 0; areFine && e < 2; ++e) {
        const int32_t* cells = ends->end[e].cell;
        areFine = cells[0] >= 0 && cells[0] < grid->cells.count && cells[1] >= 0 && cells[1] < grid->cells.count;
    }
    return areFine;
}

/* Faces at hand are borders. What was made is of no more use when the next links are there, and paid for. */
static bool AreFacesAtHand(const kiriLinks* links, const kiriGrid* grid, const kiriRegions* regions)
{
    const kiriLinkWork* work = links->work;
    const int32_t* owner = regions->field.owner.data;
    bool areFine = true;
    for (int32_t k = 0; areFine && k < work->faces.count; ++k) {
        const kiriFace* face = &grid->faces.data[work->faces.data[k]];
        areFine = face->cell[0] != KIRI_NONE && owner[face->cell[0]] != owner[face->cell[1]];
    }
    for (int32_t k = 0; areFine && work->at <= work->faces.count && k < work->made.count; ++k) {
        areFine = AreCellsOfEnds(grid, &work->made.data[k].ends) &&
                  IsMadeLink(links, grid, regions, &work->made.data[k]);
    }
    return areFine;
}

bool kiriLinks_Check(const kiriLinks* links, const kiriGrid* grid, const kiriMeshData* mesh, const kiriRegions* regions,
                     kiriCheck* check)
{
    const kiriLinkWork* work = links->work;
    if (!kiriCheck_That(check, work != NULL && work->ends.count == links->links.count &&
                                   work->nextEnds.count == links->next.count)) {
        return false;
    }
    return AreRowOfLinks(check, links->next.data, links->next.count, check->count[KIRI_OF_SITES]) &&
           AreCornersOfLinks(check, links->nextCorners.data, links->nextCorners.count, links->next.data,
                             links->next.count) &&
           AreRowOfLinks(check, links->links.data, links->links.count, check->count[KIRI_OF_FRAMES]) &&
           AreCornersOfLinks(check, links->corners.data, links->corners.count, links->links.data, links->links.count) &&
           kiriCheck_Object(check, EndsOfLinksMust, work) && AreSights(check, work) &&
           kiriCheck_That(check, AreMarksOfFaces(check, work, grid->faces.count)) &&
           (!work->running || (kiriCheck_Object(check, RunningLinksMust, work) &&
                               kiriCheck_That(check, work->at >= -2 * (int64_t)work->stale.count - 1 &&
                                                         AreOfMaterial(&work->edges, mesh) &&
                                                         AreFacesAtHand(links, grid, regions))));
}

bool kiriLinks_AreAtWork(const kiriLinks* links)
{
    return links->work != NULL && links->work->running;
}
