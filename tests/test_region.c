/* Regions: against distances by relaxing all steps, and regions that follow cuts against ones from scratch. */
#include "cells.h"
#include "mesh_copy.h"
#include "field/kiri_region.h"
#include "mesh/kiri_cut.h"
#include "support.h"

#include <stdlib.h>
#include <string.h>

/* ---- Sheets ------------------------------------------------------------------------------------------------------ */

/* Counts live blocks, and fails when no more may succeed (negative: never). */
typedef struct Blocks {
    int32_t live, untilFailure;
} Blocks;

static void* CountedAlloc(void* user, int64_t bytes)
{
    Blocks* blocks = user;
    if (blocks->untilFailure == 0) {
        return NULL;
    }
    blocks->untilFailure -= blocks->untilFailure > 0;
    ++blocks->live;
    return malloc((size_t)bytes);
}

static void CountedFree(void* user, void* pointer)
{
    --((Blocks*)user)->live;
    free(pointer);
}

/* What a cell was when the changes were cleared. */
typedef struct Was {
    int32_t owner, distance;
    kiriMoments material;
    bool lives;
} Was;

typedef struct Sheet {
    Blocks blocks;
    kiriMemory memory;
    kiriMeshData mesh;
    kiriGrid grid;
    kiriRegions regions;
    kiriSites sites;
    KIRI_ARRAY(kiriLatticePoint) anchors; /* of the sites */
    KIRI_ARRAY(kiriSiteMove) moves;
    KIRI_ARRAY(Was) was; /* by cell */
    int64_t slice;       /* items of a quota */
    int64_t used;        /* by the last update */
} Sheet;

static void ClearChanges(Sheet* sheet)
{
    assert_true(kiriArray_Resize(&sheet->memory, &sheet->was, sheet->grid.cells.count));
    for (int32_t c = 0; c < sheet->grid.cells.count; ++c) {
        bool known = c < sheet->regions.siteAt.count;
        sheet->was.data[c] = (Was){ known ? sheet->regions.field.owner.data[c] : KIRI_NONE,
                                    known ? sheet->regions.field.distance.data[c] : KIRI_FAR,
                                    Cell_Material(&sheet->grid, &sheet->mesh, c), kiriGrid_IsCell(&sheet->grid, c) };
    }
    for (int32_t i = 0; i < sheet->regions.dirty.count; ++i) {
        sheet->regions.dirty.data[i] = 0;
    }
    kiriGrid_ClearChanges(&sheet->grid);
    kiriRegions_ClearChanges(&sheet->regions);
    assert_int_equal(sheet->regions.changes.count, 0);
}

static void UpdateGrid(Sheet* sheet)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    assert_int_equal(kiriGrid_Update(&sheet->grid, &sheet->mesh, &quota), KIRI_DONE);
    kiriSquares_ClearDirty(&sheet->mesh.squares);
}

/* The unit square, of two triangles. The changes of its grid are not cleared. */
static void OpenSquare(Sheet* sheet, int32_t resolution)
{
    const float positions[8] = { 0.0f, 0.0f, 1.0f, 0.0f, 1.0f, 1.0f, 0.0f, 1.0f };
    const int32_t indices[6] = { 0, 1, 2, 0, 2, 3 };
    kiriFault why;
    memset(sheet, 0, sizeof(*sheet));
    sheet->blocks.untilFailure = -1;
    sheet->slice = INT64_MAX;
    sheet->memory = kiriMemory_Make(CountedAlloc, CountedFree, &sheet->blocks);
    assert_int_equal(kiriMesh_Init(&sheet->mesh, &sheet->memory,
                                   &(kiriMeshInput){ positions, 4, indices, 2, resolution, 0.0 }, &why),
                     KIRI_OK);
    UpdateGrid(sheet);
}

static void CloseSheet(Sheet* sheet)
{
    kiriMemory_FreeAll(sheet->mesh.memory);
    assert_int_equal(sheet->blocks.live, 0);
}

