/* Some pieces of a sheet that are kept: which of its items are theirs, and the index that each gets. */
#ifndef KIRI_DETACH_H
#define KIRI_DETACH_H

#include "kiri_sheet.h"
#include "kiri_update.h"

KIRI_C_BEGIN

typedef struct kiriKept {
    const kiriSheetData* from;
    kiriMemory memory;          /* of the arrays; freed by the caller */
    KIRI_ARRAY(uint8_t) pieces; /* of each: is it kept? Set by the caller */
    kiriKeep triangles, vertices, frames, points, pins, links;
} kiriKept;

/* No piece is kept yet. False for memory. */
bool kiriKept_Init(kiriKept* kept, const kiriSheetData* from);

/* Makes the maps, for the pieces as they are marked now. False for memory. */
bool kiriKept_Map(kiriKept* kept);

/* The same where triangles and vertices leave holes: those that kiriGather_Mark has marked, as long as they are. */
bool kiriKept_LeaveHoles(kiriKept* kept);

/* For one piece after the other: maps of which none keeps anything yet; those of vertices and triangles are the sheet's
   own (kiriTaking), which nobody else uses meanwhile. False for memory. */
bool kiriKept_InitParts(kiriKept* kept, const kiriSheetData* from);

/* The piece is kept, and all maps are made; these are its items, from the lowest to the highest. And none is again. */
void kiriKept_TakePart(kiriKept* kept, int32_t piece, const kiriIndices* vertices, const kiriIndices* triangles);
void kiriKept_DropPart(kiriKept* kept, int32_t piece, const kiriIndices* vertices, const kiriIndices* triangles);

/* One of the kept frames that a pin holds: of a line, which may hold more pieces than one, the one that it holds most
   of. KIRI_NONE where it holds none. */
int32_t kiriKept_FrameOfPin(const kiriKept* kept, int32_t pin);

/* The contact among what is kept; false where its point is not. */
bool kiriKept_FollowContact(const kiriKept* kept, kiriGivenContact* given);

/* The same of a touch, and its key; also false where only its finder knows the key. */
bool kiriKept_FollowTouch(const kiriKept* kept, kiriTouch* touch);

/* Their part of the sheet's area. */
double kiriKept_Share(const kiriKept* kept);

/* What belongs to some pieces of a sheet, found from their frames on, at the cost of the pieces. */

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

/* Pieces of a sheet as a sheet of their own. */

/* Parts of a sheet, one after the other: each costs what it is large. */
typedef struct kiriExtraction {
    kiriKept kept; /* the part at hand; its memory is that of all */
    const kiriGathered* gathered;
} kiriExtraction;

/* What is gathered may become parts, while it is not marked. False for memory; Drop is to be called then, too. */
bool kiriExtraction_Init(kiriExtraction* extraction, const kiriGathered* gathered);

/* The sheet of one piece: on the same lattice and squares, so that all that follows from the mesh is what it was bit
   for bit; frames, pins and contacts keep ids and state. `to` is new, or begun. Cuts stay behind. No cut has changed
   the mesh whose work is not done. False for memory. */
bool kiriExtraction_Build(kiriExtraction* extraction, int32_t piece, kiriSheetData* to);

/* The same little by little, before the piece leaves: its mesh, then its fields and weights as far as the quotas go.
   These depend on the mesh of the sheet alone, so long as that is the same; all else Build takes as it is in the
   end. */
kiriProgress kiriExtraction_GoOn(kiriExtraction* extraction, int32_t piece, kiriSheetData* to, kiriQuotas* quotas);

/* What it takes to make sheets of this share of a sheet's area, in samples. */
double kiriExtraction_Samples(const kiriSheetData* sheet, double share);

/* Samples to make the sheet of one piece in steps (kiriExtraction_GoOn). share: of the area; frames: of the piece. */
double kiriExtraction_SamplesAhead(const kiriSheetData* sheet, double share, int32_t frames);

void kiriExtraction_Drop(kiriExtraction* extraction);

/* Derives the data that saves leave out from the mesh and the frames: grid, regions, shape functions, links, weights of
   samples, owners of material. */

/* Runs the stages of a sheet whose saved fields were checked. False for memory; or, with *isBad, if two sites share a
   cell, or frames lie in other pieces than the save says. */
bool kiriRemake_Field(kiriSheetData* sheet, bool* isBad);

/* Takes pieces out of a sheet in place. No field is computed anew, for nothing couples two pieces: what is left stays
   as it is to the last bit, but for its indices. */

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
