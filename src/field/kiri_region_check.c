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
enum { MARK_DIRTY = 1, MARK_LOGGED = 2, MARK_SETTLED = 4, MARK_PASSES = 8 };
enum { CHECK_RESTS, CHECK_CLEARS, CHECK_SEEDS, CHECK_SETTLES, CHECK_STAGES };
enum { CHECKED, FROM_CALLER }; /* cursors before the sweep */

static int32_t StageOf(const kiriField* field)
{
    return field->cursor[KIRI_STEP_LENGTHS];
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
    bool isDirty = field->dirty.count > 0, isSettled = field->settled.count > 0 || StageOf(field) == CHECK_SETTLES,
         isDirtyLong = field->dirty.capacity >= cells, isSettledLong = field->settled.capacity >= cells;
    return (isDirtyLong || !isDirty) && (isSettledLong || !isSettled) && (isDirtyLong || isSettledLong) &&
           !(isDirty && isSettled);
}

/* Each cell comes once. An item begins with its cell. */
static bool MarkOnce(uint8_t* marks, const void* items, int32_t count, size_t bytes, uint8_t mark)
{
    bool areOnce = true;
    for (int32_t k = 0; areOnce && k < count; ++k) {
        int32_t cell = *(const int32_t*)(const void*)((const char*)items + (size_t)k * bytes);
        areOnce = (marks[cell] & mark) == 0;
        marks[cell] |= mark;
    }
    return areOnce;
}

/* Marks say in which lists cells are: of those of dirty ones, until these are checked. Whether ways pass is asked about
   dirty cells that are not seen to yet. */
static bool AreFieldMarks(const kiriField* field, uint8_t* marks)
{
    static const uint8_t lists[CHECK_STAGES] = { MARK_DIRTY, MARK_DIRTY | MARK_LOGGED, MARK_LOGGED,
                                                 MARK_LOGGED | MARK_SETTLED };
    int32_t stage = StageOf(field), isCleared = stage == CHECK_CLEARS ? field->cursor[CHECKED] : 0,
            isSeeded = stage == CHECK_SEEDS ? field->cursor[CHECKED] : 0,
            end = stage == CHECK_RESTS ? field->dirty.count : field->cursor[FROM_CALLER];
    bool areFine = true;
    if (lists[stage] & MARK_DIRTY) {
        areFine = MarkOnce(marks, field->dirty.data + isCleared, field->dirty.count - isCleared, 4, MARK_DIRTY);
    }
    if (lists[stage] & MARK_LOGGED) {
        areFine = areFine && MarkOnce(marks, field->log.data, field->log.count, sizeof(kiriSeed), MARK_LOGGED);
    }
    if (lists[stage] & MARK_SETTLED) {
        areFine = areFine && MarkOnce(marks, field->settled.data, field->settled.count, 4, MARK_SETTLED);
    }
    for (int32_t k = isSeeded; stage != CHECK_SETTLES && k < end; ++k) {
        marks[field->dirty.data[k]] |= MARK_PASSES;
    }
    for (int32_t c = 0; areFine && c < field->marks.count; ++c) {
        uint8_t is = field->marks.data[c];
        areFine = (is & ~MARK_PASSES) == (marks[c] & ~MARK_PASSES) && (is & ~marks[c]) == 0;
    }
    return areFine;
}

/* Amid a repair. */
static bool IsAtCursors(const kiriField* field)
{
    int32_t stage = StageOf(field), checked = field->cursor[CHECKED], fromCaller = field->cursor[FROM_CALLER];
    bool isBefore = checked <= field->dirty.count && fromCaller <= field->dirty.count && field->settled.count == 0;
    switch (stage) {
    case CHECK_CLEARS:
        return isBefore;
    case CHECK_SEEDS:
        return isBefore && field->heap.capacity >= field->dirty.count && field->heap.count <= checked;
    default:
        return stage == CHECK_RESTS || field->dirty.count == 0;
    }
}

/* Each cell comes once to a list: so none must have any cell twice, or one that is not marked as being there. */
static bool AreListsOfField(const kiriField* field, kiriCheck* check)
{
    uint8_t* marks = kiriCheck_Bytes(check, field->distance.count);
    bool areFine = marks != NULL && IsAtCursors(field) && HaveListsRoom(field) && AreFieldMarks(field, marks);
    kiriMemory_Free(&check->memory, marks);
    return areFine;
}

/* What the field is used for has brought it there. `isEmptied`: block by block; cells that were settled are far
   again. */