static void CutLine(Sheet* sheet, double x0, double y0, double x1, double y1)
{
    kiriQuota all = { INT64_MAX, 0, 0, false };
    kiriMesh_Begin(&sheet->mesh);
    kiriBladeTip blade = kiriCut_Place(&sheet->mesh, kiriVec2_Make(x0, y0));
    assert_int_equal(kiriCut_Move(&sheet->mesh, &blade, kiriMesh_Snap(&sheet->mesh, kiriVec2_Make(x1, y1)), 16.0, &all),
                     KIRI_DONE);
    kiriMesh_Commit(&sheet->mesh);
}

/* Between Begin and Commit. */
static void MoveBlade(Sheet* sheet, uint32_t* seed, double length)
{
    double x = RandomBetween(seed, -0.1, 1.1), y = RandomBetween(seed, -0.1, 1.1);
    double u = RandomBetween(seed, -length, length), v = RandomBetween(seed, -length, length);
    kiriQuota all = { INT64_MAX, 0, 0, false };
    kiriBladeTip blade = kiriCut_Place(&sheet->mesh, kiriVec2_Make(x, y));
    kiriLatticePoint to = kiriMesh_Snap(&sheet->mesh, kiriVec2_Make(x + u, y + v));
    assert_int_equal(kiriCut_Move(&sheet->mesh, &blade, to, 16.0, &all), KIRI_DONE);
}

static void CutRandomly(Sheet* sheet, uint32_t* seed, double length)
{
    kiriMesh_Begin(&sheet->mesh);
    MoveBlade(sheet, seed, length);
    kiriMesh_Commit(&sheet->mesh);
}

static int32_t CellAt(const Sheet* sheet, kiriLatticePoint at)
{
    int32_t triangle = kiriMesh_Locate(&sheet->mesh, at);
    assert_int_not_equal(triangle, KIRI_NONE);
    return kiriGrid_CellOf(&sheet->grid, &sheet->mesh, triangle, at);
}

static int32_t AnyCell(const Sheet* sheet, uint32_t* seed)
{
    int32_t cell = KIRI_NONE;
    while (cell == KIRI_NONE || !kiriGrid_IsCell(&sheet->grid, cell)) {
        cell = (int32_t)(Random(seed) % (uint32_t)sheet->grid.cells.count);
    }
    return cell;
}

/* ---- Sites ------------------------------------------------------------------------------------------------------- */

static bool IsTaken(const Sheet* sheet, int32_t cell)
{
    for (int32_t i = 0; i < sheet->sites.count; ++i) {
        if (sheet->sites.data[i].cell == cell) {
            return true;
        }
    }
    return false;
}

/* Somewhere in the cell's square; often in its middle. */
static kiriSite SiteIn(const Sheet* sheet, int32_t cell, uint32_t* seed)
{
    double half = Random(seed) % 3 == 0 ? 0.0 : 0.499 * sheet->grid.side;
    kiriVec2 at = kiriGrid_Middle(&sheet->grid, &sheet->mesh, cell);
    at.x += RandomBetween(seed, -half, half);
    at.y += RandomBetween(seed, -half, half);
    kiriSite site = { at, cell };
    return site;
}

static void Place(Sheet* sheet, int32_t frame, kiriSite site)
{
    kiriSiteMove move = { frame, frame < sheet->sites.count ? sheet->sites.data[frame].cell : KIRI_NONE };
    kiriLatticePoint anchor = kiriGrid_Anchor(&sheet->grid, &sheet->mesh, site.cell);
    if (frame == sheet->sites.count) {
        assert_true(kiriArray_Push(&sheet->memory, &sheet->sites, site));
        assert_true(kiriArray_Push(&sheet->memory, &sheet->anchors, anchor));
    }
    sheet->sites.data[frame] = site;
    sheet->anchors.data[frame] = anchor;
    assert_true(kiriArray_Push(&sheet->memory, &sheet->moves, move));
}

static void AddSites(Sheet* sheet, int32_t count, uint32_t* seed)
{
    while (count-- > 0) {
        int32_t cell = AnyCell(sheet, seed);
        if (!IsTaken(sheet, cell)) {
            Place(sheet, sheet->sites.count, SiteIn(sheet, cell, seed));
        }
    }
}

static bool IsMoved(const Sheet* sheet, int32_t frame)
{
    for (int32_t k = 0; k < sheet->moves.count; ++k) {
        if (sheet->moves.data[k].frame == frame) {
            return true;
        }
    }
    return false;
}

