#include "kiri_link.h"
#include "../core/kiri_array.h"
#include "kiri_site.h"

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

/* Stretches of border, face by face, and the links they make. */

/* In items of the budget: a link, and a face of its stretch. */
enum { LINK_ITEMS = 80, STRETCH_FACE_ITEMS = 5 };

kiriBorderSide kiriBorder_SideOf(const kiriBorder* border, int32_t face)
{
    KIRI_ASSERT(face >= 0 && face < border->grid->faces.count);
    const kiriFace* f = &border->grid->faces.data[face];
    const int32_t* owner = border->regions->field.owner.data;
    int32_t low = owner[f->cell[0]] < owner[f->cell[1]] ? 0 : 1;
    KIRI_ASSERT(f->cell[0] != KIRI_NONE && owner[f->cell[low]] != KIRI_NONE && owner[f->cell[0]] != owner[f->cell[1]]);
    kiriBorderSide side = { f->cell[low],     f->cell[1 - low],     owner[f->cell[low]], owner[f->cell[1 - low]],
                            kiriFace_Axis(f), low == 0 ? 1.0 : -1.0 };
    return side;
}

bool kiriBorder_IsFaceBefore(const void* context, int32_t a, int32_t b)
{
    const kiriBorder* border = context;
    const kiriCell* cells = border->grid->cells.data;
    const kiriFace *f = &border->grid->faces.data[a], *g = &border->grid->faces.data[b];
    const kiriCell *fHigh = &cells[f->cell[1]], *gHigh = &cells[g->cell[1]];
    if (fHigh->square != gHigh->square) {
        return fHigh->square < gHigh->square;
    }
    if (kiriFace_Axis(f) != kiriFace_Axis(g)) {
        return kiriFace_Axis(f) < kiriFace_Axis(g);
    }
    int32_t fLow = cells[f->cell[0]].triangle, gLow = cells[g->cell[0]].triangle;
    return fLow != gLow ? fLow < gLow : fHigh->triangle < gHigh->triangle;
}

/* ---- Stretches -------------------------------------------------------------------------------------------------- */

/* Adds the faces of `cell` that continue the stretch of `from`. */
static bool GatherFacesAt(const kiriBorder* border, const kiriBorderSide* from, int32_t cell, kiriFaceMark mark,
                          kiriFaceMark next)
{
    KIRI_ASSERT(cell >= 0 && cell < border->regions->onBorder.count);
    const kiriGrid* grid = border->grid;
    bool may = border->regions->onBorder.data[cell] && border->regions->field.owner.data[cell] == from->i;
    for (int32_t f = may ? grid->cells.data[cell].firstFace : KIRI_NONE; f != KIRI_NONE;) {
        const kiriFace* face = &grid->faces.data[f];
        if (border->work->marks.data[f] == mark) {
            kiriBorderSide side = kiriBorder_SideOf(border, f);
            bool sameWay = side.axis == from->axis && side.sign == from->sign;
            if (side.x == cell && side.i == from->i && side.j == from->j && (sameWay || mark != KIRI_FACE_BENT) &&
                kiriGrid_AreNear(grid, side.y, from->y)) {
                border->work->marks.data[f] = (uint8_t)next;
                if (!kiriArray_Push(border->memory, &border->work->stretch, f)) {
                    return false;
                }
            }
        }
        f = kiriFace_Next(face, cell);
    }
    return true;
}

/* The connected stretch of faces around one that have its mark, in order; their mark becomes `next`. */
static bool GatherStretch(const kiriBorder* border, int32_t face, kiriFaceMark next)
{
    const kiriGrid* grid = border->grid;
    kiriLinkWork* work = border->work;
    kiriFaceMark mark = (kiriFaceMark)work->marks.data[face];
    work->stretch.count = 0;
    work->marks.data[face] = (uint8_t)next;
    bool ok = kiriArray_Push(border->memory, &work->stretch, face);
    for (int32_t k = 0; ok && k < work->stretch.count; ++k) {
        kiriBorderSide side = kiriBorder_SideOf(border, work->stretch.data[k]);
        kiriSteps steps;
        kiriGrid_GetStepsTo(grid, side.x, 2, &steps);
        ok = GatherFacesAt(border, &side, side.x, mark, next);
        for (int32_t s = 0; ok && s < steps.end[1]; ++s) {
            ok = GatherFacesAt(border, &side, steps.data[s].cell, mark, next);
        }
    }
    kiriSort(work->stretch.data, work->stretch.count, kiriBorder_IsFaceBefore, border);
    return ok;
}

/* Of the k-th face of the stretch. */
static kiriStretch StretchOfFace(const kiriBorder* border, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < border->work->stretch.count);
    return kiriGrid_Stretch(border->grid, border->mesh, border->work->stretch.data[k]);
}

