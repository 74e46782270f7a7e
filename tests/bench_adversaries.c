/* Whether a budget holds: what hosts may do that costs much, under one budget, fitted on another scene. An argument
   selects one row by its name. */
#define _DEFAULT_SOURCE

#include "adversary.h"

#include <signal.h>

enum { CUT_MS = 3, SOLVE_MS = 1, BUDGET_MS = CUT_MS + SOLVE_MS };

/* ---- What hosts do ---- */

static bool CutAlong(Bed* bed, int32_t sheet, const float* points, int32_t count)
{
    kiriCut cut;
    return kiriSheet_Cut(bed->world, bed->sheets[sheet], points, count, &cut) == KIRI_OK;
}

/* From radius to 0, about the middle. */
static bool CutSpiral(Bed* bed, int32_t count, double turns, double radius)
{
    FREED(float, points) = malloc(2 * sizeof(float) * (size_t)count);
    for (int32_t i = 0; points != NULL && i < count; i++) {
        double share = 1.0 - (double)i / count, angle = 6.283185307179586 * turns * share;
        points[2 * i] = (float)(0.503 + radius * share * cos(angle));
        points[2 * i + 1] = (float)(0.497 + radius * share * sin(angle));
    }
    bool fine = points != NULL && CutAlong(bed, 0, points, count);
    return fine;
}

static bool CutSpiral20k(Bed* bed, int32_t action)
{
    return CutSpiral(bed, 20000, 10.0, 0.45);
}

static bool CutKnot20k(Bed* bed, int32_t action)
{
    return CutSpiral(bed, 20000, 100.0, 0.05);
}

static bool CutTurns(Bed* bed, int32_t action)
{
    return CutSpiral(bed, 2000, 10.0, 0.45);
}

/* Both ways from side to side, so that each way has so many parts. */
static bool CutDice(Bed* bed, int32_t parts)
{
    bool fine = true;
    for (int32_t i = 1; fine && i < parts; i++) {
        float at = ((float)i + 0.013f) / (float)parts;
        fine = CutAlong(bed, 0, (float[]){ at, -0.1f, at, 1.1f }, 2) &&
               CutAlong(bed, 0, (float[]){ -0.1f, at, 1.1f, at }, 2);
    }
    return fine;
}

static bool CutDice41(Bed* bed, int32_t action)
{
    return CutDice(bed, 41);
}

/* A cut of some hundredths, elsewhere each time. */
static bool CutShort(Bed* bed, int32_t action)
{
    float u = 0.31f + 0.17f * (float)action, v = 0.42f + 0.11f * (float)action;
    return CutAlong(bed, 0, (float[]){ u, v, u + 0.031f, v + 0.011f }, 2);
}

/* From one triangle of a coarse mesh to another. */
static bool CutAcross(Bed* bed, int32_t action)
{
    return CutAlong(bed, 0, (float[]){ 0.41f, 0.33f, 0.52f, 0.46f }, 2);
}

static bool CutEachShort(Bed* bed, int32_t action)
{
    bool fine = true;
    for (int32_t i = 0; fine && i < bed->count; i++) {
        fine = CutAlong(bed, i, (float[]){ 0.41f, 0.33f, 0.59f, 0.66f }, 2);
    }
    return fine;
}

static bool Slash(Bed* bed, int32_t action)
{
    return CutAlong(bed, 0, (float[]){ -0.1f, 0.487f, 1.1f, 0.513f }, 2);
}

/* ---- Pieces ---- */

static bool CutDice16(Bed* bed)
{
    return CutDice(bed, 16) && Bed_Finish(bed);
}

/* The smallest piece, which is the corner. */
static kiriFrame FrameOfSmallest(Bed* bed)
{
    kiriPieceState state;
    kiriFrame frame = 0;
    double least = 1e30;
    for (int32_t i = 0; kiriSheet_GetPiece(bed->world, bed->sheets[0], i, &state) == KIRI_OK; i++) {
        const kiriFrame* frames;
        int32_t count;
        if (state.area < least && kiriSheet_GetPieceFrames(bed->world, bed->sheets[0], i, &frames, &count) == KIRI_OK) {
            least = state.area;
            frame = frames[0];
        }
    }
    return frame;
}

/* To make the lists of pieces is a call by itself, which no budget limits. */
static bool CutCorner(Bed* bed)
{
    bool fine = CutAlong(bed, 0, (float[]){ 0.81f, -0.1f, 0.8f, 0.21f, 1.1f, 0.2f }, 3) && Bed_Finish(bed);
    bed->corner = fine ? FrameOfSmallest(bed) : 0;
    return bed->corner != 0;
}

static bool Detach(Bed* bed, int32_t action)
{
    kiriSheet detached = 0;
    kiriResult result = kiriFrame_DetachPiece(bed->world, bed->corner, &detached);
    bed->leaving = result == KIRI_PENDING ? bed->corner : 0;
    return result >= 0;
}

