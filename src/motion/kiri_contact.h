/* Contacts: points of a sheet that stay above planes, with friction. Whoever finds them (sheet/) writes rows; the
   solver finds forces. */
#ifndef KIRI_CONTACT_H
#define KIRI_CONTACT_H

#include "../field/kiri_shape.h"
#include "kiri_frame.h"

KIRI_C_BEGIN

/* The other side of contacts where it can yield: a body of a host, an obstacle, or another piece. */
typedef struct kiriYieldRow {
    int64_t number;          /* whose it is, as its finder likes */
    double inverseMass;      /* 1/kg; 0: it does not move */
    kiriMat3 inverseInertia; /* 1/(kg m^2), world, about the centre; zero: it does not turn */
    kiriVec3 center;         /* m: its centre of mass at the start of the tick */
    kiriWrench impulse;      /* N s, N m s about the centre: what sheets gave it in this tick; a step adds to it */
    int32_t pressed;         /* scratch: contacts that press on it in the step at hand, and share its mass; */
    int32_t held;            /* those that may be held up when its systems are solved */
    /* Scratch, see kiri_contact_pinned.c: pushes times the speed along them, N s m/s, of it before and after it gets
       them, and the most that they may leave it. */
    double before, after, most;
} kiriYieldRow;

enum { KIRI_CONTACT_WEIGHTS = 16 }; /* of a row: the largest, made to sum to 1 */

/* A point of the material, carried by frames with these weights, that stays above a plane. Planes are as at the start
   of the tick, and move with `velocity` and with what their yield row gets. */
typedef struct kiriContactRow {
    uint64_t key; /* the same contact has it in the next tick, and no other: so it is remembered */
    kiriWeight weights[KIRI_CONTACT_WEIGHTS]; /* largest first; all frames are of one piece */
    int32_t weightCount;                      /* 1 or more */
    int32_t yield;                            /* index of a yield row; KIRI_NONE: the plane does not yield */
    double felt;    /* 1/kg: of the yield row as felt there in any direction; below 0: as its mass and inertia say */
    double cushion; /* 1/kg: the contact is soft as if the obstacle had so much more inverse mass, but gets no recoil */
    kiriVec2 at;    /* local rest, m */
    kiriVec3 normal;   /* unit, to the side of the sheet */
    double offset;     /* m: dot(normal, x) of the plane, for x as the frames blend it: the seen point may be off that,
                          then the plane is moved by as much */
    kiriVec3 velocity; /* m/s: of the plane's material at the point */
    double friction;   /* both sides together */
    double pushSpeed;  /* m/s: how fast it is pushed out at most, where it starts below the plane */
    kiriVec3 way;      /* m: of the plane's material since the start of the tick; a step adds to it */
    kiriVec3 force;    /* N, on the sheet: remembered from the last tick, or zero; then as the last step left it */
    kiriVec3 impulse;  /* N s, on the sheet, since the start of the tick; a step adds to it */
} kiriContactRow;

KIRI_C_END

#endif
