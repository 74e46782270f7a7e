/* The update that kiri_grid.c and kiri_grid_steps.c work on. Private to them, and to saves. */
#ifndef KIRI_GRID_WORK_H
#define KIRI_GRID_WORK_H

#include "kiri_grid.h"

#include "../core/kiri_sort.h"

KIRI_C_BEGIN

/* What work costs, in parts of an item: each is about 5 ns. */
enum {
    KIRI_GRID_ITEM = 16,
    KIRI_GRID_PAYS_AT = 64 * KIRI_GRID_ITEM, /* work that may be long pauses no sooner than after so many */
    KIRI_GRID_SQUARE = 6,                    /* to look at a square, */
    KIRI_GRID_NODE = 2,                      /* or at a triangle in it; */
    KIRI_GRID_JOIN = 12,                     /* to join a triangle with its neighbours; */
    KIRI_GRID_MEASURE = 12,                  /* to measure what a triangle covers of a square, */
    KIRI_GRID_STRETCH = 18,                  /* or of its side; */
    KIRI_GRID_CELL = 24,                     /* to make or change a cell; */
    KIRI_GRID_SIDE = 20,                     /* to look at the faces on a side of a square; */
    KIRI_GRID_STEPS = 24,                    /* to make the steps of a cell, */
    KIRI_GRID_WAY = 3                        /* and to look at a way over two faces */
};

/* The least share of a square's area, or of its side, that a cell or a face is given. Whether they exist is decided
   exactly; their size is not, and may round to nothing where others divide by it. */
static const double kiriLeastShare = 1e-14;

/* Of a square in the update at hand. */
enum {
    KIRI_SQUARE_COLLECTED = 1,   /* its triangles are in `entries` */
    KIRI_SQUARE_FACES_DIRTY = 2, /* it is in the list of this name, */
    KIRI_SQUARE_LINKS_DIRTY = 4, /* or in this one; */
    KIRI_SQUARE_STEPS_DIRTY = 8, /* or its cells are in this one */
};

/* Which lists of changes a cell is in. */
enum { KIRI_CELL_MADE = 1, KIRI_CELL_MATERIAL = 2, KIRI_CELL_STEPS = 4, KIRI_CELL_EDGES = 8 };

/* Where a square's triangles are in `entries`. */
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
    kiriStretch was;
} kiriOldFace;

struct kiriGridWork {
    kiriGrowing growing; /* before an update */
    bool running, fromScratch;
    bool removed;        /* a cell is gone */
    int64_t due;         /* of what is done the quota has not given this yet */
    int32_t stage, item; /* where the update is, */
    int32_t part;        /* and which part of the item; */
    bool isAmidPart;     /* and how far that is: */
    int32_t node;        /* the next of the square's list, */
    int32_t at, other;   /* the next of one row or two */
    bool isSame;         /* the square at hand was whole and is */
    bool isCollecting;   /* the triangles of a square, and */
    bool isSorting;      /* them, by this: */
    kiriSorting sorting;
    kiriIndices sortRoom;
    bool isMerging;           /* the faces of a side */
    kiriIndices facesDirty;   /* squares with new cells */
    kiriIndices linksDirty;   /* squares where a face came or went: steps around may use it */
    kiriIndices stepsDirty;   /* cells whose steps are made again */
    kiriIndices knightsDirty; /* those of them that are not amid whole squares */

    KIRI_ARRAY(uint8_t) squareFlags;  /* of each square */
    kiriIndices flagged;              /* squares that have flags */
    KIRI_ARRAY(kiriNodeRange) ranges; /* of each square that is collected */
    kiriIndices entries;              /* of squares that are collected: nodes by triangle */
    kiriIndices parent;               /* union-find over them */

    KIRI_ARRAY(uint8_t) cellFlags; /* of each cell */
    KIRI_ARRAY(int32_t) mark;      /* of each cell, for cells that are reached in two ways; 0 to lastMark + 1 */
    int32_t lastMark;

    KIRI_ARRAY(kiriNewCell) newCells; /* of a square */
    KIRI_ARRAY(kiriOldFace) oldFaces; /* of a side */
    KIRI_ARRAY(kiriStep) steps;       /* of a cell */
};

/* ---- Stages of an update: of one item of their list ---- */

/* KIRI_MORE: the quota is spent amid the item, which is to be gone on with. Work is done first and paid for then. */
typedef kiriProgress kiriGridStageFn(kiriGrid* grid, const kiriMeshData* mesh, int32_t item, kiriQuota* quota);

/* Finds the cells from which a step may touch a square where a face came or went. */
kiriGridStageFn kiriGrid_SpreadDirty;

/* A cell's straight and diagonal steps; amid whole squares all its steps. */
kiriGridStageFn kiriGrid_MakeNearSteps;
kiriGridStageFn kiriGrid_MakeKnightSteps;

/* ---- What they need of each other. False for memory. ---- */

static inline bool kiriGridWork_IsFlagged(const kiriGridWork* work, int32_t square, int flag)
{
    KIRI_ASSERT(square >= 0 && square < work->squareFlags.count);
    return (work->squareFlags.data[square] & flag) != 0;
}

bool kiriGridWork_Flag(kiriGridWork* work, kiriMemory* memory, int32_t square, int flag);

/* Takes the due work from the quota, as far as that goes; false if some is still due. */
bool kiriGridWork_Pay(kiriGridWork* work, kiriQuota* quota);

/* Adds work that may be long. False: pause. */
static inline bool kiriGridWork_Spend(kiriGridWork* work, kiriQuota* quota, int32_t cost)
{
    work->due += cost;
    return work->due < KIRI_GRID_PAYS_AT || kiriGridWork_Pay(work, quota);
}

static inline int32_t kiriGridWork_TriangleAt(const kiriGridWork* work, const kiriMeshData* mesh, int32_t entry)
{
    KIRI_ASSERT(entry >= 0 && entry < work->entries.count);
    return mesh->squares.nodes.data[work->entries.data[entry]].triangle;
}

/* The cell's steps, or one of its faces, are no more what they were. */
bool kiriGrid_RecordSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell);

/* The cell, or the face, gets a material, or a stretch, of its own, which means nothing yet; null for memory. One that
   has its own keeps it. Pointers to others do not stay. */
kiriMoments* kiriGrid_OwnMaterial(kiriGrid* grid, kiriMemory* memory, int32_t cell);
kiriStretch* kiriGrid_OwnStretch(kiriGrid* grid, kiriMemory* memory, int32_t face);

/* Readies a grid from scratch for steps. */
void kiriGrid_StartSteps(kiriGrid* grid, const kiriMeshData* mesh);

/* Gives back the room of a cell's steps. */
void kiriGrid_RemoveSteps(kiriGrid* grid, kiriMemory* memory, int32_t cell);

KIRI_C_END

#endif