static int32_t AxisOfFace(const kiriBorder* border, int32_t k)
{
    KIRI_ASSERT(k >= 0 && k < border->work->stretch.count);
    return kiriFace_Axis(&border->grid->faces.data[border->work->stretch.data[k]]);
}

/* The vector sum of the faces, as normals from i to j; *sum is the sum of their widths. */
static kiriVec2 SumNormals(const kiriBorder* border, double* sum)
{
    double n[2] = { 0.0, 0.0 };
    *sum = 0.0;
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        double width = StretchOfFace(border, k).width;
        kiriBorderSide side = kiriBorder_SideOf(border, border->work->stretch.data[k]);
        n[side.axis] += side.sign * width;
        *sum += width;
    }
    return kiriVec2_Make(n[0], n[1]);
}

/* ---- One link --------------------------------------------------------------------------------------------------- */

/* Centroid and second moment along the tangent; a face counts by its width as seen along the normal. */
static void SetMoments(const kiriBorder* border, kiriLink* link)
{
    double normal[2] = { link->normal.x, link->normal.y };
    double total = 0.0;
    kiriVec2 first = { 0.0, 0.0 };
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        kiriStretch face = StretchOfFace(border, k);
        double weight = face.width * fabs(normal[AxisOfFace(border, k)]);
        total += weight;
        first = kiriVec2_Add(first, kiriVec2_Scale(weight, face.middle));
    }
    link->centroid = kiriVec2_Scale(1.0 / total, first);
    link->moment = 0.0;
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        kiriStretch face = StretchOfFace(border, k);
        /* The side's direction along the tangent is as its normal along the normal. */
        double share = fabs(normal[AxisOfFace(border, k)]);
        double s = kiriVec2_Dot(kiriVec2_Sub(face.middle, link->centroid), link->tangent);
        link->moment += share * (face.width * s * s + face.moment * share * share);
    }
}

/* About the centroid of the link. */
static void SetSpread(const kiriBorder* border, kiriLink* link)
{
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        kiriStretch face = StretchOfFace(border, k);
        kiriBorderSide side = kiriBorder_SideOf(border, border->work->stretch.data[k]);
        kiriVec2 arm = kiriVec2_Sub(face.middle, link->centroid);
        double along = side.sign * face.width;
        kiriVec2 normal = { side.axis == 0 ? along : 0.0, side.axis == 0 ? 0.0 : along };
        link->spread[0] = kiriVec2_Add(link->spread[0], kiriVec2_Scale(arm.x, normal));
        link->spread[1] = kiriVec2_Add(link->spread[1], kiriVec2_Scale(arm.y, normal));
    }
}

/* A way from site i to site j. */
typedef struct SitesWay {
    int32_t length;
    kiriVec2 crossing;
    int32_t overFaces; /* the shortest over a face: its length, */
    int32_t cell[2];   /* the cells beside the face, of regions i and j, */
    kiriVec2 over;     /* and its middle */
} SitesWay;

/* Ways by the diagonal and knight steps from `cell` over the border into region `to`. */
static void TryLongSteps(const kiriBorder* border, int32_t cell, int32_t to, SitesWay* way)
{
    const kiriGrid* grid = border->grid;
    const kiriField* field = &border->regions->field;
    kiriSteps steps;
    kiriGrid_GetSteps(grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = steps.data[s];
        if (field->owner.data[step.cell] == to) {
            int32_t length = field->distance.data[cell] + step.length + field->distance.data[step.cell];
            if (length < way->length) {
                kiriVec2 a = kiriGrid_Middle(grid, border->mesh, cell);
                kiriVec2 b = kiriGrid_Middle(grid, border->mesh, step.cell);
                way->length = length;
                way->crossing = kiriVec2_Scale(0.5, kiriVec2_Add(a, b));
            }
        }
    }
}

static SitesWay ShortestWay(const kiriBorder* border)
{
    const int32_t* distance = border->regions->field.distance.data;
    SitesWay way = { KIRI_FAR, { 0.0, 0.0 }, KIRI_FAR, { KIRI_NONE, KIRI_NONE }, { 0.0, 0.0 } };
    for (int32_t k = 0; k < border->work->stretch.count; ++k) {
        int32_t face = border->work->stretch.data[k];
        kiriBorderSide side = kiriBorder_SideOf(border, face);
        int32_t length = distance[side.x] + KIRI_UNIT + distance[side.y];
        if (length < way.overFaces) {
            way.overFaces = length;
            way.cell[0] = side.x;
            way.cell[1] = side.y;
            way.over = StretchOfFace(border, k).middle;
        }
        TryLongSteps(border, side.x, side.j, &way);
        TryLongSteps(border, side.y, side.i, &way);
    }
    if (way.overFaces <= way.length) {
        way.length = way.overFaces;
        way.crossing = way.over;
    }
    return way;
}

