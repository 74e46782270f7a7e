/* Parts of a sheet as sheets of their own. */
#ifndef KIRI_EXTRACT_H
#define KIRI_EXTRACT_H

#include "kiri_sheet.h"

/* Which pieces are kept, and the index that everything of theirs gets in the part, or KIRI_NONE; orders are kept. */
typedef struct kiriExtract {
    const kiriSheetData* from;
    const kiriMemory* memory;
    KIRI_ARRAY(uint8_t) keep; /* of each piece; set by the caller */
    KIRI_ARRAY(int32_t) triangleTo, vertexTo, frameTo, pointTo, pinTo;
} kiriExtract;

/* No piece is kept yet. No update may be at hand in the sheet. False for memory; the extract is to be released
   anyway. */
bool kiriExtract_Init(kiriExtract* extract, const kiriSheetData* from);
void kiriExtract_Release(kiriExtract* extract);

/* The sheet of the pieces that are kept: on the same lattice and squares, so that all that follows from the mesh is
   what it was bit for bit; frames, pins and contacts keep ids and state. Cuts stay behind. False for memory: the sheet
   needs no release. */
bool kiriExtract_Build(kiriExtract* extract, kiriSheetData* to);

/* The sheet that was extracted from becomes `rest`, a part of it made by the extract, and keeps its cuts: a blade that
   is in no material that is left cuts nothing until it comes back. Never fails. */
void kiriExtract_Replace(const kiriExtract* extract, kiriSheetData* sheet, kiriSheetData* rest);

#endif
