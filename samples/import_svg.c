/* SVG: shapes, paths, use and symbol, transforms, units, styles, clip paths. Hidden and clipped parts are left out. */
#include "import_xml.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PI 3.14159265358979323846

enum { MOST_USES = 12, MOST_CLIPS = 8 };

/* A region of the drawing that is seen: polygons, even-odd. Coordinates of the drawing without its scale. */
typedef struct Clip {
    double* points;
    int32_t* starts; /* of the polygons */
    int32_t pointCount, pointCapacity, startCount, startCapacity;
    double lower[2], upper[2];
} Clip;

/* Properties that children inherit. */
typedef struct Pen {
    Affine affine;
    Span stroke, fill, dashes, color, layer, strokeOpacity, fillOpacity;
    bool isHidden;
} Pen;

typedef struct Svg {
    Import* drawing;
    Xml xml;
    Clip clips[MOST_CLIPS]; /* current ones; a point is seen if all hold it */
    int32_t clipCount, uses, depth;
    Clip* into; /* shapes become a clip, and no lines */
    int32_t style;
    double view[2];           /* of the viewBox around: what per cents are of */
    double first[2], last[2]; /* of the subpath, before its affine */
    bool isBegun;
    const Pen* pen;
    double* line; /* the points of the current line before it is clipped */
    int32_t lineCount, lineCapacity;
} Svg;

static const char* SkipCommas(const char* at, const char* end)
{
    while (at < end && (Import_IsSpace(*at) || *at == ',')) {
        at++;
    }
    return at;
}

/* Reads up to `most` numbers. */
static int ReadNumbers(Span span, double* numbers, int most)
{
    const char *at = span.at, *end = span.at + span.length;
    int count = 0;
    while (span.at != NULL && count < most) {
        at = Import_ReadNumber(SkipCommas(at, end), end, &numbers[count]);
        if (at == NULL) {
            break;
        }
        count++;
    }
    return count;
}

/* Millimetres of a unit; 0: none, or not a length. */
static double GetUnit(Span unit)
{
    static const struct {
        const char* name;
        double size;
    } units[] = { { "mm", 1.0 },         { "cm", 10.0 },        { "m", 1000.0 },
                  { "in", 25.4 },        { "pt", 25.4 / 72.0 }, { "pc", 25.4 / 6.0 },
                  { "px", 25.4 / 96.0 }, { "q", 0.25 },         { "em", 16.0 * 25.4 / 96.0 } };
    for (size_t i = 0; i < sizeof units / sizeof units[0]; i++) {
        if (unit.length == (int32_t)strlen(units[i].name) && Span_Holds(unit, units[i].name)) {
            return units[i].size;
        }
    }
    return 0.0;
}

/* A length in pixels; a share of `whole` where it has a per cent sign. */
static double GetLength(Span span, double whole, double otherwise)
{
    double number;
    const char* end = span.at != NULL ? Import_ReadNumber(span.at, span.at + span.length, &number) : NULL;
    if (end == NULL) {
        return otherwise;
    }
    Span unit = { end, (int32_t)(span.at + span.length - end) };
    double size = GetUnit(unit);
    return Span_Is(unit, "%") ? 0.01 * number * whole : size > 0.0 ? number * size * 96.0 / 25.4 : number;
}

/* A per cent is a share of the width or the height; for a radius, of their quadratic mean. */
static double LengthOf(const Svg* svg, int32_t node, const char* name)
{
    bool isDown = strchr(name, 'y') != NULL || name[0] == 'h';
    double whole = Span_Is((Span){ name, (int32_t)strlen(name) }, "r") ? hypot(svg->view[0], svg->view[1]) * sqrt(0.5)
                                                                       : svg->view[isDown];
    return GetLength(Xml_GetAttribute(&svg->xml, node, name), whole, 0.0);
}

static Affine ReadTransform(Span list)
{
    Affine all = { { 1, 0, 0, 1, 0, 0 } };
    const char *at = list.at, *end = list.at + list.length;
    while (at < end) {
        const char* open = memchr(at, '(', (size_t)(end - at));
        const char* close = open != NULL ? memchr(open, ')', (size_t)(end - open)) : NULL;
        if (close == NULL) {
            break;
        }
        Span name = Span_Trim((Span){ SkipCommas(at, open), 0 });
        name.length = (int32_t)(open - name.at);
        name = Span_Trim(name);
        double n[6] = { 0 };
        int count = ReadNumbers((Span){ open + 1, (int32_t)(close - open - 1) }, n, 6);
        Affine one = { { 1, 0, 0, 1, 0, 0 } };
        if (Span_Is(name, "matrix") && count == 6) {
            memcpy(one.m, n, sizeof n);
        } else if (Span_Is(name, "translate")) {
            one.m[4] = n[0];
            one.m[5] = n[1];
        } else if (Span_Is(name, "scale")) {
            one.m[0] = n[0];
            one.m[3] = count > 1 ? n[1] : n[0];
        } else if (Span_Is(name, "rotate")) {
            double quarter = n[0] / 90.0, c = cos(n[0] * PI / 180.0), s = sin(n[0] * PI / 180.0);
            if (quarter == floor(quarter)) { /* exact right angles */
                c = floor(c + 0.5);
                s = floor(s + 0.5);
            }
            one = (Affine){ { c, s, -s, c, n[1] - c * n[1] + s * n[2], n[2] - s * n[1] - c * n[2] } };
        } else if (Span_Is(name, "skewX")) {
            one.m[2] = tan(n[0] * PI / 180.0);
        } else if (Span_Is(name, "skewY")) {
            one.m[1] = tan(n[0] * PI / 180.0);
        }
        all = Affine_Multiply(all, one);
        at = close + 1;
    }
    return all;
}

