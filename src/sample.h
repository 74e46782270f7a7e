/* Samples: points that take their weights from the grid (section 6 of the paper). Mesh vertices and collision points. */
#ifndef KIRI_SAMPLE_H
#define KIRI_SAMPLE_H

#include "frame.h"

/* The weights of a row of samples. */
typedef struct kiriSkin {
    KIRI_ARRAY(int32_t) start; /* samples + 1 */
    KIRI_ARRAY(kiriWeight) weights;
} kiriSkin;

/* A material point that the host collides with the world. */
typedef struct kiriSample {
    kiriPoint at; /* in the material */
    int32_t cell; /* that holds it */
} kiriSample;

typedef KIRI_ARRAY(kiriSample) kiriSamples;

/* What blended frames do at a point: linear-blend skinning and its velocity. A is not a rotation. */
typedef struct kiriMotion {
    kiriVec3 x, velocity, spin;
    kiriMat3 A, rate; /* rate: of A, all of it */
} kiriMotion;

void kiriSkin_Release(kiriSkin* skin, const kiriMemory* memory);

/* From scratch, for all vertices of the mesh; for all samples. False for memory. */
bool kiriSkin_BuildVertices(kiriSkin* skin, const kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                            const kiriMeshData* mesh);
bool kiriSkin_BuildSamples(kiriSkin* skin, const kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                           const kiriMeshData* mesh, const kiriSamples* samples);

/* Vertices born since kiriMesh_Begin take a blend of their parents' weights, so that they lie on the surface as it was.
   Truncate takes that back. */
bool kiriSkin_Inherit(kiriSkin* skin, const kiriMemory* memory, const kiriMeshData* mesh);
void kiriSkin_Truncate(kiriSkin* skin, int32_t sampleCount);

kiriVec3 kiriSkin_Position(const kiriSkin* skin, int32_t sample, const kiriFrameData* frames, kiriVec2 local);

/* The motion at a lattice point of a triangle, from the weights of its corners. */
kiriMotion kiriSkin_Motion(const kiriSkin* vertexSkin, const kiriFrameData* frames, const kiriMeshData* mesh,
                           int32_t triangle, kiriPoint at);

/* The cell that holds a lattice point of the material, or KIRI_NONE. */
int32_t kiriSample_Cell(const kiriGrid* grid, const kiriMeshData* mesh, kiriPoint at);

/* Sites for every piece that has none: `count` over the whole sheet in proportion to area, at least one in each such
   piece; farthest-point sampling and Lloyd relaxation. Those that are there stay. False for memory. */
bool kiriSites_Spread(kiriSites* sites, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                      kiriField* field, int32_t count);

/* The same for samples. */
bool kiriSamples_Spread(kiriSamples* samples, const kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                        kiriField* field, int32_t count);

#endif
