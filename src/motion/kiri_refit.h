/* How frames move after a commit that gives them other regions. The motion before is that of frames with their old
   regions; after it, the material of a new region moves on as it did: the frame gets the projection of that motion, in
   the norm of mass. So linear and angular momentum are kept, and so is the rigid motion of a sheet. A frame whose
   region only lost material, or did not change, needs no fit. */
#ifndef KIRI_REFIT_H
#define KIRI_REFIT_H

#include "kiri_ownership.h"
#include "kiri_prediction.h"

KIRI_C_BEGIN

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
