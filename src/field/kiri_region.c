#include "kiri_region.h"

/* ---- Seeds ------------------------------------------------------------------------------------------------------- */

/* A site of bytes that were made up may be anywhere: ways go on from there. */
static int32_t GridLength(double meters, double side)
{
    const double most = 0.5 * (KIRI_FAR - 1);
    double length = KIRI_UNIT * (meters / side) + 0.5;
    return (int32_t)kiriMin(length, most);
}

static double WayTo(const kiriSite* site, const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell)
{
    return kiriVec2_Length(kiriVec2_Sub(kiriGrid_Middle(grid, mesh, cell), site->at));
}

static bool IsAtMiddle(const kiriSite* site, const kiriGrid* grid, const kiriMeshData* mesh)
{
    return WayTo(site, grid, mesh, site->cell) <= 0.01 * grid->side;
}

/* In the site's own cell, or one step away from it. */
static kiriSeed SeedNear(const kiriSite* site, int32_t owner, const kiriGrid* grid, const kiriMeshData* mesh,
                         int32_t cell)
{
    kiriSeed seed = { cell, GridLength(WayTo(site, grid, mesh, cell), grid->side), owner };
    if (IsAtMiddle(site, grid, mesh)) {
        seed.distance = cell == site->cell ? 0 : KIRI_FAR;
    }
    return seed;
}

bool kiriSite_Seed(const kiriSite* site, int32_t owner, kiriMemory* memory, const kiriGrid* grid,
                   const kiriMeshData* mesh, kiriSeeds* seeds)
{
    kiriSeed own = SeedNear(site, owner, grid, mesh, site->cell);
    kiriSteps steps;
    if (!kiriArray_Push(memory, seeds, own)) {
        return false;
    }
    kiriGrid_GetSteps(grid, site->cell, &steps);
    int32_t end = IsAtMiddle(site, grid, mesh) ? 0 : steps.end[KIRI_STEP_LENGTHS - 1];
    for (int32_t s = 0; s < end; ++s) {
        kiriSeed seed = SeedNear(site, owner, grid, mesh, steps.data[s].cell);
        if (!kiriArray_Push(memory, seeds, seed)) {
            return false;
        }
    }
    return true;
}

/* May a step lead from one square to the other? */
static bool AreNear(const kiriGrid* grid, const kiriMeshData* mesh, int32_t a, int32_t b)
{
    KIRI_ASSERT(a >= 0 && a < grid->cells.count);
    KIRI_ASSERT(b >= 0 && b < grid->cells.count);
    int32_t columns = mesh->squares.columns, apart = grid->cells.data[a].square - grid->cells.data[b].square;
    apart = (apart < 0 ? -apart : apart) + 2;
    return apart <= 4 || (apart >= columns && apart <= columns + 4) ||
           (apart >= 2 * columns && apart <= 2 * columns + 4);
}

kiriSeed kiriSite_SeedAt(const kiriSite* site, int32_t owner, const kiriGrid* grid, const kiriMeshData* mesh,
                         int32_t cell)
{
    kiriSeed none = { cell, KIRI_FAR, KIRI_NONE };
    kiriSteps steps;
    if (!AreNear(grid, mesh, cell, site->cell)) {
        return none;
    }
    kiriGrid_GetSteps(grid, cell, &steps);
    bool near = cell == site->cell;
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1] && !near; ++s) {
        near = steps.data[s].cell == site->cell;
    }
    return near ? SeedNear(site, owner, grid, mesh, cell) : none;
}

/* ---- An update --------------------------------------------------------------------------------------------------- */

typedef struct RegionUpdate {
    kiriRegions* regions;
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const kiriSite* sites;
    int32_t siteCount;
    const kiriSiteMove* moves;
    int32_t moveCount;
    double extent; /* of the tallies */
} RegionUpdate;

/* The nearest seed of a cell. One that holds a site takes only that site's. So no region is ever empty: a site is
   within half a diagonal of its cell's middle, and every way into that cell is at least a side long. */
