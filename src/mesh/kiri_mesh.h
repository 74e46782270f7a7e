/* The triangle mesh in the rest plane. Geometrically it is one conforming triangulation that cuts never tear: the two
   half-edges of an edge stay twins, and a cut only marks the edge open. Cuts do separate vertices: each fan of
   triangles around a point, between open edges, has its own vertex. So a blade crosses older cuts like any other edge,
   both lips get the same new point, and the area is preserved exactly. */
#ifndef KIRI_MESH_H
#define KIRI_MESH_H

#include "kiri_square.h"
#include "../core/kiri_base.h"

KIRI_C_BEGIN

enum {
    KIRI_LATTICE = 1 << 29,        /* steps along the longer side of the sheet's box */
    KIRI_MOST_TRIANGLES = 1 << 29, /* half-edges must fit 32 bits */
    KIRI_SOURCES_A_BLOCK = 8
};

/* Half-edge 3 t + i runs from vertex[i] to vertex[(i + 1) % 3] of triangle t. */
typedef struct kiriTriangle {
    int32_t vertex[3]; /* counter-clockwise, never degenerate */
    int32_t twin[3];   /* opposite half-edge, also across open edges; KIRI_NONE at the outline */
    int32_t source;    /* the caller's triangle that contains it */
    int32_t parent;    /* older triangle from which it was split, or KIRI_NONE */
    int32_t
        marks; /* KIRI_TRIANGLE_..., and bit i: half-edge i is open (cut); bit 4 + i: it is a crease, which is open,
                  too; its twin agrees. Outline edges are not. */
} kiriTriangle;

enum {
    KIRI_TRIANGLE_OPEN = 7,    /* its open edges */
    KIRI_TRIANGLE_CHANGED = 8, /* in changedTriangles */
    KIRI_TRIANGLE_CREASE = 7 << 4,
    KIRI_EDGE_OPEN = 1, /* of half-edge 0; a crease is open, too */
    KIRI_EDGE_CREASE = 17
};

typedef struct kiriVertex {
    kiriLatticePoint at;
    int32_t edge;   /* a half-edge that starts at it, in its own fan */
    int32_t next;   /* older vertex in the same square, or KIRI_NONE; squares.vertexHead is the newest */
    int32_t source; /* the caller's triangle, see kiriMesh_GetShare */
    uint32_t stamp; /* equals kiriMeshData.stamp if in changedVertices */
} kiriVertex;

/* Origin of a new vertex: a blend of up to three older vertices. Vertex attributes such as weights blend the same way.
   */
typedef struct kiriBirth {
    int32_t parent[3]; /* KIRI_NONE if unused */
    double share[3];
} kiriBirth;

/* A straight line along which the sheet folds. Its edges are creases: open, but a link joins the two sides. */
typedef struct kiriFoldLine {
    kiriLatticePoint from, to;
    double reach; /* lattice steps: creases this near to the line, or beyond its ends within 4 times this, belong to it */
    float stiffness, restAngle, yieldMoment; /* see kiriFold */
    int32_t isMade; /* 0: its blade has not come to its end */
} kiriFoldLine;

enum { KIRI_MOST_FOLDS = 65536 };
#define KIRI_MOST_FOLD_REACH (4.0 * KIRI_LATTICE) /* no point of a sheet is farther from a fold */
#define KIRI_MOST_FOLD 3.14159275 /* rad: most of a rest angle; pi, as a float too */

typedef struct kiriMeshData {
    kiriMemory* memory;
    kiriVec2 origin; /* m, rest plane: position of lattice point (0, 0) */
    double step;     /* m: length of a lattice step */
    KIRI_ARRAY(kiriTriangle) triangles;
    KIRI_ARRAY(kiriVertex) vertices;
    kiriSquares squares;
    KIRI_ARRAY(kiriFoldLine) folds; /* parts keep all of them, in the same order */
    uint32_t revision; /* incremented with every change */

    /* Corners of the caller's triangles, three a triangle: they give the barycentric coordinates of vertices, see
       kiri_mesh_build.c. Triangles with an index below `originals` are the caller's, sorted by source. An unsplit
       triangle has the corners of its source. The corners of split sources are stored in blocks, in sourceCorners. A
       detached part has no blocks: it lists the sources of its triangles, ascending, and their corners in this order.
       */
    int32_t originals;
    kiriIndices sourceBlocks; /* per KIRI_SOURCES_A_BLOCK sources: their block, or KIRI_NONE if none was split */
    KIRI_ARRAY(kiriLatticePoint) sourceCorners;
    kiriIndices sources;

    /* The journal: changes since kiriMesh_Begin. A view of the mesh only needs to update these items. Vertices change
       their source and edge, never their point. */
    bool isOpen; /* between Begin and Commit; the mesh may change only then */
    bool hasMet; /* since Begin a cut has met the border or a lip: only then can material separate */
    uint32_t stamp;
    int32_t oldTriangleCount, oldVertexCount; /* items from these indices on are new */
    kiriIndices changedTriangles;             /* old triangles, each once */
    kiriIndices changedVertices;
    KIRI_ARRAY(kiriBirth) births; /* of vertices from oldVertexCount on */
} kiriMeshData;

