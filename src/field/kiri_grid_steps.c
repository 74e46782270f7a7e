#include "kiri_grid_work.h"

#include <string.h>

/* SetSteps compares bytes. */
typedef char StepHasNoPadding[sizeof(kiriStep) == 8 ? 1 : -1];

/* Steps touch the squares up to two rows away, in row v so many on each side of the column. */
enum { STEP_ROWS = 2 };

static int32_t StepColumns(int32_t v)
{
    return v == -STEP_ROWS || v == STEP_ROWS ? 1 : STEP_ROWS;
}

/* Is the square whole, and all those around that a step may touch? */
static bool IsWholeAround(const kiriGrid* grid, const kiriSquares* squares, int32_t square)
{
    int32_t column = square % squares->columns, row = square / squares->columns;
    if (column < STEP_ROWS || column >= squares->columns - STEP_ROWS || row < STEP_ROWS ||
        row >= squares->rows - STEP_ROWS) {
        return false;
    }
    for (int32_t v = -STEP_ROWS; v <= STEP_ROWS; ++v) {
        const uint8_t* whole = &grid->whole.data[square + v * squares->columns];
        for (int32_t u = -StepColumns(v); u <= StepColumns(v); ++u) {
            if (!whole[u]) {
                return false;
            }
        }
    }
    return true;
}

/* ---- Room for steps ---------------------------------------------------------------------------------------------- */

/* At least for as many as most cells have, so that most runs never move. */
static int32_t RoomFor(int32_t count)
{
    return count == 0 ? 0 : kiriMax(count, KIRI_OPEN_STEPS);
}

/* Room for so many steps; false for memory. */
static bool SetStepCount(kiriGrid* grid, kiriMemory* memory, int32_t c, int32_t count)
{
    KIRI_ASSERT(c >= 0 && c < grid->runs.count);
    kiriStepRun* run = &grid->runs.data[c];
    bool isOpen = kiriStepRun_IsOpen(run);
    kiriSpan span = { isOpen ? 0 : run->first, RoomFor(isOpen ? 0 : run->end[KIRI_STEP_LENGTHS - 1] - run->first) };
    bool ok = kiriSpan_Resize(&span, &grid->stepRoom, memory, &grid->steps, sizeof(kiriStep), RoomFor(count));
    run->first = span.first;
    run->end[0] = run->end[1] = run->end[2] = span.first + count;
    return ok;
}

void kiriGrid_RemoveSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell)
{
    bool ok = SetStepCount(grid, memory, cell, 0);
    KIRI_ASSERT(ok); /* it shrinks */
    (void)ok;
}

/* Are these the steps that the cell has? */
static bool HasSteps(const kiriGrid* grid, int32_t c, int32_t straight, int32_t near)
{
    const kiriGridWork* work = grid->work;
    kiriSteps has;
    kiriGrid_GetSteps(grid, c, &has);
    return has.end[0] == straight && has.end[1] == near && has.end[2] == work->steps.count &&
           (has.end[2] == 0 || memcmp(has.data, work->steps.data, sizeof(kiriStep) * (size_t)work->steps.count) == 0);
}

/* The cell's steps become those in `work`: so many straight ones, and so many straight and diagonal ones. */
static bool SetSteps(kiriGrid* grid, kiriMemory* memory, int32_t c, int32_t straight, int32_t near)
{
    const kiriGridWork* work = grid->work;
    kiriStepRun* run = &grid->runs.data[c];
    KIRI_ASSERT(kiriGrid_IsCell(grid, c) && 0 <= straight && straight <= near && near <= work->steps.count);
    size_t bytes = sizeof(kiriStep) * (size_t)work->steps.count;
    if (HasSteps(grid, c, straight, near)) {
        return true;
    }
    if (!SetStepCount(grid, memory, c, work->steps.count)) {
        return false;
    }
    if (bytes > 0) {
        memcpy(&grid->steps.data[run->first], work->steps.data, bytes);
    }
    run->end[0] = run->first + straight;
    run->end[1] = run->first + near;
    return kiriGrid_RecordSteps(grid, memory, c);
}

