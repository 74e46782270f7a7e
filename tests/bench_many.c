/* Many frames and many vertices: what a tick takes without cuts, by stage. */
#define _POSIX_C_SOURCE 199309L

#include "bench.h"

enum { WARM_TICKS = 10, TICKS = 15, FEW_TICKS = 3, MANY_FRAMES = 1000 };

typedef struct Times {
    Series all, solve, skin, copy, systems;
} Times;

static void FreeTimes(Times* times)
{
    Series_Free(&times->all);
    Series_Free(&times->solve);
    Series_Free(&times->skin);
    Series_Free(&times->copy);
    Series_Free(&times->systems);
}

static bool TimeTicks(kiriWorld* world, kiriSheet sheet, int32_t substeps, float* buffer, Times* times)
{
    kiriCounts counts;
    bool fine = kiriSheet_GetCounts(world, sheet, &counts) == KIRI_OK, many = counts.frames > MANY_FRAMES;
    for (int32_t i = many ? -FEW_TICKS : -WARM_TICKS; fine && i < (many ? FEW_TICKS : TICKS); i++) {
        kiriProfile profile;
        double start = Bench_Clock(NULL);
        fine = kiriWorld_Tick(world, 1.0f / 60.0f, substeps) == KIRI_OK;
        double seconds = Bench_Clock(NULL) - start, copy = Bench_TimeCopy(world, sheet, buffer);
        fine = fine && kiriWorld_GetProfile(world, &profile) == KIRI_OK;
        if (fine && i >= 0) {
            Series_Add(&times->all, 1e3 * seconds);
            Series_Add(&times->solve, 1e3 * profile.seconds[KIRI_STAGE_SOLVE]);
            Series_Add(&times->skin, 1e3 * profile.seconds[KIRI_STAGE_SKIN]);
            Series_Add(&times->copy, 1e3 * copy);
            Series_Add(&times->systems, profile.systemsSolved);
        }
    }
    return fine;
}

static bool Run(kiriSheetDef* def, int32_t squares, int32_t substeps, Times* times)
{
    kiriWorldDef worldDef = Bench_WorldDef();
    kiriWorld* world = NULL;
    kiriSheet sheet;
    float* buffer = malloc(6 * sizeof(float) * (size_t)(squares + 1) * (size_t)(squares + 1));
    def->maxFrames = 100000;
    def->rigidArea = 1.0f;
    def->sleepSpeed = 0.0f;
    bool fine = buffer != NULL && kiriCreateWorld(&worldDef, &world) == KIRI_OK &&
                Bench_AddSheet(world, def, squares, &sheet) && Bench_PinCorners(world, sheet, 0.0f, 0.0f) &&
                TimeTicks(world, sheet, substeps, buffer, times);
    kiriDestroyWorld(world);
    free(buffer);
    return fine;
}

/* ---- Frames ------------------------------------------------------------------------------------------------------ */

/* In regular rows, as many as columns. */
static float* FillRows(int32_t rows)
{
    float* points = malloc(2 * sizeof(float) * (size_t)(rows * rows));
    for (int32_t i = 0; points != NULL && i < rows * rows; i++) {
        points[2 * i] = ((float)(i % rows) + 0.5f) / (float)rows;
        points[2 * i + 1] = ((float)(i / rows) + 0.5f) / (float)rows;
    }
    return points;
}

/* A grid of four squares a frame both ways carries them. */
static bool RunFrames(int32_t rows, const kiriQuality* quality, Times* times)
{
    kiriSheetDef def = DefaultSheet();
    float* points = FillRows(rows);
    def.frameCount = rows * rows;
    def.framePoints = points;
    def.gridResolution = 4 * rows > def.gridResolution ? 4 * rows : def.gridResolution;
    def.iterations = quality != NULL ? quality->iterations : def.iterations;
    bool fine = points != NULL && Run(&def, 32, quality != NULL ? 2 * quality->substeps : 2, times);
    free(points);
    return fine;
}

static void PrintFrames(Table* table, const char* settings, int32_t rows, Times* times, double* first)
{
    double all = Series_Median(&times->all), each = 1e3 * all / (rows * rows);
    bool accurate = first == NULL;
    if (!accurate && isnan(*first)) {
        *first = each;
    }
    Table_Text(table, settings);
    Table_Number(table, rows * rows);
    Table_Judge(table, all, !accurate || rows != 17 || all < 5.0);
    Table_Number(table, Series_Worst(&times->all));
    Table_Number(table, Series_Median(&times->solve));
    Table_Number(table, Series_Median(&times->skin));
    Table_Number(table, Series_Median(&times->systems));
    Table_Number(table, 1e3 * Series_Median(&times->solve) / Series_Median(&times->systems));
    Table_Number(table, each);
    Table_Judge(table, accurate ? (double)NAN : each / *first, accurate || each / *first <= 2.0);
    fflush(stdout);
}