/* The caller's triangles. */
typedef struct kiriMeshInput {
    const float* positions; /* 2 a vertex */
    int32_t vertexCount;
    const int32_t* indices; /* 3 a triangle */
    int32_t triangleCount;
    int32_t resolution;  /* of the grid, along the longer side */
    double weldDistance; /* m: see FindWelds; 0: no welding */
} kiriMeshInput;

/* Checks and copies the caller's triangles. Drops unused vertices, and triangles that become degenerate by welding. The
   fault of KIRI_ERROR_MESH names a triangle, an edge or a vertex of the caller. Leaves the journal open. */
kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshInput* input, kiriFault* fault);

/* Items of a mesh that become a separate mesh. */
typedef struct kiriMeshPart {
    kiriIndices items;    /* ascending */
    const kiriKeep* keep; /* keeps these items */
} kiriMeshPart;

/* Copies a part of another mesh, with the same lattice and the squares around it: these triangles and vertices, each
   vertex with its whole fan. `mesh` must be zeroed. Leaves the journal open. Fails on out of memory. */
bool kiriMesh_MakePart(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshData* from,
                       const kiriMeshPart* triangles, const kiriMeshPart* vertices);

/* Removes the triangles and vertices that are not kept, each vertex with its whole fan. `squares`: all squares that
   contain removed triangles. The journal must be closed. Cannot fail. */
void kiriMesh_Keep(kiriMeshData* mesh, const kiriKeep* triangles, const kiriKeep* vertices, const int32_t* squares,
                   int32_t squareCount);

/* ---- Half-edges ---- */

static inline int32_t kiriEdge_Next(int32_t h)
{
    return h % 3 == 2 ? h - 2 : h + 1;
}
static inline int32_t kiriEdge_Previous(int32_t h)
{
    return h % 3 == 0 ? h + 2 : h - 1;
}

static inline const kiriTriangle* kiriMesh_TriangleOf(const kiriMeshData* mesh, int32_t h)
{
    KIRI_ASSERT(h >= 0 && h / 3 < mesh->triangles.count);
    return &mesh->triangles.data[h / 3];
}

static inline int32_t kiriMesh_Tail(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_TriangleOf(mesh, h)->vertex[h % 3];
}

static inline int32_t kiriMesh_Head(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_Tail(mesh, kiriEdge_Next(h));
}

/* Returns the lattice point of a vertex. */
static inline kiriLatticePoint kiriMesh_At(const kiriMeshData* mesh, int32_t vertex)
{
    KIRI_ASSERT_HAS(mesh->vertices, vertex);
    return mesh->vertices.data[vertex].at;
}

/* Returns the lattice points of the ends of a half-edge. */
static inline kiriLatticePoint kiriMesh_TailAt(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_At(mesh, kiriMesh_Tail(mesh, h));
}
static inline kiriLatticePoint kiriMesh_HeadAt(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_At(mesh, kiriMesh_Head(mesh, h));
}

static inline int32_t kiriMesh_Twin(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_TriangleOf(mesh, h)->twin[h % 3];
}

/* Returns KIRI_EDGE_OPEN, KIRI_EDGE_CREASE, or 0 for a closed edge. */
static inline int32_t kiriMesh_MarksOf(const kiriMeshData* mesh, int32_t h)
{
    return kiriMesh_TriangleOf(mesh, h)->marks >> h % 3 & KIRI_EDGE_CREASE;
}

