/* The lines in which a plane that a blade sweeps meets the surface. Each goes in one piece from border to border, or as far
   as the blade goes. */
#ifndef KIRI_SECTION_H
#define KIRI_SECTION_H

#include "kiri_bounds.h"

KIRI_C_BEGIN

/* A quadrilateral in a plane, between the previous (side 0) and the current place (side 2) of an edge. Its ends move along
   the other two sides. */
enum { KIRI_SIDE_FROM, KIRI_SIDE_SECOND, KIRI_SIDE_TO, KIRI_SIDE_FIRST, KIRI_SIDES };

typedef struct kiriWindow {
    kiriVec3 normal;
    double offset;               /* the plane: normal . x = offset */
    kiriVec3 inward[KIRI_SIDES]; /* inside is inward . x >= level, for each side */
    double level[KIRI_SIDES];
    kiriBox box;
} kiriWindow;

/* Makes a window. corner: first and second end of the previous edge, then second and first end of the current one, in a
   plane; two may be the same point. `from` and `to` are points of the previous and the current edge, and determine the
   inside if the edges cross. Returns false if the window has no area. */
bool kiriWindow_Make(kiriWindow* window, const kiriVec3 corner[4], kiriVec3 from, kiriVec3 to);

/* The end of a line: a side of the window, or one of these. */
enum {
    KIRI_END_BORDER = KIRI_SIDES, /* the outline, or a lip */
    KIRI_END_LOOP                 /* the begin of the same line */
};

typedef struct kiriSectionPoint {
    kiriVec2 rest; /* local */
    kiriVec3 at;   /* world space */
} kiriSectionPoint;

typedef struct kiriSectionLine {
    int32_t first, count; /* of its points, two at least */
    int32_t end[2];       /* of its first and its last point */
    kiriVec2 out[2];      /* at a border: direction out of the material in the rest plane, unit */
} kiriSectionLine;

typedef struct kiriSection {
    KIRI_ARRAY(kiriSectionPoint) points;
    KIRI_ARRAY(kiriSectionLine) lines;
} kiriSection;

/* Appends the lines in which the surface meets the window, in the order of triangles. The bounds must fit the surface.
   Returns false on out of memory. */
bool kiriSection_Add(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                     const kiriWindow* window);

/* Replaces the section by the lines in the area that an edge sweeps from edge[0]-edge[1] to edge[3]-edge[2]. The area is
   two triangles; no line ends at their common side. */
bool kiriSection_Sweep(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                       const kiriVec3 edge[4]);

/* Appends the path of a cut along a line, from its first or its last point on. It goes past borders by `reach` (m), and
   leaves out points within `tolerance` (m) of the straight way between the points that it keeps. Returns false on out of
   memory. */
typedef KIRI_ARRAY(kiriVec2) kiriRestPoints;
bool kiriSection_Path(const kiriSection* section, const kiriSectionLine* line, bool fromLast, double reach,
                      double tolerance, kiriMemory* memory, kiriRestPoints* path);

KIRI_C_END

#endif
