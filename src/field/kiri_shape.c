#include "kiri_shape.h"

#include <string.h>

/* ---- Weights of the cells (algorithm 2) ------------------------------------------------------------------------- */

/* Of a cell. */
enum {
    RESTEPPED = 1, /* new, or its steps changed */
    GONE = 2,
    REOWNED = 4,  /* its owner or the distance to its site changed */
    LISTED = 8,   /* it is in shape->changes, */
    COUNTED = 16, /* and in shape->recomputed */
    DIRTY = 32,   /* its weights do not sum to 1 yet */
};

/* A raw weight to be put in its place; 0: to be taken away. */
typedef struct Entry {
    int32_t cell, frame;
    double raw;
} Entry;

/* What an update knows of a frame. */
typedef struct Look {
    int32_t limit; /* of the distances in its list */
    int32_t reach; /* the least limit that cells which came to its region ask for, or lie elsewhere in it */
    bool moved;    /* its site */
    bool reowned;  /* a cell came to its region, left it, or lies elsewhere in it */
} Look;

typedef enum Stage { AT_REST, NEXT_FRAME, FROM_SITE, FROM_BORDER, OPENING, PUTTING, NORMALIZING } Stage;

struct kiriShapeWork {
    /* Of the frame at hand; empty between frames. All seeds are its own, so they need no owner, and lists that are
       loaded neither. */
    kiriField fromSite;   /* distances to its site, no farther than its weight may be above zero, */
    kiriField fromBorder; /* and to the border of its region */
    kiriSeeds seeds;

    KIRI_ARRAY(uint8_t) marks;    /* of each cell */
    KIRI_ARRAY(int32_t) wasOwner; /* of cells marked REOWNED */
    KIRI_ARRAY(int32_t) fresh;    /* of cells without weights: how many entries still go there */
    KIRI_ARRAY(int64_t) shares;   /* of each cell: what it adds to the rigid sums of its frames */
    KIRI_ARRAY(Look) looks;       /* of each frame */
    KIRI_ARRAY(Entry) entries;    /* by frame */
    KIRI_ARRAY(int32_t) dirty;
    int32_t low[2], high[2]; /* the box of columns and rows in which something changed */
    Stage stage;
    int32_t next; /* frame, entry or dirty cell at which the work goes on */
};

/* An update, and the frame at hand. */
typedef struct Job {
    kiriShape* shape;
    kiriShapeWork* work;
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const kiriRegions* regions;
    const kiriSite* sites;
    int32_t siteCount;
    int32_t frame;
} Job;

static bool Inside(const Job* job, int32_t cell)
{
    return job->regions->field.owner.data[cell] == job->frame;
}

/* How far distances to the site of its region have to go for the sake of a cell x: to itself, and where a step leads
   over the border to y, to the last cell that gets weight from there. Let the nearest way from such a cell c to the
   border come in by y. Then d <= D(x) + |xy| + |yc|, and the weight is above zero only where d > 2 e = D(x) + |xy| -
   D(y) + 2 |yc|: where |yc| < D(y), and so d < D(x) + |xy| + D(y). */
static int32_t ReachAt(const kiriRegions* regions, const kiriGrid* grid, int32_t x)
{
    const int32_t *owner = regions->field.owner.data, *distance = regions->field.distance.data;
    const kiriStepRun* run = &grid->runs.data[x];
    int64_t farthest = distance[x];
    for (int32_t s = run->first; regions->onBorder.data[x] && s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = grid->steps.data[s];
        if (owner[step.cell] != owner[x]) {
            int64_t over = (int64_t)distance[x] + step.length + distance[step.cell];
            farthest = over > farthest ? over : farthest;
        }
    }
    return farthest < KIRI_FAR ? (int32_t)farthest : KIRI_FAR - 1;
}

/* In whole sides, so that it seldom changes. */
static int32_t LimitOf(int32_t reach)
{
    int64_t sides = reach / KIRI_UNIT + 1;
    return sides * KIRI_UNIT < KIRI_FAR ? (int32_t)(sides * KIRI_UNIT) : KIRI_FAR - 1;
}

static kiriSeed SiteSeed(const void* context, int32_t cell)
{
    const Job* job = context;
    return kiriSite_SeedAt(&job->sites[job->frame], KIRI_NONE, job->grid, job->mesh, cell);
}

/* The border lies on the way between x and y where the distances to their sites are equal. A half is rounded up. */
static int32_t DistanceToBorder(const Job* job, int32_t x)
{
    const int32_t* distance = job->regions->field.distance.data;
    const kiriStepRun* run = &job->grid->runs.data[x];
    int32_t least = KIRI_FAR;
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = job->grid->steps.data[s];
        if (Inside(job, step.cell) != Inside(job, x)) {
            int32_t half = (distance[step.cell] + step.length - distance[x] + 1) / 2;
            least = half < least ? half : least;
        }
    }
    return least;
}

static kiriSeed BorderSeed(const void* context, int32_t cell)
{
    const Job* job = context;
    bool has = job->regions->onBorder.data[cell] && job->work->fromSite.distance.data[cell] != KIRI_FAR;
    kiriSeed seed = { cell, has ? DistanceToBorder(job, cell) : KIRI_FAR, KIRI_NONE };
    return seed;
}

/* Distances to the border are measured outside only as far as the weight is above zero: e grows along a way at least
   as fast as d. To keep the flood on its side of the border is needless: no step over it is shorter than the seed
   beyond. Whether a way goes on depends on what e is where it passes, but on nothing farther: so there is still one
   fixed point, and a repair finds it. */
