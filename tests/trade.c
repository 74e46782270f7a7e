#include "trade.h"

#include "specimen.h"
#include "sweep.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

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

bool Trade_Write(const char* folder, int32_t scene)
{
    printf("\nThe %s that falls and swings, see tests/sweep.h\n", sweepNames[scene]);
    if (!Sweep_Prepare(&sweepReferences[scene]) || !PrintReference(scene)) {
        return false;
    }
    Measure(scene);
    PrintFront();
    PrintRanges(scene);
    return WriteRows(folder, scene);
}