/* From the viewBox to a size in pixels: as large as it fits, in the middle. */
static Affine FitViewBox(Span viewBox, Span ratio, double width, double height)
{
    double box[4], x = 0.0, y = 0.0;
    if (ReadNumbers(viewBox, box, 4) < 4 || !(box[2] > 0.0 && box[3] > 0.0)) {
        return (Affine){ { 1, 0, 0, 1, 0, 0 } };
    }
    double across = width / box[2], down = height / box[3];
    if (!(ratio.at != NULL && Span_Holds(ratio, "none"))) {
        bool isSliced = ratio.at != NULL && Span_Holds(ratio, "slice");
        across = down = isSliced ? fmax(across, down) : fmin(across, down);
        double part[2] = { 0.5, 0.5 };
        part[0] = ratio.at != NULL && Span_Holds(ratio, "xmin")   ? 0.0
                  : ratio.at != NULL && Span_Holds(ratio, "xmax") ? 1.0
                                                                  : 0.5;
        part[1] = ratio.at != NULL && Span_Holds(ratio, "ymin")   ? 0.0
                  : ratio.at != NULL && Span_Holds(ratio, "ymax") ? 1.0
                                                                  : 0.5;
        x = part[0] * (width - box[2] * across);
        y = part[1] * (height - box[3] * down);
    }
    return (Affine){ { across, 0, 0, down, x - box[0] * across, y - box[1] * down } };
}

/* ---- Clip paths ---- */

static int CompareNumbers(const void* a, const void* b)
{
    double x = *(const double*)a, y = *(const double*)b;
    return (x > y) - (x < y);
}

/* Whether the polygons hold the point, or have it on their border. */
static bool Clip_Holds(const Clip* clip, const double p[2], double near)
{
    bool isInside = false;
    for (int32_t i = 0; i < clip->startCount; i++) {
        int32_t first = clip->starts[i], end = i + 1 < clip->startCount ? clip->starts[i + 1] : clip->pointCount;
        for (int32_t j = first; j < end; j++) {
            const double *a = &clip->points[2 * j], *b = &clip->points[2 * (j + 1 < end ? j + 1 : first)];
            double ab[2] = { b[0] - a[0], b[1] - a[1] }, ap[2] = { p[0] - a[0], p[1] - a[1] };
            double length = ab[0] * ab[0] + ab[1] * ab[1];
            double t = length > 0.0 ? fmin(fmax((ab[0] * ap[0] + ab[1] * ap[1]) / length, 0.0), 1.0) : 0.0;
            if (hypot(ap[0] - t * ab[0], ap[1] - t * ab[1]) <= near) {
                return true;
            }
            if ((a[1] > p[1]) != (b[1] > p[1]) && p[0] < a[0] + ab[0] * ap[1] / ab[1]) {
                isInside = !isInside;
            }
        }
    }
    return isInside;
}

/* Adds the parameters at which a segment crosses the polygons. */
static int FindCrossings(const Clip* clip, const double* p, const double* q, double* cuts, int count, int most)
{
    double pq[2] = { q[0] - p[0], q[1] - p[1] };
    for (int32_t i = 0; i < clip->startCount; i++) {
        int32_t first = clip->starts[i], end = i + 1 < clip->startCount ? clip->starts[i + 1] : clip->pointCount;
        for (int32_t j = first; j < end && count < most; j++) {
            const double *a = &clip->points[2 * j], *b = &clip->points[2 * (j + 1 < end ? j + 1 : first)];
            double ab[2] = { b[0] - a[0], b[1] - a[1] }, cross = pq[0] * ab[1] - pq[1] * ab[0];
            double t = ((a[0] - p[0]) * ab[1] - (a[1] - p[1]) * ab[0]) / cross;
            double s = ((a[0] - p[0]) * pq[1] - (a[1] - p[1]) * pq[0]) / cross;
            if (cross != 0.0 && t > 0.0 && t < 1.0 && s >= 0.0 && s <= 1.0) {
                cuts[count++] = t;
            }
        }
    }
    return count;
}