/* Sites keep their material; where that falls to the same cell as another's, they go elsewhere. */
static void FollowMaterial(Sheet* sheet, uint32_t* seed)
{
    for (int32_t i = 0; i < sheet->sites.count; ++i) {
        kiriSite* site = &sheet->sites.data[i];
        int32_t cell = CellAt(sheet, sheet->anchors.data[i]), was = site->cell;
        if (cell == was) {
            continue;
        }
        while (IsTaken(sheet, cell)) {
            cell = AnyCell(sheet, seed);
        }
        Place(sheet, i, SiteIn(sheet, cell, seed));
        assert_int_equal(sheet->moves.data[sheet->moves.count - 1].was, was);
    }
}

static void MoveSites(Sheet* sheet, int32_t count, uint32_t* seed)
{
    while (count-- > 0 && sheet->sites.count > 0) {
        int32_t frame = (int32_t)(Random(seed) % (uint32_t)sheet->sites.count);
        int32_t cell = Random(seed) % 2 == 0 ? sheet->sites.data[frame].cell : AnyCell(sheet, seed);
        if (!IsMoved(sheet, frame) && (cell == sheet->sites.data[frame].cell || !IsTaken(sheet, cell))) {
            Place(sheet, frame, SiteIn(sheet, cell, seed));
        }
    }
}

/* ---- Updates ----------------------------------------------------------------------------------------------------- */

static kiriProgress TryUpdate(Sheet* sheet, kiriRegions* regions)
{
    for (sheet->used = 0;;) {
        kiriQuota quota = { sheet->slice, 0, 0, false };
        kiriProgress progress =
            kiriRegions_Update(regions, &sheet->memory, &sheet->grid, &sheet->mesh, sheet->sites.data,
                               sheet->sites.count, sheet->moves.data, sheet->moves.count, &quota);
        assert_int_equal(regions->running, progress == KIRI_MORE);
        sheet->used += quota.used;
        if (progress != KIRI_MORE) {
            return progress;
        }
        assert_true(quota.left < 2); /* that a cell of another region takes */
    }
}

static void Update(Sheet* sheet)
{
    assert_int_equal(TryUpdate(sheet, &sheet->regions), KIRI_DONE);
    sheet->moves.count = 0;
}

/* From scratch, in regions of their own. */
static void MakeFromScratch(Sheet* sheet, kiriRegions* regions)
{
    int32_t moves = sheet->moves.count;
    for (int32_t i = 0; i < sheet->sites.count; ++i) {
        kiriSiteMove move = { i, KIRI_NONE };
        assert_true(kiriArray_Push(&sheet->memory, &sheet->moves, move));
    }
    assert_int_equal(TryUpdate(sheet, regions), KIRI_DONE);
    sheet->moves.count = moves;
}

/* ---- Checks ------------------------------------------------------------------------------------------------------ */

static int32_t HolderOf(const Sheet* sheet, int32_t cell)
{
    for (int32_t i = 0; i < sheet->sites.count; ++i) {
        if (sheet->sites.data[i].cell == cell) {
            return i;
        }
    }
    return KIRI_NONE;
}

static void Offer(kiriSeed* value, int32_t distance, int32_t owner)
{
    if (distance < value->distance || (distance == value->distance && owner < value->owner)) {
        value->distance = distance;
        value->owner = owner;
    }
}

/* What a site gives a cell, which is its own or one step away. */
static void OfferSite(const Sheet* sheet, kiriSeed* value, int32_t frame)
{
    const kiriSite* site = &sheet->sites.data[frame];
    int32_t holder = HolderOf(sheet, value->cell);
    kiriVec2 own = kiriVec2_Sub(kiriGrid_Middle(&sheet->grid, &sheet->mesh, site->cell), site->at);
    kiriVec2 way = kiriVec2_Sub(kiriGrid_Middle(&sheet->grid, &sheet->mesh, value->cell), site->at);
    bool inMiddle = kiriVec2_Length(own) <= 0.01 * sheet->grid.side;
    int32_t distance = (int32_t)(256.0 * (kiriVec2_Length(way) / sheet->grid.side) + 0.5);
    if (holder == frame) {
        Offer(value, inMiddle ? 0 : distance, frame);
    } else if (holder == KIRI_NONE && !inMiddle) {
        Offer(value, distance, frame);
    }
}

