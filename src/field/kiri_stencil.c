#include "kiri_stencil.h"

/* Returns the quadratic B-spline, zero from 1.5 on. */
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

/* Shares the kernel of a square with several cells, which follow each other in the steps: beside a cell in which a cut
   ends there are cells on both sides of the cut. Each gets it by the side that the point is on: all from an eighth of a
   square on, nothing as far on the other side. */
static void ShareSquares(kiriStencil* stencil, kiriVec2 from)
{
    const kiriStep* steps = stencil->steps.data;
    const kiriVec2* centers = stencil->centers.data;
    double* shares = stencil->shares.data;
    for (int32_t first = 1, end = 2; first < stencil->steps.count; first = end++) {
        double sum = 0.0, kernel = shares[first];
        while (end < stencil->steps.count && steps[first].u == steps[end].u && steps[first].v == steps[end].v) {
            ++end;
        }
        for (int32_t a = first; a < end && end - first > 1; ++a) {
            shares[a] = 1.0;
            KIRI_FROM_TO(b, first, end) {
                kiriVec2 way = kiriVec2_Sub(centers[a], centers[b]);
                kiriVec2 middle = kiriVec2_Scale(0.5, kiriVec2_Add(centers[a], centers[b]));
                double length = kiriVec2_Length(way), side = 0.5;
                side += length > 0.0 ? 4.0 * kiriVec2_Dot(kiriVec2_Sub(from, middle), way) / length : 0.0;
                shares[a] *= a == b ? 1.0 : kiriClamp(side, 0.0, 1.0);
            }
            sum += shares[a];
        }
        for (int32_t a = first; a < end && end - first > 1; ++a) {
            shares[a] = kernel * (sum > 0.0 ? shares[a] / sum : 1.0 / (end - first));
        }
    }
}

