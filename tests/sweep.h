/* Speed for accuracy: scenes that move, at many settings, each compared with the same scene computed much finer.

   All are of stiff paper, level at first, and let go: they fall and swing for 0.4 s at 60 ticks a second. The strip is
   0.2 m x 0.05 m, clamped along u = 0, with one row of frames. The square has sides of 0.2 m, bends five times as
   easily, hangs by two corners, and has as many rows as columns. The tongue is a square of 0.1 m, clamped along u = 0,
   into which an L is cut while it falls. */
#ifndef KIRI_TEST_SWEEP_H
#define KIRI_TEST_SWEEP_H

#include "kiri/kiri.h"

#include <stdbool.h>

enum { SWEEP_TICKS = 24, SWEEP_SETTINGS = 320 };

enum SweepScene { SWEEP_STRIP, SWEEP_SQUARE, SWEEP_TONGUE, SWEEP_SCENES };

typedef struct Setting {
    int32_t scene;         /* SWEEP_... */
    int32_t columns, rows; /* of frames, along u and v */
    int32_t gridResolution, iterations, substeps;
    int32_t parts;  /* calls of kiriWorld_Tick a sixtieth of a second; 1 but for the reference */
    int32_t model;  /* KIRI_MODEL_... */
    int32_t spread; /* 0: frames in regular rows; 1: where the library puts as many; more: rows, moved at random by up
                       to a tenth of the spacing (a single row only along itself), from this seed */
} Setting;

typedef struct Outcome {
    /* rms |x - x_ref| by rms |x_ref - (u, v, 0)| over all vertices (the mesh is the same at all settings) and ticks */
    double error;
    /* linear systems a tick, times frames, times 8 where a frame has 12 unknowns and not 6: counted, the same on all
       machines */
    double cost;
    double seconds; /* solve and skin, a tick; 0 without a clock */
    double create;  /* seconds of kiriCreateSheet: all of grid, regions and weights; 0 without a clock */
    double worst;   /* seconds of the longest tick, all of it; 0 without a clock */
} Outcome;

extern const char* const sweepNames[SWEEP_SCENES];

/* Settings of a scene for a table; `thin`: fewer, of the default model, for a test. Returns how many. */
int Sweep_Settings(int32_t scene, Setting settings[SWEEP_SETTINGS], bool thin);

/* A preset in a scene: a strip has framesAlong frames, a square half as many, rounded up, in either direction. */
Setting Sweep_FromQuality(int32_t scene, const kiriQuality* quality);

/* What all later runs of a scene are compared with. */
extern const Setting sweepReferences[SWEEP_SCENES];
bool Sweep_Prepare(const Setting* setting);

bool Sweep_Run(const Setting* setting, kiriClockFn* clock, Outcome* outcome);

/* Another setting of the same scene with a smaller error at no more cost, and a grid as coarse; or -1. The grid costs
   little but at cuts, so a finer one is not for free. */
int Sweep_Dominating(const Setting* settings, const Outcome* outcomes, int count, const Setting* setting,
                     const Outcome* outcome);

/* The least and the most error of a setting on grids from 4/5 to 5/4 as fine, frames where the library spreads them, or
   in rows, regular and moved at random: no figure is that of one lucky grid. False where one of them is refused. */
bool Sweep_Range(const Setting* setting, bool spread, double error[2]);

#endif
