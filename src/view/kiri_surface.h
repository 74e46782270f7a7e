/* The surface in world space: the arrays that the host reads. Fades hide the jump when a cut takes effect: samples
   start at their previous positions and go over to the new ones within a few ticks. */
#ifndef KIRI_SURFACE_H
#define KIRI_SURFACE_H

#include "../core/kiri_archive.h"
#include "../core/kiri_array.h"
#include "../core/kiri_vec.h"
#include "kiri_detail.h"
#include "kiri_skin.h"
#include "../motion/kiri_frame.h"

KIRI_C_BEGIN

typedef struct kiriFading {
    int32_t sample;
    double left; /* s until its end */
    kiriVec3 offset;
} kiriFading;

/* Samples that are not at the positions of their weights. Reserve `fading` for all samples, so that these functions cannot fail. */
typedef struct kiriFades {
    double time;                   /* s that a jump takes; 0: samples jump at once */
    double least;                  /* m: shorter offsets are dropped */
    KIRI_ARRAY(kiriFading) fading; /* in the order of samples */
    int32_t older;                 /* while jumps are taken: the next old fade, at the end of the room */
    double jump, move;             /* m, in this tick: the longest jump, and the longest way of a fade */
} kiriFades;

/* Frees the memory if nothing fades. */
void kiriFades_Trim(kiriFades* fades, kiriMemory* memory);

/* Removes the samples that are not kept. */
void kiriFades_Keep(kiriFades* fades, const kiriKeep* samples);

/* When a cut takes effect: Start, then Take, in ascending order, for each sample that fades or may have jumped.
   `offset` is from the new position of its weights to the position that was last written. */
void kiriFades_Start(kiriFades* fades);
void kiriFades_TakeJump(kiriFades* fades, int32_t sample, kiriVec3 offset);

/* Returns true if the sample, the next to take, fades already. */
static inline bool kiriFades_Has(const kiriFades* fades, int32_t sample)
{
    return fades->older < fades->fading.capacity && fades->fading.data[fades->older].sample == sample;
}

static inline void kiriFades_Take(kiriFades* fades, int32_t sample, kiriVec3 offset)
{
    if (kiriFades_Has(fades, sample) || kiriVec3_Dot(offset, offset) > fades->least * fades->least) { /* few do */
        kiriFades_TakeJump(fades, sample, offset);
    }
}

/* Shortens all offsets, after a tick of dt. */
void kiriFades_Advance(kiriFades* fades, double dt);

/* A commit, for hosts that keep the mesh elsewhere. */
typedef struct kiriChange {
    uint32_t from, to; /* revisions */
    int32_t oldVertexCount, oldTriangleCount;
    kiriRange vertices, triangles; /* the smallest ranges that hold all old items that changed */
} kiriChange;

enum { KIRI_CHANGES = 32 };

typedef struct kiriSurface {
    int32_t skinning; /* KIRI_SKINNING_... */
    kiriVec2 origin;  /* m, rest plane: of local coordinates */
    double longer;    /* m: side of the sheet */

    /* Arrays that the host reads. The mesh may change before they do. */
    kiriFloats positions, normals, restPositions, sourceWeights;
    kiriIndices indices, sourceTriangles;
    int32_t vertexCount, triangleCount;
    uint32_t revision;

    KIRI_ARRAY(kiriVec2) rest; /* local m */
    kiriFlags turns;           /* of pairs of triangles, for normals: see kiriCorners */
    kiriFloats slopes;         /* sums for the normals, 4 a vertex; before that scratch of the detail layer */
    int64_t pose;              /* grows whenever positions or corners may have changed */
    kiriVec3 middle;           /* m: near the sheet; 0 if the sheet is near the origin of the world */
    KIRI_ARRAY(float) places;  /* the skin from `middle`, 3 a vertex; unused if it is `positions`, see Places */
    kiriDetail detail;
    KIRI_ARRAY(float) before;  /* for blades: the places at the start of the last tick; empty: nothing moved, or not known */
    kiriVec3 middleBefore;     /* m: `middle` at that time */
    KIRI_ARRAY(kiriCarrier) carriers;
    KIRI_ARRAY(kiriBend) bends;
    kiriPatches patches;
    bool isWritten;    /* positions are up to date with the patches */
    bool isSteady;     /* positions were up to date when last written, but for fades */
    bool isPartly;     /* isSteady, and since then only patches of awake frames have changed */
    bool wantsNormals; /* the host asks for normals */
    bool hasNormals;   /* normals are up to date with the positions */
    bool hasSlopes;    /* slopes are up to date with the positions */

    kiriChange changes[KIRI_CHANGES]; /* a ring */
    int32_t changeCount, lastChange;
} kiriSurface;