/* Gives the parts of the line that all clips hold to the drawing. */
static void EmitClipped(Svg* svg)
{
    enum { MOST_CUTS = 256 };
    Import* drawing = svg->drawing;
    bool isOpen = false, isSeen = false;
    for (int32_t i = 0; i + 1 < svg->lineCount; i++) {
        const double *p = &svg->line[2 * i], *q = p + 2;
        double cuts[MOST_CUTS + 2], near = 1e-7 * (hypot(q[0] - p[0], q[1] - p[1]) + fabs(p[0]) + fabs(p[1])) + 1e-9;
        int count = 1;
        cuts[0] = 0.0;
        for (int32_t k = 0; k < svg->clipCount; k++) {
            count = FindCrossings(&svg->clips[k], p, q, cuts, count, MOST_CUTS);
        }
        cuts[count] = 1.0;
        qsort(cuts, (size_t)count, sizeof(double), CompareNumbers);
        for (int j = 0; j < count; j++) {
            double from[2], to[2], middle[2];
            bool isHeld = true;
            for (int k = 0; k < 2; k++) {
                from[k] = p[k] + cuts[j] * (q[k] - p[k]);
                to[k] = j + 1 < count ? p[k] + cuts[j + 1] * (q[k] - p[k]) : q[k];
                middle[k] = 0.5 * (from[k] + to[k]);
            }
            for (int32_t k = 0; k < svg->clipCount && isHeld; k++) {
                isHeld = Clip_Holds(&svg->clips[k], middle, near);
            }
            if (isHeld && !isOpen) {
                Import_Begin(drawing, svg->style);
                Import_Add(drawing, from[0], from[1]);
            } else if (!isHeld && isOpen) {
                Import_End(drawing, false);
            }
            if (isHeld) {
                Import_Add(drawing, to[0], to[1]);
            }
            isOpen = isHeld;
            isSeen = isSeen || isHeld;
        }
    }
    if (isOpen) {
        Import_End(drawing, false);
    }
    if (!isSeen) {
        Import_Skip(drawing, "clipped");
    }
}

/* ---- Lines ---- */

/* The curves of a path go through Import, which makes their points; with clips these become a list first. */
static void TakeBack(Svg* svg)
{
    Import* drawing = svg->drawing;
    ImportLine line = drawing->lines[drawing->lineCount];
    if (drawing->error[0] != 0 || line.count < 2 || line.use < 0) {
        drawing->pointCount = line.first;
        return;
    }
    svg->lineCount = 0;
    for (int32_t i = 0; i < line.count; i++) {
        if (!Import_Reserve((void**)&svg->line, &svg->lineCapacity, svg->lineCount, 2 * sizeof(double))) {
            Import_Fail(drawing, "there is no memory for the drawing");
            return;
        }
        for (int k = 0; k < 2; k++) {
            svg->line[2 * svg->lineCount + k] = drawing->points[2 * (line.first + i) + k] / drawing->scale;
        }
        svg->lineCount++;
    }
    drawing->pointCount = line.first;
    Clip* clip = svg->into;
    if (clip == NULL) {
        EmitClipped(svg);
        return;
    }
    if (!Import_Reserve((void**)&clip->starts, &clip->startCapacity, clip->startCount, sizeof(int32_t))) {
        Import_Fail(drawing, "there is no memory for the drawing");
        return;
    }
    clip->starts[clip->startCount++] = clip->pointCount;
    for (int32_t i = 0; i < svg->lineCount; i++) {
        if (!Import_Reserve((void**)&clip->points, &clip->pointCapacity, clip->pointCount, 2 * sizeof(double))) {
            Import_Fail(drawing, "there is no memory for the drawing");
            return;
        }
        memcpy(&clip->points[2 * clip->pointCount++], &svg->line[2 * i], 2 * sizeof(double));
    }
}

static void EndLine(Svg* svg, bool isClosed)
{
    if (!svg->isBegun || svg->drawing->error[0] != 0) {
        return;
    }
    svg->isBegun = false;
    if (svg->clipCount == 0 && svg->into == NULL) {
        Import_End(svg->drawing, isClosed);
        return;
    }
    if (isClosed) {
        const double* m = svg->pen->affine.m;
        Import_Add(svg->drawing, m[0] * svg->first[0] + m[2] * svg->first[1] + m[4],
                   m[1] * svg->first[0] + m[3] * svg->first[1] + m[5]);
    }
    TakeBack(svg);
}

static void AddPoint(Svg* svg, double x, double y)
{
    const double* m = svg->pen->affine.m;
    if (!svg->isBegun) {
        Import_Begin(svg->drawing, svg->style);
        Import_Add(svg->drawing, m[0] * svg->last[0] + m[2] * svg->last[1] + m[4],
                   m[1] * svg->last[0] + m[3] * svg->last[1] + m[5]);
        svg->isBegun = true;
    }
    Import_Add(svg->drawing, m[0] * x + m[2] * y + m[4], m[1] * x + m[3] * y + m[5]);
    svg->last[0] = x;
    svg->last[1] = y;
}

static void MoveTo(Svg* svg, double x, double y)
{
    EndLine(svg, false);
    svg->first[0] = svg->last[0] = x;
    svg->first[1] = svg->last[1] = y;
}

static void CurveTo(Svg* svg, const double (*points)[2], int degree)
{
    AddPoint(svg, svg->last[0], svg->last[1]);
    Import_AddBezier(svg->drawing, svg->pen->affine, points, degree);
    svg->last[0] = points[degree][0];
    svg->last[1] = points[degree][1];
}

