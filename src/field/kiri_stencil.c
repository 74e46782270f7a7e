#include "kiri_stencil.h"

/* Quadratic B-spline, zero from 1.5 on. */
static double QuadraticSpline(double t)
{
    double a = fabs(t);
    return a < 0.5 ? 0.75 - a * a : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0.0;
}

/* A first-order fit around a point, in units of squares from the middle of its cell. Offsets of neighbours are whole
   numbers, so cells in one line have a determinant of zero, but for rounding. */
typedef struct PointFit {
    kiriVec2 at;
    double sum;        /* of the kernel */
    kiriVec2 mean;     /* of the offsets, weighed by the kernel */
    double xx, xy, yy; /* (pseudo-)inverse of their second moments about the mean */
} PointFit;

static kiriVec2 OffsetOf(const kiriStencil* stencil, kiriVec2 at)
{
    return kiriVec2_Scale(1.0 / stencil->side, kiriVec2_Sub(at, stencil->middle));
}

/* Beside a cell in which a cut ends, a square has cells on both sides of the cut. How far a place is on the side of one
   of two: 1 from an eighth of a square on, 0 as far on the other side. */
static double SideFrom(kiriVec2 from, kiriVec2 mine, kiriVec2 other)
{
    kiriVec2 way = kiriVec2_Sub(mine, other), middle = kiriVec2_Scale(0.5, kiriVec2_Add(mine, other));
    double length = kiriVec2_Length(way);
    double side = length > 0.0 ? 0.5 + 4.0 * kiriVec2_Dot(kiriVec2_Sub(from, middle), way) / length : 0.5;
    return side > 1.0 ? 1.0 : kiriMax(side, 0.0);
}

/* Cells of one square share its kernel, by the side that each is on. They follow each other in the steps. */
static void ShareSquare(kiriStencil* stencil, int32_t first, int32_t count, kiriVec2 from)
{
    KIRI_ASSERT(first >= 0 && first < stencil->shares.count);
    double sum = 0.0, kernel = stencil->shares.data[first];
    for (int32_t a = first; a < first + count; ++a) {
        double side = 1.0;
        for (int32_t b = first; b < first + count; ++b) {
            side *= a == b ? 1.0 : SideFrom(from, stencil->centers.data[a], stencil->centers.data[b]);
        }
        stencil->shares.data[a] = side;
        sum += side;
    }
    for (int32_t a = first; a < first + count; ++a) {
        stencil->shares.data[a] = kernel * (sum > 0.0 ? stencil->shares.data[a] / sum : 1.0 / count);
    }
}

static void ShareSquares(kiriStencil* stencil, kiriVec2 from)
{
    const kiriStep* steps = stencil->steps.data;
    for (int32_t first = 1; first < stencil->steps.count;) {
        int32_t end = first + 1;
        while (end < stencil->steps.count && steps[first].u == steps[end].u && steps[first].v == steps[end].v) {
            ++end;
        }
        if (end - first > 1) {
            ShareSquare(stencil, first, end - first, from);
        }
        first = end;
    }
}

static kiriVec2 SetKernel(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    kiriVec2 off = OffsetOf(stencil, at);
    double u[3], v[3];
    for (int i = 0; i < 3; ++i) {
        u[i] = QuadraticSpline(i - 1 - off.x);
        v[i] = QuadraticSpline(i - 1 - off.y);
    }
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        stencil->shares.data[k] = u[stencil->steps.data[k].u + 1] * v[stencil->steps.data[k].v + 1];
    }
    if (stencil->split) {
        ShareSquares(stencil, kiriVec2_Add(off, lean));
    }
    return off;
}

/* Inverts the second moments; a direction that the neighbours do not span is dropped (no slope along it). */
static void InvertMoments(PointFit* fit)
{
    double xx = fit->xx, xy = fit->xy, yy = fit->yy, trace = xx + yy, determinant = xx * yy - xy * xy;
    double scale = trace > 0.0 ? 1.0 / (trace * trace) : 0.0;
    if (determinant > 1e-12 * trace * trace) {
        scale = 1.0 / determinant;
        fit->xx = yy;
        fit->xy = -xy;
        fit->yy = xx;
    }
    fit->xx *= scale;
    fit->xy *= scale;
    fit->yy *= scale;
}

