/* Relaxation: new sites go to the centroids of their regions; one site by itself to that of its part. */
#include "kiri_place_work.h"

enum { MOST_ROUNDS = 20, AREA_UNITS = 1 << 24 };

static double SquaredDistance(kiriVec2 a, kiriVec2 b)
{
    kiriVec2 d = kiriVec2_Sub(a, b);
    return kiriVec2_Dot(d, d);
}

kiriProgress kiriPlacerJob_StartRound(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    const kiriSites* sites = &job->placer->sites;
    for (int32_t i = job->placer->oldCount; i < sites->count; ++i) {
        work->targets.data[i - job->placer->oldCount] = kiriSiteTarget_None();
    }
    work->stage = FLOOD_ALL_NEW;
    return kiriPlacerJob_StartFlood(job, &work->fresh, job->placer->oldCount, sites->count) ? KIRI_DONE : KIRI_FAILED;
}

/* Where the flood needs no quota, and the part is much of the sheet. KIRI_MORE: it has to be flooded. */
static kiriProgress ScanPart(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    const kiriPlacer* placer = job->placer;
    bool isBegun = work->fresh.settled.count > 0;
    if (isBegun || work->hasOld || work->winds || placer->cells.count >= job->quota->left ||
        placer->cells.count < job->grid->cells.count / 4) {
        return KIRI_MORE;
    }
    kiriProgress progress =
        kiriField_Scan(&work->fresh, job->memory, job->grid, placer->cells.data, placer->cells.count);
    work->winds = progress == KIRI_MORE;
    bool isPaid = progress != KIRI_DONE || kiriQuota_Take(job->quota, work->fresh.settled.count);
    return isPaid ? progress : KIRI_MORE;
}

kiriProgress kiriPlacerJob_FloodAllNew(PlacerJob* job)
{
    kiriProgress progress = ScanPart(job);
    if (progress == KIRI_MORE) {
        progress = kiriPlacerJob_Flood(job, &job->work->fresh, kiriPlacerWork_OldDistances(job->work), NULL);
    }
    return kiriPlacerJob_GoOnTo(job, progress, SUM);
}

/* The target of the new site that a cell belongs to; null where it is an old one. */
static SiteTarget* TargetOf(PlacerJob* job, int32_t cell)
{
    kiriPlacerWork* work = job->work;
    int32_t owner = work->holds.data[cell];
    if (owner < 0) {
        owner = kiriPlacerWork_IsNearerThanOld(work, cell) ? work->fresh.owner.data[cell] : 0;
    }
    return owner < job->placer->oldCount ? NULL : &work->targets.data[owner - job->placer->oldCount];
}

/* A moment in units; of bytes that were made up it may be too large. */
static int64_t Plus(int64_t sum, double moment)
{
    const double most = 4611686018427387904.0; /* 2^62 */
    bool fits = moment > -most && moment < most && sum > -(INT64_C(1) << 62) && sum < INT64_C(1) << 62;
    return fits ? sum + (int64_t)(moment + 0.5) : sum;
}

/* Every cell counts for something, so that every region has a center. */
static void AddMaterial(const PlacerJob* job, SiteTarget* target, int32_t cell)
{
    const kiriFirstMoments material = kiriGrid_FirstMoments(job->grid, job->mesh, cell);
    double side = job->grid->side;
    int64_t area = (int64_t)(AREA_UNITS * (material.area / (side * side)) + 0.5);
    area = area > 0 ? area : 1;
    area *= kiriPlacerWork_DensityAt(job->work, cell);
    double scale = (double)area / (material.area * side);
    target->area += area;
    target->u = Plus(target->u, scale * material.u);
    target->v = Plus(target->v, scale * material.v);
}

static void FindCenter(const PlacerJob* job, SiteTarget* target)
{
    double scale = job->grid->side / (double)target->area;
    target->center = kiriVec2_Make(scale * (double)target->u, scale * (double)target->v);
}

/* Is the cell better for the target than the one that it has? Cells come in any order. */
static bool IsBetter(const PlacerJob* job, const SiteTarget* target, int32_t cell, double distance)
{
    if (target->cell == KIRI_NONE || distance != target->distance) {
        return target->cell == KIRI_NONE || distance < target->distance;
    }
    bool mostly = kiriGrid_IsMostlyCovered(job->grid, cell);
    return mostly != kiriGrid_IsMostlyCovered(job->grid, target->cell)
               ? mostly
               : kiriGrid_IsBefore(job->grid, cell, target->cell);
}

static void Consider(const PlacerJob* job, SiteTarget* target, int32_t cell)
{
    double distance = SquaredDistance(kiriGrid_Middle(job->grid, job->mesh, cell), target->center);
    if (IsBetter(job, target, cell, distance)) {
        target->cell = cell;
        target->distance = distance;
    }
}

static void SumCell(PlacerJob* job, int32_t cell)
{
    SiteTarget* target = TargetOf(job, cell);
    if (target != NULL) {
        AddMaterial(job, target, cell);
    }
}

kiriProgress kiriPlacerJob_SumRegions(PlacerJob* job)
{
    kiriProgress progress = kiriPlacerJob_VisitFresh(job, SumCell);
    if (progress == KIRI_DONE) {
        for (int32_t k = 0; k < job->placer->sites.count - job->placer->oldCount; ++k) {
            SiteTarget* target = &job->work->targets.data[k];
            target->isFound = target->area <= 0; /* of bytes that were made up a region may be empty: its site stays */
            if (!target->isFound) {
                FindCenter(job, target);
            }
        }
        job->work->lost = 0;
        job->work->stage = AIM_NEAR;
    }
    return progress;
}

