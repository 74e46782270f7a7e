/* The triangle mesh in the rest plane. As geometry it is one conforming triangulation that cuts never tear: two
   triangles beside an edge are twins for ever, and a cut only marks the edge open. What cuts do tear are the vertices:
   each fan of triangles around a place, between open edges, has a vertex of its own. So a blade crosses older cuts
   like any other edge, both lips get the same new point, and the area is kept exactly. */
#ifndef KIRI_MESH_H
#define KIRI_MESH_H

#include "kiri_square.h"

enum { KIRI_LATTICE = 1 << 29 }; /* lattice steps along the longer side of the sheet's box */

/* Half-edge 3 t + i runs from vertex[i] to vertex[(i + 1) % 3] of triangle t. */
typedef struct kiriTriangle {
    int32_t vertex[3]; /* counter-clockwise, never degenerate */
    int32_t twin[3];   /* the half-edge on the other side, also across open edges; KIRI_NONE at the outline */
    int32_t source;    /* the triangle of the caller that it is a part of */
    int32_t parent;    /* the older triangle that it was split from, or KIRI_NONE */
    int32_t open;      /* bit i: half-edge i is open (cut); its twin agrees. Outline edges are not marked. */
    uint32_t stamp;    /* number of the journal that has saved it already */
} kiriTriangle;

typedef struct kiriVertex {
    kiriLatticePoint at;
    int32_t edge;   /* a half-edge that leaves it, in its own fan */
    int32_t next;   /* an older vertex in the same square, or KIRI_NONE; squares.vertexHead is the latest one */
    int32_t source; /* triangle of the caller, */
    float share[3]; /* and barycentric coordinates in it, not negative, sum 1 */
    uint32_t stamp;
} kiriVertex;

/* How a vertex came to be, for what vertices carry (weights, say): a blend of up to three older ones. */
typedef struct kiriBirth {
    int32_t parent[3]; /* KIRI_NONE where there are fewer */
    double share[3];
} kiriBirth;

typedef struct kiriSavedTriangle {
    int32_t index;
    kiriTriangle was;
} kiriSavedTriangle;

typedef struct kiriSavedVertex {
    int32_t index;
    kiriVertex was;
} kiriSavedVertex;

typedef struct kiriMeshData {
    kiriMemory* memory;
    kiriVec2 origin; /* m, rest plane: where lattice (0, 0) is */
    double step;     /* m a lattice step */
    KIRI_ARRAY(kiriTriangle) triangles;
    KIRI_ARRAY(kiriVertex) vertices;
    kiriSquares squares;
    uint32_t revision; /* grows with every change */

    /* The caller's triangles, for provenance: their corners on the lattice, three a triangle, from the first that is
       left. */
    KIRI_ARRAY(kiriLatticePoint) sourceCorners;
    int32_t firstSource;

    /* The journal: what changed since kiriMesh_Begin. Until Commit these are all that can have changed: the triangles
       of savedTriangles and those from oldTriangleCount on; the vertices of savedVertices (their source and share,
       never their place) and those from oldVertexCount on. So a view of the mesh needs to write no others. */
    bool isOpen; /* between Begin and Commit: only then can the mesh change, or be rolled back */
    uint32_t stamp;
    int32_t oldTriangleCount, oldVertexCount;
    uint32_t oldRevision;
    KIRI_ARRAY(kiriSavedTriangle) savedTriangles;
    KIRI_ARRAY(kiriSavedVertex) savedVertices;
    KIRI_ARRAY(kiriBirth) births; /* of vertex oldVertexCount and on */
} kiriMeshData;

/* Checks the caller's triangles and takes them over. On failure *why says what is wrong, in one line. `resolution` is the grid's, along the longer side. */
kiriResult kiriMesh_Init(kiriMeshData* mesh, kiriMemory* memory, const float* positions, int32_t vertexCount,
                         const int32_t* indices, int32_t triangleCount, int32_t resolution, const char** why);

/* The part of another mesh that the maps keep, on the same lattice and squares. The index that each triangle and vertex
   gets, in their old order, or KIRI_NONE; vertices are kept with all of their fan. False for memory. */
