/* What is left of a jump when a cut takes effect: samples are seen to go on where they were, and go over to where the
   new weights have them within a few ticks. */
#ifndef KIRI_SURFACE_H
#define KIRI_SURFACE_H

#include "../core/kiri_keep.h"
#include "../core/kiri_vec.h"
#include "kiri_skin.h"
#include "../motion/kiri_frame.h"

KIRI_C_BEGIN

typedef struct kiriFading {
    int32_t sample;
    double left; /* s until it is gone */
    kiriVec3 offset;
} kiriFading;

/* Of a row of samples: those that are seen elsewhere than their weights have them. */
typedef struct kiriFades {
    double time;                   /* s that a jump takes; 0: samples jump at once */
    double least;                  /* m: what is less is not seen */
    KIRI_ARRAY(kiriFading) fading; /* by sample */
    int32_t older;                 /* while jumps are taken: the next of those from before, at the end of the room */
    double jump, move;             /* m, in this tick: the longest jump that came, and way that a fade went */
} kiriFades;

/* Room for so many samples, so that the others do not fail; none is needed where jumps take no time. */
bool kiriFades_Reserve(kiriFades* fades, kiriMemory* memory, int32_t sampleCount);

/* Gives memory back where nothing fades. */
void kiriFades_Trim(kiriFades* fades, kiriMemory* memory);
void kiriFades_Release(kiriFades* fades, kiriMemory* memory);

/* Samples are taken away. */
void kiriFades_Keep(kiriFades* fades, const kiriKeep* samples);

/* A cut takes effect: Start, then Take, in their order, for each sample that fades, or whose place may be another. The
   sample is seen so far from where it would be if nothing faded: from here on that fades. */
void kiriFades_Start(kiriFades* fades);
void kiriFades_TakeJump(kiriFades* fades, int32_t sample, kiriVec3 offset);

/* Does the sample, which is the next to take, fade already? */
static inline bool kiriFades_Has(const kiriFades* fades, int32_t sample)
{
    return fades->older < fades->fading.capacity && fades->fading.data[fades->older].sample == sample;
}

/* Or one before `end`? */
static inline bool kiriFades_HasBelow(const kiriFades* fades, int32_t end)
{
    return fades->older < fades->fading.capacity && fades->fading.data[fades->older].sample < end;
}

static inline void kiriFades_Take(kiriFades* fades, int32_t sample, kiriVec3 offset)
{
    if (kiriFades_Has(fades, sample) || kiriVec3_Dot(offset, offset) > fades->least * fades->least) { /* few do */
        kiriFades_TakeJump(fades, sample, offset);
    }
}

/* Time goes on. */
void kiriFades_Advance(kiriFades* fades, double dt);

/* The surface that the host sees: the mesh as the frames carry it. It has corners and rest positions of its own, so
   that the mesh may change while the surface still shows what was before. */

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
    double longer;    /* m: side of the sheet */

    /* What the host reads. */
    KIRI_ARRAY(float) positions, normals, restPositions, sourceWeights;
    KIRI_ARRAY(int32_t) indices, sourceTriangles;
    int32_t vertexCount, triangleCount;
    uint32_t revision;
    int32_t lentAt; /* the tick after which the host got the indices last, from 1 on */

    KIRI_ARRAY(kiriVec2) rest; /* local m */
    KIRI_ARRAY(uint8_t) turns; /* of the indices, for normals: see kiriCorners */
    KIRI_ARRAY(float) slopes;  /* 4 a vertex: sums for the normals */
    int64_t pose;              /* grows whenever positions or corners may have changed */
    kiriVec3 middle;           /* m: near the sheet; 0 where that is near the origin of the world */
    KIRI_ARRAY(float) places;  /* 3 a vertex, from `middle`, where that is not 0: else the positions have them */
    KIRI_ARRAY(kiriCarrier) carriers;
    KIRI_ARRAY(kiriBend) bends;
    kiriPatches patches;
    bool isWritten;                /* the arrays show the patches as they are; */
    bool isSteady;                 /* they did when positions were written last, but for what fades; */
    bool isPartly;                 /* and since then patches have changed of what is awake alone */
    bool wantsNormals, hasNormals; /* the host asks for them; they are those of where vertices are seen, */
    bool hasSlopes;                /* and so are the sums that they are made of */

    kiriChange changes[KIRI_CHANGES]; /* a ring */
    int32_t changeCount, lastChange;
} kiriSurface;

/* Floats far from the origin of the world tell corners no more apart. */
static inline bool kiriSurface_IsFar(const kiriSurface* surface)
{
    return surface->middle.x != 0.0 || surface->middle.y != 0.0 || surface->middle.z != 0.0;
}

/* 3 floats a vertex, from `middle`. */
static inline float* kiriSurface_Places(const kiriSurface* surface)
{
    return kiriSurface_IsFar(surface) ? surface->places.data : surface->positions.data;
}