/* An arc by its ends, as in the appendix of SVG: its ellipse is a circle in turned and stretched axes. */
static void ArcTo(Svg* svg, const double n[7])
{
    double rx = fabs(n[0]), ry = fabs(n[1]), turn = n[2] * PI / 180.0, c = cos(turn), s = sin(turn);
    double to[2] = { n[5], n[6] }, half[2] = { 0.5 * (svg->last[0] - to[0]), 0.5 * (svg->last[1] - to[1]) };
    if (rx == 0.0 || ry == 0.0 || (half[0] == 0.0 && half[1] == 0.0)) {
        AddPoint(svg, to[0], to[1]);
        return;
    }
    double x = (c * half[0] + s * half[1]) / rx, y = (-s * half[0] + c * half[1]) / ry, square = x * x + y * y;
    if (square > 1.0) {
        rx *= sqrt(square);
        ry *= sqrt(square);
        x /= sqrt(square);
        y /= sqrt(square);
        square = 1.0;
    }
    double side = sqrt(fmax(1.0 / square - 1.0, 0.0)) * ((n[3] != 0.0) == (n[4] != 0.0) ? -1.0 : 1.0);
    double center[2] = { side * y, -side * x }; /* in axes where the ellipse is the unit circle */
    double from = atan2(y - center[1], x - center[0]), sweep = atan2(-y - center[1], -x - center[0]) - from;
    sweep += n[4] != 0.0 && sweep < 0.0 ? 2.0 * PI : n[4] == 0.0 && sweep > 0.0 ? -2.0 * PI : 0.0;
    double middle[2] = { 0.5 * (svg->last[0] + to[0]), 0.5 * (svg->last[1] + to[1]) };
    Affine axes = { { c, s, -s, c, middle[0], middle[1] } };
    AddPoint(svg, svg->last[0], svg->last[1]);
    Import_AddEllipse(svg->drawing, Affine_Multiply(svg->pen->affine, axes),
                      (const double[]){ center[0] * rx, center[1] * ry }, (const double[]){ rx, ry }, from, sweep);
    if (svg->drawing->error[0] == 0) { /* the end exactly */
        ImportLine* line = &svg->drawing->lines[svg->drawing->lineCount];
        svg->drawing->pointCount -= line->count > 1;
        line->count -= line->count > 1;
    }
    AddPoint(svg, to[0], to[1]);
}

static const char* ReadArguments(const char* at, const char* end, char command, double n[7], int count)
{
    for (int i = 0; i < count; i++) {
        at = SkipCommas(at, end);
        if (command == 'A' && (i == 3 || i == 4)) { /* flags need no space */
            if (at == end || (*at != '0' && *at != '1')) {
                return NULL;
            }
            n[i] = *at++ - '0';
            continue;
        }
        at = Import_ReadNumber(at, end, &n[i]);
        if (at == NULL) {
            return NULL;
        }
    }
    return at;
}

static void ReadPath(Svg* svg, Span data)
{
    static const char letters[] = "MLHVCSQTAZ";
    static const int counts[] = { 2, 2, 1, 1, 6, 4, 4, 2, 7, 0 };
    const char *at = data.at, *end = data.at + data.length;
    char command = 0, before = 0;
    bool isRelative = false;
    double control[2] = { 0.0, 0.0 }; /* of the curve before */
    svg->first[0] = svg->first[1] = svg->last[0] = svg->last[1] = 0.0;
    while (data.at != NULL && (at = SkipCommas(at, end)) < end) {
        char letter = *at >= 'a' && *at <= 'z' ? (char)(*at - 32) : *at;
        const char* found = letter != 0 ? strchr(letters, letter) : NULL;
        if (found != NULL) {
            isRelative = *at >= 'a';
            command = letter;
            at++;
        } else if (command == 'M') {
            command = 'L';
        }
        int kind = command != 0 && command != 'Z' ? (int)(strchr(letters, command) - letters) : -1;
        if (command == 'Z' && found != NULL) {
            EndLine(svg, true);
            svg->last[0] = svg->first[0];
            svg->last[1] = svg->first[1];
            before = 'Z';
            continue;
        }
        double n[7], x = svg->last[0], y = svg->last[1];
        const char* next = kind >= 0 ? ReadArguments(at, end, command, n, counts[kind]) : NULL;
        if (next == NULL) {
            Import_Skip(svg->drawing, "damaged path"); /* drawn up to here, as SVG says */
            break;
        }
        at = next;
        for (int i = command == 'A' ? 5 : 0; i < counts[kind] && isRelative; i++) {
            n[i] += command == 'V' || (command == 'A' ? i == 6 : command != 'H' && i % 2 == 1) ? y : x;
        }
        bool isSmooth = (command == 'S' && (before == 'C' || before == 'S')) ||
                        (command == 'T' && (before == 'Q' || before == 'T'));
        double mirrored[2] = { isSmooth ? 2.0 * x - control[0] : x, isSmooth ? 2.0 * y - control[1] : y };
        if (command == 'M') {
            MoveTo(svg, n[0], n[1]);
        } else if (command == 'L') {
            AddPoint(svg, n[0], n[1]);
        } else if (command == 'H') {
            AddPoint(svg, n[0], y);
        } else if (command == 'V') {
            AddPoint(svg, x, n[0]);
        } else if (command == 'C' || command == 'S') {
            const double* c = command == 'C' ? n + 2 : n;
            CurveTo(svg,
                    (const double[4][2]){ { x, y },
                                          { command == 'C' ? n[0] : mirrored[0], command == 'C' ? n[1] : mirrored[1] },
                                          { c[0], c[1] },
                                          { c[2], c[3] } },
                    3);
            memcpy(control, c, sizeof control);
        } else if (command == 'Q' || command == 'T') {
            control[0] = command == 'Q' ? n[0] : mirrored[0];
            control[1] = command == 'Q' ? n[1] : mirrored[1];
            const double* to = command == 'Q' ? n + 2 : n;
            CurveTo(svg, (const double[3][2]){ { x, y }, { control[0], control[1] }, { to[0], to[1] } }, 2);
        } else {
            ArcTo(svg, n);
        }
        before = command;
    }
    EndLine(svg, false);
}

