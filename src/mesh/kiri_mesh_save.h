/* The mesh as bytes: see core/kiri_archive.h. */
#ifndef KIRI_MESH_SAVE_H
#define KIRI_MESH_SAVE_H

#include "../core/kiri_archive.h"
#include "kiri_mesh.h"

KIRI_C_BEGIN

extern const kiriTable kiriMeshTable;

/* What follows from the rest, where bytes were read. */
void kiriMesh_EndReading(kiriMeshData* mesh, kiriMemory* memory);

KIRI_C_END

#endif