/* ---- Steps ------------------------------------------------------------------------------------------------------- */

static bool MarkStepsDirty(kiriGrid* grid, kiriMemory* memory, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < grid->squareCell.count);
    if (kiriGridWork_IsFlagged(grid->work, square, KIRI_SQUARE_STEPS_DIRTY)) {
        return true;
    }
    for (int32_t c = grid->squareCell.data[square]; c != KIRI_NONE; c = grid->cells.data[c].next) {
        if (!kiriArray_Push(memory, &grid->work->stepsDirty, c)) {
            return false;
        }
    }
    return kiriGridWork_Flag(grid->work, memory, square, KIRI_SQUARE_STEPS_DIRTY);
}

kiriProgress kiriGrid_SpreadDirty(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    (void)quota;
    const kiriSquares* squares = &mesh->squares;
    int32_t square = work->linksDirty.data[item], column = square % squares->columns, row = square / squares->columns;
    for (int32_t v = kiriMax(-STEP_ROWS, -row); v <= STEP_ROWS && row + v < squares->rows; ++v) {
        int32_t reach = StepColumns(v);
        for (int32_t u = kiriMax(-reach, -column); u <= reach && column + u < squares->columns; ++u) {
            if (!MarkStepsDirty(grid, mesh->memory, square + v * squares->columns + u)) {
                return KIRI_FAILED;
            }
        }
    }
    work->due += KIRI_GRID_STEPS;
    return KIRI_DONE;
}

const kiriStep kiriOpenSteps[KIRI_OPEN_STEPS] = {
    { 0, KIRI_UNIT, 0, -1 },          { 0, KIRI_UNIT, -1, 0 },           { 0, KIRI_UNIT, 1, 0 },
    { 0, KIRI_UNIT, 0, 1 },           { 0, KIRI_UNIT_DIAGONAL, -1, -1 }, { 0, KIRI_UNIT_DIAGONAL, 1, -1 },
    { 0, KIRI_UNIT_DIAGONAL, -1, 1 }, { 0, KIRI_UNIT_DIAGONAL, 1, 1 },   { 0, KIRI_UNIT_KNIGHT, -1, -2 },
    { 0, KIRI_UNIT_KNIGHT, 1, -2 },   { 0, KIRI_UNIT_KNIGHT, -2, -1 },   { 0, KIRI_UNIT_KNIGHT, 2, -1 },
    { 0, KIRI_UNIT_KNIGHT, -2, 1 },   { 0, KIRI_UNIT_KNIGHT, 2, 1 },     { 0, KIRI_UNIT_KNIGHT, -1, 2 },
    { 0, KIRI_UNIT_KNIGHT, 1, 2 },
};

static bool AddStep(kiriGrid* grid, kiriMemory* memory, kiriStep step)
{
    return kiriArray_Push(memory, &grid->work->steps, step);
}

/* Adds steps that the cell has, from one length up to another. */
static bool AddSteps(kiriGrid* grid, kiriMemory* memory, const kiriSteps* steps, int32_t from, int32_t end)
{
    kiriGridWork* work = grid->work;
    int32_t count = work->steps.count;
    if (!kiriArray_Resize(memory, &work->steps, (int64_t)count + end - from)) {
        return false;
    }
    if (from < end) {
        memcpy(&work->steps.data[count], &steps->data[from], sizeof(kiriStep) * (size_t)(end - from));
    }
    return true;
}

void kiriGrid_StartSteps(kiriGrid* grid, const kiriMeshData* mesh)
{
    for (int k = 0; k < KIRI_OPEN_STEPS; ++k) {
        grid->openTo[k] = kiriOpenSteps[k].v * mesh->squares.columns + kiriOpenSteps[k].u;
    }
}

/* Puts the steps of an open cell into `work`. */
static bool ListOpenSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    KIRI_ASSERT(c >= 0 && c < grid->cells.count);
    int32_t square = grid->cells.data[c].square;
    grid->work->steps.count = 0;
    for (int k = 0; k < KIRI_OPEN_STEPS; ++k) {
        kiriStep step = kiriOpenSteps[k];
        step.cell = grid->squareCell.data[square + grid->openTo[k]];
        KIRI_ASSERT(kiriGrid_IsCell(grid, step.cell));
        if (!AddStep(grid, memory, step)) {
            return false;
        }
    }
    return true;
}

