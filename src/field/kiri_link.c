#include "kiri_link_work.h"

#include "../core/kiri_sort.h"

#include <string.h>

/* CountChanged compares bytes. */
typedef char LinkHasNoPadding[sizeof(kiriLink) == 2 * sizeof(int32_t) + 20 * sizeof(double) ? 1 : -1];

static bool IsStale(const kiriBorder* border, int32_t region)
{
    KIRI_ASSERT(region >= 0 && region < border->siteCount);
    return (border->work->stale.data[region] & KIRI_REGION_STALE) != 0;
}

/* ---- Order ------------------------------------------------------------------------------------------------------ */

static bool IsOfPair(const kiriLink* link, const kiriLink* other)
{
    return link->i == other->i && link->j == other->j;
}

static bool IsPairBefore(const kiriLink* a, const kiriLink* b)
{
    return a->i != b->i ? a->i < b->i : a->j < b->j;
}

int32_t kiriLink_FirstOfPair(const kiriLink* links, int32_t count, int32_t i, int32_t j)
{
    int32_t low;
    KIRI_SEARCH(low, 0, count, links[middle].i < i || (links[middle].i == i && links[middle].j < j));
    return low;
}

static bool IsMadeBefore(const void* context, int32_t a, int32_t b)
{
    const kiriBorder* border = context;
    const kiriNewLink *x = &border->work->made.data[a], *y = &border->work->made.data[b];
    if (x->link.i != y->link.i) {
        return x->link.i < y->link.i;
    }
    if (x->link.j != y->link.j || x->face == KIRI_NONE || y->face == KIRI_NONE) {
        return x->link.j != y->link.j ? x->link.j < y->link.j : a < b; /* those of a pair that is kept are in order */
    }
    return kiriBorder_IsFaceBefore(border, x->face, y->face);
}

/* In items of the budget: a border cell the steps of which are looked at, one the faces of which are, and a link that
   is kept. */
enum { STALE_ITEMS = 1, FACES_ITEMS = 1, KEPT_ITEMS = 4 };

/* ---- All links of regions that are stale ---------------------------------------------------------------------- */

/* Marks the regions that a step leads to from this border cell. */
static void SpreadStale(const kiriBorder* border, int32_t cell)
{
    kiriSteps steps;
    kiriGrid_GetSteps(border->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t owner = border->regions->field.owner.data[steps.data[s].cell];
        KIRI_ASSERT(owner != KIRI_NONE);
        border->work->stale.data[owner] |= KIRI_REGION_STALE;
    }
}

/* Stale are the regions that are dirty, and those beside them: where a link ends depends on what it meets there. */
static void MarkDirtyStale(const kiriBorder* border)
{
    for (int32_t i = 0; i < border->siteCount; ++i) {
        border->work->stale.data[i] = border->regions->dirty.data[i] ? KIRI_REGION_STALE : 0;
    }
}

/* Those beside one region. */
static void FindStaleBeside(const kiriBorder* border, int32_t region)
{
    const kiriRegions* regions = border->regions;
    int32_t cell = regions->dirty.data[region] ? regions->border.first.data[region] : KIRI_NONE;
    for (; cell != KIRI_NONE; cell = regions->border.cells.data[cell].next) {
        SpreadStale(border, cell);
        border->work->due += STALE_ITEMS;
    }
}

/* ---- Pairs of regions that are kept ---- */

static bool IsPairTouched(const kiriBorder* border, int32_t i, int32_t j)
{
    const kiriRegionPair* pairs = border->work->touched.data;
    int32_t low;
    KIRI_SEARCH(low, 0, border->work->touched.count,
                pairs[middle].i < i || (pairs[middle].i == i && pairs[middle].j < j));
    return low < border->work->touched.count && pairs[low].i == i && pairs[low].j == j;
}

/* Links of one pair, from the first up to the end, neither of whose regions is dirty. Where a border ends is asked at
   each of its faces: so one of the regions must have no dirty one anywhere beside it. */
