/* Removes doubled parts of lines, joins lines that meet, and sorts them. */
#include "import_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { NONE = -1, MOST_SIDE = 512 };

/* A straight part of a line. Ends 2 i and 2 i + 1 of segment i are where it begins and ends. */
typedef struct Segment {
    double from[2], to[2];
    int32_t use, style;
} Segment;

/* Squares over the drawing, with a chain of segments each. */
typedef struct Grid {
    double lower[2], square;
    int32_t columns, rows;
    int32_t* heads; /* of the chains */
    struct Link {
        int32_t item, next;
        float along[2]; /* unit vector of a segment */
    } * links;
    int32_t linkCount, linkCapacity;
} Grid;

typedef struct Join {
    Import* drawing;
    double distance;
    Segment* segments; /* by use, then as in the file */
    int32_t* mates;    /* of each end: the end that goes on, or -1 */
    int32_t* stamps;   /* of each segment: the segment that was last compared with it */
    int32_t count, capacity;
    Grid grid;
} Join;

/* Returns `isThere`; where memory is missing it says so. */
static bool HasMemory(Join* join, bool isThere)
{
    if (!isThere) {
        Import_Fail(join->drawing, "there is no memory for the drawing");
    }
    return isThere;
}

static bool AddSegment(Join* join, Segment segment)
{
    if (!Import_Reserve((void**)&join->segments, &join->capacity, join->count, sizeof(Segment))) {
        return HasMemory(join, false);
    }
    join->segments[join->count++] = segment;
    return true;
}

/* ---- The grid ---- */

/* Squares for some items of a mean length: a few in a square, and few squares for an item. */
static bool MakeGrid(Join* join, int32_t items, double length, double square)
{
    Grid* grid = &join->grid;
    double upper[2] = { -1e300, -1e300 };
    grid->lower[0] = grid->lower[1] = 1e300;
    for (int32_t i = 0; i < 2 * join->drawing->pointCount; i++) {
        grid->lower[i % 2] = fmin(grid->lower[i % 2], join->drawing->points[i]);
        upper[i % 2] = fmax(upper[i % 2], join->drawing->points[i]);
    }
    double size = fmax(upper[0] - grid->lower[0], upper[1] - grid->lower[1]) + 4.0 * join->distance;
    double side = 2.0 * sqrt((double)items) / (1.0 + length / fmax(size, 1e-300) * sqrt((double)items));
    side = floor(fmin(fmax(side, 1.0), (double)MOST_SIDE));
    grid->square = fmax(size / side, square);
    grid->lower[0] -= 2.0 * join->distance;
    grid->lower[1] -= 2.0 * join->distance;
    grid->columns = (int32_t)((upper[0] - grid->lower[0] + 2.0 * join->distance) / grid->square) + 1;
    grid->rows = (int32_t)((upper[1] - grid->lower[1] + 2.0 * join->distance) / grid->square) + 1;
    grid->linkCount = 0;
    free(grid->heads);
    grid->heads = malloc(sizeof(int32_t) * (size_t)grid->columns * (size_t)grid->rows);
    if (!HasMemory(join, grid->heads != NULL)) {
        return false;
    }
    for (int32_t i = 0; i < grid->columns * grid->rows; i++) {
        grid->heads[i] = NONE;
    }
    return true;
}

static int32_t FindSquare(const Grid* grid, double x, int axis)
{
    int32_t most = (axis == 0 ? grid->columns : grid->rows) - 1, at = (int32_t)((x - grid->lower[axis]) / grid->square);
    return at < 0 ? 0 : at > most ? most : at;
}

static bool Link(Join* join, int32_t square, int32_t item, const double along[2])
{
    Grid* grid = &join->grid;
    if (!Import_Reserve((void**)&grid->links, &grid->linkCapacity, grid->linkCount, sizeof *grid->links)) {
        return HasMemory(join, false);
    }
    grid->links[grid->linkCount] = (struct Link){ item, grid->heads[square], { (float)along[0], (float)along[1] } };
    grid->heads[square] = grid->linkCount++;
    return true;
}

/* The squares of row `row` that a segment may reach: first and last column. */
static void FindColumns(const Join* join, const Segment* s, int32_t row, int32_t columns[2])
{
    const Grid* grid = &join->grid;
    double low = grid->lower[1] + row * grid->square - join->distance, high = low + grid->square + 2.0 * join->distance;
    double dy = s->to[1] - s->from[1], x[2] = { s->from[0], s->to[0] };
    if (dy != 0.0) {
        double a = fmin(fmax((low - s->from[1]) / dy, 0.0), 1.0), b = fmin(fmax((high - s->from[1]) / dy, 0.0), 1.0);
        x[0] = s->from[0] + a * (s->to[0] - s->from[0]);
        x[1] = s->from[0] + b * (s->to[0] - s->from[0]);
    }
    columns[0] = FindSquare(grid, fmin(x[0], x[1]) - join->distance, 0);
    columns[1] = FindSquare(grid, fmax(x[0], x[1]) + join->distance, 0);
}

