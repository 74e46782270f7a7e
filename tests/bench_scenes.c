/* The scenes of the paper, and others: ticks a second, milliseconds of each stage, and what a cut touches, beside the
   paper's own numbers. Each scene runs several times, by turns as cuts usually do and rebuilding all from scratch. What
   a tick takes is the median over the runs. */
#define _POSIX_C_SOURCE 199309L

#include "../samples/scene.h"
#include "bench.h"

enum { INCREMENTAL, SCRATCH, MODES, RUNS = 3, MAX_TICKS = 1024 };
enum { BEFORE, CUTTING, PAUSE, AFTER }; /* a pause: blades move, and no cut takes effect */

/* What is timed of a tick, in milliseconds beside the last: the stages, and then. */
enum { COMMIT = KIRI_STAGE_COUNT, ALL, SEGMENT, SYSTEMS, QUANTITIES };
static const char* const quantityNames[] = { "commit", "all", "us/segment", "systems" };

enum { CELLS, WEIGHTS, VERTICES, POINTS, LINKS, SHARES };

typedef struct Paper {
    const char* scene;
    double rates[3];       /* lowest frames a second before, while and after cutting (table 1) */
    double shares[SHARES]; /* % updated (table 2) */

    /* Of our blade, so that it changes the paper's share of cells; 0: its own. Where it changes more at any
       pace, since a point cuts into one cell at least: the paper's share by ours. */
    float pace;
} Paper;

static const Paper papers[] = {
    { "spiral", { 60, 14.4, 60 }, { 0.07, 28.1, 61.5, 27.2, 41.3 }, 0.32f },
    { "kirigami", { 11.3, 3.2, 10.9 }, { 1.06, 15.9, 17.8, 15.8, 20.3 }, 15.5f },
    { "patchwork", { 60, 6.8, 45 }, { 0.02, 2.78, 4.33, 2.55, 7.15 }, 0.19f },
    { "vortex", { 45, 7.2, 35.7 }, { 0.08, 10.3, 12.8, 9.2, 24.2 }, 1.15f },
    { "fallingguy", { 60, 8.2, 60 }, { 0.09, 5.84, 11.4, 5.77, 14.9 }, 0.75f },
    { "bunny", { NAN, NAN, NAN }, { NAN, NAN, NAN, NAN, NAN }, 0.0f },
    { "rubber", { NAN, NAN, NAN }, { NAN, NAN, NAN, NAN, NAN }, 0.0f },
    { "flat", { NAN, NAN, NAN }, { NAN, NAN, NAN, NAN, NAN }, 0.0f },
};
enum { PAPERS = sizeof papers / sizeof papers[0] };

/* What is the same in all runs of a scene. */
typedef struct Facts {
    kiriProfile profile;
    kiriCounts counts;
} Facts;

typedef struct Recording {
    const Paper* paper;
    const SceneType* type;
    int32_t grid;
    Facts facts[MAX_TICKS];
    uint64_t hash[MODES];
    float times[MODES][MAX_TICKS][QUANTITIES][RUNS];
    double shares[SHARES]; /* mean % updated at the paper's pace */
} Recording;

static Recording recordings[PAPERS];

/* ---- Recording --------------------------------------------------------------------------------------------------- */

static double CommitOf(const kiriProfile* profile)
{
    double seconds = 0.0;
    for (int32_t k = KIRI_STAGE_GRID; k <= KIRI_STAGE_CONSTANTS; k++) {
        seconds += profile->seconds[k];
    }
    return seconds;
}

static void Note(Recording* recording, int mode, int run, int32_t tick, double seconds, const Facts* facts)
{
    float(*times)[RUNS] = recording->times[mode][tick];
    for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
        times[k][run] = (float)(1e3 * facts->profile.seconds[k]);
    }
    times[COMMIT][run] = (float)(1e3 * CommitOf(&facts->profile));
    times[ALL][run] = (float)(1e3 * seconds);
    int32_t steps = recording->type->substeps * facts->counts.pieces;
    times[SYSTEMS][run] = (float)facts->profile.systemsSolved / (float)steps;
    if (facts->profile.cutSegments > 0) {
        times[SEGMENT][run] = (float)(1e6 * facts->profile.seconds[KIRI_STAGE_CUT] / facts->profile.cutSegments);
    }
}