/* A cell amid whole squares, which is open. If it was, its steps are the same: a square that stays whole keeps its
   cell. */
static bool MakeOpenSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    KIRI_ASSERT(c >= 0 && c < grid->runs.count);
    if (kiriStepRun_IsOpen(&grid->runs.data[c])) {
        return true;
    }
    if (!ListOpenSteps(grid, memory, c)) {
        return false;
    }
    bool same = HasSteps(grid, c, 4, 8);
    kiriGrid_RemoveSteps(grid, memory, c);
    grid->runs.data[c].first = ~grid->cells.data[c].square;
    return same || kiriGrid_RecordSteps(grid, memory, c);
}

/* Does step a come before b? Both from the same cell: the way tells the order of squares. */
static bool ComesBefore(const kiriGrid* grid, kiriStep a, kiriStep b)
{
    if (a.length != b.length) {
        return a.length < b.length;
    }
    if (a.v != b.v) {
        return a.v < b.v;
    }
    return a.u != b.u ? a.u < b.u : grid->cells.data[a.cell].triangle < grid->cells.data[b.cell].triangle;
}

static void SortSteps(kiriGrid* grid, int32_t from)
{
    kiriStep* steps = grid->work->steps.data;
    for (int32_t i = from + 1; i < grid->work->steps.count; ++i) {
        kiriStep step = steps[i];
        int32_t j = i;
        for (; j > from && ComesBefore(grid, step, steps[j - 1]); --j) {
            steps[j] = steps[j - 1];
        }
        steps[j] = step;
    }
}

static kiriStep Straight(const kiriFace* face, int32_t from)
{
    int8_t way = face->cell[0] == from ? 1 : -1;
    int32_t axis = kiriFace_Axis(face);
    return (kiriStep){ kiriFace_Other(face, from), KIRI_UNIT, axis == 0 ? way : 0, axis == 1 ? way : 0 };
}

/* One step after another. */
static kiriStep Joined(kiriStep a, kiriStep b, int16_t length)
{
    return (kiriStep){ b.cell, length, (int8_t)(a.u + b.u), (int8_t)(a.v + b.v) };
}

/* A step counts where two ways lead to its cell, and counts once: the first way marks the cell with the number that
   this returns, the second way finds it and makes it one more. */
static int32_t NewMark(kiriGridWork* work)
{
    if (work->lastMark > INT32_MAX - 4) { /* after as many as cells in a thousand large cuts: begins anew */
        memset(work->mark.data, 0, sizeof(*work->mark.data) * (size_t)work->mark.count);
        work->lastMark = 0;
    }
    work->lastMark += 2;
    return work->lastMark;
}

static bool AddStraightSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    KIRI_ASSERT(c >= 0 && c < grid->cells.count);
    for (int32_t f = grid->cells.data[c].firstFace; f != KIRI_NONE; f = kiriFace_Next(&grid->faces.data[f], c)) {
        if (!AddStep(grid, memory, Straight(&grid->faces.data[f], c))) {
            return false;
        }
    }
    return true;
}

/* To cells reached along u, then v, and also along v, then u: both ways around the corner. */
static bool AddDiagonalSteps(kiriGrid* grid, kiriMemory* memory, int32_t c)
{
    const kiriFace* faces = grid->faces.data;
    const kiriCell* cells = grid->cells.data;
    int32_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    for (int axis = 0; axis < 2; ++axis) {
        for (int32_t f = cells[c].firstFace; f != KIRI_NONE; f = kiriFace_Next(&faces[f], c)) {
            int32_t between = kiriFace_Other(&faces[f], c);
            int32_t g = kiriFace_Axis(&faces[f]) == axis ? cells[between].firstFace : KIRI_NONE;
            for (; g != KIRI_NONE; g = kiriFace_Next(&faces[g], between)) {
                grid->work->due += KIRI_GRID_WAY;
                if (kiriFace_Axis(&faces[g]) == axis) {
                    continue;
                }
                kiriStep step = Joined(Straight(&faces[f], c), Straight(&faces[g], between), KIRI_UNIT_DIAGONAL);
                if (axis == 0) {
                    mark[step.cell] = first;
                } else if (mark[step.cell] == first) {
                    mark[step.cell] = first + 1;
                    if (!AddStep(grid, memory, step)) {
                        return false;
                    }
                }
            }
        }
    }
    return true;
}

