/* Speed for accuracy: one scene that moves, at many settings, each compared with the same scene computed much finer.

   A strip of stiff paper, 0.2 m x 0.05 m, held along u = 0 by its first frames and level at first, is let go: it falls
   and swings for 0.4 s at 60 ticks a second. */
#ifndef KIRI_TEST_SWEEP_H
#define KIRI_TEST_SWEEP_H

#include "kiri/kiri.h"

#include <stdbool.h>

enum { SWEEP_TICKS = 24, SWEEP_SETTINGS = 320 };

typedef struct Setting {
    int32_t columns, rows; /* of frames, along and across the strip */
    int32_t gridResolution, iterations, substeps;
    int32_t parts; /* calls of kiriWorld_Tick a sixtieth of a second; 1 but for the reference */
    int32_t model; /* KIRI_MODEL_... */
} Setting;

typedef struct Outcome {
    /* rms |x - x_ref| by rms |x_ref - (u, v, 0)| over all vertices (the mesh is the same at all settings) and ticks */
    double error;
    /* linear systems a tick, times frames, times 8 where a frame has 12 unknowns and not 6: counted, the same on all
       machines */
    double cost;
    double seconds; /* solve and skin, a tick; 0 without a clock */
    double create;  /* seconds of kiriCreateSheet: all of grid, regions and weights; 0 without a clock */
} Outcome;

/* Settings for a table; `thin`: the quicker half, of the default model, for a test. Returns how many. */
int Sweep_Settings(Setting settings[SWEEP_SETTINGS], bool thin);

/* A preset in this scene. */
Setting Sweep_FromQuality(const kiriQuality* quality);

/* What all later runs are compared with. */
extern const Setting sweepReference;
bool Sweep_Prepare(const Setting* setting);

bool Sweep_Run(const Setting* setting, kiriClockFn* clock, Outcome* outcome);

/* Another setting with a smaller error at no more cost, and a grid as coarse; or -1. The grid costs nothing in this
   scene but at every cut, so a finer grid is not for free. */
int Sweep_Dominating(const Setting* settings, const Outcome* outcomes, int count, const Setting* setting,
                     const Outcome* outcome);

#endif
