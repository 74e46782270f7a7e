#include "kiri_field_check.h"
#include "kiri_grid_work.h"

static bool AreOpenSteps(const kiriGrid* grid, const kiriSquares* squares)
{
    bool areFine = true;
    for (int k = 0; k < KIRI_OPEN_STEPS; ++k) {
        areFine = areFine && grid->openTo[k] == kiriOpenSteps[k].u + kiriOpenSteps[k].v * squares->columns;
    }
    return areFine;
}

/* Two rows of squares are around it, each with a cell. */
static bool IsOpenRun(const kiriGrid* grid, const kiriSquareRows* rows, int32_t cell)
{
    enum { AROUND = 2 };
    int32_t square = grid->cells.data[cell].square, row = kiriSquareRows_At(rows, square),
            column = square - row * rows->columns;
    if (square == KIRI_NONE || grid->runs.data[cell].first != ~square || column < AROUND ||
        column >= rows->columns - AROUND || row < AROUND || row >= rows->rows - AROUND) {
        return false;
    }
    bool areThere = true;
    for (int k = 0; k < KIRI_OPEN_STEPS; ++k) {
        areThere &= grid->squareCell.data[square + grid->openTo[k]] != KIRI_NONE;
    }
    return areThere;
}

/* Those of a length lead to a square so far away. While the grid follows the mesh they may still lead to what is
   gone. */
static bool AreStepsOfLength(const kiriGrid* grid, int32_t columns, int32_t square, kiriSpan span, int32_t length,
                             int32_t squared)
{
    const kiriCell* cells = grid->cells.data;
    const uint32_t count = (uint32_t)grid->cells.count;
    const kiriStep *step = &grid->steps.data[span.first], *end = step + span.count;
    bool areFine = true;
    for (; areFine && step < end; ++step) {
        areFine =
            (uint32_t)step->cell < count && step->length == length && step->u * step->u + step->v * step->v == squared;
        int32_t to = areFine ? cells[step->cell].square : KIRI_NONE;
        areFine = areFine && (to == KIRI_NONE ? grid->work->running : to == square + step->u + step->v * columns);
    }
    return areFine;
}

static bool AreStoredSteps(const kiriGrid* grid, int32_t columns, int32_t cell)
{
    static const int32_t lengths[KIRI_STEP_LENGTHS] = { KIRI_UNIT, KIRI_UNIT_DIAGONAL, KIRI_UNIT_KNIGHT };
    static const int32_t squared[KIRI_STEP_LENGTHS] = { 1, 2, 5 };
    const kiriStepRun* run = &grid->runs.data[cell];
    bool areFine = true;
    for (int k = 0; areFine && k < KIRI_STEP_LENGTHS; ++k) {
        int32_t first = k > 0 ? run->end[k - 1] : run->first;
        kiriSpan span = { first, run->end[k] - first };
        areFine = span.count == 0 ||
                  AreStepsOfLength(grid, columns, grid->cells.data[cell].square, span, lengths[k], squared[k]);
    }
    return areFine;
}

static bool IsStoredRun(kiriCheck* check, const kiriGrid* grid, const kiriSquareRows* rows, kiriRooms* rooms,
                        int32_t cell)
{
    const kiriStepRun* run = &grid->runs.data[cell];
    int64_t count = (int64_t)run->end[KIRI_STEP_LENGTHS - 1] - run->first;
    bool isFine = run->first <= run->end[0] && run->end[0] <= run->end[1] && run->end[1] <= run->end[2] &&
                  (count == 0 || run->end[2] <= grid->steps.count);
    kiriSpan room = { run->first, (int32_t)(count > 0 && count < KIRI_OPEN_STEPS ? KIRI_OPEN_STEPS : count) };
    return kiriCheck_That(check, isFine) && kiriCheck_Span(check, rooms, room) &&
           kiriCheck_That(check, AreStoredSteps(grid, rows->columns, cell));
}

bool kiriGrid_CheckSteps(const kiriGrid* grid, const kiriSquares* squares, kiriCheck* check)
{
    kiriRooms rooms;
    kiriSquareRows rows = kiriSquareRows_Of(squares);
    bool areFine = kiriCheck_That(check, AreOpenSteps(grid, squares)) &&
                   kiriCheck_StartRooms(check, &rooms, &grid->steps, sizeof(kiriStep), &grid->stepRoom);
    for (int32_t c = 0; areFine && c < grid->cells.count; ++c) {
        const kiriStepRun* run = &grid->runs.data[c];
        bool isOpen = kiriStepRun_IsOpen(run);
        areFine =
            isOpen ? kiriCheck_That(check, IsOpenRun(grid, &rows, c)) : IsStoredRun(check, grid, &rows, &rooms, c);
    }
    kiriMemory_Free(&check->memory, areFine ? rooms.taken : NULL);
    return areFine;
}
