#include "kiri_site.h"

/* ---- Slit ends --------------------------------------------------------------------------------------------------- */

/* Returns true if a fan goes all around, from one lip of its first edge to the other. */
static bool IsSlitEnd(const kiriMeshData* mesh, int32_t first, int32_t last)
{
    return kiriMesh_IsOpen(mesh, first) && kiriMesh_Twin(mesh, kiriEdge_Previous(last)) == first;
}

#define SHARP 0.7 /* cosine of the widest notch */

bool kiriSlits_WayOn(const kiriMeshData* mesh, int32_t vertex, kiriVec2* along)
{
    int32_t first, last;
    if (!kiriMesh_FindFan(mesh, vertex, &first, &last)) {
        return false;
    }
    int32_t other = kiriEdge_Previous(last); /* leads to the vertex */
    kiriVec2 a = kiriMesh_Direction(mesh, kiriMesh_Head(mesh, first), vertex);
    kiriVec2 b = kiriMesh_Direction(mesh, kiriMesh_Tail(mesh, other), vertex), sum = kiriVec2_Add(a, b);
    bool isNotch = kiriVec2_Dot(a, b) > SHARP && kiriVec2_Cross(a, b) < 0.0;
    *along = kiriVec2_Normalize(sum);
    return (isNotch || IsSlitEnd(mesh, first, last)) && !kiriMesh_IsCrease(mesh, first) && !kiriMesh_IsCrease(mesh, other);
}

bool kiriSlits_FindEndIn(const kiriGrid* grid, int32_t cell, kiriSlitEnd* end, int32_t* looks)
{
    const kiriMeshData* mesh = grid->mesh;
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    int32_t square = grid->cells.data[cell].square;
    int32_t v = grid->whole.data[square] ? KIRI_NONE : mesh->squares.vertexHead[square];
    for (; v != KIRI_NONE; v = mesh->vertices.data[v].next) {
        int32_t first, last;
        *looks += 1;
        if (kiriGrid_CellOfVertex(grid, v) == cell && kiriMesh_FindFan(mesh, v, &first, &last) &&
            IsSlitEnd(mesh, first, last)) {
            int32_t before = kiriMesh_Head(mesh, first);
            end->at = kiriMesh_LocalOf(mesh, v);
            end->along = kiriVec2_Normalize(kiriVec2_Sub(end->at, kiriMesh_LocalOf(mesh, before)));
            end->cell = cell;
            return true;
        }
    }
    return false;
}

kiriProgress kiriSlits_FindEnds(kiriSlitEnds* ends, kiriSlitSearch* search, const kiriGrid* grid, const int32_t* cells,
                                int32_t cellCount, kiriQuota* quota)
{
    enum { CELLS_AN_ITEM = 16, VERTICES_AN_ITEM = 3 };
    ends->count = search->seen == 0 ? 0 : ends->count;
    while (kiriQuota_Pay(quota, &search->owed)) {
        kiriSlitEnd end;
        int32_t looks = 0;
        if (search->seen == cellCount) {
            return KIRI_DONE;
        }
        if (kiriSlits_FindEndIn(grid, cells[search->seen], &end, &looks) &&
            !kiriArray_Push(grid->mesh->memory, ends, end)) {
            return KIRI_FAILED;
        }
        search->owed = (search->seen % CELLS_AN_ITEM == 0) + looks / VERTICES_AN_ITEM;
        search->seen += 1;
    }
    return KIRI_MORE;
}

static double SquaredDistance(kiriVec2 a, kiriVec2 b)
{
    kiriVec2 d = kiriVec2_Sub(a, b);
    return kiriVec2_Dot(d, d);
}

kiriSite kiriSlit_SiteBeside(const kiriGrid* grid, const kiriSlitEnd* end, double left)
{
    kiriVec2 way = { -left * end->along.y, left * end->along.x };
    int32_t cell = end->cell, parts = (int32_t)(2.0 * kiriVec2_Length(way) / grid->side) + 1;
    for (int32_t k = 1; k <= parts && cell != KIRI_NONE; ++k) {
        kiriVec2 at = kiriVec2_AddScaled(end->at, (double)k / parts, way);
        int32_t next = kiriGrid_CellAt(grid, kiriMesh_Snap(grid->mesh, at));
        cell =
            next != KIRI_NONE && (cell == next || kiriGrid_HasStep(grid, cell, next, KIRI_DIAGONAL)) ? next : KIRI_NONE;
    }
    return (kiriSite){ kiriVec2_Add(end->at, way), cell };
}