/* The least (distance, owner) of each cell, by relaxing all steps until nothing changes. */
static kiriSeed* Relax(const Sheet* sheet)
{
    const kiriGrid* grid = &sheet->grid;
    kiriSeed* values = malloc(sizeof(kiriSeed) * (size_t)grid->cells.count);
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        values[c] = (kiriSeed){ c, KIRI_FAR, KIRI_NONE };
    }
    for (int32_t i = 0; i < sheet->sites.count; ++i) {
        int32_t cell = sheet->sites.data[i].cell;
        OfferSite(sheet, &values[cell], i);
        kiriSteps steps;
        kiriGrid_GetSteps(grid, cell, &steps);
        for (int32_t s = 0; s < steps.end[2]; ++s) {
            OfferSite(sheet, &values[steps.data[s].cell], i);
        }
    }
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t c = 0; c < grid->cells.count; ++c) {
            bool any = kiriGrid_IsCell(grid, c) && values[c].distance != KIRI_FAR;
            kiriSteps steps;
            kiriGrid_GetSteps(grid, c, &steps);
            for (int32_t s = 0; any && s < steps.end[2]; ++s) {
                kiriSeed* to = &values[steps.data[s].cell];
                int32_t before = to->distance, owner = to->owner;
                Offer(to, values[c].distance + steps.data[s].length, values[c].owner);
                changed = changed || to->distance != before || to->owner != owner;
            }
        }
    }
    return values;
}

static void CheckDistances(const Sheet* sheet)
{
    const kiriRegions* regions = &sheet->regions;
    kiriSeed* values = Relax(sheet);
    for (int32_t c = 0; c < sheet->grid.cells.count; ++c) {
        bool lives = kiriGrid_IsCell(&sheet->grid, c), border = false;
        int32_t owner = lives ? values[c].owner : KIRI_NONE;
        assert_int_equal(regions->field.distance.data[c], lives ? values[c].distance : KIRI_FAR);
        assert_int_equal(regions->field.owner.data[c], owner);
        assert_int_equal(regions->siteAt.data[c], HolderOf(sheet, c));
        kiriSteps steps;
        kiriGrid_GetSteps(&sheet->grid, c, &steps);
        for (int32_t s = 0; lives && s < steps.end[2]; ++s) {
            border = border || values[steps.data[s].cell].owner != owner;
        }
        assert_int_equal(regions->onBorder.data[c] != 0, border);
        assert_true(HolderOf(sheet, c) == KIRI_NONE || owner == HolderOf(sheet, c));
    }
    free(values);
}

static void AssertNear(double a, double b, double tolerance)
{
    if (!(fabs(a - b) <= tolerance)) {
        fail_msg("%.17g is not %.17g within %g", a, b, tolerance);
    }
}

/* Sums over the cells, exact and plain. */
static void CheckMaterial(const Sheet* sheet)
{
    double extent = sheet->mesh.step * 536870912.0;
    for (int32_t i = 0; i < sheet->sites.count; ++i) {
        kiriTally tally = { 0 };
        kiriMoments sum = { 0 }, moments = kiriTally_Moments(&sheet->regions.material.data[i], extent);
        for (int32_t c = 0; c < sheet->grid.cells.count; ++c) {
            if (sheet->regions.field.owner.data[c] == i) {
                kiriMoments cell = kiriGrid_Material(&sheet->grid, &sheet->mesh, c);
                kiriTally_Add(&tally, &cell, 1, extent);
                kiriMoments_Add(&sum, &cell);
            }
        }
        assert_memory_equal(&tally, &sheet->regions.material.data[i], sizeof(tally));
        AssertNear(moments.area, sum.area, 1e-13);
        AssertNear(moments.u, sum.u, 1e-13);
        AssertNear(moments.vv, sum.vv, 1e-13);
    }
}

/* The changes are what has changed since they were cleared, and frames that it concerns are dirty. Returns how
   many. */
