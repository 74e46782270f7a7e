/* Is a mesh that was read one that can be cut? */
#ifndef KIRI_MESH_CHECK_H
#define KIRI_MESH_CHECK_H

#include "../core/kiri_check.h"
#include "kiri_mesh.h"
#include "../core/kiri_archive.h"

KIRI_C_BEGIN

/* Counts what there is of the mesh, for rules about all else. */
void kiriMesh_Count(const kiriMeshData* mesh, kiriCheck* check);

/* All of it: what it points to, and that it is one conforming triangulation, listed in the squares where it lies. */
bool kiriMesh_Check(const kiriMeshData* mesh, kiriCheck* check);

/* The mesh as bytes: see core/kiri_archive.h. */

extern const kiriTable kiriMeshTable;

/* What follows from the rest, where bytes were read. */
void kiriMesh_EndReading(kiriMeshData* mesh, kiriMemory* memory);

KIRI_C_END

#endif
