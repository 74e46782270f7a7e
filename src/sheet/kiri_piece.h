/* Pieces: the connected parts of a sheet. They are numbered by their lowest frame. */
#ifndef KIRI_PIECE_H
#define KIRI_PIECE_H

#include "kiri_update.h"
#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Stages the pieces that come in force with the next commit, from the links that are staged. False for memory. */
bool kiriPieces_Stage(kiriSheetData* sheet);

/* The piece of a triangle. */
int32_t kiriPiece_OfTriangle(const kiriSheetData* sheet, int32_t triangle);

/* Is any piece gone? */
bool kiriPieces_AnyGone(const kiriSheetData* sheet);

/* The pieces of the layout that has just come in force are gone where those were that they came of. */
void kiriPieces_KeepGone(kiriSheetData* sheet, const kiriLayout* old);

/* When an update is ready: finds which of the next pieces it touches, isTouched; the pieces that they come of are
   stirred. Work that is beside the cut, but comes out as before, touches nothing. */
void kiriPieces_FindTouched(kiriSheetData* sheet);

/* The pieces of the layout that has just come in force rest as those that they came of, where they are not touched. */
void kiriPieces_KeepRest(kiriSheetData* sheet, const kiriLayout* old);

/* Which frame a point of the material belongs to, and which frames a line of it: for pins and loads. */

/* The index of the frame that holds a point of the material; KIRI_NONE outside, and in what is gone. */
int32_t kiriOwner_At(const kiriSheetData* sheet, kiriLatticePoint at);

/* The same of the triangle of a node of mesh.squares, in the node's square; KIRI_NONE for no node, too. */
int32_t kiriOwner_OfNode(const kiriSheetData* sheet, int32_t node, bool isStaged);

/* Finds what of a line belongs to each frame into sheet->lineShares, in the order in which the line meets them; nothing
   where it meets no material. The ends differ. isStaged: with the regions that come in force with the next commit.
   False for memory. */
bool kiriOwner_FindShares(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, bool isStaged);

/* The items of each piece, in lists that are made when the host asks for them. */

/* Lists the items of each piece in ascending order. pieces[i] is the piece of item i, or KIRI_NONE. False for memory. */
bool kiriPieceItems_List(kiriPieceItems* list, kiriMemory* memory, int32_t pieceCount, const int32_t* pieces,
                         int32_t count);

/* Bring lists up to date: frames with collision points, or vertices with triangles. This costs nothing if neither mesh
   nor pieces have changed. False for memory. */
bool kiriPieces_ListFrames(kiriSheetData* sheet);
bool kiriPieces_ListMesh(kiriSheetData* sheet);

/* The mesh or the pieces have changed. */
static inline void kiriPieceLists_Forget(kiriPieceLists* lists)
{
    lists->hasFrames = lists->hasMesh = false;
}

kiriSpan kiriPieceItems_Of(const kiriPieceItems* list, int32_t piece);

/* Removes all lists. Arrays, which the host may hold, get the owner `retired`. */
void kiriPieceLists_Retire(kiriPieceLists* lists, kiriMemory* retired);

/* What the host asks about a piece; frames and vertices are listed. */
kiriPieceState kiriPiece_State(const kiriSheetData* sheet, int32_t piece);


KIRI_C_END

#endif
