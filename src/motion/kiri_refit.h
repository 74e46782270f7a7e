/* Which frame owns which material: the owners in force, and what changes owner with the next commit. */
#ifndef KIRI_REFIT_H
#define KIRI_REFIT_H

#include "../field/kiri_region.h"
#include "kiri_frame.h"

KIRI_C_BEGIN

/* The owner of what a triangle has in a square. */
typedef struct kiriTriangleOwner {
    int32_t triangle, owner;
} kiriTriangleOwner;

/* Owners of the material of a square. Cells have no lasting name, for an update from scratch makes all of them anew; so
   a square that is divided into several cells knows their owners by triangle. */
typedef struct kiriSquareOwners {
    int32_t owner;  /* of the whole square, where `parts` is empty; KIRI_NONE: nobody has owned it yet */
    kiriSpan parts; /* of triangleOwners */
} kiriSquareOwners;

typedef struct kiriStagedOwners {
    int32_t square;
    kiriSquareOwners owners;
} kiriStagedOwners;

/* Material that changes owner. */
typedef struct kiriTransfer {
    int32_t from;
    int32_t next; /* of the same receiver, by growing `from`, or KIRI_NONE */
    kiriTally material;
} kiriTransfer;

/* A zeroed one knows of no material. */
typedef struct kiriOwnership {
    KIRI_ARRAY(kiriSquareOwners) squares;         /* in force, of each square */
    KIRI_ARRAY(kiriTriangleOwner) triangleOwners; /* of divided squares */
    kiriSpans spans;                              /* the free room in triangleOwners */
    int32_t triangleCount;                        /* when they came in force */

    /* Of the update at hand. */
    KIRI_ARRAY(int32_t) dirty;   /* squares in which owners may have changed, each once */
    KIRI_ARRAY(uint8_t) isDirty; /* of each square */
    int32_t next;                /* in `dirty`: the next to stage; 0: nothing is staged */
    int64_t due;                 /* items of the one before it that are not paid yet */
    KIRI_ARRAY(kiriStagedOwners) staged;
    KIRI_ARRAY(kiriTransfer) transfers;
    KIRI_ARRAY(int32_t) first; /* of each frame: the first transfer to it, or KIRI_NONE */
} kiriOwnership;

/* The extent of the tallies of material. */
static inline double kiriOwnership_Extent(const kiriMeshData* mesh)
{
    return KIRI_LATTICE * mesh->step;
}

/* Makes the squares dirty in which owners may change: those of mesh->squares.dirty, and those of regions->changes. To
   be called before these are cleared. Both false for memory. */
bool kiriOwnership_NoteDirty(kiriOwnership* ownership, kiriMemory* memory, const kiriMeshData* mesh);
bool kiriOwnership_NoteChanges(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                               const kiriMeshData* mesh, const kiriRegions* regions);

/* Cells and frames have been taken away, and triangles have been renumbered: `of` are the squares where cells went.
   With regions and mesh as they are. Nothing is dirty or staged. Never fails. */
void kiriOwnership_Keep(kiriOwnership* ownership, const kiriGrid* grid, const kiriMeshData* mesh,
                        const kiriRegions* regions, const kiriKeep* triangles, const kiriKeep* frames,
                        const int32_t* of, int32_t count);

/* Finds what changes owner when the regions come in force: in dirty squares, or in all where `isScratch`. An item of
   the quota is a square that several cells share, its triangles count, too; or eight others. After KIRI_MORE it goes on
   where it was. */
kiriProgress kiriOwnership_Stage(kiriOwnership* ownership, kiriMemory* memory, const kiriGrid* grid,
                                 const kiriMeshData* mesh, const kiriRegions* regions, bool isScratch,
                                 kiriQuota* quota);

/* Forgets what is dirty and staged. */
void kiriOwnership_Drop(kiriOwnership* ownership);

/* What is staged comes in force. Never fails. */
void kiriOwnership_Commit(kiriOwnership* ownership, const kiriMeshData* mesh);

/* How frames move after a commit that gives them other regions. The motion before is that of frames with their old
   regions; after it, the material of a new region moves on as it did: the frame gets the projection of that motion, in
   the norm of mass. So linear and angular momentum are kept, and so is the rigid motion of a sheet. A frame whose
   region only lost material, or did not change, needs no fit. */

/* What a frame becomes. */
typedef struct kiriFit {
    int32_t frame;
    double gained;       /* kinetic energy that its material did not have before, J */
    kiriFrameData state; /* with the mass and centre of its new region */
} kiriFit;

/* A zeroed one is empty. */
typedef struct kiriRefit {
    kiriOwnership ownership;
    KIRI_ARRAY(kiriFit) fits;
    int32_t most;                /* fits that the commit will make */
    KIRI_ARRAY(double) gained;   /* scratch: of each piece, J; */
    KIRI_ARRAY(int32_t) firstOf; /* its first frame, or KIRI_NONE; */
    KIRI_ARRAY(int32_t) nextOf;  /* of each frame: the next of its piece, or KIRI_NONE */
} kiriRefit;

/* As kiriOwnership_Stage; and room for the fits. */
kiriProgress kiriRefit_Stage(kiriRefit* refit, kiriMemory* memory, const kiriGrid* grid, const kiriMeshData* mesh,
                             const kiriRegions* regions, bool isScratch, kiriQuota* quota);

/* Forgets what is dirty, staged and fitted. */
void kiriRefit_Drop(kiriRefit* refit);

/* Fits the frames to which material comes, into `fits`, by frame. `frames` are those in force, and from frameCount on
   new ones, of which only the state is not known; `regionMoments` are of the regions to come. Held frames are not
   fitted. Never fails. */
void kiriRefit_Solve(kiriRefit* refit, const kiriFrameData* frames, int32_t frameCount, const kiriMeshData* mesh,
                     const kiriRegions* regions, const kiriMoments* regionMoments, const kiriMaterial* material,
                     bool isRigid);

/* When the frames have their fits: takes back what kinetic energy these have brought. framePiece[f] is the piece of
   frame f. Never fails. */
void kiriRefit_LimitEnergy(kiriRefit* refit, kiriFrameData* frames, int32_t frameCount, const int32_t* framePiece,
                           int32_t pieceCount, const kiriMaterial* material);

/* The regions come in force. Never fails. */
void kiriRefit_Commit(kiriRefit* refit, const kiriMeshData* mesh);

KIRI_C_END

#endif
