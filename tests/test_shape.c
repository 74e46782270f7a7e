#define _POSIX_C_SOURCE 200809L

#include "follow.h"
#include "mesh_copy.h"

#include "field/kiri_shape.h"

#include <sys/mman.h>

typedef struct Weights {
    kiriRegions regions;
    kiriShape shape;
} Weights;

static kiriQuota All(void)
{
    kiriQuota quota = { INT64_MAX, 0, 0, false };
    return quota;
}

static void Build(Scene* scene, Weights* w, const kiriSite* sites, int32_t count)
{
    kiriSiteMove* moves = malloc(sizeof(kiriSiteMove) * (size_t)(count + 1));
    kiriQuota quota = All();
    for (int32_t i = 0; i < count; ++i) {
        moves[i] = (kiriSiteMove){ i, KIRI_NONE };
    }
    memset(w, 0, sizeof(*w));
    w->shape.rigidWeight = 0.9;
    assert_int_equal(
        kiriRegions_Update(&w->regions, &scene->memory, &scene->grid, &scene->mesh, sites, count, moves, count, &quota),
        KIRI_DONE);
    assert_int_equal(kiriShape_Update(&w->shape, &scene->memory, &scene->grid, &scene->mesh, &w->regions, sites, count,
                                      moves, count, &quota),
                     KIRI_DONE);
    free(moves);
}

static const kiriCellWeight* WeightsAt(const Weights* w, int32_t cell)
{
    return w->shape.weights.data + w->shape.spans.data[cell].first;
}

static double ValueAt(const Weights* w, int32_t cell, int32_t k)
{
    return kiriCellWeight_Raw(&WeightsAt(w, cell)[k]) / kiriShape_Sum(&w->shape, w->shape.spans.data[cell]);
}

static double WeightOf(const Weights* w, int32_t cell, int32_t frame)
{
    for (int32_t k = 0; k < w->shape.spans.data[cell].count; ++k) {
        if (WeightsAt(w, cell)[k].frame == frame) {
            return ValueAt(w, cell, k);
        }
    }
    return 0.0;
}

/* A random even lattice point in a random triangle, and its cell. */
static int32_t RandomCell(const Scene* scene, uint32_t* seed, kiriVec2* at)
{
    for (;;) {
        int32_t triangle = (int32_t)(Random(seed) % (uint32_t)scene->mesh.triangles.count);
        kiriLatticePoint corners[3];
        kiriMesh_Corners(&scene->mesh, triangle, corners);
        double a = RandomBetween(seed, 0.0, 1.0), b = RandomBetween(seed, 0.0, 1.0);
        if (a + b < 1.0) {
            double x = corners[0].x + a * (corners[1].x - corners[0].x) + b * (corners[2].x - corners[0].x);
            double y = corners[0].y + a * (corners[1].y - corners[0].y) + b * (corners[2].y - corners[0].y);
            kiriLatticePoint p = { 2 * (int32_t)(0.5 * x), 2 * (int32_t)(0.5 * y) };
            if (kiriSquares_Overlap(&scene->mesh.squares, kiriSquares_At(&scene->mesh.squares, p), corners)) {
                *at = kiriMesh_Local(&scene->mesh, p);
                return kiriGrid_CellOf(&scene->grid, &scene->mesh, triangle, p);
            }
        }
    }
}

static void CheckPoint(const Scene* scene, const Weights* w, int32_t cell, kiriVec2 at, kiriPointWeights* out)
{
    assert_true(kiriShape_At(&w->shape, (kiriMemory*)&scene->memory, &scene->grid, &scene->mesh, cell, at, out));
    double sum = 0.0, scale = 1.0 / scene->grid.side;
    kiriVec2 gradient = { 0.0, 0.0 };
    assert_true(out->count > 0);
    for (int32_t k = 0; k < out->count; ++k) {
        assert_true(k == 0 || out->data[k].frame > out->data[k - 1].frame);
        assert_true(out->data[k].value >= 0.0);
        sum += out->data[k].value;
        gradient = kiriVec2_Add(gradient, out->data[k].gradient);
    }
    AssertNear(sum, 1.0, 1e-12);
    AssertNear(gradient.x, 0.0, 1e-12 * scale);
    AssertNear(gradient.y, 0.0, 1e-12 * scale);
}

/* In the cells: exact at the sites, a partition of unity, sorted, and above zero; the rigid sums add up. */
static void CheckCells(const Scene* scene, const Weights* w, const kiriSite* sites, int32_t count)
{
    double* rigid = calloc((size_t)w->shape.rigid.count, sizeof(double));
    assert_int_equal(w->shape.spans.count, scene->grid.cells.count);
    for (int32_t c = 0; c < scene->grid.cells.count; ++c) {
        const kiriCellWeight* weights = WeightsAt(w, c);
        int32_t n = w->shape.spans.data[c].count;
        double sum = 0.0;
        for (int32_t k = 0; k < n; ++k) {
            assert_true(k == 0 || weights[k].frame > weights[k - 1].frame);
            assert_true(ValueAt(w, c, k) > 0.0);
            sum += ValueAt(w, c, k);
            rigid[weights[k].frame] += ValueAt(w, c, k) > w->shape.rigidWeight ? kiriGrid_Area(&scene->grid, c) : 0.0;
        }
        assert_int_equal(n > 0, w->regions.field.owner.data[c] != KIRI_NONE);
        if (n > 0) {
            AssertNear(sum, 1.0, 1e-12);
            assert_true(WeightOf(w, c, w->regions.field.owner.data[c]) > 0.0);
        }
    }
    for (int32_t i = 0; i < w->shape.rigid.count; ++i) {
        double square = scene->grid.side * scene->grid.side / 1099511627776.0;
        AssertNear((double)w->shape.rigid.data[i] * square, rigid[i], 1e-9);
    }
    for (int32_t i = 0; i < count; ++i) {
        const kiriCellWeight* weights = WeightsAt(w, sites[i].cell);
        assert_int_equal(w->shape.spans.data[sites[i].cell].count, 1);
        assert_int_equal(weights->frame, i);
        assert_true(ValueAt(w, sites[i].cell, 0) == 1.0);
    }
    free(rigid);
}