static bool BenchFrames(void)
{
    static const char* const columns[] = { "settings", "frames",  "tick",     "worst",    "solve", "skin",
                                           "systems",  "us each", "us/frame", "to first", NULL };
    static const int32_t rows[] = { 7, 14, 17, 32, 71 };
    Table table;
    kiriQuality accurate;
    double first = (double)NAN;
    bool fine =
        kiriGetQuality(KIRI_QUALITY_ACCURATE, &accurate) == KIRI_OK &&
        Table_Start(&table, "frames",
                    "A square of 33 x 33 vertices hangs by two corners: ms of a tick by its frames, with the "
                    "default settings and 2 substeps, and with\nthose of ACCURATE; linear systems in it, and us "
                    "of one. Aims: time a frame at most doubles; 289 frames ACCURATE under 5 ms.",
                    columns);
    for (size_t i = 0; fine && i < 2 * (sizeof rows / sizeof rows[0]); i++) {
        Times times = { .all = { .number = NULL } };
        int32_t count = rows[i / 2];
        bool isAccurate = i % 2 == 1;
        fine = RunFrames(count, isAccurate ? &accurate : NULL, &times);
        PrintFrames(&table, isAccurate ? "ACCURATE" : "default", count, &times, isAccurate ? NULL : &first);
        FreeTimes(&times);
    }
    return Table_Stop(&table) && fine;
}

/* ---- Vertices ---------------------------------------------------------------------------------------------------- */

static void PrintSkin(Table* table, int32_t squares, const kiriSheetDef* def, Times* times, double* linear)
{
    double all = Series_Median(&times->all), skin = Series_Median(&times->skin), solve = Series_Median(&times->solve);
    bool smooth = def->skinning == KIRI_SKINNING_SMOOTH;
    *linear = smooth ? *linear : skin;
    Table_Number(table, (squares + 1) * (squares + 1));
    Table_Text(table, smooth ? "smooth" : "linear");
    Table_Text(table, def->normals != 0 ? "yes" : "no");
    Table_Judge(table, all, smooth || squares != 315 || all < 1.0);
    Table_Number(table, Series_Worst(&times->all));
    Table_Number(table, solve);
    Table_Judge(table, skin, !smooth || skin <= 2.0 * *linear);
    Table_Number(table, all - solve - skin);
    Table_Number(table, 1e6 * skin / (squares + 1) / (squares + 1));
    Table_Number(table, Series_Median(&times->copy));
    Table_Number(table, skin / Series_Median(&times->copy));
    fflush(stdout);
}

static bool BenchSkin(void)
{
    static const char* const columns[] = { "vertices", "skinning", "normals", "tick",   "worst",     "solve",
                                           "skin",     "other",    "ns each", "memcpy", "of memcpy", NULL };
    static const int32_t squares[] = { 127, 255, 315, 1023 };
    Table table;
    double linear = 0.0;
    bool fine = Table_Start(&table, "skin",
                            "A square with 25 frames: ms of a tick by its vertices; ns of skinning each; memcpy of the "
                            "bytes that skinning writes.\nAims: 100 000 vertices under 1 ms; smooth skinning within "
                            "twice linear.",
                            columns);
    for (size_t i = 0; fine && i < 4 * (sizeof squares / sizeof squares[0]); i++) {
        Times times = { .all = { .number = NULL } };
        kiriSheetDef def = DefaultSheet();
        def.frameCount = 25;
        def.normals = i / 2 % 2 == 0;
        def.skinning = i % 2 == 1 ? KIRI_SKINNING_SMOOTH : KIRI_SKINNING_LINEAR;
        fine = Run(&def, squares[i / 4], 1, &times);
        PrintSkin(&table, squares[i / 4], &def, &times, &linear);
        FreeTimes(&times);
    }
    return Table_Stop(&table) && fine;
}

/* "frames" or "skin": that table alone. */
int main(int argc, char** argv)
{
    const char* only = argc > 1 ? argv[1] : "";
    Bench_WeighClock();
    bool fine = (strcmp(only, "skin") == 0 || BenchFrames()) && (strcmp(only, "frames") == 0 || BenchSkin());
    if (!fine) {
        fprintf(stderr, "bench_many: something failed\n");
    }
    return fine ? 0 : 1;
}
