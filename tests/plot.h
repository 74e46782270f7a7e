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

/* Curves with axes of their own. Values below `noise` are grey. */
typedef struct Panel {
    const char* title;
    const Curve* curves;
    int curveCount;
    double noise;
} Panel;

/* A page of panels with the same axes, from x[0] to x[1] and y[0] to y[1], rows from the top; points beyond lie on the
   border. The first panel has the legend. */
bool Plot_WritePage(const char* path, const char* xName, const char* yName, const Panel* panels, int columns, int rows,
                    const double x[2], const double y[2]);

#endif
