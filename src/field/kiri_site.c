#include "kiri_site.h"

#include <string.h>

/* ---- Slit ends ---- */

/* The next corner of the fan clockwise, or KIRI_NONE where the fan begins. */
static int32_t ClockwiseOf(const kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_IsOpen(mesh, h) ? KIRI_NONE : kiriMesh_Twin(mesh, h);
    return twin == KIRI_NONE ? KIRI_NONE : kiriEdge_Next(twin);
}

/* The open half-edge that leaves the vertex, where its fan goes all around from the one lip of that edge to the other;
   else KIRI_NONE. */
static int32_t LipAt(const kiriMeshData* mesh, int32_t vertex)
{
    KIRI_ASSERT(vertex >= 0 && vertex < mesh->vertices.count);
    int32_t start = mesh->vertices.data[vertex].edge, first = start, last = start;
    for (int32_t h = ClockwiseOf(mesh, first); h != KIRI_NONE; h = ClockwiseOf(mesh, h)) {
        if (h == start) {
            return KIRI_NONE; /* no edge is open */
        }
        first = h;
    }
    for (int32_t h = start; h != KIRI_NONE; h = kiriMesh_CounterClockwise(mesh, h)) {
        last = h;
    }
    bool isEnd = kiriMesh_IsOpen(mesh, first) && kiriMesh_Twin(mesh, kiriEdge_Previous(last)) == first;
    return isEnd ? first : KIRI_NONE;
}

/* Adds the vertices it looks at. */
static bool SearchCell(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell, kiriSlitEnd* end, int32_t* looks)
{
    int32_t square = grid->cells.data[cell].square;
    int32_t v = grid->whole.data[square] ? KIRI_NONE : mesh->squares.vertexHead[square];
    for (; v != KIRI_NONE; v = mesh->vertices.data[v].next) {
        int32_t lip = kiriGrid_CellOfVertex(grid, mesh, v) == cell ? LipAt(mesh, v) : KIRI_NONE;
        *looks += 1;
        if (lip != KIRI_NONE) {
            int32_t before = kiriMesh_Tail(mesh, kiriEdge_Next(lip));
            end->at = kiriMesh_Local(mesh, mesh->vertices.data[v].at);
            kiriVec2 way = kiriVec2_Sub(end->at, kiriMesh_Local(mesh, mesh->vertices.data[before].at));
            end->along = kiriVec2_Scale(1.0 / kiriVec2_Length(way), way);
            end->cell = cell;
            return true;
        }
    }
    return false;
}

bool kiriSlits_FindEndIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell, kiriSlitEnd* end)
{
    int32_t looks = 0;
    return SearchCell(grid, mesh, cell, end, &looks);
}

enum { SEARCHED_CELLS_AN_ITEM = 16, SEARCHED_VERTICES_AN_ITEM = 3 };

kiriProgress kiriSlits_FindEnds(kiriSlitEnds* ends, kiriSlitSearch* search, kiriMemory* memory, const kiriGrid* grid,
                                const kiriMeshData* mesh, const int32_t* cells, int32_t cellCount, kiriQuota* quota)
{
    ends->count = search->seen == 0 ? 0 : ends->count;
    while (kiriQuota_Pay(quota, &search->owed)) {
        kiriSlitEnd end;
        int32_t looks = 0;
        if (search->seen == cellCount) {
            return KIRI_DONE;
        }
        if (SearchCell(grid, mesh, cells[search->seen], &end, &looks) && !kiriArray_Push(memory, ends, end)) {
            return KIRI_FAILED;
        }
        search->owed = (search->seen % SEARCHED_CELLS_AN_ITEM == 0) + looks / SEARCHED_VERTICES_AN_ITEM;
        search->seen += 1;
    }
    return KIRI_MORE;
}

/* ---- Pairs ---- */

