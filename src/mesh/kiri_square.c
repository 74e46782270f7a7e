#include "kiri_square.h"

#include <string.h>

typedef struct SquareBox {
    int32_t firstColumn, lastColumn, firstRow, lastRow;
} SquareBox;

static int64_t CeilDivide(int64_t a, int64_t b)
{
    return (a + b - 1) / b;
}

static int32_t Min3(int32_t a, int32_t b, int32_t c)
{
    return kiriMin(kiriMin(a, b), c);
}

static int32_t Max3(int32_t a, int32_t b, int32_t c)
{
    return kiriMax(kiriMax(a, b), c);
}

/* Empty squares, whose number and side are set. */
static bool AllocateSquares(kiriSquares* squares, kiriMemory* memory)
{
    squares->perStep = 1.0 / squares->side;
    squares->freeNode = KIRI_NONE;
    int64_t count = (int64_t)squares->columns * squares->rows;
    squares->head = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    squares->vertexHead = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    squares->isDirty = kiriMemory_Alloc(memory, count);
    if (squares->head == NULL || squares->vertexHead == NULL || squares->isDirty == NULL ||
        !kiriArray_ReserveJust(memory, &squares->dirty, count)) {
        return false;
    }
    for (int64_t i = 0; i < count; ++i) {
        squares->head[i] = squares->vertexHead[i] = KIRI_NONE;
        squares->isDirty[i] = 0;
    }
    return true;
}

bool kiriSquares_Init(kiriSquares* squares, kiriMemory* memory, kiriLatticePoint extent, int32_t resolution)
{
    int64_t longer = kiriMax(extent.x, extent.y);
    memset(squares, 0, sizeof(*squares));
    squares->side = (int32_t)(2 * CeilDivide(longer + 2, 2 * (int64_t)resolution));
    squares->columns = (int32_t)CeilDivide((int64_t)extent.x + 2, squares->side);
    squares->rows = (int32_t)CeilDivide((int64_t)extent.y + 2, squares->side);
    return AllocateSquares(squares, memory);
}

/* The column or row of an even coordinate, not negative, counted from the lower border of the whole sheet. The quotient
   is at least 1 / side from a whole number: so its rounding does not show, and the multiplication is as good as a
   division and faster. */
static int32_t LineOf(const kiriSquares* squares, int32_t coordinate)
{
    return (int32_t)(squares->perStep * ((double)coordinate + 1.0));
}

/* Of `count` columns or rows from `first` on, those from a coordinate to another, and some beside them. */
static void TakeLines(const kiriSquares* like, int32_t lower, int32_t upper, int32_t* first, int32_t* count)
{
    int32_t end = *first + *count, from = LineOf(like, lower) - KIRI_SQUARES_BESIDE,
            to = LineOf(like, upper) + KIRI_SQUARES_BESIDE + 1;
    *first = kiriMax(from, *first);
    *count = kiriMin(to, end) - *first;
    KIRI_ASSERT(*count > 0);
}

bool kiriSquares_InitPart(kiriSquares* squares, kiriMemory* memory, const kiriSquares* like, kiriLatticePoint lower,
                          kiriLatticePoint upper)
{
    memset(squares, 0, sizeof(*squares));
    squares->side = like->side;
    squares->columns = like->columns;
    squares->rows = like->rows;
    squares->firstColumn = like->firstColumn;
    squares->firstRow = like->firstRow;
    TakeLines(like, lower.x, upper.x, &squares->firstColumn, &squares->columns);
    TakeLines(like, lower.y, upper.y, &squares->firstRow, &squares->rows);
    return AllocateSquares(squares, memory);
}

/* The squares that the box of the corners overlaps. Corners are even and grid lines odd, so no corner is on a line. */
static SquareBox BoxOf(const kiriSquares* squares, const kiriLatticePoint c[3])
{
    SquareBox range;
    range.firstColumn = LineOf(squares, Min3(c[0].x, c[1].x, c[2].x)) - squares->firstColumn;
    range.lastColumn = LineOf(squares, Max3(c[0].x, c[1].x, c[2].x)) - squares->firstColumn;
    range.firstRow = LineOf(squares, Min3(c[0].y, c[1].y, c[2].y)) - squares->firstRow;
    range.lastRow = LineOf(squares, Max3(c[0].y, c[1].y, c[2].y)) - squares->firstRow;
    KIRI_ASSERT(range.firstColumn >= 0 && range.lastColumn < squares->columns);
    KIRI_ASSERT(range.firstRow >= 0 && range.lastRow < squares->rows);
    return range;
}

