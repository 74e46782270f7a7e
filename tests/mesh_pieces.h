/* The pieces of a mesh. */
#ifndef KIRI_TEST_MESH_PIECES_H
#define KIRI_TEST_MESH_PIECES_H

#include "core/kiri_array.h"
#include "mesh/kiri_mesh.h"

/* Gives each triangle the number of its piece, by the lowest triangles; returns how many pieces there are. */
static inline int32_t NumberPieces(const kiriMeshData* mesh, int32_t* piece)
{
    kiriUnion_Init(piece, mesh->triangles.count);
    for (int32_t h = 0; h < 3 * mesh->triangles.count; ++h) {
        int32_t twin = kiriMesh_Twin(mesh, h);
        if (twin != KIRI_NONE && !kiriMesh_IsOpen(mesh, h)) {
            kiriUnion_Join(piece, h / 3, twin / 3);
        }
    }
    int32_t sets = 0;
    for (int32_t t = 0; t < mesh->triangles.count; ++t) {
        piece[t] = piece[t] == t ? sets++ : piece[piece[t]];
    }
    return sets;
}

#endif
