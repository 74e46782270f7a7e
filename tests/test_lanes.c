/* Skinning and normals: plain C gives the bits that the lanes of the machine give, and ranges those of the whole. */
#define KIRI_PLAIN_LANES
#define kiriCarriers_Write Plain_WriteCarriers
#define kiriCarriers_Bend Plain_BendCarriers
#define kiriPatches_Reserve Plain_ReservePatches
#define kiriPatches_Write Plain_WritePatches
#define kiriPatches_Forget Plain_ForgetPatches
#define kiriPatches_MayMove Plain_MayMove
#define kiriSkin_WritePositions Plain_WritePositions
#define kiriNormals_TurnOf Plain_TurnOf
#define kiriNormals_Sum Plain_SumNormals
#define kiriNormals_SumOne Plain_SumOneNormal
#define kiriNormals_Write Plain_WriteNormals
#include "view/kiri_skin.c"
#undef kiriCarriers_Write
#undef kiriCarriers_Bend
#undef kiriPatches_Reserve
#undef kiriPatches_Write
#undef kiriPatches_Forget
#undef kiriPatches_MayMove
#undef kiriSkin_WritePositions
#undef kiriNormals_TurnOf
#undef kiriNormals_Sum
#undef kiriNormals_SumOne
#undef kiriNormals_Write

#include "support.h"

/* As the library has them. */
void kiriSkin_WritePositions(const kiriSkin* skin, const kiriPatches* patches, const kiriVec2* rest, int32_t begin,
                             int32_t end, float* positions);
void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const kiriCorners* corners);
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end);

enum { FRAMES = 9, VERTICES = 203, TRIANGLES = 300 };

typedef struct Patchwork {
    kiriMemory memory;
    kiriPatches patches;
    kiriSkin skin;
    kiriVec2 rest[VERTICES];
    int32_t corners[3 * TRIANGLES];
} Patchwork;

static kiriVec3 RandomVector(uint32_t* seed, double size)
{
    double x = RandomBetween(seed, -size, size), y = RandomBetween(seed, -size, size);
    return kiriVec3_Make(x, y, RandomBetween(seed, -size, size));
}

static void FillPatches(Patchwork* work, bool isBent, double size, uint32_t* seed)
{
    kiriCarrier carriers[FRAMES];
    for (int32_t i = 0; i < FRAMES; ++i) {
        kiriCarrier* c = &carriers[i];
        *c = (kiriCarrier){ RandomVector(seed, size),
                            RandomVector(seed, size),
                            RandomVector(seed, 1.0),
                            RandomVector(seed, size),
                            { 0.0, 0.0 },
                            0.0,
                            0.0,
                            0.0,
                            6.0 };
        c->center = kiriVec2_Make(RandomBetween(seed, 0.0, 1.0), RandomBetween(seed, 0.0, 1.0));
        c->uu = RandomBetween(seed, -20.0, 20.0);
        c->uv = RandomBetween(seed, -20.0, 20.0);
        c->vv = RandomBetween(seed, -20.0, 20.0);
    }
    assert_true(Plain_ReservePatches(&work->patches, &work->memory, FRAMES));
    Plain_WritePatches(&work->patches, carriers, FRAMES, RandomVector(seed, size), isBent, NULL);
}

static void FillVertices(Patchwork* work, uint32_t* seed)
{
    for (int32_t v = 0; v < VERTICES; ++v) {
        kiriSpan span = { work->skin.weights.count, 1 + (int32_t)(Random(seed) % 7) };
        work->rest[v] = kiriVec2_Make(RandomBetween(seed, 0.0, 1.0), RandomBetween(seed, 0.0, 1.0));
        for (int32_t k = 0; k < span.count; ++k) {
            kiriSampleWeight weight = { (int32_t)(Random(seed) % FRAMES), (float)RandomBetween(seed, 0.0, 1.0) };
            assert_true(kiriArray_Push(&work->memory, &work->skin.weights, weight));
        }
        assert_true(kiriArray_Push(&work->memory, &work->skin.spans, span));
    }
    for (int32_t k = 0; k < 3 * TRIANGLES; ++k) {
        bool sharesEdge = k % 12 == 3 || k % 12 == 4;
        work->corners[k] = sharesEdge ? work->corners[k % 12 == 3 ? k - 3 : k - 2] : (int32_t)(Random(seed) % VERTICES);
    }
}

static void CheckNormals(const Patchwork* work, const float* positions)
{
    static float plainSlopes[4 * VERTICES], slopes[4 * VERTICES], plain[3 * VERTICES], normals[3 * VERTICES];
    uint8_t turns[TRIANGLES / 2];
    for (int32_t pair = 0; pair < TRIANGLES / 2; ++pair) {
        turns[pair] = Plain_TurnOf(&work->corners[6 * pair], false);
    }
    const kiriCorners corners = { work->corners, turns, TRIANGLES };
    Plain_SumNormals(plainSlopes, VERTICES, positions, &corners);
    kiriNormals_Sum(slopes, VERTICES, positions, &corners);
    Plain_WriteNormals(plain, plainSlopes, 0, VERTICES);
    kiriNormals_Write(normals, slopes, 0, 50);
    kiriNormals_Write(normals, slopes, 50, 131);
    kiriNormals_Write(normals, slopes, 131, VERTICES);
    assert_memory_equal(normals, plain, sizeof(normals));
}

static void BitsAreThoseOfPlainC(void** state)
{
    (void)state;
    static const double sizes[] = { 1.0, 1e-12, 1e12 };
    for (uint32_t seed = 1; seed <= 60; ++seed) {
        float plain[3 * VERTICES + 1] = { 0.0f }, positions[3 * VERTICES + 1] = { 0.0f };
        uint32_t random = seed;
        Patchwork work;
        memset(&work, 0, sizeof(work));
        work.memory = kiriMemory_Make(NULL, NULL, NULL);
        FillPatches(&work, seed % 2 == 0, sizes[seed % 3], &random);
        FillVertices(&work, &random);
        Plain_WritePositions(&work.skin, &work.patches, work.rest, 0, VERTICES, plain);
        kiriSkin_WritePositions(&work.skin, &work.patches, work.rest, 0, 77, positions);
        kiriSkin_WritePositions(&work.skin, &work.patches, work.rest, 77, VERTICES, positions);
        assert_memory_equal(positions, plain, sizeof(plain));
        CheckNormals(&work, positions);
        kiriMemory_FreeAll(&work.memory);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(BitsAreThoseOfPlainC) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
