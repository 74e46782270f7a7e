/* The surface that the host sees: the mesh as the frames carry it. It has corners and rest positions of its own, so
   that the mesh may change while the surface still shows what was before. */
#ifndef KIRI_SURFACE_H
#define KIRI_SURFACE_H

#include "kiri_fade.h"
#include "../field/kiri_link.h"
#include "kiri_sample.h"

KIRI_C_BEGIN

/* A frame as skinning reads it: the rest point p goes to x + a u + b v + c d. In a flat patch (a, b) is q = p - center
   and c is 0; a bent one follows the arc that its curvature gives, see kiri_surface.c. */
typedef struct kiriCarrier {
    kiriVec3 origin; /* where the flat patch has the local origin */
    kiriVec3 u, v, d, x;
    kiriVec2 center;
    double uu, uv, vv, six; /* curvature K, 1/m; 6 for a rigid frame */
} kiriCarrier;

/* What a frame's neighbours tell about its curvature: normal equations. */
typedef struct kiriBend {
    double uu, uv, vv;    /* sums of W s s */
    double ruu, ruv, rvv; /* and of W s t, t being how the director turns over s */
} kiriBend;

/* A commit, for hosts that keep the mesh elsewhere. */
typedef struct kiriChange {
    uint32_t from, to; /* revisions */
    int32_t oldVertexCount, oldTriangleCount;
    kiriRange vertices, triangles; /* the least that hold all old ones that are other than before */
} kiriChange;

enum { KIRI_CHANGES = 32 };

typedef struct kiriSurface {
    int32_t skinning; /* KIRI_SKINNING_... */
    kiriVec2 origin;  /* m, rest plane: of local coordinates */

    /* What the host reads. */
    KIRI_ARRAY(float) positions, normals, restPositions, sourceWeights;
    KIRI_ARRAY(int32_t) indices, sourceTriangles;
    int32_t vertexCount, triangleCount;
    uint32_t revision;

    KIRI_ARRAY(kiriVec2) rest;   /* local m */
    KIRI_ARRAY(int32_t) corners; /* 6 for two triangles: turned to a, b, c and a, c, d where they share an edge */
    KIRI_ARRAY(kiriVec3) exact;  /* positions: floats far from the origin tell corners no more apart */
    KIRI_ARRAY(kiriVec3) slopes; /* sums for the normals */
    int64_t pose;                /* grows whenever positions or corners may have changed */
    KIRI_ARRAY(kiriCarrier) carriers;
    KIRI_ARRAY(kiriBend) bends;

    kiriChange changes[KIRI_CHANGES]; /* a ring */
    int32_t changeCount, lastChange;
} kiriSurface;

/* Room for the mesh as it is and for so many frames; after it the others never fail. */
bool kiriSurface_Resize(kiriSurface* surface, kiriMemory* memory, const kiriMeshData* mesh, int32_t frameCount);

/* Takes over what kiriMesh_Begin's journal says has changed; call it before kiriMesh_Commit. The first time
   all of the mesh. */
void kiriSurface_WriteTopology(kiriSurface* surface, const kiriMeshData* mesh);

/* Arrays for what is left of those that the host reads, which may hold the old ones. */
typedef struct kiriShown {
    KIRI_ARRAY(float) positions, normals, restPositions, sourceWeights;
    KIRI_ARRAY(int32_t) indices, sourceTriangles;
} kiriShown;

/* Room for what is kept, in the memory of the surface. False for memory: what is there is to be released. */
bool kiriShown_Reserve(kiriShown* shown, kiriMemory* memory, const kiriKeep* triangles, const kiriKeep* vertices);
void kiriShown_Release(kiriShown* shown, kiriMemory* memory);

/* Triangles, vertices and frames have been taken away from the mesh: so they are from the surface. What is left is seen
   where it was. The arrays that the host may hold get the owner `retired`. Never fails. */
void kiriSurface_Keep(kiriSurface* surface, kiriShown* shown, const kiriKeep* triangles, const kiriKeep* vertices,
                      const kiriMeshData* mesh, int32_t frameCount, kiriMemory* retired);

/* The indices get a new array, for the host may hold the old one, which gets the owner `retired`. False for memory. */
bool kiriSurface_RenewIndices(kiriSurface* surface, kiriMemory* memory, kiriMemory* retired);

/* A triangle is seen no more: all its corners are the first. */
void kiriSurface_HideTriangle(kiriSurface* surface, int32_t triangle);

/* Where the vertices are now, in doubles, from the frames. The links tell a smooth surface how to bend; a linear one does
   not ask. */
void kiriSurface_Blend(kiriSurface* surface, const kiriSkin* skin, const kiriFrameData* frames, int32_t frameCount,
                       const kiriLink* links, int32_t linkCount);

/* Moves the vertices that are seen elsewhere. */
void kiriSurface_AddFades(kiriSurface* surface, const kiriFades* fades);

/* The positions and normals that the host reads: once in a tick. */
void kiriSurface_WriteArrays(kiriSurface* surface);

/* What has changed since the host saw that revision: all, where that is too long ago. */
void kiriSurface_GetDirty(const kiriSurface* surface, uint32_t sinceRevision, kiriDirty* dirty);

/* Copies of `count` items from `first` on. Null: without these. Strides in bytes. */
void kiriSurface_CopyVertices(const kiriSurface* surface, int32_t first, int32_t count, void* positions,
                              int32_t positionStride, void* normals, int32_t normalStride);

/* False where the vertices are too many for 16 bits (65535 restarts primitives, and is no vertex). */
bool kiriSurface_CopyIndices16(const kiriSurface* surface, int32_t firstTriangle, int32_t count, uint16_t* indices);

KIRI_C_END

#endif