/* Adds two sites, `reach` to each side of a slit end; false where other sites or the outline are too near. */
static bool TryPair(kiriSites* sites, const kiriGrid* grid, const kiriSlitEnd* end, double reach)
{
    kiriSite pair[2];
    KIRI_TIMES(k, 2) {
        pair[k] = kiriSlit_SiteBeside(grid, end, k == 0 ? reach : -reach);
        KIRI_EACH_WHILE(pair[k].cell != KIRI_NONE, const kiriSite, site, *sites) {
            if (site->cell == pair[k].cell || SquaredDistance(pair[k].at, site->at) < reach * reach) {
                return false;
            }
        }
    }
    if (pair[0].cell == KIRI_NONE || pair[1].cell == KIRI_NONE || pair[0].cell == pair[1].cell) {
        return false;
    }
    KIRI_ASSERT(sites->count + 2 <= sites->capacity);
    KIRI_NEXT(*sites) = pair[0];
    KIRI_NEXT(*sites) = pair[1];
    return true;
}

bool kiriSlits_AddPairs(kiriSites* sites, const kiriGrid* grid, const kiriSlitEnds* ends, double spacing, int32_t most)
{
    if (!kiriArray_Reserve(grid->mesh->memory, sites, most)) {
        return false;
    }
    KIRI_EACH_WHILE(sites->count + 2 <= most, const kiriSlitEnd, slit, *ends) {
        /* Half the spacing to both sides, or less, but no less than a square. */
        double reach = kiriMax(0.5 * spacing, grid->side);
        while (!TryPair(sites, grid, slit, reach) && reach > grid->side) {
            reach = kiriMax(0.5 * reach, grid->side);
        }
    }
    return true;
}

/* ---- The part ---------------------------------------------------------------------------------------------------- */

static kiriPlacerWork* PlacerWorkOf(kiriPlacer* placer, const kiriGrid* grid)
{
    if (placer->work == NULL) {
        placer->work = kiriMemory_AllocZeroed(grid->mesh->memory, sizeof(kiriPlacerWork));
    }
    return placer->work;
}

static bool TakeCell(kiriPlacer* placer, const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT_HAS(placer->work->marks, cell);
    uint8_t* mark = &placer->work->marks.data[cell];
    if (!*mark && !kiriArray_Push(grid->mesh->memory, &placer->cells, cell)) {
        return false;
    }
    *mark = 1;
    return true;
}

static void ClearTakenMarks(kiriPlacer* placer)
{
    KIRI_EACH_LISTED_WHILE(placer->work->isTaking, cell, placer->cells) {
        placer->work->marks.data[cell] = 0;
    }
    placer->work->isTaking = false;
}

bool kiriPlacer_StartPiece(kiriPlacer* placer, const kiriGrid* grid, int32_t cell)
{
    kiriPlacerWork* work = PlacerWorkOf(placer, grid);
    if (work == NULL || !kiriArray_Reserve(grid->mesh->memory, &work->marks, grid->cells.count)) {
        return false;
    }
    ClearTakenMarks(placer); /* after a piece that was given up */
    kiriArray_Extend(&work->marks, grid->cells.count, 0);
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    placer->cells.count = work->cursor = 0;
    work->isTaking = true;
    return TakeCell(placer, grid, cell);
}

/* Brings the cells, which are marked, into their order. Where they fill a good part of the squares from the first to
   the last, it is cheaper to visit all squares there than to sort. */
static void OrderPiece(kiriPlacer* placer, const kiriGrid* grid)
{
    int32_t count = placer->cells.count, first = INT32_MAX, last = 0, *cells = placer->cells.data;
    KIRI_TIMES(k, count) {
        int32_t square = grid->cells.data[cells[k]].square;
        first = kiriMin(square, first);
        last = kiriMax(square, last);
    }
    if (last - first > 8 * (int64_t)count) {
        kiriGrid_SortCells(grid, cells, count);
        return;
    }
    for (int32_t square = first; square <= last; ++square) {
        KIRI_EACH_CELL(c, grid, square) {
            if (placer->work->marks.data[c]) {
                *cells++ = c;
            }
        }
    }
    KIRI_ASSERT(cells == placer->cells.data + count);
}

