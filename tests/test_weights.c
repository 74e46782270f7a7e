/* Weights of points, frames that the library spreads, and the surface that both make, through the public header. */
#include "host.h"

enum { MOST = 64, FRAMES_OF_RANDOM = 9 };

typedef struct Weights {
    kiriFrame frames[MOST];
    float value[MOST], gradient[2 * MOST];
    int32_t count;
} Weights;

static Weights WeightsAt(const Host* host, kiriSheet sheet, double u, double v)
{
    Weights w;
    OK(kiriSheet_GetWeights(host->world, sheet, (float[]){ (float)u, (float)v }, w.frames, w.value, w.gradient, MOST,
                            &w.count));
    assert_in_range(w.count, 1, MOST);
    return w;
}

static double WeightOf(const Weights* w, kiriFrame frame)
{
    for (int32_t i = 0; i < w->count; ++i) {
        if (w->frames[i] == frame) {
            return w->value[i];
        }
    }
    return 0.0;
}

static kiriSheet AddSheet(Host* host, kiriSheetDef* def, const float* points, int32_t count, double width,
                          double height, kiriFrame* frames)
{
    def->framePoints = points;
    def->frameCount = def->maxFrames = count;
    def->paper.linearWeights = 1;
    kiriSheet sheet = Host_AddRectangle(host, def, (float)width, (float)height, 20, 20);
    int32_t has = World_GetFrames(host->world, sheet, frames, count);
    assert_int_equal(has, count);
    return sheet;
}

/* ---- Known weights ---- */

/* On the straight way from site to site weights are linear; beside it nearly so. The gradient is one over the distance.
   The border between the regions lies in a cell, or between two. */
TEST(LinearBetweenTwoFrames)
{
    for (int last = 31; last <= 32; ++last) {
        const float points[4] = { 4.5f / 36, 0.125f, ((float)last + 0.5f) / 36, 0.125f };
        const double length = (last - 4) / 36.0;
        kiriFrame frames[2];
        START_HOST(host);
        kiriSheetDef def = DefaultSheet();
        def.gridResolution = 36;
        kiriSheet sheet = AddSheet(&host, &def, points, 2, 1.0, 0.25, frames);
        for (int i = 0; i <= 50; ++i) {
            for (int j = 0; j < 9; ++j) {
                double x = i / 50.0, v = (2 * j + 1) / 72.0, tolerance = j != 4 ? 0.06 : 0.01;
                Weights w = WeightsAt(&host, sheet, 0.125 + length * x, v);
                assert_float_equal(WeightOf(&w, frames[0]), 1.0 - x, tolerance);
                assert_float_equal(WeightOf(&w, frames[1]), x, tolerance);
                if (i > 5 && i < 45 && j == 4) {
                    assert_float_equal(w.gradient[2] * length, 1.0, 0.02);
                    assert_float_equal(w.gradient[3], 0.0, 0.02);
                }
            }
        }
    }
}

/* Two frames face each other over a slit whose end is far. Neither reaches the other side, and around the end weights
   change little from point to point. */
TEST(WeightsEndAtTheSlit)
{
    static const float points[8] = { 0.3f, 0.15f, 0.7f, 0.15f, 0.3f, 0.7f, 0.7f, 0.7f }, slit[4] = { 0.5f, -0.1f, 0.5f, 0.8f };
    kiriFrame frames[4];
    START_HOST(host);
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = 41;
    kiriSheet sheet = AddSheet(&host, &def, points, 4, 1.0, 1.0, frames);
    Host_Cut(&host, sheet, slit, 2);
    OK(Host_Tick(&host, 0.01f, 1));
    for (int i = 0; i < 41; ++i) {
        Weights before = WeightsAt(&host, sheet, 0.0122, (i + 0.5) / 41.0);
        for (int j = 1; j < 41; ++j) {
            double u = (j + 0.5) / 41.0 + (j == 20 ? 0.003 : 0.0), v = (i + 0.5) / 41.0;
            Weights w = WeightsAt(&host, sheet, u, v);
            assert_true(v > 0.5 || WeightOf(&w, frames[u < 0.5]) == 0.0);
            for (int k = 0; k < 4 && (v > 0.85 || (j != 20 && j != 21)); ++k) {
                assert_float_equal(WeightOf(&w, frames[k]), WeightOf(&before, frames[k]), 1.1 * 4.0 / 41.0 / 0.4);
            }
            before = w;
        }
    }
    Weights left = WeightsAt(&host, sheet, 0.48, 0.1), right = WeightsAt(&host, sheet, 0.52, 0.1);
    assert_true(WeightOf(&left, frames[0]) - WeightOf(&right, frames[0]) > 0.5);
}