/* The cell to which the straight way through the material leads, or KIRI_NONE where a cut or the outline is in it. */
static int32_t CellAlong(const kiriGrid* grid, const kiriMeshData* mesh, const kiriSlitEnd* end, kiriVec2 way)
{
    int32_t cell = end->cell, parts = (int32_t)(2.0 * kiriVec2_Length(way) / grid->side) + 1;
    for (int32_t k = 1; k <= parts && cell != KIRI_NONE; ++k) {
        kiriVec2 at = kiriVec2_Add(end->at, kiriVec2_Scale((double)k / parts, way));
        int32_t next = kiriGrid_CellAt(grid, mesh, kiriMesh_Snap(mesh, at));
        cell = next != KIRI_NONE && kiriGrid_AreNear(grid, cell, next) ? next : KIRI_NONE;
    }
    return cell;
}

static bool HasRoom(const kiriSites* sites, const kiriSite* site, double distance)
{
    for (int32_t i = 0; i < sites->count; ++i) {
        kiriVec2 off = kiriVec2_Sub(site->at, sites->data[i].at);
        if (sites->data[i].cell == site->cell || kiriVec2_Dot(off, off) < distance * distance) {
            return false;
        }
    }
    return true;
}

/* So far to both sides; false where there is no room. The sites have room for two more. */
static bool TryPair(kiriSites* sites, const kiriGrid* grid, const kiriMeshData* mesh, const kiriSlitEnd* end,
                    double reach)
{
    kiriVec2 left = kiriVec2_Make(-reach * end->along.y, reach * end->along.x);
    kiriVec2 right = kiriVec2_Scale(-1.0, left);
    kiriSite a = { kiriVec2_Add(end->at, left), CellAlong(grid, mesh, end, left) };
    kiriSite b = { kiriVec2_Add(end->at, right), CellAlong(grid, mesh, end, right) };
    if (a.cell == KIRI_NONE || b.cell == KIRI_NONE || a.cell == b.cell || !HasRoom(sites, &a, reach) ||
        !HasRoom(sites, &b, reach)) {
        return false;
    }
    sites->data[sites->count++] = a;
    sites->data[sites->count++] = b;
    return true;
}

/* Half the spacing to both sides, or less, but no less than a square. */
static void AddPair(kiriSites* sites, const kiriGrid* grid, const kiriMeshData* mesh, const kiriSlitEnd* end,
                    double spacing)
{
    double reach = kiriMax(0.5 * spacing, grid->side);
    while (!TryPair(sites, grid, mesh, end, reach) && reach > grid->side) {
        reach = kiriMax(0.5 * reach, grid->side);
    }
}

bool kiriSlits_AddPairs(kiriSites* sites, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriSlitEnds* ends, double spacing, int32_t most)
{
    if (!kiriArray_Reserve(memory, sites, most)) {
        return false;
    }
    for (int32_t i = 0; i < ends->count && sites->count + 2 <= most; ++i) {
        AddPair(sites, grid, mesh, &ends->data[i], spacing);
    }
    return true;
}

/* ---- Placing (section 5) ----------------------------------------------------------------------------------------

   What is computed, whatever the order of work (tests/test_frame.c has a plain version):

   A site sends its seeds to the cells around (kiriSite_Seed), but to none that holds another site. A cell belongs to
   the site that is nearest from there by the steps of the grid, of two as near to the lower index; but a site's own
   cell is its own. So no region is ever empty, and no two sites come to share a cell. Old sites take no notice of new
   ones, nor, in sampling, new sites of those that follow.

   Sampling: the next site goes to the free cell that is farthest from all sites. Relaxation (Lloyd 1982): each new site
   goes to the centroid of its region, all at once, up to 20 times; then it takes the cell that it has come to.

   What is the same from round to round is kept: distances to the old sites are flooded once, those to the new sites
   only as far as these are nearer. */

enum { CELL_BARRED = -2, CLOSENESS = 16 };

/* So many cells of the part, one after the other in their order. */
enum { SAMPLE_CELLS = 512 };