/* ---- Doubled parts ---- */

/* The part of b, from 0 to 1, on which it lies along a. */
static bool FindCovered(const Join* join, const Segment* a, const Segment* b, double part[2])
{
    double near = 0.1 * join->distance; /* doubled lines differ by rounding */
    double d[2] = { a->to[0] - a->from[0], a->to[1] - a->from[1] }, length = hypot(d[0], d[1]);
    double e[2] = { b->to[0] - b->from[0], b->to[1] - b->from[1] }, own = hypot(e[0], e[1]);
    double p[2] = { b->from[0] - a->from[0], b->from[1] - a->from[1] };
    d[0] /= length;
    d[1] /= length;
    double off = d[0] * p[1] - d[1] * p[0], slope = d[0] * e[1] - d[1] * e[0];   /* across a, at the ends of b */
    double along = d[0] * p[0] + d[1] * p[1], speed = d[0] * e[0] + d[1] * e[1]; /* along a */
    if (fabs(off) > near && fabs(off + slope) > near && off * (off + slope) > 0.0) {
        return false;
    }
    part[0] = 0.0;
    part[1] = 1.0;
    for (int k = 0; k < 2; k++) { /* within the distance of the line, and beside the segment */
        double start = k == 0 ? off : along - 0.5 * length, rate = k == 0 ? slope : speed;
        double limit = k == 0 ? near : 0.5 * length + near;
        if (rate != 0.0) {
            double t = (-limit - start) / rate, u = (limit - start) / rate;
            part[0] = fmax(part[0], fmin(t, u));
            part[1] = fmin(part[1], fmax(t, u));
        } else if (fabs(start) > limit) {
            return false;
        }
    }
    double share = part[1] - part[0];
    bool isWhole = share >= 1.0 - 1e-9 || share * own >= length - 1e-9 * length;
    bool isParallel = fabs(slope) <= 1e-4 * own;
    return share > 0.0 && (isParallel || isWhole) && share * own > 4.0 * near;
}

static int ComparePairs(const void* a, const void* b)
{
    const double *x = a, *y = b;
    return (x[0] > y[0]) - (x[0] < y[0]);
}

/* Keeps the parts of segment b that no earlier segment covers, in `kept`. */
static bool KeepRest(Join* join, Join* kept, int32_t index)
{
    enum { MOST_PARTS = 256 };
    double parts[MOST_PARTS][2], from = 0.0;
    int count = 0;
    Segment b = join->segments[index];
    double own = hypot(b.to[0] - b.from[0], b.to[1] - b.from[1]), least = fmin(2.0 * join->distance / own, 0.5);
    double along[2] = { (b.to[0] - b.from[0]) / own, (b.to[1] - b.from[1]) / own };
    Grid* grid = &join->grid;
    int32_t columns[2], first = FindSquare(grid, fmin(b.from[1], b.to[1]) - join->distance, 1);
    int32_t last = FindSquare(grid, fmax(b.from[1], b.to[1]) + join->distance, 1);
    for (int pass = 0; pass < 2; pass++) { /* compares, then goes into the grid */
        for (int32_t row = first; row <= last; row++) {
            FindColumns(join, &b, row, columns);
            for (int32_t column = columns[0]; column <= columns[1]; column++) {
                int32_t square = row * grid->columns + column;
                for (int32_t i = pass == 0 ? grid->heads[square] : NONE; i != NONE; i = grid->links[i].next) {
                    int32_t other = grid->links[i].item;
                    const float* d = grid->links[i].along;
                    if (fabs(d[0] * along[1] - d[1] * along[0]) < 0.1 && join->stamps[other] != index &&
                        count < MOST_PARTS) {
                        join->stamps[other] = index;
                        count += FindCovered(join, &join->segments[other], &b, parts[count]);
                    }
                }
                if (pass == 1 && !Link(join, square, index, along)) {
                    return false;
                }
            }
        }
    }
    qsort(parts, (size_t)count, sizeof parts[0], ComparePairs);
    for (int i = 0; i <= count; i++) {
        double to = i < count ? parts[i][0] : 1.0;
        if (to - from > least || count == 0) {
            Segment rest = b;
            for (int k = 0; k < 2; k++) {
                rest.from[k] = from > 0.0 ? b.from[k] + from * (b.to[k] - b.from[k]) : b.from[k];
                rest.to[k] = to < 1.0 ? b.from[k] + to * (b.to[k] - b.from[k]) : b.to[k];
            }
            if (!AddSegment(kept, rest)) {
                return false;
            }
        }
        from = i < count ? fmax(from, parts[i][1]) : from;
    }
    return true;
}