/* ---- Random sheets ---- */

static void CutAtRandom(Host* host, kiriSheet sheet, uint32_t* seed)
{
    float points[8];
    points[0] = (float)RandomBetween(seed, -0.1, 1.1);
    points[1] = (float)RandomBetween(seed, -0.1, 1.1);
    for (int k = 2; k < 8; ++k) {
        points[k] = points[k - 2] + (float)RandomBetween(seed, -0.4, 0.4);
    }
    Host_Cut(host, sheet, points, 4);
}

/* Linear weights w become w^2 (3 - 2 w), divided by their sum; so a frame's own weight is flat at the frame. Gradients are
   about the slopes of the weights, and their sum is 0. */
TEST(EasedWeightsFollowLinearOnes)
{
    double apart = 0.0;
    int32_t near = 0, all = 0;
    for (uint32_t seed = 1; seed <= 12; ++seed) {
        uint32_t random = 2654435761u * seed;
        kiriSheet sheets[2];
        START_HOST(host);
        for (int k = 0; k < 2; ++k) {
            uint32_t cuts = random;
            kiriSheetDef def = SheetOf(10 + (int32_t)seed, FRAMES_OF_RANDOM);
            def.paper.linearWeights = k;
            sheets[k] = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 12, 12);
            for (int i = 0; i < 4; ++i) {
                CutAtRandom(&host, sheets[k], &cuts);
            }
        }
        OK(Host_Tick(&host, 0.01f, 1));
        for (int i = 0; i < 300; ++i) {
            const double h = 1.0 / 2048.0;
            double u = RandomBetween(&random, 0.01, 0.99), v = RandomBetween(&random, 0.01, 0.99);
            double sum = 0.0, sums[3] = { 0.0, 0.0, 0.0 };
            Weights eased = WeightsAt(&host, sheets[0], u, v), linear = WeightsAt(&host, sheets[1], u, v);
            Weights before = WeightsAt(&host, sheets[1], u - h, v), after = WeightsAt(&host, sheets[1], u + h, v);
            assert_int_equal(eased.count, linear.count);
            for (int32_t k = 0; k < linear.count; ++k) {
                double w = linear.value[k];
                sum += w * w * (3.0 - 2.0 * w);
                sums[0] += w;
                sums[1] += linear.gradient[2 * k];
                sums[2] += linear.gradient[2 * k + 1];
            }
            assert_float_equal(sums[0], 1.0, 1e-6);
            assert_float_equal(sums[1], 0.0, 1e-4);
            assert_float_equal(sums[2], 0.0, 1e-4);
            for (int32_t k = 0; k < linear.count; ++k) {
                double w = linear.value[k];
                assert_float_equal(eased.value[k], w * w * (3.0 - 2.0 * w) / sum, 1e-6);
                apart = fmax(apart, fabs(eased.value[k] - w));
                kiriFrame frame = linear.frames[k];
                double slope = (WeightOf(&after, frame) - WeightOf(&before, frame)) / (2.0 * h);
                near += fabs(slope - linear.gradient[2 * k]) < 0.15 * (1.0 + fabs(slope));
                ++all;
            }
        }
    }
    assert_true(apart > 0.09); /* 3 w^2 - 2 w^3 is up to 0.096 off the line */
    assert_true(10 * near > 9 * all); /* some pairs of points have a lip between them */
}

/* Where the frames of the weights carry a rest point, blended. */
static void Blend(const Host* host, const Weights* w, const float rest[2], double x[3])
{
    x[0] = x[1] = x[2] = 0.0;
    for (int32_t k = 0; k < w->count; ++k) {
        kiriFrameState f = World_FrameState(host->world, w->frames[k]);
        for (int a = 0; a < 3; ++a) {
            double u = (double)rest[0] - f.restPoint[0], v = (double)rest[1] - f.restPoint[1];
            x[a] += w->value[k] * (f.position[a] + u * f.rotation[a] + v * f.rotation[3 + a]);
        }
    }
}