static kiriLatticePoint CornerAt(const kiriSquares* squares, int32_t column, int32_t row)
{
    KIRI_ASSERT(column >= 0 && column < squares->columns && row >= 0 && row < squares->rows);
    kiriLatticePoint corner = { (squares->firstColumn + column) * squares->side - 1,
                                (squares->firstRow + row) * squares->side - 1 };
    return corner;
}

/* Separating axes: those of the square are its lines against the triangle's box, those of the triangle are its edges
   against the corner of the square that is farthest to their left. The caller has done the former. */
static bool EdgesOverlap(kiriLatticePoint low, int32_t side, const kiriLatticePoint c[3])
{
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint a = c[i], b = c[(i + 1) % 3], far;
        far.x = b.y > a.y ? low.x : low.x + side;
        far.y = b.x > a.x ? low.y + side : low.y;
        if (kiriOrient(a, b, far) <= 0) {
            return false;
        }
    }
    return true;
}

/* Does the triangle overlap this square of its box? In a box of one row or column it goes through all squares. */
static bool OverlapsInBox(const kiriSquares* squares, SquareBox box, int32_t column, int32_t row,
                          const kiriLatticePoint c[3])
{
    return box.firstColumn == box.lastColumn || box.firstRow == box.lastRow ||
           EdgesOverlap(CornerAt(squares, column, row), squares->side, c);
}

/* Of any square. */
static bool OverlapsAt(const kiriSquares* squares, SquareBox box, int32_t column, int32_t row,
                       const kiriLatticePoint c[3])
{
    return column >= box.firstColumn && column <= box.lastColumn && row >= box.firstRow && row <= box.lastRow &&
           OverlapsInBox(squares, box, column, row, c);
}

bool kiriSquares_Overlap(const kiriSquares* squares, int32_t square, const kiriLatticePoint corners[3])
{
    return OverlapsAt(squares, BoxOf(squares, corners), square % squares->columns, square / squares->columns, corners);
}

static uint64_t BitsInBox(const kiriSquares* squares, SquareBox box, const kiriLatticePoint c[3])
{
    uint64_t bits = 0;
    int k = 0;
    for (int32_t row = box.firstRow; row <= box.lastRow; ++row) {
        for (int32_t column = box.firstColumn; column <= box.lastColumn; ++column, ++k) {
            bits |= (uint64_t)OverlapsInBox(squares, box, column, row, c) << k;
        }
    }
    return bits;
}

/* Of four squares, where most triangles are about as large as squares: those that corners are in; and an edge from one
   of them to the opposite one passes the point in the middle on its left or on its right. */
static uint64_t BitsOfFour(const kiriSquares* squares, SquareBox box, const kiriLatticePoint c[3],
                           const kiriSquarePlace in[3])
{
    static const uint8_t rightOf[4] = { 1, 3, 0, 2 };
    kiriLatticePoint middle = CornerAt(squares, box.lastColumn, box.lastRow);
    int corner[3];
    uint64_t bits = 0;
    for (int i = 0; i < 3; ++i) {
        corner[i] = in[i].column - box.firstColumn + 2 * (in[i].row - box.firstRow);
        bits |= UINT64_C(1) << corner[i];
    }
    for (int i = 0; i < 3; ++i) {
        int from = corner[i], to = corner[(i + 1) % 3], right = rightOf[from];
        if (from + to == 3) {
            bits |= UINT64_C(1) << (kiriOrient(c[i], c[(i + 1) % 3], middle) > 0 ? right : 3 - right);
        }
    }
    return bits;
}

