#include "kiri_region.h"

/* ---- Seeds ------------------------------------------------------------------------------------------------------- */

static double DistanceTo(const kiriSite* site, const kiriGrid* grid, int32_t cell)
{
    return kiriVec2_Distance(kiriGrid_Middle(grid, cell), site->at);
}

static bool IsAtMiddle(const kiriSite* site, const kiriGrid* grid)
{
    return DistanceTo(site, grid, site->cell) <= 0.01 * grid->side;
}

/* Returns the seed in the site's own cell, or one step away from it. A site from untrusted bytes may be anywhere: its
   distance is capped so that ways can go on from there. */
static kiriSeed SeedNear(const kiriSite* site, int32_t owner, const kiriGrid* grid, int32_t cell)
{
    if (IsAtMiddle(site, grid)) {
        return (kiriSeed){ cell, cell == site->cell ? 0 : KIRI_FAR, owner };
    }
    const double most = 0.5 * (KIRI_FAR - 1);
    double length = KIRI_UNIT * (DistanceTo(site, grid, cell) / grid->side) + 0.5;
    return (kiriSeed){ cell, (int32_t)kiriMin(length, most), owner };
}

bool kiriSite_Seed(const kiriSite* site, int32_t owner, const kiriGrid* grid, kiriSeeds* seeds)
{
    kiriSteps steps = kiriGrid_GetSteps(grid, site->cell);
    int32_t end = IsAtMiddle(site, grid) ? 0 : steps.end[2];
    bool ok = true;
    KIRI_FROM_TO_WHILE(ok, s, -1, end) {
        kiriSeed seed = SeedNear(site, owner, grid, s < 0 ? site->cell : kiriSteps_At(&steps, s).cell);
        ok = kiriArray_Push(grid->mesh->memory, seeds, seed);
    }
    return ok;
}

bool kiriSites_StartFlood(kiriField* field, kiriSeeds* seeds, const kiriGrid* grid, const kiriSite* sites,
                          int32_t first, int32_t end, const int32_t* holders)
{
    bool ok = true;
    seeds->count = 0;
    KIRI_FROM_TO_WHILE(ok, i, first, end) {
        ok = kiriSite_Seed(&sites[i], i, grid, seeds);
    }
    KIRI_KEEP_IF(const kiriSeed, seed, *seeds, holders[seed->cell] < 0 || holders[seed->cell] == seed->owner);
    return ok && kiriField_Start(field, grid->mesh->memory, seeds->data, seeds->count);
}

kiriSeed kiriSite_SeedAt(const kiriSite* site, int32_t owner, const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell) && kiriGrid_IsCell(grid, site->cell));
    bool near = cell == site->cell || kiriGrid_HasStep(grid, cell, site->cell, KIRI_KNIGHT);
    return near ? SeedNear(site, owner, grid, cell) : (kiriSeed){ cell, KIRI_FAR, KIRI_NONE };
}

/* ---- An update --------------------------------------------------------------------------------------------------- */

typedef struct RegionUpdate {
    kiriRegions* regions;
    kiriMemory* memory;
    const kiriGrid* grid;
    const kiriSite* sites;
    int32_t siteCount;
    const kiriSiteMove* moves;
    int32_t moveCount;
} RegionUpdate;

/* Returns the nearest seed of a cell. A cell that holds a site takes only that site's. So no region is ever empty: a
   site is within half a diagonal of its cell's middle, and every way into that cell is at least a side long. */
static kiriSeed NearestSiteSeed(const void* context, int32_t cell)
{
    const RegionUpdate* u = context;
    const int32_t* siteAt = u->regions->siteAt.data;
    kiriSeed best = { cell, KIRI_FAR, KIRI_NONE };
    if (siteAt[cell] != KIRI_NONE) {
        return SeedNear(&u->sites[siteAt[cell]], siteAt[cell], u->grid, cell);
    }
    KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
        int32_t owner = siteAt[step.cell];
        if (owner != KIRI_NONE) {
            kiriSeed seed = SeedNear(&u->sites[owner], owner, u->grid, cell);
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
        kiriTally_Add(&u->regions->material.data[frame], &material, sign, u->grid->mesh->step * KIRI_LATTICE);
        u->regions->dirty.data[frame] = 1;
    }
}

