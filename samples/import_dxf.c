/* DXF as text: lines, polylines with bulges, arcs, circles, ellipses, splines, and blocks that are inserted. */
#include "import_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { MOST_LAYERS = 256, MOST_INSERTS = 12, MOST_CODES = 80, MOST_KNOTS = 4096, MOST_ORDER = 12 };

typedef struct Pair {
    int code;
    Span value;
} Pair;

typedef struct Layer {
    Span name;
    int color, rgb; /* color below 0: off; rgb -1: none */
    bool isHidden;
    int dashes;
} Layer;

typedef struct Block {
    Span name;
    int32_t first, end; /* pairs of its entities */
    double base[2];
} Block;

typedef struct Dxf {
    Import* drawing;
    Pair* pairs;
    Block* blocks;
    int32_t pairCount, pairCapacity, blockCount, blockCapacity;
    Layer layers[MOST_LAYERS];
    int32_t layerCount, inserts;
} Dxf;

static Span TrimSpaces(Span span)
{
    while (span.length > 0 && (span.at[0] == ' ' || span.at[0] == '\t')) {
        span.at++;
        span.length--;
    }
    while (span.length > 0 && (span.at[span.length - 1] == ' ' || span.at[span.length - 1] == '\r')) {
        span.length--;
    }
    return span;
}

static const char* ReadLine(const char* at, const char* end, Span* line)
{
    const char* stop = memchr(at, '\n', (size_t)(end - at));
    stop = stop != NULL ? stop : end;
    *line = TrimSpaces((Span){ at, (int32_t)(stop - at) });
    return stop < end ? stop + 1 : end;
}

static bool ReadPairs(Dxf* dxf, const char* at, const char* end)
{
    while (at < end) {
        Span code;
        Pair pair = { 0, { at, 0 } };
        double number = 0.0;
        at = ReadLine(at, end, &code);
        at = ReadLine(at, end, &pair.value);
        if (Import_ReadNumber(code.at, code.at + code.length, &number) == NULL || number < -10.0 || number > 1100.0) {
            if (code.length == 0 && at == end) {
                break;
            }
            Import_Fail(dxf->drawing, "this is no DXF: line %d is not a group code", 2 * dxf->pairCount + 1);
            return false;
        }
        pair.code = (int)number;
        if (!Import_Reserve((void**)&dxf->pairs, &dxf->pairCapacity, dxf->pairCount, sizeof(Pair))) {
            Import_Fail(dxf->drawing, "there is no memory for the drawing");
            return false;
        }
        dxf->pairs[dxf->pairCount++] = pair;
    }
    return true;
}

/* The pair with a code from `first` up to the next entity; null: none. */
static const Pair* FindPair(const Dxf* dxf, int32_t first, int code)
{
    for (int32_t i = first; i < dxf->pairCount && dxf->pairs[i].code != 0; i++) {
        if (dxf->pairs[i].code == code) {
            return &dxf->pairs[i];
        }
    }
    return NULL;
}

static double NumberOf(const Pair* pair, double otherwise)
{
    double number = otherwise;
    return pair != NULL && Import_ReadNumber(pair->value.at, pair->value.at + pair->value.length, &number) != NULL
               ? number
               : otherwise;
}

static double GetNumber(const Dxf* dxf, int32_t first, int code, double otherwise)
{
    return NumberOf(FindPair(dxf, first, code), otherwise);
}

static Span GetText(const Dxf* dxf, int32_t first, int code)
{
    const Pair* pair = FindPair(dxf, first, code);
    return pair != NULL ? pair->value : (Span){ NULL, 0 };
}

static bool IsBegin(const Pair* pair, const char* name)
{
    return pair->code == 0 && Span_Is(pair->value, name);
}

/* ---- Tables ---- */

static double GetUnits(int code)
{
    static const double sizes[] = { 1.0,     25.4,    304.8, 1609344.0, 1.0,  10.0, 1000.0, 1e6,
                                    25.4e-6, 25.4e-3, 914.4, 1e-7,      1e-6, 1e-3, 100.0 };
    return code >= 0 && code < (int)(sizeof sizes / sizeof sizes[0]) ? sizes[code] : 1.0;
}

