/* Samples: points that take their weights from the grid (section 6 of the paper): mesh vertices, collision points. */
#ifndef KIRI_SAMPLE_H
#define KIRI_SAMPLE_H

#include "../field/kiri_stencil.h"
#include "../motion/kiri_frame.h"

KIRI_C_BEGIN

/* A sample that shall have other weights. */
typedef struct kiriReweighed {
    int32_t sample;
    kiriSpan span;
} kiriReweighed;

/* A weight of a sample: a multiple of 2^-24, so that those of a sample add up to 1 exactly. Never 0. Its frame has the
   label that it has in the shape, too (kiriShape.labels). */
typedef struct kiriSampleWeight {
    int32_t label;
    float value;
} kiriSampleWeight;

/* The weights of a row of samples. */
typedef struct kiriSkin {
    KIRI_ARRAY(kiriSpan) spans;           /* one a sample */
    KIRI_ARRAY(kiriSampleWeight) weights; /* by spans; in a span by label */
    kiriSpans room;
    KIRI_ARRAY(kiriReweighed) staged; /* weights that take effect with the commit */
    KIRI_ARRAY(kiriReweighed)
    settling; /* samples whose weights are where they were staged, and the room they had before */
} kiriSkin;

/* A material point that the host collides with the world. */
typedef struct kiriSample {
    kiriLatticePoint at; /* in the material */
    int32_t cell;        /* around it */
    int32_t frame;       /* in whose region it is */
} kiriSample;

typedef KIRI_ARRAY(kiriSample) kiriSamples;

/* What blended frames do at a point: linear-blend skinning and its velocity. A is not a rotation. */
typedef struct kiriMotion {
    kiriVec3 x, velocity, spin;
    kiriMat3 A, rate; /* rate: of A, all of it */
} kiriMotion;

/* Stages the weights of a sample at a local point of a cell. A sample is staged at most once before a commit; those
   from `spans.count` on are new and must be staged in their order. Nothing is settling. False for memory. */
bool kiriSkin_Stage(kiriSkin* skin, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                    const kiriMeshData* mesh, int32_t sample, int32_t cell, kiriVec2 at);

/* The weights staged become those of the samples, and settle later; or they are dropped. Neither fails. */
void kiriSkin_Commit(kiriSkin* skin);
void kiriSkin_Drop(kiriSkin* skin);

/* After a commit: weights go to the room of the old ones where they fit, so that samples that lie beside each other
   keep theirs together, and other room is given back. An item of the quota is 20 samples. Never fails. */
kiriProgress kiriSkin_Settle(kiriSkin* skin, kiriQuota* quota);

/* Puts the weights in the order of samples, in which they are read, with some room for more. Nothing is staged; what
   settles has settled. False for memory: they stay as they are. */
bool kiriSkin_Sort(kiriSkin* skin, kiriMemory* memory);

/* Which samples lie in which square, for samples that never move: a list a square. */
typedef struct kiriPlaces {
    KIRI_ARRAY(int32_t) head; /* of each square, or KIRI_NONE */
    KIRI_ARRAY(int32_t) next; /* of each sample */
} kiriPlaces;
/* After it Add does not fail until there are so many samples. For none there are no lists. */
bool kiriPlaces_Reserve(kiriPlaces* places, kiriMemory* memory, const kiriMeshData* mesh, int64_t sampleCount);
bool kiriPlaces_Add(kiriPlaces* places, kiriMemory* memory, const kiriMeshData* mesh, kiriLatticePoint at);

/* Stages, of all samples that follow the shape functions, those whose weights may have changed: each in the square of a
   cell of shape->changes, in a square that was noted, or beside one of these. An item of the quota is a sample
   staged. */
typedef struct kiriRefresh {
    KIRI_ARRAY(int32_t) noted;   /* squares in which the mesh changed, until Start */
    KIRI_ARRAY(int32_t) squares; /* with such samples */
    KIRI_ARRAY(uint8_t) marks;   /* of each square; all 0 but during Start */
    int32_t change;              /* that Start looks at next */
    int32_t oldCount;            /* samples that are not new */
    int32_t square, sample;      /* where the work goes on */
    kiriStencil stencil;         /* of the cell at hand */
} kiriRefresh;

/* Notes the dirty squares of the mesh, which are cleared before Start is called: cells there may have the same weights,
   but material elsewhere, and vertices there may have come to a lip. False for memory. */
bool kiriRefresh_NoteDirty(kiriRefresh* refresh, kiriMemory* memory, const kiriMeshData* mesh);

/* Vertices from `firstVertex` on are new, and are staged all; older ones where they come out other than before. Here an
   item of the quota is 24 changes. */
kiriProgress kiriRefresh_Start(kiriRefresh* refresh, kiriMemory* memory, const kiriShape* shape, const kiriGrid* grid,
                               const kiriMeshData* mesh, int32_t firstVertex, kiriQuota* quota);
kiriProgress kiriRefresh_Vertices(kiriRefresh* refresh, kiriSkin* skin, kiriMemory* memory, const kiriShape* shape,
                                  const kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota);
kiriProgress kiriRefresh_Points(kiriRefresh* refresh, kiriSkin* skin, const kiriPlaces* places,
                                const kiriSamples* points, kiriMemory* memory, const kiriShape* shape,
                                const kiriGrid* grid, const kiriMeshData* mesh, kiriQuota* quota);

/* Forgets what is noted, and a Start that waits for more quota. */
void kiriRefresh_Drop(kiriRefresh* refresh);

/* Vertices born since kiriMesh_Begin take a blend of their parents' weights, so that they lie on the surface as it was.
   Truncate takes that back. */
bool kiriSkin_Inherit(kiriSkin* skin, kiriMemory* memory, const kiriMeshData* mesh);
void kiriSkin_Truncate(kiriSkin* skin, int32_t sampleCount);

/* Samples and frames are taken away; no sample that is kept has a weight of a frame that is not. `labels`: what labels
   become; null: they stay. Nothing is staged. Never fails. */
void kiriSkin_Keep(kiriSkin* skin, const kiriKeep* samples, const kiriKeep* labels);
void kiriPlaces_Keep(kiriPlaces* places, const kiriKeep* samples);

kiriVec3 kiriSkin_Position(const kiriSkin* skin, const kiriLabels* labels, int32_t sample, const kiriFrameData* frames,
                           kiriVec2 local);

/* The motion at a lattice point of a triangle, from the weights of its corners. */
kiriMotion kiriSkin_Motion(const kiriSkin* vertexSkin, const kiriLabels* labels, const kiriFrameData* frames,
                           const kiriMeshData* mesh, int32_t triangle, kiriLatticePoint at);

KIRI_C_END

#endif
