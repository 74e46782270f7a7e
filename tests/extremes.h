/* The extremes: a table of cases that push a sheet as far as the public header allows, each run with and without
   damping, and what came of it. `make extremes` prints the table; test_extremes.c asserts on a part of it. */
#ifndef KIRI_TEST_EXTREMES_H
#define KIRI_TEST_EXTREMES_H

#include "kiri/kiri.h"

#include <stdbool.h>

typedef struct Trial Trial;

/* Zero means the usual value, which is in brackets. Lengths and speeds are metric, but for the thinness. */
typedef struct Extreme {
    const char* name;
    void (*script)(Trial* trial); /* what the host does before each tick */
    double size;                  /* of the square [1] */
    double thinness;              /* thickness over size [1e-3] */
    double modulus, density;      /* [1e9 Pa, 700 kg/m^3] */
    double dt, gravity;           /* [1/60 s, none] */
    double rest, place;           /* how far from the origin of the rest plane, of the world [0] */
    double speed;                 /* [0] */
    int frames, grid;             /* [9, 16] */
    int iterations, substeps;     /* [2, 1] */
    int cause, ticks;             /* for so many ticks the cause works [30]; so many in all [600] */
    double calm;   /* share of its largest elastic energy at which the sheet has recovered [1e-3]; 1: not asked */
    double gain;   /* the energy that a tick may gain, see Outcome [1e-6] */
    bool resample; /* add frames where the sheet is rigid */
    bool full;     /* too long for the test */
} Extreme;

typedef struct Outcome {
    bool finite;
    const char* failed; /* a call that did not return KIRI_OK, or null */
    double gain; /* the largest gain of energy in a tick: over the energy before the tick and the work of gravity; what
                    the rounding of positions leaves unknown of both is taken off, and what earlier ticks lost */
    int gainTick;
    int recovered;  /* ticks after the cause, with damping; -1: never */
    double elastic; /* energy at the end, over its largest */
    double shape;   /* at the end: rms distance of the frames from a rigid placement, over the size; -1: in pieces */
    double spacing; /* between the floats that positions are read in, over the size */
    int frames;     /* at the end */
    int solved;     /* the most linear systems in a tick */
} Outcome;

extern const Extreme extremes[];
extern const int extremeCount;

Outcome Extreme_Run(const Extreme* extreme);

/* A case of the table with other sizes, materials and steps. It asks for no recovery. */
Extreme Extreme_Random(uint32_t* seed);

/* What the case asks for. */
double Extreme_Calm(const Extreme* extreme);
double Extreme_Gain(const Extreme* extreme);

#endif