/* 1: dashed; 2: dashes and dots. */
static int GetDashes(Span type)
{
    static const char *const mixed[] = { "dashdot", "dash dot", "dash-dot", "center", "divide", "phantom" },
                             *const plain[] = { "dash", "hidden", "dot" };
    for (size_t i = 0; type.length > 0 && i < sizeof mixed / sizeof mixed[0]; i++) {
        if (Span_Holds(type, mixed[i])) {
            return 2;
        }
    }
    return type.length > 0 && (Span_Holds(type, plain[0]) || Span_Holds(type, plain[1]) || Span_Holds(type, plain[2]));
}

static void ReadTables(Dxf* dxf)
{
    for (int32_t i = 0; i < dxf->pairCount; i++) {
        const Pair* pair = &dxf->pairs[i];
        if (pair->code == 9 && Span_Is(pair->value, "$INSUNITS") && i + 1 < dxf->pairCount) {
            int units = (int)NumberOf(&dxf->pairs[i + 1], 0.0);
            dxf->drawing->scale = GetUnits(units);
            dxf->drawing->isSized = units != 0;
        } else if (IsBegin(pair, "LAYER") && dxf->layerCount < MOST_LAYERS) {
            Layer layer = { GetText(dxf, i + 1, 2), (int)GetNumber(dxf, i + 1, 62, 7.0),
                            (int)GetNumber(dxf, i + 1, 420, -1.0), false, GetDashes(GetText(dxf, i + 1, 6)) };
            layer.isHidden = layer.color < 0 || ((int)GetNumber(dxf, i + 1, 70, 0.0) & 1) != 0;
            dxf->layers[dxf->layerCount++] = layer;
        } else if (IsBegin(pair, "BLOCK")) {
            Block block = {
                GetText(dxf, i + 1, 2), i + 1, i + 1, { GetNumber(dxf, i + 1, 10, 0.0), GetNumber(dxf, i + 1, 20, 0.0) }
            };
            while (block.end < dxf->pairCount && !IsBegin(&dxf->pairs[block.end], "ENDBLK")) {
                block.end++;
            }
            if (!Import_Reserve((void**)&dxf->blocks, &dxf->blockCapacity, dxf->blockCount, sizeof(Block))) {
                Import_Fail(dxf->drawing, "there is no memory for the drawing");
                return;
            }
            dxf->blocks[dxf->blockCount++] = block;
            i = block.end;
        }
    }
}

static const Layer* FindLayer(const Dxf* dxf, Span name)
{
    for (int32_t i = 0; i < dxf->layerCount; i++) {
        if (dxf->layers[i].name.length == name.length && name.length > 0 &&
            memcmp(dxf->layers[i].name.at, name.at, (size_t)name.length) == 0) {
            return &dxf->layers[i];
        }
    }
    return NULL;
}

/* Of 24 bits, or by AutoCAD's number: 1 red, 3 green, 5 blue; from 10 to 249 hues, ten numbers for each 15 degrees. */
static int32_t UseOfColor(int color, int rgb)
{
    if (rgb >= 0) { /* white is the pen of a black screen */
        int32_t use = Import_UseOfColor((const int[]){ rgb >> 16 & 255, rgb >> 8 & 255, rgb & 255 });
        return use != IMPORT_NONE ? use : IMPORT_CUT;
    }
    int hue = color >= 10 && color < 250 ? color / 10 - 1 : -1;
    return color == 1 || hue == 0 || hue == 23     ? IMPORT_MOUNTAIN
           : color == 5 || (hue >= 15 && hue < 18) ? IMPORT_VALLEY
           : color == 3 || (hue >= 7 && hue < 10)  ? IMPORT_SCORE
                                                   : IMPORT_CUT;
}

