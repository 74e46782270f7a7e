/* What belongs to some pieces of a sheet, found from their frames on, at the cost of the pieces. */
#ifndef KIRI_GATHER_H
#define KIRI_GATHER_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* One piece: where its triangles and vertices are in the lists, each from the lowest to the highest. */
typedef struct kiriGatheredPiece {
    int32_t piece;
    kiriSpan triangles, vertices;
} kiriGatheredPiece;

typedef struct kiriGathered {
    kiriSheetData* sheet;
    kiriMemory* memory;                              /* of the lists */
    KIRI_ARRAY(kiriGatheredPiece) pieces;            /* in their order */
    kiriIndices triangles, vertices, cells, squares; /* squares: those of the cells, each once */
    kiriIndices room;                                /* to sort them */
    bool isMarked;
} kiriGathered;

/* Gathers the pieces that `stays` is 0 for. Fields belong to the mesh as it is (kiriUpdate_IsFieldCurrent). False for memory,
   which the caller frees; and where pieces are not what they must be, in a sheet from bytes that somebody made up. */
bool kiriGather_Make(kiriGathered* gathered, kiriSheetData* sheet, kiriMemory* memory, const uint8_t* stays);

/* One of the pieces that were gathered. */
const kiriGatheredPiece* kiriGather_Find(const kiriGathered* gathered, int32_t piece);

/* Puts all that was gathered into the maps of sheet->taking, and takes it out again. */
void kiriGather_Mark(kiriGathered* gathered);
void kiriGather_Unmark(kiriGathered* gathered);

KIRI_C_END

#endif