/* Makes room for all cells and frames. */
static bool MakeRegionRoom(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    int32_t cell = r->siteAt.count, frame = r->material.count, cellCount = u->grid->cells.count;
    const kiriTally none = { 0 };
    if (!kiriField_Resize(&r->field, u->memory, cellCount, KIRI_FIELD_OWNERS | KIRI_FIELD_REPAIRS) ||
        !kiriArrays_Resize(u->memory, cellCount, &r->siteAt, &r->onBorder) ||
        !kiriBorderCells_Resize(&r->border, u->memory, cellCount, u->siteCount) ||
        !kiriArray_Resize(u->memory, &r->isChanged, cellCount) ||
        !kiriArrays_Resize(u->memory, u->siteCount, &r->material, &r->dirty)) {
        return false;
    }
    for (; cell < cellCount; ++cell) {
        r->siteAt.data[cell] = KIRI_NONE;
        r->onBorder.data[cell] = r->isChanged.data[cell] = 0;
    }
    for (; frame < u->siteCount; ++frame) {
        r->material.data[frame] = none;
        r->dirty.data[frame] = 0;
    }
    return true;
}

/* Sets whether a cell is on the border of its region. */
static void SetBorder(kiriRegions* regions, int32_t cell, bool isBorder)
{
    KIRI_ASSERT_HAS(regions->onBorder, cell);
    regions->onBorder.data[cell] = isBorder;
    kiriBorderCells_Put(&regions->border, cell, isBorder ? regions->field.owner.data[cell] : KIRI_NONE);
}

/* ---- Changes of the grid and of sites ---------------------------------------------------------------------------- */

static void MarkDirtyAround(const RegionUpdate* u, int32_t cell)
{
    if (cell != KIRI_NONE && kiriGrid_IsCell(u->grid, cell)) {
        kiriField_MarkStepsDirty(&u->regions->field, cell);
        KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
            kiriField_MarkStepsDirty(&u->regions->field, step.cell);
        }
    }
}

/* False where two sites come to one cell: only untrusted bytes say so. */
static bool MoveSites(const RegionUpdate* u)
{
    int32_t* siteAt = u->regions->siteAt.data;
    KIRI_TIMES(k, u->moveCount) {
        kiriSiteMove move = u->moves[k];
        if (!u->regions->flooding && move.was != KIRI_NONE && siteAt[move.was] == move.frame) {
            siteAt[move.was] = KIRI_NONE;
        }
    }
    KIRI_TIMES(k, u->moveCount) {
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

/* Follows the grid's changes. */
static void FollowGrid(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    const kiriGridChanges* changes = &u->grid->changes;
    KIRI_EACH_LISTED(cell, changes->gone) {
        AddToRegion(u, r->field.owner.data[cell], kiriGrid_Material(u->grid, cell), -1);
        kiriField_Forget(&r->field, cell);
        r->siteAt.data[cell] = KIRI_NONE;
        SetBorder(r, cell, false);
    }
    KIRI_EACH(const kiriMaterialChange, change, changes->material) {
        int32_t owner = r->field.owner.data[change->cell];
        AddToRegion(u, owner, change->was, -1);
        AddToRegion(u, owner, kiriGrid_Material(u->grid, change->cell), 1);
    }
    KIRI_EACH_LISTED(cell, changes->steps) {
        KIRI_ASSERT(kiriGrid_IsCell(u->grid, cell));
        MarkRegionDirty(r, r->field.owner.data[cell]);
        kiriField_MarkStepsDirty(&r->field, cell);
    }
    KIRI_EACH_LISTED(cell, changes->edges) {
        MarkRegionDirty(r, r->field.owner.data[cell]);
    }
}

/* ---- Borders, material and changes ------------------------------------------------------------------------------- */

static void FindBorder(const RegionUpdate* u, int32_t cell)
{
    const int32_t* owner = u->regions->field.owner.data;
    bool border = false;
    KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
        border |= owner[step.cell] != owner[cell];
    }
    SetBorder(u->regions, cell, border);
}

/* Finds the borders around a cell that has another owner. */
static void FindBordersAround(const RegionUpdate* u, int32_t cell)
{
    const int32_t* owner = u->regions->field.owner.data;
    FindBorder(u, cell);
    KIRI_EACH_STEP(step, u->grid, cell, KIRI_KNIGHT) {
        int32_t next = step.cell;
        if (owner[next] != owner[cell]) {
            SetBorder(u->regions, next, true);
        } else if (u->regions->onBorder.data[next]) {
            FindBorder(u, next);
        }
    }
}

/* Each cell is among the changes once, with the values before the first. */
static bool AddRegionChange(const RegionUpdate* u, kiriSeed was)
{
    if (u->regions->isChanged.data[was.cell]) {
        return true;
    }
    u->regions->isChanged.data[was.cell] = 1;
    return kiriArray_Push(u->memory, &u->regions->changes, was);
}

/* Updates region, border and changes for a cell that had other values. */
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
        kiriMoments material = kiriGrid_Material(u->grid, was.cell);
        AddToRegion(u, was.owner, material, -1);
        AddToRegion(u, owner, material, 1);
        FindBordersAround(u, was.cell);
    }
    return AddRegionChange(u, was) && (owner != KIRI_NONE || kiriArray_Push(u->memory, &r->orphans, was.cell));
}