static bool DropCrumbs(Bed* bed, int32_t action)
{
    int32_t count;
    return kiriSheet_DropCrumbs(bed->world, bed->sheets[0], 1.0f, &count) >= 0;
}

/* ---- Meshes ---- */

/* A square of one metre between lines at these places, the same both ways. */
static bool AddBetweenLines(Bed* bed, kiriSheetDef* def, const double* lines, int32_t count)
{
    size_t n = (size_t)count;
    FREED(float, rest) = malloc(2 * sizeof(float) * n * n);
    FREED(int32_t, indices) = malloc(6 * sizeof(int32_t) * n * n);
    bool fine = rest != NULL && indices != NULL &&
                kiriFillRectangle(1.0f, 1.0f, count - 1, count - 1, rest, indices) == KIRI_OK;
    for (size_t i = 0; fine && i < n * n; i++) {
        rest[2 * i] = (float)lines[(size_t)(rest[2 * i] * (float)(n - 1) + 0.5f)];
        rest[2 * i + 1] = (float)lines[(size_t)(rest[2 * i + 1] * (float)(n - 1) + 0.5f)];
    }
    def->restPositions = rest;
    def->indices = indices;
    def->vertexCount = count * count;
    def->triangleCount = 2 * (count - 1) * (count - 1);
    fine = fine && kiriCreateSheet(bed->world, def, &bed->sheets[0]) == KIRI_OK;
    return fine;
}

/* 16 lines, and 266 within one square of a grid of 32. */
static bool AddFinePatch(Bed* bed, kiriSheetDef* def)
{
    enum { COARSE = 16, FINE = 266 };
    double lines[COARSE + 1 + FINE];
    int32_t count = 0;
    for (int32_t i = 0; i <= COARSE; i++) {
        lines[count++] = (double)i / COARSE;
        for (int32_t k = 1; i == COARSE / 2 && k <= FINE; k++) {
            lines[count++] = (double)i / COARSE + 0.002 + 0.027 * (double)k / FINE;
        }
    }
    return AddBetweenLines(bed, def, lines, count);
}

static bool CutFinePatch(Bed* bed, int32_t action)
{
    return CutAlong(bed, 0, (float[]){ 0.49f, 0.513f, 0.54f, 0.519f }, 2);
}

/* ---- Rows ---- */

static const Adversary adversaries[] = {
    { .name = "spiral20k", .squares = 64, .grid = 64, .frames = 25, .act = CutSpiral20k, .seconds = 40 },
    { .name = "knot20k", .squares = 64, .grid = 64, .frames = 25, .act = CutKnot20k, .seconds = 40 },
    { .name = "dice40", .squares = 256, .grid = 64, .frames = 4, .act = CutDice41, .seconds = 40 },
    { .name = "spiral10", .squares = 256, .grid = 64, .frames = 25, .act = CutTurns },
    { .name = "short1m", .squares = 1000, .grid = 512, .frames = 25, .act = CutShort, .actions = 3 },
    { .name = "sleep1000",
      .squares = 16,
      .grid = 16,
      .frames = 5,
      .act = CutEachShort,
      .sheets = 1000,
      .asleep = true },
    { .name = "slash513", .squares = 512, .grid = 512, .frames = 25, .act = Slash, .cells = 200, .seconds = 400 },
    { .name = "patch142k", .build = AddFinePatch, .grid = 32, .frames = 25, .act = CutFinePatch },
    { .name = "grid1024", .squares = 8, .grid = 1024, .frames = 5, .act = CutAcross },
    { .name = "detach65", .squares = 64, .grid = 64, .frames = 25, .act = Detach, .prepare = CutCorner },
    { .name = "detach257", .squares = 256, .grid = 256, .frames = 25, .act = Detach, .prepare = CutCorner },
    { .name = "detach1001", .squares = 1000, .grid = 512, .frames = 25, .act = Detach, .prepare = CutCorner },
    { .name = "crumbs256", .squares = 256, .grid = 64, .frames = 4, .act = DropCrumbs, .prepare = CutDice16 },
};

/* ---- The budget ---- */

/* Two waves of zigzag cuts over 8 sheets: what the budget is fitted on. */
static bool ActReference(Bed* bed, int32_t action)
{
    enum { POINTS = 24 };
    float points[2 * POINTS];
    for (int32_t i = 0; i < POINTS; i++) {
        float along = -0.05f + 1.1f * (float)i / (POINTS - 1);
        points[2 * i + action % 2] = along;
        points[2 * i + 1 - action % 2] = 0.31f + 0.021f * (float)(i % 3) + 0.2f * along;
    }
    bool fine = true;
    for (int32_t i = 0; fine && i < bed->count; i++) {
        fine = CutAlong(bed, i, points, POINTS);
    }
    return fine;
}