/* Algorithm 2 from distances that are relaxed over all steps until nothing changes: no flood, no repair, no limit. */
static void Relax(const Scene* scene, int32_t* distance)
{
    for (bool changed = true; changed;) {
        changed = false;
        for (int32_t c = 0; c < scene->grid.cells.count; ++c) {
            kiriSteps steps;
            kiriGrid_GetSteps(&scene->grid, c, &steps);
            for (int32_t s = 0; s < steps.end[2]; ++s) {
                kiriStep to = steps.data[s];
                if (distance[c] != KIRI_FAR && distance[c] + to.length < distance[to.cell]) {
                    distance[to.cell] = distance[c] + to.length;
                    changed = true;
                }
            }
        }
    }
}

static void Measure(const Scene* scene, const Weights* w, const kiriSite* site, int32_t frame, int32_t* d, int32_t* e)
{
    const int32_t *owner = w->regions.field.owner.data, *distance = w->regions.field.distance.data;
    for (int32_t c = 0; c < scene->grid.cells.count; ++c) {
        d[c] = kiriSite_SeedAt(site, frame, &scene->grid, &scene->mesh, c).distance;
        e[c] = KIRI_FAR;
        kiriSteps steps;
        kiriGrid_GetSteps(&scene->grid, c, &steps);
        for (int32_t s = 0; s < steps.end[2]; ++s) {
            kiriStep to = steps.data[s];
            int32_t half = (distance[to.cell] + to.length - distance[c] + 1) / 2;
            e[c] = (owner[c] == frame) != (owner[to.cell] == frame) && half < e[c] ? half : e[c];
        }
    }
    Relax(scene, d);
    Relax(scene, e);
}

static void WeightsAreThoseOfThePaper(void** state)
{
    (void)state;
    uint32_t seed = 71;
    for (int round = 0; round < 40; ++round) {
        Scene scene;
        kiriSites sites;
        Weights w;
        Scene_InitRandom(&scene, &sites, 1 + (int32_t)(Random(&seed) % 10), &seed);
        Build(&scene, &w, sites.data, sites.count);
        int32_t cells = scene.grid.cells.count;
        int32_t *d = malloc(sizeof(int32_t) * (size_t)cells), *e = malloc(sizeof(int32_t) * (size_t)cells);
        double* sum = calloc((size_t)cells, sizeof(double));
        for (int pass = 0; pass < 2; ++pass) {
            for (int32_t i = 0; i < sites.count; ++i) {
                Measure(&scene, &w, &sites.data[i], i, d, e);
                for (int32_t c = 0; c < cells; ++c) {
                    bool inside = w.regions.field.owner.data[c] == i, reached = d[c] != KIRI_FAR;
                    double ratio = inside ? e[c] / ((double)d[c] + e[c]) : -e[c] / ((double)d[c] - e[c]);
                    double weight = reached && (inside || d[c] > 2.0 * e[c]) ? 0.5 + 0.5 * ratio : 0.0;
                    sum[c] += pass == 0 ? weight : 0.0;
                    if (pass == 1 && sum[c] > 0.0) {
                        AssertNear(WeightOf(&w, c, i), weight / sum[c], 1e-14);
                    }
                }
            }
        }
        free(d);
        free(e);
        free(sum);
        kiriArray_Release(&scene.memory, &sites);
        Scene_Release(&scene);
    }
}

static void RandomSheetsArePartitioned(void** state)
{
    (void)state;
    uint32_t seed = 17;
    for (int round = 0; round < 100; ++round) {
        Scene scene;
        kiriSites sites;
        Weights w;
        kiriPointWeights out = { 0 };
        Scene_InitRandom(&scene, &sites, 1 + (int32_t)(Random(&seed) % 20), &seed);
        Build(&scene, &w, sites.data, sites.count);
        CheckCells(&scene, &w, sites.data, sites.count);
        for (int k = 0; k < 200; ++k) {
            kiriVec2 at;
            int32_t cell = RandomCell(&scene, &seed, &at);
            CheckPoint(&scene, &w, cell, at, &out);
        }
        kiriArray_Release(&scene.memory, &out);
        kiriArray_Release(&scene.memory, &sites);
        Scene_Release(&scene);
    }
}

