/* What hosts see of the inside of a world: points, lines and triangles, handed to them in batches. */
#ifndef KIRI_DRAW_H
#define KIRI_DRAW_H

#include "kiri_world.h"

KIRI_C_BEGIN

enum { KIRI_DRAW_BATCH = 240 }; /* vertices: whole lines and triangles */

typedef struct kiriDrawBatch {
    kiriDrawFn* draw; /* or null: nothing is drawn */
    void* user;
    int32_t count;
    kiriDrawVertex vertices[KIRI_DRAW_BATCH];
} kiriDrawBatch;

typedef struct kiriDrawing {
    const kiriWorld* world;
    uint32_t flags; /* KIRI_DRAW_... */
    double size;    /* m, of axes and normals */
    kiriDrawBatch points, lines, triangles;
} kiriDrawing;

void kiriDrawing_Point(kiriDrawing* drawing, kiriVec3 at, uint32_t color);
void kiriDrawing_Line(kiriDrawing* drawing, kiriVec3 from, kiriVec3 to, uint32_t color);
void kiriDrawing_Triangle(kiriDrawing* drawing, const kiriVec3 corners[3], uint32_t color);

/* The host gets what it has not got yet. */
void kiriDrawing_End(kiriDrawing* drawing);

/* What the flags ask for. */
void kiriDrawing_Sheet(kiriDrawing* drawing, const kiriSheetData* sheet);
void kiriDrawing_Obstacles(kiriDrawing* drawing);
void kiriDrawing_Blades(kiriDrawing* drawing);

static inline uint32_t kiriDrawing_Color(uint32_t red, uint32_t green, uint32_t blue)
{
    return 0xff000000u | blue << 16 | green << 8 | red;
}

/* The nearest place of a piece to a point. */

/* Finds the place of the other body nearest to the probe, whose vertex and bodies are set. False where there is none
   within `reach`, or where it is the border of the other body and the probe lies beside it rather than above it or
   below. Of places equally near that of the lower triangle is taken. `distance` is what the two keep; the bounds of the
   other one are fresh. */
bool kiriNearest_Find(kiriNear* near, const kiriBody* bodies, double reach, double distance);

KIRI_C_END

#endif
