/* Skinning: the patches that frames carry, the positions of samples, and normals. */
#ifndef KIRI_SKIN_H
#define KIRI_SKIN_H

#include "../field/kiri_link.h"
#include "../motion/kiri_strain.h"
#include "kiri_sample.h"
#include "../mesh/kiri_mesh.h"

KIRI_C_BEGIN

/* The patch that a frame carries: the rest point p goes to x + a u + b v + c d. In a flat patch (a, b) is q = p -
   center and c is 0; a bent one follows the arc that its curvature gives, see kiri_skin.c. */
typedef struct kiriCarrier {
    kiriVec3 u, v, d, x;
    kiriVec2 center;
    double uu, uv, vv, six; /* curvature K, 1/m; 6 for a rigid frame */
} kiriCarrier;

/* Normal equations for curvature and strain of a patch, from the neighbors of its frame (kiriTensor_Solve). */
typedef struct kiriBend {
    kiriTensor matrix;   /* sum of w s s^T; s: way to the neighbor, w: width of the link */
    kiriVec2 turnBy[2];  /* sum of w t s^T; t: turn of the director over s */
    kiriVec2 longerBy[2]; /* the same; t: how much longer s is */
    double width;         /* m: of the links, summed */
    kiriVec2 open;        /* m: of the free border: normal times length, integrated; 0 inside the sheet */
} kiriBend;

/* Writes flat patches, one a frame. Here and below only `some` frames are written, unless that is null. */
void kiriCarriers_Write(kiriCarrier* carriers, const kiriFrameData* frames, int32_t count, const kiriIndices* some);

/* What bends and stretches patches. */
typedef struct kiriPulls {
    const kiriLink* links;
    int32_t count; /* of links */
    bool areRigid; /* the frames: their patches stretch too */
    const kiriMaterial* material;
} kiriPulls;

/* Bends and stretches the patches by the links: all links, or `someLinks` (ascending). `bends` is scratch, one a frame. */
void kiriCarriers_Fit(kiriCarrier* carriers, kiriBend* bends, const kiriFrameData* frames, int32_t count,
                      const kiriPulls* pulls, const kiriIndices* some, const kiriIndices* someLinks);

/* Linear-blend skinning in floats (section 4.1 of the paper). */

/* Carriers as rows of floats, for skinning: one a frame. */
enum { KIRI_FLAT_FLOATS = 12, KIRI_BENT_FLOATS = 24 };

/* Change of a row when it was last written. ROUNDED: the change is too small to be visible. */
enum kiriPatchChange { KIRI_PATCH_SAME, KIRI_PATCH_ROUNDED, KIRI_PATCH_OTHER };

typedef struct kiriPatches {
    kiriFloats floats;
    kiriFlags isOther;           /* of each row: KIRI_PATCH_... */
    int32_t count;               /* of rows */
    bool isBent;
    bool areOther; /* a row is not KIRI_PATCH_SAME */
} kiriPatches;

bool kiriPatches_Reserve(kiriPatches* patches, kiriMemory* memory, int32_t count);

/* Writes the rows of `count` frames. Positions are relative to `from`, near the sheet, so that floats are exact enough.
   Only `some` frames, unless that is null, may have changed. Returns true if a row changed. */
bool kiriPatches_Write(kiriPatches* patches, const kiriCarrier* carriers, int32_t count, kiriVec3 from, bool isBent,
                       const kiriIndices* some);

/* Makes all rows count as changed when they are written next. */
void kiriPatches_Forget(kiriPatches* patches);

/* Returns true if a patch that carries a sample from `begin` to `end` has changed. */
bool kiriPatches_MayMove(const kiriPatches* patches, const kiriSkin* skin, int32_t begin, int32_t end);

/* Writes the positions of the samples from `begin` to `end`, 3 floats each, from their rest points. Ranges may be written
   in parallel. */
void kiriSkin_WritePositions(const kiriSkin* skin, const kiriPatches* patches, const kiriVec2* rest, int32_t begin,
                             int32_t end, float* positions);

/* Normals of vertices: area-weighted means of the normals of their triangles. */

/* Triangles, and the turn of each pair of them: to corners a, b, c and a, c, d if they share an edge. */
typedef struct kiriCorners {
    const int32_t* indices; /* 3 a triangle */
    const uint8_t* turns;   /* one a pair, see kiriNormals_TurnOf */
    int32_t triangleCount;
} kiriCorners;

/* Returns the turn of two triangles, or of one alone. */
uint8_t kiriNormals_TurnOf(const int32_t* indices, bool isAlone);

/* Writes the sums for the normals, 4 floats a vertex, from 3 floats of position each. Reads one float beyond the
   positions. */
void kiriNormals_Sum(float* slopes, int32_t vertexCount, const float* positions, const kiriCorners* corners);

/* Writes the sum of one vertex, with the same bits. The mesh has the same triangles, some of which may be hidden. Returns
   false if too many triangles meet in the vertex: then nothing is written. */
bool kiriNormals_SumOne(float* slopes, int32_t vertex, const float* positions, const kiriCorners* corners,
                        const kiriMeshData* mesh);

/* Writes the normals from `begin` to `end`, 3 floats each: up where the sum is 0. Ranges may be written in parallel. */
void kiriNormals_Write(float* normals, const float* slopes, int32_t begin, int32_t end);

KIRI_C_END

#endif