/* Sites anywhere in their cells, in neighbouring cells too. */
static void CrowdedSitesArePartitioned(void** state)
{
    (void)state;
    uint32_t seed = 23;
    Scene scene;
    kiriSite sites[64];
    Scene_Init(&scene, 1.0, 1.0, 3, 3, 8);
    Scene_BuildGrid(&scene);
    for (int round = 0; round < 50; ++round) {
        Weights w;
        int32_t count = 0;
        for (int32_t c = 0; c < 64; ++c) {
            if (Random(&seed) % 3 == 0) {
                double half = 0.499 * scene.grid.side;
                kiriVec2 off = RandomVec2(&seed, -half, half);
                sites[count].at = kiriVec2_Add(kiriGrid_Middle(&scene.grid, &scene.mesh, c), off);
                sites[count++].cell = c;
            }
        }
        Build(&scene, &w, sites, count);
        CheckCells(&scene, &w, sites, 0);
    }
    Scene_Release(&scene);
}

/* On the straight way from site to site weights are linear; beside it nearly so. */
static void LinearBetweenTwoFrames(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    Scene_Init(&scene, 1.0, 0.25, 8, 2, 36);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 4.5 / 36, 0.125), Scene_Site(&scene, 32.5 / 36, 0.125) };
    Build(&scene, &w, sites, 2);
    CheckCells(&scene, &w, sites, 2);
    double length = sites[1].at.x - sites[0].at.x;
    for (int32_t c = 0; c < scene.grid.cells.count; ++c) {
        kiriVec2 p = kiriGrid_Middle(&scene.grid, &scene.mesh, c);
        double x = (p.x - sites[0].at.x) / length;
        if (x >= 0.0 && x <= 1.0) {
            bool onTheWay = fabs(p.y - sites[0].at.y) < 1e-9;
            AssertNear(WeightOf(&w, c, 0), 1.0 - x, onTheWay ? 1e-12 : 0.06);
            AssertNear(WeightOf(&w, c, 1), x, onTheWay ? 1e-12 : 0.06);
        }
    }
    Scene_Release(&scene);
}

/* An odd number of lengths between the sites: the border lies between two cells, and halves are rounded. */
static void LinearWhereTheBorderIsBetweenCells(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    Scene_Init(&scene, 1.0, 0.25, 8, 2, 36);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 4.5 / 36, 0.125), Scene_Site(&scene, 31.5 / 36, 0.125) };
    Build(&scene, &w, sites, 2);
    for (int32_t k = 0; k <= 27; ++k) {
        AssertNear(WeightOf(&w, Scene_Cell(&scene, (4.5 + k) / 36, 0.125), 0), 1.0 - k / 27.0, 1e-12);
    }
    Scene_Release(&scene);
}

/* Frames 0 and 1 face each other over a slit whose tip is far: neither reaches the other side near its root, and
   weights change little from cell to cell wherever there is material between, around the tip too. */
static void WeightsKnowTheSlit(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    Scene_Init(&scene, 1.0, 1.0, 10, 10, 41);
    Scene_Slit(&scene, 0.5, 0.0, 0.5, 0.8);
    Scene_BuildGrid(&scene);
    kiriSite sites[4] = { Scene_Site(&scene, 0.3, 0.15), Scene_Site(&scene, 0.7, 0.15), Scene_Site(&scene, 0.3, 0.7),
                          Scene_Site(&scene, 0.7, 0.7) };
    Build(&scene, &w, sites, 4);
    CheckCells(&scene, &w, sites, 4);
    int32_t beside = 0;
    for (int32_t c = 0; c < scene.grid.cells.count; ++c) {
        kiriMoments material = kiriGrid_Material(&scene.grid, &scene.mesh, c);
        kiriVec2 p = kiriMoments_Center(&material);
        if (p.y < 0.5) {
            ++beside;
            assert_true(WeightOf(&w, c, p.x < 0.5 ? 1 : 0) == 0.0);
        }
    }
    assert_true(beside > 41 * 20);
    for (int32_t f = 0; f < scene.grid.faces.count; ++f) {
        const kiriFace* face = &scene.grid.faces.data[f];
        for (int i = 0; i < 4; ++i) {
            AssertNear(WeightOf(&w, face->cell[0], i), WeightOf(&w, face->cell[1], i), 4.0 / 41.0 / 0.4);
        }
    }
    double jump = fabs(WeightOf(&w, Scene_Cell(&scene, 0.48, 0.1), 0) - WeightOf(&w, Scene_Cell(&scene, 0.52, 0.1), 0));
    assert_true(jump > 0.5);
    Scene_Release(&scene);
}

static void PieceWithOneFrameIsItsOwn(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    kiriPointWeights out = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&scene, 0.5, 0.0, 0.5, 1.0);
    Scene_BuildGrid(&scene);
    kiriSite sites[3] = { Scene_Site(&scene, 0.25, 0.25), Scene_Site(&scene, 0.75, 0.25),
                          Scene_Site(&scene, 0.7, 0.8) };
    Build(&scene, &w, sites, 3);
    uint32_t seed = 5;
    for (int k = 0; k < 500; ++k) {
        kiriVec2 at;
        int32_t cell = RandomCell(&scene, &seed, &at);
        CheckPoint(&scene, &w, cell, at, &out);
        kiriMoments material = kiriGrid_Material(&scene.grid, &scene.mesh, cell);
        if (kiriMoments_Center(&material).x < 0.5) {
            assert_true(WeightOf(&w, cell, 0) == 1.0);
            assert_int_equal(out.count, 1);
            assert_true(out.data[0].value == 1.0);
            AssertNear(out.data[0].gradient.x, 0.0, 1e-11);
        } else {
            assert_true(WeightOf(&w, cell, 0) == 0.0);
        }
    }
    kiriArray_Release(&scene.memory, &out);
    Scene_Release(&scene);
}

