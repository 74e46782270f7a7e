/* Pieces: the connected parts of a sheet. They are numbered by their lowest frame. */
#ifndef KIRI_PIECE_H
#define KIRI_PIECE_H

#include "kiri_sheet.h"

KIRI_C_BEGIN

/* Stages the pieces of the next commit, from the staged links. Fails on out of memory. */
bool kiriPieces_Stage(kiriSheetData* sheet);

int32_t kiriPiece_OfTriangle(const kiriSheetData* sheet, int32_t triangle);

/* Return true if the piece, or any piece that is awake, has a director more than 72 degrees off the mean of all. */
bool kiriPiece_Folds(const kiriSheetData* sheet, int32_t piece);
bool kiriPieces_AnyFolds(const kiriSheetData* sheet);

/* Returns true if a piece is gone, see kiriPiece.isGone. */
bool kiriPieces_AnyGone(const kiriSheetData* sheet);

/* Finds the pieces that a finished update changes: sets isTouched of the next pieces, and isStirred of their origins.
   Work beside the cut that changed nothing does not count. */
void kiriPieces_FindTouched(kiriSheetData* sheet);

/* After a commit: takes isGone of all pieces, and the sleep of untouched ones, from the old layout. */
void kiriPieces_Keep(kiriSheetData* sheet, const kiriLayout* old);

/* Returns the frame that owns a point of the material, for pins and loads. KIRI_NONE outside, and on a destroyed
   piece. */
int32_t kiriOwner_At(const kiriSheetData* sheet, kiriLatticePoint at);

/* Returns the owner of the triangle of a node of mesh.squares, in the square of the node. KIRI_NONE also for no node.
   isStaged: uses the regions of the next commit. */
int32_t kiriOwner_OfNode(const kiriSheetData* sheet, int32_t node, bool isStaged);

/* Finds the part of a line that each frame owns, in the order of the line, into sheet->lineShares. Nothing if the line
   meets no material. The ends must differ. isStaged: uses the regions of the next commit. Fails on out of memory. */
bool kiriOwner_FindShares(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, bool isStaged);

/* Returns the share of a frame in sheet->lineShares. Adds `none` if the frame has none yet. Null: out of memory. */
kiriLineShare* kiriOwner_ShareOf(kiriSheetData* sheet, const kiriLineShare* none);

/* Lists of the items of each piece, built when the host requests them. */

/* Lists the items of each piece in ascending order. pieces[i] is the piece of item i, or KIRI_NONE. Fails on out of
   memory. */
bool kiriPieceItems_List(kiriPieceItems* list, kiriMemory* memory, int32_t pieceCount, const int32_t* pieces,
                         int32_t count);

/* Bring lists up to date: frames with collision points, or vertices with triangles. This costs nothing if neither mesh
   nor pieces have changed. Fail on out of memory. */
bool kiriPieces_ListFrames(kiriSheetData* sheet);
bool kiriPieces_ListMesh(kiriSheetData* sheet);

/* Marks the lists as stale. Call when the mesh or the pieces changed. */
static inline void kiriPieceLists_Forget(kiriPieceLists* lists)
{
    lists->hasFrames = lists->hasMesh = false;
}

kiriSpan kiriPieceItems_Of(const kiriPieceItems* list, int32_t piece);

/* Removes all lists. Arrays, which the host may hold, get the owner `retired`. */
void kiriPieceLists_Retire(kiriPieceLists* lists, kiriMemory* retired);

/* Returns the state of a piece for the host. Frames and mesh must be listed. */
kiriPieceState kiriPiece_State(const kiriSheetData* sheet, int32_t piece);

KIRI_C_END

#endif