bool kiriSquares_FindOverlaps(const kiriSquares* squares, const kiriLatticePoint corners[3],
                              const kiriSquarePlace in[3], kiriOverlaps* overlaps)
{
    const SquareBox box = { Min3(in[0].column, in[1].column, in[2].column),
                            Max3(in[0].column, in[1].column, in[2].column), Min3(in[0].row, in[1].row, in[2].row),
                            Max3(in[0].row, in[1].row, in[2].row) };
    int32_t columns = box.lastColumn - box.firstColumn + 1, rows = box.lastRow - box.firstRow + 1;
    int64_t count = (int64_t)columns * rows;
    *overlaps = (kiriOverlaps){ 0, 0, 0, 0, 0 };
    if (count > KIRI_FEW_SQUARES) {
        return false;
    }
    bool isRow = rows == 1 || columns == 1, areFour = rows == 2 && columns == 2;
    uint64_t bits = isRow     ? ~UINT64_C(0) >> (KIRI_FEW_SQUARES - count)
                    : areFour ? BitsOfFour(squares, box, corners, in)
                              : BitsInBox(squares, box, corners);
    *overlaps = (kiriOverlaps){ box.firstRow, box.firstColumn, columns, 0, bits };
    return true;
}

int64_t kiriSquares_CountOverlaps(const kiriSquares* squares, const kiriLatticePoint corners[3])
{
    SquareBox r = BoxOf(squares, corners);
    int64_t count = 0;
    for (int32_t row = r.firstRow; row <= r.lastRow; ++row) {
        for (int32_t column = r.firstColumn; column <= r.lastColumn; ++column) {
            count += OverlapsInBox(squares, r, column, row, corners);
        }
    }
    return count;
}

static void MarkSquareDirty(kiriSquares* squares, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < squares->columns * squares->rows);
    if (!squares->isDirty[square]) {
        KIRI_ASSERT(squares->dirty.count < squares->dirty.capacity);
        squares->isDirty[square] = 1;
        squares->dirty.data[squares->dirty.count++] = square;
    }
}

void kiriSquares_ClearDirty(kiriSquares* squares)
{
    squares->oldDirtyCount = KIRI_NONE;
    for (int32_t i = 0; i < squares->dirty.count; ++i) {
        squares->isDirty[squares->dirty.data[i]] = 0;
    }
    squares->dirty.count = 0;
}

/* Separating axes: the sides of the square, and the segment. */
bool kiriSquares_RunsThrough(const kiriSquares* squares, int32_t square, kiriLatticePoint a, kiriLatticePoint b)
{
    kiriLatticePoint low = kiriSquares_Corner(squares, square), high = { low.x + squares->side, low.y + squares->side };
    if ((a.x <= low.x && b.x <= low.x) || (a.x >= high.x && b.x >= high.x) || (a.y <= low.y && b.y <= low.y) ||
        (a.y >= high.y && b.y >= high.y)) {
        return false;
    }
    /* The two corners farthest to the left and to the right of a line that rises, or falls. */
    bool rises = (a.x < b.x) == (a.y < b.y);
    kiriLatticePoint p = { low.x, rises ? high.y : low.y }, q = { high.x, rises ? low.y : high.y };
    int64_t sideP = kiriOrient(a, b, p), sideQ = kiriOrient(a, b, q);
    return (sideP < 0 && sideQ > 0) || (sideP > 0 && sideQ < 0);
}

/* To look at all squares of a box. */
static void AddEffort(kiriSquares* squares, SquareBox r)
{
    squares->effort += (int64_t)KIRI_SQUARE_EFFORT * (r.lastRow - r.firstRow + 1) * (r.lastColumn - r.firstColumn + 1);
}

void kiriSquares_MarkEdgeDirty(kiriSquares* squares, kiriLatticePoint a, kiriLatticePoint b)
{
    const kiriLatticePoint ends[3] = { a, b, b };
    SquareBox r = BoxOf(squares, ends);
    AddEffort(squares, r);
    for (int32_t row = r.firstRow; row <= r.lastRow; ++row) {
        for (int32_t column = r.firstColumn; column <= r.lastColumn; ++column) {
            int32_t square = row * squares->columns + column;
            if (kiriSquares_RunsThrough(squares, square, a, b)) {
                MarkSquareDirty(squares, square);
            }
        }
    }
}

/* ---- What Rollback restores -------------------------------------------------------------------------------------- */

void kiriSquares_Begin(kiriSquares* squares)
{
    squares->isOpen = true;
    squares->undo.count = 0;
    squares->oldNodeCount = squares->nodes.count;
    squares->oldFreeNode = squares->freeNode;
    squares->oldDirtyCount = squares->dirty.count;
}

void kiriSquares_Commit(kiriSquares* squares)
{
    squares->isOpen = false;
    squares->undo.count = 0;
}

