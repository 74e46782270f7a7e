/* A drawing by calls without structs, for paths.js. */
#include "../import.h"

#include <stddef.h>

static Import drawing;

/* 1: read. 0: getText says why. */
int32_t readDrawing(const char* text, int32_t size, double tolerance)
{
    Import_Free(&drawing);
    return Import_Read(&drawing, text, size, tolerance);
}

int32_t joinDrawing(double distance)
{
    return Import_Join(&drawing, distance);
}

/* The error, or else the note. */
const char* getText(void)
{
    return drawing.error[0] != 0 ? drawing.error : drawing.note;
}

/* The table: getNumber(4) bytes a style; the use and the count are 32-bit numbers, getNumber(5) bytes behind its name. */
ImportStyle* getStyles(void)
{
    return drawing.styles;
}

/* Lines of 4 numbers, and points of 2. */
const ImportLine* getLines(void)
{
    return drawing.lines;
}

const double* getPoints(void)
{
    return drawing.points;
}

/* 0: styles, 1: lines, 2: points, 3: whether the file has units; 4 and 5: see getStyles. */
int32_t getNumber(int32_t which)
{
    const int32_t numbers[] = { drawing.styleCount,           drawing.lineCount,
                                drawing.pointCount,           drawing.isSized,
                                (int32_t)sizeof(ImportStyle), (int32_t)offsetof(ImportStyle, use) };
    return which >= 0 && which < (int32_t)(sizeof numbers / sizeof numbers[0]) ? numbers[which] : 0;
}
