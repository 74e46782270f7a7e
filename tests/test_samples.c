/* The scenes of the samples are what the paper's table 1 says, and what they say of themselves. */
#include "../samples/scene.h"
#include "defaults.h"
#include "validate.h"
#include "support.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* A tick of a scene. Its world is validated after every seventh, to save time. */
static kiriResult TickScene(Scene* scene)
{
    kiriResult result = Scene_Tick(scene);
    const char* wrong = scene->tick % 7 == 0 ? Validate_World(scene->world) : NULL;
    if (wrong != NULL) {
        fail_msg("tick %d: %s", (int)scene->tick, wrong);
    }
    return result;
}

typedef struct Row {
    const char* name;
    int32_t grid, vertices, strokes, firstFrames, lastFrames, pieces;
} Row;

enum { SPIRAL, KIRIGAMI, PATCHWORK, VORTEX, FALLING_GUY, RUBBER, FLAT, ROWS };

/* Table 1: grid along the longer side, vertices before the cut, frames before and after. And scenes of our own. */
static const Row table[ROWS] = {
    [SPIRAL] = { "spiral", 40, 81, 1, 5, 5, 1 },
    [KIRIGAMI] = { "kirigami", 68, 4225, 48, 47, 47, 1 },
    [PATCHWORK] = { "patchwork", 50, 4225, 4, 5, 12, 5 },
    [VORTEX] = { "vortex", 68, 4225, 2, 5, 5, 1 },
    [FALLING_GUY] = { "fallingguy", 100, 289, 1, 10, 10, 1 },
    [RUBBER] = { "rubber", 50, 1353, 5, 39, 39, 3 },
    [FLAT] = { "flat", 64, 297, 5, 36, 42, 6 },
};

static void StartWith(Scene* scene, const char* name, const SceneOptions* options)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    assert_non_null(Scene_FindType(name));
    assert_true(Scene_Start(scene, Scene_FindType(name), &def, options));
}

static void StartAt(Scene* scene, const char* name, float pace)
{
    StartWith(scene, name, &(SceneOptions){ .pace = pace });
}

/* With what the paper's table has. */
static void StartAsPaper(Scene* scene, const char* name)
{
    StartWith(scene, name, &(SceneOptions){ .asPaper = true });
}

static void Start(Scene* scene, const char* name)
{
    StartAt(scene, name, 0.0f);
}

static void Play(Scene* scene, const char* name)
{
    Start(scene, name);
    while (scene->tick < scene->type->ticks) {
        assert_true(TickScene(scene) >= 0);
    }
}

TEST(Table)
{
    for (int i = 0; i < ROWS; i++) {
        SCOPED(Scene, scene, Scene_Stop);
        kiriCounts counts;
        StartAsPaper(&scene, table[i].name);
        kiriSheet_GetCounts(scene.world, scene.sheet, &counts);
        assert_int_equal(scene.gridResolution, table[i].grid);
        assert_int_equal(counts.vertices, table[i].vertices);
        assert_int_equal(counts.frames, table[i].firstFrames);
        assert_int_equal(counts.pieces, 1);
        assert_int_equal(scene.strokeCount, table[i].strokes);
    }
}

/* Strokes fill the time of cutting without a gap, and all blades are about as fast. */
static void CheckTimes(const Scene* scene)
{
    const SceneType* type = scene->type;
    if (scene->strokeCount == 0) {
        return;
    }
    assert_true(type->firstCut > 0 && type->firstCut < type->lastCut && type->lastCut + 30 < type->ticks);
    assert_int_equal(scene->strokes[0].firstTick, type->firstCut);
    assert_int_equal(scene->strokes[scene->strokeCount - 1].lastTick, type->lastCut);
    for (int32_t k = 1; k < scene->strokeCount; k++) {
        assert_int_equal(scene->strokes[k].firstTick, type->together ? type->firstCut : scene->strokes[k - 1].lastTick);
    }
    for (int32_t k = 1; k < SCENE_MOMENTS; k++) {
        assert_true(type->moments[k] > type->moments[k - 1] && type->moments[k] <= type->ticks);
    }
}

