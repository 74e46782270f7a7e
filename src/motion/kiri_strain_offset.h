/* Strains that links take over when a cut changes them. Frames stand to each other as they did, but the new borders of
   their regions see more or less of a gap between them, which in a bent stiff sheet is energy out of nowhere. So a
   link goes on with the strain that it had: the difference is its offset, which fades with time. */
#ifndef KIRI_STRAIN_OFFSET_H
#define KIRI_STRAIN_OFFSET_H

#include "kiri_awake.h"
#include "kiri_strain.h"

KIRI_C_BEGIN

/* What is taken off the strains of a link before they pull. */
typedef struct kiriStrainOffset {
    double strain[KIRI_STRAINS];
} kiriStrainOffset;

typedef struct kiriStrainOffsets {
    KIRI_ARRAY(kiriStrainOffset) strainOffsets; /* one a link; none where no cut has changed links */
    KIRI_ARRAY(kiriStrainOffset) older;         /* scratch: of links that get another index, by the old one; */
    KIRI_ARRAY(int32_t) from;                   /* the link that each goes on from, or KIRI_NONE */
    KIRI_ARRAY(kiriFrameData) frames;           /* as they were before the commit: those that it may move; */
    KIRI_ARRAY(uint8_t) mayMove;                /* which these are */
} kiriStrainOffsets;

/* Room for so many links and frames, so that the others do not fail. */
bool kiriStrainOffsets_Reserve(kiriStrainOffsets* strainOffsets, kiriMemory* memory, int32_t linkCount,
                               int32_t frameCount);

/* Before the commit. mayMove[f]: it may change where frame f is, or its centre. */
void kiriStrainOffsets_Remember(kiriStrainOffsets* strainOffsets, const kiriFrameData* frames, int32_t frameCount,
                                const uint8_t* mayMove);

/* A frame as it was before the commit, as far as strains ask; frames: as they are. */
const kiriFrameData* kiriStrainOffsets_FrameBefore(const kiriStrainOffsets* strainOffsets, const kiriFrameData* frames,
                                                   int32_t frame);

/* After it: links of the same pair, in their order, go on with their strain; links that are new begin without any.
   was[k], if not null: which of the old ones link k is, bit for bit, or KIRI_NONE where that is not known. */
void kiriStrainOffsets_Take(kiriStrainOffsets* strainOffsets, const kiriLink* old, int32_t oldCount,
                            const kiriLink* links, int32_t linkCount, const int32_t* was, const kiriFrameData* frames,
                            const kiriMaterial* material);

/* Offsets of those links that are among these elements fade to 1 / e within `time` (s). */
void kiriStrainOffsets_Advance(kiriStrainOffsets* strainOffsets, const kiriIndices* elements, double dt, double time);

KIRI_C_END

#endif