/* A full cell is taken at its middle, where the cell's weight is exactly 1; of others the middle may not be
   material. */
kiriSite kiriFrames_SiteIn(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    bool full = kiriGrid_Area(grid, cell) > 0.999 * grid->side * grid->side;
    kiriMoments material = kiriGrid_Material(grid, mesh, cell);
    kiriSite site = { full ? kiriGrid_Middle(grid, mesh, cell) : kiriMoments_Center(&material), cell };
    return site;
}

/* Drops seeds, from the first on, in cells that hold another site. */
static void DropSeeds(PlacerJob* job, int32_t first, int32_t owner)
{
    kiriSeeds* seeds = &job->work->seeds;
    int32_t kept = first;
    for (int32_t k = first; k < seeds->count; ++k) {
        int32_t holds = job->work->holds.data[seeds->data[k].cell];
        if (holds < 0 || holds == owner) {
            seeds->data[kept++] = seeds->data[k];
        }
    }
    seeds->count = kept;
}

static bool kiriPlacerJob_StartFlood(PlacerJob* job, kiriField* field, int32_t first, int32_t end)
{
    kiriSeeds* seeds = &job->work->seeds;
    kiriField_Reset(field);
    seeds->count = 0;
    for (int32_t i = first; i < end; ++i) {
        int32_t before = seeds->count;
        if (!kiriSite_Seed(&job->placer->sites.data[i], i, job->memory, job->grid, job->mesh, seeds)) {
            return false;
        }
        DropSeeds(job, before, i);
    }
    return kiriField_Start(field, job->memory, seeds->data, seeds->count);
}

static kiriProgress kiriPlacerJob_Flood(PlacerJob* job, kiriField* field, const int32_t* below, const int32_t* andBelow)
{
    kiriRule rule = { job->grid, KIRI_FAR - 1, NULL, NULL, NULL, NULL, { below, andBelow } };
    return kiriField_Flood(field, &rule, job->quota);
}

/* ---- Closeness */

static kiriProgress FloodEnds(PlacerJob* job)
{
    bool isAsked = job->work->reach > 0;
    return kiriPlacerJob_GoOnTo(job, isAsked ? kiriPlacerJob_Flood(job, &job->work->ends, NULL, NULL) : KIRI_DONE,
                                FLOOD_OLD);
}

/* How much closer sites shall be at a cell, times CLOSENESS. */
static int64_t ClosenessAt(const kiriPlacerWork* work, int32_t cell)
{
    if (work->reach == 0) {
        return CLOSENESS;
    }
    int64_t distance = work->ends.distance.data[cell], most = work->closest;
    int64_t closeness = distance > 0 ? work->reach / distance : most;
    return closeness < CLOSENESS ? CLOSENESS : kiriMin(closeness, most);
}

/* What makes a centroidal Voronoi diagram as much closer: the fourth power, as a density (Du, Faber, Gunzburger
   1999). */
static int64_t kiriPlacerWork_DensityAt(const kiriPlacerWork* work, int32_t cell)
{
    if (work->reach == 0) {
        return 1;
    }
    int64_t squared = ClosenessAt(work, cell) * ClosenessAt(work, cell);
    return squared * squared / ((int64_t)CLOSENESS * CLOSENESS * CLOSENESS * CLOSENESS);
}

/* ---- Relaxation: new sites go to the centroids of their regions; one site by itself to its part's ---- */

enum { MOST_ROUNDS = 20, AREA_UNITS = 1 << 24 };

static double SquaredDistance(kiriVec2 a, kiriVec2 b)
{
    kiriVec2 d = kiriVec2_Sub(a, b);
    return kiriVec2_Dot(d, d);
}

static kiriProgress kiriPlacerJob_StartRound(PlacerJob* job)
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

static kiriProgress kiriPlacerJob_FloodAllNew(PlacerJob* job)
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
    const kiriMoments material = kiriGrid_Material(job->grid, job->mesh, cell);
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