static bool Record(Recording* recording, int mode, int run)
{
    const SceneType* type = recording->type;
    const SceneOptions options = { .asPaper = true, .fromScratch = mode == SCRATCH };
    kiriWorldDef def = Bench_WorldDef();
    SCOPED(Scene, scene, Scene_Stop);
    bool fine = type->ticks <= MAX_TICKS && Scene_Start(&scene, type, &def, &options);
    for (int32_t i = 0; fine && i < type->ticks; i++) {
        Facts facts;
        double start = Bench_Clock(NULL);
        fine = Scene_Tick(&scene) >= 0;
        double seconds = Bench_Clock(NULL) - start;
        kiriWorld_GetProfile(scene.world, &facts.profile);
        kiriSheet_GetCounts(scene.world, scene.sheet, &facts.counts);
        Note(recording, mode, run, i, seconds, &facts);
        if (mode == INCREMENTAL) {
            recording->facts[i] = facts;
        }
    }
    recording->grid = scene.gridResolution;
    fine = fine && kiriWorld_GetStateHash(scene.world, &recording->hash[mode]) == KIRI_OK;
    return fine;
}

/* % of what there is that a tick has changed. */
static double ShareOf(const Facts* facts, int share)
{
    const kiriProfile* p = &facts->profile;
    const kiriCounts* c = &facts->counts;
    const int32_t changed[] = { p->cellsChanged, p->weightsChanged, p->verticesChanged, p->pointsChanged,
                                p->linksChanged };
    const int32_t all[] = { c->cells, c->cells, c->vertices, c->collisionPoints, c->links };
    return 100.0 * changed[share] / all[share];
}

/* What the blade changes at the paper's pace, in the mean over all ticks until it is through. */
static bool RecordPaced(Recording* recording)
{
    const SceneOptions options = { .asPaper = true, .pace = recording->paper->pace };
    kiriWorldDef def = Bench_WorldDef();
    SCOPED(Scene, scene, Scene_Stop);
    Series series[SHARES] = { { .number = NULL } };
    bool fine = Scene_Start(&scene, recording->type, &def, &options);
    while (fine && scene.tick <= scene.type->lastCut) {
        Facts facts;
        fine = Scene_Tick(&scene) >= 0;
        kiriWorld_GetProfile(scene.world, &facts.profile);
        kiriSheet_GetCounts(scene.world, scene.sheet, &facts.counts);
        for (int k = 0; k < SHARES && scene.tick > scene.type->firstCut; k++) {
            Series_Add(&series[k], ShareOf(&facts, k));
        }
    }
    for (int k = 0; k < SHARES; k++) {
        recording->shares[k] = Series_Mean(&series[k]);
        Series_Free(&series[k]);
    }
    return fine;
}

static bool RecordAll(Recording* recording, const Paper* paper)
{
    bool fine = true;
    recording->paper = paper;
    recording->type = Scene_FindType(paper->scene);
    for (int run = 0; fine && run < RUNS; run++) {
        fine = Record(recording, INCREMENTAL, run) && Record(recording, SCRATCH, run);
    }
    fine = fine && (paper->pace == 0.0f || RecordPaced(recording));
    if (fine && recording->hash[INCREMENTAL] != recording->hash[SCRATCH]) {
        fprintf(stderr, "%s: cuts from scratch end elsewhere\n", paper->scene);
        fine = false;
    }
    return fine;
}

/* ---- Reading ----------------------------------------------------------------------------------------------------- */

static int PhaseOf(const Recording* recording, int32_t tick)
{
    const SceneType* type = recording->type;
    return tick < type->firstCut                        ? BEFORE
           : recording->facts[tick].profile.commits > 0 ? CUTTING
           : tick <= type->lastCut                      ? PAUSE
                                                        : AFTER;
}

/* The median over the runs. */
static double TimeOf(const Recording* recording, int mode, int32_t tick, int quantity)
{
    SCOPED(Series, runs, Series_Free);
    for (int run = 0; run < RUNS; run++) {
        Series_Add(&runs, recording->times[mode][tick][quantity][run]);
    }
    double median = Series_Median(&runs);
    return median;
}

