/* The non-manifold grid (section 4.2 of the paper, algorithm 3). A cell is one copy of a grid square: one connected
   part of the material in it. */
#ifndef KIRI_GRID_H
#define KIRI_GRID_H

#include "../core/kiri_archive.h"
#include "../mesh/kiri_mesh.h"
#include "../core/kiri_array.h"
#include "../core/kiri_keep.h"

KIRI_C_BEGIN

/* Lengths on the grid are whole numbers, so that sums are exact and a distance does not depend on the order of work. */
enum {
    KIRI_UNIT = 256,          /* the side of a square */
    KIRI_UNIT_DIAGONAL = 362, /* times sqrt 2 */
    KIRI_UNIT_KNIGHT = 572,   /* times sqrt 5 */
};

typedef struct kiriCell {
    int32_t square;    /* KIRI_NONE: there is no cell of this index now */
    int32_t next;      /* the next cell of the same square, by lowest triangle, or KIRI_NONE */
    int32_t triangle;  /* lowest triangle of its material */
    int32_t firstFace; /* or KIRI_NONE */
    int32_t material;  /* its index in grid->materials; KIRI_NONE: all of a whole square, see kiriGrid_Material */
} kiriCell;

/* The material shared by two cells of neighbouring squares: a stretch of the squares' common side. */
typedef struct kiriFace {
    int32_t cell[2]; /* [0] in the square with the lower coordinate; [0] is KIRI_NONE: no face has this index now */
    int32_t next[2]; /* next face of cell[0], of cell[1], or KIRI_NONE; in no particular order */
    int32_t kind;    /* the axis (kiriFace_Axis), and twice its index in grid->stretches, from 1; 0: all of the side */
} kiriFace;

/* 0: the side is a vertical line u = const, normal +u; 1: v = const, normal +v. */
static inline int32_t kiriFace_Axis(const kiriFace* face)
{
    return face->kind & 1;
}

static inline bool kiriFace_HasOwnStretch(const kiriFace* face)
{
    return face->kind > 1;
}

/* What of its side a face covers. */
typedef struct kiriStretch {
    double width;    /* m, above zero */
    kiriVec2 middle; /* local m: its centroid, on the side */
    double moment;   /* m^3: second moment about its middle */
} kiriStretch;

/* A move of the geodesic: straight over a face, or diagonally, or like a knight in chess. The last two exist where both
   ways around the corner are open. What leads from a to b also leads from b to a. */
typedef struct kiriStep {
    int32_t cell;
    int16_t length; /* KIRI_UNIT... */
    int8_t u, v;    /* squares that it goes along each axis */
} kiriStep;

enum { KIRI_STEP_LENGTHS = 3, KIRI_OPEN_STEPS = 16 };

/* Where the steps of a cell are: straight ones from first to end[0], diagonal ones to end[1], knights to end[2]. A cell
   amid whole squares is open: it has all sixteen steps there are, each to the first cell of its square. They follow
   from its own square, and are not stored: `first` is ~square, and means nothing else. */
typedef struct kiriStepRun {
    int32_t first, end[KIRI_STEP_LENGTHS];
} kiriStepRun;

static inline bool kiriStepRun_IsOpen(const kiriStepRun* run)
{
    return run->first < 0;
}

/* The steps of an open cell, in their order; `cell` means nothing. */
extern const kiriStep kiriOpenSteps[KIRI_OPEN_STEPS];

/* The steps of a cell, stored or not: straight ones from 0 to end[0], diagonal ones to end[1], knights to end[2]. */
typedef struct kiriSteps {
    const kiriStep* data;
    int32_t end[KIRI_STEP_LENGTHS];
    kiriStep room[KIRI_OPEN_STEPS]; /* of an open cell */
} kiriSteps;

/* A cell whose material changed, and what it was. */
typedef struct kiriMaterialChange {
    int32_t cell;
    kiriMoments was;
} kiriMaterialChange;

/* What updates have done since kiriGrid_ClearChanges, complete when an update is done. A cell may be in several lists,
   in each at most once. One that is gone is in no other list, has square KIRI_NONE, and its index is not taken again
   before ClearChanges; one that came and went again is in none. */
typedef struct kiriGridChanges {
    KIRI_ARRAY(int32_t) made;                /* cells that are new */
    KIRI_ARRAY(int32_t) gone;                /* that are no more; their `material` is what it was at ClearChanges */
    KIRI_ARRAY(int32_t) steps;               /* whose steps changed, or whose faces did in anything; with new ones */
    KIRI_ARRAY(kiriMaterialChange) material; /* whose material changed; without new ones */
    KIRI_ARRAY(int32_t) edges;               /* in whose square edges of the material may have changed; with new ones */
} kiriGridChanges;

typedef struct kiriGridWork kiriGridWork; /* the update at hand: kiri_grid.h */

/* Cells keep their index as long as they live. Orders depend neither on indices nor on the order of cuts: cells are
   ordered by square, then lowest triangle. So a grid that was updated equals one from scratch, but for the indices. */