/* Leaves the kernel in the stencil's shares. */
static PointFit FitAround(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    PointFit fit = { SetKernel(stencil, at, lean), 0.0, { 0.0, 0.0 }, 0.0, 0.0, 0.0 };
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriStep to = stencil->steps.data[k];
        double kernel = stencil->shares.data[k];
        fit.sum += kernel;
        fit.mean = kiriVec2_Add(fit.mean, kiriVec2_Make(kernel * to.u, kernel * to.v));
        fit.xx += kernel * to.u * to.u;
        fit.xy += kernel * to.u * to.v;
        fit.yy += kernel * to.v * to.v;
    }
    fit.mean = kiriVec2_Scale(1.0 / fit.sum, fit.mean);
    fit.xx -= fit.sum * fit.mean.x * fit.mean.x;
    fit.xy -= fit.sum * fit.mean.x * fit.mean.y;
    fit.yy -= fit.sum * fit.mean.y * fit.mean.y;
    InvertMoments(&fit);
    return fit;
}

/* The slope of a function on the cells is the sum of its values times these. */
static kiriVec2 FitSlope(const PointFit* fit, kiriStep to, double kernel)
{
    kiriVec2 p = kiriVec2_Make(to.u - fit->mean.x, to.v - fit->mean.y);
    return kiriVec2_Make(kernel * (fit->xx * p.x + fit->xy * p.y), kernel * (fit->xy * p.x + fit->yy * p.y));
}

/* What the cells count at the point. Where no cell is missing, the splines are the fit: they reproduce linear
   functions. */
static void SetShares(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    if (stencil->full) {
        SetKernel(stencil, at, lean);
        return;
    }
    PointFit fit = FitAround(stencil, at, lean);
    kiriVec2 way = kiriVec2_Sub(fit.at, fit.mean);
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        double kernel = stencil->shares.data[k];
        stencil->shares.data[k] = kernel / fit.sum + kiriVec2_Dot(FitSlope(&fit, stencil->steps.data[k], kernel), way);
    }
}

static void MakeSumOne(double* values, int32_t count)
{
    double sum = 0.0;
    for (int32_t i = 0; i < count; ++i) {
        sum += values[i];
    }
    for (int32_t i = 0; i < count; ++i) {
        values[i] /= sum;
    }
}

/* The fit may undershoot: no value below zero, sum 1. */
static void WeighLinear(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    KIRI_ASSERT(stencil->cell != KIRI_NONE);
    int32_t count = stencil->frames.count;
    double* values = stencil->values.data;
    SetShares(stencil, at, lean);
    for (int32_t i = 0; i < count; ++i) {
        values[i] = 0.0;
    }
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        const double* weights = stencil->weights.data + (size_t)k * (size_t)count;
        double share = stencil->shares.data[k];
        for (int32_t i = 0; i < count; ++i) {
            values[i] += weights[i] * share;
        }
    }
    for (int32_t i = 0; i < count; ++i) {
        values[i] = kiriMax(values[i], 0.0);
    }
    MakeSumOne(values, count);
}

/* A linear weight has kinks at its site and where it becomes zero, and linear blending then makes a kink as large as
   the angle between two frames. Both go where the slope is zero there. Of two frames the sum stays 1. */
static double Ease(double w)
{
    return w * w * (3.0 - 2.0 * w);
}

void kiriStencil_Weigh(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    int32_t count = stencil->frames.count;
    WeighLinear(stencil, at, lean);
    if (stencil->eased) {
        for (int32_t i = 0; i < count; ++i) {
            stencil->values.data[i] = Ease(stencil->values.data[i]);
        }
        MakeSumOne(stencil->values.data, count);
    }
}

/* By square, then by the order of cells. */
static int CompareSteps(const kiriGrid* grid, kiriStep a, kiriStep b)
{
    int32_t x = 3 * a.v + a.u, y = 3 * b.v + b.u;
    return x != y ? (x < y ? -1 : 1) : a.cell == b.cell ? 0 : kiriGrid_IsBefore(grid, a.cell, b.cell) ? -1 : 1;
}

/* Puts a step in its place after the first, unless it is there. There is room. */
static void InsertStep(kiriStencil* stencil, const kiriGrid* grid, kiriStep step)
{
    int32_t k = stencil->steps.count;
    kiriStep* steps = stencil->steps.data;
    while (k > 1 && CompareSteps(grid, steps[k - 1], step) > 0) {
        --k;
    }
    if (k > 1 && steps[k - 1].cell == step.cell) {
        return;
    }
    for (int32_t m = stencil->steps.count++; m > k; --m) {
        steps[m] = steps[m - 1];
    }
    steps[k] = step;
}

/* Two straight steps around a corner. */
static bool InsertBeyond(kiriStencil* stencil, kiriMemory* memory, const kiriGrid* grid, kiriStep to)
{
    kiriSteps steps;
    kiriGrid_GetStepsTo(grid, to.cell, 1, &steps);
    if (!kiriArray_Reserve(memory, &stencil->steps, (int64_t)stencil->steps.count + steps.end[0])) {
        return false;
    }
    for (int32_t k = 0; k < steps.end[0]; ++k) {
        kiriStep on = steps.data[k];
        if ((to.u != 0) != (on.u != 0)) {
            on.u = (int8_t)(on.u + to.u);
            on.v = (int8_t)(on.v + to.v);
            InsertStep(stencil, grid, on);
        }
    }
    return true;
}

