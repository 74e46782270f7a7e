#include "kiri_shape_work.h"

/* ---- Distances and weights of a frame ---------------------------------------------------------------------------- */

static bool IsInRegion(const kiriShapeJob* job, int32_t cell)
{
    return job->regions->field.owner.data[cell] == job->frame;
}

/* How far distances to the site of its region have to go for the sake of a cell x: to itself, and where a step leads
   over the border to y, to the last cell that gets weight from there. Let the nearest way from such a cell c to the
   border come in by y. Then d <= D(x) + |xy| + |yc|, and the weight is above zero only where d > 2 e = D(x) + |xy| -
   D(y) + 2 |yc|: where |yc| < D(y), and so d < D(x) + |xy| + D(y). */
int32_t kiriShapeJob_ReachAt(const kiriShapeJob* job, int32_t x)
{
    const kiriField* field = &job->regions->field;
    const int32_t *owner = field->owner.data, *distance = field->distance.data;
    const kiriStepRun* run = &job->grid->runs.data[x];
    int64_t farthest = distance[x];
    for (int32_t s = run->first; job->regions->onBorder.data[x] && s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = job->grid->steps.data[s];
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
    const kiriShapeJob* job = context;
    return kiriSite_SeedAt(&job->sites[job->frame], KIRI_NONE, job->grid, job->mesh, cell);
}

/* The border lies on the way between x and y where the distances to their sites are equal. A half is rounded up. */
static int32_t DistanceToBorder(const kiriShapeJob* job, int32_t x)
{
    const int32_t* distance = job->regions->field.distance.data;
    const kiriStepRun* run = &job->grid->runs.data[x];
    int32_t least = KIRI_FAR;
    for (int32_t s = run->first; s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriStep step = job->grid->steps.data[s];
        if (IsInRegion(job, step.cell) != IsInRegion(job, x)) {
            int32_t half = (distance[step.cell] + step.length - distance[x] + 1) / 2;
            least = half < least ? half : least;
        }
    }
    return least;
}

static kiriSeed BorderSeed(const void* context, int32_t cell)
{
    const kiriShapeJob* job = context;
    bool has = job->regions->onBorder.data[cell] && job->work->fromSite.distance.data[cell] != KIRI_FAR;
    kiriSeed seed = { cell, has ? DistanceToBorder(job, cell) : KIRI_FAR, KIRI_NONE };
    return seed;
}

/* Outside the region, distances to the border are measured only as far as the weight is above zero: along a way e grows
   at least as fast as d. The flood may cross the border, for no step over it is shorter than the seed beyond. Whether a
   way goes on depends only on e where it passes: so there is still one fixed point, and a repair finds it. */
static bool HasWeight(const void* context, int32_t cell)
{
    const kiriShapeJob* job = context;
    int64_t d = job->work->fromSite.distance.data[cell], e = job->work->fromBorder.distance.data[cell];
    return d != KIRI_FAR && (d > 2 * e || IsInRegion(job, cell));
}

/* Algorithm 2, with d the distance to the site and e the distance to the border of its region: linear along a
   straight way from site to site.

   At a site c in the middle of its square its own weight is exactly 1 (d = 0), and any other frame's exactly 0:
   let the nearest way from c to the border of that frame's region cross it from y to x, with D the distances to
   the nearest site. Then e >= (D(x) + |xy| - D(y)) / 2 + |yc|, and D(y) <= |yc|, so 2 e >= D(x) + |xy| + |yc| >=
   d. */
static double RawWeight(bool inside, int32_t d, int32_t e)
{
    if (inside) {
        /* Never 0 / 0: d is 0 only in the middle of the site's own cell, and the border does not pass there. In a piece
           with one frame e is KIRI_FAR, which makes the weight 1 once it is normalised. */
        return 0.5 * (1.0 + e / ((double)d + e));
    }
    return (double)d > 2.0 * e ? 0.5 * (1.0 - e / ((double)d - e)) : 0.0;
}

/* ---- Its list ---------------------------------------------------------------------------------------------------- */

/* No way goes farther than a square a KIRI_UNIT, but for what a site off its middle gains at the start. */
static bool IsInBox(const kiriShapeJob* job)
{
    int32_t square = job->grid->cells.data[job->sites[job->frame].cell].square, columns = job->mesh->squares.columns;
    int32_t radius = job->work->frames.data[job->frame].limit / KIRI_UNIT + 2;
    const int32_t at[2] = { square % columns, square / columns };
    return job->work->low[0] <= at[0] + radius && job->work->high[0] >= at[0] - radius &&
           job->work->low[1] <= at[1] + radius && job->work->high[1] >= at[1] - radius;
}

/* Distances change only where a cell changes that they reach, for ways come from there. */
bool kiriShapeJob_IsFrameDirty(const kiriShapeJob* job)
{
    KIRI_ASSERT(job->frame >= 0 && job->frame < job->siteCount);
    const kiriShapeFrame* frame = &job->work->frames.data[job->frame];
    const kiriReaches* list = &job->shape->reaches.data[job->frame];
    if (frame->moved || frame->dirty) {
        return true;
    }
    if (!IsInBox(job)) {
        return false;
    }
    uint8_t changed = 0;
    for (int32_t k = 0; k < list->count && changed == 0; ++k) {
        changed = job->work->marks.data[list->data[k].cell] & (KIRI_MARK_STEPS | KIRI_MARK_GONE | KIRI_MARK_REGION);
    }
    return changed != 0;
}

/* What the cells of its region ask for: each is in its list, or has come to it in this update. */
static int32_t ReachOf(const kiriShapeJob* job)
{
    const kiriReaches* list = &job->shape->reaches.data[job->frame];
    const int32_t* owner = job->regions->field.owner.data;
    int32_t reach = job->work->frames.data[job->frame].reach;
    for (int32_t k = 0; k < list->count; ++k) {
        int32_t cell = list->data[k].cell; /* has no owner where it is gone */
        if (owner[cell] == job->frame) {
            int32_t at = kiriShapeJob_ReachAt(job, cell);
            reach = at > reach ? at : reach;
        }
    }
    return reach;
}

/* A cell has another owner or distance. So where the border of the frame's region runs between it and a cell beside it,
   the seeds of both may differ. */
static void MarkBorderSeedsDirty(kiriShapeJob* job, int32_t cell)
{
    kiriField* field = &job->work->fromBorder;
    const kiriStepRun* run = &job->grid->runs.data[cell];
    bool inside = IsInRegion(job, cell), turned = inside != (job->work->wasOwner.data[cell] == job->frame);
    if (turned) {
        kiriField_MarkDirty(field, cell);
    }
    for (int32_t s = run->first; (turned || job->regions->onBorder.data[cell]) && s < run->end[KIRI_STEP_LENGTHS - 1];
         ++s) {
        int32_t beside = job->grid->steps.data[s].cell;
        if (turned || IsInRegion(job, beside) != inside) {
            kiriField_MarkDirty(field, cell);
            kiriField_MarkDirty(field, beside);
        }
    }
}

/* Loads a cell about which something has changed; not where it is gone or beyond the limit. */
static void LoadDirtyCell(kiriShapeJob* job, kiriReach reach, int32_t limit, int32_t rim)
{
    kiriShapeWork* work = job->work;
    uint8_t mark = work->marks.data[reach.cell];
    if ((mark & KIRI_MARK_GONE) != 0) {
        return;
    }
    if (reach.fromSite <= limit) {
        work->fromSite.distance.data[reach.cell] = reach.fromSite;
        if ((mark & KIRI_MARK_STEPS) != 0 || reach.fromSite > rim) {
            kiriField_MarkDirty(&work->fromSite, reach.cell);
        }
    }
    work->fromBorder.distance.data[reach.cell] = reach.fromBorder;
    if ((mark & KIRI_MARK_STEPS) != 0 || reach.fromSite > limit) {
        kiriField_MarkDirty(&work->fromBorder, reach.cell);
    }
    if ((mark & KIRI_MARK_REGION) != 0) {
        MarkBorderSeedsDirty(job, reach.cell);
    }
}

/* Loads the list into the fields and marks what may change in them. The seeds of a site depend on the steps of its
   cell, so cells there are dirty too. */
static void LoadReaches(kiriShapeJob* job, int32_t limit)
{
    kiriShapeWork* work = job->work;
    const kiriReaches* list = &job->shape->reaches.data[job->frame];
    int32_t *fromSite = work->fromSite.distance.data, *fromBorder = work->fromBorder.distance.data;
    const uint8_t* marks = work->marks.data;
    int32_t old = work->frames.data[job->frame].limit, rim = limit > old ? old - KIRI_UNIT_KNIGHT : KIRI_FAR;
    int32_t plain = limit > old ? rim : limit; /* what is no farther has changed only where it is marked */
    for (int32_t k = 0; k < list->count; ++k) {
        kiriReach reach = list->data[k];
        if (reach.fromSite <= plain &&
            (marks[reach.cell] & (KIRI_MARK_STEPS | KIRI_MARK_GONE | KIRI_MARK_REGION)) == 0) {
            fromSite[reach.cell] = reach.fromSite;
            fromBorder[reach.cell] = reach.fromBorder;
        } else {
            LoadDirtyCell(job, reach, limit, rim);
        }
    }
    int32_t cell = job->sites[job->frame].cell;
    const kiriStepRun* run = &job->grid->runs.data[cell];
    for (int32_t s = run->first; (marks[cell] & KIRI_MARK_STEPS) && s < run->end[KIRI_STEP_LENGTHS - 1]; ++s) {
        kiriField_MarkDirty(&work->fromSite, job->grid->steps.data[s].cell);
    }
}

static bool StartFromSite(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    kiriShapeFrame* frame = &work->frames.data[job->frame];
    int32_t limit = LimitOf(ReachOf(job));
    bool ok = true;
    if (frame->moved) {
        work->seeds.count = 0;
        ok = kiriSite_Seed(&job->sites[job->frame], KIRI_NONE, job->memory, job->grid, job->mesh, &work->seeds) &&
             kiriField_Start(&work->fromSite, job->memory, work->seeds.data, work->seeds.count);
    } else {
        LoadReaches(job, limit);
    }
    frame->limit = limit;
    return ok;
}

static bool SeedBorder(kiriShapeJob* job)
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

/* Where the distance to the site has changed, ways to the border may pass that did not, or no more. */
static bool StartFromBorder(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    if (work->frames.data[job->frame].moved) {
        return SeedBorder(job);
    }
    for (int32_t k = 0; k < work->fromSite.log.count; ++k) {
        kiriSeed was = work->fromSite.log.data[k];
        if (work->fromSite.distance.data[was.cell] != was.distance) {
            kiriField_MarkDirty(&work->fromBorder, was.cell);
            if ((work->marks.data[was.cell] & KIRI_MARK_REGION) != 0) {
                MarkBorderSeedsDirty(job, was.cell);
            }
        }
    }
    return true;
}

static kiriProgress MeasureField(kiriShapeJob* job, kiriField* field, const kiriRule* rule, kiriQuota* quota)
{
    return job->work->frames.data[job->frame].moved ? kiriField_Flood(field, rule, quota)
                                                    : kiriField_Repair(field, job->memory, rule, quota);
}

/* UnloadFrame has made room. */
static void AddRawWeight(kiriShapeJob* job, kiriReach is)
{
    kiriShapeWork* work = job->work;
    double raw = is.fromSite == KIRI_FAR ? 0.0 : RawWeight(IsInRegion(job, is.cell), is.fromSite, is.fromBorder);
    bool none = job->shape->spans.data[is.cell].count == 0;
    if (raw > 0.0 || !none) {
        work->awaited.data[is.cell] += none;
        KIRI_ASSERT(work->rawWeights.count < work->rawWeights.capacity);
        work->rawWeights.data[work->rawWeights.count++] = (kiriRawWeight){ is.cell, job->frame, raw };
    }
}

/* Takes the distances of a cell out of the fields. */
static kiriReach UnloadCell(int32_t* fromSite, int32_t* fromBorder, int32_t cell)
{
    kiriReach reach = { cell, fromSite[cell], fromBorder[cell] };
    fromSite[cell] = fromBorder[cell] = KIRI_FAR;
    return reach;
}

static void UpdateReaches(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    kiriReaches* list = &job->shape->reaches.data[job->frame];
    int32_t *fromSite = work->fromSite.distance.data, *fromBorder = work->fromBorder.distance.data;
    const uint8_t* marks = work->marks.data;
    for (int32_t k = 0; k < list->count;) {
        kiriReach was = list->data[k], is = UnloadCell(fromSite, fromBorder, was.cell);
        bool same = is.fromSite == was.fromSite && is.fromBorder == was.fromBorder;
        if (same && (marks[was.cell] & KIRI_MARK_REGION) == 0) {
            ++k;
            continue;
        }
        if ((marks[was.cell] & KIRI_MARK_GONE) == 0) {
            AddRawWeight(job, is);
        }
        list->data[k] = is.fromSite != KIRI_FAR ? is : list->data[--list->count];
        k += is.fromSite != KIRI_FAR;
    }
}

/* A cell of a flood or a log that is still loaded is new in the list. */
static void AddReach(kiriShapeJob* job, int32_t cell)
{
    kiriReaches* list = &job->shape->reaches.data[job->frame];
    kiriReach is = UnloadCell(job->work->fromSite.distance.data, job->work->fromBorder.distance.data, cell);
    if (is.fromSite != KIRI_FAR) {
        KIRI_ASSERT(list->count < list->capacity && kiriGrid_IsCell(job->grid, cell));
        list->data[list->count++] = is;
        AddRawWeight(job, is);
    }
}

/* Brings the list up to date with the fields, and empties them. */
static bool UnloadFrame(kiriShapeJob* job)
{
    kiriShapeWork* work = job->work;
    kiriField *site = &work->fromSite, *border = &work->fromBorder;
    kiriReaches* list = &job->shape->reaches.data[job->frame];
    int64_t most = (int64_t)list->count + site->settled.count + site->log.count;
    if (!kiriArray_Reserve(job->memory, list, most) ||
        !kiriArray_Reserve(job->memory, &work->rawWeights, work->rawWeights.count + most)) {
        return false;
    }
    UpdateReaches(job);
    for (int32_t k = 0; k < site->settled.count; ++k) {
        AddReach(job, site->settled.data[k]);
    }
    for (int32_t k = 0; k < site->log.count; ++k) {
        AddReach(job, site->log.data[k].cell);
    }
    /* Distances to the border are given one step farther than ways go on. */
    for (int32_t k = 0; k < border->log.count; ++k) {
        border->distance.data[border->log.data[k].cell] = KIRI_FAR;
    }
    kiriField_Reset(border);
    site->settled.count = site->log.count = border->log.count = 0;
    return true;
}

kiriProgress kiriShapeJob_MeasureFrame(kiriShapeJob* job, kiriQuota* quota)
{
    kiriShapeWork* work = job->work;
    kiriProgress progress = KIRI_DONE;
    if (work->frameStage == KIRI_FRAME_REST) {
        if (!StartFromSite(job)) {
            return KIRI_FAILED;
        }
        work->frameStage = KIRI_FRAME_SITE;
    }
    if (work->frameStage == KIRI_FRAME_SITE) {
        const kiriRule rule = { job->grid, work->frames.data[job->frame].limit, NULL, SiteSeed, job };
        progress = MeasureField(job, &work->fromSite, &rule, quota);
        if (progress == KIRI_DONE) {
            progress = StartFromBorder(job) ? KIRI_DONE : KIRI_FAILED;
            work->frameStage = KIRI_FRAME_BORDER;
        }
    }
    if (progress == KIRI_DONE) {
        const kiriRule rule = { job->grid, KIRI_FAR - 1, HasWeight, BorderSeed, job };
        progress = MeasureField(job, &work->fromBorder, &rule, quota);
    }
    if (progress != KIRI_DONE) {
        return progress;
    }
    work->frameStage = KIRI_FRAME_REST;
    return UnloadFrame(job) ? KIRI_DONE : KIRI_FAILED;
}
