#include "import_parts.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

Affine Affine_Multiply(Affine a, Affine b)
{
    Affine r;
    for (int i = 0; i < 6; i++) {
        r.m[i] = a.m[i % 2] * b.m[i - i % 2] + a.m[2 + i % 2] * b.m[i - i % 2 + 1] + (i > 3 ? a.m[i] : 0.0);
    }
    return r;
}

bool Import_Reserve(void** items, int32_t* capacity, int32_t count, size_t itemSize)
{
    if (count < *capacity) {
        return true;
    }
    int32_t larger = *capacity > 0 ? 2 * *capacity : 64;
    void* grown = realloc(*items, (size_t)larger * itemSize);
    if (grown != NULL) {
        *items = grown;
        *capacity = larger;
    }
    return grown != NULL;
}

void Import_Fail(Import* drawing, const char* format, ...)
{
    if (drawing->error[0] == 0) {
        va_list words;
        va_start(words, format);
        vsnprintf(drawing->error, sizeof drawing->error, format, words);
        va_end(words);
    }
}

void Import_Skip(Import* drawing, const char* name)
{
    int32_t i = 0;
    while (i < drawing->skippedCount && strcmp(drawing->skipped[i].name, name) != 0) {
        i++;
    }
    if (i == IMPORT_MOST_SKIPPED) {
        i--;
    } else if (i == drawing->skippedCount) {
        snprintf(drawing->skipped[i].name, sizeof drawing->skipped[i].name, "%s", name);
        drawing->skippedCount++;
    }
    drawing->skipped[i].count++;
}

int32_t Import_AddStyle(Import* drawing, const char* name, int32_t use)
{
    char brief[sizeof drawing->styles[0].name];
    snprintf(brief, sizeof brief, "%s", name);
    for (int32_t i = 0; i < drawing->styleCount; i++) {
        if (strcmp(drawing->styles[i].name, brief) == 0) {
            return i;
        }
    }
    if (drawing->styleCount == IMPORT_MOST_STYLES) {
        return IMPORT_MOST_STYLES - 1;
    }
    ImportStyle* style = &drawing->styles[drawing->styleCount];
    memcpy(style->name, brief, sizeof brief);
    style->use = use;
    style->count = 0;
    return drawing->styleCount++;
}

/* ---- Lines ---- */

void Import_Begin(Import* drawing, int32_t style)
{
    if (!Import_Reserve((void**)&drawing->lines, &drawing->lineCapacity, drawing->lineCount, sizeof(ImportLine))) {
        Import_Fail(drawing, "there is no memory for the drawing");
        return;
    }
    drawing->lines[drawing->lineCount] = (ImportLine){ drawing->pointCount, 0, style, IMPORT_NONE };
}

static bool AddPoint(Import* drawing, const double point[2])
{
    if (drawing->pointCount >= IMPORT_MOST_POINTS) {
        Import_Fail(drawing, "the drawing has more than %d points", IMPORT_MOST_POINTS);
    } else if (!Import_Reserve((void**)&drawing->points, &drawing->pointCapacity, drawing->pointCount,
                               2 * sizeof(double))) {
        Import_Fail(drawing, "there is no memory for the drawing");
    }
    if (drawing->error[0] != 0) {
        return false;
    }
    memcpy(&drawing->points[2 * drawing->pointCount++], point, 2 * sizeof(double));
    return true;
}

void Import_Add(Import* drawing, double x, double y)
{
    if (drawing->error[0] != 0) {
        return;
    }
    ImportLine* line = &drawing->lines[drawing->lineCount];
    double point[2] = { x * drawing->scale, y * drawing->scale };
    if (!(fabs(point[0]) < 1e9 && fabs(point[1]) < 1e9)) { /* also NaN */
        line->use = -1;
        return;
    }
    const double* last = line->count > 0 ? &drawing->points[2 * (drawing->pointCount - 1)] : NULL;
    if (last == NULL || last[0] != point[0] || last[1] != point[1]) {
        line->count += AddPoint(drawing, point);
    }
}

void Import_End(Import* drawing, bool isClosed)
{
    if (drawing->error[0] != 0) {
        return;
    }
    ImportLine* line = &drawing->lines[drawing->lineCount];
    const double* first = &drawing->points[2 * line->first];
    if (isClosed && line->count > 1) {
        double point[2] = { first[0], first[1] };
        const double* last = &drawing->points[2 * (drawing->pointCount - 1)];
        if (last[0] != point[0] || last[1] != point[1]) {
            line->count += AddPoint(drawing, point);
        }
    }
    if (line->use < 0) {
        Import_Skip(drawing, "line beyond 1000 km");
    }
    if (line->count < 2 || line->use < 0) {
        drawing->pointCount = line->first;
        return;
    }
    drawing->styles[line->style].count++;
    drawing->lineCount++;
}

