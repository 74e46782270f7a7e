/* Debug draw: points, lines and triangles of the inside of a world, handed to the host in batches. */
#ifndef KIRI_DRAW_H
#define KIRI_DRAW_H

#include "kiri_world.h"

KIRI_C_BEGIN

/* Draws one sheet, or if it is null all sheets, obstacles and blades, as the flags of `draw` say. Allocates nothing. */
void kiriDraw_World(const kiriWorld* world, const kiriDebugDraw* draw, const kiriSheetData* only);

KIRI_C_END

#endif