/* Returns true if the sheet is so far from the origin of the world that floats would round its positions too much. */
static inline bool kiriSurface_IsFar(const kiriSurface* surface)
{
    return surface->middle.x != 0.0 || surface->middle.y != 0.0 || surface->middle.z != 0.0;
}

static inline bool kiriSurface_HasDetail(const kiriSurface* surface)
{
    return kiriDetail_IsOn(&surface->detail);
}

/* Returns the positions of the skin from `middle`, 3 floats a vertex. */
static inline float* kiriSurface_Places(const kiriSurface* surface)
{
    bool isApart = kiriSurface_IsFar(surface) || kiriSurface_HasDetail(surface);
    return isApart ? surface->places.data : surface->positions.data;
}

/* Returns the drawn positions from `middle`, 3 floats a vertex: with the detail layer. */
static inline const float* kiriSurface_Drawn(const kiriSurface* surface)
{
    return kiriSurface_HasDetail(surface) ? surface->detail.drawn.data : kiriSurface_Places(surface);
}

/* Returns the position of a vertex of the skin in world space, exact to 1e-6 of the size of the sheet. */
static inline kiriVec3 kiriSurface_At(const kiriSurface* surface, int32_t vertex)
{
    return kiriVec3_Add(surface->middle, kiriVec3_Load(kiriSurface_Places(surface) + 3 * vertex));
}

/* Returns a blend of up to three vertices of the skin. Missing vertices come last and are KIRI_NONE. */
static inline kiriVec3 kiriSurface_Blend(const kiriSurface* surface, const int32_t vertex[3], const double share[3])
{
    kiriVec3 at = kiriVec3_Make(0.0, 0.0, 0.0);
    for (int k = 0; k < 3 && vertex[k] != KIRI_NONE; ++k) {
        at = kiriVec3_AddScaled(at, share[k], kiriSurface_At(surface, vertex[k]));
    }
    return at;
}

/* Returns how far a vertex came in the last tick. */
static inline kiriVec3 kiriSurface_Came(const kiriSurface* surface, int32_t vertex)
{
    bool isKnown = surface->before.count == 3 * surface->vertexCount;
    kiriVec3 before =
        isKnown ? kiriVec3_Load(surface->before.data + 3 * vertex) : kiriVec3_Make(0.0, 0.0, 0.0);
    return isKnown ? kiriVec3_Sub(kiriSurface_At(surface, vertex), kiriVec3_Add(surface->middleBefore, before))
                   : before;
}

/* Returns the drawn position of a vertex in world space. */
static inline kiriVec3 kiriSurface_DrawnAt(const kiriSurface* surface, int32_t vertex)
{
    return kiriVec3_Add(surface->middle, kiriVec3_Load(kiriSurface_Drawn(surface) + 3 * vertex));
}

static inline void kiriSurface_Place(kiriSurface* surface, int32_t vertex, kiriVec3 at)
{
    kiriVec3_Store(kiriSurface_Places(surface) + 3 * vertex, kiriVec3_Sub(at, surface->middle));
}

/* Reserves room for these numbers of vertices, triangles and frames. */
bool kiriSurface_Reserve(kiriSurface* surface, kiriMemory* memory, int64_t vertices, int64_t triangles,
                         int32_t frameCount);

/* Sets the counts of all arrays, for which there is room. Before WriteTopology, and when frames change. */
void kiriSurface_Resize(kiriSurface* surface, int32_t vertices, int32_t triangles, int32_t frameCount);

/* Remembers the places, for kiriSurface_Came. Room is reserved. */
void kiriSurface_Remember(kiriSurface* surface);

/* Takes over what kiriMesh_Begin's journal says has changed; call it before kiriMesh_Commit. The first time
   all of the mesh. */
void kiriSurface_WriteTopology(kiriSurface* surface, const kiriMeshData* mesh);

/* Derives what depends on the mesh alone, of the vertices and triangles from the first ones on, after Resize. */
void kiriSurface_Derive(kiriSurface* surface, const kiriMeshData* mesh, int32_t firstVertex, int32_t firstTriangle);

/* New arrays for a surface. The host may still hold the old ones. */
typedef struct kiriShown {
    kiriFloats positions, normals, restPositions, sourceWeights;
    kiriIndices indices, sourceTriangles;
} kiriShown;

/* Makes room for the kept items, in the memory of the surface. Returns false on out of memory: then call Release. */
bool kiriShown_Reserve(kiriShown* shown, kiriMemory* memory, const kiriKeep* triangles, const kiriKeep* vertices);
void kiriShown_Release(kiriShown* shown, kiriMemory* memory);

