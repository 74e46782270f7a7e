/* Owners of material, and how frames move after a commit that gives them other regions. The material of a new region
   moves on as it did with the old regions: its frame gets the projection of that motion, in the norm of mass. So linear
   and angular momentum are kept, and so is the rigid motion of a sheet. A frame whose region only lost material, or did
   not change, needs no fit. */
#ifndef KIRI_REFIT_H
#define KIRI_REFIT_H

#include "../field/kiri_region.h"
#include "kiri_frame.h"

KIRI_C_BEGIN

/* The owner of the material that a triangle has in a square. */
typedef struct kiriTriangleOwner {
    int32_t triangle, owner;
} kiriTriangleOwner;

/* Owners of the material of a square. Cells have no lasting name, because an update from scratch makes all of them
   again; so a square that is divided into several cells stores their owners by triangle. */
typedef struct kiriSquareOwners {
    int32_t owner;  /* of the whole square, where `parts` is empty; KIRI_NONE: it had no owner yet */
    kiriSpan parts; /* of triangleOwners */
} kiriSquareOwners;

typedef struct kiriStagedOwners {
    int32_t square;
    kiriSquareOwners owners;
} kiriStagedOwners;

/* Material that changes owner. */
typedef struct kiriTransfer {
    int32_t from;
    int32_t next; /* next transfer to the same frame, by ascending `from`, or KIRI_NONE */
    kiriTally material;
} kiriTransfer;

/* Owners before the update, and their changes. A zeroed one knows no material. */
typedef struct kiriOwnership {
    KIRI_ARRAY(kiriSquareOwners) squares;         /* owners before the update, for each square */
    KIRI_ARRAY(kiriTriangleOwner) triangleOwners; /* for divided squares */
    kiriSpans spans;                              /* free room in triangleOwners */
    int32_t triangleCount;                        /* triangles at the last commit */

    kiriIndices dirty;           /* squares in which owners may have changed, each once */
    kiriFlags isDirty;           /* for each square */
    int32_t next;                /* next of `dirty` to stage; 0: nothing is staged */
    int64_t due;                 /* items of the previous one that are not paid yet */
    KIRI_ARRAY(kiriStagedOwners) staged;
    KIRI_ARRAY(kiriTransfer) transfers;
    kiriIndices first; /* for each frame: its first transfer, or KIRI_NONE */
} kiriOwnership;

/* The state that a frame gets. */
typedef struct kiriFit {
    int32_t frame;
    double gained;       /* kinetic energy that its material did not have before, J */
    kiriFrameData state; /* with the mass and centre of its new region */
} kiriFit;

/* A piece as one rigid body with the same momenta. */
typedef struct kiriFitBody {
    double gained;          /* kinetic energy that the fits of its frames gained, J */
    double energy, mass;    /* kinetic, J; kg */
    double turning, beside; /* factors for its turning as one body, and for all motion beside that */
    kiriVec3 x, velocity, angular, spin;
    kiriMat3 inertia;
} kiriFitBody;

/* A zeroed one is empty. */
typedef struct kiriRefit {
    kiriOwnership ownership;
    KIRI_ARRAY(kiriFit) fits;
    int32_t most;                   /* fits that the commit will make */
    KIRI_ARRAY(kiriFitBody) bodies; /* scratch: one a piece */
} kiriRefit;

/* Mark the squares dirty in which owners may change: mesh->squares.dirty, and the squares of regions->changes. Call
   them before these lists are cleared. False when out of memory. */
bool kiriOwnership_NoteDirty(kiriOwnership* ownership, const kiriMeshData* mesh);
bool kiriOwnership_NoteChanges(kiriOwnership* ownership, const kiriGrid* grid, const kiriRegions* regions);

/* Follows cells and frames that were taken away, and triangles that were renumbered. `of`: the squares that lost cells.
   Call it after grid and regions; nothing may be dirty or staged. Cannot fail. */
void kiriOwnership_Keep(kiriOwnership* ownership, const kiriGrid* grid, const kiriRegions* regions,
                        const kiriKeep* triangles, const kiriKeep* frames, const int32_t* of, int32_t count);

/* Finds the material that changes owner with the next commit, in dirty squares, or in all where `isScratch`; and makes
   room for the fits. A square with several cells is an item, plus one for eight of its triangles; eight other squares
   are one. KIRI_MORE: call again. */
kiriProgress kiriRefit_Stage(kiriRefit* refit, const kiriGrid* grid, const kiriRegions* regions, bool isScratch,
                             kiriQuota* quota);

/* Drops everything dirty, staged and fitted. */
void kiriRefit_Drop(kiriRefit* refit);

/* Fits the frames that receive material, into `fits`, by frame, unless they are held. `frames` are the current ones,
   then, from frameCount on, new ones without a state; `regionMoments` belong to the staged regions. Cannot fail. */
void kiriRefit_Solve(kiriRefit* refit, const kiriFrameData* frames, int32_t frameCount, const kiriMeshData* mesh,
                     const kiriRegions* regions, const kiriMoments* regionMoments, const kiriMaterial* material,
                     bool isRigid);

/* Takes back the kinetic energy that the fits gained. Call it when the frames have their fits. framePiece[f] is the
   piece of frame f. Cannot fail. */
void kiriRefit_LimitEnergy(kiriRefit* refit, kiriFrameData* frames, int32_t frameCount, const int32_t* framePiece,
                           int32_t pieceCount, const kiriMaterial* material);

/* Puts the staged owners in place. Cannot fail. */
void kiriRefit_Commit(kiriRefit* refit, const kiriMeshData* mesh);

KIRI_C_END

#endif
