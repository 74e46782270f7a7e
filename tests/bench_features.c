/* What each feature of a scene costs where it is used, and that it costs nothing where it is not: a cloth that hangs by
   two corners, is cut by one slit and swings, with one feature changed or obstacles added at a time. Times are ratios to the plain sheet,
   which runs again beside each; memory is what the world holds in the end. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

#include <stdint.h>

enum { SQUARES = 64, TICKS = 126, CUT_TICK = 20, CALM_TICK = 66, RUNS = 5 };

/* ---- Features ---- */

typedef bool AddFn(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def);

typedef struct Feature {
    const char* name;
    void (*set)(kiriSheetDef* def);
    AddFn *add, *addPlain; /* to the world with the feature, and to the one without it; or null */
} Feature;

/* A function that changes a def. */
#define SETTER(name, change) static void name(kiriSheetDef* def) { change; }

SETTER(SetNothing, (void)def)
SETTER(SetPoints, def->collisionPoints = 400)
SETTER(SetSmooth, def->skinning = KIRI_SKINNING_SMOOTH)
SETTER(SetNoFade, def->fadeTime = 0.0f)
SETTER(SetAutomatic, def->frameCount = 0; def->frameLength = 0.2f)
SETTER(SetAsleep, def->sleepSpeed = 1e6f)
SETTER(SetPlanar, def->planar = 1)
SETTER(SetAffine, def->model = KIRI_MODEL_AFFINE)
SETTER(SetEuler, def->timeStepping = KIRI_TIME_STEPPING_EULER)
SETTER(SetPaperPoints, def->model = KIRI_MODEL_POINTS)
SETTER(SetYields, def->material.yieldStress = 1e3f)
SETTER(SetNeverYields, def->material.yieldStress = 1e12f)

static bool AddFolds(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def)
{
    int32_t index;
    bool fine = true;
    for (int i = 1; fine && i < 4; i++) {
        const kiriFold fold = { { 0.25f * (float)i, 0.0f }, { 0.25f * (float)i, 1.0f }, 1e-4f, 0.0f, 0.0f };
        fine = kiriSheet_AddFold(world, sheet, &fold, &index) == KIRI_OK;
    }
    return fine;
}

static kiriSheet lower; /* hangs below */

static bool AddApart(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def)
{
    def->position[2] = -1.0f;
    return Bench_AddSheet(world, def, SQUARES, &lower) && Bench_PinCorners(world, lower, 1.0f, 0.0f);
}

static bool AddSewn(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def)
{
    static const float bottom[4] = { 0.0f, 0.0f, 1.0f, 0.0f }, top[4] = { 0.0f, 1.0f, 1.0f, 1.0f };
    kiriSeamDef seam = DefaultSeam();
    kiriSeam made;
    bool fine = AddApart(world, sheet, def);
    seam.sheetA = sheet;
    seam.sheetB = lower;
    seam.lineA = bottom;
    seam.lineB = top;
    seam.countA = seam.countB = 2;
    return fine && kiriCreateSeam(world, &seam, &made) == KIRI_OK;
}

/* The cloth has a toughness that nothing reaches. */
static bool AddTearing(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def)
{
    return kiriSheet_SetTearing(world, sheet, &(kiriTearing){ .toughness = 1e9f, .strength = 1e12f }) == KIRI_OK;
}

/* The cloth hangs from z = 1 to 0. */
static bool AddFloor(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def)
{
    kiriObstacleDef floor = ObstacleOf(KIRI_OBSTACLE_PLANE);
    kiriObstacle made;
    floor.position[2] = 0.05f;
    return kiriCreateObstacle(world, &floor, &made) == KIRI_OK;
}

static bool AddBoxes(kiriWorld* world, int32_t side, float apart)
{
    bool fine = true;
    for (int32_t i = 0; fine && i < side * side; i++) {
        kiriObstacleDef box = ObstacleOf(KIRI_OBSTACLE_BOX);
        kiriObstacle made;
        Set3(box.size, 0.06f, 0.1f, 0.06f);
        Set3(box.position, apart * (float)(i % side), 0.055f, apart * (float)(i / side));
        fine = kiriCreateObstacle(world, &box, &made) == KIRI_OK;
    }
    return fine;
}

static bool AddWall(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def) { return AddBoxes(world, 10, 0.1f); }
static bool AddTown(kiriWorld* world, kiriSheet sheet, kiriSheetDef* def) { return AddBoxes(world, 32, 2.0f); }

#define SET(name, set) { name, set, NULL, NULL }