typedef struct kiriGrid {
    double side;                  /* m */
    KIRI_ARRAY(kiriCell) cells;   /* by index, with gaps */
    KIRI_ARRAY(kiriStepRun) runs; /* of each cell */
    KIRI_ARRAY(kiriStep) steps;   /* by runs, with gaps; in a run by length, then square, then lowest triangle */
    kiriSpans stepRoom;
    int32_t openTo[KIRI_OPEN_STEPS]; /* how many squares on the steps of an open cell lead */
    KIRI_ARRAY(kiriFace) faces;      /* by index, with gaps */

    /* Of cells and faces that are not those of whole squares, which most are: by index, with gaps. */
    KIRI_ARRAY(kiriMoments) materials; /* covered area and moments, about the local origin; m */
    KIRI_ARRAY(kiriStretch) stretches;
    kiriIndices unusedMaterials, unusedStretches; /* there is room for all */

    KIRI_ARRAY(int32_t) squareCell; /* a square's first cell, or KIRI_NONE */
    KIRI_ARRAY(int32_t) nodeCell;   /* the cell of each node of mesh->squares.nodes; unused ones mean nothing */
    KIRI_ARRAY(int32_t) vertexCell; /* the cell of each vertex in a square with several; others mean nothing */
    KIRI_ARRAY(uint8_t) whole;      /* of each square: wholly covered, and no outline or open edge runs through it */
    int32_t cellCount;              /* that live */
    int32_t freeCell, freeFace;     /* heads of lists, or KIRI_NONE */
    kiriGridChanges changes;
    kiriGridWork* work;
} kiriGrid;

/* The grid of the mesh as it is, from the one before and mesh->squares.dirty: all squares that changed since. A
   zeroed or reset grid is made from scratch, of all squares. An item of the quota is about 0.3 us of work: a square
   with many triangles takes many, and may take several calls; what a call does beyond its quota, some 30 items at most
   where cells have few neighbours, is taken from the next one. KIRI_MORE: call again before the mesh changes or the
   dirty squares are cleared. KIRI_FAILED: only kiriGrid_Reset helps. */
kiriProgress kiriGrid_Update(kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota);

/* Once all who follow the grid have seen its changes; not during an update. */
void kiriGrid_ClearChanges(kiriGrid* grid);

/* How far the update at hand has come, for the state hash: it is not all in what the quota has given. */
void kiriGrid_HashProgress(const kiriGrid* grid, uint64_t* hash);

/* Gives back the room of lists that were long while all was made, and that what changes makes as long as it needs. Not
   during an update, nor before its changes are cleared. */
void kiriGrid_DropScratch(kiriGrid* grid, kiriMemory* memory);

/* Forgets everything but its memory: the next update is from scratch. */
void kiriGrid_Reset(kiriGrid* grid);

/* The cells go that are listed, with all that they hang together with, and the triangles and vertices of others get
   their new index. No change is noted: of what is left nothing else changes. Not during an update, nor before its
   changes are cleared. */
void kiriGrid_Keep(kiriGrid* grid, kiriMemory* memory, const kiriKeep* triangles, const kiriKeep* vertices,
                   const int32_t* gone, int32_t goneCount);

static inline bool kiriGrid_IsCell(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT(cell >= 0 && cell < grid->cells.count);
    return grid->cells.data[cell].square != KIRI_NONE;
}

/* The first cells of squares, seen from the square of an open cell: its steps lead to [openTo[k]]. */
static inline const int32_t* kiriGrid_AroundOpen(const kiriGrid* grid, const kiriStepRun* run)
{
    KIRI_ASSERT(kiriStepRun_IsOpen(run));
    return &grid->squareCell.data[~run->first];
}

/* The steps of a cell, to be read while the grid does not change and `steps` stays where it is; of the first so many
   lengths alone. */
static inline void kiriGrid_GetStepsTo(const kiriGrid* grid, int32_t cell, int lengths, kiriSteps* steps)
{
    const kiriStepRun* run = &grid->runs.data[cell];
    if (!kiriStepRun_IsOpen(run)) {
        steps->data = grid->steps.data + run->first;
        for (int k = 0; k < KIRI_STEP_LENGTHS; ++k) {
            steps->end[k] = run->end[k] - run->first;
        }
        return;
    }
    const int32_t* around = kiriGrid_AroundOpen(grid, run);
    for (int k = 0; k < (lengths == 3 ? KIRI_OPEN_STEPS : 4 * lengths); ++k) {
        steps->room[k] = kiriOpenSteps[k];
        steps->room[k].cell = around[grid->openTo[k]];
    }
    steps->data = steps->room;
    steps->end[0] = 4;
    steps->end[1] = 8;
    steps->end[2] = KIRI_OPEN_STEPS;
}

