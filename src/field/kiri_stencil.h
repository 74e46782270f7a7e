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

/* The weights of a cell and of the cells around it, for all points of the cell. */
typedef struct kiriStencil {
    int32_t cell; /* or KIRI_NONE */
    bool full;    /* all nine squares around have one cell each */
    bool split;   /* one of them has several: then the side of a cut that a point is on counts */
    bool eased;   /* see kiriShape */
    kiriVec2 middle;
    double side;
    KIRI_ARRAY(kiriStep) steps;   /* to these cells, first to the cell itself, then by square */
    KIRI_ARRAY(kiriVec2) centers; /* of their material, in squares from `middle`, where a square is split */
    kiriIndices frames;           /* that have weight in any of them, in order */
    kiriReals weights;            /* by step, then frame */
    kiriReals shares;             /* of the last point: factors of the steps */
    kiriReals values;             /* of the last point: weights of the frames; sum 1 */
    kiriIndices columns;          /* of all frames: index in `frames` plus 1, while they are gathered */
} kiriStencil;

/* Gathers the weights around a cell. False for memory: then the stencil has no cell. */
bool kiriStencil_Gather(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                        int32_t cell);

/* Puts the weights at a local point of the cell into `values`. A vertex on the lip of a cut counts as `lean` squares
   away from it, on its own side. */
void kiriStencil_Weigh(kiriStencil* stencil, kiriVec2 at, kiriVec2 lean);

/* Replaces `out` by the weights at a local point of the cell, sorted by frame: first-order moving least squares over
   the cells of a stencil, then eased. Weights are never negative and sum to 1 (gradients to 0). Fails on out of memory.
   For many points of a cell, a stencil is faster. Writes only `out` and blocks of `memory`, so threads with separate
   memories may call it concurrently. */
bool kiriShape_At(const kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, int32_t cell, kiriVec2 at,
                  kiriPointWeights* out);

KIRI_C_END

#endif
