#include "kiri_field_check.h"

/* ---- Fields ----------------------------------------------------------------------------------------------------- */

static const kiriMust IsFieldCell[] = { KIRI_INDEX(KIRI_OF_CELLS, kiriSpan, first, first) };
static const kiriMust MustBeOwner[] = { KIRI_INDEX_OR_NONE(KIRI_OF_OWNERS, kiriSpan, first, first) };

static const kiriMust SeedMust[] = {
    KIRI_INDEX(KIRI_OF_CELLS, kiriSeed, cell, cell),
    KIRI_WITHIN(0, KIRI_FAR, kiriSeed, distance, distance),
    KIRI_INDEX_OR_NONE(KIRI_OF_OWNERS, kiriSeed, owner, owner),
};

static const kiriMust FieldMust[] = {
    KIRI_ITEMS_MUST(kiriField, owner, MustBeOwner), KIRI_ITEMS_MUST(kiriField, settled, IsFieldCell),
    KIRI_ITEMS_MUST(kiriField, log, SeedMust),      KIRI_ITEMS_MUST(kiriField, heap, SeedMust),
    KIRI_ITEMS_MUST(kiriField, dirty, IsFieldCell), KIRI_WITHIN(0, INT32_MAX, kiriField, cursor, cursor),
};

/* Marks of kiri_geodesic.c, and what its last cursor says. */
enum { MARK_DIRTY = 1, MARK_LOGGED = 2, MARK_SETTLED = 4 };
enum { CHECK_RESTS, CHECK_SEEDS = 2, CHECK_SETTLES, CHECK_STAGES };

static bool HaveMark(const kiriField* field, const int32_t* cells, int32_t count, size_t bytes, uint8_t mark)
{
    bool have = true;
    for (int32_t k = 0; have && k < count; ++k) {
        have = (field->marks.data[*(const int32_t*)(const void*)((const char*)cells + k * bytes)] & mark) != 0;
    }
    return have;
}

/* Cells are far and nobody's, as all are beyond those of the grid, or are somebody's. */
static bool AreValues(const kiriField* field, int64_t cells, bool areOwned)
{
    bool areFine = field->distance.count == field->owner.count && field->distance.count == field->marks.count;
    for (int32_t c = 0; areFine && c < field->distance.count; ++c) {
        int32_t distance = field->distance.data[c];
        areFine = distance == KIRI_FAR ? field->owner.data[c] == KIRI_NONE
                                       : c < cells && distance >= 0 && distance <= KIRI_FARTHEST &&
                                             (!areOwned || field->owner.data[c] != KIRI_NONE);
    }
    return areFine;
}

/* One of the two lists has room for all cells: the one that is not empty. */
static bool HaveListsRoom(const kiriField* field)
{
    int32_t cells = field->distance.count;
    bool isDirty = field->dirty.count > 0,
         isSettled = field->settled.count > 0 || field->cursor[KIRI_STEP_LENGTHS] == CHECK_SETTLES,
         isDirtyLong = field->dirty.capacity >= cells, isSettledLong = field->settled.capacity >= cells;
    return (isDirtyLong || !isDirty) && (isSettledLong || !isSettled) && (isDirtyLong || isSettledLong) &&
           !(isDirty && isSettled);
}

/* Each cell comes once to a list: so none must have any cell twice, or one that is not marked as being there.
   `isEmptied`: block by block; cells that were settled are far again. */
static bool AreListsOfField(const kiriField* field, kiriCheck* check, bool isEmptied)
{
    int32_t stage = field->cursor[KIRI_STEP_LENGTHS];
    kiriIndices settled = field->settled, dirty = field->dirty;
    bool areFine = HaveListsRoom(field) && kiriCheck_Distinct(check, &settled, field->distance.count);
    if (areFine && stage == CHECK_SETTLES) {
        areFine = HaveMark(field, settled.data, settled.count, sizeof(int32_t), MARK_SETTLED);
    }
    for (int32_t k = 0; areFine && !isEmptied && stage == CHECK_RESTS && k < settled.count; ++k) {
        areFine = field->distance.data[settled.data[k]] != KIRI_FAR;
    }
    if (areFine && stage == CHECK_RESTS) {
        areFine = kiriCheck_Distinct(check, &dirty, field->distance.count) &&
                  HaveMark(field, dirty.data, dirty.count, sizeof(int32_t), MARK_DIRTY);
    }
    if (areFine && stage == CHECK_SEEDS) {
        areFine = field->heap.capacity >= dirty.count && field->heap.count <= field->cursor[0];
    }
    return areFine;
}