/* ---- Shapes ---- */

static void DrawEllipse(Svg* svg, double x, double y, double rx, double ry)
{
    if (rx > 0.0 && ry > 0.0) {
        MoveTo(svg, x + rx, y);
        for (int i = 1; i <= 4; i++) { /* four arcs: exact quarters */
            static const double quarter[5][2] = { { 1, 0 }, { 0, 1 }, { -1, 0 }, { 0, -1 }, { 1, 0 } };
            ArcTo(svg, (const double[]){ rx, ry, 0, 0, 1, x + quarter[i][0] * rx, y + quarter[i][1] * ry });
        }
        EndLine(svg, true);
    }
}

static void DrawRect(Svg* svg, int32_t node)
{
    double x = LengthOf(svg, node, "x"), y = LengthOf(svg, node, "y"), w = LengthOf(svg, node, "width"),
           h = LengthOf(svg, node, "height");
    double rx = GetLength(Xml_GetAttribute(&svg->xml, node, "rx"), svg->view[0], -1.0),
           ry = GetLength(Xml_GetAttribute(&svg->xml, node, "ry"), svg->view[1], -1.0);
    rx = rx < 0.0 ? ry : rx;
    ry = ry < 0.0 ? rx : ry;
    rx = fmin(fmax(rx, 0.0), 0.5 * w);
    ry = fmin(fmax(ry, 0.0), 0.5 * h);
    if (!(w > 0.0 && h > 0.0)) {
        return;
    }
    bool isRound = rx > 0.0 && ry > 0.0;
    rx = isRound ? rx : 0.0;
    ry = isRound ? ry : 0.0;
    MoveTo(svg, x + rx, y);
    for (int i = 0; i < 4; i++) { /* each side, then its corner */
        static const int right[4] = { 1, 1, 0, 0 }, low[4] = { 0, 1, 1, 0 };
        double corner[2] = { x + w * right[i], y + h * low[i] };
        double inX = right[i] ? -rx : rx, inY = low[i] ? -ry : ry;
        bool isAlongX = i % 2 == 0;
        AddPoint(svg, corner[0] + (isAlongX ? inX : 0.0), corner[1] + (isAlongX ? 0.0 : inY));
        if (isRound) {
            ArcTo(svg, (const double[]){ rx, ry, 0, 0, 1, corner[0] + (isAlongX ? 0.0 : inX),
                                         corner[1] + (isAlongX ? inY : 0.0) });
        }
    }
    EndLine(svg, true);
}

static void DrawPoints(Svg* svg, Span list, bool isClosed)
{
    const char *at = list.at, *end = list.at + list.length;
    double x, y;
    for (bool isFirst = true; list.at != NULL; isFirst = false) {
        at = Import_ReadNumber(SkipCommas(at, end), end, &x);
        at = at != NULL ? Import_ReadNumber(SkipCommas(at, end), end, &y) : NULL;
        if (at == NULL) {
            break;
        }
        if (isFirst) {
            MoveTo(svg, x, y);
        } else {
            AddPoint(svg, x, y);
        }
    }
    EndLine(svg, isClosed);
}

/* False: it is not a shape. */
static bool DrawShape(Svg* svg, int32_t node)
{
    Span name = svg->xml.nodes[node].name;
    if (Span_Is(name, "path")) {
        ReadPath(svg, Xml_GetAttribute(&svg->xml, node, "d"));
    } else if (Span_Is(name, "rect")) {
        DrawRect(svg, node);
    } else if (Span_Is(name, "circle") || Span_Is(name, "ellipse")) {
        bool isCircle = Span_Is(name, "circle");
        double rx = LengthOf(svg, node, isCircle ? "r" : "rx"), ry = LengthOf(svg, node, isCircle ? "r" : "ry");
        bool hasX = isCircle || Xml_GetAttribute(&svg->xml, node, "rx").at != NULL,
             hasY = isCircle || Xml_GetAttribute(&svg->xml, node, "ry").at != NULL;
        DrawEllipse(svg, LengthOf(svg, node, "cx"), LengthOf(svg, node, "cy"), hasX ? rx : ry, hasY ? ry : rx);
    } else if (Span_Is(name, "line")) {
        MoveTo(svg, LengthOf(svg, node, "x1"), LengthOf(svg, node, "y1"));
        AddPoint(svg, LengthOf(svg, node, "x2"), LengthOf(svg, node, "y2"));
        EndLine(svg, false);
    } else if (Span_Is(name, "polyline") || Span_Is(name, "polygon")) {
        DrawPoints(svg, Xml_GetAttribute(&svg->xml, node, "points"), Span_Is(name, "polygon"));
    } else {
        return false;
    }
    return true;
}

