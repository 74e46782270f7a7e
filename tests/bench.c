/* How long things take, through the public header alone. Prints tables, and writes build/bench/bench.csv. Nothing is
   asserted about time: machines differ. */
#define _POSIX_C_SOURCE 199309L

#include "../samples/scene.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>

static double ReadClock(void* user)
{
    (void)user;
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static kiriWorldDef TimedWorld(void)
{
    kiriWorldDef def;
    kiriDefaultWorldDef(&def);
    def.clock = ReadClock;
    return def;
}

static FILE* csv;
typedef struct Series {
    double number[4096];
    int32_t count;
} Series;

static void Add(Series* series, double number)
{
    if (series->count < 4096) {
        series->number[series->count++] = number;
    }
}

static int CompareNumbers(const void* left, const void* right)
{
    double l = *(const double*)left, r = *(const double*)right;
    return (l > r) - (l < r);
}

/* Prints median and worst, writes them to the file, and empties the series. */
static void Report(const char* table, const char* name, const char* quantity, Series* series)
{
    qsort(series->number, (size_t)series->count, sizeof(double), CompareNumbers);
    double median = series->number[series->count / 2],
           worst = series->number[series->count > 0 ? series->count - 1 : 0];
    printf(" %9.3f %9.3f", median, worst);
    fprintf(csv, "%s,%s,%s,%.6g,%.6g,%d\n", table, name, quantity, median, worst, series->count);
    series->count = 0;
}

enum { BEFORE, DURING, AFTER, PHASES, SCENE_RUNS = 5 };
static const char* phaseNames[PHASES] = { "before", "during", "after" };
static Series stages[PHASES][KIRI_STAGE_COUNT + 1], splits;

static bool RunScene(const SceneType* type)
{
    kiriWorldDef def = TimedWorld();
    Scene scene;
    if (!Scene_Start(&scene, type, &def, &(SceneOptions){ .dataFolder = NULL })) {
        return false;
    }
    kiriResult result = KIRI_OK;
    for (int32_t i = 0; i < type->ticks && result >= 0; i++) {
        kiriProfile profile;
        int phase = i < type->firstCut ? BEFORE : i <= type->lastCut ? DURING : AFTER;
        double start = ReadClock(NULL);
        result = Scene_Tick(&scene);
        Add(&stages[phase][KIRI_STAGE_COUNT], 1e3 * (ReadClock(NULL) - start));
        kiriWorld_GetProfile(scene.world, &profile);
        for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
            Add(&stages[phase][k], 1e3 * profile.seconds[k]);
        }
        if (profile.cutSegments > 0) {
            Add(&splits, 1e6 * profile.seconds[KIRI_STAGE_CUT] / profile.cutSegments);
        }
    }
    Scene_Stop(&scene);
    return result >= 0;
}

static bool BenchScene(const SceneType* type)
{
    bool fine = true;
    for (int run = 0; fine && run < SCENE_RUNS; run++) {
        fine = RunScene(type);
    }
    printf("\n\n%s, ms a tick: median and worst of %d runs\n  %-12s", type->name, SCENE_RUNS, "");
    printf(" %19s %19s %19s", phaseNames[BEFORE], phaseNames[DURING], phaseNames[AFTER]);
    for (int32_t k = 0; k <= KIRI_STAGE_COUNT; k++) {
        const char* name = k < KIRI_STAGE_COUNT ? kiriGetStageName(k) : "all";
        printf("\n  %-12s", name);
        for (int phase = 0; phase < PHASES; phase++) {
            char quantity[64];
            snprintf(quantity, sizeof quantity, "%s ms %s", name, phaseNames[phase]);
            Report("scene", type->name, quantity, &stages[phase][k]);
        }
    }
    printf("\n  splitting, us a cut segment:");
    Report("scene", type->name, "us/segment", &splits);
    return fine;
}

enum { WARM_TICKS = 4, CUT_TICKS = 12, PLAIN_TICKS = 24, SEGMENTS = 4 };

/* COPY moves the bytes that skinning has written, as a measure of what the memory can do; RATIO is SKIN to COPY. */
enum { PLAIN, CUTTING, SPLIT, SKIN, COPY, RATIO, COSTS };
static const char* costNames[COSTS] = { "plain ms", "cutting ms", "us/segment", "skin ms", "copy ms", "skin/copy" };
static Series costs[COSTS];

/* A square sheet of one metre with `side` vertices along a side. */
static kiriResult AddSheet(kiriWorld* world, int32_t side, int32_t grid, int32_t frames, float v, kiriSheet* sheet)
{
    kiriSheetDef def;
    kiriDefaultSheetDef(&def);
    def.sleepSpeed = 0.0f;
    int32_t squares = side - 1;
    float* positions = malloc(2 * sizeof(float) * (size_t)side * (size_t)side);
    int32_t* indices = malloc(6 * sizeof(int32_t) * (size_t)squares * (size_t)squares);
    kiriFillRectangle(1.0f, 1.0f, squares, squares, positions, indices);
    def.restPositions = positions;
    def.indices = indices;
    def.vertexCount = side * side;
    def.triangleCount = 2 * squares * squares;
    def.position[1] = v;
    def.gridResolution = grid;
    def.frameCount = def.maxFrames = frames;
    kiriResult result = kiriCreateSheet(world, &def, sheet);
    free(positions);
    free(indices);
    return result;
}