/* And so at any pace, in as many more ticks. */
TEST(Times)
{
    static const float paces[] = { 1.0f, 0.25f, 2.0f };
    for (int i = 0; Scene_GetType(i) != NULL; i++) {
        const SceneType* type = Scene_GetType(i);
        for (int k = 0; k < 3; k++) {
            SCOPED(Scene, scene, Scene_Stop);
            StartAt(&scene, type->name, paces[k]);
            CheckTimes(&scene);
            assert_int_equal(scene.type->firstCut, type->firstCut);
            assert_true(fabsf(paces[k] * (float)(scene.type->lastCut - type->firstCut) -
                              (float)(type->lastCut - type->firstCut)) <= 1.0f);
            assert_true(fabsf(paces[k] * (float)(scene.type->ticks - type->firstCut) -
                              (float)(type->ticks - type->firstCut)) <= 1.0f);
        }
    }
}

static uint64_t HashAt(float pace)
{
    SCOPED(Scene, scene, Scene_Stop);
    uint64_t hash;
    StartAt(&scene, "bunny", pace);
    for (int32_t i = 0; i < 60; i++) {
        assert_true(TickScene(&scene) >= 0);
    }
    assert_int_equal(kiriWorld_GetStateHash(scene.world, &hash), KIRI_OK);
    return hash;
}

TEST(PaceOfOne)
{
    assert_true(HashAt(0.0f) == HashAt(1.0f));
    assert_true(HashAt(0.0f) != HashAt(0.5f));
}

static float DistanceToWay(const Outline* way, const float point[2])
{
    float least = FLT_MAX;
    for (int32_t i = 0; i + 1 < way->count; i++) {
        const float *from = way->points + 2 * i, *to = from + 2;
        float u = to[0] - from[0], v = to[1] - from[1], length = u * u + v * v;
        float along = ((point[0] - from[0]) * u + (point[1] - from[1]) * v) / length;
        along = fminf(fmaxf(along, 0.0f), 1.0f);
        least = fminf(least, hypotf(from[0] + along * u - point[0], from[1] + along * v - point[1]));
    }
    return least;
}

static bool HasVertex(const kiriMesh* mesh, const float point[2], float distance)
{
    for (int32_t i = 0; i < mesh->vertexCount; i++) {
        const float* x = mesh->restPositions + 2 * i;
        if (hypotf(x[0] - point[0], x[1] - point[1]) < distance) {
            return true;
        }
    }
    return false;
}

static float LongestSide(const Outline* way)
{
    float longest = 0.0f;
    for (int32_t i = 0; i + 1 < way->count; i++) {
        const float* x = way->points + 2 * i;
        longest = fmaxf(longest, hypotf(x[2] - x[0], x[3] - x[1]));
    }
    return longest;
}

/* At a slow pace the blade goes on a little in every tick, on its way, and all points of the way are cut. */
TEST(SlowBlade)
{
    SCOPED(Scene, scene, Scene_Stop);
    StartAt(&scene, "bunny", 0.2f);
    const Stroke* stroke = &scene.strokes[0];
    const Outline* way = &stroke->way;
    float before[2] = { way->points[0], way->points[1] }, tip[1][2];
    float most = 1.01f * LongestSide(way) * (float)(way->count - 1) / (float)(stroke->lastTick - stroke->firstTick);
    assert_true(most < 0.5f * LongestSide(way));
    while (scene.tick <= stroke->lastTick) {
        bool cuts = scene.tick > stroke->firstTick;
        assert_true(TickScene(&scene) >= 0);
        if (cuts) {
            assert_int_equal(Scene_GetBlades(&scene, tip, 1), 1);
            float step = hypotf(tip[0][0] - before[0], tip[0][1] - before[1]);
            assert_true(step > 0.0f && step < most && DistanceToWay(way, tip[0]) < 1e-6f);
            memcpy(before, tip[0], sizeof before);
        }
    }
    kiriMesh mesh;
    assert_int_equal(kiriSheet_GetMesh(scene.world, scene.sheet, &mesh), KIRI_OK);
    assert_memory_equal(before, way->points + 2 * (way->count - 1), sizeof before);
    for (int32_t i = 0; i < way->count; i++) {
        assert_true(HasVertex(&mesh, way->points + 2 * i, 1.1e-4f)); /* what a blade may snap by */
    }
}