/* Cells without an owner have no weights, nor have points in them. */
static void PieceWithoutFrameHasNoWeights(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    kiriPointWeights out = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 10, 10, 21);
    Scene_Slit(&scene, 0.5, 0.0, 0.5, 1.0);
    Scene_BuildGrid(&scene);
    kiriSite site = Scene_Site(&scene, 0.25, 0.25);
    Build(&scene, &w, &site, 1);
    CheckCells(&scene, &w, &site, 1);
    kiriVec2 at = { 0.75, 0.5 };
    assert_true(
        kiriShape_At(&w.shape, &scene.memory, &scene.grid, &scene.mesh, Scene_Cell(&scene, at.x, at.y), at, &out));
    assert_int_equal(out.count, 0);
    kiriArray_Release(&scene.memory, &out);
    Scene_Release(&scene);
}

/* Do the cell and those around it span the plane? */
static bool Spans(const Scene* scene, int32_t cell)
{
    kiriVec2 middle = kiriGrid_Middle(&scene->grid, &scene->mesh, cell), first = { 0.0, 0.0 };
    kiriSteps steps;
    kiriGrid_GetSteps(&scene->grid, cell, &steps);
    for (int32_t s = 0; s < steps.end[2]; ++s) {
        if (steps.data[s].length <= KIRI_UNIT_DIAGONAL) {
            kiriVec2 p = kiriVec2_Sub(kiriGrid_Middle(&scene->grid, &scene->mesh, steps.data[s].cell), middle);
            if (fabs(first.x * p.y - first.y * p.x) > 0.5 * scene->grid.side * scene->grid.side) {
                return true;
            }
            first = p;
        }
    }
    return false;
}

/* Two weights that are linear at the middles of all cells are linear, with their slope, at every point. */
static void FitIsExactForLinearFields(void** state)
{
    (void)state;
    uint32_t seed = 29;
    int32_t spanned = 0;
    for (int round = 0; round < 30; ++round) {
        Scene scene;
        kiriSites sites;
        Weights w;
        kiriPointWeights out = { 0 };
        Scene_InitRandom(&scene, &sites, 1, &seed);
        memset(&w, 0, sizeof(w));
        double gu = RandomBetween(&seed, -0.3, 0.3), gv = RandomBetween(&seed, -0.3, 0.3);
        for (int32_t c = 0; c < scene.grid.cells.count; ++c) {
            kiriVec2 p = kiriGrid_Middle(&scene.grid, &scene.mesh, c);
            kiriSpan span = { 2 * c, 2 };
            double share = 0.5 + gu * (p.x - 0.5) + gv * (p.y - 0.5);
            kiriCellWeight a = kiriCellWeight_Make(3, share), b = kiriCellWeight_Make(7, 1.0 - share);
            assert_true(kiriArray_Push(&scene.memory, &w.shape.spans, span));
            assert_true(kiriArray_Push(&scene.memory, &w.shape.weights, a));
            assert_true(kiriArray_Push(&scene.memory, &w.shape.weights, b));
        }
        while (w.shape.rigid.count < 8) {
            assert_true(kiriArray_Push(&scene.memory, &w.shape.rigid, 0));
        }
        for (int k = 0; k < 300; ++k) {
            kiriVec2 at;
            int32_t cell = RandomCell(&scene, &seed, &at);
            CheckPoint(&scene, &w, cell, at, &out);
            if (Spans(&scene, cell)) {
                ++spanned;
                assert_int_equal(out.count, 2);
                AssertNear(out.data[0].value, 0.5 + gu * (at.x - 0.5) + gv * (at.y - 0.5), 1e-9);
                AssertNear(out.data[0].gradient.x, gu, 1e-7);
                AssertNear(out.data[0].gradient.y, gv, 1e-7);
                AssertNear(out.data[1].gradient.x, -gu, 1e-7);
            }
        }
        kiriArray_Release(&scene.memory, &out);
        kiriArray_Release(&scene.memory, &sites);
        Scene_Release(&scene);
    }
    assert_true(spanned > 5000);
}

/* One row of cells: a slope along it, none across. The last cell that frame 1 reaches is more than twice as far as its
   region's farthest cell, since the border lies between two cells. */
static void FitDropsWhatIsNotSpanned(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    kiriPointWeights out = { 0 };
    Scene_Init(&scene, 1.0, 0.09, 10, 1, 10);
    Scene_BuildGrid(&scene);
    assert_int_equal(scene.grid.cells.count, 10);
    kiriSite sites[2] = { Scene_MiddleOf(&scene, 0), Scene_MiddleOf(&scene, 8) };
    Build(&scene, &w, sites, 2);
    for (int k = 0; k < 13; ++k) { /* up to the cell before the second frame */
        kiriVec2 at = { 0.11 + 0.05 * k, 0.002 + 0.005 * k };
        CheckPoint(&scene, &w, Scene_Cell(&scene, at.x, at.y), at, &out);
        double x = (at.x - sites[0].at.x) / (sites[1].at.x - sites[0].at.x);
        assert_int_equal(out.count, 2);
        AssertNear(out.data[1].value, x, 1e-9);
        AssertNear(out.data[1].gradient.x, 1.25, 1e-5);
        AssertNear(out.data[1].gradient.y, 0.0, 1e-9);
    }
    kiriArray_Release(&scene.memory, &out);
    Scene_Release(&scene);
}