static bool HasWeight(const void* context, int32_t cell)
{
    const Job* job = context;
    int64_t d = job->work->fromSite.distance.data[cell], e = job->work->fromBorder.distance.data[cell];
    return d != KIRI_FAR && (d > 2 * e || Inside(job, cell));
}

/* Algorithm 2, with d the distance to the site and e the distance to the border of its region: linear along a
   straight way from site to site.

   At a site c in the middle of its square its own weight is exactly 1 (d = 0), and any other frame's exactly 0:
   let the nearest way from c to the border of that frame's region cross it from y to x, with D the distances to
   the nearest site. Then e >= (D(x) + |xy| - D(y)) / 2 + |yc|, and D(y) <= |yc|, so 2 e >= D(x) + |xy| + |yc| >=
   d. */
static double Weigh(bool inside, int32_t d, int32_t e)
{
    if (inside) {
        /* Never 0 / 0: d is 0 only in the middle of the site's own cell, and the border does not pass there. In a piece
           with one frame e is KIRI_FAR, which makes the weight 1 once it is normalised. */
        return 0.5 * (1.0 + e / ((double)d + e));
    }
    return (double)d > 2.0 * e ? 0.5 * (1.0 - e / ((double)d - e)) : 0.0;
}

/* ---- Weights in their places ---- */

/* Adds the cell to the rigid sums of its frames, or takes it away from them. */
static void AddRigid(Job* job, int32_t cell, int64_t share)
{
    kiriSpan span = job->shape->spans.data[cell];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        const kiriCellWeight* weight = &job->shape->weights.data[k];
        if (weight->value > job->shape->rigidWeight) {
            job->shape->rigid.data[weight->frame] += share;
        }
    }
}

/* There is room for every cell. */
static void ListChange(Job* job, int32_t cell)
{
    if ((job->work->marks.data[cell] & LISTED) == 0) {
        job->work->marks.data[cell] |= LISTED;
        job->shape->changes.data[job->shape->changes.count++] = cell;
    }
}

/* The weights of the cell, or what they count, are about to change. There is room for every cell. */
static void MarkDirty(Job* job, int32_t cell)
{
    if ((job->work->marks.data[cell] & DIRTY) == 0) {
        job->work->marks.data[cell] |= DIRTY;
        job->work->dirty.data[job->work->dirty.count++] = cell;
        AddRigid(job, cell, -job->work->shares.data[cell]);
    }
}

static void MarkWeightsDirty(Job* job, int32_t cell)
{
    MarkDirty(job, cell);
    ListChange(job, cell);
    job->shape->recomputed += (job->work->marks.data[cell] & COUNTED) == 0;
    job->work->marks.data[cell] |= COUNTED;
}

static bool ResizeSpan(Job* job, int32_t cell, int32_t count)
{
    kiriShape* shape = job->shape;
    return kiriSpan_Resize(&shape->spans.data[cell], &shape->room, job->memory, &shape->weights,
                           sizeof(*shape->weights.data), count);
}

/* A cell without weights gets room for all at once. */
static bool OpenSpan(Job* job, int32_t cell)
{
    MarkWeightsDirty(job, cell);
    return ResizeSpan(job, cell, job->work->fresh.data[cell]);
}

/* Puts, changes or takes away one weight among those that are there. */
static bool Replace(Job* job, const Entry* entry)
{
    kiriSpan* span = &job->shape->spans.data[entry->cell];
    kiriCellWeight* weights = job->shape->weights.data + span->first;
    int32_t k = 0;
    while (k < span->count && weights[k].frame < entry->frame) {
        ++k;
    }
    bool found = k < span->count && weights[k].frame == entry->frame, kept = entry->raw > 0.0;
    if (found ? weights[k].raw == entry->raw : !kept) {
        return true;
    }
    MarkWeightsDirty(job, entry->cell);
    if (found && !kept) {
        memmove(weights + k, weights + k + 1, (size_t)(span->count - k - 1) * sizeof(*weights));
        return ResizeSpan(job, entry->cell, span->count - 1);
    }
    if (!found) {
        if (!ResizeSpan(job, entry->cell, span->count + 1)) {
            return false;
        }
        weights = job->shape->weights.data + span->first;
        memmove(weights + k + 1, weights + k, (size_t)(span->count - k - 1) * sizeof(*weights));
    }
    weights[k] = (kiriCellWeight){ entry->frame, 0.0, entry->raw };
    return true;
}

static bool Put(Job* job, const Entry* entry)
{
    int32_t* fresh = &job->work->fresh.data[entry->cell];
    if (*fresh == 0) {
        return Replace(job, entry);
    }
    if (job->shape->spans.data[entry->cell].count == 0 && !OpenSpan(job, entry->cell)) {
        return false;
    }
    kiriSpan span = job->shape->spans.data[entry->cell];
    job->shape->weights.data[span.first + span.count - (*fresh)--] = (kiriCellWeight){ entry->frame, 0.0, entry->raw };
    return true;
}

/* The share of a square that the cell covers, in units of 2^-40. */
static int64_t ShareOf(const kiriGrid* grid, int32_t cell)
{
    return (int64_t)(grid->cells.data[cell].material.area / (grid->side * grid->side) * 1099511627776.0 + 0.5);
}

