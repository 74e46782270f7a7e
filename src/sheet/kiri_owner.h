/* Which frame a point of the material belongs to, and which frames a line of it: for pins and loads. */
#ifndef KIRI_OWNER_H
#define KIRI_OWNER_H

#include "kiri_update.h"

KIRI_C_BEGIN

/* The index of the frame that holds a point of the material; KIRI_NONE outside, and in what is gone. */
int32_t kiriOwner_At(const kiriSheetData* sheet, kiriLatticePoint at);

/* The same of the triangle of a node of mesh.squares, in the node's square; KIRI_NONE for no node, too. */
int32_t kiriOwner_OfNode(const kiriSheetData* sheet, int32_t node, bool isStaged);

/* Finds what of a line belongs to each frame into sheet->lineShares, in the order in which the line meets them; nothing
   where it meets no material. The ends differ. isStaged: with the regions that come in force with the next commit.
   False for memory. */
bool kiriOwner_FindShares(kiriSheetData* sheet, kiriLatticePoint from, kiriLatticePoint to, bool isStaged);

KIRI_C_END

#endif
