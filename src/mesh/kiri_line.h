/* The material along a straight line of the rest plane. */
#ifndef KIRI_LINE_H
#define KIRI_LINE_H

#include "kiri_mesh.h"

KIRI_C_BEGIN

/* A stretch of the line with the same triangles beside it: from `from` to `to`, of 0 to 1 along the line. */
typedef struct kiriLinePart {
    double from, to;
    int32_t
        node[2]; /* of mesh->squares.nodes: the triangle to the left and to the right, in its square; KIRI_NONE where
                        there is no material */
} kiriLinePart;

/* What one triangle covers of the line beside it, in one square. Private. */
typedef struct kiriLineCover {
    double from, to;
    int32_t node;
} kiriLineCover;

/* What a trace finds, with the room that it needed: a later one may need no more. */
typedef struct kiriLine {
    KIRI_ARRAY(kiriLinePart) parts;
    KIRI_ARRAY(kiriLineCover) covers; /* private, as is their order along the line: of those to the left, then right */
    kiriIndices order[2];
} kiriLine;

/* The parts of the line that have material on one side at least, in order, without overlap. Material counts that lies
   a 1024th of a square beside the line: so a line along the outline finds what is inside although points are rounded
   to the lattice, and one along a cut finds both lips. The ends differ. False for memory. */
bool kiriLine_Trace(kiriLine* line, kiriMemory* memory, const kiriMeshData* mesh, kiriLatticePoint from,
                    kiriLatticePoint to);

KIRI_C_END

#endif