/* ---- Ends that meet ---- */

static const double* EndOf(const Join* join, int32_t end)
{
    const Segment* segment = &join->segments[end / 2];
    return end % 2 == 0 ? segment->from : segment->to;
}

static void Mate(Join* join, int32_t a, int32_t b)
{
    join->mates[a] = b;
    join->mates[b] = a;
}

/* Mates free ends that are nearer than the distance: the nearest ones first at the same point, then others. */
static bool MateEnds(Join* join, double distance)
{
    if (!MakeGrid(join, join->count, 0.0, 2.0 * join->distance)) {
        return false;
    }
    Grid* grid = &join->grid;
    for (int32_t end = 0; end < 2 * join->count; end++) {
        if (join->mates[end] != NONE) {
            continue;
        }
        const double* at = EndOf(join, end);
        int32_t columns[2], rows[2], best = NONE;
        double least = distance, straightest = 2.0;
        for (int k = 0; k < 2; k++) {
            columns[k] = FindSquare(grid, at[0] + (2 * k - 1) * distance, 0);
            rows[k] = FindSquare(grid, at[1] + (2 * k - 1) * distance, 1);
        }
        for (int32_t row = rows[0]; row <= rows[1]; row++) {
            for (int32_t column = columns[0]; column <= columns[1]; column++) {
                for (int32_t i = grid->heads[row * grid->columns + column]; i != NONE; i = grid->links[i].next) {
                    int32_t other = grid->links[i].item;
                    const double* there = EndOf(join, other);
                    double away = hypot(there[0] - at[0], there[1] - at[1]);
                    if (join->mates[other] != NONE || other / 2 == end / 2 || away > distance ||
                        join->segments[other / 2].style != join->segments[end / 2].style) {
                        continue;
                    }
                    /* The cosine between the ways out of the meeting: -1 goes straight on. */
                    const double *a = EndOf(join, end ^ 1), *b = EndOf(join, other ^ 1);
                    double u[2] = { a[0] - at[0], a[1] - at[1] }, v[2] = { b[0] - there[0], b[1] - there[1] };
                    double along = (u[0] * v[0] + u[1] * v[1]) / (hypot(u[0], u[1]) * hypot(v[0], v[1]));
                    if (away < least - 1e-9 * distance || best == NONE ||
                        (away <= least + 1e-9 * distance && along < straightest)) {
                        least = away;
                        best = other;
                        straightest = along;
                    }
                }
            }
        }
        if (best != NONE) {
            Mate(join, end, best);
        } else if (!Link(join, FindSquare(grid, at[1], 1) * grid->columns + FindSquare(grid, at[0], 0), end, at)) {
            return false;
        }
    }
    return true;
}

/* ---- Lines ---- */

/* Writes the line that begins at an end; its segments get the use NONE. */
static void WriteLine(Join* join, int32_t end)
{
    Import* drawing = join->drawing;
    int32_t start = end, use = join->segments[end / 2].use;
    Import_Begin(drawing, join->segments[end / 2].style);
    const double* at = EndOf(join, end);
    Import_Add(drawing, at[0], at[1]);
    while (end != NONE && join->segments[end / 2].use != IMPORT_NONE && drawing->error[0] == 0) {
        int32_t out = end ^ 1, next = join->mates[out];
        at = next == start ? EndOf(join, start) : EndOf(join, out); /* a closed line ends where it began */
        Import_Add(drawing, at[0], at[1]);
        join->segments[end / 2].use = IMPORT_NONE;
        end = next;
    }
    if (drawing->error[0] == 0) {
        int32_t index = drawing->lineCount;
        Import_End(drawing, false);
        drawing->lines[index].use = drawing->lineCount > index ? use : IMPORT_NONE;
    }
}

typedef struct Order {
    ImportLine line;
    double area;
    int32_t index;
} Order;

static int CompareOrders(const void* a, const void* b)
{
    const Order *x = a, *y = b;
    if (x->line.use != y->line.use) {
        return x->line.use - y->line.use;
    }
    return x->area != y->area ? (x->area > y->area) - (x->area < y->area) : x->index - y->index;
}

