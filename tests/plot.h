/* A plot of curves with two logarithmic axes, as a picture. */
#ifndef KIRI_TEST_PLOT_H
#define KIRI_TEST_PLOT_H

#include <stdbool.h>

enum { CURVE_POINTS = 16 };

typedef struct Curve {
    const char* name;
    double x[CURVE_POINTS], y[CURVE_POINTS]; /* above 0 */
    int count;
} Curve;

/* Letters a to z (capitals are drawn small), digits and . , % = / - are drawn; others are blanks. */
bool Plot_Write(const char* path, const char* xName, const char* yName, const Curve* curves, int curveCount);

#endif