/* Breadth first over straight steps: there is one for every two cells that share a face. */
kiriProgress kiriPlacer_GoOnWithPiece(kiriPlacer* placer, const kiriGrid* grid, kiriQuota* quota)
{
    enum { CELLS_AN_ITEM = 3 }; /* to gather, order and mark */
    if (!placer->work->isTaking) {
        return KIRI_DONE;
    }
    for (int32_t* k = &placer->work->cursor; *k < placer->cells.count; ++*k) {
        if (*k % CELLS_AN_ITEM == 0 && !kiriQuota_Take(quota, 1)) {
            return KIRI_MORE;
        }
        KIRI_EACH_STEP(step, grid, placer->cells.data[*k], KIRI_STRAIGHT) {
            if (!TakeCell(placer, grid, step.cell)) {
                return KIRI_FAILED;
            }
        }
    }
    OrderPiece(placer, grid);
    ClearTakenMarks(placer);
    return KIRI_DONE;
}

bool kiriPlacer_TakePiece(kiriPlacer* placer, const kiriGrid* grid, int32_t cell)
{
    kiriQuota unlimited = { INT64_MAX, 0, 0, false };
    return kiriPlacer_StartPiece(placer, grid, cell) && kiriPlacer_GoOnWithPiece(placer, grid, &unlimited) == KIRI_DONE;
}

/* ---- Placing (section 5) -----------------------------------------------------------------------------------------

   The result, whatever the order of work:

   A site sends its seeds to the cells around (kiriSite_Seed), but to none that holds another site. A cell belongs to
   the site that is nearest from there by the steps of the grid, of two as near to the lower index; but the cell of a
   site is its own. So no region is ever empty, and no two sites come to share a cell. Old sites take no notice of new
   ones, nor, in sampling, new sites of later ones.

   Sampling: the next site goes to the free cell that is farthest from all sites. Relaxation (Lloyd 1982): each new site
   goes to the centroid of its region, all at once, up to 20 times; then it takes the cell that it has come to.

   Work is shared between rounds: distances to the old sites are flooded once, those to the new sites only as far as
   they are nearer. */

enum { CELL_FREE = KIRI_NONE, CELL_BARRED = -2 };
enum { CLOSENESS = 16, AREA_UNITS = 1 << 24, SAMPLE_CELLS = 512 /* a block: neighbours in the order of cells */ };

typedef struct PlacerJob {
    kiriPlacer* placer;
    kiriPlacerWork* work;
    const kiriGrid* grid;
    kiriQuota* quota;
} PlacerJob;

/* Returns the site that a frame takes in a cell. In a full cell it is the middle, where the cell's weight is exactly 1.
   In other cells the middle may not be material. */
static kiriSite SiteInCell(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell));
    bool full = kiriGrid_Area(grid, cell) > 0.999 * grid->side * grid->side;
    kiriMoments material = kiriGrid_Material(grid, cell);
    return (kiriSite){ full ? kiriGrid_Middle(grid, cell) : kiriMoments_Center(&material), cell };
}

static bool IsMostlyCovered(const kiriGrid* grid, int32_t cell)
{
    return kiriGrid_Area(grid, cell) > 0.5 * grid->side * grid->side;
}

static int32_t OldDistance(const kiriPlacerWork* work, int32_t cell)
{
    return work->hasOld ? work->old->distance.data[cell] : KIRI_FAR;
}

/* Starts a flood from sites of the part. */
static bool StartFlood(PlacerJob* job, kiriField* field, int32_t first, int32_t end)
{
    kiriField_Reset(field);
    return kiriSites_StartFlood(field, &job->work->seeds, job->grid, job->placer->sites.data, first, end,
                                job->work->holds.data);
}

/* Returns true where no old site is as near as a new one, nor, in sampling, another new one. */
static bool IsNearest(const void* context, int32_t cell)
{
    const kiriPlacerWork* work = context;
    int32_t distance = work->fresh.distance.data[cell];
    return distance < OldDistance(work, cell) && (work->stage != FLOOD_NEW || distance < work->sampled.data[cell]);
}

static kiriProgress Flood(PlacerJob* job, kiriField* field, kiriPassFn* pass)
{
    kiriRule rule = { job->grid, KIRI_FAR - 1, pass, NULL, job->work, NULL };
    return kiriField_Flood(field, &rule, job->quota);
}

