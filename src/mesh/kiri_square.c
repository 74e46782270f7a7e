#include "kiri_square.h"

/* ---- Squares of a box -------------------------------------------------------------------------------------------- */

typedef struct SquareBox {
    int32_t firstColumn, lastColumn, firstRow, lastRow;
} SquareBox;

#define EACH_IN_BOX(row, column, box)                                                                                  \
    KIRI_FROM_TO(row, (box).firstRow, (box).lastRow + 1)                                                               \
    KIRI_FROM_TO(column, (box).firstColumn, (box).lastColumn + 1)

static int64_t CeilDivide(int64_t a, int64_t b)
{
    return (a + b - 1) / b;
}

bool kiriSquares_Allocate(kiriSquares* squares, kiriMemory* memory)
{
    squares->perStep = 1.0 / squares->side;
    squares->freeNode = KIRI_NONE;
    int64_t count = (int64_t)squares->columns * squares->rows;
    squares->head = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    squares->vertexHead = kiriMemory_Alloc(memory, count * (int64_t)sizeof(int32_t));
    squares->isDirty = kiriMemory_AllocZeroed(memory, count);
    if (squares->head == NULL || squares->vertexHead == NULL || squares->isDirty == NULL ||
        !kiriArray_ReserveJust(memory, &squares->dirty, count)) {
        return false;
    }
    for (int64_t i = 0; i < count; ++i) {
        squares->head[i] = squares->vertexHead[i] = KIRI_NONE;
    }
    return true;
}

bool kiriSquares_Init(kiriSquares* squares, kiriMemory* memory, kiriLatticePoint extent, int32_t resolution)
{
    int64_t longer = kiriMax(extent.x, extent.y);
    KIRI_ASSERT(extent.x >= 0 && extent.y >= 0 && resolution > 0);
    KIRI_CLEAR(squares);
    squares->side = (int32_t)(2 * CeilDivide(longer + 2, 2 * (int64_t)resolution));
    squares->columns = (int32_t)CeilDivide((int64_t)extent.x + 2, squares->side);
    squares->rows = (int32_t)CeilDivide((int64_t)extent.y + 2, squares->side);
    return kiriSquares_Allocate(squares, memory);
}

/* Returns the column or row of an even coordinate, not negative, from the lower border of the whole sheet on. The quotient
   is at least 1 / side away from a whole number: so the product with 1 / side, which is faster, has the same floor. */
static int32_t LineOf(const kiriSquares* squares, int32_t coordinate)
{
    return (int32_t)(squares->perStep * ((double)coordinate + 1.0));
}

/* Reduces `count` columns or rows from `first` on to those between two coordinates, and KIRI_SQUARES_BESIDE more. */
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
    KIRI_CLEAR(squares);
    squares->side = like->side;
    squares->columns = like->columns;
    squares->rows = like->rows;
    squares->firstColumn = like->firstColumn;
    squares->firstRow = like->firstRow;
    TakeLines(like, lower.x, upper.x, &squares->firstColumn, &squares->columns);
    TakeLines(like, lower.y, upper.y, &squares->firstRow, &squares->rows);
    return kiriSquares_Allocate(squares, memory);
}

static void AddToBox(SquareBox* box, int32_t column, int32_t row)
{
    box->firstColumn = kiriMin(column, box->firstColumn);
    box->lastColumn = kiriMax(column, box->lastColumn);
    box->firstRow = kiriMin(row, box->firstRow);
    box->lastRow = kiriMax(row, box->lastRow);
}

/* Returns the squares that the box of the corners overlaps. Corners are even and grid lines odd: no corner is on a line. */
static SquareBox BoxOf(const kiriSquares* squares, const kiriLatticePoint c[3])
{
    SquareBox box = { INT32_MAX, -1, INT32_MAX, -1 };
    KIRI_EACH_CORNER(i) {
        AddToBox(&box, LineOf(squares, c[i].x) - squares->firstColumn, LineOf(squares, c[i].y) - squares->firstRow);
    }
    KIRI_ASSERT(box.firstColumn >= 0 && box.lastColumn < squares->columns);
    KIRI_ASSERT(box.firstRow >= 0 && box.lastRow < squares->rows);
    return box;
}

/* Separating axes: the lines of the square against the box of the triangle, and the edges of the triangle against the
   corner of the square that is farthest to their left. In a box of one row or column the triangle overlaps all squares. */