static void Normalize(Job* job, int32_t cell)
{
    kiriSpan span = job->shape->spans.data[cell];
    kiriCellWeight* weights = job->shape->weights.data + span.first;
    double sum = 0.0;
    for (int32_t k = 0; k < span.count; ++k) {
        sum += weights[k].raw;
    }
    for (int32_t k = 0; k < span.count; ++k) {
        weights[k].value = weights[k].raw / sum;
    }
    job->work->shares.data[cell] = ShareOf(job->grid, cell);
    AddRigid(job, cell, job->work->shares.data[cell]);
    job->work->marks.data[cell] &= (uint8_t)~DIRTY;
}

/* ---- One frame ---- */

/* No way goes farther than a square a KIRI_UNIT, but for what a site off its middle gains at the start. */
static bool IsInBox(const Job* job)
{
    int32_t square = job->grid->cells.data[job->sites[job->frame].cell].square, columns = job->mesh->squares.columns;
    int32_t radius = job->work->looks.data[job->frame].limit / KIRI_UNIT + 2;
    const int32_t at[2] = { square % columns, square / columns };
    return job->work->low[0] <= at[0] + radius && job->work->high[0] >= at[0] - radius &&
           job->work->low[1] <= at[1] + radius && job->work->high[1] >= at[1] - radius;
}

/* May its distances have changed? They do only where a cell changes that they reach: ways come from there. */
static bool IsConcerned(const Job* job)
{
    const Look* look = &job->work->looks.data[job->frame];
    const kiriReaches* list = &job->shape->reaches.data[job->frame];
    if (look->moved || look->reowned) {
        return true;
    }
    if (!IsInBox(job)) {
        return false;
    }
    uint8_t changed = 0;
    for (int32_t k = 0; k < list->count && changed == 0; ++k) {
        changed = job->work->marks.data[list->data[k].cell] & (RESTEPPED | GONE | REOWNED);
    }
    return changed != 0;
}

/* What the cells of its region ask for: they all came to it, or are in its list. */
static int32_t ReachOf(const Job* job)
{
    const kiriReaches* list = &job->shape->reaches.data[job->frame];
    const int32_t* owner = job->regions->field.owner.data;
    int32_t reach = job->work->looks.data[job->frame].reach;
    for (int32_t k = 0; k < list->count; ++k) {
        int32_t cell = list->data[k].cell; /* has no owner where it is gone */
        if (owner[cell] == job->frame) {
            int32_t at = ReachAt(job->regions, job->grid, cell);
            reach = at > reach ? at : reach;
        }
    }
    return reach;
}

/* A cell has another owner, or is nearer to its site or farther: so the seeds of cells beside it may differ that see a
   border of the frame's region between the two, and its own. */
static void SuspectSeeds(Job* job, int32_t cell)
{
    kiriField* field = &job->work->fromBorder;
    const kiriStepRun* run = &job->grid->runs.data[cell];
    bool inside = Inside(job, cell), turned = inside != (job->work->wasOwner.data[cell] == job->frame);
    if (turned) {
        kiriField_Suspect(field, cell);
    }
    for (int32_t s = run->first; (turned || job->regions->onBorder.data[cell]) && s < run->end[KIRI_STEP_LENGTHS - 1];
         ++s) {
        int32_t beside = job->grid->steps.data[s].cell;
        if (turned || Inside(job, beside) != inside) {
            kiriField_Suspect(field, cell);
            kiriField_Suspect(field, beside);
        }
    }
}

/* Loads a cell about which something has changed: not at all where it is gone or beyond the limit. */
static void LoadChanged(Job* job, kiriReach reach, int32_t limit, int32_t rim)
{
    kiriShapeWork* work = job->work;
    uint8_t mark = work->marks.data[reach.cell];
    if ((mark & GONE) != 0) {
        return;
    }
    if (reach.fromSite <= limit) {
        work->fromSite.distance.data[reach.cell] = reach.fromSite;
        if ((mark & RESTEPPED) != 0 || reach.fromSite > rim) {
            kiriField_Suspect(&work->fromSite, reach.cell);
        }
    }
    work->fromBorder.distance.data[reach.cell] = reach.fromBorder;
    if ((mark & RESTEPPED) != 0 || reach.fromSite > limit) {
        kiriField_Suspect(&work->fromBorder, reach.cell);
    }
    if ((mark & REOWNED) != 0) {
        SuspectSeeds(job, reach.cell);
    }
}

/* Loads the list into the fields, and suspects what may change: all that is known at first. A site's seeds depend on
   the steps of its cell. */
static void Load(Job* job, int32_t limit)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* list = &job->shape->reaches.data[job->frame];
    int32_t *fromSite = work->fromSite.distance.data, *fromBorder = work->fromBorder.distance.data;
    const uint8_t* marks = work->marks.data;
    int32_t old = work->looks.data[job->frame].limit, rim = limit > old ? old - KIRI_UNIT_KNIGHT : KIRI_FAR;
    int32_t plain = limit > old ? rim : limit; /* what is no farther has changed only where it is marked */
    for (int32_t k = 0; k < list->count; ++k) {
        kiriReach reach = list->data[k];
        if (reach.fromSite <= plain && (marks[reach.cell] & (RESTEPPED | GONE | REOWNED)) == 0) {
            fromSite[reach.cell] = reach.fromSite;
            fromBorder[reach.cell] = reach.fromBorder;
        } else {
            LoadChanged(job, reach, limit, rim);
        }
    }
    int32_t cell = job->sites[job->frame].cell;
    const kiriStepRun* run = &job->grid->runs.data[cell];
    for (int32_t s = run->first; (marks[cell] & RESTEPPED) && s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriField_Suspect(&work->fromSite, job->grid->steps.data[s].cell);
    }
}

