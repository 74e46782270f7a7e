#include "plot.h"

#include "image.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { WIDTH = 1000, HEIGHT = 640, LEFT = 80, RIGHT = 700, TOP = 30, BOTTOM = 580, DOT = 2 };

/* Three by five dots a letter: five octal digits, rows from the top. */
static const char SIGNS[] = "0123456789abcdefghijklmnopqrstuvwxyz.,%=/-";
static const int GLYPHS[] = { 075557, 026227, 071747, 071717, 055711, 074717, 074757, 071111, 075757, 075717, 025755,
                              065656, 034443, 065556, 074647, 074644, 034553, 055755, 072227, 011152, 055655, 044447,
                              057755, 065555, 025552, 065644, 025563, 065655, 034216, 072222, 055557, 055522, 055775,
                              055255, 055222, 071247, 000002, 000024, 051245, 007070, 011244, 000700 };
static const uint8_t COLOURS[][3] = { { 31, 119, 180 },  { 255, 127, 14 }, { 44, 160, 44 },   { 214, 39, 40 },
                                      { 148, 103, 189 }, { 140, 86, 75 },  { 227, 119, 194 }, { 127, 127, 127 },
                                      { 188, 189, 34 },  { 23, 190, 207 } };
static const uint8_t BLACK[3] = { 0, 0, 0 }, PALE[3] = { 220, 220, 220 };

/* Decades from low to high, drawn between two pixels. */
typedef struct Axis {
    double low, high, from, to;
} Axis;

static double Place(const Axis* axis, double value)
{
    return axis->from + (log10(value) - axis->low) / (axis->high - axis->low) * (axis->to - axis->from);
}

static void Fill(Image* image, int x, int y, int width, int height, const uint8_t* colour)
{
    for (int k = 0; k < width * height; ++k) {
        int column = x + k % width, row = y + k / width;
        if (column >= 0 && row >= 0 && column < image->width && row < image->height) {
            memcpy(image->rgb + 3 * (row * image->width + column), colour, 3);
        }
    }
}

static void Write(Image* image, int x, int y, const char* text, const uint8_t* colour)
{
    for (; *text != '\0'; ++text, x += 4 * DOT) {
        const char* sign = strchr(SIGNS, tolower((unsigned char)*text));
        for (int k = 0; sign != NULL && k < 15; ++k) {
            if (GLYPHS[sign - SIGNS] >> (14 - k) & 1) {
                Fill(image, x + k % 3 * DOT, y + k / 3 * DOT, DOT, DOT, colour);
            }
        }
    }
}

static void Line(Image* image, double x0, double y0, double x1, double y1, const uint8_t* colour)
{
    int steps = (int)fmax(fabs(x1 - x0), fabs(y1 - y0)) + 1;
    for (int k = 0; k <= steps; ++k) {
        double share = (double)k / steps;
        Fill(image, (int)(x0 + share * (x1 - x0)), (int)(y0 + share * (y1 - y0)), 2, 2, colour);
    }
}

static Axis AxisFor(const Curve* curves, int curveCount, bool isX, double from, double to)
{
    Axis axis = { HUGE_VAL, -HUGE_VAL, from, to };
    for (int c = 0; c < curveCount; ++c) {
        for (int k = 0; k < curves[c].count; ++k) {
            double decade = log10(isX ? curves[c].x[k] : curves[c].y[k]);
            axis.low = fmin(axis.low, floor(decade));
            axis.high = fmax(axis.high, floor(decade) + 1.0);
        }
    }
    return axis;
}

static void DrawGrid(Image* image, const Axis* axis, bool isX)
{
    for (int decade = (int)axis->low; decade <= (int)axis->high; ++decade) {
        for (int digit = 1; digit < (decade < (int)axis->high ? 10 : 2); ++digit) {
            int at = (int)Place(axis, digit * pow(10.0, decade));
            Fill(image, isX ? at : LEFT, isX ? TOP : at, isX ? 1 : RIGHT - LEFT, isX ? BOTTOM - TOP : 1,
                 digit == 1 ? BLACK : PALE);
            if (digit == 1) {
                char text[32];
                snprintf(text, sizeof text, "%g", pow(10.0, decade));
                Write(image, isX ? at - 8 : 10, isX ? BOTTOM + 10 : at - 5, text, BLACK);
            }
        }
    }
}

static void DrawCurve(Image* image, const Axis* x, const Axis* y, const Curve* curve, int number)
{
    const uint8_t* colour = COLOURS[number % (int)(sizeof COLOURS / sizeof COLOURS[0])];
    for (int k = 0; k < curve->count; ++k) {
        double px = Place(x, curve->x[k]), py = Place(y, curve->y[k]);
        Fill(image, (int)px - 3, (int)py - 3, 8, 8, colour);
        if (k > 0) {
            Line(image, Place(x, curve->x[k - 1]), Place(y, curve->y[k - 1]), px, py, colour);
        }
    }
    Fill(image, RIGHT + 20, TOP + 20 * number, 10, 10, colour);
    Write(image, RIGHT + 40, TOP + 20 * number, curve->name, BLACK);
}

bool Plot_Write(const char* path, const char* xName, const char* yName, const Curve* curves, int curveCount)
{
    Image image;
    if (!Image_Create(&image, WIDTH, HEIGHT)) {
        return false;
    }
    Axis x = AxisFor(curves, curveCount, true, LEFT, RIGHT), y = AxisFor(curves, curveCount, false, BOTTOM, TOP);
    DrawGrid(&image, &x, true);
    DrawGrid(&image, &y, false);
    for (int c = 0; c < curveCount; ++c) {
        DrawCurve(&image, &x, &y, &curves[c], c);
    }
    Write(&image, (LEFT + RIGHT) / 2 - 40, BOTTOM + 35, xName, BLACK);
    Write(&image, 10, 8, yName, BLACK);
    bool ok = Image_WritePng(&image, path);
    Image_Free(&image);
    return ok;
}