static bool KeepPair(const kiriBorder* border, const kiriLinks* links, int32_t first, int32_t end)
{
    KIRI_ASSERT(first >= 0 && first < links->links.count);
    kiriLinkWork* work = border->work;
    const kiriLink* link = &links->links.data[first];
    bool ok = true, isUntouched = !IsStale(border, link->i) || !IsStale(border, link->j);
    for (int32_t k = first; isUntouched && k < end; ++k) {
        isUntouched = kiriBorder_IsUntouched(border, &work->ends.data[k]);
    }
    if (!isUntouched) {
        work->stale.data[link->i] |= KIRI_REGION_TOUCHED;
        return kiriArray_Push(border->memory, &work->touched, ((kiriRegionPair){ link->i, link->j }));
    }
    for (int32_t k = first; ok && k < end; ++k) {
        kiriNewLink kept = { links->links.data[k], work->ends.data[k], KIRI_NONE, true };
        ok = kiriArray_Push(border->memory, &work->made, kept);
    }
    return ok;
}

/* The border of two regions that are not dirty is what it was, and where no dirty region is near it so are its
   links. */
static bool KeepUntouched(const kiriBorder* border, const kiriLinks* links)
{
    const uint8_t* dirty = border->regions->dirty.data;
    int32_t end = 0;
    for (int32_t first = 0; first < links->links.count; first = end) {
        kiriRegionPair pair = border->work->pairs.data[first];
        if (!IsStale(border, pair.i) && !IsStale(border, pair.j)) {
            ++end;
            continue;
        }
        while (end < links->links.count && IsOfPair(&links->links.data[end], &links->links.data[first])) {
            ++end;
        }
        bool isAsked = !dirty[pair.i] && !dirty[pair.j] && !border->work->ends.data[first].isShort;
        if (isAsked && !KeepPair(border, links, first, end)) {
            return false;
        }
    }
    return true;
}

/* ---- Faces of the others ---- */

/* A face is found from the region that is dirty, or from the lower one. */
static bool IsFoundFrom(const kiriBorder* border, int32_t region, int32_t other)
{
    const uint8_t* dirty = border->regions->dirty.data;
    if (dirty[region] || dirty[other]) {
        return dirty[region] && (region < other || !dirty[other]);
    }
    return region < other && IsPairTouched(border, region, other);
}

static bool FindFacesOf(const kiriBorder* border, int32_t region, int32_t cell)
{
    const kiriGrid* grid = border->grid;
    for (int32_t f = grid->cells.data[cell].firstFace; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        int32_t other = border->regions->field.owner.data[kiriFace_Other(face, cell)];
        if (other != region && IsFoundFrom(border, region, other)) {
            if (!kiriArray_Push(border->memory, &border->work->faces, f)) {
                return false;
            }
            border->work->marks.data[f] = KIRI_FACE_FOUND; /* what is listed is cleared */
        }
        f = kiriFace_Next(face, cell);
    }
    return true;
}

static bool FindFacesFrom(const kiriBorder* border, int32_t region)
{
    KIRI_ASSERT(region >= 0 && region < border->work->stale.count);
    const kiriRegions* regions = border->regions;
    bool ok = true,
         isAsked = regions->dirty.data[region] || (border->work->stale.data[region] & KIRI_REGION_TOUCHED) != 0;
    int32_t cell = isAsked ? regions->border.first.data[region] : KIRI_NONE;
    for (; ok && cell != KIRI_NONE; cell = regions->border.cells.data[cell].next) {
        ok = FindFacesOf(border, region, cell);
        border->work->due += FACES_ITEMS;
    }
    return ok;
}

static bool SortMade(const kiriBorder* border)
{
    kiriLinkWork* work = border->work;
    if (!kiriArray_Resize(border->memory, &work->order, work->made.count)) {
        return false;
    }
    for (int32_t k = 0; k < work->order.count; ++k) {
        work->order.data[k] = k;
    }
    kiriSort(work->order.data, work->order.count, IsMadeBefore, border);
    return true;
}

