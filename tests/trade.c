#define _POSIX_C_SOURCE 199309L /* clock_gettime */

#include "trade.h"

#include "plot.h"
#include "sweep.h"

#include <math.h>
#include <stdio.h>
#include <time.h>

enum { REPEATS = 5, MAX_CURVES = 16 };

static Setting settings[SWEEP_SETTINGS];
static Outcome outcomes[SWEEP_SETTINGS];
static int count;

static double Now(void* user)
{
    struct timespec now;
    (void)user;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* The shortest time of a few: others use the machine too. */
static bool Measure(void)
{
    count = Sweep_Settings(settings, false);
    for (int k = 0; k < REPEATS; ++k) {
        for (int i = 0; i < count; ++i) {
            Outcome now;
            if (!Sweep_Run(&settings[i], Now, &now)) {
                return false;
            }
            if (k > 0) {
                now.seconds = fmin(now.seconds, outcomes[i].seconds);
                now.create = fmin(now.create, outcomes[i].create);
            }
            outcomes[i] = now;
        }
    }
    return true;
}

/* How much the reference changes when one of its numbers is halved. */
static bool PrintReference(void)
{
    Setting halves[4];
    const char* names[] = { "half the substeps", "half the iterations", "half the grid", "half the frames" };
    for (int k = 0; k < 4; ++k) {
        Outcome outcome;
        halves[k] = sweepReference;
        halves[k].substeps /= k == 0 ? 2 : 1;
        halves[k].iterations /= k == 1 ? 2 : 1;
        halves[k].gridResolution /= k == 2 ? 2 : 1;
        halves[k].columns = k == 3 ? sweepReference.columns / 2 + 1 : sweepReference.columns;
        if (!Sweep_Run(&halves[k], NULL, &outcome)) {
            return false;
        }
        printf("reference, %-20s %8.4f %%\n", names[k], 100.0 * outcome.error);
    }
    return true;
}

static const char* PresetName(const Setting* setting)
{
    static const char* const names[KIRI_QUALITY_COUNT] = { "fast", "balanced", "accurate" };
    for (int32_t p = 0; p < KIRI_QUALITY_COUNT; ++p) {
        kiriQuality q;
        kiriGetQuality(p, &q);
        if (q.framesAlong == setting->columns && q.gridResolution == setting->gridResolution &&
            q.iterations == setting->iterations && q.substeps == setting->substeps &&
            setting->model == KIRI_MODEL_LINKS) {
            return names[p];
        }
    }
    return "";
}

static bool OnFront(int i)
{
    return Sweep_Dominating(settings, outcomes, count, &settings[i], &outcomes[i]) < 0;
}

static void PrintFront(void)
{
    printf("\n%6s %5s %10s %9s %11s %8s %10s %10s  preset\n", "frames", "grid", "iterations", "substeps", "error",
           "cost", "ms a tick", "ms create");
    for (int i = 0; i < count; ++i) {
        const Setting* s = &settings[i];
        const Outcome* o = &outcomes[i];
        if (OnFront(i)) {
            printf("%6d %5d %10d %9d %9.3f %% %8.1f %10.4f %10.2f  %s\n", s->columns * s->rows, s->gridResolution,
                   s->iterations, s->substeps, 100.0 * o->error, o->cost, 1e3 * o->seconds, 1e3 * o->create,
                   PresetName(s));
        }
    }
}

static bool WriteRows(const char* folder)
{
    char path[512];
    snprintf(path, sizeof path, "%s/trade.csv", folder);
    FILE* file = fopen(path, "w");
    if (file == NULL) {
        return false;
    }
    fprintf(file,
            "model,frames,grid,iterations,substeps,error,systems x frames a tick,ms a tick,ms create,front,preset\n");
    for (int i = 0; i < count; ++i) {
        const Setting* s = &settings[i];
        const Outcome* o = &outcomes[i];
        static const char* const models[] = { "links", "affine", "points" };
        fprintf(file, "%s,%d,%d,%d,%d,%.6g,%.6g,%.6g,%.6g,%d,%s\n", models[s->model], s->columns * s->rows,
                s->gridResolution, s->iterations, s->substeps, o->error, o->cost, 1e3 * o->seconds, 1e3 * o->create,
                OnFront(i) ? 1 : 0, PresetName(s));
    }
    return fclose(file) == 0;
}

/* ---- Plot ------------------------------------------------------------------------------------------------------- */

/* The settings of the pattern's model that agree with `pattern` where it is above 0. */
static Curve MakeCurve(const char* name, Setting pattern)
{
    Curve curve = { name, { 0.0 }, { 0.0 }, 0 };
    for (int i = 0; i < count && curve.count < CURVE_POINTS; ++i) {
        const Setting* s = &settings[i];
        if (s->model == pattern.model && (pattern.columns == 0 || s->columns == pattern.columns) &&
            (pattern.gridResolution == 0 || s->gridResolution == pattern.gridResolution) &&
            (pattern.iterations == 0 || s->iterations == pattern.iterations) &&
            (pattern.substeps == 0 || s->substeps == pattern.substeps)) {
            curve.x[curve.count] = 1e3 * outcomes[i].seconds;
            curve.y[curve.count++] = 100.0 * outcomes[i].error;
        }
    }
    return curve;
}

static bool WritePicture(const char* folder)
{
    static const char* const presets[KIRI_QUALITY_COUNT] = { "preset fast", "preset balanced", "preset accurate" };
    char path[512];
    Curve curves[MAX_CURVES];
    int drawn = 0;
    curves[drawn++] = MakeCurve("3 frames, substeps 1 to 16", (Setting){ 3, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS });
    curves[drawn++] = MakeCurve("5 frames, substeps 1 to 16", (Setting){ 5, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS });
    curves[drawn++] = MakeCurve("9 frames, substeps 1 to 16", (Setting){ 9, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS });
    curves[drawn++] = MakeCurve("17 frames, substeps 1 to 16", (Setting){ 17, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS });
    curves[drawn++] =
        MakeCurve("5 frames, 2 substeps, iterations 1 to 8", (Setting){ 5, 1, 40, 0, 2, 1, KIRI_MODEL_LINKS });
    curves[drawn++] =
        MakeCurve("9 frames, 8 substeps, iterations 1 to 8", (Setting){ 9, 1, 40, 0, 8, 1, KIRI_MODEL_LINKS });
    curves[drawn++] =
        MakeCurve("17 frames, 16 substeps, grid 20 to 80", (Setting){ 17, 1, 0, 1, 16, 1, KIRI_MODEL_LINKS });
    curves[drawn++] = MakeCurve("affine, 9 frames, 8 iterations", (Setting){ 9, 1, 40, 8, 0, 1, KIRI_MODEL_AFFINE });
    curves[drawn++] = MakeCurve("points, 9 frames, 8 iterations", (Setting){ 9, 1, 40, 8, 0, 1, KIRI_MODEL_POINTS });
    for (int32_t p = 0; p < KIRI_QUALITY_COUNT; ++p) {
        kiriQuality quality;
        kiriGetQuality(p, &quality);
        curves[drawn++] = MakeCurve(presets[p], Sweep_FromQuality(&quality));
    }
    snprintf(path, sizeof path, "%s/trade.png", folder);
    return Plot_Write(path, "ms a tick of 1/60 s, solve and skin",
                      "error, % of the way. grid 40, 1 iteration where the legend says no other", curves, drawn);
}

bool Trade_Write(const char* folder)
{
    printf("\nA strip that falls and swings, see tests/sweep.h\n");
    if (!Sweep_Prepare(&sweepReference) || !PrintReference() || !Measure()) {
        return false;
    }
    PrintFront();
    return WriteRows(folder) && WritePicture(folder);
}