void Import_AddEllipse(Import* drawing, Affine affine, const double center[2], const double radii[2], double from,
                       double sweep)
{
    const double* m = affine.m;
    double stretch = hypot(hypot(m[0], m[1]), hypot(m[2], m[3])),
           radius = fmax(radii[0], radii[1]) * stretch * drawing->scale;
    double steps = ceil(fabs(sweep) * sqrt(fmax(radius / drawing->tolerance, 4.0) / 8.0));
    int32_t count = steps < IMPORT_MOST_STEPS ? (int32_t)fmax(steps, 1.0) : IMPORT_MOST_STEPS; /* also NaN */
    for (int32_t i = 1; i <= count && drawing->error[0] == 0; i++) {
        double angle = from + sweep * i / count;
        double x = center[0] + radii[0] * cos(angle), y = center[1] + radii[1] * sin(angle);
        Import_Add(drawing, m[0] * x + m[2] * y + m[4], m[1] * x + m[3] * y + m[5]);
    }
}

void Import_AddBezier(Import* drawing, Affine affine, const double (*points)[2], int degree)
{
    double p[4][2], bend = 0.0;
    for (int i = 0; i <= degree; i++) {
        for (int k = 0; k < 2; k++) {
            p[i][k] = affine.m[k] * points[i][0] + affine.m[2 + k] * points[i][1] + affine.m[4 + k];
        }
    }
    for (int i = 0; i + 2 <= degree; i++) {
        bend = fmax(bend, hypot(p[i][0] - 2.0 * p[i + 1][0] + p[i + 2][0], p[i][1] - 2.0 * p[i + 1][1] + p[i + 2][1]));
    }
    /* Even steps of the parameter: the second derivative is at most degree (degree - 1) bend. */
    double steps = ceil(sqrt(degree * (degree - 1) * bend * drawing->scale / (8.0 * drawing->tolerance)));
    int32_t count = steps < IMPORT_MOST_STEPS ? (int32_t)fmax(steps, 1.0) : IMPORT_MOST_STEPS;
    for (int32_t i = 1; i <= count && drawing->error[0] == 0; i++) {
        double q[4][2], t = (double)i / count;
        memcpy(q, p, sizeof q);
        for (int n = degree; n > 0 && i < count; n--) {
            for (int j = 0; j < n; j++) {
                q[j][0] += t * (q[j + 1][0] - q[j][0]);
                q[j][1] += t * (q[j + 1][1] - q[j][1]);
            }
        }
        Import_Add(drawing, i < count ? q[0][0] : p[degree][0], i < count ? q[0][1] : p[degree][1]);
    }
}

/* ---- Words and numbers ---- */

bool Import_IsSpace(char c)
{
    return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\f';
}

Span Span_Trim(Span span)
{
    while (span.length > 0 && Import_IsSpace(span.at[0])) {
        span.at++;
        span.length--;
    }
    while (span.length > 0 && Import_IsSpace(span.at[span.length - 1])) {
        span.length--;
    }
    return span;
}

bool Span_Is(Span span, const char* word)
{
    return (size_t)span.length == strlen(word) && memcmp(span.at, word, (size_t)span.length) == 0;
}

static char ToLower(char c)
{
    return c >= 'A' && c <= 'Z' ? (char)(c + 32) : c;
}

bool Span_Holds(Span span, const char* word)
{
    int32_t length = (int32_t)strlen(word);
    for (int32_t i = 0; i + length <= span.length; i++) {
        int32_t k = 0;
        while (k < length && ToLower(span.at[i + k]) == word[k]) {
            k++;
        }
        if (k == length) {
            return true;
        }
    }
    return false;
}

int32_t Import_GetUse(Span name)
{
    static const struct {
        const char* word;
        int32_t use;
    } words[] = { { "mountain", IMPORT_MOUNTAIN }, { "valley", IMPORT_VALLEY },
                  { "score", IMPORT_SCORE },       { "crease", IMPORT_SCORE },
                  { "fold", IMPORT_SCORE },        { "etch", IMPORT_SCORE },
                  { "engrav", IMPORT_SCORE },      { "perfor", IMPORT_SCORE },
                  { "guide", IMPORT_NONE },        { "cut", IMPORT_CUT } };
    for (size_t i = 0; name.at != NULL && i < sizeof words / sizeof words[0]; i++) {
        if (Span_Holds(name, words[i].word)) {
            return words[i].use;
        }
    }
    return -1;
}

const char* Import_ReadNumber(const char* at, const char* end, double* number)
{
    bool isNegative = at < end && *at == '-';
    at += at < end && (*at == '-' || *at == '+');
    const char* digits = at;
    double value = 0.0;
    int32_t places = 0, exponent = 0, count = 0;
    for (; at < end && *at >= '0' && *at <= '9'; at++, count++) {
        value = 10.0 * value + (*at - '0');
    }
    if (at < end && *at == '.') {
        for (at++; at < end && *at >= '0' && *at <= '9'; at++, count++) {
            if (value < 1e17) {
                value = 10.0 * value + (*at - '0');
                places++;
            }
        }
    }
    if (count == 0) {
        return NULL;
    }
    const char* e = at + 1;
    if (at > digits && at < end && (*at == 'e' || *at == 'E')) {
        bool isSmall = e < end && *e == '-';
        e += e < end && (*e == '-' || *e == '+');
        if (e < end && *e >= '0' && *e <= '9') {
            for (at = e; at < end && *at >= '0' && *at <= '9'; at++) {
                exponent = exponent < 1000 ? 10 * exponent + (*at - '0') : exponent;
            }
            exponent = isSmall ? -exponent : exponent;
        }
    }
    exponent -= places;
    value = exponent < 0 ? value / pow(10.0, -exponent) : value * pow(10.0, exponent);
    *number = isNegative ? -value : value;
    return at;
}

