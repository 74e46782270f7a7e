/* Changing a mesh: splitting triangles, opening edges, and a journal by which all of it can be taken back. */
#ifndef KIRI_MESH_EDIT_H
#define KIRI_MESH_EDIT_H

#include "kiri_mesh.h"

KIRI_C_BEGIN

/* Begin opens the journal, Commit closes it; the mesh may change in between only. Rollback leaves the mesh and its
   squares as they were at Begin (see kiriSquares_Rollback), and the journal open; where it is closed it changes
   nothing. Begin also empties the births. */
void kiriMesh_Begin(kiriMeshData* mesh);
void kiriMesh_Commit(kiriMeshData* mesh);
void kiriMesh_Rollback(kiriMeshData* mesh);

/* These fail only on out of memory; the caller then rolls back. */

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
