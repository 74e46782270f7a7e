/* The lines that the edge of a blade draws on the surface while both move. Each goes in one piece from border to border, or
   as far as the blade goes. */
#ifndef KIRI_SECTION_H
#define KIRI_SECTION_H

#include "kiri_bounds.h"

KIRI_C_BEGIN

/* Returns how far a vertex came while the edge moved. */
typedef kiriVec3 kiriCameFn(const void* context, int32_t vertex);

typedef struct kiriSweep {
    kiriVec3 was[2], is[2]; /* the edge: its ends; the two of one edge may be the same */
    kiriCameFn* came;       /* or null: the surface stays */
    const void* context;
    double reach; /* m: no vertex came farther */
} kiriSweep;

/* The end of a line. */
enum {
    KIRI_END_FROM,   /* where the edge was */
    KIRI_END_TO,     /* where it is */
    KIRI_END_FIRST,  /* the first end of the edge went over it */
    KIRI_END_SECOND, /* the second one */
    KIRI_END_BORDER, /* the outline, or a lip */
    KIRI_END_LOOP    /* the begin of the same line */
};

typedef struct kiriSectionPoint {
    kiriVec2 rest; /* local */
    kiriVec3 at;   /* world space; as the surface is now */
} kiriSectionPoint;

typedef struct kiriSectionLine {
    int32_t first, count; /* of its points, two at least */
    int32_t end[2];       /* of its first and its last point */
} kiriSectionLine;

typedef struct kiriSection {
    KIRI_ARRAY(kiriSectionPoint) points;
    KIRI_ARRAY(kiriSectionLine) lines;
} kiriSection;

/* Replaces the section by the lines of a sweep, in the order of triangles. The bounds must fit the surface. Returns false
   on out of memory. */
bool kiriSection_Sweep(kiriSection* section, kiriMemory* memory, const kiriSurface* surface, const kiriBounds* bounds,
                       const kiriSweep* sweep);

/* Appends the path of a cut along a line, from its first or its last point on. Leaves out points within `tolerance` (m) of
   the straight way between the points that it keeps. Returns false on out of memory. */
typedef KIRI_ARRAY(kiriVec2) kiriRestPoints;
bool kiriSection_Path(const kiriSection* section, const kiriSectionLine* line, bool fromLast, double tolerance,
                      kiriMemory* memory, kiriRestPoints* path);

KIRI_C_END

#endif
