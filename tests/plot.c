#include "plot.h"

#include "image.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Pixels: a plot with its legend beside it, and panels of a page. */
enum { WIDTH = 1440, HEIGHT = 760, PANEL_WIDTH = 330, PANEL_HEIGHT = 250, GAP = 14 };

/* Where curves are drawn, in pixels, and the size of letters. */
typedef struct Area {
    int left, right, top, bottom;
    int dot; /* of which letters are made, 4 x 5 with their gap */
} Area;

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
    double share = (log10(value) - axis->low) / (axis->high - axis->low);
    return axis->from + fmin(fmax(share, 0.0), 1.0) * (axis->to - axis->from);
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

static void Write(Image* image, int dot, int x, int y, const char* text)
{
    for (; *text != '\0'; ++text, x += 4 * dot) {
        const char* sign = strchr(SIGNS, tolower((unsigned char)*text));
        for (int k = 0; sign != NULL && k < 15; ++k) {
            if (GLYPHS[sign - SIGNS] >> (14 - k) & 1) {
                Fill(image, x + k % 3 * dot, y + k / 3 * dot, dot, dot, BLACK);
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

/* A line at a number, with the number if there is room. */
static void DrawTick(Image* image, const Area* area, const Axis* axis, bool isX, bool isNamed, int decade, int digit)
{
    double value = digit * pow(10.0, decade);
    int at = (int)Place(axis, value), width = area->right - area->left, height = area->bottom - area->top;
    Fill(image, isX ? at : area->left, isX ? area->top : at, isX ? 1 : width, isX ? height : 1,
         digit == 1 ? GREY : PALE);
    if (isNamed && (digit == 1 || ((digit == 2 || digit == 5) && axis->high - axis->low < 3.0))) {
        char text[32];
        int length = snprintf(text, sizeof text, "%g", value) * 4 * area->dot;
        Write(image, area->dot, isX ? at - length / 2 : area->left - 10 - length,
              isX ? area->bottom + 12 : at - 5 * area->dot / 2, text);
    }
}

static void DrawGrid(Image* image, const Area* area, const Axis* axis, bool isX, bool isNamed)
{
    for (int decade = (int)floor(axis->low); decade <= (int)ceil(axis->high); ++decade) {
        for (int digit = 1; digit < 10; ++digit) {
            double at = log10(digit) + decade;
            if (at > axis->low - 1e-6 && at < axis->high + 1e-6) {
                DrawTick(image, area, axis, isX, isNamed, decade, digit);
            }
        }
    }
}

/* A point alone is a ring, to be seen around the point of another curve. */
static void DrawPoint(Image* image, int dot, int x, int y, bool alone, const uint8_t* colour)
{
    int size = (alone ? 20 : 8) * dot / 3, edge = alone ? 3 : size / 2;
    for (int k = 0; k < 2; ++k) {
        int off = k * (size - edge) - size / 2;
        Fill(image, x - size / 2, y + off, size, edge, colour);
        Fill(image, x + off, y - size / 2, edge, size, colour);
    }
}

static const uint8_t* ColourOf(int curve)
{
    return COLOURS[curve % (int)(sizeof COLOURS / sizeof COLOURS[0])];
}

static void DrawCurve(Image* image, int dot, const Axis* x, const Axis* y, const Curve* curve, const uint8_t* colour)
{
    for (int k = 0; k < curve->count; ++k) {
        double px = Place(x, curve->x[k]), py = Place(y, curve->y[k]);
        DrawPoint(image, dot, (int)px, (int)py, curve->count == 1, colour);
        if (k > 0) {
            Line(image, Place(x, curve->x[k - 1]), Place(y, curve->y[k - 1]), px, py, colour);
        }
    }
}

/* Returns where it ends. */
static int DrawName(Image* image, int dot, int x, int y, const Curve* curve, const uint8_t* colour)
{
    DrawPoint(image, dot, x, y, curve->count == 1, colour);
    Write(image, dot, x + 20, y - 5 * dot / 2, curve->name);
    return x + 50 + 4 * dot * (int)strlen(curve->name);
}

bool Plot_Write(const char* path, const char* xName, const char* yName, const Curve* curves, int curveCount)
{
    static const Area area = { 110, 880, 60, 670, 3 };
    Image image;
    if (!Image_Create(&image, WIDTH, HEIGHT)) {
        return false;
    }
    Axis x = AxisFor(curves, curveCount, true, area.left, area.right);
    Axis y = AxisFor(curves, curveCount, false, area.bottom, area.top);
    DrawGrid(&image, &area, &x, true, true);
    DrawGrid(&image, &area, &y, false, true);
    for (int c = 0; c < curveCount; ++c) {
        DrawCurve(&image, area.dot, &x, &y, &curves[c], ColourOf(c));
        DrawName(&image, area.dot, area.right + 30, area.top + 10 + 34 * c, &curves[c], ColourOf(c));
    }
    Write(&image, area.dot, (area.left + area.right - 12 * (int)strlen(xName)) / 2, area.bottom + 48, xName);
    Write(&image, area.dot, 10, 18, yName);
    bool ok = Image_WritePng(&image, path);
    Image_Free(&image);
    return ok;
}

static void DrawPanel(Image* image, const Area* area, const Panel* panel, const double xs[2], const double ys[2],
                      bool isNamed[2])
{
    Axis x = { log10(xs[0]), log10(xs[1]), area->left, area->right };
    Axis y = { log10(ys[0]), log10(ys[1]), area->bottom, area->top };
    int noise = (int)Place(&y, panel->noise);
    Fill(image, area->left, noise, area->right - area->left, area->bottom - noise, PALE);
    DrawGrid(image, area, &x, true, isNamed[0]);
    DrawGrid(image, area, &y, false, isNamed[1]);
    for (int c = 0; c < panel->curveCount; ++c) {
        DrawCurve(image, area->dot, &x, &y, &panel->curves[c], ColourOf(c));
    }
    Write(image, area->dot, area->left + 4, area->top - 6 * area->dot, panel->title);
}

bool Plot_WritePage(const char* path, const char* xName, const char* yName, const Panel* panels, int columns, int rows,
                    const double x[2], const double y[2])
{
    Area area = { 0, 0, 0, 0, 2 };
    Image image;
    int left = 60, top = 60, legend = left + 220;
    if (!Image_Create(&image, left + columns * PANEL_WIDTH, top + rows * PANEL_HEIGHT + 50)) {
        return false;
    }
    for (int p = 0; p < columns * rows; ++p) {
        bool isNamed[2] = { p / columns == rows - 1, p % columns == 0 };
        area.left = left + p % columns * PANEL_WIDTH;
        area.top = top + p / columns * PANEL_HEIGHT;
        area.right = area.left + PANEL_WIDTH - GAP;
        area.bottom = area.top + PANEL_HEIGHT - 2 * GAP;
        DrawPanel(&image, &area, &panels[p], x, y, isNamed);
    }
    for (int c = 0; c < panels[0].curveCount; ++c) {
        legend = DrawName(&image, area.dot, legend, 18, &panels[0].curves[c], ColourOf(c));
    }
    Write(&image, area.dot, 10, 13, yName);
    Write(&image, area.dot, (image.width - 8 * (int)strlen(xName)) / 2, image.height - 18, xName);
    bool ok = Image_WritePng(&image, path);
    Image_Free(&image);
    return ok;
}
