#include "kiri_field_check.h"
#include "kiri_place_work.h"

/* ---- Rules ------------------------------------------------------------------------------------------------------ */

static const kiriMust IsPlacerCell[] = { KIRI_INDEX(KIRI_OF_CELLS, kiriSpan, first, first) };

static const kiriMust SlitEndMust[] = {
    KIRI_REALS(kiriSlitEnd, at, along),
    KIRI_INDEX(KIRI_OF_CELLS, kiriSlitEnd, cell, cell),
};

static const kiriMust TakenMust[] = {
    KIRI_ITEMS_MUST(kiriPlacer, cells, IsPlacerCell),
};

static const kiriMust EndsMust[] = {
    KIRI_ITEMS_MUST(kiriPlacer, ends, SlitEndMust),
};

static const kiriMust PlacerMust[] = {
    KIRI_ITEMS_MUST(kiriPlacer, sites, kiriSiteMust),
    KIRI_ITEMS_MUST(kiriPlacer, cells, IsPlacerCell),
    KIRI_ITEMS_MUST(kiriPlacer, ends, SlitEndMust),
    KIRI_REALS(kiriPlacer, reach, closeness),
};

static const kiriMust TargetMust[] = {
    KIRI_REALS(SiteTarget, center, center),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, SiteTarget, cell, cell),
    KIRI_REALS(SiteTarget, distance, distance),
};

static const kiriMust SampleBlockMust[] = {
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, SampleBlock, cell, cell),
};

enum { MOST_CLOSE = 64 }; /* four times, see kiri_place.c */

static const kiriMust PlacerWorkMust[] = {
    KIRI_COUNTS(kiriPlacerWork, reach, reach),
    KIRI_WITHIN(0, MOST_CLOSE, kiriPlacerWork, closest, closest),
    KIRI_ITEMS_MUST(kiriPlacerWork, blocks, SampleBlockMust),
    KIRI_WITHIN(PLACER_RESTS, PLACER_STAGES - 1, kiriPlacerWork, stage, stage),
    KIRI_WITHIN(0, INT32_MAX, kiriPlacerWork, cursor, cursor),
    KIRI_COUNTS(kiriPlacerWork, due, due),
    KIRI_WITHIN(0, INT32_MAX, kiriPlacerWork, left, left),
    KIRI_INDEX_OR_NONE(KIRI_OF_CELLS, kiriPlacerWork, farthest, farthest),
    KIRI_WITHIN(0, INT32_MAX - 1, kiriPlacerWork, lost, round),
};

/* Are there distances from new sites? */
static bool HasFresh(const kiriPlacerWork* work)
{
    return work->stage >= FLOOD_NEW && work->stage <= AIM;
}

/* Targets of new sites, while these are moved; or of one by itself. */
static int32_t CountTargets(const kiriPlacer* placer)
{
    PlacerStage stage = placer->work->stage;
    bool isMoving = stage >= FLOOD_ALL_NEW && stage <= AIM;
    return isMoving ? placer->sites.count - placer->oldCount : stage >= SUM_PART;
}

#define MOST_MATERIAL (INT64_C(1) << 60)

/* Sums hold; and a center has been found of something. */
static bool IsTarget(kiriCheck* check, const kiriPlacerWork* work, const SiteTarget* target)
{
    bool isSummed = work->stage == AIM_NEAR || work->stage == AIM || work->stage == AIM_PART;
    return kiriCheck_Object(check, TargetMust, target) && target->area >= (isSummed && !target->isFound) &&
           target->area <= MOST_MATERIAL && target->u >= -MOST_MATERIAL && target->u <= MOST_MATERIAL &&
           target->v >= -MOST_MATERIAL && target->v <= MOST_MATERIAL;
}

