/* What Kiri is measured against: a sheet of squares, with springs along edges and diagonals and springs against
   bending, solved as extended position based dynamics does it (Macklin et al., Small Steps in Physics Simulation, 2019: one
   iteration in each of many substeps). */
#ifndef KIRI_TEST_SPRINGS_H
#define KIRI_TEST_SPRINGS_H

#include "scoped.h"

#include <stdbool.h>
#include <stdint.h>

/* Squares of a sheet. Lips of slits have vertices of their own. */
typedef struct Lattice {
    int columns, rows;
    double side, origin; /* m; origin: u of the first column */
    int* corners;        /* 4 vertices a square, counter-clockwise from its least u and v; -1: no square */
    float* rest;         /* 2 floats (u, v) a vertex */
    int32_t* triangles;  /* 2 a square */
    int vertexCount, triangleCount;
} Lattice;

typedef struct LatticeDef {
    double length, width, side; /* m; whole numbers of squares */
    double disc, hole;          /* m: squares farther from the middle, or nearer, are left out; disc 0: none is */
    const double (*slit)[2];    /* points of a polyline along edges of squares, m */
    int slitPoints;
    int ghosts; /* columns beyond u = 0, to be fixed there: a clamp */
} LatticeDef;

bool Lattice_Make(Lattice* lattice, const LatticeDef* def);
void Lattice_Free(Lattice* lattice);

typedef struct SpringMaterial {
    double stretch, bending; /* N/m: Young's modulus times thickness; N m */
    double compression;      /* stiffness of edges and diagonals that are too short, relative to long ones */
    double mass, damping;    /* kg/m^2; 1/s: velocities fade as exp(-damping t) */
} SpringMaterial;

typedef struct Springs Springs;

/* Null without memory. fixed: one a vertex. The sheet is level: (u, v, 0); gravity is along z. */
Springs* Springs_Create(const Lattice* lattice, const SpringMaterial* material, const bool* fixed);
void Springs_Destroy(Springs* springs);
void Springs_Tick(Springs* springs, double seconds, int substeps);
double* Springs_GetPositions(Springs* springs);  /* 3 a vertex; the positions of fixed vertices may be changed */
double Springs_GetSpeed(const Springs* springs); /* m/s, rms */

#endif
