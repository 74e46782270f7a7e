#include "kiri_line.h"

#include "../core/kiri_sort.h"
#include "../core/kiri_span.h"

#define BESIDE (1.0 / 1024.0) /* of the side of a square: how far beside the line the material is sought */

/* A line beside the line at hand: its ends are odd, so no vertex is on one of them, and it runs along no edge that is
   parallel to an axis. */
typedef struct SideLine {
    const kiriMeshData* mesh;
    kiriLatticePoint ends[2];
} SideLine;

/* ---- Clipping --------------------------------------------------------------------------------------------------- */

/* Keeps of [*from, *to] where a linear function that has these values at the ends of the line is above zero. Where it
   is zero throughout `keep` decides. Neighbours that share a side have the same function but for its sign, so what they
   keep has no gap and no overlap. */
static void ClipBy(double first, double last, bool keep, double* from, double* to)
{
    if (first == 0.0 && last == 0.0) {
        *to = keep ? *to : *from;
    } else if (first <= 0.0 && last <= 0.0) {
        *to = *from;
    } else if (first < 0.0) {
        double t = first / (first - last);
        *from = kiriMax(t, *from);
    } else if (last < 0.0) {
        double t = first / (first - last);
        *to = kiriMin(t, *to);
    }
}

static void ClipBySquare(const SideLine* line, int32_t square, double* from, double* to)
{
    const kiriSquares* squares = &line->mesh->squares;
    const kiriLatticePoint low = kiriSquares_Corner(squares, square), *p = line->ends;
    const double side = squares->side;
    ClipBy((double)p[0].x - low.x, (double)p[1].x - low.x, true, from, to);
    ClipBy(low.x + side - p[0].x, low.x + side - p[1].x, false, from, to);
    ClipBy((double)p[0].y - low.y, (double)p[1].y - low.y, true, from, to);
    ClipBy(low.y + side - p[0].y, low.y + side - p[1].y, false, from, to);
}

static void ClipByTriangle(const SideLine* line, int32_t triangle, double* from, double* to)
{
    kiriLatticePoint corners[3];
    kiriMesh_Corners(line->mesh, triangle, corners);
    for (int i = 0; i < 3; ++i) {
        kiriLatticePoint a = corners[i], b = corners[(i + 1) % 3];
        bool isUp = a.y < b.y || (a.y == b.y && a.x < b.x);
        ClipBy((double)kiriOrient(a, b, line->ends[0]), (double)kiriOrient(a, b, line->ends[1]), isUp, from, to);
    }
}

/* ---- The triangles along a line ---------------------------------------------------------------------------------- */

static bool CoverSquare(const SideLine* beside, kiriMemory* memory, int32_t square, kiriLine* line)
{
    const kiriSquares* squares = &beside->mesh->squares;
    kiriLineCover whole = { 0.0, 1.0, KIRI_NONE };
    ClipBySquare(beside, square, &whole.from, &whole.to);
    for (int32_t node = squares->head[square]; whole.from < whole.to && node != KIRI_NONE;
         node = squares->nodes.data[node].next) {
        kiriLineCover cover = { whole.from, whole.to, node };
        ClipByTriangle(beside, squares->nodes.data[node].triangle, &cover.from, &cover.to);
        if (cover.from < cover.to && !kiriArray_Push(memory, &line->covers, cover)) {
            return false;
        }
    }
    return true;
}

static int32_t Within(double a, int32_t most)
{
    return a < 0.0 ? 0 : a > most ? most : (int32_t)a;
}

/* The rows that the line may run through in a column, with one more at both ends for rounding. */
static kiriSpan RowsOf(const SideLine* line, int32_t column)
{
    const kiriSquares* squares = &line->mesh->squares;
    const kiriLatticePoint *a = &line->ends[0], *b = &line->ends[1];
    double dx = (double)b->x - a->x, dy = (double)b->y - a->y, y[2];
    double left = ((double)squares->firstColumn + column) * squares->side - 1.0;
    for (int k = 0; k < 2; ++k) {
        double t = dx != 0.0 ? (left + k * squares->side - a->x) / dx : k;
        y[k] = a->y + kiriClamp(t, 0.0, 1.0) * dy;
    }
    double low = kiriMin(y[0], y[1]) * squares->perStep - squares->firstRow;
    double high = kiriMax(y[1], y[0]) * squares->perStep - squares->firstRow;
    int32_t first = Within(low - 1.0, squares->rows - 1);
    kiriSpan rows = { first, Within(high + 2.0, squares->rows - 1) - first + 1 };
    return rows;
}

