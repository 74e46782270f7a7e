/* Where a sheet under its own weight should be, from other methods: the heavy elastica and shell elements. */
#ifndef KIRI_TEST_REFERENCE_H
#define KIRI_TEST_REFERENCE_H

#include <stdbool.h>

/* ---- Elastica --------------------------------------------------------------------------------------------------- */

enum { ELASTICA_STEPS = 8192 };

/* A strip of length 1, clamped level at s = 0: its height below the clamp and its way out. */
typedef struct Elastica {
    double x[ELASTICA_STEPS + 1], drop[ELASTICA_STEPS + 1];
} Elastica;

/* gamma = weight * length^2 / bending stiffness, 1e-4 to 1e5. */
void Elastica_Solve(Elastica* elastica, double gamma);
void Elastica_At(const Elastica* elastica, double s, double* x, double* drop);

/* ---- Shell ------------------------------------------------------------------------------------------------------ */

enum { SHELL_NODES = 2048 };

typedef struct ShellNode {
    double rest[2], position[3], side[2]; /* side: mean centre of the elements at the node */
} ShellNode;

typedef struct Shell {
    ShellNode nodes[SHELL_NODES];
    int count;
    const float* slit; /* polyline, 2 floats a point, or null */
    int slitPoints;
} Shell;

bool Shell_Read(Shell* shell, const char* path, const float* slit, int slitPoints);

/* The position of a rest point, by a quadratic fitted to the nodes around it that lie on its side of the slit. `side`
   is a point near `rest` and off the slit. */
void Shell_At(const Shell* shell, const double rest[2], const double side[2], double position[3]);

#endif