/* ---- Colours and layers ---- */

/* A paint that was not given is seen, if it is not transparent. */
static bool IsSeen(Span paint, Span opacity)
{
    int rgba[4];
    double part = 1.0;
    ReadNumbers(opacity, &part, 1);
    bool isNone = paint.length == 4 && Span_Holds(paint, "none");
    return part > 0.0 && !isNone && !(paint.length == 11 && Span_Holds(paint, "transparent")) &&
           !(paint.at != NULL && Import_ReadColor(paint, rgba) && rgba[3] == 0);
}

/* The style of a shape's lines; false: it is not drawn. */
static bool ChooseStyle(Svg* svg, const Pen* pen)
{
    bool isStroked = pen->stroke.at != NULL && IsSeen(pen->stroke, pen->strokeOpacity);
    Span paint = isStroked ? pen->stroke : pen->fill;
    if (pen->isHidden || (!isStroked && !IsSeen(pen->fill, pen->fillOpacity))) {
        return false;
    }
    paint = paint.length == 12 && Span_Holds(paint, "currentcolor") ? pen->color : paint;
    int rgba[4];
    bool isColor = Import_ReadColor(paint.at != NULL ? paint : (Span){ "black", 5 }, rgba);
    double dash[8] = { 0 };
    int dashes = isStroked ? ReadNumbers(pen->dashes, dash, 8) : 0;
    bool isDashed = dashes > 0 && dash[0] > 0.0 && (dashes == 1 || dash[1] > 0.0);
    char name[IMPORT_TEXT], color[24];
    int32_t use = Import_UseOfColor(rgba), layer = Import_GetUse(pen->layer);
    if (use == IMPORT_CUT && isDashed) { /* dash and dot: a mountain */
        use = dashes >= 4 ? IMPORT_MOUNTAIN : IMPORT_VALLEY;
    }
    if (isColor) {
        snprintf(color, sizeof color, "#%02x%02x%02x", (unsigned)rgba[0], (unsigned)rgba[1], (unsigned)rgba[2]);
    } else {
        snprintf(color, sizeof color, "%.*s", (int)paint.length, paint.at);
    }
    snprintf(name, sizeof name, "%s%s%s%.*s", color, isDashed ? dashes >= 4 ? " dash-dot" : " dashed" : "",
             layer >= 0 ? " " : "", layer >= 0 ? (int)(pen->layer.length < 24 ? pen->layer.length : 24) : 0,
             layer >= 0 ? pen->layer.at : "");
    svg->style = Import_AddStyle(svg->drawing, name, layer >= 0 ? layer : use);
    return true;
}

/* ---- The tree ---- */

static void Inherit(const Svg* svg, int32_t node, Pen* pen)
{
    struct {
        const char* name;
        Span* value;
    } properties[] = { { "stroke", &pen->stroke },
                       { "fill", &pen->fill },
                       { "stroke-dasharray", &pen->dashes },
                       { "color", &pen->color },
                       { "stroke-opacity", &pen->strokeOpacity },
                       { "fill-opacity", &pen->fillOpacity } };
    for (size_t i = 0; i < sizeof properties / sizeof properties[0]; i++) {
        Span value = Xml_GetProperty(&svg->xml, node, properties[i].name);
        if (value.at != NULL && !Span_Is(value, "inherit")) {
            *properties[i].value = value;
        }
    }
    Span visibility = Xml_GetProperty(&svg->xml, node, "visibility");
    if (visibility.at != NULL) {
        pen->isHidden = !Span_Is(visibility, "visible") && !Span_Is(visibility, "inherit");
    }
    if (Span_Is(svg->xml.nodes[node].name, "g")) {
        Span label = Xml_GetAttribute(&svg->xml, node, "label"), id = Xml_GetAttribute(&svg->xml, node, "id");
        Span name = Import_GetUse(label) >= 0 ? label : id;
        pen->layer = Import_GetUse(name) >= 0 ? name : pen->layer;
    }
    Span transform = Xml_GetProperty(&svg->xml, node, "transform");
    if (transform.at != NULL) {
        pen->affine = Affine_Multiply(pen->affine, ReadTransform(transform));
    }
}

static void DrawNode(Svg* svg, int32_t node, const Pen* outer);

