#include "shape.h"

/* ---- Weights of the cells (algorithm 2) ------------------------------------------------------------------------- */

typedef struct Entry {
    int32_t cell;
    kiriWeight weight;
} Entry;

typedef struct Builder {
    const kiriMemory* memory;
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const kiriRegions* regions;
    KIRI_ARRAY(uint8_t) onBorder; /* 1 where a step from the cell leads to another region */
    int32_t frame;                /* the frame at hand, and for it: */
    kiriField* fromSite;          /* distances to its site, no farther than its weight may be above zero, */
    kiriField fromBorder;         /* and to the border of its region */
    kiriSeeds seeds;
    KIRI_ARRAY(Entry) entries; /* by frame */
} Builder;

static bool FindBorders(Builder* b)
{
    const kiriGrid* grid = b->grid;
    const int32_t* owner = b->regions->owner.data;
    if (!kiriArray_Resize(b->memory, &b->onBorder, grid->cells.count)) {
        return false;
    }
    for (int32_t c = 0; c < grid->cells.count; ++c) {
        b->onBorder.data[c] = 0;
        for (int32_t s = grid->stepStart.data[c]; s < grid->stepStart.data[c + 1]; ++s) {
            b->onBorder.data[c] |= owner[grid->steps.data[s].cell] != owner[c];
        }
    }
    return true;
}

static bool Inside(const Builder* b, int32_t cell)
{
    return b->regions->owner.data[cell] == b->frame;
}

/* The border lies up to one step beyond the reach. At twice that distance it is no nearer than half the way to the
   site, so the weight is zero from there on. */
static bool MeasureFromSite(Builder* b, const kiriSite* site)
{
    int64_t twice = 2 * ((int64_t)b->regions->regions.data[b->frame].reach + KIRI_UNIT_KNIGHT);
    int32_t limit = twice < KIRI_FAR ? (int32_t)twice : KIRI_FAR - 1;
    b->seeds.count = 0;
    return kiriSite_Seed(site, b->frame, b->memory, b->grid, b->mesh, &b->seeds) &&
           kiriField_Flood(b->fromSite, b->memory, b->grid, b->seeds.data, b->seeds.count, limit, NULL, NULL);
}

/* The border lies on the way between x and y where the distances to their sites are equal. A half is rounded up. */
static int32_t DistanceToBorder(const Builder* b, int32_t x)
{
    const int32_t* distance = b->regions->distance.data;
    int32_t least = KIRI_FAR;
    for (int32_t s = b->grid->stepStart.data[x]; s < b->grid->stepStart.data[x + 1]; ++s) {
        kiriStep step = b->grid->steps.data[s];
        if (Inside(b, step.cell) != Inside(b, x)) {
            int32_t half = (distance[step.cell] + step.length - distance[x] + 1) / 2;
            least = half < least ? half : least;
        }
    }
    return least;
}

static bool SeedBorder(Builder* b)
{
    b->seeds.count = 0;
    for (int32_t k = 0; k < b->fromSite->settled.count; ++k) {
        int32_t cell = b->fromSite->settled.data[k];
        if (b->onBorder.data[cell]) {
            kiriSeed seed = { cell, DistanceToBorder(b, cell), b->frame };
            if (seed.distance < KIRI_FAR && !kiriArray_Push(b->memory, &b->seeds, seed)) {
                return false;
            }
        }
    }
    return true;
}

/* Algorithm 2, with d the distance to the site and e the distance to the border of its region: linear along a
   straight way from site to site.

   At a site c in the middle of its square its own weight is exactly 1 (d = 0), and any other frame's exactly 0:
   let the nearest way from c to the border of that frame's region cross it from y to x, with D the distances to
   the nearest site. Then e >= (D(x) + |xy| - D(y)) / 2 + |yc|, and D(y) <= |yc|, so 2 e >= D(x) + |xy| + |yc| >=
   d. */
static double Weigh(bool inside, int32_t d, int32_t e)
{
    if (inside) {
        /* Never 0 / 0: d is 0 only in the middle of the site's own cell, and the border does not pass there. In a piece
           with one frame e is KIRI_FAR, which makes the weight 1 once it is normalised. */
        return 0.5 * (1.0 + e / ((double)d + e));
    }
    return (double)d > 2.0 * e ? 0.5 * (1.0 - e / ((double)d - e)) : 0.0;
}

static double WeightAt(const Builder* b, int32_t cell)
{
    return Weigh(Inside(b, cell), b->fromSite->distance.data[cell], b->fromBorder.distance.data[cell]);
}

/* Distances to the border are measured outside only as far as the weight is above zero: e grows along a way at least
   as fast as d. To keep the flood on its side of the border is needless: no step over it is shorter than the seed
   beyond. */