static kiriSeed NearestSiteSeed(const void* context, int32_t cell)
{
    const RegionUpdate* u = context;
    const int32_t* siteAt = u->regions->siteAt.data;
    kiriSeed best = { cell, KIRI_FAR, KIRI_NONE };
    if (siteAt[cell] != KIRI_NONE) {
        return SeedNear(&u->sites[siteAt[cell]], siteAt[cell], u->grid, u->mesh, cell);
    }
    kiriSteps steps;
    kiriGrid_GetSteps(u->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t owner = siteAt[steps.data[s].cell];
        if (owner != KIRI_NONE) {
            kiriSeed seed = SeedNear(&u->sites[owner], owner, u->grid, u->mesh, cell);
            bool nearer = seed.distance < best.distance || (seed.distance == best.distance && owner < best.owner);
            best = nearer && seed.distance != KIRI_FAR ? seed : best;
        }
    }
    return best;
}

static void MarkRegionDirty(kiriRegions* regions, int32_t frame)
{
    if (frame != KIRI_NONE) {
        regions->dirty.data[frame] = 1;
    }
}

/* Adds material to a region (sign 1), or takes it away (sign -1). */
static void AddToRegion(const RegionUpdate* u, int32_t frame, kiriMoments material, int sign)
{
    if (frame != KIRI_NONE) {
        kiriTally_Add(&u->regions->material.data[frame], &material, sign, u->extent);
        u->regions->dirty.data[frame] = 1;
    }
}

static kiriMoments MaterialOf(const RegionUpdate* u, int32_t cell)
{
    return kiriGrid_Material(u->grid, u->mesh, cell);
}

/* Room for all cells and frames. */
static bool MakeRegionRoom(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    int32_t cell = r->siteAt.count, frame = r->material.count, cellCount = u->grid->cells.count;
    if (!kiriField_Resize(&r->field, u->memory, cellCount) || !kiriArray_Resize(u->memory, &r->siteAt, cellCount) ||
        !kiriArray_Resize(u->memory, &r->onBorder, cellCount) ||
        !kiriBorderCells_Resize(&r->border, u->memory, cellCount, u->siteCount) ||
        !kiriArray_Resize(u->memory, &r->isChanged, cellCount) ||
        !kiriArray_Resize(u->memory, &r->material, u->siteCount) ||
        !kiriArray_Resize(u->memory, &r->dirty, u->siteCount)) {
        return false;
    }
    for (; cell < cellCount; ++cell) {
        r->siteAt.data[cell] = KIRI_NONE;
        r->onBorder.data[cell] = r->isChanged.data[cell] = 0;
    }
    for (; frame < u->siteCount; ++frame) {
        r->material.data[frame] = (kiriTally){ { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 }, { 0, 0 } };
        r->dirty.data[frame] = 0;
    }
    return true;
}

/* With the owner that it has. */
static void SetBorder(kiriRegions* regions, int32_t cell, bool isBorder)
{
    KIRI_ASSERT(cell >= 0 && cell < regions->onBorder.count);
    regions->onBorder.data[cell] = isBorder;
    kiriBorderCells_Put(&regions->border, cell, isBorder ? regions->field.owner.data[cell] : KIRI_NONE);
}

/* ---- What has changed ------------------------------------------------------------------------------------------ */

static void MarkDirtyAround(const RegionUpdate* u, int32_t cell)
{
    kiriSteps steps;
    if (kiriGrid_IsCell(u->grid, cell)) {
        kiriGrid_GetSteps(u->grid, cell, &steps);
        kiriField_MarkStepsDirty(&u->regions->field, cell);
        for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
            kiriField_MarkStepsDirty(&u->regions->field, steps.data[s].cell);
        }
    }
}

/* False where two sites come to one cell, of bytes that were made up. */
static bool MoveSites(const RegionUpdate* u)
{
    int32_t* siteAt = u->regions->siteAt.data;
    for (int32_t k = 0; k < u->moveCount; ++k) {
        kiriSiteMove move = u->moves[k];
        if (!u->regions->flooding && move.was != KIRI_NONE && siteAt[move.was] == move.frame) {
            siteAt[move.was] = KIRI_NONE;
        }
    }
    for (int32_t k = 0; k < u->moveCount; ++k) {
        int32_t frame = u->moves[k].frame;
        KIRI_ASSERT(frame >= 0 && frame < u->siteCount && kiriGrid_IsCell(u->grid, u->sites[frame].cell));
        int32_t* at = &siteAt[u->sites[frame].cell];
        if (*at != KIRI_NONE && *at != frame) {
            return false;
        }
        *at = frame;
        MarkRegionDirty(u->regions, frame);
    }
    return true;
}