static bool IsUsedAs(const kiriField* field, kiriFieldUse use)
{
    bool isAtRest = StageOf(field) == CHECK_RESTS, isDirty = field->dirty.count > 0, isLogged = field->log.count > 0,
         isSettled = field->settled.count > 0;
    switch (use) {
    case KIRI_FIELD_FLOODS:
        return isAtRest && !isDirty && !isLogged;
    case KIRI_FIELD_REPAIRS:
        return !isAtRest || (!isLogged && !isSettled);
    case KIRI_FIELD_READ:
        return isAtRest && !isDirty && !isSettled;
    case KIRI_FIELD_MARKED:
        return isAtRest && !isLogged && !isSettled;
    case KIRI_FIELD_EMPTIED:
        return isAtRest && !isDirty;
    default:
        return isAtRest && !isDirty && !isLogged && !isSettled;
    }
}

/* Of floods and repairs that are at hand: cells have distances. */
static bool AreSettledNear(const kiriField* field)
{
    bool areNear = true;
    for (int32_t k = 0; areNear && k < field->settled.count; ++k) {
        areNear = field->distance.data[field->settled.data[k]] != KIRI_FAR;
    }
    return areNear;
}

bool kiriField_Check(const kiriField* field, kiriCheck* check, int64_t owners, kiriFieldUse use)
{
    int64_t cells = check->count[KIRI_OF_CELLS];
    kiriIndices settled = field->settled;
    check->count[KIRI_OF_OWNERS] = owners;
    check->count[KIRI_OF_CELLS] = cells < field->distance.count ? cells : field->distance.count;
    bool isFine = kiriCheck_Object(check, FieldMust, field) &&
                  kiriCheck_That(check, StageOf(field) < CHECK_STAGES && IsUsedAs(field, use) &&
                                            AreValues(field, check->count[KIRI_OF_CELLS], owners < INT32_MAX)) &&
                  kiriCheck_That(check, AreListsOfField(field, check)) &&
                  kiriCheck_Distinct(check, &settled, field->distance.count) &&
                  kiriCheck_That(check, use == KIRI_FIELD_EMPTIED || AreSettledNear(field));
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
                                     field->log.count == 0 && StageOf(field) == CHECK_RESTS) &&
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
           (!regions->running || cells == grid->cells.count) &&
           (!regions->following || (regions->running && !regions->flooding));
}

/* Between updates nothing is at hand; and of one from scratch there is only what has been flooded. */
static kiriFieldUse UseOfRegions(const kiriRegions* regions)
{
    return !regions->running    ? KIRI_FIELD_RESTS
           : regions->flooding  ? KIRI_FIELD_FLOODS
           : regions->following ? KIRI_FIELD_READ
                                : KIRI_FIELD_REPAIRS;
}

/* Cells are in `changes` once, and those on borders in the list of their region: that which they had before an update
   that is at hand. */
static bool AreCellsOfRegions(kiriCheck* check, const kiriRegions* regions, const kiriGrid* grid)
{
    uint8_t* isChanged = kiriCheck_Bytes(check, regions->isChanged.count);
    bool areFine = isChanged != NULL;
    for (int32_t k = 0; areFine && k < regions->changes.count; ++k) {
        int32_t cell = regions->changes.data[k].cell;
        areFine = kiriGrid_IsCell(grid, cell) && !isChanged[cell];
        isChanged[cell] = 1;
    }
    for (int32_t c = 0; areFine && c < regions->isChanged.count; ++c) {
        int32_t region = regions->border.cells.data[c].region;
        areFine = regions->isChanged.data[c] == isChanged[c] &&
                  regions->onBorder.data[c] == (region != KIRI_NONE) &&
                  (regions->running || region == KIRI_NONE || region == regions->field.owner.data[c]);
    }
    kiriMemory_Free(&check->memory, isChanged);
    return areFine;
}

bool kiriRegions_Check(const kiriRegions* regions, const kiriGrid* grid, kiriCheck* check, bool areAllOwned)
{
    check->count[KIRI_OF_REGIONS] = regions->material.count;
    return kiriCheck_That(check, AreRowsOfRegions(regions, grid) &&
                                     regions->material.count <= check->count[KIRI_OF_SITES]) &&
           kiriField_Check(&regions->field, check, regions->material.count, UseOfRegions(regions)) &&
           kiriCheck_Object(check, RegionsMust, regions) &&
           kiriCheck_That(check, AreTallies(regions) && AreBorders(&regions->border) &&
                                     AreCellsOfRegions(check, regions, grid) &&
                                     (!areAllOwned || AreOwned(regions, grid)));
}