static void AimCell(PlacerJob* job, int32_t cell)
{
    SiteTarget* target = TargetOf(job, cell);
    if (target != NULL && !target->isFound) {
        Consider(job, target, cell);
    }
}

/* Looks where the center of a target is, and in the squares around: middles of all others are at least one and a half
   sides away. */
static void AimAround(PlacerJob* job, SiteTarget* target)
{
    const kiriSquares* squares = &job->mesh->squares;
    int32_t square = kiriSquares_At(squares, kiriMesh_Snap(job->mesh, target->center));
    int32_t column = square % squares->columns, row = square / squares->columns;
    for (int32_t k = 0; square != KIRI_NONE && k < 9; ++k) {
        int32_t u = column + k % 3 - 1, v = row + k / 3 - 1;
        bool isSquare = u >= 0 && u < squares->columns && v >= 0 && v < squares->rows;
        int32_t c = isSquare ? job->grid->squareCell.data[v * squares->columns + u] : KIRI_NONE;
        for (; c != KIRI_NONE; c = job->grid->cells.data[c].next) {
            if (job->work->fresh.distance.data[c] != KIRI_FAR && TargetOf(job, c) == target) {
                Consider(job, target, c);
            }
        }
    }
    target->isFound = target->cell != KIRI_NONE && target->distance < 2.0 * job->grid->side * job->grid->side;
}

/* The centroid itself where it lies in the square of the target cell. From middle to middle of cells a site would get
   stuck where its centroid is less than half a side away. */
static kiriSite SiteFor(const PlacerJob* job, const SiteTarget* target)
{
    kiriVec2 off = kiriVec2_Sub(target->center, kiriGrid_Middle(job->grid, job->mesh, target->cell));
    double half = 0.5 * job->grid->side;
    kiriSite site = kiriFrames_SiteIn(job->grid, job->mesh, target->cell);
    if (fabs(off.x) < half && fabs(off.y) < half) {
        site.at = target->center;
    }
    return site;
}

/* All new sites go to their targets. Did one go farther than a hundredth of a side? */
static bool MoveToTargets(PlacerJob* job)
{
    kiriPlacer* placer = job->placer;
    bool moved = false;
    for (int32_t i = placer->oldCount; i < placer->sites.count; ++i) {
        job->work->holds.data[placer->sites.data[i].cell] = KIRI_CELL_FREE;
    }
    for (int32_t i = placer->oldCount; i < placer->sites.count; ++i) {
        const SiteTarget* target = &job->work->targets.data[i - placer->oldCount];
        kiriSite site = target->cell != KIRI_NONE ? SiteFor(job, target) : placer->sites.data[i];
        moved =
            moved || SquaredDistance(site.at, placer->sites.data[i].at) > 0.0001 * job->grid->side * job->grid->side;
        placer->sites.data[i] = site;
        KIRI_ASSERT(job->work->holds.data[site.cell] < 0); /* two sites in a cell */
        job->work->holds.data[site.cell] = i;
    }
    return moved;
}

/* Most regions hold their centroid. */
kiriProgress kiriPlacerJob_AimNearCenters(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    int32_t count = job->placer->sites.count - job->placer->oldCount;
    for (; work->cursor < count; ++work->cursor) {
        if (!kiriQuota_Take(job->quota, 1)) {
            return KIRI_MORE;
        }
        if (!work->targets.data[work->cursor].isFound) {
            AimAround(job, &work->targets.data[work->cursor]);
        }
        work->lost += !work->targets.data[work->cursor].isFound;
    }
    work->cursor = 0;
    work->stage = AIM;
    return KIRI_DONE;
}

kiriProgress kiriPlacerJob_AimAtCenters(PlacerJob* job)
{
    kiriPlacer* placer = job->placer;
    kiriProgress progress = job->work->lost > 0 ? kiriPlacerJob_VisitFresh(job, AimCell) : KIRI_DONE;
    if (progress != KIRI_DONE) {
        return progress;
    }
    if (MoveToTargets(job) && ++job->work->round < MOST_ROUNDS) {
        return kiriPlacerJob_StartRound(job);
    }
    for (int32_t i = placer->oldCount; i < placer->sites.count; ++i) {
        placer->sites.data[i] = kiriFrames_SiteIn(job->grid, job->mesh, placer->sites.data[i].cell);
    }
    job->work->stage = PLACER_RESTS;
    return KIRI_DONE;
}

/* ---- One site by itself */

static void SumPartCell(PlacerJob* job, int32_t cell)
{
    AddMaterial(job, &job->work->targets.data[0], cell);
}

kiriProgress kiriPlacerJob_SumPart(PlacerJob* job)
{
    kiriProgress progress = kiriPlacerJob_VisitPart(job, SumPartCell);
    if (progress == KIRI_DONE) {
        FindCenter(job, &job->work->targets.data[0]);
        job->work->stage = AIM_PART;
    }
    return progress;
}

static void AimPartCell(PlacerJob* job, int32_t cell)
{
    if (job->work->holds.data[cell] == KIRI_CELL_FREE) {
        Consider(job, &job->work->targets.data[0], cell);
    }
}

kiriProgress kiriPlacerJob_AimPart(PlacerJob* job)
{
    kiriProgress progress = kiriPlacerJob_VisitPart(job, AimPartCell);
    if (progress == KIRI_DONE) {
        kiriSites* sites = &job->placer->sites;
        int32_t cell = job->work->targets.data[0].cell;
        if (cell != KIRI_NONE) {
            sites->data[sites->count++] = kiriFrames_SiteIn(job->grid, job->mesh, cell);
        }
        job->work->stage = PLACER_RESTS;
    }
    return progress;
}
