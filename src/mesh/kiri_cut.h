/* The material along a straight line of the rest plane. */
#ifndef KIRI_CUT_H
#define KIRI_CUT_H

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

/* Cutting (appendix A of the paper, algorithm 4): a blade walks from vertex to vertex, splits what it meets, and opens
   the edges behind it. */

/* The next step of a move. */
enum kiriBladePhase {
    KIRI_BLADE_RESTS,  /* the last move is done */
    KIRI_BLADE_STARTS, /* makes a vertex where it is */
    KIRI_BLADE_AIMS,   /* finds the place where the move ends */
    KIRI_BLADE_LOOKS,  /* finds the next lip on the way */
    KIRI_BLADE_WALKS,  /* goes there, or to the end */
    KIRI_BLADE_JOINS   /* cuts from the line to a lip beside it, and comes back */
};

/* Where the blade is. */
typedef struct kiriBladeTip {
    kiriLatticePoint at;
    int32_t vertex;            /* a vertex at that point, or KIRI_NONE: not in the sheet, or not yet moved */
    int32_t phase;             /* kiriBladePhase */
    kiriLatticePoint from, to; /* the line of the move at work */
    kiriLatticePoint goal;     /* the next place on its way; KIRI_BLADE_JOINS: the lip */
    kiriLatticePoint lip;      /* KIRI_BLADE_WALKS: the lip to join at the goal, or the goal itself. KIRI_BLADE_JOINS:
                                  the place on the line to go back to. KIRI_BLADE_LOOKS: the last lip on the way */
    int64_t owed;              /* items that finished work still costs */
} kiriBladeTip;

/* A step of the blade, from vertex to vertex, splits an edge or a triangle at most: so many triangles are made or
   reshaped. Less in a quota takes the blade nowhere. */
enum { KIRI_MOST_SPLITS = 4 };

/* Moves the blade to `to` in a straight line and cuts on the way; it may leave the sheet and come back. `snap` is the
   snap distance in lattice steps. The cut keeps within half of it of the line, and takes corners and edges of the mesh
   a quarter of it away. Lips and the outline attract it from farther, by 3/2: an end of the move meets the lip there,
   and so do the ends of lips that the line passes. So ends of lines that are a snap apart always meet, and those two
   snaps apart never do. Where a lip runs beside the line within the snap distance, the blade goes along the lip and cuts
   nothing; where it leaves the lip, it cuts back to the line at a small angle.
   A step takes an item of the quota for each triangle that it makes or reshapes, and one where it finds its way
   without; and more where it looks at many squares, at many triangles in one, or around a vertex with many. What
   is more than there is left the next call takes first. KIRI_MORE: less than KIRI_MOST_SPLITS is left, and the blade is
   on its way; a call with the same `to` goes on, and in the end the mesh is what one call had made of it, bit for bit.
   KIRI_FAILED: out of memory. The blade has taken the steps that are done; a call with the same `to` goes on. */
kiriProgress kiriCut_Move(kiriMeshData* mesh, kiriBladeTip* blade, kiriLatticePoint to, double snap, kiriQuota* quota);

/* A blade at a lattice point, for kiriCut_Move. */
static inline kiriBladeTip kiriCut_PlaceAt(kiriLatticePoint at)
{
    kiriBladeTip blade = { at, KIRI_NONE, KIRI_BLADE_RESTS, at, at, at, at, 0 };
    return blade;
}

/* The blade at a rest point (local), for kiriCut_Move. Positions far outside are pulled in to the edge of
   the lattice's range; pass segments through kiriCut_Clip first where that matters. */
kiriBladeTip kiriCut_Place(const kiriMeshData* mesh, kiriVec2 local);

/* Cuts the segment down to the range of the lattice (the sheet's box and half its size around it), in place. False when
   nothing is left. Coordinates are local, finite, and of any size. */
bool kiriCut_Clip(const kiriMeshData* mesh, kiriVec2* from, kiriVec2* to);

KIRI_C_END

#endif