/* Where a vertex is seen: to 1e-6 of the sheet's size. */
static inline kiriVec3 kiriSurface_At(const kiriSurface* surface, int32_t vertex)
{
    return kiriVec3_Add(surface->middle, kiriVec3_Load(kiriSurface_Places(surface) + 3 * (ptrdiff_t)vertex));
}

static inline void kiriSurface_Place(kiriSurface* surface, int32_t vertex, kiriVec3 at)
{
    kiriVec3_Store(kiriSurface_Places(surface) + 3 * (ptrdiff_t)vertex, kiriVec3_Sub(at, surface->middle));
}

/* Room for the mesh as it is and for so many frames, with so many labels; after it the others never fail. */
bool kiriSurface_Resize(kiriSurface* surface, kiriMemory* memory, const kiriMeshData* mesh, int32_t frameCount,
                        int32_t labelCount);

/* The mesh is again as it is seen, and so many frames move it: what was for more is no more than room. Never fails. */
void kiriSurface_Truncate(kiriSurface* surface, int32_t frameCount);

/* Takes over what kiriMesh_Begin's journal says has changed; call it before kiriMesh_Commit. The first time
   all of the mesh. */
void kiriSurface_WriteTopology(kiriSurface* surface, const kiriMeshData* mesh);

/* Derives rest positions, and turns of the indices, after a load. False for memory. */
bool kiriSurface_RemakeRest(kiriSurface* surface, kiriMemory* memory, const kiriMeshData* mesh);

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

/* The host gets the indices, after so many ticks. Any number of threads may say so at the same time. */
void kiriSurface_LendIndices(const kiriSurface* surface, int64_t ticks);

/* Where the host holds the indices, they get a new array, and the old one gets the owner `retired`. False for
   memory. */
bool kiriSurface_RenewIndices(kiriSurface* surface, kiriMemory* memory, kiriMemory* retired, int64_t ticks);

/* A triangle is seen no more: all its corners are the first. */
void kiriSurface_HideTriangle(kiriSurface* surface, int32_t triangle);

/* Takes over where the frames are, which have these labels in weights. The links tell a smooth surface how to bend; a
   linear one does not ask. Where nothing is other than when arrays were written, they stay so. `awake`: only its frames
   may be elsewhere than when they were taken over last, and its elements begin with links; or null. */
void kiriSurface_TakeFrames(kiriSurface* surface, const kiriLabels* labels, const kiriFrameData* frames,
                            int32_t frameCount, const kiriLink* links, int32_t linkCount, const kiriAwake* awake);

/* Where the vertices from `begin` to `end` are. Writes nothing else: ranges may be written at the same time. */
void kiriSurface_BlendRange(kiriSurface* surface, const kiriSkin* skin, int32_t begin, int32_t end);

/* Moves the vertices that are seen elsewhere. */
void kiriSurface_AddFades(kiriSurface* surface, const kiriFades* fades);

/* Once in a tick, when all vertices are where they are seen: the sums that normals are made of, where the host asks for
   these. */
void kiriSurface_SumNormals(kiriSurface* surface);

/* That of one vertex, the others being known. False where too many triangles meet in it. */
bool kiriSurface_SumNormal(kiriSurface* surface, const kiriMeshData* mesh, int32_t vertex);

/* Then the positions and normals that the host reads, of the vertices from `begin` to `end`. Writes nothing else. */
void kiriSurface_WriteRange(kiriSurface* surface, int32_t begin, int32_t end);

/* Before normals are read: makes them where the tick did not, the same bits. */
void kiriSurface_NeedNormals(kiriSurface* surface);

/* What has changed since the host saw that revision: all, where that is too long ago. */
void kiriSurface_GetDirty(const kiriSurface* surface, uint32_t sinceRevision, kiriDirty* dirty);

/* Copies of `count` items from `first` on. Null: without these. Strides in bytes. */
void kiriSurface_CopyVertices(const kiriSurface* surface, int32_t first, int32_t count, void* positions,
                              int32_t positionStride, void* normals, int32_t normalStride);

/* False where the vertices are too many for 16 bits (65535 restarts primitives, and is no vertex). */
bool kiriSurface_CopyIndices16(const kiriSurface* surface, int32_t firstTriangle, int32_t count, uint16_t* indices);

/* The surface with a thickness, to draw: its two sides, and a rim along all borders, lips of cuts included. */

/* Of the surface as it is seen now; `mesh` says where it is open. The arrays are blocks of `memory`. False for memory:
   nothing is left of them. */
bool kiriSolid_Build(kiriSolid* solid, kiriMemory* memory, const kiriSurface* surface, const kiriMeshData* mesh,
                     double thickness);

KIRI_C_END

#endif
