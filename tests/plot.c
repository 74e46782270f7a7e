#include "plot.h"

#include "image.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    WIDTH = 1440,
    HEIGHT = 760,
    LEFT = 110,
    RIGHT = 880,
    TOP = 60,
    BOTTOM = 670,
    DOT = 3,
    LETTER = 4 * DOT,
    HALF = 5 * DOT / 2
};

/* Three by five dots a letter: five octal digits, rows from the top. */
static const char SIGNS[] = "0123456789abcdefghijklmnopqrstuvwxyz.,%=/-";
static const int GLYPHS[] = { 075557, 026227, 071747, 071717, 055711, 074717, 074757, 071111, 075757, 075717, 025755,
                              065656, 034443, 065556, 074647, 074644, 034553, 055755, 072227, 011152, 055655, 044447,
                              057755, 065555, 025552, 065644, 025563, 065655, 034216, 072222, 055557, 055522, 055775,
                              055255, 055222, 071247, 000002, 000024, 051245, 007070, 011244, 000700 };
static const uint8_t COLOURS[][3] = { { 31, 119, 180 },  { 255, 127, 14 }, { 44, 160, 44 },   { 214, 39, 40 },
                                      { 148, 103, 189 }, { 140, 86, 75 },  { 227, 119, 194 }, { 127, 127, 127 },
                                      { 188, 189, 34 },  { 23, 190, 207 } };
static const uint8_t BLACK[3] = { 0, 0, 0 }, GREY[3] = { 130, 130, 130 }, PALE[3] = { 220, 220, 220 };

/* Logarithms from low to high, drawn between two pixels. */
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
    for (; *text != '\0'; ++text, x += LETTER) {
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

/* The nearest 1, 2 or 5 in a decade that is not above `decade`. */
static double RoundDown(double decade)
{
    double whole = floor(decade + 1e-9), part = decade + 1e-9 - whole;
    return whole + (part < log10(2.0) ? 0.0 : part < log10(5.0) ? log10(2.0) : log10(5.0));
}

static Axis AxisFor(const Curve* curves, int curveCount, bool isX, double from, double to)
{
    Axis axis = { HUGE_VAL, -HUGE_VAL, from, to };
    for (int c = 0; c < curveCount; ++c) {
        for (int k = 0; k < curves[c].count; ++k) {
            double decade = log10(isX ? curves[c].x[k] : curves[c].y[k]);
            axis.low = fmin(axis.low, RoundDown(decade));
            axis.high = fmax(axis.high, -RoundDown(-decade));
        }
    }
    return axis;
}

static void DrawTick(Image* image, const Axis* axis, bool isX, int decade, int digit)
{
    double value = digit * pow(10.0, decade);
    int at = (int)Place(axis, value);
    Fill(image, isX ? at : LEFT, isX ? TOP : at, isX ? 1 : RIGHT - LEFT, isX ? BOTTOM - TOP : 1,
         digit == 1 ? GREY : PALE);
    if (digit == 1 || ((digit == 2 || digit == 5) && axis->high - axis->low < 3.0)) {
        char text[32];
        int length = snprintf(text, sizeof text, "%g", value) * LETTER;
        Write(image, isX ? at - length / 2 : LEFT - 10 - length, isX ? BOTTOM + 12 : at - HALF, text, BLACK);
    }
}

static void DrawGrid(Image* image, const Axis* axis, bool isX)
{
    for (int decade = (int)floor(axis->low); decade <= (int)ceil(axis->high); ++decade) {
        for (int digit = 1; digit < 10; ++digit) {
            double at = log10(digit) + decade;
            if (at > axis->low - 1e-6 && at < axis->high + 1e-6) {
                DrawTick(image, axis, isX, decade, digit);
            }
        }
    }
}

/* A point alone is a ring, to be seen around the point of another curve. */
static void DrawPoint(Image* image, int x, int y, bool alone, const uint8_t* colour)
{
    int size = alone ? 20 : 8, edge = alone ? 3 : 4;
    for (int k = 0; k < 2; ++k) {
        int off = k * (size - edge) - size / 2;
        Fill(image, x - size / 2, y + off, size, edge, colour);
        Fill(image, x + off, y - size / 2, edge, size, colour);
    }
}

static void DrawCurve(Image* image, const Axis* x, const Axis* y, const Curve* curve, int number)
{
    const uint8_t* colour = COLOURS[number % (int)(sizeof COLOURS / sizeof COLOURS[0])];
    int row = TOP + 10 + 34 * number;
    for (int k = 0; k < curve->count; ++k) {
        double px = Place(x, curve->x[k]), py = Place(y, curve->y[k]);
        DrawPoint(image, (int)px, (int)py, curve->count == 1, colour);
        if (k > 0) {
            Line(image, Place(x, curve->x[k - 1]), Place(y, curve->y[k - 1]), px, py, colour);
        }
    }
    DrawPoint(image, RIGHT + 30, row, curve->count == 1, colour);
    Write(image, RIGHT + 50, row - HALF, curve->name, BLACK);
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
    Write(&image, (LEFT + RIGHT - LETTER * (int)strlen(xName)) / 2, BOTTOM + 48, xName, BLACK);
    Write(&image, 10, 18, yName, BLACK);
    bool ok = Image_WritePng(&image, path);
    Image_Free(&image);
    return ok;
}
