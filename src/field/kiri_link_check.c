#include "kiri_field_check.h"
#include "kiri_link_work.h"

/* ---- Rules -------------------------------------------------------------------------------------------------------- */

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

static const kiriMust CornerMust[] = {
    KIRI_WITHIN(3, 4, kiriCorner, count, count),
    KIRI_INDEX_OR_NONE(KIRI_OF_LINKS, kiriCorner, link, link),
    KIRI_REALS(kiriCorner, weight, area),
};

static const kiriMust EndsOfLinksMust[] = {
    KIRI_ITEMS_MUST(kiriLinkWork, ends, LinkEndsMust),
};

/* ---- Links and corners -------------------------------------------------------------------------------------------- */

/* In their order. */
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

static bool AreCornersOfLinks(kiriCheck* check, const kiriCorner* corners, int32_t count, int32_t links)
{
    bool areFine = true;
    check->count[KIRI_OF_LINKS] = links;
    for (int32_t k = 0; areFine && k < count; ++k) {
        const kiriCorner* corner = &corners[k];
        areFine = kiriCheck_Object(check, CornerMust, corner);
        for (int32_t c = 0; areFine && c < corner->count; ++c) {
            areFine = kiriCheck_That(check, corner->link[c] > (c > 0 ? corner->link[c - 1] : KIRI_NONE));
        }
    }
    return areFine;
}

bool kiriLinks_Check(const kiriLinks* links, kiriCheck* check)
{
    const kiriLinkWork* work = links->work;
    return kiriCheck_That(check, work != NULL && work->ends.count == links->links.count &&
                                     work->nextEnds.count == links->next.count) &&
           AreRowOfLinks(check, links->next.data, links->next.count, check->count[KIRI_OF_SITES]) &&
           AreCornersOfLinks(check, links->nextCorners.data, links->nextCorners.count, links->next.count) &&
           AreRowOfLinks(check, links->links.data, links->links.count, check->count[KIRI_OF_FRAMES]) &&
           AreCornersOfLinks(check, links->corners.data, links->corners.count, links->links.count) &&
           kiriCheck_Object(check, EndsOfLinksMust, work);
}
