#include "follow.h"

/* What a commit writes to old samples is other than what they have; new ones are there all. */
static void AssertStagedDiffer(const kiriSkin* skin, int32_t oldCount, int32_t count)
{
    int32_t fresh = 0;
    for (int32_t k = 0; k < skin->staged.count; ++k) {
        kiriReweighed staged = skin->staged.data[k];
        kiriSpan was = staged.sample < oldCount ? skin->spans.data[staged.sample] : (kiriSpan){ 0, 0 };
        bool isSame = was.count == staged.span.count;
        for (int32_t i = 0; isSame && i < was.count; ++i) {
            kiriSampleWeight a = skin->weights.data[was.first + i], b = skin->weights.data[staged.span.first + i];
            isSame = a.frame == b.frame && a.value == b.value;
        }
        assert_false(isSame);
        fresh += staged.sample >= oldCount;
    }
    assert_int_equal(fresh, count - oldCount);
}

/* Weights of vertices and points after any cuts are those from scratch, bit for bit, whatever the quota. */
static void CutSheetsEqualThoseFromScratch(void** state)
{
    (void)state;
    int64_t all = 0, staged = 0;
    for (uint32_t round = 0; round < 40; ++round) {
        uint32_t seed = 43 + 7919 * round;
        Scene scene;
        Follow f;
        Wander wander;
        memset(&wander, 0, sizeof(wander));
        Scene_InitMesh(&scene, 1.0, RandomBetween(&seed, 0.3, 1.0), 12, 10, 3 + (int32_t)(Random(&seed) % 28), 0.2,
                       seed);
        Scene_CutAtRandom(&scene, (int32_t)(Random(&seed) % 4), 8, &seed);
        kiriMesh_Commit(&scene.mesh);
        Follow_Start(&f, &scene, 1 + (int32_t)(Random(&seed) % 24), 30, &seed);
        f.slice = round % 3 == 2 ? 1 + round % 5 : 0;
        double length = RandomBetween(&seed, 0.3, 2.5) * f.grid.side;
        for (int step = 0; step < 30; ++step) {
            for (uint32_t cuts = 1 + Random(&seed) % 2; cuts > 0; --cuts) {
                Wander_Cut(&wander, &f, length, &seed);
            }
            Follow_Weights(&f, &seed);
            assert_true(Follow_Links(&f));
            assert_int_equal(Follow_Samples(&f), KIRI_DONE);
            all += f.mesh->vertices.count;
            staged += f.vertexSkin.staged.count;
            AssertStagedDiffer(&f.vertexSkin, f.oldVertices, f.mesh->vertices.count);
            Follow_Commit(&f);
            Follow_Compare(&f);
            kiriSquares_ClearDirty(&scene.mesh.squares);
        }
        Follow_Release(&f);
        Scene_Release(&scene);
    }
    assert_true(2 * staged < all);
}

/* Skinned by what kiriShape_At says; at lips where squares are split, by what their own side says. */
static void WeightsAreThoseOfTheShape(void** state)
{
    (void)state;
    uint32_t seed = 3;
    Scene scene;
    Follow f;
    kiriPointWeights out = { 0 };
    kiriStencil stencil = { 0 };
    int32_t leaning = 0;
    Scene_InitMesh(&scene, 1.0, 0.8, 36, 28, 14, 0.2, seed);
    Scene_CutAtRandom(&scene, 12, 14, &seed);
    kiriMesh_Commit(&scene.mesh);
    Follow_Start(&f, &scene, 9, 0, &seed);
    for (int32_t v = 0; v < f.mesh->vertices.count; ++v) {
        int32_t cell = kiriGrid_CellOfVertex(&f.grid, f.mesh, v), k = 0;
        double sum = 0.0;
        kiriVec2 at = kiriMesh_Local(f.mesh, f.mesh->vertices.data[v].at);
        kiriVec2 lean = kiriMesh_Lean(f.mesh, v);
        assert_true(kiriShape_At(&f.shape, f.memory, &f.grid, f.mesh, cell, at, &out));
        assert_true(kiriStencil_Gather(&stencil, f.memory, &f.shape, &f.grid, f.mesh, cell));
        if (stencil.split && kiriVec2_Length(lean) > 0.0) {
            kiriStencil_Weigh(&stencil, at, lean);
            for (int32_t i = 0; i < out.count; ++i) {
                leaning += out.data[i].value != stencil.values.data[i];
                out.data[i].value = stencil.values.data[i];
            }
        }
        for (int32_t i = 0; i < out.count; ++i) {
            if (out.data[i].value >= 0x1p-25) {
                kiriSampleWeight weight = f.vertexSkin.weights.data[f.vertexSkin.spans.data[v].first + k++];
                assert_int_equal(weight.frame, out.data[i].frame);
                AssertNear(weight.value, out.data[i].value, 0x1p-25 * out.count);
                sum += weight.value;
            }
        }
        assert_int_equal(k, f.vertexSkin.spans.data[v].count);
        assert_true(sum == 1.0);
    }
    assert_true(leaning > 10);
    kiriArray_Release(f.memory, &out);
    Follow_Release(&f);
    Scene_Release(&scene);
}

