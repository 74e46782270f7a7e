#include "frame_layout.h"

#include <math.h>
#include <stdbool.h>
#include <stdint.h>
#include <string.h>

const char* const layoutNames[LAYOUT_KINDS] = { "rows", "hexagons", "jittered", "Lloyd" };

enum { LLOYD_TURNS = 60, LLOYD_SAMPLES = 160 }; /* along the longer side */

typedef struct Box {
    double length, width;
    bool ends, sides; /* are there frames on the edges u = 0 and length, v = 0 and width, which stay there? */
} Box;

static void Add(Layout* layout, double u, double v)
{
    if (layout->count < MAX_FRAMES) {
        layout->points[2 * layout->count] = (float)u;
        layout->points[2 * layout->count++ + 1] = (float)v;
    }
}

/* Of `count` places from 0 to size, the k-th; k may be a half. */
static double PlaceAt(double size, double k, int count, bool toEdges)
{
    return size * (toEdges ? k / (count - 1) : (k + 0.5) / count);
}

static void AddRows(Layout* layout, const Box* box, int kind, int columns, int rows)
{
    for (int i = 0; i < columns; ++i) {
        double u = PlaceAt(box->length, i, columns, box->ends);
        bool shifted = kind == LAYOUT_HEXAGONS && i % 2 == 1;
        for (int edge = 0; shifted && box->sides && edge < 2; ++edge) {
            Add(layout, u, box->width * edge);
        }
        for (int j = 0; j < rows - (shifted ? 1 : 0); ++j) {
            Add(layout, u, PlaceAt(box->width, j + (shifted ? 0.5 : 0.0), rows, box->sides));
        }
    }
}

static bool Stays(const Box* box, const float* point)
{
    double u = (double)point[0], v = (double)point[1], near = 1e-6 * box->length;
    bool onEnd = u < near || u > box->length - near, onSide = v < near || v > box->width - near;
    return (box->ends && onEnd) || (box->sides && onSide);
}

/* -1 to 1; Numerical Recipes' "quick and dirty" generator. */
static double Random(uint32_t* seed)
{
    *seed = 1664525u * *seed + 1013904223u;
    return (double)(*seed >> 8) / (double)(1u << 23) - 1.0;
}

static void Jitter(Layout* layout, const Box* box, int columns, int rows)
{
    uint32_t seed = 12345u;
    double step[2] = { box->length / (box->ends ? columns - 1 : columns), box->width / (box->sides ? rows - 1 : rows) };
    for (int i = 0; i < layout->count; ++i) {
        for (int k = 0; k < 2 && !Stays(box, &layout->points[2 * i]); ++k) {
            double size = k == 0 ? box->length : box->width;
            double moved = (double)layout->points[2 * i + k] + 0.25 * step[k] * Random(&seed);
            layout->points[2 * i + k] = (float)fmin(fmax(moved, 0.05 * step[k]), size - 0.05 * step[k]);
        }
    }
}

static int Nearest(const Layout* layout, double u, double v)
{
    int nearest = 0;
    double least = 1e30;
    for (int i = 0; i < layout->count; ++i) {
        double du = u - (double)layout->points[2 * i], dv = v - (double)layout->points[2 * i + 1];
        if (du * du + dv * dv < least) {
            least = du * du + dv * dv;
            nearest = i;
        }
    }
    return nearest;
}

/* Each frame that may move goes to the centroid of its region. */
static void Relax(Layout* layout, const Box* box)
{
    static double sums[MAX_FRAMES][3];
    double side = fmax(box->length, box->width) / LLOYD_SAMPLES;
    int columns = (int)(box->length / side + 0.5), rows = (int)(box->width / side + 0.5);
    memset(sums, 0, sizeof sums);
    for (int k = 0; k < columns * rows; ++k) {
        double u = box->length * (k % columns + 0.5) / columns, v = box->width * ((double)(k / columns) + 0.5) / rows;
        double* sum = sums[Nearest(layout, u, v)];
        sum[0] += u;
        sum[1] += v;
        sum[2] += 1.0;
    }
    for (int i = 0; i < layout->count; ++i) {
        for (int k = 0; k < 2 && sums[i][2] > 0.0 && !Stays(box, &layout->points[2 * i]); ++k) {
            layout->points[2 * i + k] = (float)(sums[i][k] / sums[i][2]);
        }
    }
}

static void Make(Layout* layout, const Box* box, int kind, int columns, int rows)
{
    layout->count = 0;
    AddRows(layout, box, kind, columns, rows);
    if (kind == LAYOUT_JITTERED || kind == LAYOUT_LLOYD) {
        Jitter(layout, box, columns, rows);
    }
    for (int turn = 0; kind == LAYOUT_LLOYD && turn < LLOYD_TURNS; ++turn) {
        Relax(layout, box);
    }
}

void Layout_Make(Layout* layout, int kind, double length, double width, int columns, int rows)
{
    Box box = { length, width, false, false };
    Make(layout, &box, kind, columns, rows);
}

void Layout_MakeToEnds(Layout* layout, int kind, double length, double width, int columns, int rows)
{
    Box box = { length, width, true, false };
    Make(layout, &box, kind, columns, rows);
}

void Layout_MakeFramed(Layout* layout, int kind, double length, double width, int columns, int rows)
{
    Box box = { length, width, true, true };
    Make(layout, &box, kind, columns, rows);
}