static bool StartFromSite(Job* job)
{
    kiriShapeWork* work = job->work;
    Look* look = &work->looks.data[job->frame];
    int32_t limit = LimitOf(ReachOf(job));
    bool ok = true;
    if (look->moved) {
        work->seeds.count = 0;
        ok = kiriSite_Seed(&job->sites[job->frame], KIRI_NONE, job->memory, job->grid, job->mesh, &work->seeds) &&
             kiriField_Start(&work->fromSite, job->memory, work->seeds.data, work->seeds.count);
    } else {
        Load(job, limit);
    }
    look->limit = limit;
    return ok;
}

static bool SeedBorder(Job* job)
{
    kiriShapeWork* work = job->work;
    const uint8_t* onBorder = job->regions->onBorder.data;
    work->seeds.count = 0;
    for (int32_t k = 0; k < work->fromSite.settled.count; ++k) {
        int32_t cell = work->fromSite.settled.data[k];
        if (onBorder[cell]) {
            kiriSeed seed = { cell, DistanceToBorder(job, cell), KIRI_NONE };
            if (seed.distance < KIRI_FAR && !kiriArray_Push(job->memory, &work->seeds, seed)) {
                return false;
            }
        }
    }
    return kiriField_Start(&work->fromBorder, job->memory, work->seeds.data, work->seeds.count);
}

/* Ways to the border pass where the site is near enough. */
static bool StartFromBorder(Job* job)
{
    kiriShapeWork* work = job->work;
    if (work->looks.data[job->frame].moved) {
        return SeedBorder(job);
    }
    for (int32_t k = 0; k < work->fromSite.log.count; ++k) {
        kiriSeed was = work->fromSite.log.data[k];
        if (work->fromSite.distance.data[was.cell] != was.distance) {
            kiriField_Suspect(&work->fromBorder, was.cell);
            if ((work->marks.data[was.cell] & REOWNED) != 0) {
                SuspectSeeds(job, was.cell);
            }
        }
    }
    return true;
}

static kiriProgress GoOn(Job* job, kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    return job->work->looks.data[job->frame].moved ? kiriField_Flood(field, rule, quota)
                                                   : kiriField_Repair(field, job->memory, rule, quota);
}

/* There is room. */
static void AddEntry(Job* job, kiriReach is)
{
    kiriShapeWork* work = job->work;
    double raw = is.fromSite == KIRI_FAR ? 0.0 : Weigh(Inside(job, is.cell), is.fromSite, is.fromBorder);
    bool none = job->shape->spans.data[is.cell].count == 0;
    if (raw > 0.0 || !none) {
        work->fresh.data[is.cell] += none;
        work->entries.data[work->entries.count++] = (Entry){ is.cell, job->frame, raw };
    }
}

/* Takes the distances of a cell out of the fields. */
static kiriReach Unload(int32_t* fromSite, int32_t* fromBorder, int32_t cell)
{
    kiriReach reach = { cell, fromSite[cell], fromBorder[cell] };
    fromSite[cell] = fromBorder[cell] = KIRI_FAR;
    return reach;
}

static void WriteOld(Job* job)
{
    kiriShapeWork* work = job->work;
    kiriReaches* list = &job->shape->reaches.data[job->frame];
    int32_t *fromSite = work->fromSite.distance.data, *fromBorder = work->fromBorder.distance.data;
    const uint8_t* marks = work->marks.data;
    for (int32_t k = 0; k < list->count;) {
        kiriReach was = list->data[k], is = Unload(fromSite, fromBorder, was.cell);
        bool same = is.fromSite == was.fromSite && is.fromBorder == was.fromBorder;
        if (same && (marks[was.cell] & REOWNED) == 0) {
            ++k;
            continue;
        }
        if ((marks[was.cell] & GONE) == 0) {
            AddEntry(job, is);
        }
        list->data[k] = is.fromSite != KIRI_FAR ? is : list->data[--list->count];
        k += is.fromSite != KIRI_FAR;
    }
}

/* Cells of a flood or a log that are still loaded are new in the list. */
static void WriteNew(Job* job, int32_t cell)
{
    kiriReaches* list = &job->shape->reaches.data[job->frame];
    kiriReach is = Unload(job->work->fromSite.distance.data, job->work->fromBorder.distance.data, cell);
    if (is.fromSite != KIRI_FAR) {
        list->data[list->count++] = is;
        AddEntry(job, is);
    }
}

/* Compares the distances with those of the list; leaves the fields empty. */
static bool Write(Job* job)
{
    kiriShapeWork* work = job->work;
    kiriField *site = &work->fromSite, *border = &work->fromBorder;
    kiriReaches* list = &job->shape->reaches.data[job->frame];
    int64_t most = (int64_t)list->count + site->settled.count + site->log.count;
    if (!kiriArray_Reserve(job->memory, list, most) ||
        !kiriArray_Reserve(job->memory, &work->entries, work->entries.count + most)) {
        return false;
    }
    WriteOld(job);
    for (int32_t k = 0; k < site->settled.count; ++k) {
        WriteNew(job, site->settled.data[k]);
    }
    for (int32_t k = 0; k < site->log.count; ++k) {
        WriteNew(job, site->log.data[k].cell);
    }
    /* Distances to the border are given one step farther than ways go on. */
    for (int32_t k = 0; k < border->log.count; ++k) {
        border->distance.data[border->log.data[k].cell] = KIRI_FAR;
    }
    kiriField_Reset(border);
    site->settled.count = site->log.count = border->log.count = 0;
    return true;
}