/* What is seen of a scene in the course of its ticks. */
typedef struct Watch {
    int32_t still;       /* from this tick on the host moves nothing */
    double energy, most; /* J: in the tick `still`, and at most since then */
    double elastic;      /* J: in the tick `still` */
    double offPlane;     /* m: how far a vertex ever was from the plane y = 0 */
} Watch;

static void WatchTick(Watch* watch, const Scene* scene)
{
    kiriMesh mesh;
    kiriTotals totals;
    double energy = World_Energy(scene->world, scene->sheet);
    kiriSheet_GetTotals(scene->world, scene->sheet, &totals);
    if (scene->tick == watch->still) {
        watch->energy = watch->most = energy;
        watch->elastic = totals.elasticEnergy;
    }
    watch->most = fmax(watch->most, energy);
    assert_int_equal(kiriSheet_GetMesh(scene->world, scene->sheet, &mesh), KIRI_OK);
    for (int32_t i = 0; i < mesh.vertexCount; i++) {
        watch->offPlane = fmax(watch->offPlane, fabs((double)mesh.positions[3 * i + 1]));
    }
}

/* Cuts only in the ticks that the type names; frames and pieces as in the table; nothing gets lost on the way. */
static void RunWhole(const Row* row, Scene* scene, Watch* watch)
{
    kiriCounts counts;
    kiriTotals before, after;
    StartAsPaper(scene, row->name);
    kiriSheet_GetTotals(scene->world, scene->sheet, &before);
    for (int32_t tick = 0; tick < scene->type->ticks; tick++) {
        kiriProfile profile;
        assert_true(TickScene(scene) >= 0);
        kiriWorld_GetProfile(scene->world, &profile);
        if (tick < scene->type->firstCut || tick > scene->type->lastCut) {
            assert_int_equal(profile.cutSegments, 0);
        }
        if (watch != NULL) {
            WatchTick(watch, scene);
        }
    }
    kiriSheet_GetCounts(scene->world, scene->sheet, &counts);
    kiriSheet_GetTotals(scene->world, scene->sheet, &after);
    assert_int_equal(counts.frames, row->lastFrames);
    assert_int_equal(counts.pieces, row->pieces);
    assert_true(fabs(after.mass - before.mass) < 1e-9 * before.mass);
    int32_t corners = 0;
    for (int32_t i = 0; i < scene->strokeCount; i++) {
        assert_int_equal(scene->strokes[i].taken, scene->strokes[i].way.count);
        corners += scene->strokes[i].way.count;
    }
    assert_true(counts.vertices > row->vertices + 2 * corners); /* two lips, and where mesh edges cross */
}

FIGURE(SpiralScene)
{
    SCOPED(Scene, scene, Scene_Stop);
    RunWhole(&table[SPIRAL], &scene, NULL);
}

/* The height of the highest frame whose rest point a stroke encloses. */
static float HeightOf(const Scene* scene, const Stroke* stroke)
{
    kiriFrame frames[256];
    int32_t count = 0, inside = 0;
    float height = 0.0f;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, 256, &count);
    for (int32_t i = 0; i < count; i++) {
        kiriFrameState state;
        assert_int_equal(kiriFrame_GetState(scene->world, frames[i], &state), KIRI_OK);
        if (Outline_Holds(stroke->way.points, stroke->way.count - 1, state.restPoint)) {
            height = state.position[2] > height ? state.position[2] : height;
            inside++;
        }
    }
    assert_true(inside > 0);
    return height;
}

