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
    int32_t looked;  /* cells that it has gone on from, where it is made little by little, */
    int64_t due;     /* and what the last one of these is still to be paid with */
    int32_t checked; /* triangles whose neighbours are known to be there */
    int64_t left;    /* places in squares that they have, less those that its cells have */
    bool isDone, isMarked;
    bool isUnderWay; /* little by little: what has been taken is marked */
} kiriGathered;

/* Room to gather pieces, which is as large as the sheet. Start reserves it where it is not there. An item of the quota
   is 64 vertices, triangles or cells. */
bool kiriGather_IsReserved(const kiriSheetData* sheet);
kiriProgress kiriGather_Reserve(kiriSheetData* sheet, kiriQuota* quota);

/* Gathers the pieces that `stays` is 0 for. Fields belong to the mesh as it is (kiriUpdate_IsFieldCurrent). False for
   memory, which the caller frees; and where pieces are not what they must be, in a sheet from bytes that somebody made
   up. */
bool kiriGather_Make(kiriGathered* gathered, kiriSheetData* sheet, kiriMemory* memory, const uint8_t* stays);

/* The same for the piece of one frame, little by little, while the mesh stays as it is. An item of the quota is a cell,
   or two of the triangles in its square; or four triangles that are put in order, which takes one call. */
bool kiriGather_Start(kiriGathered* gathered, kiriSheetData* sheet, kiriMemory* memory, int32_t frame);
kiriProgress kiriGather_GoOn(kiriGathered* gathered, kiriQuota* quota);

/* Before others use the maps of sheet->taking, or items get other indices: what is made ahead (sheet->ahead) marks it
   anew when it goes on. */
void kiriGather_Pause(kiriSheetData* sheet);

/* One of the pieces that were gathered. */
const kiriGatheredPiece* kiriGather_Find(const kiriGathered* gathered, int32_t piece);

/* Puts all that was gathered into the maps of sheet->taking, and takes it out again. */
void kiriGather_Mark(kiriGathered* gathered);
void kiriGather_Unmark(kiriGathered* gathered);

KIRI_C_END

#endif