/* ---- All frames ---- */

static bool MakeRoom(Job* job)
{
    kiriShape* shape = job->shape;
    kiriShapeWork* work = job->work;
    int32_t cells = job->grid->cells.count, old = work->marks.count;
    bool ok =
        kiriField_Resize(&work->fromSite, job->memory, cells) &&
        kiriField_Resize(&work->fromBorder, job->memory, cells) &&
        kiriArray_Resize(job->memory, &shape->spans, cells) && kiriArray_Reserve(job->memory, &shape->changes, cells) &&
        kiriArray_Reserve(job->memory, &work->dirty, cells) && kiriArray_Resize(job->memory, &work->wasOwner, cells) &&
        kiriArray_Resize(job->memory, &work->fresh, cells) && kiriArray_Resize(job->memory, &work->shares, cells) &&
        kiriArray_Resize(job->memory, &work->marks, cells) &&
        kiriArray_Reserve(job->memory, &shape->reaches, job->siteCount) &&
        kiriArray_Reserve(job->memory, &shape->rigid, job->siteCount) &&
        kiriArray_Reserve(job->memory, &work->looks, job->siteCount);
    for (int32_t c = old; ok && c < cells; ++c) {
        shape->spans.data[c] = (kiriSpan){ 0, 0 };
        work->fresh.data[c] = 0;
        work->shares.data[c] = 0;
        work->marks.data[c] = 0;
    }
    while (ok && shape->reaches.count < job->siteCount) {
        memset(&shape->reaches.data[shape->reaches.count++], 0, sizeof(*shape->reaches.data));
    }
    while (ok && shape->rigid.count < job->siteCount) {
        shape->rigid.data[shape->rigid.count++] = 0;
        memset(&work->looks.data[work->looks.count++], 0, sizeof(*work->looks.data));
    }
    return ok;
}

static void MarkChange(Job* job, int32_t cell, uint8_t mark)
{
    kiriShapeWork* work = job->work;
    int32_t square = job->grid->cells.data[cell].square, columns = job->mesh->squares.columns;
    const int32_t at[2] = { square % columns, square / columns };
    work->marks.data[cell] |= mark;
    for (int i = 0; i < 2; ++i) {
        work->low[i] = at[i] < work->low[i] ? at[i] : work->low[i];
        work->high[i] = at[i] > work->high[i] ? at[i] : work->high[i];
    }
}

/* Cells whose owner or distance changed, as the frames will ask for them. */
static void MarkReowned(Job* job)
{
    kiriShapeWork* work = job->work;
    const kiriField* field = &job->regions->field;
    for (int32_t k = 0; k < job->regions->changes.count; ++k) {
        kiriSeed was = job->regions->changes.data[k];
        int32_t owner = field->owner.data[was.cell];
        MarkChange(job, was.cell, REOWNED);
        work->wasOwner.data[was.cell] = was.owner;
        if (was.owner != KIRI_NONE) {
            work->looks.data[was.owner].reowned = true;
        }
        if (owner != KIRI_NONE) {
            Look* look = &work->looks.data[owner];
            int32_t reach = ReachAt(job->regions, job->grid, was.cell);
            look->reowned = true;
            look->reach = reach > look->reach ? reach : look->reach;
        }
    }
}

/* Cells that are gone have made others in their squares, so the box holds them too. */
static void MarkChanges(Job* job)
{
    const kiriGridChanges* changes = &job->grid->changes;
    for (int32_t k = 0; k < changes->gone.count; ++k) {
        int32_t cell = changes->gone.data[k];
        AddRigid(job, cell, -job->work->shares.data[cell]);
        ResizeSpan(job, cell, 0);
        job->work->shares.data[cell] = 0;
        job->work->marks.data[cell] |= GONE;
    }
    for (int32_t k = 0; k < changes->made.count; ++k) {
        if (kiriGrid_IsCell(job->grid, changes->made.data[k])) {
            MarkChange(job, changes->made.data[k], RESTEPPED);
            ListChange(job, changes->made.data[k]);
        }
    }
    for (int32_t k = 0; k < changes->steps.count; ++k) {
        if (kiriGrid_IsCell(job->grid, changes->steps.data[k])) {
            MarkChange(job, changes->steps.data[k], RESTEPPED);
            ListChange(job, changes->steps.data[k]);
        }
    }
    for (int32_t k = 0; k < changes->material.count; ++k) {
        if (kiriGrid_IsCell(job->grid, changes->material.data[k].cell)) {
            MarkDirty(job, changes->material.data[k].cell);
        }
    }
    MarkReowned(job);
}

static bool Begin(Job* job, const kiriSiteMove* moves, int32_t moveCount)
{
    kiriShapeWork* work = job->work;
    if (!MakeRoom(job)) {
        return false;
    }
    for (int32_t f = 0; f < job->siteCount; ++f) {
        Look* look = &work->looks.data[f];
        look->reach = 0;
        look->moved = look->reowned = false;
    }
    for (int32_t k = 0; k < moveCount; ++k) {
        work->looks.data[moves[k].frame].moved = true;
    }
    work->low[0] = work->low[1] = INT32_MAX;
    work->high[0] = work->high[1] = INT32_MIN;
    work->entries.count = work->dirty.count = 0;
    MarkChanges(job);
    work->stage = NEXT_FRAME;
    work->next = 0;
    return true;
}

