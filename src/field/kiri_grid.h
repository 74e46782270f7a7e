/* The non-manifold grid (section 4.2 of the paper, algorithm 3). A cell is one copy of a grid square: one connected
   part of the material in it. */
#ifndef KIRI_GRID_H
#define KIRI_GRID_H

#include "../core/kiri_archive.h"
#include "../mesh/kiri_mesh.h"
#include "../core/kiri_array.h"

KIRI_C_BEGIN

/* Lengths on the grid are whole numbers, so that sums are exact and a distance does not depend on the order of work. */
enum {
    KIRI_UNIT = 256,          /* the side of a square */
    KIRI_UNIT_DIAGONAL = 362, /* times sqrt 2 */
    KIRI_UNIT_KNIGHT = 572,   /* times sqrt 5 */
};

typedef struct kiriCell {
    int32_t square;    /* KIRI_NONE: this index is not in use */
    int32_t next;      /* the next cell of the same square, by lowest triangle, or KIRI_NONE */
    int32_t triangle;  /* lowest triangle of its material */
    int32_t firstFace; /* or KIRI_NONE */
    int32_t material;  /* index in grid->materials; KIRI_NONE: all of a whole square, see kiriGrid_Material */
} kiriCell;

/* The material shared by two cells of neighbouring squares: a stretch of the squares' common side. */
typedef struct kiriFace {
    int32_t cell[2]; /* [0] in the square with the lower coordinate; [0] is KIRI_NONE: this index is not in use */
    int32_t next[2]; /* next face of cell[0], of cell[1], or KIRI_NONE; in no particular order */
    int32_t kind;    /* the axis (kiriFace_Axis), and twice its index in grid->stretches, from 1; 0: all of the side */
} kiriFace;

/* Returns the axis of the normal. 0: the side is a vertical line u = const, normal +u; 1: v = const, normal +v. */
static inline int32_t kiriFace_Axis(const kiriFace* face)
{
    return face->kind & 1;
}

static inline bool kiriFace_HasOwnStretch(const kiriFace* face)
{
    return face->kind > 1;
}

/* The part of its side that a face covers. */
typedef struct kiriStretch {
    double width;    /* m, above zero */
    kiriVec2 middle; /* local m: its centroid, on the side */
    double moment;   /* m^3: second moment about its middle */
} kiriStretch;

/* A move of the geodesic: straight over a face, or diagonally, or like a knight in chess. The last two exist where both
   ways around the corner are open. Each step has its reverse. */
typedef struct kiriStep {
    int32_t cell;
    int16_t length; /* KIRI_UNIT... */
    int8_t u, v;    /* squares that it goes along each axis */
} kiriStep;

enum { KIRI_STEP_LENGTHS = 3, KIRI_OPEN_STEPS = 16 };

/* Where the steps of a cell are: straight ones from first to end[0], diagonal ones to end[1], knights to end[2]. A cell
   amid whole squares is open: it has all sixteen steps, and they are not stored. `first` is KIRI_NONE, and `end` means
   nothing. The open cell and the cells around have the indices of their squares. */
typedef struct kiriStepRun {
    int32_t first, end[KIRI_STEP_LENGTHS];
} kiriStepRun;

static inline bool kiriStepRun_IsOpen(const kiriStepRun* run)
{
    return run->first < 0;
}

/* The steps of a cell, stored or not: straight ones from 0 to end[0], diagonal ones to end[1], knights to end[2]. */
typedef struct kiriSteps {
    const kiriStep* data; /* without `base` in their cells: see kiriSteps_At */
    int32_t base, end[KIRI_STEP_LENGTHS];
} kiriSteps;

/* A cell whose material changed, and the previous material. */
typedef struct kiriMaterialChange {
    int32_t cell;
    kiriMoments was;
} kiriMaterialChange;

/* All changes since kiriGrid_ClearChanges, complete when an update is done. A list has a cell at most once. A removed
   cell is in `gone` alone, has square KIRI_NONE, and its index is not used again before ClearChanges. A cell that was
   made and removed in between is in no list. */
typedef struct kiriGridChanges {
    kiriIndices made;
    kiriIndices gone;  /* keep the material that they had at the last ClearChanges */
    kiriIndices steps; /* cells with other steps, or a face that changed in anything; with new cells */
    KIRI_ARRAY(kiriMaterialChange) material; /* without new cells */
    kiriIndices edges; /* cells in whose square edges of the material may have changed; with new cells */
} kiriGridChanges;

