/* The world: its sheets, obstacles, pairs, recorder, ids and events. */
#ifndef KIRI_WORLD_H
#define KIRI_WORLD_H

#include "../sheet/kiri_sheet.h"
#include "../core/kiri_archive.h"
#include "../core/kiri_base.h"
#include "../sheet/kiri_meeting.h"

KIRI_C_BEGIN

/* A piece, as seen by other pieces that may touch it. */
typedef struct kiriBody {
    kiriSheetData* sheet;
    int32_t piece;
    kiriFrame id; /* of its lowest frame; identifies the body from tick to tick */
    kiriBox box;
    double speed;      /* m/s: of its fastest probe */
    double stir;       /* m/s: of its fastest probe, relative to its mean velocity */
    kiriVec3 momentum; /* N s */
    double mass;       /* kg */
    bool asleep;
    bool folds; /* its directors differ much: it may have layers */
} kiriBody;

/* A probe of one body and the nearest place on another. */
typedef struct kiriNear {
    int32_t body, other; /* indices */
    int32_t vertex;      /* of `body` */
    int32_t triangle;    /* of `other` */
    double share[3];     /* barycentric coordinates in the triangle */
    kiriVec3 normal;     /* of the triangle; its sign follows from the order of corners in the rest plane */
    double height;       /* m: of the probe above the triangle, along the normal */
    double kept;         /* m: the distance that they keep; 0: the probe is on the wrong side */
} kiriNear;

/* Two pieces near each other. */
typedef struct kiriTouchingPair {
    kiriFrame ids[2]; /* of bodies */
    int32_t side;     /* 1: one lies on the side of the normals of the one with the higher id; -1: on the other; 0: one folds */
    int32_t touches;  /* 1: they touch or are about to, so they wake and sleep together; else 0 */
    kiriSpan nears;   /* current tick only: near places found */
} kiriTouchingPair;

typedef KIRI_ARRAY(kiriTouchingPair) kiriTouchingPairs;

/* A place on a sheet: a point of a triangle, or a vertex. */
typedef struct kiriPlace3 {
    kiriSheetData* sheet;
    int32_t vertex[3]; /* KIRI_NONE if unused */
    double share[3];
} kiriPlace3;

/* A contact of a pair, current or expected in the coming tick. */
typedef struct kiriPairTouch {
    kiriPlace3 upper, lower;
    uint64_t key;
    kiriVec3 normal;   /* unit, towards the upper place */
    kiriVec3 velocity; /* m/s: of the lower place */
    double gap;        /* m: distance of the places along the normal */
    double distance;   /* m: that they keep */
    bool isFold;       /* both places are of one piece, or have crossed */
    double rank;       /* m: the gap; less if they pushed in the last tick */
    int32_t touch; /* index in touches.found of the upper sheet, or KIRI_NONE */
} kiriPairTouch;

/* Bodies joined by mutual contacts: one system, see kiri_island.h. */
typedef struct kiriIsland {
    kiriSpan bodies; /* in kiriIslands.bodies */
    kiriIslandMatrix matrix;
    kiriSolver* solver; /* the scratch of its steps */
    kiriStitchRow* stitches; /* the first one, or null */
    int32_t iterations; /* the most of its sheets */
} kiriIsland;

/* See kiri_island.h. */
typedef struct kiriIslands {
    kiriIndices clusters, next;         /* per sheet: union-find forest of sheets; the next sheet of its cluster */
    kiriFlags isJoined;                 /* per sheet: it has a mutual contact */
    KIRI_ARRAY(kiriSystem) systems;     /* per sheet */
    kiriIndices firstBodies;            /* per sheet: number of its body 0 */
    kiriIndices parents, numbers;       /* per body: union-find forest; island, or KIRI_NONE */
    KIRI_ARRAY(kiriIslandBody) bodies;  /* by island */
    KIRI_ARRAY(kiriIsland) islands;     /* `count` of them are used in this tick; all keep their matrix */
    int32_t count;
} kiriIslands;

/* See kiri_pair.h. */
typedef struct kiriPairs {
    kiriTouchingPairs pairs, next; /* of this tick, and found for the coming tick; sorted by ids */
    kiriTouchingPairs found;       /* unsorted */
    KIRI_ARRAY(kiriBody) bodies;   /* pieces */
    kiriIndices order; /* of bodies, by the lower x of their box */
    KIRI_ARRAY(kiriNear) nears;
    kiriIndices parents;      /* union-find forest of awake pieces that touch */
    kiriReals calms;          /* s, per awake piece: in a root, of the least calm piece of its tree */
    KIRI_ARRAY(kiriPairTouch) touches;
} kiriPairs;

/* Seams, see kiri_seam.h. */