static kiriProgress Measure(Job* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    kiriRule site = { job->grid, 0, NULL, SiteSeed, job };
    kiriRule border = { job->grid, KIRI_FAR - 1, HasWeight, BorderSeed, job };
    for (; work->next < job->siteCount; ++work->next) {
        kiriProgress progress = KIRI_DONE;
        job->frame = work->next;
        if (work->stage == NEXT_FRAME) {
            if (!IsConcerned(job)) {
                continue;
            }
            if (!StartFromSite(job)) {
                return KIRI_FAILED;
            }
            work->stage = FROM_SITE;
        }
        if (work->stage == FROM_SITE) {
            site.limit = work->looks.data[job->frame].limit;
            progress = GoOn(job, &work->fromSite, &site, quota);
            if (progress == KIRI_DONE) {
                progress = StartFromBorder(job) ? KIRI_DONE : KIRI_FAILED;
                work->stage = FROM_BORDER;
            }
        }
        progress = progress == KIRI_DONE ? GoOn(job, &work->fromBorder, &border, quota) : progress;
        if (progress != KIRI_DONE) {
            return progress;
        }
        if (!Write(job)) {
            return KIRI_FAILED;
        }
        work->stage = NEXT_FRAME;
    }
    work->stage = job->shape->weights.count == 0 ? OPENING : PUTTING;
    work->next = 0;
    return KIRI_DONE;
}

/* The first weights of all lie in the order of cells, close to those of their neighbours. */
static kiriProgress OpenAll(Job* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < job->grid->cells.count; ++work->next) {
        if (work->fresh.data[work->next] > 0) {
            if (!kiriQuota_Take(quota, 1)) {
                return KIRI_MORE;
            }
            if (!OpenSpan(job, work->next)) {
                return KIRI_FAILED;
            }
        }
    }
    work->stage = PUTTING;
    work->next = 0;
    return KIRI_DONE;
}

static kiriProgress PutAll(Job* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < work->entries.count; ++work->next) {
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        if (!Put(job, &work->entries.data[work->next])) {
            return KIRI_FAILED;
        }
    }
    work->stage = NORMALIZING;
    work->next = 0;
    return KIRI_DONE;
}

static kiriProgress NormalizeAll(Job* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    for (; work->next < work->dirty.count; ++work->next) {
        if (!kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        Normalize(job, work->dirty.data[work->next]);
    }
    return KIRI_DONE;
}

/* Takes back the marks of this update, and cells that are gone out of the list of changes. */
static void End(Job* job)
{
    kiriShape* shape = job->shape;
    const kiriGridChanges* changes = &job->grid->changes;
    uint8_t* marks = job->work->marks.data;
    const uint8_t kept = (uint8_t) ~(RESTEPPED | GONE | REOWNED);
    int32_t count = 0;
    for (int32_t k = 0; k < changes->made.count; ++k) {
        marks[changes->made.data[k]] &= kept;
    }
    for (int32_t k = 0; k < changes->steps.count; ++k) {
        marks[changes->steps.data[k]] &= kept;
    }
    for (int32_t k = 0; k < job->regions->changes.count; ++k) {
        marks[job->regions->changes.data[k].cell] &= kept;
    }
    for (int32_t k = 0; k < shape->changes.count; ++k) {
        int32_t cell = shape->changes.data[k];
        if ((marks[cell] & GONE) == 0) {
            shape->changes.data[count++] = cell;
        }
    }
    shape->changes.count = count;
    for (int32_t k = 0; k < changes->gone.count; ++k) {
        marks[changes->gone.data[k]] = 0;
    }
    job->work->stage = AT_REST;
}

kiriProgress kiriShape_Update(kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                              const kiriRegions* regions, const kiriSite* sites, int32_t siteCount,
                              const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota)
{
    if (shape->work == NULL) {
        shape->work = kiriMemory_AllocZeroed(memory, sizeof(*shape->work));
    }
    if (shape->work == NULL) {
        return KIRI_FAILED;
    }
    Job job = { shape, shape->work, memory, grid, mesh, regions, sites, siteCount, 0 };
    kiriProgress progress = KIRI_DONE;
    if (shape->work->stage == AT_REST && !Begin(&job, moves, moveCount)) {
        return KIRI_FAILED;
    }
    if (shape->work->stage < OPENING) {
        progress = Measure(&job, quota);
    }
    if (progress == KIRI_DONE && shape->work->stage == OPENING) {
        progress = OpenAll(&job, quota);
    }
    if (progress == KIRI_DONE && shape->work->stage == PUTTING) {
        progress = PutAll(&job, quota);
    }
    progress = progress == KIRI_DONE ? NormalizeAll(&job, quota) : progress;
    if (progress == KIRI_DONE) {
        End(&job);
    }
    return progress;
}

void kiriShape_ClearChanges(kiriShape* shape)
{
    for (int32_t k = 0; k < shape->changes.count; ++k) {
        shape->work->marks.data[shape->changes.data[k]] &= (uint8_t) ~(LISTED | COUNTED);
    }
    shape->changes.count = 0;
    shape->recomputed = 0;
}

void kiriShape_Reset(kiriShape* shape)
{
    for (int32_t f = 0; f < shape->reaches.count; ++f) {
        shape->reaches.data[f].count = 0;
    }
    shape->spans.count = shape->weights.count = shape->rigid.count = shape->changes.count = 0;
    memset(&shape->room, 0, sizeof(shape->room));
    shape->recomputed = 0;
    if (shape->work != NULL) {
        kiriField_Clear(&shape->work->fromSite);
        kiriField_Clear(&shape->work->fromBorder);
        shape->work->marks.count = shape->work->looks.count = 0;
        shape->work->stage = AT_REST;
    }
}

/* ---- Weights of a point: moving least squares (section 4.2) ------------------------------------------------------ */

/* Quadratic B-spline, zero from 1.5 on. */
static double Spline(double t)
{
    double a = fabs(t);
    return a < 0.5 ? 0.75 - a * a : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0.0;
}

/* A first-order fit around a point, in units of squares from the middle of its cell. Offsets of neighbours are whole
   numbers, so that cells in one line are seen as such. */
typedef struct Fit {
    kiriVec2 at;
    double sum;        /* of the kernel; and with it the offsets' */
    kiriVec2 mean;     /* mean */
    double xx, xy, yy; /* and (pseudo-)inverse of the second moments about the mean */
} Fit;

static kiriVec2 SetKernel(kiriStencil* stencil, kiriVec2 at)
{
    kiriVec2 off = kiriVec2_Scale(1.0 / stencil->side, kiriVec2_Sub(at, stencil->middle));
    double u[3], v[3];
    for (int i = 0; i < 3; ++i) {
        u[i] = Spline(i - 1 - off.x);
        v[i] = Spline(i - 1 - off.y);
    }
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        stencil->shares.data[k] = u[stencil->steps.data[k].u + 1] * v[stencil->steps.data[k].v + 1];
    }
    return off;
}