/* Visits cells of a list, from the cursor on. */
static kiriProgress VisitCells(PlacerJob* job, const kiriIndices* cells, void visit(PlacerJob* job, int32_t cell))
{
    enum { VISITS_AN_ITEM = 4 };
    int32_t from = job->work->cursor, end = cells->count;
    int64_t items = (end - from + VISITS_AN_ITEM - 1) / VISITS_AN_ITEM;
    if (items > job->quota->left) {
        items = job->quota->left;
        end = from + VISITS_AN_ITEM * (int32_t)items;
    }
    kiriQuota_Take(job->quota, items);
    KIRI_FROM_TO(i, from, end) {
        visit(job, cells->data[i]);
    }
    job->work->cursor = end < cells->count ? end : 0;
    return end < cells->count ? KIRI_MORE : KIRI_DONE;
}

/* Returns how much closer sites are to be at a cell, times CLOSENESS. */
static int64_t ClosenessAt(const kiriPlacerWork* work, int32_t cell)
{
    if (work->reach == 0) {
        return CLOSENESS;
    }
    int64_t distance = work->ends.distance.data[cell], most = work->closest;
    int64_t closeness = distance > 0 ? work->reach / distance : most;
    return closeness < CLOSENESS ? CLOSENESS : kiriMin(closeness, most);
}

/* ---- Sampling ---------------------------------------------------------------------------------------------------- */

/* Finds the farthest free cell of a block, and returns the items for it. In a part without a site all cells are equally
   far, and the first one is taken: relaxation moves the site on. */
static int32_t LookAtBlock(PlacerJob* job, SampleBlock* block)
{
    enum { LOOKS_AN_ITEM = 16 };
    const kiriPlacer* placer = job->placer;
    int32_t first = (int32_t)(block - job->work->blocks.data) * SAMPLE_CELLS, left = placer->cells.count - first;
    int32_t end = first + kiriMin(left, SAMPLE_CELLS);
    *block = (SampleBlock){ -1, KIRI_NONE, placer->sites.count, false };
    KIRI_FROM_TO(i, first, end) {
        int32_t cell = placer->cells.data[i];
        if (job->work->holds.data[cell] == CELL_FREE) {
            int64_t old = OldDistance(job->work, cell), sampled = job->work->sampled.data[cell];
            int64_t distance = kiriMin(old, sampled) * ClosenessAt(job->work, cell);
            bool isCovered = distance >= block->distance && IsMostlyCovered(job->grid, cell);
            if (distance > block->distance || (distance == block->distance && isCovered && !block->isCovered)) {
                *block = (SampleBlock){ distance, cell, placer->sites.count, isCovered };
            }
        }
    }
    return 1 + (end - first) / LOOKS_AN_ITEM;
}

/* Returns the block that may have the farthest cell; of equals the first. */
static SampleBlock* FarthestBlock(const kiriPlacerWork* work)
{
    SampleBlock* best = work->blocks.data;
    KIRI_FROM_TO(b, 1, work->blocks.count) {
        SampleBlock* block = &work->blocks.data[b];
        if (block->distance > best->distance ||
            (block->distance == best->distance && block->isCovered && !best->isCovered)) {
            best = block;
        }
    }
    return best;
}

/* All new sites have a place: relaxation starts, or goes on. */
static kiriProgress StartRound(PlacerJob* job)
{
    int32_t first = job->placer->oldCount, end = job->placer->sites.count;
    KIRI_TIMES(k, end - first) {
        job->work->targets.data[k] = (SiteTarget){ .cell = KIRI_NONE };
    }
    job->work->stage = FLOOD_ALL_NEW;
    return StartFlood(job, &job->work->fresh, first, end) ? KIRI_DONE : KIRI_FAILED;
}

/* Looks at blocks until the one that may have the farthest cell has it, and puts a site there. */
static kiriProgress SampleFarthest(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    kiriSites* sites = &job->placer->sites;
    SampleBlock* best = FarthestBlock(work);
    for (; best->seen != sites->count; best = FarthestBlock(work)) {
        if (!kiriQuota_Pay(job->quota, &work->due)) {
            return KIRI_MORE;
        }
        work->due = LookAtBlock(job, best);
    }
    if (!kiriQuota_Pay(job->quota, &work->due)) {
        return KIRI_MORE;
    }
    work->left = best->cell == KIRI_NONE ? 0 : work->left - 1;
    if (best->cell != KIRI_NONE) {
        work->holds.data[best->cell] = sites->count;
        KIRI_NEXT(*sites) = SiteInCell(job->grid, best->cell); /* Start made room */
    }
    if (work->left == 0) {
        return StartRound(job);
    }
    work->stage = FLOOD_NEW;
    return StartFlood(job, &work->fresh, sites->count - 1, sites->count) ? KIRI_DONE : KIRI_FAILED;
}

