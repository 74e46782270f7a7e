/* What the world keeps of pairs, see kiri_pair.h. */
#ifndef KIRI_WORLD_H
#define KIRI_WORLD_H

#include "../sheet/kiri_sheet.h"
#include "../core/kiri_archive.h"
#include "../core/kiri_base.h"
#include "../sheet/kiri_touch.h"

KIRI_C_BEGIN

/* A piece as others may touch it. */
typedef struct kiriBody {
    kiriSheetData* sheet;
    int32_t piece;
    kiriFrame id; /* of the lowest frame of the piece: names it from tick to tick */
    kiriBox box;
    double speed;      /* m/s: of its fastest probe, */
    double stir;       /* m/s: and that beside its mean velocity */
    kiriVec3 momentum; /* N s, */
    double mass;       /* kg */
    bool asleep;
    double least;   /* m/s: how fast it rises at least in the tick, for what it will be stopped by */
    bool isCarried; /* does it lie on anything? */
    bool isHeld;    /* by a pin or by the host */
} kiriBody;

/* A probe of one body and the nearest place on another. */
typedef struct kiriNear {
    int32_t body, other; /* indices */
    int32_t vertex;      /* of `body` */
    int32_t triangle;    /* of `other`, */
    double share[3];     /* and barycentric coordinates in it */
    kiriVec3 normal;     /* of the triangle as it lies in the rest plane */
    double height;       /* m: of the probe above the triangle, along the normal */
} kiriNear;

/* Two pieces near each other. */
typedef struct kiriTouchingPair {
    kiriFrame upper, lower; /* ids of bodies */
    int32_t side;           /* 1, -1: the upper one is where the normals of the lower one point, or opposite */
    int32_t touches;        /* do they touch, or are about to? Then they wake and sleep together */
    int32_t bodies[2];      /* indices of upper and lower, */
    kiriSpan nears;         /* and what was found, in the tick at hand alone */
} kiriTouchingPair;

typedef KIRI_ARRAY(kiriTouchingPair) kiriTouchingPairs;

/* A place of a sheet: of a triangle, or a vertex alone. */
typedef struct kiriPlace3 {
    kiriSheetData* sheet;
    int32_t vertex[3]; /* KIRI_NONE where there are fewer */
    double share[3];
} kiriPlace3;

/* Where the upper one of a pair touches the lower one, or may in the coming tick. */
typedef struct kiriPairTouch {
    kiriPlace3 upper, lower;
    int32_t bodies[2]; /* of these */
    uint64_t key;
    kiriVec3 normal;   /* unit, to the upper one */
    kiriVec3 velocity; /* of the lower place */
    double gap;        /* m, of the places along the normal */
    double
        lift; /* m/s: how fast the lower one rises along it as a whole; 0: it lies on something, and only springs up */
    int32_t touch; /* index in what touches the upper sheet */
} kiriPairTouch;

/* What of the push of a touch the lower one feels. */
typedef struct kiriFeltPush {
    uint64_t key;
    kiriVec3 force; /* N, on the upper one */
} kiriFeltPush;

/* A piece that is awake; and, at the lowest of them, pieces that touch each other, directly or by others. */
typedef struct kiriIsland {
    double mass, kinetic;    /* kg, J: of the piece; */
    double gained, passed;   /* J: see kiriSolver_AddGained */
    double keep, keepPush;   /* of its velocities, by the limit of energy, and of its push on others */
    double pushed;           /* N s: of planes of other pieces on it, the sum of sizes; */
    kiriVec3 push;           /* and the sum */
    double calm;             /* s: of the least calm piece */
    bool isHeld;             /* is one held by a pin, the host or an obstacle? */
    int32_t pieces;          /* how many */
    double surplus, sources; /* J: gained out of nothing; by the pieces that gained in all */
    double moving, mostHeat; /* J, of all; J/kg, of the fastest piece, were it not for the others */
    double whole, left;      /* kg; J, of all motion when pieces are limited */
    kiriVec3 mean, velocity; /* m/s, of their centre of mass: then; and as it is due by their momentum, */
    double keepBeside;       /* and how much is kept of what velocities have beside that */
} kiriIsland;

/* See kiri_pair.h. */
typedef struct kiriPairs {
    kiriTouchingPairs pairs, next; /* in force, and as found for the coming tick; sorted by ids */
    kiriTouchingPairs found;       /* before they are sorted */
    KIRI_ARRAY(kiriBody) bodies;
    kiriIndices order; /* of bodies, by the lower end of their box along x */
    KIRI_ARRAY(kiriNear) nears;
    kiriIndices parents;            /* of pieces that are awake: which touch each other, */
    KIRI_ARRAY(kiriIsland) islands; /* and what these have together, at the lowest of them */
    KIRI_ARRAY(kiriPairTouch) touches;
    KIRI_ARRAY(kiriFeltPush) felt, nextFelt; /* by key */
} kiriPairs;

/* What a world keeps for its recording, see kiri_call.h. */

enum { KIRI_RECORDER_BYTES = 512 };

typedef struct kiriRecorder {
    kiriRecordFn* write; /* null: nothing is recorded */
    void* user;
    int32_t byteCount; /* bytes that `write` has not got yet */
    uint8_t bytes[KIRI_RECORDER_BYTES];
    int32_t hashTicks; /* ticks between state hashes; 0: none */
    int64_t ticks;
    bool isOpen; /* a call has begun and not ended */
} kiriRecorder;

/* The world: its sheets, and their ids and events. */

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

/* See kiri_move.h. */
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