/* Replaces an array by `fresh`, with the items that are kept, `each` numbers of 4 bytes an item. */
void kiriShown_Take(const kiriKeep* keep, void* array, const void* fresh, int32_t each, kiriMemory* retired);

/* Removes the triangles, vertices and frames that were removed from the mesh. The others keep their positions. The old
   arrays get the owner `retired`. Cannot fail. */
void kiriSurface_Keep(kiriSurface* surface, kiriShown* shown, const kiriKeep* triangles, const kiriKeep* vertices,
                      const kiriMeshData* mesh, int32_t frameCount, kiriMemory* retired);

/* Returns the three vertices of a triangle. */
static inline int32_t* kiriSurface_Triangle(const kiriSurface* surface, int32_t triangle)
{
    return &surface->indices.data[3 * triangle];
}

/* Hides a triangle: sets its corners to the first. */
void kiriSurface_HideTriangle(kiriSurface* surface, int32_t triangle);

/* Takes over the current frames. The links determine how a smooth surface bends and stretches; a linear surface ignores
   them. Arrays are not written again if nothing has changed. `moved`: the only frames that may have moved since the last call, and
   `movedLinks`: their links; or null. */
void kiriSurface_TakeFrames(kiriSurface* surface, const kiriFrameData* frames, int32_t frameCount,
                            const kiriPulls* pulls, const kiriIndices* moved, const kiriIndices* movedLinks);

/* Writes the positions of the vertices from `begin` to `end`, without fades. Ranges may be written in parallel. */
void kiriSurface_BlendRange(kiriSurface* surface, const kiriSkin* skin, int32_t begin, int32_t end);

/* Turns the detail layer on or off, or changes its sweeps. isHeld: seams and pins give drawn vertices offsets. Room is
   reserved. The next tick writes all positions. */
void kiriSurface_SetDetail(kiriSurface* surface, int32_t sweeps, bool isHeld);

/* Reserves room for drawn vertices with offsets. */
bool kiriSurface_ReserveHeld(kiriSurface* surface, kiriMemory* memory);

/* Adds the offsets of fades to the positions. */
void kiriSurface_AddFades(kiriSurface* surface, const kiriFades* fades);

/* Writes the drawn positions of the vertices from `begin` to `end`, if there is a detail layer. */
void kiriSurface_DrawRange(kiriSurface* surface, int32_t begin, int32_t end);

/* Writes the sums for the normals, once in a tick when all positions are written, if the host asks for normals. */
void kiriSurface_SumNormals(kiriSurface* surface);

/* Writes the sum of one vertex. Returns false if too many triangles meet in it. */
bool kiriSurface_SumNormal(kiriSurface* surface, const kiriMeshData* mesh, int32_t vertex);

/* Writes the positions and normals that the host reads, of the vertices from `begin` to `end`. Ranges may be written in
   parallel. */
void kiriSurface_WriteRange(kiriSurface* surface, int32_t begin, int32_t end);

/* Makes the normals if the tick did not, with the same bits. */
void kiriSurface_NeedNormals(kiriSurface* surface);

/* Writes the changes since a revision; everything, if it is too old. */
void kiriSurface_GetDirty(const kiriSurface* surface, uint32_t sinceRevision, kiriDirty* dirty);

/* Copies positions and normals of `count` vertices. Null: does not copy these. Strides in bytes. */
void kiriSurface_CopyVertices(const kiriSurface* surface, int32_t first, int32_t count, void* positions,
                              int32_t positionStride, void* normals, int32_t normalStride);

/* Returns false if there are too many vertices for 16 bits. 65535 restarts primitives, so it is not a vertex. */
bool kiriSurface_CopyIndices16(const kiriSurface* surface, int32_t firstTriangle, int32_t count, uint16_t* indices);

/* Builds the surface with a thickness, to draw: its two sides, and a rim along all borders, also lips of cuts. The
   arrays are in one block of `memory`. Returns false on out of memory. */
bool kiriSolid_Build(kiriSolid* solid, kiriMemory* memory, const kiriSurface* surface, const kiriMeshData* mesh,
                     double thickness);

/* Tables for saves, see core/kiri_archive.h. */
kiriTableFn kiriSkinTable, kiriPlacesTable, kiriRefreshTable, kiriFadesTable, kiriSurfaceTable;

/* Returns true if loaded fades are of samples, each once. */
bool kiriFades_AreSound(const kiriFades* fades, int32_t samples);

/* Returns true if the changes of a loaded surface are within it. */
bool kiriSurface_AreChangesSound(const kiriSurface* surface);

KIRI_C_END

#endif
