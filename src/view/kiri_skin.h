/* The patches that frames carry: flat ones, or bent as their neighbours tell. */
#ifndef KIRI_SKIN_H
#define KIRI_SKIN_H

#include "../field/kiri_link.h"
#include "../motion/kiri_frame.h"
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

/* What a frame's neighbours tell about its curvature: normal equations. */
typedef struct kiriBend {
    double uu, uv, vv;    /* sums of W s s */
    double ruu, ruv, rvv; /* and of W s t, t being how the director turns over s */
} kiriBend;

/* Flat patches; `count` frames have one each. Here and below only `some` of them are written, unless that is null. */
void kiriCarriers_Write(kiriCarrier* carriers, const kiriFrameData* frames, int32_t count, const kiriIndices* some);

/* Bends them as the links tell: all, or those of `someLinks`, ascending, that are below linkCount. `bends` is scratch,
   one a frame. */
void kiriCarriers_Bend(kiriCarrier* carriers, kiriBend* bends, const kiriFrameData* frames, int32_t count,
                       const kiriLink* links, int32_t linkCount, const kiriIndices* some, const kiriIndices* someLinks);

/* Linear-blend skinning in floats (section 4.1 of the paper). */

/* Carriers as skinning reads them, in rows of floats: a row a label of weights. */
enum { KIRI_FLAT_FLOATS = 12, KIRI_BENT_FLOATS = 24 };

/* Is a patch other than before it was written last? By rounding alone: nobody could see it. */
enum kiriPatchChange { KIRI_PATCH_SAME, KIRI_PATCH_ROUNDED, KIRI_PATCH_OTHER };

typedef struct kiriPatches {
    KIRI_ARRAY(float) floats;
    KIRI_ARRAY(uint8_t) isOther; /* one a row: KIRI_PATCH_... */
    int32_t count;               /* of rows */
    bool isBent;
    bool areOther; /* is any? */
} kiriPatches;

/* Room for so many. */
bool kiriPatches_Reserve(kiriPatches* patches, kiriMemory* memory, int32_t count);

/* Those of `count` frames, which have these labels. Positions are measured from `from`: near the sheet floats tell its
   points apart. Only those of `some`, unless that is null, may be other than they were written last. Returns whether
   any patch is other than before. */
bool kiriPatches_Write(kiriPatches* patches, const kiriLabels* labels, const kiriCarrier* carriers, int32_t count,
                       kiriVec3 from, bool isBent, const kiriIndices* some);

/* None is as before when they are written next. */
void kiriPatches_Forget(kiriPatches* patches);

/* May a sample from `begin` to `end` be elsewhere, because a patch that carries it is other than before? */
bool kiriPatches_MayMove(const kiriPatches* patches, const kiriSkin* skin, int32_t begin, int32_t end);

/* Where the samples from `begin` to `end` are, 3 floats each, by their rest points. Writes nothing else: ranges may be
   written at the same time. */
void kiriSkin_WritePositions(const kiriSkin* skin, const kiriPatches* patches, const kiriVec2* rest, int32_t begin,
                             int32_t end, float* positions);

/* Normals of vertices: the mean of those of their triangles, by area. */

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