/* What the grid has changed since the last update. */
static void FollowGrid(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    const kiriGridChanges* changes = &u->grid->changes;
    for (int32_t k = r->seen.gone; k < changes->gone.count; ++k) {
        int32_t cell = changes->gone.data[k];
        AddToRegion(u, r->field.owner.data[cell], MaterialOf(u, cell), -1);
        kiriField_Forget(&r->field, cell);
        r->siteAt.data[cell] = KIRI_NONE;
        SetBorder(r, cell, false);
    }
    for (int32_t k = r->seen.material; k < changes->material.count; ++k) {
        const kiriMaterialChange* change = &changes->material.data[k];
        int32_t owner = r->field.owner.data[change->cell];
        AddToRegion(u, owner, change->was, -1);
        AddToRegion(u, owner, MaterialOf(u, change->cell), 1);
    }
    for (int32_t k = r->seen.steps; k < changes->steps.count; ++k) {
        int32_t cell = changes->steps.data[k];
        KIRI_ASSERT(kiriGrid_IsCell(u->grid, cell));
        MarkRegionDirty(r, r->field.owner.data[cell]);
        kiriField_MarkStepsDirty(&r->field, cell);
    }
    for (int32_t k = r->seen.edges; k < changes->edges.count; ++k) {
        MarkRegionDirty(r, r->field.owner.data[changes->edges.data[k]]);
    }
}

static bool MarkDirtyCells(const RegionUpdate* u)
{
    FollowGrid(u);
    if (!MoveSites(u)) {
        return false;
    }
    for (int32_t k = 0; k < u->moveCount; ++k) {
        if (u->moves[k].was != KIRI_NONE) {
            MarkDirtyAround(u, u->moves[k].was);
        }
        MarkDirtyAround(u, u->sites[u->moves[k].frame].cell);
    }
    return true;
}

/* From scratch: the seeds of all sites, without those in the cell of another site (see NearestSiteSeed). */
static bool StartRegionFlood(const RegionUpdate* u)
{
    kiriSeeds seeds = { 0 };
    bool ok = MoveSites(u);
    for (int32_t i = 0; ok && i < u->siteCount; ++i) {
        ok = kiriSite_Seed(&u->sites[i], i, u->memory, u->grid, u->mesh, &seeds);
    }
    int32_t kept = 0;
    for (int32_t k = 0; ok && k < seeds.count; ++k) {
        int32_t holder = u->regions->siteAt.data[seeds.data[k].cell];
        if (holder == KIRI_NONE || holder == seeds.data[k].owner) {
            seeds.data[kept++] = seeds.data[k];
        }
    }
    ok = ok && kiriField_Start(&u->regions->field, u->memory, seeds.data, kept);
    kiriArray_Release(u->memory, &seeds);
    return ok;
}

/* ---- What follows from it ---------------------------------------------------------------------------------------- */

static void FindBorder(const RegionUpdate* u, int32_t cell)
{
    kiriSteps steps;
    kiriGrid_GetSteps(u->grid, cell, &steps);
    const int32_t* owner = u->regions->field.owner.data;
    bool border = false;
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        border |= owner[steps.data[s].cell] != owner[cell];
    }
    SetBorder(u->regions, cell, border);
}

/* The cell has another owner, so its neighbours may be on a border, or no more. */
static void FindBordersAround(const RegionUpdate* u, int32_t cell)
{
    kiriSteps steps;
    kiriGrid_GetSteps(u->grid, cell, &steps);
    const int32_t* owner = u->regions->field.owner.data;
    FindBorder(u, cell);
    for (int32_t s = 0; s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
        int32_t next = steps.data[s].cell;
        if (owner[next] != owner[cell]) {
            SetBorder(u->regions, next, true);
        } else if (u->regions->onBorder.data[next]) {
            FindBorder(u, next);
        }
    }
}

/* Each cell is among the changes once, as it was before the first. */
static bool AddRegionChange(const RegionUpdate* u, kiriSeed was)
{
    if (u->regions->isChanged.data[was.cell]) {
        return true;
    }
    u->regions->isChanged.data[was.cell] = 1;
    return kiriArray_Push(u->memory, &u->regions->changes, was);
}