static double WeightOf(const kiriSkin* skin, int32_t sample, int32_t frame)
{
    kiriSpan span = skin->spans.data[sample];
    for (int32_t k = span.first; k < span.first + span.count; ++k) {
        if (skin->weights.data[k].frame == frame) {
            return skin->weights.data[k].value;
        }
    }
    return 0.0;
}

/* A newborn vertex has its parents' blend, sorted, until the next commit. */
static void NewbornVerticesInherit(void** state)
{
    (void)state;
    uint32_t seed = 77;
    Scene scene;
    Follow f;
    Wander wander;
    int32_t births = 0;
    memset(&wander, 0, sizeof(wander));
    Scene_InitMesh(&scene, 1.0, 0.8, 5, 4, 14, 0.2, seed);
    kiriMesh_Commit(&scene.mesh);
    Follow_Start(&f, &scene, 9, 0, &seed);
    for (int step = 0; step < 40; ++step) {
        int32_t old = f.mesh->vertices.count;
        Wander_Cut(&wander, &f, 2.0 * f.grid.side, &seed);
        assert_int_equal(f.vertexSkin.spans.count, f.mesh->vertices.count);
        for (int32_t v = old; v < f.mesh->vertices.count; ++v) {
            const kiriBirth* birth = &f.mesh->births.data[v - f.mesh->oldVertexCount];
            kiriSpan span = f.vertexSkin.spans.data[v];
            for (int32_t k = span.first + 1; k < span.first + span.count; ++k) {
                assert_true(f.vertexSkin.weights.data[k].frame > f.vertexSkin.weights.data[k - 1].frame);
            }
            for (int32_t i = 0; i < f.sites.count; ++i) {
                double sum = 0.0;
                for (int k = 0; k < 3 && birth->parent[k] != KIRI_NONE; ++k) {
                    sum += birth->share[k] * WeightOf(&f.vertexSkin, birth->parent[k], i);
                }
                AssertNear(WeightOf(&f.vertexSkin, v, i), sum, 4e-7);
            }
            ++births;
        }
    }
    assert_true(births > 80);
    Follow_Release(&f);
    Scene_Release(&scene);
}

/* What is staged does not show before the commit; what is dropped never does. New samples are appended. */
static void StagedWeightsWait(void** state)
{
    (void)state;
    uint32_t seed = 8;
    Scene scene;
    Follow f;
    Scene_Init(&scene, 1.0, 0.5, 6, 3, 12);
    kiriMesh_Commit(&scene.mesh);
    Follow_Start(&f, &scene, 6, 5, &seed);
    kiriSkin* skin = &f.pointSkin;
    for (int round = 0; round < 2; ++round) {
        double before[6], staged[6];
        for (int32_t i = 0; i < f.sites.count; ++i) {
            before[i] = WeightOf(skin, 2, i);
        }
        for (int32_t sample = 2; sample < 7; sample += sample == 2 ? 3 : 1) { /* 2, and the new ones 5 and 6 */
            int32_t cell = f.sites.data[sample % f.sites.count].cell;
            kiriVec2 at = kiriGrid_Middle(&f.grid, f.mesh, cell);
            assert_true(kiriSkin_Stage(skin, f.memory, &f.shape, &f.grid, f.mesh, sample, cell, at));
        }
        kiriReweighed first = skin->staged.data[0];
        for (int32_t i = 0; i < f.sites.count; ++i) {
            staged[i] = 0.0;
            AssertNear(WeightOf(skin, 2, i), before[i], 0.0);
        }
        for (int32_t k = first.span.first; k < first.span.first + first.span.count; ++k) {
            staged[skin->weights.data[k].frame] = skin->weights.data[k].value;
        }
        if (round == 0) {
            kiriSkin_Drop(skin);
        } else {
            kiriSkin_Commit(skin);
        }
        assert_int_equal(skin->staged.count, 0);
        assert_int_equal(skin->spans.count, round == 0 ? 5 : 7);
        for (int32_t i = 0; i < f.sites.count; ++i) {
            AssertNear(WeightOf(skin, 2, i), round == 0 ? before[i] : staged[i], 0.0);
        }
    }
    Follow_Release(&f);
    Scene_Release(&scene);
}