static void SingleCellHasNoSlope(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    kiriPointWeights out = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 2, 2, 1);
    Scene_BuildGrid(&scene);
    assert_int_equal(scene.grid.cells.count, 1);
    kiriSite only = Scene_MiddleOf(&scene, 0);
    Build(&scene, &w, &only, 1);
    CheckPoint(&scene, &w, 0, kiriVec2_Make(0.1, 0.9), &out);
    assert_int_equal(out.count, 1);
    assert_true(out.data[0].value == 1.0 && out.data[0].gradient.x == 0.0 && out.data[0].gradient.y == 0.0);
    kiriArray_Release(&scene.memory, &out);
    Scene_Release(&scene);
}

/* Between two frames the gradient is one over the distance. */
static void GradientBetweenTwoFrames(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    kiriPointWeights out = { 0 };
    Scene_Init(&scene, 1.0, 0.25, 8, 2, 36);
    Scene_BuildGrid(&scene);
    kiriSite sites[2] = { Scene_Site(&scene, 4.5 / 36, 0.125), Scene_Site(&scene, 32.5 / 36, 0.125) };
    Build(&scene, &w, sites, 2);
    kiriVec2 at = { 0.4, 0.125 };
    CheckPoint(&scene, &w, Scene_Cell(&scene, at.x, at.y), at, &out);
    assert_int_equal(out.count, 2);
    AssertNear(out.data[1].gradient.x * (sites[1].at.x - sites[0].at.x), 1.0, 0.02);
    AssertNear(out.data[1].gradient.y, 0.0, 0.02);
    AssertNear(out.data[1].value, (at.x - sites[0].at.x) / (sites[1].at.x - sites[0].at.x), 0.01);
    kiriArray_Release(&scene.memory, &out);
    Scene_Release(&scene);
}

/* Where linear weights w go to when each changes by h along its gradient, in the direction of u or v: eased, sum 1. */
static double EasedAt(const kiriPointWeights* linear, int32_t which, double h, int axis)
{
    double sum = 0.0, value = 0.0;
    for (int32_t i = 0; i < linear->count; ++i) {
        kiriPointWeight w = linear->data[i];
        double moved = w.value + h * (axis == 0 ? w.gradient.x : w.gradient.y);
        double eased = moved * moved * (3.0 - 2.0 * moved);
        sum += eased;
        value = i == which ? eased : value;
    }
    return value / sum;
}

static void CheckEased(const kiriPointWeights* linear, const kiriPointWeights* eased, double side)
{
    const double h = 1e-5 * side;
    assert_int_equal(eased->count, linear->count);
    for (int32_t i = 0; i < eased->count; ++i) {
        kiriPointWeight w = eased->data[i];
        double u = EasedAt(linear, i, h, 0) - EasedAt(linear, i, -h, 0);
        double v = EasedAt(linear, i, h, 1) - EasedAt(linear, i, -h, 1);
        assert_int_equal(w.frame, linear->data[i].frame);
        AssertNear(w.value, EasedAt(linear, i, 0.0, 0), 1e-14);
        AssertNear(side * w.gradient.x, side * u / (2.0 * h), 1e-8);
        AssertNear(side * w.gradient.y, side * v / (2.0 * h), 1e-8);
    }
}

/* Eased weights and their gradients follow from the linear ones; a frame's own is flat where it stands. */
static void EasedWeightsFollowLinearOnes(void** state)
{
    (void)state;
    uint32_t seed = 41;
    double apart = 0.0;
    for (int round = 0; round < 20; ++round) {
        Scene scene;
        kiriSites sites;
        Weights w;
        kiriPointWeights linear = { 0 }, eased = { 0 };
        Scene_InitRandom(&scene, &sites, 1 + (int32_t)(Random(&seed) % 20), &seed);
        Build(&scene, &w, sites.data, sites.count);
        for (int k = 0; k < 100; ++k) {
            kiriVec2 at;
            int32_t cell = RandomCell(&scene, &seed, &at);
            w.shape.eased = false;
            CheckPoint(&scene, &w, cell, at, &linear);
            w.shape.eased = true;
            CheckPoint(&scene, &w, cell, at, &eased);
            CheckEased(&linear, &eased, scene.grid.side);
            apart = fmax(apart, fabs(eased.data[0].value - linear.data[0].value));
        }
        kiriArray_Release(&scene.memory, &linear);
        kiriArray_Release(&scene.memory, &eased);
        kiriArray_Release(&scene.memory, &sites);
        Scene_Release(&scene);
    }
    assert_true(apart > 0.09); /* 3 w^2 - 2 w^3 is up to 0.096 off the line */
}

/* From cell to cell the fit hardly jumps where their material is shared. */
static void FitIsContinuousOverFaces(void** state)
{
    (void)state;
    Scene scene;
    Weights w;
    kiriPointWeights a = { 0 }, b = { 0 };
    Scene_Init(&scene, 1.0, 1.0, 4, 4, 20);
    Scene_BuildGrid(&scene);
    kiriSite sites[4] = { Scene_Site(&scene, 0.2, 0.3), Scene_Site(&scene, 0.8, 0.2), Scene_Site(&scene, 0.3, 0.8),
                          Scene_Site(&scene, 0.7, 0.7) };
    Build(&scene, &w, sites, 4);
    for (int32_t f = 0; f < scene.grid.faces.count; ++f) {
        const kiriFace* face = &scene.grid.faces.data[f];
        kiriVec2 middle = kiriGrid_Stretch(&scene.grid, &scene.mesh, f).middle;
        CheckPoint(&scene, &w, face->cell[0], middle, &a);
        CheckPoint(&scene, &w, face->cell[1], middle, &b);
        for (int32_t k = 0; k < a.count; ++k) {
            for (int32_t m = 0; m < b.count; ++m) {
                if (a.data[k].frame == b.data[m].frame) {
                    AssertNear(a.data[k].value, b.data[m].value, 1e-12);
                }
            }
        }
    }
    kiriArray_Release(&scene.memory, &a);
    kiriArray_Release(&scene.memory, &b);
    Scene_Release(&scene);
}