bool kiriMesh_InitPart(kiriMeshData* mesh, kiriMemory* memory, const kiriMeshData* from, const int32_t* triangleTo,
                       const int32_t* vertexTo);

/* Changes between Begin and Commit can be taken back as a whole: Rollback leaves the mesh and its squares as they
   were at Begin (see kiriSquares_Rollback), and the journal open. After Commit it changes nothing. Begin also empties the
   births. */
void kiriMesh_Begin(kiriMeshData* mesh);
void kiriMesh_Commit(kiriMeshData* mesh);
void kiriMesh_Rollback(kiriMeshData* mesh);

/* All three fail only for memory; the caller then rolls back. */

/* A new vertex at `at` (even coordinates) on half-edge h and its twin. The four (at the outline: two) new triangles
   must be counter-clockwise: see kiriMesh_CanSplitEdge. Returns the vertex on h's side, or KIRI_NONE. */
int32_t kiriMesh_SplitEdge(kiriMeshData* mesh, int32_t h, kiriLatticePoint at);

/* A new vertex inside a triangle: see kiriMesh_CanSplitTriangle. Returns it, or KIRI_NONE. */
int32_t kiriMesh_SplitTriangle(kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

/* Opens the edge, and gives each fan at its two ends a vertex of its own. */
bool kiriMesh_Open(kiriMeshData* mesh, int32_t h);

/* Would all new triangles be counter-clockwise? Exact. */
bool kiriMesh_CanSplitEdge(const kiriMeshData* mesh, int32_t h, kiriLatticePoint at);
bool kiriMesh_CanSplitTriangle(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

/* A triangle whose closure holds the point (the lowest index, so that lips of a cut do not matter), or KIRI_NONE. */
int32_t kiriMesh_Locate(const kiriMeshData* mesh, kiriLatticePoint at);

/* Twice the area, in lattice steps squared. Exact: cuts that do not split slanted outline edges never change it. */
int64_t kiriMesh_DoubledArea(const kiriMeshData* mesh);

/* The area, m^2. */
double kiriMesh_Area(const kiriMeshData* mesh);

/* The pieces: piece[t] for each triangle, numbered by their lowest triangle; and how many there are. */
void kiriMesh_Pieces(const kiriMeshData* mesh, int32_t* piece, int32_t* count);

/* Rest position of a lattice point in metres from the lattice's origin ("local"), and back to the nearest even point;
   positions outside four times the sheet's box are the caller's to clip. */
static inline kiriVec2 kiriMesh_Local(const kiriMeshData* mesh, kiriLatticePoint p)
{
    return kiriVec2_Make(mesh->step * p.x, mesh->step * p.y);
}

/* The nearest even point to one in lattice steps. */
kiriLatticePoint kiriMesh_Round(kiriVec2 lattice);
kiriLatticePoint kiriMesh_Snap(const kiriMeshData* mesh, kiriVec2 local);

static inline int32_t kiriEdge_Next(int32_t h)
{
    return h % 3 == 2 ? h - 2 : h + 1;
}
static inline int32_t kiriEdge_Previous(int32_t h)
{
    return h % 3 == 0 ? h + 2 : h - 1;
}

static inline int32_t kiriMesh_Tail(const kiriMeshData* mesh, int32_t h)
{
    return mesh->triangles.data[h / 3].vertex[h % 3];
}

static inline int32_t kiriMesh_Twin(const kiriMeshData* mesh, int32_t h)
{
    return mesh->triangles.data[h / 3].twin[h % 3];
}

static inline bool kiriMesh_IsOpen(const kiriMeshData* mesh, int32_t h)
{
    return (mesh->triangles.data[h / 3].open >> (h % 3) & 1) != 0;
}

static inline void kiriMesh_Corners(const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint corners[3])
{
    for (int i = 0; i < 3; ++i) {
        corners[i] = mesh->vertices.data[mesh->triangles.data[triangle].vertex[i]].at;
    }
}

#endif