static void LowerCell(PlacerJob* job, int32_t cell)
{
    int32_t* sampled = &job->work->sampled.data[cell];
    *sampled = kiriMin(job->work->fresh.distance.data[cell], *sampled);
}

/* ---- Relaxation: new sites go to the centroids of their regions, one site alone to the centroid of its part ------ */

/* Returns the target of the new site that a cell belongs to; null where it belongs to an old one. */
static SiteTarget* TargetOf(PlacerJob* job, int32_t cell)
{
    kiriPlacerWork* work = job->work;
    int32_t owner = work->holds.data[cell], old = job->placer->oldCount;
    if (work->stage == SUM_PART || work->stage == AIM_PART) {
        return work->targets.data;
    }
    if (owner < 0) {
        owner = work->fresh.distance.data[cell] < OldDistance(work, cell) ? work->fresh.owner.data[cell] : 0;
    }
    KIRI_ASSERT(owner - old < work->targets.count);
    return owner < old ? NULL : &work->targets.data[owner - old];
}

/* Adds a moment in units, unless it is too large: untrusted bytes may say so. */
static int64_t Plus(int64_t sum, double moment)
{
    const double most = 4611686018427387904.0; /* 2^62 */
    bool fits = moment > -most && moment < most && sum > -(INT64_C(1) << 62) && sum < INT64_C(1) << 62;
    return fits ? sum + (int64_t)(moment + 0.5) : sum;
}

/* Every cell counts for something, so that every region has a center. A density of the fourth power of the closeness
   makes a centroidal Voronoi diagram as much closer (Du, Faber, Gunzburger 1999). */
static void SumCell(PlacerJob* job, int32_t cell)
{
    SiteTarget* target = TargetOf(job, cell);
    if (target != NULL) {
        const kiriMoments material = kiriGrid_Material(job->grid, cell);
        double side = job->grid->side;
        int64_t area = (int64_t)(AREA_UNITS * (material.area / (side * side)) + 0.5);
        int64_t squared = ClosenessAt(job->work, cell) * ClosenessAt(job->work, cell);
        area = kiriMax(area, 1) * (squared * squared / ((int64_t)CLOSENESS * CLOSENESS * CLOSENESS * CLOSENESS));
        double scale = (double)area / (material.area * side);
        target->area += area;
        target->u = Plus(target->u, scale * material.u);
        target->v = Plus(target->v, scale * material.v);
    }
}

/* Takes a cell as a target's if it is nearer to the center, or as near and better. Cells come in any order. */
static void Consider(const PlacerJob* job, SiteTarget* target, int32_t cell)
{
    double distance = SquaredDistance(kiriGrid_Middle(job->grid, cell), target->center);
    bool isBetter = target->cell == KIRI_NONE || distance < target->distance;
    if (target->cell != KIRI_NONE && distance == target->distance) {
        bool mostly = IsMostlyCovered(job->grid, cell);
        isBetter = mostly != IsMostlyCovered(job->grid, target->cell)
                       ? mostly
                       : kiriGrid_IsBefore(job->grid, cell, target->cell);
    }
    if (isBetter) {
        target->cell = cell;
        target->distance = distance;
    }
}

static void AimCell(PlacerJob* job, int32_t cell)
{
    SiteTarget* target = TargetOf(job, cell);
    bool isFree = job->work->stage != AIM_PART || job->work->holds.data[cell] == CELL_FREE;
    if (target != NULL && !target->isFound && isFree) {
        Consider(job, target, cell);
    }
}

/* Looks in the square of each target's center, and in the squares around: middles of all others are at least one and a
   half sides away. Most regions hold their centroid. */