/* ---- Following cuts ---------------------------------------------------------------------------------------------- */

static void CompareWithScratch(const Follow* f)
{
    Follow scratch;
    Follow_ScratchWeights(&scratch, f);
    Follow_CompareReaches(f, &scratch);
    Follow_CompareWeights(f, &scratch);
    Follow_Release(&scratch);
}

/* Lists, weights and rigid sums after any cuts are those from scratch, bit for bit, whatever the quota. */
static void CutSheetsEqualThoseFromScratch(void** state)
{
    (void)state;
    int64_t cells = 0, recomputed = 0;
    int32_t born = 0;
    for (uint32_t round = 0; round < 40; ++round) {
        uint32_t seed = 17 + 7919 * round;
        Scene scene;
        Follow f;
        Wander wander;
        memset(&wander, 0, sizeof(wander));
        Scene_InitMesh(&scene, 1.0, RandomBetween(&seed, 0.3, 1.0), 7, 6, 3 + (int32_t)(Random(&seed) % 28), 0.2, seed);
        Scene_CutAtRandom(&scene, (int32_t)(Random(&seed) % 4), 8, &seed);
        kiriMesh_Commit(&scene.mesh);
        Follow_Start(&f, &scene, 1 + (int32_t)(Random(&seed) % 14), 0, &seed);
        f.slice = round % 3 == 2 ? 1 + round % 5 : 0;
        double length = RandomBetween(&seed, 0.3, 2.5) * f.grid.side;
        int32_t sites = f.sites.count;
        for (int step = 0; step < 30; ++step) {
            for (uint32_t cuts = 1 + Random(&seed) % 2; cuts > 0; --cuts) {
                Wander_Cut(&wander, &f, length, &seed);
            }
            Follow_Weights(&f, &seed);
            cells += f.grid.cellCount;
            recomputed += f.shape.recomputed;
            Follow_Commit(&f);
            CompareWithScratch(&f);
            kiriSquares_ClearDirty(&scene.mesh.squares);
        }
        born += f.sites.count - sites;
        Follow_Release(&f);
        Scene_Release(&scene);
    }
    assert_true(born > 100);
    assert_true(2 * recomputed < cells);
}

/* Brings the weights up to date; all cells that the grid has made are among the changes, and none that is gone. */
static void CheckMadeAreChanged(Follow* f)
{
    int32_t made = f->grid.changes.made.count, *cells = malloc(sizeof(int32_t) * (size_t)(made + 1));
    uint8_t* changed = calloc((size_t)f->grid.cells.count, 1);
    for (int32_t k = 0; k < made; ++k) {
        cells[k] = f->grid.changes.made.data[k];
    }
    assert_int_equal(Follow_Shape(f), KIRI_DONE);
    for (int32_t k = 0; k < f->shape.changes.count; ++k) {
        assert_true(kiriGrid_IsCell(&f->grid, f->shape.changes.data[k]));
        assert_int_equal(changed[f->shape.changes.data[k]]++, 0);
    }
    for (int32_t k = 0; k < made; ++k) {
        assert_true(changed[cells[k]]);
    }
    free(cells);
    free(changed);
}

/* Cuts that are taken back: cells that have weights go, and others come. */
static void CutsTakenBackEqualThoseFromScratch(void** state)
{
    (void)state;
    int32_t gone = 0, weighed = 0;
    for (uint32_t round = 0; round < 24; ++round) {
        uint32_t seed = 23 + 104729 * round;
        Scene scene;
        Follow f;
        Scene_InitMesh(&scene, 1.0, 0.8, 6, 5, 4 + (int32_t)(Random(&seed) % 16), 0.2, seed);
        kiriMesh_Commit(&scene.mesh);
        Follow_Start(&f, &scene, 2 + (int32_t)(Random(&seed) % 10), 0, &seed);
        f.slice = round % 3 == 2 ? 3 : 0;
        for (int step = 0; step < 8; ++step) {
            Wander wander;
            memset(&wander, 0, sizeof(wander));
            Whole whole = Whole_Make(&scene.mesh);
            kiriMesh_Begin(&scene.mesh);
            for (int32_t cuts = 4 + (int32_t)(Random(&seed) % 8); cuts > 0; --cuts) {
                Wander_Move(&wander, &f, 1.5 * f.grid.side, &seed);
            }
            for (int back = 0; back < 2; ++back) {
                if (back) {
                    Whole_Restore(&whole, &scene.mesh);
                    Whole_Free(&whole);
                }
                Follow_Grid(&f);
                for (int32_t k = 0; k < f.grid.changes.gone.count; ++k, ++gone) {
                    weighed += f.shape.spans.data[f.grid.changes.gone.data[k]].count > 0;
                }
                Follow_Relocate(&f);
                Follow_AllRegions(&f);
                CheckMadeAreChanged(&f);
                CompareWithScratch(&f);
                assert_true(Follow_Links(&f));
                if (back || round % 2) {
                    Follow_Commit(&f); /* else cells go that are among the changes */
                }
                kiriSquares_ClearDirty(&scene.mesh.squares);
            }
        }
        Follow_Release(&f);
        Scene_Release(&scene);
    }
    assert_true(gone > 500 && weighed == gone);
}

