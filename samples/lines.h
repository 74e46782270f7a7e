/* Points and lines of the debug draw of a world, kept for a picture. */
#ifndef LINES_H
#define LINES_H

#include "kiri/kiri.h"

#include <stdbool.h>

#ifdef __cplusplus
extern "C" {
#endif

typedef struct Vertices {
    kiriDrawVertex* data;
    int32_t count, capacity;
} Vertices;

typedef struct Lines {
    Vertices points, lines; /* lines: two vertices each */
    bool isShort;           /* there was no memory for some */
} Lines;

enum { LINES_POINTS = 1, LINES_LINES = 2 }; /* kinds */

/* Adds what kiriWorld_DebugDraw draws of a sheet, 0: of all the world. False without memory. */
bool Lines_Add(Lines* lines, const kiriWorld* world, kiriSheet sheet, uint32_t flags, float size, int kinds);

/* There is nothing in it; the memory stays. */
void Lines_Clear(Lines* lines);

void Lines_Free(Lines* lines);

#ifdef __cplusplus
}
#endif

#endif