static kiriProgress kiriPlacerJob_SumRegions(PlacerJob* job)
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
static kiriProgress kiriPlacerJob_AimNearCenters(PlacerJob* job)
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

static kiriProgress kiriPlacerJob_AimAtCenters(PlacerJob* job)
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

static kiriProgress kiriPlacerJob_SumPart(PlacerJob* job)
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
    KIRI_ASSERT(cell >= 0 && cell < job->work->holds.count);
    if (job->work->holds.data[cell] == KIRI_CELL_FREE) {
        Consider(job, &job->work->targets.data[0], cell);
    }
}

static kiriProgress kiriPlacerJob_AimPart(PlacerJob* job)
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

/* ---- Sampling */

static kiriProgress FloodOld(PlacerJob* job)
{
    bool isKnown = !job->work->hasOld || job->work->old != &job->work->flooded;
    return kiriPlacerJob_GoOnTo(job, isKnown ? KIRI_DONE : kiriPlacerJob_Flood(job, &job->work->flooded, NULL, NULL),
                                SAMPLE);
}

static int64_t SampledDistance(const kiriPlacerWork* work, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < work->sampled.count);
    int64_t old = kiriPlacerWork_OldDistance(work, cell), sampled = work->sampled.data[cell];
    return kiriMin(old, sampled) * ClosenessAt(work, cell);
}

/* In a part without a site all cells are equally far, and the first one is taken: relaxation moves the site on. */
static void FindFarthest(PlacerJob* job, int32_t cell)
{
    kiriPlacerWork* work = job->work;
    if (work->holds.data[cell] != KIRI_CELL_FREE) {
        return;
    }
    int32_t best = work->farthest;
    int64_t distance = SampledDistance(work, cell);
    int64_t farthest = best == KIRI_NONE ? KIRI_NONE : SampledDistance(work, best);
    if (distance > farthest || (distance == farthest && kiriGrid_IsMostlyCovered(job->grid, cell) &&
                                !kiriGrid_IsMostlyCovered(job->grid, best))) {
        work->farthest = cell;
    }
}

enum { LOOKS_AN_ITEM = 16 };

/* Returns items. */
static int32_t LookAtBlock(PlacerJob* job, SampleBlock* block)
{
    kiriPlacerWork* work = job->work;
    const kiriPlacer* placer = job->placer;
    int32_t first = (int32_t)(block - work->blocks.data) * SAMPLE_CELLS, left = placer->cells.count - first;
    int32_t end = first + kiriMin(left, SAMPLE_CELLS);
    work->farthest = KIRI_NONE;
    for (int32_t i = first; i < end; ++i) {
        FindFarthest(job, placer->cells.data[i]);
    }
    block->cell = work->farthest;
    block->distance = block->cell == KIRI_NONE ? -1 : SampledDistance(work, block->cell);
    block->isCovered = block->cell != KIRI_NONE && kiriGrid_IsMostlyCovered(job->grid, block->cell);
    block->seen = placer->sites.count;
    return 1 + (end - first) / LOOKS_AN_ITEM;
}

/* The block that may have the farthest cell; of equals the first. */
static SampleBlock* FarthestBlock(const kiriPlacerWork* work)
{
    SampleBlock* best = work->blocks.data;
    for (int32_t b = 1; b < work->blocks.count; ++b) {
        SampleBlock* block = &work->blocks.data[b];
        if (block->distance > best->distance ||
            (block->distance == best->distance && block->isCovered && !best->isCovered)) {
            best = block;
        }
    }
    return best;
}

/* Looks at blocks until the one that may have the farthest cell has it. */
static kiriProgress FindFarthestOfAll(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    SampleBlock* best = FarthestBlock(work);
    for (; best->seen != job->placer->sites.count; best = FarthestBlock(work)) {
        if (!kiriQuota_Pay(job->quota, &work->due)) {
            return KIRI_MORE;
        }
        work->due = LookAtBlock(job, best);
    }
    work->farthest = best->cell;
    return kiriQuota_Pay(job->quota, &work->due) ? KIRI_DONE : KIRI_MORE;
}