/* Most cells have eight others around them, and no square there is divided: then steps of the grid tell all. */
static bool IsPlain(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->cells.count);
    kiriSteps steps;
    kiriGrid_GetStepsTo(grid, cell, 2, &steps);
    bool plain = steps.end[1] == 8 && grid->whole.data[grid->cells.data[cell].square];
    for (int32_t k = 0; plain && k < steps.end[1]; ++k) {
        plain = grid->whole.data[grid->cells.data[steps.data[k].cell].square];
    }
    return plain;
}

/* The cell itself, and what one straight step leads to, or two around a corner. A diagonal step of the grid asks for
   both ways around it: beside a cut there is often one, and a fit without these cells is another from cell to cell. */
static bool GatherSteps(kiriStencil* stencil, kiriMemory* memory, const kiriGrid* grid, int32_t cell)
{
    kiriSteps steps;
    kiriGrid_GetStepsTo(grid, cell, 2, &steps);
    bool plain = IsPlain(grid, cell);
    int32_t end = steps.end[plain ? 1 : 0];
    stencil->steps.count = 0;
    if (!kiriArray_Reserve(memory, &stencil->steps, (int64_t)end + 1)) {
        return false;
    }
    stencil->steps.data[stencil->steps.count++] = (kiriStep){ cell, 0, 0, 0 };
    for (int32_t k = 0; k < end; ++k) {
        InsertStep(stencil, grid, steps.data[k]);
    }
    for (int32_t k = 0; !plain && k < steps.end[0]; ++k) {
        if (!InsertBeyond(stencil, memory, grid, steps.data[k])) {
            return false;
        }
    }
    return true;
}

/* Which squares around have a cell, and where the material of cells is that share one. */
static bool GatherMiddles(kiriStencil* stencil, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh)
{
    int32_t count = stencil->steps.count, seen = 0;
    if (!kiriArray_Resize(memory, &stencil->centers, count) || !kiriArray_Resize(memory, &stencil->shares, count)) {
        return false;
    }
    stencil->split = false;
    for (int32_t k = 0; k < count; ++k) {
        kiriStep to = stencil->steps.data[k];
        int32_t square = 1 << (3 * (to.v + 1) + to.u + 1);
        stencil->split = stencil->split || (seen & square) != 0;
        seen |= square;
    }
    stencil->full = count == 9 && seen == 511;
    for (int32_t k = 0; stencil->split && k < count; ++k) {
        kiriMoments material = kiriGrid_Material(grid, mesh, stencil->steps.data[k].cell);
        stencil->centers.data[k] = OffsetOf(stencil, kiriMoments_Center(&material));
    }
    return true;
}

/* The frames with weight in any of the cells, sorted; `columns` tells where they are. */
static bool GatherFrames(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape)
{
    int32_t old = stencil->columns.count;
    if (!kiriArray_Resize(memory, &stencil->columns, kiriMax(old, shape->rigid.count))) {
        return false;
    }
    for (int32_t f = old; f < stencil->columns.count; ++f) {
        stencil->columns.data[f] = 0;
    }
    stencil->frames.count = 0;
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriSpan span = shape->spans.data[stencil->steps.data[k].cell];
        if (!kiriArray_Reserve(memory, &stencil->frames, (int64_t)stencil->frames.count + span.count)) {
            return false;
        }
        for (int32_t w = span.first; w < span.first + span.count; ++w) {
            int32_t frame = kiriLabels_Item(&shape->labels, shape->weights.data[w].label);
            int32_t at = stencil->frames.count;
            if (stencil->columns.data[frame] == 0) {
                stencil->columns.data[frame] = 1;
                for (; at > 0 && stencil->frames.data[at - 1] > frame; --at) {
                    stencil->frames.data[at] = stencil->frames.data[at - 1];
                }
                stencil->frames.data[at] = frame;
                ++stencil->frames.count;
            }
        }
    }
    for (int32_t i = 0; i < stencil->frames.count; ++i) {
        stencil->columns.data[stencil->frames.data[i]] = i + 1;
    }
    return true;
}