/* Is there a link of two regions among those that were made: the sorted ones, or what was added to them? */
static bool IsMade(const kiriBorder* border, int32_t i, int32_t j)
{
    const kiriLinkWork* work = border->work;
    int32_t low = 0, high = work->order.count;
    while (low < high) {
        int32_t middle = low + (high - low) / 2;
        const kiriLink* link = &work->made.data[work->order.data[middle]].link;
        if (link->i == i && link->j == j) {
            return true;
        }
        if (link->i < i || (link->i == i && link->j < j)) {
            low = middle + 1;
        } else {
            high = middle;
        }
    }
    for (int32_t k = work->order.count; k < work->made.count; ++k) {
        if (work->made.data[k].link.i == i && work->made.data[k].link.j == j) {
            return true;
        }
    }
    return false;
}

static bool AddShortLinksAt(const kiriBorder* border, const kiriLinkEnd* end, int which)
{
    const int32_t* owner = border->regions->field.owner.data;
    int32_t at = 0, cells[2], last = KIRI_NONE;
    while (kiriBorder_FindBeside(border, end, which, &at, cells)) {
        kiriNewLink made;
        if (owner[cells[1]] != last && !IsMade(border, owner[cells[0]], owner[cells[1]]) &&
            kiriBorder_MakeShort(border, end, cells, &made) &&
            !kiriArray_Push(border->memory, &border->work->made, made)) {
            return false;
        }
        last = owner[cells[1]];
    }
    return true;
}

/* Borders that the grid misses are found where other borders of their lower region end, which is stale. */
static bool AddShortLinks(const kiriBorder* border)
{
    kiriLinkWork* work = border->work;
    bool ok = true;
    for (int32_t k = 0; ok && k < work->order.count; ++k) {
        for (int e = 0; ok && e < 4; ++e) {
            const kiriNewLink* made = &work->made.data[work->order.data[k]];
            kiriLinkEnd end = made->ends.end[e / 2];
            if (IsStale(border, e % 2 == 0 ? made->link.i : made->link.j)) {
                ok = AddShortLinksAt(border, &end, e % 2);
            }
        }
    }
    return ok;
}

/* Neither region of an old link is dirty: so it is the link of its pair that has the same rank. False where there is
   none, of bytes that were made up. */
static bool TakeOldLinks(const kiriBorder* border, const kiriLinks* links)
{
    const kiriLinkWork* work = border->work;
    int32_t old = 0;
    bool areThere = true;
    for (int32_t k = 0; areThere && k < work->order.count; ++k) {
        kiriNewLink* made = &work->made.data[work->order.data[k]];
        int32_t first = kiriLink_FirstOfPair(links->links.data, links->links.count, made->link.i, made->link.j);
        old = kiriMax(first, old);
        while (old < links->links.count &&
               (IsPairBefore(&links->links.data[old], &made->link) || work->ends.data[old].isShort)) {
            ++old;
        }
        bool isOfPair = old < links->links.count && !IsPairBefore(&made->link, &links->links.data[old]);
        areThere = isOfPair || !made->isOld;
        if (made->isOld && isOfPair) {
            made->link = links->links.data[old];
            made->ends = work->ends.data[old];
        }
        old += isOfPair;
    }
    return areThere;
}

/* ---- The whole -------------------------------------------------------------------------------------------------- */

/* Where they are not there from the last update: of links that were read, be it amid an update, or are left. */
static bool ListRegionPairs(const kiriBorder* border, const kiriLinks* links)
{
    kiriLinkWork* work = border->work;
    if (work->pairs.count == links->links.count) {
        return true;
    }
    if (!kiriArray_Resize(border->memory, &work->pairs, links->links.count)) {
        return false;
    }
    for (int32_t k = 0; k < links->links.count; ++k) {
        work->pairs.data[k] = (kiriRegionPair){ links->links.data[k].i, links->links.data[k].j };
    }
    return true;
}

static bool MakeLinkRoom(const kiriBorder* border)
{
    kiriLinkWork* work = border->work;
    int32_t old = work->marks.count;
    work->edges.memory = border->memory;
    if (!kiriSightEdges_Start(&work->edges, border->mesh) ||
        !kiriArray_Resize(border->memory, &work->stale, border->siteCount) ||
        (old < border->grid->faces.count &&
         !kiriArray_Resize(border->memory, &work->marks, border->grid->faces.count))) {
        return false;
    }
    for (int32_t f = old; f < work->marks.count; ++f) {
        work->marks.data[f] = KIRI_FACE_PASSED;
    }
    work->faces.count = work->made.count = work->touched.count = 0;
    return true;
}