enum {
    KIRI_SQUARE_WHOLE = 1, /* wholly covered, and no outline or open edge runs through it */
    KIRI_SQUARE_OPEN = 2,  /* and its cell is open, with the index of the square */
};

typedef struct kiriGridWork kiriGridWork; /* the update in progress, see below */

/* Cells keep their index as long as they live. Orders depend neither on indices nor on the order of cuts: cells are
   ordered by square, then lowest triangle. So an updated grid equals one from scratch, but for the indices. */
typedef struct kiriGrid {
    const kiriMeshData* mesh;     /* the grid is of this mesh alone */
    double side;                  /* m */
    KIRI_ARRAY(kiriCell) cells;   /* by index, with gaps */
    KIRI_ARRAY(kiriStepRun) runs; /* of each cell */
    KIRI_ARRAY(kiriStep) steps;   /* by runs, with gaps; in a run by length, then square, then lowest triangle */
    kiriSpans stepRoom;
    kiriStep openSteps[KIRI_OPEN_STEPS]; /* of an open cell; their cells are added to its index */
    KIRI_ARRAY(kiriFace) faces;      /* by index, with gaps */

    /* Only for cells and faces that do not cover a whole square or side; by index, with gaps. */
    KIRI_ARRAY(kiriMoments) materials; /* covered area and moments, about the local origin; m */
    KIRI_ARRAY(kiriStretch) stretches;
    kiriIndices unusedMaterials, unusedStretches; /* their capacity is enough for all */

    kiriIndices squareCell;         /* a square's first cell, or KIRI_NONE */
    kiriIndices nodeCell;           /* the cell of each node of mesh->squares.nodes; unused ones mean nothing */
    kiriIndices vertexCell;         /* the cell of each vertex in a square with several; others mean nothing */
    kiriFlags whole;                /* of each square: 0, or KIRI_SQUARE_WHOLE, or KIRI_SQUARE_OPEN */
    int32_t cellCount;              /* cells in use */
    int32_t freeCell, freeFace;     /* heads of lists, or KIRI_NONE */
    kiriGridChanges changes;
    kiriGridWork* work;
} kiriGrid;

/* Updates the grid to the mesh, of which the squares in mesh->squares.dirty have changed. A zeroed or reset grid is
   made from scratch, of all squares. An item of the quota is about 0.3 us of work: a square with many triangles takes
   many. A square, a side or a cell is never split: work that exceeds the quota is taken from the next ones. KIRI_MORE:
   call again before the mesh changes or the dirty squares are cleared. KIRI_FAILED: only kiriGrid_Reset helps. */
kiriProgress kiriGrid_Update(kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota);

/* Forgets the changes when all readers have seen them. Not during an update. */
void kiriGrid_ClearChanges(kiriGrid* grid);

/* Adds the position of the update in progress to the state hash. */
void kiriGrid_HashProgress(const kiriGrid* grid, uint64_t* hash);

/* Gives back the room of lists that are as long as the grid only when it is made from scratch. Not during an update,
   nor before its changes are cleared. */
void kiriGrid_DropScratch(kiriGrid* grid);

/* Forgets everything but its memory: the next update is from scratch. */
void kiriGrid_Reset(kiriGrid* grid);

/* Removes the listed cells, which must be all of their pieces, and gives the triangles and vertices of the others their
   new index. Notes no change. Not during an update, nor before its changes are cleared. */
void kiriGrid_Keep(kiriGrid* grid, const kiriKeep* triangles, const kiriKeep* vertices, const int32_t* gone,
                   int32_t goneCount);

static inline bool kiriGrid_IsCell(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT_HAS(grid->cells, cell);
    return grid->cells.data[cell].square != KIRI_NONE;
}

/* Returns true for most open cells. Its answers take less memory to read than runs. */
static inline bool kiriGrid_IsOpen(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT_HAS(grid->runs, cell);
    return cell < grid->whole.count && grid->whole.data[cell] == KIRI_SQUARE_OPEN;
}

static inline kiriSteps kiriGrid_OpenSteps(const kiriGrid* grid, int32_t cell)
{
    return (kiriSteps){ grid->openSteps, cell, { 4, 8, KIRI_OPEN_STEPS } };
}

