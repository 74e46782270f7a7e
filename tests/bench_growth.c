/* How costs grow: that of a short cut with the size of the sheet, and of a tick with vertices, frames and sheets. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

static const float stepSeconds = 1.0f / 60.0f;

/* ---- The same cut in ever larger sheets -------------------------------------------------------------------------- */

enum { CELLS_A_FRAME = 200, SEGMENTS = 10, PLACES = 4 };

/* A sheet is as fine as its grid, and has frames in proportion. */
typedef struct Size {
    int32_t grid;
    int32_t places; /* where a cut is made from scratch, at most PLACES */
} Size;

static const Size sizes[] = { { 32, PLACES }, { 64, PLACES }, { 128, PLACES }, { 256, 1 }, { 512, 1 } };

typedef struct CommitTimes {
    Series stage[KIRI_STAGE_CONSTANTS + 1], all, items;
    double first; /* commit of the sheet, which makes room for more to come */
} CommitTimes;

static void NoteCommit(CommitTimes* times, const kiriProfile* profile)
{
    double seconds = 0.0;
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        seconds += profile->seconds[k];
        Series_Add(&times->stage[k], 1e3 * profile->seconds[k]);
    }
    if (times->all.count == 0) {
        times->first = 1e3 * seconds;
    }
    Series_Add(&times->all, 1e3 * seconds);
    Series_Add(&times->items, profile->trianglesSplit + profile->cellsSettled + profile->samplesRefreshed);
}

static void FreeTimes(CommitTimes* times)
{
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        Series_Free(&times->stage[k]);
    }
    Series_Free(&times->all);
    Series_Free(&times->items);
}

/* One segment a tick, each about as long as a cell, in zigzag, in the middle of the sheet. */
static bool CutShort(kiriWorld* world, kiriSheet sheet, int32_t grid, int32_t place, CommitTimes* times)
{
    float cell = 1.0f / (float)grid;
    float u = 0.5f + 13.0f * cell * (float)(place % 2 - 1), v = 0.5f + 7.3f * cell * (float)(place / 2);
    kiriCut cut;
    bool fine = kiriBeginCut(world, sheet, (float[]){ u, v }, &cut) == KIRI_OK;
    for (int32_t i = 1; fine && i <= SEGMENTS; i++) {
        float point[2] = { u + 0.97f * cell * (float)i, v + 0.3f * cell * (float)(i % 2) };
        kiriProfile profile;
        fine = kiriCut_Extend(world, cut, point, 1) == KIRI_OK && kiriWorld_Tick(world, stepSeconds, 1) == KIRI_OK &&
               kiriWorld_GetProfile(world, &profile) == KIRI_OK;
        if (fine && profile.commits > 0) {
            NoteCommit(times, &profile);
        }
    }
    return fine && kiriCut_End(world, cut) == KIRI_OK;
}

static bool RunSize(int32_t grid, int32_t places, bool fromScratch, CommitTimes* times)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    SCOPED_WORLD(world) = NULL;
    kiriSheet sheet;
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = grid;
    def.frameCount = def.maxFrames = grid * grid / CELLS_A_FRAME;
    def.iterations = 1;
    def.collisionPoints = 4 * def.frameCount;
    def.paper.fromScratch = fromScratch;
    bool fine = kiriCreateWorld(&worldDef, &world) == KIRI_OK && Bench_AddSheet(world, &def, grid, &sheet);
    for (int32_t place = 0; fine && place < places; place++) {
        fine = CutShort(world, sheet, grid, place, times);
    }
    return fine;
}

static void PrintSize(Table* table, const Size* size, CommitTimes times[2], double* reference)
{
    double median = Series_Median(&times[0].all), scratch = Series_Median(&times[1].all);
    *reference = size->grid == 64 ? median : *reference;
    double growth = median / *reference;
    TABLE_NUMBERS(table, size->grid, size->grid * size->grid / CELLS_A_FRAME);
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        Table_Number(table, Series_Median(&times[0].stage[k]));
    }
    TABLE_NUMBERS(table, median, times[0].first, Series_Median(&times[0].items));
    Table_Judge(table, growth, !(growth > 1.5));
    TABLE_NUMBERS(table, scratch, scratch / median);
}

static bool BenchGrowth(void)
{
    static const char* const columns[] = { "grid",  "frames",    "cut",       "grid",        "regions",
                                           "shape", "samples",   "constants", "all",         "first",
                                           "items", "all to 64", "scratch",   "scratch/all", NULL };
    Table table;
    if (!Table_Start(
            &table, "growth",
            "A short cut in the middle of sheets of growing size: ms of a commit in each stage, median; the first "
            "of all, which makes room;\nthe items of work in it, as budgets count them. Frames, and all that is "
            "skinned, grow with the grid, so ever more of what a cut\nneeds has left the caches. Aim: at most 1.5 "
            "times what it costs on a grid of 64.",
            columns)) {
        return false;
    }
    bool fine = true;
    double reference = (double)NAN;
    for (size_t i = 0; fine && i < sizeof sizes / sizeof sizes[0]; i++) {
        CommitTimes times[2] = { { .all = { .number = NULL } } };
        fine = RunSize(sizes[i].grid, PLACES, false, &times[0]) &&
               RunSize(sizes[i].grid, sizes[i].places, true, &times[1]);
        PrintSize(&table, &sizes[i], times, &reference);
        FreeTimes(&times[0]);
        FreeTimes(&times[1]);
    }
    return Table_Stop(&table) && fine;
}