static void DrawChildren(Svg* svg, int32_t node, const Pen* pen)
{
    for (int32_t child = svg->xml.nodes[node].child; child != NO_NODE && svg->drawing->error[0] == 0;
         child = svg->xml.nodes[child].next) {
        DrawNode(svg, child, pen);
    }
}

static void EndClip(Svg* svg)
{
    Clip* clip = &svg->clips[--svg->clipCount];
    free(clip->points);
    free(clip->starts);
}

/* Nothing is seen outside the box of a size in pixels. Returns whether a clip was added. */
static bool BeginBox(Svg* svg, Affine affine, const double size[2])
{
    if (svg->clipCount == MOST_CLIPS || svg->into != NULL) {
        return false;
    }
    Clip* clip = &svg->clips[svg->clipCount];
    *clip = (Clip){ .points = malloc(8 * sizeof(double)), .starts = calloc(1, sizeof(int32_t)), .startCount = 1 };
    if (clip->points == NULL || clip->starts == NULL) {
        free(clip->points);
        free(clip->starts);
        Import_Fail(svg->drawing, "there is no memory for the drawing");
        return false;
    }
    for (clip->pointCount = 0; clip->pointCount < 4; clip->pointCount++) {
        int32_t i = clip->pointCount;
        double x = i == 1 || i == 2 ? size[0] : 0.0, y = i > 1 ? size[1] : 0.0;
        const double* m = affine.m;
        clip->points[2 * i] = m[0] * x + m[2] * y + m[4];
        clip->points[2 * i + 1] = m[1] * x + m[3] * y + m[5];
    }
    svg->clipCount++;
    return true;
}

/* Draws an inner svg or symbol within its box. `by`: the element that sizes the box, a use or the node. */
static void DrawView(Svg* svg, int32_t node, int32_t by, Pen pen)
{
    const Xml* xml = &svg->xml;
    double size[2], box[4], outer[2] = { svg->view[0], svg->view[1] };
    Span viewBox = Xml_GetAttribute(xml, node, "viewBox"), overflow = Xml_GetProperty(xml, node, "overflow");
    for (int k = 0; k < 2; k++) {
        const char* name = k == 0 ? "width" : "height";
        double own = GetLength(Xml_GetAttribute(xml, node, name), outer[k], outer[k]);
        size[k] = GetLength(Xml_GetAttribute(xml, by, name), outer[k], own);
    }
    Affine move = { { 1, 0, 0, 1, LengthOf(svg, node, "x"), LengthOf(svg, node, "y") } };
    pen.affine = Affine_Multiply(pen.affine, move);
    bool isSeen = overflow.at != NULL && (Span_Is(overflow, "visible") || Span_Is(overflow, "auto"));
    bool isClipped = !isSeen && BeginBox(svg, pen.affine, size);
    bool hasBox = ReadNumbers(viewBox, box, 4) == 4;
    pen.affine = Affine_Multiply(
        pen.affine, FitViewBox(viewBox, Xml_GetAttribute(xml, node, "preserveAspectRatio"), size[0], size[1]));
    memcpy(svg->view, hasBox ? box + 2 : size, sizeof outer);
    DrawChildren(svg, node, &pen);
    memcpy(svg->view, outer, sizeof outer);
    if (isClipped) {
        EndClip(svg);
    }
}

static void DrawUse(Svg* svg, int32_t node, Pen pen)
{
    int32_t target = Xml_FindReference(&svg->xml, Xml_GetAttribute(&svg->xml, node, "href"));
    Affine move = { { 1, 0, 0, 1, LengthOf(svg, node, "x"), LengthOf(svg, node, "y") } };
    if (target == NO_NODE || svg->uses == MOST_USES) {
        Import_Skip(svg->drawing, target == NO_NODE ? "use of a missing id" : "use within its own");
        return;
    }
    svg->uses++;
    pen.affine = Affine_Multiply(pen.affine, move);
    Span name = svg->xml.nodes[target].name;
    if (Span_Is(name, "symbol") || Span_Is(name, "svg")) {
        Inherit(svg, target, &pen);
        DrawView(svg, target, node, pen);
    } else {
        DrawNode(svg, target, &pen);
    }
    svg->uses--;
}

/* Shapes of a clip path become one region. Returns whether a clip was added. */
static bool BeginClip(Svg* svg, Span reference, Pen pen)
{
    int32_t node = Xml_FindReference(&svg->xml, reference);
    if (node == NO_NODE || svg->into != NULL) {
        return false;
    }
    if (svg->clipCount == MOST_CLIPS) {
        Import_Skip(svg->drawing, "clip in eight clips");
        return false;
    }
    Clip* clip = &svg->clips[svg->clipCount];
    *clip = (Clip){ .points = NULL };
    Span units = Xml_GetAttribute(&svg->xml, node, "clipPathUnits");
    if (units.at != NULL && Span_Is(units, "objectBoundingBox")) {
        Import_Skip(svg->drawing, "clip by bounding box");
        return false;
    }
    pen.isHidden = false;
    pen.fill = pen.stroke = (Span){ NULL, 0 };
    svg->into = clip;
    Inherit(svg, node, &pen);
    DrawChildren(svg, node, &pen);
    svg->into = NULL;
    svg->clipCount++;
    return true;
}

