/* Takes pieces out of a sheet in place. No field is computed anew, for nothing couples two pieces: what is left stays
   as it is to the last bit, but for its indices. */
#ifndef KIRI_REMOVE_H
#define KIRI_REMOVE_H

#include "kiri_gather.h"
#include "kiri_kept.h"

KIRI_C_BEGIN

typedef struct kiriRemoval {
    kiriSheetData* sheet;
    kiriKept kept;               /* what is left */
    kiriGathered gathered;       /* what goes, where it leaves holes or becomes parts */
    bool leavesHoles;            /* triangles and vertices do not move together */
    kiriKeep labels;             /* what labels of frames become, where they do */
    kiriIndices cells, squares;  /* that go, and the squares in which they are, each once */
    KIRI_ARRAY(kiriVec3) forces; /* of each touch of the last tick */
    kiriShown shown;
    KIRI_ARRAY(float) points; /* where collision points that are left are seen */
} kiriRemoval;

/* Nothing is left yet: the caller marks in `kept` what is. False for memory; Drop is to be called then, too. */
bool kiriRemoval_Init(kiriRemoval* removal, kiriSheetData* sheet);

/* Lists what goes, by piece. Needed only where parts are made, or holes are to be left. False for memory. */
bool kiriRemoval_Gather(kiriRemoval* removal);

/* Is it worth while to move all triangles and vertices that are left together, when this share of the sheet's area
   goes? That takes a pass over the sheet: once for as much as has gone, and where a sheet is small each time. Else what
   goes is gathered, and leaves holes. */
bool kiriRemoval_IsWorthAPass(const kiriSheetData* sheet, double share);

/* What it takes to take this share of a sheet's area out of it, in samples. */
double kiriRemoval_Samples(const kiriSheetData* sheet, double share);

/* Makes ready: after it Commit does not fail. Fields belong to the mesh as it is (kiriUpdate_IsFieldCurrent). False for
   memory; nothing has changed. */
bool kiriRemoval_Stage(kiriRemoval* removal, bool leavesHoles);

/* Pieces go. Blades that were in their material are in none; other cuts go on. Arrays that the host may hold get the
   owner `retired`. Ids are left to the caller. Never fails. */
void kiriRemoval_Commit(kiriRemoval* removal, kiriMemory* retired);

/* Gives back what the removal holds, done or not. */
void kiriRemoval_Drop(kiriRemoval* removal);

KIRI_C_END

#endif
