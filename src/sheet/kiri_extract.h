/* Pieces of a sheet as a sheet of their own. */
#ifndef KIRI_EXTRACT_H
#define KIRI_EXTRACT_H

#include "kiri_gather.h"
#include "kiri_kept.h"

KIRI_C_BEGIN

/* Parts of a sheet, one after the other: each costs what it is large. */
typedef struct kiriExtraction {
    kiriKept kept; /* the part at hand; its memory is that of all */
    const kiriGathered* gathered;
} kiriExtraction;

/* What is gathered may become parts, while it is not marked. False for memory; Drop is to be called then, too. */
bool kiriExtraction_Init(kiriExtraction* extraction, const kiriGathered* gathered);

/* The sheet of one piece: on the same lattice and squares, so that all that follows from the mesh is what it was bit for
   bit; frames, pins and contacts keep ids and state. `to` is new. Cuts stay behind. No cut has changed the mesh whose
   work is not done. False for memory. */
bool kiriExtraction_Build(kiriExtraction* extraction, int32_t piece, kiriSheetData* to);

void kiriExtraction_Drop(kiriExtraction* extraction);

KIRI_C_END

#endif
