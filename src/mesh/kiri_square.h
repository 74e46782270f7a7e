/* The squares of the regular grid. A square lists its vertices, and the triangles whose interior overlaps its own (exactly).
   These lists find the triangle at a point, the edges near a blade, and the material of a cell. Squares that changed are
   dirty, so that the cost of a cut depends on the squares along it. */
#ifndef KIRI_SQUARE_H
#define KIRI_SQUARE_H

#include "../core/kiri_array.h"
#include "../core/kiri_vec.h"

KIRI_C_BEGIN

/* One triangle in one square. */
typedef struct kiriSquareNode {
    int32_t triangle;
    int32_t next; /* in the same square, or KIRI_NONE */
} kiriSquareNode;

/* Squares that a part of a sheet has around its own: steps of the grid lead this far. */
enum { KIRI_SQUARES_BESIDE = 2 };

/* Costs in ns, about: to pass a node of a list; to test a square, or to change its list. */
enum { KIRI_NODE_EFFORT = 1, KIRI_SQUARE_EFFORT = 8 };

typedef struct kiriSquares {
    int32_t columns, rows;
    int32_t firstColumn, firstRow; /* 0, but in a part of a sheet, which has only the squares around it */
    int32_t side;                  /* lattice steps, even; grid line k lies at k * side - 1 */
    double perStep;                /* 1 / side */
    int32_t* head;                 /* a square's first node, or KIRI_NONE; columns * rows, row by row */
    KIRI_ARRAY(kiriSquareNode) nodes;
    int32_t freeNode;
    int32_t* vertexHead;       /* a square's first vertex, or KIRI_NONE: see kiriVertex */
    kiriIndices dirty;         /* squares that changed since ClearDirty, each once; has room for all */
    uint8_t* isDirty;          /* of each square: 1 if it is in `dirty` */
    int64_t effort;            /* cost of changes so far, about ns */
} kiriSquares;

/* Allocates empty squares, whose numbers and side are set. False for memory. */
bool kiriSquares_Allocate(kiriSquares* squares, kiriMemory* memory);

/* Makes `resolution` squares along the longer of the two extents (lattice steps, from 0). */
bool kiriSquares_Init(kiriSquares* squares, kiriMemory* memory, kiriLatticePoint extent, int32_t resolution);

/* Makes the squares of `like` around the box between two points, and KIRI_SQUARES_BESIDE more on each side if there are
   any. They are empty. */
bool kiriSquares_InitPart(kiriSquares* squares, kiriMemory* memory, const kiriSquares* like, kiriLatticePoint lower,
                          kiriLatticePoint upper);

/* Returns the number of nodes that a triangle needs at most. */
int64_t kiriSquares_MostNodes(const kiriSquares* squares, const kiriLatticePoint corners[3]);

/* Lists a triangle in the squares that it overlaps; Reshape takes it out of the others. Corners are counter-clockwise.
   Squares that the triangle overlaps or overlapped become dirty. A triangle that stays in a square keeps its place in the
   list. Insert fails on out of memory, and changes nothing then. Reshape cannot fail: the caller has reserved nodes for
   the new shape. */
bool kiriSquares_Insert(kiriSquares* squares, kiriMemory* memory, int32_t triangle, const kiriLatticePoint corners[3]);
void kiriSquares_Reshape(kiriSquares* squares, int32_t triangle, const kiriLatticePoint was[3],
                         const kiriLatticePoint is[3]);

/* Removes the triangles that are not kept, all of which are in these squares, and renumbers the others. No square becomes
   dirty. */
void kiriSquares_Keep(kiriSquares* squares, const kiriKeep* triangles, const int32_t* of, int32_t count);

/* Makes the squares dirty if the edge between two vertices runs through their open interior. */
void kiriSquares_MarkEdgeDirty(kiriSquares* squares, kiriLatticePoint a, kiriLatticePoint b);
void kiriSquares_ClearDirty(kiriSquares* squares);

/* Returns true if the segment runs through the open square. Exact. Neither end may be on a grid line. */
bool kiriSquares_RunsThrough(const kiriSquares* squares, int32_t square, kiriLatticePoint a, kiriLatticePoint b);

/* Returns true if the segment runs through all squares that a triangle overlaps. */
bool kiriSquares_RunsThroughAll(const kiriSquares* squares, kiriLatticePoint a, kiriLatticePoint b,
                                const kiriLatticePoint corners[3]);

/* Returns the square at the point of a vertex, or KIRI_NONE outside the grid. */
int32_t kiriSquares_At(const kiriSquares* squares, kiriLatticePoint p);

/* Returns the index in the part of a square of the whole. The part has this square. */
int32_t kiriSquares_InPart(const kiriSquares* part, const kiriSquares* whole, int32_t square);

/* Loops over the nodes of a square: a node for each triangle that overlaps it. */
#define KIRI_EACH_NODE(node, squares, square)                                                                          \
    for (int32_t node = (squares)->head[square]; node != KIRI_NONE; node = (squares)->nodes.data[node].next)

/* Returns the number of triangles that overlap a square. */
int32_t kiriSquares_CountNodes(const kiriSquares* squares, int32_t square);

/* Returns the lower corner of a square (odd coordinates). */
static inline kiriLatticePoint kiriSquares_CornerAt(const kiriSquares* squares, int32_t column, int32_t row)
{
    KIRI_ASSERT(column >= 0 && column < squares->columns && row >= 0 && row < squares->rows);
    return (kiriLatticePoint){ (squares->firstColumn + column) * squares->side - 1,
                               (squares->firstRow + row) * squares->side - 1 };
}

static inline kiriLatticePoint kiriSquares_Corner(const kiriSquares* squares, int32_t square)
{
    KIRI_ASSERT(square >= 0);
    int32_t row = square / squares->columns;
    return kiriSquares_CornerAt(squares, square - row * squares->columns, row);
}

/* The squares within `margin` of a segment, in strips across its longer axis, from its start on. */
typedef struct kiriStrips {
    const kiriSquares* squares;
    double from[2], way[2], margin;
    int32_t axis; /* the longer one: 0 x, 1 y */
    int32_t index, last, step;
    int32_t square, count, stride; /* of the current strip: first square, number, and distance between squares */
} kiriStrips;

kiriStrips kiriStrips_Begin(const kiriSquares* squares, kiriLatticePoint from, kiriLatticePoint to, double margin);

/* Goes to the next strip. Returns false after the last. */
bool kiriStrips_Next(kiriStrips* strips);

/* The triangles in those squares. A triangle in several squares comes several times. */
typedef struct kiriNearby {
    kiriStrips strips;
    int32_t square, node; /* the next ones; square: index in the strip */
} kiriNearby;

kiriNearby kiriNearby_Begin(const kiriSquares* squares, kiriLatticePoint from, kiriLatticePoint to, double margin);

/* Returns the next triangle, or KIRI_NONE after the last. */
int32_t kiriNearby_Next(kiriNearby* nearby);

#define KIRI_EACH_NEARBY(triangle, nearby)                                                                             \
    for (int32_t triangle; (triangle = kiriNearby_Next(&(nearby))) != KIRI_NONE;)

KIRI_C_END

#endif