static int32_t CheckChanges(const Sheet* sheet)
{
    const kiriRegions* regions = &sheet->regions;
    int32_t n = sheet->grid.cells.count, count = 0;
    uint8_t* isChanged = calloc((size_t)n, 1);
    for (int32_t k = 0; k < regions->changes.count; ++k) {
        kiriSeed was = regions->changes.data[k];
        assert_false(isChanged[was.cell]);
        isChanged[was.cell] = 1;
        assert_true(kiriGrid_IsCell(&sheet->grid, was.cell));
        bool known = was.cell < sheet->was.count;
        assert_int_equal(was.owner, known ? sheet->was.data[was.cell].owner : KIRI_NONE);
        assert_int_equal(was.distance, known ? sheet->was.data[was.cell].distance : KIRI_FAR);
    }
    for (int32_t c = 0; c < n; ++c) {
        Was none = { KIRI_NONE, KIRI_FAR, { 0.0, 0.0, 0.0, 0.0, 0.0, 0.0 }, false };
        Was was = c < sheet->was.count ? sheet->was.data[c] : none;
        int32_t owner = regions->field.owner.data[c];
        bool lives = kiriGrid_IsCell(&sheet->grid, c);
        bool changed = was.owner != owner || was.distance != regions->field.distance.data[c];
        kiriMoments is = Cell_Material(&sheet->grid, &sheet->mesh, c);
        bool material = memcmp(&was.material, &is, sizeof(is)) != 0;
        assert_int_equal(isChanged[c], changed && lives);
        if (changed || material || was.lives != lives) {
            assert_true(was.owner == KIRI_NONE || regions->dirty.data[was.owner]);
            assert_true(owner == KIRI_NONE || regions->dirty.data[owner]);
        }
        count += changed;
    }
    free(isChanged);
    for (int32_t k = 0; k < sheet->grid.changes.steps.count; ++k) {
        int32_t cell = sheet->grid.changes.steps.data[k];
        int32_t owner = kiriGrid_IsCell(&sheet->grid, cell) ? regions->field.owner.data[cell] : KIRI_NONE;
        assert_true(owner == KIRI_NONE || regions->dirty.data[owner]);
    }
    return count;
}

static void CheckOrphans(const Sheet* sheet)
{
    int32_t next = 0;
    for (int32_t s = 0; s < sheet->grid.squareCell.count; ++s) {
        for (int32_t c = sheet->grid.squareCell.data[s]; c != KIRI_NONE; c = sheet->grid.cells.data[c].next) {
            if (sheet->regions.field.owner.data[c] == KIRI_NONE) {
                assert_true(next < sheet->regions.orphans.count);
                assert_int_equal(sheet->regions.orphans.data[next++], c);
            }
        }
    }
    assert_int_equal(next, sheet->regions.orphans.count);
}

static void CheckAgainstScratch(Sheet* sheet)
{
    kiriRegions fresh = { 0 };
    const kiriRegions* regions = &sheet->regions;
    size_t n = (size_t)sheet->grid.cells.count, frames = (size_t)sheet->sites.count;
    MakeFromScratch(sheet, &fresh);
    assert_memory_equal(fresh.field.distance.data, regions->field.distance.data, n * sizeof(int32_t));
    assert_memory_equal(fresh.field.owner.data, regions->field.owner.data, n * sizeof(int32_t));
    assert_memory_equal(fresh.siteAt.data, regions->siteAt.data, n * sizeof(int32_t));
    assert_memory_equal(fresh.onBorder.data, regions->onBorder.data, n);
    assert_int_equal(fresh.orphans.count, regions->orphans.count);
    if (frames > 0) {
        assert_memory_equal(fresh.material.data, regions->material.data, frames * sizeof(kiriTally));
    }
}

static int32_t CheckAll(Sheet* sheet)
{
    CheckDistances(sheet);
    CheckMaterial(sheet);
    CheckOrphans(sheet);
    CheckAgainstScratch(sheet);
    return CheckChanges(sheet);
}

/* A site for each piece that has none, as the sheet does. Returns how many. */
static int32_t AdoptOrphans(Sheet* sheet, uint32_t* seed)
{
    int32_t adopted = 0;
    while (sheet->regions.orphans.count > 0) {
        Place(sheet, sheet->sites.count, SiteIn(sheet, sheet->regions.orphans.data[0], seed));
        Update(sheet);
        ++adopted;
    }
    return adopted;
}

