/* One adversary of the budget: a world, work that the host asks for, and what the ticks cost until all of it is done.
   It runs in a process of its own, which is ended when it has used up its time; what it has measured so far stays. It
   runs three times: a machine that does other work disturbs each tick in some run, but seldom in all. */
#ifndef KIRI_ADVERSARY_H
#define KIRI_ADVERSARY_H

#include "bench.h"

#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

enum { TRIANGLES, CELLS, SAMPLES, ITERATIONS, KINDS };
enum { MOST_TICKS = 20000, PLAIN_TICKS = 9, TICKS_AFTER = 2, STAGE_OTHER = KIRI_STAGE_COUNT };

typedef struct Adversary Adversary;

/* Where it takes place. */
typedef struct Bed {
    const Adversary* adversary;
    kiriWorld* world;
    kiriSheet* sheets;
    int32_t count;
    kiriFrame corner;  /* of the piece that is to be detached */
    kiriFrame leaving; /* of a piece that is to become a sheet, and is none yet; or 0 */
} Bed;

struct Adversary {
    const char* name;
    int32_t squares, grid, frames;
    int32_t sheets;  /* 0: one */
    int32_t actions; /* each when nothing waits any more; 0: one */
    bool (*act)(Bed* bed, int32_t action);
    bool (*prepare)(Bed* bed);                  /* before there is a budget; or null */
    bool (*build)(Bed* bed, kiriSheetDef* def); /* null: squares of one metre */
    bool asleep;
    int32_t cells;   /* its own budget of cells; 0: that of all */
    int32_t seconds; /* that it may take; 0: 20 */
};

typedef struct Course {
    int32_t count;
    double create, plain; /* ms */
    float times[MOST_TICKS];
    int32_t stages[MOST_TICKS];    /* which took longest */
    bool waits[MOST_TICKS];        /* work, after the tick */
    int32_t most[KINDS];           /* items in a tick */
    double item[KIRI_STAGE_COUNT]; /* us an item where it was worst, of stages that most of a tick went to; or 0 */
    double seconds[KIRI_STAGE_COUNT], items[KIRI_STAGE_COUNT]; /* of ticks that a stage did most in */
    double started;                                            /* the tick that is under way */
    bool done, fine;
} Course;

static inline int32_t KindOf(int32_t stage)
{
    static const int32_t kinds[KIRI_STAGE_COUNT] = { TRIANGLES, CELLS, CELLS,      CELLS, SAMPLES,
                                                     SAMPLES,   KINDS, ITERATIONS, KINDS };
    return kinds[stage];
}

static inline void ItemsOf(const kiriProfile* profile, int32_t items[KINDS])
{
    items[TRIANGLES] = profile->trianglesSplit;
    items[CELLS] = profile->cellsSettled;
    items[SAMPLES] = profile->samplesRefreshed;
    items[ITERATIONS] = profile->solverIterations;
}

/* ---- The bed ---- */

static inline bool Bed_AddSheets(Bed* bed)
{
    const Adversary* a = bed->adversary;
    bool fine = true;
    for (int32_t i = 0; fine && i < bed->count; i++) {
        kiriSheetDef def = DefaultSheet();
        def.position[1] = 2.0f * (float)i;
        def.gridResolution = a->grid;
        def.frameCount = a->frames;
        def.maxFrames = 100000;
        def.rigidArea = 1.0f;
        def.sleepSpeed = a->asleep ? def.sleepSpeed : 0.0f;
        fine = a->build != NULL ? a->build(bed, &def) : Bench_AddSheet(bed->world, &def, a->squares, &bed->sheets[i]);
    }
    return fine;
}

static inline bool Bed_Start(Bed* bed, const Adversary* adversary)
{
    static const float none[3] = { 0.0f, 0.0f, 0.0f };
    kiriWorldDef def = Bench_WorldDef();
    *bed = (Bed){ .adversary = adversary, .count = adversary->sheets > 0 ? adversary->sheets : 1 };
    bed->sheets = calloc((size_t)bed->count, sizeof(kiriSheet));
    return bed->sheets != NULL && kiriCreateWorld(&def, &bed->world) == KIRI_OK &&
           (!adversary->asleep || kiriWorld_SetGravity(bed->world, none) == KIRI_OK) && Bed_AddSheets(bed);
}