static void AddNext(const kiriBorder* border, kiriLinks* links, const kiriLink* link, const kiriLinkEnds* ends,
                    int32_t was)
{
    links->was.data[links->was.count++] = was;
    links->next.data[links->next.count++] = *link;
    border->work->nextEnds.data[border->work->nextEnds.count++] = *ends;
    border->work->nextPairs.data[border->work->nextPairs.count++] = (kiriRegionPair){ link->i, link->j };
}

/* The room of the next links has those that were in force before the last commit. A link that stays where it was then
   is not written again: in a large sheet most are not. */
static void TakeOver(const kiriBorder* border, kiriLinks* links, int32_t k)
{
    kiriLinkWork* work = border->work;
    int32_t at = links->next.count;
    KIRI_ASSERT(work->pairs.data[k].i == links->links.data[k].i && work->pairs.data[k].j == links->links.data[k].j);
    work->now.data[k] = at;
    if (k < work->before.count && work->before.data[k] == at) {
        KIRI_ASSERT(memcmp(&links->next.data[at], &links->links.data[k], sizeof(kiriLink)) == 0);
        links->was.data[links->was.count++] = k;
        work->nextPairs.data[work->nextPairs.count++] = work->pairs.data[k];
        links->next.count = work->nextEnds.count = at + 1;
    } else {
        AddNext(border, links, &links->links.data[k], &work->ends.data[k], k);
    }
}

/* Nothing is known any more of the room of the next links. */
static void TakeBefore(kiriLinks* links)
{
    kiriLinkWork* work = links->work;
    kiriArrayHeader before = kiriArray_GetHeader(&work->before);
    kiriArray_SetHeader(&work->before, kiriArray_GetHeader(&links->was));
    kiriArray_SetHeader(&links->was, before);
    work->before.count = work->isTwin ? work->before.count : 0;
    work->isTwin = false;
    links->was.count = links->wasCorner.count = work->nextPairs.count = 0;
}

/* Takes over the links of pairs that are not stale, between those that were made; no pair has both. */
static bool MergeLinks(const kiriBorder* border, kiriLinks* links)
{
    kiriLinkWork* work = border->work;
    int32_t made = 0;
    int64_t most = (int64_t)links->links.count + work->made.count;
    work->isTwin = work->isTwin && most <= links->next.capacity && most <= work->nextEnds.capacity;
    if (!kiriArray_Reserve(border->memory, &links->next, most) ||
        !kiriArray_Reserve(border->memory, &work->nextEnds, most) ||
        !kiriArray_Reserve(border->memory, &work->nextPairs, most) ||
        !kiriArray_Reserve(border->memory, &work->before, most) ||
        !kiriArray_Reserve(border->memory, &links->was, most) ||
        !kiriArray_Resize(border->memory, &work->now, links->links.count)) {
        return false;
    }
    TakeBefore(links);
    for (int32_t k = 0; k < links->links.count; ++k) {
        kiriRegionPair pair = work->pairs.data[k];
        if (!IsStale(border, pair.i) && (!IsStale(border, pair.j) || work->ends.data[k].isShort)) {
            for (; made < work->made.count; ++made) {
                const kiriNewLink* first = &work->made.data[work->order.data[made]];
                if (first->link.i > pair.i || (first->link.i == pair.i && first->link.j >= pair.j)) {
                    break;
                }
                AddNext(border, links, &first->link, &first->ends, KIRI_NONE);
            }
            TakeOver(border, links, k);
        }
    }
    for (; made < work->made.count; ++made) {
        const kiriNewLink* last = &work->made.data[work->order.data[made]];
        AddNext(border, links, &last->link, &last->ends, KIRI_NONE);
    }
    return true;
}