static kiriProgress AimNearCenters(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    const kiriSquares* squares = &job->grid->mesh->squares;
    for (; work->cursor < job->placer->sites.count - job->placer->oldCount; ++work->cursor) {
        SiteTarget* target = &work->targets.data[work->cursor];
        if (!kiriQuota_Take(job->quota, 1)) {
            return KIRI_MORE;
        }
        int32_t square =
            target->isFound ? KIRI_NONE : kiriSquares_At(squares, kiriMesh_Snap(job->grid->mesh, target->center));
        KIRI_TIMES_WHILE(square != KIRI_NONE, k, 9) {
            int32_t u = square % squares->columns + k % 3 - 1, v = square / squares->columns + k / 3 - 1;
            bool isSquare = u >= 0 && u < squares->columns && v >= 0 && v < squares->rows;
            int32_t c = isSquare ? job->grid->squareCell.data[v * squares->columns + u] : KIRI_NONE;
            for (; c != KIRI_NONE; c = job->grid->cells.data[c].next) {
                if (work->fresh.distance.data[c] != KIRI_FAR && TargetOf(job, c) == target) {
                    Consider(job, target, c);
                }
            }
        }
        double near = 2.0 * job->grid->side * job->grid->side;
        target->isFound = target->isFound || (target->cell != KIRI_NONE && target->distance < near);
        work->lost += !target->isFound;
    }
    work->cursor = 0;
    return KIRI_DONE;
}

/* Moves all new sites to their targets: to the centroid itself if it lies in the square of the target cell, because a
   site that moves only between middles of cells would get stuck if its centroid is less than half a side away. Returns
   true if a site moved by more than a hundredth of a side. */
static bool MoveToTargets(PlacerJob* job)
{
    kiriPlacer* placer = job->placer;
    double half = 0.5 * job->grid->side;
    bool moved = false;
    KIRI_FROM_TO(i, placer->oldCount, placer->sites.count) {
        job->work->holds.data[placer->sites.data[i].cell] = CELL_FREE;
    }
    KIRI_FROM_TO(i, placer->oldCount, placer->sites.count) {
        const SiteTarget* target = &job->work->targets.data[i - placer->oldCount];
        kiriSite site = placer->sites.data[i];
        if (target->cell != KIRI_NONE) {
            kiriVec2 off = kiriVec2_Sub(target->center, kiriGrid_Middle(job->grid, target->cell));
            site = SiteInCell(job->grid, target->cell);
            site.at = fabs(off.x) < half && fabs(off.y) < half ? target->center : site.at;
        }
        moved =
            moved || SquaredDistance(site.at, placer->sites.data[i].at) > 0.0001 * job->grid->side * job->grid->side;
        placer->sites.data[i] = site;
        KIRI_ASSERT(job->work->holds.data[site.cell] < 0); /* two sites in a cell */
        job->work->holds.data[site.cell] = i;
    }
    return moved;
}

static kiriProgress EndRound(PlacerJob* job)
{
    enum { MOST_ROUNDS = 20 };
    kiriSites* sites = &job->placer->sites;
    if (MoveToTargets(job) && ++job->work->round < MOST_ROUNDS) {
        return StartRound(job);
    }
    KIRI_FROM_TO(i, job->placer->oldCount, sites->count) {
        sites->data[i] = SiteInCell(job->grid, sites->data[i].cell);
    }
    job->work->stage = PLACER_RESTS;
    return KIRI_DONE;
}

/* ---- Rows in a rectangle ----------------------------------------------------------------------------------------- */

