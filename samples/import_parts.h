/* For the readers of import.h: one file for each format. */
#ifndef IMPORT_PARTS_H
#define IMPORT_PARTS_H

#include "import.h"

#include <stddef.h>

/* A circle of 1 km within 0.02 mm has 16000 steps. */
enum { IMPORT_MOST_POINTS = 4000000, IMPORT_MOST_STEPS = 20000, IMPORT_MOST_DEPTH = 64 };

/* Part of the text. */
typedef struct Span {
    const char* at;
    int32_t length;
} Span;

/* x' = m[0] x + m[2] y + m[4], y' = m[1] x + m[3] y + m[5]. */
typedef struct Affine {
    double m[6];
} Affine;

Affine Affine_Multiply(Affine a, Affine b); /* b first */

/* Room for one more item: false without memory. */
bool Import_Reserve(void** items, int32_t* capacity, int32_t count, size_t itemSize);

/* The first error stays. */
void Import_Fail(Import* drawing, const char* format, ...);
void Import_Skip(Import* drawing, const char* name);
int32_t Import_AddStyle(Import* drawing, const char* name, int32_t use);

/* A line: its style, its points, its end. One without length is dropped. */
void Import_Begin(Import* drawing, int32_t style);
void Import_Add(Import* drawing, double x, double y);
void Import_End(Import* drawing, bool isClosed);

/* The points after the first one of a curve, in the drawing by `affine`. Angles in radians. */
void Import_AddEllipse(Import* drawing, Affine affine, const double center[2], const double radii[2], double from,
                       double sweep);
void Import_AddBezier(Import* drawing, Affine affine, const double (*points)[2], int degree);

bool Import_IsSpace(char c);
Span Span_Trim(Span span);

/* Whether a span is the word, or holds it in any case of letters (the word in small ones). */
bool Span_Is(Span span, const char* word);
bool Span_Holds(Span span, const char* word);

/* Red, green, blue and opacity from 0 to 255; false: not a colour, and black. */
bool Import_ReadColor(Span text, int rgba[4]);

/* Black cuts, red is a mountain, blue a valley, green a score; white is paper. */
int32_t Import_UseOfColor(const int rgb[3]);

/* The use that the name of a layer says; -1: none. */
int32_t Import_GetUse(Span name);

/* Reads a number whatever the locale is, and returns its end; null: there is none. */
const char* Import_ReadNumber(const char* at, const char* end, double* number);

void Import_ReadSvg(Import* drawing, const char* text, const char* end);
void Import_ReadDxf(Import* drawing, const char* text, const char* end);
void Import_ReadFold(Import* drawing, const char* text, const char* end);

#endif
