/* The world: sheets, ids, events, and the tick. */
#ifndef KIRI_WORLD_H
#define KIRI_WORLD_H

#include "../sheet/kiri_motion.h"
#include "../core/kiri_pool.h"
#include "../sheet/kiri_sheet.h"
#include "../sheet/kiri_seen.h"

typedef struct kiriError {
    char line[256];
} kiriError;

struct kiriWorld {
    kiriMemory memory;
    kiriMemory retired; /* arrays that the host may hold until the next tick */
    kiriLogFn* log;
    kiriClockFn* clock;
    void* user;
    kiriVec3 gravity;
    kiriBudget budget;
    int64_t ticks;
    int32_t turn; /* the sheet that is moved first: the one for which the last tick had no iterations left */
    kiriPool sheetIds, cutIds, frameIds, pinIds;
    KIRI_ARRAY(kiriSheetData*) sheets; /* in the order of their making */
    KIRI_ARRAY(kiriEvent) events;
    kiriProfile profile;
    int32_t stage; /* running now, or KIRI_NONE */
    double stageStart;
    kiriError error;
};

/* One tick: KIRI_OK, KIRI_PENDING (work waits), KIRI_ERROR_MEMORY (nothing moved), or KIRI_DIVERGED. */
kiriResult kiriWorld_Advance(kiriWorld* world, double dt, int32_t substeps);

/* Makes a sheet of the def, which has been checked, and gives it and its frames their ids. */
kiriResult kiriWorld_AddSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* id, const char** why);
void kiriWorld_RemoveSheet(kiriWorld* world, kiriSheetData* sheet);

/* A piece that is not the only one gets a sheet of its own, or is taken away; so are all pieces below an area but the
   largest. No update is at hand in the sheet. False for memory: nothing has changed. */
bool kiriWorld_DetachPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece, kiriSheet* id);
bool kiriWorld_DropPiece(kiriWorld* world, kiriSheetData* sheet, int32_t piece);
bool kiriWorld_DropCrumbs(kiriWorld* world, kiriSheetData* sheet, double area, int32_t* count);

/* A cut with no points yet; null for memory. */
kiriCutData* kiriWorld_AddCut(kiriWorld* world, kiriSheetData* sheet);

#endif