static bool GatherWeights(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape)
{
    int32_t count = stencil->frames.count;
    if (!kiriArray_Resize(memory, &stencil->weights, (int64_t)count * stencil->steps.count) ||
        !kiriArray_Resize(memory, &stencil->values, count)) {
        return false;
    }
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriSpan span = shape->spans.data[stencil->steps.data[k].cell];
        double *weights = stencil->weights.data + (size_t)k * (size_t)count, sum = kiriShape_Sum(shape, span);
        for (int32_t i = 0; i < count; ++i) {
            weights[i] = 0.0;
        }
        for (int32_t w = span.first; w < span.first + span.count; ++w) {
            int32_t frame = kiriLabels_Item(&shape->labels, shape->weights.data[w].label);
            weights[stencil->columns.data[frame] - 1] = kiriCellWeight_Raw(&shape->weights.data[w]) / sum;
        }
    }
    return true;
}

bool kiriStencil_Gather(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                        const kiriMeshData* mesh, int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell) && cell < shape->spans.count);
    stencil->middle = kiriGrid_Middle(grid, mesh, cell);
    stencil->side = grid->side;
    stencil->eased = shape->eased;
    bool ok = GatherSteps(stencil, memory, grid, cell) && GatherMiddles(stencil, memory, grid, mesh) &&
              GatherFrames(stencil, memory, shape) && GatherWeights(stencil, memory, shape);
    for (int32_t i = 0; i < stencil->frames.count; ++i) {
        stencil->columns.data[stencil->frames.data[i]] = 0;
    }
    stencil->cell = ok ? cell : KIRI_NONE;
    return ok;
}

/* Of the linear weights. */
static void SetGradients(kiriStencil* stencil, kiriVec2 at, kiriPointWeights* out)
{
    PointFit fit = FitAround(stencil, at, kiriVec2_Make(0.0, 0.0));
    for (int32_t k = 0; k < stencil->steps.count; ++k) {
        kiriVec2 slope = FitSlope(&fit, stencil->steps.data[k], stencil->shares.data[k]);
        const double* weights = stencil->weights.data + (size_t)k * (size_t)out->count;
        for (int32_t i = 0; i < out->count; ++i) {
            kiriPointWeight* weight = &out->data[i];
            weight->gradient = kiriVec2_Add(weight->gradient, kiriVec2_Scale(weights[i] / stencil->side, slope));
        }
    }
}

/* From linear weights w to v = ease(w) / s, s being the sum: grad v = (ease'(w) grad w - v grad s) / s. */
static void EaseGradients(kiriPointWeights* out)
{
    double sum = 0.0;
    kiriVec2 slope = { 0.0, 0.0 };
    for (int32_t i = 0; i < out->count; ++i) {
        kiriPointWeight* weight = &out->data[i];
        double w = weight->value;
        weight->gradient = kiriVec2_Scale(6.0 * w * (1.0 - w), weight->gradient);
        weight->value = Ease(w);
        sum += weight->value;
        slope = kiriVec2_Add(slope, weight->gradient);
    }
    for (int32_t i = 0; i < out->count; ++i) {
        kiriPointWeight* weight = &out->data[i];
        weight->value /= sum;
        kiriVec2 rest = kiriVec2_Sub(weight->gradient, kiriVec2_Scale(weight->value, slope));
        weight->gradient = kiriVec2_Scale(1.0 / sum, rest);
    }
}

/* The gradients sum to 0: what rounding leaves of them is taken from that of the largest weight. */
static void BalanceGradients(kiriPointWeights* out)
{
    kiriVec2 rest = { 0.0, 0.0 };
    int32_t largest = 0;
    for (int32_t i = 0; i < out->count; ++i) {
        rest = kiriVec2_Add(rest, out->data[i].gradient);
        largest = out->data[i].value > out->data[largest].value ? i : largest;
    }
    if (out->count > 0) {
        out->data[largest].gradient = kiriVec2_Sub(out->data[largest].gradient, rest);
    }
}

bool kiriShape_At(const kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                  int32_t cell, kiriVec2 at, kiriPointWeights* out)
{
    kiriMemory scratch = kiriMemory_Like(memory);
    kiriStencil stencil = { 0 };
    bool ok = kiriStencil_Gather(&stencil, &scratch, shape, grid, mesh, cell) &&
              kiriArray_Resize(memory, out, stencil.frames.count);
    if (ok) {
        WeighLinear(&stencil, at, kiriVec2_Make(0.0, 0.0));
        for (int32_t i = 0; i < out->count; ++i) {
            out->data[i] = (kiriPointWeight){ stencil.frames.data[i], stencil.values.data[i], { 0.0, 0.0 } };
        }
        SetGradients(&stencil, at, out);
        if (stencil.eased) {
            EaseGradients(out);
        }
        BalanceGradients(out);
    }
    kiriMemory_FreeAll(&scratch);
    return ok;
}
