/* The non-manifold grid (section 4.2 of the paper, algorithm 3). A cell is one copy of a grid square: one connected part of
   the material in it. */
#ifndef KIRI_GRID_H
#define KIRI_GRID_H

#include "mesh.h"

/* Lengths on the grid are whole numbers, so that sums are exact and a distance does not depend on the order of work. */
enum {
    KIRI_UNIT = 256,          /* the side of a square */
    KIRI_UNIT_DIAGONAL = 362, /* times sqrt 2 */
    KIRI_UNIT_KNIGHT = 572,   /* times sqrt 5 */
};

typedef struct kiriCell {
    int32_t square;
    int32_t next;         /* the next cell of the same square, or KIRI_NONE */
    int32_t piece;        /* connected over faces; numbered in the order of cells */
    int32_t triangle;     /* lowest triangle of its material */
    kiriMoments material; /* covered area and moments, about the local origin; m */
} kiriCell;

/* The material shared by two cells of neighbouring squares: the stretch of the squares' common side that it covers. */
typedef struct kiriFace {
    int32_t cell[2]; /* [0] in the square with the lower coordinate */
    int32_t next[2]; /* next face of cell[0], of cell[1], or KIRI_NONE */
    int32_t axis;    /* 0: the side is a vertical line u = const, normal +u; 1: v = const, normal +v */
    double width;    /* m, above zero */
    kiriVec2 middle; /* local m: centroid of the covered stretch, on the side */
    double moment;   /* m^3: second moment of the stretch about its middle */
} kiriFace;

/* A move of the geodesic: straight over a face, or diagonally or like a knight where every way around the corner between
   is open too. */
typedef struct kiriStep {
    int32_t cell;
    int32_t length; /* KIRI_UNIT... */
} kiriStep;

typedef struct kiriGrid {
    double side;                /* m */
    KIRI_ARRAY(kiriCell) cells; /* square by square, in one square by lowest triangle */
    KIRI_ARRAY(kiriFace) faces;
    KIRI_ARRAY(int32_t) faceHead;   /* a cell's first face, or KIRI_NONE */
    KIRI_ARRAY(int32_t) stepStart;  /* cells + 1 */
    KIRI_ARRAY(kiriStep) steps;     /* of cell c: stepStart[c] to stepStart[c + 1] */
    KIRI_ARRAY(int32_t) squareCell; /* a square's first cell, or KIRI_NONE */
    KIRI_ARRAY(int32_t) nodeCell;   /* the cell of each node of mesh->squares.nodes, or KIRI_NONE for free nodes */
    int32_t pieces;
} kiriGrid;

/* From scratch. The grid is zeroed, or one built before, whose memory is then used again. False for memory; the grid then
   holds nothing of use, and wants a release. */
bool kiriGrid_Build(kiriGrid* grid, const kiriMeshData* mesh);
void kiriGrid_Release(kiriGrid* grid, const kiriMemory* memory);

/* The cell that holds this part of this triangle; KIRI_NONE where it does not overlap the square around `at`. */
int32_t kiriGrid_CellOf(const kiriGrid* grid, const kiriMeshData* mesh, int32_t triangle, kiriPoint at);

/* The cell of a vertex: that of its fan. */
int32_t kiriGrid_CellOfVertex(const kiriGrid* grid, const kiriMeshData* mesh, int32_t vertex);

/* Middle of a cell's square, local m. */
kiriVec2 kiriGrid_Middle(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

/* A lattice point of the cell's material, well inside: it finds the material again when the cell falls apart. */
kiriPoint kiriGrid_Anchor(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

#endif