/* Returns the steps of a cell. Valid until the grid changes or `steps` moves. */
static inline kiriSteps kiriGrid_GetSteps(const kiriGrid* grid, int32_t cell)
{
    KIRI_ASSERT_HAS(grid->runs, cell);
    const kiriStepRun* run = &grid->runs.data[cell];
    if (kiriGrid_IsOpen(grid, cell) || kiriStepRun_IsOpen(run)) {
        KIRI_ASSERT(grid->squareCell.data[cell] == cell);
        return kiriGrid_OpenSteps(grid, cell);
    }
    int32_t at = run->first;
    return (kiriSteps){ &grid->steps.data[at], 0, { run->end[0] - at, run->end[1] - at, run->end[2] - at } };
}

static inline kiriStep kiriSteps_At(const kiriSteps* steps, int32_t index)
{
    KIRI_ASSERT(index >= 0 && index < steps->end[2]);
    kiriStep step = steps->data[index];
    step.cell += steps->base;
    return step;
}

/* A walk over steps of a cell. */
typedef struct kiriStepWalk {
    int32_t cell, length; /* of the current step */
    int32_t base;
    const kiriStep *next, *end;
} kiriStepWalk;

/* The last kind of step of a walk. */
enum { KIRI_STRAIGHT, KIRI_DIAGONAL, KIRI_KNIGHT };

static inline kiriStepWalk kiriGrid_Walk(const kiriGrid* grid, int32_t cell, int last)
{
    kiriSteps steps = kiriGrid_GetSteps(grid, cell);
    return (kiriStepWalk){ cell, 0, steps.base, steps.data, steps.data + steps.end[last] };
}

static inline bool kiriStepWalk_Next(kiriStepWalk* walk)
{
    if (walk->next == walk->end) {
        return false;
    }
    walk->cell = walk->base + walk->next->cell;
    walk->length = walk->next++->length;
    return true;
}

#define KIRI_EACH_STEP(step, grid, from, last)                                                                         \
    for (kiriStepWalk step = kiriGrid_Walk(grid, from, last); kiriStepWalk_Next(&step);)

/* Returns true if a step joins the cells. */
static inline bool kiriGrid_HasStep(const kiriGrid* grid, int32_t from, int32_t to, int last)
{
    KIRI_EACH_STEP(step, grid, from, last) {
        if (step.cell == to) {
            return true;
        }
    }
    return false;
}

/* Returns the moments that a cell covers, about the local origin; of a removed cell its last ones. */
kiriMoments kiriGrid_Material(const kiriGrid* grid, int32_t cell);

/* Returns the area of a cell, m^2. */
static inline double kiriGrid_Area(const kiriGrid* grid, int32_t cell)
{
    int32_t material = grid->cells.data[cell].material;
    return material == KIRI_NONE ? grid->side * grid->side : grid->materials.data[material].area;
}

kiriStretch kiriGrid_Stretch(const kiriGrid* grid, int32_t face);

/* For a face seen from one of its cells, return the cell on the other side, and the next face of the given cell. */
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

/* Loops over the cells of a square, in their order, and over the faces of a cell. */
#define KIRI_EACH_CELL(cell, grid, square)                                                                             \
    for (int32_t cell = (grid)->squareCell.data[square]; cell != KIRI_NONE; cell = (grid)->cells.data[cell].next)
#define KIRI_EACH_FACE(face, grid, cell)                                                                               \
    for (int32_t face = (grid)->cells.data[cell].firstFace; face != KIRI_NONE;                                         \
         face = kiriFace_Next(&(grid)->faces.data[face], cell))

/* Compares in the order of cells: by square, then lowest triangle. */
static inline bool kiriGrid_IsBefore(const kiriGrid* grid, int32_t a, int32_t b)
{
    const kiriCell *x = &grid->cells.data[a], *y = &grid->cells.data[b];
    return x->square != y->square ? x->square < y->square : x->triangle < y->triangle;
}

void kiriGrid_SortCells(const kiriGrid* grid, int32_t* cells, int32_t count);

/* Joins the cells of each piece in a union-find of all cells. Straight steps lead to all material of a piece. */
void kiriGrid_JoinCells(const kiriGrid* grid, int32_t* parent);