static bool HasWeight(const void* context, int32_t cell)
{
    const Builder* b = context;
    int64_t d = b->fromSite->distance.data[cell], e = b->fromBorder.distance.data[cell];
    return d != KIRI_FAR && (d > 2 * e || Inside(b, cell));
}

static bool AddFrame(Builder* b, const kiriSite* site)
{
    bool ok =
        MeasureFromSite(b, site) && SeedBorder(b) &&
        kiriField_Flood(&b->fromBorder, b->memory, b->grid, b->seeds.data, b->seeds.count, KIRI_FAR - 1, HasWeight, b);
    for (int32_t k = 0; ok && k < b->fromSite->settled.count; ++k) {
        int32_t cell = b->fromSite->settled.data[k];
        Entry entry = { cell, { b->frame, WeightAt(b, cell) } };
        ok = !(entry.weight.value > 0.0) || kiriArray_Push(b->memory, &b->entries, entry);
    }
    kiriField_Reset(b->fromSite);
    kiriField_Reset(&b->fromBorder);
    return ok;
}

/* Sorts the entries by cell; they come by frame and stay so within a cell. */
static bool Gather(kiriShape* shape, const Builder* b)
{
    int32_t cellCount = b->grid->cells.count;
    if (!kiriArray_Resize(b->memory, &shape->start, (int64_t)cellCount + 1) ||
        !kiriArray_Resize(b->memory, &shape->weights, b->entries.count)) {
        return false;
    }
    int32_t* start = shape->start.data;
    for (int32_t c = 0; c <= cellCount; ++c) {
        start[c] = 0;
    }
    for (int32_t k = 0; k < b->entries.count; ++k) {
        ++start[b->entries.data[k].cell];
    }
    for (int32_t c = 0; c < cellCount; ++c) {
        start[c + 1] += start[c];
    }
    for (int32_t k = b->entries.count - 1; k >= 0; --k) {
        shape->weights.data[--start[b->entries.data[k].cell]] = b->entries.data[k].weight;
    }
    return true;
}

static void Normalize(kiriShape* shape)
{
    for (int32_t c = 0; c + 1 < shape->start.count; ++c) {
        double sum = 0.0;
        for (int32_t k = shape->start.data[c]; k < shape->start.data[c + 1]; ++k) {
            sum += shape->weights.data[k].value;
        }
        for (int32_t k = shape->start.data[c]; k < shape->start.data[c + 1]; ++k) {
            shape->weights.data[k].value /= sum;
        }
    }
}

bool kiriShape_Build(kiriShape* shape, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                     const kiriRegions* regions, kiriField* field, const kiriSite* sites, int32_t siteCount)
{
    Builder b = { 0 };
    b.memory = memory;
    b.grid = grid;
    b.mesh = mesh;
    b.regions = regions;
    b.fromSite = field;
    bool ok = FindBorders(&b) && kiriField_Init(&b.fromBorder, memory, grid->cells.count);
    for (b.frame = 0; ok && b.frame < siteCount; ++b.frame) {
        ok = AddFrame(&b, &sites[b.frame]);
    }
    ok = ok && Gather(shape, &b);
    if (ok) {
        Normalize(shape);
    }
    kiriArray_Release(memory, &b.onBorder);
    kiriField_Release(&b.fromBorder, memory);
    kiriArray_Release(memory, &b.seeds);
    kiriArray_Release(memory, &b.entries);
    return ok;
}

void kiriShape_Release(kiriShape* shape, const kiriMemory* memory)
{
    kiriArray_Release(memory, &shape->start);
    kiriArray_Release(memory, &shape->weights);
}

/* ---- Weights of a point: moving least squares (section 4.2) ------------------------------------------------------ */

/* Quadratic B-spline, zero from 1.5 on. */
static double Spline(double t)
{
    double a = fabs(t);
    return a < 0.5 ? 0.75 - a * a : a < 1.5 ? 0.5 * (1.5 - a) * (1.5 - a) : 0.0;
}

/* A first-order fit around a point, in units of squares from the middle of its cell. Offsets of neighbours are whole
   numbers, so that cells in one line are seen as such. */
typedef struct Fit {
    kiriVec2 at;
    double splineU[3], splineV[3]; /* at offsets -1, 0, 1: the kernel is their product */
    double sum;                    /* of the kernel; and with it the offsets' */
    kiriVec2 mean;                 /* mean */
    double xx, xy, yy;             /* and (pseudo-)inverse of the second moments about the mean */
} Fit;

static double Kernel(const Fit* fit, kiriStep to)
{
    return fit->splineU[to.u + 1] * fit->splineV[to.v + 1];
}