static bool IsLogOfField(const kiriField* field, kiriCheck* check)
{
    uint8_t* seen = kiriCheck_Bytes(check, field->distance.count);
    bool isFine = seen != NULL;
    for (int32_t k = 0; isFine && k < field->log.count; ++k) {
        int32_t cell = field->log.data[k].cell;
        isFine = cell < field->distance.count && !seen[cell];
        seen[isFine ? cell : 0] = 1;
    }
    kiriMemory_Free(&check->memory, seen);
    return isFine && (field->cursor[KIRI_STEP_LENGTHS] == CHECK_RESTS || field->log.count == 0 ||
                      HaveMark(field, &field->log.data->cell, field->log.count, sizeof(kiriSeed), MARK_LOGGED));
}

bool kiriField_Check(const kiriField* field, kiriCheck* check, int64_t owners, kiriFieldUse use)
{
    int64_t cells = check->count[KIRI_OF_CELLS];
    check->count[KIRI_OF_OWNERS] = owners;
    check->count[KIRI_OF_CELLS] = cells < field->distance.count ? cells : field->distance.count;
    bool isFine = kiriCheck_Object(check, FieldMust, field) &&
                  kiriCheck_That(check, field->cursor[KIRI_STEP_LENGTHS] < CHECK_STAGES &&
                                            AreValues(field, check->count[KIRI_OF_CELLS], owners < INT32_MAX)) &&
                  kiriCheck_That(check, AreListsOfField(field, check, use == KIRI_FIELD_EMPTIED));
    if (isFine && use != KIRI_FIELD_FLOODS) {
        isFine = kiriCheck_That(check, IsLogOfField(field, check));
    }
    if (isFine && use == KIRI_FIELD_EMPTY) {
        isFine = kiriCheck_That(check, field->settled.count == 0 && field->log.count == 0 &&
                                           field->cursor[KIRI_STEP_LENGTHS] == CHECK_RESTS);
    }
    check->count[KIRI_OF_CELLS] = cells;
    return isFine && kiriCheck_IsFine(check);
}

/* What is not far is to be emptied: it is listed. */
static bool AreNearListed(const kiriField* field, kiriCheck* check, int32_t room)
{
    uint8_t* isListed = kiriCheck_Bytes(check, room);
    bool areListed = isListed != NULL;
    for (int32_t k = 0; areListed && k < field->settled.count; ++k) {
        isListed[field->settled.data[k]] = 1;
    }
    for (int32_t c = 0; areListed && c < field->distance.count; ++c) {
        areListed = isListed[c] || (field->distance.data[c] == KIRI_FAR && field->owner.data[c] == KIRI_NONE);
    }
    kiriMemory_Free(&check->memory, isListed);
    return areListed;
}

bool kiriField_CheckLeft(const kiriField* field, kiriCheck* check)
{
    kiriIndices settled = field->settled;
    int32_t room = field->distance.capacity < field->owner.capacity ? field->distance.capacity : field->owner.capacity;
    return kiriCheck_That(check, field->distance.count == field->owner.count && field->dirty.count == 0 &&
                                     field->log.count == 0 && field->cursor[KIRI_STEP_LENGTHS] == CHECK_RESTS) &&
           kiriCheck_Indices(check, &settled, room) && kiriCheck_That(check, AreNearListed(field, check, room));
}

/* ---- Sites ------------------------------------------------------------------------------------------------------ */

const kiriMust kiriSiteMust[2] = {
    KIRI_REALS(kiriSite, at, at),
    KIRI_INDEX(KIRI_OF_CELLS, kiriSite, cell, cell),
};

/* With half a square beside them, for rounding. */
bool kiriSite_IsOver(const kiriSite* site, const kiriMeshData* mesh)
{
    const kiriSquares* squares = &mesh->squares;
    double side = mesh->step * squares->side;
    double u = site->at.x / side - squares->firstColumn, v = site->at.y / side - squares->firstRow;
    return u >= -0.5 && v >= -0.5 && u <= squares->columns + 0.5 && v <= squares->rows + 0.5;
}

/* ---- Regions ---------------------------------------------------------------------------------------------------- */

static const kiriMust BorderCellMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_REGIONS, kiriBorderCell, region, region),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriBorderCell, next, before),
};

static const kiriMust RegionChangeMust[] = {
    KIRI_INDEX(KIRI_OF_CELLS, kiriSeed, cell, cell),
    KIRI_INDEX_OR_NONE(KIRI_OF_REGIONS, kiriSeed, owner, owner),
};

static const kiriMust RegionsMust[] = {
    KIRI_ITEMS_MUST(kiriRegions, border.cells, BorderCellMust),
    KIRI_LENGTH(KIRI_OF_REGIONS, kiriRegions, border.first),
    KIRI_LENGTH(KIRI_OF_REGIONS, kiriRegions, dirty),
    KIRI_ITEMS_MUST(kiriRegions, changes, RegionChangeMust),
    KIRI_ITEMS_MUST(kiriRegions, orphans, IsFieldCell),
    KIRI_WITHIN(0, INT32_MAX, kiriRegions, followed, followed),
    KIRI_WITHIN(0, INT32_MAX, kiriRegions, seen, seen),
};