/* The cell that a new site goes to is one of its own: no two go to one. */
static bool IsOwnTarget(const kiriPlacer* placer, int32_t k)
{
    const kiriPlacerWork* work = placer->work;
    int32_t cell = work->targets.data[k].cell, holder = cell == KIRI_NONE ? KIRI_NONE : work->holds.data[cell];
    bool isFree = holder < 0 && cell != KIRI_NONE;
    if (work->stage == SUM_PART || work->stage == AIM_PART) {
        return cell == KIRI_NONE || holder == KIRI_CELL_FREE;
    }
    return cell == KIRI_NONE ||
           placer->oldCount + k ==
               (isFree && kiriPlacerWork_IsNearerThanOld(work, cell) ? work->fresh.owner.data[cell] : holder);
}

/* A site is in the cell that says so, and in no other. */
static bool AreHeld(const kiriPlacer* placer, const kiriMeshData* mesh)
{
    const int32_t* holds = placer->work->holds.data;
    int32_t held = 0;
    bool areFine = true;
    for (int32_t k = 0; k < placer->cells.count; ++k) {
        held += holds[placer->cells.data[k]] >= 0;
    }
    for (int32_t i = 0; areFine && i < placer->sites.count; ++i) {
        areFine = holds[placer->sites.data[i].cell] == i && kiriSite_IsOver(&placer->sites.data[i], mesh);
    }
    return areFine && held == placer->sites.count;
}

/* Cells of the part live, and all that a step leads to from one is of the part: nobody else is asked anything. */
static bool IsPart(kiriCheck* check, const kiriPlacer* placer, const kiriGrid* grid, const kiriMeshData* mesh)
{
    const kiriPlacerWork* work = placer->work;
    uint8_t* isPart = kiriCheck_Bytes(check, grid->cells.count);
    bool isFine = isPart != NULL;
    for (int32_t k = 0; isFine && k < placer->cells.count; ++k) {
        int32_t cell = placer->cells.data[k];
        isFine = kiriGrid_IsCell(grid, cell) && work->holds.data[cell] >= -2 &&
                 work->holds.data[cell] < placer->sites.count && work->sampled.data[cell] >= 0;
        isPart[cell] = 1;
    }
    for (int32_t k = 0; isFine && k < placer->cells.count; ++k) {
        kiriSteps steps;
        kiriGrid_GetSteps(grid, placer->cells.data[k], &steps);
        for (int32_t s = 0; isFine && s < steps.end[KIRI_STEP_LENGTHS - 1]; ++s) {
            isFine = isPart[steps.data[s].cell];
        }
    }
    for (int32_t k = 0; isFine && k < placer->sites.count; ++k) {
        isFine = isPart[placer->sites.data[k].cell];
    }
    isFine = isFine && AreHeld(placer, mesh);
    for (int32_t k = 0; isFine && HasFresh(work) && k < work->fresh.settled.count; ++k) {
        isFine = isPart[work->fresh.settled.data[k]];
    }
    for (int32_t k = 0; isFine && k < work->blocks.count; ++k) {
        isFine = work->blocks.data[k].cell == KIRI_NONE || isPart[work->blocks.data[k].cell];
    }
    for (int32_t k = 0; isFine && k < CountTargets(placer); ++k) {
        isFine = IsTarget(check, work, &work->targets.data[k]) &&
                 (work->targets.data[k].cell == KIRI_NONE || isPart[work->targets.data[k].cell]) &&
                 IsOwnTarget(placer, k);
    }
    kiriMemory_Free(&check->memory, isPart);
    return kiriCheck_That(check, isFine);
}

enum { SAMPLED_CELLS = 512 }; /* a block: see kiri_place.c */

/* Rows are as long as cells and sites are many. */
static bool AreRowsOfPlacer(const kiriPlacer* placer, const kiriGrid* grid)
{
    const kiriPlacerWork* work = placer->work;
    int64_t fresh = (int64_t)placer->sites.count - placer->oldCount, cells = grid->cells.count;
    return work->sampled.count == cells && work->holds.count == cells && work->hasOld == (work->old != NULL) &&
           work->hasOld == (placer->oldCount > 0) &&
           (work->old != &work->flooded || work->flooded.distance.count == cells) &&
           work->fresh.distance.count == cells && (!work->hasOld || work->old->distance.count >= cells) &&
           placer->oldCount >= 0 && fresh >= 0 && placer->cells.count > 0 &&
           fresh + work->left <= (work->targets.count > 0 ? work->targets.count : 1) && work->targets.count > 0 &&
           placer->sites.capacity >= placer->sites.count + (int64_t)work->left &&
           work->blocks.count == placer->cells.count / SAMPLED_CELLS + 1 &&
           (work->reach == 0 || work->ends.distance.count == cells) && (work->stage != FLOOD_NEW || fresh > 0) &&
           (work->stage != LOWER || fresh > 0);
}