/* Of the ticks of one phase or two. */
static Series TimesOf(const Recording* recording, int mode, int first, int last, int quantity)
{
    Series series = { .number = NULL };
    for (int32_t i = 0; i < recording->type->ticks; i++) {
        int phase = PhaseOf(recording, i);
        if (phase >= first && phase <= last) {
            Series_Add(&series, TimeOf(recording, mode, i, quantity));
        }
    }
    return series;
}

/* ---- Tables ------------------------------------------------------------------------------------------------------ */

static bool PrintRates(void)
{
    static const char* const columns[] = { "scene       ",  "grid",        "frames",       "last",  "vertices",
                                           "last",          "before",      "cutting",      "after", "paper before",
                                           "paper cutting", "paper after", "times faster", NULL };
    static const int phases[3][2] = { { BEFORE, BEFORE }, { CUTTING, PAUSE }, { AFTER, AFTER } };
    Table table;
    if (!Table_Start(
            &table, "rates",
            "Table 1 of the paper: squares along the grid, frames and vertices, first and last, and the lowest rate, "
            "ticks a second\nbefore, while and after cutting; the paper's frames a second are of twelve cores of 2015. "
            "Aim: more of them.",
            columns)) {
        return false;
    }
    for (int s = 0; s < PAPERS; s++) {
        const Recording* r = &recordings[s];
        const kiriCounts *first = &r->facts[0].counts, *last = &r->facts[r->type->ticks - 1].counts;
        double rates[3];
        Table_Text(&table, r->paper->scene);
        const int32_t counts[] = { r->grid, first->frames, last->frames, first->vertices, last->vertices };
        for (int i = 0; i < 5; i++) {
            Table_Number(&table, counts[i]);
        }
        for (int i = 0; i < 3; i++) {
            Series series = TimesOf(r, INCREMENTAL, phases[i][0], phases[i][1], ALL);
            rates[i] = 1e3 / Series_Worst(&series);
            Series_Free(&series);
            Table_Judge(&table, rates[i], !(rates[i] < r->paper->rates[i]));
        }
        for (int i = 0; i < 3; i++) {
            Table_Number(&table, r->paper->rates[i]);
        }
        Table_Number(&table, rates[1] / r->paper->rates[1]);
    }
    return Table_Stop(&table);
}

/* The aim for the median of a quantity in a phase, or for the worst of it; infinite where there is none. */
static double AimOf(const Recording* recording, int phase, int quantity, bool worst)
{
    int32_t frames = recording->facts[phase == BEFORE ? 0 : recording->type->ticks - 1].counts.frames;
    bool plain = quantity == ALL && !worst && phase != CUTTING;
    return plain                                          ? 0.1 + 0.4 * (frames - 5) / 42.0
           : quantity == ALL && worst && phase == CUTTING ? 2.0
           : quantity == SEGMENT && !worst                ? 3.0
           : quantity == SYSTEMS                          ? (worst ? 4.0 : 2.5)
                                                          : (double)INFINITY;
}

/* Median and worst. */
static void PrintTimes(Table* table, const Recording* recording, int mode, int phase, int quantity)
{
    SCOPED_AS(Series, series, Series_Free) = TimesOf(recording, mode, phase, phase, quantity);
    double median = Series_Median(&series), worst = Series_Worst(&series);
    bool judged = mode == INCREMENTAL;
    Table_Judge(table, median, !judged || !(median > AimOf(recording, phase, quantity, false)));
    Table_Judge(table, worst, !judged || !(worst > AimOf(recording, phase, quantity, true)));
}

/* How many times longer a tick that cuts takes from scratch; NaN where that is nothing. */
static double RatioOf(const Recording* recording, int quantity)
{
    SCOPED(Series, ratios, Series_Free);
    for (int32_t i = 0; i < recording->type->ticks; i++) {
        double time = TimeOf(recording, INCREMENTAL, i, quantity);
        if (PhaseOf(recording, i) == CUTTING && time > 0.0) {
            Series_Add(&ratios, TimeOf(recording, SCRATCH, i, quantity) / time);
        }
    }
    double median = Series_Median(&ratios);
    return median;
}

