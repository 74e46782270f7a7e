/* Parts of a sheet as sheets of their own. */
#ifndef KIRI_EXTRACT_H
#define KIRI_EXTRACT_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Which pieces are kept, and the index that everything of theirs gets in the part, or KIRI_NONE; orders are kept. */
typedef struct kiriExtract {
    const kiriSheetData* from;
    kiriMemory memory;        /* of the arrays; freed by the caller */
    KIRI_ARRAY(uint8_t) keep; /* of each piece; set by the caller */
    KIRI_ARRAY(int32_t) triangleTo, vertexTo, frameTo, pointTo, pinTo;
} kiriExtract;

/* No piece is kept yet. No update may be at hand in the sheet. False for memory. */
bool kiriExtract_Init(kiriExtract* extract, const kiriSheetData* from);

/* The sheet of the pieces that are kept: on the same lattice and squares, so that all that follows from the mesh is
   what it was bit for bit; frames, pins and contacts keep ids and state. `to` is new. Cuts stay behind. False for
   memory. */
bool kiriExtract_Build(kiriExtract* extract, kiriSheetData* to);

/* `rest`, a part made by the extract, takes the place of the sheet, with its id and its cuts: a blade that is in no
   material that is left cuts nothing until it comes back. Never fails. */
void kiriExtract_MoveCuts(const kiriExtract* extract, kiriSheetData* sheet, kiriSheetData* rest);

KIRI_C_END

#endif
