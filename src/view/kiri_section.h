/* Where a plane that a blade sweeps meets the surface: lines through the material, each in one piece from border to
   border, or as far as the blade goes. */
#ifndef KIRI_SECTION_H
#define KIRI_SECTION_H

#include "kiri_bounds.h"

KIRI_C_BEGIN

/* A part of a plane: a quadrilateral between where an edge was (side 0) and where it is now (side 2). On the other two
   sides are the ways of its ends. */
enum { KIRI_SIDE_FROM, KIRI_SIDE_SECOND, KIRI_SIDE_TO, KIRI_SIDE_FIRST, KIRI_SIDES };

typedef struct kiriWindow {
    kiriVec3 normal;
    double offset;               /* the plane: normal . x = offset */
    kiriVec3 inward[KIRI_SIDES]; /* inside is inward . x >= level, for each side */
    double level[KIRI_SIDES];
    kiriBox box;
} kiriWindow;

/* corner: first and second end of the edge as it was, then second and first as it is, in a plane; two may be the same
   point. `from` and `to` lie on the edge as it was and as it is, and say where inside is: where the two edges cross, it
   is their part of the two triangles. False where there is no area. */
bool kiriWindow_Make(kiriWindow* window, const kiriVec3 corner[4], kiriVec3 from, kiriVec3 to);

/* What a line ends at: a side of the window, or one of these. */
enum {
    KIRI_END_BORDER = KIRI_SIDES, /* there the material ends: at the outline, or at a lip */
    KIRI_END_LOOP                 /* where the line begins */
};

typedef struct kiriSectionPoint {
    kiriVec2 rest; /* local */
    kiriVec3 at;   /* where it is seen */
} kiriSectionPoint;

typedef struct kiriSectionLine {
    int32_t first, count; /* of points: two at least */
    int32_t end[2];       /* what its first and its last point end at */
    kiriVec2 out[2];      /* at a border: the way out of the material in the rest plane, a unit vector */
} kiriSectionLine;

typedef struct kiriSection {
    KIRI_ARRAY(kiriSectionPoint) points;
    KIRI_ARRAY(kiriSectionLine) lines;
} kiriSection;

/* Appends the lines in which the surface meets the window, in the order of triangles. The bounds must fit the surface.
   False for memory. */
bool kiriSection_Add(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                     const kiriWindow* window);

/* Replaces the section by that with what an edge sweeps, from edge[0]-edge[1] to edge[3]-edge[2]: with two triangles,
   whose common side no line ends at. */
bool kiriSection_Sweep(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                       const kiriVec3 edge[4]);

/* Appends the way of a cut along a line, from its first point on or from its last: past borders by `reach` (m), and
   without points that lie within `tolerance` (m) of the straight way between those that stay. False for memory. */
typedef KIRI_ARRAY(kiriVec2) kiriRestPoints;
bool kiriSection_Path(const kiriSection* section, const kiriSectionLine* line, bool fromLast, double reach,
                      double tolerance, kiriMemory* memory, kiriRestPoints* path);

KIRI_C_END

#endif
