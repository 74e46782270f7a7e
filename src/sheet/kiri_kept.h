/* Some pieces of a sheet that are kept: which of its items are theirs, and the index that each gets. */
#ifndef KIRI_KEPT_H
#define KIRI_KEPT_H

#include "kiri_sheet.h"

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

KIRI_C_END

#endif