bool kiriPlacer_PlaceRows(kiriPlacer* placer, const kiriGrid* grid, int32_t count, int32_t most)
{
    kiriMoments sum = { 0 };
    KIRI_ASSERT(placer->work != NULL && count > 0 && count <= most);
    KIRI_EACH_LISTED(at, placer->cells) {
        const kiriMoments material = kiriGrid_Material(grid, at);
        kiriMoments_Add(&sum, &material);
    }
    const kiriVec2 center = kiriMoments_Center(&sum);
    const kiriMoments about = kiriMoments_About(&sum, center);
    const double size[2] = { sqrt(12.0 * about.uu / sum.area), sqrt(12.0 * about.vv / sum.area) };
    placer->sites.count = 0;
    if (!(fabs(size[0] * size[1] - sum.area) < 1e-4 * sum.area)) {
        return true; /* no rectangle */
    }
    const int along = size[1] > 1.001 * size[0]; /* rows run along the longer side */
    int32_t rows = (int32_t)(sqrt(count * size[1 - along] / size[along]) + 0.5);
    rows = kiriMax(rows, 1);
    count = kiriMin((count + rows - 1) / rows * rows, most);
    if (!kiriArray_Reserve(grid->mesh->memory, &placer->sites, count)) {
        return false;
    }
    KIRI_EACH_LISTED(at, placer->cells) {
        placer->work->marks.data[at] = 1; /* no site yet */
    }
    bool ok = true;
    KIRI_TIMES_WHILE(ok, row, rows) {
        int32_t first = (int32_t)(((int64_t)count * row + rows / 2) / rows);
        int32_t end = (int32_t)(((int64_t)count * (row + 1) + rows / 2) / rows);
        KIRI_ASSERT(first < end && end <= count);
        double step = size[along] / (end - first), width = size[1 - along] * (end - first) / count;
        ok = (step >= grid->side || end - first == 1) && (width >= grid->side || rows == 1);
        KIRI_FROM_TO_WHILE(ok, k, first, end) {
            double u = (k - first + 0.5) * step - 0.5 * size[along];
            double v = (0.5 * (first + end) / count - 0.5) * size[1 - along];
            kiriVec2 at = kiriVec2_Add(center, along == 0 ? kiriVec2_Make(u, v) : kiriVec2_Make(v, u));
            int32_t cell = kiriGrid_CellAt(grid, kiriMesh_Snap(grid->mesh, at));
            ok = cell != KIRI_NONE && placer->work->marks.data[cell];
            if (ok) {
                placer->work->marks.data[cell] = 0;
                KIRI_NEXT(placer->sites) = (kiriSite){ at, cell };
            }
        }
    }
    placer->sites.count = ok ? placer->sites.count : 0;
    KIRI_EACH_LISTED(at, placer->cells) {
        placer->work->marks.data[at] = 0;
    }
    return true;
}

/* ---- The job ----------------------------------------------------------------------------------------------------- */

/* Goes on to the next stage where this one is done. */
static kiriProgress Next(PlacerJob* job, kiriProgress progress, PlacerStage next)
{
    if (progress == KIRI_DONE) {
        job->work->stage = next;
    }
    return progress;
}

static kiriProgress RunStage(PlacerJob* job)
{
    kiriPlacerWork* work = job->work;
    kiriSites* sites = &job->placer->sites;
    const kiriIndices* settled = &work->fresh.settled;
    const kiriIndices* part = &job->placer->cells;
    kiriProgress progress = KIRI_DONE;
    switch (work->stage) {
    case FLOOD_ENDS:
        return Next(job, work->reach > 0 ? Flood(job, &work->ends, NULL) : KIRI_DONE, FLOOD_OLD);
    case FLOOD_OLD:
        return Next(job, work->old == &work->flooded ? Flood(job, &work->flooded, NULL) : KIRI_DONE, SAMPLE);
    case SAMPLE:
        return SampleFarthest(job);
    case FLOOD_NEW:
        return Next(job, Flood(job, &work->fresh, IsNearest), LOWER);
    case LOWER:
        return Next(job, VisitCells(job, settled, LowerCell), SAMPLE);
    case FLOOD_ALL_NEW:
        return Next(job, Flood(job, &work->fresh, IsNearest), SUM);
    case SUM:
    case SUM_PART:
        progress = VisitCells(job, work->stage == SUM ? settled : part, SumCell);
        if (progress == KIRI_DONE) {
            KIRI_TIMES(k, kiriMax(job->placer->sites.count - job->placer->oldCount, 1)) {
                SiteTarget* target = &work->targets.data[k];
                double scale = job->grid->side / (double)kiriMax(target->area, 1);
                target->center = kiriVec2_Make(scale * (double)target->u, scale * (double)target->v);
                target->isFound = target->area <= 0; /* untrusted bytes may leave a region empty: its site stays */
            }
            work->lost = 0;
        }
        return Next(job, progress, work->stage == SUM ? AIM_NEAR : AIM_PART);
    case AIM_NEAR:
        return Next(job, AimNearCenters(job), AIM);
    case AIM:
        progress = work->lost > 0 ? VisitCells(job, settled, AimCell) : KIRI_DONE;
        return progress == KIRI_DONE ? EndRound(job) : progress;
    case AIM_PART:
        progress = VisitCells(job, part, AimCell);
        if (progress == KIRI_DONE && work->targets.data[0].cell != KIRI_NONE) {
            KIRI_NEXT(*sites) = SiteInCell(job->grid, work->targets.data[0].cell);
        }
        return Next(job, progress, PLACER_RESTS);
    default:
        KIRI_ASSERT(false);
        return KIRI_FAILED;
    }
}