static void DrawNode(Svg* svg, int32_t node, const Pen* outer)
{
    static const char* const silent[] = { "defs",           "clipPath",       "mask",   "pattern", "marker",
                                          "linearGradient", "radialGradient", "symbol", "filter",  "style",
                                          "title",          "metadata",       "desc",   "script",  "namedview" };
    static const char* const left[] = { "text", "image", "foreignObject" };
    Span name = svg->xml.nodes[node].name;
    for (size_t i = 0; i < sizeof silent / sizeof silent[0]; i++) {
        if (Span_Is(name, silent[i])) {
            return;
        }
    }
    Span display = Xml_GetProperty(&svg->xml, node, "display"), opacity = Xml_GetProperty(&svg->xml, node, "opacity");
    double seen = 1.0;
    ReadNumbers(opacity, &seen, 1);
    if ((display.at != NULL && Span_Is(display, "none")) || seen <= 0.0) {
        Import_Skip(svg->drawing, Span_Is(name, "g") ? "hidden group" : "hidden");
        return;
    }
    for (size_t i = 0; i < sizeof left / sizeof left[0]; i++) {
        if (Span_Is(name, left[i])) {
            Import_Skip(svg->drawing, left[i]);
            return;
        }
    }
    if (++svg->depth > IMPORT_MOST_DEPTH) {
        Import_Fail(svg->drawing, "elements are nested more than %d deep", IMPORT_MOST_DEPTH);
        return;
    }
    Pen pen = *outer;
    Inherit(svg, node, &pen);
    Span reference = Xml_GetProperty(&svg->xml, node, "clip-path");
    bool isClipped = reference.at != NULL && BeginClip(svg, reference, pen);
    if (Xml_GetProperty(&svg->xml, node, "mask").at != NULL &&
        !Span_Is(Xml_GetProperty(&svg->xml, node, "mask"), "none")) {
        Import_Skip(svg->drawing, "mask");
    }
    svg->pen = &pen;
    if (Span_Is(name, "use")) {
        DrawUse(svg, node, pen);
    } else if (Span_Is(name, "svg")) {
        DrawView(svg, node, node, pen);
    } else if (Span_Is(name, "g") || Span_Is(name, "a") || Span_Is(name, "switch")) {
        DrawChildren(svg, node, &pen);
    } else if (svg->into != NULL) {
        DrawShape(svg, node);
    } else if (!ChooseStyle(svg, &pen)) {
        Import_Skip(svg->drawing, "hidden");
    } else if (!DrawShape(svg, node)) {
        char kind[24];
        snprintf(kind, sizeof kind, "%.*s", (int)(name.length < 20 ? name.length : 20), name.at);
        Import_Skip(svg->drawing, kind);
    }
    if (isClipped) {
        EndClip(svg);
    }
    svg->depth--;
}

void Import_ReadSvg(Import* drawing, const char* text, const char* end)
{
    Svg svg = { .drawing = drawing };
    int32_t root = 0;
    bool isRead = Xml_Read(&svg.xml, drawing, text, end);
    while (root < svg.xml.nodeCount && !Span_Is(svg.xml.nodes[root].name, "svg")) {
        root++;
    }
    if (root == svg.xml.nodeCount) {
        Import_Fail(drawing, "this is no SVG");
    } else if (isRead) {
        /* Root: pixels, or millimetres where its size has a unit. */
        Span width = Xml_GetAttribute(&svg.xml, root, "width"), height = Xml_GetAttribute(&svg.xml, root, "height"),
             viewBox = Xml_GetAttribute(&svg.xml, root, "viewBox");
        double number, box[4] = { 0.0, 0.0, 100.0, 100.0 };
        bool hasBox = ReadNumbers(viewBox, box, 4) == 4;
        svg.view[0] = hasBox ? box[2] : GetLength(width, 100.0, 100.0);
        svg.view[1] = hasBox ? box[3] : GetLength(height, 100.0, 100.0);
        const char* unit = width.at != NULL ? Import_ReadNumber(width.at, width.at + width.length, &number) : NULL;
        Span name = { unit, unit != NULL ? (int32_t)(width.at + width.length - unit) : 0 };
        drawing->isSized = unit != NULL && GetUnit(name) > 0.0 && !Span_Is(name, "px");
        drawing->scale = 25.4 / 96.0;
        Pen pen = { .affine = { { 1, 0, 0, -1, 0, 0 } } };
        if (hasBox) {
            double size[2] = { GetLength(width, box[2], box[2]), GetLength(height, box[3], box[3]) };
            pen.affine =
                Affine_Multiply(pen.affine, FitViewBox(viewBox, Xml_GetAttribute(&svg.xml, root, "preserveAspectRatio"),
                                                       size[0], size[1]));
        }
        Inherit(&svg, root, &pen);
        svg.pen = &pen;
        DrawChildren(&svg, root, &pen);
    }
    Xml_Free(&svg.xml);
    free(svg.line);
    while (svg.clipCount > 0) {
        EndClip(&svg);
    }
}
