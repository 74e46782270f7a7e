/* The shortest way between two points of the cut sheet, in the Euclidean metric: straight from corner to corner of the
   outline and of slits. */
#ifndef KIRI_WAY_H
#define KIRI_WAY_H

#include "kiri_sight.h"

KIRI_C_BEGIN

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