FIGURE(PatchworkScene)
{
    SCOPED(Scene, scene, Scene_Stop);
    RunWhole(&table[PATCHWORK], &scene, NULL);
    for (int32_t i = 0; i < scene.strokeCount; i++) {
        assert_true(HeightOf(&scene, &scene.strokes[i]) < 0.06f); /* each lies on the floor, at most folded */
    }
}

/* The mean stretch along u of frames, in themselves. */
static double StretchOfFrames(const Scene* scene)
{
    kiriFrame frames[256];
    int32_t count = 0;
    double sum = 0.0;
    kiriSheet_GetFrames(scene->world, scene->sheet, frames, 256, &count);
    for (int32_t i = 0; i < count; i++) {
        kiriFrameState state;
        assert_int_equal(kiriFrame_GetState(scene->world, frames[i], &state), KIRI_OK);
        const float* u = state.rotation;
        sum += sqrt((double)u[0] * u[0] + (double)u[1] * u[1] + (double)u[2] * u[2]);
    }
    return sum / count;
}

/* How high the sheet is where u is 0.5, by what it is there at rest. */
static double HeightOfMiddle(const Scene* scene)
{
    kiriMesh mesh;
    float low[2] = { FLT_MAX, FLT_MAX }, high[2] = { -FLT_MAX, -FLT_MAX };
    assert_int_equal(kiriSheet_GetMesh(scene->world, scene->sheet, &mesh), KIRI_OK);
    for (int32_t i = 0; i < mesh.vertexCount; i++) {
        const float now = mesh.positions[3 * i + 2], rest = mesh.restPositions[2 * i + 1];
        if (fabsf(mesh.restPositions[2 * i] - 0.5f * scene->type->size) < 1e-4f) {
            low[0] = fminf(low[0], now);
            high[0] = fmaxf(high[0], now);
            low[1] = fminf(low[1], rest);
            high[1] = fmaxf(high[1], rest);
        }
    }
    return (double)(high[0] - low[0]) / (double)(high[1] - low[1]);
}

/* Why the scene has affine frames: under the pull they stretch. The sheet gets narrower with both; rigid ones only move
   apart and together. */
FIGURE(RubberStretches)
{
    for (int plain = 0; plain < 2; plain++) {
        SCOPED(Scene, scene, Scene_Stop);
        kiriWorldDef def;
        kiriDefaultWorldDef(&def);
        assert_true(Scene_Start(&scene, Scene_FindType("rubber"), &def, &(SceneOptions){ .plain = plain != 0 }));
        while (scene.tick < scene.type->firstCut) {
            assert_int_equal(Scene_Tick(&scene), KIRI_OK);
        }
        double stretch = StretchOfFrames(&scene), height = HeightOfMiddle(&scene);
        assert_true(plain ? fabs(stretch - 1.0) < 1e-6 : stretch > 1.3);
        assert_true(height < (plain ? 0.85 : 0.8));
    }
}

/* Cuts let go of nearly all elastic energy, and bring none but what new borders see between affine frames, which have
   no offsets of strains: 5e-5 of all. */
FIGURE(RubberScene)
{
    SCOPED(Scene, scene, Scene_Stop);
    kiriTotals totals;
    Watch watch = { .still = Scene_FindType("rubber")->firstCut };
    RunWhole(&table[RUBBER], &scene, &watch);
    kiriSheet_GetTotals(scene.world, scene.sheet, &totals);
    assert_true(watch.most <= (1.0 + 1e-4) * watch.energy);
    assert_true(watch.elastic > 1.0 && totals.elasticEnergy < 1e-3 * watch.elastic);
    assert_true(fabs(StretchOfFrames(&scene) - 1.0) < 0.01);
}