/* False: the entity is not seen. A layer's name wins over colours and dashes. */
static bool ChooseStyle(Dxf* dxf, int32_t first, int32_t* style)
{
    static const char* const kinds[] = { "", " dashed", " dash-dot" };
    Span name = GetText(dxf, first, 8), type = GetText(dxf, first, 6);
    const Layer* layer = FindLayer(dxf, name);
    int color = (int)GetNumber(dxf, first, 62, 256.0), rgb = (int)GetNumber(dxf, first, 420, -1.0);
    if ((layer != NULL && layer->isHidden) || color < 0 || GetNumber(dxf, first, 60, 0.0) != 0.0) {
        Import_Skip(dxf->drawing, "hidden");
        return false;
    }
    if (rgb < 0 && (color == 256 || color == 0)) {
        color = layer != NULL ? layer->color : 7;
        rgb = layer != NULL ? layer->rgb : -1;
    }
    int dashes = type.at != NULL && !Span_Holds(type, "bylayer") ? GetDashes(type) : layer != NULL ? layer->dashes : 0;
    int32_t use = UseOfColor(color, rgb), named = Import_GetUse(name);
    use = named >= 0 ? named : use == IMPORT_CUT && dashes > 0 ? dashes == 2 ? IMPORT_MOUNTAIN : IMPORT_VALLEY : use;
    char text[IMPORT_TEXT], number[16];
    snprintf(number, sizeof number, rgb >= 0 ? "#%06x" : "%d", rgb >= 0 ? (unsigned)rgb & 0xffffff : (unsigned)color);
    snprintf(text, sizeof text, "layer %.*s, colour %s%s", (int)(name.length < 20 ? name.length : 20),
             name.at != NULL ? name.at : "", number, kinds[dashes]);
    *style = Import_AddStyle(dxf->drawing, text, use);
    return true;
}

/* ---- Entities ---- */

static void AddAffine(Dxf* dxf, Affine a, double x, double y)
{
    Import_Add(dxf->drawing, a.m[0] * x + a.m[2] * y + a.m[4], a.m[1] * x + a.m[3] * y + a.m[5]);
}

static void DrawEllipseArc(Dxf* dxf, Affine affine, int32_t style, const double center[2], const double radii[2],
                           double from, double sweep)
{
    bool isWhole = fabs(sweep) > 2.0 * PI - 1e-9;
    Import_Begin(dxf->drawing, style);
    AddAffine(dxf, affine, center[0] + radii[0] * cos(from), center[1] + radii[1] * sin(from));
    Import_AddEllipse(dxf->drawing, affine, center, radii, from, sweep);
    if (isWhole && dxf->drawing->error[0] == 0) { /* ends exactly where it began */
        ImportLine* line = &dxf->drawing->lines[dxf->drawing->lineCount];
        dxf->drawing->pointCount -= line->count > 1;
        line->count -= line->count > 1;
    }
    Import_End(dxf->drawing, isWhole);
}

/* An arc between two corners: the bulge is the tangent of a quarter of its angle. */
static void AddBulge(Dxf* dxf, Affine affine, const double a[2], const double b[2], double bulge)
{
    double chord = hypot(b[0] - a[0], b[1] - a[1]);
    if (bulge != 0.0 && chord > 0.0) {
        double up = (1.0 - bulge * bulge) / (4.0 * bulge), radius = 0.25 * chord * fabs(bulge + 1.0 / bulge);
        double center[2] = { 0.5 * (a[0] + b[0]) - up * (b[1] - a[1]), 0.5 * (a[1] + b[1]) + up * (b[0] - a[0]) };
        Import_AddEllipse(dxf->drawing, affine, center, (const double[]){ radius, radius },
                          atan2(a[1] - center[1], a[0] - center[0]), 4.0 * atan(bulge));
        ImportLine* line = dxf->drawing->error[0] == 0 ? &dxf->drawing->lines[dxf->drawing->lineCount] : NULL;
        if (line != NULL && line->count > 1) {
            dxf->drawing->pointCount--;
            line->count--;
        }
    }
    AddAffine(dxf, affine, b[0], b[1]);
}

typedef struct Corner {
    double at[2], bulge;
} Corner;