/* Inverts the second moments; a direction that the neighbours do not span is dropped (no slope along it). */
static void Invert(Fit* fit)
{
    double xx = fit->xx, xy = fit->xy, yy = fit->yy, trace = xx + yy, determinant = xx * yy - xy * xy;
    double scale = trace > 0.0 ? 1.0 / (trace * trace) : 0.0;
    if (determinant > 1e-12 * trace * trace) {
        scale = 1.0 / determinant;
        fit->xx = yy;
        fit->xy = -xy;
        fit->yy = xx;
    }
    fit->xx *= scale;
    fit->xy *= scale;
    fit->yy *= scale;
}

/* Leaves the kernel in the stencil's shares. */
static Fit FitAround(kiriStencil* stencil, kiriVec2 at)
{
    Fit fit = { SetKernel(stencil, at), 0.0, { 0.0, 0.0 }, 0.0, 0.0, 0.0 };
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriStep to = stencil->steps.data[k];
        double kernel = stencil->shares.data[k];
        fit.sum += kernel;
        fit.mean = kiriVec2_Add(fit.mean, kiriVec2_Make(kernel * to.u, kernel * to.v));
        fit.xx += kernel * to.u * to.u;
        fit.xy += kernel * to.u * to.v;
        fit.yy += kernel * to.v * to.v;
    }
    fit.mean = kiriVec2_Scale(1.0 / fit.sum, fit.mean);
    fit.xx -= fit.sum * fit.mean.x * fit.mean.x;
    fit.xy -= fit.sum * fit.mean.x * fit.mean.y;
    fit.yy -= fit.sum * fit.mean.y * fit.mean.y;
    Invert(&fit);
    return fit;
}

/* The slope of a function on the cells is the sum of its values times these. */
static kiriVec2 SlopeOf(const Fit* fit, kiriStep to, double kernel)
{
    kiriVec2 p = kiriVec2_Make(to.u - fit->mean.x, to.v - fit->mean.y);
    return kiriVec2_Make(kernel * (fit->xx * p.x + fit->xy * p.y), kernel * (fit->xy * p.x + fit->yy * p.y));
}

/* What the cells count at the point. Splines reproduce linear functions: where no cell is missing, they are the fit. */
static void SetShares(kiriStencil* stencil, kiriVec2 at)
{
    if (stencil->full) {
        SetKernel(stencil, at);
        return;
    }
    Fit fit = FitAround(stencil, at);
    kiriVec2 way = kiriVec2_Sub(fit.at, fit.mean);
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        double kernel = stencil->shares.data[k];
        stencil->shares.data[k] = kernel / fit.sum + kiriVec2_Dot(SlopeOf(&fit, stencil->steps.data[k], kernel), way);
    }
}

/* The fit may undershoot: no value below zero, sum 1. */
void kiriStencil_Weigh(kiriStencil* stencil, kiriVec2 at)
{
    int32_t count = stencil->frames.count;
    double *values = stencil->values.data, sum = 0.0;
    SetShares(stencil, at);
    for (int32_t i = 0; i < count; ++i) {
        values[i] = 0.0;
    }
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        const double* weights = stencil->weights.data + (size_t)k * (size_t)count;
        double share = stencil->shares.data[k];
        for (int32_t i = 0; i < count; ++i) {
            values[i] += weights[i] * share;
        }
    }
    for (int32_t i = 0; i < count; ++i) {
        values[i] = values[i] > 0.0 ? values[i] : 0.0;
        sum += values[i];
    }
    for (int32_t i = 0; i < count; ++i) {
        values[i] /= sum;
    }
}