static bool StartBlocks(const kiriPlacer* placer, kiriMemory* memory)
{
    kiriPlacerWork* work = placer->work;
    int32_t count = placer->cells.count / SAMPLE_CELLS + 1;
    if (!kiriArray_Resize(memory, &work->blocks, count)) {
        return false;
    }
    for (int32_t b = 0; b < count; ++b) {
        work->blocks.data[b] = (SampleBlock){ INT64_MAX, KIRI_NONE, -1, true };
    }
    return true;
}

static kiriProgress SampleFarthest(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    kiriSites* sites = &job->placer->sites;
    kiriProgress progress = FindFarthestOfAll(job);
    if (progress != KIRI_DONE) {
        return progress;
    }
    if (work->farthest != KIRI_NONE) {
        KIRI_ASSERT(sites->count < sites->capacity);
        work->holds.data[work->farthest] = sites->count;
        sites->data[sites->count++] = kiriFrames_SiteIn(job->grid, job->mesh, work->farthest); /* Start made room */
    }
    work->left = work->farthest == KIRI_NONE ? 0 : work->left - 1;
    work->farthest = KIRI_NONE;
    if (work->left == 0) {
        return kiriPlacerJob_StartRound(job);
    }
    work->stage = FLOOD_NEW;
    return kiriPlacerJob_StartFlood(job, &work->fresh, sites->count - 1, sites->count) ? KIRI_DONE : KIRI_FAILED;
}

static kiriProgress FloodNew(PlacerJob* job)
{
    return kiriPlacerJob_GoOnTo(
        job,
        kiriPlacerJob_Flood(job, &job->work->fresh, kiriPlacerWork_OldDistances(job->work), job->work->sampled.data),
        LOWER);
}

static void LowerCell(PlacerJob* job, int32_t cell)
{
    kiriPlacerWork* work = job->work;
    if (work->fresh.distance.data[cell] < work->sampled.data[cell]) {
        work->sampled.data[cell] = work->fresh.distance.data[cell];
    }
}

static kiriProgress LowerDistances(PlacerJob* job)
{
    return kiriPlacerJob_GoOnTo(job, kiriPlacerJob_VisitFresh(job, LowerCell), SAMPLE);
}

/* ---- The job */

static kiriProgress (*const placerStages[PLACER_STAGES])(PlacerJob* job) = {
    NULL,
    FloodEnds,
    FloodOld,
    SampleFarthest,
    FloodNew,
    LowerDistances,
    kiriPlacerJob_FloodAllNew,
    kiriPlacerJob_SumRegions,
    kiriPlacerJob_AimNearCenters,
    kiriPlacerJob_AimAtCenters,
    kiriPlacerJob_SumPart,
    kiriPlacerJob_AimPart,
};

kiriProgress kiriPlacer_Run(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                            kiriQuota* quota)
{
    PlacerJob job = { placer, placer->work, memory, grid, mesh, quota };
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && job.work != NULL && job.work->stage != PLACER_RESTS) {
        progress = placerStages[job.work->stage](&job);
    }
    return progress;
}

static kiriPlacerWork* WorkOf(kiriPlacer* placer, kiriMemory* memory)
{
    if (placer->work == NULL) {
        placer->work = kiriMemory_AllocZeroed(memory, sizeof(kiriPlacerWork));
    }
    return placer->work;
}

