/* Pieces that get a sheet of their own, or are taken away: at once where no work on a cut is at hand in their sheet,
   else when it is done. Then pieces that are taken away are gone as far as anybody sees, but for their place in the
   mesh. */
#ifndef KIRI_PART_H
#define KIRI_PART_H

#include "kiri_world.h"
#include "../sheet/kiri_detach.h"

KIRI_C_BEGIN

/* The pieces of these frames, whose ids are known to be right; all in one pass. KIRI_PENDING: some wait. ids[i] becomes
   the sheet of frames[i], 0 where it waits. KIRI_ERROR_STATE: nothing would be left of a sheet. On failure (also for
   memory, or ids) nothing has changed. */
kiriResult kiriParts_Detach(kiriWorld* world, const kiriFrame* frames, int32_t count, kiriSheet* ids);
kiriResult kiriParts_Destroy(kiriWorld* world, const kiriFrame* frames, int32_t count);

/* Takes away all pieces below an area (m^2) but the largest. The same. */
kiriResult kiriParts_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count);

/* Does something wait, while no work is at hand in the sheet? No work begins before that is done. */
bool kiriParts_AreDue(const kiriSheetData* sheet);

/* Pays for the pieces that are due, with the samples that are left at the end of a tick. */
void kiriParts_Pay(kiriWorld* world, kiriSheetData* sheet, kiriQuota* samples);

/* Takes out the pieces that are paid, at the start of a tick, and adds an event for each new sheet. If the first piece
   is not paid in full, goes on with its cache. The paid samples alone decide. On failure nothing has changed. */
kiriResult kiriParts_Leave(kiriWorld* world, kiriSheetData* sheet);

/* What the files of parting share: kiri_part.c (pieces become sheets), kiri_part.c (they are taken away),
   kiri_part.c (what waits). No other file of the library includes it. */

/* A piece that is taken out. */
typedef struct kiriPart {
    struct kiriPartSource* from;
    kiriFrame frame;      /* that names it */
    kiriSheetData* sheet; /* that it becomes; null: not made yet */
    int32_t piece;
} kiriPart;

/* A sheet that loses something. */
typedef struct kiriPartSource {
    kiriRemoval removal;
    kiriExtraction extraction;
    kiriPast past; /* of the sheet after its loss; unused where it leaves holes */
    bool leavesHoles;
    bool waits;     /* what is to become a sheet does so later */
    double samples; /* that it costs at once */
} kiriPartSource;

/* What one call takes out of sheets. */
typedef struct kiriParting {
    kiriWorld* world;
    kiriMemory memory;
    kiriPartSource* sources;
    int32_t sourceCount, sourceRoom;
    bool isInTick;
    KIRI_ARRAY(kiriPart) parts;
} kiriParting;

/* Room for so many sheets that lose something; false for memory. Call End in any case. */
bool kiriParting_Start(kiriParting* parting, kiriWorld* world, int32_t sheets);
void kiriParting_End(kiriParting* parting);

/* ---- Which pieces ---- */

/* Is work on a cut at hand in the sheet? */
bool kiriPart_IsBusy(const kiriSheetData* sheet);

int32_t kiriPart_PieceOfFrame(const kiriWorld* world, kiriFrame frame);

/* Does the piece wait to become a sheet? */
bool kiriPart_IsLeaving(const kiriWorld* world, const kiriSheetData* sheet, int32_t piece);

/* A sheet of which all is left, for now, but for what is gone; SourceFor adds it where it is not listed. Null for
   memory. */
kiriPartSource* kiriParting_AddSource(kiriParting* parting, kiriSheetData* sheet);
kiriPartSource* kiriParting_SourceFor(kiriParting* parting, kiriSheetData* sheet);

/* Marks the pieces of frames to go, and lists each once. False for memory. */
bool kiriParting_MarkPieces(kiriParting* parting, const kiriFrame* frames, int32_t count);

/* Is something left of each sheet? */
bool kiriParting_LeavesSome(const kiriParting* parting);

/* ---- What it costs ---- */

/* A call does at once what is left of one tick's samples; the rest waits, each sheet's for itself. What work is at hand
   in, or has others that wait, waits in any case. */
void kiriParting_ChooseWhatWaits(kiriParting* parting, bool makesSheets);

/* Once it is done. */
void kiriParting_Charge(const kiriParting* parting);

/* KIRI_PENDING where some of it waits. */
kiriResult kiriParting_Result(const kiriParting* parting);

/* ---- Out of their sheets ---- */

/* What a sheet loses is listed once for all its parts; then it is staged; then it goes. Only Commit never fails. */
bool kiriParting_Gather(kiriParting* parting, bool makesParts);
bool kiriParting_Stage(kiriParting* parting);
void kiriParting_Commit(kiriParting* parting);

/* All of it, with sheets for the pieces that are marked. */
kiriResult kiriParting_Detach(kiriParting* parting);

KIRI_C_END

#endif
