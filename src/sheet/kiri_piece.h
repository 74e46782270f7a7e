/* Pieces: the connected parts of a sheet. They are numbered by their lowest frame. */
#ifndef KIRI_PIECE_H
#define KIRI_PIECE_H

#include "kiri_update.h"

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

KIRI_C_END

#endif
