/* The squares of the regular grid, and for each the triangles whose interior overlaps its interior (exactly). It finds
   the triangle under a point, the edges near a blade, and the material of the cells. It also knows which squares have
   changed, so that a cut costs no more than what it passes through, and which vertices are in a square. */
#ifndef KIRI_SQUARE_H
#define KIRI_SQUARE_H

#include "../core/kiri_keep.h"
#include "../core/kiri_vec.h"

KIRI_C_BEGIN

/* One triangle in one square. */
typedef struct kiriSquareNode {
    int32_t triangle;
    int32_t next; /* in the same square, or KIRI_NONE */
} kiriSquareNode;

/* What a node or a head was before a change. */
typedef struct kiriSquareUndo {
    int32_t index; /* the node's slot; or ~square, whose head was `was.next` */
    kiriSquareNode was;
} kiriSquareUndo;

/* As far as steps lead: so rows that follow each other are never near by their numbers alone. */
enum { KIRI_SQUARES_BESIDE = 2 };

/* About ns: to pass a node of a list; to look whether something is in a square, and to change its list. */
enum { KIRI_NODE_EFFORT = 1, KIRI_SQUARE_EFFORT = 8 };

typedef struct kiriSquares {
    int32_t columns, rows;
    int32_t firstColumn, firstRow; /* where they begin: a part of a sheet has those around it alone */
    int32_t side;                  /* lattice steps, even; grid line k lies at k * side - 1 */
    double perStep;                /* 1 / side */
    int32_t* head;                 /* a square's first node, or KIRI_NONE; columns * rows, row by row */
    KIRI_ARRAY(kiriSquareNode) nodes;
    int32_t freeNode;
    int32_t* vertexHead;       /* a square's first vertex, or KIRI_NONE: see kiriVertex */
    KIRI_ARRAY(int32_t) dirty; /* squares that have changed since ClearDirty, each once; there is room for all */
    uint8_t* isDirty;          /* of each square: is it in `dirty`? */
    int64_t effort;            /* what changes have cost so far, in about ns */

    /* For Rollback: the changes since Begin in their order, and what was then. */
    bool isOpen;
    KIRI_ARRAY(kiriSquareUndo) undo;
    int32_t oldNodeCount, oldFreeNode;
    int32_t oldDirtyCount; /* KIRI_NONE: ClearDirty has been called since */
} kiriSquares;

/* `resolution` squares along the longer of the two extents (lattice steps, from 0). */
bool kiriSquares_Init(kiriSquares* squares, kiriMemory* memory, kiriLatticePoint extent, int32_t resolution);

/* Of these squares those around the box between two points, and KIRI_SQUARES_BESIDE more on each side as far as there
   are any; without triangles and vertices. */
bool kiriSquares_InitPart(kiriSquares* squares, kiriMemory* memory, const kiriSquares* like, kiriLatticePoint lower,
                          kiriLatticePoint upper);

/* The triangle's corners are counter-clockwise. Both make the squares dirty that the triangle overlaps or has
   overlapped, and fail only for memory: then some squares have changed and some have not, and the caller rolls back or
   gives up the squares. To take a triangle out of a square its list is walked; one that stays in a square keeps its
   place there. */
bool kiriSquares_Insert(kiriSquares* squares, kiriMemory* memory, int32_t triangle, const kiriLatticePoint corners[3]);
bool kiriSquares_Reshape(kiriSquares* squares, kiriMemory* memory, int32_t triangle, const kiriLatticePoint was[3],
                         const kiriLatticePoint is[3]);

/* Rollback restores what was at Begin, slot for slot, vertices aside: others (the grid) keep arrays by node. Squares
   that became dirty since are clean again; where ClearDirty has been called since, all are dirty, for somebody has read
   what is now taken back. It needs no memory. After it changes are noted again, until Commit. */
void kiriSquares_Begin(kiriSquares* squares);
void kiriSquares_Commit(kiriSquares* squares);
void kiriSquares_Rollback(kiriSquares* squares);

/* Triangles are taken away that are all in these squares, and the others get their new index. No square becomes dirty.
   Not between Begin and Commit. */
void kiriSquares_Keep(kiriSquares* squares, const kiriKeep* triangles, const int32_t* of, int32_t count);

/* Makes the squares dirty whose open interior the edge between two vertices runs through. */
void kiriSquares_MarkEdgeDirty(kiriSquares* squares, kiriLatticePoint a, kiriLatticePoint b);
void kiriSquares_ClearDirty(kiriSquares* squares);

/* Does the segment run through the open square? Exact; neither end may be on a grid line. */
bool kiriSquares_RunsThrough(const kiriSquares* squares, int32_t square, kiriLatticePoint a, kiriLatticePoint b);

/* The square around a vertex position, or KIRI_NONE outside the grid. */
int32_t kiriSquares_At(const kiriSquares* squares, kiriLatticePoint p);

/* The square of a part that is this one of the squares that it is of; it is among them. */
int32_t kiriSquares_InPart(const kiriSquares* part, const kiriSquares* whole, int32_t square);

/* How many triangles overlap a square. */
int32_t kiriSquares_CountNodes(const kiriSquares* squares, int32_t square);

/* The lower corner of a square (odd coordinates). */
static inline kiriLatticePoint kiriSquares_Corner(const kiriSquares* squares, int32_t square)
{
    int32_t row = square / squares->columns, column = square - row * squares->columns;
    KIRI_ASSERT(square >= 0 && row < squares->rows);
    return (kiriLatticePoint){ (squares->firstColumn + column) * squares->side - 1,
                               (squares->firstRow + row) * squares->side - 1 };
}

/* Do the interiors overlap? Exact. */
bool kiriSquares_Overlap(const kiriSquares* squares, int32_t square, const kiriLatticePoint corners[3]);

/* The squares that a triangle overlaps, of those in its box: bit k is the k-th, row by row. */
typedef struct kiriOverlaps {
    int32_t row, column,
        columns;  /* of the first square in the box, and how many columns; 0: too many squares for bits */
    int32_t left; /* of whoever goes over them */
    uint64_t bits;
} kiriOverlaps;

enum { KIRI_FEW_SQUARES = 64 };

typedef struct kiriSquarePlace {
    int32_t column, row;
} kiriSquarePlace;

/* `in`: the squares that the corners are in. False, and all is zero, where the box has more squares than these. */
bool kiriSquares_FindOverlaps(const kiriSquares* squares, const kiriLatticePoint corners[3],
                              const kiriSquarePlace in[3], kiriOverlaps* overlaps);

/* How many squares it overlaps. */
int64_t kiriSquares_CountOverlaps(const kiriSquares* squares, const kiriLatticePoint corners[3]);

KIRI_C_END

#endif