/* The knights stay what they are until all diagonal steps are made. */
kiriProgress kiriGrid_MakeNearSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    kiriGridWork* work = grid->work;
    (void)quota;
    kiriMemory* memory = mesh->memory;
    int32_t c = work->stepsDirty.data[item];
    kiriSteps has;
    work->steps.count = 0;
    work->due += KIRI_GRID_STEPS;
    if (IsWholeAround(grid, &mesh->squares, grid->cells.data[c].square)) {
        return MakeOpenSteps(grid, memory, c) ? KIRI_DONE : KIRI_FAILED;
    }
    if (!AddStraightSteps(grid, memory, c)) {
        return KIRI_FAILED;
    }
    int32_t straight = work->steps.count;
    if (!AddDiagonalSteps(grid, memory, c)) {
        return KIRI_FAILED;
    }
    int32_t near = work->steps.count;
    SortSteps(grid, 0);
    kiriGrid_GetSteps(grid, c, &has);
    return AddSteps(grid, memory, &has, has.end[1], has.end[2]) && SetSteps(grid, memory, c, straight, near) &&
                   kiriArray_Push(memory, &work->knightsDirty, c)
               ? KIRI_DONE
               : KIRI_FAILED;
}

/* Marks the cells reached straight, then diagonally. */
static void MarkKnightSteps(kiriGrid* grid, const kiriSteps* steps, int32_t mark)
{
    for (int32_t i = 0; i < steps->end[0]; ++i) {
        kiriSteps on;
        kiriGrid_GetStepsTo(grid, steps->data[i].cell, 2, &on);
        grid->work->due += on.end[1] - on.end[0];
        for (int32_t j = on.end[0]; j < on.end[1]; ++j) {
            if (steps->data[i].u == on.data[j].u || steps->data[i].v == on.data[j].v) {
                grid->work->mark.data[on.data[j].cell] = mark;
            }
        }
    }
}

/* To cells reached straight, then diagonally, and also diagonally, then straight: a slit is never jumped. */
static bool AddKnightSteps(kiriGrid* grid, kiriMemory* memory, const kiriSteps* steps)
{
    int32_t *mark = grid->work->mark.data, first = NewMark(grid->work);
    MarkKnightSteps(grid, steps, first);
    for (int32_t i = steps->end[0]; i < steps->end[1]; ++i) {
        kiriSteps on;
        kiriGrid_GetStepsTo(grid, steps->data[i].cell, 2, &on);
        for (int32_t j = 0; j < on.end[0]; ++j) {
            if (mark[on.data[j].cell] == first) {
                mark[on.data[j].cell] = first + 1;
                if (!AddStep(grid, memory, Joined(steps->data[i], on.data[j], KIRI_UNIT_KNIGHT))) {
                    return false;
                }
            }
        }
    }
    return true;
}

kiriProgress kiriGrid_MakeKnightSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota)
{
    KIRI_ASSERT(item >= 0 && item < grid->work->knightsDirty.count);
    (void)quota;
    kiriMemory* memory = mesh->memory;
    int32_t c = grid->work->knightsDirty.data[item];
    kiriSteps has;
    kiriGrid_GetSteps(grid, c, &has);
    grid->work->due += KIRI_GRID_STEPS;
    grid->work->steps.count = 0;
    if (!AddSteps(grid, memory, &has, 0, has.end[1]) || !AddKnightSteps(grid, memory, &has)) {
        return KIRI_FAILED;
    }
    SortSteps(grid, has.end[1]);
    return SetSteps(grid, memory, c, has.end[0], has.end[1]) ? KIRI_DONE : KIRI_FAILED;
}