/* Finds the cell that holds this part of this triangle; KIRI_NONE where it does not overlap the square around `at`. */
int32_t kiriGrid_CellOf(const kiriGrid* grid, int32_t triangle, kiriLatticePoint at);

/* Finds the cell of a vertex and its fan. */
int32_t kiriGrid_CellOfVertex(const kiriGrid* grid, int32_t vertex);

/* Finds the cell that holds a lattice point of the material, or returns KIRI_NONE. */
int32_t kiriGrid_CellAt(const kiriGrid* grid, kiriLatticePoint at);

/* Finds the cell at a point. A point beside the material gets the first cell of its square: a cut of a slanted outline
   may move the outline past it by a rounding of the lattice. KIRI_NONE in a square without material. */
int32_t kiriGrid_CellAround(const kiriGrid* grid, kiriLatticePoint at);

/* Returns the middle of a cell's square, local m. */
kiriVec2 kiriGrid_Middle(const kiriGrid* grid, int32_t cell);

/* Returns a lattice point of the cell's material, well inside: it finds the material again after the cell is split. */
kiriLatticePoint kiriGrid_Anchor(const kiriGrid* grid, int32_t cell);

/* The update in progress. Private to kiri_grid.c, and to snapshots. */

/* Where a square's triangles are in `entries`. */
typedef struct kiriNodeRange {
    int32_t first, end;
} kiriNodeRange;

/* A cell that a square should have, and its index. */
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
    bool hasRemoved;          /* cells */
    bool outOfMemory;         /* the update fails */
    int64_t debt;             /* work that the quota has not paid yet, in KIRI_GRID_PARTS */
    int32_t stage, item;      /* the next to do */
    kiriIndices facesDirty;   /* squares with new cells */
    kiriIndices linksDirty;   /* squares where a face came or went: steps around may use it */
    kiriIndices stepsDirty;   /* cells whose steps are made again; from scratch: all, and not listed */
    kiriIndices knightsDirty; /* cells of stepsDirty that are not open */

    kiriFlags squareFlags;            /* of each square */
    kiriIndices flagged;              /* squares that have flags */
    KIRI_ARRAY(kiriNodeRange) ranges; /* of each square that is collected */
    kiriIndices entries;              /* of squares that are collected: nodes by triangle */
    kiriIndices parent;               /* union-find over the entries of a square */

    kiriFlags cellFlags; /* of each cell: which lists of changes it is in */
    kiriIndices mark;    /* of each cell, for cells that are reached in two ways; 0 to lastMark + 1 */
    int32_t lastMark;

    KIRI_ARRAY(kiriNewCell) newCells; /* of a square */
    KIRI_ARRAY(kiriOldFace) oldFaces; /* of a side */
    KIRI_ARRAY(kiriStep) steps;       /* of a cell */
};

/* Returns the material of the cell, or the stretch of the face, for writing; null for memory. Adds one, which is not
   initialised, where the cell or face is whole so far. Earlier pointers become invalid. */
kiriMoments* kiriGrid_OwnMaterial(kiriGrid* grid, int32_t cell);
kiriStretch* kiriGrid_OwnStretch(kiriGrid* grid, int32_t face);

/* The cells on borders of regions, a list for each region, in no order: to follow the borders of a few regions takes no
   walk over all their cells. */

typedef struct kiriBorderCell {
    int32_t region;       /* whose list it is in, or KIRI_NONE */
    int32_t next, before; /* in that list, or KIRI_NONE */
} kiriBorderCell;

/* A zeroed one is empty. */
typedef struct kiriBorderCells {
    kiriIndices first; /* of each region, or KIRI_NONE */
    KIRI_ARRAY(kiriBorderCell) cells;
} kiriBorderCells;

/* Makes room for more cells and regions; new cells are in no list. False for memory. */
bool kiriBorderCells_Resize(kiriBorderCells* lists, kiriMemory* memory, int32_t cellCount, int32_t regionCount);

/* Moves a cell to the list of a region; KIRI_NONE: to none. */
void kiriBorderCells_Put(kiriBorderCells* lists, int32_t cell, int32_t region);

/* Gives regions their new index. The lists of regions that are not kept must be empty. */
void kiriBorderCells_Keep(kiriBorderCells* lists, const kiriKeep* regions);

void kiriBorderCells_Reset(kiriBorderCells* lists);

KIRI_C_END

#endif