/* By use, then by the box around a line: a line within a closed line has the smaller one. */
static void SortLines(Join* join)
{
    Import* drawing = join->drawing;
    Order* orders = malloc(sizeof(Order) * ((size_t)drawing->lineCount + 1));
    if (!HasMemory(join, orders != NULL)) {
        return;
    }
    for (int32_t i = 0; i < drawing->lineCount; i++) {
        double lower[2] = { 1e300, 1e300 }, upper[2] = { -1e300, -1e300 };
        for (int32_t j = 0; j < 2 * drawing->lines[i].count; j++) {
            double x = drawing->points[2 * drawing->lines[i].first + j];
            lower[j % 2] = fmin(lower[j % 2], x);
            upper[j % 2] = fmax(upper[j % 2], x);
        }
        orders[i] = (Order){ drawing->lines[i], (upper[0] - lower[0]) * (upper[1] - lower[1]), i };
    }
    qsort(orders, (size_t)drawing->lineCount, sizeof(Order), CompareOrders);
    for (int32_t i = 0; i < drawing->lineCount; i++) {
        drawing->lines[i] = orders[i].line;
    }
    free(orders);
}

/* ---- All of it ---- */

/* The segments of all lines, cuts first; those that go on in their line are mates. */
static void TakeSegments(Join* join)
{
    const Import* drawing = join->drawing;
    for (int32_t use = IMPORT_CUT; use < IMPORT_USE_COUNT; use++) {
        for (int32_t i = 0; i < drawing->lineCount; i++) {
            const ImportLine* line = &drawing->lines[i];
            if (drawing->styles[line->style].use != use) {
                continue;
            }
            for (int32_t j = 0; j + 1 < line->count; j++) {
                const double* p = &drawing->points[2 * (line->first + j)];
                if (!AddSegment(join, (Segment){ { p[0], p[1] }, { p[2], p[3] }, use, line->style })) {
                    return;
                }
            }
        }
    }
}

bool Import_Join(Import* drawing, double distance)
{
    distance = fmin(distance, Import_GetSize(drawing) / 10000.0);
    Join all = { .drawing = drawing, .distance = distance }, rest = { .drawing = drawing, .distance = distance };
    TakeSegments(&all);
    all.stamps = malloc(sizeof(int32_t) * ((size_t)all.count + 1));
    double length = 0.0;
    for (int32_t i = 0; i < all.count; i++) {
        length +=
            hypot(all.segments[i].to[0] - all.segments[i].from[0], all.segments[i].to[1] - all.segments[i].from[1]) /
            all.count;
    }
    bool isFine =
        drawing->error[0] == 0 && HasMemory(&all, all.stamps != NULL) && MakeGrid(&all, all.count, length, 0.0);
    for (int32_t i = 0; i < all.count && isFine; i++) {
        all.stamps[i] = NONE;
    }
    for (int32_t i = 0; i < all.count && isFine; i++) {
        isFine = KeepRest(&all, &rest, i);
    }
    rest.mates = malloc(sizeof(int32_t) * (2 * (size_t)rest.count + 1));
    isFine = isFine && HasMemory(&rest, rest.mates != NULL);
    for (int32_t i = 0; i < 2 * rest.count && isFine; i++) {
        rest.mates[i] = NONE;
    }
    for (int32_t i = 0; i + 1 < rest.count && isFine; i++) { /* as in the file */
        const Segment *a = &rest.segments[i], *b = a + 1;
        if (a->to[0] == b->from[0] && a->to[1] == b->from[1] && a->use == b->use && a->style == b->style) {
            Mate(&rest, 2 * i + 1, 2 * i + 2);
        }
    }
    isFine = isFine && MateEnds(&rest, 1e-3 * distance) && MateEnds(&rest, distance);
    drawing->pointCount = drawing->lineCount = 0;
    drawing->scale = 1.0;
    for (int32_t i = 0; i < drawing->styleCount; i++) {
        drawing->styles[i].count = 0;
    }
    for (int pass = 0; pass < 2; pass++) { /* lines with an end, then closed ones */
        for (int32_t i = 0; i < 2 * rest.count && isFine && drawing->error[0] == 0; i++) {
            if (rest.segments[i / 2].use != IMPORT_NONE && (pass == 1 ? i % 2 == 0 : rest.mates[i] == NONE)) {
                WriteLine(&rest, i);
            }
        }
    }
    if (drawing->error[0] == 0) {
        SortLines(&all);
    }
    free(all.segments);
    free(all.stamps);
    free(all.grid.heads);
    free(all.grid.links);
    free(rest.segments);
    free(rest.mates);
    free(rest.grid.heads);
    free(rest.grid.links);
    return drawing->error[0] == 0;
}
