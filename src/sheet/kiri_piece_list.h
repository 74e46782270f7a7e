/* What is in each piece of a sheet, for the host: lists that are made when it asks for them. */
#ifndef KIRI_PIECE_LIST_H
#define KIRI_PIECE_LIST_H

#include "kiri_piece.h"

KIRI_C_BEGIN

/* Bring lists up to date: that costs nothing where neither mesh nor pieces have changed. Vertices: with how many
   triangles each piece has. False for memory. */
bool kiriPieces_ListFrames(kiriSheetData* sheet);
bool kiriPieces_ListVertices(kiriSheetData* sheet);
bool kiriPieces_ListTriangles(kiriSheetData* sheet);

/* Mesh or pieces have changed. */
static inline void kiriPieceLists_Forget(kiriPieceLists* lists)
{
    lists->hasFrames = lists->hasVertices = lists->hasTriangles = false;
}

/* Where the piece is in one of the lists. */
kiriSpan kiriPieceItems_Of(const kiriPieceItems* list, int32_t piece);

/* Pieces that `stays` is 0 for go, and their vertices and triangles leave holes. So what is listed of the others stays
   where it is; frames and points get other indices. The host may hold what was listed: arrays that go get the owner
   `retired`. */
void kiriPieceLists_LeaveHoles(kiriPieceLists* lists, const uint8_t* stays, kiriMemory* retired);

/* All lists go, and arrays get the owner `retired`. */
void kiriPieceLists_Retire(kiriPieceLists* lists, kiriMemory* retired);

/* What the host asks about a piece; frames and vertices are listed. */
kiriPieceState kiriPiece_State(const kiriSheetData* sheet, int32_t piece);

KIRI_C_END

#endif
