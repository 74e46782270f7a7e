/* Straight and shortest ways in the rest plane of the cut sheet, in the Euclidean metric. */
#ifndef KIRI_PATH_H
#define KIRI_PATH_H

#include "kiri_grid.h"

KIRI_C_BEGIN

/* An edge of the material in a square: of the outline, or one lip of a slit. The material is to its left. */
typedef struct kiriSightEdge {
    kiriVec2 tail, head, after; /* local m; after: the head of the next edge */
    int32_t edge;               /* half-edge */
    int32_t cell;
    bool isTurn; /* the material has a corner of more than half a turn at the head, in this square */
} kiriSightEdge;

typedef struct kiriSquareEdges {
    int32_t square;
    kiriSpan edges;
} kiriSquareEdges;

/* Cache: the edges of squares, valid while mesh and grid do not change. A zeroed one is empty. */
typedef struct kiriSightEdges {
    KIRI_ARRAY(kiriSightEdge) edges;
    KIRI_ARRAY(kiriSquareEdges) squares; /* in the cache */
    kiriIndices listed;                  /* for each square of the mesh: index in `squares`, or KIRI_NONE */
    bool failed;                         /* out of memory: everything seen since then is void */
} kiriSightEdges;

/* Empties the cache for the squares of a mesh. False when out of memory. */
bool kiriSightEdges_Start(kiriSightEdges* edges, const kiriMeshData* mesh);

/* Sight is limited to squares with a cell of one of these regions: so the result depends only on things whose changes
   make one of them dirty. */
typedef struct kiriSight {
    const kiriGrid* grid;
    const int32_t* owner; /* region of each cell */
    const int32_t* regions;
    int32_t regionCount;
    kiriSightEdges* edges;
} kiriSight;

typedef enum kiriSightEnd {
    KIRI_SIGHT_CLEAR,
    KIRI_SIGHT_EDGE, /* the outline, or an open edge */
    KIRI_SIGHT_LOST  /* a square outside the regions */
} kiriSightEnd;

typedef struct kiriSightHit {
    double share; /* visible part of the way, 0 to 1 */
    int32_t edge; /* EDGE: its half-edge, which has the start of the way to its left */
} kiriSightHit;

/* Looks from p to q, local m, both in the material or on its edges. Anything within a millionth of a square's side of
   p, of q or of the way only touches it: both may lie on edges, and the way may run along one. */
kiriSightEnd kiriSight_Cast(const kiriSight* sight, kiriVec2 p, kiriVec2 q, kiriSightHit* hit);

static inline bool kiriSight_IsClear(const kiriSight* sight, kiriVec2 p, kiriVec2 q)
{
    kiriSightHit hit;
    return kiriSight_Cast(sight, p, q, &hit) == KIRI_SIGHT_CLEAR;
}

/* Returns the next edge of the material, around the head of one, or the previous edge. */
int32_t kiriSight_EdgeBeside(const kiriMeshData* mesh, int32_t h, bool ahead);

enum { KIRI_MOST_TURNS = 62, KIRI_MOST_SCANNED = 256, KIRI_WAY_TURNS = 24 };

/* A corner of the material of more than half a turn: where a shortest way may turn. The edges before and after it keep
   the material to their left; at the end of a slit they are its two sides. */
typedef struct kiriTurn {
    kiriVec2 at, before, after; /* local m */
} kiriTurn;

/* The corners in some squares, for ways between two points that are no longer than `most`. */
typedef struct kiriTurns {
    kiriVec2 from, to;
    double most; /* m */
    kiriTurn turn[KIRI_MOST_TURNS];
    int32_t count;
    int32_t scanned[KIRI_MOST_SCANNED]; /* squares */
    int32_t scannedCount;
    bool isFull; /* there are more corners than room: no way is found */
} kiriTurns;

/* A way: straight from corner to corner of the outline and of slits. */
typedef struct kiriWay {
    kiriVec2 turn[KIRI_WAY_TURNS]; /* local m, in the order of the way */
    int32_t turnCount;
    double length; /* m */
} kiriWay;

void kiriTurns_Start(kiriTurns* turns, kiriVec2 from, kiriVec2 to, double most);

/* Adds the corners in the square of a cell and in the squares around it, as far as sight goes. */
void kiriTurns_AddAround(kiriTurns* turns, const kiriSight* sight, int32_t cell);

/* Finds the shortest way over these corners; false where there is none. */
bool kiriWay_Find(const kiriTurns* turns, const kiriSight* sight, kiriWay* way);

/* Returns the point of a way after this part of its length, m. */
kiriVec2 kiriWay_At(const kiriWay* way, kiriVec2 from, kiriVec2 to, double length);

KIRI_C_END

#endif