static inline void kiriGrid_GetSteps(const kiriGrid* grid, int32_t cell, kiriSteps* steps)
{
    kiriGrid_GetStepsTo(grid, cell, KIRI_STEP_LENGTHS, steps);
}

/* The same cell, or a straight or diagonal step apart. */
static inline bool kiriGrid_AreNear(const kiriGrid* grid, int32_t a, int32_t b)
{
    kiriSteps steps;
    if (a == b) {
        return true;
    }
    kiriGrid_GetStepsTo(grid, a, 2, &steps);
    for (int32_t s = 0; s < steps.end[1]; ++s) {
        if (steps.data[s].cell == b) {
            return true;
        }
    }
    return false;
}

/* What a cell covers, about the local origin. One that is gone has what it had. */
kiriMoments kiriGrid_Material(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

/* The area and the first moments alone, the same bits: for who asks for many. */
kiriFirstMoments kiriGrid_FirstMoments(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

/* The area of it, m^2. */
static inline double kiriGrid_Area(const kiriGrid* grid, int32_t cell)
{
    int32_t material = grid->cells.data[cell].material;
    return material == KIRI_NONE ? grid->side * grid->side : grid->materials.data[material].area;
}

/* What a face covers. */
kiriStretch kiriGrid_Stretch(const kiriGrid* grid, const kiriMeshData* mesh, int32_t face);

/* A face seen from one of its cells: the cell beyond, and the next face of that one. */
static inline int32_t kiriFace_Other(const kiriFace* face, int32_t cell)
{
    KIRI_ASSERT(face->cell[0] == cell || face->cell[1] == cell);
    return face->cell[face->cell[0] == cell];
}
static inline int32_t kiriFace_Next(const kiriFace* face, int32_t cell)
{
    KIRI_ASSERT(face->cell[0] == cell || face->cell[1] == cell);
    return face->next[face->cell[1] == cell];
}

/* Does cell a come before cell b in the order of cells? */
static inline bool kiriGrid_IsBefore(const kiriGrid* grid, int32_t a, int32_t b)
{
    const kiriCell *x = &grid->cells.data[a], *y = &grid->cells.data[b];
    return x->square != y->square ? x->square < y->square : x->triangle < y->triangle;
}

/* Joins the cells of each piece in a union-find of all cells. Straight steps lead to all material of a piece, and to no
   other. */
void kiriGrid_JoinCells(const kiriGrid* grid, int32_t* parent);

void kiriGrid_SortCells(const kiriGrid* grid, int32_t* cells, int32_t count);

/* The cell that holds this part of this triangle; KIRI_NONE where it does not overlap the square around `at`. */
int32_t kiriGrid_CellOf(const kiriGrid* grid, const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

/* The cell of a vertex: that of its fan. */
int32_t kiriGrid_CellOfVertex(const kiriGrid* grid, const kiriMeshData* mesh, int32_t vertex);

/* Middle of a cell's square, local m. */
kiriVec2 kiriGrid_Middle(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

/* A lattice point of the cell's material, well inside: it finds the material again when the cell falls apart. */
kiriLatticePoint kiriGrid_Anchor(const kiriGrid* grid, const kiriMeshData* mesh, int32_t cell);

/* The cell that holds a lattice point of the material, or KIRI_NONE. */
int32_t kiriGrid_CellAt(const kiriGrid* grid, const kiriMeshData* mesh, kiriLatticePoint at);

/* The same; but a point that is not on the material gets the first cell of its square: a cut of a slanted outline may
   move the outline past it by a rounding of the lattice. KIRI_NONE in a square without material. */
int32_t kiriGrid_CellAround(const kiriGrid* grid, const kiriMeshData* mesh, kiriLatticePoint at);

/* The update that kiri_grid.c and kiri_grid.c work on. Private to them, and to saves. */

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

/* The cells on borders of regions, a list for each region: so who follows the borders of a few regions need not look at
   all their cells. A list is in no order. */

typedef struct kiriBorderCell {
    int32_t region;       /* in whose list it is, or KIRI_NONE */
    int32_t next, before; /* in that list, or KIRI_NONE */
} kiriBorderCell;

/* A zeroed one is empty. */
typedef struct kiriBorderCells {
    KIRI_ARRAY(int32_t) first; /* of each region, or KIRI_NONE */
    KIRI_ARRAY(kiriBorderCell) cells;
} kiriBorderCells;

/* Room for more cells and regions; new cells are in no list. False for memory. */
bool kiriBorderCells_Resize(kiriBorderCells* lists, kiriMemory* memory, int32_t cellCount, int32_t regionCount);

/* Puts a cell into the list of a region, and into no other; KIRI_NONE: into none. */
void kiriBorderCells_Put(kiriBorderCells* lists, int32_t cell, int32_t region);

/* Regions get their new index. No cell is in the list of one that is not kept. */
void kiriBorderCells_Keep(kiriBorderCells* lists, const kiriKeep* regions);

void kiriBorderCells_Reset(kiriBorderCells* lists);

KIRI_C_END

#endif
