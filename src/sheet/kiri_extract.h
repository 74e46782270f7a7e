/* Pieces of a sheet as a sheet of their own. */
#ifndef KIRI_EXTRACT_H
#define KIRI_EXTRACT_H

#include "kiri_gather.h"
#include "kiri_kept.h"
#include "kiri_pipeline.h"

KIRI_C_BEGIN

/* Parts of a sheet, one after the other: each costs what it is large. */
typedef struct kiriExtraction {
    kiriKept kept; /* the part at hand; its memory is that of all */
    const kiriGathered* gathered;
} kiriExtraction;

/* What is gathered may become parts, while it is not marked. False for memory; Drop is to be called then, too. */
bool kiriExtraction_Init(kiriExtraction* extraction, const kiriGathered* gathered);

/* The sheet of one piece: on the same lattice and squares, so that all that follows from the mesh is what it was bit
   for bit; frames, pins and contacts keep ids and state. `to` is new, or begun. Cuts stay behind. No cut has changed
   the mesh whose work is not done. False for memory. */
bool kiriExtraction_Build(kiriExtraction* extraction, int32_t piece, kiriSheetData* to);

/* The same little by little, before the piece leaves: its mesh, then its fields and weights as far as the quotas go.
   These depend on the mesh of the sheet alone, so long as that is the same; all else Build takes as it is in the
   end. */
kiriProgress kiriExtraction_GoOn(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuotas* quotas);

/* What it takes to make sheets of this share of a sheet's area, in samples. */
double kiriExtraction_Samples(const kiriSheetData* sheet, double share);

/* Samples to make the sheet of one piece in steps (kiriExtraction_GoOn). share: of the area; frames: of the piece. */
double kiriExtraction_SamplesAhead(const kiriSheetData* sheet, double share, int32_t frames);

void kiriExtraction_Drop(kiriExtraction* extraction);

KIRI_C_END

#endif