static bool Overlaps(const kiriSquares* squares, SquareBox box, int32_t column, int32_t row,
                     const kiriLatticePoint c[3])
{
    if (column < box.firstColumn || column > box.lastColumn || row < box.firstRow || row > box.lastRow) {
        return false;
    }
    bool overlaps = true;
    kiriLatticePoint low = kiriSquares_CornerAt(squares, column, row);
    KIRI_TIMES_WHILE(overlaps&& box.firstColumn != box.lastColumn && box.firstRow != box.lastRow, i, 3) {
        kiriLatticePoint a = c[i], b = c[(i + 1) % 3], far;
        far.x = b.y > a.y ? low.x : low.x + squares->side;
        far.y = b.x > a.x ? low.y + squares->side : low.y;
        overlaps = kiriOrient(a, b, far) > 0;
    }
    return overlaps;
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

bool kiriSquares_RunsThroughAll(const kiriSquares* squares, kiriLatticePoint a, kiriLatticePoint b,
                                const kiriLatticePoint corners[3])
{
    SquareBox box = BoxOf(squares, corners);
    bool isThrough = true;
    KIRI_ASSERT(!kiriLattice_IsSame(a, b));
    EACH_IN_BOX(row, column, box) {
        isThrough = isThrough && (!Overlaps(squares, box, column, row, corners) ||
                                  kiriSquares_RunsThrough(squares, row * squares->columns + column, a, b));
    }
    return isThrough;
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
    KIRI_ASSERT(square >= 0 && square < squares->columns * squares->rows);
    KIRI_EACH_NODE(n, squares, square) {
        ++count;
    }
    return count;
}

/* ---- Dirty squares ----------------------------------------------------------------------------------------------- */

static void MarkSquareDirty(kiriSquares* squares, int32_t square)
{
    KIRI_ASSERT(square >= 0 && square < squares->columns * squares->rows);
    if (!squares->isDirty[square]) {
        squares->isDirty[square] = 1;
        KIRI_NEXT(squares->dirty) = square;
    }
}

void kiriSquares_ClearDirty(kiriSquares* squares)
{
    KIRI_EACH_LISTED(square, squares->dirty) {
        squares->isDirty[square] = 0;
    }
    squares->dirty.count = 0;
}

/* Adds the cost of a visit to all squares of a box. */
static void AddEffort(kiriSquares* squares, SquareBox box)
{
    squares->effort +=
        (int64_t)KIRI_SQUARE_EFFORT * (box.lastRow - box.firstRow + 1) * (box.lastColumn - box.firstColumn + 1);
}

void kiriSquares_MarkEdgeDirty(kiriSquares* squares, kiriLatticePoint a, kiriLatticePoint b)
{
    SquareBox box = BoxOf(squares, (const kiriLatticePoint[3]){ a, b, b });
    AddEffort(squares, box);
    EACH_IN_BOX(row, column, box) {
        int32_t square = row * squares->columns + column;
        if (kiriSquares_RunsThrough(squares, square, a, b)) {
            MarkSquareDirty(squares, square);
        }
    }
}

/* ---- Triangles --------------------------------------------------------------------------------------------------- */

int64_t kiriSquares_MostNodes(const kiriSquares* squares, const kiriLatticePoint corners[3])
{
    enum { FEW = 16 };
    SquareBox box = BoxOf(squares, corners);
    int64_t inBox = (box.lastColumn - box.firstColumn + 1) * (int64_t)(box.lastRow - box.firstRow + 1);
    if (inBox <= FEW) {
        return inBox;
    }
    int64_t count = 0;
    EACH_IN_BOX(row, column, box) {
        count += Overlaps(squares, box, column, row, corners);
    }
    return count;
}

/* Adds a node, for which there is room. */
static void AddNode(kiriSquares* squares, int32_t square, int32_t triangle)
{
    int32_t slot = squares->freeNode;
    if (slot != KIRI_NONE) {
        squares->freeNode = squares->nodes.data[slot].next;
    } else {
        KIRI_ASSERT(squares->nodes.count < squares->nodes.capacity);
        slot = squares->nodes.count++;
    }
    squares->effort += KIRI_SQUARE_EFFORT;
    squares->nodes.data[slot] = (kiriSquareNode){ triangle, squares->head[square] };
    squares->head[square] = slot;
}

static void RemoveNode(kiriSquares* squares, int32_t square, int32_t triangle)
{
    int32_t* link = &squares->head[square];
    while (squares->nodes.data[*link].triangle != triangle) {
        squares->effort += KIRI_NODE_EFFORT;
        link = &squares->nodes.data[*link].next;
        KIRI_ASSERT(*link >= 0 && *link < squares->nodes.count);
    }
    int32_t slot = *link;
    squares->effort += KIRI_SQUARE_EFFORT;
    *link = squares->nodes.data[slot].next;
    squares->nodes.data[slot] = (kiriSquareNode){ KIRI_NONE, squares->freeNode };
    squares->freeNode = slot;
}

bool kiriSquares_Insert(kiriSquares* squares, kiriMemory* memory, int32_t triangle, const kiriLatticePoint corners[3])
{
    int64_t nodes = squares->nodes.count + kiriSquares_MostNodes(squares, corners);
    if (!kiriArray_Reserve(memory, &squares->nodes, nodes)) {
        return false;
    }
    kiriSquares_Reshape(squares, triangle, NULL, corners);
    return true;
}

void kiriSquares_Reshape(kiriSquares* squares, int32_t triangle, const kiriLatticePoint was[3],
                         const kiriLatticePoint is[3])
{
    SquareBox after = BoxOf(squares, is), before = was != NULL ? BoxOf(squares, was) : after, box = before;
    KIRI_ASSERT(triangle >= 0 && kiriOrient(is[0], is[1], is[2]) > 0);
    AddToBox(&box, after.firstColumn, after.firstRow);
    AddToBox(&box, after.lastColumn, after.lastRow);
    AddEffort(squares, box);
    EACH_IN_BOX(row, column, box) {
        int32_t square = row * squares->columns + column;
        bool wasIn = was != NULL && Overlaps(squares, before, column, row, was);
        bool isIn = Overlaps(squares, after, column, row, is);
        if (wasIn != isIn) {
            (isIn ? AddNode : RemoveNode)(squares, square, triangle);
        }
        if (wasIn || isIn) {
            MarkSquareDirty(squares, square);
        }
    }
}

void kiriSquares_Keep(kiriSquares* squares, const kiriKeep* triangles, const int32_t* of, int32_t count)
{
    kiriSquareNode* nodes = squares->nodes.data;
    KIRI_TIMES(k, count) {
        int32_t* link = &squares->head[of[k]];
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
    KIRI_EACH_INDEX_WHILE(kiriKeep_Moves(triangles), n, squares->nodes) {
        nodes[n].triangle = kiriKeep_To(triangles, nodes[n].triangle);
    }
}

/* ---- Strips ------------------------------------------------------------------------------------------------------ */

/* Returns the column or row of a coordinate, from the first one of the squares on, clamped to -1 and `count`. */
static int32_t ClampLine(double coordinate, int32_t side, int32_t first, int32_t count)
{
    double line = (coordinate + 1.0) / side - first;
    return line < 0.0 ? -1 : line >= count ? count : (int32_t)line;
}

kiriStrips kiriStrips_Begin(const kiriSquares* squares, kiriLatticePoint from, kiriLatticePoint to, double margin)
{
    kiriStrips s = {
        squares, { from.x, from.y }, { (double)to.x - from.x, (double)to.y - from.y }, margin + 2.0, 0, 0, 0, 1, 0, 0, 0
    };
    s.axis = fabs(s.way[1]) > fabs(s.way[0]) ? 1 : 0;
    s.step = s.way[s.axis] < 0.0 ? -1 : 1;
    int32_t first = s.axis == 0 ? squares->firstColumn : squares->firstRow;
    int32_t count = s.axis == 0 ? squares->columns : squares->rows;
    double start = s.from[s.axis] - s.step * s.margin, end = s.from[s.axis] + s.way[s.axis] + s.step * s.margin;
    s.index = ClampLine(start, squares->side, first, count) + first;
    s.last = ClampLine(end, squares->side, first, count) + first;
    return s;
}

bool kiriStrips_Next(kiriStrips* s)
{
    const kiriSquares* squares = s->squares;
    const int32_t first[2] = { squares->firstColumn, squares->firstRow },
                  count[2] = { squares->columns, squares->rows }, stride[2] = { 1, squares->columns };
    int32_t axis = s->axis, across = 1 - axis, side = squares->side;
    while (s->step * (s->last - s->index) >= 0) {
        int32_t strip = s->index - first[axis];
        double near = (double)s->index * side - 1.0 - s->margin, far = near + side + 2.0 * s->margin;
        double way = s->way[axis];
        s->index += s->step;
        if (strip < 0 || strip >= count[axis]) {
            continue;
        }
        double a = way == 0.0 ? 0.0 : ((way > 0.0 ? near : far) - s->from[axis]) / way;
        double b = way == 0.0 ? 1.0 : ((way > 0.0 ? far : near) - s->from[axis]) / way;
        double p = s->from[across] + kiriClamp(a, 0.0, 1.0) * s->way[across];
        double q = s->from[across] + kiriClamp(b, 0.0, 1.0) * s->way[across];
        int32_t low = ClampLine(kiriMin(p, q) - s->margin, side, first[across], count[across]);
        int32_t high = ClampLine(kiriMax(p, q) + s->margin, side, first[across], count[across]);
        low = kiriMax(low, 0);
        high = kiriMin(high, count[across] - 1);
        s->stride = stride[across];
        s->square = strip * stride[axis] + low * stride[across];
        s->count = high < low ? 0 : high - low + 1;
        return true;
    }
    return false;
}

kiriNearby kiriNearby_Begin(const kiriSquares* squares, kiriLatticePoint from, kiriLatticePoint to, double margin)
{
    kiriNearby nearby = { kiriStrips_Begin(squares, from, to, margin), 0, KIRI_NONE };
    KIRI_ASSERT(margin >= 0.0);
    nearby.strips.count = 0;
    return nearby;
}

int32_t kiriNearby_Next(kiriNearby* nearby)
{
    const kiriSquares* squares = nearby->strips.squares;
    while (nearby->node == KIRI_NONE) {
        if (nearby->square < nearby->strips.count) {
            nearby->node = squares->head[nearby->strips.square + nearby->square++ * nearby->strips.stride];
        } else if (kiriStrips_Next(&nearby->strips)) {
            nearby->square = 0;
        } else {
            return KIRI_NONE;
        }
    }
    KIRI_ASSERT_HAS(squares->nodes, nearby->node);
    const kiriSquareNode* node = &squares->nodes.data[nearby->node];
    nearby->node = node->next;
    KIRI_ASSERT(node->triangle >= 0);
    return node->triangle;
}