/* A stitch joins two material points. */
typedef struct kiriStitchData {
    kiriFrame frames[2];    /* each carries most of a point; it names the sheet, whichever sheet its piece is in */
    kiriLatticePoint at[2]; /* of the lattice of the sheet, which detached pieces keep */
    kiriVec2 inward[2];     /* unit, rest plane: from each line into the material, across the seam */
    double length;          /* m of the seam */
    double share;           /* of the stiffness of a whole stitch; those at ends stand for half the length */
    kiriVec3 force;         /* N, on the first point: mean over the last tick that moved it */
    int32_t number, next;   /* along the line as it was sewn; `next` may be gone. KIRI_NONE: the line ends here */
} kiriStitchData;

/* A corner of the line of a seam, between a stitch and the next one. */
typedef struct kiriSeamCorner {
    int32_t stitch; /* its number */
    double part;    /* of the way to the next one */
    kiriLatticePoint at[2];
} kiriSeamCorner;

/* A point of both drawn lips of a seam: vertices, or places in triangles. */
typedef struct kiriWeldNode {
    int32_t stretch; /* index of the stitch before it */
    double part;     /* of the way to the next stitch */
    kiriSheetData* sheets[2];
    int32_t frames[2]; /* of the stitch before it */
    int32_t vertices[2][3];
    double shares[2][3];
    bool isVertex[2];
    double open;     /* m: beyond it lips are drawn apart */
    double moves[2]; /* in this tick: share of `missing` that each end moves by */
    kiriVec3 missing;
} kiriWeldNode;

/* A vertex that moves with a lip, by the blend of two nodes. */
typedef struct kiriWeldVertex {
    int32_t vertex, node, end;
    float share, weight; /* share of the next node */
} kiriWeldVertex;

typedef struct kiriWeldNear {
    float distance; /* relative to the reach; -1: on the lip */
    int32_t node;
    float share;
} kiriWeldNear;

/* The drawn lips of a seam, see kiri_seam.h. */
typedef struct kiriWeld {
    uint64_t key;        /* hash of the stitches and meshes of the lists */
    int64_t vertexCount; /* of the sheets when listed */
    bool isDrawn;        /* in this tick */
    KIRI_ARRAY(kiriWeldNode) nodes; /* in the order of the line */
    KIRI_ARRAY(kiriWeldVertex) vertices;
} kiriWeld;

typedef struct kiriSeamData {
    kiriSeam id;
    double breakForce; /* N/m; 0: never */
    double bending;    /* N m/rad per m; 0: it turns freely */
    double restAngle;  /* rad */
    bool bends;        /* stitches meet in arcs, see kiri_seam.c */
    KIRI_ARRAY(kiriStitchData) stitches;
    KIRI_ARRAY(kiriStitchRow) rows; /* of the stitches, in the current tick */
    KIRI_ARRAY(kiriSeamCorner) corners;
    kiriWeld weld;
} kiriSeamData;

/* State of a recording, see kiri_call.h. */

enum { KIRI_RECORDER_BYTES = 512 };

typedef struct kiriRecorder {
    kiriRecordFn* write; /* null: nothing is recorded */
    void* user;
    int32_t byteCount; /* bytes not yet passed to `write` */
    uint8_t bytes[KIRI_RECORDER_BYTES];
    int32_t hashTicks; /* ticks between state hashes; 0: none */
    int64_t ticks;
    bool isOpen; /* a call has begun and not ended */
} kiriRecorder;

/* Motion of a sheet in a tick. */
typedef struct kiriMove {
    int32_t next, tail; /* next sheet of its group; in a root: last sheet of the group */
    kiriProgress progress;
    bool isStill;    /* the sheet was not moved, and its visible surface does not change */
    int64_t systems; /* items of systems solved */
} kiriMove;

/* See kiri_move.h. */
typedef struct kiriMoves {
    KIRI_ARRAY(kiriMove) of; /* one a sheet */
    kiriIndices order, parent, heads; /* of obstacles; union-find forest of sheets and obstacles; first sheet of each group */
} kiriMoves;