static inline void Bed_Stop(Bed* bed)
{
    kiriDestroyWorld(bed->world);
    free(bed->sheets);
}

static inline bool Bed_Tick(Bed* bed)
{
    return kiriWorld_Tick(bed->world, 1.0f / 60.0f, 2) >= 0;
}

/* Whether work waits for the next tick. */
static inline bool Bed_IsBehind(Bed* bed)
{
    const kiriEvent* events;
    int32_t count = 0;
    bool behind = false;
    kiriWorld_GetEvents(bed->world, &events, &count);
    for (int32_t i = 0; i < count; i++) {
        behind = behind || events[i].type == KIRI_EVENT_DEFERRED;
        bed->leaving = events[i].type == KIRI_EVENT_PIECE_DETACHED ? 0 : bed->leaving;
    }
    return behind || bed->leaving != 0;
}

static inline bool Bed_Finish(Bed* bed)
{
    bool fine = Bed_Tick(bed);
    while (fine && Bed_IsBehind(bed)) {
        fine = Bed_Tick(bed);
    }
    return fine;
}

/* ---- The course ---- */

/* Adds what a stage took to all that it takes: in ticks in which it did most of the work on cuts, for kinds are of
   several. */
static inline void Course_NotePaces(Course* course, const kiriProfile* profile, const int32_t items[KINDS])
{
    double ofCuts = 0.0;
    for (int32_t k = 0; k <= KIRI_STAGE_CONSTANTS; k++) {
        ofCuts += profile->seconds[k];
    }
    for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
        if (KindOf(k) == ITERATIONS || (k <= KIRI_STAGE_CONSTANTS && profile->seconds[k] > 0.7 * ofCuts)) {
            course->seconds[k] += profile->seconds[k];
            course->items[k] += items[KindOf(k)];
        }
    }
}

static inline void Course_NoteStages(Course* course, const kiriProfile* profile, double seconds)
{
    int32_t items[KINDS], longest = STAGE_OTHER;
    double sum = 0.0, counted = 0.0, most = 0.0;
    ItemsOf(profile, items);
    for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
        sum += profile->seconds[k];
        counted += KindOf(k) < KINDS ? profile->seconds[k] : 0.0;
        longest = profile->seconds[k] > most ? k : longest;
        most = profile->seconds[longest < STAGE_OTHER ? longest : 0];
    }
    course->stages[course->count] = seconds - sum > most ? STAGE_OTHER : longest;
    for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
        if (KindOf(k) < KINDS && profile->seconds[k] > 0.7 * counted && profile->seconds[k] > 5e-4) {
            double item = 1e6 * profile->seconds[k] / (items[KindOf(k)] > 0 ? items[KindOf(k)] : 1);
            course->item[k] = item > course->item[k] ? item : course->item[k];
        }
    }
    Course_NotePaces(course, profile, items);
    for (int32_t k = 0; k < KINDS; k++) {
        course->most[k] = items[k] > course->most[k] ? items[k] : course->most[k];
    }
}

/* A tick that began at `start`, with what the host asked for before it. */
static inline bool Course_Tick(Course* course, Bed* bed, double start)
{
    kiriProfile profile;
    course->started = start;
    bool fine = course->count < MOST_TICKS && Bed_Tick(bed);
    double seconds = Bench_Clock(NULL) - start;
    fine = fine && kiriWorld_GetProfile(bed->world, &profile) == KIRI_OK;
    if (fine) {
        Course_NoteStages(course, &profile, seconds);
        course->times[course->count] = (float)(1e3 * seconds);
        course->waits[course->count++] = Bed_IsBehind(bed);
    }
    return fine;
}

static inline bool Course_Act(Course* course, Bed* bed, int32_t action)
{
    double start = Bench_Clock(NULL);
    course->started = start;
    bool fine = bed->adversary->act(bed, action) && Course_Tick(course, bed, start);
    while (fine && course->waits[course->count - 1]) {
        fine = Course_Tick(course, bed, Bench_Clock(NULL));
    }
    for (int32_t i = 0; fine && i < TICKS_AFTER; i++) {
        fine = Course_Tick(course, bed, Bench_Clock(NULL));
    }
    return fine;
}