/* How many links are not bit for bit what they were. */
static int32_t CountChanged(const kiriLinks* links)
{
    int32_t changed = 0, old = 0;
    for (int32_t k = 0; k < links->next.count; ++k) {
        const kiriLink* link = &links->next.data[k];
        if (links->was.data[k] == old) {
            ++old;
            continue;
        }
        while (old < links->links.count && IsPairBefore(&links->links.data[old], link)) {
            ++old;
        }
        bool same = old < links->links.count && IsOfPair(&links->links.data[old], link) &&
                    memcmp(&links->links.data[old], link, sizeof(*link)) == 0;
        old += old < links->links.count && IsOfPair(&links->links.data[old], link);
        changed += !same;
    }
    return changed;
}

static bool BeginLinks(const kiriBorder* border, kiriLinks* links)
{
    kiriLinkWork* work = border->work;
    links->next.count = work->nextEnds.count = links->changed = 0;
    work->running = true;
    work->at = -2 * border->siteCount - 1;
    work->due = 0;
    if (!MakeLinkRoom(border)) {
        return false;
    }
    MarkDirtyStale(border);
    return true;
}

/* Regions that are not dirty take no turn. */
static void SkipClean(const kiriBorder* border)
{
    kiriLinkWork* work = border->work;
    int32_t start = -2 * border->siteCount - 1, end = -border->siteCount - 1;
    while (work->at < end && !border->regions->dirty.data[work->at - start]) {
        ++work->at;
    }
}

/* Before the first face, where `at` is 0: what is stale, region by region, then what is kept, then the faces of the
   rest, region by region. */
static bool FindLinksToMake(const kiriBorder* border, const kiriLinks* links, int32_t at)
{
    kiriLinkWork* work = border->work;
    int32_t count = border->siteCount;
    if (at < -count - 1) {
        FindStaleBeside(border, at + 2 * count + 1);
        SkipClean(border);
        return true;
    }
    if (at >= -count) {
        return FindFacesFrom(border, at + count);
    }
    bool ok = KeepUntouched(border, links);
    work->due += KEPT_ITEMS * (int64_t)work->made.count;
    return ok;
}

static bool FinishLinks(const kiriBorder* border, kiriLinks* links)
{
    kiriLinkWork* work = border->work;
    bool ok = SortMade(border) && TakeOldLinks(border, links) && AddShortLinks(border) && SortMade(border) &&
              !work->edges.failed && MergeLinks(border, links) && kiriBorder_MakeCorners(border, links);
    if (ok) {
        links->changed = CountChanged(links);
        work->due += 2 * (int64_t)links->next.count;
    }
    return ok;
}

static void EndLinks(kiriLinkWork* work)
{
    for (int32_t k = 0; work->running && k < work->faces.count; ++k) {
        work->marks.data[work->faces.data[k]] = KIRI_FACE_PASSED;
    }
    work->running = false;
}

void kiriLinks_Drop(kiriLinks* links)
{
    links->next.count = links->nextCorners.count = 0; /* they may be of regions that go */
    if (links->work != NULL) {
        EndLinks(links->work);
        links->work->nextEnds.count = links->work->nextPairs.count = 0;
        links->work->isTwin = false;
    }
    links->was.count = links->wasCorner.count = 0;
}

void kiriLinks_BeginAgain(kiriLinks* links)
{
    if (links->work != NULL && links->work->running) {
        kiriLinks_Drop(links);
    }
}

/* What is to be made, face by face, then the whole. Edges that are seen first are an item each: a square may have
   thousands. */
static kiriProgress RunLinks(const kiriBorder* border, kiriLinks* links, kiriQuota* quota)
{
    kiriLinkWork* work = border->work;
    bool ok = true;
    while (ok && kiriQuota_Pay(quota, &work->due)) {
        int32_t at = work->at++, seen = work->edges.edges.count;
        if (at < 0) {
            ok = FindLinksToMake(border, links, at);
        } else if (at > work->faces.count) {
            return KIRI_DONE;
        } else if (at == work->faces.count) {
            ok = FinishLinks(border, links);
        } else if (work->marks.data[work->faces.data[at]] == KIRI_FACE_FOUND) {
            ok = kiriBorder_MakeLinksAt(border, work->faces.data[at]) && !work->edges.failed;
        }
        work->due += work->edges.edges.count - seen;
    }
    return ok ? KIRI_MORE : KIRI_FAILED;
}

