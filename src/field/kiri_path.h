/* Straight ways in the rest plane: where they meet the outline or a slit. */
#ifndef KIRI_PATH_H
#define KIRI_PATH_H

#include "kiri_grid.h"

KIRI_C_BEGIN

/* An edge of the material in a square. */
typedef struct kiriSightEdge {
    kiriVec2 tail, head, after; /* local m; after: the head of the next edge */
    int32_t edge;               /* half-edge */
    int32_t cell;
    bool isTurn; /* the material has a corner of more than half a turn at the head, in this square */
} kiriSightEdge;

/* The edges of squares that were looked at, kept while mesh and grid do not change. A zeroed one with its memory is
   empty. */
typedef struct kiriSightEdges {
    kiriMemory* memory;
    KIRI_ARRAY(kiriSightEdge) edges;
    KIRI_ARRAY(int32_t) squares; /* that were looked at, */
    KIRI_ARRAY(kiriSpan) spans;  /* and the edges of each of these */
    KIRI_ARRAY(int32_t) listed;  /* of each square: where it is in `squares`, or KIRI_NONE */
    bool failed;                 /* for memory: what was seen since is of no use */
} kiriSightEdges;

/* Readies it for the squares of a mesh, and forgets all edges. False for memory. */
bool kiriSightEdges_Start(kiriSightEdges* edges, const kiriMeshData* mesh);

/* What may be looked at: squares that hold a cell of one of these regions. So what is seen depends on nothing that does
   not make one of them dirty. */
typedef struct kiriSight {
    const kiriGrid* grid;
    const kiriMeshData* mesh;
    const int32_t* owner; /* of each cell: its region */
    const int32_t* regions;
    int32_t regionCount;
    kiriSightEdges* edges;
} kiriSight;

typedef enum kiriSightEnd {
    KIRI_SIGHT_CLEAR,
    KIRI_SIGHT_EDGE, /* the outline, or an open edge */
    KIRI_SIGHT_LOST  /* a square that may not be looked at */
} kiriSightEnd;

/* What was met: */
typedef struct kiriSightHit {
    double share; /* how far one sees, of the way */
    int32_t edge; /* EDGE: its half-edge, which has the start of the way to its left */
} kiriSightHit;

/* Looks from p to q, local m, both in the material or on its edges. What is within a millionth of a square's side of p,
   of q or of the way only touches it: both may lie on edges, and the way may run along one. */
kiriSightEnd kiriSight_Cast(const kiriSight* sight, kiriVec2 p, kiriVec2 q, kiriSightHit* hit);

/* The edges of the material in a square, in no particular order: the outline, and both lips of slits. Each keeps the
   material to its left. They stay where they are until the next call. */
const kiriSightEdge* kiriSight_EdgesOf(const kiriSight* sight, int32_t square, int32_t* count);

kiriLatticePoint kiriSight_HeadOf(const kiriMeshData* mesh, int32_t h);

/* The next edge of the material after one, around its head, and the one before it. */
int32_t kiriSight_EdgeAfter(const kiriMeshData* mesh, int32_t h);
int32_t kiriSight_EdgeBefore(const kiriMeshData* mesh, int32_t h);

/* Is a cell of one of the regions? Has a square such a cell? */
bool kiriSight_MayLookIn(const kiriSight* sight, int32_t cell);
bool kiriSight_MayLookAt(const kiriSight* sight, int32_t square);

static inline bool kiriSight_IsClear(const kiriSight* sight, kiriVec2 p, kiriVec2 q)
{
    kiriSightHit hit;
    return kiriSight_Cast(sight, p, q, &hit) == KIRI_SIGHT_CLEAR;
}

/* The shortest way between two points of the cut sheet, in the Euclidean metric: straight from corner to corner of the
   outline and of slits. */

enum { KIRI_MOST_TURNS = 62, KIRI_MOST_SCANNED = 256, KIRI_WAY_TURNS = 24 };

/* A corner of the material of more than half a turn: where a way may turn. The edges before and after it keep the
   material to their left; at the end of a slit they are its two sides. */
typedef struct kiriTurn {
    kiriLatticePoint at, before, after;
} kiriTurn;

/* The corners in some squares, for ways between two points that are no longer than `most`. */
typedef struct kiriTurns {
    kiriVec2 from, to;
    double most; /* m */
    kiriTurn turn[KIRI_MOST_TURNS];
    int32_t count;
    int32_t scanned[KIRI_MOST_SCANNED]; /* squares */
    int32_t scannedCount;
    bool isFull; /* there are more than there is room for: no way is found */
} kiriTurns;

typedef struct kiriWay {
    kiriVec2 turn[KIRI_WAY_TURNS]; /* local m, in the order of the way */
    int32_t turnCount;
    double length; /* m */
} kiriWay;

void kiriTurns_Start(kiriTurns* turns, kiriVec2 from, kiriVec2 to, double most);

/* Adds the corners in the square of a cell and in those around it, of those that may be looked at. */
void kiriTurns_AddAround(kiriTurns* turns, const kiriSight* sight, int32_t cell);

/* The shortest way over these corners; false where there is none. */
bool kiriWay_Find(const kiriTurns* turns, const kiriSight* sight, kiriWay* way);

/* The point of a way at so much of its length. */
kiriVec2 kiriWay_At(const kiriWay* way, kiriVec2 from, kiriVec2 to, double length);

KIRI_C_END

#endif
