#include "trade.h"

#include "plot.h"
#include "specimen.h"
#include "sweep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_CURVES = 16 };

static Setting settings[SWEEP_SETTINGS];
static Outcome outcomes[SWEEP_SETTINGS];
static int count;

/* The shortest times of a few: others use the machine too. Settings that the library refuses are left out. */
static void Measure(int32_t scene)
{
    static Setting all[SWEEP_SETTINGS];
    int wanted = Sweep_Settings(scene, all, false), repeats = scene == SWEEP_STRIP ? 3 : 2;
    count = 0;
    for (int i = 0; i < wanted; ++i) {
        Outcome best, now;
        bool ran = Sweep_Run(&all[i], ProcessorTime, &best);
        for (int k = 1; k < repeats && ran; ++k) {
            ran = Sweep_Run(&all[i], ProcessorTime, &now);
            best.seconds = fmin(best.seconds, now.seconds);
            best.create = fmin(best.create, now.create);
            best.worst = fmin(best.worst, now.worst);
        }
        if (ran) {
            settings[count] = all[i];
            outcomes[count++] = best;
        }
    }
}

/* How much the reference changes when one of its numbers is halved. */
static bool PrintReference(int32_t scene)
{
    const char* names[] = { "half the substeps", "half the iterations", "half the grid", "half the frames" };
    for (int k = 0; k < 4; ++k) {
        Outcome outcome;
        Setting half = sweepReferences[scene];
        half.substeps /= k == 0 ? 2 : 1;
        half.iterations /= k == 1 ? 2 : 1;
        half.gridResolution /= k == 2 ? 2 : 1;
        half.columns = k == 3 ? half.columns / 2 + 1 : half.columns;
        half.rows = k == 3 ? half.rows / 2 + 1 : half.rows;
        if (!Sweep_Run(&half, NULL, &outcome)) {
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
        Setting preset = Sweep_FromQuality(setting->scene, &q);
        if (memcmp(&preset, setting, sizeof preset) == 0) {
            return names[p];
        }
    }
    return "";
}

static bool OnFront(int i)
{
    return Sweep_Dominating(settings, outcomes, count, &settings[i], &outcomes[i]) < 0;
}

/* The front, and the presets wherever they are. */
static void PrintFront(void)
{
    printf("\n%6s %5s %10s %9s %11s %8s %10s %10s %10s  preset\n", "frames", "grid", "iterations", "substeps", "error",
           "cost", "ms a tick", "worst", "ms create");
    for (int i = 0; i < count; ++i) {
        const Setting* s = &settings[i];
        const Outcome* o = &outcomes[i];
        const char* preset = PresetName(s);
        if (OnFront(i) || preset[0] != '\0') {
            printf("%6d %5d %10d %9d %9.3f %% %8.1f %10.4f %10.4f %10.2f  %s%s\n", s->columns * s->rows,
                   s->gridResolution, s->iterations, s->substeps, 100.0 * o->error, o->cost, 1e3 * o->seconds,
                   1e3 * o->worst, 1e3 * o->create, preset, OnFront(i) ? "" : ", dominated");
        }
    }
}

static void PrintRanges(int32_t scene)
{
    static const char* const names[KIRI_QUALITY_COUNT] = { "fast", "balanced", "accurate" };
    printf("\npresets on grids from 4/5 to 5/4 as fine, frames in rows, regular and moved, or spread by the library\n");
    for (int32_t p = 0; p < KIRI_QUALITY_COUNT; ++p) {
        kiriQuality q;
        kiriGetQuality(p, &q);
        Setting setting = Sweep_FromQuality(scene, &q);
        for (int spread = 0; spread < 2; ++spread) {
            double error[2];
            bool ran = Sweep_Range(&setting, spread != 0, error);
            printf("%-9s %4d frames %s, %3d squares, %2d substeps: ", names[p], setting.columns * setting.rows,
                   spread ? "spread" : "in rows", q.gridResolution, q.substeps);
            printf(ran ? "%7.3f to %7.3f %%\n" : "refused\n", 100.0 * error[0], 100.0 * error[1]);
        }
    }
}

static bool WriteRows(const char* folder, int32_t scene)
{
    static const char* const models[] = { "links", "affine", "points" };
    char path[512];
    snprintf(path, sizeof path, "%s/trade_%s.csv", folder, sweepNames[scene]);
    FILE* file = fopen(path, "w");
    if (file == NULL) {
        return false;
    }
    fprintf(file, "model,frames,grid,iterations,substeps,error,systems x frames a tick,ms a tick,ms worst tick,"
                  "ms create,front,preset\n");
    for (int i = 0; i < count; ++i) {
        const Setting* s = &settings[i];
        const Outcome* o = &outcomes[i];
        fprintf(file, "%s,%d,%d,%d,%d,%.6g,%.6g,%.6g,%.6g,%.6g,%d,%s\n", models[s->model], s->columns * s->rows,
                s->gridResolution, s->iterations, s->substeps, o->error, o->cost, 1e3 * o->seconds, 1e3 * o->worst,
                1e3 * o->create, OnFront(i) ? 1 : 0, PresetName(s));
    }
    return fclose(file) == 0;
}

/* ---- Plot ------------------------------------------------------------------------------------------------------- */

typedef struct Pattern {
    const char* name;
    Setting setting; /* 0: any */
} Pattern;

static bool Agrees(int32_t pattern, int32_t value)
{
    return pattern == 0 || pattern == value;
}

static Curve MakeCurve(const Pattern* pattern)
{
    Curve curve = { pattern->name, { 0.0 }, { 0.0 }, 0 };
    const Setting* p = &pattern->setting;
    for (int i = 0; i < count && curve.count < CURVE_POINTS; ++i) {
        const Setting* s = &settings[i];
        if (s->model == p->model && Agrees(p->columns, s->columns) && Agrees(p->gridResolution, s->gridResolution) &&
            Agrees(p->iterations, s->iterations) && Agrees(p->substeps, s->substeps)) {
            curve.x[curve.count] = 1e3 * outcomes[i].seconds;
            curve.y[curve.count++] = 100.0 * outcomes[i].error;
        }
    }
    return curve;
}

static const Pattern stripPatterns[] = {
    { "3 frames, substeps 1 to 16", { SWEEP_STRIP, 3, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "5 frames, substeps 1 to 16", { SWEEP_STRIP, 5, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "9 frames, substeps 1 to 16", { SWEEP_STRIP, 9, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "17 frames, substeps 1 to 16", { SWEEP_STRIP, 17, 1, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "9 frames, 2 substeps, iterations 1 to 8", { SWEEP_STRIP, 9, 1, 40, 0, 2, 1, KIRI_MODEL_LINKS, 0 } },
    { "17 frames, 8 substeps, grid 20 to 80", { SWEEP_STRIP, 17, 1, 0, 1, 8, 1, KIRI_MODEL_LINKS, 0 } },
    { "affine, 9 frames, 8 iterations", { SWEEP_STRIP, 9, 1, 40, 8, 0, 1, KIRI_MODEL_AFFINE, 0 } },
    { "points, 9 frames, 8 iterations", { SWEEP_STRIP, 9, 1, 40, 8, 0, 1, KIRI_MODEL_POINTS, 0 } },
    { NULL, { 0 } },
};

static const Pattern squarePatterns[] = {
    { "9 frames, substeps 1 to 16", { SWEEP_SQUARE, 3, 3, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "25 frames, substeps 1 to 16", { SWEEP_SQUARE, 5, 5, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "49 frames, substeps 1 to 16", { SWEEP_SQUARE, 7, 7, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "81 frames, substeps 1 to 16", { SWEEP_SQUARE, 9, 9, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "144 frames, substeps 1 to 16", { SWEEP_SQUARE, 12, 12, 40, 1, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "25 frames, 2 iterations", { SWEEP_SQUARE, 5, 5, 40, 2, 0, 1, KIRI_MODEL_LINKS, 0 } },
    { "81 frames, 4 substeps, grid 20 to 80", { SWEEP_SQUARE, 9, 9, 0, 1, 4, 1, KIRI_MODEL_LINKS, 0 } },
    { NULL, { 0 } },
};

static bool WritePicture(const char* folder, int32_t scene)
{
    static const char* const presets[KIRI_QUALITY_COUNT] = { "preset fast", "preset balanced", "preset accurate" };
    const Pattern* patterns = scene == SWEEP_STRIP ? stripPatterns : squarePatterns;
    char path[512], title[128];
    Curve curves[MAX_CURVES];
    int drawn = 0;
    for (int k = 0; patterns[k].name != NULL; ++k) {
        curves[drawn++] = MakeCurve(&patterns[k]);
    }
    for (int32_t p = 0; p < KIRI_QUALITY_COUNT; ++p) {
        kiriQuality quality;
        kiriGetQuality(p, &quality);
        Pattern pattern = { presets[p], Sweep_FromQuality(scene, &quality) };
        curves[drawn++] = MakeCurve(&pattern);
    }
    snprintf(path, sizeof path, "%s/trade_%s.png", folder, sweepNames[scene]);
    snprintf(title, sizeof title, "%s. error, %% of the way. grid 40, 1 iteration where the legend says no other",
             sweepNames[scene]);
    return Plot_Write(path, "ms a tick of 1/60 s, solve and skin", title, curves, drawn);
}

bool Trade_Write(const char* folder, int32_t scene)
{
    printf("\nThe %s that falls and swings, see tests/sweep.h\n", sweepNames[scene]);
    if (!Sweep_Prepare(&sweepReferences[scene]) || !PrintReference(scene)) {
        return false;
    }
    Measure(scene);
    PrintFront();
    PrintRanges(scene);
    return WriteRows(folder, scene) && WritePicture(folder, scene);
}