/* Marks are of the piece that is being taken, or of one that was given up: no others are cleared before they are
   used. */
static bool AreMarksOfTaken(const kiriPlacer* placer)
{
    const kiriPlacerWork* work = placer->work;
    int32_t marked = 0;
    for (int32_t c = 0; c < work->marks.count; ++c) {
        marked += work->marks.data[c] != 0;
    }
    return marked == (work->isTaking ? placer->cells.count : 0);
}

/* They live; and of those that were looked at, the cells beside them were taken, too. */
static bool AreTakenCells(const kiriPlacer* placer, const kiriGrid* grid)
{
    const kiriPlacerWork* work = placer->work;
    bool areFine = placer->cells.count > 0;
    for (int32_t k = 0; areFine && k < placer->cells.count; ++k) {
        kiriSteps steps;
        areFine = kiriGrid_IsCell(grid, placer->cells.data[k]);
        kiriGrid_GetStepsTo(grid, placer->cells.data[k], 1, &steps);
        for (int32_t s = 0; areFine && work->isTaking && k < work->cursor && s < steps.end[0]; ++s) {
            areFine = work->marks.data[steps.data[s].cell] != 0;
        }
    }
    return areFine;
}

/* Cells of a piece that is being taken, and their ends once all cells are there; of one that was given up, marks are
   cleared. */
static bool IsTaken(kiriCheck* check, const kiriPlacer* placer, const kiriGrid* grid, bool isAsked)
{
    const kiriPlacerWork* work = placer->work;
    kiriIndices cells = { placer->cells.data, placer->cells.count, placer->cells.capacity };
    bool isFine = !work->isTaking || kiriCheck_Marked(check, &cells, work->marks.count, work->marks.data, 1);
    isFine = isFine && kiriCheck_That(check, AreMarksOfTaken(placer));
    if (!isFine || !isAsked) {
        return isFine;
    }
    return kiriCheck_Object(check, TakenMust, placer) &&
           kiriCheck_That(check, work->cursor >= 0 && (!work->isTaking || work->marks.count == grid->cells.count)) &&
           kiriCheck_That(check, AreTakenCells(placer, grid)) &&
           (work->isTaking || kiriCheck_Object(check, EndsMust, placer));
}

bool kiriPlacer_Check(const kiriPlacer* placer, const kiriGrid* grid, const kiriMeshData* mesh, kiriCheck* check,
                      bool isTaking, bool isPlacing)
{
    const kiriPlacerWork* work = placer->work;
    if (work == NULL) {
        return true;
    }
    /* What rests, or was given up, is started anew before it is used again, and may be of a grid that is no more. */
    bool isFine = kiriField_CheckLeft(&work->flooded, check) && kiriField_CheckLeft(&work->ends, check) &&
                  kiriField_CheckLeft(&work->fresh, check) && IsTaken(check, placer, grid, isTaking);
    if (!isFine || !isPlacing) {
        return isFine;
    }
    isFine = kiriCheck_Object(check, PlacerMust, placer) && kiriCheck_Object(check, PlacerWorkMust, work);
    return isFine && kiriCheck_That(check, work->stage != PLACER_RESTS && AreRowsOfPlacer(placer, grid)) &&
           (!HasFresh(work) || kiriField_Check(&work->fresh, check, placer->sites.count, KIRI_FIELD_FLOODS)) &&
           IsPart(check, placer, grid, mesh) &&
           (work->old != &work->flooded ||
            kiriField_Check(&work->flooded, check, placer->sites.count, KIRI_FIELD_FLOODS)) &&
           (work->reach == 0 || kiriField_Check(&work->ends, check, placer->sites.count, KIRI_FIELD_FLOODS));
}
