#include "kiri_link_check.h"

#include "kiri_link_work.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------ */

static const kiriMust LinkMust[] = {
    KIRI_INDEX(KIRI_OF_FRAMES, kiriLink, i, j),
    KIRI_REALS(kiriLink, width, spread),
};

static const kiriMust LinkEndMust[] = {
    KIRI_WITHIN(KIRI_END_OPEN, KIRI_END_INNER, kiriLinkEnd, kind, kind),
    KIRI_INDEX_OR_NONE(KIRI_OF_FRAMES, kiriLinkEnd, region, region),
    KIRI_REALS(kiriLinkEnd, at, look),
};

static const kiriMust LinkEndsMust[] = {
    KIRI_PART_MUST(kiriLinkEnds, end, kiriLinkEnd, LinkEndMust),
};

static const kiriMust CornerMust[] = {
    KIRI_WITHIN(3, 4, kiriCorner, count, count),
    KIRI_INDEX_OR_NONE(KIRI_OF_LINKS, kiriCorner, link, link),
    KIRI_REALS(kiriCorner, weight, area),
};

static const kiriMust EndsOfLinksMust[] = {
    KIRI_ITEMS_MUST(kiriLinkWork, ends, LinkEndsMust),
};

static bool AreRowOfLinks(kiriCheck* check, const kiriLink* links, int32_t count)
{
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

bool kiriLinks_Check(const kiriLinks* links, kiriCheck* check)
{
    const kiriLinkWork* work = links->work;
    return kiriCheck_That(check, work != NULL && work->ends.count == links->links.count) &&
           AreRowOfLinks(check, links->links.data, links->links.count) &&
           AreCornersOfLinks(check, links->corners.data, links->corners.count, links->links.data, links->links.count) &&
           kiriCheck_Object(check, EndsOfLinksMust, work);
}