/* Every sample is in the list of its square, once. */
static void PlacesListSamples(void** state)
{
    (void)state;
    uint32_t seed = 21;
    Scene scene;
    kiriPlaces places = { 0 };
    kiriLatticePoint at[500];
    Scene_Init(&scene, 1.0, 0.5, 6, 3, 12);
    Scene_BuildGrid(&scene);
    for (int32_t k = 0; k < 500; ++k) {
        kiriVec2 p = { RandomBetween(&seed, -0.1, 1.1), RandomBetween(&seed, -0.1, 0.6) };
        at[k] = kiriMesh_Snap(&scene.mesh, p);
        assert_true(kiriPlaces_Add(&places, &scene.memory, &scene.mesh, at[k]));
    }
    int32_t found = 0, inside = 0;
    for (int32_t s = 0; s < places.head.count; ++s) {
        for (int32_t k = places.head.data[s]; k != KIRI_NONE; k = places.next.data[k]) {
            assert_int_equal(kiriSquares_At(&scene.mesh.squares, at[k]), s);
            ++found;
        }
    }
    for (int32_t k = 0; k < 500; ++k) {
        inside += kiriSquares_At(&scene.mesh.squares, at[k]) != KIRI_NONE;
    }
    assert_int_equal(found, inside);
    Scene_Release(&scene);
}

/* Wherever memory fails: what was staged is dropped, and the next refresh does it all. */
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
        Follow_Start(&f, &scene, 6, 10, &seed);
        for (int step = 0; step < 30; ++step) {
            Wander_Cut(&wander, &f, 2.0 * f.grid.side, &seed);
        }
        Follow_Weights(&f, &seed);
        assert_true(Follow_Links(&f));
        memset(&f.pointSkin, 0, sizeof(f.pointSkin));
        for (int32_t k = 0; k < f.points.count; ++k) {
            kiriSpan none = { 0, 0 };
            assert_true(kiriArray_Push(f.memory, &f.pointSkin.spans, none));
        }
        memset(&f.refresh, 0, sizeof(f.refresh));
        scene.purse.budget = budget;
        done = Follow_Samples(&f) == KIRI_DONE;
        scene.purse.budget = -1;
        if (!done) {
            ++failures;
            kiriSkin_Drop(&f.vertexSkin);
            kiriSkin_Drop(&f.pointSkin);
            assert_int_equal(Follow_Samples(&f), KIRI_DONE);
        }
        for (int32_t s = 0; s < f.points.count && f.pointSkin.staged.count < f.points.count; ++s) {
            bool listed = false;
            for (int32_t k = 0; k < f.pointSkin.staged.count; ++k) {
                listed = listed || f.pointSkin.staged.data[k].sample == s;
            }
            kiriLatticePoint at = f.points.data[s].at;
            int32_t cell = kiriGrid_CellAround(&f.grid, f.mesh, at);
            assert_true(listed || kiriSkin_Stage(&f.pointSkin, f.memory, &f.shape, &f.grid, f.mesh, s, cell,
                                                 kiriMesh_Local(f.mesh, at)));
        }
        Follow_Commit(&f);
        Follow_Compare(&f);
        Follow_Release(&f);
        Scene_Release(&scene);
        assert_true(budget < 500);
    }
    assert_true(failures > 10);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(CutSheetsEqualThoseFromScratch),
        cmocka_unit_test(WeightsAreThoseOfTheShape),
        cmocka_unit_test(NewbornVerticesInherit),
        cmocka_unit_test(StagedWeightsWait),
        cmocka_unit_test(PlacesListSamples),
        cmocka_unit_test(FailingAllocatorLeaksNothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