static bool ReserveUndo(kiriSquares* squares, kiriMemory* memory)
{
    return !squares->isOpen || kiriArray_Reserve(memory, &squares->undo, (int64_t)squares->undo.count + 2);
}

/* Room for it is reserved. */
static void PushUndo(kiriSquares* squares, int32_t index, kiriSquareNode was)
{
    KIRI_ASSERT(squares->undo.count < squares->undo.capacity);
    kiriSquareUndo undo = { index, was };
    squares->undo.data[squares->undo.count++] = undo;
}

static void SetHead(kiriSquares* squares, int32_t square, int32_t slot)
{
    if (squares->isOpen) {
        kiriSquareNode was = { KIRI_NONE, squares->head[square] };
        PushUndo(squares, ~square, was);
    }
    squares->head[square] = slot;
}

/* Slots that are newer than Begin go altogether. */
static void SetNode(kiriSquares* squares, int32_t slot, int32_t triangle, int32_t next)
{
    kiriSquareNode node = { triangle, next };
    if (squares->isOpen && slot < squares->oldNodeCount) {
        PushUndo(squares, slot, squares->nodes.data[slot]);
    }
    squares->nodes.data[slot] = node;
}

static void RestoreDirty(kiriSquares* squares)
{
    if (squares->oldDirtyCount == KIRI_NONE) {
        for (int32_t square = 0; square < squares->columns * squares->rows; ++square) {
            MarkSquareDirty(squares, square);
        }
        squares->oldDirtyCount = squares->dirty.count;
    }
    while (squares->dirty.count > squares->oldDirtyCount) {
        squares->isDirty[squares->dirty.data[--squares->dirty.count]] = 0;
    }
}

