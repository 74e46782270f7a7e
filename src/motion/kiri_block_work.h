/* What the files of the block matrix share: its pattern, and the panels of its factor. */
#ifndef KIRI_BLOCK_WORK_H
#define KIRI_BLOCK_WORK_H

#include "kiri_block_factor.h"

#include "../core/kiri_array.h"

KIRI_C_BEGIN

/* Which blocks there are on and below the diagonal: the rows of column c are those from start[c] on, ascending, so that
   the diagonal block comes first. */
typedef struct kiriBlockPattern {
    KIRI_ARRAY(int32_t) start, row;
} kiriBlockPattern;

/* Columns that follow each other, and have the same rows below them: see kiri_panel.h. */
typedef struct kiriBlockPanel {
    int32_t column, width; /* the first one, and how many */
    int32_t row, below;    /* into `rows`: those below the columns, ascending; and how many */
    int32_t left;          /* into `left`: of panels before it, what changes this one */
    int64_t values;        /* into `factors` */
} kiriBlockPanel;

/* Rows of a panel that are columns of another one. */
typedef struct kiriBlockLeft {
    int32_t panel, first, count; /* into the panel's rows */
} kiriBlockLeft;

/* Frames have places in the order of unknowns; rows and columns are places. Blocks of the matrix lie one after the
   other, column by column, and so do the entries of a block. With ones on the diagonal of L, matrix = L D L^T, in
   panels. */
struct kiriMatrix {
    kiriMemory* memory;
    int32_t size, count;
    bool hasLongVectors;
    int64_t products, chosenProducts; /* of blocks, that a factorisation takes, and one of the chosen panels */
    KIRI_ARRAY(int32_t) place;        /* of a frame */
    kiriBlockPattern own;
    KIRI_ARRAY(kiriBlockPanel) panels; /* and one more, where all of them end */
    KIRI_ARRAY(int32_t) panelOf;       /* of each column */
    kiriIndices chosen;                /* panels with a frame that is chosen */
    kiriIndices frames;                /* that are chosen, */
    kiriIndices idle;                  /* and columns of chosen panels that are not: they are those of the identity */
    KIRI_ARRAY(uint8_t) isChosen;      /* of each panel */
    KIRI_ARRAY(int32_t) rows;
    KIRI_ARRAY(kiriBlockLeft) left;
    KIRI_ARRAY(double) values, factors, right;
    KIRI_ARRAY(double) scaled, part; /* scratch: rows of a panel times D; what is solved for, as a panel has it */
    kiriBlockPattern factor;         /* scratch: columns of the factor without padding */
    KIRI_ARRAY(int64_t) keys;        /* scratch: blocks to be sorted */
    KIRI_ARRAY(int32_t) child, sibling, mark; /* scratch: the elimination tree; where a panel has a row */
};

KIRI_C_END

#endif