kiriProgress kiriLinks_Update(kiriLinks* links, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                              const kiriRegions* regions, const kiriSite* sites, int32_t siteCount, kiriQuota* quota)
{
    if (links->work == NULL) {
        links->work = kiriMemory_AllocZeroed(memory, sizeof(*links->work));
    }
    if (links->work == NULL) {
        return KIRI_FAILED;
    }
    KIRI_ASSERT(regions->dirty.count == siteCount && regions->border.first.count == siteCount && !regions->running);
    kiriBorder border = { memory, grid, mesh, regions, sites, siteCount, links->work };
    bool ok = (links->work->running || BeginLinks(&border, links)) && ListRegionPairs(&border, links);
    kiriProgress progress = ok ? RunLinks(&border, links, quota) : KIRI_FAILED;
    if (progress != KIRI_MORE) {
        EndLinks(links->work);
    }
    return progress;
}

/* ---- What is left ---- */

static kiriLinkEnds EndsTo(const kiriKeep* frames, kiriLinkEnds ends)
{
    for (int k = 0; k < 2 * KIRI_CORNER_REGIONS; ++k) {
        int32_t* region = &ends.end[k / KIRI_CORNER_REGIONS].region[k % KIRI_CORNER_REGIONS];
        *region = kiriKeep_To(frames, *region);
    }
    return ends;
}

static bool KeepCorners(kiriLinks* links, kiriMemory* memory, const kiriKeep* kept)
{
    bool ok = true;
    for (int32_t c = 0; ok && c < links->corners.count; ++c) {
        kiriCorner corner = links->corners.data[c];
        if (kiriKeep_Has(kept, corner.link[0])) {
            for (int32_t k = 0; k < corner.count; ++k) {
                corner.link[k] = kiriKeep_To(kept, corner.link[k]);
            }
            ok = kiriArray_Push(memory, &links->nextCorners, corner);
        }
    }
    return ok;
}

bool kiriLinks_Keep(kiriLinks* links, kiriMemory* memory, const kiriKeep* kept, const kiriKeep* frames)
{
    kiriLinkWork* work = links->work;
    bool ok = true;
    links->next.count = links->nextCorners.count = work->nextEnds.count = links->changed = 0;
    links->was.count = links->wasCorner.count = work->nextPairs.count = 0;
    for (int32_t k = 0; ok && k < links->links.count; ++k) {
        kiriLink link = links->links.data[k];
        if (kiriKeep_Has(kept, k)) {
            link.i = kiriKeep_To(frames, link.i);
            link.j = kiriKeep_To(frames, link.j);
            ok = kiriArray_Push(memory, &links->next, link) &&
                 kiriArray_Push(memory, &work->nextEnds, EndsTo(frames, work->ends.data[k]));
        }
    }
    return ok && KeepCorners(links, memory, kept);
}

void kiriLinks_Commit(kiriLinks* links)
{
    kiriLinks was = *links;
    kiriLinkWork* work = links->work;
    kiriLinkWork old = *work;
    memcpy(&links->links, &was.next, sizeof(links->links));
    memcpy(&links->next, &was.links, sizeof(links->next));
    memcpy(&links->corners, &was.nextCorners, sizeof(links->corners));
    memcpy(&links->nextCorners, &was.corners, sizeof(links->nextCorners));
    memcpy(&work->ends, &old.nextEnds, sizeof(work->ends));
    memcpy(&work->nextEnds, &old.ends, sizeof(work->nextEnds));
    memcpy(&work->pairs, &old.nextPairs, sizeof(work->pairs));
    memcpy(&work->nextPairs, &old.pairs, sizeof(work->nextPairs));
    links->next.count = links->nextCorners.count = work->nextEnds.count = work->nextPairs.count = 0;
    work->isTwin = links->was.count == links->links.count;
}