/* The cells of a fit: k = 0 is the cell itself, then those a straight or diagonal step away. */
static kiriStep Neighbor(const kiriGrid* grid, int32_t cell, int32_t k)
{
    kiriStep own = { cell, 0, 0, 0 };
    return k == 0 ? own : grid->steps.data[grid->stepStart.data[cell] + k - 1];
}

static int32_t NeighborCount(const kiriGrid* grid, int32_t cell)
{
    return 1 + grid->lengthStart.data[KIRI_STEP_LENGTHS * cell + 2] - grid->stepStart.data[cell];
}

/* Inverts the second moments; a direction that the neighbours do not span is dropped (no slope along it). */
static void Invert(Fit* fit)
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

static Fit FitAround(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell, kiriVec2 at)
{
    kiriVec2 off = kiriVec2_Sub(at, kiriGrid_Middle(grid, mesh, cell));
    Fit fit = { kiriVec2_Scale(1.0 / grid->side, off), { 0.0 }, { 0.0 }, 0.0, { 0.0, 0.0 }, 0.0, 0.0, 0.0 };
    for (int i = 0; i < 3; ++i) {
        fit.splineU[i] = Spline(i - 1 - fit.at.x);
        fit.splineV[i] = Spline(i - 1 - fit.at.y);
    }
    for (int32_t k = 0; k < NeighborCount(grid, cell); ++k) {
        kiriStep to = Neighbor(grid, cell, k);
        double kernel = Kernel(&fit, to);
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
    Invert(&fit);
    return fit;
}

/* A weight of zero at place k. */
static bool Insert(kiriPointWeights* out, const kiriMemory* memory, int32_t k, int32_t frame)
{
    kiriPointWeight fresh = { frame, 0.0, { 0.0, 0.0 } };
    if (!kiriArray_Push(memory, out, fresh)) {
        return false;
    }
    for (int32_t m = out->count - 1; m > k; --m) {
        out->data[m] = out->data[m - 1];
    }
    out->data[k] = fresh;
    return true;
}

/* What one cell brings to value and gradient of the fit. */
static bool AddCell(const kiriShape* shape, const kiriMemory* memory, const Fit* fit, kiriStep to, double side,
                    kiriPointWeights* out)
{
    double kernel = Kernel(fit, to);
    kiriVec2 p = kiriVec2_Make(to.u - fit->mean.x, to.v - fit->mean.y);
    kiriVec2 slope = kiriVec2_Make(kernel * (fit->xx * p.x + fit->xy * p.y), kernel * (fit->xy * p.x + fit->yy * p.y));
    double share = kernel / fit->sum + kiriVec2_Dot(slope, kiriVec2_Sub(fit->at, fit->mean));
    int32_t at = 0; /* both lists are sorted by frame */
    for (int32_t k = shape->start.data[to.cell]; k < shape->start.data[to.cell + 1]; ++k) {
        kiriWeight weight = shape->weights.data[k];
        while (at < out->count && out->data[at].frame < weight.frame) {
            ++at;
        }
        if ((at == out->count || out->data[at].frame != weight.frame) && !Insert(out, memory, at, weight.frame)) {
            return false;
        }
        kiriPointWeight* sum = &out->data[at];
        sum->value += weight.value * share;
        sum->gradient = kiriVec2_Add(sum->gradient, kiriVec2_Scale(weight.value / side, slope));
    }
    return true;
}

/* The fit may undershoot: no value below zero, sum 1; what rounding leaves of the gradients goes to the largest. */
static void Complete(kiriPointWeights* out)
{
    double sum = 0.0;
    kiriVec2 rest = { 0.0, 0.0 };
    int32_t largest = 0;
    for (int32_t k = 0; k < out->count; ++k) {
        kiriPointWeight* w = &out->data[k];
        w->value = w->value > 0.0 ? w->value : 0.0;
        sum += w->value;
        rest = kiriVec2_Add(rest, w->gradient);
        largest = w->value > out->data[largest].value ? k : largest;
    }
    for (int32_t k = 0; k < out->count; ++k) {
        out->data[k].value /= sum;
    }
    if (out->count > 0) {
        out->data[largest].gradient = kiriVec2_Sub(out->data[largest].gradient, rest);
    }
}

bool kiriShape_At(const kiriShape* shape, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                  int32_t cell, kiriVec2 at, kiriPointWeights* out)
{
    Fit fit = FitAround(grid, mesh, cell, at);
    out->count = 0;
    for (int32_t k = 0; k < NeighborCount(grid, cell); ++k) {
        if (!AddCell(shape, memory, &fit, Neighbor(grid, cell, k), grid->side, out)) {
            return false;
        }
    }
    Complete(out);
    return true;
}