void kiriSquares_Rollback(kiriSquares* squares)
{
    KIRI_ASSERT(squares->isOpen && squares->nodes.count >= squares->oldNodeCount);
    while (squares->undo.count > 0) {
        kiriSquareUndo undo = squares->undo.data[--squares->undo.count];
        if (undo.index < 0) {
            squares->head[~undo.index] = undo.was.next;
        } else {
            squares->nodes.data[undo.index] = undo.was;
        }
    }
    squares->nodes.count = squares->oldNodeCount;
    squares->freeNode = squares->oldFreeNode;
    RestoreDirty(squares);
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

static bool AddNode(kiriSquares* squares, kiriMemory* memory, int32_t square, int32_t triangle)
{
    int32_t slot = squares->freeNode;
    if (!ReserveUndo(squares, memory)) {
        return false;
    }
    if (slot != KIRI_NONE) {
        squares->freeNode = squares->nodes.data[slot].next;
    } else {
        slot = squares->nodes.count;
        if (!kiriArray_Resize(memory, &squares->nodes, (int64_t)slot + 1)) {
            return false;
        }
    }
    squares->effort += KIRI_SQUARE_EFFORT;
    SetNode(squares, slot, triangle, squares->head[square]);
    SetHead(squares, square, slot);
    MarkSquareDirty(squares, square);
    return true;
}

/* The node of a triangle in a square, which is there; *before is the one that leads to it, or KIRI_NONE. */
static int32_t FindNode(kiriSquares* squares, int32_t square, int32_t triangle, int32_t* before)
{
    int32_t slot = squares->head[square];
    *before = KIRI_NONE;
    while (squares->nodes.data[slot].triangle != triangle) {
        squares->effort += KIRI_NODE_EFFORT;
        *before = slot;
        slot = squares->nodes.data[slot].next;
        KIRI_ASSERT(slot >= 0 && slot < squares->nodes.count);
    }
    return slot;
}

static bool RemoveNode(kiriSquares* squares, kiriMemory* memory, int32_t square, int32_t triangle)
{
    if (!ReserveUndo(squares, memory)) {
        return false;
    }
    int32_t before, slot = FindNode(squares, square, triangle, &before), next = squares->nodes.data[slot].next;
    squares->effort += KIRI_SQUARE_EFFORT;
    if (before == KIRI_NONE) {
        SetHead(squares, square, next);
    } else {
        SetNode(squares, before, squares->nodes.data[before].triangle, next);
    }
    SetNode(squares, slot, KIRI_NONE, squares->freeNode);
    squares->freeNode = slot;
    MarkSquareDirty(squares, square);
    return true;
}

bool kiriSquares_Insert(kiriSquares* squares, kiriMemory* memory, int32_t triangle, const kiriLatticePoint corners[3])
{
    KIRI_ASSERT(triangle >= 0 && kiriOrient(corners[0], corners[1], corners[2]) > 0);
    SquareBox r = BoxOf(squares, corners);
    AddEffort(squares, r);
    for (int32_t row = r.firstRow; row <= r.lastRow; ++row) {
        for (int32_t column = r.firstColumn; column <= r.lastColumn; ++column) {
            if (OverlapsInBox(squares, r, column, row, corners) &&
                !AddNode(squares, memory, row * squares->columns + column, triangle)) {
                return false;
            }
        }
    }
    return true;
}

static SquareBox JoinBoxes(SquareBox a, SquareBox b)
{
    SquareBox box = { kiriMin(a.firstColumn, b.firstColumn), kiriMax(a.lastColumn, b.lastColumn),
                      kiriMin(a.firstRow, b.firstRow), kiriMax(a.lastRow, b.lastRow) };
    return box;
}

static bool ReshapeIn(kiriSquares* squares, kiriMemory* memory, int32_t square, int32_t triangle, bool was, bool is)
{
    if (was && is) {
        MarkSquareDirty(squares, square);
        return true;
    }
    return was ? RemoveNode(squares, memory, square, triangle) : !is || AddNode(squares, memory, square, triangle);
}

bool kiriSquares_Reshape(kiriSquares* squares, kiriMemory* memory, int32_t triangle, const kiriLatticePoint was[3],
                         const kiriLatticePoint is[3])
{
    SquareBox before = BoxOf(squares, was), after = BoxOf(squares, is), r = JoinBoxes(before, after);
    AddEffort(squares, r);
    for (int32_t row = r.firstRow; row <= r.lastRow; ++row) {
        for (int32_t column = r.firstColumn; column <= r.lastColumn; ++column) {
            if (!ReshapeIn(squares, memory, row * squares->columns + column, triangle,
                           OverlapsAt(squares, before, column, row, was),
                           OverlapsAt(squares, after, column, row, is))) {
                return false;
            }
        }
    }
    return true;
}

/* The nodes of the triangles that are not kept become free. */
static void FreeNodes(kiriSquares* squares, const kiriKeep* triangles, int32_t square)
{
    kiriSquareNode* nodes = squares->nodes.data;
    int32_t* link = &squares->head[square];
    while (*link != KIRI_NONE) {
        int32_t slot = *link;
        if (kiriKeep_Has(triangles, nodes[slot].triangle)) {
            link = &nodes[slot].next;
            continue;
        }
        *link = nodes[slot].next;
        nodes[slot] = (kiriSquareNode){ KIRI_NONE, squares->freeNode };
        squares->freeNode = slot;
    }
}

void kiriSquares_Keep(kiriSquares* squares, const kiriKeep* triangles, const int32_t* of, int32_t count)
{
    KIRI_ASSERT(!squares->isOpen);
    for (int32_t k = 0; k < count; ++k) {
        FreeNodes(squares, triangles, of[k]);
    }
    for (int32_t n = 0; n < squares->nodes.count && kiriKeep_Moves(triangles); ++n) {
        squares->nodes.data[n].triangle = kiriKeep_To(triangles, squares->nodes.data[n].triangle);
    }
}

int32_t kiriSquares_At(const kiriSquares* squares, kiriLatticePoint p)
{
    int32_t column = LineOf(squares, p.x) - squares->firstColumn, row = LineOf(squares, p.y) - squares->firstRow;
    if (p.x < 0 || p.y < 0 || column < 0 || row < 0 || column >= squares->columns || row >= squares->rows) {
        return KIRI_NONE;
    }
    return row * squares->columns + column;
}

int32_t kiriSquares_InPart(const kiriSquares* part, const kiriSquares* whole, int32_t square)
{
    int32_t column = square % whole->columns + whole->firstColumn - part->firstColumn;
    int32_t row = square / whole->columns + whole->firstRow - part->firstRow;
    KIRI_ASSERT(column >= 0 && column < part->columns && row >= 0 && row < part->rows);
    return row * part->columns + column;
}

int32_t kiriSquares_CountNodes(const kiriSquares* squares, int32_t square)
{
    int32_t count = 0;
    for (int32_t n = squares->head[square]; n != KIRI_NONE; n = squares->nodes.data[n].next) {
        ++count;
    }
    return count;
}
