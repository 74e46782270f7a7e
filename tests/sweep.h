/* Speed for accuracy: scenes that move, at many settings, each compared with the same scene computed much finer.

   All are of stiff paper, level at first, and let go: they fall and swing for 0.4 s at 60 ticks a second. The strip is
   0.2 m x 0.05 m, clamped along u = 0, with one row of frames. The square has sides of 0.2 m, bends five times as
   easily, hangs by two corners, and has as many rows as columns. */
#ifndef KIRI_TEST_SWEEP_H
#define KIRI_TEST_SWEEP_H

#include "kiri/kiri.h"

#include <stdbool.h>

enum { SWEEP_TICKS = 24, SWEEP_SETTINGS = 120 };

enum SweepScene { SWEEP_STRIP, SWEEP_SQUARE, SWEEP_SCENES };

typedef struct Setting {
    int32_t scene;         /* SWEEP_... */
    int32_t columns, rows; /* of frames, along u and v */
    int32_t gridResolution, iterations, substeps;
    int32_t moved; /* 0: frames in regular rows; else moved at random by up to a tenth of the spacing (a single row only
                      along itself), from this seed */
} Setting;

typedef struct Outcome {
    /* rms |x - x_ref| by rms |x_ref - (u, v, 0)| over all vertices (the mesh is the same at all settings) and ticks */
    double error;
    double cost; /* linear systems a tick, times frames: counted, the same on all machines */
} Outcome;

/* Settings of the strip. Returns how many. */
int Sweep_Settings(Setting settings[SWEEP_SETTINGS]);

/* A preset in a scene: a strip has framesAlong frames, a square half as many, rounded up, in either direction. */
Setting Sweep_FromQuality(int32_t scene, const kiriQuality* quality);

/* What all later runs of a scene are compared with. */
bool Sweep_Prepare(const Setting* setting);

bool Sweep_Run(const Setting* setting, Outcome* outcome);

/* Another setting of the same scene with a smaller error at no more cost, and a grid as coarse; or -1. The grid costs
   little but at cuts, so a finer one is not for free. */
int Sweep_Dominating(const Setting* settings, const Outcome* outcomes, int count, const Setting* setting,
                     const Outcome* outcome);

/* The least and the most error of a setting on grids from 4/5 to 5/4 as fine, frames in rows, regular and moved at
   random: a lucky grid does not help. False where one of them is refused. */
bool Sweep_Range(const Setting* setting, double error[2]);

#endif