/* Nothing leaves the plane or brings energy; in the end the halves of the disc lie on the floor, apart. */
TEST(FlatScene)
{
    SCOPED(Scene, scene, Scene_Stop);
    Watch watch = { .still = 1 };
    RunWhole(&table[FLAT], &scene, &watch);
    assert_true(watch.offPlane == 0.0 && watch.most <= (1.0 + 1e-6) * watch.energy);
    kiriPieceState halves[2], piece;
    int32_t found = 0;
    for (int32_t i = 0; i < table[FLAT].pieces; i++) {
        assert_int_equal(kiriSheet_GetPiece(scene.world, scene.sheet, i, &piece), KIRI_OK);
        if (piece.area > 0.1) {
            assert_true(found < 2 && fabsf(piece.lower[2]) < 0.01f && piece.upper[2] < 0.45f);
            halves[found++] = piece;
        }
    }
    assert_int_equal(found, 2);
    assert_true(halves[0].upper[0] < halves[1].lower[0] || halves[1].upper[0] < halves[0].lower[0]);
}

/* Folds reach their angles, and cuts through them part the sheet. */
FIGURE(FoldScenes)
{
    static const char* const names[] = { "miura", "card", "crane" };
    static const float angles[3][3] = { { -0.3f, 0.3f, -0.3f }, { 1.57f, 1.57f, -1.57f }, { -3.0f, -3.0f, -3.0f } };
    for (int i = 0; i < 3; i++) {
        SCOPED(Scene, scene, Scene_Stop);
        kiriCounts counts;
        Play(&scene, names[i]);
        kiriSheet_GetCounts(scene.world, scene.sheet, &counts);
        assert_int_equal(counts.pieces, i == 0 ? 2 : 1);
        for (int k = 0; k < 3; k++) {
            kiriFoldState fold;
            int32_t index = i == 0 ? 6 * k + 3 : k; /* one of each zigzag to the left of the cut */
            assert_int_equal(kiriSheet_GetFold(scene.world, scene.sheet, index, &fold), KIRI_OK);
            print_message("%s, fold %d: %.3f rad\n", names[i], (int)index, fold.angle);
            assert_true(fabs(fold.angle - (double)angles[i][k]) < 0.1);
        }
    }
}

/* Lips of sewn scenes stay together. The shirt hangs on the shoulders, the bag keeps its balls, and the can its dent. */
FIGURE(SewnScenes)
{
    static const char* const names[] = { "shirt", "lantern", "patch", "bag", "can" };
    for (int i = 0; i < 5; i++) {
        SCOPED(Scene, scene, Scene_Stop);
        kiriSeam seams[8];
        kiriStitch stitch;
        int32_t count = 0, stitches = 0;
        float worst = 0.0f;
        kiriPointState dent = { 0 };
        Play(&scene, names[i]);
        assert_int_equal(kiriWorld_GetSeams(scene.world, seams, 8, &count), KIRI_OK);
        assert_int_equal(count, i == 0 ? 6 : 1);
        for (int32_t k = 0; k < count; k++) {
            for (int32_t n = 0; kiriSeam_GetStitch(scene.world, seams[k], n, &stitch) == KIRI_OK; n++, stitches++) {
                worst = fmaxf(worst, stitch.gap);
                assert_true(i > 0 || stitch.position[2] > 0.7f);
            }
        }
        for (int32_t k = 0; i == 3 && k < scene.bodyCount; k++) {
            kiriObstacleState ball;
            kiriObstacle_GetState(scene.world, scene.bodyIds[k], &ball);
            assert_true(ball.position[2] > 0.03f && ball.position[2] < 0.33f);
        }
        assert_true(i != 3 || scene.bodyCount == 50);
        kiriSheet_GetPoint(scene.world, scene.sheet, (const float[]){ 0.108f, 0.115f }, &dent);
        assert_true(i < 4 || dent.position[1] < -0.02f);
        print_message("%s: %d stitches, %.2g m apart\n", names[i], (int)stitches, (double)worst);
        assert_true(stitches > 10 && worst < 1e-3f);
    }
}

