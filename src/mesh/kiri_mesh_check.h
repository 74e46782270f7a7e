/* A mesh as bytes, and the checks of a mesh that was loaded. */
#ifndef KIRI_MESH_CHECK_H
#define KIRI_MESH_CHECK_H

#include "../core/kiri_archive.h"
#include "kiri_mesh.h"

KIRI_C_BEGIN

/* A save has triangles, vertices and sources. Squares and their lists are derived. */
kiriTableFn kiriMeshTable;

/* Ends the load of a save, whose numbers are in range: checks that the mesh is one conforming triangulation, and fills
   its squares. Charges them to the room of the archive. */
void kiriMesh_Derive(kiriMeshData* mesh, kiriArchive* archive);

KIRI_C_END

#endif