static const Adversary reference = {
    .name = "reference", .squares = 48, .grid = 48, .frames = 12, .act = ActReference, .sheets = 8, .actions = 4
};

/* Adds what cuts cost to one profile, and what motion costs to the other. */
static void SplitProfile(const kiriProfile* profile, kiriProfile* cuts, kiriProfile* motion)
{
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        cuts->seconds[k] += profile->seconds[k];
    }
    cuts->trianglesSplit += profile->trianglesSplit;
    cuts->cellsSettled += profile->cellsSettled;
    cuts->samplesRefreshed += profile->samplesRefreshed;
    motion->seconds[KIRI_STAGE_SOLVE] += profile->seconds[KIRI_STAGE_SOLVE];
    motion->solverIterations += profile->solverIterations;
}

static bool RunReference(kiriProfile* cuts, kiriProfile* motion)
{
    Bed bed;
    kiriProfile profile;
    memset(cuts, 0, sizeof *cuts);
    memset(motion, 0, sizeof *motion);
    bool fine = Bed_Start(&bed, &reference);
    for (int32_t i = 0; fine && i < 5 * reference.actions; i++) {
        fine = (i % 5 > 0 || ActReference(&bed, i / 5)) && Bed_Tick(&bed) &&
               kiriWorld_GetProfile(bed.world, &profile) == KIRI_OK;
        SplitProfile(&profile, cuts, motion);
    }
    Bed_Stop(&bed);
    return fine;
}

static int32_t MoreOf(int32_t a, int32_t b)
{
    return a > b ? a : b;
}

/* Of three runs the one that was disturbed least. */
static bool FitBudget(kiriBudget* budget)
{
    bool fine = true;
    for (int run = 0; fine && run < 3; run++) {
        kiriProfile cuts, motion;
        kiriBudget fit = { 0 };
        fine = RunReference(&cuts, &motion) && kiriFitBudget(&cuts, 1e3f * CUT_MS, &fit) == KIRI_OK &&
               kiriFitBudget(&motion, 1e3f * SOLVE_MS, &fit) == KIRI_OK;
        budget->triangles = MoreOf(budget->triangles, fit.triangles);
        budget->cells = MoreOf(budget->cells, fit.cells);
        budget->samples = MoreOf(budget->samples, fit.samples);
        budget->iterations = MoreOf(budget->iterations, fit.iterations);
    }
    return fine;
}

/* ---- The table ---- */

static const char* NameOfStage(int32_t stage)
{
    return stage == STAGE_OTHER ? "other" : kiriGetStageName(stage);
}

static double MedianWaiting(const Course* course)
{
    SCOPED(Series, series, Series_Free);
    for (int32_t i = 0; i < course->count; i++) {
        if (course->waits[i]) {
            Series_Add(&series, course->times[i]);
        }
    }
    double median = series.count > 0 ? Series_Median(&series) : course->plain;
    return median;
}

static int32_t WorstTick(const Course* course)
{
    int32_t worst = 0;
    for (int32_t i = 1; i < course->count; i++) {
        worst = course->times[i] > course->times[worst] ? i : worst;
    }
    return worst;
}

static void PrintItems(Table* table, const Course* course, const kiriBudget* budget)
{
    const int32_t allowed[KINDS] = { budget->triangles, budget->cells, budget->samples, budget->iterations };
    static const double fair[KINDS] = { 3.0, 0.3, 0.6, 0.0 };
    for (int32_t k = 0; k < KINDS; k++) {
        Table_Judge(table, course->most[k], course->most[k] <= allowed[k]);
    }
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        double item = course->item[k];
        Table_Judge(table, item > 0.0 ? item : (double)NAN, !(item > 3.0 * fair[KindOf(k)]));
    }
    Table_Number(table, course->item[KIRI_STAGE_SOLVE] > 0.0 ? course->item[KIRI_STAGE_SOLVE] : (double)NAN);
}

static void PrintCourse(Table* table, const Adversary* adversary, const Course* course, const kiriBudget* fitted)
{
    kiriBudget budget = *fitted;
    budget.cells = adversary->cells > 0 ? adversary->cells : budget.cells;
    int32_t at = WorstTick(course);
    double worst = course->times[at], median = MedianWaiting(course);
    Table_Text(table, adversary->name);
    TABLE_NUMBERS(table, course->create, course->plain, median);
    Table_Judge(table, worst, worst - course->plain <= 2.0 * BUDGET_MS);
    Table_Judge(table, worst / median, worst < 1.0 || worst / median <= 2.0);
    Table_Text(table, NameOfStage(course->stages[at]));
    Table_Judge(table, course->count, course->done);
    Table_Text(table, course->done ? "yes" : "no*");
    PrintItems(table, course, &budget);
    fflush(stdout);
}