/* An update may undo what an earlier one did. */
static void DropUnchanged(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    int32_t kept = 0;
    for (int32_t k = 0; k < r->changes.count; ++k) {
        kiriSeed was = r->changes.data[k];
        bool same = was.distance == r->field.distance.data[was.cell] && was.owner == r->field.owner.data[was.cell];
        if (same || !kiriGrid_IsCell(u->grid, was.cell)) {
            r->isChanged.data[was.cell] = 0;
        } else {
            r->changes.data[kept++] = was;
        }
    }
    r->changes.count = kept;
}

/* What follows for region, border and changes where a cell was other than it is. */
static bool FollowChange(const RegionUpdate* u, kiriSeed was)
{
    kiriRegions* r = u->regions;
    int32_t owner = r->field.owner.data[was.cell];
    KIRI_ASSERT(owner >= KIRI_NONE && owner < u->siteCount &&
                (owner == KIRI_NONE || kiriGrid_IsCell(u->grid, was.cell)));
    if (was.distance == r->field.distance.data[was.cell] && was.owner == owner) {
        return true;
    }
    MarkRegionDirty(r, owner);
    if (was.owner != owner) {
        AddToRegion(u, was.owner, MaterialOf(u, was.cell), -1);
        AddToRegion(u, owner, MaterialOf(u, was.cell), 1);
        FindBordersAround(u, was.cell);
    }
    return AddRegionChange(u, was) && (owner != KIRI_NONE || kiriArray_Push(u->memory, &r->orphans, was.cell));
}

static void DropOrphans(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    int32_t kept = 0;
    for (int32_t k = 0; k < r->orphans.count; ++k) {
        int32_t cell = r->orphans.data[k];
        if (kiriGrid_IsCell(u->grid, cell) && r->field.owner.data[cell] == KIRI_NONE) {
            r->orphans.data[kept++] = cell;
        }
    }
    r->orphans.count = kept;
}

enum { ITEMS_OF_CHANGE = 2 };

/* What follows from all that the repair has changed. */
static kiriProgress FollowLog(const RegionUpdate* u, kiriQuota* quota)
{
    kiriRegions* r = u->regions;
    for (; r->followed < r->field.log.count; ++r->followed) {
        if (!kiriQuota_Take(quota, ITEMS_OF_CHANGE)) {
            return KIRI_MORE;
        }
        if (!FollowChange(u, r->field.log.data[r->followed])) {
            return KIRI_FAILED;
        }
    }
    return KIRI_DONE;
}

static bool FinishRepair(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    const kiriGridChanges* changes = &u->grid->changes;
    bool ok = true;
    for (int32_t k = r->seen.steps; k < changes->steps.count; ++k) {
        FindBorder(u, changes->steps.data[k]);
    }
    for (int32_t k = r->seen.made; ok && k < changes->made.count; ++k) {
        int32_t cell = changes->made.data[k];
        if (r->field.owner.data[cell] == KIRI_NONE) {
            ok = kiriArray_Push(u->memory, &r->orphans, cell);
        }
    }
    if (ok) {
        kiriGrid_SortCells(u->grid, r->orphans.data, r->orphans.count);
        DropUnchanged(u);
        r->field.log.count = 0;
    }
    return ok;
}

/* All cells, in their order. */
static bool FinishFlood(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    r->orphans.count = 0;
    for (int32_t s = 0; s < u->grid->squareCell.count; ++s) {
        for (int32_t c = u->grid->squareCell.data[s]; c != KIRI_NONE; c = u->grid->cells.data[c].next) {
            kiriSeed was = { c, KIRI_FAR, KIRI_NONE };
            int32_t owner = r->field.owner.data[c];
            KIRI_ASSERT(owner >= KIRI_NONE && owner < u->siteCount);
            AddToRegion(u, owner, MaterialOf(u, c), 1);
            FindBorder(u, c);
            if (owner == KIRI_NONE ? !kiriArray_Push(u->memory, &r->orphans, c) : !AddRegionChange(u, was)) {
                return false;
            }
        }
    }
    r->field.settled.count = 0;
    return true;
}

static bool BeginRegions(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    r->flooding = r->material.count == 0; /* no frames yet, so nothing of the field to keep */
    if (!MakeRegionRoom(u) || (r->flooding && !StartRegionFlood(u))) {
        return false;
    }
    return r->flooding || MarkDirtyCells(u);
}