kiriProgress kiriPlacer_Run(kiriPlacer* placer, const kiriGrid* grid, kiriQuota* quota)
{
    PlacerJob job = { placer, placer->work, grid, quota };
    kiriProgress progress = KIRI_DONE;
    while (progress == KIRI_DONE && job.work != NULL && job.work->stage != PLACER_RESTS) {
        progress = RunStage(&job);
    }
    return progress;
}

/* Starts the field from the slit ends, where it is wanted and sites are to be closer there. */
static bool StartEnds(kiriPlacer* placer, const kiriGrid* grid, bool isWanted)
{
    kiriPlacerWork* work = placer->work;
    double reach = placer->reach / grid->side, most = 4.0 * (grid->cells.count + 1.0);
    placer->reach = 0.0;
    work->reach = 0;
    if (!(reach > 0.0) || placer->ends.count == 0 || !isWanted) {
        return true;
    }
    work->reach = (int64_t)(CLOSENESS * KIRI_UNIT * kiriMin(reach, most));
    work->closest = (int32_t)(CLOSENESS * placer->closeness + 0.5);
    work->seeds.count = 0;
    KIRI_EACH(const kiriSlitEnd, end, placer->ends) {
        kiriSeed seed = { end->cell, 0, 0 };
        if (!kiriArray_Push(grid->mesh->memory, &work->seeds, seed)) {
            return false;
        }
    }
    if (!kiriField_Resize(&work->ends, grid->mesh->memory, grid->cells.count, 0)) {
        return false;
    }
    kiriField_Reset(&work->ends);
    return kiriField_Start(&work->ends, grid->mesh->memory, work->seeds.data, work->seeds.count);
}

bool kiriPlacer_Start(kiriPlacer* placer, const kiriGrid* grid, const uint8_t* allowed, int32_t count)
{
    kiriPlacerWork* work = PlacerWorkOf(placer, grid);
    const kiriField* known = placer->known;
    kiriMemory* memory = grid->mesh->memory;
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
    int32_t cells = grid->cells.count; /* room for all but seeds */
    if ((work->old == &work->flooded && !kiriField_Resize(&work->flooded, memory, cells, 0)) ||
        !kiriField_Resize(&work->fresh, memory, cells, KIRI_FIELD_OWNERS) ||
        !kiriArrays_Resize(memory, cells, &work->sampled, &work->holds) ||
        !kiriArray_Resize(memory, &work->blocks, placer->cells.count / SAMPLE_CELLS + 1) ||
        !kiriArray_Resize(memory, &work->targets, kiriMax(count, 1)) ||
        !kiriArray_ReserveMore(memory, &placer->sites, count)) {
        return false;
    }
    /* Only cells of the part are ever read from `sampled` and `holds`: floods do not leave it. */
    KIRI_EACH_LISTED(cell, placer->cells) {
        work->sampled.data[cell] = KIRI_FAR;
        work->holds.data[cell] = allowed == NULL || allowed[cell] ? CELL_FREE : CELL_BARRED;
    }
    KIRI_EACH_INDEX(i, placer->sites) {
        int32_t* holds = &work->holds.data[placer->sites.data[i].cell];
        KIRI_ASSERT(*holds < 0); /* two sites in a cell */
        *holds = i;
    }
    KIRI_EACH(SampleBlock, block, work->blocks) {
        *block = (SampleBlock){ INT64_MAX, KIRI_NONE, -1, true };
    }
    work->targets.data[0] = (SiteTarget){ .cell = KIRI_NONE };
    work->cursor = work->round = 0;
    work->left = count;
    work->due = 0;
    PlacerStage first = count == 0 ? PLACER_RESTS : count == 1 && placer->oldCount == 0 ? SUM_PART : FLOOD_ENDS;
    PlacerJob job = { placer, work, grid, NULL };
    if ((work->old == &work->flooded && !StartFlood(&job, &work->flooded, 0, placer->oldCount)) ||
        !StartEnds(placer, grid, first == FLOOD_ENDS)) {
        return false;
    }
    work->stage = first;
    return true;
}