/* All parts are torn along the lines: a strip off a letter, stamps off a sheet, a strip off a poster, and a cloth in two. */
FIGURE(TornScenes)
{
    static const char* const names[4] = { "letter", "stamps", "poster", "weave" };
    static const double areas[2][3] = { { 0.01728, 0.00432 }, { 9 * 625e-6, 2 * 625e-6, 625e-6 } }; /* m^2 */
    for (int i = 0; i < 4; i++) {
        SCOPED(Scene, scene, Scene_Stop);
        int32_t pieces = 0;
        Play(&scene, names[i]);
        for (kiriPieceState piece; kiriSheet_GetPiece(scene.world, scene.sheet, pieces, &piece) == KIRI_OK; pieces++) {
            assert_true(pieces < 3 && (i > 1 || fabs(piece.area - areas[i][pieces]) < 0.01 * piece.area));
        }
        assert_int_equal(pieces, i % 3 == 0 ? 2 : 3);
    }
}

/* Cuts set the spiral free, and do not throw it: it never moves faster than a fall by its own size would make it,
   though each commit changes the borders of bent regions. */
FIGURE(SpiralIsNotThrown)
{
    SCOPED(Scene, scene, Scene_Stop);
    Start(&scene, "spiral");
    double most = 0.0, fall = 0.0;
    for (int32_t tick = 0; tick < scene.type->ticks; ++tick) {
        kiriTotals totals;
        TickScene(&scene);
        assert_int_equal(kiriSheet_GetTotals(scene.world, scene.sheet, &totals), KIRI_OK);
        most = fmax(most, totals.kineticEnergy);
        fall = 9.81 * totals.mass * (double)scene.type->size;
    }
    assert_true(most > 0.0 && most < fall);
}

/* A spiral of equal steps, whose radius is linear in the angle; lengths as by calculus. */
TEST(Spiral)
{
    const Spiral spiral = { { 0.3, -0.2 }, 0.05, 0.4, 0.125, 3.0, 0.004 };
    const double tau = 6.283185307179586;
    Outline outline = { .points = NULL };
    assert_true(Outline_AddSpiral(&outline, &spiral));
    for (int32_t i = 0; i < outline.count; i++) {
        double u = outline.points[2 * i] - 0.3, v = outline.points[2 * i + 1] + 0.2, radius = sqrt(u * u + v * v);
        double angle = tau * (0.125 + 3.0 * (radius - 0.05) / 0.35);
        assert_true(fabs(u - radius * cos(angle)) < 1e-4 && fabs(v - radius * sin(angle)) < 1e-4);
    }
    /* The integral of sqrt(r^2 + (dr/da)^2) over the angle, by the middles of many short stretches. */
    double length = 0.0, slope = 0.35 / (3.0 * tau);
    for (int32_t i = 0; i < 100000; i++) {
        double radius = 0.05 + 0.35 * (i + 0.5) / 100000;
        length += 3.0 * tau / 100000 * sqrt(radius * radius + slope * slope);
    }
    assert_true(fabs(Outline_GetLength(&outline) - length) < 1e-3 * length);
    Outline_Free(&outline);
}

TEST(Circle)
{
    const Spiral circle = { { 0.0, 0.0 }, 0.5, 0.5, 0.9, -1.0, 0.001 };
    Outline outline = { .points = NULL };
    assert_true(Outline_AddSpiral(&outline, &circle));
    assert_true(fabs(Outline_GetLength(&outline) - 3.14159265) < 1e-4);
    assert_true(Outline_Holds(outline.points, outline.count - 1, (float[]){ 0.34f, 0.34f }));
    assert_false(Outline_Holds(outline.points, outline.count - 1, (float[]){ 0.37f, 0.37f }));
    Outline_Free(&outline);
}