/* Finds borders where steps changed, and orphans among new cells; drops orphans that got an owner, and changes that an
   earlier update made and this one undid. */
static bool FinishRepair(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    const kiriGridChanges* changes = &u->grid->changes;
    int32_t orphans = 0, kept = 0;
    KIRI_EACH_LISTED_WHILE(!r->hasSeenGrid, cell, changes->steps) {
        FindBorder(u, cell);
    }
    KIRI_EACH_LISTED(cell, r->orphans) {
        r->orphans.data[orphans] = cell;
        orphans += kiriGrid_IsCell(u->grid, cell) && r->field.owner.data[cell] == KIRI_NONE;
    }
    r->orphans.count = orphans;
    KIRI_EACH_LISTED_WHILE(!r->hasSeenGrid, cell, changes->made) {
        if (r->field.owner.data[cell] == KIRI_NONE && !kiriArray_Push(u->memory, &r->orphans, cell)) {
            return false;
        }
    }
    kiriGrid_SortCells(u->grid, r->orphans.data, r->orphans.count);
    KIRI_EACH(const kiriSeed, change, r->changes) {
        kiriSeed was = *change;
        bool same = was.distance == r->field.distance.data[was.cell] && was.owner == r->field.owner.data[was.cell];
        bool isKept = !same && kiriGrid_IsCell(u->grid, was.cell);
        r->isChanged.data[was.cell] = isKept;
        r->changes.data[kept] = was;
        kept += isKept;
    }
    r->changes.count = kept;
    r->field.log.count = 0;
    return true;
}