static bool PrintStages(const Recording* recording)
{
    static const char* const columns[] = { "stage   ", "before",          "worst", "cutting", "worst", "scratch",
                                           "worst",    "scratch/cutting", "after", "worst",   NULL };
    char name[64], title[512];
    Table table;
    snprintf(name, sizeof name, "stages_%s", recording->paper->scene);
    snprintf(title, sizeof title,
             "%s: ms of a tick before, with and after cuts, median and worst; with cuts also from scratch. Commit: all "
             "from grid to\nconstants. Aims: from scratch a commit takes 10 times as long; the worst tick with a cut 2 "
             "ms, a tick without 0.1 ms\nwith 5 frames to 0.5 ms with 47; 3 us a cut segment; 2.5 systems a step, worst 4.",
             recording->paper->scene);
    if (!Table_Start(&table, name, title, columns)) {
        return false;
    }
    for (int k = 0; k < QUANTITIES; k++) {
        Table_Text(&table, k < KIRI_STAGE_COUNT ? kiriGetStageName(k) : quantityNames[k - KIRI_STAGE_COUNT]);
        PrintTimes(&table, recording, INCREMENTAL, BEFORE, k);
        PrintTimes(&table, recording, INCREMENTAL, CUTTING, k);
        PrintTimes(&table, recording, SCRATCH, CUTTING, k);
        double ratio = RatioOf(recording, k);
        Table_Judge(&table, ratio, k != COMMIT || ratio >= 10.0);
        PrintTimes(&table, recording, INCREMENTAL, AFTER, k);
    }
    return Table_Stop(&table);
}

/* The mean over the ticks with a cut. */
static void GetShares(const Recording* recording, double means[SHARES])
{
    for (int k = 0; k < SHARES; k++) {
        SCOPED(Series, series, Series_Free);
        for (int32_t i = 0; i < recording->type->ticks; i++) {
            if (PhaseOf(recording, i) == CUTTING) {
                Series_Add(&series, ShareOf(&recording->facts[i], k));
            }
        }
        means[k] = Series_Mean(&series);
    }
}

/* No more than the paper is the aim where it is `judged`. */
static void PrintShareRow(Table* table, const Paper* paper, const char* name, const double shares[SHARES], bool judged)
{
    Table_Text(table, paper->scene);
    Table_Text(table, name);
    for (int k = 0; k < SHARES; k++) {
        Table_Judge(table, shares[k], !judged || !(shares[k] > paper->shares[k]));
    }
    Table_Number(table, shares[WEIGHTS] / shares[CELLS]);
}

static bool PrintShares(void)
{
    static const char* const columns[] = {
        "scene       ", "pace                 ", "cells", "weights", "vertices", "points",
        "links",        "weights/cells",         NULL
    };
    Table table;
    if (!Table_Start(
            &table, "shares",
            "Table 2 of the paper: % of grid cells, shape functions at cells, vertices, collision points and "
            "links that a cut\nchanges: mean over the ticks with a cut; mean over all ticks from the first cut to the "
            "last, the blade so many times as fast\nand with a point in each of them; the paper. Links stand where the "
            "paper has integration points. Cells tell how far the\nblade goes in a tick: the last column has how many "
            "weights follow from one cell. Aim: at the paper's pace no more than the paper.",
            columns)) {
        return false;
    }
    for (int s = 0; s < PAPERS; s++) {
        const Paper* paper = recordings[s].paper;
        char pace[32];
        double shares[SHARES];
        GetShares(&recordings[s], shares);
        snprintf(pace, sizeof pace, "paper's: %.4g times", paper->pace);
        PrintShareRow(&table, paper, "as it is", shares, false);
        if (paper->pace > 0.0f) {
            PrintShareRow(&table, paper, pace, recordings[s].shares, true);
            PrintShareRow(&table, paper, "paper", paper->shares, false);
        }
    }
    return Table_Stop(&table);
}

int main(void)
{
    Bench_WeighClock();
    bool fine = true;
    for (int s = 0; fine && s < PAPERS; s++) {
        fine = RecordAll(&recordings[s], &papers[s]);
    }
    fine = fine && PrintRates();
    for (int s = 0; fine && s < PAPERS; s++) {
        fine = PrintStages(&recordings[s]);
    }
    fine = fine && PrintShares();
    return fine ? 0 : 1;
}