enum { ROWS = sizeof adversaries / sizeof adversaries[0] };

/* us an item of each stage, over the ticks in which it did most of the work on cuts; or 0. */
typedef struct Paces {
    double of[ROWS][KIRI_STAGE_COUNT];
} Paces;

static void TakePaces(Paces* paces, const Course* course, size_t row)
{
    for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
        paces->of[row][k] = course->items[k] > 0.0 ? 1e6 * course->seconds[k] / course->items[k] : 0.0;
    }
}

/* Over all rows, of stages whose items are of that kind: the largest over the smallest. */
static double SpreadOf(const Paces* paces, int32_t kind)
{
    double least = 1e30, most = 0.0;
    for (int32_t row = 0; row < ROWS; row++) {
        for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
            double pace = KindOf(k) == kind ? paces->of[row][k] : 0.0;
            least = pace > 0.0 && pace < least ? pace : least;
            most = pace > most ? pace : most;
        }
    }
    return most > 0.0 ? most / least : (double)NAN;
}

static void PrintPaces(Table* table, const Paces* paces)
{
    for (int32_t row = 0; row < ROWS; row++) {
        Table_Text(table, adversaries[row].name);
        for (int32_t k = 0; k <= KIRI_STAGE_SOLVE; k++) {
            if (KindOf(k) < KINDS) {
                double pace = paces->of[row][k];
                Table_Number(table, pace > 0.0 ? pace : (double)NAN);
            }
        }
    }
    Table_Text(table, "largest over smallest, of the kind");
    for (int32_t k = 0; k <= KIRI_STAGE_SOLVE; k++) {
        if (KindOf(k) < KINDS) {
            double spread = SpreadOf(paces, KindOf(k));
            Table_Judge(table, spread, !(spread > 3.0));
        }
    }
}

static bool RunRows(Table* table, const char* name, const kiriBudget* budget, Paces* paces)
{
    Course* shared = mmap(NULL, sizeof *shared, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    FREED(Course, course) = malloc(sizeof *course);
    bool fine = course != NULL && shared != MAP_FAILED, found = false;
    for (size_t i = 0; fine && i < ROWS; i++) {
        if (name == NULL || strcmp(name, adversaries[i].name) == 0) {
            found = true;
            Course_RunApart(course, shared, &adversaries[i], budget);
            fine = course->fine;
            if (fine) {
                PrintCourse(table, &adversaries[i], course, budget);
                TakePaces(paces, course, i);
            }
        }
    }
    return fine && found;
}

static bool PrintItemTable(const Paces* paces)
{
    static const char* const columns[] = {
        "row                               ", "cut", "grid", "regions", "shape", "samples", "constants", "solve", NULL
    };
    Table table;
    if (!Table_Start(&table, "adversary_items",
                     "us an item of each stage, over the ticks in which it did most of the work on cuts. Aim: of a "
                     "kind, and triangles are "
                     "of the cut, cells of grid,\nregions and shape, samples of the next two, the largest is at most "
                     "three times the smallest.",
                     columns)) {
        return false;
    }
    PrintPaces(&table, paces);
    return Table_Stop(&table);
}

int main(int count, char** arguments)
{
    static Paces paces;
    static const char* const columns[] = {
        "row       ", "create",     "plain",     "median",     "worst",        "worst/median", "stage    ",
        "ticks",      "done",       "triangles", "cells",      "samples",      "systems",      "us cut",
        "us grid",    "us regions", "us shape",  "us samples", "us constants", "us solve",     NULL
    };
    static char title[1024];
    kiriBudget budget = { 0 };
    Table table;
    Bench_WeighClock();
    bool fine = FitBudget(&budget);
    snprintf(
        title, sizeof title,
        "Adversaries of the budget. It is fitted by kiriFitBudget on one other scene, cuts through 8 sheets of 48 x "
        "48: %d ms for cuts,\n%d triangles, %d cells, %d samples; %d ms for motion, %d systems. ms: to create, "
        "of a plain tick, of a tick while work waits, of the\nworst (with what the host calls before it), and "
        "which stage that was, each tick of the run of three in which it was fastest; ticks until nothing waits.\nMost "
        "items in a tick; us an item where it was worst. Aims: the worst tick at most twice the budget above a plain "
        "one, and twice\nthe median; an item within three times 3 us a triangle, 0.3 a cell, 0.6 a sample.",
        CUT_MS, budget.triangles, budget.cells, budget.samples, SOLVE_MS, budget.iterations);
    fine = fine && Table_Start(&table, "adversaries", title, columns) &&
           RunRows(&table, count > 1 ? arguments[1] : NULL, &budget, &paces) && Table_Stop(&table) &&
           PrintItemTable(&paces);
    return Bench_End(fine, "bench_adversaries: something failed, or no row has that name");
}