/* Sites that are moved, and moved back. */
static void SitesMove(void** state)
{
    (void)state;
    uint32_t seed = 99;
    Scene scene;
    Follow f;
    Scene_InitMesh(&scene, 1.0, 0.8, 5, 4, 19, 0.2, seed);
    Scene_CutAtRandom(&scene, 4, 8, &seed);
    kiriMesh_Commit(&scene.mesh);
    Follow_Start(&f, &scene, 8, 0, &seed);
    for (int step = 0; step < 60; ++step) {
        int32_t frame = (int32_t)(Random(&seed) % (uint32_t)f.sites.count), cell = Follow_AnyCell(&f, &seed);
        kiriSite old = f.sites.data[frame], site = { kiriGrid_Middle(&f.grid, f.mesh, cell), cell };
        if (!Follow_IsTaken(&f, cell)) {
            Follow_Move(&f, frame, site);
            Follow_AllRegions(&f);
            assert_int_equal(Follow_Shape(&f), KIRI_DONE);
            if (step % 2 && !Follow_IsTaken(&f, old.cell)) {
                Follow_Move(&f, frame, old);
                Follow_AllRegions(&f);
                assert_int_equal(Follow_Shape(&f), KIRI_DONE);
            }
            CompareWithScratch(&f);
        }
    }
    Follow_Release(&f);
    Scene_Release(&scene);
}

/* `changes` has every cell whose weights differ from what they were, and those whose steps do, each once. */
static void ChangesAreComplete(void** state)
{
    (void)state;
    uint32_t seed = 5;
    Scene scene;
    Follow f;
    Wander wander;
    memset(&wander, 0, sizeof(wander));
    Scene_InitMesh(&scene, 1.0, 0.8, 5, 4, 19, 0.2, seed);
    kiriMesh_Commit(&scene.mesh);
    Follow_Start(&f, &scene, 8, 0, &seed);
    for (int step = 0; step < 60; ++step) {
        int32_t old = f.grid.cells.count, weights = f.shape.weights.count;
        kiriSpan* spans = malloc(sizeof(kiriSpan) * (size_t)old);
        kiriCellWeight* was = malloc(sizeof(kiriCellWeight) * (size_t)weights);
        memcpy(spans, f.shape.spans.data, sizeof(kiriSpan) * (size_t)old);
        memcpy(was, f.shape.weights.data, sizeof(kiriCellWeight) * (size_t)weights);
        Wander_Cut(&wander, &f, 1.2 * f.grid.side, &seed);
        Follow_Weights(&f, &seed);
        int32_t* isChanged = calloc((size_t)f.grid.cells.count, sizeof(int32_t));
        for (int32_t k = 0; k < f.shape.changes.count; ++k) {
            assert_true(kiriGrid_IsCell(&f.grid, f.shape.changes.data[k]));
            assert_int_equal(isChanged[f.shape.changes.data[k]]++, 0);
        }
        for (int32_t c = 0; c < f.grid.cells.count; ++c) {
            kiriSpan span = f.shape.spans.data[c];
            bool same = c < old && spans[c].count == span.count &&
                        memcmp(was + spans[c].first, f.shape.weights.data + span.first,
                               sizeof(kiriCellWeight) * (size_t)span.count) == 0;
            assert_true(same || isChanged[c] || !kiriGrid_IsCell(&f.grid, c));
        }
        assert_true(f.shape.recomputed <= f.shape.changes.count);
        Follow_Commit(&f);
        assert_int_equal(f.shape.changes.count, 0);
        kiriSquares_ClearDirty(&scene.mesh.squares);
        free(spans);
        free(was);
        free(isChanged);
    }
    Follow_Release(&f);
    Scene_Release(&scene);
}

/* A stencil that has been through other cells gives what a fresh one does. */
static void StencilsEqualPoints(void** state)
{
    (void)state;
    uint32_t seed = 31;
    Scene scene;
    kiriSites sites;
    Weights w;
    kiriPointWeights out = { 0 };
    kiriStencil stencil = { 0 };
    Scene_InitRandom(&scene, &sites, 12, &seed);
    Build(&scene, &w, sites.data, sites.count);
    for (int k = 0; k < 1000; ++k) {
        kiriVec2 at;
        int32_t cell = RandomCell(&scene, &seed, &at);
        w.shape.eased = k % 2 == 1;
        CheckPoint(&scene, &w, cell, at, &out);
        assert_true(kiriStencil_Gather(&stencil, &scene.memory, &w.shape, &scene.grid, &scene.mesh, cell));
        kiriStencil_Weigh(&stencil, at, (kiriVec2){ 0.0, 0.0 });
        assert_int_equal(stencil.frames.count, out.count);
        for (int32_t i = 0; i < out.count; ++i) {
            assert_int_equal(stencil.frames.data[i], out.data[i].frame);
            assert_true(stencil.values.data[i] == out.data[i].value);
        }
    }
    kiriArray_Release(&scene.memory, &out);
    kiriArray_Release(&scene.memory, &sites);
    Scene_Release(&scene);
}