static void DrawCorners(Dxf* dxf, Affine affine, int32_t style, const Corner* corners, int32_t count, bool isClosed)
{
    if (count < 2) {
        return;
    }
    Import_Begin(dxf->drawing, style);
    AddAffine(dxf, affine, corners[0].at[0], corners[0].at[1]);
    for (int32_t i = 0; i + (isClosed ? 0 : 1) < count && dxf->drawing->error[0] == 0; i++) {
        AddBulge(dxf, affine, corners[i].at, corners[(i + 1) % count].at, corners[i].bulge);
    }
    Import_End(dxf->drawing, isClosed);
}

/* LWPOLYLINE, or POLYLINE with VERTEX entities up to SEQEND. Returns the pair after it. */
static int32_t DrawPolyline(Dxf* dxf, Affine affine, int32_t first, int32_t style, bool isSeen, bool isLight)
{
    Corner* corners = NULL;
    int32_t count = 0, capacity = 0, flags = (int32_t)GetNumber(dxf, first, 70, 0.0), i = first;
    bool isVertex = isLight;
    for (; i < dxf->pairCount; i++) {
        const Pair* pair = &dxf->pairs[i];
        if (pair->code == 0) {
            if (isLight || !(Span_Is(pair->value, "VERTEX") || Span_Is(pair->value, "SEQEND"))) {
                break;
            }
            isVertex = Span_Is(pair->value, "VERTEX");
            if (isVertex && ((int)GetNumber(dxf, i + 1, 70, 0.0) & 16) != 0) { /* control point of a spline */
                isVertex = false;
            }
        } else if (pair->code == 10 && isVertex) {
            if (!Import_Reserve((void**)&corners, &capacity, count, sizeof(Corner))) {
                Import_Fail(dxf->drawing, "there is no memory for the drawing");
                break;
            }
            corners[count++] = (Corner){ { NumberOf(pair, 0.0), 0.0 }, 0.0 };
        } else if (pair->code == 20 && isVertex && count > 0) {
            corners[count - 1].at[1] = NumberOf(pair, 0.0);
        } else if (pair->code == 42 && isVertex && count > 0) {
            corners[count - 1].bulge = NumberOf(pair, 0.0);
        }
    }
    if (!isLight && (flags & 0x50) != 0) {
        Import_Skip(dxf->drawing, "mesh");
    } else if (isSeen) {
        DrawCorners(dxf, affine, style, corners, count, (flags & 1) != 0);
    }
    free(corners);
    return i;
}

/* The point of a rational B-spline, by de Boor's algorithm. points: x w, y w, w. */
static void EvaluateSpline(const double (*points)[3], const double* knots, int order, int span, double t, double at[2])
{
    double d[MOST_ORDER][3];
    int degree = order - 1;
    for (int j = 0; j <= degree; j++) {
        memcpy(d[j], points[j + span - degree], sizeof d[j]);
    }
    for (int r = 1; r <= degree; r++) {
        for (int j = degree; j >= r; j--) {
            double low = knots[j + span - degree], high = knots[j + 1 + span - r];
            double part = high > low ? (t - low) / (high - low) : 0.0;
            for (int k = 0; k < 3; k++) {
                d[j][k] += (1.0 - part) * (d[j - 1][k] - d[j][k]);
            }
        }
    }
    at[0] = d[degree][0] / d[degree][2];
    at[1] = d[degree][1] / d[degree][2];
}

/* The slope of a curve through points for a mm of way; at an open end it bends no more. */
static void FindSlope(const double (*points)[3], int count, int i, bool isClosed, double slope[2])
{
    int before = i > 0 ? i - 1 : isClosed ? count - 1 : -1, after = i + 1 < count ? i + 1 : isClosed ? 0 : -1;
    for (int k = 0; k < 2; k++) {
        const double *a = points[before >= 0 ? before : i], *p = points[i], *b = points[after >= 0 ? after : i];
        double ap = hypot(p[0] - a[0], p[1] - a[1]), pb = hypot(b[0] - p[0], b[1] - p[1]);
        slope[k] = before < 0  ? (b[k] - p[k]) / pb
                   : after < 0 ? (p[k] - a[k]) / ap
                               : ((p[k] - a[k]) / ap * pb + (b[k] - p[k]) / pb * ap) / (ap + pb);
    }
}