/* ---- Reading ---- */

/* Lines that a laser cutter or a paper engineer colours alike: red cuts where nothing is black. */
static void GuessUses(Import* drawing)
{
    int32_t found[IMPORT_USE_COUNT] = { 0 };
    for (int32_t i = 0; i < drawing->styleCount; i++) {
        found[drawing->styles[i].use] += drawing->styles[i].count;
    }
    for (int32_t i = 0; i < drawing->styleCount && found[IMPORT_CUT] == 0; i++) {
        ImportStyle* style = &drawing->styles[i];
        if (style->use != IMPORT_NONE && (style->use == IMPORT_MOUNTAIN || found[IMPORT_MOUNTAIN] == 0)) {
            style->use = IMPORT_CUT;
        }
    }
}

static void WriteNote(Import* drawing)
{
    size_t length = 0;
    for (int32_t i = 0; i < drawing->skippedCount && length < sizeof drawing->note; i++) {
        const ImportSkipped* skipped = &drawing->skipped[i];
        length += (size_t)snprintf(drawing->note + length, sizeof drawing->note - length, "%s%d x %s",
                                   i == 0 ? "left out: " : ", ", skipped->count, skipped->name);
    }
}

double Import_GetSize(const Import* drawing)
{
    double lower[2] = { 1e300, 1e300 }, upper[2] = { -1e300, -1e300 };
    for (int32_t i = 0; i < 2 * drawing->pointCount; i++) {
        lower[i % 2] = fmin(lower[i % 2], drawing->points[i]);
        upper[i % 2] = fmax(upper[i % 2], drawing->points[i]);
    }
    return fmax(fmax(upper[0] - lower[0], upper[1] - lower[1]), 0.0);
}

static void ReadFormat(Import* drawing, const char* at, const char* end)
{
    if (end - at > INT32_MAX) {
        Import_Fail(drawing, "the file has 2 GB or more");
    } else if (at == end) {
        Import_Fail(drawing, "the file is empty");
    } else if (*at == '<') {
        Import_ReadSvg(drawing, at, end);
        GuessUses(drawing);
    } else if (*at == '{' || *at == '[') {
        Import_ReadFold(drawing, at, end);
    } else if (end - at > 2 && (memcmp(at, "\xff\xfe", 2) == 0 || memcmp(at, "\xfe\xff", 2) == 0)) {
        Import_Fail(drawing, "this is UTF-16: save it as UTF-8");
    } else if (end - at > 2 && memcmp(at, "\x1f\x8b", 2) == 0) {
        Import_Fail(drawing, "this is compressed, as .svgz is: unpack it by gunzip");
    } else if (end - at > 18 && memcmp(at, "AutoCAD Binary DXF", 18) == 0) {
        Import_Fail(drawing, "this is a binary DXF: save it as text");
    } else if (*at >= '0' && *at <= '9') {
        Import_ReadDxf(drawing, at, end);
        GuessUses(drawing);
    } else {
        Import_Fail(drawing, "this is no SVG, DXF or FOLD");
    }
}

bool Import_Read(Import* drawing, const char* text, int64_t size, double tolerance)
{
    const char *at = text, *end = text + size;
    if (size >= 3 && memcmp(text, "\xef\xbb\xbf", 3) == 0) {
        at += 3;
    }
    while (at < end && Import_IsSpace(*at)) {
        at++;
    }
    *drawing = (Import){ .tolerance = tolerance, .scale = 1.0 };
    ReadFormat(drawing, at, end);
    double finest = Import_GetSize(drawing) / 10000.0;
    if (drawing->error[0] == 0 && drawing->lineCount > 0 &&
        finest < tolerance) { /* a small drawing: once more, finer */
        Import_Free(drawing);
        *drawing = (Import){ .tolerance = finest, .scale = 1.0 };
        ReadFormat(drawing, at, end);
    }
    WriteNote(drawing);
    bool isUsed = false;
    for (int32_t i = 0; i < drawing->lineCount; i++) {
        drawing->lines[i].use = drawing->styles[drawing->lines[i].style].use;
        isUsed = isUsed || drawing->lines[i].use != IMPORT_NONE;
    }
    if (!isUsed) {
        Import_Fail(drawing, "there is no line to cut or fold in this file%s%s", drawing->note[0] ? "; " : "",
                    drawing->note);
    }
    return drawing->error[0] == 0;
}

void Import_Free(Import* drawing)
{
    free(drawing->points);
    free(drawing->lines);
    *drawing = (Import){ .points = NULL };
}