/* ---- From scratch ------------------------------------------------------------------------------------------------ */

/* Distances from a site off the middle of its square are right to a part of a cell. */
static void DistanceKnowsWhereInItsCellTheSiteIs(void** state)
{
    (void)state;
    Sheet sheet;
    uint32_t seed = 7;
    OpenSquare(&sheet, 20);
    for (int round = 0; round < 50; ++round) {
        double x = RandomBetween(&seed, 0.01, 0.99), y = RandomBetween(&seed, 0.01, 0.99);
        kiriVec2 at = kiriVec2_Make(x, y);
        kiriSite site = { at, CellAt(&sheet, kiriMesh_Snap(&sheet.mesh, at)) };
        Place(&sheet, 0, site);
        Update(&sheet);
        for (int32_t c = 0; c < sheet.grid.cells.count; ++c) {
            double straight = kiriVec2_Length(kiriVec2_Sub(kiriGrid_Middle(&sheet.grid, &sheet.mesh, c), at));
            double measured = sheet.regions.field.distance.data[c] * sheet.grid.side / KIRI_UNIT;
            assert_true(measured > 0.998 * straight - 0.01 * sheet.grid.side);
            assert_true(measured < 1.03 * straight + 0.08 * sheet.grid.side);
        }
    }
    CloseSheet(&sheet);
}

/* However close sites crowd, each owns its own cell. */
static void CrowdedSitesOwnTheirCells(void** state)
{
    (void)state;
    uint32_t seed = 11;
    for (int round = 0; round < 100; ++round) {
        Sheet sheet;
        OpenSquare(&sheet, 8);
        for (int32_t c = 0; c < 64; ++c) {
            if (Random(&seed) % 3 > 0) {
                Place(&sheet, sheet.sites.count, SiteIn(&sheet, c, &seed));
            }
        }
        Update(&sheet);
        CheckAll(&sheet);
        CloseSheet(&sheet);
    }
}

/* One site sees what kiriSite_Seed and kiriSite_SeedAt say of it. */
static void SeedsAgree(void** state)
{
    (void)state;
    uint32_t seed = 17;
    Sheet sheet;
    OpenSquare(&sheet, 9);
    for (int k = 0; k < 12; ++k) {
        CutRandomly(&sheet, &seed, 0.6);
    }
    UpdateGrid(&sheet);
    for (int round = 0; round < 60; ++round) {
        kiriSeeds seeds = { 0 };
        kiriSite site = SiteIn(&sheet, AnyCell(&sheet, &seed), &seed);
        assert_true(kiriSite_Seed(&site, 5, &sheet.memory, &sheet.grid, &sheet.mesh, &seeds));
        for (int32_t c = 0; c < sheet.grid.cells.count; ++c) {
            kiriSeed expected = { c, KIRI_FAR, KIRI_NONE };
            for (int32_t k = 0; k < seeds.count; ++k) {
                expected = seeds.data[k].cell == c ? seeds.data[k] : expected;
            }
            if (kiriGrid_IsCell(&sheet.grid, c)) {
                kiriSeed found = kiriSite_SeedAt(&site, 5, &sheet.grid, &sheet.mesh, c);
                assert_int_equal(found.distance, expected.distance);
                assert_true(found.distance == KIRI_FAR || (found.cell == c && found.owner == 5));
            }
        }
        kiriArray_Release(&sheet.memory, &seeds);
    }
    CloseSheet(&sheet);
}