/* Lengths on the grid exceed true ones by up to 3 %, and by parts of a side at both ends: only where the true way
   cannot be told they are taken, and where they are not clearly longer the way is straight. */
static kiriWay GridWay(const kiriBorder* border, const kiriLink* link, const SitesWay* sites)
{
    kiriVec2 a = border->sites[link->i].at, b = border->sites[link->j].at;
    double straight = kiriVec2_Length(kiriVec2_Sub(b, a));
    kiriWay way;
    way.length = sites->length * (border->grid->side / KIRI_UNIT);
    way.turnCount = 1;
    way.turn[0] = sites->crossing;
    if (way.length < 1.08 * straight + 0.5 * border->grid->side) {
        way.length = straight;
        way.turnCount = 0;
    }
    return way;
}

/* The crossing is half-way: there both sites are as far. */
static void SetLength(const kiriBorder* border, kiriLink* link, const kiriLinkEnds* ends)
{
    kiriVec2 a = border->sites[link->i].at, b = border->sites[link->j].at;
    SitesWay sites = ShortestWay(border);
    kiriWay way;
    bool found = kiriBorder_FindWay(border, link, ends, sites.cell, sites.over, &way);
    way = found ? way : GridWay(border, link, &sites);
    link->length = way.length;
    link->crossing = found || way.turnCount == 0 ? kiriWay_At(&way, a, b, 0.5 * way.length) : way.turn[0];
    link->span = way.turnCount == 0 ? kiriVec2_Sub(b, a) : kiriVec2_Scale(link->length, link->normal);
    double least = 0.1 * border->grid->side;
    link->length = kiriMax(link->length, least);
}

/* From the stretch at hand. */
static bool AddLink(const kiriBorder* border, bool bent)
{
    int32_t lowest = border->work->stretch.data[0];
    kiriBorderSide side = kiriBorder_SideOf(border, lowest);
    double sum;
    kiriVec2 normal = SumNormals(border, &sum);
    kiriNewLink link;
    memset(&link, 0, sizeof(link));
    link.face = lowest;
    link.link.i = side.i;
    link.link.j = side.j;
    link.link.width = kiriVec2_Length(normal);
    link.link.normal = kiriVec2_Scale(1.0 / link.link.width, normal);
    link.link.tangent = kiriVec2_Make(-link.link.normal.y, link.link.normal.x);
    link.link.sum = normal;
    SetMoments(border, &link.link);
    link.ends = kiriBorder_FindEnds(border, &link.link, bent);
    link.isOld = kiriBorder_IsUntouched(border, &link.ends);
    if (link.isOld) {
        return kiriArray_Push(border->memory, &border->work->made, link);
    }
    if (!bent) {
        kiriBorder_MakeExact(border, &link.link, &link.ends);
    }
    SetSpread(border, &link.link);
    SetLength(border, &link.link, &link.ends);
    kiriLink_SetOuter(&link.link, &link.ends);
    return kiriArray_Push(border->memory, &border->work->made, link);
}

/* ---- All links of a stretch -------------------------------------------------------------------------------------- */

/* A border that turns back on itself, around the tip of a slit for instance, loses its width in the vector sum: it is
   split into stretches of one normal each. */
static bool SplitStretch(const kiriBorder* border)
{
    kiriLinkWork* work = border->work;
    if (!kiriArray_Resize(border->memory, &work->whole, work->stretch.count)) {
        return false;
    }
    for (int32_t k = 0; k < work->stretch.count; ++k) {
        work->whole.data[k] = work->stretch.data[k];
        work->marks.data[work->whole.data[k]] = KIRI_FACE_BENT;
    }
    for (int32_t k = 0; k < work->whole.count; ++k) {
        int32_t face = work->whole.data[k];
        if (work->marks.data[face] == KIRI_FACE_BENT &&
            !(GatherStretch(border, face, KIRI_FACE_PASSED) && AddLink(border, true))) {
            return false;
        }
    }
    return true;
}

bool kiriBorder_MakeLinksAt(const kiriBorder* border, int32_t face)
{
    double sum;
    if (!GatherStretch(border, face, KIRI_FACE_GATHERED)) {
        return false;
    }
    border->work->due += STRETCH_FACE_ITEMS * (int64_t)border->work->stretch.count + LINK_ITEMS;
    bool bent = kiriVec2_Length(SumNormals(border, &sum)) < 0.5 * sum;
    return bent ? SplitStretch(border) : AddLink(border, false);
}

/* Exact borders. The grid says which stretches of border there are and what they end at; here a link gets the geometry
   of the Euclidean Voronoi diagram instead of that of a staircase of cells. */

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