/* ---- A tick under load ------------------------------------------------------------------------------------------- */

enum { WARM_TICKS = 40, TICKS = 40 }; /* a sheet at rest falls asleep after 30 */

typedef struct Load {
    int32_t squares, grid, frames, sheets;
    bool asleep;
} Load;

static const Load loads[] = {
    { 31, 32, 25, 1, false },  { 63, 32, 25, 1, false },   { 127, 32, 25, 1, false },  { 255, 32, 25, 1, false },
    { 511, 32, 25, 1, false }, { 1023, 32, 25, 1, false }, { 31, 64, 5, 1, false },    { 31, 64, 15, 1, false },
    { 31, 64, 50, 1, false },  { 31, 64, 150, 1, false },  { 31, 64, 500, 1, false },  { 16, 16, 5, 1, false },
    { 16, 16, 5, 10, false },  { 16, 16, 5, 100, false },  { 16, 16, 5, 1000, false }, { 16, 16, 5, 1, true },
    { 16, 16, 5, 10, true },   { 16, 16, 5, 100, true },   { 16, 16, 5, 1000, true },
};

typedef struct LoadTimes {
    Series all, solve, skin, copy;
} LoadTimes;

static bool TimeTicks(kiriWorld* world, const kiriSheet* sheets, int32_t count, float* buffer, LoadTimes* times)
{
    for (int32_t i = -WARM_TICKS; i < TICKS; i++) {
        kiriProfile profile;
        double start = Bench_Clock(NULL);
        if (kiriWorld_Tick(world, stepSeconds, 1) != KIRI_OK || kiriWorld_GetProfile(world, &profile) != KIRI_OK) {
            return false;
        }
        double seconds = Bench_Clock(NULL) - start, copy = 0.0;
        for (int32_t k = 0; k < count; k++) {
            copy += Bench_TimeCopy(world, sheets[k], buffer);
        }
        if (i >= 0) {
            Series_Add(&times->all, 1e3 * seconds);
            Series_Add(&times->solve, 1e3 * profile.seconds[KIRI_STAGE_SOLVE]);
            Series_Add(&times->skin, 1e3 * profile.seconds[KIRI_STAGE_SKIN]);
            Series_Add(&times->copy, 1e3 * copy);
        }
    }
    return true;
}

static bool RunLoad(const Load* load, LoadTimes* times)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    worldDef.gravity[2] = load->asleep ? 0.0f : worldDef.gravity[2];
    kiriSheetDef def = DefaultSheet();
    def.gridResolution = load->grid;
    def.frameCount = def.maxFrames = load->frames;
    def.sleepSpeed = load->asleep ? def.sleepSpeed : 0.0f;
    SCOPED_WORLD(world) = NULL;
    size_t vertices = (size_t)(load->squares + 1) * (size_t)(load->squares + 1);
    FREED(float, buffer) = malloc(6 * sizeof(float) * vertices);
    kiriSheet* sheets = calloc((size_t)load->sheets, sizeof *sheets);
    bool fine = buffer != NULL && sheets != NULL && kiriCreateWorld(&worldDef, &world) == KIRI_OK;
    for (int32_t i = 0; fine && i < load->sheets; i++) {
        fine = Bench_AddSheet(world, &def, load->squares, &sheets[i]);
    }
    fine = fine && TimeTicks(world, sheets, load->sheets, buffer, times);
    for (int32_t i = 0, awake; fine && i < load->sheets; i++) {
        fine = kiriSheet_IsAwake(world, sheets[i], &awake) == KIRI_OK && (awake == 0) == load->asleep;
    }
    free(sheets);
    return fine;
}

static void PrintLoad(Table* table, const Load* load, LoadTimes* times)
{
    double all = Series_Median(&times->all), skin = Series_Median(&times->skin), copy = Series_Median(&times->copy);
    int32_t vertices = (load->squares + 1) * (load->squares + 1);
    TABLE_NUMBERS(table, vertices, load->frames, load->sheets);
    Table_Text(table, load->asleep ? "yes" : "no");
    TABLE_NUMBERS(table, all, Series_Worst(&times->all), Series_Median(&times->solve), skin, copy,
                  load->asleep ? (double)NAN : 100.0 * copy / skin,
                  load->asleep ? (double)NAN : 1e6 * skin / vertices / load->sheets);
}

static bool BenchLoads(void)
{
    static const char* const columns[] = { "vertices", "frames", "sheets", "asleep",   "tick",      "worst",
                                           "solve",    "skin",   "memcpy", "memcpy %", "ns/vertex", NULL };
    Table table;
    if (!Table_Start(
            &table, "loads",
            "ms of a tick without a cut, median and worst, as vertices, frames and sheets grow (vertices and "
            "frames are of each sheet).\nmemcpy: of the bytes that skinning writes; %: of the time that skinning "
            "takes.",
            columns)) {
        return false;
    }
    bool fine = true;
    for (size_t i = 0; fine && i < sizeof loads / sizeof loads[0]; i++) {
        LoadTimes times = { .all = { .number = NULL } };
        fine = RunLoad(&loads[i], &times);
        PrintLoad(&table, &loads[i], &times);
        Series_Free(&times.all);
        Series_Free(&times.solve);
        Series_Free(&times.skin);
        Series_Free(&times.copy);
    }
    return Table_Stop(&table) && fine;
}

int main(void)
{
    Bench_WeighClock();
    bool fine = BenchGrowth() && BenchLoads();
    return Bench_End(fine, "bench_growth: something failed");
}
