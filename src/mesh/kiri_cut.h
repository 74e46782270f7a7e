/* Cutting (appendix A of the paper, algorithm 4): a blade walks from vertex to vertex, splits triangles and edges, and
   opens the edges behind it. Also finds the material along a straight line. */
#ifndef KIRI_CUT_H
#define KIRI_CUT_H

#include "kiri_mesh.h"

KIRI_C_BEGIN

/* A stretch of a line with the same triangles beside it. */
typedef struct kiriLinePart {
    double from, to; /* 0 to 1 along the line */
    int32_t node[2]; /* in mesh->squares.nodes: triangle to the left and to the right, in its square; or KIRI_NONE */
} kiriLinePart;

/* The part of a line that one triangle covers in one square. Private. */
typedef struct kiriLineCover {
    double from, to;
    int32_t node;
} kiriLineCover;

/* The result of a trace. Its arrays can be used again. */
typedef struct kiriLine {
    KIRI_ARRAY(kiriLinePart) parts;
    KIRI_ARRAY(kiriLineCover) covers; /* private */
    kiriIndices order[2];             /* of covers to the left and to the right, along the line. Private */
} kiriLine;

/* Finds the parts of a line with material on at least one side, in order, without overlap. It looks a 1024th of a
   square beside the line: so a line along the outline finds the inside although points are rounded, and a line along a
   cut finds both lips. The ends differ. Returns false on out of memory. */
bool kiriLine_Trace(kiriLine* line, kiriMemory* memory, const kiriMeshData* mesh, kiriLatticePoint from,
                    kiriLatticePoint to);

/* The next step of a move. */
enum kiriBladePhase {
    KIRI_BLADE_RESTS,  /* the last move is done */
    KIRI_BLADE_STARTS, /* makes a vertex where it is */
    KIRI_BLADE_AIMS,   /* finds the place where the move ends */
    KIRI_BLADE_LOOKS,  /* finds the next lip on the way */
    KIRI_BLADE_WALKS,  /* goes there, or to the end */
    KIRI_BLADE_JOINS   /* cuts from the line to a lip beside it, and comes back */
};

/* The state of a blade. */
typedef struct kiriBladeTip {
    kiriLatticePoint at;
    int32_t vertex;            /* a vertex at that point; KIRI_NONE: outside of the sheet, or not yet moved */
    int32_t phase;             /* kiriBladePhase */
    kiriLatticePoint from, to; /* line of the current move */
    kiriLatticePoint goal;     /* next place on its way; KIRI_BLADE_JOINS: the lip */
    kiriLatticePoint lip;      /* KIRI_BLADE_WALKS: the lip to join at the goal, or the goal itself. KIRI_BLADE_JOINS:
                                  the place on the line to go back to. KIRI_BLADE_LOOKS: the last lip on the way */
    int64_t owed;              /* items of finished work that are not yet paid */
    int32_t fold;              /* 0: it cuts; else it creases, for a fold line: index + 1 */
    int32_t unused;            /* always 0: fills the padding */
} kiriBladeTip;

/* Upper limit of the triangles that one step of the blade makes or reshapes: it splits one edge or triangle. With less
   quota the blade does not move. */
enum { KIRI_MOST_SPLITS = 4 };

/* Moves the blade to `to` in a straight line and cuts on the way; it may leave the sheet and come back. `snap` is the
   snap distance in lattice steps. The cut stays within half a snap of the line, and uses corners and edges of the mesh
   within a quarter. Lips and the outline attract it within 3/2: an end of the move meets the lip there, and so do the
   ends of lips that the line passes. So ends of lines at a distance of one snap always meet, and ends at a distance of
   two snaps never do. If a lip runs beside the line within the snap distance, the blade follows the lip and cuts
   nothing; where it leaves the lip, it cuts back to the line at a small angle.
   A step costs an item of the quota for each triangle that it makes or reshapes, and one if it only finds its way. It
   costs more if it tests many squares, many triangles in a square, or a vertex with many triangles. The next call pays
   the costs beyond the quota first. KIRI_MORE: the quota is below KIRI_MOST_SPLITS, and the move is incomplete; call
   again with the same `to`. The final mesh is the same as after a single call, bit for bit. KIRI_FAILED: out of memory.
   Completed steps are kept; call again with the same `to`. */
kiriProgress kiriCut_Move(kiriMeshData* mesh, kiriBladeTip* blade, kiriLatticePoint to, double snap, kiriQuota* quota);

/* Returns a blade at a lattice point, for kiriCut_Move. */
static inline kiriBladeTip kiriCut_PlaceAt(kiriLatticePoint at)
{
    kiriBladeTip blade = { at, KIRI_NONE, KIRI_BLADE_RESTS, at, at, at, at, 0, 0, 0 };
    return blade;
}

/* Returns a blade at a rest point (local), for kiriCut_Move. Positions are clamped to the range of the lattice; clip
   segments by kiriCut_Clip first if that matters. */
kiriBladeTip kiriCut_Place(const kiriMeshData* mesh, kiriVec2 local);

/* Clips the segment to the range of the lattice (the box of the sheet and half its size around it), in place. Returns
   false if nothing is left. Coordinates are local, finite, and of any size. */
bool kiriCut_Clip(const kiriMeshData* mesh, kiriVec2* from, kiriVec2* to);

KIRI_C_END

#endif