static bool GatherSteps(kiriStencil* stencil, kiriMemory* memory, const kiriGrid* grid, int32_t cell)
{
    const kiriStepRun* run = &grid->runs.data[cell];
    int32_t count = run->end[1] - run->first, seen = 0;
    if (!kiriArray_Resize(memory, &stencil->steps, (int64_t)count + 1) ||
        !kiriArray_Resize(memory, &stencil->shares, (int64_t)count + 1)) {
        return false;
    }
    stencil->steps.data[0] = (kiriStep){ cell, 0, 0, 0 };
    for (int32_t k = 1; k <= count; ++k) {
        kiriStep to = grid->steps.data[run->first + k - 1];
        stencil->steps.data[k] = to;
        seen |= 1 << (3 * (to.v + 1) + to.u + 1);
    }
    stencil->full = count == 8 && (seen | 1 << 4) == 511;
    return true;
}

/* The frames with weight in any of the cells, sorted, and in `columns` where they are. */
static bool GatherFrames(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape)
{
    int32_t old = stencil->columns.count;
    if (!kiriArray_Resize(memory, &stencil->columns, old > shape->rigid.count ? old : shape->rigid.count)) {
        return false;
    }
    for (int32_t f = old; f < stencil->columns.count; ++f) {
        stencil->columns.data[f] = 0;
    }
    stencil->frames.count = 0;
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriSpan span = shape->spans.data[stencil->steps.data[k].cell];
        if (!kiriArray_Reserve(memory, &stencil->frames, (int64_t)stencil->frames.count + span.count)) {
            return false;
        }
        for (int32_t w = span.first; w < span.first + span.count; ++w) {
            int32_t frame = shape->weights.data[w].frame, at = stencil->frames.count;
            if (stencil->columns.data[frame] == 0) {
                stencil->columns.data[frame] = 1;
                for (; at > 0 && stencil->frames.data[at - 1] > frame; --at) {
                    stencil->frames.data[at] = stencil->frames.data[at - 1];
                }
                stencil->frames.data[at] = frame;
                ++stencil->frames.count;
            }
        }
    }
    for (int32_t i = 0; i < stencil->frames.count; ++i) {
        stencil->columns.data[stencil->frames.data[i]] = i + 1;
    }
    return true;
}

static bool GatherWeights(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape)
{
    int32_t count = stencil->frames.count;
    if (!kiriArray_Resize(memory, &stencil->weights, (int64_t)count * stencil->steps.count) ||
        !kiriArray_Resize(memory, &stencil->values, count)) {
        return false;
    }
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriSpan span = shape->spans.data[stencil->steps.data[k].cell];
        double* weights = stencil->weights.data + (size_t)k * (size_t)count;
        for (int32_t i = 0; i < count; ++i) {
            weights[i] = 0.0;
        }
        for (int32_t w = span.first; w < span.first + span.count; ++w) {
            weights[stencil->columns.data[shape->weights.data[w].frame] - 1] = shape->weights.data[w].value;
        }
    }
    return true;
}

bool kiriStencil_Gather(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                        const kiriMeshData* mesh, int32_t cell)
{
    bool ok = GatherSteps(stencil, memory, grid, cell) && GatherFrames(stencil, memory, shape) &&
              GatherWeights(stencil, memory, shape);
    for (int32_t i = 0; i < stencil->frames.count; ++i) {
        stencil->columns.data[stencil->frames.data[i]] = 0;
    }
    stencil->cell = ok ? cell : KIRI_NONE;
    stencil->middle = kiriGrid_Middle(grid, mesh, cell);
    stencil->side = grid->side;
    return ok;
}

/* What rounding leaves of the gradients goes to the largest weight. */
static void SetGradients(kiriStencil* stencil, kiriVec2 at, kiriPointWeights* out)
{
    Fit fit = FitAround(stencil, at);
    kiriVec2 rest = { 0.0, 0.0 };
    int32_t largest = 0;
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriVec2 slope = SlopeOf(&fit, stencil->steps.data[k], stencil->shares.data[k]);
        const double* weights = stencil->weights.data + (size_t)k * (size_t)out->count;
        for (int32_t i = 0; i < out->count; ++i) {
            kiriPointWeight* weight = &out->data[i];
            weight->gradient = kiriVec2_Add(weight->gradient, kiriVec2_Scale(weights[i] / stencil->side, slope));
        }
    }
    for (int32_t i = 0; i < out->count; ++i) {
        rest = kiriVec2_Add(rest, out->data[i].gradient);
        largest = out->data[i].value > out->data[largest].value ? i : largest;
    }
    if (out->count > 0) {
        out->data[largest].gradient = kiriVec2_Sub(out->data[largest].gradient, rest);
    }
}

bool kiriShape_At(const kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                  int32_t cell, kiriVec2 at, kiriPointWeights* out)
{
    kiriMemory scratch = kiriMemory_Like(memory);
    kiriStencil stencil = { 0 };
    bool ok = kiriStencil_Gather(&stencil, &scratch, shape, grid, mesh, cell) &&
              kiriArray_Resize(memory, out, stencil.frames.count);
    if (ok) {
        kiriStencil_Weigh(&stencil, at);
        for (int32_t i = 0; i < out->count; ++i) {
            out->data[i] = (kiriPointWeight){ stencil.frames.data[i], stencil.values.data[i], { 0.0, 0.0 } };
        }
        SetGradients(&stencil, at, out);
    }
    kiriMemory_FreeAll(&scratch);
    return ok;
}