static inline bool kiriMesh_IsOpen(const kiriMeshData* mesh, int32_t h)
{
    return (kiriMesh_TriangleOf(mesh, h)->marks >> (h % 3) & 1) != 0;
}

static inline bool kiriMesh_IsCrease(const kiriMeshData* mesh, int32_t h)
{
    return (kiriMesh_TriangleOf(mesh, h)->marks >> (4 + h % 3) & 1) != 0;
}

/* A half-edge stands for the corner at its tail. Returns the next corner of the fan, or KIRI_NONE at the end. */
static inline int32_t kiriMesh_CounterClockwise(const kiriMeshData* mesh, int32_t h)
{
    int32_t previous = kiriEdge_Previous(h);
    return kiriMesh_IsOpen(mesh, previous) ? KIRI_NONE : kiriMesh_Twin(mesh, previous);
}

/* Returns the previous corner of the fan, or KIRI_NONE. */
static inline int32_t kiriMesh_Clockwise(const kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_IsOpen(mesh, h) ? KIRI_NONE : kiriMesh_Twin(mesh, h);
    return twin == KIRI_NONE ? KIRI_NONE : kiriEdge_Next(twin);
}

/* Returns true if the surface ends at the half-edge. A cut of one edge with both ends closed has no gap yet. */
static inline bool kiriMesh_IsBorder(const kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_Twin(mesh, h);
    if (twin == KIRI_NONE || !kiriMesh_IsOpen(mesh, h)) {
        return twin == KIRI_NONE;
    }
    return kiriMesh_Tail(mesh, kiriEdge_Next(twin)) != kiriMesh_Tail(mesh, h) ||
           kiriMesh_Tail(mesh, twin) != kiriMesh_Tail(mesh, kiriEdge_Next(h));
}

static inline void kiriMesh_Corners(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint corners[3])
{
    const kiriTriangle* t = kiriMesh_TriangleOf(mesh, 3 * triangle);
    KIRI_EACH_CORNER(i) {
        KIRI_ASSERT(t->vertex[i] >= 0 && t->vertex[i] < mesh->vertices.count);
        corners[i] = mesh->vertices.data[t->vertex[i]].at;
    }
}

/* ---- Queries ---- */

/* Returns true if the crease between two points belongs to the fold. */
bool kiriFoldLine_Has(const kiriFoldLine* fold, kiriLatticePoint a, kiriLatticePoint b);

/* Computes the barycentric coordinates of a point in a triangle. */
void kiriMesh_Shares(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at, double shares[3]);

/* Returns true if the triangle contains the point, least 0: be it on an edge, 1: on none. Exact. */
bool kiriMesh_Holds(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at, int64_t least);

/* Returns the lowest triangle whose closure contains the point, so lips of a cut do not matter, or KIRI_NONE. */
int32_t kiriMesh_Locate(const kiriMeshData* mesh, kiriLatticePoint at);

/* Returns the direction from one vertex to another, unit. */
kiriVec2 kiriMesh_Direction(const kiriMeshData* mesh, int32_t from, int32_t to);

/* Finds the first and the last corner of a vertex's fan. Returns false if no edge of it is open. */
bool kiriMesh_FindFan(const kiriMeshData* mesh, int32_t vertex, int32_t* first, int32_t* last);

/* Returns a vector from a vertex on a lip or the outline into its material. The length is a quarter on a straight lip,
   and 0 if the fan of the vertex is closed. */
kiriVec2 kiriMesh_Lean(const kiriMeshData* mesh, int32_t vertex);

/* Returns the area, m^2. Only splits of slanted outline edges change it. */
double kiriMesh_Area(const kiriMeshData* mesh);

/* Write the barycentric coordinates of a vertex, not negative, sum 1: in its source, or in another of the caller's
   triangles of which the mesh has a part. */
void kiriMesh_GetShare(const kiriMeshData* mesh, int32_t vertex, float share[3]);
void kiriMesh_GetShareIn(const kiriMeshData* mesh, int32_t vertex, int32_t source, float share[3]);

/* Return a lattice point, or a vertex, in metres from the lattice's origin ("local"). */
static inline kiriVec2 kiriMesh_Local(const kiriMeshData* mesh, kiriLatticePoint p)
{
    return kiriVec2_Make(mesh->step * p.x, mesh->step * p.y);
}