/* Memory that can be made read-only. */
enum { ARENA_BYTES = 1 << 25, ARENA_ALIGNMENT = 1 << 16 };
typedef struct Arena {
    char* bytes;
    int64_t used;
} Arena;

static void* ArenaAlloc(void* user, int64_t bytes)
{
    Arena* arena = user;
    char* block = arena->bytes + arena->used;
    arena->used += (bytes + 15) / 16 * 16;
    assert_true(arena->used <= ARENA_BYTES);
    return block;
}

static void ArenaFree(void* user, void* pointer)
{
    (void)user;
    (void)pointer;
}

/* Weights of points are asked for where all that they are made from is read-only: threads may ask at the same time. */
static void PointsOnlyRead(void** state)
{
    (void)state;
    uint32_t seed = 61;
    Arena arena = { NULL, 0 };
    void* bytes;
    assert_int_equal(posix_memalign(&bytes, ARENA_ALIGNMENT, ARENA_BYTES), 0);
    arena.bytes = bytes;
    memset(bytes, 0, ARENA_BYTES);
    Scene* scene = ArenaAlloc(&arena, sizeof(Scene));
    Weights* w = ArenaAlloc(&arena, sizeof(Weights));
    scene->memory = kiriMemory_Make(ArenaAlloc, ArenaFree, &arena);
    Scene_MakeMesh(scene, 1.0, 0.8, 9, 8, 14, 0.2, seed);
    Scene_CutAtRandom(scene, 6, 10, &seed);
    Scene_BuildGrid(scene);
    kiriSite sites[2];
    for (int k = 0; k < 2; ++k) {
        sites[k] = Scene_MiddleOf(scene, k * (scene->grid.cells.count - 1));
    }
    Build(scene, w, sites, 2);
    assert_int_equal(mprotect(bytes, ARENA_BYTES, PROT_READ), 0);
    kiriMemory memory = kiriMemory_Make(NULL, NULL, NULL);
    kiriPointWeights out = { 0 };
    int32_t both = 0;
    for (int k = 0; k < 500; ++k) {
        kiriVec2 at;
        int32_t cell = RandomCell(scene, &seed, &at);
        assert_true(kiriShape_At(&w->shape, &memory, &scene->grid, &scene->mesh, cell, at, &out));
        both += out.count == 2;
    }
    assert_true(both > 50);
    kiriMemory_FreeAll(&memory);
    assert_int_equal(mprotect(bytes, ARENA_BYTES, PROT_READ | PROT_WRITE), 0);
    free(bytes);
}

/* Wherever memory fails, a reset and an update from scratch make all right again. */
static void FailingAllocatorLeaksNothing(void** state)
{
    (void)state;
    int32_t failures = 0;
    bool done = false;
    for (int64_t budget = 0; !done; ++budget) {
        uint32_t seed = 5;
        Scene scene;
        Follow f;
        Wander wander;
        memset(&wander, 0, sizeof(wander));
        Scene_InitMesh(&scene, 1.0, 0.8, 5, 4, 12, 0.2, seed);
        kiriMesh_Commit(&scene.mesh);
        Follow_Start(&f, &scene, 6, 0, &seed);
        for (int step = 0; step < 12; ++step) {
            Wander_Cut(&wander, &f, 2.0 * f.grid.side, &seed);
        }
        Follow_Grid(&f);
        Follow_Relocate(&f);
        Follow_AllRegions(&f);
        if (budget % 2 == 1) {
            memset(&f.shape, 0, sizeof(f.shape));
            Follow_StartAgain(&f);
        }
        scene.purse.budget = budget / 2;
        done = Follow_Shape(&f) == KIRI_DONE;
        scene.purse.budget = -1;
        if (!done) {
            ++failures;
            Follow_StartAgain(&f);
            assert_int_equal(Follow_Shape(&f), KIRI_DONE);
        }
        CompareWithScratch(&f);
        Follow_Release(&f);
        Scene_Release(&scene);
        done = done && budget % 2 == 1;
        assert_true(budget < 500);
    }
    assert_true(failures > 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(RandomSheetsArePartitioned),
        cmocka_unit_test(CrowdedSitesArePartitioned),
        cmocka_unit_test(LinearBetweenTwoFrames),
        cmocka_unit_test(LinearWhereTheBorderIsBetweenCells),
        cmocka_unit_test(WeightsKnowTheSlit),
        cmocka_unit_test(PieceWithOneFrameIsItsOwn),
        cmocka_unit_test(PieceWithoutFrameHasNoWeights),
        cmocka_unit_test(FitIsExactForLinearFields),
        cmocka_unit_test(FitDropsWhatIsNotSpanned),
        cmocka_unit_test(SingleCellHasNoSlope),
        cmocka_unit_test(GradientBetweenTwoFrames),
        cmocka_unit_test(EasedWeightsFollowLinearOnes),
        cmocka_unit_test(FitIsContinuousOverFaces),
        cmocka_unit_test(WeightsAreThoseOfThePaper),
        cmocka_unit_test(CutSheetsEqualThoseFromScratch),
        cmocka_unit_test(CutsTakenBackEqualThoseFromScratch),
        cmocka_unit_test(SitesMove),
        cmocka_unit_test(ChangesAreComplete),
        cmocka_unit_test(StencilsEqualPoints),
        cmocka_unit_test(PointsOnlyRead),
        cmocka_unit_test(FailingAllocatorLeaksNothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
