/* Pieces: the connected parts of a sheet. They are numbered by their lowest frame. */
#ifndef KIRI_PIECE_H
#define KIRI_PIECE_H

#include "kiri_update.h"
#include "kiri_sheet.h"
#include "kiri_detach.h"

KIRI_C_BEGIN

/* Stages the pieces that come in force with the next commit, from the links that are staged. False for memory. */
bool kiriPieces_Stage(kiriSheetData* sheet);

/* The piece of a triangle; KIRI_NONE for a hole. */
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

/* What is in each piece of a sheet, for the host: lists that are made when it asks for them. */

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

/* Turns: where the budget has too few systems left for all pieces of a sheet that are awake, some of them are moved in
   a tick, and the others wait: a piece that waits stays where it is, with the velocity that it has, as a whole sheet
   does for which nothing is left. In the next tick the first that waited comes first. What it touched last is
   remembered as for a piece that sleeps. Pieces are independent of each other in a step, so that any of them may go. */

/* When what is awake is listed, and touches are found: chooses which of it waits. Returns whether any does: then other
   pieces are listed. */
bool kiriPieceTurns_Begin(kiriSheetData* sheet, const kiriSystem* system, const kiriQuota* systems);

/* The pieces that were chosen are moved: who is next? */
void kiriPieceTurns_Take(kiriSheetData* sheet);

/* The tick is over: nobody waits. */
void kiriPieceTurns_End(kiriSheetData* sheet);

/* A cache: the sheet of a piece is made little by little while the piece waits to leave, so that the tick in which it
   leaves has less to do. No tick depends on how far it has come, saves leave it out, and it may be dropped at any
   time. */

/* Goes on with the sheet of the piece of this frame, as far as `paid` samples pay in all. Drops the cache of another
   piece. After a load the first call catches up. Fields belong to the mesh as it is. `memory` owns all sheets. False
   for memory: the cache is dropped. */
bool kiriAhead_GoOn(kiriSheetData* sheet, kiriFrame frame, kiriMemory* memory, int64_t paid);

/* What has been made for the piece of this frame, which is the caller's from now on; null: nothing. */
kiriSheetData* kiriAhead_Take(kiriSheetData* sheet, kiriFrame frame);

/* What belongs to the pieces that `stays` is 0 for, where that is known, until the next call; or null. */
const kiriGathered* kiriAhead_Gathered(const kiriSheetData* sheet, const uint8_t* stays);

void kiriAhead_Drop(kiriSheetData* sheet, kiriMemory* memory);

KIRI_C_END

#endif