static const Feature features[] = {
    SET("nothing (once more)", SetNothing), SET("collision points, 400", SetPoints), SET("smooth skinning", SetSmooth),
    SET("without fading", SetNoFade), SET("automatic frames", SetAutomatic), SET("asleep", SetAsleep),
    SET("backward Euler", SetEuler), SET("planar", SetPlanar), SET("affine frames", SetAffine),
    SET("integration points", SetPaperPoints), SET("yields", SetYields),
    SET("may yield, and does not", SetNeverYields), { "3 folds", SetNothing, AddFolds, NULL },
    { "tips that do not tear", SetNothing, AddTearing, NULL },
    { "2 sheets sewn, or apart", SetNothing, AddSewn, AddApart },   { "floor that is touched", SetNothing, AddFloor, NULL },
    { "100 boxes that are touched", SetNothing, AddWall, NULL },    { "1024 boxes, 1 near", SetNothing, AddTown, NULL },
};
enum { FEATURES = sizeof(features) / sizeof(features[0]) };

/* ---- Runs ---- */

typedef struct Cost {
    double tick, cut; /* s: the median of ticks long after the cut; the tick of the cut */
    double bytes;
    int32_t frames;
} Cost;

static bool MakeWorld(Held* held, kiriWorld** world, kiriSheet* sheet, void (*set)(kiriSheetDef* def), AddFn* add)
{
    kiriSheetDef def = DefaultSheet();
    def.axisV[1] = 0.0f;
    def.axisV[2] = 1.0f;
    def.frameCount = 25;
    def.gridResolution = 50;
    def.sleepSpeed = 0.0f;
    set(&def);
    bool fine = Held_CreateWorld(held, world) == KIRI_OK && Bench_AddSheet(*world, &def, SQUARES, sheet) &&
                Bench_PinCorners(*world, *sheet, 1.0f, 1.0f) && (add == NULL || add(*world, *sheet, &def));
    return fine;
}

static double TimedTick(kiriWorld* world)
{
    double start = Bench_Clock(NULL);
    kiriWorld_Tick(world, 1.0f / 60.0f, 2);
    return Bench_Clock(NULL) - start;
}

static bool Run(void (*set)(kiriSheetDef* def), AddFn* add, Cost* cost)
{
    Held held = { 0, 0 };
    SCOPED_WORLD(world) = NULL;
    kiriSheet sheet;
    SCOPED(Series, plain, Series_Free);
    if (!MakeWorld(&held, &world, &sheet, set, add)) {
        return false;
    }
    for (int tick = 0; tick < TICKS; ++tick) {
        if (tick == CUT_TICK) {
            kiriCut cut;
            kiriSheet_Cut(world, sheet, (const float[]){ 0.3f, 0.2f, 0.5f, 0.25f, 0.7f, 0.6f }, 3, &cut);
            cost->cut = TimedTick(world);
        } else {
            double seconds = TimedTick(world);
            if (tick >= CALM_TICK) {
                Series_Add(&plain, seconds);
            }
        }
    }
    kiriCounts counts;
    kiriSheet_GetCounts(world, sheet, &counts);
    cost->tick = Series_Median(&plain);
    cost->bytes = (double)held.bytes;
    cost->frames = counts.frames;
    return true;
}

/* A feature beside the plain sheet, in turns; the medians of their ratios. */
static bool Compare(Table* table, const Feature* feature)
{
    Series tick = { NULL, 0, 0 }, cut = { NULL, 0, 0 };
    Cost plain = { 0 }, used = { 0 };
    for (int run = 0; run < RUNS; ++run) {
        if (!Run(SetNothing, feature->addPlain, &plain) || !Run(feature->set, feature->add, &used)) {
            return false;
        }
        Series_Add(&tick, used.tick / plain.tick);
        Series_Add(&cut, used.cut / plain.cut);
    }
    Table_Text(table, feature->name);
    TABLE_NUMBERS(table, used.frames, 1e3 * plain.tick, Series_Median(&tick), Series_Quantile(&tick, 0.0),
                  Series_Worst(&tick), Series_Median(&cut), plain.bytes / 1024.0, used.bytes / plain.bytes);
    Series_Free(&tick);
    Series_Free(&cut);
    return true;
}

int main(void)
{
    static const char* const columns[] = { "feature        ", "frames", "plain ms",   "tick, times",
                                           "least",           "most",   "cut, times", "plain KB",
                                           "memory, times",   NULL };
    Table table;
    Bench_WeighClock();
    bool fine =
        Table_Start(&table, "features", "What a feature costs: a hanging cloth of 4225 vertices, 25 frames", columns);
    for (int32_t i = 0; fine && i < FEATURES; ++i) {
        fine = Compare(&table, &features[i]);
    }
    return fine && Table_Stop(&table) ? 0 : 1;
}
