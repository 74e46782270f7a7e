/* The world: its sheets, and their ids and events. */
#ifndef KIRI_WORLD_H
#define KIRI_WORLD_H

#include "../core/kiri_task.h"
#include "../sheet/kiri_obstacle_touch.h"
#include "../sheet/kiri_sheet.h"

#include "kiri_pair_data.h"
#include "kiri_recorder.h"

KIRI_C_BEGIN

/* A sheet meets a body that it may move. */
typedef struct kiriMeet {
    int64_t number; /* of the body, see kiriObstacles_NumberOf */
    int32_t sheet;
} kiriMeet;

/* How a sheet is moved in a tick. */
typedef struct kiriMove {
    int32_t next, tail; /* of its group: the sheet after it; and of a root, the last one */
    kiriProgress progress;
    bool isStill;    /* and what is seen of it is what was */
    int64_t systems; /* that it took */
} kiriMove;

/* See kiri_move_step.h. */
typedef struct kiriMoves {
    KIRI_ARRAY(kiriMove) of; /* each sheet */
    KIRI_ARRAY(kiriMeet) meets;
    kiriIndices order, parent, heads; /* of meets; of sheets in groups; the first sheet of each group */
} kiriMoves;

/* Vertices of a sheet that are skinned at a time. */
typedef struct kiriSkinRange {
    int32_t sheet, begin, end;
} kiriSkinRange;

struct kiriWorld {
    kiriMemory memory;
    kiriMemory retired; /* arrays that the host may hold until the next tick */
    kiriLogFn* log;
    kiriClockFn* clock;
    kiriTasks tasks;
    kiriRecorder recorder;
    void* user;
    kiriVec3 gravity;
    kiriBudget budget;
    int64_t samplesDue; /* that calls have taken: the coming ticks have less */
    int64_t ticks;
    int32_t turn;      /* the sheet that is moved first: the one for which the last tick had no iterations left */
    int32_t newEvents; /* at the end of `events`: added by refused ticks, for the next tick that is not refused */
    kiriPool sheetIds, cutIds, frameIds, pinIds, obstacleIds, bladeIds;
    KIRI_ARRAY(kiriSheetData*) sheets; /* in the order of their making; */
    kiriIndices active, atWork;        /* of those that the tick at hand looks at; of those with a cut to work on */
    KIRI_ARRAY(kiriObstacleData*) obstacles; /* the same */
    KIRI_ARRAY(struct kiriBladeData*) blades;
    kiriIndices obstacleOrder; /* by where they begin along x */
    kiriObstacleSearch obstacleSearch;
    KIRI_ARRAY(kiriObstacleSearch) searches; /* for tasks: so many sheets may look for touches at a time */
    kiriPairs pairs;
    kiriMoves moves;
    KIRI_ARRAY(kiriSkinRange) skinRanges;
    KIRI_ARRAY(kiriEvent) events;
    kiriProfile profile;
    int64_t begun; /* calls of kiriWorld_Tick, refused ones too: for kiriPast */
    int32_t stage; /* running now, or KIRI_NONE */
    double stageStart;
    char errorLine[256]; /* of the last function that changes the world */

    /* Which callbacks may call, see kiri_call.h. */
    bool isBusy;           /* a function that takes the world without const runs */
    int32_t readers, logs; /* callbacks that run now: of functions that only read; of the log */
};

static inline kiriSheetData* kiriWorld_Active(const kiriWorld* world, int32_t k)
{
    return world->sheets.data[world->active.data[k]];
}

/* Makes a sheet of the def, which has been checked, and gives it and its frames their ids. On failure the fault says
   why, or "" where the result says it all. */
kiriResult kiriWorld_AddSheet(kiriWorld* world, const kiriSheetDef* def, kiriSheet* id, kiriFault* fault);
void kiriWorld_RemoveSheet(kiriWorld* world, kiriSheetData* sheet);

/* In the room of the list, with zeros for what its type does not name. */
kiriEvent* kiriWorld_AddEvent(kiriWorld* world, int32_t type, const kiriSheetData* sheet);

/* Adds a cut without points. Reserves room in the queue for `points`, and for one more that may end the cut. */
kiriResult kiriWorld_AddCut(kiriWorld* world, kiriSheetData* sheet, int64_t points, kiriCutData** made);
void kiriWorld_RemoveCut(kiriWorld* world, kiriCutData* cut);

/* The same with a zeroed block of the world's memory, where there is room in the list of cuts and for the id. */
void kiriWorld_EnlistCut(kiriWorld* world, kiriSheetData* sheet, kiriCutData* cut);

/* A point for a cut, in the room of the queue. */
void kiriWorld_QueuePoint(const kiriWorld* world, kiriCutData* cut, kiriVec2 to, bool jump);

/* Ends a cut with its last point. Where that was given before an earlier tick, queues one more, in the queue's room. */
void kiriWorld_EndCut(const kiriWorld* world, kiriCutData* cut);

/* Its id is stale then; the last pin of the sheet takes its index. */
void kiriWorld_RemovePin(kiriWorld* world, kiriSheetData* sheet, int32_t index);

/* Room for so many more sheets and their ids; for so many ids of a kind. KIRI_ERROR_MEMORY or KIRI_ERROR_LIMIT. */
kiriResult kiriWorld_ReserveSheets(kiriWorld* world, int32_t count);
kiriResult kiriWorld_ReserveIds(kiriWorld* world, kiriPool* pool, int64_t count);

KIRI_C_END

#endif