/* Of a tick before the host asks for anything; a sheet that is to sleep does so after 30. */
static inline bool Course_MeasurePlain(Course* course, Bed* bed)
{
    Series series = { .number = NULL };
    bool fine = true;
    for (int32_t i = bed->adversary->asleep ? -40 : -2; fine && i < PLAIN_TICKS; i++) {
        double start = Bench_Clock(NULL);
        fine = Bed_Tick(bed);
        if (i >= 0) {
            Series_Add(&series, 1e3 * (Bench_Clock(NULL) - start));
        }
    }
    course->plain = Series_Median(&series);
    Series_Free(&series);
    return fine;
}

static inline void LimitTime(int32_t seconds)
{
    rlim_t end = (rlim_t)(Bench_Clock(NULL) + seconds + 1);
    setrlimit(RLIMIT_CPU, &(struct rlimit){ end, end });
}

static inline bool Course_Run(Course* course, const Adversary* adversary, const kiriBudget* budget)
{
    Bed bed;
    kiriBudget own = *budget;
    own.cells = adversary->cells > 0 ? adversary->cells : own.cells;
    double start = Bench_Clock(NULL);
    bool fine = Bed_Start(&bed, adversary);
    course->create = 1e3 * (Bench_Clock(NULL) - start);
    fine = fine && (adversary->prepare == NULL || adversary->prepare(&bed)) && Course_MeasurePlain(course, &bed) &&
           kiriWorld_SetBudget(bed.world, &own) == KIRI_OK;
    LimitTime(adversary->seconds > 0 ? adversary->seconds : 20);
    for (int32_t i = 0; fine && i < (adversary->actions > 0 ? adversary->actions : 1); i++) {
        fine = Course_Act(course, &bed, i);
    }
    course->done = fine;
    Bed_Stop(&bed);
    return fine;
}

/* Runs it in a process of its own. Where that is ended, the tick under way counts with the time it has taken. */
static inline void Course_RunOnce(Course* course, const Adversary* adversary, const kiriBudget* budget)
{
    struct rusage usage;
    int status = 0;
    fflush(NULL);
    pid_t child = fork();
    if (child == 0) {
        course->fine = Course_Run(course, adversary, budget);
        _exit(0);
    }
    if (child > 0 && wait4(child, &status, 0, &usage) == child && WIFSIGNALED(status) && course->count < MOST_TICKS) {
        double used = (double)usage.ru_utime.tv_sec + (double)usage.ru_stime.tv_sec;
        course->fine = WTERMSIG(status) == SIGKILL && course->started > 0.0;
        course->times[course->count] = (float)(1e3 * (used - course->started));
        course->stages[course->count] = STAGE_OTHER;
        course->waits[course->count++] = true;
    }
}

/* The same ticks again do the same: each is taken from the run in which it was disturbed least. */
static inline void Course_TakeLess(Course* course, const Course* again)
{
    int32_t count = again->count < course->count ? again->count : course->count;
    course->plain = again->plain < course->plain ? again->plain : course->plain;
    course->create = again->create < course->create ? again->create : course->create;
    for (int32_t i = 0; i < count; i++) {
        bool isLess = again->times[i] < course->times[i];
        course->times[i] = isLess ? again->times[i] : course->times[i];
        course->stages[i] = isLess ? again->stages[i] : course->stages[i];
    }
    for (int32_t k = 0; k < KIRI_STAGE_COUNT; k++) {
        course->item[k] = again->item[k] < course->item[k] ? again->item[k] : course->item[k];
    }
    course->fine = course->fine && again->fine;
}

enum { RUNS = 3 };

/* `shared` is memory that a process and its children see. */
static inline void Course_RunApart(Course* course, Course* shared, const Adversary* adversary, const kiriBudget* budget)
{
    for (int run = 0; run < RUNS; run++) {
        memset(shared, 0, sizeof *shared);
        Course_RunOnce(shared, adversary, budget);
        if (run == 0) {
            *course = *shared;
        } else {
            Course_TakeLess(course, shared);
        }
    }
}

#endif