static bool IsCoverBefore(const void* context, int32_t a, int32_t b)
{
    const kiriLineCover *x = (const kiriLineCover*)context + a, *y = (const kiriLineCover*)context + b;
    return x->from != y->from ? x->from < y->from : x->to != y->to ? x->to < y->to : a < b;
}

/* Adds what covers the line beside the one at hand, and puts it in order. */
static bool CoverLine(const SideLine* beside, kiriMemory* memory, kiriLine* line, kiriIndices* order)
{
    const kiriSquares* squares = &beside->mesh->squares;
    const kiriLatticePoint* p = beside->ends;
    double low = kiriMin(p[0].x, p[1].x) * squares->perStep - squares->firstColumn;
    double high = kiriMax(p[1].x, p[0].x) * squares->perStep - squares->firstColumn;
    int32_t first = line->covers.count, last = Within(high + 1.0, squares->columns - 1);
    for (int32_t column = Within(low - 1.0, squares->columns - 1); column <= last; ++column) {
        kiriSpan rows = RowsOf(beside, column);
        for (int32_t k = 0; k < rows.count; ++k) {
            if (!CoverSquare(beside, memory, (rows.first + k) * squares->columns + column, line)) {
                return false;
            }
        }
    }
    if (!kiriArray_Resize(memory, order, line->covers.count - first)) {
        return false;
    }
    for (int32_t k = 0; k < order->count; ++k) {
        order->data[k] = first + k;
    }
    kiriSort(order->data, order->count, IsCoverBefore, line->covers.data);
    return true;
}

/* ---- Both sides -------------------------------------------------------------------------------------------------- */

/* To the left for way 1, to the right for -1. */
static SideLine LineBeside(const kiriMeshData* mesh, kiriLatticePoint from, kiriLatticePoint to, double way)
{
    kiriVec2 along = { (double)to.x - from.x, (double)to.y - from.y };
    double beside = way * BESIDE * mesh->squares.side / kiriVec2_Length(along);
    const kiriLatticePoint ends[2] = { from, to };
    SideLine line = { mesh, { { 0, 0 }, { 0, 0 } } };
    for (int k = 0; k < 2; ++k) {
        line.ends[k] = kiriMesh_Round(kiriVec2_Make(ends[k].x - beside * along.y, ends[k].y + beside * along.x));
        line.ends[k].x += 1;
        line.ends[k].y += 1;
    }
    return line;
}

/* What covers the line at t, from *next on in the order, or KIRI_NONE; *end is moved to where that changes. */
static int32_t CoverAt(const kiriLine* line, const kiriIndices* order, int32_t* next, double t, double* end)
{
    while (*next < order->count && line->covers.data[order->data[*next]].to <= t) {
        *next += 1;
    }
    if (*next == order->count) {
        return KIRI_NONE;
    }
    const kiriLineCover* cover = &line->covers.data[order->data[*next]];
    double change = cover->from <= t ? cover->to : cover->from;
    *end = kiriMin(change, *end);
    return cover->from <= t ? cover->node : KIRI_NONE;
}

static bool MergeSides(kiriLine* line, kiriMemory* memory)
{
    int32_t next[2] = { 0, 0 };
    for (double t = 0.0; t < 1.0;) {
        kiriLinePart part = { t, 1.0, { KIRI_NONE, KIRI_NONE } };
        part.node[0] = CoverAt(line, &line->order[0], &next[0], t, &part.to);
        part.node[1] = CoverAt(line, &line->order[1], &next[1], t, &part.to);
        bool isCovered = part.node[0] != KIRI_NONE || part.node[1] != KIRI_NONE;
        if (isCovered && !kiriArray_Push(memory, &line->parts, part)) {
            return false;
        }
        t = part.to;
    }
    return true;
}

bool kiriLine_Trace(kiriLine* line, kiriMemory* memory, const kiriMeshData* mesh, kiriLatticePoint from,
                    kiriLatticePoint to)
{
    KIRI_ASSERT(from.x != to.x || from.y != to.y);
    line->parts.count = line->covers.count = 0;
    for (int k = 0; k < 2; ++k) {
        SideLine beside = LineBeside(mesh, from, to, k == 0 ? 1.0 : -1.0);
        if (!CoverLine(&beside, memory, line, &line->order[k])) {
            return false;
        }
    }
    return MergeSides(line, memory);
}