static kiriProgress DivideCells(const RegionUpdate* u, kiriQuota* quota)
{
    kiriRegions* r = u->regions;
    kiriRule rule = { u->grid, KIRI_FAR, NULL, NearestSiteSeed, u, NULL, { NULL, NULL } };
    if (r->flooding) {
        return kiriField_Flood(&r->field, &rule, quota);
    }
    kiriProgress progress = r->following ? KIRI_DONE : kiriField_Repair(&r->field, u->memory, &rule, quota);
    if (progress == KIRI_DONE && !r->following) {
        DropOrphans(u);
        r->following = true;
        r->followed = 0;
    }
    progress = progress == KIRI_DONE ? FollowLog(u, quota) : progress;
    r->following = r->following && progress == KIRI_MORE;
    return progress;
}

kiriProgress kiriRegions_Update(kiriRegions* regions, kiriMemory* memory, const kiriGrid* grid,
                                const kiriMeshData* mesh, const kiriSite* sites, int32_t siteCount,
                                const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota)
{
    RegionUpdate u = { regions, memory, grid, mesh, sites, siteCount, moves, moveCount, mesh->step * KIRI_LATTICE };
    KIRI_ASSERT(siteCount >= regions->material.count && grid->cells.count >= regions->siteAt.count);
    if (!regions->running && !BeginRegions(&u)) {
        return KIRI_FAILED;
    }
    kiriProgress progress = DivideCells(&u, quota);
    regions->running = progress == KIRI_MORE;
    if (progress != KIRI_DONE) {
        return progress;
    }
    if (regions->flooding ? !FinishFlood(&u) : !FinishRepair(&u)) {
        return KIRI_FAILED;
    }
    const kiriGridChanges* changes = &u.grid->changes;
    u.regions->seen = (kiriSeenChanges){ changes->made.count, changes->gone.count, changes->steps.count,
                                         changes->material.count, changes->edges.count };
    return KIRI_DONE;
}

/* All cells are asked, in one plain pass: what is gone has no owner any more. */
static void RenumberCells(kiriRegions* regions, const kiriKeep* frames)
{
    int32_t *owner = regions->field.owner.data, *siteAt = regions->siteAt.data;
    const int32_t *to = frames->to.data, first = frames->first;
    for (int32_t c = 0; c < regions->siteAt.count; ++c) {
        if (owner[c] >= first) {
            owner[c] = to[owner[c]];
        }
        if (siteAt[c] >= first) {
            siteAt[c] = to[siteAt[c]];
        }
    }
}

void kiriRegions_Keep(kiriRegions* regions, const kiriKeep* frames, const int32_t* gone, int32_t goneCount)
{
    KIRI_ASSERT(!regions->running && regions->changes.count == 0 && regions->orphans.count == 0);
    for (int32_t k = 0; k < goneCount; ++k) {
        kiriField_Forget(&regions->field, gone[k]);
        regions->siteAt.data[gone[k]] = KIRI_NONE;
        SetBorder(regions, gone[k], false);
    }
    if (kiriKeep_Moves(frames)) {
        RenumberCells(regions, frames);
    }
    kiriBorderCells_Keep(&regions->border, frames);
    kiriKeep_Compact(frames, &regions->material, 1, sizeof(kiriTally));
    kiriKeep_Compact(frames, &regions->dirty, 1, sizeof(uint8_t));
}

void kiriRegions_ClearChanges(kiriRegions* regions)
{
    for (int32_t k = 0; k < regions->changes.count; ++k) {
        regions->isChanged.data[regions->changes.data[k].cell] = 0;
    }
    regions->changes.count = 0;
    regions->seen = (kiriSeenChanges){ 0, 0, 0, 0, 0 };
}

void kiriRegions_Reset(kiriRegions* regions)
{
    kiriField_Clear(&regions->field);
    regions->siteAt.count = regions->onBorder.count = regions->isChanged.count = 0;
    kiriBorderCells_Reset(&regions->border);
    regions->material.count = regions->dirty.count = 0;
    regions->changes.count = regions->orphans.count = 0;
    regions->seen = (kiriSeenChanges){ 0, 0, 0, 0, 0 };
    regions->running = regions->following = false;
}