/* Sums material and finds borders, changes and orphans: all cells, in their order. */
static bool FinishFlood(const RegionUpdate* u)
{
    kiriRegions* r = u->regions;
    r->orphans.count = 0;
    KIRI_EACH_INDEX(s, u->grid->squareCell) {
        KIRI_EACH_CELL(c, u->grid, s) {
            kiriSeed was = { c, KIRI_FAR, KIRI_NONE };
            int32_t owner = r->field.owner.data[c];
            KIRI_ASSERT(owner >= KIRI_NONE && owner < u->siteCount);
            AddToRegion(u, owner, kiriGrid_Material(u->grid, c), 1);
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
    if (!MakeRegionRoom(u)) {
        return false;
    }
    if (r->flooding) {
        kiriSeeds seeds = { 0 };
        bool ok =
            MoveSites(u) && kiriSites_StartFlood(&r->field, &seeds, u->grid, u->sites, 0, u->siteCount, r->siteAt.data);
        kiriArray_Release(u->memory, &seeds);
        return ok;
    }
    if (!r->hasSeenGrid) {
        FollowGrid(u);
    }
    if (!MoveSites(u)) {
        return false;
    }
    KIRI_TIMES(k, u->moveCount) {
        MarkDirtyAround(u, u->moves[k].was);
        MarkDirtyAround(u, u->sites[u->moves[k].frame].cell);
    }
    return true;
}

/* Makes the field right, and then everything that follows from it. */
static kiriProgress DivideCells(const RegionUpdate* u, kiriQuota* quota)
{
    enum { ITEMS_OF_CHANGE = 2 };
    kiriRegions* r = u->regions;
    kiriRule rule = { u->grid, KIRI_FAR - 1, NULL, NearestSiteSeed, u, NULL };
    kiriProgress progress = KIRI_DONE;
    if (r->flooding) {
        return kiriField_Flood(&r->field, &rule, quota);
    }
    if (!r->following) {
        progress = kiriField_Repair(&r->field, &rule, quota);
        r->following = progress == KIRI_DONE;
        r->followed = 0;
    }
    while (progress == KIRI_DONE && r->followed < r->field.log.count) {
        if (kiriMemory_MustPause(u->memory) || !kiriQuota_Take(quota, ITEMS_OF_CHANGE)) {
            return KIRI_MORE;
        }
        progress = FollowChange(u, r->field.log.data[r->followed++]) ? KIRI_DONE : KIRI_FAILED;
    }
    return progress;
}

kiriProgress kiriRegions_Update(kiriRegions* regions, const kiriGrid* grid, const kiriSite* sites, int32_t siteCount,
                                const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota)
{
    RegionUpdate u = { regions, grid->mesh->memory, grid, sites, siteCount, moves, moveCount };
    KIRI_ASSERT(siteCount >= regions->material.count && grid->cells.count >= regions->siteAt.count);
    if (!regions->running && !BeginRegions(&u)) {
        return KIRI_FAILED;
    }
    kiriProgress progress = DivideCells(&u, quota);
    regions->running = progress == KIRI_MORE;
    if (progress != KIRI_DONE) {
        return progress;
    }
    regions->following = false;
    if (regions->flooding ? !FinishFlood(&u) : !FinishRepair(&u)) {
        return KIRI_FAILED;
    }
    regions->hasSeenGrid = true;
    return KIRI_DONE;
}

void kiriRegions_Keep(kiriRegions* regions, const kiriKeep* frames, const int32_t* gone, int32_t goneCount)
{
    KIRI_ASSERT(!regions->running && regions->changes.count == 0 && regions->orphans.count == 0);
    KIRI_TIMES(k, goneCount) {
        kiriField_Forget(&regions->field, gone[k]);
        regions->siteAt.data[gone[k]] = KIRI_NONE;
        SetBorder(regions, gone[k], false);
    }
    KIRI_EACH_INDEX_WHILE(kiriKeep_Moves(frames), c, regions->siteAt) {
        regions->field.owner.data[c] = kiriKeep_To(frames, regions->field.owner.data[c]);
        regions->siteAt.data[c] = kiriKeep_To(frames, regions->siteAt.data[c]);
    }
    kiriBorderCells_Keep(&regions->border, frames);
    kiriKeep_Compact(frames, &regions->material, 1, sizeof(kiriTally));
    kiriKeep_Compact(frames, &regions->dirty, 1, sizeof(uint8_t));
}

void kiriRegions_ClearChanges(kiriRegions* regions)
{
    KIRI_EACH(const kiriSeed, change, regions->changes) {
        regions->isChanged.data[change->cell] = 0;
    }
    regions->changes.count = 0;
    regions->hasSeenGrid = false;
}

void kiriRegions_Reset(kiriRegions* regions)
{
    kiriRegions_ClearChanges(regions);
    kiriField_Clear(&regions->field);
    regions->siteAt.count = regions->onBorder.count = regions->isChanged.count = 0;
    kiriBorderCells_Reset(&regions->border);
    regions->material.count = regions->dirty.count = regions->orphans.count = 0;
    regions->running = regions->following = false;
}