static inline kiriVec2 kiriMesh_LocalOf(const kiriMeshData* mesh, int32_t vertex)
{
    return kiriMesh_Local(mesh, kiriMesh_At(mesh, vertex));
}

/* Return the nearest even lattice point, from lattice or local coordinates. Clip points outside four times the sheet's
   box first. */
kiriLatticePoint kiriMesh_Round(kiriVec2 lattice);
kiriLatticePoint kiriMesh_Snap(const kiriMeshData* mesh, kiriVec2 local);

/* ---- Used by files that make or change meshes. The caller reserves room. ---- */

/* Adds a triangle without twins and returns its index. */
int32_t kiriMesh_AddTriangle(kiriMeshData* mesh, int32_t a, int32_t b, int32_t c, int32_t source, int32_t parent);

/* Makes half-edges h and g twins; g may be KIRI_NONE. */
void kiriMesh_Link(kiriMeshData* mesh, int32_t h, int32_t g);

/* Marks a half-edge as closed (0), KIRI_EDGE_OPEN or KIRI_EDGE_CREASE, but not its twin. */
void kiriMesh_SetMarks(kiriMeshData* mesh, int32_t h, int32_t marks);

/* Writes the corners of one of the caller's triangles. Returns false if the mesh has no part of it. */
bool kiriMesh_SourceCorners(const kiriMeshData* mesh, int32_t source, kiriLatticePoint corners[3]);

/* Returns true if the corners of a triangle's source are known and stay known when any other triangle is split. */
bool kiriMesh_HasSource(const kiriMeshData* mesh, int32_t triangle);

/* Stores the corners of the triangle's source in a block. Call it before a triangle is split; there must be room. */
void kiriMesh_KeepSource(kiriMeshData* mesh, int32_t triangle);

/* Lists a new vertex in its square, before older ones. It never moves, so it stays there. */
void kiriMesh_ListVertex(kiriMeshData* mesh, int32_t vertex);

/* Inserts all triangles into squares. Fails on out of memory. */
bool kiriMesh_FillSquares(const kiriMeshData* mesh, kiriSquares* squares, kiriMemory* memory);

/* Changing a mesh: splitting triangles, opening edges. */

/* Begin opens the journal and clears the births; Commit closes the journal. The mesh may change only in between. */
void kiriMesh_Begin(kiriMeshData* mesh);
void kiriMesh_Commit(kiriMeshData* mesh);

/* Reserves room for `changes` calls of the functions below. Each call reserves nodes of squares itself, because they
   depend on the new triangles. */
bool kiriMesh_Reserve(kiriMeshData* mesh, int32_t changes);

/* These fail only on out of memory, and then nothing has changed. */

/* Adds a vertex at `at` (even coordinates) on half-edge h and its twin. The four (at the outline: two) new triangles
   must be counter-clockwise: see kiriMesh_CanSplitEdge. Returns the vertex on h's side, or KIRI_NONE. */
int32_t kiriMesh_SplitEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at);

/* Adds a vertex inside a triangle, on no edge. Returns it, or KIRI_NONE. */
int32_t kiriMesh_SplitTriangle(kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

/* Replaces the edge between two triangles by the other diagonal of their quadrilateral: see kiriMesh_CanFlipEdge. The
   new edge is half-edge kiriEdge_Next(h). */
bool kiriMesh_FlipEdge(kiriMeshData* mesh, int32_t h);

/* Opens the edge. Each fan at its two ends gets its own vertex. isCrease: as a crease, unless it is open already. Else
   a crease becomes a cut. */
bool kiriMesh_Open(kiriMeshData* mesh, int32_t h, bool isCrease);

/* Returns true if all new triangles would be counter-clockwise. Exact. */
bool kiriMesh_CanSplitEdge(const kiriMeshData* mesh, int32_t h, kiriLatticePoint at);

/* Returns true if the edge is closed, both triangles lie in the same source triangle, and both new ones would be
   counter-clockwise. Exact. */
bool kiriMesh_CanFlipEdge(const kiriMeshData* mesh, int32_t h);

/* Returns true if the edge runs through all squares of its triangles: in each square both are in one cell. So no material
   has another owner after a flip (kiri_refit.c). */
bool kiriMesh_FlipKeepsCells(const kiriMeshData* mesh, int32_t h);

KIRI_C_END

#endif
