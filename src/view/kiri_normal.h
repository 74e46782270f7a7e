/* Normals of vertices: the mean of those of their triangles, by area. */
#ifndef KIRI_NORMAL_H
#define KIRI_NORMAL_H

#include "../mesh/kiri_mesh.h"

KIRI_C_BEGIN

/* Sums for the normals, 4 floats a vertex, by 3 floats of position each. `corners` are 6 for two triangles: a, b, c and
   a, c, d where they share an edge. One float more than the positions is read. */
void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const int32_t* corners,
                     int32_t triangleCount);

/* The sum of one vertex anew, the same bits. The mesh is that of the corners, but for triangles that are hidden. False where
   too many triangles meet in it: nothing is written. */
bool kiriNormals_SumOne(float* slopes, int32_t vertex, const float* positions, const int32_t* corners,
                        const kiriMeshData* mesh);

/* The normals from `begin` to `end`, 3 floats each; up where triangles tell none. Writes nothing else. */
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end);

KIRI_C_END

#endif