/* A smooth line through the points of a spline that has no others. */
static void DrawThrough(Dxf* dxf, Affine affine, const double (*points)[3], int count, int32_t style, bool isClosed)
{
    Import_Begin(dxf->drawing, style);
    AddAffine(dxf, affine, points[0][0], points[0][1]);
    for (int i = 0; i + !isClosed < count; i++) {
        const double *p = points[i], *q = points[(i + 1) % count];
        double slopes[2][2], bezier[4][2], third = hypot(q[0] - p[0], q[1] - p[1]) / 3.0;
        FindSlope(points, count, i, isClosed, slopes[0]);
        FindSlope(points, count, (i + 1) % count, isClosed, slopes[1]);
        for (int k = 0; k < 2; k++) {
            bezier[0][k] = p[k];
            bezier[1][k] = p[k] + third * slopes[0][k];
            bezier[2][k] = q[k] - third * slopes[1][k];
            bezier[3][k] = q[k];
        }
        Import_AddBezier(dxf->drawing, affine, (const double(*)[2])bezier, 3);
    }
    Import_End(dxf->drawing, isClosed);
}

static void DrawSpline(Dxf* dxf, Affine affine, int32_t first, int32_t style)
{
    double *knots = malloc(2 * sizeof(double) * MOST_KNOTS), *weights = knots + MOST_KNOTS;
    double(*points)[3] = malloc(2 * sizeof(double[3]) * MOST_KNOTS), (*fits)[3] = points + MOST_KNOTS;
    int degree = (int)GetNumber(dxf, first, 71, 3.0), knotCount = 0, count = 0, weightCount = 0, fitCount = 0;
    bool isClosed = ((int)GetNumber(dxf, first, 70, 0.0) & 1) != 0;
    for (int32_t i = first; knots != NULL && points != NULL && i < dxf->pairCount && dxf->pairs[i].code != 0; i++) {
        double number = NumberOf(&dxf->pairs[i], 0.0);
        if (dxf->pairs[i].code == 40 && knotCount < MOST_KNOTS) {
            knots[knotCount++] = number;
        } else if (dxf->pairs[i].code == 10 && count < MOST_KNOTS) {
            points[count][0] = number;
            points[count][1] = 0.0;
            points[count++][2] = 1.0;
        } else if (dxf->pairs[i].code == 20 && count > 0) {
            points[count - 1][1] = number;
        } else if (dxf->pairs[i].code == 41 && weightCount < MOST_KNOTS) {
            weights[weightCount++] = number;
        } else if (dxf->pairs[i].code == 11 && fitCount < MOST_KNOTS) {
            fits[fitCount][1] = 0.0;
            fits[fitCount++][0] = number;
        } else if (dxf->pairs[i].code == 21 && fitCount > 0) {
            fits[fitCount - 1][1] = number;
            bool isDouble = fitCount > 1 && memcmp(fits[fitCount - 1], fits[fitCount - 2], sizeof(double[2])) == 0;
            fitCount -= isDouble;
        }
    }
    bool isFine = knots != NULL && points != NULL && degree >= 1 && degree < MOST_ORDER && count > degree &&
                  knotCount == count + degree + 1;
    for (int i = 1; i < knotCount && isFine; i++) {
        isFine = knots[i] >= knots[i - 1];
    }
    for (int i = 0; i < count && isFine; i++) {
        points[i][2] = weightCount == count && weights[i] > 0.0 ? weights[i] : 1.0;
        points[i][0] *= points[i][2];
        points[i][1] *= points[i][2];
    }
    if (!isFine && fitCount > 1 + isClosed) {
        bool isDouble = memcmp(fits[0], fits[fitCount - 1], sizeof(double[2])) == 0;
        DrawThrough(dxf, affine, (const double(*)[3])fits, fitCount - (isDouble && isClosed), style, isClosed);
    } else if (!isFine) {
        Import_Skip(dxf->drawing, "spline without knots");
    } else {
        Import_Begin(dxf->drawing, style);
        for (int span = degree; span < count; span++) {
            double bend = 0.0, at[2];
            if (!(knots[span + 1] > knots[span])) {
                continue;
            }
            for (int j = span - degree; j + 2 <= span; j++) { /* of the control polygon */
                double x = points[j][0] / points[j][2] - 2.0 * points[j + 1][0] / points[j + 1][2] +
                           points[j + 2][0] / points[j + 2][2];
                double y = points[j][1] / points[j][2] - 2.0 * points[j + 1][1] / points[j + 1][2] +
                           points[j + 2][1] / points[j + 2][2];
                bend = fmax(bend, hypot(x, y));
            }
            double steps = ceil(sqrt(degree * degree * bend * dxf->drawing->scale / (4.0 * dxf->drawing->tolerance)));
            int most = steps < 10000.0 ? (int)fmax(steps, 1.0) : 10000;
            for (int i = span == degree ? 0 : 1; i <= most; i++) {
                double t = knots[span] + (knots[span + 1] - knots[span]) * i / most;
                EvaluateSpline((const double(*)[3])points, knots, degree + 1, span, t, at);
                AddAffine(dxf, affine, at[0], at[1]);
            }
        }
        Import_End(dxf->drawing, isClosed);
    }
    free(knots);
    free(points);
}

