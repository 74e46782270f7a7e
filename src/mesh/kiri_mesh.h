/* The triangle mesh in the rest plane. As geometry it is one conforming triangulation that cuts never tear: two
   triangles beside an edge are twins for ever, and a cut only marks the edge open. What cuts do tear are the vertices:
   each fan of triangles around a point, between open edges, has a vertex of its own. So a blade crosses older cuts
   like any other edge, both lips get the same new point, and the area is kept exactly. */
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
    int32_t twin[3];   /* the half-edge on the other side, also across open edges; KIRI_NONE at the outline */
    int32_t source;    /* the triangle of the caller that it is a part of */
    int32_t parent;    /* the older triangle that it was split from, or KIRI_NONE */
    int32_t
        marks; /* KIRI_TRIANGLE_..., and bit i: half-edge i is open (cut); its twin agrees. Outline edges are not. */
} kiriTriangle;

enum {
    KIRI_TRIANGLE_OPEN = 7,   /* its open edges */
    KIRI_TRIANGLE_CHANGED = 8 /* in changedTriangles */
};

typedef struct kiriVertex {
    kiriLatticePoint at;
    int32_t edge;   /* a half-edge that leaves it, in its own fan */
    int32_t next;   /* an older vertex in the same square, or KIRI_NONE; squares.vertexHead is the latest one */
    int32_t source; /* triangle of the caller, see kiriMesh_GetShare */
    uint32_t stamp; /* kiriMeshData.stamp: in changedVertices */
} kiriVertex;

/* How a vertex came to be, for what vertices carry (weights, say): a blend of up to three older ones. */
typedef struct kiriBirth {
    int32_t parent[3]; /* KIRI_NONE where there are fewer */
    double share[3];
} kiriBirth;

typedef struct kiriMeshData {
    kiriMemory* memory;
    kiriVec2 origin; /* m, rest plane: where lattice (0, 0) is */
    double step;     /* m a lattice step */
    KIRI_ARRAY(kiriTriangle) triangles;
    KIRI_ARRAY(kiriVertex) vertices;
    kiriSquares squares;
    uint32_t revision; /* grows with every change */

    /* Corners of the caller's triangles, three a triangle, for where vertices are in them: see kiri_mesh_build.c.
       Triangles before `originals` are the caller's, by their source; one that was never split has the corners of its
       source itself. Of others these lie in blocks, from sourceCorners on. A part lists the sources that its triangles
       are of, ascending, and has the corners of these in the same order; it has no blocks. */
    int32_t originals;
    kiriIndices sourceBlocks; /* of each KIRI_SOURCES_A_BLOCK sources: their block, or KIRI_NONE: none was split */
    KIRI_ARRAY(kiriLatticePoint) sourceCorners;
    kiriIndices sources;

    /* The journal: what changed since kiriMesh_Begin. A view of the mesh needs to write nothing else. Vertices change
       their source and edge, never their point. */
    bool isOpen; /* between Begin and Commit: only then can the mesh change */
    bool hasMet; /* since Begin a cut has met the border or a lip: only there does material part */
    uint32_t stamp;
    int32_t oldTriangleCount, oldVertexCount; /* those from there on are new */
    kiriIndices changedTriangles;             /* of the older ones, each once */
    kiriIndices changedVertices;
    KIRI_ARRAY(kiriBirth) births; /* of vertex oldVertexCount and on */
} kiriMeshData;

/* The caller's triangles. */
typedef struct kiriMeshInput {
    const float* positions; /* 2 a vertex */
    int32_t vertexCount;
    const int32_t* indices; /* 3 a triangle */
    int32_t triangleCount;
    int32_t resolution;  /* of the grid, along the longer side */
    double weldDistance; /* m: see kiriWeld_Find; 0: no vertices are one */
} kiriMeshInput;

/* Checks the caller's triangles and takes them over. Leaves out vertices that no triangle has, and triangles of which
   two corners become one vertex. The fault of KIRI_ERROR_MESH names a triangle, an edge or a vertex of the caller. The journal
   is open after it. */
kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshInput* input, kiriFault* fault);

/* Items of a mesh that become one of their own. */
typedef struct kiriMeshPart {
    kiriIndices items;    /* from the lowest to the highest */
    const kiriKeep* keep; /* keeps these */
} kiriMeshPart;

/* Copies a part of another mesh, on the same lattice and the squares around it: these triangles and vertices, a vertex
   with its whole fan. The mesh is zeroed. The journal is open after it. False for memory. */
bool kiriMesh_MakePart(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshData* from,
                       const kiriMeshPart* triangles, const kiriMeshPart* vertices);

/* Takes away the triangles and vertices that are not kept; a vertex goes with its whole fan. `squares`: all squares
   that these triangles are in. Not while the journal is open. Never fails. */
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
    KIRI_ASSERT(vertex >= 0 && vertex < mesh->vertices.count);
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

static inline bool kiriMesh_IsOpen(const kiriMeshData* mesh, int32_t h)
{
    return (kiriMesh_TriangleOf(mesh, h)->marks >> (h % 3) & 1) != 0;
}

/* A half-edge stands for the corner to its left: the next corner of the fan, or KIRI_NONE where the fan ends. */
static inline int32_t kiriMesh_CounterClockwise(const kiriMeshData* mesh, int32_t h)
{
    int32_t previous = kiriEdge_Previous(h);
    return kiriMesh_IsOpen(mesh, previous) ? KIRI_NONE : kiriMesh_Twin(mesh, previous);
}

/* And the one before. */
static inline int32_t kiriMesh_Clockwise(const kiriMeshData* mesh, int32_t h)
{
    int32_t twin = kiriMesh_IsOpen(mesh, h) ? KIRI_NONE : kiriMesh_Twin(mesh, h);
    return twin == KIRI_NONE ? KIRI_NONE : kiriEdge_Next(twin);
}