/* Normals of vertices are the sums of the normals of their triangles, each as long as its triangle is large. */
static void CheckNormals(const kiriMesh* mesh)
{
    double* sums = calloc(3 * (size_t)mesh->vertexCount, sizeof(double));
    for (int32_t t = 0; t < mesh->triangleCount; ++t) {
        const int32_t* corner = &mesh->indices[3 * t];
        const float *a = &mesh->positions[3 * corner[0]], *b = &mesh->positions[3 * corner[1]],
                    *c = &mesh->positions[3 * corner[2]];
        for (int k = 0; k < 9; ++k) {
            int x = (k % 3 + 1) % 3, y = (k % 3 + 2) % 3;
            sums[3 * corner[k / 3] + k % 3] +=
                ((double)b[x] - a[x]) * ((double)c[y] - a[y]) - ((double)b[y] - a[y]) * ((double)c[x] - a[x]);
        }
    }
    for (int32_t v = 0; v < mesh->vertexCount; ++v) {
        const double* n = &sums[3 * v];
        double size = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
        for (int k = 0; k < 3 && size > 1e-6; ++k) { /* slivers are rounded */
            assert_float_equal(mesh->normals[3 * v + k], n[k] / size, 1e-3);
        }
    }
    free(sums);
}

/* Vertices are blends of the frames by the weights of their rest points. At a lip vertices have the
   weights of their own side, so those are left out. */
TEST(SurfaceIsTheBlend)
{
    int32_t checked = 0, all = 0;
    for (uint32_t seed = 1; seed <= 8; ++seed) {
        uint32_t random = 2654435761u * seed;
        START_HOST(host);
        kiriSheetDef def = SheetOf(12, FRAMES_OF_RANDOM);
        def.model = seed % 3 == 2 ? KIRI_MODEL_AFFINE : KIRI_MODEL_LINKS;
        def.fadeTime = 0.0f;
        def.material.detail = 0;
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 1.0f, 13, 13);
        kiriFrame frame = World_PointState(host.world, sheet, (float[]){ 0.1f, 0.9f }).frame;
        kiriFrameState state = World_FrameState(host.world, frame);
        OK(kiriFrame_Hold(host.world, frame, state.position, state.rotation));
        for (int tick = 0; tick < 20; ++tick) {
            if (tick % 4 == 0) {
                CutAtRandom(&host, sheet, &random);
            }
            OK(Host_Tick(&host, 0.01f, 2));
            kiriMesh mesh = Host_Mesh(&host, sheet);
            CheckNormals(&mesh);
            for (int32_t v = 0; v < mesh.vertexCount; ++v, ++all) {
                const float* rest = &mesh.restPositions[2 * v];
                bool isInside = fabsf(rest[0] - 0.5f) < 0.499f && fabsf(rest[1] - 0.5f) < 0.499f;
                for (int32_t k = 0; k < 3; ++k) { /* of the mesh before cuts */
                    double share = mesh.sourceWeights[3 * v + k];
                    isInside = isInside && (share == 0.0 || share == 1.0);
                }
                for (int32_t k = 0; k < mesh.vertexCount && isInside; ++k) {
                    const float* other = &mesh.restPositions[2 * k];
                    isInside = k == v || fabsf(other[0] - rest[0]) + fabsf(other[1] - rest[1]) > 1e-3f;
                }
                if (isInside) {
                    Weights w = WeightsAt(&host, sheet, rest[0], rest[1]);
                    double x[3];
                    Blend(&host, &w, rest, x);
                    for (int a = 0; a < 3; ++a) {
                        assert_float_equal(mesh.positions[3 * v + a], x[a], 3e-6);
                    }
                    ++checked;
                }
            }
        }
    }
    assert_true(3 * checked > all);
}

/* ---- Frames ---- */

/* Frames that the library spreads have about as much area each; one frame goes to the middle of its piece. */
TEST(FramesAreSpread)
{
    static const int32_t counts[5] = { 1, 2, 5, 16, 47 };
    for (int k = 0; k < 5; ++k) {
        kiriFrame frames[MOST];
        START_HOST(host);
        kiriSheetDef def = SheetOf(48, counts[k]);
        kiriSheet sheet = Host_AddRectangle(&host, &def, 1.0f, 0.7f, 8, 8);
        int32_t count = World_GetFrames(host.world, sheet, frames, MOST);
        assert_int_equal(count, counts[k]);
        for (int32_t i = 0; i < count; ++i) {
            kiriFrameState f = World_FrameState(host.world, frames[i]);
            double share = (double)f.area * count / 0.7;
            assert_true(share > 0.6 && share < 1.6);
            assert_true(count > 1 || (fabs(f.restPoint[0] - 0.5) < 0.02 && fabs(f.restPoint[1] - 0.35) < 0.02));
        }
    }
}
