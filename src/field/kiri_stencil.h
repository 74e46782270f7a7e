/* Weights with derivatives at any point of the sheet: moving least squares over the weights of linked cells (section
   4.2 of the paper). */
#ifndef KIRI_STENCIL_H
#define KIRI_STENCIL_H

#include "kiri_shape.h"

KIRI_C_BEGIN

/* A weight at a point, with its gradient (1/m). */
typedef struct kiriPointWeight {
    int32_t frame;
    double value;
    kiriVec2 gradient;
} kiriPointWeight;

typedef KIRI_ARRAY(kiriPointWeight) kiriPointWeights;

/* What the points of one cell have in common: the weights of the cell and of those a straight or diagonal step away. */
typedef struct kiriStencil {
    int32_t cell; /* or KIRI_NONE */
    bool full;    /* all nine squares around have one cell each */
    bool split;   /* one of them has several: then which side of a cut a point is on counts */
    bool eased;   /* see kiriShape */
    kiriVec2 middle;
    double side;
    KIRI_ARRAY(kiriStep) steps;   /* to these cells, first to the cell itself, then by square */
    KIRI_ARRAY(kiriVec2) centers; /* of their material, in squares from `middle`, where a square is split */
    KIRI_ARRAY(int32_t) frames;   /* that have weight in any of them, in order */
    KIRI_ARRAY(double) weights;   /* by step, then frame */
    KIRI_ARRAY(double) shares;    /* of the point at hand: what each step, */
    KIRI_ARRAY(double) values;    /* and what each frame counts there; sum 1 */
    KIRI_ARRAY(int32_t) columns;  /* of all frames: place in `frames` plus 1, while they are gathered */
} kiriStencil;

/* Gathers the weights around a cell. False for memory: then the stencil has no cell. */
bool kiriStencil_Gather(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                        const kiriMeshData* mesh, int32_t cell);

/* The weights at a local point of the cell into `values`. `lean` says from where a point at the lip of a cut is looked
   at: so many squares away from it, on its own side. With 0 as kiriShape_At has them. */
void kiriStencil_Weigh(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean);

/* Weights at a local point of the cell, by frame: moving least squares, first order, over the cell and those of
   a stencil, then eased; never negative, sum 1 (the gradients sum to 0). Replaces what is in `out`. False
   for memory. Many points of a cell are quicker with a stencil. Writes nothing but `out` and blocks of `memory`:
   threads may ask at the same time, each with memory of its own. */
bool kiriShape_At(const kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                  int32_t cell, kiriVec2 at, kiriPointWeights* out);

KIRI_C_END

#endif