/* Does the surface end at the half-edge? A cut of one edge, both ends of which are closed, has no gap yet. */
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
    for (int i = 0; i < 3; ++i) {
        KIRI_ASSERT(t->vertex[i] >= 0 && t->vertex[i] < mesh->vertices.count);
        corners[i] = mesh->vertices.data[t->vertex[i]].at;
    }
}

/* ---- Questions ---- */

/* A triangle whose closure holds the point (the lowest index, so that lips of a cut do not matter), or KIRI_NONE. */
int32_t kiriMesh_Locate(const kiriMeshData* mesh, kiriLatticePoint at);

/* From one vertex to another, unit. */
kiriVec2 kiriMesh_Direction(const kiriMeshData* mesh, int32_t from, int32_t to);

/* From a vertex on a lip, or on the outline, into its material: a quarter long where the lip is straight, 0 where the
   fan of the vertex goes all around. */
kiriVec2 kiriMesh_Lean(const kiriMeshData* mesh, int32_t vertex);

/* Twice the area, in lattice steps squared. Exact: cuts that do not split slanted outline edges never change it. */
int64_t kiriMesh_DoubledArea(const kiriMeshData* mesh);

/* The area, m^2. */
double kiriMesh_Area(const kiriMeshData* mesh);

/* Where a vertex is in its source, or in another triangle of the caller that the mesh has something of: barycentric
   coordinates, not negative, sum 1. */
void kiriMesh_GetShare(const kiriMeshData* mesh, int32_t vertex, float share[3]);
void kiriMesh_GetShareIn(const kiriMeshData* mesh, int32_t vertex, int32_t source, float share[3]);

/* A lattice point in metres from the lattice's origin ("local"). */
static inline kiriVec2 kiriMesh_Local(const kiriMeshData* mesh, kiriLatticePoint p)
{
    return kiriVec2_Make(mesh->step * p.x, mesh->step * p.y);
}

/* The nearest even point, of one in lattice steps or local. Clip first what may lie outside four times the sheet's
   box. */
kiriLatticePoint kiriMesh_Round(kiriVec2 lattice);
kiriLatticePoint kiriMesh_Snap(const kiriMeshData* mesh, kiriVec2 local);

/* ---- For the files that make or change meshes; the caller reserves room ---- */

/* A triangle without twins; its index. */
int32_t kiriMesh_AddTriangle(kiriMeshData* mesh, int32_t a, int32_t b, int32_t c, int32_t source, int32_t parent);

/* Half-edges h and g run along the same edge in opposite directions; g may be KIRI_NONE. */
void kiriMesh_Link(kiriMeshData* mesh, int32_t h, int32_t g);
void kiriMesh_SetOpen(kiriMeshData* mesh, int32_t h, bool open);

/* The corners of one of the caller's triangles; false where the mesh has nothing of it. */
bool kiriMesh_SourceCorners(const kiriMeshData* mesh, int32_t source, kiriLatticePoint corners[3]);

/* Are those of a triangle's source known, and so are they when any other triangle has been split? */
bool kiriMesh_HasSource(const kiriMeshData* mesh, int32_t triangle);

/* Before a triangle is split: from then on its source has corners in a block. There is room for that. */
void kiriMesh_KeepSource(kiriMeshData* mesh, int32_t triangle);

void kiriMesh_SetSource(kiriMeshData* mesh, int32_t vertex, int32_t source);

/* Lists a new vertex in its square, before older ones. It never moves, so it stays there. */
void kiriMesh_ListVertex(kiriMeshData* mesh, int32_t vertex);

/* Inserts all triangles into squares. False for memory. */
bool kiriMesh_FillSquares(const kiriMeshData* mesh, kiriSquares* squares, kiriMemory* memory);

/* Changing a mesh: splitting triangles, opening edges. */

/* Begin opens the journal and empties the births, Commit closes it. The mesh may change in between only. */
void kiriMesh_Begin(kiriMeshData* mesh);
void kiriMesh_Commit(kiriMeshData* mesh);

/* Reserves room for so many changes; each of the functions below is one. Nodes of squares are reserved by the change
   itself: only it knows the new triangles. */
bool kiriMesh_Reserve(kiriMeshData* mesh, int32_t changes);

/* These fail only on out of memory, and then nothing has changed. */

/* A new vertex at `at` (even coordinates) on half-edge h and its twin. The four (at the outline: two) new triangles
   must be counter-clockwise: see kiriMesh_CanSplitEdge. Returns the vertex on h's side, or KIRI_NONE. */
int32_t kiriMesh_SplitEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at);

/* A new vertex inside a triangle: see kiriMesh_CanSplitTriangle. Returns it, or KIRI_NONE. */
int32_t kiriMesh_SplitTriangle(kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

/* Replaces the edge between two triangles by the other diagonal of their quadrilateral: see kiriMesh_CanFlipEdge. The
   new edge is half-edge kiriEdge_Next(h). */
bool kiriMesh_FlipEdge(kiriMeshData* mesh, int32_t h);

/* Opens the edge, and gives each fan at its two ends a vertex of its own. */
bool kiriMesh_Open(kiriMeshData* mesh, int32_t h);

/* Would all new triangles be counter-clockwise? Exact. */
bool kiriMesh_CanSplitEdge(const kiriMeshData* mesh, int32_t h, kiriLatticePoint at);
bool kiriMesh_CanSplitTriangle(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

/* Returns true if the edge is closed, both triangles lie in the same source triangle, and both new ones would be
   counter-clockwise. Exact. */
bool kiriMesh_CanFlipEdge(const kiriMeshData* mesh, int32_t h);

KIRI_C_END

#endif
