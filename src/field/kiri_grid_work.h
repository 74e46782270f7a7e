/* What the files of the grid share: the update at hand. Private to kiri_grid*.c. */
#ifndef KIRI_GRID_WORK_H
#define KIRI_GRID_WORK_H

#include "kiri_grid.h"

KIRI_C_BEGIN

/* The least share of a square's area, or of its side, that a cell or a face is given. Whether they exist is decided
   exactly; their size is not, and may round to nothing where others divide by it. */
static const double kiriLeastShare = 1e-14;

enum { KIRI_OPEN_STEPS = 16 }; /* steps of a cell amid whole squares */

/* Of a square in the update at hand. */
enum {
    KIRI_SQUARE_COLLECTED = 1,   /* its triangles are in `node` */
    KIRI_SQUARE_FACES_DIRTY = 2, /* it is in the list of this name, */
    KIRI_SQUARE_LINKS_DIRTY = 4, /* or in this one; */
    KIRI_SQUARE_STEPS_DIRTY = 8, /* or its cells are in this one */
};

/* Which lists of changes a cell is in. */
enum { KIRI_CELL_MADE = 1, KIRI_CELL_MATERIAL = 2, KIRI_CELL_STEPS = 4, KIRI_CELL_EDGES = 8 };

/* Where a square's triangles are in `node`. */
typedef struct kiriNodeRange {
    int32_t first, end;
} kiriNodeRange;

/* A cell as it should be, and its index. */
typedef struct kiriNewCell {
    int32_t triangle, cell;
    kiriMoments material;
} kiriNewCell;

typedef struct kiriOldFace {
    int32_t face;
    kiriFace was;
} kiriOldFace;

struct kiriGridWork {
    bool running, fromScratch;
    bool removed;             /* a cell is gone */
    int32_t stage, item;      /* where the update is */
    kiriIndices facesDirty;   /* squares with new cells */
    kiriIndices linksDirty;   /* squares where a face came or went: steps around may use it */
    kiriIndices stepsDirty;   /* cells whose steps are made again */
    kiriIndices knightsDirty; /* those of them that are not amid whole squares */

    KIRI_ARRAY(uint8_t) squareFlags;  /* of each square */
    kiriIndices flagged;              /* squares that have flags */
    KIRI_ARRAY(kiriNodeRange) ranges; /* of each square that is collected */
    kiriIndices node;                 /* of squares that are collected: nodes by triangle */
    kiriIndices parent;               /* union-find over `node` */

    KIRI_ARRAY(uint8_t) cellFlags; /* of each cell */
    KIRI_ARRAY(int64_t) mark;      /* of each cell, for cells that are reached in two ways */
    int64_t lastMark;

    KIRI_ARRAY(kiriNewCell) newCells; /* of a square */
    KIRI_ARRAY(kiriOldFace) oldFaces; /* of a side */
    KIRI_ARRAY(kiriStep) steps;       /* of a cell */
};

/* ---- Stages of an update: of one item of their list. False for memory. ---- */

/* The cells of a square that has changed. */
bool kiriGrid_MakeCells(kiriGrid* grid, const kiriMeshData* mesh, int32_t item);

/* The faces on all sides of a square with new cells. */
bool kiriGrid_MakeFaces(kiriGrid* grid, const kiriMeshData* mesh, int32_t item);

/* Finds the cells from which a step may touch a square where a face came or went. */
bool kiriGrid_SpreadDirty(kiriGrid* grid, const kiriMeshData* mesh, int32_t item);

/* A cell's straight and diagonal steps; amid whole squares all its steps. */
bool kiriGrid_MakeNearSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item);
bool kiriGrid_MakeKnightSteps(kiriGrid* grid, const kiriMeshData* mesh, int32_t item);

/* ---- What they need of each other. False for memory. ---- */

static inline bool kiriGridWork_IsFlagged(const kiriGridWork* work, int32_t square, int flag)
{
    KIRI_ASSERT(square >= 0 && square < work->squareFlags.count);
    return (work->squareFlags.data[square] & flag) != 0;
}

bool kiriGridWork_Flag(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag);

/* Puts the square in the list of a flag, once an update. */
bool kiriGridWork_AddOnce(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag, kiriIndices* list);

/* Gets a square's triangles, sorted, into `node`: where they must be known one by one. */
bool kiriGridWork_Collect(kiriGridWork* work, const kiriMeshData* mesh, int32_t square);

static inline int32_t kiriGridWork_TriangleAt(const kiriGridWork* work, const kiriMeshData* mesh, int32_t entry)
{
    KIRI_ASSERT(entry >= 0 && entry < work->node.count);
    return mesh->squares.nodes.data[work->node.data[entry]].triangle;
}

/* The cell's steps, or one of its faces, are no more what they were. */
bool kiriGrid_RecordSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell);

/* The face between two cells comes or goes. */
bool kiriGrid_RecordLink(kiriGrid* grid, kiriMemory* memory, int32_t a, int32_t b);

void kiriGrid_FreeFace(kiriGrid* grid, int32_t face);
bool kiriGrid_RemoveFace(kiriGrid* grid, kiriMemory* memory, int32_t face);

/* Gives back the room of a cell's steps. */
void kiriGrid_RemoveSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell);

KIRI_C_END

#endif
