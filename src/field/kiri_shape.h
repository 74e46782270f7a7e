/* Shape functions: weights of the frames (section 4.1 of the paper, algorithm 2; after Faure, Gilles, Bousquet, Pai
   2011) on the cells, and weights with derivatives at any point by least squares over linked neighbours. */
#ifndef KIRI_SHAPE_H
#define KIRI_SHAPE_H

#include "kiri_region.h"

typedef struct kiriWeight {
    int32_t frame; /* index of the site */
    double value;
} kiriWeight;

/* A weight at a cell, and what it was before the weights there were made to sum to 1. */
typedef struct kiriCellWeight {
    int32_t frame;
    double value, raw;
} kiriCellWeight;

/* How far a cell is from a frame's site, and from the border of its region. */
typedef struct kiriReach {
    int32_t cell, fromSite, fromBorder;
} kiriReach;

typedef KIRI_ARRAY(kiriReach) kiriReaches;

typedef struct kiriShapeWork kiriShapeWork; /* private to shape.c */

typedef struct kiriShape {
    KIRI_ARRAY(kiriSpan) spans;         /* of each cell: its weights */
    KIRI_ARRAY(kiriCellWeight) weights; /* by spans; in a span by frame; above zero, sum of values 1 */
    kiriSpans room;
    KIRI_ARRAY(kiriReaches) reaches; /* of each frame: the cells that its distances reach, in no order */

    /* Of each frame: the cells in which its weight exceeds rigidWeight, as shares of whole squares, in units of 2^-40:
       a whole number, so that it does not depend on the order of adding. */
    KIRI_ARRAY(int64_t) rigid;
    double rigidWeight; /* set before the first update */

    /* Since kiriShape_ClearChanges: live cells, each once, whose weights changed or which are in the grid's made or
       restepped. */
    KIRI_ARRAY(int32_t) changes;
    int64_t recomputed; /* and for how many of them a weight was computed */
    kiriShapeWork* work;
} kiriShape;

/* Follows the changes of grid and regions (which are settled after it): costs what it touches, and a look at the cells
   of frames near by. `moves` as in kiriRegions_Update: distances to such a site are made from scratch. An item of the
   quota is a cell whose distance is taken away, given or flooded, a weight put in its place, or a cell that gets room
   for its first weights or whose weights are made to sum to 1. Every cell with an owner gets weights. KIRI_MORE: call
   again before grid, regions or sites change. On KIRI_FAILED only Reset or Release make sense. */
kiriProgress kiriShape_Update(kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                              const kiriRegions* regions, const kiriSite* sites, int32_t siteCount,
                              const kiriSiteMove* moves, int32_t moveCount, kiriQuota* quota);
void kiriShape_ClearChanges(kiriShape* shape);
void kiriShape_Reset(kiriShape* shape);

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
    kiriVec2 middle;
    double side;
    KIRI_ARRAY(kiriStep) steps;  /* to these cells, first to the cell itself */
    KIRI_ARRAY(int32_t) frames;  /* that have weight in any of them, in order */
    KIRI_ARRAY(double) weights;  /* by step, then frame */
    KIRI_ARRAY(double) shares;   /* of the point at hand: what each step, */
    KIRI_ARRAY(double) values;   /* and what each frame counts there; sum 1 */
    KIRI_ARRAY(int32_t) columns; /* of all frames: place in `frames` plus 1, while they are gathered */
} kiriStencil;

/* Gathers the weights around a cell. False for memory: then the stencil has no cell. */
bool kiriStencil_Gather(kiriStencil* stencil, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                        const kiriMeshData* mesh, int32_t cell);

/* The weights at a local point of the cell, as kiriShape_At has them, into `values`. */
void kiriStencil_Weigh(kiriStencil* stencil, kiriVec2 at);

/* Weights at a local point of the cell, by frame: moving least squares, first order, over the cell and those a
   straight or diagonal step away; never negative, sum 1 (the gradients sum to 0). Replaces what is in `out`. False
   for memory. Many points of a cell are quicker with a stencil. */
bool kiriShape_At(const kiriShape* shape, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                  int32_t cell, kiriVec2 at, kiriPointWeights* out);

#endif
