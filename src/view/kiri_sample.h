/* Samples: points that take their weights from the grid (section 6 of the paper): mesh vertices, collision points. */
#ifndef KIRI_SAMPLE_H
#define KIRI_SAMPLE_H

#include "../field/kiri_stencil.h"
#include "../motion/kiri_frame.h"

KIRI_C_BEGIN

/* New weights of a sample. */
typedef struct kiriReweighed {
    int32_t sample;
    kiriSpan span;
} kiriReweighed;

/* A weight of a sample: a multiple of 2^-24, not 0. The sum over a sample is exactly 1. */
typedef struct kiriSampleWeight {
    int32_t frame;
    float value;
} kiriSampleWeight;

/* The weights of a row of samples. */
typedef struct kiriSkin {
    KIRI_ARRAY(kiriSpan) spans;           /* one a sample */
    KIRI_ARRAY(kiriSampleWeight) weights; /* in spans, by frame */
    kiriSpans room;
    KIRI_ARRAY(kiriReweighed) staged;     /* weights that take effect with the commit */
} kiriSkin;

/* A collision point: a material point that the host collides with the world. */
typedef struct kiriSample {
    kiriLatticePoint at;
    int32_t cell;  /* that holds it */
    int32_t frame; /* whose region holds it */
} kiriSample;

typedef KIRI_ARRAY(kiriSample) kiriSamples;

/* Motion of the material at a point: linear-blend skinning and its velocity. A is not a rotation. */
typedef struct kiriMotion {
    kiriVec3 x, velocity, spin;
    kiriMat3 A, rate; /* rate: derivative of A */
} kiriMotion;

/* Stages the weights of a sample at a local point of a cell. A sample is staged at most once before a commit. New
   samples, from `spans.count` on, are staged in ascending order. Returns false on out of memory. */
bool kiriSkin_Stage(kiriSkin* skin, const kiriShape* shape, const kiriGrid* grid, int32_t sample, int32_t cell,
                    kiriVec2 at);

/* Stages the weights of a sample of another skin for the next sample. Returns false on out of memory. */
bool kiriSkin_StageCopy(kiriSkin* skin, kiriMemory* memory, const kiriSkin* from, int32_t was, const kiriKeep* frames);

/* Commit gives the staged weights to the samples; Drop drops them. Both cannot fail. */
void kiriSkin_Commit(kiriSkin* skin);
void kiriSkin_Drop(kiriSkin* skin);

/* Sorts the weights by samples, for speed, with some room for more. Nothing may be staged. Returns false on out of
   memory: then nothing changes. */
bool kiriSkin_Sort(kiriSkin* skin, kiriMemory* memory);

/* Lists of the samples in each square, for samples that never move. */
typedef struct kiriPlaces {
    kiriIndices head; /* of each square, or KIRI_NONE; empty without samples */
    kiriIndices next; /* of each sample */
} kiriPlaces;

/* Makes room for samples, so that Add cannot fail. */
bool kiriPlaces_Reserve(kiriPlaces* places, const kiriMeshData* mesh, int64_t sampleCount);
bool kiriPlaces_Add(kiriPlaces* places, const kiriMeshData* mesh, kiriLatticePoint at);

/* Stages the samples whose weights may have changed: those in or beside the square of a cell in shape->changes, or in
   or beside a square that was noted. */
typedef struct kiriRefresh {
    kiriIndices noted;           /* squares in which the mesh changed, until Start */
    kiriIndices squares;         /* with such samples */
    kiriFlags marks;             /* of each square; all 0 but during Start */
    int32_t change;              /* next in Start */
    int32_t oldCount;            /* samples that are not new */
    int32_t square, sample;      /* next in Stage */
    kiriStencil stencil;         /* of the current cell */
    kiriIndices joined;          /* scratch: vertices that creases join at a point */
    kiriStencil mean;            /* scratch: the mean of their weights; only frames and values */
} kiriRefresh;

/* Samples, and the data from which their weights come. */
typedef struct kiriSampleSource {
    kiriMemory* memory;
    const kiriShape* shape;
    const kiriGrid* grid;
    kiriSkin* skin;
    const kiriPlaces* places; /* null: the samples are the vertices */
    const kiriSamples* points;
} kiriSampleSource;

/* Notes the dirty squares of the mesh, which are cleared before Start: there cells may have the same weights but other
   material, and vertices may have come to a lip. Returns false on out of memory. */
bool kiriRefresh_NoteDirty(kiriRefresh* refresh, const kiriMeshData* mesh);

/* Finds the squares. Vertices from `firstVertex` on are new. An item of the quota is 16 changes. */
kiriProgress kiriRefresh_Start(kiriRefresh* refresh, const kiriSampleSource* source, int32_t firstVertex,
                               kiriQuota* quota);

/* Stages new vertices, old vertices whose weights change, and points. A quota item is a sample, or 16 squares. */
kiriProgress kiriRefresh_Stage(kiriRefresh* refresh, const kiriSampleSource* source, kiriQuota* quota);

/* Drops the noted squares, and a Start that waits for quota. */
void kiriRefresh_Drop(kiriRefresh* refresh);

/* Give vertices born since kiriMesh_Begin a blend of their parents' weights, so that they lie on the old surface.
   Reserve makes room for `births` of them; no sample has more weights than there are frames. */
bool kiriSkin_ReserveBirths(kiriSkin* skin, kiriMemory* memory, int32_t births, int32_t frames);
void kiriSkin_Inherit(kiriSkin* skin, const kiriMeshData* mesh);

/* Removes samples and frames. Samples that are kept have no weight of a frame that is removed. Nothing may be staged.
   Cannot fail. */
void kiriSkin_Keep(kiriSkin* skin, const kiriKeep* samples, const kiriKeep* frames);
void kiriPlaces_Keep(kiriPlaces* places, const kiriKeep* samples);

/* Returns the position of a sample, from its local rest point. */
kiriVec3 kiriSkin_Position(const kiriSkin* skin, int32_t sample, const kiriFrameData* frames,
                           kiriVec2 local);

/* Returns the motion at a lattice point of a triangle, from the weights of its corners. */
kiriMotion kiriSkin_Motion(const kiriSkin* vertexSkin, const kiriFrameData* frames,
                           const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

KIRI_C_END

#endif