/* Vertices of a sheet that one task skins. */
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
    int64_t samplesDue; /* samples used by calls between ticks, to be deducted from the coming ticks */
    int64_t ticks;
    int32_t turn;      /* index of the sheet to move first: the last tick had no systems left for it */
    int32_t newEvents; /* number of events at the end of `events` from refused ticks, for the next accepted tick */
    kiriPool sheetIds, cutIds, frameIds, pinIds, obstacleIds, bladeIds, seamIds;
    KIRI_ARRAY(kiriSheetData*) sheets; /* in the order of creation */
    kiriIndices active, atWork;        /* indices of sheets: processed by the current tick; with a cut to work on */
    KIRI_ARRAY(kiriObstacleData*) obstacles; /* in the order of creation */
    KIRI_ARRAY(struct kiriBladeData*) blades;
    KIRI_ARRAY(kiriSeamData*) seams; /* in the order of creation */
    KIRI_ARRAY(kiriWeldNear) weldNear; /* scratch: one a vertex of a sheet */
    kiriIndices obstacleOrder; /* by the lower x of their box */
    kiriObstacleSearch obstacleSearch;
    KIRI_ARRAY(kiriObstacleSearch) searches; /* one a task that finds touches */
    kiriPairs pairs;
    kiriIslands islands;
    kiriMoves moves;
    KIRI_ARRAY(kiriSkinRange) skinRanges;
    KIRI_ARRAY(kiriEvent) events;
    kiriProfile profile;
    int64_t begun; /* calls of kiriWorld_Tick, including refused ones: for kiriPast */
    int32_t stage; /* current stage of the tick, or KIRI_NONE */
    double stageStart;
    uint32_t loadedAt; /* a host gets revisions of surfaces from here on: each load raises it, and no number comes again */
    uint32_t mostRevision; /* of the surfaces of sheets that went since the last load */
    char errorLine[256]; /* of the last function that changes the world */

    /* State of the calls in progress, which limits the calls that callbacks may make, see kiri_call.h. */
    bool isBusy;           /* in a function that takes the world without const */
    int32_t readers, logs; /* callbacks in progress: of functions that only read; of the log */
};

/* The pools of a world, and the kinds of their ids. */
#define KIRI_POOLS(X)                                                                                                  \
    X(sheetIds, SHEET) X(cutIds, CUT) X(frameIds, FRAME) X(pinIds, PIN) X(obstacleIds, OBSTACLE) X(bladeIds, BLADE)    \
    X(seamIds, SEAM)

static inline kiriSheetData* kiriWorld_Active(const kiriWorld* world, int32_t k)
{
    return world->sheets.data[world->active.data[k]];
}

/* Loops over the active sheets. The body may not break. */
#define KIRI_EACH_ACTIVE(sheet, world)                                                                                 \
    for (int32_t sheet##At = 0; sheet##At < (world)->active.count; ++sheet##At)                                        \
        for (kiriSheetData* sheet = kiriWorld_Active(world, sheet##At); sheet != NULL; sheet = NULL)

/* Makes a sheet from a checked def, and gives the sheet and its frames their ids. On failure the fault has the reason,
   or "" if the result says enough. */
kiriResult kiriWorld_AddSheet(kiriWorld* world, const kiriSheetDef* def, const kiriFold* folds, int32_t foldCount,
                              kiriSheet* id, kiriFault* fault);
void kiriWorld_RemoveSheet(kiriWorld* world, kiriSheetData* sheet);

/* Adds an event. The list must have room. Fields that the type does not use are zero. */
kiriEvent* kiriWorld_AddEvent(kiriWorld* world, int32_t type, const kiriSheetData* sheet);

/* Adds a cut without points. Reserves room in the queue for `points`, and for one more that may end the cut. */
kiriResult kiriWorld_AddCut(kiriWorld* world, kiriSheetData* sheet, int64_t points, kiriCutData** made);
void kiriWorld_RemoveCut(kiriWorld* world, kiriCutData* cut);

/* Same as AddCut, with a zeroed block of the world's memory. The list of cuts and the pool of ids must have room. */
void kiriWorld_EnlistCut(kiriWorld* world, kiriSheetData* sheet, kiriCutData* cut);

/* Adds a point to a cut. The queue must have room. */
void kiriWorld_QueuePoint(const kiriWorld* world, kiriCutData* cut, kiriVec2 to, bool jump);

/* Ends a cut at its last point. If that point was added before an earlier tick, queues one more; the queue must have
   room. */
void kiriWorld_EndCut(const kiriWorld* world, kiriCutData* cut);

/* Removes a pin. Its id becomes stale; the last pin of the sheet takes its index. */
void kiriWorld_RemovePin(kiriWorld* world, kiriSheetData* sheet, int32_t index);

/* Reserve room for `count` more sheets with ids, or for `count` ids of a kind. Return KIRI_OK, KIRI_ERROR_MEMORY or
   KIRI_ERROR_LIMIT. */
kiriResult kiriWorld_ReserveSheets(kiriWorld* world, int32_t count);
kiriResult kiriWorld_ReserveIds(kiriWorld* world, kiriPool* pool, int64_t count);

/* ---- Tears ---- */

/* Begins tears, and queues their next points. systems: pay for trial steps. KIRI_ERROR_MEMORY, _LIMIT: some wait. */
kiriResult kiriTears_Grow(kiriWorld* world, double dt, kiriQuota* systems);

/* Ends the tears that rest. */
void kiriTears_EndResting(kiriWorld* world, double dt);

KIRI_C_END

#endif
