/* Voronoi shape functions (section 4.1 of the paper, algorithm 2; after Faure, Gilles, Bousquet, Pai 2011) on the
   cells, and weights with derivatives at any point by least squares over linked neighbours. */
#ifndef KIRI_SHAPE_H
#define KIRI_SHAPE_H

#include "region.h"

typedef struct kiriWeight {
    int32_t frame; /* index of the site */
    double value;
} kiriWeight;

typedef struct kiriShape {
    KIRI_ARRAY(int32_t) start;      /* cells + 1 */
    KIRI_ARRAY(kiriWeight) weights; /* of cell c: start[c] to start[c + 1], by frame; above zero, sum 1 */
} kiriShape;

/* From scratch. `field` as in kiriRegions_Build. Every cell with an owner gets weights. */
bool kiriShape_Build(kiriShape* shape, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                     const kiriRegions* regions, kiriField* field, const kiriSite* sites, int32_t siteCount);
void kiriShape_Release(kiriShape* shape, const kiriMemory* memory);

/* A weight at a point, with its gradient (1/m). */
typedef struct kiriPointWeight {
    int32_t frame;
    double value;
    kiriVec2 gradient;
} kiriPointWeight;

typedef KIRI_ARRAY(kiriPointWeight) kiriPointWeights;

/* Weights at a local point of the cell, by frame: moving least squares, first order, over the cell and those a
   straight or diagonal step away; never negative, sum 1 (the gradients sum to 0). Replaces what is in `out`. False
   for memory. */
bool kiriShape_At(const kiriShape* shape, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                  int32_t cell, kiriVec2 at, kiriPointWeights* out);

#endif