/* Room for the job, so that only seeds need memory while it runs. */
static bool MakePlacerRoom(kiriPlacer* placer, kiriPlacerWork* work, kiriMemory* memory, const kiriGrid* grid,
                           int32_t count)
{
    int32_t cells = grid->cells.count;
    return (work->old != &work->flooded || kiriField_Resize(&work->flooded, memory, cells)) &&
           kiriField_Resize(&work->fresh, memory, cells) && kiriArray_Resize(memory, &work->sampled, cells) &&
           kiriArray_Resize(memory, &work->holds, cells) &&
           kiriArray_Resize(memory, &work->targets, count > 0 ? count : 1) &&
           kiriArray_Reserve(memory, &placer->sites, (int64_t)placer->sites.count + count);
}

/* Only cells of the part are ever read from `sampled` and `holds`: floods do not leave it. */
static void ClearPart(const kiriPlacer* placer, const uint8_t* allowed)
{
    kiriPlacerWork* work = placer->work;
    for (int32_t k = 0; k < placer->cells.count; ++k) {
        int32_t cell = placer->cells.data[k];
        work->sampled.data[cell] = KIRI_FAR;
        work->holds.data[cell] = allowed == NULL || allowed[cell] ? KIRI_CELL_FREE : CELL_BARRED;
    }
    for (int32_t i = 0; i < placer->sites.count; ++i) {
        int32_t* holds = &work->holds.data[placer->sites.data[i].cell];
        KIRI_ASSERT(*holds < 0); /* two sites in a cell */
        *holds = i;
    }
}

static PlacerStage FirstStage(const kiriPlacer* placer)
{
    const kiriPlacerWork* work = placer->work;
    if (work->left == 0) {
        return PLACER_RESTS;
    }
    return work->left == 1 && placer->oldCount == 0 ? SUM_PART : FLOOD_ENDS;
}

/* A field from the slit ends, where sites are to be closer there. */
static bool StartEnds(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid)
{
    kiriPlacerWork* work = placer->work;
    double reach = placer->reach / grid->side, most = 4.0 * (grid->cells.count + 1.0);
    placer->reach = 0.0;
    work->reach = 0;
    if (!(reach > 0.0) || placer->ends.count == 0 || FirstStage(placer) == SUM_PART) {
        return true;
    }
    work->reach = (int64_t)(CLOSENESS * KIRI_UNIT * kiriMin(reach, most));
    work->closest = (int32_t)(CLOSENESS * placer->closeness + 0.5);
    work->seeds.count = 0;
    for (int32_t k = 0; k < placer->ends.count; ++k) {
        kiriSeed seed = { placer->ends.data[k].cell, 0, 0 };
        if (!kiriArray_Push(memory, &work->seeds, seed)) {
            return false;
        }
    }
    if (!kiriField_Resize(&work->ends, memory, grid->cells.count)) {
        return false;
    }
    kiriField_Reset(&work->ends);
    return kiriField_Start(&work->ends, memory, work->seeds.data, work->seeds.count);
}

bool kiriPlacer_Start(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      const uint8_t* allowed, int32_t count)
{
    kiriPlacerWork* work = WorkOf(placer, memory);
    const kiriField* known = placer->known;
    KIRI_ASSERT(count >= 0);
    count = kiriMin(count, placer->cells.count);
    placer->oldCount = placer->sites.count;
    placer->known = NULL;
    if (work == NULL) {
        return false;
    }
    work->stage = PLACER_RESTS;
    work->hasOld = known != NULL || placer->oldCount > 0;
    work->old = known != NULL || !work->hasOld ? known : &work->flooded;
    if (!MakePlacerRoom(placer, work, memory, grid, count)) {
        return false;
    }
    ClearPart(placer, allowed);
    PlacerJob job = { placer, work, memory, grid, mesh, NULL };
    if (work->old == &work->flooded && !kiriPlacerJob_StartFlood(&job, &work->flooded, 0, placer->oldCount)) {
        return false;
    }
    work->cursor = work->round = 0;
    work->winds = false;
    work->left = count;
    work->due = 0;
    work->farthest = KIRI_NONE;
    work->targets.data[0] = kiriSiteTarget_None();
    if (!StartEnds(placer, memory, grid) || !StartBlocks(placer, memory)) {
        return false;
    }
    work->stage = FirstStage(placer);
    return true;
}