static void DrawEntities(Dxf* dxf, int32_t first, int32_t end, Affine affine);

static void DrawInsert(Dxf* dxf, Affine affine, int32_t first)
{
    Span name = GetText(dxf, first, 2);
    const Block* block = NULL;
    for (int32_t i = 0; i < dxf->blockCount && block == NULL; i++) {
        Span is = dxf->blocks[i].name;
        block = name.length > 0 && is.length == name.length && memcmp(is.at, name.at, (size_t)name.length) == 0
                    ? &dxf->blocks[i]
                    : NULL;
    }
    if (block == NULL || dxf->inserts == MOST_INSERTS) {
        Import_Skip(dxf->drawing, block == NULL ? "insert of a missing block" : "block within its own");
        return;
    }
    double turn = GetNumber(dxf, first, 50, 0.0) * PI / 180.0, c = cos(turn), s = sin(turn);
    double across = GetNumber(dxf, first, 41, 1.0), down = GetNumber(dxf, first, 42, 1.0);
    int columns = (int)fmin(fmax(GetNumber(dxf, first, 70, 1.0), 1.0), 1000.0),
        rows = (int)fmin(fmax(GetNumber(dxf, first, 71, 1.0), 1.0), 1000.0);
    dxf->inserts++;
    for (int i = 0; i < columns * rows && dxf->drawing->error[0] == 0; i++) {
        double x = (i % columns) * GetNumber(dxf, first, 44, 0.0),
               y = (double)(i / columns) * GetNumber(dxf, first, 45, 0.0);
        Affine place = { { c, s, -s, c, GetNumber(dxf, first, 10, 0.0) + c * x - s * y,
                           GetNumber(dxf, first, 20, 0.0) + s * x + c * y } };
        Affine size = { { across, 0, 0, down, -across * block->base[0], -down * block->base[1] } };
        DrawEntities(dxf, block->first, block->end, Affine_Multiply(affine, Affine_Multiply(place, size)));
    }
    dxf->inserts--;
}

