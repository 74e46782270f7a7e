/* What frames do after a commit that gives cells to other frames. The motion before is one of frames over their old
   regions; after it each frame moves as the material that is now its own did: the projection of that motion, in the
   norm of mass. So linear and angular momentum stay what they were, and the rigid motion of a sheet goes on. A frame
   whose region only lost cells, or none, goes on as it did. */
#ifndef KIRI_REFIT_H
#define KIRI_REFIT_H

#include "kiri_prediction.h"

/* The owner in force of a part of a square: of what this triangle has in it. */
typedef struct kiriOwned {
    int32_t triangle, owner;
} kiriOwned;

/* Owners in force of the cells of a square, by what outlives the cells: one that is divided knows them by its
   triangles. */
typedef struct kiriTenure {
    int32_t owner; /* of the whole square, where `parts` is empty; KIRI_NONE: nobody has owned it yet */
    kiriSpan parts;
} kiriTenure;

typedef struct kiriStagedTenure {
    int32_t square;
    kiriTenure tenure;
} kiriStagedTenure;

/* Material that changes owner. */
typedef struct kiriTransfer {
    int32_t from;
    int32_t next; /* of the same receiver, by growing `from`, or KIRI_NONE */
    kiriTally material;
} kiriTransfer;

/* What a frame becomes. */
typedef struct kiriFit {
    int32_t frame;
    double gained;       /* kinetic energy that its material did not have before, J */
    kiriFrameData state; /* with the mass and centre of its new region */
} kiriFit;

typedef struct kiriRefit {
    KIRI_ARRAY(kiriTenure) tenures; /* of each square */
    KIRI_ARRAY(kiriOwned) owned;    /* by their parts */
    kiriSpans room;
    int32_t triangleCount; /* when they came in force */

    /* Of the update at hand. */
    KIRI_ARRAY(int32_t) squares; /* in which something may have changed, each once */
    KIRI_ARRAY(uint8_t) marks;   /* of each square: it is among them */
    KIRI_ARRAY(kiriStagedTenure) staged;
    KIRI_ARRAY(kiriTransfer) transfers;
    KIRI_ARRAY(int32_t) first; /* of each frame: the first transfer to it, or KIRI_NONE */
    KIRI_ARRAY(kiriFit) fits;
} kiriRefit;

/* Notes squares in which owners may change: those of mesh->squares.dirty, and those of regions->changes. Call them
   before these are cleared or settled. All false for memory. */
bool kiriRefit_NoteDirty(kiriRefit* refit, kiriMemory* memory, const kiriMeshData* mesh);
bool kiriRefit_NoteChanges(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                           const kiriRegions* regions);

/* Finds what changes owner when the regions come in force; in all squares where `isScratch`. */
bool kiriRefit_Stage(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                     const kiriRegions* regions, bool isScratch);

/* Forgets what is noted and staged. */
void kiriRefit_Drop(kiriRefit* refit);

/* Fits the frames to which material comes, into `fits`, by frame. `frames` are those in force, and from frameCount on
   new ones, of which only the state is not known; `regionMoments` are of the regions to come. Held frames are not
   fitted. Never fails. */
void kiriRefit_Solve(kiriRefit* refit, const kiriFrameData* frames, int32_t frameCount, const kiriMeshData* mesh,
                     const kiriRegions* regions, const kiriMoments* regionMoments, const kiriMaterial* material,
                     bool isRigid);

/* When the frames have their fits: takes back what kinetic energy these have brought. `piece` of each frame. Never
   fails. */
void kiriRefit_Brake(const kiriRefit* refit, kiriFrameData* frames, int32_t frameCount, const int32_t* piece,
                     int32_t pieceCount, const kiriMaterial* material);

/* The regions come in force. Never fails. */
void kiriRefit_Commit(kiriRefit* refit, const kiriMeshData* mesh);

#endif