/* Each cell is in the list of its region, and knows the one before it. */
static bool AreBorders(const kiriBorderCells* border)
{
    int64_t listed = 0;
    bool areFine = true;
    for (int32_t r = 0; areFine && r < border->first.count; ++r) {
        int32_t before = KIRI_NONE;
        for (int32_t c = border->first.data[r]; areFine && c != KIRI_NONE; c = border->cells.data[c].next) {
            areFine = c >= 0 && c < border->cells.count && listed < border->cells.count &&
                      border->cells.data[c].region == r && border->cells.data[c].before == before;
            before = areFine ? c : before;
            ++listed;
            if (!areFine) {
                break;
            }
        }
    }
    for (int32_t c = 0; areFine && c < border->cells.count; ++c) {
        listed -= border->cells.data[c].region != KIRI_NONE;
    }
    return areFine && listed == 0;
}

bool kiriTally_IsSum(const kiriTally* tally)
{
    const kiriExact sums[] = { tally->area, tally->u, tally->v, tally->uu, tally->uv, tally->vv };
    const int64_t most = INT64_C(1) << 61;
    bool isSum = true;
    for (int k = 0; k < 6; ++k) {
        isSum = isSum && sums[k].high >= -most && sums[k].high <= most && sums[k].low >= 0 && sums[k].low < 2 * most;
    }
    return isSum;
}

static bool AreTallies(const kiriRegions* regions)
{
    bool areFine = true;
    for (int32_t k = 0; areFine && k < regions->material.count; ++k) {
        areFine = kiriTally_IsSum(&regions->material.data[k]);
    }
    return areFine;
}

/* Those that were made since grid changes were cleared. */
static uint8_t* MarkNewCells(kiriCheck* check, const kiriGrid* grid)
{
    uint8_t* isNew = kiriCheck_Bytes(check, grid->cells.count);
    for (int32_t k = 0; isNew != NULL && k < grid->changes.made.count; ++k) {
        isNew[grid->changes.made.data[k]] = 1;
    }
    return isNew;
}

/* A site is in one cell. A cell that is gone, or was made since regions looked, may have the site of another. */
static bool AreSitesAt(kiriCheck* check, const kiriRegions* regions, const kiriGrid* grid)
{
    int32_t sites = regions->material.count;
    uint8_t *isPlaced = kiriCheck_Bytes(check, sites), *isNew = MarkNewCells(check, grid);
    bool areFine = isPlaced != NULL && isNew != NULL;
    for (int32_t c = 0; areFine && c < regions->siteAt.count; ++c) {
        int32_t site = regions->siteAt.data[c];
        areFine = site >= KIRI_NONE && site < sites;
        if (areFine && site != KIRI_NONE && kiriGrid_IsCell(grid, c) && !isNew[c]) {
            areFine = !isPlaced[site];
            isPlaced[site] = 1;
        }
    }
    kiriMemory_Free(&check->memory, isPlaced);
    kiriMemory_Free(&check->memory, isNew);
    return areFine;
}

static bool AreOwned(const kiriRegions* regions, const kiriGrid* grid)
{
    bool areOwned = regions->field.owner.count >= grid->cells.count;
    for (int32_t c = 0; areOwned && c < grid->cells.count; ++c) {
        areOwned = !kiriGrid_IsCell(grid, c) || regions->field.owner.data[c] != KIRI_NONE;
    }
    return areOwned;
}

/* What the grid has changed that regions follow: cells that they know, or are about to. */
static bool AreRowsOfRegions(const kiriRegions* regions, const kiriGrid* grid)
{
    int32_t cells = regions->siteAt.count;
    return cells == regions->field.distance.count && cells == regions->onBorder.count &&
           cells == regions->isChanged.count && cells == regions->border.cells.count && cells <= grid->cells.count &&
           (!regions->running || cells == grid->cells.count) && (!regions->following || regions->running);
}

bool kiriRegions_Check(const kiriRegions* regions, const kiriGrid* grid, kiriCheck* check, bool areAllOwned)
{
    check->count[KIRI_OF_REGIONS] = regions->material.count;
    return kiriCheck_That(check,
                          AreRowsOfRegions(regions, grid) && regions->material.count <= check->count[KIRI_OF_SITES]) &&
           kiriField_Check(&regions->field, check, regions->material.count, KIRI_FIELD_REPAIRS) &&
           kiriCheck_Object(check, RegionsMust, regions) &&
           kiriCheck_That(check, AreTallies(regions) && AreSitesAt(check, regions, grid) &&
                                     AreBorders(&regions->border) && (!areAllOwned || AreOwned(regions, grid)));
}
