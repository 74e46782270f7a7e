/* Normals of vertices: the mean of those of their triangles, by area. */
#ifndef KIRI_NORMAL_H
#define KIRI_NORMAL_H

#include "../mesh/kiri_mesh.h"

KIRI_C_BEGIN

/* Triangles by their corners, 3 each, and how each two are turned: to a, b, c and a, c, d where they share an edge. */
typedef struct kiriCorners {
    const int32_t* indices;
    const uint8_t* turns; /* one for two triangles, see kiriNormals_TurnOf */
    int32_t triangleCount;
} kiriCorners;

/* Of two triangles, or of one alone. */
uint8_t kiriNormals_TurnOf(const int32_t* indices, bool isAlone);

/* Sums for the normals, 4 floats a vertex, by 3 floats of position each. One float more than the positions is read. */
void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const kiriCorners* corners);

/* The sum of one vertex anew, the same bits. The mesh is that of the corners, but for triangles that are hidden. False
   where too many triangles meet in it: nothing is written. */
bool kiriNormals_SumOne(float* slopes, int32_t vertex, const float* positions, const kiriCorners* corners,
                        const kiriMeshData* mesh);

/* The normals from `begin` to `end`, 3 floats each; up where triangles tell none. Writes nothing else. */
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end);

KIRI_C_END

#endif