/* Sets the shares to the kernel, and returns the place of the point, in squares from the middle of the cell. */
static kiriVec2 SetKernel(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    kiriVec2 off = OffsetOf(stencil, at);
    double u[3], v[3];
    KIRI_TIMES(i, 3) {
        u[i] = QuadraticSpline(i - 1 - off.x);
        v[i] = QuadraticSpline(i - 1 - off.y);
    }
    KIRI_EACH_INDEX(k, stencil->steps) {
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

/* Fits around a point. The shares are the kernel after it. */
static PointFit FitAround(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    PointFit fit = { SetKernel(stencil, at, lean), 0.0, { 0.0, 0.0 }, 0.0, 0.0, 0.0 };
    KIRI_EACH_INDEX(k, stencil->steps) {
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

/* Returns the factor of a cell's value in the slope. */
static kiriVec2 FitSlope(const PointFit* fit, kiriStep to, double kernel)
{
    kiriVec2 p = kiriVec2_Make(to.u - fit->mean.x, to.v - fit->mean.y);
    return kiriVec2_Make(kernel * (fit->xx * p.x + fit->xy * p.y), kernel * (fit->xy * p.x + fit->yy * p.y));
}

/* Sets the share of each cell in the values at the point. Where no cell is missing, the splines are the fit: they
   reproduce linear functions. */
static void SetShares(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    if (stencil->full) {
        SetKernel(stencil, at, lean);
        return;
    }
    PointFit fit = FitAround(stencil, at, lean);
    kiriVec2 way = kiriVec2_Sub(fit.at, fit.mean);
    KIRI_EACH_INDEX(k, stencil->steps) {
        double kernel = stencil->shares.data[k];
        stencil->shares.data[k] = kernel / fit.sum + kiriVec2_Dot(FitSlope(&fit, stencil->steps.data[k], kernel), way);
    }
}

static void MakeSumOne(double* values, int32_t count)
{
    double sum = 0.0;
    KIRI_TIMES(i, count) {
        sum += values[i];
    }
    KIRI_ASSERT(count == 0 || sum > 0.0);
    KIRI_TIMES(i, count) {
        values[i] /= sum;
    }
}

/* The fit may undershoot: no value below zero, sum 1. */
static void WeighLinear(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    KIRI_ASSERT(stencil->cell != KIRI_NONE);
    int32_t count = stencil->frames.count;
    double* values = stencil->values.data;
    KIRI_ASSERT(stencil->values.count == count && stencil->weights.count == count * stencil->steps.count);
    SetShares(stencil, at, lean);
    KIRI_TIMES(i, count) {
        values[i] = 0.0;
    }
    KIRI_EACH_INDEX(k, stencil->steps) {
        const double* weights = stencil->weights.data + (size_t)k * count;
        double share = stencil->shares.data[k];
        KIRI_TIMES(i, count) {
            values[i] += weights[i] * share;
        }
    }
    KIRI_TIMES(i, count) {
        values[i] = kiriMax(values[i], 0.0);
    }
    MakeSumOne(values, count);
}

/* Linear weights have kinks at the site and where they become zero, and blending makes kinks of them as large as the
   angle between two frames. Eased weights have slope zero there. The sum of two frames stays 1. */
static double Ease(double w)
{
    return w * w * (3.0 - 2.0 * w);
}

void kiriStencil_Weigh(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean)
{
    int32_t count = stencil->frames.count;
    WeighLinear(stencil, at, lean);
    if (stencil->eased) {
        KIRI_TIMES(i, count) {
            stencil->values.data[i] = Ease(stencil->values.data[i]);
        }
        MakeSumOne(stencil->values.data, count);
    }
}

/* Puts a step in its place after the first, by square, then by the order of cells, unless it is there. There is
   room. */
static void InsertStep(kiriStencil* stencil, const kiriGrid* grid, kiriStep step)
{
    KIRI_ASSERT(stencil->steps.count < stencil->steps.capacity);
    kiriStep* steps = stencil->steps.data;
    int32_t k = stencil->steps.count, square = 3 * step.v + step.u;
    for (; k > 1; --k) {
        int32_t before = 3 * steps[k - 1].v + steps[k - 1].u;
        if (steps[k - 1].cell == step.cell) {
            return;
        }
        if (before < square || (before == square && kiriGrid_IsBefore(grid, steps[k - 1].cell, step.cell))) {
            break;
        }
    }
    for (int32_t at = stencil->steps.count++; at > k; --at) {
        steps[at] = steps[at - 1];
    }
    steps[k] = step;
}

/* Gathers the cell itself, and the cells that one straight step leads to, or two around a corner. A diagonal step of the
   grid needs both ways around it: beside a cut there is often one, and a fit without these cells would jump from cell to
   cell. */
static bool GatherSteps(kiriStencil* stencil, kiriMemory* memory, const kiriGrid* grid, int32_t cell)
{
    kiriSteps steps = kiriGrid_GetSteps(grid, cell);
    stencil->steps.count = 0;
    if (!kiriArray_Reserve(memory, &stencil->steps, (int64_t)steps.end[KIRI_DIAGONAL] + 1)) {
        return false;
    }
    if (kiriGrid_IsOpen(grid, cell)) { /* the cells around have the indices of their squares */
        stencil->steps.count = 9;
        KIRI_TIMES(k, 9) {
            int32_t u = k % 3 - 1, v = k / 3 - 1, to = cell + v * grid->mesh->squares.columns + u;
            stencil->steps.data[k == 4 ? 0 : k + (k < 4)] = (kiriStep){ to, 0, (int8_t)u, (int8_t)v };
            stencil->steps.count = grid->whole.data[to] ? stencil->steps.count : 0; /* an end of a slit changes no step */
        }
        if (stencil->steps.count > 0) {
            return true;
        }
    }
    KIRI_NEXT(stencil->steps) = (kiriStep){ cell, 0, 0, 0 };
    KIRI_TIMES(k, steps.end[0]) {
        const kiriStep to = kiriSteps_At(&steps, k);
        InsertStep(stencil, grid, to);
        kiriSteps more = kiriGrid_GetSteps(grid, to.cell);
        if (!kiriArray_ReserveMore(memory, &stencil->steps, more.end[0])) {
            return false;
        }
        KIRI_TIMES(m, more.end[0]) {
            kiriStep on = kiriSteps_At(&more, m);
            if ((to.u != 0) != (on.u != 0)) {
                on.u = (int8_t)(on.u + to.u);
                on.v = (int8_t)(on.v + to.v);
                InsertStep(stencil, grid, on);
            }
        }
    }
    return true;
}

/* Finds out which squares around have a cell, or several: of those the centres of the material are needed. */
static bool GatherMiddles(kiriStencil* stencil, kiriMemory* memory, const kiriGrid* grid)
{
    int32_t count = stencil->steps.count, seen = 0;
    if (!kiriArray_Resize(memory, &stencil->centers, count) || !kiriArray_Resize(memory, &stencil->shares, count)) {
        return false;
    }
    stencil->split = false;
    KIRI_TIMES(k, count) {
        kiriStep to = stencil->steps.data[k];
        int32_t square = 1 << (3 * (to.v + 1) + to.u + 1);
        stencil->split = stencil->split || (seen & square) != 0;
        seen |= square;
    }
    stencil->full = count == 9 && seen == 511;
    KIRI_TIMES_WHILE(stencil->split, k, count) {
        kiriMoments material = kiriGrid_Material(grid, stencil->steps.data[k].cell);
        stencil->centers.data[k] = OffsetOf(stencil, kiriMoments_Center(&material));
    }
    return true;
}

/* Gathers the frames with weight in any of the cells, sorted; `columns` says where each frame is. */
static bool GatherFrames(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape)
{
    if (stencil->columns.count < shape->rigid.count) {
        if (!kiriArrays_Reserve(memory, shape->rigid.count, &stencil->columns, &stencil->frames)) {
            return false;
        }
        kiriArray_Extend(&stencil->columns, shape->rigid.count, 0);
    }
    stencil->frames.count = 0;
    KIRI_EACH(const kiriStep, step, stencil->steps) {
        kiriSpan span = shape->spans.data[step->cell];
        KIRI_EACH_IN(w, span) {
            int32_t frame = shape->weights.data[w].frame;
            int32_t at = stencil->frames.count;
            KIRI_ASSERT_HAS(stencil->columns, frame);
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
    KIRI_EACH_INDEX(i, stencil->frames) {
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
    memset(stencil->weights.data, 0, sizeof(double) * stencil->weights.count);
    KIRI_EACH_INDEX(k, stencil->steps) {
        kiriSpan span = shape->spans.data[stencil->steps.data[k].cell];
        double* weights = stencil->weights.data + (size_t)k * count;
        KIRI_EACH_IN(w, span) {
            int32_t frame = shape->weights.data[w].frame;
            weights[stencil->columns.data[frame] - 1] = kiriCellWeight_Value(&shape->weights.data[w]);
        }
    }
    return true;
}

bool kiriStencil_Gather(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                        int32_t cell)
{
    KIRI_ASSERT(kiriGrid_IsCell(grid, cell) && cell < shape->spans.count);
    stencil->middle = kiriGrid_Middle(grid, cell);
    stencil->side = grid->side;
    stencil->eased = shape->eased;
    bool ok = GatherSteps(stencil, memory, grid, cell) && GatherMiddles(stencil, memory, grid) &&
              GatherFrames(stencil, memory, shape) && GatherWeights(stencil, memory, shape);
    KIRI_EACH_LISTED(frame, stencil->frames) {
        stencil->columns.data[frame] = 0;
    }
    stencil->cell = ok ? cell : KIRI_NONE;
    return ok;
}

/* Adds the gradients of the linear weights. */
static void SetGradients(kiriStencil* stencil, kiriVec2 at, kiriPointWeights* out)
{
    PointFit fit = FitAround(stencil, at, kiriVec2_Make(0.0, 0.0));
    KIRI_EACH_INDEX(k, stencil->steps) {
        kiriVec2 slope = FitSlope(&fit, stencil->steps.data[k], stencil->shares.data[k]);
        const double* weights = stencil->weights.data + (size_t)k * out->count;
        KIRI_EACH_INDEX(i, *out) {
            kiriPointWeight* weight = &out->data[i];
            weight->gradient = kiriVec2_AddScaled(weight->gradient, weights[i] / stencil->side, slope);
        }
    }
}

/* Goes from linear weights w to v = ease(w) / s, s being the sum: grad v = (ease'(w) grad w - v grad s) / s. */
static void EaseGradients(kiriPointWeights* out)
{
    double sum = 0.0;
    kiriVec2 slope = { 0 };
    KIRI_EACH(kiriPointWeight, weight, *out) {
        double w = weight->value;
        weight->gradient = kiriVec2_Scale(6.0 * w * (1.0 - w), weight->gradient);
        weight->value = Ease(w);
        sum += weight->value;
        slope = kiriVec2_Add(slope, weight->gradient);
    }
    KIRI_EACH(kiriPointWeight, weight, *out) {
        weight->value /= sum;
        kiriVec2 rest = kiriVec2_Sub(weight->gradient, kiriVec2_Scale(weight->value, slope));
        weight->gradient = kiriVec2_Scale(1.0 / sum, rest);
    }
}

/* Makes the gradients sum to 0: subtracts the rest, which is rounding, from the gradient of the largest weight. */
static void BalanceGradients(kiriPointWeights* out)
{
    kiriVec2 rest = { 0 };
    int32_t largest = 0;
    KIRI_EACH_INDEX(i, *out) {
        rest = kiriVec2_Add(rest, out->data[i].gradient);
        largest = out->data[i].value > out->data[largest].value ? i : largest;
    }
    if (out->count > 0) {
        out->data[largest].gradient = kiriVec2_Sub(out->data[largest].gradient, rest);
    }
}

bool kiriShape_At(const kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, int32_t cell, kiriVec2 at,
                  kiriPointWeights* out)
{
    kiriMemory scratch = kiriMemory_Like(memory);
    kiriStencil stencil = { 0 };
    bool ok = kiriStencil_Gather(&stencil, &scratch, shape, grid, cell) &&
              kiriArray_Resize(memory, out, stencil.frames.count);
    if (ok) {
        WeighLinear(&stencil, at, kiriVec2_Make(0.0, 0.0));
        KIRI_EACH_INDEX(i, *out) {
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