/* Draws an entity whose pairs begin at `first`; returns the pair after it. */
static int32_t DrawEntity(Dxf* dxf, Span name, int32_t first, Affine affine)
{
    static const char* const parts[] = { "VERTEX", "SEQEND", "ENDSEC",   "EOF",    "BLOCK",
                                         "ENDBLK", "POINT",  "VIEWPORT", "ATTDEF", "SECTION" };
    int32_t style = 0;
    for (size_t i = 0; i < sizeof parts / sizeof parts[0]; i++) {
        if (Span_Is(name, parts[i])) {
            return first;
        }
    }
    if (GetNumber(dxf, first, 67, 0.0) == 1.0) { /* on the sheet of a print */
        return first;
    }
    bool isSeen = ChooseStyle(dxf, first, &style);
    double x = GetNumber(dxf, first, 10, 0.0), y = GetNumber(dxf, first, 20, 0.0);
    if (GetNumber(dxf, first, 230, 1.0) < 0.0 && !Span_Is(name, "LINE") && !Span_Is(name, "ELLIPSE") &&
        !Span_Is(name, "SPLINE")) {
        affine = Affine_Multiply(affine, (Affine){ { -1, 0, 0, 1, 0, 0 } }); /* drawn on the back */
    }
    if (Span_Is(name, "LWPOLYLINE") || Span_Is(name, "POLYLINE")) {
        return DrawPolyline(dxf, affine, first, style, isSeen, Span_Is(name, "LWPOLYLINE"));
    }
    if (!isSeen) {
        return first;
    }
    if (Span_Is(name, "LINE")) {
        Import_Begin(dxf->drawing, style);
        AddAffine(dxf, affine, x, y);
        AddAffine(dxf, affine, GetNumber(dxf, first, 11, 0.0), GetNumber(dxf, first, 21, 0.0));
        Import_End(dxf->drawing, false);
    } else if (Span_Is(name, "CIRCLE") || Span_Is(name, "ARC")) {
        double radius = GetNumber(dxf, first, 40, 0.0), from = 0.0, sweep = 2.0 * PI;
        if (Span_Is(name, "ARC")) {
            from = GetNumber(dxf, first, 50, 0.0) * PI / 180.0;
            sweep = fmod(GetNumber(dxf, first, 51, 360.0) * PI / 180.0 - from, 2.0 * PI);
            sweep += sweep <= 0.0 ? 2.0 * PI : 0.0;
        }
        DrawEllipseArc(dxf, affine, style, (const double[]){ x, y }, (const double[]){ radius, radius }, from, sweep);
    } else if (Span_Is(name, "ELLIPSE")) {
        double major[2] = { GetNumber(dxf, first, 11, 1.0), GetNumber(dxf, first, 21, 0.0) },
               ratio = GetNumber(dxf, first, 40, 1.0);
        double side = GetNumber(dxf, first, 230, 1.0) < 0.0 ? -ratio : ratio;
        double from = GetNumber(dxf, first, 41, 0.0), sweep = GetNumber(dxf, first, 42, 2.0 * PI) - from;
        Affine axes = { { major[0], major[1], -side * major[1], side * major[0], x, y } };
        sweep += sweep <= 0.0 ? 2.0 * PI : 0.0;
        DrawEllipseArc(dxf, Affine_Multiply(affine, axes), style, (const double[]){ 0, 0 }, (const double[]){ 1, 1 },
                       from, sweep);
    } else if (Span_Is(name, "SPLINE")) {
        DrawSpline(dxf, affine, first, style);
    } else if (Span_Is(name, "INSERT")) {
        DrawInsert(dxf, affine, first);
    } else {
        char kind[24];
        snprintf(kind, sizeof kind, "%.*s", (int)(name.length < 20 ? name.length : 20), name.at);
        Import_Skip(dxf->drawing, kind);
    }
    return first;
}

static void DrawEntities(Dxf* dxf, int32_t first, int32_t end, Affine affine)
{
    for (int32_t i = first; i < end && dxf->drawing->error[0] == 0;) {
        bool isEntity = dxf->pairs[i].code == 0;
        i = isEntity ? DrawEntity(dxf, dxf->pairs[i].value, i + 1, affine) : i + 1;
    }
}

void Import_ReadDxf(Import* drawing, const char* text, const char* end)
{
    Dxf dxf = { .drawing = drawing };
    if (ReadPairs(&dxf, text, end)) {
        int32_t first = 0;
        ReadTables(&dxf);
        while (first < dxf.pairCount && !(dxf.pairs[first].code == 2 && Span_Is(dxf.pairs[first].value, "ENTITIES"))) {
            first++;
        }
        int32_t last = first;
        while (last < dxf.pairCount && !IsBegin(&dxf.pairs[last], "ENDSEC")) {
            last++;
        }
        if (first == dxf.pairCount) {
            Import_Fail(drawing, "this DXF has no section ENTITIES");
        } else {
            DrawEntities(&dxf, first + 1, last, (Affine){ { 1, 0, 0, 1, 0, 0 } });
        }
    }
    free(dxf.pairs);
    free(dxf.blocks);
}