/* A cut through and through: each half is its frame's, or nobody's. */
static void CompleteCutParts(void** state)
{
    (void)state;
    Sheet sheet;
    uint32_t seed = 2;
    double extent;
    OpenSquare(&sheet, 21);
    extent = sheet.mesh.step * 536870912.0;
    Place(&sheet, 0, SiteIn(&sheet, CellAt(&sheet, kiriMesh_Snap(&sheet.mesh, kiriVec2_Make(0.25, 0.25))), &seed));
    Update(&sheet);
    AssertNear(kiriTally_Moments(&sheet.regions.material.data[0], extent).area, 1.0, 1e-6);
    ClearChanges(&sheet);
    CutLine(&sheet, 0.5, -0.1, 0.5, 1.1);
    UpdateGrid(&sheet);
    FollowMaterial(&sheet, &seed);
    Update(&sheet);
    CheckAll(&sheet);
    AssertNear(kiriTally_Moments(&sheet.regions.material.data[0], extent).area, 0.5, 1e-6);
    assert_int_equal(sheet.regions.orphans.count, 21 * 11);
    assert_int_equal(AdoptOrphans(&sheet, &seed), 1);
    CheckAll(&sheet);
    AssertNear(kiriTally_Moments(&sheet.regions.material.data[1], extent).area, 0.5, 1e-6);
    CloseSheet(&sheet);
}

/* ---- Following --------------------------------------------------------------------------------------------------- */

/* Long cuts and short ones, sites that move and new ones, pieces that come off; now and then without a frame. */
static void FollowsCutsAndSites(void** state)
{
    (void)state;
    uint32_t seed = 23;
    int32_t adopted = 0, left = 0, clean = 0;
    for (int round = 0; round < 60; ++round) {
        Sheet sheet;
        OpenSquare(&sheet, 4 + (int32_t)(Random(&seed) % 16));
        sheet.slice = round % 3 == 0 ? 1 + round % 7 : INT64_MAX;
        AddSites(&sheet, (int32_t)(Random(&seed) % 12), &seed);
        Update(&sheet);
        CheckAll(&sheet);
        ClearChanges(&sheet);
        for (int step = 0; step < 30; ++step) {
            for (uint32_t cuts = Random(&seed) % 3; cuts > 0; --cuts) {
                CutRandomly(&sheet, &seed, Random(&seed) % 2 == 0 ? 0.1 : 0.8);
            }
            UpdateGrid(&sheet);
            FollowMaterial(&sheet, &seed);
            MoveSites(&sheet, (int32_t)(Random(&seed) % 8) - 5, &seed);
            AddSites(&sheet, (int32_t)(Random(&seed) % 8) - 6, &seed);
            Update(&sheet);
            CheckAll(&sheet);
            if (Random(&seed) % 4 > 0) {
                adopted += AdoptOrphans(&sheet, &seed);
                CheckAll(&sheet);
            }
            left += sheet.regions.orphans.count > 0;
            for (int32_t i = 0; i < sheet.sites.count; ++i) {
                clean += !sheet.regions.dirty.data[i];
            }
            ClearChanges(&sheet);
        }
        CloseSheet(&sheet);
    }
    assert_true(adopted > 100 && left > 50 && clean > 5000);
}

/* Cuts that are taken back: cells go, and others come again. */
static void FollowsCutsTakenBack(void** state)
{
    (void)state;
    uint32_t seed = 29;
    int32_t gone = 0, owned = 0;
    for (int round = 0; round < 30; ++round) {
        Sheet sheet;
        OpenSquare(&sheet, 4 + (int32_t)(Random(&seed) % 12));
        AddSites(&sheet, 3 + (int32_t)(Random(&seed) % 12), &seed);
        Update(&sheet);
        ClearChanges(&sheet);
        for (int step = 0; step < 12; ++step) {
            Whole whole = Whole_Make(&sheet.mesh);
            kiriMesh_Begin(&sheet.mesh);
            for (int cuts = 0; cuts < 3; ++cuts) {
                MoveBlade(&sheet, &seed, 0.7);
            }
            for (int back = 0; back < 2; ++back) {
                if (back) {
                    Whole_Restore(&whole, &sheet.mesh);
                    Whole_Free(&whole);
                }
                UpdateGrid(&sheet);
                for (int32_t k = 0; k < sheet.grid.changes.gone.count; ++k, ++gone) {
                    owned += sheet.regions.field.owner.data[sheet.grid.changes.gone.data[k]] != KIRI_NONE;
                }
                FollowMaterial(&sheet, &seed);
                Update(&sheet);
                CheckAll(&sheet);
                AdoptOrphans(&sheet, &seed);
                CheckAll(&sheet);
                ClearChanges(&sheet);
            }
        }
        CloseSheet(&sheet);
    }
    assert_true(gone > 1000 && owned > 1000);
}