static bool TakeCell(kiriPlacer* placer, kiriMemory* memory, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < placer->work->marks.count);
    uint8_t* mark = &placer->work->marks.data[cell];
    if (*mark) {
        return true;
    }
    *mark = 1;
    if (!kiriArray_Push(memory, &placer->cells, cell)) {
        *mark = 0;
        return false;
    }
    return true;
}

enum { TAKEN_CELLS_AN_ITEM = 3 }; /* with what it takes to order and to mark them */

/* Breadth first over straight steps: there is one for every two cells that share a face. */
static kiriProgress GatherPiece(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, kiriQuota* quota)
{
    for (int32_t* k = &placer->work->cursor; *k < placer->cells.count; ++*k) {
        kiriSteps steps;
        kiriGrid_GetStepsTo(grid, placer->cells.data[*k], 1, &steps);
        if (*k % TAKEN_CELLS_AN_ITEM == 0 && !kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        for (int32_t s = 0; s < steps.end[0]; ++s) {
            if (!TakeCell(placer, memory, steps.data[s].cell)) {
                return KIRI_FAILED;
            }
        }
    }
    return KIRI_DONE;
}

/* Brings the cells, which are marked, into their order. Where they fill a good part of the squares from the first to
   the last, it is cheaper to look into all squares there than to sort. */
static void OrderPiece(kiriPlacer* placer, const kiriGrid* grid)
{
    int32_t count = placer->cells.count, first = INT32_MAX, last = 0;
    for (int32_t k = 0; k < count; ++k) {
        int32_t square = grid->cells.data[placer->cells.data[k]].square;
        first = kiriMin(square, first);
        last = kiriMax(square, last);
    }
    if (last - first > 8 * (int64_t)count) {
        kiriGrid_SortCells(grid, placer->cells.data, count);
        return;
    }
    int32_t* cells = placer->cells.data;
    for (int32_t square = first; square <= last; ++square) {
        for (int32_t c = grid->squareCell.data[square]; c != KIRI_NONE; c = grid->cells.data[c].next) {
            if (placer->work->marks.data[c]) {
                *cells++ = c;
            }
        }
    }
}

static void ClearTakenMarks(kiriPlacer* placer)
{
    for (int32_t k = 0; placer->work->isTaking && k < placer->cells.count; ++k) {
        placer->work->marks.data[placer->cells.data[k]] = 0;
    }
    placer->work->isTaking = false;
}

bool kiriPlacer_StartPiece(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, int32_t cell)
{
    kiriPlacerWork* work = WorkOf(placer, memory);
    if (work == NULL || !kiriArray_Reserve(memory, &work->marks, grid->cells.count)) {
        return false;
    }
    ClearTakenMarks(placer); /* of a piece that was given up */
    while (work->marks.count < grid->cells.count) {
        work->marks.data[work->marks.count++] = 0;
    }
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    placer->cells.count = work->cursor = 0;
    work->isTaking = true;
    return TakeCell(placer, memory, cell);
}

kiriProgress kiriPlacer_GoOnWithPiece(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, kiriQuota* quota)
{
    if (!placer->work->isTaking) {
        return KIRI_DONE;
    }
    kiriProgress progress = GatherPiece(placer, memory, grid, quota);
    if (progress == KIRI_DONE) {
        OrderPiece(placer, grid);
        ClearTakenMarks(placer);
    }
    return progress;
}

bool kiriPlacer_TakePiece(kiriPlacer* placer, kiriMemory* memory, const kiriGrid* grid, int32_t cell)
{
    kiriQuota unlimited = { INT64_MAX, 0, 0, false };
    return kiriPlacer_StartPiece(placer, memory, grid, cell) &&
           kiriPlacer_GoOnWithPiece(placer, memory, grid, &unlimited) == KIRI_DONE;
}
