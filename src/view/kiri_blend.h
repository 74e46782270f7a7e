/* Linear-blend skinning in floats (section 4.1 of the paper). */
#ifndef KIRI_BLEND_H
#define KIRI_BLEND_H

#include "kiri_carrier.h"
#include "kiri_sample.h"

KIRI_C_BEGIN

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

KIRI_C_END

#endif