/* A site that goes and comes back before the changes are cleared has changed nothing. */
static void ThereAndBack(void** state)
{
    (void)state;
    uint32_t seed = 41;
    Sheet sheet;
    OpenSquare(&sheet, 15);
    AddSites(&sheet, 8, &seed);
    Update(&sheet);
    ClearChanges(&sheet);
    for (int round = 0; round < 20; ++round) {
        int32_t frame = round % 8, away = AnyCell(&sheet, &seed);
        kiriSite was = sheet.sites.data[frame];
        if (!IsTaken(&sheet, away)) {
            Place(&sheet, frame, SiteIn(&sheet, away, &seed));
            Update(&sheet);
            assert_true(CheckChanges(&sheet) > 0);
            Place(&sheet, frame, was);
            Update(&sheet);
            assert_int_equal(CheckAll(&sheet), 0);
            assert_int_equal(sheet.regions.changes.count, 0);
        }
    }
    CloseSheet(&sheet);
}

/* Where many frames share a sheet, a short cut changes little, and costs little. */
static void WorkIsLocal(void** state)
{
    (void)state;
    uint32_t seed = 51;
    Sheet sheet;
    int64_t used = 0;
    int32_t changed = 0, steps = 100, dirty = 0;
    OpenSquare(&sheet, 40);
    AddSites(&sheet, 40, &seed);
    Update(&sheet);
    assert_int_equal(sheet.used, 1600);
    ClearChanges(&sheet);
    for (int step = 0; step < steps; ++step) {
        CutRandomly(&sheet, &seed, 0.05);
        UpdateGrid(&sheet);
        FollowMaterial(&sheet, &seed);
        dirty += sheet.grid.changes.made.count + sheet.grid.changes.steps.count;
        Update(&sheet);
        used += sheet.used;
        changed += CheckChanges(&sheet);
        AdoptOrphans(&sheet, &seed);
        ClearChanges(&sheet);
    }
    CheckAll(&sheet);
    assert_true(used < 3 * (changed + dirty));
    assert_true(used < steps * 1600 / 10);
    CloseSheet(&sheet);
}

/* ---- Memory ------------------------------------------------------------------------------------------------------ */

static void FailsCleanly(void** state)
{
    (void)state;
    int32_t failures = 0;
    for (int32_t budget = 0, done = 0; done < 3; ++budget) {
        Sheet sheet;
        uint32_t seed = 61;
        OpenSquare(&sheet, 14);
        AddSites(&sheet, 6, &seed);
        sheet.blocks.untilFailure = budget;
        bool first = TryUpdate(&sheet, &sheet.regions) == KIRI_DONE, second = false;
        sheet.blocks.untilFailure = -1;
        if (first) {
            sheet.moves.count = 0;
            ClearChanges(&sheet);
            for (int k = 0; k < 20; ++k) {
                CutRandomly(&sheet, &seed, 0.9);
            }
            UpdateGrid(&sheet);
            FollowMaterial(&sheet, &seed);
            AddSites(&sheet, 20, &seed);
            sheet.blocks.untilFailure = budget > 15 ? budget - 15 : 0;
            second = TryUpdate(&sheet, &sheet.regions) == KIRI_DONE;
            sheet.blocks.untilFailure = -1;
        }
        if (!second) {
            ++failures;
            kiriRegions_Reset(&sheet.regions);
            sheet.moves.count = 0;
            MakeFromScratch(&sheet, &sheet.regions);
        }
        CheckDistances(&sheet);
        CheckMaterial(&sheet);
        CheckOrphans(&sheet);
        done += second;
        CloseSheet(&sheet);
    }
    assert_true(failures > 15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(DistanceKnowsWhereInItsCellTheSiteIs),
        cmocka_unit_test(CrowdedSitesOwnTheirCells),
        cmocka_unit_test(SeedsAgree),
        cmocka_unit_test(CompleteCutParts),
        cmocka_unit_test(FollowsCutsAndSites),
        cmocka_unit_test(FollowsCutsTakenBack),
        cmocka_unit_test(ThereAndBack),
        cmocka_unit_test(WorkIsLocal),
        cmocka_unit_test(FailsCleanly),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
