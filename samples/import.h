/* Lines to cut and to fold from drawings: SVG, DXF and FOLD. They need the C library alone.

     Import drawing;
     if (Import_Read(&drawing, text, size, 0.02)) {
         ... show drawing.styles, let the user change `use` of some ...
         Import_Join(&drawing, 0.05);
         ... cut drawing.lines ...
     } else {
         puts(drawing.error);
     }
     Import_Free(&drawing); */
#ifndef IMPORT_H
#define IMPORT_H

#include <stdbool.h>
#include <stdint.h>

/* Meanings of a line. */
enum ImportUse { IMPORT_NONE, IMPORT_CUT, IMPORT_MOUNTAIN, IMPORT_VALLEY, IMPORT_SCORE, IMPORT_USE_COUNT };

enum ImportLimit { IMPORT_MOST_STYLES = 64, IMPORT_MOST_SKIPPED = 16, IMPORT_TEXT = 200 };

/* Lines that look alike: "#ff0000 dashed", a layer, an assignment of FOLD. */
typedef struct ImportStyle {
    char name[48];
    int32_t use;   /* IMPORT_...: a guess, which the user may change before Import_Join */
    int32_t count; /* lines in the file */
} ImportStyle;

typedef struct ImportLine {
    int32_t first, count; /* points; a closed line ends with its first point */
    int32_t style, use;
} ImportLine;

typedef struct ImportSkipped {
    char name[24];
    int32_t count;
} ImportSkipped;

typedef struct Import {
    double* points; /* 2 a point, mm, y up */
    int32_t pointCount, pointCapacity;
    ImportLine* lines;
    int32_t lineCount, lineCapacity;
    ImportStyle styles[IMPORT_MOST_STYLES];
    int32_t styleCount;
    ImportSkipped skipped[IMPORT_MOST_SKIPPED];
    int32_t skippedCount;
    double tolerance;        /* mm: how far a polyline may be from its curve */
    double scale;            /* mm: of a unit of the reader */
    int32_t isSized;         /* 1: the file has units. Else a unit of SVG is a pixel, other units are millimetres */
    char note[IMPORT_TEXT];  /* one line that counts the parts left out; or "" */
    char error[IMPORT_TEXT]; /* one line; or "" */
} Import;

/* Reads a drawing; the text says which format. tolerance: mm, above 0; for small drawings a 10000th of their size.
   False: `error` says why. Free it in any case. */
bool Import_Read(Import* drawing, const char* text, int64_t size, double tolerance);

/* Keeps the lines whose style has a use. Removes doubled parts: of a cut and a fold the cut stays. Joins ends that are
   nearer than `distance` (mm; for small drawings a 10000th of their size). Sorts: cuts first, inner before outer. */
bool Import_Join(Import* drawing, double distance);

/* mm: the longer side of the box around all points. */
double Import_GetSize(const Import* drawing);

void Import_Free(Import* drawing);

#endif