static double TimeCopy(const kiriMesh* mesh, float* buffer)
{
    size_t bytes = 3 * sizeof(float) * (size_t)mesh->vertexCount;
    double start = ReadClock(NULL);
    memcpy(buffer, mesh->positions, bytes);
    memcpy(buffer + 3 * mesh->vertexCount, mesh->normals, bytes);
    return ReadClock(NULL) - start + 0.0 * buffer[mesh->vertexCount]; /* read, so that it is written */
}

/* The blade moves a few segments on, from side to side, before the tick. */
static bool RunTick(kiriWorld* world, kiriSheet sheet, kiriCut cut, int32_t tick, float* buffer)
{
    bool cutting = tick >= 0 && tick < CUT_TICKS, fine = true;
    for (int32_t i = 1; cutting && i <= SEGMENTS; i++) {
        float step = (float)(tick * SEGMENTS + i) / (CUT_TICKS * SEGMENTS);
        float point[2] = { 0.1f + 0.8f * step, 0.503f + 0.01f * (float)(i % 2) };
        fine = fine && kiriCut_Extend(world, cut, point, 1) == KIRI_OK;
    }
    kiriProfile profile;
    kiriMesh mesh;
    double start = ReadClock(NULL);
    fine = fine && kiriWorld_Tick(world, 1.0f / 60.0f, 1) >= 0;
    double seconds = ReadClock(NULL) - start;
    kiriWorld_GetProfile(world, &profile);
    kiriSheet_GetMesh(world, sheet, &mesh);
    if (cutting) {
        Add(&costs[CUTTING], 1e3 * seconds);
        Add(&costs[SPLIT], 1e6 * profile.seconds[KIRI_STAGE_CUT] / SEGMENTS);
    } else if (tick >= CUT_TICKS) {
        double skin = 1e3 * profile.seconds[KIRI_STAGE_SKIN], copy = 1e3 * TimeCopy(&mesh, buffer);
        Add(&costs[PLAIN], 1e3 * seconds);
        Add(&costs[SKIN], skin);
        Add(&costs[COPY], copy);
        Add(&costs[RATIO], skin / copy);
    }
    return fine;
}

/* Some sheets; a slit is cut into the last of them. */
static bool RunLoad(int32_t side, int32_t grid, int32_t frames, int32_t sheets)
{
    kiriWorldDef def = TimedWorld();
    kiriWorld* world = NULL;
    kiriSheet sheet = 0;
    kiriCut cut = 0;
    float* buffer = malloc(sizeof(float) * (12 * (size_t)side * (size_t)side + 65536)); /* cuts add some */
    bool fine = buffer != NULL && kiriCreateWorld(&def, &world) == KIRI_OK;
    for (int32_t i = 0; fine && i < sheets; i++) {
        fine = AddSheet(world, side, grid, frames, 2.0f * (float)i, &sheet) == KIRI_OK;
    }
    fine = fine && kiriBeginCut(world, sheet, (float[]){ 0.1f, 0.503f }, &cut) == KIRI_OK;
    for (int32_t tick = -WARM_TICKS; fine && tick < CUT_TICKS + PLAIN_TICKS; tick++) {
        fine = RunTick(world, sheet, cut, tick, buffer);
    }
    kiriDestroyWorld(world);
    free(buffer);
    return fine;
}

enum { VERTICES, FRAMES, SHEETS, TABLES };
static const char* tableNames[TABLES] = { "vertices", "frames", "sheets" };
static const int32_t sizes[TABLES][6] = { { 1 << 10, 1 << 12, 1 << 14, 1 << 16, 1 << 18, 1 << 20 },
                                          { 5, 15, 50, 150, 500 },
                                          { 1, 3, 10, 30, 100, 300 } };

static bool BenchTable(int table)
{
    bool fine = true;
    int shown = table == SHEETS ? SKIN : COSTS; /* of several sheets only one is copied */
    printf("\n\n%s, a tick: median and worst\n  %-12s", tableNames[table], "");
    for (int k = 0; k < shown; k++) {
        printf(" %19s", costNames[k]);
    }
    for (int i = 0; fine && i < 6 && sizes[table][i] > 0; i++) {
        char name[16];
        int32_t size = sizes[table][i];
        fine = RunLoad(table == VERTICES ? 32 << i
                       : table == FRAMES ? 65
                                         : 17,
                       table == SHEETS ? 16 : 64,
                       table == VERTICES ? 25
                       : table == FRAMES ? size
                                         : 5,
                       table == SHEETS ? size : 1);
        snprintf(name, sizeof name, "%d", size);
        printf("\n  %-12s", name);
        for (int k = 0; k < shown; k++) {
            Report(tableNames[table], name, costNames[k], &costs[k]);
        }
    }
    return fine;
}

int main(void)
{
    mkdir("build/bench", 0777);
    csv = fopen("build/bench/bench.csv", "w");
    bool fine = csv != NULL && fprintf(csv, "table,case,quantity,median,worst,count\n") > 0;
    for (int32_t i = 0; fine && Scene_GetType(i) != NULL; i++) {
        fine = BenchScene(Scene_GetType(i));
    }
    for (int table = 0; fine && table < TABLES; table++) {
        fine = BenchTable(table);
    }
    fine = csv != NULL && fclose(csv) == 0 && fine;
    printf("\n\n%s\n", fine ? "all numbers are in build/bench/bench.csv" : "bench: something failed");
    return fine ? 0 : 1;
}
