/* What the world keeps of pairs, see kiri_pair.h. */
#ifndef KIRI_PAIR_DATA_H
#define KIRI_PAIR_DATA_H

#include "../sheet/kiri_sheet.h"

KIRI_C_BEGIN

/* A piece as others may touch it. */
typedef struct kiriBody {
    kiriSheetData* sheet;
    int32_t piece;
    kiriFrame id; /* of the lowest frame of the piece: names it from tick to tick */
    kiriBox box;
    double speed;      /* m/s: of its fastest probe, */
    double stir;       /* m/s: and that beside its mean velocity */
    kiriVec3 momentum; /* N s, */
    double mass;       /* kg */
    bool asleep;
    double least;   /* m/s: how fast it rises at least in the tick, for what it will be stopped by */
    bool isCarried; /* does it lie on anything? */
    bool isHeld;    /* by a pin or by the host */
} kiriBody;

/* A probe of one body and the nearest place on another. */
typedef struct kiriNear {
    int32_t body, other; /* indices */
    int32_t vertex;      /* of `body` */
    int32_t triangle;    /* of `other`, */
    double share[3];     /* and barycentric coordinates in it */
    kiriVec3 normal;     /* of the triangle as it lies in the rest plane */
    double height;       /* m: of the probe above the triangle, along the normal */
} kiriNear;

/* Two pieces near each other. */
typedef struct kiriTouchingPair {
    kiriFrame upper, lower; /* ids of bodies */
    int32_t side;           /* 1, -1: the upper one is where the normals of the lower one point, or opposite */
    int32_t touches;        /* do they touch, or are about to? Then they wake and sleep together */
    int32_t bodies[2];      /* indices of upper and lower, */
    kiriSpan nears;         /* and what was found, in the tick at hand alone */
} kiriTouchingPair;

typedef KIRI_ARRAY(kiriTouchingPair) kiriTouchingPairs;

/* A place of a sheet: of a triangle, or a vertex alone. */
typedef struct kiriPlace3 {
    kiriSheetData* sheet;
    int32_t vertex[3]; /* KIRI_NONE where there are fewer */
    double share[3];
} kiriPlace3;

/* Where the upper one of a pair touches the lower one, or may in the coming tick. */
typedef struct kiriPairTouch {
    kiriPlace3 upper, lower;
    int32_t bodies[2]; /* of these */
    uint64_t key;
    kiriVec3 normal;   /* unit, to the upper one */
    kiriVec3 velocity; /* of the lower place */
    double gap;        /* m, of the places along the normal */
    double
        lift; /* m/s: how fast the lower one rises along it as a whole; 0: it lies on something, and only springs up */
    int32_t touch; /* index in what touches the upper sheet */
} kiriPairTouch;

/* What of the push of a touch the lower one feels. */
typedef struct kiriFeltPush {
    uint64_t key;
    kiriVec3 force; /* N, on the upper one */
} kiriFeltPush;

/* A piece that is awake; and, at the lowest of them, pieces that touch each other, directly or by others. */
typedef struct kiriIsland {
    double mass, kinetic;    /* kg, J: of the piece; */
    double gained, passed;   /* J: see kiriSolver_AddGained */
    double keep, keepPush;   /* of its velocities, by the limit of energy, and of its push on others */
    double pushed;           /* N s: of planes of other pieces on it, the sum of sizes; */
    kiriVec3 push;           /* and the sum */
    double calm;             /* s: of the least calm piece */
    bool isHeld;             /* is one held by a pin, the host or an obstacle? */
    int32_t pieces;          /* how many */
    double surplus, sources; /* J: gained out of nothing; by the pieces that gained in all */
    double moving, mostHeat; /* J, of all; J/kg, of the fastest piece, were it not for the others */
    double whole, left;      /* kg; J, of all motion when pieces are limited */
    kiriVec3 mean, velocity; /* m/s, of their centre of mass: then; and as it is due by their momentum, */
    double keepBeside;       /* and how much is kept of what velocities have beside that */
} kiriIsland;

/* See kiri_pair.h. */
typedef struct kiriPairs {
    kiriTouchingPairs pairs, next; /* in force, and as found for the coming tick; sorted by ids */
    kiriTouchingPairs found;       /* before they are sorted */
    KIRI_ARRAY(kiriBody) bodies;
    kiriIndices order; /* of bodies, by the lower end of their box along x */
    KIRI_ARRAY(kiriNear) nears;
    kiriIndices parents;            /* of pieces that are awake: which touch each other, */
    KIRI_ARRAY(kiriIsland) islands; /* and what these have together, at the lowest of them */
    KIRI_ARRAY(kiriPairTouch) touches;
    KIRI_ARRAY(kiriFeltPush) felt, nextFelt; /* by key */
} kiriPairs;

KIRI_C_END

#endif
