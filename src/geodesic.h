/* Distances inside the cut sheet: Dijkstra over the steps of the grid. Lengths are whole numbers, so a field is the one
   fixed point of d = min(seed, d of neighbour + step), whatever the order of work. */
#ifndef KIRI_GEODESIC_H
#define KIRI_GEODESIC_H

#include "grid.h"

typedef struct kiriSeed {
    int32_t cell;
    int32_t distance; /* 0 or more */
    int32_t owner;
} kiriSeed;

/* A field over the cells of a grid. Between floods all distances are KIRI_FAR; Reset makes them so again by undoing only
   what the last flood settled. */
enum { KIRI_FAR = INT32_MAX };

typedef struct kiriField {
    KIRI_ARRAY(int32_t) distance; /* one a cell */
    KIRI_ARRAY(int32_t) owner;    /* of the nearest seed; ties go to the lower owner; KIRI_NONE where FAR */
    KIRI_ARRAY(int32_t) settled;  /* cells reached, by growing distance */
    KIRI_ARRAY(kiriSeed) seeds;   /* a heap: those that the sweep has not come to yet */
} kiriField;

/* The field is zeroed, or one that was used before, whose memory is then used again. On failure it wants a release. */
bool kiriField_Init(kiriField* field, const kiriMemory* memory, int32_t cellCount);
void kiriField_Release(kiriField* field, const kiriMemory* memory);
void kiriField_Reset(kiriField* field);

/* Floods from the seeds up to and including `limit`. `pass` (or null) says of a cell that is settled whether the flood
   goes on from it. False for memory. The field must be reset. */
typedef bool kiriPassFn(const void* context, int32_t cell);
bool kiriField_Flood(kiriField* field, const kiriMemory* memory, const kiriGrid* grid, const kiriSeed* seeds,
                     int32_t seedCount, int32_t limit, kiriPassFn* pass, const void* context);

#endif
